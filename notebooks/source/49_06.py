# %% [markdown] lang="en"
# # 49.6 RNEA: inverse dynamics
#
# Given a motion, which forces make it happen? The recursive Newton–Euler algorithm passes through the tree twice: outward
# with the motion, inward with the forces. You see it grow line by line, then what gravity is in it, and what the chapter's
# pseudocode gets wrong.
# %% [markdown] lang="zh"
# # 49.6 RNEA:逆动力学
#
# 给定运动,需要什么样的力?递归牛顿-欧拉算法沿运动树走两遍:向外传递运动,向内传递力。这个笔记本一行一行地写出它,
# 再说明重力是怎样进入的,最后看看本章的伪代码错在哪里。
# %%
import twistwrench as tw

model = tw.load("go2")
q = model.standing()
# %% setup="yes"
import dataclasses
import inspect

import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot
from twistwrench.algorithms.rnea import newton_euler
from twistwrench.exercises.wrong import faulty
from twistwrench.model import columns, tree_terms, wrenches

np.set_printoptions(formatter={"float_kind": lambda x: f"{round(x, 3) + 0:7.4g}"})
v, a = np.zeros((2, model.nv))
v[2], v[3], a[3] = 0.6, 0.8, 2.0  # the base turns left at 0.6 rad/s, walks at 0.8 m/s, and speeds up
for leg, sign in {"FL": 1, "FR": -0.4, "RL": -0.4, "RR": 1}.items():  # two legs swing, two go back
    thigh = model.v_slice[model.joint_id(f"{leg}_thigh_joint")].start
    v[thigh : thigh + 2] = sign * np.array([-5.0, 4.0])
    a[thigh : thigh + 2] = sign * np.array([30.0, 90.0])


def draw_arrow(ax, at, length, text, colour, shift=(6, 4)):
    """Draw an arrow from a place, with words at its tip."""
    arrow = {"arrowstyle": "-|>", "color": colour, "lw": 2, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", np.add(at, length), at, arrowprops=arrow)
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 1}
    ax.annotate(text, np.add(at, length), shift, textcoords="offset points", color=colour, fontsize=9, bbox=box)
    ax.plot(*at, "k.", zorder=4)


# %% [markdown] lang="en"
# ## Two rods
#
# Two rods of 1 m and 1 kg, whose numbers can be checked in the head: the elbow is bent by a right angle, the shoulder turns
# at 1 rad/s, the elbow at 2 rad/s, both steadily. Body 0 is the world. To the recursion a joint is two things: the matrix
# $X_i$ that takes a twist from the parent's frame to frame $i$, and the subspace $S_i$ of the motions that it allows.
# %% [markdown] lang="zh"
# ## 两根杆
#
# 两根 1 m、1 kg 的杆,各个数都能心算验证:肘弯成直角,肩以 1 rad/s、肘以 2 rad/s 匀速转动。刚体 0 是世界。
# 对递推来说,一个关节就是两样东西:把 twist 从父坐标系换到坐标系 $i$ 的矩阵 $X_i$,以及关节所允许的运动的子空间 $S_i$。
# %%
arm = tw.chain(2)
bend, qd, qdd = np.deg2rad([0, -90]), np.array([1.0, 2.0]), np.zeros(2)
tree = tree_terms(arm, bend)
S, X, I = tree.S, tree.X, tree.I
V, A, B = np.zeros((3, 3, 6))  # a row for the world and one for each rod
# %%
figure, ax = plt.subplots(figsize=(4.4, 4), layout="constrained")
plot.side_view(arm, bend, com=False, ax=ax).set(title="the rods and their frames", xlim=(-0.7, 1.2), ylim=(-1.5, 0.5))
for k, T in enumerate(tw.forward_kinematics(arm, bend).placement[1:], start=1):
    for axis, name in ((0, "x"), (2, "z")):
        way = 0.35 * T.rotation[[0, 2], axis]
        draw_arrow(ax, T.translation[[0, 2]], way, f"{name}{k}", plot.XYZ[axis])
plt.show()
# %% [markdown] lang="en"
# ## Outward: twists and accelerations
#
# A body moves as its parent does, seen from its own frame, and its joint adds to that:
#
# $$\boldsymbol V_i = X_i \boldsymbol V_{\lambda(i)} + S_i \dot q_i.$$
#
# One line of code. The parent of rod 1 is the world, which rests:
# %% [markdown] lang="zh"
# ## 向外:twist 与加速度
#
# 刚体随父连杆一起运动(换到自己的坐标系里看),再加上关节自身的运动:
#
# $$\boldsymbol V_i = X_i \boldsymbol V_{\lambda(i)} + S_i \dot q_i.$$
#
# 代码就是一行。杆 1 的父连杆是静止的世界:
# %%
V[1] = X[1] @ V[0] + S[1] @ qd[:1]
V[1]
# %% [markdown] lang="en"
# It turns about y, and the shoulder, where its frame is, stays. For rod 2 the same line:
# %% [markdown] lang="zh"
# 它绕 y 轴转;它的坐标系在肩处,那里不动。杆 2 用同一行:
# %%
V[2] = X[2] @ V[1] + S[2] @ qd[1:]
V[2]
# %% [markdown] lang="en"
# 1 + 2 rad/s; and the elbow moves at 1 m/s to the left, which frame 2 calls its z. That was the work of $X_2$.
#
# Differentiate the line, and use the rate of $X$ (49.5). The motion of the frames adds one cross product:
#
# $$\boldsymbol a_i = X_i \boldsymbol a_{\lambda(i)} + S_i \ddot q_i + \boldsymbol V_i \times S_i \dot q_i.$$
#
# The axis $S_i$ is fixed in body $i$ and moves with it; $\boldsymbol V_i \times S_i$ is the rate at which it does. (If its
# numbers depended on $q$, as in a base with Euler angles, $\dot S_i \dot q_i$ would be added. Here they never do.)
# %% [markdown] lang="zh"
# 角速度是 1 + 2 rad/s;肘以 1 m/s 向左运动,在坐标系 2 里这就是 z 方向。这一步由 $X_2$ 完成。
#
# 对这一行求导,并用上 $X$ 的变化规律(49.5)。坐标系的运动留下的只有一个叉积:
#
# $$\boldsymbol a_i = X_i \boldsymbol a_{\lambda(i)} + S_i \ddot q_i + \boldsymbol V_i \times S_i \dot q_i.$$
#
# 关节轴 $S_i$ 固定在刚体 $i$ 上,随它一起运动,$\boldsymbol V_i \times S_i$ 就是它的变化率。(若 $S_i$ 的各个数随 $q$ 变化,例如用欧拉角表示的基座,
# 还要加上 $\dot S_i \dot q_i$。这里的 $S_i$ 都是常数。)
# %%
tw.ask("49.6-slider", ...)
# %% [markdown] lang="en"
# Start with the world: $\boldsymbol a_0 = (0, -\boldsymbol g)$. Instead of pulling every body down, let the world rise; why
# that is the same, we see below. Then one line for both rods, in a loop:
# %% [markdown] lang="zh"
# 从世界开始:$\boldsymbol a_0 = (0, -\boldsymbol g)$。不是把每个刚体往下拉,而是让世界向上加速;为什么两者一样,下面会看到。
# 然后用循环,一行算出两根杆:
# %%
A[0, 3:] = -arm.gravity
for i in (1, 2):
    vJ, aJ = S[i] @ qd[i - 1 : i], S[i] @ qdd[i - 1 : i]
    A[i] = X[i] @ A[i - 1] + aJ + tw.cross_motion(V[i]) @ vJ
A
# %% [markdown] lang="en"
# Rod 2 has 9.81 along its x, which points up, less the 2 m/s² of an elbow axis that moves.
#
# ## Inward: wrenches
#
# The Newton–Euler equation gives the wrench that each rod needs for its own motion:
# %% [markdown] lang="zh"
# 杆 2 沿自己的 x 轴(朝上)有 9.81,再减去肘轴运动带来的 2 m/s²。
#
# ## 向内:wrench
#
# 牛顿-欧拉方程给出每根杆自身的运动所需的 wrench:
# %%
for i in (1, 2):
    B[i] = I[i] @ A[i] + tw.cross_force(V[i]) @ I[i] @ V[i]
B
# %% [markdown] lang="en"
# Rod 1 needs 10.31 N upward: its weight, and 0.5 N to keep its middle on the circle. The chapter then adds "the reactions
# that all children pass on". Which sign has that?
# %% [markdown] lang="zh"
# 杆 1 需要 10.31 N 向上的力:托住重量,另有 0.5 N 使杆的中点保持在圆周上。本章接着“加上所有子连杆传递过来的反作用力”。符号是正还是负?
# %%
tw.ask("49.6-child", ...)
# %% [markdown] lang="en"
# Joint $i$ supplies body $i$ and everything outboard of it. So the wrench through it is what the body itself needs plus what
# goes on to its children, and the motor supplies the part along the joint:
#
# $$\boldsymbol F_i = \hat I_i \boldsymbol a_i + \boldsymbol V_i \times^* \hat I_i \boldsymbol V_i +
# \sum_{\lambda(j) = i} X_j^T \boldsymbol F_j, \qquad \boldsymbol\tau_i = S_i^T \boldsymbol F_i.$$
#
# $X_j^T$, because $X_j$ leads outward and equal power turns its transpose inward (49.4). From the tip inward:
# %% [markdown] lang="zh"
# 刚体 $i$ 和它外侧各刚体所需的力都要经过关节 $i$。所以经过它的 wrench,等于刚体自身所需的,加上传给各子连杆的;其中沿关节轴的分量由电机提供:
#
# $$\boldsymbol F_i = \hat I_i \boldsymbol a_i + \boldsymbol V_i \times^* \hat I_i \boldsymbol V_i +
# \sum_{\lambda(j) = i} X_j^T \boldsymbol F_j, \qquad \boldsymbol\tau_i = S_i^T \boldsymbol F_i.$$
#
# 用 $X_j^T$,是因为 $X_j$ 从父到子,而由功率相等可知,它的转置从子到父(49.4)。从末端向内:
# %%
F, torques = B.copy(), np.zeros(2)
for i in (2, 1):
    torques[i - 1] = (S[i].T @ F[i]).item()
    F[i - 1] += X[i].T @ F[i]
print(F, torques, sep="\n")
# %% thumbnail="yes"
figure, axes = plt.subplots(1, 2, figsize=(9, 4.2), layout="constrained")
for ax, title in zip(axes, ("outward: what moves", "inward: what is passed on")):
    plot.side_view(arm, bend, com=False, ax=ax).set(title=title, xlim=(-0.8, 1.3), ylim=(-1.4, 0.9))
placement = tw.forward_kinematics(arm, bend).placement
for k in (1, 2):
    T = placement[k]
    at, (v_x, _, v_z), (f_x, _, f_z) = T.translation[[0, 2]], T.rotation @ V[k, 3:], T.rotation @ F[k, 3:]
    twist_text = f"V{k}: ω {V[k, 1]:.0f} rad/s, v {np.hypot(v_x, v_z):.0f} m/s"
    draw_arrow(axes[0], at, (0.4 * v_x, 0.4 * v_z), twist_text, plot.COLOURS["blue"], shift=(-25, 10))
    wrench_text = f"F{k}: {F[k, 1]:.1f} N m, {np.hypot(f_x, f_z):.1f} N"
    draw_arrow(axes[1], at, (0.025 * f_x, 0.025 * f_z), wrench_text, plot.COLOURS["vermilion"], shift=(8, 0))
plt.show()
assert np.allclose(V, [[0, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 3, 0, 0, 0, 1]], atol=1e-15)
assert np.allclose(A[2], [0, 0, 0, 9.81 - 2, 0, 0], atol=1e-14)
assert np.allclose(torques, tw.rnea(arm, bend, qd, qdd), rtol=1e-12)
assert np.isclose(B[1, 5], 9.81 + 0.5)
w, out = 2.0, 3.0  # a slider at 0.5 m on a turntable: rad/s, and m/s outward along x
V_slider, S_slider = np.array([0, 0, w, out, 0.5 * w, 0]), np.eye(6)[3]
half = tw.cross_motion(V_slider) @ S_slider * out
assert np.allclose(half[3:], [0, w * out, 0])  # the acceleration of the slider has 2 ω v across:
assert np.allclose(half[3:] + np.cross(V_slider[:3], V_slider[3:]), [-(w**2) * 0.5, 2 * w * out, 0])


# %% [markdown] lang="en"
# Row 0 of `F` is what the wall bears. That is RNEA. For any tree, loop over all bodies: `tree.outward` counts up, since
# parents have smaller numbers, and `v_slice` finds the entries of joint $i$ (one for a hinge, six for a free base).
# %% [markdown] lang="zh"
# `F` 的第 0 行是墙所承受的。这就是 RNEA。对任意的树,只要对全部刚体循环:父连杆的编号总比子连杆小,所以 `tree.outward` 从小到大数;
# `v_slice` 给出关节 $i$ 在向量里的位置(旋转关节一个数,自由的基座六个数)。
# %%
def forces_of_motion(model, q, v, a):
    tree, at, tau = tree_terms(model, q), model.v_slice, np.zeros(model.nv)
    V, A, F = np.zeros((3, model.nbodies, 6))
    A[0, 3:] = -model.gravity
    for i in tree.outward:
        p, vJ, aJ = tree.parent[i], tree.S[i] @ v[at[i]], tree.S[i] @ a[at[i]]
        V[i] = tree.X[i] @ V[p] + vJ
        A[i] = tree.X[i] @ A[p] + aJ + tw.cross_motion(V[i]) @ vJ
        F[i] = tree.I[i] @ A[i] + tw.cross_force(V[i]) @ tree.I[i] @ V[i]
    for i in tree.inward:
        tau[at[i]] = tree.S[i].T @ F[i]
        F[tree.parent[i]] += tree.X[i].T @ F[i]
    return tau


# %% [markdown] lang="en"
# Try it on Go2, in a moment of a trot: the base walks at 0.8 m/s, turns left and speeds up, two legs swing, two go back.
# (`v` and `a` are in the folded cell at the top.)
# %% [markdown] lang="zh"
# 用 Go2 试一试,取小跑中的一瞬:基座以 0.8 m/s 前行,向左转,并在加速;两条腿向前摆,两条腿向后蹬。(`v`、`a` 在最上面折叠的单元格里。)
# %%
tau = tw.rnea(model, q, v, a)
difference = np.abs(forces_of_motion(model, q, v, a) - tau).max()
print(f"the function above against tw.rnea: {difference:.0e} of {np.abs(tau).max():.0f} N")
assert difference < 1e-12 * np.abs(tau).max()
# %% [markdown] lang="en"
# ### Fixed and floating
#
# The arm is bolted to a wall, Go2 to nothing. The lines are the same; the question is who supplies the last wrench. For the arm it
# is row 0 of `F`: the wall supplies it, and it is no part of the answer. For Go2 it is the wrench through joint 1, the free
# joint between the world and the base. That joint has six axes and no motor, so $S_1^T\boldsymbol F_1$ is all of
# $\boldsymbol F_1$: the first six numbers of the answer, which somebody outside must supply.
# %% [markdown] lang="zh"
# ### 固定基座与浮动基座
#
# 手臂固定在墙上,Go2 没有固定在任何东西上。代码一样,不同的只是最后那个 wrench 由谁提供。对手臂,它是 `F` 的第 0 行,由墙提供,不在答案里。
# 对 Go2,它经过关节 1,即世界与基座之间的自由关节。这个关节有六个轴、没有电机,所以 $S_1^T\boldsymbol F_1$ 就是整个
# $\boldsymbol F_1$:答案的前六个数,要由外界提供。
# %%
print(len(torques), "numbers for the arm,", len(tau), "for Go2")
print("base: moment", tau[:3], "N m, force", tau[3:6], "N")
# %% [markdown] lang="en"
# So it stands in the package, with external wrenches, rotors, and vectors as columns, for batches and any number type. On
# the site, with its numbers: [RNEA, line by line](../algorithms/rnea.md).
# %% [markdown] lang="zh"
# 程序包里就是这样写的,另外加上外力和转子惯量;向量写成列,所以批量的状态和任何数值类型都用同样的几行代码。
# 网站上有一页可以带着数值读:[逐行读 RNEA](../algorithms/rnea.md)。
# %%
print(inspect.getsource(newton_euler))
# %%
tw.ask("49.6-cost", ...)


# %% [markdown] lang="en"
# The picture shows what is passed along the tree of Go2: each label is the quantity that passes through that joint, and the
# width of the arrow is its size. On the site it moves: [RNEA as a film](../hands/film.md).
# %% [markdown] lang="zh"
# 下图是沿 Go2 的运动树传递的量:标注是经过该关节的量,箭头的粗细表示大小。网站上有会动的版本:[RNEA 动画](../hands/film.md)。
# %%
terms, kin = tw.rnea_terms(model, q, v, a), tw.forward_kinematics(model, q, v, a)
V, A, F, own = (np.array(rows) for rows in (terms.V, terms.A, terms.F, terms.B))


# %%
def sizes(vectors, angular, linear):
    """Lengths of both halves, for the labels; nothing for the world."""
    top, bottom = np.linalg.norm(vectors[:, :3], axis=1), np.linalg.norm(vectors[:, 3:], axis=1)
    return [""] + [f"{x:.1f} {angular}\n{y:.1f} {linear}" for x, y in zip(top[1:], bottom[1:])]


figure, axes = plt.subplots(3, 1, figsize=(10, 9.5), layout="constrained")
blue, green, red = (plot.COLOURS[name] for name in ("blue", "green", "vermilion"))
lengths = np.linalg.norm(np.stack([V, A, F])[..., 3:], axis=-1)
passes = [
    ("outward: twists |ω|, |v|", sizes(V, "rad/s", "m/s"), blue, False),
    ("outward: accelerations |α|, |a|; the world rises with 9.8 m/s²", sizes(A, "rad/s²", "m/s²"), green, False),
    ("inward: wrenches |τ|, |f|", sizes(F, "N m", "N"), red, True),
]
for ax, amounts, (title, texts, colour, inward) in zip(axes, lengths, passes):
    plot.flow(model, texts, inward=inward, amounts=amounts, colour=colour, ax=ax)
    ax.set_title(title, loc="left", fontsize=11)
plt.show()
assert np.allclose(F[0, 3:], kin.placement[1].rotation @ F[1, 3:])  # the ground, or you, must hold the last of it
# %% [markdown] lang="en"
# A check without any frames: the power of all $\boldsymbol\tau$ must be the rate of the energy, kinetic and potential.
# The energy a little later, less the energy a little before:
# %% [markdown] lang="zh"
# 再做一个完全不涉及坐标系的独立检查:全部 $\boldsymbol\tau$ 的功率应当等于能量(动能加势能)的变化率。
# 稍后的能量减去稍前的能量:
# %%
dt, energy = 1e-5, []
for t in (-dt, dt):
    q_t, v_t = model.integrate(q, t * v), v + t * a
    energy.append(tw.kinetic_energy(model, q_t, v_t) + tw.potential_energy(model, q_t))
rate = (energy[1] - energy[0]) / (2 * dt)
print(f"power {tau @ v:.3f} W, rate of the energy {rate:.3f} W")
assert np.isclose(tau @ v, rate, rtol=1e-7)


# %% [markdown] lang="en"
# ## Gravity: a rising world, or thirteen weights
#
# RNEA never mentions the weight of a link. It only lets the world rise. Is that the same?
# %% [markdown] lang="zh"
# ## 重力:向上加速的世界,或十三份重量
#
# RNEA 里从头到尾没有出现连杆的重量,只是让世界向上加速。两者一样吗?
# %% [markdown] lang="en"
# **Exercise 49.6.2.** First in numbers: write the thirteen weights as wrenches, to be given to a robot without gravity as `f_ext`. Then the
# proof, in words, in your folder. What is folded below is the answer.
# %% [markdown] lang="zh"
# **练习 49.6.2。** 先用数值检验:把十三份重量写成 wrench,作为 `f_ext` 交给没有重力的机器人。再用文字证明,写在你的文件夹里。下面折叠的就是答案。
# %%
def weight_wrenches(model, q):
    """Return the weight of each body as a wrench in the body's own frame."""
    return ...


tw.exercises.check("49.6.2", weight_wrenches)
# %% [markdown] lang="en" after="49.6.2"
# Each body needs $\hat I_i (\boldsymbol a_i - \boldsymbol g_i)$ where $\boldsymbol g_i$ is gravity, seen from body $i$
# as a spatial acceleration $(0, R_i^T \boldsymbol g)$. But $\hat I_i (0, R_i^T \boldsymbol g)$ *is* the weight: the force
# $m R_i^T \boldsymbol g$ with the moment $\boldsymbol c \times m R_i^T \boldsymbol g$. So it is the same whether you
# take the weight of each body as an external wrench, or subtract $\boldsymbol g_i$ from each acceleration. And since the
# recursion hands an acceleration of the world to every body, one line does for all. Here are the thirteen weights, with
# gravity switched off:
# %% [markdown] lang="zh" after="49.6.2"
# 每个刚体需要 $\hat I_i (\boldsymbol a_i - \boldsymbol g_i)$,其中 $\boldsymbol g_i$ 是从刚体 $i$ 看的重力,写成空间加速度
# $(0, R_i^T \boldsymbol g)$。而 $\hat I_i (0, R_i^T \boldsymbol g)$ *就是*重力:力 $m R_i^T \boldsymbol g$,带着力矩
# $\boldsymbol c \times m R_i^T \boldsymbol g$。所以把每个刚体的重力当作外力,或从每个加速度里减去 $\boldsymbol g_i$,
# 结果一样。又因为递推会把世界的加速度传给每个刚体,写一行就够了。下面关掉重力,把十三份重量当作外力加上去:
# %%
weightless = dataclasses.replace(model, gravity=np.zeros(3))
# %% after="49.6.2"
weights = np.zeros((model.nbodies, 6))
for i in range(1, model.nbodies):
    force = model.inertia[i].mass * kin.placement[i].rotation.T @ model.gravity
    weights[i] = [*np.cross(model.inertia[i].com, force), *force]
    assert np.allclose(
        weights[i], model.inertia[i].matrix() @ [0, 0, 0, *(kin.placement[i].rotation.T @ model.gravity)], atol=1e-12
    )

assert not np.allclose(tw.rnea(weightless, q, v, a), tau)
assert np.allclose(tw.rnea(weightless, q, v, a, f_ext=weights), tau, rtol=1e-12, atol=1e-12)


# %% [markdown] lang="en"
# ## At rest
#
# With $v = a = 0$, only the forces that hold the robot up remain. The first six numbers are the wrench on the base; in the
# air, somebody must supply it. The chapter expects $(0, 0, 0, 0, 0, -mg)$. Run it. Do you agree?
# %% [markdown] lang="zh"
# ## 静止时
#
# 当 $v = a = 0$,剩下的就是撑住机器人的力。前六个数是基座的 wrench;如果悬在空中,就得有人提供它。本章预期结果是
# $(0, 0, 0, 0, 0, -mg)$。运行一下,你同意吗?
# %% [markdown] lang="en"
# **Exercise 49.6.3.** Predict the wrench from masses and centre of mass alone, for any posture and any tilt of the base.
# %% [markdown] lang="zh"
# **练习 49.6.3。** 只用质量和质心预测这个 wrench,位形任意,基座可任意倾斜。
# %%
def base_wrench_at_rest(model, q):
    """Return the wrench on the base that holds a robot at rest, from mass and centre of mass."""
    return ...


tw.exercises.check("49.6.3", base_wrench_at_rest)
# %% after="49.6.3"
rest = np.zeros(model.nv)
base_wrench = tw.rnea(model, q, rest, rest)[:6]
up = -model.mass * model.gravity
c = kin.placement[1].inverse().act(tw.center_of_mass(model, q))  # base and world are aligned here
assert np.allclose(base_wrench, [*np.cross(c, up), *up])
print("base: moment", base_wrench[:3].round(3) + 0.0, "N m, force", base_wrench[3:].round(2) + 0.0, "N")
# %% [markdown] lang="en" after="49.6.3"
# Somebody must hold the whole weight *upwards*, with the force $-m\boldsymbol g$, and, since the centre of mass is not at
# the origin of the base, apply the moment of that force at $\boldsymbol c$ as well:
# $\boldsymbol c \times (-m\boldsymbol g)$, the opposite of the moment of the weight. The chapter has the sign of the
# weight, and no moment.
# %% [markdown] lang="zh" after="49.6.3"
# 得有人用 $-m\boldsymbol g$ *向上*托住全部重量;而质心不在基座原点,所以还要有这个力在 $\boldsymbol c$ 处的力矩
# $\boldsymbol c \times (-m\boldsymbol g)$,它与重力的力矩正好相反。本章写的是重力本身的符号,也没有力矩。
# %%
tw.ask("49.6-hip", ...)
# %% [markdown] lang="en"
# If the robot stands, the floor does that, and every wrench in the legs turns round. Left: held by the base, each joint
# carries what hangs below it. Right: standing, each joint carries what is above it.
# %% [markdown] lang="zh"
# 如果机器人站着,托住它的是地面,腿中各关节传递的竖直力全都反向。左:托住基座,每个关节承担挂在它下面的部分。
# 右:站立,每个关节承担在它上面的部分。
# %%
ground = np.zeros((model.nbodies, 6))
for name, force in zip(model.feet, tw.static_equilibrium(model, q).forces):
    body = model.frames[name].body
    at_foot = tw.SE3(np.eye(3), tw.frame_placement(model, q, name).translation)
    ground[body] = (kin.placement[body].inverse() @ at_foot).force_transform() @ [0, 0, 0, *force]

sticks, red = plot.sticks(model, q), plot.COLOURS["vermilion"]
figure, axes = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained", sharey=True)
for ax, (title, f_ext) in zip(axes, {"held by the base": None, "standing": ground}.items()):
    through = tw.joint_wrenches(model, q, 0 * v, 0 * a, f_ext)
    lift = np.array([T.rotation @ f for T, f in zip(kin.placement, through[:, 3:])])[:, 2]
    assert np.isclose(abs(lift[1]), 9.81 * model.mass if f_ext is None else 0)
    for stick in sticks[sticks[:, 1, 0] > 0]:  # the front legs, seen from behind
        ax.plot(*stick[:, 1:].T, color=plot.COLOURS["grey"], linewidth=3)
    for i in range(2, 8):
        assert (lift[i] > 0) == (f_ext is None)
        _, y, z = kin.placement[i].translation
        ax.annotate("", (y, z + 0.0015 * lift[i]), (y, z), arrowprops={"arrowstyle": "-|>", "color": red, "lw": 2})
        ax.plot(y, z, "k.")
        ax.annotate(f"{lift[i]:.1f} N", (y, z), (6, 6), textcoords="offset points", fontsize=9, color=red)
    ax.set(xlabel="y [m]", title=title, aspect="equal", xlim=(0.2, -0.24), ylim=(-0.02, 0.34))
axes[0].set_ylabel("z [m]")
plt.show()
# %% [markdown] lang="en"
# ## h, g, C and M from one function
#
# The equation of motion is $M(q)\,\dot v + h(q, v) = \tau$ with $h = C(q, v)\,v + g(q)$, and RNEA *is* its left side. So
# all of its parts are in it.
# %% [markdown] lang="zh"
# ## 从一个函数得到 h、g、C、M
#
# 运动方程是 $M(q)\,\dot v + h(q, v) = \tau$,其中 $h = C(q, v)\,v + g(q)$,而 RNEA *就是*它的左边。所以各部分都包含在里面。
# %%
tw.ask("49.6-double", ...)


# %% [markdown] lang="en"
# **Exercise 49.6.1.** Take $M$ out of `rnea`, without `crba`.
# %% [markdown] lang="zh"
# **练习 49.6.1。** 不用 `crba`,把 $M$ 从 `rnea` 中取出来。
# %%
def mass_matrix_by_rnea(model, q):
    """Return the mass matrix, found with RNEA alone."""
    return ...


tw.exercises.check("49.6.1", mass_matrix_by_rnea)
# %% [markdown] lang="en" after="49.6.1"
# If some arguments are zero, it returns the parts one by one: $g$ at rest, $h$ without acceleration, column $k$ of $M$
# with a unit acceleration, no velocity and no gravity. It never builds $M$; that is why it is O(N): three products with
# $X$ for each body, whatever the number of bodies.
# %% [markdown] lang="zh" after="49.6.1"
# 把某些参数取为零,就能逐个得到各部分:静止时是 $g$,没有加速度时是 $h$;单位加速度、零速度、零重力时,是 $M$ 的第 $k$ 列。它从不构造 $M$,
# 所以是 O(N):每个刚体三次与 $X$ 相乘,刚体再多也是如此。
# %% after="49.6.1"
rest = np.zeros(model.nv)
g, h_qv = tw.rnea(model, q, rest, rest), tw.rnea(model, q, v, rest)
assert np.allclose(g, tw.gravity(model, q))
assert np.allclose(h_qv, tw.nonlinear_effects(model, q, v))
Cv = h_qv - g
assert np.allclose(tw.coriolis_matrix(model, q, v) @ v, Cv, atol=1e-12)
assert np.allclose(tw.rnea(model, q, 2 * v, rest) - g, 4 * Cv)  # Coriolis forces grow with the square of the speed

M = tw.rnea(weightless, q, rest, np.eye(model.nv)).T  # all columns in one batch
assert np.allclose(M, tw.crba(model, q), atol=1e-12)
assert np.allclose(tau, M @ a + Cv + g, rtol=1e-12, atol=1e-12)


# %% [markdown] lang="en"
# ## The pseudocode, run
#
# Lay the chapter's pseudocode beside the lines above. It differs in three places:
#
# 1. `F[i] = I a + V ×* I V` stands in the loop inward; above, it stands in the loop outward.
# 2. Inward it passes on `X[i]^* * F[i]`, with the `X[i]` that leads from parent to child; above, it is $X_i^T$.
# 3. Its loops run from link 1, and link 0 is the base; above, they begin with the base.
#
# What does each of them spoil? Take the first.
# %% [markdown] lang="zh"
# ## 把伪代码运行一遍
#
# 把本章的伪代码和上面的代码并排放在一起,有三处不同:
#
# 1. `F[i] = I a + V ×* I V` 写在反向循环里;上面是写在正向循环里的。
# 2. 它用 `X[i]^* * F[i]` 往回传,而 `X[i]` 是从父到子的;上面用的是 $X_i^T$。
# 3. 循环从连杆 1 开始,而基座是连杆 0;上面是从基座开始的。
#
# 每一处各弄错了什么?先看第一处。
# %%
tw.ask("49.6-overwritten", ...)
# %% [markdown] lang="en"
# Now all three, run on Go2. Colour marks what is wrong; the white squares are right. Which tests would have passed?
# %% [markdown] lang="zh"
# 把三处错误都在 Go2 上运行一遍。有颜色的地方是错的,白色的是对的。哪些检查会通过?
# %%
as_printed = {  # in the listing, what stands there and what is printed
    "1. overwritten": ("tau[i] = S", "F[i] = B[i]; tau[i] = S"),
    "2. X* for Xᵀ": ("X[i].mT @ F[i]", "np.linalg.inv(X[i]).mT @ F[i]"),
    "3. no base": ("for i in tree.inward", "F[1] = 0 * F[1]\n    for i in tree.inward"),
}
arguments = tree_terms(model, q), columns(model, v), columns(model, a), wrenches(np.zeros((model.nbodies, 6)))
assert np.array_equal(newton_euler(*arguments).tau, tau)
printed = np.array([faulty(newton_euler, change)(*arguments).tau for change in as_printed.values()])
errors = printed - tau

names = ["τx", "τy", "τz", "fx", "fy", "fz"]
names += [name.removesuffix("_joint").replace("_", "\n") for name in model.joint_names[2:]]
ax = plot.axes_2d(size=(12.5, 2.8))
plot.matrix(errors, "error of rnea, N m and N", rows=list(as_printed), columns=names, lines=[], numbers=".2g", ax=ax)
ax.axvline(5.5, color="k", linewidth=1)
plt.show()

calves, others = [8, 11, 14, 17], [6, 7, 9, 10, 12, 13, 15, 16]
assert (errors[:, calves] == 0).all()
assert (errors[:2, others] != 0).all()
assert np.allclose(printed[0][:6], own[1])  # the base by itself: all legs are lost
assert np.allclose(printed[2][:6], tau[:6] - own[1])  # the other way round
assert (errors[2, 6:] == 0).all()
# %% [markdown] lang="en"
# The calves, with no children, come out right every time. Row 1: when the loop inward reaches a link, its children have
# added theirs to `F[i]`, and the assignment throws that away; the base keeps only its own. Row 2: $X^* = X^{-T}$ goes the
# way of $X$, outward; inward goes $X^T$. Row 3: no line adds the base's own wrench; the joints are all right.
#
# ## Pinocchio agrees
#
# Not only the torques: after its `rnea`, `data.f` holds the wrenches through the joints and `data.a_gf` the accelerations
# of a rising world. (`data.a` is for `forwardKinematics` to fill: after `rnea` do not read it.)
# %% [markdown] lang="zh"
# 小腿没有子连杆,每次都对。第 1 行:反向循环走到一个连杆时,子连杆已经把自己的加到 `F[i]` 上了,一赋值就全丢了,基座只剩自己的。
# 第 2 行:$X^* = X^{-T}$ 与 $X$ 同向,向外;向内的是 $X^T$。第 3 行:没有一行加上基座自己的 wrench;各关节都对。
#
# ## 与 Pinocchio 对照
#
# 不只是力矩:调用它的 `rnea` 之后,`data.f` 里是经过各关节的 wrench，`data.a_gf` 里是世界向上加速时的加速度。
# (`data.a` 由 `forwardKinematics` 填写,调用 `rnea` 之后不要读它。)
# %%
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    to_pin = tw.bridge.to_pinocchio_tangent
    theirs = tw.bridge.from_pinocchio_tangent(model, pin.rnea(pin_model, data, q, to_pin(model, v), to_pin(model, a)))
    scale = np.abs(tau).max()
    assert np.abs(theirs - tau).max() < 1e-12 * scale
    assert np.abs(tw.bridge.from_pinocchio_force(list(data.f)) - F)[1:].max() < 1e-12 * scale
    assert np.abs(tw.bridge.from_pinocchio_motion(list(data.a_gf)) - A)[1:].max() < 1e-12 * np.abs(A).max()
    print("torques, wrenches and accelerations: the same in both")
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.6.1** `rnea` against $M \ddot q + h$
# - **49.6.2** why gravity enters at the world, and why that is the same
# - **49.6.3** the base's wrench at rest
#
# `twistwrench exercises start my_answers` puts them into a folder; `python -m pytest` there checks your answers;
# `twistwrench exercises hint 49.6.2` helps. Next: notebook 49.7.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.6.1** `rnea` 与 $M \ddot q + h$ 比较
# - **49.6.2** 重力为什么从世界那里进入,为什么这样是等价的
# - **49.6.3** 静止时基座的 wrench
#
# `twistwrench exercises start my_answers --language zh` 把练习放进一个文件夹,在那里运行 `python -m pytest` 检查答案,
# `twistwrench exercises hint 49.6.2` 给提示。下一个:笔记本 49.7。

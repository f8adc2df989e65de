# %% [markdown] lang="en"
# # 49.6 RNEA: inverse dynamics
#
# Given a motion, which forces make it happen? The recursive Newton–Euler algorithm answers by passing through the tree twice:
# outward with the motion, inward with the forces. This notebook follows it step by step on Go2, draws what each step
# carries, and shows what gravity is in it. It ends with what the chapter's pseudocode gets wrong.
# %% [markdown] lang="zh"
# # 49.6 RNEA:逆动力学
#
# 给定运动,需要什么样的力?递归牛顿-欧拉算法沿运动树走两遍来回答:向外传递运动,向内传递力。这个笔记本在 Go2 上
# 一步一步走一遍,画出每一步带的是什么,说明重力在里面是什么,最后看看本章的伪代码错在哪里。
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

v, a = np.zeros((2, model.nv))
v[2], v[3], a[3] = 0.6, 0.8, 2.0  # the base turns left at 0.6 rad/s, walks at 0.8 m/s, and speeds up
for leg, sign in {"FL": 1, "FR": -0.4, "RL": -0.4, "RR": 1}.items():  # two legs swing, two go back
    thigh = model.v_slice[model.joint_id(f"{leg}_thigh_joint")].start
    v[thigh : thigh + 2] = sign * np.array([-5.0, 4.0])
    a[thigh : thigh + 2] = sign * np.array([30.0, 90.0])
# %% [markdown] lang="en"
# ## The tree
#
# The motion in this notebook is a moment of a trot: the base walks at 0.8 m/s, turns left at 0.6 rad/s and speeds up; two
# legs swing, two go back. (`q`, `v` and `a`, in the folded cell above.)
#
# Body 0 is the world, body 1 the base; every body $i$ hangs on its parent $\lambda(i)$ by joint $i$. To the recursion
# a joint is two things: the matrix $X_i$ that takes a twist from the parent's frame to frame $i$, and the subspace
# $S_i$ of the motions that the joint allows, 6 × 1 for a hinge and 6 × 6 for the base, which is free. `tree_terms`
# computes them. Since $\lambda(i) < i$, counting up is going outward.
# %% [markdown] lang="zh"
# ## 运动树
#
# 这个笔记本用的运动是小跑中的一瞬:基座以 0.8 m/s 前行,以 0.6 rad/s 左转,并在加速;两条腿向前摆,两条腿向后蹬。
# (即上面折叠的单元格里的 `q`、`v`、`a`。)
#
# 刚体 0 是世界,刚体 1 是基座;每个刚体 $i$ 由关节 $i$ 挂在父连杆 $\lambda(i)$ 上。对递推来说,一个关节就是两样东西:
# 把 twist 从父坐标系换到坐标系 $i$ 的矩阵 $X_i$,以及关节所允许的运动的子空间 $S_i$,旋转关节是 6 × 1,自由的基座是
# 6 × 6。`tree_terms` 负责算出它们。因为 $\lambda(i) < i$,编号从小到大就是由内向外。
# %%
tree = tree_terms(model, q)
parent, S, I, X = tree.parent, tree.S, tree.I, tree.X
print("body            parent          S")
for i in range(1, 5):
    print(f"{model.joint_names[i]:15} {model.joint_names[parent[i]]:15} {S[i].shape}")
assert all(parent[i] < i for i in range(1, model.nbodies))
assert [s.shape[1] for s in S[1:]] == [6] + 12 * [1]
# %% [markdown] lang="en"
# ## Outward: twists and accelerations
#
# A body moves as its parent does, seen from its own frame, and its joint adds to that:
#
# $$\boldsymbol V_i = X_i \boldsymbol V_{\lambda(i)} + S_i \dot q_i.$$
#
# Differentiate this, and use the rate of $X$ (49.5). The motion of the frames adds one cross product:
#
# $$\boldsymbol a_i = X_i \boldsymbol a_{\lambda(i)} + S_i \ddot q_i + \boldsymbol V_i \times S_i \dot q_i.$$
#
# The axis $S_i$ is fixed in body $i$ and moves with it; $\boldsymbol V_i \times S_i$ is the rate at which it does. (If the
# numbers of $S_i$ depended on $q$, as in a base with Euler angles, $\dot S_i \dot q_i$ would be added. Every joint here
# has a constant $S_i$; Euler angles are three hinges in a row.)
#
# The start is the world: $\boldsymbol V_0 = 0$, and $\boldsymbol a_0 = (0, -\boldsymbol g)$: instead of pulling
# every body down, let the world rise. Why that is the same, we see below.
#
# `tw.rnea_terms` returns everything that the recursion computes on its way, a list entry for each body.
# %% [markdown] lang="zh"
# ## 向外:twist 与加速度
#
# 刚体随父连杆一起运动(换到自己的坐标系里看),再加上关节自身的运动:
#
# $$\boldsymbol V_i = X_i \boldsymbol V_{\lambda(i)} + S_i \dot q_i.$$
#
# 求导,并用上 $X$ 的变化规律(49.5)。坐标系的运动留下的只有一个叉积:
#
# $$\boldsymbol a_i = X_i \boldsymbol a_{\lambda(i)} + S_i \ddot q_i + \boldsymbol V_i \times S_i \dot q_i.$$
#
# 关节轴 $S_i$ 固定在刚体 $i$ 上,随它一起运动,$\boldsymbol V_i \times S_i$ 就是它的变化率。(若 $S_i$ 的各个数随 $q$ 变化,例如用欧拉角表示的基座,
# 还要加上 $\dot S_i \dot q_i$。这里每种关节的 $S_i$ 都是常数,欧拉角写成三个依次相连的旋转关节。)
#
# 起点是世界:$\boldsymbol V_0 = 0$,而 $\boldsymbol a_0 = (0, -\boldsymbol g)$:不是把每个刚体往下拉,而是让世界向上加速。
# 为什么两者一样,下面会看到。
#
# `tw.rnea_terms` 返回递推途中算出的所有量,每个刚体一项。
# %%
tw.ask("49.6-slider", ...)
# %%
terms = tw.rnea_terms(model, q, v, a)
V, A = np.array(terms.V), np.array(terms.A)
i, at = 3, model.v_slice[3]  # one of its lines, by hand: the left front thigh
assert np.allclose(V[i], X[i] @ V[parent[i]] + S[i] @ v[at], atol=1e-14)
S_rate = tw.cross_motion(V[i]) @ S[i]  # the axis moves with its body
assert np.allclose(A[i], X[i] @ A[parent[i]] + S[i] @ a[at] + S_rate @ v[at], atol=1e-13)
assert np.allclose(A[0], [0, 0, 0, *-model.gravity])  # the world rises

kin = tw.forward_kinematics(model, q, v, a)
assert np.allclose(V, kin.twist, atol=1e-12)
risen = [T.inverse().motion_transform() @ A[0] for T in kin.placement]  # the part of A that is the world's
assert np.allclose(A - risen, kin.acceleration, atol=1e-12)

h = 1e-100  # and is it the rate of V? The complex step confirms it:
moving = tw.forward_kinematics(model, model.integrate(q, 1j * h * v), v + 1j * h * a).twist
assert np.allclose(moving.imag / h, kin.acceleration, atol=1e-12)

w, out = 2.0, 3.0  # a slider at 0.5 m on a turntable: rad/s, and m/s outward along x
V_slider, S_slider = np.array([0, 0, w, out, 0.5 * w, 0]), np.eye(6)[3]
half = tw.cross_motion(V_slider) @ S_slider * out
assert np.allclose(half[3:], [0, w * out, 0])  # the acceleration of the slider has 2 ω v across:
assert np.allclose(half[3:] + np.cross(V_slider[:3], V_slider[3:]), [-(w**2) * 0.5, 2 * w * out, 0])
# %% [markdown] lang="en"
# ## Inward: wrenches
#
# The Newton–Euler equation gives the wrench that each body needs for its motion. The chapter then adds "the reactions that
# all children pass on".
# %% [markdown] lang="zh"
# ## 向内:wrench
#
# 牛顿-欧拉方程给出每个刚体的运动所需的 wrench。本章接着“加上所有子连杆传递过来的反作用力”。
# %%
tw.ask("49.6-child", ...)
# %% [markdown] lang="en"
# This wrench is transmitted by joints:
# joint $i$ supplies body $i$ and all its children. So the wrench through joint $i$ is what the body itself needs plus
# what its children need:
#
# $$\boldsymbol F_i = \hat I_i \boldsymbol a_i + \boldsymbol V_i \times^* \hat I_i \boldsymbol V_i +
# \sum_{\lambda(j) = i} X_j^T \boldsymbol F_j, \qquad \boldsymbol\tau_i = S_i^T \boldsymbol F_i.$$
#
# $X_j^T$, because $X_j$ leads outward and equal power turns its transpose inward (49.4). A hinge transmits five of the
# six components of $\boldsymbol F_i$ by itself; only the component along $S_i$ is supplied by the motor.
# %% [markdown] lang="zh"
# 这个 wrench 由关节传递:关节 $i$ 供给刚体 $i$ 和它的所有子连杆。
# 所以经过关节 $i$ 的 wrench,等于刚体自身所需的,加上子连杆所需的:
#
# $$\boldsymbol F_i = \hat I_i \boldsymbol a_i + \boldsymbol V_i \times^* \hat I_i \boldsymbol V_i +
# \sum_{\lambda(j) = i} X_j^T \boldsymbol F_j, \qquad \boldsymbol\tau_i = S_i^T \boldsymbol F_i.$$
#
# 用 $X_j^T$,是因为 $X_j$ 向外,而功率相等使它的转置向内(49.4)。$\boldsymbol F_i$ 的六个数里,旋转关节自己就承受了五个,
# 只有沿 $S_i$ 的那一个由电机提供。
# %%
own, F, tau = np.array(terms.B), np.array(terms.F), terms.tau
i = 3
assert np.allclose(own[i], I[i] @ A[i] + tw.cross_force(V[i]) @ I[i] @ V[i], rtol=1e-12, atol=1e-12)  # Newton and Euler
children = [j for j in tree.outward if parent[j] == i]
assert np.allclose(F[i], own[i] + sum(X[j].T @ F[j] for j in children), rtol=1e-12, atol=1e-12)
assert np.allclose(tau[model.v_slice[i]], S[i].T @ F[i], rtol=1e-12)  # the motor's part
assert np.array_equal(tau, tw.rnea(model, q, v, a))


# %% [markdown] lang="en"
# That is RNEA: two passes. This is the whole of it, as it stands in the package. `tw.rnea` checks its arguments, runs
# this, and returns $\boldsymbol\tau$. Vectors are columns, so that batches and any number type go through the same lines.
# %% [markdown] lang="zh"
# 这就是 RNEA:两遍。下面是它在程序包里的全文。`tw.rnea` 检查参数,运行它,再返回 $\boldsymbol\tau$。向量写成列,
# 所以批量的状态和任何数值类型都用同样的几行代码。
# %%
print(inspect.getsource(newton_euler))
# %%
tw.ask("49.6-cost", ...)


# %% [markdown] lang="en"
# The picture shows what is passed along the tree: each label is the quantity that passes through that joint, and the
# width of the arrow is its size.
# %% [markdown] lang="zh"
# 下图是沿树传递的量:标注是经过该关节的量,箭头的粗细表示大小。
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
# An independent check without any frames: the power of all $\boldsymbol\tau$ is the rate of the energy, kinetic and
# potential.
# %% [markdown] lang="zh"
# 再做一个完全不涉及坐标系的独立检查:全部 $\boldsymbol\tau$ 的功率等于能量(动能加势能)的变化率。
# %%
q_on, v_on = model.integrate(q, 1j * h * v), v + 1j * h * a  # one instant later
energy = tw.kinetic_energy(model, q_on, v_on) + tw.potential_energy(model, q_on)
assert np.isclose(tau @ v, energy.imag / h, rtol=1e-12)
print(f"power {tau @ v:.2f} W")


# %% [markdown] lang="en"
# ## Gravity: a rising world, or thirteen weights
#
# RNEA never mentions the weight of a link. It only lets the world rise, $\boldsymbol a_0 = (0, -\boldsymbol g)$. Is that the
# same?
# %% [markdown] lang="zh"
# ## 重力:向上加速的世界,或十三份重量
#
# RNEA 从不提起连杆的重量,只是让世界向上加速,$\boldsymbol a_0 = (0, -\boldsymbol g)$。这样一样吗?
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
    assert np.allclose(weights[i], I[i] @ [0, 0, 0, *(kin.placement[i].rotation.T @ model.gravity)], atol=1e-12)

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
# Somebody must hold the whole weight *upwards* and, since the centre of mass is not at the origin of the base, apply a
# moment $\boldsymbol c \times m\boldsymbol g$ as well. The chapter has the sign of the weight, and no moment.
# %% [markdown] lang="zh" after="49.6.3"
# 得有人*向上*托住全部重量;而质心不在基座原点,所以还有力矩 $\boldsymbol c \times m\boldsymbol g$。本章写的是重力本身的符号,
# 也没有力矩。
# %%
tw.ask("49.6-hip", ...)
# %% [markdown] lang="en"
# If the robot stands, the floor does that, and every wrench in the legs turns round. Left: held by the base, each joint
# carries what hangs below it. Right: standing, each joint carries what is above it.
# %% [markdown] lang="zh"
# 如果机器人站着,这件事由地面来做,腿里的每个 wrench 都反过来。左:托住基座,每个关节承担挂在它下面的部分。
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
# If you run it exactly as the chapter prints it, three things go wrong:
#
# 1. The backward loop *sets* `F[i] = I a + V ×* I V`. By then the children have added theirs to `F[i]`; the assignment
#    throws that away.
# 2. It passes on `X[i]^* * F[i]` with `X[i]` from parent to child. But $X^* = X^{-T}$ goes the same way as $X$: outward.
#    Inward goes $X^T$.
# 3. Its loops begin at link 1, after the base: no line adds the base's own wrench.
#
# Take the first of them.
# %% [markdown] lang="zh"
# ## 把伪代码运行一遍
#
# 完全照本章的伪代码运行,有三处错误:
#
# 1. 反向循环里是*赋值* `F[i] = I a + V ×* I V`。这时子连杆已经把自己的加到 `F[i]` 上了,一赋值就全丢了。
# 2. 它用 `X[i]^* * F[i]` 往回传,而 `X[i]` 是从父到子。可是 $X^* = X^{-T}$ 与 $X$ 同向:向外。向内的是 $X^T$。
# 3. 循环从基座之后的连杆 1 开始:没有一行加上基座自己的 wrench。
#
# 先看第一处。
# %%
tw.ask("49.6-overwritten", ...)
# %% [markdown] lang="en"
# Colour marks what is wrong. The calves, with no children, come out right every time.
# %% [markdown] lang="zh"
# 有颜色的地方就是错的。小腿没有子连杆,每次都对。
# %%
as_printed = {  # in the listing, what stands there and what is printed
    "1. overwritten": ("tau[i] = S", "F[i] = B[i]; tau[i] = S"),
    "2. X* for Xᵀ": ("X[i].mT @ F[i]", "np.linalg.inv(X[i]).mT @ F[i]"),
    "3. no base": ("for i in tree.inward", "F[1] = 0 * F[1]\n    for i in tree.inward"),
}
arguments = tree, columns(model, v), columns(model, a), wrenches(np.zeros((model.nbodies, 6)))
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
# ## Pinocchio agrees
#
# Not only the torques: after its `rnea`, `data.f` holds the wrenches through the joints and `data.a_gf` the accelerations
# of a rising world. (`data.a` is for `forwardKinematics` to fill: after `rnea` do not read it.)
# %% [markdown] lang="zh"
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

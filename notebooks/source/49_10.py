# %% [markdown] lang="en"
# # 49.10 Centroidal momentum and CCRBA
#
# Whatever a robot does with its legs, the world notices six numbers: the momentum of the whole,
# $h_G = (k_G, l_G)$, angular and linear, at the centre of mass $G$. This notebook computes it, lets Go2 walk, trot and
# bound, and looks at what the simple models of chapter 51 leave out.
# %% [markdown] lang="zh"
# # 49.10 质心动量与 CCRBA
#
# 不管机器人的腿怎么动,外界能察觉的只有六个数:整体在质心 $G$ 处的动量 $h_G = (k_G, l_G)$,前一半是角动量,后一半是线动量。
# 这个笔记本先把它算出来,再让 Go2 慢走、小跑(trot)、跳跑(bound),看看第 51 章的简化模型各自略去了什么。
# %%
import twistwrench as tw

model = tw.load("go2")
# %% setup="yes"
import inspect

import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot
from twistwrench.algorithms.centroidal import centroidal_composite
from twistwrench.exercises.questions.gaits import GAITS, acceleration, move

try:
    import pinocchio as pin
except ImportError:
    pin = None
    print("Pinocchio is not installed (pip install pin): the comparisons below are skipped")

rng = np.random.default_rng(10)
q, v, a = model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv))
weight = model.mass * 9.81
tiny = 1e-100  # step of complex-step derivatives (49.2)
# %% [markdown] lang="en"
# ## The momentum of the whole
#
# Each body has the momentum $I_i V_i$ in its own frame. It is a force-like vector: $X^*$ takes it to $G$, and there
# momenta add:
#
# $$h_G = \sum_i {}^G\!X_i^*\, I_i V_i = \begin{pmatrix} k_G \\ l_G \end{pmatrix}.$$
# %% [markdown] lang="zh"
# ## 整体的动量
#
# 每个刚体在自己的坐标系里有动量 $I_i V_i$。动量与力同类:用 $X^*$ 换到 $G$ 处,就可以相加:
#
# $$h_G = \sum_i {}^G\!X_i^*\, I_i V_i = \begin{pmatrix} k_G \\ l_G \end{pmatrix}.$$
# %%
motion = tw.forward_kinematics(model, q, v)
p_G = tw.center_of_mass(model, q)
to_G = [tw.force_transform(T.rotation, T.translation - p_G) for T in motion.placement]
bodies = range(1, model.nbodies)

h_G = sum(to_G[i] @ model.inertia[i].momentum(motion.twist[i]) for i in bodies)
print("k_G", h_G[:3].round(4), "kg m²/s   l_G", h_G[3:].round(3), "kg m/s")
assert np.allclose(h_G, tw.centroidal_momentum(model, q, v), rtol=1e-12)
# %% [markdown] lang="en"
# Here it is on a running Go2, from the side. Blue: the linear momentum of each body at its own centre of mass, drawn three
# times as long. At $G$: their sum $l_G$; and $k_G$, the turning of all of them about $G$.
# %% [markdown] lang="zh"
# 画在奔跑的 Go2 上,从侧面看。蓝色:每个刚体在自己质心处的线动量,画成三倍长。在 $G$ 处:它们的和 $l_G$,以及 $k_G$,即所有刚体绕 $G$ 的转动。
# %%
run_q, run_v = move(0.09, [*GAITS.values()][-1])
run = tw.forward_kinematics(model, run_q, run_v)
h_run, G = tw.centroidal_momentum(model, run_q, run_v), tw.center_of_mass(model, run_q)
# %%
figure, ax = plt.subplots(figsize=(8, 4.2), layout="constrained")
plot.side_view(model, run_q, ax=ax)
side = [0, 2]
for T, body, twist in list(zip(run.placement, model.inertia, run.twist))[1:]:
    middle, momentum = T.act(body.com), T.rotation @ body.momentum(twist)[3:]
    tip = middle[side] + 3 * 0.02 * momentum[side]
    thin = {"arrowstyle": "-|>", "color": plot.COLOURS["blue"], "lw": 1.5, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", tip, middle[side], arrowprops=thin, zorder=5)
red, purple = plot.COLOURS["vermilion"], plot.COLOURS["purple"]
thick = {"arrowstyle": "-|>", "color": red, "lw": 3, "shrinkA": 0}
ax.annotate("", G[side] + 0.02 * h_run[[3, 5]], G[side], arrowprops=thick)
ax.annotate("l_G", G[side] + 0.02 * h_run[[3, 5]], (4, 4), textcoords="offset points", color=red, fontsize=12)
turn = np.linspace(2.4, -2.4, 60) * np.sign(h_run[1])  # against y: a positive k_y turns clockwise
circle = G[side] + 0.1 * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
ax.plot(*circle.T, color=purple, linewidth=3)
ax.set(xlim=(-0.35, 0.95), ylim=(0.05, 0.44))
ax.annotate("", circle[-1], circle[-4], arrowprops={"arrowstyle": "-|>", "color": purple, "lw": 3})
ax.annotate("k_G", circle[8], (-8, 6), textcoords="offset points", color=purple, fontsize=12)
plt.show()
parts = [T.rotation @ body.momentum(V)[3:] for T, body, V in zip(run.placement, model.inertia, run.twist)]
assert np.allclose(sum(parts[1:]), h_run[3:], rtol=1e-12)
# %% [markdown] lang="en"
# ## The matrix $A_G$, in two ways
#
# $h_G$ is linear in the velocity: $h_G = A_G\dot q$. With $V_i = J_i \dot q$ the sum above gives
# $A_G = \sum_i {}^G\!X_i^*\, I_i J_i$. (The chapter moves the inertia to $G$ and leaves $J_i$ in the frame of the body.
# That mixes two frames and is another matrix.) This touches every joint below every body. **CCRBA** needs each joint
# once: a unit velocity of joint $i$ moves its subtree as one rigid body, whose momentum is $I^C_i S_i$ (49.8), and
# column $i$ is that, seen from $G$. There is no climb to the base: $O(N)$.
# %% [markdown] lang="zh"
# ## 矩阵 $A_G$ 的两种算法
#
# $h_G$ 对速度是线性的:$h_G = A_G\dot q$。代入 $V_i = J_i \dot q$,上面的和就给出
# $A_G = \sum_i {}^G\!X_i^*\, I_i J_i$。(本章把惯量换到 $G$ 处,却让 $J_i$ 留在刚体自己的坐标系里:两个坐标系混用,得到的是另一个矩阵。)
# 这样算,每个刚体都要用到它内侧的所有关节。**CCRBA** 对每个关节只算一次:关节 $i$ 的单位速度让它的子树像一个刚体那样运动,
# 动量是 $I^C_i S_i$(49.8),从 $G$ 处看就是第 $i$ 列。不用爬到基座,所以是 $O(N)$。
# %%
A_G = tw.centroidal_map(model, q)
J = [None, *(tw.frame_jacobian(model, q, model.joint_names[i], "local") for i in bodies)]
assert np.allclose(sum(to_G[i] @ model.inertia[i].matrix() @ J[i] for i in bodies), A_G, rtol=1e-12, atol=1e-12)

in_G = [tw.SE3(T.rotation, T.translation - p_G) for T in motion.placement]
mixed = sum(model.inertia[i].transform(in_G[i]).matrix() @ J[i] for i in bodies)
print(f"the chapter's mixture is off by up to {np.abs(mixed - A_G).max():.1f}, of {np.abs(A_G).max():.1f}")
assert np.abs(mixed - A_G).max() > 1

terms = tw.centroidal_terms(model, q)
assert np.allclose(terms.X[1:], to_G[1:], atol=1e-12)
assert np.isclose(terms.IC[1][5, 5], model.mass)  # the base carries everything
assert np.allclose(A_G @ v, h_G, rtol=1e-12)
# %%
print(inspect.getsource(centroidal_composite))


# %% [markdown] lang="en"
# **Exercise 49.10.2.** Is $l_G = m v_G$? Take the linear momentum out of $A_G$, here and in your folder also out of Pinocchio's, and compute
# $m v_G$ link by link.
# %% [markdown] lang="zh"
# **练习 49.10.2。** $l_G = m v_G$ 吗?从 $A_G$ 中取出线动量(在你的文件夹里还要从 Pinocchio 的取),再逐个连杆计算 $m v_G$。
# %%
def linear_momentum(A_G, v):
    """Return the linear momentum l_G, from the centroidal momentum matrix of twistwrench."""
    return ...


tw.exercises.check("49.10.2", linear_momentum)
# %% after="49.10.2"
v_G = tw.center_of_mass(model, model.integrate(q, 1j * tiny * v)).imag / tiny
assert np.allclose(h_G[3:], model.mass * v_G, rtol=1e-12)


# %% [markdown] lang="en"
# **Exercise 49.10.1.** The columns of the base are the momentum of one rigid body, since no joint moves. Build them from four quantities of the
# whole robot. Which quarter is zero in every posture? The picture of $A_G$ comes later, folded.
# %% [markdown] lang="zh"
# **练习 49.10.1。** 基座的列就是一个刚体的动量,因为关节不动。用整机的四个量把它们构造出来。哪一块在任何位形下都为零?
# $A_G$ 的图在后面,是折叠的。
# %%
def base_columns(R, m, c, I_G):
    """Return the base's columns of A_G, from the robot as one rigid body: it is one if the joints do not move."""
    return ...


tw.exercises.check("49.10.1", base_columns)
# %% [markdown] lang="en"
# ## What changes it
#
# Which forces can change the momentum of the whole?
# %% [markdown] lang="zh"
# ## 什么能改变它
#
# 哪些力能改变整体的动量?
# %%
tw.ask("49.10-air", ...)
# %%
tw.ask("49.10-cat", ...)
# %% [markdown] lang="en"
# These are the equations of Newton and Euler for the whole robot. Only forces from outside act on it: the contacts, and
# the weight, which has no moment about $G$.
#
# $$\dot h_G = \begin{pmatrix} \sum_k (p_k - p_G) \times f_k \\ \sum_k f_k + m g \end{pmatrix}.$$
#
# This is for point contacts, such as the feet of Go2. A sole also passes a moment $\tau_k$ (49.4), which is added to the
# upper half.
#
# We check this for a random state with random torques and foot forces, and then once more without foot forces: motors
# can only change how the momentum is distributed inside the robot.
# %% [markdown] lang="zh"
# 把牛顿和欧拉方程用于整个机器人:只有来自外界的力起作用,再加上重力,而重力对 $G$ 没有力矩。
#
# $$\dot h_G = \begin{pmatrix} \sum_k (p_k - p_G) \times f_k \\ \sum_k f_k + m g \end{pmatrix}.$$
#
# 这是点接触的情形,例如 Go2 的脚。脚底(面接触)还传递力矩 $\tau_k$(49.4),要加到上半部分里。
#
# 取随机的状态、力矩和足端力来检验;再去掉足端力重做一次:电机能改变的只是动量在内部怎样分配。
# %%
S, J_c = tw.selection_matrix(model), tw.contact_jacobian(model, q, model.feet)
torques, forces = 5 * rng.standard_normal(12), 30 * rng.standard_normal((4, 3))
feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])

pushed = tw.aba(model, q, v, S.T @ torques + J_c.T @ forces.ravel())
rate = tw.centroidal_momentum_rate(model, q, v, pushed)
outside = np.concatenate([np.cross(feet - p_G, forces).sum(axis=0), forces.sum(axis=0) + model.mass * model.gravity])
assert np.abs(rate - outside).max() < 1e-12 * np.abs(outside).max()

in_the_air = tw.aba(model, q, v, S.T @ torques)
rate_in_the_air = tw.centroidal_momentum_rate(model, q, v, in_the_air)
print("in the air, all legs moving:", rate_in_the_air.round(2) + 0.0)
assert np.allclose(rate_in_the_air, [0, 0, 0, 0, 0, -weight], rtol=1e-12, atol=1e-10)
# %% [markdown] lang="en"
# ## The base's rows are this equation
#
# The first six rows of $M\ddot q + h = S^T\tau + J_c^T\lambda$ have no torques either. They are the same six equations,
# written at the base. Take them to $G$ with ${}^G\!X_b^*$:
#
# $$\begin{gathered} {}^G\!X_b^*\,(M_{bb}\ M_{bj}) = A_G, \\
# {}^G\!X_b^*\, h_b = \dot A_G \dot q - \begin{pmatrix} 0 \\ m g \end{pmatrix}, \qquad
# {}^G\!X_b^*\, J_{c,b}^T\lambda = \begin{pmatrix} \sum (p_k - p_G) \times f_k \\ \sum f_k \end{pmatrix}.
# \end{gathered}$$
# %% [markdown] lang="zh"
# ## 基座行就是这个方程
#
# $M\ddot q + h = S^T\tau + J_c^T\lambda$ 的前六行里也没有力矩。它们就是同样的六个方程,只是写在基座处。用 ${}^G\!X_b^*$ 换到 $G$ 处:
#
# $$\begin{gathered} {}^G\!X_b^*\,(M_{bb}\ M_{bj}) = A_G, \\
# {}^G\!X_b^*\, h_b = \dot A_G \dot q - \begin{pmatrix} 0 \\ m g \end{pmatrix}, \qquad
# {}^G\!X_b^*\, J_{c,b}^T\lambda = \begin{pmatrix} \sum (p_k - p_G) \times f_k \\ \sum f_k \end{pmatrix}.
# \end{gathered}$$
# %%
M, h = tw.crba(model, q), tw.nonlinear_effects(model, q, v)
gravity = np.array([0, 0, 0, 0, 0, -weight])
A_G_rate_v = tw.centroidal_momentum_rate(model, q, v, np.zeros(18))
at_feet = np.concatenate([np.cross(feet - p_G, forces).sum(axis=0), forces.sum(axis=0)])
assert np.allclose(to_G[1] @ M[:6], A_G, rtol=1e-12, atol=1e-12)
assert np.allclose(to_G[1] @ h[:6], A_G_rate_v - gravity, rtol=1e-12, atol=1e-10)
assert np.allclose(to_G[1] @ J_c[:, :6].T @ forces.ravel(), at_feet, rtol=1e-12, atol=1e-10)
# %% after="49.10.1"
leg_starts = [6, 9, 12, 15]
figure, axes = plt.subplots(1, 3, figsize=(13, 3.2), width_ratios=[18, 7, 18], layout="constrained")
moment_force = ["τx", "τy", "τz", "fx", "fy", "fz"]
limit = np.abs(A_G).max()
plot.matrix(to_G[1], "X*: base to G", rows=moment_force, columns=moment_force, limit=1, ax=axes[1])
for ax, A, title in ((axes[0], M[:6], "base's rows of M"), (axes[2], A_G, "A_G = X* times these rows")):
    plot.matrix(A, title, lines=(), limit=limit, rounding=1e-12, rows=["kx", "ky", "kz", "lx", "ly", "lz"], ax=ax)
    for k in leg_starts:
        ax.axvline(k - 0.5, color="k", linewidth=1)
    ax.set_xticks([1, 4, 7, 10, 13, 16], ["ω", "v", "FL", "FR", "RL", "RR"])
plt.show()
# %% [markdown] lang="en"
# ## At rest
#
# What is $\dot h_G$ of a robot that stands still?
# %% [markdown] lang="zh"
# ## 静止时
#
# 机器人静止站立时,$\dot h_G$ 是多少?
# %%
tw.ask("49.10-standing", ...)
# %% [markdown] lang="en"
# $\dot h_G = A_G\ddot q + \dot A_G\dot q$ depends only on the motion. At rest, with $\ddot q = 0$, it is zero, because
# the ground balances the weight of a standing robot. The chapter expects the weight here, but $\dot h_G$ is the weight
# only if the robot falls freely.
# %% [markdown] lang="zh"
# $\dot h_G = A_G\ddot q + \dot A_G\dot q$ 只取决于运动。静止且 $\ddot q = 0$ 时它为零,因为站立时重力与地面反力平衡。本章说这时应该得到重力,但只有机器人自由下落时,
# $\dot h_G$ 才等于重力。
# %%
rest, stand = np.zeros(18), model.standing()
assert not tw.centroidal_momentum_rate(model, stand, rest, rest).any()
falling = tw.aba(model, stand, rest, rest)
assert np.allclose(tw.centroidal_momentum_rate(model, stand, rest, falling), gravity, rtol=1e-12, atol=1e-10)

held = tw.static_equilibrium(model, stand)
assert np.allclose(held.forces.sum(axis=0) + model.mass * model.gravity, 0, rtol=1e-12, atol=1e-10)


# %% [markdown] lang="en"
# ## Three gaits
#
# Now Go2 moves. The joints follow smooth curves: each leg sways, and its knee bends while it swings forward. The trunk
# bobs, and in the bound it pitches. The motion is prescribed; we compute what it needs from outside.
# %% [markdown] lang="zh"
# ## 三种步态
#
# 现在让 Go2 动起来。关节走光滑的曲线:每条腿前后摆动,向前摆时弯膝;躯干上下起伏,跳跑(bound)时还会俯仰。
# 运动是给定的,我们来算:这样运动,外界要提供多大的力。
# %%
gaits = dict(zip(("slow walk", "trot", "bound"), GAITS.values()))
for gait in gaits.values():  # v is the rate of q: see it at a foot
    t = rng.uniform(0, 1, 20)
    foot_v = np.matvec(tw.frame_jacobian(model, move(t, gait)[0], "FR_foot", "local_world_aligned"), move(t, gait)[1])
    foot = tw.frame_placement(model, move(t + 1j * tiny, gait)[0], "FR_foot").translation.imag / tiny
    assert np.abs(foot_v[:, 3:] - foot).max() < 1e-12
# %% thumbnail="yes"
figure, axes = plt.subplots(3, 1, figsize=(11, 3.9), layout="constrained")
for ax, (name, gait) in zip(axes, gaits.items()):
    postures = move(np.arange(6) / 6 / gait.strides, gait)[0]
    postures[:, 0] = 0  # side by side, wherever the robot has got to
    for k, posture in enumerate(postures):
        plot.side_view(model, posture, shift=0.85 * k, ax=ax)
    ax.axhline(0, color="k", linewidth=0.8)
    ax.set_ylim(-0.02, 0.36)
    ax.set(title=f"{name}, {gait.speed:.2f} m/s", xlabel="", xticks=[])
plt.show()
# %% [markdown] lang="en"
# ## $h_G$ over a stride
#
# In a trot and in a bound, the trunk rises twice in each stride, as $l_z$ shows; in this slow walk $l_G$ keeps its mean, and
# is not drawn. (Note the scales of $k_G$: each gait has its own. Your guess is grey.)
# %% [markdown] lang="zh"
# ## 一个步态周期里的 $h_G$
#
# 小跑和跳跑时,躯干每个周期上升两次(见 $l_z$);这里的慢走 $l_G$ 保持平均值,没有画。(注意 $k_G$ 的刻度:每种步态各不相同。你猜的那一列是灰色的。)
# %%
largest_k_y = tw.ask("49.10-gait", ...)
largest_k_y
# %%
strides = {}
for name, gait in gaits.items():
    t = np.linspace(0, 1, 241) / gait.strides
    strides[name] = t, tw.centroidal_momentum(model, *move(t, gait))

figure, axes = plt.subplots(2, 3, figsize=(12, 5), sharex=True, layout="constrained")
for (name, gait), (upper, lower) in zip(gaits.items(), axes.T):
    t, momentum = strides[name]
    wobble = momentum - momentum[:-1].mean(axis=0)
    if largest_k_y.letter == "abc"[list(gaits).index(name)]:
        upper.set_facecolor("0.92")
    for k in range(3):
        upper.plot(t * gait.strides, momentum[:, k], color=plot.XYZ[k], label="xyz"[k])
        lower.plot(t * gait.strides, wobble[:, 3 + k], color=plot.XYZ[k])
    upper.locator_params(nbins=4)
    upper.set_title(f"{name}: k up to {np.abs(momentum[:, :3]).max():.3f} kg m²/s")
    lower.set(ylim=(-5.5, 5.5), yticks=[-4, 0, 4], xlabel="part of the stride")
axes[1, 0].remove()  # in the slow walk l_G keeps its mean
axes[0, 0].tick_params(labelbottom=True)
axes[0, 0].set(xlabel="part of the stride", ylabel="k_G [kg m²/s]")
axes[1, 1].set_ylabel("l_G, less its mean [kg m/s]")
figure.legend(*axes[0, 0].get_legend_handles_labels(), loc=(0.15, 0.18))
plt.show()

largest = {name: np.abs(momentum[:, 1]).max() for name, (_, momentum) in strides.items()}
for name, k_y in largest.items():
    print(f"{name:10} k_y up to {k_y:.3f} kg m²/s")
assert largest["slow walk"] < 0.1 * largest["trot"]
assert largest["trot"] < 0.1 * largest["bound"]


# %% [markdown] lang="en"
# ## $\dot h_G$ in three ways
#
# First, by the formula. Second, as the rate of $h_G$ (the dots are differences over 0.2 ms; the assertion uses a
# complex step, which is exact). Third, from inverse dynamics: the first six entries of `rnea` are the wrench that must
# act on the base from outside. Transformed to $G$, and added to the weight, it must be the same. The picture is for the
# bound:
# %% [markdown] lang="zh"
# ## 用三种办法求 $\dot h_G$
#
# 一、用公式;二、看 $h_G$ 的变化率(图中圆点为 0.2 ms 的差分,断言里用复数步长,没有截断误差);三、用逆动力学:`rnea` 的前六个数就是外界
# 必须施加在基座上的 wrench,换到 $G$ 处再加上重力,应该得到同样的结果。以跳跑为例:
# %%
def wrench_at_G(q, v, a):
    """Return what rnea asks of the world, at the centre of mass, in the axes of the world."""
    base = tw.forward_kinematics(model, q).placement[1]
    X_star = tw.force_transform(base.rotation, base.translation - tw.center_of_mass(model, q))
    return np.matvec(X_star, tw.rnea(model, q, v, a)[..., :6])


# %%
rates = {}
for name, gait in gaits.items():
    t = strides[name][0]
    by_formula = tw.centroidal_momentum_rate(model, *move(t, gait), acceleration(t, gait))
    watched = tw.centroidal_momentum(model, *move(t + 1j * tiny, gait)).imag / tiny
    by_rnea = wrench_at_G(*move(t, gait), acceleration(t, gait)) + gravity
    rates[name] = by_formula
    assert np.abs(by_formula - watched).max() < 1e-12 * np.abs(by_formula).max()
    assert np.abs(by_formula - by_rnea).max() < 1e-12 * weight

t, dt = strides["bound"][0], 1e-4
later, earlier = (tw.centroidal_momentum(model, *move(t + step, gaits["bound"])) for step in (dt, -dt))
difference = (later - earlier) / (2 * dt)
figure, axes = plt.subplots(1, 2, figsize=(11, 3.4), layout="constrained")
for ax, k, label in zip(axes, (1, 5), ("rate of k_y [N m]", "rate of l_z [N]")):
    ax.plot(t, by_formula[:, k], color=plot.COLOURS["sky"], linewidth=5, label="A_G a + (rate of A_G) v")
    ax.plot(t, by_rnea[:, k], "--", color=plot.COLOURS["black"], label="wrench of the world, from rnea")
    ax.plot(t[::12], difference[::12, k], "o", color=plot.COLOURS["vermilion"], label="change of h_G")
    ax.set(xlabel="time [s]", ylabel=label)
axes[0].legend(fontsize=8)
axes[1].axhline(-weight, color="k", linewidth=0.8, linestyle=":")
axes[1].text(t[0], -weight, "−m g: free fall", ha="left", va="bottom", fontsize=8)
axes[1].set_ylim(-175, 175)
plt.show()
assert np.abs(difference - by_formula).max() < 1e-4 * np.abs(by_formula).max()


# %% [markdown] lang="en"
# ## When is $\dot k_G \approx 0$?
#
# The linear inverted pendulum says: always. How wrong that is, the centre of pressure $c$ tells in millimetres: the
# point of the ground about which its forces $f$ have no moment along the ground. Their moment about $G$ is $\dot k_G$, so
# with the height $z$ of $G$ above the ground, $(c - p_G) \times f = \dot k_G$ in x and y.
# %% [markdown] lang="zh"
# ## 什么时候 $\dot k_G \approx 0$？
#
# 线性倒立摆(LIPM)说:总是如此。错多少,可以用压力中心 $c$ 以毫米来衡量:它是地面上的一点,地面的力 $f$ 对该点没有沿地面方向的力矩。
# 这些力对 $G$ 的力矩就是 $\dot k_G$。设 $G$ 离地面的高度为 $z$,就有 $(c - p_G) \times f = \dot k_G$ 的 x、y 分量。
# %% [markdown] lang="en"
# **Exercise 49.10.3.** Keep the height constant, and solve this for the horizontal acceleration of the centre of mass. What does $\dot k_G$ add? The
# second part, in your folder, asks what happens at another pace. Guess the next two before you open what is folded.
# %% [markdown] lang="zh"
# **练习 49.10.3。** 设高度不变,由此解出质心的水平加速度。$\dot k_G$ 多出什么项?第二部分在你的文件夹里,问的是换一种节奏会怎样。
# 先猜下面两题,再打开折叠的内容。
# %%
def com_acceleration(p_G, p, k_rate, m):
    """Return the horizontal acceleration of a centre of mass that stays at its height, with k̇_G not left out."""
    return ...


tw.exercises.check("49.10.3", com_acceleration)
# %%
tw.ask("49.10-load", ...)
# %%
shift = tw.ask("49.10-shift", ...)
shift
# %% [markdown] lang="en" after="49.10.3"
# Solved for the centre of pressure, it reads
#
# $$c_x = x_G - \frac{z f_x + \dot k_y}{f_z}, \qquad c_y = y_G - \frac{z f_y - \dot k_x}{f_z}.$$
#
# Whoever leaves $\dot k_G$ out puts $c$ off by $|(\dot k_x, \dot k_y)| / f_z$. The load $f_z = m(g + \ddot z)$ is the
# weight only if the height is constant; a lightly loaded foot shifts far for a small moment. ($\dot k_z$ shifts nothing.
# Friction supplies it.) To check this, Go2 stands on all four feet and accelerates its trunk; the forces of the feet
# show where $c$ is:
# %% [markdown] lang="zh" after="49.10.3"
# 对压力中心求解,得到
#
# $$c_x = x_G - \frac{z f_x + \dot k_y}{f_z}, \qquad c_y = y_G - \frac{z f_y - \dot k_x}{f_z}.$$
#
# 忽略 $\dot k_G$,压力中心就偏了 $|(\dot k_x, \dot k_y)| / f_z$。法向力 $f_z = m(g + \ddot z)$ 只有在高度不变时才等于重力;脚上压力很小时,
# 很小的力矩也会让压力中心移动很远。($\dot k_z$ 不移动压力中心,它由摩擦提供。)检验一下:Go2 四脚站立,躯干加速,由足端力就能看出 $c$ 在哪里:
# %% after="49.10.3"
J_stand = tw.contact_jacobian(model, stand, model.feet)
trunk = np.array([8.0, -6, 0, 1, 0.5, 3])  # rad/s² and m/s²: it rolls, pitches, and rises
legs = np.linalg.solve(J_stand[:, 6:], -J_stand[:, :6] @ trunk)  # so that no foot accelerates
speed_up = np.concatenate([trunk, legs])
needed = tw.rnea(model, stand, rest, speed_up)[:6]
f = np.linalg.lstsq(J_stand[:, :6].T, needed)[0].reshape(4, 3)  # the base's rows
standing = np.array([tw.frame_placement(model, stand, foot).translation for foot in model.feet])
c = f[:, 2] @ standing / f[:, 2].sum()  # each foot counts with its load
(x_G, y_G, z_G), (f_x, f_y, f_z) = tw.center_of_mass(model, stand), f.sum(axis=0)
k_x, k_y, _, *l_rate = tw.centroidal_momentum_rate(model, stand, rest, speed_up)
without = np.array([x_G - z_G * f_x / f_z, y_G - z_G * f_y / f_z])  # where it is if k̇_G = 0

print(f"shift {1000 * np.hypot(*(c[:2] - without)):.3f} mm, |k̇_xy| / f_z {1000 * np.hypot(k_x, k_y) / f_z:.3f} mm")
assert np.allclose(standing[:, 2], 0, atol=1e-12)
assert np.allclose(l_rate - model.mass * model.gravity, f.sum(axis=0), rtol=1e-10, atol=1e-10)
assert np.allclose(c[:2] - without, np.array([-k_y, k_x]) / f_z, rtol=0, atol=1e-12)
assert f_z > 1.2 * weight  # with the weight in place of f_z it would not come out
# %% [markdown] lang="en" after="49.10.3"
# The same gait at different frequencies: velocities grow with $f$, accelerations with $f^2$, and so does the moment.
# The shift does so only while the load hardly changes. But the trunk bobs faster as well, and near 2.6 strides per
# second it all but unloads the feet: the shift runs away. Beyond that they would have to pull: there is no centre of
# pressure, and no such gait.
# %% [markdown] lang="zh" after="49.10.3"
# 同一种步态用不同的频率来走:速度与 $f$ 成正比,加速度与 $f^2$ 成正比,力矩也与 $f^2$ 成正比。压力中心的偏移只有在法向力几乎不变时才如此。但躯干的起伏也随之加快,接近每秒 2.6 步时脚上几乎没有压力,偏移急剧增大;
# 超过每秒 2.6 步,脚就得往上拉地面:压力中心不存在,这样的步态也不存在。
# %% after="49.10.3"
frequencies = np.geomspace(0.25, 4, 17)
moments, shifts = {}, {}
for name in ("trot", "bound"):
    family = [gaits[name]._replace(strides=f) for f in frequencies]
    times = [np.linspace(0, 1, 121) / f for f in frequencies]
    h_rate = np.array(
        [tw.centroidal_momentum_rate(model, *move(t, g), acceleration(t, g)) for t, g in zip(times, family)]
    )
    moment, load = np.hypot(h_rate[..., 0], h_rate[..., 1]), h_rate[..., 5] + weight
    pushes = (load > 0).all(axis=1)
    moments[name] = moment.max(axis=1)
    shifts[name] = 1000 * (moment[pushes] / load[pushes]).max(axis=1)
    assert np.allclose(moments[name] / frequencies**2, moments[name][0] / frequencies[0] ** 2, rtol=1e-12)
    assert frequencies[pushes].max() < 2.6 < frequencies[~pushes].min()
    assert shifts[name][-1] / shifts[name][-2] > 1.5 * (frequencies[1] / frequencies[0]) ** 2  # the last step: not f²

half_length = 1000 * tw.frame_placement(model, stand, "FL_foot").translation[0]
figure, axes = plt.subplots(1, 2, figsize=(11, 3.6), layout="constrained")
for name, colour in zip(moments, ("blue", "vermilion")):
    axes[0].loglog(frequencies, moments[name], ".-", color=plot.COLOURS[colour], label=name)
    axes[1].loglog(frequencies[pushes], shifts[name], ".-", color=plot.COLOURS[colour], label=name)
axes[0].set_yticks([0.1, 1, 10], ["0.1", "1", "10"])
axes[1].set_yticks([0.1, 1, 10, 100], ["0.1", "1", "10", "100"])
axes[1].axhline(half_length, color="k", linestyle=":")
axes[1].set_ylim(top=600)
axes[1].text(0.25, half_length, "from the middle to the front feet", va="bottom", fontsize=8)
axes[0].set(ylabel="moment [N m]", title="what k̇_G = 0 leaves out")
axes[1].set(ylabel="shift [mm]", title="shift of the centre of pressure")
for ax in axes:
    ax.set_xlabel("strides per second")
    ax.set_xticks([0.25, 0.5, 1, 2, 4], ["0.25", "0.5", "1", "2", "4"])
    ax.minorticks_off()
    ax.grid(alpha=0.3)
axes[0].legend()
plt.show()
# %% [markdown] lang="en"
# ## LIPM and SRBM
#
# The LIPM keeps the height constant as well, because otherwise it is not linear: with $\ddot z \ne 0$ the force along the
# leg is scaled by $1 + \ddot z/g$. The single rigid body (SRBM) keeps six equations, but its momentum is that of a body
# that turns with the trunk, $k_G \approx \bar I \omega$: the swinging legs are missing. The bars divide the moment left
# out by the load at the same instant, with your guess for the trot beside it.
# %% [markdown] lang="zh"
# ## LIPM 与 SRBM
#
# LIPM 还假设高度不变,否则它就不是线性的:$\ddot z \ne 0$ 时,沿腿的力要乘以 $1 + \ddot z/g$。
# 单刚体模型(SRBM)保留了六个方程,但它的动量是随躯干转动的一个刚体的动量,$k_G \approx \bar I \omega$,没有摆动的腿的贡献。
# 图中的柱高是漏掉的力矩除以同一时刻的法向力;你对小跑的猜测画在旁边。
# %%
tw.ask("49.10-rigid", ...)
# %% setup="yes"
inertia = tw.centroidal_map(model, stand)[:3, :3]  # the base is level: of the whole robot about G, in its axes


def rigid(t, gait):
    """Return the angular momentum of the single rigid body, in the axes of the world."""
    q, v = move(t, gait)
    return np.matvec(tw.forward_kinematics(model, q).placement[1].rotation @ inertia, v[..., :3])


off, missed, loads = {}, {}, {}
for name, gait in gaits.items():
    t, k_rate = strides[name][0], rates[name][:, :3]
    rigid_rate = rigid(t + 1j * tiny, gait).imag / tiny
    load = rates[name][:, 5] + weight
    left_out = [np.hypot(x[:, 0], x[:, 1]) for x in (k_rate, k_rate - rigid_rate)]
    missed[name] = [moment.max() for moment in left_out]
    off[name] = [1000 * (moment / load).max() for moment in left_out]
    loads[name] = load.min() / weight, load.max() / weight
# %%
print("gait         LIPM leaves out        SRBM leaves out     load f_z / mg")
for name in gaits:
    pairs = "  ".join(f"{m:6.2f} N m {mm:7.2f} mm" for m, mm in zip(missed[name], off[name]))
    print(f"{name:10} {pairs}   {loads[name][0]:.2f} to {loads[name][1]:.2f}")

x = np.arange(3)
ax = plot.axes_2d(size=(6.5, 3.4))
for k, (model_name, colour) in enumerate({"LIPM": "vermilion", "SRBM": "blue"}.items()):
    bars = ax.bar(
        x + 0.4 * k - 0.2, [row[k] for row in off.values()], 0.4, color=plot.COLOURS[colour], label=model_name
    )
    ax.bar_label(bars, fmt="%.3g", fontsize=8, label_type="center", color="w")
ax.axhline(half_length, color="k", linestyle=":")
ax.set(xticks=x, xticklabels=off, yscale="log", ylim=(0.1, 2000), ylabel="shift of the centre of pressure [mm]")
ax.set_yticks([0.1, 1, 10, 100, 1000], ["0.1", "1", "10", "100", "1000"])
ax.set_title("moment left out, over the load")
ax.legend(loc="upper left")
shift.draw(ax, "y")
plt.show()

assert max(off["slow walk"]) < 0.5  # half a millimetre, and
assert np.allclose(loads["slow walk"], 1, atol=1e-4)  # nothing of the height: both models will do
assert np.isclose(*off["trot"])  # a level trunk: the SRBM has no angular momentum at all
assert missed["bound"][1] < 0.3 * missed["bound"][0]  # of the moment of the bound it leaves out a quarter, but
assert half_length < off["bound"][1] < off["bound"][0]  # the shift goes beyond the feet for both, at the least load
assert max(loads["trot"][0], loads["bound"][0]) < 0.1  # nearly in free fall twice a stride: no LIPM
# %% [markdown] lang="en"
# ## Pinocchio
#
# `data.Ag` and `data.hg` have the linear rows first. `computeCentroidalMomentumTimeVariation` returns all of $\dot h_G$,
# not $\dot A_G\dot q$ alone. For numbers of your own, on the site: [Translate my numbers](../hands/translate.md).
# %% [markdown] lang="zh"
# ## 与 Pinocchio 对照
#
# `data.Ag` 和 `data.hg` 的线动量行在前。`computeCentroidalMomentumTimeVariation` 返回的是整个 $\dot h_G$,
# 不只是 $\dot A_G\dot q$。要换算自己的数,可以用网站上的[换算我的数](../hands/translate.md)。
# %%
h_rate_here = tw.centroidal_momentum_rate(model, q, v, a)
if pin:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    pin_v, pin_a = tw.bridge.to_pinocchio_tangent(model, v), tw.bridge.to_pinocchio_tangent(model, a)
    A_there = pin.computeCentroidalMap(pin_model, data, q)
    h_there = pin.computeCentroidalMomentum(pin_model, data, q, pin_v).vector.copy()
    rate_there = pin.computeCentroidalMomentumTimeVariation(pin_model, data, q, pin_v, pin_a).vector.copy()
    assert np.abs(tw.bridge.from_pinocchio_jacobian(model, A_there) - A_G).max() < 1e-12 * np.abs(A_G).max()
    assert np.abs(tw.bridge.from_pinocchio_force(h_there) - h_G).max() < 1e-12 * np.abs(h_G).max()
    assert np.abs(tw.bridge.from_pinocchio_force(rate_there) - h_rate_here).max() < 1e-12 * np.abs(h_rate_here).max()
    print("A_G, h_G and its rate: the same")
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.10.1** the blocks of $A_G$ of a standing Go2
# - **49.10.2** $l_G = m v_G$
# - **49.10.3** why $\dot k_G = 0$ will do for a slow walk, and not for a somersault
#
# `twistwrench exercises start my_answers`, then `python -m pytest` in that folder;
# `twistwrench exercises hint 49.10.1`.
# Next: notebook 49.11.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.10.1** 站立的 Go2 的 $A_G$ 分块
# - **49.10.2** $l_G = m v_G$
# - **49.10.3** 为什么 $\dot k_G = 0$ 适用于慢走,却不适用于翻跟头
#
# `twistwrench exercises start my_answers --language zh`,然后在那个文件夹里运行 `python -m pytest`；`twistwrench exercises hint 49.10.1` 给提示。
# 下一个:笔记本 49.11。

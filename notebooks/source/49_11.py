# %% [markdown] lang="en"
# # 49.11 In practice: from the formula to Pinocchio
#
# The last notebook puts everything side by side: each formula of the chapter, the function of this package, the call in
# Pinocchio; the chapter's seven tests; and the four quantities that a controller asks for in every cycle.
#
# Pinocchio is installed with `pip install pin`. The package that is called `pinocchio` on PyPI is something else. Without
# it you can do all of this notebook but the comparisons.
# %% [markdown] lang="zh"
# # 49.11 实操:从公式到 Pinocchio
#
# 最后一个笔记本把前面的内容放在一起对照:本章的每个公式、本包里的函数、Pinocchio 里的调用;本章的七个测试;
# 以及控制器每个周期都要的四个量。
#
# Pinocchio 用 `pip install pin` 安装。PyPI 上名叫 `pinocchio` 的是另一个软件包。没有安装它,除了比较之外都可以照做。
# %%
import twistwrench as tw

model = tw.load("go2")
# %% setup="yes"
import timeit
from functools import partial

import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot
from twistwrench.cli import main

try:
    import pinocchio as pin
except ImportError:
    pin = None
    print("Pinocchio is not installed (pip install pin): the comparisons below are skipped")

rng = np.random.default_rng(11)
q = model.random_configuration(rng=rng)  # pin.randomConfiguration would draw an infinite position for the base
v, a, tau = rng.standard_normal((3, model.nv))
tau[:6] = 0  # no motor at the base
rest, stand = np.zeros(model.nv), model.standing()
i, foot = model.joint_id("FR_thigh_joint"), "FR_foot"


def compare(name, ours, theirs):
    """Print how large a quantity is, and how many digits the two have in common."""
    largest, difference = np.abs(ours).max(), np.abs(ours - theirs).max()
    digits = -np.log10(max(difference / largest, 1e-16))
    print(f"{name:4} up to {largest:8.4g}, the same in {digits:.0f} digits")
    assert digits > 12


# %% [markdown] lang="en"
# ## The map
#
# Each line below is a quantity: its name, the call here, the call in Pinocchio. `P` is Pinocchio's model of the same
# robot, and `data` its memory for results. Its vectors have the linear part first, so ours go over the bridge on the way
# to it, and its results on the way back:
# %% [markdown] lang="zh"
# ## 对照表
#
# 下面每一行是一个量:名字、本包的写法、Pinocchio 的写法。`P` 是同一台机器人在 Pinocchio 里的模型,`data` 是它存放结果的地方。
# 它的向量线分量在前,所以我们的向量交给它之前、它的结果拿回来之后,都要用 `tw.bridge` 换序:
# %%
if pin:
    P = tw.bridge.to_pinocchio_model(model)
    data = P.createData()
    pv, pa, ptau = (tw.bridge.to_pinocchio_tangent(model, x) for x in (v, a, tau))
# %% [markdown] lang="en"
# First what has a number for each of the eighteen velocities: $\tau = M\dot v + h$, its inverse, and the two parts of it
# that RNEA also gives. The way back is `tw.bridge.from_pinocchio_tangent`.
# %% [markdown] lang="zh"
# 先看十八个速度各对应一个数的量:$\tau = M\dot v + h$,它的逆,以及 RNEA 也能给出的两部分。把结果换回来的是 `tw.bridge.from_pinocchio_tangent`。
# %%
if pin:
    tangent = partial(tw.bridge.from_pinocchio_tangent, model)
    compare("τ", tw.rnea(model, q, v, a), tangent(pin.rnea(P, data, q, pv, pa)))
    compare("v̇", tw.aba(model, q, v, tau), tangent(pin.aba(P, data, q, pv, ptau)))
    compare("h", tw.nonlinear_effects(model, q, v), tangent(pin.nonLinearEffects(P, data, q, pv)))
    compare("g", tw.gravity(model, q), tangent(pin.computeGeneralizedGravity(P, data, q)))
# %% [markdown] lang="en"
# Matrices with such rows and columns:
# %% [markdown] lang="zh"
# 行和列都这样编号的矩阵:
# %%
if pin:
    matrix = partial(tw.bridge.from_pinocchio_matrix, model)
    compare("M", tw.crba(model, q), matrix(pin.crba(P, data, q)))
    compare("C", tw.coriolis_matrix(model, q, v), matrix(pin.computeCoriolisMatrix(P, data, q, pv)))
# %% [markdown] lang="en"
# What belongs to one body, here the right front thigh: its placement, its twist, $\mathrm{Ad}_T = X$, and its inertia. Only
# the two halves change places.
# %% [markdown] lang="zh"
# 属于一个刚体的量,这里取右前大腿:位姿、twist、$\mathrm{Ad}_T = X$ 和惯量。只有前后两半互换。
# %%
if pin:
    pin.forwardKinematics(P, data, q, pv)  # fills data.oMi and data.v
    motion, transform = tw.bridge.from_pinocchio_motion, tw.bridge.from_pinocchio_transform
    kin = tw.forward_kinematics(model, q, v)
    compare("⁰T_i", kin.placement[i].matrix(), data.oMi[i].homogeneous)
    compare("V_i", kin.twist[i], motion(data.v[i].vector))
    compare("X", kin.placement[i].motion_transform(), transform(data.oMi[i].action))
    compare("Î_i", model.inertia[i].matrix(), transform(P.inertias[i].matrix()))
# %% [markdown] lang="en"
# Jacobians, here of a foot: in its own frame, or, for a point contact, the three linear rows in the axes of the world.
# %% [markdown] lang="zh"
# 雅可比矩阵,这里取一只脚的:在它自己的坐标系中;或者对点接触,只取世界坐标轴下的三行线速度。
# %%
if pin:
    jacobian, contact = tw.bridge.from_pinocchio_jacobian, tw.bridge.from_pinocchio_contact_jacobian
    J = pin.computeFrameJacobian(P, data, q, P.getFrameId(foot), pin.LOCAL)
    J_foot = pin.computeFrameJacobian(P, data, q, P.getFrameId(foot), pin.LOCAL_WORLD_ALIGNED)
    compare("J_i", tw.frame_jacobian(model, q, foot), jacobian(model, J))
    compare("J_c", tw.contact_jacobian(model, q, [foot]), contact(model, J_foot[:3]))
# %% [markdown] lang="en"
# And the whole robot: centre of mass, momentum, and the rate of the momentum. ($A_G$ is your exercise below.)
# %% [markdown] lang="zh"
# 最后是整机:质心、动量和动量的变化率。($A_G$ 留作下面的练习。)
# %%
if pin:
    force = tw.bridge.from_pinocchio_force
    h_G = pin.computeCentroidalMomentum(P, data, q, pv).vector
    compare("p_G", tw.center_of_mass(model, q), pin.centerOfMass(P, data, q))
    compare("h_G", tw.centroidal_momentum(model, q, v), force(h_G))
    rate = pin.computeCentroidalMomentumTimeVariation(P, data, q, pv, pa).vector
    compare("ḣ_G", tw.centroidal_momentum_rate(model, q, v, a), force(rate))
# %% [markdown] lang="en"
# ## The bridge
#
# `q` is the same on both sides. In everything that belongs to `v`, the six entries of the base change places; in twists
# and wrenches, the two halves. The bridge is the only place that does this. What if you forget it?
# %% [markdown] lang="zh"
# ## 换序的桥
#
# `q` 两边相同。凡是与 `v` 对应的量,基座的六个元素要换位置;twist 和 wrench 则是前后两半互换。只有 `tw.bridge` 做这件事。
# 如果忘了换序呢?
# %%
tw.ask("49.11-order", ...)
# %%
order = tw.bridge.to_pinocchio_tangent(model, np.arange(18))
print("where Pinocchio's entries of v stand in ours:", order.astype(int))
wrong = tw.rnea(model, q, v[order.astype(int)], a[order.astype(int)])
print(f"rnea with v and a in the wrong order: off by {np.abs(wrong - tw.rnea(model, q, v, a)).max():.1f} N")
assert np.abs(wrong - tw.rnea(model, q, v, a)).max() > 1
assert np.array_equal(tw.bridge.from_pinocchio_tangent(model, order), np.arange(18))
V, F = rng.standard_normal((2, 6))
their_V, their_F = tw.bridge.to_pinocchio_motion(V), tw.bridge.to_pinocchio_force(F)
assert np.array_equal(their_V, [*V[3:], *V[:3]])
assert np.isclose(their_F @ their_V, F @ V)  # power: the same
# %%
tw.ask("49.11-eigenvalues", ...)
# %%
M = tw.crba(model, q)
there = tw.bridge.to_pinocchio_matrix(model, M)
print("largest eigenvalues, ours:       ", np.linalg.eigvalsh(M)[-4:].round(3))
print("largest eigenvalues, Pinocchio's:", np.linalg.eigvalsh(there)[-4:].round(3))

figure, axes = plt.subplots(1, 2, figsize=(9.5, 4.8), layout="constrained")
swapped = [*plot.ANGULAR_LINEAR[3:], *plot.ANGULAR_LINEAR[:3]]
leg = [name.removesuffix("_joint") for name in model.joint_names[2:5]]
orders = {"our": (M, plot.ANGULAR_LINEAR), "Pinocchio's": (there, swapped)}
for ax, (whose, (entries, base)) in zip(axes, orders.items()):
    plot.matrix(entries[:9, :9], f"M in {whose} order", rows=[*base, *leg], lines=[3, 6], rounding=1e-12, ax=ax)
plt.show()
assert np.allclose(np.linalg.eigvalsh(M), np.linalg.eigvalsh(there), rtol=1e-10)
# %%
tw.ask("49.11-quaternion", ...)
# %%
fallen = stand.copy()
fallen[3:7] = 1, 0, 0, 0  # meant: no rotation, with the scalar part first
up = tw.forward_kinematics(model, fallen).placement[1].rotation[:, 2]
print("the robot's back points to", up.round(3) + 0.0)
assert np.allclose(up, [0, 0, -1])
# %%
tw.ask("49.11-risen", ...)
# %%
print("base acceleration inside rnea:", np.array(tw.rnea_terms(model, stand, rest, rest).A)[1].round(2) + 0.0)
if pin:
    pin.rnea(P, data, stand, rest, rest)
    print("Pinocchio's data.a_gf:        ", motion(data.a_gf[1].vector).round(2) + 0.0)
    assert np.allclose(motion(data.a_gf[1].vector), [0, 0, 0, 0, 0, 9.81], atol=1e-12)


# %% [markdown] lang="en"
# **Exercise 49.11.4.** Call Pinocchio yourself, and return its $A_G$ in the chapter's order. (This one needs Pinocchio.)
# %% [markdown] lang="zh"
# **练习 49.11.4。** 自己调用 Pinocchio,并按本章的顺序返回 $A_G$。(这道题需要安装 Pinocchio。)
# %%
def map_from_pinocchio(model, q):
    """Return the centroidal map of a robot, computed by Pinocchio, in the chapter's order."""
    return ...


tw.exercises.check("49.11.4", map_from_pinocchio)
# %% [markdown] lang="en" after="49.11.4"
# Its rows are those of a momentum, its columns those of a velocity: both have a half to exchange, the columns only in the
# first six. The bridge does the same:
# %% [markdown] lang="zh" after="49.11.4"
# 它的行对应动量,列对应速度:两者都要换,但列只换前六个。`tw.bridge` 做的是同一件事:
# %% after="49.11.4"
if pin:
    compare("A_G", tw.centroidal_map(model, q), jacobian(model, pin.computeCentroidalMap(P, data, q)))
    assert np.array_equal(tw.crba(tw.bridge.from_pinocchio_model(P), q), M)
# %% [markdown] lang="en"
# ## Seven tests
#
# The chapter's listing has seven tests, one at the end of each of its parts. We run them in the chapter's own order first,
# $(\boldsymbol\omega, \boldsymbol v)$, in which its formulas are right. Tests 1 and 2: $\tau$ from RNEA is $M\ddot q + h$,
# and ABA solves that for $\ddot q$.
# %% [markdown] lang="zh"
# ## 七个测试
#
# 本章的代码用七项检查给各节收尾。先按本章自己的顺序 $(\boldsymbol\omega, \boldsymbol v)$ 来做,在这个顺序下它的公式都是对的。
# 测试 1、2:RNEA 的 $\tau$ 等于 $M\ddot q + h$;ABA 由此解出 $\ddot q$。
# %%
d = tw.dynamics(model, q, v)
test_1 = d.M @ a + d.h - tw.rnea(model, q, v, a)
test_2 = np.linalg.solve(d.M, tau - d.h) - tw.aba(model, q, v, tau)
print(f"test 1: {np.abs(test_1).max():.12f}   test 2: {np.abs(test_2).max():.12f}")
# %% [markdown] lang="en"
# Test 3: $\hat I$ from mass, centre of mass and inertia (49.5). Test 4: $\mathrm{Ad}_T$ from $R$ and $\boldsymbol p$
# (49.3). Both are built from blocks, the angular one first.
# %% [markdown] lang="zh"
# 测试 3:由质量、质心和惯量构造 $\hat I$(49.5)。测试 4:由 $R$ 和 $\boldsymbol p$ 构造 $\mathrm{Ad}_T$(49.3)。
# 两者都用分块拼成,角分量的块在前。
# %%
m, c, I_c = model.inertia[i].mass, tw.skew(model.inertia[i].com), model.inertia[i].inertia_at_com
T = tw.forward_kinematics(model, q).placement[i]
R, p = T.rotation, tw.skew(T.translation)
inertia = np.block([[I_c - m * c @ c, m * c], [-m * c, m * np.eye(3)]])
X = np.block([[R, np.zeros((3, 3))], [p @ R, R]])
test_3, test_4 = inertia - model.inertia[i].matrix(), X - T.motion_transform()
print(f"test 3: {np.abs(test_3).max():.12f}   test 4: {np.abs(test_4).max():.12f}")
# %% [markdown] lang="en"
# Test 5: $h_G = A_G\dot q$. Test 6: $l_G = m v_G$. Test 7 has no error to print. It asks for the shape of $J_c$ of the four
# feet, and for its rank.
# %% [markdown] lang="zh"
# 测试 5:$h_G = A_G\dot q$。测试 6:$l_G = m v_G$。测试 7 不打印误差,它问的是四只脚的 $J_c$ 的形状和秩。
# %%
momentum = tw.centroidal_momentum(model, q, v)
test_5 = d.A_G @ v - momentum
v_G = tw.center_of_mass(model, model.integrate(q, 1e-100j * v)).imag / 1e-100  # the complex step of 49.2
test_6 = model.mass * v_G - momentum[3:]
print(f"test 5: {np.abs(test_5).max():.12f}   test 6: {np.abs(test_6).max():.12f}")
print("test 7:", d.J_c.shape, "rank", np.linalg.matrix_rank(d.J_c))
for error in (test_1, test_2, test_3, test_4, test_5, test_6):
    assert np.abs(error).max() < 1e-10
assert d.J_c.shape == (12, 18)
assert np.linalg.matrix_rank(d.J_c) == 12


# %% [markdown] lang="en"
# The listing itself runs on Pinocchio. The chapter expects seven errors of the order of 1e-10. Run it. Do you agree?
#
# **Exercise 49.11.1.** Which of the tests pass, and what must be changed in the others? Here is test 6; the rest is in your
# folder. What is folded below is the answer.
# %% [markdown] lang="zh"
# 书上的代码运行在 Pinocchio 上。本章预期七个误差都在 1e-10 量级。运行一下,你同意吗?
#
# **练习 49.11.1。** 哪几项通过,其余的要改什么?这里是测试 6,其余的在你的文件夹里。下面折叠的就是答案。
# %%
def com_velocity(h_G, m):
    """Return the velocity of the centre of mass from Pinocchio's centroidal momentum (test 6)."""
    return ...


tw.exercises.check("49.11.1", com_velocity)


# %% [markdown] lang="en" after="49.11.1"
# Pinocchio's order is $(\boldsymbol v, \boldsymbol\omega)$. As printed, the listing first draws a `q`
# with an infinite position, and nearly everything is nan. With a finite `q`, one test of seven is right. What is to be
# changed:
#
# | test | as printed | right |
# |---|---|---|
# | 1, 2 | $M + M^T - \mathrm{diag}(M)$ | `pin.crba` returns a symmetric matrix already |
# | 3 | angular block top left | linear block top left, $-m[c]_\times$ top right |
# | 4 | $[p]_\times R$ bottom left | top right |
# | 6 | `h_G[3:]` | `h_G[:3]` |
# | 7 | `J_full[3:, :]` | `J_full[:3, :]` |
# %% [markdown] lang="zh" after="49.11.1"
# Pinocchio 的顺序是 $(\boldsymbol v, \boldsymbol\omega)$。照原样运行,首先抽到的 `q` 位置是无穷大,几乎全部结果都是 nan。
# 换成有限的 `q`,七个测试里对一个。要改的地方:
#
# | 测试 | 原文 | 正确 |
# |---|---|---|
# | 1、2 | $M + M^T - \mathrm{diag}(M)$ | `pin.crba` 返回的矩阵已经对称 |
# | 3 | 角分量的块在左上 | 线分量的块在左上,右上是 $-m[c]_\times$ |
# | 4 | $[p]_\times R$ 在左下 | 在右上 |
# | 6 | `h_G[3:]` | `h_G[:3]` |
# | 7 | `J_full[3:, :]` | `J_full[:3, :]` |
# %% after="49.11.1"
def six_errors(M, inertia, X, l_G):
    """Return the largest error of tests 1 to 6, with what the tests build by hand."""
    bias, forces = pin.nonLinearEffects(P, data, q, pv), pin.rnea(P, data, q, pv, pa)
    pin.centerOfMass(P, data, q, pv)
    found = [
        M @ pa + bias - forces,
        np.linalg.solve(M, ptau - bias) - pin.aba(P, data, q, pv, ptau),
        inertia - P.inertias[i].matrix(),
        X - data.oMi[i].action,
        pin.computeCentroidalMap(P, data, q) @ pv - h_G,
        model.mass * data.vcom[0] - l_G,
    ]
    return np.array([np.abs(error).max() for error in found])


if pin:
    M_there, h_G = pin.crba(P, data, q).copy(), pin.computeCentroidalMomentum(P, data, q, pv).vector.copy()
    doubled, halves = M_there + M_there.T - np.diag(M_there.diagonal()), np.ix_([3, 4, 5, 0, 1, 2], [3, 4, 5, 0, 1, 2])
    as_printed = six_errors(doubled, inertia, X, h_G[3:])
    mended = six_errors(M_there, inertia[halves], X[halves], h_G[:3])
    of_feet = [pin.computeFrameJacobian(P, data, q, P.getFrameId(f), pin.LOCAL_WORLD_ALIGNED) for f in model.feet]
    rank_printed, rank = (
        np.linalg.matrix_rank(np.vstack([J[rows] for J in of_feet])) for rows in (slice(3, 6), slice(3))
    )
    assert (mended < 1e-10).all()
    assert np.flatnonzero(as_printed < 1e-10).tolist() == [4]  # test 5
    assert (rank_printed < 12, rank) == (True, 12)

    ax, x = plot.axes_2d(size=(7.5, 3.4)), np.arange(1, 7)
    floor = 1e-17  # where there is no error at all
    ax.bar(x - 0.2, np.maximum(as_printed, floor), 0.4, color=plot.COLOURS["vermilion"], label="as printed")
    ax.bar(x + 0.2, np.maximum(mended, floor), 0.4, color=plot.COLOURS["blue"], label="set right")
    ax.axhline(1e-10, color="k", linestyle=":", label="the chapter's 1e-10")
    ax.set(yscale="log", ylim=(floor, 1e8), xlabel="test", ylabel="largest error", xticks=x)
    ax.set_title(f"on Pinocchio; test 7: rank {rank_printed} as printed, {rank} set right")
    ax.legend(fontsize=8, ncols=3, loc="upper center")
    plt.show()


# %% [markdown] lang="en"
# ## What a controller asks for
#
# `tw.dynamics` is the chapter's `getDynamics`: $M$, $h$, $J_c$, $A_G$ at one state, or only what `want=` names, for one
# state or for many at once:
# %% [markdown] lang="zh"
# ## 控制器要什么
#
# `tw.dynamics` 就是本章的 `getDynamics`:给出 $M$、$h$、$J_c$、$A_G$,或者只给 `want=` 里点名的几个;一个状态或许多状态都可以:
# %%
many = tw.dynamics(model, np.tile(stand, (50, 1)), rng.standard_normal((50, 18)))  # fifty states at once
print({name: getattr(many, name).shape for name in ("M", "h", "J_c", "A_G")})


# %% [markdown] lang="en"
# **Exercise 49.11.3.** All four of a standing Go2, and the forces at its feet: notebook 49.9 has that half. The other: two of
# the four know each other at rest. Find gravity's forces $g$ from $A_G$ alone.
# %% [markdown] lang="zh"
# **练习 49.11.3。** 站立的 Go2 的四个量,以及足端力:这一半在笔记本 49.9 里。另一半:静止时四个量中有两个关系密切。只由 $A_G$ 求重力项 $g$。
# %%
def gravity_from_map(A_G):
    """Return g(q), given A_G alone."""
    return ...


tw.exercises.check("49.11.3", gravity_from_map)
# %% [markdown] lang="en"
# Now one step of a controller. The robot stands on four feet that stay where they are, its trunk is moving, and it is asked
# to brake and to rise with 1 m/s². First without any motion:
# %% [markdown] lang="zh"
# 现在做控制器的一步计算。机器人四脚着地、脚不动,躯干在运动;要求它减速,并以 1 m/s² 的加速度上升。先看没有速度的情形:
# %%
tw.ask("49.11-rise", ...)
# %% setup="yes"
base_v = np.array([0.2, -0.3, 0.4, 0.1, -0.1, 0.2])
base_a = -2 * base_v + np.array([0, 0, 0, 0, 0, 1.0])
J_c = tw.contact_jacobian(model, stand, model.feet)
feet_still = np.concatenate([base_v, -np.linalg.solve(J_c[:, 6:], J_c[:, :6] @ base_v)])
d = tw.dynamics(model, stand, feet_still)
J_rate_v = [tw.frame_bias_acceleration(model, stand, feet_still, f, "local_world_aligned")[3:] for f in model.feet]
bias = np.concatenate(J_rate_v)
assert np.allclose(J_c @ feet_still, 0, atol=1e-12)
# %% [markdown] lang="en"
# **Step 1**, the joints. The feet stay, $J_c\ddot q + \dot J_c\dot q = 0$. The trunk's acceleration is given, so the
# joints' follow. (`bias` is $\dot J_c\dot q$.)
# %% [markdown] lang="zh"
# **第一步**,关节。脚不动,$J_c\ddot q + \dot J_c\dot q = 0$。躯干的加速度已经给定,关节的也就定了。(`bias` 是 $\dot J_c\dot q$。)
# %%
joint_a = np.linalg.solve(d.J_c[:, 6:], -bias - d.J_c[:, :6] @ base_a)
wanted = np.concatenate([base_a, joint_a])
print("knees:", joint_a[2::3].round(1), "rad/s²")
# %% [markdown] lang="en"
# **Step 2**, the feet. The base's six rows have no torque: they determine the forces (the smallest, of many).
# %% [markdown] lang="zh"
# **第二步**,脚。基座的六行里没有力矩,由它们求足端力(解有许多,取范数最小的)。
# %%
needed = d.M @ wanted + d.h
lam = np.linalg.lstsq(d.J_c[:, :6].T, needed[:6])[0]
print("vertical forces:", lam[2::3].round(1), "N, in all", lam[2::3].sum().round(1), "N")
# %% [markdown] lang="en"
# **Step 3**, the motors. What is left in the joints' rows, they must supply.
# %% [markdown] lang="zh"
# **第三步**,电机。关节行里剩下的,由电机提供。
# %%
torques = (needed - d.J_c.T @ lam)[6:]
print("largest torque:", np.abs(torques).max().round(1), "of", model.effort_limit[6:].min(), "N m")
assert (lam[2::3] > 0).all()  # the ground pushes
assert (np.abs(torques) < model.effort_limit[6:]).all()
# %% [markdown] lang="en"
# Does the robot then move as it is asked to? We apply the torques to one whose feet are held (by whatever forces this
# needs), and compute how it moves. Eighteen accelerations and twelve forces are unknown, and there are as many equations:
# %% [markdown] lang="zh"
# 机器人真会照要求动吗?把这些力矩交给一个脚被固定住的机器人(需要多大的力就给多大),看它怎样运动。未知数是十八个加速度和十二个力,
# 方程也有这么多:
# %%
S = tw.selection_matrix(model)
both = np.block([[d.M, -d.J_c.T], [d.J_c, np.zeros((12, 12))]])
answer = np.linalg.solve(both, np.concatenate([S.T @ torques - d.h, -bias]))
print("acceleration of the base: asked", base_a, "got", answer[:6].round(6))
assert np.allclose(answer[:18], wanted, rtol=1e-10, atol=1e-10)
assert np.allclose(answer[18:], lam, rtol=1e-10, atol=1e-10)

p_G = tw.center_of_mass(model, stand)
levers = np.array([tw.frame_placement(model, stand, f).translation for f in model.feet]) - p_G
forces = lam.reshape(4, 3)
outside = np.concatenate([np.cross(levers, forces).sum(axis=0), forces.sum(axis=0) + model.mass * model.gravity])
from_motion = d.A_G @ wanted + tw.centroidal_momentum_rate(model, stand, feet_still, rest)
assert np.allclose(from_motion, outside, rtol=1e-10, atol=1e-10)  # and the momentum changes as A_G says
# %% [markdown] lang="en"
# ## The project
#
# The chapter's project builds this library once more, in four stages. Each is an exercise that checks itself; the place to
# look when you are stuck is on the right.
#
# | stage | you write | here |
# |---|---|---|
# | `project.1` | twists and wrenches, $X$ and $X^*$, $V\times$ and $V\times^*$ | `tw.Twist`, `tw.Wrench`, `tw.SE3`, `tw.cross_force`; 49.2–49.5 |
# | `project.2` | RNEA, ABA, CRBA; the equation of a floating base | `tw.rnea`, `tw.aba`, `tw.crba`, `tw.contact_jacobian`; 49.6–49.9 |
# | `project.3` | $A_G$, $h_G$, its rate; `getDynamics` | `tw.centroidal_map`, `tw.centroidal_momentum_rate`, `tw.dynamics`; 49.10 |
# | `project.4` | it holds together: equilibrium, ABA against RNEA, time | `tw.static_equilibrium`, `twistwrench validate` |
# %% [markdown] lang="zh"
# ## 累积项目
#
# 本章的累积项目分四个阶段,把这个库再写一遍。每个阶段都是能自己检查的练习;卡住的时候,去右边一栏找。
#
# | 阶段 | 你来写 | 本包里 |
# |---|---|---|
# | `project.1` | twist 与 wrench，$X$ 与 $X^*$，$V\times$ 与 $V\times^*$ | `tw.Twist`、`tw.Wrench`、`tw.SE3`、`tw.cross_force`；49.2–49.5 |
# | `project.2` | RNEA、ABA、CRBA,浮动基座方程 | `tw.rnea`、`tw.aba`、`tw.crba`、`tw.contact_jacobian`；49.6–49.9 |
# | `project.3` | $A_G$、$h_G$ 及其变化率,`getDynamics` | `tw.centroidal_map`、`tw.centroidal_momentum_rate`、`tw.dynamics`；49.10 |
# | `project.4` | 集成验证:静力平衡,ABA 与 RNEA 互逆,耗时 | `tw.static_equilibrium`、`twistwrench validate` |
# %% [markdown] lang="en"
# ## All of it at once
#
# In a terminal: `twistwrench validate go2`. Every quantity of the chapter at random states, against Pinocchio and against a
# computation with 50 digits that knows no 6-D vectors.
# %% [markdown] lang="zh"
# ## 一次验证全部
#
# 在终端里就是 `twistwrench validate go2`:在随机状态下,把本章的每个量与 Pinocchio 比较,再与一个完全不用 6D 向量、有 50 位有效数字的计算比较。
# %%
tw.ask("49.11-digits", ...)
# %%
status = main(["validate", "go2", "--states", "2", "--truths", "1"])
assert status == 0


# %% [markdown] lang="en"
# ## How fast
#
# Times of microseconds depend on the machine and on whatever else runs on it, so we measure ratios: all candidates in turn,
# many rounds, the best of each. Pinocchio is compiled C++; this package is NumPy, written to be read. A batch makes up for
# part of it, since 1000 states cost hardly more calls than one. From two robots the chapter concludes that the growth is
# linear. Do you agree?
# %% [markdown] lang="zh"
# ## 有多快
#
# 微秒级的耗时取决于机器,也取决于机器上还在跑什么,所以我们量的是比值:各个候选轮流跑很多轮,各取最好的一次。
# Pinocchio 是编译好的 C++;本包是 NumPy,写来给人读的。批量计算能追回一部分:1000 个状态和一个状态相比,调用次数多不了多少。
# 本章由两台机器人得出耗时线性增长的结论。你同意吗?
# %% [markdown] lang="en"
# **Exercise 49.11.2.** Fit the exponent to times of a whole family of robots. Which ones, and what is to be counted first, you find in your folder.
# %% [markdown] lang="zh"
# **练习 49.11.2。** 对一整族机器人的耗时拟合指数。取哪些机器人,先要数什么,见你的文件夹。
# %%
def growth(sizes, seconds):
    """Return the exponent k with which a time grows, t = c Nᵏ, by least squares on logarithmic axes."""
    return ...


tw.exercises.check("49.11.2", growth)


# %% setup="yes"
def fastest(candidates, rounds=8):
    """Run all in turn, many times, and return the shortest time of each: seconds per call."""
    best = dict.fromkeys(candidates, np.inf)
    for _ in range(rounds):
        for name, (function, times) in candidates.items():
            best[name] = min(best[name], timeit.timeit(function, number=times) / times)
    return best


candidates = {
    "rnea": (lambda: tw.rnea(model, q, v, a), 2),
    "aba": (lambda: tw.aba(model, q, v, tau), 2),
    "crba": (lambda: tw.crba(model, q), 2),
    "centroidal_map": (lambda: tw.centroidal_map(model, q), 2),
    "dynamics": (lambda: tw.dynamics(model, q, v), 1),
}
Q, thousand = np.tile(q, (1000, 1)), rng.standard_normal((1000, 18))
candidates["rnea of 1000"] = (lambda: tw.rnea(model, Q, thousand, thousand), 1)
if pin:
    candidates |= {
        "pin.rnea": (lambda: pin.rnea(P, data, q, pv, pa), 300),
        "pin.aba": (lambda: pin.aba(P, data, q, pv, ptau), 300),
        "pin.crba": (lambda: pin.crba(P, data, q), 300),
        "pin.computeCentroidalMap": (lambda: pin.computeCentroidalMap(P, data, q), 300),
    }
# %%
seconds = fastest(candidates)
seconds["rnea of 1000, each"] = seconds.pop("rnea of 1000") / 1000
unit = "pin.rnea" if pin else "rnea"
ratio = {name: time / seconds[unit] for name, time in sorted(seconds.items(), key=lambda item: item[1])}

ax = plot.axes_2d(size=(7.5, 3.6))
colours = [plot.COLOURS["orange" if name.startswith("pin.") else "blue"] for name in ratio]
ax.bar_label(
    ax.barh(list(ratio), list(ratio.values()), color=colours),
    fmt=lambda x: f" {x:.2g}" if x < 10 else f" {x:.0f}",
    fontsize=8,
)
ax.set(xscale="log", xlabel=f"time, in units of one {unit}", title="Go2, this machine, just now")
ax.set_xlim(min(ratio.values()) / 3, max(ratio.values()) * 4)
plt.show()
# %%
assert ratio["rnea of 1000, each"] < ratio["rnea"] / 3
if pin:
    print(
        ", ".join(f"{name} {ratio[name]:.2f}" for name in ratio if name.startswith("pin.")), "of the time of pin.rnea"
    )
    assert all(0.1 < ratio[name] < 10 for name in ratio if name.startswith("pin."))  # none is of another order
    assert 10 < ratio["rnea"] < 1e5
# %% [markdown] lang="en"
# The chapter's table has CRBA slower than RNEA and ABA at 1.7 times RNEA. Compare your own line above; where this was
# written, CRBA took 0.77 of the time of RNEA: it needs no velocities, and Go2's legs are short.
#
# ## Exercises
#
# - **49.11.1** the seven tests, set right
# - **49.11.2** how RNEA's time grows with $N$
# - **49.11.3** all quantities of a standing Go2, and the forces at its feet
# - **49.11.4** Pinocchio's results in the chapter's order
#
# `twistwrench exercises start my_answers`, then `python -m pytest` in that folder; `twistwrench exercises hint 49.11.1`;
# and `twistwrench exercises status my_answers` shows what is left, project included. That was the last notebook.
# %% [markdown] lang="zh"
# 本章的表格里 CRBA 比 RNEA 慢,ABA 是 RNEA 的 1.7 倍。请和上面你自己的数字比一比;写作本文的机器上,
# CRBA 只用了 RNEA 的 0.77 倍时间:它不需要速度,而 Go2 的腿又短。
#
# ## 练习
#
# - **49.11.1** 七个测试,改到全对
# - **49.11.2** RNEA 的耗时怎样随 $N$ 增长
# - **49.11.3** 站立的 Go2 的所有量,以及它的足端力
# - **49.11.4** 把 Pinocchio 的结果换成本章的顺序
#
# `twistwrench exercises start my_answers --language zh`，然后在那个文件夹里运行 `python -m pytest`；`twistwrench exercises hint 49.11.1` 给提示;
# `twistwrench exercises status my_answers` 显示还剩哪些没做,累积项目也在内。这是最后一个笔记本。

# %% [markdown] lang="en"
# # 49.11 In practice: from the formula to Pinocchio
#
# The last notebook puts everything side by side: each formula of the chapter, the function of this package, the call in
# Pinocchio; the chapter's seven tests, set right; and the four quantities that a controller asks for in every cycle.
#
# Pinocchio is installed with `pip install pin`. The package that is called `pinocchio` on PyPI is something else.
# %% [markdown] lang="zh"
# # 49.11 实操:从公式到 Pinocchio
#
# 最后一个笔记本把一切摆在一起:本章的每个公式、本包里的函数、Pinocchio 里的调用;本章的七个测试(改正之后);
# 以及控制器每个周期都要的四个量。
#
# Pinocchio 用 `pip install pin` 安装。PyPI 上名叫 `pinocchio` 的是另一个软件包。
# %%
import twistwrench as tw

model = tw.load("go2")
# %% setup="yes"
import timeit

import matplotlib.pyplot as plt
import numpy as np
from IPython.display import Markdown, display

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
i, foot = model.joint_id("FR_thigh_joint"), "FR_foot"
# %% [markdown] lang="en"
# ## The map
#
# There is one line for each quantity: its formula, the call here, the call in Pinocchio, and the function of
# `tw.bridge` that converts Pinocchio's result into ours. The last column is the largest difference, in a state drawn at
# random. In Pinocchio `P` is the model, and `pv`, `pa`, `ptau` are our vectors in its order.
# %% [markdown] lang="zh"
# ## 对照表
#
# 每个量一行:公式、本包的写法、Pinocchio 的写法,以及 `tw.bridge` 里把结果换过来的函数。最后一列是在一个随机状态下二者的最大差别。
# Pinocchio 一栏中 `P` 是它的模型,`pv`、`pa`、`ptau` 是按它的顺序排列的向量。
# %% setup="yes"
MAP = [  # formula, here, there, bridge: from_pinocchio_…
    ("τ = M v̇ + h", "tw.rnea(model, q, v, a)", "pin.rnea(P, data, q, pv, pa)", "tangent"),
    ("v̇ = M⁻¹ (τ − h)", "tw.aba(model, q, v, tau)", "pin.aba(P, data, q, pv, ptau)", "tangent"),
    ("M", "tw.crba(model, q)", "pin.crba(P, data, q)", "matrix"),
    ("h", "tw.nonlinear_effects(model, q, v)", "pin.nonLinearEffects(P, data, q, pv)", "tangent"),
    ("g", "tw.gravity(model, q)", "pin.computeGeneralizedGravity(P, data, q)", "tangent"),
    ("C", "tw.coriolis_matrix(model, q, v)", "pin.computeCoriolisMatrix(P, data, q, pv)", "matrix"),
    ("⁰T_i", "tw.forward_kinematics(model, q).placement[i].matrix()", "data.oMi[i].homogeneous", ""),
    ("V_i", "tw.forward_kinematics(model, q, v).twist[i]", "data.v[i].vector", "motion"),
    ("Ad_T = X", "tw.forward_kinematics(model, q).placement[i].motion_transform()", "data.oMi[i].action", "transform"),
    ("Î_i", "model.inertia[i].matrix()", "P.inertias[i].matrix()", "transform"),
    (
        "J_i",
        "tw.frame_jacobian(model, q, foot)",
        "pin.computeFrameJacobian(P, data, q, P.getFrameId(foot), pin.LOCAL)",
        "jacobian",
    ),
    (
        "J_c",
        "tw.contact_jacobian(model, q, [foot])",
        "pin.computeFrameJacobian(P, data, q, P.getFrameId(foot), pin.LOCAL_WORLD_ALIGNED)[:3]",
        "contact_jacobian",
    ),
    ("A_G", "tw.centroidal_map(model, q)", "pin.computeCentroidalMap(P, data, q)", "jacobian"),
    ("h_G", "tw.centroidal_momentum(model, q, v)", "pin.computeCentroidalMomentum(P, data, q, pv).vector", "force"),
    (
        "ḣ_G",
        "tw.centroidal_momentum_rate(model, q, v, a)",
        "pin.computeCentroidalMomentumTimeVariation(P, data, q, pv, pa).vector",
        "force",
    ),
    ("p_G", "tw.center_of_mass(model, q)", "pin.centerOfMass(P, data, q)", ""),
]
WITH_MODEL = ("tangent", "matrix", "jacobian", "contact_jacobian")  # these must know where in v the base is

if pin:
    P = tw.bridge.to_pinocchio_model(model)
    data = P.createData()
    pv, pa, ptau = (tw.bridge.to_pinocchio_tangent(model, x) for x in (v, a, tau))
    pin.forwardKinematics(P, data, q, pv)  # fills data.oMi and data.v

table = ["| | twistwrench | Pinocchio | bridge | largest difference |", "|---|---|---|---|---|"]
for formula, here, there, bridge in MAP:
    ours, shown = np.array(eval(here)), "–"
    if pin:
        theirs = np.array(eval(there))  # a copy: the next call writes over data
        if bridge:
            convert = getattr(tw.bridge, f"from_pinocchio_{bridge}")
            theirs = convert(model, theirs) if bridge in WITH_MODEL else convert(theirs)
        difference, largest = np.abs(ours - theirs).max(), np.abs(ours).max()
        assert difference < 1e-12 * largest, formula
        shown = f"{difference:.0e} of {largest:.3g}"
    table.append(f"| {formula} | `{here}` | `{there}` | {bridge or 'as it is'} | {shown} |")
display(Markdown("\n".join(table)))
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
tw.ask("49.11-eigenvalues", ...)
# %%
tw.ask("49.11-quaternion", ...)
# %%
tw.ask("49.11-risen", ...)


# %% [markdown] lang="en"
# **Exercise 49.11.4.** Call Pinocchio yourself, and return its $A_G$ in the chapter's order. (This one needs Pinocchio.)
# %% [markdown] lang="zh"
# **练习 49.11.4。** 自己调用 Pinocchio,并按本章的顺序返回 $A_G$。(这道题需要安装 Pinocchio。)
# %%
def map_from_pinocchio(model, q):
    """Return the centroidal map of a robot, computed by Pinocchio, in the chapter's order."""
    return ...


tw.exercises.check("49.11.4", map_from_pinocchio)
# %%
numbered = tw.bridge.to_pinocchio_tangent(model, np.arange(18))
print("where Pinocchio's entries of v stand in ours:", numbered.astype(int))
assert np.array_equal(tw.bridge.from_pinocchio_tangent(model, numbered), np.arange(18))

V, F = rng.standard_normal((2, 6))
their_V, their_F = tw.bridge.to_pinocchio_motion(V), tw.bridge.to_pinocchio_force(F)
assert np.array_equal(their_V, [*V[3:], *V[:3]])
assert np.isclose(their_F @ their_V, F @ V)  # power: the same

M = tw.crba(model, q)
figure, axes = plt.subplots(1, 2, figsize=(9.5, 4.8), layout="constrained")
swapped = [*plot.ANGULAR_LINEAR[3:], *plot.ANGULAR_LINEAR[:3]]
leg = [name.removesuffix("_joint") for name in model.joint_names[2:5]]
orders = {"our": (M, plot.ANGULAR_LINEAR), "Pinocchio's": (tw.bridge.to_pinocchio_matrix(model, M), swapped)}
for ax, (whose, (matrix, base)) in zip(axes, orders.items()):
    plot.matrix(matrix[:9, :9], f"M in {whose} order", rows=[*base, *leg], lines=[3, 6], rounding=1e-12, ax=ax)
plt.show()
if pin:
    forgotten = pin.rnea(P, P.createData(), q, v, a)
    right = tw.bridge.to_pinocchio_tangent(model, tw.rnea(model, q, v, a))
    print(f"rnea with v and a in the wrong order: off by {np.abs(forgotten - right).max():.1f} N")
    assert np.abs(forgotten - right).max() > 1
    back = tw.bridge.from_pinocchio_model(P)
    assert np.array_equal(tw.crba(back, q), M)


# %% [markdown] lang="en"
# ## Seven tests
#
# The chapter's listing has seven tests, one at the end of each of its parts. We first run them in the chapter's own
# order, $(\boldsymbol\omega, \boldsymbol v)$, in which its formulas are right:
#
# 1. $\tau$ from RNEA is $M\ddot q + h$.
# 2. ABA solves that for $\ddot q$.
# 3. $\hat I$ from mass, centre of mass and inertia.
# 4. $\mathrm{Ad}_T$ from $R$ and $\boldsymbol p$.
# 5. $h_G = A_G\dot q$.
# 6. $l_G = m v_G$.
# 7. $J_c$ of the four feet: its shape, and its rank.
# %% [markdown] lang="zh"
# ## 七个测试
#
# 本章的代码用七项检查给各节收尾。先按本章自己的顺序 $(\boldsymbol\omega, \boldsymbol v)$ 来做,在这个顺序下它的公式都是对的:
#
# 1. RNEA 的 $\tau$ 等于 $M\ddot q + h$。
# 2. ABA 由此解出 $\ddot q$。
# 3. 由质量、质心和惯量构造 $\hat I$。
# 4. 由 $R$ 和 $\boldsymbol p$ 构造 $\mathrm{Ad}_T$。
# 5. $h_G = A_G\dot q$。
# 6. $l_G = m v_G$。
# 7. 四只脚的 $J_c$:形状和秩。
# %%
def from_blocks(angular, corners, linear):
    """Return a 6 × 6 matrix: the angular block first, and in the corners what couples the two."""
    top, bottom = corners
    return np.block([[angular, top], [bottom, linear]])


def inertia_blocks(m, com, I_c):
    """Return the blocks of a spatial inertia (49.5)."""
    c = tw.skew(com)
    return I_c - m * c @ c, (m * c, -m * c), m * np.eye(3)


def transform_blocks(R, p):
    """Return the blocks of Ad_T (49.3)."""
    return R, (np.zeros((3, 3)), tw.skew(p) @ R), R


d = tw.dynamics(model, q, v)
h_G = tw.centroidal_momentum(model, q, v)
v_G = tw.center_of_mass(model, model.integrate(q, 1e-100j * v)).imag / 1e-100
inertias = [model.inertia[k] for k in (1, 3, 5)]
placements = [tw.forward_kinematics(model, q).placement[k] for k in (1, 4, 7)]

errors = {
    1: d.M @ a + d.h - tw.rnea(model, q, v, a),
    2: np.linalg.solve(d.M, tau - d.h) - tw.aba(model, q, v, tau),
    3: [from_blocks(*inertia_blocks(I.mass, I.com, I.inertia_at_com)) - I.matrix() for I in inertias],
    4: [from_blocks(*transform_blocks(T.rotation, T.translation)) - T.motion_transform() for T in placements],
    5: d.A_G @ v - h_G,
    6: model.mass * v_G - h_G[3:],
}
for test, error in errors.items():
    print(f"test {test}: {np.abs(error).max():.1e}")
    assert np.abs(error).max() < 1e-10
assert d.J_c.shape == (12, 18)
assert np.linalg.matrix_rank(d.J_c) == 12


# %% [markdown] lang="en"
# The listing itself runs on Pinocchio. The chapter expects seven errors of the order of 1e-10. Run it. Do you agree?
# %% [markdown] lang="zh"
# 书上的代码运行在 Pinocchio 上。本章预期七个误差都在 1e-10 量级。运行一下,你同意吗?
# %% [markdown] lang="en"
# **Exercise 49.11.1.** Which of the tests pass, and what must be changed in the others? Here is test 6; the rest is in your folder. What is folded
# below is the answer.
# %% [markdown] lang="zh"
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
# | 3 | 角的块在左上 | 线的块在左上,右上是 $-m[c]_\times$ |
# | 4 | $[p]_\times R$ 在左下 | 在右上 |
# | 6 | `h_G[3:]` | `h_G[:3]` |
# | 7 | `J_full[3:, :]` | `J_full[:3, :]` |
# %% after="49.11.1"
def linear_first(angular, corners, linear):
    """Return the same matrix with the linear block first."""
    return from_blocks(linear, corners[::-1], angular)


def seven(printed):
    """Run the chapter's tests on Pinocchio, as printed or set right: six errors, and the rank of J_c."""
    half = slice(3, 6) if printed else slice(0, 3)  # where the linear part is looked for
    arranged = from_blocks if printed else linear_first
    M, h = pin.crba(P, data, q), pin.rnea(P, data, q, pv, np.zeros(18))
    M = M + M.T - np.diag(M.diagonal()) if printed else M
    inertias, placements = [P.inertias[k] for k in (1, 3, 5)], [data.oMi[k] for k in (1, 4, 7)]
    momentum = pin.computeCentroidalMomentum(P, data, q, pv).vector.copy()
    pin.centerOfMass(P, data, q, pv)
    found = [
        M @ pa + h - pin.rnea(P, data, q, pv, pa),
        np.linalg.solve(M, ptau - h) - pin.aba(P, data, q, pv, ptau),
        [arranged(*inertia_blocks(I.mass, I.lever, I.inertia)) - I.matrix() for I in inertias],
        [arranged(*transform_blocks(T.rotation, T.translation)) - T.action for T in placements],
        pin.computeCentroidalMap(P, data, q) @ pv - momentum,
        model.mass * data.vcom[0] - momentum[half],
    ]
    ids = [P.getFrameId(name) for name in model.feet]
    J_c = [pin.computeFrameJacobian(P, data, q, k, pin.LOCAL_WORLD_ALIGNED)[half] for k in ids]
    return np.array([np.abs(error).max() for error in found]), np.linalg.matrix_rank(np.vstack(J_c))


if pin:
    (as_printed, rank_printed), (mended, rank) = seven(printed=True), seven(printed=False)
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
# `tw.dynamics` is the chapter's `getDynamics`: $M$, $h$, $J_c$, $A_G$ at one state, or only what `want=` names.
# %% [markdown] lang="zh"
# ## 控制器要什么
#
# `tw.dynamics` 就是本章的 `getDynamics`:给出某个状态下的 $M$、$h$、$J_c$、$A_G$,或者只给 `want=` 里点名的几个。
# %% [markdown] lang="en"
# **Exercise 49.11.3.** All four at rest: how much does a front foot of the standing Go2 carry, and how much a rear foot? (Notebook 49.9 has the
# first half of this exercise.)
# %% [markdown] lang="zh"
# **练习 49.11.3。** 四个量,静止时:站立的 Go2 一只前脚承担多少,一只后脚承担多少?(这道题的前一半在笔记本 49.9 里。)
# %%
def standing_loads():
    """Return the vertical forces on a front foot and on a rear foot of Go2 in `model.standing()`: two numbers, N."""
    return ...


tw.exercises.check("49.11.3", standing_loads)
# %%
tw.ask("49.11-rise", ...)
# %% [markdown] lang="en"
# Here is one
# step of a controller. The robot stands on four feet that stay where they are, its trunk is moving, and it is asked to
# brake and to rise with 1 m/s². Three steps: the joints' accelerations from $J_c\ddot q + \dot J_c\dot q = 0$; the feet's
# forces from the base's rows; the torques from the joints' rows.
# %% [markdown] lang="zh"
# 下面是控制器的一步。机器人四脚着地、脚不动,躯干在运动;要求它减速,并以 1 m/s² 的加速度抬起身体。分三步:
# 由 $J_c\ddot q + \dot J_c\dot q = 0$ 求关节加速度,由基座行求足端力,由关节行求力矩。
# %%
stand = model.standing()
J_c = tw.dynamics(model, stand, np.zeros(18), want={"J_c"}).J_c
base_v = np.array([0.2, -0.3, 0.4, 0.1, -0.1, 0.2])
feet_still = np.concatenate([base_v, -np.linalg.solve(J_c[:, 6:], J_c[:, :6] @ base_v)])
assert np.allclose(J_c @ feet_still, 0, atol=1e-12)

d = tw.dynamics(model, stand, feet_still)
J_rate_v = [tw.frame_bias_acceleration(model, stand, feet_still, f, "local_world_aligned")[3:] for f in model.feet]
bias = np.concatenate(J_rate_v)
base_a = -2 * base_v + np.array([0, 0, 0, 0, 0, 1.0])
joint_a = np.linalg.solve(d.J_c[:, 6:], -bias - d.J_c[:, :6] @ base_a)
wanted = np.concatenate([base_a, joint_a])

needed = d.M @ wanted + d.h
lam = np.linalg.lstsq(d.J_c[:, :6].T, needed[:6])[0]
torques = (needed - d.J_c.T @ lam)[6:]
print("vertical forces", lam[2::3].round(1), "N; largest torque", np.abs(torques).max().round(1), "N m")
assert (lam[2::3] > 0).all()  # the ground pushes
assert (np.abs(torques) < model.effort_limit[6:]).all()
# %% [markdown] lang="en"
# To check this, we apply the torques to a robot whose feet are held (by whatever forces this needs), and compute how it
# moves. Eighteen accelerations and twelve forces are unknown, and there are as many equations. And the momentum of the
# whole changes as $A_G$ says:
# %% [markdown] lang="zh"
# 真是这样吗?把这些力矩交给一个脚被固定住的机器人(需要多大的力就给多大),看它怎样运动。未知数是十八个加速度和十二个力,
# 方程也有这么多。整体的动量也照 $A_G$ 说的那样变化:
# %%
S = tw.selection_matrix(model)
both = np.block([[d.M, -d.J_c.T], [d.J_c, np.zeros((12, 12))]])
answer = np.linalg.solve(both, np.concatenate([S.T @ torques - d.h, -bias]))
assert np.allclose(answer[:18], wanted, rtol=1e-10, atol=1e-10)
assert np.allclose(answer[18:], lam, rtol=1e-10, atol=1e-10)

levers = np.array([tw.frame_placement(model, stand, f).translation for f in model.feet]) - tw.center_of_mass(
    model, stand
)
forces = lam.reshape(4, 3)
outside = np.concatenate([np.cross(levers, forces).sum(axis=0), forces.sum(axis=0) + model.mass * model.gravity])
from_motion = d.A_G @ wanted + tw.centroidal_momentum_rate(model, stand, feet_still, np.zeros(18))
assert np.allclose(from_motion, outside, rtol=1e-10, atol=1e-10)

many = tw.dynamics(model, np.tile(stand, (50, 1)), rng.standard_normal((50, 18)))  # fifty states at once
print("in a batch:", {name: getattr(many, name).shape for name in ("M", "h", "J_c", "A_G")})
assert many.M.shape == (50, 18, 18)
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
# %% after="49.11.3"
there_and_back = tw.rnea(model, q, v, tw.aba(model, q, v, tau))
assert np.abs(there_and_back - tau).max() < 1e-12 * np.abs(tw.nonlinear_effects(model, q, v)).max()
share = tw.static_equilibrium(model, stand).forces[:, 2] / (model.mass * 9.81 / 4)
print("each foot carries, in units of mg/4:", share.round(4))
assert 0.005 < np.abs(share - 1).max() < 0.01
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
status = main(["validate", "go2", "--states", "4", "--truths", "1"])
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


# %%
def fastest(candidates, rounds=15):
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

# %% [markdown] lang="en"
# # 49.9 The equation of a floating base
#
# $$M(q)\,\ddot q + h(q, \dot q) = S^T\tau + J_c^T\lambda$$
#
# One line that every controller of a legged robot contains. This notebook takes it apart on a standing Go2: which rows
# the motors reach, how the ground holds the weight, why the forces at the feet are not unique, and what a push does.
# %% [markdown] lang="zh"
# # 49.9 浮动基座全身动力学方程
#
# $$M(q)\,\ddot q + h(q, \dot q) = S^T\tau + J_c^T\lambda$$
#
# 每个腿足机器人的控制器里都有这一行。这个笔记本以站立的 Go2 为例把它拆开来看:电机能影响哪些行,地面怎样托住重量,
# 为什么足端力不唯一,以及推它一下会发生什么。
# %%
import twistwrench as tw

model = tw.load("go2")
q = model.standing()
# %% setup="yes"
import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot

np.set_printoptions(formatter={"float_kind": lambda x: f"{round(x, 3) + 0:7.4g}"})
rng, rest = np.random.default_rng(9), np.zeros(model.nv)
weight = model.mass * 9.81
feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
# %%
d, S = tw.dynamics(model, q, rest), tw.selection_matrix(model)
print({"M": d.M.shape, "h": d.h.shape, "S": S.shape, "J_c": d.J_c.shape})


# %% [markdown] lang="en"
# ## What stands where
#
# Eighteen rows: six for the base, three for each leg. (The chapter writes $\dot q$ for what the code calls `v`: eighteen
# numbers.) **$J_c\dot q$ is the velocity of the feet**, three numbers for each;
# so the columns of $J_c^T$ are what a force at a foot does to the eighteen rows (equal power, 49.4). Go2 walks, turns left,
# and swings its left front leg and its right rear one:
# %% [markdown] lang="zh"
# ## 各个量的位置
#
# 十八行:基座六行,每条腿三行。(本章写的 $\dot q$ 就是代码里的 `v`,有十八个数。)
# **$J_c\dot q$ 就是各只脚的速度**,每只脚三个数;所以 $J_c^T$ 的列就是脚上的力对十八行的作用(功率相等,49.4)。
# Go2 前行、左转,摆动左前腿和右后腿:
# %%
walking = rest.copy()
walking[2], walking[3] = 0.6, 0.8  # rad/s, m/s
walking[[7, 16]], walking[[8, 17]] = -5.0, 4.0  # thighs and calves
foot_velocity = (d.J_c @ walking).reshape(4, 3)
for name, velocity in zip(model.feet, foot_velocity):
    print(name, velocity, "m/s")
# %%
figure = plt.figure(figsize=(7, 4.6), layout="constrained")
ax = plot.robot(model, q, com=False, ax=figure.add_subplot(projection="3d"))
speeds = [f"{np.linalg.norm(velocity):.1f} m/s" for velocity in foot_velocity]
blue = plot.COLOURS["blue"]
plot.arrows(feet, foot_velocity, scale=0.1, colour=blue, label="J_c q̇, velocity of the foot", texts=speeds, ax=ax)
ax.set(xticks=[-0.2, 0.2], yticks=[-0.1, 0.1], zticks=[0, 0.2])
ax.legend(loc="upper left", fontsize=8)
plt.show()
for name, velocity in zip(model.feet, foot_velocity):
    later = tw.frame_placement(model, model.integrate(q, 1e-100j * walking), name).translation
    assert np.allclose(later.imag / 1e-100, velocity, atol=1e-12)


# %% [markdown] lang="en"
# **Exercise 49.9.2.** Write $S^T\tau$ without any matrix; $S$ itself is the other half of the exercise, in your folder.
# %% [markdown] lang="zh"
# **练习 49.9.2。** 不用矩阵,写出 $S^T\tau$;$S$ 本身是这道练习的另一半,在你的文件夹里。
# %%
def on_all_rows(tau):
    """Return Sᵀτ without building S."""
    return ...


tw.exercises.check("49.9.2", on_all_rows)
# %% [markdown] lang="en" after="49.9.2"
# $S^T$ puts the twelve torques into the rows of the joints, and nothing into those of the base.
# %% [markdown] lang="zh" after="49.9.2"
# $S^T$ 把十二个力矩放进关节行,基座行里什么也没有。
# %%
rows = [*plot.ANGULAR_LINEAR, *(name.removesuffix("_joint") for name in model.joint_names[2:])]
figure, axes = plt.subplots(1, 3, figsize=(12, 5.2), width_ratios=[18, 12, 12], layout="constrained")
for ax, A, title in zip(axes, (d.M, S.T, d.J_c.T), ("M", "Sᵀ", "J_cᵀ")):
    plot.matrix(A, title, rows=rows if title == "M" else (), lines=(), rounding=1e-12, ax=ax)
    ax.axhline(5.5, color="k", linewidth=1)
axes[0].axvline(5.5, color="k", linewidth=1)
for k in (2.5, 5.5, 8.5):
    axes[2].axvline(k, color="k", linewidth=1)
axes[2].set_xticks([1, 4, 7, 10], model.feet)
plt.show()

assert not S.T[:6].any()  # no torque in the base's rows
leg_of_column = np.repeat(np.arange(4), 3)
assert (d.J_c.T[6:][leg_of_column[:, None] != leg_of_column] == 0).all()  # a foot's force acts on its own leg …
assert np.array_equal(np.abs(d.J_c.T[3:6]) > 0.5, np.tile(np.eye(3, dtype=bool), 4))  # … and by the base
# %% [markdown] lang="en"
# ## It holds in every state
#
# Is the equation right? Everything is drawn at random. `aba` does not use $J_c$: it gets each foot force as a wrench on the calf. With the
# acceleration that it returns, both sides must agree. (The feet slide and fly. That they stay would be one more equation,
# $J_c\ddot q + \dot J_c\dot q = 0$.)
# %% [markdown] lang="zh"
# ## 在任何状态下都成立
#
# 方程对吗?所有的量都随机抽取。`aba` 不用 $J_c$:每个足端力都作为对小腿的 wrench 交给它。
# 它算出加速度,代回去两边应当相等。(脚会滑动、会腾空。要求脚不动,那是另一个方程 $J_c\ddot q + \dot J_c\dot q = 0$。)
# %%
some_q = model.random_configuration(rng=rng)
some_v, some_tau, some_forces = rng.standard_normal(18), rng.standard_normal(12), 20 * rng.standard_normal((4, 3))


def wrenches(q, forces):
    """Write forces at the feet, in the axes of the world, as wrenches on the bodies that have the feet."""
    f_ext = np.zeros((model.nbodies, 6))
    for name, force in zip(model.feet, forces):
        foot, R = model.frame(name), tw.frame_placement(model, q, name).rotation
        f_ext[foot.body] = foot.placement.force_transform() @ np.concatenate([np.zeros(3), R.T @ force])
    return f_ext


acceleration = tw.aba(model, some_q, some_v, S.T @ some_tau, f_ext=wrenches(some_q, some_forces))
some = tw.dynamics(model, some_q, some_v)
left, right = some.M @ acceleration + some.h, S.T @ some_tau + some.J_c.T @ some_forces.ravel()
print(f"largest difference of the two sides: {np.abs(left - right).max():.1e} of {np.abs(right).max():.0f}")
assert np.abs(left - right).max() < 1e-12 * np.abs(right).max()
# %% [markdown] lang="en"
# ## The base's rows
#
# Cut the equation below the sixth row:
#
# $$M_{bb}\ddot q_b + M_{bj}\ddot q_j + h_b = J_{c,b}^T\lambda, \qquad
# M_{jb}\ddot q_b + M_{jj}\ddot q_j + h_j = \tau + J_{c,j}^T\lambda.$$
#
# The first has no $\tau$: the robot is **underactuated**. Where did the motors go? Cut a standing Go2 free at the hips: the
# trunk feels its weight and what the legs transmit, the motors' torques among it. Cut it free at the feet: what bodies do
# to each other cancels, motors included; only the ground and the weight are left. That is Newton and Euler for the whole
# robot, written at the base: the base's rows.
# %% [markdown] lang="zh"
# ## 基座行
#
# 在第六行下面把方程切开:
#
# $$M_{bb}\ddot q_b + M_{bj}\ddot q_j + h_b = J_{c,b}^T\lambda, \qquad
# M_{jb}\ddot q_b + M_{jj}\ddot q_j + h_j = \tau + J_{c,j}^T\lambda.$$
#
# 第一式里没有 $\tau$:机器人是**欠驱动**的。电机到哪里去了?把站立的 Go2 在髋处切开:躯干受到自己的重力和四条腿传来的力,
# 电机的力矩也在其中。在脚处切开:一个刚体对另一个的作用互相抵消,电机也在内,只剩地面和重力。这就是基座行:
# 整个机器人的牛顿和欧拉方程,写在基座处。
# %%
ground = tw.static_equilibrium(model, q).forces
through = tw.joint_wrenches(model, q, rest, rest, f_ext=wrenches(q, ground))
hips = [i for i in range(2, model.nbodies) if model.parent[i] == 1]
# %%
placement = tw.forward_kinematics(model, q).placement
at_hips = np.array([placement[i].translation for i in hips])
on_trunk = -np.array([placement[i].rotation @ through[i].reshape(2, 3).T for i in hips])  # by each leg: (τ, f)
moments, forces = on_trunk[..., 0], on_trunk[..., 1]
middle, own_weight = placement[1].act(model.inertia[1].com), model.inertia[1].mass * model.gravity
red, purple = plot.COLOURS["vermilion"], plot.COLOURS["purple"]
newtons = [f"{force[2]:.1f} N" for force in forces]
newton_metres = [f"{np.linalg.norm(moment):.1f} N m" for moment in moments]

figure = plt.figure(figsize=(12, 5))
figure.subplots_adjust(0, 0, 1, 0.85, wspace=0)
trunk, whole = (figure.add_subplot(1, 2, k, projection="3d") for k in (1, 2))
trunk.plot(*at_hips[[0, 1, 3, 2, 0]].T, color=plot.COLOURS["grey"], linewidth=4)
plot.arrows(at_hips, forces, scale=0.006, colour=red, label="force of a leg", texts=newtons, ax=trunk)
of_leg = "moment of a leg, its motor's among it"
plot.arrows(at_hips, moments, scale=0.045, colour=purple, label=of_leg, texts=newton_metres, ax=trunk)
plot.arrows(middle, own_weight, scale=0.006 / 3, colour=blue, label="weight, a third as long", ax=trunk)
for text in trunk.texts:
    text.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.5})
trunk.set_title("cut at the hips: the trunk\nI a + V ×* I V = weight + Σ (τ, f) of the legs")
plot.robot(model, q, com=False, ax=whole)
plot.arrows(feet, ground, scale=0.004, colour=red, label="λ, force of the ground", ax=whole)
plot.arrows(tw.center_of_mass(model, q), model.mass * model.gravity, scale=0.004 / 3, colour=blue, ax=whole)
whole.set_title("cut at the feet: the base's rows\nM_bb q̈_b + M_bj q̈_j + h_b = J_c,bᵀ λ")
for ax in (trunk, whole):
    ax.set(xlim=(-0.3, 0.3), ylim=(-0.2, 0.2), zlim=(0, 0.4), box_aspect=(0.6, 0.4, 0.4), yticks=[-0.2, 0, 0.2])
    ax.set(xticks=[-0.2, 0.2], zticks=[0, 0.2, 0.4])
trunk.set(zlim=(0.1, 0.4), box_aspect=(0.6, 0.4, 0.3))
trunk.view_init(elev=38, azim=-55)
trunk.legend(loc="upper left", fontsize=8)
plt.show()
balance = np.cross(at_hips - middle, forces).sum(axis=0) + moments.sum(axis=0)
assert np.allclose(forces.sum(axis=0) + own_weight, 0, atol=1e-10)  # Newton, for the trunk
assert np.allclose(balance, 0, atol=1e-10)  # Euler
assert np.abs(moments[:, 0]).min() > 1  # N m: the motors of the hips
assert np.allclose(d.J_c[:, :6].T @ ground.ravel(), d.h[:6], rtol=1e-12, atol=1e-10)  # for the whole robot
# %% [markdown] lang="en"
# The chapter concludes that contact forces alone decide how the base moves. Do you agree?
# %% [markdown] lang="zh"
# 本章由此说基座的运动完全由接触力决定。你同意吗?
# %%
tw.ask("49.9-kick", ...)


# %% [markdown] lang="en"
# **Exercise 49.9.3.** Choose the accelerations of the joints and the forces at the feet at will. What is then left for the base and for the
# motors? And why is it these six rows that a controller calls the constraint?
# %% [markdown] lang="zh"
# **练习 49.9.3。** 关节加速度和足端力任意选定,基座和电机还剩下什么可选?为什么控制器把恰恰这六行叫作约束?
# %%
def complete_motion(M, h, J_c, qdd_joints, forces):
    """Return the motion and the torques that belong to chosen joint accelerations and contact forces."""
    return ...


tw.exercises.check("49.9.3", complete_motion)
# %% [markdown] lang="en" after="49.9.3"
# Not quite, since $M_{bj}\ddot q_j$ stands there as well: in the air, a motor that swings a leg turns the
# trunk. What no motor can change is the momentum of the whole (49.10).
# %% [markdown] lang="zh" after="49.9.3"
# 其实不尽然,因为式中还有
# $M_{bj}\ddot q_j$:在空中,电机摆动一条腿,躯干就会转。电机改变不了的是整个机器人的动量(49.10)。
# %% after="49.9.3"
knee = model.v_slice[model.joint_id("FL_calf_joint")].start
falling, kicking = tw.aba(model, q, np.zeros((2, 18)), np.stack([rest, np.eye(18)[knee]]))  # the second: 1 N m
change = kicking - falling
print("the base's acceleration changes by", change[:3].round(2), "rad/s² and", change[3:6].round(2), "m/s²")
assert np.abs(change[:6]).max() > 1
assert np.allclose(d.M[:6] @ kicking + d.h[:6], 0, rtol=1e-12, atol=1e-10)  # M_bb a_b + M_bj a_j + h_b = 0
assert np.allclose(d.A_G @ change, 0, rtol=1e-12, atol=1e-12)


# %% [markdown] lang="en"
# ## Standing still
#
# At rest $\dot q = \ddot q = 0$. What is left of the equation, and which of its rows say what?
# %% [markdown] lang="zh"
# ## 静止站立
#
# 静止时 $\dot q = \ddot q = 0$。方程还剩下什么,哪些行说的是什么?
# %% [markdown] lang="en"
# **Exercise 49.9.1.** Write down the equation at rest, and what given torques and forces leave unbalanced in it.
# %% [markdown] lang="zh"
# **练习 49.9.1。** 写出静止时的方程,以及给定力矩和足端力时方程里不平衡的部分。
# %%
def out_of_balance(model, q, tau, forces):
    """Return the residual of the equation of a robot at rest: g − Sᵀτ − J_cᵀλ."""
    return ...


tw.exercises.check("49.9.1", out_of_balance)


# %% [markdown] lang="en"
# **Exercise 49.11.3.** This one belongs to the last section, but its answer would be told here. The chapter fits $g = J_c^T\lambda$ by least
# squares, all eighteen rows. Do you agree? Find the forces of the feet, and the torques.
# %% [markdown] lang="zh"
# **练习 49.11.3。** 这道题属于最后一节,但答案会在这里讲到。本章对 $g = J_c^T\lambda$ 的全部十八行做最小二乘。你同意吗?求足端力和力矩。
# %%
def standing_forces(g, J_c):
    """Return the contact forces and torques that hold a robot at rest."""
    return ...


tw.exercises.check("49.11.3", standing_forces)
# %% [markdown] lang="en" after="49.9.1"
# $h$ is gravity alone: $g = S^T\tau + J_c^T\lambda$. The base's six rows know no
# torques. They say that the feet's forces carry the weight and balance its moment, and they are solved first, for
# $\lambda$. The joints' rows then say what the motors do: $\tau = g_j - J_{c,j}^T\lambda$.
# %% [markdown] lang="zh" after="49.9.1"
# $h$ 只剩重力:$g = S^T\tau + J_c^T\lambda$。基座的六行里没有力矩,说的是足端力要托住重量、
# 平衡重力的力矩,所以先由它们解出 $\lambda$。关节行再给出电机要做什么:$\tau = g_j - J_{c,j}^T\lambda$。
# %% after="49.11.3"
g = tw.gravity(model, q)
lam = np.linalg.lstsq(d.J_c[:, :6].T, g[:6])[0]  # six equations for twelve unknowns: the smallest solution
tau = (g - d.J_c.T @ lam)[6:]

held = tw.static_equilibrium(model, q)  # does the same
assert np.allclose(held.forces.ravel(), lam, rtol=1e-12, atol=1e-10)
assert np.allclose(held.tau, tau, rtol=1e-12, atol=1e-10)
assert np.allclose(S.T @ tau + d.J_c.T @ lam, g, rtol=1e-12, atol=1e-10)
assert np.isclose(held.forces[:, 2].sum(), weight)
assert np.abs(tau).max() < model.effort_limit[6:].min()
# %% after="49.11.3"
ax = plot.foot_forces(model, q, held.forces)
ax.legend(loc="upper left")
plt.show()
print("torques, hip thigh calf, of FL FR RL RR [N m]:", *tau.reshape(4, 3), sep="\n")
# %% [markdown] lang="en" after="49.11.3"
# The dotted line drops from the centre of mass to the floor, inside the polygon between the feet. It lies 1.7 mm behind
# the middle, so the rear feet carry a little more. So "about $mg/4$ each" is only approximately true.
# %% [markdown] lang="zh" after="49.11.3"
# 虚线从质心垂到地面,落在四脚围成的支撑多边形里。它在中心之后 1.7 mm,所以后脚承担得略多。所以"每只脚约 $mg/4$"只是近似成立。
# %% [markdown] lang="en" after="49.11.3"
# The chapter leaves $S^T\tau$ out and fits all eighteen rows by least squares. Foot forces alone cannot hold twelve joints
# as well; the fit is a compromise that satisfies nothing:
# %% [markdown] lang="zh" after="49.11.3"
# 本章漏掉了 $S^T\tau$,对全部十八行做最小二乘。仅靠足端力是撑不住十二个关节的,拟合结果是一个折中,没有一行得到满足:
# %% after="49.11.3"
fitted = np.linalg.lstsq(d.J_c.T, g)[0]
residual = d.J_c.T @ fitted - g
print(f"left over {np.linalg.norm(residual):.1f}; the feet carry {fitted[2::3].sum():.2f} N of {weight:.2f} N")
assert np.isclose(np.linalg.norm(residual), 12.7, atol=0.05)
assert np.isclose(fitted[2::3].sum(), 156.74, atol=0.01)
assert np.abs(residual[:6]).max() > 1  # even the base would accelerate

ax = plot.axes_2d(size=(9, 3.2))
x = np.arange(18)
ax.bar(x - 0.2, residual, 0.4, color=plot.COLOURS["vermilion"], label="all rows fitted, without τ")
ax.bar(x + 0.2, S.T @ tau + d.J_c.T @ lam - g, 0.4, color=plot.COLOURS["blue"], label="base's rows for λ, then τ: zero")
ax.axhline(0, color="k", linewidth=0.8)
ax.axvline(5.5, color="k", linewidth=0.8, linestyle=":")
ax.set_xticks(x, ["τx", "τy", "τz", "fx", "fy", "fz", *rows[6:]], rotation=60, fontsize=8)
ax.set(ylabel="out of balance [N m, N]", title="equilibrium, row by row", ylim=(-7.5, 3))
ax.legend(loc="upper right", fontsize=8)
plt.show()
# %% [markdown] lang="en"
# ## Many ways to stand
#
# Twelve unknowns, six equations: six kinds of change in the forces that the base does not notice, the null space of
# $J_{c,b}^T$. Two of them: pull the feet towards each other, or shift load from one diagonal to the other. How much of the
# two does the base notice?
# %% [markdown] lang="zh"
# ## 站立的方式不止一种
#
# 十二个未知数,六个方程:足端力有一个六维的变化空间,基座察觉不到,它就是 $J_{c,b}^T$ 的零空间。举两个例子:
# 把左右脚往一起拉,或者把载荷从一条对角线移到另一条。基座从中察觉到多少?
# %% thumbnail="yes"
assert np.linalg.matrix_rank(d.J_c[:, :6]) == 6  # so 12 − 6 dimensions are free
squeeze = 15 * np.array([[0, -1, 0], [0, 1, 0], [0, -1, 0], [0, 1, 0]])  # FL, FR, RL, RR
diagonal = 25 * np.array([[0, 0, 1], [0, 0, -1], [0, 0, -1], [0, 0, 1]])
for change in (squeeze, diagonal):
    print("at the base:", d.J_c[:, :6].T @ change.ravel(), "N m and N")

family = {
    "least norm": held.forces,
    "feet pulled together": held.forces + squeeze,
    "more on one diagonal": held.forces + diagonal,
}
figure = plt.figure(figsize=(13, 4.2))
figure.subplots_adjust(0, 0, 1, 0.9, wspace=0.05)
for k, (name, forces) in enumerate(family.items(), start=1):
    torques = (g - d.J_c.T @ forces.ravel())[6:]
    ax = plot.foot_forces(model, q, forces, ax=figure.add_subplot(1, 3, k, projection="3d"))
    ax.set(zlabel="", xticks=[-0.2, 0.2], yticks=[-0.1, 0.1], zticks=[0, 0.2])
    ax.set_title(
        f"{name}: hips up to {np.abs(torques[::3]).max():.1f} N m,\nknees up to {np.abs(torques[2::3]).max():.1f}"
    )
    assert np.allclose(d.J_c[:, :6].T @ forces.ravel(), g[:6], rtol=1e-12, atol=1e-10)  # the base stands in all three
plt.show()
# %% [markdown] lang="en"
# For the base all three are the same. And for the motors?
# %% [markdown] lang="zh"
# 对基座来说三者没有区别。对电机呢?
# %%
tw.ask("49.9-least", ...)
# %% [markdown] lang="en"
# A controller can use this freedom, for example to
# make the torques as small as possible. It must stay within limits: the ground can push but not pull, and friction
# limits how far a force may be inclined (49.4).
# %% [markdown] lang="zh"
# 控制器可以利用这种自由,例如让力矩尽量小。但也要遵守限制:地面只能推、不能拉,
# 而摩擦限制了力能倾斜多少(49.4)。
# %%
free = np.linalg.svd(d.J_c[:, :6].T)[2][6:].T  # twelve rows, six directions without effect on the base
least = np.linalg.lstsq(d.J_c[:, 6:].T @ free, tau)[0]
easy_forces = lam + free @ least
easy_tau = (g - d.J_c.T @ easy_forces)[6:]
assert np.allclose(d.J_c[:, :6].T @ easy_forces, g[:6], rtol=1e-12, atol=1e-10)
print(f"‖τ‖ = {np.linalg.norm(tau):.2f} N m with the least forces, {np.linalg.norm(easy_tau):.2f} N m at best")
assert np.linalg.norm(easy_tau) < 0.95 * np.linalg.norm(tau)
assert np.abs(easy_tau[::3]).max() < 0.01  # the hips have nothing left to do

shift = np.linspace(-60, 60, 121)
vertical = held.forces[:, 2] + shift[:, None] * diagonal[:, 2] / 25
standing = (vertical >= 0).all(axis=1)
print(f"all four push for shifts from {shift[standing].min():.0f} N to {shift[standing].max():.0f} N")

ax = plot.axes_2d(size=(6.5, 3.2))
for column, name, style in zip(vertical.T, model.feet, ("-", "-", "--", "--")):
    ax.plot(
        shift, column, style, label=name, color=plot.COLOURS["blue" if name in ("FL_foot", "RR_foot") else "orange"]
    )
ax.axvspan(shift[standing].min(), shift[standing].max(), color="0.93")
ax.axhline(0, color="k", linewidth=0.8)
ax.set(xlabel="load shifted to the diagonal FL–RR [N]", ylabel="vertical force [N]", title="grey: no foot pulls")
ax.legend(fontsize=8)
plt.show()
assert np.isclose(shift[standing].max(), vertical[60].min(), atol=1)  # until the first foot is empty
# %% [markdown] lang="en"
# ## A push
#
# Somebody pushes the trunk to the left with up to 100 N, and the robot is to stay at rest. (On the site you are the one who
# pushes: [Four feet under a push](../hands/feet.md).)
# %% [markdown] lang="zh"
# ## 推一下
#
# 有人向左推躯干,最大 100 N,而机器人要保持静止。(在网站上可以自己动手推:[四只脚与一次推力](../hands/feet.md)。)
# %%
tips = tw.ask("49.9-tipping", ...)
tips
# %% [markdown] lang="en"
# `rnea` takes the push as
# `f_ext` and returns what the ground must supply. Vertical load moves to the left feet; the **centre of pressure**, the
# mean of the foot positions weighted with it, moves by push × height / weight:
# %% [markdown] lang="zh"
# `rnea` 把推力当作 `f_ext`,算出地面必须提供什么。竖直载荷移向左脚;
# **压力中心**,即以竖直力为权的脚位置平均值,移动了 推力 × 高度 / 重量:
# %%
pushes = np.linspace(0, 100, 51)
f_ext = np.zeros((51, model.nbodies, 6))
f_ext[:, 1, 4] = pushes  # on the base, at its origin, along y: the base is level, so its axes are the world's
needed = tw.rnea(model, q, rest, rest, f_ext=f_ext)[:, :6]
loads = np.linalg.lstsq(d.J_c[:, :6].T, needed.T)[0].T.reshape(51, 4, 3)
assert np.allclose(d.J_c[:, :6].T @ loads.reshape(51, 12, 1), needed[..., None], rtol=1e-12, atol=1e-10)

pressure = (loads[..., 2:] * feet).sum(axis=1) / weight
height, half_width = q[2], feet[0, 1]
assert np.allclose(loads[..., 2].sum(axis=1), weight)  # a level push changes nothing about the weight
assert np.allclose(pressure[:, 1], pushes * height / weight, rtol=1e-12, atol=1e-12)
tipping = weight * half_width / height
print(f"the right feet are empty at {tipping:.1f} N")
assert np.interp(tipping, pushes, loads[:, [1, 3], 2].sum(axis=1)) < 1e-9
# %%
figure = plt.figure(figsize=(13.5, 4))
figure.subplots_adjust(0, 0.1, 1, 0.9, wspace=0.2)
spatial, above, chart = figure.add_subplot(131, projection="3d"), figure.add_subplot(132), figure.add_subplot(133)
plot.foot_forces(model, q, loads[30], ax=spatial)
plot.arrows(q[:3] - [0, 0.24, 0], [0, 60, 0], scale=0.004, colour=plot.COLOURS["blue"], label="push: 60 N", ax=spatial)
spatial.set(xticks=[-0.2, 0.2], yticks=[-0.1, 0.1], zticks=[0, 0.2])
spatial.view_init(elev=15, azim=-25)
spatial.legend(loc="upper left", fontsize=8)

corners = plot.hull(feet)[:, :2]
above.fill(*corners.T, facecolor=plot.COLOURS["sky"], alpha=0.35)
inside = pushes <= tipping
above.plot(*pressure[inside][::5, :2].T, "o", color=plot.COLOURS["purple"], label="centre of pressure, every 10 N")
above.plot(*pressure[~inside][::5, :2].T, "x", color=plot.COLOURS["vermilion"], label="feet would have to pull")
above.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="from above", ylim=(-0.2, 0.3))
above.legend(fontsize=8, loc="upper right")

left_feet, right_feet = loads[:, [0, 2], 2].sum(axis=1), loads[:, [1, 3], 2].sum(axis=1)
chart.plot(pushes, left_feet, color=plot.COLOURS["blue"], label="left feet")
chart.plot(pushes, right_feet, color=plot.COLOURS["orange"], label="right feet")
chart.axvline(tipping, color="k", linestyle=":")
chart.axhline(0, color="k", linewidth=0.8)
chart.set(xlabel="push [N]", ylabel="vertical force [N]", title="the left feet take over")
chart.legend(fontsize=8)
tips.draw(chart)
plt.show()
# %% [markdown] lang="en"
# Beyond the dotted line, the centre of pressure would have to lie outside the polygon, which is impossible with forces that only
# push. So the robot must move, or it tips over.
# %% [markdown] lang="zh"
# 超过虚线处的推力,压力中心就得跑到多边形外面。只能推的足端力做不到这一点:机器人要么移动,要么翻倒。
# %% [markdown] lang="en"
# ## Pinocchio
#
# `getFrameJacobian` has the *linear* rows first: a point contact takes rows 0 to 2.
# %% [markdown] lang="zh"
# ## 与 Pinocchio 对照
#
# `getFrameJacobian` 的*线速度*行在前:点接触取第 0 到 2 行。
# %%
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    ids = [pin_model.getFrameId(foot) for foot in model.feet]
    full = [pin.computeFrameJacobian(pin_model, data, q, i, pin.LOCAL_WORLD_ALIGNED) for i in ids]
    linear, angular = np.vstack([J[:3] for J in full]), np.vstack([J[3:] for J in full])
    assert np.abs(tw.bridge.from_pinocchio_contact_jacobian(model, linear) - d.J_c).max() < 1e-12
    assert (np.linalg.matrix_rank(linear), np.linalg.matrix_rank(angular)) == (12, 9)

    theirs = pin.computeGeneralizedGravity(pin_model, data, q)
    assert np.abs(tw.bridge.from_pinocchio_tangent(model, theirs) - g).max() < 1e-12 * weight
    print("the same J_c, and the same g")
# %% [markdown] lang="en"
# ## For engineers: the rank of $J_c$
#
# The chapter warns that a straight knee makes $J_c$ lose rank. It does make the leg's own 3 × 3 Jacobian singular: the
# foot can no longer move along the leg. We stretch all four legs.
# %% [markdown] lang="zh"
# ## 给工程师:$J_c$ 的秩
#
# 本章警告说,膝伸直会使 $J_c$ 降秩。单条腿自己的 3 × 3 雅可比矩阵确实会奇异:脚再也不能沿腿的方向移动。我们把四条腿一起伸直。
# %%
tw.ask("49.9-stretch", ...)
# %% [markdown] lang="en"
# The smallest singular value of a leg's own Jacobian, and that of $J_c$, which has the base's columns as well. They
# compensate for what each leg has lost, as long as the four directions do not depend on each other:
# %% [markdown] lang="zh"
# 单条腿的雅可比矩阵的最小奇异值,与 $J_c$ 的最小奇异值。$J_c$ 还含有基座的列,只要四条腿失去的方向彼此不相关,它们就能补上:
# %%
bend = np.linspace(1.8, 0, 46)
stretched = np.tile(q, (46, 1))
stretched[:, 8::3], stretched[:, 9::3] = bend[:, None] / 2, -bend[:, None]  # thighs and calves
J_c = tw.contact_jacobian(model, stretched, model.feet)
of_leg = np.linalg.svd(J_c[:, :3, 6:9])[1].min(axis=-1)
of_all = np.linalg.svd(J_c)[1].min(axis=-1)
assert of_leg[-1] < 1e-12
assert of_all.min() > 0.05
assert np.linalg.matrix_rank(J_c[-1]) == 12

ax = plot.axes_2d(size=(6, 3.2))
ax.semilogy(np.rad2deg(bend[:-1]), of_leg[:-1], color=plot.COLOURS["vermilion"], label="one leg by itself")
ax.semilogy(np.rad2deg(bend), of_all, color=plot.COLOURS["blue"], label="J_c: four feet and a free base")
ax.set(xlabel="bend of the knees [°]", ylabel="smallest singular value", title="stretching the legs", ylim=(1e-3, 1))
ax.set_yticks([0.001, 0.01, 0.1, 1], ["0.001", "0.01", "0.1", "1"])
ax.invert_xaxis()
ax.legend()
plt.show()
# %% [markdown] lang="en"
# Go2's hips are 95.5 mm wide, so with the hip joints at 0 the legs lean outward. Turn each hip until the foot is right
# below it.
# %% [markdown] lang="zh"
# Go2 的髋宽 95.5 mm,髋关节为 0 时腿向外斜。再转动髋关节,让每只脚都在髋的正下方。
# %%
tw.ask("49.9-upright", ...)
# %% [markdown] lang="en"
# No motion can change the length of one of four parallel legs alone, so how they share the load is not determined.
# %% [markdown] lang="zh"
# 四条腿平行时,任何运动都不能只改变一条腿的长度,它们怎样分担重量也就无法确定。
# %%
upright = stretched[-1].copy()
upright[7::3] = np.array([-1, 1, -1, 1]) * np.arctan2(0.0955, 0.426)  # hips, rad: width and length of a leg
of_upright = np.linalg.svd(tw.contact_jacobian(model, upright, model.feet))[1]
print(f"smallest singular value {of_upright.min():.4f}, the next {of_upright[-2]:.4f}")
assert of_upright.min() < 1e-12 < 1e-2 < of_upright[-2]
# %% [markdown] lang="en"
# And contacts on the same link?
# %% [markdown] lang="zh"
# 同一根连杆上有两处接触呢?
# %%
tw.ask("49.9-calf", ...)
# %%
twice = tw.contact_jacobian(model, q, ["FL_foot", "FL_calf"])
assert np.linalg.matrix_rank(twice) == 5
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.9.1** the equation of a robot that stands still, and why the ground must carry the weight
# - **49.9.2** $S$ by hand, and the first six entries of $S^T\tau$
# - **49.9.3** why the base's rows are called the dynamics constraint
#
# `twistwrench exercises start my_answers`, then `python -m pytest` in that folder; `twistwrench exercises hint 49.9.1`.
# Next: notebook 49.10.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.9.1** 静止站立时的方程;地面为什么必须托住重量
# - **49.9.2** 手动构造 $S$；$S^T\tau$ 的前六个元素
# - **49.9.3** 基座行为什么叫"动力学约束"
#
# `twistwrench exercises start my_answers --language zh`,然后在那个文件夹里运行 `python -m pytest`；`twistwrench exercises hint 49.9.1` 给提示。
# 下一个:笔记本 49.10。

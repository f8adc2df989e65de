# %% [markdown] lang="en"
# # 49.4 Wrenches
#
# A wrench is a force on a rigid body in six numbers, $\boldsymbol F = (\boldsymbol\tau, \boldsymbol f)$: its moment about
# the origin of the frame, and the force. This notebook shows what it has to do with a twist, how it changes frame, which
# screw hides in it, and what the ground can and cannot do to a foot.
# %% [markdown] lang="zh"
# # 49.4 Wrench(空间力)
#
# Wrench 用六个数表示作用在刚体上的力,$\boldsymbol F = (\boldsymbol\tau, \boldsymbol f)$:对坐标系原点的力矩,再加上力。
# 这个笔记本说明它与 twist 的关系,换坐标系时怎样变,里面藏着怎样的螺旋,以及地面能对脚做什么、不能做什么。
# %%
import twistwrench as tw

model = tw.load("go2")
q = model.standing()
# %% setup="yes"
import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot

q[:2] = 0.6, 0.3
v = np.zeros(model.nv)
v[2], v[3] = 0.6, 0.8  # the base turns left at 0.6 rad/s and walks at 0.8 m/s
# %% [markdown] lang="en"
# ## Power: what a wrench is for
#
# The base turns left at 0.6 rad/s and walks at 0.8 m/s. Somebody pushes the robot's nose forward and to the left, $\boldsymbol f = (10, 15, 0)$ N at
# $\boldsymbol r = (0.28, 0, 0)$ m of the base. About the base's origin that is the wrench
# $(\boldsymbol r \times \boldsymbol f, \boldsymbol f)$. The power of the push is the force times the velocity of the
# *nose*, $\boldsymbol f \cdot (\boldsymbol v + \boldsymbol\omega \times \boldsymbol r)$. Turn the triple product round,
# and the nose is gone:
#
# $$P = \boldsymbol f^T \boldsymbol v + (\boldsymbol r \times \boldsymbol f)^T \boldsymbol\omega = \boldsymbol F^T
# \boldsymbol V.$$
#
# So a wrench is what turns a twist into watts. This is why $\boldsymbol\tau$ stands where $\boldsymbol\omega$ stands, and
# $\boldsymbol f$ where $\boldsymbol v$ does. A twist and a wrench live in different spaces, dual to each other: you can
# pair them, you cannot add them.
# %% [markdown] lang="zh"
# ## 功率:wrench 的用处
#
# 基座以 0.6 rad/s 左转,以 0.8 m/s 前行。有人向左前方推机器人的前端:在基座坐标系的 $\boldsymbol r = (0.28, 0, 0)$ m 处,$\boldsymbol f = (10, 15, 0)$ N。
# 对基座原点来说,这就是 wrench $(\boldsymbol r \times \boldsymbol f, \boldsymbol f)$。推力的功率等于力乘以
# *前端*的速度,$\boldsymbol f \cdot (\boldsymbol v + \boldsymbol\omega \times \boldsymbol r)$。把混合积轮换一下,
# 式中就不再出现前端的速度:
#
# $$P = \boldsymbol f^T \boldsymbol v + (\boldsymbol r \times \boldsymbol f)^T \boldsymbol\omega = \boldsymbol F^T
# \boldsymbol V.$$
#
# 所以 wrench 的作用,就是由 twist 得到功率。正因为如此,$\boldsymbol\tau$ 与 $\boldsymbol\omega$ 放在同一位置,
# $\boldsymbol f$ 与 $\boldsymbol v$ 放在同一位置。Twist 和 wrench 属于两个互为对偶的空间:可以配对,不能相加。
# %%
r, f = np.array([0.28, 0, 0]), np.array([10.0, 15.0, 0])
F = np.concatenate([np.cross(r, f), f])  # of the push, in the base's frame
V = v[:6]  # of the base, in its own frame

assert np.isclose(tw.power(F, V), f @ plot.point_velocity(V, r))
assert np.isclose(tw.Wrench(F, frame="base") @ tw.Twist(V, frame="base"), tw.power(F, V))
try:
    tw.Wrench(F) + tw.Twist(V)
except TypeError as error:
    print(error)
else:
    raise AssertionError("a wrench has been added to a twist")
# %% [markdown] lang="en"
# ## Action and reaction
#
# The ground pushes a foot, and the foot pushes the ground: two forces, equal and opposite, on *one* line. Their moments
# about any point are then opposite too, so Newton's third law holds for all six numbers. If the ground gives the foot
# the wrench $\boldsymbol F$, the foot gives the ground $-\boldsymbol F$, both in the same frame. In the picture the robot is
# lifted off the ground, so that you see what acts on which body.
# %% [markdown] lang="zh"
# ## 作用力与反作用力
#
# 地面推脚,脚也推地面:两个力大小相等、方向相反,而且在*同一条*直线上。于是对任何一点的力矩也相反,牛顿第三定律对六个数全都成立。
# 地面给脚的 wrench 是 $\boldsymbol F$,脚给地面的就是 $-\boldsymbol F$,两者在同一个坐标系里。图中把机器人从地面提了起来,好看清每个力作用在谁身上。
# %%
ax = plot.axes_2d(size=(8, 5.5))
stand, gap = model.standing(), 0.15  # m: the robot is drawn higher by this
held = tw.static_equilibrium(model, stand)
lifted = stand.copy()
lifted[2] += gap
plot.side_view(model, lifted, com=False, ax=ax)
ax.fill([-0.5, 0.5, 0.5, -0.5], [-0.17, -0.17, 0, 0], facecolor="0.9", edgecolor="0.4")
for name, force in list(zip(model.feet, held.forces))[1::2]:
    x, _, z = tw.frame_placement(model, stand, name).translation
    length = force[2] / 300
    ax.plot([x, x], [z, z + gap], ":", color=plot.COLOURS["black"])
    for tip, colour, text in [(z + gap + length, "green", "F"), (z - length, "purple", "−F")]:
        start = z + gap if tip > z else z
        ax.annotate(
            "", (x, tip), (x, start), arrowprops={"arrowstyle": "-|>", "color": plot.COLOURS[colour], "lw": 2.5}
        )
        ax.text(x + 0.02, (tip + start) / 2, text, color=plot.COLOURS[colour], fontsize=12)
ax.plot([], [], color=plot.COLOURS["green"], linewidth=2.5, label="on the robot, by the ground")
ax.plot([], [], color=plot.COLOURS["purple"], linewidth=2.5, label="on the ground, by the robot")
ax.plot([], [], ":", color=plot.COLOURS["black"], label="one line")
ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=3)
plt.show()
# %% [markdown] lang="en"
# The two act on different bodies, so they do not cancel. In the balance of a body stands what acts *on* it, and never what
# it does to others. It is the same in a joint. The thigh passes $\boldsymbol F$ on to the calf, and the calf gives
# $-\boldsymbol F$ back. Together they have the power
#
# $$\boldsymbol F^T \boldsymbol V_{calf} - \boldsymbol F^T \boldsymbol V_{thigh} =
# \boldsymbol F^T (\boldsymbol V_{calf} - \boldsymbol V_{thigh}) = \tau\,\dot q:$$
#
# only the relative motion counts, and that is the knee's. Of the six numbers in the joint the motor has one, and it does
# all the work.
# %% [markdown] lang="zh"
# 一个作用在机器人上,一个作用在地面上,所以不会抵消。列某个刚体的平衡方程,只写别的物体作用在*它上面*的力,不写它作用于别的物体的力。关节里也是一样。大腿把
# $\boldsymbol F$ 传给小腿,小腿还给大腿 $-\boldsymbol F$。两者的总功率是
#
# $$\boldsymbol F^T \boldsymbol V_{calf} - \boldsymbol F^T \boldsymbol V_{thigh} =
# \boldsymbol F^T (\boldsymbol V_{calf} - \boldsymbol V_{thigh}) = \tau\,\dot q:$$
#
# 只与相对运动有关,也就是膝的运动。关节里的六个数,电机只出其中一个,功却全是它做的。
# %%
kneeling = np.zeros(model.nv)
kneeling[2:4], kneeling[6:9] = (0.6, 0.8), (0.5, 2.0, -3.0)  # the walk, and the front left leg bends
terms, knee = tw.rnea_terms(model, stand, kneeling, np.zeros(model.nv)), model.joint_id("FL_calf_joint")
thigh, calf = tw.forward_kinematics(model, stand).placement[knee - 1 : knee + 1]
thigh_to_calf = (calf.inverse() @ thigh).motion_transform()
relative = terms.V[knee] - thigh_to_calf @ terms.V[knee - 1]
on_calf = terms.F[knee] @ terms.V[knee]
on_thigh = -(thigh_to_calf.T @ terms.F[knee]) @ terms.V[knee - 1]
motor = terms.tau[model.v_slice[knee]] @ kneeling[model.v_slice[knee]]
assert np.allclose(relative, model.joints[knee].subspace() @ kneeling[model.v_slice[knee]], atol=1e-14)
assert np.isclose(on_calf + on_thigh, motor, rtol=1e-12)
assert not np.isclose(on_calf, motor, rtol=0.2)  # each of the two alone is no property of the motor
# %% [markdown] lang="en"
# ## The same watts in every frame
#
# The power does not depend on the frame: it is the same in the frame $B$ of the base, in the world $A$, and in the
# frame of a foot. The twist changes by $\boldsymbol V_A = X \boldsymbol V_B$ (49.3). Then $\boldsymbol F_A^T X
# \boldsymbol V_B = \boldsymbol F_B^T \boldsymbol V_B$ for every twist, and that fixes how a wrench must change:
#
# $$\boldsymbol F_B = X^T \boldsymbol F_A, \qquad \boldsymbol F_A = X^{-T} \boldsymbol F_B = X^* \boldsymbol F_B,
# \qquad X^* = \begin{pmatrix} R & [\boldsymbol p]_\times R \\ 0 & R \end{pmatrix}.$$
#
# Written out, $\boldsymbol f_A = R \boldsymbol f_B$ and
# $\boldsymbol\tau_A = R \boldsymbol\tau_B + \boldsymbol p \times R \boldsymbol f_B$: the force only turns, the moment
# also gets the lever $\boldsymbol p$. The coupling that stands bottom left in $X$ stands top right in $X^*$. Note that
# $X^*$ is not $X^T$: the transpose leads the *other way*, from $A$ to $B$. On the site you move $B$, and watch twelve
# numbers change while the power does not: [Two frames](../hands/frames.md).
# %% [markdown] lang="zh"
# ## 功率与坐标系无关
#
# 换坐标系不会改变功率:无论在基座坐标系 $B$、世界 $A$ 还是脚的坐标系里,功率必须相同。Twist 按
# $\boldsymbol V_A = X \boldsymbol V_B$ 变换(49.3)。于是对任意 twist 都有
# $\boldsymbol F_A^T X \boldsymbol V_B = \boldsymbol F_B^T \boldsymbol V_B$，wrench 的变换规则也就定下来了:
#
# $$\boldsymbol F_B = X^T \boldsymbol F_A, \qquad \boldsymbol F_A = X^{-T} \boldsymbol F_B = X^* \boldsymbol F_B,
# \qquad X^* = \begin{pmatrix} R & [\boldsymbol p]_\times R \\ 0 & R \end{pmatrix}.$$
#
# 展开就是 $\boldsymbol f_A = R \boldsymbol f_B$ 和
# $\boldsymbol\tau_A = R \boldsymbol\tau_B + \boldsymbol p \times R \boldsymbol f_B$:力只需旋转,力矩还要加上力臂
# $\boldsymbol p$ 的一项。耦合项在 $X$ 里位于左下,在 $X^*$ 里位于右上。注意 $X^*$ 不是 $X^T$:转置走的是*反方向*,
# 从 $A$ 到 $B$。在网站上可以拖动 $B$,看着十二个数一起变,功率却不变:[两个坐标系](../hands/frames.md)。
# %%
base = tw.forward_kinematics(model, q).placement[1]
foot = tw.frame_placement(model, q, "FR_foot")
X, X_star = foot.motion_transform(), foot.force_transform()
assert np.allclose(X_star, np.linalg.inv(X).T, atol=1e-12)
assert not np.allclose(X_star, X.T)

figure, axes = plt.subplots(1, 2, figsize=(9, 4.6), layout="constrained")
plot.matrix(X, "X, for twists: foot to world", rows=plot.ANGULAR_LINEAR, columns=plot.ANGULAR_LINEAR, ax=axes[0])
wrench_names = ["τx", "τy", "τz", "fx", "fy", "fz"]
plot.matrix(X_star, "X*, for wrenches: foot to world", rows=wrench_names, columns=wrench_names, ax=axes[1])
plt.show()
# %% [markdown] lang="en"
# Now the push in five frames. The chapter calls its two parts "translational" and "rotational" power.
# %% [markdown] lang="zh"
# 现在把这一推放到五个坐标系里看。本章把它的两部分叫作"平动功率"和"转动功率"。
# %%
tw.ask("49.4-parts", ...)
# %% [markdown] lang="en"
# Each bar is the power, split into the part of the force and the part of the moment. The sum is the same in all frames, up
# to rounding. The two parts are not: each depends on where you put the origin.
# %% [markdown] lang="zh"
# 每根柱子是功率,分成力的部分和力矩的部分。总和都相同(只差舍入误差)。这两部分却不同:各自取决于原点放在哪里。
# %%
frames = {  # each one placed in the world
    "base": base,
    "nose": base @ tw.SE3(np.eye(3), r),
    "foot": foot,
    "world": tw.SE3.identity(),
    "3 m off": tw.SE3(np.eye(3), [-1.9, 2.0, 0]),
}
parts = {}
for name, T in frames.items():
    to_frame = T.inverse() @ base  # the base, placed in this frame
    F_there, V_there = to_frame.force_transform() @ F, to_frame.motion_transform() @ V
    parts[name] = F_there[3:] @ V_there[3:], F_there[:3] @ V_there[:3]
    assert np.isclose(sum(parts[name]), tw.power(F, V), rtol=1e-13)
force_part, moment_part = np.array(list(parts.values())).T
assert np.ptp(force_part) > 10  # W: this is no property of the push
assert np.isclose(moment_part[1], 0)  # about the nose the push has no moment

ax = plot.axes_2d(size=(7, 3.2))
x = np.arange(len(parts))
ax.bar(x - 0.18, force_part, 0.32, color=plot.COLOURS["sky"], label="f · v")
ax.bar(x + 0.18, moment_part, 0.32, color=plot.COLOURS["orange"], label="τ · ω")
ax.plot(x, force_part + moment_part, "D", color=plot.COLOURS["black"], label="power")
ax.axhline(0, color="k", linewidth=0.8)
ax.set(xticks=x, xticklabels=parts, ylabel="W", title="one push, five frames")
ax.legend(loc="center left", bbox_to_anchor=(1, 0.5))
plt.show()


# %% [markdown] lang="en"
# ## What a foot gets from the ground
#
# Each foot of Go2 is a small rubber ball. A contact that small is a **point contact**: it transmits a force, but no
# moment about itself.
# %% [markdown] lang="zh"
# ## 地面给脚的 wrench
#
# Go2 的足端是小橡胶球。这么小的接触就是**点接触**:能传递力,对接触点本身没有力矩。
# %% [markdown] lang="en"
# **Exercise 49.4.1.** The frame of a foot is fixed to the calf and leans with it. Write the force of the ground as a wrench in that frame.
# %% [markdown] lang="zh"
# **练习 49.4.1。** 脚坐标系固定在小腿上,随小腿倾斜。把地面的力写成这个坐标系里的 wrench。
# %%
def foot_wrench(model, q, foot):
    """Return the wrench of the ground on one foot, in the foot's own frame."""
    return ...


tw.exercises.check("49.4.1", foot_wrench)


# %% [markdown] lang="en"
# **Exercise 49.4.2.** Now take it to the world. Nobody has added a moment; is there one? Compute it in two ways.
# %% [markdown] lang="zh"
# **练习 49.4.2。** 再把它变到世界坐标系。没有人施加力矩,现在有力矩吗?用两种办法计算。
# %%
def contact_wrench(R, p, f_c):
    """Return the wrench of a point contact in the world frame, computed in two ways."""
    return ...


tw.exercises.check("49.4.2", contact_wrench)
# %% [markdown] lang="en" after="49.4.2"
# In a frame at the foot the wrench is $(\boldsymbol 0, \boldsymbol f)$, three numbers in place of six. Seen from
# the origin of the world the very same force has the moment $\boldsymbol p \times \boldsymbol f$: nothing was added, the
# moment is now taken about another point.
# %% [markdown] lang="zh" after="49.4.2"
# 在脚处的坐标系里,wrench 是
# $(\boldsymbol 0, \boldsymbol f)$,六个数只剩三个。从世界原点看,同一个力却有力矩 $\boldsymbol p \times \boldsymbol f$:
# 并没有多出什么,只是力矩换了一个参考点来取。
# %% [markdown] lang="en"
# In one frame, wrenches add. The four feet together balance the weight, in
# force *and* in moment:
# %% [markdown] lang="zh"
# 在同一个坐标系里,wrench 可以相加。四只脚合起来与重力平衡,
# 不光是力,*力矩*也平衡:
# %%
held = tw.static_equilibrium(model, q)
at_foot = np.concatenate([np.zeros((4, 3)), held.forces], axis=-1)  # (0, f), in the axes of the world
places = np.array([tw.frame_placement(model, q, name).translation for name in model.feet])
in_world = np.matvec(tw.force_transform(np.eye(3), places), at_foot)
assert np.allclose(in_world[:, :3], np.cross(places, held.forces))
weight = model.mass * model.gravity
of_gravity = np.concatenate([np.cross(tw.center_of_mass(model, q), weight), weight])
assert np.allclose(in_world.sum(axis=0) + of_gravity, 0, atol=1e-12)
# %%
ax = plot.robot(model, q)
for place in places:
    ax.plot(*np.stack([np.zeros(3), place], axis=-1), ":", color=plot.COLOURS["grey"], linewidth=1)
plot.arrows(places, held.forces, scale=0.006, label="f at each foot", ax=ax)
colour = plot.COLOURS["blue"]
plot.arrows(np.zeros(3), in_world[:, :3], scale=0.01, colour=colour, label="moment about the origin", ax=ax)
for name, moment in zip(model.feet, in_world[:, :3]):
    behind_tip = 0.01 * moment + 0.05 * moment / np.linalg.norm(moment)
    ax.text(*behind_tip, name[:2], color=colour, fontsize=9, ha="center", va="center")
ax.text(0, 0, 0.03, "origin of the world", ha="center", fontsize=9)
ax.view_init(elev=35, azim=-75)
ax.legend(loc="upper left")
plt.show()
# %% [markdown] lang="en"
# The dotted lines are the levers; each moment is at right angles to its lever and to the force.
# %% [markdown] lang="zh"
# 虚线是力臂;每个力矩都垂直于自己的力臂,也垂直于力。
# %% [markdown] lang="en" after="49.4.1"
# The chapter's first exercise makes Go2 12 kg heavy. The description used here has 16.085 kg with its rotors: 39.45 N for
# each foot on average. Unitree's own has no rotors and 15.019 kg.
# %% [markdown] lang="zh" after="49.4.1"
# 本章第一道练习里的 Go2 是 12 kg。这里所用的模型带转子,是 16.085 kg,平均每只脚 39.45 N;宇树自己的模型不带转子,是 15.019 kg。
# %% [markdown] lang="en"
# ## From wrenches to joints
#
# A force at a foot moves the joints as well. The foot's Jacobian gives the velocity of the foot, $\boldsymbol v_i = J_i v$;
# equal power, $\boldsymbol f_i^T J_i v = (J_i^T \boldsymbol f_i)^T v$, shows how its force enters the equation of motion:
# by $J_i^T$. For all feet that is $J_c^T \boldsymbol\lambda$. The same thing another way: hand the wrench to `rnea` as
# `f_ext`, on the body that carries the foot and in its frame.
# %% [markdown] lang="zh"
# ## 从 wrench 到关节
#
# 脚上的力也会带动关节。脚的雅可比矩阵给出脚的速度,$\boldsymbol v_i = J_i v$;由功率相等,
# $\boldsymbol f_i^T J_i v = (J_i^T \boldsymbol f_i)^T v$,可知力以 $J_i^T$ 进入运动方程。所有脚合起来就是
# $J_c^T \boldsymbol\lambda$。也可以换条路:把 wrench 作为 `f_ext` 交给 `rnea`,放在带着这只脚的刚体上,用它自己的坐标系。
# %%
J_c = tw.contact_jacobian(model, q, model.feet)  # 12 × 18
lam = held.forces.ravel()
assert np.isclose(lam @ (J_c @ v), (J_c.T @ lam) @ v)

f_ext = np.zeros((model.nbodies, 6))
kin = tw.forward_kinematics(model, q)
for name, wrench in zip(model.feet, in_world):
    body = model.frames[name].body
    f_ext[body] = kin.placement[body].inverse().force_transform() @ wrench  # from the world to the body
rest = np.zeros(model.nv)
assert np.allclose(tw.rnea(model, q, rest, rest) - tw.rnea(model, q, rest, rest, f_ext), J_c.T @ lam)
assert np.allclose(tw.rnea(model, q, rest, rest, f_ext)[:6], 0, atol=1e-12)  # no force is needed at the base
# %% [markdown] lang="en"
# ## The screw of a wrench
#
# As every twist is a turning about an axis and a sliding along it, every wrench is a force along an axis and a moment
# about it. The axis runs along $\boldsymbol f$ through $\boldsymbol f \times \boldsymbol\tau / |\boldsymbol f|^2$; the
# pitch $h = \boldsymbol f^T\boldsymbol\tau / |\boldsymbol f|^2$ is the moment per newton, in metres. With $h = 0$ it is a pure
# force. A couple has $\boldsymbol f = 0$ and infinite pitch.
# %% [markdown] lang="zh"
# ## Wrench 的螺旋
#
# 每个 twist 都是绕一条轴转动并沿它滑动;同样,每个 wrench 都是沿一条轴的力加上绕它的力矩。轴的方向是
# $\boldsymbol f$,经过点 $\boldsymbol f \times \boldsymbol\tau / |\boldsymbol f|^2$;螺距
# $h = \boldsymbol f^T\boldsymbol\tau / |\boldsymbol f|^2$ 是每牛顿力所带的力矩,单位是米。$h = 0$ 时是纯力。力偶的
# $\boldsymbol f = 0$,螺距无穷大。
# %%
tw.ask("49.4-four", ...)
# %%
tw.ask("49.4-couple", ...)
# %%
together = tw.Wrench(in_world.sum(axis=0), frame="world").screw()
assert np.isclose(together.pitch, 0, atol=1e-12)
assert np.allclose(together.point[:2], tw.center_of_mass(model, q)[:2])

couple = tw.screw([0, 0, 5.0, 0, 0, 0], of="wrench")
assert couple.pitch == np.inf
for p in np.random.default_rng(0).standard_normal((9, 3)):  # the same about every point
    assert np.array_equal(tw.force_transform(np.eye(3), p) @ [0, 0, 5.0, 0, 0, 0], [0, 0, 5.0, 0, 0, 0])
# %% [markdown] lang="en"
# Now a moment of a trot: only two feet stand, front left and rear right, and push sideways to turn the robot.
# %% [markdown] lang="zh"
# 再看小跑中的一瞬:只有左前脚和右后脚着地,它们向侧面蹬,让机器人转身。
# %%
tw.ask("49.4-axis", ...)
# %% [markdown] lang="en"
# Together that is a screw with a pitch. Both feet carry the same here, so its axis runs through the middle between them. The cones are what friction
# allows at a point, the **friction cone** $\sqrt{f_x^2 + f_y^2} \le \mu f_z$, here with $\mu = 0.6$: a force inside does
# not slip.
# %% [markdown] lang="zh"
# 合起来是一个有螺距的螺旋。这里两只脚
# 承担的力相同,所以轴经过两脚的正中。圆锥是摩擦在一个点上所允许的力,即**摩擦锥**
# $\sqrt{f_x^2 + f_y^2} \le \mu f_z$,这里 $\mu = 0.6$:力在锥内,脚就不打滑。
# %%
mu = 0.6
stance, push = places[[0, 3]], np.array([[-12.0, 18.0, 78.9], [12.0, -18.0, 78.9]])
at_stance = np.concatenate([np.zeros((2, 3)), push], axis=-1)
trot = tw.Wrench(np.matvec(tw.force_transform(np.eye(3), stance), at_stance).sum(axis=0), frame="world")
axis, point, pitch, magnitude = trot.screw()
print(f"{magnitude:.1f} N along the axis, {pitch * magnitude:.2f} N m about it: pitch {1000 * pitch:.1f} mm")

assert (np.hypot(push[:, 0], push[:, 1]) < mu * push[:, 2]).all()  # no foot slips
assert np.isclose(magnitude, push[:, 2].sum())  # the sideways forces cancel
assert np.allclose(point[:2], stance.mean(axis=0)[:2])
assert np.isclose(pitch * magnitude, np.cross(stance[0] - stance[1], push[0])[2])  # what is left of them is a moment
about_axis = trot.moment - np.cross(point, trot.force)
assert np.allclose(about_axis, pitch * trot.force)  # about its axis, and only there, the moment is along the force
# %% thumbnail="yes"
ax = plot.robot(model, q)
for k, place in enumerate(stance):
    plot.friction_cone(place, mu, height=0.14, label=None if k else "friction cone", ax=ax)
plot.arrows(stance, push, scale=0.003, label="force of the ground", ax=ax)
middle = tw.center_of_mass(model, q)
plot.screw_axis(trot, length=0.7, near=middle, colour=plot.COLOURS["blue"], label="axis of the two together", ax=ax)
ax.view_init(elev=22, azim=-70)
ax.legend(loc="upper left")
plt.show()
# %% [markdown] lang="en"
# ## Reciprocal screws: forces that do no work
#
# Put both screws into the power. If the wrench has the axis through $\boldsymbol q_F$ and the pitch $h_F$, and the twist
# the axis through $\boldsymbol q_V$ and the pitch $h_V$, then the origin drops out:
#
# $$P = \boldsymbol F^T \boldsymbol V = (h_F + h_V)\,\boldsymbol f \cdot \boldsymbol\omega
# + (\boldsymbol q_F - \boldsymbol q_V) \cdot (\boldsymbol f \times \boldsymbol\omega).$$
#
# This is what power means in the language of screws: pitches, the angle between the axes, and their distance. If $P = 0$
# the screws are **reciprocal**.
# %% [markdown] lang="zh"
# ## 互易螺旋:不做功的力
#
# 把两个螺旋都代入功率。设 wrench 的轴经过 $\boldsymbol q_F$,螺距为 $h_F$;twist 的轴经过 $\boldsymbol q_V$,螺距为
# $h_V$。这时原点消去了:
#
# $$P = \boldsymbol F^T \boldsymbol V = (h_F + h_V)\,\boldsymbol f \cdot \boldsymbol\omega
# + (\boldsymbol q_F - \boldsymbol q_V) \cdot (\boldsymbol f \times \boldsymbol\omega).$$
#
# 这才是功率的螺旋解释:两个螺距、两轴的夹角、两轴的距离。$P = 0$ 时称两个螺旋**互易**。
# %%
tw.ask("49.4-hip", ...)
# %% [markdown] lang="en"
# A pure force and a hinge ($h_F = h_V = 0$) are reciprocal if their lines meet or are parallel. You use this whenever you look at a leg: a force of the ground whose line meets the axis of a joint asks
# nothing of that motor. Below, a force on the right front foot aims at a point of the hip's axis.
# %% [markdown] lang="zh"
# 纯力与旋转关节($h_F = h_V = 0$)互易,
# 当且仅当两条直线相交或平行。观察一条腿时经常用到这一点:地面反力的作用线如果与某个关节轴相交,这个关节的电机就不必出力。
# 下面,右前脚上的力正好指向髋关节轴上的一点。
# %%
V, F = np.random.default_rng(4).standard_normal((2, 6))
of_V, of_F = tw.screw(V), tw.screw(F, of="wrench")
distance = (of_F.point - of_V.point) @ np.cross(F[3:], V[:3])
assert np.isclose((of_F.pitch + of_V.pitch) * (F[3:] @ V[:3]) + distance, F @ V)

hip = model.joint_id("FR_hip_joint")
axis_point = tw.forward_kinematics(model, q).placement[hip].act(np.array([0.05, 0, 0]))  # the hip turns about x
foot = tw.frame_placement(model, q, "FR_foot").translation
J = tw.contact_jacobian(model, q, ["FR_foot"])
torques = J.T @ (axis_point - foot)  # a force along the line from the foot to the axis
assert np.isclose(torques[model.v_slice[hip]], 0, atol=1e-15)
assert np.abs(torques[6:]).max() > 0.01  # the other motors of the leg are not spared


# %% [markdown] lang="en"
# ## A sole can do more, but not everything
#
# A humanoid has soles: a **surface contact**, six numbers. Think of the pressure under the sole as forces at its four
# corners. Each can only push. The forces together act at one point of the sole, about which there is no tangential
# moment, the **centre of pressure** (COP).
# %% [markdown] lang="zh"
# ## 脚底能做得更多,但不是什么都行
#
# 人形机器人有脚底:这是**面接触**,六个数都在。把脚底的压力想成四个角上的力,每个力只能推,不能拉。这些力合起来
# 作用在脚底的一个点上,对这个点没有切向力矩,它叫**压力中心**(COP)。
# %% [markdown] lang="en"
# **Exercise 49.4.3.** Where is it, given the wrench? And why can it not leave the sole? What is folded below is the answer.
# %% [markdown] lang="zh"
# **练习 49.4.3。** 已知 wrench,它在哪里?为什么它不会跑出脚底?下面折叠的就是答案。
# %%
def center_of_pressure(F):
    """Return the centre of pressure of a sole."""
    return ...


tw.exercises.check("49.4.3", center_of_pressure)
# %% [markdown] lang="en" after="49.4.3"
# With $\tau_x = \sum y_i f_i$ and $\tau_y = -\sum x_i f_i$ it is
#
# $$x_{COP} = \frac{\sum x_i f_i}{\sum f_i} = -\frac{\tau_y}{f_z}, \qquad y_{COP} = \frac{\sum y_i f_i}{\sum f_i} =
# \frac{\tau_x}{f_z},$$
#
# an average of the corners with weights $f_i \ge 0$. An average cannot leave the sole: that is all there is to
# $|\tau_x| \le d_y f_z$ and $|\tau_y| \le d_x f_z$.
# %% [markdown] lang="zh" after="49.4.3"
# 由 $\tau_x = \sum y_i f_i$ 和
# $\tau_y = -\sum x_i f_i$ 得
#
# $$x_{COP} = \frac{\sum x_i f_i}{\sum f_i} = -\frac{\tau_y}{f_z}, \qquad y_{COP} = \frac{\sum y_i f_i}{\sum f_i} =
# \frac{\tau_x}{f_z},$$
#
# 也就是四个角以 $f_i \ge 0$ 为权的平均。平均不会跑出脚底:$|\tau_x| \le d_y f_z$ 和 $|\tau_y| \le d_x f_z$
# 说的就是这件事。
# %% after="49.4.3"
human = tw.load("humanoid")
sole = tw.frame_placement(human, human.standing(), "left_sole")
corner_names = [f"left_sole_{corner}" for corner in ("fl", "fr", "rr", "rl")]
corners = np.array(
    [sole.inverse().act(tw.frame_placement(human, human.standing(), name).translation) for name in corner_names]
)
d_x, d_y = np.abs(corners).max(axis=0)[:2]
print(f"half a sole: {1000 * d_x:.1f} mm long, {1000 * d_y:.1f} mm wide")


def wrench_of(forces):
    """Wrench of forces at the corners, in the frame of the sole."""
    return np.concatenate([np.cross(corners, forces), forces], axis=-1).sum(axis=-2)


rng = np.random.default_rng(1)
pressure = rng.exponential(25.0, (5000, 4))  # N, at the corners: they push
slope, turned = mu * rng.random((5000, 4)), rng.uniform(0, 2 * np.pi, (5000, 4))
rubbing = pressure[..., None] * np.stack([slope * np.cos(turned), slope * np.sin(turned), np.ones((5000, 4))], axis=-1)
feet = wrench_of(rubbing)  # 5000 wrenches that the ground can bring about
cop = tw.center_of_pressure(feet)
assert (np.abs(cop[:, 0]) <= d_x).all()
assert (np.abs(cop[:, 1]) <= d_y).all()
assert (np.abs(feet[:, 0]) <= d_y * feet[:, 5]).all()
assert (np.abs(feet[:, 1]) <= d_x * feet[:, 5]).all()
# %% [markdown] lang="en"
# Three ways to stand, seen from above: quietly (the least forces at eight corners that hold the robot), about to tip
# forward, and beyond: there the heel would have to be *glued* to the floor. The numbers are the forces at the corners.
# %% [markdown] lang="zh"
# 三种站法,从上往下看:平稳站立(撑住机器人的八个角上的最小力);快要向前倒;已经越界:脚跟得*粘*在地上才行。
# 数字是四个角上的力。
# %%
eight = corner_names + [name.replace("left", "right") for name in corner_names]
quiet = tw.static_equilibrium(human, human.standing(), eight).forces[:4]
stands = {"quiet": wrench_of(quiet)}
for name, x_cop in {"about to tip": 0.95 * d_x, "impossible": 1.4 * d_x}.items():
    total = quiet.sum(axis=0)
    stands[name] = np.concatenate([np.cross([x_cop, 0, 0], total), total])

G = np.array([[*np.cross(corner, [0, 0, 1]), 0, 0, 1] for corner in corners]).T  # four forces to one wrench
figure, axes = plt.subplots(1, 3, figsize=(8, 4.4), layout="constrained", sharey=True)
for ax, (name, wrench) in zip(axes, stands.items()):
    least = np.linalg.lstsq(G, wrench)[0]
    assert np.allclose(G @ least, wrench, atol=1e-9)
    assert (least.min() >= 0) == (name != "impossible")
    plot.sole(corners, wrench, text="COP" if name == "quiet" else "", ax=ax)
    for (x, y, _), force in zip(corners, least):
        ax.text(
            y, x + np.copysign(0.003, x), f"{force:.0f} N", ha="center", va="bottom" if x > 0 else "top", fontsize=9
        )
    ax.set(title=name, xlim=(0.05, -0.05), ylim=(-0.1, 0.13))
plt.show()
assert abs(tw.center_of_pressure(stands["impossible"])[0]) > d_x
# %% [markdown] lang="en"
# The chapter's table stops there: friction cone and COP. One moment is left without a bound, the one about the normal.
# %% [markdown] lang="zh"
# 本章的表格到此为止:摩擦锥加 COP。还有一个力矩没有界,就是绕法向的那个。
# %%
largest_moment = tw.ask("49.4-spin", ...)
largest_moment
# %% [markdown] lang="en"
# Friction limits it too. No corner pushes sideways with more than $\mu f_i$, and none is further than
# $\sqrt{d_x^2 + d_y^2}$ from the middle: so $|\tau_z| \le \mu f_z \sqrt{d_x^2 + d_y^2}$. A controller that forgets this
# asks the ground for what it does not give, and the robot spins on its sole.
# %% [markdown] lang="zh"
# 摩擦同样限制它:每个角的侧向力都不超过
# $\mu f_i$,离中心都不超过 $\sqrt{d_x^2 + d_y^2}$,所以 $|\tau_z| \le \mu f_z \sqrt{d_x^2 + d_y^2}$。忘掉这一条的控制器
# 会向地面要它给不出的力矩,机器人就在脚底上打转。
# %%
reach = np.hypot(d_x, d_y)
assert (np.abs(feet[:, 2]) <= mu * feet[:, 5] * reach).all()
assert (np.abs(feet[:, 2]) / feet[:, 5]).max() > 0.5 * mu * reach  # and the bound is not far off

twisting = np.array([0, 0, 100.0, 0, 0, 98.1])  # 100 N m about the normal
assert np.hypot(*twisting[3:5]) <= mu * twisting[5]  # within the friction cone
assert np.allclose(tw.center_of_pressure(twisting), 0)  # its COP in the middle of the sole
ax = plot.axes_2d(size=(7, 3))
ax.hist(98.1 * np.abs(feet[:, 2]) / feet[:, 5], bins=60, color=plot.COLOURS["sky"], label="5000 ways to press and rub")
ax.axvline(98.1 * mu * reach, color=plot.COLOURS["black"], label="the bound")
largest_moment.draw(ax)
ax.set(xlabel="moment about the normal, of 98.1 N on the sole [N m]", yticks=[])
ax.legend(loc="upper center")
plt.show()
print(f"friction gives {mu * twisting[5] * reach:.1f} N m at most, not {twisting[2]:.0f}")
assert twisting[2] > 10 * mu * twisting[5] * reach
# %% [markdown] lang="en"
# ## For engineers
#
# Nothing later needs this; come back to it when you write a program.
#
# ### Pinocchio agrees
#
# Its `Force` stores the force first, $(\boldsymbol f, \boldsymbol\tau)$; `SE3.act` applies $X^*$ to a `Force` and $X$ to
# a `Motion`, so the type decides. `tw.bridge` does the reordering.
# %% [markdown] lang="zh"
# ## 给工程师
#
# 后面用不到这一部分,等到自己写程序时再看也不迟。
#
# ### 与 Pinocchio 对照
#
# 它的 `Force` 把力存在前面,$(\boldsymbol f, \boldsymbol\tau)$；`SE3.act` 对 `Force` 用 $X^*$,对 `Motion` 用 $X$,由类型决定。
# 换序交给 `tw.bridge`。
# %%
try:
    import pinocchio as pin
except ImportError:
    pin = None
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    T = tw.bridge.to_pinocchio_se3(base)
    force, motion = pin.Force(tw.bridge.to_pinocchio_force(F)), pin.Motion(tw.bridge.to_pinocchio_motion(V))
    ours = base.force_transform() @ F
    assert np.allclose(force.vector[:3], F[3:])  # force first
    assert np.abs(tw.bridge.from_pinocchio_force(T.act(force)) - ours).max() < 1e-12 * np.abs(ours).max()
    assert np.isclose(T.act(motion).dot(T.act(force)), tw.power(F, V), rtol=1e-13)

# %%
if pin:
    pin_model = tw.bridge.to_pinocchio_model(model)
    wrenches = tw.bridge.to_pinocchio_f_ext(model, f_ext)
    theirs = pin.rnea(pin_model, pin_model.createData(), q, rest, rest, wrenches)
    ours = tw.rnea(model, q, rest, rest, f_ext)
    assert np.abs(tw.bridge.from_pinocchio_tangent(model, theirs) - ours).max() < 1e-12 * np.abs(lam).max()
    print("torques of a leg that stands", ours[6:9].round(3), "N m, in both")
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.4.1** the contact wrench of one foot of a standing Go2
# - **49.4.2** where the moment comes from when the point of reference moves to the world's origin
# - **49.4.3** the COP, and why it has to lie in the support polygon
#
# `twistwrench exercises start my_answers` puts them into a folder; `python -m pytest` there checks your answers;
# `twistwrench exercises hint 49.4.2` helps. Next: notebook 49.5.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.4.1** Go2 站立时一只脚的接触 wrench
# - **49.4.2** 参考点移到世界原点,力矩从哪里来
# - **49.4.3** COP,以及它为什么必须在支撑多边形内
#
# `twistwrench exercises start my_answers --language zh` 把练习放进一个文件夹,在那里运行 `python -m pytest` 检查答案,
# `twistwrench exercises hint 49.4.2` 给提示。下一个:笔记本 49.5。

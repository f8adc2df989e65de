# %% [markdown] lang="en"
# # 49.2 Twists
#
# A twist is the velocity of a rigid body in six numbers,
# $\boldsymbol V = (\boldsymbol\omega, \boldsymbol v)$: how fast it turns, and how fast the point of it moves that is
# now at the origin of the frame. This notebook shows what the six numbers mean in two frames, how they become a motion,
# and the screw that hides in them.
# %% [markdown] lang="zh"
# # 49.2 Twist(空间速度)
#
# Twist 用六个数表示刚体的速度,$\boldsymbol V = (\boldsymbol\omega, \boldsymbol v)$:转得多快,以及刚体上此刻位于坐标系原点的
# 那个点移动得多快。这个笔记本说明这六个数在两种坐标系里各是什么意思,怎样由它们得到运动,以及藏在里面的螺旋。
# %%
import twistwrench as tw

model = tw.load("go2")
q = model.standing()
# %% setup="yes"
import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot

q[:2] = 1.0, 0.5
v = np.zeros(model.nv)
v[2], v[3] = 0.6, 0.8  # the base turns left at 0.6 rad/s and walks at 0.8 m/s
# %% [markdown] lang="en"
# ## One motion, two twists
#
# Let $T(t)$ be the placement of a body in the world. Its rate $\dot T$ is a 4 × 4 matrix; multiplied by $T^{-1}$ from
# one side or the other it becomes a twist:
#
# $$[\boldsymbol V_{body}] = T^{-1}\dot T, \qquad [\boldsymbol V_{spatial}] = \dot T\, T^{-1}.$$
#
# Here Go2 stands at (1, 0.5) m, turns left at 0.6 rad/s and walks at 0.8 m/s, its joints locked.
#
# We can do exactly what the definitions say. With complex numbers a derivative needs no small difference: $f(x + ih)$ has
# $h f'(x)$ as its imaginary part, and $h$ may be as small as $10^{-100}$.
# %% [markdown] lang="zh"
# ## 一个运动,两种 twist
#
# 设 $T(t)$ 是刚体在世界中的位姿。它的导数 $\dot T$ 是 4 × 4 矩阵,从一边或另一边乘上 $T^{-1}$,就得到 twist：
#
# $$[\boldsymbol V_{body}] = T^{-1}\dot T, \qquad [\boldsymbol V_{spatial}] = \dot T\, T^{-1}.$$
#
# 这里 Go2 在 (1, 0.5) m 处,以 0.6 rad/s 左转,以 0.8 m/s 前行,关节锁死。
#
# 我们就照这个定义来算。用复数求导不需要做差分:$f(x + ih)$ 的虚部是 $h f'(x)$,而 $h$ 可以小到 $10^{-100}$。
# %%
tw.ask("49.2-origin", ...)
# %%
h = 1e-100
T = tw.frame_placement(model, q, "FR_foot").matrix()
T_dot = tw.frame_placement(model, model.integrate(q, 1j * h * v), "FR_foot").matrix().imag / h

body = tw.vee(np.linalg.inv(T) @ T_dot)
spatial = tw.vee(T_dot @ np.linalg.inv(T))
print("body twist    ", body.round(3) + 0.0)
print("spatial twist ", spatial.round(3) + 0.0)

assert np.allclose(tw.frame_jacobian(model, q, "FR_foot", "local") @ v, body, atol=1e-14)
assert np.allclose(tw.frame_jacobian(model, q, "FR_foot", "world") @ v, spatial, atol=1e-14)
# %% [markdown] lang="en"
# The **body twist** is what a passenger on the foot measures, in the axes of the foot: its linear part is the velocity of
# the foot. The **spatial twist** is what is seen from the world: its linear part is the velocity of the point of the
# foot's body that passes through the *world's origin* now. Usually there is no material at that point; imagine the body
# extended to it.
#
# How are the two related? From the first definition $\dot T = T\,[\boldsymbol V_{body}]$. Put this into the second:
#
# $$[\boldsymbol V_{spatial}] = \dot T\,T^{-1} = T\,[\boldsymbol V_{body}]\,T^{-1}.$$
#
# This holds for any two frames whose placement relative to each other is $T$. Written for six numbers instead of a 4 × 4
# matrix it is one multiplication, $\boldsymbol V_{spatial} = X\,\boldsymbol V_{body}$; section 49.3 multiplies it out.
# %% [markdown] lang="zh"
# **Body twist** 是坐在脚上的乘客按脚的坐标轴量到的:线速度部分就是脚的速度。**Spatial twist** 是站在世界里看到的:
# 线速度部分是脚这个刚体上此刻经过*世界原点*的那个点的速度。那里通常没有材料,请想象刚体一直延伸到那里。
#
# 两者有什么关系?由第一个定义得 $\dot T = T\,[\boldsymbol V_{body}]$,代入第二个:
#
# $$[\boldsymbol V_{spatial}] = \dot T\,T^{-1} = T\,[\boldsymbol V_{body}]\,T^{-1}.$$
#
# 任何两个坐标系,只要相对位姿是 $T$,都有这个关系。不写成 4 × 4 矩阵而写成六个数,就是一次乘法
# $\boldsymbol V_{spatial} = X\,\boldsymbol V_{body}$;49.3 把它展开。
# %%
R, p = T[:3, :3], T[:3, 3]
assert np.allclose(R @ body[3:], T_dot[:3, 3])  # the velocity of the foot
assert np.allclose(spatial[3:], T_dot[:3, 3] + np.cross(spatial[:3], -p))  # of the point at the world's origin
assert np.allclose(T @ tw.hat(body) @ np.linalg.inv(T), tw.hat(spatial))
assert np.allclose(tw.motion_transform(R, p) @ body, spatial)


# %% [markdown] lang="en"
# **Exercise 49.2.1.** Only the base turns, about its own z axis. What is the body twist of the foot, and why does it have a linear velocity?
# %% [markdown] lang="zh"
# **练习 49.2.1。** 只有基座绕自身 z 轴转动。脚的 body twist 是什么?脚为什么有线速度?
# %%
def foot_twist(model, q, omega_z):
    """Return the body twist of FR_foot while only the base turns, about its own z axis."""
    return ...


tw.exercises.check("49.2.1", foot_twist)
# %% [markdown] lang="en"
# ## A twist is a field of velocities
#
# Given the six numbers, every point of space has a velocity, $\boldsymbol v + \boldsymbol\omega \times \boldsymbol p$.
# All joints are locked here, so the whole robot has one spatial twist. The body twist of any part of it reads the field
# where that part is; the spatial twist reads it at the origin.
# %% [markdown] lang="zh"
# ## Twist 是一个速度场
#
# 给定这六个数,空间中每一点都有速度 $\boldsymbol v + \boldsymbol\omega \times \boldsymbol p$。这里关节全部锁死,
# 所以整个机器人只有一个 spatial twist。各部分的 body twist 是在自己所在处读这个场,spatial twist 是在原点读。
# %%
tw.ask("49.2-centre", ...)
# %%
spatial_of = {name: tw.frame_jacobian(model, q, name, "world") @ v for name in ("base", "FR_foot", "RL_calf")}
assert all(np.allclose(V, spatial, atol=1e-15) for V in spatial_of.values())

grid = np.stack(np.meshgrid(np.arange(-1, 3.1, 0.5), np.arange(-1, 3.1, 0.5)), axis=-1).reshape(-1, 2)
field = plot.point_velocity(spatial, np.pad(grid, [(0, 0), (0, 1)]))  # of points on the floor

ax = plot.axes_2d(size=(6.5, 6))
for stick in plot.sticks(model, q):
    ax.plot(*stick[:, :2].T, color=plot.COLOURS["grey"], linewidth=3)
arrow = {"angles": "xy", "scale_units": "xy", "scale": 4}  # 1 m/s is 0.25 m long
ax.quiver(*grid.T, *field[:, :2].T, color=plot.COLOURS["sky"], **arrow)
ax.quiver(0, 0, *spatial[3:5], color=plot.COLOURS["vermilion"], label="v of the spatial twist", **arrow)
ax.quiver(*p[:2], *(R @ body[3:])[:2], color=plot.COLOURS["purple"], label="v of the foot's body twist", **arrow)
ax.plot(*tw.screw(spatial).point[:2], "o", color=plot.COLOURS["blue"], label="axis of the motion, end on")
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="from above")
ax.legend(loc="upper left", framealpha=1)
plt.show()
# %% [markdown] lang="en"
# The field turns about a vertical line, 0.8 / 0.6 = 1.33 m to the left of the base: the centre of the curve that the
# robot walks. On that line nothing moves.
# %% [markdown] lang="zh"
# 这个场绕着一条竖直线转,它在基座左侧 0.8 / 0.6 = 1.33 m 处:机器人所走弧线的圆心。线上的点不动。
# %%
centre = tw.screw(spatial).point
assert np.allclose(centre, [1.0, 0.5 + 0.8 / 0.6, 0])
assert np.allclose(plot.point_velocity(spatial, np.array([centre, centre + np.array([0, 0, 1])])), 0, atol=1e-15)


# %% [markdown] lang="en"
# ## From a twist to a motion: hat and exp
#
# `hat` writes a twist as the 4 × 4 matrix of $\mathfrak{se}(3)$, `vee` reads it back. If the body twist stays constant,
# then $\dot T = T\,[\boldsymbol V]$ has the solution $T(t) = T(0)\,e^{[\boldsymbol V] t}$.
#
# Take $\boldsymbol V = (0, 0, \omega, v, 0, 0)$, the walk from above.
# %% [markdown] lang="zh"
# ## 从 twist 到运动:hat 与 exp
#
# `hat` 把 twist 写成 $\mathfrak{se}(3)$ 中的 4 × 4 矩阵,`vee` 再读回来。若 body twist 保持不变,
# 那么 $\dot T = T\,[\boldsymbol V]$ 的解是 $T(t) = T(0)\,e^{[\boldsymbol V] t}$。
#
# 取 $\boldsymbol V = (0, 0, \omega, v, 0, 0)$,也就是上面的行走。
# %% [markdown] lang="en"
# **Exercise 49.2.2.** Find $e^{[\boldsymbol V]}$ exactly, here at $t = 1$ s; $[\boldsymbol V]$ itself is the first half of the exercise, in your
# folder. What is folded below is the answer.
# %% [markdown] lang="zh"
# **练习 49.2.2。** 求 $e^{[\boldsymbol V]}$ 的精确解,这里取 $t = 1$ s;$[\boldsymbol V]$ 本身是练习的前一半,在你的文件夹里。下面折叠的就是答案。
# %%
def arc(omega_z, v_x):
    """Return the placement exp([V]∧ t) at t = 1 s, V = (0, 0, omega_z, v_x, 0, 0), exactly."""
    return ...


tw.exercises.check("49.2.2", arc)
# %% [markdown] lang="en" after="49.2.2"
# The heading is $\omega t$, the velocity $v\,(\cos\omega t, \sin\omega t)$; its integral is the position, a circle of radius $v/\omega$:
#
# $$e^{[\boldsymbol V]t} = \begin{pmatrix} \cos\omega t & -\sin\omega t & 0 & \frac{v}{\omega}\sin\omega t \\
# \sin\omega t & \cos\omega t & 0 & \frac{v}{\omega}(1 - \cos\omega t) \\ 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \end{pmatrix}.$$
# %% [markdown] lang="zh" after="49.2.2"
# 朝向是 $\omega t$,速度是
# $v\,(\cos\omega t, \sin\omega t)$,积分得到位置,是半径 $v/\omega$ 的圆:
#
# $$e^{[\boldsymbol V]t} = \begin{pmatrix} \cos\omega t & -\sin\omega t & 0 & \frac{v}{\omega}\sin\omega t \\
# \sin\omega t & \cos\omega t & 0 & \frac{v}{\omega}(1 - \cos\omega t) \\ 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \end{pmatrix}.$$
# %% after="49.2.2"
V = v[:6]
assert np.array_equal(tw.vee(tw.hat(V)), V)

w, speed, times = V[2], V[3], np.linspace(0, 2 * np.pi / V[2], 13)
walk = tw.exp6(times[:, None] * V)  # thirteen placements at once
x, y = speed / w * np.sin(w * times), speed / w * (1 - np.cos(w * times))
assert np.allclose(walk.translation, np.stack([x, y, 0 * x], axis=-1), atol=1e-14)
assert np.allclose(tw.log6(walk)[1:6], times[1:6, None] * V)  # and back, up to half a turn
# %%
tw.ask("49.2-straight", ...)
# %%
step = np.eye(4) + tw.hat(V) * times[1]
straight = np.array([np.linalg.matrix_power(step, k) for k in range(13)])  # the same in twelve straight steps

ax = plot.axes_2d(size=(6.5, 5))
ax.plot(*tw.exp6(np.linspace(0, times[-1], 200)[:, None] * V).translation[:, :2].T, color=plot.COLOURS["grey"])
for k, colour in enumerate(plot.XYZ[:2]):  # the body's x and y axes
    ax.quiver(x, y, walk.rotation[:, 0, k], walk.rotation[:, 1, k], color=colour, width=0.006, scale=18)
for t, where in zip(times[:-1], 1.25 * (walk.translation - [0, speed / w, 0]) + [0, speed / w, 0]):
    ax.text(*where[:2], f"{t:.1f} s", fontsize=8, ha="center", va="center")
ax.plot(*straight[:, :2, 3].T, ".--", color=plot.COLOURS["purple"], label="1 + [V] t in place of exp, in twelve steps")
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="from above", ylim=(-5, 5))
ax.legend(loc="lower right")
plt.show()

stretched = np.linalg.det(straight[-1, :3, :3])
print(
    f"after one round the straight steps have det R = {stretched:.1f}; exp has {np.linalg.det(walk.rotation[-1]):.1f}"
)
assert stretched > 10
# %% [markdown] lang="en"
# That is why `model.integrate` uses exp, and why a quaternion that is advanced by $q + \dot q\,dt$ must be normalised.
#
# ## The screw
#
# At every instant a rigid body turns about some line and slides along the same line (Mozzi, 1763). Chasles's theorem of
# 1830 says the same of a finite displacement, so the two are named together. A twist with
# $\boldsymbol\omega \ne 0$ gives the line (direction $\boldsymbol\omega/|\boldsymbol\omega|$, through the point
# $\boldsymbol\omega \times \boldsymbol v / |\boldsymbol\omega|^2$) and the **pitch**
# $\boldsymbol\omega\cdot\boldsymbol v / |\boldsymbol\omega|^2$, metres along per radian. The pitch is negative for a
# left-handed screw, zero for a hinge, infinite for a slide.
# %% [markdown] lang="zh"
# 所以 `model.integrate` 用的是 exp,而按 $q + \dot q\,dt$ 推进的四元数必须重新归一化。
#
# ## 螺旋
#
# 在每一瞬间,刚体都绕某条直线转动并沿同一条直线滑动(Mozzi,1763)。Chasles 1830 年的定理说的是有限位移,所以两人常常并称。
# $\boldsymbol\omega \ne 0$ 的 twist 给出这条直线
# (方向 $\boldsymbol\omega/|\boldsymbol\omega|$,经过点 $\boldsymbol\omega \times \boldsymbol v / |\boldsymbol\omega|^2$)
# 和**螺距** $\boldsymbol\omega\cdot\boldsymbol v / |\boldsymbol\omega|^2$,即每转一弧度沿轴前进多少米。
# 左旋时螺距为负,旋转关节的螺距为零,平移的螺距是无穷大。
# %%
V = np.array([0.3, 0.0, 1.0, 0.1, -0.5, 0.3])
axis, point, pitch, magnitude = tw.screw(V)
print(f"axis {axis.round(3)} through {point.round(3)} m, pitch {pitch:.3f} m/rad, {magnitude:.3f} rad/s")
assert np.allclose(plot.point_velocity(V, point), pitch * magnitude * axis)  # on the axis: along it
assert np.allclose(V, np.concatenate([axis, np.cross(point, axis) + pitch * axis]) * magnitude)

ax = plot.screw_axis(V, length=2.5, label="axis")
sideways = np.cross(axis, [0, 1, 0])
ring = point + 0.5 * np.array([sideways, np.cross(axis, sideways), -sideways])
plot.twist_field(V, ring, scale=0.5, ax=ax)
for start in ring:  # where the points go if the twist stays the same
    ax.plot(*tw.exp6(np.linspace(0, 4, 60)[:, None] * V).act(start).T, color=plot.COLOURS["grey"])
plot.fit(ax).legend(loc="upper left")
plt.show()
# %% [markdown] lang="en"
# ## The screws of a leg
#
# Each joint is a screw that does not change in the joint's own frame: a hinge has pitch 0. In the world's frame the
# joints' screws are the columns of the Jacobian. What if all joints of the leg move at once?
# %% [markdown] lang="zh"
# ## 一条腿的螺旋
#
# 每个关节都是一个螺旋,在关节自己的坐标系里不变:旋转关节的螺距是 0。在世界坐标系里,各关节的螺旋就是雅可比矩阵的列。
# 如果腿的所有关节一起动呢?
# %%
tw.ask("49.2-together", ...)
# %%
q = model.standing()
hip = model.v_slice[model.joint_id("FR_hip_joint")].start
screws = tw.frame_jacobian(model, q, "FR_foot", "world")[:, hip : hip + 3].T  # one row for each joint
rates = np.array([3.0, -2.0, 4.0])  # of hip, thigh and calf, rad/s
together = rates @ screws
for name, s in {"hip": screws[0], "thigh": screws[1], "calf": screws[2], "together": together}.items():
    print(f"{name:9} axis {tw.screw(s).axis.round(2) + 0.0}, pitch {1000 * abs(tw.screw(s).pitch):5.1f} mm/rad")
assert np.allclose(tw.screw(screws).pitch, 0, atol=1e-15)
assert abs(tw.screw(together).pitch) > 0.01
for i, s in enumerate(screws):  # each axis passes through its joint
    joint = tw.forward_kinematics(model, q).placement[model.joint_id("FR_hip_joint") + i].translation
    assert np.allclose(plot.point_velocity(s, joint), 0, atol=1e-15)
# %%
ax = plot.robot(model, q, com=False)
knee = tw.frame_placement(model, q, "FR_calf").translation
for s, name, colour in zip(
    [*screws, together], ["hip", "thigh", "calf", "all three"], ["sky", "orange", "green", "blue"]
):
    plot.screw_axis(s, length=0.4, near=knee, colour=plot.COLOURS[colour], label=name, ax=ax)
foot = tw.frame_placement(model, q, "FR_foot").translation
plot.twist_field(together, foot, scale=0.15, colour=plot.COLOURS["vermilion"], label="velocity of the foot", ax=ax)
ax.view_init(elev=25, azim=-25)
ax.legend(loc="upper left", fontsize=8)
plt.show()
# %% [markdown] lang="en"
# ## As $\boldsymbol\omega \to 0$
#
# Without rotation there is no single axis. `tw.screw` returns the direction of the slide and an infinite pitch. And close to
# that?
# %% [markdown] lang="zh"
# ## 当 $\boldsymbol\omega \to 0$
#
# 没有转动就没有唯一的轴,`tw.screw` 返回滑动的方向和无穷大的螺距。接近这种情形时呢?
# %%
tw.ask("49.2-slow", ...)
# %% [markdown] lang="en"
# The point of the axis is $\boldsymbol\omega\times\boldsymbol v/|\boldsymbol\omega|^2$: the rounding of
# $\boldsymbol v$, about $10^{-16}$, is divided by $|\boldsymbol\omega|$. The velocities of points do not suffer. So draw
# screws, and compute with twists.
# %% [markdown] lang="zh"
# 轴上的点
# $\boldsymbol\omega\times\boldsymbol v/|\boldsymbol\omega|^2$ 会把 $\boldsymbol v$ 的舍入误差(约 $10^{-16}$)放大 $1/|\boldsymbol\omega|$ 倍。
# 而各点的速度不受影响。所以螺旋只用来作图,计算要用 twist。
# %%
assert tw.screw([0, 0, 0, 0, 2, 0]).pitch == np.inf

direction, through = np.array([0.36, 0.48, 0.80]), np.array([0.3, -0.2, 0.1])
nearest = through - direction * (direction @ through)
rate = np.geomspace(1e-14, 1, 57)[:, None]
slow = np.concatenate([rate * direction, rate * np.cross(through, direction) + direction], axis=-1)
axis_error = np.linalg.norm(tw.screw(slow).point - nearest, axis=-1)
velocity_error = np.linalg.norm(plot.point_velocity(slow, through) - direction, axis=-1)  # of a point on the axis
assert (axis_error < 1e-15 / rate[:, 0]).all()
assert axis_error[0] > 1e-4
assert velocity_error.max() < 1e-15

ax = plot.axes_2d()
ax.loglog(rate, axis_error, ".", color=plot.COLOURS["vermilion"], label="where the axis is [m]")
ax.loglog(rate, np.maximum(velocity_error, 1e-17), ".", color=plot.COLOURS["blue"], label="velocity of a point [m/s]")
ax.loglog(rate, 2.0**-53 / rate, color=plot.COLOURS["grey"], label="rounding / |ω|")
ax.set(xlabel="|ω| [rad/s], while v = 1 m/s", ylabel="error")
ax.legend()
plt.show()
# %% [markdown] lang="en"
# ## Which half comes first
#
# | | order | who |
# |---|---|---|
# | the chapter, this package | $(\boldsymbol\omega, \boldsymbol v)$ | Featherstone, RBDL, Drake |
# | Pinocchio's memory | $(\boldsymbol v, \boldsymbol\omega)$ | `Motion`, `Force`, Jacobians, the base's part of `v` |
#
# Here only `tw.bridge` swaps, and only the parts of `v` that are a base.
# %% [markdown] lang="zh"
# ## 哪一半在前
#
# | | 顺序 | 谁在用 |
# |---|---|---|
# | 本章、本包 | $(\boldsymbol\omega, \boldsymbol v)$ | Featherstone、RBDL、Drake |
# | Pinocchio 的内存布局 | $(\boldsymbol v, \boldsymbol\omega)$ | `Motion`、`Force`、雅可比矩阵、`v` 里属于基座的部分 |
#
# 这里只有 `tw.bridge` 换序,而且只换 `v` 里属于基座的部分。
# %%
tw.ask("49.2-order", ...)
# %%
forward = np.zeros(model.nv)
forward[0] = 1.0  # the chapter's listing: 1 m/s along x, in Pinocchio's order
assert np.array_equal(tw.bridge.from_pinocchio_tangent(model, forward)[:6], [0, 0, 0, 1, 0, 0])
taken_as_ours = tw.forward_kinematics(model, q, forward).twist[1]
print("read in our order, it rolls:", taken_as_ours)
assert np.array_equal(taken_as_ours[:3], [1, 0, 0])
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    pin.forwardKinematics(pin_model, data, q, forward)
    assert not data.v[0].vector.any()  # index 0 is the world, not the base
    v = np.random.default_rng(2).standard_normal(model.nv)
    pin.forwardKinematics(pin_model, data, q, tw.bridge.to_pinocchio_tangent(model, v))
    ours = tw.forward_kinematics(model, q, v).twist
    theirs = tw.bridge.from_pinocchio_motion([data.v[i].vector for i in range(model.nbodies)])
    assert np.abs(ours - theirs).max() < 1e-12 * np.abs(ours).max()
    print("the twists of all 14 bodies agree with Pinocchio")
# %% [markdown] lang="en"
# The chapter's listing prints `data.v[0]`. That is the world's twist, always zero; the base is body 1.
#
# Finally, the thin type `tw.Twist` can carry the name of its frame, and rejects sums that mean nothing:
# %% [markdown] lang="zh"
# 本章的代码打印的是 `data.v[0]`。那是世界的 twist,永远是零;基座是 1 号刚体。
#
# 最后,轻量类型 `tw.Twist` 可以带上坐标系的名字,没有意义的加法会报错:
# %%
nonsense = {
    "two frames": lambda: tw.Twist(V, frame="base") + tw.Twist(V, frame="world"),
    "twist + wrench": lambda: tw.Twist(V) + tw.Wrench(V),
}
for name, attempt in nonsense.items():
    try:
        attempt()
    except (tw.FrameError, TypeError) as error:
        print(f"{name}: {error}\n")
    else:
        raise AssertionError(name)
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.2.1** the base turns, and the foot gets a linear velocity: why
# - **49.2.2** hat and exp of a walk on a circle, exactly
#
# `twistwrench exercises start my_answers`, then `python -m pytest` in that folder; `twistwrench exercises hint 49.2.1`.
# Next: notebook 49.3.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.2.1** 只有基座在转,脚为什么有线速度
# - **49.2.2** 沿圆行走的 hat 与 exp,要精确解
#
# `twistwrench exercises start my_answers --language zh`,然后在那个文件夹里运行 `python -m pytest`;`twistwrench exercises hint 49.2.1` 给提示。
# 下一个:笔记本 49.3。

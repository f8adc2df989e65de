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
# Go2 stands at (1, 0.5) m, turns left at 0.6 rad/s and walks at 0.8 m/s, its joints locked. Its base carries a frame.
# Where that frame is at the time $t$ is a 4 × 4 matrix $T(t)$: three columns for the directions of its axes, and one for
# its origin. Here it is twice, now and one second later.
# %% [markdown] lang="zh"
# ## 一个运动,两种 twist
#
# Go2 在 (1, 0.5) m 处,以 0.6 rad/s 左转,以 0.8 m/s 前行,关节锁死。基座上固定着一个坐标系,它在时刻 $t$ 的位姿是
# 4 × 4 矩阵 $T(t)$：三列是各轴的方向,一列是原点的位置。下面把它画两次:现在,和一秒之后。
# %%
def placed(seconds):
    """Return T: where the frame of the base is after so many seconds of this walk."""
    return tw.frame_placement(model, model.integrate(q, seconds * v), "base").matrix()


T, T_later = placed(0), placed(1.0)
print(T.round(3), T_later.round(3), sep="\n\n")
# %%
ax = plot.axes_2d(size=(7, 4.5))
for seconds, colour in [(0, "grey"), (1.0, "sky")]:
    plot.top_view(model, model.integrate(q, seconds * v), colour=plot.COLOURS[colour], ax=ax)
for frame, name in [(np.eye(4), "the world"), (T, "T(0)"), (T_later, "T(1 s)")]:
    for k, colour in enumerate(plot.XYZ[:2]):
        ax.quiver(
            *frame[:2, 3],
            *0.3 * frame[:2, k],
            color=colour,
            angles="xy",
            scale_units="xy",
            scale=1,
            width=0.007,
            zorder=3,
        )
    ax.text(*(frame[:2, 3] - 0.2 * frame[:2, 1]), name, ha="center", va="top", fontsize=10)
corners = np.array([[0, 0, 0, 1], [0.3, 0, 0, 1], [0, 0.3, 0, 1]]).T  # three points of the body
ways = (T_later - T) @ corners
ax.quiver(
    *(T @ corners)[:2],
    *ways[:2],
    color=plot.COLOURS["purple"],
    angles="xy",
    scale_units="xy",
    scale=1,
    width=0.004,
    zorder=4,
    label="where three points of the body go",
)
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", xlim=(-0.3, 2.3), ylim=(-0.3, 1.3), title="from above")
ax.legend(loc="upper left")
plt.show()
# %% [markdown] lang="en"
# The purple arrows are the way of three points $\boldsymbol p$ of the body: $(T(t + \Delta t) - T(t))\,\boldsymbol p$.
# Divide by $\Delta t$, and this matrix has the mean velocity of each point. But it is written in the axes of the world.
# Seen from the body itself it is
#
# $$T(t)^{-1}\,\frac{T(t + \Delta t) - T(t)}{\Delta t}.$$
#
# Take smaller and smaller $\Delta t$, and watch the diagonal:
# %% [markdown] lang="zh"
# 紫色箭头是刚体上三个点 $\boldsymbol p$ 走过的路:$(T(t + \Delta t) - T(t))\,\boldsymbol p$。再除以 $\Delta t$,
# 这个矩阵给出的就是各点的平均速度,只不过用的是世界坐标轴。从刚体自己看,则是
#
# $$T(t)^{-1}\,\frac{T(t + \Delta t) - T(t)}{\Delta t}.$$
#
# 让 $\Delta t$ 越来越小,注意对角线:
# %%
quotients = {dt: np.linalg.inv(T) @ (placed(dt) - T) / dt for dt in (1.0, 0.1, 0.01)}
# %%
figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")
for ax, (dt, quotient) in zip(axes, quotients.items()):
    plot.matrix(quotient, f"Δt = {dt} s", numbers=".3f", limit=1.0, ax=ax)
plt.show()
assert np.abs(np.diag(quotients[1.0])).max() > 0.17
assert np.abs(np.diag(quotients[0.01])).max() < 0.002
# %% [markdown] lang="en"
# The diagonal vanishes. In the limit six numbers are left, $\boldsymbol\omega$ in the block of the rotation and
# $\boldsymbol v$ in the last column. A bracket around a twist means this matrix:
#
# $$[\boldsymbol V_{body}] = T^{-1}\,\dot T = \begin{pmatrix} [\boldsymbol\omega]_\times & \boldsymbol v \\ 0 & 0 \end{pmatrix},
# \qquad [\boldsymbol\omega]_\times = \begin{pmatrix} 0 & -\omega_z & \omega_y \\ \omega_z & 0 & -\omega_x \\
# -\omega_y & \omega_x & 0 \end{pmatrix}.$$
#
# This is the **body twist**. A passenger measures it in the axes of the body; its $\boldsymbol v$ is the velocity of the
# frame's origin. It is what we gave to the base: 0.6 rad/s about z, 0.8 m/s along x.
#
# Multiplied from the other side, the same $\dot T$ becomes the **spatial twist**, which is seen from the world:
#
# $$[\boldsymbol V_{spatial}] = \dot T\, T^{-1}.$$
# %% [markdown] lang="zh"
# 对角线消失了。极限里剩下六个数:$\boldsymbol\omega$ 在旋转那一块,$\boldsymbol v$ 在最后一列。给 twist 加方括号,指的就是这个矩阵:
#
# $$[\boldsymbol V_{body}] = T^{-1}\,\dot T = \begin{pmatrix} [\boldsymbol\omega]_\times & \boldsymbol v \\ 0 & 0 \end{pmatrix},
# \qquad [\boldsymbol\omega]_\times = \begin{pmatrix} 0 & -\omega_z & \omega_y \\ \omega_z & 0 & -\omega_x \\
# -\omega_y & \omega_x & 0 \end{pmatrix}.$$
#
# 这就是 **body twist**:坐在刚体上的乘客按刚体的坐标轴量到的,其中 $\boldsymbol v$ 是坐标系原点的速度。
# 它正是我们给基座的运动:绕 z 轴 0.6 rad/s,沿 x 轴 0.8 m/s。
#
# 同一个 $\dot T$ 从另一边乘,就成了 **spatial twist**,这是站在世界里看到的:
#
# $$[\boldsymbol V_{spatial}] = \dot T\, T^{-1}.$$
# %%
size_of_v = tw.ask("49.2-origin", ...)
size_of_v


# %%
def six(quotient):
    """Read ω and v off such a matrix."""
    return np.array([quotient[2, 1], quotient[0, 2], quotient[1, 0], *quotient[:3, 3]])


T_dot = (placed(1e-5) - placed(-1e-5)) / 2e-5  # a difference to both sides: nine digits
print("body twist    ", six(np.linalg.inv(T) @ T_dot).round(3) + 0.0)
print("spatial twist ", six(T_dot @ np.linalg.inv(T)).round(3) + 0.0)
assert np.allclose(six(np.linalg.inv(T) @ T_dot), v[:6], atol=1e-9)
# %% [markdown] lang="en"
# The linear part of the spatial twist is the velocity of the point of the body that passes through the *world's origin*
# now. Usually there is no material at that point; imagine the body extended to it.
#
# How are the two related? From the first definition $\dot T = T\,[\boldsymbol V_{body}]$. Put this into the second:
#
# $$[\boldsymbol V_{spatial}] = \dot T\,T^{-1} = T\,[\boldsymbol V_{body}]\,T^{-1}.$$
#
# No derivative is left in it. `tw.hat` writes a twist as its matrix, `tw.vee` reads it back. This holds for any two frames
# whose placement relative to each other is $T$. Written for six numbers instead of a 4 × 4 matrix it is one multiplication,
# $\boldsymbol V_{spatial} = X\,\boldsymbol V_{body}$; section 49.3 multiplies it out.
# %% [markdown] lang="zh"
# Spatial twist 的线速度部分,是刚体上此刻经过*世界原点*的那个点的速度。那里通常没有材料,请想象刚体一直延伸到那里。
#
# 两者有什么关系?由第一个定义得 $\dot T = T\,[\boldsymbol V_{body}]$,代入第二个:
#
# $$[\boldsymbol V_{spatial}] = \dot T\,T^{-1} = T\,[\boldsymbol V_{body}]\,T^{-1}.$$
#
# 式中不再有导数。`tw.hat` 把 twist 写成它的矩阵,`tw.vee` 再读回来。任何两个坐标系,只要相对位姿是 $T$,都有这个关系。
# 不写成 4 × 4 矩阵而写成六个数,就是一次乘法 $\boldsymbol V_{spatial} = X\,\boldsymbol V_{body}$;49.3 把它展开。
# %%
body = v[:6]
spatial = tw.vee(T @ tw.hat(body) @ np.linalg.inv(T))
assert np.allclose(spatial, six(T_dot @ np.linalg.inv(T)), atol=1e-9)
R, p = T[:3, :3], T[:3, 3]
assert np.allclose(spatial[3:], R @ body[3:] + np.cross(spatial[:3], -p))  # of the point at the world's origin
assert np.allclose(tw.frame_jacobian(model, q, "base", "local") @ v, body, atol=1e-14)
assert np.allclose(tw.frame_jacobian(model, q, "base", "world") @ v, spatial, atol=1e-14)


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
# where that part is; the spatial twist reads it at the origin. Somewhere in this field nothing moves.
# %% [markdown] lang="zh"
# ## Twist 是一个速度场
#
# 给定这六个数,空间中每一点的速度就都确定了:$\boldsymbol v + \boldsymbol\omega \times \boldsymbol p$。这里关节全部锁死,
# 所以整个机器人只有一个 spatial twist。各部分的 body twist 是这个场在该部分所在处的读数,spatial twist 是在原点处的读数。
# 这个场里有一处不动。
# %%
centre_of_curve = tw.ask("49.2-centre", ...)
centre_of_curve
# %%
centre = p + R @ [0, 0.8 / 0.6, 0]  # v / ω to the left of the base
foot = tw.frame_placement(model, q, "FR_foot").translation
assert np.allclose(plot.point_velocity(spatial, centre), 0, atol=1e-15)
for name in ("base", "FR_foot", "RL_calf"):
    assert np.allclose(tw.frame_jacobian(model, q, name, "world") @ v, spatial, atol=1e-15)
# %% thumbnail="yes"
ax = plot.axes_2d(size=(7, 7.6))
grid = np.stack(np.meshgrid(np.arange(-0.6, 2.3, 0.3), np.arange(-0.6, 2.3, 0.3)), axis=-1).reshape(-1, 2)
field = plot.point_velocity(spatial, np.pad(grid, [(0, 0), (0, 1)]))  # of points on the floor

plot.top_view(model, q, ax=ax)
arrow = {"angles": "xy", "scale_units": "xy", "scale": 4, "zorder": 3}  # 1 m/s is 0.25 m long
ax.quiver(*grid.T, *field[:, :2].T, color=plot.COLOURS["sky"], width=0.004, **arrow)
shown = {"vermilion": (np.zeros(3), "at the origin: v of the spatial twist")}
shown |= {"black": (p, "at the base: v of its body twist"), "purple": (foot, "at the foot: v of its body twist")}
for colour, (point, label) in shown.items():
    ax.quiver(
        *point[:2],
        *plot.point_velocity(spatial, point)[:2],
        color=plot.COLOURS[colour],
        label=label,
        width=0.008,
        **arrow,
    )
ax.plot(*centre[:2], "o", color=plot.COLOURS["blue"], markersize=9, label="here nothing moves")
if centre_of_curve.guess is not None:
    ax.plot(p[0], p[1] + centre_of_curve.guess, "D", color=plot.COLOURS["orange"], label="your guess of it")
if size_of_v.guess is not None:
    radius = abs(size_of_v.guess) / 4
    ax.add_patch(plt.Circle((0, 0), radius, fill=False, linestyle="--", label="your guess of the length at the origin"))
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="from above", xlim=(-0.6, 2.3), ylim=(-0.6, 2.2))
ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.09), ncols=2)
plt.show()


# %% [markdown] lang="en"
# The field turns about a vertical line, 0.8 / 0.6 = 1.33 m to the left of the base: the centre of the curve that the
# robot walks. What if the axis moves away, or leans? On the site you drag it, and see which of the six numbers stay:
# [A twist is a field](../hands/field.md).
# %% [markdown] lang="zh"
# 这个场绕着一条竖直线转,它在基座左侧 0.8 / 0.6 = 1.33 m 处:机器人所走弧线的圆心。
# 轴移远一些、歪一些会怎样?在网站上可以拖动它,看六个数里哪些不变:[twist 是一个场](../hands/field.md)。
# %% [markdown] lang="en"
# ## From a twist to a motion: hat and exp
#
# The matrices $[\boldsymbol V]$ are those of $\mathfrak{se}(3)$; `hat` makes them. If the body twist stays constant, then
# $\dot T = T\,[\boldsymbol V]$ has the solution $T(t) = T(0)\,e^{[\boldsymbol V] t}$.
#
# Take $\boldsymbol V = (0, 0, \omega, v, 0, 0)$, the walk from above.
# %% [markdown] lang="zh"
# ## 从 twist 到运动:hat 与 exp
#
# 矩阵 $[\boldsymbol V]$ 属于 $\mathfrak{se}(3)$,由 `hat` 写出。若 body twist 保持不变,
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

ax = plot.axes_2d(size=(6, 6.5))
box = np.array([[0.3, 0.18], [0.3, -0.18], [-0.3, -0.18], [-0.3, 0.18]])
box = np.pad(np.concatenate([box, [[0.5, 0]]]), [(0, 0), (0, 2)], constant_values=(0, 1)) * [1, 1, 0, 1]
ax.plot(*tw.exp6(np.linspace(0, times[-1], 200)[:, None] * V).translation[:, :2].T, color=plot.COLOURS["grey"])
for placements, colour, name in [
    (walk.matrix(), "sky", "exp([V] t)"),
    (straight, "purple", "1 + [V] t in place of exp, in twelve steps"),
]:
    for k, placement in enumerate(placements):
        outline = (placement @ box[[0, 4, 1, 2, 3]].T)[:2]
        ax.fill(*outline, color=plot.COLOURS[colour], alpha=0.5, label=None if k else name)
ax.plot(*straight[:, :2, 3].T, "--", color=plot.COLOURS["purple"])
for t, where in zip(times[:-1:2], 0.6 * (walk.translation[::2] - [0, speed / w, 0]) + [0, speed / w, 0]):
    ax.text(*where[:2], f"{t:.1f} s", fontsize=9, ha="center", va="center")
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="from above")
ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.09))
plt.show()

stretched = np.linalg.det(straight[-1, :3, :3])
print(
    f"after one round the straight steps have det R = {stretched:.1f}; exp has {np.linalg.det(walk.rotation[-1]):.1f}"
)
assert stretched > 10
# %% [markdown] lang="en"
# That is why `model.integrate` uses exp, and why a quaternion that is advanced by $q + \dot q\,dt$ must be normalised. How
# many steps would be enough? On the site you choose their number: [exp against 1 + [V] t](../hands/exponential.md).
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
# 所以 `model.integrate` 用的是 exp,而按 $q + \dot q\,dt$ 推进的四元数必须重新归一化。要分多少步才够?在网站上可以自己选步数:
# [exp 与 1 + [V] t](../hands/exponential.md)。
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
stand = model.standing()
hip = model.v_slice[model.joint_id("FR_hip_joint")].start
screws = tw.frame_jacobian(model, stand, "FR_foot", "world")[:, hip : hip + 3].T  # one row for each joint
rates = np.array([3.0, -2.0, 4.0])  # of hip, thigh and calf, rad/s
together = rates @ screws
for name, s in {"hip": screws[0], "thigh": screws[1], "calf": screws[2], "together": together}.items():
    print(f"{name:9} axis {tw.screw(s).axis.round(2) + 0.0}, pitch {1000 * abs(tw.screw(s).pitch):5.1f} mm/rad")
assert np.allclose(tw.screw(screws).pitch, 0, atol=1e-15)
assert abs(tw.screw(together).pitch) > 0.01
for i, s in enumerate(screws):  # each axis passes through its joint
    joint = tw.forward_kinematics(model, stand).placement[model.joint_id("FR_hip_joint") + i].translation
    assert np.allclose(plot.point_velocity(s, joint), 0, atol=1e-15)
# %%
ax = plot.robot(model, stand, com=False)
knee = tw.frame_placement(model, stand, "FR_calf").translation
for s, name, colour in zip(
    [*screws, together], ["hip", "thigh", "calf", "all three"], ["sky", "orange", "green", "blue"]
):
    plot.screw_axis(s, length=0.4, near=knee, colour=plot.COLOURS[colour], label=name, ax=ax)
foot = tw.frame_placement(model, stand, "FR_foot").translation
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
# ## For engineers
#
# Nothing later needs this; come back to it when you write a program.
#
# ### Which half comes first
#
# Here, as in Featherstone's book, in RBDL and in Drake, $\boldsymbol\omega$ comes first. In Pinocchio's memory
# $\boldsymbol v$ does: in `Motion`, `Force`, Jacobians, and the base's part of `v`. Only `tw.bridge` swaps. The chapter's
# listing prints `data.v[0]`, which is the world's twist, always zero; the base is body 1.
# %% [markdown] lang="zh"
# ## 给工程师
#
# 后面用不到这一部分,等到自己写程序时再看也不迟。
#
# ### 哪一半在前
#
# 这里同 Featherstone 的书、RBDL 和 Drake 一样,$\boldsymbol\omega$ 在前。Pinocchio 的内存布局是 $\boldsymbol v$ 在前:`Motion`、`Force`、
# 雅可比矩阵,以及 `v` 里属于基座的部分。只有 `tw.bridge` 换序。本章的代码打印的是 `data.v[0]`,那是世界的 twist,永远是零;基座是 1 号刚体。
# %%
tw.ask("49.2-order", ...)
# %%
forward = np.zeros(model.nv)
forward[0] = 1.0  # the chapter's listing: 1 m/s along x, in Pinocchio's order
assert np.array_equal(tw.bridge.from_pinocchio_tangent(model, forward)[:6], [0, 0, 0, 1, 0, 0])
taken_as_ours = tw.forward_kinematics(model, q, forward).twist[1]
print("read in our order, it rolls:", taken_as_ours)
assert np.array_equal(taken_as_ours[:3], [1, 0, 0])
# %%
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    pin.forwardKinematics(pin_model, data, q, forward)
    assert not data.v[0].vector.any()  # index 0 is the world, not the base
    some = np.random.default_rng(2).standard_normal(model.nv)
    pin.forwardKinematics(pin_model, data, q, tw.bridge.to_pinocchio_tangent(model, some))
    ours = tw.forward_kinematics(model, q, some).twist
    theirs = tw.bridge.from_pinocchio_motion([data.v[i].vector for i in range(model.nbodies)])
    assert np.abs(ours - theirs).max() < 1e-12 * np.abs(ours).max()
    print("the twists of all 14 bodies agree with Pinocchio")
# %% [markdown] lang="en"
# A `tw.Twist` can carry the name of its frame. Then sums that mean nothing are rejected:
# %% [markdown] lang="zh"
# `tw.Twist` 可以带上坐标系的名字,没有意义的加法就会报错:
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
# ### A derivative without a difference
#
# A difference over $10^{-5}$ s has nine digits, and no other step has many more: a shorter one rounds, a longer one bends.
# With complex numbers there is nothing to subtract. $f(t + ih)$ has the imaginary part $h f'(t)$, and $h$ may be as
# small as $10^{-100}$. The folded checks of later notebooks use this **complex step**.
# %% [markdown] lang="zh"
# ### 不用差分的导数
#
# $10^{-5}$ s 的差分有九位有效数字,换别的步长也好不了多少:再短,舍入误差变大;再长,轨迹的弯曲就显现出来。用复数就不必相减:
# $f(t + ih)$ 的虚部是 $h f'(t)$,而 $h$ 可以小到 $10^{-100}$。后面笔记本里折叠的检验用的就是这种**复数步长**。
# %%
h = 1e-100
exact = placed(1j * h).imag / h
print(f"error of the difference {np.abs(T_dot - exact).max():.1e}")
assert np.allclose(tw.vee(np.linalg.inv(T) @ exact), body, rtol=1e-14, atol=1e-14)
assert 1e-13 < np.abs(T_dot - exact).max() < 1e-9
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

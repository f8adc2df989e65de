# %% [markdown] lang="en"
# # 49.1 Why spatial vectors
#
# A rigid body turns and moves. In three dimensions this takes two vectors, and they follow different rules when you
# change the point or the frame you look from. This notebook shows the rules, what happens if you forget one, and what
# six-dimensional vectors do about it.
# %% [markdown] lang="zh"
# # 49.1 为什么需要空间向量
#
# 刚体既转动又移动。用 3D 向量来描述要两个向量,而换一个参考点或坐标系时,它们遵守的规则并不一样。
# 这个笔记本先说明这些规则,再看漏掉一条会怎样,最后看 6D 向量怎样解决这个问题。
# %%
import twistwrench as tw

model = tw.load("go2")
# %% setup="yes"
import matplotlib.pyplot as plt
import numpy as np

from twistwrench import newton_euler_3d, plot

# %% [markdown] lang="en"
# ## The velocity of a point
#
# Go2 stands at (2, 1) m, turned by 20°. It walks at 0.8 m/s along its own x axis and turns left at 0.6 rad/s, its
# joints locked: one rigid body. If $\boldsymbol\omega$ is its angular velocity and $\boldsymbol v_O$ the velocity of
# some point $O$ of it, then each of its points $P$ has the velocity
#
# $$\boldsymbol v_P = \boldsymbol v_O + \boldsymbol\omega \times \boldsymbol r_{OP}.$$
# %% [markdown] lang="zh"
# ## 一个点的速度
#
# Go2 站在 (2, 1) m 处,朝向转了 20°。它沿自己的 x 轴以 0.8 m/s 行走,同时以 0.6 rad/s 向左转弯,关节锁死,
# 因此整个机器人就是一个刚体。设 $\boldsymbol\omega$ 是它的角速度,$\boldsymbol v_O$ 是它上面某一点 $O$ 的速度,
# 那么它的任何一点 $P$ 的速度是
#
# $$\boldsymbol v_P = \boldsymbol v_O + \boldsymbol\omega \times \boldsymbol r_{OP}.$$
# %%
yaw = np.deg2rad(20)
q = model.standing()
q[:2] = 2, 1
q[3:7] = 0, 0, np.sin(yaw / 2), np.cos(yaw / 2)  # x, y, z, w
v = np.zeros(model.nv)
v[:6] = 0, 0, 0.6, 0.8, 0, 0  # of the base, in its own frame: ω, then v

base = tw.forward_kinematics(model, q).placement[1]
R, p = base.rotation, base.translation
omega, v_base = R @ v[:3], R @ v[3:6]  # in the axes of the world

points = {name: tw.frame_placement(model, q, name).translation for name in ["FL_hip", "FR_foot", "RL_foot", "RR_foot"]}
velocities = {name: v_base + np.cross(omega, point - p) for name, point in points.items()}
for name, velocity in velocities.items():
    print(f"{name:8} moves at {velocity.round(3)} m/s, and turns at {omega.round(3)} rad/s")
# %%
ax = plot.robot(model, q)
places = np.array([p, *points.values()])
plot.arrows(places, [v_base, *velocities.values()], scale=0.22, texts=["base", *points], label="velocity", ax=ax)
ax.view_init(elev=50, azim=-80)
ax.set(xticks=[1.8, 2.2])
ax.legend()
plt.show()
# %% [markdown] lang="en"
# One motion, five arrows. The angular velocity is the same everywhere; the linear velocity is different at each point
# you choose to describe the motion with, the **reference point**. Whichever you choose, you get the same velocity for
# the foot, but only if you also use the right lever $\boldsymbol r_{OP}$:
# %% [markdown] lang="zh"
# 一个运动,五个箭头。角速度处处相同;线速度则取决于你用哪一点来描述这个运动,也就是**参考点**。
# 选哪一点算出的脚的速度都一样,前提是力臂 $\boldsymbol r_{OP}$ 也换成对的:
# %%
foot = points["FR_foot"]
for name, point in points.items():
    from_here = velocities[name] + np.cross(omega, foot - point)
    assert np.allclose(from_here, velocities["FR_foot"], atol=1e-15)
    assert name == "FR_foot" or not np.allclose(velocities[name], velocities["FR_foot"], atol=0.01)
# %% [markdown] lang="en"
# ## Forces have the same trouble, the other way round
#
# A force $\boldsymbol f$ is the same for every reference point, but its moment is not: changing from $O$ to $O'$ adds
# $\boldsymbol r_{O'O} \times \boldsymbol f$. With velocities it was the *linear* part that changed; here it is the
# *angular* one.
# %% [markdown] lang="zh"
# ## 力也有同样的麻烦,只是反过来
#
# 力 $\boldsymbol f$ 在哪里看都一样,力矩却不一样:参考点从 $O$ 换到 $O'$,要加上
# $\boldsymbol r_{O'O} \times \boldsymbol f$。速度里随参考点变化的是线分量,这里变化的是角分量。
# %%
tw.ask("49.1-along", ...)
# %%
push = np.array([0, 0, 40.0])  # the ground on the right front foot, N
moments = {name: np.cross(foot - point, push) for name, point in points.items()}
for name, moment in moments.items():
    print(f"about {name:8} {(moment + 0.0).round(2)} N m")
for name, point in points.items():
    moved = moments["FL_hip"] + np.cross(points["FL_hip"] - point, push)  # from the left hip to here
    assert np.allclose(moved, moments[name], atol=1e-14)
# %% [markdown] lang="en"
# ## A change of frame, in four lines
#
# Let frame $B$ (the base) sit in frame $A$ (the world) at $\boldsymbol p$, turned by $R$. Four rules take quantities
# from $B$ to $A$: two rules only rotate, and two have a coupling term.
#
# $$\boldsymbol\omega_A = R\,\boldsymbol\omega_B, \quad
# \boldsymbol v_A = R\,\boldsymbol v_B + \boldsymbol p \times R\,\boldsymbol\omega_B, \quad
# \boldsymbol f_A = R\,\boldsymbol f_B, \quad
# \boldsymbol\tau_A = R\,\boldsymbol\tau_B + \boldsymbol p \times R\,\boldsymbol f_B.$$
#
# Here $\boldsymbol v_A$ belongs to the point of the body that passes through the origin of $A$. A robot with $N$ links
# needs these rules for the velocity, the acceleration and the force of each link. Six-dimensional vectors need two
# matrices; notebook 49.3 derives them.
# %% [markdown] lang="zh"
# ## 换坐标系:四行公式
#
# 设坐标系 $B$(基座)在坐标系 $A$(世界)中的位置是 $\boldsymbol p$、姿态是 $R$。$B$ 中已知的量按四条规则换到 $A$ 中:
# 两条只需旋转,另两条还带耦合项。
#
# $$\boldsymbol\omega_A = R\,\boldsymbol\omega_B, \quad
# \boldsymbol v_A = R\,\boldsymbol v_B + \boldsymbol p \times R\,\boldsymbol\omega_B, \quad
# \boldsymbol f_A = R\,\boldsymbol f_B, \quad
# \boldsymbol\tau_A = R\,\boldsymbol\tau_B + \boldsymbol p \times R\,\boldsymbol f_B.$$
#
# 这里的 $\boldsymbol v_A$ 是刚体上此刻经过 $A$ 的原点的那个点的速度。$N$ 个连杆的机器人,每个连杆的速度、加速度和力
# 都要用到这些规则。6D 向量只要两个矩阵,49.3 会推导它们。
# %%
twist_B = v[:6]
wrench_B = np.array([0, 0, 2.0, 5.0, 0, 40.0])  # some moment and force on the trunk
twist_A = np.concatenate([R @ twist_B[:3], R @ twist_B[3:] + np.cross(p, R @ twist_B[:3])])
wrench_A = np.concatenate([R @ wrench_B[:3] + np.cross(p, R @ wrench_B[3:]), R @ wrench_B[3:]])

assert np.allclose(base.motion_transform() @ twist_B, twist_A, rtol=1e-14)
assert np.allclose(base.force_transform() @ wrench_B, wrench_A, rtol=1e-14)
assert np.isclose(wrench_A @ twist_A, wrench_B @ twist_B)  # power: the same in both frames
# %% [markdown] lang="en"
# ## Four common mistakes, shown
#
# The chapter lists four mistakes. Here each is made on purpose, on Go2:
#
# 1. the coupling term $\boldsymbol p \times R\boldsymbol\omega$ forgotten;
# 2. the coupling term of the force with the wrong sign: someone pushes the robot's nose to the left with 30 N, and
#    forward dynamics gives how the trunk begins to turn;
# 3. $(\boldsymbol\omega, \boldsymbol v)$ read as $(\boldsymbol v, \boldsymbol\omega)$;
# 4. a body twist taken for a spatial one.
# %% [markdown] lang="zh"
# ## 四个常见错误,亲眼看看
#
# 本章列出了四个常见错误。这里在 Go2 上故意各犯一次:
#
# 1. 忘记耦合项 $\boldsymbol p \times R\boldsymbol\omega$;
# 2. 力的耦合项符号写反:有人用 30 N 向左推机器人的前端,正向动力学告诉我们躯干开始怎样转;
# 3. 把 $(\boldsymbol\omega, \boldsymbol v)$ 读成 $(\boldsymbol v, \boldsymbol\omega)$;
# 4. 把 body twist 当成 spatial twist。
# %%
tw.ask("49.1-sign", ...)
# %%
right = plot.point_velocity(twist_A, foot)
assert np.allclose(right, velocities["FR_foot"])

forgotten = plot.point_velocity(np.concatenate([R @ v[:3], R @ v[3:6]]), foot)  # 1
swapped = plot.point_velocity(base.motion_transform() @ np.roll(twist_B, 3), foot)  # 3
for name, wrong in {"coupling forgotten": forgotten, "order swapped": swapped}.items():
    print(f"{name:18} foot at {wrong.round(2)} m/s instead of {right.round(2)}")
    assert np.abs(wrong - right).max() > 0.5


# %%
def turning(wrench):
    """Angular acceleration of the trunk when a wrench acts on it, less what it is without."""
    f_ext = np.zeros((2, model.nbodies, 6))
    f_ext[1, 1] = wrench
    rest = np.zeros(model.nv)
    without, with_push = tw.aba(model, model.standing(), rest, rest, f_ext=f_ext)
    return (with_push - without)[:3]


nose, force = np.array([0.28, 0, 0]), np.array([0, 30.0, 0])
pushed = turning([*np.cross(nose, force), *force])
flipped = turning([*-np.cross(nose, force), *force])  # 2
print(f"yaw acceleration {pushed[2]:.1f} rad/s², with the wrong sign {flipped[2]:.1f}")
assert pushed[2] > 10
assert flipped[2] < -10
# %% [markdown] lang="en"
# The fourth is the most treacherous. Near the origin of the world both twists are almost equal, so a test in the lab
# passes.
# %% [markdown] lang="zh"
# 第四个最难发现。在世界原点附近,两种 twist 几乎相等,实验室里的测试能通过。
# %%
at_ten_metres = tw.ask("49.1-walked", ...)
at_ten_metres
# %% [markdown] lang="en"
# The error is $\omega d$: it grows with the distance $d$ that the robot has walked, here without turning. All four
# mistakes in one picture:
# %% [markdown] lang="zh"
# 误差是 $\omega d$：机器人向前走的距离 $d$ 越大(这里朝向没变),错得越多。四个错误画在一张图里:
# %%
distance = np.geomspace(0.01, 100, 41)
X = tw.motion_transform(np.eye(3), distance[:, None] * [1, 0, 0])  # one matrix for each distance
spatial = X @ twist_B
foot_there = foot - p + distance[:, None] * [1, 0, 0]
truth = plot.point_velocity(spatial, foot_there)
mistaken = plot.point_velocity(twist_B, foot_there)  # 4
error = np.linalg.norm(mistaken - truth, axis=-1)
assert np.allclose(error, 0.6 * distance)  # ω d
# %%
figure, axes = plt.subplots(1, 4, figsize=(13, 3.4), layout="constrained")
good, bad = plot.COLOURS["blue"], plot.COLOURS["vermilion"]
for ax, (title, wrong) in zip(axes[[0, 2]], {"1. coupling forgotten": forgotten, "3. order swapped": swapped}.items()):
    ax.bar(np.arange(3) - 0.2, right, 0.4, color=good, label="right")
    ax.bar(np.arange(3) + 0.2, wrong, 0.4, color=bad, label="wrong")
    ax.set(
        xticks=range(3), xticklabels=["x", "y", "z"], title=title, ylim=(-0.2, 1.8), ylabel="velocity of the foot [m/s]"
    )
    ax.legend()
axes[1].bar(["right", "wrong"], [pushed[2], flipped[2]], color=[good, bad])
axes[1].set(title="2. sign of p × f", ylabel="yaw acceleration [rad/s²]")
axes[3].loglog(distance, error, color=bad)
axes[3].plot(0.01, error[0], "o", color=good, label="in the lab")
axes[3].plot(10, 6, "o", color=bad, label="10 m away")
if at_ten_metres.guess:
    axes[3].plot(10, abs(at_ten_metres.guess), "D", color=plot.COLOURS["purple"], label="your guess")
axes[3].set(title="4. body for spatial", xlabel="distance walked [m]", ylabel="error of the foot's velocity [m/s]")
axes[3].legend()
axes[3].grid(alpha=0.3)
for ax in axes[:3]:
    ax.axhline(0, color="k", linewidth=0.8)
plt.show()
# %% [markdown] lang="en"
# ## The way without six dimensions
#
# `tw.newton_euler_3d` computes everything in this chapter with 3-D vectors only: bodies in the world, Newton for each
# centre of mass, Euler for its turning. It is right (the package is compared with it), but it needs six coupling terms:
#
# | | what | term |
# |---|---|---|
# | 1 | a velocity at another point | $\boldsymbol\omega \times \boldsymbol r$ |
# | 2 | an acceleration at another point | $\boldsymbol\alpha \times \boldsymbol r + \boldsymbol\omega \times (\boldsymbol\omega \times \boldsymbol r)$ |
# | 3 | a joint that slides with $\boldsymbol u$ in a turning carrier | $2\,\boldsymbol\omega \times \boldsymbol u$ |
# | 4 | the rate of a vector $\boldsymbol s$ fixed in a turning body | $\boldsymbol\omega \times \boldsymbol s$ |
# | 5 | a moment about another point | $\boldsymbol r \times \boldsymbol f$ |
# | 6 | the inertia of a turning body | $\boldsymbol\omega \times I\boldsymbol\omega$ |
#
# How much goes wrong without one? Here for the calf of the right front leg, in a motion drawn at random. Nothing in Go2
# slides, so the third is zero.
# %% [markdown] lang="zh"
# ## 不用 6D 的办法
#
# `tw.newton_euler_3d` 只用 3D 向量算出本章的所有量:世界坐标系里的刚体,每个质心用牛顿方程,绕质心的转动用欧拉方程。
# 它是对的(整个包都拿它来核对),但它需要六个耦合项:
#
# | | 什么量 | 耦合项 |
# |---|---|---|
# | 1 | 另一点的速度 | $\boldsymbol\omega \times \boldsymbol r$ |
# | 2 | 另一点的加速度 | $\boldsymbol\alpha \times \boldsymbol r + \boldsymbol\omega \times (\boldsymbol\omega \times \boldsymbol r)$ |
# | 3 | 在转动的载体上以 $\boldsymbol u$ 滑动的关节 | $2\,\boldsymbol\omega \times \boldsymbol u$ |
# | 4 | 固连在转动刚体上的向量 $\boldsymbol s$ 的变化率 | $\boldsymbol\omega \times \boldsymbol s$ |
# | 5 | 对另一点的力矩 | $\boldsymbol r \times \boldsymbol f$ |
# | 6 | 转动刚体的惯量 | $\boldsymbol\omega \times I\boldsymbol\omega$ |
#
# 少一项会错多少?下面以右前腿的小腿为例,运动是随机抽取的。Go2 没有移动关节,所以第三项是零。
# %%
tw.ask("49.1-negligible", ...)
# %% setup="yes"
rng = np.random.default_rng(1)
v, a = 3 * rng.standard_normal((2, model.nv))
calf = model.joint_id("FR_calf_joint")
moving = newton_euler_3d.motion(model, q, v, a)
w, alpha = moving.angular_velocity[calf], moving.angular_acceleration[calf]
at = tw.forward_kinematics(model, q).placement[calf]
r = tw.frame_placement(model, q, "FR_foot").translation - at.translation
I = at.rotation @ model.inertia[calf].inertia_at_com @ at.rotation.T
relative = v[model.v_slice[calf]] * at.rotation[:, 1]  # the calf turns about its y axis
carrier = w - relative
# %%
shares = {
    "1  v of the foot": (np.cross(w, r), moving.velocity[calf]),
    "2  a of the foot": (np.cross(alpha, r) + np.cross(w, np.cross(w, r)), moving.acceleration[calf]),
    "4  α of the calf": (np.cross(carrier, relative), alpha - np.cross(carrier, relative)),
    "5  moment of the foot": (np.cross(r, push), np.zeros(3)),
    "6  moment on the calf": (np.cross(w, I @ w), I @ alpha),
}
missing = {name: np.linalg.norm(x) / np.linalg.norm(x + rest) for name, (x, rest) in shares.items()}
assert min(missing.values()) > 0.03  # none is small enough to be forgotten

ax = plot.axes_2d(size=(6, 2.8))
ax.barh(list(missing), [100 * share for share in missing.values()], color=plot.COLOURS["sky"])
ax.axvline(3, color=plot.COLOURS["vermilion"], linestyle="--", label="3 %")
ax.legend()
ax.invert_yaxis()
ax.set(xlabel="error where the coupling term is left out [%]", title="one calf, one state")
plt.show()
# %% [markdown] lang="en"
# None of these errors makes a number look impossible. Six-dimensional algebra does not make the terms vanish; it puts
# them into the structure of two operations, $X$ and $\boldsymbol V \times$, where they cannot be forgotten one by one. The
# result is the same:
# %% [markdown] lang="zh"
# 犯了这些错误,没有一个数看上去离谱。6D 代数没有让这些项消失,而是把它们编进两种运算 $X$ 与 $\boldsymbol V \times$ 的结构里,
# 不会再被一项一项地漏掉。结果是一样的:
# %%
slow, fast = newton_euler_3d.inverse_dynamics(model, q, v, a), tw.rnea(model, q, v, a)
assert np.abs(slow - fast).max() < 1e-12 * np.abs(slow).max()
# %% [markdown] lang="en"
# ## Where six numbers come from
#
# Two lines of thought meet in this chapter. Above the axis are those who had six numbers for a line, a motion, a force;
# below it those who computed the motion of linked bodies in a time that grows with $N$, at first with 3-D vectors.
# Featherstone put them together.
# %% [markdown] lang="zh"
# ## 六个数从哪里来
#
# 两条思路在本章汇合。轴的上方是用六个数描述直线、运动和力的人;下方的人让多体动力学的计算时间只与 $N$ 成正比,起初用的是三维向量。
# Featherstone 把两者合到了一起。
# %%
ax = plot.axes_2d(size=(12, 4.5))
years = [
    (1763, 1, "Mozzi: a turn about a line\nand a slide along it"),
    (1830, 2.2, "Chasles: the same\nfor two places of a body"),
    (1865, 1, "Plücker: a line\nin six numbers"),
    (1876, 2.2, "Ball: screws, for motions\nand for forces"),
    (1924, 1, "von Mises: vectors\nof six components"),
    (1965, 2.2, "Dimentberg: screws\nfor mechanisms"),
    (1980, -1, "Luh, Walker, Paul: RNEA,\nwith 3-D vectors"),
    (1982, -2.2, "Walker, Orin: CRBA"),
    (1983, -3.2, "Featherstone: ABA"),
    (1984, 1, "Featherstone:\nspatial vectors"),
    (2008, 2.2, "Featherstone's book;\nOrin, Goswami: 49.10"),
    (2019, -1, "Pinocchio"),
]
ax.axhline(0, color=plot.COLOURS["black"], linewidth=1.5)
for year, height, text in years:
    colour = plot.COLOURS["blue" if height > 0 else "orange"]
    ax.plot([year, year], [0, height], color=colour, linewidth=1)
    ax.plot(year, 0, "o", color=colour)
    box = {"facecolor": "w", "edgecolor": "none", "pad": 2}
    ax.text(year, height, f"{year}\n{text}", ha="center", va="bottom" if height > 0 else "top", fontsize=9, bbox=box)
ax.set(xlim=(1735, 2045), ylim=(-4.2, 3.4))
ax.axis("off")
plt.show()
# %% [markdown] lang="en"
# ## A base that floats
#
# An arm is bolted down; Go2 is not. Its base adds six degrees of freedom without motors. The left-hand sides of the two
# equations of motion are alike, the right-hand sides are not:
# %% [markdown] lang="zh"
# ## 浮动的基座
#
# 机械臂是固定的,Go2 不是。它的基座带来六个没有电机的自由度。两个运动方程的左边一样,右边不同:
# %%
figure, (left, right_hand) = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
arm, posture = tw.load("planar_arm"), np.array([1.3, -0.9, -0.9])
stand = model.standing()
held = tw.static_equilibrium(model, stand)
for ax, robot, x in [(left, arm, posture), (right_hand, model, stand)]:
    plot.side_view(robot, x, com=False, ax=ax)
    first = 2 if robot.base == "floating" else 1
    joints = np.array([T.translation for T in tw.forward_kinematics(robot, x).placement[first:]])
    ax.plot(
        joints[:, 0], joints[:, 2], "o", markersize=11, markerfacecolor="w", color=plot.COLOURS["orange"], label="motor"
    )
left.fill([-0.3, 0.3, 0.3, -0.3], [-0.12, -0.12, -0.04, -0.04], facecolor="0.85", edgecolor="0.4", hatch="////")
for foot, force in zip(model.feet, held.forces):
    x, _, z = tw.frame_placement(model, stand, foot).translation
    right_hand.annotate(
        "",
        (x, z),
        (x, z - force[2] / 350),
        arrowprops={"arrowstyle": "-|>", "color": plot.COLOURS["green"], "lw": 2},
    )
right_hand.plot([], [], color=plot.COLOURS["green"], label="force of the ground λ")
trunk = tw.forward_kinematics(model, stand).placement[1].translation
right_hand.annotate(
    "no motor moves the base", trunk[[0, 2]], trunk[[0, 2]] + [0, 0.07], ha="center", arrowprops={"arrowstyle": "-"}
)
left.set_title(r"$M\,\ddot q + h = \tau$", fontsize=15)
right_hand.set_title(r"$M\,\ddot q + h = S^T\tau + J_c^T\lambda$", fontsize=15)
for ax in (left, right_hand):
    ax.margins(0.15)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)
right_hand.set_ylim(-0.16, 0.4)
plt.show()


# %% [markdown] lang="en"
# $S^T$ writes the torques of the motors into the rows that have a motor. $J_c^T$ brings the forces $\lambda$ at the feet into
# the equation (49.4), the six rows of the base included. So who moves the base?
# %% [markdown] lang="zh"
# $S^T$ 把电机力矩写进有电机的那些行。$J_c^T$ 把足端的力 $\lambda$ 带进方程(49.4),也包括基座的六行。那么是谁在推动基座?
# %% [markdown] lang="en"
# **Exercise 49.1.1.** How many numbers are in `q`, and how many in `v`? And with Euler angles?
# %% [markdown] lang="zh"
# **练习 49.1.1。** `q` 里有几个数,`v` 里有几个数?改用欧拉角呢?
# %%
def sizes():
    """Return nq and nv with a quaternion, then nq and nv with Euler angles: four whole numbers."""
    return ...


tw.exercises.check("49.1.1", sizes)


# %% [markdown] lang="en"
# **Exercise 49.1.2.** Why has the arm no $J_c^T\lambda$? And what changes when its tip polishes something?
# %% [markdown] lang="zh"
# **练习 49.1.2。** 机械臂为什么没有 $J_c^T\lambda$?末端打磨东西时要怎样改?
# %%
def polishing_torques(M, h, J, a, force):
    """Return the joint torques of a fixed-base arm with three joints whose tip touches something."""
    return ...


tw.exercises.check("49.1.2", polishing_torques)
# %% after="49.1.1"
print("                 base     nq  nv  motors")
for robot in map(tw.load, ["planar_arm", "cart_pole", "go2", "humanoid"]):
    motors = len(tw.selection_matrix(robot))
    print(f"{robot.name:16} {robot.base:8} {robot.nq:2}  {robot.nv:2}  {motors:2}")
    floating = robot.base == "floating"
    assert (robot.nq, robot.nv, motors) == (robot.nv + floating, robot.nv, robot.nv - 6 * floating)

S = tw.selection_matrix(model)
assert not (S.T @ np.ones(12))[:6].any()  # the motors have no direct effect on the base
# %% [markdown] lang="en" after="49.1.1"
# Since a rotation is stored as a quaternion, `q` has one number more than `v`. So `q + v * dt` cannot be right: the shapes
# do not fit, and the sum of two quaternions is no rotation. `integrate` moves on the manifold. The chapter's table writes the quaternion with $q_w$ first; Pinocchio and this package store it last.
# What if you mix them up?
# %% [markdown] lang="zh" after="49.1.1"
# 姿态用四元数存储,`q` 就比 `v` 多一个数。所以 `q + v * dt` 不可能对:形状对不上,而且四元数相加不再表示旋转。`integrate` 沿流形移动。
# 本章的表格把 $q_w$ 写在最前,而 Pinocchio 和本包都把它存在最后。弄混了会怎样?
# %%
tw.ask("49.1-rolled", ...)
# %%
dt = 0.01
assert (q.shape, v.shape) == ((19,), (18,))
later = model.integrate(q, v * dt)
assert np.isclose(np.linalg.norm(later[3:7]), 1)
assert np.allclose(model.difference(q, later), v * dt)

s = np.sqrt(0.5)
for order, quaternion in {"x, y, z, w": [s, 0, 0, s], "w, x, y, z": [s, s, 0, 0]}.items():
    rolled = model.standing()
    rolled[3:7] = quaternion  # meant: 90° about x
    up = tw.forward_kinematics(model, rolled).placement[1].rotation[:, 2]
    print(f"{order}: the robot's back points to {up.round(3) + 0.0}")
    assert np.allclose(up, [0, -1, 0]) == (order == "x, y, z, w")
# %% [markdown] lang="en"
# ## For engineers
#
# Nothing later needs this; come back to it when you write a program.
#
# ### Is it faster?
#
# The word "recursive" does not prove it. Measure it on your own machine, and count the cross products in the source:
# %% [markdown] lang="zh"
# ## 给工程师
#
# 后面用不到这一部分,等到自己写程序时再看也不迟。
#
# ### 会更快吗?
#
# "递推"两个字并不能证明更快。请在你自己的机器上测一下,再数一数源代码里的叉乘:
# %% setup="yes"
import ast
import inspect
import timeit

ways = {
    "3-D": lambda: newton_euler_3d.inverse_dynamics(model, q, v, a),
    "6-D": lambda: tw.rnea(model, q, v, a),
}


def cross_products(*modules):
    """Count the places in the source where a cross product stands."""
    calls = [n for m in modules for n in ast.walk(ast.parse(inspect.getsource(m))) if isinstance(n, ast.Call)]
    return sum("cross" in ast.unparse(call.func) for call in calls)


# %%
for name, way in ways.items():
    print(f"{name}: {1e3 * min(timeit.repeat(way, number=5, repeat=5)) / 5:.2f} ms for the inverse dynamics of Go2")
# %%
spread = cross_products(newton_euler_3d.bodies, newton_euler_3d.forces)
gathered = cross_products(inspect.getmodule(tw.rnea))
print(f"cross products in the source: {spread} with 3-D vectors, {gathered} with 6-D vectors")
assert spread > 5 * gathered
# %% [markdown] lang="en"
# In Python, the two take similar times, because most of the time is spent in small calls of NumPy. What makes a
# recursion fast is that its work grows with the number of links $N$ and not with $N^2$. The chapter's table says that
# RNEA, ABA and CRBA are all linear. Can that be?
# %% [markdown] lang="zh"
# 在 Python 里二者相差不大,因为时间主要花在一次次小的 NumPy 调用上。递推之所以快,在于工作量随连杆数 $N$ 增长,而不是随 $N^2$ 增长。
# 本章的表格说 RNEA、ABA、CRBA 都是线性时间。可能吗?
# %%
tw.ask("49.1-full", ...)
# %%
for n in (5, 10, 20, 40):
    links = tw.chain(n)
    assert np.count_nonzero(tw.crba(links, np.full(n, 0.3))) == n**2
# %% [markdown] lang="en"
# ### Pinocchio agrees
#
# The velocity of the right front foot, in the random motion from above:
# %% [markdown] lang="zh"
# ### 与 Pinocchio 对照
#
# 在上面那个随机运动中,右前脚的速度:
# %%
J = tw.frame_jacobian(model, q, "FR_foot", "local_world_aligned")
ours = J @ v
assert np.allclose(ours[3:], moving.velocity[calf] + np.cross(w, r), atol=1e-12)
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    pin.forwardKinematics(pin_model, data, q, tw.bridge.to_pinocchio_tangent(model, v))
    frame = pin_model.getFrameId("FR_foot")
    theirs = pin.getFrameVelocity(pin_model, data, frame, pin.LOCAL_WORLD_ALIGNED)
    assert np.abs(theirs.linear - ours[3:]).max() < 1e-12 * np.abs(ours).max()
    assert np.abs(theirs.angular - ours[:3]).max() < 1e-12 * np.abs(ours).max()
    print("foot", ours[3:].round(3), "m/s, in both")
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.1.1** nq and nv of Go2; with Euler angles; why a quaternion
# - **49.1.2** why an arm has no $J_c^T\lambda$, and what changes when it polishes
#
# `twistwrench exercises start my_answers` puts them into a folder; `python -m pytest` there checks your answers;
# `twistwrench exercises hint 49.1.1` helps. Next: notebook 49.2.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.1.1** Go2 的 nq 与 nv;改用欧拉角;为什么选四元数
# - **49.1.2** 机械臂为什么没有 $J_c^T\lambda$,抛光时要怎样改
#
# `twistwrench exercises start my_answers --language zh` 把练习放进一个文件夹,在那里运行 `python -m pytest` 检查答案,
# `twistwrench exercises hint 49.1.1` 给提示。下一个:笔记本 49.2。

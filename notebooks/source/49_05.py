# %% [markdown] lang="en"
# # 49.5 Spatial inertia
#
# A twist goes in, a momentum comes out: $\boldsymbol h = \hat I\,\boldsymbol V$. This notebook builds the 6 × 6 matrix
# that does it, draws what it knows about a body, moves it, adds it, and writes the equations of Newton and Euler as one.
# At the end a Go2 with locked joints is thrown into the air.
# %% [markdown] lang="zh"
# # 49.5 空间惯量
#
# 输入 twist,输出动量:$\boldsymbol h = \hat I\,\boldsymbol V$。这个笔记本构造出做这件事的 6 × 6 矩阵,画出它包含的刚体信息,给它换坐标系,把它们相加,再把牛顿方程和欧拉方程写成一个。最后,把一只关节锁死的 Go2 抛向空中。
# %%
import twistwrench as tw

model = tw.load("go2")
q = model.standing()
# %% setup="yes"
import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot

rng = np.random.default_rng(5)


# %% [markdown] lang="en"
# ## From ten numbers to a matrix
#
# A rigid body has a mass $m$, a centre of mass $C$ at $\boldsymbol c$, and an inertia $I_c$ about it: 1 + 3 + 6 numbers.
# Its twist is $(\boldsymbol\omega, \boldsymbol v)$, where $\boldsymbol v = \boldsymbol v_O$ is the velocity of the origin $O$
# of its frame.
# %% [markdown] lang="zh"
# ## 从十个数到一个矩阵
#
# 刚体有质量 $m$、位于 $\boldsymbol c$ 的质心 $C$ 和关于质心的惯量 $I_c$：1 + 3 + 6 个数。它的 twist 是
# $(\boldsymbol\omega, \boldsymbol v)$,其中 $\boldsymbol v = \boldsymbol v_O$ 是坐标系原点 $O$ 的速度。
# %%
ax = plot.axes_2d(size=(8, 4.6))
c, v_O, w = np.array([1.1, 0.45]), np.array([0.55, -0.15]), 0.7  # in a plane; ω points at you
turned = w * np.array([-c[1], c[0]])  # ω × c
around = np.linspace(0, 2 * np.pi, 100)
tilt = np.array([[0.9, -0.43], [0.43, 0.9]])
ax.fill(*(tilt @ [1.5 * np.cos(around), 0.75 * np.sin(around)] + 0.75 * c[:, None]), color="0.9", zorder=0)
for start, arrow, colour, text, shift in [
    ((0, 0), (0.45, 0), "black", "x", (0.04, -0.02)),
    ((0, 0), (0, 0.45), "black", "y", (0.03, 0)),
    ((0, 0), c, "grey", "$c$", (-0.75, -0.2)),
    ((0, 0), v_O, "blue", "$v_O$", (0.03, -0.1)),
    (c, v_O, "blue", "$v_O$", (0, -0.16)),
    (c + v_O, turned, "vermilion", r"$\omega \times c$", (0.2, -0.35)),
    (c, v_O + turned, "green", r"$v_C = v_O + \omega \times c$", (-1.0, -0.28)),
]:
    tip = np.add(start, arrow)
    ax.annotate("", tip, start, arrowprops={"arrowstyle": "-|>", "color": plot.COLOURS[colour], "lw": 2})
    ax.text(*(tip + shift), text, color=plot.COLOURS[colour], fontsize=13)
arc = np.linspace(0.4 * np.pi, 1.75 * np.pi, 50)
ax.plot(0.22 * np.cos(arc), 0.22 * np.sin(arc), color=plot.COLOURS["vermilion"])
ax.plot(
    0.22 * np.cos(arc[-1]), 0.22 * np.sin(arc[-1]), marker=(3, 0, 75), color=plot.COLOURS["vermilion"], markersize=9
)
ax.text(-0.42, 0.02, r"$\omega$", color=plot.COLOURS["vermilion"], fontsize=14)
for point, name in [((0, 0), "O"), (c, "C")]:
    ax.plot(*point, "o", color=plot.COLOURS["black"], markersize=7)
    ax.text(*np.add(point, (-0.12, -0.17)), name, fontsize=13)
ax.set(aspect="equal", xlim=(-0.9, 2.5), ylim=(-0.6, 1.55))
ax.axis("off")
plt.show()


# %% [markdown] lang="en"
# In the picture $C$ moves with $\boldsymbol v_C = \boldsymbol v_O + \boldsymbol\omega \times \boldsymbol c$. So the linear
# momentum is $\boldsymbol p = m \boldsymbol v_C$. About $O$ it has the lever $\boldsymbol c$, which gives the angular momentum
# $\boldsymbol L_O = I_c \boldsymbol\omega + \boldsymbol c \times \boldsymbol p$. Collect what multiplies
# $\boldsymbol\omega$ and what multiplies $\boldsymbol v$: that is the matrix.
# %% [markdown] lang="zh"
# 图中 $C$ 的速度是 $\boldsymbol v_C = \boldsymbol v_O + \boldsymbol\omega \times \boldsymbol c$,所以线动量是
# $\boldsymbol p = m \boldsymbol v_C$。它对 $O$ 的力臂是 $\boldsymbol c$,于是关于 $O$ 的角动量是
# $\boldsymbol L_O = I_c \boldsymbol\omega + \boldsymbol c \times \boldsymbol p$。把乘 $\boldsymbol\omega$ 的和乘
# $\boldsymbol v$ 的分别收集起来,就得到这个矩阵。
# %% [markdown] lang="en"
# **Exercise 49.5.1.** Do it on paper, write the matrix as a function of $m$, $\boldsymbol c$ and $I_c$, and run the cell: it is checked here. The
# matrix itself comes next, folded.
# %% [markdown] lang="zh"
# **练习 49.5.1。** 在纸上收集,把矩阵写成 $m$、$\boldsymbol c$、$I_c$ 的函数,运行单元格当场检查。接下来折叠起来的就是这个矩阵。
# %%
def spatial_inertia(m, c, I_c):
    """Return the spatial inertia of a body about the origin of its frame."""
    return ...


tw.exercises.check("49.5.1", spatial_inertia)
# %% [markdown] lang="en" after="49.5.1"
# $$\begin{pmatrix} \boldsymbol L_O \\ \boldsymbol p \end{pmatrix} =
# \begin{pmatrix} I_c - m[\boldsymbol c]_\times^2 & m[\boldsymbol c]_\times \\ -m[\boldsymbol c]_\times & m\,1 \end{pmatrix}
# \begin{pmatrix} \boldsymbol\omega \\ \boldsymbol v \end{pmatrix}.$$
# %% [markdown] lang="zh" after="49.5.1"
# $$\begin{pmatrix} \boldsymbol L_O \\ \boldsymbol p \end{pmatrix} =
# \begin{pmatrix} I_c - m[\boldsymbol c]_\times^2 & m[\boldsymbol c]_\times \\ -m[\boldsymbol c]_\times & m\,1 \end{pmatrix}
# \begin{pmatrix} \boldsymbol\omega \\ \boldsymbol v \end{pmatrix}.$$
# %% after="49.5.1"
thigh = model.inertia[model.joint_id("FL_thigh_joint")]
m, c, I_c = thigh.mass, tw.skew(thigh.com), thigh.inertia_at_com
I = np.block([[I_c - m * c @ c, m * c], [-m * c, m * np.eye(3)]])
assert np.allclose(thigh.matrix(), I, rtol=1e-12)

title = "Î of Go2's front left thigh [kg m², kg m, kg]"
plot.matrix(I, title, rows=["Lx", "Ly", "Lz", "px", "py", "pz"], columns=plot.ANGULAR_LINEAR, numbers=".2g")
plt.show()
# %% [markdown] lang="en" after="49.5.1"
# Top left the inertia about the *origin*, bottom right the mass, and between them the coupling: with the centre of mass
# off the origin, turning is also moving.
# %% [markdown] lang="zh" after="49.5.1"
# 左上是关于*原点*的惯量,右下是质量,中间是耦合:质心不在原点,转动就带着移动。
# %% [markdown] lang="en"
# Is it right? Do not ask another formula. A rigid body is a heap of points;
# take 500 at random and add up what each one has.
# %% [markdown] lang="zh"
# 对不对?不要用另一个公式来验证。
# 刚体就是一堆质点;随机取 500 个,把每个质点的动量加起来。
# %%
masses, points = rng.uniform(0, 0.01, 500), rng.uniform([-0.2, 0, -0.3], [0.2, 0.1, 0.5], (500, 3))
com = masses @ points / masses.sum()
arms = tw.skew(points - com)
heap = tw.SpatialInertia(masses.sum(), com, -np.tensordot(masses, arms @ arms, axes=1))

V = rng.standard_normal(6)
velocities = plot.point_velocity(V, points)
p_heap = masses @ velocities
L_heap = masses @ np.cross(points, velocities)
assert np.allclose(heap.matrix() @ V, np.concatenate([L_heap, p_heap]), rtol=1e-12)
assert np.allclose(heap.momentum(V), heap.matrix() @ V, rtol=1e-12)
assert np.isclose(heap.kinetic_energy(V), masses @ (velocities**2).sum(axis=1) / 2, rtol=1e-12)
assert np.isclose(heap.kinetic_energy(V), V @ heap.matrix() @ V / 2, rtol=1e-12)
# %% [markdown] lang="en"
# The matrix is symmetric, and $\boldsymbol V^T \hat I \boldsymbol V$ is twice the kinetic energy. The chapter calls it
# positive definite. Always?
# %% [markdown] lang="zh"
# 这个矩阵对称,$\boldsymbol V^T \hat I \boldsymbol V$ 是动能的两倍。本章说它正定。总是这样吗?
# %%
tw.ask("49.5-point", ...)
# %% [markdown] lang="en"
# It is positive definite if the mass is positive and $I_c$ is positive definite. A point mass needs no energy to
# turn about itself, and neither does a thin rod to turn about its length: their matrices have rank 3 and 5. All ten
# numbers can be read back from the 36.
# %% [markdown] lang="zh"
# 质量为正、而且 $I_c$ 正定时,它才正定。质点绕自身转动不具有动能,细杆绕自己的长轴转也是:它们的矩阵秩是 3 和 5。从这 36 个数里能把十个数全部读回来。
# %%
assert np.linalg.eigvalsh(heap.matrix()).min() > 0
ball = tw.SpatialInertia(2.0, [0, 0, 0.1], np.zeros((3, 3)))
rod = tw.SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.02, 0.02, 0]))
assert [np.linalg.matrix_rank(body.matrix()) for body in (ball, rod, heap)] == [3, 5, 6]
assert np.isclose(ball.kinetic_energy([1.0, 0, 0, 0, 0.1, 0]), 0)

again = tw.SpatialInertia.from_matrix(heap.matrix())
assert np.isclose(again.mass, heap.mass)
assert np.allclose(again.com, heap.com)
assert np.allclose(again.inertia_at_com, heap.inertia_at_com)
# %% [markdown] lang="en"
# ## What a robot's inertias look like
#
# For motion, a body *is* its ten numbers: there is a uniform ellipsoid with the same ten, with semi-axes
# $a_i = \sqrt{5\,(\mathrm{tr}\,I_c - 2 I_i) / 2m}$, and it moves exactly alike. Here is Go2, each link drawn as that ellipsoid.
# On the right all joints are locked, and the whole robot is one.
#
# To make one body of thirteen takes two steps. First bring each inertia into the frame of the base. The energy must be
# the same, $\boldsymbol V_B^T \hat I_B \boldsymbol V_B = \boldsymbol V_A^T \hat I_A \boldsymbol V_A$, and this
# determines the transform:
#
# $$\hat I_A = X^{-T} \hat I_B X^{-1} = X^* \hat I_B X^{-1}.$$
#
# Then add: momenta of bodies that share a twist add, so their inertias do. That sum is the **composite inertia** on
# which CRBA rests (49.8).
# %% [markdown] lang="zh"
# ## 机器人的惯量长什么样
#
# 就运动而言,刚体就*是*它的十个数:无论形状如何,半轴为 $a_i = \sqrt{5\,(\mathrm{tr}\,I_c - 2 I_i) / 2m}$ 的均匀椭球
# 动起来完全一样。下图是 Go2,每个连杆画成这样的椭球。右边是关节全部锁死之后,整个机器人成了一个椭球。
#
# 把十三个刚体合成一个要两步。先把每个惯量换到基座坐标系。能量相等,
# $\boldsymbol V_B^T \hat I_B \boldsymbol V_B = \boldsymbol V_A^T \hat I_A \boldsymbol V_A$,由此得到变换规则:
#
# $$\hat I_A = X^{-T} \hat I_B X^{-1} = X^* \hat I_B X^{-1}.$$
#
# 然后相加:twist 相同的刚体,动量可以相加,惯量也就可以相加。这个和就是**复合刚体惯量**，CRBA 以它为基础(49.8)。
# %%
placement = tw.forward_kinematics(model, q).placement
in_base = [placement[1].inverse() @ T for T in placement]  # of each body in the base
locked = sum(
    (I_i.transform(T) for I_i, T in zip(model.inertia[2:], in_base[2:])),
    start=model.inertia[1],
)
summed = np.zeros((6, 6))
for I_i, T in zip(model.inertia[1:], in_base[1:]):
    X = T.motion_transform()
    summed += np.linalg.inv(X).T @ I_i.matrix() @ np.linalg.inv(X)
assert np.allclose(locked.matrix(), summed, atol=1e-12)
assert np.isclose(locked.mass, 16.085)
# %% thumbnail="yes"
figure = plt.figure(figsize=(12, 4.6), layout="constrained")
for k in range(2):
    ax = figure.add_subplot(1, 2, k + 1, projection="3d")
    plot.robot(model, q, com=bool(k), ax=ax)
    if k:
        plot.ellipsoid(locked, placement[1], colour=plot.COLOURS["orange"], alpha=0.35, ax=ax)
    else:
        plot.ellipsoids(model, q, ax=ax)
    ax.set_title("all joints locked: one body" if k else "thirteen bodies")
    ax.view_init(elev=18, azim=-65)
    ax.set(xticks=[-0.3, 0.3], yticks=[-0.1, 0.1], zticks=[0, 0.2])
plt.show()
lengths, _ = plot.semi_axes(locked)
print("semi-axes of the locked robot", lengths.round(3), "m")
# %%
times_as_large = tw.ask("49.5-roll", ...)
times_as_large
# %%
trunk = model.inertia[1]
times = np.diag(locked.matrix())[:3] / np.diag(trunk.matrix())[:3]
ax = plot.axes_2d(size=(6.5, 2.8))
ax.bar(["m", "Ixx", "Iyy", "Izz"], [locked.mass / trunk.mass, *times], color=plot.COLOURS["sky"])
if times_as_large.guess is not None:
    ax.plot("Ixx", times_as_large.guess, "D", color=plot.COLOURS["purple"], label="your guess")
    ax.legend()
ax.set(ylabel="times that of the trunk", title="the robot with locked legs, beside its trunk")
plt.show()
assert np.isclose(times[0], times_as_large.truth)
# %% [markdown] lang="en"
# An ellipsoid is not the shape of a link, and may stick out of it. But it shows that calves are thin, and that thighs
# have their mass near the hip, where the motors sit. The chapter says "twelve links": there are thirteen bodies, the
# base is one.
#
# ## Parallel axes
#
# The transform above contains a theorem you know. With no rotation, the top left block becomes $I_c - m[\boldsymbol
# d]_\times^2$: the parallel axes. Mind the sign: $[\boldsymbol d]_\times^2$ has *no positive* eigenvalue, so the minus
# makes the inertia larger. With a plus, the inertia about some axes becomes negative. A change of frame, on the other
# hand, is a congruence: it changes eigenvalues, but never their signs.
# %% [markdown] lang="zh"
# 椭球不是连杆的外形,可能伸到外面去。但看得出小腿很细,大腿的质量集中在靠近髋的一端,电机就装在那里。
# 本章说"12 个连杆",其实是十三个刚体,基座也算一个。
#
# ## 平行轴
#
# 上面的变换里就有你熟悉的定理。没有旋转时,左上块变成 $I_c - m[\boldsymbol d]_\times^2$:平行轴定理。注意符号:
# $[\boldsymbol d]_\times^2$ *没有正*特征值,所以减号让惯量变大。写成加号,绕某些轴的惯量就会变成负的。
# 而换坐标系是**合同变换**:特征值会变,但符号不会变。
# %%
d = np.array([0.3, -0.1, 0.2])
moved = tw.SpatialInertia(m, [0, 0, 0], I_c).transform(tw.SE3(np.eye(3), d)).matrix()
D = tw.skew(d)
assert np.allclose(moved[:3, :3], I_c - m * D @ D, rtol=1e-12)
assert np.linalg.eigvalsh(I_c + m * D @ D).min() < 0  # the wrong sign

for T in tw.exp6(5 * rng.standard_normal((100, 6))).matrix():
    somewhere = thigh.transform(tw.SE3.from_matrix(T)).matrix()
    assert np.linalg.eigvalsh(somewhere).min() > 0
# %% [markdown] lang="en"
# ## Which bodies can exist
#
# A model file is read, and the matrices of its links are checked by their eigenvalues, as in the chapter.
# %% [markdown] lang="zh"
# ## 什么样的刚体可以存在
#
# 读入一个模型文件,像本章那样用特征值检查各连杆的矩阵。
# %%
tw.ask("49.5-plate", ...)
# %% [markdown] lang="en"
# Not every positive definite matrix is a body. The moments are sums over the same points, $I_1 = \sum m(y^2 + z^2)$ and
# so on, so $I_1 + I_2 - I_3 = 2\sum m z^2$ cannot be negative: the **triangle inequality**. (The same expression is
# under the root in the formula of the semi-axes.) In the picture each point is a body, by the ratios of its principal
# moments: bodies exist in the shaded triangle only. `diag(1, 1, 10)` passes the chapter's check for eigenvalues and
# lies far outside.
# %% [markdown] lang="zh"
# 正定的矩阵不一定是刚体。各个转动惯量是对同一批质点求和,$I_1 = \sum m(y^2 + z^2)$ 等等,所以
# $I_1 + I_2 - I_3 = 2\sum m z^2$ 不会是负的:这就是**三角不等式**。(半轴公式的根号下也是它。)图中每个点是一个刚体,
# 坐标是主转动惯量之比:只有阴影三角形里的刚体才存在。`diag(1, 1, 10)` 通得过本章的特征值检查,却远在三角形之外。
# %%
ax = plot.axes_2d(size=(5.5, 4.2))
ax.fill([0, 1, 0.5], [1, 1, 0.5], color="0.9")
for name, colour in {"go2": "blue", "humanoid": "orange"}.items():
    moments = np.array([np.linalg.eigvalsh(I_i.inertia_at_com) for I_i in tw.load(name).inertia[1:]])
    assert (moments[:, 0] + moments[:, 1] >= moments[:, 2]).all()
    ax.plot(*(moments[:, :2] / moments[:, 2:]).T, "o", color=plot.COLOURS[colour], label=f"links of {name}")
ax.plot(0.1, 0.1, "X", color=plot.COLOURS["vermilion"], markersize=10, label="diag(1, 1, 10)")
for x, y, text in [(0, 1.03, "rod"), (0.97, 1.03, "ball"), (0.44, 0.46, "disc"), (0.06, 0.66, "plates on this edge")]:
    ax.text(x, y, text, fontsize=9)
ax.set(xlabel="I₁ / I₃", ylabel="I₂ / I₃", xlim=(-0.05, 1.1), ylim=(0, 1.12), title="I₁ ≤ I₂ ≤ I₃")
ax.legend(loc="lower right")
plt.show()

impossible = tw.SpatialInertia(1.0, np.zeros(3), np.diag([1.0, 1.0, 10.0]))
assert np.linalg.eigvalsh(impossible.matrix()).min() > 0
try:
    impossible.check_physical("plate")
except tw.ModelError as error:
    print(error)
else:
    raise AssertionError("a body that cannot exist has passed")


# %% [markdown] lang="en"
# **Exercise 49.5.3.** What is left of the 6 × 6 matrix in a frame whose origin is the centre of mass? Move it there, $\hat I_A = X^* \hat I_B X^{-1}$,
# and look; the proof belongs in your folder. (`build` is your `spatial_inertia`, `moved` your `moved_inertia`.)
# %% [markdown] lang="zh"
# **练习 49.5.3。** 坐标系原点取在质心时,6 × 6 矩阵还剩什么?用 $\hat I_A = X^* \hat I_B X^{-1}$ 变过去看一看;证明写在你的文件夹里。
# (`build` 是你的 `spatial_inertia`,`moved` 是你的 `moved_inertia`。)
# %%
def about_center_of_mass(m, c, I_c):
    """Return the inertia of a body in a frame at its centre of mass, with the same axes."""
    return ...


tw.exercises.check("49.5.3", about_center_of_mass)
# %% [markdown] lang="en"
# ## Two cross products
#
# Momentum is what Newton and Euler differentiate, and the frame of the body moves. How does $X$ change as the body
# moves with $\boldsymbol V$? By a matrix, $\dot X = X\,(\boldsymbol V\times)$; and $X^*$ by its dual,
# $\dot X^* = X^* (\boldsymbol V\times^*)$:
#
# $$\boldsymbol V\times = \begin{pmatrix} [\boldsymbol\omega]_\times & 0 \\ [\boldsymbol v]_\times &
# [\boldsymbol\omega]_\times \end{pmatrix}, \qquad \boldsymbol V\times^* = -(\boldsymbol V\times)^T =
# \begin{pmatrix} [\boldsymbol\omega]_\times & [\boldsymbol v]_\times \\ 0 & [\boldsymbol\omega]_\times \end{pmatrix}.$$
#
# They are dual because the power is the same in every frame.
# %% [markdown] lang="zh"
# ## 两种空间叉积
#
# 牛顿和欧拉对动量求导,而刚体的坐标系在动。刚体以 $\boldsymbol V$ 运动时,$X$ 怎样变?乘一个矩阵,
# $\dot X = X\,(\boldsymbol V\times)$；$X^*$ 则乘它的对偶,$\dot X^* = X^* (\boldsymbol V\times^*)$：
#
# $$\boldsymbol V\times = \begin{pmatrix} [\boldsymbol\omega]_\times & 0 \\ [\boldsymbol v]_\times &
# [\boldsymbol\omega]_\times \end{pmatrix}, \qquad \boldsymbol V\times^* = -(\boldsymbol V\times)^T =
# \begin{pmatrix} [\boldsymbol\omega]_\times & [\boldsymbol v]_\times \\ 0 & [\boldsymbol\omega]_\times \end{pmatrix}.$$
#
# 二者对偶,理由还是功率相等。
# %%
tw.ask("49.5-antisymmetric", ...)
# %%
V, W, F = rng.standard_normal((3, 6))
cross, dual = tw.cross_motion(V), tw.cross_force(V)
assert np.array_equal(dual, -cross.T)
assert not np.allclose(cross, -cross.T)
assert np.allclose(cross @ W, -tw.cross_motion(W) @ V)
assert np.allclose(cross @ V, 0)
assert np.isclose((dual @ F) @ W, -F @ (cross @ W))  # the pair keeps the power

T, h = tw.exp6(rng.standard_normal(6)), 1e-100  # derivatives by the complex step: the end of 49.2
moving = T @ tw.exp6(1j * h * V)
assert np.allclose(moving.motion_transform().imag / h, T.motion_transform() @ cross)
assert np.allclose(moving.force_transform().imag / h, T.force_transform() @ dual)
X = T.motion_transform()
assert np.allclose(X @ cross @ np.linalg.inv(X), tw.cross_motion(X @ V))  # the product does not depend on the frame
bracket = cross @ tw.cross_motion(W) - tw.cross_motion(W) @ cross
assert np.allclose(tw.cross_motion(cross @ W), bracket)  # the Lie bracket
# %% [markdown] lang="en"
# ## Newton and Euler in one line
#
# In the world the momentum is $X^* \hat I \boldsymbol V$, and the force is its rate. Product rule:
# $X^* \hat I \dot{\boldsymbol V} + X^*(\boldsymbol V\times^*) \hat I \boldsymbol V$. Back in the body's frame, $X^*$ drops
# out:
#
# $$\boldsymbol F = \hat I \dot{\boldsymbol V} + \boldsymbol V \times^* \hat I \boldsymbol V.$$
#
# For comparison, we also compute it the old way, with three coupling terms and a change of the point of reference.
# Below, `stone` is a model with one free body, and gravity switched off.
# %% [markdown] lang="zh"
# ## 一行写下牛顿和欧拉
#
# 在世界坐标系里动量是 $X^* \hat I \boldsymbol V$,力是它的变化率。用乘积法则:
# $X^* \hat I \dot{\boldsymbol V} + X^*(\boldsymbol V\times^*) \hat I \boldsymbol V$。回到刚体坐标系,$X^*$ 就去掉了:
#
# $$\boldsymbol F = \hat I \dot{\boldsymbol V} + \boldsymbol V \times^* \hat I \boldsymbol V.$$
#
# 再用老办法比较:三个耦合项,外加换一次参考点。下面的 `stone` 是只有一个自由刚体的模型,并关掉了重力。
# %%
V, V_dot = rng.standard_normal((2, 6))
I = heap.matrix()
one_line = I @ V_dot + tw.cross_force(V) @ I @ V

w, v, alpha, v_dot = V[:3], V[3:], V_dot[:3], V_dot[3:]
a_C = v_dot + np.cross(w, v) + np.cross(alpha, heap.com) + np.cross(w, np.cross(w, heap.com))
f = heap.mass * a_C  # Newton
tau_C = heap.inertia_at_com @ alpha + np.cross(w, heap.inertia_at_com @ w)  # Euler
assert np.allclose(one_line, np.concatenate([tau_C + np.cross(heap.com, f), f]), rtol=1e-12)

builder = tw.Builder("stone", base="floating", root_inertia=heap, gravity=[0, 0, 0])
stone = builder.build()
assert np.allclose(tw.rnea(stone, stone.neutral(), V, V_dot), one_line, rtol=1e-12)
# %% [markdown] lang="en"
# The chapter says that the gyroscopic term $\boldsymbol\omega \times I\boldsymbol\omega$ comes from differentiating in a
# rotating frame.
# %% [markdown] lang="zh"
# 本章说陀螺项 $\boldsymbol\omega \times I\boldsymbol\omega$ 来自在旋转坐标系里求导。
# %%
tw.ask("49.5-gyroscopic", ...)
# %% [markdown] lang="en"
# Differentiate the momentum along the axes of the world:
# %% [markdown] lang="zh"
# 沿世界坐标轴对动量求导:
# %%
turning = tw.exp3(1j * h * w)  # the world's axes stand still; ω is constant, and the body turns
L = turning @ heap.inertia_at_com @ turning.mT @ w
assert np.allclose(L.imag / h, np.cross(w, heap.inertia_at_com @ w))
# %% [markdown] lang="en"
# ## A Go2 in the air
#
# Lock the joints and throw the robot, so that it spins about one of its principal axes at 4 rad/s, with an error of
# 0.02 rad/s.
# %% [markdown] lang="zh"
# ## 空中的 Go2
#
# 锁死关节,把机器人抛出去,让它绕某一条主轴以 4 rad/s 旋转,外加 0.02 rad/s 的偏差。
# %%
flips = tw.ask("49.5-turnover", ...)
flips
# %% [markdown] lang="en"
# Gravity has no moment about the centre of mass, so we may leave it out. `tw.simulate` integrates the three flights side by
# side; nothing tells it that momentum and energy have to stay. They do. The panel of your guess is grey.
# %% [markdown] lang="zh"
# 重力对质心没有力矩,可以不算。`tw.simulate` 把三次飞行并排积分;程序里没有任何地方要求动量和能量守恒,结果却都守恒。你猜的那一格是灰色的。
# %%
moments, axes = np.linalg.eigh(locked.inertia_at_com)  # the principal axes, in the frame of the base
thrown = tw.Builder("locked Go2", base="floating", root_inertia=locked, gravity=[0, 0, 0]).build()

spins = (4 * np.eye(3) + 0.02) @ axes.T  # one row for each throw, ω in the frame of the base
throws = np.concatenate([spins, np.cross(locked.com, spins)], axis=-1)  # the centre of mass stays
flight = tw.simulate(thrown, np.tile(thrown.neutral(), (3, 1)), throws, dt=0.01, duration=12)
rates = flight.v[..., :3] @ axes  # ω along the principal axes

energy = locked.kinetic_energy(flight.v)
placed = tw.forward_kinematics(thrown, flight.q).placement[1]
momenta = np.matvec(placed.force_transform(), locked.momentum(flight.v))  # in the world
assert np.allclose(energy, energy[0], rtol=1e-8)
assert np.allclose(momenta, momenta[0], rtol=0, atol=1e-6)
# %%
figure, panels = plt.subplots(1, 3, figsize=(12, 3.2), layout="constrained", sharey=True)
names = ["smallest", "middle", "largest"]
for k, ax in enumerate(panels):
    for j, colour in enumerate(plot.XYZ):
        ax.plot(flight.t, rates[:, k, j], color=colour, label=f"ω about the {names[j]}")
    if flips.letter == "abc"[k]:
        ax.set_facecolor("0.92")
    ax.set(xlabel="time [s]", title=f"thrown about the {names[k]}, {moments[k]:.3f} kg m²")
panels[0].set_ylabel("rad/s, in the body's axes")
panels[0].legend(loc="lower right")
plt.show()
assert rates[:, [0, 2], [0, 2]].min() > 3.99  # about the smallest and the largest moment it spins on
assert rates[:, 1, 1].min() < -3.9  # about the middle one it turns over
# %% [markdown] lang="en"
# Here is the middle one from the side, at equal times, the legs on the robot's left blue and those on its right vermilion.
# What is nearer is in front:
# %% [markdown] lang="zh"
# 下面从侧面看中间那一次,时间间隔相等;机器人左侧的腿是蓝色,右侧的是朱红色,近的挡住远的:
# %%
ax = plot.axes_2d(size=(13, 2.6))
for k in range(10):
    step = 78 * k  # half a somersault
    plot.side_view(model, [*flight.q[step, 1], *q[7:]], shift=1.0 * k, com=False, ax=ax)
    ax.text(1.0 * k, -0.55, f"{flight.t[step]:.1f} s", ha="center")
ax.set(ylim=(-0.6, 0.45))
ax.axis("off")
plt.show()
left_side = placed.rotation[:, 1, 1, 1]  # where the robot's left side points: along the world's y, or against it
assert left_side[0] > 0.99
assert left_side.min() < -0.99


# %% [markdown] lang="en"
# Nothing touches the robot: the term $\boldsymbol V\times^* \hat I \boldsymbol V$ alone turns it over, and back.
# Spinning about the middle axis is possible, but unstable (the intermediate-axis theorem). Try it with your phone. Why this
# axis and not the others? On the site you throw a book, and watch its momentum run along the curve where a sphere and an
# ellipsoid meet: [The book that tumbles](../hands/tumbling.md).
#
# ## Pinocchio agrees
#
# Its `Inertia` keeps the same ten numbers. The chapter compares `model.inertias[0].matrix()`, as the inertia of the base,
# entry by entry with its own. Run it. Do you agree?
# %% [markdown] lang="zh"
# 没有人碰它:单凭 $\boldsymbol V\times^* \hat I \boldsymbol V$ 就让机器人翻过去又翻回来。绕中间轴旋转是可能的,但不稳定
# (中间轴定理)。拿手机试试看。为什么偏偏是这条轴?在网站上可以抛一本书,看它的角动量沿球面与椭球面的交线走:
# [翻滚的书](../hands/tumbling.md)。
#
# ## 与 Pinocchio 对照
#
# 它的 `Inertia` 存的是同样的十个数。本章取 `model.inertias[0].matrix()` 作为基座的惯量,与自己的结果逐元素比较。
# 运行一下,你同意吗?
# %% [markdown] lang="en"
# **Exercise 49.5.2.** The mass of the base, and its spatial inertia built by hand with your function of 49.5.1, `build(m, c, I_c)`.
# %% [markdown] lang="zh"
# **练习 49.5.2。** 给出基座的质量,以及用你在 49.5.1 写的函数 `build(m, c, I_c)` 构造的空间惯量。
# %%
def base_inertia(model):
    """Return the mass of the base and its spatial inertia, built by hand from ten numbers."""
    return ...


tw.exercises.check("49.5.2", base_inertia)
# %% [markdown] lang="en" after="49.5.2"
# `matrix()` is in the order $(\boldsymbol v, \boldsymbol\omega)$, with $m\,1$ at the top left, and body 0 is the world: so
# the chapter's last assertion fails. Pinocchio also takes the impossible body.
# %% [markdown] lang="zh" after="49.5.2"
# 它的 `matrix()` 按 $(\boldsymbol v, \boldsymbol\omega)$ 排列,$m\,1$ 在左上,而且第 0 个刚体是世界:所以本章的最后一条断言失败。
# Pinocchio 也接受那个不可能存在的刚体。
# %% after="49.5.2"
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    theirs = tw.bridge.to_pinocchio_inertia(heap)
    assert np.allclose(theirs.matrix()[:3, :3], heap.mass * np.eye(3))  # linear first
    assert np.allclose(tw.bridge.from_pinocchio_transform(theirs.matrix()), heap.matrix(), rtol=1e-12)
    momentum = theirs * pin.Motion(tw.bridge.to_pinocchio_motion(V))
    assert np.allclose(tw.bridge.from_pinocchio_force(momentum), heap.momentum(V), rtol=1e-12)

    pin_model = tw.bridge.to_pinocchio_model(model)
    assert not pin_model.inertias[0].matrix().any()  # the world
    assert np.isclose(pin_model.inertias[1].mass, 7.277)  # the base, with what is welded to it
    assert pin.Inertia(1.0, np.zeros(3), np.diag([1.0, 1.0, 10.0])).mass == 1.0
    print("inertia and momentum: the same in both")
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.5.1** the 6 × 6 matrix of a link, by hand
# - **49.5.2** Go2's base against Pinocchio, entry by entry
# - **49.5.3** why the matrix falls into two blocks at the centre of mass
#
# `twistwrench exercises start my_answers` puts them into a folder; `python -m pytest` there checks your answers;
# `twistwrench exercises hint 49.5.1` helps. Next: notebook 49.6.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.5.1** 手算一个连杆的 6 × 6 矩阵
# - **49.5.2** Go2 的基座,与 Pinocchio 逐元素比较
# - **49.5.3** 为什么在质心处矩阵分成两块
#
# `twistwrench exercises start my_answers --language zh` 把练习放进一个文件夹,在那里运行 `python -m pytest` 检查答案,
# `twistwrench exercises hint 49.5.1` 给提示。下一个:笔记本 49.6。

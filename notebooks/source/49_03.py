# %% [markdown] lang="en"
# # 49.3 Plücker transforms
#
# The four rules of 49.1 become two matrices: $X$ takes twists from one frame to another, $X^*$ takes wrenches. This
# notebook derives $X$ in six steps and checks each on numbers, looks at the blocks, and shows why $X^*$ is
# $X^{-T}$ and not $X^T$.
# %% [markdown] lang="zh"
# # 49.3 Plücker 变换矩阵
#
# 49.1 的四条规则可以合成两个矩阵:$X$ 变换 twist，$X^*$ 变换 wrench。这个笔记本分六步推导 $X$,每一步都用数字核对,
# 再看看矩阵的分块结构,并说明为什么 $X^*$ 是 $X^{-T}$ 而不是 $X^T$。
# %%
import twistwrench as tw

model = tw.load("go2")
q = model.standing()
# %% setup="yes"
import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot

hip = model.joint_id("FR_hip_joint")
q[model.q_slice[hip].start :][:3] = -0.4, 0.9, -1.6  # the right front leg, put out to the side

placement = tw.forward_kinematics(model, q).placement
base, calf = placement[1], placement[model.joint_id("FR_calf_joint")]
T_AB = base.inverse() @ calf  # A: the base, B: the calf
R, p = T_AB.rotation, T_AB.translation
# %%
ax = plot.robot(model, q, com=False)
plot.triad(base, "A", ax=ax)
plot.triad(calf, "B", ax=ax)
ax.view_init(elev=18, azim=-35)
plt.show()
# %% [markdown] lang="en"
# ## Six steps
#
# **1.** In 49.2 a body twist became a spatial one by putting $\dot T = T\,[\boldsymbol V_{body}]$ into
# $[\boldsymbol V_{spatial}] = \dot T\,T^{-1}$. It is the same between any two frames A and B that are at rest to each
# other. A body C has the placements $T_{BC}(t)$ and $T_{AC} = T_{AB}\,T_{BC}$, with $T_{AB}$ constant. Therefore
#
# $$[\boldsymbol V_A] = \dot T_{AC}\,T_{AC}^{-1} = T_{AB}\,\dot T_{BC}\,T_{BC}^{-1}\,T_{AB}^{-1}
# = T_{AB}\,[\boldsymbol V_B]\,T_{AB}^{-1}.$$
#
# **2.** The inverse of a placement turns back and then moves back:
#
# $$T_{AB}^{-1} = \begin{pmatrix} R^T & -R^T\boldsymbol p \\ 0 & 1 \end{pmatrix}.$$
#
# **3.** Multiply the three matrices:
#
# $$T\,[\boldsymbol V_B]\,T^{-1} = \begin{pmatrix} R[\boldsymbol\omega]_\times R^T &
# -R[\boldsymbol\omega]_\times R^T\boldsymbol p + R\boldsymbol v \\ 0 & 0 \end{pmatrix}.$$
# %% [markdown] lang="zh"
# ## 六步推导
#
# **第一步。** 49.2 把 $\dot T = T\,[\boldsymbol V_{body}]$ 代入 $[\boldsymbol V_{spatial}] = \dot T\,T^{-1}$,
# body twist 就变成了 spatial twist。任意两个相对静止的坐标系 A、B 之间也是如此。刚体 C 的位姿是 $T_{BC}(t)$ 和
# $T_{AC} = T_{AB}\,T_{BC}$,其中 $T_{AB}$ 不变,所以
#
# $$[\boldsymbol V_A] = \dot T_{AC}\,T_{AC}^{-1} = T_{AB}\,\dot T_{BC}\,T_{BC}^{-1}\,T_{AB}^{-1}
# = T_{AB}\,[\boldsymbol V_B]\,T_{AB}^{-1}.$$
#
# **第二步。** 位姿的逆:先转回去,再移回去:
#
# $$T_{AB}^{-1} = \begin{pmatrix} R^T & -R^T\boldsymbol p \\ 0 & 1 \end{pmatrix}.$$
#
# **第三步。** 三个矩阵相乘:
#
# $$T\,[\boldsymbol V_B]\,T^{-1} = \begin{pmatrix} R[\boldsymbol\omega]_\times R^T &
# -R[\boldsymbol\omega]_\times R^T\boldsymbol p + R\boldsymbol v \\ 0 & 0 \end{pmatrix}.$$
# %%
rng = np.random.default_rng(3)
V_B = rng.standard_normal(6)
w, v = V_B[:3], V_B[3:]
T, back = T_AB.matrix(), T_AB.inverse().matrix()
carried = T @ tw.hat(V_B) @ back  # 1

assert np.allclose(back[:3], np.hstack([R.T, -(R.T @ p)[:, None]]), atol=1e-15)  # 2
assert np.allclose(T @ back, np.eye(4), atol=1e-15)
W = R @ tw.skew(w) @ R.T
assert np.allclose(carried[:3, :3], W, atol=1e-15)  # 3
assert np.allclose(carried[:3, 3], -W @ p + R @ v, atol=1e-15)


# %% [markdown] lang="en"
# **4.** A rotation keeps cross products, $R(\boldsymbol a \times \boldsymbol b) = R\boldsymbol a \times R\boldsymbol b$.
# Therefore
#
# $$R\,[\boldsymbol\omega]_\times R^T = [R\boldsymbol\omega]_\times.$$
#
# **5.** Exchange the factors of the cross product, so that the lever arm comes first:
#
# $$-[R\boldsymbol\omega]_\times\,\boldsymbol p = \boldsymbol p \times R\boldsymbol\omega = [\boldsymbol p]_\times R\,\boldsymbol\omega.$$
# %% [markdown] lang="zh"
# **第四步。** 旋转保持叉积,$R(\boldsymbol a \times \boldsymbol b) = R\boldsymbol a \times R\boldsymbol b$,因此
#
# $$R\,[\boldsymbol\omega]_\times R^T = [R\boldsymbol\omega]_\times.$$
#
# **第五步。** 叉积交换次序,力臂就到了前面:
#
# $$-[R\boldsymbol\omega]_\times\,\boldsymbol p = \boldsymbol p \times R\boldsymbol\omega = [\boldsymbol p]_\times R\,\boldsymbol\omega.$$
# %% [markdown] lang="en"
# **Exercise 49.3.1.** Step 6 is yours: read off what happens to $\boldsymbol\omega$ and to $\boldsymbol v$. Begin with a pure translation. (The rules
# of 49.1 for moments and forces give $X^*$ in the same way.)
# %% [markdown] lang="zh"
# **练习 49.3.1。** 第六步由你来做:读出 $\boldsymbol\omega$ 与 $\boldsymbol v$ 各自的变化。先做纯平移。(49.1 中力矩与力的规则同样给出 $X^*$。)
# %%
def translation_transforms(p):
    """Return X, X⁻¹ and X* of the placement (1, p)."""
    return ...


tw.exercises.check("49.3.1", translation_transforms)


# %% [markdown] lang="en"
# **Exercise 49.3.2.** Now any placement. What is folded below is step 6.
# %% [markdown] lang="zh"
# **练习 49.3.2。** 再做任意位姿。下面折叠的就是第六步。
# %%
def plucker(R, p):
    """Return X and X* of any placement (R, p)."""
    return ...


tw.exercises.check("49.3.2", plucker)
# %% [markdown] lang="en" after="49.3.2"
# **6.** Read off what happens to $\boldsymbol\omega$ and to $\boldsymbol v$:
#
# $$\begin{pmatrix} \boldsymbol\omega_A \\ \boldsymbol v_A \end{pmatrix} =
# \begin{pmatrix} R & 0 \\ [\boldsymbol p]_\times R & R \end{pmatrix}
# \begin{pmatrix} \boldsymbol\omega_B \\ \boldsymbol v_B \end{pmatrix}, \qquad
# {}^A\!X_B = \begin{pmatrix} R & 0 \\ [\boldsymbol p]_\times R & R \end{pmatrix}.$$
#
# The coupling term of 49.1 has become the block at the bottom left.
# %% [markdown] lang="zh" after="49.3.2"
# **第六步。** 读出 $\boldsymbol\omega$ 与 $\boldsymbol v$ 各自的变化:
#
# $$\begin{pmatrix} \boldsymbol\omega_A \\ \boldsymbol v_A \end{pmatrix} =
# \begin{pmatrix} R & 0 \\ [\boldsymbol p]_\times R & R \end{pmatrix}
# \begin{pmatrix} \boldsymbol\omega_B \\ \boldsymbol v_B \end{pmatrix}, \qquad
# {}^A\!X_B = \begin{pmatrix} R & 0 \\ [\boldsymbol p]_\times R & R \end{pmatrix}.$$
#
# 49.1 的耦合项变成了左下角的那一块。
# %%
assert np.allclose(W, tw.skew(R @ w), atol=1e-15)  # 4
assert np.allclose(-W @ p, tw.skew(p) @ R @ w, atol=1e-15)  # 5
# %% after="49.3.2"
X = T_AB.motion_transform()
assert np.array_equal(X, np.block([[R, np.zeros((3, 3))], [tw.skew(p) @ R, R]]))  # 6
assert np.allclose(X @ V_B, tw.vee(carried), atol=1e-15)
# %% [markdown] lang="en"
# ## Plücker's lines, and why X bears his name
#
# In 1865 Julius Plücker described a line in space by six numbers: its direction $\boldsymbol d$, of length 1, and its moment
# $\boldsymbol m = \boldsymbol r \times \boldsymbol d$, where $\boldsymbol r$ is any point of the line. (Another point
# $\boldsymbol r + s\boldsymbol d$ gives the same $\boldsymbol m$.) Seen from another frame the line has the direction
# $R\boldsymbol d$ and the moment $R\boldsymbol m + \boldsymbol p \times R\boldsymbol d$. These are the rules for
# $\boldsymbol\omega$ and $\boldsymbol v$: **$X$ transforms lines**, and therefore bears Plücker's name.
#
# The reason is simple. A body that turns about the line at 1 rad/s has the twist $(\boldsymbol d, \boldsymbol m)$, since
# its point at the origin moves with $\boldsymbol d \times (-\boldsymbol r) = \boldsymbol m$. A force of 1 N along the
# line has the same six numbers in the other order, $(\boldsymbol m, \boldsymbol d)$, and is transformed by $X^*$. A screw
# is a line and a pitch: $(\boldsymbol d, \boldsymbol m + h\boldsymbol d)$.
# %% [markdown] lang="zh"
# ## Plücker 直线,以及 X 为什么叫这个名字
#
# 1865 年,Julius Plücker 用六个数描述空间中的一条直线:方向 $\boldsymbol d$(长度为 1)和矩
# $\boldsymbol m = \boldsymbol r \times \boldsymbol d$,其中 $\boldsymbol r$ 是直线上任意一点。(换一点
# $\boldsymbol r + s\boldsymbol d$,$\boldsymbol m$ 不变。)换一个坐标系看,方向成为 $R\boldsymbol d$,矩成为
# $R\boldsymbol m + \boldsymbol p \times R\boldsymbol d$。这正是 $\boldsymbol\omega$ 与 $\boldsymbol v$ 的变换规则:
# **$X$ 变换的是直线**,所以用 Plücker 的名字。
#
# 原因很简单。刚体以 1 rad/s 绕这条直线转动时,它在原点处的点以
# $\boldsymbol d \times (-\boldsymbol r) = \boldsymbol m$ 运动,所以 twist 就是 $(\boldsymbol d, \boldsymbol m)$。
# 沿这条直线的 1 N 的力是同样六个数换个次序,$(\boldsymbol m, \boldsymbol d)$,用 $X^*$ 变换。螺旋就是一条直线加一个螺距:
# $(\boldsymbol d, \boldsymbol m + h\boldsymbol d)$。
# %%
d, point = np.array([0, 0.6, 0.8]), np.array([0.1, -0.2, 0.3])  # a line, in B
line = np.concatenate([d, np.cross(point, d)])
assert np.allclose(np.cross(point + 5 * d, d), line[3:])  # any of its points will do
in_A = np.concatenate([R @ d, np.cross(R @ point + p, R @ d)])  # the same line from its points in A
assert np.allclose(tw.motion_transform(R, p) @ line, in_A)
assert np.allclose(tw.force_transform(R, p) @ np.roll(line, 3), np.roll(in_A, 3))  # a force along the line
assert np.isclose(tw.screw(line + np.concatenate([np.zeros(3), 0.2 * d])).pitch, 0.2)  # a screw: line and pitch
# %% [markdown] lang="en"
# ## The blocks
#
# This is $X$ from Go2's right calf to the base, beside $X^*$ for wrenches, which the second half of this notebook is
# about. White is exactly zero. Same blocks; the coupling has changed its corner, because for wrenches it is the
# *angular* part that depends on the point.
# %% [markdown] lang="zh"
# ## 分块结构
#
# 左边是从 Go2 右前小腿到基座的 $X$,右边是变换 wrench 的 $X^*$,后者是这个笔记本后半部分的主题。白色表示恰好为零。
# 块是一样的,只是耦合块换了一个角,因为对 wrench 来说,依赖参考点的是角分量。
# %% thumbnail="yes"
X_star = T_AB.force_transform()
figure, axes = plt.subplots(1, 2, figsize=(10, 5), layout="constrained")
moment_force = ("τx", "τy", "τz", "fx", "fy", "fz")
for ax, A, title, names in zip(axes, (X, X_star), ("X: twists", "X*: wrenches"), (plot.ANGULAR_LINEAR, moment_force)):
    plot.matrix(A, title, rows=names, columns=names, numbers=".2f", ax=ax)
plt.show()

assert not X[:3, 3:].any()
assert not X_star[3:, :3].any()
assert np.array_equal(X[3:, :3], X_star[:3, 3:])
assert np.isclose(np.linalg.det(X), 1)


# %% [markdown] lang="en"
# ## Chains and inverses
#
# Placements chain, $T_{AC} = T_{AB}T_{BC}$. Do the matrices as well, ${}^A\!X_C = {}^A\!X_B\,{}^B\!X_C$?
# %% [markdown] lang="zh"
# ## 链式法则与逆
#
# 位姿可以连乘,$T_{AC} = T_{AB}T_{BC}$。矩阵也可以吗,${}^A\!X_C = {}^A\!X_B\,{}^B\!X_C$？
# %% [markdown] lang="en"
# **Exercise 49.3.3.** First in numbers, here; then the proof, in words and formulas, in your folder.
# %% [markdown] lang="zh"
# **练习 49.3.3。** 先在这里用数值检验;再用文字和公式证明,写在你的文件夹里。
# %%
def chain_two_ways(R_AB, p_AB, R_BC, p_BC):
    """Return X_AC in two ways: from the placement T_AB T_BC, and as X_AB X_BC."""
    return ...


tw.exercises.check("49.3.3", chain_two_ways)
# %% [markdown] lang="en" after="49.3.3"
# Conjugating twice is conjugating once with the product; so the matrices chain as well.
# %% [markdown] lang="zh" after="49.3.3"
# 连续两次共轭等于用乘积共轭一次,所以矩阵也可以连乘。
# %% [markdown] lang="en"
# Along Go2's leg, base ← hip ← thigh ← calf:
# %% [markdown] lang="zh"
# 沿着 Go2 的腿,基座 ← 髋 ← 大腿 ← 小腿:
# %%
links = [placement[model.parent[i]].inverse() @ placement[i] for i in (hip, hip + 1, hip + 2)]
steps = [link.motion_transform() for link in links]
assert np.allclose(steps[0] @ steps[1] @ steps[2], X, atol=1e-15)

figure, axes = plt.subplots(1, 4, figsize=(12, 3.4), layout="constrained")
names = ["base ← hip", "hip ← thigh", "thigh ← calf", "their product: base ← calf"]
for ax, A, name in zip(axes, [*steps, X], names):
    plot.matrix(A, name, numbers=".2f", limit=1.0, rounding=1e-12, ax=ax)
plt.show()
# %%
tw.ask("49.3-back", ...)
# %% [markdown] lang="en"
# The way back needs no solver. $T_{BA}$ has the rotation $R^T$ and the translation $-R^T\boldsymbol p$, and with step 4
#
# $${}^B\!X_A = ({}^A\!X_B)^{-1} = \begin{pmatrix} R^T & 0 \\ -R^T[\boldsymbol p]_\times & R^T \end{pmatrix}.$$
# %% [markdown] lang="zh"
# 往回变换不需要解方程。$T_{BA}$ 的旋转是 $R^T$,平移是 $-R^T\boldsymbol p$,再用第四步的恒等式:
#
# $${}^B\!X_A = ({}^A\!X_B)^{-1} = \begin{pmatrix} R^T & 0 \\ -R^T[\boldsymbol p]_\times & R^T \end{pmatrix}.$$
# %%
X_back = T_AB.inverse().motion_transform()
assert np.allclose(X_back, np.block([[R.T, np.zeros((3, 3))], [-R.T @ tw.skew(p), R.T]]), atol=1e-15)
assert np.allclose(X @ X_back, np.eye(6), atol=1e-15)
# %% [markdown] lang="en"
# ## Wrenches: the power decides
#
# The power $P = \boldsymbol F \cdot \boldsymbol V$ is watts, and watts do not depend on who looks.
# %% [markdown] lang="zh"
# ## Wrench:由功率决定
#
# 功率 $P = \boldsymbol F \cdot \boldsymbol V$ 以瓦计,它的大小与在哪个坐标系里看无关。
# %%
tw.ask("49.3-transpose", ...)
# %% [markdown] lang="en"
# Written out:
#
# $$\boldsymbol F_B^T\boldsymbol V_B = \boldsymbol F_A^T\boldsymbol V_A = \boldsymbol F_A^T X\,\boldsymbol V_B
# \quad\text{for all } \boldsymbol V_B \quad\Rightarrow\quad \boldsymbol F_B = X^T\boldsymbol F_A, \quad
# \boldsymbol F_A = X^{-T}\boldsymbol F_B.$$
#
# So $X^T$ is a matrix for wrenches, but it leads *back*, from $A$ to $B$. The one that leads the way $X$ does is
#
# $$X^* = X^{-T} = \begin{pmatrix} R & [\boldsymbol p]_\times R \\ 0 & R \end{pmatrix}.$$
#
# "Dual means transposed", so people write $X^T$. Here are all three candidates with the force of the ground on the foot,
# 40 N upwards; $B$ is at the foot now.
# %% [markdown] lang="zh"
# 写出来就是:
#
# $$\boldsymbol F_B^T\boldsymbol V_B = \boldsymbol F_A^T\boldsymbol V_A = \boldsymbol F_A^T X\,\boldsymbol V_B
# \quad\text{对所有 } \boldsymbol V_B \quad\Rightarrow\quad \boldsymbol F_B = X^T\boldsymbol F_A, \quad
# \boldsymbol F_A = X^{-T}\boldsymbol F_B.$$
#
# 所以 $X^T$ 确实是变换 wrench 的矩阵,但它的方向是*往回*,从 $A$ 到 $B$。与 $X$ 同方向的是
#
# $$X^* = X^{-T} = \begin{pmatrix} R & [\boldsymbol p]_\times R \\ 0 & R \end{pmatrix}.$$
#
# "对偶就是转置",于是有人写成 $X^T$。下面用地面对脚的力(向上 40 N)把三个候选都试一遍,这里 $B$ 取在脚上。
# %% setup="yes"
foot = tw.frame_placement(model, q, "FR_foot")
T_AF = base.inverse() @ foot
X, X_star = T_AF.motion_transform(), T_AF.force_transform()
force = np.array([0, 0, 40.0])  # in the base's axes, which are the world's here
F_foot = np.concatenate([np.zeros(3), T_AF.rotation.T @ force])
by_hand = np.concatenate([np.cross(T_AF.translation, force), force])  # moment about the base: lever × force
# %%
for name, matrix in {"X*": X_star, "Xᵀ": X.T, "X": X}.items():
    F_base = matrix @ F_foot
    print(f"{name:3} moment {F_base[:3].round(2) + 0.0} N m, force {F_base[3:].round(2) + 0.0} N")
    assert np.allclose(F_base, by_hand, atol=1e-13) == (name == "X*")
assert np.allclose(X_star, np.linalg.inv(X).T, atol=1e-14)
assert np.allclose(X.T @ by_hand, F_foot, atol=1e-13)  # and this is what Xᵀ is for: the way back
# %% [markdown] lang="en"
# ## The same power in every frame
#
# The calf moves at random, the ground pushes on its foot. We take twist and wrench into one frame after the other, down
# the leg and out to the world, and multiply.
# %% [markdown] lang="zh"
# ## 在每个坐标系里功率都相同
#
# 小腿随机运动,地面推着它的脚。把 twist 和 wrench 依次变换到各个坐标系,从脚沿腿一直到世界,再相乘。
# %%
tw.ask("49.3-own", ...)
# %% [markdown] lang="en"
# With $X$ and $X^*$ the power is the same everywhere; with $X^T$ in the place of $X^*$ it is different in every frame, and
# none of these numbers looks impossible. On the site you drag the second frame yourself: [Two frames](../hands/frames.md).
# %% [markdown] lang="zh"
# 用 $X$ 与 $X^*$ 时功率处处相同;用 $X^T$ 代替 $X^*$,每个坐标系里的功率都不一样,而这些数没有一个看上去离谱。
# 在网站上可以自己拖动第二个坐标系:[两个坐标系](../hands/frames.md)。
# %%
rates = rng.standard_normal(model.nv)
V_foot = tw.frame_jacobian(model, q, "FR_foot", "local") @ rates
frames = {"foot": foot, "calf": calf, "thigh": placement[hip + 1], "hip": placement[hip], "base": base}
frames["world"] = tw.SE3.identity()
good, wrong = [], []
for T_world in frames.values():
    T = T_world.inverse() @ foot
    V = T.motion_transform() @ V_foot
    good.append(tw.power(T.force_transform() @ F_foot, V))
    wrong.append(tw.power(T.motion_transform().T @ F_foot, V))
assert np.allclose(good, good[0], rtol=1e-13)
assert np.isclose(wrong, good).tolist() == [True, False, False, False, False, False]

ax = plot.axes_2d(size=(7, 3.5))
ax.bar(np.arange(6) - 0.2, good, 0.4, color=plot.COLOURS["blue"], label="(X* F) · (X V)")
ax.bar(np.arange(6) + 0.2, wrong, 0.4, color=plot.COLOURS["vermilion"], label="(Xᵀ F) · (X V)")
ax.axhline(0, color="k", linewidth=0.8)
ax.set(xticks=range(6), xticklabels=frames, ylabel="power [W]", title="one foot, one push, six frames")
ax.legend()
plt.show()
# %% [markdown] lang="en"
# The two agree only in the foot's own frame, where $X = 1$. A test that stays in this frame cannot distinguish them,
# and neither can a test without rotation and lever arm.
#
# ## What the recursions do with it
#
# Let $X_i$ take twists from the parent's frame to link $i$'s. Velocities go outward with $X_i$: this is the forward pass
# of RNEA (49.6).
#
# $$\boldsymbol V_i = X_i\,\boldsymbol V_{\lambda(i)} + S_i\,\dot q_i$$
# %% [markdown] lang="zh"
# 二者只在脚自己的坐标系里相等,因为那里 $X = 1$。只在这一个坐标系里做的测试分不清它们,没有旋转也没有力臂的测试也一样。
#
# ## 递推算法怎样使用它
#
# 设 $X_i$ 把 twist 从父连杆的坐标系变换到连杆 $i$ 的坐标系。速度用 $X_i$ 向外传递,这就是 RNEA 的正向传递(49.6)。
#
# $$\boldsymbol V_i = X_i\,\boldsymbol V_{\lambda(i)} + S_i\,\dot q_i$$
# %%
outward = [link.inverse().motion_transform() for link in links]  # X_i of hip, thigh, calf
twist = rates[:6]  # the base's own
for i, X_i in zip((hip, hip + 1, hip + 2), outward):
    twist = X_i @ twist + model.joints[i].subspace() @ rates[model.v_slice[i]]
assert np.allclose(twist, tw.forward_kinematics(model, q, rates).twist[hip + 2], atol=1e-14)
# %% [markdown] lang="en"
# Forces come back inward, from $i$ to its parent. The chapter's listings write $X_i^*$ there.
# %% [markdown] lang="zh"
# 力则向内传回,从 $i$ 到父连杆。本章的伪代码在这里写的是 $X_i^*$。
# %%
tw.ask("49.3-first", ...)
# %% [markdown] lang="en"
# Inward is against the direction of $X_i$, so it takes $X_i^T$. As for $X_i^*$: with an $X_i$ that leads outward this is the wrong way round. At each joint the motor
# bears the part of the wrench along its axis, $\tau_i = S_i^T \boldsymbol F_i$. The Jacobian knows the same answer:
# %% [markdown] lang="zh"
# 向内与 $X_i$ 的方向相反,所以用 $X_i^T$。至于 $X_i^*$:既然 $X_i$ 是向外的,
# 这就反了。在每个关节处,电机承担 wrench 沿自己轴的分量,$\tau_i = S_i^T \boldsymbol F_i$。雅可比矩阵给出同样的答案:
# %%
J = tw.frame_jacobian(model, q, "FR_foot", "local")
expected = (J.T @ F_foot)[model.v_slice[hip].start :][:3]


def torques(inward):
    """Torques of hip, thigh and calf under the push, with one matrix for each step inward."""
    F = (calf.inverse() @ foot).force_transform() @ F_foot  # from the foot to the calf's frame
    found = []
    for i in (hip + 2, hip + 1, hip):
        found.insert(0, (model.joints[i].subspace().T @ F).item())
        F = inward[i - hip] @ F
    return np.array(found)


by_transpose = torques([X_i.T for X_i in outward])
by_star = torques([link.inverse().force_transform() for link in links])  # X_i*: leads outward as well
print("Xᵢᵀ ", by_transpose.round(3), "N m\nXᵢ* ", by_star.round(3), "N m\nJᵀF ", expected.round(3), "N m")
assert np.allclose(by_transpose, expected, atol=1e-13)
assert np.isclose(by_star[2], expected[2])  # the first joint is right, so the slip survives a short test
assert np.abs(by_star - expected).max() > 1
# %% [markdown] lang="en"
# ## For engineers
#
# Nothing later needs this; come back to it when you write a program.
#
# ### How exact is a general inverse?
#
# `np.linalg.inv(X)` loses digits with the condition number of $X$: the largest factor by which it stretches a twist, times the
# largest by which it shrinks one.
# %% [markdown] lang="zh"
# ## 给工程师
#
# 后面用不到这一部分,等到自己写程序时再看也不迟。
#
# ### 通用的矩阵求逆有多准?
#
# `np.linalg.inv(X)` 丢失多少位有效数字,要看 $X$ 的条件数:它把 twist 放大的最大倍数,乘以缩小的最大倍数。
# %%
ten_metres = tw.ask("49.3-condition", ...)
ten_metres
# %%
turns, directions = tw.exp3(rng.standard_normal((50, 3))), rng.standard_normal((50, 3))
directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
distances = np.geomspace(0.1, 1000, 13)
condition, of_inv, of_formula = [], [], []
for metres in distances:
    far = tw.SE3(turns, metres * directions)
    exact = tw.SE3(turns.astype(np.longdouble), far.translation.astype(np.longdouble)).inverse().motion_transform()
    condition.append(np.linalg.cond(far.motion_transform()).max())
    of_inv.append(np.abs(np.linalg.inv(far.motion_transform()) - exact).max())
    of_formula.append(np.abs(far.inverse().motion_transform() - exact).max())
assert (np.array(of_inv) > 1.5 * np.array(of_formula)).all()
assert np.allclose(condition[-4:], distances[-4:] ** 2, rtol=0.01)
# %%
figure, axes = plt.subplots(1, 2, figsize=(10, 3.6), layout="constrained")
axes[0].loglog(distances, condition, color=plot.COLOURS["blue"], label="condition number of X")
axes[0].loglog(distances, distances**2, ":", color=plot.COLOURS["grey"], label="distance squared")
if ten_metres.guess:
    axes[0].plot(10, abs(ten_metres.guess), "D", color=plot.COLOURS["purple"], label="your guess")
axes[1].loglog(distances, of_inv, ".-", color=plot.COLOURS["vermilion"], label="error of np.linalg.inv")
axes[1].loglog(distances, of_formula, ".-", color=plot.COLOURS["blue"], label="error of the formula")
for ax in axes:
    ax.set_xlabel("distance of the frames [m]")
    ax.legend()
plt.show()
# %% [markdown] lang="en"
# ### Pinocchio
#
# `SE3.action` is $X$ in the order $(\boldsymbol v, \boldsymbol\omega)$, and `SE3.dualAction` is $X^*$. The chapter's
# listing looks for $[\boldsymbol p]_\times R$ at the bottom left of `action`. Where do you find it?
# %% [markdown] lang="zh"
# ### 与 Pinocchio 对照
#
# `SE3.action` 是按 $(\boldsymbol v, \boldsymbol\omega)$ 排列的 $X$，`SE3.dualAction` 是 $X^*$。
# 本章的代码到 `action` 的左下角去找 $[\boldsymbol p]_\times R$。你在哪里找到它?
# %%
try:
    import pinocchio as pin
except ImportError:
    pin = None
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    pin.forwardKinematics(pin_model, data, q)
    oMi = data.oMi[hip + 2]
    X_world, X_star_world = calf.motion_transform(), calf.force_transform()
    assert np.allclose(tw.bridge.from_pinocchio_transform(oMi.action), X_world, atol=1e-12)
    assert np.allclose(tw.bridge.from_pinocchio_transform(oMi.dualAction), X_star_world, atol=1e-12)
# %%
if pin:
    coupling = pin.skew(oMi.translation) @ oMi.rotation
    assert np.allclose(oMi.action[:3, 3:], coupling)
    assert not oMi.action[3:, :3].any()  # where the chapter expects it
    linear_first = ("vx", "vy", "vz", "ωx", "ωy", "ωz")
    plot.matrix(oMi.action, "oMi.action", rows=linear_first, columns=linear_first, numbers=".2f", rounding=1e-12)
    plt.show()
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.3.1** $X$ and $X^*$ of a pure translation, by hand
# - **49.3.2** $X$ of a pure rotation; when turning both halves is enough
# - **49.3.3** the chain rule, proved
#
# `twistwrench exercises start my_answers`, then `python -m pytest` in that folder; `twistwrench exercises hint 49.3.1`.
# Next: notebook 49.4.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.3.1** 手算纯平移的 $X$ 与 $X^*$
# - **49.3.2** 纯旋转的 $X$;什么时候只要分别旋转两半就够了
# - **49.3.3** 证明链式法则
#
# `twistwrench exercises start my_answers --language zh`,然后在那个文件夹里运行 `python -m pytest`;`twistwrench exercises hint 49.3.1` 给提示。
# 下一个:笔记本 49.4。

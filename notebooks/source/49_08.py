# %% [markdown] lang="en"
# # 49.8 CRBA: the mass matrix
#
# $M(q)$ is the inertia of a robot at each joint, and the coupling of one joint with another. RNEA and ABA do not need
# it; controllers that solve a quadratic program do. Where does each entry come from, which are zero and why,
# and what does it cost?
# %% [markdown] lang="zh"
# # 49.8 CRBA:质量矩阵
#
# $M(q)$ 是机器人在每个关节处的惯量,以及一个关节与另一个关节的耦合。RNEA 和 ABA 都用不着它,
# 而求解二次规划的控制器需要它。每个元素从哪里来,哪些为零、为什么,代价又是多少?
# %%
import twistwrench as tw

model = tw.load("go2")
# %% setup="yes"
import inspect

import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot
from twistwrench.algorithms.crba import composite_rigid_body
from twistwrench.model import tree_terms

np.set_printoptions(formatter={"float_kind": lambda x: f"{round(x, 3) + 0:7.4g}"})
rng = np.random.default_rng(8)
q = model.random_configuration(rng=rng)  # nothing is zero by accident here
rest = np.zeros(model.nv)


# %% [markdown] lang="en"
# ## A column of $M$ is an experiment
#
# The equation of motion is $\tau = M\ddot q + h$. Let the robot be at rest, switch gravity off, and require the
# acceleration 1 of one joint and 0 of all others. The forces that this needs are one column of $M$. `rnea` can do this
# experiment; the part of gravity is subtracted. Two experiments on the left front leg: the knee accelerates and the thigh
# does not, then the other way round. Compare the torques that hold the joint which stays.
# %% [markdown] lang="zh"
# ## $M$ 的一列就是一次实验
#
# 运动方程是 $\tau = M\ddot q + h$。让机器人静止,关掉重力,要求某一个关节的加速度为 1,其余全为 0。
# 所需的力就是 $M$ 的一列。`rnea` 可以做这个实验,再把重力的部分减掉。在左前腿上做两次:先让膝加速而大腿不动,再反过来。
# 比一比让不动的那个关节保持不动所需的力矩。
# %%
columns = tw.rnea(model, q, rest, np.eye(model.nv)) - tw.gravity(model, q)  # row k: the experiment with joint k
thigh, knee = (model.v_slice[model.joint_id(f"FL_{name}_joint")].start for name in ("thigh", "calf"))
print(f"torque at the thigh while the knee accelerates: {columns[knee, thigh]:.5f} N m")
print(f"torque at the knee while the thigh accelerates: {columns[thigh, knee]:.5f} N m")
M = tw.crba(model, q)
assert np.abs(columns.T - M).max() < 1e-12 * np.abs(M).max()
assert np.array_equal(M, M.T)
# %% [markdown] lang="en"
# The knee acts on the thigh as the thigh acts on the knee. That is no accident: $M$ is symmetric, because it is the matrix of
# the kinetic energy. Each body has the twist $V_i = \sum_j {}^i\!X_j S_j \dot q_j$, summed over the
# joints $j$ between it and the world, and so
#
# $$T = \tfrac12 \sum_i V_i^T I_i V_i = \tfrac12\, \dot q^T M \dot q, \qquad
# M_{jk} = \sum_{i\ \text{outboard of}\ j\ \text{and}\ k} ({}^i\!X_j S_j)^T\, I_i\; {}^i\!X_k S_k.$$
# %% [markdown] lang="zh"
# 膝对大腿的作用等于大腿对膝的作用。这不是巧合:$M$ 是对称的,因为它正是动能的系数矩阵。每个刚体的 twist 是
# $V_i = \sum_j {}^i\!X_j S_j \dot q_j$,对它与世界之间的所有关节 $j$ 求和,于是
#
# $$T = \tfrac12 \sum_i V_i^T I_i V_i = \tfrac12\, \dot q^T M \dot q, \qquad
# M_{jk} = \sum_{i\ \text{在}\ j\ \text{与}\ k\text{外侧}} ({}^i\!X_j S_j)^T\, I_i\; {}^i\!X_k S_k.$$
# %%
tw.ask("49.8-both", ...)
# %%
v = rng.standard_normal(model.nv)
twists = tw.forward_kinematics(model, q, v).twist
energies = [inertia.kinetic_energy(V) for inertia, V in zip(model.inertia, twists)]
print(f"kinetic energy {sum(energies):.3f} J, body by body; {v @ M @ v / 2:.3f} J with M")
assert np.isclose(v @ M @ v / 2, sum(energies), rtol=1e-12)
assert np.isclose(tw.kinetic_energy(model, q, v), sum(energies), rtol=1e-12)


# %% [markdown] lang="en"
# ## Two rods, line by line
#
# The experiments again, by hand, on the arm of notebook 49.6 with its elbow bent by a right angle. Column 2 first: the elbow
# accelerates with 1 rad/s², the shoulder not at all. Rod 2 alone moves. It needs the wrench $F = \hat I_2 S_2$, and the
# elbow's motor supplies the part along its own axis:
# %% [markdown] lang="zh"
# ## 两根杆,逐行推导
#
# 在笔记本 49.6 那条肘弯成直角的手臂上,亲手再做一遍这些实验。先看第 2 列:肘以 1 rad/s² 加速,肩没有加速度。只有杆 2 在动。
# 它需要的 wrench 是 $F = \hat I_2 S_2$,肘电机提供沿自己轴的那一份:
# %%
arm, bend = tw.chain(2), np.deg2rad([0, -90])
tree = tree_terms(arm, bend)
S, X, I = tree.S, tree.X, tree.I
F = I[2] @ S[2]
print(F.T, "M22:", S[2].T @ F)
# %% [markdown] lang="en"
# A moment of $ml^2/3$, and 0.5 N for the middle of the rod. The whole wrench goes on to rod 1, $X_2^T$ inward, and the
# shoulder's motor must hold against its part:
# %% [markdown] lang="zh"
# 力矩是 $ml^2/3$,另有 0.5 N 使杆的中点加速。整个 wrench 传给杆 1,用 $X_2^T$ 向内;肩电机要提供沿自己轴的那一份,才能保持不动:
# %%
F = X[2].T @ F
print(F.T, "M12:", S[1].T @ F)
# %% [markdown] lang="en"
# Column 1: the shoulder accelerates, the elbow does not, and both rods move as one rigid body. Its inertia, the **composite
# inertia** $\hat I^C_1$, is the sum in frame 1:
# %% [markdown] lang="zh"
# 第 1 列:肩加速而肘不动,两根杆像一个刚体一样运动。它的惯量叫**复合刚体惯量** $\hat I^C_1$,是两者在坐标系 1 里的和:
# %%
IC1 = I[1] + X[2].T @ I[2] @ X[2]
F = IC1 @ S[1]
print(F.T, "M11:", S[1].T @ F)


# %% [markdown] lang="en"
# $\tfrac13$ for rod 1, and $\tfrac1{12} + (1^2 + 0.5^2)$ for rod 2, whose middle is further out. For any tree, from the tips
# inward, with a climb to the base for each joint:
#
# $$M_{kk} = S_k^T \hat I^C_k S_k, \qquad M_{jk} = S_j^T F_j, \qquad F_{\lambda(j)} = {}^{j}\!X_{\lambda(j)}^T F_j.$$
# %% [markdown] lang="zh"
# 杆 1 是 $\tfrac13$;杆 2 的中点离肩更远,是 $\tfrac1{12} + (1^2 + 0.5^2)$。对任意的树,从末端向内,并且从每个关节一路爬到基座:
#
# $$M_{kk} = S_k^T \hat I^C_k S_k, \qquad M_{jk} = S_j^T F_j, \qquad F_{\lambda(j)} = {}^{j}\!X_{\lambda(j)}^T F_j.$$
# %%
def matrix_of_inertia(model, q):
    t, at, M = tree_terms(model, q), model.v_slice, np.zeros((model.nv, model.nv))
    IC = [*t.I]
    for i in t.inward:
        j, F = i, IC[i] @ t.S[i]
        M[at[i], at[i]] = t.S[i].T @ F
        while t.parent[j] > 0:
            j, F = t.parent[j], t.X[j].T @ F
            M[at[j], at[i]] = t.S[j].T @ F
            M[at[i], at[j]] = M[at[j], at[i]].T
        IC[t.parent[i]] = IC[t.parent[i]] + t.X[i].T @ IC[i] @ t.X[i]
    return M


# %%
print(matrix_of_inertia(arm, bend))
difference = np.abs(matrix_of_inertia(model, q) - M).max()
print(f"Go2, the function above against tw.crba: {difference:.0e} of {M.max():.0f} kg")
assert np.allclose(matrix_of_inertia(arm, bend), [[5 / 3, 1 / 3], [1 / 3, 1 / 3]], rtol=0.003)
assert np.allclose(matrix_of_inertia(arm, bend), tw.crba(arm, bend), rtol=1e-12)
assert difference < 1e-12 * M.max()
# %% [markdown] lang="en"
# So it stands in the package; on the site, with its numbers: [CRBA, line by line](../algorithms/crba.md). (The chapter's
# pseudocode climbs with $X^*$ of an $X$ that leads outward, which is the wrong way round; and it stops before link 0, which
# is the base, so its matrix has no base rows.)
# %% [markdown] lang="zh"
# 程序包里就是这样写的;网站上有一页可以带着数值读:[逐行读 CRBA](../algorithms/crba.md)。(本章伪代码爬升时用的是向外的 $X$ 的 $X^*$,方向反了;
# 而且它到 0 号连杆,也就是基座之前就停了,所以算出的矩阵没有基座行。)
# %%
print(inspect.getsource(composite_rigid_body))
# %% [markdown] lang="en"
# Inward goes a sum: what each joint of Go2 would move if all joints beyond it were locked. The base carries everything.
# %% [markdown] lang="zh"
# 向内传的是一个和:外侧关节全部锁死时,Go2 的每个关节要带动多少。基座承载全部质量。
# %%
terms = tw.crba_terms(model, q)
masses = [float(IC[3, 3]) for IC in terms.IC]
plot.flow(model, ["", *(f"{mass:.2f} kg" for mass in masses[1:])], inward=True, amounts=masses)
plt.show()
placement = tw.forward_kinematics(model, q).placement
calf, thigh = model.joint_id("FR_calf_joint"), model.joint_id("FR_thigh_joint")
link = placement[thigh].inverse() @ placement[calf]
both = model.inertia[thigh] + model.inertia[calf].transform(link)
assert np.allclose(terms.IC[thigh], both.matrix(), rtol=1e-12, atol=1e-12)  # the calf is all that the thigh carries
assert np.isclose(masses[1], model.mass)


# %% [markdown] lang="en"
# **Exercise 49.8.1.** What is then the upper left 6 × 6 block of $M$? The chapter calls it the inertia of the base,
# and not diagonal because of the centre of mass. Build it from the inertias of the bodies, and see whether you agree.
# %% [markdown] lang="zh"
# **练习 49.8.1。** 那么 $M$ 左上角的 6 × 6 块是什么?本章说它是基座的惯量,因质心位置而不是对角阵。由各刚体的惯量构造它,
# 看看你是否同意。
# %%
def base_block(model, q):
    """Return the base's block of M(q), without M: the inertia of all bodies, moved into the base's frame."""
    return ...


tw.exercises.check("49.8.1", base_block)
# %% after="49.8.1"
com = tw.unskew(terms.IC[1][:3, 3:]) / masses[1]
assert np.allclose(M[:6, :6], terms.IC[1], rtol=1e-12, atol=1e-12)
assert np.allclose(com, placement[1].inverse().act(tw.center_of_mass(model, q)), rtol=1e-12, atol=1e-12)


# %% [markdown] lang="en"
# ## Which entries are zero
#
# First the size.
#
# **Exercise 49.8.2.** How large is $M$ of Go2 with its floating base, and with a fixed one? And where in the larger matrix is the smaller?
# %% [markdown] lang="zh"
# ## 哪些元素为零
#
# 先看有多少个元素。
#
# **练习 49.8.2。** Go2 带浮动基座时 $M$ 多大,固定基座时多大?小矩阵在大矩阵的什么位置?
# %%
def held_mass_matrix(M):
    """Return the mass matrix of the same robot in the same posture with its base held."""
    return ...


tw.exercises.check("49.8.2", held_mass_matrix)
# %% [markdown] lang="en"
# The climb from a joint visits the joints between it and the base, and no others.
# %% [markdown] lang="zh"
# 从一个关节往上爬,只经过它与基座之间的关节,不经过别的。
# %%
tw.ask("49.8-zeros", ...)
# %% [markdown] lang="en"
# Here is $M$ beside the tree. The colours show the largest value that each entry took in 50 random postures; what is
# white was zero in all of them. Why are some of the white squares dotted?
# %% [markdown] lang="zh"
# 下面是 $M$ 和运动树。颜色表示每个元素在 50 个随机位形中取到的最大值,白色表示在所有这些位形中都是零。为什么有些白格里有一个点?
# %% thumbnail="yes"
postures = np.array([model.random_configuration(rng=rng) for _ in range(50)])
many = tw.crba(model, postures)
plot.mass_matrix(model, many, "mass matrix of Go2, 50 postures")
plt.show()

zero = (np.abs(many) < 1e-12).all(axis=0)
branch = plot.same_branch(model)
assert zero[~branch].all()
assert (~branch).sum() == 108  # a third of the 324 entries: legs are not coupled
# %% [markdown] lang="en"
# The blank blocks come from the tree: no body is outboard of both a front and a rear leg's joint. The dots are zeros that the
# tree does not explain. The chapter's picture has the base's rows full; sixteen of their entries are zero.
# %% [markdown] lang="zh"
# 空白的大块来自树结构:没有哪个刚体同时在前腿和后腿的关节外侧。带点的零则是树结构解释不了的。
# 本章的示意图里基座行是满的,其实其中有十六个元素为零。
# %% [markdown] lang="en" after="49.8.1"
# - The base's block is the composite inertia of the whole robot,
#   $\begin{pmatrix} \bar I & m[c]_\times \\ -m[c]_\times & m 1 \end{pmatrix}$: off its diagonal $m1$ has six zeros, and
#   the two $[c]_\times$ have three each on theirs.
# - To turn a leg about the hip's x axis takes no force along x: four more, one for each leg.
# %% [markdown] lang="zh" after="49.8.1"
# - 基座块就是整个机器人的复合刚体惯量
#   $\begin{pmatrix} \bar I & m[c]_\times \\ -m[c]_\times & m 1 \end{pmatrix}$:其中 $m1$ 的非对角元素有六个零,
#   两个 $[c]_\times$ 的对角线上各有三个。
# - 让腿绕髋的 x 轴转,不需要沿 x 方向的力:又是四个零,每条腿一个。
# %%
assert M.shape == (18, 18)
assert zero[:6, :6].sum() == 12
hips = [model.v_slice[model.joint_id(f"{leg}_hip_joint")].start for leg in ("FL", "FR", "RL", "RR")]
assert np.argwhere(zero[:6, 6:]).tolist() == [[3, start - 6] for start in hips]  # row 3 is the force along x
assert (zero & branch).sum() == 12 + 2 * 4  # the same four again in the columns
# %% [markdown] lang="en"
# ## Keeping the zeros
#
# To solve $M\ddot q = \tau - h$ one factors $M$ into triangles. Where to begin?
# %% [markdown] lang="zh"
# ## 保留这些零
#
# 求解 $M\ddot q = \tau - h$ 时,要把 $M$ 分解成三角矩阵。从哪里开始?
# %%
tw.ask("49.8-fill", ...)
# %% [markdown] lang="en"
# Beginning with the base, as the textbook does, couples all legs: the zeros fill up. Beginning with the tips loses none of
# them. It is the same lesson as in ABA: work from the tips inward.
# %% [markdown] lang="zh"
# 照教科书的顺序从基座开始消元,所有的腿就耦合在一起,
# 零被填满;从末端开始消元,一个零也不会丢。这和 ABA 是同一个道理:从末端向内做。
# %%
base_first = np.linalg.cholesky(M)  # M = L Lᵀ
tips_first = np.linalg.cholesky(M[::-1, ::-1])[::-1, ::-1]  # M = U Uᵀ: the same, with rows and columns reversed
assert np.allclose(tips_first @ tips_first.T, M, rtol=1e-12, atol=1e-12)

figure, axes = plt.subplots(1, 2, figsize=(9, 4.6), layout="constrained")
for ax, triangle, title in zip(axes, (base_first, tips_first), ("base first: L", "tips first: U")):
    plot.matrix(triangle, title, lines=[6, *hips], rounding=1e-12, ax=ax)
plt.show()

other_legs = ~branch
assert (np.abs(base_first[other_legs & np.tri(18, dtype=bool)]) > 1e-12).sum() == 54  # all of them
assert np.abs(tips_first[other_legs]).max() < 1e-12
# %% [markdown] lang="en"
# ## Positive definite, and when not
#
# $\dot q^T M \dot q = 2T$ is positive for every motion, as long as no motion leaves everything that has mass at rest.
# So the eigenvalues of $M$ are positive and its rank is full.
# %% [markdown] lang="zh"
# ## 正定,以及什么时候不正定
#
# 只要没有哪种运动能让所有带质量的东西都静止,$\dot q^T M \dot q = 2T$ 对任何运动都为正。所以 $M$ 的特征值都为正,满秩。
# %%
tw.ask("49.8-bare", ...)
# %% [markdown] lang="en"
# A last link without mass can turn without any energy. Then forward dynamics has no answer, and `aba` raises an error.
# %% [markdown] lang="zh"
# 末端连杆没有质量时,它的关节转动不需要能量。这时正向动力学没有答案,`aba` 会报错。
# %%
eigenvalues = np.linalg.eigvalsh(many)
print(f"eigenvalues in 50 postures: {eigenvalues.min():.2g} to {eigenvalues.max():.3g}")
assert eigenvalues.min() > 0
assert np.linalg.matrix_rank(M) == 18

builder = tw.Builder("arm with a bare tool")
end, rod = tw.SE3(np.eye(3), [0, 0, -1]), tw.SpatialInertia(1.0, [0, 0, -0.5], np.diag([0.084, 0.084, 0.001]))
builder.link("upper", parent="base_link", joint=tw.Revolute("y"), inertia=rod)
builder.link("tool", parent="upper", joint=tw.Revolute("x"), placement=end)
bare = builder.build()
assert np.linalg.matrix_rank(tw.crba(bare, [0.1, 0.2])) == 1
try:
    tw.aba(bare, [0.1, 0.2], [0, 0], [0, 1])
except tw.SingularError as error:
    print(error)
else:
    raise AssertionError("a torque on nothing has been given an acceleration")
# %% [markdown] lang="en"
# ## What it costs
#
# How does the work grow with the number of links? The chapter does not say the same in all places.
# %% [markdown] lang="zh"
# ## 计算代价
#
# 计算量怎样随连杆数增长?本章前后的说法并不一致。
# %%
tw.ask("49.8-chain", ...)
# %% [markdown] lang="en"
# The table in 49.1 calls CRBA linear, 49.8 says $O(N^2)$. Each joint climbs to the base, so the cost is
# $O(N \cdot \mathrm{depth})$: both are right for some robot. We count the lines that are executed, for a chain, for legs
# of three links, and for a bush, where the base carries every link.
# %% [markdown] lang="zh"
# 49.1 的表格说 CRBA 是线性的,49.8 说是 $O(N^2)$。每个关节都要爬到基座,所以代价是 $O(N \cdot \mathrm{depth})$:对某种机器人来说,两种说法都对。我们数一数执行的行数:链、每条腿三个连杆的多腿机器人,
# 以及所有连杆都直接挂在基座上的“灌木”。
# %% setup="yes"
carriers = {
    "chain": lambda k: k - 1,
    "legs of three": lambda k: k - 1 if k % 3 else -1,
    "bush": lambda k: -1,
}


def grow(carrier, n):
    """Build a tree of n links on a fixed base; -1 is the base."""
    builder = tw.Builder("tree")
    for k in range(n):
        parent = "base_link" if carrier(k) < 0 else f"link_{carrier(k)}"
        builder.link(f"link_{k}", parent=parent, joint=tw.Revolute("y"), inertia=rod, placement=end)
    return builder.build()


def executed_lines(tree):
    """Count the lines of CRBA that set a term, those in loops every time."""
    return len(tw.trace(tree, "crba", np.full(tree.nq, 0.3)).steps)


sizes = [3, 6, 12, 24, 48]
trees = {name: [grow(carrier, n) for n in sizes] for name, carrier in carriers.items()}
lines = {name: np.array([executed_lines(tree) for tree in family]) for name, family in trees.items()}
climbs = {name: [sum(len(t.support(i)) - 1 for i in range(1, t.nbodies)) for t in trees[name]] for name in trees}
# %%
ax = plot.axes_2d(size=(6, 3.6))
for (name, counted), colour in zip(lines.items(), ("vermilion", "green", "blue")):
    ax.loglog(sizes, counted, "o-", color=plot.COLOURS[colour], label=name)
ax.set(xlabel="number of links N", ylabel="lines executed", title="the work of CRBA depends on the tree")
ax.set_xticks(sizes, [str(n) for n in sizes], minor=False)
ax.minorticks_off()
ax.grid(alpha=0.3)
ax.legend()
plt.show()

all_lines = np.concatenate(list(lines.values()))
counts = np.stack([np.ones(15), np.tile(sizes, 3), np.concatenate(list(climbs.values()))], axis=-1)
price = np.linalg.lstsq(counts, all_lines)[0]
price = price.round(6) + 0.0
print("lines = {:.0f} + {:.0f} N + {:.0f} × (steps up the tree)".format(*price))
assert np.allclose(counts @ price, all_lines, atol=1e-6)  # exactly: nothing else costs anything
assert np.array_equal(climbs["chain"], [n * (n - 1) // 2 for n in sizes])
assert climbs["legs of three"] == sizes  # 0 + 1 + 2 steps for the three links of a leg
assert lines["chain"][-1] / lines["chain"][-2] > 3.7  # twice the links, almost four times the work
assert lines["bush"][-1] / lines["bush"][-2] == 2
# %% [markdown] lang="en"
# The work follows the number of entries: the matrix of the chain is full, and that of the bush is diagonal:
# %% [markdown] lang="zh"
# 计算量与元素的个数相当:链的矩阵是满的,灌木的矩阵是对角的:
# %%
for name, family in trees.items():
    entries = [np.count_nonzero(tw.crba(tree, rng.uniform(-1, 1, tree.nq))) for tree in family]
    print(f"{name:13} entries that are not zero:", *entries)
    assert np.array_equal(entries, np.array(sizes) + 2 * np.array(climbs[name]))
# %% [markdown] lang="en"
# ## Pinocchio
#
# The same matrix, with the base's rows and columns in the order (linear, angular). The chapter says that `pin.crba` fills
# the upper triangle only.
# %% [markdown] lang="zh"
# ## 与 Pinocchio 对照
#
# 同一个矩阵,只是基座的行和列按(线,角)排列。本章说 `pin.crba` 只填上三角。
# %%
tw.ask("49.8-recipe", ...)
# %%
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    pin_model = tw.bridge.to_pinocchio_model(model)
    theirs = pin.crba(pin_model, pin_model.createData(), q)
    assert np.abs(tw.bridge.from_pinocchio_matrix(model, theirs) - M).max() < 1e-12 * np.abs(M).max()
    assert np.array_equal(theirs, theirs.T)

    recipe = theirs + theirs.T - np.diag(theirs.diagonal())
    off_diagonal = ~np.eye(18, dtype=bool)
    assert np.allclose(recipe[off_diagonal], 2 * theirs[off_diagonal])
    right, doubled = (np.linalg.eigvalsh(matrix).min() for matrix in (theirs, recipe))
    print(f"smallest eigenvalue {right:.4f}, with the recipe {doubled:.4f}")
    assert right > 0 > doubled  # a motion with negative energy
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.8.1** the base's block of $M$ in the neutral configuration, and why it is not diagonal
# - **49.8.2** how large $M$ is with a floating base, and with a fixed one
#
# `twistwrench exercises start my_answers`, then `python -m pytest` in that folder; `twistwrench exercises hint 49.8.1`.
# Next: notebook 49.9.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.8.1** 零位形下 $M$ 的基座块,它为什么不是对角阵
# - **49.8.2** 浮动基座时 $M$ 多大,固定基座时多大
#
# `twistwrench exercises start my_answers --language zh`,然后在那个文件夹里运行 `python -m pytest`；`twistwrench exercises hint 49.8.1` 给提示。
# 下一个:笔记本 49.9。

# %% [markdown] lang="en"
# # 49.7 ABA: forward dynamics
#
# Given the forces at the joints, how does the robot accelerate? You could build $M$ and solve. The articulated-body
# algorithm does without $M$. At each joint it needs the inertia that the joint feels when everything beyond it is free to
# move: the *apparent inertia*. You hold it in the hand, and the three passes grow from it.
# %% [markdown] lang="zh"
# # 49.7 ABA:正向动力学
#
# 给定各关节的力,机器人怎样加速?可以构造 $M$ 再求解。铰接体算法不用 $M$,只需要每个关节在外侧(远离基座)关节全部自由时
# 所带动的惯量,即*表观惯量*。先用手感受它,再由它推导出三遍递推。
# %%
import twistwrench as tw

model = tw.load("go2")
q = model.standing()
# %% setup="yes"
import inspect

import matplotlib.pyplot as plt
import mpmath
import numpy as np

from twistwrench import newton_euler_3d, plot
from twistwrench.algorithms.aba import articulated_body
from twistwrench.model import tree_terms

try:
    import pinocchio as pin
except ImportError:
    pin = None
    print("Pinocchio is not installed (pip install pin): the comparisons below are skipped")

np.set_printoptions(formatter={"float_kind": lambda x: f"{round(x, 3) + 0:7.4g}"})
rng = np.random.default_rng(7)
v, tau = rng.standard_normal((2, model.nv))
rest = np.zeros(model.nv)
# %% [markdown] lang="en"
# ## A pendulum in the hand
#
# Hold a rod by a hinge at its upper end and move the hinge. Everything is at rest before, and gravity is left out.
# %% [markdown] lang="zh"
# ## 握在手里的单摆
#
# 用手通过一个旋转关节握住杆的上端,移动这个关节。起初一切静止,不计重力。
# %%
tw.ask("49.7-rod", ...)
# %% [markdown] lang="en"
# The rod follows with $\boldsymbol a = \boldsymbol a_{hand} + S \ddot q$ and takes $\boldsymbol F = \hat I \boldsymbol a$:
# that is all, because nothing moves yet ($\boldsymbol V \times^* \hat I \boldsymbol V = 0$) and nothing weighs. The hinge is
# free and transmits nothing along $S$, so $S^T \boldsymbol F = 0$. That gives $\ddot q$, and with it the force of the hand:
#
# $$\boldsymbol F = \Big(\hat I - \hat I S\,(S^T \hat I S)^{-1} S^T \hat I\Big)\,\boldsymbol a_{hand}.$$
#
# The bracket is an **articulated inertia**: the inertia of the rod minus the part along the free joint. Ten numbers no
# longer describe it: which mass it shows depends on the direction.
# %% [markdown] lang="zh"
# 杆跟着动,$\boldsymbol a = \boldsymbol a_{hand} + S \ddot q$,需要 $\boldsymbol F = \hat I \boldsymbol a$。只有这一项,
# 因为起初静止($\boldsymbol V \times^* \hat I \boldsymbol V = 0$),又不计重力。关节是自由的:沿 $S$ 不传递力矩,所以
# $S^T \boldsymbol F = 0$。由此得到 $\ddot q$,也就知道手要用多大的力:
#
# $$\boldsymbol F = \Big(\hat I - \hat I S\,(S^T \hat I S)^{-1} S^T \hat I\Big)\,\boldsymbol a_{hand}.$$
#
# 括号里就是**铰接体惯量**:杆的惯量,减去沿自由关节的那部分。它不再能用十个数表示:表观质量取决于方向。
# %%
rod = tw.chain(1, mass=2.0).inertia[1]  # 1 m long, hangs along −z
S = tw.Revolute("y").subspace()
I = rod.matrix()
apparent = I - I @ S @ np.linalg.inv(S.T @ I @ S) @ S.T @ I
assert np.allclose(apparent @ S, 0, atol=1e-12)  # turning the hand about the hinge moves nothing
assert np.isclose(apparent[5, 5], 2.0)  # kg, along the rod
assert np.isclose(apparent[3, 3], 2.0 / 4, rtol=0.01)  # kg, across
assert np.isclose(apparent[4, 4], 2.0)  # along the hinge it cannot swing
# %%
figure, axes = plt.subplots(1, 3, figsize=(10, 3.8), layout="constrained", sharey=True)
for ax, angle in zip(axes, np.deg2rad([0, 40, 90])):
    X = tw.SE3(tw.exp3([0, -angle, 0]), np.zeros(3)).inverse().motion_transform()  # from the hand to the turned rod
    ax.plot([0, np.sin(angle)], [0, -np.cos(angle)], color=plot.COLOURS["grey"], linewidth=6, solid_capstyle="round")
    plot.apparent_mass_ellipse(I, scale=0.4, colour=plot.COLOURS["orange"], label="hinge locked", ax=ax)
    plot.apparent_mass_ellipse(X.T @ apparent @ X, scale=0.4, label="hinge free", ax=ax)
    ax.plot(0, 0, "k.")
    ax.set(title=f"rod at {np.rad2deg(angle):.0f}°", xlabel="force along x for 1 m/s²", xticks=[-0.8, 0, 0.8])
    ax.set(xticklabels=["−2 N", "0", "2 N"], yticks=[])
figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
plt.show()
# %% [markdown] lang="en"
# Each point of a curve is the force that gives the hand 1 m/s² in some direction: a circle if the hinge is locked, an
# ellipse that is thin across the rod if it is free.
# %% [markdown] lang="zh"
# 曲线上每个点,是让手在某个方向得到 1 m/s² 所需的力:关节锁死时是一个圆;关节自由时是椭圆,垂直于杆的方向很窄。
# %% [markdown] lang="en"
# ## Two rods, line by line
#
# The arm of notebook 49.6, its elbow bent by a right angle, turns at 1 and 2 rad/s, and its motors are switched off. How does
# it accelerate? Whatever hangs beyond a joint, its wrench is linear in the acceleration of the body there:
#
# $$\boldsymbol F_i = \hat I_i^A \boldsymbol a_i + \boldsymbol p_i^A.$$
#
# The **bias wrench** $\boldsymbol p_i^A$ is what it takes without acceleration. **Pass 1**, outward, has what depends on
# the velocities alone: the twists of 49.6, the bias acceleration $\boldsymbol c_i = \boldsymbol V_i \times S_i \dot q_i$, and
# $\boldsymbol V_i \times^* \hat I_i \boldsymbol V_i$.
# %% [markdown] lang="zh"
# ## 两根杆,逐行推导
#
# 笔记本 49.6 的那条手臂:肘弯成直角,两个关节以 1 和 2 rad/s 转动,电机断电。它怎样加速?不管关节外侧挂着什么,
# 所需的 wrench 对那里的刚体的加速度总是线性的:
#
# $$\boldsymbol F_i = \hat I_i^A \boldsymbol a_i + \boldsymbol p_i^A.$$
#
# **偏置力** $\boldsymbol p_i^A$ 是没有加速度时所需的。**第 1 遍**向外,只算由速度决定的量:49.6 的 twist、
# 偏置加速度 $\boldsymbol c_i = \boldsymbol V_i \times S_i \dot q_i$,以及 $\boldsymbol V_i \times^* \hat I_i \boldsymbol V_i$。
# %%
arm, bend, speeds = tw.chain(2), np.deg2rad([0, -90]), np.array([1.0, 2.0])
tree = tree_terms(arm, bend)
S, X, I = tree.S, tree.X, tree.I
V, c, pA = np.zeros((3, 3, 6))  # a row for the world and one for each rod
# %%
for i in (1, 2):
    vJ = S[i] @ speeds[i - 1 : i]
    V[i] = X[i] @ V[i - 1] + vJ
    c[i] = tw.cross_motion(V[i]) @ vJ
    pA[i] = tw.cross_force(V[i]) @ I[i] @ V[i]
print(c, pA, sep="\n")
# %% [markdown] lang="en"
# **Pass 2**, inward, begins at the tip. Nothing hangs on rod 2: $\hat I_2^A = \hat I_2$. What does a unit acceleration of its
# joint need, and how much of it along the joint? And what does the motor, here 0, leave for it?
# %% [markdown] lang="zh"
# **第 2 遍**向内,从末端开始。杆 2 上什么也没挂:$\hat I_2^A = \hat I_2$。关节的单位加速度需要多大的 wrench,其中沿关节的是多少?
# 电机(这里是 0)又留下多少?
# %%
U = I[2] @ S[2]
D = S[2].T @ U
u = 0 - S[2].T @ pA[2]
print(U.T, D, u)
# %% [markdown] lang="en"
# $D$ is the inertia of a rod about its end, $ml^2/3$. Now eliminate $\ddot q$, as with the hand. Write
# $\boldsymbol a' = X_i\boldsymbol a_\lambda + \boldsymbol c_i$ for the acceleration of body $i$ if its joint does not
# accelerate. The motor fixes the part of the wrench along the joint:
#
# $$S_i^T\big(\hat I_i^A(\boldsymbol a' + S_i\ddot q_i) + \boldsymbol p_i^A\big) = \tau_i
# \quad\Rightarrow\quad \ddot q_i = D_i^{-1}(u_i - U_i^T\boldsymbol a').$$
#
# Put this back into $\boldsymbol F_i$, and the parent sees again an inertia and a bias wrench:
#
# $$\boldsymbol F_i = \underbrace{(\hat I_i^A - U_i D_i^{-1}U_i^T)}_{\hat I_i^a}\,X_i\boldsymbol a_\lambda
# + \underbrace{\boldsymbol p_i^A + \hat I_i^a\boldsymbol c_i + U_i D_i^{-1}u_i}_{\boldsymbol p_i^a}.$$
# %% [markdown] lang="zh"
# $D$ 就是杆绕一端的转动惯量 $ml^2/3$。现在像用手握杆时那样消去 $\ddot q$。设
# $\boldsymbol a' = X_i\boldsymbol a_\lambda + \boldsymbol c_i$ 为关节没有加速度时刚体 $i$ 的加速度。电机决定了 wrench 沿关节的分量:
#
# $$S_i^T\big(\hat I_i^A(\boldsymbol a' + S_i\ddot q_i) + \boldsymbol p_i^A\big) = \tau_i
# \quad\Rightarrow\quad \ddot q_i = D_i^{-1}(u_i - U_i^T\boldsymbol a').$$
#
# 代回 $\boldsymbol F_i$,父连杆看到的仍是一个惯量和一个偏置力:
#
# $$\boldsymbol F_i = \underbrace{(\hat I_i^A - U_i D_i^{-1}U_i^T)}_{\hat I_i^a}\,X_i\boldsymbol a_\lambda
# + \underbrace{\boldsymbol p_i^A + \hat I_i^a\boldsymbol c_i + U_i D_i^{-1}u_i}_{\boldsymbol p_i^a}.$$
# %%
Ia = I[2] - U @ U.T / D
pa = pA[2] + Ia @ c[2] + U @ (u / D[0])
print(Ia.diagonal(), pa)
# %% [markdown] lang="en"
# The last three of the diagonal are kilograms: across the rod, beside it, along it. Taken into the frame of rod 1 by
# $X_2^T$ (the chapter writes $X^*$ here, which leads outward, as in 49.6), they add to its own:
# %% [markdown] lang="zh"
# 对角线的后三个数单位是千克:垂直于杆、侧向、沿杆。用 $X_2^T$ 换到杆 1 的坐标系里(本章这里写的是 $X^*$,和 49.6 一样是向外的),加到它自己的上面:
# %%
IA1 = I[1] + X[2].T @ Ia @ X[2]
pA1 = pA[1] + X[2].T @ pa
print(IA1.diagonal(), pA1)


# %% [markdown] lang="en"
# Rod 1 carries all of rod 2 sideways, but only a part of it upward, where the elbow gives way. With the same lines for
# joint 1 we are at the wall, which rises with $-\boldsymbol g$. **Pass 3**, outward again, puts in the accelerations.
#
# For any tree, one function for each pass. The first has nothing new:
# %% [markdown] lang="zh"
# 杆 1 沿水平方向带动整根杆 2,向上却只带动一部分,因为肘会退让。对关节 1 用同样的几行,就到了墙,墙以 $-\boldsymbol g$ 上升。
# **第 3 遍**再次向外,代入加速度。
#
# 对任意的树,每一遍写成一个函数。第一遍没有新内容:
# %%
def pass_1(t, at, v):
    V, c, pA = np.zeros((3, len(t.I), 6))
    for i in t.outward:
        vJ = t.S[i] @ v[at[i]]
        V[i] = t.X[i] @ V[t.parent[i]] + vJ
        c[i] = tw.cross_motion(V[i]) @ vJ
        pA[i] = tw.cross_force(V[i]) @ t.I[i] @ V[i]
    return c, pA


# %% [markdown] lang="en"
# The second is what you did with rod 2, for each body from the tips inward:
# %% [markdown] lang="zh"
# 第二遍就是上面对杆 2 做的事,从末端开始,每个刚体做一次:
# %%
def pass_2(t, at, tau, c, pA):
    IA, U, D, u = [*t.I], {}, {}, {}
    for i in t.inward:
        U[i] = IA[i] @ t.S[i]
        D[i] = np.linalg.inv(t.S[i].T @ U[i])
        u[i] = tau[at[i]] - t.S[i].T @ pA[i]
        Ia = IA[i] - U[i] @ D[i] @ U[i].T
        pa = pA[i] + Ia @ c[i] + U[i] @ D[i] @ u[i]
        IA[t.parent[i]] = IA[t.parent[i]] + t.X[i].T @ Ia @ t.X[i]
        pA[t.parent[i]] += t.X[i].T @ pa
    return U, D, u


# %% [markdown] lang="en"
# The third begins with the world that rises, and computes $\ddot q_i$ from $\boldsymbol a'$, as derived above:
# %% [markdown] lang="zh"
# 第三遍从向上加速的世界开始,按上面推导的式子由 $\boldsymbol a'$ 求 $\ddot q_i$:
# %%
def pass_3(t, at, a_0, c, U, D, u):
    A, qdd = np.zeros((len(t.I), 6)), np.zeros(at[-1].stop)
    A[0, 3:] = a_0
    for i in t.outward:
        a = t.X[i] @ A[t.parent[i]] + c[i]
        qdd[at[i]] = D[i] @ (u[i] - U[i].T @ a)
        A[i] = a + t.S[i] @ qdd[at[i]]
    return qdd


# %% [markdown] lang="en"
# That is ABA:
# %% [markdown] lang="zh"
# 合起来就是 ABA:
# %%
def accelerations(model, q, v, tau):
    t, at = tree_terms(model, q), model.v_slice
    c, pA = pass_1(t, at, v)
    U, D, u = pass_2(t, at, tau, c, pA)
    return pass_3(t, at, -model.gravity, c, U, D, u)


# %%
drop, qdd = accelerations(arm, bend, speeds, np.zeros(2)), tw.aba(model, q, v, tau)
print("the arm:", drop, "rad/s²; does 49.6 agree?", tw.rnea(arm, bend, speeds, drop).round(12) + 0.0, "N m")
difference = np.abs(accelerations(model, q, v, tau) - qdd).max()
print(f"Go2, the functions above against tw.aba: {difference:.0e} of {np.abs(qdd).max():.0f} rad/s²")
assert np.isclose(D, 1 / 3, rtol=0.01)
assert np.allclose(Ia.diagonal()[3:], [0.25, 1, 1], rtol=0.01)
assert np.allclose(IA1.diagonal()[[3, 5]], [1 + 1, 1 + 0.25], rtol=0.01)
assert np.allclose(tw.rnea(arm, bend, speeds, drop), 0, atol=1e-12)
assert difference < 1e-11 * np.abs(qdd).max()
# %% [markdown] lang="en"
# So it stands in the package; on the site, with its numbers: [ABA, line by line](../algorithms/aba.md).
# %% [markdown] lang="zh"
# 程序包里就是这样写的;网站上有一页可以带着数值读:[逐行读 ABA](../algorithms/aba.md)。
# %%
print(inspect.getsource(articulated_body))
# %% [markdown] lang="en"
# The same three passes on Go2, in mid-stride in the air, its motors off. Outward go the twists; inward what each joint lets
# its parent feel, least and greatest mass over all directions, and the bias force; outward again the accelerations, seen
# from a world that rises.
# %% [markdown] lang="zh"
# 在 Go2 上做同样的三遍:它在空中跨步,电机断电。向外传 twist;向内传父连杆通过每个关节感到的量,即各方向上最小和最大的表观质量,以及偏置力;
# 再向外传加速度,从向上加速的世界看。
# %%
stride = rest.copy()
stride[3] = 0.8  # m/s
stride[7::3], stride[8::3] = [-5, 2, 2, -5], [4, -1.6, -1.6, 4]  # rad/s, thighs and calves
fall = tw.aba_terms(model, q, stride, rest)
# %%
figure, axes = plt.subplots(3, 1, figsize=(10, 9.5), layout="constrained")
blue, green, red = (plot.COLOURS[name] for name in ("blue", "green", "vermilion"))
V_all, A_all, pa_all = (np.array(rows)[1:] for rows in (fall.V, fall.A, fall.pa))
felt = np.linalg.eigvalsh(np.array(fall.Ia)[1:, 3:, 3:]).clip(0)


def lengths(rows, part):
    """Lengths of one half of each row."""
    return np.linalg.norm(rows[:, part], axis=1)


ends, turns = slice(3, 6), slice(0, 3)
twist_texts = [f"{w:.1f} rad/s\n{x:.1f} m/s" for w, x in zip(lengths(V_all, turns), lengths(V_all, ends))]
bias = lengths(pa_all, ends)
felt_texts = [f"{low:.2f}–{high:.2f} kg\n{f:.1f} N" for (low, _, high), f in zip(felt, bias)]
rate_texts = [f"{w:.0f} rad/s²\n{x:.1f} m/s²" for w, x in zip(lengths(A_all, turns), lengths(A_all, ends))]
passes = [
    ("1. outward: twists |ω|, |v|", twist_texts, lengths(V_all, ends), blue),
    ("2. inward: apparent mass, bias force", felt_texts, felt[:, 2], red),
    ("3. outward: accelerations |α|, |a|", rate_texts, lengths(A_all, ends), green),
]
for ax, (title, texts, amounts, colour) in zip(axes, passes):
    plot.flow(model, ["", *texts], inward=colour == red, amounts=[0, *amounts], colour=colour, ax=ax)
    ax.set_title(title, loc="left", fontsize=11)
plt.show()

terms = tw.aba_terms(model, q, v, tau)
A, D, IA, pA = np.array(terms.A), terms.D, np.array(terms.IA), np.array(terms.pA)
through = tw.joint_wrenches(model, q, v, qdd)
assert np.allclose(np.matvec(IA, A)[1:] + pA[1:], through[1:], atol=1e-10)  # F = I^A a + p^A, for every body
assert np.allclose(IA[0], 0, atol=1e-12)  # a base that is free hands nothing on to the world


# %% [markdown] lang="en"
# ## Locked or free
#
# Two inertias answer two questions about the same subtree:
#
# - **composite** $\hat I^C$: joints *locked*, one rigid body (49.5). CRBA builds $M$ from it, and $S_i^T \hat I_i^C S_i$
#   is the entry $M_{ii}$.
# - **articulated** $\hat I^A$: joints *free*. $D_i = S_i^T \hat I_i^A S_i$ is the apparent inertia at the motor, provided
#   that the parent body is held. (The motor pushes the parent back with the same torque.)
#
# Freeing joints can only make the inertia smaller. By how much?
# %% [markdown] lang="zh"
# ## 锁死还是自由
#
# 对同一棵子树,两种惯量回答两个问题:
#
# - **复合刚体惯量** $\hat I^C$:关节*锁死*,成为一个刚体(49.5)。CRBA 用它构造 $M$，$S_i^T \hat I_i^C S_i$ 就是元素
#   $M_{ii}$。
# - **铰接体惯量** $\hat I^A$:关节*自由*。父连杆固定时,$D_i = S_i^T \hat I_i^A S_i$ 就是电机处的表观惯量。(电机以同样大小的
#   力矩反推父连杆。)
#
# 放开关节只会使惯量变小。小多少?
# %%
tw.ask("49.7-chain", ...)


# %% [markdown] lang="en"
# The picture has six such rods, bent a little. At each hinge, it shows the apparent mass that the previous rod has to
# move, drawn as above. On the site you hold such a chain and free its joints one by one: [Felt mass](../hands/felt.md).
# %% [markdown] lang="zh"
# 下面是六根这样的杆,稍有弯曲:每个关节处画的是前一根杆所要带动的表观质量,画法同上。在网站上可以捏住这样一串杆,
# 逐个松开关节:[手上感到的质量](../hands/felt.md)。
# %%
def through_joints(model, q):
    """Composite inertia of each subtree, and its apparent inertia at the parent's side of the free joint."""
    rest = np.zeros(model.nv)
    return tw.crba_terms(model, q).IC, tw.aba_terms(model, q, rest, rest).Ia


rods = tw.chain(6)
bent = np.deg2rad([70, -20, -25, -25, 15, 25])
locked, free = through_joints(rods, bent)
placement = tw.forward_kinematics(rods, bent).placement
joints = np.array([T.translation for T in placement[1:]] + [tw.frame_placement(rods, bent, "tip").translation])

ax = plot.axes_2d(size=(8, 5.5))
ax.plot(joints[:, 0], joints[:, 2], "-o", color=plot.COLOURS["grey"], linewidth=4, markersize=5)
for i in range(1, 7):
    turn = tw.SE3(placement[i].rotation, np.zeros(3)).inverse().motion_transform()  # into the axes of the world
    at = placement[i].translation[[0, 2]]
    assert np.isclose((turn.T @ locked[i] @ turn)[5, 5], 7 - i)  # kg: all outboard rods
    assert (np.linalg.eigvalsh(locked[i] - free[i]) > -1e-12).all()  # free is lighter, for every motion
    orange = plot.COLOURS["orange"]
    plot.apparent_mass_ellipse(
        turn.T @ locked[i] @ turn, at, scale=0.14, colour=orange, label="locked" if i == 1 else None, ax=ax
    )
    plot.apparent_mass_ellipse(turn.T @ free[i] @ turn, at, scale=0.14, label="free" if i == 1 else None, ax=ax)
assert free[1][3, 3] < 1.3 * free[6][3, 3]
assert free[1][5, 5] < 3
print("free, across and along the first rod:", free[1][3, 3].round(2), free[1][5, 5].round(2), "kg")
print("              of a single rod:       ", free[6][3, 3].round(2), free[6][5, 5].round(2), "kg")
ax.set(xlabel="x [m]", ylabel="z [m]", title="apparent mass through each hinge (6 kg locked, at the first)")
ax.legend(loc="lower right")
plt.show()
# %% [markdown] lang="en"
# And Go2? Take its trunk, first in a roll, then upward.
# %% [markdown] lang="zh"
# 那么 Go2 呢?抓住它的躯干,先让它翻滚,再把它往上提。
# %%
tw.ask("49.7-roll", ...)
# %%
lifted = tw.ask("49.7-lifted", ...)
lifted
# %% [markdown] lang="en"
# In terms of $M$, the articulated inertia of the base is a Schur complement. Pushing at the base gives the same. If you
# answered above, the picture shows your guess of the lifted mass beside it:
# %% [markdown] lang="zh"
# 用 $M$ 来表示,基座的铰接体惯量就是一个 Schur 补;在基座上施加推力,求得的惯量与之相同。上面填过猜测的话,图中会把它画在提起的质量旁边:
# %%
M = tw.crba(model, q)
schur = M[:6, :6] - M[:6, 6:] @ np.linalg.solve(M[6:, 6:], M[6:, :6])
assert np.allclose(IA[1], schur, atol=1e-12)
assert np.allclose(IA[1][3:, 3:].diagonal(), [15.2, 15.3, 13.4], atol=0.1)  # kg

pushes = np.pad(np.eye(6), [(0, 0), (0, 12)])  # 1 N m or 1 N on the base, six ways in one batch
response = (tw.aba(model, q, rest, pushes) - tw.aba(model, q, rest, rest))[:, :6]
assert np.allclose(response, np.linalg.inv(IA[1]), rtol=1e-10, atol=1e-12)

front_left = range(2, 5)
pairs = {  # what is compared: names, locked, free
    "trunk, turning [kg m²]": (["roll", "pitch", "yaw"], M.diagonal()[:3], IA[1].diagonal()[:3]),
    "trunk, moving [kg]": (["x", "y", "z"], M.diagonal()[3:6], IA[1].diagonal()[3:]),
    "motors [kg m²]": (["hip", "thigh", "calf"], M.diagonal()[6:9], [D[i].item() for i in front_left]),
}
figure, axes = plt.subplots(1, 3, figsize=(11, 3.4), layout="constrained")
for ax, (title, (names, when_locked, when_free)) in zip(axes, pairs.items()):
    x = np.arange(3)
    ax.bar(x - 0.2, when_locked, 0.4, color=plot.COLOURS["orange"], label="outboard joints locked")
    ax.bar(x + 0.2, when_free, 0.4, color=plot.COLOURS["blue"], label="outboard joints free")
    ax.set(xticks=x, xticklabels=names, title=title)
    assert (np.asarray(when_free) <= np.asarray(when_locked) * (1 + 1e-12)).all()
lifted.draw(axes[1], "y")
figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
plt.show()
assert np.isclose(IA[1][0, 0] / M[0, 0], 0.24, atol=0.01)
# %% [markdown] lang="en"
# The base matters as much.
# %% [markdown] lang="zh"
# 基座的影响同样大。
# %%
tw.ask("49.7-hip", ...)
# %% [markdown] lang="en"
# Every other joint of the free robot moves too. So $\hat I_i^A$ is not the answer
# to a torque at joint $i$, as the chapter pictures it: it is the answer of body $i$ to a wrench that acts on it from
# outside. (The chapter's pseudocode sets $\boldsymbol a_0 = -\boldsymbol g$ for the base, so it computes a robot whose
# base is held.)
# %% [markdown] lang="zh"
# 机器人自由时,其他关节也都跟着动。所以 $\hat I_i^A$ 并不像本章描述的那样是对关节 $i$ 处力矩的响应,而是刚体 $i$ 对外界作用在它上面的 wrench 的响应。
# (本章的伪代码给基座设 $\boldsymbol a_0 = -\boldsymbol g$,算的其实是被托住的机器人。)
# %%
fixed, push = tw.load("go2", base="fixed"), np.eye(model.nv)[6]
held = tw.aba(fixed, q[7:], rest[6:], push[6:]) - tw.aba(fixed, q[7:], rest[6:], rest[6:])
loose = tw.aba(model, q, rest, push) - tw.aba(model, q, rest, rest)
assert np.allclose([held[0], loose[6]], [54.3, 95.5], atol=0.1)
assert np.isclose(held[0], 1 / tw.aba_terms(model, q, rest, rest).D[2].item())  # the hip is joint 2
assert np.allclose(held[3:], 0, atol=1e-12)  # held, the other legs notice nothing
assert (np.abs(loose[9:]) > 0.1).all()
# %% [markdown] lang="en"
# ## There and back
#
# `aba` goes from forces to accelerations, `rnea` back. They are algorithms of different kinds, so each tests the other: a
# hundred random states at once.
# %% [markdown] lang="zh"
# ## 正逆互验
#
# `aba` 由力求加速度,`rnea` 由加速度求回力。两种算法完全不同,正好互相检验:一次用一百个随机状态。
# %%
qs = np.array([model.random_configuration(rng=rng) for _ in range(100)])
vs, taus = rng.standard_normal((2, 100, model.nv))
there = tw.aba(model, qs, vs, taus)
back = tw.rnea(model, qs, vs, there)
print(
    f"accelerations up to {np.abs(there).max():.0f} rad/s²; the forces come back within {np.abs(back - taus).max():.0e}"
)
assert there.shape == (100, 18)
assert np.abs(back - taus).max() < 1e-12 * np.abs(there).max()
assert np.allclose(tw.aba(model, qs, vs, tw.rnea(model, qs, vs, vs)), vs, atol=1e-10)


# %% [markdown] lang="en"
# **Exercise 49.7.2.** The second way builds $M$ and solves $M\ddot q = \tau - h$. Write both ways, and run the cell: it is checked here. How much
# longer does the second take for Go2? The rest of the exercise, in your folder, has you measure it.
# %% [markdown] lang="zh"
# **练习 49.7.2。** 另一种算法先构造 $M$,再解 $M\ddot q = \tau - h$。把两种都写出来,运行单元格当场检查。对 Go2,第二种要慢多少?
# 练习的其余部分在你的文件夹里,请你测一测。
# %%
def forward_dynamics_two_ways(model, q, v, tau):
    """Return the acceleration under given forces: by ABA, and with the mass matrix."""
    return ...


tw.exercises.check("49.7.2", forward_dynamics_two_ways)
# %% [markdown] lang="en"
# ## Free fall
#
# A robot is let go in the air, its motors off. The chapter expects that the linear part of the base's acceleration is about
# (0, 0, −9.81). Do you agree?
# %% [markdown] lang="zh"
# ## 自由落体
#
# 在空中松开机器人,电机全部断电。本章认为基座加速度的线性部分约为 (0, 0, −9.81)。你同意吗?
# %%
tw.ask("49.7-knees", ...)


# %% [markdown] lang="en"
# **Exercise 49.7.1.** Let the base have any tilt. What does `aba` return, and what do you expect without any algorithm? Return both. What
# follows is folded: open it when you have also done the second part, the robot in motion, in your folder.
# %% [markdown] lang="zh"
# **练习 49.7.1。** 基座可以任意倾斜。`aba` 返回什么?不用任何算法,你预期什么?两个都返回。后面的内容是折叠的,等你在文件夹里做完第二部分
# (运动中的机器人)再打开。
# %%
def fall_from_rest(model, q):
    """Return the acceleration of a robot at rest without torques, by ABA and as you expect it."""
    return ...


tw.exercises.check("49.7.1", fall_from_rest)
# %% [markdown] lang="en" after="49.7.1"
# Without torques and at rest, every body falls alike: the base with $\boldsymbol g$ in its own axes, no joint moves. Not
# approximately; exactly. It is no longer so when $v \ne 0$: the swinging legs pull at the base, and a spatial
# acceleration leaves out $\boldsymbol\omega \times \boldsymbol v$. What does fall with $\boldsymbol g$, always, is the
# centre of mass: $\dot{\boldsymbol h}_G$ is the weight (49.10).
# %% [markdown] lang="zh" after="49.7.1"
# 没有力矩又静止时,每个刚体落得一样快:基座的加速度是它自己坐标轴下的 $\boldsymbol g$,关节不动。这不是近似,而是精确成立。$v \ne 0$ 时则不同:摆动的腿会拉动基座,而且空间加速度里不含 $\boldsymbol\omega \times \boldsymbol v$。永远以
# $\boldsymbol g$ 下落的是质心:$\dot{\boldsymbol h}_G$ 就是重力(49.10)。
# %% after="49.7.1"
for any_q in qs[:10]:
    falling = tw.aba(model, any_q, rest, rest)
    down = tw.forward_kinematics(model, any_q).placement[1].rotation.T @ model.gravity
    assert np.allclose(falling, [0, 0, 0, *down, *rest[6:]], atol=1e-11)

tumbling = tw.aba(model, qs[0], vs[0], rest)
down = tw.forward_kinematics(model, qs[0]).placement[1].rotation.T @ model.gravity
assert np.linalg.norm(tumbling[3:6] - down) > 0.5  # m/s²
rate = tw.centroidal_momentum_rate(model, qs[0], vs[0], tumbling)
assert np.allclose(rate, [0, 0, 0, *(model.mass * model.gravity)], atol=1e-10)
# %% [markdown] lang="en"
# ## Pinocchio agrees
#
# Its `aba` first. Then the second way, as the chapter writes it, with $M + M^T - \mathrm{diag}(M)$. In Python its `crba`
# has filled both triangles already, so this doubles everything off the diagonal. And `np.linalg.solve` uses all entries,
# so with the upper triangle alone it solves another problem. How far off are the two?
# %% [markdown] lang="zh"
# ## 与 Pinocchio 对照
#
# 先看它的 `aba`。再看第二种算法,像本章那样先做 $M + M^T - \mathrm{diag}(M)$。在 Python 里它的 `crba` 已经填好两个三角,
# 这样一来对角线以外全部加倍。而 `np.linalg.solve` 使用矩阵的全部元素,如果只填了上三角,它解的就是另一个问题。两者各错多少?
# %%
if pin:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    pin_v, pin_tau = (tw.bridge.to_pinocchio_tangent(model, x) for x in (v, tau))
    theirs = pin.aba(pin_model, data, q, pin_v, pin_tau)
    print(
        f"aba: {np.abs(tw.bridge.from_pinocchio_tangent(model, theirs) - qdd).max():.0e} of {np.abs(qdd).max():.0f} rad/s²"
    )
    assert np.abs(tw.bridge.from_pinocchio_tangent(model, theirs) - qdd).max() < 1e-11 * np.abs(qdd).max()
# %%
if pin:
    M, h = pin.crba(pin_model, data, q), pin.nonLinearEffects(pin_model, data, q, pin_v)
    assert np.array_equal(M, M.T)
    assert np.allclose(np.linalg.solve(M, pin_tau - h), theirs)
    doubled = M + M.T - np.diag(M.diagonal())
    for name, wrong in {"doubled": doubled, "upper triangle": np.triu(M)}.items():
        off = np.abs(np.linalg.solve(wrong, pin_tau - h) - theirs).max()
        print(f"{name}: off by {off:.0f} rad/s²")
        assert off > 10
# %% [markdown] lang="en"
# ## For engineers: a hand without mass
#
# If a joint moves no inertia, its acceleration is not determined: no number would be right. `aba` raises an error with the
# name of the joint; Pinocchio returns nan, and no error. Real models have such joints.
# %% [markdown] lang="zh"
# ## 给工程师:没有质量的手
#
# 如果一个关节带动的刚体都没有惯量,它的加速度就无法确定:没有一个数是对的。`aba` 会报错并指出关节的名字;
# Pinocchio 返回 nan,而且不报错。真实的模型里就有这样的关节。
# %%
builder = tw.Builder("arm with a massless hand", base="fixed")
builder.link("forearm", parent="base_link", joint=tw.Revolute("y"), inertia=rod)
below = tw.SE3(np.eye(3), [0, 0, -1])
builder.link("hand", parent="forearm", joint=tw.Revolute("x"), joint_name="wrist", placement=below)
bare = builder.build()
try:
    tw.aba(bare, [0.0, 0.0], [0.0, 0.0], [0.0, 0.0])
except tw.SingularError as error:
    message = str(error)
print(message)
assert "wrist" in message
assert np.linalg.matrix_rank(tw.crba(bare, [0.0, 0.0])) == 1
if pin:
    pin_bare = tw.bridge.to_pinocchio_model(bare)
    assert np.isnan(pin.aba(pin_bare, pin_bare.createData(), *np.zeros((3, 2)))).any()
# %% [markdown] lang="en"
# ## For engineers: how exact?
#
# Ten rods whose mass grows from the first to the last; fifty digits and 3-D vectors (`newton_euler_3d`) give the truth. How
# exact are `aba`, and `crba` with `solve`, in double precision?
# %% [markdown] lang="zh"
# ## 给工程师:有多准?
#
# 十根杆连成的链,质量从第一根到最后一根逐渐增大;真值由 3D 向量以五十位数字算出(`newton_euler_3d`)。
# 用双精度的 `aba`,以及 `crba` 加 `solve`,各有多准?
# %%
tw.ask("49.7-tip", ...)
# %% [markdown] lang="en"
# A light tip harms neither of the two, although $M$ then has a larger condition number than with equal rods: that number
# alone does not tell how exact the result is.
# %% [markdown] lang="zh"
# 末端很轻时,两者都不受影响,尽管这时 $M$ 的条件数比等质量时更大:只看条件数,不能判断结果有多准。
# %% setup="yes"
ratios = np.array([1e-9, 1e-6, 1e-3, 1e0, 1e3, 1e6, 1e9])
errors, conditions = np.zeros((2, len(ratios), 3)), []
for k, ratio in enumerate(ratios):
    rods = tw.chain(10, mass_ratio=ratio)
    for j in range(3):
        state = rng.standard_normal((3, 10))
        with mpmath.workdps(50):
            truth = newton_euler_3d.forward_dynamics(rods, *map(newton_euler_3d.as_mpmath, state)).astype(float)
        bent, speed, force = state
        M = tw.crba(rods, bent)
        solved = np.linalg.solve(M, force - tw.nonlinear_effects(rods, bent, speed))
        for way, answer in enumerate((tw.aba(rods, bent, speed, force), solved)):
            errors[way, k, j] = np.abs(answer - truth).max() / np.abs(truth).max()
    conditions.append(np.linalg.cond(M))
by_aba, by_solving = np.median(errors, axis=-1)
# %%
ax = plot.axes_2d(size=(7, 3.8))
ax.loglog(ratios, by_solving, "s-", color=plot.COLOURS["orange"], label="crba, then solve")
ax.loglog(ratios, by_aba, "o-", color=plot.COLOURS["blue"], label="aba")
ax.set(xlabel="mass of the last rod / mass of the first", ylabel="relative error of q̈", title="ten rods, three states")
ax.grid(alpha=0.3)
ax.legend()
plt.show()
assert by_aba[-1] < 1e-3 * by_solving[-1]  # a heavy tip: three digits more
assert by_aba[:4].max() < 1e-12
assert by_solving[0] < 1e-12
assert conditions[0] > conditions[3]  # worse conditioned, and exact all the same
# %% [markdown] lang="en"
# ## Exercises
#
# - **49.7.1** the acceleration of a Go2 without torques
# - **49.7.2** `aba` against `crba` and `solve`, in time: measure it yourself
#
# `twistwrench exercises start my_answers` puts them into a folder; `python -m pytest` there checks your answers;
# `twistwrench exercises hint 49.7.1` helps. Next: notebook 49.8.
# %% [markdown] lang="zh"
# ## 练习
#
# - **49.7.1** 没有力矩时 Go2 的加速度
# - **49.7.2** `aba` 与"`crba` 加 `solve`"比时间:自己量一量
#
# `twistwrench exercises start my_answers --language zh` 把练习放进一个文件夹,在那里运行 `python -m pytest` 检查答案,
# `twistwrench exercises hint 49.7.1` 给提示。下一个:笔记本 49.8。

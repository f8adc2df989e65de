# %% [markdown] lang="en"
# # 49.7 ABA: forward dynamics
#
# Given the forces at the joints, how does the robot accelerate? You could build $M$ and solve. The articulated-body
# algorithm does without $M$. At each joint it needs the inertia that the joint feels when everything beyond it is free to
# move: the *apparent inertia*. This notebook shows it, follows the three passes on Go2, and measures how exact the answer
# is.
# %% [markdown] lang="zh"
# # 49.7 ABA:正向动力学
#
# 给定各关节的力,机器人怎样加速?可以构造 $M$ 再求解。铰接体算法不用 $M$,只需要每个关节在外侧(远离基座)关节全部自由时
# 所带动的惯量,即*表观惯量*。这个笔记本把它画出来,在 Go2 上走完三遍递推,最后看答案有多准。
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

rng = np.random.default_rng(7)
v, tau = rng.standard_normal((2, model.nv))
rest = np.zeros(model.nv)
# %% [markdown] lang="en"
# ## A pendulum in the hand
#
# Hold a rod by a hinge at its upper end and move the hinge. Everything is at rest before, and gravity is left out.
# %% [markdown] lang="zh"
# ## 手里的单摆
#
# 用手通过一个旋转关节握住杆的上端,移动这个关节。起初一切静止,不计重力。
# %%
tw.ask("49.7-rod", ...)
# %% [markdown] lang="en"
# The rod follows with $\boldsymbol a = \boldsymbol a_{hand} + S \ddot q$ and takes
# $\boldsymbol F = \hat I \boldsymbol a$. The hinge is free: it
# transmits nothing along $S$, so $S^T \boldsymbol F = 0$. That gives $\ddot q$, and with it the force of the hand:
#
# $$\boldsymbol F = \Big(\hat I - \hat I S\,(S^T \hat I S)^{-1} S^T \hat I\Big)\,\boldsymbol a_{hand}.$$
#
# The bracket is an **articulated inertia**: the inertia of the rod minus the part along the free joint. Ten numbers no
# longer describe it. If you push along the rod, the apparent mass is the whole mass. If you push across it, the rod
# swings, and the apparent mass of a thin rod is a quarter of its mass.
# %% [markdown] lang="zh"
# 杆跟着动,$\boldsymbol a = \boldsymbol a_{hand} + S \ddot q$,需要
# $\boldsymbol F = \hat I \boldsymbol a$。关节是自由的:沿 $S$ 不传递力矩,所以 $S^T \boldsymbol F = 0$。由此得到
# $\ddot q$,也就知道手要用多大的力:
#
# $$\boldsymbol F = \Big(\hat I - \hat I S\,(S^T \hat I S)^{-1} S^T \hat I\Big)\,\boldsymbol a_{hand}.$$
#
# 括号里就是**铰接体惯量**:杆的惯量,减去沿自由关节的那部分。它不再能用十个数表示。沿着杆的方向推,表观质量就是全部质量;
# 垂直于杆推,杆会摆开,细杆的表观质量只有四分之一。
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
# Each point of a curve is the force that gives the hand 1 m/s² in some direction. If the hinge is locked, only the mass
# of the rod counts, and the curve is a circle. If the hinge is free, the curve is an ellipse that is thin across the
# rod.
#
# ## Three passes
#
# Now let the rod carry a tree, let it move, and give the joint a torque. For each body the whole tree outboard of its joint
# acts as $\boldsymbol F_i = \hat I_i^A \boldsymbol a_i + \boldsymbol p_i^A$: linear in the acceleration, whatever hangs on
# it. (RNEA's $\boldsymbol F_i$; the bias wrench $\boldsymbol p_i^A$ is what it takes without acceleration.) The same
# elimination as above, joint by joint from the tips:
#
# 1. **Outward**: twists $\boldsymbol V_i$, bias accelerations $\boldsymbol c_i = \boldsymbol V_i \times S_i \dot q_i$;
#    to begin with, $\hat I_i^A = \hat I_i$ and $\boldsymbol p_i^A = \boldsymbol V_i \times^* \hat I_i \boldsymbol V_i$.
# 2. **Inward**: with $U_i = \hat I_i^A S_i$, $D_i = S_i^T U_i$, $u_i = \tau_i - S_i^T \boldsymbol p_i^A$, the
#    apparent inertia and bias wrench at the parent are
# $$\hat I_i^a = \hat I_i^A - U_i D_i^{-1} U_i^T, \qquad \boldsymbol p_i^a = \boldsymbol p_i^A + \hat I_i^a \boldsymbol c_i
# + U_i D_i^{-1} u_i,$$
#    taken into its frame: $\hat I_{\lambda}^A$ grows by $X_i^T \hat I_i^a X_i$, $\boldsymbol p_{\lambda}^A$ by
#    $X_i^T \boldsymbol p_i^a$.
# 3. **Outward**: $\ddot q_i = D_i^{-1}\big(u_i - U_i^T (X_i \boldsymbol a_\lambda + \boldsymbol c_i)\big)$, and on to the
#    next.
#
# Where do the two formulas of step 2 come from? Write $\boldsymbol a' = X_i\boldsymbol a_\lambda + \boldsymbol c_i$ for the
# acceleration that body $i$ has if its joint does not accelerate. Then $\boldsymbol a_i = \boldsymbol a' + S_i\ddot q_i$,
# and the motor fixes the part of the wrench along the joint, $S_i^T\boldsymbol F_i = \tau_i$:
#
# $$S_i^T\big(\hat I_i^A(\boldsymbol a' + S_i\ddot q_i) + \boldsymbol p_i^A\big) = \tau_i
# \quad\Rightarrow\quad \ddot q_i = D_i^{-1}(u_i - U_i^T\boldsymbol a').$$
#
# That is step 3. Put it back into $\boldsymbol F_i = \hat I_i^A\boldsymbol a_i + \boldsymbol p_i^A$:
#
# $$\boldsymbol F_i = \hat I_i^A\boldsymbol a' + U_i D_i^{-1}(u_i - U_i^T\boldsymbol a') + \boldsymbol p_i^A
# = \underbrace{(\hat I_i^A - U_i D_i^{-1}U_i^T)}_{\hat I_i^a}\,X_i\boldsymbol a_\lambda
# + \underbrace{\boldsymbol p_i^A + \hat I_i^a\boldsymbol c_i + U_i D_i^{-1}u_i}_{\boldsymbol p_i^a}.$$
#
# So, for the parent, the subtree is again an inertia and a bias wrench. The bias wrench has three parts: the previous
# one, the effect of the velocities, and the reaction of the motor.
#
# The chapter writes $X_i^* \hat I X_i^{-1}$ and $X_i^* \boldsymbol p$ here, with $X_i$ from parent to child. That leads
# outward, as in 49.6: the calf ends up above the thigh.
# %% [markdown] lang="zh"
# 曲线上每个点,是让手在某个方向得到 1 m/s² 所需的力。关节锁死时,只有杆的质量起作用,曲线是一个圆。关节自由时,
# 曲线是椭圆,垂直于杆的方向很窄。
#
# ## 三遍递推
#
# 现在让杆后面带上一棵树,让它运动,再给关节加上力矩。对每个刚体,关节外侧的整棵树表现为
# $\boldsymbol F_i = \hat I_i^A \boldsymbol a_i + \boldsymbol p_i^A$:无论子树是什么样,它对加速度总是线性的。(这就是 RNEA 的
# $\boldsymbol F_i$;偏置力 $\boldsymbol p_i^A$ 是没有加速度时所需的。)做法与上面的消元一样,从末端开始,一个关节一个关节地做:
#
# 1. **向外**：twist $\boldsymbol V_i$,偏置加速度 $\boldsymbol c_i = \boldsymbol V_i \times S_i \dot q_i$;起初
#    $\hat I_i^A = \hat I_i$，$\boldsymbol p_i^A = \boldsymbol V_i \times^* \hat I_i \boldsymbol V_i$。
# 2. **向内**:令 $U_i = \hat I_i^A S_i$、$D_i = S_i^T U_i$、$u_i = \tau_i - S_i^T \boldsymbol p_i^A$,父连杆一侧的表观惯量和偏置力是
# $$\hat I_i^a = \hat I_i^A - U_i D_i^{-1} U_i^T, \qquad \boldsymbol p_i^a = \boldsymbol p_i^A + \hat I_i^a \boldsymbol c_i
# + U_i D_i^{-1} u_i,$$
#    再换到它的坐标系:$\hat I_{\lambda}^A$ 加上 $X_i^T \hat I_i^a X_i$，$\boldsymbol p_{\lambda}^A$ 加上
#    $X_i^T \boldsymbol p_i^a$。
# 3. **向外**：$\ddot q_i = D_i^{-1}\big(u_i - U_i^T (X_i \boldsymbol a_\lambda + \boldsymbol c_i)\big)$,再到下一个。
#
# 第 2 步的两个公式从哪里来?设 $\boldsymbol a' = X_i\boldsymbol a_\lambda + \boldsymbol c_i$,即关节没有加速度时刚体 $i$
# 的加速度。于是 $\boldsymbol a_i = \boldsymbol a' + S_i\ddot q_i$,而电机决定了 wrench 沿关节的分量,
# $S_i^T\boldsymbol F_i = \tau_i$:
#
# $$S_i^T\big(\hat I_i^A(\boldsymbol a' + S_i\ddot q_i) + \boldsymbol p_i^A\big) = \tau_i
# \quad\Rightarrow\quad \ddot q_i = D_i^{-1}(u_i - U_i^T\boldsymbol a').$$
#
# 这就是第 3 步。再代回 $\boldsymbol F_i = \hat I_i^A\boldsymbol a_i + \boldsymbol p_i^A$:
#
# $$\boldsymbol F_i = \hat I_i^A\boldsymbol a' + U_i D_i^{-1}(u_i - U_i^T\boldsymbol a') + \boldsymbol p_i^A
# = \underbrace{(\hat I_i^A - U_i D_i^{-1}U_i^T)}_{\hat I_i^a}\,X_i\boldsymbol a_\lambda
# + \underbrace{\boldsymbol p_i^A + \hat I_i^a\boldsymbol c_i + U_i D_i^{-1}u_i}_{\boldsymbol p_i^a}.$$
#
# 所以对父连杆来说,子树仍是一个惯量和一个偏置力。偏置力有三部分:原有的、速度引起的、电机的反作用。
#
# 本章这里写的是 $X_i^* \hat I X_i^{-1}$ 和 $X_i^* \boldsymbol p$,而 $X_i$ 是从父到子。这和 49.6 一样是向外的:
# 小腿会出现在大腿上方。
# %%
print(inspect.getsource(articulated_body))
# %% [markdown] lang="en"
# That is the file itself: `tw.aba` checks its arguments, runs this, and raises an error for a singular $D_i$. Its intermediate
# results are in the record that `tw.aba_terms` returns, an entry for each body.
# %% [markdown] lang="zh"
# 这就是源文件本身:`tw.aba` 检查参数,运行它,遇到奇异的 $D_i$ 就报错。中间结果都在 `tw.aba_terms` 返回的记录里,
# 每个刚体一项。
# %%
terms = tw.aba_terms(model, q, v, tau)
A, D, IA, pA, qdd = np.array(terms.A), terms.D, np.array(terms.IA), np.array(terms.pA), terms.qdd

assert np.array_equal(qdd, tw.aba(model, q, v, tau))
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
# move, drawn as above. If all hinges are locked, the circles grow with the number of rods. If all hinges are free, the
# other five rods add little across the first rod, and much less than their mass along it.
# %% [markdown] lang="zh"
# 下面是六根这样的杆,稍有弯曲:每个关节处画的是前一根杆所要带动的表观质量,画法同上。关节全部锁死时,
# 圆随杆数变大;关节全部自由时,后面五根杆在垂直于第一根杆的方向上几乎不增加惯量,在沿杆的方向上也远小于它们的质量。
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
# The base matters as much. Give the front left hip 1 N m.
# %% [markdown] lang="zh"
# 基座的影响同样大。在左前髋关节施加 1 N·m 的力矩。
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
print(f"front left hip: {held[0]:.0f} rad/s² with the base held, {loose[6]:.0f} with the base free")
assert np.allclose([held[0], loose[6]], [54.3, 95.5], atol=0.1)
assert np.isclose(held[0], 1 / tw.aba_terms(model, q, rest, rest).D[2].item())  # the hip is joint 2
assert np.allclose(held[3:], 0, atol=1e-12)  # held, the other legs notice nothing
assert (np.abs(loose[9:]) > 0.1).all()
# %% [markdown] lang="en"
# ## There and back
#
# `aba` and `rnea` are inverses of each other. It is a good test if two algorithms of different kinds agree. We do it
# for a hundred random states at once.
# %% [markdown] lang="zh"
# ## 正逆互验
#
# `aba` 与 `rnea` 互为逆。两种不同的算法结果一致,是很好的检验。这里一次用一百个随机状态。
# %%
qs = np.array([model.random_configuration(rng=rng) for _ in range(100)])
vs, taus = rng.standard_normal((2, 100, model.nv))
accelerations = tw.aba(model, qs, vs, taus)
assert accelerations.shape == (100, 18)
assert np.abs(tw.rnea(model, qs, vs, accelerations) - taus).max() < 1e-12 * np.abs(accelerations).max()
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
# 机器人在空中被松手,电机全部断电。本章认为基座加速度的线性部分约为 (0, 0, −9.81)。你同意吗?
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
# ## Where there is no answer
#
# $D_i^{-1}$ exists only if the joint moves some inertia. If it does not, its acceleration is not determined: no number
# would be right, and `aba` raises an error with the name of the joint. Real models have such joints.
# %% [markdown] lang="zh"
# ## 没有答案的地方
#
# $D_i^{-1}$ 要求有惯量。如果一个关节带动的刚体都没有惯量,它的加速度就无法确定:没有一个数是对的,`aba` 会报错并指出关节的名字。真实的模型里就有这样的关节。
# %%
builder = tw.Builder("arm with a massless hand", base="fixed")
forearm = tw.SpatialInertia(1.0, [0, 0, -0.25], np.diag([0.02, 0.02, 0.001]))
builder.link("forearm", parent="base_link", joint=tw.Revolute("y"), inertia=forearm)
below = tw.SE3(np.eye(3), [0, 0, -0.5])
builder.link("hand", parent="forearm", joint=tw.Revolute("x"), joint_name="wrist", placement=below)
arm = builder.build()
try:
    tw.aba(arm, [0.0, 0.0], [0.0, 0.0], [0.0, 0.0])
except tw.SingularError as error:
    message = str(error)
else:
    raise AssertionError("a joint without inertia has been given an acceleration")
print(message)
assert "wrist" in message
assert np.linalg.matrix_rank(tw.crba(arm, [0.0, 0.0])) == 1
# %% [markdown] lang="en"
# ## How exact?
#
# Take a chain of ten rods whose mass grows from the first to the last, and compute $\ddot q$ in fifty digits, with 3-D
# vectors (`newton_euler_3d`). These are the true values. How exact are `aba`, and `crba` with `solve`, in double
# precision?
# %% [markdown] lang="zh"
# ## 有多准?
#
# 取十根杆连成的链,质量从第一根到最后一根逐渐增大,用 3D 向量以五十位数字算出 $\ddot q$(`newton_euler_3d`),作为真值。
# 用双精度的 `aba`,以及 `crba` 加 `solve`,各有多准?
# %%
tw.ask("49.7-tip", ...)
# %% [markdown] lang="en"
# Every entry of $M$ contains the heavy tip, so the digits of a light rod are lost in rounding. ABA first
# removes what the free joint lets go, and only then adds the rest to the parent. A light tip harms neither of the two, although $M$
# then has a larger condition number than with equal rods. So the condition number alone does not tell how exact the
# result is.
# %% [markdown] lang="zh"
# $M$ 的每个元素里都有沉重的末端,轻的杆淹没在舍入误差里。ABA 在每个自由关节处,先减去随关节自由运动的部分,再相加。末端很轻时,两者都不受影响,
# 尽管这时 $M$ 的条件数比等质量时更大:只看条件数,不能判断结果有多准。
# %%
ratios = np.array([1e-9, 1e-6, 1e-3, 1e0, 1e3, 1e6, 1e9])
errors, conditions = np.zeros((2, len(ratios), 5)), []
for k, ratio in enumerate(ratios):
    rods = tw.chain(10, mass_ratio=ratio)
    for j in range(5):
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

ax = plot.axes_2d(size=(7, 3.8))
ax.loglog(ratios, by_solving, "s-", color=plot.COLOURS["orange"], label="crba, then solve")
ax.loglog(ratios, by_aba, "o-", color=plot.COLOURS["blue"], label="aba")
ax.set(xlabel="mass of the last rod / mass of the first", ylabel="relative error of q̈", title="ten rods, five states")
ax.grid(alpha=0.3)
ax.legend()
plt.show()
assert by_aba[-1] < 1e-3 * by_solving[-1]  # a heavy tip: three digits more
assert by_aba[:4].max() < 1e-12
assert by_solving[0] < 1e-12
assert conditions[0] > conditions[3]  # worse conditioned, and exact all the same
# %% [markdown] lang="en"
# ## Pinocchio agrees
#
# Three more things to know. Its `crba` already returns a symmetric matrix in Python: the chapter's $M + M^T -
# \mathrm{diag}(M)$ doubles everything off the diagonal. `np.linalg.solve` uses all entries: if only the upper triangle
# is filled, it solves another problem. And for the arm above, Pinocchio's `aba` returns nan without an error.
# %% [markdown] lang="zh"
# ## 与 Pinocchio 对照
#
# 另外有三点要知道。在 Python 里,它的 `crba` 返回的已经是对称矩阵:本章的 $M + M^T - \mathrm{diag}(M)$ 会把对角线以外
# 全部加倍。`np.linalg.solve` 使用矩阵的全部元素:如果只填了上三角,它解的就是另一个问题。还有,对上面那条手臂,
# Pinocchio 的 `aba` 返回 nan,而且不报错。
# %%
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    pin_model = tw.bridge.to_pinocchio_model(model)
    data = pin_model.createData()
    pin_v, pin_tau = (tw.bridge.to_pinocchio_tangent(model, x) for x in (v, tau))
    theirs = pin.aba(pin_model, data, q, pin_v, pin_tau)
    assert np.abs(tw.bridge.from_pinocchio_tangent(model, theirs) - qdd).max() < 1e-11 * np.abs(qdd).max()

    M, h = pin.crba(pin_model, data, q), pin.nonLinearEffects(pin_model, data, q, pin_v)
    assert np.array_equal(M, M.T)
    assert np.allclose(np.linalg.solve(M, pin_tau - h), theirs)
    doubled = M + M.T - np.diag(M.diagonal())
    for wrong in (doubled, np.triu(M)):
        off = np.abs(np.linalg.solve(wrong, pin_tau - h) - theirs).max()
        print(f"off by {off:.0f} rad/s²")
        assert off > 10

    pin_arm = tw.bridge.to_pinocchio_model(arm)
    assert np.isnan(pin.aba(pin_arm, pin_arm.createData(), np.zeros(2), np.zeros(2), np.zeros(2))).any()
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

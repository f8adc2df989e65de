# %% [markdown] lang="en"
# # Five minutes with twistwrench
#
# You need nothing from the chapter yet. In the next cells you load a robot dog, look at it, ask what its motors must do, and
# check the answer in two other ways. Eight of the code cells are for reading; the others are folded, and prepare, draw or
# check. Run them all one by one (Shift + Enter), and change them: nothing can break.
# %% [markdown] lang="zh"
# # 五分钟认识 twistwrench
#
# 现在还不需要读过本章。在下面的单元格里,你会加载一只机器狗,看看它的样子,问问它的电机要出多大力,
# 再用另外两种办法核对答案。有八个代码单元格是给你读的,其余的折叠着,负责准备、画图或检验。请逐个全部运行(Shift + Enter),
# 也请随手改一改:改不坏。
# %%
import twistwrench as tw

model = tw.load("go2")
model
# %% setup="yes"
import matplotlib.pyplot as plt
import numpy as np

from twistwrench import plot

# %% [markdown] lang="en"
# `tw.robots()` lists what else there is; a path to a URDF file works as well. Go2 has 12 motors, and its trunk is not
# bolted to anything. Its posture `q` says where the trunk is and how it is turned, then the angles of the joints:
# %% [markdown] lang="zh"
# `tw.robots()` 列出目录里的其他机器人;给一个 URDF 文件的路径也行。Go2 有 12 个电机,躯干没有固定在任何东西上。
# 位形 `q` 前面是躯干的位置和姿态,后面是各关节的角度:
# %%
q = model.standing()  # a posture with all four feet on the floor
assert (model.nq, model.nv) == (19, 18)
assert q.shape == (19,)
print("base position", q[:3].round(3), " quaternion x, y, z, w", q[3:7])
print("front left leg: hip, thigh, calf", q[7:10], "rad")
# %% [markdown] lang="en"
# The first cell says `nq = 19`, `nv = 18`: a posture takes one number more than a velocity. Why, and would it be so if the
# turn of the trunk were written otherwise? That is exercise 49.1.1.
# Which number a library writes first is another matter. On the site that belongs to this package (`python docs/build.py`
# builds it) you can paste the state of one library, and read it as another one writes it:
# [Translate my numbers](../hands/translate.md).
# %% [markdown] lang="zh"
# 第一个单元格里写着 `nq = 19`、`nv = 18`:位形比速度多一个数。为什么?躯干的姿态换一种写法,还会这样吗?这是练习 49.1.1 的问题。
# 至于先写哪个数,各个库又不一样。在本包的配套网站上(用 `python docs/build.py` 生成)可以粘贴一个库的状态,看另一个库怎样写:[换算我的数](../hands/translate.md)。
# %% [markdown] lang="en"
# ## What holds it up?
#
# Four feet carry the weight. The cross in the picture is the centre of mass.
# %% [markdown] lang="zh"
# ## 什么力托住它?
#
# 四只脚承担全部重量。图中的叉是质心。
# %%
held = tw.static_equilibrium(model, q)
feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])

ax = plot.robot(model, q)
plot.arrows(feet, held.forces, scale=0.004, label="force of the ground", ax=ax)
ax.legend(loc="upper left")
plt.show()
# %%
weight = -model.mass * model.gravity[2]
assert np.isclose(held.forces[:, 2].sum(), weight)
print(f"weight {weight:.2f} N")
# %% [markdown] lang="en"
# ## What must the motors do?
#
# You give a motion as `q`, `v` and `a`, and `rnea` returns the forces that this motion needs: **inverse dynamics**. The
# first six numbers belong to the trunk: first a moment, then a force. This order, angular before linear, is used
# everywhere in the package. Here the robot rests in the air, held by its trunk, and its legs hang; exercise 49.6.3 asks
# which six numbers the trunk then has.
# %% [markdown] lang="zh"
# ## 电机要做什么?
#
# 给出机器人的运动(`q`、`v`、`a`),`rnea` 就返回这个运动所需的力:这叫**逆动力学**。前六个数属于躯干,先力矩后力;先角后线,整个包都用这个顺序。
# 这里机器人静止在空中,由躯干托住,腿悬着;这时躯干的六个数是多少,是练习 49.6.3 的问题。
# %%
rest = np.zeros(model.nv)
tau = tw.rnea(model, q, rest, rest)
print("front left leg: hip, thigh, calf", tau[6:9].round(3) + 0.0, "N m")
assert np.abs(tau[6:]).max() < model.effort_limit[6:].min()
# %% [markdown] lang="en"
# ## Is that right?
#
# Never believe one program alone. **First**, a different way in the same package, on a motion drawn at random:
# `tw.newton_euler_3d` knows no six-dimensional vectors. It applies Newton and Euler to each body, in three dimensions.
# %% [markdown] lang="zh"
# ## 答案对吗?
#
# 不要只相信一个程序的答案。**第一**,在同一个包里换一种算法,运动随机抽取:`tw.newton_euler_3d` 完全不用六维向量,
# 只在三维空间里对每个刚体用牛顿方程和欧拉方程。
# %%
rng = np.random.default_rng(0)
v, a = rng.standard_normal((2, model.nv))
tau = tw.rnea(model, q, v, a)
error = np.abs(tw.newton_euler_3d.inverse_dynamics(model, q, v, a) - tau).max()
assert error < 1e-12 * np.abs(tau).max()
print(f"largest difference {error:.1e} N m, of forces up to {np.abs(tau).max():.0f}")
# %% [markdown] lang="en"
# **Second**, other people's program: Pinocchio, the library that most legged robots are controlled with. Its `q` is the
# same as ours, but in its vectors the linear part comes first. Only `tw.bridge` changes the order.
# %% [markdown] lang="zh"
# **第二**,换别人的程序:Pinocchio,腿足机器人控制中用得最多的动力学库。它的 `q` 与我们的一样,
# 但它的向量线性部分在前。只有 `tw.bridge` 改变顺序。
# %%
try:
    import pinocchio as pin
except ImportError:
    print("Pinocchio is not installed (pip install pin): this comparison is skipped")
else:
    theirs_model = tw.bridge.to_pinocchio_model(model)
    theirs_v, theirs_a = (tw.bridge.to_pinocchio_tangent(model, x) for x in (v, a))
    theirs = pin.rnea(theirs_model, theirs_model.createData(), q, theirs_v, theirs_a)
    error = np.abs(tw.bridge.from_pinocchio_tangent(model, theirs) - tau).max()
    assert error < 1e-12 * np.abs(tau).max()
    print(f"largest difference from Pinocchio {error:.1e}")
# %% [markdown] lang="en"
# ## One more picture
#
# A joint accelerates. Which other joints need a force, only to stay as they are? The mass matrix says it, a column for
# each joint; white is zero. Which legs are coupled with each other, and what is coupled with all of them? Notebook 49.8
# says why.
# %% [markdown] lang="zh"
# ## 再看一张图
#
# 一个关节加速时,还有哪些关节必须出力才能保持不动?质量矩阵的每一列对应一个加速的关节,写着各关节所需的力,白色是零。哪些腿彼此耦合?
# 什么与所有的腿都耦合?为什么,见笔记本 49.8。
# %%
M = tw.crba(model, q)
legs = [(f"{foot[:2]}", model.v_slice[model.joint_id(f"{foot[:2]}_hip_joint")].start) for foot in model.feet]
starts = [start for _, start in legs]
ax = plot.matrix(M, "mass matrix of Go2", lines=[3, *starts])
ax.set_xticks([1, 4, *(start + 1 for start in starts)], ["base ω", "base v", *(name for name, _ in legs)])
ax.set_yticks([1, 4, *(start + 1 for start in starts)], ["base ω", "base v", *(name for name, _ in legs)])
plt.show()
front, rear = slice(starts[0], starts[0] + 3), slice(starts[2], starts[2] + 3)
assert (M[front, rear] == 0).all()
assert (M[:6, rear] != 0).any()
# %% [markdown] lang="en"
# ## Where to go next
#
# - Notebook 49.1 begins the chapter: why six numbers for a velocity.
# - `help(tw.frame_jacobian)` shows shapes, units and frames; each function has an example.
# - `twistwrench validate go2` in a terminal compares every quantity with Pinocchio.
# - `twistwrench exercises start my_answers` puts the chapter's exercises into a folder of yours, and
#   `python -m pytest` there checks your answers.
# - The code is meant to be read: `rnea` fits on one screen, in `algorithms/rnea.py`.
# %% [markdown] lang="zh"
# ## 接下来去哪里
#
# - 笔记本 49.1 从本章的开头讲起:速度为什么要用六个数。
# - `help(tw.frame_jacobian)` 给出形状、单位和坐标系;每个函数都有例子。
# - 在终端运行 `twistwrench validate go2`,把每个量与 Pinocchio 逐一比较。
# - `twistwrench exercises start my_answers --language zh` 把本章练习放进你自己的文件夹,在那里运行 `python -m pytest` 就能检查答案。
# - 代码就是写给人读的:`rnea` 一屏就能看完,在 `algorithms/rnea.py` 里。

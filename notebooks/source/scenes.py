# %% [markdown] lang="en"
# # Scenes: model only what is needed
#
# If a humanoid stands and does not move its arms, no equations are needed for the arms. This notebook locks joints,
# compares the smaller robot with the whole one, measures the error that you make if the arms do move, asks whether the
# robot can stand, and chooses the cheapest model of a walk that is exact enough.
# %% [markdown] lang="zh"
# # 场景:只为需要的部分建模
#
# 人形机器人站着不动手臂时,方程里不需要手臂。这个笔记本先锁住关节,把缩小后的模型与整个机器人比较,再看手臂其实在动时误差多大,然后判断机器人是否站得住,最后为一段行走选出够用的模型中代价最小的一个。
# %%
import time

import matplotlib.pyplot as plt
import numpy as np

import twistwrench as tw
from twistwrench import motions
from twistwrench.plot import COLOURS

full = tw.load("humanoid")
soles = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), mu=0.7) for side in ("left", "right")]
arms = ["*_shoulder_*", "*_elbow"]
rng = np.random.default_rng(49)
# %% [markdown] lang="en"
# ## Locking a joint adds two inertias
#
# Bodies between which nothing moves are one body. Lock the left elbow at 0.7 rad: the forearm is welded to the upper
# arm, and in one frame inertias add (49.5):
#
# $$\hat I_{\text{arm}} = \hat I_{\text{upper}} + X^{*}\, \hat I_{\text{forearm}}\, X^{-1}.$$
#
# `SpatialInertia.transform` does the change of frame, here with the placement of the forearm at that angle.
# %% [markdown] lang="zh"
# ## 锁住一个关节就是把两个惯量相加
#
# 彼此不动的刚体就是一个刚体。把左肘锁在 0.7 rad:前臂焊在上臂上,在同一个坐标系里惯量可以相加(49.5):
#
# $$\hat I_{\text{arm}} = \hat I_{\text{upper}} + X^{*}\, \hat I_{\text{forearm}}\, X^{-1}.$$
#
# `SpatialInertia.transform` 完成换坐标系,这里用的是前臂在这个角度上的位姿。
# %%
q_bent = full.standing()
elbow = full.joint_id("left_elbow")
q_bent[full.q_slice[elbow]] = 0.7
bent = tw.lock_joints(full, ["left_elbow"], q_bent)

in_upper = full.placement[elbow] @ full.joints[elbow].transform(np.array([0.7]))
by_hand = full.inertia[elbow - 1] + full.inertia[elbow].transform(in_upper)
upper = bent.model.joint_id("left_shoulder_yaw")
assert np.allclose(bent.model.inertia[upper].matrix(), by_hand.matrix(), rtol=1e-14, atol=1e-16)
assert bent.model.mass == full.mass
print(full)
print(bent.model)
# %% [markdown] lang="en"
# ## A scene, and the smallest model that has it
#
# A scene locks the joints that are held and removes joints that carry nothing; it keeps contacts, frames, limits and
# rotors. Its model has the equations of the whole robot whose arms do not move: the remaining rows and columns of $M$,
# the same torques, the same momentum.
# %% [markdown] lang="zh"
# ## 场景与最小模型
#
# 场景锁住不动的关节,去掉不带动任何质量的关节,保留接触、坐标系、限位和转子惯量。它的模型就是手臂不动时整个机器人的方程:
# $M$ 中留下的行和列,同样的力矩,同样的动量。
# %%
scene = tw.Scene(full, contacts=soles, hold=arms)
print(scene)
model, kept = scene.model, tw.lock_joints(full, arms, full.standing()).kept_v
q = model.integrate(model.standing(), 0.3 * rng.uniform(-1, 1, model.nv) * scene.actuated)
v, a = rng.standard_normal((2, model.nv))
(Q, V), (_, A) = scene.expand(q, v), scene.expand(q, a)
# %%
d = scene.dynamics(q, v, want={"M", "J_c"})
assert d.h is None
assert d.J_c.shape == (12, 19)
pairs = {
    "M": (d.M, tw.crba(full, Q)[np.ix_(kept, kept)]),
    "tau": (tw.rnea(model, q, v, a), tw.rnea(full, Q, V, A)[kept]),
    "A_G": (tw.centroidal_map(model, q), tw.centroidal_map(full, Q)[:, kept]),
    "J_c": (d.J_c, tw.constraint_jacobian(full, Q, soles)[:, kept]),
}
for name, (small, whole) in pairs.items():
    error = np.abs(small - whole).max() / np.abs(whole).max()
    print(f"{name:4} {error:.0e}")
    assert error < 1e-13
# %% [markdown] lang="en"
# The time that this saves depends on how many joints are removed. The two models are timed in turns; the shortest of
# many times counts.
# %% [markdown] lang="zh"
# 省多少时间,取决于去掉了多少关节。两者轮流计时,各取多次中最快的一次。
# %%
times = np.empty((30, 2))
for row in times:
    for k, (robot, state) in enumerate(((model, (q, v, a)), (full, (Q, V, A)))):
        start = time.perf_counter()
        tw.rnea(robot, *state)
        row[k] = time.perf_counter() - start
saved = times.min(axis=0)[1] / times.min(axis=0)[0]
print(f"nv {full.nv} over {model.nv}: rnea takes {saved:.2f} times as long")
assert saved > 1
# %% [markdown] lang="en"
# ## What if the arms do move?
#
# Give the held joints the speed $r$, and compare the legs' torques. The error has a part that grows as $r$, Coriolis
# forces between the arms' motion and that of the rest, and one that grows as $r^2$, the arms' own centrifugal forces. It
# is polynomial of degree two in $r$, exactly: $h$ is quadratic in the velocities.
# %% [markdown] lang="zh"
# ## 如果手臂其实在动?
#
# 让锁住的关节以速度 $r$ 转动,比较腿部力矩。误差有一部分与 $r$ 成正比,是手臂与其余部分之间的科里奥利力;另一部分与 $r^2$ 成正比,
# 是手臂自身的离心力。因为 $h$ 是速度的二次函数,误差恰好是 $r$ 的二次多项式。
# %%
held = np.setdiff1d(np.arange(full.nv), kept)
sway = np.zeros(full.nv)
sway[held] = rng.choice([-1.0, 1.0], held.size)


def missed(rate):
    """Return the error of the legs' torques."""
    moving = tw.nonlinear_effects(full, Q, V + rate * sway)[kept]
    return (moving - tw.nonlinear_effects(model, q, v))[6:]


linear = (missed(1.0) - missed(-1.0)) / 2
quadratic = (missed(1.0) + missed(-1.0)) / 2
assert np.abs(missed(0.0)).max() < 1e-13
for rate in (0.1, 1.0, 3.0):
    assert np.allclose(missed(rate), linear * rate + quadratic * rate**2, rtol=0, atol=1e-12)
    print(f"{rate:3} rad/s: {np.abs(missed(rate)).max():.2g} N m")

rates = np.geomspace(0.03, 10, 30)
ax = plt.figure(figsize=(6, 3.5), layout="constrained").add_subplot()
ax.loglog(rates, [np.abs(missed(r)).max() for r in rates], color=COLOURS["blue"], label="error")
ax.loglog(rates, [np.abs(linear * r).max() for r in rates], "--", color=COLOURS["orange"], label="part ~ r")
ax.loglog(rates, [np.abs(quadratic * r**2).max() for r in rates], ":", color=COLOURS["vermilion"], label="part ~ r²")
ax.set(xlabel="speed of the held joints [rad/s]", ylabel="largest error of a torque [N m]")
ax.legend()
plt.show()
# %% [markdown] lang="en"
# ## Can it stand?
#
# On both soles, it can. On one sole it cannot, unless it first moves its body over this sole. And under a heavy load on
# the torso, the motors of the knees are too weak. (A wrench on a frame is part of the scene; it is constant in the axes
# of the world.)
# %% [markdown] lang="zh"
# ## 站得住吗?
#
# 两只脚着地时站得住。只有一只脚着地时站不住,除非先把身体移到这只脚上方。躯干上的负载很重时,膝关节的电机力矩不够。
# (作用在坐标系上的外力是场景的一部分,大小恒定,沿世界坐标轴。)
# %%
one_leg = tw.Scene(full, contacts=soles[:1], hold=arms)
for robot in (scene, one_leg):
    print(robot.can_stand())
assert scene.can_stand()
assert not one_leg.can_stand()


def carrying(newtons):
    """Return the scene with a load on the torso."""
    return tw.Scene(full, contacts=soles, hold=arms, wrenches={"torso": [0, 0, 0, 0, 0, -newtons]})


borne, refused = 0, 3200  # N: it stands with the first, and not with the second
while refused - borne > 100:
    middle = (borne + refused) // 2
    borne, refused = (middle, refused) if carrying(middle).can_stand() else (borne, middle)
print(f"it bears {borne} N on its torso, and then:", carrying(refused).can_stand())
assert 0 < borne < refused < 3200
# %% [markdown] lang="en"
# ## Bad scenes raise an error
# %% [markdown] lang="zh"
# ## 有问题的场景会报错
# %%
bad = {
    "no such frame": lambda: tw.Scene("go2", contacts=[tw.PointContact("FL_fot", 0.7)]),
    "no such joint": lambda: tw.Scene("go2", hold=["arm_*"]),
    "friction below zero": lambda: tw.PointContact("FL_foot", -0.1),
    "contradiction": lambda: tw.Scene("go2", contacts=[tw.PointContact("FL_foot", mu) for mu in (0.7, 0.3)]),
    "held to the world": lambda: tw.Scene(
        "go2", base="fixed", hold=["FL_*"], contacts=[tw.PointContact("FL_foot", 0.7)]
    ),
}
# %%
said = {}
for name, make in bad.items():
    try:
        make()
    except ValueError as error:
        said[name] = str(error)
        print(f"{name}: {error}\n")
assert set(said) == set(bad)
assert "did you mean 'FL_foot'" in said["no such frame"]
# %% [markdown] lang="en"
# ## The cheapest model that will do
#
# Holding the arms is one way to simplify the model; the templates of 49.10 leave out more. For a walk with swinging
# arms, `cheapest` computes the error of each model in the wrench $\dot h_G$ of ground and weight together, as a share
# of the weight. For the models within the tolerance, it counts the operations of the compiled program, and it chooses
# the model with the fewest.
# %% [markdown] lang="zh"
# ## 够用的模型中代价最小的
#
# 锁住手臂是简化模型的一种办法,49.10 的模板省得更多。对一段摆臂行走,`cheapest` 算出每个模型的 $\dot h_G$(地面反力与重力的合 wrench)的误差,
# 以占体重的比例表示;再对误差在容许范围之内的模型,统计编译后的程序的运算次数,选出次数最少的一个。
# %%
walk = motions.walk(full, samples=60)
found = scene.cheapest(0.02, walk)
print(found)
found.plot()
plt.show()
worst = {option.name: option.worst() for option in found.options}
assert worst["full"] == 0
assert worst["centroidal"] < 1e-13
assert worst["this scene"] < worst["srbm_frozen"]
assert found.best.worst() <= 0.02
assert all(option.operations >= found.best.operations for option in found.options if option.worst() <= 0.02)
# %% [markdown] lang="en"
# As the table shows, the templates leave out the momentum of the legs, and a single rigid body of any shape cannot
# represent it. The robot whose arms are held leaves out only the swing of the arms, and it also gives the torques of
# the legs.
# %% [markdown] lang="zh"
# 从表中可以看到:模板漏掉的是腿的动量,单个刚体无论取什么形状,都不能表示它。手臂锁住的机器人漏掉的只有摆臂,而且还能给出腿部力矩。

# %% [markdown] lang="en"
# # Templates: from the whole robot to a point, and back
#
# Section 49.10 ends with a bridge: the centroidal momentum connects the whole robot with the models that plan its walk.
# This notebook walks over it in both directions. A pendulum plans a walk, a humanoid walks it, and the humanoid's
# momentum shows what the plan left out. Then a trot, and a jump with a flight in which the angular momentum really is
# constant.
# %% [markdown] lang="zh"
# # 模板:从整个机器人到一个质点,再回来
#
# 49.10 节最后说明:质心动量把整个机器人与规划步行的简化模型联系起来。这个笔记本从两个方向来看:
# 倒立摆规划一段行走,人形机器人照着走,它的动量说明规划漏掉了什么。然后是小跑,以及一次跳跃:腾空时角动量真的恒定。
# %%
import matplotlib.pyplot as plt
import numpy as np

import twistwrench as tw
from twistwrench import motions, plot
from twistwrench.templates import TEMPLATES, Centroidal, LinearPendulum, RigidBody

humanoid, go2 = tw.load("humanoid"), tw.load("go2")
g = 9.81
# %% [markdown] lang="en"
# ## A pendulum on one foot
#
# A point mass at constant height $z$, with the foot at $c$: the force runs along the leg and carries the weight, so
# $\ddot p = \frac gz (p - c)$. The solution is hyperbolic,
#
# $$p(t) = c + (p_0 - c)\cosh\omega t + \frac{\dot p_0}{\omega}\sinh\omega t, \qquad \omega = \sqrt{g/z}.$$
#
# The template `LinearPendulum` is made from the robot: its mass, and its height above the feet.
# %% [markdown] lang="zh"
# ## 单脚上的倒立摆
#
# 高度恒为 $z$ 的质点,脚在 $c$ 处:力沿着腿,并且托住重量,所以 $\ddot p = \frac gz (p - c)$。解是双曲函数:
#
# $$p(t) = c + (p_0 - c)\cosh\omega t + \frac{\dot p_0}{\omega}\sinh\omega t, \qquad \omega = \sqrt{g/z}.$$
#
# 模板 `LinearPendulum` 由机器人得到:它的质量,以及质心到脚的高度。
# %%
pendulum = LinearPendulum.of(humanoid, humanoid.standing())
omega = np.sqrt(g / pendulum.height)
print(f"mass {humanoid.mass:.1f} kg, height {pendulum.height:.3f} m, ω = {omega:.2f} 1/s")

t = np.linspace(0, 0.6, 61)[:, None]
foot = np.array([0.1, 0.0, 0.0])
start, speed = np.array([-0.05, 0.03, pendulum.height]), np.array([0.75, -0.12, 0.0])
level = np.array([1, 1, 0])
p = start + (start - foot) * level * (np.cosh(omega * t) - 1) + speed / omega * np.sinh(omega * t)
p_ddot = omega**2 * ((start - foot) * level * np.cosh(omega * t) + speed / omega * np.sinh(omega * t))
assert np.allclose(pendulum.acceleration(p, foot), p_ddot, rtol=1e-12, atol=1e-12)
assert np.allclose(pendulum.center_of_pressure(p, p_ddot), foot, rtol=0, atol=1e-12)
# %% [markdown] lang="en"
# ## A humanoid walks the pendulum's walk
#
# `tw.motions.walk` plans with this pendulum. The centre of pressure goes smoothly from sole to sole; for a steady gait
# the centre of mass follows harmonic by harmonic, $p_n = c_n / (1 + n^2\omega_s^2 z/g)$. Then the motion of the whole
# body is computed: the standing feet do not move, the trunk stays nearly level, and the legs follow. Velocities and
# accelerations come from the Jacobian of the same tasks.
# %% [markdown] lang="zh"
# ## 人形机器人照着倒立摆走
#
# `tw.motions.walk` 就用这个倒立摆规划。压力中心平滑地从一只脚掌移到另一只;对稳定的步态,质心逐个谐波地跟随,
# $p_n = c_n / (1 + n^2\omega_s^2 z/g)$。然后让全身来实现它:支撑脚不动,躯干近乎水平,腿跟着走。速度和加速度由同一组任务的雅可比矩阵求得。
# %%
walk = motions.walk(humanoid)
print(walk)
for k, name in enumerate(walk.feet):
    stands = walk.contacts[:, k]
    velocity = np.matvec(tw.frame_jacobian(humanoid, walk.q, name, "local_world_aligned"), walk.v)
    assert np.abs(velocity[stands]).max() < 1e-13  # neither slides nor turns

figure, ax = plt.subplots(figsize=(10, 3), layout="constrained")
for k, i in enumerate(range(0, len(walk), 33)):
    plot.side_view(humanoid, walk.q[i], shift=0.45 * k - walk.q[i, 0], ax=ax)
ax.set(title="a slow walk, from the side", xlabel="", xticks=[])
plt.show()
# %% [markdown] lang="en"
# ## What the plan left out
#
# The pendulum believes that the centre of pressure is at $p_G - \frac zg \ddot p_G$. In fact, the ground must exert
# $\dot h_G$ of the whole robot minus the weight, and its centre of pressure is at a distance of
# $|(\dot k_x, \dot k_y)| / f_z$ from there, because of the moment that swings the legs (49.10). In this walk the load
# $f_z$ is the weight $mg$ throughout, because the height is constant.
# %% [markdown] lang="zh"
# ## 规划漏掉了什么
#
# 按倒立摆,压力中心在 $p_G - \frac zg \ddot p_G$。实际上,地面要提供整个机器人的 $\dot h_G$ 减去重力,它的压力中心与前者
# 相差 $|(\dot k_x, \dot k_y)| / f_z$,原因是摆腿所需的力矩(49.10)。这段行走高度不变,法向力 $f_z$ 始终等于重力 $mg$。
# %%
com = tw.center_of_mass(humanoid, walk.q)
height = com[0, 2] - tw.frame_placement(humanoid, walk.q[0], walk.feet[0]).translation[2]
lower = LinearPendulum.of(humanoid, humanoid.standing(), height=height)  # it walks with bent knees
(p_ddot,) = lower.read(walk.q, walk.v, walk.a)
planned = lower.center_of_pressure(com, p_ddot)
needed = motions.ground(humanoid, walk)
missed = np.hypot(*(needed.center_of_pressure - planned)[:, :2].mT)
k_rate = tw.centroidal_momentum_rate(humanoid, walk.q, walk.v, walk.a)[:, :2]
assert np.allclose(missed, np.hypot(*k_rate.mT) / (humanoid.mass * g), rtol=0, atol=1e-12)
print(f"the centre of pressure is off by up to {1e3 * missed.max():.0f} mm")
print(f"it stays {1e3 * needed.margin.min():.0f} mm inside the soles")
assert 0.02 < missed.max() < 0.04
assert needed.margin.min() > 0.01

figure, ax = plt.subplots(figsize=(9, 3.4), layout="constrained")
soles = np.stack([tw.frame_placement(humanoid, walk.q, name).translation for name in walk.feet], axis=1)
for i in range(0, len(walk), 20):
    for side in (slice(0, 4), slice(4, 8)):
        corners = soles[i, side][[0, 1, 3, 2, 0], :2]
        if walk.contacts[i, side].all():
            ax.plot(*corners.mT, color=plot.COLOURS["grey"], linewidth=1)
ax.plot(*com[:, :2].mT, color=plot.COLOURS["purple"], label="centre of mass")
ax.plot(*planned[:, :2].mT, color=plot.COLOURS["sky"], linewidth=5, label="centre of pressure, the pendulum's")
ax.plot(*needed.center_of_pressure[:, :2].mT, color=plot.COLOURS["vermilion"], label="the whole robot's")
ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="from above, one stride; grey: soles that stand")
ax.legend(fontsize=8, loc="upper center", ncols=3, bbox_to_anchor=(0.5, -0.2))
plt.show()
# %% [markdown] lang="en"
# ## Six templates, three motions, two robots
#
# Every template predicts $\dot h_G$ from what it knows; the full model's comes from the base's rows of RNEA. The table
# has the errors as a share of the weight (a moment divided by the radius of gyration counts as a force):
# %% [markdown] lang="zh"
# ## 六个模板,三种运动,两个机器人
#
# 每个模板用自己知道的那几个数预测 $\dot h_G$;完整模型的 $\dot h_G$ 取自 RNEA 的基座行。漏掉的部分相对于体重(力矩除以回转半径,当作力)如下:
# %%
moves = {
    (model.name, name): (model, make(model, samples=80))
    for model in (go2, humanoid)
    for name, make in motions.MOTIONS.items()
}
missed = {}
print(f"{'root mean square':18}" + "".join(f"{name:>13}" for name in TEMPLATES))
for key, (model, m) in moves.items():
    for name, template in TEMPLATES.items():
        relative = template.of(model, model.standing()).residual(m.q, m.v, m.a).relative
        missed[*key, name] = np.sqrt((relative**2).mean())
    print(f"{key[0]:9} {key[1]:8}" + "".join(f"{round(missed[*key, name], 12):13.2g}" for name in TEMPLATES))

assert max(missed[*key, "centroidal"] for key in moves) < 1e-14  # exact, whatever moves
assert missed["go2", "walk", "lipm"] < 0.03 < 0.3 < missed["go2", "trot", "lipm"]
assert missed["go2", "jump", "srbm"] < 0.6 * missed["go2", "jump", "point_mass"]
assert missed["humanoid", "jump", "srbm"] > 4 * missed["humanoid", "jump", "point_mass"]
# %% [markdown] lang="en"
# The last line is a surprise: for the humanoid's jump the rigid body is worse than the point. Its trunk turns one way
# because its legs turn the other, and the rigid body takes the trunk's turning for that of the whole robot.
#
# A rigid body is right where the joints are still, to the last digit, and what it misses at rest is the joints' part of
# the momentum matrix, $A_{G,j}\,\ddot q_j$:
# %% [markdown] lang="zh"
# 最后一行出人意料:人形机器人跳跃时,单刚体比质点还差。躯干往一边转,正是因为腿往另一边转,单刚体却把躯干的转动当成整个机器人的转动。
#
# 关节不动时,单刚体精确到最后一位;静止时它漏掉的正是动量矩阵中关节那一块,$A_{G,j}\,\ddot q_j$:
# %%
rng = np.random.default_rng(10)
body, q = RigidBody.of(go2, go2.standing()), go2.random_configuration(rng=rng)
v, a = rng.standard_normal((2, go2.nv))
still = np.r_[v[:6], np.zeros(12)], np.r_[a[:6], np.zeros(12)]
assert body.residual(q, *still).relative < 1e-13

at_rest = body.residual(q, 0 * v, a).moment
assert np.allclose(at_rest, -tw.centroidal_map(go2, q)[:3, 6:] @ a[6:], rtol=0, atol=1e-12)
# %% [markdown] lang="en"
# ## A jump
#
# In flight the ground does nothing: $\dot h_G = (0, mg)$. A jump whose joints and trunk are both prescribed breaks that
# law. Here $k_G(t)$ is prescribed instead, constant in flight, and the turning of the trunk is solved for. So in the air
# $\dot k_G = 0$ is no approximation, however the legs swing, and the point mass is exact. What fails is the constant
# height.
# %% [markdown] lang="zh"
# ## 跳跃
#
# 腾空时地面什么也不做:$\dot h_G = (0, mg)$。若把关节和躯干的运动都事先规定,就会违反这条定律。这里规定的是 $k_G(t)$,腾空时恒定,
# 躯干怎样转动由此解出。所以在空中 $\dot k_G = 0$ 不是近似,不管腿怎样摆动都成立,质点模型是精确的;不成立的是高度恒定。
# %%
_, jump = moves["go2", "jump"]
flies = ~jump.contacts.any(axis=1)
rate = tw.centroidal_momentum_rate(go2, jump.q, jump.v, jump.a)
k_G = tw.centroidal_momentum(go2, jump.q, jump.v)[:, :3]
assert np.abs(rate[flies] - [0, 0, 0, 0, 0, -go2.mass * g]).max() < 1e-8
assert np.ptp(k_G[flies], axis=0).max() < 1e-10
assert np.abs(k_G[flies]).max() > 0.4  # constant, and not zero

figure, ax = plt.subplots(figsize=(11, 1.9), layout="constrained")
for k, i in enumerate(range(0, len(jump), 33)):
    plot.side_view(go2, jump.q[i], shift=0.75 * k - jump.q[i, 0], ax=ax)
ax.axhline(0, color="k", linewidth=0.8)
ax.set(title="a jump of Go2", xlabel="", xticks=[])

figure, axes = plt.subplots(1, 2, figsize=(11, 3.4), layout="constrained")
axes[0].plot(jump.t, k_G[:, 1], color=plot.COLOURS["green"])
axes[0].set(title="k_y [kg m²/s]", xlabel="time [s]")
for name, colour in {"point_mass": "blue", "lipm": "orange", "srbm": "vermilion"}.items():
    relative = TEMPLATES[name].of(go2, go2.standing()).residual(jump.q, jump.v, jump.a).relative
    axes[1].semilogy(jump.t, relative, color=plot.COLOURS[colour], label=name)
axes[1].set(title="left out of ḣ_G / weight", xlabel="time [s]")
axes[1].legend(fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
for ax in axes:
    ax.axvspan(*jump.t[flies][[0, -1]], color=plot.COLOURS["grey"], alpha=0.2, linewidth=0)
plt.show()
# %% [markdown] lang="en"
# ## The law costs little, its inputs do not
#
# From a whole-body state no template is much cheaper than the full model: $\ddot p_G$ is a sum over all bodies. But its
# law, once the few numbers are read, is a few multiplications: that is what planners use.
# %% [markdown] lang="zh"
# ## 公式省时,输入不省时
#
# 从全身状态出发,没有一个模板比完整模型省很多时间,因为 $\ddot p_G$ 要对所有刚体求和。但已知那几个数之后,公式只需几次乘法,
# 规划器用的就是这一步。
# %%
(known,), exact = TEMPLATES["point_mass"].of(go2, go2.standing()).read(jump.q, jump.v, jump.a), Centroidal
print("the point mass reads", known.shape, "and its law multiplies by the mass")
law = TEMPLATES["point_mass"].of(go2, go2.standing()).law(known)
assert np.allclose(law[:, 3:], exact.of(go2, go2.standing()).rate(jump.q, jump.v, jump.a)[:, 3:], rtol=0, atol=1e-11)
# %% [markdown] lang="en"
# `docs/templates.md` has the table for Go2, Solo12, Talos and G1, with times; `python -m benchmarks.study templates` computes it
# again.
# %% [markdown] lang="zh"
# Go2、Solo12、Talos、G1 的表格和时间见 `docs/templates.zh-CN.md`;`python -m benchmarks.study templates` 可以重新生成。

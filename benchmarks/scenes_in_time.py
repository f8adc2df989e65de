"""Trials of scenes, part two: motions in time, against Pinocchio's dynamics by DOP853, MuJoCo and closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pinocchio as pin
from scenes_at_once import FEET, GO2, HUMANOID, SOLES, G, There, off
from scipy.integrate import solve_ivp

import twistwrench as tw
from twistwrench import bridge, motions

FLOOR = tw.Ground()


def by_dop853(model: tw.Model, q: np.ndarray, v: np.ndarray, duration: float) -> np.ndarray:
    """Return the configuration after a free motion: Pinocchio's ABA, SciPy's Runge-Kutta of order 8, on q itself."""
    there, data = bridge.to_pinocchio_model(model), bridge.to_pinocchio_model(model).createData()
    base = model.base == "floating"

    def rate(_: float, x: np.ndarray) -> np.ndarray:
        q, v = x[: model.nq], x[model.nq :]
        a = pin.aba(there, data, q, v, np.zeros(model.nv))
        if not base:
            return np.r_[v, a]
        turn = pin.Quaternion(q[6], *q[3:6])
        half = pin.Quaternion(0.0, *v[3:6] / 2)
        return np.r_[turn.toRotationMatrix() @ v[:3], (turn * half).coeffs(), v[6:], a]

    x = np.r_[q, bridge.to_pinocchio_tangent(model, v)]
    return solve_ivp(rate, (0, duration), x, method="DOP853", rtol=1e-12, atol=1e-12).y[: model.nq, -1]


def cuboid(sides: tuple[float, float, float], mu: float) -> tuple[tw.Model, list[tw.PointContact]]:
    """Return a box of 2 kg, its origin at its middle, and its lower corners."""
    box = tw.Builder("box", base="floating", root="box", root_inertia=tw.SpatialInertia.from_box(2.0, sides))
    for k in range(4):
        at = np.array([1 - k // 2 * 2, 1 - k % 2 * 2, -1]) * np.array(sides) / 2
        box.link(f"c{k}", parent="box", placement=tw.SE3(np.eye(3), at))
    return box.build(), [tw.PointContact(f"c{k}", mu) for k in range(4)]


def ball(**touch: object) -> tuple[tw.Model, list[tw.SphereContact]]:
    """Return a solid ball of 2 kg and 0.1 m, and its contact."""
    solid = tw.SpatialInertia.from_sphere(2.0, 0.1)
    model = tw.Builder("ball", base="floating", root="ball", root_inertia=solid).build()
    return model, [tw.SphereContact("ball", 0.1, 0.5, **touch)]


# ---------------------------------------------------------------- free motion


def double_pendulum() -> float:
    """Compare angles after 2 s at dt = 5 ms."""
    model, q = tw.load("double_pendulum"), np.array([1.5, -0.7])
    s = tw.simulate(model, q, 0 * q, dt=0.005, duration=2.0)
    return off(s.q[-1], by_dop853(model, q, 0 * q, 2.0))


def satellite() -> float:
    """Compare a free body with an arm of two joints: its configuration after 2 s at dt = 10 ms."""
    body = tw.SpatialInertia.from_box(20, [1, 1, 1])
    builder = tw.Builder("satellite", base="floating", gravity=[0, 0, 0], root_inertia=body)
    rod = tw.SpatialInertia.from_rod(2.0, 0.8).transform(tw.SE3(np.eye(3), [0, 0, 0.4]))
    for name, on, z in (("upper", "base_link", 0.5), ("lower", "upper", 0.8)):
        builder.link(name, parent=on, joint=tw.Revolute("y"), inertia=rod, placement=tw.SE3(np.eye(3), [0, 0, z]))
    model = builder.build()
    v = np.array([0.3, 0.1, 0.2, 0, 0, 0, 1.0, -2.0])
    s = tw.simulate(model, model.neutral(), v, dt=0.01, duration=2.0)
    return off(s.q[-1], by_dop853(model, model.neutral(), v, 2.0))


def two_robots() -> float:
    """Compare two Go2 without weight that hold each other, for 0.1 s: change of their momentum together."""
    one = replace(GO2, gravity=np.zeros(3))
    two = tw.attach(one, one, None, prefix="b_", placement=tw.SE3(np.eye(3), [1.0, 0, 0]))
    grip = [tw.LoopClosure("base", "b_base", welded=True)]
    v = tw.impact(two, two.neutral(), np.random.default_rng(2).normal(size=two.nv), grip).v
    s = tw.simulate(two, two.neutral(), v, dt=0.002, steps=50, contacts=grip)
    return float(np.ptp(s.momentum_about_origin, axis=0).max() / np.abs(s.momentum_about_origin).max())


# ---------------------------------------------------------------- on the ground


def box_slides() -> float:
    """Compare how far a box at 1 m/s slides, mu = 0.4, at dt = 1 ms."""
    box, corners = cuboid((0.2, 0.2, 0.1), 0.4)
    q, v = np.r_[0, 0, 0.05, 0, 0, 0, 1], 1.0 * np.eye(6)[3]
    s = tw.simulate(box, q, v, dt=0.001, duration=0.4, contacts=corners, ground=FLOOR)
    return abs(s.q[-1, 0] * 2 * 0.4 * G - 1)


def box_is_thrown() -> float:
    """Compare where a box at (1, 0.5) m/s comes to rest: beside MuJoCo, whose contacts are soft and creep."""
    import mujoco

    xml = """<mujoco><option timestep="0.001" cone="elliptic" impratio="100"/><worldbody>
    <geom type="plane" size="5 5 1" friction="0.4 0 0" condim="3"/><body pos="0 0 0.05"><freejoint/>
    <geom type="box" size="0.1 0.1 0.05" mass="2" friction="0.4 0 0" condim="3"/></body></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    data.qvel[:2] = 1.0, 0.5
    for _ in range(500):
        mujoco.mj_step(model, data)
    box, corners = cuboid((0.2, 0.2, 0.1), 0.4)
    q, v = np.r_[0, 0, 0.05, 0, 0, 0, 1], np.r_[0, 0, 0, 1.0, 0.5, 0]
    s = tw.simulate(box, q, v, dt=0.001, duration=0.5, contacts=corners, ground=FLOOR)
    return off(s.q[-1, :2], data.qpos[:2])


def box_on_a_slope() -> float:
    """Compare the slope from which a box of 2 : 1 topples, by halves: its tangent is 1/2."""
    box, corners = cuboid((0.1, 0.1, 0.2), 2.0)

    def topples(slope: float) -> bool:
        n = np.array([np.sin(slope), 0, np.cos(slope)])
        q = np.r_[0.1 * n, 0, np.sin(slope / 2), 0, np.cos(slope / 2)]
        on = [replace(c, normal=tuple(n)) for c in corners]
        s = tw.simulate(box, q, np.zeros(6), dt=0.005, duration=0.5, contacts=on, ground=tw.Ground(normal=n))
        return bool(np.abs(s.v[-1]).max() > 1e-3)

    low, high = 0.3, 0.6
    while high - low > 1e-4:
        middle = (low + high) / 2
        low, high = (low, middle) if topples(middle) else (middle, high)
    return abs(np.tan(high) / 0.5 - 1)


def ball_rolls() -> float:
    """Compare the acceleration of a ball down a slope of 0.3 rad: 5/7 g sin, at dt = 1 ms."""
    n = np.array([np.sin(0.3), 0, np.cos(0.3)])
    model, touch = ball(normal=tuple(n))
    q = np.r_[0.1 * n, 0, 0, 0, 1]
    s = tw.simulate(model, q, np.zeros(6), dt=0.001, steps=200, contacts=touch, ground=tw.Ground(normal=n))
    return abs(np.linalg.norm(s.v[-1, 3:]) / (5 / 7 * G * np.sin(0.3) * 0.2) - 1)


def ball_bounces() -> float:
    """Compare the height after a bounce with e = 0.8, of a drop by 0.5 m, at dt = 1 ms: e² of it."""
    model, touch = ball()
    q = np.r_[0, 0, 0.6, 0, 0, 0, 1]
    s = tw.simulate(model, q, np.zeros(6), dt=0.001, duration=0.8, contacts=touch, ground=tw.Ground(restitution=0.8))
    return abs((s.q[400:, 2].max() - 0.1) / (0.64 * 0.5) - 1)


def rail_and_ground() -> float:
    """Compare when a bead on a rail of 30° comes to the floor, at dt = 1 ms; there it stops."""
    solid = tw.SpatialInertia.from_sphere(2.0, 0.02)
    builder = tw.Builder("bead", base="floating", root="bead", root_inertia=solid)
    builder.link("tip", parent="bead")
    bead = builder.build()
    rail = tw.SlidingContact("bead", [[0, 1, 0], [0.5, 0, 0.75**0.5]])
    q, held = np.r_[0, 0, 0.3, 0, 0, 0, 1], [rail, tw.PointContact("tip", 0.0)]
    s = tw.simulate(bead, q, np.zeros(6), dt=0.001, duration=0.6, contacts=held, ground=FLOOR)
    assert abs(s.q[-1, 2]) < 1e-9
    assert np.abs(s.v[-1]).max() < 1e-9
    return abs(s.t[s.q[:, 2] < 1e-9][0] / np.sqrt(2 * 0.3 / G / 0.25) - 1)


def go2_lands() -> float:
    """Compare q̇ after all feet land at 1 m/s and stick, beside Pinocchio's impulse dynamics."""
    q, v = GO2.standing(), 0.2 * np.eye(18)[0] + 0.1 * np.eye(18)[3] - np.eye(18)[5]
    sticky = [replace(foot, mu=50.0) for foot in FEET]
    s = tw.simulate(GO2, q, v, dt=1e-8, steps=1, contacts=sticky, ground=FLOOR)
    there = There(GO2)
    data, models = there.model.createData(), pin.StdVec_RigidConstraintModel()
    for foot in GO2.feet:
        frame = there.model.frames[there.model.getFrameId(foot)]
        kind, axes = pin.ContactType.CONTACT_3D, pin.LOCAL_WORLD_ALIGNED
        models.append(pin.RigidConstraintModel(kind, there.model, frame.parentJoint, frame.placement, axes))
    datas = pin.StdVec_RigidConstraintData()
    datas.extend([m.createData() for m in models])
    pin.initConstraintDynamics(there.model, data, models, datas)
    after = pin.impulseDynamics(there.model, data, q, bridge.to_pinocchio_tangent(GO2, v), models, datas, 0.0)
    return off(s.v[-1], bridge.from_pinocchio_tangent(GO2, after))


def go2_drops_and_stands() -> float:
    """Compare what its feet bear 2.5 s after a drop by 0.3 m, over its weight."""
    q, hold = GO2.standing(), tw.static_equilibrium(GO2, GO2.standing()).tau
    drives = replace(GO2, damping=np.r_[np.zeros(6), np.full(12, 3.0)])
    s = tw.simulate(
        drives,
        q + 0.3 * np.eye(19)[2],
        np.zeros(18),
        dt=0.005,
        duration=2.5,
        tau=lambda t, x, v: np.r_[np.zeros(6), hold - 80.0 * (x[7:] - q[7:])],
        contacts=FEET,
        ground=FLOOR,
    )
    assert min(force[:, 2].min() for force in s.contact_forces.values()) >= 0
    return abs(sum(s.contact_forces.values())[-1, 2] / (G * pin.computeTotalMass(There(GO2).model)) - 1)


def go2_crawls() -> float:
    """Compare the base with its plan after one stride of 156 mm on the ground, in mm: nothing there measures it."""
    stride = motions.walk(GO2, samples=201)
    plan = np.zeros((201, 18))
    for phase in tw.Scene(GO2, contacts=FEET).phases(stride):
        states = (x[phase.states] for x in (stride.q, stride.v, stride.a))
        plan[phase.states] = tw.contact_inverse_dynamics(GO2, *states, phase.scene.contacts).tau

    def policy(t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        k = int(t / stride.t[-1] * 200 + 1e-6)
        return np.r_[np.zeros(6), plan[k, 6:] + 60.0 * (stride.q[k, 7:] - q[7:]) + 3.0 * stride.v[k, 6:]]

    drives = replace(GO2, damping=np.r_[np.zeros(6), np.full(12, 3.0)])
    clock = {"dt": stride.t[-1] / 400, "steps": 400}
    s = tw.simulate(drives, stride.q[0], stride.v[0], tau=policy, contacts=FEET, ground=FLOOR, **clock)
    return float(1e3 * np.linalg.norm(s.q[-1, :3] - stride.q[-1, :3]))


def humanoid_is_pushed() -> float:
    """Compare the turn about its toes from which it tips, stiff, by halves at dt = 2 ms: by its energy."""
    q = HUMANOID.standing()[:7]
    stiff = tw.lock_joints(HUMANOID, HUMANOID.joint_names[2:], HUMANOID.standing()).model
    toes = tw.frame_placement(stiff, q, "left_sole").act([0.076, 0, 0])
    ahead, _, up = toes - tw.center_of_mass(stiff, q)
    R = tw.frame_placement(stiff, q, stiff.joint_names[1]).rotation
    turn = np.array([0, 1.0, 0])
    v = np.concatenate([R.T @ turn, R.T @ np.cross(turn, q[:3] - toes)])
    edge = np.sqrt(G * stiff.mass * (np.hypot(ahead, up) + up) / tw.kinetic_energy(stiff, q, v))
    low, high = 0.9, 1.1
    while high - low > 2e-3:
        share = (low + high) / 2
        s = tw.simulate(stiff, q, share * edge * v, dt=0.002, duration=1.2, contacts=SOLES, ground=FLOOR)
        falls = tw.center_of_mass(stiff, s.q[-1])[0] > toes[0]
        low, high = (low, share) if falls else (share, high)
    return abs(high - 1)

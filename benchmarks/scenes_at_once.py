"""Trials of scenes, part one: the forces and accelerations of one state, against Pinocchio, SciPy and closed forms.

Each function returns how far we are off, as a share of the largest number unless its name in `scene_trials` has a unit.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import pinocchio as pin
from scipy.optimize import linprog

import twistwrench as tw
from twistwrench import bridge, motions
from twistwrench.contact import Contact

GO2, HUMANOID = tw.load("go2"), tw.load("humanoid")
G = 9.81
FEET = [tw.PointContact(foot, 0.6) for foot in GO2.feet]
SOLES = [tw.SurfaceContact(f"{side}_sole", (0.076, 0.0275), 0.6) for side in ("left", "right")]


def off(ours: np.ndarray, right: np.ndarray) -> float:
    """Return the largest difference over the largest number."""
    return float(np.abs(ours - right).max() / np.abs(right).max())


def moving(model: tw.Model, seed: int = 0, about: np.ndarray | None = None) -> tuple[np.ndarray, ...]:
    """Return q near a posture, v, a and τ at random."""
    rng = np.random.default_rng(seed)
    q = model.integrate(model.standing() if about is None else about, rng.uniform(-0.2, 0.2, model.nv))
    return q, *rng.normal(size=(3, model.nv))


class There:
    """Pinocchio's model of ours, or one that it made of its own; tangents are in its order."""

    def __init__(self, model: tw.Model) -> None:
        self.ours, self.model = model, bridge.to_pinocchio_model(model)

    def rnea(self, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
        """Return τ."""
        tangents = (bridge.to_pinocchio_tangent(self.ours, x) for x in (v, a))
        tau = pin.rnea(self.model, self.model.createData(), q, *tangents)
        return bridge.from_pinocchio_tangent(self.ours, tau)

    def crba(self, q: np.ndarray) -> np.ndarray:
        """Return M, of τ for unit accelerations."""
        still, eye = np.zeros(self.ours.nv), np.eye(self.ours.nv)
        return np.stack([self.rnea(q, still, one) - self.rnea(q, still, still) for one in eye], axis=1)

    def jacobian(self, q: np.ndarray, frames: Iterable[str], *, turns: bool = False) -> np.ndarray:
        """Return the linear rows of frames, below those of ω where they are asked for, in the axes of the world."""
        data, rows = self.model.createData(), list[np.ndarray]()
        for name in frames:
            J = pin.computeFrameJacobian(self.model, data, q, self.model.getFrameId(name), pin.LOCAL_WORLD_ALIGNED)
            order = (3, 4, 5, 0, 1, 2) if turns else (0, 1, 2)
            rows.append(np.stack([bridge.from_pinocchio_tangent(self.ours, J[k]) for k in order]))
        return np.concatenate(rows)

    def held(self, q: np.ndarray, v: np.ndarray, tau: np.ndarray, contacts: Sequence[Contact]) -> np.ndarray:
        """Return q̈ with points, and frames that hold frames, by its constraint dynamics."""
        data, models = self.model.createData(), pin.StdVec_RigidConstraintModel()
        anchors = tw.contact_placements(self.ours, q, contacts)
        for c in contacts:
            kind = pin.ContactType.CONTACT_6D if c.dim == 6 else pin.ContactType.CONTACT_3D
            frame = self.model.frames[self.model.getFrameId(c.frame)]
            ends = [frame.parentJoint, frame.placement]
            if c.to is not None:
                other, at = self.model.frames[self.model.getFrameId(c.to)], anchors[c.frame]
                ends = [other.parentJoint, other.placement * pin.SE3(at.rotation, at.translation), *ends]
            axes = pin.LOCAL if c.to else pin.LOCAL_WORLD_ALIGNED
            models.append(pin.RigidConstraintModel(kind, self.model, *ends, axes))
        datas = pin.StdVec_RigidConstraintData()
        datas.extend([m.createData() for m in models])
        pin.initConstraintDynamics(self.model, data, models, datas)
        rates = (bridge.to_pinocchio_tangent(self.ours, x) for x in (v, tau))
        exact = pin.ProximalSettings(1e-14, 1e-14, 0.0, 1)
        return bridge.from_pinocchio_tangent(
            self.ours, pin.constraintDynamics(self.model, data, q, *rates, models, datas, exact)
        )


def at_rest_on(model: tw.Model, contacts: Sequence[Contact], q: np.ndarray, seed: int = 1) -> np.ndarray:
    """Return a velocity with which no contact moves."""
    return tw.impact(model, q, np.random.default_rng(seed).normal(size=model.nv), contacts).v


# ---------------------------------------------------------------- what is carried, held and left out


def panda_with_a_box() -> float:
    """Compare forces of the motors."""
    arm, box = tw.load("panda"), tw.SpatialInertia.from_box(1.5, [0.1, 0.1, 0.2])
    scene = tw.Scene(arm, payload={"panda_hand": box}, hold=["*finger*"])
    q, v, a, _ = moving(scene.model, about=scene.reduce(scene.q, np.zeros(arm.nv))[0])
    there, hand = There(arm), arm.frame("panda_hand")
    there.model.appendBodyToJoint(
        there.model.frames[there.model.getFrameId("panda_hand")].parentJoint,
        bridge.to_pinocchio_inertia(box),
        bridge.to_pinocchio_se3(hand.placement),
    )
    (Q, V), (_, A) = scene.expand(q, v), scene.expand(q, a)
    kept = tw.lock_joints(arm, scene.held, scene.q).kept_v
    return off(tw.rnea(scene.model, q, v, a), there.rnea(Q, V, A)[kept])


def talos_on_one_foot() -> float:
    """Compare torques while it waves, on a sole: Pinocchio's, less those of the wrench that the base asks for."""
    model = tw.load("talos_reduced")
    sole = [tw.SurfaceContact("left_sole_link", (0.1, 0.06), 0.7)]
    q, v, a, _ = moving(model)
    found = tw.contact_inverse_dynamics(model, q, v, a, sole)
    there = There(model)
    tau, J = there.rnea(q, v, a), there.jacobian(q, ["left_sole_link"], turns=True)
    return off(found.tau[6:], (tau - J.T @ np.linalg.solve(J[:, :6].T, tau[:6]))[6:])


def go2_trots_in_place() -> float:
    """Compare the rate of the centroidal momentum, over the weight."""
    trot = motions.trot(GO2, samples=20, speed=0)
    there, errors = There(GO2), list[float]()
    for q, v, a in zip(trot.q, trot.v, trot.a):
        data = there.model.createData()
        tangents = (bridge.to_pinocchio_tangent(GO2, x) for x in (v, a))
        rate = pin.computeCentroidalMomentumTimeVariation(there.model, data, q, *tangents)
        right = np.r_[rate.angular, rate.linear]
        errors.append(np.abs(tw.centroidal_momentum_rate(GO2, q, v, a) - right).max() / (G * GO2.mass))
    return max(errors)


def go2_with_a_broken_leg() -> float:
    """Compare q̈ on three feet, beside Pinocchio's own reduced model."""
    scene = tw.Scene(GO2, contacts=FEET[:3], hold=["RR_*"])
    q, _, _, tau = moving(scene.model)
    v = at_rest_on(scene.model, scene.contacts, q)
    ours = tw.contact_forward_dynamics(scene.model, q, v, tau, scene.contacts).qdd
    whole, there = bridge.to_pinocchio_model(GO2), There(scene.model)
    locked = [whole.getJointId(f"RR_{part}_joint") for part in ("hip", "thigh", "calf")]
    there.model = pin.buildReducedModel(whole, locked, scene.q)
    return off(ours, there.held(q, v, tau, scene.contacts))


def humanoid_at_a_wall() -> float:
    """Compare the least friction, as a share of what there is: beside linear programmes of SciPy's HiGHS."""
    hands = [tw.PointContact(f"{side}_hand", 0.4, normal=(-1, 0, 0)) for side in ("left", "right")]
    points = [tw.PointContact(f"{side}_sole_{c}", 0.4) for side in ("left", "right") for c in ("fl", "fr", "rl", "rr")]
    q = HUMANOID.integrate(HUMANOID.standing(), 0.3 * np.eye(27)[1])
    contacts = [*points, *hands]
    there, least = There(HUMANOID), tw.stance_margins(HUMANOID, q, contacts).friction_used
    J, weight = there.jacobian(q, [c.frame for c in contacts]), there.rnea(q, np.zeros(27), np.zeros(27))
    way = np.arange(16) * np.pi / 8
    low, high = 0.0, 20.0
    while high - low > 1e-9:
        share = (low + high) / 2
        rows = []
        for c in contacts:
            sides = np.stack([np.cos(way), np.sin(way), np.full(16, -share * c.mu * np.cos(np.pi / 16))], axis=1)
            rows.append(np.concatenate([sides, [[0, 0, -1]]]) @ c.axes(np.eye(3)).T)
        A = np.zeros((17 * len(rows), 3 * len(rows)))
        for k, row in enumerate(rows):
            A[17 * k : 17 * k + 17, 3 * k : 3 * k + 3] = row
        found = linprog(np.zeros(len(J)), A, np.zeros(len(A)), J[:, :6].T, weight[:6], (None, None))
        low, high = (low, share) if found.status == 0 else (share, high)
    return abs(least - high) / high


def iris_with_a_load() -> float:
    """Compare the acceleration under four thrusts, 0.3 kg below the base."""
    drone = tw.load("iris")
    builder = tw.Builder("load", base="floating", root_inertia=tw.SpatialInertia.from_sphere(0.3, 0.05))
    scene = tw.Scene(tw.attach(drone, builder.build(), drone.joint_names[1], placement=tw.SE3(np.eye(3), [0, 0, -0.2])))
    q, v, _, tau = moving(scene.model, about=scene.model.neutral())
    there = There(scene.model)
    tangents = (bridge.to_pinocchio_tangent(scene.model, x) for x in (v, tau))
    right = pin.aba(there.model, there.model.createData(), q, *tangents)
    return off(tw.aba(scene.model, q, v, tau), bridge.from_pinocchio_tangent(scene.model, right))


def tiago_on_the_floor() -> float:
    """Compare M of the base that slides and turns, beside Xᵀ M X of Pinocchio's free one."""
    scene = tw.Scene(tw.load("tiago_no_hand", base="floating"), base="planar")
    q, v, *_ = moving(scene.model, about=scene.reduce(scene.q, np.zeros(scene.full_model.nv))[0])
    columns = np.stack([scene.expand(q, one)[1] for one in np.eye(scene.model.nv)], axis=1)
    Q = scene.expand(q, v)[0]
    return off(tw.crba(scene.model, q), columns.T @ There(scene.full_model).crba(Q) @ columns)


# ---------------------------------------------------------------- who touches what


def elevator() -> float:
    """Compare what the feet bear while the floor goes up at 2 m/s²."""
    up = [tw.PointContact(foot, 0.6, acceleration=(0, 0, 2.0)) for foot in GO2.feet]
    q, rest = GO2.standing(), np.zeros(18)
    tau = tw.contact_inverse_dynamics(GO2, q, rest, 2.0 * np.eye(18)[5], FEET).tau
    found = tw.contact_forward_dynamics(GO2, q, rest, tau, up)
    return off(sum(found.forces.values()), np.array([0, 0, pin.computeTotalMass(There(GO2).model) * (G + 2.0)]))


def biped_on_two_lines() -> float:
    """Compare q̈ on the front edges of its soles, each two points: beside least squares with Pinocchio's M, h and J."""
    edges = [f"{side}_sole_{c}" for side in ("left", "right") for c in ("fl", "fr")]
    contacts = [tw.PointContact(edge, 0.6) for edge in edges]
    q, _, _, tau = moving(HUMANOID)
    rest, there = np.zeros(27), There(HUMANOID)
    M, J = there.crba(q), there.jacobian(q, edges)
    free = np.linalg.solve(M, tau - there.rnea(q, rest, rest))
    L = np.linalg.cholesky(M)
    Y = np.linalg.solve(L, J.T)
    force = np.linalg.lstsq(Y, -L.T @ free, rcond=1e-10)[0]
    return off(
        tw.contact_forward_dynamics(HUMANOID, q, rest, tau, contacts).qdd, free + np.linalg.solve(M, J.T @ force)
    )


def box_in_both_hands() -> float:
    """Compare q̈ of a humanoid on its soles and of the box that it holds."""
    box = tw.Builder("box", base="floating", root_inertia=tw.SpatialInertia.from_box(2.0, [0.3, 0.3, 0.2]))
    both = tw.attach(HUMANOID, box.build(), None, prefix="its_")
    hands = [tw.LoopClosure(f"{side}_hand", "its_base_link", welded=side == "left") for side in ("left", "right")]
    held = [*(tw.PointContact(f"{side}_sole", 0.6) for side in ("left", "right")), *hands]
    q = np.r_[moving(HUMANOID)[0], 0.3, 0, 0.9, 0, 0, 0, 1]
    tau, v = np.random.default_rng(4).normal(size=both.nv), at_rest_on(both, held, q)
    return off(tw.contact_forward_dynamics(both, q, v, tau, held).qdd, There(both).held(q, v, tau, held))


def belt() -> float:
    """Compare what a robot that is set down on a belt gets of it: the velocity after, all of it the belt's."""
    belt = [tw.SurfaceContact("left_sole", (0.076, 0.0275), 0.6, velocity=(0, 0, 0, 0.8, 0, 0))]
    q = HUMANOID.standing()
    stiff = tw.lock_joints(HUMANOID, HUMANOID.joint_names[2:], q).model
    after = tw.impact(stiff, q[:7], np.zeros(6), belt)
    return off(np.r_[after.v, after.energy_lost], np.r_[0, 0, 0, 0.8, 0, 0, -stiff.mass * 0.8**2 / 2])


def four_bar() -> float:
    """Compare a parallelogram: θ̈ of two cranks of length l and a coupler that only shifts."""
    l, m, coupler, angle = 0.4, 1.2, 0.7, 0.6
    builder = tw.Builder("parallelogram")
    rod, bar = tw.SpatialInertia.from_rod(m, l), tw.SpatialInertia.from_rod(coupler, l)
    up = tw.SE3(np.eye(3), [0, 0, l / 2])
    for name, x in (("crank", 0.0), ("rocker", 0.5)):
        at = tw.SE3(np.eye(3), [x, 0, 0])
        builder.link(name, parent="base_link", joint=tw.Revolute("y"), inertia=rod.transform(up), placement=at)
    end = tw.SE3(np.eye(3), [0, 0, l])
    builder.link("coupler", parent="crank", joint=tw.Revolute("y"), inertia=bar, placement=end)
    builder.link("far", parent="coupler", placement=tw.SE3(np.eye(3), [0.5, 0, 0]))
    builder.link("tip", parent="rocker", placement=end)
    model = builder.build()
    q = np.zeros(3)
    for name, x in (("crank", angle), ("rocker", angle), ("coupler", -angle)):
        q[model.q_slice[model.joint_id(name)]] = x
    found = tw.contact_forward_dynamics(model, q, 0 * q, 0 * q, [tw.LoopClosure("far", "tip")])
    crank = model.v_slice[model.joint_id("crank")]
    right = G * np.sin(angle) * (m + coupler) / (l * (2 * m / 3 + coupler))
    return abs(float(found.qdd[crank][0]) / right - 1)


def mimic() -> float:
    """Compare a finger that follows another at −1.7 times its angle: beside M and h of Pinocchio, and q = G q′."""
    builder, n = tw.Builder("hand"), -1.7
    phalanx = tw.SpatialInertia(0.2, [0, 0.01, 0.04], np.diag([1e-4, 2e-4, 1.5e-4]))
    for name, parent in (("near", "base_link"), ("far", "near")):
        at = tw.SE3(np.eye(3), [0, 0, 0.05])
        builder.link(name, parent=parent, joint=tw.Revolute("x"), inertia=phalanx, placement=at)
    model = builder.build()
    q, v, tau = np.array([0.4, n * 0.4]), 2.0 * np.array([1, n]), np.array([0.03, 0.0])
    there, ratio = There(model), np.array([1, n])
    right = ratio @ (tau - there.rnea(q, v, 0 * v)) / (ratio @ there.crba(q) @ ratio)
    ours = tw.contact_forward_dynamics(model, q, v, tau, [tw.Coupling(model.joint_names[2], {model.joint_names[1]: n})])
    return off(ours.qdd, right * ratio)

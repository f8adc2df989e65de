"""The 3-D way against textbook formulas, against its own time derivatives, and with faults put in.

The models are made here from plain numbers, so that nothing of the package but §49.1 is used. Rates are
taken by complex steps along the motion: F(q + ih q̇, v + ih a).imag / h has no cancellation, so that the
tolerance can stay at 1e-12. `BATTERY` holds the physics; the last tests run it on copies of the source
with one line changed, each of which must fail.
"""

from __future__ import annotations

import importlib.util
import itertools
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from twistwrench import newton_euler_3d
from twistwrench.errors import ModelError, ShapeError, SingularError
from twistwrench.newton_euler_3d.arithmetic import Arithmetic
from twistwrench.newton_euler_3d.joints import joint_columns, joint_pose

TOLERANCE = 1e-12
SIZES = {"revolute": (1, 1), "prismatic": (1, 1), "continuous": (2, 1), "planar": (4, 3), "spherical": (4, 3)}
SIZES["free_flyer"] = (7, 6)
UNIT = {"continuous": slice(0, 2), "planar": slice(2, 4), "spherical": slice(0, 4), "free_flyer": slice(3, 7)}


# ---------------------------------------------------------------- models from plain numbers


def place(rotation=None, translation=(0.0, 0.0, 0.0)):
    return SimpleNamespace(rotation=np.eye(3) if rotation is None else rotation, translation=np.array(translation))


def link(parent, kind, axis=None, at=None, mass=0.0, com=(0.0, 0.0, 0.0), inertia=None, armature=0.0):
    return SimpleNamespace(**locals())


def joint(kind, axis):
    """Make what the package reads of a joint: S where there is one coordinate, the axis of a continuous joint."""
    (nq, nv), axis = SIZES[kind], (0.0, 0.0, 0.0) if axis is None else tuple(axis)
    column = {"revolute": [*axis, 0, 0, 0], "prismatic": [0, 0, 0, *axis]}.get(kind)
    return SimpleNamespace(
        kind=kind, axis=axis, nq=nq, nv=nv, unit=UNIT.get(kind), subspace=lambda dtype: np.array(column, dtype)[:, None]
    )


def make(*links, gravity=(0.0, 0.0, -9.81), frames=None):
    """Make what the package reads of a model."""
    sizes = [(0, 0), *(SIZES[x.kind] for x in links)]
    q_ends, v_ends = (np.cumsum([0, *column]).tolist() for column in zip(*sizes, strict=True))
    zero = np.zeros((3, 3))
    inertias = [(0.0, np.zeros(3), zero)]
    inertias += [(x.mass, np.array(x.com), zero if x.inertia is None else x.inertia) for x in links]
    return SimpleNamespace(
        nbodies=len(links) + 1,
        nq=q_ends[-1],
        nv=v_ends[-1],
        joints=(None, *(joint(x.kind, x.axis) for x in links)),
        joint_names=("universe", *(f"{x.kind}_{i}" for i, x in enumerate(links, 1))),
        parent=(-1, *(x.parent for x in links)),
        placement=(place(), *(x.at or place() for x in links)),
        inertia=tuple(SimpleNamespace(mass=m, com=c, inertia_at_com=I) for m, c, I in inertias),
        q_slice=tuple(slice(a, b) for a, b in itertools.pairwise(q_ends)),
        v_slice=tuple(slice(a, b) for a, b in itertools.pairwise(v_ends)),
        gravity=np.array(gravity),
        armature=np.concatenate([np.zeros(0), *(np.full(SIZES[x.kind][1], x.armature) for x in links)]),
        frames=frames or {},
    )


def random_rotation(rng):
    Q, R = np.linalg.qr(rng.standard_normal((3, 3)))
    Q = Q * np.sign(np.diag(R))
    return Q * np.linalg.det(Q)


def random_link(rng, parent, kind):
    A = rng.standard_normal((3, 3))
    axis = rng.standard_normal(3)
    return link(
        parent,
        kind,
        axis=axis / np.sqrt(axis @ axis),
        at=place(random_rotation(rng), rng.uniform(-0.5, 0.5, 3)),
        mass=rng.uniform(0.5, 2.0),
        com=rng.uniform(-0.3, 0.3, 3),
        inertia=A @ A.T * 0.02 + 0.02 * np.eye(3),
        armature=0.0 if kind == "free_flyer" else rng.uniform(0.05, 0.2),
    )


def zoo(rng):
    """A branching tree with every kind of joint, on moving carriers too."""
    kinds = ["free_flyer", "revolute", "prismatic", "planar", "spherical", "continuous", "revolute", "free_flyer"]
    parents = [0, 1, 2, 1, 4, 3, 5, 5]
    frames = {"tool": SimpleNamespace(body=7, placement=place(random_rotation(rng), rng.uniform(-0.5, 0.5, 3)))}
    return make(*map(random_link, itertools.repeat(rng), parents, kinds), gravity=(1.0, -2.0, -9.0), frames=frames)


def arm(rng):
    """A tree whose v is q̇, for which Lagrange's equations hold as they stand in the books."""
    kinds = ["revolute", "prismatic", "revolute", "revolute", "prismatic"]
    return make(*map(random_link, itertools.repeat(rng), [0, 1, 2, 2, 4], kinds), gravity=(1.0, -2.0, -9.0))


class Draw:
    """Random models and states from one seed, in doubles or, exact to all digits, in mpmath's numbers."""

    def __init__(self, seed, exact=False):
        self.rng = np.random.default_rng(seed)
        self.number = newton_euler_3d.as_mpmath if exact else np.asarray

    def state(self, model):
        q = self.number(self.rng.uniform(-1, 1, model.nq))
        for joint, at in zip(model.joints[1:], model.q_slice[1:], strict=True):
            if joint.kind in UNIT:
                part = q[at][UNIT[joint.kind]]
                part /= (part @ part) ** 0.5  # a view: in place
        v, a = self.rng.standard_normal((2, model.nv))
        return q, self.number(v), self.number(a)

    def wrenches(self, model):
        f_ext = self.rng.standard_normal((model.nbodies, 6)) * 5
        f_ext[0] = 0
        return f_ext


# ---------------------------------------------------------------- rates along the motion


def q_dot(model, q, v):
    """Return dq/dt, by formulas of their own: quaternion products, no rotation matrices."""
    out = []
    for joint, qs, vs in zip(model.joints[1:], model.q_slice[1:], model.v_slice[1:], strict=True):
        x, u = q[qs], v[vs]
        match joint.kind:
            case "revolute" | "prismatic":
                out.append(u)
            case "continuous":
                out.append(np.array([-x[1], x[0]]) * u)
            case "planar":
                c, s = x[2:]
                out.append(np.array([c * u[0] - s * u[1], s * u[0] + c * u[1], -s * u[2], c * u[2]]))
            case "spherical":
                out.append(quaternion_rate(x, u))
            case "free_flyer":
                out += [rotated(x[3:], u[3:]), quaternion_rate(x[3:], u[:3])]
    return np.concatenate(out)


def quaternion_rate(Q, omega):
    return np.append(Q[3] * omega + np.cross(Q[:3], omega), -Q[:3] @ omega) / 2


def rotated(Q, x):
    return x + 2 * np.cross(Q[:3], Q[3] * x + np.cross(Q[:3], x))


def rate(function, model, q, v, a):
    """Return d/dt of function(q, v) along the motion."""
    h = 1e-30
    stepped = np.asarray(function(q + 1j * h * q_dot(model, q, v), v + 1j * h * a))
    return np.array([x.imag for x in stepped.flat]).reshape(stepped.shape) / h


def times(matrices, vectors):
    """Return the product of each matrix with its vector, for any kind of number."""
    return (matrices * vectors[..., None, :]).sum(-1)


def error(got, want):
    """Return the largest difference relative to the largest entry (or to 1: what should vanish has no scale)."""
    got, want = np.atleast_1d(got), np.atleast_1d(want)
    return float(abs(got - want).max() / max(1.0, abs(want).max()))


# ---------------------------------------------------------------- the physics, for any copy of the package


def velocities_are_rates_of_placements(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    R, _ = ne.placements(model, q)
    moving = ne.motion(model, q, v, a)
    R_rate, p_rate = (rate(lambda q, v, k=k: ne.placements(model, q)[k], model, q, v, a) for k in (0, 1))
    turned = np.cross(moving.angular_velocity[:, None, :], R.mT).mT  # ω × each column
    return max(error(p_rate, moving.velocity), error(R_rate, turned))


def accelerations_are_rates_of_velocities(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    moving = ne.motion(model, q, v, a)
    omega_rate, velocity_rate = (rate(lambda q, v, k=k: ne.motion(model, q, v, a)[k], model, q, v, a) for k in (0, 1))
    return max(error(omega_rate, moving.angular_acceleration), error(velocity_rate, moving.acceleration))


def spatial_accelerations_are_rates_of_body_twists(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    twists = ne.body_twists(model, q, v)
    R, moving = ne.placements(model, q)[0], ne.motion(model, q, v, a)
    in_world = np.concatenate([times(R, twists[:, :3]), times(R, twists[:, 3:])], axis=1)
    return max(
        error(rate(lambda q, v: ne.body_twists(model, q, v), model, q, v, a), ne.body_accelerations(model, q, v, a)),
        error(in_world, np.concatenate([moving.angular_velocity, moving.velocity], axis=1)),
    )


def frame_jacobians_give_the_frame_s_velocity(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    R, p = ne.frame_placement(model, q, "tool")
    R_rate, p_rate = (rate(lambda q, v, k=k: ne.frame_placement(model, q, "tool")[k], model, q, v, a) for k in (0, 1))
    W = R_rate @ R.T
    omega = np.array([W[2, 1], W[0, 2], W[1, 0]])
    local, world, aligned = (
        ne.frame_jacobian(model, q, "tool", name) @ v for name in ("local", "world", "local_world_aligned")
    )
    return max(
        error(aligned, np.concatenate([omega, p_rate])),
        error(local, np.concatenate([R.T @ omega, R.T @ p_rate])),
        error(world, np.concatenate([omega, p_rate + np.cross(omega, -p)])),
    )


def frame_bias_is_the_rate_of_the_jacobian(ne, draw):
    model = zoo(draw.rng)
    q, v, _ = draw.state(model)
    errors = []
    for name in ("local", "world", "local_world_aligned"):
        bias = rate(lambda q, v, r=name: ne.frame_jacobian(model, q, "tool", r) @ v, model, q, v, 0 * v)
        errors.append(error(ne.frame_bias_acceleration(model, q, v, "tool", name), bias))
    return max(errors)


def inverse_dynamics_obeys_lagrange(ne, draw):
    model = arm(draw.rng)
    q, v, a = draw.state(model)

    def slope(energy):  # ∂/∂q, entry by entry
        return np.array([energy(q + 1e-30j * unit).imag / 1e-30 for unit in np.eye(model.nq)])

    # With T = vᵀM v / 2, d/dt ∂T/∂v is the rate of M v.
    momentum_rate = rate(lambda q, v: ne.mass_matrix(model, q) @ v, model, q, v, a)
    force = momentum_rate - slope(lambda q: ne.kinetic_energy(model, q, v))
    force = force + slope(lambda q: ne.potential_energy(model, q))
    return error(ne.inverse_dynamics(model, q, v, a), force)


def power_in_is_the_rate_of_energy(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    f_ext = draw.wrenches(model)
    power = ne.inverse_dynamics(model, q, v, a, f_ext) @ v + (f_ext * ne.body_twists(model, q, v)).sum()
    energy = rate(lambda q, v: ne.kinetic_energy(model, q, v) + ne.potential_energy(model, q), model, q, v, a)
    return error(power, energy)


def kinetic_energy_is_the_mass_matrix_s(ne, draw):
    model = zoo(draw.rng)
    q, v, _ = draw.state(model)
    gradient = [ne.kinetic_energy(model, q, v + 1e-30j * unit).imag / 1e-30 for unit in np.eye(model.nv)]
    M = ne.mass_matrix(model, q)
    return max(error(M, M.T), error(v @ M @ v / 2, ne.kinetic_energy(model, q, v)), error(gradient, M @ v))


def inverse_dynamics_is_linear_in_the_acceleration(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    h = ne.nonlinear_effects(model, q, v)
    return error(ne.mass_matrix(model, q) @ a + h, ne.inverse_dynamics(model, q, v, a))


def gravity_is_the_slope_of_the_potential(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    still = np.zeros(model.nv)
    return max(
        error(ne.gravity(model, q) @ v, rate(lambda q, v: ne.potential_energy(model, q), model, q, v, a)),
        error(ne.gravity(model, q), ne.nonlinear_effects(model, q, still)),
    )


def coriolis_matrix_is_half_of_the_mass_matrix_s_rate(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    C = ne.coriolis_matrix(model, q, v)
    return max(
        error(C @ v + ne.gravity(model, q), ne.nonlinear_effects(model, q, v)),
        error(C + C.T, rate(lambda q, v: ne.mass_matrix(model, q), model, q, v, a)),
    )


def forward_dynamics_undoes_inverse_dynamics(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    f_ext = draw.wrenches(model)
    return error(ne.forward_dynamics(model, q, v, ne.inverse_dynamics(model, q, v, a, f_ext), f_ext), a)


def momentum_changes_by_the_forces_from_outside(ne, draw):
    model = zoo(draw.rng)
    q, v, _ = draw.state(model)
    f_ext = draw.wrenches(model)
    tau = draw.rng.standard_normal(model.nv)
    tau[:6] = 0  # the motors push between bodies; the base is free
    a = ne.forward_dynamics(model, q, v, tau, f_ext)
    R, p = ne.placements(model, q)
    center, mass = ne.center_of_mass(model, q), sum(i.mass for i in model.inertia)
    force, moment = times(R, f_ext[:, 3:]), times(R, f_ext[:, :3])
    moment = moment + np.cross(p - center, force)
    # A rotor turns with its joint but its spin is not counted in the momentum, nor does it push back.
    outside = np.concatenate([moment.sum(0), force.sum(0) + mass * model.gravity])
    return error(ne.centroidal_momentum_rate(model, q, v, a), outside)


def momentum_is_what_its_map_gives(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    momentum = ne.centroidal_momentum(model, q, v)
    mass = draw.number([i.mass for i in model.inertia]).sum()
    com_rate = rate(lambda q, v: ne.center_of_mass(model, q), model, q, v, a)
    momentum_rate = rate(lambda q, v: ne.centroidal_momentum(model, q, v), model, q, v, a)
    return max(
        error(ne.centroidal_map(model, q) @ v, momentum),
        error(momentum[3:], mass * com_rate),
        error(ne.centroidal_momentum_rate(model, q, v, a), momentum_rate),
    )


def joints_transmit_what_their_motors_and_bearings_hold(ne, draw):
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    f_ext = draw.wrenches(model)
    wrenches = ne.joint_wrenches(model, q, v, a, f_ext)
    tau = ne.inverse_dynamics(model, q, v, a, f_ext)
    errors = [error(wrenches[1], tau[:6])]  # the free-flyer holds nothing by itself
    R, p = ne.placements(model, q)
    for i, joint in enumerate(model.joints):
        along = {"revolute": slice(0, 3), "continuous": slice(0, 3), "prismatic": slice(3, 6)}
        if joint and joint.kind in along:
            motor = (tau - model.armature * a)[model.v_slice[i]]
            errors.append(error(joint.axis @ wrenches[i][along[joint.kind]], motor))
        # The whole of it, bearing too, changes the momentum of what lies beyond the joint.
        beyond = [j for j in range(1, model.nbodies) if i in path_to_world(model, j)]
        cut = SimpleNamespace(**vars(model))
        cut.inertia = [x if j in beyond else model.inertia[0] for j, x in enumerate(model.inertia)]
        k_rate, l_rate = ne.centroidal_momentum_rate(cut, q, v, a).reshape(2, 3)
        force = l_rate - sum(x.mass for x in cut.inertia) * model.gravity
        moment = k_rate + np.cross(ne.center_of_mass(cut, q) - p[i], force)
        for j in beyond:
            push = R[j] @ f_ext[j, 3:]
            force, moment = force - push, moment - R[j] @ f_ext[j, :3] - np.cross(p[j] - p[i], push)
        errors.append(error(wrenches[i], np.concatenate([R[i].T @ moment, R[i].T @ force])))
    return max(errors)


def path_to_world(model, body):
    path = [body]
    while body > 0:
        body = model.parent[body]
        path.append(body)
    return path


def free_body_tumbles_by_euler(ne, draw):
    I = np.diag([0.3, 0.5, 0.7])
    model = make(link(0, "free_flyer", mass=2.0, inertia=I))
    q, v, a = draw.state(model)
    (w, u), (wd, ud) = v.reshape(2, 3), a.reshape(2, 3)
    g_body = rotated(q[3:] * [-1, -1, -1, 1], model.gravity)
    want = np.concatenate([I @ wd + np.cross(w, I @ w), 2.0 * (ud + np.cross(w, u) - g_body)])
    return error(ne.inverse_dynamics(model, q, v, a), want)


def bead_on_a_turning_wire_feels_coriolis(ne, draw):
    # A point mass at r on a wire that turns about z: m(r̈ − r θ̇²) along it, m(r² θ̈ + 2 r ṙ θ̇) about z.
    model = make(link(0, "revolute", axis=(0, 0, 1)), link(1, "prismatic", axis=(1, 0, 0), mass=1.5))
    q, v, a = draw.state(model)
    r, (w, rd), (wd, rdd) = q[1], v, a
    want = [1.5 * (r**2 * wd + 2 * r * rd * w), 1.5 * (rdd - r * w**2)]
    return error(ne.inverse_dynamics(model, q, v, a), want)


def double_pendulum(cos, sin, m1, m2, l1, l2, g, q, v, a):
    """Textbook equations of two point masses on rods, the second angle relative to the first."""
    c2, s2 = cos(q[1]), sin(q[1])
    m11 = (m1 + m2) * l1 * l1 + m2 * l2 * l2 + 2 * m2 * l1 * l2 * c2
    m12 = m2 * l2 * l2 + m2 * l1 * l2 * c2
    push = m2 * l1 * l2 * s2
    fall1, fall2 = g * (m1 + m2) * l1 * sin(q[0]), g * m2 * l2 * sin(q[0] + q[1])
    tau1 = m11 * a[0] + m12 * a[1] - push * (2 * v[0] * v[1] + v[1] * v[1]) + fall1 + fall2
    tau2 = m12 * a[0] + m2 * l2 * l2 * a[1] + push * v[0] * v[0] + fall2
    return np.array([tau1, tau2])


def double_pendulum_model(l1=0.7, l2=0.4, m1=1.3, m2=0.8):
    return make(
        link(0, "revolute", axis=(0, -1, 0), mass=m1, com=(0, 0, -l1)),
        link(1, "revolute", axis=(0, -1, 0), at=place(translation=(0, 0, -l1)), mass=m2, com=(0, 0, -l2)),
    )


def double_pendulum_obeys_the_textbook(ne, draw):
    model = double_pendulum_model()
    q, v, a = draw.state(model)
    want = double_pendulum(np.cos, np.sin, 1.3, 0.8, 0.7, 0.4, 9.81, q, v, a)
    return error(ne.inverse_dynamics(model, q, v, a), want)


def physical_pendulum_swings_with_its_period(ne, draw):
    # θ̈ = −m g l sin θ / (I + m l² + rotor)
    model = make(link(0, "continuous", axis=(1, 0, 0), mass=2.0, com=(0, 0, -0.6), inertia=np.eye(3) * 0.1))
    model.armature = np.array([0.05])
    angle = draw.rng.uniform(-3, 3)
    a = ne.forward_dynamics(model, [np.cos(angle), np.sin(angle)], draw.rng.standard_normal(1), [0.0])
    return error(a, [-2.0 * 9.81 * 0.6 * np.sin(angle) / (0.1 + 2.0 * 0.36 + 0.05)])


BATTERY = [
    double_pendulum_obeys_the_textbook,
    bead_on_a_turning_wire_feels_coriolis,
    free_body_tumbles_by_euler,
    physical_pendulum_swings_with_its_period,
    velocities_are_rates_of_placements,
    accelerations_are_rates_of_velocities,
    spatial_accelerations_are_rates_of_body_twists,
    frame_jacobians_give_the_frame_s_velocity,
    frame_bias_is_the_rate_of_the_jacobian,
    inverse_dynamics_obeys_lagrange,
    power_in_is_the_rate_of_energy,
    kinetic_energy_is_the_mass_matrix_s,
    inverse_dynamics_is_linear_in_the_acceleration,
    gravity_is_the_slope_of_the_potential,
    coriolis_matrix_is_half_of_the_mass_matrix_s_rate,
    forward_dynamics_undoes_inverse_dynamics,
    momentum_changes_by_the_forces_from_outside,
    momentum_is_what_its_map_gives,
    joints_transmit_what_their_motors_and_bearings_hold,
]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("law", BATTERY, ids=lambda law: law.__name__)
def test_physics(law, seed):
    assert law(newton_euler_3d, Draw(seed)) < TOLERANCE


# ---------------------------------------------------------------- faults put in

FAULTS = [
    # (1) lever arm of a velocity
    ("bodies", "velocity = self.velocity + cross(self.omega, r)", "velocity = self.velocity"),
    ("bodies", "velocity = self.velocity + cross(self.omega, r)", "velocity = self.velocity - cross(self.omega, r)"),
    ("bodies", "self.slide + cross(self.turn, point[:, None] - self.origin)", "self.slide"),
    ("bodies", "cross(self.turn, point[:, None] - self.origin)", "cross(self.turn, self.origin - point[:, None])"),
    # (2) centripetal
    ("bodies", " + cross(self.omega, cross(self.omega, r))  # (2)", ""),
    ("bodies", "+ cross(self.alpha, r) + ", "+ "),
    # (3) Coriolis
    ("bodies", "coriolis = 2 * cross(", "coriolis = cross("),
    ("bodies", "coriolis = 2 * cross(", "coriolis = -2 * cross("),
    # (4) vectors that turn along
    ("bodies", " + cross(carrier.omega, omega_joint)  # (4)", ""),
    ("bodies", " + cross(omega_joint, u)  # (4)", ""),
    ("bodies", "cross(self.omega, self.turn), cross(self.omega, self.slide)", "0 * self.turn, 0 * self.slide"),
    ("bodies", " + cross(turn_rate, arm)", ""),
    ("bodies", " + cross(self.turn, arm_rate)", ""),
    # (5) lever arm of a force
    ("forces", "moment_ext + cross(body.origin - body.com, force_ext)", "moment_ext"),
    ("forces", "cross(body.origin - body.com, force_ext)", "cross(body.com - body.origin, force_ext)"),
    ("forces", "moment + cross(bodies[i].com - bodies[j].origin, force)", "moment"),
    ("forces", "cross(bodies[i].com - bodies[j].origin, force)", "cross(bodies[j].origin - bodies[i].com, force)"),
    ("momentum", "body.inertia @ body.omega + cross(body.com - center, momentum)", "body.inertia @ body.omega"),
    ("momentum", "k = k + cross(body.com - center, momentum_rate)", "k = k"),
    ("momentum", "body.inertia @ Jw + cross(arm, momentum)", "body.inertia @ Jw"),
    # (6) gyroscopic
    ("forces", "I @ body.alpha + cross(w, I @ w)", "I @ body.alpha"),
    ("momentum", "I @ body.alpha + cross(w, I @ w)", "I @ body.alpha"),
    ("matrices", " + B_Jw)", ")"),
    ("matrices", "- I @ cross(w, Jw) ", ""),
    ("matrices", "- cross(I @ w, Jw)", "+ cross(I @ w, Jw)"),
    # the rest
    ("bodies", "R @ number.array(given.inertia_at_com) @ R.mT", "number.array(given.inertia_at_com)"),
    ("bodies", "p + R @ number.array(given.com)", "p + number.array(given.com)"),
    ("bodies", "carrier.rotation @ number.rotation(", "number.rotation("),
    ("bodies", "joint_frame @ p_joint", "p_joint"),
    ("joints", "[[x * 0, -z, y], [z, x * 0, -x], [-y, x, x * 0]]", "[[x * 0, z, -y], [-z, x * 0, x], [y, -x, x * 0]]"),
    ("arithmetic", "x, y, z, w = xyzw", "w, x, y, z = xyzw"),
    ("joints", "np.hstack([one, none]), np.hstack([none, one])", "np.hstack([none, one]), np.hstack([one, none])"),
    ("kinematics", "acceleration - cross(body.omega, velocity)", "acceleration"),
    ("frames", "return number.zeros(3), number.identity()", "return p, number.identity()"),
    ("frames", 'if reference == "local_world_aligned":', "if False:"),
    ("forces", "- state.number.array(state.model.gravity)", "+ state.number.array(state.model.gravity)"),
    ("forces", "tau = state.number.array(state.model.armature) * state.a", "tau = 0 * state.a"),
    ("forces", "return force - force_ext, moment - moment_ext", "return force + force_ext, moment + moment_ext"),
    ("matrices", "state.tau - virtual_power", "state.tau + virtual_power"),
    ("matrices", "np.diag(state.model.armature)", "0 * np.diag(state.model.armature)"),
    ("matrices", "body.mass * (Jv.mT @ Jv) + ", ""),
    ("momentum", "energy - body.mass", "energy + body.mass"),
]


def altered(folder: Path, module: str, line: str, fault: str) -> ModuleType:
    """Import a copy of the package with one piece of one module replaced."""
    source = Path(newton_euler_3d.__file__).parent
    for file in source.glob("*.py"):
        text = file.read_text(encoding="utf-8")
        if file.stem == module:
            assert text.count(line) == 1, f"{line!r} stands {text.count(line)} times in {file.name}"
            text = text.replace(line, fault)
        (folder / file.name).write_text(text.replace("from ..", "from twistwrench."), encoding="utf-8")
    spec: Any = importlib.util.spec_from_file_location("altered", folder / "__init__.py")
    package = importlib.util.module_from_spec(spec)
    sys.modules["altered"] = package
    spec.loader.exec_module(package)
    return package


@pytest.fixture
def _forget_altered():
    yield
    for name in [name for name in sys.modules if name.partition(".")[0] == "altered"]:
        del sys.modules[name]


def broken(law, package, draw):
    try:
        return law(package, draw) > 1e-3
    except SingularError:
        return True


@pytest.mark.usefixtures("_forget_altered")
@pytest.mark.parametrize(("module", "line", "fault"), FAULTS)
def test_a_wrong_term_breaks_the_physics(tmp_path, module, line, fault):
    package = altered(tmp_path, module, line, fault)
    assert any(broken(law, package, Draw(0)) for law in BATTERY)


@pytest.mark.usefixtures("_forget_altered")
def test_a_copy_without_a_fault_keeps_the_physics(tmp_path):
    package = altered(tmp_path, "none", "", "")
    assert not any(broken(law, package, Draw(0)) for law in BATTERY)


# ---------------------------------------------------------------- fifty digits

EXACT_LAWS = [
    velocities_are_rates_of_placements,
    accelerations_are_rates_of_velocities,
    frame_bias_is_the_rate_of_the_jacobian,
    power_in_is_the_rate_of_energy,
    coriolis_matrix_is_half_of_the_mass_matrix_s_rate,
    forward_dynamics_undoes_inverse_dynamics,
    momentum_is_what_its_map_gives,
]


@pytest.fixture
def mpmath():
    package = pytest.importorskip("mpmath", reason="mpmath is not installed: fifty digits are skipped")
    with package.workdps(50):
        yield package


@pytest.mark.parametrize("law", EXACT_LAWS, ids=lambda law: law.__name__)
@pytest.mark.usefixtures("mpmath")
def test_physics_holds_in_fifty_digits(law):
    assert law(newton_euler_3d, Draw(1, exact=True)) < 1e-46  # 1e-50 times the growth through nine bodies


LEAKS = [
    ("self.context.cos(x)", "self.context.cos(x) * (1 + 2**-52)"),
    ("self.context.sin(x)", "self.context.sin(x) * (1 + 2**-52)"),
    ("self.context.sqrt(x)", "self.context.sqrt(x) * (1 + 2**-52)"),
]


@pytest.mark.usefixtures("mpmath", "_forget_altered")
@pytest.mark.parametrize(("line", "fault"), LEAKS)
def test_an_error_of_one_rounding_of_a_double_is_seen(tmp_path, line, fault):
    package = altered(tmp_path, "arithmetic", line, fault)
    assert any(law(package, Draw(1, exact=True)) > 1e-20 for law in EXACT_LAWS)


def test_double_pendulum_obeys_the_textbook_in_fifty_digits(mpmath):
    q, v, a = (newton_euler_3d.as_mpmath(x) for x in ([0.3, -1.1], [2.0, 0.7], [-0.4, 1.9]))
    constants = newton_euler_3d.as_mpmath([1.3, 0.8, 0.7, 0.4, 9.81])
    want = double_pendulum(mpmath.cos, mpmath.sin, *constants, q, v, a)
    assert error(newton_euler_3d.inverse_dynamics(double_pendulum_model(), q, v, a), want) < 1e-48


def test_an_oblique_axis_is_of_length_one_to_the_last_digit(mpmath):
    # A point mass on an oblique axis: the moment of its weight about it, the axis divided by its length here.
    given, c = np.array([1.0, 2.0, 2.5]) / np.sqrt(11.25), (0.3, -0.2, 0.1)
    model = make(link(0, "revolute", axis=given, mass=1.7, com=c))
    n, c = newton_euler_3d.as_mpmath(given), newton_euler_3d.as_mpmath(c)
    assert n @ n != 1  # in doubles it cannot be had
    n = n / mpmath.sqrt(n @ n)
    angle = mpmath.mpf("0.9")
    turned = c * mpmath.cos(angle) + np.cross(n, c) * mpmath.sin(angle) + n * (n @ c) * (1 - mpmath.cos(angle))
    moment = -n @ np.cross(turned, mpmath.mpf(1.7) * newton_euler_3d.as_mpmath([0, 0, -9.81]))
    assert error(newton_euler_3d.gravity(model, [angle]), [moment]) < 1e-48


def test_rotations_are_orthonormal_to_the_last_digit(mpmath):
    model = zoo(np.random.default_rng(0))
    q, _, _ = Draw(0).state(model)  # quaternions of length 1 to double precision only
    R = newton_euler_3d.placements(model, newton_euler_3d.as_mpmath(q))[0]
    assert error(R.mT @ R, np.broadcast_to(np.eye(3), R.shape)) < 1e-48
    R_double = newton_euler_3d.placements(model, q)[0]
    assert 0 < error(R_double.mT @ R_double, np.broadcast_to(np.eye(3), R.shape)) < 1e-14


QUANTITIES = {
    "placements": lambda ne, m, q, v, a, tau, f: np.concatenate([x.ravel() for x in ne.placements(m, q)]),
    "motion": lambda ne, m, q, v, a, tau, f: np.stack(ne.motion(m, q, v, a)),
    "body_twists": lambda ne, m, q, v, a, tau, f: ne.body_twists(m, q, v),
    "body_accelerations": lambda ne, m, q, v, a, tau, f: ne.body_accelerations(m, q, v, a),
    "frame_placement": lambda ne, m, q, v, a, tau, f: ne.frame_placement(m, q, "tool")[1],
    "frame_jacobian": lambda ne, m, q, v, a, tau, f: ne.frame_jacobian(m, q, "tool", "world"),
    "frame_bias": lambda ne, m, q, v, a, tau, f: ne.frame_bias_acceleration(m, q, v, "tool"),
    "inverse_dynamics": lambda ne, m, q, v, a, tau, f: ne.inverse_dynamics(m, q, v, a, f),
    "nonlinear_effects": lambda ne, m, q, v, a, tau, f: ne.nonlinear_effects(m, q, v),
    "gravity": lambda ne, m, q, v, a, tau, f: ne.gravity(m, q),
    "joint_wrenches": lambda ne, m, q, v, a, tau, f: ne.joint_wrenches(m, q, v, a, f),
    "mass_matrix": lambda ne, m, q, v, a, tau, f: ne.mass_matrix(m, q),
    "coriolis_matrix": lambda ne, m, q, v, a, tau, f: ne.coriolis_matrix(m, q, v),
    "forward_dynamics": lambda ne, m, q, v, a, tau, f: ne.forward_dynamics(m, q, v, tau, f),
    "center_of_mass": lambda ne, m, q, v, a, tau, f: ne.center_of_mass(m, q),
    "centroidal_map": lambda ne, m, q, v, a, tau, f: ne.centroidal_map(m, q),
    "centroidal_momentum": lambda ne, m, q, v, a, tau, f: ne.centroidal_momentum(m, q, v),
    "centroidal_momentum_rate": lambda ne, m, q, v, a, tau, f: ne.centroidal_momentum_rate(m, q, v, a),
    "kinetic_energy": lambda ne, m, q, v, a, tau, f: ne.kinetic_energy(m, q, v),
    "potential_energy": lambda ne, m, q, v, a, tau, f: ne.potential_energy(m, q),
}


def arguments():
    draw = Draw(2)
    model = zoo(draw.rng)
    q, v, a = draw.state(model)
    return model, q, v, a, draw.rng.standard_normal(model.nv), draw.wrenches(model)


@pytest.mark.parametrize("name", QUANTITIES)
def test_more_digits_only_add_digits(mpmath, name):
    model, *state = arguments()

    def result(digits):
        with mpmath.workdps(digits):
            return np.asarray(QUANTITIES[name](newton_euler_3d, model, *map(newton_euler_3d.as_mpmath, state)))

    fifty, eighty = result(50), result(80)
    assert all(isinstance(x, mpmath.mpf) for x in fifty.flat)  # no plain zero was left over
    with mpmath.workdps(80):
        assert error(fifty, eighty) < 1e-48
        assert error(eighty, eighty.astype(float)) < 1e-15
    double = QUANTITIES[name](newton_euler_3d, model, *state)
    assert error(double, fifty) < TOLERANCE


# ---------------------------------------------------------------- kinds of numbers


@pytest.mark.parametrize("name", QUANTITIES)
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, np.complex64, np.clongdouble])
def test_the_kind_of_number_is_kept(name, dtype):
    model, *state = arguments()
    want = np.asarray(QUANTITIES[name](newton_euler_3d, model, *state))
    got = np.asarray(QUANTITIES[name](newton_euler_3d, model, *(x.astype(dtype) for x in state)))
    assert got.dtype == dtype
    assert error(got, want) < (1e-4 if np.finfo(dtype).eps > 1e-10 else TOLERANCE)


def test_the_widest_kind_of_number_wins(mpmath):
    model, q, v, a, _, _ = arguments()
    assert newton_euler_3d.inverse_dynamics(model, q.astype(np.float32), v, a).dtype == np.float64
    mixed = newton_euler_3d.inverse_dynamics(model, q, v, list(newton_euler_3d.as_mpmath(a)))
    assert isinstance(mixed[0], mpmath.mpf)


def test_integers_are_numbers():
    model = make(link(0, "prismatic", axis=(0, 0, 1), mass=2.0))
    assert newton_euler_3d.inverse_dynamics(model, [1], [0], [1]) == pytest.approx([2 * (9.81 + 1)], rel=TOLERANCE)


def test_the_length_of_a_quaternion_does_not_matter():
    model, q, *_ = arguments()
    longer = q.copy()
    for joint, at in zip(model.joints[1:], model.q_slice[1:], strict=True):
        if joint.kind in UNIT:
            longer[at][UNIT[joint.kind]] *= 1e-200
    assert error(newton_euler_3d.mass_matrix(model, longer), newton_euler_3d.mass_matrix(model, q)) < TOLERANCE


@pytest.mark.parametrize("name", QUANTITIES)
def test_arguments_are_left_as_they_are(name):
    model, *state = arguments()
    copies = [x.copy() for x in state]
    for x in state:
        x.flags.writeable = False
    QUANTITIES[name](newton_euler_3d, model, *state)
    assert all((x == y).all() for x, y in zip(state, copies, strict=True))


def test_wrenches_and_rotors_change_the_answer():
    model, q, v, a, tau, f_ext = arguments()
    ne = newton_euler_3d
    for function, last in ((ne.inverse_dynamics, a), (ne.joint_wrenches, a), (ne.forward_dynamics, tau)):
        assert error(function(model, q, v, last, f_ext), function(model, q, v, last)) > 1e-2
    rigid = SimpleNamespace(**vars(model))
    rigid.armature = 0 * model.armature
    difference = ne.inverse_dynamics(model, q, v, a) - ne.inverse_dynamics(rigid, q, v, a)
    assert error(difference, model.armature * a) < TOLERANCE
    assert error(ne.joint_wrenches(model, q, v, a), ne.joint_wrenches(rigid, q, v, a)) == 0
    spin = ne.kinetic_energy(model, q, v) - ne.kinetic_energy(rigid, q, v)
    assert error(spin, (model.armature * v**2).sum() / 2) < TOLERANCE


# ---------------------------------------------------------------- what cannot be


def test_a_wrong_length_says_what_was_meant():
    model, q, v, a, tau, f_ext = arguments()
    ne = newton_euler_3d
    with pytest.raises(ShapeError, match=r"q: expected shape \(27,\), got \(22,\); this looks like nv; q has nq = 27"):
        ne.mass_matrix(model, v)
    for name, call in {
        "v": lambda: ne.nonlinear_effects(model, q, q),
        "a": lambda: ne.inverse_dynamics(model, q, v, q),
        "tau": lambda: ne.forward_dynamics(model, q, v, q),
    }.items():
        with pytest.raises(ShapeError, match=rf"{name}: .*this looks like nq; {name} has nv = 22"):
            call()
    with pytest.raises(ShapeError, match=r"q: .*got \(3, 27\).*one state per call: loop over a batch"):
        ne.gravity(model, np.stack([q] * 3))
    with pytest.raises(ShapeError, match=r"f_ext: .*got \(2, 9, 6\).*loop over a batch"):
        ne.inverse_dynamics(model, q, v, a, np.stack([f_ext] * 2))
    with pytest.raises(ShapeError, match=r"f_ext: expected shape \(9, 6\), got \(8, 6\)$"):
        ne.forward_dynamics(model, q, v, tau, f_ext[1:])
    with pytest.raises(ShapeError, match="v: expected a rectangular array"):
        ne.nonlinear_effects(model, q, [[1.0], [1.0, 2.0]])


def test_what_is_no_number_is_refused(mpmath):
    model = make(link(0, "prismatic", axis=(0, 0, 1), mass=2.0))
    for bad in ([np.nan], [mpmath.inf], [mpmath.nan], [mpmath.mpc(0, mpmath.inf)]):
        with pytest.raises(ValueError, match=r"q: .*finite"):
            newton_euler_3d.gravity(model, bad)
    with pytest.raises(ValueError, match="v: expected numbers"):
        newton_euler_3d.nonlinear_effects(model, [mpmath.mpf(1)], [None])
    with pytest.raises(ValueError, match="q: expected numbers"):
        newton_euler_3d.gravity(model, ["high"])
    with pytest.raises(ValueError, match="q: expected numbers, got a masked array"):
        newton_euler_3d.gravity(model, np.ma.array([0.5], mask=[True]))


def test_a_wrench_on_the_world_is_refused():
    model, q, v, a, _, f_ext = arguments()
    f_ext[0, 5] = 1.0
    with pytest.raises(ValueError, match="f_ext: row 0 is the world's"):
        newton_euler_3d.inverse_dynamics(model, q, v, a, f_ext)


@pytest.mark.parametrize("kind", UNIT)
def test_a_quaternion_of_zeros_has_no_direction(kind):
    model = make(link(0, kind, axis=(0, 0, 1), mass=1.0))
    what = "quaternion" if SIZES[kind][1] != 1 and kind != "planar" else r"\(cos, sin\)"
    with pytest.raises(ValueError, match=f"{kind}_1.*{what} is zero"):
        newton_euler_3d.gravity(model, np.zeros(model.nq))


def test_unknown_frames_and_references_list_the_known():
    model, q, *_ = arguments()
    with pytest.raises(KeyError, match=r"unknown frame 'tol'; did you mean 'tool'\?"):
        newton_euler_3d.frame_placement(model, q, "tol")
    with pytest.raises(KeyError, match="did you mean 'local_world_aligned'"):
        newton_euler_3d.frame_jacobian(model, q, "tool", "world_aligned")


def test_a_placement_that_is_no_rotation_is_refused():
    model = make(link(0, "revolute", axis=(0, 0, 1), at=place(rotation=1.1 * np.eye(3))))
    with pytest.raises(ModelError, match=r"revolute_1: its placement is not a rotation, .* 0\.21"):
        newton_euler_3d.placements(model, [0.0])


def test_an_unknown_kind_of_joint_is_refused():
    model = make(link(0, "planar"))
    model.joints[1].kind = "sledge"
    with pytest.raises(ModelError, match="joint 'planar_1': unknown kind 'sledge'"):
        newton_euler_3d.placements(model, [0.0, 0.0, 1.0, 0.0])
    with pytest.raises(ModelError, match="joint 'planar_1': unknown kind 'sledge'"):
        joint_columns(Arithmetic(np.dtype(float)), model.joints[1], "planar_1")


def test_a_joint_with_one_coordinate_is_the_screw_that_its_S_says():
    """A turn about an axis beside the origin, with a pitch and at twice the rate, after q = 0.4: by hand."""
    w, point, pitch = np.array([0, 0, 2.0]), np.array([0.5, 0, 0]), 0.3
    S = np.concatenate([w, pitch * w - np.cross(w, point)])
    screw = SimpleNamespace(kind="of nobody", nq=1, nv=1, unit=None, subspace=lambda dtype: S.astype(dtype)[:, None])
    R, p = joint_pose(Arithmetic(np.dtype(float)), screw, np.array([0.4]), "screw")
    c, s = np.cos(0.8), np.sin(0.8)
    assert np.allclose(R, [[c, -s, 0], [s, c, 0], [0, 0, 1]], rtol=0, atol=1e-15)
    assert np.allclose(p, [0.5 - 0.5 * c, -0.5 * s, 0.3 * 0.8], rtol=0, atol=1e-15)
    turn, slide = joint_columns(Arithmetic(np.dtype(float)), screw, "screw")
    assert (np.concatenate([turn, slide])[:, 0] == S).all()


def test_joints_that_move_no_inertia_are_named(mpmath):
    # Two massless joints at the tip; the weightless one before the massive body is no trouble.
    links = [("prismatic", 1.0), ("revolute", 0.0), ("spherical", 1.0), ("prismatic", 0.0), ("revolute", 0.0)]
    parents = [0, 1, 2, 2, 4]
    model = make(
        *(
            link(p, kind, axis=(0, 0.6, 0.8), mass=m, inertia=m * np.eye(3), at=place(translation=(0.3, 0, 0)))
            for (kind, m), p in zip(links, parents, strict=True)
        )
    )
    q, v, a = Draw(0).state(model)
    for number in (np.asarray, newton_euler_3d.as_mpmath):
        with pytest.raises(SingularError, match="joints 'prismatic_4', 'revolute_5'"):
            newton_euler_3d.forward_dynamics(model, number(q), v, a)
    assert np.isfinite(newton_euler_3d.inverse_dynamics(model, q, v, a)).all()


def test_without_mass_there_is_no_centre_of_mass():
    model = make(link(0, "revolute", axis=(0, 0, 1), inertia=np.eye(3)))
    for function in (newton_euler_3d.center_of_mass, newton_euler_3d.centroidal_map):
        with pytest.raises(SingularError, match="nothing that moves has mass"):
            function(model, [0.0])


def test_a_model_that_cannot_move_is_one_as_well():
    empty = make()
    nothing = np.zeros(0)
    assert newton_euler_3d.inverse_dynamics(empty, nothing, nothing, nothing).shape == (0,)
    assert newton_euler_3d.mass_matrix(empty, nothing).shape == (0, 0)
    assert newton_euler_3d.forward_dynamics(empty, nothing, nothing, nothing).shape == (0,)
    assert newton_euler_3d.kinetic_energy(empty, nothing, nothing) == 0

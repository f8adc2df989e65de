"""The right values of a cell, to fifty digits, and the sizes that errors are relative to.

All of it comes from `newton_euler_3d`, which shares no formula with the functions that are measured. Every error is
free of units: the same robot in millimetres and grams has the same. And each is measured against the terms of a sum,
not the sum, so that an entry that cancels to zero is not called wrong in all its digits.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench import newton_euler_3d as ne
from twistwrench.arrays import Array
from twistwrench.newton_euler_3d.bodies import Body, bodies_in_world
from twistwrench.newton_euler_3d.forces import virtual_power
from twistwrench.newton_euler_3d.state import take

from ..numbers import as_long_double
from .robots import State

WHOLE = 40  # of a robot with more bodies only some columns of M are compared: all of them would take hours
COLUMNS = (0, 5, 6, -1)  # these: two of the base, the first joint, the last
ENOUGH = 1e-25  # the last correction of q̈, relative to its size, at which it counts as known


@dataclass(frozen=True)
class Truth:
    """Right values as mpmath numbers, and the sizes that an error in each entry is divided by.

    By name: ``tau``, torques of the motion; ``steered``, accelerations under these torques, rounded to doubles;
    ``pushed``, under torques of any sign and as large as the terms of these; None where there is no right value; ``M``,
    (columns of) the mass matrix; ``A_G``, the centroidal map; ``bias``, J̇v of the last body's frame.
    """

    right: dict[str, Array | None]
    sizes: dict[str, Any]
    torques: dict[str, Array]  # ``steered`` and ``pushed``, as doubles

    def error(self, name: str, answer: Array) -> float:
        """Return the largest relative error of finite numbers; infinite where there is no right value."""
        right, size = self.right[name], self.sizes[name]
        if right is None:
            return np.inf
        if answer.shape != right.shape:  # of M, some columns
            answer, size = answer[:, list(COLUMNS)], size[:, list(COLUMNS)]
        off = abs(ne.as_mpmath(answer) - right).astype(np.float64)
        nothing = size == 0  # and so is the right value, to the last bit
        return float(np.where(nothing, np.where(off == 0, 0.0, np.inf), off / np.where(nothing, 1, size)).max())


def truth(model: tw.Model, s: State) -> Truth:
    """Return the right values, in ``mpmath.mp.dps`` digits."""
    exact = State(*(ne.as_mpmath(x) for x in s))
    given = take(model, q=exact.q, v=exact.v, a=exact.a)
    bodies = bodies_in_world(given)
    tau = virtual_power(given, bodies)
    terms, own, momentum = sizes(model, bodies, s)
    drives = np.random.default_rng(1).standard_normal(model.nv)
    torques = {"steered": tau.astype(np.float64), "pushed": drives * terms}
    qdd = {name: accelerations(model, s, x) for name, x in torques.items()}
    weight = np.sqrt(own)
    right = {
        "tau": tau,
        "M": mass_matrix(model, exact.q),
        "A_G": ne.centroidal_map(model, exact.q),
        "bias": ne.frame_bias_acceleration(model, exact.q, exact.v, model.frame_names[-1], "local_world_aligned"),
    }
    known = {"tau": terms, "M": weight[:, None] * weight, "A_G": momentum, "bias": _size_of_bias(bodies[-1], s.v)}
    of_qdd = {name: _size_of_accelerations(model, s, x, qdd[name], weight) for name, x in torques.items()}
    return Truth(right | qdd, known | of_qdd, torques)


def mass_matrix(model: tw.Model, q: Array) -> Array:
    """Return M; of a long robot those `COLUMNS`, each the torques of a unit acceleration without weight."""
    if model.nbodies <= WHOLE:
        return ne.mass_matrix(model, q)
    light, zero = replace(model, gravity=np.zeros(3)), 0 * q[:1].repeat(model.nv)
    return np.stack([ne.inverse_dynamics(light, q, zero, ne.as_mpmath(e)) for e in np.eye(model.nv)[list(COLUMNS)]], 1)


def accelerations(model: tw.Model, s: State, torques: Array) -> Array | None:
    """Return the q̈ at which inverse dynamics returns exactly these torques, or None where M is singular.

    Newton's method: the residual of the torques is solved for with M in long doubles, and each step gains as many
    digits as these hold. The result depends on the torques alone.
    """
    q, v, tau = (ne.as_mpmath(x) for x in (s.q, s.v, torques))
    qdd, last = 0 * tau, np.inf
    while True:
        try:
            step = _divided(model, s.q, tau - ne.inverse_dynamics(model, q, v, qdd))
        except tw.SingularError:
            break
        qdd = qdd + step
        now = float(abs(step).max() / abs(qdd).max()) if qdd.any() else 0.0
        if now < ENOUGH:
            return qdd
        if not now < last / 4:
            break
        last = now
    try:
        return ne.forward_dynamics(model, q, v, tau)
    except tw.SingularError:
        return None


def _divided(model: tw.Model, q: Array, tau: Array) -> Array:
    """Return M⁻¹ τ to a few digits, of mpmath numbers."""
    unit = abs(tau).max()
    if unit == 0:
        return tau
    light, zero = replace(model, gravity=np.zeros(3)), np.zeros(model.nv, np.longdouble)
    q = model.normalize(q.astype(np.longdouble))
    step: Array = ne.as_mpmath(tw.aba(light, q, zero, as_long_double(tau / unit))) * unit
    return step


def _size_of_accelerations(model: tw.Model, s: State, torques: Array, qdd: Array | None, weight: Array) -> Any:
    """Return the sizes of the entries of q̈, such that each counts by the root of the inertia of its joint.

    The largest of three: of this q̈, of that without torques, and of their difference.
    """
    if qdd is None:
        return None
    try:
        falling = ne.as_mpmath(tw.aba(model, model.normalize(s.q.astype(np.longdouble)), s.v, 0 * torques))
    except tw.SingularError:
        falling = 0 * qdd
    return size_of_accelerations(qdd, falling, weight)


def size_of_accelerations(qdd: Array, falling: Array, weight: Array) -> Array:
    """Return the sizes of the entries of q̈, shape (..., nv), each weighed by the root of its joint's inertia."""
    weighed = np.stack([weight * abs(x) for x in (qdd, falling, qdd - falling)]).astype(np.float64)
    size: Array = weighed.max(axis=(0, -1))[..., None] / np.where(weight > 0, weight, 1)
    return size


def sizes(model: tw.Model, bodies: list[Body], s: State) -> tuple[Array, Array, Array]:
    """Return for each entry of v: the size of the terms of τ, its own inertia, the sizes of its column of A_G.

    τ_k is a sum over bodies, of ∂ċ/∂v_k · m (c̈ − g) + ∂ω/∂v_k · (I α + ω × I ω): here every vector is replaced by its
    length. The momentum of rate k is at most √(m M_kk) and √(J M_kk), with mass m and polar inertia J of what it moves.
    """
    tau, own = model.armature * abs(s.a), model.armature.copy()
    mass, polar = np.zeros(model.nv), np.zeros(model.nv)
    gravity, whole = _length(model.gravity), sum(b.mass for b in bodies)
    center = sum(b.mass * b.com for b in bodies) / whole if whole else bodies[0].com
    for body in bodies[1:]:
        k, m = body.hinges.index, float(body.mass)
        Jw, Jv = (_length(J.astype(np.float64)) for J in body.hinges.jacobian(body.com))
        I, w, alpha = (x.astype(np.float64) for x in (body.inertia, body.omega, body.alpha))
        force = m * (_length(body.at(body.com)[1].astype(np.float64)) + gravity)
        tau[k] += Jv * force + Jw * (_length(I @ alpha) + _length(w) * _length(I @ w))
        own[k] += m * Jv**2 + np.trace(I) * Jw**2
        mass[k] += m
        polar[k] += m * _length((body.com - center).astype(np.float64)) ** 2 + np.trace(I)
    return tau, own, np.sqrt(np.stack([polar] * 3 + [mass] * 3) * own)


def _size_of_bias(body: Body, v: Array) -> Array:
    """Return the sizes of the terms of J̇v at a body's origin: of the three angular entries, and of the linear ones."""
    at = body.hinges
    arms, rates = body.origin[:, None] - at.origin, body.velocity[:, None] - at.velocity
    parts = at.turn, at.slide, at.omega, arms, rates
    turn, slide, omega, arm, rate = (_length(x.astype(np.float64)) for x in parts)
    rates = abs(v[at.index])
    angular = (omega * turn * rates).sum()
    linear = ((omega * (slide + turn * arm) + turn * rate) * rates).sum()
    return np.repeat([angular, linear], 3)


def _length(x: Array) -> Any:
    """Return the lengths of columns."""
    return np.hypot.reduce(x, axis=0)

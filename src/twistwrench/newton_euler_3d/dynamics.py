"""Forces and accelerations by D'Alembert's principle (49.1, 49.6-49.9)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array
from ..errors import SingularError
from .arithmetic import Arithmetic, take
from .bodies import Body, cross, walk

__all__ = [
    "coriolis_matrix",
    "forward_dynamics",
    "gravity",
    "inverse_dynamics",
    "joint_wrenches",
    "mass_matrix",
    "nonlinear_effects",
]


def inverse_dynamics(
    model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None
) -> Array:
    """Return the generalised forces that a motion takes."""
    number, q, v, a, f_ext = take(model, q=q, v=v, a=a, f_ext=f_ext)
    return _virtual_power(number, model, q, v, a, f_ext)


def nonlinear_effects(model: Any, q: ArrayLike, v: ArrayLike) -> Array:
    """Return h(q, v): the generalised forces where a = 0."""
    number, q, v, a, f_ext = take(model, q=q, v=v, a=None, f_ext=None)
    return _virtual_power(number, model, q, v, a, f_ext)


def gravity(model: Any, q: ArrayLike) -> Array:
    """Return g(q): the generalised forces that hold the robot still."""
    number, q, v, a, f_ext = take(model, q=q, v=None, a=None, f_ext=None)
    return _virtual_power(number, model, q, v, a, f_ext)


def joint_wrenches(
    model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None
) -> Array:
    """Return the wrench that each joint transmits to the body it moves."""
    number, q, v, a, f_ext = take(model, q=q, v=v, a=a, f_ext=f_ext)
    bodies = walk(number, model, q, v, a)
    wrenches = number.zeros(model.nbodies, 6)
    for i in range(1, model.nbodies):
        force, moment = _required(number, model, bodies[i], f_ext[i])
        j = i
        while j > 0:  # every joint between this body and the world transmits it
            at_origin = moment + cross(bodies[i].com - bodies[j].origin, force)  # lever arm
            wrenches[j] += np.concatenate([bodies[j].rotation.T @ at_origin, bodies[j].rotation.T @ force])
            j = model.parent[j]
    return wrenches


def mass_matrix(model: Any, q: ArrayLike) -> Array:
    """Return M(q), column by column of each body's Jacobians."""
    number, q, rest = take(model, q=q, v=None)
    M = np.diag(number.array(model.armature))
    if number.context is not None:
        M = number.array(M)
    for body in walk(number, model, q, rest, rest)[1:]:
        Jw, Jv = body.jacobian(body.com)
        M[np.ix_(body.index, body.index)] += body.mass * (Jv.T @ Jv) + Jw.T @ body.inertia @ Jw
    return M


def coriolis_matrix(model: Any, q: ArrayLike, v: ArrayLike) -> Array:
    """Return C(q, v) with C v + g = h and Ṁ − 2C skew-symmetric."""
    number, q, v, rest = take(model, q=q, v=v, a=None)
    C = number.zeros(model.nv, model.nv)
    for body in walk(number, model, q, v, rest)[1:]:
        I, w = body.inertia, body.omega
        Jw, Jv = body.jacobian(body.com)
        Jw_rate, Jv_rate = body.jacobian_rate(body.com, body.com_velocity)
        gyroscopic = (cross(w, I @ Jw) - I @ cross(w, Jw) - cross(I @ w, Jw)) / 2
        C[np.ix_(body.index, body.index)] += body.mass * (Jv.T @ Jv_rate) + Jw.T @ (I @ Jw_rate + gyroscopic)
    return C


def forward_dynamics(
    model: Any, q: ArrayLike, v: ArrayLike, tau: ArrayLike, f_ext: ArrayLike | None = None
) -> Array:
    """Return the acceleration that generalised forces cause."""
    number, q, v, a, tau, f_ext = take(model, q=q, v=v, a=None, tau=tau, f_ext=f_ext)
    h = _virtual_power(number, model, q, v, a, f_ext)
    return _solve(number, model, mass_matrix(model, number.array(q)), tau - h)


def _virtual_power(number: Arithmetic, model: Any, q: Array, v: Array, a: Array, f_ext: Array) -> Array:
    tau = number.array(model.armature) * a
    bodies = walk(number, model, q, v, a)
    for i in range(1, model.nbodies):
        force, moment = _required(number, model, bodies[i], f_ext[i])
        Jw, Jv = bodies[i].jacobian(bodies[i].com)
        tau[bodies[i].index] += Jv.T @ force + Jw.T @ moment
    return tau


def _required(number: Arithmetic, model: Any, body: Body, f_ext: Array) -> tuple[Array, Array]:
    """Return force and moment about the centre of mass that a body needs beyond gravity and `f_ext`."""
    moment_ext, force_ext = body.rotation @ f_ext[:3], body.rotation @ f_ext[3:]
    force = body.mass * (body.com_acceleration - number.array(model.gravity)) - force_ext
    spin = body.inertia @ body.alpha + cross(body.omega, body.inertia @ body.omega)  # Euler
    moment = spin - moment_ext - cross(body.origin - body.com, force_ext)  # lever arm
    return force, moment


def _solve(number: Arithmetic, model: Any, M: Array, b: Array) -> Array:
    """Solve M x = b for a symmetric positive definite M, eliminating from the tips to the base."""
    n = len(b)
    M, x, share = M.copy(), b.copy(), number.zeros(n, n)
    for k in reversed(range(n)):
        if not M[k, k].real > 0:
            raise SingularError(k)
        share[k, :k] = M[k, :k] / M[k, k]
        M[:k, :k] -= M[:k, k, None] * share[k, :k]
        x[:k] -= share[k, :k] * x[k]
    for k in range(n):
        x[k] = x[k] / M[k, k] - share[k, :k] @ x[:k] if k else x[k] / M[k, k]
    return x

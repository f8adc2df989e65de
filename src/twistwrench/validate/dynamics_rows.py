"""The rows of 49.6 to 49.9: forces, accelerations, the mass matrix, equilibrium."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import twistwrench as tw

from .. import bridge
from .. import newton_euler_3d as ne
from ..arrays import Array
from ..model import Model
from . import exact
from .conditioning import (
    equilibrium_bound,
    forward_dynamics_bound,
    forward_dynamics_residual,
    momentum_products,
    without_inertia,
    wrenches,
)
from .oracle import Oracle
from .quantity import ComparedQuantity
from .states import States

__all__ = ["DYNAMICS", "FORWARD_DYNAMICS"]


def _standing_forces(model: Model, s: States) -> Array:
    """Return (tau, contact forces) of each state; `static_equilibrium` takes one at a time."""
    held = [tw.static_equilibrium(model, q) for q in s.q]
    return np.stack([np.concatenate([h.tau, h.forces.ravel()]) for h in held])


def _rnea(p: Oracle, s: States, *f_ext: Array) -> Array:
    extra = [bridge.to_pinocchio_f_ext(p.ours, f) for f in f_ext]
    return p.vector(p.pin.rnea(p.model, p.data, s.q, p.tangent(s.v), p.tangent(s.a), *extra))


def _aba(p: Oracle, s: States, *f_ext: Array) -> Array:
    extra = [bridge.to_pinocchio_f_ext(p.ours, f) for f in f_ext]
    return p.vector(p.pin.aba(p.model, p.data, s.q, p.tangent(s.v), p.tangent(s.tau), *extra))


def _is_right_to_refuse(model: Model, s: States, message: str) -> bool:
    """Whether the error names all joints that move nothing; or one without apparent inertia while others are free.

    Or one where M is so nearly singular that rounding may leave q̈ no digit.
    """
    named = {name for name in model.joint_names if repr(name) in message}
    nothing, lost = without_inertia(model, s)
    if not named or nothing:
        return bool(named) and named == nothing
    if named <= lost:
        return True
    qdd = ne.forward_dynamics(model, s.q, s.v, s.tau).astype(np.float64)
    rounded = replace(s, **{key: getattr(s, key).astype(np.float64) for key in ("q", "v", "tau")})
    return forward_dynamics_bound(model, rounded, qdd) > 1


FORWARD_DYNAMICS = (
    ComparedQuantity(
        "49.7",
        "forward dynamics",
        "aba",
        ours=lambda m, s: tw.aba(m, s.q, s.v, s.tau),
        theirs=_aba,
        truth=lambda m, s: ne.forward_dynamics(m, s.q, s.v, s.tau),
        bound=forward_dynamics_bound,
        residual=forward_dynamics_residual,
        singular=_is_right_to_refuse,
    ),
    ComparedQuantity(
        "49.7",
        "forward dynamics, f_ext",
        "aba, fext",
        ours=lambda m, s: tw.aba(m, s.q, s.v, s.tau, s.f_ext),
        theirs=lambda p, s: _aba(p, s, s.f_ext),
        truth=lambda m, s: ne.forward_dynamics(m, s.q, s.v, s.tau, s.f_ext),
        bound=lambda m, s, qdd: forward_dynamics_bound(m, s, qdd, s.f_ext),
        residual=lambda m, s, exact: forward_dynamics_residual(m, s, exact, s.f_ext),
        singular=_is_right_to_refuse,
    ),
)

DYNAMICS = (
    ComparedQuantity(
        "49.6",
        "wrenches at the joints",
        "data.f after rnea",
        ours=lambda m, s: tw.joint_wrenches(m, s.q, s.v, s.a)[:, 1:],
        theirs=lambda p, s: p.wrenches(s),
        truth=lambda m, s: ne.joint_wrenches(m, s.q, s.v, s.a)[1:],
    ),
    ComparedQuantity(
        "49.6",
        "inverse dynamics",
        "rnea",
        ours=lambda m, s: tw.rnea(m, s.q, s.v, s.a),
        theirs=_rnea,
        truth=lambda m, s: ne.inverse_dynamics(m, s.q, s.v, s.a),
        terms=lambda m, s: wrenches(m, s.q, s.v, s.a).max(),
    ),
    ComparedQuantity(
        "49.6",
        "inverse dynamics, f_ext",
        "rnea, fext",
        ours=lambda m, s: tw.rnea(m, s.q, s.v, s.a, s.f_ext),
        theirs=lambda p, s: _rnea(p, s, s.f_ext),
        truth=lambda m, s: ne.inverse_dynamics(m, s.q, s.v, s.a, s.f_ext),
        terms=lambda m, s: wrenches(m, s.q, s.v, s.a, s.f_ext).max(),
    ),
    ComparedQuantity(
        "49.6",
        "h = C v + g",
        "nonLinearEffects",
        ours=lambda m, s: tw.nonlinear_effects(m, s.q, s.v),
        theirs=lambda p, s: p.vector(p.pin.nonLinearEffects(p.model, p.data, s.q, p.tangent(s.v))),
        truth=lambda m, s: ne.nonlinear_effects(m, s.q, s.v),
        terms=lambda m, s: wrenches(m, s.q, s.v, 0 * s.v).max(),
    ),
    ComparedQuantity(
        "49.6",
        "g",
        "computeGeneralizedGravity",
        ours=lambda m, s: tw.gravity(m, s.q),
        theirs=lambda p, s: p.vector(p.pin.computeGeneralizedGravity(p.model, p.data, s.q)),
        truth=lambda m, s: ne.gravity(m, s.q),
        terms=lambda m, s: wrenches(m, s.q, 0 * s.v, 0 * s.v).max(),
    ),
    ComparedQuantity(
        "49.6",
        "Coriolis matrix C",
        "computeCoriolisMatrix",
        ours=lambda m, s: tw.coriolis_matrix(m, s.q, s.v),
        theirs=lambda p, s: p.matrix(p.pin.computeCoriolisMatrix(p.model, p.data, s.q, p.tangent(s.v))),
        truth=lambda m, s: ne.coriolis_matrix(m, s.q, s.v),
        terms=momentum_products,
    ),
    *FORWARD_DYNAMICS,
    ComparedQuantity(
        "49.8",
        "mass matrix M",
        "crba",
        ours=lambda m, s: tw.crba(m, s.q),
        theirs=lambda p, s: p.matrix(p.pin.crba(p.model, p.data, s.q)),
        truth=lambda m, s: ne.mass_matrix(m, s.q),
    ),
    ComparedQuantity(
        "49.9",
        "static equilibrium τ, λ",
        "g and J, by lstsq",
        ours=_standing_forces,
        theirs=lambda p, s: p.static_equilibrium(s),
        truth=exact.static_equilibrium,
        bound=equilibrium_bound,
        applies=lambda m: m.base == "floating" and bool(m.feet),
    ),
)

"""How far rounding alone may move a result.

The error of a quantity is measured against its own largest entry. Two things can rule out 1e-12 of that:

- *Cancellation*, as in the g of a nearly vertical axis. The scale is then 1 % of the largest term that
  was summed; 1e-12 of it is 45 roundings of that term.
- *An inverse*, as in forward dynamics where M is nearly singular. The bound is then computed from the
  condition, and an error above 1e-12 must also be explained by rounding: the result solves its
  equation to a few roundings of the equation's terms.

All is computed here from `newton_euler_3d`, which shares nothing with the functions that are validated.
"""

from __future__ import annotations

import numpy as np

from .. import newton_euler_3d as ne
from ..arrays import Array, resolution
from ..model import Model
from .exact import contact_jacobian
from .states import States

__all__ = [
    "CANCELLED_SHARE",
    "TERM_RTOL",
    "equilibrium_bound",
    "forward_dynamics_bound",
    "forward_dynamics_residual",
    "momentum_products",
    "reach",
    "twist_products",
    "weight_at_reach",
    "without_inertia",
    "wrenches",
]

CANCELLED_SHARE = 0.01
"""The part of the terms' size that a result is measured against where it is itself smaller than that."""

TERM_RTOL = 10 * resolution(np.float64)
"""K ε: the relative error that each term of an equation may have picked up, ten roundings."""


def twist_products(model: Model, s: States, reference: str) -> float:
    """Return the size of the terms of J̇ v: products of two twists, each a sum of J_k v_k."""
    twists = [np.abs(ne.frame_jacobian(model, s.q, name, reference)) @ np.abs(s.v) for name in s.frames]
    return float(np.max(twists) ** 2)


def momentum_products(model: Model, s: States) -> float:
    """Return the size of the terms of C: entries of M times entries of twists."""
    return float(np.abs(ne.mass_matrix(model, s.q)).max() * np.abs(ne.body_twists(model, s.q, s.v)).max())


def reach(model: Model, s: States) -> float:
    """Return the largest coordinate of a body's origin: the centre of mass is a mean of such."""
    return float(np.abs(ne.placements(model, s.q)[1]).max())


def weight_at_reach(model: Model, s: States) -> float:
    """Return the potential energy of the whole weight at the largest coordinate."""
    return float(model.mass * np.abs(model.gravity).max() * reach(model, s))


def wrenches(model: Model, q: Array, v: Array, a: Array, f_ext: Array | None = None) -> Array:
    """Return for each entry of v the largest entry of its joint's wrench, of which τ is a projection; (nv,)."""
    F = ne.joint_wrenches(model, q, v, a, f_ext)
    return np.repeat(np.abs(F).max(axis=-1), [at.stop - at.start for at in model.v_slice])


def _terms(model: Model, s: States, qdd: Array, f_ext: Array | None) -> tuple[Array, Array]:
    """Return M, and the size of the terms of each row of M q̈ = τ − h; |F|, of which h is a projection, for |h|."""
    M = ne.mass_matrix(model, s.q)
    return M, np.abs(M) @ np.abs(qdd) + np.abs(s.tau) + wrenches(model, s.q, s.v, 0 * s.v, f_ext)


def forward_dynamics_bound(model: Model, s: States, qdd: Array, f_ext: Array | None = None) -> float:
    """Return K ε ‖ |M⁻¹| (|M| |q̈| + |τ| + |F|) ‖ / ‖q̈‖: what relative errors K ε of the terms do to q̈.

    Skeel's condition, which is independent of the scaling of rows. Infinite where M is singular in double precision.
    """
    M, terms = _terms(model, s, qdd, f_ext)
    if not (np.diag(M) > 0).all():
        return np.inf
    d = 1 / np.sqrt(np.diag(M))
    try:
        inverse = d[:, None] * np.linalg.inv(d[:, None] * M * d) * d
    except np.linalg.LinAlgError:
        return np.inf
    return float(TERM_RTOL * (np.abs(inverse) @ terms).max() / np.abs(qdd).max())


def forward_dynamics_residual(model: Model, s: States, exact: States, f_ext: Array | None = None) -> float:
    """Return the residual of M q̈ = τ − h relative to its terms, in the worst row; q̈ is the a of the state."""
    missed = ne.inverse_dynamics(model, exact.q, exact.v, exact.a, f_ext) - exact.tau
    return float((np.abs(missed.astype(np.float64)) / _terms(model, s, s.a, f_ext)[1]).max())


def equilibrium_bound(model: Model, s: States, solution: Array) -> float:
    """Return the error that a relative error K ε in g and J_c makes in (τ, λ), relative to their largest entry.

    For the λ of least norm it is 3 κ(B) K ε ‖λ‖ with B the base rows of J_cᵀ (Golub and Van Loan, Matrix
    computations, section 5.6); τ inherits that through J_cᵀ, and adds K ε of its own terms.
    """
    J, n = contact_jacobian(model, s), model.nv - 6
    forces = solution[n:]
    unit = TERM_RTOL
    of_forces = 3 * np.linalg.cond(J[:, :6]) * unit * np.sqrt((forces**2).sum())
    own = unit * (wrenches(model, s.q, 0 * s.v, 0 * s.v)[6:] + np.abs(J[:, 6:].mT) @ np.abs(forces))
    of_tau = own.max(initial=0) + np.linalg.norm(J[:, 6:], 2) * of_forces if n else 0.0
    return float(max(of_forces, of_tau) / np.abs(solution).max())


def without_inertia(model: Model, s: States) -> tuple[set[str], set[str]]:
    """Return the joints that move nothing with inertia, and those whose apparent inertia is lost in rounding.

    M is eliminated from the tips to the base, as `twistwrench.aba` does; a pivot is the apparent inertia
    of a joint, with the outboard ones free. It is lost where rounding of M's own entry outweighs it.
    """
    M, nv = ne.mass_matrix(model, s.q), model.nv
    names = np.repeat(np.array(model.joint_names, object), [at.stop - at.start for at in model.v_slice])
    nothing = set(names[np.diag(M) == 0])
    lost = set()
    diagonal = np.diag(M).copy()
    for k in reversed(range(nv)):
        if M[k, k] <= nv * TERM_RTOL * diagonal[k]:
            lost.add(names[k])
        else:
            M[:k, :k] -= np.outer(M[:k, k], M[k, :k]) / M[k, k]
    return nothing, lost

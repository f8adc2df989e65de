"""Where forward dynamics has no answer: a joint that accelerates nothing, or nothing beyond rounding (49.7).

D = Sᵀ IA S is a difference of inertias, and where joints can move against each other without moving anything else
(gimbal lock) only rounding is left of it. Each inertia has a bound on its rounding error, in units of the number type's
resolution; a D below a hundred times its bound raises SingularError with the joint's name.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array, comparable, resolution
from ..errors import SingularError
from ..model import Model, Tree, composite_inertias
from ..spatial._elementary import at_first_index
from .terms import AbaTerms, ArticulatedTerms

__all__ = ["refuse_lost", "refuse_singular", "refuse_weightless"]

ROUNDINGS = 100
"""An inertia, or a singular value of contacts, below so many times the bound on its rounding counts as zero."""


def refuse_singular(model: Model, tree: Tree, terms: AbaTerms | ArticulatedTerms) -> None:
    """Raise SingularError where a D of the ABA is singular to rounding: q̈ is not determined there."""
    refuse_weightless(model, tree)
    if tree.I[0].dtype == object:  # not rounded: where D is zero, the division has raised
        return
    S, X, IA, U, D_inv = tree.S, tree.X, terms.IA, terms.U, terms.D_inv
    bound = [error_bound(I) for I in tree.I]
    for i in tree.inward:
        p = tree.parent[i]
        refuse_lost(terms.D[i], S[i].mT @ bound[i] @ S[i], model.joint_names[i], massless_base(model, i))
        left = X[i] - S[i] @ D_inv[i] @ U[i].mT @ X[i]  # of the parent's motion, outboard of the free joint
        bound[p] = bound[p] + propagate_bound(bound[i], left, X[i], IA[i], U[i] @ D_inv[i] @ U[i].mT)


def refuse_weightless(model: Model, tree: Tree) -> None:
    """Raise SingularError with the names of all joints outboard of which nothing has inertia."""
    locked = [
        ((IC @ S) * S).sum(axis=-2) + r.diagonal() for IC, S, r in zip(composite_inertias(tree), tree.S, tree.rotor)
    ]
    names = [model.joint_names[i] for i in tree.outward if (comparable(locked[i]) <= 0).any()]
    if names:
        raise SingularError(f"no inertia outboard of joint {', '.join(map(repr, names))}: q̈ is not determined there")


def error_bound(*terms: Array) -> Array:
    """Return a bound on what rounding may make of a sum of inertias, in units of the number type's resolution.

    A diagonal matrix, by which every motion's inertia is bounded: an entry (i, j) of a positive
    semidefinite term is no larger than the mean of the entries (i, i) and (j, j).
    """
    size: Array = sum(np.abs(np.diagonal(term.real, axis1=-2, axis2=-1)) for term in terms)
    bound: Array = size[..., None] * np.eye(size.shape[-1], dtype=size.dtype)
    return bound


def propagate_bound(bound: Array, left: Array, X: Array, IA: Array, lost: Array) -> Array:
    """Return a bound on the rounding error of Xᵀ (IA − lost) X, where lost = U D⁻¹ Uᵀ, in units of the resolution.

    The propagated bound of IA plus the rounding of this sum: `left` = X − S D⁻¹ Uᵀ X takes the parent's motion to the
    motion outboard of the free joint.
    """
    X = np.abs(X.real)
    here = X.mT @ (np.abs(IA.real) + np.abs(lost.real)) @ X
    inward: Array = left.real.mT @ bound @ left.real + error_bound(here)
    return inward


def massless_base(model: Model, i: int) -> str:
    """Return a hint for the message where body i is a floating base without mass, else an empty string."""
    if i != 1 or model.base != "floating" or model.inertia[1].mass:
        return ""
    return (
        "; the base has no mass of its own: give its link an inertia, weld it to one that has one, or take base='fixed'"
    )


def refuse_lost(D: Array, bound: Array, name: str, hint: str = "") -> None:
    """Raise SingularError where a motion of a joint has no more inertia than a hundred times the bound on its rounding.

    Such an inertia cannot be distinguished from zero: the outboard joints can do the same motion.
    """
    own = np.diagonal(D.real, axis1=-2, axis2=-1)
    size = np.abs(own) + np.diagonal(bound.real, axis1=-2, axis2=-1)
    unit = np.sqrt(np.where(size == 0, 1, size))
    scaled = (D.real / unit[..., :, None] / unit[..., None, :]).astype(np.float64)
    lost = np.asarray((np.linalg.eigvalsh(scaled) < ROUNDINGS * resolution(D.dtype)).any(axis=-1))
    lost |= (own < np.finfo(D.dtype).tiny).any(axis=-1)  # of which the reciprocal may overflow
    if lost.any():
        raise SingularError(
            f"joint {name!r}: with its outboard joints free it moves no inertia beyond rounding"
            f"{at_first_index(lost)}{hint}"
        )

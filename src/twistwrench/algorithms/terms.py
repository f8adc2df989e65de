"""What the recursions compute on their way: records of their terms, by the chapter's names (49.6 to 49.10).

Entry i of a tuple belongs to body i and is expressed in frame i; entry 0 is the world's. Every array has the batch
axes of the state. A record is made anew by each call: unlike a workspace, it cannot be stale.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Self

import numpy as np

from ..arrays import Array

__all__ = ["AbaTerms", "ArticulatedTerms", "CentroidalTerms", "CrbaTerms", "RneaTerms", "Subtree", "matrices"]

Batch = tuple[int, ...]
Entries = Sequence[Array]
Pair = tuple[int, int]


class Terms:
    """Record of the terms of a recursion: how it prints."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f.name for f in fields(self))})"  # type: ignore[arg-type]


@dataclass(frozen=True, eq=False, repr=False)
class RneaTerms(Terms):
    """Twists, accelerations and wrenches of the RNEA, from `rnea_terms`.

    Attributes
    ----------
    V : tuple of ndarray, shape (..., 6)
        Body twist (ω, v), rad/s and m/s.
    A : tuple of ndarray, shape (..., 6)
        Spatial acceleration; the world rises with −g, so that gravity is in it.
    B : tuple of ndarray, shape (..., 6)
        Wrench that the body's own motion needs, less the external one: I A + V ×* I V − f_ext, N m and N.
    F : tuple of ndarray, shape (..., 6)
        Wrench that the joint transmits to the body: its own and those of its children.
    tau : ndarray, shape (..., nv)
        What `rnea` returns.
    """

    V: tuple[Array, ...]
    A: tuple[Array, ...]
    B: tuple[Array, ...]
    F: tuple[Array, ...]
    tau: Array

    @classmethod
    def of(cls, batch: Batch, V: Entries, A: Entries, B: Entries, F: Entries, tau: Array) -> Self:
        """Make vectors of the columns of a recursion."""
        return cls(vectors(V, batch), vectors(A, batch), vectors(B, batch), vectors(F, batch), tau)


@dataclass(frozen=True, eq=False, repr=False)
class AbaTerms(Terms):
    """Articulated-body inertias, bias wrenches and accelerations of the ABA, from `aba_terms`.

    Attributes
    ----------
    V, c : tuple of ndarray, shape (..., 6)
        Body twist, and bias acceleration V × S q̇.
    B : tuple of ndarray, shape (..., 6)
        Bias wrench of the body alone, V ×* I V − f_ext, N m and N.
    IA : tuple of ndarray, shape (..., 6, 6)
        Articulated-body inertia: of the body with its outboard joints free.
    pA : tuple of ndarray, shape (..., 6)
        Its bias wrench.
    U : tuple of ndarray, shape (..., 6, nv of joint i)
        IA S.
    D, D_inv : tuple of ndarray, shape (..., nv of joint i, nv of joint i)
        Sᵀ U and the rotor's inertia: what the joint accelerates; and its inverse.
    u : tuple of ndarray, shape (..., nv of joint i)
        τ − Sᵀ pA, N m or N.
    Ia : tuple of ndarray, shape (..., 6, 6)
        IA − U D⁻¹ Uᵀ: the inertia as it appears through the free joint.
    pa : tuple of ndarray, shape (..., 6)
        Its bias wrench, pA + Ia c + U D⁻¹ u.
    A : tuple of ndarray, shape (..., 6)
        Spatial acceleration, gravity in it.
    qdd : ndarray, shape (..., nv)
        What `aba` returns.
    """

    V: tuple[Array, ...]
    c: tuple[Array, ...]
    B: tuple[Array, ...]
    IA: tuple[Array, ...]
    pA: tuple[Array, ...]
    U: tuple[Array, ...]
    D: tuple[Array, ...]
    D_inv: tuple[Array, ...]
    u: tuple[Array, ...]
    Ia: tuple[Array, ...]
    pa: tuple[Array, ...]
    A: tuple[Array, ...]
    qdd: Array

    @classmethod
    def of(cls, batch: Batch, *, qdd: Array, **entries: Entries) -> Self:
        """Make vectors of the columns of a recursion. The world has no joint: the terms of a joint are empty there."""
        dtype = qdd.dtype
        for name, shape in {"U": (6, 0), "D": (0, 0), "D_inv": (0, 0), "u": (0, 1), "Ia": (6, 6)}.items():
            entries[name] = [np.zeros((*batch, *shape), dtype), *entries[name][1:]]
        is_vector = ("V", "c", "B", "pA", "u", "pa", "A")
        return cls(**{k: (vectors if k in is_vector else matrices)(x, batch) for k, x in entries.items()}, qdd=qdd)


@dataclass(frozen=True, eq=False, repr=False)
class ArticulatedTerms(Terms):
    """Terms of the ABA that depend on the posture alone, from `articulated_inertias`: see `AbaTerms`.

    Attributes
    ----------
    IA, U, D, D_inv : list of ndarray
        As in `AbaTerms`.
    """

    IA: Entries
    U: Entries
    D: Entries
    D_inv: Entries


@dataclass(frozen=True, eq=False, repr=False)
class CrbaTerms(Terms):
    """Composite inertias, wrenches and mass matrix of the CRBA, from `crba_terms`.

    Attributes
    ----------
    IC : tuple of ndarray, shape (..., 6, 6)
        Composite inertia: of the body and its subtree, joints locked.
    F : mapping of (int, int) to ndarray, shape (..., 6, nv of joint i)
        ``F[j, i]``: the wrench for a unit acceleration of joint i, in frame j, for each j from i to the base.
    M : ndarray, shape (..., nv, nv)
        What `crba` returns.
    """

    IC: tuple[Array, ...]
    F: Mapping[tuple[int, int], Array]
    M: Array

    @classmethod
    def of(cls, batch: Batch, IC: Entries, F: Mapping[Pair, Array], M: Mapping[Pair, Array], sizes: list[int]) -> Self:
        """Put the blocks of M, by pairs of joints, into one matrix; `sizes` is the nv of each joint."""
        end = np.cumsum(sizes)
        whole = np.zeros((*batch, end[-1], end[-1]), IC[0].dtype)
        for (i, j), block in M.items():
            whole[..., end[i] - sizes[i] : end[i], end[j] - sizes[j] : end[j]] = block
        return cls(matrices(IC, batch), {pair: matrices([f], batch)[0] for pair, f in F.items()}, whole)


@dataclass(frozen=True, eq=False, repr=False)
class CentroidalTerms(Terms):
    """Transforms, composite inertias and momentum map of the CCRBA, from `centroidal_terms`.

    Attributes
    ----------
    X : tuple of ndarray, shape (..., 6, 6)
        ᴳX*_i, which takes a wrench or a momentum from frame i to the centre of mass, in the axes of the world.
    IC : tuple of ndarray, shape (..., 6, 6)
        Composite inertia: of the body and its subtree, joints locked.
    A_G : ndarray, shape (..., 6, nv)
        What `centroidal_map` returns.
    """

    X: tuple[Array, ...]
    IC: tuple[Array, ...]
    A_G: Array


@dataclass(frozen=True, eq=False, repr=False)
class Subtree(Terms):
    """Mass, centre, Jacobian and inertia of a part of a robot, from `subtree`; at its own centre G, axes of the world.

    Attributes
    ----------
    mass : ndarray, shape ()
        kg.
    center_of_mass : ndarray, shape (..., 3)
        p_G in the world, m.
    jacobian : ndarray, shape (..., 3, nv)
        v_G = J_G v.
    inertia : ndarray, shape (..., 6, 6)
        At G, the joints of the subtree locked.
    momentum_map : ndarray, shape (..., 6, nv)
        The momentum (k_G, l_G) of the subtree alone is A_G v.
    """

    mass: Array
    center_of_mass: Array
    jacobian: Array
    inertia: Array
    momentum_map: Array


def matrices(entries: Entries, batch: Batch) -> tuple[Array, ...]:
    """Return matrices of all bodies, each with the batch axes of the state."""
    return tuple(x if x.shape[:-2] == batch else np.broadcast_to(x, (*batch, *x.shape[-2:])) for x in entries)


def vectors(columns: Entries, batch: Batch) -> tuple[Array, ...]:
    """Return the columns of all bodies as vectors, shape (..., n)."""
    return tuple(x[..., 0] for x in matrices(columns, batch))

"""What is divided by inertias: M⁻¹, the factors of M, solves, and the inertia that a contact or a body has (49.7-49.9).

Each is computed by the textbook's function. Besides, each pivot that it divides by is watched: see `watch`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from ..algorithms.articulated import articulated_inertia, articulated_inertias
from ..algorithms.delassus import delassus_matrix, operational_space_inertia
from ..algorithms.factorization import ltdl, solve_mass_matrix
from ..algorithms.inverse_mass import inverse_mass_matrix
from ..arrays import Array
from ..model import Model, tree_terms
from .quantity import Quantity, of_each
from .watch import LEAST, pivots

__all__ = ["inverses"]

Compute = Callable[..., Array]


def inverses(model: Model, dtype: np.dtype[Any], frames: Sequence[str], rows: Quantity) -> Iterator[Quantity]:
    """Yield M⁻¹, L and D of M = Lᵀ D L, M⁻¹ τ, Λ⁻¹ = J_c M⁻¹ J_cᵀ and Λ, and the articulated inertias of frames.

    The number type decides what counts as singular; `rows` is J_c.
    """

    def by_aba(q: Array) -> list[Any]:
        tree = tree_terms(model, q)
        return [*pivots(model, tree, articulated_inertias(tree).D_inv, dtype)]

    def by_factors(q: Array) -> list[Any]:
        D = ltdl(model, q)[1]
        return [*pivots(model, tree_terms(model, q), [np.diag(1 / D[s]) for s in model.v_slice], dtype)]

    def watched(symbol: str, arguments: str, function: Compute, questions: Callable[[Array], list[Any]]) -> Quantity:
        def compute(q: Array, *others: Array) -> tuple[Array, list[Any]]:
            return function(q, *others), questions(q) if q.dtype == object else []

        return Quantity(symbol, tuple(arguments.split()), compute)

    def mobility(q: Array) -> Array:
        return delassus_matrix(model, q, rows.compute(q)[0])

    def apparent(q: Array) -> Array:
        return operational_space_inertia(model, q, rows.compute(q)[0])

    def by_rows(q: Array) -> list[Any]:
        return [*by_factors(q), *_dependence(mobility(q), apparent(q))]

    yield watched("M_inv", "q", lambda q: inverse_mass_matrix(model, q), by_aba)
    yield watched("L", "q", lambda q: ltdl(model, q)[0], by_factors)
    yield watched("D", "q", lambda q: ltdl(model, q)[1], by_factors)
    yield watched("M_inv_tau", "q tau", lambda q, tau: solve_mass_matrix(model, q, tau), by_factors)
    yield watched("Lambda_inv", "q", mobility, by_factors)
    yield watched("Lambda", "q", apparent, by_rows)
    yield watched("IA", "q", partial(of_each, frames, articulated_inertia, (6, 6), model), by_aba)


def _dependence(A: Array, A_inv: Array) -> Iterator[Any]:
    """Yield for each row its entry of A times that of A⁻¹, over the largest that is allowed.

    1 for a row that is independent of the others. The least eigenvalue of A, scaled to a diagonal of ones, is at least
    1 over the sum of these products.
    """
    for k in range(len(A)):
        yield Fraction(LEAST) * A[k, k] * A_inv[k, k]

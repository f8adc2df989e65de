"""The equations of contact solved by elimination, without a test of rank: what a program can be made of (49.8, 49.9).

M x − Jᵀ λ = f and J x = a, in the order in which nothing fills in. M = LᵀDL along the tree, from the tips inward;
Y = L⁻ᵀ Jᵀ, which is zero wherever a joint does not move a contact; J M⁻¹ Jᵀ = Yᵀ D⁻¹ Y, factorised in the same way. No
step asks what a number is. So it takes a state as a straight line, and is right wherever rows of J are independent: an
entry of the last diagonal says how much of its row no other one has. Where that is little, `decomposition` decides.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from ..algorithms.crba import composite_rigid_body
from ..algorithms.delassus import delassus
from ..algorithms.factorization import factorize, inboard_dofs, solve_inward, solve_outward
from ..arrays import Array
from ..errors import SingularError
from ..fast.watch import pivots
from ..model import Model, Tree

__all__ = ["Elimination"]

MIN_ROW_SHARE = 1e-3
"""A row of J that keeps less of its mobility where the others hold is left to the textbook: a share s costs ε / s."""


class Elimination(NamedTuple):
    """The factors of M = LᵀDL and of J M⁻¹ Jᵀ, their diagonals inverted, and Y = L⁻ᵀ Jᵀ."""

    tree: Tree
    L: Array
    D_inv: Array
    inboard: list[list[int]]
    Y: Array
    mobility: Array
    row_L: Array
    row_D_inv: Array

    @classmethod
    def of(cls, tree: Tree, J: Array) -> Elimination:
        """Factorise M and J M⁻¹ Jᵀ, of a J whose rows are independent."""
        inboard = inboard_dofs(tree)
        L, D = factorize(composite_rigid_body(tree).M, inboard)
        mobility = delassus(L, D, inboard, J)
        try:
            row_L, row_D = factorize(mobility, every_row(J))
        except ZeroDivisionError as error:  # fractions raise where floats are infinite
            raise SingularError(
                f"row {error} of J depends on the rows after it in every configuration: of many forces that have the "
                "same effect no program finds one; contact_forward_dynamics and impact find the least"
            ) from None
        return cls(tree, L, 1 / D, inboard, solve_inward(L, inboard, J.mT), mobility, row_L, 1 / row_D)

    def hold(self, a: Array) -> tuple[Array, Array]:
        """Return the least x, in the metric of M, with J x = a, and the λ with M x = Jᵀ λ."""
        force = self.force(a[..., None])
        return self.follow(self.Y @ force)[..., 0], force[..., 0]

    def solve(self, f: Array, a: Array) -> tuple[Array, Array]:
        """Return x and λ with M x − Jᵀ λ = f and J x = a, column by column."""
        white = solve_inward(self.L, self.inboard, f)
        force = self.force(a - self.Y.mT @ (white * self.D_inv[..., None]))
        return self.follow(white + self.Y @ force), force

    def force(self, a: Array) -> Array:
        """Return λ with J M⁻¹ Jᵀ λ = a, column by column."""
        rows = every_row(self.row_L)
        return solve_outward(self.row_L, rows, solve_inward(self.row_L, rows, a) * self.row_D_inv[..., None])

    def follow(self, white: Array) -> Array:
        """Return x with M x = Lᵀ times these columns."""
        return solve_outward(self.L, self.inboard, white * self.D_inv[..., None])

    def watched(self, model: Model, dtype: np.dtype[Any]) -> Iterator[Any]:
        """Yield what a program watches: small where M and J M⁻¹ Jᵀ are safely regular."""
        yield from pivots(model, self.tree, [np.diag(self.D_inv[s]) for s in model.v_slice], dtype)
        yield from Fraction(MIN_ROW_SHARE) * np.diag(self.mobility) * self.row_D_inv


def every_row(rows: Array) -> list[list[int]]:
    """Return for each row all those before it: a matrix without zeros, as a chain that no other joins."""
    return [[*range(k)] for k in range(rows.shape[-2])]

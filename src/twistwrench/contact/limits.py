"""The limits of contact forces f, as rows of A f ≤ b: those of the contacts, and of the motors that balance them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..model import Model
from .decomposition import block_diagonal
from .types import Contact, Pyramid

__all__ = ["Limits", "contact_limits", "motor_limits"]


class Limits(NamedTuple):
    """A f ≤ b, in N, with a name, a size and a unit for each row: broken by 1 N, a row is broken by `size` units."""

    A: Array
    b: Array
    names: list[str]
    size: Array
    unit: list[str]

    def join(self, other: Limits) -> Limits:
        """Return the rows of both."""
        A, b, size = (
            np.concatenate([x, y]) for x, y in zip((self.A, self.b, self.size), (other.A, other.b, other.size))
        )
        return Limits(A, b, self.names + other.names, size, self.unit + other.unit)

    def breached(self, by: Array) -> str:
        """Return which limits would have to be broken, and by how much, the worst four first."""
        worst = {self.names[k]: k for k in np.argsort(by) if by[k] > 0.01 * by.max()}  # of equal names the larger
        ranked = sorted(worst.values(), key=lambda k: (-round(by[k] / by.max(), 6), k))  # alike: in their own order
        more = f" and {len(ranked) - 4} more" if len(ranked) > 4 else ""
        said = (f"{self.names[k]} by {by[k] * self.size[k]:.3g} {self.unit[k]}" for k in ranked[:4])
        return ", ".join(said) + more


def contact_limits(contacts: Sequence[Contact], sides: int, pyramid: Pyramid) -> Limits:
    """Return the limits of the forces at all points, each in its contact's axes."""
    A = block_diagonal([c.limits(sides, pyramid) for c in contacts])
    names = [name for c in contacts for name in c.limit_names(sides)]
    return Limits(A, np.zeros(len(A)), names, np.ones(len(A)), ["N"] * len(A))


def motor_limits(model: Model, tau: Array, B: Array) -> Limits:
    """Return |τ − B f| ≤ `Model.effort_limit`, of all joints that have a limit and are no floating base.

    Parameters
    ----------
    model : Model
    tau : ndarray, shape (nv,)
        The joint forces that the motion needs without f, N m or N.
    B : ndarray, shape (nv, 3 k)
        What f does for them.
    """
    owner = np.repeat(np.arange(model.nbodies), [s.stop - s.start for s in model.v_slice])
    motors = np.flatnonzero(np.isfinite(model.effort_limit) & (owner >= (2 if model.base == "floating" else 1)))
    B, tau, limit = B[motors], tau[motors], model.effort_limit[motors]
    most = np.abs(B).max(axis=1, initial=0)
    size = np.where(most > 0, most, 1)  # m: the longest lever of a force
    lever, need, limit = B / size[:, None], tau / size, limit / size
    turns = [bool(model.joints[owner[k]].subspace()[:3, k - model.v_slice[owner[k]].start].any()) for k in motors]
    names = [f"the motor of {model.joint_names[owner[k]]!r}" for k in motors]
    A, b = np.concatenate([-lever, lever]), np.concatenate([limit - need, limit + need])
    return Limits(A, b, 2 * names, np.tile(size, 2), 2 * ["N m" if turn else "N" for turn in turns])

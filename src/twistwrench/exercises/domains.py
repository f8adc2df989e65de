"""What the arguments of the chapter's functions are, by their names: each symbol means one thing in all exercises."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from misstep.domains import Domain, Matrix, Rotation, Vector, rotation, rounded
from misstep.exercise import Part

from ..arrays import Array
from ..model import Model
from .robots import ball_robots, bare_robot, massless_link

__all__ = ["DOMAINS", "special_cases"]

MOON_GRAVITY = np.array([0, 0, -1.62])
"""Gravity that is not the earth's, in m/s²."""

CROSS_Z = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 0]])
"""The cross product with an axis z."""

WHOLE_INERTIAS: dict[tuple[int, ...], Any] = {
    (3, 3): np.diag([2, 3, 4]),
    (6, 6): np.block([[np.diag([4, 5, 4]), 2 * CROSS_Z], [-2 * CROSS_Z, 2 * np.eye(3, dtype=int)]]),
}
"""The inertia of a body of 2 kg in whole numbers, by its shape."""


class Placement(Domain):
    """A placement, 4 × 4, or several, of which the first is the world's."""

    def turned(self, value: Any, turn: Array) -> Any:
        """Return it with another rotation."""
        new = value.copy()
        new[(...,) if value.ndim == 2 else slice(1, None)][..., :3, :3] = rotation(turn)
        return new

    def scaled(self, value: Any, factor: float) -> Any:
        """Return it with another position."""
        new = value.copy()
        new[..., :3, 3] *= factor
        return new


class Configuration(Domain):
    """A configuration q of a robot, whose first seven entries place a floating base."""

    def turned(self, value: Any, turn: Array) -> Any:
        """Return it with another orientation of the base."""
        if not _floats(value):
            return value
        new = value.copy()
        new[3:7] = turn
        return new

    def scaled(self, value: Any, factor: float) -> Any:
        """Return it with another position of the base."""
        new = copy.copy(value)
        if _floats(value):
            new[:3] *= factor
        return new


class Mass(Domain):
    """A mass, which is never zero."""

    def scaled(self, value: Any, factor: float) -> Any:
        """Multiply it."""
        return value * (factor or 1)

    def whole(self, value: Any, largest: int) -> Any:
        """Round it."""
        return round(value) or 1 if isinstance(value, float) else value


class Inertia(Domain):
    """A rotational inertia, 3 × 3, or a spatial one, 6 × 6."""

    def simple(self, value: Any) -> Iterator[Any]:
        """Yield a body without mass."""
        if getattr(value, "shape", ()) == (6, 6):
            yield 0 * value

    def whole(self, value: Any, largest: int) -> Any:
        """Return the inertia of a body of 2 kg."""
        return WHOLE_INERTIAS.get(getattr(value, "shape", ()), value)


class MassMatrix(Domain):
    """A mass matrix, which stays positive definite."""

    def whole(self, value: Any, largest: int) -> Any:
        """Round it, and add to the diagonal."""
        whole = rounded(value, largest)
        return whole if whole is value else whole + len(whole) * np.eye(len(whole), dtype=int)


class Selection(Domain):
    """A motion subspace S, whole numbers where its entries are."""

    def whole(self, value: Any, largest: int) -> Any:
        """Return the same numbers as integers."""
        is_whole = isinstance(value, np.ndarray) and value.any() and np.array_equal(value, np.rint(value))
        return value.astype(int) if is_whole else value


VECTORS = (
    *("v", "a", "h", "g", "w", "p", "c", "r", "x", "tau", "force", "forces", "f_c", "weight", "points"),
    *("omega", "alpha", "a_c", "omega_z", "v_x", "p_AB", "p_BC", "p_G", "xyz", "rpy", "seconds"),
    *("F", "G", "V", "W", "V_joint", "qd", "qdd", "qdd_joints", "h_G", "k_rate"),
)

DOMAINS: dict[str, Domain] = {
    **dict.fromkeys(VECTORS, Vector()),
    **dict.fromkeys(("R", "R_AB", "R_BC"), Rotation()),
    **dict.fromkeys(("I", "I_c", "I_G"), Inertia()),
    **dict.fromkeys(("J", "J_c", "A_G"), Matrix()),
    "M": MassMatrix(),
    "S": Selection(),
    "T": Placement(),
    "m": Mass(),
    "q": Configuration(),
}
"""The chapter's symbols. A model, a list of joints or the name of a foot is left as it is drawn."""

OF_VELOCITIES = frozenset(("M", "J", "J_c", "A_G", "v", "g"))
"""Arguments that have a row or a column for each velocity of a robot."""


def special_cases(part: Part, drawn: tuple[Any, ...], rng: np.random.Generator) -> Sequence[tuple[Any, ...]]:
    """Return cases with a robot without joints, with ball joints, or without mass; with whole numbers; on the moon."""
    names = part.arguments.split(", ")
    found = [_keep_base(names, drawn)]
    if names[:2] == ["model", "q"] and isinstance(drawn[0], Model):
        model, _, *rest = drawn
        robots = (bare_robot(), *ball_robots(), massless_link()) if {*names[2:]} <= {"v", "a", "tau"} else ()
        found += [_moving(robot, names, rng) for robot in robots]
        found += [(model, model.neutral().astype(int), *rest), (replace(model, gravity=MOON_GRAVITY), *drawn[1:])]
    return found


def _keep_base(names: list[str], drawn: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return matrices and vectors of a robot as they are of one without joints; others, and all of Go2's, as is."""
    nv = max((n for x in drawn for n in getattr(x, "shape", ())), default=0)
    if nv <= 6 or {"model", "h"} & {*names}:
        return drawn
    return tuple(
        x[tuple(slice(6 if n == nv else n) for n in x.shape)] if name in OF_VELOCITIES and x.ndim < 3 else x
        for name, x in zip(names, drawn)
    )


def _moving(model: Model, names: list[str], rng: np.random.Generator) -> tuple[Any, ...]:
    """Return a robot with a configuration, and as many numbers as it has velocities for each other name."""
    return model, model.random_configuration(rng=rng), *rng.standard_normal((len(names) - 2, model.nv))


def _floats(q: Any) -> bool:
    """Whether a configuration begins as that of a floating base does."""
    return q.size >= 7 and bool(np.isclose(np.linalg.norm(q[3:7]), 1))

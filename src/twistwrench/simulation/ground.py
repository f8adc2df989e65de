"""The ground, and the points of a robot that may touch it: how high they are, and how fast they move (49.9)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Array, as_exactly, as_number, convert
from ..compiler import Results
from ..compiler.quantities import Quantity, quantities
from ..contact import Contact, PointContact, SphereContact
from ..contact.relative import contact_rows
from ..fast.programs import remembered
from ..model import Model, readonly

__all__ = ["Ground", "check_normals", "ground_terms", "point_forces"]

UP = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Ground:
    """A plane that a robot can stand on, fall on and slide on: points x of the world with n · x = height.

    Parameters
    ----------
    height : float
        Of the plane above the world's origin, along its normal, m.
    normal : array_like, shape (3,), optional
        n, out of the ground, in the axes of the world; any length but 0.
    restitution : float, optional
        e, from 0 to 1: a point that hits the ground at the speed u leaves it with e u along the normal.

    Raises
    ------
    ValueError
        If `height` is not a finite number, `normal` not a direction, or `restitution` not from 0 to 1.

    Examples
    --------
    >>> import twistwrench as tw
    >>> slope = tw.Ground(normal=[0.0, np.sin(0.2), np.cos(0.2)])
    >>> slope.axes[2].round(3)
    array([0.   , 0.199, 0.98 ])
    """

    height: float = 0.0
    normal: tuple[float, float, float] = UP
    restitution: float = 0.0

    def __post_init__(self) -> None:
        if not np.isfinite(as_number(self.height, "height")):
            raise ValueError(f"height: expected a finite number, got {self.height!r}")
        if not 0 <= as_number(self.restitution, "restitution") <= 1:
            raise ValueError(f"restitution: expected a number from 0 to 1, got {self.restitution!r}")
        n = as_exactly(self.normal, "normal", 3)
        if not n.any():
            raise ValueError("normal: expected a direction, got zero")
        n = n / np.abs(n).max()
        object.__setattr__(self, "height", float(self.height))
        object.__setattr__(self, "restitution", float(self.restitution))
        object.__setattr__(self, "normal", tuple((n / np.sqrt(n @ n)).tolist()))

    @cached_property
    def axes(self) -> Array:
        """Two directions along the ground and the normal, as rows in the axes of the world, shape (3, 3)."""
        n = np.array(self.normal)
        along = np.eye(3)[int(np.abs(n[:2]).argmin())]
        along = along - (along @ n) * n
        along /= np.sqrt(along @ along)
        return readonly(np.stack([along, np.cross(n, along), n]))


def check_normals(contacts: Sequence[Contact], ground: Ground) -> None:
    """Raise for what may touch and is not a point or sole at rest, or whose normal is not the ground's."""
    for c in contacts:
        if c.pushes and (c.dim not in (3, 6) or c.velocity or c.acceleration):
            raise ValueError(
                f"contact {c.frame!r}: with ground=, expected points, soles and balls on a ground at rest, got {c!r}"
            )
        if isinstance(c, SphereContact) and not np.allclose(c.normal, ground.normal, 0, 1e-12):
            raise ValueError(f"contact {c.frame!r}: expected normal={ground.normal}, the ground's, got {c.normal}")
        if isinstance(c, PointContact) and c.normal != UP and not np.allclose(c.normal, ground.normal, 0, 1e-12):
            raise ValueError(
                f"contact {c.frame!r}: its normal {c.normal} is not that of the ground, {ground.normal}; "
                "with ground= the ground's counts: leave it out"
            )


def ground_terms(model: Model, q: Array, contacts: Sequence[Contact], ground: Ground) -> Results:
    """Return M, the ``place`` of all contact points and the ``rows`` of their velocities, from one program.

    In the axes of the ground: `place` (..., k, 3) with the height above the plane last, `rows` (..., k, 3, nv).
    """

    def asked() -> list[Quantity]:
        return [
            quantities(model, q.dtype)["M"],
            Quantity("place", ("q",), lambda q: (point_terms(model, q, contacts)[0], [])),
            Quantity("rows", ("q",), lambda q: (point_terms(model, q, contacts)[1], [])),
        ]

    found: Results = remembered(model, ("ground", q.dtype, tuple(contacts)), q.dtype, asked)(q)
    found.place = found.place @ ground.axes.mT - np.array([0.0, 0.0, ground.height])
    found.rows = ground.axes @ found.rows
    return found


def point_terms(model: Model, q: Array, contacts: Sequence[Contact]) -> tuple[Array, Array]:
    """Return where the contact points are, and the rows of their velocities, in the axes of the world."""
    places, rows = [np.zeros((*q.shape[:-1], 0, 3), q.dtype)], [np.zeros((*q.shape[:-1], 0, 3, model.nv), q.dtype)]
    found, end = contact_rows(model, q, np.zeros((*q.shape[:-1], model.nv), q.dtype), contacts), 0
    for c, T in zip(contacts, found.placement):
        J = found.J[..., end : (end := end + c.dim), :]
        for point in c.points:
            arm = np.matvec(convert(c.axes(T.rotation), q.dtype), convert(point, q.dtype))
            moves = J if c.dim == 3 else J[..., 3:, :] + np.cross(J[..., :3, :], arm[..., None], axis=-2)
            places.append((T.translation + arm)[..., None, :])
            rows.append(moves[..., None, :, :])
    return np.concatenate(places, axis=-2), np.concatenate(rows, axis=-3)


def point_forces(contacts: Sequence[Contact], place: Array, force: Array, ground: Ground) -> dict[str, Array]:
    """Return λ by the contact's frame, in the axes of the world, of forces (..., k, 3) in those of the ground."""
    end, forces = 0, {}
    for c in contacts:
        points = slice(end, end := end + len(c.points))
        f = force[..., points, :] @ ground.axes
        arm = (place[..., points, :] - place[..., points, :].mean(axis=-2, keepdims=True)) @ ground.axes
        moment = np.cross(arm, f).sum(axis=-2)
        forces[c.frame] = np.concatenate([moment, f.sum(axis=-2)], axis=-1)[..., c.rows]
    return forces

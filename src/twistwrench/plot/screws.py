"""Screw axes, and the velocity field of a rigid motion (49.2)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_arrays, as_exactly, without_overflow
from ..errors import ShapeError
from ..spatial import Twist, Wrench, screw
from ..spatial._vector import as_spatial
from .frames import arrows
from .style import COLOURS, as_drawable, as_drawable_number, axes_3d, fit
from .words import word

__all__ = ["point_velocity", "screw_axis", "twist_field"]


@without_overflow("V, points")
def point_velocity(V: Twist | ArrayLike, points: ArrayLike) -> Array:
    """Return the velocities v + ω × p of the points of a body (49.1).

    Parameters
    ----------
    V : Twist or array_like of shape (..., 6)
        (ω, v), rad/s and m/s.
    points : array_like, shape (..., 3)
        In the frame of `V`, m.

    Returns
    -------
    ndarray, shape (..., 3)
        In the frame of `V`, m/s.

    Raises
    ------
    ShapeError
        If a last axis is not 6 or 3 long.
    TypeError
        If `V` is a Wrench.

    Examples
    --------
    >>> point_velocity([0, 0, 2, 0, 0, 0], [1, 0, 0])
    array([0., 2., 0.])
    """
    V, p = as_arrays(V=(as_spatial(V, "V"), (6,)), points=(points, (3,)))
    try:
        np.broadcast_shapes(V.shape[:-1], p.shape[:-1])
    except ValueError:
        raise ShapeError(f"V and points: shapes {V.shape} and {p.shape} do not broadcast") from None
    return np.asarray(V[..., 3:] + np.cross(V[..., :3], p))


def screw_axis(
    V: Twist | Wrench | ArrayLike,
    *,
    length: float = 1.0,
    near: ArrayLike = (0.0, 0.0, 0.0),
    colour: str = COLOURS["blue"],
    label: str | None = None,
    ax: Any = None,
) -> Any:
    """Draw the axis of a twist, or of a wrench, as a dashed line with an arrow along it.

    Parameters
    ----------
    V : Twist, Wrench or array_like of shape (6,)
        (ω, v), rad/s and m/s, or (τ, f), N m and N. A plain array is a twist.
    length : float
        Of the line, m.
    near : array_like, shape (3,)
        The middle of the line is the point of the axis nearest to this, m; a dot marks it.
    colour : str
    label : str, optional
        For the legend.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    ShapeError, SingularError
        As `twistwrench.screw`; or if `V` is a batch, or `near` is not a point.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ax = screw_axis([0, 0, 1, 0, -1, 0], length=2, ax=Figure().add_subplot(projection="3d"))
    >>> np.stack(ax.lines[0].get_data_3d(), axis=-1) + 0.0
    array([[ 1.,  0., -1.],
           [ 1.,  0.,  1.]])
    """
    length = as_drawable_number(length, "length")
    x = as_drawable(V, "V", 6)
    kind = "wrench" if isinstance(V, Wrench) else "twist"
    if x.ndim != 1:
        raise ShapeError(f"V: expected one {kind}, got a batch of shape {x.shape[:-1]}")
    axis, point = (part.astype(float) for part in screw(V if kind == "wrench" else x)[:2])
    point = point + axis * (axis * (as_drawable(as_exactly(near, "near", 3), "near") - point)).sum(-1)
    ax = axes_3d(ax)
    ends = point + length / 2 * np.stack([-axis, axis])
    ax.plot(*ends.mT, "--", color=colour, linewidth=1.6, label=label)
    ax.plot(*point[:, None], "o", color=colour, markersize=5)
    return arrows(ends[1], axis, scale=0.15 * length, colour=colour, ax=ax)


def twist_field(
    V: Twist | ArrayLike,
    points: ArrayLike,
    *,
    scale: float = 1.0,
    colour: str = COLOURS["sky"],
    label: str | None = "velocity",
    ax: Any = None,
) -> Any:
    """Draw the velocities that a twist gives to points, v + ω × p, as arrows.

    Parameters
    ----------
    V : Twist or array_like of shape (6,)
        (ω, v), rad/s and m/s.
    points : array_like, shape (..., 3)
        In the frame of `V`, m.
    scale : float
        Metres in the picture for 1 m/s.
    colour : str
    label : str, optional
        For the legend.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    ShapeError, TypeError
        As `point_velocity`.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ax = Figure().add_subplot(projection="3d")
    >>> twist_field([0, 0, 1, 0, 0, 0], [[1, 0, 0], [0, 1, 0]], ax=ax) is ax
    True
    """
    p = as_drawable(points, "points", 3)
    scale = as_drawable_number(scale, "scale")
    V = as_drawable(as_spatial(V, "V"), "V", 6)
    label = label and word(label)
    return fit(arrows(p, point_velocity(V, p), scale=scale, colour=colour, label=label, ax=ax))

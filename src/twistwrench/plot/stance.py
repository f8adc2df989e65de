"""A robot on its feet: support polygon, forces of the ground (49.9)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import frame_placement
from ..arrays import Array, as_exactly, as_names
from ..errors import ShapeError
from ..model import Model, one_configuration
from .frames import arrows
from .robot import robot
from .style import COLOURS, as_drawable, as_drawable_number, axes_3d, fit, newtons
from .words import word

__all__ = ["foot_forces", "hull", "support_polygon"]


def hull(points: ArrayLike) -> Array:
    """Return the corners of the smallest convex polygon around points, seen from above.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3)
        Only x and y are used, m.

    Returns
    -------
    ndarray, shape (k, 2) or (k, 3)
        Those of `points` that are corners, anticlockwise, from the one with the least x.

    Raises
    ------
    ShapeError
        If these are not points.

    Notes
    -----
    A. M. Andrew's monotone chain: the lower side from left to right, the upper side back.

    Examples
    --------
    >>> hull([[0, 0], [1, 1], [1, 0], [0, 1], [0.5, 0.5]])
    array([[0., 0.],
           [1., 0.],
           [1., 1.],
           [0., 1.]])
    """
    p = as_drawable(points, "points")
    p = as_drawable(p, "points", 3 if p.shape[-1:] == (3,) else 2)
    if p.ndim != 2:
        raise ShapeError(f"points: expected shape (n, 2) or (n, 3), got {p.shape}")
    ordered = np.unique(p, axis=0)  # by x, then y
    return np.concatenate([_side(ordered), _side(ordered[::-1])]) if len(ordered) > 1 else ordered


def _side(points: Array) -> Array:
    """Return the corners of one side, without the last: only left turns are kept."""
    kept: list[Array] = []
    for p in points:
        while len(kept) > 1 and _turn(kept[-2], kept[-1], p) <= 0:
            kept.pop()
        kept.append(p)
    return np.array(kept[:-1])


def _turn(a: Array, b: Array, c: Array) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def support_polygon(
    points: ArrayLike,
    com: ArrayLike | None = None,
    *,
    colour: str = COLOURS["sky"],
    label: str | None = "support polygon",
    ax: Any = None,
) -> Any:
    """Draw the polygon between contacts, and the plumb line from the centre of mass down to its height.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        The contacts, m.
    com : array_like, shape (3,), optional
        Centre of mass, m.
    colour : str
    label : str, optional
        For the legend.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    ShapeError
        If these are not points, or the array is empty.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    >>> ax = support_polygon(corners, [0.2, 0.2, 0.5], ax=Figure().add_subplot(projection="3d"))
    >>> len(ax.collections), len(ax.lines)
    (1, 3)
    """
    p = as_drawable(points, "points", 3)
    if p.ndim != 2 or not len(p):
        raise ShapeError(f"points: expected shape (n, 3) with n of at least 1, got {p.shape}")
    corners = hull(p)
    ax = axes_3d(ax)
    ax.plot(*np.concatenate([corners, corners[:1]]).mT, color=colour, linewidth=1.5, label=label and word(label))
    if len(corners) > 2:
        fan = [(0, k, k + 1) for k in range(1, len(corners) - 1)]
        ax.plot_trisurf(*corners.mT, triangles=fan, color=colour, alpha=0.35, linewidth=0, shade=False)
    if com is not None:
        c = as_drawable(as_exactly(com, "com", 3), "com")
        floor = np.array([c[0], c[1], corners[:, 2].mean()])
        ax.plot(*np.stack([c, floor], axis=-1), ":", color=COLOURS["purple"], linewidth=1.5)
        ax.plot(*floor[:, None], "o", color=COLOURS["purple"], markersize=5)
    return fit(ax, corners)


def foot_forces(
    model: Model,
    q: ArrayLike,
    forces: ArrayLike,
    contacts: Sequence[str] | None = None,
    *,
    scale: float = 0.004,
    label: str | None = "force of the ground",
    ax: Any = None,
) -> Any:
    """Draw a robot on its support polygon, with the forces of the ground on its contacts.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    forces : array_like, shape (k, 3)
        In the axes of the world, N. The vertical part is written at each.
    contacts : sequence of str, optional
        The k frames on which they act; `model.feet` unless given.
    scale : float
        Metres in the picture for 1 N.
    label : str, optional
        For the legend.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    ShapeError, ValueError
        As `robot`; or if there is not one force for each contact.
    NameNotFound
        If the model has no such frame.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> model = tw.load("go2")
    >>> q, ax = model.standing(), Figure().add_subplot(projection="3d")
    >>> ax = foot_forces(model, q, tw.static_equilibrium(model, q).forces, ax=ax)
    >>> [text.get_text().strip() for text in ax.texts]
    ['39.1 N', '39.1 N', '39.8 N', '39.8 N']
    """
    scale = as_drawable_number(scale, "scale")
    q = one_configuration(model, q)
    contacts = model.feet if contacts is None else as_names(contacts, "contacts", "frame names", ordered=True)
    f = as_drawable(as_exactly(forces, "forces", len(contacts), 3), "forces")
    places = np.array([frame_placement(model, q, name).translation for name in contacts], dtype=float)
    ax = robot(model, q, ax=ax)
    support_polygon(places, center_of_mass(model, q), ax=ax)
    texts = [newtons(vertical) for vertical in f[:, 2]]
    return arrows(places, f, scale=scale, texts=texts, label=label and word(label), ax=ax)

"""Frames and arrows in space (49.2, 49.3)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import as_names
from ..errors import ShapeError
from ..spatial import SE3
from .style import COLOURS, XYZ, as_drawable, as_drawable_number, as_placement, axes_3d, fit

__all__ = ["arrows", "triad"]


def triad(T: SE3 | ArrayLike, name: str = "", *, size: float = 0.1, ax: Any = None) -> Any:
    """Draw a frame as its three unit vectors: x vermilion, y green, z blue.

    Parameters
    ----------
    T : SE3 or array_like of shape (4, 4)
        Placement of the frame in the frame of the picture.
    name : str
        Written at its origin.
    size : float
        Length of the three, m.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    ShapeError
        If `T` is a batch.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ax = triad(SE3.identity(), "world", ax=Figure().add_subplot(projection="3d"))
    >>> len(ax.lines), ax.texts[0].get_text().strip()
    (3, 'world')
    """
    size, T = as_drawable_number(size, "size"), as_placement(T, "T")
    if T.translation.ndim != 1:
        raise ShapeError(f"T: expected one placement, got a batch of shape {T.translation.shape[:-1]}")
    ax = axes_3d(ax)
    origin = T.translation.astype(float)
    for axis, colour in zip(T.rotation.mT.astype(float), XYZ):  # column k of R is axis k
        ax.plot(*np.stack([origin, origin + size * axis], axis=-1), color=colour, linewidth=2)
    if str(name):
        ax.text(*origin, f" {name}", fontsize=9, verticalalignment="top")
    return fit(ax)


def arrows(
    points: ArrayLike,
    vectors: ArrayLike,
    *,
    scale: float = 1.0,
    colour: str = COLOURS["vermilion"],
    label: str | None = None,
    texts: Sequence[str] = (),
    ax: Any = None,
) -> Any:
    """Draw vectors as arrows that start at points: forces, velocities.

    Parameters
    ----------
    points : array_like, shape (..., 3)
        Where they start, m.
    vectors : array_like, shape (..., 3)
        In any unit.
    scale : float
        Metres in the picture for one unit of `vectors`.
    colour : str
    label : str, optional
        What the arrows are, with the unit; for the legend.
    texts : sequence of str
        Written at the tips, one for each.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    ShapeError
        If a last axis is not 3 long, or the others do not broadcast, or there is not one text for each arrow.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ax = Figure().add_subplot(projection="3d")
    >>> arrows([0, 0, 0], [0, 0, 40], scale=0.01, texts=["40 N"], ax=ax).texts[0].get_position_3d()
    (np.float64(0.0), np.float64(0.0), np.float64(0.4))
    """
    scale = as_drawable_number(scale, "scale")
    p, x = as_drawable(points, "points", 3), as_drawable(vectors, "vectors", 3)
    texts = as_names(texts, "texts", "texts", ordered=True)
    try:
        p, x = (a.reshape(-1, 3) for a in np.broadcast_arrays(p, x))
    except ValueError:
        raise ShapeError(f"points and vectors: shapes {p.shape} and {x.shape} do not broadcast") from None
    if len(texts) not in (0, len(p)):
        raise ShapeError(f"texts: expected one for each of {len(p)} arrows, got {len(texts)}")
    ax = axes_3d(ax)
    tips = p + scale * x
    ax.quiver(*p.mT, *(scale * x).mT, color=colour, label=label, arrow_length_ratio=0.15, linewidth=1.6)
    for tip, text in zip(tips, texts):
        ax.text(*tip, f" {text}", color=colour, fontsize=9)
    return fit(ax, np.concatenate([p, tips]))

"""What all pictures share: colours, and axes on which a metre is a metre in every direction."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_exactly, as_finite, as_real
from ..spatial import SE3

__all__ = [
    "COLOURS",
    "NO_MATPLOTLIB",
    "XYZ",
    "as_drawable",
    "as_drawable_number",
    "as_placement",
    "axes_2d",
    "axes_3d",
    "fit",
    "newtons",
]

MAX_DRAWN_VALUE = 1e100
"""Larger values cannot be drawn: their products overflow."""

COLOURS = {
    "black": "#000000",
    "orange": "#E69F00",
    "sky": "#56B4E9",
    "green": "#009E73",
    "yellow": "#F0E442",
    "blue": "#0072B2",
    "vermilion": "#D55E00",
    "purple": "#CC79A7",
    "grey": "#808080",
}
"""Colours that people with any kind of colour vision tell apart (Okabe and Ito), and a grey."""

XYZ = (COLOURS["vermilion"], COLOURS["green"], COLOURS["blue"])
"""Of the axes x, y, z of a frame."""

NO_MATPLOTLIB = 'a picture needs matplotlib: pip install "twistwrench[plot]"'


def axes_2d(ax: Any = None, *, size: tuple[float, float] = (6.0, 3.5)) -> Any:
    """Return flat axes to draw on: those given, or those of a new figure.

    Parameters
    ----------
    ax : matplotlib Axes, optional
    size : (float, float)
        Width and height of a new figure, inches.

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ax = Figure().add_subplot()
    >>> axes_2d(ax) is ax
    True
    """
    if ax is not None:
        _check_axes(ax)
        return ax
    return _pyplot().subplots(figsize=_size(size), layout="constrained")[1]


def axes_3d(ax: Any = None, *, size: tuple[float, float] = (6.5, 5.0)) -> Any:
    """Return spatial axes to draw on, labelled in metres: those given, or those of a new figure.

    Parameters
    ----------
    ax : matplotlib Axes3D, optional
    size : (float, float)
        Width and height of a new figure, inches.

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    TypeError
        If `ax` is flat.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> axes_3d(Figure().add_subplot(projection="3d")).get_zlabel()
    'z [m]'
    """
    if ax is None:
        ax = _pyplot().figure(figsize=_size(size), layout="constrained").add_subplot(projection="3d")
        ax.view_init(elev=20, azim=-60)
    _check_axes(ax)
    if not hasattr(ax, "get_zlabel"):
        raise TypeError(f"ax: expected axes with projection='3d', got {type(ax).__name__}")
    ax.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
    return ax


def _check_axes(ax: Any) -> None:
    """Raise for an object that is not axes."""
    from matplotlib.axes import Axes

    if not isinstance(ax, Axes):
        raise TypeError(f"ax: expected matplotlib axes, got {type(ax).__name__} {ax!r}")


def _size(size: Any) -> Any:
    """Check width and height of a figure."""
    width, height = as_exactly(size, "size", 2)
    if not (0 < width < 1000 and 0 < height < 1000):
        raise ValueError(f"size: expected width and height in inches, from 0 to 1000, got {size}")
    return width, height


def as_drawable(value: ArrayLike, name: str, *tail: int) -> Array:
    """Convert what is to be drawn to float64: real, finite and small enough, with these last axes.

    Examples
    --------
    >>> as_drawable([0, 0, 1e300], "point", 3)
    Traceback (most recent call last):
    ValueError: point: expected at most 1e+100, which can be drawn, got 1e+300
    """
    x = as_real(value, name, *tail)
    if np.abs(x).max(initial=0) > MAX_DRAWN_VALUE:
        raise ValueError(
            f"{name}: expected at most {MAX_DRAWN_VALUE:.0e}, which can be drawn, got {np.abs(x).max():.3g}"
        )
    return x


def as_drawable_number(value: object, name: str) -> float:
    """Return a number that is to be drawn: see `as_drawable`.

    Examples
    --------
    >>> as_drawable_number(np.inf, "scale")
    Traceback (most recent call last):
    ValueError: scale: expected a finite number, got inf
    """
    return float(as_drawable(as_finite(value, name), name))


def as_placement(T: SE3 | ArrayLike, name: str) -> SE3:
    """Return a placement, made from its 4 × 4 matrix where that was given."""
    return T if isinstance(T, SE3) else SE3.from_matrix(as_array(T, name, 4, 4))


def _pyplot() -> Any:
    """Return matplotlib.pyplot, or raise an error with the command that installs it."""
    try:
        import matplotlib.pyplot as plt
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(NO_MATPLOTLIB, name=error.name) from None
    return plt


def fit(ax: Any, points: ArrayLike | None = None) -> Any:
    """Set the limits to what has been drawn, with one scale on all three axes.

    Parameters
    ----------
    ax : matplotlib Axes3D
    points : array_like, shape (..., 3), optional
        What else must be in the picture, m.

    Returns
    -------
    matplotlib Axes3D
        `ax`.

    Raises
    ------
    ShapeError, ValueError
        If `points` are not points.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ax = axes_3d(Figure().add_subplot(projection="3d"))
    >>> low, high = fit(ax, [[0, 0, 0], [1, 2, 4]]).get_zlim()
    >>> bool(low <= 0 < 4 <= high)
    True
    """
    if not hasattr(ax, "get_zlabel"):
        raise TypeError(f"ax: expected axes with projection='3d', got {type(ax).__name__}")
    if points is not None:
        p = as_drawable(points, "points", 3).reshape(-1, 3)
        ax.auto_scale_xyz(p[:, 0], p[:, 1], p[:, 2], had_data=ax.has_data())
    ax.set_aspect("equal")
    axes = (ax.xaxis, ax.yaxis, ax.zaxis)
    spans = [np.ptp(axis.get_view_interval()) for axis in axes]
    for axis, span in zip(axes, spans):
        axis.set_major_locator(_few_ticks(max(span, max(spans) / 4)))  # a flat robot's axis has no room for more
    return ax


def _few_ticks(span: float) -> Any:
    """Ticks 0.1, 0.2 or 0.5 times a power of ten apart, four at most: short axes would crowd them."""
    from matplotlib.ticker import MultipleLocator

    steps = np.array([1, 2, 5, 10, 20, 50]) * 10.0 ** (np.floor(np.log10(span)) - 1)
    return MultipleLocator(float(steps[np.argmax(span / steps <= 4)]))


def newtons(force: float) -> str:
    """Write a force: one decimal from 1 N on, below that three digits, so that only zero reads as zero.

    Examples
    --------
    >>> newtons(39.14), newtons(0.00345), newtons(0.0)
    ('39.1 N', '0.00345 N', '0 N')
    """
    return f"{force:.1f} N" if abs(force) >= 1 else f"{force:.3g} N"

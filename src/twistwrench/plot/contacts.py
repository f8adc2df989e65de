"""Contacts: the friction cone of a point, the centre of pressure of a sole (49.4)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import as_exactly
from ..errors import ShapeError
from ..spatial import Wrench, center_of_pressure
from ..spatial._vector import as_spatial
from .style import COLOURS, as_drawable, as_drawable_number, axes_2d, axes_3d, fit

__all__ = ["friction_cone", "sole"]


def friction_cone(
    point: ArrayLike,
    mu: float,
    *,
    height: float = 0.1,
    colour: str = COLOURS["sky"],
    label: str | None = None,
    ax: Any = None,
) -> Any:
    """Draw the cone √(f_x² + f_y²) ≤ μ f_z of the forces that a contact can bear without slipping.

    Parameters
    ----------
    point : array_like, shape (3,)
        The contact, on a floor across z, m.
    mu : float
        Coefficient of friction.
    height : float
        Of the picture of the cone, m.
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
        If `point` is not a point.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ax = friction_cone([0, 0, 0], 0.6, height=1.0, ax=Figure().add_subplot(projection="3d"))
    >>> rim = np.stack(ax.lines[0].get_data_3d(), axis=-1)
    >>> np.hypot(rim[:, 0], rim[:, 1]).max().round(3), rim[0, 2]
    (np.float64(0.6), np.float64(1.0))
    """
    mu = as_drawable_number(mu, "mu")
    height = as_drawable_number(height, "height")
    p = as_drawable(as_exactly(point, "point", 3), "point")
    angle = np.linspace(0, 2 * np.pi, 49)
    rim = p + height * np.stack([mu * np.cos(angle), mu * np.sin(angle), np.ones(49)], axis=-1)
    ax = axes_3d(ax)
    ax.plot(*rim.mT, color=colour, linewidth=1.2, label=label)
    x, y, z = np.stack([np.broadcast_to(p, rim.shape), rim]).transpose(2, 0, 1)
    ax.plot_surface(x, y, z, color=colour, alpha=0.25, linewidth=0)
    return fit(ax, rim)


def sole(
    corners: ArrayLike,
    F: Wrench | ArrayLike | None = None,
    *,
    text: str = "",
    colour: str = COLOURS["vermilion"],
    ax: Any = None,
) -> Any:
    """Draw a sole from above, and on it the centre of pressure of a wrench.

    Parameters
    ----------
    corners : array_like, shape (n, 3)
        Of the sole, one after the other around it, in its frame, m.
    F : Wrench or array_like of shape (6,), optional
        (τ, f) of the ground on the foot, in the frame of the sole, N m and N.
    text : str
        Written beside the centre of pressure.
    colour : str
        Of the centre of pressure.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes
        x points up, as the foot does, and y to the left.

    Raises
    ------
    ShapeError, SingularError, TypeError
        As `center_of_pressure`; or if `corners` are not points, or `F` is a batch.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> corners = [[0.1, 0.05, 0], [0.1, -0.05, 0], [-0.1, -0.05, 0], [-0.1, 0.05, 0]]
    >>> ax = sole(corners, [0, -1, 0, 0, 0, 100], ax=Figure().add_subplot())
    >>> ax.lines[0].get_xydata()  # (y, x)
    array([[0.  , 0.01]])
    """
    c = as_drawable(corners, "corners", 3)
    if c.ndim != 2:
        raise ShapeError(f"corners: expected shape (n, 3), got {c.shape}")
    ax = axes_2d(ax, size=(3.0, 4.0))
    ax.fill(c[:, 1], c[:, 0], facecolor="0.92", edgecolor=COLOURS["black"], linewidth=1.2)
    ax.set(xlabel="y [m]", ylabel="x [m]", aspect="equal")
    ax.xaxis.set_inverted(True)
    if F is not None:
        x, y, _ = as_drawable(center_of_pressure(as_exactly(as_spatial(F, "F"), "F", 6)), "F")
        ax.plot(y, x, "o", color=colour, markersize=8)
        ax.annotate(text, (y, x), xytext=(6, 4), textcoords="offset points", fontsize=8)
    return ax

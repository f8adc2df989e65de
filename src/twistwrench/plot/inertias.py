"""Inertias as ellipsoids, and the apparent mass in each direction as an ellipse (49.5, 49.7)."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.kinematics import forward_kinematics
from ..arrays import Array, as_exactly, as_finite, as_names, as_number, as_sequence
from ..errors import ShapeError
from ..model import Model, one_configuration
from ..spatial import SE3, SpatialInertia
from .style import COLOURS, as_drawable, as_drawable_number, as_placement, axes_2d, axes_3d, fit

__all__ = ["apparent_mass_ellipse", "ellipsoid", "ellipsoids", "semi_axes"]


def semi_axes(inertia: SpatialInertia | ArrayLike, link: str = "body") -> tuple[Array, Array]:
    """Return the ellipsoid of uniform density that moves as the body does: same mass, same moments of inertia (49.5).

    Parameters
    ----------
    inertia : SpatialInertia or array_like of shape (6, 6)
        One body.
    link : str
        Its name, for the error.

    Returns
    -------
    lengths : ndarray, shape (3,)
        aᵢ = √(5 (tr I_c − 2 Iᵢ) / 2m), ascending, m.
    axes : ndarray, shape (3, 3)
        The principal axes as columns, in the frame of the inertia.

    Raises
    ------
    ShapeError
        If `inertia` is a batch.
    ModelError
        If no body has this inertia: one of the lengths would be imaginary.

    Examples
    --------
    A ball of 2 kg and 0.1 m radius has 2/5 m r² about each axis:

    >>> lengths, _ = semi_axes(SpatialInertia(2.0, [0, 0, 0], 0.008 * np.eye(3)))
    >>> lengths.round(12)
    array([0.1, 0.1, 0.1])
    """
    inertia = _as_inertia(inertia)
    if inertia.mass.ndim:
        raise ShapeError(f"inertia: expected one body, got a batch of shape {inertia.mass.shape}")
    inertia.check_physical(link)
    moments, axes = np.linalg.eigh(inertia.inertia_at_com.astype(float))
    squares = 5 * (moments.sum() - 2 * moments) / (2 * float(inertia.mass))
    return np.sqrt(np.maximum(squares[::-1], 0)), axes[:, ::-1]  # the largest moment has the shortest axis


def _as_inertia(inertia: SpatialInertia | ArrayLike) -> SpatialInertia:
    """Return the inertia, made from its matrix where that was given."""
    if isinstance(inertia, SpatialInertia):
        return inertia
    return SpatialInertia.from_matrix(as_exactly(inertia, "inertia", 6, 6))


def ellipsoid(
    inertia: SpatialInertia | ArrayLike,
    T: SE3 | ArrayLike | None = None,
    name: str = "",
    *,
    colour: str = COLOURS["sky"],
    alpha: float = 0.6,
    ax: Any = None,
) -> Any:
    """Draw a body as the uniform ellipsoid with its mass, its centre of mass and its moments of inertia.

    Parameters
    ----------
    inertia : SpatialInertia or array_like of shape (6, 6)
        One body.
    T : SE3 or array_like of shape (4, 4), optional
        Placement of its frame in the frame of the picture.
    name : str
        Written at the centre of mass, and in the error.
    colour : str
    alpha : float
        1 is opaque.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    ShapeError, ModelError
        As `semi_axes`.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ball = SpatialInertia(2.0, [0, 0, 0.5], 0.008 * np.eye(3))
    >>> ax = ellipsoid(ball, name="ball", ax=Figure().add_subplot(projection="3d"))
    >>> ax.texts[0].get_position_3d()
    (np.float64(0.0), np.float64(0.0), np.float64(0.5))
    """
    alpha = as_finite(alpha, "alpha")
    name = str(name)
    inertia = _as_inertia(inertia)
    placed = inertia if T is None else inertia.transform(as_placement(T, "T"))
    lengths, axes = semi_axes(placed, name or "body")
    azimuth, height = np.meshgrid(np.linspace(0, 2 * np.pi, 25), np.linspace(0, np.pi, 13))
    sphere = np.stack([np.cos(azimuth) * np.sin(height), np.sin(azimuth) * np.sin(height), np.cos(height)])
    com = placed.com.astype(float)
    x, y, z = com[:, None, None] + np.einsum("ij,jkl->ikl", axes * lengths, sphere)
    ax = axes_3d(ax)
    ax.plot_surface(x, y, z, color=colour, alpha=alpha, linewidth=0, rcount=13, ccount=25)
    if name:
        ax.text(*com, name, fontsize=9)
    return fit(ax, np.stack([x, y, z], axis=-1))


def ellipsoids(
    model: Model,
    q: ArrayLike,
    *,
    names: Collection[str] = (),
    colour: str = COLOURS["sky"],
    ax: Any = None,
) -> Any:
    """Draw every moving body of a robot as its ellipsoid; bodies without mass are left out.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    names : collection of str
        Joints whose names are written at the bodies that they move.
    colour : str
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    NameNotFound
        If the model has no such joint.
    ShapeError, ModelError, ValueError
        As `Model.state` and `semi_axes`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> model = tw.load("double_pendulum")
    >>> ax = ellipsoids(model, model.neutral(), ax=Figure().add_subplot(projection="3d"))
    >>> len(ax.collections)
    2
    """
    placement = forward_kinematics(model, one_configuration(model, q)).placement
    labels = {model.joint_id(name): name for name in as_names(names, "names", "joint names")}
    ax = axes_3d(ax)
    for i in range(1, model.nbodies):
        if model.inertia[i].mass > 0:
            model.inertia[i].check_physical(model.joint_names[i])
            ellipsoid(model.inertia[i], placement[i], labels.get(i, ""), colour=colour, ax=ax)
    return ax


def apparent_mass_ellipse(
    inertia: ArrayLike,
    at: ArrayLike = (0.0, 0.0),
    *,
    plane: tuple[int, int] = (0, 2),
    scale: float = 1.0,
    colour: str = COLOURS["blue"],
    label: str | None = None,
    ax: Any = None,
) -> Any:
    """Draw the force that accelerates a frame by 1 m/s² without turning it, for each direction in a plane.

    Of a rigid body it is a circle: its mass, whatever the direction. Of an articulated body it is an ellipse.

    Parameters
    ----------
    inertia : array_like, shape (6, 6)
        Spatial inertia, rigid or articulated, of which the last three rows and columns are drawn.
    at : array_like, shape (2,)
        Where in the picture, m.
    plane : (int, int)
        The axes of the frame that lie across and along the picture; x and z unless given.
    scale : float
        Metres in the picture for 1 kg.
    colour : str
    label : str, optional
        For the legend.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ShapeError
        If `inertia` is not one 6 × 6 matrix, or `at` is not a point of the picture.
    ValueError
        If `plane` is not two of the axes 0, 1, 2.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> body = SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.01, 0.01, 0.005]))
    >>> ax = apparent_mass_ellipse(body.matrix(), ax=Figure().add_subplot())
    >>> np.linalg.norm(ax.lines[0].get_xydata(), axis=-1).round(12).max()
    np.float64(2.0)
    """
    scale = as_drawable_number(scale, "scale")
    axes = [as_number(k, "plane") for k in as_sequence(plane, "plane", "axes")]
    if not len(axes) == 2 == len({0, 1, 2} & set(axes)):
        raise ValueError(f"plane: expected two of the axes 0, 1, 2, got {plane}")
    M = as_drawable(as_exactly(inertia, "inertia", 6, 6), "inertia")
    block = M[np.ix_(3 + np.array(axes, int), 3 + np.array(axes, int))]
    angle = np.linspace(0, 2 * np.pi, 73)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    curve = as_drawable(as_exactly(at, "at", 2), "at") + scale * circle @ block.mT
    new = ax is None
    ax = axes_2d(ax)
    if new:
        unit = "kg" if scale == 1 else f"m, {scale:g} for a kg"
        ax.set(xlabel=f"{'xyz'[int(axes[0])]} [{unit}]", ylabel=f"{'xyz'[int(axes[1])]} [{unit}]")
    ax.plot(*curve.mT, color=colour, label=label, linewidth=1.8)
    ax.set_aspect("equal")
    return ax

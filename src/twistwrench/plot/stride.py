"""A robot from the side, one posture or the frames of a stride (49.10), and from above (49.2)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import forward_kinematics
from ..arrays import Array
from ..model import Model
from .robot import sticks
from .stance import hull
from .style import COLOURS, as_drawable_number, axes_2d

__all__ = ["side_view", "sides", "top_view"]

MIDDLE_SHARE = 0.25
"""Nearer to the plane of symmetry than this share of the widest stick, a stick is on neither side."""


def side_view(model: Model, q: ArrayLike, *, shift: float = 0.0, com: bool = True, ax: Any = None) -> Any:
    """Draw a robot as a stick figure seen against the y axis of the world, x to the right and z up.

    The limbs on the robot's own left are blue, those on its right vermilion, wherever it stands and however it moves:
    which side they are on is read off the neutral configuration. What is nearer is in front.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    shift : float
        Added to x, so that several postures stand side by side, m.
    com : bool
        Whether to mark the centre of mass; not drawn for a robot without mass.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ShapeError, ValueError
        As `sticks`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> model = tw.load("go2")
    >>> ax = side_view(model, model.standing(), shift=1.0, ax=Figure().add_subplot())
    >>> len(ax.lines)  # sixteen sticks, and the centre of mass
    17
    """
    shift = as_drawable_number(shift, "shift")
    ax = axes_2d(ax, size=(10.0, 2.6))
    lines = sticks(model, q)
    side = sides(model)
    for k in np.argsort(-lines[..., 1].mean(axis=-1)):  # the far ones first
        colour = COLOURS[("grey", "blue", "vermilion")[side[k]]]
        ax.plot(lines[k, :, 0] + shift, lines[k, :, 2], color=colour, linewidth=3, solid_capstyle="round")
    if com and model.mass > 0:
        c = center_of_mass(model, q).astype(float)
        ax.plot(c[0] + shift, c[2], "x", color=COLOURS["purple"], markersize=7, markeredgewidth=2)
    ax.set(xlabel="x [m]", ylabel="z [m]", aspect="equal")
    return ax


def top_view(model: Model, q: ArrayLike, *, colour: str = COLOURS["grey"], ax: Any = None) -> Any:
    """Draw a robot as a stick figure seen from above, x to the right and y up.

    What stands on the base, such as legs or arms, is joined to it by a filled outline: the trunk. A wedge on it points
    where the x axis of the base points, which tells the front from the back.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    colour : str
        Of the sticks and of the trunk.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ShapeError, ValueError
        As `sticks`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> model = tw.load("go2")
    >>> ax = top_view(model, model.standing(), ax=Figure().add_subplot())
    >>> len(ax.lines)  # three sticks for each leg; the trunk is an outline
    12
    """
    lines, T = sticks(model, q)[..., :2], forward_kinematics(model, q).placement
    ax = axes_2d(ax, size=(5.0, 5.0))
    if model.base == "floating":
        joints = [i for i in range(2, model.nbodies) if model.parent[i] == 1]
        lines = np.delete(lines, [i - 2 for i in joints], axis=0)  # from the base to them
        base = T[1].translation[:2].astype(float)
        trunk = hull([base, *(T[i].translation[:2] for i in joints)])
        ax.fill(*trunk.mT, facecolor=colour, edgecolor=colour, alpha=0.35, linewidth=3, joinstyle="round")
        ahead = T[1].rotation[:2, 0].astype(float)
        across = np.array([-ahead[1], ahead[0]])
        front, reach = ((trunk - base) @ ahead).max(), np.abs(trunk - base).max()
        wedge = np.array([[front, reach / 2], [front + 0.6 * reach, 0], [front, -reach / 2]])
        ax.fill(*(base + wedge @ np.stack([ahead, across])).mT, color=colour)
    for line in lines:
        ax.plot(*line.mT, color=colour, linewidth=3, solid_capstyle="round")
    ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    return ax


def sides(model: Model) -> Array:
    """Return for each stick 1 on the robot's left, −1 on its right, 0 in the middle, as it is in neutral."""
    left = sticks(model, model.neutral())[..., 1].mean(axis=-1)
    return np.asarray(np.sign(left) * (np.abs(left) > 1e-6 + MIDDLE_SHARE * np.abs(left).max(initial=0)), int)

"""A robot from the side: one posture, or the frames of a stride (49.10)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..centroidal import center_of_mass
from ..checks import as_number
from ..model import Model
from .robot import sticks
from .style import COLOURS, axes_2d

__all__ = ["side_view"]


def side_view(model: Model, q: ArrayLike, *, shift: float = 0.0, com: bool = True, ax: Any = None) -> Any:
    """Draw a robot as a stick figure seen from its right, x to the right and z up.

    The limbs on the far side are blue and behind those on the near side, which are vermilion.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    shift : float
        Added to x, so that several postures stand side by side, m.
    com : bool
        Whether to mark the centre of mass; what has no mass has none.
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
    shift = as_number(shift, "shift")
    ax = axes_2d(ax, size=(10.0, 2.6))
    lines = sticks(model, q)
    across = lines[..., 1].mean(axis=-1)
    middle = 1e-6 + 0.25 * np.abs(across).max(initial=0)
    for k in np.argsort(-across):  # the far ones first
        near, far = across[k] < -middle, across[k] > middle
        colour = COLOURS["vermilion"] if near else COLOURS["blue"] if far else COLOURS["grey"]
        ax.plot(lines[k, :, 0] + shift, lines[k, :, 2], color=colour, linewidth=3, solid_capstyle="round")
    if com and model.mass > 0:
        c = center_of_mass(model, q).astype(float)
        ax.plot(c[0] + shift, c[2], "x", color=COLOURS["purple"], markersize=7, markeredgewidth=2)
    ax.set(xlabel="x [m]", ylabel="z [m]", aspect="equal")
    return ax

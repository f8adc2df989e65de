"""A robot as a stick figure (49.1, 49.6)."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import forward_kinematics, frame_placement
from ..arrays import Array, as_names
from ..model import Model, one_configuration
from .style import COLOURS, axes_3d, fit
from .words import word

__all__ = ["robot", "sticks"]


def sticks(model: Model, q: ArrayLike) -> Array:
    """Return the lines of a stick figure: from each joint to the next, and from the last ones to their tips.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)

    Returns
    -------
    ndarray, shape (n, 2, 3)
        Both ends of each line, in the world, m. The tip of a body that carries no other is, of all
        frames on it, the one furthest from its joint.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`; or if `q` is a batch.

    Examples
    --------
    Three lines for each leg of a Go2, and from the base to each hip:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> sticks(model, model.standing()).shape
    (16, 2, 3)
    """
    q = one_configuration(model, q)
    T = forward_kinematics(model, q).placement
    first = 2 if model.base == "floating" else 1
    lines = [(T[model.parent[i]].translation, T[i].translation) for i in range(first, model.nbodies)]
    for i in set(range(1, model.nbodies)) - set(model.parent):
        reach = [f.placement.translation for f in model.frames.values() if f.body == i]
        tip = max(reach, key=lambda p: float((p * p).sum()), default=np.zeros(3))
        lines.append((T[i].translation, T[i].act(tip)))
    return np.asarray(lines, dtype=float).reshape(-1, 2, 3)


def robot(
    model: Model,
    q: ArrayLike,
    *,
    frames: Collection[str] = (),
    com: bool = True,
    colour: str = COLOURS["grey"],
    ax: Any = None,
) -> Any:
    """Draw a robot as a stick figure, with its joints as dots and its centre of mass as a cross.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    frames : collection of str
        Frames whose names are written beside them.
    com : bool
        Whether to mark the centre of mass; not drawn for a robot without mass.
    colour : str
        Of the sticks.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D

    Raises
    ------
    NameNotFound
        If the model has no such frame.
    ShapeError, ValueError
        As `sticks`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> model = tw.load("go2")
    >>> ax = Figure().add_subplot(projection="3d")
    >>> robot(model, model.standing(), frames=["FR_foot"], ax=ax).texts[0].get_text().strip()
    'FR_foot'
    """
    lines = sticks(model, q)
    frames = as_names(frames, "frames", "frame names")
    ax = axes_3d(ax)
    for line in lines:
        ax.plot(*line.mT, color=colour, linewidth=3, solid_capstyle="round")
    joints = lines[:, 0]
    ax.plot(*joints.mT, ".", color=COLOURS["black"], markersize=7)
    if com and model.mass > 0:
        c = center_of_mass(model, q).astype(float)
        ax.plot(
            *c[:, None], "x", color=COLOURS["purple"], markersize=9, markeredgewidth=2.5, label=word("centre of mass")
        )
    for name in frames:
        p = frame_placement(model, q, name).translation
        ax.text(*p.astype(float), f" {name}", fontsize=9, verticalalignment="top")
    return fit(ax)

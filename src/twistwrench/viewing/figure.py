"""The stick figure, by matplotlib."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import forward_kinematics, frame_placement
from ..plot.frames import arrows, triad
from ..plot.robot import robot
from ..plot.stance import support_polygon
from ..plot.style import COLOURS, axes_3d, fit
from .state import Subject

__all__ = ["MAX_FORCE_EXTENTS", "draw"]

MAX_FORCE_EXTENTS = 0.25
"""Length of its arrow, in extents of the robot."""


def draw(seen: Subject, frames: Collection[str] | None = None, ax: Any = None) -> Any:
    """Draw a robot with its frames, centre of mass, support polygon and contact forces.

    Parameters
    ----------
    seen : Subject
        In one configuration.
    frames : collection of str, optional
        Those that are drawn, with their names; small ones on every body, without names, unless given.
    ax : matplotlib Axes3D, optional

    Returns
    -------
    matplotlib Axes3D
    """
    model, q, (centre, extent) = seen.model, seen.q, seen.box()
    ax = robot(model, q, ax=axes_3d(ax, size=(7.0, 6.0)))
    if frames is None:
        for T in forward_kinematics(model, q).placement[1:]:
            triad(T, size=0.06 * extent, ax=ax)
    for name in frames or ():
        triad(frame_placement(model, q, name), name, size=0.15 * extent, ax=ax)
    if len(corners := seen.support()):
        support_polygon(corners, center_of_mass(model, q) if model.mass > 0 else None, ax=ax)
    if (forces := seen.forces()) is not None:
        largest = float(np.linalg.norm(forces.vectors, axis=-1).max(initial=0)) or 1.0
        arrows(
            forces.at,
            forces.vectors,
            scale=MAX_FORCE_EXTENTS * extent / largest,
            texts=seen.texts(forces),
            colour=COLOURS["black"],
            label="force of the ground",
            ax=ax,
        )
    ax.set_title(f"{model.name}, {model.mass:.4g} kg")
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="upper left", fontsize=9)
    fit(ax, centre + 0.3 * extent * np.array([[-1, -1, 0], [1, 1, 0]]))  # a thin robot would crowd the ticks
    ax.set_box_aspect(np.ptp([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()], axis=1), zoom=0.9)  # room for the labels
    return ax

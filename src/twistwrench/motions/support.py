"""What the ground must do for a motion, and whether it can: friction and centre of pressure (49.9, 49.10)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..algorithms.centroidal import center_of_mass, centroidal_momentum_rate
from ..algorithms.kinematics import frame_placement
from ..arrays import Array
from ..contact.stance import inside
from ..errors import ModelError
from ..model import Model, check_model
from .motion import Motion, check_motion

__all__ = ["Ground", "ground"]

LOADED = 1e-6
"""Share of the weight above which the ground counts as loaded."""


@dataclass(frozen=True, eq=False)
class Ground:
    """What `ground` returns, for n states, of which l load the ground.

    Attributes
    ----------
    wrench : ndarray, shape (n, 6)
        The total wrench of the ground, at the centre of mass, in the axes of the world, N m and N: ḣ_G less the weight.
    loaded : ndarray of bool, shape (n,)
        Whether the ground is pushed.
    friction : ndarray, shape (l,)
        Force along the ground over force across it: the coefficient of friction that the motion needs at least.
    center_of_pressure : ndarray, shape (l, 3)
        Where on the ground no moment along it is left, m.
    margin : ndarray, shape (l,)
        How deep the centre of pressure lies inside the polygon of the frames of the standing feet, m; negative
        outside. Of a robot on one foot, or two points, the polygon has no inside: compare with the size of its soles.
    """

    wrench: Array
    loaded: Array
    friction: Array
    center_of_pressure: Array
    margin: Array


def ground(model: Model, motion: Motion) -> Ground:
    """Return what the ground must do for a motion.

    Necessary, not sufficient: neither the moment about the vertical is checked, nor whether the forces can be shared
    out among the feet, each inside its own friction cone.

    Parameters
    ----------
    model : Model
        Of the robot, with gravity along −z.
    motion : Motion

    Returns
    -------
    Ground

    Raises
    ------
    ModelError
        If gravity does not pull along −z.
    ShapeError, ValueError, SingularError
        As `twistwrench.centroidal_momentum_rate`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> needed = ground(model, tw.motions.walk(model, samples=50))
    >>> bool(needed.loaded.all()), bool(needed.friction.max() < 0.25), bool(needed.margin.min() > 0.01)
    (True, True, True)
    """
    check_model(model)
    check_motion(motion)
    if not (model.gravity[2] < 0 and not model.gravity[:2].any()):
        raise ModelError(f"{model.name!r}: expected gravity along -z, got {model.gravity.tolist()}")
    wrench = centroidal_momentum_rate(model, motion.q, motion.v, motion.a)
    wrench[:, 3:] -= model.mass * model.gravity
    loaded = (wrench[:, 5] > LOADED * model.mass * -model.gravity[2]) & motion.contacts.any(axis=1)
    n, f = wrench[loaded, :3], wrench[loaded, 3:]
    p_G = center_of_mass(model, motion.q[loaded])
    feet = np.stack([frame_placement(model, motion.q[loaded], foot).translation for foot in motion.feet], axis=1)
    stands = motion.contacts[loaded]
    level = np.where(stands, feet[..., 2], np.inf).min(axis=1)
    down = level - p_G[:, 2]
    c = p_G + np.stack([(down * f[:, 0] - n[:, 1]) / f[:, 2], (down * f[:, 1] + n[:, 0]) / f[:, 2], down], axis=1)
    friction = np.sqrt(f[:, 0] ** 2 + f[:, 1] ** 2) / f[:, 2]
    margin = [inside(corners[on, :2] - at[:2]) for corners, on, at in zip(feet, stands, c)]
    return Ground(wrench, loaded, friction, c, np.array(margin))

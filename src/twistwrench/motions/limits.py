"""Whether a motion keeps the limits of the joints."""

from __future__ import annotations

import numpy as np

from ..model import Model, floats_of
from .motion import Motion, check_motion

__all__ = ["limits_broken"]


def limits_broken(model: Model, motion: Motion) -> dict[str, tuple[float, float]]:
    """Return the joints that a motion takes outside their limits; empty where it keeps them all.

    A motion is made for the shape of a robot, without regard to its limits.

    Parameters
    ----------
    model : Model
    motion : Motion

    Returns
    -------
    dict of str to (float, float)
        By the joint's name: how far q goes outside its limits (rad or m; 0 where it does not), and the largest speed as
        a share of the velocity limit. A velocity limit of 0 means no limit.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`, where the motion is another robot's.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> limits_broken(model, tw.motions.trot(model))
    {}
    """
    check_motion(motion)
    q, v = floats_of(model, motion.q, v=motion.v)
    outside = np.maximum(np.maximum(model.lower - q, q - model.upper), 0).max(axis=0)
    limit = np.where(model.velocity_limit > 0, model.velocity_limit, np.inf)
    share = (np.abs(v) / limit).max(axis=0)
    found = {}
    for name, joint, qs, vs in zip(model.joint_names, model.joints, model.q_slice, model.v_slice):
        if joint and (outside[qs].any() or share[vs].max() > 1):
            found[name] = (float(outside[qs].max()), float(share[vs].max()))
    return found

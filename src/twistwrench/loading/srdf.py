"""Named postures, from an SRDF's ``<group_state>`` and from the table of stances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..algorithms.kinematics import frame_placement
from ..arrays import Array
from ..errors import ModelError
from ..model import Continuous, Model
from .reading import read_robot_xml
from .stances import Stance

__all__ = ["read_states", "with_stance", "with_states"]

States = Mapping[str, Mapping[str, list[float]]]


def read_states(path: Path) -> States:
    """Read the named postures of an SRDF.

    Parameters
    ----------
    path : Path

    Returns
    -------
    mapping of str to mapping of str to list of float
        For each posture, by joint, the joint's entries of q (one angle; seven numbers for a floating base).

    Raises
    ------
    ModelError
        If the file is not an SRDF, or a value is not a number.
    """
    states = {}
    for state in read_robot_xml(path).iterfind("group_state"):
        try:
            states[state.get("name")] = {
                joint.get("name"): [float(word) for word in joint.get("value").split()]
                for joint in state.iterfind("joint")
            }
        except (AttributeError, ValueError):
            raise ModelError(f"{path}, line {state.sourceline}: a value in this posture is not a number") from None
    return states


def with_states(model: Model, states: States) -> Model:
    """Return the model with these postures.

    Joints that a posture does not name stay neutral; joints that the model does not have are left out
    (one SRDF serves several variants of a robot). The values are those of the file, within the limits or not.
    """
    return replace(model, postures={name: _posture(model, state) for name, state in states.items()})


def with_stance(model: Model, stance: Stance) -> Model:
    """Return the model with its feet and the posture ``"standing"``.

    The angles are kept within the limits; the height of a floating base is the one that puts the lowest of the
    feet's frames on z = 0.

    Raises
    ------
    NameNotFound
        If the model has no frame of a foot's name.
    """
    q = model.postures[stance.state].copy() if stance.state else _from_angles(model, stance)
    for joint, s in zip(model.joints, model.q_slice, strict=True):
        if joint is not None and joint.unit is None:
            q[s] = np.clip(q[s], model.lower[s], model.upper[s])
    if model.base == "floating":
        q[2] = 0.0
        q = model.normalize(q)
        q[2] = -min(float(frame_placement(model, q, foot).translation[2]) for foot in stance.feet)
    return replace(model, feet=stance.feet, postures={**model.postures, "standing": q})


def _posture(model: Model, state: Mapping[str, list[float]]) -> Array:
    q = model.neutral()
    for i, joint in enumerate(model.joints):
        values = state.get(model.joint_names[i])
        if joint is None or values is None:
            continue
        if isinstance(joint, Continuous) and len(values) == 1:
            values = [np.cos(values[0]), np.sin(values[0])]  # an SRDF gives the angle
        if len(values) != joint.nq:
            raise ModelError(f"posture of joint {model.joint_names[i]!r}: expected {joint.nq} numbers, got {values}")
        q[model.q_slice[i]] = values
    return model.normalize(q)


def _from_angles(model: Model, stance: Stance) -> Array:
    q = model.neutral()
    for i, name in enumerate(model.joint_names):
        for ending, angle in stance.angles.items():
            if name.endswith(ending):
                q[model.q_slice[i]] = angle
    if model.base == "floating":
        q[3:7] = stance.base
    return q

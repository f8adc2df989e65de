"""How the legged robots of the catalogue stand: on which frames, and with which angles.

The height of the base is not here: it is computed, so that the lowest of the feet's frames lies on z = 0.
(A foot's frame is a point of the foot that its file chose: the middle of the sole of most humanoids, the centre of
the ball on most quadrupeds. Our humanoid's file has the corners of its soles, and they are its feet: point forces
there hold it, as two forces in the middles of two soles cannot.)
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ..algorithms.kinematics import frame_placement
from ..arrays import Array
from ..errors import ModelError
from ..model import Continuous, Model
from .element import read_robot_xml

__all__ = ["STANCES", "Stance", "read_states", "with_stance", "with_states"]


@dataclass(frozen=True)
class Stance:
    """How one robot stands.

    Parameters
    ----------
    feet : tuple of str
        The frames on which it stands.
    srdf : str
        File of named postures, beside the URDF's folder in ``srdf/``; empty for none.
    state : str
        The posture in that file which is the standing one; empty to use `angles`.
    angles : mapping of str to float
        Joint angles, rad; a joint's own name, or the end of one for all joints that end so. Others are 0.
    base : tuple of float
        Quaternion (qx, qy, qz, qw) of the base, where the file's own z is not up.
    """

    feet: tuple[str, ...]
    srdf: str = ""
    state: str = ""
    angles: Mapping[str, float] = field(default_factory=dict)
    base: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)


def _four(front: str, rear: str, foot: str) -> tuple[str, ...]:
    """Name four feet: front left, front right, rear left, rear right."""
    return tuple(leg + foot for leg in (*front.split(), *rear.split()))


UNITREE = _four("FL FR", "RL RR", "_foot")
ANYMAL = _four("LF RF", "LH RH", "_FOOT")
SOLO = _four("FL FR", "HL HR", "_FOOT")
SOLES = ("l_sole", "r_sole")
CORNERS = tuple(f"{side}_sole_{corner}" for side in ("left", "right") for corner in ("fl", "fr", "rl", "rr"))
TALOS = Stance(("left_sole_link", "right_sole_link"), "talos", "half_sitting")
G1 = Stance(
    ("left_ankle_roll_link", "right_ankle_roll_link"),
    angles={"hip_pitch_joint": -0.2, "knee_joint": 0.4, "ankle_pitch_joint": -0.2},
)
ICUB = Stance(SOLES, "icub", "half_sitting")

STANCES: dict[str, Stance] = {
    "models/go2": Stance(UNITREE, angles={"thigh_joint": 0.9, "calf_joint": -1.8}),
    "models/humanoid": Stance(
        CORNERS,  # two points bear no moment about the line between them
        angles={
            "hip_pitch": -0.3,
            "knee": 0.6,
            "ankle_pitch": -0.3,
            "left_shoulder_roll": 0.15,
            "right_shoulder_roll": -0.15,
            "elbow": -0.4,
        },
    ),
    "a1": Stance(UNITREE, "a1", "standing"),
    "alexander_lower_body": Stance(("LEFT_FOOT", "RIGHT_FOOT"), "alexander", "default"),
    "anymal_b": Stance(ANYMAL, "anymal", "standing"),
    "anymal_b_kinova": Stance(ANYMAL, "anymal-kinova", "standing_with_arm_up"),
    "anymal_c": Stance(ANYMAL, "anymal", "standing"),
    "b1": Stance(UNITREE, "b1", "standing"),
    "b1_z1": Stance(UNITREE, "b1-z1", "standing_with_arm_up"),
    "bolt": Stance(("FL_FOOT", "FR_FOOT"), "bolt", "standing"),
    "centauro": Stance(("contact_1", "contact_2", "contact_3", "contact_4"), "centauro", "homing_nominal"),
    "g1": G1,
    "g1_with_hands": G1,
    "go1": Stance(UNITREE, "go1", "standing"),
    "go2": Stance(UNITREE, "go2", "standing"),
    "human": Stance(("left_foot", "right_foot"), base=(0.5**0.5, 0.0, 0.0, 0.5**0.5)),  # its own up is y
    "hyq": Stance(("lf_foot", "rf_foot", "lh_foot", "rh_foot"), "hyq", "standing"),
    "icub": ICUB,
    "icub_reduced": ICUB,
    "laikago": Stance(UNITREE, angles={"thigh_joint": 0.7, "calf_joint": -1.4}),
    "quadruped": Stance(_four("FL FR", "BL BR", "_contact")),  # its knees have no range
    "romeo": Stance(SOLES, "romeo", "half_sitting"),
    "romeo_laas_small": Stance(SOLES),
    "romeo_small": Stance(SOLES, "romeo_small", "half_sitting"),
    "simple_humanoid": Stance(("l_ankle", "r_ankle")),  # the postures of its SRDF are outside its limits
    "simple_humanoid_classical": Stance(("l_ankle", "r_ankle")),
    "solo8": Stance(SOLO, "solo", "standing"),
    "solo12": Stance(SOLO, "solo", "standing"),
    "talos_full_v2": TALOS,
    "talos_full_v2_box": TALOS,
    "talos_reduced": TALOS,
    "talos_reduced_box": TALOS,
    "talos_reduced_corrected": TALOS,
}
"""By the name in example-robot-data, or ``models/`` and the name there."""


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

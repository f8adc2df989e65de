"""How the legged robots of the catalogue stand: on which frames, and with which angles.

The height of the base is not here: it is computed, so that the lowest of the feet's frames lies on z = 0.
(A foot's frame is a point of the foot that its file chose: the middle of the sole of most humanoids, the centre of
the ball on most quadrupeds. Our humanoid's file has the corners of its soles, and they are its feet: point forces
there hold it, as two forces in the middles of two soles cannot.)
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

__all__ = ["STANCES", "Stance"]


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

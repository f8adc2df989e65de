"""How the numbers of an answer are arranged: the blocks that a message can point to."""

from __future__ import annotations

from misstep.exercise import PLAIN, Layout, Parts
from misstep.text import Text

__all__ = [
    "CENTROIDAL_MAP",
    "CONTACT_JACOBIAN",
    "FORCE_TRANSFORM",
    "INERTIA",
    "JACOBIAN",
    "JOINTS_MAP",
    "JOINT_SPACE",
    "MASS_MATRIX",
    "MOMENTUM",
    "MOTION_TRANSFORM",
    "PINOCCHIO_INERTIA",
    "PINOCCHIO_TRANSFORM",
    "PLAIN",
    "POSE",
    "TWIST",
    "WRENCH",
]


def _halves(angular: str, linear: str) -> Parts:
    first, second = (
        Text(x, x.replace(" (angular)", "（角）").replace(" (linear)", "（线）")) for x in (angular, linear)
    )
    return (first, slice(0, 3)), (second, slice(3, 6))


_MOTION, _FORCE, _MOMENTUM = _halves("ω", "v"), _halves("τ", "f"), _halves("k (angular)", "l (linear)")
_PINOCCHIO_MOTION, _PINOCCHIO_MOMENTUM = _halves("v", "ω"), _halves("l (linear)", "k (angular)")
_JOINTS = (Text("of the base", "基座"), slice(0, 6)), (Text("of the joints", "关节"), slice(6, None))
_STATE = (
    (Text("of the base's rotation", "基座转动"), slice(0, 3)),
    (Text("of the base's translation", "基座平动"), slice(3, 6)),
    (Text("of the joints", "关节"), slice(6, None)),
)
_FEET = tuple((Text(f"of foot {k}", f"第 {k} 只脚"), slice(3 * k, 3 * k + 3)) for k in range(4))
_POSE_ROWS = (Text("0 to 2", "0–2"), slice(0, 3)), (Text("3", "3"), slice(3, 4))
_POSE_COLUMNS = (
    (Text("0 to 2 (rotation)", "0–2（旋转）"), slice(0, 3)),
    (Text("3 (position)", "3（位置）"), slice(3, 4)),
)

TWIST = Layout((_MOTION,))
WRENCH = Layout((_FORCE,))
MOMENTUM = Layout((_MOMENTUM,))
JOINT_SPACE = Layout((_STATE,))
"""A vector of a floating base's nv entries."""
MOTION_TRANSFORM = Layout((_MOTION, _MOTION))
FORCE_TRANSFORM = Layout((_FORCE, _FORCE))
INERTIA = Layout((_MOMENTUM, _MOTION))
PINOCCHIO_TRANSFORM = Layout((_PINOCCHIO_MOTION, _PINOCCHIO_MOTION))
PINOCCHIO_INERTIA = Layout((_PINOCCHIO_MOMENTUM, _PINOCCHIO_MOTION))
"""In Pinocchio's own order, the linear half first."""
JACOBIAN = Layout((_MOTION, _JOINTS))
MASS_MATRIX = Layout((_JOINTS, _JOINTS))
CENTROIDAL_MAP = Layout((_MOMENTUM, _STATE))
JOINTS_MAP = Layout((_MOMENTUM, ((Text("of the joints", "关节"), slice(0, None)),)))
"""The centroidal map without the base's columns."""
CONTACT_JACOBIAN = Layout((_FEET, _JOINTS))
POSE = Layout((_POSE_ROWS, _POSE_COLUMNS))

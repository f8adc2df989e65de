"""The project, stage 1: the class of spatial vectors, and placements."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Part, Quantity
from ..layouts import POSE
from ..wrong import swap

__all__ = ["POSE_OF_BASE", "POSE_OF_URDF", "VECTOR", "SpatialVector", "base_pose", "urdf_pose"]


class SpatialVector:
    """A twist or a wrench."""

    def __init__(self, kind: Any, vector: Any) -> None:
        self.kind, self.vector = kind, np.asarray(vector)

    def __add__(self, other: Any) -> Any:
        if self.kind != other.kind:
            raise TypeError(f"{self.kind} + {other.kind}")
        return SpatialVector(self.kind, self.vector + other.vector)

    def __sub__(self, other: Any) -> Any:
        return self + SpatialVector(other.kind, -other.vector)

    def power(self, other: Any) -> Any:
        """Power of a wrench along a twist."""
        if self.kind == other.kind:
            raise TypeError(f"power of {self.kind} and {other.kind}")
        return self.vector @ other.vector


def base_pose(q: Any) -> Any:
    """Placement of a floating base, out of q."""
    x, y, z, w = q[3:7]
    T = np.eye(4)
    T[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    T[:3, 3] = q[:3]
    return T


def urdf_pose(xyz: Any, rpy: Any) -> Any:
    """Placement out of a URDF's <origin>."""
    roll, pitch, yaw = rpy
    T = np.eye(4)
    T[:3, :3] = tw.exp3([0, 0, yaw]) @ tw.exp3([0, pitch, 0]) @ tw.exp3([roll, 0, 0])
    T[:3, 3] = xyz
    return T


# ---------------------------------------------------------------- the class, and how it goes wrong


def _use(kind: Any, V: Any, W: Any, F: Any, G: Any) -> Any:
    """Add, subtract and pair two twists and two wrenches, and try what must raise an error."""
    twist, other_twist = kind("twist", V), kind("twist", W)
    wrench, other_wrench = kind("wrench", F), kind("wrench", G)
    total, difference = wrench + other_wrench, twist - other_twist
    power, reverse = _tried(lambda: wrench.power(twist)), _tried(lambda: twist.power(wrench))
    if total is ... or difference is ... or power is ...:
        return ...
    mixed, paired = _tried(lambda: twist + wrench), _tried(lambda: twist.power(other_twist))
    errors = (x if isinstance(x, str) else "no error" for x in (mixed, paired))
    return total.kind, total.vector, difference.vector, power, reverse, *errors


def _tried(action: Any) -> Any:
    """Return a result, or the name of the error in its place."""
    try:
        return action()
    except TypeError:
        return "TypeError"
    except (ArithmeticError, AssertionError, AttributeError, LookupError, ValueError) as error:
        return type(error).__name__


class _Mixing(SpatialVector):
    """Add without a check of the kinds."""

    def __add__(self, other: Any) -> Any:
        return type(self)(self.kind, self.vector + other.vector)


class _Pairing(SpatialVector):
    """Pair without a check of the kinds."""

    def power(self, other: Any) -> Any:
        return self.vector @ other.vector


class _OneWay(SpatialVector):
    """Pair a wrench with a twist, and not a twist with a wrench."""

    def power(self, other: Any) -> Any:
        if (self.kind, other.kind) != ("wrench", "twist"):
            raise TypeError
        return super().power(other)


class _Raising(SpatialVector):
    """Raise another error."""

    def __add__(self, other: Any) -> Any:
        if self.kind != other.kind:
            raise ValueError
        return super().__add__(other)

    def power(self, other: Any) -> Any:
        if self.kind == other.kind:
            raise ValueError
        return super().power(other)


class _Swapping(SpatialVector):
    """Pair ω with f."""

    def power(self, other: Any) -> Any:
        return super().power(SpatialVector(other.kind, swap(other.vector)))


class _Reversing(SpatialVector):
    """Subtract the other way round."""

    def __sub__(self, other: Any) -> Any:
        return SpatialVector(self.kind, other.vector - self.vector)


class _Forgetting(SpatialVector):
    """Call each sum a twist."""

    def __add__(self, other: Any) -> Any:
        return SpatialVector("twist", super().__add__(other).vector)


VECTOR = Part(
    solution=SpatialVector,
    call=_use,
    given="""
        def __init__(self, kind, vector):
            self.kind, self.vector = kind, np.asarray(vector)

        def __add__(self, other):
            return ...

        def __sub__(self, other):
            return ...

        def power(self, other):
            return ...
""",
    returns=(
        Quantity("(F + G).kind"),
        Quantity("F + G"),
        Quantity("V − W"),
        Quantity("F.power(V)", unit="W"),
        Quantity("V.power(F)", unit="W"),
        Quantity("the error of V + F"),
        Quantity("the error of V.power(W)"),
    ),
    cases=lambda rng: [tuple(rng.standard_normal((4, 6))) for _ in range(3)],
    slips={
        "kinds-mixed": _Mixing,
        "pairing-of-equals": _Pairing,
        "pairing-one-way": _OneWay,
        "other-error": _Raising,
        "swapped-halves": _Swapping,
        "difference-reversed": _Reversing,
        "kind-lost": _Forgetting,
    },
)

# ---------------------------------------------------------------- placements and transforms


def _posed(rotation: Any) -> Any:
    """Take another rotation out of (x, y, z, w)."""

    def wrong(q: Any) -> Any:
        T = base_pose(q)
        T[:3, :3] = rotation(q[3:7])
        return T

    return wrong


def _rotated(xyzw: Any) -> Any:
    return base_pose(np.concatenate([np.zeros(3), xyzw]))[:3, :3]


def _configuration(rng: Any) -> Any:
    xyzw = rng.standard_normal(4)
    return np.concatenate([rng.standard_normal(3), xyzw / np.sqrt(xyzw @ xyzw), rng.standard_normal(12)])


POSE_OF_BASE = Part(
    solution=base_pose,
    returns=(Quantity("T", POSE),),
    cases=lambda rng: [(_configuration(rng),) for _ in range(4)],
    slips={
        "qwxyz": _posed(lambda xyzw: _rotated(np.roll(xyzw, -1))),
        "rotation-transposed": _posed(lambda xyzw: _rotated(xyzw).mT),
        "half-angle": _posed(lambda xyzw: tw.exp3(tw.log3(_rotated(xyzw)) / 2)),
        "translation-dropped": lambda q: base_pose(np.concatenate([np.zeros(3), q[3:]])),
    },
    residuals=(lambda answer, q: answer[:3, :3].mT @ answer[:3, :3] - np.eye(3),),
)


def _origin(R: Any, p: Any = lambda R, xyz: xyz) -> Any:
    """Take another rotation out of the three elementary ones, or another translation."""

    def wrong(xyz: Any, rpy: Any) -> Any:
        T = np.eye(4)
        T[:3, :3] = R(*(tw.exp3(angle * axis) for angle, axis in zip(rpy, np.eye(3))))
        T[:3, 3] = p(urdf_pose(xyz, rpy)[:3, :3], xyz)
        return T

    return wrong


POSE_OF_URDF = Part(
    solution=urdf_pose,
    returns=(Quantity("T", POSE),),
    cases=lambda rng: [tuple(rng.uniform(-1.2, 1.2, (2, 3))) for _ in range(4)],
    slips={
        "euler-order": _origin(lambda x, y, z: x @ y @ z),
        "rotation-transposed": _origin(lambda x, y, z: (z @ y @ x).mT),
        "degrees": lambda xyz, rpy: urdf_pose(xyz, np.radians(rpy)),
        "translation-first": _origin(lambda x, y, z: z @ y @ x, lambda R, xyz: R @ xyz),
        "translation-dropped": _origin(lambda x, y, z: z @ y @ x, lambda R, xyz: 0 * xyz),
    },
)

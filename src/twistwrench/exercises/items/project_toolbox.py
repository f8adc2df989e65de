"""The project, stage 1: the class of spatial vectors, and placements."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Output, Part

from ..layouts import POSE
from ..wrong import faulty

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
    same = ["".join([*text]) for text in ("twist", "wrench")]  # the same texts, and other objects
    twist, other_twist = kind("twist", V), kind(same[0], W)
    wrench, other_wrench = kind("wrench", F), kind(same[1], G)
    total, difference, rest = wrench + other_wrench, twist - other_twist, wrench - other_wrench
    power, reverse = _tried(lambda: wrench.power(twist)), _tried(lambda: twist.power(wrench))
    if any(x is ... for x in (total, difference, rest, power)):
        return ...
    for given, vector in ((V, twist), (W, other_twist), (F, wrench), (G, other_wrench)):
        given[:] = vector.vector  # a sum or a difference that changes one of its terms changes an argument
    mixed = _error(lambda: twist + wrench, lambda: wrench - twist, lambda: wrench + twist, lambda: twist - wrench)
    paired = _error(lambda: twist.power(other_twist), lambda: wrench.power(other_wrench))
    of_twists = {str(difference.kind), str((twist + other_twist).kind)}
    of_rest = rest.kind if of_twists == {"twist"} else f"{rest.kind}, and of twists {', '.join(sorted(of_twists))}"
    return total.kind, of_rest, total.vector, difference.vector, power, reverse, mixed, paired


def _error(*actions: Any) -> str:
    """Return the name of the error that each of these must raise; of the first that raises another, or none."""
    found = [x if isinstance(x, str) else _returned(x) for x in map(_tried, actions)]
    return next((x for x in found if x != "TypeError"), "TypeError")


def _returned(x: Any) -> str:
    """Return what is said of a result where an error must be raised."""
    return f"{type(x).__name__}, returned and not raised" if isinstance(x, BaseException) else "no error"


def _tried(action: Any) -> Any:
    """Return a result, or the name of the error in its place."""
    try:
        return action()
    except TypeError:
        return "TypeError"
    except (ArithmeticError, AssertionError, AttributeError, LookupError, ValueError) as error:
        return type(error).__name__


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
        Output("(F + G).kind"),
        Output("(F − G).kind"),
        Output("F + G"),
        Output("V − W"),
        Output("F.power(V)", unit="W"),
        Output("V.power(F)", unit="W"),
        Output("the error of V ± F", zh="V ± F 的异常"),
        Output("the error of V.power(W)", zh="V.power(W) 的异常"),
    ),
    cases=lambda rng: [tuple(rng.standard_normal((4, 6))) for _ in range(3)],
    slips={
        "kinds-mixed": faulty(SpatialVector, ("if self.kind != other.kind", "if False")),
        "pairing-of-equals": faulty(SpatialVector, ("if self.kind == other.kind", "if False")),
        "pairing-one-way": faulty(
            SpatialVector, ("self.kind == other.kind", '(self.kind, other.kind) != ("wrench", "twist")')
        ),
        "other-error": faulty(SpatialVector, ('TypeError(f"{', 'ValueError(f"{'), ('TypeError(f"p', 'ValueError(f"p')),
        "error-returned": faulty(
            SpatialVector,
            ('raise TypeError(f"{', 'return TypeError(f"{'),
            ('raise TypeError(f"p', 'return TypeError(f"p'),
        ),
        "swapped-halves": faulty(SpatialVector, ("@ other.vector", "@ swap(other.vector)")),
        "difference-reversed": faulty(
            SpatialVector,
            (
                "return self + SpatialVector(other.kind, -other.vector)",
                "return SpatialVector(self.kind, other.vector - self.vector)",
            ),
        ),
        "kind-lost": faulty(SpatialVector, ("SpatialVector(self.kind", 'SpatialVector("twist"')),
    },
)

# ---------------------------------------------------------------- placements and transforms


def _by_inner_product(q: Any) -> Any:
    """Add |u|² to every entry, where the matrix u uᵀ belongs."""
    T, u, w = base_pose(q), q[3:6], q[6]
    T[:3, :3] = (w * w - u @ u) * np.eye(3) + 2 * (u @ u) + 2 * w * tw.skew(u)
    return T


def _configuration(rng: Any) -> Any:
    xyzw = rng.standard_normal(4)
    return np.concatenate([rng.standard_normal(3), xyzw / np.sqrt(xyzw @ xyzw), rng.standard_normal(12)])


POSE_OF_BASE = Part(
    solution=base_pose,
    returns=(Output("T", POSE),),
    cases=lambda rng: [(_configuration(rng),) for _ in range(4)],
    edges=lambda rng: [(np.concatenate([q[:3], [0, 0, 0, 1 + 2.0**-52], q[7:]]),) for q in [_configuration(rng)]],
    slips={
        "qwxyz": faulty(base_pose, ("x, y, z, w =", "w, x, y, z =")),
        "rotation-transposed": faulty(base_pose, ("T[:3, :3] = [", "T[:3, :3].mT[:] = [")),
        "half-angle": faulty(
            base_pose, ("T[:3, 3] = q[:3]", "T[:3, :3], T[:3, 3] = tw.exp3(tw.log3(T[:3, :3]) / 2), q[:3]")
        ),
        "inner-for-outer": _by_inner_product,
        "translation-dropped": faulty(base_pose, ("= q[:3]", "= 0")),
    },
    residuals=(lambda answer, q: answer[:3, :3].mT @ answer[:3, :3] - np.eye(3),),
)


def _first_axis(rpy: Any) -> Any:
    """Return the x axis of a placement with these angles."""
    _, pitch, yaw = rpy
    return np.array([np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), -np.sin(pitch)])


POSE_OF_URDF = Part(
    solution=urdf_pose,
    returns=(Output("T", POSE),),
    cases=lambda rng: [tuple(rng.uniform(-1.2, 1.2, (2, 3))) for _ in range(4)],
    slips={
        "angles-as-vector": lambda xyz, rpy: np.block([[tw.exp3(rpy), xyz[:, None]], [np.eye(4)[3:]]]),
        "euler-order": faulty(
            urdf_pose,
            (
                "tw.exp3([0, 0, yaw]) @ tw.exp3([0, pitch, 0]) @ tw.exp3([roll, 0, 0])",
                "tw.exp3([roll, 0, 0]) @ tw.exp3([0, pitch, 0]) @ tw.exp3([0, 0, yaw])",
            ),
        ),
        "rotation-transposed": faulty(urdf_pose, ("T[:3, :3] =", "T[:3, :3].mT[:] =")),
        "turns-of-axes": lambda xyz, rpy: urdf_pose(xyz, -rpy),
        "pitch-sign": lambda xyz, rpy: urdf_pose(xyz, [1, -1, 1] * rpy),
        "yaw-first": lambda xyz, rpy: urdf_pose(xyz, rpy[::-1]),
        "degrees": lambda xyz, rpy: urdf_pose(xyz, np.radians(rpy)),
        "translation-first": faulty(urdf_pose, ("= xyz", "= T[:3, :3] @ xyz")),
        "translation-dropped": faulty(urdf_pose, ("= xyz", "= 0")),
    },
    residuals=(lambda answer, xyz, rpy: answer[:3, 3] - xyz, lambda answer, xyz, rpy: answer[:3, 0] - _first_axis(rpy)),
)

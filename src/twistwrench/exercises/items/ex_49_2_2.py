"""Exercise 49.2.2: an exact exponential."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import POSE
from ..text import Text
from ..wrong import before, transposed

__all__ = ["EXERCISE", "arc", "twist_matrix"]


def twist_matrix(omega_z: Any, v_x: Any) -> Any:
    """[V]∧ of a twist in the plane."""
    return np.array([[0, -omega_z, 0, v_x], [omega_z, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]])


def arc(omega_z: Any, v_x: Any) -> Any:
    """Placement after one second."""
    c, s = np.cos(omega_z), np.sin(omega_z)
    x, y = v_x * s / omega_z, v_x * (1 - c) / omega_z
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]])


def _moved(omega_z: Any, v_x: Any, x: Any, y: Any) -> Any:
    """Put other numbers in the place of the translation."""
    T = arc(omega_z, v_x)
    T[0, 3], T[1, 3] = x, y
    return T


def _exponential_of_blocks(omega_z: Any, v_x: Any) -> Any:
    return np.exp(twist_matrix(omega_z, v_x))


def _cases(rng: Any) -> Any:
    return [(float(rng.uniform(0.5, 2.5)), float(rng.uniform(0.5, 2.0))) for _ in range(4)]


MATRIX = Part(
    solution=twist_matrix,
    doc=Text(
        """Return [V]∧ of V = (0, 0, omega_z, v_x, 0, 0).

        omega_z: number, rad/s. v_x: number, m/s.
        Returns: array (4, 4).""",
        """返回 V = (0, 0, omega_z, v_x, 0, 0) 的 [V]∧。

        omega_z：数，rad/s。v_x：数，m/s。
        返回：数组 (4, 4)。""",
    ),
    returns=(Quantity("[V]∧", POSE),),
    cases=_cases,
    slips={
        "hat-one": lambda omega_z, v_x: twist_matrix(omega_z, v_x) + np.diag([0, 0, 0, 1]),
        "skew-sign": lambda omega_z, v_x: twist_matrix(-omega_z, v_x),
        "skew-symmetric": lambda omega_z, v_x: np.abs(twist_matrix(omega_z, v_x)),
        "transposed-answer": transposed(twist_matrix),
        "swapped-halves": lambda omega_z, v_x: tw.hat([v_x, 0, 0, 0, 0, omega_z]),
    },
    properties=(
        Property(
            Text("the last row is zero: [V]∧ is a derivative", "最后一行为零：[V]∧ 是导数"),
            lambda answer, omega_z, v_x: answer[3],
        ),
    ),
)

ARC = Part(
    solution=arc,
    doc=Text(
        """Return the placement exp([V]∧ t) at t = 1 s, V = (0, 0, omega_z, v_x, 0, 0), exactly.

        omega_z: number, rad/s, not 0. v_x: number, m/s.
        Returns: array (4, 4), lengths in m.""",
        """返回 t = 1 s 时的位姿 exp([V]∧ t)，V = (0, 0, omega_z, v_x, 0, 0)，要求精确解。

        omega_z：数，rad/s，不为 0。v_x：数，m/s。
        返回：数组 (4, 4)，长度单位 m。""",
    ),
    returns=(Quantity("T", POSE),),
    cases=_cases,
    slips={
        "first-order-exp": lambda omega_z, v_x: np.eye(4) + twist_matrix(omega_z, v_x),
        "second-order-exp": lambda omega_z, v_x: (
            np.eye(4) + twist_matrix(omega_z, v_x) + twist_matrix(omega_z, v_x) @ twist_matrix(omega_z, v_x) / 2
        ),
        "elementwise-exp": _exponential_of_blocks,
        "exp-straight": lambda omega_z, v_x: _moved(omega_z, v_x, v_x, 0),
        "exp-turned": lambda omega_z, v_x: _moved(omega_z, v_x, v_x * np.cos(omega_z), v_x * np.sin(omega_z)),
        "exp-minus": lambda omega_z, v_x: _moved(omega_z, v_x, arc(omega_z, v_x)[0, 3], -arc(omega_z, v_x)[1, 3]),
        "rotation-transposed": lambda omega_z, v_x: np.block(
            [[arc(omega_z, v_x)[:3, :3].mT, arc(omega_z, v_x)[:3, 3:]], [np.eye(4)[3:]]]
        ),
        "inverse-transform": lambda omega_z, v_x: np.linalg.inv(arc(omega_z, v_x)),
        "degrees": before(arc, np.radians, which=0),
    },
    properties=(
        Property(
            Text("the rotation has columns of length 1, at right angles", "旋转矩阵各列为单位长度且互相垂直"),
            lambda answer, omega_z, v_x: answer[:3, :3].mT @ answer[:3, :3] - np.eye(3),
        ),
        Property(
            Text("its logarithm is V again", "取对数应还原为 V"),
            lambda answer, omega_z, v_x: tw.log6(answer) - [0, 0, omega_z, v_x, 0, 0],
        ),
    ),
)

EXERCISE = Exercise(
    id="49.2.2",
    kind="code",
    title=Text("Driving along an arc", "沿圆弧运动"),
    text=Text(
        """A body has the constant body twist V = (0, 0, ω_z, v_x, 0, 0): it turns about z while it moves along its own
        x.
        Write down the matrix [V]∧, and the placement exp([V]∧ t) at t = 1, exactly, not as a series.""",
        """刚体的 body twist 恒为 V = (0, 0, ω_z, v_x, 0, 0)：绕 z 轴转动，同时沿自身 x 轴平移。
        写出矩阵 [V]∧，并求 t = 1 时的位姿 exp([V]∧ t)，要求精确解，不要用级数近似。""",
    ),
    parts=(MATRIX, ARC),
    hints=(
        Text(
            "Top left of [V]∧ stands [ω]×, in the last column v, below only zeros.",
            "[V]∧ 的左上是 [ω]×，最后一列是 v，最后一行全为零。",
        ),
        Text(
            "After the time t the body heads along (cos ω_z t, sin ω_z t). Integrate v_x times that from 0 to 1.",
            "t 时刻刚体朝向 (cos ω_z t, sin ω_z t)。把它乘以 v_x 从 0 积分到 1。",
        ),
        Text(
            "x = v_x sin ω_z / ω_z and y = v_x (1 − cos ω_z)/ω_z: an arc of radius v_x/ω_z.",
            "x = v_x sin ω_z / ω_z，y = v_x (1 − cos ω_z)/ω_z：半径为 v_x/ω_z 的圆弧。",
        ),
    ),
)

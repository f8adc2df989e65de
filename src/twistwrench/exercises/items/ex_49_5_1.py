"""Exercise 49.5.1: a spatial inertia by hand."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import INERTIA
from ..text import Text
from ..workbook import mine
from ..wrong import before, swapped
from .ex_49_0_1 import skew

__all__ = ["EXERCISE", "link_inertia", "random_body", "spatial_inertia"]


def spatial_inertia(m: Any, c: Any, I_c: Any) -> Any:
    """Inertia about the origin, out of ten numbers."""
    C = skew(c)
    return np.block([[I_c - m * C @ C, m * C], [-m * C, m * np.eye(3)]])


def link_inertia() -> Any:
    """Inertia of the link of the text, and its smallest eigenvalue."""
    build = mine("spatial_inertia")
    matrix = build(2.0, np.array([0, 0, 0.1]), np.diag([0.01, 0.01, 0.005]))
    return matrix, np.linalg.eigvalsh(matrix)[0]


def random_body(rng: np.random.Generator) -> Any:
    """Return mass, centre of mass and inertia about it of some body that can exist."""
    points, masses = rng.normal(scale=0.2, size=(6, 3)), rng.uniform(0.1, 1, 6)
    c = masses @ points / masses.sum()
    C = [skew(p - c) for p in points]
    return masses.sum(), c, sum(-m * C_i @ C_i for m, C_i in zip(masses, C))


def _built(m: Any, c: Any, I_c: Any, *, top_left: Any = None, top_right: Any = None, bottom_left: Any = None) -> Any:
    """Put other blocks into the matrix."""
    I6 = spatial_inertia(m, c, I_c)
    for index, block in (
        (np.s_[:3, :3], top_left),
        (np.s_[:3, 3:], top_right),
        (np.s_[3:, :3], bottom_left),
    ):
        if block is not None:
            I6[index] = block
    return I6


WRONG = {
    "parallel-axis-sign": lambda m, c, I_c: _built(m, c, I_c, top_left=I_c + m * skew(c) @ skew(c)),
    "parallel-axis-dropped": lambda m, c, I_c: _built(m, c, I_c, top_left=I_c),
    "parallel-axis-all": lambda m, c, I_c: _built(m, c, I_c, top_left=I_c + m * (c @ c) * np.eye(3)),
    "parallel-axis-outer": lambda m, c, I_c: _built(m, c, I_c, top_left=I_c + m * np.outer(c, c)),
    "com-sign": lambda m, c, I_c: spatial_inertia(m, -c, I_c),
    "com-dropped": lambda m, c, I_c: spatial_inertia(m, 0 * c, I_c),
    "inertia-asymmetric": lambda m, c, I_c: _built(m, c, I_c, bottom_left=m * skew(c)),
    "mass-dropped": lambda m, c, I_c: _built(
        m, c, I_c, top_left=I_c - skew(c) @ skew(c), top_right=skew(c), bottom_left=-skew(c)
    ),
    "swapped-halves": swapped(spatial_inertia),
}
"""What can go wrong with the matrix, whatever the body."""


def _of_link(wrong: Any, *, m: float = 2.0) -> Any:
    """Make the slips of a matrix in the matrix of the link, and find its smallest eigenvalue."""
    matrix = wrong(m, np.array([0, 0, 0.1]), np.diag([0.01, 0.01, 0.005]))
    return matrix, np.linalg.eigvals(matrix).real.min()


BY_HAND = Part(
    solution=link_inertia,
    doc=Text(
        """Return the spatial inertia of the link in the text, and its smallest eigenvalue.

        build(m, c, I_c) is your `spatial_inertia`; or write the matrix down, number by number.
        Returns: array (6, 6), in the order (ω, v), kg m², kg m and kg; and a number.
        An eigenvalue of this matrix mixes units: only its sign means something.""",
        """返回题中连杆的空间惯量矩阵及其最小特征值。

        build(m, c, I_c) 就是你的 `spatial_inertia`；也可以直接逐个写出矩阵的数。
        返回：数组 (6, 6)，顺序 (ω, v)，单位 kg m²、kg m 与 kg；以及一个数。
        这个矩阵的特征值混合了不同单位，只有正负号有意义。""",
    ),
    given='build = mine("spatial_inertia")',
    returns=(Quantity("I", INERTIA), Quantity("smallest eigenvalue")),
    cases=lambda rng: [()],
    rtol=5e-4,
    slips={
        **{slip: (lambda wrong=wrong: _of_link(wrong)) for slip, wrong in WRONG.items()},
        "thousand": lambda: _of_link(spatial_inertia, m=2000.0),
        "determinant-for-eigenvalue": lambda: (link_inertia()[0], np.linalg.det(link_inertia()[0])),
        "largest-eigenvalue": lambda: (link_inertia()[0], np.linalg.eigvalsh(link_inertia()[0])[-1]),
    },
    properties=(
        Property(Text("the matrix is symmetric", "矩阵对称"), lambda answer: answer[0] - answer[0].mT),
        Property(
            Text(
                "turning about its own centre of mass, the link does not move there",
                "连杆绕自身质心转动时，质心速度为零",
            ),
            lambda answer: (answer[0] @ [1, 0, 0, 0, 0.1, 0])[3:],
        ),
    ),
)

IN_GENERAL = Part(
    solution=spatial_inertia,
    doc=Text(
        """Return the spatial inertia of a body about the origin of its frame.

        m: number, kg. c: array (3,), m, the centre of mass.
        I_c: array (3, 3), kg m², about the centre of mass, along the axes of the frame.
        Returns: array (6, 6), in the order (ω, v).""",
        """返回刚体关于本体坐标系原点的空间惯量矩阵。

        m：数，kg。c：数组 (3,)，单位 m，质心位置。
        I_c：数组 (3, 3)，kg m²，关于质心，用本体坐标轴。
        返回：数组 (6, 6)，顺序 (ω, v)。""",
    ),
    returns=(Quantity("I", INERTIA),),
    cases=lambda rng: [random_body(rng) for _ in range(5)],
    slips={
        **WRONG,
        "products-sign": before(spatial_inertia, lambda I_c: 2 * np.diag(I_c.diagonal()) - I_c, which=2),
        "products-dropped": before(spatial_inertia, lambda I_c: np.diag(I_c.diagonal()), which=2),
    },
    properties=(
        Property(Text("the matrix is symmetric", "矩阵对称"), lambda answer, m, c, I_c: answer - answer.mT),
        Property(
            Text(
                "½ VᵀIV is the kinetic energy ½ m v_c² + ½ ωᵀI_cω, with v_c = v + ω × c",
                "½ VᵀIV 等于动能 ½ m v_c² + ½ ωᵀI_cω，其中 v_c = v + ω × c",
            ),
            lambda answer, m, c, I_c: _energies(answer, m, c, I_c),
        ),
    ),
)


def _energies(I6: Any, m: Any, c: Any, I_c: Any) -> Any:
    """Return by how much twice the energy differs between six numbers and three, for some twists."""
    V = np.arange(48.0).reshape(8, 6) % 5 - 2
    w, v_c = V[:, :3], V[:, 3:] + np.cross(V[:, :3], c)
    return ((V @ I6.mT) * V).sum(1) - m * (v_c**2).sum(1) - ((w @ I_c) * w).sum(1)


EXERCISE = Exercise(
    id="49.5.1",
    kind="number",
    title=Text("Ten numbers, a 6 × 6 matrix", "十个数与一个 6 × 6 矩阵"),
    uses=("skew",),
    text=Text(
        """A link has the mass m = 2 kg, its centre of mass at c = (0, 0, 0.1) m, and the inertia
        I_c = diag(0.01, 0.01, 0.005) kg m² about that. Write down its spatial inertia by hand. Is it symmetric and
        positive definite? The smallest eigenvalue tells.

        First write the formula as a function: later exercises use it.""",
        """一个连杆质量 m = 2 kg，质心 c = (0, 0, 0.1) m，关于质心的惯量 I_c = diag(0.01, 0.01, 0.005) kg m²。
        手算写出它的空间惯量矩阵。它对称正定吗？由最小特征值判断。

        先把公式写成函数，后面的练习要用。""",
    ),
    parts=(IN_GENERAL, BY_HAND),
    hints=(
        Text(
            "Momentum is I V. The linear half is m v_c with v_c = v + ω × c, the velocity of the centre of mass.",
            "动量是 I V。线动量为 m v_c，其中质心速度 v_c = v + ω × c。",
        ),
        Text(
            "ω × c = −[c]× ω gives the bottom row, (−m [c]×, m 1). Symmetry gives the block top right.",
            "由 ω × c = −[c]× ω 得下面一行 (−m [c]×, m 1)；由对称性得右上块。",
        ),
        Text(
            "Top left stands the inertia about the origin: I_c − m [c]×². By hand: add m (|c|² 1 − c cᵀ). About the z "
            "axis, along which c points, that is nothing.",
            "左上是关于原点的惯量 I_c − m [c]×²。手算：加上 m (|c|² 1 − c cᵀ)；c 沿 z 轴，所以绕 z 轴不增加。",
        ),
    ),
)

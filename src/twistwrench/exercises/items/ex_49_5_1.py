"""Exercise 49.5.1: a spatial inertia by hand."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part
from misstep.faults import before

from ..layouts import INERTIA
from ..public import mine
from ..wrong import faulty, swapped
from .ex_49_0_1 import skew

__all__ = ["EXERCISE", "WRONG", "link_inertia", "random_body", "spatial_inertia"]


def spatial_inertia(m: Any, c: Any, I_c: Any) -> Any:
    """Inertia about the origin, out of ten numbers."""
    C = skew(c)
    return np.block([[I_c - m * C @ C, m * C], [-m * C, m * np.eye(3)]])


def link_inertia() -> Any:
    """Inertia of the link of the text, and its eigenvalues."""
    build = mine("spatial_inertia")
    matrix = build(2.0, np.array([0, 0, 0.1]), np.diag([0.01, 0.01, 0.005]))
    return matrix, np.linalg.eigvalsh(matrix)


def random_body(rng: np.random.Generator) -> Any:
    """Return mass, centre of mass and inertia about it of some physical body."""
    points, masses = rng.normal(scale=0.2, size=(6, 3)), rng.uniform(0.1, 1, 6)
    c = masses @ points / masses.sum()
    C = [skew(p - c) for p in points]
    return masses.sum(), c, sum(-m * C_i @ C_i for m, C_i in zip(masses, C))


WRONG = {
    "parallel-axis-sign": faulty(spatial_inertia, ("I_c - m", "I_c + m")),
    "parallel-axis-dropped": faulty(spatial_inertia, (" - m * C @ C", "")),
    "parallel-axis-all": faulty(spatial_inertia, ("- m * C @ C", "+ m * (c @ c) * np.eye(3)")),
    "parallel-axis-outer": faulty(spatial_inertia, ("- m * C @ C", "+ m * np.outer(c, c)")),
    "scalar-for-matrix": faulty(spatial_inertia, ("- m * C @ C", "+ m * (c @ c - np.outer(c, c))")),
    "com-sign": faulty(spatial_inertia, ("skew(c)", "-skew(c)")),
    "com-dropped": faulty(spatial_inertia, ("skew(c)", "0 * skew(c)")),
    "coupling-dropped": faulty(spatial_inertia, ("m * C], [-m * C,", "0 * C], [0 * C,")),
    "inertia-asymmetric": faulty(spatial_inertia, ("[-m * C", "[m * C")),
    "mass-dropped": faulty(spatial_inertia, ("m * C @ C, m * C], [-m * C", "C @ C, C], [-C")),
    "parallel-axis-massless": faulty(spatial_inertia, ("- m * C @ C", "- C @ C")),
    "coupling-massless": faulty(spatial_inertia, ("m * C], [-m * C,", "C], [-C,")),
    "swapped-halves": swapped(spatial_inertia),
}
"""The slips of the matrix, for any body."""


def _link_eigenvalues(wrong: Any, *, m: float = 2.0) -> Any:
    """Make the slips of a matrix in the matrix of the link, and find its eigenvalues."""
    matrix = wrong(m, np.array([0, 0, 0.1]), np.diag([0.01, 0.01, 0.005]))
    return matrix, np.sort(np.linalg.eigvals(matrix).real)


BY_HAND = Part(
    solution=link_inertia,
    given='build = mine("spatial_inertia")',
    returns=(Output("I", INERTIA), Output("eigenvalues", zh="特征值")),
    cases=lambda rng: [()],
    rtol=2e-5,  # the least eigenvalue is 0.0099, the largest 2.02
    slips={
        **{slip: (lambda wrong=wrong: _link_eigenvalues(wrong)) for slip, wrong in WRONG.items()},
        "distance-not-squared": lambda: _link_eigenvalues(
            faulty(spatial_inertia, ("- m * C @ C", "- m * C @ C / np.linalg.norm(c)"))
        ),
        "thousand": lambda: _link_eigenvalues(spatial_inertia, m=2000.0),
        "diagonal-for-eigenvalues": lambda: (link_inertia()[0], np.sort(np.diag(link_inertia()[0]))),
    },
    residuals=(
        lambda answer: answer[0] - answer[0].mT,
        lambda answer: (answer[0] @ [1, 0, 0, 0, 0.1, 0])[3:],
    ),
)

IN_GENERAL = Part(
    solution=spatial_inertia,
    returns=(Output("I", INERTIA),),
    cases=lambda rng: [random_body(rng) for _ in range(5)],
    edges=lambda rng: [(1.5, rng.standard_normal(3), np.zeros((3, 3))), (0.0, np.zeros(3), np.diag([1.0, 2, 3]))],
    slips={
        **WRONG,
        "parallel-axis-products": faulty(
            spatial_inertia, ("- m * C @ C", "+ m * (np.outer(c, c) + np.diag(c @ c - 2 * c**2))")
        ),
        "squares-for-norm": faulty(spatial_inertia, ("- m * C @ C", "+ m * (np.diag(c**2) - np.outer(c, c))")),
        "products-sign": before(spatial_inertia, lambda I_c: 2 * np.diag(I_c.diagonal()) - I_c, which=2),
        "products-dropped": before(spatial_inertia, lambda I_c: np.diag(I_c.diagonal()), which=2),
    },
    residuals=(
        lambda answer, m, c, I_c: answer - answer.mT,
        lambda answer, m, c, I_c: _energies(answer, m, c, I_c),
    ),
)


def _energies(I6: Any, m: Any, c: Any, I_c: Any) -> Any:
    """Return by how much twice the energy differs between six numbers and three, for some twists."""
    V = np.arange(48.0).reshape(8, 6) % 5 - 2
    w, v_c = V[:, :3], V[:, 3:] + np.cross(V[:, :3], c)
    return ((V @ I6.mT) * V).sum(1) - m * (v_c**2).sum(1) - ((w @ I_c) * w).sum(1)


EXERCISE = Exercise(id="49.5.1", kind="number", uses=("skew",), parts=(IN_GENERAL, BY_HAND))

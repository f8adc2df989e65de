"""Exercise 49.10.1: the blocks of the centroidal momentum matrix."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part

from ..layouts import INERTIA, JOINTS_MAP
from ..robots import larger, states
from ..wrong import faulty, swapped

__all__ = ["EXERCISE", "base_columns", "split_map"]


def split_map(model: Any, q: Any) -> Any:
    """Split A_G into its columns for the base and for the joints."""
    A_G = tw.centroidal_map(model, q)
    return A_G[:, :6], A_G[:, 6:]


def base_columns(R: Any, m: Any, c: Any, I_G: Any) -> Any:
    """A_G's columns for the base, from the robot as one rigid body."""
    return np.block([[R @ I_G, np.zeros((3, 3))], [-m * tw.skew(c) @ R, m * R]])


def _bodies(rng: Any) -> Any:
    bodies = []
    for model, q in states(rng):
        T = tw.forward_kinematics(model, q).placement[1]
        whole = tw.SpatialInertia.from_matrix(tw.crba(model, q)[:6, :6])
        bodies.append((T.rotation, float(whole.mass), T.rotation @ whole.com, whole.inertia_at_com))
    return bodies


SPLIT = Part(
    solution=split_map,
    returns=(Output("A_Gb", INERTIA), Output("A_Gj", JOINTS_MAP)),
    cases=lambda rng: [*states(rng), *larger(rng)],
    slips={
        "swapped-halves": faulty(split_map, ("tw.centroidal_map(model, q)", "swap(tw.centroidal_map(model, q))")),
        "rows-exchanged": faulty(
            split_map, ("tw.centroidal_map(model, q)", "np.array([*map(swap, tw.centroidal_map(model, q).mT)]).mT")
        ),
        "columns-exchanged": faulty(
            split_map, ("tw.centroidal_map(model, q)", "np.array([*map(swap, tw.centroidal_map(model, q))])")
        ),
        "momentum-at-origin": faulty(
            split_map,
            ("tw.centroidal_map", "tw.force_transform(np.eye(3), tw.center_of_mass(model, q)) @ tw.centroidal_map"),
        ),
        "momentum-at-base": faulty(
            split_map,
            (
                "tw.centroidal_map",
                "tw.force_transform(np.eye(3), tw.center_of_mass(model, q) - q[:3]) @ tw.centroidal_map",
            ),
        ),
        "nq-for-nv": faulty(split_map, ("A_G[:, :6], A_G[:, 6:]", "A_G[:, :7], A_G[:, 7:]")),
        "base-last": faulty(split_map, ("A_G[:, :6], A_G[:, 6:]", "A_G[:, -6:], A_G[:, :-6]")),
        "transposed-answer": lambda model, q: tuple(block.mT for block in split_map(model, q)),
        "split-by-rows": faulty(split_map, ("A_G[:, :6], A_G[:, 6:]", "A_G[:3], A_G[3:]")),
    },
    residuals=(lambda answer, model, q: answer[0][:3, 3:],),
)

COLUMNS = Part(
    solution=base_columns,
    returns=(Output("A_Gb", INERTIA),),
    cases=_bodies,
    slips={
        "com-dropped": faulty(base_columns, ("-m * tw.skew(c) @ R", "np.zeros((3, 3))")),
        "com-sign": faulty(base_columns, ("-m *", "m *")),
        "coupling-corner": faulty(
            base_columns, ("np.zeros((3, 3))", "m * tw.skew(c) @ R"), ("-m * tw.skew(c) @ R", "np.zeros((3, 3))")
        ),
        "coupling-order": faulty(base_columns, ("tw.skew(c) @ R", "R @ tw.skew(c)")),
        "coupling-unrotated": faulty(base_columns, ("tw.skew(c) @ R", "tw.skew(c)")),
        "mass-dropped": faulty(base_columns, ("-m * tw.skew(c) @ R, m * R", "-tw.skew(c) @ R, R")),
        "untransformed": faulty(
            base_columns, ("R @ I_G", "I_G"), ("tw.skew(c) @ R, m * R", "tw.skew(c), m * np.eye(3)")
        ),
        "half-rotated": faulty(base_columns, (", m * R", ", m * np.eye(3)")),
        "rotation-transposed": lambda R, m, c, I_G: base_columns(R.mT, m, c, I_G),
        "turned-twice": faulty(base_columns, ("R @ I_G", "R @ I_G @ R.mT")),
        "momentum-at-base": faulty(
            base_columns, ("R @ I_G, np.zeros((3, 3))", "R @ I_G - m * tw.skew(c) @ tw.skew(c) @ R, m * tw.skew(c) @ R")
        ),
        "swapped-halves": swapped(base_columns),
        "aligned-for-local": lambda R, m, c, I_G: base_columns(R, m, c, I_G) @ np.kron(np.eye(2), R.mT),
    },
    residuals=(
        lambda answer, R, m, c, I_G: answer[:3, 3:],
        lambda answer, R, m, c, I_G: [
            answer[3:] @ V - m * (R @ V[3:] + np.cross(R @ V[:3], c))
            for V in np.random.default_rng(0).standard_normal((3, 6))
        ],
    ),
)

EXERCISE = Exercise(id="49.10.1", kind="explain", parts=(SPLIT, COLUMNS))

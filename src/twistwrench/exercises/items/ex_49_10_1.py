"""Exercise 49.10.1: the blocks of the centroidal momentum matrix."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import CENTROIDAL_MAP, INERTIA
from ..robots import robot, small_robot
from ..wrong import swapped

__all__ = ["EXERCISE", "base_columns", "split_map"]


def split_map(model: Any, q: Any) -> Any:
    """Split A_G into its columns for the base and for the joints."""
    A_G = tw.centroidal_map(model, q)
    return A_G[:, :6], A_G[:, 6:]


def base_columns(R: Any, m: Any, c: Any, I_G: Any) -> Any:
    """A_G's columns for the base, from the robot as one rigid body."""
    return np.block([[R @ I_G, np.zeros((3, 3))], [-m * tw.skew(c) @ R, m * R]])


def _blocks(change: Any) -> Any:
    """Change A_G before it is split."""

    def wrong(model: Any, q: Any) -> Any:
        A_G = change(model, q, tw.centroidal_map(model, q))
        return A_G[:, :6], A_G[:, 6:]

    return wrong


def _about(point: Any) -> Any:
    """Take the angular momentum about another point: it gains (p_G − point) × l."""

    def change(model: Any, q: Any, A_G: Any) -> Any:
        arm = tw.skew(tw.center_of_mass(model, q) - point(q))
        return np.concatenate([A_G[:3] + arm @ A_G[3:], A_G[3:]])

    return _blocks(change)


def _at(places: Any) -> Any:
    """Cut A_G at other places."""

    def wrong(model: Any, q: Any) -> Any:
        A_G = tw.centroidal_map(model, q)
        base, joints = places
        return A_G[:, base], A_G[:, joints]

    return wrong


def _exchanged(*, rows: bool, columns: bool) -> Any:
    """Exchange the halves of the rows, of the base's columns, or of both."""
    order = [k + 3 if k < 3 else k - 3 for k in range(6)]

    def wrong(model: Any, q: Any) -> Any:
        base, joints = split_map(model, q)
        if rows:
            base, joints = base[order], joints[order]
        return (base[:, order] if columns else base), joints

    return wrong


def _quarters(change: Any) -> Any:
    """Put other things in the quarters, given R, m, [c]× and I_G."""
    return lambda R, m, c, I_G: np.block(change(R, m, tw.skew(c), I_G))


ZERO = np.zeros((3, 3))


def _bodies(rng: Any) -> Any:
    bodies = []
    for model in (robot("go2"), small_robot(rng), small_robot(rng)):
        q = model.random_configuration(rng=rng)
        T = tw.forward_kinematics(model, q).placement[1]
        whole = tw.SpatialInertia.from_matrix(tw.crba(model, q)[:6, :6])
        bodies.append((T.rotation, float(whole.mass), T.rotation @ whole.com, whole.inertia_at_com))
    return bodies


SPLIT = Part(
    solution=split_map,
    returns=(Quantity("A_Gb", INERTIA), Quantity("A_Gj", CENTROIDAL_MAP)),
    cases=lambda rng: [
        (model, model.random_configuration(rng=rng)) for model in (robot("go2"), small_robot(rng), small_robot(rng))
    ],
    slips={
        "swapped-halves": _exchanged(rows=True, columns=True),
        "rows-only": _exchanged(rows=True, columns=False),
        "columns-only": _exchanged(rows=False, columns=True),
        "momentum-at-origin": _about(lambda q: np.zeros(3)),
        "momentum-at-base": _about(lambda q: q[:3]),
        "nq-for-nv": _at((slice(0, 7), slice(7, None))),
        "base-last": _at((slice(-6, None), slice(0, -6))),
        "transposed-answer": lambda model, q: tuple(block.mT for block in split_map(model, q)),
    },
    residuals=(lambda answer, model, q: answer[0][:3, 3:],),
)

COLUMNS = Part(
    solution=base_columns,
    returns=(Quantity("A_Gb", INERTIA),),
    cases=_bodies,
    slips={
        "com-dropped": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [ZERO, m * R]]),
        "com-sign": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [m * c @ R, m * R]]),
        "coupling-corner": _quarters(lambda R, m, c, I: [[R @ I, m * c @ R], [ZERO, m * R]]),
        "coupling-order": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [-m * R @ c, m * R]]),
        "coupling-unrotated": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [-m * c, m * R]]),
        "mass-dropped": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [-c @ R, R]]),
        "untransformed": _quarters(lambda R, m, c, I: [[I, ZERO], [-m * c, m * np.eye(3)]]),
        "half-rotated": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [-m * c @ R, m * np.eye(3)]]),
        "rotation-transposed": _quarters(lambda R, m, c, I: [[R.mT @ I, ZERO], [-m * c @ R.mT, m * R.mT]]),
        "turned-twice": _quarters(lambda R, m, c, I: [[R @ I @ R.mT, ZERO], [-m * c @ R, m * R]]),
        "momentum-at-base": _quarters(lambda R, m, c, I: [[R @ I - m * c @ c @ R, m * c @ R], [-m * c @ R, m * R]]),
        "swapped-halves": swapped(base_columns),
    },
    residuals=(
        lambda answer, R, m, c, I_G: answer[:3, 3:],
        lambda answer, R, m, c, I_G: [
            answer[3:] @ V - m * (R @ V[3:] + np.cross(R @ V[:3], c))
            for V in np.random.default_rng(0).standard_normal((3, 6))
        ],
    ),
)

EXERCISE = Exercise(
    id="49.10.1",
    kind="explain",
    parts=(SPLIT, COLUMNS),
)

"""Exercise 49.5.2: the inertia of Go2's base."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part

from ..layouts import INERTIA
from ..public import mine
from ..robots import robot, small_robot
from ..wrong import faulty, swapped
from .ex_49_5_1 import WRONG, random_body, spatial_inertia

__all__ = ["EXERCISE", "base_inertia", "chapter_order"]


def chapter_order(I: Any) -> Any:
    """From (v, ω) to (ω, v)."""
    order = np.r_[3:6, 0:3]
    return I[np.ix_(order, order)]


def base_inertia(model: Any) -> Any:
    """Mass of the base, and its inertia by hand."""
    build = mine("spatial_inertia")
    base = model.inertia[1]
    return base.mass, build(base.mass, base.com, base.inertia_at_com)


EXCHANGE = np.kron([[0, 1], [1, 0]], np.eye(3))
"""Exchanges the halves of a vector."""

LINK_BASE = (
    6.921,
    np.array([0.021112, 0, -0.005366]),
    np.array([[0.02448, 0.00012166, 0.0014849], [0.00012166, 0.098077, -3.12e-05], [0.0014849, -3.12e-05, 0.107]]),
)
"""Mass, centre of mass and inertia of the link `base` alone, as its URDF has them."""


def _numbers(model: Any) -> Any:
    base = model.inertia[1]
    return base.mass, base.com, base.inertia_at_com


def _whole(model: Any) -> Any:
    """Return mass and inertia of the whole robot in its neutral posture, in the base's frame."""
    locked = tw.SpatialInertia.from_matrix(tw.crba(model, model.neutral())[:6, :6])
    return locked.mass, locked.matrix()


def _with_mass(model: Any, m: float) -> Any:
    base = model.inertia[1]
    return m, spatial_inertia(m, base.com, base.inertia_at_com)


def _linear_first(rng: Any) -> Any:
    """Return inertias of random bodies in the order (v, ω)."""
    return [(swapped(spatial_inertia)(*random_body(rng)),) for _ in range(4)]


def _light_base(rng: Any) -> Any:
    """Return a robot whose base is lighter than what it carries."""
    model = small_robot(rng)
    base = model.inertia[1]
    light = tw.SpatialInertia(0.1 * base.mass, base.com, 0.1 * base.inertia_at_com)
    return [(tw.replace_inertia(model, model.joint_names[1], light),)]


def _draw_inertias(rng: Any) -> Any:
    """Return the inertia of the universe, and of a body whose frame is at its centre of mass."""
    m, c, I_c = random_body(rng)
    return [(np.zeros((6, 6)),), (swapped(spatial_inertia)(m, 0 * c, I_c),)]


REORDERED = Part(
    solution=chapter_order,
    returns=(Output("I", INERTIA),),
    cases=_linear_first,
    edges=_draw_inertias,
    slips={
        "swapped-halves": lambda I: I,
        "rows-only": lambda I: EXCHANGE @ I,
        "columns-only": lambda I: I @ EXCHANGE,
        "reversed": lambda I: I[::-1, ::-1],
        "diagonal-blocks-only": lambda I: np.block([[I[3:, 3:], I[:3, 3:]], [I[3:, :3], I[:3, :3]]]),
        "off-diagonal-blocks-only": lambda I: np.block([[I[:3, :3], I[3:, :3]], [I[:3, 3:], I[3:, 3:]]]),
        "rolled-by-six": lambda I: I.ravel()[np.arange(36).reshape(6, 6) - 6],
        "rolled-by-three": lambda I: I.ravel()[np.arange(36).reshape(6, 6) - 3],
        "diagonal-picked": lambda I: chapter_order(I).diagonal(),
    },
    residuals=(lambda answer, I: answer[3:, 3:] - I[0, 0] * np.eye(3),),
)

OF_BASE = Part(
    solution=base_inertia,
    given='build = mine("spatial_inertia")',
    returns=(Output("m", unit="kg"), Output("I", INERTIA)),
    cases=lambda rng: [(robot("go2"),), (robot("humanoid"),)],
    edges=_light_base,
    slips={
        "universe-for-base": lambda model: (0.0, np.zeros((6, 6))),
        "heaviest-for-base": faulty(base_inertia, ("model.inertia[1]", "max(model.inertia, key=lambda x: x.mass)")),
        "welded-left-out": lambda model: (
            (LINK_BASE[0], spatial_inertia(*LINK_BASE)) if model.name == "go2" else base_inertia(model)
        ),
        "whole-for-base": _whole,
        "mass-of-whole": lambda model: _with_mass(model, model.mass),
        "mass-of-link": lambda model: _with_mass(model, LINK_BASE[0]),
        "swapped-halves": faulty(
            base_inertia,
            (
                "build(base.mass, base.com, base.inertia_at_com)",
                "swap(build(base.mass, base.com, base.inertia_at_com))",
            ),
        ),
        "com-dropped": faulty(base_inertia, ("base.com", "0 * base.com")),
        "com-sign": faulty(base_inertia, ("base.com", "-base.com")),
        "mass-dropped": faulty(base_inertia, ("build(base.mass", "build(1.0")),
        "products-dropped": faulty(base_inertia, ("base.inertia_at_com", "np.diag(base.inertia_at_com.diagonal())")),
        "products-sign": faulty(
            base_inertia, ("base.inertia_at_com", "2 * np.diag(base.inertia_at_com.diagonal()) - base.inertia_at_com")
        ),
        "inertia-at-origin": lambda model: (model.inertia[1].mass, WRONG["parallel-axis-dropped"](*_numbers(model))),
        "parallel-axis-twice": faulty(base_inertia, ("base.inertia_at_com", "base.matrix()[:3, :3]")),
        "parallel-axis-sign": lambda model: (model.inertia[1].mass, WRONG["parallel-axis-sign"](*_numbers(model))),
    },
    residuals=(lambda answer, model: answer[1] - model.inertia[1].matrix(),),
)

EXERCISE = Exercise(id="49.5.2", kind="explain", parts=(REORDERED, OF_BASE))

"""Exercise 49.5.2: the inertia of Go2's base."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import INERTIA
from ..robots import robot
from ..workbook import mine
from ..wrong import swapped
from .ex_49_5_1 import random_body, spatial_inertia

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


def _numbers(model: Any, body: int = 1) -> Any:
    return model.inertia[body].mass, model.inertia[body].com, model.inertia[body].inertia_at_com


def _changed(change: Any) -> Any:
    """Change mass, centre of mass and inertia before the matrix is built."""

    def wrong(model: Any) -> Any:
        m, c, I_c = change(*_numbers(model))
        return _numbers(model)[0], spatial_inertia(m, c, I_c)

    return wrong


def _whole(model: Any) -> Any:
    """Return mass and inertia of the whole robot in its neutral posture, in the base's frame."""
    locked = tw.SpatialInertia.from_matrix(tw.crba(model, model.neutral())[:6, :6])
    return locked.mass, locked.matrix()


def _inertia_at_origin(model: Any) -> Any:
    m, c, I_c = _numbers(model)
    I6 = spatial_inertia(m, c, I_c)
    I6[:3, :3] = I_c
    return m, I6


def _parallel_axis_sign(model: Any) -> Any:
    m, c, I_c = _numbers(model)
    I6 = spatial_inertia(m, c, I_c)
    I6[:3, :3] = 2 * I_c - I6[:3, :3]
    return m, I6


def _linear_first(rng: Any) -> Any:
    """Return inertias of random bodies in the order (v, ω)."""
    return [(swapped(spatial_inertia)(*random_body(rng)),) for _ in range(4)]


REORDERED = Part(
    solution=chapter_order,
    returns=(Quantity("I", INERTIA),),
    cases=_linear_first,
    slips={
        "swapped-halves": lambda I: I,
        "rows-only": lambda I: EXCHANGE @ I,
        "columns-only": lambda I: I @ EXCHANGE,
        "reversed": lambda I: I[::-1, ::-1],
    },
    residuals=(lambda answer, I: answer[3:, 3:] - I[0, 0] * np.eye(3),),
)

OF_BASE = Part(
    solution=base_inertia,
    given='build = mine("spatial_inertia")',
    returns=(Quantity("m", unit="kg"), Quantity("I", INERTIA)),
    cases=lambda rng: [(robot("go2"),), (robot("humanoid"),)],
    slips={
        "universe-for-base": lambda model: (0.0, np.zeros((6, 6))),
        "welded-left-out": lambda model: (
            (LINK_BASE[0], spatial_inertia(*LINK_BASE)) if model.name == "go2" else base_inertia(model)
        ),
        "whole-for-base": _whole,
        "swapped-halves": lambda model: (_numbers(model)[0], swapped(spatial_inertia)(*_numbers(model))),
        "com-dropped": _changed(lambda m, c, I_c: (m, 0 * c, I_c)),
        "com-sign": _changed(lambda m, c, I_c: (m, -c, I_c)),
        "mass-dropped": _changed(lambda m, c, I_c: (1.0, c, I_c)),
        "products-dropped": _changed(lambda m, c, I_c: (m, c, np.diag(I_c.diagonal()))),
        "products-sign": _changed(lambda m, c, I_c: (m, c, 2 * np.diag(I_c.diagonal()) - I_c)),
        "inertia-at-origin": _inertia_at_origin,
        "parallel-axis-sign": _parallel_axis_sign,
    },
    residuals=(lambda answer, model: answer[1] - model.inertia[1].matrix(),),
)

EXERCISE = Exercise(
    id="49.5.2",
    kind="explain",
    parts=(REORDERED, OF_BASE),
)

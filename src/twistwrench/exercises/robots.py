"""The robots of the exercises: those of the catalogue, each loaded once, and small random ones."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from ..algorithms.crba import crba
from ..algorithms.rnea import nonlinear_effects
from ..arrays import Array
from ..loading import load
from ..model import Model, chain, random_tree, replace_inertia
from ..spatial import SpatialInertia

__all__ = [
    "ball_robots",
    "bare_robot",
    "held_acceleration",
    "larger",
    "massless_link",
    "robot",
    "small_robot",
    "states",
    "weightless",
]


@cache
def robot(name: str) -> Model:
    """Return a robot of the catalogue.

    Examples
    --------
    >>> robot("go2").nv
    18
    """
    return load(name)


def small_robot(rng: np.random.Generator) -> Model:
    """Return a random robot: a floating base and three joints.

    Examples
    --------
    >>> small_robot(np.random.default_rng(1)).nv
    9
    """
    return random_tree(4, rng=rng, base="floating", kinds=("revolute", "prismatic"))


@cache
def bare_robot() -> Model:
    """Return a floating base without joints.

    Examples
    --------
    >>> bare_robot().nv
    6
    """
    return random_tree(1, rng=1, base="floating")


@cache
def ball_robots() -> tuple[Model, ...]:
    """Return a robot with ball joints and joints that turn without end, and one of them whose gravity is another's.

    Examples
    --------
    >>> [(model.nq - model.nv, float(model.gravity[2])) for model in ball_robots()]
    [(4, -9.81), (4, -1.62)]
    """
    model = random_tree(4, rng=0, base="floating", kinds=("spherical", "continuous"))
    return model, replace(model, gravity=np.array([0.3, 0.2, -1.62]))


@cache
def massless_link() -> Model:
    """Return a robot with a link that has no mass but an inertia, as a rotor is given, and carries another one.

    Examples
    --------
    >>> model = massless_link()
    >>> float(model.inertia[2].mass), 2 in model.parent
    (0.0, True)
    """
    model = chain(4, base="floating")
    rotor = SpatialInertia(0.0, np.zeros(3), np.diag([0.01, 0.02, 0.03]))
    return replace_inertia(model, model.joint_names[2], rotor, physical=False)


def states(rng: np.random.Generator, *, vectors: int = 0, small: int = 2) -> Iterator[Any]:
    """Yield Go2 and some small robots, each with a configuration and so many random vectors of nv numbers.

    Examples
    --------
    >>> [[x.shape for x in case] for _, *case in states(np.random.default_rng(1), vectors=1, small=1)]
    [[(19,), (18,)], [(10,), (9,)]]
    """
    for model in (robot("go2"), *(small_robot(rng) for _ in range(small))):
        yield model, model.random_configuration(rng=rng), *rng.standard_normal((vectors, model.nv))


def larger(rng: np.random.Generator) -> list[tuple[Model, Array]]:
    """Return a random robot with more joints than Go2, and a configuration: sizes of Go2 do not fit it.

    Examples
    --------
    >>> larger(np.random.default_rng(1))[0][0].nv
    21
    """
    model = random_tree(16, rng=rng, base="floating", kinds=("revolute", "prismatic"))
    return [(model, model.random_configuration(rng=rng))]


def weightless(model: Model) -> Model:
    """Return the same robot without gravity.

    Examples
    --------
    >>> weightless(robot("go2")).gravity
    array([0., 0., 0.])
    """
    return replace(model, gravity=np.zeros(3))


def held_acceleration(model: Model, q: Array, v: Array, tau: Array) -> Array:
    """Return the accelerations of a robot whose floating base is held where it is.

    Examples
    --------
    >>> model, rest = robot("go2"), np.zeros(18)
    >>> held_acceleration(model, model.standing(), rest, rest)[:6]
    array([0., 0., 0., 0., 0., 0.])
    """
    force = (tau - nonlinear_effects(model, q, v))[6:]
    return np.concatenate([np.zeros(6), np.linalg.solve(crba(model, q)[6:, 6:], force)])

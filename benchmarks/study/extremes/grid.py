"""The cells: each dimension on its way to its limits, and every two of them at their ends."""

from __future__ import annotations

from itertools import combinations, product

import numpy as np

from .robots import Recipe

__all__ = ["DIMENSIONS", "ENDS", "WORDS", "cells", "of_pair", "of_value"]

PI = float(np.pi)
DECADES = (1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9)
VANISHING = (1e-3, 1e-6, 1e-9, 1e-12, 0.0)

DIMENSIONS: dict[str, tuple[float, ...]] = {
    "mass_ratio": DECADES,
    "bodies": (1, 2, 3, 10, 30, 100, 300, 1000),
    "leaves": (2, 10, 100, 1000),
    "distance": (0.0, 1e3, 1e6, 1e9),
    "speed": (1e-12, 1e-6, 1e-3, 1e3, 1e8),
    "base_speed": (0.0, 1e2, 1e4, 1e6, 1e8),
    "length": DECADES,
    "mass": DECADES,
    "time": DECADES,
    "light": VANISHING,
    "tip": VANISHING,
    "rotor": (1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9),
    "angle": (0.0, 1e-9, PI, -PI, 1e8),
    "parallel": (1e-1, 1e-3, 1e-6, 1e-9, 0.0),
    "norm": (1e-150, 1e-9, 1e9, 1e150),
    "off": (1e-16, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1),
    "edge": (1e-3, 1e-6, 1e-9, 1e-12, 0.0, -1e-3),
}
"""The values of every dimension, besides the usual one; of `leaves` the number of bodies."""

WORDS = {
    "mass_ratio": "mass ratio tip : base",
    "bodies": "bodies in a chain",
    "leaves": "bodies, all at the base",
    "distance": "base from the origin [m]",
    "speed": "speed [rad/s, m/s]",
    "base_speed": "speed of the base alone [m/s]",
    "length": "metres per unit",
    "mass": "kilograms per unit",
    "time": "seconds per unit",
    "light": "mass factor, link in the middle",
    "tip": "mass factor, last link",
    "rotor": "rotor : rod inertia",
    "angle": "joint angles [rad]",
    "parallel": "angle between axes that meet [rad]",
    "norm": "quaternion norm, normalised",
    "off": "quaternion off norm 1",
    "edge": "short of the triangle inequality",
}
"""The label of a row of the map."""

ENDS: dict[str, tuple[float, ...]] = {
    "mass_ratio": (1e9, 1e-9),
    "bodies": (20,),
    "leaves": (7,),
    "distance": (1e9,),
    "speed": (1e8, 1e-12),
    "base_speed": (1e6,),
    "length": (1e-9, 1e9),
    "mass": (1e9, 1e-9),
    "time": (1e-9, 1e9),
    "light": (1e-9,),
    "tip": (1e-9,),
    "rotor": (1e9, 1e-6),
    "angle": (1e8, 0.0),
    "parallel": (1e-6,),
    "off": (1e-9,),
    "edge": (0.0,),
}
"""The values that pairs are made of; the short form takes the first of each."""

LONG = 100
"""Robots with more bodies are only in the full form: their truth takes a minute each."""


def cells(*, full: bool) -> list[Recipe]:
    """Return the cells, the usual robot first and long ones last, each once."""
    alone = [of_value(name, x) for name, values in DIMENSIONS.items() for x in values]
    pairs = [recipe for first, second in combinations(ENDS, 2) for recipe in of_pair(first, second, full=full)]
    every = sorted(dict.fromkeys([Recipe(), *alone, *pairs]), key=lambda recipe: recipe.bodies > LONG)
    return [recipe for recipe in every if full or recipe.bodies <= LONG]


def of_value(name: str, x: float) -> Recipe:
    """Return the robot with one thing at a value."""
    return _at({name: x})


def of_pair(first: str, second: str, *, full: bool) -> list[Recipe]:
    """Return the robots with two things at their ends: all of them, or the first of each."""
    if {first, second} == {"bodies", "leaves"}:  # both set the number of bodies
        return []
    ends = [ENDS[name][: None if full else 1] for name in (first, second)]
    return [_at({first: x, second: y}) for x, y in product(*ends)]


def _at(values: dict[str, float]) -> Recipe:
    """Return the recipe with these values; of leaves the value is the number of bodies."""
    if "leaves" in values:
        values = values | {"leaves": True, "bodies": values["leaves"]}
    return Recipe(**values)  # type: ignore[arg-type]

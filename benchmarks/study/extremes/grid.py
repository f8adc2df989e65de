"""The cells: each dimension on its way to its limits, and every two of them at their ends."""

from itertools import combinations, product

import numpy as np

from .robots import Recipe

PI = float(np.pi)
DECADES = (1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9)
VANISHING = (1e-3, 1e-6, 1e-9, 1e-12, 0.0)

_ROWS: tuple[tuple[str, str, tuple[float, ...], tuple[float, ...]], ...] = (
    ("mass_ratio", "mass ratio tip : base", DECADES, (1e9, 1e-9)),
    ("bodies", "bodies in a chain", (1, 2, 3, 10, 30, 100, 300), (20,)),
    ("leaves", "bodies, all at the base", (2, 10, 100), (7,)),
    ("distance", "base from the origin [m]", (0.0, 1e3, 1e6, 1e9), (1e9,)),
    ("speed", "speed [rad/s, m/s]", (1e-12, 1e-6, 1e-3, 1e3, 1e8), (1e8, 1e-12)),
    ("base_speed", "speed of the base alone [m/s]", (0.0, 1e2, 1e4, 1e6, 1e8), (1e6,)),
    ("length", "metres per unit", DECADES, (1e-9, 1e9)),
    ("mass", "kilograms per unit", DECADES, (1e9, 1e-9)),
    ("time", "seconds per unit", DECADES, (1e-9, 1e9)),
    ("light", "mass factor, link in the middle", VANISHING, (1e-9,)),
    ("tip", "mass factor, last link", VANISHING, (1e-9,)),
    ("rotor", "rotor : rod inertia", (1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9), (1e9, 1e-6)),
    ("angle", "joint angles [rad]", (0.0, 1e-9, PI, -PI, 1e8), (1e8, 0.0)),
    ("parallel", "angle between axes that meet [rad]", (1e-1, 1e-3, 1e-6, 1e-9, 0.0), (1e-6,)),
    ("norm", "quaternion norm, normalised", (1e-150, 1e-9, 1e9, 1e150), ()),
    ("off", "quaternion off norm 1", (1e-16, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1), (1e-9,)),
    ("edge", "short of the triangle inequality", (1e-3, 1e-6, 1e-9, 1e-12, 0.0, -1e-3), (0.0,)),
)
WORDS = {name: words for name, words, _, _ in _ROWS}
DIMENSIONS = {name: values for name, _, values, _ in _ROWS}  # besides the usual one; of `leaves` the number of bodies
ENDS = {name: ends for name, _, _, ends in _ROWS if ends}  # that pairs are made of; the short form takes the first

LONG = 100  # robots with more bodies are only in the full form: their truth takes a minute each


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
    return Recipe(**values | ({"leaves": True, "bodies": values["leaves"]} if "leaves" in values else {}))

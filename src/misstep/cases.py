"""The cases that an answer is tried on: those that are drawn, those at the limits of a formula, and special ones."""

from __future__ import annotations

import zlib
from itertools import combinations
from typing import Any

import numpy as np

from .calls import value_of_reference
from .compare import values
from .course import Course
from .domains import Domain
from .errors import CourseError
from .exercise import Part
from .search import Arguments

__all__ = ["case", "cases", "every_case", "further_cases", "special_cases"]


ANGLES_RAD = (0, np.pi, 8e-2, 1e-3, 1e-6, np.pi - 1e-2, np.pi - 1e-6)
"""Turns at which a formula may have a case of its own, and turns just beside them."""

INVISIBLE_ANGLE_RAD = 2e-8  # a turn of which the cosine is 1
SCALES = (0.0, 1e-6, 1e-3, 3.0, 300.0)  # factors of sizes: nothing at all, small numbers, and large ones
MAX_SCALE_OF_MODEL = 3.0  # a robot that races would cost digits
TINY_SCALES = (4e-9, 2e-11)
"""Factors that leave nothing which `np.allclose` would see beside zero, and more than rounding."""

MAX_WHOLE, MAX_WHOLE_OF_MODEL = 99, 5
"""The largest of whole numbers."""


def cases(part: Part, seed: int) -> list[Arguments]:
    """Return the cases of a function for a seed: the arguments of each."""
    return list(part.cases(_generator(part, seed)))


def further_cases(course: Course, part: Part, seed: int) -> list[Arguments]:
    """Return the cases after those that are drawn first: at and near a limit, and a second draw.

    Where an angle is zero or π, a formula may divide by zero; a function may have a branch for what is small, and begin
    it too early; and what it keeps from one call to the next shows when the same sizes come again.
    """
    drawn = cases(part, seed)[0]
    if not drawn:
        return []
    largest = MAX_SCALE_OF_MODEL if course.model in part.names else SCALES[-1]
    turns = [_each(course, part, drawn, "turned", _quaternion(angle)) for angle in ANGLES_RAD]
    sizes = [_each(course, part, drawn, "scaled", factor) for factor in SCALES if factor <= largest]
    sizes = [new for new in sizes if _answered(part, new)]
    return [*(new for new in (*turns, *sizes) if _differ(new, drawn)), *part.cases(_generator(part, seed, 1))]


def special_cases(course: Course, part: Part, seed: int) -> list[Arguments]:
    """Return the cases after those, for an answer that is right in all of them.

    One argument is zero and the others are not, or one rotation turns nothing; all sizes are tiny; what may be a
    whole number is one, in some arguments or all: an array made after its pattern has no digits after the point; and
    what the course has on top.
    """
    drawn = cases(part, seed)[0]
    if not drawn:
        return []
    found = [_each(course, part, drawn, "scaled", factor) for factor in TINY_SCALES]
    found.append(_each(course, part, drawn, "turned", _quaternion(INVISIBLE_ANGLE_RAD)))
    for k, (domain, x) in enumerate(zip(_domains(course, part), drawn)):
        found += [(*drawn[:k], other, *drawn[k + 1 :]) for other in domain.simple(x)]
    largest = MAX_WHOLE_OF_MODEL if course.model in part.names else MAX_WHOLE
    whole = _each(course, part, drawn, "whole", largest)
    others = [k for k, (a, b) in enumerate(zip(whole, drawn)) if a is not b]
    for n in sorted({1, 2, len(others) - 1, len(others)} - {0, -1}):  # one or two of them, all but one, and all
        found += [tuple(whole[k] if k in some else x for k, x in enumerate(drawn)) for some in combinations(others, n)]
    found += course.special_cases(part, drawn, _generator(part, seed, 3))
    edges = part.edges(_generator(part, seed, 2))
    return [*edges, *(new for new in found if _differ(new, drawn) and _answered(part, new))]


def every_case(course: Course, part: Part, seed: int) -> list[Arguments]:
    """Return all cases of a function, in the order in which they are tried."""
    return [*cases(part, seed), *further_cases(course, part, seed), *special_cases(course, part, seed)]


def case(course: Course, name: str, number: int = 0, *, seed: int = 0) -> Arguments:
    """Return the arguments of one of the cases that an answer is tried on."""
    part = course.find_part(name)[1]
    if seed < 0:
        raise CourseError(f"seed: expected a whole number, 0 or more, got {seed}")
    found = every_case(course, part, seed)
    if not 0 <= number < len(found):
        raise CourseError(f"number: {name} has the cases 0 to {len(found) - 1}, got {number}")
    return found[number]


def _domains(course: Course, part: Part) -> list[Domain]:
    return [course.domains.get(name, Domain()) for name in part.names]


def _each(course: Course, part: Part, drawn: Arguments, how: str, by: Any) -> Arguments:
    return tuple(getattr(domain, how)(x, by) for domain, x in zip(_domains(course, part), drawn))


def _differ(new: Arguments, drawn: Arguments) -> bool:
    return any(a is not b for a, b in zip(new, drawn)) or len(new) != len(drawn)


def _quaternion(angle: float) -> Any:
    """Return the quaternion (x, y, z, w) of a turn about an axis between those of the frame; exact for 0 and π."""
    axis, exact = np.array([1.0, 2.0, 2.0]) / 3, {0: (0.0, 1.0), np.pi: (1.0, 0.0)}
    s, c = exact.get(angle, (np.sin(angle / 2), np.cos(angle / 2)))
    return np.array([*s * axis, c])


def _answered(part: Part, arguments: Arguments) -> bool:
    """Whether the reference has an answer there: it may divide by what is zero."""
    try:
        found = values(value_of_reference(part, arguments), part.returns)
    except (ArithmeticError, LookupError, ValueError):
        return False
    return found is not None and all(x.array is None or np.isfinite(x.array).all() for x in found)


def _generator(part: Part, *seeds: int) -> np.random.Generator:
    return np.random.default_rng([*seeds, zlib.crc32(part.name.encode())])

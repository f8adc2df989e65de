"""The cases that an answer is tried on: those that are drawn first, and further ones."""

from __future__ import annotations

import copy
import zlib
from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np

from ..errors import ModelError
from ..model import Model
from . import catalogue
from .compare import values
from .exercise import Part
from .robots import ball_robots, bare_robot, massless_link

__all__ = ["case", "cases", "every_case", "further_cases", "special_cases", "special_name"]

ANGLES = (0, np.pi, 8e-2, 1e-3, 1e-6, np.pi - 1e-2, np.pi - 1e-6)
"""Turns at which a formula may have a case of its own, and turns just beside them."""

SMALL = 2e-8
"""A turn of which the cosine is 1."""

SCALES = (0.0, 1e-6, 1e-3, 3.0)
"""Factors of vectors: nothing at all, small numbers, and large ones. A robot that races would cost digits."""

TINY = (4e-9, 2e-11)
"""Factors that leave nothing which `np.allclose` would see beside zero, and more than rounding."""

MOON = np.array([0, 0, -1.62])
"""Gravity that is not the earth's, in m/s²."""

CROSS_Z = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 0]])
"""The cross product with an axis z."""

MATRICES: dict[tuple[str, Any], Any] = {
    ("R", (3, 3)): np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]),
    ("I", (3, 3)): np.diag([2, 3, 4]),
    ("I", (6, 6)): np.block([[np.diag([4, 5, 4]), 2 * CROSS_Z], [-2 * CROSS_Z, 2 * np.eye(3, dtype=int)]]),
}
"""A rotation, and the inertia of a body of 2 kg, in whole numbers, by the first letter of the name and the shape."""

WHOLE = frozenset(("J", "J_c", "A_G", "M"))
"""Other arguments that may be in whole numbers; a mass matrix remains positive definite."""

VELOCITIES = frozenset(("M", "J", "J_c", "A_G", "v", "g"))
"""Arguments that may have a row or a column for each velocity of a robot."""

SCALED = frozenset(
    (
        *("v", "a", "h", "g", "w", "p", "c", "r", "x", "tau", "force", "forces", "f_c", "weight", "points"),
        *("omega", "alpha", "a_c", "omega_z", "v_x", "p_AB", "p_BC", "xyz", "rpy", "seconds"),
        *("F", "G", "V", "W", "V_joint", "qd", "qdd", "qdd_joints", "h_G", "k_rate"),
    )
)
"""Arguments that may have any size."""


def cases(part: Part, seed: int) -> list[tuple[Any, ...]]:
    """Return the cases of a function for a seed: the arguments of each."""
    return list(part.cases(_generator(part, seed)))


def further_cases(part: Part, seed: int) -> list[tuple[Any, ...]]:
    """Return the cases after those that are drawn first: at and near a limit, and a second draw.

    Where an angle is zero or π, a formula may divide by zero; a function may have a branch for what is small, and begin
    it too early; and what it keeps from one call to the next shows when the same sizes come again.
    """
    drawn = cases(part, seed)
    if not drawn[0]:
        return []
    names = part.arguments.split(", ")
    turns = [tuple(_turned(*x, _quaternion(angle)) for x in zip(names, drawn[0])) for angle in ANGLES]
    factors = SCALES if "model" in names else (*SCALES, 300.0)
    sizes = [tuple(_scaled(*x, factor) for x in zip(names, drawn[0])) for factor in factors]
    return [
        *(new for new in turns if any(a is not b for a, b in zip(new, drawn[0]))),
        *(new for new in sizes if any(a is not b for a, b in zip(new, drawn[0])) and _answered(part, new)),
        *part.cases(_generator(part, seed, 1)),
    ]


def special_cases(part: Part, seed: int) -> list[tuple[Any, ...]]:
    """Return the cases after those, for an answer that is right in all of them.

    One argument is zero and the others are not, or one rotation turns nothing; all sizes are tiny; what may be a
    whole number is one, in some arguments or all: an array made after its pattern has no digits after the point; and
    the robot is on the moon.
    """
    drawn = cases(part, seed)[0]
    names = part.arguments.split(", ")
    if not drawn:
        return []
    edges = part.edges(_generator(part, seed, 2))
    found = [tuple(_scaled(*x, factor) for x in zip(names, drawn)) for factor in TINY]
    found.append(tuple(_turned(*x, _quaternion(SMALL)) for x in zip(names, drawn)))
    for k, (name, x) in enumerate(zip(names, drawn)):
        alone = [*_thinned(name, x), *([0 * x] if name == "I" and getattr(x, "shape", 0) == (6, 6) else [])]
        if name not in ("m", "q", "T") and len(names) > 1:
            alone += [_scaled(name, x, 0.0), _turned(name, x, _quaternion(0))]
        found += [(*drawn[:k], other, *drawn[k + 1 :]) for other in alone if other is not x]
    found += _in_whole_numbers(names, drawn)
    found.append(_of_the_base(names, drawn))
    if names[:2] == ["model", "q"] and isinstance(drawn[0], Model):
        model, _, *rest = drawn
        robots = (bare_robot(), *ball_robots(), massless_link()) if {*names[2:]} <= {"v", "a", "tau"} else ()
        found += [_moving(robot, names, _generator(part, seed, 3)) for robot in robots]
        found += [(model, model.neutral().astype(int), *rest), (replace(model, gravity=MOON), *drawn[1:])]
    return [*edges, *(new for new in found if any(a is not b for a, b in zip(new, drawn)) and _answered(part, new))]


def _thinned(name: str, value: Any) -> Iterator[Any]:
    """Yield a vector, an array of them or a list with zeros in every other place, and one of six with half zero."""
    if name in SCALED and isinstance(value, np.ndarray) and value.ndim and value.dtype.kind == "f":
        for part in (slice(1, None, 2), *((slice(0, 3), slice(3, 6)) if value.shape == (6,) else ())):
            new = value.copy()
            new[part] = 0
            yield new
    elif name in SCALED and isinstance(value, list) and len(value) > 2:
        yield [0 * x if k % 2 else x for k, x in enumerate(value)]


def _of_the_base(names: list[str], drawn: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return matrices and vectors of a robot as they are of one without joints; others, and all of Go2's, as is."""
    nv = max((n for x in drawn for n in getattr(x, "shape", ())), default=0)
    if nv <= 6 or {"model", "h"} & {*names}:
        return drawn
    return tuple(
        x[tuple(slice(6 if n == nv else n) for n in x.shape)] if name in VELOCITIES and x.ndim < 3 else x
        for name, x in zip(names, drawn)
    )


def _moving(model: Model, names: list[str], rng: np.random.Generator) -> tuple[Any, ...]:
    """Return a robot with a configuration, and as many numbers as it has velocities for each other name."""
    return model, model.random_configuration(rng=rng), *rng.standard_normal((len(names) - 2, model.nv))


def every_case(part: Part, seed: int) -> list[tuple[Any, ...]]:
    """Return all cases of a function, in the order in which they are tried."""
    return [*cases(part, seed), *further_cases(part, seed), *special_cases(part, seed)]


def special_name(part: Part, k: int) -> str:
    """Return the k-th special case for the seed 0 as `twistwrench exercises case` takes it."""
    return f"{part.name} {len(cases(part, 0)) + len(further_cases(part, 0)) + k}"


def _in_whole_numbers(names: list[str], drawn: tuple[Any, ...]) -> Iterator[tuple[Any, ...]]:
    """Yield the arguments with all that may be in whole numbers, with one or two of them, and with all but one."""
    whole = [_whole(*x, 5 if "model" in names else 99) for x in zip(names, drawn)]
    others = [k for k, (a, b) in enumerate(zip(whole, drawn)) if a is not b]
    for n in sorted({1, 2, len(others) - 1, len(others)} - {0, -1}):
        for chosen in combinations(others, n):
            yield tuple(whole[k] if k in chosen else x for k, x in enumerate(drawn))


def _whole(name: str, value: Any, largest: int) -> Any:
    """Return an argument that may have any size, a mass, or a matrix, in whole numbers; each entry of a list."""
    if isinstance(value, list):
        new = [_whole(name, x, largest) for x in value]
        return new if any(a is not b for a, b in zip(new, value)) else value
    found = MATRICES.get((name[:1], getattr(value, "shape", ())))
    if found is not None:
        return found
    if isinstance(value, float) and name in SCALED | {"m"}:
        return round(value) or 1
    if not isinstance(value, np.ndarray) or value.dtype.kind != "f" or not value.any():
        return value
    if name == "S" and (value == np.rint(value)).all():
        return value.astype(int)
    if name not in SCALED | WHOLE:
        return value
    numbers = np.rint(largest * value / np.abs(value).max()).astype(int)
    return numbers + len(numbers) * np.eye(len(numbers), dtype=int) if name == "M" else numbers


def _quaternion(angle: float) -> Any:
    """Return the quaternion (x, y, z, w) of a turn about an axis between those of the frame; exact for 0 and π."""
    axis, exact = np.array([1.0, 2.0, 2.0]) / 3, {0: (0.0, 1.0), np.pi: (1.0, 0.0)}
    s, c = exact.get(angle, (np.sin(angle / 2), np.cos(angle / 2)))
    return np.array([*s * axis, c])


def _scaled(name: str, value: Any, factor: float) -> Any:
    """Return an argument that may have any size times a factor, of a placement its position; others as is."""
    new = copy.copy(value)
    if name == "q" and _floats(value):
        new[:3] *= factor
        return new
    if name == "T":
        new[..., :3, 3] *= factor
        return new
    if name == "m":
        return value * (factor or 1)
    if name not in SCALED:
        return value
    return [factor * x for x in value] if isinstance(value, list) else factor * value


def _answered(part: Part, arguments: tuple[Any, ...]) -> bool:
    """Whether the reference has an answer there: it may divide by what is zero."""
    try:
        with np.errstate(all="ignore"):
            found = values(part.value(part.solution, arguments), part.returns)
    except (ArithmeticError, LookupError, ValueError):
        return False
    return found is not None and all(x.array is None or np.isfinite(x.array).all() for x in found)


def _generator(part: Part, *seeds: int) -> np.random.Generator:
    return np.random.default_rng([*seeds, zlib.crc32(part.name.encode())])


def _turned(name: str, value: Any, turn: Any) -> Any:
    """Return an argument with another orientation: a configuration q, a rotation R..., a placement T; others as is."""
    if not isinstance(value, np.ndarray):
        return value
    (x, y, z), w = turn[:3], turn[3]
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    R = np.eye(3) + 2 * w * cross + 2 * cross @ cross
    new = value.copy()
    if name == "q" and _floats(value):
        new[3:7] = turn
    elif name.startswith("R") and value.shape == (3, 3):
        new[:] = R
    elif name == "T" and value.shape[-2:] == (4, 4):
        new[(...,) if value.ndim == 2 else slice(1, None)][..., :3, :3] = R  # entry 0 of several is the world's
    else:
        return value
    return new


def _floats(q: Any) -> bool:
    """Whether a configuration begins as that of a floating base does."""
    return q.size >= 7 and bool(np.isclose(np.linalg.norm(q[3:7]), 1))


def case(name: str, number: int = 0, *, seed: int = 0) -> tuple[Any, ...]:
    """Return the arguments of one of the cases that an answer is tried on.

    Parameters
    ----------
    name : str
        Of the function, as in the skeletons.
    number : int
        Which case, counted from 0.
    seed : int
        Of the random numbers; the message about a wrong answer names it.

    Returns
    -------
    tuple
        The arguments.

    Raises
    ------
    NameNotFound
        If no exercise has a function of that name.
    ModelError
        If there are fewer cases, or the seed is negative.

    Examples
    --------
    >>> R, p, x = case("act", 3)
    >>> (R @ x + p).shape
    (3,)
    """
    part = catalogue.find_part(name)[1]
    if seed < 0:
        raise ModelError(f"seed: expected a whole number, 0 or more, got {seed}")
    found = every_case(part, seed)
    if not 0 <= number < len(found):
        raise ModelError(f"number: {name} has the cases 0 to {len(found) - 1}, got {number}")
    return found[number]

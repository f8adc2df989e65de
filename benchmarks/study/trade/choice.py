"""The ways that are worth taking, and the choice in words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from twistwrench.timing import duration

from .measure import Point

__all__ = ["TARGETS", "advice", "best", "front"]

TARGETS = (1e-6, 1e-12, 1e-16)
"""Errors that a user may want to stay below."""


def front(points: Iterable[Point]) -> list[Point]:
    """Return the Pareto front: the points to which no other is both as fast and as exact, the fastest first.

    Examples
    --------
    >>> def at(seconds, error):
    ...     return Point("ID", "a way", "float64", 1, error, seconds, seconds, seconds, 1, True)
    >>> [p.seconds for p in front([at(1, 1e-6), at(2, 1e-12), at(3, 1e-9)])]
    [1, 2]
    """
    kept: list[Point] = []
    for point in sorted(points, key=lambda p: (p.seconds, p.error)):
        if not kept or point.error < kept[-1].error:
            kept.append(point)
    return kept


def best(points: Iterable[Point], target: float) -> Point | None:
    """Return the fastest of those whose error is not above the target; None if there is no such point."""
    return min((p for p in points if p.error <= target), key=lambda p: p.seconds, default=None)


def advice(name: str, points: Sequence[Point]) -> list[str]:
    """Return in words what to use for which error: for one state at a time, and for many.

    Parameters
    ----------
    name : str
        Of the quantity.
    points : sequence of Point
        Its points. A way for one state is also one for many.
    """
    many = max(p.states for p in points)
    lines = [f"{name}:"]
    for title, some in (("one state", [p for p in points if p.states == 1]), (f"{many} states", points)):
        said: dict[str, list[str]] = {}
        for target in TARGETS:
            said.setdefault(_answer(target, some), []).append(f"{target:.0e}".replace("e-0", "e-"))
        lines.append(f"  {title}: " + "; ".join(f"for {_listed(t)} {use}" for use, t in said.items()) + ".")
    return lines


def _listed(words: list[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]] if words[1:] else words)


def _answer(target: float, points: Sequence[Point]) -> str:
    """Return in words what to use for an error; where that is Pinocchio, also what to use without it."""
    found = best(points, target)
    if found is None:
        return "no way is exact enough"
    if not found.way.startswith("pin."):
        return f"use {_named(found)}"
    other = best([p for p in points if not p.way.startswith("pin.")], target)
    return f"use {_named(found)}, without Pinocchio {_named(other) if other else 'no way'}"


def _named(point: Point) -> str:
    return f"{point.way} in {point.number} ({duration(point.seconds)})"

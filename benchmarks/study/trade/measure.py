"""Errors and times of every way of computing a quantity."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from textwrap import shorten

import numpy as np

from twistwrench.arrays import Array
from twistwrench.timing import Lap, round_robin

from .quantity import Quantity, Way

__all__ = ["Effort", "LeftOut", "Point", "Unusable", "measure", "relative_error"]


@dataclass(frozen=True)
class Effort:
    """How much is measured.

    Attributes
    ----------
    states : int
        Number of states at which the error is measured; the worst counts.
    batch : int
        Number of states in a batch.
    rounds : int
        How often each way is timed.
    least : float
        For about how long at a time, s.
    most : float
        A way that has taken so long is timed no more, s.
    """

    states: int = 5
    batch: int = 1000
    rounds: int = 7
    least: float = 0.003
    most: float = 0.5

    def __post_init__(self) -> None:
        for name in ("states", "batch", "rounds"):
            if getattr(self, name) < 1:
                raise ValueError(f"{name}: expected 1 or more, got {getattr(self, name)}")


@dataclass(frozen=True)
class Point:
    """A way in a number type, for one state or many: its time and its error.

    Attributes
    ----------
    quantity : str
        Its key.
    way, number : str
    states : int
        In one call.
    error : float
        Worst relative error over these states, see `relative_error`.
    seconds, q1, q3 : float
        For one state: median and quartiles.
    rounds : int
        How many times were kept.
    quiet : bool
        Whether they are those of undisturbed stretches; without any, the time on the processor counts.
    """

    quantity: str
    way: str
    number: str
    states: int
    error: float
    seconds: float
    q1: float
    q3: float
    rounds: int
    quiet: bool


@dataclass(frozen=True)
class LeftOut:
    """A way that gives no number here, and the reason."""

    quantity: str
    way: str
    number: str
    states: int
    why: str


class Unusable(ValueError):
    """A result that is not a number, or has nothing to be compared with."""


def measure(
    quantity: Quantity, effort: Effort, tick: Callable[[], object] = lambda: None
) -> tuple[list[Point], list[LeftOut]]:
    """Measure every way of computing a quantity, in every number type, one state at a time and many.

    Parameters
    ----------
    quantity : Quantity
    effort : Effort
    tick : callable
        Called once for each way in each type, and once for each round of timing.

    Returns
    -------
    points, left_out : list
    """
    try:
        truths = _truths(quantity, effort.states)
    except ValueError as error:  # SingularError is one
        return [], [LeftOut(quantity.key, "all ways", "all numbers", 0, _short(error))]
    runners: list[tuple[tuple[str, str, int], float, Callable[[], object]]] = []
    left_out = []
    for way, number, states in candidates(quantity):
        label = way.name, number, states
        try:
            runners.append((label, *_check(quantity, way, number, states, truths)))
        except ValueError as error:  # SingularError and LinAlgError are ValueErrors
            left_out.append(LeftOut(quantity.key, *label, _short(error)))
        tick()
    laps = round_robin(
        [call for *_, call in runners], rounds=effort.rounds, least=effort.least, most=effort.most, after_round=tick
    )
    points = [_point(quantity.key, label, error, lap) for (label, error, _), lap in zip(runners, laps, strict=True)]
    return points, left_out


def _truths(quantity: Quantity, states: int) -> list[Array]:
    truths = [quantity.truth(i) for i in range(states)]
    if not all((truth != 0).any() for truth in truths):
        raise Unusable("the right value is zero: no error is relative to it")
    return truths


def _short(error: ValueError) -> str:
    return shorten(str(error), 100, placeholder=" …")


def candidates(quantity: Quantity) -> list[tuple[Way, str, int]]:
    """Return every way with every number type, for one state and for many."""
    return [
        (way, number, states)
        for way in quantity.ways
        for number in way.numbers
        for states in ((1, quantity.batch) if way.batches else (1,))
    ]


def _check(
    quantity: Quantity, way: Way, number: str, states: int, truths: Sequence[Array]
) -> tuple[float, Callable[[], object]]:
    """Return the worst error, and the call that is to be timed."""

    def prepare(where: int | slice) -> Callable[[], object]:
        inputs = way.before(*quantity.inputs(number, where))
        return lambda: way.compute(*inputs)

    if states == 1:
        calls = [prepare(i) for i in range(len(truths))]
        values = [way.after(call()) for call in calls]
        call = calls[0]
    else:
        call = prepare(slice(0, states))
        values = list(way.after(call()))
    # A batch may have fewer states than the error is measured at.
    return max(relative_error(x, truth) for x, truth in zip(values, truths, strict=False)), call


def relative_error(value: Array, truth: Array) -> float:
    """Return the largest difference of an entry, over the largest entry of the truth.

    Parameters
    ----------
    value : ndarray
        Of any number type.
    truth : ndarray of mpmath numbers, of the same shape

    Raises
    ------
    Unusable
        If the value is not a number, or of another shape.

    Examples
    --------
    >>> from twistwrench.newton_euler_3d import as_mpmath
    >>> relative_error(np.array([1.0, 4.0]), as_mpmath([1.5, 4.0]))
    0.125
    """
    if np.shape(value) != truth.shape:
        raise Unusable(f"expected shape {truth.shape}, got {np.shape(value)}")
    size = abs(truth).max()
    if value.dtype == object:
        return float(abs(value - truth).max() / size)
    if not np.isfinite(value).all():
        raise Unusable("gives a NaN or an infinity")
    high = truth.astype(np.float64)  # as two doubles the truth has 32 digits
    low = (truth - high).astype(np.float64)
    return float(np.abs(value.astype(np.longdouble) - high - low).max() / np.longdouble(size))


def _point(key: str, label: tuple[str, str, int], error: float, lap: Lap) -> Point:
    seconds = lap.seconds / label[2]
    q1, median, q3 = (float(x) for x in np.quantile(seconds, [0.25, 0.5, 0.75]))
    return Point(key, *label, error, median, q1, q3, rounds=len(seconds), quiet=bool(lap.kept))

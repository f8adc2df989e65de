"""From quantities to a straight line: the textbook's functions, called with numbers that remember."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from straightline.fingerprints import each_once
from straightline.line import Line
from straightline.number import Number, Tape, numbers, without_garbage

from ..arrays import Array, convert
from ..model import Model
from .quantities import Quantity
from .watch import LARGEST_ANGLE, alarm, state_questions

__all__ = ["ALARM", "record"]

ALARM = "alarm"  # the name of the result that says whether a state is the textbook's: see `watch`


@without_garbage()
def record(
    model: Model,
    quantities: Sequence[Quantity],
    shapes: Mapping[str, tuple[int, ...]],
    given: Mapping[str, Array],
    dtype: np.dtype[Any],
    note: Callable[[], Any] | None = None,
) -> Line:
    """Return the line of several quantities, which share their work.

    A state has arguments of these shapes; the others are given, the same for every state. The number type decides what
    counts as too large or as singular. For `note` see `Tape`.
    """
    tape = Tape(note)
    arguments = {name: numbers(tape, name, *shape) for name, shape in shapes.items()}
    if "f_ext" in arguments:
        world = arguments["f_ext"][0].copy()
        arguments["f_ext"][0] = convert(np.zeros(6), object)
    values = {**arguments, **{name: _constants(tape, name, x) for name, x in given.items()}}
    questions = [*state_questions(model, arguments, dtype)]
    results: dict[str, Array] = {}
    for quantity in quantities:
        result, watched = quantity.compute(*(values[name] for name in quantity.arguments if name in values))
        results[quantity.symbol] = np.asarray(result, object)
        questions += watched
    angles = {node[1] for node in tape.nodes if node[0] in ("sin", "cos")}
    questions += [Number(tape, k) / int(LARGEST_ANGLE) for k in sorted(angles)]
    if "f_ext" in arguments:
        large = 2 ** (min(int(np.finfo(dtype).maxexp), 1024) - 1)
        questions += [x * large / tape.number(Fraction(1, large)) for x in world]  # anything but zero is too much
    return each_once(Line.whole(tape, shapes, {**results, ALARM: np.asarray(alarm(tape, questions), object)}))


def _constants(tape: Tape, name: str, x: Array) -> Array:
    """Return given values as fractions; those of q, whose cosines are not fractions, as numbers unless zero."""
    exact = convert(x, object)
    if name == "q":
        exact[:] = [tape.number(one) if one else one for one in exact]
    return exact

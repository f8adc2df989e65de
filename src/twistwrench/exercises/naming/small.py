"""What is right for small numbers only: a series that is broken off, sin x taken for x, a square left out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..calls import tried
from ..compare import Value, values
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text

__all__ = ["right_when_small"]

SCALES = (2.0**-3, 2.0**-5)
"""By these the arguments become small."""

TRIED = 3
"""Cases in which it must be so."""

NOTHING = 2.0**-30
"""In place of 0, by which some right solutions divide."""

ROUNDING, PART = 1e-12, 0.1
"""Less of a result is rounding; more of its change is not a small part."""

LARGEST = 6
"""Power of an argument that is recognised."""

OFF = 0.15
"""By so much a power may differ from a whole number."""

Case = tuple[Any, ...]


def right_when_small(part: Part, again: Callable[[Case], Any], cases: Sequence[Case]) -> list[Text]:
    """Report of each wrong thing with which small arguments it is right, and to which power of them.

    Parameters
    ----------
    part : Part
    again : callable
        Calls the student's function with other arguments.
    cases : sequence of tuple
        In which it is wrong.
    """
    if part.canonical is not None or not cases:
        return []
    names = [name.partition("=")[0] for name in part.arguments.split(", ")]
    able = [k for k, x in enumerate(cases[0]) if names[k] != "q" and _scales(x)]
    lines = []
    for piece, quantity in enumerate(part.returns):
        for chosen in dict.fromkeys([tuple(able), *((k,) for k in able)]) if able else ():
            powers = {_power(part, again, piece, chosen, case) for case in cases[:TRIED]}
            if len(powers) == 1 and (power := powers.pop()):
                what = ", ".join(names[k] for k in chosen)
                lines.append(
                    say(
                        "when small",
                        name=quantity.title,
                        what=what,
                        power=power,
                        next=power + 1,
                        times=2 ** (power + 1),
                    )
                )
                break
    return lines


def _scales(x: Any) -> bool:
    """Whether an argument is a number or a vector: it may be small."""
    return isinstance(x, float) or (isinstance(x, np.ndarray) and x.ndim == 1 and x.dtype.kind == "f" and bool(x.any()))


def _power(part: Part, again: Callable[[Case], Any], piece: int, chosen: Sequence[int], case: Case) -> int | None:
    """Return up to which power of small arguments a result is right; None where it is not, or where it is right."""
    zero = _piece(part, tried(part, part.solution, _scaled(case, chosen, NOTHING)), piece)
    errors, changes = [], []
    for scale in SCALES:
        small = _scaled(case, chosen, scale)
        got, right = (_piece(part, x, piece) for x in (again(small), tried(part, part.solution, small)))
        if zero is None or got is None or right is None or not got.shape == right.shape == zero.shape:
            return None
        error, change = (float(np.abs(x - right).max(initial=0)) for x in (got, zero))
        if not ROUNDING * float(np.abs(right).max(initial=0)) < error < PART * change:
            return None
        errors.append(error)
        changes.append(change)
    of_error, of_change = (float(np.log2(x / y) / np.log2(SCALES[0] / SCALES[1])) for x, y in (errors, changes))
    power = round(of_error) - 1
    return power if 1 <= power <= LARGEST and abs(of_error - power - 1) < OFF and of_error > of_change + OFF else None


def _scaled(case: Case, chosen: Sequence[int], scale: float) -> Case:
    return tuple(scale * x if k in chosen else x for k, x in enumerate(case))


def _piece(part: Part, answer: Any, piece: int) -> Any:
    found: Sequence[Value] | None = values(answer, part.returns)
    array = found[piece].array if found else None
    return array if array is not None and array.dtype.kind == "f" and np.isfinite(array).all() else None

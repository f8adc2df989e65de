"""Calls of functions that may be wrong: of copies of their arguments, never endless, and what they computed."""

from __future__ import annotations

import copy
import sys
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from .exercise import Part

__all__ = ["CHANGED", "copied", "count", "local_values", "tried"]

Function = Callable[..., Any]

CHANGED = "<changed>"
"""Stands in place of a file in what is compiled here and by `wrong.faulty`."""

MOST_ROUNDS = 1000

_rounds = [0]


def count() -> None:
    """Stop a loop that an edit has made endless."""
    _rounds[0] += 1
    if _rounds[0] > MOST_ROUNDS:
        raise RuntimeError("an endless loop")


def tried(part: Part, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
    """Return what a function that may be faulty gives; None where it raises an error."""
    _rounds[0] = 0
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return part.value(function, copied(arguments))
    except (Exception, SystemExit):  # whatever an edit leads to
        return None


def copied(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the arguments with copies of the arrays and lists."""
    return tuple(copy.deepcopy(x) if isinstance(x, np.ndarray | list) else x for x in arguments)


def local_values(function: Function, within: Function, arguments: tuple[Any, ...]) -> dict[str, Any]:
    """Return the values of the names in a function, or a changed one, when another one that calls it is called."""
    found: dict[str, Any] = {}

    def note(*given: Any) -> None:
        frame, event, _ = given
        code, own = frame.f_code, getattr(within, "__code__", None)
        if event == "return" and own and code.co_name == own.co_name and code.co_filename in (own.co_filename, CHANGED):
            found.update(frame.f_locals)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        function(*arguments)
    except (Exception, SystemExit):  # what it computed until then is known
        pass
    finally:
        sys.setprofile(before)
    return found

"""Compare answers: entry by entry, each return value by itself."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .exercise import Output, Part

__all__ = [
    *("FLOOR", "Array", "Value", "agree", "arrays_of", "close", "copied_results", "differing"),
    *("is_one_array", "plain", "to_do", "unchanged", "unwarned", "values"),
]

Array = NDArray[Any]

FLOOR = 1e-3  # entries below this count as zero: an exact 0 is as good as 1e-17


LARGEST_INTEGER = 2**1023  # whole numbers beyond cannot be converted to a float
DEEPEST = 20  # lists in lists of an answer; a list may also be in itself


class Value(NamedTuple):
    """One thing that a function returned, as an array; None where it cannot be one."""

    output: Output
    array: Array | None
    raw: Any


def plain(answer: Any) -> Any:
    """Return an answer as numbers, strings, arrays, and lists of these: values of which nothing runs code of its own.

    An object may raise any error where it is converted, compared or printed. It is converted here, once; what cannot be
    becomes an empty object of a class of the same name. What is plain already is returned itself.
    """
    return _plain(answer, {}, 0)


def _plain(x: Any, known: dict[int, tuple[Any, Any]], depth: int) -> Any:
    """Convert an object once; `known` has, by its identity, the object itself and what it has become."""
    kind = type(x)
    if kind in (type(None), type(...), bool, float, complex, str) or issubclass(kind, np.number | np.bool_):
        return x
    if (kind is int and abs(x) < LARGEST_INTEGER) or (kind is np.ndarray and x.dtype.kind in "biufc"):
        return x
    if id(x) not in known:
        stand_in = type(kind.__name__, (), {})()
        known[id(x)] = x, stand_in  # what it is inside itself
        try:
            found = None if kind is int else _converted(x, known, depth)
        except Exception:
            found = None
        known[id(x)] = x, stand_in if found is None else found
    return known[id(x)][1]


def _converted(x: Any, known: dict[int, tuple[Any, Any]], depth: int) -> Any:
    kind = type(x)
    if issubclass(kind, str):
        return str.__str__(x)
    if not issubclass(kind, list | tuple | Sequence) or issubclass(kind, bytes) or depth >= DEEPEST:
        return _array(x)
    items = [_plain(item, known, depth + 1) for item in x]
    if kind in (list, tuple) and all(a is b for a, b in zip(items, x)):
        return x
    return tuple(items) if issubclass(kind, tuple) else items


def to_do(answer: Any) -> bool:
    """Whether an answer, or a part of it, still is the ``...`` of the skeleton."""
    if isinstance(answer, tuple | list):
        return any(to_do(x) for x in answer)
    return answer is Ellipsis


def values(answer: Any, returns: Sequence[Output]) -> list[Value] | None:
    """Return what a function returned, piece by piece; None where there are not as many pieces as asked for."""
    if len(returns) == 1:
        answer = [answer]
    elif isinstance(answer, str | dict) or not hasattr(answer, "__len__"):
        return None
    if getattr(answer, "ndim", 1) == 0 or len(answer) != len(returns):
        return None
    return [Value(q, _array(x), x) for q, x in zip(returns, answer)]


def arrays_of(answer: Any, returns: Sequence[Output]) -> Any:
    """Return an answer with arrays in place of the lists of numbers in it, as other functions compute with it."""
    pieces = values(answer, returns)
    if pieces is None:
        return answer
    found = [x.array if isinstance(x.raw, list | tuple) and x.array is not None else x.raw for x in pieces]
    return found[0] if len(found) == 1 else tuple(found)


def _array(x: Any) -> Array | None:
    """Convert to an array of numbers or of truth values."""
    if x is None or isinstance(x, str):
        return None
    for name in ("matrix", "vector"):  # our SE3 and SpatialInertia, our Twist and Wrench
        held = getattr(x, name, None)
        if held is not None and not isinstance(x, np.ndarray):
            x = held() if callable(held) else held
            break
    try:
        array = np.asarray(x)
    except Exception:  # rows of different lengths, numbers that are too large
        return None
    if array.dtype.kind in "iu":
        array = array.astype(float)
    return array if array.dtype.kind in "bfc" else None


def close(a: Value, b: Value, rtol: float) -> bool:
    """Whether two values are the same, to a part of the largest entry of the second."""
    if a.array is None or b.array is None:
        return isinstance(a.raw, str) and isinstance(b.raw, str) and a.raw.strip() == b.raw.strip()
    same_kind = (a.array.dtype.kind == "b") == (b.array.dtype.kind == "b")
    return same_kind and a.array.shape == b.array.shape and not differing(a.array, b.array, rtol).any()


def differing(a: Array, b: Array, rtol: float) -> Array:
    """Return which entries of an array differ from those of another of its shape, by a part of its largest entry."""
    if a.dtype.kind == "b" or b.dtype.kind == "b":
        return np.asarray(a != b)
    within = rtol * np.abs(b[np.isfinite(b)]).max(initial=FLOOR)
    with np.errstate(invalid="ignore"):
        return np.asarray(~((np.abs(a - b) <= within) | (a == b) | (np.isnan(a) & np.isnan(b))))


def agree(part: Part, first: Any, second: Any, arguments: tuple[Any, ...]) -> bool:
    """Whether two answers to the same arguments are the same answer."""
    if part.canonical is not None:
        canonical: Callable[..., Any] = part.canonical
        try:
            with unwarned():
                first, second = canonical(first, *arguments), canonical(second, *arguments)
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
            return False
        returns: Sequence[Output] = [Output("")] * (len(second) if isinstance(second, tuple) else 1)
    else:
        returns = part.returns
    a, b = values(first, returns), values(second, returns)
    return a is not None and b is not None and all(close(x, y, part.rtol) for x, y in zip(a, b))


@contextmanager
def unwarned() -> Iterator[None]:
    """Drop the warnings of Python and NumPy in a block; those of a student's own code stay outside of it."""
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        yield


def is_one_array(answer: Any) -> bool:
    """Whether one array is returned as two of several things."""
    arrays = [id(x) for x in answer if isinstance(x, np.ndarray)] if isinstance(answer, tuple | list) else []
    return len({*arrays}) < len(arrays)


def copied_results(answers: Sequence[Any], right: Sequence[Any], before: Sequence[Any]) -> bool:
    """Whether two things returned are the same to the last bit in all answers, but not in the right ones or before."""
    if not all(isinstance(x, tuple | list) and len(x) == 2 for x in [*answers, *right, *before]):
        return False
    same = [all(np.array_equal(first, second) for first, second in many) for many in (answers, right, before)]
    return same == [True, False, False]


def unchanged(before: Any, after: Any) -> bool:
    """Whether an array, a number, or each of a list of them is unchanged."""
    if isinstance(before, list):
        return len(before) == len(after) and all(map(unchanged, before, map(plain, after)))
    return not isinstance(before, np.ndarray | int | float) or np.array_equal(before, after)

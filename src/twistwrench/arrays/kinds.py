"""Validation of arguments that are not arrays, where they are given and not where they are first used."""

from __future__ import annotations

from collections.abc import Iterable, Set
from typing import Any

import numpy as np

__all__ = ["as_flag", "as_sequence", "check_choice", "check_kind"]


def check_kind(value: object, name: str, kind: type, expected: str) -> None:
    """Raise TypeError for a value of another kind.

    Examples
    --------
    >>> check_kind([1.0], "anchors", dict, "a mapping of frames to placements")
    Traceback (most recent call last):
    TypeError: anchors: expected a mapping of frames to placements, got list [1.0]
    """
    if not isinstance(value, kind):
        got = f"the class {value.__name__}" if isinstance(value, type) else f"{type(value).__name__} {value!r}"
        raise TypeError(f"{name}: expected {expected}, got {got}")


def check_choice(value: object, name: str, choices: tuple[str, ...], error: type[ValueError] = ValueError) -> None:
    """Raise ValueError unless the value is one of a few words.

    Examples
    --------
    >>> check_choice(np.zeros(3), "base", ("fixed", "floating"))
    Traceback (most recent call last):
    ValueError: base: expected 'fixed' or 'floating', got array([0., 0., 0.])
    """
    if not isinstance(value, str) or value not in choices:
        raise error(f"{name}: expected {' or '.join(map(repr, choices))}, got {value!r}")


def as_flag(value: object, name: str) -> bool:
    """Return a bool; 0 and 1 count.

    Examples
    --------
    >>> as_flag("no", "physical")
    Traceback (most recent call last):
    TypeError: physical: expected True or False, got str 'no'
    """
    one = value.item() if isinstance(value, np.bool | np.integer) else value
    if not isinstance(one, int) or one not in (0, 1):
        raise TypeError(f"{name}: expected True or False, got {type(value).__name__} {value!r}")
    return bool(one)


def as_sequence(
    value: Iterable[Any], name: str, expected: str, *, letters: bool = True, ordered: bool = False
) -> tuple[Any, ...]:
    """Return several values as a tuple; reject a single one, and a string unless single letters will do.

    Where their order counts (`ordered`), reject a set as well: it has no order.

    Examples
    --------
    >>> as_sequence(None, "joints", "joint names")
    Traceback (most recent call last):
    TypeError: joints: expected a sequence of joint names, got None
    """
    if isinstance(value, str) and not letters:
        raise ValueError(f"{name}: expected a sequence of {expected}, got the string {value!r}")
    if ordered and isinstance(value, Set):
        kind = type(value).__name__
        raise TypeError(f"{name}: expected a sequence of {expected}, got a {kind}, which has no order; a list has one")
    try:
        return tuple(value)
    except TypeError:
        got = "None" if value is None else f"{type(value).__name__} {value!r}"
        raise TypeError(f"{name}: expected a sequence of {expected}, got {got}") from None

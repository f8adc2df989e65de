"""Verdicts as JSON, and back: what comes back is made of these few classes, and of nothing else."""

from __future__ import annotations

from dataclasses import fields
from json import dumps, loads  # by themselves: a student's file may change the module
from typing import Any

import numpy as np

from ..exercise import Quantity
from ..failing import Block, Case, Compared
from ..folder.workbook import Unread
from ..judge import Verdict
from ..text import Text

__all__ = ["as_json", "from_json"]

CONTROLS = {k: f"\\x{k:02x}" for k in (*range(32), 127) if chr(k) not in "\t\n"}
"""Characters that a terminal or a table obeys. Others that no file can hold are written in the same way."""

CLASSES = {kind.__name__: kind for kind in (Verdict, Unread, Case, Compared, Block)}


def as_json(value: Any) -> str:
    """Return a value as a line of JSON.

    Raises
    ------
    TypeError
        If it holds something else than numbers, texts, arrays and verdicts.

    Examples
    --------
    >>> as_json(Text("right", "正确").en), as_json(np.eye(2, dtype=bool))
    ('"right"', '{"array": [[2, 2], "b", [1, 0, 0, 1]]}')
    """
    return dumps(_plain(value))


def _plain(x: Any) -> Any:
    if x is None or isinstance(x, bool | int | float):
        return x
    if isinstance(x, str):
        return x.translate(CONTROLS).encode("utf-8", "backslashreplace").decode()
    if isinstance(x, Text):
        return {"Text": [_plain(x.en), _plain(x.zh)]}
    if isinstance(x, Quantity):
        return {"Quantity": [x.name, x.unit]}
    if isinstance(x, list | tuple):
        return [_plain(item) for item in x]
    if isinstance(x, np.ndarray | np.number | np.bool_):
        return {"array": _numbers(np.asarray(x))}
    if type(x).__name__ in CLASSES:
        return {type(x).__name__: [_plain(getattr(x, field.name)) for field in fields(x)]}
    raise TypeError(f"expected numbers, texts, arrays or a verdict, got {type(x).__name__}")


def _numbers(x: np.ndarray[Any, Any]) -> list[Any]:
    """Return the shape of an array, its kind, and its numbers, of a complex one real and imaginary parts."""
    kind = "f" if x.dtype.kind in "iuf" else x.dtype.kind
    flat = np.ravel(x)
    pairs = flat.astype(complex).view(float) if kind == "c" else flat.astype(int if kind == "b" else float)
    return [list(x.shape), kind, pairs.tolist()]


def from_json(text: str | bytes) -> Any:
    """Return the value that a line of JSON stands for; lists become tuples.

    Raises
    ------
    ValueError
        If it does not stand for one.

    Examples
    --------
    >>> from_json(as_json(Verdict("wrong", (Text("no", "否"),)))).message("en")
    'no'
    """
    try:
        return _value(loads(text))
    except (KeyError, TypeError, ValueError, RecursionError) as error:
        raise ValueError(f"expected a message, got {text[:80]!r}: {error}") from None


def _value(x: Any) -> Any:
    if isinstance(x, list):
        return tuple(map(_value, x))
    if not isinstance(x, dict):
        return x
    ((name, held),) = x.items()
    if name == "array":
        shape, kind, numbers = held
        dtype = {"f": float, "b": bool, "c": complex}[kind]
        return (
            np.array(numbers, float).view(complex).reshape(shape)
            if kind == "c"
            else np.array(numbers, dtype).reshape(shape)
        )
    if name == "Text":
        return Text(*map(str, held))
    if name == "Quantity":
        return Quantity(str(held[0]), unit=str(held[1]))
    return CLASSES[name](*map(_value, held))

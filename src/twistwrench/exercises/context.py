"""In how many cases an answer is wrong, and the arguments of the first on one line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .exercise import Part
from .words.phrases import say
from .words.text import Language, Text

__all__ = ["context_of"]

ROOM = 96
"""Columns for the arguments of a case."""


def context_of(part: Part, tried: Sequence[tuple[Any, ...]], right: list[bool]) -> list[Text]:
    """Report in how many cases the answer is wrong, and show the first."""
    arguments = tried[right.index(False)]
    if not arguments:
        return []
    wrong = right.count(False)
    names = [name.partition("=")[0] for name in part.arguments.split(", ")]
    first = say("all wrong", all=len(tried)) if wrong == len(tried) else say("cases", wrong=wrong, all=len(tried))
    return [first, Text(_shown(names, arguments, "en"), _shown(names, arguments, "zh"))]


def _shown(names: Sequence[str], arguments: tuple[Any, ...], language: Language) -> str:
    """Write the arguments of a case on one line."""
    line = "    " + ", ".join(f"{name} = {_short(x, language)}" for name, x in zip(names, arguments))
    return line if len(line) <= ROOM else line[:ROOM] + " ..."


def _short(x: Any, language: Language) -> str:
    """Write an argument in short."""
    if isinstance(x, np.ndarray):
        if x.ndim > 1 or x.size > 6:
            return f"array {x.shape}"
        return "[" + ", ".join(f"{entry:.3g}" for entry in x) + "]"
    if isinstance(x, list) and any(isinstance(entry, np.ndarray) for entry in x):
        return say("arrays", n=len(x)).of(language)
    if isinstance(x, float):
        return f"{x:.4g}"
    name = getattr(x, "name", x)
    text = " ".join((name.of(language) if isinstance(name, Text) else str(name)).split())
    return text if len(text) <= ROOM or isinstance(x, list) else type(x).__name__

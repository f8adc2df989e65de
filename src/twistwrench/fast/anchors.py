"""The chapter's steps in the text of a program: what the operations of a line are called.

A value has the name of the step that it belongs to, and the body's number: ``V7_2`` is the second new number in V of
body 7. While the line is recorded, each new operation asks which line of which algorithm is being run: that line's
anchor, ``# 49.6 V: twist``, gives the name.
"""

from __future__ import annotations

import linecache
import re
import sys
from functools import cache
from types import CodeType

from straightline.source import Note

__all__ = ["step"]

ANCHOR = re.compile(r"  # (49\.\d+) (\w+)(:.*)?$")

DEEPEST = 12  # so many calls above an operation the line of the algorithm is looked for


def step() -> Note | None:
    """Return the step that the line of an algorithm, which is running above this call, has as its anchor."""
    frame = sys._getframe(1)
    for _ in range(DEEPEST):
        if (found := _anchor(frame.f_code, frame.f_lineno)) is not None:
            section, symbol, words = found
            body = frame.f_locals.get("i")
            if not isinstance(body, int):
                return Note(symbol, f"{section} {symbol}{words}")
            return Note(f"{symbol}{body}", f"{section} {symbol}{words}, body {body}")
        if frame.f_back is None:
            break
        frame = frame.f_back
    return None


@cache
def _anchor(code: CodeType, line: int) -> tuple[str, str, str] | None:
    match = ANCHOR.search(linecache.getline(code.co_filename, line).rstrip())
    return (match[1], match[2], match[3] or "") if match else None

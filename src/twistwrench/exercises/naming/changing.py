"""The line of a student's function that changes an argument."""

from __future__ import annotations

import linecache
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from ..calls import LONGEST, TooLong, copied, limited, traced
from ..compare import unchanged
from ..exercise import Part
from ..rules import file_or_cell, is_ours
from ..words.phrases import say
from ..words.text import Text

__all__ = ["changing_line"]


def changing_line(part: Part, function: Callable[..., Any], arguments: tuple[Any, ...]) -> list[Text]:
    """Return where an argument is changed first, and what stands there; nothing where that is not seen."""
    given, found = copied(arguments), list[Any]()
    done: Any = None  # the file and the line that run until the next event

    def note(*traced: Any) -> Any:
        nonlocal done
        frame, event, _ = traced
        file = frame.f_code.co_filename
        if found or is_ours(file):
            return None
        if done is not None and not all(map(unchanged, arguments, given)):
            found.append(done)
        back = frame.f_back if event == "return" else frame
        done = None if back is None else (back.f_code.co_filename, back.f_lineno)
        return note

    with suppress(Exception, TooLong), traced(note), limited(LONGEST):  # it ran before, untraced
        part.value(function, given)
    if not found or is_ours(found[0][0]):
        return []
    file, line = found[0]
    text = linecache.getline(file, line).strip()
    return [say("at line", file=file_or_cell(file), line=line), Text(f"    {text}", f"    {text}")] if text else []

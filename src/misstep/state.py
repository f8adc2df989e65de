"""What a function leaves behind: what it keeps from one call to the next, and the line that changes an argument."""

from __future__ import annotations

import inspect
import io
import linecache
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from pathlib import Path
from types import CodeType
from typing import Any

import numpy as np

from .calls import MAX_CPU_S, TooLong, call_or_none, copied, limited
from .compare import agree, unchanged
from .exercise import Part
from .messages import message
from .text import Text

__all__ = ["at_line", "changing_line", "file_or_cell", "kept_in_module"]

MAX_CASES = 3
"""Wrong cases that are tried anew."""

Function = Callable[..., Any]


def kept_in_module(part: Part, function: Function, wrong: Sequence[Sequence[Any]]) -> Text | None:
    """Report that a function keeps something, if a new copy of its module is right in each of the wrong cases.

    Parameters
    ----------
    part : Part
    function : callable
        The student's.
    wrong : sequence
        The arguments of each wrong case, and what is expected.
    """
    names = getattr(function, "__globals__", None) or getattr(getattr(function, "__wrapped__", None), "__globals__", {})
    if not wrong or names.get(part.name) is not function or inspect.isclass(function) or not [*_holders(names)]:
        return None
    source = "".join(linecache.getlines(str(names.get("__file__", ""))))
    changed: set[str] = set()
    for arguments, right in wrong[:MAX_CASES]:
        fresh = _fresh(source, names)
        if part.name not in fresh:
            return None
        before, now = dict(_holders(fresh)), dict(_holders(names))
        changed |= {name for name in now if name in before and before[name] != now[name]}
        if not agree(part, call_or_none(part, fresh[part.name], arguments), right, arguments):
            return None
    return message("kept in", name=changed.pop()) if len(changed) == 1 else message("kept by module")


def _fresh(source: str, names: dict[str, Any]) -> dict[str, Any]:
    """Return the names of a module that is read again; none where that fails."""
    fresh = {name: x for name, x in names.items() if name.startswith("__")}
    try:
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            exec(compile(source, str(names.get("__file__", "")), "exec", dont_inherit=True), fresh)
    except (Exception, SystemExit):  # it was read before: what is missing now is not the student's
        return {}
    return fresh


def _holders(names: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield what may keep something, and what it has: variables of the module, defaults of arguments, caches."""
    own = str(names.get("__file__", ""))
    for name, x in names.items():
        if name.startswith("__"):
            continue
        if isinstance(x, list | dict | set | np.ndarray | int | float | None):
            yield name, repr(x)
        code = getattr(getattr(x, "__wrapped__", x), "__code__", None)
        if not isinstance(code, CodeType) or code.co_filename != own:
            continue
        if hasattr(x, "cache_info"):
            yield f"{name}.cache", repr(x.cache_info().currsize)
        if getattr(x, "__dict__", {}).keys() - {"__wrapped__"}:
            yield name, repr(x.__dict__)
        parameters = inspect.signature(x).parameters.values()
        for other in parameters:
            if isinstance(other.default, list | dict | set | np.ndarray):
                yield other.name, repr(other.default)


def changing_line(
    part: Part, function: Function, arguments: tuple[Any, ...], is_library: Callable[[str], bool]
) -> list[Text]:
    """Return where an argument is changed first, and what stands there; nothing where that is not seen."""
    given, found = copied(arguments), list[Any]()
    done: Any = None  # the file and the line that run until the next event

    def note(*traced: Any) -> Any:
        nonlocal done
        frame, event, _ = traced
        file = frame.f_code.co_filename
        if found or is_library(file):
            return None
        if done is not None and not all(map(unchanged, arguments, given)):
            found.append(done)
        back = frame.f_back if event == "return" else frame
        done = None if back is None else (back.f_code.co_filename, back.f_lineno)
        return note

    with suppress(Exception, TooLong), _traced(note), limited(MAX_CPU_S):  # it ran before, untraced
        part.value(function, given)
    if not found or is_library(found[0][0]):
        return []
    file, line = found[0]
    text = linecache.getline(file, line).strip()
    return [*at_line(file, line), Text(f"    {text}", f"    {text}")] if text else []


@contextmanager
def _traced(note: Callable[..., Any]) -> Iterator[None]:
    """Call a function at each line that runs, as Python traces it."""
    before = sys.gettrace()
    sys.settrace(note)
    try:
        yield
    finally:
        sys.settrace(before)


def at_line(file: str, line: int | str | None) -> list[Text]:
    """Return where something happened in a student's code."""
    return [message("at line", file=file_or_cell(file), line=line)]


def file_or_cell(file: str) -> Text:
    """Return how a message names the place of a student's code: its file, or the cell of a notebook."""
    if "ipykernel" in file or file.startswith("<ipython"):
        return Text("your cell", "你的单元格")
    return Text(*(Path(file).name,) * 2)

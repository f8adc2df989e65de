"""Whether a function is right when it is called for the first time, and wrong after other calls: it keeps something."""

from __future__ import annotations

import inspect
import io
import linecache
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from types import CodeType
from typing import Any

import numpy as np

from ..calls import tried
from ..compare import agree
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text

__all__ = ["kept_in_module"]

MOST = 3
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
    for arguments, right in wrong[:MOST]:
        fresh = _fresh(source, names)
        if part.name not in fresh:
            return None
        before, now = dict(_holders(fresh)), dict(_holders(names))
        changed |= {name for name in now if name in before and before[name] != now[name]}
        if not agree(part, tried(part, fresh[part.name], arguments), right, arguments):
            return None
    return say("kept in", name=changed.pop()) if len(changed) == 1 else say("kept by module")


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

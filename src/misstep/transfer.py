"""A function of a notebook as bytes for another process: its code, and the values of the names that it uses.

What a library defines goes by its name, what the student has defined by its content, with its source.
"""

from __future__ import annotations

import dis
import functools
import io
import linecache
import marshal
import pickle
import re
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from types import CellType, CodeType, FunctionType, ModuleType
from typing import Any

from .rules import cell_content, is_ours
from .workbook import Workbook, offered

__all__ = ["received", "sent"]

Function = Callable[..., Any]

_SPACES: dict[int, dict[str, Any]] = {}
"""The names of the modules of functions that were received: functions of one module share them."""


def sent(function: Function) -> bytes | None:
    """Return a function as bytes; None where it holds something that cannot be sent, as an open file."""
    buffer = io.BytesIO()
    pickler = _Pickler(buffer)
    try:
        pickler.dump(function)
    except Exception:  # whatever the objects that it holds raise
        return None
    return pickle.dumps((buffer.getvalue(), pickler.sources))


def received(data: bytes) -> Function:
    """Return the function that was sent."""
    content, sources = pickle.loads(data)
    for file, lines in sources.items():
        linecache.cache[file] = sum(map(len, lines)), None, lines, file
    function: Function = pickle.loads(content)
    return function


class _Pickler(pickle.Pickler):
    def __init__(self, buffer: io.BytesIO) -> None:
        super().__init__(buffer)
        self.sources: dict[str, list[str]] = {}

    def reducer_override(self, x: Any) -> Any:
        if isinstance(x, FunctionType) and "mine" in vars(x):
            return _mine, (vars(x)["course"], vars(x)["mine"], str(vars(x)["folder"]))
        if isinstance(x, FunctionType) and not is_ours(x.__code__.co_filename):
            return self._function(x)
        if isinstance(x, functools._lru_cache_wrapper) and not is_ours(x.__wrapped__.__code__.co_filename):
            return _cached, (x.__wrapped__, x.cache_parameters())
        if isinstance(x, type) and _is_students(x):
            held = {k: v for k, v in vars(x).items() if k not in ("__dict__", "__weakref__")}
            return type(x), (x.__name__, x.__bases__, {}), held, None, None, _fill_class
        if isinstance(x, staticmethod | classmethod):
            return type(x), (x.__func__,)
        if isinstance(x, property):
            return property, (x.fget, x.fset, x.fdel, x.__doc__)
        if isinstance(x, ModuleType):
            return import_module, (x.__name__,)
        if isinstance(x, CellType):
            return _cell, (), cell_content(x), None, None, _fill_cell
        return NotImplemented

    def _function(self, x: FunctionType) -> Any:
        file, space = x.__code__.co_filename, x.__globals__
        lines = self.sources[file] = linecache.getlines(file)
        words = {*re.findall(r"\w+", "".join(lines))}  # the file is compiled anew, with changes: it needs its modules
        modules = {name for name in words & space.keys() if isinstance(space[name], ModuleType)}
        named = {"__name__", "__file__", x.__name__, *modules, *_globals(x.__code__)}
        names = {name: space[name] for name in sorted(named & space.keys())}
        state = names, x.__defaults__, x.__kwdefaults__, vars(x), x.__qualname__
        made = _function, (marshal.dumps(x.__code__), id(space), x.__name__, x.__closure__)
        return *made, state, None, None, _fill_function


def _is_students(kind: type) -> bool:
    """Whether a class is the student's, by the file of its module."""
    file = getattr(sys.modules.get(kind.__module__), "__file__", None)
    return kind.__module__ == "__main__" or (file is not None and not is_ours(file))


def _globals(code: CodeType) -> Iterator[str]:
    """Yield the names of its module that a code uses, and those that are written in it."""
    for step in dis.get_instructions(code):
        if step.opname in ("LOAD_GLOBAL", "LOAD_NAME"):
            yield step.argval
        elif isinstance(step.argval, CodeType):
            yield from _globals(step.argval)


# ---------------------------------------------------------------- called where it is received


def _mine(course: str, name: str, folder: str) -> Function:
    return offered(name, Workbook(import_module(course).COURSE, folder))


def _cached(function: Function, parameters: dict[str, Any]) -> Any:
    return functools.lru_cache(**parameters)(function)


def _function(code: bytes, space: int, name: str, closure: tuple[CellType, ...] | None) -> FunctionType:
    return FunctionType(marshal.loads(code), _SPACES.setdefault(space, {}), name, None, closure)


def _fill_function(function: FunctionType, state: Any) -> None:
    names, function.__defaults__, function.__kwdefaults__, attributes, function.__qualname__ = state
    function.__globals__.update(names)
    vars(function).update(attributes)


def _fill_class(kind: type, held: dict[str, Any]) -> None:
    for name, value in held.items():
        setattr(kind, name, value)


def _cell() -> CellType:
    return CellType()


def _fill_cell(cell: CellType, content: tuple[Any, ...]) -> None:
    if content:
        (cell.cell_contents,) = content

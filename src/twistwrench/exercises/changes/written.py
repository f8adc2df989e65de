"""The source of a student's function, and of what it uses of the same file."""

from __future__ import annotations

import ast
import inspect
import linecache
from collections.abc import Callable, Iterator
from types import FunctionType
from typing import Any

import twistwrench

__all__ = ["text_written", "written"]

Function = Callable[..., Any]


def text_written(function: Function) -> str:
    """Return the source of a student's function, an empty text where it is unknown."""
    return written(function) or ""


def written(function: Function) -> str | None:
    """Return the source of a student's function or class with the helpers that it calls; None where it is unknown.

    Everything else in the file is blank, so that its lines have the numbers that they have there.
    """
    code = getattr(function, "__code__", None)
    if code is None and inspect.isclass(function):
        code = next((x.__code__ for x in vars(function).values() if isinstance(x, FunctionType)), None)
    if code is None or (not inspect.isclass(function) and code.co_name != function.__name__):
        return None  # it is wrapped
    if getattr(function, "__closure__", None) or twistwrench.__path__[0] in code.co_filename:
        return None  # it cannot be compiled by itself, or is not of a student
    linecache.checkcache(code.co_filename)
    lines = linecache.getlines(code.co_filename)
    try:
        tree = ast.parse("".join(lines))
    except SyntaxError:
        return None
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name == function.__name__:
            first = min([node.lineno, *(x.lineno for x in node.decorator_list)])
            if first <= code.co_firstlineno <= (node.end_lineno or first):
                kept = [node, *_used(node, tree)] if node in tree.body else [node]
                shown = {k for x in kept for k in range(x.lineno, (x.end_lineno or 0) + 1)}
                return "".join(line if k in shown else "\n" for k, line in enumerate(lines, 1))
    return None


def _used(function: Any, tree: ast.Module) -> Iterator[Any]:
    """Yield the functions and the plain values of a file that a function uses, and those that these use."""
    beside = {name: node for node in tree.body for name in _defined(node) if node is not function}
    waiting = [function]
    while waiting:
        names = {x.id for x in ast.walk(waiting.pop()) if isinstance(x, ast.Name)}
        new = [beside.pop(name) for name in sorted(names & beside.keys())]
        waiting += new
        yield from new


def _defined(node: Any) -> list[str]:
    """Return the name that a statement of a file gives to a function, or to a value that is computed in no time."""
    if isinstance(node, ast.FunctionDef):
        return [node.name]
    if not isinstance(node, ast.Assign) or not isinstance(node.targets[0], ast.Name):
        return []
    calls = [x.func for x in ast.walk(node.value) if isinstance(x, ast.Call)]
    plain = isinstance(node.value, ast.Lambda) or all(ast.unparse(x).startswith("np.") for x in calls)
    return [node.targets[0].id] if plain else []

"""The solutions as source: as the student would write them, and with the algorithms that they call."""

from __future__ import annotations

import ast
import inspect
import re
import textwrap
from collections import defaultdict
from collections.abc import Callable, Iterable
from typing import Any, cast

from ..exercise import Exercise, Part
from ..text import Language, columns, wrapped

__all__ = ["docstring", "head", "solution_sources"]

Function = Callable[..., Any]


def solution_sources(exercise: Exercise, language: Language) -> list[str]:
    """Return the solutions of an exercise; before each, what it calls and no earlier one has shown."""
    package = exercise.course.package_name
    written: list[str] = []
    shown: set[Function] = set()
    for part in exercise.parts:
        new = [function for function in part.beside if function not in shown]
        shown.update(new)
        if new:
            written += [text for text in (_imports(new, shown, package), *map(_untyped, new)) if text]
        written.append(_solution(part, language))
    return written


def docstring(part: Part, language: Language) -> str:
    """Write the docstring of a function, on one line where it fits; a line ends where a sentence does, or is filled."""
    sentences = re.split(r"(?<=[.。:：\n])\n|(?<=[.。][)）])\n", inspect.cleandoc(part.doc.of(language)))
    lines = [line for text in sentences for line in wrapped(text, 94) or [""]]
    end = "\n" if len(lines) > 1 or columns(lines[0]) > 88 else ""
    return textwrap.indent('"""' + "\n".join(lines) + end + '"""', "    ") + "\n"


def head(part: Part) -> str:
    """Write the first line of a function or class."""
    if inspect.isclass(part.solution):
        return f"class {part.name}:\n"
    return f"def {part.name}({part.arguments}):\n"


def _solution(part: Part, language: Language) -> str:
    """Return the solution of a part as the student would write it: no types, the skeleton's docstring."""
    node, lines = _parsed(part.solution)
    if isinstance(node, ast.ClassDef):
        return head(part) + docstring(part, language) + textwrap.indent(_methods(node), "    ")
    documented = ast.get_docstring(node) is not None
    start = (node.body[0].end_lineno or 0) if documented else node.body[0].lineno - 1
    return head(part) + docstring(part, language) + "\n".join(lines[start:]).rstrip() + "\n"


def _parsed(function: Function) -> tuple[ast.FunctionDef | ast.ClassDef, list[str]]:
    """Return the definition of a function, and its lines."""
    source = textwrap.dedent(inspect.getsource(function))
    return cast("ast.FunctionDef | ast.ClassDef", ast.parse(source).body[0]), source.split("\n")


def _methods(node: ast.ClassDef) -> str:
    """Return the methods of a class without types."""
    methods = [method for method in node.body if isinstance(method, ast.FunctionDef)]
    for method in methods:
        method.returns = None
        for argument in method.args.args:
            argument.annotation = None
    return "\n" + "\n\n".join(map(ast.unparse, methods)) + "\n"


def _untyped(function: Function) -> str:
    """Return a function of the package without types, its comments kept."""
    node, lines = _parsed(function)
    body = "\n".join(lines[node.body[0].lineno - 1 :]).rstrip()
    body = re.sub(r"^( +\w+): [\w\[\], ]+ = ", r"\1 = ", body, flags=re.MULTILINE)
    return f"def {function.__name__}({', '.join(inspect.signature(function).parameters)}):\n{body}\n"


def _imports(functions: Iterable[Function], shown: set[Function], package: str) -> str:
    """Return the lines that import what functions use of the package, without what is shown itself."""
    needed = defaultdict(set)
    for function in functions:
        node, _ = _parsed(function)
        named = {n.id for line in node.body for n in ast.walk(line) if isinstance(n, ast.Name)}
        for name in named - set(function.__code__.co_varnames):
            used = function.__globals__.get(name)
            known = inspect.isroutine(used) or inspect.isclass(used)
            if known and used.__module__.startswith(package) and used not in shown:
                needed[used.__module__].add(name)
    return "".join(f"from {module} import {', '.join(sorted(names))}\n" for module, names in sorted(needed.items()))

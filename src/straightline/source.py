"""A straight line as text: Python that runs on any numbers, and C.

Where the tape took notes, a value has the name of its note and a number, and where another note begins there is a
comment.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from .line import Line
from .number import Node

__all__ = ["Note", "c_source", "python_source"]

OPERATORS = {"add": "+", "sub": "-", "mul": "*", "div": "/"}
PYTHON_CHOICE, C_CHOICE = "({a} if {x} > 0 else {b})", "({x} > 0 ? {a} : {b})"


class Note(NamedTuple):
    """What a `Tape` may note of an operation: the name that its value has in the text, and a comment."""

    name: str
    comment: str


def python_source(line: Line, name: str, functions: str = "math") -> str:
    """Return a line as a Python function of sequences of numbers, with cos of this module; results are nested lists."""
    names = _names(line, lambda array, index: array + "".join(f"[{k}]" for k in index))
    own = (*OPERATORS, "neg", "abs", "select")
    called = sorted({operation for operation in line.operations if operation not in own})
    text = [f"from {functions} import {', '.join(called)}", "", ""] if called else []
    text.append(f"def {name}({', '.join(line.inputs)}):")
    text += [f"    {one}" for one in _statements(line, names, "#", "{} = {}", PYTHON_CHOICE)]
    nested = [_nested([names[k] for k in entries], shape) for shape, entries in line.outputs.values()]
    return "\n".join([*text, f"    return {', '.join(nested)}", ""])


def c_source(line: Line, name: str) -> str:
    """Return a line as a C99 function: pointers to its arguments, then to its results, row by row."""
    names = _names(line, lambda array, index: f"{array}[{np.ravel_multi_index(index, line.inputs[array])}]")
    results = [array if len(line.outputs) > 1 else "result" for array in line.outputs]
    arguments = [f"const double *{array}" for array in line.inputs] + [f"double *{result}" for result in results]
    text = ["#include <math.h>", "", f"void {name}({', '.join(arguments)})", "{"]
    text += [f"    {one}" for one in _statements(line, names, "//", "const double {} = {};", C_CHOICE)]
    for result, (_, entries) in zip(results, line.outputs.values()):
        text += [f"    {result}[{k}] = {names[node]};" for k, node in enumerate(entries)]
    return "\n".join([*text, "}", ""])


def _names(line: Line, entry: Callable[[str, tuple[int, ...]], str]) -> list[str]:
    """Return what stands for each node in the text: a constant, an entry of an argument, or a name of its own."""
    names, counts = list[str](), Counter[str]()
    for k, (operation, *rest) in enumerate(line.nodes):
        if operation == "const":
            names.append(repr(float(rest[0])))
        elif operation == "input":
            array, *index = rest[0]
            names.append(entry(array, tuple(index)))
        elif k in line.inner:
            names.append("")
        else:
            note = line.notes[k] if line.notes else None
            stem = "t" if note is None else note.name
            counts[stem] += 1
            names.append(f"{stem}_{counts[stem]}")
    return names


def _statements(line: Line, names: list[str], comment: str, assign: str, choice: str) -> Iterator[str]:
    """Yield a line of text for each operation but those within another's, and a comment where another step begins."""
    before, names = None, [*names]
    for k, node in enumerate(line.nodes):
        if node[0] in ("input", "const"):
            continue
        if k in line.inner:
            names[k] = _expression(line, node, names, choice)
            continue
        note = line.notes[k] if line.notes else None
        if note is not None and note != before:
            yield f"{comment} {note.comment}"
        before = note
        yield assign.format(names[k], _expression(line, node, names, choice))


def _expression(line: Line, node: Node, names: list[str], choice: str) -> str:
    """Return an operation as text, its operands in brackets wherever they stand within it and are not calls."""
    operation, *needed = node
    if operation == "select":
        x, a, b = (names[k] for k in needed)
        return choice.format(x=x, a=a, b=b)
    if operation not in (*OPERATORS, "neg"):
        return f"{operation}({', '.join(names[k] for k in needed)})"
    plain = ("mul", "div") if operation in ("add", "sub") else ()
    inner = [k in line.inner and line.nodes[k][0] in {*OPERATORS, "neg"}.difference(plain) for k in needed]
    given = [f"({names[k]})" if bracket else names[k] for k, bracket in zip(needed, inner)]
    return f"-{given[0]}" if operation == "neg" else f" {OPERATORS[operation]} ".join(given)


def _nested(values: list[str], shape: tuple[int, ...]) -> str:
    """Return values as nested lists of a shape."""
    return str(np.reshape(np.array(values, object), shape).tolist()).replace("'", "")

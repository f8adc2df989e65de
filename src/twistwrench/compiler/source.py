"""A straight line as text: Python that runs on any numbers, and C.

A value has the name of the chapter's step that it belongs to, and the body's number: ``V7_2`` is the second new number
in V of body 7. While the line is recorded, each new operation asks which line of which algorithm is being run: that
line's anchor, ``# 49.6 V: twist``, gives the name.
"""

from __future__ import annotations

import linecache
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from functools import cache
from types import CodeType
from typing import NamedTuple

import numpy as np

from .line import Line
from .number import Node

__all__ = ["Step", "c_source", "python_source", "step"]

ANCHOR = re.compile(r"  # (49\.\d+) (\w+)(:.*)?$")

OPERATORS = {"add": "+", "sub": "-", "mul": "*", "div": "/"}

DEEPEST = 12  # so many calls above an operation the line of the algorithm is looked for


class Step(NamedTuple):
    """A step of the chapter, for one body or for none: "49.6", "V" and ": twist"."""

    section: str
    symbol: str
    words: str
    body: int | None


def step() -> Step | None:
    """Return the step that the line of an algorithm, which is running above this call, has as its anchor."""
    frame = sys._getframe(1)
    for _ in range(DEEPEST):
        if (found := _anchor(frame.f_code, frame.f_lineno)) is not None:
            body = frame.f_locals.get("i")
            return Step(*found, body if isinstance(body, int) else None)
        if frame.f_back is None:
            break
        frame = frame.f_back
    return None


@cache
def _anchor(code: CodeType, line: int) -> tuple[str, str, str] | None:
    match = ANCHOR.search(linecache.getline(code.co_filename, line).rstrip())
    return (match[1], match[2], match[3] or "") if match else None


def python_source(line: Line, name: str, functions: str = "math") -> str:
    """Return a line as a Python function of sequences of numbers, with cos of this module; results are nested lists."""
    names = _names(line, lambda array, index: array + "".join(f"[{k}]" for k in index))
    called = sorted({operation for operation in line.operations if operation not in (*OPERATORS, "neg", "abs")})
    text = [f"from {functions} import {', '.join(called)}", "", ""] if called else []
    text.append(f"def {name}({', '.join(line.inputs)}):")
    text += [f"    {one}" for one in _statements(line, names, "#", "{} = {}")]
    nested = [_nested([names[k] for k in entries], shape) for shape, entries in line.outputs.values()]
    return "\n".join([*text, f"    return {', '.join(nested)}", ""])


def c_source(line: Line, name: str) -> str:
    """Return a line as a C99 function: pointers to its arguments, then to its results, row by row."""
    names = _names(line, lambda array, index: f"{array}[{np.ravel_multi_index(index, line.inputs[array])}]")
    results = [array if len(line.outputs) > 1 else "result" for array in line.outputs]
    arguments = [f"const double *{array}" for array in line.inputs] + [f"double *{result}" for result in results]
    text = ["#include <math.h>", "", f"void {name}({', '.join(arguments)})", "{"]
    text += [f"    {one}" for one in _statements(line, names, "//", "const double {} = {};")]
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
            stem = "t" if note is None else note.symbol + ("" if note.body is None else str(note.body))
            counts[stem] += 1
            names.append(f"{stem}_{counts[stem]}")
    return names


def _statements(line: Line, names: list[str], comment: str, assign: str) -> Iterator[str]:
    """Yield a line of text for each operation but those within another's, and a comment where another step begins."""
    before, names = None, [*names]
    for k, node in enumerate(line.nodes):
        if node[0] in ("input", "const"):
            continue
        if k in line.inner:
            names[k] = _expression(line, node, names)
            continue
        note = line.notes[k] if line.notes else None
        if note is not None and note != before:
            body = "" if note.body is None else f", body {note.body}"
            yield f"{comment} {note.section} {note.symbol}{note.words}{body}"
        before = note
        yield assign.format(names[k], _expression(line, node, names))


def _expression(line: Line, node: Node, names: list[str]) -> str:
    """Return an operation as text, its operands in brackets wherever they stand within it and are not calls."""
    operation, *needed = node
    if operation not in (*OPERATORS, "neg"):
        return f"{operation}({', '.join(names[k] for k in needed)})"
    plain = ("mul", "div") if operation in ("add", "sub") else ()
    inner = [k in line.inner and line.nodes[k][0] in {*OPERATORS, "neg"}.difference(plain) for k in needed]
    given = [f"({names[k]})" if bracket else names[k] for k, bracket in zip(needed, inner)]
    return f"-{given[0]}" if operation == "neg" else f" {OPERATORS[operation]} ".join(given)


def _nested(values: list[str], shape: tuple[int, ...]) -> str:
    """Return values as nested lists of a shape."""
    return str(np.reshape(np.array(values, object), shape).tolist()).replace("'", "")

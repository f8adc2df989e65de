"""A page per algorithm: what a step does, its formula, and the lines of the source that do it, side by side.

The words and the formulas are in algorithms/NAME.toml, a step at a time, each with the anchor of its last line (see
`twistwrench.tracing.anchors`). The lines themselves, and their numbers, are read from the source when the site is
built; a step whose anchor is no longer there stops the build, and so does an anchor without a step.
"""

from __future__ import annotations

import ast
import tomllib
from collections.abc import Iterator
from itertools import count, pairwise, zip_longest
from pathlib import Path
from typing import Any, NamedTuple

from twistwrench.tracing.anchors import anchor_of

from . import pencil, steps
from .pages import ROOT, joined, write
from .sketches import sketch

FOLDER = Path(__file__).resolve().parent / "algorithms"
SOURCE = ROOT / "src" / "twistwrench"
ORDER = ("kinematics", "rnea", "aba", "crba", "centroidal")
WORDS = {
    "en": ("What it does", "The source: lines {} to {} of `{}`", "Documentation of {}."),
    "zh": ("这一步做什么", "源码：`{2}` 第 {0}–{1} 行", "接口文档见 {}。"),
}
FORMULA = {
    "kinematics": r"V_i = X_i V_{\lambda(i)} + S_i\,\dot q_i",
    "rnea": r"F_{\lambda(i)} \leftarrow F_{\lambda(i)} + X_i^T F_i",
    "aba": r"\ddot q_i = D_i^{-1} (u_i - U_i^T a'_i)",
    "crba": r"M_{ji} = S_j^T F_{ji}",
    "centroidal": r"h_G = A_G\, v",
}
"""What stands for an algorithm on the page that leads to all."""
LINES = {"en": "## The lines", "zh": "## 逐行解释"}


class Lines(NamedTuple):
    """Some lines of a file."""

    first: int  # number of the first line in its file, from 1
    text: list[str]


def names() -> list[str]:
    """Return the names of the algorithms that have a page, in the chapter's order."""
    return [name for name in ORDER if (FOLDER / f"{name}.toml").exists()]


def read(name: str) -> dict[str, Any]:
    """Return what algorithms/NAME.toml says."""
    return tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))


def body(file: str, function: str) -> Lines:
    """Return the lines of a function below its docstring."""
    text = (SOURCE / file).read_text(encoding="utf-8")
    found = [n for n in ast.parse(text).body if isinstance(n, ast.FunctionDef) and n.name == function]
    if not found:
        raise LookupError(f"{file} has no function {function}")
    statements = found[0].body
    start = statements[1 if ast.get_docstring(found[0]) is not None else 0].lineno
    end = statements[-1].end_lineno or start
    return Lines(start, text.splitlines()[start - 1 : end])


def cut(lines: Lines, steps: list[str], file: str) -> list[Lines]:
    """Cut the lines of a function after the anchors of its steps; raises LookupError where they are not the same.

    A step has the lines from the one before it to its anchor, the last one also those that follow; a step may have
    several anchors, with commas between them.
    """
    expected = [name for step in steps for name in step.split(", ")]
    there = [name for line in lines.text if (name := anchor_of(line))]
    if expected != there:
        wrong = next((f"expected {a}, got {b}" for a, b in zip_longest(expected, there) if a != b), "")
        raise LookupError(f"{file}: not the steps of the source: {wrong}")
    last = {name: k for k, line in enumerate(lines.text) if (name := anchor_of(line))}
    ends = [0, *(last[step.split(", ")[-1]] + 1 for step in steps[:-1]), len(lines.text)]
    return [Lines(lines.first + a, lines.text[a:b]) for a, b in pairwise(ends)]


def page(name: str, language: str) -> str:
    """Return the page of an algorithm, as Markdown for MyST."""
    said, numbers = read(name), count(1)
    call = f"{{py:obj}}`tw.{said['call']} <twistwrench.{said['call']}>`"
    out = [
        "---\nhtml_theme.sidebar_secondary.remove: true\n---",
        f"# {said['title'][language]}",
        steps.step_through(said, language),
        joined(said["intro"][language].strip(), language),
        pencil.invitation(name, language),
        WORDS[language][2].format(call),
        LINES[language],
    ]
    for part in said["part"]:
        out += _table(part, numbers, language)
    return "\n\n".join([*out, steps.section(said, language)]) + "\n"


def _table(part: dict[str, Any], numbers: Iterator[int], language: str) -> Iterator[str]:
    """Yield the rows of one function."""
    does, source, _ = WORDS[language]
    lines = body(part["file"], part["function"])
    pieces = cut(lines, [step["at"] for step in part["step"]], part["file"])
    yield ":::::{container} beside"
    yield _head(does, source.format(lines.first, lines.first + len(lines.text) - 1, part["file"]))
    for step, piece in zip(part["step"], pieces, strict=True):
        yield _row(next(numbers), step, piece, language)
    yield ":::::"


def _head(does: str, source: str) -> str:
    cells = (f":::{{container}} say\n{does}\n:::", f":::{{container}} code\n{source}\n:::")
    return "\n".join(["::::{container} step head", *cells, "::::"])


def _row(k: int, step: dict[str, Any], part: Lines, language: str) -> str:
    text = part.text
    while text and not text[-1].strip():
        text = text[:-1]
    formula = f"\n\n$$\n{step['tex'].strip()}\n$$" if "tex" in step else ""
    say = f":::{{container}} say\n**{k}.** {step[language].strip()}{formula}\n:::"
    listing = "\n".join(["```{code-block} python", f":lineno-start: {part.first}", "", *text, "```"])
    return f"::::{{container}} step\n{say}\n:::{{container}} code\n{listing}\n:::\n::::"


def write_algorithms(out: Path, language: str) -> None:
    """Write the page of every algorithm, and the doors to them into the page that leads to them."""
    index, doors = out / "algorithms" / "index.md", ["::::{container} doors"]
    for name in names():
        title = f"**[{read(name)['title'][language]}]({name}.md)**"
        drawn = f"```{{raw}} html\n{sketch(name, language)}```"
        doors.append("\n\n".join([f":::{{container}} door\n{drawn}", title, f"$$\n{FORMULA[name]}\n$$"]) + "\n:::")
        write(out / "algorithms" / f"{name}.md", page(name, language))
    text = index.read_text(encoding="utf-8")
    write(index, text.replace("<!-- doors -->", "\n".join([*doors, "::::"])))

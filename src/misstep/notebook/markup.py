"""A verdict as HTML: the message, expected and got side by side in colour, and the hints one click at a time."""

from __future__ import annotations

import re
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from ..exercise import Exercise
from ..failing import Block, Case, Compared
from ..judge import Verdict
from ..text import Language, Text

if TYPE_CHECKING:
    from .cells import Checked

__all__ = ["STYLE", "case_html", "checked_html", "hints_html", "verdict_html"]

SAY = {
    "expected": Text("expected", "应为"),
    "yours": Text("yours", "你的"),
    "inputs": Text("the inputs of this case", "这组数据的输入"),
    "hint": Text("hint {k} of {n}", "提示 {k}/{n}"),
    "again": Text("The same case again:", "再现这组数据："),
    "words": Text("Your words, and the model answer to compare with:", "你的回答，以及供对照的参考答案："),
    "map": Text("where it differs: a square for each number", "不同之处：每个数一格"),
}

STYLE = """<style>
.tw-check {font-size: 0.95em; line-height: 1.4}
.tw-check pre {white-space: pre-wrap; margin: 0.3em 0; background: none}
.tw-check .tw-right {border-left: 5px solid #009e73; padding-left: 0.8em}
.tw-check .tw-wrong {border-left: 5px solid #d55e00; padding-left: 0.8em}
.tw-check .tw-to-do {border-left: 5px solid #999999; padding-left: 0.8em}
.tw-check table.tw-numbers {display: inline-table; margin: 0.2em 1.2em 0.4em 0; border-collapse: collapse}
.tw-check table.tw-numbers td {text-align: right; padding: 1px 7px; font-family: monospace}
.tw-check td.tw-bad {background: #fbd5be; color: #7a2e00; font-weight: bold}
.tw-check td.tw-good {background: #d5f0e6; color: #00402e}
.tw-check details {margin: 0.2em 0 0.2em 1em}
.tw-check svg {vertical-align: top; margin: 0.3em 0}
</style>"""

IN_THE_SHELL = re.compile(r"[;；][^;；\n]* hint [\w.]+")
"""What a message says of a command; where the hints are below it, it is left out."""

SQUARE = 9
"""Pixels of the square of a number in the map of an array."""

LARGE = 6
"""Rows or columns up to which an array is shown in numbers; larger ones as a map as well."""


def checked_html(checked: Checked, *, hints: bool = True) -> str:
    """Return what a notebook shows for a checked exercise, with the hints one click at a time unless left out."""
    language, exercise = checked.language, checked.exercise
    parts = [STYLE, '<div class="tw-check">']
    for name, verdict in checked.verdicts.items():
        shown = verdict_html(verdict, language) if verdict.state == "wrong" else f"<b>{escape(checked.line(name))}</b>"
        kind = {"done": "right", "wrong": "wrong", "to do": "to-do"}[verdict.state]
        shown = IN_THE_SHELL.sub("", shown) if hints else shown
        parts.append(f'<div class="tw-{kind}">{shown}</div>')
    if checked.words and exercise.answer is not None:
        model = exercise.answer.of(language)
        parts.append(f"<p>{SAY['words'].of(language)}</p>{_side_by_side(checked.words, model)}")
    if hints and not checked.right:
        parts.append(hints_html(exercise, language))
    return "\n".join([*parts, f"<p>{escape(checked.progress)}</p></div>"])


def _side_by_side(words: str, model: str) -> str:
    cells = "".join(
        f'<td style="vertical-align: top; text-align: left; width: 50%"><pre>{escape(text.strip())}</pre></td>'
        for text in (words, model)
    )
    return f'<table style="width: 100%"><tr>{cells}</tr></table>'


def verdict_html(verdict: Verdict, language: Language) -> str:
    """Return a message with its failing case."""
    head, *lines = verdict.message(language).split("\n")
    text = escape("\n".join(lines).strip("\n"))
    shown = case_html(verdict.case, language) if verdict.case is not None and verdict.case.inputs else ""
    return f"<b>{escape(head)}</b><pre>{text}</pre>{shown}"


def case_html(case: Case, language: Language) -> str:
    """Return the failing case: expected and got side by side, a map of large arrays, the inputs after a click."""
    parts = [_compared(compared, language) for compared in case.compared if not compared.is_right]
    inputs = case.text(language).split("\n")[1:]
    first = next((k for k, line in enumerate(inputs) if not line.startswith(" ")), len(inputs))
    shown = escape("\n".join(line.removeprefix("    ") for line in inputs[:first]))
    parts.append(f"<details><summary>{SAY['inputs'].of(language)}</summary><pre>{shown}</pre></details>")
    parts.append(f"{SAY['again'].of(language)} <code>{escape(case.cell)}</code>")
    return "\n".join(parts)


def _compared(compared: Compared, language: Language) -> str:
    name = compared.quantity.label.of(language)
    parts = [f"<p><b>{escape(name)}</b></p>"]
    for block in compared.blocks:
        bad = bool(block.wrong.any())
        if block.name is not None:
            parts.append(f"<div>{'✗' if bad else '✓'} {escape(block.name.of(language))}</div>")
        if bad:
            parts.append(_numbers(block, language) if _is_small(block) else _map(block, language))
    return "".join(parts)


def _is_small(block: Block) -> bool:
    return block.expected.ndim <= 2 and max(block.expected.shape or (1,)) <= LARGE


def _numbers(block: Block, language: Language) -> str:
    """Return two tables, expected and got; what differs is in colour."""
    rows = list(block.rows())
    wrong = np.atleast_2d(block.wrong)
    tables = []
    for k, key in enumerate(("expected", "yours")):
        lines = ""
        for row, bad in zip(rows, wrong):
            kinds = [("tw-good" if k == 0 else "tw-bad") if no else "" for no in bad]
            lines += "<tr>" + "".join(f'<td class="{c}">{x.strip(" []")}</td>' for c, x in zip(kinds, row[k])) + "</tr>"
        tables.append(f'<table class="tw-numbers"><caption>{SAY[key].of(language)}</caption>{lines}</table>')
    return "<div>" + "".join(tables) + "</div>"


def _map(block: Block, language: Language) -> str:
    """Return a picture of a large array: a square for each number, orange where it differs."""
    wrong = block.wrong.reshape(-1, block.wrong.shape[-1])
    height, width = (SQUARE * n for n in wrong.shape)
    squares = "".join(
        f'<rect x="{SQUARE * j}" y="{SQUARE * i}" width="{SQUARE - 1}" height="{SQUARE - 1}" '
        f'fill="{"#d55e00" if bad else "#009e73"}"/>'
        for (i, j), bad in np.ndenumerate(wrong)
    )
    label = SAY["map"].of(language)
    picture = f'<svg width="{width}" height="{height}" role="img" aria-label="{label}">{squares}</svg>'
    return f"<div>{picture}<br><small>{label}</small></div>"


def hints_html(exercise: Exercise, language: Language) -> str:
    """Return the hints, each inside the one before it: it takes a click to see the next."""
    nested, n = "", len(exercise.hints)
    for k in range(n, 0, -1):
        title = SAY["hint"].fill(k=k, n=n).of(language)
        text = escape(exercise.hints[k - 1].of(language).strip())
        nested = f"<details><summary>{title}</summary><pre>{text}</pre>{nested}</details>"
    return nested

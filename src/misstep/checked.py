"""The record of an exercise: the verdicts on its functions and on its answer in words; as text, and as HTML."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape

import numpy as np

from .exercise import Exercise, Part
from .text import Language, Text, say, wrapped
from .verdict import EXPECTED, LEVELS, YOURS, Case, Compared, State, Verdict

__all__ = ["STATES", "STYLE", "WORDS", "Checked", "case_html", "checked_html", "ladder", "verdict_html"]

WORDS = "words"  # what stands for the answer in words among the names of functions
STATES: dict[State, Text] = {
    "done": Text("done", "完成"),
    "wrong": Text("wrong", "有误"),
    "to do": Text("to do", "未做"),
}

NOTED = Text("noted", "已收到")
IN_WORDS = Text("your words", "文字作答")
LATER = Text("The model answer comes once the functions are right.", "函数都写对之后，给出参考答案供对照。")


@dataclass(frozen=True, repr=False)
class Checked:
    """The verdicts on an exercise. A notebook shows them with the numbers side by side, and the hints one at a time.

    Attributes
    ----------
    exercise : Exercise
    verdicts : dict
        From the name of each function, and ``"words"``, to its verdict.
    words : str, optional
        The answer in words.
    are_functions_right : bool
        Whether all functions of the exercise are right, also those that were checked before. The answer in words is
        never judged; the model answer stands beside it once they are.
    language : {"en", "zh"}
    progress : str
        How much of the section has been checked and is right, as a line.
    level : int
        How much is told of a wrong answer at once: 1 where it is wrong and the kind of slip, 2 the slip, 3 the cure.
    max_level : int
        How much can be asked for.
    hints : dict
        How many were asked for, by the name of the function.
    solution : bool
        Whether the solution was shown.
    """

    exercise: Exercise
    verdicts: dict[str, Verdict]
    words: str | None
    language: Language
    progress: str = ""
    level: int = 1
    max_level: int = LEVELS[-1]
    hints: Mapping[str, int] = field(default_factory=dict)
    solution: bool = False
    are_functions_right: bool = False

    @property
    def functions(self) -> dict[str, Verdict]:
        """The verdicts without that on the words."""
        return {name: verdict for name, verdict in self.verdicts.items() if name != WORDS}

    @property
    def right(self) -> bool:
        """Whether all functions that were checked are right; words alone never are."""
        return bool(self.functions) and self.state == "done"

    @property
    def points(self) -> float:
        """The part of the exercise's functions that is right, from 0 to 1."""
        return sum(verdict.state == "done" for verdict in self.functions.values()) / len(self.exercise.parts)

    @property
    def state(self) -> State:
        """Wrong if one of the verdicts is, done if all are."""
        found = {verdict.state for verdict in self.verdicts.values()}
        return "wrong" if "wrong" in found else "to do" if "to do" in found else "done"

    @property
    def how(self) -> str:
        """By what it was found what is wrong, as in `Verdict`; empty where nothing is."""
        return next((verdict.how for verdict in self.verdicts.values() if verdict.state == "wrong"), "")

    def line(self, name: str) -> str:
        """Return the state of a function that is not wrong as a line."""
        verdict = self.verdicts[name]
        state = Text("to do", "未做") if verdict.state == "to do" else NOTED if name == WORDS else Text("right", "正确")
        title = IN_WORDS if name == WORDS else name
        head = say("{id}  {name}: {state}.", "{id}  {name}：{state}。", id=self.exercise.id, name=title, state=state)
        later = [LATER] if state is NOTED and self.exercise.answer is not None and self.model_answer is None else []
        return "  ".join(line.of(self.language) for line in (head, *verdict.lines, *later))

    @property
    def model_answer(self) -> Text | None:
        """The model answer to compare with; none before there are words, and all functions are right."""
        return self.exercise.answer if self.words and self.are_functions_right else None

    def __repr__(self) -> str:
        lines: list[str] = []
        for name, verdict in self.verdicts.items():
            is_wrong = verdict.state == "wrong"
            lines += [verdict.report(self.language, self.level) if is_wrong else self.line(name), ""]
        if self.model_answer is not None:
            head = "{id}  Your words, to compare with the model answer:", "{id}  请把你的回答与参考答案对照："
            lines += [say(*head, id=self.exercise.id).of(self.language)]
            lines += [*wrapped(self.model_answer.of(self.language)), ""]
        return "\n".join([*lines, self.progress])

    def _repr_html_(self) -> str:
        return checked_html(self)


# ---------------------------------------------------------------- as HTML

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
</style>"""

AGAIN, INPUTS = Text("The same case again:", "再现这组数据："), Text("the inputs of this case", "这组数据的输入")
COMPARE = Text("Your words, and the model answer to compare with:", "你的回答，以及供对照的参考答案：")


def checked_html(checked: Checked, *, hints: bool = True) -> str:
    """Return what a notebook shows for a checked exercise, with the hints one click at a time unless left out."""
    language, exercise = checked.language, checked.exercise
    parts = [STYLE, '<div class="tw-check">']
    for name, verdict in checked.verdicts.items():
        shown = f"<b>{escape(checked.line(name))}</b>"
        if verdict.state == "wrong":
            shown = verdict_html(verdict, language, checked.level)
        if hints and verdict.state != "done" and name != WORDS:
            every, told = ladder(exercise.part(name), verdict, checked.max_level), verdict.stages(checked.level)
            shown += _hints([x for x in every if x not in told], language)
        kind = {"done": "to-do" if name == WORDS else "right", "wrong": "wrong", "to do": "to-do"}[verdict.state]
        parts.append(f'<div class="tw-{kind}">{shown}</div>')
    if checked.words and checked.model_answer is not None:
        style = "vertical-align: top; text-align: left; width: 50%"
        texts = (checked.words, checked.model_answer.of(language))
        cells = "".join(f'<td style="{style}"><pre>{escape(text.strip())}</pre></td>' for text in texts)
        parts.append(f'<p>{COMPARE.of(language)}</p><table style="width: 100%"><tr>{cells}</tr></table>')
    return "\n".join([*parts, f"<p>{escape(checked.progress)}</p></div>"])


def ladder(part: Part, verdict: Verdict, max_level: int) -> tuple[Text, ...]:
    """Return what can be asked for, one after the other: which slip it is, the hints of the function, the cure."""
    help = verdict.stages(2)
    return (*help, *part.hints, *verdict.stages(max_level)[len(help) :])


def _hints(texts: Sequence[Text], language: Language) -> str:
    """Return the hints, each inside the one before it: it takes a click to see the next."""
    nested, n = "", len(texts)
    for k in range(n, 0, -1):
        title = say("hint {k} of {n}", "提示 {k}/{n}", k=k, n=n).of(language)
        text = escape(texts[k - 1].of(language).strip())
        nested = f"<details><summary>{title}</summary><pre>{text}</pre>{nested}</details>"
    return nested


def verdict_html(verdict: Verdict, language: Language, level: int = 1) -> str:
    """Return a message with its failing case."""
    head, *lines = verdict.message(language, level, in_shell=False).split("\n")
    text = escape("\n".join(lines).strip("\n"))
    shown = case_html(verdict.case, language) if verdict.case is not None and verdict.case.inputs else ""
    return f"<b>{escape(head)}</b><pre>{text}</pre>{shown}"


def case_html(case: Case, language: Language) -> str:
    """Return the failing case: expected and got side by side, a map of large arrays, the inputs after a click."""
    parts = [_compared_html(compared, language) for compared in case.compared if not compared.is_right]
    inputs = escape("\n".join(case.given(language)))
    parts.append(f"<details><summary>{INPUTS.of(language)}</summary><pre>{inputs}</pre></details>")
    return "\n".join([*parts, f"{AGAIN.of(language)} <code>{escape(case.cell)}</code>"])


def _compared_html(compared: Compared, language: Language) -> str:
    """Return two tables, expected and got, in which what differs is in colour; of a large array the first entries."""
    name = f"<p><b>{escape(compared.label.of(language))}</b></p>"
    if not compared.is_small:
        return name + f"<pre>{escape(chr(10).join(compared.lines(language)[1:]))}</pre>"
    rows, wrong, tables = list(compared.rows()), np.atleast_2d(compared.wrong), ""
    for k, (title, kind) in enumerate(((EXPECTED, "tw-good"), (YOURS, "tw-bad"))):
        lines = ""
        for row, bad in zip(rows, wrong):
            cells = (f'<td class="{kind if no else ""}">{x.strip(" []")}</td>' for x, no in zip(row[k], bad))
            lines += f"<tr>{''.join(cells)}</tr>"
        tables += f'<table class="tw-numbers"><caption>{title.of(language)}</caption>{lines}</table>'
    return f"{name}<div>{tables}</div>"

"""A question of a notebook before the answer; a guess is judged against what the package computes, as text and HTML."""

from __future__ import annotations

import re
import string
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from html import escape
from importlib import import_module
from importlib.resources import files
from types import EllipsisType
from typing import Any

import numpy as np

from misstep.checked import STYLE
from misstep.text import Language, Text, default_language, wrapped

from ..errors import check_known

__all__ = ["SECTIONS", "Asked", "Question", "ask", "questions", "written_unit"]

SECTIONS = tuple(f"49.{k}" for k in range(1, 12))
QUESTIONS = f"{__package__}.questions"
CLOSE = 0.05
"""A number that is off by no more than this part of the truth is right, unless the question says otherwise."""

SAY = {
    "letter": Text(
        'Replace the dots in tw.ask("{id}", ...) by a letter, such as "a", and run the cell again.',
        '把 tw.ask("{id}", ...) 里的省略号换成一个字母，例如 "a"，再运行这个单元格。',
    ),
    "number": Text(
        'Replace the dots in tw.ask("{id}", ...) by a number, {unit}, and run the cell again.',
        '把 tw.ask("{id}", ...) 里的省略号换成一个数，{unit}，再运行这个单元格。',
    ),
    "no unit": Text("without a unit", "没有单位"),
    "in unit": Text("in {unit}", "单位 {unit}"),
    "right": Text("Right: {truth}.", "对：{truth}。"),
    "guessed": Text("Your guess: {guess}.", "你猜的是 {guess}。"),
    "is": Text("It is {truth}.", "实际是 {truth}。"),
    "times": Text("You are a factor of {times} off.", "差了 {times} 倍。"),
    "sign": Text("Its sign is the other one.", "符号相反。"),
    "zero": Text("It is exactly zero.", "恰好是零。"),
    "not zero": Text("It is not zero.", "它不是零。"),
    "guess": Text("your guess", "你猜的"),
    "truth": Text("computed", "算出的"),
    "stop": Text(". ", "。"),
    "open": Text("The answer, once you have a guess", "有了猜测，再看答案"),
    "why": Text("Why", "为什么"),
    "not this": Text("Not this one.", "不是这个。"),
}


@dataclass(frozen=True)
class Question:
    """A question with choices, or one for a number.

    Attributes
    ----------
    id : str
        As "49.7-knees".
    text, why : Text
        What is asked, and why the answer is what it is. In braces, numbers that the package computes.
    choices : dict
        From the name of each choice to its text; empty where a number is asked for.
    usual : dict
        From the name of each usual wrong answer, a choice or a computed number, to what is said of it.
    unit : str
        Of the number; may be empty.
    rtol, atol : float
        How far from the truth a number is still right.
    """

    id: str
    text: Text
    why: Text
    choices: Mapping[str, Text] = field(default_factory=dict)
    usual: Mapping[str, Text] = field(default_factory=dict)
    unit: str = ""
    rtol: float = CLOSE
    atol: float = 0.0

    def compute(self) -> dict[str, Any]:
        """Return the truth, under that name, and the numbers of the texts."""
        section, _, name = self.id.partition("-")
        return dict(getattr(_module(section), name.replace("-", "_"))())

    def letter(self, name: str) -> str:
        """Return the letter of a choice."""
        return string.ascii_lowercase[list(self.choices).index(name)]


@dataclass(frozen=True, repr=False)
class Asked:
    """A question, and the verdict on a guess if there is one. A notebook shows it with the answer folded away.

    Attributes
    ----------
    question : Question
    facts : dict
        The truth, and the numbers of the texts, as computed.
    guess : str or float, optional
        The name of a choice, or a number.
    language : {"en", "zh"}
    """

    question: Question
    facts: Mapping[str, Any]
    guess: str | float | None
    language: Language

    @property
    def truth(self) -> Any:
        """The right answer: the name of a choice, or a number."""
        return self.facts["truth"]

    @property
    def right(self) -> bool | None:
        """Whether the guess is right; None where there is none."""
        return None if self.guess is None else self._is(self.truth)

    @property
    def letter(self) -> str:
        """The letter of the choice that was guessed; empty where none was."""
        return self.question.letter(str(self.guess)) if self.guess in self.question.choices else ""

    def draw(self, ax: Any, axis: str = "x") -> None:
        """Draw the guess and the truth as lines across a picture; nothing where there is no guess.

        Parameters
        ----------
        ax : matplotlib axes
        axis : {"x", "y"}
            The axis on which the number lies.
        """
        if self.guess is not None:
            line = ax.axvline if axis == "x" else ax.axhline
            lines = [
                line(number, color="#cc79a7", linestyle=style, label=self._say(key))
                for number, style, key in ((self.guess, "--", "guess"), (self.truth, ":", "truth"))
            ]
            ax.legend(handles=None if ax.get_legend() else lines, fontsize=8)

    def _is(self, answer: Any) -> bool:
        """Whether the guess is an answer, as closely as the question wants it."""
        if self.question.choices:
            return bool(self.guess == answer)
        near = self.question.atol or self.question.rtol * abs(answer)
        return self.guess is not None and abs(float(self.guess) - answer) <= near

    def _say(self, key: str, **values: object) -> str:
        return SAY[key].fill(**values).of(self.language)

    def _filled(self, text: Text) -> str:
        return text.of(self.language).format(**self.facts)

    @property
    def _unit(self) -> str:
        """The unit as it is written in the language."""
        return written_unit(self.question.unit, self.language)

    def _shown(self, answer: Any) -> str:
        """Return an answer as it is written: a choice with its letter, a number with its unit."""
        if self.question.choices:
            return f"{self.question.letter(answer)}) {self._filled(self.question.choices[answer])}"
        return f"{float(answer):.4g} {self._unit}".rstrip()

    def _remark(self) -> str:
        """Return what is said of a wrong guess: the sentence of a usual one, or how far off the number is."""
        for name, said in self.question.usual.items():
            if self._is(name if self.question.choices else self.facts[name]):
                return self._filled(said)
        if self.question.choices or self.guess is None:
            return self._say("not this")
        if self.truth == 0 or self.guess == 0:
            return self._say("zero" if self.truth == 0 else "not zero")
        times = float(self.guess) / self.truth
        return self._say("sign") if times < 0 else self._say("times", times=f"{max(times, 1 / times):.2g}")

    @property
    def _verdict(self) -> str:
        if self.right:
            return self._say("right", truth=self._shown(self.truth))
        guessed = self._say("guessed", guess=self._shown(self.guess))
        truth = self._say("is", truth=self._shown(self.truth))
        return ("" if self.language == "zh" else " ").join([guessed, self._remark(), truth])

    @property
    def _how(self) -> str:
        """Return how to answer."""
        unit = self._say("in unit", unit=self._unit) if self._unit else self._say("no unit")
        return self._say("letter" if self.question.choices else "number", id=self.question.id, unit=unit)

    def __repr__(self) -> str:
        lines = wrapped(self._filled(self.question.text))
        lines += [f"  {self._shown(name)}" for name in self.question.choices]
        if self.guess is None:
            return "\n".join([*lines, "", *wrapped(self._how)])
        return "\n".join([*lines, "", *wrapped(self._verdict), "", *wrapped(self._filled(self.question.why))])

    def _repr_html_(self) -> str:
        head = f"<p><b>{escape(self._filled(self.question.text))}</b></p>"
        why = escape(self._filled(self.question.why))
        if self.guess is not None:
            kind, folded = "right" if self.right else "wrong", _folded(self._say("why"), why)
            body = f'<div class="tw-{kind}"><p>{escape(self._verdict)}</p>{folded}</div>'
        else:
            body = f'<div class="tw-to-do">{self._answers(why)}<p><small>{escape(self._how)}</small></p></div>'
        return f'{STYLE}\n<div class="tw-check tw-ask">{head}{body}</div>'

    def _answers(self, why: str) -> str:
        """Return what can be opened before a guess is typed: each choice with its verdict, or the number."""
        if not self.question.choices:
            return _folded(self._say("open"), f"{escape(self._shown(self.truth))}{self._say('stop')}{why}")
        parts = []
        for name in self.question.choices:
            guessed = Asked(self.question, self.facts, name, self.language)
            said = f"{escape(self._say('right', truth=self._shown(name)))} {why}"
            parts.append(_folded(escape(self._shown(name)), said if guessed.right else escape(guessed._remark())))
        return "".join(parts)


def written_unit(unit: str, language: Language) -> str:
    """Return a unit as it is written in a language: in Chinese N·m and kg·m²."""
    return re.sub(r"(?<=[Ng]) m(?![a-z])", "·m", unit) if language == "zh" else unit


def _folded(head: str, body: str) -> str:
    return f"<details><summary>{head}</summary><p>{body}</p></details>"


def _module(section: str) -> Any:
    return import_module(f"{QUESTIONS}.section_{section.replace('.', '_')}")


@cache
def questions(section: str) -> dict[str, Question]:
    """Return the questions of a section by their ids, in the order in which its notebook asks them."""
    source = files(QUESTIONS) / f"section_{section.replace('.', '_')}.toml"
    table = tomllib.loads(source.read_text(encoding="utf-8"))
    return {f"{section}-{name}": _question(f"{section}-{name}", entry) for name, entry in table.items()}


def _question(name: str, entry: Mapping[str, Any]) -> Question:
    choices = {key: Text(*pair) for key, pair in entry.get("choices", {}).items()}
    usual = {key: Text(*pair) for key, pair in entry.get("usual", {}).items()}
    numbers = {key: entry[key] for key in ("unit", "rtol", "atol") if key in entry}
    return Question(name, Text(*entry["text"]), Text(*entry["why"]), choices, usual, **numbers)


def ask(name: str, guess: float | str | EllipsisType | None = None, *, language: Language | None = None) -> Asked:
    """Ask a question of a notebook; with a guess, judge it and tell.

    Parameters
    ----------
    name : str
        Of the question, as "49.7-knees".
    guess : str or float, optional
        The letter of a choice, or a number in the unit that the question names. With none, or with ``...``, the
        question is shown.
    language : {"en", "zh"}, optional
        That of the environment unless given.

    Returns
    -------
    Asked
        Prints as the question, or as the verdict and the answer; a notebook shows it as HTML, the answer folded.

    Raises
    ------
    NameNotFound
        If there is no such question, or no such language.
    ValueError
        If the guess is no letter of the choices, or no finite number.

    Examples
    --------
    >>> import twistwrench as tw
    >>> print(tw.ask("49.9-tipping", 90, language="en").right)
    False
    """
    language = default_language() if language is None else language
    check_known("language", language, ("en", "zh"))
    section = name.partition("-")[0] if isinstance(name, str) else ""
    known = questions(section) if section in SECTIONS else {}
    check_known("question", name, known or [other for section in SECTIONS for other in questions(section)])
    question = known[name]
    given = None if guess is None or guess is ... else _read(question, guess)
    return Asked(question, question.compute(), given, language)


def _read(question: Question, guess: Any) -> str | float:
    """Return the choice or the number that a guess means."""
    if question.choices:
        letters = {question.letter(name): name for name in question.choices}
        given = str(guess).strip().lower().rstrip(")")
        if given not in letters:
            raise ValueError(f"{question.id}: expected one of the letters {', '.join(letters)}, got {guess!r}")
        return letters[given]
    try:
        number = float(guess)
    except (TypeError, ValueError):
        number = np.nan
    if not np.isfinite(number):
        raise ValueError(f"{question.id}: expected a number, in {question.unit or 'no unit'}, got {guess!r}")
    return number

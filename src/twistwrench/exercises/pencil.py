"""Ten questions to each section that take a pencil and no computer: a sheet, its answers, and a file for Moodle."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from misstep.text import Language, Text

from ..errors import check_known
from .asking import written_unit
from .chapter import COURSE

__all__ = ["SECTIONS", "PencilQuestion", "gift", "pencil_questions", "sheet"]

SECTIONS = tuple(name for name in COURSE.sections if name.startswith("49."))
NEAR = 0.01
"""A number that is off by no more than this part of the answer is right, unless the question says otherwise."""
LETTERS = "abcd"
SIX = re.compile(r"\((?:[^();,]+, ){2}[^();,]+; ")
"""Six numbers in a question, as (0, 0, 2; 1, 0, 0)."""
WORDS = {
    "title": Text("{section} with a pencil", "{section} 纸笔题"),
    "answers": Text("{section} with a pencil: answers", "{section} 纸笔题：答案"),
    "note": Text(
        "**{title}.** Paper and pencil, no computer. Twists are (ω, v), wrenches (τ, f); every number in SI units.",
        "**{title}**。只用纸笔，不用计算机。twist 写成 (ω, v)，wrench 写成 (τ, f)；所有数值用 SI 单位。",
    ),
    "commas": Text("(Write the numbers with commas between them.)", "（数与数之间用逗号隔开。）"),
    "order": Text(
        "(Of six numbers the angular ones come first: a twist is (ω, v), a wrench (τ, f), a momentum (k, l).)",
        "（六个数中角分量在前：twist 是 (ω, v)，wrench 是 (τ, f)，动量是 (k, l)。）",
    ),
    "unit": Text("(in {unit})", "（单位 {unit}）"),
}


@dataclass(frozen=True)
class PencilQuestion:
    """A question that is answered by numbers or by a choice.

    Attributes
    ----------
    text, why : Text
        What is asked, and why the answer is what it is.
    numbers : tuple of float
        The answer; empty where there are choices.
    unit : str
        Of the numbers; may be empty.
    rtol : float
        How far a number may be from the answer, as a part of it.
    choices : tuple of Text
    right : int
        Which choice is right.
    fractions : tuple of str
        The numbers as fractions, where these are asked for as well.
    by : tuple of str
        Expressions that compute the numbers, or are true if the choice is right. Tests evaluate them.
    """

    text: Text
    why: Text
    numbers: tuple[float, ...] = ()
    unit: str = ""
    rtol: float = NEAR
    choices: tuple[Text, ...] = ()
    right: int = 0
    fractions: tuple[str, ...] = ()
    by: tuple[str, ...] = ()

    def unit_in(self, language: Language) -> str:
        """Return the unit as it is written in a language."""
        return written_unit(self.unit, language)

    def answer(self, language: Language) -> str:
        """Return the answer in one language, a choice with its letter."""
        if self.choices:
            return f"{LETTERS[self.right]}) {self.choices[self.right].of(language)}"
        numbers = ", ".join(f"{number:g}".replace("-", "−") for number in self.numbers)
        return f"{numbers if len(self.numbers) == 1 else f'({numbers})'} {self.unit_in(language)}".rstrip()


@cache
def pencil_questions(section: str) -> tuple[PencilQuestion, ...]:
    """Return the questions of a section.

    Parameters
    ----------
    section : str
        As "49.5".

    Raises
    ------
    NameNotFound
        If the chapter has no such section.

    Examples
    --------
    >>> [question.answer("en") for question in pencil_questions("49.5")][:2]
    ['(0, 0.12, 0.12) kg m²', '5']
    """
    check_known("section", section, SECTIONS)
    source = files(__package__) / "pencil" / f"section_{section.replace('.', '_')}.toml"
    return tuple(map(_question, tomllib.loads(source.read_text(encoding="utf-8"))["question"]))


def _question(entry: Mapping[str, Any]) -> PencilQuestion:
    given: dict[str, Any] = {key: entry[key] for key in ("unit", "rtol", "right") if key in entry}
    number = entry.get("number", [])
    numbers = tuple(number) if isinstance(number, list) else (number,)
    choices = tuple(Text(*pair) for pair in entry.get("choices", []))
    given |= {key: tuple(entry.get(key, [])) for key in ("fractions", "by")}
    return PencilQuestion(Text(*entry["text"]), Text(*entry["why"]), numbers, choices=choices, **given)


def sheet(section: str, language: Language = "en", *, answers: bool = False) -> str:
    """Return the sheet of a section as Markdown, with or without the answers.

    Examples
    --------
    >>> print(sheet("49.5", answers=True).splitlines()[5])
    4. **2 J** ½ VᵀÎV = ½ (2 · 1 + 1 · 2).
    """
    questions = pencil_questions(section)
    title = WORDS["answers" if answers else "title"].fill(section=section)
    lines = [f"# {title.of(language)}", ""]
    lines += [] if answers else [note(section, language), ""]
    for k, question in enumerate(questions, start=1):
        if answers:
            lines.append(f"{k}. **{plain(question.answer(language))}** {plain(question.why.of(language))}")
        else:
            lines += [f"{k}. {plain(question.text.of(language))}", ""]
            lines += [f"   {LETTERS[j]}) {plain(choice.of(language))}\n" for j, choice in enumerate(question.choices)]
    return "\n".join(lines).rstrip() + "\n"


def note(section: str, language: Language) -> str:
    """Return what stands above the questions of a section: its title, and how numbers are written."""
    return WORDS["note"].fill(title=COURSE.sections[section]).of(language)


def plain(text: str) -> str:
    r"""Return a text with nothing in it that Markdown would take for its own, but code.

    Examples
    --------
    >>> print(plain("X* of `X_i`"))
    X\* of `X_i`
    """
    pieces = re.split(r"(`[^`]+`)", text)
    return "".join(piece if k % 2 else re.sub(r"([*_\[\]<>$\\])", r"\\\1", piece) for k, piece in enumerate(pieces))


def gift(section: str, language: Language = "en") -> str:
    r"""Return the questions of a section in Moodle's GIFT format, which other learning platforms read as well.

    A single number is asked with its tolerance, several as a short answer with commas, a choice by its letter. Commas
    and brackets of a Chinese keyboard are right as well, with or without blanks. A question with six numbers says in
    which order they stand.

    Examples
    --------
    >>> print(gift("49.5").splitlines()[4].partition("inertia? ")[2])
    {#5:0.05####One motion costs nothing\: turning about its own rod. One point has rank 3.}
    """
    return f"$CATEGORY: twistwrench/{section}\n\n" + "\n\n".join(
        f"::{section}.{k}::[plain]{_escaped(_asked(question, language))} {{{_expected(question, language)}}}"
        for k, question in enumerate(pencil_questions(section), start=1)
    )


def _asked(question: PencilQuestion, language: Language) -> str:
    unit = WORDS["unit"].fill(unit=question.unit_in(language)).of(language) if question.unit else ""
    commas = WORDS["commas"].of(language) if len(question.numbers) > 1 else ""
    six = len(question.numbers) == 6 or SIX.search(question.text.en)
    order = WORDS["order"].of(language) if six else ""
    return ("" if language == "zh" else " ").join(filter(None, [question.text.of(language), order, unit, commas]))


def _expected(question: PencilQuestion, language: Language) -> str:
    why = f"####{_escaped(question.why.of(language))}"
    if question.choices:
        marks = ("=" if k == question.right else "~" for k in range(len(question.choices)))
        return (
            " ".join(mark + _escaped(choice.of(language)) for mark, choice in zip(marks, question.choices, strict=True))
            + why
        )
    if len(question.numbers) == 1:
        (number,) = question.numbers
        return f"#{number:g}:{abs(number) * max(question.rtol, NEAR):.3g}{why}"
    written = [tuple(f"{number:g}" for number in question.numbers), question.fractions]
    written += [tuple(number.replace("-", "−") for number in numbers) for numbers in written]
    bare = [mark.join(numbers) for numbers in dict.fromkeys(written) if numbers for mark in (", ", ",", "，", "， ")]
    spellings = [f"{left}{spelling}{right}" for left, right in ("  ", "()", "（）") for spelling in bare]
    return " ".join(f"={_escaped(spelling.strip())}" for spelling in spellings) + why


def _escaped(text: str) -> str:
    """Return a text for GIFT, which has marks of its own."""
    return re.sub(r"([\\~=#{}:])", r"\\\1", text)

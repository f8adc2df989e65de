"""A question before the answer: what a reader guesses is judged against what the package computes."""

from __future__ import annotations

from types import EllipsisType
from typing import Any

import numpy as np

from misstep.text import Language, default_language

from ..errors import check_known
from .asked import SECTIONS, Asked, Question, questions

__all__ = ["ask"]


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

"""What a student and a teacher call: the functions of `misstep` for this chapter."""

from __future__ import annotations

import sys
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any

from misstep import cases, helping, notebook, progress, skeletons, workbook
from misstep.checked import Checked
from misstep.isolation import TIME_LIMIT_S
from misstep.progress import Status
from misstep.text import Language

from .chapter import COURSE

__all__ = ["Checked", "Status", "case", "check", "hint", "mine", "solution", "start", "status"]


def start(
    folder: str | PathLike[str], *, language: Language | None = None, cure: bool = True
) -> tuple[list[Path], list[Path]]:
    """Write the skeletons of all exercises into a folder. Existing files are not touched.

    Parameters
    ----------
    folder : str or path
        Made if need be.
    language : {"en", "zh"}, optional
        Of texts and messages; that of the environment unless given.
    cure : bool
        Whether the student may ask what to write instead of a wrong line.

    Returns
    -------
    new, kept : list of path
        The files that were written, and those that were there before.
    """
    return skeletons.start(COURSE, folder, language=language, cure=cure)


def mine(name: str) -> Callable[..., Any]:
    """Return a function of an earlier exercise: yours once it is right, the reference until then.

    Which of the two is decided when it is first called.

    Parameters
    ----------
    name : str
        Of the function, as in the skeletons.

    Returns
    -------
    callable

    Raises
    ------
    NameNotFound
        If no exercise has a function of that name.

    Examples
    --------
    >>> skew = mine("skew")  # outside a folder with exercises: the reference
    >>> skew([1.0, 2.0, 3.0])
    array([[ 0., -3.,  2.],
           [ 3.,  0., -1.],
           [-2.,  1.,  0.]])
    """
    return workbook.mine(COURSE, name, sys._getframe(1).f_globals)  # the folder is that of the calling file


def check(
    number: str,
    *functions: Callable[..., Any],
    words: str | None = None,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT_S,
    level: int = 1,
) -> Checked:
    """Check an exercise where it is written: in a notebook, a script or a shell.

    Parameters
    ----------
    number : str
        Of the exercise, as "49.6.1".
    functions : callable
        The answers, in any order, matched by their names. Without any: those functions of the exercise that the
        caller has defined.
    words : str, optional
        The answer in words, where the exercise asks for one; once the functions are right, the model answer is shown
        beside it. It is not judged.
    language : {"en", "zh"}, optional
        The one asked for last unless given; at first that of the folder or of the environment.
    seed : int, optional
        Of the random cases; drawn anew unless given.
    time_limit : float
        Seconds for one call; 0 for none.
    level : {1, 2, 3}
        How much is told of a wrong answer: where it is wrong and what kind of slip it is; also which slip, or the line
        to look at; also what to write instead. What is told beyond 1 counts as hints in a folder with the exercise.

    Returns
    -------
    Checked
        Prints as the message; a notebook shows it as HTML.

    Raises
    ------
    NameNotFound
        If there is no such exercise, or it has no function of that name.
    CourseError
        If there is nothing to check, or no such level.

    Examples
    --------
    >>> def act(R, p, x):
    ...     return R @ x + p
    >>> check("49.0.2", act, language="en")
    49.0.2  act: right.
    <BLANKLINE>
    Section 49.0: ...●... of 5 exercises
    """
    return notebook.check(
        COURSE,
        number,
        *functions,
        words=words,
        language=language,
        seed=seed,
        time_limit=time_limit,
        level=level,
        caller=sys._getframe(1).f_globals,
    )


def case(name: str, number: int = 0, *, seed: int = 0) -> tuple[Any, ...]:
    """Return the arguments of one of the cases that an answer is tried on.

    Parameters
    ----------
    name : str
        Of the function, as in the skeletons.
    number : int
        Which case, counted from 0.
    seed : int
        Of the random numbers; the message about a wrong answer names it.

    Returns
    -------
    tuple
        The arguments.

    Raises
    ------
    NameNotFound
        If no exercise has a function of that name.
    CourseError
        If there are fewer cases.

    Examples
    --------
    >>> R, p, x = case("act", 3)
    >>> (R @ x + p).shape
    (3,)
    """
    return cases.case(COURSE, name, number, seed=seed)


def hint(
    name: str,
    folder: str | PathLike[str] = ".",
    *,
    again: bool = False,
    every: bool = False,
    language: Language | None = None,
) -> str:
    """Return the next hint for a function. Which were given is remembered in the folder.

    Of an answer that is wrong in the folder, or was when `check` looked at it last, the first hint says which slip it
    is, and the last what to write instead.

    Parameters
    ----------
    name : str
        Of the function; or the number of an exercise, as "49.3.1", for the first of its functions that is wrong, or
        else is not right yet.
    folder : str or path
        One that `start` has filled. In any other, which hints were given is remembered until Python ends, and only of
        what `check` has looked at; else each call returns the first.
    again : bool
        Repeat the last hint.
    every : bool
        All hints at once.
    language : {"en", "zh"}, optional
        The one that `check` was asked for last unless given; else that of the folder.

    Returns
    -------
    str

    Raises
    ------
    NameNotFound
        If there is no such exercise or function.

    Examples
    --------
    >>> print(hint("49.3.1", language="en").splitlines()[0])
    49.3.1 translation_transforms: hint 1 of 2
    """
    return helping.hint(COURSE, name, folder, again=again, every=every, language=language)


def solution(name: str, folder: str | PathLike[str] = ".", *, language: Language | None = None) -> str:
    """Return a solution of an exercise, as it could stand in the student's file.

    It includes the model answer to a question in words once the student has answered it. That it was shown is
    remembered in the folder.

    Parameters
    ----------
    name : str
        The number of the exercise, as "49.3.1", or the name of one of its functions.
    folder : str or path
        One that `start` has filled.
    language : {"en", "zh"}, optional
        The one that `check` was asked for last unless given; else that of the folder.

    Returns
    -------
    str

    Raises
    ------
    NameNotFound
        If there is no such exercise or function.

    Examples
    --------
    >>> print(solution("49.3.1", language="en").splitlines()[0])
    49.3.1 A pure translation: a solution
    """
    return helping.solution(COURSE, name, folder, language=language)


def status(
    folder: str | PathLike[str] = ".",
    *,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT_S,
) -> Status:
    """Check every exercise of a folder and return the progress.

    Parameters
    ----------
    folder : str or path
        One that `start` has filled.
    language : {"en", "zh"}, optional
        Of the table; that of the folder unless given.
    seed : int, optional
        Of the random cases; drawn anew unless given.
    time_limit : float
        Seconds for one call of a function; 0 for none. The answers run in a process of their own, which is ended where
        they take longer; without a limit they run in this one.

    Returns
    -------
    Status

    Raises
    ------
    CourseError
        If nothing was started there.
    """
    return progress.status(COURSE, folder, language=language, seed=seed, time_limit=time_limit)

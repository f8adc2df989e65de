"""The folders of a whole class, each judged by itself: points for each function, and what was used to get there."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from tqdm import tqdm

from ...errors import ModelError, check_known
from .. import catalogue
from ..exercise import Exercise
from ..folder.workbook import Workbook, has_started
from ..judge import Verdict
from ..processes.isolation import TIME_LIMIT, opened
from ..words.text import Language

__all__ = ["Graded", "Mark", "grade", "students"]


@dataclass(frozen=True)
class Mark:
    """The points of a student in one exercise.

    Attributes
    ----------
    exercise : str
        Its number.
    verdicts : dict
        From the name of each function to its verdict.
    words : str, optional
        The answer in words, to be read by the instructor; None where there is none.
    hints : int
        How many were asked for.
    solution : bool
        Whether the solution was shown.
    """

    exercise: str
    verdicts: dict[str, Verdict]
    words: str | None
    hints: int
    solution: bool

    @property
    def points(self) -> float:
        """The part of the functions that is right, from 0 to 1. Words are not in it."""
        return sum(verdict.state == "done" for verdict in self.verdicts.values()) / len(self.verdicts)


@dataclass(frozen=True)
class Graded:
    """The marks of one student.

    Attributes
    ----------
    student : str
        The name of the folder.
    marks : dict
        By the number of the exercise; empty where nothing was started in the folder.
    seconds : float
        That it took.
    """

    student: str
    marks: dict[str, Mark]
    seconds: float

    @property
    def points(self) -> float:
        """The sum over the exercises, a point each."""
        return sum(mark.points for mark in self.marks.values())


def grade(
    folders: Sequence[str | PathLike[str]],
    *,
    only: Sequence[str] = (),
    seed: int = 0,
    time_limit: float = TIME_LIMIT,
    jobs: int | None = None,
    language: Language = "en",
) -> list[Graded]:
    """Grade the folders of students. Each runs in processes of its own, so that none can disturb another.

    Parameters
    ----------
    folders : sequence of str or path
        Each of a student, or one that holds the folders of students.
    only : sequence of str
        Numbers of exercises, or of sections, as "49.6"; all unless given.
    seed : int
        Of the random cases, the same for all.
    time_limit : float
        Seconds for one call of a function.
    jobs : int, optional
        Folders at a time; one for each processor unless given.
    language : {"en", "zh"}
        Of the messages.

    Returns
    -------
    list of Graded
        In the order of the folders.

    Raises
    ------
    ModelError
        If there is nothing to grade.
    NameNotFound
        If there is no such exercise or section.
    """
    exercises, stopping = _chosen(only), threading.Event()

    def graded(folder: Path) -> Graded:
        start = time.perf_counter()
        with opened(folder, language=language, seed=seed, time_limit=time_limit, quiet=True) as book:
            marks = {e.id: _mark(book, e) for e in exercises if has_started(folder) and not stopping.is_set()}
        return Graded(folder.name, marks, time.perf_counter() - start)

    with ThreadPoolExecutor(jobs or os.cpu_count() or 1) as pool:
        try:
            every = students(folders)
            return list(tqdm(pool.map(graded, every), total=len(every), unit="folder", disable=None, leave=False))
        except BaseException:
            stopping.set()
            pool.shutdown(cancel_futures=True)
            raise


def students(folders: Sequence[str | PathLike[str]]) -> list[Path]:
    """Return the folders of students: those given, and for a folder of folders those in it."""
    found: list[Path] = []
    for folder in map(Path, folders):
        if not folder.is_dir():
            raise ModelError(f"{folder}: expected the folder of a student, or a folder of such folders")
        inside = [] if has_started(folder) else sorted(path for path in folder.iterdir() if path.is_dir())
        found += inside if any(map(has_started, inside)) else [folder.resolve()]
    return found


def _chosen(only: Sequence[str]) -> list[Exercise]:
    """Return the exercises of the given numbers and sections, in the chapter's order."""
    for number in only:
        check_known("exercise or section", number, (*catalogue.SECTIONS, *catalogue.available()))
    every = [catalogue.exercise(number) for number in catalogue.available()]
    return [e for e in every if not only or e.id in only or e.section in only]


def _mark(book: Workbook, exercise: Exercise) -> Mark:
    state: dict[str, Any] = book.state
    verdicts = {part.name: book.verdict(exercise, part) for part in exercise.parts}
    words = book.words(exercise) if exercise.answer is not None else None
    return Mark(
        exercise.id, verdicts, words, int(state["hints"].get(exercise.id, 0)), exercise.id in state["solutions"]
    )

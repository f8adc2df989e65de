"""The folders of a whole class, each judged by itself: points for each function, and what was used to get there."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from functools import partial
from os import PathLike
from pathlib import Path

from .calls import shown
from .checked import Checked
from .course import Course
from .errors import CourseError, check_known
from .exercise import Exercise
from .isolation import TIME_LIMIT_S, drawn, not_judged, opened
from .submissions import Submission, submissions
from .text import Language, Text
from .workbook import Workbook

__all__ = ["Graded", "grade"]


@dataclass(frozen=True)
class Graded:
    """The marks of one student.

    Attributes
    ----------
    student : str
        The name of the folder, or what stands before the names of the files.
    marks : dict
        By the number of the exercise; none where this is no student, but what was handed in without a name.
    seconds : float
        That it took.
    remarks : tuple of Text
        What an instructor should look at: files that are missing, or have another name.
    counted : bool
        Whether the hidden file was handed in that knows of hints and solutions.
    """

    student: str
    marks: dict[str, Checked]
    seconds: float
    remarks: tuple[Text, ...] = ()
    counted: bool = True

    @property
    def points(self) -> float:
        """The sum over the exercises, a point each."""
        return sum(mark.points for mark in self.marks.values())


def grade(
    course: Course,
    given: Sequence[str | PathLike[str]],
    *,
    only: Sequence[str] = (),
    seed: int = 0,
    time_limit: float = TIME_LIMIT_S,
    jobs: int | None = None,
    language: Language = "en",
    ended: Callable[[list[Graded], Graded, int], object] = lambda found, one, of: None,
) -> list[Graded]:
    """Grade what students have handed in. Each runs in processes of its own, so that none can disturb another.

    Parameters
    ----------
    course : Course
    given : sequence of str or path
        Folders or zips: each of a student, or with those of students in it.
    only : sequence of str
        Numbers of exercises, or of sections, as "49.6"; all unless given.
    seed : int
        Of the random cases, the same for all.
    time_limit : float
        Seconds for one call of a function.
    jobs : int, optional
        Students at a time; one for each processor unless given.
    language : {"en", "zh"}
        Of the messages.
    ended : callable
        Called whenever a student is done: with all that are done, in their order, with this one, and with the number
        of all students.

    Returns
    -------
    list of Graded
        In the order of the folders.

    Raises
    ------
    CourseError
        If there is nothing to grade, or a number is negative.
    UnknownName
        If there is no such exercise or section.
    """
    if jobs is not None and jobs < 1:
        raise CourseError(f"jobs: expected a whole number, 1 or more, got {jobs}")
    only = [course.dotted(number) for number in only]
    for number in only:
        check_known("exercise or section", number, (*course.sections, *course.numbers), course.unknown)
    exercises = [e for e in course.exercises if not only or e.id in only or e.section in only]
    sections = list(dict.fromkeys(exercise.section for exercise in exercises))
    reader = partial(opened, course, language=language, seed=drawn(seed), time_limit=time_limit, printed=None)
    books: list[Workbook] = []

    def graded(one: Submission) -> Graded:
        if not one.of_student:
            return Graded(one.student, {}, 0.0, one.remarks)
        start = time.perf_counter()
        with reader(one.folder, files=one.files) as book:
            books.append(book)
            marks = {exercise.id: _mark(book, exercise) for exercise in exercises}
        counted = (one.folder / course.state_file).is_file()
        return Graded(one.student, marks, time.perf_counter() - start, one.remarks, counted)

    with (
        tempfile.TemporaryDirectory(prefix="misstep-", ignore_cleanup_errors=True) as room,
        ThreadPoolExecutor(jobs or os.cpu_count() or 1) as pool,
    ):
        found: dict[int, Graded] = {}
        every = submissions(course, given, Path(room), sections)
        running = {pool.submit(graded, one): k for k, one in enumerate(every)}
        try:
            for done in as_completed(running):
                found[running[done]] = done.result()
                ended([found[k] for k in sorted(found)], done.result(), len(every))
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for book in books:
                book.close()
            raise
    return [found[k] for k in sorted(found)]


def _mark(book: Workbook, exercise: Exercise) -> Checked:
    """Judge an exercise; where the check fails on it, its functions have no points, and the reason."""
    try:
        return book.checked(exercise)
    except Exception as error:
        verdicts = {part.name: not_judged(exercise, part, shown(error)) for part in exercise.parts}
        return Checked(exercise, verdicts, None, book.language)

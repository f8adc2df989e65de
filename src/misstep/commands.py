"""The command line of a course: ``start | status | case | hint | solution | list | grade``."""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from importlib.util import find_spec
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from .files import check_writable, write_text
from .text import Language, Text, default_language

if TYPE_CHECKING:
    from .course import Course
    from .grading import Graded

__all__ = ["at_least", "register"]

REFUSED = 1
Number = TypeVar("Number", int, float)
ASK = Text("Show the solution of {id}? A hint may be enough. [y/N] ", "显示 {id} 的解答？也许一条提示就够了。[y/N] ")
UNASKED = Text("With --yes; a hint first? {command} hint {id}", "加上 --yes；要不要先看提示？{command} hint {id}")
NO_PYTEST = Text("pytest is not installed here: pip install pytest", "此处没有安装 pytest：pip install pytest")
KINDS = {
    "code": Text("code", "编程"),
    "number": Text("number", "计算"),
    "explain": Text("explain", "解释"),
    "prove": Text("prove", "证明"),
}


def at_least(least: int) -> Callable[[str], int]:
    """Return a parser of whole numbers that are not below `least`."""
    return lambda text: _read(int, text, least, f"expected a whole number, {least} or more, got {text!r}")


def _seconds(text: str) -> float:
    return _read(float, text, 0.0, f"expected a number of seconds, 0 or more, got {text!r}")


def _read(kind: Callable[[str], Number], text: str, least: Number, expected: str) -> Number:
    """Read a finite number that is not below another one."""
    try:
        value = kind(text)
    except ValueError:
        raise argparse.ArgumentTypeError(expected) from None
    if not least <= value < inf:
        raise argparse.ArgumentTypeError(expected)
    return value


def register(parser: Any, course: str) -> Any:
    """Add the commands of a course to a parser, and return what adds more; the course is read when it is needed."""
    parser.set_defaults(course=course)
    actions = parser.add_subparsers(required=True, metavar="ACTION")

    def action(run: Callable[[argparse.Namespace], int], help: str) -> Any:
        added = actions.add_parser(run.__name__.removeprefix("run_"), help=help)
        added.add_argument("--language", choices=["en", "zh"], help="remembered in the folder: English or 简体中文")
        added.set_defaults(run=run)
        return added.add_argument

    add = action(run_start, "write the skeletons into DIR; what is there stays as it is")
    add("dir", metavar="DIR", help="a folder for your answers, made if need be, such as `answers`")
    add("--no-cure", dest="cure", action="store_false", help="messages never say what to write instead")
    add = action(run_status, "check all answers and show the progress by section")
    add("dir", nargs="?", default=".", metavar="DIR")
    add("--time-limit", type=_seconds, metavar="S", help="seconds for one call of a function; 0 for none (10)")
    add("--seed", type=at_least(0), metavar="N", help="of the random cases; drawn anew unless given")
    add = action(run_case, "the arguments of a case, and the right answer")
    add("name", metavar="FUNCTION", help="as in the skeletons")
    add("number", type=int, nargs="?", default=0, metavar="K", help="which case, counted from 0 (0)")
    add("--seed", type=at_least(0), default=0, metavar="N", help="of the random cases (0)")
    add_hint = action(run_hint, "the next hint for a function; of a wrong answer, which slip it is")
    add_solution = action(run_solution, "a solution of an exercise")
    for add in (add_hint, add_solution):
        add("id", metavar="ID", help="as 49.3.1, or the name of a function")
        add("--dir", default=".", metavar="DIR", help="where the exercises are (here)")
    add_hint("--all", action="store_true", help="all hints")
    add_hint("--again", action="store_true", help="the last hint again")
    add_solution("--yes", action="store_true", help="do not ask whether you are sure")
    action(run_list, "all exercises")
    add = action(run_grade, "for instructors: the folders of a whole class, each by itself")
    add("folders", nargs="+", metavar="FOLDER", help="or zip: of a student, or with those of students in it")
    add("--only", nargs="+", default=[], metavar="ID", help="exercises or sections: 49.6 49.7.1 (all)")
    add("--csv", metavar="FILE", help="a row for each function of each student")
    add("--html", metavar="FILE", help="a page: points, messages, words beside the model answer")
    add("--seed", type=at_least(0), metavar="N", help="of the random cases, the same for all; else drawn")
    add("--timeout", type=_seconds, metavar="S", help="seconds for one call of a function (10)")
    add("--jobs", type=at_least(1), metavar="N", help="folders at a time (one for each processor)")
    return actions


# ---------------------------------------------------------------- what each does; it imports what it needs


def _course(args: argparse.Namespace) -> Course:
    course: Course = import_module(args.course).COURSE
    return course


def _language(args: argparse.Namespace, folder: str = ".") -> Language:
    """Return the language that is asked for, and remember it where the exercises are; else the one asked for before."""
    from .workbook import Workbook

    book = Workbook(_course(args), folder, language=args.language)
    if args.language and book.is_started:
        with suppress(OSError):  # a folder may be for reading only
            book.remember(language=args.language)
    return book.language


def run_start(args: argparse.Namespace) -> int:
    """Write the skeletons."""
    from .skeletons import start

    new, kept = start(_course(args), args.dir, language=args.language, cure=args.cure)
    language = _language(args, args.dir)
    for label, paths in ((Text("new", "新增"), new), (Text("kept as it is", "保持不变"), kept)):
        for path in paths:
            print(f"{path}: {label.of(language)}")
    print(f"\ncd {shlex.quote(args.dir)} && python -m pytest")
    if find_spec("pytest") is None:
        print(NO_PYTEST.of(language))
    return 0


def run_status(args: argparse.Namespace) -> int:
    """Print the progress; exit status 1 where an answer is wrong."""
    from .isolation import TIME_LIMIT_S
    from .progress import status

    limit = TIME_LIMIT_S if args.time_limit is None else args.time_limit
    found = status(_course(args), args.dir, language=_language(args, args.dir), seed=args.seed, time_limit=limit)
    print(found)
    return REFUSED if any(row.count("wrong") for row in found.rows) else 0


def run_case(args: argparse.Namespace) -> int:
    """Print a case in full: what goes in, and what must come out."""
    from .cases import case
    from .verdict import whole

    course = _course(args)
    print(whole(course.find_part(args.name)[1], case(course, args.name, args.number, seed=args.seed), _language(args)))
    return 0


def run_hint(args: argparse.Namespace) -> int:
    """Print a hint."""
    from .helping import hint

    print(hint(_course(args), args.id, args.dir, again=args.again, every=args.all, language=_language(args, args.dir)))
    return 0


def run_solution(args: argparse.Namespace) -> int:
    """Print a solution, once the student is sure; where stdin is not a terminal, print how to skip the question."""
    from .helping import solution

    course, language = _course(args), _language(args, args.dir)
    number = course.asked_for(args.id).id
    if not args.yes and not sys.stdin.isatty():
        print(UNASKED.fill(id=number, command=course.command).of(language))
        return REFUSED
    if not args.yes and input(ASK.fill(id=number).of(language)).strip().lower() not in ("y", "yes", "是"):
        return REFUSED
    print(solution(course, number, args.dir, language=language))
    return 0


def run_list(args: argparse.Namespace) -> int:
    """Print number, kind and title of every exercise."""
    language = _language(args)
    for exercise in _course(args).exercises:
        print(f"{exercise.id:10} {KINDS[exercise.kind].of(language):8} {exercise.title.of(language)}")
    return 0


def run_grade(args: argparse.Namespace) -> int:
    """Grade folders, print a table, and write what is asked for: the CSV after each student, the page at the end."""
    from .grading import grade
    from .isolation import TIME_LIMIT_S, drawn
    from .sheets import as_csv, as_html, as_table

    seed, language = drawn(args.seed), args.language or default_language()
    for option in ("csv", "html"):
        path = getattr(args, option)
        check_writable(f"--{option}", None if path is None else Path(path))
    so_far: list[Graded] = []

    def ended(found: list[Graded], one: Graded, of: int) -> None:
        so_far[:] = found
        counts = f"{one.points:.2f} / {len(one.marks)}" if one.marks else "!"
        print(f"{len(found)}/{of}  {one.student}  {counts}  {one.seconds:.0f} s", file=sys.stderr, flush=True)
        if args.csv is not None:
            write_text(args.csv, as_csv(found, seed, language))

    how = {"only": args.only, "seed": seed, "time_limit": args.timeout or TIME_LIMIT_S, "jobs": args.jobs}
    try:
        grade(_course(args), args.folders, language=language, ended=ended, **how)
    finally:
        if args.html is not None and so_far:
            write_text(args.html, as_html(so_far, seed, language))
    print(as_table(so_far, seed, language))
    return 0

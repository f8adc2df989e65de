"""The command line of a course: ``start | status | case | hint | solution | list | grade``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .files import check_writable, write_text
from .text import Language, Text

if TYPE_CHECKING:
    from .course import Course

__all__ = ["at_least", "register"]

REFUSED = 1

ASK = Text("Show the solution of {id}? A hint may be enough. [y/N] ", "显示 {id} 的解答？也许一条提示就够了。[y/N] ")
UNASKED = Text(
    "The solution of {id} is shown with --yes; a hint first? {command} hint {id}",
    "加上 --yes 即显示 {id} 的解答；要不要先看提示？{command} hint {id}",
)
NO_PYTEST = Text("pytest is not installed here: pip install pytest", "此处没有安装 pytest：pip install pytest")


def at_least(least: int) -> Callable[[str], int]:
    """Return a parser of whole numbers that are not below `least`."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = least - 1
        if value < least:
            raise argparse.ArgumentTypeError(f"expected a whole number, {least} or more, got {text!r}")
        return value

    return read


def register(parser: Any, course: str) -> None:
    """Add the commands of a course to a parser; the module that holds it is read when it is needed."""
    parser.set_defaults(course=course)
    actions = parser.add_subparsers(required=True, metavar="ACTION")
    start = _action(actions, "start", "write the skeletons into DIR; what is there stays as it is", run_start)
    start.add_argument("dir", metavar="DIR", help="a folder for your answers, made if need be, such as `answers`")
    status = _action(actions, "status", "check all answers and show the progress by section", run_status)
    status.add_argument("dir", nargs="?", default=".", metavar="DIR")
    status.add_argument(
        "--time-limit", type=_seconds, metavar="S", help="seconds for one call of a function; 0 for none (10)"
    )
    status.add_argument("--seed", type=at_least(0), metavar="N", help="of the random cases; drawn anew unless given")
    case = _action(actions, "case", "the arguments of a case, and the right answer", run_case)
    case.add_argument("name", metavar="FUNCTION", help="as in the skeletons")
    case.add_argument("number", type=int, nargs="?", default=0, metavar="K", help="which case, counted from 0 (0)")
    case.add_argument("--seed", type=at_least(0), default=0, metavar="N", help="of the random cases (0)")
    hint = _action(actions, "hint", "the next hint for an exercise", run_hint)
    solution = _action(actions, "solution", "a solution of an exercise", run_solution)
    for asked in (hint, solution):
        asked.add_argument("id", metavar="ID", help="as 49.3.1, or the name of a function")
        asked.add_argument("--dir", default=".", metavar="DIR", help="where the exercises are (here)")
    hint.add_argument("--all", action="store_true", help="all hints")
    hint.add_argument("--again", action="store_true", help="the last hint again")
    solution.add_argument("--yes", action="store_true", help="do not ask whether you are sure")
    _action(actions, "list", "all exercises", run_list)
    _add_grade(_action(actions, "grade", "for instructors: the folders of a whole class, each by itself", run_grade))


def _add_grade(grade: Any) -> None:
    grade.add_argument(
        "folders", nargs="+", metavar="FOLDER", help="or zip: of a student, or with those of students in it"
    )
    grade.add_argument("--only", nargs="+", default=[], metavar="ID", help="exercises or sections: 49.6 49.7.1 (all)")
    grade.add_argument("--csv", metavar="FILE", help="a row for each function of each student")
    grade.add_argument("--html", metavar="FILE", help="a page: points, messages, words beside the model answer")
    grade.add_argument("--junit", metavar="FILE", help="a test suite for each student")
    grade.add_argument(
        "--seed", type=at_least(0), metavar="N", help="of the random cases, the same for all; else drawn"
    )
    grade.add_argument("--timeout", type=_seconds, metavar="S", help="seconds for one call of a function (10)")
    grade.add_argument("--jobs", type=at_least(1), metavar="N", help="folders at a time (one for each processor)")


def _action(actions: Any, name: str, help: str, run: Any) -> Any:
    parser = actions.add_parser(name, help=help)
    parser.add_argument("--language", choices=["en", "zh"], help="remembered in the folder: English or 简体中文")
    parser.set_defaults(run=run)
    return parser


def _course(args: argparse.Namespace) -> Course:
    course: Course = import_module(args.course).COURSE
    return course


def _seconds(text: str) -> float:
    """Read a number of seconds."""
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0 <= seconds < 1e6:
        raise argparse.ArgumentTypeError(f"expected a number of seconds, 0 or more, got {text!r}")
    return seconds


def _language(args: argparse.Namespace, folder: str = ".") -> Language:
    """Return the language that is asked for, and remember it where the exercises are; else the one asked for before."""
    from .folder.workbook import Workbook, has_started

    book = Workbook(_course(args), folder, language=args.language)
    if args.language and has_started(book.course, book.folder):
        with suppress(OSError):  # a folder may be for reading only
            book.remember(language=args.language)
    return book.language


def run_start(args: argparse.Namespace) -> int:
    """Write the skeletons."""
    import shlex
    from importlib.util import find_spec

    from .folder.skeletons import start

    new, kept = start(_course(args), args.dir, language=args.language)
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
    from .processes.isolation import TIME_LIMIT
    from .progress import status

    limit = TIME_LIMIT if args.time_limit is None else args.time_limit
    found = status(_course(args), args.dir, language=_language(args, args.dir), seed=args.seed, time_limit=limit)
    print(found)
    return REFUSED if any(row.count("wrong") for row in found.rows) else 0


def run_case(args: argparse.Namespace) -> int:
    """Print a case in full: what goes in, and what must come out."""
    from .cases import case
    from .failing import whole

    _, part = _course(args).find_part(args.name)
    print(whole(part, case(_course(args), args.name, args.number, seed=args.seed), _language(args)))
    return 0


def run_hint(args: argparse.Namespace) -> int:
    """Print a hint."""
    from .helping import hint

    print(hint(_course(args), args.id, args.dir, again=args.again, every=args.all, language=_language(args, args.dir)))
    return 0


def run_solution(args: argparse.Namespace) -> int:
    """Print a solution, once the student is sure."""
    from .helping import solution

    number, language = _course(args).asked_for(args.id).id, _language(args, args.dir)
    if not args.yes and not _sure(_course(args), number, language):
        return REFUSED
    print(solution(_course(args), number, args.dir, language=language))
    return 0


def _sure(course: Course, number: str, language: Language) -> bool:
    """Ask; where stdin is not a terminal, print how to skip the question."""
    if not sys.stdin.isatty():
        print(UNASKED.fill(id=number, command=course.command).of(language))
        return False
    return input(ASK.fill(id=number).of(language)).strip().lower() in ("y", "yes", "是")


def run_grade(args: argparse.Namespace) -> int:
    """Grade folders, print a table, and write what is asked for: the CSV after each student, the others at the end."""
    from .grading.grading import Graded, grade
    from .grading.sheets import as_csv, as_html, as_junit, as_table
    from .processes.isolation import TIME_LIMIT, drawn
    from .text import default_language

    seed, language = drawn(args.seed), args.language or default_language()
    for option in ("csv", "html", "junit"):
        path = getattr(args, option)
        check_writable(f"--{option}", None if path is None else Path(path))
    so_far: list[Graded] = []

    def ended(found: list[Graded], one: Graded, of: int) -> None:
        so_far[:] = found
        counts = f"{one.points:.2f} / {len(one.marks)}"
        print(f"{len(found)}/{of}  {one.student}  {counts}  {one.seconds:.0f} s", file=sys.stderr, flush=True)
        if args.csv is not None:
            write_text(args.csv, as_csv(found, seed, language))

    how = {"only": args.only, "seed": seed, "time_limit": args.timeout or TIME_LIMIT, "jobs": args.jobs}
    try:
        grade(_course(args), args.folders, language=language, ended=ended, **how)
    finally:
        for path, made in ((args.html, as_html), (args.junit, as_junit)):
            if path is not None and so_far:
                write_text(path, made(so_far, seed, language))
    print(as_table(so_far, seed, language))
    return 0


def run_list(args: argparse.Namespace) -> int:
    """Print number, kind and title of every exercise."""
    from .messages import message

    language = _language(args)
    for exercise in _course(args).exercises:
        print(f"{exercise.id:10} {message(exercise.kind).of(language):8} {exercise.title.of(language)}")
    return 0

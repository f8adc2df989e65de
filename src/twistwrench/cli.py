"""The command line: ``twistwrench validate``, ``robots``, ``view``, ``advise``, ``exercises``.

A command is a function that adds its parser; it names in ``set_defaults(run=...)`` what does the work
and returns the exit status. It imports there what it needs, so that ``--help`` is quick.
"""

from __future__ import annotations

import argparse
import errno
import io
import json
import os
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import twistwrench as tw
from misstep.errors import CourseError

from .advice import add_advise
from .errors import ModelError, NameNotFound, SingularError
from .exercises.commands import register as add_exercises
from .files import write_text
from .options import at_least, check_writable
from .stopping import EXIT_SIGINT, EXIT_SIGPIPE, Stopped, handle_signals
from .viewing.commands import register as add_view

if TYPE_CHECKING:
    from .validate import Report
    from .validate.sweep import Outcome

__all__ = ["COMMANDS", "main"]

Commands = Any
"""What ``add_subparsers`` returns; argparse has no public name for it."""

FAILED, MISUSED = 1, 2


def main(
    argv: Sequence[str] | None = None,
    *,
    program: str = "twistwrench",
    commands: Sequence[Callable[[Commands], None]] | None = None,
) -> int:
    """Run the command line.

    Parameters
    ----------
    argv : sequence of str, optional
        The arguments; those of the process unless given.
    program : str
        Its name in the help.
    commands : sequence of callable, optional
        Each adds the parser of a command; `COMMANDS` unless given.

    Returns
    -------
    int
        0; 1 where a check failed; 2 where the command cannot be carried out; where it was stopped, 128 and the
        number of the signal: 130 by Ctrl-C, 143 by SIGTERM, 141 where nobody reads what it prints.

    Examples
    --------
    >>> main(["robots", "--source", "models"])
    name             dof  base      source  licence       note
    cart_pole        2    fixed     models  BSD-3-Clause
    ...
    0
    """
    parser = argparse.ArgumentParser(prog=program, description="Spatial vector algebra and robot dynamics.")
    parser.add_argument("--version", action="version", version=f"%(prog)s {tw.__version__}")
    parsers = parser.add_subparsers(required=True, metavar="COMMAND")
    for add in COMMANDS if commands is None else commands:
        add(parsers)
    if not (sys.argv[1:] if argv is None else argv):
        parser.print_help(sys.stderr)
        parser.exit(MISUSED)
    args = parser.parse_args(argv)
    if isinstance(sys.stdout, io.TextIOWrapper):  # a letter that a terminal or a file lacks is shown by its number
        sys.stdout.reconfigure(errors="backslashreplace", line_buffering=True)
    try:
        with handle_signals():
            status = int(args.run(args))
            sys.stdout.flush()
        return status
    except BrokenPipeError:  # the reader has closed the pipe, as in `twistwrench robots | head`
        return _discard_output(EXIT_SIGPIPE)
    except Stopped as stopped:
        return _discard_output(EXIT_SIGPIPE) if stopped.status == EXIT_SIGPIPE else stopped.status
    except KeyboardInterrupt:
        return EXIT_SIGINT
    except (NameNotFound, ModelError, SingularError, CourseError, ImportError, OSError) as error:
        print(f"twistwrench: {_said(error)}", file=sys.stderr)
        return _discard_output(MISUSED) if _is_of_stdout(error) else MISUSED


def _discard_output(status: int) -> int:
    """Discard what is still to be printed, and return an exit status."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return status


def _is_of_stdout(error: Exception) -> bool:
    """Whether stdout leads to a full disk: whatever else writes names its file."""
    return isinstance(error, OSError) and error.errno == errno.ENOSPC and error.filename is None


def _said(error: Exception) -> str:
    """Return the message; of a bare import that failed, how to install the package."""
    if _is_of_stdout(error):
        return "what is printed goes to a file on a full disk"
    if isinstance(error, ModuleNotFoundError) and error.name == "matplotlib":
        from .plot.style import NO_MATPLOTLIB

        return NO_MATPLOTLIB
    if isinstance(error, ModuleNotFoundError) and error.name == "mpmath":
        from .advice import NO_MPMATH

        return NO_MPMATH
    return str(error)


# -------------------------------------------------------------------- robots


def add_robots(commands: Commands) -> None:
    """Add ``twistwrench robots``."""
    parser = commands.add_parser("robots", help="list the robots that can be loaded by name")
    parser.add_argument("--source", choices=["models", "example-robot-data"], help="only those that come with it")
    parser.set_defaults(run=run_robots)


def run_robots(args: argparse.Namespace) -> int:
    """Print the catalogue."""
    from .loading import Catalogue, robots

    print(Catalogue(robot for robot in robots() if args.source in (None, robot.source)))
    return 0


# -------------------------------------------------------------------- validate


def add_validate(commands: Commands) -> None:
    """Add ``twistwrench validate``."""
    parser = commands.add_parser(
        "validate",
        help="hold every quantity against Pinocchio and the 50-digit truth",
        description="Hold every quantity of the chapter against Pinocchio and against the truth in 50 digits, at "
        "random states, and print a row for each. Exit status 1 where a row is outside its bound.",
    )
    what = parser.add_mutually_exclusive_group()
    what.add_argument("robot", nargs="*", default=[], metavar="ROBOT", help="a name of `twistwrench robots` or a URDF")
    what.add_argument("--all", action="store_true", help="every robot on a fixed and on a floating base, a line each")
    parser.add_argument("--base", choices=["fixed", "floating"], help="the base, if not the robot's own (--all: both)")
    parser.add_argument("--fast", action="store_true", help="hold what tw.fast computes: the rows that it has")
    parser.add_argument("--states", type=at_least(1), default=8, metavar="N", help="random states (8)")
    parser.add_argument("--truths", type=at_least(1), metavar="N", help="states with the truth computed (3; --all: 1)")
    parser.add_argument("--seed", type=at_least(0), default=0, metavar="N", help="of the random states (0)")
    parser.add_argument("--json", metavar="FILE", help="write the results as JSON; - for stdout, without the table")
    parser.add_argument("--jobs", type=at_least(1), metavar="N", help="processes for --all (as many as processors)")
    parser.add_argument(
        "--progress", action="store_true", help="a progress bar on stderr, also where that is not a terminal"
    )
    parser.set_defaults(run=run_validate, misuse=parser.error)


def run_validate(args: argparse.Namespace) -> int:
    """Validate, print and write."""
    _check_options(args)
    start, outcomes = time.perf_counter(), list[Any]()
    try:
        (_validate_all if args.all else _validate_some)(args, outcomes)
    except (KeyboardInterrupt, BrokenPipeError):
        if outcomes and args.json not in (
            None,
            "-",
        ):  # an old file of a whole run is worth more than a part of a new one
            part = f"{args.json}.part"
            write_text(part, _as_json(outcomes, start, interrupted=True) + "\n")
            print(f"\ntwistwrench: stopped; what was finished is in {part}", file=sys.stderr)
        raise
    if args.json is not None:
        text = _as_json(outcomes, start, ascii_only=args.json == "-")
        print(text) if args.json == "-" else write_text(args.json, text + "\n")
    return 0 if all(outcome.passed for outcome in outcomes) else FAILED


def _as_json(outcomes: Sequence[Any], start: float, *, ascii_only: bool = False, interrupted: bool = False) -> str:
    """Return what was found, reports or outcomes of a sweep, as JSON."""
    found: dict[str, Any] = {"passed": not interrupted and all(outcome.passed for outcome in outcomes)}
    found |= {"interrupted": True} if interrupted else {}
    found["seconds"] = round(time.perf_counter() - start, 3)
    found["reports"] = [outcome.as_dict() for outcome in outcomes]
    return json.dumps(found, indent=2, ensure_ascii=ascii_only, allow_nan=False)


def _validate_some(args: argparse.Namespace, reports: list[Report]) -> None:
    """Validate the robots that are named, a table each; gather the reports."""
    from .validate import validate

    for name in args.robot or ["go2"]:
        report = validate(
            name,
            base=args.base,
            states=args.states,
            truths=args.truths or 3,
            rng=args.seed,
            fast=args.fast,
            progress=_shows_bar(args),
        )
        reports.append(report)
        if args.json != "-":
            print("\n" * (len(reports) > 1) + str(report))


def _validate_all(args: argparse.Namespace, outcomes: list[Outcome]) -> None:
    """Validate the whole catalogue, a line each; gather the outcomes."""
    from tqdm import tqdm

    from .validate import sweep

    start, which = time.perf_counter(), sweep.every_robot(args.base)
    say: Callable[[str], None] = tqdm.write if args.json != "-" else lambda text: None  # stdout is for the JSON
    say(sweep.header())
    found = sweep.sweep(
        which, jobs=args.jobs, states=args.states, truths=args.truths or 1, seed=args.seed, fast=args.fast
    )
    with closing(found):
        for outcome in tqdm(found, total=len(which), unit="robot", disable=not _shows_bar(args), leave=False):
            outcomes.append(outcome)
            say(sweep.line(outcome))
    say("\n" + sweep.summary(outcomes, time.perf_counter() - start))


def _check_options(args: argparse.Namespace) -> None:
    """Raise, before any work, for options that would have no effect or fail at the end."""
    if args.jobs and not args.all:
        args.misuse("argument --jobs: only with --all")
    if args.truths and args.truths > args.states:
        args.misuse(f"argument --truths: expected at most the number of states, {args.states}, got {args.truths}")
    if args.all and not (find_spec("pinocchio") or find_spec("mpmath")):
        from .validate.run import NOTHING_TO_COMPARE_WITH

        raise ImportError(NOTHING_TO_COMPARE_WITH)
    if args.json != "-":
        check_writable("--json", None if args.json is None else Path(args.json))
    for name in args.robot[1:]:  # --jobs is checked at once
        tw.load(name, base=args.base, physical=False, mimic="independent")


def _shows_bar(args: argparse.Namespace) -> bool:
    return args.progress or sys.stderr.isatty()


COMMANDS: tuple[Callable[[Commands], None], ...] = (
    add_validate,
    add_robots,
    add_view,
    add_advise,
    add_exercises,
)

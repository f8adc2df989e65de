"""``python -m benchmarks.study extremes``."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

from twistwrench.files import write_text
from twistwrench.options import at_least, check_writable

__all__ = ["add_extremes"]

FAILED = 1

STATES = 100
"""States of each cell in which programs are compared with the textbook."""


def add_extremes(studies: Any) -> None:
    """Add ``python -m benchmarks.study extremes``."""
    parser = studies.add_parser(
        "extremes",
        help="where digits are lost: one thing at its limit at a time, and every two of them",
        description="Compare every algorithm with a reference in 50 digits where robots and states are extreme, "
        "and count the digits kept. Exit status 1 where a way of ours gives a NaN, a warning, or a number where "
        "none is right.",
    )
    parser.add_argument("--full", action="store_true", help="all ends of all pairs, and robots of 1000 bodies")
    parser.add_argument(
        "--longest",
        type=at_least(1),
        metavar="N",
        help="leave out robots of more bodies: the two of 1000 take as long as all others",
    )
    parser.add_argument(
        "--cells",
        metavar="FILE",
        help="where each cell is kept as it is done; a study goes on from there (extremes.jsonl)",
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write what was counted as JSON")
    parser.add_argument("--pictures", type=Path, metavar="FOLDER", help="draw the map of every algorithm into a folder")
    parser.add_argument(
        "--angles", type=_count, default=10_000, metavar="N", help="of exp and log; 0 leaves them out (10000)"
    )
    parser.add_argument(
        "--bounds", action="store_true", help="instead: whether the bounds of compiled programs hold; half an hour"
    )
    parser.add_argument(
        "--programs",
        action="store_true",
        help=f"instead: whether programs round worse than the textbook, in {STATES} states a cell; ten minutes",
    )
    parser.add_argument(
        "--progress", action="store_true", help="a progress bar on stderr, also where that is not a terminal"
    )
    parser.set_defaults(run=run_extremes)


def _count(text: str) -> int:
    """Read how many angles: none, or one near 0 and one near π at least."""
    if not text.isdecimal() or text == "1":
        raise argparse.ArgumentTypeError(f"expected 0, or a whole number from 2, got {text!r}")
    return int(text)


def run_extremes(args: argparse.Namespace) -> int:
    """Measure, print, write and draw."""
    from . import report
    from .grid import cells
    from .rotations import rotations
    from .run import run

    check_writable("--json", args.json)
    if args.bounds:
        return _run_bounds(args)
    if args.programs:
        return _run_programs(args)
    if args.pictures is not None:
        args.pictures.mkdir(parents=True, exist_ok=True)
    kept = Path(args.cells or "extremes.jsonl") if args.full or args.cells else None
    bar = args.progress or sys.stderr.isatty()
    recipes = [recipe for recipe in cells(full=args.full) if args.longest is None or recipe.bodies <= args.longest]
    found = run(recipes, kept, pinocchio=_pinocchio(), progress=bar)
    print(report.table(found))
    turns = rotations(args.angles, progress=bar) if args.angles else []
    print("\n".join(["", *report.turns(turns)]) if turns else "", end="\n" if turns else "")
    if args.json is not None:
        _write(args.json, report.as_dict(found) | {"exp and log": [turn._asdict() for turn in turns]})
    if args.pictures is not None:
        from .picture import save

        print("\n".join(str(path) for path in save(found, args.pictures)))
    wrong = report.bad(found)
    for cell, outcome in wrong:
        print(f"{cell}: {outcome.algorithm} by {outcome.who}: {outcome.bad}", file=sys.stderr)
    return FAILED if wrong else 0


def _run_bounds(args: argparse.Namespace) -> int:
    """Measure the bounds of compiled programs, print and write."""
    from tqdm import tqdm

    from .bounds import LONGEST, bounds, measured, table
    from .grid import cells

    recipes = [recipe for recipe in cells(full=args.full) if recipe.bodies <= LONGEST]
    bar = tqdm(recipes, "bounds", unit="cell", disable=not (args.progress or sys.stderr.isatty()))
    found = bounds(one for recipe in bar for one in measured(recipe))
    print(table(found))
    if args.json is not None:
        _write(args.json, {"cells": len(recipes), "bounds": [asdict(bound) for bound in found]})
    return FAILED if any(bound.broken for bound in found) else 0


def _run_programs(args: argparse.Namespace) -> int:
    """Compare the errors of programs with the textbook's, print and write."""
    from tqdm import tqdm

    from .grid import cells
    from .programs import LONGEST, compared, counts, medians, table

    recipes = [recipe for recipe in cells(full=args.full) if recipe.bodies <= LONGEST]
    bar = tqdm(recipes, "programs", unit="cell", disable=not (args.progress or sys.stderr.isatty()))
    every = [one for recipe in bar for one in compared(recipe, STATES)]
    found = counts(every)
    print(table(found))
    if args.json is not None:
        _write(args.json, {"states": STATES, "counts": [asdict(count) for count in found], "cells": medians(every)})
    return 0


def _pinocchio() -> bool:
    """Whether Pinocchio is installed; the study is worth running without."""
    from twistwrench.bridge import import_pinocchio

    try:
        import_pinocchio()
    except ImportError as error:
        print(f"{error}: it has no column", file=sys.stderr)
        return False
    return True


def _write(path: Path, found: dict[str, Any]) -> None:
    write_text(path, json.dumps(found, indent=1, ensure_ascii=False, allow_nan=False) + "\n")

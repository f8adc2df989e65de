"""``python -m benchmarks.study budget``: the table, the picture and the file of results."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import twistwrench as tw
from twistwrench.files import write_text
from twistwrench.motions import MOTIONS
from twistwrench.options import check_writable
from twistwrench.tables import text_table

from ..trade.picture import check_format
from . import Source, budget

__all__ = ["add_budget"]

STEP = 1e-3
"""Seconds between two states of the motion, which is also the step of Euler's method."""


def add_budget(studies: Any) -> None:
    """Add ``python -m benchmarks.study budget``."""
    parser = studies.add_parser(
        "budget",
        help="every source of error of a motion on one scale: N m and mm",
        description="Put rounding, time steps, simpler models, wrong masses and slips of convention, each alone, into "
        "one motion, and show what each costs at the worst motor and at the centre of pressure.",
    )
    parser.add_argument("robot", nargs="?", default="go2", metavar="ROBOT", help="(go2)")
    parser.add_argument("--motion", choices=MOTIONS, default="trot", help="(trot)")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="draw it: a png, svg or pdf")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers")
    parser.set_defaults(run=run_budget)


def run_budget(args: argparse.Namespace) -> int:
    """Print the table, and write what is asked for."""
    if args.plot is not None:
        check_format(args.plot)
    for option, path in (("--plot", args.plot), ("--json", args.json)):
        check_writable(option, path)
    model = tw.load(args.robot)
    motion = MOTIONS[args.motion](model, samples=2)  # of its duration
    motion = MOTIONS[args.motion](model, samples=1 + round((motion.t[-1] - motion.t[0]) / STEP))
    found = list(budget(model, motion))
    print(f"{args.robot}, {motion!r}: the error of each source alone, where it is worst")
    print(text_table(("", "source", "torque, N m", "at", "pressure, mm"), [_cells(source) for source in found]))
    if args.json is not None:
        made = {"robot": args.robot, "motion": args.motion, "sources": [source._asdict() for source in found]}
        write_text(args.json, json.dumps(made, indent=1, ensure_ascii=False) + "\n")
    if args.plot is not None:
        from .picture import draw

        draw(found, args.plot, title=f"{args.robot}, {args.motion}: what each source of error costs at worst")
    return 0


def _cells(source: Source) -> tuple[str, ...]:
    return source.kind, source.name, f"{source.torque:.1e}", source.joint, f"{source.pressure:.1e}"

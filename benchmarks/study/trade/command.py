"""``python -m benchmarks.study trade``: the time of every way of computing a quantity, and how many digits it keeps."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from twistwrench.files import write_text
from twistwrench.options import at_least, check_writable

from .report import Trade
from .run import FULL, KEYS, SHORT, weigh

__all__ = ["add_trade"]


def add_trade(studies: Any) -> None:
    """Add ``python -m benchmarks.study trade``."""
    parser = studies.add_parser(
        "trade",
        help="speed against accuracy of every way, in every number type",
        description="Time every way of computing every quantity, in every number type, for one state and for many, and "
        "hold it against the truth in 60 digits. Prints tables, and in words which to use for which error.",
    )
    parser.add_argument("robot", nargs="?", default="go2", metavar="ROBOT", help="a catalogue name or a URDF (go2)")
    parser.add_argument("--base", choices=["fixed", "floating"], help="the base, if not the robot's own")
    parser.add_argument("--only", action="append", default=[], metavar="KEY", help=f"of {', '.join(KEYS)}; repeatable")
    parser.add_argument("--seed", type=at_least(0), default=0, metavar="N", help="of the random states (0)")
    parser.add_argument("--short", action="store_true", help="few states and rounds: to see that all is there")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write everything as JSON")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="draw error over time: a png, svg or pdf")
    parser.add_argument(
        "--progress", action="store_true", help="a progress bar on stderr, also where that is not a terminal"
    )
    parser.set_defaults(run=run_trade)


def _keep(trade: Trade, path: Path | None) -> None:
    """Print what was measured before the study was stopped, and write it beside the output file."""
    if path is not None:
        write_text(f"{path}.part", trade.to_json() + "\n")
        print(f"twistwrench: stopped; what was finished is in {path}.part", file=sys.stderr)
    print(f"{trade}\n\nstopped: the other quantities were not measured")


def run_trade(args: argparse.Namespace) -> int:
    """Measure, print, write, draw."""
    check_writable("--json", args.json)
    check_writable("--plot", args.plot)
    if args.plot is not None:
        from .picture import check_format, draw

        check_format(args.plot)
    effort = SHORT if args.short else FULL
    progress = True if args.progress else None
    measured: list[Trade] = []
    try:
        trade = weigh(
            args.robot,
            base=args.base,
            only=args.only,
            effort=effort,
            rng=args.seed,
            progress=progress,
            after_quantity=measured.append,
        )
    except KeyboardInterrupt:
        if measured:
            _keep(measured[-1], args.json)
        raise
    print(trade)
    if args.json is not None:
        write_text(args.json, trade.to_json() + "\n")
    if args.plot is not None:
        draw(trade, args.plot)
    return 0

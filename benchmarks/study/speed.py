"""``python -m benchmarks.study speed``: the textbook and `tw.fast` against Pinocchio called state by state from Python.

The long form, over batches and lengths and against other packages, is in benchmarks/.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.timing import round_robin

from .cases import QUANTITIES, ours, pinocchio, random_states

__all__ = ["Speed", "add_speed", "speed"]

BATCH = 1000
REFERENCE = 300
"""States in a loop of Pinocchio."""


class Speed(NamedTuple):
    """The time that one way takes for one quantity.

    Attributes
    ----------
    quantity : str
        A key of `cases.QUANTITIES`.
    way : str
    us, us_q1, us_q3 : float
        Median and quartiles of the time for a state, µs.
    ratio : float or None
        Of the medians, to Pinocchio; None where that is not installed.
    disturbed : bool
        Whether the call had to wait for the processor in every round.
    """

    quantity: str
    way: str
    us: float
    us_q1: float
    us_q3: float
    ratio: float | None
    disturbed: bool


def speed(
    model: tw.Model, *, rounds: int = 9, states: int = BATCH, after_round: Callable[[], object] = lambda: None
) -> Iterator[Speed]:
    """Time every quantity, all ways of one in turns.

    Parameters
    ----------
    model : Model
    rounds : int
        Of each comparison.
    states : int
        In a batch.
    after_round : callable
        Called after each round of each quantity, for a progress bar.

    Yields
    ------
    Speed

    Examples
    --------
    >>> import twistwrench as tw
    >>> found = list(speed(tw.load("pendulum"), rounds=1, states=10))
    >>> sorted({row.way for row in found} - {"Pinocchio"})
    ['fast', 'fast, 10 float32', 'fast, 10 states', 'textbook']
    """
    s = random_states(model, max(states, REFERENCE))
    first, some, single = s.first(1), s.first(states), s.first(states, np.float32)
    for quantity in QUANTITIES:
        calls = {
            "textbook": (ours(tw, model, quantity, first), 1),
            "fast": (ours(tw.fast, model, quantity, first), 1),
            f"fast, {states} states": (ours(tw.fast, model, quantity, some), states),
            f"fast, {states} float32": (ours(tw.fast, model, quantity, single), states),
        }
        if find_spec("pinocchio"):
            calls = {"Pinocchio": (pinocchio(model, quantity, s.first(REFERENCE)), REFERENCE)} | calls
        laps = round_robin([call for call, _ in calls.values()], rounds=rounds, after_round=after_round)
        times = [1e6 * np.quantile(lap.seconds, [0.5, 0.25, 0.75]) / n for lap, (_, n) in zip(laps, calls.values())]
        for way, lap, us in zip(calls, laps, times):
            median, q1, q3 = us.tolist()
            ratio = median / times[0][0] if "Pinocchio" in calls else None
            yield Speed(quantity, way, median, q1, q3, ratio, not lap.kept)


def add_speed(studies: Any) -> None:
    """Add ``python -m benchmarks.study speed``."""
    parser = studies.add_parser("speed", help="the textbook and tw.fast against Pinocchio, about ten seconds")
    parser.add_argument("robot", nargs="?", default="go2", metavar="ROBOT", help="a catalogue name or a URDF (go2)")
    parser.add_argument("--base", choices=["fixed", "floating"], help="the base, if not the robot's own")
    parser.set_defaults(run=run_speed)


def run_speed(args: argparse.Namespace) -> int:
    """Print the table."""
    from tqdm import tqdm

    model, rounds = tw.load(args.robot, base=args.base), 9
    with tqdm(total=rounds * len(QUANTITIES), unit=" rounds", disable=not sys.stderr.isatty(), leave=False) as bar:
        print(table(model, list(speed(model, rounds=rounds, after_round=bar.update))))
    return 0


def table(model: tw.Model, found: list[Speed]) -> str:
    """Return the rows as text."""
    ways = list(dict.fromkeys(row.way for row in found))
    lines = [f"{model.name}, nv = {model.nv}: microseconds for one state, median of rounds in turns"]
    if "Pinocchio" in ways:
        lines.append("× is against Pinocchio, called from Python for one state at a time")
    else:
        lines.append("Pinocchio is not installed (pip install pin): there is nothing to compare with")
    lines.append("")
    halves = zip(*(way.rpartition(", ")[::2] for way in ways))  # break "fast, 1000 states" into two lines
    lines += [f"{'':26}" + "".join(f"{x:>{_width(way)}}" for way, x in zip(ways, half)) for half in halves]
    for quantity, meaning in QUANTITIES.items():
        cells = [f"{_cell(row):>{_width(row.way)}}" for row in found if row.quantity == quantity]
        lines.append(f"{meaning:26}" + "".join(cells))
    if any(row.disturbed for row in found):
        lines.append("\n~ the machine had other things to do in every round: run it again when it has not")
    return "\n".join(lines)


def _width(way: str) -> int:
    return 10 if way == "Pinocchio" else 16


def _cell(row: Speed) -> str:
    ratio = f" ({_short(row.ratio)} ×)" if row.ratio is not None and row.way != "Pinocchio" else ""
    return "~" * row.disturbed + _short(row.us) + ratio


def _short(x: float) -> str:
    return f"{x:.2g}" if x < 1 else f"{x:.3g}" if x < 1000 else f"{x:.0f}"

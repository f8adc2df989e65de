"""The results: as a table, as JSON, in words."""

from __future__ import annotations

import json
import textwrap
from dataclasses import asdict, dataclass
from typing import Any

from twistwrench.tables import aligned
from twistwrench.timing import duration
from twistwrench.validate.report import number

from .choice import advice, front
from .measure import Effort, LeftOut, Point

__all__ = ["Trade"]

HEADER = ("", "", "way", "number", "states", "time", "quartiles", "error")
WIDTHS = (1, 1, 39, 13, 6, 8, 17, 8)
LINE = 100
"""Letters in a line of words."""


@dataclass(frozen=True)
class Trade:
    """Speed against accuracy for one robot.

    Attributes
    ----------
    robot, description : str
    names : dict of str
        By their keys: the names of the quantities.
    points : tuple of Point
    left_out : tuple of LeftOut
    missing : tuple of str
        What is not installed.
    versions : dict of str
    effort : Effort
    seconds : float
        What it took.
    """

    robot: str
    description: str
    names: dict[str, str]
    points: tuple[Point, ...]
    left_out: tuple[LeftOut, ...]
    missing: tuple[str, ...]
    versions: dict[str, str]
    effort: Effort
    seconds: float

    def of(self, key: str) -> list[Point]:
        """Return the points of a quantity."""
        return [p for p in self.points if p.quantity == key]

    def fronts(self, key: str) -> tuple[list[Point], list[Point]]:
        """Return the Pareto fronts of a quantity: for one state at a time, and for many."""
        return front(p for p in self.of(key) if p.states == 1), front(self.of(key))

    def words(self) -> str:
        """Return in words which way to use for which error."""
        lines = [line for key, name in self.names.items() if self.of(key) for line in advice(name, self.of(key))]
        return "\n".join(["The fastest way whose error is not above", *map(_wrapped, lines)])

    def __str__(self) -> str:
        head = [
            f"{self.robot}: {self.description}",
            _wrapped(
                f"error: largest difference from the truth in 60 digits, over its largest entry; the worst of "
                f"{self.effort.states} states"
            ),
            _wrapped(
                "time: for a state, median of rounds in turns; ● in the first column: no other way for one state is "
                "both as fast and as exact, in the second: none for many"
            ),
            *self.missing,
        ]
        tables = [line for key in self.names for line in self._table(key)]
        if not all(p.quiet for p in self.points):
            tables += ["", "~ the machine had other things to do: time on the processor, not on the wall"]
        return "\n".join([*head, *tables, "", self.words(), "", f"{self.seconds:.0f} s"])

    def _table(self, key: str) -> list[str]:
        one, many = self.fronts(key)
        lines = ["", self.names[key], _aligned(HEADER)]
        for p in sorted(self.of(key), key=lambda p: (p.states, p.seconds)):
            marks = "●" if p in one else "", "●" if p in many else ""
            quartiles = f"{duration(p.q1)} – {duration(p.q3)}"
            cells = (
                p.way,
                p.number,
                str(p.states),
                "~" * (not p.quiet) + duration(p.seconds),
                quartiles,
                number(p.error),
            )
            lines.append(_aligned((*marks, *cells)))
        lost = [x for x in self.left_out if x.quantity == key]
        return lines + [
            f"    left out: {x.way}, {x.number}{', a batch' if x.states > 1 else ''}: {x.why}" for x in lost
        ]

    def as_dict(self) -> dict[str, Any]:
        """Return everything in JSON's own types, with the fronts and the words."""
        plain = asdict(self)
        plain["fronts"] = {
            key: {
                kind: [[p.way, p.number, p.states] for p in points]
                for kind, points in zip(("one", "many"), self.fronts(key), strict=True)
            }
            for key in self.names
        }
        return plain | {"words": self.words().splitlines()}

    def to_json(self) -> str:
        """Return everything as JSON, a point a line."""
        plain = self.as_dict()
        rows = {key: plain.pop(key) for key in ("points", "left_out")}
        text = json.dumps(plain, indent=2, ensure_ascii=False, allow_nan=False)
        for key, values in rows.items():
            lines = ",\n".join("    " + json.dumps(x, ensure_ascii=False, allow_nan=False) for x in values)
            text = text[:-2] + f',\n  "{key}": [\n{lines}\n  ]\n}}'
        return text


def _wrapped(line: str) -> str:
    """Return a line cut to the width of a table, as words are."""
    rest = "    " if line.startswith(" ") else ""
    return textwrap.fill(line, LINE, subsequent_indent=rest, break_on_hyphens=False, break_long_words=False)


def _aligned(cells: tuple[str, ...]) -> str:
    return aligned([cells], widths=WIDTHS, right=range(4, len(WIDTHS)), gap=" ")[0]

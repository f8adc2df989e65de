"""The results of a validation: as a table, as JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from html import escape
from typing import Any

from ..tables import aligned, html_table
from .measure import Comparison

__all__ = ["Report", "notes", "number"]

HEADER = ("§", "quantity", "in Pinocchio", "shape", "vs Pin.", "vs truth", "bound", "")
RIGHT_ALIGNED_COLUMNS = (4, 5, 6)


@dataclass(frozen=True)
class Report:
    """The results for one robot.

    Attributes
    ----------
    robot : str
    description : str
        Base, bodies, sizes.
    base : str
    nv : int
    rows : tuple of Row
    pinocchio, mpmath : str or None
        Versions; None where it is missing and that side was left out.
    states, truths : int
        Number of random states, and of those at which the truth was computed in any case.
    seed : int or None
    loader : bool
        Whether Pinocchio read the same URDF by itself.
    seconds : float
    mimics : tuple of str
        Joints of the URDF that should mimic others, and move on their own.
    """

    robot: str
    description: str
    base: str
    nv: int
    rows: tuple[Comparison, ...]
    pinocchio: str | None
    mpmath: str | None
    states: int
    truths: int
    seed: int | None
    loader: bool
    seconds: float
    mimics: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether every row is inside its bound."""
        return all(row.passed for row in self.rows)

    @property
    def failed(self) -> tuple[Comparison, ...]:
        """The rows that are outside their bounds."""
        return tuple(row for row in self.rows if not row.passed)

    @property
    def worst(self) -> Comparison | None:
        """The row closest to its bound, or furthest above it."""
        compared = [row for row in self.rows if row.error is not None]
        return max(compared, key=lambda row: _ratio(row), default=None)

    def __str__(self) -> str:
        lines = [
            f"{self.robot}: {self.description}",
            *self._sides(),
            "",
            *aligned([HEADER, *map(_cells, self.rows)], right=RIGHT_ALIGNED_COLUMNS),
        ]
        return "\n".join([*lines, *notes(self.rows), "", self.summary()])

    @property
    def missing(self) -> list[str]:
        """Return in words which side is not installed."""
        pinocchio = "Pinocchio is not installed: held against the truth alone (pip install pin; not on Windows)"
        mpmath = "mpmath is not installed: without the 50-digit truth (pip install mpmath gmpy2)"
        return [pinocchio] * (self.pinocchio is None) + [mpmath] * (self.mpmath is None)

    def _sides(self) -> list[str]:
        """Return in words at which states ours was compared with what."""
        states = "1 state" if self.states == 1 else f"{self.states} states"
        lines = [f"at {states}" + ("" if self.seed is None else f" of seed {self.seed}")]
        if self.pinocchio is not None:
            reads = "reads the same URDF" if self.loader else "is handed the model over by the bridge"
            lines.append(f"vs Pin.: Pinocchio {self.pinocchio}, which {reads}")
        if self.mpmath is not None:
            lines.append(f"vs truth: newton_euler_3d in 50 digits, at {self.truths} and wherever the two differ")
        if self.mimics:
            more = f" and {len(self.mimics) - 4} more" if len(self.mimics) > 4 else ""
            lines.append(f"mimic joints, moved on their own: {', '.join(map(repr, self.mimics[:4]))}{more}")
        return [*lines, *self.missing]

    def summary(self) -> str:
        """Return the last line."""
        good = len(self.rows) - len(self.failed)
        time = f"{self.seconds:.1f} s"
        if not self.rows:
            return f"nothing moves: nothing to compare · {time}"
        if self.passed:
            return f"{good} of {len(self.rows)} rows inside their bounds · {time}"
        names = ", ".join(row.quantity for row in self.failed)
        return f"{good} of {len(self.rows)} rows inside their bounds; outside: {names} · {time}"

    def to_json(self, indent: int | None = 2) -> str:
        """Return everything as JSON; NaN and infinities are null."""
        return json.dumps(self.as_dict(), indent=indent, ensure_ascii=False, allow_nan=False)

    def as_dict(self) -> dict[str, Any]:
        """Return everything in JSON's own types."""
        plain = asdict(self) | {"passed": self.passed}
        plain["rows"] = [{key: _finite(value) for key, value in asdict(row).items()} for row in self.rows]
        return plain

    def _repr_html_(self) -> str:
        head = "<br>".join(escape(line) for line in (f"{self.robot}: {self.description}", *self._sides()))
        return f"<p>{head}</p>{html_table(HEADER, map(_cells, self.rows))}<p>{escape(self.summary())}</p>"


def notes(rows: Iterable[Comparison]) -> list[str]:
    """Return the notes on the rows, each once."""
    said: dict[str, list[str]] = {}
    for row in rows:
        if row.note:
            said.setdefault(row.note, []).append(row.quantity)
    return [f"    {'; '.join(names)}: {note}" for note, names in said.items()]


def _ratio(row: Comparison) -> float:
    ratio = (row.error or 0.0) / row.bound
    return math.inf if math.isnan(ratio) else ratio


def _cells(row: Comparison) -> tuple[str, ...]:
    verdict = "✓" if row.passed else "✗"
    if row.singular:
        return (row.section, row.quantity, row.pinocchio, "", "", "singular", "", verdict)
    shape = "×".join(map(str, row.shape)) or ("scalar" if row.error is not None else "")
    errors = [number(row.ours_vs_pinocchio), number(row.ours_vs_truth)]
    return (row.section, row.quantity, row.pinocchio, shape, *errors, number(row.bound), verdict)


def number(x: float | None) -> str:
    """Write an error in two digits; a dash in place of None.

    Examples
    --------
    >>> number(2.34e-16), number(0.0), number(None)
    ('2.3e-16', '0', '–')
    """
    if x is None:
        return "–"
    return "NaN" if math.isnan(x) else "0" if x == 0 else f"{x:.1e}".replace("1.0e-12", "1e-12")


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value

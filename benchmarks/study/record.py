"""The two things that every study is about: a way of computing a quantity, and the record of what it gave."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Self

import numpy as np

from twistwrench.arrays import Array
from twistwrench.tables import aligned
from twistwrench.timing import Lap, duration, round_robin

Call = Callable[[], object]

BUSY = "~ the machine had other things to do in every round: run it again when it has not"


@dataclass(frozen=True)
class Way:
    """How a quantity is computed: by which function, in which number type."""

    quantity: str
    name: str  # as the user would write it
    compute: Callable[..., Any]  # of the arrays that `before` returns; this is what is timed
    number: str = "float64"
    batches: bool = True  # whether it takes many states in one call
    before: Callable[..., tuple[Any, ...]] = lambda *inputs: inputs
    after: Callable[[Any], Array] = lambda value: value

    def value(self, *inputs: Array) -> Array:
        """Return the quantity."""
        return self.after(self.compute(*self.before(*inputs)))


@dataclass(frozen=True)
class Record:
    """What a way gave: its error, its cost, and the conditions of both."""

    quantity: str
    way: str
    number: str = "float64"
    where: str = ""  # the motion, the joint, the range of angles
    states: int = 1  # in one call
    error: float | None = None  # None without a number
    estimate: float | None = None  # what `twistwrench.accuracy` predicted: infinite where it guarantees nothing
    raised: str = ""  # the error that was raised in place of a number
    fault: str = ""  # what must not be: a NaN, an infinity, a warning, a number where none is right
    seconds: float = 0.0  # for one state: the median
    q1: float = 0.0
    q3: float = 0.0
    rounds: int = 0  # how many times were kept
    quiet: bool = True  # whether those of undisturbed stretches; without any, the time on the processor counts

    def timed(self, lap: Lap) -> Self:
        """Return it with the times of a lap."""
        q1, median, q3 = (float(x) for x in np.quantile(lap.seconds / self.states, [0.25, 0.5, 0.75]))
        return replace(self, seconds=median, q1=q1, q3=q3, rounds=len(lap.seconds), quiet=bool(lap.kept))

    @property
    def time(self) -> str:
        """The time for one state, marked where the machine was busy."""
        return "~" * (not self.quiet) + duration(self.seconds)

    def as_dict(self) -> dict[str, Any]:
        """Return what is not as by default, for JSON: which has no infinity, so that of an estimate is a word."""
        given = {f.name: getattr(self, f.name) for f in fields(self) if getattr(self, f.name) != f.default}
        return given | ({"estimate": "inf"} if self.estimate == np.inf else {})

    @classmethod
    def from_dict(cls, found: dict[str, Any]) -> Self:
        """Return the record of an `as_dict`."""
        return cls(**found | ({"estimate": np.inf} if found.get("estimate") == "inf" else {}))


def time_in_turns(started: Sequence[tuple[Record, Call]], **how: Any) -> list[Record]:
    """Return the records with the times of their calls, which are made in turns; `how` is for `round_robin`."""
    laps = round_robin([call for _, call in started], **how)
    return [record.timed(lap) for (record, _), lap in zip(started, laps, strict=True)]


def table(found: Sequence[dict[str, Any]], head: dict[str, str | None], **formats: str) -> str:
    """Return dictionaries as a table, with a column for each key of `head`, where numbers stand at the right."""
    lines = [[format(row[name], formats.get(name, "")) for name in head] for row in found]
    right = [k for k, name in enumerate(head) if found and not isinstance(found[0][name], str)]
    return "\n".join(aligned([[title or name for name, title in head.items()], *lines], right=right))

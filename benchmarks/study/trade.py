"""``python -m benchmarks.study trade``: the time of every way of computing a quantity, and how many digits it keeps."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from importlib.util import find_spec
from textwrap import shorten
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.advice import NO_MPMATH
from twistwrench.arrays import Array
from twistwrench.errors import ModelError, check_known
from twistwrench.tables import aligned
from twistwrench.timing import duration
from twistwrench.validate.report import number
from twistwrench.validate.states import States, random_states

from . import turns
from .derivatives import SLOPE, derivatives, slope_truth
from .numbers import DIGITS, PAIRS, TRUTH, as_long_double, convert
from .quantities import QUANTITIES, REFERENCE, Robot, pinocchio
from .record import Record, Way, time_in_turns

DRAWN = 50  # random states; larger batches repeat them
KEYS = ("ID", "FD", "M", "A_G", "dh_G", "dJv", SLOPE, "exp", "log")
WIDTHS = (1, 1, 39, 13, 6, 8, 17, 8)  # of the columns of all tables


@dataclass(frozen=True)
class Effort:
    """How much is measured."""

    states: int = 5  # at which the error is measured; the worst counts
    batch: int = 1000  # states in a batch
    rounds: int = 7  # how often each way is timed
    least: float = 0.003  # for about how long at a time, s
    most: float = 0.5  # a way that has taken so long is timed no more, s


FULL = Effort()
SHORT = Effort(states=2, batch=20, rounds=2, least=1e-4, most=0.05)
"""A quick check that all of it runs. Its times are worth little."""


class Task(NamedTuple):
    """A quantity with all ways of computing it."""

    key: str
    name: str
    inputs: Callable[[str, int | slice], tuple[Array, ...]]  # from a number type and states to the arguments of a way
    truth: Callable[[int], Array]  # of the index of a state, in 60 digits
    ways: Sequence[Way]
    batch: int

    def candidates(self) -> list[tuple[Way, int]]:
        """Return every way for one state, and for many where it takes them."""
        return [(way, n) for way in self.ways for n in ((1, self.batch) if way.batches else (1,))]

    def measure(self, effort: Effort, tick: Callable[[], object] = lambda: None) -> list[Record]:
        """Measure every way; `tick` is called once for each, and once for each round of timing."""
        try:
            truths = [self.truth(i) for i in range(effort.states)]
            if not all((truth != 0).any() for truth in truths):
                raise ValueError("the right value is zero: no error is relative to it")
        except ValueError as error:  # SingularError is one
            return [Record(self.key, "all ways", "all numbers", raised=shorten(str(error), 100))]
        started, left_out = [], []
        for way, states in self.candidates():
            record = Record(self.key, way.name, way.number, states=states)
            try:
                error, call = self._check(way, states, truths)
                started.append((replace(record, error=error), call))
            except ValueError as error:  # SingularError and LinAlgError are ValueErrors
                left_out.append(replace(record, raised=shorten(str(error), 100)))
            tick()
        how = {"rounds": effort.rounds, "least": effort.least, "most": effort.most}
        return [*time_in_turns(started, **how, after_round=tick), *left_out]

    def _check(self, way: Way, states: int, truths: Sequence[Array]) -> tuple[float, Callable[[], object]]:
        """Return the worst error, and the call that is to be timed."""
        where = range(len(truths)) if states == 1 else [slice(states)]
        calls = [partial(way.compute, *way.before(*self.inputs(way.number, i))) for i in where]
        values = [way.after(call()) for call in calls]
        # A batch may have fewer states than the error is measured at.
        pairs = zip(values if states == 1 else values[0], truths, strict=False)
        return max(relative_error(x, truth) for x, truth in pairs), calls[0]


def relative_error(value: Array, truth: Array) -> float:
    """Return the largest difference of an entry from the truth in mpmath numbers, over the largest entry of that.

    >>> from twistwrench.newton_euler_3d import as_mpmath
    >>> relative_error(np.array([1.0, 4.0]), as_mpmath([1.5, 4.0]))
    0.125
    """
    if np.shape(value) != truth.shape:
        raise ValueError(f"expected shape {truth.shape}, got {np.shape(value)}")
    size = abs(truth).max()
    if value.dtype == object:
        return float(abs(value - truth).max() / size)
    if not np.isfinite(value).all():
        raise ValueError("gives a NaN or an infinity")
    high = truth.astype(np.float64)  # as two doubles the truth has 32 digits
    low = (truth - high).astype(np.float64)
    return float(np.abs(value.astype(np.longdouble) - high - low).max() / np.longdouble(size))


def _repeated(x: Array, where: int | slice) -> Array:
    """Return one entry, or the first ones, repeated where there are fewer than wanted."""
    return np.asarray(x[where] if isinstance(where, int) else x[np.arange(where.stop) % len(x)])


def _tasks(model: tw.Model, effort: Effort, seed: int) -> list[Task]:
    """Return all quantities. The same states are drawn for every effort, and repeated to make a batch."""
    rng = np.random.default_rng(seed)
    states = random_states(model, DRAWN, rng=rng)
    robot = Robot(model, pinocchio(model), _moving_frame(model, states))

    def task(key: str, name: str, takes: str, truth: Callable[..., Array], ways: list[Way], batch: int) -> Task:
        def inputs(kind: str, where: int | slice) -> tuple[Array, ...]:
            """NumPy's quaternions are made unit to the last digit of their type."""
            q, *others = (convert(_repeated(getattr(states, x), where), kind) for x in takes.split())
            return (q if kind == PAIRS or kind.endswith("digits") else model.normalize(q)), *others

        return Task(key, name, inputs, lambda i: truth(*inputs(TRUTH, i)), ways, batch)

    known = {key: QUANTITIES[key] for key in KEYS if key in QUANTITIES}
    batch = max(2, effort.batch // 10)  # each derivative evaluates nv or more states
    return [
        *(task(k, of.name, of.takes, robot.truth(k), robot.ways(k), effort.batch) for k, of in known.items()),
        task(SLOPE, "derivative ∂τ/∂q", "q v a", partial(slope_truth, model), derivatives(robot), batch),
        *_pose_tasks(effort, rng),
    ]


def _moving_frame(model: tw.Model, s: States) -> str:
    """Return a frame whose J̇ v is not zero, as it is on an axis that does not move; a foot if there is one."""
    names = (*s.frames, *model.frame_names)
    state = model, s.q[0], s.v[0]
    return next((name for name in names if tw.frame_bias_acceleration(*state, name, REFERENCE).any()), names[0])


def _pose_tasks(effort: Effort, rng: np.random.Generator) -> list[Task]:
    """Return exp and log: of random axes, angles uniform in 0 … π, and 1 m times a normal number."""
    w, v = rng.standard_normal((2, DRAWN, 3))
    w *= rng.uniform(0, np.pi, (DRAWN, 1)) / np.sqrt((w * w).sum(axis=-1, keepdims=True))
    V = np.concatenate([w, v], axis=-1)
    exact = turns.exact_exp(convert(V[: effort.states], TRUTH))  # the others only take time
    nearly = tw.exp6(V.astype(np.longdouble)).matrix()
    nearly[: effort.states] = as_long_double(exact)

    def twists(kind: str, where: int | slice) -> tuple[Array, ...]:
        return (convert(_repeated(V, where), kind),)

    def placements(kind: str, where: int | slice) -> tuple[Array, ...]:
        """Return the truth, rounded once."""
        return (convert(exact[where], kind),) if kind in DIGITS else (_repeated(nearly, where).astype(kind),)

    ways = [replace(way, quantity=way.quantity[:-1]) for way in turns.ways() if way.quantity.endswith("6")]
    exps, logs = ([way for way in ways if way.quantity == key] for key in ("exp", "log"))
    return [
        Task("exp", "exponential exp6", twists, lambda i: exact[i], exps, effort.batch),
        Task("log", "logarithm log6", placements, lambda i: convert(V[i], TRUTH), logs, effort.batch),
    ]


def weigh(
    model: tw.Model, *, only: Collection[str] = (), effort: Effort = FULL, seed: int = 0, progress: bool = False
) -> Trade:
    """Measure speed against accuracy: every quantity of `KEYS`, or those of `only`, every way, every number type."""
    from tqdm import tqdm

    start = time.perf_counter()
    for key in only:
        check_known("quantity", key, KEYS)
    if not find_spec("mpmath"):
        raise ImportError(NO_MPMATH)
    if not model.nv:
        raise ModelError(f"{model.name}: nothing moves: nothing to measure")
    trade = Trade(model.name, repr(model).partition(": ")[2], effort)
    tasks = [task for task in _tasks(model, effort, seed) if not only or task.key in only]
    steps = sum(len(task.candidates()) + effort.rounds for task in tasks)
    with tqdm(total=steps, unit="step", leave=False, disable=not progress) as bar:
        for task in tasks:
            bar.set_description(task.key)
            trade.records += task.measure(effort, bar.update)
            trade.names[task.key] = task.name
    trade.seconds = time.perf_counter() - start
    return trade


def front(points: Iterable[Record]) -> list[Record]:
    """Return the Pareto front: the points to which no other is both as fast and as exact, the fastest first.

    >>> points = [Record("ID", "", error=e, seconds=t) for e, t in [(1e-6, 1), (1e-12, 2), (1e-9, 3)]]
    >>> [p.seconds for p in front(points)]
    [1, 2]
    """
    kept: list[Record] = []
    for point in sorted(points, key=lambda p: (p.seconds, p.error)):
        if not kept or point.error < kept[-1].error:
            kept.append(point)
    return kept


@dataclass
class Trade:
    """Speed against accuracy for one robot."""

    robot: str
    description: str
    effort: Effort
    names: dict[str, str] = field(default_factory=dict)  # of the quantities that were measured, by their keys
    records: list[Record] = field(default_factory=list)  # a way that gives no number has an error that was raised
    seconds: float = 0.0  # what it took

    def points(self, key: str) -> list[Record]:
        """Return what was measured of a quantity."""
        return [r for r in self.records if r.quantity == key and r.error is not None]

    def fronts(self, key: str) -> tuple[list[Record], list[Record]]:
        """Return the Pareto fronts of a quantity: for one state at a time, and for many."""
        return front(p for p in self.points(key) if p.states == 1), front(self.points(key))

    def __str__(self) -> str:
        missing = [name for name in ("pinocchio", "scipy", "gmpy2") if not find_spec(name)]
        lines = [
            f"{self.robot}: {self.description}",
            "error: largest difference from the truth in 60 digits, over its largest entry;",
            f"    the worst of {self.effort.states} states",
            "time: for a state, median of rounds in turns; ● in the first column: no other way for one state",
            "    is both as fast and as exact, in the second: none for many",
            *(f"not installed: {name}" for name in missing),
            *(line for key in self.names for line in self._table(key)),
            *([] if all(r.quiet for r in self.records) else ["", "~ the machine was busy: time on the processor"]),
        ]
        return "\n".join([*lines, "", f"{self.seconds:.0f} s"])

    def _table(self, key: str) -> list[str]:
        one, many = self.fronts(key)
        rows = [("", "", "way", "number", "states", "time", "quartiles", "error")]
        for p in sorted(self.points(key), key=lambda p: (p.states, p.seconds)):
            quartiles = f"{duration(p.q1)} – {duration(p.q3)}"
            front = "●" * (p in one), "●" * (p in many)
            rows.append((*front, p.way, p.number, str(p.states), p.time, quartiles, number(p.error)))
        lost = [r for r in self.records if r.quantity == key and r.error is None]
        return [
            "",
            self.names[key],
            *aligned(rows, widths=WIDTHS, right=range(4, 8), gap=" "),
            *(f"    left out: {r.way}, {r.number}{', a batch' * (r.states > 1)}: {r.raised}" for r in lost),
        ]

    def to_json(self) -> str:
        """Return everything as JSON, a record a line."""
        plain: dict[str, Any] = vars(self) | {"effort": asdict(self.effort)}
        records = ",\n".join("    " + json.dumps(r.as_dict(), ensure_ascii=False) for r in plain.pop("records"))
        return json.dumps(plain, indent=2, ensure_ascii=False)[:-2] + f',\n  "records": [\n{records}\n  ]\n}}\n'

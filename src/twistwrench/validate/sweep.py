"""Validate all robots of the catalogue, on several processes (49.11)."""

from __future__ import annotations

import os
import threading
from collections.abc import Generator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import active_children, get_context, parent_process
from typing import Any, Literal

from ..loading import robots
from ..loading.catalogue import PREFIX, example_robot_data_folder
from ..stopping import without_interrupts
from ..tables import aligned
from .report import Report, notes, number
from .run import validate

__all__ = ["Outcome", "every_robot", "header", "line", "summary", "sweep"]

Base = Literal["fixed", "floating"]
BASES: tuple[Base, Base] = ("fixed", "floating")


@dataclass(frozen=True)
class Outcome:
    """The outcome for one robot on one base: a report, or the error that prevented it."""

    robot: str
    base: Base
    report: Report | None
    error: str = ""

    @property
    def passed(self) -> bool:
        """Whether there is a report and every row of it is inside its bound."""
        return self.report is not None and self.report.passed

    def as_dict(self) -> dict[str, Any]:
        """Return everything in JSON's own types."""
        if self.report is not None:
            return self.report.as_dict()
        return {"robot": self.robot, "base": self.base, "passed": False, "error": self.error}


def every_robot(base: Base | None = None) -> list[tuple[str, Base]]:
    """List the robots of the catalogue that are installed, each on both bases unless one is given."""
    there = [r.name for r in robots() if r.source == "models" or example_robot_data_folder() is not None]
    return [(name, b) for name in there for b in (BASES if base is None else (base,))]


def sweep(
    which: Sequence[tuple[str, Base]],
    *,
    jobs: int | None = None,
    states: int = 8,
    truths: int = 1,
    seed: int = 0,
    fast: bool = False,
) -> Generator[Outcome]:
    """Validate robots, several at a time, each with two frames.

    Parameters
    ----------
    which : sequence of (name, base)
    jobs : int, optional
        Number of processes; as many as there are processors unless given.
    states, truths, seed, fast
        As `validate`'s states, truths, rng and fast.

    Yields
    ------
    Outcome
        In the order of `which`.
    """
    jobs = min(jobs or os.cpu_count() or 1, len(which) or 1)
    if jobs == 1:
        for name, base in which:
            yield _outcome(name, base, states, truths, seed, fast)
        return
    # Spawned, not forked: a fork copies locks of the BLAS's threads in whatever state they are.
    pool = ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), initializer=_end_with_the_parent)
    others = set(active_children())
    try:
        with without_interrupts():
            running = [pool.submit(_outcome, name, base, states, truths, seed, fast) for name, base in which]
        for future in running:
            yield future.result()
    except BaseException:  # Ctrl-C, or the caller stopped: the work in progress would take seconds or minutes
        for process in set(active_children()) - others:
            process.kill()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _end_with_the_parent() -> None:
    """End a process of the pool when its parent was killed: it would wait for work forever."""

    def watch() -> None:
        if (parent := parent_process()) is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _outcome(name: str, base: Base, states: int, truths: int, seed: int, fast: bool) -> Outcome:
    try:
        report = validate(name, base=base, states=states, truths=truths, frames=2, rng=seed, fast=fast)
        return Outcome(name, base, report)
    except Exception as error:  # show the other robots all the same
        return Outcome(name, base, None, f"{type(error).__name__}: {error}")


COLUMNS = ("robot", "base", "nv", "rows", "closest to its bound", "vs Pin.", "truth", "bound", "")
WIDTHS = (26, 8, 3, 5, 23, 7, 7, 7, 1)


def header() -> str:
    """Return the first line of the table."""
    return _aligned(COLUMNS)


def line(outcome: Outcome) -> str:
    """Return an outcome's line of the table, and below it the notes on its rows."""
    report = outcome.report
    name = outcome.robot.replace(PREFIX, "…/")
    if report is None:
        return _aligned((name, outcome.base, "", "", outcome.error))
    row = report.worst
    count = f"{len(report.rows) - len(report.failed)}/{len(report.rows)}"
    what = row.quantity if row else "(nothing moves)"
    numbers = map(number, (row.ours_vs_pinocchio, row.ours_vs_truth, row.bound)) if row else [""] * 3
    cells = (name, outcome.base, str(report.nv), count, what, *numbers, "✓" if outcome.passed else "✗")
    return "\n".join([_aligned(cells), *notes(report.rows)])


def _aligned(cells: Sequence[str]) -> str:
    return aligned([cells], widths=WIDTHS, right=range(5, 8), gap=" ")[0]


def summary(outcomes: Sequence[Outcome], seconds: float) -> str:
    """Return the last line, preceded by what was missing."""
    missing = {text: None for o in outcomes if o.report for text in o.report.missing}
    if example_robot_data_folder() is None:
        missing["example-robot-data is not installed: its robots are left out (pip install example-robot-data)"] = None
    good = sum(o.passed for o in outcomes)
    rows = sum(len(o.report.rows) for o in outcomes if o.report)
    names = ", ".join(f"{o.robot} ({o.base})" for o in outcomes if not o.passed)
    line = (
        f"{good} of {len(outcomes)} robots and bases inside all their bounds, {rows} rows"
        + (f"; not: {names}" if names else "")
        + f" · {seconds:.0f} s"
    )
    return "\n".join([*missing, line])

"""What docs/trade.md shows: two runs of ``python -m benchmarks.study trade``, their pictures, and its tables.

python benchmarks/trade.py            # run both studies, ten minutes; writes to results/ and docs/pictures/
python benchmarks/trade.py --tables   # only make the tables and two pictures anew from results/
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import argparse
import json
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np
from speed import environment
from study.derivatives import central_difference, complex_step, forward_difference
from study.pictures import draw_trade, save
from study.record import Record
from study.trade import Effort, Trade, weigh
from tables import table, write

import twistwrench as tw
from twistwrench.advice import USES, Advice, advise
from twistwrench.plot.style import COLOURS
from twistwrench.timing import duration
from twistwrench.validate.report import number

HERE = Path(__file__).parent
DOCS = HERE.parent / "docs"
PAGES = (DOCS / "trade.md", DOCS / "trade.zh-CN.md")
ROBOTS = ("go2", "humanoid")
USES_RESULTS = HERE / "results" / "uses.json"
TARGETS = (1e-6, 1e-12, 1e-16)
"""Errors that a user may want to stay below."""


def read(robot: str) -> Trade:
    """Return what was measured in a run."""
    found = json.loads((HERE / "results" / f"trade_{robot}.json").read_text(encoding="utf-8"))
    records = [Record.from_dict(record) for record in found["records"]]
    return Trade(robot, found["description"], Effort(**found["effort"]), found["names"], records)


def points(robot: str) -> list[Record]:
    """Return the records of a run that have an error."""
    return [record for record in read(robot).records if record.error is not None]


def tables() -> dict[str, str]:
    """Return all tables by name. A cell is a time for one state, or that and an error."""
    go2 = points("go2")
    uses = json.loads(USES_RESULTS.read_text(encoding="utf-8"))["uses"]
    return {
        "uses": table(cell for row in uses for cell in _use(Advice(**row))),
        "one": table(_answers([p for p in go2 if p.states == 1])),
        "alone": table(_answers([p for p in go2 if p.states == 1 and not p.way.startswith("pin.")])),
        "many": table(_answers(go2)),
        "numbers": table(_cells(go2, "ID")),
        "forward": table(_cells(go2, "FD")),
        "derivative": table(_cells(go2, "dID/dq")),
        "exp": table(_cells(go2, "exp")),
        "log": table(_cells(go2, "log")),
        "humanoid": table(_answers(points("humanoid"))),
        "heavier": table(_cells(points("humanoid"), "FD")),
    }


def _use(row: Advice) -> Iterator[tuple[str, str, str]]:
    """Yield the row of a use."""
    some = "1 state" if row.states == 1 else f"{row.states} states"
    cells = {"function": f"`{row.function}`", "number type": row.number, "in a call": some}
    cells |= {"error": f"{row.error:.0e} {row.unit}", "time": duration(row.seconds)}
    for column, cell in cells.items():
        yield f"`{row.use}`", column, cell


def _answers(some: list[Record]) -> Iterator[tuple[str, str, str]]:
    """Yield for each quantity and each error the fastest way that stays below."""
    for key in dict.fromkeys(p.quantity for p in some):
        for target in TARGETS:
            enough = [p for p in some if p.quantity == key and p.error <= target]
            found = min(enough, key=lambda p: p.seconds, default=None)
            cell = f"`{found.way}`, {found.number}, {found.time}" if found else "–"
            yield f"`{key}`", f"{target:.0e}".replace("e-0", "e-"), cell


def _cells(some: list[Record], key: str) -> Iterator[tuple[str, str, str]]:
    """Yield time and error of each way of a quantity, a line for one state and another for many."""
    for p in some:
        if p.quantity == key:
            yield f"`{p.way}`, {p.states}", p.number, f"{p.time}, {number(p.error)}"


def _with_machine(text: str) -> str:
    """Return JSON with a first line on the machine."""
    machine = json.dumps(environment("python benchmarks/trade.py"), ensure_ascii=False)
    return text.replace("{", f'{{\n  "machine": {machine},', 1)


def draw_steps(path: Path) -> None:
    """Draw the error of a derivative over the step, in double precision: forward, central, complex."""
    from matplotlib.figure import Figure

    model = tw.load("go2")
    rng = np.random.default_rng(0)
    q = model.random_configuration(rng=rng)
    v, a = rng.standard_normal((2, model.nv))
    longer = model.normalize(q.astype(np.longdouble)), *(x.astype(np.longdouble) for x in (v, a))
    tau = partial(tw.fast.rnea, model)
    exact = complex_step(tau, model, *longer, h=1e-100)
    ways = {
        "forward difference": (forward_difference, "v", "sky"),
        "central difference": (central_difference, "^", "orange"),
    }
    ways["complex step"] = (complex_step, "o", "vermilion")
    ax = (figure := Figure(figsize=(7, 4), layout="constrained")).add_subplot()
    for name, (way, marker, colour) in ways.items():
        largest = 4 if way is complex_step else 1  # what leaves the rotations by more is refused
        steps = 10.0 ** -np.arange(largest, 18, 0.25)
        errors = [np.abs(way(tau, model, q, v, a, h) - exact).max() / np.abs(exact).max() for h in steps]
        ax.loglog(steps, errors, marker + "-", color=COLOURS[colour], markersize=4, label=name)
    ax.set(xlabel="step h", ylabel="relative error of ∂τ/∂q", title="go2, float64: what a step costs", xlim=(1, 1e-18))
    ax.grid(alpha=0.3)
    ax.legend()
    save(figure, path)


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description="Make the numbers, the pictures and the tables of docs/trade.md.")
    parser.add_argument("--tables", action="store_true", help="only the tables and pictures of results/")
    parser.add_argument("--uses", action="store_true", help="only the uses: half a minute")
    args = parser.parse_args()
    if not args.tables:
        model = tw.load("go2")
        rows = [advise(model, use)._asdict() for use in USES]
        found = {**environment("python benchmarks/trade.py"), "robot": model.name, "uses": rows}
        USES_RESULTS.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    if not (args.tables or args.uses):
        for robot in ROBOTS:
            trade = weigh(tw.load(robot), progress=sys.stderr.isatty())
            (HERE / "results" / f"trade_{robot}.json").write_text(_with_machine(trade.to_json()), encoding="utf-8")
        draw_steps(DOCS / "pictures" / "trade_steps.png")
    for robot in ROBOTS:
        save(draw_trade(read(robot)), DOCS / "pictures" / f"trade_{robot}.png")
    write(PAGES, tables())


if __name__ == "__main__":
    main()

"""What docs/budget.md shows: the error budget of a trot and of a walk, and its picture.

python benchmarks/budget.py            # both studies, half a minute; results, picture, table
python benchmarks/budget.py --tables   # only make the table anew from results/
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path

from study.__main__ import main as study
from study.record import Record
from tables import table, write

HERE = Path(__file__).parent
DOCS = HERE.parent / "docs"
PAGES = (DOCS / "budget.md", DOCS / "budget.zh-CN.md")
MOTIONS = {"go2": "trot", "talos_reduced": "walk"}


def results(robot: str) -> Path:
    """Return the file of results of a robot."""
    return HERE / "results" / f"budget_{robot}.json"


def records(robot: str) -> list[Record]:
    """Return what was measured of a robot."""
    found = json.loads(results(robot).read_text(encoding="utf-8"))["records"]
    return [Record.from_dict(record) for record in found]


def amount(x: float) -> str:
    """Return a digit: the first, and of tens and hundreds the power as zeros."""
    return f"{float(f'{x:.0e}'):g}" if x >= 1e-2 else f"{x:.0e}"


def tables() -> dict[str, str]:
    """Return the table: a line for each source, for each robot a torque and a shift."""
    return {"budget": table(_cells())}


def _cells() -> Iterator[tuple[str, str, str]]:
    for robot, motion in MOTIONS.items():
        columns = {"torque": f"{robot}, {motion}: N m", "pressure": f"{robot}: mm"}
        for record in records(robot):
            yield record.way, columns[record.quantity], amount(record.error)


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description="Make the numbers, the picture and the table of docs/budget.md.")
    parser.add_argument("--tables", action="store_true", help="only the table, from results/")
    if not parser.parse_args().tables:
        for robot, motion in MOTIONS.items():
            picture = ["--plot", str(DOCS / "pictures" / "budget.png")] if robot == "go2" else []
            study(["budget", robot, "--motion", motion, "--json", str(results(robot)), *picture])
    write(PAGES, tables())


if __name__ == "__main__":
    main()

"""How fast is `tw.fast`? Everything against Pinocchio called state by state from Python, in one process, in turns.

python benchmarks/speed.py                # all of it, ten minutes; writes to benchmarks/results
python benchmarks/speed.py --only links   # one of: one, batch, links, peers
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import argparse
import csv
import json
import os
import platform
import sys
import time
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import numpy as np
from study.speed import QUANTITIES, ours, random_states
from study.speed import theirs as pinocchio
from tables import rows

import twistwrench as tw
from twistwrench.timing import Race, race, round_robin

RESULTS = Path(__file__).parent / "results"
BATCHES = (1, 10, 100, 1000, 10_000, 100_000)
LINKS = (10, 20, 40, 80, 100, 200, 500, 1000)  # to 80 there are programs
REFERENCE = 300
"""States in a loop of Pinocchio."""

Row = dict[str, object]


def one(rounds: int) -> Iterator[Row]:
    """One state at a time, by the fast way and by the textbook."""
    model = tw.load("go2")
    s = random_states(model, REFERENCE)
    first = s.first(1)
    for quantity in QUANTITIES:
        for way, package in (("fast", tw.fast), ("textbook", tw)):
            call = ours(package, model, quantity, first), 1
            result = race(call, (pinocchio(model, quantity, s), REFERENCE), rounds=rounds)
            yield row("one", way, quantity, result, robot=model.name, dtype="float64", batch=1)


def batch(rounds: int) -> Iterator[Row]:
    """Many states in one call."""
    model = tw.load("go2")
    s = random_states(model, max(BATCHES))
    for dtype in (np.float64, np.float32):
        for quantity in QUANTITIES:
            reference = pinocchio(model, quantity, s.first(REFERENCE)), REFERENCE
            for n in BATCHES:
                call = ours(tw.fast, model, quantity, s.first(n, dtype)), n
                result = race(call, reference, rounds=rounds if n < 100_000 else 3)
                yield row("batch", "fast", quantity, result, robot=model.name, dtype=np.dtype(dtype).name, batch=n)


def links(rounds: int) -> Iterator[Row]:
    """Chains of 10 to 1000 links; all lengths in turns, so that a slow minute of the machine bends no curve."""
    models = {n: tw.chain(n) for n in LINKS}
    states = {n: random_states(model, 100) for n, model in models.items()}
    for quantity in ("rnea", "aba", "A_G"):
        calls = {}
        for n, model in models.items():
            for size in (1, 100):
                calls["fast", n, size] = ours(tw.fast, model, quantity, states[n].first(size)), size
            if n <= 200:
                calls["textbook", n, 1] = ours(tw, model, quantity, states[n].first(1)), 1
                # Beyond, its data take gigabytes, and so many chains are kept here at once.
                calls["Pinocchio", n, 1] = pinocchio(model, quantity, states[n]), 100
        laps = round_robin([call for call, _ in calls.values()], rounds=rounds, least=0.05)
        ran = dict(zip(calls, laps, strict=True))
        for (way, n, size), lap in ran.items():
            if way != "Pinocchio":
                mine = lap.seconds / size
                theirs = ran["Pinocchio", n, 1].seconds / 100 if n <= 200 else np.full(1, np.nan)
                some = min(len(mine), len(theirs)) if n <= 200 else len(mine)
                result = Race(mine[:some], np.resize(theirs, some), len(lap.spare))
                yield row("links", way, quantity, result, robot=f"chain_{n}", dtype="float64", batch=size, links=n)


def peers(rounds: int) -> Iterator[Row]:
    """Other packages, one state and many."""
    from peers import expected
    from peers import peers as installed

    from twistwrench.loading.catalogue import find

    model = tw.load("go2")
    s = random_states(model, 10_000)
    for peer in installed(model, str(find("example-robot-data/go2").path)):
        few = type(s)(*(x[:20] for x in s))
        right = expected(model, peer, few)
        error = np.abs(peer.prepare(few)() - right).max() / np.abs(right).max()
        if not error < 1e-9:
            print(f"{peer.name} {peer.quantity}: differs by {error:.1e}; left out")
            continue
        reference = pinocchio(model, peer.quantity, s.first(REFERENCE)), REFERENCE
        for n in (1, 100, 1000, 10_000) if peer.batched else (1000,):
            some = type(s)(*(x[:n] for x in s))
            result = race((peer.prepare(some), n), reference, rounds=min(rounds, 5), one_thread=False)
            size = n if peer.batched else 1
            yield row("peers", peer.name, peer.quantity, result, robot=model.name, dtype="float64", batch=size)


def row(study: str, way: str, quantity: str, result, **what) -> Row:
    """Return a row of the table, and print its gist."""
    made = {"study": study, "way": way, "quantity": quantity, "links": "", **what, **result.row(), "date": today()}
    place = f"{made['links']} links, " if made["links"] else ""
    print(
        f"{study:8} {way:18} {quantity:5} {what['dtype']:8} {place}batch {what['batch']:>7,}: "
        f"{made['us']:10.2f} µs"
        + f", {made['ratio']:8.2f} × ({made['ratio_q1']:.2f} to {made['ratio_q3']:.2f})" * (made["ratio"] > 0)
        + f", reference {made['reference_us']:.2f} µs" * (made["ratio"] > 0)
        + f", {made['disturbed']} disturbed" * bool(made["disturbed"]),
        flush=True,
    )
    return made


def kept(found: list[Row]) -> list[Row]:
    """Return the rows of the last run whose package was not measured now: it is not installed."""
    measured = {r["way"] for r in found}
    return [dict(r) for r in rows("peers") if r["way"] not in measured]


def today() -> str:
    """Return the date of a row."""
    return time.strftime("%Y-%m-%d")


STUDIES = {"one": one, "batch": batch, "links": links, "peers": peers}


def environment(command: str) -> dict[str, object]:
    """Return on what this ran."""
    packages = ("twistwrench", "numpy", "pin", "mpmath", "gmpy2", "scipy")
    packages += ("mujoco", "adam-robotics", "casadi", "frax", "jax")
    found = {}
    for name in packages:
        try:
            found[name] = version(name)
        except ImportError:
            continue
    model = [line.split(":")[1].strip() for line in _cpuinfo() if line.startswith("model name")]
    return {
        "command": command,
        "python": platform.python_version(),
        "packages": found,
        "processor": model[0] if model else platform.processor(),
        "cores": os.cpu_count(),
        "system": platform.system(),
        "load": os.getloadavg() if hasattr(os, "getloadavg") else None,
        "date": today(),
    }


def _cpuinfo() -> list[str]:
    path = Path("/proc/cpuinfo")
    return path.read_text().splitlines() if path.exists() else []


def main() -> None:
    """Run what is asked for; write the rows of a study over those of its last run."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", choices=list(STUDIES), action="append", help="this study; may be repeated")
    parser.add_argument("--rounds", type=int, default=9, help="of each comparison (9)")
    args = parser.parse_args()
    RESULTS.mkdir(exist_ok=True)
    command = " ".join(["python", "benchmarks/speed.py", *sys.argv[1:]])
    for name in args.only or STUDIES:
        found = list(STUDIES[name](args.rounds))
        if not found:  # no peers are installed, or there is one processor
            print(f"{name}: nothing was measured; what results/ holds of it stays")
            continue
        if name == "peers":
            found = [*kept(found), *found]
        with (RESULTS / f"{name}.csv").open("w", newline="") as file:
            writer = csv.DictWriter(file, list(found[-1]))
            writer.writeheader()
            writer.writerows({k: f"{v:.5g}" if isinstance(v, float) else v for k, v in r.items()} for r in found)
        (RESULTS / f"{name}.json").write_text(json.dumps(environment(command), indent=2) + "\n")


if __name__ == "__main__":
    main()

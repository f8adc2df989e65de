"""What `tw.advise` promises, and what its answers give in new states: five robots, five uses, two tolerances each.

python benchmarks/advice.py            # what is not in results/advice.json yet, and the table of docs/which
python benchmarks/advice.py --anew     # all of it, half an hour on one core
python benchmarks/advice.py --tables   # only the table

The call that the advice prints is evaluated as it stands, at random states of the same kind that the advice never saw.
What is right is computed with 3-D vectors in 45 digits (`newton_euler_3d`), that of a motion by SciPy's DOP853. No
number in the package was chosen on one of these robots.
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import argparse
import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
from scipy.integrate import solve_ivp
from tables import table, write

import twistwrench as tw
from twistwrench import newton_euler_3d as ne
from twistwrench.advice import MM_OF_ACCELERATION, USES
from twistwrench.simulation.growth import apart
from twistwrench.validate.manifold import integrate

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "advice.json"
PAGES = (HERE.parent / "docs" / "which.md", HERE.parent / "docs" / "which.zh-CN.md")
STATES = {"mpc": 40}
MOST_STATES = 200
DIGITS = 45
mpmath.mp.dps = DIGITS

ROBOTS = {
    "kinova": lambda: tw.load("kinova"),
    "anymal_b_kinova": lambda: tw.load("anymal_b_kinova"),
    "hextilt": lambda: tw.load("hextilt"),
    "bolt": lambda: tw.load("bolt"),
    "chain of 12": lambda: tw.chain(12, mass_ratio=1e-2),
}
"""Robots of example-robot-data: an arm, a quadruped with an arm, a drone with an arm, a biped; and a chain."""

QUESTIONS: list[tuple[str, tuple[str, str], dict[str, Any]]] = [
    ("control", ("0.01 N m", "1e-20 N m"), {}),
    ("mpc", ("4 digits", "1e-8 N m/rad"), {}),
    ("sampling", ("10 mm", "1e-6 mm"), {}),
    ("verification", ("1e-6 N m", "1e-10 N m"), {"certified": True}),
    ("simulation", ("1 mm", "0.01 mm"), {"duration": 0.4}),
]


def new_states(model: tw.Model, n: int) -> list[np.ndarray]:
    """Draw states of the kind that the advice is about, others than its own."""
    rng = np.random.default_rng(38_001)
    return [model.random_configuration(n, rng=rng), *rng.standard_normal((2, n, model.nv))]


def truth(model: tw.Model, use: str, q: np.ndarray, v: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Return what is right at one state, in mpmath."""
    if use == "sampling":
        return ne.forward_dynamics(model, q, v, u)
    if use == "control":
        u = 0 * u
    here = ne.inverse_dynamics(model, q, v, u)
    if use != "mpc":
        return here
    with mpmath.workdps(2 * DIGITS):
        h = mpmath.mpf(10) ** -DIGITS
        steps = ne.as_mpmath(np.eye(model.nv)) * h
        here = ne.inverse_dynamics(model, q, v, u)
        return np.stack([(ne.inverse_dynamics(model, integrate(model, q, s), v, u) - here) / h for s in steps], axis=1)


@cache
def truths(robot: str, use: str) -> list[np.ndarray]:
    """Return what is right at each new state."""
    model = ROBOTS[robot]()
    states = zip(*new_states(model, STATES.get(use, MOST_STATES)))
    return [truth(model, use, *map(ne.as_mpmath, state)) for state in states]


def errors(robot: str, use: str, advice: Any) -> np.ndarray:
    """Return how far off the call is at each new state, in the unit of the advice."""
    model = ROBOTS[robot]()
    states = new_states(model, STATES.get(use, MOST_STATES))
    program = eval(advice.function, {"tw": tw, "model": model})
    number = "float64" if advice.number == "double-double" else advice.number
    known = dict(zip(("q", "v", "a"), states)) | {"tau": states[2]}
    found = program(*(known[name].astype(number) for name in USES[use].arguments.split()))
    bound = None
    if "bound=" in advice.function:
        found, bound = found
    first = next(iter(vars(found).values())) if hasattr(found, "__dict__") else found
    parts = [ne.as_mpmath(part) for part in (first if isinstance(first, tuple) else (first,))]
    off = list[float]()
    for k, right in enumerate(truths(robot, use)):
        error = abs(sum(part[k] for part in parts) - right)
        if bound is not None and not (error <= ne.as_mpmath(bound[k])).all():
            raise AssertionError(f"{advice.function}: a bound that is proved is exceeded in state {k}")
        size = abs(right).max() if advice.unit == "digits" else 1
        off.append(float(error.max() / size) * (MM_OF_ACCELERATION if use == "sampling" else 1))
    return np.array(off)


def distances(model: tw.Model, advice: Any, duration: float) -> np.ndarray:
    """Return how far from where it should be each new motion ends, mm: all as one differential equation."""
    q, v, _ = new_states(model, MOST_STATES)
    cut, still = q.size, np.zeros_like(v)

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        q, v = y[:cut].reshape(-1, model.nq), y[cut:].reshape(-1, model.nv)
        unit = model.normalize(q)
        q_rate = model.integrate(unit, 1e-100j * v).imag / 1e-100
        return np.concatenate([q_rate.ravel(), tw.fast.aba(model, unit, v, still).ravel()])

    start = np.concatenate([q.ravel(), v.ravel()])
    end = solve_ivp(rates, (0, duration), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:cut, -1]
    motion = eval(advice.function, {"tw": tw, "model": model, "q": q, "v": v})
    return apart(model, motion.q[-1], model.normalize(end.reshape(q.shape)))


def ask(robot: str, use: str, within: str, options: dict[str, Any]) -> dict[str, Any]:
    """Return what is promised and what is found."""
    model = ROBOTS[robot]()
    decision = tw.advise(model, use, within=within, rounds=1, **options)
    best = decision.best
    if best is None:
        return {"choice": "nothing: " + decision.instead}
    off = distances(model, best, **options) if "duration" in options else errors(robot, use, best)
    return {
        "choice": best.function,
        "number": best.number,
        "unit": best.unit,
        "allowed": decision.within,
        "promised": best.error,
        "found": float(off.max()),
        "states": len(off),
        "below the promise": int((off <= best.error).sum()),
        "below what is allowed": int((off <= decision.within).sum()),
    }


def measured(before: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield what is not known yet, with the key of its line."""
    for robot in ROBOTS:
        for use, tolerances, options in QUESTIONS:
            for within in tolerances:
                key = f"{robot} | {use} | {within}"
                if key not in before:
                    found = ask(robot, use, within, options)
                    print(f"{key} | {found}", flush=True)
                    yield key, found


def tables() -> dict[str, str]:
    """Return the table: a line for each use and tolerance, a column for each robot, and how often it is kept."""
    return {"advice": table(_cells(json.loads(RESULTS.read_text(encoding="utf-8"))))}


def _cells(found: dict[str, Any]) -> Iterator[tuple[str, str, str]]:
    for use, tolerances, options in QUESTIONS:
        for within in tolerances:
            rows = {robot: found[f"{robot} | {use} | {within}"] for robot in ROBOTS}
            line = f"`{use}`, {within}" + ", proved" * ("certified" in options)
            for robot, row in rows.items():
                yield line, robot, _cell(row)
            told = [row for row in rows.values() if "found" in row]
            kept, states = (sum(row[name] for row in told) for name in ("below the promise", "states"))
            yield line, "new states below the promise", f"{kept}/{states}"


def _cell(row: dict[str, Any]) -> str:
    """Return the choice, and the error that is promised and the largest that is found."""
    if "found" not in row:
        return "nothing"
    what = re.search(r"bound=([^)]+)|dt=([^,]+)", row["choice"])
    chosen = f"`{what[0]}`" if what else f"{row['number']}"
    return f"{chosen}: {row['promised']:.1e}, {row['found']:.1e}"


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--anew", action="store_true", help="measure all, and not what is missing")
    parser.add_argument("--tables", action="store_true", help="only the table, from results/")
    args = parser.parse_args()
    found = {} if args.anew or not RESULTS.exists() else json.loads(RESULTS.read_text(encoding="utf-8"))
    for key, row in () if args.tables else measured(found):
        found[key] = row
        RESULTS.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    write(PAGES, tables())


if __name__ == "__main__":
    main()

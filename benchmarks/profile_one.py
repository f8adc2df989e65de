"""What one state's M, h, J_c and A_G is spent on: each stage for itself, microseconds and calls of NumPy.

python benchmarks/profile_one.py        # writes results/profile_one.csv
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import csv
import time
from pathlib import Path

import numpy as np

import twistwrench as tw
from twistwrench.fast import arguments, dispatch
from twistwrench.fast import single as one
from twistwrench.study.cases import random_states

RESULTS = Path(__file__).parent / "results"


def microseconds(call, rounds: int = 25, repeat: int = 200) -> float:
    """Return the median time of a call."""
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        for _ in range(repeat):
            call()
        times.append((time.perf_counter() - start) / repeat)
    return float(np.median(times)) * 1e6


def stages() -> dict[str, object]:
    """Return a call for each stage, in the order in which they follow one another."""
    model = tw.load("go2")
    q, v, _ = random_states(model, 1).first(1)
    plan = dispatch._single_plan(model)
    contacts = dispatch._contact_rows(model, plan, model.feet)
    at = one.place(plan, q)
    J = one._inertias(plan, at)

    def momenta():
        carried = plan.sums.carried(J.reshape(-1, 16)).reshape(-1, 4, 4)
        return carried, (at.twist.reshape(-1, 4, 4) @ carried[1:]).reshape(-1, 16).mT

    carried, unit = momenta()
    felt = at.twist.dot(unit)
    parts = one.single_dynamics(plan, ("M", "h", "J_c", "A_G"), contacts, q, v)
    return {
        "input validation": lambda: arguments.validate(model, q, ("v", v)),
        "places and twists of the links": lambda: one.place(plan, q),
        "inertias seen from the base": lambda: one._inertias(plan, at),
        "h": lambda: one.forces(plan, at, J, v),
        "momenta of unit rates": momenta,
        "M": lambda: one.mass_matrix(plan, at.twist.dot(unit)),
        "A_G": lambda: one.centroidal_matrix(plan, at, felt[:6], carried[0, 3]),
        "J_c": lambda: one.contact_jacobian(at, contacts),
        "the container": lambda: tw.Dynamics(**parts),
        "all of it": lambda: tw.fast.dynamics(model, q, v),
    }


def main() -> None:
    """Print the profile and write it."""
    rows = [(name, microseconds(call)) for name, call in stages().items()]
    apart = sum(us for _, us in rows[:-1])
    rows.insert(-1, ("from stage to stage", rows[-1][1] - apart))
    with (RESULTS / "profile_one.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["stage", "us"])
        for name, us in rows:
            print(f"{name:32} {us:6.1f} µs")
            writer.writerow([name, f"{us:.2f}"])


if __name__ == "__main__":
    main()

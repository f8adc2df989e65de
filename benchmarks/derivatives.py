"""Derivatives and regressor: a compiled program beside Pinocchio called state by state, in turns, one thread.

python benchmarks/derivatives.py go2 talos_reduced    # some minutes; prints a row for each robot and question
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import sys
import time
from collections.abc import Iterator
from typing import Any

from study.record import Record, table, time_in_turns
from study.speed import random_states

import twistwrench as tw
from twistwrench.validate.oracle import Oracle

STATES = 1000
WANTED: dict[str | tuple[str, ...], str] = {
    ("dtau_dq", "dtau_dv", "M"): "computeRNEADerivatives",
    ("qdd", "dqdd_dq", "dqdd_dv", "dqdd_dtau"): "computeABADerivatives",
    "Y": "computeJointTorqueRegressor",
}
"""By what is compiled: the function of Pinocchio."""


def rows(robot: str) -> Iterator[dict[str, Any]]:
    """Yield operations, seconds until the first results by NumPy and by machine code, and times beside Pinocchio's."""
    model = tw.load(robot)
    oracle, s = Oracle(model, None), random_states(model, STATES)
    theirs = list(zip(s.q, oracle.tangent(s.v), oracle.tangent(s.a), strict=True))
    for want, name in WANTED.items():
        row: dict[str, Any] = {"robot": robot, "quantities": want if isinstance(want, str) else ", ".join(want)}
        for backend in ("numpy", "llvm"):
            start = time.process_time()
            program = tw.compile(model, want, backend=backend)
            program(*s.first(1))
            row[f"first call, {backend}"] = f"{time.process_time() - start:.1f} s"
        function, one = getattr(oracle.pin, name), s.first(1)

        def state_by_state(function: Any = function) -> None:
            for state in theirs:
                function(oracle.model, oracle.data, *state)

        batch, single, reference = time_in_turns(
            [
                (Record("", "program", states=STATES), lambda program=program: program(*s)),
                (Record("", "program"), lambda program=program, one=one: program(*one)),
                (Record("", "Pinocchio", states=STATES), state_by_state),
            ]
        )
        row |= {"operations": program.operations.total(), f"{STATES} states": batch.time, "one state": single.time}
        row |= {"Pinocchio": reference.time, "ratio": batch.seconds / reference.seconds}
        yield row | {"of one": single.seconds / reference.seconds}


if __name__ == "__main__":
    found = [row for robot in sys.argv[1:] or ["go2"] for row in rows(robot)]
    print(table(found, dict.fromkeys(found[0]), ratio=".2f", **{"of one": ".2f"}))

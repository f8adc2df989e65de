"""Derivatives and regressor: a compiled program beside Pinocchio, one thread, interleaved in one process.

Run ``python benchmarks/derivatives.py go2 talos_reduced``: a row for each robot and question, times in microseconds.
"""

import sys
import time

import numpy as np
import pinocchio as pin

import twistwrench as tw
from twistwrench import compile

STATES, ROUNDS = 1000, 15
INVERSE, FORWARD, REGRESSOR = ("dtau_dq", "dtau_dv", "M"), ("qdd", "dqdd_dq", "dqdd_dv", "dqdd_dtau"), "Y"


def measured(calls):
    """Return the times of some calls in seconds, shape (rounds, calls), one after the other in each round."""
    rounds = np.empty((ROUNDS, len(calls)))
    for times in rounds:
        for k, call in enumerate(calls):
            start = time.perf_counter()
            call()
            times[k] = time.perf_counter() - start
    return rounds


def row(model, want, args, theirs):
    """Print operations, seconds until the first results by machine code and by NumPy, and times beside Pinocchio's."""
    one, seconds = [x[0].copy() for x in args], []
    for backend in ("numpy", "llvm"):
        start = time.process_time()
        program = compile(model, want, backend=backend)
        program(*one)
        program(*args)
        seconds.append(f"{time.process_time() - start:.1f} s")

    def state_by_state():
        for _ in range(STATES // 4):
            program(*one)

    times = measured([lambda: program(*args), state_by_state, lambda: [theirs(k) for k in range(STATES // 4)]])
    batch, single, pinocchio = (times / STATES * [1, 4, 4]).T
    ratios = [np.median(x / pinocchio) for x in (batch, single)]
    micro = [1e6 * x.min() for x in (batch, single, pinocchio)]
    name = want if isinstance(want, str) else ", ".join(want)
    cells = [model.name, name, program.operations.total(), *seconds, *(f"{x:.3g}" for x in (*micro, *ratios))]
    print("|", " | ".join(map(str, cells)), "|", flush=True)


def compared(name):
    """Print the rows of a robot."""
    model, rng = tw.load(name), np.random.default_rng(0)
    there = tw.bridge.to_pinocchio_model(model)
    data = there.createData()
    q = np.stack([model.random_configuration(rng=rng) for _ in range(STATES)])
    v, a, tau = rng.standard_normal((3, STATES, model.nv))
    V, A, T = (tw.bridge.to_pinocchio_tangent(model, x) for x in (v, a, tau))
    row(model, INVERSE, (q, v, a), lambda k: pin.computeRNEADerivatives(there, data, q[k], V[k], A[k]))
    row(model, FORWARD, (q, v, tau), lambda k: pin.computeABADerivatives(there, data, q[k], V[k], T[k]))
    row(model, REGRESSOR, (q, v, a), lambda k: pin.computeJointTorqueRegressor(there, data, q[k], V[k], A[k]))


if __name__ == "__main__":
    columns = [
        "robot",
        "quantities",
        "operations",
        "first call, NumPy",
        "machine code",
        "1000 states",
        "one",
        "Pinocchio",
    ]
    print("|", " | ".join([*columns, "ratio", "ratio of one"]), "|")
    for name in sys.argv[1:] or ["go2"]:
        compared(name)

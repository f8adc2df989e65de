"""The column of times of docs/which.md: what each call takes for a Go2, the quickest of some, on one core.

usage:  python docs/pictures/which.py        (half a minute)
"""

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

import twistwrench as tw
from twistwrench import motions

GO2 = tw.load("go2")
FEET = [tw.PointContact(foot, 0.6) for foot in GO2.feet]
WARM, LEAST = 2.0, 0.5  # s of calls


def quickest(call: Callable[[], object]) -> float:
    """Return the time of a call, s: that of the quickest, after two seconds of calls, in which programs are made."""
    start = time.perf_counter()
    while time.perf_counter() - start < WARM:
        call()
    times = list[float]()
    while sum(times) < LEAST or len(times) < 3:
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def main() -> None:
    """Print the times."""
    walk = motions.walk(GO2, samples=60)
    states = walk.q[30], walk.v[30], walk.a[30]
    stands = [c for c, on in zip(FEET, walk.contacts[30]) if on]
    many = tuple(np.repeat(x, 20, axis=0) for x in (walk.q, walk.v, walk.a))
    rest, still = GO2.standing(), np.zeros(18)
    hold = np.r_[np.zeros(6), tw.static_equilibrium(GO2, rest).tau]

    running, closer = (tw.compile(GO2, "rnea", bound=bound) for bound in ("running", True))
    floats = replace(GO2, gravity=np.zeros(3))
    tumbles = rest, np.random.default_rng(0).normal(size=18)

    def moves(model: tw.Model, q: np.ndarray, v: np.ndarray, **more: object) -> float:
        """Return the time of 0.2 s of motion, for a second of it."""
        return 5 * quickest(lambda: tw.simulate(model, q, v, duration=0.2, **more))

    found = {
        "tw.fast.rnea": quickest(lambda: tw.fast.rnea(GO2, *states)),
        "tw.fast.rnea, each of 1200 states": quickest(lambda: tw.fast.rnea(GO2, *many)) / 1200,
        'bound="running"': quickest(lambda: running(*states)),
        "bound=True": quickest(lambda: closer(*states)),
        "tw.contact_inverse_dynamics": quickest(lambda: tw.contact_inverse_dynamics(GO2, *states, stands)),
        "tw.friction_inverse_dynamics": quickest(lambda: tw.friction_inverse_dynamics(GO2, *states, stands)),
        "tw.stance_margins": quickest(lambda: tw.stance_margins(GO2, rest, FEET)),
        "a second with ground=, dt = 5 ms": moves(
            GO2, rest, still, dt=0.005, tau=hold, contacts=FEET, ground=tw.Ground()
        ),
        "a second by variational, dt = 10 ms": moves(floats, *tumbles, dt=0.01, method="variational"),
        "a second by rk4, dt = 10 ms": moves(floats, *tumbles, dt=0.01),
        "cheapest, a walk of 60 states": quickest(lambda: tw.Scene(GO2, contacts=FEET).cheapest({"tau": 2.0}, walk)),
    }
    for name, took in found.items():
        print(f"{name:40} {took:.2g} s")


if __name__ == "__main__":
    main()

"""Measure how the cost of each algorithm grows with the number of links: the complexity table of the chapter's summary.

usage:  python docs/chapter/complexity.py [SMALL LARGE]     links, 60 and 240 unless given; Pinocchio does the work

Two families on a floating base: one chain of all links, and legs of three links each, like a Go2 with many legs.
"""

import sys
from timeit import repeat

import numpy as np
import pinocchio as pin

NAMES = ("RNEA", "ABA", "CRBA", "CRBA + Cholesky", "CCRBA")


def robot(links: int, legs: bool) -> pin.Model:
    """Return a floating base with a chain of links, or with legs of three links each."""
    model, placement = pin.Model(), pin.SE3(np.eye(3), np.array([0, 0, -0.4]))
    link = pin.Inertia(1.0, np.array([0, 0, -0.2]), np.diag([0.02, 0.02, 0.01]))
    base = parent = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")
    model.appendBodyToJoint(base, link, pin.SE3.Identity())
    for k in range(links):
        parent = base if legs and k % 3 == 0 else parent
        parent = model.addJoint(parent, pin.JointModelRY(), placement, f"joint {k}")
        model.appendBodyToJoint(parent, link, pin.SE3.Identity())
    return model


def times(links: int, legs: bool) -> np.ndarray:
    """Return the shortest time of each algorithm of NAMES in seconds."""
    model = robot(links, legs)
    data, q, v = model.createData(), pin.neutral(model), np.full(model.nv, 0.1)
    q[7:] = 0.3 * np.sin(np.arange(links))

    def solve():
        pin.crba(model, data, q)
        pin.cholesky.decompose(model, data)

    calls = (
        lambda: pin.rnea(model, data, q, v, v),
        lambda: pin.aba(model, data, q, v, v),
        lambda: pin.crba(model, data, q),
        solve,
        lambda: pin.computeCentroidalMap(model, data, q),
    )
    return np.array([min(repeat(call, number=5, repeat=60)) / 5 for call in calls])


def growth(small: int, large: int, legs: bool) -> np.ndarray:
    """Return the power of the number of links with which each time grows."""
    return np.log(times(large, legs) / times(small, legs)) / np.log(large / small)


def main() -> None:
    """Print the powers."""
    small, large = (int(n) for n in sys.argv[1:3]) if len(sys.argv) > 2 else (60, 240)
    chain, legs = growth(small, large, legs=False), growth(small, large, legs=True)
    print(f"{'':16} chain  legs    (time grows as links to this power, from {small} to {large} links)")
    for name, of_chain, of_legs in zip(NAMES, chain, legs, strict=True):
        print(f"{name:16} {of_chain:5.2f} {of_legs:5.2f}")


if __name__ == "__main__":
    main()

"""Exercise 49.11.2: how the cost grows with the robot."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part

from ...model import chain
from ..robots import robot, small_robot
from ..wrong import faulty

__all__ = ["EXERCISE", "count_transforms", "growth"]


def count_transforms(parent: Any) -> Any:
    """Six-vectors that RNEA and CRBA carry from frame to frame."""
    depth = [0] * len(parent)
    for i in range(1, len(parent)):
        depth[i] = depth[parent[i]] + 1
    bodies = len(parent) - 1
    return 3 * bodies, sum(depth) - bodies


def growth(sizes: Any, seconds: Any) -> Any:
    """Exponent k of t = c Nᵏ."""
    slope, _ = np.polyfit(np.log(sizes), np.log(seconds), 1)
    return slope


def _trees(rng: Any) -> Any:
    star = (-1, 0, *[1] * int(rng.integers(3, 8)))
    random = (-1, 0, *(int(rng.integers(0, i)) for i in range(2, 12)))
    return [
        (robot("go2").parent,),
        (chain(int(rng.integers(5, 15))).parent,),
        (small_robot(rng).parent,),
        (star,),
        (random,),
        (tuple(range(-1, 300)),),  # deeper than a byte counts
    ]


def _times(rng: Any) -> Any:
    """Return times that grow with a power of N, and are off by some per cent as measured ones are, of any sizes."""
    sizes = [np.array([10.0, 20, 40, 80, 160]), np.array([7.0, 30, 300]), rng.permutation(np.arange(20.0, 90, 9))]
    powers = rng.uniform([0.8, 1.8, 2.6], [1.2, 2.2, 3.2])
    return [(N, rng.uniform(1e-6, 1e-5) * N**k * rng.uniform(0.9, 1.1, len(N))) for N, k in zip(sizes, powers)]


def _again(rng: Any) -> Any:
    """Return a size that is measured twice; sizes that are whole numbers; and times of hours."""
    sizes = np.array([20.0, 20, 40, 80]), np.array([20, 40, 80, 160]), np.array([20.0, 40, 80, 160])
    return [(N, unit * N**1.5 * rng.uniform(0.8, 1.2, 4)) for N, unit in zip(sizes, (1e-6, 1e-6, 60))]


COUNT = Part(
    solution=count_transforms,
    returns=(Output("RNEA"), Output("CRBA")),
    cases=_trees,
    slips={
        "transforms-two": faulty(count_transforms, ("3 * bodies", "2 * bodies")),
        "roots-not-counted": faulty(count_transforms, ("3 * bodies", "3 * sum(d > 1 for d in depth)")),
        "world-as-body": faulty(count_transforms, ("3 * bodies", "3 * len(parent)")),
        "world-counted": faulty(count_transforms, ("sum(depth) - bodies", "sum(depth)")),
        "quadratic-always": faulty(count_transforms, ("sum(depth) - bodies", "bodies * (bodies - 1) // 2")),
        "one-for-each": faulty(count_transforms, ("sum(depth) - bodies", "sum(d > 1 for d in depth)")),
        "one-for-each-body": faulty(count_transforms, ("sum(depth) - bodies", "bodies")),
        "longest-branch": faulty(count_transforms, ("sum(depth) - bodies", "max(depth) * (max(depth) - 1) // 2")),
    },
)


GROWTH = Part(
    solution=growth,
    returns=(Output("k"),),
    cases=_times,
    edges=_again,
    slips={
        "two-points": lambda N, t: np.log(t[-1] / t[0]) / np.log(N[-1] / N[0]),
        "fit-through-first": lambda N, t: np.log(N / N[0]) @ np.log(t / t[0]) / (np.log(N / N[0]) @ np.log(N / N[0])),
        "slopes-averaged": lambda N, t: np.mean(np.diff(np.log(t)) / np.diff(np.log(N))),
        "fit-rescaled": lambda N, t: growth(N, t) * np.ptp(np.log(N)) / 2,
        "fit-unlogged": lambda N, t: np.polyfit(N, t, 1)[0],
        "fit-half-logged": lambda N, t: np.polyfit(N, np.log(t), 1)[0],
        "fit-times-unlogged": lambda N, t: np.polyfit(np.log(N), t, 1)[0],
        "fit-through-origin": lambda N, t: np.log(N) @ np.log(t) / (np.log(N) @ np.log(N)),
        "fit-intercept": lambda N, t: np.polyfit(np.log(N), np.log(t), 1)[1],
        "fit-inverted": lambda N, t: np.polyfit(np.log(t), np.log(N), 1)[0],
    },
)

EXERCISE = Exercise(id="49.11.2", kind="explain", parts=(COUNT, GROWTH))

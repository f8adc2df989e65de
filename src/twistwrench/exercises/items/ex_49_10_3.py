"""Exercise 49.10.3: when k̇_G may be left out."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part

from ..robots import states
from ..wrong import faulty

__all__ = ["EXERCISE", "com_acceleration", "rate_at_pace"]


def com_acceleration(p_G: Any, p: Any, k_rate: Any, m: Any) -> Any:
    """Horizontal acceleration of the centre of mass at constant height."""
    (x, y, z), (p_x, p_y), (k_x, k_y) = p_G, p, k_rate
    g = 9.81
    return np.array([g / z * (x - p_x) - k_y / (m * z), g / z * (y - p_y) + k_x / (m * z)])


def _by_components(p_G: Any, p: Any, k_rate: Any, m: Any) -> Any:
    return 9.81 / p_G[2] * (p_G[:2] - p) + np.array([-k_rate[1], k_rate[0]]) / (m * p_G[2])


def rate_at_pace(model: Any, q: Any, v: Any, a: Any, s: Any) -> Any:
    """k̇_G of the same motion at another pace."""
    return tw.centroidal_momentum_rate(model, q, s * v, s**2 * a)[:3]


def _by_scaling(model: Any, q: Any, v: Any, a: Any, s: Any) -> Any:
    return s**2 * tw.centroidal_momentum_rate(model, q, v, a)[:3]


def _walks(rng: Any) -> Any:
    def state() -> Any:
        p_G = np.concatenate([rng.uniform(-1, 1, 2), [10 ** rng.uniform(-1.5, 0.7)]])
        return p_G, p_G[:2] + rng.uniform(-0.2, 0.2, 2), rng.normal(scale=20, size=2), float(rng.uniform(10, 90))

    return [state() for _ in range(4)]


def _above(rng: Any) -> Any:
    """Return distances to the point below, none and a small one, each with a rate."""
    return zip((0.0, 0.005), rng.normal(scale=20, size=(2, 2)))


def _gaits(rng: Any) -> Any:
    return [
        (*state, float(rng.uniform(*paces)))
        for state, paces in zip(states(rng, vectors=2), ((0.2, 0.8), (1.5, 4), (0.02, 0.1)))
    ]


def _ground(answer: Any, p_G: Any, p: Any, k_rate: Any, m: Any) -> Any:
    """Return k̇ less the moment of the ground's force about the centre of mass, in x and y."""
    force = m * np.array([*answer, 9.81])
    return k_rate - np.cross(np.array([*p, 0.0]) - p_G, force)[:2]


def _rate(model: Any, q: Any, v: Any, a: Any) -> Any:
    return tw.centroidal_momentum_rate(model, q, v, a)


ACCELERATION = Part(
    solution=com_acceleration,
    ways=(_by_components,),
    returns=(Output("p̈_G", unit="m/s²"),),
    cases=_walks,
    edges=lambda rng: [(np.array([0.1 + x, 0.2, 0.8]), np.array([0.1, 0.2]), k, 16.0) for x, k in _above(rng)],
    slips={
        "rate-left-out": faulty(com_acceleration, (" - k_y / (m * z)", ""), (" + k_x / (m * z)", "")),
        "rate-sign": faulty(com_acceleration, ("- k_y", "+ k_y"), ("+ k_x", "- k_x")),
        "rate-axes": faulty(com_acceleration, ("- k_y", "- k_x"), ("+ k_x / (m * z)]", "+ k_y / (m * z)]")),
        "rate-reversed": faulty(com_acceleration, ("- k_y", "+ k_y")),
        "rate-subtracted": faulty(com_acceleration, ("- k_y", "- k_x"), ("+ k_x", "- k_y")),
        "rate-unturned": faulty(com_acceleration, ("- k_y", "+ k_x"), ("+ k_x / (m * z)]", "+ k_y / (m * z)]")),
        "pendulum-hangs": faulty(com_acceleration, ("[g / z", "[-g / z"), (", g / z", ", -g / z")),
        "height-dropped": faulty(com_acceleration, ("k_y / (m * z)", "k_y / m"), ("k_x / (m * z)", "k_x / m")),
        "mass-dropped": faulty(com_acceleration, ("k_y / (m * z)", "k_y / z"), ("k_x / (m * z)", "k_x / z")),
        "g-ten": faulty(com_acceleration, ("g = 9.81", "g = 10")),
        "g-rounded": faulty(com_acceleration, ("g = 9.81", "g = 9.8")),
    },
    residuals=(_ground,),
)

PACE = Part(
    solution=rate_at_pace,
    ways=(_by_scaling,),
    returns=(Output("k̇_G", unit="N m"),),
    cases=_gaits,
    slips={
        "speed-once": lambda model, q, v, a, s: s * _rate(model, q, v, a)[:3],
        "acceleration-unscaled": faulty(rate_at_pace, ("s**2 * a", "a")),
        "acceleration-scaled-once": faulty(rate_at_pace, ("s**2 * a", "s * a")),
        "rate-bias-scaled-once": faulty(
            rate_at_pace, ("tw.centroidal_momentum_rate(model, q, s * v, s**2 * a)", "s * _rate(model, q, v, s * a)")
        ),
        "velocity-unscaled": faulty(rate_at_pace, ("s * v", "v")),
        "pace-inverted": lambda model, q, v, a, s: _rate(model, q, v, a)[:3] / s**2,
        "linear-for-angular": faulty(rate_at_pace, ("[:3]", "[3:]")),
        "rate-bias-missing": lambda model, q, v, a, s: s**2 * (tw.centroidal_map(model, q) @ a)[:3],
    },
    residuals=(lambda answer, model, q, v, a, s: answer - s**2 * _rate(model, q, v, a)[:3],),
)

EXERCISE = Exercise(id="49.10.3", kind="explain", parts=(ACCELERATION, PACE))

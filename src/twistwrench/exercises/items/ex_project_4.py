"""The project, stage 4: does it all hold together, and how long does it take."""

from collections.abc import Callable
from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import times
from misstep.text import Text

from ..robots import held_acceleration, robot, small_robot
from ..wrong import faulty
from .project_timing import TIME

__all__ = ["EXERCISE", "consistency_error", "vertical_loads"]


def vertical_loads(p_G: Any, feet: Any, weight: Any) -> Any:
    """Vertical forces on the feet that hold a weight, those of least norm."""
    levers = np.array([np.ones(len(feet)), feet[:, 0] - p_G[0], feet[:, 1] - p_G[1]])
    return np.linalg.lstsq(levers, np.array([weight, 0, 0]))[0]


def consistency_error(forward: Any, inverse: Any, model: Any, q: Any, v: Any, tau: Any) -> Any:
    """Largest error of the recovered forces, relative to the largest force."""
    back = inverse(model, q, v, forward(model, q, v, tau))
    return np.abs(back - tau).max() / np.abs(tau).max()


# ---------------------------------------------------------------- loads


def _standings(rng: Any) -> Any:
    """Return centres of mass over three to five feet, and one beside them: a foot must pull."""

    def stand(n: int, shares: Any = None) -> Any:
        angles = np.sort(rng.uniform(0, 2 * np.pi, n))
        feet = np.column_stack([0.3 * np.cos(angles), 0.2 * np.sin(angles), np.zeros(n)]) + rng.uniform(-1, 1, 3)
        p_G = (rng.dirichlet(np.ones(n)) if shares is None else shares) @ feet + [0, 0, 0.3]
        return p_G, feet, float(rng.uniform(100, 300))

    return [*map(stand, (4, 4, 3, 5)), stand(3, np.array([0.7, -0.3, 0.6]))]


def _in_line(rng: Any) -> Any:
    """Return centres of mass over one to three feet in a line, with numbers of few digits: exactly in a line."""

    def stand(*shares: float) -> Any:
        first, along = rng.integers(-32, 32, (2, 2)) / 32
        feet = np.array([[*first + k * along, 0.0] for k in range(len(shares))])
        return np.array(shares) @ feet + [0, 0, 0.25], feet, float(rng.uniform(100, 300))

    return [stand(0.25, 0.75), stand(0.5, 0.25, 0.25), stand(1.0)]


def _by_nearness(p_G: Any, feet: Any, weight: Any) -> Any:
    near = 1 / np.hypot(*(feet - p_G).mT[:2])
    return weight * near / near.sum()


def _pushing(p_G: Any, feet: Any, weight: Any) -> Any:
    return np.maximum(vertical_loads(p_G, feet, weight), 0)


def _rescaled(p_G: Any, feet: Any, weight: Any) -> Any:
    loads = _pushing(p_G, feet, weight)
    return weight * loads / loads.sum()


def _axis_by_axis(p_G: Any, feet: Any, weight: Any) -> Any:
    """Let each axis have its own sum of squares, as if x and y were not correlated."""
    levers, d = (feet - feet.mean(0))[:, :2], (p_G - feet.mean(0))[:2]
    return weight * (1 / len(feet) + levers @ (d / (levers**2).sum(0)))


LOADS = Part(
    solution=vertical_loads,
    returns=(Output("f_z", unit="N"),),
    cases=_standings,
    edges=_in_line,
    slips={
        "equal-shares": lambda p_G, feet, weight: np.full(len(feet), weight / len(feet)),
        "moment-about-origin": faulty(
            vertical_loads, ("feet[:, 0] - p_G[0], feet[:, 1] - p_G[1]", "feet[:, 0], feet[:, 1]")
        ),
        "two-origins": lambda p_G, feet, weight: vertical_loads(p_G + feet.mean(0), feet, weight),
        "shared-by-nearness": _by_nearness,
        "pull-dropped": _pushing,
        "pull-rescaled": _rescaled,
        "height-balanced": lambda p_G, feet, weight: np.linalg.lstsq(
            np.vstack([np.ones(len(feet)), feet.mT]), weight * np.array([1, *p_G])
        )[0],
        "axes-uncoupled": _axis_by_axis,
        "moment-of-one-axis": faulty(vertical_loads, (", feet[:, 1] - p_G[1]", ""), ("[weight, 0, 0]", "[weight, 0]")),
        "force-sign": times(vertical_loads, -1),
        "mass-for-weight": times(vertical_loads, 1 / 9.81),
        "not-shared": lambda p_G, feet, weight: np.full(len(feet), weight),
    },
    residuals=(
        lambda answer, p_G, feet, weight: answer.sum() - weight,
        lambda answer, p_G, feet, weight: (answer @ feet / weight - p_G)[:2],
    ),
)

# ---------------------------------------------------------------- consistency


def _round_trip(forward: Any, inverse: Any, model: Any, q: Any, v: Any, tau: Any) -> Any:
    a = forward(model, q, v, tau)
    back = inverse(model, q, v, a)
    if np.isnan(back).any():
        return np.nan
    again = forward(model, q, v, back)
    return np.abs(again - a).max() / np.abs(a).max()


class Variant:
    """Forward dynamics with something wrong in it."""

    def __init__(self, name: Text, function: Callable[..., Any]) -> None:
        self.name, self._function = name, function

    def __call__(self, *arguments: Any) -> Any:
        """Compute it."""
        return self._function(*arguments)


RIGHT = Variant(Text("right", "正确"), tw.aba)
INVERSE = Variant(Text("right", "正确"), tw.rnea)
FLOATING = Variant(
    Text("no gravity", "无重力"), lambda model, q, v, tau: tw.aba(model, q, v, tau + tw.gravity(model, q))
)
STILL = Variant(Text("no velocity terms", "无速度项"), lambda model, q, v, tau: tw.aba(model, q, 0 * v, tau))

OPPOSITE = Variant(
    Text("forces of the opposite sign", "力的符号相反"), lambda model, q, v, tau: tw.aba(model, q, v, -tau)
)


def _less(part: float, row: int = 4) -> Variant:
    """Return forward dynamics under torques of which one is too small, by a part of the largest."""

    def forward(model: Any, q: Any, v: Any, tau: Any) -> Any:
        short = np.array(tau)
        short[row] -= part * np.abs(tau).max()
        return tw.aba(model, q, v, short)

    return Variant(Text(f"off by {part:.0e}", f"相差 {part:.0e}"), forward)


def _without_number(model: Any, q: Any, v: Any, a: Any) -> Any:
    return np.nan * tw.rnea(model, q, v, a)


def _partly_a_number(model: Any, q: Any, v: Any, a: Any) -> Any:
    tau = tw.rnea(model, q, v, a)
    tau[len(tau) // 2] = np.nan
    return tau


BROKEN = Variant(Text("not a number", "不是数"), _without_number)
PARTLY = Variant(Text("one entry is not a number", "一个元素不是数"), _partly_a_number)
RESTING = Variant(Text("no velocity terms", "无速度项"), lambda model, q, v, a: tw.rnea(model, q, 0 * v, a))
HELD = Variant(Text("base held", "基座固定"), held_acceleration)


def _states(rng: Any) -> Any:
    """Return states, with a forward dynamics that is right or has one of three faults, and a faulty inverse one."""
    cases = []
    for forward, model in zip(
        (RIGHT, FLOATING, STILL, HELD), (robot("go2"), robot("go2"), small_robot(rng), small_robot(rng))
    ):
        tau = np.concatenate([np.zeros(6), 10 * rng.standard_normal(model.nv - 6)])
        cases.append((forward, INVERSE, model, model.random_configuration(rng=rng), rng.standard_normal(model.nv), tau))
    slight = [(_less(part), INVERSE, *cases[0][2:]) for part in (1e4, 1e-2, 1e-4, 1e-6, 1e-8)]
    slight.append((_less(1e-8, -1), INVERSE, *cases[0][2:]))
    return [
        *cases,
        (RIGHT, RESTING, *cases[0][2:]),
        (OPPOSITE, INVERSE, *cases[0][2:]),
        *slight,
        *((RIGHT, one, *cases[0][2:]) for one in (BROKEN, PARTLY)),
    ]


CONSISTENCY = Part(
    solution=consistency_error,
    returns=(Output("error", zh="误差"),),
    cases=_states,
    canonical=lambda answer, *_: float(answer) if np.isfinite(answer) else -1.0,
    rtol=1e-7,
    slips={
        "error-signed": faulty(consistency_error, ("np.abs(back - tau)", "(back - tau)")),
        "error-absolute": faulty(consistency_error, (" / np.abs(tau).max()", "")),
        "error-by-norms": faulty(
            consistency_error,
            ("np.abs(back - tau).max() / np.abs(tau).max()", "np.linalg.norm(back - tau) / np.linalg.norm(tau)"),
        ),
        "sizes-compared": faulty(consistency_error, ("np.abs(back - tau)", "np.abs(np.abs(back) - np.abs(tau))")),
        "scale-signed": faulty(consistency_error, ("np.abs(tau).max()", "tau.max()")),
        "accelerations-compared": _round_trip,
        "error-averaged": faulty(consistency_error, ("np.abs(back - tau).max()", "np.abs(back - tau).mean()")),
        "error-of-joints": faulty(consistency_error, ("np.abs(back - tau)", "np.abs(back - tau)[6:]")),
        "nan-lost": faulty(
            consistency_error, ("np.abs(back - tau).max()", "np.abs(back - tau).max(where=back == back, initial=0.0)")
        ),
        "assumed": lambda forward, inverse, model, q, v, tau: 0.0,
    },
)

EXERCISE = Exercise(id="project.4", kind="explain", parts=(LOADS, CONSISTENCY, TIME))

"""What `tw.motion_error` says of eight motions, and how far off they are: against the same motions in 50 digits.

python benchmarks/motion_errors.py            # what is not in results/ yet, and the table of docs/simulation
python benchmarks/motion_errors.py --anew     # all, ten minutes
python benchmarks/motion_errors.py --tables   # only the table

The truth is integrated by extrapolation of the midpoint rule (W. B. Gragg 1965, R. Bulirsch and J. Stoer 1966) with
accelerations of `newton_euler_3d`, all in 50 digits: no formula and no number of it is that of the simulation.
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import argparse
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import mpmath
import numpy as np
from tables import table, write_each

import twistwrench as tw
from twistwrench import newton_euler_3d as ne
from twistwrench.model import FreeFlyer, Spherical
from twistwrench.newton_euler_3d.bodies import cross
from twistwrench.simulation.growth import apart

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "motion_errors.json"
PAGES = {language: HERE.parent / "docs" / f"simulation{language}.md" for language in ("", ".zh-CN")}
DIGITS = 50
COLUMNS = 14
"""Of the extrapolation: its order is twice that."""
ENOUGH = 1e-16
"""What the last column may change in a step, rad, m or their rates."""

Policy = Callable[[Any, np.ndarray, np.ndarray], np.ndarray]


class Motion(NamedTuple):
    """A start, how long it moves, under which forces; the steps of the simulation; and that of the extrapolation, s."""

    model: tw.Model
    q: np.ndarray
    v: np.ndarray
    duration: float
    dt: float
    long: float
    tau: Policy | None = None


def _pendulum(angle: float, duration: float, dt: float) -> Motion:
    return Motion(tw.load("pendulum"), np.array([angle]), np.zeros(1), duration, dt, 0.125)


def _double_pendulum() -> Motion:
    return Motion(tw.load("double_pendulum"), np.array([2.0, 0.3]), np.zeros(2), 1.5, 0.001, 0.015625)


def _middle_axis() -> Motion:
    body = tw.SpatialInertia(2.0, [0.1, 0, 0], np.diag([0.02, 0.05, 0.06]))
    model = tw.Builder("book", base="floating", root="book", root_inertia=body, gravity=(0, 0, 0)).build()
    return Motion(model, model.neutral(), np.array([0.01, 6.0, 0.01, 0.2, 0, 0.1]), 2.0, 0.01, 0.125)


def _top() -> Motion:
    builder = tw.Builder("top")
    body = tw.SpatialInertia(0.3, [0, 0, 0.05], np.diag([2e-4, 2e-4, 1e-4]))
    builder.link("top", parent="base_link", joint=tw.Spherical(), inertia=body)
    return Motion(builder.build(), np.array([0.2, 0, 0, np.sqrt(0.96)]), np.array([0, 0, 100.0]), 0.25, 0.002, 0.0125)


def _go2() -> Motion:
    model = tw.load("go2")
    v = np.random.default_rng(38).standard_normal(18)
    return Motion(model, model.standing(), v, 0.2, 0.01, 0.1)


def _arm() -> Motion:
    goal = np.array([1.0, -0.5, 0.2])

    def hold(t: Any, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        return -20.0 * (q - goal) - 0.5 * v

    return Motion(tw.load("planar_arm"), np.array([0.3, 0.6, 0.9]), np.zeros(3), 0.5, 0.005, 0.015625, hold)


def _cart() -> Motion:
    def shaken(t: Any, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        swing = mpmath.sin(3 * t) if isinstance(t, mpmath.mpf) else np.sin(3 * t)
        return np.array([4 * swing - v[0], 0 * v[0]])

    return Motion(tw.load("cart_pole"), np.array([0.0, 0.5]), np.zeros(2), 2.0, 0.01, 0.0625, shaken)


MOTIONS: dict[str, tuple[str, Callable[[], Motion]]] = {
    "a pendulum swings": ("摆来回摆动", lambda: _pendulum(2.0, 5.0, 0.01)),
    "a pendulum begins upright": ("摆从倒立开始", lambda: _pendulum(np.pi, 8.0, 0.002)),
    "a double pendulum tumbles": ("双摆翻转", _double_pendulum),
    "a book turns about its middle axis": ("书本绕中间惯量轴转动", _middle_axis),
    "a heavy top spins at 100 rad/s": ("重陀螺以 100 rad/s 自转", _top),
    "a Go2 falls and kicks": ("Go2 自由下落，腿在摆动", _go2),
    "an arm is held by PD": ("由 PD 控制的机械臂", _arm),
    "a cart is shaken under its pole": ("小车晃动，摆杆随动", _cart),
}
METHODS = ("rk4", "midpoint", "semi-implicit")
WORDS = {
    "": {"for": "for", "dt": "dt", "growth": "growth", "of": "{}: said", "found": "{}: found"},
    ".zh-CN": {"for": "时长", "dt": "dt", "growth": "放大倍数", "of": "{}：估计", "found": "{}：实际"},
}


def rates(model: tw.Model, q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return q̇, of balls and floating bases by quaternions of any length."""
    found = v[:0]
    for joint, at_q, at_v in zip(model.joints[1:], model.q_slice[1:], model.v_slice[1:]):
        if not isinstance(joint, FreeFlyer | Spherical):
            found = np.concatenate([found, v[at_v]])
            continue
        w, (x, y, z, s) = v[at_v][:3], q[at_q][-4:]
        turn = np.array([[s, -z, y], [z, s, -x], [-y, x, s], [-x, -y, -z]])
        if isinstance(joint, FreeFlyer):
            u, more = np.array([x, y, z]), v[at_v][3:]
            once = cross(u, more)
            found = np.concatenate([found, more + 2 * (s * once + cross(u, once)) / (q[at_q][-4:] ** 2).sum()])
        found = np.concatenate([found, turn @ w / 2])
    return found


def unit(model: tw.Model, q: np.ndarray) -> np.ndarray:
    """Return q with quaternions of length 1."""
    q = q.copy()
    for joint, at in zip(model.joints[1:], model.q_slice[1:]):
        if isinstance(joint, FreeFlyer | Spherical):
            last = slice(at.stop - 4, at.stop)
            q[last] = q[last] / mpmath.sqrt((q[last] ** 2).sum())
    return q


def truth(motion: Motion) -> np.ndarray:
    """Return q at the end, in 50 digits."""
    model, nq = motion.model, motion.model.nq

    def f(t: Any, y: np.ndarray) -> np.ndarray:
        q, v = unit(model, y[:nq]), y[nq:]
        tau = 0 * v if motion.tau is None else motion.tau(t, q, v)
        return np.concatenate([rates(model, q, v), ne.forward_dynamics(model, q, v, tau)])

    with mpmath.workdps(DIGITS):
        steps = round(motion.duration / motion.long)
        H = mpmath.mpf(motion.duration) / steps
        y = ne.as_mpmath(np.concatenate([motion.q, motion.v]))
        for k in range(steps):
            y = extrapolated(f, k * H, y, H)
        return unit(model, y[:nq])


def extrapolated(f: Callable[[Any, np.ndarray], np.ndarray], t: Any, y: np.ndarray, H: Any) -> np.ndarray:
    """Return y after a step H: midpoint rules of 2, 4, 6, … parts, extrapolated to infinitely many."""
    slope = f(t, y)
    row: list[np.ndarray] = []
    for j in range(1, COLUMNS + 1):
        h = H / (2 * j)
        before, now = y, y + h * slope
        for k in range(1, 2 * j):
            before, now = now, before + 2 * h * f(t + k * h, now)
        new = [now]
        for k in range(1, j):
            new.append(new[-1] + (new[-1] - row[k - 1]) / (mpmath.mpf(j) ** 2 / (j - k) ** 2 - 1))
        last, row = row, new
    if abs(row[-1] - last[-1]).max() > ENOUGH:
        raise ArithmeticError(f"the extrapolation still changes by {float(abs(row[-1] - last[-1]).max()):.1e}")
    return row[-1]


def measure(name: str) -> dict[str, Any]:
    """Return what is said of a motion and what is found, mm."""
    motion = MOTIONS[name][1]()
    right = truth(motion).astype(float)
    found: dict[str, Any] = {"duration": motion.duration, "dt": motion.dt}
    for method in METHODS:
        options = {"dt": motion.dt, "duration": motion.duration, "method": method, "tau": motion.tau}
        said = tw.motion_error(motion.model, motion.q, motion.v, **options)
        end = tw.simulate(motion.model, motion.q, motion.v, **options).q[-1]
        off = float(apart(motion.model, end, right))
        found[method] = {"said": float(said.total), "found": off, "growth": float(said.growth)}
    return found


def tables(language: str) -> dict[str, str]:
    """Return the table of a page."""
    found = json.loads(RESULTS.read_text(encoding="utf-8"))
    return {"motions": table(cell for name in MOTIONS for cell in _cells(name, found[name], language))}


def _cells(name: str, row: dict[str, Any], language: str) -> Iterator[tuple[str, str, str]]:
    line, words = (MOTIONS[name][0] if language else name), WORDS[language]
    yield line, words["for"], f"{row['duration']:g} s"
    yield line, words["dt"], f"{1e3 * row['dt']:g} ms"
    yield line, words["growth"], f"{row['rk4']['growth']:.2g}"
    for method in METHODS:
        yield line, words["of"].format(f"`{method}`"), f"{row[method]['said']:.1e}"
        yield line, words["found"].format(f"`{method}`"), f"{row[method]['found']:.1e}"


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tables", action="store_true", help="only the table, from results/")
    parser.add_argument("--anew", action="store_true", help="measure all, and not what is missing")
    args = parser.parse_args()
    found = {} if args.anew or not RESULTS.exists() else json.loads(RESULTS.read_text(encoding="utf-8"))
    for name in () if args.tables else [name for name in MOTIONS if name not in found]:
        found[name] = measure(name)
        RESULTS.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    write_each(PAGES, tables)


if __name__ == "__main__":
    main()

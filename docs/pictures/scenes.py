"""The numbers and pictures of docs/scenes.md: Talos with held arms, and the cheapest model of a walk.

usage:  python docs/pictures/scenes.py        (half a minute; needs example-robot-data and matplotlib)
"""

import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

import twistwrench as tw
from twistwrench import motions
from twistwrench.plot import COLOURS, axes_2d

HERE = Path(__file__).parent
HOLD = ["arm_*", "gripper_*", "head_*"]
LEGS = ["leg_*"]
RATES = (0.0, 0.1, 1.0, 3.0)
STATES = 200
ROUNDS = 60
SAMPLES = 60


class Moving:
    """Talos whose held joints move after all: 200 states, legs and torso bent by ±0.3 rad and turning at ±1 rad/s."""

    def __init__(self, scene: tw.Scene) -> None:
        rng = np.random.default_rng(0)
        model, full = scene.model, scene.full_model
        bent = rng.uniform(-0.3, 0.3, (STATES, model.nv)) * scene.actuated
        self.full, self.model = full, model
        self.q, self.v = model.integrate(model.standing(), bent), rng.uniform(-1, 1, (STATES, model.nv))
        held = [full.v_slice[full.joint_id(name)].start for name in scene.held]
        self.kept = np.setdiff1d(np.arange(full.nv), held)
        self.Q, self.V = scene.expand(self.q, self.v)
        self.sway = rng.choice([-1.0, 1.0], (STATES, full.nv))
        self.sway[:, self.kept] = 0

    def errors(self, rate: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the largest error of a motor's torque, at once and 0.1 s later, N m, and that of k_G as a share."""
        V = self.V + rate * self.sway
        later = self.full.integrate(self.Q, 0.1 * rate * self.sway)
        ours = tw.nonlinear_effects(self.model, self.q, self.v)[:, 6:]
        now, then = (
            np.abs(tw.nonlinear_effects(self.full, Q, V)[:, self.kept[6:]] - ours).max(axis=1) for Q in (self.Q, later)
        )
        k, k_small = tw.centroidal_momentum(self.full, self.Q, V), tw.centroidal_momentum(self.model, self.q, self.v)
        return now, then, np.hypot.reduce((k - k_small)[:, :3], axis=1) / np.hypot.reduce(k[:, :3], axis=1)


def ratio(small: Callable[[], object], full: Callable[[], object]) -> float:
    """Return how many times longer the full model takes: the quickest of many turns each, one right after the other."""
    pairs = np.empty((ROUNDS, 2))
    for pair in pairs:
        for k, call in enumerate((small, full)):
            start = time.process_time()
            call()
            pair[k] = time.process_time() - start
    small_time, full_time = pairs.min(axis=0)
    return float(full_time / small_time)


def held_arms(scene: tw.Scene) -> None:
    """Print what held arms cost that move after all, and draw it."""
    moving = Moving(scene)
    print("| rad/s | torque, median | worst | 0.1 s later, median | worst | k_G, median | worst |")
    ax = axes_2d(size=(6.0, 3.6))
    rates = np.geomspace(0.03, 5, 12)
    of = [[np.median(x) for x in moving.errors(rate)[:2]] for rate in rates]
    for k, (label, colour) in enumerate((("at once", "blue"), ("0.1 s later", "orange"))):
        ax.loglog(rates, [x[k] for x in of], "o-", color=COLOURS[colour], label=label)
    ax.set(xlabel="speed of the held joints [rad/s]", ylabel="largest error of a torque [N m]")
    ax.set_title("Talos, arms and head taken for still")
    ax.grid(alpha=0.3)
    ax.legend()
    ax.figure.savefig(HERE / "scenes_held.png", dpi=110)
    for rate in RATES:
        now, then, k = moving.errors(rate)
        print(f"| {rate:g} | " + " | ".join(f"{f(x):.2g}" for x in (now, then, k) for f in (np.median, np.max)) + " |")


def time_saved(scene: tw.Scene) -> None:
    """Print how much longer the full model takes."""
    full, small = scene.full_model, scene.model
    rng = np.random.default_rng(1)
    V = rng.standard_normal((1000, full.nv))
    Q = full.integrate(full.standing(), 0.1 * V)
    q, v = scene.reduce(Q, V)
    calls = {
        "rnea": lambda model, q, v: tw.rnea(model, q, v, v),
        "aba": lambda model, q, v: tw.aba(model, q, v, v),
        "crba": lambda model, q, v: tw.crba(model, q),
        "fast.rnea": lambda model, q, v: tw.fast.rnea(model, q, v, v),
        "fast.aba": lambda model, q, v: tw.fast.aba(model, q, v, v),
        "fast.dynamics, M and h": lambda model, q, v: tw.fast.dynamics(model, q, v, want={"M", "h"}),
    }
    for name, call in calls.items():
        one = ratio(lambda: call(small, q[0], v[0]), lambda: call(full, Q[0], V[0]))  # noqa: B023
        many = f"{ratio(lambda: call(small, q, v), lambda: call(full, Q, V)):.1f}" if "fast" in name else ""  # noqa: B023
        print(f"| `{name}` | {one:.1f} | {many} |")


def cheapest(scene: tw.Scene) -> None:
    """Print the table of a walk and draw it."""
    found = scene.cheapest(
        {"tau": 2.0, "of": LEGS, "cop": 0.005}, motions.walk(scene.full_model), held_out=motions.trot(scene.full_model)
    )
    print(found)
    found.plot().figure.savefig(HERE / "scenes_cheapest.png", dpi=110)


def some_motions(
    robot: str,
) -> tuple[tw.Model, dict[str, Any], dict[str, list[str]] | None, list[motions.Motion], list[motions.Motion]]:
    """Return a robot, what is needed of it, groups of joints, the motions to choose on and those held out."""
    model = tw.load(robot)
    if robot in ("panda", "iris"):
        rng, pace = np.random.default_rng(0), {"panda": 1.5, "iris": 1.0}[robot]
        ends = model.neutral() if robot == "iris" else np.clip(model.neutral(), model.lower, model.upper)
        goals = [model.integrate(ends, rng.uniform(-0.6, 0.6, model.nv)) for _ in range(5)]
        if robot == "panda":
            goals = [np.clip(q, model.lower, model.upper) for q in goals]
        ways = [motions.reach(model, a, b, duration=pace, samples=SAMPLES) for a, b in pairwise(goals)]
        groups = {
            "panda": {"fingers": ["*finger*"], "wrist": ["*joint6", "*joint7"]},
            "iris": {"rotors": ["*rotor*"]},
        }[robot]
        return (
            model,
            {"tau": 2.0, "of": ["panda_joint[1-5]"]} if robot == "panda" else {"wrench": 0.01},
            groups,
            ways[:2],
            ways[2:],
        )
    speed, need = {
        "go2": (0.07, {"wrench": 0.05, "cop": 0.01}),
        "talos_reduced": (0.23, {"tau": 2.0, "of": LEGS, "cop": 0.005}),
        "humanoid": (0.19, {"tau": 0.2, "of": ["*_hip_*", "*_knee", "*_ankle_*"], "cop": 0.001}),
    }[robot]
    seen = [motions.walk(model, samples=SAMPLES, speed=share * speed) for share in (0.7, 1.0)]
    other = [
        {"speed": 1.25 * speed},
        {"speed": 0.9 * speed, "direction": 0.4},
        {"speed": speed, "step_length": 0.8 * speed * seen[1].t[-1]},
    ]
    return model, need, None, seen, [motions.walk(model, samples=SAMPLES, **gait) for gait in other]


def held_out() -> None:
    """Print what was promised and what was found on motions that the choice was not made on."""
    for robot in ("go2", "talos_reduced", "humanoid", "panda", "iris"):
        model, need, groups, seen, unseen = some_motions(robot)
        for margin in (1.0, 1.5):
            found = tw.Scene(model).cheapest(need, seen, held_out=unseen, margin=margin, groups=groups)
            best = found.best
            for name, most in found.tolerance.items():
                unit = {"cop": 1e3}.get(name, 1)
                said = (unit * x for x in (most, best.worst(name), best.worst(name, held_out=True)))
                numbers = " | ".join(f"{0 if x < 1e-9 else x:.2g}" for x in said)
                print(f"| {robot} | {margin:g} | {best.name} | {name} | {numbers} |")


def main() -> None:
    """Print all tables and write all pictures."""
    mpl.use("agg")
    talos = tw.load("talos_reduced")
    scene = tw.Scene(talos, contacts=[tw.SurfaceContact(foot, (0.1, 0.06), mu=0.7) for foot in talos.feet], hold=HOLD)
    print(scene)
    held_arms(scene)
    time_saved(scene)
    cheapest(scene)
    held_out()


if __name__ == "__main__":
    main()

"""The numbers and pictures of docs/simulation.md: what each method of `tw.simulate` loses, over dt and over its cost.

usage:  python docs/pictures/simulation.py        (some five minutes; needs matplotlib)
"""

import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np

import twistwrench as tw
from twistwrench.plot import COLOURS, axes_2d
from twistwrench.simulation import METHODS, Simulation

HERE = Path(__file__).parent
LOOK = {
    "euler": ("grey", "v"),
    "semi-implicit": ("orange", "s"),
    "midpoint": ("green", "^"),
    "rk4": ("blue", "o"),
    "variational": ("vermilion", "D"),
}


class Example(NamedTuple):
    """A motion, and by what its error is told."""

    title: str
    model: tw.Model
    q: np.ndarray
    v: np.ndarray
    duration: float
    steps: Sequence[float]
    label: str
    error: Callable[[Simulation], float]
    tau: Callable[..., np.ndarray] | None = None
    contacts: Iterable[tw.PointContact] = ()

    def run(self, method: str, dt: float) -> Simulation:
        """Simulate."""
        start = {"dt": dt, "duration": self.duration, "tau": self.tau, "contacts": self.contacts}
        return tw.simulate(self.model, self.q, self.v, method=method, **start)  # type: ignore[arg-type]


def energy_drift(scale: float) -> Callable[[Simulation], float]:
    """Return the largest change of the energy, as a share of a scale."""
    return lambda s: float(np.abs(s.energy - s.energy[0]).max()) / scale


def pendulum() -> Example:
    """Let go at 2 rad, for 10 s."""
    model = tw.load("pendulum")
    scale = float(tw.potential_energy(model, [2.0]) - tw.potential_energy(model, [0.0]))
    return Example(
        "pendulum", model, np.array([2.0]), np.zeros(1), 10.0, STEPS, "energy drift / its swing", energy_drift(scale)
    )


def double_pendulum() -> Example:
    """Let go at 1 and 0.5 rad, for 10 s."""
    model, q = tw.load("double_pendulum"), np.array([1.0, 0.5])
    scale = float(tw.potential_energy(model, q) - tw.potential_energy(model, [0.0, 0.0]))
    return Example(
        "double pendulum", model, q, np.zeros(2), 10.0, STEPS, "energy drift / its swing", energy_drift(scale)
    )


def tumbling_body() -> Example:
    """Turn a body about its middle axis, so that it tumbles, for 10 s, without weight."""
    inertia = tw.SpatialInertia(2.0, np.zeros(3), np.diag([1.0, 2.0, 3.0]))
    model = tw.Builder("body", base="floating", root_inertia=inertia, gravity=np.zeros(3)).build()
    v = np.array([0.1, 2.0, 0.1, 0.0, 0.0, 0.0])
    scale = float(tw.kinetic_energy(model, model.neutral(), v))
    return Example(
        "tumbling body", model, model.neutral(), v, 10.0, STEPS, "energy drift / energy", energy_drift(scale)
    )


def standing_go2() -> Example:
    """Push a Go2 on four feet, whose motors hold its posture by springs and dampers, for 0.4 s."""
    model = tw.load("go2")
    posture, feet = model.standing(), [tw.PointContact(foot, 0.6) for foot in model.feet]
    hold = tw.static_equilibrium(model, posture).tau

    def policy(t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        tau = np.zeros(model.nv)
        tau[6:] = hold - 60.0 * (q[7:] - posture[7:]) - 1.0 * v[6:]
        return tau

    v = tw.impact(model, posture, np.array([0, 0, 0, 0.5, 0.3] + 13 * [0.0]), feet).v
    start = {"dt": 0.000625, "duration": 0.4, "tau": policy, "contacts": feet}
    exact = tw.simulate(model, posture, v, **start).q[-1]  # type: ignore[arg-type]

    def error(s: Simulation) -> float:
        return float(np.abs(s.q[-1, :3] - exact[:3]).max())

    steps = (0.02, 0.01, 0.005, 0.0025)
    return Example(
        "Go2 on its feet", model, posture, v, 0.4, steps, "error of the base's place [m]", error, policy, feet
    )


STEPS = (0.1, 0.05, 0.02, 0.01, 0.005)


def measure(example: Example) -> dict[str, list[tuple[float, float, float]]]:
    """Return for each method (dt, processor time for a second of motion, error), and print it as rows of a table."""
    found: dict[str, list[tuple[float, float, float]]] = {}
    for name in LOOK:
        if example.contacts and not METHODS[name].contacts:
            continue
        for dt in example.steps:
            start = time.process_time()
            try:
                s = example.run(name, dt)
            except (tw.DivergenceError, tw.SingularError):
                continue
            spent = (time.process_time() - start) / example.duration
            found.setdefault(name, []).append((dt, spent, example.error(s)))
        shown = {dt: f"{error:.1e}" for dt, _, error in found.get(name, [])}
        cells = [shown.get(dt, "diverges") for dt in example.steps]
        print(f"| {example.title} | `{name}` | {' | '.join(cells)} |", flush=True)
    return found


def draw(examples: list[Example], results: list[dict[str, list[tuple[float, float, float]]]], column: int) -> Any:
    """Draw the error of each example over dt (column 0) or over the processor time (column 1)."""
    import matplotlib.pyplot as plt
    from matplotlib.ticker import LogLocator, NullLocator

    figure, axes = plt.subplots(2, 2, figsize=(8.5, 6.6), layout="constrained")
    for ax, example, result in zip(axes.flat, examples, results, strict=True):
        for name, rows in result.items():
            colour, marker = LOOK[name]
            x, y = [row[column] for row in rows], [max(row[2], 1e-16) for row in rows]
            ax.loglog(x, y, marker=marker, color=COLOURS[colour], label=name, markersize=5)
        ax.set(title=example.title, ylabel=example.label)
        ax.set_xlabel(("dt [s]", "processor time for 1 s of motion [s]")[column])
        ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        ax.xaxis.set_major_formatter("{x:g}")
        ax.xaxis.set_minor_locator(NullLocator())
        ax.grid(alpha=0.3)
    handles, labels = axes.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5)
    return figure


def long_run() -> None:
    """Draw the energy of a pendulum over 300 s at a dt of 0.2 s."""
    model, ax = tw.load("pendulum"), axes_2d(size=(7.0, 3.4))
    for name, alpha in (("semi-implicit", 0.4), ("rk4", 1.0), ("variational", 1.0)):
        s = tw.simulate(model, [2.0], [0.0], dt=0.2, steps=1500, method=name)
        change = s.energy - s.energy[0]
        ax.plot(s.t, change, color=COLOURS[LOOK[name][0]], label=name, linewidth=1.0, alpha=alpha)
        part = len(change) // 10
        first, last = np.abs(change[:part]).max(), np.abs(change[-part:]).max()
        print(f"| `{name}` | {first:.2g} | {last:.2g} |", flush=True)
    ax.set(xlabel="time [s]", ylabel="change of the energy [J]", title="pendulum, dt = 0.2 s", ylim=(-7.5, 7.5))
    ax.grid(alpha=0.3)
    ax.legend(loc="upper center", ncols=3)
    ax.figure.savefig(HERE / "simulation_long.png", dpi=110)


def kept_momentum() -> None:
    """Print how well each method keeps the angular momentum about the origin of a robot that tumbles without weight."""
    scene = tw.Scene("go2", gravity=[0, 0, 0])
    v = np.random.default_rng(0).standard_normal(scene.model.nv)
    for name in LOOK:
        s = tw.simulate(scene, scene.model.standing(), v, dt=0.01, steps=100, method=name)
        h = s.momentum_about_origin[:, :3]
        change = np.abs(h - h[0]).max() / np.abs(h[0]).max()
        print(f"| `{name}` | {change:.1e} | {s.evaluations / 100:.1f} |", flush=True)


def flown_ball(method: str, dt: float) -> float:
    """Return how far a ball without weight, at 3.5 m/s and 35 rad/s, is from its straight line after 2 s, m."""
    inertia = tw.SpatialInertia.from_sphere(1.0, 0.1)
    model = tw.Builder("ball", base="floating", root_inertia=inertia, gravity=np.zeros(3)).build()
    v = np.array([21.0, -16.8, 22.4, 3.5, 0.0, 0.0])
    s = tw.simulate(model, model.neutral(), v, dt=dt, duration=2.0, method=method)
    return float(np.abs(s.q[-1, :3] - [7.0, 0, 0]).max())


def swung_pendulum(method: str, dt: float) -> float:
    """Return how far a pendulum is from Jacobi's solution 0.4 s after it was let go at 2 rad."""
    s = tw.simulate(tw.load("pendulum"), [2.0], [0.0], dt=dt, duration=0.4, method=method)
    return abs(float(s.q[-1, 0]) - pendulum_angle(2.0, 9.81 / 1.001, 0.4))


def pendulum_angle(start: float, stiffness: float, t: float) -> float:
    """Return the angle of a pendulum, φ̈ = −k sin φ, a time after it was let go."""
    from scipy.special import ellipj, ellipk

    m = np.sin(start / 2) ** 2
    sn = ellipj(ellipk(m) - np.sqrt(stiffness) * t, m)[0]
    return float(2 * np.arcsin(np.sin(start / 2) * sn))


def free_top(method: str, dt: float) -> float:
    """Return how far a symmetric body, which precesses about its momentum, is from there after 0.4 s, rad."""
    A, C, w, T = 2.0, 0.5, np.array([0.3, -1.2, 4.0]), 0.4
    inertia = tw.SpatialInertia(1.0, np.zeros(3), np.diag([A, A, C]))
    model = tw.Builder("top", base="floating", root_inertia=inertia, gravity=np.zeros(3)).build()
    R = tw.exp3(T * np.array([A, A, C]) * w / A) @ tw.exp3([0, 0, T * w[2] * (A - C) / A])
    s = tw.simulate(model, model.neutral(), np.r_[w, 1.0, 2.0, 3.0], dt=dt, duration=T, method=method)
    return float(np.abs(tw.log3(tw.frame_placement(model, s.q[-1], "base_link").rotation.T @ R)).max())


def heavy_top(method: str, dt: float) -> float:
    """Return how far a top on a ball joint is from its steady precession after 0.4 s: m g l = C ω₃ Ω − A Ω² cos θ."""
    A, C, m, l, tilt, turns, T = 0.03, 0.03, 1.0, 0.1, 0.5, 5.0, 0.4
    spin = (m * 9.81 * l + A * turns**2 * np.cos(tilt)) / (C * turns)
    builder = tw.Builder("top")
    builder.link(
        "top",
        parent="base_link",
        joint=tw.Spherical(),
        inertia=tw.SpatialInertia(m, [0, 0, l], np.diag([A - m * l * l, A - m * l * l, C])),
    )
    model, R0 = builder.build(), tw.exp3([0, tilt, 0])
    w = R0.T @ np.array([0, 0, turns])
    w[2] = spin
    own = spin - turns * np.cos(tilt)
    q = np.r_[0, np.sin(tilt / 2), 0, np.cos(tilt / 2)]
    s = tw.simulate(model, q, w, dt=dt, duration=T, method=method)
    R = tw.exp3([0, 0, turns * T]) @ R0 @ tw.exp3([0, 0, own * T])
    return float(np.abs(tw.log3(tw.frame_placement(model, s.q[-1], "top").rotation.T @ R)).max())


def orders() -> None:
    """Print the error in closed forms at a dt, the slope between twice this dt and it, and what a step costs."""
    go2 = tw.load("go2")
    start = go2.standing(), np.random.default_rng(0).standard_normal(18)

    def made(name: str) -> float:
        return seconds_of(lambda: tw.simulate(go2, *start, dt=0.002, steps=60, method=name))

    every = [*LOOK, "time-stepping"]
    spent = {name: made(name) for name in every}
    for name in every:
        dt, cells = (0.01 if METHODS[name].order == 4 else 0.002), []
        for form in (flown_ball, swung_pendulum, free_top, heavy_top):
            coarse, fine = form(name, 2 * dt), form(name, dt)
            cells.append(f"{fine:.1e}" + (f" ({np.log2(coarse / fine):.1f})" if fine > 1e-11 else ""))
        print(f"| `{name}` | {1000 * dt:g} | {' | '.join(cells)} | {spent[name] / spent['rk4']:.1g} |", flush=True)


def on_ground(
    inertia: tw.SpatialInertia, place: Sequence[float], v: Sequence[float], dt: float, **how: Any
) -> Simulation:
    """Let a body with the origin of its frame at a place, and its points, move on a ground for `how["duration"]`."""
    builder = tw.Builder("body", base="floating", root="body", root_inertia=inertia)
    for name, at in how.pop("points", {}).items():
        builder.link(name, parent="body", placement=tw.SE3(np.eye(3), at))
    turn = how.pop("turn", [0.0, 0, 0, 1])
    return tw.simulate(builder.build(), np.r_[place, turn], v, dt=dt, **{"ground": tw.Ground()} | how)


def ball_down(dt: float) -> float:
    """Return how far a ball that rolls down 30° from rest is from ½ · 5/7 g sin 30° t² after 1 s, m."""
    n, inertia = np.array([0.5, 0, np.sqrt(0.75)]), tw.SpatialInertia.from_sphere(1.0, 0.05)
    how = {"duration": 1.0, "contacts": [tw.SphereContact("body", 0.05, 0.8)], "ground": tw.Ground(normal=n)}
    s = on_ground(inertia, 0.05 * n, 6 * [0.0], dt, **how)
    return abs(float(np.linalg.norm(s.q[-1, :3] - s.q[0, :3])) - 5 / 28 * 9.81)


def sliding_ball(dt: float) -> float:
    """Return how far a ball that slides at 1 m/s at first, μ = 0.2, and then rolls is from where it belongs, m."""
    inertia, until = tw.SpatialInertia.from_sphere(1.0, 0.05), 2 / 7 / (0.2 * 9.81)
    how = {"duration": 0.4, "contacts": [tw.SphereContact("body", 0.05, 0.2)]}
    s = on_ground(inertia, [0, 0, 0.05], [0, 0, 0, 1.0, 0, 0], dt, **how)
    return abs(float(s.q[-1, 0]) - (until - 0.1 * 9.81 * until**2 + 5 / 7 * (0.4 - until)))


def bouncing_ball(dt: float) -> float:
    """Return how far a ball that is dropped from 0.5 m, e = 0.8, is from its height after 0.8 s, m."""
    fall, inertia = np.sqrt(1.0 / 9.81), tw.SpatialInertia.from_sphere(1.0, 0.05)
    how = {"duration": 0.8, "contacts": [tw.SphereContact("body", 0.05, 0.5, restitution=0.8)]}
    s = on_ground(inertia, [0, 0, 0.55], 6 * [0.0], dt, **how)
    t, up = 0.8 - fall, 0.8 * 9.81 * fall
    return abs(float(s.q[-1, 2]) - 0.05 - (up * t - 9.81 / 2 * t**2))


def tipping_box(dt: float) -> float:
    """Return how far a box that tips over an edge, let go 0.2 rad past it, is from a pendulum after 0.3 s, rad."""
    half, past = np.array([0.1, 0.05, 0.15]), 0.2
    arm, beyond = np.hypot(half[0], half[2]), np.arctan2(half[0], half[2])
    lean = past + beyond
    inertia = tw.SpatialInertia.from_box(2.0, 2 * half)
    points = {f"p{k}": half * [1, y, -1] for k, y in enumerate((1, -1))}
    how = {"turn": [0, np.sin(lean / 2), 0, np.cos(lean / 2)], "points": points, "duration": 0.3}
    how["contacts"] = [tw.PointContact(name, 1e6) for name in points]
    s = on_ground(inertia, [0, 0, arm * np.cos(past)], 6 * [0.0], dt, **how)
    stiffness = 9.81 * arm / (inertia.inertia_at_com[1, 1] / 2.0 + arm**2)
    expected = np.pi - pendulum_angle(np.pi - past, stiffness, 0.3)
    x, _, z = tw.frame_placement(s.model, s.q[-1], "body").rotation[:, 2]
    return abs(float(np.arctan2(x, z)) - beyond - expected)


def orders_on_the_ground() -> None:
    """Print the errors of time stepping in closed forms, and the slope from each dt to half of it."""
    steps = (0.004, 0.002, 0.001, 0.0005)
    for title, form in (
        ("ball down 30°", ball_down),
        ("ball that slides, then rolls", sliding_ball),
        ("ball that bounces", bouncing_ball),
        ("box that tips", tipping_box),
    ):
        off = [form(dt) for dt in steps]
        slope = np.log2(off[0] / off[-1]) / np.log2(steps[0] / steps[-1])
        print(f"| {title} | {' | '.join(f'{x:.1e}' for x in off)} | {slope:.1f} |", flush=True)


def seconds_of(call: Callable[[], object]) -> float:
    """Return the processor time of the quickest of five calls, after one in which programs are made."""
    call()
    found = []
    for _ in range(5):
        start = time.process_time()
        call()
        found.append(time.process_time() - start)
    return min(found)


def main() -> None:
    """Print all tables and write all pictures."""
    mpl.use("agg")
    orders()
    orders_on_the_ground()
    kept_momentum()
    long_run()
    examples = [pendulum(), double_pendulum(), tumbling_body(), standing_go2()]
    results = [measure(example) for example in examples]
    for column, name in enumerate(("simulation_drift", "simulation_cost")):
        draw(examples, results, column).savefig(HERE / f"{name}.png", dpi=110)


if __name__ == "__main__":
    main()

"""Random scenes on a ground, seven robots: what must not happen is counted, and that nothing of it is silent.

μ from 0 to 1000, slopes, restitution from 0 to 1, steps from 10 µs to 20 ms, at rest and thrown. Of each step is asked:
whether a point is pushed that is above the ground before and after it, is pulled, or bears a force outside its cone;
whether a point is below the ground; whether Coulomb's law is missed by more than 1e-3 of the fastest point, and if so,
whether a remark says it. The energy may be above that of the start only by what is smaller with half the step.

Usage: python benchmarks/ground_scenes.py [SCENES [SEED]]
"""

from __future__ import annotations

import sys
from collections import Counter

import numpy as np

import twistwrench as tw
from twistwrench.simulation.ground import GroundPoints
from twistwrench.simulation.result import COULOMB_RTOL

BOX = np.array([0.1, 0.08, 0.05])  # m: half its sides
ON = 1e-9
"""m: nearer than this, a point is on the ground."""


def body(name, inertia, points):
    """Return a flying body with frames p0, p1, … at these points."""
    builder = tw.Builder(name, base="floating", root=name, root_inertia=inertia)
    for k, point in enumerate(points):
        builder.link(f"p{k}", parent=name, placement=tw.SE3(np.eye(3), point))
    return builder.build()


def biped():
    """Return a trunk on two legs with ball joints."""
    trunk, leg = tw.SpatialInertia.from_box(5.0, [0.2, 0.2, 0.2]), np.diag([0.02, 0.02, 0.001])
    builder = tw.Builder("biped", base="floating", root="hip", root_inertia=trunk)
    for side, y in (("l", 0.1), ("r", -0.1)):
        at = tw.SE3(np.eye(3), [0, y, 0])
        inertia = tw.SpatialInertia(1.0, [0, 0, -0.2], leg)
        builder.link(f"{side}_leg", parent="hip", joint=tw.Spherical(), placement=at, inertia=inertia)
        builder.link(f"{side}_foot", parent=f"{side}_leg", placement=tw.SE3(np.eye(3), [0, 0, -0.4]))
    return builder.build()


def robots():
    """Return the robots by name, each with what makes its contacts of μ."""
    go2, humanoid, tree = tw.load("go2"), tw.load("humanoid"), tw.random_tree(6, rng=3, base="floating")
    corners = [BOX * [x, y, z] for x in (1, -1) for y in (1, -1) for z in (1, -1)]
    lower = [*go2.feet, "FL_calf", "FR_calf", "RL_calf", "RR_calf", "base"]

    def points(*frames):
        return lambda mu: [tw.PointContact(frame, mu) for frame in frames]

    def soles(mu):
        both = [tw.SurfaceContact(f"{side}_sole", (0.076, 0.0275), mu) for side in ("left", "right")]
        return [*both, tw.PointContact("pelvis", mu)]

    rod = tw.SpatialInertia(1.0, [0, 0, 0], np.diag([0.002, 1 / 12, 1 / 12]))
    return {
        "box": (body("box", tw.SpatialInertia.from_box(2.0, 2 * BOX), corners), points(*(f"p{k}" for k in range(8)))),
        "rod": (body("rod", rod, [[-0.5, 0, 0], [0.5, 0, 0]]), points("p0", "p1")),
        "ball": (
            body("ball", tw.SpatialInertia.from_sphere(1.0, 0.1), [[0, 0, 0]]),
            lambda mu: [tw.SphereContact("p0", 0.1, mu)],
        ),
        "go2": (go2, points(*lower)),
        "humanoid": (humanoid, soles),
        "biped": (biped(), points("l_foot", "r_foot", "hip")),
        "tree": (tree, points(*tree.joint_names[1:])),
    }


def scene(model, contacts, rng):
    """Return the arguments of a random scene, and its ground points."""
    mu = rng.choice([0.0, 10 ** rng.uniform(-2, 0.3), 10 ** rng.uniform(0, 3)])
    lean, way = rng.choice([0.0, rng.uniform(0, 0.7)]), rng.uniform(0, 2 * np.pi)
    n = [np.sin(lean) * np.cos(way), np.sin(lean) * np.sin(way), np.cos(lean)]
    e = rng.choice([0.0, 0.0, rng.uniform(0, 1), 1.0])
    ground, touch = tw.Ground(normal=n, height=0.1 * rng.normal(), restitution=e), contacts(float(mu))
    points = GroundPoints(model, touch, ground)
    q = np.clip(model.standing() if model.feet else model.neutral(), model.lower, model.upper)
    turn = rng.normal(size=3) * rng.choice([0.1, 0.5, 2.0])
    q = model.integrate(model.normalize(q), np.r_[turn, np.zeros(model.nv - 3)])
    gap = rng.choice([0.0, rng.uniform(0, 0.02)])
    q[:3] += np.array(ground.normal) * (gap - points.height(q).min())
    v = rng.normal(size=model.nv) * rng.choice([0.0, 0.3, 1.0, 5.0])
    options = {"dt": 10 ** rng.uniform(-5, np.log10(0.02)), "steps": int(rng.integers(5, 40))}
    return (q, v), options | {"contacts": touch, "ground": ground}, points


def gained(s):
    """Return by how much the energy is above that of the start at most, J."""
    return float((s.energy - s.energy[0]).max())


def faults(model, state, options, points):
    """Yield what went wrong in one scene, by name."""
    try:
        s = tw.simulate(model, *state, **options)
    except (tw.DivergenceError, tw.SingularError) as error:
        yield type(error).__name__
        return
    stepping, dt = s.system.stepping, options["dt"]
    force, height = np.array(stepping.forces), points.height(s.q)
    if not np.isfinite(s.q).all() or not np.isfinite(force).all():
        yield "NaN"
    if height.min() < -ON:
        yield "below the ground"
    curved = (dt * (1 + np.abs(s.v).max())) ** 2 / 2  # m: what a step leaves of a way that is not straight
    pushed = force[..., 2] > 1e-9 * np.abs(force).max(initial=0)
    if (pushed & (height[:-1] > ON) & (height[1:] > ON + curved)).any():
        yield "pushed from afar"
    if force[..., 2].min(initial=0) < 0:
        yield "pulled"
    if (np.hypot(force[..., 0], force[..., 1]) > stepping.mu * force[..., 2] * (1 + 1e-9)).any():
        yield "outside its cone"
    missed, limit = np.max(stepping.missed, axis=-1, initial=0), COULOMB_RTOL * np.array(stepping.fastest)
    if (missed > limit + 1e-9).any():
        yield "Coulomb's law missed, said" if any(r.kind == "coulomb" for r in s.remarks) else "MISSED IN SILENCE"
    scale = tw.kinetic_energy(model, *state) + model.mass * 9.81 * 0.1
    if gained(s) > 1e-9 * scale:
        finer = options | {"dt": dt / 8, "steps": 8 * options["steps"]}
        less = gained(tw.simulate(model, *state, **finer)) < 0.6 * gained(s)
        yield "energy above the start, less with a smaller step" if less else "energy above the start"


def main(scenes=2000, seed=0):
    """Print the counts."""
    count, steps, every = Counter(), 0, robots()
    for n in range(scenes):
        name = [*every][n % len(every)]
        model, contacts = every[name]
        state, options, points = scene(model, contacts, np.random.default_rng([seed, n]))
        steps += options["steps"]
        for fault in faults(model, state, options, points):
            count[fault] += 1
            if fault.startswith(("energy above the start", "MISSED", "Div", "Sing")) and not fault.endswith("step"):
                print(f"scene {n} of {name}, dt = {options['dt']:.2g} s: {fault}")
    print(f"{scenes} scenes, {steps} steps: {dict(count) or 'no fault'}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

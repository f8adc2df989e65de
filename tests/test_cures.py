"""What `tw.accuracy` proposes where digits are lost brings them back: trees that nobody tuned, 1e±12, 160 digits."""

from dataclasses import replace

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench import newton_euler_3d as slow

KINDS = ("masses", "lengths", "of each body", "velocities", "far bodies", "light base", "parallel axes", "float32")


def tree(kind, seed):
    """A random tree with one thing scaled by up to 1e±12, and a state with torques of one of three kinds."""
    rng = np.random.default_rng([KINDS.index(kind), seed])
    model = tw.random_tree(int(rng.integers(2, 8)), rng=rng, base=("fixed", "floating")[seed % 2])
    n = model.nbodies
    mass, length, reach, far, speed = np.ones(n), 1.0, np.ones(n), np.zeros(n), 1.0
    if kind in ("masses", "float32"):
        mass = 10 ** rng.uniform(-12, 12, n) if kind == "masses" else 10 ** rng.uniform(-3, 3, n)
    elif kind == "lengths":
        length = 10 ** rng.uniform(-12, 12)
    elif kind == "of each body":
        reach = 10 ** rng.uniform(-4, 4, n)
    elif kind == "velocities":
        speed = 10 ** rng.uniform(-12, 12)
    elif kind == "far bodies":
        far = 10 ** rng.uniform(0, 6, n) * (rng.random(n) < 0.5)
    elif kind == "light base":
        mass = 10 ** (rng.uniform(0, 12) * np.arange(n) / n)
    joints, inertia, placement = [*model.joints], [model.inertia[0]], [model.placement[0]]
    for i in range(1, n):
        I, size, T = model.inertia[i], length * reach[i], model.placement[i]
        axis = getattr(joints[i], "axis", (0.0, 0.0, 1.0))
        com = I.com * size + far[i] * length * np.array(axis)
        inertia.append(tw.SpatialInertia(I.mass * mass[i], com, I.inertia_at_com * mass[i] * size**2))
        turn = tw.exp3(10 ** rng.uniform(-9, -2) * rng.standard_normal(3)) if kind == "parallel axes" else T.rotation
        if kind == "parallel axes" and isinstance(joints[i], tw.Revolute):
            joints[i] = tw.Revolute("z")
        offset = T.translation * (
            10 ** rng.uniform(-9, 0) if kind == "parallel axes" else length * reach[model.parent[i]]
        )
        placement.append(tw.SE3(turn, offset))
    model = replace(model, joints=tuple(joints), inertia=tuple(inertia), placement=tuple(placement),
                    gravity=model.gravity * length, armature=np.zeros(model.nv))  # fmt: skip
    q, v = model.random_configuration(rng=rng), speed * rng.standard_normal(model.nv)
    weight = np.sqrt(np.abs(np.diagonal(tw.crba(model, q))))
    push = rng.standard_normal(model.nv) * weight * np.abs(tw.nonlinear_effects(model, q, v) / weight).max()
    tau = (0 * v, push, tw.rnea(model, q, v, speed**2 * rng.standard_normal(model.nv)))[int(rng.integers(3))]
    number = np.float32 if kind == "float32" else np.float64
    q, v, tau = (x.astype(number) for x in (q, v, tau))
    return (model, model.normalize(q), v, tau)


def right(model, q, v, tau):
    """q̈, q̈ without torques, and √M_kk, all in 160 digits."""
    mpmath.mp.dps = 160
    q, v, tau = (slow.as_mpmath(x.astype(float)) for x in (q, v, tau))
    weight = np.array([mpmath.sqrt(x) for x in np.diagonal(slow.mass_matrix(model, q))])
    return [slow.forward_dynamics(model, q, v, x) for x in (tau, 0 * tau)], weight


def off(answer, found, weight):
    size = max(max(abs(x * weight)) for x in (*found, found[0] - found[1]))
    return float(max(abs((slow.as_mpmath(np.asarray(answer, float)) - found[0]) * weight)) / size)


def tried(kind, seed):
    """The error before, what was estimated, and the error after the cure; None where no cure is proposed."""
    try:
        model, q, v, tau = tree(kind, seed)
        known = tw.accuracy(model, q, v, tau)
    except ValueError:  # sizes that the number type cannot hold
        return None
    digits = mpmath.mp.dps
    try:
        found, weight = right(model, q, v, tau)
        try:
            before = off(tw.aba(model, q, v, tau), found, weight)
        except ValueError:
            before = np.inf  # it refuses
        cures = [loss for loss in known.losses if loss.lines]
        if not cures:
            return before, float(known.aba), None, "", known
        names = {"np": np, "mpmath": mpmath, "tw": tw, "model": model, "q": q, "v": v, "tau": tau}
        try:
            exec(cures[0].lines, names)
            after = off(names["qdd"], found, weight)
        except ValueError:
            after = np.inf
        return before, float(known.aba), after, cures[0].cause, known
    finally:
        mpmath.mp.dps = digits


def whole(kind):
    """What counts as all digits: what an ordinary robot has."""
    return 1e-6 if kind == "float32" else 1e-14


def counted(kinds, seeds):
    rows = [(kind, seed, tried(kind, seed)) for kind in kinds for seed in seeds]
    rows = [(kind, seed, found) for kind, seed, found in rows if found is not None]
    above = [(kind, seed) for kind, seed, (before, estimate, *_) in rows if estimate < before < np.inf]
    proposed = [(kind, seed, found) for kind, seed, found in rows if found[2] is not None]
    lost = [(kind, seed) for kind, seed, found in proposed if not found[2] <= whole(kind)]
    return len(rows), above, proposed, lost


def test_of_a_few_trees_of_each_kind_the_cure_brings_the_digits_back():
    _, above, proposed, lost = counted(KINDS, range(1))
    assert above == []
    assert len(proposed) >= 2
    assert lost == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_the_cure_brings_the_digits_back(kind):
    tried_, above, proposed, lost = counted([kind], range(2, 42))
    assert tried_ > 20
    assert len(above) <= 0.05 * tried_, above  # free and ball joints inside a tree: see the notes of `accuracy`
    assert len(lost) <= 0.05 * len(proposed), lost

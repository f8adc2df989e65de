"""Answers to the questions of 49.7: what is felt through free joints, and what falls."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts


def rod() -> Facts:
    """Mass of a rod of 2 kg and 1 m, without thickness, that a hand feels across it, through a free hinge."""
    thin = tw.SpatialInertia(2.0, [0, 0, -0.5], np.diag([1 / 6, 1 / 6, 0])).matrix()
    S = tw.Revolute("y").subspace()
    free = thin - thin @ S @ np.linalg.inv(S.mT @ thin @ S) @ S.mT @ thin
    return {"truth": float(free[3, 3]), "whole": 2.0, "half": 1.0}


def chain() -> Facts:
    """Mass felt across the first of six hanging rods of 1 kg, beside that of one."""
    felt = [float(tw.aba_terms(model, *np.zeros((3, model.nv))).Ia[1][3, 3]) for model in (tw.chain(1), tw.chain(6))]
    ratio = felt[1] / felt[0]
    truth = "hardly" if ratio < 1.5 else "twice" if ratio < 3 else "six"
    return {"truth": truth, "one": felt[0], "six": felt[1]}


def roll() -> Facts:
    """Inertia of Go2's trunk about its long axis, legs free, in per cent of that with locked joints."""
    locked, free = _trunk()
    return {"truth": 100 * float(free[0, 0] / locked[0, 0]), "all": 100.0, "half": 50.0}


def lifted() -> Facts:
    """Mass that is felt when the trunk of Go2 is lifted and the joints are free."""
    model = tw.load("go2")
    _, free = _trunk()
    return {"truth": float(free[5, 5]), "whole": model.mass, "trunk": float(model.inertia[1].mass)}


def hip() -> Facts:
    """Acceleration of the front left hip under 1 N m, with the base held and with the base free."""
    model, held = tw.load("go2"), tw.load("go2", base="fixed")
    q, push = model.standing(), np.eye(model.nv)[6]
    free = float((tw.aba(model, q, 0 * push, push) - tw.aba(model, q, 0 * push, 0 * push))[6])
    q, push = q[7:], push[6:]
    fixed = float((tw.aba(held, q, 0 * push, push) - tw.aba(held, q, 0 * push, 0 * push))[0])
    truth = "same" if np.isclose(free, fixed, rtol=0.02) else "more" if free > fixed else "less"
    return {"truth": truth, "free": free, "held": fixed}


def knees() -> Facts:
    """How the knees of a dropped Go2 begin to turn; a knee that bends has a negative acceleration."""
    model = tw.load("go2")
    rest = np.zeros(model.nv)
    knee = tw.aba(model, model.standing(), rest, rest)[8]
    truth = "still" if abs(knee) < 1e-9 else "stretch" if knee > 0 else "fold"
    return {"truth": truth}


def tip() -> Facts:
    """Which forward dynamics keeps more digits on ten rods whose mass grows a million times to the tip."""
    import mpmath

    model = tw.chain(10, mass_ratio=1e6)
    q, v, tau = np.random.default_rng(7).standard_normal((3, 10))
    with mpmath.workdps(50):
        state = map(tw.newton_euler_3d.as_mpmath, (q, v, tau))
        exact = tw.newton_euler_3d.forward_dynamics(model, *state).astype(float)
    solved = np.linalg.solve(tw.crba(model, q), tau - tw.nonlinear_effects(model, q, v))
    by_aba, by_solving = (
        float(np.abs(way - exact).max() / np.abs(exact).max()) for way in (tw.aba(model, q, v, tau), solved)
    )
    ratio = by_solving / by_aba
    return {"truth": "aba" if ratio > 10 else "crba" if ratio < 0.1 else "both", "aba": by_aba, "solving": by_solving}


def _trunk() -> tuple[np.ndarray, np.ndarray]:
    """Return the inertia of a standing Go2 at its base, with locked joints and with free ones."""
    model = tw.load("go2")
    q, rest = model.standing(), np.zeros(model.nv)
    return tw.crba(model, q)[:6, :6], tw.aba_terms(model, q, rest, rest).IA[1]

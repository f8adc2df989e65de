"""Answers to the questions of 49.11: two orders, two packages, and one step of a controller."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts


def order() -> Facts:
    """Effect of v and a in the wrong order on inverse dynamics; the largest error of a force in N."""
    model, q, (v, a) = _state()
    wrong = tw.rnea(model, q, *(tw.bridge.to_pinocchio_tangent(model, x) for x in (v, a)))
    off = float(np.abs(wrong - tw.rnea(model, q, v, a)).max())
    return {"truth": "silent" if off > 1 else "small", "off": off}


def eigenvalues() -> Facts:
    """Whether M has other eigenvalues in Pinocchio's order."""
    model, q, _ = _state()
    M = tw.crba(model, q)
    ours, theirs = (np.linalg.eigvalsh(matrix) for matrix in (M, tw.bridge.to_pinocchio_matrix(model, M)))
    return {"truth": "same" if np.allclose(ours, theirs, rtol=1e-9) else "other"}


def quaternion() -> Facts:
    """How a robot lies that should stand level, where its quaternion begins with the scalar part."""
    model = tw.load("go2")
    q = model.standing()
    q[3:7] = 1, 0, 0, 0
    up = tw.forward_kinematics(model, q).placement[1].rotation[2, 2]
    return {"truth": "level" if up > 0.9 else "back" if up < -0.9 else "side"}


def rise() -> Facts:
    """Force of the ground on a standing Go2 whose trunk begins to rise with 1 m/s² from rest; its feet stay."""
    model = tw.load("go2")
    q, rest = model.standing(), np.zeros(model.nv)
    J, trunk = tw.contact_jacobian(model, q, model.feet), np.array([0, 0, 0, 0, 0, 1.0])
    a = np.concatenate([trunk, -np.linalg.solve(J[:, 6:], J[:, :6] @ trunk)])
    force = tw.centroidal_momentum_rate(model, q, rest, a)[5] + 9.81 * model.mass
    weight = 9.81 * model.mass
    return {"truth": float(force), "weight": weight, "trunk": weight + float(model.inertia[1].mass)}


def risen() -> Facts:
    """Acceleration of the base inside RNEA, upward, for a robot that rests."""
    model = tw.load("go2")
    rest = np.zeros(model.nv)
    A = np.asarray(tw.rnea_terms(model, model.standing(), rest, rest).A)
    return {"truth": float(A[1, 5]), "none": 0.0, "down": -9.81}


def digits() -> Facts:
    """How many digits of RNEA in double precision are those of a computation with 3-D vectors and 50 digits."""
    import mpmath

    model, q, (v, a) = _state()
    with mpmath.workdps(50):
        state = [tw.newton_euler_3d.as_mpmath(x) for x in (q, v, a)]
        exact = tw.newton_euler_3d.inverse_dynamics(model, *state).astype(float)
    error = np.abs(tw.rnea(model, q, v, a) - exact).max() / np.abs(exact).max()
    return {"truth": float(-np.log10(error)), "single": 7.0, "fifty": 50.0}


def _state() -> tuple[tw.Model, np.ndarray, np.ndarray]:
    """Return Go2 in a random posture, with a velocity and an acceleration."""
    model, rng = tw.load("go2"), np.random.default_rng(11)
    return model, model.random_configuration(rng=rng), rng.standard_normal((2, model.nv))

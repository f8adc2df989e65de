"""Answers to the questions of 49.5: inertias, and what a body does that is thrown."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts


def point() -> Facts:
    """Rank of the spatial inertia of a point mass that is not at the origin."""
    ball = tw.SpatialInertia(2.0, [0, 0, 0.1], np.zeros((3, 3)))
    return {"truth": float(np.linalg.matrix_rank(ball.matrix())), "one": 1.0, "five": 5.0, "six": 6.0}


def roll() -> Facts:
    """Inertia of a locked Go2 about the long axis of its base, as a multiple of that of the trunk alone."""
    model, locked = tw.load("go2"), locked_go2()
    trunk = model.inertia[1]
    mass = float(locked.mass / trunk.mass)
    return {"truth": float(locked.matrix()[0, 0] / trunk.matrix()[0, 0]), "mass": mass, "square": mass**2}


def plate() -> Facts:
    """Whether a body can have the moments 1, 1 and 10 kg m²; the largest that the third can be is given as well."""
    body = tw.SpatialInertia(1.0, np.zeros(3), np.diag([1.0, 1.0, 10.0]))
    try:
        body.check_physical("body")
    except tw.ModelError:
        return {"truth": "never", "most": 2.0}
    return {"truth": "any", "most": 2.0}


def antisymmetric() -> Facts:
    """Whether it is the matrix V× that is antisymmetric, or the product."""
    V, W = np.random.default_rng(5).standard_normal((2, 6))
    cross = tw.cross_motion(V)
    matrix, product = np.allclose(cross, -cross.mT), np.allclose(cross @ W, -tw.cross_motion(W) @ V)
    return {"truth": {(True, True): "both", (False, True): "product", (True, False): "matrix"}[matrix, product]}


def gyroscopic() -> Facts:
    """Whether the term ω × I ω is left when a body's momentum is differentiated along axes that stand still."""
    inertia, w, h = np.diag([1.0, 2.0, 3.0]), np.array([0.4, -0.3, 0.5]), 1e-100
    turning = tw.exp3(1j * h * w)
    rate = (turning @ inertia @ turning.mT @ w).imag / h
    return {"truth": "stays" if np.linalg.norm(rate) > 1e-9 else "gone"}


def turnover() -> Facts:
    """About which of its principal axes a locked Go2 turns over when it is thrown with a small error."""
    inertia = locked_go2()
    moments, axes = np.linalg.eigh(inertia.inertia_at_com)
    thrown = inertia.transform(tw.SE3(axes * np.linalg.det(axes), inertia.com).inverse())
    body = tw.Builder("thrown", base="floating", root_inertia=thrown, gravity=[0, 0, 0]).build()
    found = []
    for k, name in enumerate(("smallest", "middle", "largest")):
        spin = np.array([0.02, 0.02, 0.02, 0, 0, 0])
        spin[k] += 4
        rates = np.asarray(tw.simulate(body, body.neutral(), spin, dt=0.05, duration=6.0).v)[:, k]
        found += [name] * bool(rates.min() < 0)
    (truth,) = found
    return {"truth": truth, "small": float(moments[0]), "middle": float(moments[1]), "large": float(moments[2])}


def locked_go2() -> tw.SpatialInertia:
    """Return the inertia of a standing Go2 with locked joints, in the frame of its base."""
    model = tw.load("go2")
    base, *others = tw.forward_kinematics(model, model.standing()).placement[1:]
    moved = (body.transform(base.inverse() @ T) for body, T in zip(model.inertia[2:], others, strict=True))
    return sum(moved, start=model.inertia[1])

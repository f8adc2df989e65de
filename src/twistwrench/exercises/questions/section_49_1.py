"""Answers to the questions of 49.1: what changes with the point one looks from, and what a slip does."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts


def along() -> Facts:
    """Whether the moment of a force changes where the point of reference moves along the line of the force."""
    force, lever = np.array([0, 0, 40.0]), np.array([0.2, -0.1, -0.3])
    here, above = (np.cross(lever - shift * force / 40, force) for shift in (0.0, 0.5))
    return {"truth": "same" if np.allclose(here, above) else "grows"}


def sign() -> Facts:
    """How the trunk begins to turn that is pushed to the left at its front, where the sign of p × f is wrong."""
    model = tw.load("go2")
    q, rest = model.standing(), np.zeros(model.nv)
    nose, force = np.array([0.28, 0, 0]), np.array([0, 30.0, 0])
    f_ext = np.zeros((3, model.nbodies, 6))
    f_ext[1, 1], f_ext[2, 1] = [*np.cross(nose, force), *force], [*-np.cross(nose, force), *force]
    still, right, wrong = (float(a) for a in tw.aba(model, q, np.zeros((3, 18)), rest, f_ext=f_ext)[:, 2])
    return {
        "truth": "other" if (right - still) * (wrong - still) < 0 else "less",
        "right": right - still,
        "wrong": wrong - still,
    }


def walked() -> Facts:
    """Error of a foot's velocity where a body twist is taken for a spatial one, 10 m from the origin, at 0.6 rad/s."""
    V, far = np.array([0, 0, 0.6, 0.8, 0, 0]), np.array([10.0, 0, 0])
    right = tw.motion_transform(np.eye(3), far) @ V
    error = float(np.linalg.norm(right[3:] - V[3:]))  # both turn alike, so it is the same at every point
    return {"truth": error, "none": 0.0, "slow": 0.6}


def negligible() -> Facts:
    """Smallest error that one of the coupling terms left out makes at a calf in a random motion, in per cent."""
    model, rng = tw.load("go2"), np.random.default_rng(1)
    q, (v, a) = model.standing(), 3 * rng.standard_normal((2, model.nv))
    calf = model.joint_id("FR_calf_joint")
    moving = tw.newton_euler_3d.motion(model, q, v, a)
    w, alpha = moving.angular_velocity[calf], moving.angular_acceleration[calf]
    at = tw.forward_kinematics(model, q).placement[calf]
    r = tw.frame_placement(model, q, "FR_foot").translation - at.translation
    I = at.rotation @ model.inertia[calf].inertia_at_com @ at.rotation.mT
    relative = v[model.v_slice[calf]] * at.rotation[:, 1]
    turned = np.cross(w - relative, relative)
    terms = [
        (np.cross(w, r), moving.velocity[calf]),
        (np.cross(alpha, r) + np.cross(w, np.cross(w, r)), moving.acceleration[calf]),
        (turned, alpha - turned),
        (np.cross(w, I @ w), I @ alpha),
    ]
    shares = [100 * float(np.linalg.norm(term) / np.linalg.norm(term + rest)) for term, rest in terms]
    truth = "none" if min(shares) > 3 else "one" if sorted(shares)[1] > 3 else "most"
    return {"truth": truth, "least": min(shares), "largest": max(shares)}


def full() -> Facts:
    """How many entries of the mass matrix of a chain of 40 links are not zero."""
    M = tw.crba(tw.chain(40), np.full(40, 0.3))
    return {"truth": float(np.count_nonzero(M)), "links": 40.0, "band": 3 * 40 - 2.0}


def rolled() -> Facts:
    """Where the back of a robot points that should lie on its side, its quaternion written with w first."""
    model = tw.load("go2")
    q = model.standing()
    q[3:7] = np.sqrt(0.5), np.sqrt(0.5), 0, 0
    up = tw.forward_kinematics(model, q).placement[1].rotation[:, 2]
    return {"truth": "down" if up[2] < -0.9 else "up" if up[2] > 0.9 else "side"}

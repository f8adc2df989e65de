"""Answers to the questions of 49.3: what X, its inverse and its transpose do."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts


def back() -> Facts:
    """Which of three candidates is the inverse of X."""
    T = tw.exp6(np.random.default_rng(3).standard_normal(6))
    R, p, X = T.rotation, T.translation, T.motion_transform()
    blocks = np.block([[R.mT, np.zeros((3, 3))], [-R.mT @ tw.skew(p), R.mT]])
    ways = {"transpose": X.mT, "sign": tw.motion_transform(R, -p), "blocks": blocks}
    (truth,) = (name for name, way in ways.items() if np.allclose(way @ X, np.eye(6), atol=1e-12))
    return {"truth": truth}


def condition() -> Facts:
    """Condition number of X between two frames that are 10 m apart, and its determinant."""
    X = tw.motion_transform(tw.exp3([0.3, -0.2, 0.5]), [6.0, 0.0, 8.0])
    return {"truth": float(np.linalg.cond(X)), "one": float(np.linalg.det(X)), "ten": 10.0}


def transpose() -> Facts:
    """Where the transpose of an X from B to A takes wrenches."""
    T = tw.exp6(np.random.default_rng(3).standard_normal(6))
    F = np.random.default_rng(4).standard_normal(6)  # in A
    in_B = T.inverse().force_transform() @ F
    return {"truth": "back" if np.allclose(T.motion_transform().mT @ F, in_B) else "nowhere"}


def own() -> Facts:
    """In which frames the power comes out right where wrenches are taken there with the transpose of X."""
    F, V = np.random.default_rng(5).standard_normal((2, 6))
    frames = {"own": tw.SE3.identity(), "shifted": tw.SE3(np.eye(3), [0.1, 0.2, -0.3])}
    frames["turned"] = tw.SE3(tw.exp3([0.3, 0.4, 0.5]), np.zeros(3))
    right = [
        name
        for name, T in frames.items()
        if np.isclose((T.motion_transform().mT @ F) @ (T.motion_transform() @ V), F @ V)
    ]
    return {"truth": right[0] if len(right) == 1 else "many"}


def first() -> Facts:
    """How many of a leg's three torques are right where the wrench goes inward with X* in place of the transpose."""
    model = tw.load("go2")
    q = model.standing()
    hip = model.joint_id("FR_hip_joint")
    q[model.q_slice[hip].start :][:3] = -0.4, 0.9, -1.6  # the leg put out to the side
    placement = tw.forward_kinematics(model, q).placement
    foot = tw.frame_placement(model, q, "FR_foot")
    force = np.concatenate([np.zeros(3), foot.rotation.mT @ [0, 0, 40.0]])
    right = (tw.frame_jacobian(model, q, "FR_foot", "local").mT @ force)[model.v_slice[hip].start :][:3]
    F = (placement[hip + 2].inverse() @ foot).force_transform() @ force
    axes = [joint.subspace()[:, 0] for joint in model.joints[hip : hip + 3] if joint is not None]
    found: list[float] = []
    for i in (2, 1, 0):
        found.insert(0, float(axes[i] @ F))
        F = (placement[hip + i].inverse() @ placement[model.parent[hip + i]]).force_transform() @ F
    return {"truth": float(np.isclose(found, right).sum()), "none": 0.0, "all": 3.0}

"""Answers to the questions of 49.6: what RNEA passes through the joints."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts


def slider() -> Facts:
    """Size of V × S q̇ for a slider that moves outward at 3 m/s on a turntable with 2 rad/s, 0.5 m from its axis."""
    turn, out = 2.0, 3.0
    V, S = np.array([0, 0, turn, out, 0.5 * turn, 0]), np.eye(6)[3]
    term = tw.cross_motion(V) @ S * out
    return {"truth": float(np.linalg.norm(term[3:])), "coriolis": 2 * turn * out, "centripetal": turn**2 * 0.5}


def child() -> Facts:
    """Vertical force that RNEA adds at the trunk for one leg, where the trunk of a Go2 at rest is held."""
    _, through = _hips()
    return {"truth": through, "weighs": through, "reaction": -through}


def cost() -> Facts:
    """Work of RNEA on a chain of 40 links as a multiple of that on 4, by the lines that are executed."""
    few, many = (len(tw.trace(tw.chain(n), "rnea", *np.full((3, n), 0.3)).steps) for n in (4, 40))
    return {"truth": many / few, "square": 100.0, "cube": 1000.0}


def hip() -> Facts:
    """Vertical force that the trunk of a standing Go2 gets through its front left hip."""
    ground, through = _hips(standing=True)
    _, leg = _hips()
    return {"truth": -through, "all": ground, "leg": leg}


def double() -> Facts:
    """Joint forces that come from velocity, as a multiple, where every velocity doubles."""
    model = tw.load("go2")
    q, v = model.standing(), np.random.default_rng(6).standard_normal(model.nv)
    one, two = (tw.nonlinear_effects(model, q, k * v) - tw.gravity(model, q) for k in (1, 2))
    return {"truth": float(np.linalg.norm(two) / np.linalg.norm(one)), "linear": 2.0, "cube": 8.0}


def overwritten() -> Facts:
    """At which joint of a leg a torque is right although what the children pass on is lost."""
    model = tw.load("go2")
    q, (v, a) = model.standing(), np.random.default_rng(6).standard_normal((2, model.nv))
    terms = tw.rnea_terms(model, q, v, a)
    leg = zip(model.joints[2:5], terms.B[2:5], strict=True)
    alone = [float(joint.subspace()[:, 0] @ own) for joint, own in leg if joint is not None]
    right = [
        name for name, torque, tau in zip(("hip", "thigh", "calf"), alone, terms.tau[6:9]) if np.isclose(torque, tau)
    ]
    return {"truth": right[0] if len(right) == 1 else "none"}


def _hips(*, standing: bool = False) -> tuple[float, float]:
    """Return the force of the ground on the front left foot of a Go2 at rest, and that through its hip to the leg."""
    model = tw.load("go2")
    q, rest = model.standing(), np.zeros(model.nv)
    forces, kin = tw.static_equilibrium(model, q).forces, tw.forward_kinematics(model, q)
    f_ext = np.zeros((model.nbodies, 6))
    for name, force in zip(model.feet, forces if standing else 0 * forces, strict=True):
        body = model.frames[name].body
        at_foot = tw.SE3(np.eye(3), tw.frame_placement(model, q, name).translation)
        f_ext[body] = (kin.placement[body].inverse() @ at_foot).force_transform() @ [0, 0, 0, *force]
    hip = model.joint_id("FL_hip_joint")
    through = kin.placement[hip].rotation @ tw.joint_wrenches(model, q, rest, rest, f_ext)[hip, 3:]
    return float(forces[0, 2]), float(through[2])

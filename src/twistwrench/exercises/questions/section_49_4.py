"""Answers to the questions of 49.4: what a wrench does, and what the ground can give."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts

MU = 0.6


def parts() -> Facts:
    """Which part of a push's power stays as it is where the origin of the frame is moved by 3 m."""
    r, f = np.array([0.28, 0, 0]), np.array([10.0, 15.0, 0])
    F, V = np.concatenate([np.cross(r, f), f]), np.array([0, 0, 0.6, 0.8, 0, 0])
    aside = tw.SE3(np.eye(3), [-2.5, 1.7, 0]).inverse()
    F_there, V_there = aside.force_transform() @ F, aside.motion_transform() @ V
    sums = np.isclose(F_there @ V_there, F @ V)
    force, moment = (
        np.isclose(F_there[3:] @ V_there[3:], F[3:] @ V[3:]),
        np.isclose(F_there[:3] @ V_there[:3], F[:3] @ V[:3]),
    )
    truth = "all" if force and moment else "sum" if sums else "none"
    return {
        "truth": truth,
        "power": float(F @ V),
        "here": float(F[3:] @ V[3:]),
        "there": float(F_there[3:] @ V_there[3:]),
    }


def four() -> Facts:
    """Where the line of the single force runs that the four feet of a standing Go2 add up to."""
    model = tw.load("go2")
    q = model.standing()
    places = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
    forces = tw.static_equilibrium(model, q).forces
    point = tw.screw([*np.cross(places, forces).sum(axis=0), *forces.sum(axis=0)], of="wrench").point[:2]
    ways = {"com": tw.center_of_mass(model, q), "feet": places.mean(axis=0), "base": q[:3]}
    truth = min(ways, key=lambda name: float(np.linalg.norm(ways[name][:2] - point)))
    return {"truth": truth, "off": 1000 * float(np.linalg.norm(ways["feet"][:2] - point))}


def couple() -> Facts:
    """Effect on the wrench of a couple of moving it by 1 m."""
    F = np.array([0, 0, 5.0, 0, 0, 0])
    moved = tw.force_transform(np.eye(3), np.array([1.0, 0, 0])) @ F
    return {"truth": "nothing" if np.array_equal(moved, F) else "moment"}


def axis() -> Facts:
    """Pitch in mm of the wrench of two diagonal feet that also push sideways against each other with 18 N."""
    model = tw.load("go2")
    q = model.standing()
    places = np.array([tw.frame_placement(model, q, foot).translation for foot in ("FL_foot", "RR_foot")])
    push = np.array([[-12.0, 18.0, 78.9], [12.0, -18.0, 78.9]])
    trot = tw.screw([*np.cross(places, push).sum(axis=0), *push.sum(axis=0)], of="wrench")
    return {"truth": "screw" if abs(trot.pitch) > 1e-6 else "force", "moment": float(trot.pitch * trot.magnitude)}


def hip() -> Facts:
    """Whether the hip of a leg has a torque where its foot is pushed with 40 N along a line through the hip's axis."""
    model = tw.load("go2")
    q = model.standing()
    joint = model.joint_id("FR_hip_joint")
    target = tw.forward_kinematics(model, q).placement[joint].act(np.array([0.05, 0, 0]))  # on the axis, which is x
    line = target - tw.frame_placement(model, q, "FR_foot").translation
    force = 40 * line / np.linalg.norm(line)
    torques = (tw.contact_jacobian(model, q, ["FR_foot"]).mT @ force)[model.v_slice[joint].start :][:3]
    return {"truth": "none" if abs(torques[0]) < 1e-12 else "some", "others": float(np.abs(torques[1:]).max())}


def spin() -> Facts:
    """Moment about the normal that a sole of the humanoid can give at most, with 98.1 N on it and µ = 0.6."""
    human = tw.load("humanoid")
    q = human.standing()
    sole = tw.frame_placement(human, q, "left_sole").inverse()
    corners = [sole.act(tw.frame_placement(human, q, f"left_sole_{at}").translation) for at in ("fl", "fr", "rr", "rl")]
    length, width = np.abs(corners).max(axis=0)[:2]
    reach = float(np.hypot(length, width))
    return {"truth": MU * 98.1 * reach, "without": 98.1 * reach, "force": MU * 98.1, "half": 1000 * float(length)}

"""Answers to the questions of 49.2: fields of velocities, screws, and what becomes of them."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts


def origin() -> Facts:
    """Linear part of the spatial twist of a Go2 that walks and turns at (1, 0.5) m, in m/s."""
    model = tw.load("go2")
    q, v = model.standing(), np.zeros(model.nv)
    q[:2], v[2], v[3] = (1.0, 0.5), 0.6, 0.8
    spatial = tw.frame_jacobian(model, q, "FR_foot", "world") @ v
    return {"truth": float(np.linalg.norm(spatial[3:])), "base": 0.8, "arm": 0.6 * float(np.hypot(1.0, 0.5))}


def centre() -> Facts:
    """Distance to the left of the point that stands still, of a base that walks at 0.8 m/s and turns at 0.6 rad/s."""
    speed, turn = 0.8, 0.6
    return {
        "truth": float(tw.screw([0, 0, turn, speed, 0, 0]).point[1]),
        "inverse": turn / speed,
        "product": turn * speed,
    }


def straight() -> Facts:
    """Growth of a body on a full circle in twelve steps of 1 + [V] t; the determinant of its rotation."""
    V = np.array([0, 0, 0.6, 0.8, 0, 0])
    whole = np.linalg.matrix_power(np.eye(4) + tw.hat(V) * (2 * np.pi / 0.6 / 12), 12)
    det = float(np.linalg.det(whole[:3, :3]))
    return {"truth": "larger" if det > 1.1 else "smaller" if det < 0.9 else "back", "det": det}


def together() -> Facts:
    """Whether the calf of a leg whose three hinges turn at once moves about a hinge as well; its pitch in mm."""
    model = tw.load("go2")
    q = model.standing()
    hip = model.v_slice[model.joint_id("FR_hip_joint")].start
    screws = tw.frame_jacobian(model, q, "FR_foot", "world")[:, hip : hip + 3].mT
    pitch = 1000 * abs(float(tw.screw(np.array([3.0, -2.0, 4.0]) @ screws).pitch))
    return {"truth": "screw" if pitch > 1e-6 else "hinge", "pitch": pitch}


def slow() -> Facts:
    """Which is exact, the axis or a velocity, where a body slides at 1 m/s and hardly turns, at 1e-13 rad/s."""
    direction, through = np.array([0.36, 0.48, 0.80]), np.array([0.3, -0.2, 0.1])
    V = np.concatenate([1e-13 * direction, 1e-13 * np.cross(through, direction) + direction])
    nearest = through - direction * (direction @ through)
    axis = float(np.linalg.norm(tw.screw(V).point - nearest))
    velocity = float(np.linalg.norm(V[3:] + np.cross(V[:3], through) - direction))
    truth = "velocity" if axis > 1e-6 > velocity else "neither" if velocity > 1e-6 else "both"
    return {"truth": truth, "axis": 1000 * axis}


def order() -> Facts:
    """How a robot moves that should go forward at 1 m/s, where its twist is read in the other order."""
    model = tw.load("go2")
    forward = np.zeros(model.nv)
    forward[0] = 1.0
    twist = np.asarray(tw.forward_kinematics(model, model.standing(), forward).twist)[1]
    return {"truth": ("rolls", "pitches", "turns", "drives", "slides", "rises")[int(np.argmax(np.abs(twist)))]}

"""Robots that touch something, and the 50-digit truth of how they then move, for the tests of contact."""

from __future__ import annotations

from typing import NamedTuple

import mpmath
import numpy as np

import twistwrench as tw
from twistwrench import newton_euler_3d as slow

from .robots import shared

mpmath.mp.dps = 50


def solid(name: str, mass: float, sides, points: dict[str, tuple[float, float, float]]) -> tw.Model:
    """A floating cuboid of given sides with named points on it."""
    x, y, z = np.square(sides)
    inertia = tw.SpatialInertia(mass, [0, 0, 0], mass / 12 * np.diag([y + z, x + z, x + y]))
    builder = tw.Builder(name, base="floating", root="body", root_inertia=inertia)
    for frame, place in points.items():
        builder.link(frame, parent="body", placement=tw.SE3(np.eye(3), place))
    return builder.build()


def corners(sides) -> dict[str, tuple[float, float, float]]:
    x, y, z = np.divide(sides, 2)
    return {f"{a}{b}": (i * x, j * y, -z) for a, i in (("f", 1), ("r", -1)) for b, j in (("l", 1), ("r", -1))}


BOX_SIDES = (0.6, 0.4, 0.2)
BOX = solid("box", 8.0, BOX_SIDES, corners(BOX_SIDES))
GO2, HUMANOID = shared("go2"), shared("humanoid")
SOLE = (0.076, 0.0275)


def points(frames, mu=0.6, **more) -> list[tw.PointContact]:
    return [tw.PointContact(frame, mu, **more) for frame in frames]


BOX_CORNERS = points(["fl", "fr", "rl", "rr"])
FEET = points(GO2.feet)
SOLES = [tw.SurfaceContact(f"{side}_sole", SOLE, 0.6) for side in ("left", "right")]
SOLE_CORNERS = points([f"{side}_sole_{corner}" for side in ("left", "right") for corner in ("fl", "fr", "rl", "rr")])


def posed(turn, place) -> np.ndarray:
    """A free-flyer's q: turned by a rotation vector, at a place."""
    return tw.Model.integrate(BOX, BOX.neutral(), np.r_[turn, 0, 0, 0]) + np.r_[place, 0, 0, 0, 0]


def straight(plumb: bool) -> np.ndarray:
    """Go2 with straight legs; plumb, with its feet right below the hips' axes."""
    q = GO2.neutral()
    feet = [tw.frame_placement(GO2, q, foot).translation for foot in GO2.feet]
    for foot, p in zip(GO2.feet, feet, strict=True):
        hip = GO2.joint_id(f"{foot[:2]}_hip_joint")
        offset = p[1] - tw.forward_kinematics(GO2, q).placement[hip].translation[1]
        if plumb:
            q[GO2.q_slice[hip]] = np.arctan2(-offset, -p[2])
    return q


class Truth(NamedTuple):
    qdd: np.ndarray
    forces: dict[str, np.ndarray]
    rank: int


def kkt(model, q, v, tau, contacts, f_ext=None) -> Truth:
    """M q̈ + h = τ + Jᵀ λ with J q̈ + J̇ v = 0 and the least forces at the touching points, in 50 digits.

    Soles are four points each; independent rows are picked by Gram and Schmidt, and the linear systems solved by LU.
    """
    q, v, tau = (slow.as_mpmath(x) for x in (q, v, tau))
    f_ext = None if f_ext is None else slow.as_mpmath(f_ext)
    rows, rates, arms = [], [], []
    for c in contacts:
        J = slow.frame_jacobian(model, q, c.frame, "local_world_aligned")
        a = slow.frame_bias_acceleration(model, q, v, c.frame, "local_world_aligned")
        R, _ = slow.frame_placement(model, q, c.frame)
        for p in c.points:
            arm = R.dot(slow.as_mpmath(p)) if isinstance(c, tw.SurfaceContact) else slow.as_mpmath(p)
            rows.append(J[3:] + np.stack([cross(w, arm) for w in J[:3].T], axis=1))
            rates.append(a[3:] + cross(a[:3], arm))
            arms.append((c, arm))
    J, rate = np.concatenate(rows), np.concatenate(rates)
    M = slow.mass_matrix(model, q)
    free = tau - slow.inverse_dynamics(model, q, v, 0 * v, f_ext)
    B = J[independent(J)]
    b = rate[independent(J)]
    n, r = len(v), len(B)
    K = np.block([[M, -B.T], [B, np.zeros((r, r), int)]])
    qdd = solve(K, np.concatenate([free, -b]))[:n]
    f = J.dot(B.T).dot(solve(B.dot(J.T).dot(J).dot(B.T), B.dot(M.dot(qdd) - free)))
    forces = {c.frame: slow.as_mpmath(np.zeros(c.dim)) for c in contacts}
    for (c, arm), push in zip(arms, f.reshape(-1, 3), strict=True):
        forces[c.frame] = forces[c.frame] + np.concatenate([cross(arm, push), push])[c.rows]
    return Truth(qdd, forces, r)


def cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def independent(J) -> list[int]:
    """Rows of which none is a sum of those before."""
    basis, picked = [], []
    for k, row in enumerate(J):
        rest = row
        for _ in range(2):
            for unit in basis:
                rest = rest - unit.dot(rest) * unit
        norm = mpmath.sqrt(rest.dot(rest))
        if norm > mpmath.mpf(10) ** -14:  # the inputs are rounded to double precision
            basis.append(rest / norm)
            picked.append(k)
    return picked


def solve(A, b):
    return np.array(list(mpmath.lu_solve(mpmath.matrix(A.tolist()), mpmath.matrix(b.tolist()))))


def error(ours, true, size=0.0) -> float:
    """The largest difference, relative to the largest entry, or to `size` where that is larger."""
    true = np.asarray(true)
    return float(abs(slow.as_mpmath(ours) - true).max() / max(abs(true).max(), size))


def motors(model, rng) -> np.ndarray:
    """Random joint forces, none on the base."""
    return tw.selection_matrix(model).T @ rng.standard_normal(model.nv - 6)


def on_bodies(model, q, contacts, forces):
    """Return forces at contact points, in the axes of the world, as wrenches on the bodies that carry them."""
    f_ext = np.zeros((model.nbodies, 6))
    placement = tw.forward_kinematics(model, q).placement
    for name, force in zip(contacts, forces, strict=True):
        body = model.frame(name).body
        R, p = placement[body].rotation, placement[body].translation
        arm = tw.frame_placement(model, q, name).translation - p
        f_ext[body] += np.concatenate([R.T @ np.cross(arm, force), R.T @ force])
    return f_ext

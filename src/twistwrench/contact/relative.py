"""How a frame moves in what holds it, the world or another body: its place, J v, and its rate J q̈ + J̇ v (49.9).

In the axes of what holds it, at the frame's origin. With the world, J v is the velocity of a point that goes along with
the robot, and its rate is that point's classical acceleration: it is zero where the point is at rest, not the linear
half of the spatial acceleration, which is ω × v less.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import DTypeLike

from ..algorithms.kinematics import motion, placements
from ..arrays import Array
from ..model import Model, Tree, cast, columns, tree_terms
from ..spatial import SE3

__all__ = ["FrameRows", "Loop", "Posture", "StateMotion"]


class FrameRows(NamedTuple):
    """How a frame moves in what holds it, in the axes of that.

    Attributes
    ----------
    point : ndarray, shape (..., 3)
        The frame's origin.
    J : ndarray, shape (..., 6, nv)
    bias : ndarray, shape (..., 6)
        J̇ v.
    v : ndarray, shape (..., nv)
    rotation : ndarray, shape (..., 3, 3)
        The frame's axes.
    """

    point: Array
    J: Array
    bias: Array
    v: Array
    rotation: Array


class Posture(NamedTuple):
    """A configuration of a robot, and the placements of its bodies in their parents there."""

    model: Model
    q: Array
    placement: Sequence[SE3]


class StateMotion(NamedTuple):
    """A state of a robot, and how its bodies move in it where q̈ = 0: what the rows of all its contacts share."""

    model: Model
    q: Array
    v: Array
    tree: Tree
    bodies: list[SE3]
    """The placements of the bodies in the world."""
    qd: list[Array]
    qdd: list[Array]
    V: list[Array]
    A: list[Array]

    @property
    def posture(self) -> Posture:
        """The configuration."""
        return Posture(self.model, self.q, self.tree.placement)

    @classmethod
    def of(cls, model: Model, q: Array, v: Array) -> StateMotion:
        """Compute the twists and accelerations of all bodies."""
        tree = tree_terms(model, q)
        bodies = placements(model.parent, tree.placement)
        qd = columns(model, v)
        qdd = columns(model, np.zeros_like(v))
        V, A = motion(tree, qd, qdd)
        return cls(model, q, v, tree, bodies, qd, qdd, V, A)


class Loop(NamedTuple):
    """A frame on body i, what holds it (a frame on body k, or the world), and the joints that move one in the other."""

    i: int
    k: int
    frame: SE3
    to: SE3 | None
    joints: frozenset[int]

    @classmethod
    def of(cls, model: Model, frame: str, to: str | None, dtype: DTypeLike) -> Loop:
        """Find the joints that carry one of the two frames but not both."""
        here = model.frame(frame)
        k = 0 if to is None else model.frame(to).body
        there = None if to is None else cast(model.frame(to).placement, dtype)
        joints = frozenset(model.support(here.body)) ^ frozenset(model.support(k))
        return cls(here.body, k, cast(here.placement, dtype), there, joints)

    def place(self, at: Posture) -> SE3:
        """Return where the frame is in the one that holds it, from the bodies of the loop alone."""

        def carried(body: int, T: SE3) -> SE3:
            while body in self.joints:
                T = at.placement[body] @ T
                body = at.model.parent[body]
            return T

        there = carried(self.i, self.frame)
        return there if self.to is None else carried(self.k, self.to).inverse() @ there

    def rows(self, state: StateMotion) -> FrameRows:
        """Return how the frame moves in what holds it: all six rows of J and of J̇ v, in the axes of that.

        What moves both frames alike has no part in it: with a frame `to`, the joints of the loop alone move the bodies.
        """
        model = state.model
        tree = state.tree
        bodies = state.bodies
        v = state.v
        at = self.place(state.posture)
        V, A = state.V, state.A
        if self.to is not None:
            own = [x if i in self.joints else np.zeros_like(x) for i, x in enumerate(state.qd)]
            V, A = motion(tree, own, state.qdd)
        J, bias = self._rows(model, tree, bodies, at.translation, v, V, A)
        return FrameRows(at.translation, J, bias, v, at.rotation)

    def _rows(
        self, model: Model, tree: Tree, bodies: Sequence[SE3], point: Array, v: Array, V: list[Array], A: list[Array]
    ) -> tuple[Array, Array]:
        """Return all six rows of J, shape (..., 6, nv), and of J̇ v, in the axes of what holds the frame.

        `point` is the frame's origin there; V and A are the motion of the bodies by the joints of the loop alone.
        """
        i = self.i
        k = self.k
        arm = self.frame.translation
        J = self._jacobian(model, bodies, tree, i, arm)
        bias = _bias(bodies[i], V[i][..., 0], A[i][..., 0], arm)
        if self.to is None:
            return J, bias
        arm = self.to.act(point)
        J = J - self._jacobian(model, bodies, tree, k, arm)
        bias = bias - _bias(bodies[k], V[k][..., 0], A[k][..., 0], arm)
        # What holds the frame turns with ω, so do its axes; and the point of it that holds the frame is another one.
        w = np.matvec(bodies[k].rotation, V[k][..., :3, 0])
        slip = np.matvec(J, v)
        turning = np.concatenate([np.cross(w, slip[..., :3]), 2 * np.cross(w, slip[..., 3:])], axis=-1)
        bias = bias - turning
        R = (bodies[k].rotation @ self.to.rotation).mT
        turned = [np.matvec(R, x) for x in (bias[..., :3], bias[..., 3:])]
        return np.concatenate([R @ J[..., :3, :], R @ J[..., 3:, :]], axis=-2), np.concatenate(turned, axis=-1)

    def _jacobian(self, model: Model, bodies: Sequence[SE3], tree: Tree, body: int, point: Array) -> Array:
        """Return the rows (ω, v) of a point of a body, by the joints of the loop, in the axes of the world.

        The point is expressed in one body after the other: a difference of positions in the world would lose digits
        far from its origin, and with them the rank.
        """
        J = np.zeros((*bodies[0].translation.shape[:-1], 6, model.nv), point.dtype)
        for i in model.support(body):
            S = tree.S[i]
            if i in self.joints:
                shift = S[3:] + np.cross(S[:3], point[..., None], axis=-2)
                J[..., :3, model.v_slice[i]] = bodies[i].rotation @ S[:3]
                J[..., 3:, model.v_slice[i]] = bodies[i].rotation @ shift
            point = tree.placement[i].act(point)
        return J


def _bias(at: SE3, V: Array, A: Array, arm: Array) -> Array:
    """Return (α, a) of a point of a body without q̈, in the axes of the world, shape (..., 6).

    From the body's spatial acceleration A: its origin's classical one is ω × v more.
    """
    w, alpha = V[..., :3], A[..., :3]
    a = A[..., 3:] + np.cross(w, V[..., 3:]) + np.cross(alpha, arm) + np.cross(w, np.cross(w, arm))
    return np.concatenate([np.matvec(at.rotation, alpha), np.matvec(at.rotation, a)], axis=-1)

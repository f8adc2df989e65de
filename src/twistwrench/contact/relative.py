"""How contacts move in what holds them, the world or another body: their place, J v, and its rate J q̈ + J̇ v (49.9).

In the axes of what holds them, at the origin of each contact's frame, in the order of the contacts. With the world,
J v is the velocity of a point that goes along with the robot, and its rate is that point's classical acceleration: it
is zero where the point is at rest, not the linear half of the spatial acceleration, which is ω × v less.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import DTypeLike

from ..algorithms.kinematics import motion, placements
from ..arrays import Array, check_kind
from ..errors import unknown_name
from ..model import Model, Tree, cast, columns, tree_terms
from ..spatial import SE3, exp3, log3
from .closures import Coupling
from .types import Contact, FrameRows

__all__ = ["ContactRows", "contact_errors", "contact_rows", "given_motion", "moved", "moved_anchors", "place"]


class ContactRows(NamedTuple):
    """Where the contacts' frames are in what holds them, their J and their J̇ v."""

    placement: list[SE3]
    J: Array
    bias: Array


def contact_rows(model: Model, q: Array, v: Array, contacts: Sequence[Contact]) -> ContactRows:
    """Return the kinematics of all contacts."""
    tree = tree_terms(model, q)
    bodies = placements(model.parent, tree.placement)
    qd, qdd = columns(model, v), columns(model, np.zeros_like(v))
    motion_of_all = motion(tree, qd, qdd)
    at: list[SE3] = []
    J = [np.zeros((*q.shape[:-1], 0, model.nv), q.dtype)]
    bias = [np.zeros((*q.shape[:-1], 0), q.dtype)]
    for c in contacts:
        at.append(place(model, tree.placement, q, c))
        if isinstance(c, Coupling):
            J_c, bias_c = c.jacobian(model, q), np.zeros((*q.shape[:-1], 1), q.dtype)
        else:
            loop, (V, A) = Loop.of(model, c, q.dtype), motion_of_all
            if c.to is not None:
                own = [x if i in loop.joints else np.zeros_like(x) for i, x in enumerate(qd)]
                V, A = motion(tree, own, qdd)
            T = loop.place(model, tree.placement)
            J_c, bias_c = loop.rows(model, tree, bodies, T.translation, v, V, A)
            J_c, bias_c = c.held_rows(FrameRows(T.translation, J_c, bias_c, v, T.rotation))
        J.append(J_c)
        bias.append(bias_c)
    return ContactRows(at, np.concatenate(J, axis=-2), np.concatenate(bias, axis=-1))


class Loop(NamedTuple):
    """A frame on body i, what holds it (a frame on body k, or the world), and the joints that move one in the other."""

    i: int
    k: int
    frame: SE3
    to: SE3 | None
    joints: frozenset[int]

    @classmethod
    def of(cls, model: Model, c: Contact, dtype: DTypeLike) -> Loop:
        """Find the joints that carry one of the two frames but not both."""
        here = model.frame(c.frame)
        k, to = 0, None
        if c.to is not None:
            k, to = model.frame(c.to).body, cast(model.frame(c.to).placement, dtype)
        joints = frozenset(model.support(here.body)) ^ frozenset(model.support(k))
        return cls(here.body, k, cast(here.placement, dtype), to, joints)

    def place(self, model: Model, placement: Sequence[SE3]) -> SE3:
        """Return where the frame is in the one that holds it, from the bodies of the loop alone."""

        def carried(body: int, T: SE3) -> SE3:
            while body in self.joints:
                body, T = model.parent[body], placement[body] @ T
            return T

        there = carried(self.i, self.frame)
        return there if self.to is None else carried(self.k, self.to).inverse() @ there

    def rows(
        self, model: Model, tree: Tree, bodies: Sequence[SE3], point: Array, v: Array, V: list[Array], A: list[Array]
    ) -> tuple[Array, Array]:
        """Return all six rows of J, shape (..., 6, nv), and of J̇ v, in the axes of what holds the frame.

        `point` is the frame's origin there; V and A are the motion of the bodies by the joints of the loop alone.
        """
        i, k, arm = self.i, self.k, self.frame.translation
        J, bias = self._jacobian(model, bodies, tree, i, arm), _bias(bodies[i], V[i][..., 0], A[i][..., 0], arm)
        if self.to is None:
            return J, bias
        arm = self.to.act(point)
        J = J - self._jacobian(model, bodies, tree, k, arm)
        bias = bias - _bias(bodies[k], V[k][..., 0], A[k][..., 0], arm)
        # What holds the frame turns with ω, so do its axes; and the point of it that holds the frame is another one.
        w, slip = np.matvec(bodies[k].rotation, V[k][..., :3, 0]), np.matvec(J, v)
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
                turn, shift = S[:3], S[3:] + np.cross(S[:3], point[..., None], axis=-2)
                J[..., :3, model.v_slice[i]] = bodies[i].rotation @ turn
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


def place(model: Model, placement: Sequence[SE3], q: Array, c: Contact) -> SE3:
    """Return where a contact's frame is in what holds it, from the placements of the bodies in their parents.

    Of a coupling the translation (q − Σ ratio q, 0, 0), which stays as it is; of points at a distance (d, 0, 0).
    """
    if not isinstance(c, Coupling):
        return c.held_place(Loop.of(model, c, q.dtype).place(model, placement))
    off = np.zeros((*q.shape[:-1], 3), q.dtype)
    if c.counts_turns(model):
        off[..., :1] = np.matvec(c.coefficients(model, model.q_slice, model.nq, q.dtype), q)
    return SE3._trusted(np.broadcast_to(np.eye(3, dtype=q.dtype), (*q.shape[:-1], 3, 3)), off)


def given_motion(contacts: Sequence[Contact], name: str) -> Array:
    """Return the given velocities or accelerations of all contacts, in the order of the rows of J."""
    return np.concatenate([np.zeros(0), *(getattr(c, name) or np.zeros(c.dim) for c in contacts)])


def moved(contacts: tuple[Contact, ...], t: float) -> tuple[Contact, ...]:
    """Return contacts as they are after a time at their given, constant accelerations."""
    return tuple(
        replace(c, velocity=tuple((given_motion([c], "velocity") + t * np.array(c.acceleration)).tolist()))  # type: ignore[type-var]
        if c.acceleration
        else c
        for c in contacts
    )


def moved_anchors(model: Model, contacts: Sequence[Contact], anchors: Mapping[str, SE3], t: float) -> dict[str, SE3]:
    """Return where the contacts' frames belong after a time; a given turn goes about an axis that does not turn."""
    later = dict(anchors)
    for c in contacts:
        if (c.velocity or c.acceleration) and not (isinstance(c, Coupling) and not c.counts_turns(model)):
            turns, more = (given_motion([c], name)[:3] for name in ("velocity", "acceleration"))
            if c.dim == 6 and np.cross(turns, more).any():
                raise ValueError(
                    f"contact {c.frame!r}: acceleration: expected one that turns about the axis of velocity, "
                    f"{turns.tolist()}, got {more.tolist()}"
                )
            way = t * given_motion([c], "velocity") + t**2 / 2 * given_motion([c], "acceleration")
            turn, shift = np.split(np.linalg.pinv(c.directions) @ way, 2)
            T = anchors[c.frame]
            later[c.frame] = SE3._trusted(exp3(turn) @ T.rotation, T.translation + shift)
    return later


def contact_errors(contacts: Sequence[Contact], now: Sequence[SE3], anchors: Mapping[str, SE3]) -> Array:
    """Return how far the contacts are from their anchors, in the order of the rows of J, rad and m."""
    check_kind(anchors, "anchors", Mapping, "placements by frame, as from contact_placements")
    missing = [c.frame for c in contacts if c.frame not in anchors]
    if missing:
        raise unknown_name("anchor", missing[0], anchors)
    parts = [np.zeros((*now[0].translation.shape[:-1], 0))] if now else [np.zeros(0)]
    for c, T in zip(contacts, now):
        check_kind(anchors[c.frame], f"anchors[{c.frame!r}]", SE3, "an SE3")
        anchor = cast(anchors[c.frame], np.float64)
        moved = T.translation - anchor.translation
        turned = log3(T.rotation @ anchor.rotation.mT) if c.placed[:, :3].any() else np.zeros_like(moved)
        parts.append(np.matvec(c.placed, np.concatenate([turned, moved], axis=-1)))
    return np.concatenate(parts, axis=-1)

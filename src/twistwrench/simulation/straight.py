"""Steps in axes that do not turn: a body that turns while it flies goes straight on (49.2, 49.5).

The velocity of a floating base, or of a joint that slides and turns, is in axes that turn with it. The entries v along
them change though nothing pushes, v̇ = a with a = −ω × v, and a method that adds dt a to them adds to the speed as well:
√(1 + ω² dt²) a step. In axes that stand still it is v̇ = a + ω × v, which is the force over the mass and nothing else.
So a step is made in the axes of one instant: the velocity is turned into them, changed there, and turned into those of
the end, v⁺ = exp(−dt ω) (v + dt (a + ω × v)).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arrays import Array
from ..fast.programs import cached_program
from ..fast.quantities import Quantity
from ..model import GroupJoint, Model
from ..spatial import cross_motion, skew
from ..spatial._quaternions import exp_quaternion
from ..spatial.rotation import quaternion_matrix

__all__ = ["go_straight", "in_turned_axes", "straight_rate", "turning"]


def go_straight(model: Model, q: Array, u: Array) -> Array:
    """Return where q is after a step u at which what flies goes straight: first it is shifted, then it turns.

    `Model.integrate` would go along the screw of u.
    """
    asked = Quantity("q", ("q", "v"), lambda q, u: (shifted_and_turned(model, q, u), []))
    there: Array = cached_program(model, ("straight", u.dtype), u.dtype, lambda: [asked], single=True)(q, u)
    return there


def shifted_and_turned(model: Model, q: Array, u: Array) -> Array:
    """Return what `go_straight` does, by the textbook."""
    shifted, turn = q.copy(), u.copy()
    for i, joint, s in sliding(model):
        S = joint.subspace(u.dtype)
        place = model.q_slice[i]
        way = np.matvec(joint.transform(q[..., place]).rotation, np.matvec(S[3:], u[..., s]))
        size = int(joint.subspace()[3:].any(axis=0).sum())  # of its place, which comes first in q
        shifted[..., place.start : place.start + size] += way[..., :size]
        turn[..., s] = np.matvec(S.mT[:, :3], np.matvec(S[:3], u[..., s]))
    return model._step(shifted, turn) if u.dtype == object else model.integrate(shifted, turn)


def in_turned_axes(model: Model, v: Array, u: Array) -> Array:
    """Return the velocity v in the axes of what slides and turns after it has turned by its part of u."""
    asked = Quantity("turned", ("v", "a"), lambda v, u: (turned(model, v, u), []))
    there: Array = cached_program(model, ("turned", u.dtype), u.dtype, lambda: [asked], single=True)(v, u)
    return there


def turned(model: Model, v: Array, u: Array) -> Array:
    """Return what `in_turned_axes` does, by the textbook."""
    new = v.copy()
    for _, joint, s in sliding(model):
        S = joint.subspace(u.dtype)
        R = quaternion_matrix(exp_quaternion(np.matvec(S[:3], u[..., s])))
        along = np.matvec(R.mT, np.matvec(S[3:], v[..., s]))
        new[..., s] = np.matvec(S.mT[:, :3], np.matvec(S[:3], v[..., s])) + np.matvec(S.mT[:, 3:], along)
    return new


def turning(model: Model, v: Array) -> Array:
    """Return ω × v of what slides and turns: what is to be added to an acceleration for axes that stand still."""
    asked = Quantity("turning", ("v",), lambda v: (turning_rate(model, v), []))
    there: Array = cached_program(model, ("turning", v.dtype), v.dtype, lambda: [asked], single=True)(v)
    return there


def turning_rate(model: Model, v: Array) -> Array:
    """Return what `turning` does, by the textbook."""
    more = np.zeros_like(v)
    for _, joint, s in sliding(model):
        S = joint.subspace(v.dtype)
        twist = np.matvec(S, v[..., s])
        spin = np.concatenate([twist[..., :3], np.zeros_like(twist[..., 3:])], axis=-1)
        more[..., s] = np.matvec(S.mT, np.matvec(cross_motion(spin), twist))
    return more


def straight_rate(model: Model, u: Array, v: Array) -> Array:
    """Return u̇ of a way u that is gone with the velocity v in the axes of its beginning (`go_straight`).

    What is shifted is shifted by v. What turns, R = exp φ, turns with φ̇ = dexp⁻¹₋ᵩ ω = ω + ½ φ × ω + 1/12 φ × (φ × ω),
    and terms of the fourth order in φ: what methods up to order 4 need.
    """

    def asked() -> list[Quantity]:
        return [Quantity("rate", ("v", "a"), lambda u, v: (v + turns_further(model, u, v), []))]

    found: Array = cached_program(model, ("rate", v.dtype), v.dtype, asked, single=True)(u, v)
    return found


def turns_further(model: Model, u: Array, v: Array) -> Array:
    """Return φ̇ − ω of balls, floating bases and planar joints; 0 elsewhere."""
    more = np.zeros_like(v)
    for joint, s in zip(model.joints, model.v_slice):
        if isinstance(joint, GroupJoint):
            S = joint.subspace(u.dtype)[:3]
            first = np.matvec(skew(np.matvec(S, u[..., s])), np.matvec(S, v[..., s]))
            second = np.matvec(skew(np.matvec(S, u[..., s])), first)
            more[..., s] = np.matvec(S.mT, first / 2 + second / 12)
    return more


def sliding(model: Model) -> Iterator[tuple[int, GroupJoint, slice]]:
    """Yield the joints that slide in axes that turn with them, and their entries of v: floating and planar ones."""
    for i, (joint, s) in enumerate(zip(model.joints, model.v_slice)):
        if isinstance(joint, GroupJoint) and joint.subspace()[3:].any():
            yield i, joint, s

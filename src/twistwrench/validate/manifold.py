"""The configuration manifold in exact numbers: what `Model.integrate` must return (49.1, 49.3).

Quaternions, (cos, sin) and the power series of the exponential, which the package itself does not use for this.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Array
from ..errors import ModelError
from ..model import Continuous, FreeFlyer, Joint, Model, Planar, Spherical
from ..newton_euler_3d.bodies import cross

__all__ = ["integrate"]


def integrate(model: Model, q: Array, dv: Array) -> Array:
    """Return q ⊕ dv for one state of mpmath numbers, shape (nq,)."""
    pieces = [
        _step(joint, q[qs], dv[vs])
        for joint, qs, vs in zip(model.joints, model.q_slice, model.v_slice, strict=True)
        if joint
    ]
    return np.concatenate(pieces)


def _step(joint: Joint, q: Array, dv: Array) -> Array:
    if joint.unit is None:
        return q + dv
    if isinstance(joint, Continuous):
        return _turned(q, dv[0])
    if isinstance(joint, Planar):
        c, s, w = q[2], q[3], dv[2]
        shift = _shift(np.array([w * 0, w * 0, w]), np.array([dv[0], dv[1], w * 0]))
        place = q[:2] + np.array([c * shift[0] - s * shift[1], s * shift[0] + c * shift[1]])
        return np.concatenate([place, _turned(q[2:], w)])
    if isinstance(joint, Spherical):
        return _product(q, _quaternion(dv))
    if not isinstance(joint, FreeFlyer):
        raise ModelError(f"no exact step is known for a joint of kind {joint.kind!r}")
    position = q[:3]
    quaternion = q[3:]
    return np.concatenate(
        [position + _rotate(quaternion, _shift(dv[:3], dv[3:])), _product(quaternion, _quaternion(dv[:3]))]
    )


def _turned(cs: Array, angle: Any) -> Array:
    """Turn a direction (cos, sin) of any length."""
    mp = angle.context
    c, s = cs / mp.sqrt((cs * cs).sum())
    return np.array([c * mp.cos(angle) - s * mp.sin(angle), s * mp.cos(angle) + c * mp.sin(angle)])


def _quaternion(w: Array) -> Array:
    """Return (x, y, z, w) of the turn by the vector `w`."""
    mp = w[0].context
    angle = mp.sqrt((w * w).sum())
    half_sinc = mp.sin(angle / 2) / angle if angle else mp.mpf(1) / 2
    return np.append(w * half_sinc, mp.cos(angle / 2))


def _product(a: Array, b: Array) -> Array:
    """Return the quaternion product a b, of length 1."""
    u, v = a[:3], b[:3]
    product = np.append(a[3] * v + b[3] * u + cross(u, v), a[3] * b[3] - (u * v).sum())
    unit: Array = product / product[0].context.sqrt((product * product).sum())
    return unit


def _rotate(quaternion: Array, x: Array) -> Array:
    """Return u x u⁻¹ for a quaternion u of any length."""
    u = quaternion[:3]
    w = quaternion[3]
    square = (quaternion * quaternion).sum()
    rotated: Array = x + 2 * (w * cross(u, x) + cross(u, cross(u, x))) / square
    return rotated


def _shift(w: Array, v: Array) -> Array:
    """Return ∫₀¹ exp(t [w]×) v dt = v + w × v / 2! + w × (w × v) / 3! + …, to the last digit."""
    total = v
    term = v
    k = 1
    while (abs(term) > v[0].context.eps * abs(v).max()).any():
        k += 1
        term = cross(w, term) / k
        total = total + term
    return total

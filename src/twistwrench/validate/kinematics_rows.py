"""The rows of 49.1 to 49.3 and the Jacobians of 49.9: where things are and how they move."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from .. import bridge
from .. import newton_euler_3d as ne
from ..algorithms.kinematics import Reference
from ..arrays import Array
from ..model import Model
from . import exact, manifold
from .conditioning import twist_products
from .oracle import Oracle
from .quantity import ComparedQuantity
from .states import States

__all__ = ["KINEMATICS"]


def _placements(model: Model, s: States) -> list[tw.SE3]:
    return tw.forward_kinematics(model, s.q).placement[1:]


def _truly(model: Model, s: States) -> tuple[Array, Array]:
    R, p = ne.placements(model, s.q)
    return R[1:], p[1:]


def _stack(arrays: list[Array]) -> Array:
    """Put what is a list over bodies or frames on the axis after the batch."""
    return np.stack(arrays, axis=1)


def _frame_row(section: str, name: str, reference: Reference, of: str) -> ComparedQuantity:
    return ComparedQuantity(
        section,
        name,
        of,
        ours=lambda m, s: _stack([tw.frame_jacobian(m, s.q, frame, reference) for frame in s.frames]),
        theirs=lambda p, s: p.frame_jacobians(s, reference),
        truth=lambda m, s: np.stack([ne.frame_jacobian(m, s.q, f, reference) for f in s.frames]),
        applies=lambda m: bool(m.frames),
    )


def _bias_row(section: str, name: str, reference: Reference, of: str) -> ComparedQuantity:
    return ComparedQuantity(
        section,
        name,
        of,
        ours=lambda m, s: _stack([tw.frame_bias_acceleration(m, s.q, s.v, frame, reference) for frame in s.frames]),
        theirs=lambda p, s: p.frame_bias(s, reference),
        truth=lambda m, s: np.stack([ne.frame_bias_acceleration(m, s.q, s.v, f, reference) for f in s.frames]),
        terms=lambda m, s: twist_products(m, s, reference),
        applies=lambda m: bool(m.frames),
    )


def _pinocchio_step(p: Oracle, s: States) -> Array:
    return np.array(p.pin.integrate(p.model, s.q, p.tangent(s.dv)))


def _pinocchio_difference(p: Oracle, s: States) -> Array:
    return p.vector(p.pin.difference(p.model, s.q, _pinocchio_step(p, s)))


KINEMATICS = (
    ComparedQuantity(
        "49.1",
        "step on the manifold",
        "integrate",
        ours=lambda m, s: m.integrate(s.q, s.dv),
        theirs=_pinocchio_step,
        truth=lambda m, s: manifold.integrate(m, s.q, s.dv),
    ),
    ComparedQuantity(
        "49.1",
        "difference of two q",
        "difference",
        ours=lambda m, s: m.difference(s.q, m.integrate(s.q, s.dv)),
        theirs=_pinocchio_difference,
        truth=lambda m, s: s.dv,  # every turn in it is below π
        terms=lambda m, s: float(np.abs(s.q).max()),  # a difference of two such
    ),
    ComparedQuantity(
        "49.2",
        "body twists",
        "data.v",
        ours=lambda m, s: np.asarray(tw.forward_kinematics(m, s.q, s.v).twist)[:, 1:],
        theirs=lambda p, s: bridge.from_pinocchio_motion(list(p.motion(s).v)[1:]),
        truth=lambda m, s: ne.body_twists(m, s.q, s.v)[1:],
    ),
    ComparedQuantity(
        "49.3",
        "placements of bodies",
        "data.oMi",
        ours=lambda m, s: _stack([T.matrix() for T in _placements(m, s)]),
        theirs=lambda p, s: np.stack([T.homogeneous for T in p.placements(s.q)]),
        truth=lambda m, s: exact.homogeneous(*_truly(m, s)),
    ),
    ComparedQuantity(
        "49.3",
        "their X, of twists",
        "oMi.action",
        ours=lambda m, s: _stack([T.motion_transform() for T in _placements(m, s)]),
        theirs=lambda p, s: bridge.from_pinocchio_transform(np.stack([T.action for T in p.placements(s.q)])),
        truth=lambda m, s: exact.action(*_truly(m, s)),
    ),
    ComparedQuantity(
        "49.3",
        "their X*, of wrenches",
        "oMi.dualAction",
        ours=lambda m, s: _stack([T.force_transform() for T in _placements(m, s)]),
        theirs=lambda p, s: bridge.from_pinocchio_transform(np.stack([T.dualAction for T in p.placements(s.q)])),
        truth=lambda m, s: exact.dual_action(*_truly(m, s)),
    ),
    ComparedQuantity(
        "49.3",
        "placements of frames",
        "data.oMf",
        ours=lambda m, s: _stack([tw.frame_placement(m, s.q, frame).matrix() for frame in s.frames]),
        theirs=lambda p, s: p.frame_placements(s),
        truth=lambda m, s: exact.frame_placements(m, s),
        applies=lambda m: bool(m.frames),
    ),
    ComparedQuantity(
        "49.6",
        "spatial accelerations",
        "data.a",
        ours=lambda m, s: np.asarray(tw.forward_kinematics(m, s.q, s.v, s.a).acceleration)[:, 1:],
        theirs=lambda p, s: bridge.from_pinocchio_motion(list(p.motion(s).a)[1:]),
        truth=lambda m, s: ne.body_accelerations(m, s.q, s.v, s.a)[1:],
    ),
    _frame_row("49.9", "J, local", "local", "getFrameJacobian LOCAL"),
    _frame_row("49.9", "J, world", "world", "… WORLD"),
    _frame_row("49.9", "J, world axes", "local_world_aligned", "… LOCAL_WORLD_ALIGNED"),
    ComparedQuantity(
        "49.9",
        "J_c of the feet",
        "linear rows of it",
        ours=lambda m, s: tw.contact_jacobian(m, s.q, m.feet),
        theirs=lambda p, s: p.contact_jacobian(s),
        truth=exact.contact_jacobian,
        applies=lambda m: bool(m.feet),
    ),
    _bias_row("49.9", "J̇ v, local", "local", "getFrameAcceleration LOCAL"),
    _bias_row("49.9", "J̇ v, world", "world", "… WORLD"),
    _bias_row("49.9", "J̇ v, world axes", "local_world_aligned", "getFrameClassicalAcceleration"),
)

"""The same robot hung from another link: a foot, a hand or an IMU as the root of the tree (49.6).

A tree has no root of its own. Whatever link is taken, the joints between it and the former root are passed the other
way: what was the parent is now the child, and the joint's transform is the inverse. The motions are the same, so are
energies and forces; only the coordinates of the base are others.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import ModelError
from ..spatial import SE3, cross_motion
from .arguments import check_model
from .checks import PER_DOF
from .joint import AxisJoint, GroupJoint, Joint
from .joints import FreeFlyer
from .model import Frame, Model
from .tree import joint_placements

__all__ = ["Rerooting", "reroot"]


@dataclass(frozen=True, eq=False)
class Rerooting:
    """A model, the same robot hung from another frame, and the maps between their states.

    Attributes
    ----------
    original : Model
    model : Model
        Its base is the frame that was asked for; joints and frames have their names, other numbers.
    root : str
        That frame.

    Examples
    --------
    >>> import twistwrench as tw
    >>> go2 = tw.load("go2")
    >>> foot = reroot(go2, "FL_foot")
    >>> q, v = foot.convert(go2.standing(), np.zeros(go2.nv))
    >>> q[:3].round(3), tw.frame_placement(go2, go2.standing(), "FL_foot").translation.round(3)
    (array([0.193, 0.142, 0.   ]), array([0.193, 0.142, 0.   ]))
    >>> bool(np.isclose(tw.potential_energy(foot.model, q), tw.potential_energy(go2, go2.standing())))
    True
    """

    original: Model
    model: Model
    root: str

    def convert(self, q: ArrayLike, v: ArrayLike, a: ArrayLike | None = None) -> tuple[Array, ...]:
        """Return a state of the original as one of `model`.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v : array_like, shape (..., nv)
        a : array_like, shape (..., nv), optional

        Returns
        -------
        tuple of ndarray
            q and v, and a if it was given. The base's entries are pose, twist and spatial acceleration of the frame, in
            its own axes; a joint of one axis keeps its entry.

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        at = self.original.frame(self.root)
        return _carry(self.original, self.model, self.original.support(at.body)[::-1], at.placement, q, v, a)

    def revert(self, q: ArrayLike, v: ArrayLike, a: ArrayLike | None = None) -> tuple[Array, ...]:
        """Return a state of `model` as one of the original: the inverse of `convert`, with the same errors.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v : array_like, shape (..., nv)
        a : array_like, shape (..., nv), optional

        Returns
        -------
        tuple of ndarray
        """
        at = self.original.frame(self.root)
        way = self.original.support(at.body)[::-1]
        first = way[1] if len(way) > 1 else 1  # the joint that the former base hangs on now
        mount = self.original.placement[first] if len(way) > 1 else at.placement
        back = self.model.support(self.model.joint_id(self.original.joint_names[first]))[::-1]
        return _carry(self.model, self.original, back, mount.inverse(), q, v, a)

    def __repr__(self) -> str:
        return f"<Rerooting of {self.original.name!r} at {self.root!r}>"


def reroot(model: Model, frame: str) -> Rerooting:
    """Hang a robot with a floating base from another of its frames: a foot, a hand, an IMU.

    Parameters
    ----------
    model : Model
        With a floating base: of a fixed one the mass of the root link is not known.
    frame : str
        The base of the new model: its pose is in q, its twist in v.

    Returns
    -------
    Rerooting
        Its model, and the states of one for the other. A model that stands on that foot, welded to the world, is
        ``tw.lock_joints(there.model, [there.model.joint_names[1]], q).model``.

    Raises
    ------
    NameNotFound
        If there is no such frame.
    ModelError
        If the base is fixed, the frame is one of the world, or a joint between the two has limits or a rotor that have
        no meaning when it is passed the other way: those of a base, a planar joint or a ball.

    Notes
    -----
    Section 49.6: X of the reversed joint is X⁻¹. About an axis a it is the same turn about −a, so q, v and limits stay.
    Of the other joints S is kept by X, so that v becomes −SᵀX⁻¹S v.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm", base="floating")
    >>> hand = reroot(arm, "tool").model
    >>> hand.joint_names[1:], hand.parent[1:]
    (('root_joint', 'wrist', 'elbow', 'shoulder'), (0, 1, 2, 3))
    >>> round(hand.mass - arm.mass, 12)
    0.0
    """
    check_model(model)
    at = model.frame(frame)
    if model.base != "floating":
        raise ModelError(f"model {model.name!r}: expected a floating base: load it with base='floating'")
    way = model.support(at.body)[::-1]
    if way[:1] != [1]:
        raise ModelError(f"frame {frame!r}: expected one that the base of {model.name!r} carries")
    _check_base(model)
    own = [SE3.identity() for _ in model.parent]  # of each body: its new frame in its old one
    for parent, child in pairwise(way):
        own[parent] = model.placement[child]
    own[at.body] = at.placement
    back = [T.inverse() for T in own]
    up, place = [*model.parent], [back[max(p, 0)] @ T for p, T in zip(model.parent, model.placement)]
    moved_by, joints = [*range(model.nbodies)], [*model.joints]
    for parent, child in pairwise(way):  # the joint between the two now moves the former parent
        up[parent], place[parent], moved_by[parent], joints[parent] = child, back[child], child, _reversed(model, child)
    up[at.body], place[at.body], moved_by[at.body], joints[at.body] = 0, model.placement[1], 1, model.joints[1]
    names = [model.joint_names[i] for i in moved_by]
    order = _depth_first(up, names)
    number = {i: k for k, i in enumerate(order)}
    new_q = np.concatenate([np.arange(model.nq)[model.q_slice[moved_by[i]]] for i in order])
    new_v = np.concatenate([np.arange(model.nv)[model.v_slice[moved_by[i]]] for i in order])
    there = replace(
        model,
        joint_names=tuple(names[i] for i in order),
        joints=tuple(joints[i] for i in order),
        parent=(-1, *(number[up[i]] for i in order[1:])),
        placement=tuple(place[i] for i in order),
        inertia=tuple(model.inertia[i].transform(back[i]) for i in order),
        frames={name: _moved_frame(f, number[f.body], back[f.body], f.body in way) for name, f in model.frames.items()},
        lower=model.lower[new_q],
        upper=model.upper[new_q],
        postures={},
        **{name: getattr(model, name)[new_v] for name in PER_DOF},
    )
    both = Rerooting(model, there, frame)
    postures = {name: both.convert(q, np.zeros(model.nv))[0] for name, q in model.postures.items()}
    return replace(both, model=replace(there, postures=postures))


def _moved_frame(frame: Frame, body: int, back: SE3, turned: bool) -> Frame:
    """Return a frame on its new body; on the way what hung on it is now before it, so that is no longer known."""
    moved = replace(frame, body=body, placement=back @ frame.placement)
    return replace(moved, parent=None, inertia=None) if turned else moved


def _depth_first(parent: list[int], names: list[str]) -> list[int]:
    """Return the bodies from the world outwards, siblings by the names of their joints: Pinocchio's order."""
    order, waiting = [], [0]
    while waiting:
        order.append(waiting.pop())
        children = [i for i, p in enumerate(parent) if p == order[-1]]
        waiting += sorted(children, key=lambda i: names[i], reverse=True)
    return order


def _check_base(model: Model) -> None:
    """Raise if the base has limits or a rotor, which would be those of another link."""
    if np.isfinite(model.lower[:7]).any() or np.isfinite(model.upper[:7]).any() or model.armature[:6].any():
        raise ModelError(f"joint {model.joint_names[1]!r}: expected a base without limits and armature")


def _reversed(model: Model, i: int) -> Joint:
    """Return the joint whose transform is the inverse of that of joint i, at the same q if it has one axis."""
    joint, name = model.joints[i], model.joint_names[i]
    if isinstance(joint, AxisJoint):
        other: Joint = replace(joint, axis=(-joint.axis[0], -joint.axis[1], -joint.axis[2]))
        q = joint.random(np.random.default_rng(0), np.full(joint.nq, -1.0), np.full(joint.nq, 1.0))
        if np.allclose((joint.transform(q) @ other.transform(q)).matrix(), np.eye(4), rtol=0, atol=1e-12):
            return other
    if not isinstance(joint, GroupJoint):
        raise ModelError(f"joint {name!r}: the inverse of a {type(joint).__name__} is none")
    at_q, at_v = model.q_slice[i], model.v_slice[i]
    limits = {key: getattr(model, key)[at_q] for key in ("lower", "upper")}
    numbers = limits | {key: getattr(model, key)[at_v] for key in PER_DOF}
    for key, x in numbers.items():
        same = (x == x[0]).all() and key in ("armature", "damping") and not joint.subspace()[3:].any()  # of a ball
        if not (same or np.isinf(x).all() or (x == 0).all()):
            raise ModelError(f"joint {name!r}: its {key} would be that of other axes, passed the other way")
    return joint


def _carry(
    source: Model, target: Model, way: list[int], mount: SE3, q: ArrayLike, v: ArrayLike, a: ArrayLike | None
) -> tuple[Array, ...]:
    """Return a state of one model as one of the other, whose base is at `mount` on the last body of the way there."""
    q, *rates = source.state(q, v=v) if a is None else source.state(q, v=v, a=a)
    new_q = np.zeros((*q.shape[:-1], target.nq), q.dtype)
    new_rates = [np.zeros_like(x) for x in rates]
    numbers = {name: i for i, name in enumerate(source.joint_names)}
    for k in range(2, target.nbodies):
        i = numbers[target.joint_names[k]]
        joint, here, there = source.joints[i], q[..., source.q_slice[i]], target.v_slice[k]
        if i in way and isinstance(joint, GroupJoint) and not isinstance(joint, AxisJoint):
            back = joint.transform(here).inverse()
            near = here.copy()
            near[..., joint.unit][..., :-1] *= -1  # the conjugate quaternion
            here = joint.from_placement(back, near)
            S = joint.subspace(q.dtype)
            turn = -S.mT @ back.inverse().motion_transform() @ S
            pieces = [np.matvec(turn, x[..., source.v_slice[i]]) for x in rates]
        else:
            pieces = [x[..., source.v_slice[i]] for x in rates]
        new_q[..., target.q_slice[k]] = here
        for new, piece in zip(new_rates, pieces):
            new[..., there] = piece
    T, twist, *acceleration = _end(source, way, q, *rates)
    X = mount.inverse().motion_transform().astype(q.dtype)
    base = FreeFlyer()
    new_q[..., :7] = base.from_placement(target.placement[1].inverse() @ (T @ mount), near=q[..., :7])
    for new, x in zip(new_rates, [twist, *acceleration]):
        new[..., :6] = np.matvec(X, x)
    return new_q, *new_rates


def _end(model: Model, way: list[int], q: Array, *rates: Array) -> tuple[Any, ...]:
    """Return the placement of the last body of a way from the world, its twist and its acceleration."""
    relative = joint_placements(model, q)
    T = relative[0]
    motions = [np.zeros((*q.shape[:-1], 6), q.dtype) for _ in rates]
    for i in way:
        T = T @ relative[i]
        X = relative[i].inverse().motion_transform()
        S = model.constants(q.dtype).S[i]
        steps = [np.matvec(S, x[..., model.v_slice[i]]) for x in rates]
        motions = [np.matvec(X, x) + step for x, step in zip(motions, steps)]
        if len(rates) == 2:
            motions[1] = motions[1] + np.matvec(cross_motion(motions[0]), steps[0])
    return T, *motions

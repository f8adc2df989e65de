"""Kinematics: where the bodies and frames are, how they move, and the Jacobians (49.2, 49.6, 49.9)."""

from __future__ import annotations

from typing import Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import check_known
from ..model import Model, Tree, cast, check_state, columns, joint_placements, tree_terms
from ..spatial import SE3
from ..spatial.formulas import cross_motion
from ._mimic import also_of_mimics

__all__ = [
    "Kinematics",
    "Reference",
    "forward_kinematics",
    "frame_bias_acceleration",
    "frame_jacobian",
    "frame_placement",
    "motion",
    "placements",
]

Reference = Literal["local", "world", "local_world_aligned"]


class Kinematics(NamedTuple):
    """Placements, twists and accelerations of all bodies, from `forward_kinematics`; entry 0 is the world's.

    Attributes
    ----------
    placement : list of SE3
        Of each body's frame in the world (Pinocchio's ``data.oMi``).
    twist : ndarray, shape (..., nbodies, 6), or None
        Body twist (ω, v), in the body's frame, rad/s and m/s (``data.v``).
    acceleration : ndarray, shape (..., nbodies, 6), or None
        Spatial acceleration, in the body's frame, without gravity (``data.a`` of Pinocchio's
        ``forwardKinematics``, not of its ``rnea``). Its linear part is not the acceleration of the
        frame's origin, which is a + ω × v.
    """

    placement: list[SE3]
    twist: Array | None
    acceleration: Array | None

    def __repr__(self) -> str:
        batch = self.placement[0].translation.shape[:-1]
        given = [name for name in ("twist", "acceleration") if getattr(self, name) is not None]
        of = f" of a batch {batch}" if batch else ""
        return f"<Kinematics{of}: {', '.join([f'{len(self.placement)} placements', *given])}>"


@also_of_mimics
def forward_kinematics(
    model: Model, q: ArrayLike, v: ArrayLike | None = None, a: ArrayLike | None = None
) -> Kinematics:
    """Return the placements of all bodies; their twists if v is given, and spatial accelerations if a is given, too.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv), optional
        An acceleration needs the velocity as well.

    Returns
    -------
    Kinematics
        placement, twist (None without v), acceleration (None without a).

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`; or if `a` is given without `v`.

    Notes
    -----
    The forward pass of 49.6, with the world at rest.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> stance = tw.forward_kinematics(model, model.standing())
    >>> stance.placement[1].translation.round(3), stance.twist  # the base
    (array([0.   , 0.   , 0.265]), None)
    """
    if v is None:
        if a is not None:
            raise ValueError("a: an acceleration needs the velocity as well, got v = None")
        (q,) = check_state(model, q)
        return Kinematics(placements(model.parent, joint_placements(model, q)), None, None)
    q, v, *rest = check_state(model, q, v=v) if a is None else check_state(model, q, v=v, a=a)
    tree = tree_terms(model, q)
    placement = placements(model.parent, tree.placement)
    V, A = motion(tree, columns(model, v), columns(model, rest[0] if rest else np.zeros_like(v)))
    twist, acceleration = (np.stack(x, axis=-3)[..., 0] for x in (V, A))
    return Kinematics(placement, twist, acceleration if rest else None)


def placements(parent: tuple[int, ...], relative: list[SE3]) -> list[SE3]:
    """Return the placement of each body in the world, from those in the parents' frames (49.3)."""
    T = [*relative]
    for i in range(1, len(parent)):
        T[i] = T[parent[i]] @ T[i]  # 49.3 T
    return T


def motion(tree: Tree, qd: list[Array], qdd: list[Array]) -> tuple[list[Array], list[Array]]:
    """Return twist and spatial acceleration of each body, in its frame: pass 1 of 49.6, with the world at rest."""
    parent, S, X = tree.parent, tree.S, tree.X
    V, A = tree.zeros(2)
    for i in tree.outward:
        p = parent[i]
        vJ = S[i] @ qd[i]
        V[i] = X[i] @ V[p] + vJ  # 49.2 V: body twist
        A[i] = X[i] @ A[p] + S[i] @ qdd[i] + cross_motion(V[i]) @ vJ  # 49.2 A: its rate
    return V, A


@also_of_mimics
def frame_placement(model: Model, q: ArrayLike, frame: str) -> SE3:
    """Return the placement of a named frame in the world.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    frame : str
        The name of a link or a joint; it may be a welded one.

    Returns
    -------
    SE3

    Raises
    ------
    NameNotFound
        If the model has no such frame; the message lists the nearest names.
    ShapeError, ValueError
        As `Model.state`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.frame_placement(model, model.standing(), "FR_foot").translation.round(3) + 0.0
    array([ 0.193, -0.142,  0.   ])
    """
    (q,) = check_state(model, q)
    at = model.frame(frame)
    return _frame_placement(model, joint_placements(model, q), at.body, cast(at.placement, q.dtype))


def _frame_placement(model: Model, relative: list[SE3], body: int, T: SE3) -> SE3:
    for i in [*model.support(body), 0]:
        T = relative[i] @ T  # 49.3 T_f
    return T


@also_of_mimics
def frame_jacobian(model: Model, q: ArrayLike, frame: str, reference: Reference = "local") -> Array:
    """Return the Jacobian of a named frame: its twist is J(q) v.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    frame : str
        The name of a link or a joint; it may be a welded one.
    reference : {"local", "world", "local_world_aligned"}
        The point of reference of the twist J v, and its axes. "local": the frame's origin and the frame's axes (body
        twist). "world": the world's origin and the world's axes (spatial twist). "local_world_aligned": the frame's
        origin and the world's axes.

    Returns
    -------
    ndarray, shape (..., 6, nv)
        Rows (ω, v): the linear rows are the last three (in Pinocchio the first three).

    Raises
    ------
    NameNotFound
        If the model has no such frame, or there is no such reference.
    ShapeError, ValueError
        As `Model.state`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm")
    >>> tw.frame_jacobian(arm, arm.neutral(), "tool", "world").shape
    (6, 3)
    """
    (q,) = check_state(model, q)
    check_known("reference", reference, get_args(Reference))
    at = model.frame(frame)
    tree, T = tree_terms(model, q), cast(at.placement, q.dtype)
    J = np.zeros((*q.shape[:-1], 6, model.nv), q.dtype)
    X = T.inverse().motion_transform()
    for i in model.support(at.body):  # from the frame to the base
        J[..., model.v_slice[i]] = X @ tree.S[i]  # 49.2 J
        X = X @ tree.X[i]
    return _to_reference(reference, _frame_placement(model, tree.placement, at.body, T)) @ J


@also_of_mimics
def frame_bias_acceleration(
    model: Model, q: ArrayLike, v: ArrayLike, frame: str, reference: Reference = "local"
) -> Array:
    """Return J̇ v: the frame's acceleration at q̈ = 0.

    The rate of J v is J q̈ + J̇ v, with J as `frame_jacobian` returns it. In "local" and "world" that
    is the spatial acceleration; in "local_world_aligned" its linear part is the acceleration of the
    frame's origin (the classical one), since J v there is that point's velocity.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
    frame : str
    reference : {"local", "world", "local_world_aligned"}

    Returns
    -------
    ndarray, shape (..., 6)
        rad/s² and m/s², without gravity.

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As `frame_jacobian`.

    Examples
    --------
    The bob of a pendulum of 1 m at 2 rad/s is pulled to the pivot with ω² r:

    >>> import twistwrench as tw
    >>> tw.frame_bias_acceleration(tw.load("pendulum"), [0.0], [2.0], "bob", "local_world_aligned")[3:].round(12)
    array([0., 0., 4.])
    """
    q, v = check_state(model, q, v=v)
    check_known("reference", reference, get_args(Reference))
    at = model.frame(frame)
    tree, T = tree_terms(model, q), cast(at.placement, q.dtype)
    V, A = (x[at.body][..., 0] for x in motion(tree, columns(model, v), columns(model, np.zeros_like(v))))
    X = T.inverse().motion_transform()
    V, A = np.matvec(X, V), np.matvec(X, A)
    if reference == "local_world_aligned":
        classical = np.cross(V[..., :3], V[..., 3:])  # 49.9 classical: + ω × v, of the origin
        A = A + np.concatenate([np.zeros_like(classical), classical], axis=-1)
    to_reference = _to_reference(reference, _frame_placement(model, tree.placement, at.body, T))
    bias: Array = np.matvec(to_reference, A)  # 49.9 dJ
    return bias


def _to_reference(reference: str, T: SE3) -> Array:
    """Return the X that takes a twist from a frame placed at T to the reference, shape (..., 6, 6)."""
    zero = np.zeros(3, T.translation.dtype)
    if reference == "local":
        return np.eye(6, dtype=zero.dtype)
    if reference == "world":
        return T.motion_transform()  # 49.2 world
    return SE3._trusted(T.rotation, zero).motion_transform()  # 49.9 aligned

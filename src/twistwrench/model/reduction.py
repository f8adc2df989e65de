"""Joints that stand still: lock them, merge the bodies, and carry states both ways (49.5).

Bodies between which nothing moves are one body, whose inertia is the sum of theirs in one frame. So a robot some of
whose joints are held is a smaller robot, with the same equations in fewer unknowns.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_names
from ..errors import NameNotFound
from ..spatial import SE3, SpatialInertia
from .arguments import one_configuration
from .checks import PER_DOF
from .model import Model
from .state import in_double
from .tree import joint_placements

__all__ = ["Reduction", "idle_joints", "lock_joints", "matching_joints"]


@dataclass(frozen=True, eq=False)
class Reduction:
    """A model, the reduced model with some of its joints held, and the maps between their states.

    Attributes
    ----------
    full : Model
    model : Model
        Without the held joints. The bodies that they carried are welded to their parents; all frames are kept.
    held : tuple of str
        The joints that are held, in the order of the full model.
    at : ndarray, shape (nq of full,)
        The configuration in which they are held; only their entries count.
    kept_q, kept_v : ndarray of int, shape (nq,) and (nv,)
        Where the entries of the small q and v stand in the full ones: M_full[kept_v][:, kept_v] is M.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm")
    >>> small = tw.lock_joints(arm, ["wrist"], arm.neutral())
    >>> small.model.nv, small.held
    (2, ('wrist',))
    >>> q, v = small.expand([0.1, 0.2], [1.0, 2.0])
    >>> q, v
    (array([0.1, 0.2, 0. ]), array([1., 2., 0.]))
    """

    full: Model
    model: Model
    held: tuple[str, ...]
    at: Array
    kept_q: Array
    kept_v: Array

    def reduce(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return the entries of a full state that are left, shapes (..., nq) and (..., nv).

        The entries of the held joints are dropped, whether they are zero or not.

        Parameters
        ----------
        q : array_like, shape (..., nq of full)
        v : array_like, shape (..., nv of full)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        q, v = self.full.state(q, v=v)
        return np.take(q, self.kept_q, axis=-1), np.take(v, self.kept_v, axis=-1)  # each state in one piece

    def expand(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return the full state in which the held joints are at rest where they are held.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v : array_like, shape (..., nv); velocities, or accelerations or joint forces of the joints that are left

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        q, v = self.model.state(q, v=v)
        q_full = np.broadcast_to(self.at.astype(q.dtype), (*q.shape[:-1], self.full.nq)).copy()
        v_full = np.zeros((*v.shape[:-1], self.full.nv), v.dtype)
        q_full[..., self.kept_q], v_full[..., self.kept_v] = q, v
        return q_full, v_full

    def __repr__(self) -> str:
        joints = "1 joint" if len(self.held) == 1 else f"{len(self.held)} joints"
        return f"<Reduction of {self.full.name!r}: {joints} held, nv = {self.model.nv}>"


def lock_joints(model: Model, joints: Iterable[str], q: ArrayLike) -> Reduction:
    """Lock some joints of a model at their values in q, and merge the bodies that no longer move against each other.

    Parameters
    ----------
    model : Model
    joints : iterable of str
        Names of joints, or patterns: ``"arm_*"`` is every joint whose name begins so. The exact name of a joint is
        not taken as a pattern.
    q : array_like, shape (nq,)
        Where they are held; the entries of the other joints have no influence.

    Returns
    -------
    Reduction
        Its model keeps the other joints in their order, with their limits and armature, and all frames, feet and
        named postures (of these the entries that are left). Bodies locked to the world never move and are not
        part of a model: their mass is dropped, as that of the base of a fixed arm always is.

    Raises
    ------
    NameNotFound
        If a name or a pattern fits no joint; the message lists the joints.
    ShapeError, ValueError
        As `Model.state`; if q is a batch; or if `joints` is a single string.

    Notes
    -----
    Section 49.5: in one frame inertias add. Pinocchio's ``buildReducedModel`` does the same.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("humanoid")
    >>> model
    Model 'humanoid': floating base, 22 moving bodies, nq = 28, nv = 27, 20 kg
    >>> tw.lock_joints(model, ["*_shoulder_*", "*_elbow"], model.standing()).model
    Model 'humanoid': floating base, 14 moving bodies, nq = 20, nv = 19, 20 kg
    """
    at = in_double(model, one_configuration(model, q))
    held = matching_joints(model, joints)
    kept = [i for i in range(1, model.nbodies) if model.joint_names[i] not in held]
    carrier, in_carrier = _carriers(model, at, kept)
    kept_q = np.concatenate([np.zeros(0, np.intp), *(np.arange(model.nq)[model.q_slice[i]] for i in kept)])
    kept_v = np.concatenate([np.zeros(0, np.intp), *(np.arange(model.nv)[model.v_slice[i]] for i in kept)])
    up = [model.parent[i] for i in kept]
    small = replace(
        model,
        base=model.base if kept[:1] == [1] else "fixed",
        joint_names=(model.joint_names[0], *(model.joint_names[i] for i in kept)),
        joints=(None, *(model.joints[i] for i in kept)),
        parent=(-1, *(carrier[p] for p in up)),
        placement=(model.placement[0], *(in_carrier[p] @ model.placement[i] for p, i in zip(up, kept))),
        inertia=_merged(model, carrier, in_carrier, 1 + len(kept)),
        frames={
            name: replace(f, body=carrier[f.body], placement=in_carrier[f.body] @ f.placement)
            for name, f in model.frames.items()
        },
        lower=model.lower[kept_q],
        upper=model.upper[kept_q],
        postures={name: posture[kept_q] for name, posture in model.postures.items()},
        **{name: getattr(model, name)[kept_v] for name in PER_DOF},
    )
    return Reduction(model, small, held, at, kept_q, kept_v)


def _carriers(model: Model, q: Array, kept: list[int]) -> tuple[list[int], list[SE3]]:
    """Return for each body the body of the small model that it is part of, and its placement in that one."""
    relative = joint_placements(model, q)
    carrier = [0]
    in_carrier = [SE3.identity()]
    for i in range(1, model.nbodies):
        p = model.parent[i]
        moves = i in kept
        carrier.append(1 + kept.index(i) if moves else carrier[p])
        in_carrier.append(SE3.identity() if moves else in_carrier[p] @ relative[i])
    return carrier, in_carrier


def _merged(model: Model, carrier: list[int], in_carrier: list[SE3], n: int) -> tuple[SpatialInertia, ...]:
    """Add up the inertias that make each body of the small model, in its own frame; the world's stays zero."""
    merged = [SpatialInertia.zero() for _ in range(n)]
    for inertia, body, T in zip(model.inertia, carrier, in_carrier):
        if body > 0:
            merged[body] = merged[body] + inertia.transform(T)
    return tuple(merged)


def matching_joints(model: Model, patterns: Iterable[str], argument: str = "joints") -> tuple[str, ...]:
    """Return the joints that match any of the patterns, in the model's order; raise where a pattern matches none."""
    names = model.joint_names[1:]
    held = set[str]()
    for pattern in as_names(patterns, argument, "names or patterns"):
        if not isinstance(pattern, str):
            raise NameNotFound(f"{argument}: expected names or patterns, got {type(pattern).__name__} {pattern!r}")
        exact = pattern in names  # a name may hold characters of patterns: "arm[1]"
        fits = {pattern} if exact else {name for name in names if fnmatchcase(name, pattern)}
        if not fits:
            raise NameNotFound(f"{pattern!r} fits no joint of {model.name!r}; its joints are {', '.join(names)}")
        held |= fits
    return tuple(name for name in names if name in held)


def idle_joints(model: Model, needed: Collection[str] = ()) -> tuple[str, ...]:
    """Return the joints that carry nothing: no mass, no rotor of their own, and none of the needed frames.

    Such a joint has a row and a column of zeros in M. Its outboard bodies have no inertia and transmit no force.

    Parameters
    ----------
    model : Model
    needed : collection of str
        Frames that must stay movable, for example those of contacts.

    Returns
    -------
    tuple of str

    Raises
    ------
    NameNotFound
        If the model has no such frame.

    Examples
    --------
    >>> import twistwrench as tw
    >>> robot = tw.Builder("a camera on a mast")
    >>> mast = tw.SpatialInertia(1.0, [0, 0, 1], np.diag([0.1, 0.1, 0.01]))
    >>> robot.link("mast", parent="base_link", joint=tw.Revolute("z"), inertia=mast)
    >>> robot.link("camera", parent="mast", joint=tw.Revolute("y"))
    >>> idle_joints(robot.build())
    ('camera',)
    >>> idle_joints(robot.build(), needed=["camera"])
    ()
    """
    loaded = {model.frame(name).body for name in needed}
    loaded |= {i for i in range(1, model.nbodies) if model.inertia[i].mass or model.armature[model.v_slice[i]].any()}
    busy = {i for body in loaded for i in model.support(body)}
    return tuple(name for i, name in enumerate(model.joint_names) if i > 0 and i not in busy)

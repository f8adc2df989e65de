"""The model: a tree of bodies, and the manifold on which its q lives.

Body 0 is the world. Body i is moved by joint i, whose frame is body i's frame; λ(i) = ``parent[i]``
is smaller than i, so that going up through the indices walks the tree from the root to the tips.
The indices are Pinocchio's joint ids.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from .checks import Array, as_arrays, resolution
from .errors import ShapeError, unknown_name
from .inertia import SpatialInertia
from .joint import Joint
from .plucker import SE3

__all__ = ["Constants", "Frame", "Model", "cast"]


@dataclass(frozen=True)
class Frame:
    """A named frame fixed to a body.

    Parameters
    ----------
    body : int
        The body that carries it; 0 is the world.
    placement : SE3
        Of the frame in the body's frame.
    """

    body: int
    placement: SE3


@dataclass(frozen=True, eq=False, repr=False)
class Model:
    """A tree of rigid bodies. Frozen; made by `twistwrench.load` or `twistwrench.Builder`.

    Attributes
    ----------
    name : str
    base : {"fixed", "floating"}
        Whether joint 1 is the free-flyer of a floating base.
    joint_names : tuple of str
        Entry 0 is ``"universe"``, the world.
    joints : tuple of Joint
        Entry 0 is None: nothing moves the world.
    parent : tuple of int
        λ(i); entry 0 is -1.
    placement : tuple of SE3
        Of joint i's frame in the frame of body λ(i), in the neutral configuration.
    inertia : tuple of SpatialInertia
        Of body i, in its own frame, with everything welded to it. Entry 0 is zero: what is welded
        to the world never moves and is no part of the model (Pinocchio leaves it out as well).
    frames : mapping of str to Frame
        Every link and every joint, welded ones too.
    gravity : ndarray, shape (3,)
        Acceleration of free fall in the world, m/s².
    armature : ndarray, shape (nv,)
        Inertia of the rotors, as seen at the joint, kg m² or kg.
    lower, upper : ndarray, shape (nq,)
        Limits of q; infinite where there is none.
    velocity_limit, effort_limit : ndarray, shape (nv,)
    postures : mapping of str to ndarray, shape (nq,)
        Named configurations, for example ``"standing"``.
    feet : tuple of str
        The frames on which a legged robot stands.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> model
    Model 'go2': floating base, 13 moving bodies, nq = 19, nv = 18, 16.085 kg
    """

    name: str
    base: str
    joint_names: tuple[str, ...]
    joints: tuple[Joint | None, ...]
    parent: tuple[int, ...]
    placement: tuple[SE3, ...]
    inertia: tuple[SpatialInertia, ...]
    frames: Mapping[str, Frame]
    gravity: Array
    armature: Array
    lower: Array
    upper: Array
    velocity_limit: Array
    effort_limit: Array
    postures: Mapping[str, Array] = field(default_factory=dict)
    feet: tuple[str, ...] = ()
    _constants: dict[Any, Constants] = field(default_factory=dict, init=False)

    # ---------------------------------------------------------------- sizes and names

    @property
    def nbodies(self) -> int:
        """Number of bodies, the world included."""
        return len(self.parent)

    @cached_property
    def nq(self) -> int:
        """Number of entries of q."""
        return sum(joint.nq for joint in self.joints if joint)

    @cached_property
    def nv(self) -> int:
        """Number of degrees of freedom: entries of v, a and tau."""
        return sum(joint.nv for joint in self.joints if joint)

    @cached_property
    def q_slice(self) -> tuple[slice, ...]:
        """Where joint i's entries stand in q; empty for the world."""
        return _slices([joint.nq if joint else 0 for joint in self.joints])

    @cached_property
    def v_slice(self) -> tuple[slice, ...]:
        """Where joint i's entries stand in v; empty for the world."""
        return _slices([joint.nv if joint else 0 for joint in self.joints])

    @property
    def frame_names(self) -> tuple[str, ...]:
        """The names of all frames."""
        return tuple(self.frames)

    @cached_property
    def mass(self) -> float:
        """Mass of everything that moves, kg."""
        return float(sum(inertia.mass for inertia in self.inertia))

    def frame(self, name: str) -> Frame:
        """Return the frame of this name; an unknown name lists the nearest ones."""
        if name not in self.frames:
            raise unknown_name(f"frame of {self.name!r}", name, self.frames)
        return self.frames[name]

    def joint_id(self, name: str) -> int:
        """Return the index of the joint of this name, which is also its body's."""
        if name not in self.joint_names:
            raise unknown_name(f"joint of {self.name!r}", name, self.joint_names)
        return self.joint_names.index(name)

    def support(self, body: int) -> list[int]:
        """Return the bodies from `body` down to the one that the world carries."""
        path = []
        while body > 0:
            path.append(body)
            body = self.parent[body]
        return path

    def __repr__(self) -> str:
        return (
            f"Model {self.name!r}: {self.base} base, {self.nbodies - 1} moving bodies, "
            f"nq = {self.nq}, nv = {self.nv}, {self.mass:.6g} kg"
        )

    # ---------------------------------------------------------------- the configuration manifold

    def neutral(self) -> Array:
        """Return the configuration in which no joint moves anything, shape (nq,). Ignores the limits."""
        return np.concatenate([np.zeros(0), *(joint.neutral() for joint in self.joints if joint)])

    def standing(self) -> Array:
        """Return a posture within the limits with the feet on z = 0, shape (nq,).

        Raises
        ------
        KeyError
            If the model has none: only the legged robots of the catalogue do.
        """
        if "standing" not in self.postures:
            raise unknown_name(f"posture of {self.name!r}", "standing", self.postures or ["(none)"])
        return self.postures["standing"].copy()

    def random_configuration(self, *, rng: np.random.Generator | int | None = None) -> Array:
        """Draw a configuration, shape (nq,).

        Uniform between the limits; uniform over the turns of a quaternion or a (cos, sin). Where a
        limit is infinite, a revolute angle lies in ±π and a length in ±1 m (Pinocchio returns
        infinities there).

        Parameters
        ----------
        rng : numpy Generator or int, optional
            Where the randomness comes from.
        """
        rng = np.random.default_rng(rng)
        parts = [
            joint.random(rng, self.lower[s], self.upper[s]) for joint, s in zip(self.joints, self.q_slice) if joint
        ]
        return np.concatenate([np.zeros(0), *parts])

    def integrate(self, q: ArrayLike, v_dt: ArrayLike) -> Array:
        """Go from q along v_dt: q ⊕ v_dt.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v_dt : array_like, shape (..., nv)
            Velocity times duration.

        Returns
        -------
        ndarray, shape (..., nq)
        """
        q, v_dt = self.state(q, v_dt=v_dt)
        return self._by_joint(lambda joint, qs, vs: joint.integrate(q[..., qs], v_dt[..., vs]), q)

    def difference(self, q0: ArrayLike, q1: ArrayLike) -> Array:
        """Return the v_dt that leads from q0 to q1: q1 ⊖ q0, shape (..., nv).

        Parameters
        ----------
        q0, q1 : array_like, shape (..., nq)
        """
        q0, q1 = self.state(q0, q1=q1)
        return self._by_joint(lambda joint, qs, vs: joint.difference(q0[..., qs], q1[..., qs]), q0)

    def normalize(self, q: ArrayLike) -> Array:
        """Scale the quaternions and the (cos, sin) in q to norm 1.

        Parameters
        ----------
        q : array_like, shape (..., nq)

        Returns
        -------
        ndarray, shape (..., nq)

        Raises
        ------
        ValueError
            If one of them is zero, which has no direction; the message names the joint.
        """
        (q,) = self._arrays(q=q)
        pieces = [q[..., :0]]
        for i, s in enumerate(self.q_slice):
            joint = self.joints[i]
            if joint is None:
                continue
            try:
                pieces.append(joint.normalize(q[..., s]))
            except ValueError as error:
                raise ValueError(f"joint {self.joint_names[i]!r} (q[{s.start}:{s.stop}]): {error}") from None
        return np.concatenate(pieces, axis=-1)

    def _by_joint(self, function: Callable[[Joint, slice, slice], Array], like: Array) -> Array:
        """Apply `function` to every joint with its slices and join the results."""
        pieces = [function(joint, qs, vs) for joint, qs, vs in zip(self.joints, self.q_slice, self.v_slice) if joint]
        return np.concatenate([like[..., :0], *pieces], axis=-1)

    # ---------------------------------------------------------------- the check at the door

    def state(self, q: ArrayLike, **others: ArrayLike) -> tuple[Array, ...]:
        """Check a state and bring it to one dtype and one batch shape.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        **others : array_like
            By the name of the argument: ``f_ext`` (..., nbodies, 6), names that begin with ``q``
            (..., nq), all others (..., nv).

        Returns
        -------
        tuple of ndarray
            q and the others, in their order, broadcast against each other. Read-only views.

        Raises
        ------
        ShapeError
            A wrong last axis (with a hint where nq and nv were confused), or batch axes that do
            not broadcast.
        ValueError
            An infinity or a NaN; a quaternion or (cos, sin) that is off norm 1 by more than the
            root of the number type's resolution (1.5e-8 in float64).
        """
        arrays = self._arrays(q=q, **others)
        tails = [2 if name == "f_ext" else 1 for name in ("q", *others)]
        batches = [x.shape[: x.ndim - tail] for x, tail in zip(arrays, tails)]
        try:
            batch = np.broadcast_shapes(*batches)
        except ValueError:
            named = ", ".join(f"{name} {shape}" for name, shape in zip(("q", *others), batches))
            raise ShapeError(f"batch axes do not broadcast: {named}") from None
        for name, x in zip(("q", *others), arrays):
            if name.startswith("q"):
                self._check_unit(x, name)
        return tuple(np.broadcast_to(x, batch + x.shape[x.ndim - tail :]) for x, tail in zip(arrays, tails))

    def _arrays(self, **named: ArrayLike) -> tuple[Array, ...]:
        """Convert to arrays of one dtype with the right last axes, or say what is wrong."""
        for name, value in named.items():
            if name != "f_ext":
                self._check_not_swapped(name, value)
        return as_arrays(**{name: (value, self._tail(name)) for name, value in named.items()})

    def _check_not_swapped(self, name: str, value: ArrayLike) -> None:
        """Say so where a v came for a q, or a q for a v."""
        kind, other = ("q", "v") if name.startswith("q") else ("v", "q")
        size, came = (self.nq, self.nv) if kind == "q" else (self.nv, self.nq)
        try:
            shape = np.shape(value)
        except ValueError:  # ragged: as_arrays will say so
            return
        if size != came and shape[-1:] == (came,):
            raise ShapeError(
                f"{name}: expected shape (..., {size}), got {shape}; this looks like n{other}: "
                f"{kind} has n{kind} = {size}, {other} has n{other} = {came}"
            )

    def _tail(self, name: str) -> tuple[int, ...]:
        if name == "f_ext":
            return (self.nbodies, 6)
        return (self.nq,) if name.startswith("q") else (self.nv,)

    def _check_unit(self, q: Array, name: str) -> None:
        for i, s in enumerate(self.q_slice):
            joint = self.joints[i]
            if joint is None or joint.unit is None:
                continue
            part = slice(s.start + joint.unit.start, s.start + joint.unit.stop)
            norm2 = (q[..., part].real ** 2).sum(axis=-1)
            bad = np.abs(norm2 - 1) > 2 * np.sqrt(resolution(q.dtype))
            if bad.any():
                what = "(cos, sin)" if joint.unit.stop - joint.unit.start == 2 else "quaternion"
                raise ValueError(
                    f"{name}: joint {self.joint_names[i]!r}: the {what} {name}[{part.start}:{part.stop}] has norm "
                    f"{float(np.sqrt(norm2[bad].flat[0])):.6g}, expected 1; model.normalize(q) repairs it"
                )

    # ---------------------------------------------------------------- constants in a number type

    def constants(self, dtype: DTypeLike) -> Constants:
        """Return the model's constants in a number type; made once per type."""
        key = np.dtype(dtype)
        if key not in self._constants:
            self._constants[key] = Constants.of(self, key)
        return self._constants[key]


@dataclass(frozen=True, eq=False)
class Constants:
    """What the recursions read of a model, in one number type. Entry 0 of each is the world's.

    Attributes
    ----------
    S : list of ndarray, shape (6, nv of joint i)
        The joint's motion subspace, in the body's frame.
    I : list of ndarray, shape (6, 6)
        The body's spatial inertia, in its frame.
    placement : list of SE3
        As `Model.placement`.
    gravity : ndarray, shape (6,)
        The spatial acceleration (0, g) of free fall, in the world.
    armature : ndarray, shape (nv,)
    """

    S: list[Array]
    I: list[Array]
    placement: list[SE3]
    gravity: Array
    armature: Array

    @classmethod
    def of(cls, model: Model, dtype: np.dtype[Any]) -> Constants:
        """Convert the constants of `model`."""
        inertia = [
            SpatialInertia(i.mass.astype(dtype), i.com.astype(dtype), i.inertia_at_com.astype(dtype))
            for i in model.inertia
        ]
        return cls(
            S=[joint.subspace(dtype) if joint else np.zeros((6, 0), dtype) for joint in model.joints],
            I=[i.matrix() for i in inertia],
            placement=[cast(T, dtype) for T in model.placement],
            gravity=np.concatenate([np.zeros(3), model.gravity]).astype(dtype),
            armature=model.armature.astype(dtype),
        )


def cast(T: SE3, dtype: DTypeLike) -> SE3:
    """Convert a placement to a number type, its rotation orthonormal to that type's precision.

    The model holds it in float64. For a finer type, two steps of Newton's iteration for the nearest
    rotation, R ← R (3 − RᵀR)/2, remove what float64 could not hold.
    """
    R = T.rotation.astype(dtype)
    if resolution(R.dtype) < resolution(np.float64):
        for _ in range(2):
            R = R @ (3 * np.eye(3, dtype=R.dtype) - R.mT @ R) / 2
    return SE3(R, T.translation.astype(dtype))


def _slices(sizes: list[int]) -> tuple[slice, ...]:
    ends = np.cumsum([0, *sizes]).tolist()
    return tuple(slice(a, b) for a, b in pairwise(ends))

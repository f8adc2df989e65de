"""The model: a tree of bodies, and the manifold on which its q lives.

Body 0 is the world. Body i is moved by joint i, whose frame is body i's frame; λ(i) = ``parent[i]``
is smaller than i, so that going up through the indices walks the tree from the root to the tips.
The indices are Pinocchio's joint ids.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property, partial
from itertools import pairwise
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from .checks import Array, as_constant, as_generator
from .constants import Constants, fixed
from .errors import NameNotFound, unknown_name
from .inertia import SpatialInertia
from .joint import Joint
from .plucker import SE3
from .state import check_arrays, check_state

__all__ = ["Frame", "Model"]


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

    def __post_init__(self) -> None:
        for name in ("gravity", "armature", "lower", "upper", "velocity_limit", "effort_limit"):
            object.__setattr__(self, name, fixed(as_constant(getattr(self, name), name)))
        postures = {name: fixed(as_constant(q, f"posture {name!r}")) for name, q in self.postures.items()}
        object.__setattr__(self, "postures", MappingProxyType(postures))
        object.__setattr__(self, "frames", MappingProxyType(dict(self.frames)))

    def __reduce__(self) -> tuple[partial[Model], tuple[()]]:
        given = {f.name: getattr(self, f.name) for f in fields(self) if f.init}
        return partial(Model, **given | {name: dict(given[name]) for name in ("frames", "postures")}), ()

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
        """Return the frame of this name; raises NameNotFound, with the nearest names, where there is none."""
        if not isinstance(name, str) or name not in self.frames:
            raise unknown_name("frame", name, self.frames, f" of model {self.name!r}")
        return self.frames[name]

    def joint_id(self, name: str) -> int:
        """Return the index of the joint of this name, which is also its body's; raises NameNotFound as `frame`."""
        if name not in self.joint_names:
            raise unknown_name("joint", name, self.joint_names, f" of model {self.name!r}")
        return self.joint_names.index(name)

    def support(self, body: int) -> list[int]:
        """Return the bodies from `body` down to the one that the world carries."""
        path = []
        while body > 0:
            path.append(body)
            body = self.parent[body]
        return path

    def __repr__(self) -> str:
        bodies = "1 moving body" if self.nbodies == 2 else f"{self.nbodies - 1} moving bodies"
        return f"Model {self.name!r}: {self.base} base, {bodies}, nq = {self.nq}, nv = {self.nv}, {self.mass:.6g} kg"

    # ---------------------------------------------------------------- the configuration manifold

    def neutral(self) -> Array:
        """Return the configuration in which no joint moves anything, shape (nq,). Ignores the limits."""
        return np.concatenate([np.zeros(0), *(joint.neutral() for joint in self.joints if joint)])

    def standing(self) -> Array:
        """Return a posture within the limits with the feet on z = 0, shape (nq,).

        Raises
        ------
        NameNotFound
            If the model has none: only the legged robots of the catalogue do.
        """
        if "standing" not in self.postures:
            raise NameNotFound(f"model {self.name!r} has no standing posture; there is neutral()")
        return self.postures["standing"].copy()

    def random_configuration(self, *, rng: np.random.Generator | int | None = None) -> Array:
        """Draw a configuration, shape (nq,).

        Uniform between the limits; uniform over the turns of a quaternion or a (cos, sin). A range without end, or
        one of more than 100 turns or 200 m, is cut to one turn or 2 m of it, as near to 0 as it goes: to ±π or ±1 m
        where 0 is well inside (Pinocchio returns infinities there).

        Parameters
        ----------
        rng : numpy Generator or int, optional
            Where the randomness comes from.
        """
        rng = as_generator(rng)
        joints = zip(self.joints, self.q_slice)
        parts = [joint.random(rng, self.lower[s], self.upper[s]) for joint, s in joints if joint]
        return np.concatenate([np.zeros(0), *parts])

    def integrate(self, q: ArrayLike, v_dt: ArrayLike) -> Array:
        """Go from q along v_dt: q ⊕ v_dt, shape (..., nq).

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v_dt : array_like, shape (..., nv)
            Velocity times duration.
        """
        q, v_dt = self.state(q, v_dt=v_dt)
        return self._by_joint(lambda joint, qs, vs: joint.integrate(q[..., qs], v_dt[..., vs]), q)

    def difference(self, q0: ArrayLike, q1: ArrayLike) -> Array:
        """Return the v_dt that leads from q0 to q1: q1 ⊖ q0, shape (..., nv).

        Parameters
        ----------
        q0, q1 : array_like, shape (..., nq)
        """
        q0, q1 = check_state(self, q0=q0, q1=q1)
        return self._by_joint(lambda joint, qs, vs: joint.difference(q0[..., qs], q1[..., qs]), q0)

    def normalize(self, q: ArrayLike) -> Array:
        """Scale the quaternions and the (cos, sin) in q to norm 1, shape (..., nq).

        Parameters
        ----------
        q : array_like, shape (..., nq)

        Raises
        ------
        ValueError
            If one of them is zero, which has no direction; the message names the joint.
        """
        (q,) = check_arrays(self, q=q)
        pieces = []
        for joint, name, s in zip(self.joints, self.joint_names, self.q_slice):
            try:
                pieces.append(joint.normalize(q[..., s]) if joint else q[..., s])
            except ValueError as error:
                raise ValueError(f"joint {name!r} (q[{s.start}:{s.stop}]): {error}") from None
        return np.concatenate(pieces, axis=-1)

    def _by_joint(self, function: Callable[[Joint, slice, slice], Array], like: Array) -> Array:
        pieces = [function(joint, qs, vs) for joint, qs, vs in zip(self.joints, self.q_slice, self.v_slice) if joint]
        return np.concatenate([like[..., :0], *pieces], axis=-1)

    # ---------------------------------------------------------------- what the algorithms ask for

    def state(self, q: ArrayLike, **others: ArrayLike | None) -> tuple[Array, ...]:
        """Check a state and bring it to one dtype and one batch shape.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        **others : array_like
            By the name of the argument: ``f_ext`` (..., nbodies, 6), zero where it is None; names that
            begin with ``q`` (..., nq), all others (..., nv).

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
            An infinity or a NaN; a wrench on the world; a quaternion or (cos, sin) that is off norm 1 by more than the
            root of the number type's resolution (1.5e-8 in float64).
        """
        return check_state(self, q=q, **others)

    def constants(self, dtype: DTypeLike) -> Constants:
        """Return the model's constants in a number type; made once per type."""
        key = np.dtype(dtype)
        if key not in self._constants:
            self._constants[key] = Constants.of(self, key)
        return self._constants[key]


def _slices(sizes: list[int]) -> tuple[slice, ...]:
    ends = np.cumsum([0, *sizes]).tolist()
    return tuple(slice(a, b) for a, b in pairwise(ends))

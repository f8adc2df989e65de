"""The model: a tree of bodies.

Body 0 is the world. Body i is moved by joint i, whose frame is body i's frame; λ(i) = ``parent[i]``
is smaller than i, so that ascending indices go through the tree from the root to the tips.
The indices are Pinocchio's joint ids.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property, partial
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import DTypeLike

from ..arrays import Array, as_constant, as_count
from ..errors import check_known
from ..spatial import SE3, SpatialInertia
from .constants import Constants, readonly
from .joint import Joint
from .manifold import Manifold
from .report import Report

__all__ = ["PER_DOF", "Frame", "Model"]

PER_DOF = ("armature", "velocity_limit", "effort_limit", "damping", "friction")
"""The attributes of a `Model` with one entry for each degree of freedom."""


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
class Model(Manifold):
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
        to the world never moves and is not part of the model (Pinocchio leaves it out as well).
    frames : mapping of str to Frame
        Every link and every joint, welded ones too.
    gravity : ndarray, shape (3,)
        Acceleration of free fall in the world, m/s².
    armature : ndarray, shape (nv,)
        Inertia of the rotors, as seen at the joint, kg m² or kg.
    lower, upper : ndarray, shape (nq,)
        Limits of q; infinite where a joint has no limit.
    velocity_limit, effort_limit : ndarray, shape (nv,)
    postures : mapping of str to ndarray, shape (nq,)
        Named configurations, for example ``"standing"``.
    feet : tuple of str
        The frames on which a legged robot stands.
    damping, friction : ndarray, shape (nv,)
        From a URDF's ``<dynamics>``: N m s/rad or N s/m, and N m or N; zero where the file has no
        value. `simulate` applies them with the method "time-stepping", as on a ground; no algorithm does.
    report : Report
        What the loader had to interpret, and how. Prints as a table.

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
    damping: Array = field(default_factory=lambda: np.zeros(0))
    friction: Array = field(default_factory=lambda: np.zeros(0))
    report: Report = field(default_factory=Report)
    _constants: dict[Any, Constants] = field(default_factory=dict, init=False)
    _programs: dict[Any, Any] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        for name in ("gravity", "armature", "lower", "upper", "velocity_limit", "effort_limit"):
            object.__setattr__(self, name, readonly(as_constant(getattr(self, name), name)))
        for name in ("damping", "friction"):
            given = as_constant(getattr(self, name), name)
            object.__setattr__(self, name, readonly(given if given.size else np.zeros(self.nv)))
        postures = {name: readonly(as_constant(q, f"posture {name!r}")) for name, q in self.postures.items()}
        object.__setattr__(self, "postures", MappingProxyType(postures))
        object.__setattr__(self, "frames", MappingProxyType(dict(self.frames)))

    def __reduce__(self) -> tuple[partial[Model], tuple[()]]:
        given = {f.name: getattr(self, f.name) for f in fields(self) if f.init}
        return partial(Model, **given | {name: dict(given[name]) for name in ("frames", "postures")}), ()

    @property
    def frame_names(self) -> tuple[str, ...]:
        """The names of all frames."""
        return tuple(self.frames)

    @cached_property
    def mass(self) -> float:
        """Mass of everything that moves, kg."""
        return float(sum(inertia.mass for inertia in self.inertia))

    def frame(self, name: str) -> Frame:
        """Return the frame of this name.

        Parameters
        ----------
        name : str

        Returns
        -------
        Frame

        Raises
        ------
        NameNotFound
            If there is none; the message lists the nearest names.

        Examples
        --------
        >>> import twistwrench as tw
        >>> foot = tw.load("go2").frame("FR_foot")
        >>> foot.body, foot.placement.translation  # on the calf, 0.213 m below the knee
        (7, array([ 0.   ,  0.   , -0.213]))
        """
        check_known("frame", name, self.frames, f" of model {self.name!r}")
        return self.frames[name]

    def joint_id(self, name: str) -> int:
        """Return the index of the joint of this name, which is also its body's.

        Parameters
        ----------
        name : str

        Returns
        -------
        int

        Raises
        ------
        NameNotFound
            If there is none; the message lists the nearest names.

        Examples
        --------
        >>> import twistwrench as tw
        >>> tw.load("go2").joint_id("FR_calf_joint")
        7
        """
        check_known("joint", name, self.joint_names, f" of model {self.name!r}")
        return self.joint_names.index(name)

    def support(self, body: int) -> list[int]:
        """Return the bodies from `body` down to the one that the world carries; an empty list for the world, 0.

        Parameters
        ----------
        body : int

        Returns
        -------
        list of int

        Raises
        ------
        ValueError
            If the model has no such body.

        Examples
        --------
        >>> import twistwrench as tw
        >>> tw.load("go2").support(7)
        [7, 6, 5, 1]
        """
        body, path = as_count(body, "body", 0), []
        if body >= self.nbodies:
            raise ValueError(f"body: expected a whole number from 0 to {self.nbodies - 1}, got {body}")
        while body > 0:
            path.append(body)
            body = self.parent[body]
        return path

    def __repr__(self) -> str:
        bodies = "1 moving body" if self.nbodies == 2 else f"{self.nbodies - 1} moving bodies"
        return f"Model {self.name!r}: {self.base} base, {bodies}, nq = {self.nq}, nv = {self.nv}, {self.mass:.6g} kg"

    def _repr_html_(self) -> str:
        from .outline import outline

        return outline(self)

    def constants(self, dtype: DTypeLike) -> Constants:
        """Return the model's constants in a number type: S, I, tree constants and gravity, made once for each type.

        Parameters
        ----------
        dtype : dtype_like

        Returns
        -------
        Constants
        """
        kind = np.dtype(dtype)
        key = kind, kind.metadata is None  # of objects, whether they are fractions or decimals
        if key not in self._constants:
            self._constants[key] = Constants.of(self, kind)
        return self._constants[key]

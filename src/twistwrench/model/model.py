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
from numpy.typing import ArrayLike, DTypeLike

from ..arrays import Array, as_count, as_exactly, as_names, as_sequence, check_choice, check_kind
from ..errors import ModelError, ShapeError, check_known
from ..spatial import SE3, SpatialInertia
from .checks import UNLIMITED, WORLD, as_entries, check_body, check_limits, check_name, check_placement
from .configuration import ConfigurationSpace
from .constants import Constants, readonly
from .joint import Joint
from .joints import FreeFlyer
from .report import LoadReport
from .state import in_double

__all__ = ["Frame", "Model"]


@dataclass(frozen=True)
class Frame:
    """A named frame fixed to a body. Two are equal if they are at one place.

    Parameters
    ----------
    body : int
        The body that carries it; 0 is the world.
    placement : SE3
        Of the frame in the body's frame.
    parent : str, optional
        The frame that it hangs on: a link on its joint, a joint on the link before it. None for the root.
    inertia : SpatialInertia, optional
        Of the link at this frame alone, in its axes; zero of a joint. None where it is not known.
    """

    body: int
    placement: SE3
    parent: str | None = field(default=None, compare=False)
    inertia: SpatialInertia | None = field(default=None, compare=False)


@dataclass(frozen=True, eq=False, repr=False)
class Model(ConfigurationSpace):
    """A tree of rigid bodies. Frozen; made by `twistwrench.load` or `twistwrench.Builder`.

    A copy with other attributes is ``dataclasses.replace(model, damping=3.0)``, checked as what comes from `Builder`.
    Where an attribute has an entry for each one of q or v, those of a floating base may be left out: it then has no
    limits, armature, damping or friction. One number stands for all that are left: 12 numbers for 12 motors, or one.

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
    report : LoadReport
        What the loader had to interpret, and how. Prints as a table.

    Raises
    ------
    ModelError
        If a limit, an armature, damping or friction cannot be, a name is taken, or joints do not form a tree.
    ShapeError, ValueError, NameNotFound
        If an attribute has a wrong size or is not of finite real numbers, a posture is not a configuration, or a foot
        not a frame.
    TypeError
        If an attribute is of another kind.

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
    damping: Array = field(default_factory=lambda: np.zeros(()))
    friction: Array = field(default_factory=lambda: np.zeros(()))
    report: LoadReport = field(default_factory=LoadReport)
    _constants: dict[Any, Constants] = field(default_factory=dict, init=False)
    _programs: dict[Any, Any] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        check_kind(self.name, "name", str, "a name")
        check_choice(self.base, "base", ("fixed", "floating"), ModelError)
        self._check_bodies()
        self._hold("gravity", readonly(as_exactly(self.gravity, "gravity", 3)))
        self._check_limits()
        check_kind(self.frames, "frames", Mapping, "frames by name")
        self._hold("frames", MappingProxyType(dict(self.frames)))
        for name, frame in self.frames.items():
            check_kind(frame, f"frame {name!r}", Frame, "a Frame")
            check_kind(name, "frames", str, "a name")
            if not _is_index(frame.body, self.nbodies):
                raise ModelError(f"frame {name!r}: expected a body from 0 to {self.nbodies - 1}, got {frame.body!r}")
            check_placement(frame.placement, f"frame {name!r}")
        self._hold("feet", as_names(self.feet, "feet", "frame names", ordered=True))
        for foot in self.feet:
            self.frame(foot)
        check_kind(self.postures, "postures", Mapping, "configurations by name")
        for name in self.postures:
            check_kind(name, "postures", str, "a name")
        postures = {name: readonly(_posture(self, name, q)) for name, q in self.postures.items()}
        self._hold("postures", MappingProxyType(postures))
        check_kind(self.report, "report", LoadReport, "a LoadReport")

    def _hold(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)

    def _check_bodies(self) -> None:
        """Raise unless each body has a name, a joint, a parent of a smaller number, a placement and an inertia."""
        for name in ("joint_names", "joints", "parent", "placement", "inertia"):
            entries = as_sequence(getattr(self, name), name, "one for each body", letters=False, ordered=True)
            self._hold(name, entries)
            if len(entries) != len(self.joint_names):
                raise ShapeError(f"{name}: expected {len(self.joint_names)} entries, one a body, got {len(entries)}")
        world = (self.joint_names[:1], self.joints[:1], self.parent[:1])
        if world != ((WORLD,), (None,), (-1,)):
            raise ModelError(f"joint_names, joints and parent: expected {WORLD!r}, None and -1 first, got {world}")
        bodies = zip(self.joint_names, self.joints, self.parent, self.placement, self.inertia)
        taken = {WORLD}
        for i, (name, joint, parent, placement, inertia) in enumerate(bodies):
            check_body(f"joint {name!r}", joint, name, placement, inertia)
            if i == 0:
                continue
            check_name(name, "joint")
            if name in taken:
                raise ModelError(f"joint {name!r}: the name is taken")
            taken.add(name)
            if joint is None:
                raise ModelError(f"joint {name!r}: expected a joint such as Revolute('z'), got None")
            if not _is_index(parent, i):
                raise ModelError(f"joint {name!r}: expected a parent from 0 to {i - 1}, got {parent!r}")
        self._hold("parent", tuple(int(p) for p in self.parent))
        if self.placement[0] != SE3.identity():
            raise ModelError(f"placement: expected the identity for {WORLD!r}, entry 0, got {self.placement[0]}")
        if self.inertia[0] != SpatialInertia.zero():
            raise ModelError(f"inertia: expected zero for {WORLD!r}, entry 0, got {self.inertia[0]}")
        if self.base == "floating" and not (self.nbodies > 1 and isinstance(self.joints[1], FreeFlyer)):
            raise ModelError("base: expected 'fixed', as joint 1 is not a FreeFlyer, got 'floating'")

    def _check_limits(self) -> None:
        """Raise unless there is a limit, an armature, a damping and a friction for each entry of q or v."""
        floating = self.base == "floating"
        sizes = {key: (self.nq, 7) if key in ("lower", "upper") else (self.nv, 6) for key in UNLIMITED}
        for key, (size, base) in sizes.items():
            self._hold(key, as_entries(getattr(self, key), key, size, base * floating, key))
        joints = list(zip(self.joint_names, self.q_slice, self.v_slice))
        check_limits({key: readonly(getattr(self, key)) for key in UNLIMITED}, joints[1:])

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
        body = as_count(body, "body", 0)
        path = []
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


def _is_index(value: object, size: int) -> bool:
    """Return whether a value is a whole number, of Python or NumPy, from 0 to size - 1."""
    return isinstance(value, int | np.integer) and not isinstance(value, bool) and int(value) in range(size)


def _posture(model: Model, name: str, q: ArrayLike) -> Array:
    """Return a named configuration, checked."""
    try:
        checked = in_double(model, *model.state(q))
    except ValueError as error:
        raise type(error)(f"posture {name!r}: {error}") from None
    if checked.ndim != 1:
        raise ShapeError(f"posture {name!r}: expected one configuration, shape ({model.nq},), got {checked.shape}")
    return checked

"""Make a model in a few lines of Python. The URDF loader goes through here as well.

Links are added one by one; each is carried by a parent through a joint, or welded to it. `Builder.build`
merges welded links into the body that carries them and numbers the bodies as Pinocchio does: depth
first, siblings in the order of their joints' names.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_constant, as_exactly, as_flag, check_choice, check_kind, convert
from ..errors import ModelError, ShapeError, check_known
from ..spatial import SE3, SpatialInertia
from ..spatial._physical import check_not_negative
from .checks import PER_DOF, UNLIMITED, WORLD, as_entries, check_body, check_limits, check_name
from .constants import cast
from .joint import Joint
from .joints import FreeFlyer
from .model import Frame, Model
from .report import Entry, LoadReport

__all__ = ["GRAVITY", "IMPOSSIBLE", "Builder", "Link", "NumberedTree", "placement_of"]

GRAVITY = (0.0, 0.0, -9.81)
"""Acceleration of free fall in the world, m/s², unless another is given."""

IMPOSSIBLE = "given, as a body that cannot exist (physical=True rejects it)"
"""How a loader reads such a body."""

Base = Literal["fixed", "floating"]


class Builder:
    """Builds a model: `link` adds one link after the other, and `build` returns the model.

    Parameters
    ----------
    name : str
        Name of the model.
    base : {"fixed", "floating"}
        Whether the root link is welded to the world or flies freely.
    root : str
        Name of the root link.
    root_inertia : SpatialInertia, optional
        Inertia of the root link, in its frame. It has no effect with a fixed base, since the root link never moves.
    root_joint : str
        Name of the joint of a floating base.
    gravity : array_like, shape (3,)
        In the axes of the world, m/s².

    Raises
    ------
    ModelError
        If `base` is not one of the two, or `root` is the name of the world.
    ShapeError, ValueError
        If `gravity` is not three real numbers.
    TypeError
        If `name` or `root` is not a string, or `root_inertia` is not a SpatialInertia.

    Examples
    --------
    >>> from twistwrench import Revolute
    >>> rod = SpatialInertia(1.0, [0, 0, -0.5], np.diag([1 / 12, 1 / 12, 0.001]))
    >>> double = Builder("double pendulum")
    >>> double.link("upper", parent="base_link", joint=Revolute("y"), inertia=rod)
    >>> double.link("lower", parent="upper", joint=Revolute("y"), inertia=rod, placement=SE3(np.eye(3), [0, 0, -1]))
    >>> double.build()
    Model 'double pendulum': fixed base, 2 moving bodies, nq = 2, nv = 2, 2 kg
    """

    def __init__(
        self,
        name: str,
        *,
        base: Base = "fixed",
        root: str = "base_link",
        root_inertia: SpatialInertia | None = None,
        root_joint: str = "root_joint",
        gravity: ArrayLike = GRAVITY,
    ) -> None:
        check_choice(base, "base", ("fixed", "floating"), ModelError)
        check_kind(name, "name", str, "a name")
        check_kind(root_joint, "root_joint", str, "a name")
        self._name = name
        self._base = base
        self._gravity = as_exactly(gravity, "gravity", 3)
        self._links: dict[str, Link] = {}
        self._joint_names: set[str] = set()
        flyer, joint_name = (FreeFlyer(), root_joint) if base == "floating" else (None, "")
        inertia = SpatialInertia.zero() if root_inertia is None else root_inertia
        self._add(Link.make(root, WORLD, flyer, joint_name, SE3.identity(), inertia, {}))

    def link(
        self,
        name: str,
        *,
        parent: str,
        joint: Joint | None = None,
        joint_name: str | None = None,
        placement: SE3 | None = None,
        inertia: SpatialInertia | None = None,
        lower: ArrayLike = -np.inf,
        upper: ArrayLike = np.inf,
        velocity_limit: ArrayLike = np.inf,
        effort_limit: ArrayLike = np.inf,
        armature: ArrayLike = 0.0,
        damping: ArrayLike = 0.0,
        friction: ArrayLike = 0.0,
    ) -> None:
        """Add a link.

        Parameters
        ----------
        name : str
        parent : str
            The link that carries this one; it must have been added before.
        joint : Joint, optional
            The joint that moves the link; without a joint the link is welded to its parent.
        joint_name : str, optional
            The link's own name unless given.
        placement : SE3, optional
            Of the joint's frame in the parent link's frame; the identity unless given.
        inertia : SpatialInertia, optional
            In the link's frame; zero unless given.
        lower, upper : array_like, shape () or (joint.nq,)
            Limits of the joint's entries of q.
        velocity_limit, effort_limit : array_like, shape () or (joint.nv,)
        armature : array_like, shape () or (joint.nv,)
            Inertia of the rotor as seen at the joint, kg m² or kg.
        damping, friction : array_like, shape () or (joint.nv,)
            Kept as `Model.damping` and `Model.friction`; only `simulate` by time-stepping applies them.

        Raises
        ------
        ModelError
            If the name is already used, or is the world's; if a lower limit is above the upper one; if a limit of speed
            or effort, an armature, damping or friction is below zero or given for a weld; if numbers are complex.
        ShapeError
            If placements or inertias come as a batch, or limits have a wrong shape.
        TypeError
            If `name` is not a string, or `joint`, `placement` or `inertia` is of another type.
        NameNotFound
            If the parent is not known.
        """
        check_known("parent link", parent, self._links)
        numbers = {
            "lower": lower,
            "upper": upper,
            "velocity_limit": velocity_limit,
            "effort_limit": effort_limit,
            "armature": armature,
            "damping": damping,
            "friction": friction,
        }
        placement = SE3.identity() if placement is None else placement
        inertia = SpatialInertia.zero() if inertia is None else inertia
        joint_name = name if joint_name is None else joint_name
        self._add(Link.make(name, parent, joint, joint_name, placement, inertia, numbers))

    def __repr__(self) -> str:
        counts = (len(self._links), "link"), (sum(link.joint is not None for link in self._links.values()), "joint")
        parts = ", ".join(f"{n} {what}{'s' * (n != 1)}" for n, what in counts)
        return f"<Builder {self._name!r}: {self._base} base, {parts}>"

    def _add(self, link: Link) -> None:
        if link.name in self._links:
            raise ModelError(f"link {link.name!r}: the name is taken")
        if link.joint_name in self._joint_names:
            raise ModelError(f"link {link.name!r}: the joint name {link.joint_name!r} is taken")
        self._links[link.name] = link
        self._joint_names.add(link.joint_name)

    def build(
        self,
        *,
        postures: Mapping[str, ArrayLike] | None = None,
        feet: Sequence[str] = (),
        physical: bool | None = True,
    ) -> Model:
        """Make the model.

        Parameters
        ----------
        postures : mapping of str to array_like, shape (nq,), optional
            Named configurations.
        feet : sequence of str
            The frames on which a legged robot stands.
        physical : bool, optional
            Reject a moving body, welded links merged, that cannot exist (`SpatialInertia.check_physical`). None rejects
            only a principal moment below zero; a body whose largest is more than the sum of the others is reported.
            A body without mass is accepted, and `Model.report` names it where it has an inertia.

        Returns
        -------
        Model

        Raises
        ------
        NameNotFound, ShapeError, ValueError
            If a foot is not a frame, or a posture is not a configuration.
        ModelError
            If a body cannot exist, numbers overflow where links are merged, or two frames want one name.
        """
        postures = {} if postures is None else postures
        physical = None if physical is None else as_flag(physical, "physical")
        with np.errstate(over="ignore", invalid="ignore"):
            tree = NumberedTree(self._links)
            tree.check_finite()
        report = LoadReport(tree.check_bodies(physical))
        moved = tree.moved
        return Model(
            name=self._name,
            base=self._base,
            joint_names=(WORLD, *(link.joint_name for link in moved)),
            joints=(None, *(link.joint for link in moved)),
            parent=tuple(tree.parent),
            placement=tuple(tree.placement),
            inertia=tuple(tree.inertia),
            frames=tree.frames,
            gravity=self._gravity,
            lower=_join([link.lower for link in moved]),
            upper=_join([link.upper for link in moved]),
            postures=postures,  # type: ignore[arg-type]  # a Model makes arrays of them
            feet=feet,  # type: ignore[arg-type]
            report=report,
            **{name: _join([getattr(link, name) for link in moved]) for name in PER_DOF},
        )


def _join(pieces: list[Array]) -> Array:
    return np.concatenate([np.zeros(0), *pieces])


@dataclass(frozen=True)
class Link:
    """A link, the joint or the weld that carries it, and the joint's limits: all in float64."""

    name: str
    parent: str
    joint: Joint | None
    joint_name: str
    placement: SE3
    inertia: SpatialInertia
    lower: Array
    upper: Array
    velocity_limit: Array
    effort_limit: Array
    armature: Array
    damping: Array
    friction: Array

    @classmethod
    def make(
        cls,
        name: str,
        parent: str,
        joint: Joint | None,
        joint_name: str,
        placement: SE3,
        inertia: SpatialInertia,
        numbers: Mapping[str, ArrayLike],
    ) -> Link:
        """Make a link from checked arguments. `numbers` are the entries of `UNLIMITED` that were given."""
        check_name(name, "link")
        check_name(joint_name, "joint")
        check_body(f"link {name!r}", joint, joint_name, placement, inertia)
        limits = {key: as_constant(x, f"link {name!r}: {key}") for key, x in numbers.items()}
        if joint is None and any((x != UNLIMITED[key]).any() for key, x in limits.items()):
            raise ModelError(f"link {name!r}: limits and armature belong to a joint, and this link is welded")
        try:
            own = SpatialInertia._trusted(
                *(convert(x, np.float64) for x in (inertia.mass, inertia.com, inertia.inertia_at_com))
            )
            at = cast(placement, np.float64)
        except ValueError as error:
            raise ModelError(f"link {name!r}: {error}") from None
        nq, nv = (joint.nq, joint.nv) if joint else (0, 0)
        vectors = {
            key: as_entries(x, key, nq if key in ("lower", "upper") else nv, 0, f"joint {joint_name!r}: {key}")
            for key, x in (UNLIMITED | dict(numbers)).items()
        }
        check_limits(vectors, [(joint_name, slice(0, nq), slice(0, nv))])
        return cls(name, parent, joint, joint_name, at, own, **vectors)


def placement_of(T: ArrayLike, name: str) -> SE3:
    """Return the placement of a 4 × 4 matrix; an error names the argument."""
    try:
        return SE3.from_matrix(as_exactly(T, name, 4, 4))
    except ShapeError as error:
        raise ShapeError(f"{name}: {str(error).removeprefix('T: ').removeprefix(f'{name}: ')}") from None


class NumberedTree:
    """The links in their final order, depth first: bodies numbered, welded links merged.

    Attributes
    ----------
    groups : list of list of Link
        For each body the links that it is made of: the one that its joint moves, then what is welded
        to it. Entry 0, the world's, is empty.
    parent, placement, inertia, frames
        As in `Model`.
    """

    def __init__(self, links: Mapping[str, Link]) -> None:
        self.groups: list[list[Link]] = [[]]
        self.parent = [-1]
        self.placement = [SE3.identity()]
        self.inertia = [SpatialInertia.zero()]
        found: dict[tuple[str, str], Frame] = {}
        children: dict[str, list[Link]] = {name: [] for name in (WORLD, *links)}
        for link in sorted(links.values(), key=lambda link: link.joint_name, reverse=True):
            children[link.parent].append(link)
        waiting = [(link, 0, SE3.identity()) for link in children[WORLD]]
        while waiting:  # the last one in is the first one out, hence the reversed order above
            link, carrier, in_carrier = waiting.pop()
            carrier, at = self._place(link, carrier, in_carrier @ link.placement)
            if link.joint is not None or link.parent != WORLD:  # a fixed root link hangs on no joint
                found["joint", link.joint_name] = Frame(carrier, at)
            found["link", link.name] = Frame(carrier, at)
            waiting += [(child, carrier, at) for child in children[link.name]]
        self.frames = _named(found, links)

    @property
    def moved(self) -> list[Link]:
        """The links that joints move, one for each body."""
        return [group[0] for group in self.groups[1:]]

    def _place(self, link: Link, carrier: int, at: SE3) -> tuple[int, SE3]:
        """Give a moved link its number, or merge a welded one; return the body and where the link is in it."""
        if link.joint is not None:
            self.groups.append([link])
            self.parent.append(carrier)
            self.placement.append(at)
            self.inertia.append(link.inertia)
            carrier = len(self.parent) - 1
            at = SE3.identity()
        elif carrier > 0:  # what is welded to the world never moves
            self.groups[carrier].append(link)
            self.inertia[carrier] = self.inertia[carrier] + link.inertia.transform(at)
        return carrier, at

    def check_finite(self) -> None:
        """Raise ModelError where finite numbers overflow when links are merged."""
        for link, inertia, placement in zip(self.moved, self.inertia[1:], self.placement[1:], strict=True):
            if not (np.isfinite(inertia.matrix()).all() and np.isfinite(placement.matrix()).all()):
                raise ModelError(f"joint {link.joint_name!r}: the inertia that it carries, or the way to it, overflows")
        for name, frame in self.frames.items():
            if not np.isfinite(frame.placement.matrix()).all():
                raise ModelError(f"frame {name!r}: the way to it overflows")

    def check_bodies(self, physical: bool | None) -> list[Entry]:
        """Check each body, welded links merged: that sum is all that enters the dynamics.

        A single welded link may be a point, or carry an inertia without mass, as in many a real file. Returns
        remarks on whole bodies, for the report.
        """
        bodies = list(zip(self.groups[1:], self.inertia[1:], strict=True))
        indefinite = [(group, fault) for group, inertia in bodies if (fault := _fault(inertia, group, definite=True))]
        faults = [(group, fault) for group, inertia in bodies if (fault := _fault(inertia, group))]
        refused = {True: faults, False: [], None: indefinite}[physical]
        if refused:
            count = "1 moving body" if len(refused) == 1 else f"{len(refused)} moving bodies"
            listed = "".join(f"\n  {fault}" for _, fault in refused)
            raise ModelError(f"{count} cannot exist (physical=False accepts the robot all the same):{listed}")
        warns = physical is None
        read_as = IMPOSSIBLE if warns else "a body that cannot exist (physical=False)"
        impossible = [Entry(_link(group), fault.partition(": ")[2], read_as, warns=warns) for group, fault in faults]
        degenerate = [entry for group, inertia in bodies if (entry := _degenerate(inertia, group))]
        return [*impossible, *degenerate, *self._floating_nothing()]

    def _floating_nothing(self) -> list[Entry]:
        """Report a floating base without mass that carries a single joint: the two turn against each other freely."""
        if len(self.groups) == 1 or self.groups[1][0].parent != WORLD or self.inertia[1].matrix().any():
            return []
        carried = [group[0].joint_name for group, parent in zip(self.groups[2:], self.parent[2:]) if parent == 1]
        if len(carried) > 1:
            return []
        found = "floats without mass" + "".join(f", and carries the joint {name!r} alone" for name in carried)
        return [Entry(_link(self.groups[1]), found, "given: M is singular (base='fixed' or a mass mends that)")]


def _fault(inertia: SpatialInertia, group: list[Link], *, definite: bool = False) -> str:
    """Return why a body cannot exist, under the name of its first link; empty if it can exist.

    A body without mass is judged as the limit of ever lighter ones with its inertia: no moment may be negative. With
    `definite` that is all that is asked of a body with mass, too: it keeps M positive definite.
    """
    try:
        if inertia.mass > 0 and not definite:
            inertia.check_physical(group[0].name)
        else:
            check_not_negative(group[0].name, inertia.mass, inertia.com, inertia.inertia_at_com)
    except ModelError as error:
        others = [repr(x.name) for x in group[1:] if x.inertia.mass > 0 or x.inertia.inertia_at_com.any()]
        return f"{error}" + (f" (with {', '.join(others)} welded to it)" if others else "")
    return ""


def _degenerate(inertia: SpatialInertia, group: list[Link]) -> Entry | None:
    """Report a body that is a limit: a point mass, or an inertia without mass."""
    if inertia.mass == 0 and inertia.inertia_at_com.any():
        return Entry(_link(group), "an inertia without a mass", "the inertia as given, with no weight")
    if inertia.mass > 0 and not inertia.inertia_at_com.any():
        return Entry(_link(group), f"{inertia.mass:.6g} kg without an inertia", "a point mass")
    return None


def _link(group: list[Link]) -> str:
    return f"link {group[0].name!r}"


def _named(found: Mapping[tuple[str, str], Frame], links: Mapping[str, Link]) -> dict[str, Frame]:
    """Name the frames of links and joints, each with the one that it hangs on and its link's own inertia.

    A link and a joint of one name are one frame where they share the place. Where they do not, neither
    gets the bare name, so that they cannot be confused: ``link:name`` and ``joint:name``.
    """
    frames: dict[str, Frame] = {}
    owner: dict[str, str] = {}
    named: dict[tuple[str, str], str] = {}
    for (kind, name), frame in found.items():
        other = found.get(("link" if kind == "joint" else "joint", name), frame)
        same = other.body == frame.body and bool((other.placement.matrix() == frame.placement.matrix()).all())
        full = name if same else f"{kind}:{name}"
        if owner.setdefault(full, name) != name:  # a link really named link:name
            raise ModelError(f"{kind} {name!r}: the frame name {full!r} is taken")
        frames[full] = frame
        named[kind, name] = full
    for link in links.values():
        own = named["link", link.name]
        joint = named.get(("joint", link.joint_name), own)
        carrier = named.get(("link", link.parent))
        frames[joint] = replace(frames[joint], parent=carrier, inertia=SpatialInertia.zero())
        frames[own] = replace(frames[own], parent=carrier if joint == own else joint, inertia=link.inertia)
    return frames

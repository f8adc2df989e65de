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

from .checks import Array, as_array
from .errors import ModelError, ShapeError, unknown_name
from .inertia import SpatialInertia
from .joint import Joint
from .joint_types import FreeFlyer
from .model import Frame, Model
from .plucker import SE3

__all__ = ["Builder"]

Base = Literal["fixed", "floating"]


@dataclass(frozen=True)
class _Link:
    """What `Builder.link` was told."""

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


class Builder:
    """Collects links; `build` makes the model.

    Parameters
    ----------
    name : str
        Of the model.
    base : {"fixed", "floating"}
        Whether the root link is welded to the world or flies freely.
    root : str
        Name of the root link.
    root_inertia : SpatialInertia, optional
        Of the root link, in its frame. Of no effect on a fixed base: it never moves.
    gravity : array_like, shape (3,)
        In the world, m/s².

    Raises
    ------
    ModelError
        If `base` is neither.

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
        gravity: ArrayLike = (0.0, 0.0, -9.81),
    ) -> None:
        if base not in ("fixed", "floating"):
            raise ModelError(f"base: expected 'fixed' or 'floating', got {base!r}")
        self._name = name
        self._base = base
        self._gravity = as_array(gravity, "gravity", 3).astype(np.float64)
        self._links: dict[str, _Link] = {}
        flyer = FreeFlyer() if base == "floating" else None
        inertia, joint_name = root_inertia or SpatialInertia.zero(), "root_joint" if flyer else ""
        self._add(root, "universe", flyer, joint_name, SE3.identity(), inertia, {}, 0.0)

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
    ) -> None:
        """Add a link.

        Parameters
        ----------
        name : str
        parent : str
            The link that carries this one; it must have been added before.
        joint : Joint, optional
            What moves the link; without one it is welded to its parent.
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

        Raises
        ------
        ModelError
            A name that is taken, limits that cross, an armature below zero, limits or an armature on a weld.
        NameNotFound
            If the parent is not known.
        """
        limits = {"lower": lower, "upper": upper, "velocity_limit": velocity_limit, "effort_limit": effort_limit}
        if parent not in self._links:
            raise unknown_name("parent link", parent, self._links)
        self._add(
            name,
            parent,
            joint,
            joint_name or name,
            placement or SE3.identity(),
            inertia or SpatialInertia.zero(),
            limits,
            armature,
        )

    def _add(
        self,
        name: str,
        parent: str,
        joint: Joint | None,
        joint_name: str,
        placement: SE3,
        inertia: SpatialInertia,
        limits: Mapping[str, ArrayLike],
        armature: ArrayLike,
    ) -> None:
        if name in self._links:
            raise ModelError(f"link {name!r}: the name is taken")
        if joint_name in (other.joint_name for other in self._links.values()):
            raise ModelError(f"link {name!r}: the joint name {joint_name!r} is taken")
        nq, nv = (joint.nq, joint.nv) if joint else (0, 0)
        wide = {"lower": -np.inf, "upper": np.inf, "velocity_limit": np.inf, "effort_limit": np.inf} | dict(limits)
        sizes = {"lower": nq, "upper": nq, "velocity_limit": nv, "effort_limit": nv}
        vectors = {key: _vector(wide[key], size, f"joint {joint_name!r}: {key}") for key, size in sizes.items()}
        if (vectors["lower"] > vectors["upper"]).any():
            raise ModelError(
                f"joint {joint_name!r}: lower limit {vectors['lower']} is above upper limit {vectors['upper']}"
            )
        rotor = _vector(armature, nv, f"joint {joint_name!r}: armature")
        if (rotor < 0).any():
            raise ModelError(f"joint {joint_name!r}: armature {armature!r} is below zero")
        if joint is None and (np.any(armature) or any(np.isfinite(limit).any() for limit in limits.values())):
            raise ModelError(f"link {name!r}: limits and armature belong to a joint, and this link is welded on")
        self._links[name] = _Link(name, parent, joint, joint_name, placement, inertia, **vectors, armature=rotor)

    def build(self, *, postures: Mapping[str, ArrayLike] | None = None, feet: Sequence[str] = ()) -> Model:
        """Make the model.

        Parameters
        ----------
        postures : mapping of str to array_like, shape (nq,), optional
            Named configurations.
        feet : sequence of str
            The frames on which a legged robot stands.

        Returns
        -------
        Model

        Raises
        ------
        NameNotFound, ShapeError, ValueError
            If a foot is no frame, or a posture is no configuration.
        """
        tree = _Numbered(self._links)
        moved = tree.moved
        model = Model(
            name=self._name,
            base=self._base,
            joint_names=("universe", *(link.joint_name for link in moved)),
            joints=(None, *(link.joint for link in moved)),
            parent=tuple(tree.parent),
            placement=tuple(tree.placement),
            inertia=tuple(tree.inertia),
            frames=tree.frames,
            gravity=self._gravity,
            armature=_join([link.armature for link in moved]),
            lower=_join([link.lower for link in moved]),
            upper=_join([link.upper for link in moved]),
            velocity_limit=_join([link.velocity_limit for link in moved]),
            effort_limit=_join([link.effort_limit for link in moved]),
            postures={},
            feet=tuple(feet),
        )
        for foot in feet:
            model.frame(foot)
        checked = {name: _join([model.state(q)[0]]) for name, q in (postures or {}).items()}
        return replace(model, postures=checked)


class _Numbered:
    """The links in their final order, depth first: bodies numbered, welded links merged."""

    def __init__(self, links: Mapping[str, _Link]) -> None:
        self.moved: list[_Link] = []
        self.parent, self.placement, self.inertia = [-1], [SE3.identity()], [SpatialInertia.zero()]
        found: dict[tuple[str, str], Frame] = {}
        children: dict[str, list[_Link]] = {name: [] for name in ("universe", *links)}
        for link in sorted(links.values(), key=lambda link: link.joint_name, reverse=True):
            children[link.parent].append(link)
        waiting = [(link, 0, SE3.identity()) for link in children["universe"]]
        while waiting:  # the last one in is the first one out, hence the reversed order above
            link, carrier, in_carrier = waiting.pop()
            carrier, at = self._place(link, carrier, in_carrier @ link.placement)
            if link.joint is not None or link.parent != "universe":  # a fixed root link hangs on no joint
                found["joint", link.joint_name] = Frame(carrier, at)
            found["link", link.name] = Frame(carrier, at)
            waiting += [(child, carrier, at) for child in children[link.name]]
        self.frames = _named(found)

    def _place(self, link: _Link, carrier: int, at: SE3) -> tuple[int, SE3]:
        """Give a moved link its number, or merge a welded one; return the body and where the link is in it."""
        if link.joint is not None:
            self.moved.append(link)
            self.parent.append(carrier)
            self.placement.append(at)
            self.inertia.append(link.inertia)
            carrier, at = len(self.parent) - 1, SE3.identity()
        elif carrier > 0:  # what is welded to the world never moves
            self.inertia[carrier] = self.inertia[carrier] + link.inertia.transform(at)
        return carrier, at


def _named(found: Mapping[tuple[str, str], Frame]) -> dict[str, Frame]:
    """Name the frames of links and joints.

    A link and a joint of one name are one frame where they share the place. Where they do not, neither
    gets the bare name, so that nobody takes one for the other: ``link:name`` and ``joint:name``.
    """
    frames = {}
    for (kind, name), frame in found.items():
        other = found.get(("link" if kind == "joint" else "joint", name), frame)
        same = other.body == frame.body and bool((other.placement.matrix() == frame.placement.matrix()).all())
        frames[name if same else f"{kind}:{name}"] = frame
    return frames


def _vector(value: ArrayLike, size: int, what: str) -> Array:
    """Return a float64 vector of `size` entries; a scalar is repeated."""
    x = np.asarray(value, dtype=np.float64)
    if x.shape not in ((), (size,)):
        raise ShapeError(f"{what}: expected shape () or ({size},), got {x.shape}")
    if np.isnan(x).any():
        raise ModelError(f"{what}: is not a number")
    return np.broadcast_to(x, size).copy()


def _join(pieces: list[Array]) -> Array:
    joined = np.concatenate([np.zeros(0), *pieces])
    joined.flags.writeable = False
    return joined

"""Make a model in a few lines of Python. The URDF loader goes through here as well.

Links are added one by one; each is carried by a parent through a joint, or welded to it. `Builder.build`
merges welded links into the body that carries them and numbers the bodies as Pinocchio does: depth
first, siblings in the order of their joints' names.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_exactly, as_flag, check_choice, check_kind
from ..errors import ModelError, check_known
from ..spatial import SE3, SpatialInertia
from .checks import PER_DOF, WORLD
from .joint import Joint
from .joints import FreeFlyer
from .link import Link
from .model import Model
from .numbering import NumberedTree
from .report import Report

__all__ = ["GRAVITY", "Builder"]

GRAVITY = (0.0, 0.0, -9.81)
"""Acceleration of free fall in the world, m/s², unless another is given."""

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
        self._add(Link.checked(root, WORLD, flyer, joint_name, SE3.identity(), inertia, {}))

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
        self._add(Link.checked(name, parent, joint, joint_name, placement, inertia, numbers))

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
        report = Report(tree.check_bodies(physical))
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

"""From a URDF to a `Model`: the file is checked here, parsed by yourdfpy and put together by `Builder`."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from ..builder import Builder
from ..errors import ModelError
from ..inertia import SpatialInertia
from ..joint import Joint
from ..joint_types import Continuous, FreeFlyer, Planar, Prismatic, Revolute
from ..model import Model
from ..plucker import SE3
from .reading import XML, read_robot_xml
from .urdf_checks import INERTIA, LIMITS, check_mimics, check_robot

__all__ = ["load_urdf"]

Base = Literal["fixed", "floating"]

KEPT = {
    "link": ("name",),
    "inertial": (),
    "mass": ("value",),
    "inertia": INERTIA,
    "joint": ("name", "type"),
    "origin": ("xyz", "rpy"),
    "parent": ("link",),
    "child": ("link",),
    "axis": ("xyz",),
    "limit": LIMITS,
}
"""The elements, and their attributes, that yourdfpy gets to see. Meshes are not among them: none is looked for."""

INSIDE = {
    "robot": ("link", "joint"),
    "link": ("inertial",),
    "inertial": ("origin", "mass", "inertia"),
    "joint": ("origin", "parent", "child", "axis", "limit"),
    "fixed": ("origin", "parent", "child"),
}
"""Which of them stand inside which. An axis or a limit means nothing on a fixed joint."""


def load_urdf(path: Path, *, base: Base, gravity: ArrayLike, physical: bool, quiet: bool) -> Model:
    """Load a URDF. The arguments are those of `twistwrench.load`.

    Parameters
    ----------
    path : Path
    base : {"fixed", "floating"}
    gravity : array_like, shape (3,)
        In the world, m/s².
    physical : bool
        Refuse bodies that cannot exist.
    quiet : bool
        Do not warn of joints that should mimic others, nor ask whether there are such others.

    Returns
    -------
    Model

    Raises
    ------
    ModelError
        See `twistwrench.load`.
    """
    root = read_robot_xml(path)
    check_robot(path, root)
    if not quiet:
        check_mimics(path, root)
        _warn_of_mimics(path, root)
    robot = _through_yourdfpy(root, default_name=path.stem)
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            model = _build(robot, base, gravity, physical)
    except ModelError as error:
        raise ModelError(f"{path}: {error}") from None
    return model


def _through_yourdfpy(root: XML, default_name: str) -> Any:
    """Hand yourdfpy the checked part of the file; return its `Robot` of links and joints."""
    import yourdfpy
    from lxml import etree

    plain = etree.Element("robot", name=root.get("name") or default_name)
    waiting = [(root, plain, INSIDE["robot"])]
    for element, copy, tags in waiting:  # grows as it is walked
        for child in element.iterchildren(*tags):
            attributes = {key: child.get(key) for key in KEPT[child.tag] if child.get(key) is not None}
            inside = INSIDE.get("fixed" if child.get("type") == "fixed" else child.tag, ())
            waiting.append((child, etree.SubElement(copy, child.tag, attributes), inside))
    text = BytesIO(etree.tostring(plain, encoding="utf-8"))
    return yourdfpy.URDF.load(text, build_scene_graph=False, load_meshes=False).robot


def _build(robot: Any, base: Base, gravity: ArrayLike, physical: bool) -> Model:
    """Put the tree together, from the root outwards."""
    links, root = {link.name: link for link in robot.links}, _root(robot)
    builder = Builder(robot.name, base=base, root=root, root_inertia=_inertia(links[root]), gravity=gravity)
    for joint in _outwards(robot, root):
        builder.link(
            joint.child,
            parent=joint.parent,
            joint=_joint(joint),
            joint_name=joint.name,
            placement=_placement(joint.origin),
            inertia=_inertia(links[joint.child]),
            **_limits(joint),
        )
    return builder.build(physical=physical)


def _root(robot: Any) -> str:
    carried = {joint.child for joint in robot.joints}
    return next(str(link.name) for link in robot.links if link.name not in carried)


def _outwards(robot: Any, root: str) -> Iterator[Any]:
    """Yield the joints of a tree, each after the one that carries it."""
    leaving: dict[str, list[Any]] = {}
    for joint in robot.joints:
        leaving.setdefault(joint.parent, []).append(joint)
    reached = [root]
    for link in reached:  # grows as it is walked
        for joint in leaving.get(link, ()):
            reached.append(joint.child)
            yield joint


def _joint(joint: Any) -> Joint | None:
    match joint.type:
        case "revolute":
            return Revolute(joint.axis)
        case "continuous":
            return Continuous(joint.axis)
        case "prismatic":
            return Prismatic(joint.axis)
        case "planar":
            return Planar()
        case "floating":
            return FreeFlyer()
    return None  # fixed


def _limits(joint: Any) -> dict[str, Any]:
    """Return the limits of a joint. Only revolute and prismatic joints have an end of their range."""
    limit = joint.limit
    if joint.type == "fixed" or limit is None:
        return {}
    limits = {"velocity_limit": limit.velocity, "effort_limit": limit.effort}
    if joint.type in ("revolute", "prismatic"):
        limits |= {"lower": limit.lower or 0.0, "upper": limit.upper or 0.0}  # URDF: 0 when not given
    return limits


def _placement(origin: Any) -> SE3:
    return SE3.identity() if origin is None else SE3.from_matrix(origin)


def _inertia(link: Any) -> SpatialInertia:
    """Return a link's inertia in its own frame: its <origin> may turn the axes of <inertia> as well."""
    if link.inertial is None:
        return SpatialInertia.zero()
    about_com = SpatialInertia(link.inertial.mass, np.zeros(3), link.inertial.inertia)
    return about_com.transform(_placement(link.inertial.origin))


def _warn_of_mimics(path: Path, root: XML) -> None:
    moved = [joint for joint in root.findall("joint") if joint.get("type") != "fixed"]
    mimics = {j.get("name"): j.find("mimic").get("joint") for j in moved if j.find("mimic") is not None}
    if mimics:
        shown = ", ".join(f"{name!r} of {leader!r}" for name, leader in list(mimics.items())[:4])
        warnings.warn(
            f"{path}: joints that should mimic others are free to move on their own, as in Pinocchio: {shown}"
            + (f" and {len(mimics) - 4} more" if len(mimics) > 4 else "")
            + "; mimic='independent' says that you know",
            UserWarning,
            stacklevel=4,
        )

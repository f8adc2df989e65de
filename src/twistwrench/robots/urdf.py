"""From a URDF to a `Model`: the file is checked, read, and put together by `Builder`."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from ..builder import Builder
from ..checks import Array
from ..errors import ModelError
from ..inertia import SpatialInertia
from ..joint import Joint
from ..joint_types import Continuous, FreeFlyer, Planar, Prismatic, Revolute
from ..model import Model
from ..plucker import SE3
from ..rotation import rpy_to_rotation
from .reading import XML, read_robot_xml
from .urdf_checks import INERTIA, check_mimics, check_robot

__all__ = ["load_urdf"]

Base = Literal["fixed", "floating"]


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
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            model = _build(root, root.get("name") or path.stem, base, gravity, physical)
    except ModelError as error:
        raise ModelError(f"{path}: {error}") from None
    return model


def _build(root: XML, name: str, base: Base, gravity: ArrayLike, physical: bool) -> Model:
    """Put the tree together, from the root outwards. What is read here has been checked."""
    links = {link.get("name"): link for link in root.findall("link")}
    joints = root.findall("joint")
    first = next(iter(links.keys() - {joint.find("child").get("link") for joint in joints}))
    builder = Builder(name, base=base, root=first, root_inertia=_inertia(links[first]), gravity=gravity)
    for joint in _outwards(joints, first):
        child = joint.find("child").get("link")
        builder.link(
            child,
            parent=joint.find("parent").get("link"),
            joint=_joint(joint),
            joint_name=joint.get("name"),
            placement=_placement(joint.find("origin")),
            inertia=_inertia(links[child]),
            **_limits(joint),
        )
    return builder.build(physical=physical)


def _outwards(joints: list[XML], root: str) -> Iterator[XML]:
    """Yield the joints of a tree, each after the one that carries it."""
    leaving: dict[str, list[XML]] = {}
    for joint in joints:
        leaving.setdefault(joint.find("parent").get("link"), []).append(joint)
    reached = [root]
    for link in reached:  # grows as it is walked
        for joint in leaving.get(link, ()):
            reached.append(joint.find("child").get("link"))
            yield joint


def _joint(joint: XML) -> Joint | None:
    axis = _numbers(joint.find("axis"), "xyz", "1 0 0")
    match joint.get("type"):
        case "revolute":
            return Revolute(axis)
        case "continuous":
            return Continuous(axis)
        case "prismatic":
            return Prismatic(axis)
        case "planar":
            return Planar()
        case "floating":
            return FreeFlyer()
    return None  # fixed: an axis or a limit means nothing there


def _limits(joint: XML) -> dict[str, Any]:
    """Return the limits of a joint. Only revolute and prismatic joints have an end of their range."""
    limit, kind = joint.find("limit"), joint.get("type")
    if kind == "fixed" or limit is None:
        return {}
    limits = {"velocity_limit": float(limit.get("velocity")), "effort_limit": float(limit.get("effort"))}
    if kind in ("revolute", "prismatic"):
        limits |= {key: float(limit.get(key, "0")) for key in ("lower", "upper")}  # URDF: 0 when not given
    return limits


def _placement(origin: XML | None) -> SE3:
    if origin is None:
        return SE3.identity()
    return SE3(rpy_to_rotation(_numbers(origin, "rpy", "0 0 0")), _numbers(origin, "xyz", "0 0 0"))


def _inertia(link: XML) -> SpatialInertia:
    """Return a link's inertia in its own frame: its <origin> may turn the axes of <inertia> as well."""
    inertial = link.find("inertial")
    if inertial is None:
        return SpatialInertia.zero()
    xx, xy, xz, yy, yz, zz = (float(inertial.find("inertia").get(key)) for key in INERTIA)
    moments = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    about_com = SpatialInertia(float(inertial.find("mass").get("value")), np.zeros(3), moments)
    return about_com.transform(_placement(inertial.find("origin")))


def _numbers(element: XML | None, key: str, default: str) -> Array:
    """Read the numbers of an attribute; `default` is what URDF means where it, or its element, is missing."""
    text = default if element is None else element.get(key, default)
    return np.array([float(word) for word in text.split()])


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

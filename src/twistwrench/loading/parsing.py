"""From the XML of a URDF to its records, in one pass: each number is checked where it is read.

yourdfpy accepts cycles, two roots, orphans and names that are used twice, and inserts a default where
a number is missing. Here each of these is an error with file, line and name. Whether an inertia is
physical is decided later, once the welded links are merged: see `Builder.build`.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import ModelError, unknown_name
from ..model import Entry, LoadReport
from ..spatial import SE3, SpatialInertia, rpy_to_rotation
from .element import LEFT_OUT, XML, Element, read_document
from .records import UrdfJoint, UrdfLink, UrdfMimic, UrdfRobot, outwards
from .rotors import read_rotors

__all__ = ["read_urdf"]

JOINT_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
RANGED = ("revolute", "prismatic")
MAX_USUAL_M = 10.0
"""Metres: longer ones in an <origin>, or as a radius of gyration, are often millimetres."""

AXIS_RTOL = 1e-9
"""Relative size of the x and y of an axis along z that are rounding, as a CAD program leaves it."""

RESERVED = "universe"
"""Pinocchio's name of the world, which stands in `Model.joint_names` as well."""

POINT = "a point mass"
GIVEN = "given, in metres and kg m²"
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
TWINS = {"iyx": "ixy", "izx": "ixz", "izy": "iyz"}
"""The entries below the diagonal, which the format leaves out, and those above it."""


def read_urdf(path: Path, text: str | None = None) -> UrdfRobot:
    """Read a URDF.

    Parameters
    ----------
    path : Path
    text : str, optional
        The URDF itself; `path` then only names it.

    Returns
    -------
    UrdfRobot

    Raises
    ------
    ModelError
        Naming the file, the line, the link or joint, and what was expected.
    """
    xml, remarks = read_document(path, text)
    try:
        return _robot(path, xml, remarks)
    except ModelError as error:
        unread = LoadReport(entry for entry in remarks if entry.read_as == LEFT_OUT)
        raise ModelError(f"{error}{unread.summary()}") from None


def _robot(path: Path, xml: XML, remarks: list[Entry]) -> UrdfRobot:
    """Read the links, the joints, and the tree that they make."""
    robot = Element(xml, path, "the robot", remarks)
    links = {name: _link(name, element) for name, element in _named(robot, "link").items()}
    if not links:
        raise ModelError(f"{path}: the robot has no <link>")
    joints = {name: _joint(name, element, links) for name, element in _named(robot, "joint").items()}
    rotors = read_rotors(robot, joints)
    joints |= {name: replace(joints[name], numbers={**joints[name].numbers, **rotor}) for name, rotor in rotors.items()}
    root, ordered = outwards(path, links, joints)
    return UrdfRobot(xml.get("name") or path.stem, root, links, ordered, tuple(remarks))


def _named(robot: Element, tag: str) -> dict[str, Element]:
    """Collect the elements of one kind by name; each must have one, and its own."""
    found: dict[str, Element] = {}
    for xml in robot.xml.findall(tag):
        name, at = xml.get("name"), f"{robot.path}, line {xml.sourceline}"
        element = Element(xml, robot.path, f"{tag} {name!r}", robot.remarks)
        if not name:
            raise ModelError(f"{at}: this <{tag}> has no name")
        if name == RESERVED:
            raise ModelError(f"{at}: a {tag} cannot be called {name!r}: that names the world")
        if name in found:
            raise ModelError(f"{at}: two {tag}s are called {name!r} (the first on line {found[name].xml.sourceline})")
        found[name] = element
    return found


# -------------------------------------------------------------------- links


def _link(name: str, link: Element) -> UrdfLink:
    """Read mass and inertia: no <inertial> is a massless link, a mass without <inertia> a point."""
    inertial = link.only("inertial")
    if inertial is None:
        return UrdfLink(name, SpatialInertia.zero())
    placement = _placement(inertial)
    mass, inertia = inertial.only("mass"), inertial.only("inertia")
    missing = ["<mass>" if mass is None else "mass value"] if mass is None or mass.get("value") is None else []
    if inertia is not None:
        missing += [key for key in MOMENTS if inertia.get(key) is None]
    if mass is None or missing:
        raise inertial.error(
            f"its <inertial> is incomplete: {', '.join(missing)} missing (for a link without mass leave out <inertial>)"
        )
    moments, kilograms = np.zeros((3, 3)) if inertia is None else _moments(inertia), mass.number("value")
    if kilograms < 0:
        raise mass.error(f"its mass is {mass.get('value')}, expected 0 or more")
    if inertia is None and kilograms > 0:
        inertial.remark("no <inertia>", POINT)
    if inertia is not None and (largest := moments.diagonal().max()) > kilograms * MAX_USUAL_M**2 > 0:
        inertia.remark(f"a radius of gyration of {math.sqrt(largest / kilograms):.3g} m", GIVEN)
    about_com = SpatialInertia(kilograms, np.zeros(3), moments)
    return UrdfLink(name, about_com.transform(placement))  # its <origin> may turn the axes of <inertia> as well


def _moments(inertia: Element) -> np.ndarray:
    """Read the six numbers of a symmetric matrix, or all nine where they agree."""
    value = {key: inertia.number(key) for key in MOMENTS}
    twins = {key: inertia.number(key) for key in TWINS if inertia.get(key) is not None}
    room = 1e-8 * max(map(abs, value.values()))
    for key, number in twins.items():
        if abs(number - value[TWINS[key]]) > room:
            raise inertia.error(
                f"its {key} = {number:g} contradicts {TWINS[key]} = {value[TWINS[key]]:g}: expected a symmetric matrix"
            )
    if twins:
        inertia.remark(f"{', '.join(twins)} beside the six numbers of <inertia>", "the same matrix")
    xx, xy, xz, yy, yz, zz = value.values()
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


# -------------------------------------------------------------------- joints


def _joint(name: str, joint: Element, links: dict[str, UrdfLink]) -> UrdfJoint:
    kind = joint.get("type")
    if kind not in JOINT_TYPES:
        got, known = "missing" if kind is None else repr(kind), ", ".join(JOINT_TYPES)
        raise joint.error(f"its type is {got}, expected one of {known}")
    moves = kind != "fixed"  # an axis, a limit or a mimic means nothing there
    placement = _placement(joint)
    axis = _axis(joint, kind) if moves else ()
    numbers = _limits(joint, kind) | _dynamics(joint) if moves else {}
    mimic = _mimic(joint) if moves else None
    parent, child = (_end(joint, name, tag, links) for tag in ("parent", "child"))
    return UrdfJoint(name, kind, parent, child, placement, axis, numbers, mimic, joint.xml.sourceline)


def _placement(element: Element) -> SE3:
    origin = element.only("origin")
    if origin is None:
        return SE3.identity()
    nothing = (0.0, 0.0, 0.0)
    xyz, rpy = origin.numbers("xyz", nothing), origin.numbers("rpy", nothing)
    if (distance := math.hypot(*xyz)) > MAX_USUAL_M:
        origin.remark(f"<origin> {distance:.3g} m away", GIVEN)
    return SE3._trusted(rpy_to_rotation(np.array(rpy)), np.array(xyz))


def _axis(joint: Element, kind: str) -> tuple[float, ...]:
    """Read an axis that can be normalised; for a planar joint check that the plane is x-y, but for rounding."""
    element = joint.only("axis")
    if element is not None and element.get("xyz") is None:
        raise element.error("its <axis> has no xyz")
    axis = (1.0, 0.0, 0.0) if element is None else element.numbers("xyz", (1.0, 0.0, 0.0))
    place = joint if element is None else element
    if kind == "planar" and not math.hypot(*axis[:2]) <= AXIS_RTOL * axis[2] > 0:
        got = "no <axis>, which means 1 0 0" if element is None else str([*axis])
        raise place.error(
            f"a planar joint moves in its x-y plane: expected <axis xyz='0 0 1'/>, got {got} "
            "(turn the joint's origin instead; Pinocchio ignores this axis)"
        )
    if kind != "floating" and not any(axis):
        raise place.error("its axis is zero, expected a direction")
    return axis


def _limits(joint: Element, kind: str) -> dict[str, float]:
    """Read the limits, which do not affect the dynamics: a missing or impossible one is infinite.

    Only revolute and prismatic joints have a range. Of one that has but one end the other is 0, as the format says.
    """
    limit = joint.only("limit")
    if limit is None:
        if kind in RANGED:
            joint.remark("no <limit>", "no limits")
        return {}
    limits = {}
    for key in ("effort", "velocity"):
        value = limit.number(key, -math.inf, infinite=True)
        if value >= 0:
            limits[f"{key}_limit"] = value
        else:
            limit.remark(f"no {key} limit" if limit.get(key) is None else f"{key} limit {value:g}", "no limit of it")
    return limits | _range(limit, kind)


def _range(limit: Element, kind: str) -> dict[str, float]:
    """Read the ends of a joint's range; nothing is returned where it has none."""
    lower, upper = (limit.number(key, infinite=True) for key in ("lower", "upper"))
    ends = f"lower limit {lower:g}, upper limit {upper:g}"
    missing = [key for key in ("lower", "upper") if limit.get(key) is None]
    if kind not in RANGED:
        if any(math.isfinite(end) and end for end in (lower, upper)):
            limit.remark(ends, f"no end of its range: a {kind} joint has none")
        return {}
    if len(missing) == 2:
        others = ", ".join(sorted({*limit.xml.attrib} - {"effort", "velocity"}))
        limit.remark("neither lower nor upper limit" + f" (but {others})" * bool(others), "no end of its range")
        return {}
    if lower > upper or lower == math.inf or upper == -math.inf:
        limit.remark(f"lower limit {lower:g} above upper limit {upper:g}", "no end of its range")
        return {}
    if missing:
        limit.remark(f"no {missing[0]} limit", "0, as the format says", warns=False)
    if lower == upper:
        limit.remark(ends, "given: the joint cannot move", warns=False)
    return {"lower": lower, "upper": upper}


def _dynamics(joint: Element) -> dict[str, float]:
    """Read damping and friction, which are kept and enter no algorithm."""
    element = joint.only("dynamics")
    if element is None:
        return {}
    found = {key: element.number(key) for key in ("damping", "friction")}
    for key, value in found.items():
        if value < 0:
            element.remark(f"{key} {value:g}", "none")
        elif value > 0:
            element.remark(f"{key} {value:g}", f"model.{key}, applied by time-stepping only", warns=False)
    return {key: value for key, value in found.items() if value > 0}


def _mimic(joint: Element) -> UrdfMimic | None:
    element = joint.only("mimic")
    if element is None:
        return None
    multiplier, offset = element.number("multiplier", 1.0), element.number("offset")
    leader = element.get("joint")
    if not leader:
        raise element.error("its <mimic> names no joint")
    return UrdfMimic(leader, multiplier, offset, element.xml.sourceline)


def _end(joint: Element, name: str, tag: str, links: dict[str, UrdfLink]) -> str:
    """Return the name of a joint's parent or child link, which must exist."""
    element = joint.only(tag)
    link = None if element is None else element.get("link")
    if element is None or not link:
        raise ModelError(f"{joint.at}: joint {name!r} names no {tag} link")
    if link not in links:
        raise element.error(f"its {tag}: {unknown_name('link', link, links)}")
    return link

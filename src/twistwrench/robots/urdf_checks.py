"""What a URDF must hold before anybody computes with it.

yourdfpy accepts cycles, two roots, orphans and names that are used twice, and puts a default where
a number is missing. Here each of these is an error with file, line and name. Whether an inertia is
one that a body can have is decided later, once the welded links are merged: see `urdf`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

from ..errors import ModelError, unknown_name
from .reading import XML
from .urdf_words import check_words

__all__ = ["INERTIA", "JOINT_TYPES", "check_mimics", "check_robot"]

INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
LIMITS = ("lower", "upper", "effort", "velocity")
JOINT_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
RESERVED = "universe"
"""Pinocchio's name of the world, which stands in `Model.joint_names` as well."""


def check_robot(path: Path, root: XML) -> None:
    """Check links, joints, numbers and the tree they make.

    Parameters
    ----------
    path : Path
        For the messages.
    root : lxml element
        The ``<robot>`` element.

    Raises
    ------
    ModelError
        Naming the file, the line, the link or joint, and what was expected.
    """
    check_words(path, root)
    links, joints = _named(path, root, "link"), _named(path, root, "joint")
    if not links:
        raise ModelError(f"{path}: the robot has no <link>")
    for name, link in links.items():
        _check_inertial(path, name, link)
    for name, joint in joints.items():
        _check_joint(path, name, joint)
    _check_tree(path, links, joints)


def check_mimics(path: Path, root: XML) -> None:
    """Demand that a joint mimics another one of the robot.

    Parameters
    ----------
    path : Path
        For the messages.
    root : lxml element
        The ``<robot>`` element, checked.

    Raises
    ------
    ModelError
        Naming the file, the line and the joint.
    """
    joints = [joint.get("name") for joint in root.findall("joint")]
    for joint in root.findall("joint"):
        mimic = joint.find("mimic") if joint.get("type") != "fixed" else None
        if mimic is None:
            continue
        leader, what = mimic.get("joint"), f"{_at(path, mimic)}: joint {joint.get('name')!r}: its <mimic>"
        if leader == joint.get("name"):
            raise ModelError(f"{what} names the joint itself, expected another one")
        if leader not in joints:
            raise ModelError(f"{what}: {unknown_name('joint', leader, joints)}")


def _named(path: Path, root: XML, tag: str) -> dict[str, XML]:
    """Collect the elements of one kind by name; each must have one, and its own."""
    found: dict[str, XML] = {}
    for element in root.findall(tag):
        name = element.get("name")
        if not name:
            raise ModelError(f"{_at(path, element)}: this <{tag}> has no name")
        if name == RESERVED:
            raise ModelError(f"{_at(path, element)}: a {tag} cannot be called {name!r}: that names the world")
        if name in found:
            first = found[name].sourceline
            raise ModelError(f"{_at(path, element)}: two {tag}s are called {name!r} (the first on line {first})")
        found[name] = element
    return found


# -------------------------------------------------------------------- numbers


def _check_inertial(path: Path, name: str, link: XML) -> None:
    """Demand all of mass and inertia, or no <inertial> at all, which is a massless link."""
    what = f"link {name!r}"
    inertial = _only(path, what, link, "inertial")
    if inertial is None:
        return
    _check_origin(path, what, inertial)
    mass, inertia = _only(path, what, inertial, "mass"), _only(path, what, inertial, "inertia")
    missing = [f"<{tag}>" for tag, element in (("mass", mass), ("inertia", inertia)) if element is None]
    if mass is not None and mass.get("value") is None:
        missing.append("mass value")
    if inertia is not None:
        missing += [key for key in INERTIA if inertia.get(key) is None]
    if missing:
        raise ModelError(
            f"{_at(path, inertial)}: {what}: its <inertial> is incomplete: {', '.join(missing)} missing "
            "(for a link without mass leave out <inertial>)"
        )
    for key in INERTIA:
        _numbers(path, inertia, what, key, 1)
    if _numbers(path, mass, what, "value", 1)[0] < 0:
        raise ModelError(f"{_at(path, mass)}: {what}: its mass is {mass.get('value')}, expected 0 or more")


def _check_joint(path: Path, name: str, joint: XML) -> None:
    what, kind = f"joint {name!r}", joint.get("type")
    if kind not in JOINT_TYPES:
        came, known = "missing" if kind is None else repr(kind), ", ".join(JOINT_TYPES)
        raise ModelError(f"{_at(path, joint)}: {what}: its type is {came}, expected one of {known}")
    _check_origin(path, what, joint)
    if kind == "fixed":
        return
    _check_axis(path, what, joint, kind)
    _check_limit(path, what, joint, kind)
    for tag, keys in (("dynamics", ("damping", "friction")), ("mimic", ("multiplier", "offset"))):
        element = _only(path, what, joint, tag)
        if element is not None:
            _optional_numbers(path, element, what, keys, 1)
            if tag == "mimic" and not element.get("joint"):
                raise ModelError(f"{_at(path, element)}: {what}: its <mimic> names no joint")


def _check_axis(path: Path, what: str, joint: XML, kind: str) -> None:
    """Refuse an axis that cannot be normalised, and a plane that is not x-y."""
    element = _only(path, what, joint, "axis")
    if element is not None and element.get("xyz") is None:
        raise ModelError(f"{_at(path, element)}: {what}: its <axis> has no xyz")
    axis = [1.0, 0.0, 0.0] if element is None else _numbers(path, element, what, "xyz", 3)
    place = _at(path, joint if element is None else element)
    if kind == "planar" and not (axis[0] == axis[1] == 0 < axis[2]):
        got = "no <axis>, which means 1 0 0" if element is None else str(axis)
        raise ModelError(
            f"{place}: {what}: a planar joint moves in its x-y plane: expected <axis xyz='0 0 1'/>, got {got} "
            "(turn the joint's origin instead; Pinocchio ignores this axis)"
        )
    if kind != "floating" and not any(axis):
        raise ModelError(f"{place}: {what}: its axis is zero, expected a direction")


def _check_limit(path: Path, what: str, joint: XML, kind: str) -> None:
    """Demand effort and velocity; lower and upper are 0 when they are not given, as URDF has it."""
    limit = _only(path, what, joint, "limit")
    if limit is None:
        if kind in ("revolute", "prismatic"):
            hint = "; a turn without end is type 'continuous'" if kind == "revolute" else ""
            raise ModelError(f"{_at(path, joint)}: {what}: a {kind} joint needs a <limit>{hint}")
        return
    missing = [key for key in ("effort", "velocity") if limit.get(key) is None]
    if missing:
        raise ModelError(f"{_at(path, limit)}: {what}: its <limit> lacks {' and '.join(missing)}")
    value = _optional_numbers(path, limit, what, LIMITS, 1)
    lower, upper = value.get("lower", 0.0), value.get("upper", 0.0)
    if lower > upper:
        raise ModelError(f"{_at(path, limit)}: {what}: its lower limit {lower} is above its upper limit {upper}")
    for key in ("effort", "velocity"):
        if value[key] < 0:
            raise ModelError(f"{_at(path, limit)}: {what}: its {key} limit is {value[key]}, expected 0 or more")


def _check_origin(path: Path, what: str, element: XML) -> None:
    origin = _only(path, what, element, "origin")
    if origin is not None:
        _optional_numbers(path, origin, what, ("xyz", "rpy"), 3)


def _optional_numbers(path: Path, element: XML, what: str, keys: tuple[str, ...], count: int) -> dict[str, float]:
    """Check those of the attributes that are there; return the first number of each."""
    return {key: _numbers(path, element, what, key, count)[0] for key in keys if element.get(key) is not None}


def _numbers(path: Path, element: XML, what: str, key: str, count: int) -> list[float]:
    """Read `count` finite numbers from an attribute."""
    text = element.get(key)
    name = f"{_at(path, element)}: {what}: <{element.tag} {key}={text!r}>"
    words = text.split()
    if len(words) != count:
        raise ModelError(f"{name}: expected {count} number{'s' * (count > 1)}, got {len(words)}")
    values = []
    for word in words:
        try:
            values.append(float(word if word.isascii() and "_" not in word else "?"))  # Python alone reads 1_000
        except ValueError:
            hint = "; expand the macros with xacro first" if "$" in word else ""
            raise ModelError(f"{name}: {word!r} is not a number{hint}") from None
        if not math.isfinite(values[-1]):
            raise ModelError(f"{name}: {word!r} is not a finite number")
    return values


# -------------------------------------------------------------------- the tree


def _check_tree(path: Path, links: dict[str, XML], joints: dict[str, XML]) -> None:
    """Demand that every link but one hangs on exactly one joint, and no link on itself."""
    carrier: dict[str, str] = {}
    parent: dict[str, str] = {}
    for name, joint in joints.items():
        ends = {tag: _end(path, name, joint, tag, links) for tag in ("parent", "child")}
        child = ends["child"]
        if child == ends["parent"]:
            raise ModelError(f"{_at(path, joint)}: joint {name!r}: link {child!r} is both its parent and its child")
        if child in carrier:
            raise ModelError(
                f"{_at(path, joint)}: link {child!r} hangs on two joints, {carrier[child]!r} and {name!r}: "
                "expected a tree (closed loops are not modelled)"
            )
        carrier[child], parent[child] = name, ends["parent"]
    if cycle := _cycle(links, parent):
        short = cycle if len(cycle) < 12 else [*cycle[:6], "...", *cycle[-4:]]
        raise ModelError(f"{path}: the links form a cycle: {' -> '.join(short)}; expected a tree with one root")
    roots = [name for name in links if name not in parent]
    if len(roots) > 1:
        shown = ", ".join(map(repr, roots[:6])) + (", ..." if len(roots) > 6 else "")
        raise ModelError(f"{path}: {len(roots)} links are no joint's child, expected one root: {shown}")


def _end(path: Path, name: str, joint: XML, tag: str, links: dict[str, XML]) -> str:
    """Return the name of a joint's parent or child link, which must exist."""
    element = _only(path, f"joint {name!r}", joint, tag)
    link = None if element is None else element.get("link")
    if not link:
        raise ModelError(f"{_at(path, joint)}: joint {name!r} names no {tag} link")
    if link not in links:
        raise ModelError(f"{_at(path, element)}: joint {name!r}: its {tag}: {unknown_name('link', link, links)}")
    return str(link)


def _cycle(links: dict[str, XML], parent: dict[str, str]) -> list[str]:
    """Return the links of a cycle, from a link back to itself; empty where there is none."""
    settled: set[str] = set()
    for start in links:
        path = [start]
        seen = {start}
        while path[-1] in parent and path[-1] not in settled:
            path.append(parent[path[-1]])
            if path[-1] in seen:
                return path[path.index(path[-1]) :][::-1]
            seen.add(path[-1])
        settled.update(path)
    return []


# -------------------------------------------------------------------- XML


def _only(path: Path, what: str, element: XML, tag: str) -> XML:
    """Return the child of this kind, or None; two would leave open which one counts."""
    found: Iterator[XML] = iter(element.findall(tag))
    first, second = next(found, None), next(found, None)
    if second is not None:
        raise ModelError(f"{_at(path, second)}: {what}: has two <{tag}>, expected one")
    return first


def _at(path: Path, element: XML) -> str:
    return f"{path}, line {element.sourceline}"

"""The contents of a URDF, as frozen records, and the tree that its joints make."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..errors import ModelError
from ..model import Entry
from ..spatial import SE3, SpatialInertia

__all__ = ["UrdfJoint", "UrdfLink", "UrdfMimic", "UrdfRobot", "outwards"]


@dataclass(frozen=True)
class UrdfLink:
    """A ``<link>``: its inertia in its own frame, zero where it has no ``<inertial>``."""

    name: str
    inertia: SpatialInertia


@dataclass(frozen=True)
class UrdfMimic:
    """A ``<mimic>``: q = multiplier q_leader + offset."""

    leader: str
    multiplier: float
    offset: float
    line: int


@dataclass(frozen=True)
class UrdfJoint:
    """A ``<joint>``. `numbers` are its limits, damping and friction, under the names of `Builder.link`."""

    name: str
    kind: str
    parent: str
    child: str
    placement: SE3
    axis: tuple[float, ...]
    numbers: Mapping[str, float]
    mimic: UrdfMimic | None
    line: int


@dataclass(frozen=True)
class UrdfRobot:
    """A ``<robot>``: its root link, all links by name, the joints from the root outwards, and the report."""

    name: str
    root: str
    links: Mapping[str, UrdfLink]
    joints: tuple[UrdfJoint, ...]
    remarks: tuple[Entry, ...]


def outwards(path: Path, links: Collection[str], joints: Mapping[str, UrdfJoint]) -> tuple[str, tuple[UrdfJoint, ...]]:
    """Return the root link, and the joints, each after the one that carries it.

    Parameters
    ----------
    path : Path
        For the messages.
    links : collection of str
    joints : mapping of str to UrdfJoint

    Raises
    ------
    ModelError
        Unless every link but one hangs on exactly one joint, and no link on itself.
    """
    carrier: dict[str, UrdfJoint] = {}
    leaving: dict[str, list[UrdfJoint]] = {name: [] for name in links}
    for joint in joints.values():
        at, child = f"{path}, line {joint.line}", joint.child
        if child == joint.parent:
            raise ModelError(f"{at}: joint {joint.name!r}: link {child!r} is both its parent and its child")
        if child in carrier:
            raise ModelError(
                f"{at}: link {child!r} hangs on two joints, {carrier[child].name!r} and {joint.name!r}: "
                "expected a tree (closed loops are not modelled)"
            )
        carrier[child] = joint
        leaving[joint.parent].append(joint)
    if cycle := _cycle(links, {child: joint.parent for child, joint in carrier.items()}):
        short = cycle if len(cycle) < 12 else [*cycle[:6], "...", *cycle[-4:]]
        raise ModelError(f"{path}: the links form a cycle: {' -> '.join(short)}; expected a tree with one root")
    roots = [name for name in links if name not in carrier]
    if len(roots) > 1:
        shown = ", ".join(map(repr, roots[:6])) + (", ..." if len(roots) > 6 else "")
        raise ModelError(f"{path}: {len(roots)} links are no joint's child, expected one root: {shown}")
    ordered = [*leaving[roots[0]]]
    for joint in ordered:  # grows as it is walked
        ordered += leaving[joint.child]
    return roots[0], tuple(ordered)


def _cycle(links: Collection[str], parent: Mapping[str, str]) -> list[str]:
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

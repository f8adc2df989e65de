"""The contents of a URDF, as frozen records: every number read once, and checked where it was read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..model import Entry
from ..spatial import SE3, SpatialInertia

__all__ = ["UrdfJoint", "UrdfLink", "UrdfMimic", "UrdfRobot"]


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

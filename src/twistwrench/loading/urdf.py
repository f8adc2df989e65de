"""From a URDF to a `Model`: the file is read into records, and `Builder` puts them together."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import Law
from ..errors import ModelError, unknown_name
from ..model import Builder, Continuous, Entry, FreeFlyer, Joint, LoadReport, Model, Planar, Prismatic, Revolute
from ..model.builder import IMPOSSIBLE
from .parsing import read_urdf
from .records import UrdfJoint, UrdfRobot

__all__ = ["load_urdf"]

Base = Literal["fixed", "floating"]
Mimic = Literal["independent", "reduce"]

FREE = "free to move on its own, as in Pinocchio (mimic='independent' silences this, mimic='reduce' lets it follow)"


def load_urdf(
    path: Path,
    *,
    base: Base,
    gravity: ArrayLike,
    physical: bool | None,
    mimic: Mimic | None,
    strict: bool,
    quiet: bool,
    text: str | None = None,
) -> tuple[Model, dict[str, Law]]:
    """Load a URDF. The arguments are those of `twistwrench.load`.

    Parameters
    ----------
    path : Path
    base : {"fixed", "floating"}
    gravity : array_like, shape (3,)
        In the world, m/s².
    physical : bool, optional
        As in `Builder.build`.
    mimic : {"independent", "reduce"}, optional
        Of no effect on the joints, which are free here: the laws are returned.
    strict : bool
        Raise for what would be reported.
    quiet : bool
        Report, and warn of nothing but bodies that cannot exist.
    text : str, optional
        The URDF itself; `path` then only names it.

    Returns
    -------
    Model
    dict of str to (str, float, float)
        For each joint with ``<mimic>`` its leader, the multiplier and the offset.

    Raises
    ------
    ModelError
        See `twistwrench.load`.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        robot = read_urdf(path, text)
        if mimic == "reduce" or (mimic is None and not quiet):
            _check_mimics(path, robot)
        try:
            model, remarks = _build(robot, base, gravity, physical)
        except ModelError as error:
            raise ModelError(f"{path}: {error}") from None
    impossible = LoadReport(entry for entry in model.report.warnings if entry.read_as == IMPOSSIBLE)
    known = {(entry.where, entry.read_as) for entry in robot.remarks}
    bodies = [entry for entry in model.report if (entry.where, entry.read_as) not in known]
    model = replace(model, report=LoadReport([*robot.remarks, *remarks, *_mimics(robot, mimic), *bodies]))
    odd = model.report.warnings
    if odd and strict:
        raise ModelError(f"{path}: strict=True rejects what is not as it should be:{odd.summary()}")
    odd = impossible if quiet else odd
    if odd:
        hint = "model.report has the table, strict=True rejects them"
        warnings.warn(f"{path}: not all is as it should be ({hint}):{odd.summary()}", stacklevel=3)
    followers = [(joint.name, joint.mimic) for joint in robot.joints if joint.mimic is not None]
    return model, {name: (law.leader, law.multiplier, law.offset) for name, law in followers}


def _build(robot: UrdfRobot, base: Base, gravity: ArrayLike, physical: bool | None) -> tuple[Model, list[Entry]]:
    """Put the tree together, from the root outwards."""
    names = {joint.name for joint in robot.joints}
    free = "root_joint"
    while free in names:
        free += "_"
    builder = Builder(
        robot.name,
        base=base,
        root=robot.root,
        root_inertia=robot.links[robot.root].inertia,
        root_joint=free,
        gravity=gravity,
    )
    for joint in robot.joints:
        builder.link(
            joint.child,
            parent=joint.parent,
            joint=_joint(joint),
            joint_name=joint.name,
            placement=joint.placement,
            inertia=robot.links[joint.child].inertia,
            **joint.numbers,
        )
    taken = base == "floating" and free != "root_joint"
    note = Entry("joint 'root_joint'", "the name of the floating base's joint", f"the file's; the base's is {free!r}")
    return builder.build(physical=physical), [note] * taken


def _joint(joint: UrdfJoint) -> Joint | None:
    match joint.kind:
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
    return None


def _check_mimics(path: Path, robot: UrdfRobot) -> None:
    """Raise unless a joint mimics another one of the robot."""
    names = [joint.name for joint in robot.joints]
    for joint in robot.joints:
        if joint.mimic is None:
            continue
        what = f"{path}, line {joint.mimic.line}: joint {joint.name!r}: its <mimic>"
        free = "(mimic='independent' loads it, free to move on its own)"
        if joint.mimic.leader == joint.name:
            raise ModelError(f"{what} names the joint itself, expected another one {free}")
        if joint.mimic.leader not in names:
            raise ModelError(f"{what}: {unknown_name('joint', joint.mimic.leader, names)} {free}")


def _mimics(robot: UrdfRobot, mimic: Mimic | None) -> list[Entry]:
    """Report which joints should follow others, and whether they do."""
    return [
        Entry(
            f"joint {joint.name!r}",
            f"a <mimic> of {law.leader!r}",
            f"q = {law.multiplier:g} q_leader + {law.offset:g}" if mimic == "reduce" else FREE,
            law.line,
            warns=mimic is None,
        )
        for joint in robot.joints
        if (law := joint.mimic) is not None
    ]

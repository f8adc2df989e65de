"""Rotors in the ``<transmission>`` of a URDF: what they add to the mass matrix.

The format has no number for it. Drake's ``<drake:rotor_inertia>`` and ``<drake:gear_ratio>`` do, in the ``<actuator>``:
the joint feels I n². A ratio alone, as in ``<mechanicalReduction>`` of a transmission, changes nothing, and is noted.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from .element import LEFT_OUT, XML, Element, spell_tag
from .records import UrdfJoint
from .urdf_words import local_name

__all__ = ["read_rotors"]

REDUCTIONS = ("mechanicalReduction", "mechanical_reduction")
"""What a ratio is called: in a <transmission>, its <joint> or <actuator>, and in that of ros2_control."""

ONE_SPEED = ("revolute", "continuous", "prismatic")


def read_rotors(robot: Element, joints: Mapping[str, UrdfJoint]) -> dict[str, dict[str, float]]:
    """Return the armature of each joint that a rotor drives, under the name of `Builder.link`.

    Parameters
    ----------
    robot : Element
    joints : mapping of str to UrdfJoint

    Raises
    ------
    ModelError
        If a number is none, or an inertia is below zero.
    """
    found: dict[str, dict[str, float]] = {}
    for xml in robot.xml.iter("transmission"):
        names = [str(joint.get("name")) for joint in xml.findall("joint")]
        what = f"joint {names[0]!r}" if len(names) == 1 else f"<{spell_tag(xml)}> of {len(names)} joints"
        transmission = replace(robot, xml=xml, what=what)
        armature = sum(_reflected(transmission, actuator) for actuator in xml.findall("actuator"))
        if not armature:
            _note_gears(transmission)
            continue
        if len(names) == 1 and names[0] in joints and joints[names[0]].kind in ONE_SPEED:
            transmission.remark("a rotor", f"armature {armature:g}, as in Drake (Pinocchio has none)", warns=False)
            found[names[0]] = {"armature": armature + found.get(names[0], {}).get("armature", 0.0)}
        else:
            transmission.remark("a rotor", LEFT_OUT)
    return found


def _reflected(transmission: Element, actuator: XML) -> float:
    """Return what a rotor adds at the joint, I n²."""
    numbers = {"rotor_inertia": 0.0, "gear_ratio": 1.0}
    for child in actuator.iterchildren("*"):
        name = local_name(child.tag)
        if name in numbers and name != child.tag:
            numbers[name] = replace(transmission, xml=child).number("value", numbers[name])
        elif name in numbers:
            replace(transmission, xml=child).remark(f"<{name}> without drake:", LEFT_OUT)
    if numbers["rotor_inertia"] < 0:
        raise transmission.error(f"its rotor_inertia is {numbers['rotor_inertia']:g}, expected 0 or more", actuator)
    return numbers["rotor_inertia"] * numbers["gear_ratio"] * numbers["gear_ratio"]


def _note_gears(transmission: Element) -> None:
    """Note the gears of a transmission whose rotor the file does not have."""
    parts = [part for part in transmission.xml.iter("*") if isinstance(part.tag, str)]
    given = [(part.text or "").strip() for part in parts if local_name(part.tag) in REDUCTIONS]
    given += [part.get("value", "") for part in parts if local_name(part.tag) == "gear_ratio" != part.tag]
    gears = {*given} - {"", "1", "1.0", "-1", "-1.0"}
    if gears:
        transmission.remark(f"a gear of {', '.join(sorted(gears))}", "no armature: the file has no rotor", warns=False)

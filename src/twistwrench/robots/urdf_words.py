"""Slips of the pen in a URDF: ``<axs>``, ``<inertal>``, ``<origin xzy=...>``.

A URDF may hold elements and attributes that a reader does not know: those of simulators and drivers are
passed over. A misspelt one would be as well, and another robot loaded than was meant. What is unknown and
all but a word of the format is therefore an error.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from ..errors import ModelError
from .reading import XML

__all__ = ["check_words"]

CHILDREN = {
    "robot": ("link", "joint"),
    "link": ("inertial",),
    "inertial": ("origin", "mass", "inertia"),
    "joint": ("origin", "parent", "child", "axis", "limit", "mimic"),
}
"""What stands inside what, and counts for the dynamics."""

ATTRIBUTES = {
    "link": ("name",),
    "joint": ("name", "type"),
    "origin": ("xyz", "rpy"),
    "mass": ("value",),
    "inertia": ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"),
    "parent": ("link",),
    "child": ("link",),
    "axis": ("xyz",),
    "limit": ("lower", "upper", "effort", "velocity"),
    "mimic": ("joint", "multiplier", "offset"),
}

QUATERNION = "quat_xyzw"
"""An attribute of <origin> in a later version of the format."""

ALIKE = 0.65
"""From here on two words are taken for one (difflib's ratio): xzy and xyz have 0.67, command_effort and effort 0.6."""


def check_words(path: Path, root: XML) -> None:
    """Refuse what looks like a misspelt element or attribute.

    Parameters
    ----------
    path : Path
        For the messages.
    root : lxml element
        The ``<robot>`` element.

    Raises
    ------
    ModelError
        Naming the file, the line, the link or joint, and the word that was meant; also for a quaternion in an
        ``<origin>``, which is not read.
    """
    for what, element in _walk(root):
        place = f"{path}, line {element.sourceline}: {what}"
        known = ATTRIBUTES.get(element.tag, ())
        if element.tag == "origin" and QUATERNION in element.attrib:
            raise ModelError(f"{place}: <origin {QUATERNION}=...> is not read; give the rotation as rpy")
        for key in element.attrib:
            if meant := _meant(key, known):
                raise ModelError(f"{place}: unknown attribute {key!r} of <{element.tag}>; did you mean {meant!r}?")
        if element.tag in CHILDREN:
            for child in element.iterchildren("*"):
                if meant := _meant(child.tag, CHILDREN[element.tag]):
                    line = f"{path}, line {child.sourceline}: {what}"
                    raise ModelError(f"{line}: unknown element <{child.tag}>; did you mean <{meant}>?")


def _walk(root: XML) -> Iterator[tuple[str, XML]]:
    """Yield every element that counts, with the link or joint that it belongs to."""
    waiting = [("the robot", root)]
    for what, element in waiting:  # grows as it is walked
        yield what, element
        inside = element.iterchildren(*CHILDREN[element.tag]) if element.tag in CHILDREN else ()
        waiting += [(f"{child.tag} {child.get('name')!r}" if element is root else what, child) for child in inside]


@cache
def _meant(word: str, known: tuple[str, ...]) -> str:
    """Return the word of the format that this is all but; empty where it is one, or its own ("gear_velocity")."""
    import difflib  # only where there is a word to look at

    if word in known or "}" in word or set(known) & set(word.split("_")):
        return ""
    return next(iter(difflib.get_close_matches(word.lower(), known, n=1, cutoff=ALIKE)), "")

"""The words of a URDF, and those that look like them: ``<axs>``, ``<origin xzy=...>``, ``<joint xyz=...>``.

A URDF may hold elements and attributes that a reader does not know: those of simulators and drivers are
ignored. A misspelt word would be ignored as well, and so would one in the wrong place: a different robot would be
loaded. An unknown name that nearly is a word of the format is therefore an error, and a word of the format in a
place where it means nothing is reported.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Any

__all__ = [
    "ATTRIBUTES",
    "BY_ATTRIBUTES",
    "CHILDREN",
    "NOT_DYNAMICS",
    "WORDS",
    "home_of",
    "is_ignored_attribute",
    "is_ignored_child",
    "local_name",
    "meant",
    "words_of",
]

CHILDREN = {
    "robot": ("link", "joint"),
    "link": ("inertial",),
    "inertial": ("origin", "mass", "inertia"),
    "joint": ("origin", "parent", "child", "axis", "limit", "mimic", "dynamics"),
}
"""The children of each element that matter for the dynamics."""

ATTRIBUTES = {
    "link": ("name",),
    "joint": ("name", "type"),
    "origin": ("xyz", "rpy"),
    "mass": ("value",),
    "inertia": ("ixx", "ixy", "ixz", "iyy", "iyz", "izz", "iyx", "izx", "izy"),
    "parent": ("link",),
    "child": ("link",),
    "axis": ("xyz",),
    "limit": ("lower", "upper", "effort", "velocity"),
    "mimic": ("joint", "multiplier", "offset"),
    "dynamics": ("damping", "friction"),
}

BY_ATTRIBUTES = {*ATTRIBUTES} - {"link", "joint", "limit"}
"""Elements whose whole meaning is in their attributes. (Drivers add theirs to a <limit>: those count for nothing.)"""

WORDS = {word for words in (*CHILDREN.values(), *ATTRIBUTES.values()) for word in words} - {"name", "type"}
"""All words of the format but those two, which label anything."""

LABELS = {"link", "joint", "value"}
"""Words that are attributes of elements of many other formats as well."""

ROTOR = {"armature", "rotor_inertia", "gear_ratio"}
"""Words of MJCF and of Drake for what a rotor adds to the inertia of a joint."""

OTHER_FORMATS = {"include", "pose", "com"}
"""Elements of SDF, of xacro and of the first URDFs that place or hold a body."""

NOT_DYNAMICS = {"visual", "collision", "geometry", "material", "gazebo", "sensor", "camera", "transmission", "plugin"}
"""Elements that do not affect the equations of motion, whatever their contents."""

EXTENSIONS = {
    *("safety_controller", "calibration", "hardwareInterface", "ros2_control", "mujoco", "contact", "frame"),
    *("collision_checking", "collision_filter_group", "self_collision_checking", "self_filter", "surface"),
}
"""More of them, those of the format, of drivers and of simulators, by their whole name."""

MIN_SIMILARITY = 0.65
"""Similarity (difflib's ratio) of a misspelt word, at least: xzy and xyz have 0.67, command_effort and effort 0.6."""


def words_of(name: str) -> set[str]:
    """Return the words that a name is made of.

    Examples
    --------
    >>> sorted(words_of("RefLink") | words_of("gear_velocity"))
    ['gear', 'link', 'ref', 'velocity']
    """
    return {word.lower() for word in re.findall(r"[A-Z]?[^A-Z_\-.]+|[A-Z]+", name)}


def home_of(word: str, tag: str) -> str:
    """Return the element in which a word of the format belongs, and nothing where it may stand in `tag`.

    Examples
    --------
    >>> home_of("mass", "link"), home_of("visual", "link")
    ('inertial', '')
    """
    if word in CHILDREN.get(tag, ()):
        return ""
    return next((home for home, words in CHILDREN.items() if word in words), "")


def local_name(name: str) -> str:
    """Return a name without its prefix or namespace.

    Examples
    --------
    >>> local_name("drake:joint"), local_name("{http://drake.mit.edu}joint"), local_name("joint")
    ('joint', 'joint', 'joint')
    """
    return name.rpartition("}")[2].rpartition(":")[2]


def is_ignored_attribute(tag: str, key: str) -> bool:
    """Return whether an attribute stands where a number of the dynamics may be meant, and is not one of the format.

    Examples
    --------
    >>> is_ignored_attribute("origin", "position"), is_ignored_attribute("joint", "xyz")
    (True, True)
    >>> is_ignored_attribute("link", "type")
    False
    """
    if key in ATTRIBUTES.get(tag, ()):
        return False
    return local_name(key) in WORDS | ROTOR or (tag in BY_ATTRIBUTES and local_name(key) == key)


def is_ignored_child(tag: str, child: Any) -> bool:
    """Return whether a child that is none of `tag` may be meant for the dynamics.

    Whatever stands in an <inertial> or a <joint> may; elsewhere, or with a prefix, what holds a word of the format.

    Parameters
    ----------
    tag : str
    child : lxml element

    Examples
    --------
    >>> from lxml import etree
    >>> group, gravity = etree.fromstring("<group><link name='a'/></group>"), etree.fromstring("<gravity>1</gravity>")
    >>> is_ignored_child("robot", group), is_ignored_child("link", gravity), is_ignored_child("inertial", gravity)
    (True, False, True)
    """
    name = local_name(child.tag)
    if "xacro" in child.tag or name in NOT_DYNAMICS | EXTENSIONS:
        return False
    if name == child.tag and tag not in ("robot", "link"):
        return True
    inside = {local_name(x.tag) for x in child.iter("*")}
    inside |= {local_name(key) for x in child.iter("*") for key in x.attrib} - LABELS
    return bool(inside & (WORDS | OTHER_FORMATS) or words_of(name) & WORDS)


@cache
def meant(word: str, known: tuple[str, ...]) -> str:
    """Return the word of the format that this is a misspelling of.

    Empty where it is a word of the format, has a prefix, or is a compound of its own, such as gear_velocity.

    Examples
    --------
    >>> meant("xzy", ("xyz", "rpy")), meant("RefLink", ("link", "joint"))
    ('xyz', '')
    """
    import difflib  # only where there is a word to compare

    if word in known or "}" in word or ":" in word or (len(words_of(word)) > 1 and set(known) & words_of(word)):
        return ""
    return next(iter(difflib.get_close_matches(word.lower(), known, n=1, cutoff=MIN_SIMILARITY)), "")

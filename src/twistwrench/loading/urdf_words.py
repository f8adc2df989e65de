"""Slips of the pen in a URDF: ``<axs>``, ``<inertal>``, ``<origin xzy=...>``.

A URDF may hold elements and attributes that a reader does not know: those of simulators and drivers are
ignored. A misspelt one would be ignored as well, and a different robot loaded. An unknown name that nearly is a
word of the format is therefore an error.
"""

from __future__ import annotations

import re
from functools import cache

__all__ = ["ATTRIBUTES", "CHILDREN", "NOT_DYNAMICS", "home_of", "ignored_attribute", "meant", "words_of"]

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

SAID_BY_ATTRIBUTES = {"origin", "mass", "inertia", "parent", "child", "axis", "mimic"}
"""Elements whose whole meaning is in their attributes, and counts for the dynamics."""

NOT_DYNAMICS = {"visual", "collision", "geometry", "material", "gazebo", "sensor", "camera", "transmission", "plugin"}
"""Elements that do not affect the equations of motion, whatever their contents."""

ALIKE = 0.65
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


def ignored_attribute(tag: str, key: str) -> bool:
    """Return whether an attribute stands where a number of the dynamics may be meant, and is not one of the format.

    Examples
    --------
    >>> ignored_attribute("origin", "position"), ignored_attribute("joint", "axis"), ignored_attribute("link", "type")
    (True, True, False)
    """
    if key in ATTRIBUTES.get(tag, ()) or "}" in key or ":" in key:
        return False
    return tag in SAID_BY_ATTRIBUTES or (tag in ("link", "joint") and any(key in words for words in CHILDREN.values()))


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
    return next(iter(difflib.get_close_matches(word.lower(), known, n=1, cutoff=ALIKE)), "")

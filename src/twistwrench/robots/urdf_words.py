"""Slips of the pen in a URDF: ``<axs>``, ``<inertal>``, ``<origin xzy=...>``.

A URDF may hold elements and attributes that a reader does not know: those of simulators and drivers are
passed over. A misspelt one would be as well, and another robot loaded than was meant. What is unknown and
all but a word of the format is therefore an error.
"""

from __future__ import annotations

import re
from functools import cache

__all__ = ["ATTRIBUTES", "CHILDREN", "NOT_DYNAMICS", "meant", "words_of"]

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
    "inertia": ("ixx", "ixy", "ixz", "iyy", "iyz", "izz", "iyx", "izx", "izy"),
    "parent": ("link",),
    "child": ("link",),
    "axis": ("xyz",),
    "limit": ("lower", "upper", "effort", "velocity"),
    "mimic": ("joint", "multiplier", "offset"),
}

NOT_DYNAMICS = {"visual", "collision", "geometry", "material", "gazebo", "sensor", "camera", "transmission", "plugin"}
"""Elements that change no equation of motion, whatever stands in them."""

ALIKE = 0.65
"""From here on two words are taken for one (difflib's ratio): xzy and xyz have 0.67, command_effort and effort 0.6."""


def words_of(name: str) -> set[str]:
    """Return the words that a name is made of.

    Examples
    --------
    >>> sorted(words_of("RefLink") | words_of("gear_velocity"))
    ['gear', 'link', 'ref', 'velocity']
    """
    return {word.lower() for word in re.findall(r"[A-Z]?[^A-Z_\-.]+|[A-Z]+", name)}


@cache
def meant(word: str, known: tuple[str, ...]) -> str:
    """Return the word of the format that this is all but.

    Empty where it is one, has a prefix, or is a word of its own: put together of several, such as gear_velocity.

    Examples
    --------
    >>> meant("xzy", ("xyz", "rpy")), meant("RefLink", ("link", "joint"))
    ('xyz', '')
    """
    import difflib  # only where there is a word to look at

    if word in known or "}" in word or ":" in word or (len(words_of(word)) > 1 and set(known) & words_of(word)):
        return ""
    return next(iter(difflib.get_close_matches(word.lower(), known, n=1, cutoff=ALIKE)), "")

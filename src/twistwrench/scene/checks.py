"""Input validation of a scene: contacts and wrenches that are impossible, or could change nothing."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_exactly, as_sequence
from ..contact import Contact
from ..errors import ModelError
from ..model import Model

__all__ = ["SAME_PLACE", "checked_contacts", "checked_wrenches", "expect_movable"]

SAME_PLACE = 1e-9
"""Two points of a body that are closer than this count as one, m."""


def checked_contacts(model: Model, contacts: Iterable[Contact]) -> tuple[Contact, ...]:
    """Return contacts of frames that the model has, each place touched once.

    Raises
    ------
    TypeError
        If one of them is not a contact.
    NameNotFound
        If the model has no such frame.
    ModelError
        If two of them touch at the same place.
    """
    if isinstance(contacts, str | Contact):
        raise TypeError(f"contacts: expected a sequence of contacts, got {contacts!r}")
    contacts = as_sequence(contacts, "contacts", "contacts", ordered=True)
    for contact in contacts:
        if not isinstance(contact, Contact):
            got = f"{type(contact).__name__} {contact!r}"
            raise TypeError(f"contacts: expected contacts such as PointContact(frame, mu=0.7), got {got}")
        for frame in contact.frames:
            model.frame(frame)
    for one, other in combinations([c for c in contacts if c.pushes], 2):
        here, there = model.frame(one.frame), model.frame(other.frame)
        apart = np.abs(here.placement.translation - there.placement.translation).max()
        if here.body == there.body and apart < SAME_PLACE:
            same = (type(one), _terms(one)) == (type(other), _terms(other))
            verdict = "the same contact twice" if same else "they contradict each other"
            raise ModelError(f"contacts {one} and {other} touch at one place of one body: {verdict}")
    return contacts


def _terms(contact: Contact) -> dict[str, object]:
    return {name: value for name, value in vars(contact).items() if name != "frame"}


def checked_wrenches(model: Model, wrenches: Mapping[str, ArrayLike]) -> dict[str, Array]:
    """Return one wrench for each frame named, in float64.

    Raises
    ------
    NameNotFound
        If the model has no such frame.
    ShapeError, ValueError
        If a wrench is not six finite real numbers.
    TypeError
        If they are given without the names of their frames.
    """
    if not isinstance(wrenches, Mapping):
        raise TypeError(f"wrenches: expected a mapping of frames to wrenches, got {type(wrenches).__name__}")
    checked = {}
    for frame, value in wrenches.items():
        model.frame(frame)
        checked[frame] = as_exactly(value, f"wrenches[{frame!r}]", 6)
    return checked


def expect_movable(model: Model, frames: Iterable[str], what: str) -> None:
    """Raise for frames that the scene leaves fixed to the world: no force on them could change anything.

    Raises
    ------
    ModelError
        Names the frame.
    """
    for name in frames:
        if model.frame(name).body == 0:
            raise ModelError(f"{what} {name!r}: the scene holds this frame fixed to the world; nothing can move it")

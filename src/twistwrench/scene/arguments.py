"""The arguments of a scene, checked: the robot and where it stands, its payload, contacts and wrenches (49.5)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields, replace
from itertools import combinations
from os import PathLike

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_exactly, as_number, as_sequence, check_kind
from ..contact import Contact
from ..errors import ModelError, no_model
from ..loading import load
from ..model import Model, attach, in_double, one_configuration
from ..spatial import SpatialInertia

__all__ = [
    "SAME_PLACE",
    "Payload",
    "add_payload",
    "check_contacts",
    "check_wrenches",
    "expect_movable",
    "posture",
    "whole_robot",
]


def whole_robot(robot: str | PathLike[str] | Model, base: str | None, gravity: ArrayLike | None) -> Model:
    """Return the robot with the gravity of the scene, and with a floating base where the scene needs one."""
    if not isinstance(base, str | None) or base not in (None, "fixed", "floating", "planar"):
        raise ModelError(f"base: expected 'fixed', 'floating' or 'planar', got {base!r}")
    if not isinstance(robot, str | PathLike | Model):
        raise no_model(robot, "robot", "a name, a path or a Model")
    flies = base in ("floating", "planar")
    model = robot if isinstance(robot, Model) else load(robot, base="floating" if flies else None)
    if flies and model.base != "floating":
        raise ModelError(f"base: {model.name!r} has a fixed base, not a {base} one; load it with base='floating'")
    if gravity is None:
        return model
    return replace(model, gravity=as_exactly(gravity, "gravity", 3))


def posture(model: Model, q: ArrayLike | None) -> Array:
    """Return where a scene's robot stands: q, or the standing posture, or the neutral one."""
    if q is None:
        return model.standing() if "standing" in model.postures else model.neutral()
    return in_double(model, one_configuration(model, q))


Payload = float | SpatialInertia | Model


def add_payload(model: Model, payload: Mapping[str, Payload] | None) -> Model:
    """Return the robot with what it carries, by the frames that carry it.

    Raises
    ------
    NameNotFound
        If the model has no such frame.
    ModelError
        If a mass is not above 0, if no such body can exist, if a frame is fixed to the world, or as `attach`.
    TypeError
        If it is given without the names of frames, or is neither a mass, a SpatialInertia nor a Model.
    """
    given = {} if payload is None else payload
    check_kind(given, "payload", Mapping, "what is carried by the names of frames")
    for frame, what in given.items():
        at = model.frame(frame)
        name = f"payload[{frame!r}]"
        if at.body == 0:
            raise ModelError(f"{name}: the world carries this frame")
        if isinstance(what, Model):
            model = attach(model, what, frame, prefix=f"{what.name}_")
            continue
        if not isinstance(what, SpatialInertia):
            if not 0 < as_number(what, name) < float("inf"):
                raise ModelError(f"{name}: expected a mass above 0, got {what!r}")
            what = SpatialInertia.from_point(float(what), [0, 0, 0])
        what.check_physical(name)
        body = model.inertia[at.body] + what.transform(at.placement)
        model = replace(model, inertia=(*model.inertia[: at.body], body, *model.inertia[at.body + 1 :]))
    return model


SAME_PLACE = 1e-9
"""Two points of a body that are closer than this count as one, m."""


def check_contacts(model: Model, contacts: Iterable[Contact]) -> tuple[Contact, ...]:
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
    """Return what a contact was made with, but its frame; not what it remembers since."""
    return {field.name: getattr(contact, field.name) for field in fields(contact) if field.name != "frame"}  # type: ignore[arg-type]


def check_wrenches(model: Model, wrenches: Mapping[str, ArrayLike]) -> dict[str, Array]:
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

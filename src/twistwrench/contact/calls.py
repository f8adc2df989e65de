"""The program of some contacts, which is found again at once where a loop asks for the same ones (49.9)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from straightline.llvm import default_backend

from ..algorithms.mimic import MimicModel
from ..arrays import Array
from ..fast.program import Program
from ..fast.programs import cached_program
from ..fast.quantity import Quantity
from ..model import Model
from .kinds import PointContact, SphereContact, SurfaceContact, WheelContact
from .programs import Equations, Once, Solution
from .rows import per_contact
from .types import Contact

__all__ = ["ContactProgram", "contact_program", "is_programmed", "known_program"]

DOUBLE = np.dtype(np.float64)

MAX_KNOWN = 64  # sets of contacts that are found again by their addresses

NOTHING: Mapping[tuple[int, ...], Any] = {}


class ContactProgram(NamedTuple):
    """A program of some contacts: in a state it finds a row of arrays, of which the last ones are λ of each contact."""

    contacts: tuple[Contact, ...]
    program: Program
    frames: tuple[str, ...]
    dim: int

    def one(self, *state: Any) -> tuple[Array, ...] | None:
        """Return what is found in one state; None for all else, and where the rows are not safely independent."""
        function = self.program.one_state
        found: tuple[Array, ...] | None = function(*state) if function else None
        return found

    def __call__(self, q: Array, v: Array, **others: Array) -> tuple[Array, ...] | None:
        """Return what is found in states that have been checked; None where one alone is the textbook's."""
        if self.program.one_state and q.ndim == 1 and "f_ext" not in others:
            return self.one(q, v, *others.values())
        return tuple(vars(self.program(q, v, *others.values())).values())


def is_programmed(contacts: Sequence[Contact]) -> bool:
    """Return whether a program is worth its making: machine code, for contacts at rest."""
    at_rest = not any(c.velocity or c.acceleration for c in contacts)
    return bool(contacts) and at_rest and default_backend(DOUBLE) == "llvm"


def known_program(model: Model | MimicModel, kind: str, contacts: Any) -> ContactProgram | None:
    """Return the program that was made for these very contacts, which it keeps: so none else has their addresses."""
    if type(contacts) not in (list, tuple) or type(model) is not Model:
        return None
    found: ContactProgram | None = model._programs.get(kind, NOTHING).get((*map(id, contacts),))
    return found


def without_friction(contact: Contact) -> Contact:
    """Return a contact with the same rows: those of different friction share a program."""
    if type(contact) in (PointContact, SurfaceContact, SphereContact, WheelContact):
        return replace(contact, mu=1.0, restitution=None)  # type: ignore[type-var]
    return contact


def contact_program(
    model: Model,
    kind: str,
    contacts: tuple[Contact, ...],
    equations: Callable[..., Equations],
    size: int,
    more: Callable[[Solution, Array], Sequence[Array]],
    textbook: Callable[..., Sequence[Array]],
) -> ContactProgram:
    """Return the program of contacts that have been checked: made once.

    `equations` makes what it solves. It finds `size` arrays: x, `more` of a solution at a velocity, and λ of each
    contact; the textbook returns the same, of arrays that do not remember.
    """

    def asked() -> list[Quantity]:
        made = equations(model, contacts, DOUBLE)
        answered = Once(textbook)

        def quantity(place: int) -> Quantity:
            def compute(q: Array, v: Array, *others: Array) -> tuple[Array, list[Any]]:
                if q.dtype != object:
                    return answered(q, v, *others)[place], []
                found = made.solved(q, v, *others)
                parts = [found.motion, *more(found, v), *per_contact(contacts, found.force).values()]
                return parts[place], found.watched if place == 0 else []

            return Quantity(f"{kind}{place}", made.arguments, compute)

        return [quantity(place) for place in range(size)]

    known = known_program(model, kind, contacts)
    if known is None:
        program = cached_program(model, (kind, DOUBLE, *map(without_friction, contacts)), DOUBLE, asked)
        known = ContactProgram(contacts, program, tuple(c.frame for c in contacts), sum(c.dim for c in contacts))
        every = model._programs.setdefault(kind, {})
        if len(every) >= MAX_KNOWN:  # contacts that are made anew for each call
            every.clear()
        every[(*map(id, contacts),)] = known
    return known

"""The program of some contacts, which is found again at once where a loop asks for the same ones (49.9).

One array has all that is found in a state, one thing after the other: x, λ, and more.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from straightline.llvm import default_backend

from ..algorithms.mimic import MimicModel
from ..arrays import Array
from ..fast.program import Program
from ..fast.programs import cached_program
from ..fast.quantity import Quantity
from ..model import Model
from .programs import Equations, Solution
from .types import Contact

__all__ = ["ContactProgram", "at_once", "contact_program", "is_programmed", "known_program", "stacked"]

DOUBLE = np.dtype(np.float64)


class ContactProgram(NamedTuple):
    """A program, and where in its result the motion is, λ of each contact by its frame, and what follows."""

    contacts: tuple[Contact, ...]
    program: Program
    motion: tuple[Any, slice]
    forces: tuple[tuple[str, tuple[Any, slice]], ...]
    dim: int

    def one(self, *state: Any) -> Array | None:
        """Return what is found in one state; None for all else, and where the rows are not safely independent."""
        function = self.program.one_state
        found: Array | None = function(*state) if function else None
        return found

    def __call__(self, q: Array, v: Array, **others: Array) -> Array | None:
        """Return what is found in states that have been checked; None where one alone is the textbook's."""
        if self.program.one_state and q.ndim == 1 and "f_ext" not in others:
            return self.one(q, v, *others.values())
        found: Array = self.program(q, v, *others.values())
        return found

    def forces_of(self, x: Array) -> dict[str, Array]:
        """Return λ by frame."""
        return {frame: x[at] for frame, at in self.forces}


def is_programmed(contacts: Sequence[Contact]) -> bool:
    """Return whether a program is worth its making: machine code, for contacts at rest."""
    at_rest = not any(c.velocity or c.acceleration for c in contacts)
    return bool(contacts) and at_rest and default_backend(DOUBLE) == "llvm"


def known_program(model: Model | MimicModel, kind: str, contacts: Any) -> ContactProgram | None:
    """Return the program that was made for these very contacts, which it keeps: so none else has their addresses."""
    if type(contacts) not in (list, tuple) or type(model) is not Model:
        return None
    found: ContactProgram | None = model._programs.get((kind, *map(id, contacts)))
    return found


def at_once(model: Model | MimicModel, kind: str, contacts: Any, *state: Any) -> tuple[ContactProgram, Array] | None:
    """Return what the program that is known finds in one state; None where the other way has to be gone."""
    known = known_program(model, kind, contacts)
    x = known and known.one(*state)
    return None if known is None or x is None else (known, x)


def contact_program(
    model: Model,
    kind: str,
    contacts: tuple[Contact, ...],
    equations: Callable[..., Equations],
    more: Callable[[Solution, Array], Sequence[Array]],
    textbook: Callable[..., Array],
) -> ContactProgram:
    """Return the program of contacts that have been checked: made once.

    `equations` makes what it solves. `more` returns, of a solution at a velocity, what follows x and λ, as numbers that
    remember; `textbook` all of it, of arrays.
    """

    def asked() -> list[Quantity]:
        made = equations(model, contacts, DOUBLE)

        def compute(q: Array, v: Array, *others: Array) -> tuple[Array, list[Any]]:
            if q.dtype != object:
                return textbook(q, v, *others), []
            found = made.solved(q, v, *others)
            return stacked(found.motion, found.force, *more(found, v)), found.watched

        return [Quantity(kind, made.arguments, compute)]

    end, forces = model.nv, []
    for c in contacts:
        forces.append((c.frame, (..., slice(end, end + c.dim))))
        end += c.dim
    program = cached_program(model, (kind, DOUBLE, contacts), DOUBLE, asked, single=True)
    known = ContactProgram(contacts, program, (..., slice(0, model.nv)), tuple(forces), end - model.nv)
    model._programs[(kind, *map(id, contacts))] = known
    return known


def stacked(*parts: Array) -> Array:
    """Return arrays one after the other along the last axis."""
    return np.concatenate(parts, axis=-1)

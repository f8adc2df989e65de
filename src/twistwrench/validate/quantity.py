"""A row of the table, and how far two right answers may lie apart."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ..arrays import Array
from ..errors import SingularError
from ..model import Model
from .oracle import Oracle
from .states import States

__all__ = ["DEFAULT_RTOL", "ComparedQuantity"]

DEFAULT_RTOL = 1e-12
"""Relative error that every quantity must keep, unless its conditioning forbids it."""


@dataclass(frozen=True)
class ComparedQuantity:
    """A row: one quantity, computed in three ways.

    Attributes
    ----------
    section : str
        Of the chapter.
    name : str
    pinocchio : str
        What Pinocchio calls it.
    ours : callable
        Of the model and a batch of states: the batched result, so that batching is checked as well.
    theirs : callable
        Of an `Oracle` and one state: Pinocchio's result, in the chapter's order.
    truth : callable
        Of the model and one state of mpmath numbers.
    terms : callable, optional
        Of the model and one state: the size of the terms that add up to the quantity. Where they
        cancel, rounding is theirs, not the result's.
    bound : callable, optional
        Of the model, one state and the right result: the relative error that the conditioning allows.
    residual : callable, optional
        Of the model, a state whose a is our result, and the same in exact numbers: the residual of
        the equation that the result should solve, relative to its terms. Used where the error is above 1e-12.
    singular : callable, optional
        Of the model, one state in exact numbers and the message of a SingularError of ours: whether it is
        right there. Unless given, it is where the truth does not exist either.
    applies : callable
        Of the model: whether it has this quantity.
    """

    section: str
    name: str
    pinocchio: str
    ours: Callable[[Model, States], Array]
    theirs: Callable[[Oracle, States], Array]
    truth: Callable[[Model, States], Array]
    terms: Callable[[Model, States], float] | None = None
    bound: Callable[[Model, States, Array], float] | None = None
    residual: Callable[[Model, States, States], float] | None = None
    applies: Callable[[Model], bool] = lambda model: True
    singular: Callable[[Model, States, str], bool] | None = None

    def is_singular(self, model: Model, states: Iterable[States], message: str) -> bool:
        """Return whether a SingularError of ours is right at one of these states, given in exact numbers."""
        if self.singular is not None:
            return any(self.singular(model, s, message) for s in states)
        return any(self._does_not_exist(model, s) for s in states)

    def _does_not_exist(self, model: Model, s: States) -> bool:
        try:
            self.truth(model, s)
        except SingularError:
            return True
        return False

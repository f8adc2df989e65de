"""One row measured: how far ours is from Pinocchio and from the truth, and whether that is allowed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from textwrap import shorten
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import ShapeError, SingularError
from ..model import Model
from .conditioning import CANCELLED_SHARE, TERM_RTOL
from .oracle import Oracle
from .quantity import DEFAULT_RTOL, ComparedQuantity
from .states import States

__all__ = ["Comparison", "Judge"]


@dataclass(frozen=True)
class Comparison:
    """The result for one quantity.

    Attributes
    ----------
    section, quantity, pinocchio : str
        Where in the chapter, what, and what Pinocchio calls it.
    shape : tuple of int
        Of the value at one state.
    ours_vs_pinocchio, ours_vs_truth, pinocchio_vs_truth : float or None
        Worst relative error over the states; None where a side is missing, NaN where one gave no number.
        Where the bound varies, of the state that is closest to its bound.
    bound : float
        The relative error allowed: 1e-12, or more where the conditioning forbids that.
    passed : bool
    singular : bool
        Ours raises SingularError; the row passes if the quantity does not exist here.
    note : str
        Remarks besides the numbers.
    """

    section: str
    quantity: str
    pinocchio: str
    shape: tuple[int, ...] = ()
    ours_vs_pinocchio: float | None = None
    ours_vs_truth: float | None = None
    pinocchio_vs_truth: float | None = None
    bound: float = DEFAULT_RTOL
    passed: bool = False
    singular: bool = False
    note: str = ""

    @property
    def error(self) -> float | None:
        """The error that decides: against the truth where that is known, else against Pinocchio."""
        return self.ours_vs_pinocchio if self.ours_vs_truth is None else self.ours_vs_truth


class HighLow(NamedTuple):
    """A right value as the sum of two doubles: 32 digits of it."""

    high: Array
    low: Array | float = 0.0


@dataclass(frozen=True)
class StateErrors:
    """The errors at one state, of every entry, in units of the scale; None where a side is missing."""

    ours_vs_pinocchio: Array | None
    ours_vs_truth: Array | None
    pinocchio_vs_truth: Array | None
    bound: float
    residual: float | None = None

    @property
    def decides(self) -> Array:
        """The truth decides; where it is not known, Pinocchio."""
        errors = self.ours_vs_pinocchio if self.ours_vs_truth is None else self.ours_vs_truth
        return np.zeros(0) if errors is None else errors

    @property
    def error(self) -> float:
        """The worst of the errors that decide."""
        return float(self.decides.max(initial=0))

    @property
    def closeness(self) -> float:
        """The deciding error in units of the bound. A NaN is infinitely far off."""
        worst = np.max([self.error / self.bound, (self.residual or 0.0) / TERM_RTOL])
        return float(np.inf if np.isnan(worst) else worst)

    def place(self, state: int) -> str:
        """Return in words where the worst entry is."""
        entry = np.unravel_index(np.argmax(self.decides), self.decides.shape)
        return f"worst at state {state}, entry {tuple(int(k) for k in entry)}"


@dataclass(frozen=True)
class Judge:
    """Reference values of a quantity, and the states at which it is compared.

    Attributes
    ----------
    model : Model
    states : States
    oracle : Oracle or None
        Pinocchio.
    context : mpmath context or None
        In whose numbers the truth is computed.
    truths : int
        At how many of the states it is computed in any case. It is computed as well wherever ours and
        Pinocchio differ by more than the bound, to see who is right.
    """

    model: Model
    states: States
    oracle: Oracle | None
    context: Any
    truths: int

    def row(self, quantity: ComparedQuantity) -> Comparison:
        """Measure one quantity."""
        row = Comparison(quantity.section, quantity.name, quantity.pinocchio)
        try:
            ours = quantity.ours(self.model, self.states)
        except SingularError as error:
            exact = (self.states[i].exact(self.context) for i in range(len(self.states)))
            passed = quantity.is_singular(self.model, exact, str(error))
            return replace(row, passed=passed, singular=True, note=self._named(str(error)))
        except Exception as error:  # show the other rows all the same
            return replace(row, note=f"{type(error).__name__}: {error}")
        row = replace(row, shape=ours.shape[1:])
        try:
            return _sum_up(row, [self._at(quantity, i, x) for i, x in enumerate(ours)])
        except SingularError as error:
            return replace(row, note=f"ours gives numbers where the quantity does not exist: {error}")
        except ShapeError as error:
            return replace(row, note=str(error))

    def _named(self, message: str) -> str:
        """Shorten the message of a SingularError that names many joints."""
        names = [repr(name) for name in self.model.joint_names if repr(name) in message]
        if not names:
            return "singular: " + shorten(message.partition(": (")[0], 90, placeholder=" …")
        more = f" and {len(names) - 4} more" if len(names) > 4 else ""
        return f"singular: {len(names)} joint{'s' * (len(names) > 1)}: {', '.join(names[:4])}{more}"

    def _at(self, quantity: ComparedQuantity, i: int, x: Array) -> StateErrors:
        s = self.states[i]
        theirs = None if self.oracle is None else HighLow(quantity.theirs(self.oracle, s))
        truth = self._truth(quantity, s) if theirs is None or i < self.truths else None
        at = self._compare(quantity, s, x, theirs, truth)
        if truth is None and at.closeness > 1:
            truth = self._truth(quantity, s)  # who is right?
            at = self._compare(quantity, s, x, theirs, truth)
        if quantity.residual is not None and DEFAULT_RTOL < at.error <= at.bound:
            s = replace(s, a=x)
            at = replace(at, residual=quantity.residual(self.model, s, s.exact(self.context)))
        return at

    def _truth(self, quantity: ComparedQuantity, s: States) -> HighLow | None:
        if self.context is None:
            return None
        y = quantity.truth(self.model, s.exact(self.context))
        high = y.astype(np.float64)
        return HighLow(high, np.asarray(y - high, np.float64))

    def _compare(
        self, quantity: ComparedQuantity, s: States, x: Array, theirs: HighLow | None, truth: HighLow | None
    ) -> StateErrors:
        right = theirs if truth is None else truth
        if right is None:
            raise ValueError("nothing to compare with: neither Pinocchio nor mpmath is there")
        if x.shape != right.high.shape:
            raise ShapeError(f"ours has shape {x.shape}, expected {right.high.shape}")
        scale = np.abs(right.high).max(initial=0)
        bound = DEFAULT_RTOL
        if quantity.terms is not None:
            scale = max(scale, CANCELLED_SHARE * quantity.terms(self.model, s))
        if quantity.bound is not None:
            bound = max(bound, quantity.bound(self.model, s, right.high))
        return StateErrors(
            ours_vs_pinocchio=_errors(x, theirs, scale),
            ours_vs_truth=_errors(x, truth, scale),
            pinocchio_vs_truth=None if theirs is None else _errors(theirs.high, truth, scale),
            bound=bound,
        )


def _errors(x: Array, right: HighLow | None, scale: float) -> Array | None:
    """Return the relative error of each entry. Where the scale is zero, so is the right value, to the last bit."""
    if right is None:
        return None
    off = np.abs(x - right.high - right.low)
    return np.asarray(off / scale if scale else np.where(off == 0, 0.0, np.inf))


def _sum_up(row: Comparison, states: Sequence[StateErrors]) -> Comparison:
    """Take the worst of the states."""
    known = [i for i, at in enumerate(states) if at.ours_vs_truth is not None] or range(len(states))
    worst = max(known, key=lambda i: states[i].closeness)
    constant = all(at.bound == DEFAULT_RTOL for at in states)
    seen = states if constant else [states[worst]]
    row = replace(
        row,
        ours_vs_pinocchio=_worst(at.ours_vs_pinocchio for at in seen),
        ours_vs_truth=_worst(at.ours_vs_truth for at in seen),
        pinocchio_vs_truth=_worst(at.pinocchio_vs_truth for at in seen),
        bound=states[worst].bound,
        passed=all(at.closeness <= 1 for at in states),
    )
    return replace(row, note=_remark(states) if row.passed else states[worst].place(worst))


def _worst(errors: Iterable[Array | None]) -> float | None:
    """Return the largest error; NaN if there is one."""
    known = [e.max(initial=0) for e in errors if e is not None]
    return float(np.max(known)) if known else None


def _remark(states: Sequence[StateErrors]) -> str:
    """Return notes on where rounding rules out 1e-12, and where ours is right and Pinocchio is not."""
    above = [at for at in states if at.residual is not None]
    theirs = _worst(at.pinocchio_vs_truth for at in states) or 0.0
    if above:
        worst = max(above, key=lambda at: at.error)
        return (
            f"error {worst.error:.1e} at {len(above)} of {len(states)} states, M is so nearly singular that rounding "
            f"may cost {worst.bound:.1e}; the equation is met to {worst.residual:.1e} of its terms"
        )
    if np.isnan(theirs):
        return "Pinocchio gives NaN"
    return f"Pinocchio is {theirs:.1e} off the truth" if theirs > max(at.bound for at in states) else ""

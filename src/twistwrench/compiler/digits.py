"""Programs of 32 digits in pairs of doubles, and programs whose results have a bound.

They hold a program in doubles, which knows the arguments and raises the errors, and run its line in other numbers.
"""

from __future__ import annotations

from collections import Counter
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import ShapeError
from .backend import BackEnd
from .bounds import OWN
from .double_double import BOUND, LO, double_double
from .llvm import NATIVE
from .pairs import two_sum
from .program import Program
from .recording import ALARM
from .wide import WIDE, DigitsProgram, WideProgram

__all__ = ["NUMBERS", "BoundedProgram", "DoubleDouble", "DoubleDoubleProgram", "with_digits"]

PAIRS = "double-double"
NUMBERS = (PAIRS, *WIDE)
"""Number types that are not NumPy's, by name."""

DOUBLE = np.dtype(np.float64)


class DoubleDouble(NamedTuple):
    """Numbers of 32 digits: hi + lo, where hi is the double nearest to the sum.

    Attributes
    ----------
    hi, lo : ndarray
        Of the same shape.

    Examples
    --------
    >>> third = DoubleDouble(np.array(1 / 3), np.array(2.0**-54 / 3))  # 1/3 to 32 digits
    """

    hi: Array
    lo: Array


class DoubleDoubleProgram(DigitsProgram):
    """A program with 32 digits: what `twistwrench.compile` returns with ``dtype="double-double"``.

    Parameters
    ----------
    program : Program
        The same in doubles.
    bound : bool
        Whether each result has a bound.
    """

    def __init__(self, program: Program, *, bound: bool = False) -> None:
        super().__init__(program)
        self.bound = bound
        self._codes: dict[Any, BackEnd] = {}

    @property
    def operations(self) -> Counter[str]:
        """How many operations on doubles one state takes, by kind."""
        return self.of(self.program._plain, ()).line.operations

    def of(self, names: tuple[str, ...], low: tuple[str, ...]) -> BackEnd:
        """Return what runs the line for states with these arguments, of which some are pairs; rewritten once."""
        if (names, low) not in self._codes:
            line, backend = self.program._line(names), self.program.backend
            pairs = double_double(line, low=low, plain=(ALARM,), fma=backend == "llvm", bound=self.bound)
            self._codes[names, low] = BackEnd(pairs, DOUBLE, backend)
        return self._codes[names, low]

    def __call__(self, *args: ArrayLike | DoubleDouble | None, **named: ArrayLike | DoubleDouble | None) -> Any:
        """Return the quantities in a state, or in many.

        Parameters
        ----------
        *args, **named : array_like or DoubleDouble
            As for `Program`.

        Returns
        -------
        DoubleDouble, or Results of them
            With a bound: that, and an array or Results with the bound of each entry, infinite where none is certain.

        Raises
        ------
        ShapeError, SingularError, TypeError, ValueError
            As `Program`; also for angles above 2⁴⁵ rad.
        """
        given = self.program._bound(args, named)
        pairs = {name: _as_pair(name, x) for name, x in given.items() if isinstance(x, DoubleDouble)}
        states = self.program._arrays({name: pairs[name].hi if name in pairs else x for name, x in given.items()})
        high = dict(zip(given, states))
        batch = self.program.batch(high)
        low = {name + LO: np.broadcast_to(pair.lo, high[name].shape) for name, pair in pairs.items()}
        found = self.of(tuple(given), tuple(pairs)).results(high | low, batch, self.program.threads)
        self._check(high, found, "angles up to 2**45 rad, and sizes ")
        value = {symbol: DoubleDouble(found[symbol], found[symbol + LO]) for symbol in self._symbols}
        if not self.bound:
            return self._packed(value)
        certain = {symbol: _certain(found[symbol + BOUND]) for symbol in value}
        return self._packed(value), self._packed(certain)

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(DoubleDoubleProgram, bound=self.bound), (self.program,)

    def __repr__(self) -> str:
        return f"{self.program!r}"[:-1].replace("float64", "double-double") + ">"


class BoundedProgram(DigitsProgram):
    """A program whose results have a bound: what `twistwrench.compile` returns with ``bound=True``.

    The bound of an entry is its distance from the same entry with 32 digits, and what those are off at most by the
    running error bound (`bounds`). It is for the arguments as they are: numbers of the program's type, taken as exact.

    Parameters
    ----------
    program : Program
        In float32 or float64.
    """

    def __init__(self, program: Program) -> None:
        super().__init__(program)
        self.dtype = program.dtype
        self._reference = DoubleDoubleProgram(program, bound=True)

    @property
    def operations(self) -> Counter[str]:
        """How many operations one state takes, with its bound, by kind."""
        return self.program.operations + self._reference.operations

    def __call__(self, *args: ArrayLike | None, **named: ArrayLike | None) -> tuple[Any, Any]:
        """Return the quantities in a state, or in many, and how far each entry can be off.

        Parameters
        ----------
        *args, **named : array_like
            As for `Program`.

        Returns
        -------
        value : ndarray or Results
        bound : ndarray or Results
            Of the same shape and number type; infinite where nothing is certain.

        Raises
        ------
        ShapeError, SingularError, TypeError, ValueError
            As `Program`.
        """
        given = self.program._bound(args, named)
        states = dict(zip(given, self.program._arrays(given)))
        value = self.program(**states)
        batch = self.program.batch(states)
        wide = {name: x.astype(DOUBLE) for name, x in states.items()}
        found = self._reference.of(tuple(given), ()).results(wide, batch, self.program.threads)
        bound = {}
        for symbol in self._symbols:
            own = (value if self.program.single else getattr(value, symbol)).astype(DOUBLE)
            off = np.abs((own - found[symbol]) - found[symbol + LO])
            bound[symbol] = np.nextafter(
                _certain(off + found[symbol + BOUND]).astype(self.dtype), self.dtype.type("inf")
            )
        return value, self._packed(bound)

    def __reduce__(self) -> tuple[Any, ...]:
        return BoundedProgram, (self.program,)

    def __repr__(self) -> str:
        return f"{self.program!r}"[:-1] + ", bound>"


def with_digits(program: Program, number: str | None, *, bound: bool) -> Program | DigitsProgram:
    """Return a program as it is, or in other numbers than NumPy's ("double-double", "quad", "mpmath"), or with a bound.

    Raises
    ------
    ImportError
        If the package of the number type is not installed.
    TypeError
        If there is no bound for it.
    """
    if number == PAIRS:
        return DoubleDoubleProgram(program, bound=bound)
    if bound and (number or program.dtype not in NATIVE):
        raise TypeError(f'bound: expected dtype float32, float64 or "double-double", got {number or program.dtype}')
    if number:
        return WideProgram(program, number)
    return BoundedProgram(program) if bound else program


def _as_pair(name: str, x: DoubleDouble) -> DoubleDouble:
    """Return a pair whose first number is the double nearest to the sum."""
    hi, lo = (np.asarray(part, DOUBLE) for part in x)
    if hi.shape != lo.shape:
        raise ShapeError(f"{name}: expected hi and lo of the same shape, got {hi.shape} and {lo.shape}")
    if not (np.isfinite(hi).all() and np.isfinite(lo).all()):
        raise ValueError(f"{name}: expected finite numbers")
    return DoubleDouble(*two_sum(hi, lo))


def _certain(bound: Array) -> Array:
    """Return a bound with its own roundings; infinite where it is not a number."""
    return np.where(np.isnan(bound), np.inf, bound * float(OWN))

"""Programs of 32 digits in pairs of doubles, and programs whose results have a bound.

They hold a program in doubles, which knows the arguments and raises the errors, and run its line in other numbers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import ShapeError
from .backend import BackEnd
from .double_double import BOUND, LO, OWN, double_double
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
VALUE = ".value"


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

    The results are `DoubleDouble`, for angles up to 2⁴⁵ rad. With a bound the program returns two: the second is an
    array, or Results, with the bound of each entry, infinite where none is certain.

    Parameters
    ----------
    program : Program
        The same in doubles.
    bound : bool
        Whether each result has a bound.
    """

    expected = "angles up to 2**45 rad, and " + DigitsProgram.expected

    def __init__(self, program: Program, *, bound: bool = False) -> None:
        super().__init__(program)
        self.bound = bound

    @property
    def operations(self) -> Counter[str]:
        """How many operations on doubles one state takes, by kind."""
        return self._code(self.program._plain, ()).line.operations

    def _code(self, names: tuple[str, ...], low: tuple[str, ...]) -> BackEnd:
        """Return what runs the line for states with these arguments, of which some are pairs; rewritten once."""
        if (names, low) not in self._codes:
            line, backend = self.program._line(names), self.program.backend
            pairs = double_double(line, low=low, plain=(ALARM,), fma=backend == "llvm", bound=self.bound)
            self._codes[names, low] = BackEnd(pairs, DOUBLE, backend)
        return self._codes[names, low]

    def _own(self, name: str, x: Any) -> tuple[Array, Array] | None:
        """Return the lower part, and the double nearest to the sum."""
        if not isinstance(x, DoubleDouble):
            return None
        hi, lo = (np.asarray(part, DOUBLE) for part in x)
        if hi.shape != lo.shape:
            raise ShapeError(f"{name}: expected hi and lo of the same shape, got {hi.shape} and {lo.shape}")
        if not (np.isfinite(hi).all() and np.isfinite(lo).all()):
            raise ValueError(f"{name}: expected finite numbers")
        hi, lo = two_sum(hi, lo)
        return lo, hi

    def _run(self, states: Mapping[str, Array], own: Mapping[str, Array]) -> dict[str, Array]:
        low = {name + LO: np.broadcast_to(lo, states[name].shape) for name, lo in own.items()}
        code = self._code(tuple(states), tuple(own))
        return code.results({**states, **low}, self.program.batch(states), self.program.threads)

    def _result(self, found: Mapping[str, Array], symbol: str) -> Any:
        value = DoubleDouble(found[symbol], found[symbol + LO])
        return (value, _certain(found[symbol + BOUND])) if self.bound else value

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(DoubleDoubleProgram, bound=self.bound), (self.program,)

    def __repr__(self) -> str:
        return f"{self.program!r}"[:-1].replace("float64", "double-double") + ">"


class BoundedProgram(DigitsProgram):
    """A program whose results have a bound: what `twistwrench.compile` returns with ``bound=True``.

    The bound of an entry is its distance from the same entry with 32 digits, and what those are off at most by the
    running error bound (`double_double`). It is for the arguments as they are: numbers of the program's type, taken as
    exact.

    Parameters
    ----------
    program : Program
        In float32 or float64.
    """

    bound = True

    def __init__(self, program: Program) -> None:
        super().__init__(program)
        self.dtype = program.dtype
        self._reference = DoubleDoubleProgram(program, bound=True)

    @property
    def operations(self) -> Counter[str]:
        """How many operations one state takes, with its bound, by kind."""
        return self.program.operations + self._reference.operations

    def _own(self, name: str, x: Any) -> None:
        return None

    def _run(self, states: Mapping[str, Array], own: Mapping[str, Any]) -> dict[str, Any]:
        value = self.program(**states)
        found = self._reference._run({name: x.astype(DOUBLE) for name, x in states.items()}, own)
        del found[ALARM]  # the program has heard it
        return found | {VALUE: {self._symbols[0]: value} if self.program.single else vars(value)}

    def _result(self, found: Mapping[str, Any], symbol: str) -> tuple[Array, Array]:
        value = found[VALUE][symbol]
        off = np.abs((value.astype(DOUBLE) - found[symbol]) - found[symbol + LO])
        bound = _certain(off + found[symbol + BOUND]).astype(self.dtype)
        return value, np.nextafter(bound, self.dtype.type("inf"))

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


def _certain(bound: Array) -> Array:
    """Return a bound with its own roundings; infinite where it is not a number."""
    return np.where(np.isnan(bound), np.inf, bound * float(OWN))

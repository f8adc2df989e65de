"""Programs of 32 digits in pairs of doubles, and programs whose results have a bound.

They hold a program in doubles, which knows the arguments and raises the errors, and run its line in other numbers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import partial
from math import prod
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import ShapeError
from .backend import divided
from .bounds import OWN
from .double_double import BOUND, LO, double_double
from .line import Line
from .llvm import NATIVE, MachineCode, lanes
from .pairs import two_sum
from .program import Program
from .recording import ALARM
from .registers import Registers
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


class Pairwise:
    """A line with pairs of doubles, in LLVM or in NumPy.

    Parameters
    ----------
    line : Line
    low : sequence of str
        The arguments that are pairs.
    backend : {"llvm", "numpy"}
    threads : int
    bound : bool
        Whether there is a bound of each result.
    """

    def __init__(self, line: Line, low: Sequence[str], *, backend: str, threads: int, bound: bool) -> None:
        self.native, self.threads = backend == "llvm", threads
        self.line = double_double(line, low=low, plain=(ALARM,), fma=self.native, bound=bound)
        self._codes: dict[int, Any] = {}

    def run(self, states: Mapping[str, Array], batch: tuple[int, ...]) -> dict[str, Array]:
        """Return the results, the parts of pairs by the names of `double_double`."""
        count = prod(batch)
        shapes = self.line.inputs.items()
        given = [np.ascontiguousarray(states[name].reshape(count, prod(shape))) for name, shape in shapes]
        results = {name: np.empty((count, len(entries))) for name, (_, entries) in self.line.outputs.items()}
        if count:
            self._run([*given, *results.values()], count)
        return {name: results[name].reshape(batch + shape) for name, (shape, _) in self.line.outputs.items()}

    def _run(self, arrays: Sequence[Array], count: int) -> None:
        width = lanes(DOUBLE) if self.native else 1
        divided(self._code(width if count >= width else 1).run, arrays, self.threads)

    def _code(self, width: int) -> Any:
        if width not in self._codes:
            native = MachineCode(self.line, DOUBLE, width) if self.native else Registers(self.line, DOUBLE)
            self._codes[width] = native
        return self._codes[width]


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
        self._pairwise: dict[Any, Pairwise] = {}

    @property
    def operations(self) -> Counter[str]:
        """How many operations on doubles one state takes, by kind."""
        return self.of(self.program._plain, ()).line.operations

    def of(self, names: tuple[str, ...], low: tuple[str, ...]) -> Pairwise:
        """Return the line for states with these arguments, rewritten once."""
        key = names, low
        if key not in self._pairwise:
            line, program = self.program._line(names), self.program
            self._pairwise[key] = Pairwise(
                line, low, backend=program.backend, threads=program.threads, bound=self.bound
            )
        return self._pairwise[key]

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
        found = self.of(tuple(given), tuple(pairs)).run(high | low, batch)
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
        found = self._reference.of(tuple(given), ()).run(wide, batch)
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

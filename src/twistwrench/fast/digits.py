"""Programs in numbers that no processor has, and programs whose results have a bound.

They hold a program, which knows the arguments and raises the errors, and run its line in other numbers.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

import numpy as np

from straightline.backend import BackEnd
from straightline.double_double import BOUND, LO, OWN, DoubleDouble, double_double
from straightline.line import Line
from straightline.llvm import NATIVE
from straightline.pairs import two_sum
from straightline.running import with_running_bound

from ..arrays import Array
from ..errors import ShapeError, SingularError
from ..newton_euler_3d import as_mpmath
from .program import Program
from .quantity import by_the_textbook, shapes
from .recording import ALARM

__all__ = ["NUMBERS", "RUNNING", "WIDE", "DigitsProgram", "wide_type", "with_digits"]

PAIRS = "double-double"
WIDE = {"quad": ("numpy_quaddtype", 'pip install "twistwrench[quad]"'), "mpmath": ("mpmath", "pip install mpmath")}
"""Number types of other packages: the package, and what installs it."""

NUMBERS = (PAIRS, *WIDE)  # number types that are not NumPy's, by name

RUNNING = "running"  # the bound that is carried along in the program's own numbers

DOUBLE = np.dtype(np.float64)
VALUE = ".value"


class DigitsProgram(ABC):
    """A program whose line is run in other numbers than its own, and which is called as that is."""

    number: str | None = None
    bound: bool | str = False
    expected = "sizes whose products are numbers"

    def __init__(self, program: Program) -> None:
        self.program, self.model, self.arguments = program, program.model, program.arguments
        self.source, self.c = program.source, program.c
        self._symbols = [quantity.symbol for quantity in program.quantities]
        self._codes: dict[Any, BackEnd] = {}

    @property
    def operations(self) -> Counter[str]:
        """How many operations a state takes, by kind."""
        return self.program.operations

    def __call__(self, *args: Any, **named: Any) -> Any:
        """Return the quantities in a state, or in many: as `Program`, in numbers of the program's type.

        The arguments are doubles, which are taken as exact, or numbers of that type. With a bound there are two
        results, of which the second has the bound of each entry, infinite where nothing is certain.
        """
        given = self.program._bound(args, named)
        own = {name: both for name, x in given.items() if (both := self._own(name, x)) is not None}
        rounded = {name: own[name][1] if name in own else x for name, x in given.items()}
        states = self.program._states(rounded)
        found = self._run(states, {name: wide for name, (wide, _) in own.items()})
        if ALARM in found:
            self._check(states, found)
        results = {symbol: self._result(found, symbol) for symbol in self._symbols}
        if not self.bound:
            return self.program.packed(results)
        return tuple(self.program.packed({symbol: both[k] for symbol, both in results.items()}) for k in (0, 1))

    @abstractmethod
    def _own(self, name: str, x: Any) -> tuple[Any, Array] | None:
        """Return numbers of more digits than a double has, and as doubles; None for others."""

    @abstractmethod
    def _run(self, states: Mapping[str, Array], own: Mapping[str, Any]) -> dict[str, Any]:
        """Return the results of the line."""

    def _result(self, found: Mapping[str, Any], symbol: str) -> Any:
        """Return one of them as the caller gets it, with its bound if there is one."""
        return found[symbol]

    def _line(self, names: tuple[str, ...]) -> Line:
        """Return the program's line for states with these arguments; raise SingularError if it divides by zero."""
        line = self.program._code(names).line
        if any(node[0] == "div" and line.nodes[node[2]] == ("const", 0) for node in line.nodes):
            raise SingularError(
                f"{', '.join(self._symbols)} of {self.model.name!r}: a pivot is zero in every state, as that of rows "
                "of J that depend on each other; what the textbook chooses there has no more digits than a double"
            )
        return line

    def _check(self, states: Mapping[str, Array], found: Mapping[str, Array]) -> None:
        """Let the textbook look at the states that raise the alarm: it raises what there is to raise."""
        unsure = ~(found[ALARM] <= 1)
        if unsure.any():
            looked_at = {symbol: np.empty(found[symbol].shape) for symbol in self._symbols}
            asked = {**self.program.given, **states}
            by_the_textbook(self.model, self.program.quantities, asked, looked_at, unsure)
            for quantity in self.program.quantities:
                if quantity.unique:
                    given = [name for name in quantity.arguments if name in asked]
                    quantity.unique(*(asked[name][unsure] if name in states else asked[name] for name in given))
        if not all(np.all(abs(found[symbol]) < np.inf) for symbol in self._symbols):
            raise ValueError(f"expected {self.expected}")

    def __reduce__(self) -> tuple[Any, ...]:
        return with_digits, (self.program, self.number, self.bound)

    def __repr__(self) -> str:
        text = repr(self.program).replace("float64", self.number or "float64")
        kind = "running bound" if self.bound == RUNNING else "bound"
        return f"{text[:-1]}, {kind}>" if self.bound else text


class WideProgram(DigitsProgram):
    """A program in numpy-quaddtype's numbers, 34 digits, or in mpmath's, ``mpmath.mp.dps`` digits as at the call.

    An axis that is oblique to its frame is a unit vector to 38 digits.
    """

    def __init__(self, program: Program, number: str) -> None:
        super().__init__(program)
        self.number, self.dtype = number, wide_type(number)

    def _own(self, name: str, x: Any) -> tuple[Array, Array] | None:
        try:
            array = np.asarray(x)
            if array.dtype not in (self.dtype, np.longdouble):
                return None
            own = self._wide(array)
            return own, own.astype(np.float64)
        except (TypeError, ValueError):  # complex numbers: the program in doubles raises
            return None

    def _wide(self, x: Array) -> Array:
        return as_mpmath(x) if self.dtype.hasobject and not x.dtype.hasobject else x.astype(self.dtype)

    def _run(self, states: Mapping[str, Array], own: Mapping[str, Array]) -> dict[str, Array]:
        """Return the results of the line; its constants have as many digits as mpmath now has."""
        key = tuple(states), import_module("mpmath").mp.prec if self.dtype.hasobject else None
        if key not in self._codes:
            self._codes[key] = BackEnd(self._line(tuple(states)), self.dtype, "numpy")
        filled = {name: self._wide(np.broadcast_to(own.get(name, x), x.shape)) for name, x in states.items()}
        return self._codes[key].results(filled, self.program.batch(states), self.program.threads, {})


def wide_type(number: Any) -> np.dtype[Any]:
    """Return NumPy's type for quadruple precision, or for objects, which mpmath's numbers are."""
    package, install = WIDE[number]
    try:
        module = import_module(package)
    except ImportError:
        raise ImportError(f'dtype: "{number}" needs {package.replace("_", "-")}: {install}') from None
    found: np.dtype[Any] = np.dtype(object) if number == "mpmath" else module.QuadPrecDType()
    return found


class DoubleDoubleProgram(DigitsProgram):
    """A program with 32 digits, for angles up to 2⁴⁵ rad: ``dtype="double-double"``; its results are `DoubleDouble`."""

    number: str | None = PAIRS
    expected = "angles up to 2**45 rad, and " + DigitsProgram.expected

    def __init__(self, program: Program, bound: bool) -> None:
        super().__init__(program)
        self.bound = bound

    @property
    def operations(self) -> Counter[str]:
        """How many operations on doubles one state takes, by kind."""
        return self._code(self.program._plain, ()).line.operations

    def _code(self, names: tuple[str, ...], low: tuple[str, ...]) -> BackEnd:
        """Return what runs the line for states with these arguments, of which some are pairs; rewritten once."""
        if (names, low) not in self._codes:
            line, backend = self._line(names), self.program.backend
            pairs = double_double(line, low=low, plain=(ALARM,), fma=backend == "llvm", bound=bool(self.bound))
            self._codes[names, low] = BackEnd(pairs, DOUBLE, backend)
        return self._codes[names, low]

    def _own(self, name: str, x: Any) -> tuple[Array, Array] | None:
        """Return the lower part, and the double nearest to the sum."""
        if not isinstance(x, DoubleDouble):
            wide = _as_long_double(x)
            if wide is None:
                return None
            rounded = wide.astype(DOUBLE)
            x = DoubleDouble(rounded, wide - rounded)
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
        return code.results({**states, **low}, self.program.batch(states), self.program.threads, {})

    def _result(self, found: Mapping[str, Array], symbol: str) -> Any:
        value = DoubleDouble(found[symbol], found[symbol + LO])
        return (value, _certain(found[symbol + BOUND])) if self.bound else value


class BoundedProgram(DoubleDoubleProgram):
    """A program in float32 or float64 whose results have a bound: ``bound=True``.

    The bound of an entry is its distance from the same entry with 32 digits, and what those are off at most by the
    running error bound (`double_double`).
    """

    number = None

    def __init__(self, program: Program) -> None:
        super().__init__(program, True)
        self.dtype = program.dtype

    @property
    def operations(self) -> Counter[str]:
        """How many operations one state takes, with its bound, by kind."""
        return self.program.operations + super().operations

    def _own(self, name: str, x: Any) -> None:
        return None

    def _run(self, states: Mapping[str, Array], own: Mapping[str, Any]) -> dict[str, Any]:
        value = self.program(**states)
        found = super()._run({name: x.astype(DOUBLE) for name, x in states.items()}, own)
        del found[ALARM]  # the program has heard it
        return found | {VALUE: {self._symbols[0]: value} if self.program.single else vars(value)}

    def _result(self, found: Mapping[str, Any], symbol: str) -> tuple[Array, Array]:
        value = found[VALUE][symbol]
        off = np.abs((value.astype(DOUBLE) - found[symbol]) - found[symbol + LO])
        bound = _certain(off + found[symbol + BOUND]).astype(self.dtype)
        return value, np.nextafter(bound, self.dtype.type("inf"))


class RunningProgram(DigitsProgram):
    """A program in float32 or float64 that carries a bound along beside each number: ``bound="running"``.

    See `straightline.running`. States of which that knows nothing, and those that the program leaves to the textbook,
    have the bounds of `BoundedProgram`.
    """

    bound = RUNNING

    def __init__(self, program: Program) -> None:
        super().__init__(program)
        self.dtype, self.closer = program.dtype, BoundedProgram(program)
        self._one_state: Callable[..., Any] | None = None
        self._of_one = [shapes(self.model)[name] for name in program._plain]

    @property
    def operations(self) -> Counter[str]:
        """How many operations one state takes, with its bound, by kind."""
        return self._code(self.program._plain).line.without(ALARM).operations

    def __call__(self, *args: Any, **named: Any) -> Any:
        """Return the quantities, and the bound of each entry."""
        if not named and [getattr(x, "shape", None) for x in args] == self._of_one:
            if self._one_state is None:
                self._one_state = self._code(self.program._plain).one_state(False)
            found = self._one_state(*args) if self._one_state else None
            if found is not None:
                return tuple(self.program.packed(dict(zip(self._symbols, found[k::2]))) for k in (0, 1))
        return super().__call__(*args, **named)

    def _code(self, names: tuple[str, ...]) -> BackEnd:
        """Return what runs the line with its bounds for states with these arguments; rewritten once."""
        if names not in self._codes:
            line, backend = self._line(names), self.program.backend
            running = with_running_bound(line, self.dtype, alarm=ALARM, fma=backend == "llvm")
            self._codes[names] = BackEnd(running, self.dtype, backend)
        return self._codes[names]

    def _own(self, name: str, x: Any) -> None:
        return None

    def _run(self, states: Mapping[str, Array], own: Mapping[str, Any]) -> dict[str, Array]:
        return self._code(tuple(states)).results(states, self.program.batch(states), self.program.threads)

    def _check(self, states: Mapping[str, Array], found: Mapping[str, Array]) -> None:
        """Let the textbook look at the states that raise the alarm, and fill in what it finds, with closer bounds."""
        unsure = ~(found[ALARM] <= 1)
        if not unsure.any():
            return
        asked = {**self.program.given, **states}
        by_the_textbook(self.model, self.program.quantities, asked, found, unsure)
        both = self.closer(**{name: x[unsure] for name, x in states.items()})
        for ending, part in zip(("", BOUND), both, strict=True):
            values = {self._symbols[0]: part} if self.program.single else vars(part)
            for symbol, x in values.items():
                found[symbol + ending][unsure] = x

    def _result(self, found: Mapping[str, Array], symbol: str) -> tuple[Array, Array]:
        return found[symbol], found[symbol + BOUND]


def with_digits(program: Program, number: str | None, bound: bool | str) -> Program | DigitsProgram:
    """Return a program as it is, or in numbers that are not NumPy's ("double-double", …), or with a bound."""
    if number == PAIRS and bound != RUNNING:
        return DoubleDoubleProgram(program, bool(bound))
    if bound and (number or program.dtype not in NATIVE):
        held = "float32 or float64" if bound == RUNNING else 'float32, float64 or "double-double"'
        raise TypeError(f"bound: expected dtype {held}, got {number or program.dtype}")
    if number:
        return WideProgram(program, number)
    if bound == RUNNING:
        return RunningProgram(program)
    return BoundedProgram(program) if bound else program


def _as_long_double(x: Any) -> Array | None:
    """Return long doubles as an array; None for all other numbers, and for what is no array of numbers."""
    try:
        array = np.asarray(x)
    except (TypeError, ValueError):
        return None
    return array if array.dtype == np.longdouble else None


def _certain(bound: Array) -> Array:
    """Return a bound with its own roundings; infinite where it is not a number."""
    return np.where(np.isnan(bound), np.inf, bound * float(OWN))

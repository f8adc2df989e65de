"""Programs in numbers that no processor has: quadruple precision, and as many digits of mpmath as are set.

They hold a program in doubles, which knows the arguments and raises the errors, and run its line in other numbers.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Mapping
from importlib import import_module
from typing import Any

import numpy as np

from ..arrays import Array
from ..newton_euler_3d import as_mpmath
from .backend import BackEnd
from .memory import Results
from .program import Program
from .recording import ALARM
from .textbook import by_the_textbook

__all__ = ["WIDE", "DigitsProgram", "WideProgram", "wide_type"]

WIDE = {"quad": ("numpy_quaddtype", 'pip install "twistwrench[quad]"'), "mpmath": ("mpmath", "pip install mpmath")}
"""Number types of other packages: the package, and what installs it."""


class DigitsProgram(ABC):
    """A program whose line is run in other numbers than its own, and which is called as that is.

    Parameters
    ----------
    program : Program
        Knows the arguments, and the textbook that raises the errors.

    Attributes
    ----------
    model : Model
    arguments : tuple of str
        The names of the program's arguments, in their order.
    source, c : callable
        The texts of the straight line: see `Program`.
    """

    bound = False
    expected = "sizes whose products are numbers"

    def __init__(self, program: Program) -> None:
        self.program, self.model, self.arguments = program, program.model, program.arguments
        self.source, self.c = program.source, program.c
        self._codes: dict[Any, BackEnd] = {}

    @property
    def operations(self) -> Counter[str]:
        """How many operations a state takes, by kind."""
        return self.program.operations

    def __call__(self, *args: Any, **named: Any) -> Any:
        """Return the quantities in a state, or in many.

        Parameters
        ----------
        *args, **named : array_like
            As for `Program`: doubles, which are taken as exact, or numbers of the program's type.

        Returns
        -------
        array or Results
            In numbers of the program's type; with a bound two of them, of which the second has the bound of each entry,
            infinite where nothing is certain.

        Raises
        ------
        ShapeError, SingularError, TypeError, ValueError
            As `Program`.
        """
        given = self.program._bound(args, named)
        own = {name: both for name, x in given.items() if (both := self._own(name, x)) is not None}
        rounded = {name: own[name][1] if name in own else x for name, x in given.items()}
        states = dict(zip(given, self.program._arrays(rounded)))
        found = self._run(states, {name: wide for name, (wide, _) in own.items()})
        if ALARM in found:
            self._check(states, found)
        results = {symbol: self._result(found, symbol) for symbol in self._symbols}
        if not self.bound:
            return self._packed(results)
        return tuple(self._packed({symbol: both[k] for symbol, both in results.items()}) for k in (0, 1))

    @abstractmethod
    def _own(self, name: str, x: Any) -> tuple[Any, Array] | None:
        """Return numbers of more digits than a double has, and as doubles; None for others."""

    @abstractmethod
    def _run(self, states: Mapping[str, Array], own: Mapping[str, Any]) -> dict[str, Array]:
        """Return the results of the line."""

    def _result(self, found: Mapping[str, Array], symbol: str) -> Any:
        """Return one of them as the caller gets it, with its bound if there is one."""
        return found[symbol]

    @property
    def _symbols(self) -> list[str]:
        return [quantity.symbol for quantity in self.program.quantities]

    def _packed(self, results: Mapping[str, Any]) -> Any:
        """Return one result as it is, several as `Results`."""
        return next(iter(results.values())) if self.program.single else Results(**results)

    def _check(self, states: Mapping[str, Array], found: Mapping[str, Array]) -> None:
        """Let the textbook look at the states that raise the alarm: it raises what there is to raise."""
        unsure = ~(found[ALARM] <= 1)
        if unsure.any():
            looked_at = {symbol: np.empty(found[symbol].shape) for symbol in self._symbols}
            asked = {**self.program.given, **states}
            by_the_textbook(self.model, self.program.quantities, asked, looked_at, unsure)
        if not all((abs(found[symbol]) < np.inf).all() for symbol in self._symbols):
            raise ValueError(f"expected {self.expected}")


class WideProgram(DigitsProgram):
    """A program in quadruple precision or in mpmath's numbers: ``dtype="quad"`` or ``"mpmath"``.

    The results are for "quad" of numpy-quaddtype's type, 34 digits; for "mpmath" of mpf, with ``mpmath.mp.dps`` digits
    as it is at the call. An axis that is oblique to its frame is a unit vector to 38 digits.

    Parameters
    ----------
    program : Program
        The same in doubles.
    number : {"quad", "mpmath"}

    Raises
    ------
    ImportError
        If the package of the number type is not installed.
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
            self._codes[key] = BackEnd(self.program._line(tuple(states)), self.dtype, "numpy")
        filled = {name: self._wide(np.broadcast_to(own.get(name, x), x.shape)) for name, x in states.items()}
        return self._codes[key].results(filled, self.program.batch(states), self.program.threads)

    def __reduce__(self) -> tuple[Any, ...]:
        return WideProgram, (self.program, self.number)

    def __repr__(self) -> str:
        return repr(self.program).replace("float64", self.number)


def wide_type(number: Any) -> np.dtype[Any]:
    """Return NumPy's type for quadruple precision, or for objects, which mpmath's numbers are.

    Raises
    ------
    ImportError
        If the package is not installed.
    """
    package, install = WIDE[number]
    try:
        module = import_module(package)
    except ImportError:
        raise ImportError(f'dtype: "{number}" needs {package.replace("_", "-")}: {install}') from None
    found: np.dtype[Any] = np.dtype(object) if number == "mpmath" else module.QuadPrecDType()
    return found

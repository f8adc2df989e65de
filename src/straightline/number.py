"""Numbers that only remember what was done to them: how a function becomes a straight line.

A function that is arithmetic runs as it stands if it is called with arrays of `Number`, and each + − × ÷, sin, cos,
sqrt and atan2 is written down instead of computed. Its loops are gone: what is left is one operation after the other,
in which

- what is multiplied by 0 is dropped, and so is a factor of 1 or an addition of 0;
- what occurs a second time is the first one again;
- signs go outward, −a · b = −(a · b), where a sum absorbs them; but a constant keeps its own, so that what is mirrored
  comes to the same operations.

A number cannot be asked how large it is. But `select` writes down a choice between two numbers: both are computed.

No rule changes a rounding: a line computes what the function computes, to the last bit but for signs of zero, the order
of a sum of two, and doublings.

>>> tape = Tape()
>>> x, y = tape.input("x"), tape.input("y")
>>> z = x * y + 0 * x - y * x * 1
>>> z
Fraction(0, 1)
"""

from __future__ import annotations

import gc
import operator
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from itertools import count
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

__all__ = ["ARITHMETIC", "Array", "Node", "Number", "Tape", "is_power_of_two", "numbers", "select", "without_garbage"]

Array = NDArray[Any]

Node = tuple[Any, ...]
"""An operation and its operands: (op, index, …) of earlier nodes; ("input", name) and ("const", Fraction)."""

ARITHMETIC: dict[str, Callable[..., Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": operator.truediv,
    "neg": operator.neg,
}

ZERO, ONE, TWO = Fraction(0), Fraction(1), Fraction(2)
EXACT = (Fraction, int)  # the types of constants


class Tape:
    """The operations so far, each once.

    Attributes
    ----------
    places : dict
        The index of each node: ``tape.places["add", a, b]`` enters a sum where it is new.
    factors : dict
        Of nodes that are a power of two times another one, the power and the other one.
    notes : list
        What `note` returned for each new operation, if it is given: see `source.Note`.
    """

    def __init__(self, note: Callable[[], Any] | None = None) -> None:
        self.note, self.notes = note, list[Any]()
        self.places = defaultdict[Node, int](self._noted if note else count().__next__)
        self.factors: dict[int, tuple[Fraction, int]] = {}
        self._constants: dict[tuple[int, int], int] = {}  # fractions take long to hash

    def _noted(self) -> int:
        self.notes.append(self.note and self.note())
        return len(self.places)

    @property
    def nodes(self) -> list[Node]:
        """All operations: operands come before what uses them."""
        return [*self.places]

    def input(self, name: Any) -> Number:
        """Return a number that is given when the program runs."""
        return Number(self, self.places["input", name])

    def number(self, x: Number | Fraction | float) -> Number:
        """Return a constant as a number of this tape."""
        return x if isinstance(x, Number) else Number(self, self.constant(Fraction(x)))

    def node(self, x: Number | Fraction | float) -> int:
        """Return the node of a number, where its sign is an operation, too."""
        x = self.number(x)
        if not x.minus:
            return x.index
        index = self.places["neg", x.index]
        if self.note:
            self.notes[index] = self.notes[x.index]
        return index

    def apply(self, operation: str, *operands: Number | Fraction | float) -> Number:
        """Return the result of an operation as it stands: no rule simplifies it."""
        return Number(self, self.places[operation, *map(self.node, operands)])

    def constant(self, c: Fraction) -> int:
        """Return the index of a constant."""
        ratio = c.as_integer_ratio()
        index = self._constants.get(ratio)
        if index is None:
            index = self._constants[ratio] = self.places["const", c]
        return index

    def scaled(self, c: Fraction, a: int) -> int:
        """Return the index of c a; powers of two, which round nothing, are put together."""
        power = is_power_of_two(c)
        if power and a in self.factors:
            factor, a = self.factors[a]
            c = c * factor
        if c.numerator == c.denominator:
            return a
        k = self.constant(c)
        index = self.places["mul", a, k] if a < k else self.places["mul", k, a]
        if power:
            self.factors[index] = c, a
        return index


class Number:
    """A number without a value: a node of the tape, or minus that. Constants are fractions."""

    __slots__ = ("index", "minus", "tape")

    def __init__(self, tape: Tape, index: int, minus: bool = False) -> None:
        self.tape, self.index, self.minus = tape, index, minus

    def __add__(self, other: Any) -> Any:
        tape, a, minus = self.tape, self.index, self.minus
        if type(other) is not Number:
            if not isinstance(other, EXACT):
                return NotImplemented  # NumPy takes an array entry by entry
            if not other:
                return self
            other = tape.number(other)
        b = other.index
        if minus == other.minus:
            if a == b:
                return Number(tape, tape.scaled(TWO, a), minus)
            return Number(tape, tape.places["add", a, b] if a < b else tape.places["add", b, a], minus)
        if a == b:
            return ZERO
        if minus:
            a, b = b, a
        opposite = tape.places.get(("sub", b, a))
        return Number(tape, tape.places["sub", a, b]) if opposite is None else Number(tape, opposite, True)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        return self + (Number(self.tape, other.index, not other.minus) if type(other) is Number else -other)

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        tape, a, minus = self.tape, self.index, self.minus
        if type(other) is Number:
            b = other.index
            return Number(tape, tape.places["mul", a, b] if a < b else tape.places["mul", b, a], minus != other.minus)
        if not isinstance(other, EXACT):
            return NotImplemented
        if not other:
            return ZERO
        c = other if type(other) is Fraction else Fraction(other)
        if c.numerator < 0 and is_power_of_two(-c):
            minus, c = not minus, -c
        return Number(tape, tape.scaled(c, a), minus)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if type(other) is not Number:
            if not isinstance(other, EXACT):
                return NotImplemented
            if is_power_of_two(abs(Fraction(other))):
                return self * (1 / Fraction(other))
            other = self.tape.number(other)
        minus = self.minus != other.minus
        if self.index == other.index:
            return -ONE if minus else ONE
        return Number(self.tape, self.tape.places["div", self.index, other.index], minus)

    def __rtruediv__(self, other: Any) -> Any:
        if not isinstance(other, EXACT):
            return NotImplemented
        return self.tape.number(other) / self if other else ZERO

    def __neg__(self) -> Number:
        return Number(self.tape, self.index, not self.minus)

    def sin(self) -> Number:
        """Return the sine, −sin x for −x."""
        return Number(self.tape, self.tape.places["sin", self.index], self.minus)

    def cos(self) -> Number:
        """Return the cosine, the same for −x."""
        return Number(self.tape, self.tape.places["cos", self.index])

    def sqrt(self) -> Number:
        """Return the square root."""
        return self.tape.apply("sqrt", self)

    def arctan2(self, other: Any) -> Number:
        """Return the angle of the point (other, self), from −π to π; it is not a number at (0, 0)."""
        return self.tape.apply("atan2", self, other)

    def select(self, a: Any, b: Any) -> Any:
        """Return a where this is above 0, b elsewhere: see `select`."""
        return select(self, a, b)

    def _has_no_value(self, *others: Any) -> NoReturn:
        compare = f" to compare with {others[0]!r}" if others else ""
        raise TypeError(f"a recorded number has no value{compare}: a straight line is the same for every state")

    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = __bool__ = __abs__ = _has_no_value
    __float__ = __int__ = __index__ = __complex__ = _has_no_value
    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"<Number {'-' * self.minus}{self.index}: {self.tape.nodes[self.index]}>"


def select(x: Any, a: Any, b: Any) -> Any:
    """Return a where x > 0, b elsewhere, of numbers and constants.

    What is not chosen may be infinite or not a number. But plain Python stops at a quotient by 0 and at the root of a
    negative number, wherever they are: a formula should be given a harmless number where it is not chosen.

    >>> x = Tape().input("x")
    >>> select(x, 1, x), select(ONE, x, 2 * x) is x
    (<Number 2: ('select', 0, 1, 0)>, True)
    """
    if not isinstance(x, Number):
        return a if x > 0 else b
    return x.tape.apply("select", x, a, b)


def is_power_of_two(c: Fraction) -> bool:
    """Return whether a constant is a power of two: a product with it rounds nothing."""
    n, d = c.as_integer_ratio()
    return n > 0 and n & (n - 1) == 0 and d & (d - 1) == 0


def numbers(tape: Tape, name: str, *shape: int) -> Array:
    """Return an array of inputs of this shape; the input's name is (name, index)."""
    x = np.empty(shape, object)
    for k in np.ndindex(shape):
        x[k] = tape.input((name, *k))
    return x


@contextmanager
def without_garbage() -> Iterator[None]:
    """Let Python not look for garbage among thousands of operations, again and again: a fifth of the time."""
    before = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if before:
            gc.enable()

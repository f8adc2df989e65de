"""Numbers that only remember what was done to them: how a recursion becomes a straight line (49.6 to 49.10).

The algorithms of this package are arithmetic. Called with arrays of `Number` in the place of q and v, they run as they
stand, and each + − × ÷, sin, cos and sqrt is written down instead of computed. Once the tree is known the loops are
gone: what is left is one line after the other, in which

- what is multiplied by 0 is dropped, and so is a factor of 1 or an addition of 0: most entries of S, of X and of the
  inertias are such;
- what occurs a second time is the first one again;
- signs go outward, −a · b = −(a · b), where a sum absorbs them; but a constant keeps its own, so that a left limb and a
  right one come to the same operations.

No rule changes a rounding: a program computes what the textbook computes, to the last bit but for signs of zero, the
order of a sum of two, and doublings.

>>> tape = Tape()
>>> x, y = tape.input("x"), tape.input("y")
>>> z = x * y + 0 * x - y * x * 1
>>> z
Fraction(0, 1)
"""

from __future__ import annotations

import gc
import operator
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from typing import Any, NoReturn

import numpy as np

from ..arrays import Array

__all__ = ["ARITHMETIC", "Node", "Number", "Tape", "is_power_of_two", "numbers", "without_garbage"]

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
    nodes : list of tuple
        See `Node`. Operands come before what uses them.
    note : callable, optional
        Called for each new operation; what it returns is in `notes`: see `source.step`.
    """

    def __init__(self, note: Callable[[], Any] | None = None) -> None:
        self.nodes: list[Node] = []
        self.note, self.notes = note, list[Any]()
        self.places: dict[Node, int] = {}
        self._constants: dict[tuple[int, int], int] = {}  # fractions take long to hash

    def input(self, name: Any) -> Number:
        """Return a number that is given when the program runs."""
        return Number(self, self.enter("input", name))

    def number(self, x: Number | Fraction | float) -> Number:
        """Return a constant as a number of this tape."""
        return x if isinstance(x, Number) else Number(self, self.constant(Fraction(x)))

    def node(self, x: Number | Fraction | float) -> int:
        """Return the node of a number, where its sign is an operation, too."""
        x = self.number(x)
        return self.enter("neg", x.index) if x.minus else x.index

    def apply(self, operation: str, *operands: Number | Fraction | float) -> Number:
        """Return the result of an operation as it stands: no rule simplifies it."""
        return Number(self, self.enter(operation, *map(self.node, operands)))

    def enter(self, *node: Any) -> int:
        """Return the index of an operation, which is entered where it is new."""
        index = self.places.get(node)
        if index is None:
            index = self.places[node] = len(self.nodes)
            self.nodes.append(node)
            if self.note is not None:
                self.notes.append(self.notes[node[1]] if node[0] == "neg" else self.note())
        return index

    def constant(self, c: Fraction) -> int:
        """Return the index of a constant."""
        ratio = c.as_integer_ratio()
        index = self._constants.get(ratio)
        if index is None:
            index = self._constants[ratio] = self.enter("const", c)
        return index

    def scaled(self, c: Fraction, a: int) -> int:
        """Return the index of c a; powers of two, which round nothing, are put together."""
        node = self.nodes[a]
        if node[0] == "mul" and is_power_of_two(c):
            for factor, rest in ((node[1], node[2]), (node[2], node[1])):
                if self.nodes[factor][0] == "const" and is_power_of_two(self.nodes[factor][1]):
                    return self.scaled(c * self.nodes[factor][1], rest)
        if c.numerator == c.denominator:
            return a
        k = self.constant(c)
        return self.enter("mul", a, k) if a < k else self.enter("mul", k, a)


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
            return Number(tape, tape.enter("add", a, b) if a < b else tape.enter("add", b, a), minus)
        if a == b:
            return ZERO
        if minus:
            a, b = b, a
        opposite = tape.places.get(("sub", b, a))
        return Number(tape, tape.enter("sub", a, b)) if opposite is None else Number(tape, opposite, True)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        return self + (Number(self.tape, other.index, not other.minus) if type(other) is Number else -other)

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        tape, a, minus = self.tape, self.index, self.minus
        if type(other) is Number:
            b = other.index
            return Number(tape, tape.enter("mul", a, b) if a < b else tape.enter("mul", b, a), minus != other.minus)
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
        return Number(self.tape, self.tape.enter("div", self.index, other.index), minus)

    def __rtruediv__(self, other: Any) -> Any:
        if not isinstance(other, EXACT):
            return NotImplemented
        return self.tape.number(other) / self if other else ZERO

    def __neg__(self) -> Number:
        return Number(self.tape, self.index, not self.minus)

    def sin(self) -> Number:
        """Return the sine, −sin x for −x."""
        return Number(self.tape, self.tape.enter("sin", self.index), self.minus)

    def cos(self) -> Number:
        """Return the cosine, the same for −x."""
        return Number(self.tape, self.tape.enter("cos", self.index))

    def sqrt(self) -> Number:
        """Return the square root."""
        return self.tape.apply("sqrt", self)

    def _has_no_value(self, *others: Any) -> NoReturn:
        compare = f" to compare with {others[0]!r}" if others else ""
        raise TypeError(f"a recorded number has no value{compare}: a straight line is the same for every state")

    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = __bool__ = __abs__ = _has_no_value
    __float__ = __int__ = __index__ = __complex__ = _has_no_value
    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"<Number {'-' * self.minus}{self.index}: {self.tape.nodes[self.index]}>"


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

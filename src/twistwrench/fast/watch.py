"""What a program watches while it runs: numbers whose squares add up to at most 1 for every ordinary state.

Each question that the textbook asks of a state, and of the pivots of the ABA, can be put as a number that is small
where all is well: an entry over the largest that is allowed, a norm's distance from 1 over the tolerance, the least
inertia that counts over the inertia of a joint. The sum of their squares is one more result of the program. Where it is
above 1, or not a number, the textbook takes the state: it names what is wrong, or finds that nothing is.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from straightline.number import Number, Tape

from ..arrays import Array, convert, resolution
from ..model import Model, Tree

__all__ = ["alarm", "pivots", "state_questions", "with_watch"]

LARGEST_ANGLE = 2.0**17  # rad. The sine of a program for vectors is good below; the textbook takes larger angles.
MIN_PIVOT_SHARE = 1e-6  # a joint with less than this share of its inertia with all joints locked is the textbook's, too


def alarm(tape: Tape, questions: list[Any]) -> Number:
    """Return the sum of the squares, added in pairs."""
    squares: list[Any] = [x * x for x in questions]
    while len(squares) > 1:
        squares = [sum(squares[k : k + 2], Fraction(0)) for k in range(0, len(squares), 2)]
    return tape.number(squares[0] if squares else Fraction(0))


def state_questions(model: Model, arguments: Mapping[str, Array], dtype: np.dtype[Any]) -> Iterator[Any]:
    """Yield what to watch of the arguments: sizes, norms, and a wrench on the world."""
    largest = min(int(np.finfo(dtype).maxexp), 1024)  # more than a double holds is left to the textbook
    for name, x in arguments.items():
        limit = Fraction(2) ** (largest // (4 if name.startswith("q") else 5))
        for k in np.ndindex(x.shape):
            yield x[k] / limit
    tolerance = Fraction(2) ** (int(np.frexp(float(resolution(dtype) ** 0.5))[1]) - 1)  # dividing by it rounds nothing
    for x in (x for name, x in arguments.items() if name.startswith("q")):
        for joint, s in zip(model.joints, model.q_slice):
            if joint is not None and joint.unit is not None:
                part = x[s][joint.unit]
                yield ((part * part).sum() - 1) / (2 * tolerance)


def pivots(model: Model, tree: Tree, D_inv: Sequence[Array], dtype: np.dtype[Any]) -> Iterator[Any]:
    """Yield for each degree of freedom the least inertia that counts times its entry of D⁻¹ (49.7, 49.8).

    The least one is a share of the inertia that the joint moves with all joints outboard of it locked, which is bounded
    by masses and distances alone: with `reach` between the origins of two bodies, moments of mass about one origin are
    at most m reach more about the other.
    """
    share = Fraction(max(MIN_PIVOT_SHARE, resolution(dtype) ** 0.5))
    mass = [convert(I.mass, object).item() for I in model.inertia]
    distance = [_length(convert(I.com, object)) for I in model.inertia]
    first = [m * d for m, d in zip(mass, distance)]
    second = [m * d * d + Fraction(float(np.trace(I.inertia_at_com))) for m, d, I in zip(mass, distance, model.inertia)]
    for i in tree.inward:
        p, S = tree.parent[i], tree.S[i]
        for k in range(S.shape[-1]):
            turn, slide = _length(S[:3, k]), _length(S[3:, k])
            locked = turn * turn * second[i] + 2 * turn * slide * first[i] + slide * slide * mass[i]
            yield share * (locked + tree.rotor[i][k, k]) * D_inv[i][k, k]
        if p:
            reach = _length(tree.placement[i].translation)
            second[p] = second[p] + second[i] + 2 * reach * first[i] + reach * reach * mass[i]
            first[p], mass[p] = first[p] + first[i] + reach * mass[i], mass[p] + mass[i]


def with_watch(J: Array, contacts: Iterable[object]) -> tuple[Array, list[Any]]:
    """Return the rows of contacts, and their entries to watch where they divide by a length.

    An entry is so small there that only what is not a number raises the alarm, or is too large for a robot.
    """
    divides = J.dtype == object and any(getattr(c, "divides", False) for c in contacts)
    return J, [x * Fraction(1, 2**40) for x in J.flat] if divides else []


def _length(x: Array) -> Any:
    """Return the length of a vector of constants or numbers."""
    square = sum(one * one for one in x)
    return square.sqrt() if isinstance(square, Number) else Fraction(float(square) ** 0.5)

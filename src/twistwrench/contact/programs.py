"""What contacts do to a motion as quantities of programs, and the derivatives of that (49.9).

A program is made of the elimination. Its derivatives are not those of its line, which would be several times as long:
what q̈ and λ leave of the two equations stays zero, whatever changes. So the change of what is left, at this q̈ and λ,
is the right side of the same equations for the change of q̈ and λ.

By floats, for the states that a program leaves to the textbook, the textbook's decomposition answers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple
from weakref import ref

import numpy as np

from straightline.number import Tape, numbers
from straightline.tangent import directions, jacobian

from ..algorithms.aba import aba_terms
from ..algorithms.crba import crba
from ..algorithms.rnea import rnea
from ..arrays import Array, convert
from ..errors import SingularError
from ..fast.derivatives import replay, steps
from ..fast.quantity import Quantity, shapes
from ..fast.watch import with_watch
from ..model import Model, tree_terms
from .decomposition import decompose
from .elimination import Elimination
from .rows import ContactRows, contact_rows, given_motion
from .types import Contact

__all__ = ["Equations", "Once", "Solution", "held_equations", "held_quantities", "hit_equations"]

Answer = Callable[..., tuple[Array, Array]]
"""From a state to q̈ and λ, or v⁺ and Λ, by the textbook: shapes (..., nv) and (..., m)."""


class Solution(NamedTuple):
    """What solves the equations in a state, what a program watches there; of numbers that remember, also how."""

    motion: Array
    force: Array
    watched: list[Any]
    equations: Elimination | None = None
    rows: Any = None


class Equations:
    """M (x − x₀) = Jᵀ λ and J x = a in a state, and the derivatives of x and λ.

    Parameters
    ----------
    model : Model
    contacts : sequence of Contact
    dtype : dtype
    arguments : tuple of str
        What x₀ depends on, q and v first.
    free : callable
        From the arguments to x₀.
    asked : callable
        From the rows of the contacts to a.
    left : callable
        From the rows, x, λ and the arguments to what is left of both equations, shape (nv + m,).
    textbook : callable, optional
        From the arguments to x and λ, of numbers that a program leaves to it; None where it will not be asked.
    """

    def __init__(
        self,
        model: Model,
        contacts: Sequence[Contact],
        dtype: np.dtype[Any],
        arguments: tuple[str, ...],
        free: Callable[..., Array],
        asked: Callable[[ContactRows], Array],
        left: Callable[..., Array],
        textbook: Answer | None,
    ) -> None:
        self.model, self.contacts, self.dtype, self.arguments = model, contacts, dtype, arguments
        self.free, self.asked, self.left, self.textbook = free, asked, left, textbook
        self.solved = Once(self._solved)
        self.changed = {name: Once(partial(self._changed, name)) for name in arguments}

    def _solved(self, q: Array, v: Array, *others: Array) -> Solution:
        """Solve them in a state."""
        if q.dtype != object and self.textbook:
            return Solution(*self.textbook(q, v, *others), [])
        rows = contact_rows(self.model, q, v, self.contacts)
        equations = Elimination.of(tree_terms(self.model, q), rows.J)
        free = self.free(q, v, *others)
        change, force = equations.hold(self.asked(rows) - np.matvec(rows.J, free))
        watched = [*equations.watched(self.model, self.dtype), *with_watch(rows.J, self.contacts)[1]]
        return Solution(free + change, force, watched, equations, rows)

    def quantity(self, symbol: str, part: Callable[[Array, Array], Array]) -> Quantity:
        """Return a quantity: a part of x and λ."""

        def compute(*x: Array) -> tuple[Array, list[Any]]:
            solution = self.solved(*x)
            return part(solution.motion, solution.force), solution.watched

        def derivative(of: str) -> Callable[..., tuple[Array, list[Any]]]:
            def compute(*x: Array) -> tuple[Array, list[Any]]:
                return part(*self.changed[of](*x)), self.solved(*x).watched

            return compute

        def unique(*x: Array) -> None:
            self._independent_rows(x[0], np.zeros((*x[0].shape[:-1], self.model.nv)))

        return Quantity(symbol, self.arguments, compute, derivative, unique)

    def _changed(self, of: str, *x: Array) -> tuple[Array, Array]:
        """Return the derivatives of x and λ by an argument, shapes (..., nv, nv) and (..., m, nv)."""
        found: Solution = self.solved(*x)
        equations = found.equations
        if equations is None:
            equations = Elimination.of(tree_terms(self.model, x[0]), self._independent_rows(*x[:2]))
        known = dict(zip(self.arguments, x)) | {"a": found.motion, "lambda": found.force}
        left = self._left_changed(of, known)
        n = self.model.nv
        return equations.solve(-left[..., :n, :], -left[..., n:, :])

    def _left_changed(self, of: str, known: Mapping[str, Array]) -> Array:
        """Return the derivative of what is left of the equations by an argument, at this x and λ."""
        tape = Tape()
        sizes = shapes(self.model) | {"lambda": (sum(c.dim for c in self.contacts),)}
        x = {name: numbers(tape, name, *sizes[name]) for name in known}
        if "f_ext" in x:
            x["f_ext"][0] = convert(np.zeros(6), object)
        rows = contact_rows(self.model, x["q"], x["v"], self.contacts)
        left = self.left(rows, x["a"], x["lambda"], *(x[name] for name in self.arguments if name in x))
        tangents = steps(self.model, x["q"]) if of == "q" else directions(x[of])
        return replay(tape, [jacobian(tape, left, tangents, self.model.nv)], known)[0]

    def _independent_rows(self, q: Array, v: Array) -> Array:
        """Return J; raise SingularError where rows depend on each other: of many λ there is no derivative."""
        J = contact_rows(self.model, q, v, self.contacts).J
        rank = decompose(self.model, crba(self.model, q), J).rank
        if (rank < J.shape[-2]).any():
            raise SingularError(
                f"the contacts hold {J.shape[-2]} directions of which {int(rank.min())} are independent: "
                "many forces have the same effect, and the one that is chosen has no derivative, nor more digits"
            )
        return J


def held_quantities(
    model: Model,
    contacts: Sequence[Contact],
    dtype: np.dtype[Any],
    held: Answer,
    hit: Answer,
    push: Callable[[Array], Array] | None = None,
) -> Iterator[Quantity]:
    """Yield q̈ and λ of contacts that hold, "qdd" and "lambda", and v⁺ and Λ where they close: "v_plus", "impulse".

    `held` and `hit` are the textbook's. `push` returns forces in a configuration that come from outside.
    """
    for equations, motion, force in (
        (held_equations(model, contacts, dtype, held, push), "qdd", "lambda"),
        (hit_equations(model, contacts, dtype, hit), "v_plus", "impulse"),
    ):
        yield equations.quantity(motion, lambda x, _: x)
        yield equations.quantity(force, lambda _, x: x)


def held_equations(
    model: Model,
    contacts: Sequence[Contact],
    dtype: np.dtype[Any],
    textbook: Answer | None = None,
    push: Callable[[Array], Array] | None = None,
) -> Equations:
    """Return M q̈ + h = τ + Jᵀ λ and J q̈ + J̇ v = the given acceleration."""
    given = given_motion(contacts, "acceleration")

    def free(q: Array, v: Array, tau: Array, *f_ext: Array) -> Array:
        return aba_terms(model, q, v, tau if push is None else tau + push(q), *f_ext).qdd

    def left(rows: ContactRows, a: Array, force: Array, q: Array, v: Array, tau: Array, *f_ext: Array) -> Array:
        pushed = tau + (rows.J.mT * force).sum(axis=-1)  # also of no rows
        unmoved = rnea(model, q, v, a, *f_ext) - (pushed if push is None else pushed + push(q))
        return np.concatenate([unmoved, (rows.J * a).sum(axis=-1) + rows.bias])

    def asked(rows: ContactRows) -> Array:
        return convert(given, rows.bias.dtype) - rows.bias

    return Equations(model, contacts, dtype, ("q", "v", "tau", "f_ext"), free, asked, left, textbook)


def hit_equations(
    model: Model, contacts: Sequence[Contact], dtype: np.dtype[Any], textbook: Answer | None = None
) -> Equations:
    """Return M (v⁺ − v) = Jᵀ Λ and J v⁺ = the given velocity."""
    given = given_motion(contacts, "velocity")

    def left(rows: ContactRows, after: Array, force: Array, q: Array, v: Array) -> Array:
        unmoved = np.matvec(crba(model, q), after - v) - np.matvec(rows.J.mT, force)
        return np.concatenate([unmoved, np.matvec(rows.J, after)])

    def asked(rows: ContactRows) -> Array:
        return convert(given, rows.bias.dtype)

    return Equations(model, contacts, dtype, ("q", "v"), lambda q, v: v, asked, left, textbook)


class Once:
    """A function that computes once what is asked again of the same arrays, as several quantities of a program do."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function
        self._arrays: list[ref[Array]] = []
        self._answer: Any = None

    def __call__(self, *x: Array) -> Any:
        """Return what the function returns."""
        if len(x) != len(self._arrays) or any(known() is not one for known, one in zip(self._arrays, x)):
            self._arrays, self._answer = [], None
            self._answer = self._function(*x)
            self._arrays = [ref(x[0], self._forget), *map(ref, x[1:])]
        return self._answer

    def _forget(self, gone: object) -> None:
        """Keep no answer longer than its arrays: it holds what was recorded of them."""
        if any(one is gone for one in self._arrays):
            self._arrays, self._answer = [], None

"""Wrong implementations, made out of right ones: the slips that need no code of their own.

Each takes the reference, and gives a function with the same arguments that makes one slip: `faulty` changes a line of
it, the others what goes in or comes out. Where the reference returns several things, ``only`` names
those that are touched; by default all are.
"""

from __future__ import annotations

import inspect
import sys
import textwrap
from collections.abc import Callable, Mapping
from functools import cache, wraps
from types import FunctionType
from typing import Any

import numpy as np

__all__ = ["after", "as_column", "before", "faulty", "negated", "times", "transposed"]

Function = Callable[..., Any]


def faulty(
    solution: Function, *changes: tuple[str, str], of: Function | None = None, names: Mapping[str, Any] | None = None
) -> Function:
    """Change the text of the reference: in each pair the right text, and the wrong one in its place.

    Where the reference only calls an algorithm of the package, `of` is the listing whose text is changed instead; the
    reference then calls the changed one. It is compiled when it is first called, among the names of both modules, and
    those that are given.

    Raises
    ------
    ValueError
        When it is called, if the right text does not stand exactly once in what is changed.

    Examples
    --------
    >>> wrong = faulty(negated, ("-np.asarray(x)", "np.asarray(x)"))
    >>> wrong(np.positive)(2)
    array(2)
    """
    changed = solution if of is None else of

    @cache
    def compiled() -> Function:
        source, name = textwrap.dedent(inspect.getsource(changed)), changed.__name__
        for right, wrong in changes:
            if source.count(right) != 1:
                raise ValueError(f"{name}: expected {right!r} once in its source, found it {source.count(right)} times")
            source = source.replace(right, wrong)
        modules = (sys.modules[function.__module__] for function in (solution, changed))
        known = {**(names or {})} | {k: x for module in modules for k, x in vars(module).items()}
        exec(compile(source, "<changed>", "exec"), known)
        found: Function = known[name]
        return found if of is None else FunctionType(solution.__code__, {**solution.__globals__, name: found})

    @wraps(solution)
    def wrong(*arguments: Any) -> Any:
        return compiled()(*arguments)

    return wrong


def after(solution: Function, change: Callable[[Any], Any], *, only: tuple[int, ...] | None = None) -> Function:
    """Change what the reference returns."""

    def wrong(*arguments: Any) -> Any:
        answer = solution(*arguments)
        if not isinstance(answer, tuple):
            return change(answer)
        return tuple(change(x) if only is None or k in only else x for k, x in enumerate(answer))

    return wrong


def before(solution: Function, change: Callable[[Any], Any], *, which: int) -> Function:
    """Change one of the arguments of the reference."""

    def wrong(*arguments: Any) -> Any:
        return solution(*(change(x) if k == which else x for k, x in enumerate(arguments)))

    return wrong


def transposed(solution: Function) -> Function:
    """Rows and columns exchanged."""
    return after(solution, lambda x: np.asarray(x).mT)


def negated(solution: Function) -> Function:
    """Every sign wrong."""
    return after(solution, lambda x: -np.asarray(x))


def times(solution: Function, factor: float) -> Function:
    """Wrong by a factor."""
    return after(solution, lambda x: factor * np.asarray(x))


def as_column(solution: Function) -> Function:
    """(n, 1) in place of (n,)."""
    return after(solution, lambda x: np.asarray(x)[..., None])

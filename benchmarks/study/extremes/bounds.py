"""Whether proved bounds hold: programs with ``bound=True`` in the cells of the grid, against the truth in 80 digits."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench import newton_euler_3d as ne
from twistwrench.arrays import Array
from twistwrench.errors import ModelError, SingularError

from .robots import Recipe

__all__ = ["LONGEST", "Bound", "Measured", "bounds", "measured", "table"]

LONGEST = 30
"""Robots with more bodies are left out: a bound takes a minute to compile for them."""

DIGITS = 80
NOISE = 1e-37
"""Of the truth, relative to its largest entry: an oblique axis of a program is a unit vector to 38 digits."""

NUMBERS = ("float64", "float32")
TRUTH: dict[str, Callable[..., Array]] = {
    "tau": ne.inverse_dynamics,
    "M": ne.mass_matrix,
    "A_G": ne.centroidal_map,
    "qdd": ne.forward_dynamics,
}


class Measured(NamedTuple):
    """The entries of a quantity in a cell: how far each is off, and its bound; None where an error was raised."""

    quantity: str
    number: str
    cell: str
    off: Array | None
    bound: Array | None
    noise: float = 0.0


@dataclass(frozen=True)
class Bound:
    """The bounds of one quantity in one number type, over all cells.

    Attributes
    ----------
    quantity, number : str
    cells, raised : int
        Cells measured, and those where an error was raised instead.
    entries, held, infinite : int
        Entries, those whose bound is not below the error, and those for which nothing is certain.
    median, worst : float
        Of bound over error, where the error is not 0 and the bound is finite.
    broken : list of str
        The cells with an entry whose bound is below the error.
    """

    quantity: str
    number: str
    cells: int
    raised: int
    entries: int
    held: int
    infinite: int
    median: float
    worst: float
    broken: list[str]


def measured(recipe: Recipe) -> Iterator[Measured]:
    """Yield what the programs of a cell return, in both number types.

    The truth is that of the arguments as the program gets them, rounded to its numbers.
    """
    cell = ", ".join(f"{name} {x}" for name, x in recipe.changed.items()) or "usual"
    try:
        model, s = recipe.model, recipe.state
    except ModelError:
        yield from (Measured(quantity, number, cell, None, None) for quantity in TRUTH for number in NUMBERS)
        return
    tau = ne.inverse_dynamics(model, *(ne.as_mpmath(x) for x in s)).astype(np.float64)
    for wanted in (("tau", "M", "A_G"), ("qdd",)):
        shared: dict[Any, Any] = {}
        for number in NUMBERS:
            program: Any = tw.compile(model, wanted, dtype=number, bound=True, backend="numpy")
            program._codes = shared  # the same line: rewritten once
            with np.errstate(over="ignore"):
                state = {"q": s.q, "v": s.v, "a": s.a, "tau": tau}
                given = {name: x.astype(number) for name, x in state.items() if name in program.arguments}
            try:
                value, bound = program(**given)
            except ValueError:
                yield from (Measured(quantity, number, cell, None, None) for quantity in wanted)
                continue
            for quantity in wanted:
                yield _compared(model, quantity, number, cell, given, (value, bound))


def _compared(
    model: Any, quantity: str, number: str, cell: str, given: dict[str, Array], found: tuple[Any, Any]
) -> Measured:
    """Return how far the entries of a quantity are off; infinitely where there is no right value."""
    import mpmath

    value, bound = (getattr(x, quantity) for x in found)
    names = {"tau": "q v a", "qdd": "q v tau"}.get(quantity, "q").split()
    with mpmath.workdps(DIGITS):
        try:
            right = TRUTH[quantity](model, *(ne.as_mpmath(given[name]) for name in names))
        except SingularError:
            return Measured(quantity, number, cell, np.full(value.shape, np.inf), bound)
        off = abs(ne.as_mpmath(value) - right).astype(np.float64)
        return Measured(quantity, number, cell, off, bound.astype(np.float64), NOISE * float(abs(right).max()))


def bounds(every: Iterable[Measured]) -> list[Bound]:
    """Count over all cells."""
    by: dict[tuple[str, str], list[Measured]] = {}
    for one in every:
        by.setdefault((one.quantity, one.number), []).append(one)
    return [_counted(quantity, number, found) for (quantity, number), found in by.items()]


def _counted(quantity: str, number: str, found: Sequence[Measured]) -> Bound:
    held = infinite = entries = 0
    ratios, broken = [np.zeros(0)], list[str]()
    for one in found:
        if one.off is None or one.bound is None:
            continue
        kept, finite = one.off <= one.bound + one.noise, one.bound < np.inf
        ratios.append((one.bound / np.where(one.off > 0, one.off, 1))[finite & (one.off > one.noise)])
        entries, held, infinite = entries + kept.size, held + int(kept.sum()), infinite + int((~finite).sum())
        broken += [] if kept.all() else [one.cell]
    ratio = np.concatenate(ratios)
    raised = sum(one.off is None for one in found)
    median, worst = (float(np.median(ratio)), float(ratio.max())) if ratio.size else (0.0, 0.0)
    return Bound(quantity, number, len(found), raised, entries, held, infinite, median, worst, broken)


def table(found: Iterable[Bound]) -> str:
    """Return the table as text."""
    lines = [
        f"{'bound':8} {'':8} {'cells':>5} {'raised':>7} {'entries':>7} {'held':>7} {'infinite':>8} "
        f"{'bound / error, median':>22} {'largest':>8}"
    ]
    for b in found:
        lines.append(
            f"{b.quantity:8} {b.number:8} {b.cells:5} {b.raised:7} {b.entries:7} {b.held:7} {b.infinite:8} "
            f"{b.median:22.3f} {b.worst:8.1e}"
        )
        lines += [f"  does not hold: {cell}" for cell in b.broken]
    return "\n".join(lines)

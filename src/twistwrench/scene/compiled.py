"""The law of a model as a compiled program, from the few variables that it knows: what is timed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from straightline.backend import BackEnd
from straightline.llvm import default_backend

from ..arrays import Array
from ..errors import SingularError
from ..fast.programs import too_long
from ..fast.quantity import Quantity
from ..fast.recording import ALARM, record
from ..model import Model
from ..timing import round_robin

__all__ = ["compile_law", "seconds"]

Law = Callable[..., tuple[Array, ...]]
DOUBLE = np.dtype(np.float64)


def compile_law(
    model: Model, law: Law, known: Sequence[Array], wanted: Sequence[int]
) -> tuple[Callable[[], Sequence[Array]], float]:
    """Return what computes some of a law's results for all states, and its operations for one state.

    It is a program, or else, where the law cannot be one, NumPy's: then the number of operations is infinite.

    Parameters
    ----------
    model : Model
    law : callable
        From what is known to a tuple of results.
    known : sequence of ndarray, shapes (n, ...)
    wanted : sequence of int
        Which of the results.
    """

    def one(k: int, *x: Array) -> tuple[Array, list[object]]:
        return law(*x)[k], []

    names = tuple(f"x{k}" for k in range(len(known)))
    shapes = {name: x.shape[1:] for name, x in zip(names, known)}
    try:
        if too_long(model, ("qdd",)):
            raise TypeError
        wants = [Quantity(f"y{k}", names, partial(one, k)) for k in wanted]
        line = record(model, wants, shapes, {}, DOUBLE).without(ALARM)
    except (TypeError, ArithmeticError, SingularError):  # a law that asks what its numbers are
        return lambda: [y for k, y in enumerate(law(*known)) if k in wanted], np.inf
    n = len(known[0])
    code = BackEnd(line, DOUBLE, default_backend(DOUBLE)).code(n)
    flat = [np.ascontiguousarray(x.reshape(n, -1), DOUBLE) for x in known]
    results = [np.empty((n, *shape)) for shape, _ in line.outputs.values()]
    arrays = [*flat, *(y.reshape(n, -1) for y in results)]

    def run() -> Sequence[Array]:
        code.run(arrays)
        return results

    return run, line.operations.total()


def seconds(calls: Sequence[Callable[[], object]], states: int) -> list[float]:
    """Return the time of each call for one state: the quickest of many, all in turns."""
    for call in calls:
        call()  # what is made once is made now
    return [float(lap.seconds.min()) / states for lap in round_robin(calls, rounds=7, least=1e-4)]

"""The program for a model and a question: made when it is first asked for, and remembered with the model."""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from straightline.llvm import default_backend

from ..algorithms.floating_base import HeldRows
from ..arrays import Array
from ..errors import SingularError
from ..model import Model, check_model
from .program import Program
from .quantities import quantities
from .quantity import Quantity, checked

__all__ = [
    "ASKED",
    "MAX_CHAIN_DOF",
    "MAX_COMPILED_OPERATIONS",
    "MAX_DOF",
    "MAX_ENTRIES_OF_M",
    "MAX_HEAVY_CHAIN_DOF",
    "cached_program",
    "program",
    "remembered",
    "result",
    "states_of",
    "too_long",
]

MAX_CHAIN_DOF = 400  # degrees of freedom from the world to a body

MAX_HEAVY_CHAIN_DOF = 80
"""The same for what is heavy in a long chain: the pivots of q̈ are always below what a program takes, or the operations
grow with the square of the length, as those of M."""

HEAVY = {"qdd", "IA", "M_inv", "M_inv_tau", "L", "D", "Lambda", "Lambda_inv", "M", "C", "dA_G", "Y"}  # and derivatives

MAX_DOF = 1000  # degrees of freedom of a robot that is not too large for a straight line
MAX_ENTRIES_OF_M = 20_000  # entries of M on and below its diagonal that are not always zero, where M is asked for

MAX_COMPILED_OPERATIONS = 150_000
"""Operations that are not too many for machine code, which then takes some seconds to make: NumPy does longer lines."""

MAX_CACHED_PROGRAMS = 256  # programs that a model remembers: of gaits each set of feet is one, and each frame three

LOG = logging.getLogger(__name__)

PLAIN = (np.dtype(np.float64), np.dtype(np.float32), np.dtype(np.longdouble))
"""Number types of which a program sees for itself whether a state is valid."""

ASKED = Quantity("asked", ("q", "v"), lambda q, v: (q[..., :0], []))
"""Nothing; but q and v are looked at, whatever else depends on them."""


def states_of(model: Model, named: Mapping[str, Any]) -> tuple[tuple[Any, ...], np.dtype[Any]]:
    """Return the arguments, and their number type: as they are where they are arrays of one type, else converted."""
    args = tuple(named.values())
    dtype = getattr(args[0], "dtype", None)
    if dtype not in PLAIN or not all(type(x) is np.ndarray and x.dtype == dtype for x in args):
        args = tuple(checked(model, named).values())
    return args, args[0].dtype


def remembered(model: Model, want: Any, contacts: Any, args: Sequence[Any], out: Any = None) -> Any:
    """Return what the program that is remembered for a question returns, as `Program.results`; None if there is none.

    It looks at nothing that the program looks at itself: for one state each 0.1 µs counts.
    """
    try:
        program = model._programs[want, args[0].dtype, contacts]
        alone = program.alone[len(args)] if out is None else None
    except (AttributeError, KeyError, TypeError):  # none yet, or arguments of other kinds
        return None
    found = alone(*args) if alone else None
    return program.results(args, out) if found is None else found


def result(
    model: Model, symbol: str, names: tuple[str, ...], args: tuple[ArrayLike, ...], f_ext: ArrayLike | None, out: Any
) -> Array:
    """Return one quantity, which depends on these arguments, of one state or many."""
    if f_ext is not None:
        names, args = (*names, "f_ext"), (*args, f_ext)
    found: Array | None = remembered(model, (symbol,), None, args, out)
    if found is None:
        states, dtype = states_of(model, dict(zip(names, args)))
        found = program(model, (symbol,), dtype)(*states, out=out)
    return found


def program(
    model: Model, want: tuple[str, ...], dtype: np.dtype[Any], contacts: tuple[str | HeldRows, ...] | None = None
) -> Program:
    """Return what computes one quantity, by its symbol; with contacts, which are those of J_c, several: `Results`."""

    def asked() -> list[Quantity]:
        known = quantities(model, dtype, contacts or ())
        return [known[name] for name in want] + ([] if contacts is None else [ASKED])

    check_model(model)
    return cached_program(model, (want, dtype, contacts), dtype, asked, single=contacts is None)


def cached_program(
    model: Model,
    key: Hashable,
    dtype: np.dtype[Any],
    asked: Callable[[], Sequence[Quantity]],
    *,
    single: bool = False,
    warmup_calls: int = 0,
) -> Program:
    """Return the program for the quantities that `asked` returns, the one that was made for this key before if any.

    For the first `warmup_calls` it is the textbook: a program is not worth its making for a few states.
    """
    programs = model._programs
    found: Program | int = programs.get(key, 0)
    if isinstance(found, Program):
        return found
    if found < warmup_calls:
        programs[key] = found + 1
        return Program(model, asked(), single=single, dtype=dtype, backend="textbook")
    for forgotten in [*programs][: len(programs) + 1 - MAX_CACHED_PROGRAMS]:
        programs.pop(forgotten, None)
    made = Program(model, asked(), single=single, dtype=dtype, backend=default_backend(dtype))
    made.run_by(suited(made))
    programs[key] = made
    return made


def suited(program: Program) -> str:
    """Return which back end suits a program: its own, NumPy for a long line, the textbook where there can be none."""
    model, symbols = program.model, [quantity.symbol for quantity in program.quantities]
    if reason := too_long(model, symbols):
        LOG.warning("%s has %s: the textbook computes %s", model.name, reason, ", ".join(symbols))
        return "textbook"
    try:
        operations = program.operations.total()
    except (TypeError, ArithmeticError, SingularError):  # a joint that asks what its q is; no inertia
        return "textbook"
    return program.backend if operations <= MAX_COMPILED_OPERATIONS else "numpy"


def too_long(model: Model, want: Collection[str]) -> str | None:
    """Return what is too much of a model for a straight line that computes these symbols, if anything is."""
    above = [0]  # degrees of freedom from the world up to a body
    for p, joint in zip(model.parent[1:], model.joints[1:]):
        above.append(above[p] + (joint.nv if joint else 0))
    entries = sum(above[i] * joint.nv for i, joint in enumerate(model.joints) if joint)
    heavy = any(symbol in HEAVY or "_d" in symbol for symbol in want)
    longest = min(MAX_CHAIN_DOF, MAX_HEAVY_CHAIN_DOF) if heavy else MAX_CHAIN_DOF
    if max(above) > longest:
        return f"{max(above)} degrees of freedom in a chain, more than {longest}"
    if model.nv > MAX_DOF:
        return f"{model.nv} degrees of freedom, more than {MAX_DOF}"
    if "M" in want and entries > MAX_ENTRIES_OF_M:
        return f"{entries} entries of M, more than {MAX_ENTRIES_OF_M}"
    return None

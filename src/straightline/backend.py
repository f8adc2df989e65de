"""What runs a line: LLVM, NumPy, or for a few states plain Python."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache, cached_property
from math import prod
from typing import Any

import numpy as np

from . import extension, ufunc
from .line import Line
from .llvm import MachineCode, lanes
from .number import Array
from .registers import Registers
from .source import python_source

__all__ = ["BackEnd"]

NONE: Mapping[str, Array] = {}

MAX_SINGLE_STATES = 20  # without LLVM, up to so many states are done one by one, in plain Python; more of them by NumPy
MIN_STATES_PER_THREAD = 64  # a thread does at least so many states
MAX_ARRAYS = 32  # arguments and results of a function of NumPy
KEPT = 2**25 - 2**16  # bytes, a little less than the 32 MiB up to which glibc learns: see `keep_memory`


class BackEnd:
    """A line, and what runs it, "llvm" or "numpy": made when it is first needed."""

    def __init__(self, line: Line, dtype: np.dtype[Any], name: str) -> None:
        self.line, self.dtype, self.name = line, dtype, name
        # the sines of pairs are rounded to whole numbers, which `math` does not do
        self.few = MAX_SINGLE_STATES if dtype == np.float64 and "round" not in line.operations else 0
        self._codes: dict[int, MachineCode] = {}
        self.addresses = (ctypes.c_void_p * 3)()  # of machine code for one state, and for several: see `ArrayFunction`
        keep_memory()

    def machine_code(self, width: int) -> MachineCode:
        """Return machine code for so many states at once."""
        if width not in self._codes:
            self._codes[width] = MachineCode(self.line, self.dtype, width)
            self.addresses[width > 1] = self._codes[width].address
        return self._codes[width]

    @cached_property
    def plain(self) -> Plain:
        """The line in plain Python."""
        return Plain(self.line)

    @cached_property
    def registers(self) -> Registers:
        """The line in NumPy."""
        return Registers(self.line, self.dtype)

    def one_state(self, single: bool) -> Callable[..., Any] | None:
        """Return a function of the interpreter for one state, of which the last result decides: see `extension`.

        None if there can be none: without machine code, or if the interpreter's objects are not as they are expected.
        """
        if self.name != "llvm" or not extension.POSSIBLE:
            return None
        return extension.state_function(self.machine_code(1), self.line, self.dtype, single)

    def array_function(self) -> ufunc.ArrayFunction | None:
        """Return a function of arrays with any leading axes, of which the last result decides: see `ufunc`.

        None if there can be none: without machine code, without an entry in an argument, or with too many arrays.
        """
        line, arguments = self.line, self.line.inputs.values()
        few = len(line.inputs) + len(line.outputs) <= MAX_ARRAYS
        if self.name != "llvm" or not ufunc.POSSIBLE or not few or not line.inputs or not all(map(prod, arguments)):
            return None
        return ufunc.ArrayFunction(self.line, self.dtype, self.addresses, lanes(self.dtype))

    def code(self, count: int) -> MachineCode | Plain | Registers:
        """Return what is quickest for so many states: its `run` fills the results, as rows, from the arguments."""
        if self.name == "llvm":
            width = lanes(self.dtype)
            return self.machine_code(width if count >= width else 1)
        return self.plain if count <= self.few else self.registers

    def results(
        self, states: Mapping[str, Array], batch: tuple[int, ...], threads: int = 1, into: Mapping[str, Array] = NONE
    ) -> dict[str, Array]:
        """Return the results by name, from arguments with these batch axes; `into` has rows for some of them."""
        count, line = prod(batch), self.line
        given = [states[name].reshape(count, prod(shape)) for name, shape in line.inputs.items()]
        given = [x if x.strides[1] == x.itemsize and x.flags.aligned else np.ascontiguousarray(x) for x in given]
        made = {name: np.empty((count, len(line.outputs[name][1])), self.dtype) for name in line.outputs.keys() - into}
        rows = {**into, **made}
        arrays = [*given, *(rows[name] for name in line.outputs)]
        if count >= 2 * MIN_STATES_PER_THREAD and threads > 1:
            divided(self.code(count).run, arrays, threads)
        elif count:
            self.code(count).run(arrays)
        return {name: rows[name].reshape(batch + shape) for name, (shape, _) in line.outputs.items()}


class Plain:
    """A line as a Python function of floats."""

    def __init__(self, line: Line) -> None:
        names: dict[str, Any] = {}
        flat = replace(line, outputs={name: ((len(entries),), entries) for name, (_, entries) in line.outputs.items()})
        exec(python_source(flat, "program"), names)  # our own text
        self.function, self.shapes = names["program"], [*line.inputs.values()]

    def run(self, arrays: Sequence[Array]) -> None:
        """Fill the results: each array has shape (states, entries)."""
        given, results = arrays[: len(self.shapes)], arrays[len(self.shapes) :]
        for k in range(len(arrays[0])):
            state = [x[k].reshape(shape).tolist() for x, shape in zip(given, self.shapes)]
            try:
                found = self.function(*state)
                values = (found,) if len(results) == 1 else found
            except (OverflowError, ValueError, ZeroDivisionError):  # where NumPy goes on with NaN
                values = (np.nan,) * len(results)
            for x, value in zip(results, values):
                x[k] = value


def divided(run: Callable[[Sequence[Array]], None], arrays: Sequence[Array], threads: int) -> None:
    """Call `run` with the states of all arrays, divided among threads."""
    count = len(arrays[-1])
    parts = min(threads, count // MIN_STATES_PER_THREAD)
    edges = [count * k // parts for k in range(parts + 1)]
    with ThreadPoolExecutor(parts) as pool:
        list(pool.map(lambda k: run([x[edges[k] : edges[k + 1]] for x in arrays]), range(parts)))


@cache
def keep_memory() -> None:
    """Let the C library keep the memory of freed arrays instead of returning it to the kernel.

    glibc returns blocks above a limit, at first 128 KiB, and every page that is used again then costs a page fault:
    most of the time of 1000 states. The limit follows the largest block that was ever freed; elsewhere nothing happens.
    """
    np.empty(KEPT, np.uint8)

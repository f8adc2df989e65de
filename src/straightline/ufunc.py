"""A line as a function of NumPy's own kind, a generalized ufunc: any leading axes, strides and arrays to be filled.

NumPy finds where the states lie, which of them an argument shares with others, and makes the arrays of the results, all
in a microsecond; the machine code of the line gets what NumPy's own loops get. It is told where a row of entries begins
and how far it is to the next one: rows whose entries do not lie next to each other raise the alarm of all their states.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
from importlib import import_module
from math import prod
from typing import Any

import numpy as np

from .instructions import InstructionText
from .line import Line
from .llvm import NATIVE, engine_of
from .number import Array
from .outputs import Tail

__all__ = ["POSSIBLE", "ArrayFunction"]

POSSIBLE = hasattr(ctypes, "pythonapi")
"""Whether NumPy can be asked for such functions: without them all results are the same, tens of microseconds later."""

CLEAR, FROM_SIGNATURE = 27, 31
"""Places in NumPy's table of functions for ufuncs: PyUFunc_clearfperr, PyUFunc_FromFuncAndDataAndSignature."""


class ArrayFunction:
    """The results of a line, and last of all its alarm, for arrays of one number type with any leading axes.

    `call` returns new arrays in C's order, or fills those of `out`, of which some may be None; it raises ValueError if
    the shapes do not fit. `addresses` are those of machine code for one state and for `width` at once, null until it is
    made: states for which there is none yet raise the alarm. The third one is for NumPy's function.
    """

    def __init__(self, line: Line, dtype: np.dtype[Any], addresses: Any, width: int) -> None:
        inputs, outputs = [*line.inputs.values()], [shape for shape, _ in line.outputs.values()]
        there = [shape for shape in outputs if 0 not in shape]
        count = len(inputs) + len(there)
        self.dtype = dtype
        self.empty = {k: shape for k, shape in enumerate(outputs) if 0 in shape}
        self.numbers = [k for k, shape in enumerate(outputs[:-1]) if not shape]
        addresses[2] = _functions()[CLEAR]
        self.engine = engine_of(LoopText(dtype).written(width, inputs, outputs))
        signature = f"{_words(inputs)}->{_words(there)}".encode()
        loops, data = Pointer(self.engine.get_function_address("loop")), Pointer(ctypes.addressof(addresses))
        types = ctypes.create_string_buffer(bytes([dtype.num] * count), count)
        self.kept = addresses, loops, data, types, signature  # which NumPy does not copy
        make = ctypes.PYFUNCTYPE(ctypes.py_object, *ARGUMENTS)(_functions()[FROM_SIGNATURE])
        at = [ctypes.addressof(x) for x in (loops, data, types)]
        made = make(*at, 1, len(inputs), len(there), -1, NAME, None, 0, signature)
        self.ufunc: Callable[..., Any] = partial(made, order="C")
        self.call: Callable[..., Sequence[Array]] = self._completed if self.empty or self.numbers else self.ufunc

    def _completed(self, *arrays: Array, out: Sequence[Array | None] = ()) -> list[Array]:
        """Return what `call` does where NumPy leaves out what is empty, and makes bare numbers of single ones."""
        if out:
            made = self.ufunc(*arrays, out=tuple(x for k, x in enumerate(out) if k not in self.empty))
        else:
            made = self.ufunc(*arrays)
        found = [*made] if type(made) is tuple else [made]  # the alarm alone
        batch = found[-1].shape
        for k, shape in self.empty.items():
            own = out[k] if out else None
            found.insert(k, np.empty(batch + shape, self.dtype) if own is None else own)
        if not batch:
            for k in self.numbers:
                found[k] = np.asarray(found[k])
        return found


Pointer = ctypes.c_void_p * 1
NAME = b"program"
TEXT = ctypes.c_char_p
ARGUMENTS = [*[ctypes.c_void_p] * 3, *[ctypes.c_int] * 4, TEXT, TEXT, ctypes.c_int, TEXT]
"""Of PyUFunc_FromFuncAndDataAndSignature."""


def _words(shapes: Sequence[Tail]) -> str:
    """Return shapes in NumPy's words: (19),(4,6),()."""
    return ",".join(f"({','.join(map(str, shape))})" for shape in shapes)


class LoopText(InstructionText):
    """The loop that NumPy calls: with pointers to the arrays, the number of states, and steps in bytes.

    The steps are those from state to state for each array, then those along the axes of each array's entries.
    """

    def __init__(self, dtype: np.dtype[Any]) -> None:
        super().__init__(NATIVE[dtype], 1)

    def written(self, width: int, inputs: Sequence[Tail], outputs: Sequence[Tail]) -> str:
        """Return the loop as a module of LLVM's language."""
        shapes = [*inputs, *outputs]
        table = self.new(f"alloca i64, i64 {2 * len(shapes)}")  # pointers, each with a step
        there = [k for k, shape in enumerate(shapes) if 0 not in shape]
        start, step = "", ""
        for place, k in enumerate(there):
            start, step = self.member("ptr", "%pointers", place), self.member("i64", "%steps", place)
            self.lines.append(f"store ptr {start}, ptr {self.place(table, 2 * k)}")
            self.lines.append(f"store i64 {step}, ptr {self.place(table, 2 * k + 1)}")
        count = self.new("load i64, ptr %dimensions")
        many = self.new(f"icmp sge i64 {count}, {width}")
        one, several, clear = (self.member("ptr", "%addresses", k) for k in range(3))
        code = self.new(f"select i1 {many}, ptr {several}, ptr {one}")
        fits = self.new(f"icmp ne ptr {code}, null")
        for k, expected in self.expected_steps([shapes[k] for k in there]):
            as_expected = self.new(f"icmp eq i64 {self.member('i64', '%steps', k)}, {expected}")
            fits = self.new(f"and i1 {fits}, {as_expected}")
        names = {"count": count, "table": table, "code": code, "fits": fits, "clear": clear}
        last = {"alarm": start, "step": step, "scalar": self.scalar}
        return LOOP.format(lines="\n  ".join(self.lines), **names, **last)

    def expected_steps(self, shapes: Sequence[Tail]) -> Iterator[tuple[int, int]]:
        """Yield the places of the steps along entries that lie next to each other, and how many bytes they are."""
        axes = [(length, shape[n + 1 :]) for shape in shapes for n, length in enumerate(shape)]
        for k, (length, inner) in enumerate(axes, len(shapes)):
            if length > 1:
                yield k, self.bytes * prod(inner)

    def member(self, kind: str, of: str, k: int) -> str:
        """Return entry k of an array of numbers or pointers, of eight bytes each."""
        return self.new(f"load {kind}, ptr {self.place(of, k)}")

    def place(self, of: str, k: int) -> str:
        """Return where entry k of such an array is."""
        return self.new(f"getelementptr i64, ptr {of}, i64 {k}")


LOOP = """
define void @loop(ptr %pointers, ptr %dimensions, ptr %steps, ptr %addresses) {{
begin:
  {lines}
  %some = icmp sgt i64 {count}, 0
  br i1 %some, label %look, label %end
look:
  br i1 {fits}, label %compute, label %unknown
compute:
  call void {code}(ptr {table}, i64 {count})
  call void {clear}()
  br label %end
unknown:
  %state = phi i64 [0, %look], [%next, %unknown]
  %offset = mul i64 %state, {step}
  %place = getelementptr i8, ptr {alarm}, i64 %offset
  store {scalar} 0x7FF0000000000000, ptr %place
  %next = add i64 %state, 1
  %more = icmp slt i64 %next, {count}
  br i1 %more, label %unknown, label %end
end:
  ret void
}}
"""
"""What is not a number or infinite is seen in the alarm: NumPy's flags of such operations are cleared."""


@cache
def _functions() -> Any:
    """Return NumPy's table of functions for ufuncs, which `import_umath` of a module in C asks for."""
    pointer = ctypes.pythonapi.PyCapsule_GetPointer
    pointer.argtypes, pointer.restype = [ctypes.py_object, ctypes.c_char_p], ctypes.POINTER(ctypes.c_void_p)
    return pointer(import_module("numpy._core._multiarray_umath")._UFUNC_API, None)

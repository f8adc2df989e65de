"""A line as a function of the interpreter, such as a module in C would have: for one state, where 0.1 µs counts.

With the machine code of a line goes a little more, which finds the numbers where CPython and NumPy keep them, makes the
arrays of the results and lets the line fill them: by what every compiled module relies on, the C-API of CPython and
NumPy, and the first members of `PyObject` and `PyArrayObject`. Whatever is not an array of the right number type and
shape, and each state whose last result, the alarm, is above 1, is answered with None, and the caller goes another way.

Nothing needs it: it is used where `POSSIBLE`, that is where an array of this interpreter has its members at these
places, and without it all results are the same, some microseconds later.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from .instructions import InstructionText
from .line import Line
from .llvm import NATIVE, MachineCode, engine_of
from .number import Array
from .outputs import Tail

__all__ = ["POSSIBLE", "as_expected", "members", "state_function"]

KIND = 8
DATA, AXES, SHAPE, DTYPE, FLAGS = 16, 24, 32, 56, 64
"""Where an object has its type, and an array its members: bytes from the first one on."""

USUAL = 0x101  # flags of an array in C's order, whose entries are where the processor wants them
POSITIONAL = 0x80  # METH_FASTCALL: the function gets its arguments as pointers, one after the other, and their count
NEW_ARRAY = 93  # the place of PyArray_New among the functions of NumPy's C-API


SIZE = 72  # bytes: no array is shorter than its first members


def members(x: Array) -> tuple[int, ...]:
    """Return what stands at these places of an array: its type, number type, data, axes, flags, and lengths."""
    start = id(x)
    kind, dtype, data, shape = (ctypes.c_size_t.from_address(start + at).value for at in (KIND, DTYPE, DATA, SHAPE))
    axes, flags = (ctypes.c_int.from_address(start + at).value for at in (AXES, FLAGS))
    if axes != x.ndim:
        return kind, dtype, data, axes, flags
    return kind, dtype, data, axes, flags, *(ctypes.c_ssize_t.from_address(shape + 8 * k).value for k in range(axes))


def as_expected() -> bool:
    """Return whether the members of an array of this interpreter stand at these places.

    An object has to begin with a count and its type, eight bytes each; in CPython without its lock it does not.
    """
    if sys.implementation.name != "cpython" or object.__basicsize__ != 16 or np.ndarray.__basicsize__ < SIZE:
        return False
    x = np.zeros((2, 3), np.float32)
    return members(x) == (id(np.ndarray), id(x.dtype), x.ctypes.data, 2, x.flags.num, 2, 3)


POSSIBLE = as_expected()


class MethodDef(ctypes.Structure):
    """PyMethodDef: a function as CPython expects it."""

    _fields_ = [("name", ctypes.c_char_p), ("at", ctypes.c_void_p), ("flags", ctypes.c_int), ("doc", ctypes.c_char_p)]


def state_function(code: MachineCode, line: Line, dtype: np.dtype[Any], single: bool) -> Callable[..., Any]:
    """Return a function from the arrays of one state to the results of a line, without the last, which is the alarm.

    The code is the line's, of width 1. A single result is an array; several are a tuple of arrays.
    """
    *results, _ = [shape for shape, _ in line.outputs.values()]
    engine = engine_of(Call(dtype).written(code.address, [*line.inputs.values()], results, single))
    method = MethodDef(b"program", engine.get_function_address("state"), POSITIONAL, None)
    make = ctypes.pythonapi.PyCFunction_NewEx
    make.argtypes, make.restype = [ctypes.c_void_p, ctypes.py_object, ctypes.c_void_p], ctypes.py_object
    function: Callable[..., Any] = make(ctypes.addressof(method), (method, engine, code), None)  # which it keeps alive
    return function


class Call(InstructionText):
    """The function's instructions, for arrays of float32 or float64."""

    def __init__(self, dtype: np.dtype[Any]) -> None:
        super().__init__(NATIVE[dtype], 1)
        self.dtype = dtype

    def written(self, program: int, inputs: Sequence[Tail], outputs: Sequence[Tail], single: bool) -> str:
        """Return the function as a module of LLVM's language; `program` is the address of the line's machine code."""
        table = self.new(f"alloca i64, i64 {2 * (len(inputs) + len(outputs) + 1)}")  # pointers, each with a stride
        alarm = self.new(f"alloca {self.scalar}")
        self.require("i64", "%count", len(inputs))
        pointers = [self.entries(k, shape) for k, shape in enumerate(inputs)]
        results = "null" if single else self.made(f"{api('PyTuple_New')}(i64 {len(outputs)})", "null")
        for k, shape in enumerate(outputs):
            x = self.made(self.new_array(shape), results)
            pointers.append(self.member("ptr", x, DATA))
            if single:
                results = x
            else:
                self.new(f"call i32 {api('PyTuple_SetItem')}(ptr {results}, i64 {k}, ptr {x})")
        for k, pointer in enumerate([*pointers, alarm]):
            self.lines.append(f"store ptr {pointer}, ptr {self.new(f'getelementptr i64, ptr {table}, i64 {2 * k}')}")
        self.lines.append(f"call void {at(program)}(ptr {table}, i64 1)")
        value = self.new(f"load {self.scalar}, ptr {alarm}")
        sure = self.new(f"fcmp ole {self.scalar} {value}, 1.0")
        names = {"release": api("Py_DecRef"), "keep": api("Py_IncRef"), "none": at(id(None))}
        text = STATE.format(lines="\n  ".join(self.lines), sure=sure, results=results, **names)
        return "\n".join([*sorted(self.declared), text])

    def entries(self, k: int, shape: Tail) -> str:
        """Return where the entries of argument k are, if it is an array as expected."""
        x = self.member("ptr", "%arguments", 8 * k)
        self.require("i64", self.member("i64", x, KIND), id(np.ndarray))
        self.require("i64", self.member("i64", x, DTYPE), id(self.dtype))
        self.require("i32", self.new(f"and i32 {self.member('i32', x, FLAGS)}, {USUAL}"), USUAL)
        self.require("i32", self.member("i32", x, AXES), len(shape))
        lengths = self.member("ptr", x, SHAPE)
        for axis, length in enumerate(shape):
            self.require("i64", self.member("i64", lengths, 8 * axis), length)
        return self.member("ptr", x, DATA)

    def new_array(self, shape: Tail) -> str:
        """Return the call that makes an array."""
        name = "@" + "_".join(["shape", *map(str, shape)])
        self.declared.add(f"{name} = private constant [{len(shape)} x i64] [{', '.join(f'i64 {n}' for n in shape)}]")
        kind = f"ptr {at(id(np.ndarray))}, i32 {len(shape)}, ptr {name}, i32 {self.dtype.num}"
        return f"{at(numpy_api()[NEW_ARRAY])}({kind}, ptr null, ptr null, i32 0, i32 0, ptr null)"

    def member(self, kind: str, of: str, offset: int) -> str:
        """Return what is so many bytes from a pointer on."""
        return self.new(f"load {kind}, ptr {self.new(f'getelementptr i8, ptr {of}, i64 {offset}')}")

    def require(self, kind: str, value: str, expected: int) -> None:
        """Give up where a value is not the expected one."""
        equal = self.new(f"icmp eq {kind} {value}, {expected}")
        self.lines.append(f"br i1 {equal}, label %next{len(self.lines)}, label %unknown\nnext{len(self.lines)}:")

    def made(self, call: str, results: str) -> str:
        """Return a new object; if there is no memory for it, release the results so far and let the error through."""
        x = self.new(f"call ptr {call}")
        none, n = self.new(f"icmp eq ptr {x}, null"), len(self.lines)
        self.lines.append(f"br i1 {none}, label %full{n}, label %next{n}\nfull{n}:")
        self.lines.append(f"call void {api('Py_DecRef')}(ptr {results})\n  ret ptr null\nnext{n}:")
        return x


STATE = """
define ptr @state(ptr %self, ptr %arguments, i64 %count) {{
  {lines}
  br i1 {sure}, label %done, label %unsure
done:
  ret ptr {results}
unsure:
  call void {release}(ptr {results})
  br label %unknown
unknown:
  call void {keep}(ptr {none})
  ret ptr {none}
}}
"""


def at(address: int) -> str:
    """Return a pointer to what never moves."""
    return f"inttoptr (i64 {address} to ptr)"


def api(name: str) -> str:
    """Return the pointer to a function of CPython's C-API."""
    return at(ctypes.cast(getattr(ctypes.pythonapi, name), ctypes.c_void_p).value or 0)


@cache
def numpy_api() -> Any:
    """Return the table of NumPy's C-API, which `import_array` of a module in C asks for."""
    pointer = ctypes.pythonapi.PyCapsule_GetPointer
    pointer.argtypes, pointer.restype = [ctypes.py_object, ctypes.c_char_p], ctypes.POINTER(ctypes.c_void_p)
    return pointer(import_module("numpy._core._multiarray_umath")._ARRAY_API, None)

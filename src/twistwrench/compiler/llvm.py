"""Machine code from a straight line, by LLVM: one state, or as many at once as a register of the processor holds.

Every operation becomes one instruction of LLVM's language, with the same numbers of W states in one register. All that
is written besides is a loop over the states, the way in and out of memory, and sin and cos (`sine`). Nothing is put
together or reordered by the compiler: what comes out is what the operations say, to the last bit.

`llvmlite` is an extra: ``pip install "twistwrench[compile]"``.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np

from ..arrays import Array
from .instructions import Text
from .line import Line, operands
from .sine import sine_and_cosine

__all__ = ["NATIVE", "MachineCode", "available", "engine_of", "lanes"]

NATIVE = {np.dtype(np.float64): "double", np.dtype(np.float32): "float"}
"""LLVM's names of the number types that a processor has."""

WHOLE, PIECE = 10_000, 600
"""Operations of a line that is compiled as a whole; a longer one is in pieces of so many instructions."""


@cache
def available() -> bool:
    """Return whether llvmlite is installed."""
    try:
        import llvmlite.binding  # noqa: F401
    except ImportError:
        return False
    return True


@cache
def lanes(dtype: np.dtype[Any]) -> int:
    """Return how many numbers of a type a register of this processor holds."""
    import llvmlite.binding as llvm

    features = llvm.get_host_cpu_features()
    bits = 512 if features.get("avx512f") else 256 if features.get("avx2") else 128
    return bits // (8 * dtype.itemsize)


class MachineCode:
    """A line as machine code, for `width` states at once.

    Parameters
    ----------
    line : Line
    dtype : dtype
        float32 or float64.
    width : int
        A power of two; with 1, for one state after the other.

    Attributes
    ----------
    address : int
        Where the function is that takes a table of pointers and strides, and the number of states.
    """

    def __init__(self, line: Line, dtype: np.dtype[Any], width: int) -> None:
        self._engine = engine_of(written(line, NATIVE[dtype], width))  # keeps the code alive
        self.address: int = self._engine.get_function_address("program")
        self._call = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int64)(self.address)

    def run(self, arrays: Sequence[Array]) -> None:
        """Fill the results: each array has shape (states, entries), its entries next to each other in memory.

        Other threads of Python run in the meantime.
        """
        table = np.array([(x.ctypes.data, x.strides[0]) for x in arrays], np.int64)
        self._call(table.ctypes.data, len(arrays[0]))


def engine_of(text: str) -> Any:
    """Return what holds the machine code of a text in LLVM's language, for this processor."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    features = llvm.get_host_cpu_features().flatten()
    host = llvm.Target.from_default_triple().create_target_machine(
        opt=1, cpu=llvm.get_host_cpu_name(), features=features
    )
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(text), host)
    engine.finalize_object()
    return engine


def written(line: Line, scalar: str, width: int) -> str:
    """Return a line as a module of LLVM's language: pieces of some operations, and a loop over the states.

    A long one in pieces, since the time that a compiler takes grows faster than the length of what it compiles at once.
    """
    pieces = Pieces(line, scalar, width)
    for k, (operation, *_) in enumerate(line.nodes):
        if operation not in ("input", "const"):
            pieces.compute(k)
    for array, (_, entries) in enumerate(line.outputs.values(), len(line.inputs)):
        for start in range(0, len(entries), width):
            pieces.store(array, start, entries[start : start + width])
    pieces.end()
    return pieces.module()


class Pieces:
    """The pieces of a line, and the memory in which one leaves what the next ones need.

    Parameters
    ----------
    line : Line
    scalar : {"double", "float"}
    width : int
    """

    def __init__(self, line: Line, scalar: str, width: int) -> None:
        self.line, self.width = line, width
        self.text, self.finished = Text(scalar, width), list[Text]()
        self.name: dict[int, str] = {}  # of the nodes that this piece has
        self.slot: dict[int, int] = {}  # of the nodes that later pieces need
        self.free: list[int] = []
        self.slots = 0
        self.longest = PIECE if len(line.nodes) > WHOLE else sys.maxsize
        self.rows: dict[int, list[str]] = {}
        self.last = {}
        for k, node in enumerate(line.nodes):
            self.last.update(dict.fromkeys(operands(node), k))
        stored = len(line.nodes)
        for _, entries in line.outputs.values():
            self.last.update(dict.fromkeys(entries, stored))
        self.places = {node: k for k, node in enumerate(line.nodes) if node[0] in ("input", "sin", "cos")}
        self.arrays = {name: k for k, name in enumerate(line.inputs)}

    def compute(self, k: int) -> None:
        """Write the operation of a node."""
        operation, *needed = self.line.nodes[k]
        if k in self.name or k in self.slot:
            return  # a cosine, with its sine
        values = [self.value(j) for j in needed]
        if operation in ("sin", "cos"):
            both = sine_and_cosine(self.text, *values)
            found = {self.places.get((name, *needed)): value for name, value in zip(("sin", "cos"), both)}
            self.name |= {place: value for place, value in found.items() if place is not None}
        else:
            self.name[k] = self.text.operate(operation, *values)
        if len(self.text.lines) > self.longest:
            self.end(k)

    def value(self, k: int) -> str:
        """Return the name of a node's value in this piece."""
        operation, *rest = self.line.nodes[k]
        if operation == "const":
            return self.text.constant(rest[0])
        if k not in self.name:
            if operation == "input":
                self.load(*rest[0])
            else:
                self.name[k] = self.text.new(f"load {self.text.type}, ptr {self.kept(self.slot[k])}")
        return self.name[k]

    def kept(self, slot: int) -> str:
        """Return where values are kept from one piece to the next."""
        return self.text.new(f"getelementptr {self.text.type}, ptr %kept, i64 {slot}")

    def load(self, name: str, *index: int) -> None:
        """Load an argument's entry, and with it its neighbours: squares of W × W numbers, by rows, and transposed."""
        keys = [*np.ndindex(self.line.inputs[name])]
        start = keys.index(index) // self.width * self.width
        keys = keys[start : start + self.width]
        values = self.text.load(self.row(self.arrays[name]), start, len(keys))
        for key, value in zip(keys, values):
            place = self.places.get(("input", (name, *key)))
            if place is not None:
                self.name[place] = value

    def store(self, array: int, start: int, nodes: Sequence[int]) -> None:
        """Store entries of a result."""
        self.text.store(self.row(array), start, [self.value(k) for k in nodes])
        if len(self.text.lines) > self.longest:
            self.end(len(self.line.nodes) - 1)

    def row(self, array: int) -> list[str]:
        """Return where the states of this turn have their entries of an array."""
        if array not in self.rows:
            self.rows[array] = self.text.rows(array)
        return self.rows[array]

    def end(self, now: int | None = None) -> None:
        """End this piece after node `now`, and keep what is needed later."""
        if now is not None:
            self.free += [self.slot.pop(k) for k in [*self.slot] if self.last[k] <= now]
            for k, value in self.name.items():
                if self.last.get(k, -1) > now and k not in self.slot and self.line.nodes[k][0] != "input":
                    if not self.free:
                        self.free.append(self.slots)
                        self.slots += 1
                    self.slot[k] = self.free.pop()
                    self.text.lines.append(f"store {self.text.type} {value}, ptr {self.kept(self.slot[k])}")
        self.finished.append(self.text)
        self.text, self.name, self.rows = Text(self.text.scalar, self.width), {}, {}

    def module(self) -> str:
        """Return all pieces, and the loop that calls them; its last turn ends with the last state."""
        declared = sorted(set().union(*(text.declared for text in self.finished)))
        arguments = "ptr %table, i64 %state, ptr %kept"
        pieces = [
            f"define internal void @piece{k}({arguments}) {{\n  " + "\n  ".join(text.lines) + "\n  ret void\n}"
            for k, text in enumerate(self.finished)
        ]
        calls = "\n  ".join(f"call void @piece{k}({arguments})" for k in range(len(pieces)))
        loop = LOOP.format(width=self.width, slots=max(1, self.slots), type=self.text.type, calls=calls)
        return "\n".join([*declared, *pieces, loop])


LOOP = """
define void @program(ptr %table, i64 %count) {{
start:
  %kept = alloca {type}, i64 {slots}, align 64
  %last = sub i64 %count, {width}
  br label %turn
turn:
  %state = phi i64 [0, %start], [%next, %turn]
  {calls}
  %following = add i64 %state, {width}
  %beyond = icmp sgt i64 %following, %last
  %next = select i1 %beyond, i64 %last, i64 %following
  %more = icmp slt i64 %following, %count
  br i1 %more, label %turn, label %end
end:
  ret void
}}
"""

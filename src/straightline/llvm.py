"""Machine code from a straight line, by LLVM: one state, or as many at once as a register of the processor holds.

Every operation becomes one instruction of LLVM's language, with the same numbers of W states in one register. All that
is written besides is a loop over the states, the way in and out of memory, and sin, cos and atan2 (`sine`,
`arctangent`). The results are what the operations say, to the last bit.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cache, lru_cache
from typing import Any

import numpy as np

from . import objects
from .arctangent import with_arctangents
from .instructions import InstructionText
from .line import LEAVES, Line
from .number import Array, without_garbage
from .sine import with_series

__all__ = ["NATIVE", "MachineCode", "available", "default_backend", "engine_of", "lanes"]

NATIVE = {np.dtype(np.float64): "double", np.dtype(np.float32): "float"}
"""LLVM's names of the number types that a processor has."""

PIECE = 800  # instructions that are compiled at once

LONG = 750_000
"""Letters of a text for which LLVM assigns registers in its quickest way: what comes out is a few per cent slower."""

MOST_KEPT = 2**17
"""Bytes of values in memory up to which the states of two registers take turns in each piece: its instructions are then
fetched once for both, which takes as long as half of them."""

MAX_ENGINES = 32  # that are remembered in case that the same line is made again
ENGINES: dict[str, Any] = {}  # by the name of the line, the last used at the end

Group = tuple[int, int, Sequence[int]]
"""Results that are stored together: their array, the place of the first one, and their nodes."""


@cache
def available() -> bool:
    """Return whether llvmlite is installed."""
    try:
        import llvmlite.binding  # noqa: F401
    except ImportError:
        return False
    return True


def default_backend(dtype: np.dtype[Any]) -> str:
    """Return what runs lines of a number type: "llvm" where it is installed and has the type, else "numpy"."""
    return "llvm" if dtype in NATIVE and available() else "numpy"


@cache
def register_bits() -> int:
    """Return how long a register for vectors of this processor is."""
    import llvmlite.binding as llvm

    features = llvm.get_host_cpu_features()
    return 512 if features.get("avx512f") else 256 if features.get("avx2") else 128


def lanes(dtype: np.dtype[Any]) -> int:
    """Return how many numbers of a type a register of this processor holds."""
    return register_bits() // (8 * dtype.itemsize)


class MachineCode:
    """A line as machine code, `width` states at once, a power of two: a function of a table and a number of states."""

    def __init__(self, line: Line, dtype: np.dtype[Any], width: int) -> None:
        self._engine = engine_for(line, NATIVE[dtype], width)  # keeps the code alive
        self.address: int = self._engine.get_function_address("program")
        self._call = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int64)(self.address)

    def run(self, arrays: Sequence[Array]) -> None:
        """Fill the results: each array has shape (states, entries), its entries next to each other in memory."""
        table = np.array([(x.ctypes.data, x.strides[0]) for x in arrays], np.int64)
        self._call(table.ctypes.data, len(arrays[0]))


def engine_for(line: Line, scalar: str, width: int) -> Any:
    """Return what holds the machine code of a line: from this process, from the disk (`objects`), or compiled now."""
    key = key_of(line, scalar, width)
    engine = ENGINES.pop(key, None)
    if engine is None:
        code = objects.fetch(key)
        if code is None:
            code = compiled(written(line, scalar, width))
            objects.keep(key, code)
        engine = loaded(code)
    ENGINES[key] = engine
    for forgotten in [*ENGINES][:-MAX_ENGINES]:
        ENGINES.pop(forgotten, None)
    return engine


def key_of(line: Line, scalar: str, width: int) -> str:
    """Return a name for all that the machine code of a line depends on."""
    from hashlib import sha256

    import llvmlite
    import llvmlite.binding as llvm

    versions = sys.version, llvmlite.__version__, llvm.llvm_version_info, objects.own_source()
    processor = llvm.get_default_triple(), llvm.get_host_cpu_name(), sorted(llvm.get_host_cpu_features().items())
    nodes = [tuple(map(_written, node)) for node in line.nodes]
    operations = nodes, [*line.inputs.items()], [*line.outputs.items()]
    text = repr((versions, processor, scalar, width, register_bits(), operations))
    return sha256(text.encode()).hexdigest()


def _written(x: Any) -> Any:
    """Return a fraction as two texts: Python writes no number of more than 4300 digits in tens."""
    return (hex(x.numerator), hex(x.denominator)) if isinstance(x, Fraction) else x


@lru_cache(maxsize=32)  # the same function, made again, has the same text
def engine_of(text: str) -> Any:
    """Return what holds the machine code of a text in LLVM's language, for this processor."""
    return loaded(compiled(text))


def compiled(text: str) -> bytes:
    """Return a text in LLVM's language as an object file for this processor."""
    import llvmlite.binding as llvm

    code: bytes = host(0 if len(text) > LONG else 1).emit_object(llvm.parse_assembly(text))
    return code


def loaded(code: bytes) -> Any:
    """Return what holds the machine code of an object file."""
    import llvmlite.binding as llvm

    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), host(1))
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    return engine


def host(effort: int) -> Any:
    """Return LLVM's description of this processor."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    features = llvm.get_host_cpu_features().flatten()
    name = llvm.get_host_cpu_name()
    return llvm.Target.from_default_triple().create_target_machine(opt=effort, cpu=name, features=features, jit=True)


@without_garbage()
def written(line: Line, scalar: str, width: int) -> str:
    """Return a line as a module of LLVM's language: pieces, and a loop over the states.

    In pieces, since the time that a compiler takes grows faster than the length of what it compiles at once. LLVM is to
    translate each instruction by itself (`optnone`), four times as quickly, which needs constants in memory.
    """
    pieces = Pieces(with_series(with_arctangents(line, scalar), scalar), scalar, width)
    for needed, node, group in pieces.turns:
        if group:
            pieces.store(*group)
        else:
            pieces.compute(node)
        pieces.done(needed)
    pieces.end()
    return pieces.module()


class Pieces:
    """The pieces of a line, and which values are in registers.

    When all registers are taken, the value whose next use is farthest goes to memory (Bélády), and is loaded when it is
    needed again. LLVM would find out itself, in twice the time. In `turns` is what is to be written, after the nodes
    that it needs: each node to compute, each group of results that lie next to each other as soon as they are there.
    """

    def __init__(self, line: Line, scalar: str, width: int) -> None:
        self.line, self.width = line, width
        self.text, self.finished = InstructionText(scalar, width, {}), list[InstructionText]()
        self.name: dict[int, str] = {}  # of the nodes that are in registers
        self.slot: dict[int, int] = {}  # of the nodes that are in memory
        self.free: list[int] = []
        self.slots = 0
        self.registers = 24 if register_bits() == 512 else 12  # of 32 or 16: the others are for what lies between
        self.rows: dict[int, list[str]] = {}
        self.places = {node: k for k, node in enumerate(line.nodes) if node[0] == "input"}
        self.arrays = {name: k for k, name in enumerate(line.inputs)}
        self.turns = [*self._turns()]
        self.uses: dict[int, list[int]] = {}  # of each node the turns that need it, the last first
        for turn in range(len(self.turns) - 1, -1, -1):
            for k in self.turns[turn][0]:
                self.uses.setdefault(k, []).append(turn)
        self.due = {k: turns[-1] for k, turns in self.uses.items()}

    def _turns(self) -> Iterator[tuple[set[int], int, Group | None]]:
        groups = list[Group]()
        for array, (_, entries) in enumerate(self.line.outputs.values(), len(self.line.inputs)):
            groups += [(array, k, entries[k : k + self.width]) for k in range(0, len(entries), self.width)]
        groups.sort(key=lambda group: -max(group[2]))  # the last one is there first
        for k, node in enumerate(self.line.nodes):
            if node[0] not in LEAVES:
                yield {*node[1:]}, k, None
            while groups and max(groups[-1][2]) <= k:
                group = groups.pop()
                yield {*group[2]}, 0, group

    def compute(self, k: int) -> None:
        """Write the operation of a node."""
        operation, *needed = self.line.nodes[k]
        self.name[k] = self.text.operate(operation, *[self.name.get(j) or self.value(j) for j in needed])

    def done(self, needed: Iterable[int]) -> None:
        """End a turn that needed some values."""
        for k in needed:
            uses = self.uses[k]
            uses.pop()
            if uses:
                self.due[k] = uses[-1]
            else:
                self.name.pop(k, None)
                if k in self.slot:
                    self.free.append(self.slot.pop(k))
        if len(self.text.lines) > PIECE:
            self.end()
        while len(self.name) > self.registers:
            self.put_away(max(self.name, key=self.due.__getitem__))

    def put_away(self, k: int) -> None:
        """Move a value from its register to memory, where a constant is anyway."""
        value = self.name.pop(k)
        if k not in self.slot and self.uses.get(k) and self.line.nodes[k][0] != "const":
            if not self.free:
                self.free.append(self.slots)
                self.slots += 1
            self.slot[k] = self.free.pop()
            self.text.lines.append(f"store %V {value}, ptr {self.kept(self.slot[k])}")

    def value(self, k: int) -> str:
        """Return the name of a node's value in this piece."""
        if k in self.name:
            return self.name[k]
        operation, *rest = self.line.nodes[k]
        if operation == "const":
            self.name[k] = self.text.constant(rest[0])
        elif k in self.slot:
            self.name[k] = self.text.new(f"load %V, ptr {self.kept(self.slot[k])}")
        else:
            self.load(*rest[0])
        return self.name[k]

    def kept(self, slot: int) -> str:
        """Return a place in memory."""
        return self.text.new(f"getelementptr %V, ptr %kept, i64 {slot}")

    def load(self, name: str, *index: int) -> None:
        """Load an argument's entry, and with it its neighbours: squares of W × W numbers, by rows, and transposed."""
        keys = [*np.ndindex(self.line.inputs[name])]
        start = keys.index(index) // self.width * self.width
        keys = keys[start : start + self.width]
        values = self.text.load(self.row(self.arrays[name]), start, len(keys))
        for key, value in zip(keys, values):
            place = self.places.get(("input", (name, *key)))
            if place is not None and self.uses.get(place) and place not in self.slot:
                self.name[place] = value

    def store(self, array: int, start: int, nodes: Sequence[int]) -> None:
        """Store entries of a result."""
        self.text.store(self.row(array), start, [self.value(k) for k in nodes])

    def row(self, array: int) -> list[str]:
        """Return where the states of this turn have their entries of an array."""
        if array not in self.rows:
            self.rows[array] = self.text.rows(array)
        return self.rows[array]

    def end(self) -> None:
        """End this piece: what is needed later goes to memory."""
        for k in [*self.name]:
            self.put_away(k)
        self.finished.append(self.text)
        self.text, self.name, self.rows = InstructionText(self.text.scalar, self.width, self.text.constants), {}, {}

    def module(self) -> str:
        """Return all pieces, and the loop that calls them; its last turn ends with the last state."""
        declared = sorted(set().union(*(text.declared for text in self.finished)))
        arguments = "ptr %table, i64 %state, ptr %kept, ptr %constants"
        pieces, calls = [], []
        for k, text in enumerate(self.finished):
            head = f"define internal void @piece{k}({arguments}) optnone noinline {{"
            pieces.append("\n  ".join([head, *text.lines, "ret void\n}"]))
            calls.append(CALL.format(k=k, following=k + 1, before=f"call{k - 1}" if k else "turn"))
        constants = [f"%V {one}" for one in self.text.constants] or ["%V undef"]
        table = f"@constants = internal constant [{len(constants)} x %V] [{', '.join(constants)}]"
        slots = max(1, self.slots)
        together = 2 if self.width > 1 and 2 * slots * self.width * self.text.bytes <= MOST_KEPT else 1
        loop = "".join([LOOP, *calls, END]).format(
            width=self.width, slots=slots, together=together, all=together * slots, k=len(pieces) - 1, end=len(pieces)
        )
        vector = f"<{self.width} x {self.text.scalar}>" if self.width > 1 else self.text.scalar
        return "\n".join([f"%V = type {vector}", *declared, table, *pieces, loop])


LOOP = """
define void @program(ptr %table, i64 %count) {{
start:
  %all = alloca %V, i64 {all}, align 64
  %constants = getelementptr i8, ptr @constants, i64 0
  %last = sub i64 %count, {width}
  br label %turn
turn:
  %first = phi i64 [0, %start], [%following{k}, %call{end}]
  br label %call0
"""

CALL = """call{k}:
  %place{k} = phi i64 [0, %{before}], [%next{k}, %call{k}]
  %done{k} = mul i64 %place{k}, {{width}}
  %wanted{k} = add i64 %first, %done{k}
  %beyond{k} = icmp sgt i64 %wanted{k}, %last
  %state{k} = select i1 %beyond{k}, i64 %last, i64 %wanted{k}
  %start{k} = mul i64 %place{k}, {{slots}}
  %kept{k} = getelementptr %V, ptr %all, i64 %start{k}
  call void @piece{k}(ptr %table, i64 %state{k}, ptr %kept{k}, ptr %constants)
  %next{k} = add i64 %place{k}, 1
  %following{k} = add i64 %wanted{k}, {{width}}
  %left{k} = icmp slt i64 %following{k}, %count
  %room{k} = icmp slt i64 %next{k}, {{together}}
  %again{k} = and i1 %left{k}, %room{k}
  br i1 %again{k}, label %call{k}, label %call{following}
"""

END = """call{end}:
  br i1 %left{k}, label %turn, label %end
end:
  ret void
}}
"""

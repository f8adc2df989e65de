"""Instructions of LLVM's language, each for the same number of W states at once."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np

__all__ = ["InstructionText"]

INTRINSICS = {"sqrt": "sqrt", "fma": "fma", "round": "roundeven"}

ALL_BUT_THE_SIGN = {"double": 0x7FFFFFFFFFFFFFFF, "float": 0x7FFFFFFFE0000000}
"""Bits of a number, as LLVM writes them: those of the double with the same value."""


class InstructionText:
    """Instructions for `width` states at once, of type ``%V``; `constants` are in memory at ``%constants``, and where.

    A value has a number: LLVM reads it in half the time of a name.
    """

    def __init__(self, scalar: str, width: int, constants: dict[str, int] | None = None) -> None:
        self.scalar, self.width = scalar, width
        self.bytes = 8 if scalar == "double" else 4
        self.lines: list[str] = []
        self.count = 0
        self.declared: set[str] = set()
        self.constants = {} if constants is None else constants

    def new(self, instruction: str) -> str:
        """Write an instruction, and return the name of its result."""
        self.count += 1
        name = f"%{self.count}"
        self.lines.append(f"{name} = {instruction}")
        return name

    def constant(self, x: Any) -> str:
        """Write the load of a constant, rounded to the number type."""
        rounded = float(x) if self.scalar == "double" else float(np.float32(float(x)))
        return self.bits("%V", struct.unpack("<Q", struct.pack("<d", rounded))[0])

    def bits(self, kind: str, bits: int) -> str:
        """Write the load of a constant of these bits, of a double."""
        same = f"0x{bits:016X}" if self.width == 1 else f"<{', '.join([f'{self.scalar} 0x{bits:016X}'] * self.width)}>"
        place = self.constants.setdefault(same, len(self.constants))
        return self.new(f"load {kind}, ptr {self.new(f'getelementptr %V, ptr %constants, i64 {place}')}")

    def operate(self, operation: str, *operands: str) -> str:
        """Write an operation of a line."""
        if operation in ("add", "sub", "mul", "div"):
            return self.new(f"f{operation} %V {operands[0]}, {operands[1]}")
        if operation == "neg":
            return self.new(f"fsub %V {self.constant(-0.0)}, {operands[0]}")
        if operation == "abs":  # LLVM's own would load the mask in two instructions
            whole = f"i{8 * self.bytes}" if self.width == 1 else f"<{self.width} x i{8 * self.bytes}>"
            mask = self.bits(whole, ALL_BUT_THE_SIGN[self.scalar])
            same = self.new(f"bitcast %V {operands[0]} to {whole}")
            return self.new(f"bitcast {whole} {self.new(f'and {whole} {same}, {mask}')} to %V")
        if operation == "select":
            above = self.new(f"fcmp ogt %V {operands[0]}, zeroinitializer")
            flags = "i1" if self.width == 1 else f"<{self.width} x i1>"
            return self.new(f"select {flags} {above}, %V {operands[1]}, %V {operands[2]}")
        kind = ("" if self.width == 1 else f"v{self.width}") + f"f{8 * self.bytes}"
        function = f"%V @llvm.{INTRINSICS[operation]}.{kind}"
        self.declared.add(f"declare {function}({', '.join(['%V'] * len(operands))})")
        return self.new(f"call {function}({', '.join(f'%V {x}' for x in operands)})")

    # ---------------------------------------------------------------- memory

    def rows(self, k: int) -> list[str]:
        """Return where each of the states of this turn has its entries in array k of the table."""
        pointer = self.new(f"getelementptr i64, ptr %table, i64 {2 * k}")
        stride = self.new(f"getelementptr i64, ptr %table, i64 {2 * k + 1}")
        start, step = self.new(f"load ptr, ptr {pointer}"), self.new(f"load i64, ptr {stride}")
        rows = []
        for lane in range(self.width):
            state = self.new(f"add i64 %state, {lane}")
            offset = self.new(f"mul i64 {state}, {step}")
            rows.append(self.new(f"getelementptr i8, ptr {start}, i64 {offset}"))
        return rows

    def load(self, rows: list[str], start: int, count: int) -> list[str]:
        """Return up to W entries of all states."""
        if count == self.width:
            places = [self.entry(row, start) for row in rows]
            return self.transposed([self.new(f"load %V, ptr {p}, align {self.bytes}") for p in places])
        values = []
        for k in range(start, start + count):
            value = "undef"
            for lane, row in enumerate(rows):
                value = self.insert(value, self.new(f"load {self.scalar}, ptr {self.entry(row, k)}"), lane)
            values.append(value)
        return values

    def store(self, rows: list[str], start: int, values: list[str]) -> None:
        """Store up to W entries: the way of `load` back."""
        if len(values) == self.width:
            for row, x in zip(rows, self.transposed(values)):
                self.lines.append(f"store %V {x}, ptr {self.entry(row, start)}, align {self.bytes}")
            return
        for k, value in enumerate(values, start):
            for lane, row in enumerate(rows):
                self.lines.append(f"store {self.scalar} {self.extract(value, lane)}, ptr {self.entry(row, k)}")

    def insert(self, values: str, one: str, lane: int) -> str:
        """Put a number into a register."""
        return one if self.width == 1 else self.new(f"insertelement %V {values}, {self.scalar} {one}, i32 {lane}")

    def extract(self, values: str, lane: int) -> str:
        """Take a number out of a register."""
        return values if self.width == 1 else self.new(f"extractelement %V {values}, i32 {lane}")

    def entry(self, row: str, k: int) -> str:
        """Return where entry k of a row is."""
        return self.new(f"getelementptr {self.scalar}, ptr {row}, i64 {k}")

    def transposed(self, rows: list[str]) -> list[str]:
        """Transpose W vectors of W entries, in log2 W rounds: the off-diagonal halves of each square change places."""
        W, half = self.width, 1
        while half < W:
            turned = [*rows]
            for k in (k for k in range(W) if not k & half):
                low = [j - half + W if j & half else j for j in range(W)]
                high = [j + W if j & half else j + half for j in range(W)]
                for place, choice in ((k, low), (k + half, high)):
                    mask = ", ".join(f"i32 {j}" for j in choice)
                    pair = f"%V {rows[k]}, %V {rows[k + half]}"
                    turned[place] = self.new(f"shufflevector {pair}, <{W} x i32> <{mask}>")
            rows, half = turned, 2 * half
        return rows

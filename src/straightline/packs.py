"""What NumPy can do in one call: the same operation in several limbs.

Some lines do the same several times over with different numbers: that of a quadruped has four legs, and the operations
of one are those of each other. Such operations are the lanes of a pack: k numbers that lie one after the other in
memory, for all states. Operands of a pack should be packs too, in the same order, since numbers that must first be
brought together cost as much as the operation. So packs are made from the results back to the arguments:
superword-level parallelism (S. Larsen and S. Amarasinghe, 2000).

Operations are alike if they are the same function of operands that are alike, and belong to different limbs if they
depend on different arguments.

>>> import numpy as np
>>> from straightline.number import Tape, numbers
>>> tape = Tape()
>>> q = numbers(tape, "q", 5)
>>> line = Line.of(tape, {"q": (5,)}, {"result": q[1:].copy() * np.array([3, 5, 7, 9]) + q[0]})
>>> [(line.nodes[pack[0]][0], len(pack)) for pack in Packs(line).packs]
[('add', 4), ('mul', 4), ('input', 5)]
"""

from __future__ import annotations

from functools import reduce
from itertools import chain, count, zip_longest
from operator import or_
from typing import Any

from .line import Line, operands

__all__ = ["Packs", "View"]

View = tuple[int, int, int]  # lanes of a pack: its number, the first lane, and the step to the next one

MIN_LANES = 4
"""Lanes that are worth a pack: fewer calls are as quick as one whose operands do not all lie next to each other."""


class Packs:
    """The operations of a line, put together.

    In `packs` are the nodes of each pack, lane by lane, also what is needed of the arguments; a node can be in several.
    In `operands` are those of each pack: nodes lane by lane, or one node that all lanes share.
    """

    def __init__(self, line: Line) -> None:
        self.nodes = line.nodes
        self.packs: list[tuple[int, ...]] = []
        self.operands: list[list[tuple[int, ...]]] = []
        self._places: dict[int, list[tuple[int, int]]] = {}  # of each node the packs that it is in, and the lanes
        self._describe()
        self._wanted: list[set[tuple[int, ...]]] = [set() for _ in range(1 + max(self._kind, default=0))]
        for k in line.results:
            self._want((k,))
        for wanted in reversed(self._wanted):  # what needs a kind has a higher number
            self._arrange(wanted)

    def _describe(self) -> None:
        """Find of each node its kind, its operands in the order of their kinds, and on which arguments it depends."""
        self._ordered: list[tuple[int, ...]] = []
        self._kind: list[int] = []
        self._limb: list[int] = []
        numbers: dict[tuple[Any, ...], int] = {}
        inputs = count()
        for node in self.nodes:
            needed = operands(node)
            if node[0] in ("add", "mul"):
                needed = tuple(sorted(needed, key=lambda j: (self._kind[j], j)))
            kind = node[1][:1] if node[0] == "input" else (node[0], *(self._kind[j] for j in needed))
            self._kind.append(numbers.setdefault(kind, len(numbers)))
            self._ordered.append(needed)
            own = 1 << next(inputs) if node[0] == "input" else 0
            self._limb.append(reduce(or_, (self._limb[j] for j in needed), own))

    def _want(self, lanes: tuple[int, ...]) -> None:
        if self.nodes[lanes[0]][0] != "const":
            self._wanted[self._kind[lanes[0]]].add(lanes)

    def _arrange(self, wanted: set[tuple[int, ...]]) -> None:
        """Enter packs of one kind, such that whatever is wanted of it is in one of them."""
        if wanted and self.nodes[min(wanted)[0]][0] == "input":
            self._enter(tuple(sorted({*chain(*wanted)}, key=lambda k: self.nodes[k][1])))
        for lanes in sorted(wanted, key=lambda lanes: (-len(lanes), lanes)):
            if len(lanes) > 1 and self.view(lanes) is None:
                self._enter(lanes)
        limbs: dict[int, list[int]] = {}
        for (k,) in sorted(lanes for lanes in wanted if len(lanes) == 1):
            if k not in self._places:
                limbs.setdefault(self._limb[k], []).append(k)
        alone = (
            [limbs[limb] for limb in sorted(limbs)] if len(limbs) > 1 else [[k] for ks in limbs.values() for k in ks]
        )
        for one_each in zip_longest(*alone):
            lanes = tuple(k for k in one_each if k is not None)
            for part in [lanes] if len(lanes) >= MIN_LANES else [(k,) for k in lanes]:
                self._enter(part)

    def _enter(self, lanes: tuple[int, ...]) -> None:
        for lane, k in enumerate(lanes):
            self._places.setdefault(k, []).append((len(self.packs), lane))
        needed = [lanes if len({*lanes}) > 1 else lanes[:1] for lanes in zip(*(self._ordered[k] for k in lanes))]
        self.packs.append(lanes)
        self.operands.append(needed)
        for one in needed:
            self._want(one)

    def view(self, lanes: tuple[int, ...]) -> View | None:
        """Return where these nodes lie evenly in a pack, if they do."""
        for pack, start in self._places.get(lanes[0], ()):
            if len(lanes) == 1:
                return pack, start, 1
            for other, second in self._places.get(lanes[1], ()):
                step = second - start
                if other == pack and step > 0 and self.packs[pack][start::step][: len(lanes)] == lanes:
                    return pack, start, step
        return None

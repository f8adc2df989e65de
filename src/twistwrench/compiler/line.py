"""The straight line: what is left of a recursion when only what the question needs is kept."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..arrays import Array
from .number import Node, Tape

__all__ = ["Line", "Output", "needed", "operands", "ordered"]

DEEPEST = 8
"""How deep operations stand within each other in a text, at most."""

LEAVES = ("input", "const")

Output = tuple[tuple[int, ...], tuple[int, ...]]
"""The shape of a result, and the node of each of its entries."""


@dataclass(frozen=True, eq=False, repr=False)
class Line:
    """Operations one after the other, without a loop and without a condition.

    Attributes
    ----------
    nodes : tuple of tuple
        ("input", (name, index, …)), ("const", Fraction), or (operation, operands, …) with the indices of earlier nodes.
    inputs : mapping of str to tuple of int
        The shape of each argument.
    outputs : mapping of str to Output
    notes : tuple
        Of each node, where the tape took notes: the step of the chapter that it belongs to.
    """

    nodes: tuple[Node, ...]
    inputs: Mapping[str, tuple[int, ...]]
    outputs: Mapping[str, Output]
    notes: tuple[Any, ...] = ()

    @classmethod
    def of(
        cls,
        tape: Tape,
        inputs: Mapping[str, tuple[int, ...]],
        results: Mapping[str, Array],
        wanted: Iterable[Any] | None = None,
    ) -> Line:
        """Keep of a tape what the results depend on.

        If numbers are wanted one after the other, each operation is just before it is first needed: so that fewer
        numbers are waiting at any time.
        """
        outputs = {
            name: (result.shape, tuple(tape.number(x).index for x in result.flat)) for name, result in results.items()
        }
        every = [k for _, entries in outputs.values() for k in entries]
        if wanted is None:
            return cls._reduced(tape.nodes, tape.notes, inputs, outputs, needed(tape.nodes, every))
        order = ordered([*(tape.number(x).index for x in wanted), *every], lambda k: operands(tape.nodes[k]))
        return cls._reduced(tape.nodes, tape.notes, inputs, outputs, order)

    def without(self, name: str) -> Line:
        """Return what is left where a result is not asked for."""
        outputs = {other: output for other, output in self.outputs.items() if other != name}
        wanted = [k for _, entries in outputs.values() for k in entries]
        return self._reduced(self.nodes, self.notes, self.inputs, outputs, needed(self.nodes, wanted))

    @classmethod
    def _reduced(
        cls,
        nodes: Sequence[Node],
        notes: Sequence[Any],
        inputs: Mapping[str, tuple[int, ...]],
        outputs: Mapping[str, Output],
        order: Iterable[int],
    ) -> Line:
        """Return a line of some nodes, in an order in which operands come before what needs them."""
        kept = [*order]
        new = {old: k for k, old in enumerate(kept)}
        renumbered = tuple(_renumbered(nodes[old], new) for old in kept)
        renamed = {name: (shape, tuple(new[k] for k in entries)) for name, (shape, entries) in outputs.items()}
        return cls(renumbered, dict(inputs), renamed, tuple(notes[old] for old in kept) if notes else ())

    @cached_property
    def inner(self) -> frozenset[int]:
        """The nodes that only one other operation needs, of the same step: as text they stand within that one."""
        users: dict[int, list[int]] = {}
        for k, node in enumerate(self.nodes):
            for needed in operands(node):
                users.setdefault(needed, []).append(k)
        results = {*self.results}
        depth: dict[int, int] = {}
        for k, node in enumerate(self.nodes):
            depth[k] = 1 + max((depth.get(j, 0) for j in operands(node)), default=0)
            alone = len(users.get(k, ())) == 1 and k not in results and node[0] not in LEAVES
            if not (alone and depth[k] <= DEEPEST and (not self.notes or self.notes[k] == self.notes[users[k][0]])):
                depth[k] = 0
        return frozenset(k for k, size in depth.items() if size)

    @property
    def results(self) -> list[int]:
        """The nodes of all results, entry by entry."""
        return [k for _, entries in self.outputs.values() for k in entries]

    @property
    def operations(self) -> Counter[str]:
        """How many operations there are, by kind."""
        return Counter(node[0] for node in self.nodes if node[0] not in LEAVES)


def needed(nodes: Sequence[Node], wanted: Iterable[int], ends: Container[int] = ()) -> list[int]:
    """Return the nodes on which some depend, in their order, but not those on which only the ends depend."""
    found = bytearray(len(nodes))
    for k in wanted:
        found[k] = 1
    for k in range(len(nodes) - 1, -1, -1):
        if found[k] and k not in ends:
            for j in operands(nodes[k]):
                found[j] = 1
    return [k for k, one in enumerate(found) if one]


def ordered(wanted: Sequence[int], needs: Callable[[int], Sequence[int]]) -> Iterator[int]:
    """Yield what some need, and them, each just before it is first needed if the wanted are computed in this order."""
    done = set[int]()
    left = [(k, False) for k in reversed(wanted)]
    while left:
        k, ready = left.pop()
        if k not in done:
            if ready:
                done.add(k)
                yield k
            else:
                left += [(k, True), *((j, False) for j in reversed(needs(k)))]


def operands(node: Node) -> tuple[int, ...]:
    """Return the nodes that an operation needs."""
    return () if node[0] in LEAVES else node[1:]


def _renumbered(node: Node, new: Mapping[int, int]) -> Node:
    return node if node[0] in LEAVES else (node[0], *map(new.__getitem__, node[1:]))

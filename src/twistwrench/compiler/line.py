"""The straight line: what is left of a recursion when only what the question needs is kept."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ..arrays import Array
from .number import Node, Tape

__all__ = ["Line", "Output", "operands"]

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
    """

    nodes: tuple[Node, ...]
    inputs: Mapping[str, tuple[int, ...]]
    outputs: Mapping[str, Output]

    @classmethod
    def of(cls, tape: Tape, inputs: Mapping[str, tuple[int, ...]], results: Mapping[str, Array]) -> Line:
        """Keep of a tape what the results depend on."""
        indices = {name: [tape.number(x).index for x in result.flat] for name, result in results.items()}
        needed = _needed(tape.nodes, [k for result in indices.values() for k in result])
        new = {old: k for k, old in enumerate(needed)}
        nodes = tuple(_renumbered(tape.nodes[old], new) for old in needed)
        outputs = {name: (results[name].shape, tuple(new[k] for k in result)) for name, result in indices.items()}
        return cls(nodes, dict(inputs), outputs)

    def in_order_of(self, wanted: Iterable[int]) -> Line:
        """Return the same line, each operation just before it is first needed if the wanted are computed in this order.

        So that fewer numbers are waiting at any time.
        """
        new: dict[int, int] = {}
        left = [(k, False) for k in [*wanted, *(k for _, entries in self.outputs.values() for k in entries)][::-1]]
        while left:
            k, ready = left.pop()
            if k in new:
                continue
            if ready:
                new[k] = len(new)
            else:
                left += [(k, True), *((j, False) for j in reversed(operands(self.nodes[k])))]
        nodes = tuple(_renumbered(self.nodes[k], new) for k in new)
        outputs = {name: (shape, tuple(new[k] for k in entries)) for name, (shape, entries) in self.outputs.items()}
        return Line(nodes, self.inputs, outputs)

    @property
    def operations(self) -> Counter[str]:
        """How many operations there are, by kind."""
        return Counter(node[0] for node in self.nodes if node[0] not in ("input", "const"))


def _needed(nodes: list[Node], wanted: list[int]) -> list[int]:
    """Return the nodes on which some depend, in their order."""
    needed, left = set(), list(wanted)
    while left:
        k = left.pop()
        if k not in needed:
            needed.add(k)
            left += operands(nodes[k])
    return sorted(needed)


def operands(node: Node) -> tuple[int, ...]:
    """Return the nodes that an operation needs."""
    return () if node[0] in ("input", "const") else node[1:]


def _renumbered(node: Node, new: Mapping[int, int]) -> Node:
    return node if node[0] in ("input", "const") else (node[0], *(new[k] for k in node[1:]))

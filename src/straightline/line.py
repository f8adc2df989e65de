"""The straight line: what is left of a function when only what its results need is kept."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from .number import Array, Node, Number, Tape

__all__ = ["Line", "Output", "needed", "operands", "ordered", "rewritten"]

DEEPEST = 8  # how deep operations stand within each other in a text, at most

LEAVES = ("input", "const")

Output = tuple[tuple[int, ...], tuple[int, ...]]  # the shape of a result, and the node of each of its entries


@dataclass(frozen=True, eq=False, repr=False)
class Line:
    """Operations one after the other, without a loop and without a condition: see `Node`.

    `inputs` has the shape of each argument; `notes` that of each node, where the tape took notes.
    """

    nodes: Sequence[Node]
    inputs: Mapping[str, tuple[int, ...]]
    outputs: Mapping[str, Output]
    notes: Sequence[Any] = ()

    @classmethod
    def whole(cls, tape: Tape, inputs: Mapping[str, tuple[int, ...]], results: Mapping[str, Array]) -> Line:
        """Return all that is on a tape."""
        outputs = {name: (result.shape, tuple(map(tape.node, result.flat))) for name, result in results.items()}
        return cls(tape.nodes, dict(inputs), outputs, tape.notes)

    @classmethod
    def of(cls, tape: Tape, inputs: Mapping[str, tuple[int, ...]], results: Mapping[str, Array]) -> Line:
        """Keep of a tape what the results depend on."""
        return cls.whole(tape, inputs, results).reduced()

    def without(self, name: str) -> Line:
        """Return what is left where a result is not asked for."""
        return replace(self, outputs={other: self.outputs[other] for other in self.outputs if other != name}).reduced()

    def reduced(self) -> Line:
        """Return it without what no result needs."""
        kept, new = needed(self.nodes, self.results), [0] * len(self.nodes)
        for k, old in enumerate(kept):
            new[old] = k
        nodes = [renumbered(self.nodes[old], new) for old in kept]
        outputs = {name: (shape, tuple([new[k] for k in entries])) for name, (shape, entries) in self.outputs.items()}
        return Line(tuple(nodes), self.inputs, outputs, tuple(self.notes[old] for old in kept) if self.notes else ())

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
        if found[k] and nodes[k][0] not in LEAVES and k not in ends:
            for j in nodes[k][1:]:
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


def rewritten(line: Line, rules: Mapping[str, Callable[..., Any]]) -> Line:
    """Return a line in which some functions are written as other operations."""
    tape, index = Tape(), list[int]()
    for node in line.nodes:
        if node[0] in rules:
            index.append(tape.node(rules[node[0]](*[Number(tape, index[k]) for k in node[1:]])))
        else:
            index.append(tape.places[renumbered(node, index)])
    outputs = {name: (shape, tuple([index[k] for k in entries])) for name, (shape, entries) in line.outputs.items()}
    return Line(tape.nodes, line.inputs, outputs)


def renumbered(node: Node, index: Sequence[int]) -> Node:
    """Return an operation whose operands have other indices."""
    if len(node) == 3:
        return node[0], index[node[1]], index[node[2]]
    return node if node[0] in LEAVES else (node[0], *[index[k] for k in node[1:]])


def operands(node: Node) -> tuple[int, ...]:
    """Return the nodes that an operation needs."""
    return () if node[0] in LEAVES else node[1:]

"""What docs/compile.md shows: how long the straight lines are, what each rule saves, and how long they run.

python benchmarks/programs.py            # count and time, about a minute; writes to results/ and into the page
python benchmarks/programs.py --counts   # only count: the times stay, and the processor that they were taken on
python benchmarks/programs.py --tables   # only make the tables anew from results/
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import argparse
import json
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
from speed import environment
from study.speed import random_states
from tables import table, write

import twistwrench as tw
from straightline.line import LEAVES, Line
from straightline.number import Node, Number, Tape
from twistwrench.fast import recording
from twistwrench.fast.program import Program
from twistwrench.timing import round_robin

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "programs.json"
PAGES = tuple(HERE.parent / "docs" / f"compile{suffix}.md" for suffix in ("", ".zh-CN"))

WANTED = ("rnea", "aba", "crba")
LINKS = (5, 10, 20, 40)
BATCH = 1000

Cells = list[tuple[str, str, int]]


# ------------------------------------------------------------- over the length of a chain


def chains() -> Cells:
    """Return for chains of several lengths how many operations each recursion takes."""
    return [(f"`{want}`", f"{n} links", count(tw.chain(n), want)) for want in WANTED for n in LINKS]


def count(model: tw.Model, want: str, **given: Any) -> int:
    """Return the number of operations of a program."""
    return tw.compile(model, want, **given).operations.total()


# ------------------------------------------------------------- without one of the rules


class NoFingerprints(Tape):
    """Takes for different what looks different."""


class Anew(dict[Node, int]):
    """Indices of nodes, of which only the leaves are known again."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []

    def __missing__(self, node: Node) -> int:
        self.nodes.append(node)
        index = len(self.nodes) - 1
        return self.setdefault(node, index) if node[0] in LEAVES else index


class NothingShared(NoFingerprints):
    """Enters every operation anew, also one that is there."""

    def __init__(self, note: Callable[[], Any] | None = None) -> None:
        super().__init__(note)
        self.places = Anew()

    @property
    def nodes(self) -> list[Node]:
        """All operations."""
        return self.places.nodes


class ZerosKept(NoFingerprints):
    """Multiplies by 0 and by 1."""

    def scaled(self, c: Fraction, a: int) -> int:
        """Return the index of c a."""
        return self.places["mul", self.constant(c), a]


class SignsKept(NoFingerprints):
    """Leaves a sign where it arises."""


def add_everything(self: Number, other: Any, add: Callable[..., Any] = Number.__add__) -> Any:
    """Return the sum, of zeros too."""
    return add(self, self.tape.number(other)) if isinstance(other, Number | Fraction | int) else NotImplemented


def multiply_everything(self: Number, other: Any) -> Any:
    """Return the product, with zeros and ones too."""
    if not isinstance(other, Number | Fraction | int):
        return NotImplemented
    other = self.tape.number(other)
    return Number(self.tape, self.tape.places["mul", self.index, other.index], self.minus != other.minus)


def negate(self: Number) -> Number:
    """Return the negative, by an operation."""
    return self.tape.apply("neg", self)


@contextmanager
def recorded_on(tape: type[Tape]) -> Iterator[None]:
    """Record on another tape."""
    with ExitStack() as stack:
        stack.enter_context(patch.object(recording, "Tape", tape))
        if issubclass(tape, NoFingerprints):  # which would find again what another rule lets go
            stack.enter_context(patch.object(recording, "each_once", Line.reduced))
        if tape is ZerosKept:
            for name in ("__add__", "__radd__"):
                stack.enter_context(patch.object(Number, name, add_everything))
            for name in ("__mul__", "__rmul__"):
                stack.enter_context(patch.object(Number, name, multiply_everything))
        if tape is SignsKept:
            stack.enter_context(patch.object(Number, "__neg__", negate))
        yield


RULES: dict[str, type[Tape]] = {
    "all rules": Tape,
    "no fingerprints": NoFingerprints,
    "0 and 1 kept": ZerosKept,
    "nothing shared": NothingShared,
    "signs kept": SignsKept,
}


def rules() -> Cells:
    """Return how many operations Go2 takes without one of the rules; and with the frames of its links turned."""
    go2 = tw.load("go2")
    cells: Cells = []
    for name, tape in RULES.items():
        with recorded_on(tape):
            cells += [(name, f"`{want}`", count(go2, want)) for want in WANTED]
    for name, what in (("S", "axes"), ("X", "placements"), ("I", "inertias")):
        full = without_zeros(go2, what)
        cells += [(f"no zero in {name}", f"`{want}`", count(full, want)) for want in WANTED]
    return cells


def without_zeros(model: tw.Model, what: str) -> tw.Model:
    """Return a model with the same tree whose axes, placements or inertias have no entry that is 0.

    It is another robot: only the number of its operations is looked at.
    """
    rng = np.random.default_rng(0)

    def somewhere() -> tw.SE3:
        return tw.SE3(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3))

    if what == "placements":
        return replace(model, placement=(model.placement[0], *(somewhere() for _ in model.placement[1:])))
    if what == "inertias":
        return replace(model, inertia=(model.inertia[0], *(I.transform(somewhere()) for I in model.inertia[1:])))
    axes = [tw.Revolute(rng.standard_normal(3)) if isinstance(one, tw.Revolute) else one for one in model.joints]
    return replace(model, joints=tuple(axes))


# ------------------------------------------------------------- scenes


HELD = {"go2": ["R*"], "talos_reduced": ["arm_*", "gripper_*", "head_*"], "panda": ["panda_finger_joint*"]}
"""Joints that stand still: of Go2 those of the two hind legs."""

ALONE = ("gravity", "nonlinear_effects", "center_of_mass", "centroidal_momentum", "centroidal_map")
TOGETHER = ("M", "h", "A_G")


def scenes(robot: str) -> Iterator[tuple[str, tw.Model, dict[str, Any]]]:
    """Yield for a robot what is asked of it: in words, the model and what is given."""
    model = tw.load(robot)
    rest = {"v": np.zeros(model.nv)}
    yield "whole robot", model, {}
    yield "some joints held", tw.lock_joints(model, HELD[robot], model.neutral()).model, {}
    yield "v = 0", model, {"given": rest}
    yield "no gravity", replace(model, gravity=np.zeros(3)), {}
    if model.base == "floating":
        yield "fixed base", tw.load(robot, base="fixed"), {}


def over_scenes(times: dict[tuple[str, str, str], float]) -> list[dict[str, Any]]:
    """Return for every robot, scene and quantity how many operations there are, and the time for a state of 1000.

    The times are taken where none are given.
    """
    found: list[dict[str, Any]] = []
    for robot in HELD:
        programs = {
            (scene, want): tw.compile(model, want, **given) for scene, model, given in scenes(robot) for want in WANTED
        }
        model = tw.load(robot)
        programs |= {("alone", want): tw.compile(model, want) for want in ALONE}
        programs["together", ", ".join(TOGETHER)] = tw.compile(model, TOGETHER)
        if not times:
            laps = round_robin([prepared(program) for program in programs.values()], rounds=7, least=0.004)
            taken = [1e6 * float(np.median(lap.seconds)) / BATCH for lap in laps]
        else:
            taken = [times[robot, scene, want] for scene, want in programs]
        for (scene, want), program, us in zip(programs, programs.values(), taken, strict=True):
            row: dict[str, Any] = {"robot": robot, "scene": scene, "want": want, "nv": program.model.nv}
            found.append(row | {"operations": program.operations.total(), "us": us})
    return found


def prepared(program: Program) -> Callable[[], object]:
    """Return a call of a program with 1000 states."""
    s = random_states(program.model, BATCH)
    values = {"q": s.q, "v": s.v, "a": s.a, "tau": s.a}
    args = [values[name] for name in program.arguments if name in values]
    return lambda: program(*args)


# ------------------------------------------------------------- the page


def tables() -> dict[str, str]:
    """Return all tables by name."""
    found = json.loads(RESULTS.read_text(encoding="utf-8"))
    rows = [row for row in found["scenes"] if row["want"] in WANTED]
    alone = [row for row in found["scenes"] if row["want"] not in WANTED]

    def cell(row: dict[str, Any]) -> str:
        return f"{row['operations']}, {1000 * row['us']:.0f} ns"

    def name(row: dict[str, Any]) -> str:
        return row["robot"].removesuffix("_reduced")

    return {
        "chains": table((line, column, str(n)) for line, column, n in [*found["chains"], *growths(found["chains"])]),
        "rules": table((line, column, str(n)) for line, column, n in found["rules"]),
        "scenes": table((f"{name(row)}, {row['scene']}", f"`{row['want']}`", cell(row)) for row in rows),
        "quantities": table((f"`{row['want']}`", name(row), cell(row)) for row in alone),
    }


def growths(cells: Cells) -> Iterator[tuple[str, str, str]]:
    """Yield the power of the number of links with which each count grows, between the two longest chains."""
    counts = {(want, links): n for want, links, n in cells}
    for want in WANTED:
        few, many = (counts[f"`{want}`", f"{n} links"] for n in LINKS[-2:])
        yield f"`{want}`", "power", f"{np.log2(many / few):.2f}"


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description="Make the numbers and the tables of docs/compile.md.")
    parser.add_argument("--counts", action="store_true", help="only the numbers of operations; the times stay")
    parser.add_argument("--tables", action="store_true", help="only the tables, from results/")
    asked = parser.parse_args()
    if not asked.tables:
        command = " ".join(["python", "benchmarks/programs.py", *sys.argv[1:]])
        known = json.loads(RESULTS.read_text(encoding="utf-8")) if asked.counts else environment(command)
        times = {(row["robot"], row["scene"], row["want"]): row["us"] for row in known.get("scenes", ())}
        found = {**known, "chains": chains(), "rules": rules(), "scenes": over_scenes(times)}
        RESULTS.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    write(PAGES, tables())


if __name__ == "__main__":
    main()

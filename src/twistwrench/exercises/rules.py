"""The ways that an exercise rules out: calls that it forbids, the reference itself, a result that is written down."""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module
from inspect import unwrap
from pathlib import Path
from types import FrameType
from typing import Any

from .changes.crosses import nodes_of
from .changes.places import unused
from .changes.written import text_written
from .exercise import Part
from .words.text import Text

__all__ = ["FORBIDDEN", "Calls", "file_or_cell", "is_ours", "watching", "written_down"]

FORBIDDEN: dict[str, tuple[str, ...]] = {
    "base_wrench_at_rest": ("rnea", "rnea_terms", "gravity", "nonlinear_effects", "dynamics"),
    "mass_matrix_by_rnea": ("crba", "crba_terms", "dynamics", "inverse_mass_matrix", "kinetic_energy", "ltdl"),
    "base_block": ("crba", "crba_terms", "rnea", "rnea_terms", "dynamics"),
    "on_all_rows": ("selection_matrix",),
    "momentum_of_links": ("centroidal_map", "centroidal_momentum", "centroidal_terms", "dynamics"),
    "own_centroidal_map": ("centroidal_map", "centroidal_momentum", "centroidal_terms", "dynamics"),
    "map_from_pinocchio": ("from_pinocchio_model", "centroidal_map", "centroidal_terms", "dynamics"),
    "jacobian_from_pinocchio": ("from_pinocchio_model", "frame_jacobian", "dynamics"),
    "acceleration_from_pinocchio": ("from_pinocchio_model", "aba", "aba_terms", "crba", "rnea", "dynamics"),
}
"""What the text of an exercise forbids, by the function that the student writes: names of the package."""

COMPUTED = {"about_center_of_mass": 1}
"""Which argument a result is computed from, though its value does not depend on it, by the name of the function."""

SAY = {
    "written down": Text(
        "The numbers are right, but {name} is not used: the exercise asks to compute them, not to write them down.",
        "数值正确，但没有用到 {name}：题目要求算出结果，而不是直接写出。",
    ),
    "forbidden": Text(
        "The numbers are right, but line {line} calls {name}, and the exercise asks to do without it.",
        "数值正确，但第 {line} 行调用了 {name}，而题目要求不用它。",
    ),
    "reference": Text(
        "The numbers are right, but they are those of the reference, which it calls: write {name} yourself.",
        "数值正确，但它调用的就是参考实现：请自己写出 {name}。",
    ),
}


class Calls:
    """What a student's function called that it must not; `lines` is the message, empty where there is nothing."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.found: dict[str, int] = {}

    @property
    def lines(self) -> list[Text]:
        """The message."""
        if self.name in self.found:
            return [SAY["reference"].fill(name=self.name)]
        return [SAY["forbidden"].fill(name=name, line=line) for name, line in self.found.items()][:1]


def written_down(part: Part, function: Callable[..., Any]) -> list[Text]:
    """Report that a student's function does not use the argument that its result is to be computed from."""
    if part.name not in COMPUTED:
        return []
    defined = [x for x in nodes_of(text_written(function)) if isinstance(x, ast.FunctionDef) and x.name == part.name]
    given = [(x, argument.arg) for x in defined for argument in x.args.args[COMPUTED[part.name] :][:1]]
    return [SAY["written down"].fill(name=name) for x, name in given if name in unused(x)]


def is_ours(file: str) -> bool:
    """Whether a file is in this package, in NumPy or in another library, and not the student's."""
    own = str(Path(__file__).parents[1]) in file or "site-packages" in file
    return own or (file.startswith("<") and not file.startswith("<ipython"))


def file_or_cell(file: str) -> Text:
    """Return how a message names the place of a student's code: its file, or the cell of a notebook."""
    if "ipykernel" in file or file.startswith("<ipython"):
        return Text("your cell", "你的单元格")
    return Text(*(Path(file).name,) * 2)


@contextmanager
def watching(part: Part, function: Callable[..., Any], calls: Calls) -> Iterator[None]:
    """Note the forbidden calls of a student's function while it runs."""
    forbidden, wrappers = _forbidden(part) if function is not part.solution else ({}, set())

    def noted(frame: FrameType, *event: Any) -> None:
        if event[0] == "call" and id(frame.f_code) in forbidden:
            name, caller = forbidden[id(frame.f_code)], frame.f_back
            while caller is not None and id(caller.f_code) in wrappers:
                caller = caller.f_back
            own = frame.f_code is getattr(part.solution, "__code__", None)  # also by way of `mine`
            if caller is not None and (own or not is_ours(caller.f_code.co_filename)):
                calls.found.setdefault(name, caller.f_lineno)

    before = sys.getprofile()
    sys.setprofile(noted if forbidden and before is None else before)  # a profiler of the student's goes first
    try:
        yield
    finally:
        sys.setprofile(before)


def _forbidden(part: Part) -> tuple[dict[int, str], set[int]]:
    """Return the code that a function must not run, with its name, and the code of what stands around it, by identity.

    Two functions with the same text have equal code. Forbidden are the reference, the listing that it runs, and what
    the text forbids.
    """
    functions = [(part.name, function) for function in (part.solution, *part.beside[-1:])]
    for room in map(import_module, ("twistwrench", "twistwrench.fast", "twistwrench.bridge")):
        shown = room.__name__.replace("twistwrench", "tw")
        names = [name for name in FORBIDDEN.get(part.name, ()) if hasattr(room, name)]
        functions += [(f"{shown}.{name}", getattr(room, name)) for name in names]
    found: dict[int, str] = {}
    wrappers: set[int] = set()
    for name, function in functions:
        if hasattr(function, "__code__"):
            inner = unwrap(function)
            found[id(inner.__code__)] = name
            if inner is not function:
                wrappers.add(id(function.__code__))
    return found, wrappers

"""A function as a listing: its source with its helpers, changed in one place, and the values of its expressions."""

from __future__ import annotations

import ast
import inspect
import linecache
import textwrap
from collections.abc import Callable, Iterator
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np

__all__ = ["Change", "Listing", "Place", "equal", "locate", "source_with_helpers", "text_of"]

Function = Callable[..., Any]

MAX_EVENTS = 6_000  # values that one run records
MAX_ROUNDS = 100_000  # of all loops of a changed function, in all calls: a change may make a loop endless
MAX_RECORDED_SIZE = 4_000  # entries of an array that is recorded as a copy; a larger one is recorded as it is
LOCAL_ASSIGNMENTS = ast.Constant | ast.List | ast.Tuple | ast.Dict | ast.Lambda | ast.BinOp | ast.UnaryOp
"""What a name of the file may stand for, to be taken over with the functions that use it."""


class Place(NamedTuple):
    """A node of the syntax tree, with the nodes around it and the field of the innermost that holds it."""

    parents: tuple[ast.AST, ...]
    field: str | tuple[str, int]
    node: Any

    @property
    def parent(self) -> Any:
        """The node around it."""
        return self.parents[-1]

    def put(self, node: ast.AST) -> None:
        """Put a node here."""
        if isinstance(self.field, tuple):
            getattr(self.parent, self.field[0])[self.field[1]] = node
        else:
            setattr(self.parent, self.field, node)


class Change(NamedTuple):
    """A node to stand in a place."""

    place: Place
    new: Any


def equal(a: Any, b: Any) -> bool:
    """Whether two values are the same, or the same object where they cannot be compared."""
    try:
        return bool(np.array_equal(a, b))
    except Exception:
        return a is b


def text_of(node: ast.AST) -> str:
    """Return a node as a line of code."""
    return ast.unparse(node).split("\n")[0].replace(".mT", ".T")


def locate(new: ast.AST, node: ast.AST) -> None:
    """Give new nodes the line of the node that they replace."""
    for x in ast.walk(new):
        if not hasattr(x, "lineno"):
            ast.copy_location(x, node)
    ast.fix_missing_locations(new)


def source_with_helpers(function: Function) -> str | None:
    """Return the source of a function or class, with what it uses of the same file; None where it is not at hand.

    Everything else in the file is blank, so that its lines keep their numbers.
    """
    code = getattr(function, "__code__", None) or getattr(_method(function), "__code__", None)
    if code is None or getattr(function, "__closure__", None):
        return None
    linecache.checkcache(code.co_filename)
    lines = linecache.getlines(code.co_filename)
    try:
        tree = ast.parse("".join(lines))
    except SyntaxError:
        return None
    named: dict[str, ast.stmt] = {}
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            named[node.name] = node
        elif isinstance(node, ast.Assign) and isinstance(node.value, LOCAL_ASSIGNMENTS):
            named |= {x.id: node for x in node.targets if isinstance(x, ast.Name)}
    waiting, kept = [function.__name__], set[str]()
    if function.__name__ not in named:
        return None
    while waiting:
        name = waiting.pop()
        kept.add(name)
        waiting += {x.id for x in ast.walk(named[name]) if isinstance(x, ast.Name)} & named.keys() - kept
    shown = {k for name in kept for k in range(named[name].lineno, (named[name].end_lineno or 0) + 1)}
    if not inspect.isclass(function) and code.co_firstlineno not in shown:
        return None
    return "".join(line if k in shown else "\n" for k, line in enumerate(lines, 1))


class Listing:
    """The syntax tree of a function or class, of which single nodes can be replaced.

    Its source, with helpers, is read from its file unless given. What is run is its caller where there is one; `given`
    are its arguments by name.
    """

    def __init__(
        self,
        function: Function,
        *,
        source: str | None = None,
        caller: Function | None = None,
        given: dict[str, Any] | None = None,
    ) -> None:
        self.function, self.caller, self.given = function, caller, given or {}
        names = getattr(function, "__globals__", None) or getattr(_method(function), "__globals__", {})
        self.names = {**names, "_round": self._round}
        text = textwrap.dedent(inspect.getsource(function)) if source is None else source
        self.tree = ast.fix_missing_locations(_Bounded().visit(ast.parse(text)))
        self.places = [place for top in self.tree.body for place in _places(top, ())]
        self.values: dict[int, list[Any]] = {}
        self.events: list[tuple[Any, Any]] = []

    def _round(self) -> None:
        self._left -= 1
        if self._left < 0:
            raise RuntimeError("an endless loop")

    def compiled(self, tree: Any = None, **more: Any) -> Function:
        """Return the function as the tree has it now, or its caller; the one made before must not run any more."""
        names, self._left = {**self.names, **more}, MAX_ROUNDS
        exec(compile(tree or self.tree, "<changed>", "exec", dont_inherit=True), names)
        found: Function = names[self.function.__name__]
        if self.caller is None:
            return found
        names = {**self.caller.__globals__, found.__name__: found}
        return FunctionType(self.caller.__code__, names, closure=self.caller.__closure__)

    def mutant(self, changes: tuple[Change, ...]) -> Function | None:
        """Return the function with other nodes in some places; None where that does not compile."""
        for place, new in changes:
            if not hasattr(new, "lineno"):
                locate(new, place.node)
            place.put(new)
        try:
            return self.compiled()
        except Exception:  # whatever keeps it from being compiled
            return None
        finally:
            for place, _ in changes:
                place.put(place.node)

    def trace(self, run: Callable[[Function], Any]) -> Listing:
        """Run it, and record the value of each expression, in the order in which they are computed."""
        nodes = [place.node for place in self.places if _has_value(place)]
        numbers = {id(node): k for k, node in enumerate(nodes)}

        def record(k: int, value: Any) -> Any:
            if len(self.events) < MAX_EVENTS and not callable(value):
                self.events.append((nodes[k], _snapshot(value)))
            return value

        run(self.compiled(ast.fix_missing_locations(_recording(self.tree, numbers)), _record=record))
        for node, value in self.events:
            self.values.setdefault(id(node), []).append(value)
        return self

    @property
    def statements(self) -> dict[int, Any]:
        """The statement around each node, by the identity of the node."""
        around = {id(place.node): [x for x in place.parents if isinstance(x, ast.stmt)] for place in self.places}
        return {node: found[-1] if found else None for node, found in around.items()}

    def value(self, node: Any) -> Any:
        """Return what an expression was when it first ran; of a constant, itself; None where it did not run."""
        if isinstance(node, ast.Constant):
            return node.value
        return self.values.get(id(node), [None])[0]


def _method(function: Any) -> Any:
    """Return a function of a class."""
    members = vars(function).values() if inspect.isclass(function) else ()
    return next((x for x in members if isinstance(x, FunctionType)), None)


class _Bounded(ast.NodeTransformer):
    """Lets every loop count its rounds, at the beginning of its body."""

    def visit(self, node: ast.AST) -> Any:
        """Add the count to a loop."""
        self.generic_visit(node)
        if isinstance(node, ast.For | ast.While):
            node.body.insert(0, ast.copy_location(ast.parse("_round()").body[0], node))
        return node


def _recording(tree: ast.Module, numbers: dict[int, int]) -> ast.Module:
    """Return a copy of a tree in which each expression with a number passes its value on."""

    def copied(node: Any) -> Any:
        if isinstance(node, list):
            return [copied(x) for x in node]
        if not isinstance(node, ast.AST):
            return node
        new: Any = type(node)(**{name: copied(value) for name, value in ast.iter_fields(node)})
        ast.copy_location(new, node)
        if id(node) in numbers:
            return ast.Call(ast.Name("_record", ast.Load()), [ast.Constant(numbers[id(node)]), new], [])
        return new

    found: ast.Module = copied(tree)
    return found


def _snapshot(value: Any) -> Any:
    """Return a copy of what may be changed later, unless it is large."""
    if isinstance(value, np.ndarray):
        return value.copy() if value.size <= MAX_RECORDED_SIZE else value
    if type(value) in (list, tuple):
        return type(value)(_snapshot(x) for x in value)
    return value


def _has_value(place: Place) -> bool:
    node = place.node
    if not isinstance(node, ast.expr) or isinstance(node, ast.Constant | ast.Slice | ast.Starred | ast.Lambda):
        return False
    if place.field == "func" or isinstance(place.parent, ast.JoinedStr | ast.FormattedValue | ast.Slice):
        return False
    in_brackets = isinstance(place.parent, ast.Subscript) and place.field == "slice"
    return isinstance(getattr(node, "ctx", ast.Load()), ast.Load) and not in_brackets


def _places(node: ast.AST, parents: tuple[ast.AST, ...]) -> Iterator[Place]:
    """Yield the places below a node, those of signatures and errors left out."""
    if isinstance(node, ast.Raise) or (isinstance(node, ast.Call) and text_of(node.func) == "_round"):
        return
    around = (*parents, node)
    for name, value in ast.iter_fields(node):
        if name in ("args", "returns", "annotation", "decorator_list") and not isinstance(node, ast.Call):
            continue
        entries = [((name, k), x) for k, x in enumerate(value)] if isinstance(value, list) else [(name, value)]
        for field, child in entries:
            if isinstance(child, ast.expr | ast.stmt | ast.keyword | ast.comprehension):
                yield Place(around, field, child)
                yield from _places(child, around)

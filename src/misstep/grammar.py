"""Small edits of a listing, rule by rule: what somebody writes who means the right thing.

Most edits are rows of `REWRITES`: what stands in the code, and what may stand there. A single capital letter stands for
any expression, but `M` and `N` for matrices, `S` for a square one and `V` for an array: what an
expression is, is known from its value in one run. So only things of one kind are exchanged or replaced.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from .listing import Change, Listing, Place, equal, locate, text_of

__all__ = ["RULES", "Edit", "Habits", "edits"]

RULES = ("copy", "order", "sign", "turn", "drop", "name", "index", "number", "operator", "flow")
"""The likeliest first; a copy, or an array of floats, changes no number unless it was missing."""

REWRITES = """
copy      np.array(A)            np.array(A, float)
copy      np.asarray(A)          np.array(A, float)
copy      np.zeros_like(A)       np.zeros_like(A, float)
copy      A.copy()               np.array(A, float)
order     A - B            B - A
order     A / B            B / A
order     A ** B           B ** A
order     M @ N            N @ M
order     A @ B @ M        B @ A @ M        A @ M @ B        M @ B @ A
order     [[A, B], [C, D]]     [[A, C], [B, D]]      [[D, B], [C, A]]
order     np.zeros(A, B)   np.zeros((A, B))
sign      A + B            A - B
sign      A - B            A + B
sign      -A               A
turn      M.T              M
turn      M.mT             M
turn      np.linalg.inv(M)     M        M.mT
turn      np.linalg.pinv(M)    M        M.mT
drop      A + B            A            B
drop      A - B            A            -B
drop      A * B            A            B
drop      A / B            A            1 / B
drop      A @ B            A            B
drop      A ** B           A
drop      np.linalg.inv(A) @ B     A @ B
operator  A * B            A / B        A @ B        np.cross(A, B)       np.outer(A, B)
operator  A / B            A * B
operator  A // B           A / B
operator  A @ B            A * B        np.outer(A, B)
operator  A ** -1          np.linalg.inv(A)
operator  1 / S            np.linalg.inv(S)
operator  A * B + C        A * (B + C)
operator  A * B - C        A * (B - C)
operator  A @ B + C        A @ (B + C)
operator  A @ B - C        A @ (B - C)
operator  A * (B + C)      A * B + C        B + A * C
operator  A * (B - C)      A * B - C        B - A * C
operator  A @ (B + C)      A @ B + C        B + A @ C        A @ B - C
operator  A @ (B - C)      A @ B - C        B - A @ C        A @ B + C
operator  A < B            A <= B           A > B
operator  A <= B           A < B            A >= B
operator  A > B            A >= B           A < B
operator  A >= B           A > B            A <= B
operator  A == B           A != B           A >= B
operator  A != B           A == B
operator  A and B          A or B
operator  A or B           A and B
operator  A == B or C      A == B or A == C
operator  np.sum(A)        np.sum(A, axis=0)    np.sum(A, axis=1)
operator  np.mean(A)       np.mean(A, axis=0)   np.mean(A, axis=1)
operator  np.max(A)        np.max(A, axis=0)    np.max(A, axis=1)
operator  np.linalg.norm(A)    np.linalg.norm(A, axis=0)    np.linalg.norm(A, axis=1)
flow      range(A)         range(A + 1)     range(A - 1)     range(1, A)      reversed(range(A))
flow      range(A, B)      range(A, B + 1)  range(A, B - 1)  range(A + 1, B)  range(A - 1, B)  reversed(range(A, B))
flow      range(A, B, C)   range(A, B - 1, C)   range(A, B + 1, C)   range(A - 1, B, C)   range(A + 1, B, C)
flow      reversed(A)      A
"""

CONFUSABLE = (
    *(("cos", "sin"), ("any", "all"), ("min", "max", "mean", "median", "sum"), ("nanmax", "max"), ("vstack", "hstack")),
    *(("zeros", "eye"), ("triu", "tril"), ("log", "log10", "log2"), ("cross", "multiply"), ("isnan", "isfinite")),
)
"""Names of NumPy that are taken for each other."""

SLICES = (":3", "3:", "3:6", ":6", "6:")
REPEATABLE = ("sign", "turn", "drop", "name", "index", "number", "operator")
"""Rules whose edit may have to be made in several places at once, where the same text stands."""

MAX_REPEATED = 5  # places with the same text of which each pair is tried; of more only all


class Rewrite(NamedTuple):
    """A node in place of another, where text beside text does not show what it does: how, to which line."""

    new: Any
    how: str
    text: str
    line: Any = None


class Edit(NamedTuple):
    """A small change of a listing: by which rule, what is put where, and how its line read before and reads after.

    `how` is "replace" where `after` stands in place of `before`, "drop" where nothing does, or what is done to it.
    """

    rule: str
    changes: tuple[Change, ...]
    line: int
    before: str
    after: str
    how: str = "replace"

    def touches(self, other: Edit) -> bool:
        """Whether both are about the same expression."""
        nodes = {id(x) for change in self.changes for x in ast.walk(change.place.node)}
        return self.line == other.line and any(id(x.place.node) in nodes for x in other.changes)


@dataclass(frozen=True)
class Habits:
    """What a field takes for each other: groups of names, and other arrangements of an array `x`, as code."""

    confusable: tuple[tuple[str, ...], ...] = ()
    rearranged: tuple[str, ...] = ()


def edits(listing: Listing, habits: Habits = Habits()) -> Iterator[Edit]:
    """Yield the small edits of a traced listing, rule by rule; after each rule, its edits in several places at once."""
    context = Context(listing, habits)
    for rule in RULES:
        alike: dict[tuple[str, str], list[Edit]] = {}
        made = [_made(rule, place, new) for place in listing.places for new in context.replacements(rule, place)]
        if rule == "sign":  # a plus for a minus before a minus more, and that as near to the result as may be
            made.sort(key=lambda edit: (isinstance(edit.changes[0].new, ast.UnaryOp), -edit.line))
        for edit in made:
            if edit.before != edit.after:
                change = edit.changes[0]
                alike.setdefault((text_of(change.place.node), text_of(change.new)), []).append(edit)
                yield edit
        if rule in REPEATABLE:
            yield from _repeated(alike.values(), pairs=rule != "drop")


def _repeated(alike: Any, *, pairs: bool) -> Iterator[Edit]:
    for same in alike:
        groups = [same] * (len(same) > 1) + [*combinations(same, 2)] * (pairs and 2 < len(same) <= MAX_REPEATED)
        for group in groups:
            places = [edit.changes[0].place for edit in group]
            if not any(a.node in b.parents for a in places for b in places):
                yield group[0]._replace(changes=tuple(edit.changes[0] for edit in group))


def _made(rule: str, place: Place, new: Any) -> Edit:
    """Return an edit with the smallest text around it that stands only once in its statement."""
    if isinstance(new, Rewrite):
        locate(new.new, place.node)
        line = getattr(new.line or place.node, "lineno", 0)
        return Edit(rule, (Change(place, new.new),), line, new.text, "", new.how)
    statement = next((x for x in (place.node, *reversed(place.parents)) if isinstance(x, ast.stmt)), place.node)
    whole, around = text_of(statement), place.node
    for outer in reversed(place.parents):
        text = text_of(around)
        unique = whole.count(text) == 1 and len(text) > 3 and not isinstance(around, ast.Slice | ast.keyword)
        if unique or not isinstance(outer, ast.expr | ast.keyword):
            break
        around = outer
    before = text_of(around)
    locate(new, place.node)
    place.put(new)
    after = text_of(new if around is place.node else around)
    place.put(place.node)
    line = getattr(place.node, "lineno", getattr(statement, "lineno", 0))
    return Edit(rule, (Change(place, new),), line, before, after, "drop" if isinstance(new, ast.Pass) else "replace")


def code(text: str, **nodes: Any) -> Any:
    """Return an expression in which names stand for nodes."""
    return copied(_parsed(text), nodes)


@cache
def _parsed(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


def copied(node: Any, nodes: Mapping[str, Any] | None = None) -> Any:
    """Return a copy of a tree, without its lines, in which names stand for nodes."""
    if isinstance(node, list):
        return [copied(x, nodes) for x in node]
    if not isinstance(node, ast.AST):
        return node
    if nodes and isinstance(node, ast.Name) and node.id in nodes:
        return nodes[node.id]
    return type(node)(**{name: copied(value, nodes) for name, value in ast.iter_fields(node)})


def _rows() -> Iterator[tuple[str, ast.expr, tuple[str, ...]]]:
    for line in REWRITES.strip().split("\n"):
        rule, left, *right = (x.strip() for x in line.replace("  ", "\t").split("\t") if x.strip())
        yield rule, ast.parse(left, mode="eval").body, tuple(right)


ROWS = tuple(_rows())


class Context:
    """A listing that has run, with what stands at hand in it."""

    def __init__(self, listing: Listing, habits: Habits) -> None:
        self.listing, self.habits = listing, habits

    def replacements(self, rule: str, place: Place) -> Iterator[Any]:
        """Yield what a rule puts in a place."""
        if isinstance(place.node, ast.expr) and _is_read(place.node):
            for name, left, rights in ROWS:
                if name == rule and (found := self.match(left, place.node)) is not None:
                    yield from (code(right, **found) for right in rights)
        yield from FUNCTIONS[rule](self, place)

    def match(self, pattern: Any, node: Any) -> dict[str, Any] | None:
        """Return what the letters of a pattern stand for in an expression, None where it has another form."""
        if isinstance(pattern, ast.Name) and len(pattern.id) == 1:
            return {pattern.id: node} if self.may_be(pattern.id, node) else None
        if type(pattern) is not type(node):
            return None
        found: dict[str, Any] = {}
        for name, wanted in ast.iter_fields(pattern):
            given = getattr(node, name)
            pairs = [*zip(wanted, given)] if isinstance(wanted, list) else [(wanted, given)]
            if isinstance(wanted, list) and len(wanted) != len(given):
                return None
            for one, other in pairs:
                if not isinstance(one, ast.AST):
                    if one != other:
                        return None
                elif (inner := self.match(one, other)) is None:
                    return None
                else:
                    found |= inner
        return found

    def may_be(self, letter: str, node: Any) -> bool:
        """Whether an expression is what a letter of a pattern stands for."""
        if not isinstance(node, ast.expr):
            return False
        shape = self.shape(node) or ()
        wanted = {"M": len(shape) > 1, "N": len(shape) > 1, "S": len(shape) > 1 and shape[-1] == shape[-2]}
        return wanted.get(letter, True)

    def shape(self, node: Any) -> tuple[int, ...] | None:
        """Return the shape of a number or an array; None of anything else, and of what did not run."""
        value = self.listing.value(node)
        if isinstance(value, bool | np.bool_) or not isinstance(value, np.ndarray | np.number | float | int):
            return None
        return np.shape(value)

    def kind(self, node: Any) -> Any:
        """Return what two expressions must have in common to be taken for each other; None of what did not run."""
        return _kind(self.listing.value(node))

    @cached_property
    def at_hand(self) -> dict[str, Any]:
        """The values of the names, entries and attributes of the listing, by their text."""
        found: dict[str, Any] = {}
        for place in self.listing.places:
            node = place.node
            if isinstance(node, ast.Name | ast.Subscript | ast.Attribute) and self.listing.value(node) is not None:
                found.setdefault(text_of(node), self.listing.value(node))
        return {**self.listing.given, **found}


def _kind(value: Any) -> Any:
    if isinstance(value, bool | np.bool_):
        return bool
    if isinstance(value, np.ndarray | np.number | int | float):
        return np.shape(value) if np.shape(value) or not isinstance(value, int) else int
    if value is None:
        return None
    return (type(value), len(value)) if isinstance(value, list | tuple) else type(value)


def _is_read(node: Any) -> bool:
    return isinstance(getattr(node, "ctx", ast.Load()), ast.Load)


def _in_brackets(place: Place) -> bool:
    """Whether something is part of an index."""
    outer = (*place.parents, place.node)
    return any(isinstance(x, ast.Subscript) and any(x.slice is y for y in outer) for x in place.parents)


def _is_term(place: Place) -> bool:
    """Whether something is computed with: a term, a factor, an argument, an entry or a result."""
    node, parent = place.node, place.parent
    structure = (
        ast.Slice | ast.Starred | ast.Tuple | ast.List | ast.ListComp | ast.GeneratorExp | ast.Compare | ast.BoolOp
    )
    if not isinstance(node, ast.expr) or isinstance(node, structure) or not _is_read(node) or place.field == "func":
        return False
    if isinstance(parent, ast.Attribute | ast.Subscript) and place.field == "value":
        return False
    if isinstance(node, ast.Constant) and type(node.value) not in (int, float):
        return False
    return not _in_brackets(place)


# ---------------------------------------------------------------- the rules that are no rows


def own_array(context: Context, place: Place) -> Iterator[Any]:
    """Make an array for each name that stands for one."""
    node = place.node
    if isinstance(node, ast.Assign) and len(node.targets) > 1:
        each: list[ast.stmt] = [ast.Assign([target], copied(node.value)) for target in node.targets]
        yield Rewrite(ast.If(ast.Constant(True), each, []), "separate", text_of(node))
    is_value = isinstance(place.parent, ast.Assign) and place.field == "value"
    if is_value and isinstance(node, ast.Subscript | ast.Name) and context.shape(node):
        yield code("np.array(x, float)", x=node)


def exchange_entries(context: Context, place: Place) -> Iterator[Any]:
    """Exchange two arguments of a call, or two entries of a list, that are of the same kind."""
    node = place.node
    if isinstance(node, ast.Call) and 1 < len(node.args) < 6 and text_of(node.func) != "range":
        yield from (ast.Call(node.func, args, node.keywords) for args in _exchanged(context, node.args))
    if isinstance(node, ast.Tuple | ast.List) and 1 < len(node.elts) < 8:
        yield from (type(node)(entries, node.ctx) for entries in _exchanged(context, node.elts))


def _exchanged(context: Context, entries: Sequence[Any]) -> Iterator[list[Any]]:
    kinds = [context.kind(x) for x in entries]
    unpacked = len(entries) == 2 and not any(map(_is_read, entries))
    for i, j in combinations(range(len(entries)), 2):
        if unpacked or (kinds[i] is not None and kinds[i] == kinds[j]):
            yield [entries[j if k == i else i if k == j else k] for k in range(len(entries))]


def negate(context: Context, place: Place) -> Iterator[Any]:
    """Put a minus before a term, or take away what is added."""
    node = place.node
    if isinstance(node, ast.AugAssign) and isinstance(node.op, ast.Add | ast.Sub):
        yield ast.AugAssign(node.target, ast.Sub() if isinstance(node.op, ast.Add) else ast.Add(), node.value)
    if not _is_term(place) or isinstance(node, ast.Constant | ast.UnaryOp) or isinstance(place.parent, ast.UnaryOp):
        return
    if context.shape(node) is not None:
        yield ast.UnaryOp(ast.USub(), node)


def transpose(context: Context, place: Place) -> Iterator[Any]:
    """Transpose or invert a matrix, or arrange an array in another way that the field has."""
    node, shape = place.node, context.shape(place.node)
    if (
        not _is_term(place)
        or not shape
        or isinstance(node, ast.Constant)
        or text_of(node).startswith(("np.eye", "np.zeros"))
    ):
        return
    turned = isinstance(node, ast.Attribute) and node.attr in ("T", "mT")
    inverted = isinstance(node, ast.Call) and text_of(node.func) in ("np.linalg.inv", "np.linalg.pinv")
    if len(shape) > 1 and not turned and not inverted:
        yield ast.Attribute(node, "mT", ast.Load())
        if shape[-1] == shape[-2]:
            yield code("np.linalg.inv(x)", x=node)
    for text in context.habits.rearranged if shape[0] >= 6 else ():
        yield code(text, x=node)


def leave_out(context: Context, place: Place) -> Iterator[Any]:
    """Leave out a statement, a call around something, an option, a slice, a condition; put zero for an entry."""
    node = place.node
    if isinstance(node, ast.AugAssign) or (isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Subscript)):
        yield ast.Pass()
    if isinstance(node, ast.If) and not node.orelse:
        yield ast.If(ast.Constant(True), node.body, [])
    if isinstance(node, ast.Call):
        inner = [x for x in node.args[:2] if not isinstance(x, ast.Constant | ast.Starred)]
        if isinstance(node.func, ast.Attribute):
            inner.append(node.func.value)
        yield from (x for x in inner if context.kind(x) is not None)  # of a module nothing is known
        if not node.args:
            yield node.func
        for keyword in node.keywords:
            yield ast.Call(node.func, node.args, [x for x in node.keywords if x is not keyword])
    is_slice = isinstance(node, ast.Subscript) and _is_read(node) and isinstance(node.slice, ast.Slice)
    if is_slice and context.kind(node.value) is not None:
        yield node.value
    if isinstance(node, ast.BoolOp):
        for k in range(len(node.values)):
            others = node.values[:k] + node.values[k + 1 :]
            yield ast.BoolOp(node.op, others) if len(others) > 1 else others[0]
    is_list = isinstance(node, ast.Tuple | ast.List) and _is_read(node) and isinstance(place.parent, ast.expr)
    for k, x in enumerate(node.elts if is_list and not _in_brackets(place) else ()):
        if context.shape(x) is not None and not isinstance(x, ast.Constant):
            zero = code("np.zeros_like(x)", x=x) if context.shape(x) else ast.Constant(0)
            yield type(node)([*node.elts[:k], zero, *node.elts[k + 1 :]], node.ctx)


def other_name(context: Context, place: Place) -> Iterator[Any]:
    """Put another thing of the same kind that is at hand, or a name that is taken for this one."""
    node = place.node
    for other in _confused(_word(node), context.habits):
        if isinstance(node, ast.Attribute):
            yield ast.Attribute(node.value, other, node.ctx)
        elif isinstance(node, ast.Name):
            yield ast.Name(other, node.ctx)
        else:
            yield ast.Constant(other)
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield from (code(text) for text, known in context.at_hand.items() if isinstance(known, str))
        lists = [known for known in context.listing.given.values() if isinstance(known, list)]
        listed = {x for known in lists for x in known if isinstance(x, str)}
        yield from (ast.Constant(x) for x in sorted(listed - {node.value}))
    if isinstance(node, ast.Name) and context.listing.value(node) is None and node.id not in context.listing.names:
        modules = {name: x for name, x in context.listing.names.items() if hasattr(x, "__path__")}
        yield from (code(f"{name}.{node.id}") for name, x in modules.items() if hasattr(x, node.id))
    held = isinstance(node, ast.Name) and isinstance(place.parent, ast.Subscript) and place.field == "value"
    named = isinstance(node, ast.Name | ast.Subscript | ast.Attribute) and _is_read(node) and (held or _is_term(place))
    count = isinstance(node, ast.BinOp) and type(context.listing.value(node)) is int
    value, kind = context.listing.value(node), context.kind(node)
    if (named or count) and value is not None:
        for text, known in context.at_hand.items():
            alike = _kind(known) == kind and not isinstance(known, str) and not equal(known, value)
            if alike and text != text_of(node):
                yield code(text)


def _word(node: Any) -> Any:
    """Return the name that a node has, or the text that it is."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else None
    return getattr(node, "attr", getattr(node, "id", None)) if isinstance(node, ast.Attribute | ast.Name) else None


def _confused(word: Any, habits: Habits) -> Iterator[str]:
    for group in (*CONFUSABLE, *habits.confusable) if isinstance(word, str) else ():
        if word in group:
            yield from (other for other in group if other != word)


def other_index(context: Context, place: Place) -> Iterator[Any]:
    """Put another slice, another number or another counter in brackets."""
    node, parent = place.node, place.parent
    if isinstance(node, ast.Slice):
        yield from (code(f"x[{other}]").slice for other in SLICES if other != text_of(node))
        ends = [getattr(x, "value", None) for x in (node.lower, node.upper)]
        if all(type(x) is int for x in ends):
            yield from (ast.Slice(*(ast.Constant(int(x or 0) + k) for x in ends)) for k in (-1, 1))
        return
    if not (place.field == "slice" or isinstance(parent, ast.Slice | ast.Tuple)) or not _in_brackets(place):
        return
    if isinstance(node, ast.Constant) and type(node.value) is int:
        others = dict.fromkeys((node.value + 1, node.value - 1, *range(6)))
        yield from (ast.Constant(x) for x in others if x != node.value)
    elif isinstance(node, ast.Name):
        for text, value in context.at_hand.items():
            if type(value) is int and text != node.id and (text.isidentifier() or text.endswith(f"[{node.id}]")):
                yield code(text)
        yield from (code(f"x {sign} 1", x=node) for sign in "+-")
    elif isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Name):
        yield node.slice  # the number of a thing for that of its parent


def other_number(context: Context, place: Place) -> Iterator[Any]:
    """Put another number for one, and a factor of two where there is none."""
    node = place.node
    if isinstance(node, ast.Constant) and type(node.value) in (int, float) and not _in_brackets(place):
        yield from (ast.Constant(x) for x in dict.fromkeys(_near(node.value)) if x != node.value)
        return
    is_used = _is_term(place) and isinstance(place.parent, ast.BinOp | ast.Return | ast.Assign | ast.Call)
    if is_used and context.shape(node) is not None:
        yield from (ast.BinOp(node, op, ast.Constant(factor)) for factor in (2, 3) for op in (ast.Mult(), ast.Div()))


def _near(x: Any) -> list[Any]:
    if isinstance(x, int):
        return [x + 1, x - 1, 0, 2 * x, -x, x / 2 if x % 2 else x // 2, 1, 2, 3, 6]
    return [0.0, 1.0, -x, 2 * x, x / 2, 10 * x, x / 10]


def missing_factor(context: Context, place: Place) -> Iterator[Any]:
    """Turn a term by a matrix at hand, multiply it by a number at hand, or take its size or its diagonal."""
    node, shape = place.node, context.shape(place.node)
    around = ast.BinOp | ast.Call | ast.Return | ast.Assign | ast.Tuple | ast.List
    if not _is_term(place) or shape is None or not isinstance(place.parent, around) or isinstance(node, ast.Constant):
        return
    yield code("abs(x)", x=node)
    if len(shape) == 2 and shape[0] == shape[1]:
        yield code("np.diag(np.diag(x))", x=node)
    for text, value in context.at_hand.items():
        if text == text_of(node):
            continue
        square = isinstance(value, np.ndarray) and value.ndim == 2 and value.shape[0] == value.shape[1]
        if square and shape and shape[0] == value.shape[0]:
            forms = ("A @ x", "A.T @ x", *(("A @ x @ A.T", "A.T @ x @ A") if len(shape) == 2 else ()))
            yield from (code(form, x=node, A=code(text)) for form in forms)
        elif isinstance(value, float | int) and not isinstance(value, bool) and value not in (0, 1):
            yield from (code(form, x=node, s=code(text)) for form in ("x * s", "x / s"))


def other_flow(context: Context, place: Place) -> Iterator[Any]:
    """Add up or not, move a line out of a loop or into it."""
    node, parents = place.node, place.parents
    in_loop = any(isinstance(x, ast.For | ast.While) for x in parents)
    if isinstance(node, ast.AugAssign):
        yield ast.Assign([node.target], node.value)
    elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name | ast.Subscript) and in_loop:
        yield ast.AugAssign(node.targets[0], ast.Add(), node.value)
    if isinstance(node, ast.For):
        yield from _other_loop(node, place)


def _other_loop(node: ast.For, place: Place) -> Iterator[Rewrite]:
    """Move the last line of a loop behind it, or one of those above into it; add up from zero."""
    if len(node.body) > 2:  # the first counts the rounds
        loop = ast.For(node.target, node.iter, node.body[:-1], node.orelse)
        last = node.body[-1]
        yield Rewrite(ast.If(ast.Constant(True), [loop, last], []), "after loop", text_of(last), last)
    for k, line in enumerate(node.body):
        if isinstance(line, ast.Assign) and isinstance(line.targets[0], ast.Name):
            start = ast.Assign([ast.Name(line.targets[0].id, ast.Store())], ast.Constant(0))
            added = ast.Assign(line.targets, ast.BinOp(ast.Name(line.targets[0].id, ast.Load()), ast.Add(), line.value))
            loop = ast.For(node.target, node.iter, [*node.body[:k], added, *node.body[k + 1 :]], node.orelse)
            yield Rewrite(ast.If(ast.Constant(True), [start, loop], []), "sum", text_of(line), line)
    beside = getattr(place.parent, "body", [])
    at = next((k for k, x in enumerate(beside) if x is node), 0)
    for line in beside[max(0, at - 3) : at]:
        if isinstance(line, ast.Assign):
            loop = ast.For(node.target, node.iter, [line, *node.body], node.orelse)
            yield Rewrite(loop, "in loop", text_of(line), line)


FUNCTIONS: dict[str, Callable[[Context, Place], Iterator[Any]]] = {
    "copy": own_array,
    "order": exchange_entries,
    "sign": negate,
    "turn": transpose,
    "drop": leave_out,
    "name": other_name,
    "index": other_index,
    "number": other_number,
    "operator": missing_factor,
    "flow": other_flow,
}
"""By its rule, what yields the edits that are no rows."""

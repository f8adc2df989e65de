"""Small edits of a right function: a sign, a transpose, a factor, an index, a term left out, two things exchanged.

They are made in its syntax tree, so that no list has to name them. A wrong answer is explained by the edit that gives
the same numbers; and as no edit may pass the check, they measure the cases of an exercise too.
"""

from __future__ import annotations

import ast
import copy
import inspect
import sys
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import wraps
from itertools import combinations
from types import FunctionType
from typing import Any

from ..calls import CHANGED, count
from .alternatives import KINDS, crossed
from .containers import Change, parsed
from .excerpts import assignment, enclosing, term, text_of
from .places import Place, all_places, is_empty, mark, put, put_in, stands_elsewhere, surroundings
from .scope import Scope
from .whole import Edit, of_arguments, of_order

__all__ = ["Source", "edits"]

Function = Callable[..., Any]
MOST_PLACES = 5
"""Of the same text, for which an edit is tried in each two of them."""

LIKELY = ("sign", "exchanged", "left out")
"""Those of which two are tried together."""


def edits(
    solution: Function,
    listings: tuple[Function, ...] = (),
    *,
    shown: Mapping[str, Any] = {},
    names: Mapping[str, Any] = {},
) -> Iterator[Edit]:
    """Yield every small edit of a function and of the listings that it calls, the likeliest first.

    Parameters
    ----------
    solution : callable
        A function, or a class, with its source.
    listings : tuple of callable
        What it calls and can be edited as well.
    shown : mapping
        Values of the names in each of them, by its name: only names of the same kind are exchanged.
    names : mapping
        Put in place of what the edited functions call by these names.

    Examples
    --------
    >>> from twistwrench.exercises.catalogue import find_part
    >>> newton_euler = find_part("newton_euler")[1].solution
    >>> [edit.right for edit in edits(newton_euler) if edit.kind == "sign"][:1]
    ['np.cross(omega, I_c @ omega)']
    """
    sources = [Source(f, solution, shown, names) for f in (solution, *listings)]
    for kind in KINDS:
        for source in sources:
            yield from source.edits(kind)
        if kind == "sign" and not inspect.isclass(solution):
            yield from of_arguments(_guarded(sources))
            yield from of_order(_guarded(sources))
    if not inspect.isclass(solution):  # two slips in two methods may make up for each other
        yield from sources[0].pairs()


def _guarded(sources: list[Source]) -> Function:
    """Return the solution as it is, with loops that cannot be endless, whatever its arguments are."""
    solution, *listings = (source.compiled() for source in sources)
    names = {**solution.__globals__, **{f.__name__: f for f in listings}}
    return wraps(sources[0].function)(FunctionType(solution.__code__, names, closure=solution.__closure__))


def _globals(function: Function) -> Mapping[str, Any]:
    """Return the names of the module of a function; a class has them from its methods."""
    methods = [x for x in vars(function).values() if isinstance(x, FunctionType)] if inspect.isclass(function) else []
    first = methods[0] if methods else function
    return getattr(first, "__globals__", None) or vars(sys.modules[function.__module__])


class Source:
    """The syntax tree of a function, in which one place at a time is changed.

    Parameters
    ----------
    function, solution : callable
        What is changed, and what is called: the same, or one that calls it.
    values : mapping
        Of the names in it, by its name.
    names : mapping
        Put in place of what it calls by these names.
    text : str, optional
        Its source, where Python does not find that; with the helpers of a student's.
    """

    def __init__(
        self,
        function: Function,
        solution: Function,
        values: Mapping[str, Mapping[str, Any]],
        names: Mapping[str, Any],
        text: str | None = None,
    ) -> None:
        self.function, self.solution = function, solution
        module = _globals(function)
        self.names = {**module, "_one_more_round": count, **{k: x for k, x in names.items() if k in module}}
        self.tree = ast.parse(textwrap.dedent(inspect.getsource(function) if text is None else text))
        for node in ast.walk(self.tree):
            if isinstance(node, ast.While):
                node.body.insert(0, ast.parse("_one_more_round()").body[0])
        self.places = self._places()
        self.scopes = {_name(x): Scope(x, values.get(_name(x), {}), self.names) for x in self.tree.body}

    def _places(self) -> list[tuple[list[Any], Any, Any]]:
        """Return the places of the function, and of its helpers."""
        return [place for node in self.tree.body for place in all_places(node)]

    def _alternatives(self, parents: list[Any], node: Any) -> Iterator[Change]:
        """Yield what could stand in a place."""
        return self.scopes[_name(parents[0])].alternatives(node, parents)

    def after(self, edit: Edit) -> Source:
        """Return the source after one edit, to be changed further; its lines keep their numbers."""
        for parents, field, node, other in edit.places:
            old = {id(x) for x in ast.walk(node)}
            for x in ast.walk(other):
                if id(x) not in old and hasattr(x, "lineno"):
                    vars(x).update(lineno=node.lineno, end_lineno=node.lineno)  # those of what it replaces
                    vars(x).update(col_offset=0, end_col_offset=0)
            put(parents[-1], field, other)
        found = copy.copy(self)
        found.tree = copy.deepcopy(self.tree)
        for parents, field, node, _ in edit.places:
            put(parents[-1], field, node)
        ast.fix_missing_locations(found.tree)
        found.places = found._places()
        return found

    def edits(self, kind: str) -> Iterator[Edit]:
        """Yield the edits of one kind: each by itself, then those that are the same in several places together."""
        alike: dict[tuple[Any, tuple[str, str]], list[Place]] = {}
        made = [(*place, x) for place in self.places for k, x in self._alternatives(place[0], place[2]) if k == kind]
        if kind == "sign":  # a plus for a minus before a minus more, and that as near to the result as may be
            made.sort(key=lambda place: (isinstance(place[3], ast.UnaryOp), -place[2].lineno))
        for place in made:
            texts = self.texts(kind, place)
            if texts[0] == texts[1]:
                continue  # two names that are one, exchanged
            method = next((id(x) for x in place[0] if isinstance(x, ast.FunctionDef)), None)  # in two it is two
            alike.setdefault((method, mark(texts, *place[2:])), []).append(place)
            yield from self.made(kind, texts, [place])
        yield from self._halves() if kind == "halves" else self._crossed() if kind == "exchanged" else ()
        for (_, (right, wrong)), places in alike.items():
            if kind == "number" and len({field for _, field, *_ in places}) > 1:
                continue  # where a slice begins and where another ends are two things
            if len(places) > 1 and (len(places) == 2 or not stands_elsewhere(right, places)):
                yield from self.made(kind, (right, wrong), places, everywhere=True)
            if 2 < len(places) <= MOST_PLACES:
                for two in combinations(places, 2):
                    yield from self.made(kind, (right, wrong), [*two], everywhere=True)

    def _halves(self) -> Iterator[Edit]:
        """Yield the exchange of the two halves of an array, wherever they stand: ω for v, and v for ω."""
        halves: dict[str, list[Place]] = {}
        for parents, field, node in self.places:
            text = ast.unparse(node) if isinstance(node, ast.Slice) else ""
            if text in (":3", "3:", "3:6") and isinstance(parents[-1], ast.Subscript):
                other: Any = parsed("x[3:6]" if text == ":3" else "x[:3]")
                halves.setdefault(text_of(parents[-1].value), []).append((parents, field, node, other.slice))
        for name, places in halves.items():
            if len({ast.unparse(node) == ":3" for _, _, node, _ in places}) == 2:
                other_half = next(ast.unparse(node) for _, _, node, _ in places if ast.unparse(node) != ":3")
                yield from self.made("halves", (f"{name}[:3]", f"{name}[{other_half}]"), places)

    def pairs(self, kinds: Sequence[str] = LIKELY) -> Iterator[Edit]:
        """Yield two edits at once, of the kinds that are likeliest."""
        for k, (parents, field, node) in enumerate(self.places):
            for kind, other in self._alternatives(parents, node):
                if kind in kinds:
                    first = kind, *self.texts(kind, (parents, field, node, other)), node.lineno
                    put_in((parents, field, node, other))
                    for place in self.places[k + 1 :]:
                        if not any(parent is node for parent in place[0]):
                            yield from self._second(first, place, kinds)
                    put(parents[-1], field, node)

    def _second(self, first: tuple[str, str, str, int], where: Any, kinds: Sequence[str]) -> Iterator[Edit]:
        parents, field, node = where
        for kind, other in self._alternatives(parents, node):
            if kind in kinds:
                place = parents, field, node, other
                for edit in self.made(kind, self.texts(kind, place), [place]):
                    yield replace(edit, first=first)

    def texts(self, kind: str, place: Place) -> tuple[str, str]:
        """Return the texts of an edit, right and wrong."""
        parents, field, node, other = place
        if kind == "carried":
            return other.said  # type: ignore[no-any-return]
        if kind in ("sign", "left out", "after loop", "in loop", "summed", "diagonal"):
            return term(node, other), ""
        around = enclosing(parents, node)
        right = text_of(around)
        put(parents[-1], field, other)
        wrong = text_of(other if around is node else around)
        put(parents[-1], field, node)
        return right, wrong

    def made(
        self, kind: str, texts: tuple[str, str], places: list[Place], *, everywhere: bool = False
    ) -> Iterator[Edit]:
        """Yield the edit in some places, if it is a program."""
        for place in places:
            put_in(place)
        try:
            if any(is_empty(parents[-1]) for parents, *_ in places):
                return
            changed = self.compiled(located=True)
            became = tuple(text_of(surroundings(parents)) for parents, *_ in places)
        except Exception:  # no program; and the body of a class is run
            return
        finally:
            for parents, field, node, _ in places:
                put(parents[-1], field, node)
        function = changed
        if self.function is not self.solution:
            names = {**self.solution.__globals__, self.function.__name__: changed}
            function = FunctionType(self.solution.__code__, names, closure=self.solution.__closure__)
        statement = "" if everywhere else assignment(places[0][0])
        node = places[0][2]
        moved = node.body[-1] if kind == "after loop" else places[0][3].body[0] if kind == "in loop" else node
        line = moved.lineno
        around = [text_of(surroundings(parents)) for parents, *_ in places] if everywhere and len(places) == 2 else []
        yield Edit(
            kind,
            *texts,
            self.function,
            function,
            len(places) * everywhere,
            statement,
            None,
            line,
            (*places,),
            (*around,),
            became,
        )

    def as_written(self, edit: Edit, mends: Callable[[Function], bool]) -> Edit:
        """Return an edit with `.mT` in its text, if it does not mend with `.T`, as a text has it."""
        if ".T" not in edit.wrong or not edit.places:
            return edit
        places = [(parents, field, node, _with_plain_transposes(other)) for parents, field, node, other in edit.places]
        found = self.made(edit.kind, (edit.right, edit.wrong), places, everywhere=bool(edit.everywhere))
        plain = any(mends(other.function) for other in found)
        return edit if plain else replace(edit, wrong=edit.wrong.replace(".T", ".mT"))

    def compiled(self, *, located: bool = False) -> Function:
        """Return the function as the tree is now, if need be with lines for its nodes."""
        name, names = self.function.__name__, dict(self.names)
        if not located:
            ast.fix_missing_locations(self.tree)
        exec(compile(self.tree, CHANGED, "exec", dont_inherit=True), names)
        found: Function = names[name]
        return found

    def _crossed(self) -> Iterator[Edit]:
        """Yield the exchange of two names, wherever they stand in an expression."""
        for parents, field, node in self.places:
            if isinstance(node, ast.expr) and isinstance(parents[-1], ast.stmt):
                kinds = self.scopes[_name(parents[0])].kinds
                used = sorted({x.id for x in ast.walk(node) if isinstance(x, ast.Name) and x.id in kinds})
                for x, y in combinations(used, 2):
                    if kinds[x] == kinds[y]:
                        place = parents, field, node, crossed(node, x, y)
                        yield from self.made("exchanged", self.texts("exchanged", place), [place])


def _name(node: Any) -> str:
    """Return the name of a function or class; empty for a value beside it."""
    return getattr(node, "name", "")


def _with_plain_transposes(node: Any) -> Any:
    """Return a copy of a piece of a program with `.T` for each `.mT`, which is another thing for many matrices."""
    found = copy.deepcopy(node)
    for x in ast.walk(found):
        if isinstance(x, ast.Attribute) and x.attr == "mT":
            x.attr = "T"
    return found

"""Which changes of a student's function are slips that somebody makes, and which only switch off what is wrong."""

from __future__ import annotations

import ast
import re
from dataclasses import replace
from functools import lru_cache
from typing import Any

from ..exercise import Part
from .crosses import is_cross, is_difference, nodes_of, of_a_minus, parsed, turned
from .of_wrenches import turns_into_the_other_kind
from .whole import Edit

__all__ = ["nested", "plausible", "shuts", "turns_the_rest"]

POSTURES = ("neutral", "standing")
"""Either may be meant: which of them stands there is not why numbers are wrong."""


def plausible(edit: Edit, text: str, part: Part) -> bool:
    """Whether a change that makes a function right is the undoing of a slip.

    Parameters
    ----------
    edit : Edit
        Of the student's function: `right` is what stands there, `wrong` what is put in its place.
    text : str
        The source of the student's function.
    part : Part
        What is asked for.
    """
    if edit.first is not None:
        kind, right, wrong, line = edit.first
        first = replace(edit, kind=kind, right=right, wrong=wrong, line=line, first=None)
        return (
            not turns_the_rest(first, edit)
            and plausible(first, text, part)
            and plausible(replace(edit, first=None), text, part)
        )
    before, after = edit.right, edit.wrong
    if any(x in after and x not in before for x in ("0 * ", "1 * ")) or after.endswith(" / 1"):
        return False  # it is switched off, or nothing
    if _nobody_makes(edit, part):
        return False
    if edit.kind == "inserted" and _undoes(parsed(after)):
        return False  # what is divided by does not belong there
    if edit.kind == "number" and " != 0" in before and " != 0" not in after:
        return False  # nobody takes another number for the zero that must not be divided by
    if edit.kind == "left out" and any(
        isinstance(x, ast.Tuple) and isinstance(y[-1], ast.Assign | ast.Subscript) for y, _, x, _ in edit.places
    ):
        return False  # one of several things that get names, or an index, is only switched off
    if _unpacked(before, after, text) or _kept(before, after, text):
        return False
    if edit.kind == "name" and (_left_over(edit, text) or _added_up(edit, text)):
        return False
    if edit.kind == "after loop":
        return not isinstance(parsed(before), ast.Expr)  # a call after the loop is made only once
    if edit.kind == "in loop":
        return not _read_after(parsed(before), text, edit.places[0][2].lineno)
    if isinstance(parsed(after), ast.AugAssign) and isinstance(parsed(before), ast.Assign):
        return ast.unparse(parsed(before).targets[0]) not in ast.unparse(parsed(before).value)  # it is in it already
    if edit.kind == "inserted" and any(before in ast.unparse(x) for x in nodes_of(text) if isinstance(x, ast.Compare)):
        return False  # a branch that is wrong needs no further factor in its condition
    if shuts(edit):
        tests = [ast.unparse(x.test) for x in nodes_of(text) if isinstance(x, ast.If | ast.IfExp)]
        return ">" not in before and any(before in test for test in tests)
    if any(name in before and name not in after for name in POSTURES) and any(name in after for name in POSTURES):
        return False
    return edit.kind != "exchanged" or (turned(before, text, part.solution) and not of_a_minus(edit, text))


def _nobody_makes(edit: Edit, part: Part) -> bool:
    """Whether what an edit puts there cannot be what was meant."""
    return (
        edit.kind == "diagonal"  # nobody forgets to drop what is beside the diagonal
        or (edit.kind in ("sign", "number", "exchanged") and _is_place(edit))  # a place, or how often, has no sign
        or (edit.kind == "sign" and _is_positive(edit.right))  # −R is not a rotation matrix, −m not a mass
        or (edit.kind == "index" and _is_written_to(edit))  # two things would be written to one place
        or bool(re.search(r"(?<!\w)-\d+:\d", edit.wrong))  # nothing is in such a slice
        or (edit.kind == "instead" and _is_guard(edit))  # what keeps a number from zero
        or "Error(" in edit.right  # it is raised, and nothing is computed with it
        or _of_itself(edit)
        or turns_into_the_other_kind(edit, part)
    )


def _is_place(edit: Edit) -> bool:
    """Whether a computed index, bound of a slice, or number of rounds gets another sign."""
    if not edit.places or isinstance(edit.places[0][2], ast.Slice | ast.Tuple | ast.Call):
        return False
    for parents, _, node, other in edit.places:
        if isinstance(node, ast.Constant) and not ast.unparse(other).startswith("-"):
            return False
        chain = [*parents, node]
        if any(isinstance(x, ast.Subscript) and x.slice in chain for x in chain):
            return True
        if any(isinstance(x, ast.Call) and ast.unparse(x.func) == "range" for x in parents):
            return not edit.by_one  # a loop downward ends at -1
    return False


def _is_positive(text: str) -> bool:
    """Whether a text is a rotation matrix by its name, or the transpose of one, or a mass, or a small bound."""
    name = text.removesuffix(".T").removeprefix("float(").removesuffix(")").rpartition(".")[2]
    return name in ("R", "rotation", "m", "eps", "tiny", "tol") or (name.isidentifier() and "mass" in name.lower())


def _is_written_to(edit: Edit) -> bool:
    """Whether what is written to would be the end, or what the same statement writes to as well."""
    for parents, *_ in edit.places:
        for statement in (x for x in parents if isinstance(x, ast.Assign)):
            targets = [ast.unparse(x) for target in statement.targets for x in getattr(target, "elts", [target])]
            if edit.right in targets and (edit.wrong in targets or edit.wrong.endswith("[-1]")):
                return True
    return False


def _is_guard(edit: Edit) -> bool:
    """Whether the larger of something and a fixed number becomes the smaller, or the other way round."""
    node = edit.places[0][2] if edit.places else None
    bound = isinstance(node, ast.Attribute | ast.Name) and edit.right.partition("(")[0].endswith(("max", "min", "imum"))
    arguments = getattr(getattr(parsed(edit.right), "value", None), "args", [])
    return bound and any(isinstance(x, ast.Constant) for x in arguments)


def _of_itself(edit: Edit) -> bool:
    """Whether a thing would be crossed with itself, or subtracted from it or added to it: zero, or twice that."""
    nodes, around = nodes_of(edit.wrong), edit.places[0][0] if edit.places else []
    sums = [x for x in around if isinstance(x, ast.BinOp) and isinstance(x.op, ast.Add | ast.Sub)]
    ends = [{ast.unparse(x.left), ast.unparse(x.right)} for x in sums]
    pairs = [x.args for x in nodes if is_cross(x)] + [[x.left, x.right] for x in nodes if is_difference(x)]
    nothing = any(len({ast.unparse(y).lstrip("-") for y in pair}) == 1 for pair in pairs)
    return nothing or any({edit.right, edit.wrong.replace(".T.T", "")} == both for both in ends)


def turns_the_rest(edit: Edit, other: Edit) -> bool:
    """Whether two changes give a sign to something and to all that is around it: to the rest alone, that is."""
    return nested(edit, other) and edit.kind == "sign" and other.kind in ("sign", "left out")


def nested(edit: Edit, other: Edit) -> bool:
    """Whether what one of two changes is made to is a piece of what the other is made to."""
    return edit.right in other.right or other.right in edit.right


def shuts(edit: Edit) -> bool:
    """Whether a change puts a threshold below zero: then a branch is not taken any more."""
    compared = any(isinstance(x, ast.Compare) for x in nodes_of(edit.wrong))
    return edit.kind == "number" and compared and edit.wrong.count("-") > edit.right.count("-")


def _undoes(node: Any) -> bool:
    """Whether something is multiplied by what it has just been divided by or by its transpose."""
    products = [x for x in ast.walk(node) if isinstance(x, ast.BinOp) and isinstance(x.op, ast.MatMult)] if node else ()
    if any(ast.unparse(x.left) in (f"{ast.unparse(x.right)}.T", f"{ast.unparse(x.right)}.mT") for x in products):
        return True
    for outer in (x for x in ast.walk(node) if isinstance(x, ast.BinOp)) if node else ():
        inner: Any = outer.left
        pair = {type(outer.op), type(getattr(inner, "op", None))}
        if pair == {ast.Mult, ast.Div} and ast.unparse(inner.right) == ast.unparse(outer.right):
            return True
    return False


def _read_after(assigned: Any, text: str, line: int) -> bool:
    """Whether what is assigned before a loop is read after it, where it would have only what the last round made."""
    loops = [x for x in nodes_of(text) if isinstance(x, ast.For | ast.While) and x.lineno == line]
    end = max((x.end_lineno or 0 for x in loops), default=0)
    names = {x.id for y in getattr(assigned, "targets", ()) for x in ast.walk(y) if isinstance(x, ast.Name)}
    return any(isinstance(x, ast.Name) and x.id in names and x.lineno > end for x in nodes_of(text))


def _unpacked(before: str, after: str, text: str) -> bool:
    """Whether things that are computed one by one get each other's names, or a tuple of several is inverted."""
    alike, whole = _unpackings(text)
    return before in alike or (before in whole and after == f"np.linalg.inv({before})")


@lru_cache(maxsize=64)
def _unpackings(text: str) -> tuple[set[str], set[str]]:
    """Return what is written where things that are computed alike get their names, and what is unpacked at all."""
    several = [x for x in nodes_of(text) if isinstance(x, ast.Assign) and isinstance(x.targets[0], ast.Tuple)]
    alike = [x for x in several if isinstance(x.value, ast.GeneratorExp | ast.ListComp)]
    return {ast.unparse(y) for x in alike for y in (x, x.targets[0])}, {ast.unparse(x.value) for x in several}


def _kept(before: str, after: str, text: str) -> bool:
    """Whether of a sum over a loop, or of its largest, only the last would be kept: that is not why it is there."""
    if not any(word in before for word in ("+=", "max(", "min(")):
        return False
    node, other = parsed(before), parsed(after)
    if isinstance(node, ast.AugAssign) and isinstance(other, ast.Assign):
        loops = [x for x in nodes_of(text) if isinstance(x, ast.For)]
        inside = [x for x in loops if before in map(ast.unparse, ast.walk(x))]
        over = {x.id for loop in inside for x in ast.walk(loop.target) if isinstance(x, ast.Name)}
        return bool(inside) and not over & {x.id for x in ast.walk(node.target) if isinstance(x, ast.Name)}
    held = [ast.unparse(x.targets[0]) for x in nodes_of(text) if isinstance(x, ast.Assign)]
    call = node.value if isinstance(node, ast.Expr) else None
    if not isinstance(call, ast.Call) or ast.unparse(call.func) not in ("max", "min"):
        return False
    arguments = [*map(ast.unparse, call.args)]
    return after in arguments and any(x in held for x in arguments)


def _left_over(edit: Edit, text: str) -> bool:
    """Whether a change puts the variable of a loop, or of a comprehension, where it has only its last value."""
    new = {x.id for x in nodes_of(edit.wrong) if isinstance(x, ast.Name)} - {
        x.id for x in nodes_of(edit.right) if isinstance(x, ast.Name)
    }
    loops = [x for x in nodes_of(text) if isinstance(x, ast.For) and ast.unparse(x.target) in new]
    return bool(loops) and not any(x.lineno <= edit.line <= (x.end_lineno or 0) for x in loops)


def _added_up(edit: Edit, text: str) -> bool:
    """Whether a change puts what is added up in place of the variable of a loop."""
    old, new = ({x.id for x in nodes_of(part) if isinstance(x, ast.Name)} for part in (edit.right, edit.wrong))
    loops = {ast.unparse(x.target) for x in nodes_of(text) if isinstance(x, ast.For)}
    sums = {ast.unparse(x.target) for x in nodes_of(text) if isinstance(x, ast.AugAssign)}
    return bool((old - new) & loops) and bool((new - old) & sums)

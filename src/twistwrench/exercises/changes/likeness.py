"""Which changes are the same for a student, and which are less likely to be the slip than others."""

from __future__ import annotations

import ast
from dataclasses import replace

from .crosses import cross_text, difference_text
from .plausible import nested
from .whole import Edit

__all__ = ["ALIKE", "BESIDE", "alike", "anywhere", "blames", "by_detour", "renames", "zeroes"]

ALIKE = {"exchanged": "sign", "halves": "sign", "sign": "sign", "transposed": "transposed", "left out": "left out"}
"""Kinds of which one may make right what another does, and which are then the same for a student."""

BESIDE = ("name", "index", "instead", "left out")
"""Kinds of which another one, of another text, is another thing for a student."""


def alike(edit: Edit, other: Edit) -> bool:
    """Whether two changes are the same for a student: the factors of a cross product and its lever arm are two."""
    within = nested(edit, other)
    taken_out = "left out" in (edit.kind, other.kind)
    if edit.line == other.line and within and (edit.kind != other.kind or edit.wrong == other.wrong) and not taken_out:
        return True  # the sign of a piece, and the transpose of it: there it does the same
    if "sign" in (ALIKE.get(edit.kind), ALIKE.get(other.kind)) or {edit.kind, other.kind} == {"transposed"}:
        crossed, levers = ([f(x.right) for x in (edit, other)] for f in (cross_text, difference_text))
        two = edit.kind == other.kind == "exchanged" and crossed == levers[::-1] and any(crossed)
        return not two and ALIKE.get(edit.kind) == ALIKE.get(other.kind)
    if edit.kind == other.kind:
        inverse = all("np.linalg.inv(" in x.wrong for x in (edit, other))  # of one matrix, here or there
        return within or inverse or edit.kind not in BESIDE or edit.everywhere != other.everywhere
    return (edit.kind not in ALIKE or other.kind not in ALIKE) and (within or edit.line == other.line)


def by_detour(edit: Edit) -> bool:
    """Whether a change is less likely than one after it: an inverse, factors or a whole product turned round."""
    node, other = edit.places[0][2:] if edit.places else (None, None)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult) and isinstance(other, ast.BinOp):
        turned = ast.unparse(node.left) == ast.unparse(other.right)
        return turned or edit.kind == "transposed" or _inverts(edit)
    return _inverts(edit) or (edit.kind == "transposed" and isinstance(node, ast.BinOp))


def blames(edit: Edit) -> bool:
    """Whether a change says that what its line computes is wrong, and not only that it is the wrong thing here."""
    return edit.kind in ("sign", "exchanged", "halves", "left out", "number", "inserted") or _inverts(edit)


def renames(edit: Edit) -> bool:
    """Whether a change exchanges the names of several results, or turns one wherever it is used.

    The names may be right, and their use wrong.
    """
    node = edit.places[0][2] if edit.places else None
    names = node.targets[0] if isinstance(node, ast.Assign) else node
    if edit.kind == "sign" and edit.everywhere:
        return True
    return edit.kind == "exchanged" and isinstance(names, ast.Tuple) and isinstance(names.ctx, ast.Store)


def zeroes(edit: Edit) -> bool:
    """Whether an entry of a list or tuple stays there, and becomes zero."""
    if edit.kind != "left out" or not edit.places:
        return False
    node, other = edit.places[0][2:]
    entries = isinstance(node, ast.List | ast.Tuple) and isinstance(other, ast.List | ast.Tuple)
    return entries and len(node.elts) == len(other.elts)


def _inverts(edit: Edit) -> bool:
    return "np.linalg.inv(" in edit.wrong and "np.linalg.inv(" not in edit.right


def anywhere(edit: Edit, other: Edit) -> Edit:
    """Return a change without its place, if the same one in another place of the line does the same."""
    texts = ((x.kind, x.right, x.wrong, x.line) for x in (edit, other))
    same = len({*texts}) == 1 and edit.places != other.places
    if edit.places and other.places:
        (around, _, node, *_), (others, _, within, *_) = edit.places[0], other.places[0]
        if any(x is node for x in (*others, within)) or any(x is within for x in around):
            return edit  # it is the same, or one is within the other
    return replace(edit, places=()) if same and not edit.everywhere and not other.everywhere else edit

"""Whether a student's own code bears out a slip with the same numbers: what is false of his code is not said of him."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Sequence
from typing import Any

from ..changes.crosses import cross_text, difference_text, nodes_of
from ..changes.repair import Repair
from ..changes.whole import Edit
from ..changes.written import text_written
from ..exercise import Part
from ..slips import SLIPS
from ..words.phrases import say
from ..words.text import Text

__all__ = ["borne_out", "by_own_line", "by_piece_borne_out", "in_other_roles", "own_lines", "shown_in", "traced"]

SIGNS = {"cross-order": "cross(", "lever-reversed": " - "}
"""Slips that give the same numbers, the sign of a cross product, and what stands in the line that is turned round."""

TURNED = ("sign", "wrong end", "mirrored", "factors of the cross product")
"""Words of the titles of slips that change a sign."""

FORCES = ("children-overwritten", "children-dropped")
"""Slips that may give the numbers of a loop in the wrong direction."""

BACKWARD = ("inverse", "wrong way")
"""Words of the titles of slips that no sign mends, but by chance."""

NO_SIGN = ("left out", "index", "name", "last", "summed", "argument")
"""Kinds of changes that do not give back a sign."""

TRACES = {"ᵀ": (".T", ".mT", "transpose", "swapaxes", "einsum"), "⁻¹": ("inv", "solve", ".T", ".mT")}
"""By what it is seen in a program that something is transposed, or inverted."""

WRITTEN = {
    "base-twice": r"(?s)bod(y|ies)|links?\b|\.inertia|\A(?!.*tw\.)",
    "qwxyz": r"quat|qw|1(\.0?)?, *0(\.0?)?, *0|\[(3:7|-4:)\]|\bq\w*\[",
}
"""What is written where a slip can be made, by its name."""

WORDS = {"transpose": TRACES["ᵀ"], "inverse": ("inv", "solve", "inverse")}
"""The same for slips that have the word in their name."""


def borne_out(part: Part, found: list[str], function: Callable[..., Any], mended: Sequence[Repair]) -> list[str]:
    """Return of the slips with the student's numbers those that his source and the lines found in it bear out.

    Parameters
    ----------
    part : Part
    found : list of str
    function : callable
        The student's.
    mended : sequence of Repair
        Each makes it right; empty where none was found.
    """
    source = text_written(function)
    edits = [repair.edit for repair in mended]
    found = by_own_line(found, edits)
    if source:
        found = [slip for slip in found if _spoken(slip, source)]
    if edits:
        found = [slip for slip in found if any(_fits(slip, edit) for edit in edits)]
    if len({edit.line for edit in edits if edit.kind in ("sign", "exchanged")}) > 1:
        found = [slip for slip in found if slip not in SIGNS]  # by its numbers it may be any of these lines
    if edits and {*found} == {*SIGNS}:
        return []  # either would give the sign back, and others as well
    if len(found) < 2 or not source:
        return found

    asked = inspect.getsource(part.solution)  # where an inverse is asked for, the word proves nothing

    def speaks(slip: str) -> int:
        words = [word for key, traces in WORDS.items() if key in slip and key not in asked for word in traces]
        return 1 if not words else 2 * any(word in source for word in words)

    return [slip for slip in found if speaks(slip) == max(map(speaks, found))]


def by_piece_borne_out(
    part: Part, found: dict[str, list[str]], function: Callable[..., Any], mended: Sequence[Repair]
) -> bool:
    """Whether of the slips found in each of several things the student's source, and its lines, bear one out in each.

    The others are taken out of what was found.
    """
    for k, quantity in enumerate(part.returns):
        if quantity.name in found:
            own = [repair for repair in mended if repair.piece in (None, k)]
            found[quantity.name] = borne_out(part, found[quantity.name], function, own)
    return all(found.values())


def shown_in(source: str, edit: Edit) -> bool:
    """Whether a student's source has the wrong text of an edit of a right solution, or lacks what is left out there."""
    own, right, wrong = (re.sub(r"[\s()]", "", text).replace(".mT", ".T") for text in (source, edit.right, edit.wrong))
    if edit.first is not None or edit.kind in ("argument", "result"):
        return False
    if wrong:  # a colon, or a number, is in any
        return len(wrong) > 2 and any(map(str.isalpha, wrong)) and wrong in own and right not in own
    called = re.findall(r"[\w.]+(?=\()", edit.right)
    return (
        right in own if edit.kind == "sign" else edit.kind == "left out" and not any(x in own for x in (right, *called))
    )


def in_other_roles(function: Callable[..., Any], edit: Edit) -> bool:
    """Whether an edit of a right solution puts one thing for another, and a student's code has the right one, or both.

    They may mean other things there, and he would look for the slip where there is none.
    """
    source = text_written(function)
    if edit.kind not in ("name", "index", "instead") or shown_in(source, edit):
        return False
    names = {*re.findall(r"\w+", source)}
    both = {edit.right, edit.wrong} <= names
    return both or (len(edit.right) > 2 and edit.right in source and edit.wrong not in source)


def own_lines(mended: Sequence[Repair], found: Sequence[str]) -> list[Text]:
    """Report the line of the student's where a slip is, or the two where it may be."""
    lacking = any(SLIPS[slip].lacks for slip in found)
    whole = [x for x in mended if x.piece is None and _tells(x, found)]
    whole = [x for x in whole if x.edit.kind != "name" or not lacking or isinstance(x.edit.inside, ast.Call)]
    titles = [x.title() for x in whole[:2] if x.edit.kind == whole[0].edit.kind]
    either = Text("; or ".join(x.en for x in titles), "；或 ".join(x.zh for x in titles))
    remark = whole[0].remark if whole else None
    if remark is not None:
        return [say("own code once", title=either), remark]
    return [say("own code", title=either)] if titles else []


def _tells(repair: Repair, found: Sequence[str]) -> bool:
    """Whether a change of a line shows where a slip is, and is not only another one with the same effect."""
    edit = repair.edit
    inverse = "np.linalg.inv(" in edit.wrong
    if edit.kind == "number":  # a term of a sum is any number's
        return not isinstance(edit.inside, ast.BinOp) or not isinstance(edit.inside.op, ast.Add | ast.Sub)
    if edit.kind == "sign" and any(word in SLIPS[slip].title.en for slip in found for word in BACKWARD):
        return False
    return inverse or not repair.roundabout


def by_own_line(found: list[str], edits: Sequence[Edit]) -> list[str]:
    """Return of a cross product and its lever arm, which give one sign, those that the student's lines reverse."""
    turned = [edit for edit in edits if edit.kind == "exchanged"]
    own = ["" if _of_indices(edit) else _exchanged(edit) for edit in turned]
    if not {*found} & {*SIGNS} or not any(own):
        return found
    first = min(k for k, slip in enumerate(found) if slip in SIGNS)
    others = [[slip] if slip not in SIGNS else [*filter(None, own)] * (k == first) for k, slip in enumerate(found)]
    return [*dict.fromkeys(slip for slips in others for slip in slips)]


def _exchanged(edit: Edit) -> str:
    """Return what an exchange turns round: the factors of a cross product, or the two ends of a lever arm."""
    if cross_text(edit.right):
        return "cross-order"
    ends = _ends(edit.right)
    return "lever-reversed" if ends and ends == _ends(edit.wrong)[::-1] else ""


def _ends(text: str) -> tuple[str, ...]:
    """Return the two ends of a lever arm; none where it is the difference of two products, or of nothing."""
    if not difference_text(text) or re.search(r"[@*]|\b(cross|outer|skew|hat|einsum)\(", text):
        return ()
    (difference,) = (x for x in nodes_of(text)[:3] if isinstance(x, ast.BinOp))
    return ast.unparse(difference.left), ast.unparse(difference.right)


def _of_indices(edit: Edit) -> bool:
    """Whether what is exchanged are variables of loops, which are no points."""
    root = edit.places[0][0][0] if edit.places else ast.Pass()
    loops = [x.target for x in ast.walk(root) if isinstance(x, ast.For | ast.comprehension)]
    indices = {x.id for target in loops for x in ast.walk(target) if isinstance(x, ast.Name)}
    return {*re.findall(r"\b[A-Za-z_]\w*", edit.right)} <= indices


def traced(slip: str, source: str) -> bool:
    """Whether a slip in an inverse can be one of this source: it inverts, or returns what it names an inverse."""
    return (
        not source or "in the inverse" not in SLIPS[slip].title.en or any(word in source for word in WORDS["inverse"])
    )


def _spoken(slip: str, source: str) -> bool:
    """Whether what the slip says to stand there can stand in this source: a transpose, an inverse, a quaternion."""
    if slip in WRITTEN and not re.search(WRITTEN[slip], source):
        return False
    said, meant = _halves(slip)
    said = re.sub(r"(\w) \1ᵀ", "", said)  # an outer product, which needs no transpose
    return not meant or all(any(x in source for x in traces) for key, traces in TRACES.items() if key in said)


def _halves(slip: str) -> tuple[str, str]:
    """Return what the title of a slip says to stand there, and in place of what, where it has both."""
    said, *meant = re.split(" taken for | in place of ", SLIPS[slip].title.en, maxsplit=1)
    return said, meant[0].partition(":")[0] if meant else ""


def _fits(slip: str, edit: Edit) -> bool:
    """Whether the change that mends the student's line undoes this slip, and not another with the same numbers."""
    title, (said, meant) = SLIPS[slip].title.en, _halves(slip)
    if slip in SIGNS:  # a sign alone is neither
        turned = edit.kind == "exchanged" and (SIGNS[slip] in edit.right or "(" not in edit.right)
        return turned and (" - " not in edit.right or slip == _exchanged(edit))
    if "ᵀ" in said and "⁻¹" in meant and edit.kind == "exchanged":
        return False  # nothing is inverted by it that was not
    backward = any(word in edit.right + edit.wrong for word in ("range", "reversed", "[::-1]"))
    if slip in FORCES and backward:
        return False
    if slip == "children-dropped" and edit.wrong.replace("+=", "=") == edit.right:
        return False  # they are added, and then overwritten
    if _is_term(edit):
        return not SLIPS[slip].lacks and not any(word in title for word in TURNED) and sorted(said) != sorted(meant)
    if any(word in title for word in TURNED):
        return edit.kind not in NO_SIGN or edit.kind == "left out"
    return True


def _is_term(edit: Edit) -> bool:
    """Whether a change takes a term or a factor away, and not a number or a condition."""
    node = edit.places[0][2] if edit.places else None
    number = bool(re.fullmatch(r"[-\d.e]*", edit.right))
    return edit.kind == "left out" and isinstance(node, ast.BinOp | ast.AugAssign) and not number

"""A change that makes a student's function right, and how it is said."""

from __future__ import annotations

import ast
from dataclasses import dataclass, replace
from typing import Any

from ..words.phrases import say
from ..words.text import Text
from .excerpts import taken_out, text_of
from .likeness import renames, zeroes
from .places import changed_around, innermost
from .plausible import shuts
from .search import said_where
from .whole import Edit

__all__ = ["Repair"]

SUM = ast.Add | ast.Sub

WRITTEN = ("transposed", "exchanged", "name", "instead", "inserted", "index", "number")
"""Kinds of changes that are printed as what stands there and what must."""

OF_RESULT = {
    "-x": "sign of result",
    "np.roll(x, len(x) // 2, 0)": "halves of result",
    "np.roll(x, len(x.T) // 2, 1)": "halves of columns",
    "np.r_[x[3:6], x[:3], x[6:]]": "halves of base",
    "np.linalg.inv(x)": "inverse of result",
    "x[6:]": "first six of result",
}
"""What a change of the result says of the answer."""


@dataclass(frozen=True)
class Repair:
    """A change that makes a student's function right, or one of the things that it returns.

    Attributes
    ----------
    edit : Edit
    piece : int, optional
        Which of the things is right by it; None for all.
    first : Edit, optional
        Another change that is made before it.
    meaning : Text, optional
        What is said in place of what it puts there.
    unsure : bool
        Whether what its line computes is right, so that another line may be wrong.
    narrow : str
        A special case in which the function is then still wrong, as `case` takes it.
    only : str
        What else is wrong then, where that is known: "earthbound" or "whole", as `Sound.only` has it.
    """

    edit: Edit
    piece: int | None = None
    first: Edit | None = None
    meaning: Text | None = None
    unsure: bool = False
    narrow: str = ""
    only: str = ""

    @property
    def one_piece(self) -> bool:
        """Whether the second of two changes is one of what the first puts there: then they are one."""
        first, edit = self.first, self.edit
        here = first is not None and first.line == edit.line and not first.everywhere and not edit.everywhere
        return bool(first and here and first.wrong and edit.wrong and edit.right.count(first.wrong) == 1)

    @property
    def is_two(self) -> bool:
        """Whether two changes are printed."""
        return (self.first is not None and not self.one_piece) or self.edit.first is not None or bool(self._apart)

    @property
    def _apart(self) -> list[tuple[str, str]]:
        """What stands in each of two places before and after, where one text does not tell both; or that twice."""
        edit = self.edit
        if edit.everywhere != 2:
            return []
        if len({*edit.around}) == 2 and edit.kind in WRITTEN and edit.around[1] not in edit.around[0]:
            return [*zip(edit.around, edit.became)]
        if len({*self._lines}) == 2:
            return [("", ""), ("", "")]
        pairs = [changed_around(place, edit.right) for place in edit.places]
        more = self._statement is not None and text_of(self._statement).count(edit.right) > 2
        return pairs if more and len({*edit.around}) < 2 and all(a for a, _ in pairs) else []

    @property
    def _lines(self) -> list[int]:
        return [place[2].lineno for place in self.edit.places]

    @property
    def line(self) -> int | None:
        """The line where the first of the changes makes another value; None for an argument, a result, or a target."""
        edit, statement = self.first or self.edit, self._statement
        target = isinstance(edit.inside, ast.Subscript) and isinstance(edit.inside.ctx, ast.Store)
        return None if statement is None or target else statement.lineno

    @property
    def remark(self) -> Text | None:
        """What is still wrong after it, if anything is."""
        return say("narrow", case=self.narrow) if self.narrow else say(f"{self.only} then") if self.only else None

    @property
    def in_header(self) -> bool:
        """Whether it takes something out of what a loop runs over, and not a round."""
        edit = self.first or self.edit
        return edit.kind == "left out" and isinstance(self._statement, ast.For) and "range" not in edit.right

    @property
    def _statement(self) -> Any:
        edit = self.first or self.edit
        return innermost(edit.places[0][0]) if edit.places else None

    @property
    def roundabout(self) -> bool:
        """Whether it only undoes what is wrong, on the way in or out, and does not name that."""
        changes = (edit for edit in (self.first, self.edit) if edit is not None)
        return self.unsure or any(
            x.kind == "argument" or (x.kind == "result" and x.wrong not in OF_RESULT) or renames(x) for x in changes
        )

    def title(self) -> Text:
        """Report what must stand where."""
        edit = self.edit
        if self.first is not None and not self.one_piece:
            return say("both edits", first=Repair(self.first).title(), second=Repair(edit).title())
        if self.first is not None:
            edit = replace(
                edit, kind="instead", right=edit.right.replace(self.first.wrong, self.first.right), first=None
            )
        wrong = edit.right
        if edit.kind == "left out" and edit.places:
            wrong = taken_out(edit.places[0][2], edit.places[0][3], wrong)
        title = self.meaning or say(f"repair {edit.kind}", right=edit.wrong, wrong=wrong)
        if edit.kind == "missing" and isinstance(edit.inside, ast.BinOp) and not isinstance(edit.inside.op, SUM):
            title = say("repair instead", right=f"({wrong} {edit.wrong})", wrong=wrong)
        if zeroes(edit):
            title = say("repair zeroed", wrong=wrong)
        if shuts(edit):
            title = say("branch", wrong=edit.right)
        if edit.kind == "result" and edit.wrong in OF_RESULT:
            return say(OF_RESULT[edit.wrong], right=edit.wrong)
        if self._apart and edit is self.edit:
            each = [say("repair instead", wrong=a, right=b) if a else title for a, b in self._apart]
            if title == say("repair left out", right=edit.wrong, wrong=wrong):  # with the operator of each
                taken = [taken_out(node, other, edit.right) for _, _, node, other in edit.places]
                each = [say("repair left out", right="", wrong=text) for text in taken]
            first, second = (say("in own line", line=line, title=x) for line, x in zip(self._lines, each))
            return say("both edits", first=first, second=second)
        if edit.line:
            around, became = changed_around(edit.places[0], edit.right) if edit.places else ("", "")
            if not edit.places and edit.kind != "argument":  # it may be any of them
                title = say("one place", title=title)
            elif around.count(edit.right) > 1 and not edit.everywhere:  # which of them is seen in the whole only
                title = say("repair instead", wrong=around, right=became)
            else:
                title = said_where(edit, title)
            if len({*self._lines}) < 2 or self.first is not None:  # else it is not a change of one line
                title = say("in own line", line=edit.line, title=title)
        if edit.first is not None:
            kind, wrong, right, line = edit.first
            other = say(f"repair {kind}", right=right, wrong=wrong)
            return say("both edits", first=say("in own line", line=line, title=other), second=title)
        return title

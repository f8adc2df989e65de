"""Which of the changes that make a function right are reported: the likeliest, and others of which one may be meant."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from .likeness import ALIKE, BESIDE, alike, anywhere, blames, by_detour, renames
from .repair import Repair
from .whole import Edit

__all__ = ["Chosen", "Lines"]

MOST = 3
"""Changes of which one may be meant."""

SIGNS = frozenset(("sign", "exchanged"))
"""Kinds of changes that turn a sign."""

LONGER = 1.0
"""Seconds for which a better change is looked for, and as long again as the first has taken."""


class Lines(NamedTuple):
    """What is known of the lines of a student's function.

    In `right`: whether a right solution has what a line computes; in `blameless`: whether another one goes wrong first.
    """

    right: Callable[[int], bool]
    blameless: Callable[[int | None], bool]


class Chosen:
    """The changes that are found one after the other, the likeliest kinds first.

    Parameters
    ----------
    lines : Lines, optional
        What is known of the student's lines.
    few : bool
        Whether there is one case only, in which a zero may hide that two signs are two things.
    """

    def __init__(self, lines: Lines | None, *, few: bool = False) -> None:
        self.few = few
        self.lines = lines or Lines(lambda line: False, lambda line: False)
        self.begun, self.until = time.process_time(), math.inf
        self.sure: list[Repair] = []
        self.later: list[Repair] = []
        self.spare: list[Repair] = []
        self.narrow: list[Repair] = []

    @property
    def reported(self) -> list[Repair]:
        """Those that are reported; one that blames a right line, or is wrong elsewhere, only if there is no other."""
        straight = [x for x in self.sure if not x.roundabout]
        likely = sorted(straight, key=lambda repair: by_detour(repair.edit)) + self.later
        return likely[:MOST] or self.spare[:1] or self.sure or self.narrow[:1]

    def ended(self, kind: str) -> bool:
        """Whether the search may end before the changes of this kind."""
        if self.sure and not by_detour(self.sure[0].edit):
            first = self.sure[0].edit.kind
            return kind not in ALIKE and (kind != first or kind not in BESIDE)
        return len(self.sure) == MOST or time.process_time() > self.until

    def judged(self, repair: Repair) -> Repair:
        """Return a change with the mark whether it blames a line that is right."""
        edit = repair.edit
        right = bool(edit.places) and blames(edit) and self.lines.right(edit.line)
        return replace(repair, unsure=renames(edit) or right)

    def add(self, repair: Repair) -> None:
        """Take in a change that makes the function right."""
        edit, now, judged = repair.edit, time.process_time(), self.judged(repair)
        if repair.narrow:
            self.narrow += [] if judged.roundabout else [judged]
            return
        self.until = min(self.until, 2 * now - self.begun + LONGER)
        wrong_before = repair.in_header or self.lines.blameless(repair.line)
        if judged.unsure:
            self.spare.append(judged)
        elif not any(alike(edit, x.edit) and not self._two(edit, x.edit) for x in (*self.sure, *self.later)):
            (self.later if wrong_before else self.sure).append(repair)
        self.sure = [replace(x, edit=anywhere(x.edit, edit)) for x in self.sure]

    def _two(self, edit: Edit, other: Edit) -> bool:
        """Whether two signs of other lines may be two things."""
        return self.few and edit.line != other.line and {edit.kind, other.kind} <= SIGNS

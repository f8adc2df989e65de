"""Whether a change that makes a function right is a cure: it leaves the arguments alone, and holds in special cases."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Any

import numpy as np

from ..calls import copied, keeps_arguments, tried
from ..cases import special_cases, special_name
from ..compare import agree
from ..exercise import Part
from .planets import earthbound, on_earth

__all__ = ["Sound", "has_whole"]

Function = Callable[..., Any]


class Sound:
    """What is asked of a change of a function beyond the cases in which the answer was wrong.

    Parameters
    ----------
    part : Part
    function : callable
        The student's, as it is.
    """

    def __init__(self, part: Part, function: Function) -> None:
        self.part, self.function = part, function

    def good(self, changed: Function, arguments: tuple[Any, ...]) -> bool:
        """Whether a changed function is right in the degenerate cases in which it gave an answer before.

        Nor may it change an argument that it left as it was.
        """
        part = self.part
        edges = [c for c in part.edges(np.random.default_rng(0)) if tried(part, self.function, c) is not None]
        right = all(agree(part, tried(part, changed, c), part.value(part.solution, copied(c)), c) for c in edges)
        kept = keeps_arguments(part, changed, arguments) or not keeps_arguments(part, self.function, arguments)
        return right and kept

    def everywhere(self, changed: Function) -> bool:
        """Whether a changed function is right in all special cases: what only happens to be right is not."""
        return not self.fails(changed)

    def fails(self, changed: Function) -> str:
        """Return the first special case in which a changed function is wrong, as `case` takes it; empty for none."""
        return next((special_name(self.part, k) for k in self._failing(changed)), "")

    def only(self, changed: Function) -> str:
        """Return what all special cases have in which a function is wrong: "earthbound", "whole", or nothing."""
        bad = [self._special[k][0] for k in self._failing(changed)]
        if all(on_earth(c) is not None for c in bad) and earthbound(self.part, changed, self.part.solution):
            return "earthbound"
        return "whole" if all(map(has_whole, bad)) else ""

    def _failing(self, changed: Function) -> Iterator[int]:
        """Yield which special cases a changed function gets wrong."""
        for k, (arguments, right) in enumerate(self._special):
            if not agree(self.part, tried(self.part, changed, arguments), right, arguments):
                yield k

    @cached_property
    def _special(self) -> list[tuple[tuple[Any, ...], Any]]:
        return [(c, self.part.value(self.part.solution, copied(c))) for c in special_cases(self.part, 0)]


def has_whole(arguments: tuple[Any, ...]) -> bool:
    """Whether one of the arguments is a whole number, or an array of them."""
    return any(isinstance(x, np.ndarray | int) and np.asarray(x).dtype.kind == "i" for x in arguments)

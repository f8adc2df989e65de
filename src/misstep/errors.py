"""The errors of a course: a name that is not known, and a request that cannot be met."""

from __future__ import annotations

import difflib
from collections.abc import Collection

__all__ = ["CourseError", "UnknownName", "check_known"]


class CourseError(ValueError):
    """A request that cannot be met. The message says what was expected and what was got."""


class UnknownName(KeyError, CourseError):
    """A name that is not known. The message lists the nearest known ones."""

    def __str__(self) -> str:
        return str(self.args[0])


def check_known(kind: str, name: object, known: Collection[str], error: type[Exception] = UnknownName) -> None:
    """Raise an error unless a name is known.

    Examples
    --------
    >>> check_known("section", "49.20", ["49.1", "49.2"])
    Traceback (most recent call last):
    misstep.errors.UnknownName: unknown section '49.20'; did you mean '49.2', '49.1'?
    """
    if isinstance(name, str) and name in known:
        return
    near = difflib.get_close_matches(str(name), known, n=4, cutoff=0.5)
    shown = ", ".join(map(repr, near or [*known][:12]))
    raise error(f"unknown {kind} {name!r}; " + (f"did you mean {shown}?" if near else f"known: {shown or 'none'}"))

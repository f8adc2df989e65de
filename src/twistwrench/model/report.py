"""The report of a loader: what it found, and how it was interpreted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..tables import html_table, text_table

__all__ = ["Entry", "LoadReport"]


@dataclass(frozen=True)
class Entry:
    """One finding: an entry that violates the format or is not physical, and how it was interpreted.

    Attributes
    ----------
    where : str
        The link, the joint, or the file.
    found : str
        The text of the file.
    read_as : str
        How it was interpreted.
    line : int or None
        Of the file.
    warns : bool
        Whether `twistwrench.load` warns of this, and rejects it under ``strict=True``. False where an argument asked
        for it, or where it is read as it stands and merely worth knowing, as damping is.
    """

    where: str
    found: str
    read_as: str
    line: int | None = None
    warns: bool = True


class LoadReport(tuple[Entry, ...]):
    """The findings of a loader, a tuple of `Entry`; prints as a table. Empty where the file is clean.

    Examples
    --------
    >>> LoadReport([Entry("joint 'j'", "no <limit>", "no limits", line=4)])
    line  where      found       read as
    4     joint 'j'  no <limit>  no limits
    >>> LoadReport()
    nothing to report
    """

    __slots__ = ()

    columns = ("line", "where", "found", "read as")

    @property
    def warnings(self) -> LoadReport:
        """The entries that `twistwrench.load` warns of."""
        return LoadReport(entry for entry in self if entry.warns)

    def summary(self) -> str:
        """Return one line for each interpretation, with the first places."""
        groups: dict[str, list[Entry]] = {}
        for entry in self:
            groups.setdefault(entry.read_as, []).append(entry)
        return "".join(f"\n  {_places(entries)}: read as {read_as}" for read_as, entries in groups.items())

    def _cells(self) -> list[list[str]]:
        return [["" if e.line is None else str(e.line), e.where, e.found, e.read_as] for e in self]

    def __repr__(self) -> str:
        return text_table(self.columns, self._cells()) if self else "nothing to report"

    def _repr_html_(self) -> str:
        return html_table(self.columns, self._cells()) if self else f"<p>{self}</p>"


def _places(entries: Sequence[Entry], shown: int = 4) -> str:
    lines = ["" if e.line is None else f"line {e.line}: " for e in entries]
    places = [f"{e.where} ({line}{e.found})" for e, line in zip(entries[:shown], lines)]
    return ", ".join(places) + (f" and {len(entries) - shown} more" if len(entries) > shown else "")

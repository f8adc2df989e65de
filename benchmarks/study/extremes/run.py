"""The grid measured cell by cell; cells on file are not measured again."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from twistwrench.files import errors_name, write_text

from .cell import Outcome, measure
from .robots import Recipe

__all__ = ["Cell", "read", "run"]


START = '{"cell": '
"""The beginning of a line on file."""


@dataclass(frozen=True)
class Cell:
    """A cell and its outcomes."""

    recipe: Recipe
    outcomes: tuple[Outcome, ...]

    def __str__(self) -> str:
        """Return in words which values are not the usual ones."""
        return ", ".join(f"{name} {x if isinstance(x, bool) else f'{x:g}'}" for name, x in self.recipe.changed.items())

    def as_line(self) -> str:
        """Return it as a line of JSON: the values that are not the usual ones, then the outcome of every way."""
        return json.dumps({"cell": self.recipe.changed, "outcomes": [_short(o) for o in self.outcomes]})

    @classmethod
    def from_line(cls, line: str) -> Cell:
        """Read a line of `as_line`."""
        found = json.loads(line)
        return cls(Recipe(**found["cell"]), tuple(_whole(**o) for o in found["outcomes"]))


def _short(outcome: Outcome) -> dict[str, Any]:
    """Return an outcome without its defaults; an infinite estimate as a word, since JSON has no number for it."""
    found = {name: x for name, x in asdict(outcome).items() if x not in (None, "")}
    return found | ({"estimate": "inf"} if found.get("estimate") == float("inf") else {})


def _whole(estimate: float | str | None = None, **others: Any) -> Outcome:
    """Return the outcome that `_short` shortened."""
    return Outcome(estimate=None if estimate is None else float(estimate), **others)


def read(path: Path) -> list[Cell]:
    """Return the cells on file. The last line may have been cut off where the study was stopped: it is left out.

    Raises
    ------
    OSError
        If any other line is not a cell: the file is something else, and would be lost.
    """
    text = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
    *lines, cut = text.split("\n")  # each line is ended when it is whole
    if not START.startswith(cut[: len(START)]):
        lines.append(cut)
    cells = []
    for number, line in enumerate(lines, 1):
        try:
            cells.append(Cell.from_line(line))
        except (ValueError, TypeError, KeyError):
            raise OSError(f"{path}, line {number}: expected a cell of this study; the file was left as it is") from None
    return cells


def run(recipes: Sequence[Recipe], path: Path | None, *, pinocchio: bool, progress: bool) -> list[Cell]:
    """Measure the cells that are not yet on file, add each to it at once, and return all in the order of the recipes.

    Parameters
    ----------
    recipes : sequence of Recipe
    path : Path, optional
        Of the file, a cell a line.
    pinocchio : bool
        Whether Pinocchio is measured as well.
    progress : bool
        Whether a bar is shown on stderr.
    """
    from tqdm import tqdm

    known = {cell.recipe: cell for cell in (read(path) if path else [])}
    missing = [recipe for recipe in recipes if recipe not in known]
    bar = tqdm(
        missing, "extremes", len(recipes), unit="cell", disable=not progress, initial=len(recipes) - len(missing)
    )
    for cell in _kept(_measured(bar, pinocchio=pinocchio), path, known.values()):
        known[cell.recipe] = cell
    return [known[recipe] for recipe in recipes]


def _measured(recipes: Iterable[Recipe], *, pinocchio: bool) -> Iterator[Cell]:
    for recipe in recipes:
        yield Cell(recipe, tuple(measure(recipe, pinocchio=pinocchio)))


def _kept(cells: Iterable[Cell], path: Path | None, known: Iterable[Cell]) -> Iterator[Cell]:
    """Append each cell to the file before yielding it; a last line that was cut off is removed."""
    if path is None:
        yield from cells
        return
    write_text(path, "".join(cell.as_line() + "\n" for cell in known))
    for cell in cells:
        with errors_name(path), path.open("a", encoding="utf-8") as file:
            file.write(cell.as_line() + "\n")
        yield cell

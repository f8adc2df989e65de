"""The map of an algorithm: a square for every cell, its colour the digits kept, hatched where an error is raised."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from twistwrench.files import replacing
from twistwrench.plot.style import COLOURS

from .cell import Outcome
from .grid import DIMENSIONS, ENDS, WORDS, of_pair, of_value
from .robots import Recipe
from .run import Cell

__all__ = ["draw", "save"]

DIGITS = 17
"""The end of the scale: errors below 1e-17 have one colour."""

NAMES = {
    "rnea": "rnea",
    "crba": "crba",
    "aba, steered": "aba_steered",
    "aba, pushed": "aba_pushed",
    "crba + solve, steered": "solve_steered",
    "crba + solve, pushed": "solve_pushed",
    "centroidal map": "centroidal_map",
    "J̇v": "bias",
}
"""The algorithms, and the names of their files."""

SAID = "accuracy"
"""The column of what `twistwrench.accuracy` predicted."""

TITLES = {
    "textbook": "textbook",
    "fast": "tw.fast",
    "float32": "textbook, float32",
    "pinocchio": "Pinocchio",
    SAID: "tw.accuracy, at least",
}

Found = dict[tuple[Recipe, str], Outcome]


class Square(NamedTuple):
    """A cell, or several that share a place: their outcomes, and the text written on it."""

    column: int
    row: int
    outcomes: list[Outcome]
    text: str = ""


def save(cells: Sequence[Cell], folder: Path) -> list[Path]:
    """Draw a map of every algorithm into a folder, and return the files."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for algorithm, name in NAMES.items():
        figure = Figure(figsize=(14.0, 8.6), dpi=100, layout="constrained")
        canvas: Any = FigureCanvasAgg(figure)
        draw(cells, algorithm, figure)
        canvas.draw()
        paths.append(folder / f"extremes_{name}.png")
        whole = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
        few = whole.quantize(128, method=Image.Quantize.FASTOCTREE)  # a third of the bytes, and rare colours stay
        with replacing(paths[-1]) as beside:
            few.save(beside, optimize=True)
    return paths


def draw(cells: Sequence[Cell], algorithm: str, figure: Any) -> None:
    """Draw the map of an algorithm: above one thing at its limit at a time, below two at once."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm

    colours = colormaps["cividis"].resampled(DIGITS)
    found = _found(cells, algorithm)
    ways = [who for who in TITLES if any(w == who for _, w in found)]
    axes = figure.subplots(2, len(ways), squeeze=False)
    for column, who in enumerate(ways):
        above, below = axes[:, column]
        for ax, squares in ((above, _alone(found, who)), (below, _pairs(found, who))):
            for square in squares:
                _paint(ax, square, colours)
        widest = max(map(len, DIMENSIONS.values()))
        _frame(above, list(DIMENSIONS), [""] * widest, labelled=column == 0)
        _frame(below, list(ENDS), [name.replace("_", " ") for name in ENDS][:-1], labelled=column == 0)
        above.set_title(TITLES[who], fontsize=10)
    axes[0, 0].set_ylabel("one thing at a time")
    axes[1, 0].set_ylabel("two at once, the worst of their ends")
    shown = ScalarMappable(BoundaryNorm(np.arange(DIGITS + 1), DIGITS), colours)
    figure.colorbar(shown, ax=axes, shrink=0.6, aspect=40, pad=0.01).set_label("decimal digits kept")
    figure.suptitle(f"{algorithm}: digits kept; hatched: an error was raised; red: a NaN", fontsize=11)


def _found(cells: Sequence[Cell], algorithm: str) -> Found:
    """Return the outcomes of an algorithm, and beside them the predictions of `accuracy`."""
    found = {(c.recipe, o.who): o for c in cells for o in c.outcomes if o.algorithm == algorithm}
    for (recipe, who), o in list(found.items()):
        if who == "textbook" and o.estimate is not None:
            nothing = o.estimate >= 1
            found[recipe, SAID] = Outcome(
                algorithm, SAID, error=None if nothing else o.estimate, raised="unsure" * nothing
            )
    return found


def _alone(found: Found, who: str) -> Iterator[Square]:
    for y, (name, values) in enumerate(DIMENSIONS.items()):
        for x, value in enumerate(values):
            if outcome := found.get((of_value(name, value), who)):
                yield Square(x, y, [outcome], _short(value))


def _short(value: float) -> str:
    """Write a value as short as possible."""
    if abs(value) == np.pi:
        return "π" if value > 0 else "−π"
    return re.sub(r"e([+-])0*(\d)", lambda m: "e" + m[1].strip("+") + m[2], f"{value:g}")


def _pairs(found: Found, who: str) -> Iterator[Square]:
    for y, first in enumerate(ENDS):
        for x, second in enumerate(list(ENDS)[:y]):
            outcomes = [o for recipe in of_pair(second, first, full=True) if (o := found.get((recipe, who)))]
            if outcomes:
                yield Square(x, y, outcomes)


def _paint(ax: Any, square: Square, colours: Any) -> None:
    """Paint a square in the colour of its least digits, a NaN red, and hatch it where an error was raised."""
    from matplotlib.patches import Rectangle

    errors = [o.error for o in square.outcomes if o.error is not None]
    digits = int(np.clip(-np.log10(max([*errors, 1e-17])), 0, DIGITS - 1)) if errors else None
    face = "white" if digits is None else colours(digits)
    if any(o.bad for o in square.outcomes):
        face = COLOURS["vermilion"]
    raised = any(o.raised for o in square.outcomes)
    hatch, edge = ("/////", COLOURS["grey"]) if raised else (None, "white")
    corner = square.column, square.row
    ax.add_patch(Rectangle(corner, 1, 1, facecolor=face, edgecolor=edge, hatch=hatch, linewidth=0.5))
    dark = digits is not None and digits < DIGITS * 0.6
    style: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 5, "color": "white" if dark else "black"}
    if raised and digits is None and square.text:
        style["bbox"] = {"facecolor": "white", "linewidth": 0, "pad": 0.5}
    ax.text(square.column + 0.5, square.row + 0.5, square.text, **style)


def _frame(ax: Any, rows: list[str], columns: list[str], *, labelled: bool) -> None:
    ax.set(xlim=(0, len(columns)), ylim=(len(rows), 0))
    ax.set_yticks(np.arange(len(rows)) + 0.5, [WORDS[n] if labelled else "" for n in rows], fontsize=7)
    ax.set_xticks(np.arange(len(columns)) + 0.5, columns, fontsize=6, rotation=90)
    ax.tick_params(length=0)
    for spine in ax.spines.values():
        spine.set_visible(False)

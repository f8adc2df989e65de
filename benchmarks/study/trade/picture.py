"""Error over time, one panel a quantity, both in powers of ten."""

from __future__ import annotations

from collections.abc import Iterable
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import Any

from twistwrench.files import replacing
from twistwrench.plot.style import COLOURS, NO_MATPLOTLIB

from .measure import Point
from .report import Trade

__all__ = ["check_format", "draw"]

FLOOR = 1e-38
"""Smaller errors are drawn on the bottom line, and a note gives their size."""

MARKERS = {"float32": "v", "float64": "o", "longdouble": "s", "double-double": "P", "20 digits": "D", "50 digits": "*"}
OWN = {
    "tw.fast.": "vermilion",
    "tw.compile ": "orange",
    "tw.": "blue",
    "newton_euler_3d": "green",
    "mpmath": "green",
    "pin.": "black",
}
OTHERS = ("sky", "purple", "grey", "yellow")
COLUMNS = 3
FORMATS = (".png", ".svg", ".pdf")


def check_format(path: Path) -> None:
    """Raise for a file that could not be drawn, or where matplotlib is missing.

    Raises
    ------
    OSError
        If the suffix is not one of a known format.
    ImportError
        If matplotlib is not installed.
    """
    if path.suffix not in FORMATS:
        raise OSError(f"--plot {path}: expected a file that ends with one of {', '.join(FORMATS)}")
    if find_spec("matplotlib") is None:
        raise ImportError(NO_MATPLOTLIB)


def draw(trade: Trade, path: Path) -> None:
    """Draw all quantities of a robot into a file.

    Parameters
    ----------
    trade : Trade
    path : Path
        Its suffix sets the format: png, svg, pdf.
    """
    from matplotlib.figure import Figure

    keys = [key for key in trade.names if trade.of(key)]
    rows = -(-len(keys) // COLUMNS)
    figure = Figure(figsize=(4.2 * COLUMNS, 3.9 * rows + 0.9), layout="constrained")
    panels = figure.subplots(rows, COLUMNS, squeeze=False).flat
    for ax, key in zip(panels, keys, strict=False):
        panel(ax, trade, key)
    for ax in list(panels):
        ax.remove()
    figure.suptitle(f"{trade.robot}: what a digit costs")
    _explain(figure)
    _save(figure, path)


def _save(figure: Any, path: Path) -> None:
    """Write the picture; PNG with a palette, which is a third of the size."""
    if path.suffix != ".png":
        with replacing(path) as beside:
            figure.savefig(beside)
        return
    from PIL import Image

    page = BytesIO()
    figure.savefig(page, dpi=100, format="png")
    colours, plain = Image.open(page).convert("RGB"), Image.Dither.NONE
    with replacing(path) as beside:
        colours.quantize(128, Image.Quantize.MAXCOVERAGE, dither=plain).save(beside, optimize=True)


def panel(ax: Any, trade: Trade, key: str) -> Any:
    """Draw one quantity: a colour for each way, a shape for each number type, filled where many states are one call.

    Parameters
    ----------
    ax : matplotlib Axes
    trade : Trade
    key : str
        Of the quantity.

    Returns
    -------
    matplotlib Axes
        `ax`.
    """
    points = trade.of(key)
    colours = _colours(dict.fromkeys(p.way for p in points))
    for points_of_front, style in zip(trade.fronts(key), ("--", "-"), strict=True):
        x, y = [p.seconds for p in points_of_front], [max(p.error, FLOOR) for p in points_of_front]
        ax.plot(x, y, style, color=COLOURS["grey"], linewidth=1, drawstyle="steps-post", zorder=1)
    for p in points:
        colour = COLOURS[colours[p.way]]
        face = colour if p.states > 1 else "white"
        size = 9 if p.number == "50 digits" else 6
        where = p.seconds, max(p.error, FLOOR)
        ax.plot(*where, MARKERS[p.number], color=colour, markerfacecolor=face, markersize=size, clip_on=False)
    _note_the_floor(ax, points)
    ax.set(xscale="log", yscale="log", ylim=(FLOOR, max(1e-4, 10 * max(p.error for p in points))))
    ax.set(title=trade.names[key], xlabel="time for one state [s]", ylabel="relative error")
    ax.grid(alpha=0.3)
    _name_the_ways(ax, colours)
    return ax


def _colours(ways: Iterable[str]) -> dict[str, str]:
    """Give each way a colour: the package's and Pinocchio's always the same, where they are the first of theirs."""
    given: dict[str, str] = {}
    spare = iter(OTHERS)
    for way in ways:
        own = next((colour for start, colour in OWN.items() if way.startswith(start)), "")
        given[way] = own if own and own not in given.values() else next(spare)
    return given


def _note_the_floor(ax: Any, points: Iterable[Point]) -> None:
    """Note the smallest error among those on the bottom line."""
    below = [p.error for p in points if p.error < FLOOR]
    if below:
        text = f"on the bottom line: down to {min(below):.0e}" if min(below) else "on the bottom line: down to 0"
        ax.text(0.02, 0.03, text, transform=ax.transAxes, fontsize=7)


def _name_the_ways(ax: Any, colours: dict[str, str]) -> None:
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], color=COLOURS[c], marker="o", linestyle="", label=way) for way, c in colours.items()]
    columns = 1 if max(map(len, colours)) > 31 else 2
    where = {"loc": "upper center", "bbox_to_anchor": (0.45, -0.17)}
    ax.legend(handles=handles, **where, ncols=columns, fontsize=7, frameon=False, handletextpad=0, columnspacing=0.5)


def _explain(figure: Any) -> None:
    """Explain shapes, fillings and lines below all panels."""
    from matplotlib.lines import Line2D

    black, grey = COLOURS["black"], COLOURS["grey"]
    kinds = [Line2D([], [], color=black, marker=m, linestyle="", label=name) for name, m in MARKERS.items()]
    hollow = Line2D([], [], color=black, marker="o", markerfacecolor="white", linestyle="", label="hollow: one state")
    full = Line2D([], [], color=black, marker="o", linestyle="", label="filled: many states in one call")
    one = Line2D([], [], color=grey, linestyle="--", label="Pareto front for one state")
    many = Line2D([], [], color=grey, linestyle="-", label="for many")
    figure.legend(handles=[*kinds, hollow, full, one, many], loc="outside lower center", ncols=5, fontsize=9)

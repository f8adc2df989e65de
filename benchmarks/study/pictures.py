"""The pictures of the studies: each draws its records, and all are saved in one way."""

import re
from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench.files import replacing
from twistwrench.motions import Motion
from twistwrench.plot.style import COLOURS, NO_MATPLOTLIB, XYZ
from twistwrench.templates import TEMPLATES

from .budget import SOURCES
from .extremes.cells import ALGORITHMS, Cell
from .extremes.grid import DIMENSIONS, ENDS, WORDS, of_pair, of_value
from .record import Record
from .trade import Trade

FORMATS = (".png", ".svg", ".pdf")


def check_format(path: Path) -> None:
    """Raise for a file that could not be drawn, or where matplotlib is missing."""
    if path.suffix not in FORMATS:
        raise OSError(f"--plot {path}: expected a file that ends with one of {', '.join(FORMATS)}")
    if find_spec("matplotlib") is None:
        raise ImportError(NO_MATPLOTLIB)


def _figure(width: float, height: float) -> Any:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def save(figure: Any, path: Path) -> None:
    """Write a picture, in the format of its suffix; PNG with a palette, which is a third of the size."""
    with replacing(path) as beside:
        if path.suffix != ".png":
            figure.savefig(beside)
            return
        from PIL import Image

        page = BytesIO()
        figure.savefig(page, dpi=100, format="png")
        drawn, kind = Image.open(page), Image.Quantize.FASTOCTREE  # the one that keeps what can be seen through
        if figure.patch.get_alpha() != 0:
            drawn, kind = drawn.convert("RGB"), Image.Quantize.MAXCOVERAGE
        few = drawn.quantize(128, kind, dither=Image.Dither.NONE)
        few.save(beside, optimize=True)


# ---------------------------------------------------------------- trade: error over time

FLOOR = 1e-38  # smaller errors are drawn on the bottom line, and a note gives their size
MARKERS = {"float32": "v", "float64": "o", "longdouble": "s", "double-double": "P", "20 digits": "D", "50 digits": "*"}
OWN = {"tw.fast.": "vermilion", "tw.compile ": "orange", "tw.": "blue", "newton_euler_3d": "green", "mpmath": "green"}
OWN["pin."] = "black"
OTHERS = ("sky", "purple", "grey", "yellow")
COLUMNS = 3


def draw_trade(trade: Trade) -> Any:
    """Draw all quantities of a robot, one panel each: both axes in powers of ten."""
    keys = [key for key in trade.names if trade.points(key)]
    rows = -(-len(keys) // COLUMNS)
    figure = _figure(4.2 * COLUMNS, 3.9 * rows + 0.9)
    panels = figure.subplots(rows, COLUMNS, squeeze=False).flat
    for ax, key in zip(panels, keys, strict=False):
        _draw_quantity(ax, trade, key)
    for ax in list(panels):
        ax.remove()
    figure.suptitle(f"{trade.robot}: what a digit costs")
    kinds = [_handle(name, "black", marker) for name, marker in MARKERS.items()]
    kinds += [_handle("hollow: one state", "black", "o", face="white"), _handle("filled: many states", "black", "o")]
    kinds += [_handle("Pareto front for one state", "grey", line="--"), _handle("for many", "grey", line="-")]
    figure.legend(handles=kinds, loc="outside lower center", ncols=5, fontsize=9)
    return figure


def _handle(label: str, colour: str, marker: str = "", *, face: str | None = None, line: str = "") -> Any:
    """Return a line of a legend."""
    from matplotlib.lines import Line2D

    colour = COLOURS[colour]
    return Line2D([], [], color=colour, marker=marker, linestyle=line, markerfacecolor=face or colour, label=label)


def _draw_quantity(ax: Any, trade: Trade, key: str) -> None:
    """Draw one quantity: a colour for each way, a shape for each number type, filled where many states are one call."""
    points = trade.points(key)
    colours = _colours(dict.fromkeys(p.way for p in points))
    for of_front, style in zip(trade.fronts(key), ("--", "-"), strict=True):
        x, y = [p.seconds for p in of_front], [max(p.error, FLOOR) for p in of_front]
        ax.plot(x, y, style, color=COLOURS["grey"], linewidth=1, drawstyle="steps-post", zorder=1)
    for p in points:
        colour = COLOURS[colours[p.way]]
        look = {"color": colour, "markerfacecolor": colour if p.states > 1 else "white", "clip_on": False}
        ax.plot(
            p.seconds, max(p.error, FLOOR), MARKERS[p.number], markersize=9 if p.number == "50 digits" else 6, **look
        )
    note_floor(ax, points)
    ax.set(xscale="log", yscale="log", ylim=(FLOOR, max(1e-4, 10 * max(p.error for p in points))))
    ax.set(title=trade.names[key], xlabel="time for one state [s]", ylabel="relative error")
    ax.grid(alpha=0.3)
    ways = [_handle(way, colour, "o") for way, colour in colours.items()]
    where = {"loc": "upper center", "bbox_to_anchor": (0.45, -0.17), "ncols": 1 if max(map(len, colours)) > 31 else 2}
    ax.legend(handles=ways, **where, fontsize=7, frameon=False, handletextpad=0, columnspacing=0.5)


def _colours(ways: Iterable[str]) -> dict[str, str]:
    """Give each way a colour: the package's and Pinocchio's always the same, where they are the first of theirs."""
    given: dict[str, str] = {}
    spare = iter(OTHERS)
    for way in ways:
        own = next((colour for start, colour in OWN.items() if way.startswith(start)), "")
        given[way] = own if own and own not in given.values() else next(spare)
    return given


def note_floor(ax: Any, points: Iterable[Record]) -> None:
    """Note the smallest error among those on the bottom line."""
    below = [p.error for p in points if p.error < FLOOR]
    if below:
        least = f"{min(below):.0e}" if min(below) else "0"
        ax.text(0.02, 0.03, f"on the bottom line: down to {least}", transform=ax.transAxes, fontsize=7)


# ---------------------------------------------------------------- budget: a row for each source

KINDS = {"number": "green", "time": "blue", "model": "orange", "state": "purple", "slip": "vermilion"}


def draw_budget(found: Sequence[Record], title: str) -> Any:
    """Draw the torque and the centre of pressure of each source, both scales in powers of ten."""
    figure = _figure(9, 0.6 + 0.27 * len(SOURCES))
    axes = figure.subplots(1, 2, sharey=True)
    for ax, quantity, label in zip(axes, ("torque", "pressure"), ("worst motor [N m]", "centre of pressure [mm]")):
        for row, record in enumerate(r for r in found if r.quantity == quantity):
            ax.plot(record.error, row, "o", color=COLOURS[KINDS[SOURCES[record.way][0]]])
        ax.set(xscale="log", xlabel=label)
        ax.grid(axis="both", color="0.9")
        ax.set_axisbelow(True)
    axes[0].set_yticks(range(len(SOURCES)), list(SOURCES))
    axes[0].invert_yaxis()
    figure.suptitle(title)
    return figure


# ---------------------------------------------------------------- templates: k̇_G and the residuals over each motion

LINES = {"point_mass": ("blue", "-"), "lipm": ("orange", "--"), "srbm_frozen": ("sky", ":"), "srbm": ("vermilion", "-")}
LEAST = 1e-4
"""Where the axis of the residuals begins. Smaller ones are outside the picture, and a note gives their size."""


def draw_templates(model: tw.Model, motions: Sequence[Motion]) -> Any:
    """Draw k̇_G above and the residuals of the templates below, a column for each motion."""
    figure = _figure(11, 5.2)
    axes = figure.subplots(2, len(motions), squeeze=False, sharey="row")
    for motion, above, below in zip(motions, *axes, strict=True):
        _draw_rates(model, motion, above)
        draw_residuals(model, motion, below)
    axes[0, 0].set_ylabel("k̇_G / weight [mm]")
    axes[1, 0].set_ylabel("left out of ḣ_G / weight")
    axes[0, 0].legend(loc="upper left", ncols=3, fontsize=8)
    figure.legend(*axes[1, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(LINES), fontsize=9)
    return figure


def _draw_rates(model: tw.Model, motion: Motion, ax: Any) -> None:
    """Draw k̇_G over the weight, a length: where the load is the weight, the shift of the centre of pressure."""
    rate = tw.centroidal_momentum_rate(model, motion.q, motion.v, motion.a)[:, :3]
    shift = 1e3 * rate / (model.mass * np.sqrt((model.gravity**2).sum()))
    for k, (name, colour) in enumerate(zip("xyz", XYZ)):
        ax.plot(motion.t, shift[:, k], color=colour, label=name)
    largest = np.sqrt((shift**2).sum(axis=1)).max()
    ax.text(0.97, 0.93, f"largest {largest:.3g} mm", ha="right", va="top", transform=ax.transAxes, fontsize=8)
    ax.set_title(motion.name + ", flight shaded" * _shade_flight(motion, ax))


def draw_residuals(model: tw.Model, motion: Motion, ax: Any) -> None:
    """Draw the relative residuals of the templates, on a logarithmic scale."""
    below = []
    for name, (colour, line) in LINES.items():
        relative = TEMPLATES[name].of(model, model.standing()).residual(motion.q, motion.v, motion.a).relative
        ax.semilogy(motion.t, relative, line, color=COLOURS[colour], label=name)
        if relative.min() < LEAST:
            below.append(f"{name} {relative.min():.0e}")
    if below:
        text = "\n".join(["below the picture, down to", *below])
        ax.text(0.5, 0.04, text, ha="center", va="bottom", transform=ax.transAxes, fontsize=7)
    _shade_flight(motion, ax)
    ax.set(xlabel="t [s]", ylim=(LEAST, 5))


def _shade_flight(motion: Motion, ax: Any) -> bool:
    """Shade the times when no foot stands; return whether there are any."""
    flies = motion.t[~motion.contacts.any(axis=1)]
    if len(flies):
        ax.axvspan(flies[0], flies[-1], color=COLOURS["grey"], alpha=0.2, linewidth=0)
    return len(flies) > 0


# ---------------------------------------------------------------- extremes: a square for every cell

ACROSS = 3  # maps side by side: as many as leave room for letters
INK = "#767676"  # read on white and on black
KEPT = 17  # the end of the scale of digits: errors below 1e-17 have one colour
PREDICTED = "tw.accuracy, at least"
TITLES = {"textbook": "textbook", "fast": "tw.fast", "float32": "textbook, float32", "pinocchio": "Pinocchio"}
MAPS = {name: name.replace("crba + ", "").replace(", ", "_").replace(" ", "_") for name in ALGORITHMS} | {"J̇v": "bias"}
"""The algorithms, and the names of their files."""

Place = tuple[int, int]


def draw_map(cells: Sequence[Cell], algorithm: str) -> Any:
    """Draw the map of an algorithm: above one thing at its limit at a time, below two at once, the worst of their ends.

    The colour of a square is the digits kept; it is hatched where an error is raised. Nothing is painted behind it, and
    words are grey, so that it can be read on a light page and on a dark one.
    """
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm

    colours = colormaps["cividis"].resampled(KEPT)
    ways = {
        title: {c.recipe: r for c in cells for r in c.records if (r.quantity, r.way) == (algorithm, way)}
        for way, title in TITLES.items()
    }
    known = {recipe: r.estimate for recipe, r in ways["textbook"].items() if r.estimate is not None}
    ways[PREDICTED] = {k: Record("", "", **({"error": x} if x < 1 else {"raised": "unsure"})) for k, x in known.items()}
    ways = {title: found for title, found in ways.items() if found}
    rows = -(-len(ways) // ACROSS)
    figure = _figure(11.0, 9.6 * rows + 0.6)
    figure.patch.set_alpha(0)
    axes = figure.subplots(2 * rows, ACROSS, squeeze=False)
    widest = max(map(len, DIMENSIONS.values()))
    for k, (title, found) in enumerate(ways.items()):
        above, below = axes[k // ACROSS, k % ACROSS], axes[rows + k // ACROSS, k % ACROSS]
        for y, (name, values) in enumerate(DIMENSIONS.items()):
            for x, value in enumerate(values):
                _paint(above, (x, y), [found.get(of_value(name, value))], colours, _short(value))
        for y, first in enumerate(ENDS):
            for x, second in enumerate(list(ENDS)[:y]):
                _paint(below, (x, y), [found.get(recipe) for recipe in of_pair(second, first, full=True)], colours)
        _frame(above, DIMENSIONS, [""] * widest, labelled=k % ACROSS == 0)
        _frame(below, ENDS, [name.replace("_", " ") for name in ENDS][:-1], labelled=k % ACROSS == 0)
        for ax, what in ((above, "one at a time"), (below, "two at once, the worst of their ends")):
            ax.set_title(f"{title}\n{what}", fontsize=10, color=INK)
    for k in range(len(ways), rows * ACROSS):
        axes[k // ACROSS, k % ACROSS].remove()
        axes[rows + k // ACROSS, k % ACROSS].remove()
    shown = ScalarMappable(BoundaryNorm(np.arange(KEPT + 1), KEPT), colours)
    bar = figure.colorbar(shown, ax=figure.axes, location="bottom", shrink=0.6, aspect=40, pad=0.01)
    bar.set_label("decimal digits kept", color=INK)
    bar.ax.tick_params(colors=INK)
    figure.suptitle(f"{algorithm}: digits kept; hatched: an error was raised; red: a NaN", fontsize=12, color=INK)
    return figure


def _short(value: float) -> str:
    """Write a value as short as possible."""
    if abs(value) == np.pi:
        return "π" if value > 0 else "−π"
    return re.sub(r"e([+-])0*(\d)", lambda m: "e" + m[1].strip("+") + m[2], f"{value:g}")


def _paint(ax: Any, corner: Place, found: Sequence[Record | None], colours: Any, text: str = "") -> None:
    """Paint a square in the colour of its least digits, a fault red, and hatch it where an error was raised."""
    from matplotlib.patches import Rectangle

    records = [r for r in found if r is not None]
    if not records:
        return
    errors = [r.error for r in records if r.error is not None]
    digits = int(np.clip(-np.log10(max([*errors, 1e-17])), 0, KEPT - 1)) if errors else None
    face = "none" if digits is None else colours(digits)
    if any(r.fault for r in records):
        face = COLOURS["vermilion"]
    hatch, edge = ("/////", COLOURS["grey"]) if any(r.raised for r in records) else (None, "none")
    ax.add_patch(Rectangle(corner, 1, 1, facecolor=face, edgecolor=edge, hatch=hatch, linewidth=0.5))
    dark = digits is not None and digits < KEPT * 0.6
    style: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 7, "color": "white" if dark else "black"}
    if hatch and digits is None and text:
        style["bbox"] = {"facecolor": "white", "linewidth": 0, "pad": 1}
    ax.text(corner[0] + 0.5, corner[1] + 0.5, text, **style)


def _frame(ax: Any, rows: Iterable[str], columns: list[str], *, labelled: bool) -> None:
    rows = [WORDS[name] if labelled else "" for name in rows]
    ax.set(xlim=(0, len(columns)), ylim=(len(rows), 0))
    ax.set_yticks(np.arange(len(rows)) + 0.5, rows, fontsize=9)
    ax.set_xticks(np.arange(len(columns)) + 0.5, columns, fontsize=9, rotation=90)
    ax.tick_params(length=0, colors=INK)
    ax.patch.set_alpha(0)
    ax.spines[:].set_visible(False)

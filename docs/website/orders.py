"""A drawing for each library of docs/conventions.md: the order of q and of v of a floating base, and in whose axes.

What is drawn is read from the tables of that page, which tests hold to the libraries. The page says
``<!-- drawings -->`` where they stand; elsewhere the mark is not seen.
"""

from __future__ import annotations

import re
from html import escape
from pathlib import Path
from typing import NamedTuple

from .thumbnails import table

PAGE = Path(__file__).resolve().parents[1] / "conventions.md"
MARK = re.compile(r"^<!-- drawings -->$", re.MULTILINE)
TABLES = (5, 6)
"""The sections of the page that say the order of q, and the order and the axes of v."""
ANGULAR, LINEAR, REAL = "#d55e00", "#3a8fc8", "#009e73"
WIDE, HIGH, CELL = 300, 200, 34
ARROWS = "M0 0H44m-7 -4l7 4l-7 4M0 0V-44m-4 7l4 -7l4 7"
BODY = '<rect x="-46" y="-15" width="92" height="30" rx="5" class="body" transform="translate({} {}) rotate({})"/>'
WORDS = {
    "en": {
        "Here": "Here",
        "The chapter": "The chapter",
        "The book": "Featherstone's book",
        "world": "world",
        "base": "base",
    },
    "zh": {"Here": "本包", "The chapter": "本章", "The book": "Featherstone 的书", "world": "世界", "base": "基座"},
}
SEEN = {
    "en": "{}: q = ({}); v = ({}); ω in the axes of the {}, v in those of the {}",
    "zh": "{}：q = ({})；v = ({})；ω 用{}的坐标轴表示，v 用{}的坐标轴表示",
}


class Order(NamedTuple):
    """How a library writes a floating base."""

    q: list[str]
    v: list[str]
    """ω and v, in their order."""
    axes: dict[str, str]
    """Of ω and v: "base" or "world"."""


def orders() -> dict[str, Order]:
    """Return what the page's tables say, by library, in their columns' order."""
    sections = re.split(r"^### \d+\. .*$", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)
    of_q, of_v = (table(sections[k], 0) for k in TABLES)
    q = {name: cell for head, cell in zip(of_q[0], of_q[1]) for name in head.split(", ")}
    rows = {row[0]: dict(zip(of_v[0][1:], row[1:])) for row in of_v[1:]}
    return {
        name: Order(
            _cells(q[name]),
            _cells(rows["order"][name]),
            {half: rows[f"axes of {half}"][name].strip("*") for half in ("ω", "v")},
        )
        for name in rows["order"]
    }


def _cells(text: str) -> list[str]:
    """Return the names in the first brackets of a cell; for a book without them, its four Euler parameters."""
    found = re.search(r"\(([^)]*)\)", text)
    return found[1].split(", ") if found else ["p₀", "p₁", "p₂", "p₃"]


def with_drawings(text: str, language: str) -> str:
    """Return the text of a page with the drawings."""
    drawn = "\n".join(f'<div class="door">{drawing(name, order, language)}</div>' for name, order in orders().items())
    block = f'```{{raw}} html\n<div class="doors orders">{drawn}</div>\n```'
    return MARK.sub(lambda _: block, text)


def drawing(name: str, order: Order, language: str) -> str:
    """Return the drawing of a library: the cells of q and of v, and the frame that each half of v is told in."""
    words = WORDS[language]
    title = words.get(name, name)
    says = [", ".join(order.q), ", ".join(order.v), words[order.axes["ω"]], words[order.axes["v"]]]
    seen = escape(SEEN[language].format(title, *says))
    out = [f'<svg class="thumb" viewBox="0 0 {WIDE} {HIGH}" role="img" aria-label="{seen}">']
    out.append(f'<text x="8" y="18" class="title">{escape(title)}</text>')
    out += _strip("q", order.q, 30, {"qw": REAL, "p₀": REAL})
    halves = [f"{half}{axis}" for half in order.v for axis in "xyz"]
    out += _strip("v", halves, 66, {f"{h}{axis}": c for h, c in (("ω", ANGULAR), ("v", LINEAR)) for axis in "xyz"})
    told = {frame: [half for half in order.v if order.axes[half] == frame] for frame in ("world", "base")}
    out += _frame(40, 172, 0.0, told["world"], words["world"])
    out.append(BODY.format(200, 145, -20))
    out += _frame(200, 145, -20.0, told["base"], words["base"])
    return "".join([*out, "</svg>"])


def _strip(name: str, cells: list[str], y: int, colours: dict[str, str]) -> list[str]:
    """Return a row of cells, those that have a colour filled with it."""
    out = [f'<text x="8" y="{y + 18}" class="letter">{name}</text>']
    for k, cell in enumerate(cells):
        x, colour = 24 + k * CELL, colours.get(cell)
        fill = (
            f'fill="{colour}" fill-opacity="0.3" stroke="{colour}"' if colour else 'fill="none" stroke="currentColor"'
        )
        letter = f'{cell[0]}<tspan dy="3" font-size="9">{cell[1:]}</tspan>' if len(cell) > 1 else cell
        out.append(f'<rect x="{x}" y="{y}" width="{CELL - 4}" height="26" rx="3" {fill}/>')
        out.append(f'<text x="{x + CELL / 2 - 2}" y="{y + 17}" text-anchor="middle">{letter}</text>')
    return out


def _frame(x: int, y: int, turn: float, told: list[str], label: str) -> list[str]:
    """Return two axes, pale where nothing is told in them, and below them what is."""
    pale = "" if told else ' opacity="0.35"'
    arrows = f'<path d="{ARROWS}" class="axes" transform="translate({x} {y}) rotate({turn})"{pale}/>'
    colours = {"ω": ANGULAR, "v": LINEAR}
    letters = "".join(f'<tspan fill="{colours[half]}" class="half"> {half}</tspan>' for half in told)
    return [arrows, f'<text x="{x - 30}" y="192"{pale}>{label}{letters}</text>']

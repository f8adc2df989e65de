"""The pictures of the gallery of studies: a few numbers of a page's own table, drawn when the site is built.

Each is an SVG in the page itself, so that its lines and letters have the page's colours, light or dark, and its text
for the blind says the same numbers in the page's language. Which numbers: thumbnails.toml.
"""

from __future__ import annotations

import math
import re
import tomllib
from html import escape
from pathlib import Path
from textwrap import shorten
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench.plot import filled_in
from twistwrench.plot.robot import sticks

from .film import motions

ROOT = Path(__file__).resolve().parents[2]
WIDE, HIGH = 176, 128
"""As wide as the narrowest door: its letters, of 11 units, are never smaller than that."""
UNITS = {"ns": 1e-9, "µs": 1e-6, "ms": 1e-3, "s": 1.0}
NUMBER = re.compile(r"(-?\d[\d.]*(?:e-?\d+)?)(?: (ns|µs|ms|s)\b)?")
BLUE, ORANGE = "#3a8fc8", "#d55e00"
SVG = (
    '<svg class="thumb" viewBox="0 0 {wide} {high}" role="img" aria-label="{label}" fill="none" stroke-linecap="round">'
    '{drawn}<text x="{middle}" y="{low}" text-anchor="middle">{says}</text></svg>\n'
)


def thumbnail(name: str, text: str, language: str) -> str:
    """Return the picture of a study, whose page has this text in its language."""
    own = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))[name]
    says = own["says"][language]
    if draw := own.get("draw"):
        drawn, told = DRAW[draw](own, text)
        says = says.format(**told)
        label = says
    else:
        shown = cells(own, text)
        drawn = lines(shown, own.get("log", False))
        label = f"{says}: {'; '.join(f'{row} {cell}' for row, cell in shown)}"
    parts = {"wide": WIDE, "high": HIGH, "middle": WIDE // 2, "low": HIGH - 4}
    return SVG.format(label=escape(label), says=escape(says), drawn=drawn, **parts)


def cells(own: dict[str, Any], text: str) -> list[tuple[str, str]]:
    """Return the cells that a picture shows, each with what it is of."""
    head, *rows = table(text, own["table"])
    if "columns" in own:
        return [(plain(head[k]), number(rows[own["row"]][k])[0]) for k in own["columns"]]
    column, label = own["column"], own.get("label", 0)
    return [(plain(rows[k][label]) + own.get("unit", ""), number(rows[k][column])[0]) for k in own["rows"]]


def table(text: str, which: str | int) -> list[list[str]]:
    """Return the rows of a table of a page, its head first, by its number or by the name in the comment before it."""
    start = text.index(f"<!-- table: {which} -->") if isinstance(which, str) else 0
    found = re.findall(r"(?:^\|.*\n)+", text[start:], re.MULTILINE)[which if isinstance(which, int) else 0]
    rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", row.strip("|"))] for row in found.splitlines()]
    return [rows[0], *rows[2:]]


def plain(text: str) -> str:
    """Return a cell without its marks, a call without its arguments, and no more than has room."""
    short = re.split(r"[(（]|[,，] ?[\"“]", re.sub(r"[`*]|\]\([^)]*\)|\[", "", text))[0]
    return short.strip()


def number(cell: str) -> tuple[str, float]:
    """Return the first number of a cell, as it stands there and as it is."""
    found = NUMBER.search(cell)
    if not found:
        raise ValueError(f"no number in the cell {cell!r}")
    return found[0], float(found[1]) * UNITS.get(found[2], 1.0)


def lines(shown: list[tuple[str, str]], log: bool) -> str:
    """Return bars from zero; or points on a logarithmic axis, where a length would mean nothing."""
    values = [number(cell)[1] for _, cell in shown]
    least, most = min(values), max(values)
    step, drawn = (HIGH - 20) / len(shown), []
    for k, ((row, cell), value) in enumerate(zip(shown, values, strict=True)):
        share = (math.log(value) - math.log(least)) / math.log(most / least) if log else value / most
        x, y = 5 + (WIDE - 10) * share, round(k * step + 19)
        drawn.append(f'<text x="3" y="{y - 7}">{escape(shorten(row, 28 - len(cell), placeholder=" …"))}</text>')
        drawn.append(f'<text x="{WIDE - 3}" y="{y - 7}" text-anchor="end">{escape(cell)}</text>')
        drawn.append(f'<path d="M5 {y}H{WIDE - 5}" stroke="currentColor" stroke-opacity=".25" stroke-width="2"/>')
        if log:
            drawn.append(f'<circle cx="{x:.1f}" cy="{y}" r="4" fill="{BLUE}"/>')
        else:
            drawn.append(f'<path d="M5 {y}H{x:.1f}" stroke="{BLUE}" stroke-width="5"/>')
    return "".join(drawn)


def standing(own: dict[str, Any], text: str) -> tuple[str, dict[str, str]]:
    """Return a robot that stands, with the forces under its feet or the corners of its soles."""
    model = tw.load(own["robot"])
    q, rest = model.standing(), np.zeros(model.nv)
    weight = model.mass * -float(model.gravity[2])
    contacts = [tw.PointContact(foot, 0.6) for foot in model.feet]
    held = tw.contact_inverse_dynamics(model, q, rest, rest, contacts).forces
    feet = [(tw.frame_placement(model, q, foot).translation, held[foot] / weight) for foot in model.feet]
    return pose(sticks(model, q), feet), {}


def landing(own: dict[str, Any], text: str) -> tuple[str, dict[str, str]]:
    """Return the last picture of a film of the page."""
    film = motions(ROOT / "docs" / "control.md")[own["film"]]
    limbs = np.reshape(film["sticks"][-1], (-1, 2, 3)) / 1000
    arrows = np.reshape(film["forces"][-1], (-1, 2, 3)) / 1000
    whole = sum(arrow[1] - arrow[0] for arrow in arrows)[2]
    return pose(limbs, [(a, (b - a) / whole) for a, b in arrows]), {}


def pose(limbs: np.ndarray, forces: list[tuple[np.ndarray, np.ndarray]]) -> str:
    """Return a robot from the side and a little from above, and forces as shares of the weight."""
    across = np.array([[0.88, 0.47, 0.0], [0.2, -0.25, -0.95]])  # to the right, and down
    flat = limbs @ across.T
    low, high = flat.min((0, 1)), flat.max((0, 1))
    scale = min((WIDE - 40) / (high - low)[0], (HIGH - 36) / (high - low)[1])
    shift = np.array([WIDE / 2, 10]) - scale * np.array([(low + high)[0] / 2, low[1]])
    drawn = [
        f'<path d="M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}" stroke="currentColor" stroke-width="3"/>'
        for a, b in scale * flat + shift
    ]
    for foot, share in forces:
        (x, y), (dx, dy) = scale * across @ foot + shift, 90 * across @ share
        drawn.append(f'<path d="M{x:.1f} {y:.1f}l{dx:.1f} {dy:.1f}" stroke="{ORANGE}" stroke-width="3"/>')
        drawn.append(f'<circle cx="{x + dx:.1f}" cy="{y + dy:.1f}" r="3.5" fill="{ORANGE}"/>')
    return "".join(drawn)


def fill_in(own: dict[str, Any], text: str) -> tuple[str, dict[str, str]]:
    """Return the entries of M of a robot: what is not zero, and the zeros that the usual order of elimination fills."""
    model = tw.load(own["robot"])
    lost, M = filled_in(model), tw.crba(model, model.standing())
    side, drawn = (HIGH - 20) / model.nv, []
    for i, j in np.ndindex(lost.shape):
        if lost[i, j] or lost[j, i] or M[i, j] != 0:
            colour = ORANGE if lost[i, j] or lost[j, i] else "currentColor"
            x, y = (WIDE - side * model.nv) / 2 + j * side, i * side + 2
            drawn.append(f'<path d="M{x:.1f} {y:.1f}h{side - 1:.1f}v{side - 1:.1f}h-{side - 1:.1f}z" fill="{colour}"/>')
    return "".join(drawn), {}


def shares(own: dict[str, Any], text: str) -> tuple[str, dict[str, str]]:
    """Return the shares into which the program of a page cuts its states; the picture has eight of them."""
    of_all, of_share, block = (
        int(re.search(rf"\b{word}=([\d_]+)", text)[1])  # type: ignore[index]
        for word in ("shares", "blocks", "block")
    )
    drawn_shares = min(of_all, 8)
    high = (HIGH - 28) / drawn_shares
    drawn = [
        f'<rect x="28" y="{4 + k * high:.1f}" width="120" height="{high - 5:.1f}" rx="3" stroke="{BLUE}"/>'
        f'<text x="88" y="{2 + (k + 0.5) * high + 3:.1f}" text-anchor="middle">{of_share * block:,}</text>'
        for k in range(drawn_shares)
    ]
    return "".join(drawn), {"states": f"{of_all * of_share * block:,}", "count": str(of_all)}


DRAW = {"standing": standing, "film": landing, "fill-in": fill_in, "blocks": shares}

"""What a digit costs, as one picture: a line for each way and number type, from a single state to many in one call.

A page says ``<!-- digits: ROBOT -->`` where it stands; the numbers are those of benchmarks/results/trade_ROBOT.json. A
slider asks for digits: what gives fewer turns pale, and the quickest of the others is named. Elsewhere the mark is not
seen.
"""

from __future__ import annotations

import json
import math
import re
from html import escape
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).resolve().parents[2]
MARK = re.compile(r"^<!-- digits: (\w+) -->$", re.MULTILINE)
NUMBERS = ("float32", "float64", "longdouble", "20 digits", "double-double", "50 digits")
COLOUR = {"tw.fast": "#d55e00", "tw.compile": "#e69f00", "tw.": "#3a8fc8", "newton": "#009e73", "mpmath": "#009e73"}
OTHER = "#888"
WIDE, LEFT, RIGHT, ROW, HEAD, FOOT = 960, 150, 40, 22, 12, 30
DECADES = range(-8, 0)
WORDS = {
    "en": {
        "quantity": "I compute",
        "need": "I need so many digits:",
        "one": "For one state at a time: {}.",
        "many": "For many in one call: {} a state.",
        "none": "No way that was measured gives so many.",
        "digits": "{} digits",
        "says": "Time for one state of a Go2. Hollow: a single state in a call; filled: many in one call.",
        "seen": "Time and digits of every way to compute {}",
    },
    "zh": {
        "quantity": "要算",
        "need": "需要的位数：",
        "one": "一次算一个状态：{}。",
        "many": "一次算许多状态：{}，按每个状态计。",
        "none": "测过的办法都给不出这么多位。",
        "digits": "{} 位",
        "says": "Go2 每个状态的时间。空心：一次调用一个状态；实心：一次调用许多状态。",
        "seen": "计算 {} 的各种办法：时间与位数",
    },
}


class Row(NamedTuple):
    """One way in one number type."""

    number: str
    way: str
    seconds: dict[str, float]
    """By "one" and "many"."""
    digits: float


def with_digits(text: str, language: str) -> str:
    """Return the text of a page with its picture."""
    return MARK.sub(lambda found: picture(found[1], language), text)


def picture(robot: str, language: str) -> str:
    """Return the picture of all quantities of a robot, as a block of HTML."""
    path = ROOT / "benchmarks" / "results" / f"trade_{robot}.json"
    measured, words = json.loads(path.read_text(encoding="utf-8")), WORDS[language]
    names = measured["names"]
    parts = {
        "options": "".join(f"<option>{escape(name)}</option>" for name in names),
        "pictures": "\n".join(_drawn(rows(measured["records"], name), name, words) for name in names),
        "words": json.dumps(words, ensure_ascii=False),
    }
    html = Path(__file__).with_suffix(".html").read_text(encoding="utf-8")
    for name, text in (words | parts).items():
        html = html.replace(f"${name}$", text)
    return f"```{{raw}} html\n{html}```"


def rows(records: list[dict[str, Any]], quantity: str) -> list[Row]:
    """Return the ways to a quantity, by number types, the quickest first."""
    found: dict[tuple[str, str], Row] = {}
    for record in records:
        if record["quantity"] == quantity and record.get("error") is not None:
            number, count = record.get("number", "float64"), "many" if record.get("states", 1) > 1 else "one"
            digits = -math.log10(record["error"]) if record["error"] else math.inf
            row = found.setdefault((number, record["way"]), Row(number, record["way"], {}, digits))
            row.seconds[count] = record["seconds"]
    return sorted(found.values(), key=lambda row: (NUMBERS.index(row.number), min(row.seconds.values())))


def _drawn(ways: list[Row], quantity: str, words: dict[str, str]) -> str:
    """Return the picture of a quantity: number types below each other, in each a row for a way."""
    high = HEAD + ROW * (len(ways) + len({row.number for row in ways})) + FOOT
    label = escape(words["seen"].format(quantity))
    out, y = [f'<svg viewBox="0 0 {WIDE} {high}" role="img" aria-label="{label}">'], HEAD + ROW // 2
    for decade in DECADES:
        x = _across(10.0**decade)
        out.append(f'<path d="M{x:.0f} {HEAD}V{high - FOOT}" class="grid"/>')
        out.append(f'<text x="{x:.0f}" y="{high - 10}" text-anchor="middle">{time_of(10.0**decade)}</text>')
    for number, group in groupby(ways, lambda row: row.number):
        those = [*group]
        least = math.floor(min(row.digits for row in those) + 0.1)
        middle = y + ROW * (len(those) - 1) / 2
        out.append(f'<text x="4" y="{middle:.0f}" class="number">{number}</text>')
        out.append(f'<text x="4" y="{middle + 15:.0f}">{words["digits"].format(least)}</text>')
        for row in those:
            out += _row(row, y)
            y += ROW
        out.append(f'<path d="M0 {y}H{WIDE}" class="grid"/>')
        y += ROW
    return "".join([*out, "</svg>"])


def _row(row: Row, y: int) -> list[str]:
    """Return a way: its one or two marks, the line between them, and its name."""
    colour = next((c for name, c in COLOUR.items() if row.way.startswith(name)), OTHER)
    places = {count: _across(seconds) for count, seconds in row.seconds.items()}
    low, high = min(places.values()), max(places.values())
    data = f'data-digits="{row.digits:.1f}"'
    out = [f'<path d="M{low:.0f} {y}H{high:.0f}" stroke="{colour}" stroke-width="2" {data}/>']
    for count, x in places.items():
        says = escape(f"{row.way}, {row.number}, {time_of(row.seconds[count])}")
        fill = colour if count == "many" else "var(--pst-color-background)"
        more = f'data-count="{count}" data-seconds="{row.seconds[count]:.3e}" data-name="{says}"'
        mark = f'<circle cx="{x:.0f}" cy="{y}" r="6" fill="{fill}" stroke="{colour}" stroke-width="2.5" {data} {more}>'
        out.append(f"{mark}<title>{says}</title></circle>")
    left = high > 0.72 * WIDE
    at = f'x="{low - 11:.0f}" text-anchor="end"' if left else f'x="{high + 11:.0f}"'
    return [*out, f'<text {at} y="{y + 4}" {data}>{escape(row.way)}</text>']


def _across(seconds: float) -> float:
    share = (math.log10(seconds) - DECADES[0]) / (DECADES[-1] - DECADES[0])
    return LEFT + (WIDE - LEFT - RIGHT) * share


def time_of(seconds: float) -> str:
    r"""Return a time to three digits, in its unit.

    >>> time_of(1.04e-6), time_of(2.5e-5), time_of(0.1)
    ('1.04\xa0µs', '25\xa0µs', '100\xa0ms')
    """
    unit, size = next(
        pair for pair in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9)) if seconds >= 0.999 * pair[1]
    )
    return f"{seconds / size:.3g}\u00a0{unit}"

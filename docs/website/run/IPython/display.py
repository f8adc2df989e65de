"""`display` and `Markdown`, as far as the notebooks use them: a table, code, and text."""

from __future__ import annotations

import re
from html import escape

import classroom


class Markdown:
    """A table in Markdown; of other text, code in it."""

    def __init__(self, data: str) -> None:
        self.data = data

    def _repr_html_(self) -> str:
        lines = [re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(line)) for line in self.data.strip().splitlines()]
        if len(lines) < 2 or not re.fullmatch(r"[|:\- ]+", lines[1]):
            return "<p>" + "<br>".join(lines) + "</p>"
        head, _, *rows = ([cell.strip() for cell in line.strip("| ").split("|")] for line in lines)
        table = [("th", head), *(("td", row) for row in rows)]
        filled = ("".join(f"<{tag}>{cell}</{tag}>" for cell in row) for tag, row in table)
        return '<table class="table">' + "".join(f"<tr>{row}</tr>" for row in filled) + "</table>"


def display(*values: object) -> None:
    """Show values where the cell is."""
    for value in values:
        classroom.OUTPUTS.extend(classroom.display(value))

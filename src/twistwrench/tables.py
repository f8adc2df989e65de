"""Tables of words, as text and as HTML, and matrices as coloured squares."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

__all__ = ["html_matrix", "html_table", "text_table"]

SQUARE = 9
"""Side of an entry of a matrix, pixels."""


def text_table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table as text, its columns under each other."""
    lines = [head, *rows]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join("  ".join(c.ljust(w) for c, w in zip(line, widths, strict=True)).rstrip() for line in lines)


def html_table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table as HTML."""

    def row(cells: Iterable[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return f"<table>{row(head, 'th')}{''.join(row(cells, 'td') for cells in rows)}</table>"


def html_matrix(A: NDArray[np.floating], name: str) -> str:
    """Return a matrix as coloured squares: purple above zero, orange below, white only where it is zero.

    The colour grows with the cube root, as in `plot.matrix`; an entry's number shows where the pointer rests.
    """
    largest = float(np.abs(A).max(initial=0)) or 1.0
    squares = "".join(
        f'<rect x="{SQUARE * k}" y="{SQUARE * i}" width="{SQUARE}" height="{SQUARE}" '
        f'fill="{"#542788" if x > 0 else "#B35806"}" fill-opacity="{np.cbrt(abs(x) / largest):.2f}">'
        f"<title>{escape(name)}[{i}, {k}] = {x:.6g}</title></rect>"
        for (i, k), x in np.ndenumerate(A)
        if x
    )
    height, width = (SQUARE * n for n in A.shape)
    said = f"{escape(name)}: full colour ±{largest:.3g}, half ±{largest / 8:.3g}"
    return (
        f'{said}<br><svg width="{width}" height="{height}" role="img" '
        f'style="background: white; outline: 1px solid #808080"><title>{said}</title>{squares}</svg>'
    )

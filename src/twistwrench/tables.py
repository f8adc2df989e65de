"""Tables of words, as text and as HTML, and matrices as coloured squares."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

__all__ = ["aligned", "html_matrix", "html_table", "text_table"]

ENTRY_PX = 9
"""Side of an entry of a matrix, pixels."""


def text_table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table as text, its columns under each other."""
    return "\n".join(aligned([head, *rows]))


def aligned(
    lines: Sequence[Sequence[str]], *, right: Iterable[int] = (), widths: Sequence[int] = (), gap: str = "  "
) -> list[str]:
    """Return the lines of a table, their cells padded to columns.

    Parameters
    ----------
    lines : sequence of sequence of str
        The cells.
    right : iterable of int
        The columns whose cells end at the right, as numbers do.
    widths : sequence of int, optional
        Of the columns, for a table that is printed line by line; those of the widest cells unless given.
    gap : str
        Between two columns.

    Examples
    --------
    >>> aligned([("joint", "rad"), ("hip", "1.5")], right=[1])
    ['joint  rad', 'hip    1.5']
    """
    widths = widths or [max(map(_width, column)) for column in zip(*lines, strict=True)]
    at_right = set(right)

    def padded(cell: str, column: int) -> str:
        space = " " * (widths[column] - _width(cell))
        return space + cell if column in at_right else cell + space

    return [gap.join(padded(cell, column) for column, cell in enumerate(line)).rstrip() for line in lines]


def _width(text: str) -> int:
    """Return how many columns a text takes: the dot over a letter takes none."""
    return sum(not unicodedata.combining(c) for c in text)


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
        f'<rect x="{ENTRY_PX * k}" y="{ENTRY_PX * i}" width="{ENTRY_PX}" height="{ENTRY_PX}" '
        f'fill="{"#542788" if x > 0 else "#B35806"}" fill-opacity="{np.cbrt(abs(x) / largest):.2f}">'
        f"<title>{escape(name)}[{i}, {k}] = {x:.6g}</title></rect>"
        for (i, k), x in np.ndenumerate(A)
        if x
    )
    height, width = (ENTRY_PX * n for n in A.shape)
    said = f"{escape(name)}: full colour ±{largest:.3g}, half ±{largest / 8:.3g}"
    return (
        f'{said}<br><svg width="{width}" height="{height}" role="img" '
        f'style="background: white; outline: 1px solid #808080"><title>{said}</title>{squares}</svg>'
    )

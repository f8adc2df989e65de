"""Matrices as coloured squares, so that their blocks and zeros are seen (49.3, 49.5, 49.8)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import as_count, as_sequence
from ..errors import ShapeError
from .style import COLOURS, as_drawable, as_drawable_number, axes_2d
from .words import word

__all__ = ["ANGULAR_LINEAR", "matrix"]

ANGULAR_LINEAR = ("ωx", "ωy", "ωz", "vx", "vy", "vz")
"""Names of the entries of a twist."""


def matrix(
    A: ArrayLike,
    title: str = "",
    *,
    rows: Sequence[str] = (),
    columns: Sequence[str] = (),
    lines: Sequence[int] = (3,),
    numbers: str | None = None,
    limit: float | None = None,
    rounding: float = 0.0,
    ax: Any = None,
) -> Any:
    """Draw a matrix: orange where it is negative, purple where it is positive, white only where it is zero.

    The colour grows with the cube root of the entry, so that small ones are seen: half of it is an eighth of the value.
    Where no numbers are written, a line below the matrix gives these two values.

    Parameters
    ----------
    A : array_like, shape (m, n)
    title : str
    rows, columns : sequence of str
        Names of the rows and columns.
    lines : sequence of int
        Before which rows and columns a line separates the blocks.
    numbers : str, optional
        How to write the entries into the squares, for example ``".2f"``; zeros are left out.
    limit : float, optional
        The value from which on the colour is full; the largest of `A` unless given.
    rounding : float
        Entries up to this are taken for zeros that rounding has touched.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ShapeError
        If `A` is not a matrix, or the names are not as many as its rows and columns.
    ValueError
        If `limit` is not above zero.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> ax = matrix(np.diag([1, -1]), numbers="g", lines=(1,), ax=Figure().add_subplot())
    >>> [text.get_text() for text in ax.texts]
    ['1', '-1']
    """
    limit = None if limit is None else as_drawable_number(limit, "limit")
    if limit is not None and not limit > 0:
        raise ValueError(f"limit: expected a number above zero, got {limit}")
    rounding, A = as_drawable_number(rounding, "rounding"), as_drawable(A, "A")
    rows, columns = as_sequence(rows, "rows", "names"), as_sequence(columns, "columns", "names")
    lines = [as_count(k, "lines", 0) for k in as_sequence(lines, "lines", "rows and columns")]
    _check_format(numbers)
    if A.ndim != 2 or len(rows) not in (0, A.shape[0]) or len(columns) not in (0, A.shape[1]):
        raise ShapeError(f"A, rows, columns: {A.shape} with {len(rows)} and {len(columns)} names do not go together")
    A = np.where(np.abs(A) > rounding, A, 0)
    ax = axes_2d(ax, size=(4.5, 4.5))
    limit = limit or float(np.abs(A).max()) or 1.0
    shade = np.ma.masked_equal(np.cbrt(A / limit), 0)  # masked squares stay white
    ax.imshow(shade, cmap="PuOr", vmin=-1, vmax=1)
    for k in lines:
        ax.axhline(k - 0.5, color=COLOURS["black"], linewidth=1)
        ax.axvline(k - 0.5, color=COLOURS["black"], linewidth=1)
    ax.set_xticks(range(len(columns)), columns, fontsize=8)
    ax.set_yticks(range(len(rows)), rows, fontsize=8)
    ax.tick_params(length=0, top=False, labeltop=True, bottom=False, labelbottom=False)
    ax.set_title(title, fontsize=11)
    if numbers is None:
        ax.set_xlabel(word("full colour: ±{:.2g}, half: ±{:.2g}").format(limit, limit / 8), fontsize=8)
    else:
        for i, k in np.argwhere(A != 0):
            dark = abs(shade[i, k]) > 0.7
            ax.text(k, i, format(A[i, k], numbers), ha="center", va="center", fontsize=8, color="w" if dark else "k")
    return ax


def _check_format(numbers: object) -> None:
    """Raise for a format that cannot write a number."""
    try:
        format(1.0, "" if numbers is None else numbers)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise ValueError(f"numbers: expected a format such as '.2f', got {numbers!r}") from None

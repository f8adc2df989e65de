"""Slips of the chapter that need no code of their own: the other order of six numbers, half of a matrix twice."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from misstep import faults

from ..arrays import Array

__all__ = ["doubled", "faulty", "swap", "swapped"]

Function = Callable[..., Any]


def swap(x: Any) -> Array:
    """Exchange the angular and the linear half of every axis that is 6 long or longer; later entries stay."""
    x = np.array(x)
    for axis, size in enumerate(x.shape):
        if size >= 6:
            x = np.take(x, [k + 3 if k < 3 else k - 3 if k < 6 else k for k in range(size)], axis)
    return np.asarray(x)


def doubled(M: Any) -> Array:
    """Return a symmetric matrix with everything off its diagonal doubled."""
    return np.asarray(2 * M - np.diag(np.diag(M)))


def swapped(solution: Function, *, only: tuple[int, ...] | None = None) -> Function:
    """(v, ω) in place of (ω, v)."""
    return faults.after(solution, swap, only=only)


def faulty(solution: Function, *changes: tuple[str, str], of: Function | None = None) -> Function:
    """Change the text of the reference, in which `doubled` and `swap` may be used: see `misstep.faults.faulty`."""
    return faults.faulty(solution, *changes, of=of, names={"doubled": doubled, "swap": swap})

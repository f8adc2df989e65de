"""Numbers in bounds: real and finite ones for drawings and motions, and no products that overflow."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec

import numpy as np
from numpy.typing import ArrayLike

from .conversion import Array, as_array, as_constant, as_number

__all__ = ["as_finite", "as_real", "check_overflow", "check_size", "without_overflow"]

P = ParamSpec("P")


def as_finite(value: object, name: str) -> float:
    """Return one real number that is neither infinite nor NaN.

    Examples
    --------
    >>> as_finite(np.nan, "scale")
    Traceback (most recent call last):
    ValueError: scale: expected a finite number, got nan
    """
    x = as_number(value, name)
    if not np.isfinite(x):
        raise ValueError(f"{name}: expected a finite number, got {x}")
    return x


def as_real(value: ArrayLike, name: str, *tail: int) -> Array:
    """Convert one argument to float64: finite and real, with these last axes.

    Examples
    --------
    >>> as_real([[0, 0, 1j]], "points", 3)
    Traceback (most recent call last):
    ValueError: points: expected real numbers, got complex128
    """
    return as_constant(as_array(value, name, *tail), name)


def check_overflow(result: Array, names: str) -> None:
    """Raise for arguments that are finite but of which a product or a sum is not.

    Examples
    --------
    >>> check_overflow(np.array([1.0, np.inf]), "F, V")
    Traceback (most recent call last):
    ValueError: F, V: expected smaller numbers, as products overflow in float64
    """
    if result.dtype.kind in "fc" and not np.isfinite(result).all():
        raise ValueError(f"{names}: expected smaller numbers, as products overflow in {result.dtype}")


def without_overflow(names: str) -> Callable[[Callable[P, Array]], Callable[P, Array]]:
    """Let a function of one array name its arguments in an error where the result overflows: see `check_overflow`."""

    def decorate(function: Callable[P, Array]) -> Callable[P, Array]:
        @wraps(function)
        def checked(*args: P.args, **kwargs: P.kwargs) -> Array:
            with np.errstate(over="ignore", invalid="ignore"):
                result = function(*args, **kwargs)
            check_overflow(result, names)
            return result

        return checked

    return decorate


def check_size(x: Array, name: str) -> None:
    """Raise ValueError for numbers that could make m (p × ω)² overflow.

    With lengths p below the fourth root of the largest number, and rates and forces below its fifth,
    a tenth of the exponents is left for m.
    """
    largest = np.finfo(x.dtype).max ** (1 / 4 if name.startswith("q") else 1 / 5)
    huge = np.abs(x) > largest
    if huge.any():
        where = tuple(int(k) for k in np.argwhere(huge)[0])
        limit = np.format_float_scientific(largest, 1)
        raise ValueError(
            f"{name}: expected at most {limit}, as products overflow in {x.dtype}, got {x[where]} at {where}"
        )

"""Input validation at the public functions, so that the formulas they call need no checks.

Every public function of the algebra takes its arrays through `as_array`; every algorithm takes
its state through `model.arguments.check_state`, which calls `as_arrays`. The result is finite, of known
last axes, and of one floating-point type.
"""

from __future__ import annotations

from collections.abc import Iterable
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ShapeError
from .exact import beside, exact_numbers, has_objects, home
from .kinds import as_sequence

__all__ = [
    "Array",
    "as_array",
    "as_arrays",
    "as_constant",
    "as_count",
    "as_exactly",
    "as_generator",
    "as_names",
    "as_number",
    "as_number_array",
    "as_number_arrays",
    "check_batches",
    "resolution",
    "tolerance",
]

Array = NDArray[Any]

ROUNDING_ATOL = 16 * 2.0**-52
"""By how much rounding may break a condition on doubles: entries of rotations, norms of quaternions."""


def resolution(dtype: np.dtype[Any] | type) -> float:
    """Spacing of the numbers next to 1, for a real or complex floating-point type; objects are judged as doubles.

    Examples
    --------
    >>> resolution(np.complex128) == resolution(np.float64) == 2.0**-52
    True
    """
    return float(np.finfo(np.float64 if np.dtype(dtype).hasobject else dtype).eps)


def tolerance(dtype: np.dtype[Any] | type) -> float:
    """By how much an argument may miss a condition that rounding breaks: the root of the resolution.

    Never less than what rounding leaves of a double: in a long double of 113 bits the root of the resolution is
    below that, and numbers widened from doubles are valid all the same.

    Examples
    --------
    >>> tolerance(np.float64) == 2.0**-26
    True
    """
    return float(max(resolution(dtype) ** 0.5, ROUNDING_ATOL))


def as_arrays(**named: tuple[ArrayLike, tuple[int, ...]]) -> tuple[Array, ...]:
    """Convert several arguments to arrays of one floating-point type and check each.

    float32, float64, longdouble and their complex twins are kept, the widest of those given
    wins; integers do not count (alone, they become float64).

    Parameters
    ----------
    **named : (array_like, tuple of int)
        For each argument, by its name, the value and the last axes of its shape.

    Returns
    -------
    tuple of ndarray
        In the order of the arguments, of one dtype. The leading axes are untouched.

    Raises
    ------
    ShapeError
        If the last axes of an argument are not the ones asked for.
    ValueError
        If an argument is not numeric or holds an infinity or a NaN.

    Examples
    --------
    >>> w, v = as_arrays(w=([0, 0, 1], (3,)), v=(np.ones(3, np.float32), (3,)))
    >>> w.dtype, v.dtype
    (dtype('float32'), dtype('float32'))
    """
    arrays = {name: _numeric(value, name) for name, (value, _) in named.items()}
    dtypes = [x.dtype for x in arrays.values() if x.dtype.kind in "fc"]
    dtype = np.result_type(*dtypes, np.float32) if dtypes else np.dtype(np.float64)
    for name, (_, tail) in named.items():
        x = arrays[name] = arrays[name].astype(dtype, copy=False)
        _check_tail(x, name, tail)
        if not np.isfinite(x).all():
            where = tuple(int(k) for k in np.argwhere(~np.isfinite(x))[0])
            raise ValueError(f"{name}: expected finite numbers, got {x[where]} at index {where}")
    return tuple(arrays.values())


def check_batches(what: str, first: tuple[int, ...], second: tuple[int, ...]) -> None:
    """Raise ShapeError where the batch axes of two arguments do not broadcast; `what` names the two."""
    if first != second and any(a != b and 1 not in (a, b) for a, b in zip(first[::-1], second[::-1])):
        raise ShapeError(f"{what}: batch axes {first} and {second} do not broadcast")


def as_number_arrays(**named: tuple[ArrayLike, tuple[int, ...]]) -> tuple[Array, ...]:
    """Convert as `as_arrays`, for formulas that take any number: fractions, SymPy's and the like are kept, too.

    Where one argument holds such, all become arrays of objects, and floats the fractions that they are; beside
    symbols the shortest decimals that are read as them.

    Raises
    ------
    ShapeError, ValueError
        As `as_arrays`; an object that is not a number, a complex number beside exact ones.

    Examples
    --------
    >>> from fractions import Fraction
    >>> as_number_arrays(w=([0, 0, Fraction(1, 3)], (3,)), v=([0, 0, 0.5], (3,)))[1]
    array([Fraction(0, 1), Fraction(0, 1), Fraction(1, 2)], dtype=object)
    """
    try:
        arrays = {name: np.asarray(value) for name, (value, _) in named.items()}
    except ValueError:  # rows of different lengths: as_arrays raises for them
        return as_arrays(**named)
    if not any(has_objects(x) for x in arrays.values()):
        return as_arrays(**named)
    dtype = beside(arrays.values())
    for name, (value, tail) in named.items():
        x = arrays[name] if arrays[name].dtype == object else as_array(value, name, *tail)
        arrays[name] = exact_numbers(x, name, dtype)
        _check_tail(x, name, tail)
    return tuple(arrays.values())


def as_number_array(value: ArrayLike, name: str, *tail: int) -> Array:
    """Convert one argument to an array of any number type and check it: see `as_number_arrays`.

    Examples
    --------
    >>> as_number_array(["1", None], "w", 2)
    Traceback (most recent call last):
    ValueError: w: expected numbers, got '1' at index (0,)
    """
    return as_number_arrays(**{name: (value, tail)})[0]


def as_array(value: ArrayLike, name: str, *tail: int) -> Array:
    """Convert one argument to a floating-point array and check it: see `as_arrays`.

    Parameters
    ----------
    value : array_like, shape (..., *tail)
    name : str
        The argument's name, for the error.
    *tail : int
        The last axes that are asked for.

    Returns
    -------
    ndarray, shape (..., *tail)

    Raises
    ------
    ShapeError, ValueError
        As `as_arrays`.

    Examples
    --------
    >>> as_array([1, 2], "omega", 3)
    Traceback (most recent call last):
    twistwrench.errors.ShapeError: omega: expected shape (..., 3), got (2,)
    """
    return as_arrays(**{name: (value, tail)})[0]


def as_constant(value: ArrayLike, name: str) -> Array:
    """Convert a constant of a model to float64: real, of any shape, infinities allowed.

    Examples
    --------
    >>> as_constant(1j, "gravity")
    Traceback (most recent call last):
    ValueError: gravity: expected real numbers, got complex128
    """
    x = _numeric(value, name)
    if x.dtype.kind == "c":
        raise ValueError(f"{name}: expected real numbers, got {x.dtype}")
    return x.astype(np.float64)


def as_exactly(value: ArrayLike, name: str, *shape: int) -> Array:
    """Convert one argument to float64: finite and real, of this shape and without batch axes.

    Examples
    --------
    >>> as_exactly([[0, 0, -9.81]], "gravity", 3)
    Traceback (most recent call last):
    twistwrench.errors.ShapeError: gravity: expected shape (3,), got (1, 3)
    """
    x = as_constant(as_array(value, name, *shape), name)
    if x.shape != shape:
        raise ShapeError(f"{name}: expected shape {shape}, got {x.shape}")
    return x


def as_number(value: object, name: str) -> float:
    """Return one real number: no text, no bool, no list.

    Examples
    --------
    >>> as_number("0.01", "dt")
    Traceback (most recent call last):
    ValueError: dt: expected a number, got '0.01'
    """
    one = value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value
    if not isinstance(one, Real) or isinstance(one, bool):
        raise ValueError(f"{name}: expected a number, got {value!r}")
    return float(one)


def as_count(value: object, name: str, least: int) -> int:
    """Return a whole number of at least `least`; one above 2**53 is a slip, not a count.

    Examples
    --------
    >>> as_count(1.5, "samples", 2)
    Traceback (most recent call last):
    ValueError: samples: expected a whole number of at least 2, got 1.5
    """
    x = as_number(value, name)
    if not least <= x <= 2**53 or x != round(x):
        raise ValueError(f"{name}: expected a whole number of at least {least}, got {value}")
    return int(x)


def as_generator(rng: np.random.Generator | int | None) -> np.random.Generator:
    """Return the generator that `rng` is or seeds.

    Examples
    --------
    >>> as_generator(-1)
    Traceback (most recent call last):
    ValueError: rng: expected a numpy Generator, a whole number of at least 0 or None, got -1
    """
    try:
        return np.random.default_rng(rng)
    except (TypeError, ValueError):
        expected = "a numpy Generator, a whole number of at least 0 or None"
        raise ValueError(f"rng: expected {expected}, got {rng!r}") from None


def as_names(value: Iterable[str], name: str, expected: str, *, ordered: bool = False) -> tuple[str, ...]:
    """Return several names as a tuple; reject a string, which is a sequence of letters, and where order counts a set.

    Examples
    --------
    >>> as_names("FR_foot", "contacts", "frame names")
    Traceback (most recent call last):
    ValueError: contacts: expected a sequence of frame names, got the string 'FR_foot'
    """
    return as_sequence(value, name, expected, letters=False, ordered=ordered)


def _numeric(value: ArrayLike, name: str) -> Array:
    """Turn `value` into an array of numbers, or raise ValueError with the reason why it is not one."""
    try:
        x = np.asarray(value)
    except ValueError:
        raise ShapeError(f"{name}: expected a rectangular array, got rows of different lengths") from None
    if np.ma.is_masked(value):
        raise ValueError(f"{name}: expected numbers, got a masked array: what should stand where the mask is?")
    if x.dtype.kind in "iufc":
        return x
    if x.ndim == 0:
        raise ValueError(f"{name}: expected numbers, got {value!r}")
    raise ValueError(f"{name}: expected {'' if x.dtype != object else 'floating-point '}numbers, got {_what(x)}")


def _what(x: Array) -> str:
    """Describe what an array that is not of a floating-point type holds."""
    if x.dtype != object:
        return f"an array of {x.dtype}"
    if not has_objects(x):
        return "an array of objects; .astype(float) makes floating-point numbers of it"
    odd = next(one for one in x.flat if not isinstance(one, int | float | complex | np.number))
    mpmath = home(odd).startswith("mpmath")
    return f"{odd!r}{' (for mpmath numbers use twistwrench.newton_euler_3d)' if mpmath else ''}"


def _check_tail(x: Array, name: str, tail: tuple[int, ...]) -> None:
    if x.shape[x.ndim - len(tail) :] != tail or x.ndim < len(tail):
        raise ShapeError(f"{name}: expected {_shape(tail)}, got {x.shape}")


def _shape(tail: tuple[int, ...]) -> str:
    return f"shape (..., {', '.join(map(str, tail))})" if tail else "any shape"

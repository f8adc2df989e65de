"""Arrays of numbers that are objects: fractions, SymPy's expressions, numbers that record what is done to them.

A formula of this package is arithmetic, so it takes them as they are. What they need is settled here beforehand:
which objects are numbers, what a float becomes beside them, and their cosine, sine and square root. Nothing here
compares a number or turns it into a float, unless its type is registered as one of Python's `numbers`.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from fractions import Fraction
from math import isqrt
from numbers import Number, Rational, Real
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

__all__ = ["beside", "comparable", "convert", "elementary", "exact_numbers", "exact_unit", "has_objects", "home"]

SYMBOLS = np.dtype(object, metadata={"floats": "decimals"})
"""The number type of arrays among which there are symbols: beside them 0.1 is 1/10, the shortest decimal that is read
as that float. For NumPy it is `object`, and every slice of such an array has it. Beside fractions alone 0.1 is the
fraction that the float is, 3602879701896397/36028797018963968."""

ARITHMETIC = ("__radd__", "__rsub__", "__rmul__", "__rtruediv__", "__neg__")
"""What a type must define to count as a type of numbers."""


def has_objects(x: NDArray[Any]) -> bool:
    """Return whether an array holds numbers that are not Python's or NumPy's floats and whole numbers.

    Examples
    --------
    >>> has_objects(np.array([Fraction(1, 3), 2])), has_objects(np.array([0.5, 2], object))
    (True, False)
    """
    return x.dtype == object and not all(isinstance(one, int | float | complex | np.number) for one in x.flat)


def beside(arrays: Iterable[NDArray[Any]]) -> np.dtype[Any]:
    """Return the number type in which constants stand beside arrays of objects: `SYMBOLS` if one of them holds some.

    Examples
    --------
    >>> beside([np.array([Fraction(1, 3)], object)]).metadata is None
    True
    """
    objects = [x for x in arrays if x.dtype == object]
    symbols = any(x.dtype.metadata or any(hasattr(one, "free_symbols") for one in x.flat) for x in objects)
    return SYMBOLS if symbols else np.dtype(object)


def home(x: object) -> str:
    """Return the module that the type of x is from; SymPy makes a type without one for each function, as f of f(t).

    Examples
    --------
    >>> home(Fraction(1, 3))
    'fractions'
    """
    return next(kind.__module__ for kind in type(x).__mro__ if isinstance(kind.__module__, str))


def exact_numbers(x: NDArray[Any], name: str, dtype: np.dtype[Any] | None = None) -> NDArray[Any]:
    """Return an array of objects of the same values: floats and whole numbers become the fractions that they are.

    Whole numbers too, since half of one is a float in Python, and half of a fraction is a fraction.

    Parameters
    ----------
    x : ndarray
    name : str
        The argument's name, for the error.
    dtype : dtype, optional
        `SYMBOLS` for the shortest decimals of the floats; else that of `beside` this array.

    Raises
    ------
    ValueError
        If an entry is not a number, not finite, complex, or of mpmath.

    Examples
    --------
    >>> exact_numbers(np.array([0.5, 2.0, Fraction(1, 3)], object), "q")
    array([Fraction(1, 2), Fraction(2, 1), Fraction(1, 3)], dtype=object)
    """
    dtype = beside([x]) if dtype is None else dtype
    numbers = np.empty(x.shape, dtype)
    for k in np.ndindex(x.shape):
        wrong = _why_not(x[k])
        if wrong:
            where = f" at index {k}" if k else ""
            raise ValueError(f"{name}: expected {wrong}, got {x[k]!r}{where}")
        numbers[k] = _decimal(x[k]) if dtype.metadata else _exact(x[k])
    return numbers


def convert(x: NDArray[Any], dtype: DTypeLike) -> NDArray[Any]:
    """Convert constants to a number type; as objects, to the fractions that they are, or their shortest decimals.

    Examples
    --------
    >>> convert(np.array([2.0, 0.5]), object)
    array([Fraction(2, 1), Fraction(1, 2)], dtype=object)
    """
    number = np.dtype(dtype)
    if number.hasobject:
        return exact_numbers(x, "constant", number)
    try:
        return x.astype(number)
    except TypeError:  # SymPy's for what has no value; sqrt(2) has one
        raise ValueError(f"constant: expected numbers that can become {number}, got symbols: {x.tolist()}") from None


def comparable(x: NDArray[Any]) -> NDArray[Any]:
    """Return values that a check can compare: real parts; of objects, doubles, and NaN where the value is not known.

    Examples
    --------
    >>> comparable(np.array([Fraction(1, 2), 3], object)), comparable(np.array([1 + 2j]))
    (array([0.5, 3. ]), array([1.]))
    """
    if x.dtype != object:
        return x.real
    known = [float(one) if isinstance(one, Real) else np.nan for one in x.flat]
    return np.array(known).reshape(x.shape)


def exact_unit(x: NDArray[Any]) -> NDArray[Any]:
    """Return fractions whose squares add up to 1 exactly, within 2⁻¹²⁷ of three doubles divided by their length.

    The point of the sphere is projected from the pole across onto the plane, and back with fractions. Of three
    fractions of length 1, for example the decimals of (0.6, 0, 0.8), nothing is changed.

    Examples
    --------
    >>> n = exact_unit(np.array([0.6, 0.0, -0.8]))
    >>> bool((n * n).sum() == 1), n.astype(float)
    (True, array([ 0.6,  0. , -0.8]))
    """
    k = int(np.abs(x).argmax())
    side = 1 if x[k] > 0 else -1
    given = exact_numbers(x, "axis")
    square = (given * given).sum()
    if square == 1:
        return given
    length = Fraction(isqrt((square.numerator << 300) // square.denominator), 2**150)
    flat = np.array([Fraction(round(one / (length + abs(given[k])) * 2**128), 2**128) for one in given], object)
    flat[k] = Fraction(0)
    square = (flat * flat).sum()
    n: NDArray[Any] = 2 * flat / (1 + square)
    n[k] = side * (1 - square) / (1 + square)
    return n


def elementary(name: str, x: Any, dtype: DTypeLike = object) -> Any:
    """Return the cos, sin or sqrt of one number that is an object.

    The number is asked first (a method of that name), then the context that it carries (mpmath's), then the package
    that it is from (SymPy's). Whole numbers and fractions have only those values that are fractions themselves; among
    symbols, in an array of `SYMBOLS`, SymPy has the others.

    Raises
    ------
    ValueError
        If the value is not a fraction, or the number's type knows no such function.

    Examples
    --------
    >>> elementary("sqrt", Fraction(9, 25)), elementary("cos", 0)
    (Fraction(3, 5), Fraction(1, 1))
    """
    if isinstance(x, int | Fraction):
        return _apply_to_fraction(name, x, bool(np.dtype(dtype).metadata))
    package = sys.modules.get(home(x).partition(".")[0])
    for place in (x, getattr(x, "context", None), package):
        function = getattr(place, name, None)
        if function is not None:
            return function() if place is x else function(x)
    raise ValueError(f"expected numbers that have a {name}, got a {type(x).__name__}")


def _apply_to_fraction(name: str, x: int | Fraction, among_symbols: bool) -> Any:
    if name == "sqrt" and x >= 0:
        root = Fraction(isqrt(x.numerator), isqrt(x.denominator))
        if root * root == x:
            return root
    elif name != "sqrt" and x == 0:
        return Fraction(name == "cos")
    sympy = sys.modules.get("sympy")
    if among_symbols and sympy and (name != "sqrt" or x > 0):
        return getattr(sympy, name)(sympy.Rational(x.numerator, x.denominator))
    raise ValueError(
        f"the {name} of {x} is not a fraction; a number of SymPy's has one, and a float with no exact number beside it"
    )


def _exact(x: Any) -> Any:
    if isinstance(x, int | np.integer):
        return Fraction(int(x))
    return Fraction(*x.as_integer_ratio()) if isinstance(x, float | np.floating) else x


def _decimal(x: Any) -> Any:
    """Return the shortest decimal that is read as a float; of other numbers what `_exact` returns."""
    floating = isinstance(x, float | np.floating)
    return Fraction(np.format_float_positional(x, unique=True)) if floating else _exact(x)


def _why_not(x: Any) -> str:
    """Return what was expected in the place of x, or an empty string where x is a number."""
    if home(x).startswith("mpmath"):
        return "numbers of another kind (for mpmath numbers use twistwrench.newton_euler_3d)"
    if isinstance(x, bool | np.ndarray) or not all(hasattr(type(x), operation) for operation in ARITHMETIC):
        return "numbers"
    if isinstance(x, complex | np.complexfloating):
        return "no complex number beside exact ones"
    if home(x) in ("decimal", "_pydecimal", "_decimal"):
        return "a fraction (fractions.Fraction takes it as it is) or a float"
    try:
        Fraction(1, 2) + x
    except TypeError:  # CasADi's, say
        return "numbers that can be added to fractions"
    unlike_fractions = isinstance(x, Number) and not isinstance(x, Rational)
    if (unlike_fractions and x - x != 0) or getattr(x, "is_finite", None) is False:
        return "finite numbers"
    return ""

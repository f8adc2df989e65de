"""An answer that is typed as a formula: read by SymPy, and tried like any function.

The arguments are SymPy's matrices and symbols, by their names in the skeleton: ``"R*x + p"``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .cases import cases
from .errors import CourseError
from .exercise import Exercise, Part
from .judge import judge
from .text import Text
from .verdict import Verdict, headed

__all__ = ["judge_formula", "typed"]


def judge_formula(exercise: Exercise, part: Part, formula: str, *, seed: int = 0) -> Verdict:
    """Judge a formula as a function is; what cannot be read is wrong."""
    try:
        return judge(exercise, part, typed(part, formula), seed=seed)
    except CourseError as error:
        return headed(exercise, part, Text(str(error), str(error)))


def typed(part: Part, formula: str) -> Callable[..., Any]:
    """Return the function that a formula is, in the names of the arguments.

    ``*`` multiplies matrices, ``R.T`` is a transpose, ``a[0]`` an entry; ``cross(a, b)``, ``skew(a)``, ``stack(a, b)``
    and ``block([[A, B], [C, D]])`` are there besides what SymPy has. Several results have a comma between them.
    """
    sympy = _sympy()
    symbols, results = _read(part, formula)
    flat = [entry for value in symbols.values() for entry in _entries(value)]
    compute = sympy.lambdify(flat, [sympy.Matrix(_entries(x)) for x in results], "numpy")
    right = part.value(part.solution, cases(part, 0)[0])
    shapes = [np.shape(value) for value in (right if len(part.returns) > 1 else (right,))]

    def function(*arguments: Any) -> Any:
        numbers = [float(x) for value in arguments for x in np.ravel(value)]
        found = [np.asarray(x, float) for x in compute(*numbers)]
        fitting = [x.reshape(s) if x.size == int(np.prod(s)) else x for x, s in zip(found, shapes)]
        return tuple(fitting) if len(fitting) > 1 else fitting[0]

    function.__name__ = part.name
    return function


def _sympy() -> Any:
    try:
        import sympy
    except ImportError:
        raise CourseError("a formula needs SymPy: pip install sympy") from None
    return sympy


def _read(part: Part, formula: str) -> tuple[dict[str, Any], tuple[Any, ...]]:
    """Return the arguments as symbols, and the results as expressions of them."""
    sympy, n = _sympy(), len(part.returns)
    tried = cases(part, 0)
    shapes = {tuple(np.shape(x) if _is_number(x) else None for x in arguments) for arguments in tried}
    if len(shapes) != 1 or None in (shape := shapes.pop()) or not tried[0]:
        raise CourseError(f"{part.name}: the answer is not a formula in its arguments ({part.arguments or 'none'})")
    symbols = {name: _symbol(name, form or ()) for name, form in zip(part.names, shape)}
    functions = {
        "cross": lambda a, b: a.cross(b),
        "skew": lambda a: sympy.Matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]]),
        "stack": lambda *blocks: sympy.Matrix.vstack(*blocks),
        "block": lambda rows: sympy.Matrix(sympy.BlockMatrix(rows)),
    }
    names = {name: getattr(sympy, name) for name in ("Matrix", "eye", "zeros")}
    try:
        found = sympy.sympify(formula, locals={**functions, **names, **symbols})
    except (sympy.SympifyError, SyntaxError, TypeError, AttributeError, ValueError) as error:
        raise CourseError(f"{part.name}: the formula {formula!r} cannot be read: {error}") from None
    results = tuple(found) if isinstance(found, tuple | sympy.Tuple) and n > 1 else (found,)
    if len(results) != n:
        raise CourseError(f"{part.name}: expected {n} results with a comma between, got {len(results)}")
    known = {entry for value in symbols.values() for entry in _entries(value)}
    free = {str(s) for x in results for e in _entries(x) for s in sympy.sympify(e).free_symbols if s not in known}
    if free:
        text = f"unknown in the formula: {', '.join(sorted(free))}; known: {', '.join(part.names)}"
        raise CourseError(f"{part.name}: {text}")
    return symbols, results


def _is_number(x: Any) -> bool:
    return isinstance(x, np.ndarray | float | int) and np.ndim(x) <= 2


def _symbol(name: str, shape: tuple[int, ...]) -> Any:
    sympy = _sympy()
    if not shape:
        return sympy.Symbol(name, real=True)
    rows, columns = (*shape, 1)[:2]
    return sympy.Matrix(rows, columns, lambda i, j: sympy.Symbol(f"{name}_{i}{j if len(shape) > 1 else ''}", real=True))


def _entries(value: Any) -> list[Any]:
    """Return the entries of a matrix, row by row, or a number by itself."""
    return list(value) if hasattr(value, "shape") or isinstance(value, list | tuple) else [value]

"""Steps between configurations: q ⊕ v_dt, q₁ ⊖ q₀, and their derivatives, as programs (49.2, 49.3).

The textbook's formulas are recorded. Where they ask how large an angle is, or which of q and −q is closer, a program
computes both and chooses. Complex numbers are left to the textbook.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..model import Model, check_model
from .program import Program
from .programs import cached_program, remembered, states_of
from .quantity import Quantity

__all__ = ["d_difference", "d_integrate", "difference", "integrate", "interpolate"]


def integrate(model: Model, q: ArrayLike, v_dt: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `Model.integrate` does: q ⊕ v_dt.

    Parameters
    ----------
    model : Model
    q, v_dt
        As there.
    out : ndarray, shape (..., nq), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (..., nq)

    Raises
    ------
    ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.fast.integrate(model, model.neutral(), np.array([0, 0, np.pi / 2, *np.zeros(15)]))[3:7].round(3)
    array([0.   , 0.   , 0.707, 0.707])
    """
    there: Array = _result(model, ("integrate",), ("q", "v_dt"), (q, v_dt), out)
    return there


def difference(model: Model, q0: ArrayLike, q1: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `Model.difference` does: the q1 ⊖ q0 that leads from q0 to q1.

    Parameters
    ----------
    model : Model
    q0, q1
        As there.
    out : ndarray, shape (..., nv), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (..., nv)
        rad and m; a turn by at most π.

    Raises
    ------
    ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model, step = tw.load("go2"), np.linspace(-1, 1, 18)
    >>> q = model.standing()
    >>> bool(np.allclose(tw.fast.difference(model, q, tw.fast.integrate(model, q, step)), step, rtol=0, atol=1e-14))
    True
    """
    way: Array = _result(model, ("difference",), ("q0", "q1"), (q0, q1), out)
    return way


def d_integrate(model: Model, q: ArrayLike, v_dt: ArrayLike) -> tuple[Array, Array]:
    """Return what `Model.d_integrate` does: how q ⊕ v_dt moves with q, and with v_dt.

    Parameters
    ----------
    model : Model
    q, v_dt
        As there.

    Returns
    -------
    J_q, J_v : ndarray, shape (..., nv, nv)

    Raises
    ------
    ShapeError, ValueError
        As there.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model, step = tw.load("go2"), np.array([0, 0, np.pi / 2, *np.zeros(15)])
    >>> J_q, J_v = tw.fast.d_integrate(model, model.neutral(), step)
    >>> J_q[:3, :3].round(15) + 0.0
    array([[ 0.,  1.,  0.],
           [-1.,  0.,  0.],
           [ 0.,  0.,  1.]])
    """
    J_q, J_v = _result(model, ("J_q", "J_v"), ("q", "v_dt"), (q, v_dt))
    return J_q, J_v


def d_difference(model: Model, q0: ArrayLike, q1: ArrayLike) -> tuple[Array, Array]:
    """Return what `Model.d_difference` does: how q1 ⊖ q0 changes with q0, and with q1.

    Parameters
    ----------
    model : Model
    q0, q1
        As there.

    Returns
    -------
    J_0, J_1 : ndarray, shape (..., nv, nv)

    Raises
    ------
    ShapeError, ValueError
        As there.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> J_0, J_1 = tw.fast.d_difference(model, model.standing(), model.standing())
    >>> bool((J_1 == np.eye(18)).all() and (J_0 == -np.eye(18)).all())
    True
    """
    J_0, J_1 = _result(model, ("J_0", "J_1"), ("q0", "q1"), (q0, q1))
    return J_0, J_1


def interpolate(model: Model, q0: ArrayLike, q1: ArrayLike, u: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `Model.interpolate` does: q0 ⊕ u (q1 ⊖ q0), on the way from q0 to q1.

    Parameters
    ----------
    model : Model
    q0, q1, u
        As there.
    out : ndarray, shape (..., nq), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (..., nq)

    Raises
    ------
    ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm")
    >>> tw.fast.interpolate(arm, [0, 0, 0], [1, 2, -4], [0, 0.5])
    array([[ 0. ,  0. ,  0. ],
           [ 0.5,  1. , -2. ]])
    """
    if isinstance(u, float):
        u = np.full(batch, u) if (batch := getattr(q0, "shape", ())[:-1]) else np.array(u, float)
    there: Array = _result(model, ("interpolate",), ("q0", "q1", "u"), (q0, q1, u), out)
    return there


def _interpolated(model: Model, q0: Array, q1: Array, u: Array) -> Array:
    return model._step(q0, u[..., None] * model._way(q0, q1))


TEXTBOOK: dict[str, tuple[Callable[..., Array], Callable[..., Array]]] = {
    "integrate": (Model.integrate, Model._step),
    "difference": (Model.difference, Model._way),
    "J_q": (lambda *x: Model.d_integrate(*x)[0], lambda m, q, v: m._d_step(v)[0]),
    "J_v": (lambda *x: Model.d_integrate(*x)[1], lambda m, q, v: m._d_step(v)[1]),
    "J_0": (lambda *x: Model.d_difference(*x)[0], lambda *x: Model._d_way(*x)[0]),
    "J_1": (lambda *x: Model.d_difference(*x)[1], lambda *x: Model._d_way(*x)[1]),
    "interpolate": (Model.interpolate, _interpolated),
}
"""What is computed, by its symbol: the textbook's function, and its formula, which is recorded."""


def _result(
    model: Model, want: tuple[str, ...], names: tuple[str, ...], args: Sequence[ArrayLike], out: Array | None = None
) -> Any:
    """Return one result, or a tuple of several."""
    found = remembered(model, want, None, args, out)
    if found is not None:
        return found if len(want) == 1 else tuple(found)
    check_model(model)
    states, dtype = states_of(model, dict(zip(names, args)))

    def asked() -> list[Quantity]:
        return [_quantity(model, symbol, names, dtype) for symbol in want]

    single = len(want) == 1
    if dtype.kind == "c":
        program = Program(model, asked(), single=single, dtype=dtype, backend="textbook")
    else:
        program = cached_program(model, (want, dtype, None), dtype, asked, single=single)
    results = program(*states, out=out)
    return results if single else tuple(getattr(results, symbol) for symbol in want)


def _quantity(model: Model, symbol: str, names: tuple[str, ...], dtype: np.dtype[Any]) -> Quantity:
    """Return what is computed, by the textbook's function; of recorded numbers by its formula."""
    function, formula = TEXTBOOK[symbol]
    limit = Fraction(2) ** (min(int(np.finfo(dtype).maxexp), 1024) // 5)  # of a step, as in `watch.state_questions`

    def compute(*x: Array) -> tuple[Array, list[Any]]:
        if x[0].dtype != object:
            return function(model, *x), []
        try:
            watched = x[2] * model._way(*x[:2]) / limit if symbol == "interpolate" else ()
            return formula(model, *x), [*watched]
        except ValueError as error:  # a joint of one's own that checks its numbers
            raise TypeError(f"{symbol} of {model.name!r} asks what its arguments are") from error

    return Quantity(symbol, names, compute)

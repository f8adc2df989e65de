"""The public functions of `twistwrench.fast`: those of the textbook, as programs."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

from numpy.typing import ArrayLike

from ..algorithms.floating_base import HeldRows, as_frames, as_held
from ..algorithms.whole_body import QUANTITIES, Dynamics, select_quantities
from ..arrays import Array
from ..model import Model, check_model
from .programs import program, remembered, result, states_of

__all__ = ["aba", "centroidal_map", "crba", "dynamics", "nonlinear_effects", "rnea"]

KINDS = (tuple, list, set, frozenset)
SETS = {frozenset(names): names for k in range(1 + len(QUANTITIES)) for names in combinations(QUANTITIES, k)}
"""All that may be wanted, in the order of `QUANTITIES`."""


def rnea(
    model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None, *, out: Array | None = None
) -> Array:
    """Return what `twistwrench.rnea` does: the joint forces that make a motion happen (49.6).

    Parameters
    ----------
    model, q, v, a, f_ext
        As there.
    out : ndarray, shape (..., nv), optional
        To be filled, of the number type of the result. It may share memory with the inputs: all are read as they were
        before the call.

    Returns
    -------
    ndarray, shape (..., nv)
        N m or N.

    Raises
    ------
    ShapeError, ValueError
        As `twistwrench.rnea`; or if `out` does not fit, is read-only, or has entries that share memory.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> v = np.random.default_rng(0).standard_normal((1000, model.nv))
    >>> tau = tw.fast.rnea(model, model.standing(), v, v)
    >>> np.allclose(tau[0], tw.rnea(model, model.standing(), v[0], v[0]), rtol=0, atol=1e-11)
    True
    """
    return result(model, "tau", ("q", "v", "a"), (q, v, a), f_ext, out)


def nonlinear_effects(model: Model, q: ArrayLike, v: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `twistwrench.nonlinear_effects` does: h = C v + g (49.6).

    Parameters
    ----------
    model, q, v, out
        As in `rnea`.

    Returns
    -------
    ndarray, shape (..., nv)
        N m or N.

    Raises
    ------
    ShapeError, ValueError
        As `rnea`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.fast.nonlinear_effects(tw.load("cart_pole"), [0.0, 0.0], [0.0, 0.0]) + 0.0  # standing: nothing for the cart
    array([0., 0.])
    """
    return result(model, "h", ("q", "v"), (q, v), None, out)


def crba(model: Model, q: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `twistwrench.crba` does: the mass matrix (49.8).

    Parameters
    ----------
    model, q, out
        As in `rnea`; `out` has shape (..., nv, nv).

    Returns
    -------
    ndarray, shape (..., nv, nv)
        kg m², kg m and kg.

    Raises
    ------
    ShapeError, ValueError
        As `rnea`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("pendulum")
    >>> tw.fast.crba(model, [[0.0], [1.0]]).shape
    (2, 1, 1)
    """
    return result(model, "M", ("q",), (q,), None, out)


def centroidal_map(model: Model, q: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `twistwrench.centroidal_map` does: the centroidal momentum matrix (49.10).

    Parameters
    ----------
    model, q, out
        As in `rnea`; `out` has shape (..., 6, nv).

    Returns
    -------
    ndarray, shape (..., 6, nv)
        Rows (angular, linear), in the axes of the world.

    Raises
    ------
    ShapeError, SingularError, ValueError
        As `rnea`, and if nothing that moves has mass.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.fast.centroidal_map(model, model.standing())[5, 5].round(3)  # the whole mass
    np.float64(16.085)
    """
    return result(model, "A_G", ("q",), (q,), None, out)


def dynamics(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    *,
    contacts: Iterable[str | HeldRows] | None = None,
    want: Iterable[str] = QUANTITIES,
    out: Dynamics | None = None,
) -> Dynamics:
    """Return what `twistwrench.dynamics` does: M, h, J_c and A_G (49.11).

    Computing all at once is faster than one after the other, because they share the placements of the links.

    Parameters
    ----------
    model, q, v, contacts, want
        As there.
    out : Dynamics, optional
        Arrays that the results are written to. Where an entry is None, a new array is made.

    Returns
    -------
    Dynamics
        Quantities that were not wanted are None.

    Raises
    ------
    NameNotFound, ShapeError, SingularError, ValueError
        As `twistwrench.dynamics`.
    TypeError
        If `out` is not a `Dynamics`.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> d = tw.fast.dynamics(model, np.tile(model.standing(), (5, 1)), np.zeros((5, model.nv)))
    >>> d.M.shape, d.h.shape, d.J_c.shape, d.A_G.shape
    ((5, 18, 18), (5, 18), (5, 12, 18), (5, 6, 18))
    """
    check_model(model)
    names = want if want is QUANTITIES else in_order(want)
    if contacts is None:
        contacts = model.feet
    elif type(contacts) is not tuple:
        contacts = as_frames(contacts)
    given = None
    if out is not None:
        if not isinstance(out, Dynamics):
            raise TypeError(f"out: expected a Dynamics, got {type(out).__name__}")
        given = {name: x for name in names if (x := getattr(out, name)) is not None}
    held = contacts if "J_c" in names else ()
    found = remembered(model, names, held, (q, v), given)
    if found is None:
        as_held(model, held)  # raises for those that the model has not
        args, dtype = states_of(model, {"q": q, "v": v})
        computed = program(model, names, dtype, held)(*args, out=given)
        found = [getattr(computed, name) for name in names]
    made = object.__new__(Dynamics)  # whose own way, entry by entry, takes a third as long as the program
    vars(made).update(zip(names, found))
    return made


def in_order(want: Iterable[str]) -> tuple[str, ...]:
    """Return which quantities are wanted, in the order of `QUANTITIES`; raise NameNotFound for other names."""
    try:
        names = SETS.get(frozenset(want)) if type(want) in KINDS else None
    except TypeError:  # what is no name, which the next line says
        names = None
    return SETS[frozenset(select_quantities(want))] if names is None else names


def aba(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    tau: ArrayLike,
    f_ext: ArrayLike | None = None,
    *,
    out: Array | None = None,
) -> Array:
    """Return what `twistwrench.aba` does: the acceleration under given joint forces (49.7).

    Parameters
    ----------
    model, q, v, tau, f_ext, out
        As there, and as in `rnea`.

    Returns
    -------
    ndarray, shape (..., nv)
        rad/s² or m/s².

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `twistwrench.aba`; or if `out` does not fit.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("double_pendulum")
    >>> q = np.random.default_rng(0).uniform(-3, 3, (1000, 2))
    >>> qdd = tw.fast.aba(model, q, q, q)
    >>> np.allclose(tw.fast.rnea(model, q, q, qdd), q)
    True
    """
    return result(model, "qdd", ("q", "v", "tau"), (q, v, tau), f_ext, out)

"""What `twistwrench.fast` offers: functions of the textbook, by other means."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import partial

from numpy.typing import ArrayLike

from ..centroidal import centroidal_map as textbook_centroidal_map
from ..checks import Array
from ..errors import unknown_name
from ..whole_body import Dynamics
from ..model import Model
from .contacts import contacts_of
from .door import admit
from .kernels import forward_dynamics, inverse_dynamics, quantities
from .many import fill, given_or_empty

__all__ = ["aba", "centroidal_map", "crba", "dynamics", "nonlinear_effects", "rnea"]


def rnea(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    f_ext: ArrayLike | None = None,
    *,
    out: Array | None = None,
    workers: int = 1,
    progress: bool = False,
) -> Array:
    """Return what `twistwrench.rnea` does: the joint forces that make a motion happen (49.6).

    Parameters
    ----------
    model, q, v, a, f_ext
        As there.
    out : ndarray, shape (..., nv), optional
        To be filled, of the number type of the result.
    workers : int
        Number of threads for many states.
    progress : bool
        Show a bar on stderr.

    Returns
    -------
    ndarray, shape (..., nv)
        N m or N. Of many states, the states come last in memory.

    Raises
    ------
    ShapeError, ValueError
        As `twistwrench.rnea`; or if `out` is not what it must be.

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
    plan, (q, *rest) = admit(model, q, ("v", v), ("a", a), f_ext=f_ext)
    out = given_or_empty("out", out, q.shape[:-1], (model.nv,), q.dtype)
    fill(partial(inverse_dynamics, plan), [q, *rest], [out], plan=plan, workers=workers, progress=progress)
    return out


def nonlinear_effects(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    *,
    out: Array | None = None,
    workers: int = 1,
    progress: bool = False,
) -> Array:
    """Return what `twistwrench.nonlinear_effects` does: h = C v + g (49.9).

    Parameters
    ----------
    model, q, v
        As there.
    out, workers, progress
        As in `rnea`.

    Returns
    -------
    ndarray, shape (..., nv)
        N m or N. Of many states, the states come last in memory.

    Raises
    ------
    ShapeError, ValueError
        As `rnea`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.fast.nonlinear_effects(tw.load("cart_pole"), [0.0, 0.0], [0.0, 0.0])  # standing: nothing for the cart
    array([0., 0.])
    """
    given = {} if out is None else {"h": out}
    return _compute(model, q, {"v": v}, ("h",), (), given, workers, progress)["h"]


def crba(model: Model, q: ArrayLike, *, out: Array | None = None, workers: int = 1, progress: bool = False) -> Array:
    """Return what `twistwrench.crba` does: the mass matrix (49.8).

    Parameters
    ----------
    model, q
        As there.
    out, workers, progress
        As in `rnea`; `out` has shape (..., nv, nv).

    Returns
    -------
    ndarray, shape (..., nv, nv)
        kg m², kg m and kg. Of many states, the states come last in memory.

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
    given = {} if out is None else {"M": out}
    return _compute(model, q, {}, ("M",), (), given, workers, progress)["M"]


def centroidal_map(
    model: Model, q: ArrayLike, *, out: Array | None = None, workers: int = 1, progress: bool = False
) -> Array:
    """Return what `twistwrench.centroidal_map` does: the centroidal momentum matrix (49.10).

    Parameters
    ----------
    model, q
        As there.
    out, workers, progress
        As in `rnea`; `out` has shape (..., 6, nv).

    Returns
    -------
    ndarray, shape (..., 6, nv)
        Rows (angular, linear), in the axes of the world. Of many states, the states come last in memory.

    Raises
    ------
    SingularError
        If nothing that moves has mass.
    ShapeError, ValueError
        As `rnea`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.fast.centroidal_map(model, model.standing())[5, 5].round(3)  # the whole mass
    np.float64(16.085)
    """
    given = {} if out is None else {"A_G": out}
    return _compute(model, q, {}, ("A_G",), (), given, workers, progress)["A_G"]


def dynamics(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    *,
    contacts: Sequence[str] | None = None,
    want: Collection[str] = ("M", "h", "J_c", "A_G"),
    out: Dynamics | None = None,
    workers: int = 1,
    progress: bool = False,
) -> Dynamics:
    """Return what `twistwrench.dynamics` does: M, h, J_c and A_G (49.9).

    Asking for all at once is cheaper than for one after the other: they share the places of the links.

    Parameters
    ----------
    model, q, v, contacts, want
        As there.
    out : Dynamics, optional
        Arrays to be filled; what is None in it is made.
    workers, progress
        As in `rnea`.

    Returns
    -------
    Dynamics
        What was not asked for is None. Of many states, the states come last in memory.

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As `twistwrench.dynamics`.
    SingularError
        As `centroidal_map`.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> d = tw.fast.dynamics(model, np.tile(model.standing(), (5, 1)), np.zeros((5, model.nv)))
    >>> d.M.shape, d.h.shape, d.J_c.shape, d.A_G.shape
    ((5, 18, 18), (5, 18), (5, 12, 18), (5, 6, 18))
    """
    contacts = model.feet if contacts is None else contacts
    given = {} if out is None else {name: x for name, x in vars(out).items() if x is not None}
    return Dynamics(**_compute(model, q, {"v": v}, want, contacts, given, workers, progress))


def _compute(
    model: Model,
    q: ArrayLike,
    rates: dict[str, ArrayLike],
    want: Collection[str],
    contacts: Sequence[str],
    given: dict[str, Array],
    workers: int,
    progress: bool,
) -> dict[str, Array]:
    """Check, make room and fill it with what is wanted."""
    nv = model.nv
    tails = {"M": (nv, nv), "h": (nv,), "J_c": (3 * len(contacts), nv), "A_G": (6, nv)}
    for name in want:
        if name not in tails:
            raise unknown_name("quantity", name, tails)
    plan, (q, *rest) = admit(model, q, *rates.items())
    if "A_G" in want and model.mass == 0:
        textbook_centroidal_map(model, q)  # says what is wrong
    touching = contacts_of(model, plan, contacts) if "J_c" in want else None
    results = {
        name: given_or_empty(f"out.{name}", given.get(name), q.shape[:-1], tail, q.dtype)
        for name, tail in tails.items()
        if name in want
    }
    kernel = partial(quantities, plan, touching, tuple(results))
    fill(kernel, [q, *rest], list(results.values()), plan=plan, workers=workers, progress=progress)
    return results


def aba(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    tau: ArrayLike,
    f_ext: ArrayLike | None = None,
    *,
    out: Array | None = None,
    workers: int = 1,
    progress: bool = False,
) -> Array:
    """Return what `twistwrench.aba` does: the acceleration under given joint forces (49.7).

    Parameters
    ----------
    model, q, v, tau, f_ext
        As there.
    out, workers, progress
        As in `rnea`.

    Returns
    -------
    ndarray, shape (..., nv)
        rad/s² or m/s². Of many states, the states come last in memory.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `twistwrench.aba`; or if `out` is not what it must be.

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
    plan, (q, *rest) = admit(model, q, ("v", v), ("tau", tau), f_ext=f_ext)
    out = given_or_empty("out", out, q.shape[:-1], (model.nv,), q.dtype)
    fill(partial(forward_dynamics, model, plan), [q, *rest], [out], plan=plan, workers=workers, progress=progress)
    return out

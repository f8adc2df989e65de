"""Where frames and the centre of mass are, their Jacobians, and the energies: the textbook's functions, as programs."""

from __future__ import annotations

from typing import Any, get_args

from numpy.typing import ArrayLike

from ..algorithms import kinematics as textbook
from ..algorithms.kinematics import Reference
from ..arrays import Array
from ..errors import check_known
from ..model import Model, check_model
from ..spatial import SE3
from .programs import cached_program, remembered, result, states_of
from .quantity import Quantity

__all__ = [
    "center_of_mass",
    "center_of_mass_jacobian",
    "frame_bias_acceleration",
    "frame_jacobian",
    "frame_placement",
    "kinetic_energy",
    "potential_energy",
]


def frame_placement(model: Model, q: ArrayLike, frame: str) -> SE3:
    """Return what `twistwrench.frame_placement` does: where a frame is in the world (49.3).

    Parameters
    ----------
    model, q, frame
        As there.

    Returns
    -------
    SE3

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As there.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.fast.frame_placement(model, model.standing(), "FR_foot").translation.round(3) + 0.0
    array([ 0.193, -0.142,  0.   ])
    """
    found = remembered(model, ("R", "p"), frame, (q,))
    if found is None:
        R = Quantity("R", ("q",), lambda q: (textbook.frame_placement(model, q, frame).rotation, []))
        p = Quantity("p", ("q",), lambda q: (textbook.frame_placement(model, q, frame).translation, []))
        both = _of_frame(model, [R, p], frame, {"q": q})
        found = both.R, both.p
    return SE3._trusted(*found)


def frame_jacobian(
    model: Model, q: ArrayLike, frame: str, reference: Reference = "local", *, out: Array | None = None
) -> Array:
    """Return what `twistwrench.frame_jacobian` does: the J with which a frame's twist is J v (49.2, 49.9).

    Parameters
    ----------
    model, q, frame, reference
        As there.
    out : ndarray, shape (..., 6, nv), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (..., 6, nv)
        Rows (ω, v).

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm")
    >>> tw.fast.frame_jacobian(arm, arm.neutral(), "tool", "world").shape
    (6, 3)
    """
    found = remembered(model, ("J",), (frame, reference), (q,), out)
    if found is None:
        J = Quantity("J", ("q",), lambda q: (textbook.frame_jacobian(model, q, frame, reference), []))
        found = _of_frame(model, [J], (frame, reference), {"q": q}, out)
    return found  # type: ignore[no-any-return]


def frame_bias_acceleration(
    model: Model, q: ArrayLike, v: ArrayLike, frame: str, reference: Reference = "local", *, out: Array | None = None
) -> Array:
    """Return what `twistwrench.frame_bias_acceleration` does: J̇ v, the frame's acceleration at q̈ = 0 (49.9).

    Parameters
    ----------
    model, q, v, frame, reference
        As there.
    out : ndarray, shape (..., 6), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (..., 6)
        rad/s² and m/s², without gravity.

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import twistwrench as tw
    >>> pendulum = tw.load("pendulum")
    >>> tw.fast.frame_bias_acceleration(pendulum, [0.0], [2.0], "bob", "local_world_aligned")[3:].round(12)
    array([0., 0., 4.])
    """
    found = remembered(model, ("dJ_v",), (frame, reference), (q, v), out)
    if found is None:

        def bias(q: Array, v: Array) -> tuple[Array, list[Any]]:
            return textbook.frame_bias_acceleration(model, q, v, frame, reference), []

        found = _of_frame(model, [Quantity("dJ_v", ("q", "v"), bias)], (frame, reference), {"q": q, "v": v}, out)
    return found  # type: ignore[no-any-return]


def center_of_mass(model: Model, q: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `twistwrench.center_of_mass` does: p_G of everything that moves, in the world (49.10).

    Parameters
    ----------
    model, q
        As there.
    out : ndarray, shape (..., 3), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (..., 3)
        m.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.fast.center_of_mass(tw.load("pendulum"), [[0.0]]) + 0.0
    array([[ 0.,  0., -1.]])
    """
    return result(model, "p_G", ("q",), (q,), None, out)


def center_of_mass_jacobian(model: Model, q: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `twistwrench.center_of_mass_jacobian` does: the J_G with which v_G = J_G v (49.10).

    Parameters
    ----------
    model, q
        As there.
    out : ndarray, shape (..., 3, nv), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (..., 3, nv)
        In the axes of the world.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.fast.center_of_mass_jacobian(tw.load("pendulum"), [[0.0]])[0].T.round(12) + 0.0
    array([[-1.,  0.,  0.]])
    """
    return result(model, "J_G", ("q",), (q,), None, out)


def kinetic_energy(model: Model, q: ArrayLike, v: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `twistwrench.kinetic_energy` does: T = ½ vᵀ M v, rotors included (49.8).

    Parameters
    ----------
    model, q, v
        As there.
    out : ndarray, shape (...), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (...)
        J.

    Raises
    ------
    ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.fast.kinetic_energy(tw.load("pendulum"), [0.5], [2.0])
    np.float64(2.002)
    """
    return _number(result(model, "T", ("q", "v"), (q, v), None, out), out)


def potential_energy(model: Model, q: ArrayLike, *, out: Array | None = None) -> Array:
    """Return what `twistwrench.potential_energy` does: U = −Σ mᵢ g · cᵢ (49.8).

    Parameters
    ----------
    model, q
        As there.
    out : ndarray, shape (...), optional
        To be filled: see `rnea`.

    Returns
    -------
    ndarray, shape (...)
        J.

    Raises
    ------
    ShapeError, ValueError
        As there; or if `out` does not fit.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.fast.potential_energy(tw.load("pendulum"), [0.0])
    np.float64(-9.81)
    """
    return _number(result(model, "U", ("q",), (q,), None, out), out)


def _of_frame(
    model: Model, asked: list[Quantity], of: str | tuple[str, str], named: dict[str, Any], out: Array | None = None
) -> Any:
    """Return what the program of a frame computes."""
    check_model(model)
    frame, *reference = of if isinstance(of, tuple) else (of,)
    model.frame(frame)
    for axes in reference:
        check_known("reference", axes, get_args(Reference))
    states, dtype = states_of(model, named)
    key = (tuple(quantity.symbol for quantity in asked), dtype, of)
    return cached_program(model, key, dtype, lambda: asked, single=len(asked) == 1)(*states, out=out)


def _number(x: Array, out: Array | None) -> Array:
    """Return the energy of one state as a number, as the textbook does, unless it is in an array of the caller."""
    number: Array = x[()] if out is None else x
    return number

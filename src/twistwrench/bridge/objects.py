"""Pinocchio's own types: placements, inertias, external wrenches (section 49.11)."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array
from ..errors import ShapeError
from ..model import Model, check_arrays, check_model
from ..spatial import SE3, SpatialInertia
from .spatial import HALVES, to_pinocchio_force, vectors

__all__ = [
    "from_pinocchio_f_ext",
    "from_pinocchio_inertia",
    "from_pinocchio_se3",
    "import_pinocchio",
    "to_pinocchio_f_ext",
    "to_pinocchio_inertia",
    "to_pinocchio_se3",
]


def import_pinocchio() -> Any:
    """Return the module `pinocchio`, or raise with the way to install it.

    Returns
    -------
    module

    Raises
    ------
    ImportError
        If it is missing, or if what is installed under that name is something else.

    Examples
    --------
    >>> import_pinocchio().__name__
    'pinocchio'
    """
    how = "install it with `pip install pin` (the name `pinocchio` on PyPI is a plugin for a test runner)"
    try:
        pin = importlib.import_module("pinocchio")
    except ImportError as error:
        raise ImportError(f"Pinocchio cannot be imported ({error}); {how}") from None
    if not hasattr(pin, "JointModelFreeFlyer"):
        raise ImportError(f"the installed module `pinocchio` is not the rigid-body library; {how}")
    return pin


def to_pinocchio_se3(T: SE3) -> Any:
    """Return a placement as ``pin.SE3``.

    Parameters
    ----------
    T : SE3
        One placement, without batch axes.

    Returns
    -------
    pin.SE3
        In float64, the only number type that it has.

    Raises
    ------
    ShapeError, ValueError
        If T has batch axes or is complex.
    TypeError
        If the argument is of another type.
    ImportError
        As `import_pinocchio`.

    Examples
    --------
    >>> to_pinocchio_se3(SE3(np.eye(3), [1, 2, 3])).translation
    array([1., 2., 3.])
    """
    _expect(SE3, T, "T")
    return import_pinocchio().SE3(_double(T.rotation, "T.rotation", 2), _double(T.translation, "T.translation", 1))


def from_pinocchio_se3(T: Any) -> SE3:
    """Return a ``pin.SE3`` as `SE3`.

    Parameters
    ----------
    T : pin.SE3

    Returns
    -------
    SE3

    Raises
    ------
    ShapeError, ValueError
        If its rotation is not a rotation matrix, or not finite.
    TypeError
        If the argument is of another type.

    Examples
    --------
    >>> pin = import_pinocchio()
    >>> from_pinocchio_se3(pin.SE3(np.eye(3), np.array([1.0, 2, 3]))).translation
    array([1., 2., 3.])
    """
    _expect(import_pinocchio().SE3, T, "T")
    return SE3(T.rotation, T.translation)


def to_pinocchio_inertia(inertia: SpatialInertia) -> Any:
    """Return a spatial inertia as ``pin.Inertia``, number by number.

    Its matrix is in Pinocchio's order then; a 6 × 6 matrix goes through `to_pinocchio_transform`.

    Parameters
    ----------
    inertia : SpatialInertia
        One body, without batch axes.

    Returns
    -------
    pin.Inertia

    Raises
    ------
    ShapeError, ValueError
        If it has batch axes or is complex.
    TypeError
        If the argument is of another type.
    ImportError
        As `import_pinocchio`.

    Examples
    --------
    >>> body = SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.01, 0.01, 0.005]))
    >>> to_pinocchio_inertia(body).matrix().diagonal()
    array([2.   , 2.   , 2.   , 0.03 , 0.03 , 0.005])
    """
    _expect(SpatialInertia, inertia, "inertia")
    # Filled in afterwards: the constructor rejects inertias that are not physical, but that robots have.
    there = import_pinocchio().Inertia.Zero()
    there.mass = float(_double(inertia.mass, "mass", 0))
    there.lever = _double(inertia.com, "com", 1)
    there.inertia = _double(inertia.inertia_at_com, "inertia_at_com", 2)
    return there


def from_pinocchio_inertia(inertia: Any) -> SpatialInertia:
    """Return a ``pin.Inertia`` as `SpatialInertia`, number by number.

    Parameters
    ----------
    inertia : pin.Inertia

    Returns
    -------
    SpatialInertia

    Raises
    ------
    ModelError, ValueError
        If the mass is below zero, or a number is not finite.
    TypeError
        If the argument is of another type.

    Examples
    --------
    >>> pin = import_pinocchio()
    >>> from_pinocchio_inertia(pin.Inertia(2.0, np.array([0, 0, 0.1]), np.eye(3))).com
    array([0. , 0. , 0.1])
    """
    _expect(import_pinocchio().Inertia, inertia, "inertia")
    return SpatialInertia(inertia.mass, inertia.lever, inertia.inertia)


def to_pinocchio_f_ext(model: Model, f_ext: ArrayLike) -> Any:
    """Return external wrenches as Pinocchio's ``rnea`` and ``aba`` take them.

    Parameters
    ----------
    model : Model
    f_ext : array_like, shape (nbodies, 6)
        Wrench (τ, f) on each body, in its own frame; row 0 is zero. N m and N.

    Returns
    -------
    pin.StdVec_Force
        One ``pin.Force`` per joint id, the universe included, each in its joint's frame.

    Raises
    ------
    ShapeError, ValueError
        If the shape is not (nbodies, 6), the numbers are complex, or a wrench acts on the world.
    ImportError
        As `import_pinocchio`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("pendulum")
    >>> to_pinocchio_f_ext(model, [[0, 0, 0, 0, 0, 0], [1, 2, 3, 4, 5, 6]])[1].linear
    array([4., 5., 6.])
    """
    check_model(model)
    pin = import_pinocchio()
    F = _double(check_arrays(model, f_ext=f_ext)[0], "f_ext", 2)
    there = pin.StdVec_Force()
    there.extend([pin.Force(f) for f in to_pinocchio_force(F)])
    return there


def from_pinocchio_f_ext(model: Model, f_ext: Any) -> Array:
    """Return Pinocchio's external wrenches as an array: the inverse of `to_pinocchio_f_ext`.

    Parameters
    ----------
    model : Model
    f_ext : pin.StdVec_Force, or sequence of pin.Force
        One per joint id, the universe included.

    Returns
    -------
    ndarray, shape (nbodies, 6)
        Wrench (τ, f) on each body, in its own frame, N m and N.

    Raises
    ------
    ShapeError, ValueError
        If there is not one wrench per body, or one acts on the world.

    Examples
    --------
    >>> import twistwrench as tw
    >>> pin, model = import_pinocchio(), tw.load("pendulum")
    >>> from_pinocchio_f_ext(model, [pin.Force.Zero(), pin.Force(np.arange(6.0))])[1]
    array([3., 4., 5., 0., 1., 2.])
    """
    check_model(model)
    F = as_array(vectors(f_ext, "f_ext", "Force"), "f_ext", 6)[..., HALVES]
    return check_arrays(model, f_ext=F)[0]


def _expect(kind: type, value: object, name: str) -> None:
    """Raise TypeError for another type, with the packages of both: each has an SE3."""
    if not isinstance(value, kind):
        expected, got = (f"{k.__module__.partition('.')[0]}.{k.__name__}" for k in (kind, type(value)))
        raise TypeError(f"{name}: expected {expected}, got {got}")


def _double(x: Array, name: str, axes: int) -> Array:
    """Return x in float64, or raise with the reason why Pinocchio cannot hold it."""
    if x.ndim != axes:
        raise ShapeError(f"{name}: Pinocchio takes one at a time, got batch axes {x.shape[: x.ndim - axes]}")
    if np.iscomplexobj(x):
        raise ValueError(f"{name}: Pinocchio has no complex numbers, got {x.dtype}")
    return x.astype(np.float64)

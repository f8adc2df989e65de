"""How the centroidal quantities change: Ȧ_G, the velocity and acceleration of the centre of mass, and I_G (49.10)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..model import Model, Tree, check_state, columns, composite_inertias, tree_terms
from ..spatial.formulas import cross_force, cross_motion, symmetric
from ._mimic import also_of_mimics
from .centroidal import centroidal_map, centroidal_momentum, centroidal_momentum_rate, to_center_of_mass, total_mass

__all__ = [
    "center_of_mass_acceleration",
    "center_of_mass_jacobian",
    "center_of_mass_velocity",
    "centroidal_inertia",
    "centroidal_map_rate",
    "momentum_map_rate",
    "total_inertia",
]


def momentum_map_rate(tree: Tree, X: list[Array], qd: list[Array]) -> Array:
    """Run the CCRBA and its derivative: each body's inertia turns with the body, each joint's S as well.

    Seen from a frame that moves along with the centre of mass, the world has the velocity −v_G: V[i] is the twist of
    body i as seen from there, and X[i], which leads there, is ᴳX*_i as in `centroidal_composite`.
    """
    parent, S, I, bodies = tree.parent, tree.S, tree.I, range(len(tree.parent))
    IC = composite_inertias(tree)
    (V,) = tree.zeros(1)
    momentum = sum((X[i] @ (IC[i] @ (S[i] @ qd[i])) for i in tree.outward), V[0])
    v_G = momentum[..., 3:, :] / sum(I[i][..., 5, 5] for i in bodies)
    V[0] = np.concatenate([np.zeros_like(v_G), -v_G], axis=-2)
    for i in tree.outward:
        V[i] = tree.X[i] @ V[parent[i]] + S[i] @ qd[i]
    dIC = [cross_force(V[i]) @ I[i] - I[i] @ cross_motion(V[i]) for i in bodies]  # 49.10 dI: of the body alone
    for i in tree.inward:
        dIC[parent[i]] = dIC[parent[i]] + tree.X[i].mT @ dIC[i] @ tree.X[i]  # 49.10 dIC: of its subtree
    dA_G = [X[i] @ (dIC[i] @ S[i] + IC[i] @ cross_motion(V[i]) @ S[i]) for i in bodies]  # 49.10 dA_G
    return np.concatenate(dA_G, axis=-1)


def total_inertia(tree: Tree, X: list[Array], bodies: Sequence[int]) -> Array:
    """Return the inertia of some bodies, joints locked, where X, as in `centroidal_composite`, leads to."""
    inertia: Array = np.sum([X[i] @ tree.I[i] @ X[i].mT for i in bodies], axis=0)  # 49.10 I_G
    return symmetric(inertia)


@also_of_mimics
def centroidal_map_rate(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Return Ȧ_G(q, v), the rate of the centroidal momentum matrix: ḣ_G = A_G a + Ȧ_G v.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (..., 6, nv)
        Rows (angular, linear), at the centre of mass, in the axes of the world (Pinocchio's ``data.dAg`` has the
        linear rows first).

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `center_of_mass`.

    Notes
    -----
    Section 49.10; P. M. Wensing and D. E. Orin, Improved computation of the humanoid centroidal dynamics and
    application for whole-body control, 2016. For Ȧ_G v alone `centroidal_momentum_rate` with a = 0 is less work.
    `momentum_map_rate` has the loops.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> q, v = model.standing(), np.linspace(-1, 1, model.nv)
    >>> bias = tw.centroidal_momentum_rate(model, q, v, np.zeros(model.nv))
    >>> np.allclose(tw.centroidal_map_rate(model, q, v) @ v, bias, rtol=0, atol=1e-13)
    True
    """
    q, v = check_state(model, q, v=v)
    tree = tree_terms(model, q)
    return momentum_map_rate(tree, to_center_of_mass(model, tree, q), columns(model, v))


@also_of_mimics
def centroidal_inertia(model: Model, q: ArrayLike) -> Array:
    """Return I_G, the inertia of the whole robot with its joints locked, at the centre of mass in the world's axes.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., 6, 6)
        The rotational inertia, kg m², and the mass on the diagonal, kg: nothing couples the two at the centre of mass,
        but for rounding.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `center_of_mass`.

    Notes
    -----
    Section 49.10. I_G⁻¹ h_G is the average twist of Orin, Goswami and Lee: that of the locked robot with the same
    momentum. Pinocchio's ``data.Ig``.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.centroidal_inertia(model, model.standing()).diagonal().round(3)
    array([ 0.166,  0.501,  0.562, 16.085, 16.085, 16.085])
    """
    (q,) = check_state(model, q)
    tree = tree_terms(model, q)
    return total_inertia(tree, to_center_of_mass(model, tree, q), range(model.nbodies))


@also_of_mimics
def center_of_mass_jacobian(model: Model, q: ArrayLike) -> Array:
    """Return J_G, the Jacobian of the centre of mass: v_G = J_G v, the linear rows of A_G over the mass.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., 3, nv)
        In the axes of the world.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `center_of_mass`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.center_of_mass_jacobian(tw.load("pendulum"), [0.0]).round(12) + 0.0
    array([[-1.],
           [ 0.],
           [ 0.]])
    """
    return _over_mass(model, centroidal_map(model, q).mT).mT


@also_of_mimics
def center_of_mass_velocity(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Return v_G, the velocity of the centre of mass in the world: the linear momentum over the mass.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (..., 3)
        m/s.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `center_of_mass`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.center_of_mass_velocity(tw.load("pendulum"), [0.0], [2.0]).round(12) + 0.0
    array([-2.,  0.,  0.])
    """
    return _over_mass(model, centroidal_momentum(model, q, v))


@also_of_mimics
def center_of_mass_acceleration(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
    """Return a_G, the acceleration of the centre of mass in the world, without gravity.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (..., 3)
        m/s².

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `center_of_mass`.

    Examples
    --------
    The ball of a pendulum of 1 m at 2 rad/s is pulled to the pivot with ω² r:

    >>> import twistwrench as tw
    >>> tw.center_of_mass_acceleration(tw.load("pendulum"), [0.0], [2.0], [0.0]).round(12) + 0.0
    array([0., 0., 4.])
    """
    return _over_mass(model, centroidal_momentum_rate(model, q, v, a))


def _over_mass(model: Model, momentum: Array) -> Array:
    """Divide the linear part by the mass."""
    mass = total_mass(model, momentum, range(model.nbodies), model.name)
    return np.asarray(momentum[..., 3:] / mass)

"""Centre of mass, centroidal momentum and its matrix (49.10).

Forces from outside change six numbers of the whole robot and nothing else: its momentum
h_G = (k_G, l_G) at the centre of mass G, in the axes of the world.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, convert
from ..errors import SingularError
from ..model import Model, Tree, check_state, columns, composite_inertias, joint_placements, tree_terms
from ..spatial import SE3
from ..spatial.formulas import bias_wrench
from ..spatial.plucker import place_point
from ._mimic import also_of_mimics
from .kinematics import motion, placements
from .terms import CentroidalTerms, matrices

__all__ = [
    "center_of_mass",
    "centroidal_composite",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_momentum_rate",
    "centroidal_terms",
    "composite_center",
    "mean_center",
    "placements_from_first_body",
    "to_center_of_mass",
    "total_mass",
    "wrench_transforms",
]


def centroidal_composite(tree: Tree, placement: list[SE3]) -> CentroidalTerms:
    """Run the CCRBA: a unit velocity of joint i moves its subtree as one rigid body, with the momentum IC[i] S[i].

    The bodies are placed in the axes of the world, about any origin. X[i] is the chapter's ᴳX*_i: it takes a momentum
    from frame i to the centre of mass.
    """
    IC = composite_inertias(tree)  # 49.10 IC
    X = wrench_transforms(placement, composite_center(tree, IC, placement))
    A_G = [X[i] @ IC[i] @ tree.S[i] for i in range(len(X))]  # 49.10 A_G
    return CentroidalTerms(tuple(X), matrices(IC, tree.batch), np.concatenate(A_G, axis=-1))


def composite_center(tree: Tree, IC: list[Array], placement: list[SE3]) -> Array:
    """Return the centre of mass of all that moves, which the bodies next to the world carry: IC[i] holds m and m c."""
    first = [i for i in tree.outward if tree.parent[i] == 0]
    mass = {i: IC[i][..., 5, 5, None] for i in first}
    moment = {i: IC[i][..., [2, 0, 1], [4, 5, 3]] for i in first}  # out of m [c]×
    moments = [place_point(placement[i].rotation, mass[i] * placement[i].translation, moment[i]) for i in first]
    p_G: Array = np.sum(moments, axis=0) / sum(mass.values())
    return p_G


@also_of_mimics
def center_of_mass(model: Model, q: ArrayLike) -> Array:
    """Return the centre of mass p_G of everything that moves, in the world.

    The base link of a fixed base never moves and does not count (nor does it in Pinocchio).

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., 3)
        m.

    Raises
    ------
    SingularError
        If nothing that moves has mass.
    ShapeError, ValueError
        As `Model.state`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.center_of_mass(tw.load("pendulum"), [0.0])
    array([ 0.,  0., -1.])
    """
    (q,) = check_state(model, q)
    placement = placements(model.parent, joint_placements(model, q))
    return mean_center(model, placement, q, range(model.nbodies), model.name)


def mean_center(model: Model, placement: list[SE3], q: Array, bodies: Sequence[int], name: str) -> Array:
    """Return the centre of mass of some of the bodies, which have a name together; raise where they have no mass."""
    moment = np.zeros((*q.shape[:-1], 3), q.dtype)
    for i in bodies:
        T, inertia = placement[i], model.inertia[i]
        com = place_point(T.rotation, T.translation, convert(inertia.com, q.dtype))
        moment = moment + convert(inertia.mass, q.dtype) * com
    p_G: Array = moment / total_mass(model, q, bodies, name)  # 49.10 p_G
    return p_G


def total_mass(model: Model, q: Array, bodies: Sequence[int], name: str) -> Array:
    """Return the mass of some of the bodies, in q's number type; raise SingularError where it is zero."""
    if not any(model.inertia[i].mass for i in bodies):
        raise SingularError(f"centre of mass of {name!r}: nothing that moves has mass")
    return np.asarray(np.sum([convert(model.inertia[i].mass, q.dtype) for i in bodies]))


@also_of_mimics
def centroidal_map(model: Model, q: ArrayLike) -> Array:
    """Return the centroidal momentum matrix A_G(q): h_G = A_G v, by the CCRBA.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., 6, nv)
        Rows (angular, linear), at the centre of mass, in the axes of the world (Pinocchio's
        ``data.Ag`` has the linear rows first).

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `center_of_mass`.

    Notes
    -----
    Section 49.10; D. E. Orin, A. Goswami and S.-H. Lee, Centroidal dynamics of a humanoid robot,
    2013. A unit velocity of joint i moves its subtree as one rigid body. Column i is the momentum I^C S of this
    body, transformed to the centre of mass. Unlike `crba`, this has no loop from each joint to the base: O(N).

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.centroidal_map(model, model.standing())[3:, 3:6].round(12) + 0.0  # linear momentum of the base's motion
    array([[16.085,  0.   ,  0.   ],
           [ 0.   , 16.085,  0.   ],
           [ 0.   ,  0.   , 16.085]])
    """
    return centroidal_terms(model, q).A_G


def centroidal_terms(model: Model, q: ArrayLike) -> CentroidalTerms:
    """Return what the CCRBA computes on its way: transforms to the centre of mass, composite inertias, and A_G.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    CentroidalTerms
        X and IC for each body, and A_G.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `centroidal_map`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.centroidal_terms(model, model.standing()).IC[1][5, 5].round(3)  # with the joints locked, the whole mass
    np.float64(16.085)
    """
    (q,) = check_state(model, q)
    tree = tree_terms(model, q)
    total_mass(model, q, range(model.nbodies), model.name)  # raises where nothing that moves has mass
    return centroidal_composite(tree, placements_from_first_body(model, tree))


@also_of_mimics
def centroidal_momentum(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Return the momentum h_G = (k_G, l_G) at the centre of mass, in the axes of the world.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (..., 6)
        Angular momentum, kg m²/s, and linear momentum, kg m/s. Pinocchio's ``data.hg.vector`` has
        the linear part first.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `center_of_mass`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.centroidal_momentum(tw.load("pendulum"), [0.0], [2.0]).round(12) + 0.0  # a ball of 1 kg at 2 m/s
    array([ 0.   ,  0.002,  0.   , -2.   ,  0.   ,  0.   ])
    """
    q, v = check_state(model, q, v=v)
    tree = tree_terms(model, q)
    X, I = to_center_of_mass(model, tree, q), tree.I
    V, _ = motion(tree, columns(model, v), columns(model, np.zeros_like(v)))
    h_G: Array = np.sum([X[i] @ (I[i] @ V[i]) for i in range(model.nbodies)], axis=0)  # 49.10 h_G
    return h_G[..., 0]


@also_of_mimics
def centroidal_momentum_rate(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
    """Return ḣ_G = A_G a + Ȧ_G v, the rate of the centroidal momentum in a given motion.

    A matter of motion alone: at rest with a = 0 it is zero, whatever gravity and contacts do (the
    chapter expects the weight there). That it equals the wrench of all forces at G is Newton's and
    Euler's law.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (..., 6)
        N m and N.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `center_of_mass`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> free_fall = tw.aba(model, model.standing(), rest, rest)
    >>> tw.centroidal_momentum_rate(model, model.standing(), rest, free_fall)[5].round(3)  # −m g
    np.float64(-157.794)
    """
    q, v, a = check_state(model, q, v=v, a=a)
    tree = tree_terms(model, q)
    X, I = to_center_of_mass(model, tree, q), tree.I
    V, A = motion(tree, columns(model, v), columns(model, a))
    F = [I[i] @ A[i] + bias_wrench(I[i], V[i]) for i in range(model.nbodies)]  # 49.10 F
    rate: Array = np.sum([X[i] @ F[i] for i in range(model.nbodies)], axis=0)  # 49.10 rate
    return rate[..., 0]


def to_center_of_mass(model: Model, tree: Tree, q: Array) -> list[Array]:
    """Return for each body the X* that takes a wrench or momentum from its frame to G, world axes."""
    placement = placements_from_first_body(model, tree)
    return wrench_transforms(placement, mean_center(model, placement, q, range(model.nbodies), model.name))


def wrench_transforms(placement: list[SE3], p_G: Array) -> list[Array]:
    """Return for each placed body the X* that takes a wrench or momentum from its frame to a point, world axes."""
    return [SE3._trusted(T.rotation, T.translation - p_G).force_transform() for T in placement]  # 49.10 X


def placements_from_first_body(model: Model, tree: Tree) -> list[SE3]:
    """Return the placement of each body, in the world's axes but about the origin of the first body that moves.

    A lever p_i − p_G does not depend on where the robot stands. As the difference of two world coordinates it would
    lose digits with the distance from the world's origin: 1e-10 of A_G at 1000 km, in float32 1e-4 at 1 km (a Go2).
    """
    world, first = tree.placement[0], tree.placement[min(1, model.nbodies - 1)]  # the world itself where nothing moves
    about_first = SE3._trusted(world.rotation, -first.translation)
    return placements(model.parent, [about_first, *tree.placement[1:]])

"""Mass, centre, Jacobian, inertia and momentum of a part of the robot: a body and all that it carries (49.10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..model import Model, Tree, check_state, composite_inertias, joint_placements, tree_terms
from ..spatial import SE3
from .centroidal import mean_center, placements_from_first_body, total_mass
from .kinematics import placements
from .momentum_rate import total_inertia
from .terms import Subtree

__all__ = ["subtree", "subtree_momentum_map"]


def subtree_momentum_map(tree: Tree, X: list[Array], body: int) -> Array:
    """Return A_G of a body and all that it carries; X[i] takes a momentum from frame i to the subtree's centre.

    A joint outboard of the body moves what it carries itself, as in the CCRBA; a joint inboard of it, and the body's
    own, move the whole subtree as one; all others do not move it.
    """
    parent, S, IC = tree.parent, tree.S, composite_inertias(tree)
    A_G = [np.zeros_like(X[i] @ S[i]) for i in range(len(X))]
    for i in outboard(tree.parent, body):
        A_G[i] = X[i] @ IC[i] @ S[i]  # 49.10 A_sub: of what joint i carries
    whole, i = X[body] @ IC[body], body
    while i > 0:
        A_G[i] = whole @ S[i]  # 49.10 A_whole: of the whole subtree
        whole, i = whole @ tree.X[i], parent[i]
    return np.concatenate(A_G, axis=-1)


def outboard(parent: tuple[int, ...], body: int) -> list[int]:
    """Return the bodies that a body carries, and the body itself, in the order of their numbers."""
    carried = [body]
    for i in range(body + 1, len(parent)):
        if parent[i] in carried:
            carried.append(i)
    return carried


def subtree(model: Model, q: ArrayLike, frame: str) -> Subtree:
    """Return mass, centre of mass, Jacobian, inertia and momentum map of a body and all that it carries.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    frame : str
        A link or a joint. A welded link stands for the body that carries it, the root for the whole robot.

    Returns
    -------
    Subtree
        mass, center_of_mass, jacobian, inertia and momentum_map.

    Raises
    ------
    SingularError
        If the subtree has no mass.
    NameNotFound
        If the model has no such frame.
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Section 49.10. As in `center_of_mass`, what never moves does not count.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> leg = tw.subtree(model, model.standing(), "FL_hip")
    >>> leg.mass.round(3), leg.center_of_mass.round(3)
    (np.float64(2.202), array([0.172, 0.096, 0.237]))
    >>> leg.jacobian[:, 6].round(3) + 0.0  # velocity of its centre of mass as the hip turns at 1 rad/s
    array([0.   , 0.028, 0.05 ])
    """
    (q,) = check_state(model, q)
    body, tree = model.frame(frame).body, tree_terms(model, q)
    bodies = outboard(model.parent, body)
    mass = total_mass(model, q, bodies, frame)
    near = placements_from_first_body(model, tree)  # levers, which do not depend on where the robot stands
    center = mean_center(model, near, q, bodies, frame)
    X = [SE3._trusted(T.rotation, T.translation - center).force_transform() for T in near]
    A_G = subtree_momentum_map(tree, X, body)
    in_world = mean_center(model, placements(model.parent, joint_placements(model, q)), q, bodies, frame)
    return Subtree(mass, in_world, A_G[..., 3:, :] / mass, total_inertia(tree, X, bodies), A_G)

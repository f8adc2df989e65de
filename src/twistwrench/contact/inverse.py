"""Inverse dynamics under contact: which joint forces and contact forces make the robot move as it should (49.9).

The six base rows of M q̈ + h = Sᵀ τ + Jᵀ λ have no τ: they determine the total wrench of the contacts. Of all forces at
the contact points that exert it the least are chosen, without limits or within the friction cones; τ follows.
"""

from __future__ import annotations

from collections.abc import Iterable

from numpy.typing import ArrayLike

from ..arrays import as_flag
from ..errors import ShapeError, SingularError
from ..model import Model
from .limits import contact_limits
from .qp import least_breach, least_within
from .reach import NEAR
from .task import ContactForces, Task, passive_entries
from .types import Contact, Pyramid

__all__ = ["contact_inverse_dynamics", "friction_inverse_dynamics"]


def contact_inverse_dynamics(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    contacts: Iterable[Contact],
    f_ext: ArrayLike | None = None,
    *,
    motors: Iterable[str] | None = None,
) -> ContactForces:
    """Return the joint forces and the least contact forces of a motion: M a + h = Sᵀ τ + Jᵀ λ.

    Forces may pull, and friction is ignored. With a fixed base and a motor in each joint these do all, and λ = 0 is the
    least.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv)
    contacts : iterable of Contact
    f_ext : array_like, shape (..., nbodies, 6), optional
        Wrench (τ, f) on each body from outside, as `rnea`.
    motors : iterable of str, optional
        The joints that have one; in the others τ is zero, as at the hinges of a four-bar whose crank is driven. All but
        a floating base unless given.

    Returns
    -------
    ContactForces
        In double precision. The forces are the least at the contact points: of a sole, at its corners.

    Raises
    ------
    SingularError
        If no forces at these contacts make the base, or the joints without a motor, move so; the message gives the
        unbalanced part.
    NameNotFound, ShapeError, ValueError
        As `constraint_jacobian`; complex numbers.

    See Also
    --------
    twistwrench.friction_inverse_dynamics : the same within the friction cones.

    Notes
    -----
    Section 49.9. Moments and forces are weighed against each other by the inertia of the robot as one rigid body, so
    that no unit decides the rank.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest, feet = np.zeros(model.nv), [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> held = tw.contact_inverse_dynamics(model, model.standing(), rest, rest, feet)
    >>> sum(held.forces.values()).round(3) + 0.0
    array([  0.   ,   0.   , 157.794])
    """
    task = Task.of(model, q, v, a, contacts, f_ext, passive_entries(model, motors))
    return task.result(task.least, ())


def friction_inverse_dynamics(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    contacts: Iterable[Contact],
    f_ext: ArrayLike | None = None,
    *,
    sides: int = 8,
    pyramid: Pyramid = "inner",
    effort_limits: bool = False,
) -> ContactForces:
    """Return the joint forces and the least contact forces within the friction cones: a quadratic programme.

    No contact pulls, none slips, and the pressure on a sole stays within it. Quicker with the extra
    ``pip install "twistwrench[qp]"``, where the least forces alone are not within the limits.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
        One state.
    v, a : array_like, shape (nv,)
    contacts : iterable of Contact
    f_ext : array_like, shape (nbodies, 6), optional
    sides : int, optional
        Of the pyramids that stand for the cones, at least 3. An inner pyramid has its sides at cos(π/sides) of μ: at
        71 % with 4, at 92 % with 8, at 98 % with 16.
    pyramid : {"inner", "outer"}, optional
        Inner: forces that are found are within the cones. Outer: if none are found, none exist in the cones.
    effort_limits : bool, optional
        Keep each joint force within `Model.effort_limit`, too: contacts take what a motor cannot hold.

    Returns
    -------
    ContactForces
        In double precision.

    Raises
    ------
    SingularError
        If no forces within the limits make the robot move so; the message names the limits that are violated.
    NameNotFound, ShapeError, ValueError
        As `contact_inverse_dynamics`; a batch; less than 3 sides; a pyramid that is neither.

    Notes
    -----
    Sections 49.9 and 49.4. A motion is possible if forces within the limits miss the base's wrench by at most 1e-8 of
    it. Where they only just reach it, they are feasible forces, not the least.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> a, feet = np.zeros(model.nv), [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> a[3] = 5.0  # m/s², forwards
    >>> push = tw.friction_inverse_dynamics(model, model.standing(), 0 * a, a, feet)
    >>> bool(push.forces["RL_foot"][0] <= 0.6 * push.forces["RL_foot"][2])
    True
    """
    task = Task.of(model, q, v, a, contacts, f_ext)
    if task.least.ndim != 1:
        asked = "q, v, a" if f_ext is None else "q, v, a, f_ext"
        raise ShapeError(f"{asked}: expected one state, got a batch of shape {task.least.shape[:-1]}")
    effort_limits = as_flag(effort_limits, "effort_limits")
    motors = task.motors(model) if effort_limits else None
    rows, free = contact_limits(task.contacts, sides, pyramid), task.free
    rows = rows.join(motors) if motors else rows
    A, b = rows.A @ free, rows.b - rows.A @ task.least
    found = least_within(A, b, task.size)
    if found is not None:
        z, tight = found
        f = task.least + free @ z
    else:  # no forces, or barely some
        answer = task.reach(sides, pyramid, motors)
        if not answer.reached:
            worst = rows.breached(least_breach(A, b, task.size))
            raise SingularError(f"cannot: no forces within the limits do this; they would have to break {worst}")
        f, tight = answer.f, rows.A @ answer.f - rows.b > -NEAR * task.size
    binding = tuple(dict.fromkeys(name for name, leans in zip(rows.names, tight) if leans))
    return task.result(f, binding)

"""Inverse dynamics under contact: which joint forces and contact forces make the robot move as it should (49.9).

The six base rows of M q̈ + h = Sᵀ τ + Jᵀ λ have no τ: they determine the total wrench of the contacts. Of all forces at
the contact points that exert it the least are chosen, without limits or within the friction cones; τ follows.
"""

from __future__ import annotations

from collections.abc import Iterable

from numpy.typing import ArrayLike

from straightline.llvm import available

from ..algorithms.mimic import MimicModel
from ..arrays import as_flag
from ..errors import ShapeError, SingularError
from ..model import Model, check_model
from .qp import least_breach, least_within
from .rows import every_joint
from .task import TEXTBOOK_CALLS, WRENCH_RTOL, ContactForces, ContactProblem, contact_limits, passive_entries
from .types import Contact, Pyramid

__all__ = ["contact_inverse_dynamics", "friction_inverse_dynamics"]


def contact_inverse_dynamics(
    model: Model | MimicModel,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    contacts: Iterable[Contact],
    f_ext: ArrayLike | None = None,
    *,
    motors: Iterable[str] | None = None,
) -> ContactForces:
    """Return the joint forces and the least contact forces of a motion: M a + h = Sᵀ τ + Jᵀ λ.

    The contact forces may pull, and friction is ignored. If the base is fixed and each joint has a motor, the motors
    alone can make the motion, and the least contact forces are λ = 0.

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv)
    contacts : iterable of Contact
    f_ext : array_like, shape (..., nbodies, 6), optional
        Wrench (τ, f) on each body from outside, as `rnea`.
    motors : iterable of str, optional
        The joints that have a motor; in the others τ is zero, as at the hinges of a four-bar whose crank is driven.
        Unless given, all joints but a floating base have one.

    Returns
    -------
    ContactForces
        In double precision. Of all forces at the contact points (the corners of a sole), those with the least norm.

    Raises
    ------
    SingularError
        If no forces at these contacts give the base, or a joint without a motor, this acceleration; the message gives
        the part that is not balanced.
    NameNotFound, ShapeError, ValueError
        As `constraint_jacobian`; complex numbers.

    Notes
    -----
    Section 49.9. `twistwrench.friction_inverse_dynamics` does the same within the friction cones.

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
    every_joint(model)
    task = ContactProblem.of(model, q, v, a, contacts, f_ext, passive_entries(model, motors), textbook_calls())
    return task.result(task.least, ())


def friction_inverse_dynamics(
    model: Model | MimicModel,
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

    No contact pulls or slips, and the centre of pressure of a sole stays within the sole. If the least forces alone
    violate a limit, a solver is needed, and ``pip install "twistwrench[qp]"`` makes it faster.

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (nq,)
        One state.
    v, a : array_like, shape (nv,)
    contacts : iterable of Contact
    f_ext : array_like, shape (nbodies, 6), optional
    sides : int, optional
        The number of sides of the pyramids that approximate the cones, at least 3.
    pyramid : {"inner", "outer"}, optional
        Inner: if forces are found, they are within the cones. Outer: if no forces are found, the cones contain none.
    effort_limits : bool, optional
        Keep each joint force within `Model.effort_limit` as well: the contacts bear what a motor cannot.

    Returns
    -------
    ContactForces
        In double precision.

    Raises
    ------
    SingularError
        If no forces within the limits produce the motion; the message names the limits that are violated.
    NameNotFound, ShapeError, ValueError
        As `contact_inverse_dynamics`; for a batch, for less than 3 sides, or for another name of a pyramid.

    Notes
    -----
    Sections 49.9 and 49.4. A motion counts as possible if forces within the limits give the base's wrench to 1e-8.

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
    task = ContactProblem.of(model, q, v, a, contacts, f_ext, None, textbook_calls())
    if task.least.ndim != 1:
        asked = "q, v, a" if f_ext is None else "q, v, a, f_ext"
        raise ShapeError(f"{asked}: expected one state, got a batch of shape {task.least.shape[:-1]}")
    effort_limits = as_flag(effort_limits, "effort_limits")
    if effort_limits:
        check_model(model)  # of motors that move together it is open which one bears what
    motors = task.motors(model) if effort_limits else None  # type: ignore[arg-type]
    rows = contact_limits(task.contacts, sides, pyramid)
    free = task.free
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
        f = answer.f
        tight = rows.A @ answer.f - rows.b > -WRENCH_RTOL * task.size
    binding = tuple(dict.fromkeys(name for name, leans in zip(rows.names, tight) if leans))
    return task.result(f, binding)


def textbook_calls() -> int:
    """Return how often the textbook is asked first: never where machine code is made, which a loop waits for once."""
    return 0 if available() else TEXTBOOK_CALLS

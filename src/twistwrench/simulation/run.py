"""The loop over time, and its input validation."""

from __future__ import annotations

from collections.abc import Iterable
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_count, as_number
from ..contact import Contact
from ..contact.rows import as_contacts
from ..errors import SingularError, check_known
from ..model import Model
from .divergence import DivergenceError, refuse_divergence
from .methods import METHODS, Step
from .result import Simulation
from .scene_like import SceneLike, parts
from .system import Policy, System

__all__ = ["simulate"]

LONGEST = 1e60
"""Seconds: with a longer step products overflow."""


def simulate(
    robot: Model | SceneLike,
    q: ArrayLike,
    v: ArrayLike,
    *,
    dt: float,
    steps: int | None = None,
    duration: float | None = None,
    tau: Policy | ArrayLike | None = None,
    contacts: Iterable[Contact] = (),
    method: str = "rk4",
    progress: bool = False,
) -> Simulation:
    """Let a robot move from a state, and return its motion.

    There is no collision detection: a robot without contacts falls through the floor. Contacts stick where they are at
    t = 0, all the time: none opens, closes or slips, and they pull where they must: see `Simulation.contact_forces`.

    Parameters
    ----------
    robot : Model or Scene
        Of a scene the smallest model, its contacts and its wrenches.
    q : array_like, shape (..., nq)
        Configuration at t = 0. Leading axes are as many motions, side by side.
    v : array_like, shape (..., nv)
        Velocity at t = 0.
    dt : float
        Duration of a step, s.
    steps : int, optional
        How many of them; or else
    duration : float, optional
        the time at the end, s: a whole number of steps.
    tau : callable or array_like, shape (..., nv), optional
        Joint forces as `aba` takes them: a policy ``(t, q, v) -> tau``, which is called wherever the method needs
        the forces, or constant ones. Zero unless given.
    contacts : iterable of Contact, optional
        `PointContact` or `SurfaceContact`, besides those of a scene. After each step the state goes back to where they
        hold (`project_state`). Computed in double precision.
    method : {"euler", "semi-implicit", "midpoint", "rk4", "variational"}
        Of order 1, 1, 2, 4 and 2 in dt. "variational" holds the energy over long times and keeps the momenta that
        have a conservation law; it solves an equation in each step, and takes no contacts.
    progress : bool
        Whether to show a progress bar.

    Returns
    -------
    Simulation
        t, q, v, energy and momentum, τ and the forces at the contacts as they were applied; printed, how far energy and
        momentum changed.

    Raises
    ------
    DivergenceError
        If the motion leaves all bounds, or the equation of a variational step cannot be solved. The message names the
        time and the joint.
    SingularError
        As `aba` and `contact_forward_dynamics`, with the time.
    NameNotFound
        If there is no such method, or no frame of a contact.
    ShapeError, ValueError
        As `Model.state`; if `tau` is or returns anything but finite forces of that shape; if dt is not positive; if
        not one of `steps` and `duration` is given; if numbers are complex; if a contact moves at t = 0; if a
        variational method is asked for contacts.

    Notes
    -----
    Every method moves on the configuration manifold: q = q ⊕ u, so that quaternions need no repair, and Runge-Kutta
    methods keep their order on balls and floating bases by Munthe-Kaas' correction of u̇.

    Examples
    --------
    >>> import twistwrench as tw
    >>> pendulum = tw.load("pendulum")
    >>> print(tw.simulate(pendulum, [2.0], [0.0], dt=0.01, duration=10.0))
    pendulum by Runge-Kutta: 1000 steps to 10 s, 4000 evaluations
      energy changes by at most 1.51e-07 J, in the end by 4.78e-08 J
    >>> damped = tw.simulate(pendulum, [2.0], [0.0], dt=0.01, steps=100, tau=lambda t, q, v: -0.5 * v)
    >>> bool((np.diff(damped.energy) <= 0).all())
    True
    """
    model, own, push = parts(robot)
    check_known("method", method, METHODS)
    count = _count(dt, steps, duration)
    contacts = (*own, *as_contacts(model, contacts))
    q, v = model.state(q, v=v)
    if q.dtype.kind == "c":
        raise ValueError(f"q, v: expected real numbers, got {q.dtype}")
    if contacts:
        if not METHODS[method].contacts:
            raise ValueError(f"method: {method!r} takes no contacts, and there are {len(contacts)}")
        q, v = model.normalize(q.astype(np.float64)), v.astype(np.float64)
    system, step = System(model, contacts, push, tau, q, v, float(dt)), METHODS[method].step
    qs, vs = np.empty((count + 1, *q.shape), q.dtype), np.empty((count + 1, *v.shape), v.dtype)
    qs[0], vs[0], start = q, v, perf_counter()
    taus = np.empty((count, *v.shape), v.dtype)
    held: list[dict[str, Array]] = []
    for k in _bar(count, progress):
        system.begin()
        qs[k + 1], vs[k + 1] = _advance(step, system, k, qs[k].copy(), vs[k].copy())
        taus[k] = system.tau
        held.append(system.forces)
    t = np.arange(count + 1) * float(dt)
    if contacts:
        held.append(_at_the_end(system, float(t[-1]), qs[-1].copy(), vs[-1].copy()))
    forces = {c.frame: np.stack([at[c.frame] for at in held]) for c in contacts}
    return Simulation(system, method, t, qs, vs, taus, forces, system.evaluations, perf_counter() - start)


def _at_the_end(system: System, t: float, q: Array, v: Array) -> dict[str, Array]:
    """Return the forces at the contacts in the last state, from which no step begins."""
    try:
        return system.held(t, q, v).forces
    except SingularError as error:
        raise SingularError(f"the end, t = {t:.6g} s: {error}") from error


def _advance(step: Step, system: System, k: int, q: Array, v: Array) -> tuple[Array, Array]:
    """Make step k; where it fails, add the time to the error."""
    t = k * system.dt
    try:
        q, v = system.settle(*step(system, t, q, v))
        refuse_divergence(system.model, "v", v, dt=system.dt)
    except (DivergenceError, SingularError) as error:
        raise type(error)(f"step {k + 1}, from t = {t:.6g} s: {error}") from error
    return q, v


def _count(dt: float, steps: int | None, duration: float | None) -> int:
    """Return the number of steps; raise an error if it is not one."""
    if not 0 < as_number(dt, "dt") < LONGEST:
        raise ValueError(f"dt: expected a positive number of seconds, got {dt}")
    if steps is not None and duration is None:
        return as_count(steps, "steps", 0)
    if duration is None or steps is not None:
        raise ValueError(f"steps, duration: expected one of the two, got {steps} and {duration}")
    if not 0 <= as_number(duration, "duration") < np.inf:
        raise ValueError(f"duration: expected seconds, 0 or more, got {duration}")
    count = round(duration / dt)
    if abs(count * dt - duration) > 1e-9 * duration:
        whole = f"a whole number of steps of {dt} s"
        raise ValueError(f"duration: expected {whole}, got {duration} s, which is {duration / dt:.9g} of them")
    return count


def _bar(count: int, progress: bool) -> Iterable[int]:
    if not progress:
        return range(count)
    from tqdm import tqdm

    bar: Iterable[int] = tqdm(range(count), "simulate", unit="step")
    return bar

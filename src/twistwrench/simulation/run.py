"""The loop over time, and its input validation."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_count, as_number
from ..contact import Contact
from ..contact.rows import as_contacts
from ..errors import ShapeError, SingularError, check_known
from ..model import Model
from .diagnosis import divergence_cause
from .divergence import DivergenceError, check_divergence
from .ground import Ground, check_ground
from .methods import METHODS
from .mimics import simulate_following
from .result import Simulation
from .stepping import TimeStepping
from .system import Policy, SimulatedScene, System, parts

__all__ = ["simulate"]

Stop = Callable[[float, Array, Array], bool]
"""From time, q (..., nq) and v (..., nv) to whether the motion ends here."""

MAX_STEP_S = 1e60
"""Seconds: with a longer step products overflow."""
MAX_STEPS = 2**53
"""Beyond this, a float does not count one by one."""


def simulate(
    robot: Model | MimicModel | SimulatedScene,
    q: ArrayLike,
    v: ArrayLike,
    *,
    dt: float,
    steps: int | None = None,
    duration: float | None = None,
    t0: float = 0.0,
    tau: Policy | ArrayLike | None = None,
    dt_control: float | None = None,
    contacts: Iterable[Contact] = (),
    ground: Ground | None = None,
    method: str | None = None,
    stop: Stop | None = None,
    progress: bool = False,
) -> Simulation:
    """Compute the motion of a robot from a given state.

    With a ground, the contacts are points and soles that may touch it: they land, lift off, stick and slide, and the
    joints stay in their ranges. Constraints that can also pull (a loop, gears, a rail) hold all the time.

    Without a ground, each contact is fixed where it is at the start: it never opens or slips, and it may pull. See
    docs/simulation.md, also for the methods.

    Parameters
    ----------
    robot : Model, MimicModel or Scene
        For a scene, its smallest model is used, with its contacts and its wrenches. Where joints follow others, the
        full model moves with a `Coupling` for each of them; q, v and τ are those of the `MimicModel`.
    q : array_like, shape (..., nq)
        Configuration at t = 0. With leading axes, that many motions are computed side by side.
    v : array_like, shape (..., nv)
        Velocity at t = 0.
    dt : float
        Duration of a step, s.
    steps : int, optional
        The number of steps. Give either `steps` or `duration`.
    duration : float, optional
        Length of the motion, s: a whole number of steps.
    t0 : float, optional
        Time at the start, s. To continue another motion, give the time at its end.
    tau : callable or array_like, shape (..., nv), optional
        Joint forces as `aba` takes them: a policy ``(t, q, v) -> tau``, or constant ones. Zero unless given.
    dt_control : float, optional
        The period of the policy, a whole number of dt, s: the policy is called once at the beginning of each period.
    contacts : iterable of Contact
        Of any kind, in addition to those of a scene; with a ground, no planes that slide.
    ground : Ground, optional
        What the contacts may touch, each with its μ.
    method : {"rk4", "euler", "semi-implicit", "midpoint", "variational", "time-stepping"}, optional
        Their orders in dt are 4, 1, 1, 2, 2 and 1. "variational" conserves momenta, and takes no contacts.
        "time-stepping" is the method for a ground, and the only one that applies damping and friction of the joints
        and keeps their ranges. Default: "time-stepping" with a ground, "rk4" without one.
    stop : callable, optional
        ``(t, q, v) -> bool``, called after each step: the motion ends where it is true.
    progress : bool
        Whether to show a progress bar.

    Returns
    -------
    Simulation
        t, q, v, energy, momentum, τ and contact forces; ``print`` summarises them. If an error or Ctrl-C ends the
        motion, ``error.motion`` has the part that was computed.

    Raises
    ------
    DivergenceError
        If the motion grows without bound, or a step cannot be solved. The message names the time and the joint.
    SingularError
        As `aba` and `contact_forward_dynamics`, with the time.
    NameNotFound
        If there is no such method, or no frame of a contact.
    ShapeError, ValueError
        As `Model.state`; if an option is impossible or contradicts another one; if the state at the start violates
        the contacts, the ground or the ranges of the joints.
    TypeError
        If `ground` is not a Ground, or `stop` not a function.

    Examples
    --------
    >>> import twistwrench as tw
    >>> pendulum = tw.load("pendulum")
    >>> print(tw.simulate(pendulum, [2.0], [0.0], dt=0.01, duration=10.0))
    pendulum by Runge-Kutta: 1000 steps to 10 s, 4000 evaluations
      energy changes by at most 1.51e-07 J, in the end by 4.78e-08 J
      a step is off by up to 6.2e-10 in q, 9.6e-10 in v (of 5: see step_error)
    >>> damped = tw.simulate(pendulum, [2.0], [0.0], dt=0.01, steps=100, tau=lambda t, q, v: -0.5 * v)
    >>> bool((np.diff(damped.energy) <= 0).all())
    True

    A Go2 is dropped, and lands on its feet:

    >>> go2 = tw.load("go2")
    >>> q, feet = go2.standing(), [tw.PointContact(foot, 0.6) for foot in go2.feet]
    >>> q[2] += 0.1
    >>> drop = tw.simulate(go2, q, np.zeros(18), dt=0.002, duration=0.2, contacts=feet, ground=tw.Ground())
    >>> round(max(force[:, 2].max() for force in drop.contact_forces.values())) > 0
    True
    """
    if isinstance(robot, MimicModel):
        if method == "variational":
            raise ValueError("method: 'variational' takes no couplings, and joints that follow others are coupled")
        clock: dict[str, Any] = {"dt": dt, "steps": steps, "duration": duration, "t0": t0, "dt_control": dt_control}
        options: dict[str, Any] = {"ground": ground, "method": method, "progress": progress}
        given: dict[str, Any] = {"tau": tau, "contacts": contacts, "stop": stop}
        return simulate_following(simulate, robot, q, v, **given, **clock, **options)
    model, own, push = parts(robot)
    count = _count(dt, steps, duration)
    contacts = (*own, *as_contacts(model, contacts))
    name = _method(method, ground, contacts)
    q, v = model.state(q, v=v)
    if q.dtype.kind == "c":
        raise ValueError(f"q, v: expected real numbers, got {q.dtype}")
    if contacts or name == "time-stepping":
        q, v = model.normalize(q.astype(np.float64)), v.astype(np.float64)
    stepper = None
    may_touch = tuple(c for c in contacts if c.pushes)
    if name == "time-stepping":
        contacts = tuple(c for c in contacts if not c.pushes)
        stepper = TimeStepping(model, may_touch, ground or Ground(), float(dt), q, contacts, count)
    system = System(model, contacts, push, tau, q, v, float(dt), _period(dt_control, dt, tau), stepper)
    system.check_slip(q, v)
    start = perf_counter()
    if stop is not None and not callable(stop):
        raise TypeError(f"stop: expected a function (t, q, v) -> bool, got {type(stop).__name__}")
    made = Trajectory([(q, v)], [], [])
    t0 = float(as_number(t0, "t0"))

    try:
        _loop(made, system, name, t0, _bar(count, progress), stop)
    except (Exception, KeyboardInterrupt) as error:
        error.motion = _motion(made, system, name, t0, perf_counter() - start, failed=True)  # type: ignore[union-attr]
        raise
    return _motion(made, system, name, t0, perf_counter() - start)


def _motion(
    made: Trajectory, system: System, name: str, t0: float, seconds: float, *, failed: bool = False
) -> Simulation:
    """Return the motion until now."""
    qs, vs = (np.stack([state[i] for state in made.states]) for i in (0, 1))
    taus = np.array(made.taus[: len(vs) - 1], vs.dtype).reshape(len(vs) - 1, *vs.shape[1:])
    t = t0 + np.arange(len(vs)) * system.dt
    stepper = system.stepping
    forces = stepper.contact_forces(qs[:-1]) if stepper else made.forces(system, float(t[-1]), failed)
    return Simulation(system, name, t, qs, vs, taus, forces, system.evaluations, seconds)


@dataclass
class Trajectory:
    """States of a motion so far, and of each step τ and the forces of the contacts that stick."""

    states: list[tuple[Array, Array]]
    taus: list[Array]
    held: list[dict[str, Array]]

    def forces(self, system: System, t: float, failed: bool) -> dict[str, Array]:
        """Return the forces at the contacts over time; in the last state, at t, those under the last τ."""
        if not system.contacts or (failed and not self.held):
            return {}
        q, v = (x.copy() for x in self.states[-1])
        try:
            held = [*self.held, self.held[-1] if failed else system.held_last(t, q, v)][: len(self.states)]
        except SingularError as error:
            raise SingularError(f"the end, t = {t:.6g} s: {error}") from error
        return {c.frame: np.stack([at[c.frame] for at in held]) for c in system.contacts}


def _loop(made: Trajectory, system: System, method: str, t0: float, counter: Iterable[int], stop: Stop | None) -> None:
    """Make the steps; where one fails, add the time to the error, and what began it."""
    step = METHODS[method].step
    for k in counter:
        t, (q, v) = t0 + k * system.dt, (x.copy() for x in made.states[-1])
        try:
            system.begin_step(k, t, q, v)
            q, v = system.project(t + system.dt, *step(system, t, q, v))
            check_divergence(system.model, "v", v, dt=system.dt)
        except (DivergenceError, SingularError) as error:
            reason = divergence_cause(system, method, t0, made.states)
            text = f"{error}{' ' if str(error).endswith('?') else '; '}{reason}" if reason else error
            raise type(error)(f"step {k + 1}, from t = {t:.6g} s: {text}") from error
        made.taus.append(system.tau)
        made.held.append(system.forces)
        made.states.append((q, v))  # last: where the motion is interrupted, so many states count
        if stop is not None:
            ends = stop(t + system.dt, q.copy(), v.copy())
            if np.ndim(ends):
                raise ShapeError(f"stop(t, q, v): expected one bool for all motions, got shape {np.shape(ends)}")
            if ends:
                break


def _method(method: str | None, ground: Ground | None, contacts: Sequence[Contact]) -> str:
    """Return the name of the method; raise an error where it does not take what is there."""
    if ground is not None and not isinstance(ground, Ground):
        raise TypeError(f"ground: expected a Ground, got {type(ground).__name__}")
    name = ("rk4" if ground is None else "time-stepping") if method is None else method
    check_known("method", name, METHODS)
    if ground is not None:
        if name != "time-stepping":
            raise ValueError(f"method: {name!r} takes no ground; leave it out, or expected 'time-stepping'")
        check_ground(contacts, ground)
    elif name == "time-stepping" and any(c.pushes for c in contacts):
        raise ValueError(f"method: {name!r} takes no contacts without a ground but loops, couplings and rails")
    elif contacts and not METHODS[name].contacts and name != "time-stepping":
        raise ValueError(f"method: {name!r} takes no contacts, and there are {len(contacts)}")
    return name


def _period(dt_control: float | None, dt: float, tau: object) -> int:
    """Return the period of the policy in steps; 0 if it has none."""
    if dt_control is None:
        return 0
    if not 0 < as_number(dt_control, "dt_control") < MAX_STEP_S:
        raise ValueError(f"dt_control: expected a positive number of seconds, got {dt_control}")
    if not callable(tau):
        raise ValueError("dt_control: there is no policy that could be called: tau is not a function")
    period = round(dt_control / dt)
    if period < 1 or abs(period * dt - dt_control) > 1e-9 * dt_control:
        raise ValueError(f"dt_control: expected a whole number of steps of {dt} s, got {dt_control} s")
    return period


def _count(dt: float, steps: int | None, duration: float | None) -> int:
    """Return the number of steps; raise an error if it is not one."""
    if not 0 < as_number(dt, "dt") < MAX_STEP_S:
        raise ValueError(f"dt: expected a positive number of seconds, got {dt}")
    if steps is not None and duration is None:
        return as_count(steps, "steps", 0)
    if duration is None or steps is not None:
        raise ValueError(f"steps, duration: expected one of the two, got {steps} and {duration}")
    if not 0 <= as_number(duration, "duration") < MAX_STEPS * dt:
        raise ValueError(f"duration: expected seconds, 0 or more and less than 2**53 steps, got {duration}")
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

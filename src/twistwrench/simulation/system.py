"""What a method needs of the mechanics: the forces of the policy, the contacts, and the acceleration that follows."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array
from ..contact import (
    Contact,
    ContactDynamics,
    constraint_jacobian,
    contact_forward_dynamics,
    contact_placements,
    project_state,
)
from ..contact.rows import given_motion, moved, moved_anchors
from ..errors import ShapeError, no_model
from ..fast import aba, rnea
from ..model import Model
from .divergence import check_divergence
from .stepping import TimeStepping

__all__ = ["Policy", "Push", "SimulatedScene", "System", "parts"]

Policy = Callable[[float, Array, Array], ArrayLike]
"""From time, q (..., nq) and v (..., nv) to joint forces (..., nv)."""

Push = Callable[[Array], Array]
"""From q (..., nq) to wrenches on the bodies (..., nbodies, 6)."""

SLIP_RTOL = 1e-9
"""How fast a contact that sticks may move at the start, relative to the fastest motion."""


class SimulatedScene(Protocol):
    """What `simulate` needs of a scene, which comes later in the order of the rooms: model, contacts, wrenches."""

    model: Model
    contacts: tuple[Contact, ...]

    @abstractmethod
    def f_ext(self, q: ArrayLike) -> Array:
        """Return the wrenches on the bodies in a configuration, shape (..., nbodies, 6)."""


def parts(robot: Model | SimulatedScene) -> tuple[Model, tuple[Contact, ...], Push | None]:
    """Return the model, the contacts and the wrenches of a scene; of a model alone, only the model."""
    if isinstance(robot, Model):
        return robot, (), None
    if not hasattr(robot, "f_ext"):
        raise no_model(robot, "robot", "a Model or a Scene")
    return robot.model, robot.contacts, robot.f_ext


class System:
    """A model that moves under a policy, wrenches and contacts.

    Parameters
    ----------
    model : Model
    contacts : tuple of Contact
        They stick where they are in q; with `stepping`, what holds besides what may touch.
    push : callable, optional
        From q to wrenches on the bodies from outside, shape (..., nbodies, 6).
    tau : callable, array_like or None
        As in `simulate`.
    q, v : ndarray, shapes (..., nq) and (..., nv)
        The state at the start.
    dt : float
        Duration of a step, s.
    period : int, optional
        The policy is called at the beginning of each so many steps, and its forces hold until then; 0: wherever the
        method needs them.
    stepping : TimeStepping, optional
        What may touch, for the method that steps with it.

    Attributes
    ----------
    evaluations : int
        How often the forces were computed.
    tau : ndarray, shape (..., nv)
        The joint forces that count for the step being made: those of its first evaluation, or where a method looks for
        them, of its last.
    forces : dict of str to ndarray
        λ of that evaluation, by the contact's frame.
    """

    def __init__(
        self,
        model: Model,
        contacts: tuple[Contact, ...],
        push: Push | None,
        tau: Policy | ArrayLike | None,
        q: Array,
        v: Array,
        dt: float,
        period: int = 0,
        stepping: TimeStepping | None = None,
    ) -> None:
        self.model = model
        self.contacts = contacts
        self.push = push
        self.dt = dt
        self.evaluations = 0
        self.period, self.stepping = period, stepping
        self.anchors = contact_placements(model, q, contacts)
        self._policy = tau if callable(tau) else None
        constant = np.zeros_like(v) if tau is None or callable(tau) else self._checked("tau", tau, v)
        self._constant = self.tau = np.broadcast_to(constant, v.shape).copy()
        self.forces: dict[str, Array] = {}
        self._first, self._start = True, 0.0
        self._policy_missing = False

    def __getstate__(self) -> dict[str, object]:
        """Leave the policy behind: a lambda cannot be pickled, and a motion is worth as much without it."""
        needed = self._policy is not None and not self.period
        return vars(self) | {"_policy": None, "_policy_missing": self._policy_missing or needed}

    def begin_step(self, k: int, t: float, q: Array, v: Array) -> None:
        """Begin step k: what is evaluated next counts. At the beginning of a period, call the policy."""
        self._first = True
        self._start = t if k == 0 else self._start
        if self.period and k % self.period == 0:
            self._constant = self.policy_forces(t, q, v)

    def time_since_start(self, t: float) -> float:
        """Return the time since the start, s."""
        return t - self._start

    def force(self, t: float, q: Array, v: Array) -> Array:
        """Return the generalized forces of policy and external wrenches in a state: τ + Σ Jᵀ f, shape (..., nv)."""
        self.evaluations += 1
        tau = self._constant if self.period else self.policy_forces(t, q, v)
        if self._first:
            self.tau = np.broadcast_to(tau, v.shape).copy()
        return self._with_push(tau, q, v)

    def _with_push(self, tau: Array, q: Array, v: Array) -> Array:
        """Return τ and the generalized forces of the wrenches from outside."""
        if self.push is None:
            return np.broadcast_to(tau, v.shape)
        rest = np.zeros_like(v)
        return tau + rnea(self.model, q, rest, rest) - rnea(self.model, q, rest, rest, self.push(q))

    def policy_forces(self, t: float, q: Array, v: Array) -> Array:
        """Return what the policy returns in a state, or the constant forces."""
        if self._policy is None:
            return self._constant
        for x in (q, v):
            x.flags.writeable = False  # a policy cannot change the state in place
        return self._checked("tau(t, q, v)", self._policy(t, q, v), v, f" at t = {t:.6g}")

    def acceleration(self, t: float, q: Array, v: Array) -> Array:
        """Return the acceleration in a state, shape (..., nv) (49.7)."""
        check_divergence(self.model, "v", v, dt=self.dt)
        if self.contacts:
            return self.held(t, q, v).qdd
        tau = self.force(t, q, v)
        self._first = False
        return aba(self.model, q, v, tau)

    def held(self, t: float, q: Array, v: Array) -> ContactDynamics:
        """Return acceleration and contact forces in a state (49.9)."""
        found = self._held_under(self.force(t, q, v), t, q, v)
        if self._first:
            self.forces = found.forces
            self._first = False
        return found

    def held_last(self, t: float, q: Array, v: Array) -> dict[str, Array]:
        """Return the contact forces in a state under the last forces that were applied."""
        self.evaluations += 1
        return self._held_under(self._with_push(self.tau, q, v), t, q, v).forces

    def _held_under(self, force: Array, t: float, q: Array, v: Array) -> ContactDynamics:
        contacts = moved(self.contacts, self.time_since_start(t))
        return contact_forward_dynamics(self.model, q, v, force, contacts)

    def two_half_steps(
        self,
        t: float,
        q: Array,
        v: Array,
        tau: Array,
        step: Callable[[System, float, Array, Array], tuple[Array, Array]],
    ) -> tuple[Array, Array]:
        """Return the state after a step from t, q and v, made in two halves as the step was made.

        The policy is asked again, wherever the method needs it; forces that were held for a period are held again.

        Raises
        ------
        ValueError
            If there was a policy, and it stayed in the process in which the motion was made.
        """
        if self._policy_missing:
            raise ValueError("step_error: the policy has stayed in the process in which the motion was made")
        dt = self.dt / 2
        own = self.stepping
        forces = tau if self._policy is None or self.period else self._policy
        contacts = moved(self.contacts, self.time_since_start(t))
        stepping = own and TimeStepping(self.model, own.contacts, own.ground, dt, q, contacts)
        there = System(self.model, contacts, self.push, forces, q, v, dt, stepping=stepping)
        for k in range(2):
            at = t + k * dt
            there.begin_step(k, at, q, v)
            q, v = there.project(at + dt, *step(there, at, q.copy(), v.copy()))
        return q, v

    def project(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        """Return the nearby state in which the contacts are where they stick, and move as what they stick to."""
        if not self.contacts or self.stepping is not None:
            return q, v
        since = self.time_since_start(t)
        anchors = moved_anchors(self.model, self.contacts, self.anchors, since)
        return project_state(self.model, q, v, moved(self.contacts, since), anchors)

    def check_travel(self, u: Array) -> None:
        """Raise for a step u that no robot goes."""
        check_divergence(self.model, "v dt", u)

    def check_slip(self, q: Array, v: Array) -> None:
        """Raise for a contact that sticks and moves at the start."""
        for contact in self.contacts:
            rates = np.matvec(constraint_jacobian(self.model, q, [contact]), v) - given_motion([contact], "velocity")
            slip = np.abs(rates).max(initial=0)
            if slip > SLIP_RTOL * np.abs(v).max(initial=1):
                raise ValueError(
                    f"v: contact {contact.frame!r} sticks, but slips at t = 0 (up to {slip:.3g} m/s or rad/s); "
                    "twistwrench.impact gives the velocity after it has closed"
                )

    def _checked(self, name: str, tau: ArrayLike, v: Array, when: str = "") -> Array:
        """Return joint forces in the number type of v; raise an error if they are not such."""
        try:
            checked = as_array(tau, name)
        except ValueError as error:
            raise type(error)(f"{error}{when}") from None
        if checked.dtype.kind == "c":
            raise ValueError(f"{name}: expected real numbers, got {checked.dtype}{when}")
        if checked.shape not in (v.shape, v.shape[-1:]):
            hint = ""
            floats = self.model.base == "floating"
            if floats and checked.shape[-1:] == (self.model.nv - 6,):
                hint = "; the six entries of the floating base come first: zeros, as it has no motor"
            raise ShapeError(f"{name}: expected shape {v.shape}, got {checked.shape}{when}{hint}")
        return checked.astype(v.dtype, copy=False)

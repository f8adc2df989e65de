"""What a simulation returns: the motion, and what it is worth.

A remark is the first time that a robot did what a real one would not, or that a foot lost the ground.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..algorithms.centroidal import center_of_mass, centroidal_momentum
from ..algorithms.energy import kinetic_energy, potential_energy
from ..algorithms.kinematics import forward_kinematics, frame_placement
from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_count
from ..contact import Contact, PointContact, SphereContact, SurfaceContact, WheelContact
from ..errors import check_known
from ..model import Model
from .methods import METHODS
from .remark import Remark
from .stepping import TimeStepping
from .system import System

__all__ = ["Simulation", "contact_remarks", "ground_remarks", "joint_remarks", "neglect_remarks"]

PRINTED_SAMPLES = 5
"""Steps that are made again where a motion is printed."""

AXIS_LABELS = {
    "energy": "change of the energy [J]",
    "angular momentum": "change of the angular momentum [kg m²/s]",
    "q": "q [rad, m]",
    "v": "v [rad/s, m/s]",
}

REMARK_RTOL = 1e-9
"""Relative to what is allowed, or in rad and m: rounding stays below."""

FOOT_SIZE_M = 1e-3
"""m: what is less far below the contacts may be a foot's own size."""

MIN_SLIDE_M_PER_S = 1e-3
"""m/s: how fast a point that touches slides at least."""

COULOMB_RTOL = 1e-3
"""Relative to the fastest point: how far a step may miss Coulomb's law before it is said."""

ENERGY_RTOL = 0.02
"""Relative to the largest kinetic energy and what the motors moved: how much energy may come of the steps alone."""

ALTERNATIONS = 8
"""So many changes of v in a row with opposite signs are no motion but gains that are too high for the step."""

ALTERNATION_GROWTH = 4.0
"""The last of them is at least so many times the first."""

MIN_ALTERNATION = 5.0
"""rad/s or m/s: the last of them is larger."""


@dataclass(frozen=True, eq=False, repr=False)
class Simulation:
    """A motion, as `simulate` returns it. The n states are those at the start and after each step.

    Attributes
    ----------
    system : System
        What moved: model, policy and contacts.
    method : str
        Its name in the registry of methods.
    t : ndarray, shape (n,)
        Times, s.
    q : ndarray, shape (n, ..., nq)
    v : ndarray, shape (n, ..., nv)
    tau : ndarray, shape (n − 1, ..., nv)
        The joint forces of each step: those of its first evaluation, at the state where it begins; of a variational
        step those in its middle.
    contact_forces : dict of str to ndarray, shape (n, ..., 3) or (n, ..., 6)
        Forces on the robot by the contact's frame, axes of the world, (τ, f) of a surface: those that went with `tau`,
        and in the last state those under the last `tau`. With a ground, of each of the n − 1 steps the mean over it.
        Empty without contacts.
    evaluations : int
        How often forces and accelerations were computed.
    seconds : float
        How long it took.
    follows : MimicModel, optional
        Where joints follow others: q, v and τ are this model's, and `system` is the full robot's.
    """

    system: System
    method: str
    t: Array
    q: Array
    v: Array
    tau: Array
    contact_forces: dict[str, Array]
    evaluations: int
    seconds: float
    follows: MimicModel | None = None

    @property
    def model(self) -> Model | MimicModel:
        """The model that moved; of a scene the smallest one."""
        return self.system.model if self.follows is None else self.follows

    @cached_property
    def full(self) -> tuple[Array, Array, Array]:
        """q, v and τ of all joints, those that follow others included."""
        if self.follows is None:
            return self.q, self.v, self.tau
        q, v = self.follows.expand(self.q, self.v)
        tau = np.zeros((*self.tau.shape[:-1], v.shape[-1]), self.tau.dtype)
        own = [self.follows.full.v_slice[self.follows.full.joint_id(name)] for name in self.follows.joint_names[1:]]
        tau[..., np.r_[tuple(own)]] = self.tau
        return q, v, tau

    @cached_property
    def energy(self) -> Array:
        """Kinetic and potential energy, shape (n, ...), J."""
        total: Array = self._kinetic_energy + potential_energy(self.system.model, self.full[0])
        return total

    @cached_property
    def _kinetic_energy(self) -> Array:
        q, v, _ = self.full
        return np.asarray(kinetic_energy(self.system.model, q, v))

    @cached_property
    def momentum(self) -> Array:
        """Angular and linear momentum (k_G, l_G) at the centre of mass, axes of the world, shape (n, ..., 6)."""
        return centroidal_momentum(self.system.model, *self.full[:2])

    @cached_property
    def momentum_about_origin(self) -> Array:
        """Angular momentum about the world's origin, and linear momentum, shape (n, ..., 6): k_G + p_G × l_G, l_G."""
        k, l = self.momentum[..., :3], self.momentum[..., 3:]
        return np.concatenate([k + np.cross(center_of_mass(self.system.model, self.full[0]), l), l], axis=-1)

    @cached_property
    def work(self) -> Array:
        """Work of the joint forces τ since the start, shape (n, ...), J: of each step τ times the mean v."""
        power = (self.tau * (self.v[1:] + self.v[:-1])).sum(axis=-1) / 2
        start = np.zeros((1, *power.shape[1:]), power.dtype)
        return np.concatenate([start, np.cumsum(power * self.system.dt, axis=0)])

    @cached_property
    def remarks(self) -> tuple[Remark, ...]:
        """Remarks on what a real robot would not have done, or not unnoticed, the first time of each, in time order.

        A contact that sticks and pulls, would slip or tip; a body below all contacts; a joint beyond its range or its
        speed, or whose velocity alternates and grows; a motor beyond its limit; on a ground, a contact that leaves it
        or slides, and energy from nowhere; damping and friction of a joint, which only time stepping applies.
        """
        system, stepping, model, (q, v, tau) = self.system, self.system.stepping, self.system.model, self.full
        clock = slice(None, None, max(system.period, 1))
        over_time = (x[clock] for x in (self.t, v, tau))
        found = [*joint_remarks(model, self.t, q, v, tau), *alternation_remarks(model, *over_time)]
        if self.contact_forces and stepping is None:
            found += contact_remarks(model, self.t, q, system.contacts, self.contact_forces)
        found += neglect_remarks(model, self.t, v) if stepping is None else ground_remarks(stepping, self.t)
        if stepping is not None and not stepping.is_driven() and system.push is None:
            most = ENERGY_RTOL * np.abs(np.diff(self.work, axis=0)).sum(axis=0)
            most = most + energy_of_steps(model, self._kinetic_energy.max(axis=0), system.dt)
            found += energy_remarks(model.name, self.t, self.energy - self.work, most)
        return tuple(sorted(found))

    def step_error(self, samples: int = 20) -> tuple[float, float]:
        """Return how far one step is off, from the difference to the same step made as two halves.

        With a method of order p a step is off by c dt^(p + 1) and two halves by 2⁻ᵖ of it, so that the difference is
        1 − 2⁻ᵖ of the error of the step (L. F. Richardson, 1911).

        Parameters
        ----------
        samples : int
            So many steps are made again, evenly over the motion, as they were made: a policy is asked again wherever
            the method needs it, and forces that were held for `dt_control` are held.

        Returns
        -------
        tuple of float
            Of q in rad or m, and of v in rad/s or m/s. It is what a step adds to the error, not the error at the end;
            where something hits within the step, the whole impact.

        Raises
        ------
        ValueError
            If the motion was made under a policy in another process, where the policy has stayed.

        Examples
        --------
        >>> import twistwrench as tw
        >>> motion = tw.simulate(tw.load("pendulum"), [2.0], [0.0], dt=0.01, duration=1.0)
        >>> max(motion.step_error()) < 2e-9
        True
        """
        count = min(as_count(samples, "samples", 1), len(self.tau))
        worst, (q, v, tau) = np.zeros(2), self.full
        for k in np.unique(np.linspace(0, len(self.tau) - 1, count).astype(int)) if count else ():
            half = self.system.two_half_steps(float(self.t[k]), q[k], v[k], tau[k], METHODS[self.method].step)
            whole = self.system.model.difference(q[k + 1], half[0]), v[k + 1] - half[1]
            worst = np.maximum(worst, [np.abs(x).max(initial=0) for x in whole])
        worst = worst / (1 - 2.0 ** -METHODS[self.method].order)
        return float(worst[0]), float(worst[1])

    def __repr__(self) -> str:
        batch = "" if self.q.ndim == 2 else f", a batch of {self.q.shape[1:-1]}"
        made = f"{len(self.t) - 1} steps to {self.t[-1]:.6g} s{batch}"
        lines = [f"{self.model.name} by {METHODS[self.method].title}: {made}, {self.evaluations} evaluations"]
        rows = [("energy", "J", self.energy[..., None])]
        if self.model.base == "floating":
            moved = self.system.model
            fall = moved.mass * np.multiply.outer(self.t, moved.gravity)
            fall = fall.reshape(len(self.t), *(1,) * (self.q.ndim - 2), 3)
            rows += [
                ("angular momentum at the centre of mass", "kg m²/s", self.momentum[..., :3]),
                ("linear momentum, without the weight's,", "kg m/s", self.momentum[..., 3:] - fall),
            ]
        for name, unit, x in rows:
            change = np.sqrt(((x - x[0]) ** 2).sum(axis=-1))
            largest, last = (y.max(initial=0) for y in (change, change[-1]))
            lines.append(f"  {name} changes by at most {largest:.2e} {unit}, in the end by {last:.2e} {unit}")
        if self.tau.any() and not batch:
            lines.append(f"  the joint forces put in {self.work[-1]:.3g} J")
        if self.system.stepping is not None and self.system.stepping.contacts:
            missed = np.max(self.system.stepping.missed, initial=0)
            lines.append(f"  no contact pulls or leaves its cone; Coulomb's law is missed by at most {missed:.1e} m/s")
        lines += self._step_error_line()
        kinds: dict[str, list[Remark]] = {}
        for remark in self.remarks:
            kinds.setdefault(remark.kind, []).append(remark)
        lines += [f"  {same[0]}" + f" ({len(same) - 1} more)" * (len(same) > 1) for same in kinds.values()]
        return "\n".join(lines)

    def _step_error_line(self) -> list[str]:
        """Return what is printed of the error of a step; nothing without a step, or where it cannot be made again."""
        if not len(self.tau):
            return []
        try:
            dq, dv = self.step_error(PRINTED_SAMPLES)
        except Exception:  # half a step fails, or the policy, which may raise anything, or is in another process
            return []
        return [f"  a step is off by up to {dq:.1e} in q, {dv:.1e} in v (of {PRINTED_SAMPLES}: see step_error)"]

    def plot(self, ax: Any = None, *, what: str = "energy") -> Any:
        """Draw a quantity over time; of a batch, of every item.

        Parameters
        ----------
        ax : matplotlib Axes, optional
        what : {"energy", "angular momentum", "q", "v"}
            Of the first two, the change.

        Returns
        -------
        matplotlib Axes

        Raises
        ------
        NameNotFound
            If `what` is not one of these.
        """
        check_known("quantity", what, AXIS_LABELS)
        from ..plot.style import axes_2d

        ax = axes_2d(ax)
        if what in ("q", "v"):
            drawn = self.q if what == "q" else self.v
        else:
            total = self.energy if what == "energy" else self.momentum[..., :3]
            drawn = total - total[0]
        ax.plot(self.t, drawn.reshape(len(self.t), -1))
        ax.set(xlabel="time [s]", ylabel=AXIS_LABELS[what])
        return ax


def first_excess(
    t: Array, kind: str, name: str, value: Array, limit: Array | float, sign: float = 1.0
) -> Iterator[Remark]:
    """Yield the first time that values, time first, are above a limit, or with the sign −1 below it."""
    limit = np.broadcast_to(limit, value.shape)
    over = sign * (value - limit) > REMARK_RTOL * np.maximum(1, np.abs(limit))
    if over.any():
        k = tuple(int(i) for i in np.argwhere(over)[0])
        yield Remark(float(t[k[0]]), kind, name, float(value[k]), float(limit[k]))


def joint_remarks(model: Model, t: Array, q: Array, v: Array, tau: Array) -> Iterator[Remark]:
    """Yield the joints that left their ranges, or were faster or stronger than they can be."""
    for name, joint, at_q, at_v in zip(model.joint_names, model.joints, model.q_slice, model.v_slice):
        if joint is None:
            continue
        if joint.nq == joint.nv:
            yield from first_excess(t, "range", name, q[..., at_q], model.upper[at_q])
            yield from first_excess(t, "range", name, q[..., at_q], model.lower[at_q], -1.0)
        yield from first_excess(t, "speed", name, np.abs(v[..., at_v]), model.velocity_limit[at_v])
        yield from first_excess(t, "effort", name, np.abs(tau[..., at_v]), model.effort_limit[at_v])


def alternation_remarks(model: Model, t: Array, v: Array, tau: Array) -> Iterator[Remark]:
    """Yield the joints whose velocity changes its way in each step, under other forces, and each time by more."""
    change = np.diff(v, axis=0)
    if len(change) <= ALTERNATIONS:
        return
    turns = (change[1:] * change[:-1] < 0) & (np.diff(tau[: len(change)], axis=0) != 0)
    runs = np.lib.stride_tricks.sliding_window_view(turns, ALTERNATIONS, axis=0).all(axis=-1)
    begins, ends = np.abs(change[:-ALTERNATIONS]), np.abs(change[ALTERNATIONS:])
    found = np.where(runs & (ends > ALTERNATION_GROWTH * begins) & (ends > MIN_ALTERNATION), ends, 0.0)
    for name, joint, at in zip(model.joint_names, model.joints, model.v_slice):
        if joint is not None:
            yield from first_excess(t, "alternates", name, found[..., at], 0.0)


def energy_of_steps(model: Model, kinetic: Array, dt: float) -> Array:
    """Return what steps may add of themselves: a share of the kinetic energy, and ½ m g v dt where something rises."""
    g = float(np.sqrt(model.gravity @ model.gravity))
    return np.asarray(ENERGY_RTOL * kinetic + dt / 2 * g * np.sqrt(2 * model.mass * kinetic))


def energy_remarks(name: str, t: Array, own: Array, most: Array) -> Iterator[Remark]:
    """Yield the first time that a robot has more energy of its own, without its motors' work, than it had before."""
    yield from first_excess(t, "energy", name, own - np.minimum.accumulate(own, axis=0), most)


def neglect_remarks(model: Model, t: Array, v: Array) -> Iterator[Remark]:
    """Yield the joints that moved as if they had no damping or no dry friction, which the file gives them."""
    for name, joint, at in zip(model.joint_names, model.joints, model.v_slice):
        if joint is not None:
            braked = model.damping[at] * np.abs(v[..., at]), model.friction[at] * (v[..., at] != 0)
            for kind, value in zip(("damping", "friction"), braked):
                yield from (r._replace(value=float(value.max())) for r in first_excess(t, kind, name, value, 0.0))


def contact_remarks(
    model: Model, t: Array, q: Array, contacts: Sequence[Contact], forces: dict[str, Array]
) -> Iterator[Remark]:
    """Yield the contacts that stick and pulled, or would have slipped or tipped, and the bodies that sank below all.

    A sole would tip where its centre of pressure leaves it. Of others, such as loops, nothing is said.
    """
    contacts = [c for c in contacts if isinstance(c, PointContact | SphereContact | SurfaceContact | WheelContact)]
    for c in contacts:
        axes = c.axes(frame_placement(model, q, c.frame).rotation)
        wrench = np.zeros((*q.shape[:-1], 6))
        wrench[..., c.rows] = forces[c.frame]
        f = np.matvec(axes.mT, wrench[..., 3:])
        moment = np.abs(np.matvec(axes.mT, wrench[..., :3]))
        loose = REMARK_RTOL * np.abs(f).max(initial=0)
        pressed = np.maximum(f[..., 2], 0)
        yield from first_excess(t, "pull", c.frame, -f[..., 2], loose)
        yield from first_excess(t, "slip", c.frame, np.hypot(f[..., 0], f[..., 1]), c.mu * pressed + loose)
        if isinstance(c, SurfaceContact):
            for axis, half in ((1, c.half_size[0]), (0, c.half_size[1])):
                yield from first_excess(t, "tip", c.frame, moment[..., axis], half * pressed + loose)
    if contacts and not any(c.velocity or c.acceleration for c in contacts):
        feet = [frame_placement(model, q[0], c.frame).translation[..., 2] for c in contacts]
        floor = np.min(feet, axis=0) - FOOT_SIZE_M
        bodies = forward_kinematics(model, q).placement[1:]
        if all((T.translation[0, ..., 2] >= floor).all() for T in bodies):
            for name, T in zip(model.joint_names[1:], bodies):
                yield from first_excess(t, "sunk", name, T.translation[..., 2], floor, -1.0)


def ground_remarks(stepping: TimeStepping, t: Array) -> Iterator[Remark]:
    """Yield the contacts on a ground that left it after they had touched it, slid on it, or missed Coulomb's law."""
    force = np.array(stepping.forces)
    slides = np.array(stepping.slides)
    end = 0
    missed = np.array(stepping.missed)
    most = COULOMB_RTOL * np.array(stepping.fastest)
    for c in stepping.contacts if len(force) else ():
        points = slice(end, end := end + len(c.points))
        touches = (force[..., points, 2] > 0).any(axis=-1)
        left = np.maximum.accumulate(touches, axis=0) & ~touches
        yield from first_excess(t, "lift-off", c.frame, left.astype(float), 0.0)
        yield from first_excess(t, "slide", c.frame, slides[..., points].max(axis=-1), MIN_SLIDE_M_PER_S)
        yield from first_excess(t, "coulomb", c.frame, missed[..., points].max(axis=-1), most)

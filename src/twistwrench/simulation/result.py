"""What a simulation returns."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..algorithms.centroidal import center_of_mass, centroidal_momentum
from ..algorithms.energy import kinetic_energy, potential_energy
from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_count
from ..errors import check_known
from ..model import Model
from .methods import METHODS
from .remarks import Remark, of_alternation, of_contacts, of_ground, of_joints, of_left_out
from .system import System

__all__ = ["Simulation"]

ASKED = 5
"""Steps that are made again where a motion is printed."""

LABELS = {
    "energy": "change of the energy [J]",
    "angular momentum": "change of the angular momentum [kg m²/s]",
    "q": "q [rad, m]",
    "v": "v [rad/s, m/s]",
}


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
        moved, (q, v, _) = self.system.model, self.full
        total: Array = kinetic_energy(moved, q, v) + potential_energy(moved, q)
        return total

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
        """What the joint forces τ have put in since the start, shape (n, ...), J: of each step τ times the mean v."""
        power = (self.tau * (self.v[1:] + self.v[:-1])).sum(axis=-1) / 2
        start = np.zeros((1, *power.shape[1:]), power.dtype)
        return np.concatenate([start, np.cumsum(power * self.system.dt, axis=0)])

    @cached_property
    def remarks(self) -> tuple[Remark, ...]:
        """What a real robot would not have done, or not without being noticed, the first time of each, in time order.

        A contact that sticks and pulls, would slip or tip; a body below all contacts; a joint beyond its range or its
        speed, or whose velocity alternates and grows; a motor beyond its limit; on a ground, a contact that leaves it
        or slides; damping and friction of a joint, which only time stepping applies.
        """
        system, stepping, model, (q, v, tau) = self.system, self.system.stepping, self.system.model, self.full
        clock = slice(None, None, max(system.period, 1))
        found = [*of_joints(model, self.t, q, v, tau), *of_alternation(model, *(x[clock] for x in (self.t, v, tau)))]
        if self.contact_forces and stepping is None:
            found += of_contacts(model, self.t, q, system.contacts, self.contact_forces)
        found += of_left_out(model, self.t, v) if stepping is None else of_ground(stepping, self.t)
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
            half = self.system.again(float(self.t[k]), q[k], v[k], tau[k], METHODS[self.method].step)
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
            dq, dv = self.step_error(ASKED)
        except Exception:  # half a step fails, or the policy, which may raise anything, or is in another process
            return []
        return [f"  a step is off by up to {dq:.1e} in q, {dv:.1e} in v (of {ASKED}: see step_error)"]

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
        check_known("quantity", what, LABELS)
        from ..plot.style import axes_2d

        ax = axes_2d(ax)
        if what in ("q", "v"):
            drawn = self.q if what == "q" else self.v
        else:
            total = self.energy if what == "energy" else self.momentum[..., :3]
            drawn = total - total[0]
        ax.plot(self.t, drawn.reshape(len(self.t), -1))
        ax.set(xlabel="time [s]", ylabel=LABELS[what])
        return ax

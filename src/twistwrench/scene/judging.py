"""What a model's answer misses, in what people think in: wrench, centre of pressure, contact forces, torques.

The wrench that the ground must exert is ḣ_G less the weight, which a robot with held joints has elsewhere, too. It is
shared out among the contacts that stand, the least forces that do. The motors exert what is then left, τ − Jᵀ f, where
f are the least forces of all contacts, loops and gears with which nothing is left for a joint without a motor: Jᵤᵀ f =
τᵤ. So whatever a model has wrong in the wrench, its forces and torques have wrong as well.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..algorithms.centroidal import center_of_mass
from ..algorithms.floating_base import base_placement
from ..algorithms.kinematics import frame_jacobian, frame_placement
from ..arrays import Array
from ..contact import Contact, PointContact, constraint_jacobian
from ..model import Model
from ..motions import Motion
from ..spatial import SE3, skew
from ..templates import Residual
from .candidates import Articulated, heights

__all__ = ["QUANTITIES", "ReferenceMotion", "scale", "unit"]

QUANTITIES = {"wrench": "of the weight", "cop": "m", "forces": "of the weight", "tau": "N m"}
"""What may be asked of a model, and the unit of its error."""

MIN_LOAD_SHARE = 0.05
"""Share of the weight that the ground must bear for a centre of pressure to count."""

RANK_RTOL = 1e-9
"""Two feet on a line cannot exert a moment about it: a singular value that small counts as zero."""


@dataclass(frozen=True, eq=False)
class ReferenceMotion:
    """The whole robot in a motion, which the answers of other models are held against."""

    model: Model
    weight: float
    """N; without gravity the largest wrench of the motion."""
    length: float
    """m: moments are compared with forces over this radius of gyration."""
    rate: Array
    tau: Array
    standing: Array
    """Which contact points bear something, shape (n, points)."""
    to_G: Array
    """From a wrench on the base, in its axes, to one at the centre of mass, in the world's; shape (n, 6, 6)."""
    share: Array
    """The least forces of a unit wrench at the centre of mass: at each contact point, shape (n, points, 3, 6)."""
    ease: Array
    """From torques that joints without motors would have to exert to those that contacts take from all joints instead,
    shape (n, nv, nv)."""
    first: Array
    """Where each contact's points begin."""
    height: Array
    """Of the centre of mass above the lowest contact that stands, m, shape (n,)."""
    pushed: Array
    """The wrenches of the scene together, at the centre of mass, shape (n, 6)."""

    @classmethod
    def of(
        cls,
        model: Model,
        motion: Motion,
        contacts: Sequence[Contact],
        wrenches: Mapping[str, Array],
        driven: Array,
        length: float,
    ) -> ReferenceMotion:
        """Compute what the motion needs; its feet have the soles of the contacts on the same frames.

        `driven` says which entries of v have a motor.
        """
        q, v, a = model.state(motion.q, v=motion.v, a=motion.a)
        whole = Articulated.of(model, model, lambda q, v: (q, v), wrenches)
        rate, tau = whole.law(*whole.read(q, v, a))
        weight = model.mass * float(np.sqrt(model.gravity @ model.gravity))
        if weight == 0:
            weight = float(Residual(rate[..., :3], rate[..., 3:], 1.0, length).relative.max(initial=0)) or 1.0
        given = {c.frame: c for c in contacts if c.pushes and c.to is None}
        touched = {model.frame(foot).body for foot in motion.feet}
        always = [c for c in given.values() if model.frame(c.frame).body not in touched]
        feet = [given.get(foot, PointContact(foot, 1.0)) for foot in motion.feet] + always
        stands = np.concatenate([motion.contacts, np.ones((len(q), len(always)), bool)], axis=1)
        owner = np.repeat(np.arange(len(feet)), [len(c.points) for c in feet])
        points, J = _points(model, q, feet)
        on, G = stands[:, owner], center_of_mass(model, q)
        share = _share((points - G[:, None]) / length, on) / np.array([length] * 3 + [1.0] * 3)
        height = np.where(on, heights(model, points, G), -np.inf).max(axis=1, initial=-np.inf)
        first = np.flatnonzero(np.diff(owner, prepend=-1))
        to_G = np.zeros((len(q), 6, 6))
        if model.base == "floating":
            base = base_placement(model, q)
            to_G = SE3._trusted(base.rotation, base.translation - G).force_transform()
        J = (J * on[..., None, None]).reshape(len(q), -1, model.nv)
        if inside := [c for c in contacts if not (c.pushes and c.to is None)]:
            J = np.concatenate([J, constraint_jacobian(model, q, inside)], axis=1)
        base_rows = to_G / np.array([[length]] * 3 + [[1.0]] * 3) if model.base == "floating" else None
        ease = _ease(J, ~driven, base_rows)
        pushed = np.zeros((len(q), 6))
        for frame, wrench in wrenches.items():
            arm = frame_placement(model, q, frame).translation - G
            pushed += np.concatenate([wrench[:3] + np.cross(arm, wrench[3:]), np.tile(wrench[3:], (len(q), 1))], axis=1)
        if model.base != "floating":
            on = np.zeros_like(on)
        return cls(model, weight, length, rate, tau, on, to_G, share, ease, first, height, pushed)

    @property
    def _floats(self) -> bool:
        return self.model.base == "floating"

    @property
    def tells(self) -> tuple[str, ...]:
        """What can be asked of a model in this motion."""
        motors = self.model.nv > (6 if self._floats else 0)
        feet = ("cop", "forces") if self.standing.any() and self.model.gravity.any() else ()
        return ("wrench", *feet, *(("tau",) if motors else ()))

    def errors(self, rate: Array, tau: Array | None, kept: Array, motors: Array) -> Mapping[str, Array]:
        """Return what an answer misses in each state, of all that it tells.

        `kept` are the entries that its τ has, `motors` those that are needed: one that lacks any tells no τ, nor
        does one that lacks what contacts take from a joint without a motor to one of these.
        """
        off = rate - self.rate
        found = {"wrench": Residual(off[..., :3], off[..., 3:], self.weight, self.length).relative}
        if tau is not None and self._floats and 0 in kept:
            off = np.matvec(self.to_G, tau[:, :6] - self.tau[:, :6])
        f = np.einsum("npij,nj->npi", self.share, off)
        if "cop" in self.tells:
            found["cop"] = self._cop_error(self.rate + off)
            by_contact = np.add.reduceat(f, self.first, axis=1)
            found["forces"] = np.sqrt((by_contact**2).sum(axis=-1)).max(axis=1) / self.weight
        needed = np.isin(kept, motors)
        if tau is not None and len(motors) and needed.sum() == len(motors):
            more = np.zeros_like(self.tau)
            more[:, kept] = tau - self.tau[:, kept]
            told = np.isin(np.arange(self.model.nv), kept)
            if self._floats and 0 not in kept:
                more[:, :6] = np.linalg.solve(self.to_G, off[..., None])[..., 0]
                told[:6] = True
            if np.abs(self.ease[:, motors][:, :, ~told]).max(initial=0) < RANK_RTOL:
                found["tau"] = np.abs(more - np.matvec(self.ease, more))[:, motors].max(axis=1)
        return found

    def _cop_error(self, rate: Array) -> Array:
        """Return how far the centre of pressure is from where it should be, where the ground is loaded, m."""
        right, loaded = self._cop(self.rate)
        there, _ = self._cop(rate)
        return np.where(loaded, np.sqrt(((there - right) ** 2).sum(axis=-1)), 0.0)

    def _cop(self, rate: Array) -> tuple[Array, Array]:
        """Return the centre of pressure from below the centre of mass, and whether the ground bears anything.

        The point r of the ground below which the moment N − r × F is along the vertical u.
        """
        g = self.model.gravity
        u = -g / np.sqrt(g @ g)
        N, F = rate[..., :3] - self.pushed[:, :3], rate[..., 3:] - self.model.mass * g - self.pushed[:, 3:]
        load = F @ u
        loaded = (load > MIN_LOAD_SHARE * self.weight) & self.standing.any(axis=1)
        h = np.where(loaded, self.height, 0.0)[:, None]
        across = np.cross(u, N + np.cross(h * u, F))
        return across / np.where(load > 1e-3 * self.weight, load, 1e-3 * self.weight)[:, None], loaded


def _share(arm: Array, on: Array) -> Array:
    """Return the least forces at points that exert a unit wrench about the origin, shape (n, points, 3, 6)."""
    columns = np.concatenate([skew(arm), np.broadcast_to(np.eye(3), (*arm.shape, 3))], axis=-2) * on[..., None, None]
    n, points = on.shape
    if not points:
        return np.zeros((n, 0, 3, 6))
    return np.asarray(
        np.linalg.pinv(np.moveaxis(columns, 1, 2).reshape(n, 6, -1), rtol=RANK_RTOL).reshape(n, points, 3, 6)
    )


def _ease(J: Array, passive: Array, base: Array | None) -> Array:
    """Return Jᵀ f of the least f with Jᵤᵀ f = τᵤ, as a matrix that τ is multiplied by, shape (n, nv, nv).

    `base` are the rows of a wrench at the centre of mass, of the forces of a floating base: where no f does, those are
    the errors that are least together.
    """
    n, _, nv = J.shape
    taken = np.broadcast_to(np.eye(nv)[passive], (n, passive.sum(), nv)).copy()
    if base is not None:
        taken[:, :6, :6] = base
    return np.asarray(J.mT @ np.linalg.pinv(taken @ J.mT, rtol=RANK_RTOL) @ taken)


def _points(model: Model, q: Array, contacts: Sequence[Contact]) -> tuple[Array, Array]:
    """Return where the contact points are in the world, (n, points, 3), and their Jacobians, (n, points, 3, nv)."""
    places = [np.zeros((len(q), 0, 3))]
    J = [np.zeros((len(q), 0, 3, model.nv))]
    for c in contacts:
        T = frame_placement(model, q, c.frame)
        six = frame_jacobian(model, q, c.frame, "local_world_aligned")[:, None]
        arm = c.points @ c.axes(T.rotation).mT
        places.append(T.translation[:, None] + arm)
        J.append(six[..., 3:, :] - skew(arm) @ six[..., :3, :])
    return np.concatenate(places, axis=1), np.concatenate(J, axis=1)


def unit(name: str) -> str:
    """Return the unit in which the error of a quantity is shown, after a blank; nothing for a share of the weight."""
    return {"m": " mm", "N m": " N m"}.get(QUANTITIES[name], "")


def scale(name: str) -> float:
    """Return by what an error is multiplied to be shown in that unit."""
    return 1e3 if QUANTITIES[name] == "m" else 1.0

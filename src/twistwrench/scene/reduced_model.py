"""The smallest model of a scene: the base that was chosen, held joints locked, joints that carry nothing dropped."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..contact import Contact
from ..errors import ModelError
from ..model import Model, idle_joints, lock_joints, matching_joints
from .checks import checked_contacts, checked_wrenches, expect_movable
from .payload import Payload, loaded
from .planar_base import OnTheFloor
from .robot import posture, whole_robot

__all__ = ["Base", "SmallestModel"]

Base = Literal["fixed", "floating", "planar"]


class SmallestModel:
    """What a scene is made of, and the maps between the states of the whole robot and those of the smallest model.

    Parameters and attributes are those of `Scene`.
    """

    def __init__(
        self,
        robot: str | PathLike[str] | Model,
        *,
        base: Base | None = None,
        contacts: Iterable[Contact] = (),
        hold: Iterable[str] = (),
        q: ArrayLike | None = None,
        gravity: ArrayLike | None = None,
        wrenches: Mapping[str, ArrayLike] | None = None,
        payload: Mapping[str, Payload] | None = None,
    ) -> None:
        self.full_model = full = loaded(whole_robot(robot, base, gravity), payload)
        self.payload = dict(payload or {})
        self.q = posture(full, q)
        self.contacts = checked_contacts(full, contacts)
        self.wrenches = checked_wrenches(full, {} if wrenches is None else wrenches)
        self.held = _held(full, hold)
        self._base = base or full.base
        self._floor = OnTheFloor.of(full, self.q) if base == "planar" else None
        before = self._floor.model if self._floor else full
        at = self._floor.reduce(self.q, np.zeros(full.nv))[0] if self._floor else self.q
        locked = {*self.held, *(full.joint_names[1:2] if (base, full.base) == ("fixed", "floating") else ())}
        touched = [*(frame for contact in self.contacts for frame in contact.frames), *self.wrenches]
        self.idle = idle_joints(lock_joints(before, locked, at).model, touched)
        self._reduction = lock_joints(before, {*locked, *self.idle}, at)
        self.model = self._reduction.model
        if self.model.nv == 0:
            raise ModelError(f"{full.name!r}: nothing is left to move; every joint is held, or carries nothing")
        expect_movable(self.model, (contact.frame for contact in self.contacts), "contact on frame")
        expect_movable(self.model, self.wrenches, "wrench on frame")
        expect_movable(self.model, self.payload, "payload on frame")

    # ---------------------------------------------------------------- between the whole robot and the model

    def reduce(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return the state of `model` that belongs to one of `full_model`.

        The coordinates and velocities of the held joints are dropped; with a planar base also height,
        tilt and their rates. Accelerations are mapped as velocities are.

        Parameters
        ----------
        q : array_like, shape (..., nq of full_model)
        v : array_like, shape (..., nv of full_model)

        Returns
        -------
        (ndarray, ndarray), shapes (..., nq) and (..., nv)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        q, v = self.full_model.state(q, v=v)
        return self._reduction.reduce(*(self._floor.reduce(q, v) if self._floor else (q, v)))

    def expand(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return the state of `full_model` that belongs to one of `model`: what is held stands still.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v : array_like, shape (..., nv)

        Returns
        -------
        (ndarray, ndarray), shapes (..., nq of full_model) and (..., nv of full_model)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        q, v = self._reduction.expand(q, v)
        return self._floor.expand(q, v) if self._floor else (q, v)

    @property
    def actuated(self) -> Array:
        """Which entries of v have a motor, bool of shape (nv,): all but those of a floating or planar base."""
        return np.arange(self.model.nv) >= {"floating": 6, "planar": 3, "fixed": 0}[self._base]

    def __repr__(self) -> str:
        said = [f"{self._base} base"]
        for names, one, several in (
            (self.contacts, "contact", "contacts"),
            (self.wrenches, "wrench", "wrenches"),
            (self.payload, "payload", "payloads"),
            (self.held, "joint held", "joints held"),
            (self.idle, "joint that carries nothing dropped", "joints that carry nothing dropped"),
        ):
            if names:
                said.append(f"{len(names)} {one if len(names) == 1 else several}")
        return f"<Scene {self.full_model.name!r}: {', '.join(said)}, nv = {self.model.nv} of {self.full_model.nv}>"


def _held(model: Model, hold: Iterable[str]) -> tuple[str, ...]:
    """Return the joints that match; a floating base is not among them, as `base` decides about it."""
    held = matching_joints(model, hold, "hold")
    base = model.joint_names[1:2] if model.base == "floating" else ()
    if held and held == base:
        raise ModelError(f"hold: {base[0]!r} is the floating base; base='fixed' holds it")
    return tuple(name for name in held if name not in base)

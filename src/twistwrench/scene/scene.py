"""The scene: a robot, what holds it, what pushes it; and the smallest model that has all this."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array
from ..contact import Contact
from ..errors import ModelError
from ..floating_base import names_of
from ..kinematics import frame_placement
from ..model import Model
from ..reduction import idle_joints, lock_joints, matching_joints
from ..whole_body import Dynamics
from .checks import checked_contacts, checked_wrenches, expect_movable
from .floor import OnTheFloor
from .once import scene_dynamics
from .robot import posture, whole_robot

__all__ = ["Scene"]

Base = Literal["fixed", "floating", "planar"]


class Scene:
    """A robot with what holds it and what pushes it, and the smallest model that says the same.

    Joints that are held are locked where they stand and their bodies merged; joints that carry nothing are dropped;
    all frames stay. `model` is what is left, for any function of the package.

    Parameters
    ----------
    robot : str, path or Model
        As `twistwrench.load` takes it, or a model.
    base : {"fixed", "floating", "planar"}, optional
        Held where it stands in q; free; or free to slide and turn on the floor, as high and as tilted as in q. As the
        model has it unless given.
    contacts : iterable of Contact
        `PointContact` or `SurfaceContact`.
    hold : iterable of str
        Joints that stand still, by name or pattern: ``"arm_*"`` is every joint whose name begins so.
    q : array_like, shape (nq of the whole robot,), optional
        Where they stand; the standing posture, or where there is none the neutral one, unless given.
    gravity : array_like, shape (3,), optional
        In the world, m/s²; the model's unless given.
    wrenches : mapping of str to array_like, shape (6,), optional
        Constant (τ, f) from outside on a frame: at its origin, in the axes of the world, N m and N.

    Attributes
    ----------
    model : Model
        The smallest model.
    full_model : Model
        The whole robot, with the scene's gravity.
    contacts : tuple of Contact
    held : tuple of str
        The joints that are held.
    idle : tuple of str
        The joints that were dropped because they carry nothing.
    q : ndarray, shape (nq of full_model,)
        Where the held and the dropped joints stand.
    wrenches : dict of str to ndarray, shape (6,)

    Raises
    ------
    NameNotFound
        A robot, a joint or pattern, or a frame that is not known; the message lists what is.
    ModelError
        A base that is none of the three or cannot be had; a contact or a wrench on a frame that the scene holds fixed
        to the world; two contacts at one place; nothing left to move.
    ShapeError, ValueError
        Numbers that are none, or of a wrong shape; friction below zero (`PointContact` says so).
    TypeError
        A contact that is none.

    Examples
    --------
    >>> import twistwrench as tw
    >>> soles = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), mu=0.7) for side in ("left", "right")]
    >>> scene = tw.Scene("humanoid", contacts=soles, hold=["*_shoulder_*", "*_elbow"])
    >>> scene
    <Scene 'humanoid': floating base, 2 contacts, 8 joints held, nv = 19 of 27>
    >>> d = scene.dynamics(scene.model.standing(), np.zeros(19), want={"M", "J_c"})
    >>> d.M.shape, d.J_c.shape, d.h
    ((19, 19), (12, 19), None)
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
    ) -> None:
        self.full_model = full = whole_robot(robot, base, gravity)
        self.q = posture(full, q)
        self.contacts = checked_contacts(full, contacts)
        self.wrenches = checked_wrenches(full, wrenches or {})
        self.held = matching_joints(full, hold)
        self._base = "fixed" if "root_joint" in self.held else base or full.base
        self._floor = OnTheFloor.of(full, self.q) if base == "planar" else None
        before = self._floor.model if self._floor else full
        at = self._floor.reduce(self.q, np.zeros(full.nv))[0] if self._floor else self.q
        locked = {*self.held, *(["root_joint"] if (self._base, full.base) == ("fixed", "floating") else [])}
        touched = [*(contact.frame for contact in self.contacts), *self.wrenches]
        self.idle = idle_joints(lock_joints(before, locked, at).model, touched)
        self._reduction = lock_joints(before, {*locked, *self.idle}, at)
        self.model = self._reduction.model
        if self.model.nv == 0:
            raise ModelError(f"{full.name!r}: the scene holds every joint, and nothing is left to move")
        expect_movable(self.model, (contact.frame for contact in self.contacts), "contact on frame")
        expect_movable(self.model, self.wrenches, "wrench on frame")

    # ---------------------------------------------------------------- the way between the whole robot and the model

    def reduce(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return the state of `model` that belongs to one of `full_model`.

        What the held joints do there is dropped, whether they stand still or not; with a planar base also height,
        tilt and their rates. Accelerations go the way of velocities.

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

    # ---------------------------------------------------------------- what a controller asks for

    def dynamics(self, q: ArrayLike, v: ArrayLike, *, want: Iterable[str] = ("M", "h", "J_c", "A_G")) -> Dynamics:
        """Return what is wanted of M q̈ + h = Sᵀ τ + J_cᵀ λ, and nothing else.

        All of it from one placement of the links (`fast.dynamics`); the angular rows of a sole, or of a moment, take
        the rotations on the way to it once more.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v : array_like, shape (..., nv)
        want : iterable of {"M", "h", "J_c", "A_G"}

        Returns
        -------
        Dynamics
            Of `model`. h holds the scene's wrenches: it is smaller by Σ Jᵀ (τ, f). J_c has the rows of each contact in
            the scene's order, in the axes of the world: (v) of a point, (ω, v) of a surface.

        Raises
        ------
        NameNotFound
            If `want` names something else.
        ShapeError, SingularError, ValueError
            As `twistwrench.dynamics`.
        """
        want = names_of(want, "want", "quantities")
        return scene_dynamics(self.model, self.contacts, self.wrenches, q, v, want)

    def f_ext(self, q: ArrayLike) -> Array:
        """Return the scene's wrenches as `twistwrench.rnea` and `twistwrench.aba` take them, shape (..., nbodies, 6).

        Parameters
        ----------
        q : array_like, shape (..., nq)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        (q,) = self.model.state(q)
        f = np.zeros((*q.shape[:-1], self.model.nbodies, 6), q.dtype)
        for name, wrench in self.wrenches.items():
            at = self.model.frame(name)
            R = frame_placement(self.model, q, name).rotation
            turned = np.concatenate([np.matvec(R.mT, wrench[:3]), np.matvec(R.mT, wrench[3:])], axis=-1)
            f[..., at.body, :] += np.matvec(at.placement.force_transform(), turned)
        return f

    def __repr__(self) -> str:
        said = [f"{self._base} base"]
        for names, one, several in (
            (self.contacts, "contact", "contacts"),
            (self.wrenches, "wrench", "wrenches"),
            (self.held, "joint held", "joints held"),
            (self.idle, "joint that carries nothing dropped", "joints that carry nothing dropped"),
        ):
            if names:
                said.append(f"{len(names)} {one if len(names) == 1 else several}")
        return f"<Scene {self.full_model.name!r}: {', '.join(said)}, nv = {self.model.nv} of {self.full_model.nv}>"

"""What is shown: a model in one or many configurations, where it touches the ground, and the forces of the ground."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from os import PathLike

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.kinematics import forward_kinematics
from ..arrays import Array, as_exactly, as_sequence
from ..contact import Contact, PointContact, contact_inverse_dynamics, contact_placements
from ..errors import ShapeError, SingularError, no_model
from ..loading import load
from ..model import Model, in_double
from ..motions import Motion
from ..plot.style import as_drawable, newtons
from ..scene import Scene
from ..simulation import Simulation

__all__ = ["Forces", "Subject", "subject"]


@dataclass(frozen=True)
class Forces:
    """The forces of the ground, in the axes of the world.

    Attributes
    ----------
    at : ndarray, shape (k, 3)
        Where on the robot: the origin of a contact's frame, or the centre of pressure of a sole, m.
    vectors : ndarray, shape (k, 3)
        N.
    """

    at: Array
    vectors: Array


@dataclass(frozen=True)
class Subject:
    """What is shown.

    Attributes
    ----------
    model : Model
    q : ndarray, shape (nq,) or (n, nq)
    t : ndarray, shape (n,), or None
        Times of the n configurations, s.
    contacts : tuple of Contact
        The k that may touch the ground.
    stands : ndarray of bool, shape (k,) or (n, k)
        Which of them do.
    given : ndarray, shape (k, 3) or (n, k, 3), or None
        Forces on the frames of the contacts; None for those that hold the robot at rest.
    """

    model: Model
    q: Array
    t: Array | None
    contacts: tuple[Contact, ...]
    stands: Array
    given: Array | None

    def at(self, k: int) -> Subject:
        """Return configuration k of a motion alone; a single one is its own."""
        if self.t is None:
            return self
        given = None if self.given is None else self.given[k]
        return replace(self, q=self.q[k], t=None, stands=self.stands[k], given=given)

    def moved(self, q: ArrayLike) -> Subject:
        """Return the same robot in another configuration."""
        q = _configuration(self.model, q)
        if q.ndim != 1:
            raise ShapeError(f"q: expected one configuration, shape ({self.model.nq},), got {q.shape}")
        return replace(self.at(0), q=q)

    # ---------------------------------------------------------------- of one configuration

    def support(self) -> Array:
        """Return the points that touch the ground, in the world, shape (n, 3), m."""
        T = contact_placements(self.model, self.q, self.contacts)
        points = [T[c.frame].act(c.points) for c, stands in zip(self.contacts, self.stands) if stands]
        return np.concatenate([np.zeros((0, 3)), *points])

    def forces(self) -> Forces | None:
        """Return the forces that were given, or those that hold a floating robot at rest; None where no forces can."""
        T = contact_placements(self.model, self.q, self.contacts)
        feet = np.array([T[c.frame].translation for c in self.contacts]).reshape(-1, 3)
        if self.given is not None:
            return Forces(feet, self.given)
        if self.model.base != "floating" or not self.contacts:
            return None
        rest = np.zeros(self.model.nv)
        try:
            found = contact_inverse_dynamics(self.model, self.q, rest, rest, self.contacts).forces
        except SingularError:
            return None
        for k, c in enumerate(self.contacts):
            if c.dim == 6:  # the wrench of a sole has no moment along the sole about its centre of pressure (49.4)
                moment = found[c.frame][:3]
                force = found[c.frame][3:]
                normal = T[c.frame].rotation[:, 2]
                feet[k] += np.cross(normal, moment) / (normal @ force or 1.0)  # a sole without a force has no moment
        return Forces(feet, np.array([found[c.frame][-3:] for c in self.contacts]))

    def texts(self, forces: Forces) -> list[str]:
        """Return what to write at the forces: the size of each; of several on a body, their sum at the outermost."""
        bodies = np.array([self.model.frames[c.frame].body for c in self.contacts])
        texts = [""] * len(bodies)
        outwards = np.linalg.norm(forces.at - forces.at.mean(axis=0), axis=-1)
        for body in np.unique(bodies):
            (on,) = np.nonzero(bodies == body)
            size = float(np.linalg.norm(forces.vectors[on].sum(axis=0)))
            texts[on[outwards[on].argmax()]] = f"{'Σ ' * (len(on) > 1)}{newtons(size)}" if size else ""
        return texts

    def box(self) -> tuple[Array, float]:
        """Return the middle of the box around bodies and frames, shape (3,), and its longest side; in the world, m."""
        T = forward_kinematics(self.model, self.q).placement
        origins = [place.translation for place in T[1:] or T]
        points = np.array([*origins, *(T[f.body].act(f.placement.translation) for f in self.model.frames.values())])
        low, high = points.min(axis=0), points.max(axis=0)
        return (low + high) / 2, float((high - low).max()) or 1.0


def subject(
    robot: str | PathLike[str] | Model | Scene | Simulation,
    q: ArrayLike | Motion | Simulation | None = None,
    *,
    t: ArrayLike | None = None,
    contacts: Iterable[str | Contact] | None = None,
    forces: ArrayLike | None = None,
) -> Subject:
    """Gather what is to be shown, and fill in the defaults. The arguments are those of `twistwrench.view`.

    Returns
    -------
    Subject

    Raises
    ------
    NameNotFound
        If there is no such robot or frame.
    ShapeError, ValueError, TypeError
        If `q`, `t` or `forces` cannot be those of the model and its contacts.
    """
    model = load(robot) if isinstance(robot, str | PathLike) else getattr(robot, "model", robot)
    if not isinstance(model, Model):
        raise no_model(robot, "robot", "a name, a path, a Model, a Scene or a Simulation")
    motion = robot if isinstance(robot, Simulation) and q is None else q
    own = contacts is None
    ground = _contacts(model, _own_contacts(robot, motion) if own else contacts)
    if own and forces is None and isinstance(motion, Simulation):
        forces = _own_forces(motion, ground)
    standing = motion.contacts if own and isinstance(motion, Motion) else None
    if isinstance(motion, Motion | Simulation):
        t = motion.t if t is None else t
        motion = motion.q
    q = _configuration(model, motion)
    given = None
    if forces is not None:
        given = as_drawable(as_exactly(forces, "forces", *q.shape[:-1], len(ground), 3), "forces")
    stands = np.ones((*q.shape[:-1], len(ground)), bool) if standing is None else standing
    stands = stands if given is None else (given != 0).any(axis=-1)
    return Subject(model, q, _times(q, t), ground, stands, given)


def _own_contacts(robot: object, motion: object) -> tuple[Contact, ...] | None:
    """Return the contacts of a simulation or of a scene; None for those of another robot, which are its feet."""
    if isinstance(motion, Simulation) and motion.contact_forces:
        stepping = motion.system.stepping
        return stepping.contacts if stepping else motion.system.contacts
    return robot.contacts if isinstance(robot, Scene) else None


def _own_forces(motion: Simulation, contacts: tuple[Contact, ...]) -> Array | None:
    """Return the forces of a simulation in its n states, shape (n, k, 3), N; None where nothing touches.

    Those of a step with a ground, of which there are n - 1, are shown in the state where it ends.
    """
    if not contacts or not motion.contact_forces or motion.q.ndim != 2:
        return None
    found = np.stack([motion.contact_forces[c.frame][..., -3:] for c in contacts], axis=1)
    return np.concatenate([found[: len(motion.q) - len(found)], found]) if len(found) else None


def _configuration(model: Model, q: ArrayLike | None) -> Array:
    """Check q; without one the robot stands, or is neutral."""
    if q is None:
        return model.postures["standing"] if "standing" in model.postures else model.neutral()
    (q,) = model.state(q)
    if q.ndim > 2 or (q.ndim == 2 and not len(q)):
        raise ShapeError(f"q: expected shape ({model.nq},), or (n, {model.nq}) for a motion, got {q.shape}")
    if q.dtype.kind == "c":
        raise ValueError("q: expected real numbers, got complex ones")
    return in_double(model, q)


def _times(q: Array, t: ArrayLike | None) -> Array | None:
    """Check the times of a motion; None for a single configuration."""
    if q.ndim == 1:
        if t is not None:
            raise ValueError("t: a single configuration has no times")
        return None
    times = np.arange(len(q)) / 30 if t is None else as_exactly(t, "t", len(q))
    if (np.diff(times) <= 0).any():
        raise ValueError("t: expected times that grow")
    return times


def _contacts(model: Model, contacts: Iterable[str | Contact] | None) -> tuple[Contact, ...]:
    """Make point contacts of names; the model's feet where none are given."""
    if isinstance(contacts, str):
        raise ValueError(f"contacts: expected several contacts, got the string {contacts!r}; [{contacts!r}] is one")
    given = model.feet if contacts is None else as_sequence(contacts, "contacts", "contacts or frame names")
    made = [c if isinstance(c, Contact) else PointContact(c, 0.0) for c in given]
    for contact in made:
        model.frame(contact.frame)
    return tuple(c for c in made if c.pushes and c.dim >= 3)  # what is held otherwise is not drawn

"""The legs of a robot: which joints, which feet, and whether a foot is a point or a sole."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import frame_placement
from ..arrays import Array
from ..errors import ModelError
from ..model import Model, check_model

__all__ = ["Leg", "Stand", "stand"]


@dataclass(frozen=True, eq=False)
class Leg:
    """One leg of a robot that stands.

    Attributes
    ----------
    frame : str
        The foot's frame, or the first of them.
    feet : tuple of int
        Which of `Model.feet` are on this leg.
    columns : tuple of int
        Its joints' places in v. Three place a point foot, six a sole.
    entries : tuple of int
        Their places in q.
    position : ndarray, shape (3,)
        Of the frame in the world, m.
    rotation : ndarray, shape (3, 3)
        Of the frame.
    center : ndarray, shape (3,)
        The mean of its feet's frames, m.
    """

    frame: str
    feet: tuple[int, ...]
    columns: tuple[int, ...]
    entries: tuple[int, ...]
    position: Array
    rotation: Array
    center: Array

    @property
    def has_sole(self) -> bool:
        """Whether the foot must stay flat, too."""
        return len(self.columns) == 6

    @property
    def rows(self) -> slice:
        """The rows of the frame's Jacobian that its joints can choose: of a point foot the linear ones."""
        return slice(0 if self.has_sole else 3, 6)


@dataclass(frozen=True, eq=False)
class Stand:
    """A robot as it stands: where every motion begins.

    Attributes
    ----------
    model : Model
    q : ndarray, shape (nq,)
        `Model.standing`.
    com : ndarray, shape (3,)
        m.
    legs : tuple of Leg
    """

    model: Model
    q: Array
    com: Array
    legs: tuple[Leg, ...]

    @property
    def height(self) -> float:
        """Of the centre of mass above the lowest foot, m."""
        return float(self.com[2] - min(leg.center[2] for leg in self.legs))

    @property
    def unit(self) -> float:
        """The unit of time of everything that falls from that height: √(height / g), s."""
        return float(np.sqrt(self.height / np.sqrt((self.model.gravity**2).sum())))


def stand(model: Model) -> Stand:
    """Return a legged robot as it stands.

    Raises
    ------
    ModelError
        If the robot does not stand on legs of three joints (point feet) or six (soles), or gravity does not pull along
        −z.
    """
    check_model(model)
    if model.base != "floating" or not model.feet:
        raise ModelError(f"{model.name!r}: expected a floating base and feet, got a {model.base} one, {model.feet}")
    if not (model.gravity[2] < 0 and not model.gravity[:2].any()):
        raise ModelError(f"{model.name!r}: expected gravity along -z, got {model.gravity.tolist()}")
    q = model.standing()
    carriers = dict.fromkeys(model.frame(foot).body for foot in model.feet)
    legs = tuple(_leg(model, q, body) for body in carriers)
    joints = [column for leg in legs for column in leg.columns]
    if len(set(joints)) < len(joints):
        raise ModelError(f"{model.name!r}: its legs share joints")
    return Stand(model, q, center_of_mass(model, q), legs)


def _leg(model: Model, q: Array, body: int) -> Leg:
    feet = tuple(k for k, foot in enumerate(model.feet) if model.frame(foot).body == body)
    path = model.support(body)[-2::-1]
    columns = tuple(c for i in path for c in range(model.v_slice[i].start, model.v_slice[i].stop))
    entries = tuple(c for i in path for c in range(model.q_slice[i].start, model.q_slice[i].stop))
    if len(columns) not in (3, 6):
        expected = "expected a leg of 3 joints (a point foot) or 6 (a sole)"
        raise ModelError(f"{model.name!r}: {expected}, got {len(columns)} to {model.feet[feet[0]]!r}")
    placed = [frame_placement(model, q, model.feet[k]) for k in feet]
    center = np.mean([T.translation for T in placed], axis=0)
    return Leg(model.feet[feet[0]], feet, columns, entries, placed[0].translation, placed[0].rotation, center)

"""The models that may take the place of a whole robot: the templates of 49.10, and the robot with joints held."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import frame_placement
from ..arrays import Array
from ..contact import Contact
from ..model import Model, lock_joints, matching_joints
from ..templates import TEMPLATES
from ..templates.reduced import Full, LinearPendulum
from ..templates.template import Template
from .articulated import Articulated
from .judging import heights

__all__ = ["Candidate", "candidates", "limbs", "this_scene"]

LEFT_OUT = {"planar": "the height and the tilt of the base", "fixed": "the motion of the base"}


class Candidate(NamedTuple):
    """A model to be tried; or why it cannot be tried."""

    name: str
    leaves_out: str
    model: Template | Articulated | None
    unfit: str = ""

    @property
    def kept(self) -> Array:
        """The entries of the whole robot's τ that it tells."""
        return self.model.kept[0] if isinstance(self.model, Articulated) else np.zeros(0, int)

    @property
    def tells_torques(self) -> bool:
        """Whether it predicts τ."""
        return isinstance(self.model, Articulated)

    def law(self, *known: Array) -> tuple[Array, ...]:
        """Return ḣ_G, and τ where it tells it."""
        if isinstance(self.model, Articulated):
            return self.model.law(*known)
        if self.model is None:
            raise ValueError(f"{self.name!r} does not apply: {self.unfit}")
        return (self.model.law(*known),)


def candidates(
    model: Model, q: Array, groups: Mapping[str, Iterable[str]], feet: Sequence[Contact]
) -> Iterator[Candidate]:
    """Yield the templates, and the full model with each group of joints held in q, with any two, and with all."""
    for name, kind in TEMPLATES.items():
        yield _template(name, kind, model, q, feet)
    whole, tried = len(model.joint_names) - _first(model), set[frozenset[str]]()
    held = {name: matching_joints(model, joints) for name, joints in groups.items()}
    for count in sorted({1, 2, len(held)} - {0}):
        for names in combinations(held, count):
            joints = frozenset(joint for name in names for joint in held[name])
            if joints not in tried:
                tried.add(joints)
                small = lock_joints(model, joints, q)
                said = f"The motion of {len(small.held)} of {whole} joints."
                fits = small.model.nv > 0
                yield Candidate(
                    "hold " + " + ".join(names),
                    said,
                    Articulated.of(model, small.model, small.reduce) if fits else None,
                    "" if fits else "nothing is left to move",
                )


def this_scene(
    full: Model, small: Model, base: str, gone: Collection[str], reduce: Callable[[Array, Array], tuple[Array, Array]]
) -> Iterator[Candidate]:
    """Yield the model of a scene in place of the whole robot, where it leaves anything out."""
    said = [] if base == full.base else [LEFT_OUT[base]]
    if gone:
        said.append(f"the motion of {len(gone)} of {len(full.joint_names) - _first(full)} joints")
    if said:
        text = " and ".join(said)
        yield Candidate("this scene", f"{text[0].upper()}{text[1:]}.", Articulated.of(full, small, reduce))


def _template(name: str, kind: type[Template], model: Model, q: Array, feet: Sequence[Contact]) -> Candidate:
    """Return a template, or why it does not apply to this robot."""
    if kind is Full:
        return Candidate(name, kind.assumes, Articulated.of(model, model, lambda q, v: (q, v)))
    try:
        if kind is LinearPendulum and feet and not model.feet:
            pendulum = LinearPendulum.of(model, q, height=_height(model, q, feet))
            return Candidate(name, kind.assumes, pendulum)
        return Candidate(name, kind.assumes, kind.of(model, q))
    except ValueError as error:
        return Candidate(name, kind.assumes, None, str(error))


def _height(model: Model, q: Array, feet: Sequence[Contact]) -> float:
    """Return how far the centre of mass is above the lowest point that touches, against gravity, m."""
    places = [(c, frame_placement(model, q, c.frame)) for c in feet]
    points = np.concatenate([T.translation + c.points @ c.axes(T.rotation).mT for c, T in places])
    return float(heights(model, points, center_of_mass(model, q)).max())


def _first(model: Model) -> int:
    """Return the first body whose joint can be held: all but a floating base."""
    return 2 if model.base == "floating" else 1


def limbs(model: Model, feet: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """Return the limbs that do not touch the ground: by the joint that each hangs on, that one and all outboard of it.

    A limb begins where the way to no foot leads, and again where a limb branches.

    Parameters
    ----------
    model : Model
    feet : iterable of str
        Frames that touch the ground.

    Returns
    -------
    dict of str to tuple of str

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("humanoid")
    >>> list(limbs(model, model.feet))
    ['waist_yaw', 'left_shoulder_pitch', 'right_shoulder_pitch']
    """
    busy = {*range(_first(model)), *(i for name in feet for i in model.support(model.frame(name).body))}
    heads = [
        i
        for i in range(1, model.nbodies)
        if i not in busy and (model.parent[i] in busy or model.parent.count(model.parent[i]) > 1)
    ]
    outboard = {head: [i for i in range(1, model.nbodies) if head in model.support(i)] for head in heads}
    return {model.joint_names[head]: tuple(model.joint_names[i] for i in bodies) for head, bodies in outboard.items()}

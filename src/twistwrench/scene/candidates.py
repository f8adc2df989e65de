"""The models that may take the place of a whole robot: the templates of 49.10, and the robot with joints held."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ..algorithms.centroidal import center_of_mass, centroidal_momentum_rate
from ..algorithms.kinematics import forward_kinematics, frame_placement
from ..algorithms.rnea import rnea
from ..arrays import Array
from ..contact import Contact
from ..model import Model, lock_joints, matching_joints
from ..templates import TEMPLATES
from ..templates.reduced import Full, LinearPendulum
from ..templates.template import Template, full_rate
from .dynamics import push

__all__ = ["Articulated", "Candidate", "candidates", "heights", "limbs", "radius_of_gyration", "scene_candidate"]

Reduce = Callable[[Array, Array], tuple[Array, Array]]


@dataclass(frozen=True, eq=False)
class Articulated:
    """A model with joints, in place of the whole robot: it predicts ḣ_G, and the torques of the joints it has.

    A body that is held to the world has no part in the momentum of the model; so ḣ_G is about the centre of mass of the
    whole robot, which a model whose base does not float must be given.
    """

    full: Model
    model: Model
    reduce: Reduce
    """From a state of the whole robot to one of the model."""
    kept: Array
    """The entries of the whole robot's τ that it has, and where they are in its own: shape (2, k)."""
    wrenches: Mapping[str, Array] = field(default_factory=dict)
    """From outside, on frames: (τ, f) in the axes of the world."""

    @classmethod
    def of(cls, full: Model, model: Model, reduce: Reduce, wrenches: Mapping[str, Array] | None = None) -> Articulated:
        """Return a model in place of the whole robot; joints of one name and size are the same."""
        there = dict(zip(full.joint_names, full.v_slice))
        both = [(there[name], s) for name, s in zip(model.joint_names[1:], model.v_slice[1:]) if name in there]
        same = [(s, t) for s, t in both if s.stop - s.start == t.stop - t.start]  # not the base, where it is another
        pairs = [pair for s, t in same for pair in zip(range(full.nv)[s], range(model.nv)[t])]
        return cls(full, model, reduce, np.array(pairs, int).reshape(-1, 2).mT, wrenches or {})

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return the model's state, and where it does not float the centre of mass of the whole robot."""
        known = (*self.reduce(q, v), self.reduce(q, a)[1])
        return known if self.model.base == "floating" else (*known, center_of_mass(self.full, q))

    def law(self, *known: Array) -> tuple[Array, Array]:
        """Return ḣ_G = (k̇, l̇), shape (..., 6), and τ without contact forces, shape (..., k)."""
        q, v, a, *about = known
        tau = (
            rnea(self.model, q, v, a) - push(self.model, self.wrenches, q)
            if self.wrenches
            else rnea(self.model, q, v, a)
        )
        tau = tau[..., self.kept[1]]
        if not about:
            return full_rate(self.model, q, v, a), tau
        rate = centroidal_momentum_rate(self.model, q, v, a)
        moment = rate[..., :3] + np.cross(center_of_mass(self.model, q) - about[0], rate[..., 3:])
        return np.concatenate([moment, rate[..., 3:]], axis=-1), tau


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
    def predicts_torques(self) -> bool:
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
    model: Model,
    q: Array,
    groups: Mapping[str, Iterable[str]],
    feet: Sequence[Contact],
    wrenches: Mapping[str, Array],
) -> Iterator[Candidate]:
    """Yield the templates, and the full model with each group of joints held in q, with any two, and with all."""
    for name, kind in TEMPLATES.items():
        yield _template(name, kind, model, q, feet, wrenches)
    whole = len(model.joint_names) - _first(model)
    tried = set[frozenset[str]]()
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
                    Articulated.of(model, small.model, small.reduce, wrenches) if fits else None,
                    "" if fits else "nothing is left to move",
                )


def scene_candidate(
    full: Model, small: Model, base: str, gone: Collection[str], reduce: Reduce, wrenches: Mapping[str, Array]
) -> Iterator[Candidate]:
    """Yield the model of a scene in place of the whole robot, where it leaves anything out."""
    said = [] if base == full.base else [LEFT_OUT[base]]
    if gone:
        said.append(f"the motion of {len(gone)} of {len(full.joint_names) - _first(full)} joints")
    if said:
        text = " and ".join(said)
        yield Candidate("this scene", f"{text[0].upper()}{text[1:]}.", Articulated.of(full, small, reduce, wrenches))


def _template(
    name: str, kind: type[Template], model: Model, q: Array, feet: Sequence[Contact], wrenches: Mapping[str, Array]
) -> Candidate:
    """Return a template, or why it does not apply to this robot."""
    if kind is Full:
        return Candidate(name, kind.assumes, Articulated.of(model, model, lambda q, v: (q, v), wrenches))
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


def radius_of_gyration(model: Model, q: Array) -> float:
    """Return √(trace I_G / 2 m) of a robot with its joints locked in one configuration, m."""
    G = center_of_mass(model, q)
    squares = 0.0
    for T, inertia in list(zip(forward_kinematics(model, q).placement, model.inertia))[1:]:
        arm = T.translation + T.rotation @ inertia.com - G
        squares += float(inertia.mass * (arm @ arm) + np.trace(inertia.inertia_at_com) / 2)
    return float(np.sqrt(squares / model.mass))


def heights(model: Model, points: Array, G: Array) -> Array:
    """Return how far the centre of mass is above points, against gravity, m, shape (..., k)."""
    up = -model.gravity / max(float(np.sqrt(model.gravity @ model.gravity)), np.finfo(float).tiny)
    return np.asarray((G[..., None, :] - points) @ up)

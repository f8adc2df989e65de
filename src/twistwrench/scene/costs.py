"""The cost of a reduced model: error and time of each over a motion, and the quickest that is exact enough.

All models answer one question: which wrench the ground and the weight together must exert on the robot for the motion
to happen, ḣ_G. The templates of 49.10 answer only this; a robot with held joints gives the torques of the rest as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import frame_placement
from ..arrays import Array, as_number
from ..contact import Contact
from ..model import Model, lock_joints
from ..motions import Motion
from ..templates import TEMPLATES, Residual
from ..templates.full_model import Full
from ..templates.pendulum import LinearPendulum
from ..templates.template import Template
from ..timing import round_robin
from .anchored import Anchored, radius_of_gyration

__all__ = ["Candidate", "Costs", "Option", "State", "costs", "limbs"]


@dataclass(frozen=True)
class Option:
    """A model that could take the place of the full one, and what that costs.

    Attributes
    ----------
    name : str
        Of the template, or of the joints that are held.
    leaves_out : str
        What it assumes.
    tells_torques : bool
        Whether it gives joint torques, and not only ḣ_G.
    residual : ndarray, shape (n,)
        At each state of the motion, the wrench that it misses as a share of the weight (`Residual.relative`).
    seconds : float
        For one state, when all states are done at once.
    unfit : str
        Why it does not apply to this robot, with nothing then in `residual` and no number in `seconds`; empty where it
        does.
    """

    name: str
    leaves_out: str
    tells_torques: bool
    residual: Array
    seconds: float
    unfit: str = ""

    @property
    def worst(self) -> float:
        """The largest residual over the motion; infinite where the model does not apply."""
        return np.inf if self.unfit else float(self.residual.max(initial=0))


@dataclass(frozen=True)
class Costs:
    """What `Scene.cheapest` returns: every option, the quickest first, and the choice. Printed, it is a table.

    Attributes
    ----------
    motion : str
    tolerance : float
        The largest residual that is allowed, as a share of the weight.
    options : tuple of Option
        Those that do not apply come last, with the reason.
    share_of : str
        What the residuals are a share of: the weight, or without gravity the largest ḣ_G of the motion.
    """

    motion: str
    tolerance: float
    options: tuple[Option, ...]
    share_of: str = "the weight"

    @property
    def best(self) -> Option:
        """The quickest option that stays within the tolerance over the whole motion."""
        return next(option for option in self.options if option.worst <= self.tolerance)

    def __str__(self) -> str:
        width = max(len(option.name) for option in self.options)
        rows = [
            f"{'→' if option is self.best else ' '} {option.name:{width}}  {np.median(option.residual):8.1e}"
            f"  {option.worst:8.1e} {'  ' if option.worst <= self.tolerance else '> '}{option.seconds * 1e6:8.2f}"
            f"  {'ḣ_G, τ' if option.tells_torques else 'ḣ_G':6}  {option.leaves_out}"
            for option in self.options
            if not option.unfit
        ]
        rows += [f"  {option.name:{width}}  does not apply: {option.unfit}" for option in self.options if option.unfit]
        head = f"  {'model':{width}}    median     worst     µs/state  tells   leaves out"
        title = f"{self.motion}: wrench missed, as a share of {self.share_of}; tolerance {self.tolerance:.1e}"
        return "\n".join([title, head, *(row.rstrip() for row in rows)])

    def plot(self, ax: Any = None) -> Any:
        """Draw time over error: the options left of the line are exact enough, and the lowest of these is the choice.

        Parameters
        ----------
        ax : matplotlib Axes, optional

        Returns
        -------
        matplotlib Axes

        Raises
        ------
        ModuleNotFoundError
            If matplotlib is not installed.
        """
        from .picture import draw

        return draw(self, ax)


State = tuple[Array, Array, Array]


class Candidate(NamedTuple):
    """A model to be tried, and the states of the motion as it knows them; or why it cannot be tried."""

    name: str
    leaves_out: str
    template: Template | Anchored | None
    state: State
    unfit: str = ""


def costs(
    model: Model,
    motion: Motion,
    tolerance: float,
    groups: Mapping[str, Iterable[str]],
    feet: Sequence[Contact] = (),
    scene: Callable[[State], Candidate] | None = None,
) -> Costs:
    """See `Scene.cheapest`; `scene` is one more candidate, of the states of the motion."""
    if not as_number(tolerance, "tolerance") >= 0:
        raise ValueError(f"tolerance: expected a share of the weight, 0 or more, got {tolerance!r}")
    q, v, a = model.state(motion.q, v=motion.v, a=motion.a)
    state = (q, v, a)
    whole = _whole(model, state)
    true = whole.law(*whole.read(*state))
    scale, length, share_of = _scale(whole, q[0], true)
    tried = candidates(model, state, groups, feet) + ([scene(state)] if scene else [])
    fit = [(one.template, one) for one in tried if one.template is not None]
    known = [template.read(*one.state) for template, one in fit]
    laps = round_robin([partial(template.law, *x) for (template, _), x in zip(fit, known)], rounds=7, least=0)
    options = []
    for (template, one), x, lap in zip(fit, known, laps):
        e = template.law(*x) - true
        residual = Residual(e[..., :3], e[..., 3:], scale, length).relative
        seconds = float(lap.seconds.min()) / len(true)
        options.append(Option(one.name, one.leaves_out, isinstance(template, Full | Anchored), residual, seconds))
    options.sort(key=lambda option: option.seconds)
    unfit = [Option(one.name, one.leaves_out, False, np.zeros(0), np.nan, one.unfit) for one in tried if one.unfit]
    return Costs(motion.name, float(tolerance), (*options, *unfit), share_of)


def candidates(
    model: Model, state: State, groups: Mapping[str, Iterable[str]], feet: Sequence[Contact]
) -> list[Candidate]:
    """Return the templates, and the full model with each group of joints held where the motion begins."""
    (q, v, a), about = state, center_of_mass(model, state[0])
    tried = [_template(name, kind, model, state, feet) for name, kind in TEMPLATES.items()]
    for name, joints in groups.items():
        small = lock_joints(model, joints, q[0])
        leaves_out = f"The motion of {len(small.held)} of {len(_movable(model))} joints."
        known = (q[..., small.kept_q], v[..., small.kept_v], a[..., small.kept_v])
        if model.base == "floating":
            tried.append(Candidate(name, leaves_out, Full.of(small.model, known[0][0]), known))
        elif small.model.nv == 0:
            tried.append(Candidate(name, leaves_out, None, known, "nothing is left to move"))
        else:
            tried.append(Candidate(name, leaves_out, Anchored(small.model, about), known))
    return tried


def _template(name: str, kind: type[Template], model: Model, state: State, feet: Sequence[Contact]) -> Candidate:
    """Return a template, or why it does not apply to this robot."""
    if kind is Full:
        return Candidate(name, kind.assumes, _whole(model, state), state)
    try:
        if kind is LinearPendulum and feet and not model.feet:
            pendulum = LinearPendulum.of(model, state[0][0], height=_height(model, state[0][0], feet))
            return Candidate(name, kind.assumes, pendulum, state)
        return Candidate(name, kind.assumes, kind.of(model, state[0][0]), state)
    except ValueError as error:
        return Candidate(name, kind.assumes, None, state, str(error))


def _height(model: Model, q: Array, feet: Sequence[Contact]) -> float:
    """Return how far the centre of mass is above the lowest point that touches, against gravity, m."""
    places = [(c, frame_placement(model, q, c.frame)) for c in feet]
    points = np.concatenate([T.translation + c.points @ c.axes(T.rotation).mT for c, T in places])
    up = -model.gravity / max(float(np.sqrt(model.gravity @ model.gravity)), np.finfo(float).tiny)
    return float(((center_of_mass(model, q) - points) @ up).max())


def _whole(model: Model, state: State) -> Template | Anchored:
    """Return the model that all others are held against."""
    return Full.of(model, state[0][0]) if model.base == "floating" else Anchored(model, center_of_mass(model, state[0]))


def _scale(whole: Template | Anchored, q: Array, true: Array) -> tuple[float, float, str]:
    """Return the force, N, and the length, m, that wrenches are compared with, and what the force is."""
    model = whole.model
    length = whole.length if isinstance(whole, Template) else radius_of_gyration(model, q)
    weight = model.mass * float(np.sqrt((model.gravity**2).sum()))
    if weight > 0:
        return weight, length, "the weight"
    largest = float(Residual(true[..., :3], true[..., 3:], 1.0, length).relative.max(initial=0))
    return largest or 1.0, length, "the largest ḣ_G of the motion"


def _movable(model: Model) -> range:
    """Return the bodies whose joints can be held: all but a floating base."""
    return range(2 if model.base == "floating" else 1, model.nbodies)


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
    busy = {*range(_movable(model).start), *(i for name in feet for i in model.support(model.frame(name).body))}
    heads = [
        i
        for i in range(1, model.nbodies)
        if i not in busy and (model.parent[i] in busy or model.parent.count(model.parent[i]) > 1)
    ]
    outboard = {head: [i for i in range(1, model.nbodies) if head in model.support(i)] for head in heads}
    return {model.joint_names[head]: tuple(model.joint_names[i] for i in bodies) for head, bodies in outboard.items()}

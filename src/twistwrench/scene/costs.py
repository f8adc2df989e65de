"""What does it cost to leave this out? Error and time of each smaller model over a motion, and the best that will do.

All models answer one question: which wrench the ground and the weight together must exert on the robot for the motion
to happen, ḣ_G. The templates of 49.10 answer no other; a robot with held joints tells the torques of the rest as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ..checks import Array, as_number
from ..clock import round_robin
from ..model import Model
from ..motions import Motion
from ..reduction import lock_joints
from ..templates import TEMPLATES, Residual
from ..templates.template import Template, full_rate
from ..templates.whole import Full

__all__ = ["Costs", "Option", "costs", "limbs"]


@dataclass(frozen=True)
class Option:
    """A model that could take the place of the full one, and what that costs.

    Attributes
    ----------
    name : str
        Of the template, or of the joints that are held.
    leaves_out : str
        What it takes for granted.
    tells_torques : bool
        Whether it tells joint torques, and not only ḣ_G.
    residual : ndarray, shape (n,)
        At each state of the motion, the wrench that it misses as a share of the weight (`Residual.relative`).
    seconds : float
        For one state, when all states are done at once.
    """

    name: str
    leaves_out: str
    tells_torques: bool
    residual: Array
    seconds: float

    @property
    def worst(self) -> float:
        """The largest residual over the motion."""
        return float(self.residual.max())


@dataclass(frozen=True)
class Costs:
    """What `Scene.cheapest` returns: every option, the quickest first, and the choice. Printed, it is a table.

    Attributes
    ----------
    motion : str
    tolerance : float
        The largest residual that is allowed, as a share of the weight.
    options : tuple of Option
    """

    motion: str
    tolerance: float
    options: tuple[Option, ...]

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
        ]
        head = f"  {'model':{width}}    median     worst     µs/state  tells   leaves out"
        title = f"{self.motion}: wrench missed, as a share of the weight; tolerance {self.tolerance:.1e}"
        return "\n".join([title, head, *(row.rstrip() for row in rows)])

    def plot(self, ax: Any = None) -> Any:
        """Draw time over error: what is left of the line will do, and the lowest of that is the choice.

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


class Candidate(NamedTuple):
    """A model to be tried, and the states of the motion as it knows them."""

    name: str
    leaves_out: str
    template: Template
    state: tuple[Array, Array, Array]


def costs(model: Model, motion: Motion, tolerance: float, groups: Mapping[str, Iterable[str]]) -> Costs:
    """Do what `Scene.cheapest` says, for a model with a floating base."""
    if not as_number(tolerance, "tolerance") >= 0:
        raise ValueError(f"tolerance: expected a share of the weight, 0 or more, got {tolerance!r}")
    q, v, a = model.state(motion.q, v=motion.v, a=motion.a)
    true, size = full_rate(model, q, v, a), Full.of(model, q[0])
    tried = candidates(model, q, v, a, groups)
    known = [one.template.read(*one.state) for one in tried]
    laps = round_robin([partial(one.template.law, *x) for one, x in zip(tried, known)], rounds=7, least=0)
    options = []
    for one, x, lap in zip(tried, known, laps):
        e = one.template.law(*x) - true
        residual = Residual(e[..., :3], e[..., 3:], size.weight, size.length).relative
        seconds = float(lap.seconds.min()) / len(q)
        options.append(Option(one.name, one.leaves_out, isinstance(one.template, Full), residual, seconds))
    return Costs(motion.name, float(tolerance), tuple(sorted(options, key=lambda option: option.seconds)))


def candidates(model: Model, q: Array, v: Array, a: Array, groups: Mapping[str, Iterable[str]]) -> list[Candidate]:
    """Return the templates, and the full model with each group of joints held where the motion begins."""
    tried = [Candidate(name, kind.assumes, kind.of(model, q[0]), (q, v, a)) for name, kind in TEMPLATES.items()]
    for name, joints in groups.items():
        small = lock_joints(model, joints, q[0])
        leaves_out = f"The motion of {len(small.held)} of {model.nbodies - 2} joints."
        state = (q[..., small.kept_q], v[..., small.kept_v], a[..., small.kept_v])
        tried.append(Candidate(name, leaves_out, Full.of(small.model, state[0][0]), state))
    return tried


def limbs(model: Model, feet: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """Return the limbs that do not touch the ground: by the joint that each hangs on, that one and all beyond.

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
    busy = {0, 1, *(i for name in feet for i in model.support(model.frame(name).body))}
    heads = [
        i
        for i in range(1, model.nbodies)
        if i not in busy and (model.parent[i] in busy or model.parent.count(model.parent[i]) > 1)
    ]
    beyond = {head: [i for i in range(1, model.nbodies) if head in model.support(i)] for head in heads}
    return {model.joint_names[head]: tuple(model.joint_names[i] for i in bodies) for head, bodies in beyond.items()}

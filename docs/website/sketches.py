"""The pictures of the list of algorithms: what each gives a Go2 that walks off, drawn when the site is built."""

from __future__ import annotations

from html import escape

import numpy as np

import twistwrench as tw
from twistwrench.plot.robot import sticks

from .handled import walk
from .thumbnails import HIGH, SVG, WIDE, pose

SAYS = {
    "kinematics": {"en": "where each body is, how it moves", "zh": "各刚体在哪里、怎样运动"},
    "rnea": {"en": "wrenches, on their way in", "zh": "向内传递的 wrench"},
    "aba": {"en": "one torque: how all accelerate", "zh": "一个力矩，全身的加速度"},
    "crba": {"en": "the entries of M that are not 0", "zh": "M 中不为零的元素"},
    "centroidal": {"en": "momentum at the centre of mass", "zh": "质心处的动量"},
}
LONGEST = 0.6
"""An arrow, as a share of what `pose` draws for the weight."""


def sketch(name: str, language: str) -> str:
    """Return the picture of an algorithm."""
    says = escape(SAYS[name][language])
    return SVG.format(wide=WIDE, high=HIGH, middle=WIDE // 2, low=HIGH - 4, label=says, says=says, drawn=_drawn(name))


def _drawn(name: str) -> str:
    model, q, v, a, _, ground = walk()
    if name == "crba":
        return _pattern(tw.crba(model, q))
    motion = tw.forward_kinematics(model, q, v, a)
    if name == "centroidal":
        G, h = tw.center_of_mass(model, q), tw.centroidal_momentum(model, q, v)
        return pose(sticks(model, q), _arrows([G, G], [h[3:] / 15, h[:3]]))
    if name == "aba":
        torque = tw.static_equilibrium(model, q).tau
        tau = np.concatenate([np.zeros(6), torque]) if torque.shape == (model.nv - 6,) else torque
        tau[7] += 10.0  # N m, at the thigh of the left front leg
        motion = tw.forward_kinematics(model, q, v, tw.aba(model, q, v, tau))
    parts = {"kinematics": motion.twist, "aba": motion.acceleration, "rnea": tw.joint_wrenches(model, q, v, a, ground)}
    six = parts[name]
    assert six is not None
    bodies = range(1, model.nbodies)
    at = [motion.placement[i].translation for i in bodies]
    return pose(sticks(model, q), _arrows(at, [motion.placement[i].rotation @ six[i, 3:] for i in bodies]))


def _arrows(at: list[np.ndarray], along: list[np.ndarray]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return arrows of which the longest has the same length in every picture."""
    longest = max(float(np.linalg.norm(x)) for x in along)
    return [(p, LONGEST * x / longest) for p, x in zip(at, along, strict=True) if np.linalg.norm(x) > 0.02 * longest]


def _pattern(M: np.ndarray) -> str:
    """Return the entries of a matrix that are not zero, as squares."""
    side = (HIGH - 20) / len(M)
    squares = [
        f'<path d="M{(WIDE - side * len(M)) / 2 + j * side:.1f} {i * side + 2:.1f}h{side - 1:.1f}v{side - 1:.1f}'
        f'h-{side - 1:.1f}z" fill="currentColor"/>'
        for i, j in np.argwhere(np.abs(M) > 1e-12 * np.abs(M).max())
    ]
    return "".join(squares)

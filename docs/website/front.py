"""What moves on the front page: the RNEA of a Go2 line by line, and a Go2 that trots on the forces of the ground."""

from __future__ import annotations

from functools import cache

import numpy as np

import twistwrench as tw
from twistwrench.motions.support import needs
from twistwrench.plot.robot import sticks
from twistwrench.plot.stride import sides
from twistwrench.tracing.stepper import stepper

from . import handled
from .film import NEWTONS, film, millimetres

__all__ = ["hero", "trot"]

FRAMES = 48

WORDS = {
    "en": {
        "seen": "A Go2 that trots, with the forces that the ground exerts on its feet",
        "says": "Left legs are blue, right legs orange; the arrows are the forces of the ground. "
        "The package computed the gait and the forces.",
    },
    "zh": {
        "seen": "一台小跑的 Go2，以及地面对各足的力",
        "says": "左腿为蓝色，右腿为橙色，箭头是地面的力；步态和力都由本程序包算出。",
    },
}


HELD = {
    "en": ("Go2 walks off, held by its base in the air", "Go2 walks off on three feet, the ground carries it"),
    "zh": ("Go2 迈步，被拎着基座悬空", "Go2 用三只脚迈步，由地面支撑"),
}


def hero(language: str) -> str:
    """Return the RNEA on a Go2, from line to line, as a block of HTML."""
    model, q, v, a, _, ground = handled.walk()
    held = [tw.trace(model, "rnea", q, v, a, f_ext=f_ext) for f_ext in (None, ground)]
    return f"```{{raw}} html\n{stepper(dict(zip(HELD[language], held)), language, playing=True)}\n```"


def trot(language: str) -> str:
    """Return the picture as a block of HTML."""
    return film(language, stride(), **WORDS[language])


@cache
def stride() -> dict[str, object]:
    """Return one stride: the sticks of each frame, the feet with their forces, in mm, and how far the robot comes."""
    model = tw.load("go2")
    motion = tw.motions.trot(model, samples=FRAMES + 1)
    forces = needs(model, motion).forces
    frames, arrows, gone = [], [], []
    for k in range(FRAMES):
        q = motion.q[k]
        at = np.array([q[0], q[1], 0.0])
        frames.append(millimetres(sticks(model, q) - at))
        feet = [tw.frame_placement(model, q, foot).translation - at for foot in motion.feet]
        arrows.append(millimetres(np.stack([np.stack([p, p + f / NEWTONS]) for p, f in zip(feet, forces[k])])))
        gone.append(round(1000 * float(q[0] - motion.q[0, 0])))
    return {
        "sticks": frames,
        "forces": arrows,
        "sides": sides(model).tolist(),
        "gone": gone,
        "length": round(1000 * float(motion.q[-1, 0] - motion.q[0, 0])),
        "seconds": round(float(motion.t[-1]), 3),
        "pace": 0.6,
        "wide": 950,
    }

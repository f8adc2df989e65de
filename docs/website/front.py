"""The robot of the front page: a Go2 that trots, with the forces of the ground, drawn by a few lines in the page."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

import twistwrench as tw
from twistwrench.plot.robot import sticks
from twistwrench.plot.stride import sides
from twistwrench.study.budget.needs import needs

__all__ = ["trot"]

FRAMES = 48
NEWTONS = 600
"""So many newtons are drawn as a metre."""

WORDS = {
    "en": {
        "seen": "A Go2 that trots, with the forces that the ground exerts on its feet",
        "turn": "Drag, or use the arrow keys, to look from elsewhere.",
        "play": "Play",
        "pause": "Pause",
        "says": "The package computed all of it: the gait, and the forces on the feet.",
    },
    "zh": {
        "seen": "一台小跑的 Go2，以及地面对各足的力",
        "turn": "拖动或用方向键换个角度看。",
        "play": "播放",
        "pause": "暂停",
        "says": "图中每个数都由本包算出：步态和足底的力。",
    },
}


def trot(language: str) -> str:
    """Return the picture as a block of HTML."""
    text = (Path(__file__).parent / "front.html").read_text(encoding="utf-8")
    for name, word in WORDS[language].items():
        text = text.replace(f"${name}$", word)
    return f"```{{raw}} html\n{text.replace('$data$', json.dumps(stride(), separators=(',', ':')))}```"


def stride() -> dict[str, object]:
    """Return one stride: the sticks of each frame, the feet with their forces, in mm, and how far the robot comes."""
    model = tw.load("go2")
    motion = tw.motions.trot(model, samples=FRAMES + 1)
    forces = needs(model, motion).forces
    frames, arrows = [], []
    for k in range(FRAMES):
        q = motion.q[k]
        at = np.array([q[0], q[1], 0.0])
        frames.append(_millimetres(sticks(model, q) - at))
        feet = [tw.frame_placement(model, q, foot).translation - at for foot in motion.feet]
        arrows.append(_millimetres(np.stack([np.stack([p, p + f / NEWTONS]) for p, f in zip(feet, forces[k])])))
    length = 1000 * (motion.q[-1, 0] - motion.q[0, 0])
    return {
        "sticks": frames,
        "forces": arrows,
        "sides": sides(model).tolist(),
        "length": round(float(length)),
        "seconds": round(float(motion.t[-1]), 3),
    }


def _millimetres(x: np.ndarray) -> list[int]:
    return np.rint(1000 * x).astype(int).ravel().tolist()

"""Films in a page: a robot as sticks, the forces of the ground, their friction cones and the polygon of what touches.

A page says ``<!-- film: NAME -->`` after a block of its code that gives this name to what `tw.simulate` returns. Its
blocks are run once for both languages, and the lines of film.html draw the motion. Elsewhere the mark is not seen.
"""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench.plot.robot import sticks
from twistwrench.plot.stance import hull
from twistwrench.plot.stride import sides

__all__ = ["NEWTONS", "film", "millimetres", "moving", "with_films"]

NEWTONS = 600
"""So many newtons are drawn as a metre."""

RATE = 20
"""Pictures in a second."""

MARK = re.compile(r"<!-- film: (\w+) -->")
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)

WORDS = {
    "en": {
        "seen": "A robot in motion, with the forces of the ground",
        "turn": "Drag, or press the arrow keys, to turn the view.",
        "play": "Play",
        "pause": "Pause",
        "says": "The motion of this block, with the forces of the ground, their cones and the polygon of what touches.",
    },
    "zh": {
        "seen": "运动中的机器人，以及地面的力",
        "turn": "拖动或按方向键可切换视角。",
        "play": "播放",
        "pause": "暂停",
        "says": "这段代码的运动：地面的力、它们的摩擦锥，以及接触处围成的多边形。",
    },
}


def film(language: str, data: dict[str, Any], **words: str) -> str:
    """Return a film as a block of HTML."""
    text = (Path(__file__).parent / "film.html").read_text(encoding="utf-8")
    for name, word in (WORDS[language] | words).items():
        text = text.replace(f"${name}$", word)
    return f"```{{raw}} html\n{text.replace('$data$', json.dumps(data, separators=(',', ':')))}```"


def with_films(text: str, page: Path, language: str) -> str:
    """Return the text of a page with its films; `page` is the file in English, whose code is run."""
    if not MARK.search(text):
        return text
    return MARK.sub(lambda found: film(language, motions(page)[found[1]]), text)


@cache  # for both languages
def motions(page: Path) -> dict[str, dict[str, Any]]:
    """Run the blocks of a page, and return the films that it asks for."""
    text, names = page.read_text(encoding="utf-8"), dict[str, Any]()
    for block in BLOCK.findall(text):
        exec(compile(block, str(page), "exec"), names)
    return {name: moving(names[name]) for name in MARK.findall(text)}


def moving(motion: tw.simulation.Simulation) -> dict[str, Any]:
    """Return the pictures of a motion on the ground, in mm: of each the sticks, the forces, and what touches."""
    model, stepping = motion.model, motion.system.stepping
    assert stepping is not None
    every, high = max(1, round(1 / (RATE * motion.system.dt))), tw.center_of_mass(model, motion.q[0])[2]
    frames, arrows, polygons, gone = list[Any](), list[Any](), list[Any](), list[float]()
    for k in range(0, len(motion.t) - 1, every):
        q = motion.q[k + 1]
        at = np.array([q[0], q[1], stepping.ground.height])
        T = tw.contact_placements(model, q, stepping.contacts)
        points = np.concatenate([T[c.frame].act(c.points) for c in stepping.contacts]) - at
        forces = stepping.forces[k] @ stepping.ground.axes
        frames.append(millimetres(sticks(model, q) - at))
        arrows.append(millimetres(np.stack([points, points + forces / NEWTONS], axis=1)))
        touching = points[forces[:, 2] > 0]
        polygons.append(millimetres(hull(touching)) if len(touching) else [])
        gone.append(round(1000 * float(q[0])))
    return {
        "sticks": frames,
        "forces": arrows,
        "polygons": polygons,
        "mu": float(stepping.mu.max()),
        "sides": sides(model).tolist(),
        "gone": gone,
        "length": 0,
        "seconds": round(float(motion.t[-1] - motion.t[0]), 3),
        "pace": 1,
        "wide": round(4500 * float(high)),
    }


def millimetres(x: np.ndarray) -> list[int]:
    """Return lengths in whole millimetres."""
    return np.rint(1000 * x).astype(int).ravel().tolist()

"""The controls of the page: a slider for each joint, or one for the time."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from ..arrays import Array
from .state import Subject

__all__ = ["add_joints", "add_time"]

MAX_OPEN_SLIDERS = 20
"""The sliders of more joints than these are folded away at first."""

PICTURES_PER_S = 30
"""A second, while it plays."""


def add_joints(gui: Any, seen: Subject, show: Callable[[Array], None]) -> None:
    """Add a slider for each joint whose q is one angle or one length.

    Parameters
    ----------
    gui : viser.GuiApi
    seen : Subject
        Where the sliders start.
    show : callable
        Shows a configuration.
    """
    model = seen.model
    q = np.array(seen.q)

    def follow(s: slice) -> Callable[[Any], None]:
        def moved(event: Any) -> None:
            q[s] = event.target.value
            show(q.copy())

        return moved

    with gui.add_folder("Joints", expand_by_default=model.nv < MAX_OPEN_SLIDERS):
        for name, joint, s in zip(model.joint_names, model.joints, model.q_slice):
            if joint is not None and joint.nq == joint.nv == 1:
                now = float(q[s][0])
                low, high = (float(limit[s][0]) for limit in (model.lower, model.upper))
                low = min(now, max(low, -np.pi))  # π is also as far as a slider without limits goes, in rad or m
                high = max(now, min(high, np.pi), low + 1e-3)
                gui.add_slider(name, low, high, (high - low) / 1000, now).on_update(follow(s))


def add_time(gui: Any, t: Array, show: Callable[[int], None]) -> Any:
    """Add a slider for the time, and a box that lets it run.

    Parameters
    ----------
    gui : viser.GuiApi
    t : ndarray, shape (n,)
        Times of the configurations, s.
    show : callable
        Shows configuration k.

    Returns
    -------
    viser.GuiCheckboxHandle
        The box: while its value is true, it plays.
    """
    first = float(t[0])
    last = float(t[-1])
    slider = gui.add_slider("time [s]", first, last, (last - first) / 1000, first)
    runs = gui.add_checkbox("play", initial_value=False)

    def moved(event: Any) -> None:
        show(int(np.searchsorted(t, event.target.value, side="right")) - 1)

    def play() -> None:
        while runs.value:
            later = slider.value + 1 / PICTURES_PER_S
            slider.value = later if later <= last else first
            time.sleep(1 / PICTURES_PER_S)

    def run(event: Any) -> None:
        if event.target.value:
            threading.Thread(target=play, daemon=True).start()  # ends with the process, at the latest

    slider.on_update(moved)
    runs.on_update(run)
    return runs

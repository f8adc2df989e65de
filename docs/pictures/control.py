"""The picture of docs/control.md: its own blocks are run, and what they leave is drawn.

usage:  python docs/pictures/control.py        (some seconds; needs matplotlib)
"""

import re
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from twistwrench.plot import COLOURS

mpl.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).parent
PAGE = HERE.parent / "control.md"


def motions() -> dict[str, Any]:
    """Run the blocks of the page, and return what they define."""
    names: dict[str, Any] = {}
    for block in re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
        exec(compile(block, str(PAGE), "exec"), names)
    return names


def draw(names: dict[str, Any]) -> None:
    """Draw the angles of the first two, and of the third the height and what its feet carry."""
    raised, up, landing, model = (names[name] for name in ("raised", "up", "landing", "model"))
    figure, axes = plt.subplots(2, 3, figsize=(12, 5), sharex="col", constrained_layout=True)
    axes[0, 0].plot(raised.t, raised.q[:, 0], color=COLOURS["blue"])
    axes[0, 0].axhline(np.pi / 2, color=COLOURS["grey"], lw=0.8)
    axes[0, 0].set(title="pendulum", ylabel="angle [rad]")
    axes[1, 0].step(raised.t[:-1], raised.tau[:, 0], color=COLOURS["vermilion"])
    axes[1, 0].axhline(raised.model.effort_limit[0], color=COLOURS["grey"], lw=0.8)
    axes[1, 0].set(ylabel="τ and its limit [N m]")
    axes[0, 1].plot(up.t, up.q[:, 1], color=COLOURS["blue"])
    for upright in (0, 2 * np.pi):
        axes[0, 1].axhline(upright, color=COLOURS["grey"], lw=0.8)
    axes[0, 1].set(title="cart-pole", ylabel="angle from upright [rad]")
    axes[1, 1].plot(up.t, up.q[:, 0], color=COLOURS["green"])
    axes[1, 1].set(ylabel="cart [m]")
    axes[0, 2].plot(landing.t, landing.q[:, 2], color=COLOURS["blue"])
    axes[0, 2].set(title="Go2", ylabel="height of the base [m]")
    for foot, colour in (("FL_foot", "green"), ("RL_foot", "vermilion")):  # those on the right do the same
        axes[1, 2].step(landing.t[:-1], landing.contact_forces[foot][:, 2], color=COLOURS[colour], label=foot)
    axes[1, 2].axhline(9.81 * model.mass / 4, color="black", lw=0.8, ls=":")
    axes[1, 2].set(ylabel="normal force [N]")
    axes[1, 2].legend(fontsize="small")
    for ax in axes[1]:
        ax.set_xlabel("time [s]")
    figure.savefig(HERE / "control.png", dpi=100)


if __name__ == "__main__":
    draw(motions())

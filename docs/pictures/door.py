"""The first picture of README: a formula, its line of code, its six numbers and its arrow, on light and on dark.

usage:  python docs/pictures/door.py            (two seconds; needs matplotlib)
"""

import inspect
import re
import tomllib
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser

import twistwrench as tw
from twistwrench.algorithms.rnea import newton_euler
from twistwrench.plot import COLOURS, robot
from twistwrench.plot.frames import arrows

HERE = Path(__file__).parent
STEP = "49.6 F_p"
SCALE = 0.0014  # m for 1 N
INKS = {
    "light": ("#ffffff", "#1f2328", "#59636e", COLOURS["blue"]),
    "dark": ("#0d1117", "#f0f6fc", "#9198a1", COLOURS["sky"]),
}
"""The page, light or dark; and on it the words, the robot and the arrows."""


def formula() -> str:
    """Return the formula of the step, as the site shows it beside the line."""
    page = tomllib.loads((HERE.parent / "website/algorithms/rnea.toml").read_text(encoding="utf-8"))
    (tex,) = (step["tex"] for part in page["part"] for step in part["step"] if step["at"] == STEP)
    MathTextParser("path").parse(f"${tex}$")  # an error names what cannot be set
    return f"${tex}$"


def line() -> str:
    """Return the line of the package that carries out the step."""
    (found,) = re.findall(rf"^ *(.*\S) +# {re.escape(STEP)}:", inspect.getsource(newton_euler), re.MULTILINE)
    return str(found)


def draw(page: str, ink: str, sticks: str, arrow: str) -> Figure:
    """Draw Go2, held at its trunk: each joint carries what hangs beyond it, and the trunk the whole weight."""
    model = tw.load("go2")
    q, rest = model.standing(), np.zeros(model.nv)
    F = tw.joint_wrenches(model, q, rest, rest)
    placements = tw.forward_kinematics(model, q).placement
    places = np.array([T.translation for T in placements[1:]])
    forces = np.array([T.rotation @ wrench[3:] for T, wrench in zip(placements[1:], F[1:])])

    figure = Figure(figsize=(10.0, 4.2), facecolor=page)
    ax = figure.add_axes((0.45, -0.19, 0.58, 1.42), projection="3d")
    robot(model, q, com=False, colour=sticks, ax=ax)
    for dots in ax.lines:
        dots.set_markerfacecolor(ink)
        dots.set_markeredgecolor(ink)
    texts = [f"{forces[0, 2]:.1f} N", *[""] * (len(forces) - 1)]
    arrows(places, forces, scale=SCALE, colour=arrow, texts=texts, ax=ax)
    ax.texts[0].set(color=arrow, fontsize=13)
    ax.set_axis_off()
    ax.view_init(elev=14, azim=-62)
    ax.patch.set_alpha(0)
    for drawn in ax.collections:
        drawn.set_linewidth(2.5)

    figure.text(0.03, 0.78, formula(), fontsize=26, color=ink)
    figure.text(0.03, 0.55, line(), fontsize=15, family="monospace", color=ink)
    for k, number in enumerate(F[1]):  # of the trunk
        figure.text(0.07 + 0.065 * k + 0.02 * (k > 2), 0.33, f"{number + 0.0:.1f}", fontsize=14, color=ink, ha="center")
    for x, unit in ((0.135, "τ [N m]"), (0.35, "f [N]")):
        figure.text(x, 0.24, unit, fontsize=11, color=sticks, ha="center")
    return figure


def main() -> None:
    """Write both pictures, the same bytes in each run."""
    with mpl.rc_context({"svg.hashsalt": "door", "mathtext.fontset": "cm"}):
        for name, inks in INKS.items():
            draw(*inks).savefig(HERE / f"door_{name}.svg", metadata={"Date": None, "Creator": None})


if __name__ == "__main__":
    main()

"""The picture of docs/contacts.md: Go2 pushes itself forwards, with and without friction cones.

usage:  python docs/pictures/contacts.py        (a few seconds; needs matplotlib and daqp)
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import twistwrench as tw
from twistwrench.plot import COLOURS

HERE = Path(__file__).parent
MU = 0.6
GO2 = tw.load("go2")
STAND, REST = GO2.standing(), np.zeros(GO2.nv)
FEET = [tw.PointContact(foot, MU) for foot in GO2.feet]
SIDE = {"FR_foot": "front", "RR_foot": "rear"}


def forces(forward: float, *, cones: bool) -> dict[str, np.ndarray] | None:
    """Return the forces of the ground at an acceleration forwards, m/s²; None where no forces within the cones do."""
    a = REST.copy()
    a[3] = forward
    if not cones:
        return tw.contact_inverse_dynamics(GO2, STAND, REST, a, FEET).forces
    try:
        return tw.friction_inverse_dynamics(GO2, STAND, REST, a, FEET, sides=16).forces
    except tw.SingularError:
        return None


def side_view(ax, forward: float) -> None:
    """Draw the right feet from the side, their cones, and the forces at one acceleration."""
    least, within = forces(forward, cones=False), forces(forward, cones=True)
    for foot in SIDE:
        x, _, z = tw.frame_placement(GO2, STAND, foot).translation
        height, scale = 0.15, 0.003
        ax.fill(
            [x, x - MU * height, x + MU * height], [z, z + height, z + height], color=COLOURS["sky"], alpha=0.3, lw=0
        )
        for f, colour, style in ((least, COLOURS["vermilion"], "--"), (within, COLOURS["blue"], "-")):
            tip = (x + scale * f[foot][0], z + scale * f[foot][2])
            ax.annotate("", tip, (x, z), arrowprops={"arrowstyle": "-|>", "color": colour, "ls": style, "lw": 2})
        ax.annotate(SIDE[foot], (x, z), xytext=(0, -16), textcoords="offset points", ha="center")
    G = tw.center_of_mass(GO2, STAND)
    ax.plot(G[0], G[2], "o", color=COLOURS["purple"])
    ax.annotate("centre of mass", (G[0], G[2]), xytext=(0, 8), textcoords="offset points", ha="center")
    ax.axhline(0, color="0.3", lw=1)
    ax.plot([], [], "--", color=COLOURS["vermilion"], lw=2, label="least forces of all")
    ax.plot([], [], color=COLOURS["blue"], lw=2, label="least within the cones")
    ax.legend(loc="upper center", ncols=2, frameon=False)
    ax.set(xlim=(-0.4, 0.4), ylim=(-0.06, 0.4), aspect="equal", xlabel="x [m]", ylabel="z [m]")
    ax.set_title(f"right feet, {forward:g} m/s² forwards")


def shares(ax) -> None:
    """Draw how much of its normal force each foot pushes along the ground."""
    pushes = np.linspace(0, 6, 61)
    for cones, colour in ((False, COLOURS["vermilion"]), (True, COLOURS["blue"])):
        found = [(a, f) for a in pushes if (f := forces(a, cones=cones)) is not None]
        for foot, style in zip(SIDE, ("-", ":"), strict=True):
            share = [np.hypot(*f[foot][:2]) / f[foot][2] for _, f in found]
            label = f"{SIDE[foot]}, {'within the cones' if cones else 'least of all'}"
            ax.plot([a for a, _ in found], share, style, color=colour, lw=2, label=label)
    ax.axhline(MU, color="0.4", lw=1)
    ax.annotate("μ", (0.1, MU), xytext=(0, 4), textcoords="offset points")
    ax.axvline(MU * 9.81, color="0.4", lw=1, ls=":")
    ax.annotate("μ g", (MU * 9.81, 0.02), xytext=(-4, 0), textcoords="offset points", ha="right")
    ax.legend(frameon=False, loc="upper left", bbox_to_anchor=(0.08, 1.0), fontsize=9)
    ax.set(xlim=(0, 6.2), ylim=(0, 1.2), xlabel="acceleration forwards [m/s²]", ylabel="√(f_x² + f_y²) / f_z")
    ax.set_title("friction used by each foot")


def main() -> None:
    """Write the picture."""
    figure = Figure(figsize=(10, 3.9), layout="constrained")
    left, right = figure.subplots(1, 2)
    side_view(left, 5.0)
    shares(right)
    figure.savefig(HERE / "contacts.png", dpi=110)


if __name__ == "__main__":
    main()

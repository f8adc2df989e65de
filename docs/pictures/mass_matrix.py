"""The pictures of docs/mass_matrix.md: which entries of L are not zero, in both orders of elimination.

usage:  python docs/pictures/mass_matrix.py        (a second; needs matplotlib)
"""

from pathlib import Path

from matplotlib.figure import Figure

import twistwrench as tw
from twistwrench.plot import fill_in

HERE = Path(__file__).parent


def main() -> None:
    """Draw Go2 and the humanoid side by side."""
    figure = Figure(figsize=(13, 6), layout="constrained")
    for ax, name in zip(figure.subplots(1, 2), ("go2", "humanoid"), strict=True):
        fill_in(tw.load(name), name, ax=ax)
    figure.savefig(HERE / "mass_matrix_fill_in.png", dpi=110)


if __name__ == "__main__":
    main()

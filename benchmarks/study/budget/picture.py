"""The picture of ``python -m benchmarks.study budget``: a row for each source, both scales in powers of ten."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from twistwrench.files import replacing
from twistwrench.plot.style import COLOURS

from . import Source

__all__ = ["draw"]

KINDS = {"number": "green", "time": "blue", "model": "orange", "state": "purple", "slip": "vermilion"}


def draw(sources: Sequence[Source], path: Path, *, title: str = "") -> None:
    """Draw the torque and the centre of pressure of each source.

    Parameters
    ----------
    sources : sequence of Source
    path : Path
        A png, svg or pdf.
    title : str
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 0.6 + 0.27 * len(sources)), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for ax, field, label in zip(axes, ("torque", "pressure"), ("worst motor [N m]", "centre of pressure [mm]")):
        for row, source in enumerate(sources):
            ax.plot(getattr(source, field), row, "o", color=COLOURS[KINDS[source.kind]])
        ax.set(xscale="log", xlabel=label)
        ax.grid(axis="both", color="0.9")
        ax.set_axisbelow(True)
    axes[0].set_yticks(range(len(sources)), [source.name for source in sources])
    axes[0].invert_yaxis()
    figure.suptitle(title)
    with replacing(path) as beside:
        figure.savefig(beside, dpi=110)

"""The picture of ``python -m benchmarks.study templates``: k̇_G and the residuals over each motion."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench.files import replacing
from twistwrench.motions import Motion
from twistwrench.plot.style import COLOURS, XYZ
from twistwrench.templates import TEMPLATES

__all__ = ["draw"]

LINES = {
    "point_mass": (COLOURS["blue"], "-"),
    "lipm": (COLOURS["orange"], "--"),
    "srbm_frozen": (COLOURS["sky"], ":"),
    "srbm": (COLOURS["vermilion"], "-"),
}
LEAST = 1e-4
"""Where the axis of the residuals begins. Smaller ones are outside the picture, and a note gives their size."""


def draw(model: tw.Model, motions: Sequence[Motion], path: Path) -> None:
    """Draw k̇_G above and the residuals of the templates below, a column for each motion.

    Parameters
    ----------
    model : Model
    motions : sequence of Motion
    path : Path
        A png, svg or pdf.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 5.2), layout="constrained")
    axes = figure.subplots(2, len(motions), squeeze=False, sharey="row")
    for column, motion in zip(np.moveaxis(axes, 1, 0), motions):
        rates(model, motion, column[0])
        residuals(model, motion, column[1])
    axes[0, 0].set_ylabel("k̇_G / weight [mm]")
    axes[1, 0].set_ylabel("left out of ḣ_G / weight")
    axes[0, 0].legend(loc="upper left", ncols=3, fontsize=8)
    figure.legend(*axes[1, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(LINES), fontsize=9)
    with replacing(path) as beside:
        figure.savefig(beside, dpi=110)


def rates(model: tw.Model, motion: Motion, ax: Any) -> None:
    """Draw k̇_G over the weight, a length: where the load is the weight, the shift of the centre of pressure."""
    rate = tw.centroidal_momentum_rate(model, motion.q, motion.v, motion.a)[:, :3]
    weight = model.mass * np.sqrt((model.gravity**2).sum())
    for k, (name, colour) in enumerate(zip("xyz", XYZ)):
        ax.plot(motion.t, 1e3 * rate[:, k] / weight, color=colour, label=name)
    largest = 1e3 * np.sqrt((rate**2).sum(axis=1)).max() / weight
    ax.text(0.97, 0.93, f"largest {largest:.3g} mm", ha="right", va="top", transform=ax.transAxes, fontsize=8)
    if _flight(motion, ax):
        ax.text(0.5, 0.05, "flight", ha="center", transform=ax.transAxes, fontsize=8)
    ax.set_title(motion.name)


def residuals(model: tw.Model, motion: Motion, ax: Any) -> None:
    """Draw the relative residuals of the templates, on a logarithmic scale."""
    below = []
    for name, (colour, line) in LINES.items():
        relative = TEMPLATES[name].of(model, model.standing()).residual(motion.q, motion.v, motion.a).relative
        ax.semilogy(motion.t, relative, line, color=colour, label=name)
        if relative.min() < LEAST:
            below.append(f"{name} {relative.min():.0e}")
    if below:
        text = "\n".join(["below the picture, down to", *below])
        ax.text(0.5, 0.04, text, ha="center", va="bottom", transform=ax.transAxes, fontsize=7)
    _flight(motion, ax)
    ax.set(xlabel="t [s]", ylim=(LEAST, 5))


def _flight(motion: Motion, ax: Any) -> bool:
    """Shade the times when no foot stands; return whether there are any."""
    flies = motion.t[~motion.contacts.any(axis=1)]
    if len(flies):
        ax.axvspan(flies[0], flies[-1], color=COLOURS["grey"], alpha=0.2, linewidth=0)
    return len(flies) > 0

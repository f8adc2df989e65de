"""Draw the results of speed.py: results/batch.png and results/links.png.

python benchmarks/plots.py
"""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from study.speed import QUANTITIES
from tables import RANGES, Row, growth, rows

RESULTS = Path(__file__).parent / "results"
BLUE, ORANGE, GREEN, GREY, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#7F7F7F", "#CC79A7", "#56B4E9"


def line(ax: Axes, found: list[Row], x: str, y: str, **style) -> None:
    """Draw medians with a band between the quartiles."""
    found = sorted(found, key=lambda r: float(r[x]))
    if not found:
        return
    at = [float(r[x]) for r in found]
    ax.plot(at, [float(r[y]) for r in found], marker="o", markersize=3, **style)
    ax.fill_between(
        at,
        [float(r[f"{y}_q1"]) for r in found],
        [float(r[f"{y}_q3"]) for r in found],
        color=style["color"],
        alpha=0.2,
        lw=0,
    )


def over_batches() -> None:
    """Ratio to Pinocchio over the size of the batch, a panel per quantity."""
    ours, others = rows("batch"), rows("peers")
    figure, axes = plt.subplots(2, 3, figsize=(11, 6.4), sharex=True, sharey=True, constrained_layout=True)
    for ax, (quantity, meaning) in zip(axes.flat, QUANTITIES.items(), strict=True):
        mine = [r for r in ours if r["quantity"] == quantity]
        line(ax, [r for r in mine if r["dtype"] == "float64"], "batch", "ratio", color=BLUE, label="tw.fast, float64")
        line(ax, [r for r in mine if r["dtype"] == "float32"], "batch", "ratio", color=ORANGE, label="tw.fast, float32")
        for name, color in (("adam (NumPy)", GREEN), ("adam (JAX)", PURPLE), ("frax", SKY), ("MuJoCo", GREY)):
            theirs = [r for r in others if r["quantity"] == quantity and r["way"] == name]
            line(ax, theirs, "batch", "ratio", color=color, label=name, linestyle="--")
        ax.axhline(1, color="black", lw=0.8)
        ax.set(xscale="log", yscale="log", title=f"{quantity}: {meaning}" if quantity != "set" else meaning)
        ax.grid(alpha=0.3)
    for ax in axes[:, 0]:
        ax.set_ylabel("time per state / Pinocchio's")
    for ax in axes[1]:
        ax.set_xlabel("states in a call")
    handles, labels = axes.flat[2].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=6, frameon=False)
    figure.suptitle("Go2, one thread; Pinocchio called state by state from Python is 1")
    figure.savefig(RESULTS / "batch.png", dpi=100)


def over_links() -> None:
    """Time per state over the number of links, a panel per quantity, with the slopes of `RANGES`."""
    found = rows("links")
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.9), sharey=True, constrained_layout=True)
    for ax, quantity in zip(axes, ("rnea", "aba", "A_G"), strict=True):
        mine = [r for r in found if r["quantity"] == quantity]
        for way, batch, color in (("fast", "1", BLUE), ("fast", "100", ORANGE), ("textbook", "1", GREY)):
            some = [r for r in mine if r["way"] == way and r["batch"] == batch]
            steep = ", then ".join(f"{growth(quantity, batch, *ends):.2f}" for ends in RANGES.values())
            name = f"{way}, batch {batch}" + f": slope {steep}" * (way == "fast")
            line(ax, some, "links", "us", color=color, label=name)
        theirs = [dict(r, us=r["reference_us"], us_q1=r["reference_us_q1"], us_q3=r["reference_us_q3"]) for r in mine]
        one_each = {r["links"]: r for r in theirs if r["us"] != "nan"}
        line(ax, list(one_each.values()), "links", "us", color="black", label="Pinocchio, one by one", linestyle="--")
        ax.set(xscale="log", yscale="log", title=f"{quantity}: {QUANTITIES[quantity]}", xlabel="links of a chain")
        ax.grid(alpha=0.3)
        ax.legend(fontsize=8, frameon=False)
    axes[0].set(ylabel="µs per state", ylim=(0.15, None))  # room for the legends
    figure.savefig(RESULTS / "links.png", dpi=100)


if __name__ == "__main__":
    over_batches()
    over_links()

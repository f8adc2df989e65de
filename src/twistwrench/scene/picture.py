"""The picture of what models cost: how long each takes, and what it misses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..plot.style import COLOURS, axes_2d

if TYPE_CHECKING:
    from .costs import Costs

__all__ = ["draw"]


def draw(costs: Costs, ax: Any = None) -> Any:
    """Draw a bar for the time of each option, coloured by whether it is exact enough; returns the axes."""
    options = [option for option in costs.options if not option.unfit]
    ax = axes_2d(ax, size=(7.0, 1.2 + 0.32 * len(options)))
    best, times = costs.best, [1e6 * option.seconds for option in options]
    start = min(times) / 3  # where the bars begin: a logarithm has no zero
    kinds = ["the choice" if o is best else f"misses {_verdict(o.worst, costs)}" for o in options]
    colours = {
        "the choice": COLOURS["vermilion"],
        f"misses at most {costs.tolerance:.2g}": COLOURS["blue"],
        f"misses more than {costs.tolerance:.2g}": COLOURS["grey"],
    }
    for kind, colour in colours.items():
        rows = [k for k, mine in enumerate(kinds) if mine == kind]
        ax.barh(rows, [times[k] - start for k in rows], color=colour, label=kind, left=start)
    for k, option in enumerate(options):
        ax.text(
            1.15 * times[k], k, f"{option.worst:.2g}" + ("  + torques" if option.tells_torques else ""), va="center"
        )
    ax.set_yticks(range(len(times)), [option.name for option in options])
    ax.invert_yaxis()
    ax.set(xscale="log", xlim=(start, 40 * max(times)), xlabel="time [µs per state]")
    ax.set_title(f"{costs.motion}: worst wrench missed, as a share of {costs.share_of}")
    ax.legend(loc="upper right", fontsize="small")
    return ax


def _verdict(worst: float, costs: Costs) -> str:
    return ("at most " if worst <= costs.tolerance else "more than ") + f"{costs.tolerance:.2g}"

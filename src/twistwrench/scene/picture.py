"""The picture of what models cost: how long each takes, and what it misses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..plot.style import COLOURS, axes_2d

if TYPE_CHECKING:
    from .costs import Costs

__all__ = ["draw"]


def draw(costs: Costs, ax: Any = None) -> Any:
    """Draw a bar for the time of each option that is exact enough, and what each option misses; returns the axes."""
    options = [option for option in costs.options if not option.unfit]
    ax = axes_2d(ax, size=(7.0, 1.2 + 0.32 * len(options)))
    best, timed = costs.best, [option for option in options if option.seconds > 0]
    times = [1e6 * option.seconds for option in timed]
    start = min(times) / 3  # where the bars begin: a logarithm has no zero
    for kind, colour in (("the choice", "vermilion"), ("exact enough", "blue")):
        rows = [k for k, option in enumerate(timed) if (option is best) == (kind == "the choice")]
        ax.barh(rows, [times[k] - start for k in rows], color=COLOURS[colour], label=kind, left=start)
    for k, option in enumerate(options):
        said = ", ".join(f"{option.worst(name):.2g}" if name in option.errors else "-" for name in costs.tolerance)
        end = 1.15 * times[k] if k < len(times) else 1.15 * start
        ax.text(end, k, said + ("  + torques" if option.tells_torques else ""), va="center")
    ax.set_yticks(range(len(options)), [option.name for option in options])
    ax.invert_yaxis()
    ax.set(xscale="log", xlim=(start, 40 * max(times)), xlabel="time [µs per state]")
    ax.set_title(f"{costs.motion}: largest errors of {', '.join(costs.tolerance)}")
    ax.legend(loc="lower right", fontsize="small")
    return ax

"""The picture of what models cost: how long each takes, and what it misses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..plot.style import COLOURS, axes_2d
from ..plot.words import word
from .judging import scale, unit

if TYPE_CHECKING:
    from .costs import Costs, Option

__all__ = ["draw"]


def draw(costs: Costs, ax: Any = None) -> Any:
    """Draw a bar for the time of each option that is exact enough, and what each option misses; returns the axes."""
    options = [option for option in costs.options if not option.unfit]
    ax = axes_2d(ax, size=(7.0, 1.2 + 0.32 * len(options)))
    best, timed = costs.best, [option for option in options if option.seconds > 0]
    times = [1e6 * option.seconds for option in timed]
    for kind, colour in (("the choice", "vermilion"), ("exact enough", "blue")):
        rows = [k for k, option in enumerate(timed) if (option is best) == (kind == "the choice")]
        ax.barh(rows, [times[k] for k in rows], color=COLOURS[colour], label=word(kind))
    for k, option in enumerate(options):
        said = ", ".join(_error(option, name) for name in costs.tolerance)
        end = times[k] if k < len(times) else 0.0
        ax.text(end + 0.01 * max(times), k, said + (word("  + torques") if option.tells_torques else ""), va="center")
    ax.set_yticks(range(len(options)), [option.name for option in options])
    ax.set(xlim=(0, 2.4 * max(times)), ylim=(len(options) - 0.5, -0.5), xlabel=word("time [µs per state]"))
    ax.set_title(word("{}: largest errors of {}").format(costs.motion, ", ".join(costs.tolerance)))
    ax.legend(loc="lower right", fontsize="small")
    return ax


def _error(option: Option, name: str) -> str:
    return f"{option.worst(name) * scale(name):.2g}{unit(name)}" if name in option.errors else "-"

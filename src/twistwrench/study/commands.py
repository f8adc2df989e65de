"""``twistwrench study``: one command a study."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .budget.command import add_budget
from .extremes.command import add_extremes
from .speed import add_speed
from .templates import add_templates
from .trade.command import add_trade

__all__ = ["STUDIES", "register"]

Commands = Any
"""What ``add_subparsers`` returns; argparse has no public name for it."""


def register(commands: Commands) -> None:
    """Add ``twistwrench study``, and a command below it for every study."""
    parser = commands.add_parser(
        "study", help="measure speed, what a digit costs, where digits are lost, what a template leaves out"
    )
    studies = parser.add_subparsers(required=True, metavar="STUDY")
    for add in STUDIES:
        add(studies)


STUDIES: tuple[Callable[[Commands], None], ...] = (add_speed, add_trade, add_templates, add_extremes, add_budget)
"""Each adds its parser, and sets with ``set_defaults(run=...)`` the function that returns the exit status."""

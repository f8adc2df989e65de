"""``python -m benchmarks.study``: one command a study."""

import sys
from collections.abc import Callable, Sequence
from typing import Any

from twistwrench import cli

from .budget.command import add_budget
from .extremes.command import add_extremes
from .speed import add_speed
from .templates import add_templates
from .trade.command import add_trade

__all__ = ["STUDIES", "main"]

STUDIES: tuple[Callable[[Any], None], ...] = (add_speed, add_trade, add_templates, add_extremes, add_budget)
"""Each adds its parser, and sets with ``set_defaults(run=...)`` the function that returns the exit status."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one study, with the command line's exit statuses."""
    return cli.main(argv, program="python -m benchmarks.study", commands=STUDIES)


if __name__ == "__main__":
    sys.exit(main())

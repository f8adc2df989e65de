"""The command line: ``twistwrench exercises``."""

from typing import Any

from misstep.commands import register as add_actions

__all__ = ["register"]


def register(commands: Any) -> None:
    """Add ``twistwrench exercises``."""
    parser = commands.add_parser("exercises", help="the chapter's exercises, checked by pytest")
    add_actions(parser, f"{__package__}.chapter")

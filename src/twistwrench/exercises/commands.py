"""The command line: ``twistwrench exercises``."""

import argparse
from typing import Any

from misstep.commands import register as add_actions
from misstep.text import default_language

__all__ = ["register"]


def register(commands: Any) -> None:
    """Add ``twistwrench exercises``."""
    parser = commands.add_parser("exercises", help="the chapter's exercises, checked by pytest")
    actions = add_actions(parser, f"{__package__}.chapter")
    added = actions.add_parser("sheet", help="ten questions of a section for paper and pencil, as Markdown")
    added.add_argument("section", metavar="SECTION", help="as 49.5")
    added.add_argument("--language", choices=["en", "zh"], help="English or 简体中文")
    kind = added.add_mutually_exclusive_group()
    kind.add_argument("--answers", action="store_true", help="the answers in place of the questions")
    kind.add_argument("--gift", action="store_true", help="questions and answers in Moodle's GIFT format")
    added.set_defaults(run=_print_sheet)


def _print_sheet(args: argparse.Namespace) -> int:
    """Print a sheet, its answers, or both for Moodle."""
    from .pencil import gift, sheet

    language = args.language or default_language()
    print(gift(args.section, language) if args.gift else sheet(args.section, language, answers=args.answers))
    return 0

"""Types and checks of the commands' options: a whole number, and a file that can be written."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from misstep.files import check_writable

__all__ = ["at_least", "check_writable"]


def at_least(least: int) -> Callable[[str], int]:
    """Return a parser of whole numbers that are not below `least`."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = least - 1
        if value < least:
            raise argparse.ArgumentTypeError(f"expected a whole number, {least} or more, got {text!r}")
        return value

    return read

"""Types and checks of the commands' options: a whole number, and a file that can be written."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from pathlib import Path

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


def check_writable(option: str, path: Path | None) -> None:
    """Open the file that will be written, before the work; do not change its content.

    Raises
    ------
    OSError
        Naming the option.
    """
    if path is None:
        return
    target = Path(os.path.realpath(path))  # a link that leads nowhere yet stays, the file it leads to is made
    new = not path.exists()
    try:
        path.open("a").close()
    except OSError as error:
        raise OSError(f"{option} {path}: {error.strerror}") from None
    if new:
        target.unlink()

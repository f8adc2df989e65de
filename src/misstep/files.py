"""Write a file beside, then rename: the old file stays intact until the new one is whole."""

from __future__ import annotations

import os
import secrets
from contextlib import suppress
from os import PathLike
from pathlib import Path

__all__ = ["check_writable", "write_text"]


def write_text(path: str | PathLike[str], text: str) -> None:
    """Write a text file in UTF-8, whole or not at all. A link stays, and the file that it leads to is replaced.

    Raises
    ------
    OSError
        Naming the file. The old file is unchanged.
    """
    target = Path(os.path.realpath(path))
    beside = target.with_name(f".{secrets.token_hex(4)}{target.suffix}")
    try:
        if target.exists() and not target.is_file():  # a device or a pipe
            target.write_text(text, encoding="utf-8")
            return
        if target.exists():
            target.open("a").close()  # a file that may not be written must not be replaced
        beside.write_text(text, encoding="utf-8")
        beside.replace(target)
    except OSError as error:
        raise OSError(f"{path}: {error.strerror or error}") from error
    finally:
        with suppress(OSError):
            beside.unlink(missing_ok=True)


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
    is_new = not path.exists()
    try:
        path.open("a").close()
    except OSError as error:
        raise OSError(f"{option} {path}: {error.strerror}") from None
    if is_new:
        target.unlink()

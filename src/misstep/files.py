"""Write a file beside, then rename: the old file stays intact until the new one is whole."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from os import PathLike
from pathlib import Path

__all__ = ["check_writable", "errors_name", "replacing", "write_text"]

IN_PLACE = ("/dev/", "/proc/")
"""In these folders a name stands for a file that is open already."""


@contextmanager
def errors_name(path: str | PathLike[str]) -> Iterator[None]:
    """Name the file in an error of the operating system: "No space left on device" does not.

    Raises
    ------
    OSError
        Naming the file.
    """
    try:
        yield
    except OSError as error:
        raise OSError(f"{path}: {error.strerror or error}") from error


@contextmanager
def replacing(path: str | PathLike[str]) -> Iterator[Path]:
    """Yield a new file to write; it replaces `path` once it is written without an error.

    It lies in the same folder and has the same suffix. A link stays, and the file that it leads to is replaced.
    A device or a pipe is yielded itself.

    Parameters
    ----------
    path : str or path

    Yields
    ------
    Path

    Raises
    ------
    OSError
        Naming the file. The old file is unchanged.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "found.json"
    >>> with replacing(path) as beside:
    ...     written = beside.write_text("{}")
    >>> path.read_text(), len(list(path.parent.iterdir()))
    ('{}', 1)
    """
    with errors_name(path):
        target = Path(os.path.realpath(path))
        there = Path(path).exists()
        if (there and not Path(path).is_file()) or os.path.abspath(path).startswith(IN_PLACE):
            yield Path(path)
            return
        if there:
            target.open("a").close()  # a file that may not be written must not be replaced
        beside = target.with_name(f".{secrets.token_hex(4)}{target.suffix}")
        try:
            beside.open("x").close()
        except PermissionError:
            if not there:
                raise
            yield target  # the file may be written, its folder may not
            return
        try:
            yield beside
            if there:
                shutil.copymode(target, beside)
            beside.replace(target)
        finally:
            with suppress(OSError):
                beside.unlink(missing_ok=True)


def write_text(path: str | PathLike[str], text: str) -> None:
    """Write a text file in UTF-8, whole or not at all.

    Parameters
    ----------
    path : str or path
    text : str

    Raises
    ------
    OSError
        Naming the file. The old file is unchanged.
    """
    with replacing(path) as beside:
        beside.write_text(text, encoding="utf-8")


def check_writable(option: str, path: Path | None) -> None:
    """Open the file that will be written, before the work; do not change its content. The error names the option."""
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

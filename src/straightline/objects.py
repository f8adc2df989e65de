"""Machine code on disk, so that the next process need not compile it again.

The folder is ``straightline`` in the user's cache, or the one that the environment variable ``STRAIGHTLINE_CACHE``
names; if that is "off", nothing is kept. A file is named after all that its content depends on, and begins with a
checksum: one that is damaged is removed. It is written under another name first, so that nobody reads half of it. What
was not used for longest is removed when there is more than `MOST`. Where there is no such folder, or another user could
write to it, everything is compiled in each process.
"""

from __future__ import annotations

import os
import stat
import sys
from contextlib import suppress
from functools import cache

__all__ = ["VARIABLE", "fetch", "folder", "keep"]

VARIABLE = "STRAIGHTLINE_CACHE"
MOST = 128 * 2**20  # bytes
CHECKSUM = 32  # bytes


def folder() -> str | None:
    """Return the folder, which is made if need be; None if there is none that only this user can write to."""
    path = os.environ.get(VARIABLE) or os.path.join(_caches(), "straightline")
    if path == "off" or not os.path.isabs(path):
        return None
    try:
        os.makedirs(path, 0o700, exist_ok=True)
        found = os.stat(path)
    except OSError:
        return None
    others = stat.S_IWGRP | stat.S_IWOTH
    if hasattr(os, "getuid") and (found.st_uid != os.getuid() or found.st_mode & others):
        return None
    return path


def _caches() -> str:
    """Return where programs of this user keep what they can make again; "" if that is nowhere."""
    home = os.path.expanduser("~")  # "~" where there is none
    if sys.platform == "win32":
        return os.environ.get("LOCALAPPDATA", "")
    if sys.platform == "darwin":
        return os.path.join(home, "Library", "Caches")
    return os.environ.get("XDG_CACHE_HOME") or os.path.join(home, ".cache")


def fetch(key: str) -> bytes | None:
    """Return what is kept under a name, if it is there and whole."""
    path = folder()
    if path is None:
        return None
    name = os.path.join(path, key)
    try:
        with open(name, "rb") as file:
            checksum, content = file.read(CHECKSUM), file.read()
        if checksum == _checksum(key, content):
            os.utime(name)  # used just now
            return content
        os.remove(name)
    except OSError:
        pass
    return None


def keep(key: str, content: bytes) -> None:
    """Keep something under a name, for which another process may keep the same at the same time."""
    path = folder()
    if path is None:
        return
    name = os.path.join(path, key)
    draft = f"{name}.{os.getpid()}.{os.urandom(4).hex()}"
    try:
        with open(draft, "xb") as file:
            file.write(_checksum(key, content) + content)
        os.replace(draft, name)
    except OSError:
        with suppress(OSError):
            os.remove(draft)
        return
    _make_room(path)


def _make_room(path: str) -> None:
    """Remove what was not used for longest."""
    files = list[tuple[float, int, str]]()
    with suppress(OSError):
        for name in os.listdir(path):
            with suppress(OSError):  # another process has removed it
                found = os.stat(os.path.join(path, name))
                files.append((found.st_mtime, found.st_size, name))
    left = sum(size for _, size, _ in files)
    for _, size, name in sorted(files):
        if left <= MOST:
            break
        with suppress(OSError):
            os.remove(os.path.join(path, name))
            left -= size


def _checksum(key: str, content: bytes) -> bytes:
    from hashlib import sha256

    return sha256(key.encode() + content).digest()


@cache
def own_source() -> bytes:
    """Return a checksum of the files of this package, by which its versions are told apart."""
    from hashlib import sha256

    found, here = sha256(), os.path.dirname(__file__)
    for name in sorted(os.listdir(here)):
        if name.endswith(".py"):
            with open(os.path.join(here, name), "rb") as file:
                found.update(name.encode() + file.read())
    return found.digest()

"""The texts of the exercises: a TOML file beside each, in both languages, read when a text is needed."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from .words.text import Text

__all__ = ["as_text", "read"]

SHARED = "shared"
"""Passages that several texts share: a name in braces stands for one."""


@cache
def read(folder: str, name: str) -> Mapping[str, Any]:
    """Return what is in a data file.

    Parameters
    ----------
    folder : str
        "items" or "slips".
    name : str
        Of the file, without its suffix.

    Returns
    -------
    mapping

    Examples
    --------
    >>> read("items", "ex_49_0_4")["title"]
    {'en': 'nq and nv', 'zh': 'nq 与 nv'}
    """
    return tomllib.loads(files(__package__).joinpath(folder, f"{name}.toml").read_text(encoding="utf-8"))


def as_text(entry: Mapping[str, str]) -> Text:
    """Return an entry, ``en`` and ``zh``, of a data file as a text.

    Examples
    --------
    >>> as_text({"en": "nq and nv", "zh": "nq 与 nv"}).of("zh")
    'nq 与 nv'
    """
    return Text(_filled(entry["en"], "en"), _filled(entry["zh"], "zh"))


def _filled(line: str, language: str) -> str:
    """Replace the names of shared passages by their texts."""
    if "{lists}" not in line:
        return line
    return line.replace("{lists}", read("items", SHARED)["lists"][language])

"""The texts of the exercises: a TOML file beside each, in both languages, read when a text is needed."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from .text import Text

__all__ = ["as_text", "read"]

SHARED = "shared"
"""The file beside them with passages that several texts share: a name in braces stands for one."""


@cache
def read(package: str, name: str) -> Mapping[str, Any]:
    """Return the content of a data file: of the package that holds it, and by its name without the suffix.

    It is empty where there is no such file: an exercise in a script has no texts.
    """
    file = files(package).joinpath(f"{name}.toml") if package else None
    return tomllib.loads(file.read_text(encoding="utf-8")) if file is not None and file.is_file() else {}


def as_text(entry: Mapping[str, str], package: str = "") -> Text:
    """Return an entry, ``en`` and ``zh``, of a data file as a text; shared passages are those of its package.

    Examples
    --------
    >>> as_text({"en": "nq and nv", "zh": "nq 与 nv"}).of("zh")
    'nq 与 nv'
    """
    text = Text(entry["en"], entry["zh"])
    if "{" not in text.en or not package or not files(package).joinpath(f"{SHARED}.toml").is_file():
        return text
    for word, passage in read(package, SHARED).items():
        mark = "{" + word + "}"
        text = Text(text.en.replace(mark, passage["en"]), text.zh.replace(mark, passage["zh"]))
    return text

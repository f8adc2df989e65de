"""A text in two languages: filled with values, read from a data file, and broken into lines of a given width."""

from __future__ import annotations

import inspect
import os
import re
import tomllib
import unicodedata
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any, Literal, NamedTuple

__all__ = ["Language", "Text", "as_text", "columns", "default_language", "hanging", "read", "say", "wrapped"]

Language = Literal["en", "zh"]

WIDTH = 98
WIDE_MARKS = "、。，；：！？（）【】《》“”‘’"
NO_END = "（【《“‘("
NO_START = "、。，；：！？）】》”’,.;:!?)"
SHARED = "shared"  # the data file with passages that several texts of a package share: a name in braces stands for one


class Text(NamedTuple):
    """A text in English and in Simplified Chinese."""

    en: str
    zh: str

    def of(self, language: Language) -> str:
        """Return the text in one language."""
        return self.zh if language == "zh" else self.en

    def fill(self, **values: object) -> Text:
        """Fill the braces; a value that is itself a `Text` goes to each language in that language."""
        en, zh = ({k: v.of(code) if isinstance(v, Text) else v for k, v in values.items()} for code in ("en", "zh"))
        return Text(self.en.format(**en), self.zh.format(**zh))


def say(en: str, zh: str, **values: object) -> Text:
    """Return a sentence of a message, its braces filled.

    Examples
    --------
    >>> say("{n} bodies", "{n} 个刚体", n=3).en
    '3 bodies'
    """
    return Text(en, zh).fill(**values)


@cache
def read(package: str, name: str) -> Mapping[str, Any]:
    """Return the content of a TOML file by its package and its name; empty where there is none, as for a script."""
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
    for word, passage in read(package, SHARED).items() if "{" in text.en else ():
        mark = "{" + word + "}"
        text = Text(text.en.replace(mark, passage["en"]), text.zh.replace(mark, passage["zh"]))
    return text


def default_language() -> Language:
    """Return the language of the environment; English unless it is Chinese."""
    asked = next((os.environ[k] for k in ("LC_ALL", "LC_MESSAGES", "LANG") if os.environ.get(k)), "")
    return "zh" if asked.lower().startswith("zh") else "en"


def columns(text: str) -> int:
    """Return how many columns of a terminal a text takes: Chinese characters take two."""
    return sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in text)


def wrapped(text: str, width: int = WIDTH) -> list[str]:
    """Break a text into lines. Paragraphs stay apart."""
    lines: list[str] = []
    for paragraph in inspect.cleandoc(text).split("\n\n"):
        lines += [*_fill([line.strip() for line in paragraph.split("\n")], width), ""]
    return lines[:-1]


def hanging(line: str, width: int = WIDTH) -> list[str]:
    """Break one line of a message, and indent what follows like its beginning. Code (indented by four) stays."""
    indent = line[: len(line) - len(line.lstrip(" -"))]
    if (len(indent) >= 4 and "-" not in indent) or columns(line) <= width:
        return [line]
    first, *others = _fill([line[len(indent) :]], width - len(indent))
    return [indent + first, *(" " * len(indent) + other for other in others)]


def _fill(parts: list[str], width: int) -> list[str]:
    """Fill lines with words; each Chinese character is a word, and no line starts with a full stop."""
    text = ""
    for part in parts:
        wide = [columns(c) == 2 for c in text[-1:] + part[:1]]
        glued = not text or all(wide) or text[-1] in WIDE_MARKS or part[:1] in WIDE_MARKS
        text += part if glued else " " + part
    lines, line = [], ""
    for word in re.findall(r"[\x21-\u2dff]+ *|[^\x21-\u2dff]", text):
        if line and columns(line + word.rstrip()) > width and word[0] not in NO_START:
            full = line.rstrip().rstrip(NO_END)
            line = line[len(full) :].lstrip() + word.lstrip()
            lines.append(full.rstrip())
        else:
            line += word
    return [*lines, line.rstrip()] if line.strip() else lines

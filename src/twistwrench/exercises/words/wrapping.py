"""Lines of a given width, in a script with spaces and in one without."""

from __future__ import annotations

import inspect
import re
import unicodedata

__all__ = ["columns", "hanging", "wrapped"]

WIDTH = 98
WIDE_MARKS = "、。，；：！？（）【】《》“”‘’"
NO_END = "（【《“‘("
NO_START = "、。，；：！？）】》”’,.;:!?)"


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

"""The words of docs/glossary.md, and where a text uses one for the first time."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

__all__ = ["Piece", "Words", "anchor", "rows"]

GLOSSARY = Path(__file__).resolve().parents[1] / "glossary.md"
COLUMN = {"zh": 0, "en": 1}
EVERYDAY = {"link", "body", "parent", "pitch", "posture", "bias", "批", "姿态"}
"""Words that mean other things as well, too often to lead anywhere."""


class Piece(NamedTuple):
    """A piece of a text; with the anchor of its row if it uses a word for the first time."""

    text: str
    anchor: str | None


def rows() -> list[tuple[str, list[str]]]:
    """Return the anchor and the cells of each row of the glossary."""
    lines = [line for line in GLOSSARY.read_text(encoding="utf-8").splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]
    return [(anchor(row[COLUMN["en"]]), row) for row in cells]


def anchor(english: str) -> str:
    """Return the anchor of a row, which is the same in both languages, from its English word."""
    return "term-" + re.sub(r"[^a-z]+", "-", english.lower()).strip("-")


class Words:
    """The words of a language, as one pattern: the longer ones first, so that 复合刚体惯量 is not taken for 刚体."""

    def __init__(self, language: str) -> None:
        self.rows = {
            word.lower(): name
            for name, row in rows()
            for word in re.split("[,、] ?", re.sub("（.*?）| S$", "", row[COLUMN[language]]))
            if word not in EVERYDAY
        }
        longest = sorted(self.rows, key=len, reverse=True)
        if language == "en":
            words = "|".join(re.escape(word).replace("degree", "degrees?") for word in longest)
            self.pattern = re.compile(rf"(?<![\w-])(?:{words})(?:e?s)?(?![\w-])", re.IGNORECASE)
        else:
            words = "|".join(map(re.escape, longest))
            self.pattern = re.compile(rf"(?<![A-Za-z])(?:{words})(?![A-Za-z])", re.IGNORECASE)

    def pieces(self, text: str, used: set[str]) -> Iterator[Piece]:
        """Yield a text in pieces; `used` has the anchors that the page has already, and gets those of the text."""
        end = 0
        for found in self.pattern.finditer(text):
            name = self.row(found[0])
            if name not in used:
                used.add(name)
                yield Piece(text[end : found.start()], None)
                yield Piece(found[0], name)
                end = found.end()
        yield Piece(text[end:], None)

    def row(self, word: str) -> str:
        """Return the anchor of a word, or of its plural."""
        word = word.lower().replace("degrees", "degree")
        return next(self.rows[w] for w in (word, word.removesuffix("s"), word.removesuffix("es")) if w in self.rows)

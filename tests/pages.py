"""The pages of docs/: cut at their headings, and their blocks of Python run."""

import re
from pathlib import Path
from typing import Any, NamedTuple

DOCS = Path(__file__).resolve().parents[1] / "docs"
FENCE = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


NUMBERED = re.compile(r"^### (\d+)\. (.+)$", re.MULTILINE)


class Part(NamedTuple):
    heading: re.Match[str]
    text: str
    blocks: list[str]  # each behind as many newlines as stand before it on the page, so that a failure names its line


def blocks(page: str, start: int, end: int) -> list[str]:
    return ["\n" * page.count("\n", 0, m.start(1)) + m[1] for m in FENCE.finditer(page, start, end)]


def cut(path: Path, heading: re.Pattern[str]) -> tuple[list[str], list[Part]]:
    """The blocks before the first heading, which all others start from, and what stands under each heading."""
    page = path.read_text(encoding="utf-8")
    headings = list(heading.finditer(page))
    ends = [*(h.start() for h in headings[1:]), len(page)]
    parts = [Part(h, page[h.end() : end], blocks(page, h.end(), end)) for h, end in zip(headings, ends, strict=True)]
    return blocks(page, 0, headings[0].start()), parts


def page(name: str, language: str = "") -> Path:
    return DOCS / f"{name}{language}.md"


def numbered(name: str, language: str = "") -> tuple[list[str], list[Part]]:
    """A page whose entries are called "### 1. Title"."""
    return cut(page(name, language), NUMBERED)


def run(path: Path, sources: list[str]) -> dict[str, Any]:
    """Run blocks of a page one after the other, and return what they define."""
    namespace: dict[str, Any] = {"__name__": path.stem}
    for source in sources:
        exec(compile(source, str(path), "exec"), namespace)
    return namespace


def names_author_and_licence(path: Path) -> bool:
    head = " ".join(path.read_text(encoding="utf-8")[:1500].split())
    return "Pengfei Guo" in head and "CC BY 4.0" in head

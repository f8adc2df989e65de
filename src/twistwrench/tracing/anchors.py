"""Where the steps of the chapter are in the source: at the end of its line each has an anchor, ``# 49.7 D`` or so.

Words may follow after a colon.
The map, the pages that go through an algorithm, the seeded faults and `trace` name a step by its anchor, so that a line
can be improved without being copied anywhere.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

__all__ = ["Anchor", "anchor_of", "anchors"]

SOURCE = Path(__file__).parents[1]
ANCHOR = re.compile(r"\S.*  # (49\.\d+ \w+)(?::.*)?$")


class Anchor(NamedTuple):
    """A line that does a step of the chapter."""

    file: str
    """Below the package."""
    number: int
    line: str


@cache
def anchors() -> dict[str, Anchor]:
    """Return all anchors of the source by their names; raises LookupError where one stands twice.

    Examples
    --------
    >>> anchors()["49.7 U"].line.partition("  #")[0]
    'U[i] = IA[i] @ S[i]'
    """
    found: dict[str, Anchor] = {}
    for path in sorted(SOURCE.rglob("*.py")):
        file = path.relative_to(SOURCE).as_posix()
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if name := anchor_of(line):
                if name in found:
                    raise LookupError(f"{file}:{number}: the anchor {name} stands in {found[name].file} as well")
                found[name] = Anchor(file, number, line.strip())
    return found


def anchor_of(line: str) -> str | None:
    """Return the name of the anchor at the end of a line, or None."""
    match = ANCHOR.search(line)
    return match[1] if match else None

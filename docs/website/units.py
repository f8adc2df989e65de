"""A number and its unit stay on one line: 1.26 ms is not broken after 1.26, nor 40 N m after N, nor 6 × 6."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

UNITS = "kg|mm|cm|km|ms|[µμ]s|ns|min|rad|Hz|kB|MB|GB|[NmsJW%°]"
NUMBER_AND_UNIT = re.compile(rf"(?<=\d) (?=(?:{UNITS})(?![\w'’]))")
FACTORS = re.compile(r"(?<=\bN) (?=m\b)|(?<=\bN m) (?=s\b)|(?<=\bkg) (?=m²)")
POWER = re.compile(r"(\b\d[\d.]*e-\d+)")
TIMES = re.compile(r"(?<=\d) (?=× \d)|(?<=\d\u00a0×) (?=\d)|(?<=\d ×) (?=\d)")


def kept_together(text: str) -> str:
    """Return a text whose units cannot come loose from their numbers."""
    for blank in (NUMBER_AND_UNIT, FACTORS, TIMES):
        text = blank.sub("\u00a0", text)
    return text


class NumbersKeepTheirUnits(SphinxPostTransform):
    """Do so wherever a page speaks; code stays as it is written."""

    default_priority = 900

    def run(self, **_: Any) -> None:
        """Go through the words of a page."""
        for text in [*self.document.findall(nodes.Text)]:
            if not isinstance(text.parent, nodes.FixedTextElement | nodes.literal | nodes.raw | nodes.math):
                pieces = POWER.split(kept_together(text))
                if pieces != [text]:
                    text.parent.replace(text, [_piece(piece) for piece in pieces if piece])


def _piece(text: str) -> nodes.Node:
    """Return a node for a text; a number that has a hyphen, where a line may end, as one that is not broken."""
    return nodes.inline(text, text, classes=["unbroken"]) if POWER.fullmatch(text) else nodes.Text(text)


def connect(app: Any) -> None:
    """Do so in every page."""
    app.add_post_transform(NumbersKeepTheirUnits)

"""The first use of each word of the glossary on a page leads to its row there."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

from .glossary import Words, rows

__all__ = ["connect"]

PAGE = "glossary"
ELSEWHERE = (nodes.FixedTextElement, nodes.literal, nodes.raw, nodes.math, nodes.reference, nodes.title, nodes.table)
"""Where a word leads nowhere: code, formulas, links, headings, tables."""


class FirstUses(SphinxPostTransform):
    """Link them; on the glossary's own page, give each row its anchor."""

    default_priority = 890  # before numbers and their units are put together

    def run(self, **_: Any) -> None:
        """Go through the paragraphs of a page."""
        if self.env.docname == PAGE:
            self.name_rows()
            return
        words = Words("zh" if str(self.config.language).startswith("zh") else "en")
        target, used = self.app.builder.get_relative_uri(self.env.docname, PAGE), set[str]()
        for text in [*self.document.findall(nodes.Text)]:
            above = [*_above(text)]
            if any(isinstance(node, nodes.paragraph) for node in above) and not any(
                isinstance(node, ELSEWHERE) for node in above
            ):
                pieces = [piece for piece in words.pieces(str(text), used) if piece.text]
                if any(piece.anchor for piece in pieces):
                    text.parent.replace(text, [_node(piece.text, piece.anchor, target) for piece in pieces])

    def name_rows(self) -> None:
        """Give the rows of the glossary their anchors."""
        for row, (name, _) in zip([*self.document.findall(nodes.row)][1:], rows(), strict=True):
            row["ids"].append(name)


def _above(node: nodes.Node) -> Any:
    while node.parent is not None:
        yield node.parent
        node = node.parent


def _node(text: str, anchor: str | None, target: str) -> nodes.Node:
    if anchor is None:
        return nodes.Text(text)
    return nodes.reference("", text, internal=True, refuri=f"{target}#{anchor}", classes=["term"])


def connect(app: Any) -> None:
    """Do so in every page."""
    app.add_post_transform(FirstUses)

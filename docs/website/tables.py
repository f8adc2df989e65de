"""The corner of a table that has heads in its first row and in its first column: empty, and so no head itself."""

from __future__ import annotations

import re
from typing import Any

EMPTY = re.compile(r'<th class="head([^"]*)">\s*(?:<p>\s*</p>)?\s*</th>')


def without_empty_heads(html: str) -> str:
    """Return a page in which what heads nothing is an ordinary cell: a reader of screens would announce it."""
    return EMPTY.sub(r'<td class="head\1"></td>', html)


def connect(app: Any) -> None:
    """Do so in every page."""

    def change(app: Any, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
        if "body" in context:
            context["body"] = without_empty_heads(context["body"])

    app.connect("html-page-context", change)

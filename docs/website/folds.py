"""Long lists, folded: of the errata each entry, of the map each section; above them a box that finds entries by words.

Without a script the entries open and close by themselves, and the box is not there.
"""

from __future__ import annotations

import re
from typing import Any

LEVEL = {"errata": 3, "map": 2}
"""The pages, and which of their headings are folded with what follows."""
ENTRY = {"errata": ".entry", "map": ".entry li"}
"""What the box finds."""
SECTION = r'(<section id="[^"]*">\s*(?:<span id="[^"]*"></span>\s*)*)(<h{0}>.*?</h{0}>)'
SECTION += r"((?:(?!<section|</section>).)*)(</section>)"
WORDS = {
    "en": {
        "find": "Find entries by words:",
        "errata": "49.6 crash",
        "map": "Jacobian",
        "count": "{} of {}",
        "all": "Open all",
        "none": "Close all",
    },
    "zh": {
        "find": "按词查找条目：",
        "errata": "49.6 崩溃",
        "map": "雅可比",
        "count": "{} / {}",
        "all": "全部展开",
        "none": "全部收起",
    },
}


def folded(body: str, level: int) -> str:
    """Return a page whose sections of a level are folded below their headings; a section with others in it is not.

    >>> folded('<section id="a"><h3>A</h3><p>text</p></section>', 3)
    '<section id="a"><details class="entry"><summary><h3>A</h3></summary><p>text</p></details></section>'
    """
    fold = r'\1<details class="entry"><summary>\2</summary>\3</details>\4'
    return re.sub(SECTION.format(level), fold, body, flags=re.DOTALL)


def box(page: str, language: str) -> str:
    """Return the box that finds entries, for the script to show."""
    words = WORDS[language]
    data = "".join(f' data-{name}="{words[name]}"' for name in ("count", "all", "none"))
    field = f'<input type="search" placeholder="{words[page]}">'
    label = f"<label>{words['find']} {field}</label>"
    return f'<div class="find" data-entries="{ENTRY[page]}"{data} hidden>{label}<span role="status"></span></div>'


def connect(app: Any, language: str) -> None:
    """Fold the entries of the pages, and put the box above the first section."""

    def fold(app: Any, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
        if page in LEVEL and "body" in context:
            title, rest = context["body"].split("</h1>", 1)
            before, first, sections = rest.partition("<section")
            found = folded(first + sections, LEVEL[page])
            context["body"] = f"{title}</h1>{before}{box(page, language)}\n{found}"

    app.connect("html-page-context", fold)

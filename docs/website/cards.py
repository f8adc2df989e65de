"""The map as cards: what and its formula, the line that computes it, and where to go from there.

On a code host docs/map.md is a table of six columns, wider than any page of the site. Here each of its rows is a card:
it leads to the function, to the line in the source, to the page that goes through the algorithm line by line, and names
what Pinocchio calls it; each section leads to its notebook.
"""

from __future__ import annotations

import re
from functools import cache, partial
from pathlib import Path
from typing import Any

from twistwrench.tracing.anchors import anchors

from . import beside, notebooks, pages, typeset

TABLE = re.compile(r"(?:^\|.*\n)+", re.MULTILINE)
SECTION = re.compile(r"^## (49\.\d+) .*\n", re.MULTILINE)
LINE = re.compile(r'<span class="linenos"> *(\d+)</span>')
BACK = re.compile(r'(class="viewcode-back" href="[^"#]*#)([\w.]+)')
BY_LINE = {"en": "`{}`, line {}", "zh": "`{}` 第 {} 行"}
ITS_NAME = {"en": "Pinocchio: {}", "zh": "Pinocchio：{}"}
NOTEBOOK = {"en": "The notebook of this section: [{0}]({1})", "zh": "本节的笔记本：[{0}]({1})"}
STEPS = {"en": "[line by line](algorithms/{}.md)", "zh": "[逐行解释](algorithms/{}.md)"}


def write_map(out: Path, language: str) -> None:
    """Put the cards into the page of the map."""
    page = out / "map.md"
    pages.write(page, in_place_of_tables(page.read_text(encoding="utf-8"), language))


def in_place_of_tables(text: str, language: str) -> str:
    """Return the text of the map with a list of cards for each table, and links to the notebooks."""
    text = SECTION.sub(lambda found: found[0] + _notebook(found[1], language), text)
    return TABLE.sub(lambda found: _cards(found[0], language), text)


def _notebook(section: str, language: str) -> str:
    """Return the line that leads to the notebook of a section."""
    chapter, _, number = section.partition(".")
    (name,) = (name for name in notebooks.names() if name.startswith(f"{chapter}_{number:0>2}_"))
    return f"\n{NOTEBOOK[language].format(section, f'chapter/{name}.ipynb')}\n"


def _cards(table: str, language: str) -> str:
    """Return the rows of a table, below its head, as cards."""
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in table.splitlines()[2:]]
    return "\n".join([":::{container} cards", "", *(_card(row, language) for row in rows), ":::", ""])


def _card(row: list[str], language: str) -> str:
    """Return what a row says as an entry of a list."""
    what, formula, call, file, line, pinocchio = row
    read, path = typeset.tex(formula), file.strip("`")
    name = call.strip("`")
    number, source = _place(path, line.strip("`"))
    shown = f"${read}$" if read else formula
    at = f"_modules/twistwrench/{path.removesuffix('.py')}.html#L{number}"
    target = name.rpartition(".")[0] if name.endswith("__") else name  # an operator stands with its class
    links = [f"{{py:obj}}`{name} <twistwrench.{target}>`", BY_LINE[language].format(path, number)]
    if page := _steps().get(line.strip("`")):
        links.append(STEPS[language].format(page))
    links += [ITS_NAME[language].format(pinocchio)] if pinocchio else []
    code = f'<a class="line" href="{at}">``{source}``</a>'
    return "\n\n  ".join([f"- **{what}**" + (f" {shown}" if shown else ""), code, " · ".join(links)]) + "\n"


def _place(file: str, line: str) -> tuple[int, str]:
    """Return the number and the text of a line that the map names by its anchor, or quotes."""
    if line in anchors():
        return anchors()[line].number, anchors()[line].line
    lines = [own.strip() for own in (beside.SOURCE / file).read_text(encoding="utf-8").splitlines()]
    return lines.index(line) + 1, line


@cache
def _steps() -> dict[str, str]:
    """Return the pages that go through an algorithm, by the anchors of their steps."""
    parts = [(page, part) for page in beside.names() for part in beside.read(page)["part"]]
    return {name: page for page, part in parts for step in part["step"] for name in step["at"].split(", ")}


def _back(env: Any, page: str, link: re.Match[str]) -> str:
    """Lead from a listing to the entry of a name, which may stand at the top of the package, or in its folder.

    Sphinx knows one prefix for all names of a file.
    """
    places = env.get_domain("py").objects
    module = page.removeprefix("_modules/").replace("/", ".")
    _, _, used, prefix = env._viewcode_modules[module]
    own = link[2].removeprefix(f"{prefix}.")
    found = [name for name in places if name.endswith(f".{own}") and places[name].docname == used.get(own)]
    if link[2] in places or not found:
        return link[0]
    return link[1] + str(places[min(found, key=len)].node_id)


def connect(app: Any) -> None:
    """Give every line of the shown sources a name, and show those files too that document nothing by themselves."""

    def show(app: Any, env: Any) -> None:
        shown = env.__dict__.setdefault("_viewcode_modules", {})
        for file in files():
            module = f"twistwrench.{file.removesuffix('.py').replace('/', '.')}"
            if not shown.get(module):
                shown[module] = ((beside.SOURCE / file).read_text(encoding="utf-8"), {}, {}, module)

    def name_lines(app: Any, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
        if page.startswith("_modules/") and "body" in context:
            body = LINE.sub(lambda m: m[0].replace("<span", f'<span id="L{m[1]}"'), context["body"])
            context["body"] = BACK.sub(partial(_back, app.env, page), body)

    app.connect("env-check-consistency", show)
    app.connect("html-page-context", name_lines)


def files() -> list[str]:
    """Return the files that the map leads to."""
    text = (pages.ROOT / "docs" / "map.md").read_text(encoding="utf-8")
    return sorted(set(re.findall(r"\| `([\w/]+\.py)` \|", text)))

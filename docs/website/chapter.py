"""The chapter's path: for each section its notebook, its algorithms line by line, its functions, and its errata."""

from __future__ import annotations

import re
from pathlib import Path

import nbformat

from . import beside, interface, notebooks
from .pages import ROOT, SUFFIX, contents, joined, write

INTRO = {
    "en": """# The chapter

A notebook for each section, and one to begin with; beside it the algorithms line by line, the functions, and what the
chapter gets wrong there. The outputs are those of the run that built this site, and everything that a notebook says in
numbers is an `assert`. To change a cell and see what still holds, open the notebooks in `notebooks/en/`.""",
    "zh": """# 逐节学习

每节一个笔记本，另有一个用来起步；旁边是逐行读的算法、相应的函数，以及本章在那里写错了什么。
这里的输出来自构建本站时的运行，笔记本中每个与数字有关的说法都是一条 `assert`。
想改一改代码、看看哪些还成立，请打开 `notebooks/zh/` 中的笔记本。""",
}
HEAD = {
    "en": ("Read and run", "Line by line", "Functions", "Errata"),
    "zh": ("读与运行", "逐行读", "函数", "勘误"),
}


def write_chapter(out: Path, language: str) -> None:
    """Write the page of the chapter's path."""
    at, errata = interface.sections(), _errata(language)
    rows = ["| {} | {} | {} | {} |".format(*HEAD[language]), "|---|---|---|---|"]
    for name in notebooks.names():
        number = _number(name)
        lines = [f"[{call}](../algorithms/{page}.md)" for page, call in _algorithms(number, at)]
        files = [f"[`{file}`](../api/{file}.md)" for file in interface.by_section() if at.get(file) == number]
        wrong = f"[{number}](../errata.md#{errata[number]})" if number in errata else ""
        title = f"[{_title(name, language)}]({name}.ipynb)"
        rows.append(f"| {title} | {', '.join(lines)} | {', '.join(files)} | {wrong} |")
    path = [":::{container} path", "", *rows, ":::"]
    parts = [joined(INTRO[language], language), "\n".join(path), contents(notebooks.names(), hidden=True)]
    write(out / "chapter" / "index.md", "\n\n".join(parts) + "\n")


def _number(name: str) -> str:
    """Return the section of a notebook, 49.6 of 49_06_rnea; nothing for one that belongs to none."""
    found = re.match(r"49_(\d+)_", name)
    return f"49.{int(found[1])}" if found else ""


def _title(name: str, language: str) -> str:
    notebook = nbformat.read(ROOT / "notebooks" / language / f"{name}.ipynb", as_version=4)
    return str(notebook.cells[0].source).splitlines()[0].removeprefix("# ")


def _algorithms(number: str, at: dict[str, str]) -> list[tuple[str, str]]:
    """Return the pages of the algorithms of a section, and what each of them computes."""
    found = [(name, beside.read(name)) for name in beside.names()]
    return [(n, f"`{s['call']}`") for n, s in found if number == at[s["part"][-1]["file"].removesuffix(".py")]]


def _errata(language: str) -> dict[str, str]:
    """Return for each section that has errata the place where they begin."""
    text = (ROOT / "docs" / f"errata{SUFFIX[language]}.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## ((49\.\d+).*)$", text, re.MULTILINE)
    return {number: re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title, number in headings}

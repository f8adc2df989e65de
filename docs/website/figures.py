"""The pictures of the site: what they show in words, the code that draws them, and the page that has them all.

A picture of a notebook is told, to those who cannot see it, by the heading above it and the words before it; in the
gallery it stands with the cell that draws it. What the pages of docs/ show is there too, with the program that made it.
"""

from __future__ import annotations

import base64
import hashlib
import os
import re
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import NamedTuple

import nbformat

from .pages import ROOT, joined, moved, pages, twin, write

ENDING = {"image/png": "png", "image/svg+xml": "svg"}
LONGEST = 220  # characters of a text for the blind
SIGNS = {
    "times": "×",
    "cdot": "·",
    "approx": "≈",
    "ne": "≠",
    "le": "≤",
    "ge": "≥",
    "sum": "Σ ",
    "to": "→",
    "partial": "∂",
}
SIGNS |= {"leftarrow": "←", "lambda": "λ", "omega": "ω", "tau": "τ", "mu": "μ", "boldsymbol": "", "hat": "", "frac": ""}
MARKS = {"dot": "\u0307", "ddot": "\u0308", "bar": "\u0304"}
PROGRAMS = ("docs/pictures", "benchmarks", "benchmarks/study")
"""Where the programs are that make the pictures of docs/pictures."""
HEADING = re.compile(r"^#{1,4} (.*)$", re.MULTILINE)
SHOWN = re.compile(r"^!\[([^\]]+)\]\((pictures/([\w]+)\.\w+)\)", re.MULTILINE)
TEXT = {
    "en": """# Pictures

Every picture of this site: click it, and its page opens where it stands. Below it is the code that draws it.""",
    "zh": """# 图库

本站的全部图片：点图打开它所在的页面；图下是画出它的代码。""",
}
CODE = {"en": "The code", "zh": "代码"}
MADE = {"en": "Made by [`{0}`](../{0}).", "zh": "由 [`{0}`](../{0}) 生成。"}
NOTEBOOK = {"en": "From the notebooks", "zh": "出自笔记本"}
PAGES = {"en": "From the pages on speed, accuracy, contacts and scenes", "zh": "出自讨论速度、精度、接触与场景的各页"}


class Figure(NamedTuple):
    """A picture that a cell of a notebook draws."""

    cell: nbformat.NotebookNode
    heading: str
    says: str
    file: str
    """As Sphinx names it."""


def figures(notebook: nbformat.NotebookNode) -> Iterator[Figure]:
    """Yield the pictures of a notebook that was run, the first of each cell."""
    heading, before = "", ""
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            heading = (HEADING.findall(cell.source) or [heading])[-1]
            before = _last_words(cell.source) or before
        else:
            names = [_name(output.data) for output in cell.outputs if "data" in output]
            if names := [name for name in names if name]:
                says = _sentence(plain(heading)) + before if before else plain(heading)
                yield Figure(cell, heading, _shortened(says), names[0])


def _sentence(heading: str) -> str:
    """Return a heading with what ends a sentence, as its language writes it."""
    chinese = bool(re.search("[\u4e00-\u9fff]", heading))
    stop = "" if heading[-1:] in {*"?!？！"} else "。" if chinese else "."
    return f"{heading}{stop}" if chinese else f"{heading}{stop} "


def _name(data: dict[str, str]) -> str:
    """Return the name of the file into which MyST-NB writes an output; nothing for what is no picture."""
    for kind, ending in ENDING.items():
        if kind in data:
            text = data[kind]
            raw = base64.b64decode(text) if ending == "png" else os.linesep.join(text.splitlines()).encode()
            return f"{hashlib.sha256(raw).hexdigest()}.{ending}"
    return ""


def _last_words(text: str) -> str:
    """Return the last paragraph of a text that is no heading, formula, table or fold."""
    blocks = re.sub(r"\$\$.*?\$\$|<details>.*?</details>", "", text, flags=re.DOTALL).split("\n\n")
    said = [block for block in blocks if block.strip() and not re.match(r"\s*(#|\||<|```|\*\*(Exercise|练习))", block)]
    return plain(said[-1]) if said else ""


def plain(text: str) -> str:
    """Return Markdown without its marks, and formulas as their letters."""
    text = re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", re.sub(r"<[^>]+>", "", text))
    text = re.sub(r"\\boldsymbol\s*|\\[,;! ]", "", text)
    text = re.sub(r"\\(dot|ddot|bar)\s*\{?(\\?\w+?)(?![a-z])\}?", lambda m: m[2] + MARKS[m[1]], text)
    text = re.sub(r"\\([a-z]+) ?", lambda m: SIGNS.get(m[1], m[1]), text)
    return re.sub(r"\s+", " ", re.sub(r"[*`${}\\]|^[-\d]+[.)]? ", "", text)).strip()


def _shortened(text: str) -> str:
    """Return whole sentences of a text, as many as have room."""
    if len(text) <= LONGEST:
        return text
    ends = [found.end() for found in re.finditer(r"[.?!](?= )|[。？！]", text) if found.end() <= LONGEST]
    return text[: ends[-1]] if ends and ends[-1] > LONGEST // 3 else text[: LONGEST - 1].rstrip() + "…"


def with_words(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Give the pictures of a notebook their text for the blind."""
    for figure in figures(notebook):
        figure.cell.metadata.setdefault("mystnb", {})["image"] = {"alt": figure.says}
    return notebook


def image(file: str, says: str, up: str = "../", link: str = "") -> str:
    """Return a small picture as HTML, which may lead to a page."""
    shown = f'<img src="{up}_images/{file}" alt="{escape(says)}" loading="lazy">'
    return f'<a href="{link}">{shown}</a>' if link else shown


def gallery(out: Path, names: list[str], language: str) -> str:
    """Return the page of all pictures; the notebooks in `out` were run."""
    from myst_parser.slugs import github_slugify  # of the docs extra, which the tests of notebooks do without

    parts = [joined(TEXT[language], language), f"## {NOTEBOOK[language]}", "::::{container} doors gallery"]
    for name in names:
        for figure in figures(nbformat.read(out / "chapter" / f"{name}.ipynb", as_version=4)):
            place = github_slugify(re.sub(r"\$[^$]*\$|[*`]", "", figure.heading))
            seen = image(figure.file, figure.says, "", f"chapter/{name}.html#{place}")
            parts.append(
                _door(seen, f"[{figure.heading}](chapter/{name}.ipynb)", _folded(figure.cell.source, language))
            )
    parts += ["::::", f"## {PAGES[language]}", "::::{container} doors gallery", *_of_pages(out, language), "::::"]
    return "\n\n".join(parts) + "\n"


def _door(seen: str, title: str, below: str) -> str:
    return f":::{{container}} door\n```{{raw}} html\n{seen}\n```\n\n**{title}**\n\n{below}\n:::"


def _folded(code: str, language: str) -> str:
    return f"<details><summary>{CODE[language]}</summary>\n\n```python\n{code.strip()}\n```\n\n</details>"


def _of_pages(out: Path, language: str) -> Iterator[str]:
    """Yield the pictures of the pages of docs/, each with the program that made it."""
    for path in pages():
        own = ROOT / twin(path, language)
        text = own.read_text(encoding="utf-8") if own.exists() else ""
        for says, file, stem in SHOWN.findall(text):
            by = MADE[language].format(_program(stem))
            seen = f"[![{says}]({file})]({path.removeprefix('docs/')})"
            door = f":::{{container}} door\n{seen}\n\n**{says}**\n\n{by}\n:::"
            yield moved(door, twin("docs/gallery.md", language), "gallery", out)


def _program(picture: str) -> str:
    """Return the program that made a picture of docs/pictures: its name begins with that of the program."""
    programs = [path for folder in PROGRAMS for path in sorted((ROOT / folder).glob("*.py"))]
    made = next(path for path in programs if f"{picture}_".startswith(f"{path.stem}_"))
    return made.relative_to(ROOT).as_posix()


def write_gallery(out: Path, names: list[str], language: str) -> None:
    """Write the page of all pictures."""
    write(out / "gallery.md", gallery(out, names, language))

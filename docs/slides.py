"""Turn a notebook into slides: one HTML file that needs no network, for the projector or as a handout to print.

usage:  python docs/slides.py 49_07                  build/slides/en/49_07_aba.html
        python docs/slides.py 49_07 --language zh    in Chinese
        python docs/slides.py                        all notebooks

Each heading begins a slide, and so does each question or text that follows something else, and each picture. Set-up
and what checks the claims are left out; of a picture only the picture is shown. Keys: right and left for the slides,
down for the next answer that is folded. Printed, each slide is a page. What is shown is what the notebook keeps
(`python notebooks/execute.py`). Needs `pip install -e ".[docs]"`.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator, Sequence
from html import escape
from importlib.metadata import files
from pathlib import Path

import nbformat
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer

ROOT = Path(__file__).resolve().parents[1]
TEMPLATE = Path(__file__).resolve().parent / "website" / "slides.html"
LANGUAGES = {"en": "en", "zh": "zh-CN"}
MATHJAX = "tex-svg-full.js"
LEFT_OUT = ("# Set-up", "# 准备", "# The claims above, checked", "# 检验上面的说法")
"""The first lines of cells that no class needs to see."""
HOW = re.compile(r"<p><small>.*?</small></p>", re.DOTALL)
"""How a question is answered in the notebook."""


def cells(notebook: nbformat.NotebookNode) -> Iterator[tuple[str, str]]:
    """Yield what is shown of each cell, as HTML, with what kind it is: text, question, picture or code."""
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            yield "text", text(cell.source)
        elif not cell.source.startswith(LEFT_OUT):
            outputs = [shown(output) for output in cell.outputs]
            asks = "tw.ask(" in cell.source
            hidden = asks or "hide-input" in cell.metadata.get("tags", [])
            code = "" if hidden else f"{highlight(cell.source, PythonLexer(), HtmlFormatter())}"
            body = code + "".join(outputs)
            if "hide-cell" in cell.metadata.get("tags", []):
                head, _, rest = cell.source.partition("\n")
                listing = highlight(rest, PythonLexer(), HtmlFormatter()) + "".join(outputs)
                body = f"<details><summary>{escape(head.removeprefix('# '))}</summary>{listing}</details>"
            pictured = any("<img" in output or "<figure" in output for output in outputs)
            if body:
                yield "question" if asks else "picture" if pictured else "code", body


def text(source: str) -> str:
    """Return Markdown as HTML; formulas stay TeX, which MathJax sets, and links become plain words."""
    reader = MarkdownIt("commonmark", {"html": True}).enable("table").use(dollarmath_plugin, double_inline=True)
    reader.add_render_rule("math_inline", lambda _, tokens, k, *__: rf"\({escape(tokens[k].content)}\)")
    for rule in ("math_block", "math_inline_double", "math_block_label"):
        reader.add_render_rule(rule, lambda _, tokens, k, *__: rf"<div>\[{escape(tokens[k].content)}\]</div>")
    return str(reader.render(re.sub(r"\[((?:[^\[\]]|\[[^\]]*\])+)\]\((?!https?:)[^)]*\)", r"*\1*", source)))


def shown(output: nbformat.NotebookNode) -> str:
    """Return an output as HTML."""
    data = output.get("data", {})
    if "image/png" in data:
        return f'<img alt="" src="data:image/png;base64,{"".join(data["image/png"].split())}">'
    if "image/svg+xml" in data:
        return f"<figure>{re.sub(r'^.*?(?=<svg)', '', data['image/svg+xml'], flags=re.DOTALL)}</figure>"
    if "text/html" in data:
        return HOW.sub("", data["text/html"])
    if "text/markdown" in data:
        return text(data["text/markdown"])
    plain = output.get("text") or data.get("text/plain", "")
    return f'<pre class="out">{escape(plain.rstrip())}</pre>' if plain.strip() else ""


def slides(notebook: nbformat.NotebookNode) -> list[str]:
    """Return the slides of a notebook."""
    found: list[list[str]] = []
    heading, before = "", ""
    for kind, body in cells(notebook):
        own = re.match(r"\s*<h[123]>(.*?)</h[123]>", body)
        if not found or own or before == "question" or kind == "picture" or (before != "text" and kind != "code"):
            found.append([] if own or not heading else [f'<h2 class="again">{heading}</h2>'])
        heading, before = own[1] if own else heading, kind
        found[-1].append(body)
    return [f'<section><div class="fit">{"".join(parts)}</div></section>' for parts in found]


def page(path: Path, language: str, script: str = "") -> str:
    """Return a notebook as one page of slides, with MathJax inside or, where it is beside the page, as a script."""
    notebook = nbformat.read(path, as_version=4)
    title = notebook.cells[0].source.splitlines()[0].removeprefix("# ")
    parts = {"lang": LANGUAGES[language], "title": escape(title), "slides": "\n".join(slides(notebook))}
    parts["highlight"] = HtmlFormatter().get_style_defs(".highlight")
    inside = "" if script else mathjax().replace("</script", "<\\/script")
    parts["mathjax"] = f'<script src="{script}"></script>' if script else f"<script>{inside}</script>"
    return TEMPLATE.read_text(encoding="utf-8").format(**parts)


def mathjax() -> str:
    """Return the text of MathJax."""
    own = next(file for file in files("sphinx-mathjax-offline") or [] if file.name == MATHJAX)
    return own.read_text(encoding="utf-8")


def write_slides(html: Path, languages: Sequence[str]) -> None:
    """Write the slides of all notebooks beside the pages of the site, whose MathJax they use."""
    for language in languages:
        for path in sorted((ROOT / "notebooks" / language).glob("*.ipynb")):
            target = html / language / "slides" / f"{path.stem}.html"
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(page(path, language, f"../_static/mathjax/{MATHJAX}"), encoding="utf-8")


def main(arguments: list[str] | None = None) -> int:
    """Write the slides of notebooks and print where they are."""
    parser = argparse.ArgumentParser(description="Turn notebooks into slides.")
    parser.add_argument("names", nargs="*", default=[""], help="with which names begin, as 49_07; all unless given")
    parser.add_argument("--language", choices=list(LANGUAGES), default="en")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "slides", metavar="DIR")
    given = parser.parse_args(arguments)
    folder = ROOT / "notebooks" / given.language
    paths = [path for path in sorted(folder.glob("*.ipynb")) if path.stem.startswith(tuple(given.names))]
    if not paths:
        parser.error(f"no notebook begins with {' or '.join(given.names)}")
    for path in paths:
        target = given.out / given.language / f"{path.stem}.html"
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(page(path, given.language), encoding="utf-8")
        print(f"{target}: {target.stat().st_size / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())

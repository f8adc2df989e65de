"""Build the notebooks: from each text in source/, one in English and one in Chinese.

usage:  python notebooks/build.py             write en/ and zh/
        python notebooks/build.py --check     change nothing; exit 1 where a notebook is not what its source says

A source is a Python file in percent form. Its code cells go into both notebooks; in the Chinese one, their comments and
the words of figures are in Chinese (source/zh.toml; one without its Chinese is an error). Each Markdown cell goes
into the one whose language it names; an English cell is followed by the Chinese one that says the same:

    # %% [markdown] lang="en"
    # Turn the base.
    # %% [markdown] lang="zh"
    # 让基座转起来。
    # %%
    v[2] = 0.5

Asserts at the top of a code cell, and what draws a picture from its figure to `plt.show()`, go into cells of their own
after it, whose code is folded away: a reader sees what is computed, and unfolds the rest. A cell that tells the answer
of an exercise says which, `after="49.6.3"`: it is folded away with its outputs, and opened after that exercise. What
only prepares the rest, imports and names, is marked `setup="yes"`, and folded as well. The picture that stands for the
notebook on the chapter's page is that of the cell marked `thumbnail="yes"`.

A page that only the site has, `[RNEA as a film](../hands/film.md)`, is called by its name in the notebook, where the
link would lead nowhere; the site makes it a link again.

What a notebook shows is kept while its code stays the same; `python notebooks/execute.py` runs it anew.

In the Chinese text, commas, brackets, quotation marks and the like may be typed as English has them, and a line may
end anywhere.
"""

import argparse
import ast
import io
import itertools
import re
import sys
import tokenize
import tomllib
from collections.abc import Iterator
from pathlib import Path

import jupytext
import nbformat

HERE = Path(__file__).resolve().parent
LANGUAGES = ("en", "zh")
NAMES = {
    "00_first": "00_first",
    "49_01": "49_01_why",
    "49_02": "49_02_twist",
    "49_03": "49_03_pluecker",
    "49_04": "49_04_wrench",
    "49_05": "49_05_inertia",
    "49_06": "49_06_rnea",
    "49_07": "49_07_aba",
    "49_08": "49_08_crba",
    "49_09": "49_09_floating_base",
    "49_10": "49_10_centroidal",
    "49_11": "49_11_pinocchio",
    "scenes": "scenes",
    "templates": "templates",
}
"""What the notebook of each source is called."""
METADATA = {
    "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}

HAN = "\u4e00-\u9fff"
LINE_END = rf"[{HAN},;:?!、。]\n[{HAN}]|[,;:?!、。]\n([A-Za-z]|\*\*|\$(?!\$)|`(?!``))"
"""Where a line ends and no blank may show."""
FULL_WIDTH = {ord(mark): ord(mark) + 0xFEE0 for mark in "(),;:?!"}
NOT_WORDS = r"`[^`]+`|\$\$[^$]+\$\$|\$[^$]+\$|\]\([^)]*\)"
QUOTES = rf'{NOT_WORDS}|"([^"]*)"'
UNITS = r"(?<![A-Za-z])(N m|kg m)(?![A-Za-z])"
"""Products of units, which Chinese writes with a dot."""
BRACKETS = rf"{NOT_WORDS}| ?\((?:{NOT_WORDS}|\([^()`$]*\)|[^()`$])*\) ?"
KEPT = rf"{NOT_WORDS}|\((?:{NOT_WORDS}|[^()])*\)|(?<=\d)[,:](?=\d{{2}})|:(?=//)"
HALF_WIDTH = rf"{KEPT}|([,;:?!]) ?"
"""In Chinese every mark is as wide as the characters, also beside a unit, a number or a formula. As they are typed stay
code, formulas, what is in narrow brackets, such as (ω, v), a number or a time, such as 1,000 and 12:30, and links."""


def sources() -> list[Path]:
    """Return the sources that there are, in the chapter's order."""
    return [path for name in NAMES if (path := HERE / "source" / f"{name}.py").exists()]


def target(source: Path, language: str) -> Path:
    """Return where the notebook of a source is kept."""
    return HERE / language / f"{NAMES[source.stem]}.ipynb"


def cells(source: Path) -> list[nbformat.NotebookNode]:
    """Return the cells of a source; raises ValueError where the two languages are not in step."""
    found = jupytext.reads(source.read_text(encoding="utf-8"), fmt="py:percent").cells
    waiting = ""
    for k, cell in enumerate(found):
        language = cell.metadata.get("lang", "") if cell.cell_type == "markdown" else ""
        if cell.cell_type == "markdown" and language not in LANGUAGES:
            raise ValueError(f'{source.name}, cell {k}: expected lang="en" or lang="zh" on a Markdown cell')
        if (waiting == "en") != (language == "zh"):
            raise ValueError(f"{source.name}, cell {k}: each English cell is followed by its Chinese one")
        waiting = language
    if waiting == "en":
        raise ValueError(f"{source.name}: the last English cell has no Chinese one")
    return found


def chinese(text: str) -> str:
    """Set a Chinese text: no blank where a line ends between two characters, and full-width punctuation."""
    lines: list[str] = []
    for line in text.split("\n"):
        if lines and not lines[-1].startswith(("#", "|")) and re.search(LINE_END, f"{lines[-1][-1:]}\n{line.lstrip()}"):
            lines[-1] += line.lstrip()
        else:
            lines.append(line)
    text = re.sub(QUOTES, lambda found: f"“{found[1]}”" if found[1] else found[0], "\n".join(lines))
    text = re.sub(BRACKETS, _brackets, text)
    text = re.sub(UNITS, lambda unit: unit[0].replace(" ", "·"), text)
    return re.sub(HALF_WIDTH, lambda found: found[1].translate(FULL_WIDTH) if found[1] else found[0], text)


def _brackets(found: re.Match[str]) -> str:
    """Widen brackets that hold Chinese, or stand right behind it; others, code and formulas stay as they are."""
    text, words = found[0], re.sub(NOT_WORDS, "", found[0])
    behind = text[0] == "(" and re.match(f"[{HAN}$*`]", found.string[found.start() - 1])
    if words.strip()[:1] != "(" or not (behind or re.search(f"[{HAN}]", words)):
        return text
    return f"（{text.strip()[1:-1]}）"


CLAIMS, DRAWING = "# The claims above, checked", "# The picture"
"""The first line of a folded cell."""
FOLDED = {"jupyter": {"source_hidden": True}, "tags": ["hide-input"], "cellView": "form"}
"""For JupyterLab, for the site, for Colab."""
AFTER = {"en": "After you have solved {}", "zh": "做完练习 {} 之后再看"}
"""The heading of what tells the answer of an exercise."""
SETUP = {"en": "# Set-up", "zh": "# 准备"}
"""The first line of a cell that prepares."""
FOLDED_AFTER = {**FOLDED, "jupyter": {"source_hidden": True, "outputs_hidden": True}, "tags": ["hide-cell"]}
"""The same, with the outputs."""
THUMBNAIL = "thumbnail"
"""The tag of the cell whose picture stands for the notebook."""
SITE_PAGE = re.compile(r"\[((?:[^\[\]]|\[[^\]]*\])+)\]\(\.\./(?:hands|algorithms)/\w+\.md\)")
"""A link to a page that only the site has."""
CALLED = {"en": "*{}*", "zh": "“{}”"}
"""How a notebook calls such a page."""
DRAWS = re.compile(r"\b(plt|plot|ax|axes|axis|figure|fig|picture)\b")


def unfolded(code: str) -> list[tuple[str, bool]]:
    """Return the cells of a code cell, what is computed, drawn and claimed, each with whether it is folded away."""
    lines, start = code.split("\n"), 0
    shown: list[str] = []
    drawn: list[str] = []
    claimed: list[str] = []
    body = ast.parse(code).body
    pictures = [k for k, node in enumerate(body) if ast.unparse(node) == "plt.show()"]
    for k, node in enumerate(body):
        text = "\n".join(lines[start : node.end_lineno])
        start = node.end_lineno or 0
        show = next((end for end in pictures if end >= k), None)
        if _is_claim(node):
            claimed.append(text)
        elif show is not None and (drawn or (DRAWS.search(ast.unparse(node)) and not _defines(node))):
            drawn.append(text)
        else:
            shown.append(text)
    rest = "\n".join(lines[start:])
    folded = [(head, part) for head, part in ((DRAWING, drawn), (CLAIMS, claimed)) if part]
    if not shown and len(folded) == 1 and not claimed:
        return [(code, False)] if len(drawn) < 4 else [(f"{DRAWING}\n{code}", True)]
    cells = [("\n".join([*shown, rest]).strip("\n"), False)] if shown else []
    return cells + [(head + "\n" + "\n".join(part).strip("\n"), True) for head, part in folded]


def without_site(text: str, language: str) -> tuple[str, dict[str, str]]:
    """Return a text that calls the pages of the site by their names, and for each name as it stands there its link."""
    links = {CALLED[language].format(found[1]): found[0] for found in SITE_PAGE.finditer(text)}
    return SITE_PAGE.sub(lambda found: CALLED[language].format(found[1]), text), links


def _is_claim(node: ast.stmt) -> bool:
    """Whether a statement is an assert, or a loop of nothing but asserts."""
    if isinstance(node, ast.For | ast.With):
        return all(map(_is_claim, node.body))
    return isinstance(node, ast.Assert)


def _defines(node: ast.stmt) -> bool:
    return isinstance(node, ast.Import | ast.ImportFrom | ast.FunctionDef | ast.ClassDef)


WORDS = HERE / "source" / "zh.toml"
"""The Chinese of the comments and words of code cells."""
PLACES = {"loc", "ha", "va", "layout", "textcoords"}
"""Keywords whose words are matplotlib's."""
PROSE = re.compile(r"(?<![\w.(])[A-Za-z]{2,}[,:;]? \(?[a-z]{2,}(?![\w(.=\[])")
CHECK = re.compile(r"^((?:\w+ = )?tw\.(?:exercises\.check|ask)\(.*)\)$", re.MULTILINE)
"""A question, or the check of an exercise: it answers in the notebook's language and not in that of the machine."""
CHINESE_FIGURES = "tw.plot.chinese()  # 图中可以写汉字"


def said(code: str) -> list[tuple[int, int, str]]:
    """Return where each comment and each string of a code cell begins and ends, and its text as it is typed."""
    lines = code.splitlines(keepends=True)
    starts = [0, *itertools.accumulate(map(len, lines))]
    found = []
    for token in tokenize.generate_tokens(io.StringIO(code).readline):
        if token.type == tokenize.COMMENT:
            start = starts[token.start[0] - 1] + token.start[1]
            found.append((start, start + len(token.string), token.string))
    for node in _strings(ast.parse(code)):
        ends = (node.lineno, node.col_offset), (node.end_lineno or 0, node.end_col_offset or 0)
        start, end = (starts[k - 1] + len(lines[k - 1].encode()[:column].decode()) for k, column in ends)
        found.append((start, end, re.sub(r'^f?("""|")|("""|")$', "", code[start:end])))
    return sorted(found)


def _strings(node: ast.AST) -> Iterator[ast.Constant | ast.JoinedStr]:
    """Yield the strings below a node, an f-string as one, but those that say where a thing is drawn."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.JoinedStr) or (isinstance(child, ast.Constant) and isinstance(child.value, str)):
            yield child
        elif not (isinstance(child, ast.keyword) and child.arg in PLACES):
            yield from _strings(child)


def needs_chinese(text: str) -> bool:
    """Whether a comment or a string says something in English: a name, a unit or a formula needs no Chinese."""
    if text.startswith("#"):
        return bool(re.search("[A-Za-z]{3}", text))
    return bool(PROSE.search(re.sub(r"\{[^}]*\}", "{}", text)))


def in_chinese(code: str, words: dict[str, str]) -> str:
    """Return a code cell with its comments and its words in Chinese; raises ValueError where one has no Chinese."""
    for start, end, text in reversed(said(code)):
        if text not in words and needs_chinese(text):
            raise ValueError(f"{WORDS.name}: expected the Chinese of {text!r}")
        code = code[:start] + code[start:end].replace(text, words.get(text) or text) + code[end:]
    code = CHECK.sub(r'\1, language="zh")', code)
    lines = code.split("\n")
    if "import matplotlib.pyplot as plt" in lines:
        last = max(k for k, line in enumerate(lines) if line.startswith(("import ", "from ")))
        lines[last + 1 : last + 1] = ["", CHINESE_FIGURES]
    return "\n".join(lines)


def build(source: Path, language: str) -> str:
    """Return the notebook of a source in one language, as the text of an .ipynb."""
    notebook = nbformat.v4.new_notebook(metadata=METADATA)
    words = tomllib.loads(WORDS.read_text(encoding="utf-8")) if WORDS.exists() else {}
    own = words.get("all", {}) | words.get(source.stem, {})
    for cell in cells(source):
        head = AFTER[language].format(cell.metadata.get("after"))
        if cell.cell_type == "code" and "after" in cell.metadata:
            code = in_chinese(cell.source, own) if language == "zh" else cell.source
            notebook.cells.append(nbformat.v4.new_code_cell(f"# {head}\n{code}", metadata=FOLDED_AFTER))
        elif cell.cell_type == "code" and "setup" in cell.metadata:
            code = in_chinese(cell.source, own) if language == "zh" else cell.source
            notebook.cells.append(nbformat.v4.new_code_cell(f"{SETUP[language]}\n{code}", metadata=FOLDED))
        elif cell.cell_type == "code":
            for code, folded in unfolded(cell.source):
                stands = [THUMBNAIL] if THUMBNAIL in cell.metadata and "plt.show()" in code else []
                code = in_chinese(code, own) if language == "zh" else code
                metadata = (
                    {**FOLDED, "tags": [*FOLDED["tags"], *stands]} if folded else {"tags": stands} if stands else {}
                )
                notebook.cells.append(nbformat.v4.new_code_cell(code, metadata=metadata))
        elif cell.metadata["lang"] == language:
            text = chinese(cell.source) if language == "zh" else cell.source
            if "after" in cell.metadata:
                text = f"<details>\n<summary>{head}</summary>\n\n{text}\n\n</details>"
            text, links = without_site(text, language)
            notebook.cells.append(nbformat.v4.new_markdown_cell(text, metadata={"site": links} if links else {}))
    for k, cell in enumerate(notebook.cells):
        cell.id = f"cell-{k:02}"  # the same in every build: only what changed shows in a diff
    nbformat.validate(notebook)
    return nbformat.writes(notebook) + "\n"


def with_outputs(text: str, path: Path) -> str:
    """Return a built notebook with the outputs of the one that is there, unless its code has changed since."""
    there = nbformat.read(path, as_version=4) if path.exists() else nbformat.v4.new_notebook()
    notebook = nbformat.reads(text, as_version=4)
    ours, theirs = ([cell for cell in n.cells if cell.cell_type == "code"] for n in (notebook, there))
    if [cell.source for cell in ours] != [cell.source for cell in theirs]:
        return text
    for cell, other in zip(ours, theirs, strict=True):
        cell.outputs = other.outputs
    return nbformat.writes(notebook) + "\n"


def main(arguments: list[str] | None = None) -> int:
    """Write all notebooks, or check them."""
    parser = argparse.ArgumentParser(description="Build the notebooks from their sources.")
    parser.add_argument("--check", action="store_true", help="change nothing; exit 1 where a notebook is out of step")
    check = parser.parse_args(arguments).check
    stale = []
    for source in sources():
        for language in LANGUAGES:
            path = target(source, language)
            text = with_outputs(build(source, language), path)
            if path.exists() and path.read_text(encoding="utf-8") == text:
                continue
            stale.append(path.relative_to(HERE).as_posix())
            if not check:
                path.parent.mkdir(exist_ok=True)
                path.write_text(text, encoding="utf-8", newline="\n")
    for name in stale:
        print(f"{name}: out of step with its source" if check else name)
    return int(check and bool(stale))


if __name__ == "__main__":
    sys.exit(main())

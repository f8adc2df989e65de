"""The pages of the interface: one for each room, and in the chapter's rooms one for each file that offers something.

The order is that of the rooms' tables of files and of the table in docs/contributing.md, which also says to which
section a room belongs. What a page says comes from the docstrings, the formulas from docs/map.md. In Chinese each room
and each name has a line of its own from names.zh-CN.toml, and below it the docstring in English.
"""

from __future__ import annotations

import inspect
import re
import sys
import tomllib
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from sphinx.pycode import ModuleAnalyzer

import twistwrench as tw

from . import typeset
from .pages import ROOT, SUFFIX, contents, write

CHAPTER = ("spatial", "model", "algorithms")
"""The rooms that have a page for each file; their `__init__` has a table of them."""
PACKAGES = (*(name for name in tw.__all__ if isinstance(getattr(tw, name), ModuleType)), "validate")
"""Rooms whose names are used with the room's, as in tw.fast.rnea."""
LAST = "errors"
RETURNED = (
    *(f"algorithms.terms.{name}" for name in ("RneaTerms", "AbaTerms", "CrbaTerms", "CentroidalTerms", "Subtree")),
    *("model.report.Entry", "model.report.LoadReport", "model.Reduction", "model.Rerooting", "model.ScrewAxes"),
    *(f"contact.{name}" for name in ("ContactDynamics", "ContactForces", "Impact", "StanceMargins")),
    *("simulation.Simulation", "simulation.remark.Remark", "simulation.growth.MotionError"),
    *("algorithms.floating_base.Equilibrium", "fast.program.Program", "tracing.Trace"),
    *("advice.Advice", "advice.Decision", "error_bounds.Accuracy", "identification.BaseParameters"),
)
"""What public functions return, by the room that has it: users do not make one by hand."""
TITLE = {"en": "Interface", "zh": "接口"}
INTRO = {
    "en": "Every public name, by the folder and the file that hold it, in the chapter's order. Each entry says shape, "
    "unit and frame of every array, which errors are raised, and which formula of the chapter it computes; the "
    "examples are run by the tests. `import twistwrench as tw` is understood.",
    "zh": "所有公开名称，按所在的文件夹与文件排列，顺序与本章一致。"
    "每一项写明各数组的形状、单位与坐标系，会抛出哪些异常，计算本章的哪个公式；其中的例子都由测试运行。"
    "每个名称有一句中文，其后的文档字符串是英文。以下均假定 `import twistwrench as tw`。",
}
HEAD = {"en": ("Name", "What it gives"), "zh": ("名称", "给出什么")}
IN_THE_CHAPTER = {"en": "In the chapter", "zh": "本章公式"}
ROW = {"en": "- {} {}: {} (``{}``)", "zh": "- {} {}：{}（``{}``）"}
STOP = {"en": ".", "zh": "。"}
NOTE = {"en": "", "zh": "每个名称先用一句中文说明，其后的文档字符串是英文。\n\n"}


class Formula(NamedTuple):
    """A row of docs/map.md."""

    section: str
    what: str
    formula: str
    file: str


def rooms() -> list[str]:
    """Return the rooms in the order of the table in docs/contributing.md, the errors last."""
    found = dict.fromkeys(file.split("/")[0] for file in _rows())
    return [*(room for room in found if room != LAST), LAST]


def sections() -> dict[str, str]:
    """Return the section of the chapter of each page: of a file by its room's table, of a room by contributing.md."""
    found = {room: section for room, section in _rows().items() if section and "/" not in room}
    for room in CHAPTER:
        found |= {f"{room}/{file}": section for file, section in files(room).items() if section}
    return found


def files(room: str) -> dict[str, str]:
    """Return the files of a room of the chapter, in the order of the table in its `__init__`, with their sections."""
    docstring = inspect.getdoc(_module(room)) or ""
    return dict(re.findall(r"^(\w+) +(49\.\d+)?", docstring.split("==\n")[2], re.MULTILINE))


def _rows() -> dict[str, str]:
    """Return what contributing.md's table names, each file or folder of the source, with its section or nothing."""
    rows = re.findall(r"^\| (49\.\d+)? ?\|([^|]*`)[^|]*\|.*\|$", _text("docs/contributing", "en"), re.MULTILINE)
    return {file: section for section, cell in rows for file in re.findall(r"`([\w/]+?)(?:\.py|/)`", cell)}


def formulas(language: str) -> dict[str, list[Formula]]:
    """Return the chapter's formulas by the dotted name that computes them, from docs/map.md."""
    found: dict[str, list[Formula]] = {}
    section = ""
    for line in _text("docs/map", language).splitlines():
        if heading := re.match(r"## (49\.\d+)", line):
            section = heading[1]
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 6 and re.fullmatch(r"`[\w.]+`", cells[2]):
            what, formula, call, file = cells[:4]
            found.setdefault(f"twistwrench.{call.strip('`')}", []).append(
                Formula(section, what, formula, file.strip("`"))
            )
    return found


def by_page() -> dict[str, list[str]]:
    """Return the public names of each page, in the order of the source; a page is a room, or a file of a chapter's."""
    order = [page for room in rooms() for page in ([f"{room}/{f}" for f in files(room)] if room in CHAPTER else [room])]
    owners: dict[str, list[str]] = {page: [] for page in order}
    offered = [name for name in tw.__all__ if name not in PACKAGES]
    offered += [f"{room}.{name}" for room in PACKAGES for name in _module(room).__all__]
    for name in (*offered, *RETURNED):
        owners[_page_of(name)].append(name)
    return {page: sorted(names, key=_place) for page, names in owners.items() if names}


def by_room() -> dict[str, list[str]]:
    """Return the pages of each room."""
    found: dict[str, list[str]] = {}
    for page in by_page():
        found.setdefault(page.split("/")[0], []).append(page)
    return found


def _page_of(name: str) -> str:
    """Return the page of a name: the room that it is used with, or that of the file that defines it."""
    if (room := name.split(".")[0]) in PACKAGES:
        return room
    _, room, *more = _value(name).__module__.split(".")
    return "/".join([room, *more]) if room in CHAPTER else str(room)


def _place(name: str) -> tuple[str, int]:
    value = _value(name)
    try:
        return inspect.getsourcefile(value) or "", inspect.getsourcelines(value)[1]
    except (OSError, TypeError):
        return "", 0


def _value(name: str) -> Any:
    module, _, own = name.rpartition(".")
    return getattr(_module(module) if module else tw, own)


def _module(name: str) -> ModuleType:
    return import_module(f"twistwrench.{name}")


def _text(path: str, language: str) -> str:
    return (ROOT / f"{path}{SUFFIX[language]}.md").read_text(encoding="utf-8")


def chinese() -> dict[str, str]:
    """Return what each public name gives, and what each room is for, in Chinese."""
    return tomllib.loads((Path(__file__).parent / "names.zh-CN.toml").read_text(encoding="utf-8"))


def first_line(name: str) -> str:
    """Return the first paragraph of what the source says of a name, in one line."""
    value = _value(name)
    said = (inspect.getdoc(value) or "") if callable(value) else "\n".join(_said(name))
    return " ".join(said.split("\n\n")[0].split())


def said_of_room(room: str) -> str:
    """Return the first paragraph of what the source says of a room, in one line, without the full stop."""
    return " ".join((inspect.getdoc(_module(room)) or "").split("\n\n")[0].split()).rstrip(".")


def write_interface(out: Path, language: str) -> None:
    """Write a page for each room, in the chapter's one for each file, and the list of all names."""
    owners, own = by_page(), chinese() if language == "zh" else {}
    rows = [f"# {TITLE[language]}", INTRO[language]]
    for room, pages in by_room().items():
        line = own.get(f"{room}/") or said_of_room(room)
        rows += [f"## [`{room}`]({room}.md)", _text_of(line) + STOP[language]]
        for page in pages:
            write(out / "api" / f"{page}.md", _page(page, owners[page], language))
            if room in CHAPTER:
                rows.append(f"### {_title(page, f'({page}.md)')}")
            table = ["| {} | {} |\n|---|---|".format(*HEAD[language])]
            table += [_row(name, own.get(name) or first_line(name)) for name in owners[page]]
            rows.append("\n".join([":::{container} names", "", *table, ":::"]))
        if room in CHAPTER:
            write(out / "api" / f"{room}.md", f"{_page(room, [], language)}\n{contents(pages)}\n")
    rows.append(contents(list(by_room()), hidden=True))
    write(out / "api" / "index.md", "\n\n".join(rows) + "\n")


def _title(page: str, link: str = "") -> str:
    """Return section and name of a page, 49.2 `rotation`."""
    name = f"`{page.split('/')[-1]}`"
    return f"{sections().get(page, '')} {f'[{name}]{link}' if link else name}".strip()


def _row(name: str, what: str) -> str:
    shown = name.rpartition(".")[2] if name in RETURNED else name
    return f"| {{py:obj}}`{shown} <twistwrench.{name}>` | {_text_of(what)} |"


def _text_of(line: str) -> str:
    """Return a line, without its full stop, such that Markdown takes nothing in it for its own but code."""
    parts = re.split(r"(`[^`]+`)", line.rstrip("."))
    return "".join(part if k % 2 else re.sub(r"([|*_\[\]<>$])", r"\\\1", part) for k, part in enumerate(parts))


def _page(page: str, names: list[str], language: str) -> str:
    head = f".. automodule:: twistwrench.{page.replace('/', '.')}\n   :no-members:"
    if page in tw.__all__ and not isinstance(getattr(tw, page), ModuleType):  # tw.robots is the function
        head = inspect.getdoc(_module(page)) or ""
    entries = [head, ".. currentmodule:: twistwrench", *map(_entry, names)]
    note = NOTE[language] if names else ""
    return f"# {_title(page)}\n\n{note}````{{eval-rst}}\n" + "\n\n".join(entries) + "\n````\n"


def _entry(name: str) -> str:
    value = _value(name)
    if not inspect.isclass(value):
        return f".. autofunction:: twistwrench.{name}" if callable(value) else _constant(name)
    options = [":members:"]
    if issubclass(value, tuple):  # the docstring describes the fields; what every tuple can do is not ours
        options.append(f":exclude-members: {', '.join(getattr(value, '_fields', ()))}")
    elif not issubclass(value, BaseException):
        options.append(":inherited-members:")
    return "\n   ".join([f".. autoclass:: twistwrench.{name}", *options])


def _constant(name: str) -> str:
    return "\n   ".join([f".. py:data:: {name}", "", *_said(name)])


def _said(name: str) -> list[str]:
    """Return the string that stands below a constant in the source."""
    package, _, own = name.rpartition(".")
    modules = [module for module in sys.modules if module.startswith(f"twistwrench.{package}")]
    said = [ModuleAnalyzer.for_module(module).find_attr_docs().get(("", own), []) for module in modules]
    return max(said, key=len, default=[])


def connect(app: Any, language: str) -> None:
    """Let Sphinx put the chapter's formulas below the first paragraph of each docstring, in Chinese a line above it."""
    known, own = formulas(language), chinese() if language == "zh" else {}

    def add(app: Any, what: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
        lines[:] = _bars("\n".join(lines)).split("\n")
        if rows := known.get(name):
            end = lines.index("") if "" in lines else len(lines)
            said = [ROW[language].format(row.section, _rst(row.what), _set(row.formula), row.file) for row in rows]
            lines[end:end] = ["", f"*{IN_THE_CHAPTER[language]}*", "", *said, ""]
        if phrase := own.get(name.removeprefix("twistwrench.") + ("/" if what == "module" else "")):
            lines[:0] = [f"{_rst(phrase)}。", ""]

    app.connect("autodoc-process-docstring", add, priority=600)  # after napoleon
    app.connect("missing-reference", _find_returned)


def _find_returned(app: Any, env: Any, node: Any, shown: Any) -> Any:
    """Let a docstring call a record by its own name alone, `RneaTerms`."""
    short = {name.rpartition(".")[2]: name for name in RETURNED}
    if (target := node.get("reftarget")) not in short or node.get("refdomain") != "py":
        return None
    place = env.get_domain("py")
    return place.resolve_xref(env, node["refdoc"], app.builder, "obj", f"twistwrench.{short[target]}", node, shown)


def _bars(text: str) -> str:
    """Escape the bars of |ω|, which would be substitutions, but not in examples and literals."""
    parts = re.split(r"(^ *>>> .*?(?:\n\n|\Z)|``.*?``|::\n\n(?:(?: +.*)?\n)+)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(part if k % 2 else part.replace("|", r"\|") for k, part in enumerate(parts))


def _set(formula: str) -> str:
    """Return a formula for a docstring; what follows it may be a bracket of Chinese, which would not end it."""
    read = typeset.tex(formula)
    return f":math:`{read}`\\ " if read else _rst(formula)


def _rst(text: str) -> str:
    parts = re.split(r"(`[^`]+`)", text)
    return "".join(f"`{part}`" if part[0] == "`" else re.sub(r"([*|_\\])", r"\\\1", part) for part in parts if part)

"""The pages of the interface: one for each section that offers something, in the chapter's order.

What they say comes from the docstrings, the section from README's table of files, the formulas from docs/map.md. In
Chinese each name has a line of its own from names.zh-CN.toml, and below it the docstring in English.
"""

from __future__ import annotations

import importlib
import inspect
import re
import sys
import tomllib
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from sphinx.pycode import ModuleAnalyzer

import twistwrench as tw
from twistwrench.exercises.catalogue import SECTIONS

from .pages import ROOT, SUFFIX, contents, write

PACKAGES = ("newton_euler_3d", "fast", "bridge", "plot", "validate", "exercises")
"""Sections that are used by their own name, as in tw.fast.rnea."""
FIRST = ("model", "joint_types", "builder", "trees", "robots", "errors")
"""Of the sections without a number those that come first; the others follow by name."""
LATER = {"en": "Models, tools and errors", "zh": "模型、工具与异常"}
TITLE = {"en": "Interface", "zh": "接口"}
INTRO = {
    "en": "Every public name, by the section of the chapter that it belongs to. Each entry says shape, unit and frame "
    "of every array, which errors are raised, and which formula of the chapter it computes; the examples are run by "
    "the tests. `import twistwrench as tw` is understood.",
    "zh": "所有公开名称，按所属的章节排列。每一项写明各数组的形状、单位与坐标系，会抛出哪些异常，计算本章的哪个公式；"
    "其中的例子都由测试运行。"
    "每个名称有一句中文，其后的文档字符串是英文。以下均假定 `import twistwrench as tw`。",
}
HEAD = {"en": ("Name", "What it gives"), "zh": ("名称", "给出什么")}
IN_THE_CHAPTER = {"en": "In the chapter", "zh": "本章公式"}
ROW = {"en": "- {} {}: {} (``{}``)", "zh": "- {} {}：{}（``{}``）"}
NOTE = {"en": "", "zh": "每个名称先用一句中文说明，其后的文档字符串是英文。\n\n"}


class Formula(NamedTuple):
    """A row of docs/map.md."""

    section: str
    what: str
    formula: str
    file: str


def sections() -> dict[str, str]:
    """Return the section of the chapter of each file or folder that README's table names."""
    found = {}
    for section, files in re.findall(r"^\| (49\.\d+) \|([^|]*)\|", _text("README", "en"), re.MULTILINE):
        for name in re.findall(r"`(\w+)(?:\.py|/)`", files):
            found[name] = section
    return found


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


def by_section() -> dict[str, list[str]]:
    """Return the public names of each section's file or folder, in the chapter's order, the others after them."""
    at = sections()
    owners: dict[str, list[str]] = {section: [] for section in at}
    for name in tw.__all__:
        value = getattr(tw, name)
        if not isinstance(value, ModuleType):
            owners.setdefault(value.__module__.split(".")[1], []).append(name)
    for package in dict.fromkeys([*PACKAGES, *(n for n in tw.__all__ if isinstance(getattr(tw, n), ModuleType))]):
        owners[package] = [f"{package}.{name}" for name in getattr(_module(package), "__all__", [])]
    order = [*sorted(at, key=lambda section: _number(at[section])), *FIRST, *sorted(owners)]
    return {s: sorted(owners[s], key=_place) for s in sorted(owners, key=order.index) if owners[s]}


def _number(section: str) -> int:
    return int(section.partition(".")[2])


def _place(name: str) -> tuple[str, int]:
    value = _value(name)
    try:
        return inspect.getsourcefile(value) or "", inspect.getsourcelines(value)[1]
    except (OSError, TypeError):
        return "", 0


def _value(name: str) -> Any:
    package, _, rest = name.rpartition(".")
    return getattr(_module(package) if package else tw, rest)


def _module(name: str) -> ModuleType:
    return importlib.import_module(f"twistwrench.{name}") if name not in tw.__all__ else getattr(tw, name)


def _text(path: str, language: str) -> str:
    return (ROOT / f"{path}{SUFFIX[language]}.md").read_text(encoding="utf-8")


def chinese() -> dict[str, str]:
    """Return what each public name gives, in Chinese."""
    return tomllib.loads((Path(__file__).parent / "names.zh-CN.toml").read_text(encoding="utf-8"))


def first_line(name: str) -> str:
    """Return the first paragraph of what the source says of a name, in one line."""
    value = _value(name)
    said = (inspect.getdoc(value) or "") if callable(value) else "\n".join(_said(name))
    return " ".join(said.split("\n\n")[0].split())


def write_interface(out: Path, language: str) -> None:
    """Write a page for each section, and the list of them all."""
    at, owners = sections(), by_section()
    for section, names in owners.items():
        write(out / "api" / f"{section}.md", _page(section, names, at.get(section, ""), language))
    own = chinese() if language == "zh" else {}
    rows = [f"# {TITLE[language]}", INTRO[language]]
    numbered = sorted({at[s] for s in owners if s in at}, key=_number)
    for number in [*numbered, ""]:
        mine = [section for section in owners if at.get(section, "") == number]
        rows.append(f"## {number} {SECTIONS[number].of(language)}" if number else f"## {LATER[language]}")
        table = ["| {} | {} |\n|---|---|".format(*HEAD[language])]
        table += [_row(name, own.get(name) or first_line(name)) for section in mine for name in owners[section]]
        rows.append("\n".join([":::{container} names", "", *table, ":::"]))
    rows.append(contents(list(owners), hidden=True))
    write(out / "api" / "index.md", "\n\n".join(rows) + "\n")


def _row(name: str, what: str) -> str:
    what = re.sub(r"([|*_\[\]<>$])", r"\\\1", what.rstrip("."))
    return f"| {{py:obj}}`{name} <twistwrench.{name}>` | {what} |"


def _page(section: str, names: list[str], number: str, language: str) -> str:
    module = f"twistwrench.{section}"
    if section in tw.__all__ and not isinstance(getattr(tw, section), ModuleType):  # tw.robots is the function
        head = inspect.getdoc(importlib.import_module(f"{module}")) or ""
    else:
        head = f".. automodule:: {module}\n   :no-members:"
    title = f"# {number} `{section}`".replace("  ", " ")
    entries = [head, ".. currentmodule:: twistwrench", *map(_entry, names)]
    return f"{title}\n\n{NOTE[language]}````{{eval-rst}}\n" + "\n\n".join(entries) + "\n````\n"


def _entry(name: str) -> str:
    value = _value(name)
    if not inspect.isclass(value):
        return f".. autofunction:: twistwrench.{name}" if callable(value) else _constant(name)
    options = [":members:"]
    if issubclass(value, tuple):  # the docstring describes the fields; what every tuple can do is not ours
        options.append(f":exclude-members: {', '.join(value._fields)}")
    elif not issubclass(value, BaseException):
        options.append(":inherited-members:")
    return "\n   ".join([f".. autoclass:: twistwrench.{name}", *options])


def _constant(name: str) -> str:
    return "\n   ".join([f".. py:data:: {name}", "", *_said(name)])


def _said(name: str) -> list[str]:
    """Return the string that stands below a constant in the source."""
    package, _, own = name.partition(".")
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
            said = [ROW[language].format(row.section, _rst(row.what), _rst(row.formula), row.file) for row in rows]
            lines[end:end] = ["", f"*{IN_THE_CHAPTER[language]}*", "", *said, ""]
        if phrase := own.get(name.removeprefix("twistwrench.")):
            lines[:0] = [f"{_rst(phrase)}。", ""]

    app.connect("autodoc-process-docstring", add, priority=600)  # after napoleon


def _bars(text: str) -> str:
    """Escape the bars of |ω|, which would be substitutions, but not in examples and literals."""
    parts = re.split(r"(^ *>>> .*?(?:\n\n|\Z)|``.*?``|::\n\n(?:(?: +.*)?\n)+)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(part if k % 2 else part.replace("|", r"\|") for k, part in enumerate(parts))


def _rst(text: str) -> str:
    parts = re.split(r"(`[^`]+`)", text)
    return "".join(f"`{part}`" if part[0] == "`" else re.sub(r"([*|_\\])", r"\\\1", part) for part in parts if part)

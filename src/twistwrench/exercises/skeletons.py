"""The files that a student starts from, written out of the exercises."""

from __future__ import annotations

import ast
import inspect
import textwrap
from os import PathLike
from pathlib import Path
from typing import cast

from ..files import write_text
from . import catalogue
from .exercise import Exercise, Part
from .text import Language, Text, default_language
from .workbook import STATE_FILE, Workbook
from .wrapping import columns, wrapped

__all__ = ["skeleton", "solved", "source_of", "start"]

PYTEST_INI = """\
[pytest]
addopts = -p twistwrench.exercises.checking --tb=short -q -rN
"""

HEAD = {
    "en": '''"""{title}.

Replace each `...` by your answer and run `python -m pytest {file}` in this folder. Twists are (ω, v),
wrenches (τ, f), units SI. `twistwrench exercises hint {first}` gives a hint, and the next one when asked again.

After the exercises of Chapter 49 of the Robotics Tutorial by Pengfei Guo (CC BY 4.0), in other words.
"""
''',
    "zh": '''"""{title}。

把每个 `...` 换成你的答案，然后在本目录运行 `python -m pytest {file}`。twist 为 (ω, v)，wrench 为 (τ, f)，
使用国际单位。`twistwrench exercises hint {first}` 给出一条提示，再次运行给出下一条。

改写自 Robotics Tutorial 第 49 章的练习，作者 Pengfei Guo(CC BY 4.0)。
"""
''',
}

IMPORTS = """
import numpy as np

import twistwrench as tw
"""

YOURS = Text("yours where it is right, else the reference", "你的实现正确时用你的，否则用参考实现")
WORDS = Text("In your own words, as a string:", "用自己的话回答，写成字符串：")


def start(folder: str | PathLike[str], *, language: Language | None = None) -> tuple[list[Path], list[Path]]:
    """Write the skeletons of all exercises into a folder. Existing files are not touched.

    Parameters
    ----------
    folder : str or path
        Made if need be.
    language : {"en", "zh"}, optional
        Of texts and messages; that of the environment unless given.

    Returns
    -------
    new, kept : list of path
        The files that were written, and those that were there before.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    asked = language or (Workbook(folder).language if (folder / STATE_FILE).exists() else default_language())
    files = {"pytest.ini": PYTEST_INI}
    files |= {catalogue.file_name(s): skeleton(s, asked) for s in catalogue.SECTIONS if catalogue.of_section(s)}
    new, kept = [], []
    for name, text in files.items():
        path = folder / name
        if path.exists():
            kept.append(path)
        else:
            write_text(path, text)
            new.append(path)
    Workbook(folder).remember(language=asked)
    return new, kept


def skeleton(section: str, language: Language) -> str:
    """Return the student's file of a section, as it is before the start."""
    return _file(section, language, solve=False)


def solved(section: str, language: Language) -> str:
    """Return the student's file of a section with every solution written in."""
    return _file(section, language, solve=True)


def _file(section: str, language: Language, *, solve: bool) -> str:
    exercises = catalogue.of_section(section)
    title, file = _title(section).of(language), catalogue.file_name(section)
    text = HEAD[language].format(section=section, title=title, file=file, first=exercises[0].id) + IMPORTS
    uses = list(dict.fromkeys(name for exercise in exercises for name in exercise.uses))
    text += "from twistwrench.exercises import mine\n"
    if uses:
        text += "\n"
        origin = {name: catalogue.find_part(name)[0].id for name in uses}
        text += "".join(f'{name} = mine("{name}")  # {origin[name]}: {YOURS.of(language)}\n' for name in uses)
    return text + "".join(_exercise(exercise, language, solve=solve) for exercise in exercises)


def _title(section: str) -> Text:
    title = catalogue.SECTIONS[section]
    if section == "project":
        return Text(f"{title.en} at the end of the chapter", f"章末的{title.zh}")
    return Text(f"Section {section}: {title.en}", f"{section} 节：{title.zh}")


def _exercise(exercise: Exercise, language: Language, *, solve: bool) -> str:
    """Write one exercise: its text as a comment, its functions, the place for the words."""
    rule = "# " + "-" * 98
    lines = [f"{exercise.id}  {exercise.title.of(language)}", "", *wrapped(exercise.text.of(language))]
    text = "\n\n" + rule + "\n" + "".join(f"# {line}".rstrip() + "\n" for line in lines) + rule + "\n"
    for part in exercise.parts:
        text += "\n\n" + (source_of(part, language) if solve else _stub(part, language))
    if exercise.answer is not None:
        words = '"""' + inspect.cleandoc(exercise.answer.of(language)) + '"""' if solve else "..."
        text += f"\n\n# {WORDS.of(language)}\n{exercise.answer_name} = {words}\n"
    return text


def _docstring(part: Part, language: Language) -> str:
    """Write the docstring of a function, on one line where it fits."""
    lines = [line for text in inspect.cleandoc(part.doc.of(language)).split("\n") for line in wrapped(text, 94) or [""]]
    end = "\n" if len(lines) > 1 or columns(lines[0]) > 88 else ""
    return textwrap.indent('"""' + "\n".join(lines) + end + '"""', "    ") + "\n"


def _head(part: Part) -> str:
    if inspect.isclass(part.solution):
        return f"class {part.name}:\n"
    return f"def {part.name}({part.arguments}):\n"


def _stub(part: Part, language: Language) -> str:
    given = textwrap.indent(textwrap.dedent(part.given).strip("\n"), "    ")
    given = ("\n" if inspect.isclass(part.solution) else "") + given + ("\n" if given else "")
    last = "" if inspect.isclass(part.solution) else "    return ...\n"
    return _head(part) + _docstring(part, language) + given + last


def _untyped(node: ast.ClassDef) -> str:
    """Return the methods of a class without types."""
    methods = [method for method in node.body if isinstance(method, ast.FunctionDef)]
    for method in methods:
        method.returns = None
        for argument in method.args.args:
            argument.annotation = None
    return "\n" + "\n\n".join(map(ast.unparse, methods)) + "\n"


def source_of(part: Part, language: Language) -> str:
    """Return the solution of a part as the student would write it: no types, the skeleton's docstring."""
    source = textwrap.dedent(inspect.getsource(part.solution))
    node = cast("ast.FunctionDef | ast.ClassDef", ast.parse(source).body[0])
    if isinstance(node, ast.ClassDef):
        return _head(part) + _docstring(part, language) + textwrap.indent(_untyped(node), "    ")
    documented = ast.get_docstring(node) is not None
    start = (node.body[0].end_lineno or 0) if documented else node.body[0].lineno - 1
    return _head(part) + _docstring(part, language) + "\n".join(source.split("\n")[start:]).rstrip() + "\n"

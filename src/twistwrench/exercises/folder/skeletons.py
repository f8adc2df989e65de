"""The files that a student starts from, written out of the exercises."""

from __future__ import annotations

import inspect
import textwrap
from os import PathLike
from pathlib import Path

from ...files import write_text
from .. import catalogue
from ..exercise import Exercise, Part
from ..words.text import Language, Text, default_language
from ..words.wrapping import wrapped
from .sources import docstring, head, solution_sources
from .workbook import STATE_FILE, Workbook

__all__ = ["opening", "place", "skeleton", "solved", "start"]

PYTEST_INI = """\
[pytest]
addopts = -p twistwrench.exercises.checking --tb=short -q -rN
"""

HEAD = {
    "en": '''"""{title}.

Replace each `...` by your answer and run `python -m pytest {file}` in this folder. Twists are (ω, v),
wrenches (τ, f), units SI. A function must not change its arguments: work on copies. They may be whole numbers, as
in `np.array([1, 0, 0])`; a robot may have joints of any kind, or none, and links without mass. It may call what the
package has, unless the text rules it out.
`twistwrench exercises hint {first}` gives a hint, and the next one when asked again.

After the exercises of Chapter 49 of the Robotics Tutorial by Pengfei Guo (CC BY 4.0), in other words.
"""
''',
    "zh": '''"""{title}。

把每个 `...` 换成你的答案，然后在本目录运行 `python -m pytest {file}`。twist 为 (ω, v)，wrench 为 (τ, f)，
使用国际单位。函数不得修改传入的参数，请在副本上计算；参数可能是整数，例如 `np.array([1, 0, 0])`；
机器人的关节可以是任何类型，也可以没有关节，可以有质量为零的连杆。
除题目禁止的以外，可以调用本包的函数。
`twistwrench exercises hint {first}` 给出一条提示，再次运行给出下一条。

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


def opening(section: str, language: Language) -> str:
    """Return how the student's file of a section begins: its title, and what all of its exercises may use."""
    exercises = catalogue.of_section(section)
    title, file = _title(section).of(language), catalogue.file_name(section)
    text = HEAD[language].format(section=section, title=title, file=file, first=exercises[0].id) + IMPORTS
    uses = list(dict.fromkeys(name for exercise in exercises for name in exercise.uses))
    text += "from twistwrench.exercises import mine\n"
    if uses:
        text += "\n"
        origin = {name: catalogue.find_part(name)[0].id for name in uses}
        text += "".join(f'{name} = mine("{name}")  # {origin[name]}: {YOURS.of(language)}\n' for name in uses)
    return text


def _file(section: str, language: Language, *, solve: bool) -> str:
    written = (_text(e, language) + "\n\n" + place(e, language, solve=solve) for e in catalogue.of_section(section))
    return opening(section, language) + "".join(written)


def _title(section: str) -> Text:
    title = catalogue.SECTIONS[section]
    if section == "project":
        return Text(f"{title.en} at the end of the chapter", f"章末的{title.zh}")
    return Text(f"Section {section}: {title.en}", f"{section} 节：{title.zh}")


def _text(exercise: Exercise, language: Language) -> str:
    """Return what an exercise asks, as a comment."""
    rule = "# " + "-" * 98
    lines = [f"{exercise.id}  {exercise.title.of(language)}", "", *wrapped(exercise.text.of(language))]
    return "\n\n" + rule + "\n" + "".join(f"# {line}".rstrip() + "\n" for line in lines) + rule + "\n"


def place(exercise: Exercise, language: Language, *, solve: bool = False) -> str:
    """Return where the answer to an exercise is written: its functions, and the place for the words."""
    written = solution_sources(exercise, language) if solve else [_stub(part, language) for part in exercise.parts]
    text = "\n\n".join(written)
    if exercise.answer is not None:
        words = '"""' + inspect.cleandoc(exercise.answer.of(language)) + '"""' if solve else "..."
        text += f"\n\n# {WORDS.of(language)}\n{exercise.answer_name} = {words}\n"
    return text


def _stub(part: Part, language: Language) -> str:
    given = textwrap.indent(textwrap.dedent(part.given).strip("\n"), "    ")
    given = ("\n" if inspect.isclass(part.solution) else "") + given + ("\n" if given else "")
    last = "" if inspect.isclass(part.solution) else "    return ...\n"
    return head(part) + docstring(part, language) + given + last

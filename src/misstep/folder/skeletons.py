"""The files that a student starts from, written out of the exercises."""

from __future__ import annotations

import inspect
import textwrap
from os import PathLike
from pathlib import Path

from ..course import Course
from ..exercise import Exercise, Part
from ..files import write_text
from ..text import Language, Text, default_language, wrapped
from .sources import docstring, head, solution_sources
from .workbook import Workbook

__all__ = ["opening", "place", "skeleton", "solved", "start"]

PYTEST_INI = """\
[pytest]
addopts = -p {plugin} --tb=short -q -rN
"""

YOURS = Text("yours where it is right, else the reference", "你的实现正确时用你的，否则用参考实现")
WORDS = Text("In your own words, as a string:", "用自己的话回答，写成字符串：")


def start(
    course: Course, folder: str | PathLike[str], *, language: Language | None = None
) -> tuple[list[Path], list[Path]]:
    """Write the skeletons of all exercises into a folder. Existing files are not touched.

    Parameters
    ----------
    course : Course
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
    kept_language = Workbook(course, folder).language if (folder / course.state_file).exists() else default_language()
    asked = language or kept_language
    files = {"pytest.ini": PYTEST_INI.format(plugin=course.plugin)}
    files |= {course.file_name(s): skeleton(course, s, asked) for s in course.sections if course.of_section(s)}
    new, kept = [], []
    for name, text in files.items():
        path = folder / name
        if path.exists():
            kept.append(path)
        else:
            write_text(path, text)
            new.append(path)
    Workbook(course, folder).remember(language=asked)
    return new, kept


def skeleton(course: Course, section: str, language: Language) -> str:
    """Return the student's file of a section, as it is before the start."""
    return _file(course, section, language, solve=False)


def solved(course: Course, section: str, language: Language) -> str:
    """Return the student's file of a section with every solution written in."""
    return _file(course, section, language, solve=True)


def opening(course: Course, section: str, language: Language) -> str:
    """Return how the student's file of a section begins: its title, and what all of its exercises may use."""
    exercises = course.of_section(section)
    title, file = course.title(section).of(language), course.file_name(section)
    text = course.opening.of(language).format(title=title, file=file, first=exercises[0].id)
    uses = list(dict.fromkeys(name for exercise in exercises for name in exercise.uses))
    if uses:
        text += "\n"
        origin = {name: course.find_part(name)[0].id for name in uses}
        text += "".join(f'{name} = mine("{name}")  # {origin[name]}: {YOURS.of(language)}\n' for name in uses)
    return text


def _file(course: Course, section: str, language: Language, *, solve: bool) -> str:
    written = (_text(e, language) + "\n\n" + place(e, language, solve=solve) for e in course.of_section(section))
    return opening(course, section, language) + "".join(written)


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

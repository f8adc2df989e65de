"""The files that a student starts from, and the solutions as they would stand there: written out of the exercises."""

from __future__ import annotations

import ast
import inspect
import re
import textwrap
from collections import defaultdict
from collections.abc import Callable, Iterable
from os import PathLike
from pathlib import Path
from typing import Any, cast

from .course import Course
from .exercise import Exercise, Part
from .files import write_text
from .text import Language, Text, columns, default_language, wrapped
from .workbook import Workbook

__all__ = ["opening", "place", "skeleton", "solution_sources", "solved", "start"]

Function = Callable[..., Any]

PYTEST_INI = "[pytest]\naddopts = -p {plugin} --tb=short -q -rN\n"
RULE = "# " + "-" * 98 + "\n"
YOURS = Text("yours where it is right, else the reference", "你的实现正确时用你的，否则用参考实现")
WORDS = Text("In your own words, as a string:", "用自己的话回答，写成字符串：")


def start(
    course: Course, folder: str | PathLike[str], *, language: Language | None = None, cure: bool = True
) -> tuple[list[Path], list[Path]]:
    """Write the skeletons into a folder; return the files that are new, and those that were there and stay.

    Without `cure`, messages in this folder never say what to write instead.
    """
    book = Workbook(course, folder)
    book.folder.mkdir(parents=True, exist_ok=True)
    has_state = (book.folder / course.state_file).exists()
    asked = language or (book.language if has_state else default_language())
    files = {"pytest.ini": PYTEST_INI.format(plugin=course.plugin)}
    files |= {course.file_name(s): skeleton(course, s, asked) for s in course.sections if course.of_section(s)}
    kept = [book.folder / name for name in files if (book.folder / name).exists()]
    new = [book.folder / name for name in files if not (book.folder / name).exists()]
    for path in new:
        write_text(path, files[path.name])
    book.remember(language=asked, **({} if cure else {"cure": False}))
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
    uses = {name: course.find_part(name)[0].id for exercise in exercises for name in exercise.uses}
    lines = [f'{name} = mine("{name}")  # {origin}: {YOURS.of(language)}\n' for name, origin in uses.items()]
    return text + "\n" * bool(lines) + "".join(lines)


def _file(course: Course, section: str, language: Language, *, solve: bool) -> str:
    text = opening(course, section, language)
    for exercise in course.of_section(section):
        lines = [f"{exercise.id}  {exercise.title.of(language)}", "", *wrapped(exercise.text.of(language))]
        asked = "".join(f"# {line}".rstrip() + "\n" for line in lines)
        text += "\n\n" + RULE + asked + RULE + "\n\n" + place(exercise, language, solve=solve)
    return text


def place(exercise: Exercise, language: Language, *, solve: bool = False) -> str:
    """Return where the answer to an exercise is written: its functions, and the place for the words."""
    written = solution_sources(exercise, language) if solve else [_stub(part, language) for part in exercise.parts]
    text = "\n\n".join(written)
    if exercise.answer is not None:
        words = '"""' + inspect.cleandoc(exercise.answer.of(language)) + '"""' if solve else "..."
        text += f"\n\n# {WORDS.of(language)}\n{exercise.answer_name} = {words}\n"
    return text


def _stub(part: Part, language: Language) -> str:
    given = textwrap.indent(textwrap.dedent(part.given).strip("\n"), "    ") + "\n" * bool(part.given.strip())
    if inspect.isclass(part.solution):
        return _head(part, language) + "\n" + given
    return _head(part, language) + given + "    return ...\n"


def _head(part: Part, language: Language) -> str:
    """Write the first line and the docstring, whose lines end where a sentence does, or are filled."""
    head = f"class {part.name}:\n" if inspect.isclass(part.solution) else f"def {part.name}({part.arguments}):\n"
    sentences = re.split(r"(?<=[.。:：\n])\n|(?<=[.。][)）])\n", inspect.cleandoc(part.doc.of(language)))
    lines = [line for text in sentences for line in wrapped(text, 94) or [""]]
    end = "\n" if len(lines) > 1 or columns(lines[0]) > 88 else ""
    return head + textwrap.indent('"""' + "\n".join(lines) + end + '"""', "    ") + "\n"


# ---------------------------------------------------------------- solutions


def solution_sources(exercise: Exercise, language: Language) -> list[str]:
    """Return the solutions of an exercise; before each, what it calls and no earlier one has shown."""
    written: list[str] = []
    shown: set[Function] = set()
    for part in exercise.parts:
        new = [function for function in part.beside if function not in shown]
        shown.update(new)
        imports = _imports(new, shown, exercise.course.package_name)
        written += [*([imports] if imports else []), *map(_untyped, new), _solution(part, language)]
    return written


def _solution(part: Part, language: Language) -> str:
    """Return the solution of a part as the student would write it: no types, the skeleton's docstring."""
    node, lines = _parsed(part.solution)
    if isinstance(node, ast.ClassDef):
        return _head(part, language) + textwrap.indent(_methods(node), "    ")
    has_docstring = ast.get_docstring(node) is not None
    start = (node.body[0].end_lineno or 0) if has_docstring else node.body[0].lineno - 1
    return _head(part, language) + "\n".join(lines[start:]).rstrip() + "\n"


def _parsed(function: Function) -> tuple[ast.FunctionDef | ast.ClassDef, list[str]]:
    """Return the definition of a function, and its lines."""
    source = textwrap.dedent(inspect.getsource(function))
    return cast("ast.FunctionDef | ast.ClassDef", ast.parse(source).body[0]), source.split("\n")


def _methods(node: ast.ClassDef) -> str:
    """Return the methods of a class without types."""
    methods = [method for method in node.body if isinstance(method, ast.FunctionDef)]
    for method in methods:
        method.returns = None
        for argument in method.args.args:
            argument.annotation = None
    return "\n" + "\n\n".join(map(ast.unparse, methods)) + "\n"


def _untyped(function: Function) -> str:
    """Return a function of the package without types, its comments kept."""
    node, lines = _parsed(function)
    body = "\n".join(lines[node.body[0].lineno - 1 :]).rstrip()
    body = re.sub(r"^( +\w+): [\w\[\], ]+ = ", r"\1 = ", body, flags=re.MULTILINE)
    return f"def {function.__name__}({', '.join(inspect.signature(function).parameters)}):\n{body}\n"


def _imports(functions: Iterable[Function], shown: set[Function], package: str) -> str:
    """Return the lines that import what functions use of the package, without what is shown itself."""
    needed = defaultdict(set)
    for function in functions:
        node, _ = _parsed(function)
        named = {n.id for line in node.body for n in ast.walk(line) if isinstance(n, ast.Name)}
        for name in named - set(function.__code__.co_varnames):
            used = function.__globals__.get(name)
            is_known = inspect.isroutine(used) or inspect.isclass(used)
            if is_known and used.__module__.startswith(package) and used not in shown:
                needed[used.__module__].add(name)
    return "".join(f"from {module} import {', '.join(sorted(names))}\n" for module, names in sorted(needed.items()))

"""What runs in the page's worker: the cells of a notebook, and the checks of the exercises.

`run` answers with a list of outputs, each a kind and a text, in the order in which they came. The answers to the
exercises are put together to the folder that `twistwrench exercises start` writes, and checked there.
"""

from __future__ import annotations

import ast
import base64
import io
import linecache
import re
import sys
import traceback
import warnings
import zipfile
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

from tqdm import tqdm

ANSWERS = Path("/answers")
TO_BE_HAD = {"matplotlib", "mpmath", "sympy"}
"""Packages that are loaded when a cell imports them."""
IN_THE_SHELL = re.compile(r"\n+.*twistwrench exercises solution.*")
"""What the last hint says of a command, which a page has a button for."""
ANSWER = re.compile(r"^# -{98}\n# (\S+)  .*\n(?:#.*\n)*# -{98}\n([\s\S]*?)(?=^# -{98}\n|\Z)", re.MULTILINE)
"""In a student's file, the number of an exercise and what stands below its text."""
LINE = re.compile(r"(\bline |第 )(\d+)\b")
"""A line of the student's file, in both languages."""
SPACES: dict[str, dict[str, Any]] = {}
"""What the cells of a page have defined, by the page's name."""
OUTPUTS: list[tuple[str, str]] = []
"""What the cell that runs has given so far."""
SHOWN = ("_repr_html_", "html"), ("_repr_latex_", "latex"), ("_repr_svg_", "html")

Output = tuple[str, str]

if sys.platform == "emscripten":
    tqdm.monitor_interval = 0  # what watches over slow bars would be a thread


class Lines(io.TextIOBase):
    """A text stream that keeps what is written, among the other outputs."""

    def __init__(self, kind: str, outputs: list[Output]) -> None:
        self.kind, self.outputs = kind, outputs

    def write(self, text: str) -> int:
        """Append to the last output where it is of this stream."""
        if self.outputs and self.outputs[-1][0] == self.kind:
            text = self.outputs.pop()[1] + text
        self.outputs.append((self.kind, re.sub(r"[^\n]*\r(?!\n)", "", text)))  # a progress bar writes over itself
        return len(text)


def run(source: str, page: str, name: str) -> list[Output]:
    """Run a cell of a page, and return what it prints and draws, and its last value; or how it fails.

    A package that is not there, but can be, is asked for: ``[("needs", "matplotlib")]``.
    """
    space = SPACES.setdefault(page, {"__name__": "__main__", "__builtins__": __builtins__})
    outputs = OUTPUTS
    outputs.clear()
    linecache.cache[name] = (len(source), None, source.splitlines(keepends=True), name)
    with redirect_stdout(Lines("out", outputs)), redirect_stderr(Lines("err", outputs)), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "FigureCanvas")  # cannot be shown: `figures` does it
        try:
            outputs += display(execute(source, space, name))
        except (Exception, SystemExit) as error:
            if package := missing(error):
                return [("needs", package)]
            outputs.append(("error", explained(error)))
        except BaseException as error:
            outputs.append(("error", type(error).__name__))
        outputs += figures()
    return list(outputs)


def execute(source: str, space: dict[str, Any], name: str) -> Any:
    """Run a source in a name space, and return the value of its last line where that is an expression."""
    tree = ast.parse(source, name)
    last = None
    if tree.body and isinstance(tree.body[-1], ast.Expr) and not source.rstrip().endswith(";"):
        last = ast.Expression(tree.body.pop().value)  # type: ignore[attr-defined]
    exec(compile(tree, name, "exec"), space)
    return None if last is None else eval(compile(last, name, "eval"), space)


def display(value: Any) -> Iterator[Output]:
    """Yield what a notebook would show of a value."""
    if value is None:
        return
    for method, kind in SHOWN:
        if callable(shown := getattr(value, method, None)) and (text := shown()):
            yield kind, text
            return
    yield "out", f"{value!r}\n"


def figures() -> Iterator[Output]:
    """Yield the open figures as SVG, and close them."""
    if "matplotlib.pyplot" not in sys.modules:
        return
    import matplotlib.pyplot as plt

    for number in plt.get_fignums():
        text = io.StringIO()
        plt.figure(number).savefig(text, format="svg", bbox_inches="tight")
        svg = text.getvalue()
        yield "figure", svg[svg.index("<svg") :]
    plt.close("all")


def missing(error: BaseException | None) -> str:
    """Return the package behind whose absence an error is, where it can be had; else nothing."""
    while error is not None:
        if isinstance(error, ModuleNotFoundError) and error.name in TO_BE_HAD:
            return error.name
        error = error.__cause__ or error.__context__
    return ""


def explained(error: BaseException) -> str:
    """Return an error as Python prints it, without the lines of this file."""
    if isinstance(error, SyntaxError):
        return "".join(traceback.format_exception_only(error))
    trace = error.__traceback__
    while trace is not None and trace.tb_frame.f_code.co_filename == __file__:
        trace = trace.tb_next
    return "".join(traceback.format_exception(error.with_traceback(trace)))


# ---------------------------------------------------------------- exercises


def folder(answers: dict[str, str], state: str, language: str) -> Path:
    """Write the folder of a student: the skeletons with the answers in their places, and what was remembered."""
    from misstep import skeletons
    from twistwrench.exercises import start
    from twistwrench.exercises.chapter import COURSE

    ANSWERS.mkdir(exist_ok=True)
    for path in ANSWERS.iterdir():
        path.unlink()
    if state:
        (ANSWERS / ".twistwrench.json").write_text(state, encoding="utf-8")
    start(ANSWERS, language=language)
    for number, answer in answers.items():
        exercise = COURSE.exercise(number)
        path, place = ANSWERS / COURSE.file_name(exercise.section), skeletons.place(exercise, language)
        text = path.read_text(encoding="utf-8")
        path.write_text(text.replace(place, answer.rstrip() + "\n"), encoding="utf-8")
    return ANSWERS


def remembered() -> str:
    """Return the content of the hidden file, to be kept with the answers; nothing before there are any."""
    path = ANSWERS / ".twistwrench.json"
    return path.read_text(encoding="utf-8") if path.exists() else ""


def try_out(number: str, answers: dict[str, str], state: str, language: str) -> list[Output]:
    """Run an answer as a cell, with what stands above it in its file."""
    from misstep import skeletons
    from twistwrench.exercises.chapter import COURSE

    exercise = COURSE.exercise(number)
    path = folder(answers, state, language) / COURSE.file_name(exercise.section)
    SPACES[number] = {"__name__": "__main__", "__builtins__": __builtins__, "__file__": str(path)}
    execute(skeletons.opening(COURSE, exercise.section, language), SPACES[number], path.name)
    return run(answers.get(number, ""), number, number)


def check(number: str, answers: dict[str, str], state: str, language: str) -> list[Output]:
    """Check an exercise, and return the verdict as HTML."""
    from misstep.checked import checked_html
    from misstep.isolation import opened
    from misstep.notebook import checked
    from twistwrench.exercises.chapter import COURSE

    outputs: list[Output] = []
    with redirect_stdout(Lines("out", outputs)), redirect_stderr(Lines("err", outputs)):
        try:
            with opened(COURSE, folder(answers, state, language), time_limit=0) as book:
                verdict = checked(book, COURSE.exercise(number))
        except ImportError as error:
            if package := missing(error):
                return [("needs", package)]
            raise
    text = in_the_cell(checked_html(verdict, hints=False), number, answers[number])
    return [*outputs, ("right" if verdict.right else "wrong", text)]


def in_the_cell(message: str, number: str, answer: str) -> str:
    """Return a message in which the lines of the file are counted as the page shows them, from the answer's first."""
    from twistwrench.exercises.chapter import COURSE

    file = (ANSWERS / COURSE.file_name(COURSE.exercise(number).section)).read_text(encoding="utf-8")
    above, length = file.partition(answer.rstrip())[0].count("\n"), answer.rstrip().count("\n") + 1

    def here(found: re.Match[str]) -> str:
        line = int(found[2]) - above
        return f"{found[1]}{line}" if 1 <= line <= length else found[0]

    return LINE.sub(here, message)


def hint(number: str, answers: dict[str, str], state: str, language: str) -> list[Output]:
    """Return the next hint for the first function that is not right; after the last one a solution."""
    from misstep.workbook import Workbook
    from twistwrench import exercises
    from twistwrench.exercises.chapter import COURSE

    place = folder(answers, state, language)
    before = Workbook(COURSE, place).state["hints"]
    text = exercises.hint(number, place)
    if Workbook(COURSE, place).state["hints"] == before:
        text = exercises.solution(number, place)
    text = IN_THE_SHELL.sub("", text)
    return [("hint", in_the_cell(text, number, answers[number]) if number in answers else text)]


def answers(files: dict[str, str]) -> list[Output]:
    """Return the answers in the files of a student's folder, by their numbers, where they differ from the skeleton."""
    from misstep import skeletons
    from twistwrench.exercises.chapter import COURSE

    found = []
    for section in COURSE.sections:
        for number, text in ANSWER.findall(files.get(COURSE.file_name(section), "")):
            exercise = COURSE.exercise(number)
            if text.strip() not in (skeletons.place(exercise, language).strip() for language in ("en", "zh")):
                found.append((number, text.strip()))
    return found


def archive(answers: dict[str, str], state: str, language: str) -> str:
    """Return the folder of answers as a ZIP file in base64."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in sorted(folder(answers, state, language).iterdir()):
            packed.write(path, f"answers/{path.name}")
    return base64.b64encode(content.getvalue()).decode()

"""A folder with a student's answers: its content, and the progress."""

from __future__ import annotations

import json
import shlex
import stat
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from functools import cached_property, partial
from importlib.util import decode_source
from os import PathLike
from os.path import isfile  # Path's own raises where the folder may not be read
from pathlib import Path
from types import ModuleType
from typing import Any

from ..calls import shown
from ..course import Course
from ..errors import CourseError
from ..exercise import Exercise, Part
from ..files import write_text
from ..judge import Verdict, judge
from ..messages import message
from ..rules import is_reference, reference
from ..text import Language, Text, default_language
from .formulas import judge_formula, typed

__all__ = [
    "LARGEST_FILE",
    "Unread",
    "Workbook",
    "content",
    "has_started",
    "mine",
    "offered",
    "verdict_on_words",
]

LARGEST_FILE = 1_000_000
"""Bytes of a student's file; the largest of the solved ones has 20 kB."""

MOST_HINTS = 100
"""More than any exercise has."""

SHORTEST_ANSWER = 12
"""Characters of an answer in words; a sentence in Chinese needs no more."""


class Unread(Verdict):
    """The verdict on each function of a file that cannot be read."""


class Workbook:
    """A folder that `start` has filled.

    The student's files are read once: make a new one to see what has been changed since.

    Parameters
    ----------
    course : Course
    folder : str or path
    language : {"en", "zh"}, optional
        Of the messages; the one that the folder was started in unless given.
    seed : int
        Of the random cases.
    files : mapping
        From a section to the file with its answers, where that has another name than `start` has given it.
    """

    def __init__(
        self,
        course: Course,
        folder: str | PathLike[str],
        *,
        language: Language | None = None,
        seed: int = 0,
        files: Mapping[str, Path] | None = None,
    ) -> None:
        self.course, self.folder, self.seed = course, Path(folder), seed
        self.files = dict(files or {})
        self._asked = language
        self._modules: dict[str, ModuleType | Text | None] = {}
        self._verdicts: dict[str, Verdict] = {}
        self._judging: list[str] = []
        self.watch: Callable[[str], AbstractContextManager[object]] = nullcontext
        """Surrounds each call of the student's function of a name, and the reading of a file of a name."""
        self.search: bool | None = None
        """Whether small changes are looked for that explain a wrong answer, as in `judge`."""
        self.borrowed: set[str] = set()
        """Functions that `mine` took from the reference."""

    @classmethod
    def existing(cls, course: Course, folder: str | PathLike[str], *, language: Language | None = None) -> Workbook:
        """Open a folder that was started before.

        Raises
        ------
        CourseError
            If nothing was started there.
        """
        book = cls(course, folder, language=language)
        if not has_started(course, book.folder):
            raise CourseError(f"{book.folder}: no exercises here; {_where(course, book.folder)}")
        return book

    # ---------------------------------------------------------------- what is remembered

    @cached_property
    def state(self) -> dict[str, Any]:
        """The content of the hidden file, as far as it can be read."""
        try:
            kept = json.loads(content(self.folder / self.course.state_file))
        except (OSError, ValueError, RecursionError):
            kept = {}
        kept = kept if isinstance(kept, dict) else {}
        hints, *lists = (kept.get(name) for name in ("hints", "compared", "solutions"))
        shown = hints.items() if isinstance(hints, dict) else ()
        counts = {number: n for number, n in shown if isinstance(n, int) and 0 <= n < MOST_HINTS}
        compared, solutions = ([x for x in y if isinstance(x, str)] if isinstance(y, list) else [] for y in lists)
        return {**kept, "hints": counts, "compared": compared, "solutions": solutions}

    def remember(self, **news: Any) -> None:
        """Write the hidden file."""
        self.state.update(news)
        text = json.dumps(self.state, indent=1, ensure_ascii=False)
        write_text(self.folder / self.course.state_file, text + "\n")

    @property
    def language(self) -> Language:
        """The language of the messages."""
        kept = self.state.get("language", default_language())
        return self._asked or ("zh" if kept == "zh" else "en")

    # ---------------------------------------------------------------- what the student wrote

    def path(self, section: str) -> Path:
        """Return the student's file of a section."""
        return self.files.get(section, self.folder / self.course.file_name(section))

    def module(self, section: str) -> ModuleType | Text:
        """Return the student's file of a section as a module, or why it cannot be read."""
        if section not in self._modules:
            self._modules[section] = None  # while it is being read
            self._modules[section] = self._read(self.path(section))
        return self._modules[section] or message(
            "no file", file=self.course.file_name(section), command=self.course.command
        )

    def _no_file(self, name: str) -> Text:
        return message("no file", file=name, command=self.course.command)

    def _read(self, path: Path) -> ModuleType | Text:
        if not path.exists():
            return self._no_file(path.name)
        module = ModuleType(path.stem)
        module.__dict__.update(__file__=str(path), __workbook__=self)
        try:
            source = decode_source(content(path))  # as Python reads it: with a BOM, or a line that names a coding
        except (OSError, SyntaxError, UnicodeError) as error:
            return message("file" if isinstance(error, OSError) else "encoding", file=path.name, error=error)
        kept = {name: (x, dict(vars(x))) for name, x in self.course.shared.items()}
        try:
            with _importable(path.parent), self.watch(path.name):
                sys.modules.setdefault(path.stem, module)  # in which a dataclass looks for its names
                # compiled anew each time: a cached file can be older than the last change
                exec(compile(source, path, "exec", dont_inherit=True), module.__dict__)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # whatever the student's file raises becomes a message
            said = shown(error)
            if (line := _line(error, path)) is not None:
                return message("file at line", file=path.name, line=line, error=said)
            return message("file", file=path.name, error=said)
        changed = [*_restored(kept)]
        return message("patched", file=path.name, name=changed[0]) if changed else module

    def words(self, exercise: Exercise) -> str | None:
        """Return the student's answer in words, None if it is not written yet."""
        module = self.module(exercise.section)
        text = None if isinstance(module, Text) else vars(module).get(exercise.answer_name)
        return str.strip(text) or None if isinstance(text, str) else None

    # ---------------------------------------------------------------- the progress

    def verdict(self, exercise: Exercise, part: Part) -> Verdict:
        """Judge one function; each is judged once."""
        if part.name not in self._verdicts:
            self._judging.append(part.name)
            try:
                self._verdicts[part.name] = self._judge(exercise, part)
            finally:
                self._judging.pop()
        return self._verdicts[part.name]

    def _judge(self, exercise: Exercise, part: Part) -> Verdict:
        module, file = self.module(exercise.section), self.path(exercise.section).name
        head = message("head", id=exercise.id, name=part.name)
        if isinstance(module, Text):
            missing = not self.path(exercise.section).exists()
            return Verdict("to do", (head, module)) if missing else Unread("wrong", (head, module))
        function = vars(module).get(part.name)
        if isinstance(function, str):
            return judge_formula(exercise, part, function, seed=self.seed)
        if not callable(function):
            phrase = "missing" if function is None else "not a function"
            return Verdict("wrong", (head, message(phrase, name=part.name, file=file)))
        if is_reference(part, function):
            return Verdict("wrong", (head, reference(part)))
        watch = partial(self.watch, part.name)
        return judge(exercise, part, function, seed=self.seed, watch=watch, search=self.search)

    def verdict_in_words(self, exercise: Exercise) -> Verdict | None:
        """Judge whether the answer in words is written; None where the exercise needs no words."""
        if exercise.answer is None:
            return None
        words = self.words(exercise)
        if words is not None:
            return verdict_on_words(exercise, words)
        are_right = all(self.verdict(exercise, part).state == "done" for part in exercise.parts)
        return Verdict("to do", (message("words missing", name=exercise.answer_name),) if are_right else ())

    def verdicts(self, exercise: Exercise) -> dict[str, Verdict]:
        """Return the verdicts on all parts of an exercise, by the name in the file."""
        found = {part.name: self.verdict(exercise, part) for part in exercise.parts}
        words = self.verdict_in_words(exercise)
        return found if words is None else {**found, exercise.answer_name: words}

    def best(self, name: str) -> Callable[..., Any]:
        """Return the student's function where it is right, the reference where it is not yet."""
        if self._judging[-1:] == [name]:
            raise RuntimeError(f"mine({name!r}) is the function that you are to write here")
        exercise, part = self.course.find_part(name)
        module = self.module(exercise.section)
        if name not in self._judging and not isinstance(module, Text) and self.verdict(exercise, part).state == "done":
            found = vars(module)[name]
            function: Callable[..., Any] = typed(part, found) if isinstance(found, str) else found
            return function
        self.borrowed.add(name)
        return part.solution


def verdict_on_words(exercise: Exercise, words: str) -> Verdict:
    """Judge an answer in words: only whether there is enough of it."""
    if len(words.strip()) < SHORTEST_ANSWER:
        return Verdict("wrong", (message("words short", name=exercise.answer_name),))
    return Verdict("done")


def content(path: Path) -> bytes:
    """Return what is in a file.

    Raises
    ------
    OSError
        If it is not a regular file, as a pipe that nobody writes to, or has more than 1 MB.
    """
    about = path.stat()
    if not stat.S_ISREG(about.st_mode):
        raise OSError("it is not a regular file")
    if about.st_size > LARGEST_FILE:
        raise OSError(f"it has {about.st_size / 1e6:.1f} MB, and may have {LARGEST_FILE / 1e6:.0f} MB")
    with path.open("rb") as file:
        return file.read(LARGEST_FILE)


def _line(error: BaseException, path: Path) -> int | None:
    """Return the line of a file at which an error is, or was raised."""
    if isinstance(error, SyntaxError):
        return error.lineno
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(path)]
    return lines[-1] if lines else None


def _restored(kept: dict[str, tuple[ModuleType, dict[str, Any]]]) -> Iterator[str]:
    """Put back what a file has changed in modules, and yield its names."""
    for name, (module, before) in kept.items():
        for key, value in before.items():
            if vars(module).get(key) is not value:
                setattr(module, key, value)
                yield f"{name}.{key}"


@contextmanager
def _importable(folder: Path) -> Iterator[None]:
    """Let files of the folder import each other, and forget these modules afterwards, for the next folder."""
    before = set(sys.modules)
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for name in set(sys.modules) - before:
            file = getattr(sys.modules[name], "__file__", None)
            if file and Path(file).parent == folder:
                del sys.modules[name]


def mine(course: Course, name: str, asker: Mapping[str, Any]) -> Callable[..., Any]:
    """Return a function of an earlier exercise: the student's once it is right, the reference until then.

    The folder is that of the file with the names of `asker`.
    """
    return offered(name, asker.get("__workbook__") or Workbook(course, Path(asker.get("__file__", "")).parent))


def offered(name: str, book: Workbook) -> Callable[..., Any]:
    """Return what `mine` does, for a folder."""
    _, part = book.course.find_part(name)

    def function(*arguments: Any, **named: Any) -> Any:
        return book.best(name)(*arguments, **named)

    function.__name__, function.__doc__ = name, part.doc.en
    function.mine, function.folder = name, book.folder  # type: ignore[attr-defined]
    function.course = book.course.module  # type: ignore[attr-defined]
    return function


def has_started(course: Course, folder: Path) -> bool:
    """Whether a folder holds a student's files."""
    return any(isfile(folder / file) for file in course.files)


def _where(course: Course, folder: Path) -> str:
    """Return where the exercises may be, for a student who is in another folder."""
    near = [folder / "..", *(sorted(folder.iterdir()) if folder.is_dir() else ())]
    for other in near:
        if has_started(course, other):
            return f"there are some in {other}: {course.command} status {shlex.quote(str(other))}"
    named, new = f"{course.command} status DIR", f"{course.command} start DIR"
    return f"name the folder that they are in: {named} (to make one: {new})"

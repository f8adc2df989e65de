"""A folder with a student's answers: its content, and the progress."""

from __future__ import annotations

import inspect
import json
import shlex
import stat
import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from functools import cached_property, partial
from importlib.util import decode_source
from os import PathLike
from os.path import isfile  # Path's own raises where the folder may not be read
from pathlib import Path
from types import ModuleType
from typing import Any
from zlib import crc32

from .calls import shown
from .checked import WORDS, Checked
from .compare import arrays_of, plain, unwarned
from .course import Course
from .errors import CourseError
from .exercise import Exercise, Part
from .files import write_text
from .judge import judge
from .rules import is_reference, reference
from .text import Language, Text, default_language
from .verdict import LEVELS, Unread, Verdict, headed

__all__ = ["MAX_FILE_BYTES", "Workbook", "checksum", "content", "mine", "offered", "verdict_on_words"]

MAX_FILE_BYTES = 1_000_000  # of a student's file; the largest of the solved ones has 20 kB
MAX_HINTS = 100  # that are remembered of a function
MIN_CHARACTERS = 12  # of an answer in words; a sentence in Chinese needs no more

NO_FILE = Text("{file} is not there: `{command} start` brings it back.", "缺少 {file}：{command} start 可重新生成。")
ENCODING = Text(
    "{file} is not written in UTF-8: save it as UTF-8. ({error})", "{file} 请另存为 UTF-8 编码。（{error}）"
)
UNREADABLE = Text("{file} cannot be read: {error}", "无法读取 {file}：{error}")
UNREADABLE_LINE = Text("{file}, line {line} cannot be read: {error}", "{file} 第 {line} 行无法读取：{error}")
PATCHED = Text("{file} changes `{name}`: give what you write another name.", "{file} 改动了 `{name}`：请换一个名称。")
NO_FUNCTION = Text("There is no function {name} in {file} any more.", "{file} 中已没有函数 {name}。")
NO_WORDS = Text("Now explain it in words: fill in {name}.", "请再用文字作答：填写 {name}。")
SHORT = Text("{name} is very short: a sentence or two, please.", "{name} 太短：请写一两句话。")


class Workbook:
    """A folder that `start` has filled, or that is yet to be. Its files are read once: make a new one for changes.

    The language is that of the messages, the one that it was started in unless given; `files` are by section those that
    have another name than `start` has given them.
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

    def must_be_started(self) -> None:
        """Raise a CourseError unless the folder was started; its message says where one may be that was."""
        if self.is_started:
            return
        named, new = f"{self.course.command} status DIR", f"{self.course.command} start DIR"
        where = f"name the folder that they are in: {named} (to make one: {new})"
        near = [self.folder / "..", *(sorted(self.folder.iterdir()) if self.folder.is_dir() else ())]
        if other := next((x for x in near if Workbook(self.course, x).is_started), None):
            where = f"there are some in {other}: {self.course.command} status {shlex.quote(str(other))}"
        raise CourseError(f"{self.folder}: no exercises here; {where}")

    @property
    def is_started(self) -> bool:
        """Whether the folder holds a student's files."""
        return any(isfile(self.folder / file) for file in self.course.files)

    def close(self) -> None:
        """End what reads and judges the files, where that is another process."""

    # ---------------------------------------------------------------- what is remembered

    @cached_property
    def state(self) -> dict[str, Any]:
        """The content of the hidden file, as far as it can be read."""
        try:
            kept = json.loads(content(self.folder / self.course.state_file))
        except (OSError, ValueError, RecursionError):
            kept = {}
        kept = kept if isinstance(kept, dict) else {}
        lists = {name: kept[name] if isinstance(kept.get(name), list) else [] for name in ("compared", "solutions")}
        hints = kept["hints"] if isinstance(kept.get("hints"), dict) else {}
        shown = {name: [x for x in y if isinstance(x, str)][:MAX_HINTS] for name, y in hints.items() if type(y) is list}
        return {**kept, "hints": shown} | {name: [x for x in y if isinstance(x, str)] for name, y in lists.items()}

    def remember(self, **news: Any) -> None:
        """Write the hidden file."""
        self.state.update(news)
        text = json.dumps(self.state, indent=1, ensure_ascii=False)
        write_text(self.folder / self.course.state_file, text + "\n")

    def remember_shown(self, section: str, **news: Any) -> bool:
        """Write down what was shown, in a folder with the exercise that may be written to; return whether it is."""
        if not isfile(self.path(section)):
            return False
        with suppress(OSError):
            self.remember(**news)
            return True
        return False

    def remember_hints(self, exercise: Exercise, part: Part, texts: Iterable[Text]) -> bool:
        """Write down which hints of a function were shown, each by a checksum; return whether that was possible."""
        hints = self.state["hints"]
        before = hints.get(part.name, [])
        shown = [*dict.fromkeys((*before, *map(checksum, texts)))]
        return shown == before or self.remember_shown(exercise.section, hints={**hints, part.name: shown})

    def hints(self, exercise: Exercise) -> dict[str, int]:
        """Return how many hints were shown of each function of an exercise."""
        return {part.name: len(self.state["hints"].get(part.name, ())) for part in exercise.parts}

    @property
    def max_level(self) -> int:
        """The last level of a message: the cure, unless the folder was started without."""
        return LEVELS[-2 if self.state.get("cure") is False else -1]

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
        return self._modules[section] or NO_FILE.fill(file=self.path(section).name, command=self.course.command)

    def _read(self, path: Path) -> ModuleType | Text:
        if not path.exists():
            return NO_FILE.fill(file=path.name, command=self.course.command)
        module = ModuleType(path.stem)
        module.__dict__.update(__file__=str(path), __workbook__=self)
        try:
            source = decode_source(content(path))  # as Python reads it: with a BOM, or a line that names a coding
        except (OSError, SyntaxError, UnicodeError) as error:
            return (UNREADABLE if isinstance(error, OSError) else ENCODING).fill(file=path.name, error=error)
        kept = {name: (x, dict(vars(x))) for name, x in self.course.shared.items()}
        try:
            with _importable(path.parent), self.watch(path.name):
                sys.modules.setdefault(path.stem, module)  # in which a dataclass looks for its names
                # compiled anew each time: a cached file can be older than the last change
                exec(compile(source, path, "exec", dont_inherit=True), module.__dict__)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # whatever the student's file raises becomes a message
            lines = [x.lineno for x in traceback.extract_tb(error.__traceback__) if x.filename == str(path)]
            line = error.lineno if isinstance(error, SyntaxError) else (lines or [None])[-1]
            return (UNREADABLE if line is None else UNREADABLE_LINE).fill(file=path.name, line=line, error=shown(error))
        changed = [*_restored(kept)]
        return PATCHED.fill(file=path.name, name=changed[0]) if changed else module

    def words(self, exercise: Exercise) -> str | None:
        """Return the student's answer in words, None if it is not written yet."""
        module = self.module(exercise.section)
        text = None if isinstance(module, Text) else vars(module).get(exercise.answer_name)
        return str.strip(text) or None if isinstance(text, str) else None

    # ---------------------------------------------------------------- the verdicts

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
        module, path = self.module(exercise.section), self.path(exercise.section)
        if isinstance(module, Text):
            verdict = headed(exercise, part, module)
            return Unread("wrong", verdict.lines) if path.exists() else Verdict("to do", verdict.lines)
        function = vars(module).get(part.name)
        if not callable(function):
            return headed(exercise, part, NO_FUNCTION.fill(name=part.name, file=path.name))
        return self.judge_function(exercise, part, function)

    def judge_function(self, exercise: Exercise, part: Part, function: Callable[..., Any]) -> Verdict:
        """Judge a function as the answer to a part."""
        if is_reference(part, function):
            return headed(exercise, part, reference(part))
        watch = partial(self.watch, part.name)
        return judge(exercise, part, function, seed=self.seed, watch=watch, search=self.search)

    def verdict_in_words(self, exercise: Exercise) -> Verdict:
        """Judge whether the answer in words is written."""
        words = self.words(exercise)
        if words is not None:
            return verdict_on_words(exercise, words)
        are_right = all(self.verdict(exercise, part).state == "done" for part in exercise.parts)
        return Verdict("to do", (NO_WORDS.fill(name=exercise.answer_name),) if are_right else ())

    def checked(self, exercise: Exercise) -> Checked:
        """Judge all functions of an exercise, and its answer in words."""
        verdicts = {part.name: self.verdict(exercise, part) for part in exercise.parts}
        if exercise.answer is not None:
            verdicts[WORDS] = self.verdict_in_words(exercise)
        words = None if exercise.answer is None else self.words(exercise)
        return Checked(
            exercise,
            verdicts,
            words,
            self.language,
            max_level=self.max_level,
            hints=self.hints(exercise),
            solution=exercise.id in self.state["solutions"],
            are_functions_right=all(verdicts[part.name].state == "done" for part in exercise.parts),
        )

    def best(self, name: str) -> Callable[..., Any]:
        """Return the student's function where it is right, the reference where it is not yet."""
        if self._judging[-1:] == [name]:
            raise RuntimeError(f"mine({name!r}) is the function that you are to write here")
        exercise, part = self.course.find_part(name)
        module = self.module(exercise.section)
        if name not in self._judging and not isinstance(module, Text) and self.verdict(exercise, part).state == "done":
            function: Callable[..., Any] = vars(module)[name]
            return function
        self.borrowed.add(name)
        return part.solution


def checksum(text: Text) -> str:
    """Return what stands for a text in the hidden file."""
    return f"{crc32(text.en.encode()):08x}"


def verdict_on_words(exercise: Exercise, words: str) -> Verdict:
    """Judge an answer in words: only whether there is enough of it."""
    if len(words.strip()) >= MIN_CHARACTERS:
        return Verdict("done")
    return Verdict("wrong", (SHORT.fill(name=exercise.answer_name),))


def content(path: Path) -> bytes:
    """Return what is in a file; an OSError where it is not a regular one, as a pipe is, or has more than 1 MB."""
    about = path.stat()
    if not stat.S_ISREG(about.st_mode):
        raise OSError("it is not a regular file")
    if about.st_size > MAX_FILE_BYTES:
        raise OSError(f"it has {about.st_size / 1e6:.1f} MB, and may have {MAX_FILE_BYTES / 1e6:.0f} MB")
    with path.open("rb") as file:
        return file.read(MAX_FILE_BYTES)


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
    """Return what `offered` does, for the folder of the file with the names of `asker`."""
    return offered(name, asker.get("__workbook__") or Workbook(course, Path(asker.get("__file__", "")).parent))


def offered(name: str, book: Workbook) -> Callable[..., Any]:
    """Return a function of an earlier exercise: the student's once it is right, the reference until then."""
    _, part = book.course.find_part(name)

    def function(*arguments: Any, **named: Any) -> Any:
        best = book.best(name)
        if best is part.solution:
            with unwarned():  # a warning would show a line of the solution
                return best(*arguments, **named)
        found = best(*arguments, **named)
        if part.call or inspect.isclass(best):
            return found
        return arrays_of(plain(found), part.returns)  # as it was judged

    function.__name__, function.__doc__ = name, part.doc.en
    vars(function)["mine"] = name
    return function

"""Judge one function of the student: to do, done or wrong, with a message."""

from __future__ import annotations

import copy
import inspect
import io
import linecache
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext, redirect_stderr, redirect_stdout, suppress
from dataclasses import is_dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from .calls import MAX_CPU_S, TooLong, call_or_none, copied, limited, shown
from .cases import Arguments, cases, every_case, further_cases, special_cases
from .compare import agree, copied_results, is_one_array, plain, to_do, unchanged
from .diagnose import diagnose
from .exercise import Exercise, Part
from .rules import broken_rules, is_ours
from .text import Text, say
from .verdict import Case, Verdict, failing_case, headed

__all__ = ["at_line", "judge"]

Function = Callable[..., Any]
Watch = Callable[[], AbstractContextManager[object]]

MAX_FRESH = 3  # wrong cases that are tried in a new copy of the file

NEEDS = Text(
    "It needs the package {name}, which is not installed here; `pip install pin` brings Pinocchio.",
    "需要 {name}，此处没有安装；`pip install pin` 可安装 Pinocchio。",
)
CHANGED = Text(
    "It changes its argument `{name}`. Work on a copy: the caller still needs it.",
    "它修改了参数 `{name}`。请在副本上运算，调用者还要用它。",
)
CHANGED_TERM = Text(
    "A sum or a difference changes one of its terms. Make a new array: `a + b` does, `a += b` changes that of `a`.",
    "求和或求差时改变了其中一个操作数。请新建数组：`a + b` 会新建，`a += b` 改变的是 `a` 的数组。",
)
KEPT = Text(
    "Called again with the same arguments, it returns something else: it keeps something from one call to the next."
    " Make it anew in each call; a default like `out=[]` is made only once.",
    "用相同的参数再调用一次，返回的却不一样：它把某些内容从一次调用留到了下一次。"
    "请在每次调用时重新建立；`out=[]` 这样的默认值只生成一次。",
)
KEPT_BY_MODULE = Text(
    "Called for the first time, it is right with these arguments, too: it keeps something from one call to the next"
    " (a global variable, a default argument, a cache). Make it anew in each call.",
    "第一次调用时，用这些参数结果也正确：它把某些内容从一次调用留到了下一次（全局变量、参数的默认值或缓存）。"
    "请在每次调用时重新建立。",
)
RETURNED_BEFORE = Text(
    "It returns the same array as in an earlier call, with other arguments: it keeps something from one call to the"
    " next. Make what it returns anew in each call.",
    "参数不同，它返回的却是以前某次调用的同一个数组：它把某些内容从一次调用留到了下一次。返回的量每次都要新建。",
)
ONE_ARRAY = Text(
    "The numbers are right, but two of the things that it returns are one and the same array: compute each.",
    "数值正确，但它返回的量中有两个是同一个数组：请分别计算。",
)
ONE_WAY = Text(
    "The numbers are right, but the two results are the same to the last bit in all cases: compute each in its way.",
    "数值正确，但两个结果在所有情形中逐位相同：请分别用各自的方法计算。",
)
READ_ON = Text("Read {section}; ask for a hint: {command} hint {id}", "参阅{section}；需要提示：{command} hint {id}")


def judge(
    exercise: Exercise,
    part: Part,
    function: Function,
    *,
    seed: int = 0,
    watch: Watch = nullcontext,
    search: bool | None = None,
) -> Verdict:
    """Compare a function with the reference on random cases.

    Parameters
    ----------
    exercise : Exercise
    part : Part
        Of the exercise.
    function : callable
        The student's.
    seed : int
        Of the random cases. The same seed gives the same verdict.
    watch : callable
        Gives a context for each call of the function, as to stop it after some time.
    search : bool, optional
        Look for the small change that explains a wrong answer. Another package may end the process at such a change:
        unless given, none is looked for where the exercise needs one.

    Returns
    -------
    Verdict
    """
    if exercise.needs and find_spec(exercise.needs) is None:
        return Verdict("to do", (NEEDS.fill(name=exercise.needs),))
    return _Trial(exercise, part, function, seed, watch, not exercise.needs if search is None else search).verdict()


class _Stop(Exception):
    """The student's function did not give an answer: the lines that say so, and whether an edit may help."""

    def __init__(self, lines: list[Text], is_curable: bool) -> None:
        super().__init__()
        self.lines, self.is_curable = lines, is_curable


class _Trial:
    """A function that is tried case by case: of each the arguments, its answer, the right one, whether they agree."""

    def __init__(
        self, exercise: Exercise, part: Part, function: Function, seed: int, watch: Watch, search: bool
    ) -> None:
        self.exercise, self.course, self.part, self.function = exercise, exercise.course, part, function
        self.seed, self.watch, self.search = seed, watch, search
        self.tried: list[Arguments] = []
        self.answers: list[Any] = []
        self.expected: list[Any] = []
        self.right: list[bool] = []
        self.changed: list[Text] = []
        self.changed_in = 0  # the first case in which an argument is changed

    def verdict(self) -> Verdict:
        """Try the function in all cases, and report what is wrong."""
        broken = broken_rules(self.course.rules, self.part, self.function)  # before anything is run
        for arguments in self._cases():
            try:
                ended = self._try(arguments)
            except NotImplementedError:
                return Verdict("to do")
            except _Stop as stop:
                if self.changed or not all(self.right):
                    break  # what is wrong without an error comes first
                return self._stopped(stop, arguments)
            if ended is not None:
                return ended
        kept = self._kept()
        if self.changed:
            self.changed += self._changing_line(self.tried[self.changed_in])
        if kept is not None or not all(self.right):
            return self._wrong(kept)
        if self.changed:
            return headed(self.exercise, self.part, *self.changed, case=self._case(self.changed_in))
        remarks = broken or [*self._made_one()][:1]
        return headed(self.exercise, self.part, *remarks) if remarks else Verdict("done")

    def _cases(self) -> Iterator[Arguments]:
        """Yield those that are drawn first, further ones, and special ones unless one of these was wrong."""
        yield from cases(self.part, self.seed)
        yield from further_cases(self.course, self.part, self.seed)
        if all(self.right):
            yield from special_cases(self.course, self.part, self.seed)

    def _try(self, arguments: Arguments) -> Verdict | None:
        """Compare the answer in one case; return a verdict where no further one is needed."""
        frozen = {id(x): x for x in arguments if is_dataclass(x) and x.__dataclass_params__.frozen}  # type: ignore[attr-defined]
        kept = copy.deepcopy(arguments, frozen)  # an answer may change a model that it is given
        with self.watch():
            answer, changed = self._run(arguments)
        if to_do(answer):
            return Verdict("to do")
        if changed and not self.changed:
            self.changed, self.changed_in = [changed], len(self.tried)
        right = self.part.value(self.part.solution, kept)
        self.tried.append(arguments)
        self.answers.append(answer)
        self.expected.append(right)
        self.right.append(agree(self.part, answer, right, arguments))
        if self.right[-1] or agree(self.part, self.part.value(self.part.solution, arguments), right, arguments):
            return None
        return headed(self.exercise, self.part, CHANGED.fill(name=self.part.names[0]), case=self._case(-1))

    def _run(self, arguments: Arguments) -> tuple[Any, Text | None]:
        """Call the function on copies of the arguments; report whether it changes one, and where it stopped."""
        given = copied(arguments)
        try:
            answer = plain(self.part.value(self.function, given))
        except (KeyboardInterrupt, NotImplementedError):
            raise
        except BaseException as error:  # whatever the student's code raises becomes a message
            raise _Stop(_place_of(error), not isinstance(error, MemoryError | SystemExit)) from None
        for name, before, after in zip(self.part.names, arguments, given):
            if not unchanged(before, after):
                return answer, CHANGED_TERM if inspect.isclass(self.part.solution) else CHANGED.fill(name=name)
        return answer, None

    def _stopped(self, stop: _Stop, arguments: Arguments) -> Verdict:
        """Report an error, and the change after which there is none and the answer is right."""
        self.tried.append(arguments)
        lines, how = stop.lines, "located"
        if self.search and stop.is_curable:
            every = every_case(self.course, self.part, self.seed)
            found = diagnose(self.part, self.function, [None] * len(every), every, self.course.field)
            if found.how == "line":
                lines, how = [*lines, *found.lines], "line"
        return headed(self.exercise, self.part, *lines, case=self._case(-1), how=how)

    def _wrong(self, kept: Text | None) -> Verdict:
        """Return what is wrong, with the first case that shows it."""
        k = 0 if all(self.right) else self.right.index(False)
        if kept is not None:
            return headed(self.exercise, self.part, *self.changed, kept, case=self._case(k))
        found = diagnose(
            self.part,
            self.function,
            self.answers,
            self.tried,
            self.course.field,
            special_cases=lambda: special_cases(self.course, self.part, self.seed),
            search_code=self.search,
        )
        if self.changed and inspect.isclass(self.part.solution) and not found.slips:  # what is wrong comes of it
            return headed(self.exercise, self.part, *self.changed, case=self._case(k))
        wrong, n = self.right.count(False), len(self.right)
        count = say("Wrong in {wrong} of {n} cases.", "{n} 组数据中错了 {wrong} 组。", wrong=wrong, n=n)
        lines = (*self.changed, *found.lines, *([count] if self.tried[k] else []), self._where(found.slips))
        case = self._case(k, (self.expected[k], self.answers[k]))
        return headed(self.exercise, self.part, *lines, slips=found.slips, case=case, how=found.how)

    def _case(self, k: int, answers: Sequence[Any] = ()) -> Case:
        k %= len(self.tried)
        return failing_case(self.exercise, self.part, k, self.seed, self.tried[k], answers)

    def _where(self, slips: Sequence[str]) -> Text:
        """Return where to read on."""
        section = self.course.field.slips[slips[0]].section if slips else self.exercise.section
        name = Text("the project at the end of the chapter", "章末的累积项目")
        if section[:1].isdigit():
            name = Text(f"§{section}", f" §{section}")
        return READ_ON.fill(section=name, id=self.exercise.id, command=self.course.command)

    # ---------------------------------------------------------------- what it leaves behind

    def _kept(self) -> Text | None:
        """Report that it keeps something from one call to the next, if it does."""
        k, again = (0 if all(self.right) else self.right.index(False)), None
        with suppress(NotImplementedError, _Stop), self.watch():
            again = self._run(self.tried[k])[0]
        if not agree(self.part, again, self.answers[k], self.tried[k]) and not _repeated(again, self.answers[k]):
            return KEPT
        wrong = [x for x, is_right in enumerate(self.right) if not is_right]
        if wrong and all(map(self._is_right_anew, wrong[:MAX_FRESH])):
            return KEPT_BY_MODULE
        objects = [x for x, is_right in zip(self.answers, self.right) if is_right and isinstance(x, np.ndarray | list)]
        if wrong and any(self.answers[k] is x for x in objects):
            return RETURNED_BEFORE
        one_part = [self.part] * len(self.tried)
        changed = not wrong and not all(map(agree, one_part, self.answers, self.expected, self.tried))
        return RETURNED_BEFORE if changed else None

    def _is_right_anew(self, k: int) -> bool:
        """Whether a case is right where the student's file is read again."""
        names = getattr(inspect.unwrap(self.function), "__globals__", {})
        file = str(names.get("__file__", ""))
        source = "".join(linecache.getlines(file))
        if not source or inspect.isclass(self.function) or names.get(self.part.name) is not self.function:
            return False
        fresh = {name: x for name, x in names.items() if name.startswith("__")}
        try:
            with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
                exec(compile(source, file, "exec", dont_inherit=True), fresh)
            answer = call_or_none(self.part, fresh[self.part.name], self.tried[k])
        except (Exception, SystemExit):  # it was read before: what is missing now is not the student's
            return False
        return agree(self.part, answer, self.expected[k], self.tried[k])

    def _made_one(self) -> Iterator[Text]:
        """Yield what is wrong where two of the things returned are one."""
        if is_one_array(self.answers[0]):
            yield ONE_ARRAY
        if copied_results(self.answers, self.expected, self.expected):
            yield ONE_WAY

    def _changing_line(self, arguments: Arguments) -> list[Text]:
        """Return where an argument is changed first, and what stands there; nothing where that is not seen."""
        given, found = copied(arguments), list[tuple[str, int]]()
        last: tuple[str, int] | None = None  # the file and the line that run until the next event

        def note(frame: Any, event: str, _: Any) -> Any:
            nonlocal last
            if found or is_ours(frame.f_code.co_filename):
                return None
            if last is not None and not all(map(unchanged, arguments, given)):
                found.append(last)
            back = frame.f_back if event == "return" else frame
            last = None if back is None else (back.f_code.co_filename, back.f_lineno)
            return note

        with suppress(Exception, TooLong), _traced(note), limited(MAX_CPU_S):  # it ran before, untraced
            self.part.value(self.function, given)
        file, line = found[0] if found else ("", 0)
        text = "" if not found or is_ours(file) else linecache.getline(file, line).strip()
        return at_line(file, line, text) if text else []


@contextmanager
def _traced(note: Function) -> Iterator[None]:
    """Call a function at each line that runs, as Python traces it."""
    before = sys.gettrace()
    sys.settrace(note)
    try:
        yield
    finally:
        sys.settrace(before)


def _repeated(first: Any, second: Any) -> bool:
    """Whether two answers are the same, as far as they are numbers."""
    if isinstance(first, tuple | list) and isinstance(second, tuple | list):
        return len(first) == len(second) and all(map(_repeated, first, second))
    try:
        return np.shape(first) == np.shape(second) and np.allclose(first, second, equal_nan=True)
    except (OverflowError, TypeError, ValueError):
        return True


def _place_of(error: BaseException) -> list[Text]:
    """Report what was raised, and at which line of the student's file."""
    lines = [say("It stopped with {error}", "运行出错：{error}", error=shown(error))]
    own = [f for f in traceback.extract_tb(error.__traceback__) if not is_ours(f.filename)]
    frame = next((f for f in reversed(own) if f.line), own[-1] if own else None)  # generated code shows no line
    return lines if frame is None else [*lines, *at_line(frame.filename, frame.lineno, frame.line)]


def at_line(file: str, line: object, text: str | None) -> list[Text]:
    """Return where something happened in a student's file, or in a cell of a notebook, and what stands there."""
    name = Text(*(Path(file).name,) * 2)
    if "ipykernel" in file or file.startswith("<ipython"):
        name = Text("your cell", "你的单元格")
    place = say("in {file}, line {line}:", "位于 {file} 第 {line} 行：", file=name, line=line)
    return [place, Text(f"    {text}", f"    {text}")]

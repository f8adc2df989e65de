"""Judge one function of the student: to do, done or wrong, with a message."""

from __future__ import annotations

import copy
import inspect
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import is_dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from .calls import TooLong, copied, shown, value_of_reference
from .cases import cases, every_case, further_cases, special_cases
from .compare import agree, copied_results, is_one_array, plain, to_do, unchanged
from .diagnose import diagnose
from .exercise import Exercise, Part
from .rules import broken_rules, is_ours
from .search import Arguments
from .text import Text, say
from .verdict import Case, Verdict, failing_case, headed

__all__ = ["ASK", "ENDLESS", "at_line", "judge", "more"]

Function = Callable[..., Any]
Watch = Callable[[], AbstractContextManager[object]]

ENDLESS = Text("It did not finish in {s:g} s: a loop that never ends?", "{s:g} 秒内没有结束：是不是死循环？")
NEEDS = Text("It needs the package {name}, which is not installed here.", "需要 {name}，此处没有安装。")
CHANGED = Text("It changes its argument `{name}`: work on a copy.", "它修改了参数 `{name}`：请在副本上运算。")
COPY = Text(
    "Begin with `{name} = np.array({name}, dtype=float)`: a copy, which also holds what stands after the point.",
    "函数开头先写 `{name} = np.array({name}, dtype=float)`：这是副本，也存得下小数。",
)
COPY_OF_LIST = Text(
    "Begin with `{name} = copy.deepcopy({name})`: a copy of the list and of what is in it.",
    "函数开头先写 `{name} = copy.deepcopy({name})`：列表及其元素都是副本。",
)
CHANGED_TERM = Text(
    "A sum or a difference changes one of its terms. Make a new array: `a + b` does, `a += b` changes that of `a`.",
    "求和或求差时改变了其中一个操作数。请新建数组：`a + b` 会新建，`a += b` 改变的是 `a` 的数组。",
)
KEPT = Text(
    "It keeps something from one call to the next, as a global array, a cache or a default `out=[]` does:"
    " make what changes anew in each call.",
    "它把某些内容从一次调用留到了下一次（全局数组、缓存或 `out=[]` 这样的默认值）：会变的量请在每次调用时新建。",
)
ONE_ARRAY = Text("Two of the things that it returns are one and the same array.", "它返回的量中有两个是同一个数组。")
ONE_WAY = Text("The two results are the same to the last bit in all cases.", "两个结果在所有情形中逐位相同。")
COMPUTE_EACH = Text("The numbers are right, but compute each in its own way: {why}", "数值正确，但请分别计算：{why}")
READ, ASK = Text("Read {section}.", "参阅{section}。"), Text("For more: {call}", "更多提示：{call}")


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


class _Raised(Exception):
    """The student's function raised an error."""

    def __init__(self, error: BaseException) -> None:
        super().__init__()
        self.error = error

    def lines(self) -> list[Text]:
        """Report what was raised, and at which line of the student's file."""
        lines = [say("It stopped with {error}", "运行出错：{error}", error=shown(self.error))]
        if isinstance(self.error, TooLong):
            lines = [ENDLESS.fill(s=self.error.seconds)]
        own = [f for f in traceback.extract_tb(self.error.__traceback__) if not is_ours(f.filename)]
        frame = next((f for f in reversed(own) if f.line), own[-1] if own else None)  # generated code shows no line
        return lines if frame is None else [*lines, *at_line(frame.filename, frame.lineno, frame.line)]


class _Trial:
    """A function that is tried case by case: of each the arguments, its answer, the right one, whether they agree."""

    def __init__(
        self, exercise: Exercise, part: Part, function: Function, seed: int, watch: Watch, search: bool
    ) -> None:
        self.exercise, self.course, self.part, self.function = exercise, exercise.course, part, function
        self.seed, self.watch, self.search = seed, watch, search
        self.tried: list[Arguments] = []
        self.current: Arguments = ()
        self.answers: list[Any] = []
        self.expected: list[Any] = []
        self.right: list[bool] = []
        self.changes: dict[int, str] = {}  # by case: which argument is changed

    def verdict(self) -> Verdict:
        """Try the function in all cases, and report what is wrong."""
        try:
            return self._verdict()
        except TooLong as late:
            self.tried.append(self.current)
            return self._headed(*_Raised(late).lines(), case=self._case(-1), how="located", more=self._more())

    def _verdict(self) -> Verdict:
        broken = broken_rules(self.course.rules, self.part, self.function)  # before anything is run
        for arguments in self._cases():
            self.current = arguments
            try:
                ended = self._try(arguments)
            except NotImplementedError:
                return Verdict("to do")
            except _Raised as raised:
                if not self.changes and all(self.right):
                    return self._stopped(raised, arguments)
                break  # what is wrong without an error comes first
            if ended is not None:
                return ended
        return self._judged(broken)

    def _cases(self) -> Iterator[Arguments]:
        """Yield those that are drawn first, further ones, and special ones unless one of these was wrong."""
        yield from cases(self.part, self.seed)
        yield from further_cases(self.course, self.part, self.seed)
        if all(self.right):
            yield from special_cases(self.course, self.part, self.seed)

    def _try(self, arguments: Arguments) -> Verdict | None:
        """Compare the answer in one case; return a verdict where no further one is needed."""
        frozen = {id(x): x for x in arguments if is_dataclass(x) and _is_frozen(x)}
        kept = copy.deepcopy(arguments, frozen)  # an answer may change a model that it is given
        with self.watch():
            answer, given = self._run(arguments)
        if to_do(answer):
            return Verdict("to do")
        changed = [name for name, x, y in zip(self.part.names, arguments, given) if not unchanged(x, y)]
        if changed:
            self.changes[len(self.tried)] = changed[0]
        right = value_of_reference(self.part, kept)
        self.tried.append(arguments)
        self.answers.append(answer)
        self.expected.append(right)
        self.right.append(agree(self.part, answer, right, arguments))
        if self.right[-1] or agree(self.part, value_of_reference(self.part, arguments), right, arguments):
            return None
        return self._changed(len(self.tried) - 1, self.part.names[0])

    def _run(self, arguments: Arguments) -> tuple[Any, Arguments]:
        """Call the function on copies of the arguments; return its answer, and what has become of them."""
        given = copied(arguments)
        try:
            return plain(self.part.value(self.function, given)), given
        except (KeyboardInterrupt, NotImplementedError):
            raise
        except BaseException as error:  # whatever the student's code raises becomes a message
            raise _Raised(error) from None

    def _stopped(self, raised: _Raised, arguments: Arguments) -> Verdict:
        """Report an error, and the change after which there is none and the answer is right."""
        self.tried.append(arguments)
        lines = raised.lines()
        if self.search and not isinstance(raised.error, MemoryError | SystemExit):
            every = every_case(self.course, self.part, self.seed)
            found = diagnose(self.part, self.function, [None] * len(every), every, self.course.field)
            if found.how == "line":
                shown = {"help": found.help, "cure": found.cure, "more": self._more()}
                return self._headed(*lines, *found.lines, case=self._case(-1), how="line", **shown)
        return self._headed(*lines, case=self._case(-1), how="located", more=self._more())

    def _judged(self, broken: Sequence[Text]) -> Verdict:
        """Return the verdict on a function that has given answers: what is wrong comes before what is forbidden."""
        k = 0 if all(self.right) else self.right.index(False)
        if self.changes:  # what is wrong besides may come of it
            return self._changed(*min(self.changes.items()))
        if self._keeps(k):
            return self._headed(KEPT, case=self._case(k))
        if not all(self.right):
            return self._wrong(k)
        why = ONE_ARRAY if is_one_array(self.answers[0]) else None
        if copied_results(self.answers, self.expected, self.expected):
            why = why or ONE_WAY
        remarks = broken or ([COMPUTE_EACH.fill(why=why)] if why else [])
        return self._headed(*remarks) if remarks else Verdict("done")

    def _keeps(self, k: int) -> bool:
        """Whether it keeps something from one call to the next: it returns something else, or an array of before."""
        again = None
        with suppress(NotImplementedError, _Raised), self.watch():
            again = self._run(self.tried[k])[0]
        if not agree(self.part, again, self.answers[k], self.tried[k]) and not _repeated(again, self.answers[k]):
            return True
        if all(self.right):
            one_part = [self.part] * len(self.tried)
            return not all(map(agree, one_part, self.answers, self.expected, self.tried))
        objects = [x for x, is_right in zip(self.answers, self.right) if is_right and isinstance(x, np.ndarray | list)]
        return any(self.answers[k] is x for x in objects)

    def _changed(self, k: int, name: str) -> Verdict:
        """Report that an argument is changed, in which case, and how to make a copy."""
        argument = self.tried[k][self.part.names.index(name)]
        copies = {np.ndarray: (COPY.fill(name=name),), list: (COPY_OF_LIST.fill(name=name),)}
        if inspect.isclass(self.part.solution):
            return self._headed(CHANGED_TERM, case=self._case(k))
        help = copies.get(type(argument), ())
        return self._headed(CHANGED.fill(name=name), case=self._case(k), help=help, more=self._more())

    def _wrong(self, k: int) -> Verdict:
        """Return what is wrong with the numbers, with the first case that shows it."""
        found = diagnose(
            self.part,
            self.function,
            self.answers,
            self.tried,
            self.course.field,
            special_cases=lambda: special_cases(self.course, self.part, self.seed),
            search_code=self.search,
        )
        wrong, n = self.right.count(False), len(self.right)
        count = say("Wrong in {wrong} of {n} cases.", "{n} 组数据中错了 {wrong} 组。", wrong=wrong, n=n)
        return replace(
            self._headed(*found.lines, *([count] if self.tried[k] else []), how=found.how),
            slips=found.slips,
            case=self._case(k, (self.expected[k], self.answers[k])),
            help=found.help,
            cure=found.cure,
            more=self._more(found.slips),
        )

    def _headed(self, *lines: Text, **more: Any) -> Verdict:
        return headed(self.exercise, self.part, *lines, **more)

    def _case(self, k: int, answers: Sequence[Any] = ()) -> Case:
        k %= len(self.tried)
        return failing_case(self.exercise, self.part, k, self.seed, self.tried[k], answers)

    def _more(self, slips: Sequence[str] = ()) -> tuple[Text, ...]:
        return more(self.exercise, self.part, slips)


def more(exercise: Exercise, part: Part, slips: Sequence[str] = ()) -> tuple[Text, ...]:
    """Return where to read on, and how to ask for more."""
    course = exercise.course
    section = course.field.slips[slips[0]].section if slips else exercise.taught or exercise.section
    name = Text(f"§{section}", f" §{section}") if section[:1].isdigit() else course.title(section)
    return READ.fill(section=name), ASK.fill(call=f"{course.command} hint {part.name}")


def _is_frozen(x: Any) -> bool:
    return bool(x.__dataclass_params__.frozen)


def _repeated(first: Any, second: Any) -> bool:
    """Whether two answers are the same, as far as they are numbers."""
    if isinstance(first, tuple | list) and isinstance(second, tuple | list):
        return len(first) == len(second) and all(map(_repeated, first, second))
    try:
        return np.shape(first) == np.shape(second) and np.allclose(first, second, equal_nan=True)
    except (OverflowError, TypeError, ValueError):
        return True


def at_line(file: str, line: object, text: str | None) -> list[Text]:
    """Return where something happened in a student's file, or in a cell of a notebook, and what stands there."""
    name = Text(*(Path(file).name,) * 2)
    if "ipykernel" in file or file.startswith("<ipython"):
        name = Text("your cell", "你的单元格")
    place = say("in {file}, line {line}:", "位于 {file} 第 {line} 行：", file=name, line=line)
    return [place, Text(f"    {text}", f"    {text}")]

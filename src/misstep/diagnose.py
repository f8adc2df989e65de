"""From a wrong answer to what went wrong: several things are looked for, the likeliest first, and one is reported."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from types import ModuleType
from typing import Any

import numpy as np

from .calls import muted
from .compare import values
from .differences import differences, first_wrong_line, structure
from .exercise import Part, Slip
from .grammar import Edit, Habits
from .listing import Listing, source_with_helpers
from .search import Arguments, Evidence, Found, Hypothesis, mutants, search, slips
from .text import Text, say
from .verdict import How, Verdict

__all__ = ["Field", "diagnose"]

MAX_CPU_S = {"slip": 4.0, "own": 2.2, "own of slip": 1.2, "reference": 1.0}
"""Seconds of CPU time that each search may take, beside its number of trials."""

MAX_NAMED = 3  # slips or changes that one message names
MAX_LINES = 4  # about how the results differ
MAX_ADDED_CHARS = 12  # of an edit that is shown as the place of a slip
NOTICEABLE = 1e-6  # the least residual of a property that counts, for answers of the size of 1
PROPERTY_ERRORS = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, np.linalg.LinAlgError)
NO_HABITS = Habits()

EDITS = {
    "replace": Text("`{after}` in place of `{before}`", "用 `{after}` 代替 `{before}`"),
    "in loop": Text("`{before}` in the loop, not before it", "把 `{before}` 放进循环之内"),
    "after loop": Text("`{before}` after the loop, not in it", "把 `{before}` 放到循环之后"),
    "sum": Text("`{before}` added up in the loop, from zero", "在循环中从零开始累加 `{before}`"),
    "separate": Text("an array for each name in `{before}`", "`{before}` 中每个名字各建一个数组"),
    "drop": Text("`{before}` left out", "去掉 `{before}`"),
}
"""What an edit does, by its `how`."""

KINDS = {
    "copy": Text("kind of array", "数组类型"),
    "order": Text("order", "顺序"),
    "sign": Text("sign", "符号"),
    "turn": Text("transpose or inverse", "转置或求逆"),
    "name": Text("another quantity", "用错了量"),
    "index": Text("index", "下标"),
    "number": Text("number", "数值"),
    "operator": Text("operation", "运算"),
    "flow": Text("loop", "循环"),
}
"""What kind of slip an edit undoes, by its rule."""

SURPLUS = Text("something too much", "多写了一项或一步运算")
MISSING = Text("something missing", "漏了一项或一步运算")

KIND = Text("Kind of slip: {kinds}.", "错误类型：{kinds}。")
LOOK = Text("Look at {lines}.", "请看{lines}。")
ANY = Text("Your numbers fit any of these slips:", "你的数值正好符合以下任一错误：")
OWN = Text("Line {line}: with {edit}, it is right{cases}.", "第 {line} 行：{edit}，{cases}就正确。")
OWN_ANY = Text("Each of these changes alone makes it right{cases}:", "下列改动任取其一，{cases}就正确：")
REFERENCE = Text(
    "Your numbers are those of a right solution that has {edit}.", "你的数值正好等于正确解法作如下改动的结果：{edit}。"
)
EXCHANGED = Text("{first} and {second} are exchanged.", "{first} 与 {second} 互换了。")
BROKEN = Text("This holds for every right answer, but not for yours: {x}", "正确答案都满足而你的不满足：{x}")


@dataclass(frozen=True)
class Field:
    """What a diagnosis knows of the field that the functions are from.

    Attributes
    ----------
    slips : mapping
        The slips that have a name.
    habits : Habits
        What is taken for each other there.
    package : module, optional
        The package that the functions use.
    """

    slips: Mapping[str, Slip]
    habits: Habits = NO_HABITS
    package: ModuleType | None = None


def diagnose(
    part: Part,
    function: Callable[..., Any],
    answers: Sequence[Any],
    cases: Sequence[Arguments],
    field: Field,
    *,
    special_cases: Callable[[], Sequence[Arguments]] = tuple,
    search_code: bool = True,
) -> Verdict:
    """Return what is wrong with a function: by what it was found, the lines of its message, and the slips.

    Parameters
    ----------
    part : Part
        What it was to be: a right function, and the slips of the list.
    function : callable
        The student's.
    answers : sequence
        What it returned in each case; None where it raised an error.
    cases : sequence of tuple
        Its arguments.
    field : Field
    special_cases : callable
        Returns further cases in which a change must be right.
    search_code : bool
        Whether changed code is run.
    """
    with muted(), np.errstate(over="ignore"):
        evidence = Evidence(part, function, answers, cases, special_cases)
        return _Diagnoser(evidence, field, search_code).best()


class _Diagnoser:
    """Looks for explanations, each when it is first asked for."""

    def __init__(self, evidence: Evidence, field: Field, search_code: bool) -> None:
        self.evidence, self.part, self.field, self.search_code = evidence, evidence.part, field, search_code

    def best(self) -> Verdict:
        """Return the first explanation in the order in which they are likely."""
        producers = (self._of_slips, self._of_order, self._of_results, self._of_own_code, self._of_reference)
        for producer in (*producers, self._of_structure):
            found = producer()
            if found is not None:
                return found
        return self._located()

    # ---------------------------------------------------------------- the three searches, each made once

    @cached_property
    def listed(self) -> Found:
        """The slips of the list that give the student's numbers."""
        evidence = self.evidence
        return search(evidence, slips(self.part), evidence.answers, max_cpu_s=MAX_CPU_S["slip"])

    @cached_property
    def listing(self) -> Listing | None:
        """The student's function, traced in the first wrong case; None where its source cannot be run by itself."""
        function, evidence = self.evidence.function, self.evidence
        source = source_with_helpers(function) if self.search_code and not evidence.is_typed else None
        if source is None:
            return None
        given = dict(zip(self.part.names, evidence.cases[evidence.first]))
        try:
            listing = Listing(function, source=source, given=given)
            return listing.trace(lambda f: evidence.call(f, evidence.first))
        except Exception:  # it does not run again as it did
            return None

    @cached_property
    def own(self) -> Found:
        """The edits of the student's code that make it right."""
        if self.listing is None:
            return Found()
        evidence = self.evidence
        seconds = MAX_CPU_S["own of slip" if self.listed.whole else "own"]
        edits = mutants(self.listing, "own", self.field.habits, evidence.chance_rules)
        return search(evidence, edits, evidence.right, max_cpu_s=seconds)

    @cached_property
    def solutions(self) -> list[Listing]:
        """The right solutions, traced in the first wrong case, and what they call."""
        found = []
        for way in (self.part.solution, *self.part.ways):
            for function in (way, *(self.part.beside if way is self.part.solution else ())):
                if not inspect.isclass(function):
                    listing = Listing(function, caller=None if function is way else way)
                    found.append(listing.trace(lambda f: self.evidence.call(f, self.evidence.first)))
        return found

    @cached_property
    def reference(self) -> Found:
        """The edits of right solutions that give the student's numbers."""
        found, evidence = Found(), self.evidence
        results = [x.array for answer in evidence.answers for x in values(answer, self.part.returns) or []]
        finite = all(x is None or x.dtype.kind not in "fc" or np.isfinite(x).all() for x in results)
        raised = any(x is None for x in evidence.answers)
        if not self.search_code or evidence.is_typed or raised or not finite:
            return found
        for listing in self.solutions:
            edits = mutants(listing, "reference", self.field.habits, evidence.chance_rules)
            one = search(evidence, edits, evidence.answers, max_cpu_s=MAX_CPU_S["reference"])
            if one.whole:
                return one
            found.of_result = {**one.of_result, **found.of_result}
        return found

    # ---------------------------------------------------------------- what may be reported

    def _of_structure(self) -> Verdict | None:
        found = structure(self.part, self.evidence.answers, self.evidence.right)
        return None if found is None else _wrong("structure", found)

    def _of_order(self) -> Verdict | None:
        """Two results exchanged."""
        evidence = self.evidence
        for i, j in combinations(sorted(evidence.wrong) if evidence.is_split else [], 2):
            turned = [_exchanged(answer, i, j) for answer in evidence.answers]
            if all(all(evidence.same(*three)) for three in zip(turned, evidence.right, evidence.cases)):
                first, second = (self.part.returns[k].title for k in (i, j))
                return _wrong("structure", EXCHANGED.fill(first=first, second=second))
        return None

    def _of_slips(self) -> Verdict | None:
        names = [x.slip for x in self.listed.whole]
        if not names:
            return None
        lines = [say("Your numbers fit this slip: {x}", "你的数值正好符合这种错误：{x}", x=self._slip(names[0]))]
        if len(names) > 1:
            lines = [ANY, *(say("  - {x}", "  - {x}", x=self._slip(name)) for name in names[:MAX_NAMED])]
        edit = next((x.edit for x in self.own.whole if x.edit and _is_plain(x.edit)), None)
        cure = (
            say("To mend line {line}: {edit}.", "第 {line} 行这样改：{edit}。", line=edit.line, edit=edit_text(edit))
            if edit
            else None
        )
        return self._explained("slip", self.listed.whole, help=lines, cure=[cure] if cure else [], slips=names)

    def _of_results(self) -> Verdict | None:
        """Explain each wrong result by itself, by slips alone or by slips and edits."""
        evidence = self.evidence
        if not evidence.is_split or not evidence.wrong:
            return None
        found = dict(self.listed.of_result)
        if not evidence.wrong <= found.keys():
            if self.own.whole or self.reference.whole:
                return None
            found = {**self.reference.of_result, **self.own.of_result, **found}
        if not evidence.wrong <= found.keys():
            return None
        each = {j: found[j][0] for j in sorted(evidence.wrong)}
        lines: dict[bool, list[Text]] = {True: [], False: []}  # slips, and edits
        for j, x in each.items():
            text = say("In {name}: {x}", "在 {name} 中：{x}", name=self.part.returns[j].title, x=self._of_result(x))
            lines[bool(x.slip)].append(text)
        names = list(dict.fromkeys(x.slip for x in each.values() if x.slip))
        how: How = "slip" if names else "line" if any(x.origin == "own" for x in each.values()) else "reference"
        return self._explained(how, [*each.values()], help=lines[True], cure=lines[False], slips=names)

    def _of_result(self, hypothesis: Hypothesis) -> Text:
        if hypothesis.edit is None:
            return self._slip(hypothesis.slip)
        text = Text("that of a right solution that has {edit}.", "正好等于正确解法作如下改动的结果：{edit}。")
        if hypothesis.origin == "own":
            text = Text("line {line}, {edit} makes it right.", "第 {line} 行，{edit}，就正确。")
        return text.fill(line=hypothesis.edit.line, edit=edit_text(hypothesis.edit))

    def _of_own_code(self) -> Verdict | None:
        edits = [x.edit for x in self.own.whole if x.edit][:MAX_NAMED]
        if not edits:
            return None
        n = len(self.evidence.cases)
        cases = Text(f" in all {n} cases", f"全部 {n} 组数据") if n > 1 else Text("", "")
        each = [{"line": x.line, "edit": edit_text(x)} for x in edits]
        lines = [OWN.fill(cases=cases, **each[0])]
        if len(each) > 1:
            lines = [OWN_ANY.fill(cases=cases)]
            lines += [say("  - line {line}: {edit}", "  - 第 {line} 行：{edit}", **x) for x in each]
        numbers = dict.fromkeys(x["line"] for x in each)
        look = Text(" or ".join(f"line {n}" for n in numbers), "或".join(f"第 {n} 行" for n in numbers))
        return self._explained("line", self.own.whole[:MAX_NAMED], help=[LOOK.fill(lines=look)], cure=lines)

    def _of_reference(self) -> Verdict | None:
        edit = next((x.edit for x in self.reference.whole if x.edit), None)
        if edit is None:
            return None
        return self._explained("reference", self.reference.whole[:1], cure=[REFERENCE.fill(edit=edit_text(edit))])

    def _explained(self, how: How, found: Sequence[Hypothesis], **more: Sequence[Any]) -> Verdict:
        """Return a verdict that begins with where the answer is wrong and what kind of slip it is."""
        each = dict.fromkeys(map(self._kind, found[:MAX_NAMED]))
        kind = KIND.fill(kinds=Text(", ".join(x.en for x in each), "、".join(x.zh for x in each)))
        where, is_shown = self._where(), how != "slip" and self._structure is not None  # that says more than the kind
        return _wrong(how, *where, *[kind] * (not is_shown), **{name: tuple(lines) for name, lines in more.items()})

    def _kind(self, found: Hypothesis) -> Text:
        """Return what kind of slip was found; an edit that leaves something out says where it is too much."""
        if found.edit is None:
            return self.field.slips[found.slip].kind
        return KINDS.get(found.edit.rule) or (SURPLUS if found.origin == "own" else MISSING)

    @cached_property
    def _structure(self) -> Text | None:
        """What shows without numbers; nothing where it raised an error."""
        evidence = self.evidence
        if evidence.answers[evidence.shown] is None:
            return None
        return structure(self.part, evidence.answers, evidence.right)

    def _where(self) -> list[Text]:
        """Return where the first wrong answer differs, unless it has nothing to compare, or others would be right."""
        evidence = self.evidence
        answer, right = evidence.answers[evidence.shown], evidence.right[evidence.shown]
        if answer is None or self.part.canonical is not None:
            return []
        found = self._structure
        return [found] if found else differences(self.part, answer, right)[0][:MAX_LINES]

    def _located(self) -> Verdict:
        """Where it goes wrong, and how the numbers differ."""
        evidence, line = self.evidence, None
        if self.listing is not None:
            line = first_wrong_line(self.listing, evidence.cases[evidence.first], self.solutions)
        shown, telling = differences(self.part, evidence.answers[evidence.shown], evidence.right[evidence.shown])
        broken, help = [*self._broken_properties()][:1], (line,) if line else ()
        how: How = "located" if broken or help or telling else "numbers"
        return _wrong(how, *broken, *shown[:MAX_LINES], help=help)

    def _broken_properties(self) -> Iterator[Text]:
        """Yield the properties of right answers that the first wrong one lacks."""
        evidence = self.evidence
        answer, right, arguments = (x[evidence.shown] for x in (evidence.answers, evidence.right, evidence.cases))
        shapes = [[np.shape(x.raw) for x in values(y, self.part.returns) or []] for y in (answer, right)]
        for item in self.part.properties if shapes[0] == shapes[1] else ():
            try:
                own, of_right = (np.abs(np.asarray(item.residual(x, *arguments), complex)) for x in (answer, right))
            except PROPERTY_ERRORS:
                return
            if np.isfinite(own).all() and (own > NOTICEABLE).any() and (of_right <= NOTICEABLE).all():
                yield BROKEN.fill(x=item.text)

    def _slip(self, name: str) -> Text:
        """Return the title and the reason of a slip, those of the part where it has its own."""
        slip = self.field.slips[name]
        title, why = self.part.titles.get(name, slip.title), self.part.reasons.get(name, slip.why)
        return Text(f"{title.en}. {why.en}", f"{title.zh}。{why.zh}")


def _wrong(how: How, *lines: Text, **more: Any) -> Verdict:
    return Verdict("wrong", lines, how=how, **more)


def _exchanged(answer: Any, i: int, j: int) -> Any:
    if not isinstance(answer, tuple | list) or len(answer) <= max(i, j):
        return answer
    return tuple(answer[j if k == i else i if k == j else k] for k in range(len(answer)))


def _is_plain(edit: Edit) -> bool:
    """Whether an edit can be shown as the place of a slip: it adds little to the line."""
    return edit.rule != "flow" and len(edit.after) <= len(edit.before) + MAX_ADDED_CHARS


def edit_text(edit: Edit) -> Text:
    """Describe an edit: what is put in place of what."""
    n = len(edit.changes)
    text = EDITS["replace" if n > 1 else edit.how].fill(before=edit.before, after=edit.after)
    return Text(f"{text.en}, in {n} places", f"{text.zh}（共 {n} 处）") if n > 1 else text

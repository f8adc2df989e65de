"""What an instructor gets of a graded class: a table, a CSV, a page, and JUnit's XML."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from html import escape
from xml.etree.ElementTree import Element, SubElement, tostring

from ..exercise import Exercise
from ..judge import Verdict
from ..notebook.markup import STYLE, verdict_html
from ..text import Language, Text, columns
from .grading import Graded, Mark

__all__ = ["as_csv", "as_html", "as_junit", "as_table"]

SAY = {
    "student": Text("student", "学生"),
    "total": Text("points", "得分"),
    "hints": Text("hints", "提示"),
    "solutions": Text("solutions", "看过解答"),
    "words": Text("words", "文字作答"),
    "legend": Text(
        "A dot: to do. A question mark for each hint, an exclamation mark where the solution was shown.",
        "圆点：未做。每要一条提示记一个问号，看过解答记一个感叹号。",
    ),
    "seed": Text(
        "Random cases: --seed {seed}. A point for each exercise; answers in words are for you to read.",
        "随机数据：--seed {seed}。每题一分；文字作答请自行批阅。",
    ),
    "remarks": Text("To look at", "请留意"),
    "no words": Text("No answer: {names}", "未作答：{names}"),
    "title": Text("The exercises of the class", "全班练习"),
    "model": Text("Model answer", "参考答案"),
    "messages": Text("Messages", "消息"),
    "read": Text("In words, to be read", "文字作答（请批阅）"),
    "to do": Text("to do", "未做"),
    "done": Text("right", "正确"),
    "wrong": Text("wrong", "有误"),
}

HEADER = (
    *("student", "exercise", "function", "state", "points", "of", "hints", "solution", "slips", "how"),
    *("reason", "words", "seed"),
)

PAGE = """<!doctype html>
<html lang="{code}"><head><meta charset="utf-8"><title>{title}</title>
<meta name="viewport" content="width=device-width">
{style}
<style>
body {{font-family: sans-serif; margin: 1.5em; color: #222}}
table.tw-class {{border-collapse: collapse; font-size: 0.9em}}
table.tw-class td, table.tw-class th {{border: 1px solid #ccc; padding: 2px 6px; text-align: center}}
table.tw-class th:first-child {{text-align: left; position: sticky; left: 0; background: white;
  white-space: nowrap}}
.tw-full {{background: #d5f0e6}} .tw-part {{background: #fdf3cf}} .tw-zero {{background: #fbd5be}}
table.tw-class pre {{text-align: left; margin: 4px 0; font-family: inherit}}
.tw-scroll {{overflow-x: auto}}
</style></head><body><h1>{title}</h1>
{body}
</body></html>
"""


def as_table(found: Sequence[Graded], seed: int, language: Language) -> str:
    """Return a line for each student: points, hints, solutions shown, answers in words."""
    wide = max([columns(SAY["student"].of(language)), *(columns(one.student) for one in found)]) + 2
    names = ("total", "hints", "solutions", "words")
    lines = [_padded(SAY["student"].of(language), wide) + "".join(_padded(SAY[n].of(language), 14) for n in names)]
    for one in found:
        marks = one.marks.values()
        cells = [f"{one.points:.2f} / {len(one.marks)}", f"{sum(m.hints for m in marks)}"]
        cells += [f"{sum(m.solution for m in marks)}", f"{sum(m.words is not None for m in marks)}"]
        lines.append((_padded(one.student, wide) + "".join(_padded(cell, 14) for cell in cells)).rstrip())
        lines += [f"  ! {remark.of(language)}" for remark in one.remarks]
    return "\n".join([*lines, "", SAY["seed"].fill(seed=seed).of(language)])


def _padded(text: str, width: int) -> str:
    return text + " " * (width - columns(text))


def as_csv(found: Sequence[Graded], seed: int, language: Language) -> str:
    """Return a row for each function of each student, for each answer in words, and for each remark on a student."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADER)
    for one in found:
        for row in _rows(one, language):
            writer.writerow([_harmless(str(cell)) for cell in (one.student, *row, seed)])
    return "\ufeff" + text.getvalue()  # the mark by which spreadsheets recognise UTF-8


def _rows(one: Graded, language: Language) -> Iterator[tuple[object, ...]]:
    for remark in one.remarks:
        yield *[""] * 9, remark.of(language), ""
    for number, mark in one.marks.items():
        share = 1 / len(mark.verdicts)
        used = mark.hints, int(mark.solution)
        for name, verdict in mark.verdicts.items():
            points = share if verdict.state == "done" else 0.0
            slips, how = " ".join(verdict.slips), verdict.how if verdict.state == "wrong" else ""
            points_of = f"{points:.4g}", f"{share:.4g}"
            yield number, name, verdict.state, *points_of, *used, slips, how, _reason(verdict, language), ""
        if mark.words_verdict is not None:
            name, state = mark.exercise.answer_name, mark.words_verdict.state
            yield number, name, state, "", "", *used, "", "", "", mark.words or ""


def _harmless(cell: str) -> str:
    """Keep a spreadsheet from reading what a student wrote as a formula."""
    return "'" + cell if cell[:1] in ("=", "+", "@", "\t") or (cell[:1] == "-" and not cell[1:2].isdigit()) else cell


def _reason(verdict: Verdict, language: Language) -> str:
    """Return what the message says first after its head and its case, on one line."""
    said = [line.of(language).strip() for line in verdict.lines[1:]]
    found = [line for line in said[said.index("") + 1 if "" in said else 0 :] if line]
    last = next((k for k, line in enumerate(found) if not line.endswith((":", "："))), 0)
    return " ".join(found[: last + 1])


def as_junit(found: Sequence[Graded], seed: int, language: Language) -> str:
    """Return JUnit's XML: a suite for each student, whose name is also the class of each of the tests."""
    root = Element("testsuites", name=f"exercises, seed {seed}")
    for one in found:
        verdicts = [(n, name, v) for n, mark in one.marks.items() for name, v in mark.verdicts.items()]
        count = {state: str(sum(v.state == state for *_, v in verdicts)) for state in ("wrong", "to do")}
        how = {"failures": count["wrong"], "skipped": count["to do"], "errors": "0", "time": f"{one.seconds:.3f}"}
        student = _printable(one.student)
        suite = SubElement(root, "testsuite", {"name": student, "tests": str(len(verdicts)), **how})
        for number, name, verdict in verdicts:
            test = SubElement(suite, "testcase", classname=student, name=f"{number.replace('.', '_')}-{name}")
            if verdict.state == "wrong":
                failure = SubElement(test, "failure", message=_printable(_reason(verdict, language)))
                failure.text = _printable(verdict.report(language))
            elif verdict.state == "to do":
                SubElement(test, "skipped", message=SAY["to do"].of(language))
    return '<?xml version="1.0" encoding="utf-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def _printable(text: str) -> str:
    """Drop characters that XML cannot hold."""
    return "".join(c for c in text if c in "\n\t" or (c >= " " and c not in "\ufffe\uffff"))


def as_html(found: Sequence[Graded], seed: int, language: Language) -> str:
    """Return a page: the points of all, their answers in words beside the model answer, and every message."""
    said = f"{SAY['seed'].fill(seed=seed).of(language)}<br>{SAY['legend'].of(language)}"
    body = [f"<p>{said}</p>", _points(found, language), _remarks(found, language)]
    asked = [exercise for exercise in _exercises(found) if exercise.answer is not None]
    body += [f"<h2>{SAY['read'].of(language)}</h2>", *(_answers(exercise, found, language) for exercise in asked)]
    body += [f"<h2>{SAY['messages'].of(language)}</h2>", *(_messages(one, k, language) for k, one in enumerate(found))]
    title, code = SAY["title"].of(language), "zh-CN" if language == "zh" else "en"
    return PAGE.format(code=code, title=title, style=STYLE, body="\n".join(body))


def _exercises(found: Sequence[Graded]) -> list[Exercise]:
    return list({number: mark.exercise for one in found for number, mark in one.marks.items()}.values())


def _points(found: Sequence[Graded], language: Language) -> str:
    numbers = list(dict.fromkeys(number for one in found for number in one.marks))
    titles = (escape(exercise.title.of(language), quote=True) for exercise in _exercises(found))
    head = f"<th></th><th>{escape(SAY['total'].of(language))}</th>"
    head += "".join(f'<th title="{title}">{number}</th>' for number, title in zip(numbers, titles))
    rows = []
    for k, one in enumerate(found):
        cells = "".join(_cell(one.marks.get(number), _place(k, number)) for number in numbers)
        rows.append(f"<tr><th>{escape(one.student)}</th><td>{one.points:.2f}</td>{cells}</tr>")
    return f'<div class="tw-scroll"><table class="tw-class"><tr>{head}</tr>{"".join(rows)}</table></div>'


def _remarks(found: Sequence[Graded], language: Language) -> str:
    """Return what to look at, a line for each student of whom there is something."""
    lines = [
        f"<li><b>{escape(x.student)}</b>: {escape(' '.join(r.of(language) for r in x.remarks))}"
        for x in found
        if x.remarks
    ]
    return f"<h2>{SAY['remarks'].of(language)}</h2><ul>{''.join(lines)}</ul>" if lines else ""


def _place(student: int, number: str) -> str:
    """Return the name of the place on the page where a student's messages about an exercise begin."""
    return f"m{student}-{number}"


def _cell(mark: Mark | None, place: str) -> str:
    """Return the points of one exercise, with ? for each hint and ! where the solution was shown.

    Where something is wrong, it is a link to the messages.
    """
    if mark is None:
        return "<td></td>"
    begun = any(verdict.state != "to do" for verdict in mark.verdicts.values())
    kind = "tw-full" if mark.points == 1 else "tw-part" if mark.points else "tw-zero" if begun else ""
    text = (f"{mark.points:.2g}" if begun else "·") + "?" * mark.hints + "!" * mark.solution
    wrong = any(verdict.state == "wrong" for verdict in mark.verdicts.values())
    return f'<td class="{kind}"><a href="#{place}">{text}</a></td>' if wrong else f'<td class="{kind}">{text}</td>'


def _answers(exercise: Exercise, found: Sequence[Graded], language: Language) -> str:
    """Return the answers of all to one question, the model answer on top."""
    number = exercise.id
    model = (exercise.answer or Text("", "")).of(language).strip()
    rows = [f"<tr><th>{SAY['model'].of(language)}</th><td><pre>{escape(model)}</pre></td></tr>"]
    written = {one.student: words for one in found if (words := one.marks[number].words)}
    for student, words in written.items():
        rows.append(f"<tr><th>{escape(student)}</th><td style='text-align: left'><pre>{escape(words)}</pre></td></tr>")
    if without := ", ".join(one.student for one in found if one.student not in written):
        rows.append(f"<tr><td colspan='2'><i>{escape(SAY['no words'].fill(names=without).of(language))}</i></td></tr>")
    title = f"{number} {escape(exercise.title.of(language))}"
    table = f'<table class="tw-class">{"".join(rows)}</table>'
    return f'<details class="tw-check"><summary>{title}</summary>{table}</details>'


def _messages(one: Graded, student: int, language: Language) -> str:
    """Return the messages of one student, those about one exercise together."""
    about = {n: [v for v in mark.verdicts.values() if v.state == "wrong"] for n, mark in one.marks.items()}
    shown = ""
    for number in filter(about.get, about):
        each = (f'<div class="tw-wrong">{verdict_html(verdict, language)}</div>' for verdict in about[number])
        shown += f'<div id="{_place(student, number)}">{"".join(each)}</div>\n'
    title = f"{escape(one.student)}: {sum(map(len, about.values()))} {SAY['wrong'].of(language)}"
    return f'<details class="tw-check"><summary>{title}</summary>{shown}</details>'

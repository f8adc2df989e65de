"""What an instructor gets of a graded class: a table, a CSV, and a page."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from html import escape

from .checked import STATES, STYLE, WORDS, Checked, verdict_html
from .exercise import Exercise
from .grading import Graded
from .text import Language, Text, columns, say
from .verdict import LEVELS, Verdict

__all__ = ["as_csv", "as_html", "as_table"]

HEADER = "student exercise function state points of hints solution slips how reason words seed"
HEADS = (Text("student", "学生"), Text("points", "得分"), Text("hints", "提示"), Text("solutions", "看过解答"))
IN_WORDS = Text("words", "文字作答")
SEED = Text(
    "Random cases: --seed {seed}. A point for each exercise; answers in words are for you to read.",
    "随机数据：--seed {seed}。每题一分；文字作答请自行批阅。",
)
LEGEND = Text(
    "A dot: to do. A question mark for each hint, an exclamation mark where the solution was shown. A dash beside the "
    "points: the hidden file that counts both was not handed in.",
    "圆点：未做。每看一条提示记一个问号，看过解答记一个感叹号。得分旁有短横：没有交记录这两项的隐藏文件。",
)
UNKNOWN = "–"  # in place of a number that nobody knows
TITLE, TO_READ = Text("The exercises of the class", "全班练习"), Text("In words, to be read", "文字作答（请批阅）")
REMARKS, MESSAGES = Text("To look at", "请留意"), Text("Messages", "消息")

PAGE = """<!doctype html>
<html lang="{code}"><head><meta charset="utf-8"><title>{title}</title>
<meta name="viewport" content="width=device-width">
{style}
<style>
body {{font-family: sans-serif; margin: 1.5em; color: #222}}
table.tw-class {{border-collapse: collapse; font-size: 0.9em}}
table.tw-class td, table.tw-class th {{border: 1px solid #ccc; padding: 2px 6px; text-align: center}}
table.tw-class th:first-child {{text-align: left; position: sticky; left: 0; background: white; white-space: nowrap}}
.tw-full {{background: #d5f0e6}} .tw-part {{background: #fdf3cf}} .tw-zero {{background: #fbd5be}}
table.tw-class pre {{text-align: left; margin: 4px 0; font-family: inherit}}
.tw-scroll {{overflow-x: auto}}
</style></head><body><h1>{title}</h1>
{body}
</body></html>
"""


def as_table(found: Sequence[Graded], seed: int, language: Language) -> str:
    """Return a line for each student: points, hints, solutions shown, answers in words."""
    student, *heads = (head.of(language) for head in (*HEADS, IN_WORDS))
    wide = max([columns(student), *(columns(one.student) for one in found)]) + 2
    lines = [_padded(student, wide) + "".join(_padded(head, 14) for head in heads)]
    for one in found:
        marks = one.marks.values()
        used = sum(sum(m.hints.values()) for m in marks), sum(m.solution for m in marks)
        words = sum(m.words is not None for m in marks)
        counts = (*(used if one.counted else (UNKNOWN, UNKNOWN)), words)
        cells = (f"{one.points:.2f} / {len(one.marks)}", *map(str, counts)) if one.marks else ()
        lines.append((_padded(one.student, wide) + "".join(_padded(cell, 14) for cell in cells)).rstrip())
        lines += [f"  ! {remark.of(language)}" for remark in one.remarks]
    return "\n".join([*lines, "", SEED.fill(seed=seed).of(language)])


def _padded(text: str, width: int) -> str:
    return text + " " * (width - columns(text))


# ---------------------------------------------------------------- for programs


def as_csv(found: Sequence[Graded], seed: int, language: Language) -> str:
    """Return a row for each function of each student, for each answer in words, and for each remark on a student."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADER.split())
    for one in found:
        for row in _rows(one, language):
            writer.writerow([_harmless(str(cell)) for cell in (one.student, *row, seed)])
    return "\ufeff" + text.getvalue()  # the mark by which spreadsheets recognise UTF-8


def _rows(one: Graded, language: Language) -> Iterator[tuple[object, ...]]:
    for remark in one.remarks:
        yield *[""] * 9, remark.of(language), ""
    for number, mark in one.marks.items():
        share, solution = 1 / len(mark.functions), int(mark.solution) if one.counted else ""
        for name, verdict in mark.functions.items():
            points = f"{share if verdict.state == 'done' else 0:.4g}", f"{share:.4g}"
            why = " ".join(verdict.slips), verdict.how, _reason(verdict, language)
            state, hints = STATES[verdict.state].of(language), mark.hints.get(name, 0) if one.counted else ""
            yield number, name, state, *points, hints, solution, *why, ""
        if WORDS in mark.verdicts:
            name, state = mark.exercise.answer_name, STATES[mark.verdicts[WORDS].state].of(language)
            yield number, name, state, "", "", 0 if one.counted else "", solution, "", "", "", mark.words or ""


def _harmless(cell: str) -> str:
    """Keep a spreadsheet from reading what a student wrote as a formula."""
    return "'" + cell if cell[:1] in ("=", "+", "@", "\t") or (cell[:1] == "-" and not cell[1:2].isdigit()) else cell


def _reason(verdict: Verdict, language: Language) -> str:
    """Return what the message says first after its head, on one line; what ends in a colon goes with the next."""
    found = [line.of(language).strip() for line in verdict.help or verdict.cure or verdict.lines[1:]]
    last = next((k for k, line in enumerate(found) if not line.endswith((":", "："))), 0)
    return " ".join(found[: last + 1])


# ---------------------------------------------------------------- the page


def as_html(found: Sequence[Graded], seed: int, language: Language) -> str:
    """Return a page: the points of all, their answers in words beside the model answer, and every message."""
    everyone, found = found, [one for one in found if one.marks]
    exercises = [mark.exercise for mark in found[0].marks.values()] if found else []
    body = [f"<p>{SEED.fill(seed=seed).of(language)}<br>{LEGEND.of(language)}</p>", _points(exercises, found, language)]
    remarks = [
        (one.student, " ".join(remark.of(language) for remark in one.remarks)) for one in everyone if one.remarks
    ]
    if remarks:
        items = "".join(f"<li><b>{escape(student)}</b>: {escape(text)}</li>" for student, text in remarks)
        body.append(f"<h2>{REMARKS.of(language)}</h2><ul>{items}</ul>")
    body.append(f"<h2>{TO_READ.of(language)}</h2>")
    body += [_answers(exercise, found, language) for exercise in exercises if exercise.answer is not None]
    body += [f"<h2>{MESSAGES.of(language)}</h2>", *(_messages(one, k, language) for k, one in enumerate(found))]
    code = "zh-CN" if language == "zh" else "en"
    return PAGE.format(code=code, title=TITLE.of(language), style=STYLE, body="\n".join(body))


def _points(exercises: Sequence[Exercise], found: Sequence[Graded], language: Language) -> str:
    """Return the points of all as a table, a row for each student."""
    heads = [f'<th title="{escape(e.title.of(language), quote=True)}">{e.id}</th>' for e in exercises]
    rows = [f"<th></th><th>{HEADS[1].of(language)}</th>{''.join(heads)}"]
    for k, one in enumerate(found):
        cells = "".join(_cell(mark, _place(k, number)) for number, mark in one.marks.items())
        rows.append(
            f"<th>{escape(one.student)}</th><td>{one.points:.2f}{'' if one.counted else ' ' + UNKNOWN}</td>{cells}"
        )
    return f'<div class="tw-scroll">{_table(rows)}</div>'


def _table(rows: Sequence[str]) -> str:
    return f'<table class="tw-class">{"".join(f"<tr>{row}</tr>" for row in rows)}</table>'


def _place(student: int, number: str) -> str:
    """Return the name of the place on the page where a student's messages about an exercise begin."""
    return f"m{student}-{number}"


def _cell(mark: Checked, place: str) -> str:
    """Return the points of one exercise, what was used for them, and a link to the messages."""
    states = {verdict.state for verdict in mark.functions.values()}
    has_begun = states != {"to do"}
    kind = "tw-full" if mark.points == 1 else "tw-part" if mark.points else "tw-zero" if has_begun else ""
    text = (f"{mark.points:.2g}" if has_begun else "·") + "?" * sum(mark.hints.values()) + "!" * mark.solution
    return f'<td class="{kind}">' + (f'<a href="#{place}">{text}</a>' if "wrong" in states else text) + "</td>"


def _answers(exercise: Exercise, found: Sequence[Graded], language: Language) -> str:
    """Return the answers of all to one question, the model answer on top."""
    model = (exercise.answer or Text("", "")).of(language).strip()
    rows = [f"<th>{Text('Model answer', '参考答案').of(language)}</th><td><pre>{escape(model)}</pre></td>"]
    written = {one.student: words for one in found if (words := one.marks[exercise.id].words)}
    for student, words in written.items():
        rows.append(f"<th>{escape(student)}</th><td style='text-align: left'><pre>{escape(words)}</pre></td>")
    if without := ", ".join(one.student for one in found if one.student not in written):
        text = say("No answer: {names}", "未作答：{names}", names=without).of(language)
        rows.append(f"<td colspan='2'><i>{escape(text)}</i></td>")
    return _folded(f"{exercise.id} {exercise.title.of(language)}", _table(rows))


def _messages(one: Graded, student: int, language: Language) -> str:
    """Return the messages of one student, those about one exercise together."""
    shown, n = "", 0
    for number, mark in one.marks.items():
        if wrong := [verdict for verdict in mark.functions.values() if verdict.state == "wrong"]:
            each = (f'<div class="tw-wrong">{verdict_html(verdict, language, LEVELS[-1])}</div>' for verdict in wrong)
            shown += f'<div id="{_place(student, number)}">{"".join(each)}</div>\n'
            n += len(wrong)
    return _folded(f"{one.student}: {n} {Text('wrong', '处有误').of(language)}", shown)


def _folded(title: str, text: str) -> str:
    return f'<details class="tw-check"><summary>{escape(title)}</summary>{text}</details>'

"""Questions inside the page: ten for each section to be done on paper, and the lines of a recursion to be put in order.

The questions are those of `twistwrench exercises sheet`. A choice says whether it is the right one, a number is folded
away; two buttons print the sheet, with or without the answers. The recursions are in recursions.toml.
"""

from __future__ import annotations

import json
import random
import tomllib
from html import escape
from pathlib import Path
from typing import Any

from twistwrench.exercises.pencil import LETTERS, SECTIONS, WORDS, PencilQuestion, gift, note, pencil_questions, plain

from . import notebooks
from .pages import contents, joined, write

RECURSIONS = Path(__file__).with_name("recursions.toml")
SAY = {
    "en": {
        "answer": "Answer",
        "right": "Right.",
        "wrong": "Not this one.",
        "sheet": "Print the sheet",
        "answers": "Print it with the answers",
        "moodle": "For Moodle and others (GIFT)",
        "slides": "Slides of this section's notebook",
        "order": "Put the lines in order",
        "check": "Check",
        "up": "up",
        "down": "down",
        "done": "Right: this order runs.",
        "needs": "Line {}: “{}” needs what “{}” does, which comes only later.",
        "solution": "The order",
        "keys": "Move a line with its buttons, or with the arrow keys while one of them is selected.",
        "before": "Before you read on: [put the lines in order](../pencil/{}.md).",
    },
    "zh": {
        "answer": "答案",
        "right": "对。",
        "wrong": "不是这个。",
        "sheet": "打印题目",
        "answers": "打印题目和答案",
        "moodle": "导入 Moodle 等平台（GIFT）",
        "slides": "本节笔记本的幻灯片",
        "order": "把各行排好顺序",
        "check": "检查",
        "up": "上移",
        "down": "下移",
        "done": "对：这个顺序可以运行。",
        "needs": "第 {} 行：“{}” 要用到 “{}” 的结果，而它在后面才出现。",
        "solution": "正确顺序",
        "keys": "用每行的按钮移动，或者选中按钮后按上下方向键。",
        "before": "往下读之前：[先把各行排好顺序](../pencil/{}.md)。",
    },
}
INDEX = {
    "en": """# For class

Ten questions to each section, to be done with a pencil, in class or before it: click for the answer, or print the
sheet. Where the section has a recursion, its lines are there to be put in order. For teachers: [ninety minutes at the
board](../teaching.md) for each section, [questions for an exam](../exam.md) with what earns each point, slides, and
[how to grade](../instructors.md).""",
    "zh": """# 课堂用题

每节十道题，用纸笔就能做，可在课上或课前使用：点开看答案，或者打印出来。有递推算法的小节，还要把它的各行排好顺序。
教师另见：每节的[九十分钟板书安排](../teaching.md)、[考试题](../exam.md)与评分标准、幻灯片，以及[怎样评分](../instructors.md)。""",
}


def name_of(section: str) -> str:
    """Return the name of the page of a section: 49_05 of 49.5."""
    chapter, number = section.split(".")
    return f"{chapter}_{int(number):02}"


def recursions() -> dict[str, dict[str, Any]]:
    """Return what recursions.toml says, by algorithm."""
    return tomllib.loads(RECURSIONS.read_text(encoding="utf-8"))


def invitation(algorithm: str, language: str) -> str:
    """Return the sentence that leads from the page of an algorithm to its lines in disorder."""
    return SAY[language]["before"].format(name_of(recursions()[algorithm]["section"]))


def page(section: str, language: str) -> str:
    """Return the page of a section, as Markdown for MyST."""
    say = SAY[language]
    title = WORDS["title"].fill(section=section).of(language)
    buttons = "".join(
        f'<button type="button" data-print="{kind}">{say[kind]}</button>' for kind in ("sheet", "answers")
    )
    parts = [f"# {title}", note(section, language)]
    parts.append(f'```{{raw}} html\n<div class="pencil-bar">{buttons}</div>\n```')
    parts += [_question(k, question, language) for k, question in enumerate(pencil_questions(section), start=1)]
    parts += [puzzle(one, language) for one in recursions().values() if one["section"] == section]
    parts.append(f"{{download}}`{say['moodle']} <{name_of(section)}.gift.txt>`")
    begins = "00" if section == "49.0" else name_of(section)
    slides = next(name for name in notebooks.names() if name.startswith(begins))
    parts.append(f'```{{raw}} html\n<p><a href="../slides/{slides}.html">{say["slides"]}</a></p>\n```')
    parts.append('```{raw} html\n<script src="../_static/pencil.js"></script>\n```')
    return "\n\n".join(parts) + "\n"


def _question(k: int, question: PencilQuestion, language: str) -> str:
    say, why = SAY[language], plain(question.why.of(language))
    lines = [":::{container} pencil", f"**{k}.** {plain(question.text.of(language))}"]
    for j, choice in enumerate(question.choices):
        is_right = j == question.right
        told = f"{say['right']} {why}" if is_right else say["wrong"]
        lines.append(_fold(f"{LETTERS[j]}) {choice.of(language)}", told, "choice right" if is_right else "choice"))
    if not question.choices:
        lines.append(_fold(say["answer"], f"**{plain(question.answer(language))}** {why}", "answer"))
    return "\n\n".join(lines) + "\n:::"


def _fold(head: str, body: str, kind: str) -> str:
    return f'<details class="{kind}"><summary>{escape(head)}</summary>\n\n{body}\n\n</details>'


def puzzle(given: dict[str, Any], language: str) -> str:
    """Return the lines of a recursion, shuffled; without a script they can be read, and their order unfolded."""
    say, lines = SAY[language], given["lines"]
    shuffled = list(range(len(lines)))
    random.Random(len(lines)).shuffle(shuffled)
    words = {key: say[key] for key in ("check", "up", "down", "done", "needs", "keys")}
    data = escape(json.dumps({"after": given["after"], "words": words}, ensure_ascii=False))
    items = "".join(f'<li data-line="{k}"><code>{escape(lines[k])}</code></li>' for k in shuffled)
    solution = f"<details><summary>{say['solution']}</summary><pre>{escape(chr(10).join(lines))}</pre></details>"
    html = f'<div class="order" data-order="{data}"><ol>{items}</ol>{solution}</div>'
    says = plain(given["says"][language == "zh"])
    return f"## {say['order']}\n\n{says}\n\n```{{raw}} html\n{html}\n```"


def write_pencil(out: Path, language: str) -> None:
    """Write a page for each section, its file for Moodle, and the page that leads to them."""
    names = [name_of(section) for section in SECTIONS]
    for section, name in zip(SECTIONS, names, strict=True):
        write(out / "pencil" / f"{name}.md", page(section, language))
        write(out / "pencil" / f"{name}.gift.txt", gift(section, "zh" if language == "zh" else "en") + "\n")
    inside = contents([*names, "../teaching", "../exam"])
    write(out / "pencil" / "index.md", f"{joined(INDEX[language], language)}\n\n{inside}\n")

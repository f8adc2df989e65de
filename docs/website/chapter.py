"""The chapter's path: for each section its notebook, algorithms line by line, functions, and errata; its exercises."""

from __future__ import annotations

import re
from pathlib import Path

import nbformat

from misstep import skeletons
from misstep.text import Language, wrapped
from twistwrench.exercises.chapter import COURSE
from twistwrench.exercises.pencil import plain

from . import beside, figures, hands, inpage, interface, notebooks, pencil
from .pages import ROOT, SUFFIX, contents, joined, write

INTRO = {
    "en": """# The chapter

A notebook for each section, and one to begin with; below it the algorithms line by line, the functions, and what the
chapter gets wrong there. The outputs are those of the run that built this site, and everything that a notebook says in
numbers is an `assert`. To change a cell and see what still holds, press *Run* in its page where there is such a button,
or download the notebook.""",
    "zh": """# 逐节学习

每节一个笔记本，另有一个用来起步；下面列出相应的逐行算法、函数，以及本章该节的勘误。
页面上的输出来自构建本站时的运行；笔记本中凡是用数字说明的结论，都有一条 `assert` 检验。
想改动代码、看看哪些结论还成立，页面上有「运行」按钮时就在页面里运行，或者下载笔记本。""",
}
WORDS = {
    "en": {"lines": "Line by line", "functions": "Functions", "pencil": "Pencil", "wrong": "Errata", "colon": ": "},
    "zh": {"lines": "逐行读", "functions": "函数", "pencil": "纸笔题", "wrong": "勘误", "colon": "："},
}
EXERCISES = {
    "en": """# Exercises

The chapter's exercises with its pre-test and its project, in our own words. Answer them here, where *Check* says
where an answer is wrong and what kind of slip it is, and *Hint* helps one step at a time; or in a shell: `twistwrench
exercises start answers` puts them into a folder, `python -m pytest` there checks what you write, and `twistwrench
exercises hint 49.3.1` helps. Both have the same files: what is written here can be downloaded, and opened again.""",
    "zh": """# 练习

本章的练习，连同前置自测与累积项目，用我们自己的话写成。
可以就在这里作答：「检查」指出错在哪里、是哪一类错误，「提示」一步一步给出提示；也可以在命令行里：
`twistwrench exercises start answers --language zh` 把它们放进一个文件夹；
在那里运行 `python -m pytest` 就会检查你写下的答案；
`twistwrench exercises hint 49.3.1` 给出提示。两处的文件相同：这里写下的答案可以下载，也可以再读入。""",
}


ANSWER = """<details class="exercise" data-number="{}"><summary>{}</summary>

```python
{}
```

</details>"""
"""Where an exercise is answered: its skeleton, which becomes an editor where Python is in the page."""


def write_chapter(out: Path, language: str) -> None:
    """Write the page of the chapter's path."""
    at, errata = interface.sections(), _errata(language)
    doors, say = [], WORDS[language]
    for name in notebooks.names():
        number = _number(name)
        lines = [f"[{call}](../algorithms/{page}.md)" for page, call in _algorithms(number, at)]
        functions = [page for page in interface.by_page() if at.get(page) == number]
        files = [f"[`{page.split('/')[-1]}`](../api/{page}.md)" for page in functions]
        wrong = [f"[{number}](../errata.md#{errata[number]})"] if number in errata else []
        on_paper = [f"[{number}](../pencil/{pencil.name_of(number)}.md)"] if number else []
        beside_it = {"lines": lines, "functions": files, "pencil": on_paper, "wrong": wrong}
        below = [f"{say[what]}{say['colon']}{', '.join(links)}" for what, links in beside_it.items() if links]
        title = f"[{_title(name, language)}]({name}.ipynb)"
        doors.append(_door(_seen(out, name), title, below))
    for name, text in (("exercises", EXERCISES), ("../pencil/index", pencil.INDEX), ("../hands/index", hands.INTRO)):
        title, first = text[language].split("\n\n")[:2]
        seen = hands.thumbnail({"exercises": "feet", "../pencil/index": "field"}.get(name, "frames"))
        doors.append(_door(seen, f"[{title.removeprefix('# ')}]({name}.md)", [joined(_sentence(first), language)]))
    path = "\n".join(["::::{container} doors", *doors, "::::"])
    inside = contents([*notebooks.names(), "exercises", "../pencil/index", "../hands/index"], hidden=True)
    parts = [joined(INTRO[language], language), path, inside]
    write(out / "chapter" / "index.md", "\n\n".join(parts) + "\n")
    write(out / "chapter" / "exercises.md", _exercises(language))


def _door(seen: str, title: str, below: list[str]) -> str:
    return "\n\n".join([f":::{{container}} door\n```{{raw}} html\n{seen}\n```", f"**{title}**", *below]) + "\n:::"


def _seen(out: Path, name: str) -> str:
    """Return the picture of a notebook that was run which stands for it; of one that marks none, the first."""
    drawn = [*figures.figures(nbformat.read(out / "chapter" / f"{name}.ipynb", as_version=4))]
    marked = (picture for picture in drawn if "thumbnail" in picture.cell.metadata.get("tags", ()))
    picture = next(marked, drawn[0])
    return figures.image(picture.file, picture.says, link=f"{name}.html")


def _sentence(text: str) -> str:
    """Return the first sentence of a text."""
    return re.split(r"(?<=[.:])\s|(?<=[。：])", text)[0]


def _exercises(language: Language) -> str:
    """Return the page of the exercises: what is asked, without hints."""
    parts = [joined(EXERCISES[language], language)]
    for section, title in COURSE.sections.items():
        number = f"{section} " if section.startswith("49") else ""
        parts.append(f"## {number}{title.of(language)}")
        for exercise in COURSE.of_section(section):
            parts.append(f"### {exercise.id} {plain(exercise.title.of(language))}")
            parts += map(plain, wrapped(exercise.text.of(language), 10**6))
            parts.append(
                ANSWER.format(exercise.id, inpage.SAY[language]["answer"], skeletons.place(exercise, language))
            )
    return "\n\n".join(parts) + "\n"


def _number(name: str) -> str:
    """Return the section of a notebook, 49.6 of 49_06_rnea; nothing for one that belongs to none."""
    found = re.match(r"49_(\d+)_", name)
    return f"49.{int(found[1])}" if found else ""


def _title(name: str, language: str) -> str:
    notebook = nbformat.read(ROOT / "notebooks" / language / f"{name}.ipynb", as_version=4)
    return str(notebook.cells[0].source).splitlines()[0].removeprefix("# ")


def _algorithms(number: str, at: dict[str, str]) -> list[tuple[str, str]]:
    """Return the pages of the algorithms of a section, and what each of them computes."""
    found = [(name, beside.read(name)) for name in beside.names()]
    return [(n, f"`{s['call']}`") for n, s in found if number == at[s["part"][-1]["file"].removesuffix(".py")]]


def _errata(language: str) -> dict[str, str]:
    """Return for each section that has errata the place where they begin."""
    text = (ROOT / "docs" / f"errata{SUFFIX[language]}.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## ((49\.\d+).*)$", text, re.MULTILINE)
    return {number: re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title, number in headings}

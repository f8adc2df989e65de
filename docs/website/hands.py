"""Take it in your hand: a page for each small object that the reader moves, and the gallery of them.

The words of an object are in hands/NAME.toml, in both languages, its drawing for the gallery in hands/NAME.svg; what it
does is in static/hands/NAME.js, and what all share in se3.js (the algebra) and hand.js (stage, sliders, tables).
Numbers of robots come from the package, when the site is built.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import Any

from . import handled
from .pages import contents, joined, write

FOLDER = Path(__file__).resolve().parent / "hands"
ORDER = ("frames", "field", "exponential", "tumbling", "film", "felt", "feet", "translate")
SHARED = ("se3", "hand")
DATA: dict[str, Callable[[], Any]] = {"film": handled.film, "felt": handled.felt, "feet": handled.feet}
"""The objects that show a robot, and where their numbers come from."""

INTRO = {
    "en": """# Take it in your hand

Small things to move: drag them, or use their sliders from the keyboard. Each is computed in the page, by the same
formulas as in the package; nothing is loaded from elsewhere, and nothing moves until you press *Play*.""",
    "zh": """# 动手试试

可以动手摆弄的小东西：用鼠标拖动，或者用键盘移动滑块。全部在页面里计算，公式与本包相同；
不从别处载入任何内容，按下「播放」之前什么都不会动。""",
}
NUMBERS = {"en": "The numbers", "zh": "数值"}
COMMON = {
    "play": {"en": "Play", "zh": "播放"},
    "pause": {"en": "Pause", "zh": "暂停"},
    "stop": {"en": ". ", "zh": "。"},
    "comma": {"en": ", ", "zh": "，"},
}
TRY = {"en": "## What to try", "zh": "## 试一试"}
BESIDE = {"en": "Take it in your hand:", "zh": "动手试试："}


def names() -> list[str]:
    """Return the names of the objects, in the chapter's order."""
    return [name for name in ORDER if (FOLDER / f"{name}.toml").exists()]


def read(name: str) -> dict[str, Any]:
    """Return what hands/NAME.toml says."""
    return tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))


def page(name: str, language: str) -> str:
    """Return the page of an object."""
    said = read(name)
    words = {key: word[language] for key, word in (COMMON | said["words"]).items()}
    data = {"words": words, "data": DATA[name]() if name in DATA else None}
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/")
    scripts = "\n".join(f'<script src="../_static/hands/{file}.js"></script>' for file in (*SHARED, name))
    label = escape(said["title"][language])
    box = f'<div class="hand" data-hand="{name}" role="group" aria-label="{label}">'
    html = (
        f'{box}\n<script type="application/json" data-numbers="{NUMBERS[language]}">{text}</script>\n</div>\n{scripts}'
    )
    parts = ["---\nhtml_theme.sidebar_secondary.remove: true\n---", f"# {said['title'][language]}"]
    parts += [joined(said["intro"][language].strip(), language), f"```{{raw}} html\n{html}\n```"]
    return "\n\n".join([*parts, TRY[language], joined(said["try"][language].strip(), language)]) + "\n"


def thumbnail(name: str) -> str:
    """Return a small drawing of an object, hands/NAME.svg, for the page itself: its lines have the page's colours."""
    return (FOLDER / f"{name}.svg").read_text(encoding="utf-8")


def gallery(language: str) -> str:
    """Return the page that leads to all of them."""
    cards = []
    for name in names():
        said = read(name)
        cards.append(
            f":::{{container}} door\n```{{raw}} html\n{thumbnail(name)}```\n\n"
            f"**[{said['title'][language]}]({name}.md)**\n\n{said['card'][language]}\n:::"
        )
    doors = "\n".join(["::::{container} doors", *cards, "::::"])
    return "\n\n".join([joined(INTRO[language], language), doors, contents(names(), hidden=True)]) + "\n"


def write_hands(out: Path, language: str) -> None:
    """Write the gallery, and the page of every object."""
    write(out / "hands" / "index.md", gallery(language))
    for name in names():
        write(out / "hands" / f"{name}.md", page(name, language))


def connect(app: Any, language: str) -> None:
    """Add to a page of the chapter the links to what belongs to it."""
    shown = [(name, read(name)) for name in names()]

    def add(app: Any, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
        if page.startswith("hands/"):
            app.add_css_file("hands/hand.css")
        here = [(n, said["title"][language]) for n, said in shown if page.startswith(tuple(said["at"]))]
        if not here or "body" not in context:
            return
        up = "../" * page.count("/")
        links = " · ".join(f'<a href="{up}hands/{name}.html">{escape(title)}</a>' for name, title in here)
        line = f'<p class="hand-links">{BESIDE[language]} {links}</p>'
        context["body"] = context["body"].replace("</h1>", f"</h1>\n{line}", 1)

    app.connect("html-page-context", add)

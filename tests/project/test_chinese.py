"""Chinese is set with its own punctuation: commas, colons and brackets as wide as the characters beside them."""

import ast
import json
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HAN = "\u4e00-\u9fff"
NOT_WORDS = re.compile(r"`[^`\n]+`|\$\$[^$]+\$\$|\$[^$\n]+\$|\]\([^)\s]*\)")
NARROW = re.compile(rf"[{HAN}][,;:!?()]|[,;:!?()](?=[{HAN}])")
PATTERNS = ("*.md", "benchmarks/*.md", "docs/**/*.md", "docs/website/*/*.toml", "models/*.md")
PATTERNS += ("notebooks/*.md", "notebooks/source/*.toml", "notebooks/zh/*.ipynb")
PATTERNS += ("src/**/*.md", "src/**/*.py", "src/**/*.toml")
FILES = sorted(path for pattern in PATTERNS for path in ROOT.glob(pattern))


def texts(path: Path) -> list[str]:
    """The texts of a file: of a Python file its strings, of a notebook its cells of text."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        found = (node.value for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Constant))
        return [value for value in found if isinstance(value, str)]
    if path.suffix == ".ipynb":
        return ["".join(cell["source"]) for cell in json.loads(text)["cells"] if cell["cell_type"] == "markdown"]
    return [text]


@cache
def spoken(path: Path) -> str:
    """The texts of a file without its code and formulas."""
    return NOT_WORDS.sub("x", "".join(texts(path)))


def narrow(text: str) -> list[str]:
    """Where a mark as narrow as those of English stands beside a Chinese character, outside code and formulas."""
    words = NOT_WORDS.sub("x", text)
    return [words[max(0, found.start() - 10) : found.end() + 10] for found in NARROW.finditer(words)]


def test_chinese_has_its_own_punctuation():
    every = {path.relative_to(ROOT).as_posix(): texts(path) for path in FILES}
    assert sum(bool(re.search(f"[{HAN}]", "".join(own))) for own in every.values()) > 80
    assert {
        name: found for name, own in every.items() if (found := [place for text in own for place in narrow(text)])
    } == {}


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("质心,脚", 1),
        ("质心(脚)", 2),
        ("(质心)", 2),
        ("质心\uff08脚\uff09", 0),
        ("转动 (ω, v)", 0),
        ("见 `f(质心)`:", 0),
    ],
)
def test_a_narrow_mark_is_noticed(text, places):
    assert len(narrow(text)) == places


ONE_TERM = {
    "构型": "位形",
    "转动关节": "旋转关节",
    "棱柱关节": "移动关节",
    "(?<!复合刚体)复合惯量(?!（)": "复合刚体惯量",
    rf"(?<=[{HAN}])\s?Jacobian(?![A-Za-z(])|(?<![A-Za-z_.])Jacobian\s?(?=[{HAN}])": "雅可比矩阵",
    "[父子](?:物体|刚体)|物体 i|个物体": "连杆, or 刚体",
    "铰链": "旋转关节, or 关节",
    "世界系": "世界坐标系",
    "雅可比(?!矩阵)": "雅可比矩阵",
    "带不动|全部家当|看见机器人|沿树行走": "a mistranslation",
}
"""What a thing is not called, and what it is called: docs/glossary.zh-CN.md."""
ELSEWHERE = ("docs/glossary", "docs/mirror")
"""The glossary and the chapter's own headings have the chapter's words."""


@pytest.mark.one_case
@pytest.mark.parametrize("word", ONE_TERM)
def test_one_thing_has_one_term(word):
    wrong = "构型，转动关节，棱柱关节，复合惯量，脚的 Jacobian 矩阵，带不动，父物体，铰链，世界系，雅可比"
    assert re.search(word, wrong)
    own = [path for path in FILES if not path.relative_to(ROOT).as_posix().startswith(ELSEWHERE)]
    found = {
        path.name: [one[max(0, hit.start() - 9) : hit.end() + 9] for hit in re.finditer(word, one)]
        for path in own
        for one in [spoken(path)]
    }
    assert {name: places for name, places in found.items() if places} == {}, ONE_TERM[word]

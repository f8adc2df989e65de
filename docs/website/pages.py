"""Which page of the site comes from which file, and how links between files become links between pages.

A file keeps its text: it is read on a code host as it stands. On the way into the site only its links change, and the
line that leads to its twin in the other language goes, since every page of the site has a switch for that.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

from .digits import with_digits
from .film import with_films
from .front import hero, trot
from .orders import with_drawings
from .thumbnails import thumbnail

ROOT = Path(__file__).resolve().parents[2]
TEXT = Path(__file__).resolve().parent / "text"
LANGUAGES = ("en", "zh")
SUFFIX = {"en": "", "zh": ".zh-CN"}

LOOK_UP = ("companion", "mirror", "errata", "conventions", "map", "traps", "everyday", "glossary")
PROJECT = ("contributing", "changelog", "models", "exercises")
CLASS = ("teaching", "exam")
ONE_BY_ONE = {
    "README.md": "readme",
    "CHANGELOG.md": "changelog",
    "benchmarks/README.md": "benchmarks",
    "models/README.md": "models",
    "src/twistwrench/exercises/README.md": "exercises",
}
"""Pages from files outside docs/. Of docs/ every page is taken that is there."""

FENCE = re.compile(r"^(`{3,}|~{3,}).*?^\1`*$\n?", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"(\]\(|<img src=\"|<source srcset=\")(?![a-z]+:|#)([^)\s\"#]+)(#[^)\s\"]*)?")
TO_THE_TWIN = re.compile(
    r"^\[(?:简体中文|English|中文)\]\([^)]+\)(?: · \[(?:README|glossary|词汇表)\]\([^)]+\))*(?: · |\n+)", re.MULTILINE
)
"""What leads to the page in the other language, to the README and to the glossary, to which each word leads here; links
to other pages may follow in its line, and stay."""
LINE_END = re.compile(
    r"(^#.*\n)|(?<=[\u4e00-\u9fff，。；：、！？）》”])\n {0,3}(?=[\u4e00-\u9fff（《“`])"
    r"|(?<=[，。；：、！？）》”])\n {0,3}(?=[A-Za-z\[]|\*\*)",
    re.MULTILINE,
)
"""Where a line of Chinese ends and no blank may show; a heading ends with its line."""
PICTURE = re.compile(r'<picture>\n<source srcset="([^"]+)"[^>]*>\n<img src="([^"]+)" alt="([^"]+)">\n</picture>')
"""A picture for the dark and one for the light; the site shows the one of the theme, not of the machine."""
IMAGES = "```{image} \\2\n:alt: \\3\n:class: only-light\n```\n\n```{image} \\1\n:alt: \\3\n:class: only-dark\n```"
NO_TWIN = "\n\n:::{note}\n本页只有英文。\n:::\n"


def pages() -> dict[str, str]:
    """Return the pages that come from files as they are: the file's path, the page's name."""
    found = {path.relative_to(ROOT).as_posix(): path.stem for path in sorted((ROOT / "docs").glob("*.md"))}
    found = {path: name for path, name in found.items() if not name.endswith(SUFFIX["zh"])}
    return found | {path: name for path, name in ONE_BY_ONE.items() if (ROOT / path).exists()}


def twin(path: str, language: str) -> str:
    """Return the path of a page's file in a language, whether it is there or not."""
    return path.replace(SUFFIX["zh"], "").removesuffix(".md") + SUFFIX[language] + ".md"


def studies() -> list[str]:
    """Return the names of the pages that are neither for looking up, for class nor about the project."""
    return [name for name in pages().values() if name not in (*LOOK_UP, *PROJECT, *CLASS, "readme")]


def write_pages(out: Path, language: str) -> None:
    """Write all pages that come from files, and the files that they show or link to."""
    for path, name in pages().items():
        own = twin(path, language)
        there = (ROOT / own).exists()
        text = (ROOT / (own if there else path)).read_text(encoding="utf-8")
        text = moved(text if there else _with_note(text), own if there else path, name, out)
        for add in (with_digits, with_drawings):
            text = add(text, language)
        write(out / f"{name}.md", with_films(text, ROOT / path, language))


def moved(text: str, path: str, name: str, out: Path) -> str:
    """Return the text of a file as the text of the page `name`, its links turned into those of the site."""
    here = Path(path).parent

    def follow(match: re.Match[str]) -> str:
        before, target, fragment = match[1], match[2], match[3] or ""
        goal = os.path.normpath(here / target)
        if not (ROOT / goal).exists():
            return match[0]  # for Sphinx to complain of, with the line
        page = page_of(goal)
        if page is None:
            page = _carried(goal, out)
        return f"{before}{os.path.relpath(page, Path(name).parent)}{fragment}"

    pieces = [(fenced, part if fenced else LINK.sub(follow, TO_THE_TWIN.sub("", part))) for fenced, part in cut(text)]
    if not any(re.search(r"^## ", part, re.MULTILINE) for fenced, part in pieces if not fenced):
        pieces = [(f, part if f else re.sub(r"^### ", "## ", part, flags=re.MULTILINE)) for f, part in pieces]
    if path.endswith(f"{SUFFIX['zh']}.md"):
        pieces = [(f, part if f else joined(part, "zh")) for f, part in pieces]
    return PICTURE.sub(IMAGES, "".join(part for _, part in pieces))


def page_of(path: str) -> str | None:
    """Return the page, with its ending, that a file or folder of the repository has become."""
    english = twin(path, "en") if path.endswith(".md") else path
    if english in pages():
        return f"{pages()[english]}.md"
    if re.fullmatch(r"notebooks/(en|zh|source)/\w+\.(ipynb|py)", path):
        return f"chapter/{Path(path).stem}.ipynb"
    if path == "notebooks" or path.startswith(("notebooks/en", "notebooks/zh", "notebooks/README")):
        return "chapter/index.md"
    return None


def _carried(path: str, out: Path) -> str:
    """Carry a file of the repository into the site; a folder is its README, or the list of its files."""
    source, target = ROOT / path, f"files/{path.lstrip('.')}"
    if source.is_dir():
        listing = "\n".join(sorted(p.name for p in source.iterdir() if not p.name.startswith(("_", "."))))
        write(out / f"{target}.txt", listing + "\n")
        return f"{target}.txt"
    (out / target).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, out / target)
    return target


def joined(text: str, language: str) -> str:
    """Return a text whose lines of Chinese follow each other without a blank."""
    return LINE_END.sub(r"\1", text) if language == "zh" else text


def cut(text: str) -> Iterator[tuple[bool, str]]:
    """Cut a text at its fenced blocks: yield whether a piece is one, and the piece."""
    end = 0
    for match in FENCE.finditer(text):
        yield False, text[end : match.start()]
        yield True, match[0]
        end = match.end()
    yield False, text[end:]


def _with_note(text: str) -> str:
    title, _, rest = text.partition("\n")
    return title + NO_TWIN + rest


def write_texts(out: Path, language: str, listings: dict[str, list[str]]) -> None:
    """Write the pages that only the site has; `<!-- pages: x -->` becomes a list of pages, `gallery: x` doors."""
    moving = {"<!-- stepper -->": hero(language), "<!-- trot -->": trot(language)}
    for path in TEXT.glob("*.md"):
        if path.stem.endswith(SUFFIX["zh"]) != (language == "zh"):
            continue
        name = path.stem.removesuffix(SUFFIX["zh"]).replace("__", "/")
        text = path.read_text(encoding="utf-8")
        for mark, html in moving.items():
            text = text.replace(mark, html)
        text = "".join(part if f else joined(part, language) for f, part in cut(text))
        text = re.sub(r"<!-- gallery: (\w+) -->", lambda m: gallery(listings[m[1]], out, language), text)
        text = re.sub(r"<!-- (hidden )?pages: (\w+) -->", lambda m: contents(listings[m[2]], bool(m[1])), text)
        write(out / f"{name}.md", text)


def contents(names: list[str], hidden: bool = False) -> str:
    """Return a table of contents of some pages."""
    return "\n".join(["```{toctree}", ":maxdepth: 1", *([":hidden:"] if hidden else []), "", *names, "```"])


def gallery(names: list[str], out: Path, language: str) -> str:
    """Return a door to each of some pages that are written: a picture, its title and its first sentence."""
    doors = []
    for name in names:
        text = (out / f"{name}.md").read_text(encoding="utf-8")
        title, *blocks = re.sub(r"^# ", "", text.strip()).split("\n\n")
        words = next(block for block in blocks if re.match(r"[\w`]", block))
        says = re.match(r".*?(?:[.?](?=\s|$)|[。？]|$)", words, re.DOTALL)[0]
        says = re.sub(r"\[([^\]]+)\]\([^)]+\)", r"\1", says)
        seen = f"```{{raw}} html\n{thumbnail(name, text, language)}```\n"
        doors.append("\n".join([":::{container} door", seen, f"**[{title}]({name}.md)**\n", says, ":::"]))
    return "\n".join(["::::{container} doors", *doors, "::::"])


def write(path: Path, text: str) -> None:
    """Write a file, and the folders above it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="\n")


def replace(old: Path, new: Path) -> bool:
    """Put the files of a tree in the place of another, touching only what differs; return whether any went."""
    there = {path.relative_to(old) for path in old.rglob("*") if path.is_file()}
    coming = {path.relative_to(new) for path in new.rglob("*") if path.is_file()}
    for name in coming:
        if name not in there or (old / name).read_bytes() != (new / name).read_bytes():
            (old / name).parent.mkdir(parents=True, exist_ok=True)
            (new / name).replace(old / name)
    for name in there - coming:
        (old / name).unlink()
    return bool(there - coming)

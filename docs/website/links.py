"""Check that every link inside the site leads somewhere, and that no page fetches anything from elsewhere."""

from __future__ import annotations

from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

FETCHED = {
    ("script", "src"),
    ("link", "href"),
    ("img", "src"),
    ("source", "src"),
    ("iframe", "src"),
    ("object", "data"),
}
NOT_FETCHED = {"canonical", "alternate", "author", "license"}


class Page(HTMLParser):
    """What a page links to, what it fetches, and the places in it that can be linked to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.fetched: list[str] = []
        self.places: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        """Note an element's target and its name."""
        for name, value in attributes:
            if name == "id" or (tag, name) == ("a", "name"):
                self.places.add(value or "")
            elif (tag, name) == ("a", "href"):
                self.links.append(value or "")
            elif (tag, name) in FETCHED and dict(attributes).get("rel") not in NOT_FETCHED:
                self.fetched.append(value or "")


def check(html: Path) -> Iterator[str]:
    """Yield each link that leads nowhere, and each thing that would have to be fetched from elsewhere."""
    pages = {
        path.resolve(): Page(path.read_text(encoding="utf-8"))
        for path in sorted(html.rglob("*.html"))
        if "_static" not in path.parts
    }
    for path, page in pages.items():
        name = path.relative_to(html.resolve()).as_posix()
        for target in {*page.links, *page.fetched}:
            url = urlsplit(target)
            if url.scheme == "data":
                continue
            if url.scheme or url.netloc:
                if target in page.fetched:
                    yield f"{name}: fetches {target}"
                continue
            goal = (path.parent / unquote(url.path)).resolve() if url.path else path
            if not goal.is_file():
                yield f"{name}: no file for {target}"
            elif url.fragment and goal in pages and unquote(url.fragment) not in pages[goal].places:
                yield f"{name}: no such place: {target}"

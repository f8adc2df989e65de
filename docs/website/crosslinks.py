"""Every name of the package and every number of a section, in a sentence or a table, leads to where it is explained.

A name leads to its entry in the interface, 49.6 to the notebook of the section, 49.6.2 to the exercise. Headings and
listings lead nowhere, nor does a page to itself.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms.post_transforms import SphinxPostTransform

from . import notebooks

NAME = re.compile(r"(?:(?P<ours>tw|twistwrench)\.)?(?P<name>[A-Za-z_][\w.]*)(?:\(.*\))?", re.DOTALL)
SECTION = re.compile(r"(?<![\d.\w-])49\.\d+(?:\.\d+)?(?![\d.]*\d)")
EXERCISES = "chapter/exercises"
KEPT = (nodes.reference, nodes.title, nodes.FixedTextElement, nodes.raw, nodes.math, nodes.caption)
KEPT += (addnodes.desc_signature, addnodes.toctree)

Place = tuple[str, str]
"""A page, and the place in it."""


def place_of(code: str, names: Mapping[str, Place], modules: Mapping[str, Place]) -> Place | None:
    """Return where a name, or a call of it, is explained; `model` alone is no folder, `tw.model` is."""
    found = NAME.fullmatch(code)
    if not found:
        return None
    return names.get(found["name"]) or (modules.get(found["name"]) if found["ours"] else None)


def chapter() -> dict[str, Place]:
    """Return the notebook of each section."""
    numbers = {name: re.match(r"49_(\d+)_", name) for name in notebooks.names()}
    return {f"49.{int(found[1])}": (f"chapter/{name}", "") for name, found in numbers.items() if found}


def cut(text: str, sections: Mapping[str, Place]) -> Iterator[tuple[str, Place | None]]:
    """Cut a text at the numbers of sections that lead somewhere."""
    at = 0
    for found in SECTION.finditer(text):
        if place := sections.get(found[0]):
            yield from ([(text[at : found.start()], None)] if found.start() > at else [])
            yield found[0], place
            at = found.end()
    if text[at:]:
        yield text[at:], None


class Crosslinks(SphinxPostTransform):
    """Make the links of a page."""

    default_priority = 910  # after the formulas and the units

    def run(self, **_: Any) -> None:
        """Go through the codes and the words of a page."""
        names, modules = self._names()
        sections = chapter() | self._exercises()
        is_interface = self.env.docname.startswith("api/")
        for code in [*self.document.findall(nodes.literal)]:
            place = None if is_interface else place_of(code.astext(), names, modules)
            if place and not _kept(code):
                code.replace_self(self._link(code.deepcopy(), place))
        for text in [*self.document.findall(nodes.Text)]:
            pieces = [*cut(text.astext(), sections)]
            if any(place for _, place in pieces) and not (_kept(text) or isinstance(text.parent, nodes.literal)):
                text.parent.replace(text, [self._link(nodes.Text(words), place) for words, place in pieces])

    def _link(self, shown: nodes.Node, place: Place | None) -> nodes.Node:
        if place is None or place[0] == self.env.docname:
            return shown
        page, at = place
        uri = self.app.builder.get_relative_uri(self.env.docname, page) + (f"#{at}" if at else "")
        return nodes.reference("", "", shown, refuri=uri, internal=True)

    def _names(self) -> tuple[dict[str, Place], dict[str, Place]]:
        """Return where the names of the package, and its folders and files, are explained."""
        found: tuple[dict[str, Place], dict[str, Place]] = {}, {}
        for name, entry in self.env.get_domain("py").objects.items():  # type: ignore[attr-defined]
            if name.startswith("twistwrench."):
                found[entry.objtype == "module"][name.removeprefix("twistwrench.")] = entry.docname, entry.node_id
        return found

    def _exercises(self) -> dict[str, Place]:
        """Return the place of each exercise, kept from page to page."""
        kept: dict[str, Place] | None = getattr(self.app, "exercise_places", None)
        if kept is None:
            found = self.env.get_doctree(EXERCISES).findall(nodes.section) if EXERCISES in self.env.found_docs else ()
            kept = {str(s[0].astext()).split()[0]: (EXERCISES, s["ids"][0]) for s in found}
            self.app.exercise_places = kept  # type: ignore[attr-defined]
        return {number: place for number, place in kept.items() if number.count(".") == 2}


def _kept(node: nodes.Node) -> bool:
    above: nodes.Node | None = node.parent
    while above:
        if isinstance(above, KEPT):
            return True
        above = above.parent
    return False


def connect(app: Any) -> None:
    """Do so in every page."""
    app.add_post_transform(Crosslinks)

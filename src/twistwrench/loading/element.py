"""An element of a URDF, and the errors that name its place."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import ModelError
from ..model import Entry
from .reading import XML
from .urdf_words import (
    ATTRIBUTES,
    BY_ATTRIBUTES,
    CHILDREN,
    home_of,
    ignored_attribute,
    ignored_child,
    meant,
)

__all__ = ["LEFT_OUT", "Element"]

LEFT_OUT = "not URDF, left out"
"""How a word of the format is read in a place where it means nothing."""

QUATERNION = "quat_xyzw"
"""An attribute of <origin> in a later version of the format."""

NO_LOSS = {"limit", "dynamics", "origin"}
"""Children that are reported, not rejected, in the wrong place."""


def all_zero(texts: Iterable[str]) -> bool:
    """Return whether attributes hold nothing but zeros."""
    return not any(word.strip("-+.0") for text in texts for word in text.split())


def says_nothing(element: XML) -> bool:
    """Return whether an element, and all that is in it, holds nothing but zeros."""
    return all_zero(text for x in element.iter("*") for text in (x.text or "", *x.attrib.values()))


def written(element: XML) -> str:
    """Return the tag as the file has it, with the name of the element where it has one."""
    tag, name = str(element.tag).rpartition("}")[2], element.get("name")
    prefix = f"{element.prefix}:" if element.prefix and ":" not in tag else ""
    return prefix + tag + (f" name={name!r}" if name else "")


@dataclass(frozen=True)
class Element:
    """An element whose numbers are read and checked here; `what` is the link or joint, for the messages.

    A misspelt attribute or child is an error from the start, and so is a child that belongs elsewhere. What has a
    single possible meaning, and a word where it has none, is added to `remarks`, a list that all elements share.
    """

    xml: XML
    path: Path
    what: str
    remarks: list[Entry]

    def __post_init__(self) -> None:
        tag = self.xml.tag
        if tag == "origin" and QUATERNION in self.xml.attrib:
            raise self.error(f"<origin {QUATERNION}=...> is not read; give the rotation as rpy")
        if tag not in CHILDREN and tag not in ATTRIBUTES:
            return
        for key in self.xml.attrib:
            if word := meant(key, ATTRIBUTES.get(tag, ())):
                raise self.error(f"unknown attribute {key!r} of <{tag}>; did you mean {word!r}?")
            if ignored_attribute(tag, key) and not all_zero([self.xml.get(key)]):
                self.remark(f"attribute {key!r} of <{tag}>", LEFT_OUT)
        if tag in BY_ATTRIBUTES and (self.xml.text or "").strip():
            self.remark(f"text in <{tag}>", LEFT_OUT)
        for child in self.xml.iterchildren("*"):
            if word := meant(child.tag, CHILDREN.get(tag, ())):
                raise self.error(f"unknown element <{child.tag}>; did you mean <{word}>?", child)
            if home := home_of(child.tag, tag):
                self._misplaced(child, home)
            elif child.tag not in CHILDREN.get(tag, ()) and ignored_child(tag, child) and not says_nothing(child):
                place = "" if tag == "robot" else f" in <{tag}>"
                self.remark(f"<{written(child)}>{place}", LEFT_OUT, line=child.sourceline)

    def _misplaced(self, child: XML, home: str) -> None:
        """Raise for a misplaced child that affects the dynamics; report a limit, friction or a link's own origin.

        An inertia outside all links is reported, too: no link has it, here as in every other loader.
        """
        if child.tag == "inertial" and self.xml.tag == "robot":
            self.remark("<inertial> outside all links", LEFT_OUT, line=child.sourceline)
            return
        if child.tag not in NO_LOSS:
            raise self.error(f"a <{child.tag}> stands in <{self.xml.tag}>, expected in <{home}>", child)
        if not all_zero(child.attrib.values()):
            self.remark(f"<{child.tag}> in <{self.xml.tag}>", LEFT_OUT)

    def error(self, text: str, child: XML = None) -> ModelError:
        """Return the error with this text of the link or joint, or of a child."""
        line = (self.xml if child is None else child).sourceline
        return ModelError(f"{self.path}, line {line}: {self.what}: {text}")

    @property
    def at(self) -> str:
        """File and line."""
        return f"{self.path}, line {self.xml.sourceline}"

    def remark(self, found: str, read_as: str, *, warns: bool = True, line: int | None = None) -> None:
        """Note the text of the file, and how it was interpreted; the line is the element's unless given."""
        self.remarks.append(Entry(self.what, found, read_as, line or self.xml.sourceline, warns))

    def get(self, key: str) -> str | None:
        """Return the text of an attribute."""
        text: str | None = self.xml.get(key)
        return text

    def only(self, tag: str) -> Element | None:
        """Return the child of this kind, or None; raise for two."""
        found: Iterator[XML] = iter(self.xml.findall(tag))
        first, second = next(found, None), next(found, None)
        if second is not None:
            raise ModelError(f"{self.path}, line {second.sourceline}: {self.what}: has two <{tag}>, expected one")
        return None if first is None else replace(self, xml=first)

    def numbers(self, key: str, default: tuple[float, ...], *, infinite: bool = False) -> tuple[float, ...]:
        """Read as many numbers as the default has; `default` is URDF's value where the attribute is missing."""
        text = self.get(key)
        if text is None:
            return default
        name, words = f"<{self.xml.tag} {key}={text!r}>", text.split()
        if len(words) != len(default):
            expected = f"{len(default)} number{'s' * (len(default) > 1)}"
            raise self.error(f"{name}: expected {expected}, got {len(words)}")
        values = []
        for word in words:
            try:
                values.append(float(word if word.isascii() and "_" not in word else "?"))  # float() accepts 1_000
            except ValueError:
                hint = "; expand the macros with xacro first" if "$" in word else ""
                raise self.error(f"{name}: {word!r} is not a number{hint}") from None
            if math.isnan(values[-1]) or (math.isinf(values[-1]) and not infinite):
                raise self.error(f"{name}: {word!r} is not a finite number")
        return tuple(values)

    def number(self, key: str, default: float = 0.0, *, infinite: bool = False) -> float:
        """Read one number."""
        return self.numbers(key, (default,), infinite=infinite)[0]

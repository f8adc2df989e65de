"""From a path to the XML of a robot and its elements, and the errors that name file, line and element.

A URDF is text from elsewhere: entities are not expanded, nothing is fetched, and XML that is not
well-formed is rejected. (yourdfpy would recover what it can and drop the rest.)
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..errors import ModelError
from ..model import Entry
from .urdf_words import (
    ATTRIBUTES,
    BY_ATTRIBUTES,
    CHILDREN,
    NOT_DYNAMICS,
    home_of,
    is_ignored_attribute,
    is_ignored_child,
    meant,
    words_of,
)

__all__ = ["LEFT_OUT", "XML", "Element", "read_document", "read_robot_xml", "spell_tag"]

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


def spell_tag(element: XML) -> str:
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
            if is_ignored_attribute(tag, key) and not all_zero([self.xml.get(key)]):
                self.remark(f"attribute {key!r} of <{tag}>", LEFT_OUT)
        if tag in BY_ATTRIBUTES and (self.xml.text or "").strip():
            self.remark(f"text in <{tag}>", LEFT_OUT)
        for child in self.xml.iterchildren("*"):
            if word := meant(child.tag, CHILDREN.get(tag, ())):
                raise self.error(f"unknown element <{child.tag}>; did you mean <{word}>?", child)
            if home := home_of(child.tag, tag):
                self._misplaced(child, home)
            elif child.tag not in CHILDREN.get(tag, ()) and is_ignored_child(tag, child) and not says_nothing(child):
                place = "" if tag == "robot" else f" in <{tag}>"
                self.remark(f"<{spell_tag(child)}>{place}", LEFT_OUT, line=child.sourceline)

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
        name, words = f"<{spell_tag(self.xml)} {key}={text!r}>", text.split()
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


XML = Any
"""An lxml element; lxml carries no types."""

DOCTYPE = "declares a document type (<!DOCTYPE ...>); a URDF has none, and entities are not expanded: remove it"
GIT_LFS = b"version https://git-lfs.github.com/spec/"
DECLARATION = re.compile(rb"(\xef\xbb\xbf|\s)*(<\?xml\s[^>]*\?>)")
ENCODING = re.compile(r"(?<=<\?xml)([^>]*?)\s+encoding\s*=\s*([\"'])[^\"'>]*\2")
"""Of a text, which has been decoded: what it declares no longer holds."""
VERSION = re.compile(rb"version\s*=\s*([\"'])([^\"']*)\1")
OTHER_FORMATS = {
    "sdf": "SDF; convert it to URDF first",
    "mujoco": "MJCF; twistwrench.bridge.from_mujoco_model(mujoco.MjModel.from_xml_path(file)) reads it",
    "COLLADA": "COLLADA; convert it to URDF first",
}


def read_robot_xml(path: Path) -> XML:
    """Read the ``<robot>`` element of a URDF or SRDF.

    Parameters
    ----------
    path : Path

    Returns
    -------
    lxml element
        Without namespace on the elements of the format itself.

    Raises
    ------
    ModelError
        If the file is missing, not a regular file, a Git LFS pointer, empty, not XML, cut short, nested too deep, not a
        robot, full of xacro macros, or declares a document type (and so entities).

    Examples
    --------
    >>> read_robot_xml(Path("nowhere.urdf"))
    Traceback (most recent call last):
    twistwrench.errors.ModelError: nowhere.urdf: no such file
    """
    return read_document(path)[0]


def read_document(path: Path, text: str | None = None) -> tuple[XML, list[Entry]]:
    """Read the ``<robot>`` element, as `read_robot_xml` does, and the violations of XML 1.0 in it.

    With `text` that is read, and `path` only names it.
    """
    data, remarks = _declared(
        _read(path) if text is None else ENCODING.sub(r"\1", text, count=1).encode(errors="xmlcharrefreplace")
    )
    root, undeclared = _parse(path, data)
    remarks += undeclared
    if root.getroottree().docinfo.doctype:
        raise ModelError(f"{path}: {DOCTYPE}")
    _drop_namespace(root)
    if root.tag != "robot":
        known = OTHER_FORMATS.get(str(root.tag))
        hint = f" (this looks like {known})" if known else ""
        raise ModelError(f"{path}: the root element is <{root.tag}>, expected <robot>{hint}")
    return root, remarks + _leftover_macros(path, root)


def _read(path: Path) -> bytes:
    """Return the content of a regular file that is not empty."""
    if "\0" in str(path):
        raise ModelError(f"{str(path)!r}: a path holds no null character")
    try:
        if path.is_dir():
            raise ModelError(f"{path}: is a directory, expected a .urdf file")
        if path.exists() and not path.is_file():
            raise ModelError(f"{path}: is not a regular file, expected a .urdf file")
        data = path.read_bytes()
    except FileNotFoundError:
        raise ModelError(f"{path}: no such file") from None
    except OSError as error:
        raise ModelError(f"{path}: cannot be read: {error.strerror}") from None
    if not data.strip():
        raise ModelError(f"{path}: the file is empty")
    if data.startswith(GIT_LFS):
        raise ModelError(f"{path}: is a Git LFS pointer, not the file itself; fetch that with: git lfs pull")
    return data


def _declared(data: bytes) -> tuple[bytes, list[Entry]]:
    """Repair the text before the first element; the lines keep their numbers."""
    found = DECLARATION.match(data)
    if found is None:
        return data, []
    before, declaration, remarks = data[: found.start(2)], found[2], []
    version = VERSION.search(declaration)
    if version and not version[2].startswith(b"1."):
        written = version[2].decode("latin-1")
        remarks.append(Entry("the file", f"XML version {written!r}", "XML 1.0", line=1 + before.count(b"\n")))
        declaration = declaration[: version.start(2)] + b"1.0" + declaration[version.end(2) :]
    blank = before.removeprefix(b"\xef\xbb\xbf")
    if blank:
        remarks.append(Entry("the file", "blanks before the XML declaration", "none", line=1))
    return declaration + blank.replace(b"\xef\xbb\xbf", b"") + data[found.end() :], remarks


def _parse(path: Path, data: bytes) -> tuple[XML, list[Entry]]:
    """Parse with nothing expanded, nothing fetched, and libxml2's limits on depth and growth kept."""
    from lxml import etree

    rules: dict[str, Any] = {"resolve_entities": False, "load_dtd": False, "no_network": True, "huge_tree": False}
    parser = etree.XMLParser(**rules)
    try:
        return etree.fromstring(data, parser), []
    except etree.XMLSyntaxError as error:
        undeclared = [(e.line, e.message) for e in parser.error_log if e.type_name == "NS_ERR_UNDEFINED_NAMESPACE"]
        if len(undeclared) == len(parser.error_log) > 0:  # nothing is lost; names are such as "drake:acceleration"
            prefixes = {message.split()[2]: line for line, message in undeclared[::-1]}
            remarks = [Entry("the file", f"prefix {x}: not declared", "not URDF", line) for x, line in prefixes.items()]
            return etree.fromstring(data, etree.XMLParser(recover=True, **rules)), remarks[::-1]
        line, column = error.position
        place = f"line {line}, column {column}"
        reason = (error.msg or "nothing could be parsed").removesuffix(f", {place}")
    if "entity amplification" in reason or "entity reference loop" in reason:
        raise ModelError(f"{path}, {place}: {DOCTYPE} ({reason})")
    if "encoding" in reason.lower():
        raise ModelError(f"{path}, {place}: not well-formed XML: {reason}; save the file as UTF-8")
    if "depth" in reason.lower():
        raise ModelError(f"{path}, {place}: elements are nested deeper than any robot's ({reason})")
    raise ModelError(f"{path}, {place}: not well-formed XML: {reason}")


def _drop_namespace(root: XML) -> None:
    """Read ``<robot xmlns="...">`` as ``<robot>``: the elements in the root's own namespace lose it."""
    space, brace, _ = str(root.tag).rpartition("}")
    for element in root.iter(f"{space}{brace}*") if brace else ():
        element.tag = element.tag.removeprefix(space + brace)


def _leftover_macros(path: Path, root: XML) -> list[Entry]:
    """Raise for xacro's elements where they could stand for a link, a joint or a number; ignore all others."""
    remarks = []
    for element in root.iter("*"):
        space, _, name = element.tag.rpartition("}" if "}" in element.tag else ":")
        if "xacro" not in space:
            continue
        inside = {str(ancestor.tag) for ancestor in element.iterancestors()}
        if not inside & NOT_DYNAMICS and not words_of(name) & NOT_DYNAMICS:
            raise ModelError(
                f"{path}, line {element.sourceline}: holds xacro macros; expand them first, "
                "for example with: xacro robot.urdf.xacro > robot.urdf"
            )
        remarks.append(Entry("the file", f"<xacro:{name}>, not expanded", "no dynamics", element.sourceline))
    return remarks

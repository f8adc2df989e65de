"""From a path to the XML of a robot, or to an error that names the fault of the file.

A URDF is text from elsewhere: entities are not expanded, nothing is fetched, and XML that is not
well-formed is rejected. (yourdfpy would recover what it can and drop the rest.)
Three slips are common, have one meaning each, and are read: an XML version that does not exist, blank lines
before the XML declaration, and a prefix such as ``drake:`` that nobody declared.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from ..errors import ModelError
from ..model import Entry
from .urdf_words import NOT_DYNAMICS, words_of

__all__ = ["XML", "read_document", "read_robot_xml"]

XML = Any
"""An lxml element; lxml carries no types."""

DOCTYPE = "declares a document type (<!DOCTYPE ...>); a URDF has none, and entities are not expanded: remove it"
GIT_LFS = b"version https://git-lfs.github.com/spec/"
DECLARATION = re.compile(rb"(\xef\xbb\xbf|\s)*(<\?xml\s[^>]*\?>)")
ENCODING = re.compile(r"(?<=<\?xml)([^>]*?)\s+encoding\s*=\s*([\"'])[^\"'>]*\2")
"""Of a text, which has been decoded: what it declares no longer holds."""
VERSION = re.compile(rb"version\s*=\s*([\"'])([^\"']*)\1")
OTHER_FORMATS = {"sdf": "SDF", "mujoco": "MJCF", "COLLADA": "COLLADA"}


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
        hint = f" (this looks like {known}; convert it to URDF first)" if known else ""
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

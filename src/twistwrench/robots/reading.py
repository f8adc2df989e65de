"""From a path to the XML of a robot, or to an error that says what is wrong with the file.

A URDF is text from elsewhere: entities are not expanded, nothing is fetched, and what is not
well-formed is refused. (yourdfpy, left alone, would recover what it can and drop the rest.)
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import ModelError

__all__ = ["XML", "read_robot_xml"]

XML = Any
"""An lxml element; lxml carries no types."""

DOCTYPE = "declares a document type (<!DOCTYPE ...>); a URDF has none, and entities are not expanded: remove it"
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
        A file that is missing, no file, empty, not XML, cut short, nested too deep, not a robot,
        full of xacro macros, or that declares a document type (the door to entities).

    Examples
    --------
    >>> read_robot_xml(Path("nowhere.urdf"))
    Traceback (most recent call last):
    twistwrench.errors.ModelError: nowhere.urdf: no such file
    """
    root = _parse(path, _read(path))
    if root.getroottree().docinfo.doctype:
        raise ModelError(f"{path}: {DOCTYPE}")
    _drop_namespace(root)
    if root.tag != "robot":
        known = OTHER_FORMATS.get(str(root.tag))
        hint = f" (this looks like {known}; convert it to URDF first)" if known else ""
        raise ModelError(f"{path}: the root element is <{root.tag}>, expected <robot>{hint}")
    _refuse_macros(path, root)
    return root


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
    return data


def _parse(path: Path, data: bytes) -> XML:
    """Parse with nothing expanded, nothing fetched, and libxml2's limits on depth and growth kept."""
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, load_dtd=False, no_network=True, huge_tree=False, recover=False)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        line, column = error.position
        place = f"line {line}, column {column}"
        reason = (error.msg or "nothing could be parsed").removesuffix(f", {place}")
    if "entity amplification" in reason or "entity reference loop" in reason:
        raise ModelError(f"{path}, {place}: {DOCTYPE} ({reason})")
    if "depth" in reason.lower():
        raise ModelError(f"{path}, {place}: elements are nested deeper than any robot's ({reason})")
    raise ModelError(f"{path}, {place}: not well-formed XML: {reason}")


def _drop_namespace(root: XML) -> None:
    """Read ``<robot xmlns="...">`` as ``<robot>``: the elements in the root's own namespace lose it."""
    space, brace, _ = str(root.tag).rpartition("}")
    for element in root.iter(f"{space}{brace}*") if brace else ():
        element.tag = element.tag.removeprefix(space + brace)


def _refuse_macros(path: Path, root: XML) -> None:
    for element in root.iter("{*}*"):
        if element.tag.startswith("{") and "xacro" in element.tag:
            raise ModelError(
                f"{path}, line {element.sourceline}: holds xacro macros; expand them first, "
                "for example with: xacro robot.urdf.xacro > robot.urdf"
            )

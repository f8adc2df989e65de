"""The visual meshes of a URDF's links, read by yourdfpy and trimesh."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass
from functools import cache
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from ..loading.catalogue import PREFIX, find, is_known
from ..loading.element import read_robot_xml
from ..model import Model
from ..spatial import SE3
from .meshes import Unseen, find_mesh, read_mesh

__all__ = ["Shape", "shapes"]

GREY = (160, 165, 170, 255)
"""The colour of a mesh without one."""


@dataclass(frozen=True)
class Shape:
    """A piece of a body.

    Attributes
    ----------
    body : int
    placement : SE3
        In the body's frame.
    mesh : trimesh.Trimesh
    """

    body: int
    placement: SE3
    mesh: Any


def shapes(model: Model, source: str | PathLike[str] | None) -> list[Shape]:
    """Return the shapes of a model's bodies; an empty list where no meshes are available.

    Parameters
    ----------
    model : Model
    source : str, path or None
        The URDF or the robot of the catalogue that has them. Our own robots come without meshes: theirs are
        those of the robot of the same name in example-robot-data, if its links are the same.

    Returns
    -------
    list of Shape

    Warns
    -----
    UserWarning
        If a mesh that the URDF names cannot be shown; names link, file and reason.
    """
    path = _urdf(source)
    if path is None:
        return []
    _import_yourdfpy()  # report what is missing even where nothing would be read
    visuals = _visuals(path)
    frames = {link: f"link:{link}" if f"link:{link}" in model.frames else link for link, _ in visuals}
    if not set(frames.values()) <= set(model.frames):
        return []  # other links than the model's
    found, unseen, read = [], [], cache(read_mesh)  # four legs share one file
    for link, visual in visuals:
        frame = model.frames[frames[link]]
        try:
            placement, mesh = _shape(visual, path, read)
        except Unseen as reason:
            unseen.append(f"{link} ({reason})")
        else:
            found.append(Shape(frame.body, frame.placement @ placement, mesh))
    if unseen:
        links = ", ".join(dict.fromkeys(unseen))
        warnings.warn(f"{path}: these links are not shown, or not all of them: {links}", UserWarning, stacklevel=2)
    return found


def _urdf(source: str | PathLike[str] | None) -> Path | None:
    """Return the file that names the meshes."""
    if source is None:
        return None
    name = str(source)
    if not is_known(name):
        return Path(source)
    robot = find(name)
    if robot.source == "models":
        if not is_known(PREFIX + name):
            return None
        robot = find(PREFIX + name)
    try:
        return robot.path
    except ValueError:  # example-robot-data is not installed: no meshes
        return None


def _import_yourdfpy() -> Any:
    """Import yourdfpy, or raise an error with the command that installs it."""
    try:
        import yourdfpy
    except ModuleNotFoundError:
        raise ModuleNotFoundError(
            'meshes need yourdfpy, which is not installed: pip install "twistwrench[view]"; meshes=False draws sticks'
        ) from None
    return yourdfpy


def _visuals(path: Path) -> list[tuple[str, Any]]:
    """Return the visuals of each link, with the link's name; a file that is not proper XML was rejected before."""
    robot = read_robot_xml(path)
    return [(link.get("name"), visual) for link in robot.iterfind("link") for visual in link.iterfind("visual")]


def _parse(visual: Any) -> Any:
    """Read one visual element, with the material that the robot gives its name; each alone, as one may be broken."""
    from lxml import etree

    alone = etree.Element("robot", name="alone")
    alone.extend(deepcopy(m) for m in visual.getroottree().getroot().iterfind("material"))
    etree.SubElement(alone, "link", name="link").append(deepcopy(visual))
    try:
        text = BytesIO(etree.tostring(alone))
        robot = _import_yourdfpy().URDF.load(text, build_scene_graph=False, load_meshes=False).robot
        (parsed,) = robot.links[0].visuals
    except Exception as error:  # whatever stands there
        raise Unseen(f"its <visual> in line {visual.sourceline} cannot be read: {error}") from None
    if parsed.material is not None and parsed.material.color is None:
        named = [m for m in robot.materials if m.name == parsed.material.name]
        parsed.material = named[0] if named else None
    return parsed


def _shape(element: Any, urdf: Path, read: Callable[[Path], Any]) -> tuple[SE3, Any]:
    """Return where a visual is on its link, and its mesh with its colours."""
    visual = _parse(element)
    try:
        placement = SE3.identity() if visual.origin is None else SE3.from_matrix(visual.origin)
        mesh = _mesh(visual.geometry, urdf, read)
        if not (len(mesh.faces) and np.isfinite(mesh.vertices).all()):
            raise Unseen("its shape has no surface")
        _paint(mesh, visual.material)
    except (AttributeError, TypeError, ValueError) as error:
        raise Unseen(f"its <visual> in line {element.sourceline} cannot be drawn: {error}") from None
    return placement, mesh


def _mesh(geometry: Any, urdf: Path, read: Callable[[Path], Any]) -> Any:
    """Return a geometry as one mesh."""
    import trimesh

    if geometry.box is not None:
        return trimesh.creation.box(geometry.box.size)
    if geometry.cylinder is not None:
        return trimesh.creation.cylinder(geometry.cylinder.radius, geometry.cylinder.length)
    if geometry.sphere is not None:
        return trimesh.creation.icosphere(radius=geometry.sphere.radius)
    if geometry.mesh is None or not geometry.mesh.filename:
        raise Unseen("it has no geometry")
    mesh = read(find_mesh(geometry.mesh.filename, urdf)).copy()
    if geometry.mesh.scale is not None:
        mesh.apply_scale(geometry.mesh.scale)
    return mesh


def _paint(mesh: Any, material: Any) -> None:
    """Give a mesh without colours the one of the URDF."""
    if mesh.visual.defined:
        return
    rgba = None if material is None or material.color is None else material.color.rgba
    mesh.visual.face_colors = GREY if rgba is None else [int(255 * part) for part in rgba]

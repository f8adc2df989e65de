"""The meshes of a URDF: what the links look like, read by yourdfpy and trimesh."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from ..model import Model
from ..plucker import SE3
from ..robots.catalogue import PREFIX, find, known
from ..robots.reading import read_robot_xml

__all__ = ["Shape", "shapes"]

GREY = (160, 165, 170, 255)
"""Of what has no colour of its own."""


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
    """Return the shapes of a model's bodies, none where there are none to be had.

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
        Where a file that the URDF names is missing.
    """
    path = _urdf(source)
    if path is None:
        return []
    looks = [link for link in _links(path) if link.visuals]
    frames = {link.name: f"link:{link.name}" if f"link:{link.name}" in model.frames else link.name for link in looks}
    if not set(frames.values()) <= set(model.frames):
        return []  # other links than the model's
    found, missing, read = [], [], cache(_read)  # four legs have one file
    for link in looks:
        frame = model.frames[frames[link.name]]
        for visual in link.visuals:
            mesh = _mesh(visual.geometry, path, read)
            if mesh is None:
                missing.append(link.name)
                continue
            _paint(mesh, visual.material)
            origin = SE3.identity() if visual.origin is None else SE3.from_matrix(visual.origin)
            found.append(Shape(frame.body, frame.placement @ origin, mesh))
    if missing:
        names = ", ".join(dict.fromkeys(missing))
        warnings.warn(f"{path}: the mesh files of these links are missing: {names}", UserWarning, stacklevel=2)
    return found


def _urdf(source: str | PathLike[str] | None) -> Path | None:
    """Return the file that names the meshes."""
    if source is None:
        return None
    name = str(source)
    if not known(name):
        return Path(source)
    robot = find(name)
    if robot.source == "models":
        if not known(PREFIX + name):
            return None
        robot = find(PREFIX + name)
    try:
        return robot.path
    except ValueError:  # example-robot-data is not installed: no meshes, and none are asked for
        return None


def _links(path: Path) -> list[Any]:
    """Read the links, without their meshes; what is no proper XML is refused before."""
    from lxml import etree

    try:
        import yourdfpy
    except ModuleNotFoundError:
        raise ModuleNotFoundError(
            'meshes need yourdfpy, which is not installed: pip install "twistwrench[view]"; meshes=False draws sticks'
        ) from None

    text = BytesIO(etree.tostring(read_robot_xml(path)))
    return list(yourdfpy.URDF.load(text, build_scene_graph=False, load_meshes=False).robot.links)


def _mesh(geometry: Any, urdf: Path, read: Callable[[Path], Any]) -> Any:
    """Return a geometry as one mesh; None where its file is missing."""
    import trimesh

    if geometry.box is not None:
        return trimesh.creation.box(geometry.box.size)
    if geometry.cylinder is not None:
        return trimesh.creation.cylinder(geometry.cylinder.radius, geometry.cylinder.length)
    if geometry.sphere is not None:
        return trimesh.creation.icosphere(radius=geometry.sphere.radius)
    file = _file(geometry.mesh.filename, urdf)
    if file is None:
        return None
    mesh = read(file).copy()
    if geometry.mesh.scale is not None:
        mesh.apply_scale(geometry.mesh.scale)
    return mesh


def _read(file: Path) -> Any:
    """Read a file as one mesh, with colours at its corners in place of a picture, which may weigh 20 MB."""
    import trimesh

    scene = trimesh.load_scene(file)
    for part in scene.geometry.values():
        if part.visual.kind == "texture":
            paint, uv = part.visual.material, part.visual.uv
            found = None if uv is None else paint.to_color(uv)  # None without a picture
            colours = np.asarray(paint.main_color if found is None else found)
            colours = np.broadcast_to(colours, (len(part.vertices), 4))
            part.visual = trimesh.visual.ColorVisuals(part, vertex_colors=colours)
    return scene.to_mesh()


def _file(name: str, urdf: Path) -> Path | None:
    """Return where a mesh is: beside the URDF, or for ``package://`` in or below one of the folders around it."""
    scheme, colon, rest = name.partition("://")
    if colon and scheme not in ("package", "file"):
        return None  # nothing is fetched
    inside = Path(rest if colon else name)
    around = urdf.resolve().parents
    tried = [urdf.parent / inside] if scheme != "package" else []
    if scheme == "package":
        tried = [folder / tail for folder in around for tail in (inside, Path(*inside.parts[1:]))]
    return next((file for file in tried if file.is_file()), None)


def _paint(mesh: Any, material: Any) -> None:
    """Give a mesh without colours the one of the URDF."""
    if mesh.visual.defined:
        return
    rgba = None if material is None or material.color is None else material.color.rgba
    mesh.visual.face_colors = GREY if rgba is None else [int(255 * part) for part in rgba]

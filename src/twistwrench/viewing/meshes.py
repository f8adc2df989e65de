"""The mesh files that a URDF names: where they are, and what is in them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

__all__ = ["Unseen", "find_mesh", "read_mesh"]

POINTER = b"version https://git-lfs"
"""The first bytes of a Git LFS pointer, which stands in place of a file that was not downloaded."""


class Unseen(Exception):
    """Something cannot be shown; the message gives the reason."""


def find_mesh(name: str, urdf: Path) -> Path:
    """Return where a mesh is: beside the URDF, or for ``package://`` in or below one of the folders around it.

    Raises
    ------
    Unseen
        If it is not there; nothing is fetched.
    """
    scheme, colon, rest = name.partition("://")
    inside = Path(rest if colon else name)
    around = urdf.resolve().parents
    tried = [urdf.parent / inside] if not colon or scheme == "file" else []
    if scheme == "package":
        tried = [folder / tail for folder in around for tail in (inside, Path(*inside.parts[1:]))]
    for file in tried:
        try:
            if file.is_file():
                return file
        except OSError:  # a name that is too long
            break
    raise Unseen(f"{name}: the file is missing")


def read_mesh(file: Path) -> Any:
    """Read a file as one mesh, with colours at its corners in place of a picture, which may weigh 20 MB.

    Raises
    ------
    Unseen
        If it contains no mesh.
    """
    import trimesh

    try:
        with file.open("rb") as opened:
            start = opened.read(len(POINTER))
        if start == POINTER:
            raise Unseen(f"{file}: this is a pointer of Git LFS, not the mesh; `git lfs pull` downloads it")
        scene = trimesh.load_scene(file)
        for part in scene.geometry.values():
            _colour_corners(part)
        mesh = scene.to_mesh()
    except Unseen:
        raise
    except Exception as error:  # trimesh and its readers raise errors of any type
        raise Unseen(f"{file}: it cannot be read as a mesh: {str(error).strip().partition(chr(10))[0]}") from None
    if not len(mesh.faces):
        raise Unseen(f"{file}: there is no mesh in it")
    return mesh


def _colour_corners(part: Any) -> None:
    """Put the colours of a picture on the corners."""
    import trimesh

    if part.visual.kind == "texture":
        paint, uv = part.visual.material, part.visual.uv
        found = None if uv is None else paint.to_color(uv)  # None without a picture
        colours = np.asarray(paint.main_color if found is None else found)
        colours = np.broadcast_to(colours, (len(part.vertices), 4))
        part.visual = trimesh.visual.ColorVisuals(part, vertex_colors=colours)

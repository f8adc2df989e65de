"""The browser's scene, by viser: each part is added once, and moved to a configuration."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

import numpy as np

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import forward_kinematics, frame_placement
from ..arrays import Array
from ..plot.robot import sticks
from ..plot.stance import hull
from ..plot.style import COLOURS, XYZ
from ..spatial import SE3, rotation_to_quaternion
from .figure import MAX_FORCE_EXTENTS
from .shapes import Shape
from .state import Subject

__all__ = ["Mover", "build"]

Mover = Callable[[Subject], None]
"""Moves a part to a configuration."""


def build(scene: Any, seen: Subject, shapes: list[Shape], frames: Collection[str] | None) -> Mover:
    """Add a robot to the scene, in its first configuration.

    Parameters
    ----------
    scene : viser.SceneApi
    seen : Subject
    shapes : list of Shape
        Sticks are drawn for an empty list.
    frames : collection of str, optional
        Those that are drawn, with their names; small ones on every body unless given.

    Returns
    -------
    Mover
        Takes the same robot in one configuration, and shows that.
    """
    first = seen.at(0)
    _floor(scene, first)
    drawn = _bodies(scene, shapes) if shapes else _sticks(scene, first)
    parts = [drawn, _frames(scene, first, frames)]
    if first.model.mass > 0:
        parts.append(_mass(scene, first))
    if first.contacts:
        parts.append(_support(scene, first))
    if largest := _largest_force(seen):
        parts.append(_forces(scene, first, largest))

    def move(seen: Subject) -> None:
        for part in parts:
            part(seen)

    move(first)
    return move


def _largest_force(seen: Subject) -> float:
    """Return the largest of all forces, N, which scales the arrows; 0 without any. Those of a motion must be given."""
    if seen.given is None:
        forces = None if seen.t is not None else seen.forces()
        vectors = np.zeros((0, 3)) if forces is None else forces.vectors
    else:
        vectors = seen.given
    return float(np.linalg.norm(vectors, axis=-1).max(initial=0))


def _floor(scene: Any, seen: Subject) -> None:
    extent = seen.box()[1]
    lowest = min(0.0, float(sticks(seen.model, seen.q)[..., 2].min(initial=0)))
    cell = 0.1 if extent < 2 else 1.0
    scene.set_up_direction("+z")
    scene.add_grid("/floor", 8 * extent, 8 * extent, cell_size=cell, section_size=1.0, position=(0.0, 0.0, lowest))


def _bodies(scene: Any, shapes: list[Shape]) -> Mover:
    """Add a node for each body, with its meshes below it."""
    nodes = {shape.body: scene.add_frame(f"/bodies/{shape.body}", show_axes=False) for shape in shapes}
    for k, shape in enumerate(shapes):
        scene.add_mesh_trimesh(
            f"/bodies/{shape.body}/{k}", shape.mesh, wxyz=_wxyz(shape.placement), position=shape.placement.translation
        )

    def move(seen: Subject) -> None:
        T = forward_kinematics(seen.model, seen.q).placement
        for body, node in nodes.items():
            node.wxyz, node.position = _wxyz(T[body]), T[body].translation

    return move


def _sticks(scene: Any, seen: Subject) -> Mover:
    """Add rods from joint to joint, and a ball at each."""
    import trimesh

    radius = 0.015 * seen.box()[1]
    n = len(sticks(seen.model, seen.q))
    rod = trimesh.creation.cylinder(1.0, 1.0)
    ball = trimesh.creation.icosphere(2)
    at = np.zeros((n, 3))
    turned = np.tile([1.0, 0, 0, 0], (n, 1))
    rods = scene.add_batched_meshes_simple(
        "/rods",
        rod.vertices,
        rod.faces,
        turned,
        at,
        batched_scales=np.ones((n, 3)),
        batched_colors=_rgb("grey"),
        lod="off",
    )
    balls = scene.add_batched_meshes_simple(
        "/joints",
        ball.vertices,
        ball.faces,
        turned,
        at,
        batched_scales=np.full(n, 1.5 * radius),
        batched_colors=(60, 60, 60),
        lod="off",
    )

    def move(seen: Subject) -> None:
        lines = sticks(seen.model, seen.q)
        along = lines[:, 1] - lines[:, 0]
        length = np.linalg.norm(along, axis=-1)
        rods.batched_wxyzs, rods.batched_positions = _turn_z_to(along), lines.mean(axis=1)
        rods.batched_scales = np.stack([np.full(n, radius), np.full(n, radius), length], axis=-1)
        balls.batched_positions = lines[:, 0]

    return move


def _frames(scene: Any, seen: Subject, names: Collection[str] | None) -> Mover:
    """Add arrows along x, y, z of each frame, in the colours of the figures."""
    size = (0.08 if names is None else 0.15) * seen.box()[1]

    def arrows(seen: Subject) -> Array:
        T = forward_kinematics(seen.model, seen.q).placement[1:]
        shown = T if names is None else [frame_placement(seen.model, seen.q, name) for name in names]
        origin = np.array([place.translation for place in shown]).reshape(-1, 1, 3)
        axes = np.array([place.rotation.mT for place in shown]).reshape(-1, 3, 3)  # row k is axis k
        return np.stack([origin + 0 * axes, origin + size * axes], axis=-2).reshape(-1, 2, 3)

    points = arrows(seen)
    colours = np.tile([_linear(colour) for colour in XYZ], (len(points) // 3, 1))
    node = scene.add_arrows("/frames", points, colours, **_thin(size))
    labels = [scene.add_label(f"/names/{k}", name) for k, name in enumerate(names or ())]

    def move(seen: Subject) -> None:
        node.points = arrows(seen).astype(np.float32)
        for label, origin in zip(labels, node.points[::3, 0]):
            label.position = origin

    return move


def _mass(scene: Any, seen: Subject) -> Mover:
    """Add a ball at the centre of mass; its label is seen through the bodies."""
    ball = scene.add_icosphere("/centre_of_mass", 0.03 * seen.box()[1], color=_rgb("purple"))
    label = scene.add_label("/names/centre_of_mass", "centre of mass")

    def move(seen: Subject) -> None:
        ball.position = label.position = center_of_mass(seen.model, seen.q)

    return move


def _support(scene: Any, seen: Subject) -> Mover:
    """Add the polygon between the points on the ground, as a fan around a corner, and the plumb line onto it."""
    n, above = sum(len(c.points) for c in seen.contacts), 0.005 * seen.box()[1]  # in the floor it would flicker
    fan = np.array([(0, k, k + 1) for k in range(1, n - 1)], dtype=np.uint32).reshape(-1, 3)
    look: dict[str, Any] = {"color": _rgb("sky"), "opacity": 0.5, "side": "double", "cast_shadow": False}
    plate = scene.add_mesh_simple("/support", np.zeros((n, 3), np.float32), fan, **look)
    edges = scene.add_line_segments("/support/edges", np.zeros((n, 2, 3)), _rgb("blue"), thickness=above)
    plumb = scene.add_line_segments("/plumb", np.zeros((1, 2, 3)), _rgb("purple"), thickness=above)

    def move(seen: Subject) -> None:
        corners = seen.support()
        plate.visible = len(corners) > 0
        plumb.visible = plate.visible and seen.model.mass > 0
        if len(corners) > 0:
            corners = hull(corners)
            if plumb.visible:
                c = center_of_mass(seen.model, seen.q)
                floor = corners[:, 2].mean()
                plumb.points = np.array([[c, [c[0], c[1], floor]]], np.float32)
            corners[:, 2] += above
            corners = corners[np.minimum(np.arange(n), len(corners) - 1)]  # as many as there may be at most
            plate.vertices = corners.astype(np.float32)
            edges.points = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1).astype(np.float32)

    return move


def _forces(scene: Any, seen: Subject, largest: float) -> Mover:
    """Add an arrow at each contact, with its size."""
    k = len(seen.contacts)
    extent = seen.box()[1]
    node = scene.add_arrows("/forces", np.zeros((k, 2, 3)), _rgb("black"), **_thin(0.15 * extent))
    labels = [scene.add_label(f"/forces/{k}", "") for k in range(k)]

    def move(seen: Subject) -> None:
        forces = seen.forces()
        node.visible = forces is not None
        if forces is None:
            return
        tips = forces.at + MAX_FORCE_EXTENTS * extent / largest * forces.vectors
        node.points = np.stack([forces.at, tips], axis=1).astype(np.float32)
        for label, text, tip in zip(labels, seen.texts(forces), tips):
            label.text, label.position, label.visible = text, tip, bool(text)

    return move


def _wxyz(T: SE3) -> Array:
    """Return a placement's quaternion, scalar first."""
    return np.roll(rotation_to_quaternion(T.rotation), 1)


def _turn_z_to(along: Array) -> Array:
    """Return quaternions, scalar first, that turn z into directions: 1 + z·d and z × d, normalised."""
    d = along / np.maximum(np.linalg.norm(along, axis=-1, keepdims=True), 1e-12)
    wxyz = np.stack([1 + d[:, 2], -d[:, 1], d[:, 0], 0 * d[:, 2]], axis=-1)
    wxyz[wxyz[:, 0] < 1e-9] = [0, 1, 0, 0]  # straight down: half a turn about x
    return np.asarray(wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True))


def _thin(length: float) -> dict[str, float]:
    return {"shaft_radius": 0.05 * length, "head_radius": 0.12 * length, "head_length": 0.25 * length}


def _rgb(name: str) -> tuple[int, int, int]:
    return _hex(COLOURS[name])


def _hex(colour: str) -> tuple[int, int, int]:
    red, green, blue = bytes.fromhex(colour.removeprefix("#"))
    return red, green, blue


def _linear(colour: str) -> Array:
    """Return a colour in linear light, as batched meshes need it, from the usual sRGB."""
    return np.asarray((255 * (np.array(_hex(colour)) / 255) ** 2.2).round(), np.uint8)

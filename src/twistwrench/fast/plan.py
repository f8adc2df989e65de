"""The plan: everything that can be computed from a model before the first state."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Array
from ..model import Joint, Model
from .dofs import Dof, Index, Level, Step, base_floats, index, levels_of, links_of, parents_of, steps_of

__all__ = ["Placed", "Plan", "plan_of"]


class Placed(NamedTuple):
    """The first link of a joint whose `transform` places it.

    Attributes
    ----------
    link : int
        Its place in its level.
    joint : Joint
    q : slice
        The joint's entries.
    axes : ndarray, shape (3, 3)
        As `Dof.axes`.
    """

    link: int
    joint: Joint
    q: slice
    axes: Array


@dataclass(frozen=True, eq=False)
class Plan:
    """Constants of a model in one number type, link by link; 1 + n links, the first of which is the base.

    Attributes
    ----------
    floats : bool
        Whether link 0 is a body that floats, with the first six entries of v; else it is the world.
    n, nq, nv : int
        Number of links without the base, of entries of q, and of degrees of freedom.
    units : list of slice
        The entries of q that have norm 1.
    parent : list of int
        Of each link; 0 also for the base.
    levels : list of Level
        From the base to the tips.
    steps : list of Step
        From each link to the base.
    fixed : ndarray, shape (n, 4, 3)
        The axes x, y, z of each link before it turns and the offset of its origin, in the axes of its parent.
    entry : ndarray of int, shape (1 + n,)
        The entry of each link in v; -1 for the base.
    apart : (ndarray, ndarray) of int
        The entries of M that are always zero, of links none of which carries the other.
    turn : ndarray, shape (1 + n, 1), or None
        How much a link turns about its z axis for a unit rate; None where all do by 1.
    slide : ndarray, shape (3, 1 + n, 1), or None
        How much a link slides for a unit rate, in its own axes; None where none does.
    last, before : slice or ndarray
        For each link the last one of its joint, and the one that carries the joint.
    angles, circles, lengths : (slice or ndarray, ndarray of int)
        Links without the base, and the entry of q that holds the angle; its cosine, with the sine next; and the
        distance along its z axis, times its `slide`.
    placed : list of list of Placed
        Level by level, what a joint's `transform` places.
    inertia : ndarray, shape (1 + n, 4, 3)
        Of each link in its axes about its origin: the rows of the inertia, then mass times centre of mass.
    mass, carried : ndarray, shape (1 + n, 1)
        Of each link; of the link and of all that it carries.
    first, second : ndarray, shape (1 + n,)
        Bounds of each link's own moments of mass: the length of the first, the trace of the inertia.
    bodies : list of (int, int, ndarray)
        Dof, body and the body's axes in those of the link, as columns.
    rotor : ndarray, shape (nv, 1)
        `Model.armature`.
    gravity : ndarray, shape (3, 1)
        In the world.
    under : ndarray, shape (3, 3)
        The axes from which a floating base turns, as columns in those of the world.
    reach : ndarray, shape (1 + n,), or None
        How far the links are from their parents; None where that depends on the state.
    kept : dict
        A cache for other functions.
    """

    floats: bool
    n: int
    nq: int
    nv: int
    units: list[slice]
    parent: list[int]
    levels: list[Level]
    steps: list[Step]
    fixed: Array
    entry: Array
    apart: tuple[Array, Array]
    turn: Array | None
    slide: Array | None
    last: Index
    before: Index
    angles: tuple[Index, Array]
    circles: tuple[Index, Array]
    lengths: tuple[Index, Array]
    placed: list[list[Placed]]
    inertia: Array
    mass: Array
    carried: Array
    first: Array
    second: Array
    bodies: list[tuple[int, int, Array]]
    rotor: Array
    gravity: Array
    under: Array
    reach: Array | None
    kept: dict[str, Any] = field(default_factory=dict)

    def support(self, link: int) -> list[int]:
        """Return the links from `link` towards the base, without the base."""
        path = []
        while link > 0:
            path.append(link)
            link = self.parent[link]
        return path


def plan_of(model: Model, dtype: np.dtype[Any]) -> Plan:
    """Return the plan of a model for a real number type; made once, forgotten with the model."""
    made: dict[Any, Any] = model._constants  # the model's cache of one entry per number type
    key = ("fast", dtype)
    if key not in made:
        made[key] = _make(model, dtype)
    plan: Plan = made[key]
    return plan


def _make(model: Model, dtype: np.dtype[Any]) -> Plan:
    links, floats = links_of(model), base_floats(model)
    levels = levels_of(links)
    spread, mass = _inertias(model, links)
    carried = mass.copy()
    for level in reversed(levels):
        for parents, children in level.inward:
            carried[parents] += carried[level.here][children]
    turn = np.array([[1], *([link.turn] for link in links)], np.longdouble)
    slide = np.array([np.zeros(3), *(link.slide for link in links)], np.longdouble)
    ends = {link.joint: link.number for link in links if link.last}
    fixed = _fixed(model, links).astype(dtype)
    rigid = all(link.way != "transform" and not link.slide.any() for link in links)
    starts = {link.joint: link.parent.number if link.parent else 0 for link in links if link.first}
    return Plan(
        floats=floats,
        n=len(links),
        nq=model.nq,
        nv=model.nv,
        units=_units(model),
        parent=parents_of(links),
        levels=levels,
        steps=steps_of(links, levels),
        fixed=fixed,
        entry=np.array([-1, *(link.entry for link in links)], np.intp),
        apart=_apart(links),
        turn=None if (turn == 1).all() else turn.astype(dtype),
        slide=slide.astype(dtype).mT[..., None] if slide.any() else None,
        last=index([ends[link.joint] for link in links]),
        before=index([starts[link.joint] for link in links]),
        angles=_moved(model, [link for link in links if link.way == "coordinate" and link.turn]),
        circles=_moved(model, [link for link in links if link.way == "circle"]),
        lengths=_moved(model, [link for link in links if link.way == "coordinate" and link.slide.any()]),
        placed=[_placed(model, links[level.here.start - 1 : level.here.stop - 1], dtype) for level in levels],
        inertia=spread.astype(dtype),
        mass=mass.astype(dtype),
        carried=carried.astype(dtype),
        first=np.sqrt((spread[:, 3] ** 2).sum(axis=-1)).astype(dtype),
        second=spread[:, range(3), range(3)].sum(axis=-1).astype(dtype),
        bodies=[*([(0, 1, np.eye(3, dtype=dtype))] if floats else []), *_bodies(links, dtype)],
        rotor=model.armature.astype(dtype)[:, None],
        gravity=model.gravity.astype(dtype)[:, None],
        under=model.constants(np.longdouble).placement[1 if floats else 0].rotation.astype(dtype),
        reach=np.append(0, np.sqrt((fixed[:, 3] ** 2).sum(axis=-1))).astype(dtype) if rigid else None,
    )


def _units(model: Model) -> list[slice]:
    return [
        slice(q.start + joint.unit.start, q.start + joint.unit.stop)
        for joint, q in zip(model.joints, model.q_slice)
        if joint is not None and joint.unit is not None
    ]


def _apart(links: list[Dof]) -> tuple[Array, Array]:
    """Return rows and columns of M where neither link carries the other."""
    related = np.eye(1 + len(links), dtype=bool)
    for link in links:
        if link.parent is not None:
            related[link.number] |= related[link.parent.number]
    rows, columns = np.nonzero(~(related | related.mT)[1:, 1:])
    entry = np.array([link.entry for link in links], np.intp)
    return entry[rows], entry[columns]


def _bodies(links: list[Dof], dtype: np.dtype[Any]) -> list[tuple[int, int, Array]]:
    return [(link.number, link.joint, link.axes.mT.astype(dtype)) for link in links if link.last]


def _inertias(model: Model, links: list[Dof]) -> tuple[Array, Array]:
    """Return inertia and first moment of each link, in its axes about its origin, and its mass."""
    spread, mass = np.zeros((1 + len(links), 4, 3), np.longdouble), np.zeros((1 + len(links), 1), np.longdouble)
    carriers = [(link.number, link.joint, link.axes) for link in links if link.last]
    if base_floats(model):
        carriers.insert(0, (0, 1, np.eye(3, dtype=np.longdouble)))
    for number, body, axes in carriers:
        given = model.inertia[body]
        mass[number] = given.mass
        com = axes.mT @ given.com.astype(np.longdouble)
        about_com = axes.mT @ given.inertia_at_com.astype(np.longdouble) @ axes
        spread[number, :3] = about_com + given.mass * ((com * com).sum() * np.eye(3) - np.outer(com, com))
        spread[number, 3] = given.mass * com
    return spread, mass


def _fixed(model: Model, links: list[Dof]) -> Array:
    """Return where each link is in its parent's axes before it moves: the axes as rows, then the offset."""
    constants = model.constants(np.longdouble)
    rows = np.zeros((len(links), 4, 3), np.longdouble)
    for row, link in zip(rows, links):
        carrier = np.eye(3, dtype=np.longdouble) if link.parent is None else link.parent.axes
        if not link.first:
            row[:3] = (carrier.mT @ link.axes).mT
            continue
        base = constants.placement[link.joint]
        axes = base.rotation if link.way == "transform" else base.rotation @ link.axes
        row[:3], row[3] = (carrier.mT @ axes).mT, carrier.mT @ base.translation
    if not base_floats(model) and links:
        roots = [i for i, link in enumerate(links) if link.parent is None]
        rows[roots, 3] -= rows[0, 3]  # nothing depends on where the base is, but digits do
    return rows


def _placed(model: Model, links: list[Dof], dtype: np.dtype[Any]) -> list[Placed]:
    """Return what is placed by its joint's `transform` in a level, by its place in the level."""
    return [
        Placed(k, joint, model.q_slice[link.joint], link.axes.astype(dtype))
        for k, link in enumerate(links)
        if link.first and link.way == "transform" and (joint := model.joints[link.joint]) is not None
    ]


def _moved(model: Model, links: list[Dof]) -> tuple[Index, Array]:
    """Return the places of links among those without the base, and where their q begins."""
    starts = [model.q_slice[link.joint].start for link in links]
    return index([link.number - 1 for link in links]), np.array(starts, np.intp)

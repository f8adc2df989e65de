"""The links of a plan: a link of its own for every degree of freedom.

The algorithms use only its column (w, v) of S: the link turns with w, and slides with v. The frame of a
link is turned such that w, or where it only slides v, is along its z axis. The links of one joint have one origin in
common; the last of them carries the body, those before it have no mass. So there is one kind of link only, and no kind
of joint in the algorithms.

How a q places a link is found by trying the joint, too: see `Way`.

The links are numbered level by level, from the base to the tips, and in a level as far as possible in the order
of their parents: what a level reads of the one below it is then a slice. Number 0 is the base: the body that
floats, or the world of a fixed base.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np

from ..arrays import Array
from ..model import FreeFlyer, Joint, Model
from ..spatial import exp6

__all__ = ["Dof", "Index", "Level", "Step", "base_floats", "index", "levels_of", "links_of", "parents_of", "steps_of"]

Way = Literal["coordinate", "circle", "transform"]
"""How q places a joint: T = exp(S q) with one coordinate q; a turn with q = (cos, sin); or `Joint.transform` does."""

ROUNDING = 1e-15
TRIAL = 0.7

Index = slice | Array
"""Some of the links: a slice where it can be one, since a slice copies nothing."""


@dataclass(eq=False)
class Dof:
    """One degree of freedom, and the link that it moves.

    Attributes
    ----------
    joint : int
        The joint that it belongs to.
    entry : int
        Its entry in v.
    way : Way
        How q places the joint.
    turn : long double
        How much it turns about its z axis for a unit rate.
    slide : ndarray, shape (3,)
        How much it slides for a unit rate, in its own axes.
    first, last : bool
        Whether it is the first, the last of its joint.
    axes : ndarray, shape (3, 3)
        The axes of the link, as columns, in those of the joint's body. Long double.
    parent : Dof or None
        The link that carries it; None is the base.
    """

    joint: int
    entry: int
    way: Way
    turn: np.longdouble
    slide: Array
    first: bool
    last: bool
    axes: Array
    parent: Dof | None = None
    children: list[Dof] = field(default_factory=list)
    height: int = 0
    number: int = 0


class Level(NamedTuple):
    """The links at one distance from the base.

    Attributes
    ----------
    here : slice
        Their numbers.
    up : slice or ndarray
        The numbers of their parents.
    inward : list of (parents, links)
        The same in groups in each of which no parent occurs twice, so that children can be added to their parents;
        the links by their place in the level.
    """

    here: slice
    up: Index
    inward: list[tuple[Index, Index]]


class Step(NamedTuple):
    """One step of all links at once towards the base.

    Attributes
    ----------
    movers : slice
        The links that are not at the base after it.
    left : slice or ndarray
        For each, the ancestor that it leaves.
    reached : slice or ndarray
        For each, the ancestor that it reaches.
    """

    movers: slice
    left: Index
    reached: Index


def base_floats(model: Model) -> bool:
    """Whether all bodies hang on body 1, and that one on nothing."""
    joint = model.joints[1] if model.nbodies > 1 else None
    return type(joint) is FreeFlyer and model.parent.count(0) == 1


def links_of(model: Model) -> list[Dof]:
    """Return the links without the base, numbered from 1."""
    start = 2 if base_floats(model) else 1
    carrier: dict[int, Dof | None] = dict.fromkeys(range(start))  # of each body; the base carries itself
    made: list[Dof] = []
    for i in range(start, model.nbodies):
        parent = carrier[model.parent[i]]
        for link in _links_of_joint(model, i):
            link.parent, parent = parent, link
            made.append(link)
        carrier[i] = parent
    for link in reversed(made):
        if link.parent is not None:
            link.parent.children.insert(0, link)
            link.parent.height = max(link.parent.height, link.height + 1)
    return _numbered([link for link in made if link.parent is None])


def _links_of_joint(model: Model, i: int) -> Iterator[Dof]:
    """Yield a link for each column of S."""
    joint, start = model.joints[i], model.v_slice[i].start
    if joint is None:
        return
    S = joint.subspace(np.longdouble)
    screws = [_screw(column) for column in S.mT]
    way = _way(joint) if isinstance(joint, Hashable) else _way.__wrapped__(joint)
    for k, (axes, turn, slide) in enumerate(screws):
        yield Dof(i, start + k, way, turn, slide, first=k == 0, last=k == joint.nv - 1, axes=axes)


def _screw(column: Array) -> tuple[Array, np.longdouble, Array]:
    """Return axes with z along the turn, or where there is none along the slide; the turn; and the slide in them.

    Rounding errors of the length 1, and of components across z, are removed.
    """
    w, v = column[:3], column[3:]
    z = w if w.any() else v
    size = np.sqrt((z * z).sum())
    if abs(size - 1) < ROUNDING:
        size = np.longdouble(1)
    axes = _axes_with_z(z / size) if size else np.eye(3, dtype=z.dtype)
    slide = axes.mT @ v if w.any() else np.array([0, 0, size])
    slide[np.abs(slide) < ROUNDING * np.abs(v).max()] = 0
    return axes, size if w.any() else size * 0, slide


@lru_cache(maxsize=256)
def _way(joint: Joint) -> Way:
    """Return how q places a joint: the way that its nq and its S suggest is tested on one q."""
    if joint.nv != 1:
        return "transform"
    S = joint.subspace(np.longdouble)[:, 0]
    _, turn, slide = _screw(S)
    if turn not in (0, 1) or slide[:2].any():
        return "transform"
    way: Way = "coordinate" if joint.nq == 1 else "circle"
    q, unit = ([TRIAL], None) if joint.nq == 1 else ([np.cos(TRIAL), np.sin(TRIAL)], slice(0, 2))
    if joint.nq != len(q) or joint.unit != unit:
        return "transform"
    off = joint.transform(np.array(q)).matrix() - exp6(TRIAL * S.astype(np.float64)).matrix()
    return way if np.abs(off).max() < 1e-12 * max(1, np.abs(slide).max()) else "transform"


def _axes_with_z(z: Array) -> Array:
    """Return right-handed axes, as columns, the third of which is the unit vector z; exact for a coordinate axis."""
    x = np.zeros_like(z)
    x[np.abs(z).argmin()] = 1
    x = x - z[np.abs(z).argmin()] * z
    x = x / np.sqrt((x * x).sum())
    y = z[[1, 2, 0]] * x[[2, 0, 1]] - z[[2, 0, 1]] * x[[1, 2, 0]]
    return np.stack([x, y, z], axis=-1)


def _numbered(roots: list[Dof]) -> list[Dof]:
    """Give the links their numbers, level by level: first children in the order of their parents, then second ones.

    The child with the longest way to a tip counts as the first. Those that have children of their own thus
    tend to stand at the head of a level.
    """
    order: list[Dof] = []
    families = [roots]
    while any(families):
        ranked = [sorted(family, key=lambda link: -link.height) for family in families if family]
        level = [family[k] for k in range(max(map(len, ranked))) for family in ranked if k < len(family)]
        order += level
        families = [link.children for link in level]
    for number, link in enumerate(order, start=1):
        link.number = number
    return order


def index(numbers: Sequence[int]) -> Index:
    """Return numbers as a slice where they go up in equal steps, as an array where not."""
    first, *rest = numbers or [0]
    step = max(rest[0] - first, 1) if rest else 1
    steps = range(first, first + step * len(numbers), step)
    return (
        slice(first, steps.stop, None if step == 1 else step)
        if list(numbers) == list(steps)
        else np.array(numbers, dtype=np.intp)
    )


def parents_of(links: list[Dof]) -> list[int]:
    """Return the number of each link's parent, with an entry for the base."""
    return [0, *(link.parent.number if link.parent else 0 for link in links)]


def levels_of(links: list[Dof]) -> list[Level]:
    """Return the levels, from the base to the tips."""
    parent, depth = parents_of(links), [0]
    for i in range(1, len(parent)):
        depth.append(depth[parent[i]] + 1)
    levels = []
    for d, size in sorted(Counter(depth[1:]).items()):
        here = range(depth.index(d), depth.index(d) + size)
        up = [parent[i] for i in here]
        groups: dict[int, list[int]] = defaultdict(list)
        for i in here:
            groups[up[: i - here.start].count(parent[i])].append(i)
        inward = [
            (index([parent[i] for i in group]), index([i - here.start for i in group])) for group in groups.values()
        ]
        levels.append(Level(slice(here.start, here.stop), slice(0, 1) if d == 1 else index(up), inward))
    return levels


def steps_of(links: list[Dof], levels: list[Level]) -> list[Step]:
    """Return the steps that lead every link to the one below the base."""
    parent = parents_of(links)
    steps, at = [], list(range(len(parent)))
    for level in levels[1:]:
        movers = slice(level.here.start, len(parent))
        left = at[movers]
        at = [parent[i] for i in at]
        steps.append(Step(movers, index(left), index(at[movers])))
    return steps

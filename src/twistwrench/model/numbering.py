"""From links to bodies: welded links merged, bodies numbered as Pinocchio does, frames named."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..errors import ModelError
from ..spatial import SE3, SpatialInertia
from ..spatial._physical import check_not_negative
from .checks import WORLD
from .link import Link
from .model import Frame
from .report import Entry

__all__ = ["IMPOSSIBLE", "NumberedTree"]

IMPOSSIBLE = "given, as a body that cannot exist (physical=True rejects it)"


class NumberedTree:
    """The links in their final order, depth first: bodies numbered, welded links merged.

    Attributes
    ----------
    groups : list of list of Link
        For each body the links that it is made of: the one that its joint moves, then what is welded
        to it. Entry 0, the world's, is empty.
    parent, placement, inertia, frames
        As in `Model`.
    """

    def __init__(self, links: Mapping[str, Link]) -> None:
        self.groups: list[list[Link]] = [[]]
        self.parent, self.placement, self.inertia = [-1], [SE3.identity()], [SpatialInertia.zero()]
        found: dict[tuple[str, str], Frame] = {}
        children: dict[str, list[Link]] = {name: [] for name in (WORLD, *links)}
        for link in sorted(links.values(), key=lambda link: link.joint_name, reverse=True):
            children[link.parent].append(link)
        waiting = [(link, 0, SE3.identity()) for link in children[WORLD]]
        while waiting:  # the last one in is the first one out, hence the reversed order above
            link, carrier, in_carrier = waiting.pop()
            carrier, at = self._place(link, carrier, in_carrier @ link.placement)
            if link.joint is not None or link.parent != WORLD:  # a fixed root link hangs on no joint
                found["joint", link.joint_name] = Frame(carrier, at)
            found["link", link.name] = Frame(carrier, at)
            waiting += [(child, carrier, at) for child in children[link.name]]
        self.frames = _named(found)

    @property
    def moved(self) -> list[Link]:
        """The links that joints move, one for each body."""
        return [group[0] for group in self.groups[1:]]

    def _place(self, link: Link, carrier: int, at: SE3) -> tuple[int, SE3]:
        """Give a moved link its number, or merge a welded one; return the body and where the link is in it."""
        if link.joint is not None:
            self.groups.append([link])
            self.parent.append(carrier)
            self.placement.append(at)
            self.inertia.append(link.inertia)
            carrier, at = len(self.parent) - 1, SE3.identity()
        elif carrier > 0:  # what is welded to the world never moves
            self.groups[carrier].append(link)
            self.inertia[carrier] = self.inertia[carrier] + link.inertia.transform(at)
        return carrier, at

    def check_finite(self) -> None:
        """Raise ModelError where finite numbers overflow when links are merged."""
        for link, inertia, placement in zip(self.moved, self.inertia[1:], self.placement[1:], strict=True):
            if not (np.isfinite(inertia.matrix()).all() and np.isfinite(placement.matrix()).all()):
                raise ModelError(f"joint {link.joint_name!r}: the inertia that it carries, or the way to it, overflows")
        for name, frame in self.frames.items():
            if not np.isfinite(frame.placement.matrix()).all():
                raise ModelError(f"frame {name!r}: the way to it overflows")

    def check_bodies(self, physical: bool | None) -> list[Entry]:
        """Check each body, welded links merged: that sum is all that enters the dynamics.

        A single welded link may be a point, or carry an inertia without mass, as in many a real file. Returns
        remarks on whole bodies, for the report.
        """
        bodies = list(zip(self.groups[1:], self.inertia[1:], strict=True))
        indefinite = [(group, fault) for group, inertia in bodies if (fault := _fault(inertia, group, definite=True))]
        faults = [(group, fault) for group, inertia in bodies if (fault := _fault(inertia, group))]
        refused = {True: faults, False: [], None: indefinite}[physical]
        if refused:
            count = "1 moving body" if len(refused) == 1 else f"{len(refused)} moving bodies"
            listed = "".join(f"\n  {fault}" for _, fault in refused)
            raise ModelError(f"{count} cannot exist (physical=False accepts the robot all the same):{listed}")
        warns = physical is None
        read_as = IMPOSSIBLE if warns else "a body that cannot exist (physical=False)"
        impossible = [Entry(_link(group), fault.partition(": ")[2], read_as, warns=warns) for group, fault in faults]
        degenerate = [entry for group, inertia in bodies if (entry := _degenerate(inertia, group))]
        return [*impossible, *degenerate, *self._floating_nothing()]

    def _floating_nothing(self) -> list[Entry]:
        """Report a floating base without mass that carries a single joint: the two turn against each other freely."""
        if len(self.groups) == 1 or self.groups[1][0].parent != WORLD or self.inertia[1].matrix().any():
            return []
        carried = [group[0].joint_name for group, parent in zip(self.groups[2:], self.parent[2:]) if parent == 1]
        if len(carried) > 1:
            return []
        found = "floats without mass" + "".join(f", and carries the joint {name!r} alone" for name in carried)
        return [Entry(_link(self.groups[1]), found, "given: M is singular (base='fixed' or a mass mends that)")]


def _fault(inertia: SpatialInertia, group: list[Link], *, definite: bool = False) -> str:
    """Return why a body cannot exist, under the name of its first link; empty if it can exist.

    A body without mass is judged as the limit of ever lighter ones with its inertia: no moment may be negative. With
    `definite` that is all that is asked of a body with mass, too: it keeps M positive definite.
    """
    try:
        if inertia.mass > 0 and not definite:
            inertia.check_physical(group[0].name)
        else:
            check_not_negative(group[0].name, inertia.mass, inertia.com, inertia.inertia_at_com)
    except ModelError as error:
        others = [repr(x.name) for x in group[1:] if x.inertia.mass > 0 or x.inertia.inertia_at_com.any()]
        return f"{error}" + (f" (with {', '.join(others)} welded to it)" if others else "")
    return ""


def _degenerate(inertia: SpatialInertia, group: list[Link]) -> Entry | None:
    """Report a body that is a limit: a point mass, or an inertia without mass."""
    if inertia.mass == 0 and inertia.inertia_at_com.any():
        return Entry(_link(group), "an inertia without a mass", "the inertia as given, with no weight")
    if inertia.mass > 0 and not inertia.inertia_at_com.any():
        return Entry(_link(group), f"{inertia.mass:.6g} kg without an inertia", "a point mass")
    return None


def _link(group: list[Link]) -> str:
    return f"link {group[0].name!r}"


def _named(found: Mapping[tuple[str, str], Frame]) -> dict[str, Frame]:
    """Name the frames of links and joints.

    A link and a joint of one name are one frame where they share the place. Where they do not, neither
    gets the bare name, so that they cannot be confused: ``link:name`` and ``joint:name``.
    """
    frames: dict[str, Frame] = {}
    owner: dict[str, str] = {}
    for (kind, name), frame in found.items():
        other = found.get(("link" if kind == "joint" else "joint", name), frame)
        same = other.body == frame.body and bool((other.placement.matrix() == frame.placement.matrix()).all())
        full = name if same else f"{kind}:{name}"
        if owner.setdefault(full, name) != name:  # a link really named link:name
            raise ModelError(f"{kind} {name!r}: the frame name {full!r} is taken")
        frames[full] = frame
    return frames

"""Contact Jacobians of all links at once (49.9)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..model import Model
from .frames import Frames
from .plan import Plan
from .vectors import cross, times

__all__ = ["Contacts", "contact_jacobian", "contacts_of"]


class Contacts(NamedTuple):
    """Points of contact, in the terms of a plan.

    Attributes
    ----------
    link : ndarray of int, shape (k,)
        The link that carries each point.
    point : ndarray, shape (3, k, 1)
        The points, in the axes of their links.
    by_base : ndarray of int
        The contacts that a floating base moves.
    by_links : (ndarray, ndarray) of int
        Contact and link, for each link that moves a contact.
    unmoved : (ndarray, ndarray) of int
        Contact and entry of v, for each pair without influence.
    """

    link: Array
    point: Array
    by_base: Array
    by_links: tuple[Array, Array]
    unmoved: tuple[Array, ...]


def contacts_of(model: Model, plan: Plan, names: Sequence[str]) -> Contacts:
    """Look up the frames at which a robot touches its surroundings."""
    carriers = {body: (link, axes) for link, body, axes in plan.bodies}
    world, dtype = (0, np.eye(3)), plan.mass.dtype
    frames = [model.frame(name) for name in names]
    seats = [carriers.get(frame.body, world) for frame in frames]
    points = [axes @ frame.placement.translation for frame, (_, axes) in zip(frames, seats)]
    pairs = [(k, i) for k, (link, _) in enumerate(seats) for i in plan.support(link)]
    k, i = np.array(pairs, np.intp).reshape(-1, 2).mT
    by_base = [k for k, frame in enumerate(frames) if plan.floats and frame.body > 0]
    moved = np.zeros((len(frames), plan.nv), bool)
    moved[k, plan.entry[i]] = True
    moved[by_base, :6] = True
    return Contacts(
        link=np.array([link for link, _ in seats], np.intp),
        point=np.array(points, dtype).reshape(-1, 3).mT[..., None],
        by_base=np.array(by_base, np.intp),
        by_links=(k, i),
        unmoved=np.nonzero(~moved),
    )


def contact_jacobian(plan: Plan, frames: Frames, origin: Array, contacts: Contacts, J: Array) -> None:
    """Write the linear rows of the contacts to J, shape (3 k, nv, b), in the axes of the world."""
    J = J.reshape(len(contacts.link), 3, *J.shape[1:])  # a view: the first axis is cut up
    point = origin[:, contacts.link] + np.einsum("cikb,ckb->ikb", frames.axes[:, :, contacts.link], contacts.point)
    k, i = contacts.by_links
    columns = cross(frames.spin[:, i], point[:, k] - origin[:, i])
    if frames.slide is not None:
        columns += frames.slide[:, i]
    if frames.base is not None:
        if not frames.in_world:
            columns, point = times(frames.base, columns), times(frames.base, point)
        at = point[:, contacts.by_base]
        for c in range(3):
            J[contacts.by_base, :, c] = cross(frames.base[:, c, None], at).swapaxes(0, 1)
        J[contacts.by_base, :, 3:6] = frames.base
    J[k, :, plan.entry[i]] = columns.swapaxes(0, 1)
    k, entry = contacts.unmoved
    J[k, :, entry] = 0

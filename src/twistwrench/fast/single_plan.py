"""The plan for one state: constant matrices for products that do all links at once.

The links are those of `plan`, in the order of v: link 0 is the base, and each link comes after its parent.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .contacts import Contacts
from .dofs import Index, index
from .plan import Placed, Plan
from .products import MOMENTUM, TWISTS
from .single_sums import BLOCK, Sums, SumsInBlocks, carried_by, sums_of

__all__ = ["ContactRows", "SinglePlan", "contact_rows", "make_single_plan"]


class ContactRows(NamedTuple):
    """Points of contact.

    Attributes
    ----------
    link : ndarray of int, shape (k,)
        The links that carry them.
    point : ndarray, shape (k, 4, 1)
        (x, 1) in the link's axes.
    placed : ndarray, shape (4 k, 16 (1 + n)), or None
        From the placements of all links to the points; None where it would be large.
    row, column : ndarray of int, shape (48 k,)
        Where, in the rotation of the base and in the points, the factors of their products stand.
    moved : ndarray, shape (3 k, nv)
        1 where an entry of v moves the contact, 0 elsewhere.
    """

    link: Array
    point: Array
    placed: Array | None
    row: Array
    column: Array
    moved: Array


class JointTerms(NamedTuple):
    """The joint terms as one vector: 1, cosines and sines of angles, cosines and sines from q, lengths, 0.

    Attributes
    ----------
    constant : ndarray, shape (m,)
        The vector with its constant part, to be filled.
    gather : ndarray of int, shape (n, 4)
        The indices of a link's 1, cosine, sine and length in it: cosine 1 and sine 0 without turn, 0 without slide.
    angles : slice or ndarray of int
        Their entries in q.
    circles : ndarray of int, shape (2, k)
        The entries of cosines and of sines.
    lengths : ndarray of int
    """

    constant: Array
    gather: Array
    angles: Index
    circles: Array
    lengths: Array


@dataclass(frozen=True, eq=False)
class SinglePlan:
    """Constants of a model for one state, in double precision. 1 + n links, the first of which is the base.

    Attributes
    ----------
    base : int
        How many entries of v are those of a floating base: 6, or 0.
    joint_terms : JointTerms
    local : ndarray, shape (16 n, m) or (n, 16, 4)
        From the joint terms to the placement of each link in its parent's axes: one matrix, or, where that would be
        large, a matrix for each link.
    pose : ndarray, shape (16 (1 + n),)
        Placements to be filled; that of the base is known.
    placed : list of (int, Placed, ndarray)
        A link that a joint's `transform` places, and the joint's own placement.
    chain : list of (links, links)
        Products T[links] ← T[others] T[links] that lead from placements in the parents to those in the base.
    twist : ndarray, shape (nv, 16)
        Twists of unit rates to be filled; those of the base are known.
    origin, axis : ndarray of int, shape (12 n,)
        Where, in the placements, the factors of the products p̄ zᵀ stand.
    turn : ndarray, shape (n, 1), or None
        How much links without the base turn for a unit rate; None where all do by 1.
    sliding : ndarray of int
        Links without the base that slide.
    slide : ndarray, shape (k, 3, 1)
        How much these slide for a unit rate, in their own axes.
    sums : Sums or SumsInBlocks
    J : ndarray, shape (1 + n, 4, 4)
        Second moments, first moments and mass: ∫ x̄ x̄ᵀ dm.
    upper : ndarray of int, shape (nv, nv)
        For each entry of M the flat index of itself, or below the diagonal of its mirror image.
    related : ndarray, shape (nv, nv)
        1 where one of row and column carries the other, 0 elsewhere.
    rotor : ndarray, shape (nv,), or None
    to_com : ndarray, shape (36, 36)
        `MOMENTUM` over the mass of the robot.
    gravity : ndarray, shape (3,)
    under : ndarray, shape (3, 3), or None
        The axes from which the base turns, as columns in those of the world, where they are not the same.
    new : ndarray of int, shape (1 + n,)
        The number here of each link of `Plan`.
    known : dict
        A cache of contacts.
    """

    base: int
    joint_terms: JointTerms
    local: Array
    pose: Array
    placed: list[tuple[int, Placed, Array]]
    chain: list[tuple[Index, Index]]
    twist: Array
    origin: Array
    axis: Array
    turn: Array | None
    sliding: Array
    slide: Array
    sums: Sums | SumsInBlocks
    J: Array
    upper: Array
    related: Array
    rotor: Array | None
    to_com: Array
    gravity: Array
    under: Array | None
    new: Array
    known: dict[tuple[str, ...], ContactRows] = field(default_factory=dict)


def make_single_plan(plan: Plan) -> SinglePlan:
    """Bring the constants of a plan in double precision into the order of v, and into matrices."""
    base, n = 6 if plan.floats else 0, plan.n
    order = np.argsort(plan.entry)  # old numbers in the new order; the base, with entry -1, stays the first
    new = np.argsort(order)
    parent = new[np.array(plan.parent)][order]
    of = np.concatenate([np.zeros(base, np.intp), np.arange(1, 1 + n)])
    before, last = (
        np.concatenate([[end], new[np.arange(1 + n)[links]]])[order]
        for links, end in ((plan.before, -1), (plan.last, 0))
    )
    joint_terms, local = _joint_terms(plan, new), _local(plan)[order[1:] - 1]
    carried, entries = carried_by(parent)[np.ix_(of, of)], np.indices((len(of), len(of)))
    row, column = np.indices((4, 3)).reshape(2, 12)
    first = 16 * np.arange(1, 1 + n)[:, None]
    slide = np.zeros((n, 3, 1)) if plan.slide is None else plan.slide.swapaxes(0, 1)[order[1:]]
    sliding = np.flatnonzero(slide.any(axis=(1, 2)))
    return SinglePlan(
        base=base,
        joint_terms=joint_terms,
        local=_side_by_side(local, joint_terms) if n < BLOCK else local,
        pose=np.concatenate([np.eye(4).reshape(16), np.zeros(16 * n)]),
        placed=_placed(plan, new),
        chain=_chain(parent),
        twist=np.concatenate([TWISTS[:base], np.zeros((n, 16))]),
        origin=(first + 4 * row + 3).reshape(12 * n),
        axis=(first + 4 * column + 2).reshape(12 * n),
        turn=None if plan.turn is None else plan.turn[order[1:]],
        sliding=sliding,
        slide=slide[sliding],
        sums=sums_of(parent, of, before, last),
        J=_pseudo_inertias(plan)[order],
        upper=np.minimum(*entries) * len(of) + np.maximum(*entries),
        related=np.maximum(carried, carried.mT),
        rotor=plan.rotor[:, 0] if plan.rotor.any() else None,
        to_com=MOMENTUM / plan.mass.sum() if plan.mass.any() else MOMENTUM,
        gravity=plan.gravity[:, 0],
        under=None if (plan.under == np.eye(3)).all() else plan.under,
        new=new,
    )


def _joint_terms(plan: Plan, new: Array) -> JointTerms:
    """Lay out the joint terms in one vector: 1, cosines and sines of angles, of circles, lengths, 0."""
    kinds = []
    for links, entries in (plan.angles, plan.circles, plan.lengths):
        mine = new[1:][links] - 1
        kinds.append((np.sort(mine), entries[np.argsort(mine)]))
    (angles, _), (circles, _), (lengths, _) = kinds
    columns = [(angles, 1), (angles, 2), (circles, 1), (circles, 2), (lengths, 3)]
    end = 1 + sum(len(links) for links, _ in columns)
    gather, place = np.tile([0, 0, end, end], (plan.n, 1)), 1
    for links, column in columns:
        gather[links, column] = place + np.arange(len(links))
        place += len(links)
    constant = np.zeros(end + 1)
    constant[0] = 1
    cosines = kinds[1][1]
    return JointTerms(constant, gather, index(kinds[0][1].tolist()), np.stack([cosines, cosines + 1]), kinds[2][1])


def _side_by_side(local: Array, joint_terms: JointTerms) -> Array:
    """Return one matrix, shape (16 n, m), for the placements of all links."""
    out = np.zeros((len(local), 16, len(joint_terms.constant)))
    for mine, matrix, places in zip(out, local, joint_terms.gather):
        for place, column in zip(places, matrix.mT):
            mine[:, place] += column
    return out.reshape(-1, len(joint_terms.constant))


def _local(plan: Plan) -> Array:
    """Return placements in the parents' axes for (1, cos, sin, length), shape (n, 16, 4)."""
    local = np.zeros((plan.n, 4, 4, 4))
    x, y, z, offset = plan.fixed.swapaxes(0, 1)
    local[:, :3, 0, 1], local[:, :3, 0, 2] = x, y
    local[:, :3, 1, 1], local[:, :3, 1, 2] = y, -x
    local[:, :3, 2, 0], local[:, :3, 3, 0], local[:, 3, 3, 0] = z, offset, 1
    if plan.slide is not None:
        local[:, :3, 3, 3] = z * plan.slide[2, 1:]
    return local.reshape(plan.n, 16, 4)


def _placed(plan: Plan, new: Array) -> list[tuple[int, Placed, Array]]:
    placed = []
    for level, of_level in zip(plan.levels, plan.placed):
        for one in of_level:
            number = level.here.start + one.link
            own = np.eye(4)
            own[:3, :3], own[:3, 3] = plan.fixed[number - 1, :3].mT, plan.fixed[number - 1, 3]
            placed.append((int(new[number]), one, own))
    return placed


def _chain(parent: Array) -> list[tuple[Index, Index]]:
    """Return the products that lead from placements in the parents to placements in the base.

    Level by level; or, where there are many levels, in rounds that double the number of joints passed: in the first
    round each link takes in its parent, in the second its grandparent, which has already taken in its own parent, …
    """
    depth = np.zeros(len(parent), np.intp)
    for i in range(1, len(parent)):
        depth[i] = depth[parent[i]] + 1
    if depth.max() <= 4:
        levels = [np.flatnonzero(depth == d) for d in range(2, depth.max() + 1)]
        return [(index(level.tolist()), index(parent[level].tolist())) for level in levels]
    rounds, up, reach = [], parent, 1
    while reach < depth.max():
        links = np.flatnonzero(depth > reach)
        rounds.append((index(links.tolist()), index(up[links].tolist())))
        up, reach = up[up], 2 * reach
    return rounds


def _pseudo_inertias(plan: Plan) -> Array:
    """Return ∫ x̄ x̄ᵀ dm of the links: the second moments are tr(I)/2 − I."""
    J = np.zeros((1 + plan.n, 4, 4))
    I, h = plan.inertia[:, :3], plan.inertia[:, 3]
    J[:, :3, :3] = np.trace(I, axis1=1, axis2=2)[:, None, None] / 2 * np.eye(3) - I
    J[:, :3, 3] = J[:, 3, :3] = h
    J[:, 3, 3] = plan.mass[:, 0]
    return J


def contact_rows(plan: SinglePlan, contacts: Contacts) -> ContactRows:
    """Bring contacts into the order of v."""
    k, n1, link = len(contacts.link), len(plan.J), plan.new[contacts.link]
    point = np.ones((k, 4, 1))
    point[:, :3, 0] = contacts.point[..., 0].mT
    small = k * n1 < 1024
    placed = np.zeros((k, 4, n1 if small else 0, 4, 4))
    for row in range(4 if small else 0):
        placed[range(k), row, link, row] = point[..., 0]
    contact, i, a, b = np.indices((k, 3, 4, 4)).reshape(4, 48 * k)
    moved = np.ones((k, len(plan.twist)))
    moved[contacts.unmoved] = 0
    return ContactRows(
        link=link,
        point=point,
        placed=placed.reshape(4 * k, 16 * n1) if small else None,
        row=3 * i + a % 3,  # where a = 3 the twist has a row of zeros
        column=4 * contact + b,
        moved=np.repeat(moved, 3, axis=0),
    )

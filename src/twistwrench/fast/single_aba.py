"""Forward dynamics of one state: articulated inertias with one more row and column.

In `twistwrench.aba` an articulated inertia I and a bias force p go together: the force that is needed is I a + p. Here
they are one symmetric 7 × 7 matrix, and a is (a, 1):

    K = [ I   p ]     Y = [ X   c ]     w = K S − (0, τ) = [  U ]      q̈ = − wᵀ Y (a, 1) / D,   D = Sᵀ U
        [ pᵀ  · ]         [ 0   1 ]                        [ −u ]

X takes a twist from the parent's origin to the link's, c is the bias acceleration. All of pass 2 is then

    K of the parent  +=  Yᵀ (K − w wᵀ / D) Y,

for all links of a level at once, in the axes of the base, each about its own origin. The corner of K is not used.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..spatial.formulas import bias_wrench
from .articulated import NearlySingular, floors
from .dofs import Index, index
from .plan import Plan
from .single import placements, turned
from .single_plan import SinglePlan
from .vectors import CYCLE

__all__ = ["AbaPlan", "make_aba_plan", "single_aba"]


class Stage(NamedTuple):
    """The links of a level.

    Attributes
    ----------
    here : slice or ndarray
        Their numbers.
    up : slice or ndarray
        The numbers of their parents; one for all where the base is.
    parents : slice or ndarray
        The parents, each once.
    family : ndarray, or None
        1 where the link of the column belongs to the parent of the row; None where each has one.
    """

    here: Index
    up: Index
    parents: Index
    family: Array | None


@dataclass(frozen=True, eq=False)
class AbaPlan:
    """The constants of forward dynamics of one state besides `SinglePlan`, with the links in the same order.

    Attributes
    ----------
    single : SinglePlan
    stages : list of Stage
        From the base to the tips.
    parent, last : ndarray of int, shape (1 + n,)
    screw : ndarray, shape (1 + n, 3, 2)
        How a link turns and slides for a unit rate, in its own axes.
    rotor : ndarray, shape (nv,)
    floors : tuple of ndarray, or None
        As `articulated.floors` gives them, in the order here, where they do not depend on the state.
    plan : Plan
        For the floors where they do.
    """

    single: SinglePlan
    stages: list[Stage]
    parent: Array
    last: Array
    screw: Array
    rotor: Array
    floors: tuple[Array, Array] | None
    plan: Plan


def _constants() -> tuple[Array, Array, Array]:
    """Return `SPATIAL`, `CROSS` and `SHIFT`."""
    skew = np.zeros((3, 3, 3))
    for i, j, k in CYCLE:
        skew[k, j, i], skew[k, i, j] = 1, -1
    spatial, motion = np.zeros((4, 4, 6, 6)), np.zeros((6, 6, 6))
    for i in range(3):
        spatial[i, i, :3, :3] += np.eye(3)
        spatial[3, 3, 3 + i, 3 + i] = 1
        for j in range(3):
            spatial[i, j, i, j] -= 1
    spatial[:3, 3, :3, 3:], spatial[:3, 3, 3:, :3] = skew, -skew
    motion[:3, :3, :3] = motion[:3, 3:, 3:] = motion[3:, 3:, :3] = skew
    return spatial.reshape(16, 36), motion.reshape(6, 36), -skew.reshape(3, 9)


SPATIAL, CROSS, SHIFT = _constants()
"""From ∫ x̄ x̄ᵀ dm to the 6 × 6 inertia; from V to V×; from r to −r×."""


def make_aba_plan(plan: Plan, single: SinglePlan) -> AbaPlan:
    """Bring the constants of a plan in double precision into the order of `SinglePlan`."""
    order = np.argsort(single.new)
    parent = single.new[np.array(plan.parent)][order]
    last = np.concatenate([[0], single.new[np.arange(1 + plan.n)[plan.last]]])[order]
    screw = np.zeros((1 + plan.n, 3, 2))
    screw[1:, 2, 0] = 1 if single.turn is None else single.turn[:, 0]
    screw[1 + single.sliding, :, 1] = single.slide[:, :, 0]
    stages = [_stage(np.sort(single.new[level.here]), parent) for level in plan.levels]
    constant = None
    if plan.reach is not None:
        links, base = floors(plan, plan.reach)
        constant = links[order, 0], base[:, 0]
    return AbaPlan(single, stages, parent, last, screw, plan.rotor[:, 0], constant, plan)


def _stage(links: Array, parent: Array) -> Stage:
    up = parent[links]
    parents, of_parent = np.unique(up, return_inverse=True)
    if len(parents) == len(links):
        return Stage(index(links.tolist()), index(up.tolist()), index(up.tolist()), None)
    family = np.zeros((len(parents), len(links)))
    family[of_parent, range(len(links))] = 1
    all_of_them = slice(parents[0], parents[0] + 1) if len(parents) == 1 else index(up.tolist())
    return Stage(index(links.tolist()), all_of_them, index(parents.tolist()), family)


def single_aba(aba: AbaPlan, q: Array, v: Array, tau: Array) -> Array:
    """Return q̈ for one state, shape (nv,).

    Raises
    ------
    NearlySingular
        If a joint may have no apparent inertia.
    """
    base = aba.single.base
    S, K, Y, a, reach = _start(aba, q, v)
    floor, base_floor = aba.floors or _floors(aba, reach)
    w, D, qdd = np.empty_like(S), np.empty(len(S)), np.empty(len(v))
    motor, rotor = np.concatenate([[0.0], tau[base:]]), np.concatenate([[0.0], aba.rotor[base:]])
    with np.errstate(divide="ignore", invalid="ignore"):
        for here, _, parents, family in reversed(aba.stages):  # pass 2
            IA, s = K[here], S[here, :, None]
            U = np.matmul(IA, s)
            D[here] = np.matmul(s.mT, U)[:, 0, 0] + rotor[here]
            U[:, 6, 0] -= motor[here]
            w[here] = U[:, :, 0]
            through = IA - np.matmul(U / D[here, None, None], U.mT)
            moved = np.matmul(np.matmul(Y[here].mT, through), Y[here])
            moved = (moved + moved.mT) / 2
            if family is not None:
                moved = family.dot(moved.reshape(-1, 49)).reshape(-1, 7, 7)
            K[parents] += moved
    if not (D[1:] > floor[1:]).all():
        raise NearlySingular
    if base:
        qdd[:6] = _base(K[0], tau[:6], aba.rotor[:6], a[0, :6], base_floor)
        a[0, :6] += qdd[:6]
    for here, up, _, _ in aba.stages:  # pass 3
        carried = np.matmul(Y[here], a[up, :, None])[:, :, 0]
        rate = -(w[here] * carried).sum(axis=-1) / D[here]
        a[here] = carried + S[here] * rate[:, None]
        D[here] = rate
    qdd[base:] = D[1:]
    return qdd


def _start(aba: AbaPlan, q: Array, v: Array) -> tuple[Array, Array, Array, Array, Array]:
    """Pass 1: return S, K and Y of the links, the accelerations with that of the base filled in, and the offsets."""
    single, base = aba.single, aba.single.base
    _, T = placements(single, q)
    offset = T[:, :3, 3].copy()
    for links, others in single.chain:
        T[links] = np.matmul(T[others], T[links])
    T[:, :3, 3] = 0  # each link about its own origin
    r = np.matmul(T.take(aba.parent, axis=0)[:, :3, :3], offset[:, :, None])[:, :, 0]
    n1 = len(T)
    S = np.zeros((n1, 7))
    S[:, :6] = np.matmul(T[:, :3, :3], aba.screw).mT.reshape(n1, 6)
    K, Y, V, a = np.zeros((n1, 7, 7)), np.zeros((n1, 7, 7)), np.zeros((n1, 7)), np.empty((n1, 7))
    I = np.matmul(np.matmul(T, single.J), T.mT).reshape(-1, 16).dot(SPATIAL).reshape(-1, 6, 6)
    Y[:, range(7), range(7)] = 1
    Y[:, 3:6, :3] = r.dot(SHIFT).reshape(-1, 3, 3)
    moving = S * np.concatenate([[0.0], v[base:]])[:, None]
    V[0, :base] = v[:base]
    for here, up, _, _ in aba.stages:
        V[here] = np.matmul(Y[here], V[up, :, None])[:, :, 0] + moving[here]
    V6 = V[:, :6]
    cross = V6.dot(CROSS).reshape(-1, 6, 6)
    Y[:, :6, 6] = np.matmul(cross.take(aba.last, axis=0), moving[:, :6, None])[:, :, 0]
    bias = bias_wrench(I, V6[:, :, None])[:, :, 0]
    K[:, :6, :6], K[:, :6, 6], K[:, 6, :6] = I, bias, bias
    a[0] = 0, 0, 0, *-single.gravity.dot(turned(single, q).reshape(3, 3)), 1  # the world rises
    return S, K, Y, a, offset


def _floors(aba: AbaPlan, offset: Array) -> tuple[Array, Array]:
    """Return the limits of D where they depend on the state: on the distances of the links from their parents."""
    order = np.argsort(aba.single.new)
    reach = np.sqrt((offset * offset).sum(axis=-1))[aba.single.new]
    links, base = floors(aba.plan, reach)
    return links[order, 0], base[:, 0]


def _base(K: Array, tau: Array, rotor: Array, rising: Array, floor: Array) -> Array:
    """Return the acceleration of a floating base, shape (6,)."""
    I = K[:6, :6]
    IA = I + np.diag(rotor)
    try:
        pivots = np.linalg.cholesky(IA).diagonal() ** 2
    except np.linalg.LinAlgError:
        raise NearlySingular from None
    if not (pivots > floor).all():
        raise NearlySingular
    unit = np.sqrt(IA.diagonal())  # scales the rows: the solver's pivots must not depend on kg and m
    x: Array = np.linalg.solve(IA / unit[:, None] / unit, (tau - K[:6, 6] - I.dot(rising)) / unit) / unit
    return x

"""The project, stage 1, continued: placements, twists and wrenches along a tree."""

from functools import partial
from typing import Any

import numpy as np

from misstep.exercise import Output, Part
from misstep.faults import after

from ...algorithms.kinematics import placements
from ...model import joint_placements, random_tree
from ...model.tree import split
from ...spatial import motion_transform
from ..public import mine
from ..robots import robot
from ..wrong import faulty, swap
from .project_trees import previous

__all__ = ["PLACEMENTS", "TWISTS", "WRENCHES", "body_placements", "body_twists", "carried_wrenches"]


def body_placements(parent: Any, T: Any) -> Any:
    """Placements in the world out of those in the parents."""
    return np.array(placements(parent, [*T]))


def body_twists(parent: Any, T: Any, V_joint: Any) -> Any:
    """Twists of all bodies out of those of their joints."""
    transforms = mine("transforms_of")
    V = [np.zeros(6)]
    for i in range(1, len(parent)):
        X, _ = transforms(np.linalg.inv(T[i]))
        V.append(X @ V[parent[i]] + V_joint[i])
    return np.array(V)


def carried_wrenches(parent: Any, T: Any, F: Any) -> Any:
    """Wrenches that the joints pass on, out of those that the bodies need."""
    transforms = mine("transforms_of")
    carried = np.array(F, float)
    for i in range(len(parent) - 1, 0, -1):
        _, X_star = transforms(T[i])
        carried[parent[i]] += X_star @ carried[i]
    return carried


def _steps_of_twists(answer: Any, parent: Any, T: Any, V_joint: Any) -> Any:
    """Return what the step from the parent to each body does not explain."""
    seen = [np.linalg.inv(motion_transform(x[:3, :3], x[:3, 3])) @ answer[p] for p, x in zip(parent[1:], T[1:])]
    return answer[1:] - seen - V_joint[1:]


def _unmoved(before: Any, T: Any) -> Any:
    T = before @ T
    T[:3, 3] = before[:3, 3]
    return T


def _added(before: Any, T: Any) -> Any:
    """Add the positions as they are."""
    placed = before @ T
    placed[:3, 3] = before[:3, 3] + T[:3, 3]
    return placed


def _uncoupled(X: Any) -> Any:
    """Return a transform without its coupling."""
    return np.block([[X[:3, :3], np.zeros((3, 3))], [np.zeros((3, 3)), X[3:, 3:]]])


def _shifted_back(T: Any) -> Any:
    """Return (Rᵀ, −p)."""
    T = np.array(T)
    T[:3, :3], T[:3, 3] = T[:3, :3].mT.copy(), -T[:3, 3]
    return T


def _robots(rng: Any) -> Any:
    """Return for some robots the parents, the placements in them, and the motion at the joints."""
    cases = []
    for model in (robot("go2"), random_tree(5, rng=rng), random_tree(6, rng=rng, base="floating")):
        q, v = model.random_configuration(rng=rng), split(model, rng.standard_normal(model.nv))
        V_joint = np.array([S @ rate for S, rate in zip(model.constants(np.dtype(float)).S, v)])
        cases.append((model.parent, np.array([T.matrix() for T in joint_placements(model, q)]), V_joint))
    return cases


def _with_wrenches(rng: Any) -> Any:
    return [
        (parent, T, np.concatenate([[np.zeros(6)], rng.standard_normal((len(T) - 1, 6))]))
        for parent, T, _ in _robots(rng)
    ]


_changed = partial(faulty, body_placements, of=placements)

PLACEMENTS = Part(
    solution=body_placements,
    beside=(placements,),
    rtol=1e-12,
    returns=(Output("oMi"),),
    cases=lambda rng: [(parent, T) for parent, T, _ in _robots(rng)],
    slips={
        "composition-order": _changed(("T[parent[i]] @ T[i]", "T[i] @ T[parent[i]]")),
        "chain-for-tree": lambda parent, T: body_placements(previous(parent), T),
        "translation-unrotated": _changed(("T[parent[i]] @ T[i]", "_added(T[parent[i]], T[i])")),
        "translation-dropped": _changed(("T[parent[i]] @ T[i]", "_unmoved(T[parent[i]], T[i])")),
        "inverse-transform": after(body_placements, np.linalg.inv),
        "parents-joint-only": _changed(("T[parent[i]] @ T[i]", "relative[parent[i]] @ T[i]")),
        "untransformed": lambda parent, T: T,
    },
    residuals=(lambda answer, parent, T: [answer[i] - answer[parent[i]] @ T[i] for i in range(1, len(parent))],),
)

TWISTS = Part(
    solution=body_twists,
    rtol=1e-12,
    given='transforms = mine("transforms_of")  # transforms(T) gives X and X*',
    returns=(Output("V"),),
    cases=_robots,
    slips={
        "inverse-transform": faulty(body_twists, ("np.linalg.inv(T[i])", "T[i]")),
        "force-for-motion": faulty(body_twists, ("X, _ =", "_, X =")),
        "transpose-for-inverse": faulty(
            body_twists, ("X, _ = transforms(np.linalg.inv(T[i]))", "X = transforms(T[i])[0].mT")
        ),
        "coupling-dropped": faulty(body_twists, ("X @ V", "_uncoupled(X) @ V")),
        "untransformed": faulty(body_twists, ("X @ V", "V")),
        "inverse-unrotated": faulty(body_twists, ("np.linalg.inv(T[i])", "_shifted_back(T[i])")),
        "transform-of-parent": faulty(body_twists, ("T[i]", "T[parent[i]]")),
        "own-transformed": faulty(body_twists, ("X @ V[parent[i]] + V_joint[i]", "X @ (V[parent[i]] + V_joint[i])")),
        "parents-joint-only": faulty(body_twists, ("V[parent[i]]", "V_joint[parent[i]]")),
        "twist-not-carried": lambda parent, T, V_joint: V_joint,
        "chain-for-tree": lambda parent, T, V_joint: body_twists(previous(parent), T, V_joint),
        "swapped-halves": lambda parent, T, V_joint: _halves(body_twists(parent, T, V_joint)),
    },
    alike=(frozenset({"force-for-motion", "transpose-for-inverse"}),),  # X*(T⁻¹) is X(T)ᵀ
    residuals=(_steps_of_twists,),
)


def _halves(rows: Any) -> Any:
    """Exchange the halves of each row, not the rows."""
    return np.array([swap(row) for row in rows])


WRENCHES = Part(
    solution=carried_wrenches,
    rtol=1e-12,
    given='transforms = mine("transforms_of")  # transforms(T) gives X and X*',
    returns=(Output("F"),),
    cases=_with_wrenches,
    slips={
        "inverse-transform": faulty(carried_wrenches, ("transforms(T[i])", "transforms(np.linalg.inv(T[i]))")),
        "transpose-for-dual": faulty(
            carried_wrenches, ("_, X_star = transforms(T[i])", "X_star = transforms(T[i])[0].mT")
        ),
        "motion-for-force": faulty(carried_wrenches, ("_, X_star =", "X_star, _ =")),
        "coupling-dropped": faulty(carried_wrenches, ("X_star @ carried", "_uncoupled(X_star) @ carried")),
        "untransformed": faulty(carried_wrenches, ("X_star @ carried", "carried")),
        "children-overwritten": faulty(carried_wrenches, ("+=", "=")),
        "children-dropped": lambda parent, T, F: F,
        "force-sign": faulty(carried_wrenches, ("+=", "-=")),
        "own-share-only": faulty(carried_wrenches, ("range(len(parent) - 1, 0, -1)", "range(1, len(parent))")),
        "ground-left-out": after(carried_wrenches, lambda F: F * (np.arange(len(F)) > 0)[:, None]),
        "chain-for-tree": lambda parent, T, F: carried_wrenches(previous(parent), T, F),
        "swapped-halves": lambda parent, T, F: _halves(carried_wrenches(parent, T, F)),
    },
    alike=(frozenset({"inverse-transform", "transpose-for-dual"}),),  # X(T)ᵀ is X*(T⁻¹)
    residuals=(
        lambda answer, parent, T, F: (
            answer[0] - sum(mine("transforms_of")(P)[1] @ f for P, f in zip(body_placements(parent, T), F))
        ),
    ),
)

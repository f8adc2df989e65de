"""The tree terms that all recursions of the chapter share.

Inside a recursion the index is the frame: V[i] is the twist of body i in frame i. X[i] is the chapter's
ⁱX_λ(i): it takes a twist from the parent's frame to frame i. A wrench comes back from frame i to the
parent's by X[i]ᵀ, since power is the same in both (49.3; not by X[i]*, which leads outward like X[i]).
Vectors are columns, shape (..., 6, 1): a line of the chapter is then a line of the source.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..spatial import SE3
from ..spatial.formulas import symmetric
from .model import Model

__all__ = ["Tree", "columns", "composite_inertias", "joint_placements", "stack_columns", "tree_terms", "wrenches"]


@dataclass(frozen=True)
class Tree:
    """What a recursion needs of the model at q. Entry 0 of each list is the world's.

    Attributes
    ----------
    parent : tuple of int
        λ(i).
    S : list of ndarray, shape (6, nv of joint i)
        Motion subspace, in frame i.
    I : list of ndarray, shape (6, 6)
        Spatial inertia, in frame i.
    placement : list of SE3
        ^λ(i)T_i, the placement of frame i in the parent's.
    X : list of ndarray, shape (..., 6, 6)
        ⁱX_λ(i), from the parent's frame to frame i.
    rotor : list of ndarray, shape (nv of joint i, nv of joint i)
        Inertia of the rotors, a diagonal matrix.
    gravity : ndarray, shape (..., 6, 1)
        The spatial acceleration (0, g) of free fall, in the world.
    """

    parent: tuple[int, ...]
    S: list[Array]
    I: list[Array]
    placement: list[SE3]
    X: list[Array]
    rotor: list[Array]
    gravity: Array

    @property
    def batch(self) -> tuple[int, ...]:
        """The batch axes of the configuration."""
        return self.gravity.shape[:-2]

    @property
    def outward(self) -> range:
        """The bodies from the root to the tips, without the world."""
        return range(1, len(self.parent))

    @property
    def inward(self) -> range:
        """The bodies from the tips to the root, without the world."""
        return range(len(self.parent) - 1, 0, -1)

    @property
    def nv(self) -> list[int]:
        """The number of velocities of each joint, 0 for the world."""
        return [S.shape[-1] for S in self.S]

    def zeros(self, count: int) -> list[list[Array]]:
        """Return that many lists with an entry for each body, a column of zeros at first."""
        zero = np.zeros_like(self.gravity)
        return [[zero] * len(self.parent) for _ in range(count)]


def tree_terms(model: Model, q: Array) -> Tree:
    """Return what the recursions need of `model` at a checked `q`, in q's number type."""
    constants = model.constants(q.dtype)
    placement = joint_placements(model, q)
    X = [T.inverse().motion_transform() for T in placement]  # 49.3 X
    gravity = np.broadcast_to(constants.gravity[:, None], (*q.shape[:-1], 6, 1))
    return Tree(model.parent, [*constants.S], [*constants.I], placement, X, [*constants.rotor], gravity)


def joint_placements(model: Model, q: Array) -> list[SE3]:
    """Return for each body its placement in its parent's frame: tree constant, then joint (49.3)."""
    placement = model.constants(q.dtype).placement
    batch = q.shape[:-1]
    root = placement[0]  # the world's, broadcast to q's batch axes
    world = SE3._trusted(np.broadcast_to(root.rotation, (*batch, 3, 3)), np.broadcast_to(root.translation, (*batch, 3)))
    return [
        T @ joint.transform(q[..., s]) if joint else world  # 49.3 T_J: tree constant, then joint
        for T, joint, s in zip(placement, model.joints, model.q_slice)
    ]


def composite_inertias(tree: Tree) -> list[Array]:
    """Return for each body the inertia of its whole subtree with the joints locked, in frame i.

    Congruences and sums from the tips inward (49.5): I^C[λ] += X[i]ᵀ I^C[i] X[i].
    """
    IC = [*tree.I]
    for i in tree.inward:
        p = tree.parent[i]
        IC[p] = IC[p] + symmetric(tree.X[i].mT @ IC[i] @ tree.X[i])  # 49.5 IC: congruences and sums
    return IC


def columns(model: Model, v: Array) -> list[Array]:
    """Cut a (..., nv) array into one column per joint, shape (..., nv of joint i, 1); the world's is empty."""
    return [v[..., s, None] for s in model.v_slice]


def stack_columns(pieces: list[Array]) -> Array:
    """Return the columns of all joints as one (..., nv) array; the world, entry 0, has no joint."""
    return np.concatenate([pieces[0][..., :0, :], *pieces[1:]], axis=-2)[..., 0]


def wrenches(f_ext: Array) -> list[Array]:
    """Return the wrenches on the bodies, (..., nbodies, 6), as one column for each body."""
    return [f_ext[..., i, :, None] for i in range(f_ext.shape[-2])]


def split(model: Model, v: Array) -> list[Array]:
    """Cut a (..., nv) array into one piece per joint; the world's is empty."""
    return [v[..., s] for s in model.v_slice]


def join(pieces: list[Array]) -> Array:
    """Put the pieces of `split` together again."""
    return np.concatenate(pieces, axis=-1)

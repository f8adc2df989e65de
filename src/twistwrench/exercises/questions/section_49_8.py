"""Answers to the questions of 49.8: which entries M has, and what its zeros are worth."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts


def both() -> Facts:
    """Which bodies count in the entry of M that couples the hip of a leg with its knee."""
    model = tw.load("go2")
    q = model.random_configuration(rng=np.random.default_rng(8))
    hip, calf = (model.v_slice[model.joint_id(f"FR_{part}_joint")].start for part in ("hip", "calf"))
    shares = {}
    for body in range(1, model.nbodies):
        J = tw.frame_jacobian(model, q, model.joint_names[body], "local")
        shares[model.joint_names[body]] = J[:, hip] @ model.inertia[body].matrix() @ J[:, calf]
    count = [name for name, share in shares.items() if abs(share) > 1e-12]
    return {"truth": "calf" if count == ["FR_calf_joint"] else "leg" if len(count) == 3 else "others"}


def zeros() -> Facts:
    """How many entries of M are zero in every posture of Go2, and how many of them the tree explains."""
    model, rng = tw.load("go2"), np.random.default_rng(8)
    M = np.array([tw.crba(model, model.random_configuration(rng=rng)) for _ in range(4)])
    return {"truth": float((np.abs(M) < 1e-12).all(axis=0).sum()), "tree": 4 * 3 * 9.0, "base": 4 * 3 * 9.0 + 12}


def fill() -> Facts:
    """How many of the zeros between legs, below the diagonal, a factorization fills that begins with the base."""
    model = tw.load("go2")
    M = tw.crba(model, model.random_configuration(rng=np.random.default_rng(8)))
    leg = np.repeat(np.arange(4), 3)
    apart = np.tril(leg[:, None] != leg)
    base_first = np.linalg.cholesky(M)[6:, 6:]
    tips_first = np.linalg.cholesky(M[::-1, ::-1])[::-1, ::-1].mT[6:, 6:]
    filled, other = (float((np.abs(factor[apart]) > 1e-12).sum()) for factor in (base_first, tips_first))
    return {"truth": filled, "none": other, "half": filled / 2}


def bare() -> Facts:
    """Rank of M of an arm with two joints whose last link has no mass."""
    builder = tw.Builder("arm with a bare tool")
    rod = tw.SpatialInertia(1.0, [0, 0, -0.5], np.diag([0.084, 0.084, 0.001]))
    builder.link("upper", parent="base_link", joint=tw.Revolute("y"), inertia=rod)
    builder.link("tool", parent="upper", joint=tw.Revolute("x"), placement=tw.SE3(np.eye(3), [0, 0, -1]))
    rank = np.linalg.matrix_rank(tw.crba(builder.build(), [0.1, 0.2]))
    return {"truth": float(rank), "two": 2.0, "none": 0.0}


def chain() -> Facts:
    """Work of CRBA on a chain of 48 links as a multiple of that on 24, by the lines that are executed."""
    few, many = (len(tw.trace(tw.chain(n), "crba", np.full(n, 0.3)).steps) for n in (24, 48))
    return {"truth": many / few, "linear": 2.0, "cube": 8.0}


def recipe() -> Facts:
    """Effect on M of doubling its entries off the diagonal."""
    model = tw.load("go2")
    M = tw.crba(model, model.random_configuration(rng=np.random.default_rng(8)))
    least = float(np.linalg.eigvalsh(M + M.mT - np.diag(M.diagonal())).min())
    return {"truth": "negative" if least < 0 else "larger", "least": least}

"""Exercise 49.10.2: the linear momentum, in both orders."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part

from ..robots import larger, states
from ..wrong import faulty

__all__ = ["EXERCISE", "linear_momentum", "momentum_of_links", "pinocchio_linear_momentum"]


def linear_momentum(A_G: Any, v: Any) -> Any:
    """Linear momentum out of A_G, in the order (ω, v)."""
    return A_G[3:] @ v


def pinocchio_linear_momentum(A_G: Any, v: Any) -> Any:
    """Linear momentum out of Pinocchio's A_G, in its order (v, ω)."""
    return A_G[:3] @ v


def momentum_of_links(model: Any, q: Any, v: Any) -> Any:
    """Sum of m_i times the velocity of link i's centre of mass."""
    motion = tw.forward_kinematics(model, q, v)
    total = np.zeros(3)
    for body, T, V in zip(model.inertia, motion.placement, np.array(motion.twist)):
        velocity = V[3:] + np.cross(V[:3], body.com)
        total = total + body.mass * T.rotation @ velocity
    return total


def _base(model: Any, q: Any, v: Any) -> Any:
    """Return the whole mass times the velocity of the base."""
    return model.mass * tw.forward_kinematics(model, q).placement[1].rotation @ v[3:6]


def _velocity(text: str) -> Any:
    """Return what has another velocity of the links' centres of mass, in the axes of the world."""
    return faulty(momentum_of_links, ("T.rotation @ velocity", f"({text})".replace("R @", "T.rotation @")))


def _maps(rng: Any) -> Any:
    return [(tw.centroidal_map(model, q), v) for model, q, v in states(rng, vectors=1)]


def _in_pinocchio_order(rng: Any) -> Any:
    """Return A_G and v as Pinocchio has them: all the halves exchanged, no joint touched."""
    cases = []
    for A_G, v in _maps(rng):
        order = [k + 3 if k < 3 else k - 3 if k < 6 else k for k in range(len(v))]
        cases.append((A_G[order[:6]][:, order], v[order]))
    return cases


def _other_order(v: Any) -> Any:
    return np.concatenate([v[:6].reshape(2, 3)[::-1].ravel(), v[6:]])


OURS = Part(
    solution=linear_momentum,
    returns=(Output("l_G", unit="kg m/s"),),
    cases=_maps,
    edges=lambda rng: [(tw.centroidal_map(model, q), rng.standard_normal(model.nv)) for model, q in larger(rng)],
    slips={
        "angular-for-linear": faulty(linear_momentum, ("A_G[3:]", "A_G[:3]")),
        "joints-left-out": lambda A_G, v: A_G[3:, :6] @ v[:6],
        "columns-and-v": lambda A_G, v: A_G[3:] @ _other_order(v),
        "base-for-com": lambda A_G, v: A_G[3:, 3:6] @ v[3:6],
        "base-rotation-left-out": lambda A_G, v: A_G[3:, 3:] @ v[3:],
    },
)

THEIRS = Part(
    solution=pinocchio_linear_momentum,
    returns=(Output("l_G", unit="kg m/s"),),
    cases=_in_pinocchio_order,
    edges=lambda rng: [(rng.standard_normal((6, n)), rng.standard_normal(n)) for n in (7, 30)],
    slips={
        "angular-for-linear": lambda A_G, v: A_G[3:] @ v,
        "joints-left-out": lambda A_G, v: A_G[:3, :6] @ v[:6],
        "columns-and-v": lambda A_G, v: A_G[:3] @ _other_order(v),
        "base-for-com": lambda A_G, v: A_G[:3, :3] @ v[:3],
    },
)

LINKS = Part(
    solution=momentum_of_links,
    returns=(Output("m v_G", unit="kg m/s"),),
    cases=lambda rng: [*states(rng, vectors=1)],
    slips={
        "frame-for-com": faulty(momentum_of_links, (" + np.cross(V[:3], body.com)", "")),
        "cross-order": faulty(momentum_of_links, ("np.cross(V[:3], body.com)", "np.cross(body.com, V[:3])")),
        "local-for-world": faulty(momentum_of_links, ("T.rotation @ velocity", "velocity")),
        "rotation-transposed": faulty(momentum_of_links, ("T.rotation @", "T.rotation.mT @")),
        "angular-for-linear": faulty(momentum_of_links, ("T.rotation @ velocity", "T.rotation @ V[:3]")),
        "mass-dropped": faulty(momentum_of_links, ("body.mass * ", "")),
        "unweighted-mean": faulty(momentum_of_links, ("body.mass", "model.mass / (model.nbodies - 1)")),
        "base-for-com": _base,
        "inertia-of-body-before": faulty(
            momentum_of_links,
            ("motion.placement, np.array(motion.twist)", "motion.placement[1:], np.array(motion.twist)[1:]"),
        ),
        "omega-in-body-axes": _velocity("R @ V[3:] + np.cross(V[:3], R @ body.com)"),
        "lever-in-body-axes": _velocity("R @ V[3:] + np.cross(R @ V[:3], body.com)"),
        "half-rotated": _velocity("V[3:] + R @ np.cross(V[:3], body.com)"),
        "lever-from-origin": _velocity("R @ V[3:] + np.cross(R @ V[:3], T.translation + R @ body.com)"),
        "spatial-for-body": _velocity("V[3:] + np.cross(V[:3], T.translation + R @ body.com)"),
        "legs-left-out": faulty(
            momentum_of_links, ("in zip", "in [*zip"), ("np.array(motion.twist)):", "np.array(motion.twist))][1:2]:")
        ),
    },
    residuals=(lambda answer, model, q, v: answer - model.mass * _rate_of_com(model, q, v),),
)


def _rate_of_com(model: Any, q: Any, v: Any) -> Any:
    """Differentiate the centre of mass along the motion, by a central difference."""
    h = 1e-5
    ahead, behind = (tw.center_of_mass(model, model.integrate(q, s * v)) for s in (h, -h))
    return (ahead - behind) / (2 * h)


EXERCISE = Exercise(id="49.10.2", kind="code", parts=(OURS, THEIRS, LINKS))

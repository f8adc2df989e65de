"""The project, stage 3: A_G and ḣ_G of one's own, and how they go wrong."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Output, Part

from ..layouts import CENTROIDAL_MAP, MOMENTUM
from ..robots import states
from ..wrong import faulty, swapped

__all__ = ["MAP", "RATE", "momentum_rate", "own_centroidal_map"]


def own_centroidal_map(model: Any, q: Any) -> Any:
    """A_G, as the sum of the momenta of all bodies."""
    p_G, placement = tw.center_of_mass(model, q), tw.forward_kinematics(model, q).placement
    A_G = np.zeros((6, model.nv))
    for i in range(1, model.nbodies):
        J = tw.frame_jacobian(model, q, model.joint_names[i], reference="local")
        R, p = placement[i].rotation, placement[i].translation
        A_G = A_G + tw.force_transform(R, p - p_G) @ model.inertia[i].matrix() @ J
    return A_G


def _about_the_origin(model: Any, q: Any) -> Any:
    placement, p_G, A_G = (
        tw.forward_kinematics(model, q).placement,
        tw.center_of_mass(model, q),
        np.zeros((6, model.nv)),
    )
    for i in range(1, model.nbodies):
        J = tw.frame_jacobian(model, q, model.joint_names[i], reference="local")
        X_star = tw.force_transform(placement[i].rotation, placement[i].translation)
        A_G = A_G + X_star @ model.inertia[i].matrix() @ J
    return tw.force_transform(np.eye(3), -p_G) @ A_G


def momentum_rate(model: Any, q: Any, v: Any, a: Any) -> Any:
    """Rate of the centroidal momentum in a given motion."""
    p_G = tw.center_of_mass(model, q)
    placement, twists, accelerations = tw.forward_kinematics(model, q, v, a)
    rate = np.zeros(6)
    for body, T, V, A in zip(model.inertia, placement, np.array(twists), np.array(accelerations)):
        I = body.matrix()
        F = I @ A + tw.cross_force(V) @ I @ V
        rate = rate + tw.force_transform(T.rotation, T.translation - p_G) @ F
    return rate


def _at_mean(model: Any, q: Any) -> Any:
    """Return the plain mean of the bodies' centres of mass."""
    placement = tw.forward_kinematics(model, q).placement
    return np.mean([T.act(body.com) for body, T in zip(model.inertia[1:], placement[1:])], axis=0)


def _at_frames(model: Any, q: Any) -> Any:
    """Return the mean of the bodies' origins, weighted by the masses."""
    placement = tw.forward_kinematics(model, q).placement
    return sum(body.mass * T.translation for body, T in zip(model.inertia, placement)) / model.mass


def _spin(body: Any) -> Any:
    """Return the inertia of a body that has no mass: only its spin is left."""
    I = body.matrix()
    I[:3, 3:], I[3:, :3], I[:3, :3] = 0, 0, body.inertia_at_com
    return I


def _point(body: Any) -> Any:
    """Return the inertia of a body whose mass is all at its centre of mass."""
    I = body.matrix()
    I[:3, :3] -= body.inertia_at_com
    return I


def _heavier(body: Any) -> Any:
    """Return the inertia of a body, with that about its origin taken for that about its centre of mass."""
    I = body.matrix()
    I[:3, :3] += I[:3, :3] - body.inertia_at_com
    return I


def _rows(model: Any, q: Any) -> Any:
    """Exchange the rows of A_G alone."""
    A_G = tw.centroidal_map(model, q)
    return np.concatenate([A_G[k : k + 3] for k in (3, 0)])


def _motions(rng: Any) -> Any:
    return [(model, q, *rng.standard_normal((2, model.nv))) for model, q in [*states(rng)]]


MAP = Part(
    solution=own_centroidal_map,
    ways=(_about_the_origin,),
    returns=(Output("A_G", CENTROIDAL_MAP),),
    cases=lambda rng: [*states(rng)],
    slips={
        "momentum-at-origin": faulty(own_centroidal_map, ("tw.center_of_mass(model, q)", "np.zeros(3)")),
        "momentum-at-base": faulty(own_centroidal_map, ("tw.center_of_mass(model, q)", "q[:3]")),
        "unweighted-mean": faulty(own_centroidal_map, ("tw.center_of_mass(model, q)", "_at_mean(model, q)")),
        "frame-for-com": faulty(own_centroidal_map, ("tw.center_of_mass(model, q)", "_at_frames(model, q)")),
        "motion-for-force": faulty(own_centroidal_map, ("tw.force_transform", "tw.motion_transform")),
        "untransformed": faulty(own_centroidal_map, ("tw.force_transform(R, p - p_G) @ ", "")),
        "local-for-world": faulty(own_centroidal_map, ("tw.force_transform(R", "tw.force_transform(np.eye(3)")),
        "inverse-transform": faulty(
            own_centroidal_map, ("tw.force_transform(R, p - p_G)", "np.linalg.inv(tw.force_transform(R, p - p_G))")
        ),
        "mixed-frames": faulty(
            own_centroidal_map,
            ("tw.force_transform(R, p - p_G) @ model.inertia[i]", "model.inertia[i].transform(tw.SE3(R, p - p_G))"),
        ),
        "moments-not-moved": faulty(own_centroidal_map, ("p - p_G", "0 * p")),
        "inertia-of-origin": faulty(own_centroidal_map, ("model.inertia[i].matrix()", "_heavier(model.inertia[i])")),
        "spin-missing": faulty(own_centroidal_map, ("model.inertia[i].matrix()", "_point(model.inertia[i])")),
        "orbital-missing": faulty(own_centroidal_map, ("model.inertia[i].matrix()", "_spin(model.inertia[i])")),
        "rows-exchanged": _rows,
    },
    residuals=(lambda answer, model, q: answer[3:] - tw.newton_euler_3d.centroidal_map(model, q)[3:],),
)


def _by_vectors(model: Any, q: Any, v: Any, a: Any) -> Any:
    """Turn ω × l, ω × k and v × l into the rate one by one."""
    p_G = tw.center_of_mass(model, q)
    placement, twists, accelerations = tw.forward_kinematics(model, q, v, a)
    rate = np.zeros(6)
    for body, T, V, A in zip(model.inertia, placement, np.array(twists), np.array(accelerations)):
        h, F = body.matrix() @ V, body.matrix() @ A
        tau = F[:3] + np.cross(V[:3], h[:3]) + np.cross(V[3:], h[3:])
        f = F[3:] + np.cross(V[:3], h[3:])
        rate = rate + tw.force_transform(T.rotation, T.translation - p_G) @ np.concatenate([tau, f])
    return rate


RATE = Part(
    solution=momentum_rate,
    ways=(_by_vectors,),
    returns=(Output("ḣ_G", MOMENTUM),),
    cases=_motions,
    slips={
        "gyroscopic-missing": faulty(momentum_rate, (" + tw.cross_force(V) @ I @ V", "")),
        "gyroscopic-sign": faulty(momentum_rate, ("+ tw.cross_force", "- tw.cross_force")),
        "gyroscopic-of-rotation": faulty(
            momentum_rate, ("tw.cross_force(V) @ I @ V", "tw.cross_motion(V * np.repeat([1, 0], 3)) @ I @ V")
        ),
        "motion-cross-for-force": faulty(momentum_rate, ("tw.cross_force", "tw.cross_motion")),
        "classical-acceleration": faulty(
            momentum_rate, ("I @ A +", "I @ (A + np.concatenate([np.zeros(3), np.cross(V[:3], V[3:])])) +")
        ),
        "swapped-halves": swapped(momentum_rate),
        "rate-bias-missing": lambda model, q, v, a: tw.centroidal_map(model, q) @ a,
        "velocity-for-acceleration": lambda model, q, v, a: tw.centroidal_map(model, q) @ v,
        "moments-not-moved": faulty(momentum_rate, ("T.translation - p_G", "0 * p_G")),
        "momentum-at-origin": faulty(momentum_rate, ("tw.center_of_mass(model, q)", "np.zeros(3)")),
        "momentum-at-base": faulty(momentum_rate, ("tw.center_of_mass(model, q)", "q[:3]")),
        "gravity-in-rate": lambda model, q, v, a: (
            tw.centroidal_momentum_rate(model, q, v, a) - np.concatenate([np.zeros(3), model.mass * model.gravity])
        ),
    },
    residuals=(
        lambda answer, model, q, v, a: (answer - tw.newton_euler_3d.centroidal_momentum_rate(model, q, v, a))[3:],
    ),
)

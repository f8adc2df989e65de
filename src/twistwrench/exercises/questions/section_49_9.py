"""Answers to the questions of 49.9: what moves a floating base, what the ground can do, and the rank of J_c."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts

HIP_WIDTH, LEG = 0.0955, 0.426  # m, of Go2: from the hip's axis to the thigh, and thigh and calf together


def kick() -> Facts:
    """Effect of 1 N m at a knee on the trunk of Go2 in the air."""
    model = tw.load("go2")
    q, rest = model.standing(), np.zeros(model.nv)
    push = np.eye(model.nv)[model.v_slice[model.joint_id("FL_calf_joint")].start]
    change = tw.aba(model, q, rest, push) - tw.aba(model, q, rest, rest)
    turned, com = float(np.linalg.norm(change[:3])), tw.center_of_mass_acceleration(model, q, rest, change)
    truth = "nothing" if turned < 1e-9 else "turns" if np.linalg.norm(com) < 1e-9 else "flies"
    return {"truth": truth, "turned": turned}


def least() -> Facts:
    """Whether the least forces at the feet of a standing Go2 also need the least torques."""
    model = tw.load("go2")
    q = model.standing()
    held, J, g = tw.static_equilibrium(model, q), tw.contact_jacobian(model, q, model.feet), tw.gravity(model, q)
    free = np.linalg.svd(J[:, :6].mT)[2][6:].mT  # changes of the forces that the base does not notice
    change = free @ np.linalg.lstsq(J[:, 6:].mT @ free, held.tau)[0]
    best = (g - J.mT @ (held.forces.ravel() + change))[6:]
    sizes = float(np.linalg.norm(held.tau)), float(np.linalg.norm(best))
    return {"truth": "no" if sizes[1] < 0.99 * sizes[0] else "yes", "forces": sizes[0], "best": sizes[1]}


def tipping() -> Facts:
    """Push to the side, at the height of its base, at which two feet of a standing Go2 carry nothing more."""
    model = tw.load("go2")
    q = model.standing()
    rest, half_width = np.zeros(model.nv), tw.frame_placement(model, q, model.feet[0]).translation[1]
    f_ext = np.zeros((2, model.nbodies, 6))
    f_ext[1, 1, 4] = 1.0
    needed = tw.rnea(model, q, rest, rest, f_ext=f_ext)[:, :6]  # at the base: without the push, and with 1 N of it
    edge = tw.SE3(np.eye(3), [0, -half_width, q[2]]).force_transform()  # from the base to the floor below the left feet
    about = needed @ edge[0]  # the moment about the line through them: the right feet carry nothing if it is zero
    weight = 9.81 * model.mass
    return {"truth": float(-about[0] / (about[1] - about[0])), "weight": weight, "friction": 0.6 * weight}


def stretch() -> Facts:
    """Rank of J_c with all four legs stretched, the hips at zero."""
    return {"truth": float(np.linalg.matrix_rank(_stretched(0.0))), "legs": 8.0, "one": 11.0}


def upright() -> Facts:
    """Rank of J_c with all four legs stretched and parallel."""
    rank = np.linalg.matrix_rank(_stretched(np.arctan2(HIP_WIDTH, LEG)), tol=1e-9)
    return {"truth": float(rank), "full": 12.0, "legs": 8.0}


def calf() -> Facts:
    """Rank of J_c of two contact points on one calf."""
    model = tw.load("go2")
    J = tw.contact_jacobian(model, model.standing(), ["FL_foot", "FL_calf"])
    return {"truth": float(np.linalg.matrix_rank(J)), "six": 6.0, "three": 3.0}


def _stretched(hip: float) -> np.ndarray:
    """Return J_c of Go2 with straight knees and its hips turned outward by an angle."""
    model = tw.load("go2")
    q = model.standing()
    q[7::3], q[8::3], q[9::3] = np.array([-1, 1, -1, 1]) * hip, 0.0, 0.0
    return tw.contact_jacobian(model, q, model.feet)

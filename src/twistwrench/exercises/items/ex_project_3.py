"""The project, stage 3: the interface of the centroidal momentum."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after

from ..layouts import CENTROIDAL_MAP, CONTACT_JACOBIAN, JOINT_SPACE, MASS_MATRIX, MOMENTUM, WRENCH
from ..public import mine
from ..robots import larger, robot
from ..wrong import faulty, swap
from .project_momentum import MAP, RATE

__all__ = ["EXERCISE", "get_dynamics", "rate_and_wrench"]


def rate_and_wrench(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
    """Rate of the momentum out of the motion, and the wrench of what acts from outside."""
    acceleration, rate = mine("accelerated"), mine("momentum_rate")
    M, h, J_c = tw.crba(model, q), tw.nonlinear_effects(model, q, v), tw.contact_jacobian(model, q, model.feet)
    a = acceleration(M, h, tw.selection_matrix(model), J_c, tau, forces.ravel())
    feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
    moment = np.cross(feet - tw.center_of_mass(model, q), forces).sum(0)
    return rate(model, q, v, a), np.concatenate([moment, forces.sum(0) + model.mass * model.gravity])


def get_dynamics(model: Any, q: Any, v: Any, feet: Any) -> Any:
    """M, h, J_c and A_G."""
    M, h = tw.crba(model, q), tw.nonlinear_effects(model, q, v)
    J_c = np.vstack([tw.frame_jacobian(model, q, foot, reference="local_world_aligned")[3:] for foot in feet])
    return M, h, J_c, tw.centroidal_map(model, q)


def _falls(rng: Any) -> Any:
    model = robot("go2")
    return [
        (model, model.random_configuration(rng=rng), rng.standard_normal(18), *rng.normal(scale=10, size=(2, 12)))
        for _ in range(2)
    ]


def _about_the_origin(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
    """Move the wrench to the world's origin."""
    rate, wrench = rate_and_wrench(model, q, v, tau, forces)
    return rate, tw.force_transform(np.eye(3), tw.center_of_mass(model, q)) @ wrench


LAW = Part(
    solution=rate_and_wrench,
    given="""
        acceleration = mine("accelerated")  # of M, h, S, J_c, tau, forces: the accelerations
        rate = mine("momentum_rate")  # rate(model, q, v, a) is ḣ_G
""",
    returns=(Output("ḣ_G", MOMENTUM), Output("wrench from outside", WRENCH, zh="外部的 wrench")),
    cases=lambda rng: [(model, q, v, tau, forces.reshape(4, 3)) for model, q, v, tau, forces in _falls(rng)],
    slips={
        "contact-missing": faulty(rate_and_wrench, ("tau, forces.ravel()", "tau, 0 * forces.ravel()")),
        "force-sign": faulty(rate_and_wrench, ("tau, forces.ravel()", "tau, -forces.ravel()")),
        "bias-for-zero": faulty(rate_and_wrench, ("acceleration(M, h", "acceleration(M, 0 * h")),
        "velocity-terms-missing": faulty(
            rate_and_wrench, ("tw.nonlinear_effects(model, q, v)", "tw.gravity(model, q)")
        ),
        "rate-bias-missing": faulty(rate_and_wrench, ("rate(model, q, v, a)", "tw.centroidal_map(model, q) @ a")),
        "gravity-in-rate": faulty(
            rate_and_wrench,
            (
                "return rate(model, q, v, a)",
                "return rate(model, q, v, a) - np.concatenate([np.zeros(3), model.mass * model.gravity])",
            ),
        ),
        "gravity-missing": faulty(rate_and_wrench, (" + model.mass * model.gravity", "")),
        "weight-upward": faulty(rate_and_wrench, ("+ model.mass", "- model.mass")),
        "moment-about-origin": faulty(rate_and_wrench, (" - tw.center_of_mass(model, q)", "")),
        "wrench-about-origin": _about_the_origin,
        "base-for-com": faulty(rate_and_wrench, ("tw.center_of_mass(model, q)", "q[:3]")),
        "lever-reversed": faulty(rate_and_wrench, ("moment = np", "moment = -np")),
        "swapped-halves": after(rate_and_wrench, swap),
    },
    residuals=(lambda answer, model, q, v, tau, forces: answer[0] - answer[1],),
)


def _states(rng: Any) -> Any:
    """Return states of Go2 on all feet and on two, and of a smaller robot; the feet in any order."""
    feet = (("RL_foot", "FR_foot", "RR_foot", "FL_foot"), ("RL_foot", "FR_foot"))
    other, posture = larger(rng)[0]
    return [
        *((model, q, v, names) for (model, q, v, _, _), names in zip(_falls(rng), feet)),
        (other, posture, rng.standard_normal(other.nv), tuple(other.joint_names[3:1:-1])),
    ]


INTERFACE = Part(
    solution=get_dynamics,
    returns=(
        Output("M", MASS_MATRIX),
        Output("h", JOINT_SPACE),
        Output("J_c", CONTACT_JACOBIAN),
        Output("A_G", CENTROIDAL_MAP),
    ),
    cases=_states,
    slips={
        "doubled-off-diagonal": faulty(get_dynamics, ("return M", "return doubled(M)")),
        "one-triangle": faulty(get_dynamics, ("return M", "return np.triu(M)")),
        "velocity-terms-missing": faulty(get_dynamics, ("tw.nonlinear_effects(model, q, v)", "tw.gravity(model, q)")),
        "gravity-missing": faulty(get_dynamics, ("return M, h", "return M, h - tw.gravity(model, q)")),
        "base-missing": faulty(get_dynamics, ("return M, h", "return M, h[6:]")),
        "angular-for-linear": faulty(get_dynamics, ("[3:]", "[:3]")),
        "axis-by-axis": faulty(
            get_dynamics, ("return M, h, J_c", "return M, h, np.concatenate([J_c[axis::3] for axis in range(3)])")
        ),
        "feet-of-model": faulty(get_dynamics, ("h, J_c,", "h, tw.contact_jacobian(model, q, model.feet),")),
        "contact-rows-all": faulty(get_dynamics, ("[3:]", "")),
        "local-for-aligned": faulty(get_dynamics, ("local_world_aligned", "local")),
        "world-for-aligned": faulty(get_dynamics, ("local_world_aligned", "world")),
        "momentum-at-origin": faulty(
            get_dynamics,
            ("tw.centroidal_map", "tw.force_transform(np.eye(3), tw.center_of_mass(model, q)) @ tw.centroidal_map"),
        ),
        "momentum-at-base": faulty(
            get_dynamics,
            (
                "tw.centroidal_map",
                "tw.force_transform(np.eye(3), tw.center_of_mass(model, q) - q[:3]) @ tw.centroidal_map",
            ),
        ),
        "swapped-halves": faulty(
            get_dynamics,
            (
                "return M, h, J_c, tw.centroidal_map(model, q)",
                "return swap(M), swap(h), np.array([*map(swap, J_c)]), swap(tw.centroidal_map(model, q))",
            ),
        ),
    },
    residuals=(lambda answer, model, q, v, feet: answer[3] - _from_base(model, q) @ answer[0][:6],),
)


def _from_base(model: Any, q: Any) -> Any:
    """Return the X* that takes a wrench from the base's frame to the centre of mass."""
    T = tw.forward_kinematics(model, q).placement[1]
    return tw.force_transform(T.rotation, T.translation - tw.center_of_mass(model, q))


EXERCISE = Exercise(id="project.3", kind="code", parts=(MAP, RATE, LAW, INTERFACE))

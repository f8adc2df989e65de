"""The project, stage 3: the interface of the centroidal momentum."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import CENTROIDAL_MAP, CONTACT_JACOBIAN, JOINT_SPACE, MASS_MATRIX, MOMENTUM, WRENCH
from ..robots import robot, small_robot
from ..workbook import mine
from ..wrong import after, swap
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


def _accelerated(model: Any, q: Any, v: Any, tau: Any, forces: Any, h: Any = None) -> Any:
    h = tw.nonlinear_effects(model, q, v) if h is None else h
    given = np.concatenate([np.zeros(6), tau]) + tw.contact_jacobian(model, q, model.feet).mT @ forces.ravel() - h
    return np.linalg.solve(tw.crba(model, q), given)


def _wrench(model: Any, q: Any, forces: Any, point: Any = None, weight: float = 1.0) -> Any:
    point = tw.center_of_mass(model, q) if point is None else point
    feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
    moment = np.cross(feet - point, forces).sum(0)
    return np.concatenate([moment, forces.sum(0) + weight * model.mass * model.gravity])


def _rate(change: Any) -> Any:
    """Find the rate otherwise, and the wrench as it is."""
    return lambda model, q, v, tau, forces: (change(model, q, v, tau, forces), _wrench(model, q, forces))


def _law(change: Any) -> Any:
    """Find the wrench otherwise, and the rate as it is."""

    def wrong(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
        rate = tw.centroidal_momentum_rate(model, q, v, _accelerated(model, q, v, tau, forces))
        return rate, change(model, q, forces)

    return wrong


def _of(acceleration: Any) -> Any:
    """Find the rate from another acceleration."""
    return _rate(
        lambda model, q, v, tau, forces: tw.centroidal_momentum_rate(
            model, q, v, acceleration(model, q, v, tau, forces)
        )
    )


def _uncarried(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
    return tw.centroidal_map(model, q) @ _accelerated(model, q, v, tau, forces)


def _weighed(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
    rate = tw.centroidal_momentum_rate(model, q, v, _accelerated(model, q, v, tau, forces))
    return rate - np.concatenate([np.zeros(3), model.mass * model.gravity])


def _falls(rng: Any) -> Any:
    model = robot("go2")
    return [
        (model, model.random_configuration(rng=rng), rng.standard_normal(18), *rng.normal(scale=10, size=(2, 12)))
        for _ in range(2)
    ]


LAW = Part(
    solution=rate_and_wrench,
    given="""
        acceleration = mine("accelerated")  # of M, h, S, J_c, tau, forces: the accelerations
        rate = mine("momentum_rate")  # rate(model, q, v, a) is ḣ_G
""",
    returns=(Quantity("ḣ_G", MOMENTUM), Quantity("wrench from outside", WRENCH)),
    cases=lambda rng: [(model, q, v, tau, forces.reshape(4, 3)) for model, q, v, tau, forces in _falls(rng)],
    slips={
        "contact-missing": _of(lambda model, q, v, tau, forces: _accelerated(model, q, v, tau, 0 * forces)),
        "force-sign": _of(lambda model, q, v, tau, forces: _accelerated(model, q, v, tau, -forces)),
        "bias-for-zero": _of(lambda model, q, v, tau, forces: _accelerated(model, q, v, tau, forces, np.zeros(18))),
        "velocity-terms-missing": _of(
            lambda model, q, v, tau, forces: _accelerated(model, q, v, tau, forces, tw.gravity(model, q))
        ),
        "rate-bias-missing": _rate(_uncarried),
        "gravity-in-rate": _rate(_weighed),
        "gravity-missing": _law(lambda model, q, forces: _wrench(model, q, forces, weight=0)),
        "weight-upward": _law(lambda model, q, forces: _wrench(model, q, forces, weight=-1)),
        "moment-about-origin": _law(lambda model, q, forces: _wrench(model, q, forces, np.zeros(3))),
        "base-for-com": _law(lambda model, q, forces: _wrench(model, q, forces, q[:3])),
        "lever-reversed": _law(lambda model, q, forces: _wrench(model, q, forces) * np.repeat([-1, 1], 3)),
        "swapped-halves": after(rate_and_wrench, swap),
    },
    residuals=(lambda answer, model, q, v, tau, forces: answer[0] - answer[1],),
)


def _replaced(k: int, by: Any) -> Any:
    """Replace one of the four things."""

    def wrong(model: Any, q: Any, v: Any, feet: Any) -> Any:
        answer = list(get_dynamics(model, q, v, feet))
        answer[k] = by(model, q, v, feet, answer[k])
        return tuple(answer)

    return wrong


def _jacobians(rows: Any = slice(3, 6), reference: Any = "local_world_aligned") -> Any:
    """Stack other rows of other Jacobians."""
    return _replaced(
        2,
        lambda model, q, v, feet, J_c: np.vstack(
            [tw.frame_jacobian(model, q, foot, reference=reference)[rows] for foot in feet]
        ),
    )


def _about(point: Any) -> Any:
    """Take the angular momentum about another point: it gains (p_G − point) × l."""
    return _replaced(
        3,
        lambda model, q, v, feet, A_G: np.concatenate(
            [A_G[:3] + tw.skew(tw.center_of_mass(model, q) - point(q)) @ A_G[3:], A_G[3:]]
        ),
    )


def _in_pinocchio_order(model: Any, q: Any, v: Any, feet: Any) -> Any:
    M, h, J_c, A_G = get_dynamics(model, q, v, feet)
    return swap(M), swap(h), np.array([swap(row) for row in J_c]), swap(A_G)


def _states(rng: Any) -> Any:
    """Return states of Go2 on all feet and on two, and of a smaller robot."""
    feet = (robot("go2").feet, ("FR_foot", "RL_foot"))
    other = small_robot(rng)
    return [
        *((model, q, v, names) for (model, q, v, _, _), names in zip(_falls(rng), feet)),
        (other, other.random_configuration(rng=rng), rng.standard_normal(other.nv), tuple(other.joint_names[2:4])),
    ]


INTERFACE = Part(
    solution=get_dynamics,
    returns=(
        Quantity("M", MASS_MATRIX),
        Quantity("h", JOINT_SPACE),
        Quantity("J_c", CONTACT_JACOBIAN),
        Quantity("A_G", CENTROIDAL_MAP),
    ),
    cases=_states,
    slips={
        "doubled-off-diagonal": _replaced(0, lambda model, q, v, feet, M: 2 * M - np.diag(np.diag(M))),
        "one-triangle": _replaced(0, lambda model, q, v, feet, M: np.triu(M)),
        "velocity-terms-missing": _replaced(1, lambda model, q, v, feet, h: tw.gravity(model, q)),
        "gravity-missing": _replaced(1, lambda model, q, v, feet, h: h - tw.gravity(model, q)),
        "base-missing": _replaced(1, lambda model, q, v, feet, h: h[6:]),
        "angular-for-linear": _jacobians(slice(0, 3)),
        "contact-rows-all": _jacobians(slice(0, 6)),
        "local-for-aligned": _jacobians(reference="local"),
        "world-for-aligned": _jacobians(reference="world"),
        "momentum-at-origin": _about(lambda q: np.zeros(3)),
        "momentum-at-base": _about(lambda q: q[:3]),
        "swapped-halves": _in_pinocchio_order,
    },
    residuals=(lambda answer, model, q, v, feet: answer[3] - _from_base(model, q) @ answer[0][:6],),
)


def _from_base(model: Any, q: Any) -> Any:
    """Return the X* that takes a wrench from the base's frame to the centre of mass."""
    T = tw.forward_kinematics(model, q).placement[1]
    return tw.force_transform(T.rotation, T.translation - tw.center_of_mass(model, q))


EXERCISE = Exercise(
    id="project.3",
    kind="code",
    parts=(MAP, RATE, LAW, INTERFACE),
)

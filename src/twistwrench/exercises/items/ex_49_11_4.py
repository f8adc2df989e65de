"""Exercise 49.11.4: what Pinocchio returns, in the chapter's order."""

from functools import partial
from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after

from ..layouts import CENTROIDAL_MAP, JACOBIAN, JOINT_SPACE
from ..robots import ball_robots, small_robot
from ..wrong import faulty, swap, swapped

__all__ = ["EXERCISE", "acceleration_from_pinocchio", "jacobian_from_pinocchio", "map_from_pinocchio"]


def map_from_pinocchio(model: Any, q: Any) -> Any:
    """A_G."""
    import pinocchio as pin

    order = [3, 4, 5, 0, 1, 2, *range(6, model.nv)]
    A_G = pin.computeCentroidalMap(model, model.createData(), q)
    return A_G[np.ix_(order[:6], order)]


def jacobian_from_pinocchio(model: Any, q: Any, frame: Any) -> Any:
    """J of a frame, in the world's axes."""
    import pinocchio as pin

    order, number = [3, 4, 5, 0, 1, 2, *range(6, model.nv)], model.getFrameId(frame)
    J = pin.computeFrameJacobian(model, model.createData(), q, number, pin.LOCAL_WORLD_ALIGNED)
    return J[np.ix_(order[:6], order)]


def acceleration_from_pinocchio(model: Any, q: Any, v: Any, tau: Any) -> Any:
    """Accelerations by ABA."""
    import pinocchio as pin

    order = [3, 4, 5, 0, 1, 2, *range(6, model.nv)]
    return pin.aba(model, model.createData(), q, v[order], tau[order])[order]


def _robots(rng: Any, *, vectors: int = 0) -> Any:
    """Return random robots as Pinocchio's models, each with a configuration and so many vectors."""
    robots = [small_robot(rng) for _ in range(3)]
    return [
        (tw.bridge.to_pinocchio_model(model), model.random_configuration(rng=rng), *rng.standard_normal((vectors, 9)))
        for model in robots
    ]


def _with_balls(rng: Any, *, vectors: int = 0) -> Any:
    """Return a robot with ball joints and joints that turn without end, where nq is not nv + 1."""
    model = ball_robots()[0]
    q, more = model.random_configuration(rng=rng), rng.standard_normal((vectors, model.nv))
    return [(tw.bridge.to_pinocchio_model(model), q, *more)]


def _frames(rng: Any) -> Any:
    """Return robots, configurations and the name of a frame: of a joint, or of a tool, beside others that it is not."""
    cases = []
    for (model, q), wanted in zip(_robots(rng), (None, "tool_1", "tool_2")):
        _add_tools(model, rng)
        cases.append((model, q, wanted or model.names[int(rng.integers(2, model.njoints))]))
    return cases


def _add_tools(model: Any, rng: Any) -> None:
    """Add frames of numbers in a row to one body, each at another place and turned in another way."""
    import pinocchio as pin

    body = int(rng.integers(2, model.njoints))
    for k in range(4):
        place = pin.SE3(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3))
        model.addFrame(pin.Frame(f"tool_{k}", body, 0, place, pin.FrameType.OP_FRAME))


def _here(model: Any) -> Any:
    return tw.bridge.from_pinocchio_model(model)


def _about_origin(model: Any, q: Any, A_G: Any) -> Any:
    """Move the momentum from the centre of mass to the world's origin."""
    c = tw.center_of_mass(_here(model), q)
    return np.concatenate([A_G[:3] + tw.skew(c) @ A_G[3:], A_G[3:]])


_map, _jacobian, _acceleration = (
    partial(faulty, f) for f in (map_from_pinocchio, jacobian_from_pinocchio, acceleration_from_pinocchio)
)
ROWS = ("np.ix_(order[:6], order)", "order[:6]")
COLUMNS = ("[np.ix_(order[:6], order)]", "[:, order]")
ROLLED = ("np.ix_(order[:6], order)", "np.ix_(order[:6], np.roll(np.arange(model.nv), 3))")

_in_own_axes = _jacobian(("pin.LOCAL_WORLD_ALIGNED", "pin.LOCAL"))


def _rows_of_base_only(x: Any) -> Any:
    """Exchange the rows back in the columns of the joints."""
    return np.hstack([x[:, :6], swap(x)[:, 6:]])


def _turning(v: Any) -> Any:
    """Return ω × v of the base, where it stands among the accelerations."""
    return np.concatenate([np.zeros(3), np.cross(v[:3], v[3:6]), np.zeros(len(v) - 6)])


MAP = Part(
    solution=map_from_pinocchio,
    returns=(Output("A_G", CENTROIDAL_MAP),),
    cases=_robots,
    edges=_with_balls,
    slips={
        "swapped-halves": swapped(map_from_pinocchio),
        "rows-only": _map(ROWS),
        "columns-only": _map(COLUMNS),
        "base-block-only": after(map_from_pinocchio, _rows_of_base_only),
        "joints-moved": _map(ROLLED),
        "reversed": _map(("3, 4, 5, 0, 1, 2", "5, 4, 3, 2, 1, 0")),
        "momentum-at-origin": lambda model, q: _about_origin(model, q, map_from_pinocchio(model, q)),
    },
    residuals=(lambda answer, model, q: answer - tw.centroidal_map(_here(model), q),),
)


JACOBIAN_PART = Part(
    solution=jacobian_from_pinocchio,
    returns=(Output("J", JACOBIAN),),
    cases=_frames,
    edges=lambda rng: [(model, q, model.names[-1]) for model, q in _with_balls(rng)],
    slips={
        "swapped-halves": swapped(jacobian_from_pinocchio),
        "rows-only": _jacobian(ROWS),
        "columns-only": _jacobian(COLUMNS),
        "base-block-only": after(jacobian_from_pinocchio, _rows_of_base_only),
        "joints-moved": _jacobian(ROLLED),
        "half-rotated": lambda model, q, frame: np.vstack(
            [_in_own_axes(model, q, frame)[:3], jacobian_from_pinocchio(model, q, frame)[3:]]
        ),
        "local-for-aligned": _in_own_axes,
        "world-for-aligned": _jacobian(("pin.LOCAL_WORLD_ALIGNED", "pin.WORLD")),
    },
    residuals=(
        lambda answer, model, q, frame: (
            answer - tw.frame_jacobian(_here(model), q, frame, reference="local_world_aligned")
        ),
    ),
)

ACCELERATION = Part(
    solution=acceleration_from_pinocchio,
    returns=(Output("q̈", JOINT_SPACE),),
    cases=partial(_robots, vectors=2),
    edges=partial(_with_balls, vectors=2),
    rtol=1e-8,
    slips={
        "swapped-halves": _acceleration(("v[order], tau[order])[order]", "v, tau)")),
        "input-unconverted": _acceleration(("v[order], tau[order]", "v, tau")),
        "output-unconverted": _acceleration((")[order]", ")")),
        "forces-unconverted": _acceleration(("tau[order]", "tau")),
        "classical-acceleration": _acceleration(("return pin", "return _turning(v) + pin")),
        "classical-subtracted": _acceleration(("return pin", "return -_turning(v) + pin")),
        "velocity-terms-missing": _acceleration(("v[order]", "0 * v")),
        "torques-missing": _acceleration(("tau[order]", "0 * tau")),
    },
    residuals=(lambda answer, model, q, v, tau: tw.rnea(_here(model), q, v, answer) - tau,),
)

EXERCISE = Exercise(id="49.11.4", kind="code", parts=(MAP, JACOBIAN_PART, ACCELERATION), needs="pinocchio")

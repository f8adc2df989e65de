"""The numbers of robots that the objects of hands/ show: computed by the package when the site is built."""

from __future__ import annotations

from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench.plot.robot import sticks
from twistwrench.plot.stride import sides

__all__ = ["feet", "felt", "film"]


def feet() -> dict[str, Any]:
    """Return a standing Go2: its sticks, its weight, N, where its centre of mass and its feet are, and their names."""
    model = tw.load("go2")
    q = model.standing()
    return {
        "sticks": _rounded(sticks(model, q), 4),
        "sides": sides(model).tolist(),
        "weight": model.mass * -float(model.gravity[2]),
        "com": tw.center_of_mass(model, q).tolist(),
        "names": [foot.removesuffix("_foot") for foot in model.feet],
        "feet": [tw.frame_placement(model, q, foot).translation.tolist() for foot in model.feet],
    }


def felt() -> dict[str, Any]:
    """Return the inertia of a rod of 1 m and 1 kg that hangs from its joint."""
    return {"inertia": tw.chain(1).inertia[1].matrix().tolist()}


def film() -> dict[str, Any]:
    """Return the RNEA of a Go2 that walks off, body by body: held by its base in the air, and on its feet.

    On its feet the ground gives the least forces that carry the motion; they are wrenches on the calves from outside.
    """
    model = tw.load("go2")
    q, (v, a) = model.standing(), np.zeros((2, model.nv))
    v[2], v[3], a[3] = 0.6, 0.8, 2.0
    v[7:9], a[7:9] = (-5.0, 4.0), (30.0, 90.0)  # the thigh and the calf of the left front leg, which is in the air
    standing = [foot for foot in model.feet if not foot.startswith("FL")]
    ground = np.zeros((model.nbodies, 6))
    points = [tw.PointContact(foot, 0.6) for foot in standing]
    forces = tw.contact_inverse_dynamics(model, q, v, a, points).forces
    at = tw.forward_kinematics(model, q).placement
    for foot in standing:
        body = model.frames[foot].body
        here = at[body].inverse() @ tw.SE3(np.eye(3), tw.frame_placement(model, q, foot).translation)
        ground[body] += here.force_transform() @ [0, 0, 0, *forces[foot]]
    cases = [tw.rnea_terms(model, q, v, a, f_ext) for f_ext in (None, ground)]
    return {
        "names": ["world", "base", *(name.removesuffix("_joint") for name in model.joint_names[2:])],
        "parent": list(model.parent),
        "R": [_rounded(at[i].rotation, 5) for i in range(model.nbodies)],
        "p": [_rounded(at[i].translation, 4) for i in range(model.nbodies)],
        "sticks": _rounded(sticks(model, q), 4),
        "V": _rounded(np.stack(cases[0].V), 4),
        "F": [_rounded(np.stack(case.F), 3) for case in cases],
        "tau": [_rounded(tw.rnea(model, q, v, a, f_ext)[6:], 3) for f_ext in (None, ground)],
        "feet": [
            [_rounded(tw.frame_placement(model, q, foot).translation, 4), _rounded(forces[foot], 3)]
            for foot in standing
        ],
    }


def _rounded(x: Any, digits: int) -> Any:
    return np.round(np.asarray(x), digits).tolist()

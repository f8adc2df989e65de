"""The numbers of robots that the objects of hands/ show: computed by the package when the site is built."""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.plot.robot import sticks
from twistwrench.plot.stride import sides
from twistwrench.tracing.anchors import anchors
from twistwrench.tracing.stepper import formula
from twistwrench.tracing.words import FORMULAS

__all__ = ["feet", "felt", "film", "walk"]

FILMED = ("49.6 V", "49.6 F_p")
"""The line of each pass that the film shows: outward, inward."""


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


class Walk(NamedTuple):
    """A Go2 that walks off, its left front leg in the air."""

    model: tw.Model
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    forces: dict[str, np.ndarray]
    """Of the ground on the other feet, N, in the world: the least that carry the motion."""
    ground: np.ndarray
    """The same forces as wrenches on the bodies, in their frames."""


@cache
def walk() -> Walk:
    """Return a Go2 that turns, speeds up, and swings its left front leg."""
    model = tw.load("go2")
    q, (v, a) = model.standing(), np.zeros((2, model.nv))
    v[2], v[3], a[3] = 0.6, 0.8, 2.0
    v[7:9], a[7:9] = (-5.0, 4.0), (30.0, 90.0)  # the thigh and the calf of the left front leg, which is in the air
    standing = [foot for foot in model.feet if not foot.startswith("FL")]
    ground = np.zeros((model.nbodies, 6))
    points = [tw.PointContact(foot, 0.6) for foot in standing]
    found = tw.contact_inverse_dynamics(model, q, v, a, points).forces
    at = tw.forward_kinematics(model, q).placement
    for foot in standing:
        body = model.frames[foot].body
        here = at[body].inverse() @ tw.SE3(np.eye(3), tw.frame_placement(model, q, foot).translation)
        ground[body] += here.force_transform() @ [0, 0, 0, *found[foot]]
    return Walk(model, q, v, a, {foot: found[foot] for foot in standing}, ground)


def film() -> dict[str, Any]:
    """Return the RNEA of a Go2 that walks off, body by body: held by its base in the air, and on its feet.

    On its feet the ground gives the least forces that carry the motion; they are wrenches on the calves from outside.
    """
    model, q, v, a, forces, ground = walk()
    at = tw.forward_kinematics(model, q).placement
    cases = [tw.rnea_terms(model, q, v, a, f_ext) for f_ext in (None, ground)]
    numbers = [{"i": i, "p": model.parent[i]} for i in range(1, model.nbodies)]
    return {
        "names": ["world", "base", *(name.removesuffix("_joint") for name in model.joint_names[2:])],
        "parent": list(model.parent),
        "lines": [anchors()[name].line.partition("  #")[0] for name in FILMED],
        "formulas": [["", *(formula(FORMULAS[name], of) for of in numbers)] for name in FILMED],
        "R": [_rounded(at[i].rotation, 5) for i in range(model.nbodies)],
        "p": [_rounded(at[i].translation, 4) for i in range(model.nbodies)],
        "sticks": _rounded(sticks(model, q), 4),
        "V": _rounded(np.stack(cases[0].V), 4),
        "F": [_rounded(np.stack(case.F), 3) for case in cases],
        "tau": [_rounded(tw.rnea(model, q, v, a, f_ext)[6:], 3) for f_ext in (None, ground)],
        "feet": [
            [_rounded(tw.frame_placement(model, q, foot).translation, 4), _rounded(force, 3)]
            for foot, force in forces.items()
        ],
    }


def _rounded(x: Any, digits: int) -> Any:
    return np.round(np.asarray(x), digits).tolist()

"""Bad calls: every public function, every argument, some forty values that it cannot be."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import is_dataclass
from decimal import Decimal
from fractions import Fraction
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.scene.costs import Costs

from .robots import shared

FOLDERS = ["", ".bridge", ".fast", ".motions", ".newton_euler_3d", ".plot", ".templates"]
GO2 = shared("go2")
FEET = [tw.PointContact(foot, 0.6) for foot in GO2.feet]
REST, STAND = np.zeros(GO2.nv), GO2.standing()
SCENE = tw.Scene("go2", contacts=FEET)
HELD = tw.lock_joints(GO2, ["FR_hip_joint"], STAND)
BODY = GO2.inertia[1]
WALK = tw.motions.walk(GO2, samples=2)
MASS = tw.templates.PointMass.of(GO2, STAND)

MADE_BY_HAND = ["SE3", "Baumgarte", "Builder", "Continuous", "Ground", "PointContact", "Prismatic", "Revolute", "Scene"]
MADE_BY_HAND += ["SpatialInertia", "SurfaceContact", "Twist", "Wrench", "motions.Motion"]
MADE_BY_HAND += ["Coupling", "DistanceConstraint", "LoopClosure", "SlidingContact", "SphereContact"]
"""The classes whose constructors take what a user types; functions fill in the others."""

LEFT_OUT = {"axes_2d", "axes_3d", "import_pinocchio", "robots", "Template"}
LEFT_OUT |= {"from_mujoco_model", "from_pinocchio_inertia", "from_pinocchio_model", "from_pinocchio_se3"}
LEFT_OUT |= {"advise"}  # it measures for seconds; its own tests make its bad calls
LEFT_OUT |= {"prepare"}  # it takes names alone, and its own tests give it others
NOT_SWEPT = {"colour", "label", "text", "title", "progress", "com", "inward", "alpha", "there"}
"""Arguments that matplotlib takes as they are, that are true or false, and Pinocchio's own objects."""

METHODS = {
    "Builder.build": lambda **given: bodies().build(**given),
    "Builder.link": lambda **given: bodies().link(**given),
    "Model.d_difference": GO2.d_difference,
    "Model.d_integrate": GO2.d_integrate,
    "Model.difference": GO2.difference,
    "Model.distance": GO2.distance,
    "Model.frame": GO2.frame,
    "Model.integrate": GO2.integrate,
    "Model.interpolate": GO2.interpolate,
    "Model.joint_id": GO2.joint_id,
    "Model.normalize": GO2.normalize,
    "Model.random_configuration": GO2.random_configuration,
    "Model.support": GO2.support,
    "Reduction.expand": HELD.expand,
    "Reduction.reduce": HELD.reduce,
    "SE3.act": tw.SE3.identity().act,
    "SE3.from_matrix": tw.SE3.from_matrix,
    "Scene.can_stand": SCENE.can_stand,
    "Scene.cheapest": SCENE.cheapest,
    "Scene.dynamics": SCENE.dynamics,
    "Scene.expand": SCENE.expand,
    "Scene.f_ext": SCENE.f_ext,
    "Scene.phases": SCENE.phases,
    "Scene.reduce": SCENE.reduce,
    "SpatialInertia.from_box": tw.SpatialInertia.from_box,
    "SpatialInertia.from_capsule": tw.SpatialInertia.from_capsule,
    "SpatialInertia.from_matrix": tw.SpatialInertia.from_matrix,
    "SpatialInertia.from_mesh": tw.SpatialInertia.from_mesh,
    "SpatialInertia.from_parameters": tw.SpatialInertia.from_parameters,
    "SpatialInertia.from_point": tw.SpatialInertia.from_point,
    "SpatialInertia.from_pseudo_inertia": tw.SpatialInertia.from_pseudo_inertia,
    "SpatialInertia.kinetic_energy": BODY.kinetic_energy,
    "SpatialInertia.momentum": BODY.momentum,
    "SpatialInertia.transform": BODY.transform,
    "Template.rate": MASS.rate,
    "Template.residual": MASS.residual,
    "Twist.transform": tw.Twist(np.ones(6)).transform,
    "Twist.from_screw": tw.Twist.from_screw,
    "Wrench.from_force": tw.Wrench.from_force,
    "Wrench.transform": tw.Wrench(np.ones(6)).transform,
}
SIGNATURES = {"Builder.build": tw.Builder("b").build, "Builder.link": tw.Builder("b").link}

GOOD: dict[str, Any] = {
    "A": np.eye(3),
    "F": np.array([0, -1.0, 0, 0, 0, 100]),
    "I6": BODY.matrix(),
    "J": np.zeros((6, GO2.nv)),
    "J_c": np.zeros((12, GO2.nv)),
    "M": np.eye(GO2.nv),
    "R": np.eye(3),
    "T": tw.SE3.identity(),
    "T0": tw.SE3.identity(),
    "T1": tw.SE3.identity(),
    "V": np.ones(6),
    "X": np.eye(6),
    "a": REST,
    "algorithm": "crba",
    "anchors": tw.contact_placements(GO2, STAND, FEET),
    "at": np.zeros(2),
    "axis": "z",
    "body": 2,
    "com": np.zeros(3),
    "contacts": FEET,
    "corners": np.array([[0.1, 0.05, 0], [0.1, -0.05, 0], [-0.1, -0.05, 0]]),
    "dt": 0.01,
    "duration": 0.02,
    "f_ext": np.zeros((GO2.nbodies, 6)),
    "feet": (),
    "forces": np.ones((4, 3)),
    "frame": "FR_foot",
    "frequency": 5.0,
    "half_size": (0.1, 0.05),
    "inertia": BODY,
    "inertia_at_com": np.eye(3),
    "joints": ["FR_hip_joint"],
    "mass": 1.0,
    "model": GO2,
    "motion": WALK,
    "mu": 0.5,
    "n": 2,
    "name": "tip",
    "normals": np.array([0.0, 0, 1]),
    "p": np.zeros(3),
    "parent": "base_link",
    "point": np.zeros(3),
    "points": np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]),
    "q": STAND,
    "q0": STAND,
    "q1": STAND,
    "robot": GO2,
    "rotation": np.eye(3),
    "samples": 4,
    "source": "go2",
    "steps": 1,
    "t": WALK.t,
    "tau": REST,
    "texts": [""] * GO2.nbodies,
    "tolerance": 0.1,
    "translation": np.zeros(3),
    "u": 0.5,
    "v": REST,
    "v_dt": REST,
    "vector": np.ones(6),
    "vectors": np.ones(3),
    "w": np.ones(3),
    "x": np.ones(6),
    "size": np.ones(3),
    "radius": 0.1,
    "ratios": {"FL_hip_joint": -2.0},
    "to": "FL_foot",
    "length": 0.5,
    "P": np.eye(4),
    "faces": np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
    "vertices": np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
}
"""A good value for every argument that must be given."""

SPECIAL: dict[str, dict[str, Any]] = {
    "Builder.link": {"joint": tw.Revolute("y"), "inertia": BODY, "placement": tw.SE3.identity()},
    "Model.frame": {"name": "FR_foot"},
    "Model.joint_id": {"name": "FR_hip_joint"},
    "SpatialInertia.from_parameters": {"p": BODY.parameters()},
    "attach": {"model": GO2, "other": GO2, "frame": "base", "prefix": "second_"},
    "bridge.from_mujoco_configuration": {"qpos": STAND},
    "replace_inertia": {"inertia": BODY},
    "Twist.from_screw": {"axis": np.ones(3), "frame": "base"},
    "Wrench.from_force": {"force": np.ones(3), "frame": "base"},
    "from_dh": {"a": np.ones(2), "alpha": np.zeros(2), "d": np.zeros(2), "convention": "classical"},
    "from_screw_axes": {"M": np.eye(4), "Slist": np.eye(6)[:, :2]},
    "screw_axes": {"model": shared("planar_arm"), "frame": "tool"},
    "bridge.from_pinocchio_f_ext": {"f_ext": [np.zeros(6)] * GO2.nbodies},
    "compile": {"want": "gravity", "contacts": GO2.feet},
    "contact_jacobian": {"contacts": GO2.feet},
    "motions.Motion": {name: getattr(WALK, name) for name in ("name", "t", "q", "v", "a", "feet", "contacts")},
    "Reduction.expand": {"q": HELD.reduce(STAND, REST)[0], "v": REST[:-1]},
    "SE3.from_matrix": {"T": np.eye(4)},
    "force_transform": {"p": np.zeros(3)},
    "motion_transform": {"p": np.zeros(3)},
    "bridge.from_pinocchio_force": {"F": np.ones(6)},
    "operational_space_inertia": {"J": np.eye(6, GO2.nv)},
    "plot.arrows": {"points": np.zeros(3), "texts": ["a"]},
    "plot.apparent_mass_ellipse": {"inertia": BODY.matrix()},
    "plot.foot_forces": {"contacts": GO2.feet},
    "static_equilibrium": {"contacts": GO2.feet},
    "unskew": {"M": tw.skew([1.0, 2, 3])},
    "vee": {"M": tw.hat(np.ones(6))},
    "view": {"contacts": GO2.feet},
    "simulate": {"steps": 1},
    "log6": {"T": tw.SE3.identity()},
    "exp6": {"V": np.ones(6)},
    "ask": {"name": "49.7-tip", "guess": "a"},
    "advise": {"use": "simulation"},
}
CALLED = {
    "ask": {"name": "question", "guess": "letters"},
    "motion_error": {"dt": "duration"},
    "Builder": {"root": "link", "root_inertia": "inertia"},
    "Builder.build": {"postures": "posture"},
    "Builder.link": {"name": "link", "joint_name": "joint"},
    "Model.frame": {"name": "frame"},
    "Model.joint_id": {"name": "joint"},
    "Scene": {"robot": "robot|file"},
    "Scene.cheapest": {"groups": "names? or patterns|joint", "tolerance": "tolerance|quantity"},
    "contact_forward_dynamics": {"v": "all arguments", "tau": "all arguments"},
    "contact_inverse_dynamics": {"v": "all arguments", "a": "all arguments"},
    "force_transform": {"R": "rotation", "p": "translation"},
    "friction_inverse_dynamics": {"v": "all arguments", "a": "all arguments"},
    "impact": {"v": "all arguments"},
    "DistanceConstraint": {"to": "frame"},
    "LoopClosure": {"to": "frame"},
    "SlidingContact": {"to": "frame"},
    "load": {"source": "robot|file"},
    "motion_transform": {"R": "rotation", "p": "translation"},
    "motions.Motion": {"t": "contacts", "v": "a", "feet": "contacts"},
    "plot.arrows": {"points": "arrows", "vectors": "arrows"},
    "plot.foot_forces": {"contacts": "forces"},
    "power": {"F": "power", "V": "power"},
    "project_state": {"v": "all arguments"},
    "view": {"robot": "file"},
}
"""What messages call an argument, where it is not by its name alone."""

KINDS = {"contacts": "frame|contact", "feet": "frame", "frames": "frame", "hold": "joint", "joints": "joint"}
KINDS |= {
    "given": "argument",
    "kinds": "kind",
    "motors": "joint",
    "names": "joint",
    "want": "quantity",
    "anchors": "anchor",
    "wrenches": "frame",
    "payload": "frame",
}
"""What is unknown where one of several names is."""

FLAT = {"fill_in", "flow", "apparent_mass_ellipse", "mass_matrix", "matrix", "side_view", "sole", "top_view"}
"""The pictures that are flat."""


def bodies() -> tw.Builder:
    """Return a builder with one body, anew: each link changes it."""
    builder = tw.Builder("b")
    builder.link("arm", parent="base_link", joint=tw.Revolute("z"), inertia=BODY)
    return builder


class Taker(NamedTuple):
    """A public function and good values for its arguments."""

    name: str
    function: Callable[..., Any]
    good: dict[str, Any]


def takers() -> Iterator[Taker]:
    """Return every public function, constructor and method that takes something."""
    found = dict(METHODS)
    for folder in FOLDERS:
        package = import_module("twistwrench" + folder)
        for name in package.__all__:
            thing, path = getattr(package, name), f"{folder}.{name}".lstrip(".")
            if inspect.isclass(thing) and path not in MADE_BY_HAND:
                thing = getattr(thing, "of", None)
            if callable(thing) and name not in LEFT_OUT:
                found[path] = thing
    for name, function in found.items():
        if good := _good(name, SIGNATURES.get(name, function)):
            yield Taker(name, function, good)


def _good(name: str, function: Callable[..., Any]) -> dict[str, Any]:
    """Return what a function is given: all that it must have, and of the rest what `GOOD` has."""
    given = {}
    for argument, p in inspect.signature(function).parameters.items():
        if p.kind in (p.VAR_POSITIONAL, p.VAR_KEYWORD):
            continue
        special = SPECIAL.get(name, {})
        if argument in special:
            given[argument] = special[argument]
        elif p.default is p.empty:
            given[argument] = axes(name) if argument == "ax" else GOOD[argument]
        else:
            given[argument] = p.default
    return given


def calls(taker: Taker) -> Iterator[tuple[str, str, Callable[[], Any]]]:
    """Return every bad call of a function: the argument, the bad value in words, and the call."""
    for argument, good in taker.good.items():
        if argument in NOT_SWEPT:
            continue
        for words, bad in values(good if good is not None else GOOD.get(argument)):
            if callable(bad) and argument in ("tau", "stop"):
                continue  # a function of the caller, whose errors are its own
            yield argument, words, partial(_call, taker, argument, bad)


def _call(taker: Taker, argument: str, bad: Any) -> Any:
    """Call a function with one bad argument, a picture on new axes: they take longer than the call."""
    new = {"ax": axes(taker.name)} if "ax" in taker.good else {}
    return taker.function(**taker.good | new | {argument: bad})


def axes(name: str) -> Any:
    """Return axes for a picture."""
    from matplotlib.figure import Figure

    flat = name.rpartition(".")[2] in FLAT
    return Figure().add_subplot(projection=None if flat else "3d")


def values(good: Any) -> Iterator[tuple[str, Any]]:
    """Return values that an argument cannot be, or hardly can."""
    yield from {
        "None": None,
        "True": True,
        "text": "x",
        "empty text": "",
        "bytes": b"x",
        "path": Path("x"),
        "-1": -1,
        "99": 99,
        "0.5": 0.5,
        "huge": 1e308,
        "NaN": np.nan,
        "inf": np.inf,
        "complex": 1j,
        "fraction": Fraction(1, 3),
        "decimal": Decimal("0.5"),
        "empty list": [],
        "list of None": [None],
        "list of NaN": [np.nan],
        "list of texts": ["x", "y"],
        "ragged": [[1.0, 2.0], [3.0]],
        "dict": {"x": 1},
        "set": {"x"},
        "iterator": iter([1.0]),
        "object": object(),
        "function": len,
        "type": int,
        "slice": slice(None),
        "zeros(0)": np.zeros(0),
        "zeros(7)": np.zeros(7),
        "eye(3)": np.eye(3),
        "eye(4)": np.eye(4),
        "eye(6)": np.eye(6),
        "zeros(2, 3, 4)": np.zeros((2, 3, 4)),
        "bools": np.ones(6, bool),
        "times": np.zeros(6, "datetime64[s]"),
        "SE3": tw.SE3.identity(),
        "inertia": BODY,
        "Twist": tw.Twist(np.ones(6)),
        "Wrench": tw.Wrench(np.ones(6)),
        "model": GO2,
        "contacts": FEET,
    }.items()
    if isinstance(good, np.ndarray):
        yield from bad_arrays(good.astype(float))


def bad_arrays(good: np.ndarray) -> Iterator[tuple[str, Any]]:
    """Return arrays that are not quite the good one."""
    yield "its NaN", np.full_like(good, np.nan)
    yield "its inf", np.full_like(good, np.inf)
    yield "huge", 1e300 * (good + 1)
    yield "largest", np.full_like(good, np.finfo(good.dtype).max)
    yield "tiny", 1e-300 * (good + 1)
    yield "its complex", good + 1e-20j
    yield "its text", good.astype(str)
    yield "its objects", good.astype(object)
    yield "masked", np.ma.array(good, mask=np.ones(good.shape, bool))
    yield "short", good[..., :-1]
    yield "column", good[..., None]
    yield "batch", np.stack([good, good])
    yield "empty batch", np.zeros((0, *good.shape))
    yield "zero", 0 * good
    yield "list", good.tolist()


def verdict(taker: Taker, argument: str, call: Callable[[], Any]) -> str:
    """Make a bad call; return what is wrong with its end, and nothing where it was refused by name or is finite."""
    called = "|".join([argument, CALLED.get(taker.name, {}).get(argument, argument), KINDS.get(argument, argument)])
    try:
        result = call()
    except (TypeError, ValueError) as error:
        said = str(error)
        return (
            ""
            if re.search(rf"\b({called})\b", said) or isinstance(error, tw.SingularError)
            else f"{type(error).__name__}: {said}"
        )
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return "" if finite(result) else f"not finite: {result!r:.200}"


def finite(result: Any) -> bool:
    """Return whether all numbers of a result are finite."""
    if isinstance(result, np.ndarray | float | complex | np.number):
        numbers = np.asarray(result)
        return numbers.dtype.kind not in "fc" or bool(np.isfinite(numbers).all())
    if isinstance(result, tw.Screw | tw.Model | tw.Scene | tw.simulation.Simulation | Costs):
        return True  # with a pitch or limits that may be infinite
    if isinstance(result, tw.SE3):
        return finite(result.rotation) and finite(result.translation)
    if isinstance(result, Mapping):
        return all(map(finite, result.values()))
    if isinstance(result, tuple | list):
        return all(map(finite, result))
    if is_dataclass(result) and not isinstance(result, type):
        return all(finite(getattr(result, name)) for name in result.__dataclass_fields__)
    return True

"""A number or a name that is none is refused by every public function: which argument, what was expected, what came."""

from __future__ import annotations

import inspect
import re
from importlib import import_module

import numpy as np
import pytest

import twistwrench as tw

from ..badcalls import SPECIAL
from ..robots import shared

FOLDERS = ["", ".fast", ".motions", ".newton_euler_3d", ".plot", ".templates", ".validate"]
MADE_BY_HAND = ["Baumgarte", "Builder", "PointContact", "Scene", "SurfaceContact", "Twist", "Wrench"]
GO2 = shared("go2")
FEET = [tw.PointContact(foot, 0.6) for foot in GO2.feet]
REST = np.zeros(GO2.nv)
METHODS = [
    tw.Builder("arm").link,
    tw.Scene("go2", contacts=FEET).cheapest,
    tw.simulate(GO2, GO2.standing(), REST, dt=0.01, steps=1).plot,
    GO2.frame,
    GO2.joint_id,
    GO2.random_configuration,
]
GOOD = {
    "A": np.eye(3),
    "M": np.eye(GO2.nv),
    "T": tw.SE3.identity(),
    "V": np.ones(6),
    "a": REST,
    "algorithm": "crba",
    "anchors": tw.contact_placements(GO2, GO2.standing(), FEET),
    "axis": "z",
    "contacts": FEET,
    "dt": 0.01,
    "duration": 0.02,
    "forces": np.zeros((4, 3)),
    "frame": "FR_foot",
    "frequency": 5.0,
    "half_size": (0.1, 0.05),
    "inertia": GO2.inertia[1],
    "model": GO2,
    "motion": tw.motions.walk(GO2, samples=2),
    "mu": 0.5,
    "n": 3,
    "name": "tip",
    "parent": "base_link",
    "point": np.zeros(3),
    "points": np.zeros(3),
    "q": GO2.standing(),
    "q0": GO2.standing(),
    "q1": GO2.standing(),
    "robot": GO2,
    "source": "go2",
    "tau": REST,
    "tolerance": 0.1,
    "v": REST,
    "vector": np.ones(6),
    "vectors": np.ones(3),
    "x": np.ones(6),
}
"""A value for every argument that must be given."""

ELSEWHERE = {"advise(within)", "advise(duration)"}
"""A tolerance may be a text, and a duration is one of a motion: tests/test_advice.py has them."""

OTHERS = {"Collection", "Iterable", "Mapping", "Model", "Sequence", "bool"}
"""Arguments that may be one of these have tests of their own."""

CALLED = {
    "ask(name)": "question",
    "ask(guess)": "49.7-tip",
    "Builder(root)": "link",
    "Builder.link(joint_name)": "joint",
    "Builder.link(name)": "link",
    "Model.frame(name)": "frame",
    "Model.joint_id(name)": "joint",
    "Simulation.plot(what)": "quantity",
}
"""What messages call an argument, where it is not by its name."""


def takers():
    """Return every public function, constructor and method above, with each argument that is a number or a name."""
    functions = {method.__qualname__: method for method in METHODS}
    for folder in FOLDERS:
        package = import_module("twistwrench" + folder)
        for name in package.__all__:
            thing = getattr(package, name)
            if inspect.isclass(thing) and name not in MADE_BY_HAND:
                thing = getattr(thing, "of", None)
            if callable(thing):
                functions[f"{folder}.{name}".lstrip(".")] = thing
    found = {}
    for name, function in functions.items():
        for argument, parameter in inspect.signature(function).parameters.items():
            takes = str(parameter.annotation)
            words = set(re.findall(r"\w+", takes))
            number = words & {"float", "int"} and "[" not in takes
            label = words & {"str", "Base", "Literal", "Pyramid", "Reference"} and not words & OTHERS
            if number or (label and not name.startswith("plot.")):
                found[f"{name}({argument})"] = (function, argument, bool(number))
    return {taker: found[taker] for taker in found if taker not in ELSEWHERE}


TAKERS = takers()


def test_every_taker_of_a_number_or_a_name_is_found():
    assert len(TAKERS) > 65
    known = {
        "simulate(dt)",
        "ConfigurationSpace.random_configuration(rng)",
        "templates.LinearPendulum(height)",
    }
    assert known <= set(TAKERS)


@pytest.mark.parametrize("taker", TAKERS)
def test_what_is_no_number_or_no_name_is_named(taker):
    function, argument, is_number = TAKERS[taker]
    if taker.startswith("validate"):
        pytest.importorskip("mpmath")
    parameters = inspect.signature(function).parameters
    needed = {name: p.kind for name, p in parameters.items() if p.default is p.empty}
    own = SPECIAL.get(taker.partition("(")[0], {})
    variable = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    given = {name: own[name] if name in own else GOOD[name] for name, kind in needed.items() if kind not in variable}
    given |= {name: value for name, value in own.items() if name in parameters}
    for bad in ("0.01", [1.0, 2.0], 1j) if is_number else (0.5, ["FR_foot"]):
        with pytest.raises((TypeError, ValueError), match=rf"\b{CALLED.get(taker, argument)}\b.*: .*, got "):
            function(**given | {argument: bad})

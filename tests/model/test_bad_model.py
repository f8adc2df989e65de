"""What is no model is refused by every public function that takes one, in words that lead to one."""

from __future__ import annotations

import inspect
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw

from ..badcalls import GOOD as EVERY
from ..badcalls import SPECIAL
from ..robots import shared

FOLDERS = ["", ".bridge", ".fast", ".motions", ".newton_euler_3d", ".plot", ".templates", ".validate"]
GO2 = shared("go2")
REST = np.zeros(GO2.nv)
GOOD = {
    "algorithm": "crba",
    "anchors": {},
    "dt": 0.01,
    "f_ext": np.zeros((GO2.nbodies, 6)),
    "forces": np.zeros((4, 3)),
    "frame": "FR_foot",
    "joints": ["FR_hip_joint"],
    "J": np.zeros((6, GO2.nv)),
    "J_c": np.zeros((12, GO2.nv)),
    "M": np.eye(GO2.nv),
    "motion": tw.motions.walk(GO2, samples=2),
    "q": GO2.standing(),
    "texts": [""] * GO2.nbodies,
    "Iterable[Contact]": [tw.PointContact("FR_foot", 0.6)],
    "Iterable[str]": ["FR_foot"],
    "v": REST,
    "a": REST,
    "tau": REST,
    "use": "simulation",
}
"""A value for every argument that must be given: by its name or, where that has two meanings, by its type."""


def takers():
    """Return every public function that takes a robot, with the argument's name: of a class, its ``of``, or `Scene`.

    All other classes are filled in by functions.
    """
    found = {}
    for folder in FOLDERS:
        package = import_module("twistwrench" + folder)
        for name in package.__all__:
            function = getattr(package, name)
            if inspect.isclass(function) and name != "Scene":
                function = getattr(function, "of", None)
            if callable(function):
                names = {"model", "robot"} & set(inspect.signature(function).parameters)
                found |= {f"{folder}.{name}".lstrip("."): (function, argument) for argument in names}
    return found


TAKERS = takers()


def call(function, **given):
    """Call a function with what is given, and with a good value for all else that it must have."""
    for name, parameter in inspect.signature(function).parameters.items():
        named = parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
        if named and parameter.default is parameter.empty and name not in given:
            given[name] = next(
                known[key] for known in (GOOD, EVERY) for key in (name, parameter.annotation) if key in known
            )
    return function(**given)


NO_MODEL = [
    ("go2", r"the str 'go2'; did you mean tw\.load\('go2'\)\?"),
    (Path("a.urdf"), r"the \w*Path 'a.urdf'; did you mean tw\.load\('a.urdf'\)\?"),
    (None, "None"),
    (REST, "numpy's ndarray"),
    (GO2.inertia[1], "the SpatialInertia"),
    (tw.Model, "the class Model"),
    (tw.load, "the function"),
    (tw.Scene("go2"), r"the Scene; did you mean its \.model\?"),
]


def test_every_taker_of_a_model_is_found():
    assert len(TAKERS) > 80
    assert {"rnea", "simulate", "Scene", "fast.aba", "templates.Full", "validate.validate"} <= set(TAKERS)


@pytest.mark.parametrize("taker", TAKERS)
def test_what_is_no_model_is_named(taker):
    function, argument = TAKERS[taker]
    takes = inspect.signature(function).parameters[argument].annotation
    for bad, came in NO_MODEL:
        if (isinstance(bad, str | Path) and "str" in takes) or (isinstance(bad, tw.Scene) and "Scene" in takes):
            continue
        with pytest.raises(TypeError, match=rf"^{argument}: expected .*Model.*, got {came}$"):
            call(function, **SPECIAL.get(taker, {}) | {argument: bad})


def test_model_of_pinocchio_is_led_to_the_bridge():
    pin = pytest.importorskip("pinocchio")
    with pytest.raises(TypeError, match=r"got pinocchio's Model; tw\.bridge\.from_pinocchio_model makes one of it$"):
        tw.rnea(pin.Model(), GO2.standing(), REST, REST)

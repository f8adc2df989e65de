"""What is prepared is not compiled in the loop."""

import numpy as np
import pytest

import twistwrench as tw
from straightline.llvm import MachineCode, available
from twistwrench import fast
from twistwrench.fast.program import Program

from ..strategies import random_state

FEET = [tw.PointContact("left", 0.6)]


def robot():
    """A small robot with a foot, which has no program yet."""
    rod = tw.SpatialInertia(1.0, [0, 0, 0.5], np.eye(3) * 0.1)
    builder = tw.Builder("prepared", base="floating", root_inertia=rod)
    builder.link("left", parent="base_link", joint=tw.Revolute("x"), inertia=rod)
    return builder.build()


def forbidden(*_, **__):
    raise AssertionError("a program is made in the loop")


@pytest.fixture
def loop(monkeypatch):
    """Return what forbids to make anything from now on."""

    def begin():
        monkeypatch.setattr(Program, "__init__", forbidden)
        monkeypatch.setattr(Program, "_general", forbidden)
        monkeypatch.setattr(MachineCode, "__init__", forbidden)

    return begin


@pytest.mark.one_case
@pytest.mark.skipif(not available(), reason="llvmlite is not installed")
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_what_is_prepared_makes_nothing_in_the_loop(loop, dtype):
    model = robot()
    fast.prepare(model, "rnea", "aba", "dynamics", contacts=FEET, want={"M", "J_c"}, dtype=dtype, f_ext=True)
    loop()
    for leading in ((), (1,), (3,), (100,), (4, 25)):
        s = random_state(model, rng=0, batch=leading, dtype=dtype)
        for f_ext in (None, s.f_ext):
            assert fast.rnea(model, s.q, s.v, s.a, f_ext).dtype == dtype
            assert fast.aba(model, s.q, s.v, s.tau, f_ext).shape == (*leading, 7)
        assert fast.dynamics(model, s.q, s.v, contacts=FEET, want=["M", "J_c"]).J_c.shape == (*leading, 3, 7)
    with pytest.raises(AssertionError, match="made in the loop"):
        fast.crba(model, s.q)


@pytest.mark.skipif(not available(), reason="llvmlite is not installed")
def test_only_what_is_asked_for_is_made(loop):
    model = robot()
    fast.prepare(model, "crba", batch=False)
    loop()
    fast.crba(model, model.neutral())
    with pytest.raises(AssertionError, match="made in the loop"):
        fast.crba(model, np.tile(model.neutral(), (100, 1)))
    assert len(model._programs) == 1


def test_it_takes_every_function_of_its_room():
    """With what each needs besides; also without machine code."""
    model, options = robot(), {"frame": "left", "u": 0.5}
    names = [name for name in fast.__all__ if name != "prepare"]
    for name in names:
        taken = fast.preparation.signature(getattr(fast, name)).parameters
        fast.prepare(model, name, batch=False, **{k: x for k, x in options.items() if k in taken})


@pytest.mark.parametrize(
    ("names", "options", "error", "words"),
    [
        (["rne"], {}, tw.NameNotFound, "did you mean 'rnea'"),
        (["prepare"], {}, tw.NameNotFound, "prepare"),
        ([], {}, TypeError, "names: .* got none"),
        (["rnea"], {"contacts": ["left"]}, TypeError, "contacts: expected an option of rnea"),
        (["dynamics"], {"contacts": ["lift"]}, tw.NameNotFound, "did you mean 'left'"),
        (["rnea"], {"batch": 3}, TypeError, "batch"),
    ],
)
def test_what_it_does_not_take_is_refused(names, options, error, words):
    with pytest.raises(error, match=words):
        fast.prepare(robot(), *names, **options)


def test_what_is_no_model_is_refused():
    with pytest.raises(TypeError, match="model"):
        fast.prepare("go2", "rnea")

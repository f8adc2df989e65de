"""The arrays of the caller: whatever memory `out` shares with an input, the result is the one without `out`.

Only the public functions are called, so that the test holds for whatever computes them.
"""

from __future__ import annotations

import importlib
from contextlib import contextmanager

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import twistwrench as tw
from twistwrench import fast

from ..strategies import examples

MODEL = tw.load("double_pendulum")
RUNNING = tw.random_tree(4, rng=3, base="floating", kinds=["revolute", "prismatic"])

ARGUMENTS = {
    "rnea": ("q", "v", "a", "f_ext"),
    "aba": ("q", "v", "tau", "f_ext"),
    "nonlinear_effects": ("q", "v"),
    "crba": ("q",),
    "centroidal_map": ("q",),
    "dynamics": ("q", "v"),
}
PAIRS = [
    (name, argument, result)
    for name, arguments in ARGUMENTS.items()
    for argument in arguments
    for result in (("M", "h", "J_c", "A_G") if name == "dynamics" else ("it",))
]


def width(model, argument):
    return {"q": (model.nq,), "f_ext": (model.nbodies, 6)}.get(argument, (model.nv,))


def tail(model, name, result):
    nv = model.nv
    of = {"crba": (nv, nv), "centroidal_map": (6, nv), "M": (nv, nv), "J_c": (3 * len(contacts(model)), nv)}
    return of.get(result, of.get(name, (6, nv) if result == "A_G" else (nv,)))


def contacts(model):
    return [model.frame_names[-1]]


def call(model, name, given, result, out=None):
    """Return one result of a function, by itself or in the caller's array."""
    arguments = [given[argument] for argument in ARGUMENTS[name]]
    if name == "dynamics":
        outs = None if out is None else tw.Dynamics(**{result: out})
        return getattr(fast.dynamics(model, *arguments, contacts=contacts(model), out=outs), result)
    return getattr(fast, name)(model, *arguments, out=out)


@contextmanager
def small_chunks():
    """Chunks of 4 states, where there are chunks."""
    with pytest.MonkeyPatch.context() as patch:
        try:
            many = importlib.import_module("twistwrench.fast.batch")
        except ImportError:
            pass
        else:
            patch.setattr(many, "FEWEST", 4, raising=False)
            patch.setattr(many, "CACHED", 1, raising=False)
        yield


def strided(buffer, start, shape, order):
    """Take an array out of a buffer, its axes in memory as C or Fortran has them, or backwards."""
    flat = buffer[start : start + int(np.prod(shape))]
    if order == "F":
        return flat.reshape(shape[::-1]).transpose()
    x = flat.reshape(shape)
    return x[::-1] if order == "backwards" else x


@pytest.mark.one_case
@pytest.mark.parametrize(("name", "argument", "result"), PAIRS, ids=lambda x: x)
@given(
    model=st.sampled_from([MODEL, RUNNING]),
    count=st.sampled_from([1, 3, 9, 30]),
    shift=st.integers(-40, 40),
    orders=st.tuples(*[st.sampled_from(["C", "F", "backwards"])] * 2),
    seed=st.integers(0, 2**32 - 1),
)
@examples(15)
def test_an_out_that_overlaps_an_input_changes_nothing(name, argument, result, model, count, shift, orders, seed):
    rng = np.random.default_rng(seed)
    states = {"q": np.stack([model.random_configuration(rng=rng) for _ in range(count)])}
    for other in ARGUMENTS[name][1:]:
        states[other] = rng.standard_normal((count, *width(model, other)))
    if "f_ext" in states:
        states["f_ext"][:, 0] = 0
    right = call(model, name, states, result)
    shapes = (count, *width(model, argument)), (count, *tail(model, name, result))
    buffer = np.full(40 + max(int(np.prod(shape)) for shape in shapes) + 40, 7.0)
    read = strided(buffer, 40, shapes[0], orders[0])
    read[...] = states[argument]
    out = strided(buffer, 40 + min(shift, buffer.size - 40 - int(np.prod(shapes[1]))), shapes[1], orders[1])
    with small_chunks():
        returned = call(model, name, {**states, argument: read}, result, out)
    assert returned is out
    np.testing.assert_allclose(out, right, rtol=0, atol=1e-10 * max(1.0, np.abs(right).max(initial=0)))


def test_a_trajectory_can_be_filled_one_step_ahead_of_what_is_read():
    model, n = tw.load("go2"), 5000
    rng = np.random.default_rng(0)
    q = model.integrate(model.standing(), 0.3 * rng.standard_normal((n - 1, model.nv)))
    trajectory = rng.standard_normal((n, model.nv))
    right = fast.nonlinear_effects(model, q, trajectory[:-1].copy())
    fast.nonlinear_effects(model, q, trajectory[:-1], out=trajectory[1:])
    np.testing.assert_allclose(trajectory[1:], right, rtol=0, atol=1e-10)


@pytest.mark.parametrize("count", [2, 37])
@pytest.mark.parametrize(("name", "argument", "result"), PAIRS, ids=lambda x: x)
def test_an_out_in_which_entries_share_memory_is_refused(name, argument, result, count):
    states = {each: np.zeros((count, *width(MODEL, each))) for each in ARGUMENTS[name]}
    shape = (count, *tail(MODEL, name, result))
    one = np.empty(shape[1:])
    for out in (np.lib.stride_tricks.as_strided(one, shape, (0, *one.strides)), half_steps(shape)):
        with pytest.raises(ValueError, match=r"out: expected for .* an array with memory of its own for each entry"):
            call(MODEL, name, states, result, out)


def half_steps(shape):
    """States that begin one entry after the one before: a sliding window."""
    flat = np.empty(2 * int(np.prod(shape)))
    inner = np.empty(shape[1:]).strides
    return np.lib.stride_tricks.as_strided(flat, shape, (8, *inner))


@pytest.mark.parametrize("count", [1, 2, 37])
@pytest.mark.parametrize(("name", "argument", "result"), PAIRS, ids=lambda x: x)
def test_an_out_that_is_read_only_is_refused(name, argument, result, count):
    states = {each: np.zeros((count, *width(MODEL, each))) for each in ARGUMENTS[name]}
    out = np.empty((count, *tail(MODEL, name, result)))
    out.flags.writeable = False
    with pytest.raises(ValueError, match=r"out: expected for .* an array that can be written to, got a read-only one"):
        call(MODEL, name, states, result, out)


def test_arrays_for_two_results_that_share_memory_are_refused_and_those_that_only_interleave_are_filled():
    q, buffer = np.zeros((30, 2)), np.empty((30, 6))
    M, h = buffer[:, :4].reshape(30, 2, 2), buffer[:, 4:]
    d = fast.dynamics(MODEL, q, q, want={"M", "h"}, out=tw.Dynamics(M=M, h=h))
    assert d.M is M
    assert d.h is h
    np.testing.assert_array_equal(h, fast.nonlinear_effects(MODEL, q, q))
    np.testing.assert_array_equal(M, fast.crba(MODEL, q))
    with pytest.raises(ValueError, match="out: expected separate arrays for M and h, got two that share memory"):
        fast.dynamics(MODEL, q, q, want={"M", "h"}, out=tw.Dynamics(M=M, h=buffer[:, 3:5]))


def test_an_input_that_is_also_the_output_is_whole_where_nothing_comes_out():
    builder = tw.Builder("massless")
    builder.link("body", parent="base_link", joint=tw.Revolute("z"))
    model = builder.build()
    for count in (3, 300):
        tau = np.ones((count, 1))
        with pytest.raises(tw.SingularError):
            fast.aba(model, np.zeros((count, 1)), np.zeros((count, 1)), tau, out=tau)
        assert (tau == 1).all()

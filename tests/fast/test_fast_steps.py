"""Steps q ⊕ u as programs: the textbook's, Pinocchio's, and half of it twice."""

import numpy as np
import pytest

import twistwrench as tw
from straightline import llvm
from twistwrench import bridge
from twistwrench.fast import programs
from twistwrench.fast.steps import integrate
from twistwrench.model import KINDS, Joint

SIZES = [0.0, 1e-200, 1e-8, 1e-3, 0.1, 0.5, 1.0, 3.0, 20.0]
"""Of the steps: on both sides of the radian from which the textbook takes them."""

KIND = pytest.mark.parametrize("kind", KINDS)


def steps(kind, batch=()):
    model = tw.random_tree(5, rng=7, kinds=(kind,), base="floating" if kind == "free_flyer" else "fixed")
    rng = np.random.default_rng(1)
    u = np.multiply.outer(SIZES, rng.standard_normal((*batch, model.nv)))
    q = np.broadcast_to(model.random_configuration(rng=rng), (*u.shape[:-1], model.nq))
    return model, q.copy(), u


@KIND
def test_a_step_of_any_size_is_the_textbooks(kind):
    model, q, u = steps(kind)
    for one_q, one_u, there in zip(q, u, model.integrate(q, u)):
        np.testing.assert_allclose(integrate(model, one_q, one_u), there, rtol=1e-15, atol=1e-15)
    assert isinstance(model._programs["step", u.dtype], programs.Program)


@KIND
def test_a_step_is_pinocchios_and_half_of_it_twice(kind):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model, q, u = steps(kind)
    there = bridge.to_pinocchio_model(model)
    for one_q, one_u in zip(q, u):
        size = max(1, np.abs(one_u).max())
        ours = integrate(model, one_q, one_u)
        theirs = pin.integrate(there, one_q, bridge.to_pinocchio_tangent(model, one_u))
        assert np.abs(model.difference(ours, theirs)).max() < 1e-14 * size
        halves = integrate(model, integrate(model, one_q, one_u / 2), one_u / 2)
        assert np.abs(model.difference(ours, halves)).max() < 1e-14 * size


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_batches_and_number_types_are_kept_without_machine_code_too(dtype, monkeypatch):
    monkeypatch.setattr(llvm, "available", lambda: False)
    model, q, u = steps("free_flyer", (3, 2))
    q, u = model.normalize(q.astype(dtype)), u.astype(dtype)
    there = integrate(model, q, u)
    assert there.dtype == dtype
    eps = np.finfo(dtype).eps
    np.testing.assert_allclose(there, model.integrate(q, u), rtol=8 * eps, atol=8 * eps * np.abs(u).max())


def test_a_state_that_is_none_is_refused():
    model, q, u = steps("free_flyer")
    with pytest.raises(ValueError, match=r"quaternion .* has norm 2"):
        integrate(model, np.concatenate([q[0][:3], 2 * q[0][3:7], q[0][7:]]), u[0])


def test_a_joint_of_ones_own_that_asks_what_its_step_is_takes_the_textbooks():
    class Asking(Joint):
        kind, nq, nv = "asking of test_fast_steps", 1, 1

        def subspace(self, dtype=np.float64):
            return np.eye(6, 1, dtype=dtype)

        def transform(self, q):
            return tw.model.Revolute("x").transform(q)

        def integrate(self, q, dv):
            return np.where(np.isfinite(dv), q + dv, q)

    try:
        builder = tw.Builder("asking")
        builder.link("wheel", parent="base_link", joint=Asking())
        model = builder.build()
        assert integrate(model, np.zeros(1), np.array([0.5])) == 0.5
        assert model._programs["step", np.dtype(float)].backend == "textbook"
    finally:
        Joint.kinds.pop(Asking.kind)

"""Frames, the centre of mass and the energies as programs: the textbook's, Pinocchio's, and the laws between them."""

import numpy as np
import pytest
from hypothesis import given

import twistwrench as tw
from straightline import llvm
from twistwrench import fast

from ..strategies import BATCHES, REFERENCES, Recipe, examples, recipes

GO2 = tw.load("go2")
CALLS = {
    "frame_placement": lambda package, m, s, frame: package.frame_placement(m, s.q, frame).matrix(),
    **{
        f"frame_jacobian, {r}": lambda package, m, s, frame, r=r: package.frame_jacobian(m, s.q, frame, r)
        for r in REFERENCES
    },
    **{
        f"frame_bias_acceleration, {r}": lambda package, m, s, frame, r=r: package.frame_bias_acceleration(
            m, s.q, s.v, frame, r
        )
        for r in REFERENCES
    },
    "center_of_mass": lambda package, m, s, frame: package.center_of_mass(m, s.q),
    "center_of_mass_jacobian": lambda package, m, s, frame: package.center_of_mass_jacobian(m, s.q),
    "kinetic_energy": lambda package, m, s, frame: package.kinetic_energy(m, s.q, s.v),
    "potential_energy": lambda package, m, s, frame: package.potential_energy(m, s.q),
}
EACH = pytest.mark.parametrize("name", CALLS)


def same(ours, book, digits=64):
    assert (np.shape(ours), type(ours)) == (np.shape(book), type(book))
    assert ours.dtype == book.dtype
    size = np.abs(book).max(initial=1)
    np.testing.assert_allclose(ours, book, rtol=0, atol=digits * np.finfo(book.dtype).eps * size)


@given(recipes(5))
@examples(2)
def test_every_joint_is_as_in_the_textbook(recipe):
    s, frame = recipe.state(), recipe.frame()
    for call in CALLS.values():
        same(call(fast, recipe.model, s, frame), call(tw, recipe.model, s, frame))


@EACH
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_batches_are_kept(name, batch):
    recipe = Recipe(7, 129, "floating")
    s = recipe.state(batch)
    same(CALLS[name](fast, recipe.model, s, recipe.frame()), CALLS[name](tw, recipe.model, s, recipe.frame()))


@EACH
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, np.complex128])
def test_number_types_are_kept(name, dtype):
    recipe = Recipe(4, 7, "floating")
    for batch in ((), (30,)):
        s = recipe.state(batch, dtype)
        same(CALLS[name](fast, recipe.model, s, recipe.frame()), CALLS[name](tw, recipe.model, s, recipe.frame()))


@EACH
@pytest.mark.parametrize("batch", [(), (30,)], ids=str)
def test_without_machine_code_the_results_are_the_same(name, batch, monkeypatch):
    monkeypatch.setattr(llvm, "available", lambda: False)
    recipe = Recipe(7, 129, "floating")
    model = tw.random_tree(7, rng=129, base="floating")  # which remembers no program
    s = recipe.state(batch)
    same(CALLS[name](fast, model, s, recipe.frame()), CALLS[name](tw, model, s, recipe.frame()))


def test_the_laws_between_them_hold_in_one_state():
    s = Recipe(7, 129, "floating").state()
    model, frame, h = Recipe(7, 129, "floating").model, Recipe(7, 129, "floating").frame(), 1e-6
    q = {sign: model.integrate(s.q, sign * h * s.v) for sign in (1, -1)}
    J = fast.frame_jacobian(model, s.q, frame, "local_world_aligned")

    def rate(function):
        return (function(q[1]) - function(q[-1])) / (2 * h)

    moved = rate(lambda q: fast.frame_placement(model, q, frame).translation)
    np.testing.assert_allclose(J[3:] @ s.v, moved, rtol=0, atol=1e-7)
    bias = rate(lambda q: fast.frame_jacobian(model, q, frame, "local_world_aligned") @ s.v)
    ours = fast.frame_bias_acceleration(model, s.q, s.v, frame, "local_world_aligned")
    np.testing.assert_allclose(ours, bias, rtol=0, atol=1e-6)
    J_G = fast.center_of_mass_jacobian(model, s.q)
    np.testing.assert_allclose(J_G @ s.v, rate(lambda q: fast.center_of_mass(model, q)), rtol=0, atol=1e-7)
    np.testing.assert_allclose(fast.kinetic_energy(model, s.q, s.v), s.v @ fast.crba(model, s.q) @ s.v / 2, rtol=1e-13)
    power = rate(lambda q: fast.potential_energy(model, q))
    np.testing.assert_allclose(tw.gravity(model, s.q) @ s.v, power, rtol=0, atol=1e-6)


def test_they_are_pinocchios():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    s = Recipe(7, 129, "floating").state()
    model, frame = Recipe(7, 129, "floating").model, Recipe(7, 129, "floating").frame()
    there = tw.bridge.to_pinocchio_model(model)
    data, k = there.createData(), there.getFrameId(frame)
    v = tw.bridge.to_pinocchio_tangent(model, s.v)
    pin.computeAllTerms(there, data, s.q, v)
    pin.updateFramePlacements(there, data)
    pin.forwardKinematics(there, data, s.q, v, 0 * v)
    np.testing.assert_allclose(
        fast.frame_placement(model, s.q, frame).matrix(), data.oMf[k].homogeneous, rtol=0, atol=1e-14
    )
    for name, theirs in {
        "local": pin.LOCAL,
        "world": pin.WORLD,
        "local_world_aligned": pin.LOCAL_WORLD_ALIGNED,
    }.items():
        J = tw.bridge.from_pinocchio_jacobian(model, pin.getFrameJacobian(there, data, k, theirs))
        np.testing.assert_allclose(fast.frame_jacobian(model, s.q, frame, name), J, rtol=0, atol=1e-13)
        classical = name == "local_world_aligned"
        read = pin.getFrameClassicalAcceleration if classical else pin.getFrameAcceleration
        bias = np.roll(read(there, data, k, theirs).vector, 3)
        ours = fast.frame_bias_acceleration(model, s.q, s.v, frame, name)
        np.testing.assert_allclose(ours, bias, rtol=0, atol=1e-12)
    np.testing.assert_allclose(fast.center_of_mass(model, s.q), data.com[0], rtol=0, atol=1e-14)
    energy = pin.computePotentialEnergy(there, data, s.q)
    np.testing.assert_allclose(fast.potential_energy(model, s.q), energy, rtol=0, atol=1e-12)


# ---------------------------------------------------------------- what is refused, and where it is written

Q, V = GO2.standing(), np.zeros(18)
WRONG = {
    "a NaN": (np.where(np.arange(19) == 8, np.nan, Q), V, "FR_foot", "local"),
    "a quaternion off norm 1": (np.where(np.arange(19) == 6, 1.1, Q), V, "FR_foot", "local"),
    "v for q": (V, V, "FR_foot", "local"),
    "no such frame": (Q, V, "FR_fot", "local"),
    "no such reference": (Q, V, "FR_foot", "locl"),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_what_the_textbook_refuses_is_refused_in_the_same_words(wrong):
    q, v, frame, reference = WRONG[wrong]
    calls = [
        lambda package: package.frame_jacobian(GO2, q, frame, reference),
        lambda package: package.frame_bias_acceleration(GO2, q, v, frame, reference),
    ]
    if "reference" not in wrong:
        calls.append(lambda package: package.frame_placement(GO2, q, frame))
    if "such" not in wrong:
        calls += [
            lambda package: package.center_of_mass(GO2, q),
            lambda package: package.center_of_mass_jacobian(GO2, q),
            lambda package: package.kinetic_energy(GO2, q, v),
            lambda package: package.potential_energy(GO2, q),
        ]
    for call in calls:
        with pytest.raises((ValueError, KeyError)) as book:
            call(tw)
        with pytest.raises(type(book.value)) as ours:
            call(fast)
        assert str(ours.value) == str(book.value)


def test_what_is_no_model_is_refused():
    for function, *arguments in (
        (fast.frame_placement, Q, "FR_foot"),
        (fast.frame_jacobian, Q, "FR_foot"),
        (fast.frame_bias_acceleration, Q, V, "FR_foot"),
        (fast.center_of_mass, Q),
        (fast.center_of_mass_jacobian, Q),
        (fast.kinetic_energy, Q, V),
        (fast.potential_energy, Q),
    ):
        with pytest.raises(TypeError, match="model"):
            function("go2", *arguments)


@pytest.mark.parametrize("batch", [(), (3,), (20,)], ids=str)
def test_out_is_filled_and_returned(batch):
    s = Recipe(7, 129, "floating").state(batch)
    model, frame = Recipe(7, 129, "floating").model, Recipe(7, 129, "floating").frame()
    for function, *arguments in (
        (fast.frame_jacobian, s.q, frame, "world"),
        (fast.frame_bias_acceleration, s.q, s.v, frame),
        (fast.center_of_mass, s.q),
        (fast.center_of_mass_jacobian, s.q),
        (fast.kinetic_energy, s.q, s.v),
        (fast.potential_energy, s.q),
    ):
        expected = function(model, *arguments)
        out = np.full(np.shape(expected), np.nan)
        assert function(model, *arguments, out=out) is out
        np.testing.assert_array_equal(out, expected)

"""Number types and batch axes: what comes in comes out, and nothing is lost on the way."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

import twistwrench as tw

from ..robots import shared
from ..strategies import BATCHES, Recipe, State, examples, random_state, recipes
from ..truth import ULPS, assert_agree, check_against_the_truth, textbook

LONG = np.finfo(np.longdouble).eps < np.finfo(np.float64).eps
needs_long_double = pytest.mark.skipif(not LONG, reason="long double is double here: nothing finer to test")
TREES = [Recipe(6, seed=1, base="floating"), Recipe(7, seed=4, branching=1.0), Recipe(1, seed=2)]


# ---------------------------------------------------------------- number types


@pytest.mark.one_case
@pytest.mark.parametrize(
    "dtype",
    [
        np.float32,
        np.complex64,
        pytest.param(np.longdouble, marks=needs_long_double),
        pytest.param(np.clongdouble, marks=needs_long_double),
    ],
)
@given(recipes(5))
@examples(3)
def test_every_number_type_is_kept_and_is_right_to_its_own_precision(dtype, recipe):
    check_against_the_truth(recipe, dtype)


@pytest.mark.slow
@pytest.mark.parametrize(
    "dtype",
    [
        np.float32,
        np.complex64,
        np.complex128,
        pytest.param(np.longdouble, marks=needs_long_double),
        pytest.param(np.clongdouble, marks=needs_long_double),
    ],
)
@given(recipes(14))
@examples(3, every=12)
def test_every_number_type_is_right_on_larger_trees(dtype, recipe):
    check_against_the_truth(recipe, dtype)


@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, np.complex64, np.complex128, np.clongdouble])
@pytest.mark.parametrize("recipe", TREES, ids=str)
def test_no_quantity_leaves_the_number_type_on_its_way(recipe, dtype):
    one, batch = (textbook(recipe.model, recipe.state(b, dtype), recipe.frame()) for b in ((), (2,)))
    others = {name: x.dtype for x_of in (one, batch) for name, x in x_of.items() if x.dtype != dtype}
    assert others == {}


@needs_long_double
def test_long_double_gains_what_double_has_not():
    # The check above would pass a recursion that goes through double somewhere, were its bound not this fine.
    assert ULPS * np.finfo(np.longdouble).eps < 1e-16
    recipe = Recipe(6, seed=1, base="floating")
    s = recipe.state(dtype=np.longdouble)
    fine = textbook(recipe.model, s, recipe.frame())
    coarse = textbook(recipe.model, State(*(x.astype(np.float64) for x in s)), recipe.frame())
    for name in fine:
        apart = np.abs(fine[name] - coarse[name]).max() / np.abs(fine[name]).max()
        assert 1e-17 < apart < 1e-12, name


def single(model):
    """A configuration in single precision whose quaternion is off norm 1 by more than double precision may be."""
    rng = np.random.default_rng(0)
    while True:
        q = model.integrate(model.standing(), rng.standard_normal(model.nv) * 0.1).astype(np.float32)
        if abs(np.hypot.reduce(q[3:7].astype(float)) - 1) > 3e-8:
            return q


@pytest.mark.slow
def test_a_single_configuration_goes_with_double_velocities():
    """Its quaternion has norm 1 to seven digits, and is made one to sixteen on the way."""
    model = shared("go2")
    q, v = single(model), np.linspace(-1, 1, model.nv)
    checked, _ = model.state(q, v=v)
    assert abs(np.hypot.reduce(checked[3:7]) - 1) < 1e-15
    feet = [tw.PointContact(foot, 0.6) for foot in model.feet]
    exact = model.normalize(q.astype(np.float64))
    for answer in (
        lambda q: tw.constraint_bias(model, q, v, feet),
        lambda q: tw.templates.TEMPLATES["srbm"].of(model, exact).rate(q, v, v),
        lambda q: tw.simulate(model, q, v, dt=0.01, steps=1).q,
        lambda q: tw.simulate(model, q, v, dt=0.01, steps=1, method="variational").q,
    ):
        assert np.allclose(answer(q), answer(exact), rtol=0, atol=1e-12)


@pytest.mark.slow
def test_what_is_done_in_double_precision_takes_singles():
    model = shared("go2")
    q, v = single(model), np.zeros(model.nv, np.float32)
    exact, feet = model.normalize(q.astype(np.float64)), [tw.PointContact(foot, 0.6) for foot in model.feet]
    anchors = tw.contact_placements(model, q, feet)
    for answer in (
        lambda q: tw.contact_forward_dynamics(model, q, v, v, feet, stabilise=tw.Baumgarte(20.0, anchors)).qdd,
        lambda q: tw.contact_inverse_dynamics(model, q, v, v, feet).tau,
        lambda q: tw.impact(model, q, v + 1, feet).v,
        lambda q: tw.project_state(model, q, v, feet, anchors)[0],
        lambda q: tw.lock_joints(model, ["root_joint"], q).expand(np.zeros(12), np.zeros(12))[0],
        lambda q: tw.crba(model, tw.Scene(model, base="fixed", q=q).q),
        lambda q: tw.stance_margins(model, q, feet).tip,
    ):
        assert np.allclose(answer(q), answer(exact), rtol=0, atol=1e-9)


def test_integers_count_as_double_precision_and_lists_are_welcome():
    model = tw.chain(3)
    tau = tw.rnea(model, [0, 1, 2], [1, 0, 0], [0, 0, 1])
    assert tau.dtype == np.float64
    assert (tau == tw.rnea(model, np.array([0.0, 1, 2]), np.array([1.0, 0, 0]), np.array([0, 0, 1.0]))).all()


def test_widest_type_of_the_arguments_wins_and_what_is_left_out_has_no_say():
    model = tw.chain(3)
    zero = {t: np.zeros(3, t) for t in (np.float32, np.float64, np.complex64, np.complex128)}
    single, wrenches = zero[np.float32], np.zeros((4, 6))
    assert tw.rnea(model, single, [0, 0, 0], [1, 2, 3]).dtype == np.float32
    assert tw.rnea(model, single, single, single, wrenches).dtype == np.float64
    assert tw.rnea(model, single, single, single, wrenches.astype(np.float32)).dtype == np.float32
    assert tw.rnea(model, single, zero[np.float64], single).dtype == np.float64
    assert tw.rnea(model, single, zero[np.complex64], single).dtype == np.complex64
    assert tw.aba(model, zero[np.float64], zero[np.complex64], single).dtype == np.complex128
    assert tw.gravity(model, single).dtype == np.float32
    assert tw.nonlinear_effects(model, single, single).dtype == np.float32
    assert tw.forward_kinematics(model, single).placement[1].rotation.dtype == np.float32


@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, np.complex128])
def test_manifold_and_floating_base_functions_keep_the_number_type(dtype):
    model = Recipe(6, seed=1, base="floating").model
    s, contacts = random_state(model, rng=0, dtype=dtype), model.frame_names[-2:]
    for result in (
        model.integrate(s.q, s.v.real.astype(dtype)),
        model.difference(s.q, s.q),
        model.normalize(s.q),
        tw.contact_jacobian(model, s.q, contacts),
        *vars(tw.dynamics(model, s.q, s.v, contacts=contacts)).values(),
    ):
        assert result.dtype == dtype


# ---------------------------------------------------------------- batch axes


@pytest.mark.parametrize("batch", BATCHES, ids=str)
@pytest.mark.parametrize("recipe", TREES, ids=str)
def test_batch_is_computed_item_by_item(recipe, batch):
    model, frame = recipe.model, recipe.frame()
    s = recipe.state(batch)
    whole = textbook(model, s, frame)
    one = textbook(model, recipe.state(), frame)
    for name in whole:
        assert np.shape(whole[name]) == (*batch, *np.shape(one[name])), name
    for item in np.ndindex(*batch):
        alone = State(*(x[item] for x in s))
        right = textbook(model, alone, frame)
        assert_agree(model, alone, {name: x[item] for name, x in whole.items()}, right, against=right)


def test_arguments_broadcast_against_each_other():
    recipe = TREES[0]
    model, frame = recipe.model, recipe.frame()
    q = random_state(model, rng=0, batch=(3, 1)).q
    v = random_state(model, rng=1, batch=(2,)).v
    a, tau, f_ext = random_state(model, rng=2)[2:]
    whole = textbook(model, State(q, v, a, tau, f_ext), frame)
    assert whole["rnea"].shape == (3, 2, model.nv)
    assert whole["M"].shape == (3, 1, model.nv, model.nv)
    for i, j in np.ndindex(3, 2):
        alone = State(q[i, 0], v[j], a, tau, f_ext)
        right = textbook(model, alone, frame)
        got = {name: x[i, min(j, x.shape[1] - 1)] for name, x in whole.items()}
        assert_agree(model, alone, got, right, against=right)


def test_batch_of_one_quantity_alone_is_enough():
    recipe = TREES[0]
    s, many = recipe.state(), recipe.state((4,))
    for function, name in ((tw.rnea, "a"), (tw.aba, "tau")):
        last = getattr(many, name)
        together = function(recipe.model, s.q, s.v, last, s.f_ext)
        assert together.shape == (4, recipe.model.nv)
        for k in range(4):
            assert np.allclose(together[k], function(recipe.model, s.q, s.v, last[k], s.f_ext), rtol=1e-12)
        by_wrench = function(recipe.model, s.q, s.v, last[0], many.f_ext)
        assert by_wrench.shape == (4, recipe.model.nv)
        assert len(np.unique(by_wrench[:, 0])) == 4


@pytest.mark.parametrize("batch", [(1,), (3, 1, 2), (0,)], ids=str)
def test_manifold_and_floating_base_functions_take_batches(batch):
    model = Recipe(6, seed=1, base="floating").model
    s, contacts = random_state(model, rng=0, batch=batch), model.frame_names[-2:]
    everything = tw.dynamics(model, s.q, s.v, contacts=contacts)
    got = {
        "integrate": model.integrate(s.q, s.v),
        "difference": model.difference(s.q, s.q[..., ::1]),
        "normalize": model.normalize(s.q),
        "J_c": tw.contact_jacobian(model, s.q, contacts),
        **vars(everything),
    }
    for item in np.ndindex(*batch):
        q, v = s.q[item], s.v[item]
        right = {
            "integrate": model.integrate(q, v),
            "difference": model.difference(q, q),
            "normalize": model.normalize(q),
            "J_c": tw.contact_jacobian(model, q, contacts),
            **vars(tw.dynamics(model, q, v, contacts=contacts)),
        }
        for name in right:
            assert np.allclose(got[name][item], right[name], rtol=1e-12, atol=1e-13), name
    for name, x in got.items():
        assert x.shape[: len(batch)] == batch, name


# ---------------------------------------------------------------- whose arrays


def test_inputs_are_never_changed_and_may_be_read_only():
    recipe = TREES[0]
    s = recipe.state((2,))
    before = [x.copy() for x in s]
    for x in s:
        x.flags.writeable = False
    textbook(recipe.model, s, recipe.frame())
    recipe.model.integrate(s.q, s.v)
    recipe.model.difference(s.q, s.q)
    recipe.model.normalize(s.q)
    assert all((x == y).all() for x, y in zip(s, before, strict=True))


def test_results_belong_to_the_caller():
    for recipe in TREES:
        model, s = recipe.model, recipe.state((2,))
        first = textbook(model, s, recipe.frame())
        kept = {name: x.copy() for name, x in first.items()}
        for name, x in first.items():
            assert not any(np.shares_memory(x, y) for y in s), name
            if not name.startswith("frame"):  # an SE3 is frozen
                x[...] = 7
        q = model.normalize(s.q)
        q[...] = 7
        again = textbook(model, s, recipe.frame())
        assert all((again[name] == kept[name]).all() for name in kept)

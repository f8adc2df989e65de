"""``bound="running"``: never below the true error, from programs of 32 digits and the 60-digit Newton-Euler of 49.1."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import twistwrench as tw
from straightline.llvm import available
from twistwrench import compile
from twistwrench import newton_euler_3d as ne

from ..strategies import examples, random_state, recipes

mpmath = pytest.importorskip("mpmath")

llvm = pytest.mark.skipif(not available(), reason="llvmlite is not installed")
BACKENDS = [pytest.param("llvm", marks=llvm), "numpy"]
BACKEND = "llvm" if available() else "numpy"
ASKED = ("rnea", "aba", "crba", "centroidal_map")
ARGUMENTS = {"rnea": "q v a", "aba": "q v tau", "crba": "q", "centroidal_map": "q", "M": "q"}


def states(model, name, count, seed=0, **sizes):
    """Return the arguments of so many random states, of standard size or of another."""
    rng = np.random.default_rng(seed)
    found = {"q": np.stack([model.random_configuration(rng=rng) for _ in range(count)])}
    for symbol in ("v", "a", "tau"):
        found[symbol] = rng.standard_normal((count, model.nv)) * sizes.get(symbol, 1.0)
    return [found[symbol] for symbol in ARGUMENTS[name].split()]


def true_error(model, name, args, value):
    """Return how far the entries are off, and what is not known of it: the bound of the 32 digits."""
    exact, bound = compile(model, name, dtype="double-double", bound=True, backend=BACKEND)(*map(np.float64, args))
    return np.abs((value.astype(np.float64) - exact.hi) - exact.lo), bound + 2.0**-1074


def check(model, name, args, dtype=np.float64, backend=BACKEND):
    """Assert that the bounds hold, and are of the program's shape and type; return bound over error."""
    args = [x.astype(dtype) for x in args]
    value, bound = compile(model, name, dtype=dtype, bound="running", backend=backend)(*args)
    assert value.dtype == bound.dtype == dtype
    assert value.shape == bound.shape
    off, unknown = true_error(model, name, args, value)
    assert (off * (1 - 2.0**-50) <= bound + unknown).all()
    return (bound / np.where(off > 4 * unknown, off, np.nan)).ravel()


@pytest.mark.one_case
@pytest.mark.parametrize(
    ("robot", "name"), [("cart_pole", "rnea"), *(("go2", name) for name in ASKED), ("planar_arm", "aba")]
)
def test_no_entry_is_further_off_than_its_bound(robot, name):
    model = tw.load(robot)
    ratios = check(model, name, states(model, name, 200))
    assert np.nanmin(ratios) >= 1
    assert np.nanmedian(ratios) < (1500 if name == "aba" else 100)  # of aba, Wilkinson's own rules give 500


@pytest.mark.parametrize(("robot", "name"), [("cart_pole", "aba"), *(("panda", x) for x in ASKED), ("planar_arm", "M")])
def test_the_bounds_of_float32_hold(robot, name):
    model = tw.load(robot)
    ratios = check(model, name, states(model, name, 50), np.float32)
    # Of float32, aba of seven joints with light wrists is the loosest: a median of 10 000.
    assert 1 <= np.nanmedian(ratios) < (20_000 if name == "aba" else 2000)


@given(recipe=recipes(4), name=st.sampled_from(ASKED))
@examples(2)
def test_trees_of_every_joint_are_within_their_bounds(recipe, name):
    model = recipe.model
    state = random_state(model, rng=recipe.seed)._asdict()
    check(model, name, [state[symbol] for symbol in ARGUMENTS[name].split()], backend="numpy")


def test_fifty_digits_agree():
    """The truth of the other tests comes from the same line; this one from formulas of its own."""
    model = tw.random_tree(4, rng=2, base="floating")
    model = replace(
        model, placement=tuple(None if T is None else tw.SE3(np.eye(3), T.translation) for T in model.placement)
    )  # rotations that are exact in every number
    state = random_state(model, rng=3)
    with mpmath.workdps(60):
        right = ne.inverse_dynamics(model, *map(ne.as_mpmath, (state.q, state.v, state.a)))
        value, bound = compile(model, "rnea", bound="running", backend=BACKEND)(state.q, state.v, state.a)
        off = abs(ne.as_mpmath(value) - right)
        assert (off <= ne.as_mpmath(bound) + mpmath.mpf(10) ** -35).all()
        assert float(max(off)) > 0


@pytest.mark.one_case
@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize(
    "sizes",
    [{"v": 1e-300, "a": 1e-300}, {"v": 5e-324, "a": 1.0}, {"v": 1e40, "a": 1e-40}, {"v": 1e-160, "a": 1e-308}],
    ids=str,
)
def test_extremes_are_within_their_bounds(sizes, backend):
    model = tw.load("double_pendulum")
    for weight in (model, replace(model, gravity=np.zeros(3))):
        check(weight, "rnea", states(weight, "rnea", 30, **sizes), backend=backend)
        check(weight, "aba", states(weight, "aba", 30, v=sizes["v"], tau=sizes["a"]), backend=backend)


@pytest.mark.one_case
@pytest.mark.parametrize("backend", BACKENDS)
def test_states_of_the_textbook_have_the_closer_bound(backend):
    """Of an angle above 2¹⁷ rad the textbook takes the sine, and the bound is that of ``bound=True``."""
    model = tw.load("double_pendulum")
    q = np.array([[0.3, 1.0], [2.0**18 + 1.0, 0.5], [0.3, 1.0]])
    value, bound = compile(model, "gravity", bound="running", backend=backend)(q)
    for k in (0, 1):
        one = compile(model, "gravity", bound="running", backend=backend)(q[k])
        np.testing.assert_array_equal([value[k], bound[k]], one)
    closer = compile(model, "gravity", bound=True, backend=backend)(q[1])
    np.testing.assert_array_equal([value[1], bound[1]], closer)
    np.testing.assert_array_equal(value[0], value[2])


@pytest.mark.parametrize("backend", BACKENDS)
def test_one_state_many_and_wrenches(backend):
    model = tw.load("double_pendulum")
    q, v, a = states(model, "rnea", 40)
    program = compile(model, "rnea", bound="running", backend=backend)
    value, bound = program(q.reshape(4, 10, -1), v.reshape(4, 10, -1), a.reshape(4, 10, -1))
    assert value.shape == bound.shape == (4, 10, model.nv)
    one, its_bound = program(q[7], v[7], a[7])
    named = program(q[7], v=v[7], a=list(a[7]))
    np.testing.assert_array_equal([one, its_bound], [value[0, 7], bound[0, 7]])
    np.testing.assert_array_equal([one, its_bound], named)
    f = np.zeros((model.nbodies, 6))
    f[2] = 3.0
    pushed, larger = program(q, v, a, f)
    assert (abs(pushed - value.reshape(pushed.shape)).max(axis=1) > 0.01).all()
    assert (larger > 0).all()
    assert program(np.zeros((0, 2)), v[0], a[0])[1].shape == (0, 2)


@pytest.mark.parametrize("backend", BACKENDS)
def test_several_quantities(backend):
    model = tw.load("double_pendulum")
    q, v = states(model, "rnea", 5)[:2]
    program = compile(model, ["M", "h"], bound="running", backend=backend)
    value, bound = program(q, v)
    one, its_bound = program(q[0], v[0])
    assert value.M.shape == bound.M.shape == (5, 2, 2)
    np.testing.assert_array_equal(value.M[0], one.M)
    np.testing.assert_array_equal(bound.h[0], its_bound.h)
    np.testing.assert_array_equal(compile(model, "M", bound="running", backend=backend)(q)[1], bound.M)


@llvm
def test_the_value_is_the_programs():
    model = tw.load("panda")
    args = states(model, "aba", 30)
    np.testing.assert_array_equal(compile(model, "aba", bound="running")(*args)[0], compile(model, "aba")(*args))


def test_errors_are_the_programs():
    model = tw.load("go2")
    q, v = model.standing(), np.zeros(model.nv)
    program = compile(model, "rnea", bound="running")
    for bad in (np.nan, np.inf):
        with pytest.raises(ValueError, match="v"):
            program(q, np.where(np.arange(model.nv) == 7, bad, v), v)
        with pytest.raises(ValueError, match="a"):
            program(np.tile(q, (30, 1)), v, np.full((30, model.nv), bad))
    with pytest.raises(ValueError, match="norm"):
        program(q * 1.1, v, v)
    with pytest.raises(tw.ShapeError, match="q: expected"):
        program(q[1:], v, v)
    with pytest.raises(TypeError, match="a missing"):
        program(q, v)
    with pytest.raises(ValueError, match="complex128"):
        program(q, v + 0j, v)
    pole = tw.load("cart_pole")
    weightless = replace(pole, inertia=(*pole.inertia[:-1], tw.SpatialInertia.zero()), armature=np.zeros(2))
    with pytest.raises(tw.SingularError, match="no inertia"):
        compile(weightless, "aba", bound="running")(np.zeros(2), np.zeros(2), np.zeros(2))


@pytest.mark.parametrize("dtype", [np.longdouble, np.complex128, "double-double", "mpmath"])
def test_other_numbers_are_refused(dtype):
    with pytest.raises(TypeError, match="bound: expected dtype float32 or float64"):
        compile(tw.load("pendulum"), "gravity", dtype=dtype, bound="running")


def test_another_word_is_refused():
    with pytest.raises(ValueError, match="bound: expected 'running', got 'tight'"):
        compile(tw.load("pendulum"), "gravity", bound="tight")


def test_it_pickles():
    program = compile(tw.load("double_pendulum"), "M", dtype=np.float32, bound="running")
    copy, q = pickle.loads(pickle.dumps(program)), np.array([0.3, 2.0], np.float32)
    assert (repr(copy), copy.operations) == (repr(program), program.operations)
    assert "running bound" in repr(program)
    np.testing.assert_array_equal(copy(q), program(q))


@pytest.mark.slow
@llvm
def test_a_bound_takes_few_operations():
    """Counted, since times depend on the machine; the arguments of a rotation are shared."""
    for name in ("rnea", "crba"):
        plain, bounded = (compile(tw.load("go2"), name, bound=bound) for bound in (False, "running"))
        assert bounded.operations.total() < 3.5 * plain.operations.total()

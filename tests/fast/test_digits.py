"""Programs of 32 digits, and bounds that hold, against mpmath and against the 50-digit Newton-Euler of 49.1."""

import pickle
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import twistwrench as tw
from straightline import DoubleDouble
from straightline.llvm import available
from twistwrench import compile
from twistwrench import newton_euler_3d as ne

from ..sampling import sampled
from ..strategies import examples, random_state, recipes

mpmath = pytest.importorskip("mpmath")

llvm = pytest.mark.skipif(not available(), reason="llvmlite is not installed")
BACKENDS = [pytest.param("llvm", marks=llvm), "numpy"]
TRUTH = {
    "rnea": (ne.inverse_dynamics, "q v a"),
    "aba": (ne.forward_dynamics, "q v tau"),
    "crba": (ne.mass_matrix, "q"),
    "centroidal_map": (ne.centroidal_map, "q"),
}
WAYS = [*((name, "numpy") for name in TRUTH), pytest.param("rnea", "llvm", marks=llvm)]
DIGITS = 1e-30
NOISE = 1e-37
"""Of the truth, relative to its largest entry: an axis that is a unit vector exactly is within 2⁻¹²⁷ of the joint's."""


@pytest.fixture(autouse=True)
def sixty_digits():
    with mpmath.workdps(60):
        yield


def whole(pair):
    """Return the sum of a pair, exactly."""
    return ne.as_mpmath(pair.hi) + ne.as_mpmath(pair.lo)


def aligned(model):
    """Return the model with each joint's frame parallel to its parent's: rotations that are exact in every number."""
    return replace(
        model, placement=tuple(None if T is None else tw.SE3(np.eye(3), T.translation) for T in model.placement)
    )


def relative(found, right):
    return float(abs(found - right).max() / abs(right).max())


def arguments(model, name, rng=0):
    state = random_state(model, rng=rng)._asdict()
    return [state[x] for x in TRUTH[name][1].split()]


@cache
def of_go2(name, dtype=np.float64):
    """Return a state of Go2, in numbers of a type, and the truth."""
    model = tw.load("go2")
    args = [x.astype(dtype) for x in arguments(model, name)]
    with mpmath.workdps(60):
        return model, args, TRUTH[name][0](model, *(ne.as_mpmath(x) for x in args))


# ---------------------------------------------------------------- programs of 32 digits


@pytest.mark.slow
@pytest.mark.one_case
@pytest.mark.parametrize(("name", "backend"), sampled(WAYS, 2, several=True))
def test_go2_has_thirty_digits(name, backend):
    model, args, right = of_go2(name)
    found = compile(model, name, dtype="double-double", backend=backend)(*args)
    assert relative(whole(found), right) < DIGITS
    assert (found.hi + found.lo == found.hi).all()


@given(recipe=recipes(3), name=st.sampled_from([*TRUTH]))
@examples(4)
def test_trees_of_every_joint_have_thirty_digits_and_bounds_that_hold(recipe, name):
    model = aligned(recipe.model)
    args = arguments(model, name, recipe.seed)
    with mpmath.workdps(60):
        right = TRUTH[name][0](model, *(ne.as_mpmath(x) for x in args))
        program = compile(model, name, backend="numpy", bound=True)
        pairs = compile(model, name, backend="numpy", dtype="double-double", bound=True)
        found, bound = pairs(*args)  # as the program compares itself with
        off, noise = abs(whole(found) - right), NOISE * abs(right).max()
        assert (off <= bound + noise).all()
        assert float(off.max()) <= DIGITS * float(abs(right).max()) or name == "aba"  # whose M may be near singular
        value, bound = program(*args)
        assert (abs(ne.as_mpmath(value) - right) <= bound + noise).all()


@pytest.mark.slow
@pytest.mark.parametrize("backend", BACKENDS)
def test_pairs_go_in_and_batches_and_wrenches(backend):
    model = aligned(tw.random_tree(4, rng=2, base="floating"))
    s = random_state(model, rng=3)
    program = compile(model, "rnea", dtype="double-double", backend=backend)
    f = np.zeros((model.nbodies, 6))
    low = s.v * 2.0**-54 / 3
    one = program(s.q, DoubleDouble(s.v, low), s.a)
    right = ne.inverse_dynamics(model, ne.as_mpmath(s.q), ne.as_mpmath(s.v) + ne.as_mpmath(low), ne.as_mpmath(s.a))
    assert relative(whole(one), right) < DIGITS
    assert relative(whole(program(s.q, s.v, s.a)), right) > 1e-20  # the low parts do count
    many = program(np.tile(s.q, (2, 9, 1)), DoubleDouble(s.v, low), a=s.a, f_ext=f)
    assert many.hi.shape == (2, 9, model.nv)
    assert (many.hi[1, 8] == one.hi).all()
    assert (many.lo[1, 8] == one.lo).all()
    assert program(np.zeros((0, model.nq)), s.v, s.a).lo.shape == (0, model.nv)
    moved = program(s.q, DoubleDouble(s.v + low, -low / 2), s.a)  # the same numbers, written otherwise
    assert relative(whole(moved), right) < 1e-15


@pytest.mark.skipif(np.finfo(np.longdouble).eps == np.finfo(float).eps, reason="long doubles are doubles here")
def test_a_long_double_keeps_its_digits():
    third = np.array([1], np.longdouble) / 3
    found = compile(tw.load("pendulum"), "gravity", dtype="double-double", backend="numpy")(third)
    exact = mpmath.mpf(9.81) * mpmath.sin(ne.as_mpmath(third)[0])
    assert abs(whole(found)[0] - exact) < DIGITS
    assert abs(mpmath.mpf(9.81) * mpmath.sin(mpmath.mpf(float(third[0]))) - exact) > 1e-20  # the double's next to it


def test_complex_numbers_are_refused():
    for options in ({"dtype": "double-double"}, {"bound": True}):
        with pytest.raises(ValueError, match=r"^q: expected real numbers, got complex128"):
            compile(tw.load("pendulum"), "gravity", backend="numpy", **options)([0.3 + 1e-30j])


@pytest.mark.slow
def test_several_results_are_pairs_by_name():
    model = tw.load("panda")
    q = model.neutral() + 0.3
    both, bound = compile(model, ["M", "g"], dtype="double-double", backend="numpy", bound=True)(q)
    assert relative(whole(both.M), ne.mass_matrix(model, ne.as_mpmath(q))) < 1e-15  # its placements are no rotations
    assert both.g.lo.shape == bound.g.shape == (model.nv,)
    assert bound.M.max() < 1e-25


@pytest.mark.parametrize("options", [{"dtype": "double-double", "bound": True}, {"dtype": np.float32, "bound": True}])
def test_programs_of_digits_pickle(options):
    model = tw.load("double_pendulum")
    program = compile(model, "M", backend="numpy", **options)
    copy, q = pickle.loads(pickle.dumps(program)), np.array([0.3, 2.0])
    assert (repr(copy), copy.arguments, copy.operations) == (repr(program), program.arguments, program.operations)
    for one, other in zip(program(q), copy(q), strict=True):
        np.testing.assert_array_equal(np.asarray(one), np.asarray(other))


@pytest.mark.slow
def test_errors_are_the_textbooks():
    model = tw.load("go2")
    q, v = model.standing(), np.zeros(model.nv)
    program = compile(model, "rnea", dtype="double-double", backend="numpy")
    with pytest.raises(tw.ShapeError, match="q: expected"):
        program(q[1:], v, v)
    with pytest.raises(tw.ShapeError, match="v: expected hi and lo of the same shape"):
        program(q, DoubleDouble(v, v[1:]), v)
    with pytest.raises(ValueError, match="v: expected finite"):
        program(q, DoubleDouble(v, v + np.nan), v)
    with pytest.raises(ValueError, match="norm"):
        program(q * 1.1, v, v)
    with pytest.raises(ValueError, match=r"angles up to 2\*\*45"):
        program(np.concatenate([q[:7], q[7:] + 2.0**47]), v, v)
    with pytest.raises(TypeError, match="a missing"):
        program(q, v)
    pole = tw.load("cart_pole")
    weightless = replace(pole, inertia=(*pole.inertia[:-1], tw.SpatialInertia.zero()), armature=np.zeros(2))
    with pytest.raises(tw.SingularError, match="no inertia"):
        compile(weightless, "aba", dtype="double-double", backend="numpy")(np.zeros(2), np.zeros(2), np.zeros(2))
    with pytest.raises(TypeError, match="bound: expected dtype"):
        compile(model, "rnea", dtype=np.longdouble, bound=True)


# ---------------------------------------------------------------- bounds


@pytest.mark.slow
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize(("name", "backend"), sampled(WAYS, 1, several=True))
def test_bounds_hold_and_are_close(name, backend, dtype):
    model, args, right = of_go2(name, dtype)
    value, bound = compile(model, name, backend=backend, dtype=dtype, bound=True)(*args)
    assert value.dtype == bound.dtype == dtype
    assert value.shape == bound.shape
    off, noise = abs(ne.as_mpmath(value) - right), NOISE * abs(right).max()
    assert (off <= ne.as_mpmath(bound) + noise).all()
    sure = off > noise
    assert np.median((ne.as_mpmath(bound)[sure] / off[sure]).astype(float)) < 1.01
    plain = compile(model, name, backend=backend, dtype=dtype)(*args)
    assert (plain == value).all()

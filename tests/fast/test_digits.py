"""Programs of 32 digits, and bounds that hold, against mpmath and against the 50-digit Newton-Euler of 49.1."""

import pickle
from dataclasses import replace
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import twistwrench as tw
from straightline import DoubleDouble
from straightline.double_double import double_double
from straightline.line import Line
from straightline.llvm import MachineCode, available
from straightline.number import Tape, numbers
from straightline.pairs import two_sum
from straightline.registers import Registers
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


def run(line, arrays, fma):
    """Return the results of a line for the states in the rows of arrays."""
    results = [np.empty((len(arrays[0]), len(entries))) for _, entries in line.outputs.values()]
    code = MachineCode(line, np.dtype(float), 1) if fma else Registers(line, np.dtype(float))
    code.run([*arrays, *results])
    return dict(zip(line.outputs, results))


def of_inputs(function, count):
    """Return the line of a function of so many numbers."""
    tape = Tape()
    x = numbers(tape, "x", count)
    return Line.of(tape, {"x": (count,)}, {"y": np.asarray(function(*x), object)})


# ---------------------------------------------------------------- operations on pairs


def test_what_a_sum_is_rounded_by_is_kept():
    tape = Tape()
    a, b = tape.input(("x", 0)), tape.input(("x", 1))
    s, e = two_sum(a, b)
    line = Line.of(tape, {"x": (2,)}, {"s": np.array(s, object), "e": np.array(e, object)})
    assert line.operations.total() == 6
    found = run(line, [np.array([[1.0, 2.0**-60]])], fma=False)
    assert (found["s"], found["e"]) == (1.0, 2.0**-60)


@pytest.mark.parametrize("fma", [pytest.param(True, marks=llvm), False])
@pytest.mark.parametrize(
    ("operation", "limit"),
    [
        (lambda x, y: x + y, 3),
        (lambda x, y: x - y, 3),
        (lambda x, y: x * y, 7),
        (lambda x, y: x / y, 15),
        (lambda x, _: x.sqrt() if hasattr(x, "sqrt") else mpmath.sqrt(x), 4),
        (lambda x, y: x * y - y * y, None),
        (lambda x, _: x / Fraction(7, 3), 16),
    ],
    ids=["+", "-", "×", "÷", "√", "× and -", "÷ 7/3"],
)
def test_operations_on_pairs_are_as_right_as_was_proved(operation, limit, fma):
    rng = np.random.default_rng(0)
    line = of_inputs(lambda x, y: operation(x, y), 2)
    line = double_double(line, low=("x",), fma=fma, bound=True)
    hi = np.abs(rng.standard_normal((500, 2))) * 10.0 ** rng.uniform(-9, 9, (500, 2))
    hi[250:, 1] = hi[250:, 0] * (1 + rng.standard_normal(250) * 1e-12)  # sums that cancel
    lo = hi * rng.uniform(-1, 1, hi.shape) * 2.0**-54
    found = run(line, [hi, lo], fma)
    right = [operation(*x) for x in ne.as_mpmath(hi) + ne.as_mpmath(lo)]
    off = abs(ne.as_mpmath(found["y"][:, 0]) + ne.as_mpmath(found["y.lo"][:, 0]) - right)
    assert (off <= found["y.bound"][:, 0]).all()
    if limit is not None:
        assert float((off / np.abs(right)).max()) <= limit * 2.0**-106


@pytest.mark.parametrize("fma", [pytest.param(True, marks=llvm), False])
@pytest.mark.parametrize("size", [1e-12, 1.0, 4.0, 1e5, 1e9, 2.0**44])
def test_sin_and_cos_of_a_pair_have_all_digits(fma, size):
    rng = np.random.default_rng(0)
    line = double_double(of_inputs(lambda x: [x.sin(), x.cos()], 1), low=("x",), fma=fma, bound=True)
    hi = rng.uniform(-size, size, (200, 1))
    hi[:4, 0] = [0.0, np.pi / 2, -np.pi, 3 * np.pi / 4]
    lo = hi * rng.uniform(-1, 1, hi.shape) * 2.0**-54
    found = run(line, [hi, lo], fma)
    for k, (x,) in enumerate(ne.as_mpmath(hi) + ne.as_mpmath(lo)):
        for j, right in enumerate([mpmath.sin(x), mpmath.cos(x)]):
            off = abs(mpmath.mpf(found["y"][k, j]) + mpmath.mpf(found["y.lo"][k, j]) - right)
            assert off <= 8 * mpmath.mpf(2) ** -106  # the worst of 72 000 was 2.0
            assert off <= found["y.bound"][k, j]


def test_sin_of_a_tiny_pair_is_relatively_right():
    line = double_double(of_inputs(lambda x: [x.sin()], 1), low=(), fma=False)
    x = 10.0 ** -np.arange(0, 200, 20.0)[:, None]
    found = run(line, [x], fma=False)
    right = [mpmath.sin(one) for one in ne.as_mpmath(x[:, 0])]
    off = ne.as_mpmath(found["y"][:, 0]) + ne.as_mpmath(found["y.lo"][:, 0]) - right
    assert (abs(off) <= 2.0**-100 * np.abs(right)).all()


# ---------------------------------------------------------------- programs of 32 digits


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


def test_nothing_is_certain_of_a_division_by_what_may_be_zero():
    line = of_inputs(lambda x, y: [1 / ((x + y) - x), x.sin()], 2)
    found = run(double_double(line, fma=False, bound=True), [np.array([[2.0**50, 2.0**-90]])], fma=False)
    assert np.isnan(found["y.bound"][0, 0])
    assert np.isnan(found["y"][0, 1])  # the sine of an angle that is too large


def test_a_bound_notices_what_a_sum_has_lost():
    """((x + y) + y²) − x − y with y² far below the last digit of x: the result is off by y², and the bound knows."""
    line = double_double(of_inputs(lambda x, y: [((x + y) + y * y) - x - y], 2), low=(), fma=False, bound=True)
    found = run(line, [np.array([[1.0, 2.0**-80]])], fma=False)
    off = abs(found["y"][0, 0] + found["y.lo"][0, 0] - 2.0**-160)
    assert 0 < off <= found["y.bound"][0, 0] < 2.0**-90

"""Programs in quadruple precision, long doubles and mpmath's numbers, against the 50-digit Newton-Euler of 49.1."""

import pickle
import sys
from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import compile
from twistwrench import newton_euler_3d as ne

from ..sampling import sampled
from ..strategies import random_state
from .test_digits import TRUTH, aligned, arguments, of_go2, relative

mpmath = pytest.importorskip("mpmath")
try:
    import numpy_quaddtype
except ImportError:
    numpy_quaddtype = None
quad = pytest.param("quad", marks=pytest.mark.skipif(numpy_quaddtype is None, reason="numpy-quaddtype is missing"))
WIDE = [quad, "mpmath"]
LEAST = {"quad": 1e-33, "mpmath": 1e-47}
"""Of 113 bits and of 50 digits, relative to the largest entry."""


@pytest.fixture(autouse=True)
def fifty_digits():
    with mpmath.workdps(50):
        yield


def exactly(x):
    """Return numbers of any type as mpmath's, without rounding."""
    if x.dtype == object:
        return x
    with mpmath.workdps(60):
        parts = []
        for _ in range(3):
            parts.append(x.astype(float))
            x = x - parts[-1]
        return sum(ne.as_mpmath(part) for part in parts)


@pytest.mark.parametrize("number", WIDE)
def test_an_energy_of_one_state_is_a_number(number):
    program = compile(tw.load("pendulum"), ("kinetic_energy", "potential_energy"), dtype=number)
    found = program([0.3], [0.2])
    assert float(found.T) == pytest.approx(1.001 * 0.2**2 / 2, rel=1e-14)
    assert float(found.U) == pytest.approx(-9.81 * np.cos(0.3), rel=1e-14)


@pytest.mark.parametrize("number", [None, "mpmath", "double-double"])
def test_results_of_any_numbers_show_their_shapes(number):
    program = compile(tw.load("pendulum"), ("kinetic_energy", "M"), dtype=number or float)
    assert repr(program([[0.3]] * 5, [0.2])) == "Results(T: (5,), M: (5, 1, 1))"


@pytest.mark.one_case
@pytest.mark.parametrize("number", WIDE)
@pytest.mark.parametrize("name", sampled(TRUTH, 2))
def test_go2_has_all_digits(name, number):
    model, args, right = of_go2(name)
    program = compile(model, name, dtype=number)
    found = program(*args)
    assert relative(exactly(found), right) < LEAST[number]
    assert program.operations == compile(model, name).operations
    assert f"{number}, numpy>" in repr(program)
    assert program.source() == compile(model, name).source()
    assert program.model is model


@pytest.mark.skipif(np.finfo(np.longdouble).eps == np.finfo(float).eps, reason="long doubles are doubles here")
@pytest.mark.parametrize("name", TRUTH)
def test_long_doubles_have_all_digits(name):
    model, args, right = of_go2(name)
    found = compile(model, name, dtype=np.longdouble)(*args)
    assert found.dtype == np.longdouble
    assert relative(exactly(found), right) < 8 * np.finfo(np.longdouble).eps


@pytest.mark.parametrize("number", WIDE)
@pytest.mark.parametrize("name", TRUTH)
def test_trees_of_every_joint(name, number):
    """An oblique axis is a unit vector to 38 digits: both are right to 33."""
    model = aligned(tw.random_tree(5, rng=4, base="floating"))
    args = arguments(model, name, rng=1)
    right = TRUTH[name][0](model, *(ne.as_mpmath(x) for x in args))
    assert relative(exactly(compile(model, name, dtype=number)(*args)), right) < 1e-32


@pytest.mark.parametrize("digits", [20, 200])
def test_the_digits_are_those_at_the_call(digits):
    """M of a pendulum is constant, its weight m g l sin q, g a double."""
    program = compile(tw.load("pendulum"), "gravity", dtype="mpmath")
    for dps in (digits, 30, digits):
        with mpmath.workdps(dps):
            (found,) = program([mpmath.mpf(1) / 3])
            right = mpmath.mpf(9.81) * mpmath.sin(mpmath.mpf(1) / 3)
            assert abs(found - right) <= 4 * mpmath.mpf(10) ** -dps * right
    with mpmath.workdps(200):
        assert abs(found - right) < 10.0**-digits  # and no more than those


@pytest.mark.parametrize("number", WIDE)
@pytest.mark.parametrize("angle", [1e8, 2.0**60, 1e30])
def test_large_angles_are_right(number, angle):
    (found,) = exactly(compile(tw.load("pendulum"), "gravity", dtype=number)([angle]))
    with mpmath.workdps(90):
        right = mpmath.mpf(9.81) * mpmath.sin(mpmath.mpf(angle))
        assert abs(found - right) < abs(right) * 1e-32


@pytest.mark.one_case
@pytest.mark.parametrize("number", WIDE)
def test_wide_numbers_go_in_and_batches_and_wrenches(number):
    model = aligned(tw.random_tree(4, rng=2, base="floating"))
    s = random_state(model, rng=3)
    program = compile(model, ["tau", "M"], dtype=number, threads=2)
    low = s.v * 2.0**-60 / 3
    v = ne.as_mpmath(s.v) + ne.as_mpmath(low)
    given = v if number == "mpmath" else s.v.astype(program.dtype) + low
    one = program(s.q, given, a=s.a)
    right = ne.inverse_dynamics(model, ne.as_mpmath(s.q), v, ne.as_mpmath(s.a))
    assert relative(exactly(one.tau), right) < 1e-32
    assert relative(exactly(program(s.q, s.v, s.a).tau), right) > 1e-20  # the digits do count
    many = program(np.tile(s.q, (2, 70, 1)), given, s.a, np.zeros((model.nbodies, 6)))
    assert many.tau.shape == (2, 70, model.nv)
    assert (many.tau[1, 69] == one.tau).all()
    assert many.M.dtype == program.dtype
    assert program(np.zeros((0, model.nq)), s.v, s.a).M.shape == (0, model.nv, model.nv)
    np.testing.assert_allclose(one.M.astype(float), program.program(s.q, s.v, s.a).M, rtol=0, atol=1e-13)


@pytest.mark.parametrize("number", WIDE)
def test_long_doubles_keep_their_digits(number):
    program = compile(tw.load("pendulum"), "gravity", dtype=number)
    q = np.array([np.longdouble(1) / 3])
    (right,) = exactly(np.sin(q.astype(program.dtype))) if number == "quad" else [mpmath.sin(exactly(q)[0])]
    assert abs(exactly(program(q))[0] - right * mpmath.mpf(9.81)) < 1e-32


@pytest.mark.parametrize("number", WIDE)
def test_errors_are_the_textbooks(number):
    model = tw.load("go2")
    q, v = model.standing(), np.zeros(model.nv)
    program = compile(model, "rnea", dtype=number)

    def own(*x):
        return np.array(x).astype(program.dtype) if number == "quad" else np.array([mpmath.mpf(one) for one in x])

    with pytest.raises(tw.ShapeError, match="q: expected"):
        program(q[1:], v, v)
    with pytest.raises(tw.ShapeError, match="v: expected"):
        program(q, own(*v[1:]), v)
    with pytest.raises(tw.ShapeError, match="v: expected a rectangular array"):
        program(q, [[1.0], [1.0, 2.0]], v)
    with pytest.raises(ValueError, match="v: expected finite"):
        program(q, own(np.nan, *v[1:]), v)
    with pytest.raises(ValueError, match=r"v: expected .*numbers"):
        program(q, ["one"] * model.nv, v)
    with pytest.raises(ValueError, match="v: expected at most"):
        program(q, own(1e80, *v[1:]), v)
    with pytest.raises(ValueError, match="norm"):
        program(q * 1.1, v, v)
    with pytest.raises(TypeError, match="a missing"):
        program(q, v)
    with pytest.raises(TypeError, match="bound: expected dtype"):
        compile(model, "rnea", dtype=number, bound=True)
    with pytest.raises(TypeError, match='backend="numpy" has it'):
        compile(model, "rnea", dtype=number, backend="llvm")


@pytest.mark.parametrize("number", WIDE)
def test_complex_numbers_are_refused(number):
    program = compile(tw.load("pendulum"), "gravity", dtype=number)
    for q in ([0.3 + 1e-30j], np.array([0.3j], np.clongdouble)):
        with pytest.raises(ValueError, match="q: expected real numbers, got complex"):
            program(q)


def test_complex_numbers_of_mpmath_are_refused():
    with pytest.raises(ValueError, match="q: expected floating-point numbers, got mpc"):
        compile(tw.load("pendulum"), "gravity", dtype="mpmath")([mpmath.mpc(1, 1)])


@pytest.mark.parametrize("number", WIDE)
def test_a_singular_state_is_named(number):
    pole = tw.load("cart_pole")
    weightless = replace(pole, inertia=(*pole.inertia[:-1], tw.SpatialInertia.zero()), armature=np.zeros(2))
    with pytest.raises(tw.SingularError, match="no inertia"):
        compile(weightless, "aba", dtype=number)(np.zeros(2), np.zeros(2), np.zeros(2))


@pytest.mark.parametrize("number", WIDE)
def test_they_pickle(number):
    program = compile(tw.load("double_pendulum"), "M", dtype=number)
    copy, q = pickle.loads(pickle.dumps(program)), np.array([0.3, 2.0])
    assert repr(copy) == repr(program)
    assert (copy(q) == program(q)).all()


@pytest.mark.parametrize(("number", "package"), [("quad", "numpy-quaddtype"), ("mpmath", "mpmath")])
def test_what_is_not_installed_is_named(number, package, monkeypatch):
    monkeypatch.setitem(sys.modules, package.replace("-", "_"), None)
    with pytest.raises(ImportError, match=f'dtype: "{number}" needs {package}: pip install'):
        compile(tw.load("pendulum"), "gravity", dtype=number)

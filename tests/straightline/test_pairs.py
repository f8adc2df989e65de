"""Arithmetic with pairs of doubles and proved bounds, against mpmath."""

from fractions import Fraction

import numpy as np
import pytest

from straightline.double_double import double_double
from straightline.line import Line
from straightline.llvm import MachineCode, available
from straightline.number import Tape, numbers
from straightline.pairs import two_sum
from straightline.registers import Registers

mpmath = pytest.importorskip("mpmath")

llvm = pytest.mark.skipif(not available(), reason="llvmlite is not installed")


@pytest.fixture(autouse=True)
def sixty_digits():
    with mpmath.workdps(60):
        yield


def exactly(x):
    """Return doubles in mpmath's numbers."""
    return np.array([mpmath.mpf(float(one)) for one in np.ravel(x)], object).reshape(np.shape(x))


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
    right = [operation(*x) for x in exactly(hi) + exactly(lo)]
    off = abs(exactly(found["y"][:, 0]) + exactly(found["y.lo"][:, 0]) - right)
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
    for k, (x,) in enumerate(exactly(hi) + exactly(lo)):
        for j, right in enumerate([mpmath.sin(x), mpmath.cos(x)]):
            off = abs(mpmath.mpf(found["y"][k, j]) + mpmath.mpf(found["y.lo"][k, j]) - right)
            assert off <= 8 * mpmath.mpf(2) ** -106  # the worst of 72 000 was 2.0
            assert off <= found["y.bound"][k, j]


def test_sin_of_a_tiny_pair_is_relatively_right():
    line = double_double(of_inputs(lambda x: [x.sin()], 1), low=(), fma=False)
    x = 10.0 ** -np.arange(0, 200, 20.0)[:, None]
    found = run(line, [x], fma=False)
    right = [mpmath.sin(one) for one in exactly(x[:, 0])]
    off = exactly(found["y"][:, 0]) + exactly(found["y.lo"][:, 0]) - right
    assert (abs(off) <= 2.0**-100 * np.abs(right)).all()


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

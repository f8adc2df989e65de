"""The bound that goes along beside each number, against exact numbers and 60 digits."""

from fractions import Fraction

import numpy as np
import pytest

from straightline.backend import BackEnd
from straightline.double_double import BOUND
from straightline.line import Line
from straightline.llvm import available
from straightline.number import Tape, numbers
from straightline.running import with_running_bound
from straightline.sine import PI, SINE_ROUNDINGS, known_sines, split

mpmath = pytest.importorskip("mpmath")

llvm = pytest.mark.skipif(not available(), reason="llvmlite is not installed")
BACKENDS = [pytest.param("llvm", marks=llvm), "numpy"]
DOUBLE, SINGLE = np.dtype(np.float64), np.dtype(np.float32)
TYPES = [DOUBLE, SINGLE]


@pytest.fixture(autouse=True)
def many_digits():
    with mpmath.workdps(120):
        yield


class Exact:
    """A number of many digits with the functions of a recorded one."""

    def __init__(self, x):
        self.x = x if isinstance(x, mpmath.mpf) else mpmath.mpf(x.numerator) / x.denominator

    def __add__(self, other):
        return Exact(self.x + as_exact(other))

    def __sub__(self, other):
        return Exact(self.x - as_exact(other))

    def __mul__(self, other):
        return Exact(self.x * as_exact(other))

    def __truediv__(self, other):
        return Exact(self.x / as_exact(other) if as_exact(other) else mpmath.nan)

    def __neg__(self):
        return Exact(-self.x)

    def sin(self):
        return Exact(mpmath.sin(self.x))

    def cos(self):
        return Exact(mpmath.cos(self.x))

    def sqrt(self):
        return Exact(mpmath.sqrt(self.x) if self.x >= 0 else mpmath.nan)

    __radd__, __rmul__ = __add__, __mul__


def as_exact(x):
    return x.x if isinstance(x, Exact) else Exact(Fraction(x)).x


def recorded(function, count):
    tape = Tape()
    x = numbers(tape, "x", count)
    return Line.of(tape, {"x": (count,)}, {"y": np.array(function(*x), object)})


def with_bounds(function, states, backend, dtype=DOUBLE):
    """Return the results, their bounds, and how far they are off."""
    line = recorded(function, states.shape[1])
    running = with_running_bound(line, dtype, fma=backend == "llvm")
    codes = BackEnd(running, dtype, backend), BackEnd(line, dtype, backend)
    for code in codes:
        code.few = 0  # plain Python, where NumPy would take a few states, has other sines
    found, plain = (code.results({"x": states.astype(dtype)}, (len(states),)) for code in codes)
    np.testing.assert_array_equal(found["y"], plain["y"])  # to the last bit
    off = np.empty(found["y"].shape)
    for k, state in enumerate(states.astype(dtype)):
        right = function(*[Exact(Fraction(float(x))) for x in state])
        for j, one in enumerate(right):
            y = float(found["y"][k, j])
            off[k, j] = above(abs(mpmath.mpf(y) - one.x)) if np.isfinite(y) else np.inf
    return found["y"].astype(float), found["y" + BOUND].astype(float), off


def above(x):
    """Return a double that is not smaller."""
    return float(x) if mpmath.mpf(float(x)) >= x else np.nextafter(float(x), np.inf)


def drawn(count, width, dtype, rng):
    """Return numbers of all sizes: usual ones, tiny and huge ones, subnormal ones, zeros, and pairs that cancel."""
    info = np.finfo(dtype)
    usual = rng.standard_normal((count, width)) * 10.0 ** rng.uniform(-6, 6, (count, width))
    lowest, highest = np.log10(float(info.smallest_subnormal)), np.log10(float(info.max))
    wide = np.sign(rng.standard_normal((count, width))) * 10.0 ** rng.uniform(lowest, highest, (count, width))
    tiny = rng.integers(-5, 6, (count, width)) * float(info.smallest_subnormal)
    alike = usual[:, :1] * (1 + rng.integers(-9, 10, (count, width)) * float(info.eps))
    return np.concatenate([usual, wide, tiny, alike]).astype(dtype)


OPERATIONS = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "×": lambda a, b: a * b,
    "÷": lambda a, b: a / b,
    "neg": lambda a, b: -(a + b),
    "√": lambda a, b: (a * a).sqrt(),
    "√ of a sum": lambda a, b: (a * a + b * b).sqrt(),
    "constants": lambda a, b: Fraction(1, 3) * a + Fraction(1, 10**9),
    "powers of two": lambda a, b: Fraction(1, 8) * a + 4 * b,
}
OPERANDS = {
    "arguments": lambda w, x, y, z: (w, x),
    "products": lambda w, x, y, z: (w * x, y * z),
    "sums": lambda w, x, y, z: (w + x, y - z),
    "constant and sum": lambda w, x, y, z: (Fraction(1, 7) * w, x + y),
    "sums of products": lambda w, x, y, z: (w * x + y * z, w * y - x * z),
}


@pytest.mark.parametrize("dtype", TYPES, ids=str)
@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("operation", OPERATIONS)
def test_no_operation_is_further_off_than_its_bound(operation, backend, dtype):
    rng = np.random.default_rng(len(operation))
    states = drawn(12, 4, dtype, rng)

    def function(*x):
        return [OPERATIONS[operation](*operands(*x)) for operands in OPERANDS.values()]

    y, bound, off = with_bounds(function, states, backend, dtype)
    finite = np.isfinite(y)
    assert not (bound[~finite] < np.inf).any()
    assert (off <= bound)[finite & ~np.isnan(bound) & ~np.isnan(off)].all()
    assert (finite & (bound < np.inf)).mean() > 0.4
    usual = (off > 0) & finite & (abs(y) > 1e-30) & (bound < np.inf)
    if usual.any():
        assert np.median(bound[usual] / off[usual]) < 40


@pytest.mark.parametrize("backend", BACKENDS)
def test_what_a_sum_has_lost_is_known(backend):
    """(x + y) − x with y below the last digit of x is 0, and off by y; and its square by y²."""

    def function(x, y):
        lost, another = (x + y) - x, (2 * x + y) - 2 * x
        return [lost, lost * x, lost * another]

    y, bound, off = with_bounds(function, np.array([[1.0, 2.0**-60]]), backend)
    assert (y == 0).all()
    np.testing.assert_array_equal(off, [[2.0**-60, 2.0**-60, 2.0**-120]])
    assert ((off <= bound) & (bound < 1e5 * off)).all()


@pytest.mark.parametrize("backend", BACKENDS)
def test_nothing_is_certain_of_a_quotient_by_what_may_be_zero(backend):
    state = np.array([[2.0**50, 2.0**-90]])
    _, bound, _ = with_bounds(lambda x, y: [x / ((x + y) - x)], state, backend)
    assert not bound[0, 0] < np.inf
    _, bound, _ = with_bounds(lambda x, y: [y / (x - y)], state, backend)
    assert bound[0, 0] < 1e-40


@pytest.mark.parametrize("backend", BACKENDS)
def test_what_is_exact_has_the_bound_zero(backend):
    _, bound, _ = with_bounds(lambda x: [x, -x, 4 * x], np.array([[0.3]]), backend)
    assert (bound == 0).all()


@pytest.mark.parametrize("dtype", TYPES, ids=str)
@pytest.mark.parametrize("backend", BACKENDS)
def test_roundings_of_the_bounds_themselves_are_counted(backend, dtype):
    """Each product doubles how many roundings stand behind the bound: soon they are too many for float32."""

    def function(x, y):
        for _ in range(8):
            x = (x + y) * (x - y)
            x = x / (x * x + 1)
        return [x]

    running = with_running_bound(recorded(function, 2), dtype, fma=backend == "llvm")
    assert (1 + Fraction(1, 2**8) in [node[1] for node in running.nodes if node[0] == "const"]) == (dtype == SINGLE)
    states = np.random.default_rng(0).uniform(-1, 1, (20, 2))
    _, bound, off = with_bounds(function, states, backend, dtype)
    assert (off[bound < np.inf] <= bound[bound < np.inf]).all()
    assert (bound < np.inf).any()


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("seed", range(4))
def test_lines_of_any_operations_are_within_their_bounds(seed, backend):
    choices = np.random.default_rng(seed).integers(0, 2**31, (60, 3))

    def function(*x):
        values = list(x)
        for kind, i, j in choices:
            a, b = values[i % len(values)], values[-1 - j % min(8, len(values))]
            ways = (a + b, a - b, a * b, a * a + b * b, Fraction(3, 7) * a + b, a.sin(), b.cos() * a)
            values.append(ways[kind % 7] if kind % 11 else a / (b * b + 1))
            values[-1] = values[-1] / (values[-1] * values[-1] + 1)  # stays below 1
        return values[-20:]

    states = np.random.default_rng(seed).standard_normal((6, 4))
    _, bound, off = with_bounds(function, states, backend)
    assert (off <= bound).all()


# ---------------------------------------------------------------- sines


@pytest.mark.parametrize("dtype", TYPES, ids=str)
@pytest.mark.parametrize("backend", BACKENDS)
def test_sines_are_within_their_bounds(backend, dtype):
    rng = np.random.default_rng(0)
    k = rng.integers(1, 80_000, 30)
    near = (k * np.pi / 2).astype(dtype)  # next to multiples of π/2
    sizes = 10.0 ** rng.uniform(-12, 5, 60) * rng.choice([-1, 1], 60)
    states = np.concatenate([near, sizes, [0.0, 2.0**17, -(2.0**17), 1e-30]])[:, None]
    y, bound, off = with_bounds(lambda x: [x.sin(), x.cos(), (x + x * x / 4096 / 64).sin()], states, backend, dtype)
    assert (off <= bound).all()
    usual = (off > 0) & (abs(y) > 1e-3)
    assert np.median(bound[usual] / off[usual]) < 40


def nearest_to_quarter_turns(dtype):
    """Return for each k up to 2¹⁷ rad k, and the distance of k π/2 from the number of the type that is next to it."""
    digits, scale = np.finfo(dtype).nmant + 1, 2**400
    quarter = int(PI / 2 * scale)
    for k in range(1, int(2**17 / float(PI / 2)) + 2):
        turned = k * quarter
        last = turned.bit_length() - digits
        nearest = ((turned + (1 << last >> 1)) >> last) << last
        yield k, abs(nearest - turned) / scale


@pytest.mark.slow
@pytest.mark.parametrize("dtype", TYPES, ids=str)
def test_no_number_is_so_close_to_a_quarter_turn_that_its_sine_loses_digits(dtype):
    """What two of three differences x − k π/2 round, and the digits of π that are left out, over what is left."""
    u, parts = 2.0 ** -(np.finfo(dtype).nmant + 1), split(PI / 2, 3, dtype.type)
    third, left_out = abs(float(parts[2])), abs(float(PI / 2 - sum(parts)))
    assert max((1.01 * u * k * third + k * left_out) / gap for k, gap in nearest_to_quarter_turns(dtype)) < u / 100


@llvm
@pytest.mark.parametrize("dtype", TYPES, ids=str)
def test_sines_of_machine_code_round_as_little_as_is_said(dtype):
    rng = np.random.default_rng(1)
    x = np.concatenate([rng.uniform(-4, 4, 1500), rng.uniform(-(2**17), 2**17, 500)]).astype(dtype)[:, None]
    line = recorded(lambda x: [x.sin(), x.cos()], 1)
    found = BackEnd(line, dtype, "llvm").results({"x": x}, (len(x),))["y"]
    u, worst = 2.0 ** -(np.finfo(dtype).nmant + 1), 0.0
    with mpmath.workdps(40):
        for (angle,), both in zip(x.tolist(), found.tolist()):
            for right, y in zip((mpmath.sin(angle), mpmath.cos(angle)), both):
                worst = max(worst, float(abs(mpmath.mpf(y) - right) / (u * abs(right))))
    assert 0.5 < worst < float(SINE_ROUNDINGS)


@pytest.mark.parametrize("dtype", TYPES, ids=str)
def test_sines_that_are_known_to_be_right_are(dtype):
    rng = np.random.default_rng(2)
    x = np.concatenate([rng.uniform(-4, 4, 200), rng.uniform(-(2**17), 2**17, 100)]).astype(dtype)[:, None]
    tape = Tape()
    *both, roundings, rest = known_sines(numbers(tape, "x", 1)[0], dtype)
    line = Line.of(tape, {"x": (1,)}, {"y": np.array(both, object)})
    found = BackEnd(line, dtype, "numpy").results({"x": x}, (len(x),))["y"]
    u = 2.0 ** -(np.finfo(dtype).nmant + 1)
    for (angle,), both in zip(x.tolist(), found.tolist()):
        for right, y in zip((mpmath.sin(angle), mpmath.cos(angle)), both):
            assert abs(mpmath.mpf(y) - right) <= float(roundings) * u * abs(right) + float(rest)


def test_an_operation_without_a_rule_is_refused():
    tape = Tape()
    x = tape.input(("x", 0))
    line = Line.of(tape, {"x": (1,)}, {"y": np.array([tape.apply("round", x)], object)})
    with pytest.raises(NotImplementedError, match="round"):
        with_running_bound(line, DOUBLE, fma=False)

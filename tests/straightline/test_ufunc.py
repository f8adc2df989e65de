"""A line as a function of NumPy's: the numbers of one state at a time, and the alarm for what it cannot read."""

import gc
import warnings

import numpy as np
import pytest

from straightline import BackEnd, straight_line
from straightline.llvm import available, lanes

pytestmark = pytest.mark.skipif(not available(), reason="llvmlite is not installed")

WIDTH = {dtype: lanes(np.dtype(dtype)) for dtype in (np.float32, np.float64)} if available() else {}


def turned(x, angle, f):
    """A vector, a matrix, nothing, a number, and last the alarm."""
    return np.cos(angle) * x + f[0], np.multiply.outer(x, x), x[:0], np.sqrt(angle), x[0] / 2


LINE = straight_line(turned, x=(2,), angle=(), f=(3, 2))


def made(dtype=np.float64, widths=None, line=LINE):
    backend = BackEnd(line, np.dtype(dtype), "llvm")
    for width in widths or (1, WIDTH[dtype]):
        backend.machine_code(width)
    return backend, backend.array_function()


BACKEND, FUNCTION = made()


def expected(x, angle, f):
    """One state after the other, in NumPy."""
    return np.cos(angle)[..., None] * x + f[..., 0, :], x[..., None] * x[..., None, :], np.sqrt(angle), x[..., 0] / 2


def arguments(*leading, dtype=np.float64):
    rng = np.random.default_rng(0)
    return [rng.uniform(0, 1, (*leading, *shape)).astype(dtype) for shape in ((2,), (), (3, 2))]


def check(found, right, tolerance=1e-15):
    vector, matrix, nothing, number, alarm = found
    assert nothing.shape == (*np.shape(alarm), 0)
    for x, y in zip((vector, matrix, number, alarm), right):
        assert np.shape(x) == np.shape(y)
        assert np.abs(x - y).max(initial=0) <= tolerance
    assert all(type(x) is np.ndarray and x.flags.carray for x in (vector, matrix, nothing, number))


@pytest.mark.parametrize("leading", [(), (1,), (3,), (40,), (3, 1), (5, 9), (0,), (2, 0)], ids=str)
@pytest.mark.parametrize("dtype", WIDTH)
def test_any_leading_axes_have_the_numbers_of_each_state(leading, dtype):
    x = arguments(*leading, dtype=dtype)
    found = made(dtype)[1].call(*x)
    assert {one.dtype for one in found} == {np.dtype(dtype)}
    check(found, expected(*x), 1e-15 if dtype == np.float64 else 1e-6)


def test_a_state_has_the_same_numbers_alone_and_among_others():
    x = arguments(21)
    together = FUNCTION.call(*x)
    for k in range(21):
        for one, many in zip(FUNCTION.call(*(part[k] for part in x)), together):
            assert np.array_equal(one, many[k])


VIEWS = {
    "every second": lambda x: x[::2],
    "backwards": lambda x: x[::-1],
    "axes exchanged": lambda x: x.reshape(4, 10, *x.shape[1:]).swapaxes(0, 1),
    "some of two axes": lambda x: x.reshape(4, 10, *x.shape[1:])[:, 1:9],
    "read only": lambda x: np.frombuffer(x.tobytes(), x.dtype).reshape(x.shape),
}


@pytest.mark.parametrize("view", VIEWS.values(), ids=VIEWS)
def test_states_may_lie_anywhere(view):
    x = [view(part) for part in arguments(40)]
    check(FUNCTION.call(*x), expected(*x))


def test_what_is_shared_by_states_is_given_once():
    x, angle, f = arguments(5, 7)
    each = np.broadcast_to(x[:, :1], x.shape), np.broadcast_to(angle[0], (5, 7)), np.broadcast_to(f[0, 0], f.shape)
    check(FUNCTION.call(x[:, :1], angle[0], f[0, 0]), expected(*each))


def test_unaligned_arrays_are_read():
    x, angle, f = arguments(3)
    shifted = np.frombuffer(b"\0" + x.tobytes(), float, offset=1).reshape(x.shape)
    assert not shifted.flags.aligned
    check(FUNCTION.call(shifted, angle, f), expected(x, angle, f))


@pytest.mark.parametrize("leading", [(), (5,), (30,)], ids=str)
def test_rows_with_gaps_raise_the_alarm_of_all_states(leading):
    x, angle, f = arguments(*leading)
    gaps = np.repeat(x, 2, -1)[..., ::2]
    assert (FUNCTION.call(gaps, angle, f)[-1] == np.inf).all()
    turned = f.mT.copy().mT
    assert (FUNCTION.call(x, angle, turned)[-1] == np.inf).all()


@pytest.mark.parametrize("count", [1, 30])
def test_states_without_machine_code_raise_the_alarm(count):
    """It is for who calls to have it made: of the other width there is some."""
    width = WIDTH[np.float64]
    backend, function = made(widths=[width if count == 1 else 1])
    x = arguments(count)
    assert (function.call(*x)[-1] == np.inf).all()
    backend.machine_code(1 if count == 1 else width)
    check(function.call(*x), expected(*x))


@pytest.mark.parametrize("shapes", [((3,), (), (3, 2)), ((2,), (), (2, 3)), ((4, 2), (3,), (3, 2)), ((), (), (3, 2))])
def test_shapes_that_do_not_fit_are_refused(shapes):
    with pytest.raises(ValueError):  # noqa: PT011 - NumPy's words
        FUNCTION.call(*map(np.zeros, shapes))


@pytest.mark.parametrize("leading", [(), (3,), (30,)], ids=str)
def test_arrays_of_the_caller_are_filled(leading):
    x = arguments(*leading)
    vector, number = np.full((*leading, 2), np.nan), np.full(leading, np.nan)
    found = FUNCTION.call(*x, out=(vector, None, None, number, None))
    assert found[0] is vector
    assert found[3] is number or not leading
    check([vector, found[1], found[2], number, found[4]], expected(*x))


def test_nothing_is_warned_of():
    """Also not where NumPy would: the alarm says what is not a number."""
    x, angle, f = arguments(30)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with np.errstate(all="raise"):
            found = FUNCTION.call(x * np.inf, -angle, 1e308 * f)
    assert np.isnan(found[3]).all()
    assert (found[4] == np.inf).all()


def test_lines_that_numpy_has_no_function_for_have_none():
    assert BackEnd(LINE, np.dtype(float), "numpy").array_function() is None
    assert BackEnd(straight_line(lambda x: x.sum(), x=(0,)), np.dtype(float), "llvm").array_function() is None
    many = straight_line(lambda x: tuple(x * k for k in range(40)), x=(1,))
    assert BackEnd(many, np.dtype(float), "llvm").array_function() is None


@pytest.mark.parametrize("leading", [(), (5,), (0,)], ids=str)
def test_where_all_results_are_empty_there_is_the_alarm(leading):
    line = straight_line(lambda x: (x[:0], np.multiply.outer(x[:0], x), x[0] / 2), x=(2,))
    x = np.full((*leading, 2), 3.0)
    function = made(line=line)[1]
    none, rows, alarm = function.call(x)
    assert (none.shape, rows.shape) == ((*leading, 0), (*leading, 0, 2))
    assert np.shape(alarm) == leading
    assert (alarm == 1.5).all()
    given = np.empty((*leading, 0))
    assert function.call(x, out=(given, None, None))[0] is given


def test_threads_can_call_it_at_the_same_time():
    from concurrent.futures import ThreadPoolExecutor

    x = arguments(2000)
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda _: FUNCTION.call(*x), range(20)):
            check(found, expected(*x))


def test_nothing_is_left_behind():
    import tracemalloc

    x, held = arguments(30), []
    tracemalloc.start()
    for count in (50, 500):
        for _ in range(count):
            FUNCTION.call(*x)
        gc.collect()
        held.append(tracemalloc.get_traced_memory()[0])
    tracemalloc.stop()
    assert held[1] - held[0] < 5_000

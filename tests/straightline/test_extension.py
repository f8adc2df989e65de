"""A program as a function of the interpreter: the same numbers, None for what it does not know, and no leak."""

import gc
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import twistwrench as tw
from straightline import extension
from straightline.llvm import available

pytestmark = pytest.mark.skipif(not (available() and extension.POSSIBLE), reason="needs CPython and llvmlite")

MODEL = tw.load("cart_pole")
Q, V = np.array([0.3, -0.7]), np.array([0.5, 1.1])


@pytest.fixture(scope="module")
def program():
    made = tw.compile(MODEL, ["M", "h", "T", "J_c"])
    made(Q, V)
    return made


ARRAYS = [
    np.arange(6.0),
    np.zeros((2, 3, 4), np.float32),
    np.array(1.0),
    np.ones((4, 3)).mT,
    np.ones((4, 4))[::2, 1:],
    np.frombuffer(bytes(17), np.float64, offset=1),
]


def test_an_array_has_its_members_where_they_are_read():
    """What CPython and NumPy promise to compiled modules, on this version of Python."""
    for x in ARRAYS:
        expected = id(np.ndarray), id(x.dtype), x.ctypes.data, x.ndim, x.flags.num, *x.shape
        assert extension.members(x) == expected
        assert x.flags.num & extension.USUAL == 0x1 * x.flags.c_contiguous + 0x100 * x.flags.aligned
    assert extension.as_expected()


@pytest.mark.slow
@pytest.mark.parametrize("minor", ["3.11", "3.12", "3.13", "3.14"])
def test_so_it_has_on_other_versions_of_python(minor):
    python = shutil.which(f"python{minor}")
    if python is None or subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode:
        pytest.skip(f"there is no Python {minor} with NumPy")
    code = "import straightline.extension as e; raise SystemExit(not e.as_expected())"
    source = str(Path(extension.__file__).parents[1])
    assert subprocess.run([python, "-c", code], env={"PYTHONPATH": source}).returncode == 0


@pytest.mark.parametrize("name", ["KIND", "DATA", "AXES", "DTYPE", "FLAGS"])
def test_members_at_other_places_are_noticed(name, monkeypatch):
    monkeypatch.setattr(extension, name, {"KIND": 0, "DATA": 8, "AXES": 28, "DTYPE": 48, "FLAGS": 60}[name])
    assert not extension.as_expected()


def test_one_state_has_the_numbers_of_a_batch_to_the_last_bit(program):
    assert program.one_state is not None
    found, batch = program(Q, V), program(Q[None], V[None])
    assert [*vars(found)] == ["M", "h", "T", "J_c"]
    for name, x in vars(found).items():
        assert type(x) is np.ndarray
        assert x.flags.carray
        assert np.array_equal(x, getattr(batch, name)[0]), name
    assert (found.T.shape, found.J_c.shape) == ((), (0, 2))
    assert np.abs(found.M - tw.crba(MODEL, Q)).max() < 1e-15
    assert np.abs(found.h - tw.nonlinear_effects(MODEL, Q, V)).max() < 1e-14


def test_each_call_returns_new_arrays(program):
    first = program(Q, V)
    kept = first.M.copy()
    second = program(2 * Q, V)
    assert not np.shares_memory(first.M, second.M)
    assert np.array_equal(first.M, kept)


def test_one_quantity_alone_is_an_array_in_either_number_type():
    for dtype, tolerance in ((np.float64, 1e-15), (np.float32, 1e-6)):
        program = tw.compile(MODEL, "crba", dtype=dtype)
        program(Q.astype(dtype))
        found = program.one_state(Q.astype(dtype))
        assert found.dtype == dtype
        assert np.abs(found - tw.crba(MODEL, Q)).max() < tolerance


def test_without_such_functions_the_numbers_are_the_same(program, monkeypatch):
    monkeypatch.setattr("straightline.extension.POSSIBLE", False)
    other = tw.compile(MODEL, ["M", "h", "T", "J_c"])
    for name, x in vars(other(Q, V)).items():
        assert np.array_equal(x, getattr(program(Q, V), name))
    assert other.one_state is None


class Tagged(np.ndarray):
    """An array of a class of its own."""


UNALIGNED = np.frombuffer(b"\0" + Q.tobytes(), np.float64, offset=1)
OTHERS = {
    "fewer": (Q,),
    "more": (Q, V, V),
    "none": (),
    "None": (Q, None),
    "a list": (Q, [0.5, 1.1]),
    "a number": (Q, 1.0),
    "another number type": (Q, V.astype(np.float32)),
    "other bytes": (Q, V.astype(">f8")),
    "another length": (Q, np.zeros(3)),
    "a batch": (Q[None], V[None]),
    "gaps": (Q, np.zeros(4)[::2]),
    "backwards": (Q[::-1], V),
    "a subclass": (Q.view(Tagged), V),
    "unaligned": (UNALIGNED, V),
    "not finite": (np.array([np.nan, 0]), V),
    "too large": (np.array([0, 1e300]), V),
}


@pytest.mark.parametrize("name", OTHERS)
def test_what_it_does_not_know_is_none(program, name):
    assert program.one_state(*OTHERS[name]) is None


@pytest.mark.parametrize("name", [*OTHERS][4:])
def test_and_goes_the_way_of_many(program, name):
    try:
        expected = tw.nonlinear_effects(MODEL, *OTHERS[name])
    except (TypeError, ValueError) as error:
        with pytest.raises(type(error)):
            program(*OTHERS[name])
    else:
        assert np.abs(program(*OTHERS[name]).h - expected).max() < 1e-7


def test_the_function_lives_without_its_program():
    program = tw.compile(MODEL, "crba")
    M = program(Q)
    function = program.one_state
    del program
    gc.collect()
    assert np.array_equal(function(Q), M)


def test_nothing_is_left_behind(program):
    bad = np.array([np.nan, 0.0])
    for one in ((Q, V), (bad, V), (Q, [1])):
        program.one_state(*one)
    gc.collect()
    before = [sys.getrefcount(x) for x in (Q, V, bad, np.ndarray, Q.dtype)]
    blocks = sys.getallocatedblocks()
    for _ in range(1000):
        program.one_state(Q, V)
        program.one_state(bad, V)
        program.one_state(Q, None)
    assert sys.getallocatedblocks() < blocks + 100
    assert np.abs(np.subtract([sys.getrefcount(x) for x in (Q, V, bad, np.ndarray, Q.dtype)], before)).max() < 100


@pytest.mark.parametrize("single", [True, False])
def test_where_there_is_no_memory_numpy_s_error_comes_through(program, single):
    huge = {"small": ((3,), ()), "huge": ((2**50,), ()), "alarm": ((), ())}
    line = SimpleNamespace(inputs={"q": (2,)}, outputs={name: huge[name] for name in [*huge][single:]})
    code = program._code(program.arguments).machine_code(1)
    function = extension.state_function(code, line, np.dtype(float), single)
    with pytest.raises(MemoryError, match="Unable to allocate"):
        function(Q)

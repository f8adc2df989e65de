"""From a function to a line, and what runs it: closed forms, without a robot."""

import ctypes
import shutil
import subprocess
from fractions import Fraction

import numpy as np
import pytest

from straightline import BackEnd, Tape, c_source, double_double, numbers, python_source, straight_line
from straightline import extension as interpreter
from straightline.line import Line
from straightline.llvm import available, default_backend
from straightline.number import select
from straightline.outputs import check_outputs
from straightline.source import Note
from straightline.tangent import directions, jacobian

DOUBLE = np.dtype(np.float64)
BACKENDS = [
    pytest.param("llvm", marks=pytest.mark.skipif(not available(), reason="llvmlite is not installed")),
    "numpy",
]


def kepler(E, e):
    """Return the mean anomaly and the place on an ellipse."""
    return E[0] - e[0] * np.sin(E[0]), np.stack([np.cos(E[0]) - e[0], np.sqrt(1 - e[0] * e[0]) * np.sin(E[0])])


LINE = straight_line(kepler, E=(1,), e=(1,))
E = np.linspace(-3, 3, 70)[:, None]
ECCENTRICITY = np.linspace(0, 0.9, 70)[:, None]


@pytest.mark.parametrize("count", [1, 3, 21, 70])
@pytest.mark.parametrize("dtype", [np.float64, np.float32], ids=["double", "single"])
@pytest.mark.parametrize("backend", BACKENDS)
def test_a_line_is_the_function(backend, dtype, count):
    given = {"E": E[:count].astype(dtype), "e": ECCENTRICITY[:count].astype(dtype)}
    found = BackEnd(LINE, np.dtype(dtype), backend).results(given, (count,))
    for x, expected in zip((found["y0"], found["y1"].mT), kepler(E[:count].mT, ECCENTRICITY[:count].mT)):
        assert x.dtype == dtype
        np.testing.assert_allclose(x, expected, rtol=0, atol=8 * np.finfo(dtype).eps * 3)


def test_only_what_the_results_need_is_left():
    line = straight_line(lambda x: np.array([x[0] * 1 + 0 * x[1], x[1] * x[0] - x[0] * x[1]]), x=(2,))
    assert line.operations.total() == 0
    assert [line.nodes[k][0] for k in line.results] == ["input", "const"]


def test_a_function_that_asks_what_a_number_is_has_no_line():
    with pytest.raises(TypeError, match="a recorded number has no value"):
        straight_line(lambda x: x if x[0] > 0 else -x, x=(1,))


def test_the_text_in_python_computes_the_same():
    names = {}
    exec(python_source(LINE, "kepler"), names)
    M, place = names["kepler"]([0.5], [0.3])
    expected = kepler(np.array([0.5]), np.array([0.3]))
    np.testing.assert_allclose([M, *place], [expected[0], *expected[1]], rtol=1e-15)


def test_notes_name_the_values_and_begin_with_a_comment():
    tape = Tape(lambda: Note("area", "the product of the sides"))
    a, b = numbers(tape, "a", 2)
    line = Line.of(tape, {"a": (2,)}, {"y": np.array(a * b, object)})
    assert "# the product of the sides\n    area_1 = a[0] * a[1]\n" in python_source(line, "f")


@pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")
def test_the_text_in_c_computes_the_same(tmp_path):
    (tmp_path / "kepler.c").write_text(c_source(LINE, "kepler"))
    library = tmp_path / "kepler.so"
    subprocess.run(
        ["cc", "-std=c99", "-O1", "-shared", "-fPIC", tmp_path / "kepler.c", "-o", library, "-lm"], check=True
    )
    given, results = (np.array([0.5]), np.array([0.3])), (np.zeros(1), np.zeros(2))
    ctypes.CDLL(str(library)).kepler(*(ctypes.c_void_p(x.ctypes.data) for x in (*given, *results)))
    for x, expected in zip(results, kepler(*given)):
        np.testing.assert_allclose(x, np.ravel(expected), rtol=1e-15)


def test_a_derivative_is_a_line_too():
    """Of Kepler's equation it is 1 − e cos E."""
    tape = Tape()
    x, e = numbers(tape, "x", 2)
    J = jacobian(tape, np.array([x - e * x.sin()], object), directions(np.array([x, e])), 2)
    line = Line.of(tape, {"x": (2,)}, {"J": J})
    found = BackEnd(line, DOUBLE, "numpy").results({"x": np.array([[0.5, 0.3]])}, (1,))["J"][0]
    np.testing.assert_allclose(found, [[1 - 0.3 * np.cos(0.5), -np.sin(0.5)]], rtol=1e-15)


@pytest.mark.parametrize("backend", BACKENDS)
def test_thirty_two_digits_and_a_bound(backend):
    """√2² − 2 is 0: what is left of it is below the bound, some units of the 32nd digit."""
    line = straight_line(lambda x: np.sqrt(x) * np.sqrt(x) - 2, x=(1,))
    pairs = double_double(line, fma=backend == "llvm", bound=True)
    found = BackEnd(pairs, DOUBLE, backend).results({"x": np.array([[2.0]])}, (1,))
    off = abs(found["y"] + found["y.lo"])
    assert (off <= found["y.bound"]).all()
    assert (found["y.bound"] < 2e-30).all()


def test_what_has_no_form_in_pairs_is_named():
    tape = Tape()
    line = Line.of(tape, {"x": ()}, {"y": np.array(tape.apply("tan", tape.input(("x",))), object)})
    with pytest.raises(NotImplementedError, match="tan"):
        double_double(line, fma=False)


def test_without_llvm_numpy_is_the_way(monkeypatch):
    monkeypatch.setattr("straightline.llvm.available", lambda: False)
    assert default_backend(DOUBLE) == "numpy"
    assert BackEnd(LINE, DOUBLE, default_backend(DOUBLE)).one_state(False) is None


@pytest.mark.skipif(not (available() and interpreter.POSSIBLE), reason="needs CPython and llvmlite")
def test_one_state_is_answered_unless_the_last_result_is_above_one(monkeypatch):
    line = straight_line(lambda x: (x * x, x[0]), x=(2,))
    code = BackEnd(line, DOUBLE, "llvm")
    square = code.one_state(True)
    np.testing.assert_array_equal(square(np.array([0.5, 3.0])), [0.25, 9.0])
    assert square(np.array([2.0, 3.0])) is None
    monkeypatch.setattr(interpreter, "POSSIBLE", False)
    assert code.one_state(True) is None


def test_an_array_that_does_not_fit_is_a_misfit_of_the_callers_kind():
    class Misfit(ValueError):
        pass

    with pytest.raises(
        Misfit, match=r"out: expected for y an array of float64 of shape \(3,\), got float64 of shape \(4,\)"
    ):
        check_outputs({"y": np.zeros(4)}, (), {"y": (3,)}, DOUBLE, Misfit)
    with pytest.raises(ValueError, match="read-only"):
        check_outputs({"y": np.broadcast_to(0.0, 3)}, (), {"y": (3,)}, DOUBLE)


def test_constants_are_fractions():
    assert straight_line(lambda x: x * Fraction(1, 3), x=()).operations.total() == 1
    with pytest.raises(TypeError):
        straight_line(lambda x: x * 0.1, x=())


# ---------------------------------------------------------------- choices and angles

ANGLE = straight_line(lambda p: np.arctan2(p[1], p[0]), p=(2,))
HARD = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1e-300), (-1, 1e-300), (1e-300, 1)]


@pytest.mark.parametrize("dtype", [np.float64, np.float32], ids=["double", "single"])
@pytest.mark.parametrize("backend", BACKENDS)
def test_the_angle_of_a_point_is_right_to_two_roundings(backend, dtype):
    rng = np.random.default_rng(0)
    near = np.tan(np.pi / 8 * np.arange(-8, 9))[:, None] * (1 + rng.uniform(-1e-6, 1e-6, 17))[:, None]
    points = [
        np.array(HARD),
        np.concatenate([np.ones((17, 1)), near], axis=1),
        rng.standard_normal((2000, 2)) * 10.0 ** rng.integers(-10, 3, (2000, 2)),
    ]
    p = np.concatenate(points).astype(dtype)
    found = BackEnd(ANGLE, np.dtype(dtype), backend).results({"p": p}, (len(p),))["y"]
    expected = np.arctan2(*p.astype(np.longdouble).mT[::-1])
    np.testing.assert_allclose(found, expected, rtol=2 * np.finfo(dtype).eps, atol=np.finfo(dtype).tiny)


def branches(x):
    """Return |x|, the root of x where it is above 0 and 0 elsewhere, and a constant by the sign of x."""
    above = select(x[0], x[0], 0)
    return np.array([select(x[0], x[0], -x[0]), np.sqrt(above), select(x[0], Fraction(1, 3), -2)], object)


def test_of_two_numbers_one_is_chosen_and_the_other_may_be_anything():
    x = np.array([[2.0], [-2.0], [0.0], [1e308], [-np.inf], [np.nan]])
    line = straight_line(lambda x: np.array([*branches(x), select(x[0], 1, x[0] * 10**200 * 10**200)]), x=(1,))
    expected = [np.where(x > 0, x, -x), np.sqrt(np.where(x > 0, x, 0)), np.where(x > 0, 1 / 3, -2)]
    for backend in ("numpy", *(["llvm"] if available() else [])):
        for count in (1, len(x)):
            found = BackEnd(line, DOUBLE, backend).results({"x": x[:count]}, (count,))["y"]
            np.testing.assert_array_equal(found[:, :3], np.concatenate(expected, axis=1)[:count])
    names = {}
    exec(python_source(straight_line(branches, x=(1,)), "branches"), names)
    assert [names["branches"]([one]) for one in (4.0, -4.0)] == [[4.0, 2.0, 1 / 3], [4.0, 0.0, -2.0]]
    assert "(x[0] > 0 ? " in c_source(straight_line(branches, x=(1,)), "branches")


def test_choices_of_different_numbers_are_different():
    line = straight_line(lambda x: np.array([select(x[0], x[1], x[2]), select(x[0], x[3], x[2])]), x=(4,))
    y = BackEnd(line, DOUBLE, "numpy").results({"x": np.array([[1.0, 2, 3, 4]])}, (1,))["y"]
    assert y.tolist() == [[2, 4]]
    turned = straight_line(lambda x: select(x[0], np.cos(x[1]), x[2]) - select(x[0], np.sin(x[1]), x[2]), x=(3,))
    assert turned.operations.total() == 5


def test_choices_and_angles_have_derivatives():
    tape = Tape()
    x = numbers(tape, "x", 2)
    results = np.array([np.arctan2(x[0], x[1]), select(x[0] - x[1], x[0] * x[1], 3 * x[1]), select(x[0], 1, x[0])])
    J = jacobian(tape, results, directions(x), 2)
    line = Line.of(tape, {"x": (2,)}, {"J": J})
    at = np.array([[3.0, 4.0], [4.0, 3.0], [-1.0, 2.0]])
    found = BackEnd(line, DOUBLE, "numpy").results({"x": at}, (3,))["J"]
    expected = [[[b / (a * a + b * b), -a / (a * a + b * b)], [b, a] if a > b else [0, 3], [0 if a > 0 else 1, 0]]
                for a, b in at]  # fmt: skip
    np.testing.assert_allclose(found, expected, rtol=1e-15)


def test_pairs_of_doubles_refuse_a_choice_by_name():
    with pytest.raises(NotImplementedError, match="'select' of pairs"):
        double_double(straight_line(branches, x=(1,)), fma=False)

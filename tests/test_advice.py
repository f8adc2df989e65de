"""`tw.advise` with a tolerance: the cheapest that keeps it, what it says where nothing does, its promise."""

import json

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.advice import USES, read_tolerance
from twistwrench.cli import main

from .pages import page

ROBOTS = ("planar_arm", "double_pendulum", "cart_pole")


@pytest.mark.one_case
@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("within", ["0.001 N m", "1e-10 N m", "6 digits"])
def test_the_promise_holds_in_states_that_it_never_saw(robot, within):
    """τ by the chosen number type against 40 digits, in 60 new states."""
    mpmath = pytest.importorskip("mpmath", reason="mpmath is not installed: there is no truth to hold anything against")
    model, rng = tw.load(robot), np.random.default_rng(7)
    best = tw.advise(model, "control", within=within, rounds=1).best
    assert best.error <= read_tolerance(within, "N m")[0]
    program = tw.compile(model, "h", dtype=best.number)
    held = []
    with mpmath.workdps(40):
        for _ in range(60):
            q, v = model.random_configuration(rng=rng), rng.standard_normal(model.nv)
            given = [x.astype(best.number) if best.number != "double-double" else x for x in (q, v)]
            found = program(*given)
            value = sum(map(tw.newton_euler_3d.as_mpmath, found if isinstance(found, tuple) else (found,)))
            exact = [tw.newton_euler_3d.as_mpmath(x) for x in (q, v, 0 * v)]
            truth = tw.newton_euler_3d.inverse_dynamics(model, *exact)
            off = abs(value - truth).max() / (abs(truth).max() if best.unit == "digits" else 1)
            held.append(off <= best.error)
    assert np.mean(held) >= 0.95


def test_float32_is_refused_where_it_does_not_hold():
    tried = tw.advise(tw.load("planar_arm"), "control", within="1e-9 N m", rounds=1)
    assert tried.best.number == "float64"
    assert next(a for a in tried.tried if a.number == "float32").error > 1e-9
    assert 'dtype="float32"' in str(tried)


def test_it_says_where_nothing_holds_and_what_would():
    found = tw.advise(tw.load("pendulum"), "identification", within="1e-30 N m", rounds=1)
    assert found.best is None
    assert "nothing here keeps 1e-30 N m" in str(found)
    assert "verification" in str(found)


def test_a_proved_error_comes_from_a_bound():
    found = tw.advise(tw.load("planar_arm"), "verification", within="1e-9 N m", certified=True, rounds=1)
    assert "bound=" in found.best.function
    assert 0 < found.best.error < 1e-9


def test_of_several_quantities_the_first_has_a_proved_error_and_a_regressor_no_torques():
    arm = tw.load("planar_arm")
    found = tw.advise(arm, "control", within="1e-9 N m", certified=True, rounds=1)
    assert '("h", "M", "J_c", "A_G"), bound=' in found.best.function
    assert 0 < found.best.error < 1e-9
    with pytest.raises(ValueError, match="certified: a bound is proved of programs, in N m; 'identification' has none"):
        tw.advise(arm, "identification", within="1e-9 N m", certified=True, rounds=1)


@pytest.mark.parametrize(
    ("text", "unit", "read"),
    [
        ("0.01Nm", "N m", (0.01, "N m")),
        ("0.01 N·m", "N m", (0.01, "N m")),
        ("20 µm", "mm", (0.02, "mm")),
        ("1e-3 m", "mm after 1 s", (1.0, "mm after 1 s")),
        ("8 digits", "N m/rad", (1e-8, "digits")),
        (0.5, "N m/rad", (0.5, "N m/rad")),
    ],
)
def test_tolerances_are_read(text, unit, read):
    assert read_tolerance(text, unit) == (pytest.approx(read[0], rel=1e-12), read[1])


@pytest.mark.parametrize("text", ["", "mm", "-1 mm", "0 mm", "1 mile", "0.1 N m/rad", "nan mm", "1e999 mm"])
def test_what_is_no_tolerance_is_refused(text):
    with pytest.raises(ValueError, match=r"within: expected an error above zero, as in '0.1 mm'"):
        read_tolerance(text, "mm")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"duration": 1.0}, "within: expected"),
        ({"certified": True}, "within: expected"),
        ({"within": 0.1, "duration": 1.0}, "use 'simulation'"),
        ({"within": 0.1, "start": ([0.0], [0.0])}, "duration="),
        ({"within": "3 digits", "certified": True}, "in N m"),
    ],
)
def test_options_that_need_another_one_say_so(options, said):
    with pytest.raises(ValueError, match=said):
        tw.advise(tw.load("pendulum"), "control", **options)


def test_the_command_decides(capsys):
    assert main(["advise", "pendulum", "--use", "control", "--within", "0.01Nm"]) == 0
    assert "→" in capsys.readouterr().out
    assert main(["advise", "pendulum", "--within", "0.1mm", "--for", "0.2s"]) == 0
    assert 'method="' in capsys.readouterr().out
    assert main(["advise", "pendulum", "--use", "control", "--within", "1 mile"]) == 2
    assert "expected an error above zero" in capsys.readouterr().err
    assert main(["advise", "pendulum", "--use", "identification", "--within", "1e-30Nm"]) == 1


def test_every_use_takes_a_tolerance_in_its_unit():
    for use in ("learn", "mpc", "sampling", "identification"):
        found = tw.advise(tw.load("pendulum"), use, within=1e-3, rounds=1)
        assert found.unit == USES[use].unit
        assert found.best is not None


def test_the_promises_of_the_page_are_those_of_the_benchmark_and_held_in_95_percent(benchmark_file):
    """Five robots, five uses, two tolerances each: in no line fewer of the new states, in all together 98 %."""
    pytest.importorskip("mpmath", reason="mpmath is not installed: the benchmark is not read")
    pytest.importorskip("scipy", reason="SciPy is not installed: the benchmark is not read")
    benchmark, tables = map(benchmark_file, ("advice", "tables"))
    found = json.loads(benchmark.RESULTS.read_text(encoding="utf-8"))
    asked = [(use, within) for use, tolerances, _ in benchmark.QUESTIONS for within in tolerances]
    assert set(found) == {f"{robot} | {use} | {within}" for robot in benchmark.ROBOTS for use, within in asked}
    answered = [row for row in found.values() if "found" in row]
    assert len(answered) == len(found) == 50
    assert all(row["promised"] <= row["allowed"] for row in answered)
    assert min(row["below the promise"] / row["states"] for row in answered) >= 0.95
    kept, states = (sum(row[name] for row in answered) for name in ("below the promise", "states"))
    assert kept / states > 0.98
    for language in ("", ".zh-CN"):
        text = page("which", language).read_text(encoding="utf-8")
        assert tables.fill(text, benchmark.tables()) == text

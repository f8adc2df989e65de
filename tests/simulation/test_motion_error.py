"""`tw.motion_error` against closed forms, invariants, SciPy's DOP853; `cheapest_steps` by its promise."""

import json

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import step_choice
from twistwrench.simulation.growth import apart

from ..pages import page
from ..sampling import drawn
from .test_step_error import EXAMPLES, q_rate

SMALL_MM = 5.0
"""Beyond this, the error is no longer small against a robot of 1 m."""

MOTIONS = {  # without contacts, and none that a clock holds: the start of each, and for how long
    "pendulum": 3.0,
    "damped pendulum": 3.0,
    "double pendulum": 1.0,
    "arm": 1.0,
    "tumbling body": 4.0,
    "cart-pole": 1.0,
}


@pytest.mark.parametrize(("angle", "grows"), [(0.0, np.cos), (np.pi, np.cosh)])
def test_a_pendulum_multiplies_errors_as_it_hangs_or_stands(angle, grows):
    """Linear about both equilibria: δ(T) = δ(0) cos ωT below, δ(0) cosh ωT above, with ω² = m g l / I."""
    model = tw.load("pendulum")
    rate = np.sqrt(9.81 * model.mass * 1.0 / tw.crba(model, [0.0])[0, 0])
    found = tw.motion_error(model, [angle], [0.0], dt=0.005, duration=2.0)
    assert found.growth == pytest.approx(abs(grows(rate * 2.0)), rel=1e-4)


@pytest.mark.one_case
@pytest.mark.parametrize("name", MOTIONS)
def test_dop853_ends_as_far_away_as_is_said(name):
    integrate = pytest.importorskip("scipy.integrate", reason="SciPy is not installed")
    example, duration = EXAMPLES[name](), MOTIONS[name]
    model, nq = example.model, example.model.nq
    tau = example.tau or (lambda t, q, v: np.zeros(model.nv))

    def rates(t, y):
        q, v = model.normalize(y[:nq]), y[nq:]
        return np.r_[q_rate(model, y[:nq], v), tw.fast.aba(model, q, v, np.asarray(tau(t, q, v), float))]

    y = np.r_[example.q, example.v]
    right = integrate.solve_ivp(rates, (0, duration), y, method="DOP853", rtol=1e-13, atol=1e-13).y[:nq, -1]
    options = {"dt": example.dt, "duration": duration, "tau": example.tau}
    for method in ("rk4", "midpoint", "euler"):
        motion = tw.simulate(model, example.q, example.v, method=method, **options)
        off = apart(model, motion.q[-1], model.normalize(right))
        said = tw.motion_error(model, example.q, example.v, method=method, **options)
        assert off / 1.5 - 1e-8 < said.total < 1.5 * off + 1e-6, (method, off)  # mm: DOP853 itself is off by 1e-9


def test_where_a_robot_is_and_where_it_falls_does_not_count():
    go2 = tw.load("go2")
    q, v = go2.standing(), np.random.default_rng(0).standard_normal(18)
    here = tw.motion_error(go2, q, v, dt=0.01, duration=0.2)
    q[:2] += [3.0, -2.0]
    there = tw.motion_error(go2, q, v, dt=0.01, duration=0.2)
    assert there.steps == pytest.approx(here.steps, rel=1e-5)


@pytest.mark.parametrize("duration", [0, -1.0, np.nan])
def test_a_motion_of_no_time_has_no_error(duration):
    with pytest.raises(ValueError, match="duration: expected a time above zero"):
        tw.motion_error(tw.load("pendulum"), [0.3], [0.0], dt=0.01, duration=duration)


def test_the_least_work_keeps_its_promise_on_starts_that_it_never_saw():
    """A double pendulum for half a second within a hundredth of a millimetre, by DOP853 at 20 new starts."""
    integrate = pytest.importorskip("scipy.integrate", reason="SciPy is not installed")
    model, rng = tw.load("double_pendulum"), np.random.default_rng(99)
    found = step_choice.cheapest_steps(model, 0.01, 0.5)
    best = min((way for way in found.ways if way.error <= 0.01), key=lambda way: way.work)
    within = []
    for _ in range(20):
        q, v = model.random_configuration(rng=rng), rng.standard_normal(2)
        motion = tw.simulate(model, q, v, dt=best.dt, duration=0.5, method=best.method)

        def rates(t, y):
            return np.r_[y[2:], tw.fast.aba(model, y[:2], y[2:], np.zeros(2))]

        right = integrate.solve_ivp(rates, (0, 0.5), np.r_[q, v], method="DOP853", rtol=1e-12, atol=1e-12).y[:2, -1]
        within.append(apart(model, motion.q[-1], right) <= best.error)
    assert np.mean(within) >= 0.95


def test_where_the_motion_outruns_doubles_it_is_said_for_how_long_they_do(monkeypatch):
    """A pendulum balanced for 10 s multiplies by 10^13, and in half of this by 10^6."""
    monkeypatch.setattr(step_choice, "FIRST_DT", 0.04)
    found = step_choice.cheapest_steps(tw.load("pendulum"), 0.1, 10.0, ([np.pi], [0.0]))
    assert all(way.error > 0.1 for way in found.ways)
    assert "the motion multiplies errors; for" in found.instead


@pytest.fixture
def benchmark(benchmark_file):
    """benchmarks/motion_errors.py, which integrates motions in 50 digits."""
    pytest.importorskip("mpmath", reason="mpmath is not installed: there is no truth to hold anything against")
    return benchmark_file("motion_errors")


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_table_of_eight_motions_is_that_of_the_results(benchmark, benchmark_file, language):
    text = page("simulation", language).read_text(encoding="utf-8")
    assert benchmark_file("tables").fill(text, benchmark.tables(language)) == text
    assert set(json.loads(benchmark.RESULTS.read_text(encoding="utf-8"))) == set(benchmark.MOTIONS)
    assert len(benchmark.MOTIONS) == 8


def test_what_is_said_of_eight_motions_is_what_50_digits_find(benchmark):
    """Within a fifth, while the error is small against the motion; rounding alone is said with a margin above."""
    for name, row in json.loads(benchmark.RESULTS.read_text(encoding="utf-8")).items():
        for method in benchmark.METHODS:
            said, found = row[method]["said"], row[method]["found"]
            assert found < 1.2 * said, (name, method)
            if name != "a pendulum begins upright" and found < SMALL_MM:
                assert said < 1.2 * found, (name, method)


def test_a_motion_in_50_digits_ends_as_the_closed_form_says(benchmark):
    """Jacobi's elliptic functions: sin(φ/2) = k sn(K − ω T), of the pendulum from 2 rad at rest."""
    import mpmath

    motion = benchmark.MOTIONS["a pendulum swings"][1]()._replace(duration=0.5)
    with mpmath.workdps(50):
        mass, rod = (mpmath.mpf(x) for x in (motion.model.mass, tw.crba(motion.model, [0.0])[0, 0]))
        k, rate = mpmath.sin(1), mpmath.sqrt(mpmath.mpf(9.81) * mass / rod)
        exact = 2 * mpmath.asin(k * mpmath.ellipfun("sn", mpmath.ellipk(k**2) - rate / 2, k=k))
        assert abs(benchmark.truth(motion)[0] - exact) < 1e-14


@pytest.mark.slow
def test_each_motion_is_off_as_the_table_says(benchmark):
    before = json.loads(benchmark.RESULTS.read_text(encoding="utf-8"))
    rounding = "a pendulum begins upright"  # another one elsewhere
    steady = [name for name in benchmark.MOTIONS if name != rounding]
    for name in drawn(steady, 1):
        found = benchmark.measure(name)
        for method in benchmark.METHODS:
            assert found[method]["found"] == pytest.approx(before[name][method]["found"], rel=0.02, abs=1e-9)

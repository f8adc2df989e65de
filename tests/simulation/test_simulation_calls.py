"""How `tw.simulate` is called: policies, batches, number types, what it returns, and what it refuses."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.simulation import METHODS, variational
from twistwrench.simulation.variational import momenta

from ..pages import blocks, page
from ..pages import run as run_page
from ..robots import shared
from ..strategies import Recipe

PENDULUM = shared("pendulum")
DOUBLE = shared("double_pendulum")
SMOOTH = [name for name in METHODS if name != "time-stepping"]  # which keeps the joints' ranges, in double precision


def run(model=DOUBLE, q=(0.3, -0.5), v=(0.0, 1.0), *, dt=0.01, steps=3, **options):
    return tw.simulate(model, q, v, dt=dt, steps=steps, **options)


# ---------------------------------------------------------------- arguments


@pytest.mark.parametrize("method", METHODS)
def test_a_motion_starts_at_its_start_and_has_a_state_for_each_time(method):
    s = run(method=method, steps=4)
    assert s.q.shape == s.v.shape == (5, 2)
    assert s.energy.shape == (5,)
    assert s.momentum.shape == (5, 6)
    assert s.t == pytest.approx([0, 0.01, 0.02, 0.03, 0.04])
    assert (s.q[0] == [0.3, -0.5]).all()
    assert (s.v[0] == [0.0, 1.0]).all()


def test_duration_is_another_way_to_say_steps():
    a, b = run(steps=30), tw.simulate(DOUBLE, [0.3, -0.5], [0.0, 1.0], dt=0.01, duration=0.3)
    assert (a.q == b.q).all()


def test_no_steps_are_no_motion():
    s = run(steps=0)
    assert s.q.shape == (1, 2)
    assert s.evaluations == 0


@pytest.mark.parametrize("method", METHODS)
def test_constant_forces_are_those_of_a_policy_that_returns_them(method):
    still, array, policy = (run(method=method, tau=tau) for tau in (None, [0.5, -1.0], lambda t, q, v: [0.5, -1.0]))
    assert (array.q == policy.q).all()
    assert np.abs(array.q - still.q).max() > 1e-4


@pytest.mark.parametrize(
    ("method", "times"),
    [
        ("euler", [0, 0.25]),
        ("semi-implicit", [0, 0.25]),
        ("time-stepping", [0, 0.25]),
        ("midpoint", [0, 0.125, 0.25, 0.375]),
        ("rk4", [0, 0.125, 0.125, 0.25, 0.25, 0.375, 0.375, 0.5]),
    ],
)
def test_a_policy_is_asked_at_the_times_of_the_method(method, times):
    asked = []
    s = run(method=method, dt=0.25, steps=2, tau=lambda t, q, v: asked.append(t) or np.zeros(2))
    assert asked == times
    assert s.evaluations == len(times)


def test_the_variational_method_asks_in_the_middle():
    asked = []
    s = run(method="variational", dt=0.25, steps=2, tau=lambda t, q, v: asked.append(t) or np.zeros(2))
    assert set(asked) == {0.125, 0.375}
    assert s.evaluations == len(asked)


def test_a_policy_cannot_change_the_state():
    def policy(t, q, v):
        v *= 0.5
        return v

    with pytest.raises(ValueError, match="read-only"):
        run(tau=policy)


def test_nothing_that_is_given_is_changed():
    q, v = np.array([0.3, -0.5]), np.array([0.0, 1.0])
    run(q=q, v=v)
    assert (q == [0.3, -0.5]).all()
    assert (v == [0.0, 1.0]).all()
    q[0] = 1  # still writeable


@pytest.mark.parametrize("method", METHODS)
def test_a_batch_is_its_items(method):
    rng = np.random.default_rng(0)
    model = Recipe(3, seed=5, base="floating", kinds=("spherical", "revolute")).model
    q = np.stack([model.random_configuration(rng=rng) for _ in range(6)]).reshape(2, 3, -1)
    v = rng.standard_normal((3, model.nv))
    s = tw.simulate(model, q, v, dt=0.02, steps=3, method=method)
    assert s.q.shape == (4, 2, 3, model.nq)
    assert s.energy.shape == (4, 2, 3)
    for i, j in np.ndindex(2, 3):
        one = tw.simulate(model, q[i, j], v[j], dt=0.02, steps=3, method=method)
        assert np.abs(s.q[:, i, j] - one.q).max() < 1e-13
        assert np.abs(s.v[:, i, j] - one.v).max() < 1e-11


def test_a_momentum_is_seen_to_the_last_digit_whatever_else_is_in_the_batch():
    flyer = Recipe(1, seed=0, base="floating").model
    u, p, impulse = np.random.default_rng(0).standard_normal((3, 2, flyer.nv))
    u[0] *= 1e-9  # this one hardly turns, and is large
    p[0] *= 1e20
    together, alone = momenta(flyer, u, p, impulse), momenta(flyer, u[1], p[1], impulse[1])
    for batch, one in zip(together, alone, strict=True):
        assert np.abs(batch[1] - one).max() < 1e-14


@pytest.mark.one_case
@pytest.mark.parametrize("method", SMOOTH)
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble])
def test_the_number_type_is_kept(method, dtype):
    """And its digits: the difference to double precision is that of the coarser of the two."""
    model = Recipe(3, seed=5, base="floating", kinds=("spherical", "revolute")).model
    q = model.normalize(model.random_configuration(rng=0).astype(dtype))
    v = np.ones(model.nv, dtype)
    s = tw.simulate(model, q, v, dt=0.0625, steps=3, method=method, tau=np.full(model.nv, 0.25))
    double = tw.simulate(
        model,
        model.normalize(q.astype(float)),
        v.astype(float),
        dt=0.0625,
        steps=3,
        method=method,
        tau=np.full(model.nv, 0.25),
    )
    assert s.q.dtype == s.v.dtype == s.energy.dtype == dtype
    assert np.abs(s.v - double.v).max() < (2e-3 if dtype == np.float32 else 1e-11)


def test_long_double_has_more_digits():
    """A variational step there and back returns beyond double precision."""
    if np.finfo(np.longdouble).eps == np.finfo(float).eps:
        pytest.skip("long double is double here")
    q, v = np.array([0.3, -0.5], np.longdouble), np.array([0, 1], np.longdouble)
    there = run(q=q, v=v, method="variational", steps=1, dt=0.1)
    back = run(q=there.q[-1], v=-there.v[-1], method="variational", steps=1, dt=0.1)
    assert np.abs(back.q[-1] - q).max() < 2e-18


def test_progress_is_shown_where_asked_for(capsys):
    run(progress=True)
    assert "3/3" in capsys.readouterr().err
    run()
    assert capsys.readouterr().err == ""


# ---------------------------------------------------------------- a controller's clock, an end, and going on


@pytest.mark.parametrize("method", METHODS)
def test_a_policy_with_a_period_is_called_once_in_it_and_its_forces_hold(method):
    """Of an integral controller the sum is that of its own clock, whatever method moves the robot."""
    asked, total = [], []

    def integral(t, q, v):
        asked.append(t)
        total.append((total[-1] if total else 0) + np.asarray(q))
        return -total[-1]

    s = run(dt=0.05, steps=6, tau=integral, dt_control=0.1, method=method)
    assert asked == pytest.approx([0, 0.1, 0.2])
    assert s.tau == pytest.approx(-np.repeat(np.cumsum(s.q[[0, 2, 4]], axis=0), 2, axis=0))
    halves = [lambda t, q, v, tau=tau: tau for tau in s.tau[::2]]
    q, v = s.q[0], s.v[0]
    for k, constant in enumerate(halves):
        part = run(q=q, v=v, dt=0.05, steps=2, t0=0.1 * k, tau=constant, method=method)
        q, v = part.q[-1], part.v[-1]
    assert q == pytest.approx(s.q[-1], abs=1e-12)
    assert part.t[-1] == pytest.approx(s.t[-1])


def test_a_motion_stops_where_its_condition_holds_and_goes_on_from_there():
    whole = run(steps=100)
    first = run(steps=100, stop=lambda t, q, v: q[0] < 0)
    assert first.q[-2, 0] >= 0 > first.q[-1, 0]
    rest = run(q=first.q[-1], v=first.v[-1], t0=first.t[-1], steps=100 - len(first.tau))
    assert rest.t[-1] == pytest.approx(whole.t[-1])
    assert rest.q[-1] == pytest.approx(whole.q[-1], abs=1e-12)


def test_an_error_has_the_motion_until_then():
    with pytest.raises(tw.DivergenceError) as caught:
        run(v=np.ones(2), dt=0.1, steps=500, tau=lambda t, q, v: 100 * v)
    motion = caught.value.motion
    assert f"step {len(motion.t)}, from t = {motion.t[-1]:.6g}" in str(caught.value)
    assert np.isfinite(motion.energy).all()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"dt_control": 0.1}, "dt_control: there is no policy"),
        ({"dt_control": 0.025, "tau": lambda t, q, v: 0 * v}, "dt_control: expected a whole number of steps of 0.01 s"),
        ({"dt_control": -1, "tau": lambda t, q, v: 0 * v}, "dt_control: expected a positive number of seconds, got -1"),
    ],
)
def test_a_period_that_is_none_is_refused(options, said):
    with pytest.raises(ValueError, match=said):
        run(**options)


def test_a_condition_that_is_no_function_is_refused():
    with pytest.raises(TypeError, match=r"stop: expected a function \(t, q, v\) -> bool, got float"):
        run(stop=0.5)
    with pytest.raises(tw.ShapeError, match=r"stop\(t, q, v\): expected one bool for all motions, got shape \(2,\)"):
        run(stop=lambda t, q, v: [True, False])


# ---------------------------------------------------------------- what comes back


def test_the_summary_says_what_was_done_and_what_changed():
    text = str(run())
    assert text == repr(run())
    assert "double_pendulum by Runge-Kutta: 3 steps to 0.03 s, 12 evaluations" in text
    assert "energy changes by at most" in text
    assert "momentum" not in text  # the world holds its base


def test_the_summary_of_a_flight_has_momenta_without_that_of_the_weight():
    model = shared("go2")
    s = tw.simulate(model, model.standing(), np.zeros(model.nv), dt=0.1, steps=5)
    rows = str(s).splitlines()
    assert len(rows) == 5
    assert float(rows[3].split("at most ")[1].split()[0]) < 1e-11
    assert np.abs(s.momentum[-1, 5]) > 70  # which grows by m g t
    assert "a batch of (2,)" in str(tw.simulate(model, [model.standing()] * 2, np.zeros(model.nv), dt=0.1, steps=1))


def test_energy_and_momentum_are_those_of_the_states():
    model = Recipe(3, seed=1, base="floating").model
    s = tw.simulate(model, model.random_configuration(rng=0), np.ones(model.nv), dt=0.01, steps=2)
    q, v = s.q[-1], s.v[-1]
    assert s.energy[-1] == pytest.approx(tw.kinetic_energy(model, q, v) + tw.potential_energy(model, q), rel=1e-14)
    assert s.momentum[-1] == pytest.approx(tw.centroidal_momentum(model, q, v), rel=1e-13)
    kin = tw.forward_kinematics(model, q, v)
    about_origin = sum(
        T.force_transform() @ I.matrix() @ V for T, I, V in zip(kin.placement, model.inertia, kin.twist, strict=True)
    )
    assert s.momentum_about_origin[-1] == pytest.approx(about_origin, rel=1e-12)


def test_a_motion_is_drawn_on_given_axes():
    figure = pytest.importorskip("matplotlib.figure", reason="matplotlib is not installed")
    s = run(steps=5)
    for what, curves in {"energy": 1, "angular momentum": 3, "q": 2, "v": 2}.items():
        ax = figure.Figure().add_subplot()
        assert s.plot(ax, what=what) is ax
        assert len(ax.lines) == curves
        assert "s]" in ax.get_xlabel()
    assert ax.lines[1].get_ydata() == pytest.approx(s.v[:, 1])
    assert s.plot(figure.Figure().add_subplot()).lines[0].get_ydata() == pytest.approx(s.energy - s.energy[0])
    rotor = tw.Builder("a rotor without mass")
    rotor.link("rotor", parent="base_link", joint=tw.Revolute("z"), armature=0.1)
    turning = tw.simulate(rotor.build(), [0.0], [1.0], dt=0.1, steps=2)  # there is no centre of mass, nor any asked for
    assert turning.plot(figure.Figure().add_subplot(), what="q").lines[0].get_ydata() == pytest.approx([0, 0.1, 0.2])
    pyplot = pytest.importorskip("matplotlib.pyplot")
    try:
        assert s.plot().figure.number in pyplot.get_fignums()
    finally:
        pyplot.close("all")
    with pytest.raises(tw.NameNotFound, match="unknown quantity 'enrgy'; did you mean 'energy'"):
        s.plot(what="enrgy")


# ---------------------------------------------------------------- what is refused


@pytest.mark.parametrize("dt", [0, -0.1, np.nan, np.inf])
def test_a_dt_that_is_no_duration_is_refused(dt):
    with pytest.raises(ValueError, match="dt: expected a positive number of seconds, got"):
        run(dt=dt)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({}, "expected one of the two, got None and None"),
        ({"steps": 3, "duration": 0.1}, "expected one of the two, got 3 and 0.1"),
        ({"steps": -1}, "steps: expected a whole number of at least 0, got -1"),
        ({"steps": 2.5}, "steps: expected a whole number of at least 0, got 2.5"),
        ({"steps": np.nan}, "steps: expected a whole number"),
        ({"duration": -1.0}, "duration: expected seconds, 0 or more and less than 2"),
        ({"duration": np.inf}, "duration: expected seconds"),
        ({"duration": 0.025}, "expected a whole number of steps of 0.01 s, got 0.025 s, which is 2.5 of them"),
    ],
)
def test_a_number_of_steps_that_is_none_is_refused(options, said):
    with pytest.raises(ValueError, match=said):
        tw.simulate(PENDULUM, [0.0], [0.0], dt=0.01, **options)


def test_an_unknown_method_is_refused_with_the_known_ones():
    with pytest.raises(tw.NameNotFound, match="unknown method 'rk5'; did you mean 'rk4'"):
        run(method="rk5")


def test_a_state_of_the_wrong_shape_is_refused():
    with pytest.raises(tw.ShapeError, match=r"q: expected shape \(..., 2\), got \(3,\)"):
        run(q=[0, 0, 0])
    with pytest.raises(tw.ShapeError, match="batch axes do not broadcast"):
        run(q=np.zeros((2, 2)), v=np.zeros((3, 2)))


def test_complex_numbers_are_refused():
    with pytest.raises(ValueError, match="q, v: expected real numbers, got complex128"):
        run(q=[0.1j, 0])
    with pytest.raises(ValueError, match="tau: expected real numbers, got complex128"):
        run(tau=[0.1j, 0])


def test_forces_of_the_wrong_shape_are_refused_with_the_time():
    with pytest.raises(tw.ShapeError, match=r"tau: expected shape \(2,\), got \(3,\)$"):
        run(tau=[0, 0, 0])
    with pytest.raises(tw.ShapeError, match=r"tau\(t, q, v\): expected shape \(2,\), got \(1, 2\) at t = 0$"):
        run(tau=lambda t, q, v: [[0, 0]])
    with pytest.raises(tw.ShapeError, match=r"tau\(t, q, v\): expected shape \(2,\), got \(1,\) at t = 0.02"):
        run(tau=lambda t, q, v: np.zeros(2 if t < 0.02 else 1), method="euler")


def test_the_torques_of_the_motors_alone_are_refused_with_a_hint():
    model = shared("go2")
    with pytest.raises(tw.ShapeError, match=r"got \(12,\) at t = 0; the six entries of the floating base come first"):
        tw.simulate(model, model.standing(), np.zeros(18), dt=0.01, steps=1, tau=lambda t, q, v: np.zeros(12))


def test_forces_that_are_no_numbers_are_refused_with_the_time():
    with pytest.raises(ValueError, match=r"tau\(t, q, v\): expected numbers, got None at t = 0"):
        run(tau=lambda t, q, v: None)
    with pytest.raises(
        ValueError, match=r"tau\(t, q, v\): expected finite numbers, got nan at index \(1,\) at t = 0.01"
    ):
        run(tau=lambda t, q, v: [0, 0 if t < 0.01 else np.nan], method="euler")


@pytest.mark.parametrize("method", SMOOTH)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_motion_that_leaves_all_bounds_is_refused_with_time_and_joint(method, dtype):
    """Never a NaN, and no overflow on the way."""
    with pytest.raises(tw.DivergenceError, match=r"^step \d+, from t = [\d.]+ s: .*joint '(shoulder|elbow)'"):
        run(v=np.ones(2, dtype), dt=0.1, steps=500, tau=lambda t, q, v: 100 * v, method=method)


@pytest.mark.slow
def test_a_base_that_turns_more_than_once_in_a_step_is_refused():
    model = replace(shared("go2"), gravity=np.zeros(3))
    v = np.zeros(18)
    v[0] = 100
    with pytest.raises(tw.DivergenceError, match="turns by more than a whole turn in one step"):
        tw.simulate(model, model.standing(), v, dt=1.0, steps=1, method="variational")


def test_a_step_that_cannot_be_solved_is_refused(monkeypatch):
    """Far too long a step; and one iteration where five are needed."""
    with pytest.raises(tw.DivergenceError, match=r"^step \d+, from t = \d+ s: .*joint '(elbow|shoulder)'"):
        run(q=[2.0, -1.0], v=[5.0, -5.0], dt=1.0, steps=20, method="variational")
    monkeypatch.setattr(variational, "MAX_ITERATIONS", 1)
    with pytest.raises(tw.DivergenceError, match=r"not solved in 1 iterations, least of all for joint 'shoulder'"):
        run(q=[2.0, -1.0], v=[5.0, -5.0], dt=0.1, steps=1, method="variational")


@pytest.mark.parametrize("method", METHODS)
def test_a_singular_state_is_refused_with_the_time(method):
    builder = tw.Builder("weightless")
    builder.link("rod", parent="base_link", joint=tw.Revolute("y"), inertia=None)
    model = builder.build()
    with pytest.raises(tw.SingularError, match=r"step 1, from t = 0 s: .*'rod"):
        tw.simulate(model, [0.0], [0.0], dt=0.1, steps=1, method=method)


# ---------------------------------------------------------------- the page


def test_both_pages_have_the_same_code_and_the_same_numbers():
    def code(path):
        text = path.read_text(encoding="utf-8")
        return [block.strip() for block in blocks(text, 0, len(text))]

    def numbers(path):
        rows = [line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
        return [re.findall(r"`[^`]+`|[\d.]+(?:e[-+]\d+)?", row) for row in rows]

    english, chinese = (page("simulation", language) for language in ("", ".zh-CN"))
    uncommented = [[re.sub(r"#.*", "", block) for block in code(path)] for path in (english, chinese)]
    assert uncommented[0] == uncommented[1]
    assert len(uncommented[0]) == 8
    assert numbers(english) == numbers(chinese)


@pytest.mark.slow
def test_the_code_of_the_page_runs():
    text = page("simulation").read_text(encoding="utf-8")
    run_page(page("simulation"), blocks(text, 0, len(text)))


def test_the_table_of_the_page_names_the_methods_with_their_orders():
    text = page("simulation").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([\w-]+)` \| (\d) \|", text, re.MULTILINE)
    assert [(name, int(order)) for name, order in rows] == [(name, m.order) for name, m in METHODS.items()]


def test_a_name_is_no_robot_yet():
    with pytest.raises(TypeError, match=r"robot: expected a Model or a Scene, got the str 'pendulum'"):
        tw.simulate("pendulum", [0.0], [0.0], dt=0.01, steps=1)


# ---------------------------------------------------------------- what is left out, and what an interrupt leaves


def test_a_smooth_method_says_that_it_leaves_out_damping_and_dry_friction_and_time_stepping_applies_them():
    rough = replace(PENDULUM, damping=np.array([0.2]), friction=np.array([0.05]))
    s = tw.simulate(rough, [0.3], [1.0], dt=0.01, steps=20)
    left_out = {r.kind: r for r in s.remarks}
    assert left_out["damping"].value == 0.2 * np.abs(s.v).max()
    assert left_out["friction"].value == 0.05
    assert "'time-stepping'" in str(s)
    assert (s.q == tw.simulate(PENDULUM, [0.3], [1.0], dt=0.01, steps=20).q).all()
    braked = tw.simulate(rough, [0.3], [1.0], dt=0.01, steps=20, method="time-stepping")
    assert not {"damping", "friction"} & {r.kind for r in braked.remarks}
    assert not tw.simulate(rough, [0.3], [0.0], dt=0.01, steps=0).remarks  # it has not moved


@pytest.mark.parametrize("stopped_by", [KeyboardInterrupt, ZeroDivisionError])
@pytest.mark.parametrize("ground", [None, tw.Ground(-5.0)])
def test_what_was_made_before_an_interrupt_is_kept(stopped_by, ground):
    def policy(t, q, v):
        if t > 0.1:
            raise stopped_by
        return [0.5]

    with pytest.raises(stopped_by) as caught:
        tw.simulate(PENDULUM, [0.3], [1.0], dt=0.01, steps=100, tau=policy, dt_control=0.01, ground=ground)
    whole = tw.simulate(PENDULUM, [0.3], [1.0], dt=0.01, steps=11, tau=[0.5], ground=ground)
    assert (caught.value.motion.q == whole.q[: len(caught.value.motion.q)]).all()
    assert len(caught.value.motion.tau) == len(caught.value.motion.q) - 1 >= 10


def test_the_error_of_a_step_is_printed_unless_it_cannot_be_told():
    s = tw.simulate(PENDULUM, [2.0], [0.0], dt=0.01, steps=10)
    assert f"a step is off by up to {s.step_error(5)[0]:.1e} in q" in str(s)
    assert "a step" not in str(tw.simulate(PENDULUM, [2.0], [0.0], dt=0.01, steps=0))

"""What began a divergence: the joint, its apparent inertia, and the longest step."""

import re
from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw

from ..robots import shared

STABLE = {"euler": 2.0, "semi-implicit": 2.0, "midpoint": 2.0, "rk4": 2.785}


def told(error, quantity):
    """The number after a quantity in a message."""
    return float(re.search(rf"{quantity} = ([0-9.e+-]+)", str(error)).group(1))


def wheel(inertia):
    builder = tw.Builder("wheel", gravity=(0, 0, 0))
    solid = tw.SpatialInertia(1.0, [0, 0, 0], inertia * np.eye(3))
    builder.link("disc", parent="base_link", joint=tw.Revolute("z"), inertia=solid)
    return builder.build()


@pytest.mark.one_case
@pytest.mark.parametrize("method", STABLE)
def test_a_damped_wheel_is_stable_up_to_the_step_that_the_message_names(method):
    """v⁺ = R(−dt kd / D) v, with the polynomial R of the method: closed form."""
    model, kd = wheel(0.02), 4.0
    longest = STABLE[method] * 0.02 / kd

    def moved(dt):
        return tw.simulate(model, [0.0], [1.0], dt=dt, steps=3000, tau=lambda t, q, v: -kd * v, method=method)

    assert abs(moved(0.98 * longest).v[-1, 0]) < 1e-6
    with pytest.raises(tw.DivergenceError, match="it began with joint 'disc'") as raised:
        moved(1.3 * longest)
    assert told(raised.value, "D") == pytest.approx(0.02, rel=0.05)
    assert told(raised.value, "kd") == pytest.approx(kd, rel=0.01)
    assert told(raised.value, "D/kd") == pytest.approx(longest, rel=0.05)
    assert ("alternates" in str(raised.value)) == (method in ("euler", "semi-implicit"))


def test_the_ankle_of_a_humanoid_is_named():
    """The apparent inertia of its roll is that of the foot alone: 0.00015 kg m², and kd = 3 needs 0.1 ms."""
    model = shared("humanoid")
    q0 = model.standing()

    def hold(t, q, v):
        return np.r_[np.zeros(6), 300.0 * (q0[7:] - q[7:]) - 3.0 * v[6:]]

    with pytest.raises(tw.DivergenceError) as raised:
        tw.simulate(model, q0, 0.1 * np.ones(27), dt=1e-3, steps=100, tau=hold, method="semi-implicit")
    assert re.search("began with joint '(left|right)_ankle_roll', whose velocity alternates", str(raised.value))
    ankle = model.v_slice[model.joint_id("left_ankle_roll")].start
    D = 1 / np.linalg.inv(tw.crba(model, q0))[ankle, ankle]
    assert told(raised.value, "D") == pytest.approx(D, rel=0.05)
    assert told(raised.value, "D/kd") == pytest.approx(2 * D / 3, rel=0.1)


@pytest.mark.parametrize("gain", ["kd", "kp"])
def test_joints_that_are_stable_one_by_one_and_not_together_are_named(gain):
    """Near rest v⁺ = (1 − dt M⁻¹ kd) v, and with springs v swings at √λ, of the largest eigenvalue."""
    model, dt, q0 = replace(shared("planar_arm"), gravity=np.zeros(3)), 1e-3, np.array([0.3, 0.6, 0.9])
    inverse = np.linalg.inv(tw.crba(model, q0))
    k = 0.9 * 2 / dt / np.diag(inverse) if gain == "kd" else 0.5 * (2 / dt) ** 2 / np.diag(inverse)
    largest = np.linalg.eigvals(inverse @ np.diag(k)).real.max()
    longest = 2 / largest if gain == "kd" else 2 / np.sqrt(largest)
    assert longest < dt

    def moved(dt):
        def tau(t, q, v):
            return -k * (v if gain == "kd" else q - q0)

        return tw.simulate(model, q0, [1e-6, 2e-6, -1e-6], dt=dt, steps=3000, tau=tau, method="semi-implicit")

    assert np.abs(moved(0.95 * longest).v[-1]).max() < 1e-5
    with pytest.raises(
        tw.DivergenceError, match=f"it began with joint '.*alone it would not, but with '.*M⁻¹ {gain}"
    ) as e:
        moved(dt)
    assert told(e.value, "λ") == pytest.approx(largest, rel=0.05)
    assert told(e.value, "2/√?λ") == pytest.approx(longest, rel=0.05)


def test_the_clock_of_a_policy_counts_and_not_the_step():
    clock = {"dt": 1e-3, "dt_control": 0.02, "steps": 20_000}
    with pytest.raises(tw.DivergenceError) as raised:
        tw.simulate(wheel(0.02), [0.0], [1.0], tau=lambda t, q, v: -4 * v, **clock)
    assert told(raised.value, "dt_control") == pytest.approx(0.02)
    assert told(raised.value, "D/kd") == pytest.approx(0.01, rel=0.01)


def test_a_spring_that_is_too_stiff_is_named_with_its_step():
    model, kp = wheel(0.02), 200.0  # ω = 100 rad/s
    with pytest.raises(tw.DivergenceError, match="stiffness kp = 200") as raised:
        tw.simulate(model, [0.1], [0.0], dt=0.025, steps=500, tau=lambda t, q, v: -kp * q, method="semi-implicit")
    assert re.search(r"√\(D/kp\) = 0\.02 s", str(raised.value))


def test_a_policy_that_pushes_the_way_it_moves_is_named():
    with pytest.raises(tw.DivergenceError, match="joint 'disc': its τ grows with its own velocity, by 4"):
        tw.simulate(wheel(0.02), [0.0], [1.0], dt=0.01, steps=500, tau=lambda t, q, v: 4 * v)


@pytest.mark.parametrize("method", ["euler", "semi-implicit", "midpoint", "rk4"])
def test_a_rod_that_spins_too_fast_for_its_step_is_named_with_its_angle(method):
    inertia = tw.SpatialInertia(1e-3, [0, 0, 0], np.diag([2e-10, 8e-5, 8e-5]))
    rod = tw.Builder("rod", base="floating", root="rod", root_inertia=inertia, gravity=(0, 0, 0)).build()
    with pytest.raises(tw.DivergenceError, match=r"began with joint 'root_joint'.*dt \|ω\| = ") as raised:
        tw.simulate(rod, rod.neutral(), [200.0, 300, 400, 0, 0, 0], dt=0.019, steps=50, method=method)
    assert told(raised.value, r"dt \|ω\|") > 5


def test_a_policy_that_cannot_be_asked_again_leaves_the_message_as_it_was():
    calls = []

    def until_then(t, q, v):
        calls.append(t)
        if not np.isclose(t, 0.1 * (len(calls) - 1)):
            raise ValueError("the log is read once")
        return 100.0 * v

    with pytest.raises(tw.DivergenceError, match=r"^step \d+, from .*weaker forces\?$"):
        tw.simulate(wheel(0.02), [0.0], [1.0], dt=0.1, steps=50, tau=until_then, method="euler")


@pytest.mark.parametrize("clock", [{"dt": 0.01}, {"dt": 0.002, "dt_control": 0.01}])
def test_gains_that_are_too_high_are_told_of_a_motion_that_has_not_diverged_yet(clock):
    """v changes by the factor 1 − dt kd / D in each step: −1.4 here, and −0.8 with half the gain, which dies out."""
    model = wheel(0.02)

    def moved(kd):
        options = {"duration": 0.1, "tau": lambda t, q, v: -kd * v, "method": "time-stepping"} | clock
        return tw.simulate(model, [0.0], [1.0], **options)

    said = [(r.kind, r.name) for r in moved(4.8).remarks]
    assert said == [("alternates", "disc")]
    assert moved(3.6).remarks == ()


def test_a_coin_that_rattles_until_it_lies_has_no_gains():
    inertia = tw.SpatialInertia(1.0, [0, 0, 0], 0.0025 * np.diag([1.0, 2.0, 1.0]))
    coin = tw.Builder("coin", base="floating", root="coin", root_inertia=inertia).build()
    q, rim = [0, 0, 0.1 * np.cos(1.2), -np.sin(0.6), 0, 0, np.cos(0.6)], [tw.WheelContact("coin", 0.1, 0.5)]
    s = tw.simulate(coin, q, np.zeros(6), dt=1e-3, duration=0.13, contacts=rim, ground=tw.Ground())
    assert "alternates" not in {remark.kind for remark in s.remarks}


def test_a_policy_that_fails_does_not_hide_the_divergence_nor_the_print():
    """Asked for its gains, and for the error of a step, it may raise anything."""
    log = {round(0.1 * k, 6): 100.0 for k in range(50)}
    with pytest.raises(tw.DivergenceError) as raised:
        tw.simulate(
            wheel(0.02), [0.0], [1.0], dt=0.1, steps=50, tau=lambda t, q, v: log.pop(round(t, 6)) * v, method="euler"
        )
    assert "a step is off" not in str(raised.value.motion)

"""Motions of robots some of whose joints follow others."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.algorithms.mimic import follow
from twistwrench.simulation import METHODS

from ..robots import shared


def arm():
    return follow(shared("planar_arm"), {"wrist": ("elbow", -1.0, 0.5)})


def shake(t, q, v):
    return np.array([np.sin(3 * t), 0.4]) - 0.2 * v


@pytest.mark.one_case
@pytest.mark.parametrize("method", ["rk4", "midpoint", "semi-implicit", "time-stepping"])
def test_an_arm_whose_wrist_follows_moves_as_its_projected_equations_say(method):
    """M = Gᵀ M_full G and h = Gᵀ h_full, by SciPy's DOP853, to the order of the method."""
    integrate = pytest.importorskip("scipy.integrate", reason="SciPy is not installed")
    model = arm()
    q, v, T = np.array([0.3, 0.6]), np.array([0.5, -0.4]), 0.16

    def rates(t, x):
        q, v = x[:2], x[2:]
        return np.r_[v, np.linalg.solve(tw.crba(model, q), shake(t, q, v) - tw.nonlinear_effects(model, q, v))]

    end = integrate.solve_ivp(rates, (0, T), np.r_[q, v], "DOP853", rtol=1e-12, atol=1e-13).y[:, -1]

    def moved(n):
        return tw.simulate(model, q, v, dt=T / n, steps=n, tau=shake, method=method)

    errors = [np.abs(np.r_[s.q[-1], s.v[-1]] - end).max() for s in (moved(20), moved(40))]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(METHODS[method].order, abs=0.3), errors
    motion = moved(20)
    assert motion.q.shape == motion.v.shape == (21, 2)
    assert motion.tau.shape == (20, 2)
    assert motion.model is model
    full_q, full_v, _ = motion.full
    np.testing.assert_allclose(full_q[:, 2], 0.5 - full_q[:, 1], rtol=0, atol=1e-11)
    np.testing.assert_allclose(full_v[:, 2], -full_v[:, 1], rtol=0, atol=1e-11)


def test_its_energy_gains_what_the_forces_put_in_and_it_prints():
    motion = tw.simulate(arm(), [0.3, 0.6], [0.5, -0.4], dt=0.002, duration=0.2, tau=[0.1, 0.2])
    assert motion.energy[-1] - motion.energy[0] == pytest.approx(motion.work[-1], abs=1e-5)
    assert max(motion.step_error()) < 1e-9
    assert "planar_arm by Runge-Kutta: 100 steps" in str(motion)


def test_a_condition_and_constant_forces_are_in_its_own_coordinates():
    model, seen = arm(), []
    motion = tw.simulate(
        model, [0.3, 0.6], [0, 0], dt=0.01, steps=9, tau=[0.1, 0.2], stop=lambda t, q, v: bool(seen.append(q.shape))
    )
    assert set(seen) == {(2,)}
    assert (motion.tau == [0.1, 0.2]).all()
    for wrong in ([0.1, 0.2, 0.3, 0.4], np.zeros(3), lambda t, q, v: np.zeros(3)):  # three joints has the full robot
        with pytest.raises(tw.ShapeError, match=r"expected shape \(\.\.\., 2\)"):
            tw.simulate(model, [0.3, 0.6], [0, 0], dt=0.01, steps=1, tau=wrong)


def test_a_divergence_has_the_motion_of_the_leaders():
    with pytest.raises(tw.DivergenceError) as raised:
        tw.simulate(arm(), [0.3, 0.6], [0.1, 0.1], dt=0.01, steps=500, tau=lambda t, q, v: 100 * v, method="euler")
    assert raised.value.motion.q.shape[-1] == 2


def test_what_takes_no_couplings_refuses_it_by_name():
    with pytest.raises(ValueError, match="method: 'variational' takes no couplings, and joints that follow"):
        tw.simulate(arm(), [0.3, 0.6], [0, 0], dt=0.01, steps=1, method="variational")


@pytest.mark.slow
def test_a_robot_whose_knees_follow_lands_on_the_ground():
    """Both hind knees by one coordinate: they stay alike, and in the end the feet carry the weight."""
    go2 = shared("go2")
    model = follow(go2, {"RR_calf_joint": ("RL_calf_joint", 1.0, 0.0)})
    feet = [tw.PointContact(foot, 0.6) for foot in go2.feet]
    stand = go2.standing()[model.kept_q]
    hold = tw.static_equilibrium(go2, go2.standing()).tau @ model.G[6:, 6:]

    def drives(t, q, v):
        return np.r_[np.zeros(6), hold - 60 * (q[7:] - stand[7:]) - v[6:]]

    q = stand + np.eye(18)[2] * 0.02
    s = tw.simulate(model, q, np.zeros(17), dt=0.002, duration=0.6, tau=drives, contacts=feet, ground=tw.Ground())
    knees = [go2.q_slice[go2.joint_id(f"R{side}_calf_joint")].start for side in "RL"]
    assert np.abs(np.diff(s.full[0][:, knees], axis=1)).max() < 1e-9
    up = sum(s.contact_forces[foot][:, 2] for foot in go2.feet)
    assert up[0] == 0  # it flies
    assert up[-1] == pytest.approx(go2.mass * 9.81, rel=0.05)
    assert all((s.contact_forces[foot][:, 2] >= 0).all() for foot in go2.feet)

"""What `Simulation.step_error` says of one step is what SciPy's DOP853 finds."""

import pickle

import numpy as np
import pytest

import twistwrench as tw


def nothing(t, q, v):
    return 0 * v


def damper(t, q, v):
    return -0.5 * v


def shaken(t, q, v):
    return np.sin(3 * t) - 0.2 * v


EXAMPLES = {
    "pendulum": ("pendulum", [2.0], 0.01, nothing),
    "damped pendulum": ("pendulum", [2.0], 0.01, damper),
    "double pendulum": ("double_pendulum", [1.0, 0.5], 0.01, nothing),
    "arm under a policy": ("planar_arm", None, 0.005, shaken),
}


def largest_error(motion, policy, samples):
    """The largest error of the steps that `step_error` makes again, of q and of v."""
    integrate = pytest.importorskip("scipy.integrate", reason="SciPy is not installed")
    model, n, dt, worst = motion.model, motion.model.nv, motion.system.dt, np.zeros(2)
    for k in np.unique(np.linspace(0, len(motion.tau) - 1, samples).astype(int)):
        q, v, t = motion.q[k], motion.v[k], motion.t[k]

        def rates(s, y, q=q, t=t):
            moved = q + y[:n]
            return np.concatenate([y[n:], tw.fast.aba(model, moved, y[n:], policy(t + s, moved, y[n:]))])

        start = np.concatenate([np.zeros(n), v])
        end = integrate.solve_ivp(rates, (0, dt), start, method="DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
        off = np.abs(motion.q[k + 1] - q - end[:n]).max(), np.abs(motion.v[k + 1] - end[n:]).max()
        worst = np.maximum(worst, off)
    return worst


@pytest.mark.parametrize("method", ["euler", "semi-implicit", "midpoint", "rk4", "variational"])
@pytest.mark.parametrize("example", EXAMPLES)
def test_the_error_of_a_step_is_the_one_that_dop853_finds(example, method):
    robot, q, dt, policy = EXAMPLES[example]
    model = tw.load(robot)
    q = np.linspace(0.3, 0.9, model.nv) if q is None else q
    motion = tw.simulate(model, q, np.zeros(model.nv), dt=dt, duration=0.2, tau=policy, method=method)
    np.testing.assert_allclose(motion.step_error(5), largest_error(motion, policy, 5), rtol=0.15)


def test_forces_that_were_held_are_held_again():
    calls = []

    def policy(t, q, v):
        calls.append(t)
        return -v

    motion = tw.simulate(tw.load("pendulum"), [1.0], [0.0], dt=0.01, steps=20, tau=policy, dt_control=0.02)
    asked = len(calls)
    error = motion.step_error()
    assert len(calls) == asked == 10
    assert 0 < max(error) < 1e-7


def test_a_motion_and_an_error_under_a_lambda_leave_a_worker():
    """As a process does it: by a pickle, in which the policy stays behind."""

    def moved(gain):
        return tw.simulate(tw.load("pendulum"), [1.0], [0.0], dt=0.01, steps=2000, tau=lambda t, q, v: gain * v)

    with pytest.raises(tw.DivergenceError) as raised:
        moved(1e3)
    failed = pickle.loads(pickle.dumps(raised.value))
    assert str(failed) == str(raised.value)
    assert (failed.motion.q == raised.value.motion.q).all()
    motion = moved(-1.0)
    there = pickle.loads(pickle.dumps(motion))
    assert (there.q == motion.q).all()
    with pytest.raises(ValueError, match="policy"):
        there.step_error()
    assert "a step is off" in str(motion)
    assert "a step is off" not in str(there)

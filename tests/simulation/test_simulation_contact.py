"""Motion in time with contacts that stick: what a pin does, a Go2 on its feet, and scenes."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.spatial import rotation_to_quaternion

from ..robots import shared
from ..sampling import sampled
from .test_simulation import ORDERS, pendulum

GO2 = shared("go2")  # one for all, so that each program is made once
WITH_CONTACTS = [method for method in ORDERS if method != "variational"]


def pinned_ball(*, spherical: bool):
    """A ball on a rod of 1 m, as `pendulum`: on a spherical joint, or flying freely with a frame to be pinned."""
    ball = tw.SpatialInertia(1.0, [0, 0, -1], 0.001 * np.eye(3))
    if not spherical:
        return tw.Builder("ball", base="floating", root="rod", root_inertia=ball).build()
    builder = tw.Builder("ball")
    builder.link("rod", parent="base_link", joint=tw.Spherical(), inertia=ball)
    return builder.build()


def standing_go2(stiffness=60.0, damping=1.0):
    """A Go2 on its feet, whose motors hold its posture by springs and dampers about the torques of its equilibrium."""
    model = GO2
    posture, hold = model.standing(), tw.static_equilibrium(model, model.standing()).tau

    def policy(t, q, v):
        tau = np.zeros(model.nv)
        tau[6:] = hold - stiffness * (q[7:] - posture[7:]) - damping * v[6:]
        return tau

    return model, policy, [tw.PointContact(foot, 0.6) for foot in model.feet]


# ---------------------------------------------------------------- a pin


@pytest.mark.parametrize("method", WITH_CONTACTS)
def test_a_pinned_body_swings_as_the_closed_form_says_with_the_order_of_theory(method):
    exact, model = pendulum(), pinned_ball(spherical=False)
    q, v = (np.concatenate([np.zeros(3), rotation_to_quaternion(tw.exp3([0, exact.q[0], 0]))]), np.zeros(6))
    errors = []
    for n in {1: (40, 80), 2: (20, 40), 4: (12, 24)}[ORDERS[method]]:
        s = tw.simulate(model, q, v, dt=exact.T / n, steps=n, contacts=[tw.PointContact("rod", 1.0)], method=method)
        turned = tw.log3(model.joints[1].transform(s.q[-1]).rotation)
        errors.append(max(np.abs(turned - [0, exact.q_end[0], 0]).max(), abs(s.v[-1, 1] - exact.v_end[0])))
        assert np.abs(s.q[:, :3]).max() < 1e-12  # the pin is where it was
    assert abs(np.log2(errors[0] / errors[1]) - ORDERS[method]) < 0.1, errors


def test_a_pin_does_what_a_ball_joint_does():
    pinned, jointed = pinned_ball(spherical=False), pinned_ball(spherical=True)
    turn, w = rotation_to_quaternion(tw.exp3([0.4, 1.0, -0.2])), np.array([1.0, -0.5, 2.0])
    a = tw.simulate(
        pinned,
        np.concatenate([np.zeros(3), turn]),
        np.concatenate([w, np.zeros(3)]),
        dt=0.01,
        steps=20,
        contacts=[tw.PointContact("rod", 1.0)],
    )
    b = tw.simulate(jointed, turn, w, dt=0.01, steps=20)
    assert np.abs(a.q[:, 3:] - b.q).max() < 1e-12
    assert np.abs(a.energy - b.energy).max() < 1e-11
    wrench = [
        -tw.joint_wrenches(jointed, q, v, tw.aba(jointed, q, v, 0 * v))[1, 3:] for q, v in zip(b.q, b.v, strict=True)
    ]
    rotation = jointed.joints[1].transform(b.q).rotation
    assert a.contact_forces["rod"] == pytest.approx(-np.matvec(rotation, wrench), abs=1e-9)


# ---------------------------------------------------------------- a robot on its feet


def test_a_go2_that_stands_keeps_standing():
    model, policy, feet = standing_go2()
    s = tw.simulate(model, model.standing(), np.zeros(model.nv), dt=0.01, steps=10, tau=policy, contacts=feet)
    assert np.abs(s.q - s.q[0]).max() < 1e-12
    weight = sum(s.contact_forces[foot] for foot in model.feet)
    assert weight == pytest.approx(np.broadcast_to([0, 0, model.mass * 9.81], (11, 3)), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("method", sampled(WITH_CONTACTS, 1))
def test_a_go2_that_is_pushed_sways_on_feet_that_stay(method):
    model, policy, feet = standing_go2()
    v = np.zeros(model.nv)
    v[3:5] = 0.5, 0.3
    v = tw.impact(model, model.standing(), v, feet).v
    s = tw.simulate(model, model.standing(), v, dt=0.005, steps=12, tau=policy, contacts=feet, method=method)
    assert np.abs(s.q[:, :2] - s.q[0, :2]).max() > 0.005
    for foot in model.feet:
        at = tw.frame_placement(model, s.q, foot).translation
        assert np.abs(at - at[0]).max() < 1e-11
    slip = np.matvec(tw.contact_jacobian(model, s.q, model.feet), s.v)
    assert np.abs(slip).max() < 1e-12


def test_a_robot_that_no_motor_moves_keeps_its_energy_on_feet_that_do_no_work():
    """Go2 without torques sinks on its four feet; the error is Runge-Kutta's, 16 times less at half the dt."""
    model, _, feet = standing_go2()
    error = []
    for n in (4, 8):
        s = tw.simulate(model, model.standing(), np.zeros(model.nv), dt=0.04 / n, steps=n, contacts=feet)
        error.append(np.abs(s.energy - s.energy[0]).max())
    assert error[0] < 1e-6
    assert error[1] < error[0] / 8


def test_contacts_are_computed_in_double_precision():
    model, policy, feet = standing_go2()
    q = model.standing()
    q[3:7] = rotation_to_quaternion(tw.exp3([0.1, 0.2, 0.3]))
    s = tw.simulate(model, q.astype(np.float32), np.zeros(18, np.float32), dt=0.005, steps=2, tau=policy, contacts=feet)
    assert s.q.dtype == s.v.dtype == np.float64
    at = tw.frame_placement(model, s.q, "FL_foot").translation
    assert np.abs(at - at[0]).max() < 1e-12


def test_no_states_at_all_move_nowhere():
    model, _, feet = standing_go2()
    s = tw.simulate(model, np.zeros((0, 19)), np.zeros((0, 18)), dt=0.01, steps=2, contacts=feet)
    assert s.q.shape == (3, 0, 19)
    assert s.contact_forces["FL_foot"].shape == (3, 0, 3)


# ---------------------------------------------------------------- scenes


def test_a_scene_brings_its_model_and_its_contacts():
    model, _, feet = standing_go2()
    scene = tw.Scene("go2", contacts=feet)
    q, v, tau = model.standing(), np.zeros(model.nv), np.linspace(0, 1, model.nv)
    a = tw.simulate(scene, q, v, dt=0.01, steps=2, tau=tau)
    b = tw.simulate(model, q, v, dt=0.01, steps=2, tau=tau, contacts=feet)
    assert a.model is scene.model
    assert np.abs(a.q - b.q).max() < 1e-14


@pytest.mark.one_case
@pytest.mark.parametrize("method", ["rk4", "variational"])
def test_the_wrenches_of_a_scene_push(method):
    """A force on a frame off the base, in the axes of the world: as a policy that has Jᵀ f."""
    scene = tw.Scene("go2", wrenches={"FL_foot": [0.1, 0.2, 0.3, 5.0, -3.0, 20.0]})
    model, wrench = scene.model, scene.wrenches["FL_foot"]

    def policy(t, q, v):
        return tw.frame_jacobian(model, q, "FL_foot", "local_world_aligned").mT @ wrench

    q, v = model.standing(), np.full(model.nv, 0.2)
    a = tw.simulate(scene, q, v, dt=0.01, steps=3, method=method)
    b = tw.simulate(model, q, v, dt=0.01, steps=3, tau=policy, method=method)
    assert np.abs(a.v - b.v).max() < 1e-9
    assert np.abs(a.v - tw.simulate(model, q, v, dt=0.01, steps=3, method=method).v).max() > 0.01


def test_the_forces_at_the_contacts_are_those_of_the_motion_whatever_becomes_of_the_callers_array():
    model, _, feet = standing_go2()
    tau = np.linspace(0, 1, 18)
    a, b = (tw.simulate(model, model.standing(), np.zeros(18), dt=0.01, steps=1, tau=tau, contacts=feet) for _ in "ab")
    expected = a.contact_forces["FL_foot"]
    tau[:] = 100.0
    assert (b.contact_forces["FL_foot"] == expected).all()


class Noisy:
    """A controller that says something else whenever it is asked."""

    def __init__(self, policy, integral):
        self.policy, self.integral, self.rng, self.sum, self.said = policy, integral, np.random.default_rng(0), 0.0, []

    def __call__(self, t, q, v):
        self.sum = self.sum + v
        drive = np.r_[np.zeros(6), self.rng.normal(size=12) * 3] if not self.integral else -0.1 * self.sum
        self.said.append((t, self.policy(t, q, v) + np.r_[np.zeros(6), drive[6:]]))
        return self.said[-1][1]


@pytest.mark.parametrize("integral", sampled([True, False], 1))
def test_forces_and_torques_are_those_that_were_applied(integral):
    """Their sum is what the momentum changes by, and the policy is not asked again."""
    model, policy, feet = standing_go2()
    noisy, dt = Noisy(policy, integral), 1e-3
    v = tw.impact(model, model.standing(), np.r_[0, 0, 0, 0.3, 0.2, 0, np.zeros(12)], feet).v
    s = tw.simulate(model, model.standing(), v, dt=dt, steps=30, contacts=feet, tau=noisy, method="semi-implicit")
    asked = len(noisy.said)
    assert asked == s.evaluations - 1 == 30  # in the last state the last forces hold on
    assert (s.tau == [tau for _, tau in noisy.said[:30]]).all()
    pushed = sum(s.contact_forces.values())
    assert len(noisy.said) == asked
    gained = np.diff(s.momentum[:, 3:], axis=0) / dt
    assert np.abs(pushed[:-1] + model.mass * model.gravity - gained).max() < 0.02 * model.mass * 9.81
    for k, (_, tau) in enumerate(noisy.said):  # and exactly so, as the equation of motion has it
        want = tw.contact_forward_dynamics(model, s.q[k], s.v[k], tau, feet).forces
        assert all((want[foot] == s.contact_forces[foot][k]).all() for foot in model.feet)
    at_the_end = tw.contact_forward_dynamics(model, s.q[-1], s.v[-1], s.tau[-1], feet).forces
    assert all((at_the_end[foot] == s.contact_forces[foot][-1]).all() for foot in model.feet)


@pytest.mark.parametrize("method", ORDERS)
def test_the_torques_of_each_step_are_kept(method):
    said = []
    s = tw.simulate(
        *(shared("double_pendulum"), [0.3, -0.5], [0.0, 1.0]),
        dt=0.01,
        steps=4,
        method=method,
        tau=lambda t, q, v: said.append((t, -v)) or -v,
    )
    assert s.tau.shape == (4, 2)
    assert s.contact_forces == {}
    if method == "variational":  # in the middle of the step, where it was found
        assert np.abs(s.tau + (s.v[1:] + s.v[:-1]) / 2).max() < 1e-3
    else:
        assert (s.tau == -s.v[:-1]).all()


# ---------------------------------------------------------------- what is refused


def test_a_contact_that_moves_at_the_start_is_refused():
    model, _, feet = standing_go2()
    v = np.zeros(model.nv)
    v[3] = 0.25
    with pytest.raises(ValueError, match=r"v: contact 'FL_foot' sticks, but slips at t = 0 \(up to 0.25 m/s"):
        tw.simulate(model, model.standing(), v, dt=0.01, steps=1, contacts=feet)


def test_a_method_that_takes_no_contacts_says_so():
    model, _, feet = standing_go2()
    with pytest.raises(ValueError, match="method: 'variational' takes no contacts, and there are 4"):
        tw.simulate(model, model.standing(), np.zeros(18), dt=0.01, steps=1, contacts=feet, method="variational")


def test_a_single_contact_is_no_sequence_of_them():
    model, _, feet = standing_go2()
    with pytest.raises(ValueError, match="contacts: expected a sequence of contacts, got the single PointContact"):
        tw.simulate(model, model.standing(), np.zeros(18), dt=0.01, steps=1, contacts=feet[0])


def test_an_unknown_frame_is_refused():
    model, _, _ = standing_go2()
    with pytest.raises(tw.NameNotFound, match="unknown frame 'FL_fot'"):
        tw.simulate(model, model.standing(), np.zeros(18), dt=0.01, steps=1, contacts=[tw.PointContact("FL_fot", 1)])


def test_a_motion_that_the_contacts_end_is_refused_with_the_time():
    """After half a second of free fall the feet are out of reach."""
    model, _, feet = standing_go2()
    with pytest.raises(tw.SingularError, match=r"^step 1, from t = 0 s: the contacts do not come to their anchors"):
        tw.simulate(model, model.standing(), np.zeros(18), dt=0.5, steps=1, contacts=feet, method="semi-implicit")

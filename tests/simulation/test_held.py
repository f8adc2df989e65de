"""What holds beside the ground: loops, couplings and rails in the programme of each step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw

from ..contact.test_loops import FOUR_BAR, PIN, four_bar_q
from ..robots import shared

G = 9.81
GO2 = shared("go2")
FEET = [tw.PointContact(foot, 0.6) for foot in GO2.feet]


def swing(**options):
    q = four_bar_q(0.4)
    v = tw.impact(FOUR_BAR, q, [1.0, 0, 0], PIN).v
    return tw.simulate(FOUR_BAR, q, v, contacts=PIN, duration=0.2, **options)


@pytest.mark.slow
def test_a_four_bar_by_time_stepping_comes_to_that_of_runge_kutta_at_order_1_and_never_opens():
    """Against contact_forward_dynamics by rk4, which is held against Lagrange's equations elsewhere."""
    exact, errors, forces = swing(dt=0.005), [], []
    for dt in (0.01, 0.005):
        s = swing(dt=dt, method="time-stepping")
        errors.append(np.abs(s.q[-1] - exact.q[-1]).max())
        middle = [np.interp(s.t[:-1] + dt / 2, exact.t, f) for f in exact.contact_forces["coupler_end"].T]
        forces.append(np.abs(s.contact_forces["coupler_end"] - np.transpose(middle)).max())
        ends = [tw.frame_placement(FOUR_BAR, s.q, f"{name}_end").translation for name in ("coupler", "rocker")]
        assert np.abs(ends[0] - ends[1]).max() < 1e-11
        assert np.abs(np.matvec(tw.constraint_jacobian(FOUR_BAR, s.q, PIN), s.v)).max() < 1e-12
    assert errors[0] / errors[1] == pytest.approx(2, abs=0.3)
    assert forces[1] < 0.7 * forces[0] < 0.1 * np.abs(exact.contact_forces["coupler_end"]).max()


def test_a_four_bar_that_falls_on_the_ground_stops_there():
    floor = tw.Ground(0.55)
    foot = [*PIN, tw.PointContact("rocker_end", 0.3)]
    s = tw.simulate(FOUR_BAR, four_bar_q(0.4), np.zeros(3), dt=0.005, steps=160, contacts=foot, ground=floor)
    height = tw.frame_placement(FOUR_BAR, s.q, "rocker_end").translation[:, 2]
    assert height.min() == pytest.approx(0.55, abs=1e-9)
    assert s.contact_forces["rocker_end"][:, 2].min() >= 0
    assert s.contact_forces["rocker_end"][:, 2].max() > 0
    assert np.abs(height - tw.frame_placement(FOUR_BAR, s.q, "coupler_end").translation[:, 2]).max() < 1e-11
    assert (s.energy <= s.energy[0] + 1e-9).all()


@pytest.mark.slow
def test_a_joint_that_is_locked_in_one_step_is_a_joint_that_the_model_has_not():
    """From rest, where both models have the same M: one step on four feet that press, to rounding."""
    lock, q, rng = "FL_calf_joint", GO2.standing(), np.random.default_rng(3)
    small = tw.lock_joints(GO2, [lock], q)
    tau = np.r_[np.zeros(6), rng.normal(size=12) * 5]
    v = []
    for model, also, kept in ((GO2, [tw.Coupling(lock, {})], small.kept_v), (small.model, [], slice(None))):
        at = q if model is GO2 else np.delete(q, GO2.q_slice[GO2.joint_id(lock)])
        load = tau if model is GO2 else tau[small.kept_v]
        s = tw.simulate(
            model, at, np.zeros(model.nv), dt=0.01, steps=1, tau=load, contacts=[*FEET, *also], ground=tw.Ground()
        )
        v.append((s.v[-1][kept], [s.contact_forces[foot.frame] for foot in FEET]))
        if also:
            M, h = tw.crba(model, q), tw.nonlinear_effects(model, q, s.v[-1] / 2)
            pushed = sum(f[0] @ tw.constraint_jacobian(model, q, [c]) for f, c in zip(v[-1][1], FEET))
            held = (M @ s.v[-1] / 0.01 + h - tau - pushed)[model.v_slice[model.joint_id(lock)]]
            assert s.contact_forces[lock][0] == pytest.approx(
                held, rel=2e-3
            )  # h is that of the velocity in the middle, which is found in two turns
    assert np.abs(v[0][0] - v[1][0]).max() < 1e-11
    assert np.abs(np.array(v[0][1]) - v[1][1]).max() < 1e-8


@pytest.mark.slow
def test_a_go2_with_a_coupled_joint_lands_and_keeps_the_coupling():
    gears = tw.Coupling("FL_calf_joint", {"FL_thigh_joint": -2.0})
    q = GO2.standing() + 0.05 * (np.arange(19) == 2)
    hold = tw.static_equilibrium(GO2, GO2.standing()).tau
    drives = replace(GO2, damping=np.r_[np.zeros(6), np.full(12, 3.0)])

    def stand(t, now, v):
        return np.r_[np.zeros(6), hold - 80.0 * (now[7:] - GO2.standing()[7:])]

    s = tw.simulate(
        drives, q, np.zeros(18), dt=0.004, steps=200, tau=stand, contacts=[*FEET, gears], ground=tw.Ground()
    )
    thigh, calf = (GO2.q_slice[GO2.joint_id(f"FL_{part}_joint")].start for part in ("thigh", "calf"))
    off = s.q[:, calf] + 2 * s.q[:, thigh]
    assert np.abs(off - off[0]).max() < 1e-10
    assert np.abs(s.q[:, calf] - s.q[0, calf]).max() > 0.01  # it does move
    support = sum(s.contact_forces[foot.frame] for foot in FEET)
    assert support[-1, 2] == pytest.approx(G * GO2.mass, rel=0.02)
    assert min(s.contact_forces[foot.frame][:, 2].min() for foot in FEET) >= 0
    again = tw.simulate(
        drives, s.q[-1], s.v[-1], dt=0.004, steps=2, tau=stand, contacts=[*FEET, gears], ground=tw.Ground(), t0=s.t[-1]
    )
    assert len(again.t) == 3  # it goes on from where it was
    assert s.step_error(4)[0] < 1e-3


# ---------------------------------------------------------------- two robots


def test_two_robots_in_one_model_are_two_robots():
    other = shared("humanoid")
    two = tw.attach(GO2, other, None, prefix="second_")
    rng = np.random.default_rng(1)
    q, v, a = two.random_configuration(rng=rng), rng.normal(size=two.nv), rng.normal(size=two.nv)
    alone = [
        tw.rnea(m, q[x], v[y], a[y])
        for m, x, y in ((GO2, slice(19), slice(18)), (other, slice(19, None), slice(18, None)))
    ]
    assert np.abs(tw.rnea(two, q, v, a) - np.concatenate(alone)).max() < 1e-11
    assert two.feet == (*GO2.feet, *(f"second_{foot}" for foot in other.feet))
    assert two.standing().shape == (19 + other.nq,)


@pytest.mark.one_case
@pytest.mark.parametrize(("method", "share"), [("rk4", 1e-9), ("time-stepping", 2e-3)])
def test_two_robots_that_hold_each_other_keep_their_momentum_together_and_each_gets_what_the_other_loses(method, share):
    """At dt = 2 ms, by methods of order 4 and 1."""
    one, other = (replace(tw.random_tree(2, rng=k, base="floating"), gravity=np.zeros(3)) for k in (3, 4))
    two = tw.attach(one, other, None, prefix="b_")
    grip = [tw.LoopClosure(one.joint_names[-1], f"b_{other.joint_names[-1]}", welded=True)]
    rng = np.random.default_rng(2)
    q = two.random_configuration(rng=rng)
    s = tw.simulate(
        two, q, tw.impact(two, q, rng.normal(size=two.nv), grip).v, dt=0.002, steps=50, contacts=grip, method=method
    )
    total = s.momentum_about_origin
    assert np.abs(total - total[0]).max() < share * np.abs(total[0]).max()
    l = tw.centroidal_momentum(one, s.q[:, : one.nq], s.v[:, : one.nv])[:, 3:]
    force = tw.frame_placement(two, s.q, grip[0].to).rotation[:50] @ s.contact_forces[grip[0].frame][:50, 3:, None]
    gained = np.cumsum(0.002 * force[..., 0], axis=0)  # by λ at the beginning of each step, or its mean: of order 1
    assert np.abs(gained - (l[1:] - l[0])).max() < 0.02 * np.abs(l - l[0]).max()
    assert np.abs(l - l[0]).max() > 0.01

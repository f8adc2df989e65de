"""A ball that slides, rolls and sticks: closed forms, and rows against differences."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.simulation.ground import GroundPoints

from ..mechanisms import G
from ..robots import shared

R, MU, MASS = 0.1, 0.3, 2.0
BALL = tw.Builder(
    "ball",
    base="floating",
    root="ball",
    root_inertia=tw.SpatialInertia(MASS, [0, 0, 0], 0.4 * MASS * R**2 * np.eye(3)),
).build()


def touch(**options):
    return [tw.SphereContact("ball", R, MU, **options)]


@pytest.mark.parametrize("way", [0.0, 0.8])
def test_a_ball_that_is_pushed_slides_and_then_rolls_with_5_7_of_its_speed(way):
    """Coulomb's friction brakes it and turns it; it rolls from t = 2 v / (7 mu g) on. The step is of order 1.

    It ends in the axes of its beginning, from which the ball turns by ω dt: its speeds are off by that share.
    """
    t = 2 / (7 * MU * G)
    s = tw.simulate(
        BALL,
        [0, 0, R, 0, 0, 0, 1],
        [0, 0, 0, np.cos(way), np.sin(way), 0],
        dt=t / 40,
        steps=60,
        contacts=touch(),
        ground=tw.Ground(),
    )
    rotation = tw.frame_placement(BALL, s.q, "ball").rotation
    v, w = (np.matvec(rotation, x) for x in (s.v[:, 3:], s.v[:, :3]))
    along = np.array([np.cos(way), np.sin(way), 0.0])
    speed = np.where(s.t <= t, 1 - MU * G * s.t, 5 / 7)
    off = 5 / 7 / R * t / 40
    assert np.abs(v - speed[:, None] * along).max() < 0.75 * off
    assert np.abs(w @ [-along[1], along[0], 0] * R - np.where(s.t <= t, 2.5 * MU * G * s.t, 5 / 7)).max() < 0.75 * off
    assert np.abs(s.q[:, 2] - R).max() < 1e-9
    force = s.contact_forces["ball"]
    assert np.abs(force[:38] - MASS * G * np.array([*(-MU * along[:2]), 1.0])).max() < 0.75 * off * MASS * G
    assert np.abs(force[42:, :2]).max() < 0.05 * MU * MASS * G  # nothing brakes a ball that rolls
    assert s.energy[-1] - s.energy[0] == pytest.approx(-MASS / 7, rel=3 * off)  # 2/7 of its kinetic energy


@pytest.mark.parametrize(("slope", "rolls"), [(0.3, True), (0.9, False)])
def test_on_a_slope_it_rolls_up_to_the_tangent_of_7_2_mu_and_slides_beyond(slope, rolls):
    n = (np.sin(slope), 0.0, np.cos(slope))
    assert rolls == (np.tan(slope) < 3.5 * MU)
    ground = tw.Ground(normal=n)
    s = tw.simulate(
        BALL, [*(R * np.array(n)), 0, 0, 0, 1], np.zeros(6), dt=0.002, steps=50, contacts=touch(normal=n), ground=ground
    )
    fast = np.sqrt((s.v[-1, 3:] ** 2).sum()) / s.t[-1]
    expected = 5 / 7 * G * np.sin(slope) if rolls else G * (np.sin(slope) - MU * np.cos(slope))
    assert fast == pytest.approx(expected, rel=expected / R * 0.1 * 0.002)  # ω dt
    same = tw.simulate(BALL, s.q[0], s.v[0], dt=0.002, steps=50, contacts=touch(), ground=ground)  # the ground's counts
    assert np.abs(same.v - s.v).max() < 1e-12
    with pytest.raises(ValueError, match=r"contact 'ball': its normal .* is not that of the ground"):
        tw.simulate(BALL, s.q[0], s.v[0], dt=0.01, steps=1, contacts=touch(normal=(1, 0, 0)), ground=ground)


def test_a_ball_that_sticks_rolls_by_runge_kutta_straight_on_whatever_its_spin():
    """A ball that spins about the normal and rolls goes straight: m v and k_G about the point are constant."""
    v0 = tw.impact(BALL, [0, 0, R, 0, 0, 0, 1], [0, 5.0, 3.0, 0, 0, 0], touch()).v
    s = tw.simulate(BALL, [0, 0, R, 0, 0, 0, 1], v0, dt=0.01, steps=50, contacts=touch())
    v = np.matvec(tw.frame_placement(BALL, s.q, "ball").rotation, s.v[:, 3:])
    assert np.abs(v - v[0]).max() < 1e-8  # by a step of order 4
    assert np.abs(v[0]).max() > 0.1
    assert np.abs(s.q[:, 2] - R).max() < 1e-11
    assert np.abs(s.q[-1, :2] - 0.5 * v[0, :2]).max() < 1e-8
    assert np.ptp(s.energy) < 1e-9


def test_rows_and_bias_of_a_ball_on_a_robot_are_differences():
    model, rng, h = tw.random_tree(4, rng=5, base="floating"), np.random.default_rng(0), 1e-5
    ball = [tw.SphereContact(model.joint_names[-1], 0.07, 0.5, normal=[0.3, -0.2, 1.0])]
    q, v = model.random_configuration(rng=rng), rng.normal(size=model.nv)
    centre, n = tw.frame_jacobian(model, q, ball[0].frame, "local_world_aligned"), np.array(ball[0].normal)
    lowest = centre[3:] @ v + np.cross(centre[:3] @ v, -0.07 * n)
    assert np.abs(tw.constraint_jacobian(model, q, ball) @ v - lowest).max() < 1e-13
    ahead, back = (tw.constraint_jacobian(model, model.integrate(q, s * h * v), ball) @ v for s in (1, -1))
    assert np.abs((ahead - back) / (2 * h) - tw.constraint_bias(model, q, v, ball)).max() < 1e-7  # h², and rounding / h


@pytest.mark.parametrize("bad", [{"radius": 0.0}, {"radius": -1.0}, {"normal": [0, 0, 0]}, {"mu": -0.1}])
def test_what_is_no_ball_is_refused(bad):
    with pytest.raises(ValueError, match=f"contact 'f': {next(iter(bad))}"):
        tw.SphereContact(**({"frame": "f", "radius": 0.1, "mu": 0.5} | bad))


def test_the_ground_is_computed_by_a_program_for_points_soles_and_balls():
    """The textbook would be twenty times slower, and nothing else would tell."""
    for model, contact in (
        (tw.load("go2"), tw.PointContact("FL_foot", 0.6)),
        (tw.load("humanoid"), tw.SurfaceContact("left_sole", (0.07, 0.02), 0.6)),
        (BALL, touch()[0]),
    ):
        GroundPoints(model, (contact,), tw.Ground()).terms(model.standing() if model.feet else model.neutral())
        made = [program for key, program in model._programs.items() if key[0] == "middle of a step"]
        assert {type(program).__name__ for program in made} == {"Program"}


@pytest.mark.one_case
@pytest.mark.parametrize("share", [0.98, 1.02])
def test_a_stiff_humanoid_that_is_pushed_tips_over_its_toes_beyond_the_energy_that_lifts_its_centre_over_them(share):
    h = shared("humanoid")
    statue = tw.lock_joints(h, h.joint_names[2:], h.standing()).model
    q, soles = h.standing()[:7], [tw.SurfaceContact(f"{side}_sole", (0.076, 0.0275), 0.9) for side in ("left", "right")]
    toes = tw.frame_placement(statue, q, "left_sole").act([0.076, 0, 0])
    ahead, _, up = tw.center_of_mass(statue, q) - toes
    R = tw.frame_placement(statue, q, statue.joint_names[1]).rotation
    turn = np.array([0, 1.0, 0])
    push = np.concatenate([R.T @ turn, R.T @ np.cross(turn, q[:3] - toes)])  # about the toes, which stay
    most = np.sqrt(statue.mass * G * (np.hypot(ahead, up) - up) / tw.kinetic_energy(statue, q, push))

    def over(t, q, v):
        return bool(tw.center_of_mass(statue, q)[0] > toes[0])

    s = tw.simulate(
        statue, q, share * most * push, dt=0.004, duration=1.6, contacts=soles, ground=tw.Ground(), stop=over
    )
    assert (s.t[-1] < 1.5) == (share > 1)
    assert most * up < -ahead * np.sqrt(G / up)  # a capture point, which has no inertia to turn, allows more

"""Nothing pushes a body that spins, and the ground touches what it touches: closed forms of steps with a ground."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.simulation.straight import go_straight, in_turned_axes, turning

from ..mechanisms import G
from ..robots import shared
from .test_ground import BOX, HALF, body, corners


def ball(r, gravity=(0, 0, -G)):
    inertia = tw.SpatialInertia.from_sphere(1.0, r)
    return tw.Builder("s", base="floating", root="s", root_inertia=inertia, gravity=gravity).build()


def world(s, k=-1):
    """Return the base's velocity in the axes of the world."""
    R = tw.frame_placement(s.model, s.q[k], s.model.joint_names[1]).rotation
    return R @ s.v[k, 3:6]


# ---------------------------------------------------------------- steps in axes that do not turn


@pytest.mark.one_case
@pytest.mark.parametrize("spin", [[0, 0, 35.0], [35.0, 0, 0], [20.0, -30.0, 10.0]])
def test_a_free_body_keeps_its_speed_and_goes_straight_on(spin):
    model = ball(0.1, gravity=(0, 0, 0))
    far = tw.Ground(height=-1.0)
    touch = [tw.SphereContact("s", 0.1, 0.5)]
    s = tw.simulate(model, model.neutral(), [*spin, 3.5, 0, 0], dt=4e-3, duration=2.0, contacts=touch, ground=far)
    assert s.q[-1, :3] == pytest.approx([7.0, 0, 0], abs=1e-11)
    assert world(s) == pytest.approx([3.5, 0, 0], abs=1e-11)


@pytest.mark.slow
def test_a_puck_and_a_body_that_floats_in_a_tree_go_straight_on():
    puck = tw.Builder("puck", gravity=[0, 0, 0])
    disc = tw.SpatialInertia(1.0, [0, 0, 0], 0.01 * np.eye(3))
    puck.link("puck", parent="base_link", joint=tw.Planar(), inertia=disc)
    s = tw.simulate(puck.build(), [0, 0, 1, 0], [1.0, 0, 20.0], dt=0.005, duration=2.0, method="time-stepping")
    assert s.q[-1, :2] == pytest.approx([2.0, 0], abs=1e-12)
    pair = tw.attach(BOX, BOX, None, prefix="b_", placement=tw.SE3(np.eye(3), [1.0, 0, 0]))
    v = np.zeros(12)
    v[[8, 9]] = 15.0, 1.0
    away = tw.simulate(pair, pair.neutral(), v, dt=0.005, steps=100, method="time-stepping")
    assert away.q[-1, 7] - away.q[0, 7] == pytest.approx(0.5, abs=1e-12)


def test_a_step_that_goes_straight_shifts_then_turns_and_the_velocity_turns_back():
    model, rng = shared("go2"), np.random.default_rng(0)
    q, u, v = model.random_configuration(rng=rng), 0.3 * rng.normal(size=18), rng.normal(size=18)
    there, base = go_straight(model, q, u), model.joint_names[1]
    before, after = (tw.frame_placement(model, x, base) for x in (q, there))
    assert np.abs(after.translation - before.act(u[3:6])).max() < 1e-15
    assert np.abs(after.rotation - before.rotation @ tw.exp3(u[:3])).max() < 1e-15
    assert np.abs(there[7:] - q[7:] - u[6:]).max() < 1e-15
    turned = in_turned_axes(model, v, u)
    assert np.abs(after.rotation @ turned[3:6] - before.rotation @ v[3:6]).max() < 1e-15
    assert (np.delete(turned, [3, 4, 5]) == np.delete(v, [3, 4, 5])).all()
    assert turning(model, v)[3:6] == pytest.approx(np.cross(v[:3], v[3:6]), abs=1e-15)


# ---------------------------------------------------------------- rolling and spinning


@pytest.mark.slow
@pytest.mark.one_case
@pytest.mark.parametrize(
    ("r", "mu", "speed"), [(0.1, 0.0, 0.0), (0.02, 0.5, 0.1), (0.0025, 0.5, 0.001), (0.1, 1e6, 3.5)]
)
def test_a_ball_that_spins_on_ice_stays_and_one_that_rolls_keeps_its_speed(r, mu, speed):
    model = ball(r)
    spin = 40.0 if mu == 0 else speed / r
    touch = [tw.SphereContact("s", r, mu)]
    q, v = [0, 0, r, 0, 0, 0, 1], [0, spin, 0, speed, 0, 0]
    s = tw.simulate(model, q, v, dt=2e-3, steps=400, contacts=touch, ground=tw.Ground())
    assert s.q[-1, :3] == pytest.approx([0.8 * speed, 0, r], abs=1e-12)
    assert world(s) == pytest.approx([speed, 0, 0], abs=1e-12)
    assert s.contact_forces["s"][-1] == pytest.approx([0, 0, G], abs=1e-9)


def test_a_ball_rolls_down_30_degrees_with_5_7_of_g_sin():
    """Its speed to rounding; its way to order 1, as q goes along the velocity at the end of each step."""
    model, n = ball(0.05), np.array([0.5, 0, 0.75**0.5])
    for dt in (0.004, 0.002):
        touch = [tw.SphereContact("s", 0.05, 0.8)]
        q, slope = [*(0.05 * n), 0, 0, 0, 1], tw.Ground(normal=n)
        s = tw.simulate(model, q, np.zeros(6), dt=dt, duration=1.0, contacts=touch, ground=slope)
        a = 5 / 7 * G / 2
        assert np.linalg.norm(world(s)) == pytest.approx(a, rel=1e-12)
        assert np.linalg.norm(s.q[-1, :3] - s.q[0, :3]) == pytest.approx(a / 2 * (1 + dt), rel=1e-12)
        assert np.diff(s.energy).max() < 1e-12


@pytest.mark.slow
def test_a_box_that_is_thrown_with_spin_gains_no_energy():
    for dt in (4e-3, 2e-3):
        q, v = [0, 0, 0.3, 0, 0, 0, 1], [3.0, 8.0, 5.0, 1.0, 0, 2.0]
        s = tw.simulate(BOX, q, v, dt=dt, duration=0.8, contacts=corners(0.5), ground=tw.Ground())
        assert (s.energy <= s.energy[0]).all()
        assert s.q[:, 2].min() < HALF[0]  # it has landed
        assert not [remark for remark in s.remarks if remark.kind == "coulomb"]


def test_a_top_on_ice_precesses_about_its_centre_which_stays():
    """Steady, at the angle θ, where C n Ω − A Ω² cos θ = m g l; the error is of order 1."""
    A, C, l, lean, n = 0.002, 0.003, 0.05, 0.4, 60.0
    top = body("top", tw.SpatialInertia(1.0, [0, 0, 0], np.diag([A, A, C])), [[0, 0, -l]])
    rate = (C * n - np.sqrt((C * n) ** 2 - 4 * A * np.cos(lean) * G * l)) / (2 * A * np.cos(lean))
    q = [0, 0, l * np.cos(lean), 0, np.sin(lean / 2), 0, np.cos(lean / 2)]
    off = []
    for dt in (0.002, 0.001):
        v = [-rate * np.sin(lean), 0, n, 0, 0, 0]
        s = tw.simulate(top, q, v, dt=dt, duration=0.4, contacts=[tw.PointContact("p0", 0.0)], ground=tw.Ground())
        axis = tw.frame_placement(top, s.q[-1], "top").rotation[:, 2]
        angle = 0.4 * rate
        off.append(np.abs(axis - [np.sin(lean) * np.cos(angle), np.sin(lean) * np.sin(angle), np.cos(lean)]).max())
        assert np.abs(s.q[:, :2]).max() < 1e-12
    assert off[0] < 0.03
    assert np.log2(off[0] / off[1]) > 0.9


# ---------------------------------------------------------------- what the ground touches


ROD = body("rod", tw.SpatialInertia(1.0, [0, 0, 0], np.diag([0.002, 1 / 12, 1 / 12])), [[-0.5, 0, 0], [0.5, 0, 0]])


@pytest.mark.parametrize("mu", [0.0, 3.0, 1e6])
def test_what_flies_is_not_touched_however_large_the_friction(mu):
    """One end 1 mm above the ground, both rising: a large μ knows another answer, of kilonewtons (Painlevé)."""
    lean = 0.567
    q = [0, 0, 0.5 * np.sin(lean) + 0.001, 0, np.sin(lean / 2), 0, np.cos(lean / 2)]
    v = [0, 1.825, 0, 7.882, 0, 6.696]
    touch = [tw.PointContact(f"p{k}", mu) for k in range(2)]
    s = tw.simulate(ROD, q, v, dt=0.001, steps=5, contacts=touch, ground=tw.Ground())
    assert all((force == 0).all() for force in s.contact_forces.values())
    assert s.energy[0] - s.energy[-1] == pytest.approx(0.5 * G**2 * 0.001**2 * 5, rel=0.01)


@pytest.mark.parametrize("mu", [0.3, 20.0, 1e6])
def test_a_box_on_one_corner_is_pushed_there_and_nowhere_else(mu):
    every = [HALF * [x, y, z] for x in (1, -1) for y in (1, -1) for z in (1, -1)]
    box = body("box", tw.SpatialInertia.from_box(2.0, 2 * HALF), every)
    touch = [tw.PointContact(f"p{k}", mu) for k in range(8)]
    rng = np.random.default_rng(1)
    for _ in range(5):
        q = box.integrate(box.neutral(), np.r_[rng.normal(size=3), np.zeros(3)])
        height = np.array([tw.frame_placement(box, q, f"p{k}").translation[2] for k in range(8)])
        q[2] -= height.min()
        s = tw.simulate(box, q, rng.normal(size=6), dt=0.002, steps=1, contacts=touch, ground=tw.Ground())
        pushed = [k for k in range(8) if s.contact_forces[f"p{k}"].any()]
        assert pushed in ([], [int(height.argmin())])
        assert np.max(s.system.stepping.missed) < 1e-7


@pytest.mark.slow
def test_neither_friction_nor_restitution_nor_the_ground_makes_another_program():
    model, q, made = tw.load("go2"), tw.load("go2").standing(), []
    q[2] += 0.1
    for k, n in enumerate(([0, 0, 1], [0.1, 0, 1])):
        feet = [tw.PointContact(foot, 0.1 + k, restitution=0.3 * k) for foot in model.feet]
        ground = tw.Ground(normal=n, height=-0.1 * k, restitution=0.1 * k)
        tw.simulate(model, q, np.zeros(18), dt=0.002, steps=1, contacts=feet, ground=ground)
        made.append({*model._programs})
    assert made[0] == made[1]
    assert any(key[0] == "middle of a step" for key in made[0])


def test_a_top_at_300_rad_per_s_has_order_1_on_a_point_and_order_4_on_a_joint():
    """What docs/simulation.md says, against a step of 1/16 ms: how far its centre is from where it should be, mm."""
    inertia, turn = tw.SpatialInertia(0.3, [0, 0, 0.05], np.diag([2e-4, 2e-4, 1e-4])), [np.sin(0.2), 0, 0, np.cos(0.2)]
    hung, flies = tw.Builder("top"), body("top", inertia, [])
    hung.link("top", parent="base_link", joint=tw.Spherical(), inertia=inertia)
    hung = hung.build()

    def centre(model, q, v, dt, **options):
        s = tw.simulate(model, q, v, dt=dt, duration=0.2, **options)
        return 1e3 * tw.frame_placement(model, s.q[-1], "top").act([0, 0, 0.05])

    right = centre(hung, turn, [0, 0, 300.0], 0.2 / 3200)
    touches = {"contacts": [tw.PointContact("top", 100.0)], "ground": tw.Ground()}
    start = [0, 0, 0, *turn], [0, 0, 300.0, 0, 0, 0]
    off = [np.linalg.norm(centre(flies, *start, dt, **touches) - right) for dt in (1e-3, 2.5e-4)]
    assert off == pytest.approx([12, 1.8], rel=0.05)
    assert np.linalg.norm(centre(hung, turn, [0, 0, 300.0], 1e-3) - right) == pytest.approx(0.034, rel=0.05)

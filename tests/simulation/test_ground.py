"""Contact in time: closed forms, what no contact may do, other engines, and what is refused."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.simulation import cones, coulomb
from twistwrench.spatial import rotation_to_quaternion

from ..robots import shared

G = 9.81
HALF = np.array([0.1, 0.08, 0.05])  # m: half the sides of the box


def body(name, inertia, points):
    """A flying body with frames at these points."""
    builder = tw.Builder(name, base="floating", root=name, root_inertia=inertia)
    for k, point in enumerate(points):
        T = np.eye(4)
        T[:3, 3] = point
        builder.link(f"p{k}", parent=name, placement=tw.SE3.from_matrix(T))
    return builder.build()


BOX = body("box", tw.SpatialInertia.from_box(2.0, 2 * HALF), [HALF * [x, y, -1] for x in (1, -1) for y in (1, -1)])
BALL = body("ball", tw.SpatialInertia(1.0, np.zeros(3), 0.01 * np.eye(3)), [np.zeros(3)])
GO2 = shared("go2")


def corners(mu):
    return [tw.PointContact(f"p{k}", mu) for k in range(4)]


def slide(mu, v, *, ground=None, q=None, dt=0.005, steps=100, contacts=None, **options):
    """A box that begins flat on a ground."""
    ground = ground or tw.Ground()
    turn = rotation_to_quaternion(ground.axes.T)
    q = np.r_[HALF[2] * np.array(ground.normal), turn] if q is None else q
    return tw.simulate(BOX, q, v, dt=dt, steps=steps, contacts=contacts or corners(mu), ground=ground, **options)


def tilted(angle):
    """A plane that falls off in the direction of x."""
    return tw.Ground(normal=[np.sin(angle), 0.0, np.cos(angle)])


def downhill(ground):
    down = -np.array([0, 0, 1.0]) + ground.normal[2] * np.array(ground.normal)
    return down / np.sqrt(down @ down)


# ---------------------------------------------------------------- closed forms


@pytest.mark.one_case
@pytest.mark.parametrize("way", [0.0, 0.7])
def test_a_box_that_slides_stops_after_v2_over_2_mu_g_in_any_direction(way):
    """Of order 1 in dt: q goes along the velocity at the end of each step, which is short by v dt / 2."""
    exact, errors = 1 / (2 * 0.4 * G), []
    for dt in (0.01, 0.005):
        s = slide(0.4, np.r_[0, 0, 0, np.cos(way), np.sin(way), 0], dt=dt, steps=round(0.4 / dt))
        assert s.q[-1, :2] / exact == pytest.approx([np.cos(way), np.sin(way)], abs=dt * 5)
        errors.append(exact - np.sqrt(s.q[-1, :2] @ s.q[-1, :2]))
        assert np.abs(s.v[-1]).max() < 1e-12
        assert np.abs(s.q[:, 2] - HALF[2]).max() < 1e-6  # and Anitescu's lift is gone
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize("share", [0.99, 1.01])
def test_on_a_slope_a_box_sticks_up_to_the_angle_of_friction_and_slides_beyond(share):
    angle = np.arctan(0.5 * share)
    ground = tilted(angle)
    s = slide(0.5, np.zeros(6), ground=ground, steps=40)
    along = s.v[:, 3:] @ (ground.axes @ downhill(ground))  # the box lies in the axes of the ground
    if share < 1:
        assert np.abs(s.v).max() < 1e-10
    else:
        assert along[-1] == pytest.approx(G * (np.sin(angle) - 0.5 * np.cos(angle)) * s.t[-1], abs=1e-4 * G * s.t[-1])


@pytest.mark.parametrize("share", [0.98, 1.02])
def test_on_a_slope_with_much_friction_a_box_topples_where_its_weight_passes_its_edge(share):
    edge = HALF[0] if abs(downhill(tilted(0.3)) @ tilted(0.3).axes[0]) > 0.5 else HALF[1]
    ground = tilted(np.arctan(edge / HALF[2]) * share)
    s = slide(10.0, np.zeros(6), ground=ground, steps=40)
    assert (np.abs(s.v[-1, :3]).max() > 0.01) == (share > 1)


@pytest.mark.parametrize("share", [0.999, 1.001])
@pytest.mark.parametrize("way", [0.0, 0.5])
def test_the_largest_push_before_a_box_slips_is_mu_m_g(share, way):
    push = share * 0.4 * 2.0 * G * np.array([np.cos(way), np.sin(way)])
    s = slide(0.4, np.zeros(6), steps=10, tau=np.r_[0, 0, 0, push, 0])
    speed = np.sqrt(s.v[-1, 3:5] @ s.v[-1, 3:5])
    assert speed == pytest.approx(max(0.0, share - 1) * 0.4 * G * s.t[-1], abs=4e-5 * G * s.t[-1])
    total = sum(s.contact_forces.values())
    expected = [*-min(1, 1 / share) * push, 2.0 * G]
    assert total[-1] == pytest.approx(expected, abs=1e-3)  # the box turns by as little as the solver leaves open


@pytest.mark.one_case
@pytest.mark.parametrize("own", [False, True])
def test_a_ball_bounces_to_e2_of_its_height_and_with_e_1_for_ever(own):
    """The step that hits ends on the ground, with e times the speed at which the fall ends there."""
    q = np.r_[0, 0, 0.5, 0, 0, 0, 1]
    for e, dt in ((0.8, 2e-3), (1.0, 4e-3)):
        ground = tw.Ground(restitution=0.3 if own else e)
        touch = [tw.PointContact("p0", 0.5, restitution=e if own else None)]
        s = tw.simulate(BALL, q, np.zeros(6), dt=dt, duration=1.2, contacts=touch, ground=ground)
        z = s.q[:, 2]
        tops = z[1:-1][(z[1:-1] > z[:-2]) & (z[1:-1] >= z[2:])]
        assert tops[:2] == pytest.approx([0.5 * e**2, 0.5 * e**4][: len(tops[:2])], rel=0.05)
        assert (np.diff(s.energy) < 1e-12).all()
        assert z.min() > -1e-9
        bounces = (s.contact_forces["p0"][:, 2] > 0).sum()
        assert (np.abs(z[1:][s.contact_forces["p0"][:, 2] > 0]) < 1e-9).all()
        falls = len(s.t) - 1 - bounces
        if e == 1:  # what the semi-implicit step loses in free fall, and nothing else
            assert s.energy[0] - s.energy[-1] == pytest.approx(0.5 * G**2 * dt**2 * falls, rel=1e-6)


def test_each_contact_has_its_own_restitution_and_what_already_lies_has_none():
    """A box of which two corners are hard and two soft leaves the ground on the hard side; one that lies stays."""
    hard = [tw.PointContact(f"p{k}", 0.0, restitution=0.9 * (k < 2)) for k in range(4)]
    lands = slide(0.0, np.r_[np.zeros(5), -1.0], q=np.r_[0, 0, HALF[2], 0, 0, 0, 1], dt=1e-6, steps=1, contacts=hard)
    up = tw.contact_jacobian(BOX, lands.q[-1], [f"p{k}" for k in range(4)]) @ lands.v[-1]
    assert up[2::3] == pytest.approx([0.9, 0.9, 0, 0], abs=1e-5)
    lies = slide(
        0.3, np.zeros(6), contacts=[tw.PointContact(f"p{k}", 0.3, restitution=1.0) for k in range(4)], steps=20
    )
    assert np.abs(lies.v).max() < 1e-12
    with pytest.raises(ValueError, match=r"contact 'p0': restitution: expected a number from 0 to 1, got 1\.5"):
        tw.PointContact("p0", 0.3, restitution=1.5)


def test_a_block_on_a_belt_is_brought_to_its_speed_and_then_goes_with_it_whatever_its_friction():
    along, size = np.array([0.5, 0.2]), np.hypot(0.5, 0.2)
    for mu, v in ((0.3, np.zeros(2)), (1e6, along)):
        belt = [tw.PointContact(f"p{k}", mu, velocity=(*along, 0.0)) for k in range(4)]
        s = slide(mu, np.r_[0, 0, 0, v, 0], contacts=belt, dt=0.002, steps=100)
        speed = np.minimum(np.sqrt(v @ v) + mu * G * s.t, size)
        assert np.abs(s.v[:, 3:5] - speed[:, None] * along / size).max() < 1e-9
    with pytest.raises(ValueError, match="contact 'p0': velocity: expected one along the ground"):
        slide(0.3, np.zeros(6), contacts=[tw.PointContact("p0", 0.3, velocity=(0, 0, 0.1))])


def test_a_ball_that_bounces_with_spin_slides_by_coulombs_law():
    """It lands at 45 degrees: the speed along the ground falls by μ (1 + e) times the speed of the impact."""
    v = np.r_[0, 0, 0, 2.0, 0, -1.0]
    hit = tw.simulate(
        *(BALL, np.r_[0, 0, 1e-9, 0, 0, 0, 1], v),
        dt=1e-6,
        steps=1,
        contacts=[tw.PointContact("p0", 0.3)],
        ground=tw.Ground(restitution=0.5),
    )
    assert hit.v[-1, 3:] == pytest.approx([2.0 - 0.3 * 1.5 * 1.0, 0, 0.5], abs=1e-4)


def test_a_wheel_of_spokes_loses_what_mcgeer_says_at_each_of_them():
    """A rimless wheel that lands on its next spoke: ω is multiplied by (I + m r² cos 2α) / (I + m r²)."""
    inertia, r, alpha = 0.02, 0.3, np.pi / 8
    feet = [r * np.array([np.sin(a), y, -np.cos(a)]) for y in (0.1, -0.1) for a in (alpha, -alpha)]
    wheel = body("wheel", tw.SpatialInertia(1.0, np.zeros(3), inertia * np.eye(3)), feet)
    pivot = feet[1] * [1, 0, 1]
    v = np.r_[0, 2.0, 0, np.cross([0, 2.0, 0], -pivot)]  # about the spoke behind
    s = tw.simulate(
        *(wheel, np.r_[0, 0, r * np.cos(alpha), 0, 0, 0, 1], v),
        dt=1e-7,
        steps=1,
        contacts=[tw.PointContact(f"p{k}", 5.0) for k in range(4)],
        ground=tw.Ground(),
    )
    m_r2 = 1.0 * r**2
    assert s.v[-1, 1] / 2.0 == pytest.approx((inertia + m_r2 * np.cos(2 * alpha)) / (inertia + m_r2), rel=1e-5)


# ---------------------------------------------------------------- what no contact may do


def dropped(height=0.01, **options):
    """A Go2 that falls on its feet, askew, and folds up."""
    q, v = GO2.standing(), np.zeros(18)
    q[2] += height
    v[[0, 1, 3]] = 1.0, -0.5, 0.7
    given = {"dt": 0.002, "steps": 60, "ground": tw.Ground(), "contacts": feet(0.6)} | options
    return tw.simulate(GO2, GO2.normalize(q), v, **given)


def feet(mu):
    return [tw.PointContact(foot, mu) for foot in GO2.feet]


def test_no_foot_pulls_leaves_its_cone_or_sinks_and_no_energy_comes_of_it():
    s = dropped()
    force = np.stack([*s.contact_forces.values()])
    assert force[..., 2].min() >= 0
    assert (np.sqrt((force[..., :2] ** 2).sum(axis=-1)) <= 0.6 * force[..., 2] * (1 + 1e-12)).all()
    assert (force[:, -1, 2] > 0).any()
    height = np.stack([tw.frame_placement(GO2, s.q, foot).translation[..., 2] for foot in GO2.feet])
    assert height.min() > -1e-9
    assert (height[:, -1] < 1e-3).any()
    assert np.diff(s.energy).max() < 1e-4
    assert (s.q[:, 7:] > GO2.lower[7:] - 1e-9).all()
    assert (s.q[:, 7:] < GO2.upper[7:] + 1e-9).all()
    assert max(map(np.max, s.system.stepping.missed)) < 1e-4


def test_what_begins_a_little_below_the_ground_is_brought_back_without_being_thrown():
    q = BOX.neutral()
    q[2] = HALF[2] - 5e-4
    s = slide(0.5, np.zeros(6), q=q, steps=2)
    assert s.q[1:, 2] == pytest.approx(HALF[2], abs=1e-9)
    assert np.abs(s.v).max() < 1e-9


def test_where_newtons_method_leads_nowhere_sweeps_over_the_points_find_the_forces(monkeypatch):
    expected = dropped(steps=26)
    monkeypatch.setattr(coulomb, "newton", lambda law, x, still: (x, law.missed(x, law.moves(x))))
    monkeypatch.setattr(coulomb, "ROUNDS", 200)
    s = dropped(steps=26)
    assert max(force[:, 2].max() for force in expected.contact_forces.values()) > 10  # N: a foot has landed
    assert np.abs(s.v[-1] - expected.v[-1]).max() < 1e-4
    assert min(force[:, 2].min() for force in s.contact_forces.values()) >= 0


def test_where_coulombs_law_is_missed_it_is_said_and_where_nothing_keeps_a_point_up_it_is_an_error(monkeypatch):
    right = coulomb.solve

    def smooth(law, guesses, size):
        """Return what is right for points without friction."""
        impulse, _ = right(coulomb.CoulombLaw(law.W, law.u0, 0 * law.mu), guesses, size)
        return impulse, law.missed(impulse, law.moves(impulse))

    monkeypatch.setattr(cones, "solve", smooth)
    s = slide(0.4, np.r_[0, 0, 0, 1.0, 0, 0], steps=2)
    said = [remark for remark in s.remarks if remark.kind == "coulomb"]
    assert {remark.name for remark in said} == {f"p{k}" for k in range(4)}
    assert all(remark.value > remark.limit for remark in said)
    monkeypatch.setattr(cones, "solve", lambda law, guesses, size: (0 * law.u0, np.abs(law.u0)))
    with pytest.raises(tw.DivergenceError, match=r"nothing keeps 'p[0-3]' above the ground"):
        slide(0.4, np.r_[0, 0, 0, 1.0, 0, 0], steps=2)


def test_a_batch_on_the_ground_is_its_items():
    q = np.stack([GO2.standing(), GO2.standing()])
    q[:, 2] += 0.01, 0.0
    rest = np.zeros(18)
    both = tw.simulate(GO2, q, rest, dt=0.002, steps=15, contacts=feet(0.6), ground=tw.Ground())
    for k in range(2):
        one = tw.simulate(GO2, q[k], rest, dt=0.002, steps=15, contacts=feet(0.6), ground=tw.Ground())
        assert np.abs(both.v[:, k] - one.v).max() < 1e-9
        for foot in GO2.feet:
            assert both.contact_forces[foot][:, k] == pytest.approx(one.contact_forces[foot], abs=1e-6)


def test_a_sole_stands_on_its_corners_and_rolls_over_its_edge():
    """A board on one sole: what its corners do adds up to one wrench, and beyond its edge it turns over."""
    board = body("board", tw.SpatialInertia.from_box(2.0, 2 * HALF), [[0, 0, -HALF[2]]])
    q = np.r_[0, 0, HALF[2], 0, 0, 0, 1]
    sole = [tw.SurfaceContact("p0", (HALF[0], HALF[1]), 0.5)]
    for arm, stands in ((0.9, True), (1.1, False)):
        moment = arm * HALF[0] * 2.0 * G  # about y, against the weight on the edge
        push = np.r_[0, moment, 0, 0, 0, 0]
        s = tw.simulate(board, q, np.zeros(6), dt=0.002, steps=20, tau=push, contacts=sole, ground=tw.Ground())
        assert (np.abs(s.v[-1]).max() < 1e-10) == stands
        if stands:
            assert s.contact_forces["p0"][-1] == pytest.approx([0, -moment, 0, 0, 0, 2.0 * G], abs=1e-6)


# ---------------------------------------------------------------- what a motion is worth


@pytest.mark.slow
def test_a_go2_that_hangs_on_its_own_feet_says_so():
    """Passive on feet that stick: they would slip, then pull; the legs leave their ranges and the trunk sinks."""
    q, rest = GO2.standing(), np.zeros(18)
    s = tw.simulate(GO2, q, rest, dt=0.02, steps=18, contacts=feet(0.6), method="semi-implicit")
    said = {remark.kind: remark for remark in s.remarks[::-1]}
    assert {"slip", "pull", "range", "sunk"} <= said.keys()
    assert [remark.t for remark in s.remarks] == sorted(remark.t for remark in s.remarks)
    pull = said["pull"]
    k = round(pull.t / 0.02)
    assert s.contact_forces[pull.name][k, 2] == -pull.value < 0
    assert all((force[:k, 2] > -1e-6).all() for force in s.contact_forces.values())
    text = str(s)
    assert f"from t = {pull.t:.4g} s contact '{pull.name}' pulls, by {pull.value:.4g} N" in text
    assert "below all contacts" in text


def test_a_robot_that_does_what_it_can_has_no_remarks():
    q = GO2.standing()
    hold = tw.static_equilibrium(GO2, q).tau
    for ground in (None, tw.Ground()):
        tau = np.r_[np.zeros(6), hold]
        s = tw.simulate(GO2, q, np.zeros(18), dt=0.002, steps=5, tau=tau, contacts=feet(0.6), ground=ground)
        assert s.remarks == ()


def test_a_motor_a_speed_and_a_sole_that_are_asked_too_much_are_named_with_the_limit():
    model = rotor(effort_limit=1.0, velocity_limit=2.0, lower=-0.1, upper=0.1)
    s = tw.simulate(model, [0.0], [1.9], dt=0.01, steps=10, tau=[1.5])
    assert [(r.kind, r.t, r.limit) for r in s.remarks] == [
        ("effort", 0.0, 1.0),
        ("speed", pytest.approx(0.01), 2.0),
        ("range", pytest.approx(0.05), 0.1),
    ]
    board = body("board", tw.SpatialInertia.from_box(2.0, 2 * HALF), [[0, 0, -HALF[2]]])
    for arm, kinds in ((0.9, []), (1.1, ["tip"])):
        sole, push = [tw.SurfaceContact("p0", (HALF[0], HALF[1]), 0.5)], np.r_[0, arm * HALF[0] * 2.0 * G, 0, 0, 0, 0]
        tipped = tw.simulate(board, [0, 0, HALF[2], 0, 0, 0, 1], np.zeros(6), dt=0.01, steps=1, tau=push, contacts=sole)
        assert [r.kind for r in tipped.remarks] == kinds


def test_a_foot_that_leaves_the_ground_and_one_that_slides_are_noted():
    s = slide(0.4, np.r_[0, 0, 0, 1.0, 0, 0], steps=3)
    assert {(r.kind, r.t) for r in s.remarks} == {("slide", 0.0)}
    assert s.remarks[0].value == pytest.approx(1.0 - 0.4 * G * 0.005, rel=1e-3)
    thrown = slide(0.4, np.zeros(6), steps=10, tau=lambda t, q, v: np.r_[0, 0, 0, 0, 0, 40.0 * (t > 0.011)])
    assert [(r.kind, r.t) for r in thrown.remarks] == [("lift-off", pytest.approx(0.015))] * 4


def test_the_work_of_the_joint_forces_is_what_the_energy_gains():
    model = shared("double_pendulum")
    clock = {"dt": 0.002, "steps": 200, "dt_control": 0.01}
    s = tw.simulate(model, [0.3, 0.2], [0.0, 0.0], tau=lambda t, q, v: [0.5, -0.2 * np.sin(9 * t)], **clock)
    assert s.work.shape == s.t.shape
    assert np.abs(s.energy - s.energy[0] - s.work).max() < 2e-3 * np.abs(s.work).max()


@pytest.mark.parametrize(("method", "order"), [("euler", 1), ("rk4", 4)])
def test_the_error_of_a_step_is_that_of_its_order(method, order):
    errors = []
    for steps in (10, 20):
        s = tw.simulate(shared("pendulum"), [2.0], [0.5], dt=1.0 / steps, steps=steps, method=method)
        errors.append(s.step_error()[1])
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order + 1, abs=0.6)


# ---------------------------------------------------------------- what a URDF says of its joints


def rotor(**numbers):
    """A wheel of 0.1 kg m² on an axis."""
    builder = tw.Builder("rotor")
    wheel = tw.SpatialInertia(1.0, np.zeros(3), 0.1 * np.eye(3))
    builder.link("wheel", parent="base_link", joint=tw.Revolute("z"), inertia=wheel, **numbers)
    return builder.build()


def turn(model, v, *, dt=0.01, steps=20, tau=0.0, q=0.0):
    return tw.simulate(model, [q], [v], dt=dt, steps=steps, tau=[tau], method="time-stepping")


@pytest.mark.parametrize("d", [0.5, 1e6])
def test_damping_is_implicit_and_stable_however_large(d):
    s = turn(rotor(damping=d), 2.0)
    assert s.v[:, 0] == pytest.approx(2.0 / (1 + 0.01 * d / 0.1) ** np.arange(21), rel=1e-12)


def test_dry_friction_holds_up_to_its_size_and_brakes_what_moves_to_rest():
    f = 0.3
    s = turn(rotor(friction=f), 0.3, tau=0.1)  # decelerated by (0.3 − 0.1) / 0.1 = 2 rad/s²: for 0.15 s
    assert s.v[:, 0] == pytest.approx(np.maximum(0.3 - 2.0 * s.t, 0), abs=1e-9)
    assert np.abs(turn(rotor(friction=f), 0.0, tau=0.299).v).max() < 1e-12
    assert turn(rotor(friction=f), 0.0, tau=-0.4).v[-1, 0] == pytest.approx(-1.0 * 0.2, rel=1e-9)
    back = turn(rotor(friction=f), 0.05, tau=-1.0)  # within a step it stops and turns back
    assert back.v[-1, 0] == pytest.approx(-7 * (0.2 - 0.05 / 13), abs=13 * 0.01 / 2)


def test_a_joint_stops_at_the_end_of_its_range_and_may_come_back():
    s = turn(rotor(lower=-0.1, upper=0.1), 1.0)
    assert s.q.max() == pytest.approx(0.1, abs=1e-12)
    assert s.v[-1] == 0
    assert turn(rotor(lower=-0.1, upper=0.1), 0.0, q=0.1, tau=-1.0).q[-1] < 0.1


@pytest.mark.slow
def test_the_gain_of_a_drive_as_damping_needs_no_short_steps():
    """kd = 20 on a Go2 at 2 ms; as a policy it wants 0.25 ms, and here it diverges."""
    stiff = replace(GO2, damping=np.r_[np.zeros(6), np.full(12, 20.0)])
    q, hold = GO2.standing(), tw.static_equilibrium(GO2, GO2.standing()).tau

    def spring(t, x, v):
        return np.r_[np.zeros(6), hold - 60 * (x[7:] - q[7:])]

    options = {"dt": 0.002, "steps": 45, "contacts": feet(0.6), "ground": tw.Ground()}
    pushed = np.r_[np.zeros(5), -0.3, np.zeros(12)]
    s = tw.simulate(stiff, q, pushed, tau=spring, **options)
    assert np.abs(s.v[-1]).max() < 0.1
    with pytest.raises(tw.DivergenceError):
        tw.simulate(GO2, q, pushed, tau=lambda t, x, v: spring(t, x, v) - np.r_[np.zeros(6), 20 * v[6:]], **options)


# ---------------------------------------------------------------- other engines


def test_feet_that_stick_in_an_impact_do_what_pinocchio_says():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its impulse dynamics is not asked")
    there = tw.bridge.to_pinocchio_model(GO2)
    data, q, v = there.createData(), GO2.standing(), np.zeros(18)
    v[[0, 3, 5]] = 0.2, 0.1, -1.0
    models = []
    for foot in GO2.feet:
        frame = there.frames[there.getFrameId(foot)]
        models.append(
            pin.RigidConstraintModel(
                pin.ContactType.CONTACT_3D, there, frame.parentJoint, frame.placement, pin.LOCAL_WORLD_ALIGNED
            )
        )
    datas = [m.createData() for m in models]
    pin.initConstraintDynamics(there, data, models, datas)
    after = pin.impulseDynamics(there, data, q, tw.bridge.to_pinocchio_tangent(GO2, v), models, datas, 0.0)
    s = tw.simulate(GO2, q, v, dt=1e-8, steps=1, contacts=feet(50.0), ground=tw.Ground(height=0.0))
    assert np.abs(s.v[-1] - tw.bridge.from_pinocchio_tangent(GO2, after)).max() < 1e-5


def test_a_box_that_is_thrown_ends_where_mujoco_lets_it_end():
    """Its contacts are soft and creep: to 2 % of the way."""
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: the thrown box is not asked of it")
    xml = f"""<mujoco><option timestep="0.001" cone="elliptic" impratio="100"/><worldbody>
    <geom type="plane" size="5 5 1" friction="0.4 0 0" condim="3"/><body pos="0 0 {HALF[2]}"><freejoint/>
    <geom type="box" size="{HALF[0]} {HALF[1]} {HALF[2]}" mass="2" friction="0.4 0 0" condim="3"/></body>
    </worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    data.qvel[:3] = 1.0, 0.5, 0.0
    for _ in range(500):
        mujoco.mj_step(model, data)
    s = slide(0.4, np.r_[0, 0, 0, 1.0, 0.5, 0], dt=0.002, steps=200)
    assert s.q[-1, :2] == pytest.approx(data.qpos[:2], rel=0.02)


# ---------------------------------------------------------------- what is refused


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"height": np.inf}, "height: expected a finite number"),
        ({"restitution": 1.2}, "restitution: expected a number from 0 to 1, got 1.2"),
        ({"normal": [0, 0, 0]}, "normal: expected a direction, got zero"),
    ],
)
def test_a_ground_that_is_none_is_refused(options, said):
    with pytest.raises(ValueError, match=said):
        tw.Ground(**options)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"method": "rk4"}, "method: 'rk4' takes no ground"),
        ({"ground": None, "method": "time-stepping"}, "'time-stepping' takes no contacts without a ground"),
        ({"contacts": [tw.PointContact("FL_foot", 0.5, (1, 0, 0))]}, "contact 'FL_foot': its normal .* is not that"),
        ({"height": -0.1}, r"q: '\w+_foot' begins 0.1 m below the ground; raise the base, or lower the ground"),
    ],
)
def test_what_does_not_go_with_a_ground_is_refused(options, said):
    with pytest.raises(ValueError, match=said):
        dropped(**{"steps": 1, **options})


def test_a_joint_that_begins_beyond_its_range_is_refused():
    with pytest.raises(ValueError, match=re.escape("q: joint 'FL_calf_joint' begins 0.838 beyond its range, -2.7227")):
        tw.simulate(GO2, GO2.neutral() + np.eye(19)[2], np.zeros(18), dt=0.002, steps=1, ground=tw.Ground())


def test_the_first_joint_of_a_fixed_base_is_named_and_not_the_world():
    arm = replace(shared("pendulum"), lower=[-1.0], upper=[1.0])
    with pytest.raises(ValueError, match=f"q: joint {arm.joint_names[1]!r} begins 0.3 beyond its range"):
        tw.simulate(arm, [1.3], [0.0], dt=0.01, steps=1, method="time-stepping")


def test_a_ground_of_another_kind_is_refused():
    with pytest.raises(TypeError, match="ground: expected a Ground, got float"):
        dropped(ground=0.0)


def test_energy_that_steps_make_is_remarked():
    """Legs that fold at 50 rad/s turn by a radian in 18 ms; what a belt puts in is not from nowhere."""
    model = shared("humanoid")
    soles = [tw.SurfaceContact(f"{side}_sole", (0.076, 0.0275), 0.6) for side in ("left", "right")]
    q = model.standing()
    q[2] += 0.3

    def said(dt, steps):
        bouncy = {"contacts": soles, "ground": tw.Ground(restitution=0.9)}
        s = tw.simulate(model, q, np.zeros(27), dt=dt, steps=steps, **bouncy)
        return [remark for remark in s.remarks if remark.kind == "energy"], s.energy

    (remark,), energy = said(0.018, 16)
    k = round(remark.t / 0.018)
    assert remark.value == pytest.approx(energy[k] - energy[:k].min(), rel=1e-12)
    assert remark.value == pytest.approx(12, rel=0.05)
    assert "the energy of 'humanoid' grows by 11.6 J from nowhere" in str(remark)
    assert not said(0.002, 135)[0]
    belt = [tw.PointContact(f"p{k}", 0.5, velocity=(2.0, 0, 0)) for k in range(4)]
    pulled = slide(0.5, np.zeros(6), contacts=belt, steps=40)
    assert pulled.energy[-1] > pulled.energy[0] + 0.9
    assert not [remark for remark in pulled.remarks if remark.kind == "energy"]

"""Motions: smooth, consistent, on feet that stand, and in flight such as only gravity makes them (49.10)."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.polynomial import Polynomial

import twistwrench as tw
from twistwrench.motions import MOTIONS, Motion, ground, limits_broken
from twistwrench.motions.curves import Harmonics, PiecewiseCurve, connect, hop, stair
from twistwrench.motions.gaits import CRAWL, TROT, WALK, Steps
from twistwrench.motions.inverse_kinematics import body_rates, follow
from twistwrench.motions.jumping import FOUR_LEGS, Leap
from twistwrench.motions.legs import stand

from ..robots import shared

G, H = 9.81, 1e-20
GO2 = shared("go2")
OWN = ("go2", "humanoid")
DATA = ("solo12", "talos_reduced", "g1")
NAMES = tuple(MOTIONS)


@cache
def robot(name):
    try:
        return tw.load(name)
    except tw.NameNotFound:
        pytest.skip(f"{name} comes with example-robot-data, which is not installed")


@cache
def motion(name, kind) -> Motion:
    return MOTIONS[kind](robot(name), samples=60)


@cache
def plan(name, kind):
    standing = stand(robot(name))
    if kind == "jump":
        return standing, Leap(standing, FOUR_LEGS)
    return standing, Steps(standing, {"walk": replace(CRAWL, direction=0.4), "trot": TROT}[kind])


every = pytest.mark.parametrize(
    ("name", "kind"),
    [
        *((name, kind) for name in OWN for kind in NAMES),
        *(pytest.param(name, kind, marks=pytest.mark.slow) for name in DATA for kind in NAMES),
    ],
)


# ---------------------------------------------------------------- what every motion promises


@pytest.mark.one_case
@every
def test_feet_that_stand_do_not_move(name, kind):
    model, m = robot(name), motion(name, kind)
    assert m.contacts.any()
    for k, foot in enumerate(m.feet):
        stands = m.contacts[:, k]
        J = tw.frame_jacobian(model, m.q, foot, "local_world_aligned")
        speed = np.matvec(J, m.v)[stands]
        bias = tw.frame_bias_acceleration(model, m.q, m.v, foot, "local_world_aligned")
        acceleration = (np.matvec(J, m.a) + bias)[stands]
        rows = slice(0 if len(stand(model).legs) == 2 else 3, 6)  # a sole does not turn either
        assert np.abs(speed[:, rows]).max() < 1e-13  # m/s and rad/s
        assert np.abs(acceleration[:, rows]).max() < 1e-10
        place = tw.frame_placement(model, m.q, foot).translation
        stays = stands[1:] & stands[:-1] & (np.abs(np.diff(place[:, 2])) < 1e-3)
        assert np.abs(np.diff(place, axis=0)[stays]).max() < 1e-12
        assert np.abs(place[stands, 2]).max() < 1e-12 + np.abs(tw.frame_placement(model, m.q[0], foot).translation[2])


@every
def test_joints_keep_their_limits(name, kind):
    model, m = robot(name), motion(name, kind)
    assert limits_broken(model, m) == {}
    assert ((model.lower <= m.q) & (m.q <= model.upper)).all()
    assert (np.abs(m.v) <= model.velocity_limit).all()


@every
def test_in_flight_the_ground_does_nothing(name, kind):
    model, m = robot(name), motion(name, kind)
    flies = ~m.contacts.any(axis=1)
    assert flies.any() == (kind == "jump")
    wrench = ground(model, m).wrench[flies]
    k_G = tw.centroidal_momentum(model, m.q[flies], m.v[flies])[:, :3]
    if kind == "jump":
        assert np.abs(wrench).max() < 1e-9 * model.mass * G  # of the collocation
        assert np.ptp(k_G, axis=0).max() < 1e-10 * np.abs(k_G).max()
        assert np.abs(k_G).max() > 1e-3


@every
def test_the_ground_is_never_pulled_and_friction_is_enough(name, kind):
    model, m = robot(name), motion(name, kind)
    needed = ground(model, m)
    assert needed.wrench[:, 5].min() > -1e-9 * model.mass * G
    assert needed.friction.max() < 0.5


@pytest.mark.parametrize("kind", NAMES)
def test_two_feet_with_soles_carry_all_motions(kind):
    assert ground(robot("humanoid"), motion("humanoid", kind)).margin.min() > 0


@pytest.mark.slow
def test_a_crawl_and_a_jump_of_go2_keep_the_pressure_inside_the_polygon_and_a_trot_does_not():
    """By as much as docs/templates.md says."""
    inside = {kind: ground(robot("go2"), motion("go2", kind)).margin.min() for kind in NAMES}
    assert inside == pytest.approx({"walk": 0.023, "trot": -0.038, "jump": 0.070}, abs=0.0005)


# ---------------------------------------------------------------- v is the rate of q, a that of v


@pytest.mark.one_case
@pytest.mark.parametrize("kind", NAMES)
def test_velocity_and_acceleration_are_derivatives_by_a_complex_step(kind):
    standing, course = plan("go2", kind)
    model, end = standing.model, course.breaks[-1] if kind == "jump" else course.period
    t = np.random.default_rng(0).uniform(0, end, 12)
    q, v, a = follow(standing, course.goal(t))
    moved_q, moved_v, _ = follow(standing, course.goal(t + 1j * H))
    assert np.abs(moved_q.real - q).max() < 1e-12
    along = model.integrate(q, 1j * H * v).imag / H
    assert np.abs(moved_q.imag / H - along).max() < 1e-11 * np.abs(v).max()
    assert np.abs(moved_v.imag / H - a).max() < 1e-9 * np.abs(a).max()  # of a jump: φ̈ of a fit of φ̇


def test_velocity_and_acceleration_are_slopes_of_what_is_sampled():
    """Central differences of eighth order, of joints, where adding is enough."""
    standing, course = plan("go2", "trot")
    weights, dt = np.array([4 / 5, -1 / 5, 4 / 105, -1 / 280]), 1e-4
    t = np.random.default_rng(3).uniform(0, course.period, 10)  # none within 4 dt of where a foot lifts or lands
    q, v, a = (x.reshape(9, 10, -1) for x in follow(standing, course.goal(np.concatenate(t + dt * np.c_[-4:5]))))
    slope, change = (sum(w * (x[4 + j] - x[4 - j]) for j, w in enumerate(weights, 1)) / dt for x in (q, v))
    assert np.abs(slope[:, 7:] - v[4, :, 6:]).max() < 1e-10 * np.abs(v).max()
    assert np.abs(change - a[4]).max() < 1e-10 * np.abs(a).max()


def test_a_stride_ends_as_it_began_and_further_on():
    for name in OWN:
        for kind in ("walk", "trot"):
            m = motion(name, kind)
            assert np.allclose(m.q[-1, 1:], m.q[0, 1:], rtol=0, atol=1e-11)
            assert np.allclose(m.v[-1], m.v[0], rtol=0, atol=1e-9)
            mean = tw.center_of_mass(robot(name), m.q)
            assert mean[-1, 0] - mean[0, 0] > 0.1


def test_a_jump_begins_and_ends_at_rest_and_level():
    for name in OWN:
        m = motion(name, "jump")
        assert np.abs(m.v[[0, -1]]).max() < 1e-9
        assert np.abs(m.q[-1, 3:6]).max() < 0.02  # the trunk, after its turns


# ---------------------------------------------------------------- outside oracle


def test_the_feet_stand_and_the_robot_falls_in_pinocchio():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model, m = robot("go2"), motion("go2", "jump")
    there = tw.bridge.to_pinocchio_model(model)
    data = there.createData()
    feet = [there.getFrameId(foot) for foot in m.feet]
    for k in range(0, len(m), 5):
        v, a = (tw.bridge.to_pinocchio_tangent(model, x[k]) for x in (m.v, m.a))
        pin.forwardKinematics(there, data, m.q[k], v, a)
        pin.centerOfMass(there, data, m.q[k], v, a)
        speed = [pin.getFrameVelocity(there, data, foot, pin.LOCAL_WORLD_ALIGNED).linear for foot in feet]
        if m.contacts[k].all():
            assert np.abs(speed).max() < 1e-13
        else:
            assert np.allclose(data.acom[0], [0, 0, -G], rtol=0, atol=1e-11)
            rate = pin.computeCentroidalMomentumTimeVariation(there, data, m.q[k], v, a)
            assert np.abs(rate.angular).max() < 1e-8


# ---------------------------------------------------------------- curves, closed forms


def test_a_polynomial_has_the_derivatives_and_the_area_asked_for():
    start, end, span = [1.0, -2, 3], [0.5, 4], (2.0, 2.7)
    p = connect(start, end, span, area=0.9)
    assert np.allclose([p.deriv(k)(span[0]) if k else p(span[0]) for k in range(3)], start, rtol=1e-11)
    assert np.allclose([p(span[1]), p.deriv()(span[1])], end, rtol=1e-11)
    assert p.integ()(span[1]) - p.integ()(span[0]) == pytest.approx(0.9, rel=1e-11)
    assert np.allclose(connect([0.0, 0], [1.0, 0], (0, 1))(0.3), 3 * 0.3**2 - 2 * 0.3**3, rtol=1e-14)


def test_jets_are_derivatives():
    t = np.array([0.05, 0.4, 0.77, 1.3])
    pieces = PiecewiseCurve([0, 0.5, 1], [[Polynomial([1, 2, 3]), Polynomial([0, 1])], [Polynomial([2, -1, 0, 4])] * 2])
    path = Harmonics(np.array([0.3]), np.random.default_rng(0).standard_normal((32, 1)), 0.9, np.ones(8))
    for curve in (pieces, path, lambda t: stair(2 * t - 0.3, 2), lambda t: hop(2 * t - 0.3, 2)):
        jet, moved = curve(t), curve(t + 1j * H)
        assert np.allclose(moved[:2].imag / H, jet[1:], rtol=1e-13, atol=1e-11)


def test_steps_are_smooth_where_they_begin_and_end():
    for curve in (stair, hop):
        ends = curve(np.array([-0.5, 0.0, 1.0, 1.5]), 1)
        assert np.abs(ends[1:]).max() == 0
    assert stair(np.array([0.5]), 1)[0] == pytest.approx(0.5)
    assert hop(np.array([0.5]), 1)[0] == pytest.approx(1)


def test_the_planned_path_is_a_pendulums_about_the_planned_pressure():
    """p̈ = (g / z)(p − c), harmonic by harmonic: with c a cosine, p is c / (1 + ω² z / g)."""
    period, z = 1.3, 0.4
    t = np.arange(64) / 64 * period
    w = 2 * np.pi / period
    c = np.stack([0.2 + 0.05 * np.cos(3 * w * t), 0.1 * np.sin(w * t)], axis=1)
    gain = 1 / (1 + (w * np.arange(8)) ** 2 * z / G)
    p = Harmonics(np.zeros(2), c, period, gain)(t)
    assert np.allclose(p[2], G / z * (p[0] - c), rtol=0, atol=1e-12)
    assert np.allclose(p[0, :, 1], c[:, 1] / (1 + w**2 * z / G), rtol=0, atol=1e-14)


def test_angular_velocity_and_acceleration_of_a_turning_frame():
    rng = np.random.default_rng(0)
    c = rng.standard_normal((4, 5, 3)) / 2

    def phi(t):
        return np.stack([c[0] + c[1] * t + c[2] * t**2 + c[3] * t**3, c[1] + 2 * c[2] * t + 3 * c[3] * t**2])

    t, second = 0.7, 2 * c[2] + 6 * c[3] * 0.7
    w, w_dot = body_rates(np.stack([*phi(t), second]))
    R = tw.exp3(phi(t + 1j * H)[0])
    assert np.allclose(tw.skew(w), R.real.mT @ R.imag / H, rtol=0, atol=1e-13)
    moved, _ = body_rates(np.stack([*phi(t + 1j * H), second + 0j]))
    assert np.allclose(moved.imag / H, w_dot, rtol=0, atol=1e-13)
    axis = np.array([[0.0, 0.6, 0.8]])  # about one axis ω is φ̇
    assert np.allclose(body_rates(np.stack([2 * axis, 3 * axis, 4 * axis])), np.stack([3 * axis, 4 * axis]), atol=1e-13)


# ---------------------------------------------------------------- what the ground must do


def still(model, a=(0, 0, 0)) -> Motion:
    """A standing robot that is pushed as a whole."""
    q = model.standing()[None]
    acceleration = np.concatenate([np.zeros(3), a, np.zeros(model.nv - 6)])[None]
    contacts = np.ones((1, len(model.feet)), bool)
    return Motion("still", np.zeros(1), q, 0 * acceleration, acceleration, model.feet, contacts)


def test_a_standing_robot_presses_below_its_centre_of_mass():
    model = robot("go2")
    needed, com = ground(model, still(model)), tw.center_of_mass(model, model.standing())
    assert needed.friction == pytest.approx(0, abs=1e-15)
    assert np.allclose(needed.center_of_pressure[0], com * [1, 1, 0], rtol=0, atol=1e-14)
    feet = [tw.frame_placement(model, model.standing(), foot).translation for foot in model.feet]
    edges = np.abs(feet)[0, :2] - np.abs(com[:2])  # its feet are a rectangle about the origin
    assert needed.margin == pytest.approx(edges.min(), rel=1e-12)
    assert needed.wrench[0] == pytest.approx([0, 0, 0, 0, 0, model.mass * G], abs=1e-12)


def test_speeding_up_moves_the_pressure_back_by_the_pendulums_law_and_needs_friction():
    model = robot("go2")
    needed, com = ground(model, still(model, (2.0, -1.0, 0.5))), tw.center_of_mass(model, model.standing())
    back = com[2] / (G + 0.5) * np.array([2.0, -1.0, 0])
    assert np.allclose(needed.center_of_pressure[0], com * [1, 1, 0] - back, rtol=0, atol=1e-13)
    assert needed.friction == pytest.approx(np.hypot(2, 1) / (G + 0.5), rel=1e-12)


def test_the_motion_of_another_robot_is_refused():
    for function in (ground, limits_broken):
        with pytest.raises(tw.ShapeError, match=r"q: expected shape \(..., 28\), got"):
            function(robot("humanoid"), motion("go2", "walk"))


def test_pressure_outside_the_feet_counts_as_negative():
    model = robot("go2")
    com, edge = tw.center_of_mass(model, model.standing()), 0.1934
    front = max(tw.frame_placement(model, model.standing(), foot).translation[0] for foot in model.feet)
    assert front == pytest.approx(edge, abs=1e-3)
    needed = ground(model, still(model, (-12.0, 0, 0)))
    ahead = com[0] + 12 * com[2] / G
    assert needed.margin == pytest.approx(front - ahead, rel=1e-12)
    assert ahead > front


def test_moments_move_the_pressure():
    """With k̇_G: what turns the robot about y is pressed (k̇_y / weight) further back."""
    model = robot("go2")
    m = still(model)
    m.a[0, 1] = 3.0  # turns about the base's origin
    rate = tw.centroidal_momentum_rate(model, m.q, m.v, m.a)[0]
    force = rate[3:] - model.mass * model.gravity
    com = tw.center_of_mass(model, model.standing())
    c = ground(model, m).center_of_pressure[0]
    assert np.allclose(np.cross(c - com, force)[:2], rate[:2], rtol=0, atol=1e-12)


# ---------------------------------------------------------------- what cannot be


def fork():
    """Two feet whose legs begin at one knee."""
    builder, bone = tw.Builder("fork", base="floating", root="hip"), tw.SpatialInertia(1, [0, 0, -0.1], np.eye(3) / 9)
    parent = "hip"
    for name in ("thigh", "shin"):
        builder.link(name, parent=parent, joint=tw.Revolute("y"), inertia=bone)
        parent = name
    for name in ("left", "right"):
        builder.link(name, parent="shin", joint=tw.Revolute("x"), inertia=bone)
    return builder.build(feet=("left", "right"), postures={"standing": [0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0]})


def test_a_jump_whose_turning_does_not_come_to_rest_is_none(monkeypatch):
    monkeypatch.setattr("twistwrench.motions.jumping.PICARD_ITERATIONS", 1)
    with pytest.raises(tw.SingularError, match="'go2': no turning of the base found"):
        Leap(stand(robot("go2")), FOUR_LEGS)


def test_what_has_no_legs_cannot_walk():
    with pytest.raises(tw.ModelError, match="'planar_arm': expected a floating base and feet, got a fixed one"):
        tw.motions.walk(shared("planar_arm"))
    with pytest.raises(tw.ModelError, match="expected a leg of 3 joints"):
        tw.motions.walk(replace(robot("go2"), feet=("FL_calf_joint", "FR_hip_joint")))
    with pytest.raises(tw.ModelError, match="'fork': its legs share joints"):
        stand(fork())
    with pytest.raises(tw.ModelError, match="expected 4 legs for this gait, got 3"):
        tw.motions.trot(replace(robot("go2"), feet=robot("go2").feet[:3]))


def test_gravity_must_pull_down():
    tilted = replace(robot("go2"), gravity=np.array([1.0, 0, -9.81]))
    with pytest.raises(tw.ModelError, match="expected gravity along -z"):
        tw.motions.walk(tilted)
    with pytest.raises(tw.ModelError, match="expected gravity along -z"):
        ground(tilted, motion("go2", "walk"))


@pytest.mark.slow
def test_steps_that_are_too_long_are_refused():
    standing = stand(robot("go2"))
    steps = Steps(standing, replace(CRAWL, speed=0.5))
    with pytest.raises(tw.SingularError, match=r"'go2': no posture .* are the legs long enough"):
        follow(standing, steps.goal(np.linspace(0, steps.period, 20)))


@pytest.mark.parametrize("raises", [True, False], ids=["raises", "a browser's NumPy"])
def test_a_straight_leg_is_refused(raises, monkeypatch):
    if not raises:
        monkeypatch.setattr(np.linalg, "solve", lambda J, wanted: np.full_like(wanted, np.nan))
    model = robot("humanoid")
    straight = np.where(np.abs(model.standing()) > 0.2, 0, model.standing())  # hips, knees and ankles
    straight[[2, 6]] = model.standing()[[2, 6]]
    with pytest.raises(tw.SingularError, match="a leg is straight"):
        tw.motions.jump(replace(model, postures={"standing": straight}), samples=5)


def test_a_joint_beyond_its_limits_is_named():
    model, m = robot("go2"), motion("go2", "walk")
    name, entry, place = (
        "FL_calf_joint",
        *(at[model.joint_id("FL_calf_joint")].start for at in (model.q_slice, model.v_slice)),
    )
    upper, fastest = model.upper.copy(), model.velocity_limit.copy()
    upper[entry], fastest[place] = m.q[:, entry].max() - 0.1, np.abs(m.v[:, place]).max() / 1.5
    beyond, share = limits_broken(replace(model, upper=upper, velocity_limit=fastest), m)[name]
    assert beyond == pytest.approx(0.1)
    assert share == pytest.approx(1.5)


def test_a_motion_has_at_least_two_samples():
    with pytest.raises(ValueError, match="samples: expected a whole number of at least 2, got 1"):
        tw.motions.walk(robot("go2"), samples=1)


def test_gaits_follow_the_legs_wherever_they_stand_in_the_list():
    for name in OWN:
        model = robot(name)
        turned = replace(model, feet=tuple(reversed(model.feet)))
        one, other = (tw.motions.trot(m, samples=5) for m in (model, turned))
        assert np.allclose(one.q, other.q, rtol=0, atol=1e-12)
        assert (one.contacts == other.contacts[:, ::-1]).all()


def test_arms_swing_against_the_legs_of_their_side():
    steps = Steps(stand(robot("humanoid")), WALK)
    model, columns = robot("humanoid"), [column for column, _, _ in steps.arms]
    swung = {name for name, at in zip(model.joint_names, model.v_slice, strict=True) if at.start in columns}
    assert swung - {"universe"} == {"left_shoulder_pitch", "right_shoulder_pitch"}
    t = np.linspace(0, steps.period, 50)
    goal = steps.goal(t)
    com = goal.com[0, :, 0]
    for leg in range(2):
        ahead = goal.steps[0, :, leg, 0] - com
        column = next(c for c, _, left in steps.arms if left == (steps.stand.legs[leg].center[1] > 0))
        assert np.corrcoef(ahead, goal.joints[0, :, column])[0, 1] > 0.8  # a turn about +y takes the hand back


def test_a_motion_keeps_its_contacts_when_the_callers_change():
    walk = tw.motions.walk(shared("go2"), samples=3)
    given = {name: np.array(getattr(walk, name)) for name in ("t", "q", "v", "a", "contacts")}
    motion = tw.motions.Motion("mine", given["t"], given["q"], given["v"], given["a"], walk.feet, given["contacts"])
    for x in given.values():
        x[:] = 0
    for name in given:
        assert np.array_equal(getattr(motion, name), getattr(walk, name))


# ---------------------------------------------------------------- of one's own


@pytest.mark.parametrize("name", OWN)
def test_a_gait_has_the_speed_the_height_the_direction_and_the_steps_that_it_is_given(name):
    model = robot(name)
    given = {"speed": 0.1, "height": 0.9 * stand(model).height, "direction": 0.5, "step_length": 0.12}
    ours = tw.motions.walk(model, samples=30, **given)
    G = tw.center_of_mass(model, ours.q)
    assert ours.name == "walk at 0.1 m/s"
    assert ours.t[-1] == pytest.approx(1.2)  # the time of a stride: of its length at that speed
    gone = G[-1] - G[0]
    assert np.linalg.norm(gone) == pytest.approx(0.12, rel=1e-9)
    assert np.arctan2(gone[1], gone[0]) == pytest.approx(0.5)
    feet = np.stack([tw.frame_placement(model, ours.q, foot).translation for foot in ours.feet])
    assert np.linalg.norm(feet[:, -1] - feet[:, 0], axis=-1) == pytest.approx(0.12, rel=1e-9)
    assert np.ptp(G[:, 2]) < 1e-9
    assert G[0, 2] - feet[..., 2].min() == pytest.approx(given["height"], rel=1e-9)


def test_on_the_spot_nothing_gets_any_further():
    ours = tw.motions.trot(GO2, samples=12, speed=0)
    assert np.abs(np.diff(tw.center_of_mass(GO2, ours.q)[[0, -1]], axis=0)).max() < 1e-12
    assert not ours.contacts.all()


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"speed": -1.0}, "speed: expected a number from 0 to 15.*, got -1.0"),
        ({"height": 0}, r"height: expected a number from 0.00247 to 24.7, got 0"),
        ({"step_length": 0}, r"step_length: expected a number from 0.00247 to 24.7, got 0"),
        ({"direction": np.inf}, "direction: expected a number from -100 to 100, got inf"),
        ({"step_length": 0.1, "speed": 0}, "step_length: expected None, since the speed is 0, got 0.1"),
    ],
)
def test_a_gait_that_is_none_is_named(given, said):
    with pytest.raises(ValueError, match=said):
        tw.motions.walk(GO2, samples=2, **given)


@pytest.mark.parametrize("name", ["planar_arm", "go2"])
def test_any_robot_reaches_from_rest_to_rest(name):
    model, rng = robot(name), np.random.default_rng(1)
    q0, q1 = (model.random_configuration(rng=rng) for _ in range(2))
    ours = tw.motions.reach(model, q0, q1, duration=0.7, samples=9)
    assert np.abs(model.difference(ours.q[[0, -1]], np.stack([q0, q1]))).max() < 1e-13
    assert not ours.v[[0, -1]].any()
    assert not ours.a[[0, -1]].any()
    for k in (2, 4, 7):  # by a complex step along the curve, and of v
        way = model.difference(q0, q1)
        s, pace, change = stair((ours.t[k : k + 1] + H * 1j) / 0.7, 1 / 0.7)[:, 0]
        ahead = model.difference(ours.q[k].astype(complex), model.integrate(q0.astype(complex), s * way))
        assert np.abs(ahead.imag / H - ours.v[k]).max() < 1e-12 * np.abs(way).max() / 0.7
        assert np.abs((pace * way).imag / H - ours.a[k]).max() < 1e-12 * np.abs(ours.a).max()
        assert change.real * way == pytest.approx(ours.a[k])


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"duration": 0}, "duration: expected a number above 0, got 0"),
        ({"samples": 1}, "samples: expected"),
        ({"q1": np.zeros((2, 3))}, "q0, q1: expected one real configuration each"),
        ({"q0": np.zeros(2)}, r"q0: expected shape \(..., 3\)"),
    ],
)
def test_a_reach_that_is_none_is_named(given, said):
    with pytest.raises(ValueError, match=said):
        tw.motions.reach(robot("planar_arm"), **{"q0": np.zeros(3), "q1": np.ones(3)} | given)

"""Inverse dynamics under contact, with and without friction cones, and how far a pose is from slipping or tipping."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import linprog, nnls

import twistwrench as tw
from twistwrench.contact.qp import least_within
from twistwrench.contact.task import ContactProblem, contact_limits

from ..robots import shared
from ..touching import (
    BOX,
    BOX_CORNERS,
    FEET,
    GO2,
    HUMANOID,
    SOLE,
    SOLE_CORNERS,
    SOLES,
    corners,
    error,
    motors,
    points,
    posed,
    solid,
)

REST, STILL = np.zeros(18), np.zeros(27)
POSE = HUMANOID.standing()
DOWN = np.r_[0, 0, 0, 0, 0, -9.81 - 4.81]  # the ground would have to pull at 8 kg with 4.81 m/s²
FORWARDS = np.r_[0, 0, 0, 5.0, 0, 0, np.zeros(12)]  # m/s²
SLOWER = 0.4 * FORWARDS


def stacked(forces):
    return np.concatenate(list(forces.values()))


def feet(mu):
    return points(GO2.feet, mu)


# ---------------------------------------------------------------- least squares


@pytest.mark.one_case
@pytest.mark.parametrize(
    ("model", "q", "contacts"),
    [
        (GO2, GO2.standing(), FEET),
        (HUMANOID, POSE, SOLES),
        (HUMANOID, POSE, SOLE_CORNERS),
    ],
    ids=["Go2", "soles", "corners"],
)
def test_inverse_dynamics_gives_the_forces_that_forward_dynamics_answers_with_the_same_motion(model, q, contacts):
    rng = np.random.default_rng(0)
    v = tw.impact(model, q, rng.standard_normal(model.nv), contacts).v
    a = tw.contact_forward_dynamics(model, q, v, motors(model, rng), contacts).qdd
    need = tw.contact_inverse_dynamics(model, q, v, a, contacts)
    assert (need.tau[:6] == 0).all()
    J = tw.constraint_jacobian(model, q, contacts)
    left = tw.rnea(model, q, v, a) - need.tau - J.T @ stacked(need.forces)
    assert np.abs(left).max() < 1e-12 * np.abs(stacked(need.forces)).max()
    assert np.abs(need.residual).max() < 1e-11 * np.abs(a).max()
    assert error(tw.contact_forward_dynamics(model, q, v, need.tau, contacts).qdd, a) < 1e-11


def test_forces_at_rest_are_those_of_static_equilibrium():
    held = tw.static_equilibrium(GO2, GO2.standing())
    need = tw.contact_inverse_dynamics(GO2, GO2.standing(), REST, REST, FEET)
    assert error(stacked(need.forces), held.forces.ravel()) < 1e-13
    assert error(need.tau[6:], held.tau) < 1e-13


def test_forces_are_the_least_that_balance_the_base():
    rng = np.random.default_rng(1)
    a = rng.standard_normal(HUMANOID.nv)
    q, v = POSE, rng.standard_normal(HUMANOID.nv)
    need = tw.contact_inverse_dynamics(HUMANOID, q, v, a, SOLE_CORNERS)
    base = tw.constraint_jacobian(HUMANOID, q, SOLE_CORNERS)[:, :6]
    least = np.linalg.lstsq(base.T, tw.rnea(HUMANOID, q, v, a)[:6])[0]
    assert error(stacked(need.forces), least) < 1e-12
    as_soles = tw.contact_inverse_dynamics(HUMANOID, q, v, a, SOLES)
    for sole in SOLES:
        force = sum(f for name, f in need.forces.items() if name.startswith(sole.frame))
        assert error(as_soles.forces[sole.frame][3:], force) < 1e-12


def test_residual_is_the_acceleration_that_the_motion_asks_of_the_contacts():
    a = np.random.default_rng(2).standard_normal(18)
    need = tw.contact_inverse_dynamics(GO2, GO2.standing(), REST, a, FEET)
    assert error(need.residual, tw.contact_jacobian(GO2, GO2.standing(), GO2.feet) @ a) < 1e-12


@pytest.mark.slow
def test_a_wrench_from_outside_is_borne():
    f_ext = np.zeros((GO2.nbodies, 6))
    f_ext[1, 5] = -50.0  # a load on the base, which is level
    need = tw.contact_inverse_dynamics(GO2, GO2.standing(), REST, REST, FEET, f_ext)
    assert np.allclose(sum(need.forces.values()), [0, 0, GO2.mass * 9.81 + 50], rtol=0, atol=1e-11)


def test_batches_are_single_states():
    a = np.random.default_rng(3).standard_normal((2, 1, 18))
    q = np.stack([GO2.standing()] * 3)
    many = tw.contact_inverse_dynamics(GO2, q, REST, a, FEET)
    one = tw.contact_inverse_dynamics(GO2, q[0], REST, a[1, 0], FEET)
    assert many.tau.shape == (2, 3, 18)
    assert error(many.tau[1, 2], one.tau) < 1e-12
    assert error(many.forces["RR_foot"][1, 2], one.forces["RR_foot"]) < 1e-12


def test_a_fixed_base_needs_no_contact_forces():
    arm = shared("planar_arm")
    q, v, a = np.array([[0.3, -0.5, 0.7], [1, 2, 3], [4, 5, 6]])
    need = tw.contact_inverse_dynamics(arm, q, v, a, points(["tool"]))
    assert (need.forces["tool"] == 0).all()
    assert error(need.tau, tw.rnea(arm, q, v, a)) < 1e-14


def test_a_robot_that_falls_freely_needs_no_forces():
    q, v = GO2.standing(), np.random.default_rng(4).standard_normal(18)
    falling = tw.aba(GO2, q, v, REST)
    for ask in (tw.contact_inverse_dynamics, tw.friction_inverse_dynamics):
        for contacts in (FEET, FEET[:2], []):
            need = ask(GO2, q, v, falling, contacts)
            assert np.abs(need.tau).max() < 1e-12
            assert all(np.abs(force).max() < 1e-12 for force in need.forces.values())


def test_what_two_feet_cannot_hold_is_told():
    with pytest.raises(tw.SingularError, match=r"no forces at \['FL_foot', 'FR_foot'\] do this: .* is left over"):
        tw.contact_inverse_dynamics(GO2, GO2.standing(), REST, REST, FEET[:2])
    with pytest.raises(tw.SingularError, match=r"no forces at \[\] do this"):
        tw.contact_inverse_dynamics(GO2, GO2.standing(), REST, REST, [])


# ---------------------------------------------------------------- friction cones


def test_forces_that_obey_anyway_are_the_least_ones():
    need = tw.friction_inverse_dynamics(GO2, GO2.standing(), REST, REST, FEET)
    assert need.binding == ()
    assert error(stacked(need.forces), stacked(tw.contact_inverse_dynamics(GO2, *poised(REST), FEET).forces)) < 1e-15


def poised(a):
    return GO2.standing(), REST, a


def pushing(contacts, **cone):
    return tw.friction_inverse_dynamics(GO2, *poised(FORWARDS), contacts, **cone)


@pytest.mark.parametrize("pyramid", ["inner", "outer"])
@pytest.mark.parametrize("sides", [4, 8, 16])
@pytest.mark.parametrize(
    ("model", "q", "a", "contacts"),
    [
        (GO2, GO2.standing(), FORWARDS, feet(0.75)),
        (HUMANOID, POSE, np.r_[0, 0, 0, 0.3, 0.8, 0, np.zeros(21)], SOLES),
    ],
    ids=["Go2", "humanoid"],
)
def test_forces_are_the_least_within_the_limits(model, q, a, contacts, sides, pyramid):
    """By the conditions of Karush, Kuhn and Tucker, with multipliers that another algorithm finds."""
    v = np.zeros(model.nv)
    need = tw.friction_inverse_dynamics(model, q, v, a, contacts, sides=sides, pyramid=pyramid)
    J = tw.constraint_jacobian(model, q, contacts)
    left = tw.rnea(model, q, v, a) - need.tau - J.T @ stacked(need.forces)
    weight = model.mass * 9.81
    assert np.abs(left).max() < 1e-12 * weight
    assert (need.tau[:6] == 0).all()

    task = ContactProblem.of(model, q, v, a, contacts, None)
    A, _, names, *_ = contact_limits(contacts, sides, pyramid)
    free = task.free
    z, _ = least_within(A @ free, -A @ task.least, task.size)
    f = task.least + free @ z
    assert error(stacked(need.forces), task.P @ f) < 1e-15
    assert (A @ f).max() < 1e-9 * weight
    tight = A @ f > -1e-7 * weight
    _, miss = nnls((A[tight] @ free).T, -free.T @ f)  # the gradient is a sum of limits that it leans on
    assert miss < 1e-7 * weight
    assert set(need.binding) <= {name for name, leans in zip(names, tight, strict=True) if leans}
    assert need.binding


def test_finer_pyramids_come_nearer_to_the_cone_from_both_sides():
    norms = {
        (sides, pyramid): np.linalg.norm(
            stacked(
                tw.friction_inverse_dynamics(GO2, *poised(FORWARDS), feet(0.58), sides=sides, pyramid=pyramid).forces
            )
        )
        for sides in (8, 16, 64)
        for pyramid in ("inner", "outer")
    }
    gaps = [norms[sides, "inner"] - norms[sides, "outer"] for sides in (8, 16, 64)]
    assert gaps[0] > gaps[1] > gaps[2] > 0
    for force in pushing(feet(0.58)).forces.values():
        assert np.hypot(*force[:2]) <= 0.58 * force[2] * (1 + 1e-9)


def test_the_pressure_on_a_sole_stays_within_it():
    a = np.r_[0, 0, 0, 0.3, 0.8, 0, np.zeros(21)]
    q, v = POSE, np.zeros(27)
    need = tw.friction_inverse_dynamics(HUMANOID, q, v, a, SOLES)
    for sole in SOLES:
        R = tw.frame_placement(HUMANOID, q, sole.frame).rotation
        tau, f = R.T @ need.forces[sole.frame][:3], R.T @ need.forces[sole.frame][3:]
        assert abs(tau[1]) <= SOLE[0] * f[2] * (1 + 1e-9)
        assert abs(tau[0]) <= SOLE[1] * f[2] * (1 + 1e-9)
        assert np.hypot(*f[:2]) <= 0.6 * f[2] * (1 + 1e-9)


@pytest.mark.one_case
@pytest.mark.parametrize("mu", np.linspace(0.45, 0.65, 9))
def test_it_says_cannot_exactly_where_a_linear_programme_finds_no_forces(mu):
    task = ContactProblem.of(GO2, *poised(FORWARDS), feet(mu), None)
    A = contact_limits(feet(mu), 8, "inner").A
    possible = linprog(np.zeros(12), A, np.zeros(len(A)), task.J[:, :6].T @ task.P, task.b[:6], (None, None)).success
    try:
        pushing(feet(mu))
        found = True
    except tw.SingularError:
        found = False
    assert found == possible


def test_cannot_comes_with_the_limits_that_stand_in_the_way():
    with pytest.raises(tw.SingularError, match=r"cannot: .* break friction at '.._foot' by \d+\.\d+ N, friction at"):
        pushing(feet(0.3))
    with pytest.raises(tw.SingularError, match=r"cannot: .* break lift-off at corner \(.*\) of 'left_sole' by"):
        tw.friction_inverse_dynamics(HUMANOID, POSE, STILL, STILL, SOLES[:1])
    with pytest.raises(tw.SingularError, match=r"break (lift-off at '[fr][lr]' by 9\.62 N(, )?){4} and 4 more$"):
        tw.friction_inverse_dynamics(BOX, BOX.neutral(), 0 * DOWN, DOWN, BOX_CORNERS)


@pytest.fixture(scope="module")
def tired():
    """Go2 with motors of which the four knees are too weak for the least forces of a push, by a sixth."""
    need = np.abs(tw.friction_inverse_dynamics(GO2, *poised(SLOWER), feet(0.75), sides=16).tau[8::3]).max()
    limit = GO2.effort_limit.copy()
    limit[8::3] = need / 1.2
    return replace(GO2, effort_limit=limit), need / 1.2


def test_forces_that_spare_the_motors_are_the_least_that_do(tired):
    """By the conditions of Karush, Kuhn and Tucker again: the torques' limits are limits of the forces."""
    model, limit = tired
    contacts, state = feet(0.75), poised(SLOWER)
    free = tw.friction_inverse_dynamics(model, *state, contacts, sides=16)
    kept = tw.friction_inverse_dynamics(model, *state, contacts, sides=16, effort_limits=True)
    assert np.abs(free.tau[8::3]).max() == pytest.approx(1.2 * limit)
    assert np.abs(kept.tau[8::3]).max() == pytest.approx(limit, rel=1e-9)
    J, h = tw.constraint_jacobian(model, state[0], contacts), tw.rnea(model, *state)
    assert np.abs(h - kept.tau - J.T @ stacked(kept.forces)).max() < 1e-11 * model.mass * 9.81
    motors = {name for name in kept.binding if name.startswith("the motor of")}
    assert motors <= {f"the motor of '{leg}_calf_joint'" for leg in ("FL", "FR", "RL", "RR")}
    assert motors
    assert np.linalg.norm(stacked(kept.forces)) > np.linalg.norm(stacked(free.forces))

    f = stacked(kept.forces)  # point feet: the contacts' axes are the world's
    cones = contact_limits(contacts, 16, "inner").A
    torques = np.concatenate([-J.T[8::3], J.T[8::3]])
    room = np.concatenate([limit - h[8::3], limit + h[8::3]]) - torques @ f
    assert room.min() > -1e-9 * limit
    rows = np.concatenate([cones[cones @ f > -1e-7 * 158], torques[room < 1e-7 * limit]])
    inner = np.linalg.svd(J[:, :6].T)[2][6:]  # what exerts no wrench
    _, miss = nnls((rows @ inner.T).T, -inner @ f)
    assert miss < 1e-7 * np.linalg.norm(f)


def test_motors_that_nothing_spares_are_named(tired):
    weak = replace(tired[0], effort_limit=np.r_[np.full(6, np.inf), np.full(12, 0.3)])
    with pytest.raises(tw.SingularError, match=r"they would have to break the motor of '.*_joint' by \d.*N m"):
        tw.friction_inverse_dynamics(weak, *poised(REST), FEET, effort_limits=True)


def test_an_arm_leans_on_a_table_as_far_as_its_motors_cannot_hold_it():
    """Of a fixed base nothing asks for forces but the motors; the largest that they spare, by a linear programme."""
    arm, q = shared("planar_arm"), np.array([0.4, 0.5, 0.6])
    strong, table = np.abs(tw.gravity(arm, q)), points(["tool"])
    assert not stacked(tw.friction_inverse_dynamics(arm, q, 0 * q, 0 * q, table, effort_limits=True).forces).any()
    J, A = tw.constraint_jacobian(arm, q, table), contact_limits(table, 16, "inner").A
    g = tw.gravity(arm, q)
    ways = np.block([[A, np.zeros((len(A), 1))], *([s * J.T, -strong[:, None]] for s in (-1, 1))])  # f, and the share
    least = linprog([0, 0, 0, 1], ways, np.r_[np.zeros(len(A)), -g, g], bounds=[(None, None)] * 3 + [(0, None)]).fun
    assert 0 < least < 0.9
    for share, enough in ((1.001 * least, True), (0.999 * least, False)):
        weak = replace(arm, effort_limit=share * strong)
        try:
            held = tw.friction_inverse_dynamics(weak, q, 0 * q, 0 * q, table, sides=16, effort_limits=True)
        except tw.SingularError:
            assert not enough
        else:
            assert enough
            assert (np.abs(held.tau) <= weak.effort_limit * (1 + 1e-8)).all()
            assert np.abs(g - held.tau - J.T @ held.forces["tool"]).max() < 1e-12 * g.max()
    with pytest.raises(tw.SingularError, match=r"break the motor of 'shoulder' by \d.* N m"):
        tw.friction_inverse_dynamics(weak, q, 0 * q, 0 * q, [], effort_limits=True)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"sides": 2}, "sides: expected a whole number, at least 3, got 2"),
        ({"pyramid": "round"}, "pyramid: expected 'inner' or 'outer', got 'round'"),
        ({"q": np.stack([GO2.standing()] * 2)}, r"q, v, a: expected one state, got a batch of shape \(2,\)"),
        ({"a": np.zeros(12)}, r"a: expected shape \(..., 18\)"),
        ({"q": GO2.standing() + 0j}, "expected real numbers"),
        ({"contacts": ["FL_foot"]}, "PointContact"),
    ],
)
def test_a_wrong_argument_is_named(change, said):
    given = {"q": GO2.standing(), "v": REST, "a": REST, "contacts": FEET} | change
    with pytest.raises(ValueError, match=said):
        tw.friction_inverse_dynamics(GO2, **given)


# ---------------------------------------------------------------- stance


def block(slope, size, mu=0.6):
    """A block on a slope, downhill along x, and its corners."""
    model = solid("block", 3.0, size, corners(size))
    normal = (np.sin(slope), 0, np.cos(slope))
    return model, posed([0, slope, 0], [0, 0, 0]), points(["fl", "fr", "rl", "rr"], mu, normal=normal)


@pytest.mark.parametrize("slope", [0.1, 0.5, 0.8])
@pytest.mark.parametrize(("sides", "pyramid"), [(4, "outer"), (4, "inner"), (16, "inner")])
def test_a_block_on_a_slope_needs_the_tangent_of_the_slope(slope, sides, pyramid):
    margins = tw.stance_margins(*block(slope, (0.4, 0.4, 0.2)), sides=sides, pyramid=pyramid)
    side = np.cos(np.pi / sides) if pyramid == "inner" else 1.0  # where the pyramid has its sides, of μ
    assert np.isclose(margins.friction_used, np.tan(slope) / 0.6 / side, rtol=2e-6)
    assert margins.stands == (margins.friction_used <= 1)
    assert margins.reason.startswith("it slips" if margins.friction_used > 1 else "")
    assert np.isclose(margins.tip, 0.2 * np.cos(slope) - 0.1 * np.sin(slope), rtol=1e-12)


@pytest.mark.parametrize("mu", [0.0, 1e-6])
def test_a_block_on_a_smooth_slope_slips_and_does_not_tip(mu):
    margins = tw.stance_margins(*block(0.1, (0.4, 0.4, 0.2), mu=mu))
    assert not margins.stands
    assert margins.tip > 0.1
    assert margins.reason.removeprefix("it slips: it would need ").startswith("1.02e+05 times" if mu else "friction wh")


@pytest.mark.parametrize(("slope", "stands"), [(0.49, True), (0.51, False)])
def test_a_tall_block_tips_where_its_centre_passes_the_lower_edge(slope, stands):
    height = 0.2 / np.tan(0.5)  # tips at 0.5 rad
    margins = tw.stance_margins(*block(slope, (0.2, 0.3, height), mu=2.0))
    assert margins.stands == stands == (margins.tip > 0)
    assert np.isclose(margins.tip, np.hypot(0.2, height) / 2 * np.sin(0.5 - slope), rtol=1e-11)
    assert margins.reason == "" or margins.reason.startswith("it tips: the centre of mass is")


@pytest.mark.parametrize("angle", [0.6, 0.9, 1.3])
def test_a_ladder_at_a_smooth_wall_needs_half_the_cotangent(angle):
    margins = tw.stance_margins(*ladder(angle, 0.5, 0.0), sides=4, pyramid="outer")
    assert np.isclose(margins.friction_used, 0.5 / np.tan(angle) / 0.5, rtol=2e-6)


def test_a_ladder_at_45_degrees_with_friction_at_both_ends_needs_the_root_of_two_less_one():
    margins = tw.stance_margins(*ladder(np.pi / 4, 0.5, 0.5), sides=4, pyramid="outer")
    assert np.isclose(margins.friction_used, (np.sqrt(2) - 1) / 0.5, rtol=2e-6)


def ladder(angle, floor, wall):
    """A ladder up to a wall across x."""
    model = solid("ladder", 10.0, (4.0, 0.02, 0.02), {"foot": (-2, 0, 0), "head": (2, 0, 0)})
    touching = [tw.PointContact("foot", floor), tw.PointContact("head", wall, (-1, 0, 0))]
    return model, posed([0, -angle, 0], [0, 0, 2 * np.sin(angle)]), touching


def test_robots_stand_on_level_ground_without_friction_and_by_the_distance_to_the_edge():
    margins = tw.stance_margins(GO2, GO2.standing(), FEET)
    G = tw.center_of_mass(GO2, GO2.standing())
    feet = np.array([tw.frame_placement(GO2, GO2.standing(), foot).translation for foot in GO2.feet])
    assert margins.stands
    assert margins.friction_used == 0
    assert np.isclose(
        margins.tip, np.abs(np.abs(feet[:, 1]) - abs(G[1])).min(), rtol=1e-9
    )  # the nearest edge is a side
    on_soles = tw.stance_margins(HUMANOID, POSE, SOLES)
    on_corners = tw.stance_margins(HUMANOID, POSE, SOLE_CORNERS)
    assert on_soles.stands
    assert np.isclose(on_soles.tip, on_corners.tip, rtol=1e-12)


def test_one_sole_cannot_hold_a_humanoid_that_stands_between_both():
    margins = tw.stance_margins(HUMANOID, POSE, SOLES[:1])
    assert not margins.stands
    assert margins.friction_used == np.inf
    y = tw.frame_placement(HUMANOID, POSE, "left_sole").translation[1]
    assert np.isclose(margins.tip, -(y - SOLE[1] - tw.center_of_mass(HUMANOID, POSE)[1]), rtol=1e-12)
    assert "tips: the centre of mass is 0.0425 m outside" in margins.reason


def test_one_point_holds_what_stands_right_above_it_and_pulls_nothing_down():
    top = solid("top", 2.0, (0.2, 0.2, 0.4), {"foot": (0.0, 0.0, -0.2), "corner": (0.1, 0.1, -0.2)})
    q, rest, fall = top.neutral(), np.zeros(6), np.array([0, 0, 0, 0, 0, -20.0])
    right_above = tw.stance_margins(top, q, points(["foot"]))
    assert (right_above.stands, right_above.friction_used, right_above.tip) == (True, 0, 0)
    beside = tw.stance_margins(top, q, points(["corner"]))
    assert not beside.stands
    assert beside.tip == pytest.approx(-0.1 * np.sqrt(2), rel=1e-12)
    assert tw.friction_inverse_dynamics(top, q, rest, fall / 4, points(["foot"])).forces["foot"][2] == pytest.approx(
        9.62
    )
    with pytest.raises(tw.SingularError, match=r"break lift-off at 'foot' by 20\.4 N"):
        tw.friction_inverse_dynamics(top, q, rest, fall, points(["foot"]))


def test_two_points_cannot_hold_a_robot_that_is_not_above_their_line():
    margins = tw.stance_margins(GO2, GO2.standing(), FEET[:2])
    assert not margins.stands
    assert margins.tip < -0.1
    assert margins.reason.startswith("it falls: no forces at ['FL_foot', 'FR_foot'] do this")


def test_nothing_depends_on_where_gravity_points():
    """A box hung on a wall of a world whose gravity is along x stands as one on the floor."""
    builder = tw.Builder("box", base="floating", root="body", root_inertia=BOX.inertia[1], gravity=(-9.81, 0, 0))
    for name in ("fl", "fr", "rl", "rr"):
        builder.link(name, parent="body", placement=BOX.frame(name).placement)
    turned, turn = builder.build(), posed([0, np.pi / 2, 0], [0, 0, 0])
    here = tw.stance_margins(BOX, BOX.neutral(), BOX_CORNERS)
    there = tw.stance_margins(turned, turn, points(["fl", "fr", "rl", "rr"], normal=(1, 0, 0)))
    assert there.stands
    assert np.isclose(here.tip, there.tip, rtol=1e-12)
    assert here.tip == 0.2


@pytest.mark.parametrize(
    ("model", "q", "contacts", "said"),
    [
        (GO2, GO2.standing(), [], "expected a floating base, gravity and at least one contact"),
        (shared("planar_arm"), np.zeros(3), points(["tool"]), "expected a floating base"),
        (GO2, np.stack([GO2.standing()] * 2), FEET, r"q: expected one configuration, shape \(19,\), got \(2, 19\)"),
        (GO2, GO2.standing(), points(["FL_fot"]), "unknown frame 'FL_fot'"),
    ],
)
def test_what_cannot_stand_at_all_is_refused(model, q, contacts, said):
    with pytest.raises(ValueError, match=said):
        tw.stance_margins(model, q, contacts)

"""A scene: the smallest model with its contacts and wrenches, what it computes, and what it refuses."""

import importlib.util
import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import compile, fast, motions

from ..pages import DOCS, blocks, names_author_and_licence, page, run
from ..robots import shared
from ..sampling import sampled
from ..strategies import random_state
from ..truth import largest

SOLES = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), mu=0.7) for side in ("left", "right")]
FEET = [tw.PointContact(f"{leg}_foot", mu=0.7) for leg in ("FL", "FR", "RL", "RR")]
PAGES = [page("scenes", language) for language in ("", ".zh-CN")]
ARMS = ["*_shoulder_*", "*_elbow"]
GO2, HUMANOID = shared("go2"), shared("humanoid")
EVERYTHING = {"M", "h", "J_c", "A_G"}


def close(ours, right, bound=2e-14):
    assert np.shape(ours) == np.shape(right)
    assert largest(ours - right) <= bound * largest(right)


# ---------------------------------------------------------------- the smallest model


def test_the_scene_holds_the_smallest_model_and_keeps_all_frames():
    scene = tw.Scene(HUMANOID, contacts=SOLES, hold=ARMS)
    full = shared("humanoid")
    assert (scene.full_model.nv, scene.model.nv, scene.model.nbodies) == (27, 19, 15)
    assert scene.held == tuple(n for n in full.joint_names if "shoulder" in n or "elbow" in n)
    assert scene.contacts == tuple(SOLES)
    assert scene.model.frame_names == full.frame_names
    assert scene.model.mass == pytest.approx(full.mass, rel=1e-15)
    np.testing.assert_array_equal(scene.q, full.standing())
    hand = tw.frame_placement(scene.model, scene.model.standing(), "left_hand").matrix()
    np.testing.assert_allclose(
        hand, tw.frame_placement(full, full.standing(), "left_hand").matrix(), rtol=0, atol=1e-14
    )


def test_links_that_carry_nothing_are_dropped_unless_something_touches_them():
    builder = tw.Builder("mast", base="floating", root_inertia=tw.SpatialInertia(1, [0, 0, 0], np.eye(3)))
    builder.link("mast", parent="base_link", joint=tw.Revolute("z"), inertia=tw.SpatialInertia(1, [0, 0, 1], np.eye(3)))
    builder.link("camera", parent="mast", joint=tw.Revolute("y"))
    builder.link("weight", parent="camera", joint=tw.Revolute("x"), inertia=tw.SpatialInertia(1, [0, 0, 1], np.eye(3)))
    builder.link("flag", parent="mast", joint=tw.Revolute("y"))
    model = builder.build()
    scene = tw.Scene(model)
    assert (scene.idle, scene.model.nv) == (("flag",), 9)
    assert "flag" in scene.model.frames
    assert tw.Scene(model, hold=["weight"]).idle == ("flag",)
    assert tw.Scene(model, contacts=[tw.PointContact("flag", 0.5)]).idle == ()
    assert tw.Scene(model, wrenches={"flag": [0, 0, 0, 1, 0, 0]}).idle == ()
    assert "1 joint that carries nothing dropped, nv = 9 of 10" in repr(scene)


@pytest.mark.parametrize("base", ["fixed", "floating", "planar"])
def test_states_go_both_ways_on_every_base(base):
    scene = tw.Scene(GO2, base=base, hold=["F*"])
    q, v = scene.model.random_configuration(rng=1), np.arange(scene.model.nv) + 1.0
    Q, V = scene.expand(q, v)
    assert (Q.shape, V.shape) == ((19,), (18,))
    np.testing.assert_array_equal(Q[7:13], scene.q[7:13])
    for ours, right in zip(scene.reduce(Q, V), (q, v), strict=True):
        np.testing.assert_allclose(ours, right, rtol=0, atol=1e-14)
    assert scene.actuated.sum() == 6
    assert f"{base} base" in repr(scene)


def test_a_planar_base_slides_and_turns_on_the_floor_as_high_and_tilted_as_it_stood():
    """Beside the floating robot in the state that belongs to it: placements, twists, energy; M = XᵀM X."""
    full = shared("go2")
    stood = full.standing()
    stood[:7] = [1, 2, 0.4, *(np.array([0.1, -0.2, 0.5, 1.0]) / np.sqrt(1.3))]
    scene = tw.Scene(full, base="planar", q=stood)
    rest = np.zeros(18)
    close(scene.expand(*scene.reduce(stood, rest))[0], stood)
    model = scene.model
    q, v, a, *_ = random_state(model, rng=3)
    (Q, V), (_, A) = scene.expand(q, v), scene.expand(q, a)
    for frame in ("base", "FL_foot"):
        close(tw.frame_placement(model, q, frame).matrix(), tw.frame_placement(full, Q, frame).matrix())
        close(tw.frame_jacobian(model, q, frame) @ v, tw.frame_jacobian(full, Q, frame) @ V)
    close(tw.kinetic_energy(model, q, v), tw.kinetic_energy(full, Q, V))
    close(tw.potential_energy(model, q), tw.potential_energy(full, Q))
    columns = np.array([scene.expand(q, unit)[1] for unit in np.eye(15)]).T
    close(tw.crba(model, q), columns.T @ tw.crba(full, Q) @ columns)
    close(tw.rnea(model, q, v, a), columns.T @ tw.rnea(full, Q, V, A), 1e-13)
    assert np.ptp([scene.expand(model.random_configuration(rng=k), v)[0][2] for k in range(5)]) < 1e-15


def test_a_base_whose_x_axis_points_up_has_no_heading_and_still_goes_both_ways():
    full = shared("go2")
    stood = full.standing()
    stood[3:7] = [0, -np.sqrt(0.5), 0, np.sqrt(0.5)]
    scene = tw.Scene(full, base="planar", q=stood)
    close(scene.expand(*scene.reduce(stood, np.ones(18)))[0], stood)


def test_a_base_held_where_it_stands_is_fixed_to_the_world():
    scene = tw.Scene(GO2, base="fixed")
    model = scene.model
    assert (model.base, model.nv, scene.held) == ("fixed", 12, ())
    full = scene.full_model
    q, v, a, *_ = random_state(model, rng=0)
    (Q, V), (_, A) = scene.expand(q, v), scene.expand(q, a)
    close(tw.rnea(model, q, v, a), tw.rnea(full, Q, V, A)[6:])
    assert scene.actuated.all()


def test_a_pattern_that_fits_all_joints_leaves_the_base_what_it_is():
    scene = tw.Scene(GO2, hold=["*_joint"])
    assert (scene.model.nbodies, scene.model.nv, len(scene.held)) == (2, 6, 12)
    close(scene.model.inertia[1].matrix(), tw.crba(scene.full_model, scene.q)[:6, :6])


def test_gravity_is_the_scenes():
    moon = tw.Scene(HUMANOID, gravity=[0, 0, -1.62], hold=ARMS)
    q = moon.model.standing()
    h = moon.dynamics(q, np.zeros(19), want=["h"]).h
    close(h * 9.81 / 1.62, tw.Scene(HUMANOID, hold=ARMS).dynamics(q, np.zeros(19), want=["h"]).h)
    assert moon.full_model.gravity.tolist() == moon.model.gravity.tolist() == [0, 0, -1.62]


# ---------------------------------------------------------------- what it computes


@pytest.mark.one_case
@pytest.mark.parametrize("batch", sampled([(3, 1, 2), (1,), (20,), (0,), ()], 2))
@pytest.mark.parametrize("dtype", sampled([np.float64, np.float32, np.longdouble, complex], 2))
def test_dynamics_are_the_textbooks(batch, dtype):
    mixed = [SOLES[0], tw.PointContact("right_sole", 0.5), tw.PointContact("left_hand", 0.2)]
    scene = tw.Scene(HUMANOID, contacts=mixed, hold=["waist_yaw", "right_elbow"])
    q, v, *_ = random_state(scene.model, rng=4, batch=batch, dtype=dtype)
    d = scene.dynamics(q, v)
    right = tw.dynamics(scene.model, q, v)
    bound = 500 * np.finfo(dtype).eps
    close(d.J_c, tw.constraint_jacobian(scene.model, q, mixed), bound)
    for name in ("M", "h", "A_G"):
        close(getattr(d, name), getattr(right, name), bound)
    assert {x.dtype for x in vars(d).values()} == {np.dtype(dtype)}


def test_wrenches_from_outside_are_in_h():
    """The load on the hand and the push on the torso, by the virtual power of their world-aligned wrenches."""
    wrenches = {"left_hand": [0, 0, 0, 0, 0, -20.0], "torso": [3.0, 0, -2.0, 30.0, 0, 0]}
    scene = tw.Scene(HUMANOID, contacts=SOLES, hold=["*shoulder*"], wrenches=wrenches)
    model = scene.model
    q, v, a, *_ = random_state(model, rng=6)
    d = scene.dynamics(q, v)
    push = sum(tw.frame_jacobian(model, q, name, "local_world_aligned").T @ F for name, F in wrenches.items())
    close(d.h, tw.nonlinear_effects(model, q, v) - push)
    close(d.J_c, tw.constraint_jacobian(model, q, SOLES))
    close(d.M @ a + d.h, tw.rnea(model, q, v, a, scene.f_ext(q)))
    Q, V = scene.expand(q, v)
    whole = tw.Scene(HUMANOID, wrenches=wrenches)
    kept = [*range(6), *np.flatnonzero(np.isin(whole.model.joint_names[2:], model.joint_names[2:])) + 6]
    close(d.h, whole.dynamics(Q, V, want={"h"}).h[kept])
    batch = np.stack([q, q])
    close(scene.dynamics(batch, v, want={"h"}).h[1], d.h)
    assert scene.f_ext(batch).shape == (2, model.nbodies, 6)


def test_a_scene_may_have_wrenches_and_no_contacts():
    scene = tw.Scene(GO2, wrenches={"base": [1.0, 2.0, 3.0, 0, 0, 5.0]})
    q, v, a, *_ = random_state(scene.model, rng=8)
    d = scene.dynamics(q, v)
    assert d.J_c.shape == (0, 18)
    close(d.M @ a + d.h, tw.rnea(scene.model, q, v, a, scene.f_ext(q)))


# ---------------------------------------------------------------- how much work that is


def operations(scene, want):
    """Return how many operations the scene's program for some quantities has, with those that watch the state."""
    scene.model._programs.clear()
    d = scene.dynamics(scene.model.standing(), np.ones(scene.model.nv), want=want)
    assert {name for name, x in vars(d).items() if x is not None} == want
    (program,) = scene.model._programs.values()
    return program.operations.total()


@pytest.mark.slow
def test_only_what_is_wanted_is_computed_and_what_is_shared_once():
    scene = tw.Scene(GO2, contacts=FEET, hold=["RR_*"])
    alone = {name: operations(scene, {name}) for name in EVERYTHING}
    watched = operations(scene, set())
    assert alone["J_c"] < alone["M"]
    together = operations(scene, EVERYTHING)
    assert together - watched < sum(count - watched for count in alone.values())
    for name, count in alone.items():
        assert operations(scene, EVERYTHING - {name}) < together, name
        assert count - watched > 100


@pytest.mark.slow
def test_held_joints_are_no_work_and_the_rows_of_a_sole_that_no_one_asks_for_are_none():
    scene = tw.Scene(HUMANOID, contacts=SOLES, hold=ARMS)
    whole = tw.Scene(HUMANOID, contacts=SOLES)
    assert operations(scene, {"M", "J_c"}) < 0.75 * operations(whole, {"M", "J_c"})
    points = tw.Scene(HUMANOID, contacts=[tw.PointContact(sole.frame, 0.7) for sole in SOLES], hold=ARMS)
    assert operations(points, {"J_c"}) <= operations(scene, {"J_c"})
    jacobian = compile(scene.model, "contact_jacobian", contacts=[sole.frame for sole in SOLES])
    assert operations(points, {"J_c"}) == pytest.approx(jacobian.operations.total(), abs=4 * scene.model.nv)


# ---------------------------------------------------------------- whether it can stand


def test_a_robot_stands_within_its_polygon_and_its_friction_cones():
    tilt = shared("go2").standing()
    tilt[3:7] = [0, np.sin(0.3), 0, np.cos(0.3)]  # the trunk and the slope under it, by 0.6 rad

    def slope(mu):
        normal = (np.sin(0.6), 0, np.cos(0.6))
        return [tw.PointContact(foot.frame, mu, normal=normal) for foot in FEET]

    assert tw.Scene(GO2, contacts=FEET).can_stand()
    assert str(tw.Scene(GO2, contacts=FEET).can_stand()) == "it stands"
    assert tw.Scene(GO2, contacts=slope(0.75)).can_stand(tilt)  # tan 0.6 = 0.68, the pyramid keeps 0.98 of μ
    slips = tw.Scene(GO2, contacts=slope(0.65)).can_stand(tilt)
    assert not slips
    assert str(slips).startswith("cannot stand: it slips: it would need 1.07 times the friction")
    tips = tw.Scene(HUMANOID, contacts=SOLES[:1], hold=ARMS).can_stand()
    assert "the centre of mass is 0.02 m outside the support polygon" in str(tips)
    pair = tw.Scene(GO2, contacts=[FEET[0], FEET[3]]).can_stand()
    assert "no forces at ['FL_foot', 'RR_foot'] do this" in str(pair)


def test_a_pose_beyond_the_limits_is_none():
    scene = tw.Scene(GO2, contacts=FEET)
    q = scene.model.standing()
    q[9] = 0.5
    assert "joint 'FL_calf_joint' is at [0.5], outside its limits [-2.723] to [-0.838]" in str(scene.can_stand(q))


def weakened(limits: dict[str, float]) -> tw.Model:
    """Go2 with weaker motors: the limit of each joint named, N m."""
    model = shared("go2")
    effort = model.effort_limit.copy()
    for name, limit in limits.items():
        effort[model.v_slice[model.joint_id(name)]] = limit
    return replace(model, effort_limit=effort)


def test_on_three_smooth_feet_the_torques_are_what_they_are_and_a_motor_is_strong_enough_or_not():
    """Three vertical forces follow from the weight alone, so the knee needs one torque."""
    smooth = [tw.PointContact(foot.frame, 0.0) for foot in FEET[1:]]
    model = shared("go2")
    p, G = (np.array([tw.frame_placement(model, model.standing(), f.frame).translation for f in smooth]), None)
    G = tw.center_of_mass(model, model.standing())
    f = np.linalg.solve(np.stack([np.ones(3), *p[:, :2].T]), 9.81 * model.mass * np.array([1, *G[:2]]))
    J = np.stack([tw.contact_jacobian(model, model.standing(), [c.frame])[2] for c in smooth])
    tau = tw.gravity(model, model.standing()) - J.T @ f
    np.testing.assert_allclose(tau[:6], 0, rtol=0, atol=1e-11)
    knee = "RL_calf_joint"
    need = abs(float(tau[model.v_slice[model.joint_id(knee)]][0]))
    assert tw.Scene(weakened({knee: 1.001 * need}), contacts=smooth).can_stand()
    weak = tw.Scene(weakened({knee: 0.999 * need}), contacts=smooth).can_stand()
    assert f"that of {knee!r} would have to hold {need:.3g}" in str(weak)


@pytest.mark.slow
def test_weak_motors_are_spared_where_other_forces_do():
    """The smallest limit of all four knees with which it stands, by a linear programme and a second solver."""
    optimize = pytest.importorskip("scipy.optimize", reason="scipy is not installed: there is no second solver")
    model = shared("go2")
    q, rest, knees = model.standing(), np.zeros(18), [f"{leg}_calf_joint" for leg in ("FL", "FR", "RL", "RR")]
    J, g, k = tw.constraint_jacobian(model, q, FEET), tw.gravity(model, q), [model.joint_id(name) + 4 for name in knees]
    corners = np.pi / 8 * np.arange(16)
    pyramid = np.stack([np.cos(corners), np.sin(corners), np.full(16, -0.7 * np.cos(np.pi / 16))], axis=-1)
    cones = np.pad(np.kron(np.eye(4), pyramid), ((0, 0), (0, 1)))  # f, and last the largest torque t
    torques = [np.column_stack([sign * -J[:, k].T, -np.ones(4)]) for sign in (1, -1)]  # ±(g − Jᵀ f) ≤ t
    found = optimize.linprog(
        np.eye(13)[12],
        A_ub=np.concatenate([cones, *torques]),
        b_ub=np.concatenate([np.zeros(64), -g[k], g[k]]),
        A_eq=np.pad(J[:, :6].T, ((0, 0), (0, 1))),
        b_eq=g[:6],
        bounds=(None, None),
    )
    least = tw.friction_inverse_dynamics(model, q, rest, rest, FEET).tau[k]
    assert 0.1 < 1.001 * found.fun < 0.995 * abs(least).max()
    assert tw.Scene(weakened(dict.fromkeys(knees, 1.001 * found.fun)), contacts=FEET).can_stand()
    assert not tw.Scene(weakened(dict.fromkeys(knees, 0.999 * found.fun)), contacts=FEET).can_stand()


def test_what_pushes_the_robot_counts():
    feet = {"contacts": FEET}
    assert tw.Scene(GO2, **feet, wrenches={"base": [0, 0, 0, 0, 0, -400.0]}).can_stand()
    heavy = tw.Scene(GO2, **feet, wrenches={"base": [0, 0, 0, 0, 0, -4000.0]}).can_stand()
    assert "no forces at the contacts spare the motors" in str(heavy)
    pushed = tw.Scene(GO2, **feet, wrenches={"base": [0, 0, 0, 300.0, 0, 0]}).can_stand()
    assert "no forces within the limits do this; they would have to break lift-off at" in str(pushed)
    lifted = tw.Scene(GO2, **feet, wrenches={"base": [0, 0, 0, 0, 0, 160.0]})  # more than its weight of 157.8 N
    assert not lifted.can_stand()


@pytest.mark.parametrize("given", [{"base": "planar", "contacts": FEET}, {}, {"contacts": FEET, "gravity": [0, 0, 0]}])
def test_to_stand_takes_gravity_and_something_to_stand_on(given):
    with pytest.raises(ValueError, match="standing needs gravity, and a fixed base or a floating one with contacts"):
        tw.Scene(GO2, **given).can_stand()


def test_an_arm_holds_what_its_motors_hold():
    """By the moments of the weights about each joint, and with a hand on a table that takes some of them."""
    arm = shared("planar_arm")
    q = np.array([0.4, 0.5, 0.6])
    need = np.abs(tw.gravity(arm, q))
    for share, holds in ((1.001, True), (0.999, False)):
        strong = replace(arm, effort_limit=share * need)
        assert bool(tw.Scene(strong, q=q).can_stand()) == holds
        assert not tw.Scene(strong, q=q, payload={"tool": 0.01 * arm.mass}).can_stand()
    weak = replace(arm, effort_limit=need * [0.999, 2, 2])
    said = f"cannot hold: the motor of 'shoulder' would have to hold {need[0]:.3g}, and its limit is "
    assert str(tw.Scene(weak, q=q).can_stand()) == said + f"{0.999 * need[0]:.3g}"
    assert str(tw.Scene(weak, q=q, contacts=[tw.PointContact("tool", 0.6)]).can_stand()) == "it holds"


# ---------------------------------------------------------------- what it carries

BOX = tw.SpatialInertia.from_box(1.5, [0.2, 0.1, 0.3])
AT = tw.SE3(tw.exp3([0.3, -0.2, 0.5]), [0.1, 0.05, -0.2])


def crate():
    """A box with a named corner, as an object of its own."""
    builder = tw.Builder("crate", base="floating", root_inertia=BOX)
    builder.link("corner", parent="base_link", placement=tw.SE3(np.eye(3), [0.1, 0.05, -0.15]))
    return builder.build()


def test_a_payload_is_a_body_and_not_a_force():
    """It falls as the robot does; a force of its weight would make the robot fall faster."""
    rest = np.zeros(18)
    falls = tw.Scene(GO2, payload={"base": 2.0})
    model = falls.model
    assert falls.full_model.mass == pytest.approx(shared("go2").mass + 2.0, rel=1e-15)
    assert tw.aba(model, model.standing(), rest, rest)[3:6] == pytest.approx([0, 0, -9.81], abs=1e-12)
    pushed = tw.Scene(GO2, wrenches={"base": [0, 0, 0, 0, 0, -2 * 9.81]})
    a = tw.aba(pushed.model, model.standing(), rest, rest, pushed.f_ext(model.standing()))
    assert tw.centroidal_momentum_rate(model, model.standing(), rest, a)[5] < -9.81 * falls.full_model.mass
    assert repr(falls) == "<Scene 'go2': floating base, 1 payload, nv = 18 of 18>"


@pytest.mark.parametrize("frame", ["base", "FL_foot", "FR_hip_joint"])
def test_a_payload_moves_as_a_body_that_is_welded_on(frame):
    """As a replaced inertia, as an attached model, and in Pinocchio."""
    go2 = shared("go2")
    q, v, a, *_ = random_state(go2, rng=2)
    body, at = go2.frame(frame).body, go2.frame(frame).placement
    turned = BOX.transform(AT)
    mine = tw.Scene(go2, payload={frame: turned}).model
    in_frame = go2.inertia[body].transform(at.inverse())
    replaced = tw.replace_inertia(go2, frame, in_frame + turned)
    attached = tw.attach(go2, crate(), frame, placement=AT)
    for other in (replaced, attached):
        close(tw.rnea(mine, q, v, a), tw.rnea(other, q, v, a), 1e-13)
        close(tw.crba(mine, q), tw.crba(other, q), 1e-13)
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    there = tw.bridge.to_pinocchio_model(go2)
    inertia = tw.bridge.to_pinocchio_inertia(turned)
    there.appendBodyToJoint(there.frames[there.getFrameId(frame)].parentJoint, inertia, tw.bridge.to_pinocchio_se3(at))
    V, A = (tw.bridge.to_pinocchio_tangent(go2, x) for x in (v, a))
    tau = pin.rnea(there, there.createData(), q, V, A)
    close(tw.rnea(mine, q, v, a), tw.bridge.from_pinocchio_tangent(go2, tau), 1e-12)


@pytest.mark.slow
def test_an_object_that_is_carried_may_touch():
    """The humanoid holds a crate in its hand, whose corner it sets on something; what is held is one body more."""
    scene = tw.Scene(
        "humanoid", contacts=[*SOLES, tw.PointContact("crate_corner", 0.4)], payload={"left_hand": crate()}
    )
    whole = shared("humanoid")
    assert scene.full_model.nv == whole.nv
    assert scene.full_model.mass == pytest.approx(whole.mass + 1.5)
    q = scene.model.standing()
    corner = tw.frame_placement(whole, whole.standing(), "left_hand") @ tw.SE3(np.eye(3), [0.1, 0.05, -0.15])
    close(tw.frame_placement(scene.model, q, "crate_corner").matrix(), corner.matrix())
    assert scene.dynamics(q, np.zeros(scene.model.nv), want={"J_c"}).J_c.shape == (15, whole.nv)
    for base in ("fixed", "planar"):
        low = tw.Scene(HUMANOID, base=base, payload={"left_hand": 1.5})
        assert low.model.mass == pytest.approx(tw.Scene(HUMANOID, base=base).model.mass + 1.5)


def test_what_is_carried_counts_where_the_robot_stands():
    """2 kg at arm's length move the centre of mass, by their moment over the weight of both."""
    bare, heavy = (tw.Scene(HUMANOID, contacts=SOLES, payload=p).model for p in ({}, {"left_hand": 2.0}))
    q = bare.standing()
    hand, G = tw.frame_placement(bare, q, "left_hand").translation, tw.center_of_mass(bare, q)
    close(tw.center_of_mass(heavy, q), (bare.mass * G + 2.0 * hand) / (bare.mass + 2.0))
    assert tw.Scene(GO2, contacts=FEET, payload={"base": 10.0}).can_stand()
    too_much = tw.Scene(GO2, contacts=FEET, payload={"base": 300.0}).can_stand()
    assert "no forces at the contacts spare the motors" in str(too_much)


# ---------------------------------------------------------------- who touches when


@pytest.mark.one_case
@pytest.mark.parametrize("robot", ["go2", "humanoid"])
def test_the_phases_of_a_walk_are_scenes_whose_contacts_stand_still(robot):
    """J_c v = 0 and J_c a + J̇_c v = 0 in each phase, of point feet and of soles; their forces bear the motion."""
    model, contacts = tw.load(robot), FEET if robot == "go2" else SOLES
    walk, scene = motions.walk(model, samples=40), tw.Scene(robot, contacts=contacts)
    phases = scene.phases(walk)
    assert [phase.states.start for phase in phases] == [0, *(phase.states.stop for phase in phases[:-1])]
    assert phases[-1].states.stop == 40
    assert all(one.scene.contacts != two.scene.contacts for one, two in pairwise(phases))
    assert {len(phase.scene.contacts) for phase in phases} == ({3, 4} if robot == "go2" else {1, 2})
    for phase in phases:
        assert phase.scene.model is scene.model
        assert [phase.start, phase.end] == walk.t[phase.states][[0, -1]].tolist()
        q, v, a = (x[phase.states] for x in (walk.q, walk.v, walk.a))
        J = phase.scene.dynamics(q, v, want={"J_c"}).J_c
        assert np.abs(np.matvec(J, v)).max() < 1e-11
        found = tw.contact_inverse_dynamics(model, q, v, a, phase.scene.contacts)
        assert np.abs(found.residual).max() < 1e-9
        left = tw.rnea(model, q, v, a) - found.tau - np.matvec(J.mT, np.concatenate([*found.forces.values()], axis=-1))
        assert np.abs(left).max() < 1e-9


@pytest.mark.slow
def test_a_hand_on_a_rail_stays_and_a_robot_in_the_air_touches_nothing():
    rail = [*SOLES, tw.PointContact("left_hand", 0.5)]
    scene = tw.Scene(HUMANOID, contacts=rail)
    jump = motions.jump(shared("humanoid"), samples=20)
    names = [[c.frame for c in phase.scene.contacts] for phase in scene.phases(jump)]
    assert names == [["left_sole", "right_sole", "left_hand"], ["left_hand"], ["left_sole", "right_sole", "left_hand"]]
    assert scene.contacts == tuple(rail)
    both = tw.Scene(HUMANOID, contacts=[*SOLES, tw.LoopClosure("left_hand", "right_hand")])
    assert [len(phase.scene.contacts) for phase in both.phases(jump)] == [3, 1, 3]  # the hands hold each other
    walk = motions.walk(shared("humanoid"), samples=3)
    assert both.cheapest(1e-9, replace(walk, feet=(), contacts=np.zeros((3, 0), bool))).best.worst() < 1e-9
    assert tw.Scene(HUMANOID).phases(jump)[0].states == slice(0, 20)
    with pytest.raises(tw.ShapeError):
        scene.phases(motions.walk(shared("go2"), samples=2))


def test_in_an_elevator_the_feet_bear_the_robot_and_its_acceleration():
    """Feet that go up at 2 m/s²: m (g + a) on them, and the robot goes with them; on a belt nothing changes."""
    up, belt = (
        [replace(foot, **given) for foot in FEET] for given in ({"acceleration": (0, 0, 2)}, {"velocity": (1, 0, 0)})
    )
    lift, model = tw.Scene(GO2, contacts=up), shared("go2")
    rest, rise, along = np.zeros(18), np.r_[0, 0, 0, 0, 0, 2.0, np.zeros(12)], np.r_[0, 0, 0, 1.0, np.zeros(14)]
    tau = tw.contact_inverse_dynamics(model, model.standing(), rest, rise, FEET).tau
    found = tw.contact_forward_dynamics(lift.model, model.standing(), rest, tau, lift.contacts)
    assert sum(found.forces.values())[2] == pytest.approx(model.mass * 11.81)
    assert np.abs(found.qdd - rise).max() < 1e-9
    carried = tw.contact_forward_dynamics(model, model.standing(), along, tau, belt)
    assert np.abs(carried.slip).max() < 1e-15
    still = tw.contact_forward_dynamics(model, model.standing(), rest, tau, FEET)
    assert np.abs(carried.qdd - still.qdd).max() < 1e-9


# ---------------------------------------------------------------- what it refuses


@pytest.mark.parametrize(
    ("given", "error", "said"),
    [
        (
            {"contacts": [tw.PointContact("FL_fot", 0.7)]},
            tw.NameNotFound,
            "unknown frame 'FL_fot'.*did you mean 'FL_foot'",
        ),
        (
            {"hold": ["arm_*"]},
            tw.NameNotFound,
            r"'arm_\*' fits no joint of 'go2'; its joints are root_",
        ),
        ({"wrenches": {"hand": np.zeros(6)}}, tw.NameNotFound, "unknown frame 'hand'"),
        ({"payload": {"hand": 1.0}}, tw.NameNotFound, "unknown frame 'hand'"),
        ({"payload": {"base": 0}}, tw.ModelError, r"payload\['base'\]: expected a mass above 0, got 0"),
        ({"payload": {"base": "2 kg"}}, ValueError, r"payload\['base'\]: expected"),
        ({"payload": [2.0]}, TypeError, "payload: expected what is carried by the names of frames"),
        ({"payload": {"base": 1.0}, "base": "fixed"}, tw.ModelError, "payload on frame 'base': the scene holds"),
        ({"payload": {"base": shared("planar_arm")}}, tw.ModelError, "other: expected a floating base"),
        ({"wrenches": {"base": np.zeros(3)}}, tw.ShapeError, r"wrenches\['base'\]: expected shape"),
        ({"wrenches": {"base": np.zeros((2, 6))}}, tw.ShapeError, r"wrenches\['base'\]: expected shape \(6,\)"),
        ({"wrenches": {"base": [0, 0, 0, 0, 0, np.nan]}}, ValueError, r"wrenches\['base'\]: expected finite"),
        ({"contacts": FEET[:1], "base": "fixed", "hold": ["FL_*"]}, tw.ModelError, "frame 'FL_foot': the scene holds"),
        ({"base": "fixed", "wrenches": {"base": np.ones(6)}}, tw.ModelError, "wrench on frame 'base': the scene holds"),
        ({"contacts": [FEET[0], FEET[0]]}, tw.ModelError, "the same contact twice"),
        ({"contacts": [FEET[0], tw.PointContact("FL_foot", 0.3)]}, tw.ModelError, "contradict each other"),
        (
            {"contacts": [FEET[0], tw.SurfaceContact("FL_foot", (0.1, 0.1), 0.7)]},
            tw.ModelError,
            "contradict each other",
        ),
        (
            {"contacts": [FEET[0], tw.PointContact("FL_foot", 0.7, normal=(1, 0, 0))]},
            tw.ModelError,
            "contradict each other",
        ),
        ({"contacts": ["FL_foot"]}, TypeError, "expected contacts such as PointContact"),
        ({"contacts": FEET[0]}, TypeError, "expected a sequence of contacts"),
        ({"hold": "RR_*"}, ValueError, "got the string 'RR_"),
        ({"base": "flying"}, tw.ModelError, "base: expected 'fixed', 'floating' or 'planar', got 'flying'"),
        ({"hold": ["root_*"]}, tw.ModelError, "hold: 'root_joint' is the floating base; base='fixed' holds it"),
        ({"base": "fixed", "hold": ["*_joint"]}, tw.ModelError, "nothing is left to move"),
        ({"gravity": [0, 0]}, tw.ShapeError, "gravity: expected shape"),
        ({"gravity": np.zeros((2, 3))}, tw.ShapeError, r"gravity: expected shape \(3,\)"),
        ({"q": np.zeros(18)}, tw.ShapeError, "this looks like nv"),
        ({"q": np.tile(shared("go2").standing(), (2, 1))}, tw.ShapeError, "expected one real configuration"),
    ],
)
def test_a_scene_that_cannot_be_is_refused(given, error, said):
    with pytest.raises(error, match=said):
        tw.Scene(GO2, **given)


def test_friction_below_zero_is_refused_where_the_contact_is_made():
    with pytest.raises(ValueError, match=r"mu: expected at least 0, got -0\.1"):
        tw.Scene(GO2, contacts=[tw.PointContact("FL_foot", -0.1)])


def test_one_place_of_a_body_under_two_names_is_one_place():
    frames = shared("humanoid").frames
    assert frames["left_sole"].body == frames["left_sole_joint"].body
    with pytest.raises(tw.ModelError, match="the same contact twice"):
        tw.Scene(HUMANOID, contacts=[tw.PointContact("left_sole", 0.7), tw.PointContact("left_sole_joint", 0.7)])
    used = [tw.PointContact(name, 0.7) for name in ("left_sole", "left_sole_joint")]  # which remember their rows
    assert [one.directions.shape for one in used] == [(3, 6), (3, 6)]
    with pytest.raises(tw.ModelError, match="the same contact twice"):
        tw.Scene(HUMANOID, contacts=used)


def test_a_robot_that_is_none_or_has_no_such_base_is_refused():
    with pytest.raises(tw.NameNotFound, match="did you mean 'go2'"):
        tw.Scene("go3")
    for base in ("floating", "planar"):
        with pytest.raises(tw.ModelError, match="has a fixed base, not a " + base):
            tw.Scene(shared("planar_arm"), base=base)
    assert tw.Scene("planar_arm", base="floating").model.nv == 9


def test_a_quantity_or_a_state_that_is_none_is_refused():
    scene = tw.Scene(GO2, contacts=FEET, wrenches={"base": [0, 0, 0, 1, 0, 0]})
    q, v = scene.model.standing(), np.zeros(18)
    with pytest.raises(tw.NameNotFound, match="unknown quantity 'C'"):
        scene.dynamics(q, v, want={"M", "C"})
    with pytest.raises(ValueError, match="got the string 'M'"):
        scene.dynamics(q, v, want="M")
    with pytest.raises(tw.ShapeError, match="v: expected shape"):
        scene.dynamics(q, q)
    with pytest.raises(tw.ShapeError):
        scene.reduce(q, q)
    with pytest.raises(tw.ShapeError):
        scene.expand(v, v)
    with pytest.raises(tw.ShapeError):
        scene.f_ext(v)
    assert fast.dynamics(scene.model, q, v, want={"M"}).M.shape == (18, 18)


# ---------------------------------------------------------------- its page


@pytest.mark.slow
def test_the_page_runs_and_both_languages_have_the_same_code_and_numbers():
    english, chinese = PAGES
    sources, twins = (blocks(path.read_text(encoding="utf-8"), 0, 10**6) for path in (english, chinese))
    assert len(sources) == 8
    assert [block.strip("\n") for block in sources] == [block.strip("\n") for block in twins]
    rows = ([line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("| ")] for path in PAGES)
    ours, theirs = ([sorted(re.findall(r"\d[\d.e-]*", row)) for row in of_page] for of_page in rows)
    assert ours == theirs
    assert sum(map(bool, ours)) >= 10
    assert repr(run(english, sources)["scene"]) in english.read_text(encoding="utf-8")
    assert names_author_and_licence(english)
    assert names_author_and_licence(chinese)


@pytest.mark.slow(one_in=3)
def test_the_tables_of_the_page_are_what_its_command_finds(capsys):
    """The errors; times are of the day."""
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: the command of the page is not run")
    if "talos_reduced" not in [robot.name for robot in tw.robots()]:
        pytest.skip("example-robot-data is not installed: the tables of the page are not made again")
    path = DOCS / "pictures" / "scenes.py"
    spec = importlib.util.spec_from_file_location("scenes", path)
    command = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(command)
    text, talos = PAGES[0].read_text(encoding="utf-8"), tw.load("talos_reduced")
    scene = tw.Scene(talos, hold=command.HOLD)
    moving = command.Moving(scene)
    for rate in command.RATES[1:]:
        row = re.search(rf"^\| {rate:g} \|(.*)\|$", text, re.MULTILINE)[1].split("|")
        said = [float(x.strip(" %")) / (100 if "%" in x else 1) for x in row]
        found = [f(x) for x in moving.errors(rate) for f in (np.median, np.max)]
        np.testing.assert_allclose(said, found, rtol=0.06)
    scene = tw.Scene(
        talos, contacts=[tw.SurfaceContact(foot, (0.1, 0.06), mu=0.7) for foot in talos.feet], hold=command.HOLD
    )
    need = {"tau": 2.0, "of": command.LEGS, "cop": 0.005}
    found = scene.cheapest(need, motions.walk(talos), held_out=motions.trot(talos))
    for option in found.options:
        row = re.search(rf"^[ →] {re.escape(option.name)}  +(.*)$", text, re.MULTILINE)[1].split()[:5]
        assert (row[4] == "-") == np.isnan(option.operations)
        if (count := row.pop()) != "-":  # a better compiler has fewer
            assert float(count) == pytest.approx(option.operations, rel=0.06)
        for cell, (name, out) in zip(row, [(n, o) for n in ("tau", "cop") for o in (False, True)], strict=True):
            worst = option.worst(name, held_out=out) * (1e3 if name == "cop" else 1)
            if np.isfinite(worst):
                assert float(cell.strip(">")) == pytest.approx(worst, rel=0.06, abs=1e-9)
            else:
                assert cell == "-"
    capsys.readouterr()
    command.held_out()
    for printed in capsys.readouterr().out.splitlines():
        robot, margin, choice, quantity, *numbers = (cell.strip() for cell in printed.strip("|").split("|"))
        row = rf"^\| {robot} \| {margin} \| {re.escape(choice)} \| {quantity} \|(.*)\|$"
        said = re.search(row, text, re.MULTILINE)[1].split("|")
        np.testing.assert_allclose(list(map(float, said)), list(map(float, numbers)), rtol=0.06)


def test_wrenches_without_frames_are_refused():
    with pytest.raises(TypeError, match="wrenches: expected a mapping of frames to wrenches, got list"):
        tw.Scene(GO2, wrenches=[[0, 0, 0, 1, 0, 0]])

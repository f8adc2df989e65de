"""Forward dynamics under contact: closed forms, invariants, Pinocchio and the 50-digit truth."""

from __future__ import annotations

import sys

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as slow
from twistwrench.contact.decomposition import decompose

from ..strategies import Recipe
from ..touching import (
    BOX,
    BOX_CORNERS,
    FEET,
    GO2,
    HUMANOID,
    SOLE_CORNERS,
    SOLES,
    error,
    kkt,
    motors,
    points,
    posed,
    solid,
    straight,
)

H = 1e-20
RNG = np.random.default_rng(6)
TREE = Recipe(14, seed=4, base="floating", branching=0.7).model
TIPS = [TREE.joint_names[i] for i in range(1, TREE.nbodies) if i not in TREE.parent]
HANDS = [*points(TIPS[:2]), tw.SurfaceContact(TIPS[2], (0.1, 0.05), 0.6)]


@pytest.fixture(autouse=True)
def _the_same_numbers_in_any_order(monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "RNG", np.random.default_rng(6))


def moving(model, q, contacts):
    """A velocity that does not move the contacts."""
    return tw.impact(model, q, RNG.standard_normal(model.nv), contacts).v


CASES = {
    "box on four corners": (BOX, posed([0, 0, 0.3], [1, 2, 0.1]), None, BOX_CORNERS, 6),
    "box on four corners, tilted": (BOX, posed([0.1, 0.2, 0.3], [1, 2, 0.1]), None, BOX_CORNERS, 6),
    "box on two corners, tumbling": (BOX, posed([0.1, 0.2, 0.3], [1, 2, 0.1]), "moving", BOX_CORNERS[:2], 5),
    "Go2 on four feet, moving": (GO2, GO2.standing(), "moving", FEET, 12),
    "Go2, feet that slip": (GO2, GO2.standing(), "slipping", FEET, 12),
    "Go2, straight knees": (GO2, straight(plumb=False), None, FEET, 12),
    "Go2, straight knees, feet below the hips": (GO2, straight(plumb=True), None, FEET, 11),
    "humanoid on two soles, moving": (HUMANOID, HUMANOID.standing(), "moving", SOLES, 12),
    "humanoid on eight corners": (HUMANOID, HUMANOID.standing(), None, SOLE_CORNERS, 12),
    "a tree of joints of all kinds, moving": (TREE, TREE.random_configuration(rng=1), "moving", HANDS, 12),
}


def state(name):
    model, q, motion, contacts, rank = CASES[name]
    kinds = {
        None: lambda: np.zeros(model.nv),
        "moving": lambda: moving(model, q, contacts),
        "slipping": lambda: RNG.standard_normal(model.nv),
    }
    return model, q, kinds[motion](), motors(model, RNG), contacts, rank


def stacked(forces) -> np.ndarray:
    return np.concatenate(list(forces.values()))


# ---------------------------------------------------------------- 50 digits, Pinocchio


LONG = [name for name in CASES if name.endswith(("slip", "knees", "soles, moving", "kinds, moving"))]


@pytest.mark.one_case
@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.slow] * (n in LONG)) for n in CASES])
def test_accelerations_and_forces_are_those_of_the_50_digit_kkt_system(name):
    model, q, v, tau, contacts, rank = state(name)
    got, true = tw.contact_forward_dynamics(model, q, v, tau, contacts), kkt(model, q, v, tau, contacts)
    assert got.rank == true.rank == rank
    assert got.redundant == sum(c.dim for c in contacts) - rank
    assert error(got.qdd, true.qdd, size=9.81) < 1e-12
    assert error(stacked(got.forces), stacked(true.forces)) < 1e-12


@pytest.mark.parametrize("name", CASES)
def test_both_equations_are_solved_to_rounding(name):
    model, q, v, tau, contacts, _ = state(name)
    got = tw.contact_forward_dynamics(model, q, v, tau, contacts)
    J, force = tw.constraint_jacobian(model, q, contacts), stacked(got.forces)
    left = tw.rnea(model, q, v, got.qdd) - tau - J.T @ force
    assert np.abs(left).max() < 1e-12 * np.abs(J.T @ force).max()
    asked = J @ got.qdd + tw.constraint_bias(model, q, v, contacts)
    assert np.allclose(got.residual, asked, rtol=0, atol=1e-12 * np.abs(got.qdd).max())
    assert np.abs(got.residual).max() < 1e-12 * max(np.abs(got.qdd).max(), 9.81)


def test_a_wrench_from_outside_counts_as_in_the_truth():
    q, v, tau = GO2.standing(), moving(GO2, GO2.standing(), FEET), motors(GO2, RNG)
    f_ext = RNG.standard_normal((GO2.nbodies, 6))
    f_ext[0] = 0
    got = tw.contact_forward_dynamics(GO2, q, v, tau, FEET, f_ext)
    true = kkt(GO2, q, v, tau, FEET, f_ext)
    assert error(got.qdd, true.qdd) < 1e-12
    assert not np.allclose(got.qdd, tw.contact_forward_dynamics(GO2, q, v, tau, FEET).qdd)


def constraints(pin, there, contacts):
    """The contacts as Pinocchio's."""
    models, data = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    for c in contacts:
        frame = there.frames[there.getFrameId(c.frame)]
        kind = pin.ContactType.CONTACT_3D if c.dim == 3 else pin.ContactType.CONTACT_6D
        models.append(
            pin.RigidConstraintModel(kind, there, frame.parentJoint, frame.placement, pin.LOCAL_WORLD_ALIGNED)
        )
    for model in models:
        data.append(model.createData())
    return models, data


@pytest.mark.parametrize("name", [name for name in CASES if "tree" not in name and "tilted" not in name])
def test_accelerations_are_pinocchios(name):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its constrained dynamics is not asked")
    model, q, v, tau, contacts, rank = state(name)
    there = bridge.to_pinocchio_model(model)
    data, (models, datas) = there.createData(), constraints(pin, there, contacts)
    pin.initConstraintDynamics(there, data, models, datas)
    redundant = rank < sum(c.dim for c in contacts)
    proximal = pin.ProximalSettings(1e-14, 1e-14, 1e-8, 20) if redundant else pin.ProximalSettings(1e-14, 1e-14, 0.0, 1)
    state_there = (bridge.to_pinocchio_tangent(model, x) for x in (v, tau))
    a = pin.constraintDynamics(there, data, q, *state_there, models, datas, proximal)
    got = tw.contact_forward_dynamics(model, q, v, tau, contacts)
    assert error(got.qdd, bridge.from_pinocchio_tangent(model, a), size=9.81) < 1e-12
    if not redundant:
        for c, its in zip(contacts, datas, strict=True):
            force = bridge.from_pinocchio_force(its.contact_force)[c.rows]
            assert error(got.forces[c.frame], force, size=np.abs(stacked(got.forces)).max()) < 1e-12


# ---------------------------------------------------------------- closed forms


@pytest.mark.parametrize(("angle", "rate"), [(0.4, 0.0), (1.2, 2.0), (-2.5, -3.0)])
def test_a_flying_rod_held_at_one_end_is_a_pendulum(angle, rate):
    """θ̈ = −m g d sin θ / I about the pivot, d = l/2; what the pivot then bears is Newton's second law."""
    length, mass, g, d = 0.8, 1.5, 9.81, 0.4
    rod = solid("rod", mass, (0.02, 0.02, length), {"end": (0, 0, d)})
    about_pivot = mass / 12 * (length**2 + 0.02**2) + mass * d**2
    R = tw.exp3([0, -angle, 0])  # θ from hanging down, towards x
    q = posed([0, -angle, 0], -R @ [0, 0, d])
    omega = np.array([0, -rate, 0])
    v = np.r_[omega, np.cross(omega, [0, 0, -d])]
    held = tw.contact_forward_dynamics(rod, q, v, np.zeros(6), points(["end"]))
    speed_up = -mass * g * d * np.sin(angle) / about_pivot
    assert np.isclose(-held.qdd[1], speed_up, rtol=1e-13)
    along, across = R @ [0, 0, 1], R @ [1, 0, 0]
    assert np.isclose(held.forces["end"] @ along, mass * (g * np.cos(angle) + rate**2 * d), rtol=1e-13)
    assert np.isclose(held.forces["end"] @ across, mass * (d * speed_up + g * np.sin(angle)), rtol=1e-12)


def test_a_box_at_rest_stands_on_a_quarter_of_its_weight_at_each_corner():
    rest = np.zeros(6)
    held = tw.contact_forward_dynamics(BOX, posed([0, 0, 0], [0, 0, 0.1]), rest, rest, BOX_CORNERS)
    assert np.abs(held.qdd).max() < 1e-14 * 9.81
    for force in held.forces.values():
        assert np.allclose(force, [0, 0, BOX.mass * 9.81 / 4], rtol=0, atol=1e-13)


def test_the_acceleration_that_vanishes_is_that_of_the_material_point():
    """On a wheel that spins and slips: ω² r towards the axle. The linear half of the spatial one is ω × v less."""
    wheel = solid("wheel", 1.0, (0.5, 0.1, 0.5), {"rim": (0, 0, -0.25)})
    v = np.array([0, 3.0, 0, 2.0, 0, 0])  # 3 rad/s about the axle, which goes at 2 m/s; rolling would be 0.75
    bias = tw.constraint_bias(wheel, wheel.neutral(), v, points(["rim"]))
    axle = np.cross(v[:3], v[3:])  # q̈ = 0 keeps the velocity the same in the wheel's turning axes
    assert np.allclose(bias - axle, [0, 0, 3.0**2 * 0.25], rtol=0, atol=1e-14)
    spatial = tw.frame_bias_acceleration(wheel, wheel.neutral(), v, "rim")[3:]
    rim = np.array([2.0 - 0.75, 0, 0])
    assert np.allclose(bias - spatial, np.cross(v[:3], rim), rtol=0, atol=1e-14)


# ---------------------------------------------------------------- invariants


@pytest.mark.parametrize(
    ("model", "contacts"), [(GO2, FEET), (HUMANOID, SOLES), (TREE, HANDS)], ids=lambda x: str(x)[:14]
)
def test_jacobian_and_bias_are_derivatives_of_the_contacts_placements(model, contacts):
    q, v = model.random_configuration(rng=RNG), RNG.standard_normal(model.nv)
    J, bias = tw.constraint_jacobian(model, q, contacts), tw.constraint_bias(model, q, v, contacts)
    later = model.integrate(q, 1j * H * v)
    rate = (tw.constraint_jacobian(model, later, contacts) @ v).imag / H
    assert np.allclose(bias, rate, rtol=0, atol=1e-12 * max(np.abs(rate).max(), 1))
    now, then = tw.contact_placements(model, q, contacts), tw.contact_placements(model, later, contacts)
    moved = [
        np.r_[tw.unskew(then[c.frame].rotation.imag / H @ now[c.frame].rotation.T), then[c.frame].translation.imag / H]
        for c in contacts
    ]
    expected = np.concatenate([twist[c.rows] for c, twist in zip(contacts, moved, strict=True)])
    assert np.allclose(J @ v, expected, rtol=0, atol=1e-13 * max(np.abs(expected).max(), 1))


def test_jacobian_and_bias_are_those_of_the_frames():
    q, v = TREE.random_configuration(rng=RNG), RNG.standard_normal(TREE.nv)
    J, bias = tw.constraint_jacobian(TREE, q, HANDS), tw.constraint_bias(TREE, q, v, HANDS)
    frames = [tw.frame_jacobian(TREE, q, c.frame, "local_world_aligned")[c.rows] for c in HANDS]
    rates = [tw.frame_bias_acceleration(TREE, q, v, c.frame, "local_world_aligned")[c.rows] for c in HANDS]
    assert error(J.ravel(), np.concatenate(frames).ravel()) < 1e-13
    assert error(bias, np.concatenate(rates)) < 1e-13


@pytest.mark.parametrize("name", [name for name in CASES if "moving" in name])
def test_contacts_that_hold_do_no_work(name):
    model, q, v, tau, contacts, _ = state(name)
    held = tw.contact_forward_dynamics(model, q, v, tau, contacts)
    force = stacked(held.forces)
    assert np.abs(held.slip).max() < 1e-12
    assert abs(force @ held.slip) < 1e-12 * np.abs(force).max()
    energy = tw.kinetic_energy(model, q, v) + tw.potential_energy(model, q)
    h = 1e-20j
    later = model.integrate(q, h * v)
    power = (tw.kinetic_energy(model, later, v + h * held.qdd) + tw.potential_energy(model, later)).imag / 1e-20
    assert np.isclose(power, tau @ v, rtol=0, atol=1e-11 * max(energy, 1))


@pytest.mark.parametrize("name", ["box on four corners", "humanoid on eight corners"])
def test_redundant_forces_are_the_least_of_all_that_do_the_same(name):
    model, q, v, tau, contacts, _ = state(name)
    held = tw.contact_forward_dynamics(model, q, v, tau, contacts)
    force = stacked(held.forces)
    J = tw.constraint_jacobian(model, q, contacts)
    idle = np.linalg.svd(J.T)[2][int(held.rank) :]  # forces that press and do nothing
    assert np.abs(J.T @ idle.T).max() < 1e-13
    assert np.abs(idle @ force).max() < 1e-12 * np.abs(force).max()
    for press in idle:
        assert np.linalg.norm(force + 0.1 * press) > np.linalg.norm(force)


def test_a_sole_stands_for_the_least_forces_at_its_corners():
    q, tau = HUMANOID.standing(), motors(HUMANOID, RNG)
    v = moving(HUMANOID, q, SOLES)
    as_soles = tw.contact_forward_dynamics(HUMANOID, q, v, tau, SOLES)
    as_corners = tw.contact_forward_dynamics(HUMANOID, q, v, tau, SOLE_CORNERS)
    assert error(as_soles.qdd, as_corners.qdd) < 1e-12
    for sole in SOLES:
        at = tw.frame_placement(HUMANOID, q, sole.frame).translation
        names = [c.frame for c in SOLE_CORNERS if c.frame.startswith(sole.frame)]
        arms = [tw.frame_placement(HUMANOID, q, name).translation - at for name in names]
        wrench = sum(
            np.r_[np.cross(arm, as_corners.forces[name]), as_corners.forces[name]]
            for arm, name in zip(arms, names, strict=True)
        )
        assert np.allclose(as_soles.forces[sole.frame], wrench, rtol=0, atol=1e-11 * np.abs(wrench).max())


def test_nothing_depends_on_where_the_world_has_its_origin_and_its_x_axis():
    q, tau = HUMANOID.standing(), motors(HUMANOID, RNG)
    v = moving(HUMANOID, q, SOLES)
    T = tw.SE3(tw.exp3([0, 0, 2.0]), [3, -4, 5])
    moved = q.copy()
    moved[:3] = T.act(q[:3])
    half = np.array([0, 0, np.sin(1), np.cos(1)])
    x, y, z, w = q[3:7]
    moved[3:7] = [
        half[3] * x - half[2] * y,
        half[3] * y + half[2] * x,
        half[3] * z + half[2] * w,
        half[3] * w - half[2] * z,
    ]
    here = tw.contact_forward_dynamics(HUMANOID, q, v, tau, SOLES)
    there = tw.contact_forward_dynamics(HUMANOID, moved, v, tau, SOLES)
    assert error(there.qdd, here.qdd) < 1e-12
    for frame, force in here.forces.items():
        turned = np.r_[T.rotation @ force[:3], T.rotation @ force[3:]]
        assert np.allclose(there.forces[frame], turned, rtol=0, atol=1e-11 * np.abs(force).max())


@pytest.mark.parametrize("far", [0.0, 1e6])
@pytest.mark.parametrize(
    ("model", "q", "contacts", "rank"),
    [(BOX, BOX.neutral(), BOX_CORNERS, 6), (GO2, straight(plumb=True), FEET, 11)],
    ids=["box", "Go2"],
)
def test_the_rank_is_the_same_however_the_robot_lies_and_however_far_away(model, q, contacts, rank, far):
    for _ in range(8):
        moved = model.integrate(q, np.r_[RNG.standard_normal(3), np.zeros(model.nv - 3)])
        moved[:3] += far * RNG.standard_normal(3)
        got = tw.contact_forward_dynamics(model, moved, np.zeros(model.nv), motors(model, RNG), contacts)
        assert got.rank == rank
        assert np.abs(got.residual).max() < 1e-12


@pytest.mark.parametrize("exponent", [-6, 6])
def test_rank_and_forces_do_not_depend_on_the_units_of_the_joints(exponent):
    q, contacts = HUMANOID.standing(), SOLE_CORNERS
    M, J = tw.crba(HUMANOID, q), tw.constraint_jacobian(HUMANOID, q, contacts)
    unit = 10.0 ** RNG.uniform(-abs(exponent), abs(exponent), HUMANOID.nv)
    ask = J @ RNG.standard_normal(HUMANOID.nv)
    ours, theirs = decompose(HUMANOID, M, J), decompose(HUMANOID, M * unit * unit[:, None], J * unit)
    assert ours.rank == theirs.rank == 12
    _, forces = ours.respond(ask)
    assert np.allclose(theirs.respond(ask)[1], forces, rtol=0, atol=1e-11 * np.abs(forces).max())


@pytest.mark.parametrize("scale", [1e-9, 1e9])
def test_rank_does_not_depend_on_the_units_of_length_and_mass(scale):
    q, contacts = straight(plumb=True), FEET
    M, J = tw.crba(GO2, q), tw.constraint_jacobian(GO2, q, contacts)
    assert decompose(GO2, scale * M, J).rank == decompose(GO2, M, scale * J).rank == 11


@pytest.mark.parametrize("bend", [1e-3, 1e-6])
def test_knees_that_are_almost_straight_are_independent_again_and_nothing_blows_up(bend):
    q = straight(plumb=True)
    for foot in GO2.feet:
        q[GO2.q_slice[GO2.joint_id(f"{foot[:2]}_calf_joint")]] = bend
    rest = np.zeros(18)
    held = tw.contact_forward_dynamics(GO2, q, rest, motors(GO2, RNG), FEET)
    assert held.rank == 12
    assert np.abs(held.residual).max() < 1e-10
    assert np.isfinite(held.qdd).all()
    assert np.isfinite(stacked(held.forces)).all()


def test_batches_are_single_states_and_no_contacts_are_free_motion():
    q = np.stack([GO2.standing(), straight(plumb=True), straight(plumb=False)])
    v, tau = np.zeros((2, 1, 18)), RNG.standard_normal((2, 1, 18))
    many = tw.contact_forward_dynamics(GO2, q, v, tau, FEET)
    assert many.qdd.shape == (2, 3, 18)
    assert (many.rank == [[12, 11, 12]] * 2).all()
    one = tw.contact_forward_dynamics(GO2, q[1], v[1, 0], tau[1, 0], FEET)
    assert np.allclose(many.qdd[1, 1], one.qdd, rtol=0, atol=1e-12 * np.abs(one.qdd).max())
    assert np.allclose(many.forces["RL_foot"][1, 1], one.forces["RL_foot"], rtol=0, atol=1e-11)
    free = tw.contact_forward_dynamics(GO2, q[0], v[1, 0], tau[1, 0], [])
    assert error(free.qdd, tw.aba(GO2, q[0], v[1, 0], tau[1, 0])) < 1e-12
    assert free.rank == 0
    assert free.forces == {}


# ---------------------------------------------------------------- Baumgarte


def test_stabilisation_asks_for_a_spring_and_a_damper():
    q0 = HUMANOID.standing()
    anchors = tw.contact_placements(HUMANOID, q0, SOLES)
    step = 1e-5 * RNG.standard_normal(HUMANOID.nv)
    q, v = HUMANOID.integrate(q0, step), 1e-5 * RNG.standard_normal(HUMANOID.nv)
    J = tw.constraint_jacobian(HUMANOID, q, SOLES)
    got = tw.contact_forward_dynamics(HUMANOID, q, v, 0 * v, SOLES, stabilise=tw.Baumgarte(30.0, anchors, damping=0.7))
    is_now = J @ got.qdd + tw.constraint_bias(HUMANOID, q, v, SOLES)
    asked = -2 * 0.7 * 30.0 * (J @ v) - 30.0**2 * (J @ step)  # J step is the error but for its square
    assert np.allclose(is_now, asked, rtol=0, atol=1e-3 * np.abs(asked).max())
    assert np.abs(got.residual).max() < 1e-11


def flail() -> tw.Model:
    """Two rods on a hinge, the first with a hook at its end."""
    rod = tw.SpatialInertia(1.0, [0, 0, -0.5], np.diag([0.08, 0.08, 0.001]))
    builder = tw.Builder("flail", base="floating", root="upper", root_inertia=rod)
    builder.link("lower", parent="upper", joint=tw.Revolute("y"), inertia=rod, placement=tw.SE3(np.eye(3), [0, 0, -1]))
    builder.link("hook", parent="lower", placement=tw.SE3(np.eye(3), [0, 0, -1]))
    return builder.build()


def test_a_stabilised_contact_comes_back_and_others_drift_away():
    """Two rods swing on a hook for 0.8 s in steps of 10 ms."""
    model, hook = flail(), points(["hook"])
    q0 = np.r_[posed([0.5, 0.9, 0], [0, 0, 0]), 0.7]
    anchors = tw.contact_placements(model, q0, hook)
    far = {}
    for stabilise in (None, tw.Baumgarte(40.0, anchors)):
        q, v, dt = q0, np.zeros(7), 1e-2
        for _ in range(80):
            v = v + dt * tw.contact_forward_dynamics(model, q, v, 0 * v, hook, stabilise=stabilise).qdd
            q = model.integrate(q, dt * v)
        now = tw.contact_placements(model, q, hook)["hook"].translation
        far[stabilise is None] = float(np.abs(now - anchors["hook"].translation).max())
    assert far[True] > 0.01
    assert far[False] < 0.1 * far[True]


# ---------------------------------------------------------------- what is refused


def test_contacts_that_contradict_each_other_are_named():
    """A straight leg that bends pulls its foot up while the other three carry the base: no q̈ gives all of it."""
    q, v = straight(plumb=True), np.zeros(18)
    v[GO2.v_slice[GO2.joint_id("FL_thigh_joint")]] = -1
    v[GO2.v_slice[GO2.joint_id("FL_calf_joint")]] = 2
    assert np.abs(tw.constraint_jacobian(GO2, q, FEET) @ v).max() < 1e-15  # the feet do stand still
    with pytest.raises(
        tw.SingularError, match=r"contradict each other: no acceleration keeps all at rest; 'FL_foot' 0\.1"
    ):
        tw.contact_forward_dynamics(GO2, q, v, 0 * v, FEET)
    with pytest.raises(tw.SingularError, match=r"contradict each other at index \(1,\)"):
        tw.contact_forward_dynamics(GO2, q, np.stack([0 * v, v]), 0 * v, FEET)


def test_a_velocity_that_the_contacts_forbid_is_told():
    v = np.array([0, 0, 0, 0.1, 0, 0])
    sliding = tw.contact_forward_dynamics(BOX, BOX.neutral(), v, 0 * v, BOX_CORNERS)
    assert np.allclose(sliding.slip.reshape(4, 3), [0.1, 0, 0], rtol=0, atol=1e-15)
    around = tw.contact_forward_dynamics(BOX, BOX.neutral(), [0, 0, 3.0, 0, 0, 0], 0 * v, BOX_CORNERS)
    told = around.residual.reshape(4, 3)  # corners that go round keep some of ω² r, towards the middle
    assert np.allclose(np.abs(told), [9 * 0.3, 9 * 0.2, 0], rtol=1e-12, atol=1e-12)


def test_a_joint_that_moves_nothing_is_named():
    builder = tw.Builder("hat", base="floating", root="body", root_inertia=tw.SpatialInertia(1, [0, 0, 0], np.eye(3)))
    builder.link("hat", parent="body", joint=tw.Revolute("z"))
    model = builder.build()
    rest = np.zeros(7)
    with pytest.raises(tw.SingularError, match="no inertia outboard of joint 'hat'"):
        tw.contact_forward_dynamics(model, model.neutral(), rest, rest, points(["body"]))
    with pytest.raises(tw.SingularError, match=r"not positive definite: no inertia outboard of joint 'hat'$"):
        tw.impact(model, model.neutral(), rest, points(["body"]))
    builder = tw.Builder("two slides along one line")
    builder.link("first", parent="base_link", joint=tw.Prismatic("x"))
    builder.link("second", parent="first", joint=tw.Prismatic("x"), inertia=tw.SpatialInertia(1, [0, 0, 0], np.eye(3)))
    with pytest.raises(tw.SingularError, match="some joints have none when moved together"):
        tw.impact(builder.build(), [0.0, 0.0], [1.0, 0.0], points(["second"]))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"v": np.zeros(17)}, r"v: expected shape \(..., 18\)"),
        ({"tau": np.full(18, np.nan)}, "tau: expected finite"),
        ({"q": GO2.standing() + 0j}, "q: expected real numbers"),
        ({"f_ext": np.zeros((13, 6))}, "f_ext: expected shape"),
        ({"stabilise": tw.Baumgarte(1.0, {"FL_foot": tw.SE3.identity()})}, "unknown anchor 'FR_foot'"),
        ({"stabilise": tw.Baumgarte(1.0, {})}, "unknown anchor 'FL_foot'; known: none"),
    ],
)
def test_a_wrong_argument_is_named(change, said):
    given = {"q": GO2.standing(), "v": np.zeros(18), "tau": np.zeros(18), "contacts": FEET} | change
    with pytest.raises(ValueError, match=said):
        tw.contact_forward_dynamics(GO2, **given)


@pytest.mark.parametrize(("frequency", "damping"), [(0, 1), (-1, 1), (np.nan, 1), (np.inf, 1), (1, -1), (1, np.nan)])
def test_a_stabilisation_out_of_bounds_is_refused(frequency, damping):
    with pytest.raises(ValueError, match="expected a number"):
        tw.Baumgarte(frequency, {}, damping=damping)


def test_what_is_no_stabilisation_is_refused():
    with pytest.raises(TypeError, match="anchors: expected placements by frame, as from contact_placements, got None"):
        tw.Baumgarte(20.0, None)
    with pytest.raises(TypeError, match=r"stabilise: expected a Baumgarte or None, got 20\.0"):
        tw.contact_forward_dynamics(GO2, GO2.standing(), np.zeros(18), np.zeros(18), FEET, stabilise=20.0)


def test_the_truth_is_50_digits():
    v = np.zeros(6)
    assert isinstance(kkt(BOX, BOX.neutral(), v, v, BOX_CORNERS[:3]).qdd[0], type(slow.as_mpmath(np.ones(1))[0]))


# ---------------------------------------------------------------- the catalogue

WALKERS = ["g1", "talos_reduced", "solo12", "solo8", "hyq", "anymal_c", "centauro", "bolt", "talos_full_v2"]


@pytest.mark.slow
@pytest.mark.parametrize("name", WALKERS)
def test_both_equations_hold_on_robots_of_the_catalogue_wherever_they_are(name):
    if name not in [robot.name for robot in tw.robots()]:
        pytest.skip("example-robot-data is not installed")
    model = tw.load(name)
    for contacts in (points(model.feet), [tw.SurfaceContact(foot, (0.1, 0.05), 0.6) for foot in model.feet]):
        for q in (model.standing(), model.neutral(), model.random_configuration(rng=RNG)):
            rest, tau = np.zeros(model.nv), motors(model, RNG)
            got = tw.contact_forward_dynamics(model, q, rest, tau, contacts)
            push = tw.constraint_jacobian(model, q, contacts).T @ stacked(got.forces)
            left = tw.rnea(model, q, rest, got.qdd) - tau - push
            assert np.abs(left).max() < 1e-10 * np.abs(push).max()
            assert np.abs(got.residual).max() < 1e-10
            assert got.rank + got.redundant == sum(c.dim for c in contacts)


def test_a_singular_mass_matrix_is_named_where_numpy_gives_nan_instead_of_raising(monkeypatch):
    """NumPy built for a browser has no floating-point flags, and raises no LinAlgError."""
    body = points(["body"])
    assert np.isfinite(body[0].grasp_cholesky).all()  # made once, before
    monkeypatch.setattr(np.linalg, "cholesky", lambda M: np.full_like(M, np.nan))
    builder = tw.Builder("hat", base="floating", root="body", root_inertia=tw.SpatialInertia(1, [0, 0, 0], np.eye(3)))
    builder.link("hat", parent="body", joint=tw.Revolute("z"))
    model = builder.build()
    with pytest.raises(tw.SingularError, match=r"not positive definite: no inertia outboard of joint 'hat'$"):
        tw.impact(model, model.neutral(), np.zeros(7), body)

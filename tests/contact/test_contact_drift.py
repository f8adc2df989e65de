"""Redundant contacts that have drifted: the least-squares acceleration, and no word of a contradiction."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge

from ..sampling import sampled
from ..touching import BOX, BOX_CORNERS, FEET, GO2, HUMANOID, SOLE_CORNERS, straight

STANDS = [(BOX, BOX_CORNERS, BOX.neutral()), (GO2, FEET, GO2.standing()), (HUMANOID, SOLE_CORNERS, HUMANOID.standing())]


def least_squares(model, q, v, tau, contacts, target):
    """Of all accelerations that bring J q̈ nearest to a target, the nearest to the free one, by a pseudo-inverse."""
    free, L = tw.aba(model, q, v, tau), np.linalg.cholesky(tw.crba(model, q))
    Y = np.linalg.solve(L, tw.constraint_jacobian(model, q, contacts).T).T
    x = np.linalg.pinv(Y, rcond=1e-10) @ (target - tw.constraint_jacobian(model, q, contacts) @ free)
    return free + np.linalg.solve(L.T, x)


@pytest.mark.parametrize("rate", [1e-6, 1e-3, 1.0, 30.0])
def test_a_box_that_turns_on_four_points_has_a_least_squares_acceleration(rate):
    q, v, rest = BOX.neutral(), np.r_[rate * np.array([0.3, -0.7, 1.0]), 0.1 * rate, 0, 0], np.zeros(6)
    held = tw.contact_forward_dynamics(BOX, q, v, rest, BOX_CORNERS)
    want = least_squares(BOX, q, v, rest, BOX_CORNERS, -tw.constraint_bias(BOX, q, v, BOX_CORNERS))
    assert (held.rank, held.redundant) == (6, 6)
    assert np.abs(held.qdd - want).max() < 1e-12 * (10 + rate**2)
    assert np.abs(held.residual).max() < rate**2
    balance = tw.rnea(BOX, q, v, held.qdd) - tw.constraint_jacobian(BOX, q, BOX_CORNERS).T @ np.concatenate(
        list(held.forces.values())
    )
    assert np.abs(balance).max() < 1e-11 * (BOX.mass * 9.81 + rate**2)


@pytest.mark.parametrize(("frequency", "drift"), [(20.0, 1e-4), (100.0, 1e-5), (20.0, 1e-2)])
def test_a_spring_brings_redundant_contacts_back(frequency, drift):
    q = BOX.integrate(BOX.neutral(), drift * np.array([1.0, 0.4, -0.3, 0.2, -1, 0.5]))
    spring = tw.Baumgarte(frequency, tw.contact_placements(BOX, BOX.neutral(), BOX_CORNERS))
    held = tw.contact_forward_dynamics(BOX, q, np.zeros(6), np.zeros(6), BOX_CORNERS, stabilise=spring)
    assert np.abs(held.residual).max() < (frequency * drift) ** 2  # of second order
    way = BOX.difference(q, BOX.neutral())
    assert held.qdd @ way > 0.9 * np.linalg.norm(held.qdd) * np.linalg.norm(way)


def pinocchios(pin, model, q, v, tau, contacts, spring, axes):
    """The acceleration of Pinocchio's proximal solver, with a corrector on each point."""
    there = bridge.to_pinocchio_model(model)
    models, datas = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    for c in contacts:
        frame, anchor = there.frames[there.getFrameId(c.frame)], spring.anchors[c.frame]
        ground = pin.SE3(np.array(anchor.rotation), np.array(anchor.translation))
        point = (frame.parentJoint, frame.placement, 0, ground)
        models.append(pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, there, *point, axes))
    for one in models:
        gains = getattr(one, "m_baumgarte_parameters", None) or one.corrector
        gains.Kp, gains.Kd = spring.frequency**2, 2 * spring.damping * spring.frequency
        datas.append(one.createData())
    data = there.createData()
    pin.initConstraintDynamics(there, data, models, datas)
    state_there = (bridge.to_pinocchio_tangent(model, x) for x in (v, tau))
    settings = pin.ProximalSettings(1e-14, 1e-14, 1e-8, 20)
    return bridge.from_pinocchio_tangent(
        model, pin.constraintDynamics(there, data, q, *state_there, models, datas, settings)
    )


@pytest.mark.one_case
@pytest.mark.parametrize(("drift", "speed"), [(1e-2, 0.1), (0, 0), (1e-4, 0), (1e-3, 1e-3)])
@pytest.mark.parametrize(("model", "contacts", "q"), STANDS, ids=["box", "go2", "humanoid"])
def test_corrected_accelerations_are_pinocchios(model, contacts, q, drift, speed):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its correctors are not asked")
    rng, spring = np.random.default_rng(0), tw.Baumgarte(20.0, tw.contact_placements(model, q, contacts), 0.7)
    q = model.integrate(q, drift * rng.standard_normal(model.nv))
    v, tau = speed * rng.standard_normal(model.nv), rng.standard_normal(model.nv)
    held = tw.contact_forward_dynamics(model, q, v, tau, contacts, stabilise=spring)
    for axes in (pin.LOCAL, pin.LOCAL_WORLD_ALIGNED):
        want = pinocchios(pin, model, q, v, tau, contacts, spring, axes)
        # What the points ask in contradiction, Pinocchio's multipliers gather in each of its steps, at 1e-8 of it.
        room = 1e-12 * (10 + np.abs(want).max()) + 1e-4 * np.abs(held.residual).max()
        assert np.abs(held.qdd - want).max() < room


def test_a_corrector_brings_a_box_on_four_points_back_as_fast_as_its_frequency():
    home = BOX.neutral()
    anchors = tw.contact_placements(BOX, home, BOX_CORNERS)
    q, v, dt = BOX.integrate(home, 1e-2 * np.array([1.0, 0.4, -0.3, 0.2, -1, 0.5])), np.zeros(6), 1e-3
    start = np.abs(BOX.difference(home, q)).max()
    for _ in range(500):
        held = tw.contact_forward_dynamics(BOX, q, v, np.zeros(6), BOX_CORNERS, stabilise=tw.Baumgarte(20.0, anchors))
        v = v + dt * held.qdd
        q = BOX.integrate(q, dt * v)
    left = np.abs(BOX.difference(home, q)).max() / start
    assert left < 10 * 11 * np.exp(-10.0)  # (1 + ωt) e^(−ωt), and what is left by steps of ω dt = 0.02


def test_a_spring_keeps_its_anchors_when_the_callers_change():
    anchors = tw.contact_placements(BOX, BOX.neutral(), BOX_CORNERS)
    spring = tw.Baumgarte(20.0, anchors)
    anchors.clear()
    assert spring.anchors.keys() == {"fl", "fr", "rl", "rr"}


@pytest.mark.slow
@pytest.mark.parametrize("dt", sampled([0.02, 0.01, 0.005], 1))
def test_a_humanoid_sinks_on_its_eight_corners_as_on_its_soles(dt):
    q, v = HUMANOID.standing(), 0.5 * np.random.default_rng(1).standard_normal(HUMANOID.nv)
    q, v = tw.project_state(HUMANOID, q, v, SOLE_CORNERS, tw.contact_placements(HUMANOID, q, SOLE_CORNERS))
    motion = tw.simulate(HUMANOID, q, v, dt=dt, duration=0.4, contacts=SOLE_CORNERS)
    soles = [tw.SurfaceContact(f"{side}_sole", (0.076, 0.0275), 0.6) for side in ("left", "right")]
    same = tw.simulate(HUMANOID, q, v, dt=dt, duration=0.4, contacts=soles)
    assert np.abs(HUMANOID.difference(motion.q[-1], same.q[-1])).max() < 2e-3 * (dt / 0.005) ** 3


def test_what_contradicts_itself_without_drift_is_still_refused():
    q, v, rest = straight(plumb=True), np.zeros(18), np.zeros(18)
    v[GO2.v_slice[GO2.joint_id("FL_thigh_joint")]], v[GO2.v_slice[GO2.joint_id("FL_calf_joint")]] = -1, 2
    for more in (0.0, 0.1):  # with drift on top, too
        with pytest.raises(tw.SingularError, match=r"the contacts contradict each other: .* 'FL_foot' .* is left"):
            tw.contact_forward_dynamics(GO2, q, v + np.r_[0, more, np.zeros(16)], rest, FEET)
    spring = tw.Baumgarte(20.0, tw.contact_placements(GO2, GO2.integrate(q, np.full(18, 1e-3)), FEET))
    with pytest.raises(tw.SingularError, match="the contacts contradict each other"):
        tw.contact_forward_dynamics(GO2, q, v, rest, FEET, stabilise=spring)


def test_in_a_batch_only_the_state_that_contradicts_is_named():
    q, v = np.stack([straight(plumb=True)] * 3), np.zeros((3, 18))
    v[1, 0] = 1e-3
    v[2, GO2.v_slice[GO2.joint_id("FL_thigh_joint")]], v[2, GO2.v_slice[GO2.joint_id("FL_calf_joint")]] = -1, 2
    with pytest.raises(tw.SingularError, match=r"contradict each other at index \(2,\)"):
        tw.contact_forward_dynamics(GO2, q, v, 0 * v, FEET)
    tw.contact_forward_dynamics(GO2, q[:2], v[:2], 0 * v[:2], FEET)

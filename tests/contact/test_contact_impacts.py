"""Impacts, and the way back to where the contacts hold."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as slow

from ..touching import (
    BOX,
    BOX_CORNERS,
    FEET,
    GO2,
    HUMANOID,
    SOLE_CORNERS,
    SOLES,
    error,
    independent,
    points,
    posed,
    solid,
    solve,
    straight,
)
from .test_contact_dynamics import constraints

CASES = {
    "box on four corners": (BOX, posed([0.1, 0.2, 0.3], [1, 2, 0.1]), BOX_CORNERS),
    "box on one corner": (BOX, posed([0.1, 0.2, 0.3], [1, 2, 0.1]), BOX_CORNERS[:1]),
    "Go2": (GO2, GO2.standing(), FEET),
    "Go2, straight knees": (GO2, straight(plumb=True), FEET),
    "humanoid on soles": (HUMANOID, HUMANOID.standing(), SOLES),
    "humanoid on corners": (HUMANOID, HUMANOID.standing(), SOLE_CORNERS),
}


def falling(name):
    model, q, contacts = CASES[name]
    return model, q, np.random.default_rng(7).standard_normal(model.nv), contacts


def stacked(forces):
    return np.concatenate(list(forces.values()))


# ---------------------------------------------------------------- impacts


@pytest.mark.parametrize("tilt", [0.0, 0.5, -1.2])
def test_a_rod_that_falls_on_one_end_turns_about_it_as_the_textbook_says(tilt):
    """ω = 6 v cos θ d / (l² + t² + 12 d²), d = l/2, of a rod that falls without turning: 3 v cos θ / 2 l if thin."""
    length, mass, fall = 0.8, 1.5, 2.0
    rod = solid("rod", mass, (length, 0.02, 0.02), {"end": (-length / 2, 0, 0)})
    q = posed([0, -tilt, 0], [0, 0, 1])  # the other end is higher where θ > 0
    R = tw.exp3([0, -tilt, 0])
    v = np.r_[0, 0, 0, R.T @ [0, 0, -fall]]
    hit = tw.impact(rod, q, v, points(["end"]))
    about_end = mass / 12 * (length**2 + 0.02**2) + mass * length**2 / 4
    omega = mass * fall * np.cos(tilt) * length / 2 / about_end
    assert np.isclose(omega, 1.5 * fall * np.cos(tilt) / length, rtol=2e-4)
    assert np.allclose(hit.v[:3], [0, omega, 0], rtol=0, atol=1e-13)  # the free end comes down
    assert np.isclose(hit.energy_lost, mass * fall**2 / 2 - about_end * omega**2 / 2, rtol=1e-12)
    rises = mass * (fall - omega * length / 2 * np.cos(tilt))  # of the centre of mass: what stopped it partly
    assert np.isclose(hit.impulses["end"][2], rises, rtol=1e-12)


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("name", CASES)
def test_impulses_are_what_changes_the_momenta_and_no_energy_is_gained(name, restitution):
    model, q, v, contacts = falling(name)
    hit = tw.impact(model, q, v, contacts, restitution=restitution)
    J, M = tw.constraint_jacobian(model, q, contacts), tw.crba(model, q)
    change = M @ (hit.v - v)
    assert np.allclose(change, J.T @ stacked(hit.impulses), rtol=0, atol=1e-12 * np.abs(change).max())
    assert np.allclose(J @ hit.v, -restitution * J @ v, rtol=0, atol=1e-12 * np.abs(J @ v).max())
    before, after = tw.kinetic_energy(model, q, v), tw.kinetic_energy(model, q, hit.v)
    assert hit.energy_lost >= 0
    assert np.isclose(hit.energy_lost, before - after, rtol=0, atol=1e-12 * before)
    if restitution < 1:
        assert hit.energy_lost > 1e-3 * before


def test_one_more_impact_at_once_changes_nothing():
    model, q, v, contacts = falling("humanoid on corners")
    once = tw.impact(model, q, v, contacts)
    twice = tw.impact(model, q, once.v, contacts)
    assert error(twice.v, once.v) < 1e-13
    assert twice.energy_lost < 1e-24 * once.energy_lost
    assert (once.rank, once.redundant) == (12, 12)


@pytest.mark.parametrize("name", ["box on one corner", "Go2, straight knees"])
def test_impacts_are_those_of_the_50_digit_kkt_system(name):
    model, q, v, contacts = falling(name)
    hit = tw.impact(model, q, v, contacts, restitution=0.3)
    q, v = slow.as_mpmath(q), slow.as_mpmath(v)
    J = np.concatenate([slow.frame_jacobian(model, q, c.frame, "local_world_aligned")[3:] for c in contacts])
    B, M = J[independent(J)], slow.mass_matrix(model, q)
    K = np.block([[M, -B.T], [B, np.zeros((len(B),) * 2, int)]])
    e = slow.as_mpmath(np.array(0.3)).item()
    after = solve(K, np.concatenate([M.dot(v), -e * B.dot(v)]))[: model.nv]
    assert error(hit.v, after) < 1e-12


@pytest.mark.parametrize("name", ["box on one corner", "Go2", "humanoid on soles"])
def test_impacts_are_pinocchios(name):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its impulse dynamics is not asked")
    model, q, v, contacts = falling(name)
    there = bridge.to_pinocchio_model(model)
    data, (models, datas) = there.createData(), constraints(pin, there, contacts)
    pin.initConstraintDynamics(there, data, models, datas)
    after = pin.impulseDynamics(there, data, q, bridge.to_pinocchio_tangent(model, v), models, datas, 0.3)
    assert (
        error(tw.impact(model, q, v, contacts, restitution=0.3).v, bridge.from_pinocchio_tangent(model, after)) < 1e-12
    )


def test_turning_round_the_normal_part_alone_would_add_energy():
    """Why restitution turns the whole velocity of a contact round: the reason that the docstring gives, in numbers."""
    rod = solid("rod", 1.0, (1.0, 0.02, 0.02), {"end": (-0.5, 0, 0)})
    q = posed([0, -1.0, 0], [0, 0, 0])
    J, M = tw.constraint_jacobian(rod, q, points(["end"])), tw.crba(rod, q)
    A = J @ np.linalg.solve(M, J.T)
    u = A @ [0, 0, 1.0]  # the velocity that an impulse straight up gives: of all with this normal part it costs least
    after = np.array([0, 0, u[2]])  # e = 1 along the normal, no sliding after
    assert after @ np.linalg.solve(A, after) > 1.1 * (u @ np.linalg.solve(A, u))


@pytest.mark.parametrize("restitution", [-0.1, 1.1, np.nan])
def test_a_restitution_out_of_bounds_is_refused(restitution):
    with pytest.raises(ValueError, match="restitution: expected a number from 0 to 1"):
        tw.impact(BOX, BOX.neutral(), np.zeros(6), BOX_CORNERS, restitution=restitution)


def test_impacts_take_batches():
    v = np.random.default_rng(0).standard_normal((3, 6))
    many = tw.impact(BOX, BOX.neutral(), v, BOX_CORNERS)
    assert many.v.shape == (3, 6)
    assert many.energy_lost.shape == (3,)
    assert np.allclose(many.v[1], tw.impact(BOX, BOX.neutral(), v[1], BOX_CORNERS).v, rtol=0, atol=1e-15)


# ---------------------------------------------------------------- projection


def anchored(model, q, contacts, size, seed=0):
    """A drifted state, and where its contacts belong."""
    rng = np.random.default_rng(seed)
    drifted = model.integrate(q, size * rng.standard_normal(model.nv))
    return drifted, rng.standard_normal(model.nv), tw.contact_placements(model, q, contacts)


@pytest.mark.parametrize(
    ("model", "q", "contacts"),
    [
        (BOX, posed([0.1, 0.2, 0.3], [1, 2, 0.1]), BOX_CORNERS),
        (GO2, GO2.standing(), FEET),
        (HUMANOID, HUMANOID.standing(), SOLES),
    ],
    ids=["box", "Go2", "humanoid"],
)
def test_a_projected_state_touches_and_stays_so(model, q, contacts):
    drifted, v, anchors = anchored(model, q, contacts, 0.02)
    q, v_held = tw.project_state(model, drifted, v, contacts, anchors)
    for name, T in tw.contact_placements(model, q, contacts).items():
        assert np.allclose(T.translation, anchors[name].translation, rtol=0, atol=1e-12)
        if contacts is SOLES:
            assert np.allclose(T.rotation, anchors[name].rotation, rtol=0, atol=1e-10)  # 1e-12 m at 0.0275 m
    J = tw.constraint_jacobian(model, q, contacts)
    assert np.abs(J @ v_held).max() < 1e-12 * np.abs(J @ v).max()
    lost = tw.crba(model, q) @ (v - v_held)  # across in the metric of M to all that the contacts allow
    allowed = np.linalg.svd(J)[2][np.linalg.matrix_rank(J) :]
    assert np.abs(allowed @ lost).max(initial=0) < 1e-11 * np.abs(lost).max()


def test_the_first_step_is_the_least_in_the_metric_of_the_mass_matrix():
    drifted, v, anchors = anchored(GO2, GO2.standing(), FEET, 1e-6)
    q, _ = tw.project_state(GO2, drifted, v, FEET, anchors)
    step = GO2.difference(drifted, q)
    J, M = tw.constraint_jacobian(GO2, drifted, FEET), tw.crba(GO2, drifted)
    asked = np.concatenate([anchors[c.frame].translation for c in FEET]) - np.concatenate(
        [tw.frame_placement(GO2, drifted, c.frame).translation for c in FEET]
    )
    least = np.linalg.solve(M, J.T @ np.linalg.solve(J @ np.linalg.solve(M, J.T), asked))
    assert np.allclose(step, least, rtol=0, atol=1e-4 * np.abs(least).max())


def test_a_state_that_touches_is_left_as_it_is():
    anchors = tw.contact_placements(GO2, GO2.standing(), FEET)
    q, v = tw.project_state(GO2, GO2.standing(), np.zeros(18), FEET, anchors)
    assert (q == GO2.standing()).all()
    assert (v == 0).all()


def test_projection_takes_batches():
    states = [anchored(BOX, BOX.neutral(), BOX_CORNERS, size, seed) for seed, size in enumerate((0.1, 1e-3))]
    q, v = np.stack([s[0] for s in states]), np.stack([s[1] for s in states])
    many, _ = tw.project_state(BOX, q, v, BOX_CORNERS, states[0][2])
    for k in range(2):
        assert np.allclose(many[k, :3], 0, rtol=0, atol=1e-12)
        assert np.allclose(np.abs(many[k, 6]), 1, rtol=0, atol=1e-12)


def test_anchors_out_of_reach_are_named():
    anchors = dict(tw.contact_placements(GO2, GO2.standing(), FEET))
    anchors["RR_foot"] = tw.SE3(np.eye(3), anchors["RR_foot"].translation - [0, 3, 0])
    with pytest.raises(tw.SingularError, match=r"do not come to their anchors in 20 steps: 'R._foot' is .* m away"):
        tw.project_state(GO2, GO2.standing(), np.zeros(18), FEET, anchors)


def test_steps_and_tolerance_are_heeded():
    drifted, v, anchors = anchored(GO2, GO2.standing(), FEET, 0.02)
    with pytest.raises(tw.SingularError, match="in 1 steps"):
        tw.project_state(GO2, drifted, v, FEET, anchors, steps=1)
    q, _ = tw.project_state(GO2, drifted, v, FEET, anchors, steps=1, tolerance=1e-2)
    left = tw.frame_placement(GO2, q, "RL_foot").translation - anchors["RL_foot"].translation
    assert 1e-9 < np.abs(left).max() < 1e-2
    for tolerance in (-1e-12, np.nan):
        with pytest.raises(ValueError, match=rf"tolerance: expected .*, got {tolerance}"):
            tw.project_state(GO2, drifted, v, FEET, anchors, tolerance=tolerance)


def test_a_missing_anchor_is_named():
    with pytest.raises(KeyError, match="unknown anchor 'FR_foot'; did you mean 'FL_foot'"):
        tw.project_state(GO2, GO2.standing(), np.zeros(18), FEET, {"FL_foot": tw.SE3.identity()})

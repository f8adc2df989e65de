"""Contacts of robots some of whose joints follow others: every term of all joints, projected by the constant G."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.algorithms.mimic import follow
from twistwrench.simulation.mimics import couplings

from ..robots import shared

GO2 = shared("go2")
LAWS = {"RR_thigh_joint": ("RL_thigh_joint", 1.0, 0.0), "RR_calf_joint": ("FR_calf_joint", -0.8, -3.2)}
MODEL = follow(GO2, LAWS)
FEET = [tw.PointContact(foot, 0.6) for foot in GO2.feet[:3]]


def state(*batch):
    rng = np.random.default_rng(3)
    q = MODEL.integrate(np.broadcast_to(GO2.standing()[MODEL.kept_q], (*batch, MODEL.nq)), 0.2 * rng.normal(size=16))
    return q, *rng.normal(size=(3, *batch, MODEL.nv))


def projected(q, v):
    """Return GᵀMG, Gᵀh, J G and J̇ v from the full model, whose functions are tested by themselves."""
    x, u = MODEL.expand(q, v)
    G, J = MODEL.G, tw.constraint_jacobian(GO2, x, FEET)
    M, h = tw.crba(GO2, x), tw.nonlinear_effects(GO2, x, u)
    return G.T @ M @ G, G.T @ h, J @ G, tw.constraint_bias(GO2, x, u, FEET)


def test_the_accelerations_and_forces_are_those_of_the_projected_equations():
    q, v, tau, _ = state()
    M, h, J, bias = projected(q, v)
    m = len(J)
    both = np.linalg.solve(np.block([[M, -J.T], [J, np.zeros((m, m))]]), np.r_[tau - h, -bias])
    held = tw.contact_forward_dynamics(MODEL, q, v, tau, FEET)
    size = np.abs(both).max()
    np.testing.assert_allclose(held.qdd, both[:-m], rtol=0, atol=1e-11 * size)
    np.testing.assert_allclose(np.concatenate(list(held.forces.values())), both[-m:], rtol=0, atol=1e-11 * size)
    np.testing.assert_allclose(tw.constraint_jacobian(MODEL, q, FEET), J, rtol=0, atol=1e-15)
    np.testing.assert_allclose(tw.constraint_bias(MODEL, q, v, FEET), bias, rtol=0, atol=1e-14)
    free = tw.contact_forward_dynamics(MODEL, q, v, tau, []).qdd
    np.testing.assert_allclose(free, tw.aba(MODEL, q, v, tau), rtol=0, atol=1e-10 * np.abs(free).max())


def test_they_are_those_of_the_full_robot_with_couplings_of_which_the_contacts_know_nothing():
    q, v, tau, _ = state(2)
    full, gears, leaders = MODEL.expand(q, v), couplings(MODEL), MODEL.G.argmax(axis=0)
    forces = np.zeros((2, GO2.nv))
    forces[:, leaders] = tau
    f_ext = np.random.default_rng(1).normal(size=(2, GO2.nbodies, 6))
    f_ext[:, 0] = 0
    ours = tw.contact_forward_dynamics(MODEL, q, v, tau, FEET, f_ext)
    theirs = tw.contact_forward_dynamics(GO2, *full, forces, [*FEET, *gears], f_ext)
    size = np.abs(theirs.qdd).max()
    np.testing.assert_allclose(MODEL.expand(q, ours.qdd)[1], theirs.qdd, rtol=0, atol=1e-10 * size)
    for foot in ours.forces:
        np.testing.assert_allclose(ours.forces[foot], theirs.forces[foot], rtol=0, atol=1e-10 * size)
    assert (ours.rank == theirs.rank - len(gears)).all()


def test_impacts_projections_and_inverse_dynamics_take_such_a_model():
    q, v, tau, _ = state()
    M, h, J, _ = projected(q, v)
    hit = tw.impact(MODEL, q, v, FEET)
    impulse = np.concatenate(list(hit.impulses.values()))
    np.testing.assert_allclose(J @ hit.v, 0, atol=1e-12)
    np.testing.assert_allclose(M @ (hit.v - v), J.T @ impulse, rtol=0, atol=1e-12)
    assert hit.energy_lost == pytest.approx(tw.kinetic_energy(MODEL, q, v) - tw.kinetic_energy(MODEL, q, hit.v))
    anchors = tw.contact_placements(MODEL, q, FEET)
    back, still = tw.project_state(MODEL, MODEL.integrate(q, 1e-3 * v), v, FEET, anchors)
    for foot, place in tw.contact_placements(MODEL, back, FEET).items():
        np.testing.assert_allclose(place.translation, anchors[foot].translation, rtol=0, atol=1e-12)
    np.testing.assert_allclose(tw.constraint_jacobian(MODEL, back, FEET) @ still, 0, atol=1e-12)
    tau[:6] = 0
    held = tw.contact_forward_dynamics(MODEL, q, v, tau, FEET)
    asked = tw.contact_inverse_dynamics(MODEL, q, v, held.qdd, FEET)
    force = np.concatenate(list(asked.forces.values()))
    np.testing.assert_allclose(M @ held.qdd + h, asked.tau + J.T @ force, rtol=0, atol=1e-10)
    np.testing.assert_array_equal(asked.tau[:6], 0)
    all_but_one = [name for name in MODEL.joint_names[2:] if name != "FL_hip_joint"]
    idle = tw.contact_inverse_dynamics(MODEL, q, v, held.qdd, FEET, motors=all_but_one).tau
    assert idle[MODEL.v_slice[MODEL.joint_names.index("FL_hip_joint")]] == 0
    with pytest.raises(tw.NameNotFound, match="RR_calf_joint"):
        tw.contact_inverse_dynamics(MODEL, q, v, held.qdd, FEET, motors=["RR_calf_joint"])


def test_it_stands_where_the_full_robot_does():
    model = follow(GO2, {"RR_calf_joint": ("RL_calf_joint", 1.0, 0.0)})
    q, feet = GO2.standing(), [tw.PointContact(foot, 0.6) for foot in GO2.feet]
    ours, theirs = tw.stance_margins(model, q[model.kept_q], feet), tw.stance_margins(GO2, q, feet)
    assert (ours.stands, ours.tip) == (True, pytest.approx(theirs.tip, abs=1e-12))
    rest = np.zeros(model.nv)
    tau = tw.friction_inverse_dynamics(model, q[model.kept_q], rest, rest, feet).tau
    np.testing.assert_allclose(
        tau, model.G.T @ tw.friction_inverse_dynamics(GO2, q, *np.zeros((2, 18)), feet).tau, rtol=0, atol=1e-9
    )
    for call in (
        lambda: tw.friction_inverse_dynamics(model, q[model.kept_q], rest, rest, feet, effort_limits=True),
        lambda: tw.Scene(model, contacts=feet),
    ):
        with pytest.raises(TypeError, match=r"MimicModel.*\[tw\.Coupling\('RR_calf_joint', \{'RL_calf_joint': 1\}\)\]"):
            call()

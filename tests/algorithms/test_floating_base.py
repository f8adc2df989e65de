"""The equation of a floating base, M q̈ + h = Sᵀ τ + J_cᵀ λ: each term, and a robot that stands by it (49.9)."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

from ..invariants import H
from ..robots import shared
from ..touching import on_bodies

GO2 = shared("go2")
STAND, REST = GO2.standing(), np.zeros(18)


def test_selection_matrix_drives_the_joints_and_not_the_base():
    S = tw.selection_matrix(GO2)
    tau = np.arange(1.0, 13.0)
    assert (S.T @ tau).tolist() == [0] * 6 + tau.tolist()
    assert (S @ np.arange(18)).tolist() == list(range(6, 18))
    assert (tw.selection_matrix(tw.chain(4)) == np.eye(4)).all()


def test_contact_jacobian_gives_the_velocities_of_the_contact_points_in_the_order_asked_for():
    rng = np.random.default_rng(0)
    q, v = GO2.random_configuration(rng=rng), rng.standard_normal(18)
    moved = GO2.integrate(q, 1j * H * v)
    contacts = ["RL_foot", "FR_foot", "base"]
    velocities = [tw.frame_placement(GO2, moved, name).translation.imag / H for name in contacts]
    assert np.allclose(tw.contact_jacobian(GO2, q, contacts) @ v, np.concatenate(velocities), rtol=0, atol=1e-13)
    assert tw.contact_jacobian(GO2, q, []).shape == (0, 18)


def test_forces_at_the_feet_act_through_the_transposed_contact_jacobian():
    rng = np.random.default_rng(1)
    q, v, a = GO2.random_configuration(rng=rng), *rng.standard_normal((2, 18))
    forces = rng.standard_normal((4, 3))
    pushed = tw.rnea(GO2, q, v, a, on_bodies(GO2, q, GO2.feet, forces))
    through = tw.contact_jacobian(GO2, q, GO2.feet).T @ forces.ravel()
    assert np.allclose(tw.rnea(GO2, q, v, a) - pushed, through, rtol=0, atol=1e-12)


def test_standing_robot_needs_the_torques_and_forces_that_are_returned_and_none_at_its_base():
    held = tw.static_equilibrium(GO2, STAND)
    tau = tw.rnea(GO2, STAND, REST, REST, on_bodies(GO2, STAND, GO2.feet, held.forces))
    assert np.allclose(tau[:6], 0, rtol=0, atol=1e-12)
    assert np.allclose(tau[6:], held.tau, rtol=0, atol=1e-13)
    a = tw.aba(GO2, STAND, REST, np.r_[np.zeros(6), held.tau], on_bodies(GO2, STAND, GO2.feet, held.forces))
    assert np.abs(a).max() < 1e-10  # nothing moves; terms of 10 rad/s² and more cancel


def test_forces_of_the_ground_carry_the_weight_below_the_centre_of_mass():
    held = tw.static_equilibrium(GO2, STAND)
    G = tw.center_of_mass(GO2, STAND)
    feet = np.array([tw.frame_placement(GO2, STAND, name).translation for name in GO2.feet])
    assert np.allclose(held.forces.sum(0), [0, 0, GO2.mass * 9.81], rtol=0, atol=1e-12)
    assert np.allclose(np.cross(feet - G, held.forces).sum(0), 0, rtol=0, atol=1e-12)


def test_forces_of_the_ground_are_the_least_that_will_do():
    held = tw.static_equilibrium(GO2, STAND)
    base_rows = tw.contact_jacobian(GO2, STAND, GO2.feet)[:, :6].T
    internal = np.linalg.svd(base_rows)[2][6:]  # forces that squeeze and do nothing else
    assert np.allclose(base_rows @ internal.T, 0, rtol=0, atol=1e-14)
    assert np.allclose(internal @ held.forces.ravel(), 0, rtol=0, atol=1e-12)


def test_three_feet_stand_where_the_centre_of_mass_is_above_them_and_the_choice_is_heeded():
    three = tw.static_equilibrium(GO2, STAND, GO2.feet[:3])
    assert three.forces.shape == (3, 3)
    assert np.isclose(three.forces[:, 2].sum(), GO2.mass * 9.81)
    assert not np.allclose(three.tau, tw.static_equilibrium(GO2, STAND).tau)


def test_contact_forces_that_hold_the_feet_solve_the_equation_of_the_floating_base():
    # M a + h = Sᵀ τ + J_cᵀ λ and J_c a + J̇_c v = 0, solved as one system, against aba under the forces found.
    rng = np.random.default_rng(3)
    v, tau, feet = 0.3 * rng.standard_normal(18), rng.standard_normal(12), GO2.feet
    d = tw.dynamics(GO2, STAND, v)
    bias = [tw.frame_bias_acceleration(GO2, STAND, v, name, "local_world_aligned")[3:] for name in feet]
    K = np.block([[d.M, -d.J_c.T], [d.J_c, np.zeros((12, 12))]])
    x = np.linalg.solve(K, np.concatenate([tw.selection_matrix(GO2).T @ tau - d.h, -np.concatenate(bias)]))
    forces = x[18:].reshape(4, 3)
    a = tw.aba(GO2, STAND, v, tw.selection_matrix(GO2).T @ tau, on_bodies(GO2, STAND, feet, forces))
    assert np.allclose(a, x[:18], rtol=0, atol=1e-11 * np.abs(x).max())  # cond K is 2e3
    later = GO2.integrate(STAND, 1j * H * v)
    velocities = tw.contact_jacobian(GO2, later, feet) @ (v + 1j * H * a)
    assert np.abs(velocities.imag / H).max() < 1e-11 * np.abs(x).max()  # the feet do not speed up


def test_contacts_are_a_list_of_frames_even_where_there_is_one():
    for function in (tw.contact_jacobian, tw.static_equilibrium):
        with pytest.raises(ValueError, match="contacts: expected a sequence"):
            function(GO2, STAND, "FR_foot")


def test_static_equilibrium_that_does_not_exist_is_refused():
    with pytest.raises(tw.SingularError, match=r"no forces at .* balance the weight"):
        tw.static_equilibrium(GO2, STAND, ["FR_foot"])
    with pytest.raises(ValueError, match="expected a floating base"):
        tw.static_equilibrium(tw.chain(3), np.zeros(3), ["tip"])
    with pytest.raises(ValueError, match="at least one contact"):
        tw.static_equilibrium(GO2, STAND, [])


@pytest.mark.parametrize("q", [np.stack([STAND] * 2), STAND + 0j], ids=["batch", "complex"])
def test_static_equilibrium_is_asked_of_one_real_configuration(q):
    with pytest.raises(tw.ShapeError, match=rf"^q: expected one real configuration, shape \(19,\), got {q.dtype} of"):
        tw.static_equilibrium(GO2, q)

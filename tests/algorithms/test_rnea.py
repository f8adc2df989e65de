"""RNEA, and what is built on it: gravity, nonlinear effects, and the wrenches that the joints transmit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw

from ..invariants import body_frame, close, floating, in_world, several, trees
from ..mechanisms import C1, I1, M1, G, agrees, body, mechanisms, newton_and_euler, pendulum, states, wheel

# ---------------------------------------------------------------- closed forms


@mechanisms
@states
def test_rnea_gives_the_torques_of_the_textbook(mechanism, q, v, a):
    motion = mechanism(q, v, a)
    assert agrees(tw.rnea(motion.model, motion.q, motion.v, motion.a), motion.tau)


@mechanisms
@states
def test_gravity_and_nonlinear_effects_are_those_of_the_textbook(mechanism, q, v, a):
    motion = mechanism(q, v, a)
    assert agrees(tw.gravity(motion.model, motion.q), motion.g)
    assert agrees(tw.nonlinear_effects(motion.model, motion.q, motion.v), motion.C_v + motion.g)


@pytest.mark.parametrize("seed", range(4))
def test_rnea_of_one_body_is_newtons_and_eulers_equations(seed):
    motion = newton_and_euler(seed)
    assert agrees(tw.rnea(motion.model, motion.q, motion.v, motion.a), motion.tau, 1e-13)


def test_rnea_of_a_lift_is_larger_while_it_speeds_up():
    builder = tw.Builder("lift")
    builder.link("cabin", parent="base_link", joint=tw.Prismatic("z"), inertia=body(M1, [0.1, 0.2, 0.3], I1, 1))
    assert agrees(tw.rnea(builder.build(), [2.0], [1.0], [3.0]), [M1 * (G + 3.0)])


def test_gravity_loads_every_joint_of_a_chain_held_out_straight():
    # joint k of n equal rods of mass m and length l: the n − k rods beyond it have their centre (n − k) l / 2 away
    q = [np.pi / 2, 0, 0, 0, 0]
    expected = [-2.0 * G * 0.5 * k**2 / 2 for k in (5, 4, 3, 2, 1)]
    assert agrees(tw.gravity(tw.chain(5, mass=2.0, length=0.5), q), np.negative(expected))


def test_gravity_of_a_wheel_that_has_turned_by_its_cosine_and_sine_is_that_of_a_pendulum():
    for angle in (0.0, 1.0, 2.5, -3.0):
        assert agrees(tw.gravity(wheel(), [np.cos(angle), np.sin(angle)]), tw.gravity(pendulum(), [angle]))


def test_joint_wrench_in_the_hinge_of_a_pendulum_is_the_weight_and_the_centripetal_force():
    # at the bottom: m g + m c ω² along the bar, no moment
    wrench = tw.joint_wrenches(pendulum(), [0.0], [3.0], [0.0])[1]
    assert agrees(wrench, [0, 0, 0, 0, 0, M1 * (G + C1 * 9.0)])


def test_joint_wrench_under_a_gyroscope_is_a_moment_to_its_side():
    # a wheel that spins about x with ω is yawed about z with Ω: it wants the moment I ω Ω about y
    builder = tw.Builder("gyroscope", gravity=[0, 0, 0])
    builder.link("yaw", parent="base_link", joint=tw.Revolute("z"))
    wheel = tw.SpatialInertia(1.0, [0, 0, 0], np.diag([0.5, 0.3, 0.3]))
    builder.link("wheel", parent="yaw", joint=tw.Revolute("x"), inertia=wheel)
    wrench = tw.joint_wrenches(builder.build(), [0.0, 0.0], [2.0, 7.0], [0.0, 0.0])[1]
    assert agrees(wrench, [0, 0.5 * 7.0 * 2.0, 0, 0, 0, 0])


# ---------------------------------------------------------------- invariants


@trees
@several
def test_rnea_undoes_aba(recipe):
    model, s = recipe.model, recipe.state()
    M, h = tw.crba(model, s.q), tw.nonlinear_effects(model, s.q, s.v)
    for f_ext in (None, s.f_ext):
        a = tw.aba(model, s.q, s.v, s.tau, f_ext)
        size = (np.abs(M) @ np.abs(a) + np.abs(h)).max()
        assert close(tw.rnea(model, s.q, s.v, a, f_ext), s.tau, size=size)


@trees
@several
def test_rnea_is_the_mass_matrix_times_acceleration_plus_nonlinear_effects(recipe):
    model, s = recipe.model, recipe.state()
    M, h = tw.crba(model, s.q), tw.nonlinear_effects(model, s.q, s.v)
    assert close(tw.rnea(model, s.q, s.v, s.a), M @ s.a + h)
    columns = tw.rnea(model, s.q, 0 * s.v, np.eye(model.nv)) - tw.gravity(model, s.q)
    assert close(columns, M, size=np.abs(tw.gravity(model, s.q)).max())


@trees
@several
def test_nonlinear_effects_are_gravity_plus_a_square_of_velocity(recipe):
    model, s = recipe.model, recipe.state()
    g, h = tw.gravity(model, s.q), tw.nonlinear_effects(model, s.q, s.v)
    weightless = replace(model, gravity=np.zeros(3))
    size = np.abs(h).max() + model.mass * 9.81
    assert close(tw.nonlinear_effects(model, s.q, 2 * s.v) - g, 4 * (h - g), size=size)
    assert close(tw.nonlinear_effects(model, s.q, -s.v), h, size=size)  # time runs backwards
    assert close(tw.nonlinear_effects(weightless, s.q, s.v), h - g, size=size)
    assert not tw.gravity(weightless, s.q).any()


@trees
@several
def test_external_wrenches_enter_rnea_through_the_jacobians_of_their_bodies(recipe):
    model, s = recipe.model, recipe.state()
    without, pushed = tw.rnea(model, s.q, s.v, s.a), tw.rnea(model, s.q, s.v, s.a, s.f_ext)
    through = sum(tw.frame_jacobian(model, s.q, body_frame(model, i)).T @ s.f_ext[i] for i in range(1, model.nbodies))
    assert close(without - pushed, through, size=np.abs(without).max())


@trees
@several
def test_joint_wrenches_are_what_the_bodies_need_and_the_ground_bears_the_rest(recipe):
    model, s = recipe.model, recipe.state()
    F, tau = tw.joint_wrenches(model, s.q, s.v, s.a, s.f_ext), tw.rnea(model, s.q, s.v, s.a, s.f_ext)
    felt = np.concatenate([joint.subspace().T @ f for joint, f in zip(model.joints[1:], F[1:], strict=True)])
    assert close(felt, tau - model.armature * s.a)
    placement, G = tw.forward_kinematics(model, s.q).placement, tw.center_of_mass(model, s.q)
    at_G = tw.centroidal_momentum_rate(model, s.q, s.v, s.a)
    at_G[3:] -= model.mass * model.gravity
    ground = in_world(tw.SE3(np.eye(3), G), at_G)
    ground -= sum(in_world(T, f) for T, f in zip(placement, s.f_ext, strict=True))
    assert close(F[0], ground, size=np.abs(F).max())


@floating
@several
def test_rnea_does_not_notice_a_uniform_motion_of_everything(recipe):
    # Galileo: add a constant velocity c. In the base's frame that is Rᵀc, which turns backwards with −ω × Rᵀc.
    model, s = recipe.model, recipe.state()
    seen = tw.forward_kinematics(model, s.q).placement[1].rotation.T @ [3.0, -5.0, 2.0]
    v, a = s.v.copy(), s.a.copy()
    v[3:6] += seen
    a[3:6] -= np.cross(s.v[:3], seen)
    tau = tw.rnea(model, s.q, s.v, s.a)
    assert close(tw.rnea(model, s.q, v, a), tau, 1e-11)  # terms of the order of |c| cancel
    assert not close(tw.rnea(model, s.q, v, s.a), tau)
    assert close(
        tw.centroidal_momentum(model, s.q, v) - tw.centroidal_momentum(model, s.q, s.v),
        np.concatenate([np.zeros(3), model.mass * np.array([3.0, -5.0, 2.0])]),
    )

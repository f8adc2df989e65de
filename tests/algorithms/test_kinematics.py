"""Kinematics: placements, twists and accelerations of bodies; placements, Jacobians and their rates of frames."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

from ..invariants import H, body_frame, close, rate, several, step, trees
from ..mechanisms import C1, I1, L1, M1, agrees, at, body, states
from ..strategies import REFERENCES


@states
def test_frame_jacobian_and_bias_acceleration_of_the_planar_arm_are_those_of_spong_and_craig(q, v, a):
    # two links along x that turn about z: J and J̇ q̇ of the tip
    builder = tw.Builder("planar arm")
    builder.link("one", parent="base_link", joint=tw.Revolute("z"), inertia=body(M1, [C1, 0, 0], I1, 2))
    builder.link("two", parent="one", joint=tw.Revolute("z"), placement=at(L1, 0, 0))
    builder.link("tip", parent="two", placement=at(0.6, 0, 0))
    model, (q1, q2), (v1, v2) = builder.build(), q, v
    s1, c1, s12, c12 = np.sin(q1), np.cos(q1), np.sin(q1 + q2), np.cos(q1 + q2)
    J = tw.frame_jacobian(model, q, "tip", "local_world_aligned")
    assert agrees(J[3:5], [[-L1 * s1 - 0.6 * s12, -0.6 * s12], [L1 * c1 + 0.6 * c12, 0.6 * c12]])
    assert agrees(J[:3], [[0, 0], [0, 0], [1, 1]])
    bias = tw.frame_bias_acceleration(model, q, v, "tip", "local_world_aligned")
    one, two = L1 * v1**2, 0.6 * (v1 + v2) ** 2
    assert agrees(bias, [0, 0, 0, -one * c1 - two * c12, -one * s1 - two * s12, 0])
    assert agrees(tw.frame_placement(model, q, "tip").translation, [L1 * c1 + 0.6 * c12, L1 * s1 + 0.6 * s12, 0])


@trees
@several
def test_forward_kinematics_gives_twists_as_the_rate_of_placements_and_accelerations_as_that_of_twists(recipe):
    model, s = recipe.model, recipe.state()
    now = tw.forward_kinematics(model, s.q, s.v, s.a)
    soon = tw.forward_kinematics(model, step(model, s.q, s.v), s.v + 1j * H * s.a)
    for i in range(1, model.nbodies):
        body_twist = tw.vee(now.placement[i].inverse().matrix() @ rate(soon.placement[i].matrix()))
        assert close(now.twist[i], body_twist, size=np.abs(now.twist).max())
    assert close(rate(soon.twist), now.acceleration)
    assert not now.twist[0].any()
    assert not now.acceleration[0].any()


@trees
@several
def test_frame_jacobian_gives_the_rate_of_the_frames_placement(recipe):
    model, s, frame = recipe.model, recipe.state(), recipe.frame()
    T, T_rate = (
        tw.frame_placement(model, s.q, frame),
        rate(tw.frame_placement(model, step(model, s.q, s.v), frame).matrix()),
    )
    twist = {
        "local": tw.vee(T.inverse().matrix() @ T_rate),
        "world": tw.vee(T_rate @ T.inverse().matrix()),
    }
    twist["local_world_aligned"] = np.concatenate([twist["world"][:3], T_rate[:3, 3]])
    for reference in REFERENCES:
        J = tw.frame_jacobian(model, s.q, frame, reference)
        assert close(J @ s.v, twist[reference], size=np.abs(J).max() + 1e-300)


@trees
@several
def test_frame_bias_acceleration_is_the_rate_of_the_jacobian_times_velocity(recipe):
    model, s, frame = recipe.model, recipe.state(), recipe.frame()
    for reference in REFERENCES:
        J_rate = rate(tw.frame_jacobian(model, step(model, s.q, s.v), frame, reference))
        bias = tw.frame_bias_acceleration(model, s.q, s.v, frame, reference)
        size = np.abs(tw.frame_jacobian(model, s.q, frame, reference)).max() * np.abs(s.v).max() ** 2
        assert close(bias, J_rate @ s.v, size=size + 1e-300)  # a frame on the world has no Jacobian


@trees
@several
def test_forward_kinematics_moves_a_body_as_its_frame(recipe):
    model, s = recipe.model, recipe.state()
    motion = tw.forward_kinematics(model, s.q, s.v, s.a)
    for i in range(1, model.nbodies):
        name = body_frame(model, i)
        J, bias = tw.frame_jacobian(model, s.q, name), tw.frame_bias_acceleration(model, s.q, s.v, name)
        assert close(J @ s.v, motion.twist[i], size=np.abs(motion.twist).max())
        assert close(J @ s.a + bias, motion.acceleration[i], size=np.abs(motion.acceleration).max())
        assert close(tw.frame_placement(model, s.q, name).matrix(), motion.placement[i].matrix())


def test_forward_kinematics_refuses_an_acceleration_without_a_velocity():
    with pytest.raises(ValueError, match="an acceleration needs the velocity"):
        tw.forward_kinematics(tw.chain(3), np.zeros(3), None, np.zeros(3))

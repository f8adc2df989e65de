"""The centre of mass and the momentum about it: closed forms, what conserves it, and digits far from the origin."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw

from ..invariants import H, close, floating, in_world, rate, several, step, trees
from ..mechanisms import C1, agrees, newton_and_euler, pendulum, satellite, states
from ..robots import shared

# ---------------------------------------------------------------- closed forms


@states
def test_center_of_mass_of_a_pendulum_is_that_of_the_textbook(q, v, a):
    assert agrees(tw.center_of_mass(pendulum(), q[:1]), [-C1 * np.sin(q[0]), 0, -C1 * np.cos(q[0])])


@pytest.mark.parametrize("seed", range(4))
def test_centroidal_momentum_of_one_body_is_its_spin_and_its_drift(seed):
    motion = newton_and_euler(seed)
    assert agrees(tw.centroidal_momentum(motion.model, motion.q, motion.v), motion.momentum, 1e-13)


def test_centroidal_map_of_a_satellite_has_the_inertias_about_the_axis_of_its_wheel():
    model = satellite()
    assert agrees(tw.centroidal_map(model, model.neutral())[2], [0, 0, 1.22, 0, 0, 0, 0.02])


# ---------------------------------------------------------------- invariants


@trees
@several
def test_centroidal_momentum_is_the_mass_times_the_velocity_of_the_centre_of_mass(recipe):
    model, s = recipe.model, recipe.state()
    momentum = tw.centroidal_momentum(model, s.q, s.v)
    velocity = rate(tw.center_of_mass(model, step(model, s.q, s.v)))
    assert close(momentum[3:], model.mass * velocity, size=np.abs(momentum).max())
    assert close(tw.potential_energy(model, s.q), -model.mass * model.gravity @ tw.center_of_mass(model, s.q),
                 size=model.mass * 9.81)  # fmt: skip


@trees
@several
def test_centroidal_momentum_is_linear_in_velocity_and_its_rate_follows(recipe):
    model, s = recipe.model, recipe.state()
    A, momentum = tw.centroidal_map(model, s.q), tw.centroidal_momentum(model, s.q, s.v)
    assert close(A @ s.v, momentum, size=np.abs(A).max())
    later = tw.centroidal_momentum(model, step(model, s.q, s.v), s.v + 1j * H * s.a)
    assert close(tw.centroidal_momentum_rate(model, s.q, s.v, s.a), rate(later), size=np.abs(A).max())
    assert not tw.centroidal_momentum_rate(model, s.q, 0 * s.v, 0 * s.a).any()  # a matter of motion, not of forces


@floating
@several
def test_centroidal_map_is_the_base_rows_of_the_mass_matrix_seen_from_the_centre_of_mass(recipe):
    model, s = recipe.model, recipe.state()
    T = tw.forward_kinematics(model, s.q).placement[1]
    from_G = tw.SE3(T.rotation, T.translation - tw.center_of_mass(model, s.q))
    assert close(from_G.force_transform() @ tw.crba(model, s.q)[:6], tw.centroidal_map(model, s.q))


@floating
@several
def test_centroidal_momentum_changes_by_external_forces_and_gravity_alone(recipe):
    model, s = recipe.model, recipe.state()
    a = tw.aba(model, s.q, s.v, s.tau, s.f_ext)  # the joints' own torques are internal; the base's are a wrench
    wrenches = s.f_ext.copy()
    wrenches[1] += s.tau[:6]
    G, placement = tw.center_of_mass(model, s.q), tw.forward_kinematics(model, s.q).placement
    total = np.concatenate([np.zeros(3), model.mass * model.gravity])
    for T, wrench in zip(placement, wrenches, strict=True):
        total += in_world(tw.SE3(T.rotation, T.translation - G), wrench)
    h_rate = tw.centroidal_momentum_rate(model, s.q, s.v, a)
    terms = np.abs(tw.centroidal_map(model, s.q)) @ np.abs(a)  # large accelerations whose momenta cancel
    assert close(h_rate, total, size=terms.max())


@floating
@several
def test_centroidal_momentum_is_conserved_where_nothing_acts_from_outside(recipe):
    model, s = replace(recipe.model, gravity=np.zeros(3)), recipe.state()
    tau = s.tau.copy()
    tau[:6] = 0
    a = tw.aba(model, s.q, s.v, tau)
    h_rate = tw.centroidal_momentum_rate(model, s.q, s.v, a)
    terms = np.abs(tw.centroidal_map(model, s.q)) @ (np.abs(a) + s.v**2)
    assert np.abs(h_rate).max() <= 1e-12 * terms.max()
    q, v = step(model, s.q, s.v), s.v + 1j * H * a
    work = tau @ s.v
    assert close(rate(tw.kinetic_energy(model, q, v)), work, size=np.abs(tw.crba(model, s.q) @ a).max())


# ---------------------------------------------------------------- digits, and what has no mass


STONE = tw.Builder("stone", base="floating", root_inertia=tw.SpatialInertia(2, [0.1, 0.2, 0.3], np.diag([3, 4, 5])))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("distance", [1e3, 1e6, 1e9])
@pytest.mark.parametrize("model", [shared("go2"), STONE.build()], ids=lambda model: model.name)
def test_centroidal_momentum_loses_no_digit_where_the_robot_is_far_from_the_worlds_origin(model, distance, dtype):
    rng = np.random.default_rng(5)
    here, v, a = model.random_configuration(rng=rng), *rng.normal(size=(2, model.nv))
    here, v, a = (x.astype(dtype) for x in (here, v, a))
    here[:3], there = 0, here.copy()
    there[:3] = distance * np.array([1, -0.7, 0.3])
    for function, motion in [
        (tw.centroidal_map, ()),
        (tw.centroidal_momentum, (v,)),
        (tw.centroidal_momentum_rate, (v, a)),
    ]:  # none depends on where the base is, and it drops out before anything is rounded: equal to the last bit
        assert (function(model, there, *motion) == function(model, here, *motion)).all()


def test_centroidal_map_loses_no_digit_where_the_robot_is_welded_down_far_from_the_worlds_origin():
    arm, far = shared("planar_arm"), tw.SE3(np.eye(3), [1e6, 2e6, -1e6])
    moved = replace(arm, placement=(arm.placement[0], far @ arm.placement[1], *arm.placement[2:]))
    q = np.array([[0.3, -1.1, 0.7], [2.0, 0.4, -0.1]])
    assert (tw.centroidal_map(moved, q) == tw.centroidal_map(arm, q)).all()
    assert close(tw.center_of_mass(moved, q), tw.center_of_mass(arm, q) + far.translation)


def test_center_of_mass_of_a_robot_without_mass_is_refused():
    builder = tw.Builder("ghost")
    builder.link("ghost", parent="base_link", joint=tw.Revolute("z"))
    model = builder.build()
    for function in (tw.center_of_mass, tw.centroidal_map):
        with pytest.raises(tw.SingularError, match="centre of mass of 'ghost': nothing that moves has mass"):
            function(model, [0.0])
    assert tw.crba(model, [0.0]) == [[0.0]]

"""Ȧ_G, I_G, v_G and a_G: closed forms, what they are derivatives of, Pinocchio and 50 digits."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest

import twistwrench as tw

from ..invariants import close, floating, hinges_and_slides, rate, several, step, trees
from ..mechanisms import C1, agrees, newton_and_euler, pendulum, satellite, states
from ..robots import shared
from ..strategies import BATCHES, Recipe
from ..truth import slow
from .test_factorization import TYPES, wheels

# ---------------------------------------------------------------- closed forms


@states
def test_center_of_mass_of_a_pendulum_moves_on_a_circle(q, v, a):
    (q, *_), (w, *_), (alpha, *_) = q, v, a
    along, inward = np.array([-np.cos(q), 0, np.sin(q)]), np.array([np.sin(q), 0, np.cos(q)])
    assert agrees(tw.center_of_mass_velocity(pendulum(), [q], [w]), C1 * w * along)
    assert agrees(tw.center_of_mass_acceleration(pendulum(), [q], [w], [alpha]), C1 * (alpha * along + w**2 * inward))


def test_inertia_of_a_satellite_is_the_sum_of_hull_and_wheel():
    assert agrees(
        tw.centroidal_inertia(satellite(), satellite().neutral()), np.diag([1.01, 1.11, 1.22, 10.5, 10.5, 10.5])
    )


@pytest.mark.parametrize("seed", range(3))
def test_map_of_one_body_turns_with_the_body(seed):
    """Of one body A_G = [R I_c, 0; −m R [c]×, m R], so that Ȧ_G has R [ω]× for R."""
    motion = newton_and_euler(seed)
    body, w = motion.model.inertia[1], tw.skew(motion.v[:3])
    R = tw.forward_kinematics(motion.model, motion.q).placement[1].rotation
    expected = np.block([
        [R @ w @ body.inertia_at_com, np.zeros((3, 3))],
        [-body.mass * R @ w @ tw.skew(body.com), body.mass * R @ w],
    ])  # fmt: skip
    assert agrees(tw.centroidal_map_rate(motion.model, motion.q, motion.v), expected, 1e-13)


# ---------------------------------------------------------------- invariants


@trees
@several
def test_it_is_the_derivative_of_the_map_along_the_motion(recipe):
    model, s = recipe.model, recipe.state()
    A = rate(tw.centroidal_map(model, step(model, s.q, s.v)))
    assert close(tw.centroidal_map_rate(model, s.q, s.v), A, size=np.abs(tw.centroidal_map(model, s.q)).max())


@trees
@several
def test_the_rate_of_momentum_has_its_two_terms(recipe):
    model, s = recipe.model, recipe.state()
    A, dA = tw.centroidal_map(model, s.q), tw.centroidal_map_rate(model, s.q, s.v)
    assert close(A @ s.a + dA @ s.v, tw.centroidal_momentum_rate(model, s.q, s.v, s.a), size=np.abs(A).max())


@trees
@several
def test_velocity_and_acceleration_are_derivatives_of_the_center_of_mass(recipe):
    model, s = recipe.model, recipe.state()
    G, v_G = tw.center_of_mass(model, s.q), tw.center_of_mass_velocity(model, s.q, s.v)
    assert close(v_G, rate(tw.center_of_mass(model, step(model, s.q, s.v))), size=np.abs(G).max())
    assert close(tw.center_of_mass_jacobian(model, s.q) @ s.v, v_G, size=np.abs(s.v).max())
    later = tw.center_of_mass_velocity(model, step(model, s.q, s.v), s.v + 1e-20j * s.a)
    assert close(tw.center_of_mass_acceleration(model, s.q, s.v, s.a), rate(later), size=np.abs(v_G).max())


@floating
@several
def test_a_robot_that_moves_as_one_has_the_momentum_of_its_inertia(recipe):
    """With the joints at rest h_G = I_G V, where V is the base's twist seen at the centre of mass."""
    model, s = recipe.model, recipe.state()
    T = tw.forward_kinematics(model, s.q).placement[1]
    from_G = tw.SE3(T.rotation, T.translation - tw.center_of_mass(model, s.q))
    inertia = tw.centroidal_inertia(model, s.q)
    expected = inertia @ from_G.motion_transform()
    assert close(tw.centroidal_map(model, s.q)[:, :6], expected)
    assert close(inertia[3:], np.c_[np.zeros((3, 3)), model.mass * np.eye(3)], size=np.abs(inertia).max())


@trees
@several
def test_nothing_depends_on_the_gravity(recipe):
    model, s = recipe.model, recipe.state()
    other = replace(model, gravity=np.array([1.0, 2, 3]))
    for function in (tw.centroidal_map_rate, tw.center_of_mass_velocity):
        assert (function(model, s.q, s.v) == function(other, s.q, s.v)).all()


# ---------------------------------------------------------------- outside oracles


@trees
@several
def test_all_are_pinocchios(recipe):
    pin = pytest.importorskip("pinocchio")
    model, s = recipe.model, recipe.state()
    there = tw.bridge.to_pinocchio_model(model)
    data = there.createData()
    v, a = (tw.bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.a))
    pin.dccrba(there, data, s.q, v)
    size = np.abs(tw.centroidal_map(model, s.q)).max()
    theirs = tw.bridge.from_pinocchio_jacobian(model, data.dAg.reshape(6, -1))
    assert close(tw.centroidal_map_rate(model, s.q, s.v), theirs, size=size)
    inertia = tw.bridge.from_pinocchio_transform(data.Ig.matrix())
    assert close(tw.centroidal_inertia(model, s.q), inertia)
    pin.centerOfMass(there, data, s.q, v, a)
    assert close(tw.center_of_mass_velocity(model, s.q, s.v), data.vcom[0], size=np.abs(s.v).max())
    assert close(tw.center_of_mass_acceleration(model, s.q, s.v, s.a), data.acom[0], size=(s.v**2).sum())
    linear = pin.jacobianCenterOfMass(there, data, s.q).reshape(3, -1)
    rows = np.concatenate([linear, np.zeros((3, model.nv))])
    assert close(tw.center_of_mass_jacobian(model, s.q), tw.bridge.from_pinocchio_jacobian(model, rows)[3:])


@hinges_and_slides
@several
def test_the_rate_of_the_map_is_right_to_fifty_digits(recipe):
    model, s = recipe.model, recipe.state()
    q, v, h = slow.as_mpmath(s.q), slow.as_mpmath(s.v), mpmath.mpf("1e-16")
    true = (slow.centroidal_map(model, q + h * v) - slow.centroidal_map(model, q - h * v)) / (2 * h)  # to 1e-32
    size = np.abs(tw.centroidal_map(model, s.q)).max()
    assert close(tw.centroidal_map_rate(model, s.q, s.v), true.astype(float), 1e-13, size=size)


# ---------------------------------------------------------------- digits, number types, batches


@pytest.mark.parametrize("distance", [1e3, 1e6, 1e9])
def test_none_depends_on_where_the_robot_stands(distance):
    model, rng = shared("go2"), np.random.default_rng(5)
    here, v = model.random_configuration(rng=rng), rng.standard_normal(model.nv)
    there = here.copy()
    here[:3], there[:3] = 0, distance * np.array([1, -0.7, 0.3])
    assert (tw.centroidal_map_rate(model, here, v) == tw.centroidal_map_rate(model, there, v)).all()
    assert (tw.centroidal_inertia(model, here) == tw.centroidal_inertia(model, there)).all()


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_every_number_type_and_batch_is_kept(dtype, batch):
    recipe = Recipe(7, seed=4, base="floating")
    model, s = recipe.model, recipe.state(batch, dtype)
    for function, motion, tail in (
        (tw.centroidal_map_rate, "v", (6, model.nv)),
        (tw.centroidal_inertia, "", (6, 6)),
        (tw.center_of_mass_jacobian, "", (3, model.nv)),
        (tw.center_of_mass_velocity, "v", (3,)),
        (tw.center_of_mass_acceleration, "va", (3,)),
    ):
        ours = function(model, s.q, *(getattr(s, name) for name in motion))
        assert ours.dtype == dtype
        assert ours.shape == (*batch, *tail)


def test_fractions_stay_exact():
    model, third = wheels(), Fraction(1, 3)
    q = np.array([Fraction(3, 5), Fraction(4, 5), Fraction(5, 13), Fraction(-12, 13), third])
    v, a = np.array([third, Fraction(2), Fraction(-1, 7)]), np.array([Fraction(1), -third, Fraction(0)])
    both = tw.centroidal_map(model, q) @ a + tw.centroidal_map_rate(model, q, v) @ v
    assert (both == tw.centroidal_momentum_rate(model, q, v, a)).all()
    inertia = tw.centroidal_inertia(model, q)
    assert (inertia[3:, :3] == 0).all()
    assert (inertia[3:, 3:] == Fraction(9, 2) * np.eye(3, dtype=int)).all()


def test_a_robot_without_mass_has_no_center():
    builder = tw.Builder("ghost")
    builder.link("tip", parent="base_link", joint=tw.Revolute("z"))
    for function, count in ((tw.centroidal_map_rate, 1), (tw.centroidal_inertia, 0), (tw.center_of_mass_velocity, 1)):
        with pytest.raises(tw.SingularError, match="centre of mass of 'ghost': nothing that moves has mass"):
            function(builder.build(), [0.0], *[[1.0]] * count)

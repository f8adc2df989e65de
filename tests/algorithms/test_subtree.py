"""A part of the robot: its mass, centre, Jacobian, inertia and momentum."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.algorithms.subtree import outboard

from ..invariants import body_frame, close, rate, several, step, trees
from ..mechanisms import C1, C2, I2, L1, M1, M2, agrees, states, two_bars
from ..strategies import BATCHES, Recipe
from .test_factorization import TYPES, wheels


@states
def test_the_lower_bar_of_a_double_pendulum_is_carried_by_the_upper_one(q, v, a):
    part = tw.subtree(two_bars(), q, "lower")
    (q1, q12), c = (q[0], q[0] + q[1]), C2
    assert part.mass == M2
    assert agrees(part.center_of_mass, [-L1 * np.sin(q1) - c * np.sin(q12), 0, -L1 * np.cos(q1) - c * np.cos(q12)])
    by_lower = np.array([-c * np.cos(q12), 0, c * np.sin(q12)])
    by_upper = by_lower + np.array([-L1 * np.cos(q1), 0, L1 * np.sin(q1)])
    assert agrees(part.jacobian, np.stack([by_upper, by_lower], axis=-1))
    assert agrees(part.momentum_map[1], [I2, I2])
    assert agrees(part.inertia[1, 1], I2)
    whole = tw.subtree(two_bars(), q, "upper")
    upper = np.array([-C1 * np.sin(q1), 0, -C1 * np.cos(q1)])
    assert agrees(whole.center_of_mass, (M2 * part.center_of_mass + M1 * upper) / (M1 + M2))


@trees
@several
def test_the_whole_robot_is_a_subtree(recipe):
    model, q = recipe.model, recipe.state().q
    whole = tw.subtree(model, q, model.frame_names[0])
    if model.frame(model.frame_names[0]).body == 0:
        assert (whole.center_of_mass == tw.center_of_mass(model, q)).all()
        assert (whole.inertia == tw.centroidal_inertia(model, q)).all()
        assert close(whole.momentum_map, tw.centroidal_map(model, q))
        assert float(whole.mass) == pytest.approx(model.mass, rel=1e-15)


@trees
@several
def test_its_maps_are_derivatives_and_its_momentum_is_that_of_its_bodies(recipe):
    model, s = recipe.model, recipe.state()
    body = 1 + recipe.seed % (model.nbodies - 1)
    frame = body_frame(model, body)
    part = tw.subtree(model, s.q, frame)
    later = tw.subtree(model, step(model, s.q, s.v), frame).center_of_mass
    assert close(part.jacobian @ s.v, rate(later), size=np.abs(part.center_of_mass).max() + np.abs(part.jacobian).max())
    kinematics = tw.forward_kinematics(model, s.q, s.v)
    momentum = np.zeros(6)
    for i in outboard(model.parent, body):
        T = kinematics.placement[i]
        X = tw.SE3(T.rotation, T.translation - part.center_of_mass).force_transform()
        momentum += X @ model.inertia[i].matrix() @ kinematics.twist[i]
    assert close(part.momentum_map @ s.v, momentum, size=np.abs(part.momentum_map).max())
    assert close(part.momentum_map[3:], part.mass * part.jacobian)


@trees
@several
def test_momentum_of_the_parts_is_that_of_the_whole(recipe):
    """The subtrees of the bodies on the world add up, each seen from the centre of mass of all."""
    model, s = recipe.model, recipe.state()
    G, total = tw.center_of_mass(model, s.q), np.zeros((6, model.nv))
    for i in range(1, model.nbodies):
        if model.parent[i] == 0:
            part = tw.subtree(model, s.q, body_frame(model, i))
            total += tw.SE3(np.eye(3), part.center_of_mass - G).force_transform() @ part.momentum_map
    assert close(total, tw.centroidal_map(model, s.q))


@trees
@several
def test_it_is_pinocchios(recipe):
    pin = pytest.importorskip("pinocchio")
    model, q = recipe.model, recipe.state().q
    there = tw.bridge.to_pinocchio_model(model)
    data = there.createData()
    pin.centerOfMass(there, data, q, True)
    placements = tw.forward_kinematics(model, q).placement
    for i in range(1, model.nbodies):
        part = tw.subtree(model, q, body_frame(model, i))
        assert close(part.mass, data.mass[i])
        assert close(part.center_of_mass, placements[i].act(np.array(data.com[i])), size=1.0)
        J = pin.jacobianSubtreeCenterOfMass(there, there.createData(), q, i).reshape(3, -1)
        J = tw.bridge.from_pinocchio_jacobian(model, np.r_[J, 0 * J])[3:]
        assert close(part.jacobian, J, size=1.0)


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_every_number_type_and_batch_is_kept(dtype, batch):
    recipe = Recipe(7, seed=4, base="floating")
    model, s = recipe.model, recipe.state(batch, dtype)
    part = tw.subtree(model, s.q, body_frame(model, 3))
    for name, tail in {
        "center_of_mass": (3,),
        "jacobian": (3, model.nv),
        "inertia": (6, 6),
        "momentum_map": (6, model.nv),
    }.items():
        x = getattr(part, name)
        assert (x.dtype, x.shape) == (dtype, (*batch, *tail)), name
    assert part.mass.dtype == dtype


def test_fractions_stay_exact():
    q = np.array([Fraction(3, 5), Fraction(4, 5), Fraction(5, 13), Fraction(-12, 13), Fraction(1, 3)])
    part = tw.subtree(wheels(), q, "a")
    assert part.mass == Fraction(9, 2)
    assert (part.momentum_map == tw.centroidal_map(wheels(), q)).all()


def test_a_part_without_mass_is_named():
    builder = tw.Builder("arm")
    builder.link(
        "arm", parent="base_link", joint=tw.Revolute("z"), inertia=tw.SpatialInertia(1, np.zeros(3), np.eye(3))
    )
    builder.link("tip", parent="arm", joint=tw.Revolute("z"))
    with pytest.raises(tw.SingularError, match="centre of mass of 'tip': nothing that moves has mass"):
        tw.subtree(builder.build(), [0.0, 0.0], "tip")
    with pytest.raises(tw.NameNotFound, match="'tap'"):
        tw.subtree(builder.build(), [0.0, 0.0], "tap")

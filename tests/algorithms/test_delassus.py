"""Λ⁻¹ = J M⁻¹ Jᵀ and Λ: closed forms, what the tree leaves out, and Pinocchio."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import twistwrench as tw

from ..invariants import body_frame, close, floating, several, trees
from ..mechanisms import C2, I2, M1, M2, agrees, cart_and_pole, newton_and_euler, states
from ..robots import shared
from ..strategies import BATCHES, REFERENCES, Recipe
from .test_factorization import TYPES, wheels
from .test_inverse_mass import EPS, loss


@states
def test_a_cart_feels_as_heavy_as_its_free_pole_leaves_it(q, v, a):
    model = cart_and_pole(q, v, a).model
    felt = M1 + M2 - (M2 * C2 * np.cos(q[1])) ** 2 / (I2 + M2 * C2**2)
    assert agrees(tw.operational_space_inertia(model, q, [[1.0, 0.0]]), [[felt]])
    assert agrees(tw.delassus_matrix(model, q, [[1.0, 0.0]]), [[1 / felt]])


@pytest.mark.parametrize("seed", range(3))
def test_a_point_of_a_free_body_has_the_mobility_of_the_textbook(seed):
    """Λ⁻¹ = 1/m − [r]× I⁻¹ [r]×, with r from the centre of mass to the point."""
    motion = newton_and_euler(seed)
    body = motion.model.inertia[1]
    R = tw.forward_kinematics(motion.model, motion.q).placement[1].rotation
    r = tw.skew(-R @ body.com)
    expected = np.eye(3) / body.mass - r @ np.linalg.inv(R @ body.inertia_at_com @ R.T) @ r
    J = tw.contact_jacobian(motion.model, motion.q, [body_frame(motion.model, 1)])
    assert agrees(tw.delassus_matrix(motion.model, motion.q, J), expected, 1e-13)


@trees
@several
def test_it_is_what_a_full_inverse_gives(recipe):
    model, q, frame = recipe.model, recipe.state().q, recipe.frame()
    M = tw.crba(model, q)
    for reference in REFERENCES:
        J = tw.frame_jacobian(model, q, frame, reference)
        if J.any():
            expected = J @ np.linalg.solve(M, J.T)
            assert close(tw.delassus_matrix(model, q, J), expected, 100 * EPS * loss(M))


@floating
@several
def test_of_the_base_it_is_the_articulated_inertia(recipe):
    model, q = recipe.model, recipe.state().q
    base = body_frame(model, 1)
    ours = tw.operational_space_inertia(model, q, tw.frame_jacobian(model, q, base))
    assert close(ours, tw.articulated_inertia(model, q, base), 100 * EPS * loss(tw.crba(model, q)))


def test_arms_on_one_fixed_base_do_not_meet():
    builder = tw.Builder("arms")
    body = tw.SpatialInertia(1.0, [0.1, 0.2, 0.3], np.diag([0.5, 0.6, 0.7]))
    for side in ("left", "right"):
        builder.link(f"{side} upper", parent="base_link", joint=tw.Revolute("y"), inertia=body)
        builder.link(f"{side} lower", parent=f"{side} upper", joint=tw.Revolute("x"), inertia=body)
    model = builder.build()
    q = np.array([0.3, -0.4, 0.5, 0.6])
    J = np.concatenate([tw.frame_jacobian(model, q, f"{side} lower") for side in ("left", "right")])
    across = tw.delassus_matrix(model, q, J)[:6, 6:]
    assert (across == 0).all()
    assert np.abs(tw.delassus_matrix(model, q, J)).max() > 0.1


def test_a_contact_without_friction_stops_by_its_inertia():
    """The impulse that stops a foot is Λ times its velocity, as `impact` finds it by another way."""
    model = shared("go2")
    q, v = model.standing(), np.linspace(-1, 1, model.nv)
    J = tw.contact_jacobian(model, q, ["FL_foot"])
    impulse = tw.impact(model, q, v, [tw.PointContact("FL_foot", 0.6)]).impulses["FL_foot"]
    assert close(tw.operational_space_inertia(model, q, J) @ -(J @ v), impulse)


@trees
@several
def test_it_is_pinocchios(recipe):
    pin = pytest.importorskip("pinocchio")
    model, q, frame = recipe.model, recipe.state().q, recipe.frame()
    there = tw.bridge.to_pinocchio_model(model)
    data = there.createData()
    Minv = pin.computeMinverse(there, data, q)
    J = pin.computeFrameJacobian(there, data, q, there.getFrameId(frame), pin.LOCAL).reshape(6, -1)
    if not J.any():
        return
    theirs = tw.bridge.from_pinocchio_transform(J @ Minv @ J.T)
    ours = tw.delassus_matrix(model, q, tw.frame_jacobian(model, q, frame))
    assert close(ours, theirs, 100 * EPS * loss(tw.crba(model, q)))


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_every_number_type_and_batch_is_kept(dtype, batch):
    recipe = Recipe(7, seed=4, base="floating")
    model, s = recipe.model, recipe.state(batch, dtype)
    J = tw.frame_jacobian(model, s.q, body_frame(model, 1))
    ours = tw.delassus_matrix(model, s.q, J), tw.operational_space_inertia(model, s.q, J)
    assert all(x.dtype == dtype and x.shape == (*batch, 6, 6) for x in ours)
    if ours[0].size:
        assert close(ours[0] @ ours[1], 0 * ours[0] + np.eye(6, dtype=dtype), 1e4 * np.finfo(dtype).eps)


def test_a_batch_of_jacobians_meets_one_posture_and_one_jacobian_a_batch_of_postures():
    model = tw.chain(3)
    many = np.random.default_rng(0).standard_normal((4, 2, 3))
    assert tw.delassus_matrix(model, np.zeros(3), many).shape == (4, 2, 2)
    assert tw.delassus_matrix(model, np.zeros((5, 3)), many[0]).shape == (5, 2, 2)
    with pytest.raises(tw.ShapeError, match=r"batch axes do not broadcast: q \(5,\), J \(4,\)"):
        tw.delassus_matrix(model, np.zeros((5, 3)), many)


def test_fractions_stay_exact():
    model, J = wheels(), np.array([[1, 2, 0], [0, 1, 3]])
    q = np.array([Fraction(3, 5), Fraction(4, 5), Fraction(5, 13), Fraction(-12, 13), Fraction(1, 3)])
    product = tw.delassus_matrix(model, q, J) @ tw.operational_space_inertia(model, q, J)
    assert (product == np.eye(2, dtype=int)).all()


def test_rows_that_depend_on_each_other_are_refused_with_J_named():
    model = shared("planar_arm")
    q = np.array([0.3, -0.4, 0.5])
    with pytest.raises(tw.SingularError, match="J: its rows depend on each other"):
        tw.operational_space_inertia(model, q, tw.frame_jacobian(model, q, "tool"))  # 6 rows, 3 joints
    with pytest.raises(tw.SingularError, match=r"J: its rows depend on each other at index \(1,\)"):
        tw.operational_space_inertia(model, q, [[[1.0, 0, 0], [0, 1, 0]], [[1.0, 1, 0], [2, 2, 0]]])
    with pytest.raises(tw.SingularError, match="J: its rows depend on each other"):
        tw.operational_space_inertia(wheels(), [Fraction(1), 0, 1, 0, 1], [[1, 1, 0], [2, 2, 0]])
    with pytest.raises(tw.ShapeError, match=r"J: expected shape \(\.\.\., m, 3\), got \(3,\); one row is J\[None\]"):
        tw.delassus_matrix(model, q, np.ones(3))

"""M⁻¹ without M, and the articulated inertia of a body: closed forms, invariants, Pinocchio, 50 digits."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import numpy as np
import pytest

import twistwrench as tw

from ..invariants import body_frame, close, floating, several, trees
from ..mechanisms import C2, I2, M1, M2, agrees, cart_and_pole, double_pendulum, states
from ..strategies import BATCHES, Recipe, examples
from ..truth import slow
from .test_factorization import TYPES, wheels

EPS = np.finfo(float).eps


def loss(M):
    """How many times the resolution an inverse may lose: the condition of M scaled to a diagonal of ones."""
    size = np.sqrt(np.diagonal(M))
    return np.linalg.cond(M / size[:, None] / size)


@states
def test_inverse_of_a_double_pendulum_is_that_of_a_two_by_two_matrix(q, v, a):
    motion = double_pendulum(q, v, a)
    (m11, m12), (_, m22) = motion.M
    adjugate = np.array([[m22, -m12], [-m12, m11]])
    assert agrees(tw.inverse_mass_matrix(motion.model, q), adjugate / (m11 * m22 - m12**2), 1e-13)


@states
def test_articulated_inertia_of_a_cart_is_what_its_free_pole_leaves_of_it(q, v, a):
    model = cart_and_pole(q, v, a).model
    along = tw.articulated_inertia(model, q, "cart")[3, 3]
    assert agrees(along, M1 + M2 - (M2 * C2 * np.cos(q[1])) ** 2 / (I2 + M2 * C2**2))


@trees
@examples(4)
def test_inverse_is_pinocchios_symmetric_and_right_to_fifty_digits(recipe):
    pin = pytest.importorskip("pinocchio")
    model, q = recipe.model, recipe.state().q
    ours, M = tw.inverse_mass_matrix(model, q), tw.crba(model, q)
    assert (ours == ours.T).all()
    true = mpmath.matrix(slow.mass_matrix(model, slow.as_mpmath(q)).tolist()) ** -1
    assert close(ours, np.array(true.tolist(), float), 100 * EPS * loss(M))
    there = tw.bridge.to_pinocchio_model(model)
    theirs = pin.computeMinverse(there, there.createData(), q)
    assert close(ours, tw.bridge.from_pinocchio_matrix(model, theirs), 100 * EPS * loss(M))


@trees
@several
def test_columns_of_the_inverse_are_the_accelerations_of_unit_forces(recipe):
    model, s = recipe.model, recipe.state()
    free = tw.aba(model, s.q, s.v, s.tau)
    for k, unit in enumerate(np.eye(model.nv)):
        change = tw.aba(model, s.q, s.v, s.tau + unit) - free
        assert close(change, tw.inverse_mass_matrix(model, s.q)[k], 1e-9, size=np.abs(free).max())


@trees
@several
def test_articulated_inertia_is_that_of_the_aba_and_never_above_the_composite_one(recipe):
    model, s = recipe.model, recipe.state()
    IA, IC = tw.aba_terms(model, s.q, s.v, s.tau).IA, tw.crba_terms(model, s.q).IC
    for i in range(1, model.nbodies):
        ours = tw.articulated_inertia(model, s.q, body_frame(model, i))
        assert close(ours, IA[i])
        assert np.linalg.eigvalsh(IC[i] - ours).min() > -1e-12 * np.abs(IC[i]).max()


@trees
@several
def test_articulated_inertia_of_a_frame_has_the_frames_axes(recipe):
    model, q, frame = recipe.model, recipe.state().q, recipe.frame()
    at = model.frame(frame)
    X = at.placement.force_transform()
    if at.body:
        ours = tw.articulated_inertia(model, q, frame)
        assert close(X @ ours @ X.T, tw.articulated_inertia(model, q, body_frame(model, at.body)))


@floating
@several
def test_articulated_inertia_is_pinocchios(recipe):
    pin = pytest.importorskip("pinocchio")
    model, s = recipe.model, recipe.state()
    there = tw.bridge.to_pinocchio_model(model)
    data = there.createData()
    pin.aba(there, data, s.q, *(tw.bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.tau)), pin.Convention.LOCAL)
    theirs = tw.bridge.from_pinocchio_transform(np.array(data.Yaba[1]))
    X = np.array(tw.bridge.from_pinocchio_se3(data.oMi[1]).motion_transform())
    assert X.shape == (6, 6)
    assert close(tw.articulated_inertia(model, s.q, body_frame(model, 1)), theirs, 1e-11)


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_every_number_type_and_batch_is_inverted(dtype, batch):
    recipe = Recipe(7, seed=4, base="floating")
    model, s = recipe.model, recipe.state(batch, dtype)
    ours, IA = tw.inverse_mass_matrix(model, s.q), tw.articulated_inertia(model, s.q, recipe.frame())
    assert ours.dtype == IA.dtype == dtype
    assert (ours.shape, IA.shape) == ((*batch, model.nv, model.nv), (*batch, 6, 6))
    if ours.size:
        assert close(ours @ tw.crba(model, s.q), ours * 0 + np.eye(model.nv, dtype=dtype), 1e4 * np.finfo(dtype).eps)


def test_fractions_are_inverted_exactly():
    model = wheels()
    q = np.array([Fraction(3, 5), Fraction(4, 5), Fraction(5, 13), Fraction(-12, 13), Fraction(1, 3)])
    assert (tw.inverse_mass_matrix(model, q) @ tw.crba(model, q) == np.eye(3, dtype=int)).all()


@pytest.mark.parametrize("function", [tw.inverse_mass_matrix, lambda model, q: tw.articulated_inertia(model, q, "tip")])
def test_a_joint_that_moves_nothing_is_named(function):
    builder = tw.Builder("ghost")
    builder.link("tip", parent="base_link", joint=tw.Revolute("z"))
    for q in ([0.0], [Fraction(0)]):
        with pytest.raises(tw.SingularError, match="no inertia outboard of joint 'tip'"):
            function(builder.build(), q)


def test_inverse_keeps_the_digits_that_a_factorisation_of_the_mass_matrix_loses():
    model = tw.chain(20, mass_ratio=1e6)
    q = np.full(20, 0.3)
    true = np.array((mpmath.matrix(slow.mass_matrix(model, slow.as_mpmath(q)).tolist()) ** -1).tolist(), float)
    ours = tw.inverse_mass_matrix(model, q)
    solved = np.linalg.inv(tw.crba(model, q))
    assert np.abs(ours - true).max() < 1e-2 * np.abs(solved - true).max()

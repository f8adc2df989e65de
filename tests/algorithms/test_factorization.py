"""M = Lᵀ D L along the tree: the zeros stay, the product is M, and the solves are those of Pinocchio."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench.plot import same_branch

from ..invariants import close, several, trees
from ..mechanisms import agrees, double_pendulum, states
from ..robots import shared
from ..sampling import sampled
from ..strategies import BATCHES, Recipe
from ..truth import SKEEL, slow

TYPES = [np.float32, np.float64, np.longdouble, np.complex64, np.complex128]


def product(L, D):
    return L.mT @ (D[..., None] * L)


# ---------------------------------------------------------------- closed forms


@states
def test_factors_of_a_double_pendulum_are_those_of_a_two_by_two_matrix(q, v, a):
    motion = double_pendulum(q, v, a)
    (m11, m12), (_, m22) = motion.M
    L, D = tw.ltdl(motion.model, q)
    assert agrees(D, [m11 - m12**2 / m22, m22])
    assert agrees(L, [[1, 0], [m12 / m22, 1]])
    assert agrees(tw.ltl(motion.model, q), [[np.sqrt(m11 - m12**2 / m22), 0], [m12 / np.sqrt(m22), np.sqrt(m22)]])
    det = m11 * m22 - m12**2
    assert agrees(tw.solve_mass_matrix(motion.model, q, a), [(m22 * a[0] - m12 * a[1]) / det,
                                                           (m11 * a[1] - m12 * a[0]) / det], 1e-13)  # fmt: skip


# ---------------------------------------------------------------- invariants


@trees
@several
def test_the_product_of_the_factors_is_the_mass_matrix_and_no_zero_is_filled_in(recipe):
    model, q = recipe.model, recipe.state().q
    (L, D), M = tw.ltdl(model, q), tw.crba(model, q)
    assert close(product(L, D), M)
    root = tw.ltl(model, q)
    assert close(root.mT @ root, M)
    assert (D > 0).all()
    assert (np.diagonal(L) == 1).all()
    for factor in (L, root):
        assert not factor[~same_branch(model)].any()
        assert not np.triu(factor, 1).any()


@trees
@several
def test_a_pivot_is_the_inertia_of_a_joint_whose_outboard_joints_are_free(recipe):
    model, s = recipe.model, recipe.state()
    D, terms = tw.ltdl(model, s.q)[1], tw.aba_terms(model, s.q, s.v, s.tau)
    for i in range(1, model.nbodies):
        size = np.linalg.norm(terms.D[i])
        assert close(np.prod(D[model.v_slice[i]]), np.linalg.det(terms.D[i]), 1e-11, size=size ** len(terms.D[i]))


def test_the_usual_order_of_cholesky_fills_the_zeros_in():
    model = shared("go2")
    q = model.random_configuration(rng=1)
    other = np.linalg.cholesky(tw.crba(model, q))
    assert np.count_nonzero(other[~same_branch(model)]) == 54  # six pairs of legs, nine entries each: all of them


@trees
@several
def test_a_rotor_stands_on_the_diagonal(recipe):
    model, q = recipe.model, recipe.state().q
    geared = replace(model, armature=model.armature + 0.5)
    assert close(product(*tw.ltdl(geared, q)), tw.crba(model, q) + 0.5 * np.eye(model.nv))


# ---------------------------------------------------------------- an outside oracle, and 50 digits


@trees
@several
def test_solves_are_pinocchios_and_right_to_fifty_digits(recipe):
    pin = pytest.importorskip("pinocchio")
    model, s = recipe.model, recipe.state()
    ours = tw.solve_mass_matrix(model, s.q, s.tau)
    M = slow.mass_matrix(model, slow.as_mpmath(s.q))
    assert residual(M, ours, s.tau) <= SKEEL * np.finfo(float).eps
    there = tw.bridge.to_pinocchio_model(model)
    data = there.createData()
    pin.crba(there, data, s.q)
    pin.cholesky.decompose(there, data)
    theirs = pin.cholesky.solve(there, data, tw.bridge.to_pinocchio_tangent(model, s.tau))
    theirs = tw.bridge.from_pinocchio_tangent(model, theirs)
    assert close(ours, theirs, 4 * SKEEL * np.finfo(float).eps * np.linalg.cond(tw.crba(model, s.q)))
    if all(joint is None or joint.nv < 6 for joint in model.joints):  # Pinocchio's (v, ω) of a free-flyer: another L
        L, D = tw.ltdl(model, s.q)
        assert close(L.T, data.U, 1e-10)
        assert close(D, data.D, 1e-10)


def residual(M, x, b):
    """How far M x is from b, measured by |M| |x| + |b|: the backward error of the solution."""
    left = M @ slow.as_mpmath(x) - slow.as_mpmath(b)
    size = np.abs(M.astype(x.dtype)) @ np.abs(x) + np.abs(b)
    return float(np.max(np.abs(left.astype(x.dtype)) / size.max()))


@pytest.mark.parametrize("n", sampled([10, 20], 1))
def test_of_a_heavy_tip_the_condition_of_M_is_lost_and_no_more(n):
    """Tip to base 1e9: errors of 1e-6 in solves and in accelerations of contacts are conditioning, by 50 digits.

    Skeel's condition bounds what rounding of the entries alone may change: |A⁻¹| (|A| |x| + |b|) times 2⁻⁵³, where A is
    M, and with a contact [M, −Jᵀ; J, 0]. M⁻¹ from the ABA loses nothing of it.
    """
    chain, q = tw.chain(n, mass_ratio=1e9), np.linspace(0.1, 1, n)
    rest, tau = np.zeros(n), np.array([1.0, -1.0] * (n // 2))
    tip = [tw.SlidingContact(chain.frame_names[-1], [[1, 0, 0], [0, 0, 1]])]
    exact, none = slow.as_mpmath(q), np.zeros((2, 2), int)
    M, h = slow.mass_matrix(chain, exact), slow.nonlinear_effects(chain, exact, slow.as_mpmath(rest))
    J = slow.frame_jacobian(chain, exact, tip[0].frame, "local_world_aligned")[[3, 5]]
    held = tw.contact_forward_dynamics(chain, q, rest, tau, tip)
    for A, b, got in (
        (M, slow.as_mpmath(tau), tw.solve_mass_matrix(chain, q, tau)),
        (np.block([[M, -J.T], [J, none]]), np.r_[slow.as_mpmath(tau) - h, 0, 0], np.r_[held.qdd, 0, 0]),
    ):
        inverse = np.array((mpmath.matrix(A.tolist()) ** -1).tolist(), object).reshape(A.shape)
        x = (inverse @ b).astype(float)
        size = np.abs(A.astype(float)) @ np.abs(x) + np.r_[np.abs(tau) + (len(b) > n) * np.abs(h.astype(float)), b[n:]]
        lost = (np.abs(inverse.astype(float)) @ size.astype(float))[:n].max() / np.abs(x[:n]).max()
        off = np.abs(got - x)[:n].max() / np.abs(x[:n]).max()
        assert 1e-9 < off < lost * 2.0**-53
        if len(b) == n:
            by_aba = tw.inverse_mass_matrix(chain, q)
            assert np.abs(by_aba - inverse.astype(float)).max() < 1e-12 * np.abs(by_aba).max()


# ---------------------------------------------------------------- number types, batches, errors


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_every_number_type_and_batch_is_factorised(dtype, batch):
    recipe = Recipe(7, seed=4, base="floating")
    model, s = recipe.model, recipe.state(batch, dtype)
    L, D = tw.ltdl(model, s.q)
    x = tw.solve_mass_matrix(model, s.q, s.tau)
    M = tw.crba(model, s.q)
    assert L.dtype == D.dtype == x.dtype == dtype
    assert (L.shape, D.shape, x.shape) == ((*batch, model.nv, model.nv), (*batch, model.nv), (*batch, model.nv))
    if L.size:
        eps = np.finfo(dtype).eps
        assert close(product(L, D), M, 100 * eps)
        assert close(np.matvec(M, x), s.tau, 1e4 * eps)


def test_tau_and_q_broadcast():
    model = tw.chain(3)
    x = tw.solve_mass_matrix(model, np.zeros((4, 1, 3)), np.ones((5, 3)))
    assert x.shape == (4, 5, 3)
    assert (x[2, 1] == tw.solve_mass_matrix(model, np.zeros(3), np.ones(3))).all()


def test_fractions_are_factorised_exactly():
    model = wheels()
    q = np.array([Fraction(3, 5), Fraction(4, 5), Fraction(5, 13), Fraction(-12, 13), Fraction(1, 3)])
    L, D = tw.ltdl(model, q)
    assert all(isinstance(x, Fraction) for x in D)
    assert (product(L, D) == tw.crba(model, q)).all()
    tau = np.array([Fraction(1, 7), Fraction(2), Fraction(-1, 3)])
    assert (tw.crba(model, q) @ tw.solve_mass_matrix(model, q, tau) == tau).all()


def wheels():
    builder = tw.Builder("wheels")
    body = tw.SpatialInertia(1.5, [0.25, 0.5, -0.125], np.diag([0.5, 0.75, 1.0]))
    builder.link("a", parent="base_link", joint=tw.Continuous("z"), inertia=body)
    builder.link("b", parent="a", joint=tw.Continuous("x"), inertia=body, placement=tw.SE3(np.eye(3), [0.5, 0, 1]))
    builder.link("c", parent="a", joint=tw.Prismatic("y"), inertia=body)
    return builder.build()


@pytest.mark.parametrize("function", [tw.ltdl, tw.ltl, lambda model, q: tw.solve_mass_matrix(model, q, [0.0, 0.0])])
@pytest.mark.parametrize("exact", [False, True])
def test_a_joint_that_moves_nothing_is_named(function, exact):
    builder = tw.Builder("ghost")
    builder.link(
        "arm", parent="base_link", joint=tw.Prismatic("z"), inertia=tw.SpatialInertia(1, np.zeros(3), np.eye(3))
    )
    builder.link("tip", parent="arm", joint=tw.Prismatic("z"))
    q = [Fraction(0), Fraction(1)] if exact else [0.0, 1.0]
    with pytest.raises(tw.SingularError, match="M is singular at joint 'tip'"):
        function(builder.build(), q)


def test_a_model_without_joints_has_empty_factors():
    L, D = tw.ltdl(tw.Builder("rock").build(), np.zeros(0))
    assert (L.shape, D.shape) == ((0, 0), (0,))

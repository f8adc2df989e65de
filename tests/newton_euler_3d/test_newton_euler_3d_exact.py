"""newton_euler_3d on fractions and on symbols: the same numbers as in doubles, and as the textbook's on them."""

from fractions import Fraction as F

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import newton_euler_3d as slow
from twistwrench.arrays import convert
from twistwrench.newton_euler_3d.exact import Exact

from ..robots import shared

EXACT = Exact(np.dtype(object))
TWO = tw.chain(2)


def rational(model, seed=0):
    """Draw a state whose sines and cosines are fractions: a quaternion of any length, joint angles 0."""
    rng = np.random.default_rng(seed)
    q = np.zeros(model.nq)
    if model.base == "floating":
        q[:7] = rng.integers(-8, 9, 7) / 8
    v, a = rng.integers(-8, 9, (2, model.nv)) / 8
    return tuple(convert(x, object) for x in (q, v, a))


def doubles(model, q, *others):
    q = q.astype(float)
    return (model.normalize(q) if model.base == "floating" else q, *(x.astype(float) for x in others))


def same(got, expected, tolerance=1e-13):
    assert all(isinstance(one, F) for one in np.asarray(got).flat)
    np.testing.assert_allclose(np.asarray(got).astype(float), expected, rtol=0, atol=tolerance * np.abs(expected).max())


@pytest.mark.one_case
@pytest.mark.parametrize("name", ["go2", "double_pendulum", "cart_pole"])
def test_fractions_give_what_doubles_give(name):
    model = tw.load(name)
    q, v, a = rational(model)
    floats = doubles(model, q, v, a)
    same(slow.inverse_dynamics(model, q, v, a), slow.inverse_dynamics(model, *floats))
    same(slow.mass_matrix(model, q), slow.mass_matrix(model, floats[0]))
    same(slow.coriolis_matrix(model, q, v), slow.coriolis_matrix(model, *floats[:2]))
    same(slow.centroidal_momentum(model, q, v), slow.centroidal_momentum(model, *floats[:2]))
    same(slow.body_accelerations(model, q, v, a), slow.body_accelerations(model, *floats))
    same(slow.potential_energy(model, q), slow.potential_energy(model, floats[0]))


def test_what_is_an_identity_holds_to_the_last_digit():
    model = shared("go2")
    q, v, a = rational(model)
    M, h = slow.mass_matrix(model, q), slow.nonlinear_effects(model, q, v)
    assert (M == M.T).all()
    assert (slow.inverse_dynamics(model, q, v, a) == M @ a + h).all()
    assert (slow.coriolis_matrix(model, q, v) @ v + slow.gravity(model, q) == h).all()
    assert (slow.centroidal_map(model, q) @ v == slow.centroidal_momentum(model, q, v)).all()
    assert (slow.forward_dynamics(model, q, v, M @ a + h) == a).all()


def test_spatial_algebra_and_vectors_agree_in_fractions_to_the_last_digit():
    model = shared("go2")
    q, v, a = rational(model)
    assert (tw.rnea(model, q, v, a) == slow.inverse_dynamics(model, q, v, a)).all()
    assert (tw.crba(model, q) == slow.mass_matrix(model, q)).all()
    assert (tw.centroidal_map(model, q) == slow.centroidal_map(model, q)).all()
    assert (tw.coriolis_matrix(model, q, v) == slow.coriolis_matrix(model, q, v)).all()
    assert (tw.aba(model, q, v, tw.rnea(model, q, v, a)) == a).all()
    assert tw.potential_energy(model, q) == slow.potential_energy(model, q)
    assert tw.kinetic_energy(model, q, v) == slow.kinetic_energy(model, q, v)
    J = tw.frame_jacobian(model, q, "FR_foot", "world")
    assert all(isinstance(one, F | int) for one in J.flat)
    same(J @ v + 0, tw.frame_jacobian(model, (at := doubles(model, q, v))[0], "FR_foot", "world") @ at[1])


@pytest.mark.slow(one_in=3)
def test_spatial_algebra_and_vectors_agree_in_symbols():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    q, v, a = (sympy.symbols(f"{name}1 {name}2") for name in "qva")
    fast = sympy.Matrix(tw.rnea(TWO, q, v, a)) - sympy.Matrix(slow.inverse_dynamics(TWO, q, v, a))
    assert fast.applyfunc(sympy.simplify) == sympy.zeros(2, 1)
    M, u = slow.mass_matrix(TWO, q), sympy.symbols("u1 u2")
    assert (sympy.Matrix(tw.aba(TWO, q, v, u)) - sympy.Matrix(slow.forward_dynamics(TWO, q, v, u))).subs(
        dict(zip((*q, *v, *u), (0.3, -0.8, 1.1, 0.7, 0.2, -0.4)))
    ).norm() < 1e-13
    pushed = sympy.Matrix(slow.forward_dynamics(TWO, q, v, u))
    left = sympy.Matrix(M) * pushed + sympy.Matrix(slow.nonlinear_effects(TWO, q, v)) - sympy.Matrix(u)
    assert left.applyfunc(sympy.simplify) == sympy.zeros(2, 1)


def test_a_joint_that_moves_nothing_is_refused_in_symbols_too():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    wheel = tw.Builder("weightless")
    wheel.link("rod", parent="base_link", joint=tw.Revolute("y"), inertia=tw.SpatialInertia(1, [0, 0, 1], np.eye(3)))
    wheel.link("tip", parent="rod", joint=tw.Revolute("y"), inertia=tw.SpatialInertia.zero())
    model = wheel.build(physical=False)
    for q in (sympy.symbols("q1 q2"), [F(0), 0]):
        with pytest.raises(tw.SingularError, match="no inertia resists the joints 'tip"):
            slow.forward_dynamics(model, q, [0, 0], [0, 0])
        with pytest.raises(tw.SingularError, match="no inertia outboard of joint 'tip"):
            tw.aba(model, q, [0, 0], [0, 0])


def test_placements_of_a_model_become_rotations_exactly():
    for seed in range(6):
        R = tw.exp3(np.random.default_rng(seed).standard_normal(3) * 2)
        exact = EXACT.rotation(R, "arm")
        assert (exact.T @ exact == np.eye(3)).all()
        assert abs(exact.astype(float) - R).max() < 1e-15
    with pytest.raises(tw.ModelError, match="arm: its placement is not a rotation"):
        EXACT.rotation(2 * np.eye(3), "arm")


def test_what_has_no_fraction_and_what_is_no_number_is_named():
    with pytest.raises(ValueError, match="the cos of 1/3 is not a fraction"):
        slow.mass_matrix(TWO, [F(0), F(1, 3)])
    with pytest.raises(ValueError, match=r"q: expected numbers, got None at index \(1,\)"):
        slow.mass_matrix(TWO, [F(0), None])
    with pytest.raises(ValueError, match="the quaternion is zero"):
        slow.mass_matrix(shared("go2"), [F(0)] * 19)

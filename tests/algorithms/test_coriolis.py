"""The Coriolis matrix: Christoffel's, that of the double pendulum, and the one with Ṁ − 2C skew-symmetric."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench import newton_euler_3d as ne

from ..invariants import H, close, hinges_and_slides, rate, several, step, trees
from ..mechanisms import agrees, double_pendulum_equations, mechanisms, states, two_bars
from ..robots import shared


@mechanisms
@states
def test_coriolis_matrix_times_velocity_is_that_of_the_textbook(mechanism, q, v, a):
    motion = mechanism(q, v, a)
    assert agrees(tw.coriolis_matrix(motion.model, motion.q, motion.v) @ motion.v, motion.C_v)


@states
def test_coriolis_matrix_of_the_double_pendulum_is_christoffels(q, v, a):
    assert agrees(tw.coriolis_matrix(two_bars(), q, v), double_pendulum_equations(q, v)[1])


@trees
@several
def test_coriolis_matrix_makes_the_forces_and_does_no_work(recipe):
    model, s = recipe.model, recipe.state()
    C, M_rate = tw.coriolis_matrix(model, s.q, s.v), rate(tw.crba(model, step(model, s.q, s.v)))
    size = np.abs(tw.crba(model, s.q)).max() * np.abs(s.v).max()
    bias = tw.nonlinear_effects(model, s.q, s.v) - tw.gravity(model, s.q)
    assert close(C @ s.v, bias, size=size * np.abs(s.v).max() + model.mass * 9.81)
    assert close(C + C.T, M_rate, size=size)  # Ṁ − 2C is skew-symmetric


@hinges_and_slides
@several
def test_coriolis_matrix_has_christoffels_symbols_and_lagranges_equations_hold(recipe):
    # Where v = q̇: C_ij = ½ Σ_k (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) v_k.
    model, s = recipe.model, recipe.state()
    dM = rate(tw.crba(model, s.q + 1j * H * np.eye(model.nv)))  # [k, i, j]: ∂M_ij/∂q_k
    christoffel = (np.einsum("kij,k->ij", dM, s.v) + np.einsum("jik,k->ij", dM, s.v)) / 2
    christoffel -= np.einsum("ijk,k->ij", dM, s.v) / 2
    size = np.abs(tw.crba(model, s.q)).max() * np.abs(s.v).max()
    assert close(tw.coriolis_matrix(model, s.q, s.v), christoffel, size=size)
    # d/dt (∂T/∂v) − ∂T/∂q + ∂U/∂q, with a = 0
    forces = np.einsum("kij,k,j->i", dM, s.v, s.v) - np.einsum("ijk,j,k->i", dM, s.v, s.v) / 2
    forces += rate(tw.potential_energy(model, s.q + 1j * H * np.eye(model.nv)))
    weight = model.mass * 9.81
    assert close(tw.nonlinear_effects(model, s.q, s.v), forces, size=size * np.abs(s.v).max() + weight)


# ---------------------------------------------------------------- a fast base


@trees
@several
def test_the_linear_velocity_of_a_floating_base_does_not_enter(recipe):
    model, s = recipe.model, recipe.state()
    if model.joints[1].nv == 6:
        fast = s.v + 1e6 * (np.arange(model.nv) // 3 == 1)
        assert np.array_equal(tw.coriolis_matrix(model, s.q, fast), tw.coriolis_matrix(model, s.q, s.v))


@pytest.mark.one_case
@pytest.mark.parametrize("speed", [1.0, 1e2, 1e4, 1e6])
def test_coriolis_matrix_times_velocity_keeps_its_digits_on_a_fast_base(speed):
    """V ×* I and I V× hold m v each, which cancels: at 10 km/s C v was off by 1e-7 N m, now by 1e-10."""
    model, rng = shared("go2"), np.random.default_rng(0)
    for _ in range(5):
        q, v = model.random_configuration(rng=rng), rng.standard_normal(model.nv)
        v[3:6] *= speed
        with mpmath.workdps(40):
            exact = [ne.inverse_dynamics(model, *map(ne.as_mpmath, (q, rate, 0 * v))) for rate in (v, 0 * v)]
            right = (exact[0] - exact[1]).astype(float)
        assert np.abs(tw.coriolis_matrix(model, q, v) @ v - right).max() < 2e-15 * np.abs(right).max()

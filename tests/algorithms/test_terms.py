"""The records of the recursions: what is in them, and the bias wrench that loses nothing at speed."""

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench import newton_euler_3d as exact
from twistwrench.spatial.formulas import bias_wrench, cross_force

from ..robots import shared

MODELS = [
    shared("go2"),
    shared("humanoid"),
    *(tw.random_tree(8, rng=s, base=b) for s in (3, 4) for b in ("fixed", "floating")),
]


def state(model, *batch):
    rng = np.random.default_rng(model.nv)
    q = np.array([model.random_configuration(rng=rng) for _ in range(int(np.prod(batch)))]).reshape(*batch, model.nq)
    f_ext = rng.standard_normal((model.nbodies, 6))
    f_ext[0] = 0
    return q, *rng.standard_normal((2, *batch, model.nv)), f_ext


@pytest.mark.parametrize("batch", [(), (1,), (2, 3)])
@pytest.mark.parametrize("model", MODELS, ids=lambda model: f"{model.name} {model.base} {model.nv}")
def test_every_term_has_the_batch_axes_of_the_state(model, batch):
    q, v, a, f_ext = state(model, *batch)
    n = [s.stop - s.start for s in model.v_slice]
    inverse, forward = tw.rnea_terms(model, q, v, a, f_ext), tw.aba_terms(model, q, v, a, f_ext)
    matrix, centroidal = tw.crba_terms(model, q), tw.centroidal_terms(model, q)
    for i in range(model.nbodies):
        for vectors in (inverse.V, inverse.A, inverse.B, inverse.F, forward.V, forward.c, forward.B, forward.pA):
            assert vectors[i].shape == (*batch, 6)
        for matrices in (forward.IA, forward.Ia, matrix.IC, centroidal.IC, centroidal.X):
            assert matrices[i].shape == (*batch, 6, 6)
        assert forward.U[i].shape == (*batch, 6, n[i])
        assert forward.D[i].shape == forward.D_inv[i].shape == (*batch, n[i], n[i])
        assert forward.u[i].shape == (*batch, n[i])
        for j in model.support(i):
            assert matrix.F[j, i].shape == (*batch, 6, n[i])
    np.testing.assert_array_equal(inverse.tau, tw.rnea(model, q, v, a, f_ext))
    np.testing.assert_array_equal(forward.qdd, tw.aba(model, q, v, a, f_ext))
    np.testing.assert_array_equal(matrix.M, tw.crba(model, q))
    np.testing.assert_array_equal(centroidal.A_G, tw.centroidal_map(model, q))


@pytest.mark.parametrize("model", MODELS, ids=lambda model: f"{model.name} {model.base} {model.nv}")
def test_a_batch_of_terms_holds_those_of_its_states(model):
    q, v, a, f_ext = state(model, 3)
    whole, one = tw.aba_terms(model, q, v, a, f_ext), tw.aba_terms(model, q[1], v[1], a[1], f_ext)
    for name in ("V", "IA", "pA", "U", "u", "Ia", "pa", "A"):
        for batch, single in zip(getattr(whole, name), getattr(one, name), strict=True):
            np.testing.assert_allclose(batch[1], single, rtol=0, atol=1e-12 * max(1, np.abs(single).max(initial=0)))


def test_terms_cannot_be_exchanged_and_take_no_memory_of_the_caller():
    model = shared("double_pendulum")
    q, v, tau = np.array([0.3, 0.4]), np.ones(2), np.ones(2)
    terms = tw.aba_terms(model, q, v, tau)
    before = [x.copy() for x in (*terms.u, *terms.V, terms.qdd)]
    q[:], v[:], tau[:] = 9, 9, 9
    for x, kept in zip((*terms.u, *terms.V, terms.qdd), before, strict=True):
        np.testing.assert_array_equal(x, kept)
    with pytest.raises(AttributeError):
        terms.qdd = tau


def test_a_record_prints_the_names_of_its_terms():
    model = shared("double_pendulum")
    assert repr(tw.rnea_terms(model, [0, 0], [0, 0], [0, 0])) == "RneaTerms(V, A, B, F, tau)"
    assert repr(tw.crba_terms(model, [0, 0])) == "CrbaTerms(IC, F, M)"


# ---------------------------------------------------------------- V ×* I V, without v × m v


def brick():
    builder = tw.Builder("brick", gravity=(0, 0, 0))
    inertia = tw.SpatialInertia(3.0, [0.3, -0.2, 0.1], np.diag([0.01, 0.02, 0.025]))
    builder.link("brick", parent="base_link", joint=tw.FreeFlyer(), inertia=inertia)
    return builder.build()


def test_the_bias_wrench_is_what_the_cross_product_says():
    rng = np.random.default_rng(0)
    for _ in range(20):
        A = rng.standard_normal((3, 3))
        I = tw.SpatialInertia(2.0, rng.standard_normal(3), A @ A.T + np.trace(A @ A.T) * np.eye(3)).matrix()
        V = rng.standard_normal((6, 1))
        np.testing.assert_allclose(bias_wrench(I, V), cross_force(V) @ I @ V, rtol=0, atol=1e-13 * np.abs(I).max())


@pytest.mark.parametrize("speed", [1.0, 1e2, 1e3, 1e6])
def test_a_body_that_only_slides_needs_no_wrench(speed):
    """A uniform motion: exactly zero, with its centre of mass away from the origin of its frame."""
    model = brick()
    v = np.array([0, 0, 0, 0.3, -0.7, 0.2]) * [1, 1, 1, speed, speed, speed]
    rest = np.zeros(6)
    assert not tw.rnea(model, model.neutral(), v, rest).any()
    assert not tw.aba(model, model.neutral(), v, rest).any()
    assert not tw.fast.aba(model, model.neutral(), v, rest).any()
    assert not tw.centroidal_momentum_rate(model, model.neutral(), v, rest).any()


@pytest.mark.parametrize("speed", [1.0, 1e2, 1e3, 1e4])
def test_the_error_of_a_turning_body_grows_with_its_speed_and_not_with_its_square(speed):
    """Against 40 digits; a tumbling body, whose centre of mass flies straight on."""
    model = brick()
    rng = np.random.default_rng(1)
    q, rest = model.random_configuration(rng=rng), np.zeros(6)
    for _ in range(10):
        v = rng.standard_normal(6) * [1, 1, 1, speed, speed, speed]
        with mpmath.workdps(40):
            truth = exact.forward_dynamics(model, *map(exact.as_mpmath, (q, v, rest))).astype(float)
        error = np.maximum(np.abs(tw.aba(model, q, v, rest) - truth), np.abs(tw.fast.aba(model, q, v, rest) - truth))
        assert error.max() < 1e-14 * max(1, speed) * 30  # |I⁻¹| m c ω v ε, with I⁻¹ m c of about 30 rad/m

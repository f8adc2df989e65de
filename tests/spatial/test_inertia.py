"""Spatial inertia and the spatial cross products (section 49.5)."""

import dataclasses
import warnings

import numpy as np
import pytest

from twistwrench.errors import ModelError, ShapeError
from twistwrench.spatial import SE3, SpatialInertia, Twist, cross_force, cross_motion, exp3, exp6, hat, vee

EPS = 2.0**-52
SHAPES = [(), (1,), (3, 1, 2), (0,)]
DTYPES = [np.float32, np.float64, np.longdouble, np.complex64, np.complex128, np.clongdouble]


def bodies(seed, shape=(8,), dtype=np.float64):
    """Bodies made of mass points: physical by construction."""
    rng = np.random.default_rng(seed)
    x, mass, com = rng.normal(size=(*shape, 5, 3)), rng.uniform(0.5, 3, size=shape), rng.normal(size=(*shape, 3))
    x = x - x.mean(-2, keepdims=True)
    second = x.mT @ x
    I_c = np.trace(second, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) - second
    return SpatialInertia(mass.astype(dtype), com.astype(dtype), I_c.astype(dtype))


def placements(seed, shape=(8,)):
    return exp6(np.random.default_rng(seed).normal(size=(*shape, 6)))


# --- cross products ------------------------------------------------------------------------------


def test_cross_products_have_the_blocks_of_the_chapter():
    w, v = np.array([[0, -3, 2], [3, 0, -1], [-2, 1, 0]]), np.array([[0, -6, 5], [6, 0, -4], [-5, 4, 0]])
    zero = np.zeros((3, 3))
    np.testing.assert_array_equal(cross_motion([1, 2, 3, 4, 5, 6]), np.block([[w, zero], [v, w]]))
    np.testing.assert_array_equal(cross_force([1, 2, 3, 4, 5, 6]), np.block([[w, v], [zero, w]]))


def test_cross_product_of_twists_is_the_commutator_of_their_matrices():
    A, B = np.random.default_rng(0).normal(size=(2, 6))
    bracket = vee(hat(A) @ hat(B) - hat(B) @ hat(A))
    np.testing.assert_allclose(cross_motion(A) @ B, bracket, rtol=0, atol=4e-15)


def test_cross_product_of_twists_is_antisymmetric_and_obeys_jacobi():
    A, B, C = np.random.default_rng(1).normal(size=(3, 6))
    a, b, c = cross_motion(A), cross_motion(B), cross_motion(C)
    np.testing.assert_allclose(a @ B, -b @ A, rtol=0, atol=1e-15)
    np.testing.assert_allclose(a @ A, np.zeros(6), rtol=0, atol=1e-15)
    np.testing.assert_allclose(a @ (b @ C) + b @ (c @ A) + c @ (a @ B), np.zeros(6), rtol=0, atol=1e-14)


def test_cross_products_are_dual_so_that_power_is_carried_along():
    V, W, F = np.random.default_rng(2).normal(size=(3, 6))
    np.testing.assert_allclose((cross_force(V) @ F) @ W + F @ (cross_motion(V) @ W), 0, atol=4e-15)


def test_cross_products_are_the_rates_of_the_changes_of_frame():
    # d/dt X(exp(t V)) at t = 0 is V×, and of X* it is V×*.
    V = np.random.default_rng(3).normal(size=6)
    T = exp6(1e-30j * V)
    np.testing.assert_allclose(T.motion_transform().imag / 1e-30, cross_motion(V), rtol=0, atol=1e-15)
    np.testing.assert_allclose(T.force_transform().imag / 1e-30, cross_force(V), rtol=0, atol=1e-15)


def test_a_change_of_frame_carries_the_cross_product_along():
    T, V = placements(4, ()), np.random.default_rng(5).normal(size=6)
    X, Xf = T.motion_transform(), T.force_transform()
    np.testing.assert_allclose(cross_motion(X @ V), X @ cross_motion(V) @ np.linalg.inv(X), rtol=0, atol=2e-14)
    np.testing.assert_allclose(cross_force(X @ V), Xf @ cross_force(V) @ X.T, rtol=0, atol=2e-14)


# --- the matrix ----------------------------------------------------------------------------------


def test_exercise_49_5_1_by_hand():
    body = SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.01, 0.01, 0.005]))
    expected = [
        [0.03, 0, 0, 0, -0.2, 0],
        [0, 0.03, 0, 0.2, 0, 0],
        [0, 0, 0.005, 0, 0, 0],
        [0, 0.2, 0, 2, 0, 0],
        [-0.2, 0, 0, 0, 2, 0],
        [0, 0, 0, 0, 0, 2],
    ]
    np.testing.assert_allclose(body.matrix(), expected, rtol=1e-15, atol=0)
    assert np.linalg.eigvalsh(body.matrix()).min() > 0


def test_exercise_49_5_3_at_the_centre_of_mass_turning_and_sliding_come_apart():
    I_c = bodies(6, ()).inertia_at_com
    expected = np.block([[I_c, np.zeros((3, 3))], [np.zeros((3, 3)), 3 * np.eye(3)]])
    np.testing.assert_array_equal(SpatialInertia(3, [0, 0, 0], I_c).matrix(), expected)


def test_the_matrix_is_symmetric_positive_definite_and_gives_back_its_ten_numbers():
    body = bodies(7)
    M = body.matrix()
    np.testing.assert_array_equal(M, M.mT)
    assert np.linalg.eigvalsh(M).min() > 0
    back = SpatialInertia.from_matrix(M)
    np.testing.assert_array_equal(back.mass, body.mass)
    np.testing.assert_allclose(back.com, body.com, rtol=1e-15)
    np.testing.assert_allclose(back.inertia_at_com, body.inertia_at_com, rtol=0, atol=4e-15)


def test_momentum_and_energy_are_those_of_the_mass_points():
    rng = np.random.default_rng(8)
    m, x, V = rng.uniform(0.1, 1, size=7), rng.normal(size=(7, 3)), rng.normal(size=6)
    com = (m[:, None] * x).sum(0) / m.sum()
    r = x - com
    I_c = sum(mk * (rk @ rk * np.eye(3) - np.outer(rk, rk)) for mk, rk in zip(m, r, strict=True))
    body = SpatialInertia(m.sum(), com, I_c)
    speed = V[3:] + np.cross(V[:3], x)
    p = m[:, None] * speed
    np.testing.assert_allclose(body.momentum(V), np.append(np.cross(x, p).sum(0), p.sum(0)), rtol=1e-13)
    np.testing.assert_allclose(body.kinetic_energy(V), (p * speed).sum() / 2, rtol=1e-13)


def test_momentum_and_energy_are_those_of_the_matrix():
    body, V = bodies(9), np.random.default_rng(10).normal(size=(8, 6))
    momentum = np.matvec(body.matrix(), V)
    np.testing.assert_allclose(body.momentum(V), momentum, rtol=0, atol=2e-14)
    np.testing.assert_allclose(body.kinetic_energy(V), (V * momentum).sum(-1) / 2, rtol=1e-13)
    np.testing.assert_array_equal(body.momentum(V[0]), body.momentum(Twist(V[0])))


def test_complex_step_of_the_energy_is_the_momentum():
    body, V = bodies(11, ()), np.random.default_rng(12).normal(size=6)
    rate = body.kinetic_energy(V + 1e-30j * np.eye(6)).imag / 1e-30
    np.testing.assert_allclose(rate, body.momentum(V), rtol=1e-13)


def test_newton_euler_in_six_dimensions_is_euler_and_newton_at_the_centre_of_mass():
    body = SpatialInertia(2.0, np.zeros(3), bodies(13, ()).inertia_at_com)
    V, A = np.random.default_rng(14).normal(size=(2, 6))
    w, v = V[:3], V[3:]
    F = body.matrix() @ A + cross_force(V) @ body.momentum(V)
    moment = body.inertia_at_com @ A[:3] + np.cross(w, body.inertia_at_com @ w)
    np.testing.assert_allclose(F, np.append(moment, 2.0 * (A[3:] + np.cross(w, v))), rtol=0, atol=2e-14)


# --- change of frame -----------------------------------------------------------------------------


def test_change_of_frame_is_the_congruence_with_the_force_transform():
    body, T = bodies(15), placements(16)
    Xf = T.force_transform()
    moved = body.transform(T)
    np.testing.assert_allclose(moved.matrix(), Xf @ body.matrix() @ Xf.mT, rtol=0, atol=4e-13)
    np.testing.assert_array_equal(moved.inertia_at_com, moved.inertia_at_com.mT)


def test_energy_and_momentum_are_the_same_in_every_frame():
    body, T, V = bodies(17), placements(18), np.random.default_rng(19).normal(size=(8, 6))
    V_A, moved = np.matvec(T.motion_transform(), V), body.transform(T)
    np.testing.assert_allclose(moved.kinetic_energy(V_A), body.kinetic_energy(V), rtol=1e-12)
    np.testing.assert_allclose(moved.momentum(V_A), np.matvec(T.force_transform(), body.momentum(V)), atol=1e-12)


def test_parallel_axes_in_the_closed_form_of_a_rod():
    # About its end, m l²/3; about its middle, m l²/12.
    m, l = 3.0, 0.8
    rod = SpatialInertia(m, [0, 0, 0], np.diag([m * l**2 / 12, m * l**2 / 12, 0]))
    end = rod.transform(SE3(np.eye(3), [0, 0, l / 2])).matrix()
    np.testing.assert_allclose(np.diagonal(end)[:3], [m * l**2 / 3, m * l**2 / 3, 0], rtol=1e-15)


def test_a_thousand_kilometres_away_nothing_is_lost():
    body = bodies(20)
    T = SE3(exp3(np.random.default_rng(21).normal(size=(8, 3))), np.full(3, 1e6))
    back = body.transform(T).transform(T.inverse())
    np.testing.assert_allclose(back.inertia_at_com, body.inertia_at_com, rtol=0, atol=1e-13)
    np.testing.assert_allclose(back.com, body.com, rtol=0, atol=1e-9)  # the resolution of a position at 1e6 m
    lost = SpatialInertia.from_matrix(body.transform(T).matrix()).inertia_at_com
    assert np.abs(lost - body.transform(T).inertia_at_com).max() > 1e-6


# --- composite bodies ----------------------------------------------------------------------------


def test_inertias_add_as_their_matrices_do():
    a, b = bodies(22), bodies(23)
    np.testing.assert_allclose((a + b).matrix(), a.matrix() + b.matrix(), rtol=0, atol=2e-14)


def test_inertias_of_a_list_sum():
    parts = [SpatialInertia(m, [m, 0, 0], np.eye(3)) for m in (1.0, 2.0, 3.0)]
    assert sum(parts) == parts[0] + parts[1] + parts[2]
    with pytest.raises(TypeError, match="only inertias add"):
        1 + parts[0]


def test_two_halves_make_the_whole_rod_and_the_whole_without_one_is_the_other():
    m, l = 2.0, 1.0
    half = SpatialInertia(m / 2, [0, 0, 0], np.diag([1, 1, 0]) * (m / 2) * (l / 2) ** 2 / 12)
    lower, upper = (half.transform(SE3(np.eye(3), [0, 0, z])) for z in (l / 4, 3 * l / 4))
    whole = lower + upper
    np.testing.assert_allclose(whole.inertia_at_com, np.diag([1, 1, 0]) * m * l**2 / 12, rtol=1e-15)
    np.testing.assert_allclose(whole.com, [0, 0, l / 2], rtol=1e-15)
    np.testing.assert_allclose((whole - upper).inertia_at_com, half.inertia_at_com, rtol=1e-14, atol=1e-17)
    np.testing.assert_allclose((whole - upper).com, [0, 0, l / 4], rtol=1e-15)


def test_a_sum_far_from_the_origin_keeps_the_inertia_about_its_centre_of_mass():
    # At 2**40 m positions of quarters of a metre are exact, and so must the sum be: m₁m₂/m d² with d = 1 m.
    a = SpatialInertia(1.0, [2.0**40, 0, 0], np.eye(3))
    b = SpatialInertia(1.0, [2.0**40 + 1, 0, 0], np.eye(3))
    np.testing.assert_array_equal((a + b).inertia_at_com, np.diag([2, 2.5, 2.5]))


def test_sums_do_not_depend_on_their_order():
    a, b, c = bodies(24), bodies(25), bodies(26)
    np.testing.assert_array_equal((a + b).matrix(), (b + a).matrix())
    np.testing.assert_allclose(((a + b) + c).matrix(), (a + (b + c)).matrix(), rtol=0, atol=4e-14)


def test_nothing_added_changes_nothing_to_the_last_bit():
    body, zero = bodies(27, ()), SpatialInertia.zero()
    for whole in (body + zero, zero + body):
        for name in ("mass", "com", "inertia_at_com"):
            np.testing.assert_array_equal(getattr(whole, name), getattr(body, name))
    nothing = zero + zero
    np.testing.assert_array_equal(nothing.matrix(), np.zeros((6, 6)))
    np.testing.assert_array_equal(SpatialInertia.from_matrix(np.zeros((6, 6))).com, np.zeros(3))
    np.testing.assert_array_equal(zero.transform(placements(28, ())).matrix(), np.zeros((6, 6)))


def test_a_massless_rotor_adds_its_inertia_alone():
    rotor = SpatialInertia(0.0, [9, 9, 9], np.eye(3))
    body = bodies(29, ())
    whole = body + rotor
    np.testing.assert_array_equal(whole.com, body.com)
    np.testing.assert_allclose(whole.inertia_at_com, body.inertia_at_com + np.eye(3), rtol=1e-15)


# --- outside oracle ------------------------------------------------------------------------------


def test_pinocchio_has_the_same_inertias_in_its_own_order():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    swap = [3, 4, 5, 0, 1, 2]
    order = np.ix_(swap, swap)
    a, b, T = bodies(30, ()), bodies(31, ()), placements(32, ())
    V, F = np.random.default_rng(33).normal(size=(2, 6))
    A, B = (pin.Inertia(float(x.mass), x.com, x.inertia_at_com) for x in (a, b))
    M = pin.SE3(T.rotation, T.translation)
    np.testing.assert_allclose(a.matrix(), A.matrix()[order], rtol=0, atol=4e-15)
    np.testing.assert_allclose((a + b).matrix(), (A + B).matrix()[order], rtol=0, atol=2e-14)
    np.testing.assert_allclose(a.transform(T).matrix(), M.act(A).matrix()[order], rtol=0, atol=4e-14)
    motion, force = pin.Motion(V[swap]), pin.Force(F[swap])
    np.testing.assert_allclose(a.momentum(V), (A * motion).vector[swap], rtol=0, atol=1e-14)
    np.testing.assert_allclose(a.kinetic_energy(V), A.vtiv(motion) / 2, rtol=1e-13)
    np.testing.assert_allclose(cross_motion(V) @ F, motion.cross(pin.Motion(F[swap])).vector[swap], atol=1e-15)
    np.testing.assert_allclose(cross_force(V) @ F, motion.cross(force).vector[swap], atol=1e-15)


# --- what cannot be a body -----------------------------------------------------------------------


@pytest.mark.parametrize(
    "moments",
    [
        [1, 1, 1],  # ball
        [0.5, 1, 1.5],  # thin plate: on the edge of the triangle inequality
        [0, 0, 0],  # point mass
        [0, 1, 1],  # thin rod: on the edge of being positive definite
        [1, 1, 2 * (1 + 0.4e-9)],  # over the edge by rounding
    ],
)
def test_bodies_that_exist_pass_in_every_attitude(moments):
    for w in np.random.default_rng(34).normal(size=(20, 3)):
        R = exp3(w)
        SpatialInertia(1.0, [0, 0, 0], R @ np.diag(moments) @ R.T).check_physical("link")


@pytest.mark.parametrize(
    ("mass", "moments", "complaint"),
    [
        (0.0, [1, 1, 1], "link 'calf': the mass must be positive, got 0 kg"),
        (1.0, [-0.1, 1, 1], "link 'calf': .* positive definite, got principal moments -0.1, 1, 1 kg m²"),
        (1.0, [-2e-9, 1, 1], "link 'calf': .* positive definite"),
        (1.0, [1, 1, 10], "link 'calf': .*triangle inequality.*got 1, 1, 10 kg m²"),
        (1.0, [1, 1, 2 * (1 + 2e-9)], "link 'calf': .*triangle inequality"),
    ],
)
def test_bodies_that_cannot_exist_are_refused_with_link_condition_and_numbers(mass, moments, complaint):
    with pytest.raises(ModelError, match=complaint):
        SpatialInertia(mass, [0, 0, 0], np.diag(moments)).check_physical("calf")


def test_one_impossible_body_in_a_batch_is_found():
    batch = SpatialInertia(1.0, [0, 0, 0], np.stack([np.eye(3), np.diag([1, 1, 10])]))
    with pytest.raises(ModelError, match="got 1, 1, 10"):
        batch.check_physical("calf")
    bodies(35, (0,)).check_physical("none")


def test_numbers_that_are_no_inertia_are_refused():
    with pytest.raises(ModelError, match="mass: expected no negative mass, got -1 kg"):
        SpatialInertia(-1, [0, 0, 0], np.eye(3))
    with pytest.raises(ModelError, match=r"mass: .* got -2 kg at index \(1,\)"):
        SpatialInertia([1, -2, -3], [0, 0, 0], np.eye(3))
    with pytest.raises(ModelError, match=r"symmetric matrix, got \|I − Iᵀ\| = 1 kg m²"):
        SpatialInertia(1, [0, 0, 0], [[1, 1, 0], [0, 1, 0], [0, 0, 1]])
    with pytest.raises(ShapeError, match=r"com: expected shape \(\.\.\., 3\), got \(2,\)"):
        SpatialInertia(1, [0, 0], np.eye(3))
    with pytest.raises(ShapeError, match=r"batch axes \(2,\), \(4, 3\) and \(1,\) do not broadcast"):
        SpatialInertia([1, 2], np.zeros((4, 3, 3)), np.zeros((1, 3, 3)))
    with pytest.raises(ValueError, match="inertia_at_com: expected finite numbers, got nan"):
        SpatialInertia(1, [0, 0, 0], np.full((3, 3), np.nan))
    with pytest.raises(TypeError, match=r"SpatialInertia \+ ndarray"):
        bodies(36, ()) + np.eye(6)
    with pytest.raises(TypeError, match=r"ndarray \+ SpatialInertia"):
        np.eye(6) + bodies(36, ())


def test_a_matrix_that_is_no_spatial_inertia_is_refused():
    good = bodies(37, ()).matrix()
    swap = [3, 4, 5, 0, 1, 2]
    with pytest.raises(ModelError, match="I6: expected"):
        SpatialInertia.from_matrix(good[np.ix_(swap, swap)] + np.diag([0, 0, 0, 0, 0, 1.0]))
    for row, column in [(0, 1), (0, 4), (3, 0), (3, 3), (3, 4), (0, 3)]:
        wrong = good.copy()
        wrong[row, column] += 0.01
        with pytest.raises(ModelError, match="I6: expected"):
            SpatialInertia.from_matrix(wrong)
    massless = np.zeros((6, 6))
    massless[0, 4], massless[4, 0] = 1, 1
    with pytest.raises(ModelError, match="I6: expected"):
        SpatialInertia.from_matrix(massless)
    with pytest.raises(ShapeError, match=r"I6: expected shape \(\.\.\., 6, 6\)"):
        SpatialInertia.from_matrix(np.eye(3))


def test_the_room_for_an_inertia_ends_at_the_square_root_of_the_resolution():
    skewed = np.zeros((3, 3))
    skewed[0, 1] = EPS**0.5
    SpatialInertia(1, [0, 0, 0], np.eye(3) + 0.9 * skewed)
    with pytest.raises(ModelError, match="symmetric"):
        SpatialInertia(1, [0, 0, 0], np.eye(3) + 1.1 * skewed)
    M, off = np.eye(6), np.zeros((6, 6))
    off[3, 4] = EPS**0.5
    SpatialInertia.from_matrix(M + 0.9 * off)
    with pytest.raises(ModelError, match="I6: expected"):
        SpatialInertia.from_matrix(M + 1.1 * off)


# --- shapes, types -------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    body = bodies(38, shape, dtype)
    V = np.random.default_rng(39).normal(size=(*shape, 6)).astype(dtype)
    T = exp6(V)
    for x in (body, body + body, body.transform(T), SpatialInertia.from_matrix(body.matrix())):
        assert x.mass.shape == shape
        assert x.com.shape == (*shape, 3)
        assert x.inertia_at_com.shape == (*shape, 3, 3)
        assert x.mass.dtype == x.com.dtype == x.inertia_at_com.dtype == x.matrix().dtype == dtype
    assert cross_motion(V).shape == cross_force(V).shape == (*shape, 6, 6)
    assert cross_motion(V).dtype == cross_force(V).dtype == body.momentum(V).dtype == dtype
    assert body.kinetic_energy(V).shape == shape
    Xf = T.force_transform()
    scale = 64 * float(np.finfo(dtype).eps) * 50
    np.testing.assert_allclose(body.transform(T).matrix(), Xf @ body.matrix() @ Xf.mT, rtol=0, atol=scale)


def test_a_float32_body_in_a_float64_frame_is_float64_throughout():
    moved = bodies(38, (), np.float32).transform(placements(41, ()))
    assert moved.mass.dtype == moved.com.dtype == moved.inertia_at_com.dtype == np.float64


def test_rounding_in_the_two_halves_of_an_inertia_is_averaged():
    I_c = np.diag([1.0, 2.0, 2.5])
    I_c[0, 1] = 1e-9
    np.testing.assert_array_equal(SpatialInertia(1, [0, 0, 0], I_c).inertia_at_com[:2, :2], [[1, 5e-10], [5e-10, 2]])


def test_one_body_meets_a_batch_of_frames_and_twists():
    body, T, V = bodies(40, ()), placements(41, (5,)), np.random.default_rng(42).normal(size=(5, 6))
    moved = body.transform(T)
    assert moved.mass.shape == (5,)
    assert (moved + body).matrix().shape == (5, 6, 6)
    assert body.momentum(V).shape == (5, 6)
    assert moved.momentum(V[0]).shape == (5, 6)
    assert moved.kinetic_energy(V[0]).shape == (5,)


def test_an_inertia_does_not_change():
    I_c = np.eye(3)
    body = SpatialInertia(1.0, np.zeros(3), I_c)
    I_c[0, 0] = 7
    np.testing.assert_array_equal(body.inertia_at_com, np.eye(3))
    with pytest.raises(dataclasses.FrozenInstanceError):
        body.mass = 2
    for x in (body, body + body, body.transform(SE3.identity())):
        with pytest.raises(ValueError, match="read-only"):
            x.com[0] = 1


def test_inertias_are_equal_where_their_ten_numbers_are():
    body = SpatialInertia(2.0, [0, 0, 0.1], np.diag([3, 2, 1]))
    assert SpatialInertia(2, [0, 0, 0.1], np.diag([3, 2, 1])) == body
    assert body + SpatialInertia.zero() == body
    for other in [(1, [0, 0, 0.1], [3, 2, 1]), (2, [0, 0, 0.2], [3, 2, 1]), (2, [0, 0, 0.1], [3, 2, 2])]:
        assert SpatialInertia(*other[:2], np.diag(other[2])) != body
    assert (body == body.matrix()) is False
    assert (SpatialInertia([2, 2], [0, 0, 0.1], np.diag([3, 2, 1])) == body) is False  # one answer, no broadcasting
    with pytest.raises(TypeError, match="unhashable"):
        hash(body)


def test_an_inertia_shows_itself():
    body = SpatialInertia(2 / 3, [0, 1e-9 / 3, 1], np.diag([3, 2, 1]) / 7e6)
    np.testing.assert_array_equal(eval(repr(body)).matrix(), body.matrix())
    assert max(map(len, repr(body).splitlines())) <= 100
    assert repr(bodies(43)) == "<SpatialInertia: a batch, shape (8,)>"


@pytest.mark.parametrize("method", ["momentum", "kinetic_energy"])
@pytest.mark.parametrize("size", [1e300, 1.7e308])
def test_a_speed_whose_products_overflow_is_refused_by_name(method, size):
    body = SpatialInertia(1e9, [0, 0, 0.1], np.eye(3))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=r"^V: expected smaller numbers"):
            getattr(body, method)(np.full(6, size))


def test_the_largest_inertia_is_not_halved_to_infinity():
    big = np.finfo(float).max * np.eye(3)
    assert np.array_equal(SpatialInertia(0.0, [0, 0, 0], big).inertia_at_com, big)


@pytest.mark.parametrize("cross", [cross_motion, cross_force])
def test_a_second_argument_is_told_where_it_belongs(cross):
    with pytest.raises(
        TypeError, match=rf"^V: expected one twist, shape .*, got 2 arguments; {cross.__name__}\(V\) @ "
    ):
        cross(np.ones(6), np.ones(6))

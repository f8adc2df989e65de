"""The forms of a spatial inertia: ten parameters, pseudo-inertia, principal axes, and the difference of two bodies."""

from fractions import Fraction

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.spatial import SE3, SpatialInertia, exp3, exp6

from .test_inertia import bodies

SHAPES = [(), (1,), (3, 1, 2), (0,)]
DTYPES = [np.float32, np.float64, np.longdouble, np.complex128]


def assert_same(a, b, atol=1e-14):
    for name in ("mass", "com", "inertia_at_com"):
        np.testing.assert_allclose(getattr(a, name), getattr(b, name), rtol=0, atol=atol)


# --- ten parameters ------------------------------------------------------------------------------


def test_the_parameters_are_entries_of_the_matrix_in_pinocchios_order():
    body = bodies(0)
    p, M = body.parameters(), body.matrix()
    np.testing.assert_array_equal(p[..., 0], M[..., 5, 5])
    np.testing.assert_array_equal(p[..., 1:4], M[..., [2, 0, 1], [4, 5, 3]])
    np.testing.assert_array_equal(p[..., 4:], M[..., [0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2]])
    assert_same(SpatialInertia.from_parameters(p), body)


def test_momentum_is_linear_in_the_parameters():
    a, b, V = bodies(1), bodies(2), np.random.default_rng(0).normal(size=(8, 6))
    both = SpatialInertia.from_parameters(a.parameters() + b.parameters())
    assert_same(both, a + b)
    np.testing.assert_allclose(both.momentum(V), a.momentum(V) + b.momentum(V), rtol=0, atol=1e-13)


def test_pinocchio_has_the_same_parameters_and_pseudo_inertia():
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    for k in range(8):
        a = bodies(3)
        body = SpatialInertia(a.mass[k], a.com[k], a.inertia_at_com[k])
        theirs = tw.bridge.to_pinocchio_inertia(body)
        np.testing.assert_allclose(body.parameters(), theirs.toDynamicParameters(), rtol=0, atol=1e-14)
        np.testing.assert_allclose(body.pseudo_inertia(), theirs.toPseudoInertia().toMatrix(), rtol=0, atol=1e-14)


# --- pseudo-inertia ------------------------------------------------------------------------------


def test_the_pseudo_inertia_is_the_sum_over_the_points_of_a_body():
    x, m = np.random.default_rng(4).normal(size=(6, 3)), np.arange(1.0, 7)
    body = sum(SpatialInertia.from_point(m[k], x[k]) for k in range(6))
    points = np.concatenate([x, np.ones((6, 1))], axis=-1)
    np.testing.assert_allclose(body.pseudo_inertia(), (points.T * m) @ points, rtol=0, atol=2e-14)
    assert_same(SpatialInertia.from_pseudo_inertia((points.T * m) @ points), body)


def test_the_pseudo_inertia_moves_with_the_homogeneous_matrix():
    body, T = bodies(5), exp6(np.random.default_rng(5).normal(size=(8, 6)))
    M = T.matrix()
    np.testing.assert_allclose(body.transform(T).pseudo_inertia(), M @ body.pseudo_inertia() @ M.mT, rtol=0, atol=5e-14)


def test_it_is_positive_definite_exactly_where_a_body_can_exist():
    rng, seen = np.random.default_rng(6), {True: 0, False: 0}
    for _ in range(400):
        R, moments = exp3(rng.normal(size=3)), rng.uniform(-0.3, 2, size=3)
        body = SpatialInertia(rng.uniform(0.1, 2), rng.normal(size=3), R @ np.diag(moments) @ R.T)
        definite = bool(np.linalg.eigvalsh(body.pseudo_inertia())[0] > 0)
        seen[definite] += 1
        if definite:
            body.check_physical("body")
        else:
            with pytest.raises(tw.ModelError, match="link 'body'"):
                body.check_physical("body")
    assert min(seen.values()) > 50


@pytest.mark.parametrize(
    ("body", "rank"),
    [
        (SpatialInertia.from_point(2.0, [1, 2, 3]), 1),
        (SpatialInertia.from_rod(2.0, 0.5), 2),
        (SpatialInertia.from_box(2.0, [1, 0.5, 0]), 3),
        (SpatialInertia.from_sphere(2.0, 0.5), 4),
    ],
)
def test_its_rank_is_the_dimension_of_the_body_and_one(body, rank):
    assert np.linalg.matrix_rank(body.pseudo_inertia()) == rank
    body.check_physical("a limit")


# --- principal axes ------------------------------------------------------------------------------


def test_the_principal_frame_makes_the_inertia_diagonal():
    body = bodies(7, (3, 20))
    moments, T = body.principal_axes()
    there = body.transform(T.inverse())
    np.testing.assert_allclose(there.com, 0, atol=1e-14)
    expected = np.zeros((3, 20, 3, 3))
    expected[..., [0, 1, 2], [0, 1, 2]] = moments
    np.testing.assert_allclose(there.inertia_at_com, expected, rtol=0, atol=1e-14 * moments.max())
    assert (np.diff(moments, axis=-1) >= 0).all()


def test_numpy_has_the_same_moments_and_axes():
    body = bodies(8)
    moments, T = body.principal_axes()
    theirs, axes = np.linalg.eigh(body.inertia_at_com)
    np.testing.assert_allclose(moments, theirs, rtol=0, atol=2e-14)
    np.testing.assert_allclose(np.abs((T.rotation * axes).sum(-2)), 1, rtol=0, atol=1e-13)


@pytest.mark.parametrize("moments", [[1, 1, 1], [0, 1, 1], [0, 0, 0], [1, 1, 2], [1e-9, 1, 1 + 1e-9], [1, 2, 3]])
def test_equal_and_zero_moments_are_found_as_well(moments):
    R = exp3([0.4, -1.0, 0.7])
    got, T = SpatialInertia(1.0, [1, 2, 3], R @ np.diag(moments) @ R.T).principal_axes()
    np.testing.assert_allclose(got, moments, rtol=0, atol=2e-15)
    np.testing.assert_allclose(T.rotation @ np.diag(got) @ T.rotation.T, R @ np.diag(moments) @ R.T, rtol=0, atol=4e-15)


def test_of_a_body_along_its_own_axes_the_frame_is_the_axes():
    moments, T = SpatialInertia(1.0, [1, 2, 3], np.diag([1, 2, 3])).principal_axes()
    np.testing.assert_array_equal(moments, [1, 2, 3])
    assert SE3(np.eye(3), [1, 2, 3]) == T


def test_principal_moments_of_a_long_double_have_its_digits():
    mp = pytest.importorskip("mpmath", reason="mpmath is not installed: the comparison with 50 digits is skipped")
    I_c = np.array([[4, 1, 0.5], [1, 3, -0.25], [0.5, -0.25, 2]])
    moments, _ = SpatialInertia(1.0, [0, 0, 0], I_c.astype(np.longdouble)).principal_axes()
    with mp.workdps(50):
        exact = sorted(mp.eigsy(mp.matrix(I_c.tolist()), eigvals_only=True))
        for one, truth in zip(moments, exact):
            high = float(one)
            off = mp.mpf(high) + mp.mpf(float(one - np.longdouble(high))) - truth
            assert abs(off) < 40 * float(np.finfo(np.longdouble).eps)


# --- difference ----------------------------------------------------------------------------------


def test_a_part_can_be_taken_away_again():
    a, b = bodies(9), bodies(10)
    assert_same((a + b) - b, a, atol=5e-14)
    np.testing.assert_allclose(((a + b) - b).matrix(), (a + b).matrix() - b.matrix(), rtol=0, atol=5e-14)
    nothing = a - a
    assert_same(nothing, SpatialInertia(np.zeros(8), np.zeros(3), np.zeros((3, 3))), atol=0)


def test_pinocchio_subtracts_to_the_same_body():
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    a, b = bodies(9), bodies(10)
    for k in range(8):
        one, two = (SpatialInertia(x.mass[k], x.com[k], x.inertia_at_com[k]) for x in (a, b))
        whole = tw.bridge.to_pinocchio_inertia(one + two)
        rest = tw.bridge.from_pinocchio_inertia(whole - tw.bridge.to_pinocchio_inertia(two))
        assert_same((one + two) - two, rest, atol=1e-13)


def test_a_hole_in_a_plate():
    plate, hole = SpatialInertia.from_box(9.0, [3, 3, 0]), SpatialInertia.from_box(1.0, [1, 1, 0])
    at = SE3(np.eye(3), [1, 0, 0])
    rest = plate - hole.transform(at)
    np.testing.assert_allclose(rest.com, [-1 / 8, 0, 0], rtol=1e-15)
    squares = [SE3(np.eye(3), [x, y, 0]) for x in (-1, 0, 1) for y in (-1, 0, 1) if (x, y) != (1, 0)]
    assert_same(rest, sum(hole.transform(T) for T in squares))


def test_more_than_there_is_cannot_be_taken_away():
    light, heavy = SpatialInertia.from_point(1.0), SpatialInertia.from_point(2.0)
    with pytest.raises(tw.ModelError, match="expected a part of the first, got 1 kg − 2 kg"):
        _ = light - heavy
    with pytest.raises(tw.ModelError, match="got 1 kg − 1 kg"):
        _ = light - SpatialInertia.from_point(1.0, [1, 0, 0])
    with pytest.raises(TypeError, match="SpatialInertia - ndarray"):
        _ = light - np.eye(6)


# --- number types, batches, errors ---------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    body = bodies(11, shape, dtype)
    back = SpatialInertia.from_parameters(body.parameters()), SpatialInertia.from_pseudo_inertia(body.pseudo_inertia())
    for other in (*back, (body + body) - body):
        assert (other.com.shape, other.com.dtype, other.inertia_at_com.dtype) == ((*shape, 3), dtype, dtype)
        assert_same(other, body, atol=1e3 * np.finfo(dtype).eps)
    if np.dtype(dtype).kind == "f":
        moments, T = body.principal_axes()
        assert (moments.shape, moments.dtype, T.rotation.dtype) == ((*shape, 3), dtype, dtype)
    else:
        with pytest.raises(ValueError, match="principal_axes: expected real floating-point numbers"):
            body.principal_axes()


def test_fractions_stay_exact():
    body = SpatialInertia(Fraction(3), [Fraction(1, 3), 0, 1], np.diag([1, 2, Fraction(5, 2)]))
    assert SpatialInertia.from_parameters(body.parameters()) == body
    assert SpatialInertia.from_pseudo_inertia(body.pseudo_inertia()) == body
    assert (body + body) - body == body


def test_errors_name_the_argument():
    with pytest.raises(tw.ModelError, match="p: m c is not zero, and the mass is"):
        SpatialInertia.from_parameters([0, 0, 0, 1, 1, 0, 1, 0, 0, 1])
    with pytest.raises(tw.ModelError, match="mass: expected no negative mass"):
        SpatialInertia.from_parameters([-1, 0, 0, 1, 1, 0, 1, 0, 0, 1])
    with pytest.raises(tw.ModelError, match="P: expected a symmetric matrix"):
        SpatialInertia.from_pseudo_inertia(np.triu(np.ones((4, 4))))
    with pytest.raises(tw.ShapeError, match=r"P: expected shape \(\.\.\., 4, 4\)"):
        SpatialInertia.from_pseudo_inertia(np.eye(3))


# --- scaling -------------------------------------------------------------------------------------


def test_a_body_as_many_times_as_dense_has_as_many_times_each_of_the_ten_numbers():
    body = SpatialInertia(2.0, [0.1, -0.2, 0.3], np.diag([0.01, 0.02, 0.025]))
    for scaled in (3 * body, body * 3.0, np.float64(3) * body, body / (1 / 3)):
        np.testing.assert_allclose(scaled.matrix(), 3 * body.matrix(), rtol=1e-15)
    batch = np.array([1.0, 2.0, 0.0]) * body
    np.testing.assert_allclose(batch.parameters(), np.outer([1, 2, 0], body.parameters()), rtol=1e-15, atol=1e-17)
    single = SpatialInertia(np.float32(2), np.zeros(3, np.float32), np.eye(3, dtype=np.float32))
    assert (2 * single).com.dtype == (single / 2).com.dtype == np.float32
    assert (Fraction(1, 3) * SpatialInertia(Fraction(1), [0, 0, 0], np.eye(3))).mass == Fraction(1, 3)


def test_what_no_body_can_be_scaled_by_is_refused_with_what_works():
    body = SpatialInertia(2.0, [0.1, -0.2, 0.3], np.diag([0.01, 0.02, 0.025]))
    for call in (lambda: -body, lambda: -2 * body, lambda: np.array([1.0, -2]) * body, lambda: body / -2):
        with pytest.raises(tw.ModelError, match=r"scale: .* not negative, got -.*parameters\(\)"):
            call()
    with pytest.raises(ZeroDivisionError):
        body / 0
    with pytest.raises(TypeError, match=r"SpatialInertia \* Twist: .* I @ V"):
        body * tw.Twist(np.zeros(6))
    with pytest.raises(TypeError, match=r"SpatialInertia \* SpatialInertia"):
        body * body
    with pytest.raises(ValueError, match="scale: expected numbers, got 'two'"):
        body * "two"


def test_a_scale_beside_exact_numbers_is_exact_in_all_ten():
    third = Fraction(1, 3) * SpatialInertia(0.5, [0, 0, 0.25], np.diag([1.0, 2.0, 3.0]))
    assert third.mass == Fraction(1, 6)
    assert isinstance(third.mass[()], Fraction)
    assert third.inertia_at_com.diagonal().tolist() == [Fraction(1, 3), Fraction(2, 3), 1]
    assert (third / Fraction(1, 3)).mass == Fraction(1, 2)


def test_a_body_is_divided_by_numbers_alone_and_without_overflow():
    body = SpatialInertia(2.0, [0, 0, 0.1], np.eye(3))
    for other in (tw.Twist(np.ones(6)), tw.Wrench(np.ones(6)), body):
        with pytest.raises(TypeError, match=f"for /: 'SpatialInertia' and '{type(other).__name__}'"):
            body / other
    for call in (lambda: 1e308 * body, lambda: body / 1e-320):
        with pytest.raises(ValueError, match="scale, mass, inertia_at_com: expected smaller numbers"):
            call()
    single = SpatialInertia(np.float32(2), np.zeros(3, np.float32), np.eye(3, dtype=np.float32))
    assert (single / np.array([2, 4])).mass.dtype == (single * np.array([2, 4])).mass.dtype == np.float32


# --- the nearest that a body can have ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("moments", "nearest"),
    [
        ((1, 2, 3.3), (1.1, 2.1, 3.2)),  # a plate
        ((-0.5, 2, 2.4), (0, 2.2, 2.2)),  # a rod
        ((-3, -2, -1), (0, 0, 0)),  # a point
        ((1, 2, 3), (1, 2, 3)),
        ((2, 3, 4), (2, 3, 4)),
    ],
)
def test_the_nearest_inertia_by_hand(moments, nearest):
    R = exp3([0.3, -0.4, 0.5])
    body = SpatialInertia(2.0, [0.1, 0.2, 0.3], R @ np.diag(moments) @ R.mT).nearest_physical()
    np.testing.assert_allclose(body.inertia_at_com, R @ np.diag(nearest) @ R.mT, rtol=0, atol=1e-14)
    body.check_physical("link")


def test_no_other_body_is_nearer():
    """Against a thousand bodies around it, and as the projection that it is: its own nearest is itself."""
    rng = np.random.default_rng(3)
    A = rng.standard_normal((50, 3, 3))
    wild = SpatialInertia(np.ones(50), np.zeros(3), A + A.mT)
    near = wild.nearest_physical()
    assert_same(near.nearest_physical(), near, atol=1e-13)
    away = np.linalg.norm(wild.inertia_at_com - near.inertia_at_com, axis=(-2, -1))
    for _ in range(1000):
        root = np.linalg.cholesky(near.pseudo_inertia()[:, :3, :3] + 1e-9 * np.eye(3))
        root = root + 0.1 * rng.standard_normal((50, 3, 3))
        Sigma = root @ root.mT  # of a body: positive semidefinite
        other = np.trace(Sigma, axis1=-2, axis2=-1)[:, None, None] * np.eye(3) - Sigma
        assert (np.linalg.norm(wild.inertia_at_com - other, axis=(-2, -1)) >= away * (1 - 1e-12)).all()


def test_a_body_that_can_be_is_its_own_nearest_to_the_last_bit():
    body = SpatialInertia.from_box(3.0, [0.1, 0.2, 0.3])
    np.testing.assert_array_equal(body.nearest_physical().inertia_at_com, body.inertia_at_com)
    with pytest.raises(tw.ModelError, match=r"nearest_physical.*0 kg"):
        SpatialInertia.zero().nearest_physical()

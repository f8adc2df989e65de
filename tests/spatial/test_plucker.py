"""Change of frame (section 49.3): X and X*, their inverses, their duality, and SE3."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest

from twistwrench.errors import ShapeError
from twistwrench.spatial import SE3, exp3, force_transform, motion_transform, skew

EPS = 2.0**-52
SHAPES = [(), (1,), (3, 1, 2), (0,)]
DTYPES = [np.float32, np.float64, np.longdouble, np.complex64, np.complex128, np.clongdouble]


def placements(seed, shape=(10,), dtype=np.float64):
    rng = np.random.default_rng(seed)
    w, p = rng.normal(size=(2, *shape, 3)).astype(dtype)
    return SE3(exp3(w), p)


# --- closed forms --------------------------------------------------------------------------------


def test_exercise_49_3_1_pure_translation():
    p = np.array([1.0, 2.0, 3.0])
    zero, one, cross = np.zeros((3, 3)), np.eye(3), [[0, -3, 2], [3, 0, -1], [-2, 1, 0]]
    X, Xf = motion_transform(one, p), force_transform(one, p)
    np.testing.assert_array_equal(X, np.block([[one, zero], [np.array(cross), one]]))
    np.testing.assert_array_equal(Xf, np.block([[one, np.array(cross)], [zero, one]]))
    np.testing.assert_array_equal(X @ motion_transform(one, -p), np.eye(6))


def test_exercise_49_3_2_pure_rotation_turns_both_halves_alike():
    R, zero = exp3([0.1, 0.2, 0.3]), np.zeros((3, 3))
    expected = np.block([[R, zero], [zero, R]])
    np.testing.assert_array_equal(motion_transform(R, np.zeros(3)), expected)
    np.testing.assert_array_equal(force_transform(R, np.zeros(3)), expected)


def test_a_quarter_turn_at_the_hip_by_hand():
    # B sits at (0, 1, 0) in A, its x axis along A's y. A twist along B's x axis (turning and sliding):
    T = SE3([[0, -1, 0], [1, 0, 0], [0, 0, 1]], [0, 1, 0])
    np.testing.assert_array_equal(T.motion_transform() @ [1, 0, 0, 2, 0, 0], [0, 1, 0, 0, 2, 0])
    np.testing.assert_array_equal(T.motion_transform() @ [0, 0, 1, 0, 0, 0], [0, 0, 1, 1, 0, 0])
    np.testing.assert_array_equal(T.force_transform() @ [0, 0, 0, 0, 1, 0], [0, 0, 1, -1, 0, 0])
    np.testing.assert_array_equal(T.act([1, 0, 0]), [0, 2, 0])


# --- invariants ----------------------------------------------------------------------------------


def test_exercise_49_3_3_transforms_chain():
    A, B = placements(0), placements(1)
    for name in ("motion_transform", "force_transform", "matrix"):
        chained, multiplied = getattr(A @ B, name)(), getattr(A, name)() @ getattr(B, name)()
        np.testing.assert_allclose(chained, multiplied, rtol=0, atol=1e-14)


def test_the_inverse_placement_has_the_inverse_transforms():
    T = placements(2)
    for name in ("motion_transform", "force_transform", "matrix"):
        forth, back = getattr(T, name)(), getattr(T.inverse(), name)()
        np.testing.assert_allclose(forth @ back, np.broadcast_to(np.eye(forth.shape[-1]), forth.shape), atol=4e-15)
        np.testing.assert_allclose(back, np.linalg.inv(forth), rtol=0, atol=1e-14)


def test_the_transform_of_wrenches_is_the_inverse_transpose_and_not_the_transpose():
    T = placements(3)
    X, Xf = T.motion_transform(), T.force_transform()
    np.testing.assert_allclose(Xf, np.linalg.inv(X).mT, rtol=0, atol=1e-14)
    np.testing.assert_allclose(Xf, T.inverse().motion_transform().mT, rtol=0, atol=4e-15)
    assert np.abs(Xf - X.mT).max() > 1


def test_power_is_the_same_in_every_frame():
    T = placements(4)
    V, F = np.random.default_rng(5).normal(size=(2, 10, 6))
    moved = (np.matvec(T.force_transform(), F) * np.matvec(T.motion_transform(), V)).sum(-1)
    np.testing.assert_allclose(moved, (F * V).sum(-1), rtol=0, atol=4e-14)


def test_a_point_of_the_body_has_one_velocity_whichever_frame_tells_it():
    T = placements(6)
    V, x = np.random.default_rng(7).normal(size=(10, 6)), np.random.default_rng(8).normal(size=(10, 3))
    in_B = np.cross(V[:, :3], x) + V[:, 3:]
    V_A = np.matvec(T.motion_transform(), V)
    in_A = np.cross(V_A[:, :3], T.act(x)) + V_A[:, 3:]
    np.testing.assert_allclose(in_A, np.matvec(T.rotation, in_B), rtol=0, atol=1e-14)


def test_the_moment_about_a_point_is_one_vector_whichever_frame_tells_it():
    T = placements(9)
    F, x = np.random.default_rng(10).normal(size=(10, 6)), np.random.default_rng(11).normal(size=(10, 3))
    about_x_in_B = F[:, :3] - np.cross(x, F[:, 3:])
    F_A = np.matvec(T.force_transform(), F)
    about_x_in_A = F_A[:, :3] - np.cross(T.act(x), F_A[:, 3:])
    np.testing.assert_allclose(about_x_in_A, np.matvec(T.rotation, about_x_in_B), rtol=0, atol=1e-14)


def test_placements_keep_distances_and_form_a_group():
    A, B, C = placements(12), placements(13), placements(14)
    x, y = np.random.default_rng(15).normal(size=(2, 10, 3))
    np.testing.assert_allclose(np.linalg.norm(A.act(x) - A.act(y), axis=-1), np.linalg.norm(x - y, axis=-1), rtol=1e-14)
    np.testing.assert_allclose((A @ B).act(x), A.act(B.act(x)), rtol=0, atol=1e-14)
    np.testing.assert_allclose(((A @ B) @ C).matrix(), (A @ (B @ C)).matrix(), rtol=0, atol=1e-14)
    np.testing.assert_allclose((A @ A.inverse()).matrix() - np.eye(4), 0, atol=4e-15)
    np.testing.assert_array_equal((A @ SE3.identity()).matrix(), A.matrix())


def test_rotating_a_skew_matrix_rotates_its_vector():
    # The identity R [a]× Rᵀ = [R a]× on which the derivation of X rests.
    R, a = exp3([0.3, -1.0, 0.5]), np.array([1.0, -2.0, 0.5])
    np.testing.assert_allclose(R @ skew(a) @ R.T, skew(R @ a), rtol=0, atol=2e-15)


# --- outside oracle ------------------------------------------------------------------------------


def test_pinocchio_has_the_same_transforms_in_its_own_order():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    swap = [3, 4, 5, 0, 1, 2]
    T = placements(16, ())
    theirs = pin.SE3(T.rotation, T.translation)
    order = np.ix_(swap, swap)
    np.testing.assert_allclose(T.motion_transform(), theirs.action[order], rtol=0, atol=2 * EPS)
    np.testing.assert_allclose(T.inverse().motion_transform(), theirs.actionInverse[order], rtol=0, atol=4 * EPS)
    np.testing.assert_allclose(T.force_transform(), theirs.dualAction[order], rtol=0, atol=2 * EPS)
    np.testing.assert_allclose(T.inverse().matrix(), theirs.inverse().homogeneous, rtol=0, atol=4 * EPS)
    np.testing.assert_array_equal(T.matrix(), theirs.homogeneous)


# --- shapes, types, bad input --------------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    T = placements(17, shape, dtype)
    tolerance = 32 * float(np.finfo(dtype).eps)
    assert T.rotation.shape == (*shape, 3, 3)
    for M in (T.motion_transform(), T.force_transform(), motion_transform(T.rotation, T.translation)):
        assert M.shape == (*shape, 6, 6)
        assert M.dtype == dtype
    product = (T @ T.inverse()).matrix()
    assert product.shape == (*shape, 4, 4)
    assert product.dtype == T.act(T.translation).dtype == dtype
    np.testing.assert_allclose(product - np.eye(4), np.zeros((*shape, 4, 4)), atol=tolerance)
    np.testing.assert_array_equal(SE3.from_matrix(T.matrix()).matrix(), T.matrix())


def test_rotation_and_translation_broadcast():
    T = SE3(np.eye(3), np.ones((2, 3)))
    assert T.rotation.shape == (2, 3, 3)
    assert (T @ SE3(np.broadcast_to(np.eye(3), (5, 1, 3, 3)), np.zeros(3))).translation.shape == (5, 2, 3)
    assert T.act(np.zeros((4, 1, 3))).shape == (4, 2, 3)
    with pytest.raises(ShapeError, match=r"^point: expected shape \(\.\.\., 3\), got \(2,\)"):
        SE3.identity().act([1, 2])
    with pytest.raises(ShapeError, match=r"batch axes \(2,\) and \(4, 3\) do not broadcast"):
        SE3(np.broadcast_to(np.eye(3), (2, 3, 3)), np.zeros((4, 3, 3)))


def test_complex_step_gives_the_derivative_of_a_transform():
    # d/dp of the lower left block [p]× R along e is [e]× R.
    R = exp3([0.1, 0.2, 0.3])
    for e in np.eye(3):
        rate = motion_transform(R, np.ones(3) + 1e-30j * e).imag / 1e-30
        np.testing.assert_allclose(rate[3:, :3], skew(e) @ R, rtol=0, atol=EPS)


def test_a_placement_does_not_change():
    R, p = np.eye(3), np.zeros(3)
    T = SE3(R, p)
    p[0], R[0, 0] = 5, 7
    np.testing.assert_array_equal(T.matrix(), np.eye(4))
    with pytest.raises(dataclasses.FrozenInstanceError):
        T.translation = p
    for array in (T.translation, T.rotation, (T @ T).translation, T.inverse().rotation, SE3.identity().rotation):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 5
    for twin in (pickle.loads(pickle.dumps(T)), copy.deepcopy(T)):
        np.testing.assert_array_equal(twin.matrix(), T.matrix())


def test_only_placements_chain_with_the_matrix_product():
    T = SE3.identity()
    for other in (np.ones(3), np.eye(4), 2.0):
        advice = r"use T\.act\(x\) for points, T\.motion_transform\(\) @ x"
        with pytest.raises(TypeError, match=rf"^SE3 @ {type(other).__name__}: .* {advice}"):
            T @ other
    with pytest.raises(TypeError, match="ndarray @ SE3: only placements"):
        np.eye(4) @ T


@pytest.mark.parametrize("make", [SE3, motion_transform, force_transform])
def test_what_is_no_placement_is_refused(make):
    with pytest.raises(ShapeError, match=r"rotation: expected shape \(\.\.\., 3, 3\), got \(3,\)"):
        make([1, 0, 0], np.zeros(3))
    with pytest.raises(ShapeError, match=r"translation: expected shape \(\.\.\., 3\), got \(4,\)"):
        make(np.eye(3), np.zeros(4))
    with pytest.raises(ShapeError, match=r"rotation: expected a rotation matrix, got \|RᵀR − 1\| = 3"):
        make(2 * np.eye(3), np.zeros(3))
    with pytest.raises(ShapeError, match="reflection"):
        make(-np.eye(3), np.zeros(3))
    with pytest.raises(ValueError, match="translation: expected finite numbers, got inf"):
        make(np.eye(3), [0, 0, np.inf])


def test_a_matrix_with_a_wrong_last_row_is_refused():
    M = np.stack([np.eye(4), np.eye(4)])
    M[1, 3, 0] = 0.1
    with pytest.raises(ShapeError, match=r"last row, got \[0\.1, 0\.0, 0\.0, 1\.0\] at index \(1,\)"):
        SE3.from_matrix(M)


def test_the_room_for_a_last_row_ends_at_the_square_root_of_the_resolution():
    M = np.eye(4)
    M[3, 0] = 0.9 * EPS**0.5
    np.testing.assert_array_equal(SE3.from_matrix(M).matrix(), np.eye(4))
    M[3, 0] = 1.1 * EPS**0.5
    with pytest.raises(ShapeError, match="last row"):
        SE3.from_matrix(M)


def test_placements_are_equal_where_their_numbers_are():
    T = SE3(np.eye(3), [1, 2, 3])
    assert SE3.from_matrix(T.matrix()) == T
    assert T @ T.inverse() == SE3.identity()
    assert SE3(np.eye(3), [1, 2, 4]) != T
    assert SE3(np.diag([1, -1, -1]), [1, 2, 3]) != T
    assert (T.matrix() == T) is False
    assert (SE3(np.eye(3), [[1, 2, 3], [1, 2, 3]]) == T) is False  # one answer, and no broadcasting
    with pytest.raises(TypeError, match="unhashable"):
        hash(T)


def test_a_placement_shows_itself():
    T = SE3(np.eye(3), [1, 2, 3])
    assert repr(T) == (
        "SE3(rotation=[[1., 0., 0.],\n"
        "              [0., 1., 0.],\n"
        "              [0., 0., 1.]],\n"
        "    translation=[1., 2., 3.])"
    )
    for far in (1, 1e-200, 1e200):
        again = eval(repr(placed := SE3(exp3([0.1, 0.2, -0.3]), [-far / 3, far, 0])))
        np.testing.assert_array_equal(again.matrix(), placed.matrix())
        assert max(map(len, repr(placed).splitlines())) <= 100
    assert T._repr_latex_() == (
        r"$T = \begin{bmatrix} 1 & 0 & 0 & 1 \\ 0 & 1 & 0 & 2 \\ 0 & 0 & 1 & 3 \\ 0 & 0 & 0 & 1 \end{bmatrix}$"
    )
    for shape in [(4,), (2, 5)]:
        assert repr(placements(18, shape)) == f"<SE3: a batch of placements, shape {shape}>"
    assert placements(18)._repr_latex_() is None


def test_a_placement_in_the_place_of_a_rotation_is_led_to_its_own_method():
    for function in (motion_transform, force_transform):
        with pytest.raises(
            TypeError, match=rf"R, p: expected .*, got SE3 and None; did you mean T\.{function.__name__}"
        ):
            function(SE3.identity())
        with pytest.raises(TypeError, match=r"R, p: expected a rotation matrix and a point, got ndarray and None$"):
            function(np.eye(3))

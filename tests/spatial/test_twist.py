"""Twists (section 49.2): the matrix in se(3), the screw, and a type that refuses nonsense."""

import numpy as np
import pytest

from twistwrench.errors import FrameError, ShapeError, SingularError
from twistwrench.spatial import SE3, Screw, SpatialInertia, Twist, Wrench, exp3, exp6, hat, screw, vee

SHAPES = [(), (1,), (3, 1, 2), (0,)]
DTYPES = [np.float32, np.float64, np.longdouble, np.complex64, np.complex128, np.clongdouble]


def placement(seed):
    rng = np.random.default_rng(seed)
    return SE3(exp3(rng.normal(size=3)), rng.normal(size=3))


# --- hat and vee ---------------------------------------------------------------------------------


def test_exercise_49_2_2_matrix_of_driving_while_turning():
    wz, vx = 0.5, 2.0
    expected = [[0, -wz, 0, vx], [wz, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]
    np.testing.assert_array_equal(hat([0, 0, wz, vx, 0, 0]), expected)


def test_hat_gives_the_velocity_of_every_point_of_the_body():
    w, v, x = np.random.default_rng(0).normal(size=(3, 3))
    velocity = hat(np.append(w, v)) @ np.append(x, 1)
    np.testing.assert_allclose(velocity, np.append(np.cross(w, x) + v, 0), rtol=0, atol=1e-15)


def test_vee_undoes_hat_exactly():
    V = np.random.default_rng(1).normal(size=(5, 6))
    np.testing.assert_array_equal(vee(hat(V)), V)
    np.testing.assert_array_equal(vee(np.zeros((4, 4))), np.zeros(6))


def test_body_twist_is_the_rate_of_the_placement_seen_from_the_body():
    # T⁻¹ Ṫ of T(t) = T₀ exp(t V), differentiated by a complex step.
    V, T0 = np.random.default_rng(2).normal(size=6), placement(3).matrix()
    rate = T0 @ exp6(1e-30j * V).matrix().imag / 1e-30
    np.testing.assert_allclose(vee(np.linalg.solve(T0, rate)), V, rtol=0, atol=1e-14)


def test_spatial_twist_is_the_rate_of_the_placement_seen_from_the_world():
    T, V = placement(4), np.random.default_rng(5).normal(size=6)
    spatial = vee(T.matrix() @ hat(V) @ np.linalg.inv(T.matrix()))
    np.testing.assert_allclose(Twist(V).transform(T).vector, spatial, rtol=0, atol=1e-14)


def test_a_matrix_outside_se3_is_refused():
    with pytest.raises(ShapeError, match="skew-symmetric"):
        vee(np.diag([1.0, 0, 0, 0]))
    with pytest.raises(ShapeError, match=r"^M: expected a last row of zeros, got up to 1"):
        vee(exp6([0, 0, 1, 0, 0, 0]).matrix())
    with pytest.raises(ShapeError, match=r"^M: expected shape \(\.\.\., 4, 4\), got \(3, 3\)"):
        vee(np.zeros((3, 3)))


@pytest.mark.parametrize("rate", [1e-3, 1.0, 1e3])
def test_the_room_for_a_matrix_in_se3_ends_at_the_square_root_of_the_resolution(rate):
    M = hat([0, 0, rate, 0, 0, 0])
    M[3, 3] = 0.9 * 2.0**-26 * rate
    np.testing.assert_array_equal(vee(M), [0, 0, rate, 0, 0, 0])
    M[3, 3] = 1.1 * 2.0**-26 * rate
    with pytest.raises(ShapeError, match="last row of zeros"):
        vee(M)


# --- screws --------------------------------------------------------------------------------------


def test_a_revolute_joint_is_a_screw_of_pitch_zero():
    point, rate = np.array([0.2, -0.5, 0.0]), 3.0
    w = np.array([0, 0, rate])
    found = screw(np.append(w, -np.cross(w, point)))
    np.testing.assert_allclose(found.axis, [0, 0, 1])
    np.testing.assert_allclose(found.point, point, rtol=0, atol=1e-16)
    assert found.pitch == 0
    assert found.magnitude == rate


def test_a_prismatic_joint_is_a_screw_of_infinite_pitch():
    found = screw([0, 0, 0, 0, -4, 3])
    np.testing.assert_allclose(found.axis, [0, -0.8, 0.6], rtol=1e-15)
    np.testing.assert_array_equal(found.point, np.zeros(3))
    assert found.pitch == np.inf
    assert found.magnitude == 5


def test_a_negative_pitch_is_a_left_handed_screw():
    assert screw([0, 0, 2, 0, 0, -1]).pitch == -0.5


@pytest.mark.parametrize("of", ["twist", "wrench"])
def test_a_screw_gives_back_the_vector_it_came_from(of):
    V = np.random.default_rng(6).normal(size=(20, 6))
    s = screw(V, of=of)
    line = s.magnitude[:, None] * s.axis
    free = np.cross(s.point, line) + s.pitch[:, None] * line
    back = np.concatenate([line, free] if of == "twist" else [free, line], axis=-1)
    np.testing.assert_allclose(back, V, rtol=0, atol=4e-15)
    np.testing.assert_allclose((s.axis * s.axis).sum(-1), 1, rtol=1e-15)
    np.testing.assert_allclose((s.axis * s.point).sum(-1), 0, rtol=0, atol=1e-15)


def test_points_on_the_axis_move_along_it_only():
    V = np.random.default_rng(7).normal(size=6)
    s = screw(V)
    for t in (-3.0, 0.0, 5.0):
        velocity = V[3:] + np.cross(V[:3], s.point + t * s.axis)
        np.testing.assert_allclose(velocity, s.pitch * s.magnitude * s.axis, rtol=0, atol=4e-15)


def test_a_change_of_frame_moves_the_axis_and_leaves_pitch_and_magnitude():
    T, V = placement(8), np.random.default_rng(9).normal(size=6)
    old, new = screw(V), Twist(V).transform(T).screw()
    np.testing.assert_allclose([new.pitch, new.magnitude], [old.pitch, old.magnitude], rtol=1e-13)
    np.testing.assert_allclose(new.axis, T.rotation @ old.axis, rtol=0, atol=1e-15)
    np.testing.assert_allclose(np.cross(T.act(old.point) - new.point, new.axis), 0, atol=4e-15)


@pytest.mark.parametrize("rate", [1e-200, 1e-12, 1.0, 1e200])
def test_the_screw_of_a_slow_or_fast_turn_is_as_exact_as_its_numbers(rate):
    # v is exact here: it is its rounding, divided by the rate, that makes a slow screw uncertain in practice.
    s = screw([0, 0, rate, rate * 0.5, -rate * 2, rate * 0.25])
    np.testing.assert_allclose(s.point, [2, 0.5, 0], rtol=1e-15)
    np.testing.assert_allclose([s.pitch, s.magnitude], [0.25, rate], rtol=1e-15)


def test_rounding_in_the_velocity_moves_a_slow_axis_by_the_rounding_over_the_rate():
    point, rate = np.array([0.3, 0.7, 0.0]), 1e-8
    w = np.array([0, 0, rate])
    v = -np.cross(w, point) + np.array([1e-16, 0, 0])
    np.testing.assert_allclose(screw(np.append(w, v)).point - point, [0, 1e-8, 0], rtol=1e-6, atol=1e-15)


def test_screws_of_a_batch_may_mix_turns_and_translations():
    V = np.array([[0, 0, 2, 0, -2, 1], [0, 0, 0, 3, 0, 0]], dtype=float)
    s = screw(V)
    for k in range(2):
        for mine, alone in zip(s, screw(V[k]), strict=True):
            np.testing.assert_array_equal(mine[k], alone)


def test_an_axis_beyond_all_numbers_is_placed_in_its_batch():
    with pytest.raises(SingularError, match=r"too far away for floating-point numbers at index \(1,\)"):
        screw([[0, 0, 1, 0, 0, 0], [1e-300, 0, 0, 0, 1e300, 0]])


def test_a_twist_of_zero_has_no_screw():
    with pytest.raises(SingularError, match=r"zero twist has no axis at index \(1,\)"):
        screw([[0, 0, 1, 0, 0, 0], [0, 0, 0, 0, 0, 0]])
    with pytest.raises(SingularError, match="zero wrench has no axis"):
        screw(np.zeros(6), of="wrench")
    for kind in (Twist, Wrench):
        with pytest.raises(SingularError, match=f"zero {kind.__name__.lower()} has no axis"):
            kind(np.zeros(6)).screw()


def test_an_axis_beyond_the_largest_number_is_refused():
    with pytest.raises(SingularError, match="too far away for floating-point numbers"):
        screw([0, 0, 1e-300, 1e10, 0, 0])


def test_the_kind_of_a_plain_array_changes_its_screw_and_must_be_known():
    V = [0, 0, 2, 1, 0, 0]
    assert screw(V).magnitude == 2
    assert screw(V, of="wrench").magnitude == 1
    with pytest.raises(ValueError, match="expected 'twist' or 'wrench', got 'force'"):
        screw(V, of="force")
    with pytest.raises(TypeError, match="of='wrench', but x is a Twist"):
        screw(Twist(V), of="wrench")
    assert isinstance(screw(Twist(V), of="twist"), Screw)


# --- the type ------------------------------------------------------------------------------------


def test_twists_add_and_scale_like_vectors():
    a, b = np.random.default_rng(10).normal(size=(2, 6))
    for got, expected in [
        (Twist(a) + Twist(b), a + b),
        (Twist(a) - Twist(b), a - b),
        (-Twist(a), -a),
        (2 * Twist(a), 2 * a),
        (Twist(a) * np.float64(3), a * 3),
        (np.array([1.0, 2.0]) * Twist(a), np.stack([a, 2 * a])),
        (Twist(a) / 3, a / 3),
        (Twist(a) / np.array([1.0, 3.0]), np.stack([a, a / 3])),
        (sum([Twist(a), Twist(b)]), a + b),
    ]:
        assert type(got) is Twist
        np.testing.assert_array_equal(got.vector, expected)
        np.testing.assert_array_equal(np.asarray(got), expected)
    np.testing.assert_array_equal(Twist(a).angular, a[:3])
    np.testing.assert_array_equal(Twist(a).linear, a[3:])
    assert (Twist(a.astype(np.float32)) / 2).vector.dtype == np.float32


def test_what_does_not_divide_or_sum_is_refused():
    V = Twist(np.ones(6))
    for zero in (0, 0.0, np.array([1.0, 0.0])):
        with pytest.raises(ZeroDivisionError, match="Twist / 0"):
            V / zero
    for wrong in (lambda: V / V, lambda: 1 / V, lambda: V / Wrench(np.ones(6))):
        with pytest.raises(TypeError):
            wrong()
    with pytest.raises(TypeError, match="dual spaces"):
        sum([V, Wrench(np.ones(6))])
    for number in (1, 0.0, False):  # nothing but the 0 that sum starts from
        with pytest.raises(TypeError, match="both sides"):
            number + V


def test_a_twist_and_a_wrench_do_not_add():
    V, F = Twist(np.ones(6)), Wrench(np.ones(6))
    for wrong in (lambda: V + F, lambda: F + V, lambda: V - F, lambda: F - V):
        with pytest.raises(TypeError, match="dual spaces"):
            wrong()
    with pytest.raises(TypeError):
        V * F
    with pytest.raises(TypeError, match=r"Twist: expected one array of shape \(\.\.\., 6\), got 2; np\.concatenate"):
        Twist([0, 0, 1], [1, 0, 0])
    with pytest.raises(TypeError, match=r"Wrench\(Twist\): expected six numbers"):
        Wrench(V)


def test_a_twist_and_a_plain_array_do_not_add():
    V = Twist(np.ones(6))
    with pytest.raises(TypeError, match=r"Twist \+ ndarray: both sides"):
        V + np.ones(6)
    with pytest.raises(TypeError, match=r"ndarray \+ Twist: both sides"):
        np.ones(6) + V
    with pytest.raises(TypeError, match="Twist - list: both sides"):
        V - [1] * 6
    with pytest.raises(TypeError, match="ndarray - Twist: both sides"):
        np.ones(6) - V


def test_a_matrix_is_no_placement():
    for x in (Twist(np.zeros(6)), Wrench(np.zeros(6)), SpatialInertia(1.0, [0, 0, 0], np.eye(3))):
        with pytest.raises(TypeError, match=r"^T: expected an SE3, got ndarray; SE3\.from_matrix makes one of a 4 × 4"):
            x.transform(np.eye(4))


def test_a_matrix_times_a_twist_points_to_transform():
    with pytest.raises(TypeError, match=r"ndarray @ Twist: use V\.transform\(T\)"):
        np.eye(6) @ Twist(np.ones(6))


def test_frames_that_differ_are_refused_with_the_expression_and_both_frames():
    V, W = Twist(np.ones(6), frame="base"), Twist(np.ones(6), frame="world")
    with pytest.raises(FrameError, match=r"V\[base\] \+ V\[world\]: the frames differ"):
        V + W
    with pytest.raises(FrameError, match=r"V\[world\] - V\[base\]"):
        W - V


def test_a_frame_survives_what_does_not_change_it():
    V, anonymous = Twist(np.ones(6), frame="base"), Twist(np.ones(6))
    for x in (V + V, V - V, -V, 2 * V, V + anonymous, anonymous + V):
        assert x.frame == "base"
    assert (anonymous + anonymous).frame is None
    assert V.transform(SE3.identity()).frame is None
    assert V.transform(SE3.identity(), frame="world").frame == "world"


def test_twists_are_equal_where_numbers_and_frame_are():
    V = Twist([1, 2, 3, 4, 5, 6], frame="base")
    assert Twist(V.vector.astype(np.float32), frame="base") == V
    assert Twist(V.vector) != V
    assert V != -V
    assert (V.vector == V) is False
    assert (Wrench(V.vector, frame="base") == V) is False
    batch = Twist(np.stack([V.vector, V.vector]), frame="base")
    assert (batch == V) is False  # one answer, and no broadcasting
    assert batch == Twist(batch.vector, frame="base")
    assert batch != Twist([V.vector, -V.vector], frame="base")
    with pytest.raises(TypeError, match="unhashable"):
        hash(V)


def test_a_twist_keeps_its_own_numbers():
    x = np.ones(6)
    V = Twist(x)
    x[0] = 5
    np.testing.assert_array_equal(V.vector, np.ones(6))
    for array in (V.vector, V.angular, np.asarray(V)):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 5


def test_a_twist_shows_its_numbers_and_its_frame():
    V = Twist([0, 0, 0.5, 1e-7, 0, -2], frame="FR_foot")
    assert repr(V) == "Twist([0.0, 0.0, 0.5, 1e-07, 0.0, -2.0], frame='FR_foot')"
    assert eval(repr(V)).frame == "FR_foot"
    body = r"\begin{bmatrix} 0 \\ 0 \\ 0.5 \\ 1 \cdot 10^{-7} \\ 0 \\ -2 \end{bmatrix}$"
    assert V._repr_latex_() == r"${}^{\mathrm{FR\_foot}}\mathbf{V} = " + body
    assert Twist(V.vector)._repr_latex_() == r"$\mathbf{V} = " + body
    odd = Twist(V.vector, frame=r"a b_{c}^2 50%~#1 $x$&\y")
    shown = r"a\ b\_\{c\}\wedge 2\ 50\%\sim \#1\ \$x\$\&\backslash y"
    assert odd._repr_latex_() == rf"${{}}^{{\mathrm{{{shown}}}}}\mathbf{{V}} = " + body
    assert Twist(np.zeros((2, 6)))._repr_latex_() is None


@pytest.mark.parametrize("angular", [9e-16, -9e-16, 1e-300, 0.0])
def test_a_rotation_that_is_no_longer_than_its_noise_is_none(angular):
    """Both sides of the threshold, which the infinite pitch tells."""
    V = [0, 0, angular, 0, 2, 0]
    for s in (
        screw(V, noise=1e-15),
        screw(Twist(V), noise=1e-15),
        screw([0, 2, 0, 0, 0, angular], of="wrench", noise=1e-15),
    ):
        assert s.pitch == np.inf
        assert s.magnitude == 2
        np.testing.assert_array_equal(s.point, 0)
    turning = screw([0, 0, 1.1e-15, 0, 2, 0], noise=1e-15)
    assert turning.magnitude == 1.1e-15
    assert turning.pitch == 0


@pytest.mark.parametrize("noise", [-1.0, np.nan, "little"])
def test_a_noise_that_is_none_is_refused(noise):
    with pytest.raises(ValueError, match=r"^noise: expected"):
        screw([0, 0, 1, 0, 0, 0], noise=noise)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    V = np.random.default_rng(11).uniform(1, 2, size=(*shape, 6)).astype(dtype)
    assert hat(V).shape == (*shape, 4, 4)
    assert vee(hat(V)).dtype == Twist(V).vector.dtype == (2 * Twist(V)).vector.dtype == dtype
    moved = Twist(V).transform(exp6(V))
    assert moved.vector.shape == (*shape, 6)
    assert moved.vector.dtype == dtype
    axis, point, pitch, magnitude = screw(V)
    assert axis.shape == point.shape == (*shape, 3)
    assert pitch.shape == magnitude.shape == shape
    assert axis.dtype == point.dtype == pitch.dtype == magnitude.dtype == dtype


def test_complex_step_gives_the_derivative_of_a_screw():
    # The pitch ω·v/|ω|² has the derivative (v − 2 h ω)/|ω|² along ω and ω/|ω|² along v.
    V = np.random.default_rng(12).normal(size=6)
    w, v = V[:3], V[3:]
    got = screw(V + 1e-30j * np.eye(6)).pitch.imag / 1e-30
    expected = np.append(v - 2 * screw(V).pitch * w, w) / (w @ w)
    np.testing.assert_allclose(got, expected, rtol=1e-13)


def test_wrong_shapes_and_numbers_are_refused():
    with pytest.raises(ShapeError, match=r"vector: expected shape \(\.\.\., 6\), got \(3,\)"):
        Twist([1, 2, 3])
    with pytest.raises(ValueError, match="expected finite numbers"):
        Twist([0, 0, np.inf, 0, 0, 0])
    with pytest.raises(ShapeError, match=r"V: expected shape \(\.\.\., 6\)"):
        hat(np.zeros(4))
    with pytest.raises(ShapeError, match=r"x: expected shape \(\.\.\., 6\)"):
        screw(np.zeros(4))

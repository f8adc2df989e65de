"""Wrenches (section 49.4): contact forces, power, screws, and the dual type."""

import numpy as np
import pytest

from twistwrench.errors import FrameError, ShapeError
from twistwrench.spatial import (
    SE3,
    SpatialInertia,
    Twist,
    Wrench,
    cross_force,
    cross_motion,
    exp3,
    exp6,
    hat,
    power,
    screw,
)

SHAPES = [(), (1,), (3, 1, 2), (0,)]
DTYPES = [np.float32, np.float64, np.longdouble, np.complex64, np.complex128, np.clongdouble]

BODY = SpatialInertia(2.0, [0.1, 0, 0.2], np.diag([3, 2, 2]))


def placement(seed):
    rng = np.random.default_rng(seed)
    return SE3(exp3(rng.normal(size=3)), rng.normal(size=3))


# --- closed forms --------------------------------------------------------------------------------


def test_exercise_49_4_1_four_feet_share_the_weight_without_a_moment():
    # 12 kg on four feet: 29.43 N each, a pure force in the frame of the foot.
    feet = [[0.2, 0.15, -0.3], [0.2, -0.15, -0.3], [-0.2, 0.15, -0.3], [-0.2, -0.15, -0.3]]
    foot = Wrench([0, 0, 0, 0, 0, 12 * 9.81 / 4])
    assert foot.force[2] == pytest.approx(29.43, rel=1e-15)
    at_base = [foot.transform(SE3(np.eye(3), p), frame="base") for p in feet]
    total = at_base[0] + at_base[1] + at_base[2] + at_base[3]
    np.testing.assert_allclose(total.vector, [0, 0, 0, 0, 0, 12 * 9.81], rtol=0, atol=1e-14)
    assert total.frame == "base"


def test_exercise_49_4_2_a_point_contact_has_the_moment_of_its_lever_in_the_world():
    T, f = placement(0), np.array([1.0, -2.0, 30.0])
    world = Wrench(np.append(np.zeros(3), f)).transform(T)
    np.testing.assert_allclose(world.force, T.rotation @ f, rtol=1e-14)
    np.testing.assert_allclose(world.moment, np.cross(T.translation, T.rotation @ f), rtol=1e-14)


def test_exercise_49_4_3_centre_of_pressure_is_where_the_horizontal_moment_vanishes():
    cop, fz = np.array([0.05, -0.02, 0.0]), 80.0
    foot = Wrench([0, 0, 0, 0, 0, fz]).transform(SE3(np.eye(3), cop))
    np.testing.assert_allclose([-foot.moment[1] / fz, foot.moment[0] / fz], cop[:2], rtol=1e-14)


def test_power_is_moment_times_angular_velocity_plus_force_times_velocity():
    assert power([1, 2, 3, 4, 5, 6], [7, 8, 9, 10, 11, 12]) == 7 + 16 + 27 + 40 + 55 + 72


def test_a_pure_force_is_a_screw_of_pitch_zero_on_its_line_of_action():
    point, f = np.array([0.0, 0.4, -0.2]), np.array([10.0, 0.0, 0.0])
    s = screw(np.append(np.cross(point, f), f), of="wrench")
    np.testing.assert_allclose(s.axis, [1, 0, 0])
    np.testing.assert_allclose(s.point, point, rtol=0, atol=1e-16)
    assert s.pitch == 0
    assert s.magnitude == 10


def test_a_pure_couple_is_a_screw_of_infinite_pitch():
    s = Wrench([0, 3, 4, 0, 0, 0]).screw()
    np.testing.assert_allclose(s.axis, [0, 0.6, 0.8], rtol=1e-15)
    np.testing.assert_array_equal(s.point, np.zeros(3))
    assert s.pitch == np.inf
    assert s.magnitude == 5


# --- invariants ----------------------------------------------------------------------------------


def test_power_is_the_same_in_every_frame():
    F, V = np.random.default_rng(1).normal(size=(2, 6))
    for seed in range(5):
        T = placement(seed)
        moved = Wrench(F).transform(T) @ Twist(V).transform(T)
        np.testing.assert_allclose(moved, F @ V, rtol=0, atol=2e-14)


def test_a_change_of_frame_moves_the_axis_and_leaves_pitch_and_magnitude():
    T, F = placement(2), np.random.default_rng(3).normal(size=6)
    old, new = Wrench(F).screw(), Wrench(F).transform(T).screw()
    np.testing.assert_allclose([new.pitch, new.magnitude], [old.pitch, old.magnitude], rtol=1e-13)
    np.testing.assert_allclose(new.axis, T.rotation @ old.axis, rtol=0, atol=1e-15)
    np.testing.assert_allclose(np.cross(T.act(old.point) - new.point, new.axis), 0, atol=4e-15)


def test_the_power_of_a_wrench_on_a_twist_of_reciprocal_screws_vanishes():
    # A revolute joint carries any force whose line meets its axis: no power, hence no torque.
    w, on_axis, f = np.array([0.0, 0.0, 2.0]), np.array([0.0, 0.0, 0.7]), np.array([3.0, -1.0, 5.0])
    assert power(np.append(np.cross(on_axis, f), f), np.append(w, np.zeros(3))) == 0


def test_there_and_back_leaves_the_wrench():
    T, F = placement(4), np.random.default_rng(5).normal(size=6)
    np.testing.assert_allclose(Wrench(F).transform(T).transform(T.inverse()).vector, F, rtol=0, atol=1e-14)


# --- outside oracle ------------------------------------------------------------------------------


def test_pinocchio_moves_forces_the_same_way():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    swap = [3, 4, 5, 0, 1, 2]
    T = placement(6)
    F, V = np.random.default_rng(7).normal(size=(2, 6))
    theirs = pin.SE3(T.rotation, T.translation)
    np.testing.assert_allclose(Wrench(F).transform(T).vector[swap], theirs.act(pin.Force(F[swap])).vector, rtol=1e-13)
    np.testing.assert_allclose(Twist(V).transform(T).vector[swap], theirs.act(pin.Motion(V[swap])).vector, rtol=1e-13)
    np.testing.assert_allclose(power(F, V), pin.Motion(V[swap]).dot(pin.Force(F[swap])), rtol=1e-13)


# --- the type ------------------------------------------------------------------------------------


def test_power_can_be_written_in_four_ways():
    F, V = Wrench([1, 2, 3, 4, 5, 6]), Twist([7, 8, 9, 10, 11, 12])
    assert F @ V == V @ F == F.power(V) == power(F, V) == F.power(V.vector) == power(F.vector, V) == 217


def test_power_refuses_anything_but_a_wrench_and_a_twist():
    F, V = Wrench(np.ones(6)), Twist(np.ones(6))
    for wrong, came in [
        (lambda: power(V, F), "Twist, Wrench"),
        (lambda: power(V, V), "Twist, Twist"),
        (lambda: power(F, F), "Wrench, Wrench"),
        (lambda: F.power(F), "Wrench, Wrench"),
    ]:
        with pytest.raises(TypeError, match=rf"^power\({came}\): expected a wrench, then a twist"):
            wrong()
    with pytest.raises(TypeError, match="Wrench @ ndarray: expected a Twist"):
        F @ np.ones(6)
    with pytest.raises(TypeError, match=r"ndarray @ Wrench: use F\.transform"):
        np.eye(6) @ F
    with pytest.raises(TypeError):
        V @ V
    with pytest.raises(TypeError, match="F: expected a Wrench or an array, got a Twist"):
        power([F, V], V)
    with pytest.raises(TypeError, match="V: expected a Twist or an array, got a Wrench"):
        F.power([V, F])


@pytest.mark.parametrize("function", [hat, exp6, cross_motion, cross_force, BODY.momentum, BODY.kinetic_energy])
def test_a_wrench_where_a_twist_belongs_is_refused(function):
    with pytest.raises(TypeError, match="V: expected a Twist or an array, got a Wrench"):
        function(Wrench(np.ones(6)))
    with pytest.raises(TypeError, match="V: expected a Twist or an array, got a Wrench"):
        function([Twist(np.ones(6)), Wrench(np.ones(6))])
    typed, plain = function(Twist(np.ones(6))), function(np.ones(6))
    assert typed == plain if isinstance(plain, SE3) else (typed == plain).all()


def test_power_in_two_frames_is_refused_with_the_expression_and_both_frames():
    F, V = Wrench(np.ones(6), frame="foot"), Twist(np.ones(6), frame="world")
    for wrong in (lambda: F @ V, lambda: V @ F, lambda: F.power(V)):
        with pytest.raises(FrameError, match=r"F\[foot\] · V\[world\]: the frames differ"):
            wrong()
    assert F @ Twist(np.ones(6)) == 6
    assert F @ Twist(np.ones(6), frame="foot") == 6


def test_sums_of_wrenches_check_frames():
    F = Wrench(np.ones(6), frame="foot")
    np.testing.assert_array_equal((F + 2 * F - F).vector, 2 * np.ones(6))
    with pytest.raises(FrameError, match=r"F\[foot\] \+ F\[world\]"):
        F + Wrench(np.ones(6), frame="world")


def test_a_wrench_shows_itself():
    F = Wrench([0, 0, 1, 0, 0, 9.81], frame="foot")
    assert repr(F) == "Wrench([0.0, 0.0, 1.0, 0.0, 0.0, 9.81], frame='foot')"
    assert F._repr_latex_().startswith(r"${}^{\mathrm{foot}}\mathbf{F} = \begin{bmatrix} 0 \\ 0 \\ 1")


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    F = np.random.default_rng(8).uniform(1, 2, size=(*shape, 6)).astype(dtype)
    moved = Wrench(F).transform(exp6(F))
    assert moved.vector.shape == (*shape, 6)
    assert moved.vector.dtype == power(F, F).dtype == dtype
    assert power(F, np.ones(6, dtype)).shape == (Wrench(F) @ Twist(F)).shape == shape


def test_complex_step_gives_the_derivative_of_the_power():
    F, V = np.random.default_rng(9).normal(size=(2, 6))
    np.testing.assert_allclose(power(F, V + 1e-30j * np.eye(6)).imag / 1e-30, F, rtol=1e-15)


def test_wrong_shapes_are_refused():
    with pytest.raises(ShapeError, match=r"V: expected shape \(\.\.\., 6\), got \(3,\)"):
        power(np.ones(6), np.ones(3))
    with pytest.raises(ShapeError, match=r"F: expected shape \(\.\.\., 6\), got \(3,\)"):
        power(np.ones(3), np.ones(6))
    with pytest.raises(ShapeError, match=r"vector: expected shape"):
        Wrench(np.ones(3))

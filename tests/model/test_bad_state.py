"""What is wrong with a state is said at the door: which argument, what was expected, what came."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

import twistwrench as tw

from ..robots import shared

GO2 = shared("go2")
ARM = tw.chain(3)
STAND = GO2.standing()
REST = np.zeros(18)

BY_STATE = {
    "rnea": (tw.rnea, ("q", "v", "a", "f_ext")),
    "joint_wrenches": (tw.joint_wrenches, ("q", "v", "a", "f_ext")),
    "aba": (tw.aba, ("q", "v", "tau", "f_ext")),
    "crba": (tw.crba, ("q",)),
    "gravity": (tw.gravity, ("q",)),
    "nonlinear_effects": (tw.nonlinear_effects, ("q", "v")),
    "coriolis_matrix": (tw.coriolis_matrix, ("q", "v")),
    "kinetic_energy": (tw.kinetic_energy, ("q", "v")),
    "potential_energy": (tw.potential_energy, ("q",)),
    "center_of_mass": (tw.center_of_mass, ("q",)),
    "centroidal_map": (tw.centroidal_map, ("q",)),
    "centroidal_momentum": (tw.centroidal_momentum, ("q", "v")),
    "centroidal_momentum_rate": (tw.centroidal_momentum_rate, ("q", "v", "a")),
    "forward_kinematics": (tw.forward_kinematics, ("q", "v", "a")),
    "dynamics": (tw.dynamics, ("q", "v")),
    "frame_placement": (lambda m, q: tw.frame_placement(m, q, "FR_foot"), ("q",)),
    "frame_jacobian": (lambda m, q: tw.frame_jacobian(m, q, "FR_foot"), ("q",)),
    "frame_bias_acceleration": (lambda m, q, v: tw.frame_bias_acceleration(m, q, v, "FR_foot"), ("q", "v")),
    "contact_jacobian": (lambda m, q: tw.contact_jacobian(m, q, ["FR_foot"]), ("q",)),
    "static_equilibrium": (tw.static_equilibrium, ("q",)),
    "integrate": (lambda m, q, v_dt: m.integrate(q, v_dt), ("q", "v_dt")),
    "difference": (lambda m, q0, q1: m.difference(q0, q1), ("q0", "q1")),
    "normalize": (lambda m, q: m.normalize(q), ("q",)),
}
EACH = [(name, argument) for name, (_, arguments) in BY_STATE.items() for argument in arguments]
every_argument = pytest.mark.parametrize(("name", "argument"), EACH, ids=[f"{n}-{a}" for n, a in EACH])


def good(argument):
    if argument == "f_ext":
        return np.zeros((GO2.nbodies, 6))
    return STAND.copy() if argument.startswith("q") else REST.copy()


def call(name, **changed):
    function, arguments = BY_STATE[name]
    return function(GO2, **({argument: good(argument) for argument in arguments} | changed))


# ---------------------------------------------------------------- shapes


@every_argument
def test_wrong_shape_says_which_argument_and_what_was_expected(name, argument):
    expected = r"\(\.\.\., 14, 6\)" if argument == "f_ext" else r"\(\.\.\., 1[89]\)"
    for bad in (good(argument)[..., :-1], good(argument)[..., None], 1.0):
        with pytest.raises(tw.ShapeError, match=rf"{argument}: expected shape {expected}, got \("):
            call(name, **{argument: bad})


@every_argument
def test_nq_taken_for_nv_is_recognised(name, argument):
    if argument == "f_ext":
        return
    swapped, looks = (REST, "nv") if argument.startswith("q") else (STAND, "nq")
    with pytest.raises(tw.ShapeError, match=f"this looks like {looks}") as error:
        call(name, **{argument: swapped})
    assert str(error.value).startswith(argument)
    assert "q has nq = 19" in str(error.value)
    assert "v has nv = 18" in str(error.value)


def test_no_confusion_is_suspected_where_nq_is_nv():
    with pytest.raises(tw.ShapeError, match=r"^q: expected shape \(\.\.\., 3\), got \(4,\)$"):
        tw.crba(ARM, np.zeros(4))


@every_argument
def test_rows_of_different_lengths_are_named(name, argument):
    with pytest.raises(tw.ShapeError, match=f"{argument}: expected a rectangular array"):
        call(name, **{argument: [[1.0, 2.0], [3.0]]})


def test_masked_wrenches_are_refused():
    f_ext = np.ma.array(np.zeros((4, 6)), mask=np.arange(4)[:, None] > 1 * np.ones(6))
    for function in (tw.rnea, tw.fast.rnea, tw.aba, tw.fast.aba):
        with pytest.raises(ValueError, match="f_ext: expected numbers, got a masked array"):
            function(ARM, np.zeros(3), np.zeros(3), np.zeros(3), f_ext)


def test_batch_axes_that_do_not_broadcast_are_listed():
    with pytest.raises(tw.ShapeError, match=r"batch axes do not broadcast: q \(2,\), v \(3,\)$"):
        tw.rnea(ARM, np.zeros((2, 3)), np.zeros((3, 3)), np.zeros(3))
    with pytest.raises(tw.ShapeError, match=r"f_ext \(2,\)"):
        tw.rnea(ARM, np.zeros((3, 3)), np.zeros(3), np.zeros(3), np.zeros((2, 4, 6)))


# ---------------------------------------------------------------- numbers


@every_argument
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_number_that_is_none_is_found_and_placed(name, argument, bad):
    x = good(argument)
    index = (3, 1) if argument == "f_ext" else (8,)
    x[index] = bad
    with pytest.raises(ValueError, match="expected finite numbers") as error:
        call(name, **{argument: x})
    assert str(error.value) == f"{argument}: expected finite numbers, got {bad} at index {index}"


def test_place_in_a_batch_is_named():
    v = np.zeros((2, 5, 3))
    v[1, 4, 2] = np.nan
    with pytest.raises(ValueError, match=r"v: expected finite numbers, got nan at index \(1, 4, 2\)"):
        tw.nonlinear_effects(ARM, np.zeros(3), v)


@every_argument
def test_mpmath_numbers_are_sent_where_they_belong(name, argument):
    x = good(argument).astype(object) + mpmath.mpf(0)
    with pytest.raises(ValueError, match=f"{argument}: .*twistwrench.newton_euler_3d"):
        call(name, **{argument: x})


@pytest.mark.parametrize("bad", ["abc", [None, 0, 0], np.zeros(3, bool), {"a": 1}], ids=repr)
def test_what_is_no_number_is_refused(bad):
    with pytest.raises(ValueError, match="q: expected "):
        tw.crba(ARM, bad)


# ---------------------------------------------------------------- quaternions


UNIT = [item for item in EACH if item[1].startswith("q") and item[0] != "normalize"]


@pytest.mark.parametrize(("name", "argument"), UNIT, ids=[f"{n}-{a}" for n, a in UNIT])
@pytest.mark.parametrize("size", [0.0, 0.999, 1 + 1e-6, 2.0])
def test_quaternion_that_is_off_norm_1_is_refused_with_the_joints_name(name, argument, size):
    q = STAND.copy()
    q[3:7] *= size
    with pytest.raises(
        ValueError, match=rf"{argument}: joint 'root_joint': the quaternion {argument}\[3:7\] has norm {size:.6g}"
    ):
        call(name, **{argument: q})


def test_error_of_rounding_in_a_quaternion_is_let_through_and_changes_nothing():
    q = STAND.copy()
    q[3:7] *= 1 + 1e-9  # a scale that would be seen in the rotation, were it not divided out
    M = tw.crba(GO2, STAND)
    assert np.abs(tw.crba(GO2, q) - M).max() < 1e-14 * np.abs(M).max()
    single = STAND.astype(np.float32)
    single[3:7] *= np.float32(1 + 1e-5)
    assert tw.crba(GO2, single).dtype == np.float32


def test_cosine_and_sine_that_are_none_are_refused_with_the_joints_name():
    builder = tw.Builder("wheel")
    builder.link("wheel", parent="base_link", joint=tw.Continuous("z"), joint_name="axle")
    model = builder.build()
    with pytest.raises(ValueError, match=r"joint 'axle': the \(cos, sin\) q\[0:2\] has norm 1.41421"):
        tw.gravity(model, [1.0, 1.0])
    with pytest.raises(ValueError, match=r"joint 'axle' \(q\[0:2\]\): .* all zero"):
        model.normalize([0.0, 0.0])


def test_zero_quaternion_has_no_direction_to_normalise():
    q = STAND.copy()
    q[3:7] = 0
    with pytest.raises(ValueError, match=r"joint 'root_joint' \(q\[0:7\]\): .* all zero"):
        GO2.normalize(q)


def test_bad_quaternion_in_a_batch_is_found():
    q = np.stack([STAND] * 4)
    q[2, 3:7] *= 3
    with pytest.raises(ValueError, match="norm 3"):
        tw.crba(GO2, q)


# ---------------------------------------------------------------- wrenches, names, options


def test_wrench_on_the_world_is_refused():
    f_ext = good("f_ext")
    f_ext[0, 5] = 1.0
    for name in ("rnea", "aba", "joint_wrenches"):
        for one_or_many in (f_ext, np.stack([0 * f_ext, f_ext])):
            with pytest.raises(ValueError, match=r"^f_ext: row 0 is a wrench on the world"):
                call(name, f_ext=one_or_many)


def test_unknown_frame_lists_the_nearest_names():
    for function in (
        lambda name: tw.frame_placement(GO2, STAND, name),
        lambda name: tw.frame_jacobian(GO2, STAND, name),
        lambda name: tw.frame_bias_acceleration(GO2, STAND, REST, name),
        lambda name: tw.contact_jacobian(GO2, STAND, [name]),
        lambda name: tw.static_equilibrium(GO2, STAND, [name]),
        lambda name: tw.dynamics(GO2, STAND, REST, contacts=[name]),
        GO2.frame,
    ):
        with pytest.raises(tw.NameNotFound, match=r"frame 'FR_fot' of model 'go2'; did you mean 'FR_foot'"):
            function("FR_fot")
    assert issubclass(tw.NameNotFound, KeyError)
    assert issubclass(tw.NameNotFound, ValueError)


def test_unknown_joint_and_posture_are_named():
    with pytest.raises(tw.NameNotFound, match="joint 'FL_calf' of model 'go2'; did you mean 'FL_calf_joint'"):
        GO2.joint_id("FL_calf")
    with pytest.raises(tw.NameNotFound, match="model 'chain of 3' has no standing posture"):
        ARM.standing()


def test_unknown_reference_and_quantity_are_named():
    for function in (
        lambda: tw.frame_jacobian(GO2, STAND, "FR_foot", "wrold"),
        lambda: tw.frame_bias_acceleration(GO2, STAND, REST, "FR_foot", "wrold"),
    ):
        with pytest.raises(tw.NameNotFound, match="reference 'wrold'; did you mean 'world'"):
            function()
    with pytest.raises(tw.NameNotFound, match="quantity 'H'"):
        tw.dynamics(GO2, STAND, REST, want=["H"])

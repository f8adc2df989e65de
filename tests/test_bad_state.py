"""What is wrong with a state is said at the door: which argument, what was expected, what came."""

from __future__ import annotations

from dataclasses import FrozenInstanceError

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench.singular import refuse_lost

GO2 = tw.load("go2")
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


def test_one_frame_where_a_list_is_meant_is_refused():
    for function in (tw.contact_jacobian, tw.static_equilibrium):
        with pytest.raises(ValueError, match="contacts: expected a sequence"):
            function(GO2, STAND, "FR_foot")


def test_acceleration_without_a_velocity_is_refused():
    with pytest.raises(ValueError, match="an acceleration needs the velocity"):
        tw.forward_kinematics(ARM, np.zeros(3), None, np.zeros(3))


# ---------------------------------------------------------------- what does not exist


def massless(*names):
    """Three bars in a row, those named without mass."""
    builder, parent = tw.Builder("bars"), "base_link"
    for name in ("a", "b", "c"):
        inertia = tw.SpatialInertia.zero() if name in names else tw.SpatialInertia(1.0, [0, 0, -0.5], 0.1 * np.eye(3))
        builder.link(name, parent=parent, joint=tw.Revolute("y"), inertia=inertia, joint_name=f"joint_{name}",
                     placement=tw.SE3(np.eye(3), [0, 0, -1.0]))  # fmt: skip
        parent = name
    return builder.build()


def test_joints_that_move_nothing_are_named_and_all_but_aba_still_works():
    rng = np.random.default_rng(0)
    q, v, a = rng.standard_normal((3, 3))
    model = massless("b", "c")
    with pytest.raises(tw.SingularError, match="no inertia behind joint 'joint_b', 'joint_c'"):
        tw.aba(model, q, v, a)
    alone, mounted = massless("c"), massless("b")
    assert not tw.crba(model, q)[1:].any()
    assert not tw.rnea(model, q, v, a)[1:].any()
    assert np.isfinite(tw.centroidal_momentum_rate(model, q, v, a)).all()
    with pytest.raises(tw.SingularError, match="'joint_c': q̈ is not"):
        tw.aba(alone, q, v, a)
    assert np.isfinite(tw.aba(mounted, q, v, a)).all()  # a light link with a heavy one on it is no obstacle


def test_rotor_is_inertia_enough():
    builder = tw.Builder("rotor")
    builder.link("disc", parent="base_link", joint=tw.Revolute("y"), armature=0.5)
    assert tw.aba(builder.build(), [0.0], [1.0], [2.0]) == [4.0]


def gimbal(unit=1.0):
    """Two rings without mass and a rotor, about z, y and z: locked where the middle angle is zero."""
    builder = tw.Builder("gimbal")
    builder.link("outer", parent="base_link", joint=tw.Revolute("z"))
    builder.link("inner", parent="outer", joint=tw.Revolute("y"))
    disc = tw.SpatialInertia(unit, [0, 0, 0], unit * np.diag([0.1, 0.1, 0.2]))
    builder.link("disc", parent="inner", joint=tw.Revolute("z"), inertia=disc)
    return builder.build()


@pytest.mark.parametrize("middle", [0.0, 1e-9, np.pi])
@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_gimbal_lock_of_massless_rings_is_singular(middle, dtype):
    if middle == 1e-9 and np.finfo(dtype).eps < 1e-17:
        middle = 1e-11  # with more digits less is lost
    q = np.array([0.3, middle, -0.2], dtype)
    with pytest.raises(tw.SingularError, match="joint 'outer': with the joints behind it free it feels no inertia"):
        tw.aba(gimbal(), q, np.zeros(3, dtype), np.ones(3, dtype))


@pytest.mark.parametrize("unit", [2.0**-60, 2.0**60])
def test_gimbal_lock_does_not_depend_on_the_unit_of_mass(unit):
    with pytest.raises(tw.SingularError, match="joint 'outer'"):
        tw.aba(gimbal(unit), [0.3, 1e-9, -0.2], np.zeros(3), np.ones(3))


def test_a_joint_that_feels_nothing_at_all_is_refused_before_anything_is_divided_by_it():
    feels = np.array([[[1.0]], [[0.0]]])
    with pytest.raises(tw.SingularError, match=r"joint 'elbow': .* at index \(1,\)"):
        refuse_lost(feels, feels, "elbow")


def test_one_locked_gimbal_in_a_batch_is_enough():
    q = np.zeros((3, 3))
    q[:, 1] = [0.5, 0.0, 1.0]
    with pytest.raises(tw.SingularError, match="outer"):
        tw.aba(gimbal(), q, np.zeros(3), np.ones(3))
    assert np.isfinite(tw.aba(gimbal(), q[[0, 2]], np.zeros(3), np.ones(3))).all()


def test_nothing_has_no_centre_of_mass():
    builder = tw.Builder("ghost")
    builder.link("ghost", parent="base_link", joint=tw.Revolute("z"))
    model = builder.build()
    for function in (tw.center_of_mass, tw.centroidal_map):
        with pytest.raises(tw.SingularError, match="centre of mass of 'ghost': nothing that moves has mass"):
            function(model, [0.0])
    assert tw.crba(model, [0.0]) == [[0.0]]


def test_equilibrium_that_does_not_exist_is_refused():
    with pytest.raises(tw.SingularError, match=r"no forces at .* balance the weight"):
        tw.static_equilibrium(GO2, STAND, ["FR_foot"])
    with pytest.raises(ValueError, match="expected a floating base"):
        tw.static_equilibrium(ARM, np.zeros(3), ["tip"])
    with pytest.raises(ValueError, match="at least one contact"):
        tw.static_equilibrium(GO2, STAND, [])


@pytest.mark.parametrize("q", [np.stack([STAND] * 2), STAND + 0j], ids=["batch", "complex"])
def test_equilibrium_is_asked_of_one_real_configuration(q):
    with pytest.raises(tw.ShapeError, match=rf"^q: expected one real configuration, shape \(19,\), got {q.dtype} of"):
        tw.static_equilibrium(GO2, q)


def test_model_without_joints_has_nothing_to_say():
    model = tw.Builder("rock").build()
    empty = np.zeros(0)
    assert (model.nq, model.nv, model.nbodies) == (0, 0, 1)
    assert tw.rnea(model, empty, empty, empty).shape == (0,)
    assert tw.aba(model, empty, empty, empty).shape == (0,)
    assert tw.crba(model, empty).shape == (0, 0)
    assert tw.kinetic_energy(model, empty, empty) == 0
    for function, arguments in ((tw.center_of_mass, 1), (tw.centroidal_map, 1), (tw.centroidal_momentum_rate, 3)):
        with pytest.raises(tw.SingularError, match="centre of mass of 'rock': nothing that moves has mass"):
            function(model, *[empty] * arguments)
    assert tw.frame_placement(model, empty, "base_link").translation.tolist() == [0, 0, 0]
    assert tw.frame_jacobian(model, empty, "base_link").shape == (6, 0)


# ---------------------------------------------------------------- frozen


def test_model_is_frozen():
    with pytest.raises(FrozenInstanceError):
        GO2.name = "dog"
    for array in (GO2.gravity, GO2.armature, GO2.lower, GO2.upper, GO2.velocity_limit, GO2.effort_limit):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
    for inertia, placement in zip(GO2.inertia, GO2.placement, strict=True):
        with pytest.raises(ValueError, match="read-only"):
            inertia.com[0] = 1.0
        with pytest.raises(ValueError, match="read-only"):
            placement.translation[0] = 1.0


def test_standing_posture_is_a_copy():
    GO2.standing()[:] = 0
    assert (GO2.standing() == STAND).all()
    assert GO2.standing()[2] > 0


@pytest.mark.parametrize("legs", [1, 3])
def test_a_massless_base_is_refused_wherever_its_leg_points(legs):
    # the base can turn and the leg turn back without anything that has inertia moving
    rng = np.random.default_rng(0)
    for _ in range(40):
        P = rng.standard_normal((6, 3))
        rod = tw.SpatialInertia(1.0, P.mean(axis=0), np.trace(np.cov(P.T)) * np.eye(3) - np.cov(P.T))
        builder = tw.Builder("hopper", base="floating")
        for k in range(legs):
            placement = tw.exp6(rng.standard_normal(6) * [1, 1, 1, 3, 3, 3])
            parent, axis = f"leg{k - 1}" if k else "base_link", rng.standard_normal(3)
            builder.link(f"leg{k}", parent=parent, joint=tw.Revolute(axis), placement=placement, inertia=rod)
        model = builder.build()
        v, tau = rng.standard_normal((2, model.nv))
        with pytest.raises(tw.SingularError, match="'root_joint': with the joints behind it free"):
            tw.aba(model, model.random_configuration(rng=rng), v, tau)


def test_a_long_chain_in_float32_is_not_called_singular():
    chain, rest = tw.chain(200), np.zeros(200, np.float32)
    push = np.ones(200, np.float32)
    assert np.isfinite(tw.aba(chain, rest, rest, push)).all()


def test_a_singular_state_of_a_batch_is_located():
    # two hinges with one massless link between them: singular where their axes are in line
    rod = tw.SpatialInertia(1.0, [0.0, 0.1, 0.5], np.diag([0.1, 0.2, 0.25]))
    builder = tw.Builder("gimbal")
    builder.link("outer", parent="base_link", joint=tw.Revolute("z"))
    builder.link("middle", parent="outer", joint=tw.Revolute("x"))
    builder.link("inner", parent="middle", joint=tw.Revolute("z"), inertia=rod)
    q, rest = np.array([[0.3, 1.0, 0.2], [0.3, 0.0, 0.2]]), np.zeros(3)
    with pytest.raises(tw.SingularError, match=r"joint 'outer': .* at index \(1,\)"):
        tw.aba(builder.build(), q, rest, rest)

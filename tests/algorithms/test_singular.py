"""Where there is no q̈: ABA names the joint outboard of which nothing has inertia, and refuses no other state."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.algorithms.singular import refuse_lost

# ---------------------------------------------------------------- links without mass


def massless(*names):
    """Three bars in a row, those named without mass."""
    builder, parent = tw.Builder("bars"), "base_link"
    for name in ("a", "b", "c"):
        inertia = tw.SpatialInertia.zero() if name in names else tw.SpatialInertia(1.0, [0, 0, -0.5], 0.1 * np.eye(3))
        builder.link(name, parent=parent, joint=tw.Revolute("y"), inertia=inertia, joint_name=f"joint_{name}",
                     placement=tw.SE3(np.eye(3), [0, 0, -1.0]))  # fmt: skip
        parent = name
    return builder.build()


def test_aba_names_joints_that_move_nothing_and_all_else_still_works():
    rng = np.random.default_rng(0)
    q, v, a = rng.standard_normal((3, 3))
    model = massless("b", "c")
    with pytest.raises(tw.SingularError, match="no inertia outboard of joint 'joint_b', 'joint_c'"):
        tw.aba(model, q, v, a)
    alone, mounted = massless("c"), massless("b")
    assert not tw.crba(model, q)[1:].any()
    assert not tw.rnea(model, q, v, a)[1:].any()
    assert np.isfinite(tw.centroidal_momentum_rate(model, q, v, a)).all()
    with pytest.raises(tw.SingularError, match="'joint_c': q̈ is not"):
        tw.aba(alone, q, v, a)
    assert np.isfinite(tw.aba(mounted, q, v, a)).all()  # a light link with a heavy one on it is no obstacle


def test_aba_finds_inertia_enough_in_a_rotor():
    builder = tw.Builder("rotor")
    builder.link("disc", parent="base_link", joint=tw.Revolute("y"), armature=0.5)
    assert tw.aba(builder.build(), [0.0], [1.0], [2.0]) == [4.0]


@pytest.mark.one_case
@pytest.mark.parametrize("legs", [1, 3])
def test_aba_refuses_a_massless_base_wherever_its_leg_points(legs):
    # the base can turn and the leg turn back without anything that has inertia moving
    rng = np.random.default_rng(0)
    for trial in range(40):
        P = rng.standard_normal((6, 3))
        rod = tw.SpatialInertia(1.0, P.mean(axis=0), np.trace(np.cov(P.T)) * np.eye(3) - np.cov(P.T))
        builder = tw.Builder("hopper", base="floating")
        for k in range(legs):
            placement = tw.exp6(rng.standard_normal(6) * [1, 1, 1, 3, 3, 3])
            parent, axis = f"leg{k - 1}" if k else "base_link", rng.standard_normal(3)
            builder.link(f"leg{k}", parent=parent, joint=tw.Revolute(axis), placement=placement, inertia=rod)
        model = builder.build()
        v, tau = rng.standard_normal((2, model.nv))
        helpful = r"'root_joint': with its outboard joints free.*the base has no mass of its own.*base='fixed'"
        for aba in (tw.aba, tw.fast.aba)[: 1 + (trial < 3)]:  # a program is made for each
            with pytest.raises(tw.SingularError, match=helpful):
                aba(model, model.random_configuration(rng=rng), v, tau)


def test_a_joint_without_any_inertia_is_refused_before_anything_is_divided_by_it():
    feels = np.array([[[1.0]], [[0.0]]])
    with pytest.raises(tw.SingularError, match=r"joint 'elbow': .* at index \(1,\)"):
        refuse_lost(feels, feels, "elbow")


def test_aba_does_not_call_a_long_chain_in_float32_singular():
    chain, rest = tw.chain(200), np.zeros(200, np.float32)
    push = np.ones(200, np.float32)
    assert np.isfinite(tw.aba(chain, rest, rest, push)).all()


# ---------------------------------------------------------------- gimbal lock


def gimbal(unit=1.0):
    """Two rings without mass and a rotor, about z, y and z: locked where the middle angle is zero."""
    builder = tw.Builder("gimbal")
    builder.link("outer", parent="base_link", joint=tw.Revolute("z"))
    builder.link("inner", parent="outer", joint=tw.Revolute("y"))
    disc = tw.SpatialInertia(unit, [0, 0, 0], unit * np.diag([0.1, 0.1, 0.2]))
    builder.link("disc", parent="inner", joint=tw.Revolute("z"), inertia=disc)
    return builder.build()


@pytest.mark.parametrize("middle", [0.0, "near", np.pi])
@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_aba_refuses_the_gimbal_lock_of_massless_rings(middle, dtype):
    if middle == "near":
        middle = np.sqrt(np.finfo(dtype).eps) / 15  # 1e-9 in double: its square is lost beside 1
    q = np.array([0.3, middle, -0.2], dtype)
    with pytest.raises(tw.SingularError, match="joint 'outer': with its outboard joints free it moves no inertia"):
        tw.aba(gimbal(), q, np.zeros(3, dtype), np.ones(3, dtype))


@pytest.mark.parametrize("unit", [2.0**-60, 2.0**60])
def test_aba_refuses_a_gimbal_lock_in_every_unit_of_mass(unit):
    with pytest.raises(tw.SingularError, match="joint 'outer'"):
        tw.aba(gimbal(unit), [0.3, 1e-9, -0.2], np.zeros(3), np.ones(3))


def test_aba_refuses_a_batch_with_one_locked_gimbal():
    q = np.zeros((3, 3))
    q[:, 1] = [0.5, 0.0, 1.0]
    with pytest.raises(tw.SingularError, match="outer"):
        tw.aba(gimbal(), q, np.zeros(3), np.ones(3))
    assert np.isfinite(tw.aba(gimbal(), q[[0, 2]], np.zeros(3), np.ones(3))).all()


def test_aba_says_which_state_of_a_batch_is_singular():
    # two hinges with one massless link between them: singular where their axes are in line
    rod = tw.SpatialInertia(1.0, [0.0, 0.1, 0.5], np.diag([0.1, 0.2, 0.25]))
    builder = tw.Builder("gimbal")
    builder.link("outer", parent="base_link", joint=tw.Revolute("z"))
    builder.link("middle", parent="outer", joint=tw.Revolute("x"))
    builder.link("inner", parent="middle", joint=tw.Revolute("z"), inertia=rod)
    q, rest = np.array([[0.3, 1.0, 0.2], [0.3, 0.0, 0.2]]), np.zeros(3)
    with pytest.raises(tw.SingularError, match=r"joint 'outer': .* at index \(1,\)"):
        tw.aba(builder.build(), q, rest, rest)


def slide(mass):
    builder = tw.Builder("slide")
    body = tw.SpatialInertia(mass, np.zeros(3), np.zeros((3, 3)))
    builder.link("bead", parent="base_link", joint=tw.Prismatic("z"), inertia=body)
    return builder.build()


@pytest.mark.parametrize("backend", ["llvm", "numpy"])
def test_a_program_says_of_a_link_without_weight_what_the_textbook_says(backend):
    if backend == "llvm":
        pytest.importorskip("llvmlite", reason="llvmlite is not installed: there is no machine code")
    robot = tw.Builder("tiny")
    link = tw.SpatialInertia(1e-320, [0, 0, 1], np.zeros((3, 3)))
    robot.link("link", parent="base_link", joint=tw.Revolute("x"), inertia=link)
    with pytest.raises(tw.SingularError, match=r"'link'.*beyond rounding"):
        tw.compile(robot.build(), "aba", backend=backend)([0.1], [0.2], [0.3])


@pytest.mark.parametrize("mass", [1e-320, 1e-308])
@pytest.mark.parametrize(
    "function",
    [
        lambda model: tw.aba(model, [0.0], [0.0], [1.0]),
        lambda model: tw.aba(model, [[0.0]] * 2, [0.0], [0.0]),
        lambda model: tw.articulated_inertia(model, [0.0], "bead"),
        lambda model: tw.solve_mass_matrix(model, [0.0], [1.0]),
        lambda model: tw.ltdl(model, [0.0]),
    ],
)
def test_an_inertia_whose_reciprocal_overflows_is_singular(mass, function):
    with pytest.raises(tw.SingularError, match="joint 'bead'"):
        function(slide(mass))


def test_a_light_body_that_can_be_accelerated_is_and_one_that_flies_off_is_an_error_by_name():
    model = slide(1e-300)
    assert tw.aba(model, [0.0], [0.0], [1e-300])[0] == pytest.approx(1 - 9.81, rel=1e-14)
    with pytest.raises(ValueError, match=r"tau.*: expected smaller numbers"):
        tw.aba(model, [0.0], [0.0], [1e20])
    with pytest.raises(ValueError, match="tau: expected smaller numbers"):
        tw.solve_mass_matrix(model, [0.0], [1e20])

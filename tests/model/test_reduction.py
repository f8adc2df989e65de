"""Held joints: the smaller model says what the full one says with these joints truly still."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import twistwrench as tw
from twistwrench import newton_euler_3d as slow
from twistwrench.model import idle_joints

from ..robots import shared
from ..strategies import examples, random_state, recipes
from ..truth import ULPS, double, largest, skeel

EPS = float(np.finfo(float).eps)
ARMS = ["arm_*", "gripper_*", "head_*"]


def robot(name: str) -> tw.Model:
    """A robot of the catalogue, which may not be installed."""
    if name not in [r.name for r in tw.robots()]:
        pytest.skip(f"example-robot-data is not installed: {name} is not tried")
    return tw.load(name)


def error(ours, right, scale=None):
    """The largest difference, relative to the largest entry."""
    size = largest(right) if scale is None else scale
    return largest(slow.as_mpmath(ours) - right if np.asarray(right).dtype == object else ours - right) / (size or 1)


def errors(reduction: tw.model.Reduction, q, v, a) -> dict[str, float]:
    """Every quantity of the small model beside that of the full one with the held joints at rest."""
    full, small, kept = reduction.full, reduction.model, reduction.kept_v
    (Q, V), (_, A) = reduction.expand(q, v), reduction.expand(q, a)
    still = not any(f.body > 0 and small.frames[n].body == 0 for n, f in full.frames.items())
    M = tw.crba(full, Q)[kept[:, None], kept]
    tau = tw.rnea(full, Q, V, A)[kept]
    found = {
        "M": error(tw.crba(small, q), M),
        "h": error(tw.nonlinear_effects(small, q, v), tw.nonlinear_effects(full, Q, V)[kept], largest(tau)),
        "rnea": error(tw.rnea(small, q, v, a), tau),
        "T": error(tw.kinetic_energy(small, q, v), tw.kinetic_energy(full, Q, V)),
    }
    if still and full.mass > 0:  # what is locked to the world is no part of a model
        found["A_G"] = error(tw.centroidal_map(small, q), tw.centroidal_map(full, Q)[:, kept])
        found["h_G"] = error(tw.centroidal_momentum(small, q, v), tw.centroidal_momentum(full, Q, V))
        found["com"] = error(tw.center_of_mass(small, q), tw.center_of_mass(full, Q), 1.0)
    for name in list(full.frames)[:: max(1, len(full.frames) // 6)]:
        J = tw.frame_jacobian(full, Q, name)[:, kept]
        found[f"J {name}"] = error(tw.frame_jacobian(small, q, name), J, max(1.0, largest(J)))
        bias = tw.frame_bias_acceleration(full, Q, V, name)
        found[f"dJ v {name}"] = error(tw.frame_bias_acceleration(small, q, v, name), bias, max(1, largest(v) ** 2))
    return found


# ---------------------------------------------------------------- closed forms


def two_link(l1=0.8, c1=0.3, c2=0.45, m1=2.0, m2=1.5, I1=0.12, I2=0.07) -> tw.Model:
    """A planar arm in the x-z plane, hanging along -z at q = 0."""
    builder = tw.Builder("two links", gravity=(0, 0, -9.81))
    link = {"joint": tw.Revolute("y"), "armature": 0.01, "lower": -1.0, "upper": 2.0, "effort_limit": 5.0}
    first = tw.SpatialInertia(m1, [0, 0, -c1], np.diag([I1, I1, 1e-3]))
    second = tw.SpatialInertia(m2, [0, 0, -c2], np.diag([I2, I2, 1e-3]))
    builder.link("upper", parent="base_link", inertia=first, **link)
    builder.link("lower", parent="upper", inertia=second, placement=tw.SE3(np.eye(3), [0, 0, -l1]), **link)
    builder.link("hand", parent="lower", placement=tw.SE3(np.eye(3), [0, 0, -2 * c2]))
    return builder.build()


def test_two_links_with_the_elbow_locked_are_one_pendulum():
    """By the law of cosines: I = I1 + m1 c1² + I2 + m2 (l1² + c2² + 2 l1 c2 cos q2), and the rotor of the shoulder."""
    l1, c1, c2, m1, m2, I1, I2 = 0.8, 0.3, 0.45, 2.0, 1.5, 0.12, 0.07
    q1, q2, v1 = 0.4, 1.1, 3.0
    small = tw.lock_joints(two_link(), ["lower"], [9.9, q2]).model
    I = I1 + m1 * c1**2 + I2 + m2 * (l1**2 + c2**2 + 2 * l1 * c2 * np.cos(q2)) + 0.01
    moment = 9.81 * ((m1 * c1 + m2 * l1) * np.sin(q1) + m2 * c2 * np.sin(q1 + q2))
    assert tw.crba(small, [q1])[0, 0] == pytest.approx(I, rel=1e-14)
    assert tw.nonlinear_effects(small, [q1], [v1])[0] == pytest.approx(moment, rel=1e-14)
    hand = tw.frame_placement(small, [q1], "hand").translation
    reach = -l1 * np.array([np.sin(q1), 0, np.cos(q1)]) - 2 * c2 * np.array([np.sin(q1 + q2), 0, np.cos(q1 + q2)])
    np.testing.assert_allclose(hand, reach, rtol=0, atol=1e-15)


def test_limits_and_armature_of_the_joints_that_are_left_are_kept():
    full = robot("talos_reduced")
    reduction = tw.lock_joints(full, ARMS, full.standing())
    small, q, v = reduction.model, reduction.kept_q, reduction.kept_v
    assert small.joint_names == tuple(n for n in full.joint_names if not n.startswith(("arm_", "gripper_", "head_")))
    for name, entries in (("lower", q), ("upper", q), ("velocity_limit", v), ("effort_limit", v), ("armature", v)):
        np.testing.assert_array_equal(getattr(small, name), getattr(full, name)[entries])
    assert np.isfinite(small.effort_limit[6:]).all()
    assert small.frame_names == full.frame_names
    assert (small.feet, small.base) == (full.feet, "floating")
    np.testing.assert_array_equal(small.standing(), full.standing()[q])
    assert two_link().armature.tolist() == [0.01, 0.01]
    assert repr(reduction) == f"<Reduction of {full.name!r}: {full.nv - small.nv} joints held, nv = {small.nv}>"
    reduction = tw.lock_joints(two_link(), ["upper"], [0.3, 0])
    assert reduction.model.armature.tolist() == [0.01]
    assert "1 joint held" in repr(reduction)


# ---------------------------------------------------------------- invariants


def test_each_state_of_a_batch_is_in_one_piece_for_the_programs_take_no_other_at_full_speed():
    model = shared("go2")
    q = np.tile(model.standing(), (7, 1))
    for x in tw.lock_joints(model, ["FL_*"], q[0]).reduce(q, q[:, :18]):
        assert x.flags.c_contiguous


def test_all_joints_locked_leave_one_rigid_body_of_the_composite_inertia():
    full = robot("talos_reduced")
    q = full.random_configuration(rng=3)
    small = tw.lock_joints(full, [n for n in full.joint_names if n not in ("universe", "root_joint")], q).model
    assert (small.nbodies, small.nv) == (2, 6)
    np.testing.assert_allclose(small.inertia[1].matrix(), tw.crba(full, q)[:6, :6], rtol=0, atol=1e-13 * full.mass)
    np.testing.assert_allclose(small.inertia[1].mass, full.mass, rtol=1e-15)


@examples(25)
@given(recipes(20), st.integers(0, 2**20), st.integers(0, 2**20))
def test_in_two_steps_as_in_one(recipe, first, second):
    full, (q, v, *_) = recipe.model, recipe.state()
    names = full.joint_names[1:]
    a, b = ({n for k, n in enumerate(names) if chosen >> k & 1} for chosen in (first, second))
    once = tw.lock_joints(full, a | b, q)
    half = tw.lock_joints(full, a, q)
    twice = tw.lock_joints(half.model, b - a, half.reduce(q, v)[0])
    assert (once.model.joint_names, once.model.parent) == (twice.model.joint_names, twice.model.parent)
    np.testing.assert_array_equal(half.kept_q[twice.kept_q], once.kept_q)
    for one, other in zip(once.model.inertia, twice.model.inertia, strict=True):
        assert largest(one.matrix() - other.matrix()) <= 50 * EPS * max(largest(one.matrix()), largest(other.matrix()))
    for name, frame in once.model.frames.items():
        other = twice.model.frames[name]
        assert frame.body == other.body
        np.testing.assert_allclose(frame.placement.matrix(), other.placement.matrix(), rtol=0, atol=1e-13)


@examples(12)
@given(recipes(20), st.integers(0, 2**20))
def test_the_small_model_of_any_tree_is_the_full_one_with_still_joints(recipe, chosen):
    full, (q, v, a, *_) = recipe.model, recipe.state()
    reduction = tw.lock_joints(full, [n for k, n in enumerate(full.joint_names[1:]) if chosen >> k & 1], q)
    (small_q, small_v), (_, small_a) = reduction.reduce(q, v), reduction.reduce(q, a)
    np.testing.assert_array_equal(reduction.expand(small_q, small_v)[0], q)
    if reduction.model.nv:
        found = errors(reduction, small_q, small_v, small_a)
        assert max(found.values()) < 2 * ULPS * EPS, found


@pytest.mark.parametrize("batch", [(1,), (3, 1, 2), (0,)])
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, complex])
def test_states_of_any_batch_and_number_type_go_both_ways(batch, dtype):
    full = shared("humanoid")
    reduction = tw.lock_joints(full, ["*shoulder*", "*elbow"], full.standing())
    q, v, *_ = random_state(reduction.model, rng=1, batch=batch, dtype=dtype)
    Q, V = reduction.expand(q, v)
    assert (Q.shape, V.shape, Q.dtype) == ((*batch, full.nq), (*batch, full.nv), np.dtype(dtype))
    assert not V[..., 19:].any()
    back = reduction.reduce(Q, V)
    np.testing.assert_array_equal(back[0], q)
    np.testing.assert_array_equal(back[1], v)


def test_a_joint_locked_to_the_world_takes_its_body_out_of_the_model():
    full = shared("go2")
    small = tw.lock_joints(full, ["root_joint"], full.standing()).model
    assert (small.base, small.nv, small.frames["base"].body) == ("fixed", 12, 0)
    assert small.mass == pytest.approx(full.mass - full.inertia[1].mass)
    np.testing.assert_allclose(small.frames["base"].placement.translation[2], full.standing()[2])


# ---------------------------------------------------------------- oracles


def test_talos_with_held_arms_is_talos_with_still_arms():
    """M, h, rnea, A_G and J: the bound is 1e-13; the worst of twenty states is 5e-16."""
    full = robot("talos_reduced")
    for seed in range(3):
        state = random_state(full, rng=seed)
        reduction = tw.lock_joints(full, ARMS, state.q)
        (q, v), (_, a) = reduction.reduce(state.q, state.v), reduction.reduce(state.q, state.a)
        found = errors(reduction, q, v, a)
        assert max(found.values()) < 1e-13, found


@pytest.mark.slow
def test_talos_with_held_arms_against_fifty_digits():
    """The small model in double precision beside the full one in 50 digits; aba to its conditioning."""
    full = robot("talos_reduced")
    state = random_state(full, rng=7)
    reduction = tw.lock_joints(full, ARMS, state.q)
    small, kept = reduction.model, reduction.kept_v
    (q, v), (_, a) = reduction.reduce(state.q, state.v), reduction.reduce(state.q, state.a)
    (Q, V), (_, A) = ((slow.as_mpmath(x) for x in reduction.expand(q, x)) for x in (v, a))
    tau = slow.inverse_dynamics(full, Q, V, A)[kept]
    right = {
        "M": (tw.crba(small, q), slow.mass_matrix(full, Q)[kept[:, None], kept]),
        "rnea": (tw.rnea(small, q, v, a), tau),
        "h": (tw.nonlinear_effects(small, q, v), slow.nonlinear_effects(full, Q, V)[kept]),
        "A_G": (tw.centroidal_map(small, q), slow.centroidal_map(full, Q)[:, kept]),
    }
    found = {name: error(ours, true) for name, (ours, true) in right.items()}
    assert max(found.values()) < 1e-13, found
    lost = skeel(right["M"][1], a, tau, double(right["h"][1]))
    assert error(tw.aba(small, q, v, double(tau)), a) < 20 * EPS * lost


@pytest.mark.parametrize("name", ["talos_reduced", "humanoid", "romeo", "planar_arm"])
def test_as_pinocchios_reduced_model(name):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its reduced models are not compared")
    full = robot(name)
    state = random_state(full, rng=5)
    patterns = {"humanoid": ["*shoulder*", "waist*"], "romeo": ["*Finger*", "*Elbow*"], "planar_arm": ["elbow"]}
    reduction = tw.lock_joints(full, patterns.get(name, ARMS), state.q)
    there = tw.bridge.to_pinocchio_model(full)
    there = pin.buildReducedModel(there, [there.getJointId(joint) for joint in reduction.held], state.q)
    data, small = there.createData(), reduction.model
    (q, v), (_, a) = reduction.reduce(state.q, state.v), reduction.reduce(state.q, state.a)
    V, A = (tw.bridge.to_pinocchio_tangent(small, x) for x in (v, a))
    assert tuple(there.names) == small.joint_names
    M = tw.bridge.from_pinocchio_matrix(small, pin.crba(there, data, q))
    assert error(tw.crba(small, q), M) < 1e-13
    assert (
        error(tw.rnea(small, q, v, a), tw.bridge.from_pinocchio_tangent(small, pin.rnea(there, data, q, V, A))) < 1e-13
    )
    A_G = tw.bridge.from_pinocchio_jacobian(small, pin.computeCentroidalMap(there, data, q))
    assert error(tw.centroidal_map(small, q), A_G) < 1e-13
    np.testing.assert_array_equal(there.effortLimit[6:], small.effort_limit[6:])  # beyond a base, one order for both


def test_it_is_the_same_robot_to_the_fast_functions():
    full = robot("talos_reduced")
    reduction = tw.lock_joints(full, ARMS, full.standing())
    q, v, a, *_ = random_state(reduction.model, rng=2)
    d = tw.fast.dynamics(reduction.model, q, v)
    assert error(d.M, tw.crba(reduction.model, q)) < 1e-13
    assert error(tw.fast.rnea(reduction.model, q, v, a), tw.rnea(reduction.model, q, v, a)) < 1e-13


# ---------------------------------------------------------------- what carries nothing


def test_romeos_fingers_carry_nothing():
    """24 massless joints make Pinocchio's forward dynamics NaN and ours a SingularError; without them both work."""
    full = robot("romeo")
    idle = idle_joints(full)
    assert len(idle) == 24
    assert all("Finger" in name or "Thumb" in name or "Hand" in name for name in idle)
    zero = np.zeros(full.nv)
    with pytest.raises(tw.SingularError):
        tw.aba(full, full.standing(), zero, zero)
    reduction = tw.lock_joints(full, idle, full.standing())
    small, rest = reduction.model, np.zeros(reduction.model.nv)
    fall = tw.aba(small, small.standing(), rest, rest)
    np.testing.assert_allclose(tw.rnea(small, small.standing(), rest, fall), 0, rtol=0, atol=1e-10)
    assert errors(reduction, small.standing(), rest, fall)["M"] == 0


def test_a_rotor_or_a_needed_frame_keeps_a_joint():
    builder = tw.Builder("mast")
    builder.link("mast", parent="base_link", joint=tw.Revolute("z"), inertia=tw.SpatialInertia(1, [0, 0, 1], np.eye(3)))
    builder.link("camera", parent="mast", joint=tw.Revolute("y"))
    builder.link("lens", parent="camera", joint=tw.Prismatic("x"))
    builder.link("motor", parent="mast", joint=tw.Revolute("x"), armature=0.1)
    model = builder.build()
    assert idle_joints(model) == ("camera", "lens")
    assert idle_joints(model, ["lens"]) == ()
    assert idle_joints(model, ["camera"]) == ("lens",)


def test_the_name_of_a_joint_is_no_pattern():
    rod = tw.SpatialInertia(1, [0, 0, -0.5], np.diag([0.1, 0.1, 0.01]))
    builder = tw.Builder("names that look like patterns")
    for name, parent, inertia in (("a", "base_link", rod), ("b[1]", "a", rod), ("a*", "b[1]", None), ("ab", "a*", rod)):
        builder.link(name, parent=parent, joint=tw.Revolute("y"), inertia=inertia)
    builder.link("c*", parent="a", joint=tw.Revolute("y"))
    builder.link("cc", parent="a", joint=tw.Revolute("y"), inertia=rod)
    model = builder.build()
    assert tw.lock_joints(model, ["b[1]"], model.neutral()).held == ("b[1]",)
    assert tw.lock_joints(model, ["a*"], model.neutral()).held == ("a*",)
    assert tw.lock_joints(model, ["a?", "b*"], model.neutral()).held == ("b[1]", "a*", "ab")
    scene = tw.Scene(model)  # what carries nothing is dropped by its name
    assert scene.idle == ("c*",)
    assert set(scene.model.joint_names) == {"universe", "a", "b[1]", "a*", "ab", "cc"}


# ---------------------------------------------------------------- what is wrong is said


@pytest.mark.parametrize(
    ("joints", "said"),
    [
        (["arm_9_*"], "'arm_9_.' fits no joint of 'planar_arm'; its joints are shoulder, elbow, wrist"),
        (["wrist", "tool"], "'tool' fits no joint"),
        ([3], "expected names or patterns, got int 3"),
        ("wrist", "got the string 'wrist'"),
        (["universe"], "'universe' fits no joint"),
    ],
)
def test_joints_that_are_none_are_refused(joints, said):
    arm = shared("planar_arm")
    with pytest.raises(ValueError, match=said):
        tw.lock_joints(arm, joints, arm.neutral())


def test_a_configuration_that_is_none_is_refused():
    arm = shared("planar_arm")
    with pytest.raises(tw.ShapeError, match="q: expected one real configuration"):
        tw.lock_joints(arm, ["wrist"], np.zeros((2, 3)))
    with pytest.raises(tw.ShapeError, match="q: expected one real configuration"):
        tw.lock_joints(arm, ["wrist"], np.zeros(3, complex))
    with pytest.raises(ValueError, match="finite"):
        tw.lock_joints(arm, ["wrist"], [0, np.nan, 0])
    with pytest.raises(tw.ShapeError, match="expected shape"):
        tw.lock_joints(arm, ["wrist"], arm.neutral()).expand([0.0], [0.0])
    with pytest.raises(tw.NameNotFound):
        idle_joints(arm, ["gripper"])

"""The model: its sizes and names, its manifold, its constants in every number type."""

from __future__ import annotations

import copy
import pickle
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest
from hypothesis import given

import twistwrench as tw
from twistwrench import bridge
from twistwrench.model import Frame

from ..robots import shared
from ..strategies import Recipe, examples, random_state, recipes

trees = given(recipes(12))
GO2 = shared("go2")
MIXED = Recipe(9, seed=5, base="floating").model


def close(x, y, tolerance=1e-12):
    return np.abs(np.asarray(x) - np.asarray(y)).max(initial=0) <= tolerance


# ---------------------------------------------------------------- sizes and names


@trees
@examples(15)
def test_slices_cut_q_and_v_into_joints_without_gap_or_overlap(recipe):
    model = recipe.model
    assert len(model.joints) == len(model.joint_names) == len(model.parent) == model.nbodies
    assert len(model.placement) == len(model.inertia) == model.nbodies
    for slices, total, of in ((model.q_slice, model.nq, "nq"), (model.v_slice, model.nv, "nv")):
        covered = [k for s in slices for k in range(s.start, s.stop)]
        assert covered == list(range(total))
        assert [s.stop - s.start for s in slices[1:]] == [getattr(joint, of) for joint in model.joints[1:]]
    assert (model.joints[0], model.joint_names[0], model.parent[0]) == (None, "universe", -1)
    assert model.q_slice[0] == model.v_slice[0] == slice(0, 0)
    assert model.lower.shape == model.upper.shape == (model.nq,)
    assert model.armature.shape == model.velocity_limit.shape == model.effort_limit.shape == (model.nv,)


@trees
@examples(15)
def test_support_leads_from_a_body_to_the_root(recipe):
    model = recipe.model
    for i in range(model.nbodies):
        path = model.support(i)
        assert path[:1] == ([i] if i else [])
        assert [model.parent[a] for a in path] == [*path[1:], 0][: len(path)]


def test_every_joint_and_link_is_a_frame_and_is_found_by_its_name():
    for i, name in enumerate(MIXED.joint_names[1:], start=1):
        assert MIXED.joint_id(name) == i
        assert MIXED.frame(name).body == i
        assert (MIXED.frame(name).placement.matrix() == np.eye(4)).all()
    assert MIXED.frame_names == tuple(MIXED.frames)
    assert MIXED.joint_id("universe") == 0
    assert np.isclose(MIXED.mass, sum(float(inertia.mass) for inertia in MIXED.inertia))


def test_model_says_what_it_is():
    assert (
        repr(tw.chain(2, base="floating")) == "Model 'chain of 2': floating base, 2 moving bodies, nq = 8, nv = 7, 2 kg"
    )


# ---------------------------------------------------------------- the configuration manifold


@trees
@examples(20)
def test_integrate_and_difference_undo_each_other(recipe):
    model, rng = recipe.model, np.random.default_rng(recipe.seed)
    q0, q1 = (model.random_configuration(rng=rng) for _ in range(2))
    step = rng.uniform(-1, 1, model.nv)  # turns below √3 < π
    assert close(model.difference(q0, model.integrate(q0, step)), step)
    there = model.integrate(q0, model.difference(q0, q1))
    assert close(tw.crba(model, there), tw.crba(model, q1), 1e-11 * np.abs(tw.crba(model, q1)).max())
    assert close(model.integrate(q0, 0 * step), q0)
    assert close(model.difference(q0, q0), 0)


@trees
@examples(20)
def test_long_walk_stays_on_the_manifold(recipe):
    model, rng = recipe.model, np.random.default_rng(recipe.seed)
    q = model.random_configuration(rng=rng)
    for _ in range(50):
        q = model.integrate(q, rng.standard_normal(model.nv))
    assert close(model.normalize(q), q, 1e-14 * max(1.0, np.abs(q).max()))


@trees
@examples(30)
def test_manifold_is_pinocchios(recipe):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model, rng = recipe.model, np.random.default_rng(recipe.seed)
    there = bridge.to_pinocchio_model(model)
    assert (pin.neutral(there) == model.neutral()).all()
    q, step = model.random_configuration(rng=rng), rng.uniform(-1, 1, model.nv)
    moved = model.integrate(q, step)
    assert close(moved, pin.integrate(there, q, bridge.to_pinocchio_tangent(model, step)))
    back = bridge.from_pinocchio_tangent(model, pin.difference(there, q, moved))
    assert close(back, step, 1e-6)  # Pinocchio's planar difference loses ε/ω²: 1.5e-9 was seen at one small turn
    assert close(model.difference(q, moved), step)
    assert close(model.normalize(2 * q), pin.normalize(there, 2 * q), 1e-14)


def test_neutral_places_every_body_at_its_placement():
    placement = tw.forward_kinematics(MIXED, MIXED.neutral()).placement
    for i in range(1, MIXED.nbodies):
        assert close(placement[i].matrix(), (placement[MIXED.parent[i]] @ MIXED.placement[i]).matrix(), 1e-14)


def test_normalize_repairs_what_state_refuses():
    q = MIXED.random_configuration(rng=0)
    with pytest.raises(ValueError, match="repairs it"):
        tw.crba(MIXED, 3 * q)
    assert close(MIXED.normalize(MIXED.normalize(3 * q)), MIXED.normalize(3 * q), 1e-15)
    tw.crba(MIXED, MIXED.normalize(3 * q))


# ---------------------------------------------------------------- random configurations


def test_random_configurations_repeat_with_their_seed():
    once, again, other = (MIXED.random_configuration(rng=seed) for seed in (1, 1, 2))
    assert (once == again).all()
    assert (once != other).any()
    generator = np.random.default_rng(1)
    assert (MIXED.random_configuration(rng=generator) == once).all()
    assert (MIXED.random_configuration(rng=generator) != once).any()
    assert (MIXED.random_configuration() != MIXED.random_configuration()).any()


def test_random_configurations_of_go2_lie_within_its_limits_and_are_finite():
    model = shared("go2")
    q = np.array([model.random_configuration(rng=seed) for seed in range(100)])
    joints = q[:, 7:]
    assert (joints >= model.lower[7:]).all()
    assert (joints <= model.upper[7:]).all()
    assert (np.ptp(joints, axis=0) > 0.9 * (model.upper - model.lower)[7:]).all()
    assert np.isfinite(tw.crba(model, q)).all()  # Pinocchio's randomConfiguration returns infinities here


# ---------------------------------------------------------------- constants, copies


def test_constants_are_made_once_per_number_type():
    model = Recipe(4, seed=2).model
    assert model.constants(np.float64) is model.constants("f8")
    for dtype in (np.float32, np.longdouble, np.complex128):
        constants = model.constants(dtype)
        assert {x.dtype for x in (*constants.S, *constants.I, constants.gravity, constants.armature)} == {
            np.dtype(dtype)
        }
        eps = np.finfo(dtype).eps
        for T in constants.placement:
            assert T.rotation.dtype == dtype
            assert close(T.rotation.mT @ T.rotation, np.eye(3), 8 * eps)
        for S in constants.S[1:]:
            turn = S[:3].any(axis=0)  # of norm 1 is the turn, or the slide of what only slides
            assert close((np.where(turn, S[:3], S[3:]) ** 2).sum(axis=0), np.ones(S.shape[1]), 4 * eps)


def test_copy_with_another_gravity_has_constants_of_its_own():
    model = tw.chain(2)
    q = np.array([0.5, 0.2])
    weight = tw.gravity(model, q)
    moon = replace(model, gravity=np.array([0, 0, -1.62]))
    assert close(tw.gravity(moon, q), weight * 1.62 / 9.81, 1e-14)
    assert close(tw.gravity(model, q), weight, 0)
    with pytest.raises(ValueError, match="read-only"):
        moon.gravity[2] = -3.7


def test_nothing_that_later_results_depend_on_can_be_changed():
    model = Recipe(4, seed=2).model
    constants = model.constants(np.float64)
    for array in (*constants.S[1:], *constants.I, constants.gravity, constants.armature):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 1.0
    go2 = shared("go2")
    for held in (go2, tw.lock_joints(go2, ["FL_*"], go2.standing()).model, tw.Scene(go2, base="planar").model):
        with pytest.raises(ValueError, match="read-only"):
            held.postures["standing"][0] = 1.0
        held.standing()[0] = 1.0  # a copy
    with pytest.raises(ValueError, match="posture 'up': q: expected real numbers"):
        replace(model, postures={"up": model.neutral() + 1j})
    for mapping in (model.frames, model.postures):
        with pytest.raises(TypeError, match="does not support item assignment"):
            mapping["new"] = mapping
    names = {"tip": model.frame(model.frame_names[-1])}
    other = replace(model, frames=names)
    names.clear()
    assert other.frame_names == ("tip",)


def test_arrays_that_a_model_is_made_of_stay_the_callers():
    gravity = np.array([0, 0, -1.62])
    moon = replace(tw.chain(2), gravity=gravity)
    gravity[2] = 0  # still writeable, and of no effect
    assert moon.gravity[2] == -1.62


@pytest.mark.parametrize(
    ("change", "error", "said"),
    [
        ({"lower": -np.ones(18)}, tw.ShapeError, r"lower: expected shape \(\) or \(19,\), or \(12,\) .*, got \(18,\)"),
        ({"armature": np.zeros((2, 18))}, tw.ShapeError, r"armature: .* \(18,\), or \(12,\) .*, got \(2, 18\)"),
        ({"effort_limit": np.ones(13)}, tw.ShapeError, r"effort_limit: expected .*, got \(13,\)"),
        ({"armature": np.nan}, tw.ModelError, "joint 'FL_hip_joint': armature: is not a number"),
        ({"armature": np.r_[np.zeros(17), -1]}, tw.ModelError, "joint 'RR_calf_joint': armature -1 is below zero"),
        ({"damping": [0, -1, *np.zeros(10)]}, tw.ModelError, "joint 'FL_thigh_joint': damping -1 is below zero"),
        ({"friction": np.inf}, tw.ModelError, "joint 'FL_hip_joint': friction inf is not finite"),
        ({"upper": -10.0}, tw.ModelError, "joint 'FL_hip_joint': lower limit -1.* is above upper limit -10"),
        ({"velocity_limit": 1j}, ValueError, "velocity_limit: expected real numbers"),
        ({"gravity": [0, 0, np.nan]}, ValueError, "gravity: expected finite numbers, got nan"),
        ({"gravity": [0, -9.81]}, tw.ShapeError, r"gravity: expected shape \(..., 3\), got \(2,\)"),
        ({"feet": ("nope",)}, KeyError, "unknown frame 'nope'"),
        ({"feet": "FR_foot"}, ValueError, "feet: expected a sequence of frame names"),
        ({"postures": {"standing": np.zeros(3)}}, tw.ShapeError, r"posture 'standing': q: expected .*, got \(3,\)"),
        ({"postures": {"up": np.zeros(19)}}, ValueError, "posture 'up': q: joint 'root_joint': the quaternion"),
        ({"postures": {"up": [GO2.standing()] * 2}}, tw.ShapeError, r"posture 'up': .* got \(2, 19\)"),
        ({"postures": [GO2.standing()]}, TypeError, "postures: expected configurations by name"),
        ({"name": 3}, TypeError, "name: expected a name, got int 3"),
        ({"base": "flying"}, tw.ModelError, "base: expected 'fixed' or 'floating', got 'flying'"),
        ({"joint_names": GO2.joint_names[:-1]}, tw.ShapeError, "joints: expected 13 entries, .*, got 14"),
        ({"joint_names": (*GO2.joint_names[:-1], "FL_hip_joint")}, tw.ModelError, "'FL_hip_joint': the name is taken"),
        ({"joint_names": ("world", *GO2.joint_names[1:])}, tw.ModelError, "expected 'universe'"),
        ({"joints": (*GO2.joints[:-1], None)}, tw.ModelError, "'RR_calf_joint': expected a joint"),
        ({"joints": (*GO2.joints[:-1], "z")}, TypeError, "'RR_calf_joint': joint: expected a joint"),
        ({"joints": (None, tw.Planar(), *GO2.joints[2:])}, tw.ModelError, "base: .* joint 1 is not a FreeFlyer"),
        ({"parent": (*GO2.parent[:-1], 13)}, tw.ModelError, "'RR_calf_joint': expected a parent from 0 to 12, got 13"),
        ({"placement": GO2.placement[0]}, TypeError, "placement: expected a sequence"),
        ({"placement": (*GO2.placement[:-1], np.eye(4))}, TypeError, "'RR_calf_joint': placement: expected an SE3"),
        ({"inertia": (*GO2.inertia[:-1], tw.SpatialInertia([1, 2], np.zeros(3), np.eye(3)))}, tw.ShapeError, r"\(2,\)"),
        ({"frames": {"tip": Frame(14, tw.SE3.identity())}}, tw.ModelError, "'tip': .* from 0 to 13, got 14"),
        ({"frames": {"tip": tw.SE3.identity()}}, TypeError, "frame 'tip': expected a Frame"),
        ({"frames": {"tip": Frame(1.0, tw.SE3.identity())}}, tw.ModelError, "'tip': .* from 0 to 13, got 1.0"),
        ({"frames": {3: Frame(1, tw.SE3.identity())}}, TypeError, "frames: expected a name, got int 3"),
        ({"postures": {3: GO2.standing()}}, TypeError, "postures: expected a name, got int 3"),
        ({"parent": (*GO2.parent[:-1], 12.0)}, tw.ModelError, "'RR_calf_joint': expected a parent .*, got 12.0"),
        ({"parent": (*GO2.parent[:-1], True)}, tw.ModelError, "'RR_calf_joint': expected a parent .*, got True"),
        ({"placement": (tw.SE3(np.eye(3), [1, 0, 0]), *GO2.placement[1:])}, tw.ModelError, "identity for 'universe'"),
        ({"inertia": (GO2.inertia[1], *GO2.inertia[1:])}, tw.ModelError, "inertia: expected zero for 'universe'"),
        ({"report": "nothing"}, TypeError, "report: expected a LoadReport"),
    ],
    ids=lambda x: str(x)[:30] if isinstance(x, dict) else "",
)  # fmt: skip
def test_a_copy_is_checked_as_a_model_from_the_builder_is(change, error, said):
    with pytest.raises(error, match=said):
        replace(GO2, **change)


@pytest.mark.parametrize("key", ["armature", "damping", "friction", "velocity_limit", "effort_limit"])
def test_twelve_numbers_for_twelve_motors_leave_out_the_floating_base(key):
    nothing = np.inf if "limit" in key else 0.0
    twelve = getattr(replace(GO2, **{key: np.arange(12.0)}), key)
    assert twelve.tolist() == [nothing] * 6 + list(range(12))
    assert getattr(replace(GO2, **{key: np.arange(18.0)}), key).tolist() == list(range(18))
    assert getattr(replace(GO2, **{key: 0.5}), key).tolist() == [nothing] * 6 + [0.5] * 12
    arm = tw.chain(3)
    assert getattr(replace(arm, **{key: 0.5}), key).tolist() == [0.5] * 3


def test_limits_of_q_may_leave_out_the_floating_base_too():
    model = replace(GO2, lower=-np.ones(12), upper=1.0)
    assert model.lower.tolist() == [-np.inf] * 7 + [-1.0] * 12
    assert model.upper.tolist() == [np.inf] * 7 + [1.0] * 12
    q = model.random_configuration(rng=0)
    assert q.shape == (19,)
    assert (abs(q[7:]) <= 1).all()


def test_rotors_given_as_twelve_numbers_are_those_of_the_joints():
    geared = replace(GO2, armature=np.full(12, 0.01))
    q = GO2.standing()
    added = tw.crba(geared, q) - tw.crba(GO2, q)
    assert close(added, np.diag([0.0] * 6 + [0.01] * 12), 1e-15)


def test_parents_may_be_numbers_of_numpy():
    copied = replace(GO2, parent=np.array(GO2.parent))
    assert copied.parent == GO2.parent
    assert {type(p) for p in copied.parent} == {int}


def test_model_survives_pickling_and_copying():
    s = random_state(MIXED, rng=0)
    tau = tw.rnea(MIXED, s.q, s.v, s.a, s.f_ext)
    for twin in (pickle.loads(pickle.dumps(MIXED)), copy.deepcopy(MIXED), copy.copy(MIXED)):
        assert (tw.rnea(twin, s.q, s.v, s.a, s.f_ext) == tau).all()
        assert twin.frame_names == MIXED.frame_names


# ---------------------------------------------------------------- the door


def test_state_brings_all_to_one_type_and_one_batch_shape_and_copies_nothing():
    q, v = np.zeros((2, 1, 3)), np.ones((4, 3), np.float32)
    model = tw.chain(3)
    checked_q, checked_v = model.state(q, v=v)
    assert checked_q.shape == checked_v.shape == (2, 4, 3)
    assert checked_q.dtype == checked_v.dtype == np.float64
    assert np.shares_memory(checked_q, q)
    assert not checked_q.flags.writeable
    (alone,) = model.state([0, 1, 2])
    assert alone.dtype == np.float64


# ---------------------------------------------------------------- frozen


def test_model_is_frozen():
    go2 = shared("go2")
    with pytest.raises(FrozenInstanceError):
        go2.name = "dog"
    for array in (go2.gravity, go2.armature, go2.lower, go2.upper, go2.velocity_limit, go2.effort_limit):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
    for inertia, placement in zip(go2.inertia, go2.placement, strict=True):
        with pytest.raises(ValueError, match="read-only"):
            inertia.com[0] = 1.0
        with pytest.raises(ValueError, match="read-only"):
            placement.translation[0] = 1.0


def test_standing_posture_is_a_copy():
    go2 = shared("go2")
    stand = go2.standing()
    go2.standing()[:] = 0
    assert (go2.standing() == stand).all()
    assert go2.standing()[2] > 0

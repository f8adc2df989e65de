"""The validator: right robots pass, every wrong number fails, and what is missing is said."""

import importlib.util
import json
import re
import sys
from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.loading.catalogue import find
from twistwrench.model import random_tree
from twistwrench.validate import Judge, quantities, sweep, validate
from twistwrench.validate.conditioning import forward_dynamics_bound
from twistwrench.validate.oracle import Oracle
from twistwrench.validate.quantity import DEFAULT_RTOL
from twistwrench.validate.run import _context
from twistwrench.validate.states import random_states, sample_frames

from ..sampling import sampled

PINOCCHIO = importlib.util.find_spec("pinocchio") is not None
needs_pinocchio = pytest.mark.skipif(not PINOCCHIO, reason="Pinocchio is not installed: the comparison is skipped")
pytest.importorskip("mpmath", reason="mpmath is not installed: the comparison with the truth is skipped")

QUICK = {"states": 2, "truths": 1}


def judge(model, *, states=3, truths=1):
    return Judge(
        model,
        random_states(model, states, rng=0, frames=1),
        Oracle(model, None) if PINOCCHIO else None,
        _context(),
        truths,
    )


def quantity(name):
    return next(q for q in quantities.QUANTITIES if q.name == name)


def go2_judge():
    return judge(tw.load("go2"))


# ---------------------------------------------------------------- what is right passes


@pytest.mark.one_case
@pytest.mark.parametrize(
    "robot",
    ["pendulum", "double_pendulum", "cart_pole", "planar_arm", "go2", pytest.param("humanoid", marks=pytest.mark.slow)],
)
def test_our_own_robots_pass(robot):
    report = validate(robot, **QUICK)
    assert report.passed, report
    compared = [row for row in report.rows if not row.singular]
    assert all(row.ours_vs_truth < 1e-13 for row in compared)
    if PINOCCHIO:
        assert report.loader
        assert all(row.ours_vs_pinocchio < 1e-13 for row in compared)


def test_mimic_joints_of_a_file_are_named(tmp_path):
    text = find("double_pendulum").path.read_text(encoding="utf-8")
    path = tmp_path / "coupled.urdf"
    head, joint, tail = text.partition("</joint>")
    path.write_text(f'{head}<mimic joint="elbow"/>{joint}{tail}', encoding="utf-8")
    report = validate(path, **QUICK)
    assert report.passed
    assert "\nmimic joints, moved on their own: 'shoulder'\n" in str(report)
    assert report.as_dict()["mimics"] == ("shoulder",)
    assert "mimic" not in str(validate("double_pendulum", **QUICK))


def test_go2_has_a_row_for_every_quantity_of_the_chapter():
    rows = {row.quantity: row for row in validate("go2", states=1, truths=1).rows}
    assert len(rows) == len(quantities.QUANTITIES) == 31
    assert rows["mass matrix M"].shape == (18, 18)
    assert rows["J, local"].shape == (4, 6, 18)
    assert rows["static equilibrium τ, λ"].shape == (24,)
    assert {row.section for row in rows.values()} >= {"49.1", "49.2", "49.3", "49.6", "49.7", "49.8", "49.10"}


@needs_pinocchio
@pytest.mark.parametrize("robot", sampled(["planar_arm", "go2"], 1))
def test_the_fast_way_passes_its_rows(robot):
    report = validate(robot, states=3, truths=2, fast=True)
    assert report.passed
    assert [row.quantity for row in report.rows if not row.quantity.startswith("J")] == [
        *("step on the manifold", "difference of two q", "inverse dynamics", "inverse dynamics, f_ext"),
        *("h = C v + g", "forward dynamics", "forward dynamics, f_ext"),
        *("mass matrix M", "kinetic energy", "potential energy", "centre of mass", "centroidal map A_G"),
    ]


@pytest.mark.parametrize(("state", "few"), [("alone", True), ("in a batch", False)])
def test_an_error_of_the_fast_way_fails_its_row(monkeypatch, state, few):
    """Alone or in a batch, with one entry off by 1e-10 of its size."""
    crba = tw.fast.crba

    def off(model, q):
        M = crba(model, q).copy()
        if (q.ndim == 1) == few:
            M[..., 0, 0] *= 1 + 1e-10
        return M

    monkeypatch.setattr(tw.fast, "crba", off)
    report = validate("pendulum", states=3, truths=1, fast=True)
    assert [row.quantity for row in report.failed] == ["mass matrix M"]


@needs_pinocchio
def test_a_tree_with_every_kind_of_joint_passes_by_way_of_the_bridge():
    report = validate(random_tree(8, rng=3), **QUICK)
    assert report.passed, report
    assert not report.loader
    assert "by the bridge" in str(report)


def test_a_robot_that_does_not_move_has_nothing_to_compare():
    report = validate(tw.Builder("stone", base="fixed").build(), **QUICK)
    assert report.passed
    assert report.rows == ()
    assert "nothing moves" in str(report)


def test_the_seed_makes_a_report_repeatable():
    assert validate("pendulum", states=1, truths=0, rng=np.int64(3)).seed == 3
    first, again, other = (validate("cart_pole", rng=seed, **QUICK).rows for seed in (1, 1, 2))
    assert first == again
    assert first != other


def test_the_states_of_a_standing_robot_begin_with_its_posture():
    model = tw.load("go2")
    s = random_states(model, 4, rng=0)
    assert (s.q[0] == model.standing()).all()
    assert (np.abs(s.q[1:, :3]) <= 1).all()


# ---------------------------------------------------------------- what is wrong fails


@pytest.mark.parametrize("q", quantities.QUANTITIES, ids=lambda q: q.name)
@pytest.mark.parametrize("state", sampled([0, 2], 1))
def test_one_entry_off_by_1e_10_fails_the_row(q, state):
    """State 0 is compared with the truth in any case, state 2 with Pinocchio first."""

    def wrong(model, states):
        x = q.ours(model, states).copy()
        entry = np.unravel_index(np.argmax(np.abs(x[state])), x.shape[1:])
        x[(state, *entry)] *= 1 + 1e-10
        return x

    row = go2_judge().row(replace(q, ours=wrong))
    assert not row.passed
    assert row.error == pytest.approx(1e-10, rel=0.5)
    assert f"state {state}" in row.note


@pytest.mark.parametrize(
    ("function", "rows"),
    [
        ("crba", {"mass matrix M"}),
        pytest.param("centroidal_map", {"centroidal map A_G"}, marks=pytest.mark.slow),
        pytest.param("coriolis_matrix", {"Coriolis matrix C"}, marks=pytest.mark.slow),
        pytest.param("frame_jacobian", {"J, local", "J, world", "J, world axes"}, marks=pytest.mark.slow),
    ],
)
def test_the_sign_of_a_single_column_fails_its_rows(monkeypatch, function, rows):
    right = getattr(tw, function)

    def wrong(*args):
        x = right(*args).copy()
        x[..., 1] *= -1
        return x

    monkeypatch.setattr(tw, function, wrong)
    assert {row.quantity for row in validate("planar_arm", **QUICK).failed} == rows


def test_gravity_that_points_up_fails_in_a_batch_or_alone(monkeypatch):
    right = tw.gravity
    monkeypatch.setattr(tw, "gravity", lambda model, q: -right(model, q))
    report = validate("double_pendulum", states=1, truths=1)
    assert [row.quantity for row in report.failed] == ["g"]
    assert "outside: g" in report.summary()
    assert "✗" in str(report)


def test_a_result_that_ignores_the_batch_fails(monkeypatch):
    right = tw.crba
    monkeypatch.setattr(tw, "crba", lambda model, q: np.broadcast_to(right(model, q[0]), (len(q), model.nv, model.nv)))
    assert [row.quantity for row in validate("double_pendulum", **QUICK).failed] == ["mass matrix M"]


def test_nan_a_wrong_shape_and_an_exception_fail_with_a_note(monkeypatch):
    right = tw.center_of_mass
    monkeypatch.setattr(tw, "center_of_mass", lambda model, q: right(model, q) * np.nan)
    monkeypatch.setattr(tw, "kinetic_energy", lambda model, q, v: np.zeros((len(q), 2)))
    monkeypatch.setattr(tw, "potential_energy", lambda model, q: 1 / 0)
    rows = {row.quantity: row for row in validate("pendulum", **QUICK).failed}
    assert set(rows) == {"centre of mass", "kinetic energy", "potential energy"}
    assert np.isnan(rows["centre of mass"].ours_vs_truth)
    assert "expected ()" in rows["kinetic energy"].note
    assert "ZeroDivisionError" in rows["potential energy"].note


@needs_pinocchio
def test_where_the_two_differ_the_truth_says_who_is_right():
    q = quantity("g")
    row = go2_judge().row(replace(q, theirs=lambda p, s: q.theirs(p, s) * (1 + 1e-6)))
    assert row.passed
    assert row.ours_vs_pinocchio == pytest.approx(1e-6, rel=0.1)
    assert row.note == "Pinocchio is 1.0e-06 off the truth"


@needs_pinocchio
def test_where_pinocchio_gives_nan_the_truth_decides_and_the_note_says_so():
    q = quantity("g")
    row = go2_judge().row(replace(q, theirs=lambda p, s: q.theirs(p, s) * np.nan))
    assert row.passed
    assert row.note == "Pinocchio gives NaN"


@needs_pinocchio
def test_a_frame_that_a_link_and_a_joint_share_the_name_of_is_the_one_that_is_meant(tmp_path):
    path, text = tmp_path / "robot.urdf", find("double_pendulum").path.read_text(encoding="utf-8")
    path.write_text(text.replace('"lower"', '"shoulder"').replace('"tip_joint"', '"upper"'), encoding="utf-8")
    model = tw.load(path)
    oracle, s = Oracle(model, path), random_states(model, 1, rng=0)[0]
    types = {"link:shoulder": "BODY", "joint:shoulder": "JOINT", "link:upper": "BODY", "joint:upper": "FIXED_JOINT"}
    found = {name: oracle.model.frames[oracle.frame(name)] for name in types}
    assert {name: frame.type.name for name, frame in found.items()} == types
    named = tuple(types)
    ours = [tw.frame_placement(model, s.q, name).matrix() for name in named]
    np.testing.assert_allclose(oracle.frame_placements(replace(s, frames=named)), ours, rtol=0, atol=1e-14)
    with pytest.raises(tw.ModelError, match="Pinocchio has no frame 'link:elbow'"):
        oracle.frame("link:elbow")


@needs_pinocchio
def test_a_link_and_a_joint_of_one_name_in_one_place_are_one_frame(tmp_path):
    path, text = tmp_path / "robot.urdf", find("pendulum").path.read_text(encoding="utf-8")
    joints, links = re.findall('<joint name="(.*?)"', text), re.findall('<child link="(.*?)"', text)
    for joint, link in zip(joints, links, strict=True):
        text = text.replace(f'name="{joint}"', f'name="{link}"')
    path.write_text(text, encoding="utf-8")
    assert validate(path, states=2, truths=0).passed


@needs_pinocchio
def test_a_file_that_pinocchio_cannot_read_is_named(tmp_path):
    path, text = tmp_path / "robot.urdf", find("pendulum").path.read_text(encoding="utf-8")
    path.write_text(text.replace('<robot name="pendulum"', "<robot"), encoding="utf-8")
    with pytest.raises(tw.ModelError, match=r"robot\.urdf: Pinocchio cannot read it: "):
        validate(path)


@needs_pinocchio
def test_two_robots_are_not_compared():
    with pytest.raises(tw.ModelError, match=r"pendulum: the joints differ: Pinocchio's .*, ours "):
        Oracle(tw.load("pendulum"), find("double_pendulum").path)


def test_a_value_that_is_zero_is_measured_against_the_terms_that_cancelled():
    """A cart's g is zero; 1e-12 of 1 % of its weight may be missing, no more."""
    q, j = quantity("g"), judge(tw.load("cart_pole"))
    weight = 1e-2 * np.abs(tw.joint_wrenches(j.model, j.states.q[0], [0, 0], [0, 0])).max()
    for off, passes in ((0.5e-12, True), (2e-12, False)):

        def moved(model, states, off=off):
            return q.ours(model, states) + np.array([off * weight, 0.0])

        flat = replace(j, states=replace(j.states, q=0 * j.states.q))  # the pole hangs: both entries are zero
        assert flat.row(replace(q, ours=moved)).passed is passes


# ---------------------------------------------------------------- singular and nearly singular


def pendulum_with(tip_mass):
    """A link of 1 kg, and on it one whose inertia is all in a body welded beside its axis, of any size."""
    builder = tw.Builder("two", base="fixed")
    heavy = tw.SpatialInertia(1.0, [0, 0, -0.5], np.eye(3) / 10)
    light = tw.SpatialInertia(tip_mass, [0, 0, -0.5], np.eye(3) * tip_mass / 10)
    builder.link("upper", parent="base_link", joint=tw.Revolute("y"), inertia=heavy)
    down = tw.SE3(np.eye(3), [0, 0, -1])
    builder.link("lower", parent="upper", joint=tw.Revolute("y"), placement=down, inertia=light)
    return builder.build()


def test_a_massless_joint_is_named_and_passes():
    j = judge(pendulum_with(0.0))
    for name in ("forward dynamics", "forward dynamics, f_ext"):
        row = j.row(quantity(name))
        assert row.passed
        assert row.singular
        assert row.note == "singular: 1 joint: 'lower'"
    assert all(j.row(q).passed for q in quantities.QUANTITIES if q.applies(j.model))


def test_numbers_where_there_are_none_fail():
    q = quantity("forward dynamics")
    row = judge(pendulum_with(0.0)).row(replace(q, ours=lambda m, s: np.zeros_like(s.v)))
    assert not row.passed
    assert "does not exist" in row.note


def test_a_singular_error_that_names_another_joint_or_none_fails():
    def raises(message):
        def ours(model, states):
            raise tw.SingularError(message)

        return ours

    q, j = quantity("forward dynamics"), judge(pendulum_with(0.0))
    assert j.row(replace(q, ours=raises("joint 'lower'"))).passed
    assert not j.row(replace(q, ours=raises("joint 'upper'"))).passed
    assert not j.row(replace(q, ours=raises("joints 'lower', 'upper'"))).passed
    assert not j.row(replace(q, ours=raises("something"))).passed
    assert not judge(tw.load("pendulum")).row(replace(q, ours=raises("joint 'pivot'"))).passed
    assert not j.row(replace(quantity("mass matrix M"), ours=raises("joint 'lower'"))).passed


def test_frames_of_both_legs_are_compared():
    assert {name.partition("_")[0] for name in sample_frames(tw.load("humanoid"), 2)} == {"left", "right"}


@pytest.mark.one_case
@needs_pinocchio
@pytest.mark.parametrize(("named", "rows"), [((), 22), (("middle",), 29)])
def test_a_model_of_pinocchio_s_need_not_have_a_frame_on_every_tip(named, rows):
    import pinocchio as pin

    pin.seed(0)
    there, parent = pin.Model(), 0
    kinds = {"first": pin.JointModelFreeFlyer(), "middle": pin.JointModelRX(), "tip": pin.JointModelPZ()}
    for name, joint in kinds.items():
        parent = there.addJoint(parent, joint, pin.SE3.Random(), name)
        there.appendBodyToJoint(parent, pin.Inertia.Random(), pin.SE3.Random())
    for name in named:
        there.addFrame(pin.Frame(name, 2, 0, pin.SE3.Random(), pin.FrameType.OP_FRAME))
    report = validate(tw.bridge.from_pinocchio_model(there), **QUICK)
    assert report.passed
    assert len(report.rows) == rows


def test_two_point_feet_hold_nothing():
    on_two_points = replace(tw.load("humanoid"), feet=("left_sole", "right_sole"))
    row = judge(on_two_points).row(quantity("static equilibrium τ, λ"))
    assert row.passed
    assert row.singular
    assert "no forces at" in row.note


def test_the_bound_of_forward_dynamics_comes_from_the_conditioning():
    well, ill = tw.load("double_pendulum"), pendulum_with(1e-9)
    for model, allowed in ((well, (0, 1e-12)), (ill, (0, 1e-4))):
        s = random_states(model, 1, rng=0)[0]
        assert allowed[0] < forward_dynamics_bound(model, s, tw.aba(model, s.q, s.v, s.tau)) < allowed[1]
    one_and_one = tw.Builder("disc")  # M is [[1, 1], [1, 1]]
    one_and_one.link("hub", parent="base_link", joint=tw.Revolute("z"))
    one_and_one.link("disc", parent="hub", joint=tw.Revolute("z"), inertia=tw.SpatialInertia(1, [0, 0, 0], np.eye(3)))
    for singular in (pendulum_with(0.0), one_and_one.build()):
        s = random_states(singular, 1, rng=0)[0]
        assert forward_dynamics_bound(singular, s, s.a) == np.inf


def coaxial():
    """Two joints about one oblique axis with next to nothing between them: cond(M) is 1e13."""
    builder, axis = tw.Builder("coaxial", base="fixed"), tw.Revolute([1, 2, 3])
    between = tw.SpatialInertia(1e-12, [0, 0, 0], np.eye(3) * 1e-13)
    heavy = tw.SpatialInertia(1.0, [0.3, 0.1, -0.5], np.diag([3, 2, 4]) / 10)
    builder.link("first", parent="base_link", joint=axis, inertia=between)
    builder.link("second", parent="first", joint=axis, inertia=heavy)
    return builder.build()


def test_an_error_beyond_1e_12_passes_where_rounding_explains_it():
    row = judge(coaxial()).row(quantity("forward dynamics"))
    assert row.passed
    assert 1e-12 < row.ours_vs_truth <= row.bound < 1
    assert "the equation is met to" in row.note


def test_to_call_singular_what_is_only_nearly_so_fails():
    def gives_up(model, states):
        raise tw.SingularError("joint 'first'")

    assert not judge(coaxial()).row(replace(quantity("forward dynamics"), ours=gives_up)).passed


def test_an_error_within_the_bound_fails_where_rounding_does_not_explain_it():
    """The equation is then missed by far more than a few roundings of its terms."""
    q, j = quantity("forward dynamics"), judge(coaxial())

    def wrong(model, states):
        return q.ours(model, states) * [1 + 1e-9, 1]

    row = j.row(replace(q, ours=wrong))
    assert row.ours_vs_truth < row.bound
    assert not row.passed


# ---------------------------------------------------------------- what is missing is said


def test_without_pinocchio_the_truth_alone_decides(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    report = validate("double_pendulum", **QUICK)
    assert report.passed
    assert report.pinocchio is None
    assert "Pinocchio is not installed: held against the truth alone" in str(report)
    assert all(row.ours_vs_pinocchio is None and row.ours_vs_truth is not None for row in report.rows)
    right = tw.crba
    monkeypatch.setattr(tw, "crba", lambda model, q: right(model, q).mT * (1 + 1e-9))
    assert [row.quantity for row in validate("double_pendulum", **QUICK).failed] == ["mass matrix M"]


@needs_pinocchio
def test_without_mpmath_pinocchio_alone_decides(monkeypatch):
    monkeypatch.setitem(sys.modules, "mpmath", None)
    report = validate("double_pendulum", **QUICK)
    assert report.passed
    assert "pip install mpmath" in str(report)
    assert all(row.ours_vs_truth is None and row.ours_vs_pinocchio is not None for row in report.rows)
    right = tw.crba
    monkeypatch.setattr(tw, "crba", lambda model, q: right(model, q) * (1 + 1e-9))
    assert [row.quantity for row in validate("double_pendulum", **QUICK).failed] == ["mass matrix M"]


@needs_pinocchio
def test_without_mpmath_a_nearly_singular_equation_is_put_to_the_test_in_long_double():
    row = replace(judge(coaxial()), context=None).row(quantity("forward dynamics"))
    assert row.passed
    assert row.ours_vs_truth is None
    assert "the equation is met to" in row.note


def test_without_both_there_is_nothing_to_compare_with(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    monkeypatch.setitem(sys.modules, "mpmath", None)
    with pytest.raises(ImportError, match=r'pip install "twistwrench\[validate\]"'):
        validate("pendulum")
    model = tw.load("pendulum")
    with pytest.raises(ValueError, match="nothing to compare with"):
        Judge(model, random_states(model, 1, rng=0), None, None, 1).row(quantity("g"))


def test_arguments_that_cannot_be_are_refused():
    with pytest.raises(ValueError, match="states: expected a whole number of at least 1, got 0"):
        validate("pendulum", states=0)
    with pytest.raises(ValueError, match="has its base"):
        validate(tw.load("pendulum"), base="floating")
    with pytest.raises(tw.NameNotFound, match="did you mean 'go2'"):
        validate("go3")


# ---------------------------------------------------------------- reports


def test_the_report_is_json_and_html():
    report = validate("cart_pole", base="floating", **QUICK)  # nothing but a pole carries the base: aba is singular
    found = json.loads(report.to_json())
    assert found["passed"] is True
    assert found["seed"] == 0
    assert len(found["rows"]) == len(report.rows)
    assert {row["bound"] for row in found["rows"]} == {DEFAULT_RTOL}
    assert report._repr_html_().count("<tr>") == len(report.rows) + 1


@pytest.mark.slow
def test_the_table_fits_100_columns():
    lines = str(validate("go2", **QUICK)).splitlines()
    assert max(map(len, lines)) <= 100


# ---------------------------------------------------------------- many robots


@pytest.mark.slow
def test_a_sweep_runs_in_several_processes_and_keeps_the_order():
    which = [("pendulum", "fixed"), ("double_pendulum", "fixed"), ("nonsense", "fixed")]
    found = list(sweep.sweep(which, jobs=2, states=2))
    assert [(o.robot, o.passed) for o in found] == [("pendulum", True), ("double_pendulum", True), ("nonsense", False)]
    assert "unknown robot" in sweep.line(found[2])
    assert "2 of 3 robots and bases inside all their bounds" in sweep.summary(found, 1.0)
    alone = list(sweep.sweep(which, jobs=1, states=2))
    assert [o.report.rows for o in found[:2]] == [o.report.rows for o in alone[:2]]


def test_a_sweep_says_that_the_robots_of_a_package_are_left_out(monkeypatch):
    monkeypatch.setattr(sweep, "example_robot_data_folder", lambda: None)
    assert len(sweep.every_robot("fixed")) == 6
    assert sweep.summary([], 1.0).startswith("example-robot-data is not installed: its robots are left out")


def test_every_robot_of_the_catalogue_is_on_both_bases():
    every = sweep.every_robot()
    assert len(every) == len(set(every)) == 2 * len(sweep.every_robot("fixed"))
    assert {name for name, _ in every} <= {robot.name for robot in tw.robots()}


@pytest.mark.slow
@pytest.mark.parametrize(("robot", "base"), [("romeo", "floating"), ("icub", "fixed"), ("iris", "floating")])
def test_robots_of_example_robot_data_pass(robot, base):
    if not any(name == robot for name, _ in sweep.every_robot()):
        pytest.skip("example-robot-data is not installed")
    assert (fast := validate(robot, base=base, states=2, truths=1, fast=True)).passed, fast
    report = validate(robot, base=base, states=2, truths=1)
    assert report.passed, report
    aba = next(row for row in report.rows if row.pinocchio == "aba")
    assert aba.singular is (robot in ("romeo", "icub"))
    if robot == "romeo":
        assert "24 joints" in aba.note

"""What `tw.trace` tells: the values of the textbook, equal to those that others find, and balanced at each body."""

import re
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import newton_euler_3d as slow

from ..robots import shared

SOURCE = Path(tw.__file__).parent
ULPS = 1e-13
"""Relative: two ways of computing one number, on trees of a dozen bodies."""

MODELS = {
    "go2": shared("go2"),
    "humanoid": shared("humanoid"),
    **{f"tree {seed}": tw.random_tree(9, rng=seed, base=base) for seed, base in ((1, "fixed"), (2, "floating"))},
}


@pytest.fixture(
    params=[pytest.param(name, marks=[pytest.mark.slow] * (name == "humanoid")) for name in MODELS], scope="module"
)
def case(request):
    model, rng = MODELS[request.param], np.random.default_rng(5)
    f_ext = rng.normal(size=(model.nbodies, 6))
    f_ext[0] = 0
    return model, model.random_configuration(rng=rng), rng.normal(size=model.nv), rng.normal(size=model.nv), f_ext


def traces(case):
    model, q, v, a, f_ext = case
    tau = tw.rnea(model, q, v, a, f_ext)
    return [
        tw.trace(model, "rnea", q, v, a, f_ext=f_ext),
        tw.trace(model, "aba", q, v, tau=tau, f_ext=f_ext),
        tw.trace(model, "crba", q),
        tw.trace(model, "forward_kinematics", q, v, a),
    ]


def close(x, y, name=""):
    size = max(1.0, float(np.abs(y).max(initial=0)))
    np.testing.assert_allclose(np.asarray(x, float), np.asarray(y, float), rtol=0, atol=20 * ULPS * size, err_msg=name)


# ---------------------------------------------------------------- the same as the textbook


def test_watching_changes_nothing(case):
    model, q, v, a, f_ext = case
    inverse, forward, matrix, motion = traces(case)
    found = tw.forward_kinematics(model, q, v, a)
    np.testing.assert_array_equal(inverse.result, tw.rnea(model, q, v, a, f_ext))
    np.testing.assert_array_equal(forward.result, tw.aba(model, q, v, inverse.result, f_ext))
    np.testing.assert_array_equal(matrix.result, tw.crba(model, q))
    np.testing.assert_array_equal(motion.result, [T.matrix() for T in found.placement])
    np.testing.assert_array_equal(motion["V"], found.twist)
    np.testing.assert_array_equal(motion["A"], found.acceleration)


def test_every_step_is_a_line_of_the_source(case):
    files = {
        "newton_euler": "rnea",
        "articulated_body": "aba",
        "composite_rigid_body": "crba",
        "placements": "kinematics",
        "motion": "kinematics",
    }
    for trace in traces(case):
        assert len(trace.steps) >= 3 * (trace.model.nbodies - 1)
        for step in trace.steps:
            lines = (SOURCE / "algorithms" / f"{files[step.function]}.py").read_text(encoding="utf-8").splitlines()
            assert step.source == lines[step.line - 1].strip()
            assert re.search(rf"\b{step.name}\b", step.source)


def test_outward_passes_reach_each_body_once_and_in_order(case):
    for trace in traces(case)[:2]:
        turns = [step.index for step in trace.steps if step.name == "V"]
        assert turns == list(range(1, trace.model.nbodies))


# ---------------------------------------------------------------- balance


def test_own_and_received_are_the_total_at_each_body(case):
    for trace in traces(case):
        for row in trace.rows:
            for name, account in row.accounts.items():
                close(account.own + sum(account.received.values()), account.total, f"{trace.algorithm} {name}")
                assert list(account.received) == [r.body for r in trace.rows if r.parent == row.body]
                assert (account.passed is None) == (row.body == 0)


def test_what_is_received_is_what_was_passed_on(case):
    for trace in traces(case):
        for row in trace.rows[1:]:
            for name, account in row.accounts.items():
                np.testing.assert_array_equal(trace.rows[row.parent].accounts[name].received[row.body], account.passed)


def test_a_wrench_is_passed_on_with_its_moment_about_the_parents_origin(case):
    model, q, *_ = case
    T = tw.forward_kinematics(model, q).placement
    for row in traces(case)[0].rows[1:]:
        place = T[row.parent].inverse() @ T[row.body]
        F, passed = row.accounts["F"].total, row.accounts["F"].passed
        force = place.rotation @ F[3:]
        close(passed[3:], force)
        close(passed[:3], place.rotation @ F[:3] + np.cross(place.translation, force))


def test_the_ground_bears_what_changes_the_momentum_and_carries_the_weight(case):
    """Newton and Euler for the whole robot, about its centre of mass."""
    model, q, v, a, f_ext = case
    borne = traces(case)[0].rows[0].accounts["F"].total
    com = tw.center_of_mass(model, q)
    rate = tw.centroidal_momentum_rate(model, q, v, a) - [0, 0, 0, *(model.mass * model.gravity)]
    T = tw.forward_kinematics(model, q).placement
    for i in range(1, model.nbodies):
        f = T[i].rotation @ f_ext[i, 3:]
        rate -= [*(T[i].rotation @ f_ext[i, :3] + np.cross(T[i].translation - com, f)), *f]
    close(borne[3:], rate[3:])
    close(borne[:3], rate[:3] + np.cross(com, rate[3:]))


# ---------------------------------------------------------------- independent quantities


def test_twists_accelerations_and_wrenches_are_those_of_the_slow_obvious_way(case):
    model, q, v, a, f_ext = case
    trace = traces(case)[0]
    kinematics = tw.forward_kinematics(model, q, v, a)
    close(trace["V"], kinematics.twist)
    rises = [np.concatenate([np.zeros(3), T.rotation.mT @ -model.gravity]) for T in kinematics.placement]
    close(trace["A"], kinematics.acceleration + rises)
    close(trace["F"][1:], slow.joint_wrenches(model, q, v, a, f_ext)[1:])
    close(np.concatenate(trace["tau"][1:]), trace.result)


def test_articulated_inertia_and_bias_give_the_wrench_of_the_joint(case):
    """IA A + pA is the wrench at the joint in the motion that results: what rnea finds from the other side."""
    inverse, forward, *_ = traces(case)
    for there, here in zip(inverse.rows, forward.rows):
        IA, pA = (here.accounts[name].total for name in ("IA", "pA"))
        F = there.accounts["F"].total
        bound = 1e-10 * max(1.0, np.abs(F).max())  # the acceleration of aba itself: forward dynamics loses some digits
        np.testing.assert_allclose(IA @ here.values["A"] + pA, F, rtol=0, atol=bound)


def test_what_a_joint_feels_follows_from_what_was_read_there(case):
    model, *_ = case
    for row in traces(case)[1].rows[1:]:
        s, S = model.v_slice[row.body], model.constants(float).S[row.body]
        felt = S.mT @ row.accounts["IA"].total @ S + np.diag(model.armature[s])
        close(row.values["D"], felt)
        close(row.values["U"], row.accounts["IA"].total @ S)
        assert np.linalg.eigvalsh(row.values["D"]).min() > 0


def test_a_unit_acceleration_sends_the_column_of_the_mass_matrix_inward(case):
    """F of crba is the wrench of rnea where one joint alone accelerates, at rest and without gravity."""
    model, q, *_ = case
    trace, rest = traces(case)[2], np.zeros(model.nv)
    at_rest = tw.joint_wrenches(model, q, rest, rest)
    for row in trace.rows[1:]:
        for k in range(model.v_slice[row.body].start, model.v_slice[row.body].stop):
            column = k - model.v_slice[row.body].start
            wrenches = tw.joint_wrenches(model, q, rest, np.eye(model.nv)[k]) - at_rest
            for j in model.support(row.body):
                close(row.values[f"F in {j}"][:, column], wrenches[j])
                close(row.values[f"M[{j}, {row.body}]"][:, column], trace.result[model.v_slice[j], k])


def test_composite_inertias_carry_the_mass_of_their_subtree(case):
    model, *_ = case
    for row in traces(case)[2].rows:
        subtree = [i for i in range(model.nbodies) if row.body in (*model.support(i), 0)]
        close(row.accounts["IC"].total[3:, 3:], np.eye(3) * sum(model.inertia[i].mass for i in subtree))


def test_pinocchio_keeps_the_same_values():
    pin = pytest.importorskip(
        "pinocchio", reason="Pinocchio is not installed: its intermediate values are not compared"
    )
    model, rng = MODELS["go2"], np.random.default_rng(7)
    there = tw.bridge.to_pinocchio_model(model)
    data, swap = there.createData(), [3, 4, 5, 0, 1, 2]
    q, v, a = model.random_configuration(rng=rng), rng.normal(size=18), rng.normal(size=18)
    their_v, their_a = (tw.bridge.to_pinocchio_tangent(model, x) for x in (v, a))
    tau = pin.rnea(there, data, q, their_v, their_a)
    trace = tw.trace(model, "rnea", q, v, a)
    for i in range(1, model.nbodies):
        close(trace["V"][i][swap], data.v[i].vector)
        close(trace["F"][i][swap], data.f[i].vector)
        close(trace["A"][i][swap], data.a_gf[i].vector)
    pin.aba(there, data, q, their_v, tau)
    forward = tw.trace(model, "aba", q, v, tau=trace.result)
    for i in range(1, model.nbodies):
        IA, U, D = forward["IA"][i], forward["U"][i], forward["D"][i]
        Ia = IA - U @ np.linalg.solve(D, U.mT) if model.parent[i] else IA  # what Pinocchio keeps, but of the base
        close(Ia[np.ix_(swap, swap)], data.Yaba[i])
    pin.crba(there, data, q)
    for i, IC in enumerate(tw.trace(model, "crba", q)["IC"][1:], 1):
        close(IC[np.ix_(swap, swap)], data.Ycrb[i].matrix())


# ---------------------------------------------------------------- how it is shown


def test_the_table_has_a_block_for_each_body_with_its_account():
    model = MODELS["go2"]
    rest = np.zeros(model.nv)
    trace = tw.trace(model, "rnea", model.standing(), rest, rest)
    assert repr(trace) == f"<Trace: rnea of 'go2', 13 bodies, {len(trace.steps)} steps>"
    blocks = str(trace).split("\n\n")
    assert len(blocks) == 1 + model.nbodies
    hip = blocks[3].splitlines()
    assert hip[0] == "2 FL_hip_joint, on 1"
    assert [line[2:20].strip() for line in hip[1:]] == ["V", "A", "F: its own", "+ from 3", "= F", "→ to 1", "tau"]
    shown = [float(x) for x in re.findall(r"-?\d[\d.e-]*", hip[5].partition("F ")[2].partition("N m")[0])]
    np.testing.assert_allclose(shown, trace.row("FL_hip_joint").accounts["F"].total, rtol=1e-3, atol=1e-12)


def test_what_is_small_is_shown_and_what_rounding_left_is_not():
    arm = tw.Builder("hair", gravity=(0, 0, -9.81))
    mote = tw.SpatialInertia(1e-9, [1e-3, 0, 0], 1e-16 * np.eye(3))  # a microgram on 2 mm
    arm.link("hair", parent="base_link", joint=tw.Revolute([0, -1, 0]), inertia=mote)
    trace = tw.trace(arm.build(), "rnea", [0.0], [0.0], [0.0])
    assert "tau                  9.81e-12" in str(trace)
    assert "tau = 9.81e-12" in trace.tree()
    level = tw.trace(arm.build(), "rnea", [np.pi / 2], [0.0], [0.0])  # it hangs: cos(π/2) is 6e-17
    assert "tau                         0" in str(level)


@pytest.mark.parametrize("name", ["go2", "humanoid"])
def test_table_and_tree_are_a_hundred_columns_wide_at_most(name):
    rng = np.random.default_rng(0)
    model, q = MODELS[name], MODELS[name].random_configuration(rng=rng)
    v, a = rng.standard_normal((2, model.nv))
    given = {"rnea": {"v": v, "a": a}, "aba": {"v": v, "tau": a}, "crba": {}, "forward_kinematics": {"v": v, "a": a}}
    for algorithm, rest in given.items():
        trace = tw.trace(model, algorithm, q, **rest)
        assert max(map(len, [*str(trace).splitlines(), *trace.tree().splitlines()])) <= 100


def test_the_tree_has_every_body_once_below_its_parent():
    for trace in traces((MODELS["humanoid"], MODELS["humanoid"].standing(), *np.zeros((2, 27)), np.zeros((23, 6)))):
        lines = trace.tree().splitlines()
        assert lines[0] == "universe"
        bodies = [re.match(r"([│├└─ ]*)(\d+) (\S+)", line).groups() for line in lines[1:]]
        depth = {0: 0}
        for indent, number, name in bodies:
            i = int(number)
            depth[i] = len(indent) // 3
            assert depth[i] == depth[trace.model.parent[i]] + 1
            assert name == trace.model.joint_names[i]
        assert len(depth) == trace.model.nbodies


@pytest.mark.one_case
def test_a_notebook_shows_the_same_lines_as_the_table(case):
    for trace in traces(case):
        html = trace._repr_html_().partition("<details>")[2]
        lines = sum(line.startswith("  ") for line in str(trace).splitlines())
        assert html.count("<tr>") == lines + trace.model.nbodies
        assert html.count("<td") == lines * 8


def test_a_variable_is_asked_for_by_its_name_in_the_source():
    trace = traces((MODELS["go2"], MODELS["go2"].standing(), *np.ones((2, 18)), np.zeros((14, 6))))[1]
    assert [len(x) for x in trace["u"][1:]] == [6] + 12 * [1]
    assert trace["u"][0] is None
    assert trace.row(np.int64(2)) is trace.row("FL_hip_joint") is trace.rows[2]
    with pytest.raises(tw.NameNotFound, match="unknown variable 'IC' of aba"):
        trace["IC"]


# ---------------------------------------------------------------- the steps


def test_the_last_value_that_a_line_gives_is_that_of_the_record(case):
    for trace in traces(case):
        last = {(step.name, step.index): step.value for step in trace.steps}
        for row in trace.rows[1:]:
            for name, account in row.accounts.items():
                np.testing.assert_array_equal(last.get((name, row.body), account.own), account.total)
            for name in ("T", "V", "c", "A", "U", "D", "u", "tau", "qdd"):
                if name in row.values:
                    np.testing.assert_array_equal(last[name, row.body], row.values[name])


def test_what_adds_up_is_told_child_by_child(case):
    for trace, name in zip(traces(case), ("F", "pA", "IC")):
        for row in trace.rows:
            told = [step for step in trace.steps if (step.name, step.index) == (name, row.body)]
            received = row.accounts[name].received
            assert [step.body for step in told if step.body != row.body] == sorted(received, reverse=True)


def test_a_trace_keeps_its_values_when_the_callers_arrays_change():
    model = shared("double_pendulum")
    q, v, a, f_ext = np.array([0.3, 0.4]), np.ones(2), np.ones(2), np.ones((3, 6)) * [[0.0], [1.0], [1.0]]
    trace = tw.trace(model, "rnea", q, v, a, f_ext=f_ext)
    before = [np.array(step.value) for step in trace.steps]
    for x in (q, v, a, f_ext):
        x[:] = 99
    for step, value in zip(trace.steps, before, strict=True):
        np.testing.assert_array_equal(step.value, value)


# ---------------------------------------------------------------- what cannot be traced


@pytest.mark.parametrize(
    ("arguments", "error", "said"),
    [
        (("fd", [0.0, 0.0]), tw.NameNotFound, "unknown algorithm 'fd'; known: 'rnea', 'aba', 'crba'"),
        (("rnea", [0.0, 0.0], [0.0, 0.0]), ValueError, "rnea takes q, v, a; got q, v"),
        (("crba", [0.0, 0.0], [0.0, 0.0]), ValueError, "crba takes q; got q, v"),
        (("aba", [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]), ValueError, "aba takes q, v, tau; got q, v, a"),
        (("crba", [[0.0, 0.0]]), tw.ShapeError, "q: expected one state, got a batch (1,)"),
        (
            ("rnea", [0.0, 0.0], [[0.0, 0.0]], [0.0, 0.0]),
            tw.ShapeError,
            "q, v, a: expected one state, got a batch (1,)",
        ),
        (("crba", [0.0, np.nan]), ValueError, "q: expected finite numbers"),
        (("rnea", [0.0], [0.0, 0.0], [0.0, 0.0]), tw.ShapeError, "q: expected shape (..., 2)"),
    ],
)
def test_what_cannot_be_traced_is_said(arguments, error, said):
    with pytest.raises(error, match=re.escape(said)):
        tw.trace(shared("double_pendulum"), *arguments)


def test_the_mass_matrix_refuses_wrenches_that_could_change_nothing():
    with pytest.raises(ValueError, match="f_ext: expected none, since neither M nor A_G depends on it"):
        tw.trace(shared("pendulum"), "crba", [0.0], f_ext=np.zeros((2, 6)))
    with pytest.raises(ValueError, match="f_ext: expected none, since no placement or motion depends on it"):
        tw.trace(shared("pendulum"), "forward_kinematics", [0.0], [0.0], [0.0], f_ext=np.zeros((2, 6)))

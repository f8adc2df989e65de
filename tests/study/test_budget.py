"""`python -m benchmarks.study budget`: what a motion needs, the effect of each source of error, docs/budget.md."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from study.__main__ import main as study_main
from study.budget import SOURCES, budget, differentiated, template
from tables import fill

import twistwrench as tw
from twistwrench.motions.support import needs

from ..pages import page
from ..robots import shared

GO2 = shared("go2")
WALK = tw.motions.walk(GO2, samples=60)
TROT = tw.motions.trot(GO2, samples=60)


@pytest.fixture
def maker(benchmark_file):
    """benchmarks/budget.py, which makes the page's table."""
    return benchmark_file("budget")


# ---------------------------------------------------------------- what a motion needs


def test_at_rest_the_pressure_is_below_the_centre_of_mass():
    rest = replace(WALK, v=0 * WALK.v, a=0 * WALK.a)
    feet = np.stack([tw.frame_placement(GO2, WALK.q, foot).translation for foot in WALK.feet], axis=1)
    middle = np.average(feet, axis=1, weights=np.broadcast_to(WALK.contacts[..., None], feet.shape))
    below = (tw.center_of_mass(GO2, WALK.q) - middle)[:, :2]
    np.testing.assert_allclose(needs(GO2, rest).pressure, below, rtol=0, atol=1e-14)


def test_in_motion_the_pressure_is_that_of_the_centroidal_momentum():
    """`motions.ground` takes it from ḣ_G, and the feet of this walk stand on the level of zero."""
    feet = np.stack([tw.frame_placement(GO2, WALK.q, foot).translation for foot in WALK.feet], axis=1)
    middle = np.average(feet, axis=1, weights=np.broadcast_to(WALK.contacts[..., None], feet.shape))
    right = tw.motions.ground(GO2, WALK).center_of_pressure - middle
    np.testing.assert_allclose(needs(GO2, WALK).pressure, right[:, :2], rtol=0, atol=1e-12)


def test_the_torques_are_those_of_the_least_contact_forces():
    found = needs(GO2, WALK).tau
    for k in range(0, 60, 7):
        contacts = [tw.PointContact(foot, 0.6) for foot, on in zip(WALK.feet, WALK.contacts[k]) if on]
        right = tw.contact_inverse_dynamics(GO2, WALK.q[k], WALK.v[k], WALK.a[k], contacts).tau[6:]
        np.testing.assert_allclose(found[k], right, rtol=0, atol=1e-11)


@pytest.mark.slow
def test_in_flight_there_is_no_pressure_and_no_force():
    jump = tw.motions.jump(GO2, samples=20)
    flies = ~jump.contacts.any(axis=1)
    found = needs(GO2, jump)
    assert flies.any()
    assert np.isnan(found.pressure[flies]).all()
    assert np.isfinite(found.pressure[~flies]).all()
    np.testing.assert_allclose(found.tau[flies], tw.rnea(GO2, jump.q, jump.v, jump.a)[flies, 6:], rtol=0, atol=1e-12)


# ---------------------------------------------------------------- the sources


@pytest.fixture(scope="module")
def found():
    return {(record.quantity, record.way): record for record in budget(GO2, TROT)}


def test_every_source_is_measured_and_none_is_without_effect(found):
    assert list(found) == [(quantity, name) for name in SOURCES for quantity in ("torque", "pressure")]
    for name in SOURCES:
        assert 0 < found["torque", name].error < 100
        assert 0 < found["pressure", name].error < 1e4
        assert found["torque", name].where in GO2.joint_names


def test_sizes_are_those_of_the_number_types(found):
    assert found["torque", "float64"].error < 1e-11
    assert 1e-7 < found["torque", "float32"].error < 1e-4


def test_g_changes_the_weight_and_what_it_presses():
    """The torques are affine in g: twice the change is twice the error."""
    lighter = replace(GO2, gravity=GO2.gravity * (2 * 9.8 / 9.81 - 1))
    once = SOURCES["g = 9.8 for 9.81"][1](GO2, TROT).tau - needs(GO2, TROT).tau
    twice = needs(lighter, TROT).tau - needs(GO2, TROT).tau
    np.testing.assert_allclose(twice, 2 * once, rtol=0, atol=1e-12)
    assert np.abs(once).max() > 1e-2


@pytest.mark.slow
def test_differences_grow_with_the_square_of_the_step():
    trot = tw.motions.trot(GO2, samples=401)
    h, true = trot.t[1] - trot.t[0], needs(GO2, trot).tau
    inside = slice(100, 300)
    errors = [np.abs(differentiated(k * h, GO2, trot).tau - true)[inside].max() for k in (2, 4)]
    assert 3 < errors[1] / errors[0] < 5


def test_the_joints_that_are_held_stand_and_move_the_rest():
    sums = SOURCES["joints that move least, held"][1](GO2, TROT).tau - needs(GO2, TROT).tau
    assert np.abs(sums).max() > 0.1


def test_a_template_of_the_whole_body_leaves_out_the_legs_alone():
    """Centroidal dynamics leave nothing out of the ground's wrench: the pressure is right, the torques are not."""
    whole, true = template("centroidal", GO2, TROT), needs(GO2, TROT)
    np.testing.assert_allclose(whole.pressure, true.pressure, rtol=0, atol=1e-10)
    legs = tw.rnea(GO2, TROT.q, TROT.v, TROT.a)[:, 6:]
    np.testing.assert_allclose(true.tau - whole.tau, legs, rtol=0, atol=1e-9)


# ---------------------------------------------------------------- the command and the page


@pytest.mark.slow
def test_the_command_prints_and_writes(tmp_path, capsys):
    picture, file = tmp_path / "b.svg", tmp_path / "b.json"
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: the picture is not drawn")
    assert study_main(["budget", "go2", "--plot", str(picture), "--json", str(file)]) == 0
    assert "base pitched by 1°" in capsys.readouterr().out
    assert picture.stat().st_size > 10_000
    records = json.loads(file.read_text(encoding="utf-8"))["records"]
    assert [record["way"] for record in records if record["quantity"] == "torque"] == list(SOURCES)


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_table_of_the_page_is_that_of_the_results(maker, language):
    text = page("budget", language).read_text(encoding="utf-8")
    assert fill(text, maker.tables()) == text
    assert re.findall(r"<!-- table: (\w+) -->", text) == ["budget"]


def test_the_results_are_those_of_today(maker, found):
    kept = maker.records("go2")
    assert [(record.quantity, record.way) for record in kept] == list(found)
    for record in kept:  # the trot of the test has a seventh of the states
        if record.quantity == "torque" and SOURCES[record.way][0] in ("model", "state", "slip"):
            assert record.error == pytest.approx(found["torque", record.way].error, rel=0.2)


def test_the_forces_make_the_base_move_as_it_does():
    """Newton: their sum is m (a_G - g), wherever four, three or two feet stand."""
    forces = needs(GO2, WALK).forces
    assert forces.shape == (60, 4, 3)
    assert np.abs(forces[~WALK.contacts]).max() < 1e-12  # N: the pseudo-inverse rounds
    acceleration = tw.center_of_mass_acceleration(GO2, WALK.q, WALK.v, WALK.a)
    np.testing.assert_allclose(forces.sum(axis=1), GO2.mass * (acceleration - GO2.gravity), rtol=0, atol=1e-10)

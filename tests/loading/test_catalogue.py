"""The catalogue says what is true of its robots, and they are what their files say."""

import re
import subprocess
import sys
from collections import Counter

import numpy as np
import pytest

from twistwrench import ModelError, center_of_mass, frame_placement
from twistwrench.loading import catalogue, load, robots
from twistwrench.loading.element import read_robot_xml
from twistwrench.loading.stances import STANCES, Stance, read_states, with_stance, with_states

FOLDER = catalogue.example_robot_data_folder()
OWN = [robot for robot in robots() if robot.source == "models"]
OTHERS = [robot for robot in robots() if robot.source == "example-robot-data"]
LEGGED = [robot for robot in robots() if robot.stance is not None]
installed = pytest.mark.skipif(FOLDER is None, reason="example-robot-data is not installed: its rows are not checked")


def here(rows):
    return [row for row in rows if row.source == "models" or FOLDER is not None]


def physical(robot):
    """Return the argument with which a robot loads without a warning."""
    return None if "not physical" not in robot.note else False


# -------------------------------------------------------------------- the table


def test_names_are_unambiguous():
    assert [name for name, count in Counter(robot.name for robot in robots()).items() if count > 1] == []


def test_every_urdf_of_models_is_in_the_table():
    assert {robot.file for robot in OWN} == {path.name for path in catalogue.models_folder().glob("*.urdf")}


@installed
def test_every_urdf_of_example_robot_data_is_in_the_table():
    files = {path.relative_to(FOLDER).as_posix() for path in FOLDER.glob("**/*.urdf")}
    stub = {"ur_description/urdf/ur3.urdf"}  # no link at all; Pinocchio refuses it as well
    assert {robot.file for robot in OTHERS} == files - stub
    with pytest.raises(ModelError, match="no <link>"):
        load(FOLDER / stub.pop())


@pytest.mark.parametrize("robot", here(robots()), ids=lambda robot: robot.name)
def test_row_is_true(robot):
    model = load(robot.name, physical=physical(robot))
    assert (model.nv, model.base) == (robot.dof, robot.base)
    massless = sum(bool(inertia.mass == 0) for inertia in model.inertia[1:])
    joints = read_robot_xml(robot.path).findall("joint")
    mimics = sum(joint.find("mimic") is not None and joint.get("type") != "fixed" for joint in joints)
    facts = {"massless": massless, "mimic": mimics}
    for word, count in facts.items():
        noted = re.search(rf"(\d+) {word}", robot.note)
        assert (int(noted[1]) if noted else 0) == count, word


@pytest.mark.parametrize("robot", [r for r in here(robots()) if "not physical" in r.note], ids=lambda robot: robot.name)
def test_unphysical_robots_are_refused_with_the_way_out_or_warn(robot):
    with pytest.raises(ModelError, match=r"(?s)cannot exist.*physical=False.*link '"):
        load(robot.name, physical=True)
    if "warning" in robot.note:
        with pytest.warns(UserWarning, match="too much"):
            load(robot.name)
    else:
        with pytest.raises(ModelError, match=r"(?s)physical=False.*positive definite"):
            load(robot.name)


@installed
@pytest.mark.parametrize("robot", OTHERS, ids=lambda robot: robot.name)
def test_licence_is_the_one_of_the_robots_readme(robot):
    readme = FOLDER / robot.file.split("/")[0] / "README.md"
    licence = re.search(r"(?i)license:\s*(.+)", readme.read_text())[1].strip()
    assert robot.licence == {"ASL 2.0": "Apache-2.0"}.get(licence, licence)


def test_table_prints_as_a_table():
    text, html = repr(robots()), robots()._repr_html_()
    lines = text.splitlines()
    assert lines[0].split() == ["name", "dof", "base", "source", "licence", "note"]
    assert len(lines) == len(robots()) + 1
    assert html.count("<tr>") == len(robots()) + 1
    assert all(robot.name in line for robot, line in zip(robots(), lines[1:], strict=True))
    assert max(map(len, lines)) <= 140


# -------------------------------------------------------------------- names


def test_unknown_name_lists_the_nearest():
    with pytest.raises(KeyError, match=r"unknown robot 'anymal'; did you mean .*'anymal_b'"):
        load("anymal")
    with pytest.raises(ValueError, match=r"did you mean .*'example-robot-data/go2'"):
        load("example-robot-data/go3")


@installed
def test_plain_name_is_ours_and_the_prefix_leads_to_the_other():
    assert (load("go2").name, load("example-robot-data/go2").name) == ("go2", "go2_description")
    assert load("example-robot-data/panda").name == load("panda").name


@pytest.mark.parametrize("name", ["pendulum", "go2"])
def test_base_can_be_chosen(name):
    fixed, floating = load(name, base="fixed"), load(name, base="floating")
    assert (fixed.base, floating.base) == ("fixed", "floating")
    assert floating.nv == fixed.nv + 6


def test_without_example_robot_data_the_error_says_how_to_get_it(monkeypatch):
    monkeypatch.setattr(catalogue, "example_robot_data_folder", lambda: None)
    with pytest.raises(ModelError, match=r"'talos_reduced'.*pip install example-robot-data"):
        load("talos_reduced")
    assert load("go2").nv == 18


def test_models_are_found_inside_an_installed_package(monkeypatch, tmp_path):
    """A wheel carries models/ inside the package; a checkout has it beside src/."""
    package = tmp_path / "site-packages" / "twistwrench"
    (package / "robots").mkdir(parents=True)
    monkeypatch.setattr(catalogue, "__file__", str(package / "robots" / "catalogue.py"))
    (package / "models").mkdir()
    assert catalogue.models_folder() == package / "models"
    (package / "models").rmdir()
    assert catalogue.models_folder() == tmp_path / "models"


def test_conda_installs_example_robot_data_without_cmeel(monkeypatch, tmp_path):
    folder = tmp_path / "share" / "example-robot-data" / "robots"
    folder.mkdir(parents=True)
    monkeypatch.setattr(sys, "path", [])
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    assert catalogue.example_robot_data_folder() == folder


@pytest.mark.slow
def test_a_robot_is_read_with_lxml_alone_and_only_when_it_is_asked_for():
    """A reader of meshes would pull in trimesh, scipy and some thirty other packages, 266 MB."""
    show = "print('lxml' in sys.modules, *{'yourdfpy', 'trimesh', 'scipy'} & {*sys.modules})"
    code = f"import sys, twistwrench as tw; tw.robots(); {show}; tw.load('go2'); {show}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "True"]


def test_capitals_do_not_hide_the_name_that_was_meant():
    assert all(name == name.lower() for name in (robot.name for robot in robots()))
    with pytest.raises(KeyError, match=r"unknown robot 'GO2'; did you mean 'go2'"):
        load("GO2")


# -------------------------------------------------------------------- how they stand


def test_every_stance_belongs_to_a_robot():
    names = {f"models/{robot.name}" for robot in OWN} | {robot.name.removeprefix(catalogue.PREFIX) for robot in OTHERS}
    assert set(STANCES) <= names


@pytest.mark.parametrize("robot", here(LEGGED), ids=lambda robot: robot.name)
def test_legged_robots_stand_within_their_limits_with_all_feet_on_the_ground(robot):
    model = load(robot.name, physical=physical(robot))
    q = model.standing()
    model.state(q)
    assert (q >= model.lower).all()
    assert (q <= model.upper).all()
    feet = np.array([frame_placement(model, q, foot).translation for foot in model.feet])
    assert len(model.feet) in (2, 4, 8)
    np.testing.assert_allclose(feet[:, 2], 0, atol=1e-5)  # SRDFs give five digits
    above = center_of_mass(model, q)
    assert above[2] > 0.1
    middle, reach = feet.mean(axis=0), np.ptp(feet, axis=0)
    assert (np.abs(above - middle)[:2] < np.maximum(reach[:2] / 2, 0.1)).all()  # it would not fall at once


@pytest.mark.parametrize("robot", here(LEGGED), ids=lambda robot: robot.name)
def test_standing_angles_are_the_same_on_a_fixed_base(robot):
    fixed = load(robot.name, base="fixed", physical=False)
    floating = load(robot.name, physical=False)
    np.testing.assert_array_equal(fixed.standing(), floating.standing()[7:])


def test_the_lowest_foot_is_the_one_on_the_ground():
    model = with_stance(load("go2"), Stance(("base", "FL_foot", "imu")))
    heights = [float(frame_placement(model, model.standing(), foot).translation[2]) for foot in model.feet]
    assert min(heights) == heights[1] == 0
    assert heights[0] > 0.3


def test_a_robot_without_legs_does_not_stand():
    with pytest.raises(KeyError, match="standing"):
        load("pendulum").standing()


@installed
def test_postures_come_from_the_srdf_and_continuous_joints_take_an_angle():
    model = load("kinova")
    states = read_states(catalogue.find("kinova").srdf)
    q = model.postures["arm_up"]
    for i, name in enumerate(model.joint_names):
        angle = states["arm_up"].get(name)
        if angle is not None:
            expected = angle if model.joints[i].nq == 1 else [np.cos(angle[0]), np.sin(angle[0])]
            np.testing.assert_allclose(q[model.q_slice[i]], expected, rtol=1e-15)


@installed
def test_base_of_a_posture_is_the_srdfs():
    assert load("talos_reduced").postures["half_sitting"][:7].tolist() == [0, 0, 1.01927, 0, 0, 0, 1]


def test_broken_srdf_is_an_error(tmp_path):
    path = tmp_path / "robot.srdf"
    path.write_text('<robot name="r">\n<group_state name="s"><joint name="j" value="up"/></group_state></robot>')
    with pytest.raises(ModelError, match="line 2: a value in this posture"):
        read_states(path)


def test_posture_of_another_joint_is_an_error():
    with pytest.raises(ModelError, match=r"'shoulder': expected 1 numbers, got \[1.0, 2.0\]"):
        with_states(load("double_pendulum"), {"home": {"shoulder": [1.0, 2.0]}})


def test_without_example_robot_data_there_is_no_folder_of_it(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "path", [])
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    assert catalogue.example_robot_data_folder() is None

"""Everything that can be wrong with a URDF is an error that says what, where, and what was expected."""

import os
import re
import time
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import ModelError
from twistwrench.loading import load

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
JOINT = f'<joint name="j" type="revolute"><parent link="a"/><child link="b"/>{LIMIT}</joint>'
GOOD = f'<robot name="r">\n<link name="a">{INERTIAL}</link>\n<link name="b">{INERTIAL}</link>\n{JOINT}\n</robot>'


def refuse(source, *words, **options):
    """Load what must be refused; the message must hold every word."""
    with pytest.raises(ModelError) as caught:
        load(source, **options)
    message = str(caught.value)
    for word in words:
        assert word in message, f"{word!r} is not in: {message}"
    return message


@pytest.fixture
def save(tmp_path):
    def saved(text):
        path = tmp_path / "robot.urdf"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return saved


def changed(old, new, count=1):
    assert old in GOOD
    return GOOD.replace(old, new, count)


def test_the_good_file_is_good(save):
    """All the faults below are one change away from this one."""
    assert load(save(GOOD)).nv == 1


# -------------------------------------------------------------------- one change that breaks it

LINK_B = f'<link name="b">{INERTIAL}</link>'
BACK = f'<joint name="k" type="revolute"><parent link="b"/><child link="a"/>{LIMIT}</joint>'
AGAIN = f'<joint name="k" type="revolute"><parent link="a"/><child link="b"/>{LIMIT}</joint>'
PLANAR = JOINT.replace("revolute", "planar")

FAULTS = {
    # the tree
    "cycle of all": (changed(JOINT, JOINT + BACK), ["cycle", "a -> b -> a", "one root"]),
    "cycle aside": (
        changed(JOINT, JOINT.replace('"a"', '"c"') + f'<link name="c"/>{BACK.replace(chr(34) + "a", chr(34) + "c")}'),
        ["cycle", "b -> c -> b"],
    ),
    "two roots": (changed(JOINT, ""), ["2 links", "one root", "'a', 'b'"]),
    "two parents": (changed(JOINT, JOINT + AGAIN), ["line 4", "'b'", "two joints", "'j' and 'k'", "tree"]),
    "own parent": (changed('<child link="b"/>', '<child link="a"/>'), ["'j'", "'a'", "both its parent and its child"]),
    "parent unknown": (
        changed('<parent link="a"/>', '<parent link="base_lnk"/>').replace('name="a"', 'name="base_link"'),
        ["line 4", "'j'", "parent", "unknown link 'base_lnk'", "did you mean 'base_link'"],
    ),
    "child unknown": (changed('<child link="b"/>', '<child link="nobody"/>'), ["'j'", "child", "'nobody'"]),
    "no parent element": (changed('<parent link="a"/>', ""), ["'j'", "names no parent link"]),
    "no child attribute": (changed('<child link="b"/>', "<child/>"), ["'j'", "names no child link"]),
    "no link": ('<robot name="r"/>', ["no <link>"]),
    "all in a group": (
        GOOD.replace("</robot>", "</group></robot>").replace('"r">', '"r"><group>'),
        ["<group>", "no <link>"],
    ),
    "a joint of Drake's": (
        GOOD.replace("<joint ", "<drake:joint ").replace("</joint>", "</drake:joint>"),
        ["2 links", "one root", "line 4: <drake:joint name='j'>"],
    ),
    # names
    "duplicate link": (changed(LINK_B, LINK_B + "\n" + LINK_B), ["line 4", "two links", "'b'", "line 3"]),
    "duplicate joint": (changed(JOINT, JOINT + "\n" + JOINT), ["line 5", "two joints", "'j'", "line 4"]),
    "link without name": (changed('<link name="b">', "<link>"), ["line 3", "<link> has no name"]),
    "joint without name": (changed('<joint name="j"', '<joint name=""'), ["line 4", "<joint> has no name"]),
    "link named as the world": (GOOD.replace('"b"', '"universe"'), ["'universe'", "the world"]),
    # the joint
    "unknown type": (changed('"revolute"', '"revolut"'), ["line 4", "'j'", "'revolut'", "continuous, prismatic"]),
    "no type": (changed(' type="revolute"', ""), ["'j'", "type is missing", "expected one of"]),
    "zero axis": (changed(LIMIT, LIMIT + '<axis xyz="0 0 0"/>'), ["'j'", "axis is zero"]),
    "axis without xyz": (changed(LIMIT, LIMIT + "<axis/>"), ["'j'", "<axis> has no xyz"]),
    "axis of two": (changed(LIMIT, LIMIT + '<axis xyz="0 1"/>'), ["'j'", "<axis xyz='0 1'>", "3 numbers, got 2"]),
    "planar without axis": (changed(JOINT, PLANAR), ["'j'", "planar", "0 0 1", "got no <axis>, which means 1 0 0"]),
    "planar with its axis as an attribute": (
        changed(JOINT, PLANAR.replace("<joint ", '<joint axis="0 0 1" ')),
        ["'j'", "got no <axis>", "line 4: attribute 'axis' of <joint>"],
    ),
    "planar, a little across": (changed(JOINT, PLANAR.replace(LIMIT, '<axis xyz="1e-8 0 1"/>')), ["planar", "1e-08"]),
    "planar across": (changed(JOINT, PLANAR.replace(LIMIT, '<axis xyz="0 1 0"/>')), ["planar", "[0.0, 1.0, 0.0]"]),
    "planar upside down": (changed(JOINT, PLANAR.replace(LIMIT, '<axis xyz="0 0 -1"/>')), ["planar", "0 0 1"]),
    "two axes": (changed(LIMIT, LIMIT + 2 * '<axis xyz="0 0 1"/>'), ["'j'", "two <axis>"]),
    "mimic of nobody": (changed(LIMIT, LIMIT + "<mimic/>"), ["'j'", "<mimic> names no joint"]),
    "mimic of itself": (changed(LIMIT, LIMIT + '<mimic joint="j"/>'), ["line 4", "'j'", "the joint itself"]),
    "mimic of a stranger": (
        changed(LIMIT, LIMIT + '<mimic joint="jj"/>'),
        ["line 4", "'j'", "<mimic>", "unknown joint 'jj'", "did you mean 'j'"],
    ),
    # slips of the pen
    "axs": (changed(LIMIT, LIMIT + '<axs xyz="0 0 1"/>'), ["line 4", "joint 'j'", "<axs>", "did you mean <axis>"]),
    "inertal": (GOOD.replace("inertial", "inertal"), ["line 2", "link 'a'", "<inertal>", "did you mean <inertial>"]),
    "orgin": (changed(LIMIT, LIMIT + '<orgin xyz="1 0 0"/>'), ["'j'", "<orgin>", "did you mean <origin>"]),
    "orgin of a mass": (changed("<inertial>", '<inertial><orgin xyz="1 0 0"/>'), ["link 'a'", "<orgin>", "<origin>"]),
    "capitals": (changed(LIMIT, LIMIT + '<Axis xyz="0 0 1"/>'), ["'j'", "<Axis>", "did you mean <axis>"]),
    "xzy": (changed(LIMIT, LIMIT + '<origin xzy="1 0 0"/>'), ["'j'", "attribute 'xzy' of <origin>", "mean 'xyz'"]),
    "ryp": (changed(LIMIT, LIMIT + '<origin ryp="1 0 0"/>'), ["'j'", "attribute 'ryp' of <origin>", "mean 'rpy'"]),
    "uper": (changed('upper="1"', 'uper="1"'), ["'j'", "attribute 'uper' of <limit>", "did you mean 'upper'"]),
    "mimics": (changed(LIMIT, LIMIT + '<mimics joint="k"/>'), ["'j'", "<mimics>", "did you mean <mimic>"]),
    "jiont": (GOOD.replace("joint", "jiont"), ["line 4", "the robot", "<jiont>", "did you mean <joint>"]),
    "inertia in a link": (changed(INERTIAL, INERTIAL[27:-11]), ["line 2", "'a'", "<inertia>", "mean <inertial>"]),
    "quaternion": (changed(LIMIT, LIMIT + '<origin quat_xyzw="0 0 0 1"/>'), ["'j'", "quat_xyzw", "not read", "rpy"]),
    # numbers
    "nan in a limit": (changed('upper="1"', 'upper="nan"'), ["'j'", "<limit upper='nan'>", "not a finite number"]),
    "overflow": (changed('<mass value="1"/>', '<mass value="1e999"/>'), ["'a'", "'1e999' is not a finite number"]),
    "word for a mass": (changed('<mass value="1"/>', '<mass value="heavy"/>'), ["line 2", "'a'", "'heavy'"]),
    "empty mass": (changed('<mass value="1"/>', '<mass value=""/>'), ["'a'", "expected 1 number, got 0"]),
    "decimal comma": (changed('<mass value="1"/>', '<mass value="1,5"/>'), ["'1,5' is not a number"]),
    "grouped digits": (changed('<mass value="1"/>', '<mass value="1_000"/>'), ["'1_000' is not a number"]),
    "arabic digits": (changed('<mass value="1"/>', '<mass value="١"/>'), ["'١' is not a number"]),
    "word in an inertia": (changed('ixy="0"', 'ixy="x"'), ["'a'", "<inertia ixy='x'>"]),
    "nan in an origin": (changed(LIMIT, LIMIT + '<origin xyz="0 nan 0"/>'), ["'j'", "<origin xyz='0 nan 0'>"]),
    "rpy of two": (changed(LIMIT, LIMIT + '<origin rpy="0 0"/>'), ["'j'", "<origin rpy='0 0'>", "got 2"]),
    "xyz of four": (changed("<inertial>", '<inertial><origin xyz="0 0 0 1"/>'), ["'a'", "3 numbers, got 4"]),
    "word for damping": (changed(LIMIT, LIMIT + '<dynamics damping="some"/>'), ["'j'", "<dynamics damping='some'>"]),
    "nan in a mimic": (changed(LIMIT, LIMIT + '<mimic joint="k" offset="nan"/>'), ["'j'", "<mimic offset='nan'>"]),
    "macro for a number": (changed('<mass value="1"/>', '<mass value="${m}"/>'), ["'${m}'", "xacro"]),
    # inertias
    "negative mass": (changed('<mass value="1"/>', '<mass value="-1"/>'), ["line 2", "'a'", "mass is -1"]),
    "no mass": (changed('<mass value="1"/>', ""), ["'a'", "incomplete", "<mass> missing"]),
    "no mass value": (changed('<mass value="1"/>', "<mass/>"), ["'a'", "incomplete", "mass value missing"]),
    "inertia in part": (changed(' iyy="1" izz="1"', ""), ["'a'", "incomplete", "iyy, izz missing"]),
    "nothing in it": (changed(INERTIAL, "<inertial/>"), ["'a'", "<mass> missing", "leave out"]),
    "two inertials": (changed(INERTIAL, 2 * INERTIAL), ["'a'", "two <inertial>"]),
    # the file
    "empty": ("", ["robot.urdf", "the file is empty"]),
    "blank": (" \n\t ", ["the file is empty"]),
    "unclosed": (GOOD.removesuffix("</robot>"), ["line 5", "not well-formed XML"]),
    "cut in a tag": (GOOD[: GOOD.index("velocity")], ["not well-formed XML"]),
    "text": ("a robot", ["line 1", "not well-formed XML"]),
    "binary": (bytes(range(256)), ["not well-formed XML"]),
    "wrong encoding": (GOOD.replace("r", "ü", 1).encode("latin-1"), ["not well-formed XML", "save the file as UTF-8"]),
    "chinese": (GOOD.replace('"r"', '"机器人"').encode("gb18030"), ["line 1", "save the file as UTF-8"]),
    "unknown encoding": ('<?xml version="1.0" encoding="martian"?>' + GOOD, ["not well-formed XML", "ncoding"]),
    "bytes not of the encoding": ('<robot name="é"/>'.encode("latin-1"), ["line 1", "not well-formed XML"]),
    "entity of nobody": (changed('"1"', '"&one;"'), ["line 2", "not well-formed XML", "one"]),
    "two elements": (GOOD + GOOD, ["not well-formed XML"]),
    "another root": ("<gadget/>", ["root element is <gadget>", "expected <robot>"]),
    "sdf": ('<sdf version="1.7"/>', ["<sdf>", "SDF"]),
    "mjcf": ("<mujoco/>", ["<mujoco>", "MJCF"]),
    "xacro": (
        GOOD.replace('name="r">', 'xmlns:xacro="http://ros.org/wiki/xacro" name="r"><xacro:macro name="leg"/>'),
        ["line 1", "xacro macros", "expand"],
    ),
    "undeclared xacro": (changed(JOINT, "<xacro:leg/>" + JOINT), ["line 4", "xacro macros", "expand"]),
    "xacro in a link": (changed(INERTIAL, f"<xacro:box/>{INERTIAL}"), ["line 2", "xacro macros"]),
    "not only a prefix": (changed(JOINT, "<drake:a/><a></b>" + JOINT), ["not well-formed XML"]),
    "git lfs": (
        "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n",
        ["Git LFS pointer", "git lfs pull"],
    ),
    "nine entries that contradict": (
        changed('ixy="0"', 'ixy="0" iyx="0.1" izx="0" izy="0"'),
        ["line 2", "'a'", "iyx = 0.1 contradicts ixy = 0", "symmetric"],
    ),
    "half below the diagonal": (changed('ixy="0"', 'iyx="0"'), ["'a'", "incomplete", "ixy missing"]),
    "negative moment without mass": (
        changed('<link name="b">', '<link name="b"><!-- b -->').replace(
            f"<!-- b -->{INERTIAL}",
            INERTIAL.replace('<mass value="1"', '<mass value="0"').replace('ixx="1"', 'ixx="-1"'),
        ),
        ["'b'", "positive definite", "-1, 1, 1"],
    ),
    "infinite origin": (changed(LIMIT, LIMIT + '<origin xyz="0 inf 0"/>'), ["'j'", "not a finite number"]),
    # doors to elsewhere
    "document type": ('<!DOCTYPE robot SYSTEM "http://nowhere.invalid/r.dtd">' + GOOD, ["DOCTYPE", "remove"]),
    "entity": ('<!DOCTYPE robot [<!ENTITY m "1">]>' + GOOD.replace('"1"', '"&m;"'), ["DOCTYPE", "entities"]),
    "external entity": ('<!DOCTYPE r [<!ENTITY e SYSTEM "file:///etc/passwd">]><robot>&e;</robot>', ["DOCTYPE"]),
    "hidden document type": (
        '<?xml version="1.0" encoding="UTF-16"?><!DOCTYPE robot [<!ENTITY m "1">]><robot name="r"/>'.encode("utf-16"),
        ["DOCTYPE"],
    ),
}


@pytest.mark.parametrize(("text", "words"), FAULTS.values(), ids=FAULTS.keys())
def test_fault_is_named(save, text, words):
    path = save(text)
    refuse(path, str(path), *words)


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_faults_do_not_depend_on_the_base(save, base):
    for text, words in FAULTS.values():
        refuse(save(text), *words, base=base)


def test_what_drivers_and_simulators_add_is_passed_over(save):
    extras = '<hardwareInterface/><safety_controller/><dynamics damping="1"/><role/><s:axs xmlns:s="urn:sim"/>'
    limit = LIMIT.replace("<limit", '<limit gear_velocity="9" command_effort="9"')
    assert load(save(changed(LIMIT, limit + extras).replace("</robot>", "<gazebo/><sensor/></robot>"))).nv == 1


@pytest.mark.parametrize("leader", ["j", "nobody"])
def test_whom_a_joint_should_follow_is_nothing_to_one_that_moves_on_its_own(save, leader):
    path = save(changed(LIMIT, LIMIT + f'<mimic joint="{leader}"/>'))
    refuse(path, "'j'", "<mimic>", "mimic='independent' loads it")
    assert load(path, mimic="independent").nv == 1


def test_the_place_of_a_fault_in_the_xml_is_said_once(save):
    message = refuse(save(changed('<parent link="a"/>', "<parent link=a/>")), "line 4, column ", "not well-formed XML")
    assert message.count("column") == message.count("line 4") == 1


# -------------------------------------------------------------------- bodies that cannot exist


def unphysical(**moments):
    """Two faulty links that move, so that one message must name both."""
    text = GOOD.replace('<link name="a">', '<link name="root"/><link name="a">')
    text = text.replace(JOINT, JOINT + JOINT.replace('"a"', '"root"').replace('"b"', '"a"').replace('"j"', '"i"'))
    for name, value in moments.items():
        text = re.sub(f'{name}="[^"]*"', f'{name}="{value}"', text)
    return text


def test_all_bodies_that_cannot_exist_are_named_in_one_message(save):
    path = save(unphysical(izz=10))
    words = ["2 moving bodies", "'a'", "'b'", "triangle inequality", "1, 1, 10 kg m², 8 too much", "physical=False"]
    message = refuse(path, *words, physical=True)
    assert message.count("triangle inequality") == 2


def test_a_body_that_cannot_exist_and_can_be_computed_is_loaded_with_one_warning(save):
    """A plate whose digits CAD rounded: 1e-6 + 1e-6 < 2.000001e-6. The excess is 1e-12 kg m²."""
    path = save(unphysical(ixx=1e-6, iyy=1e-6, izz=2.000001e-6))
    with pytest.warns(UserWarning, match=r"(?s)'a'.*1e-12 too much.*'b'.*1e-12 too much") as caught:
        model = load(path)
    assert len(caught) == 1
    assert [entry.where for entry in model.report.warnings] == ["link 'a'", "link 'b'"]
    assert np.linalg.eigvalsh(tw.crba(model, [0.1, 0.2])).min() > 0
    np.testing.assert_array_equal(tw.crba(model, [0.1, 0.2]), tw.crba(load(path, physical=False), [0.1, 0.2]))
    refuse(path, "1e-12 too much", strict=True)
    refuse(path, "1e-12 too much", physical=True)
    assert load(path, physical=False, strict=True).report.warnings == ()


def test_one_body_that_makes_m_indefinite_is_refused_and_the_others_are_not_named(save):
    text = unphysical(izz=10)
    head, mark, tail = text.partition('<link name="b">')
    refuse(save(head + mark + tail.replace('ixx="1"', 'ixx="-1"', 1)), "1 moving body", "link 'b'", "positive definite")


def test_what_rounding_leaves_of_no_inertia_is_none(save):
    """As in iCub's file: 0.5 kg, 3 cm away, and -5e-20 kg m², which rounding of m c² hides."""
    text = unphysical(ixx=-5.4e-20, iyy=0, izz=0).replace("<inertial>", '<inertial><origin xyz="0 0 0.03"/>')
    assert load(save(text), strict=True).nv == 2
    refuse(save(text.replace("-5.4e-20", "-5.4e-17")), "positive definite")


def test_inertia_that_is_not_positive_definite_is_refused(save):
    refuse(save(unphysical(ixx=-1)), "positive definite", "-1, 1, 1")
    refuse(save(unphysical(ixy=5)), "positive definite", "-4, 1, 6")


def test_what_is_welded_to_a_faulty_link_is_named_with_it(save):
    weld = '<joint name="w" type="fixed"><parent link="b"/><child link="c"/></joint>'
    text = unphysical(izz=10).replace(JOINT, JOINT + weld + f'<link name="c">{INERTIAL}</link>')
    assert "link 'b'" in refuse(save(text), "(with 'c' welded to it)", physical=True)


@pytest.mark.parametrize("moments", [{"izz": 10}, {"ixx": -1}])
def test_physical_false_loads_them_all_the_same(save, moments):
    assert load(save(unphysical(**moments)), physical=False).mass == 2


def test_what_never_moves_need_not_exist(save):
    path = save(changed('izz="1"', 'izz="10"'))  # only link a, the root
    assert load(path, base="fixed").nv == 1
    refuse(path, "'a'", "triangle inequality", base="floating", physical=True)


def test_welded_links_are_judged_by_their_sum(save):
    """A point welded to a ball is no point: many a real file has one (a camera, a force sensor)."""
    point = INERTIAL.replace('"1"', '"0"').replace('<mass value="0"', '<mass value="1"')
    weld = '<joint name="w" type="fixed"><parent link="b"/><child link="c"/><origin xyz="1 0 0"/></joint>'
    assert load(save(changed(JOINT, JOINT + weld + f'<link name="c">{point}</link>'))).mass == 2


@pytest.mark.parametrize("text", ['value="1"', 'ixx="1"', 'izz="1"'])
@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_numbers_that_overflow_are_refused(save, text, base):
    """Each is a finite number; their sums or products are not."""
    key = text.split("=")[0]
    weld = JOINT.replace("revolute", "fixed").replace(LIMIT, '<origin xyz="1e200 0 0"/>')
    move = f'<joint name="k" type="revolute"><parent link="c"/><child link="a"/>{LIMIT}</joint><link name="c"/>'
    path = save(changed(JOINT, weld + move).replace(text, f'{key}="1.7e308"'))
    refuse(path, str(path), "overflow", base=base)


@pytest.mark.parametrize(("end", "named"), [("b", "joint 'j'"), ("a", "frame 'x'")])
def test_a_way_that_overflows_is_refused(save, end, named):
    far = '<origin xyz="1.7e308 0 0"/>'
    weld = f'<joint name="w" type="fixed"><parent link="{end}"/><child link="c"/>{far}</joint><link name="c"/>'
    on = weld.replace('"c"', '"d"').replace(f'"{end}"', '"c"').replace('"w"', '"x"')
    refuse(save(changed(JOINT, JOINT + weld + on)), named, "overflow")


# -------------------------------------------------------------------- files that are none


def test_missing_file_is_named(tmp_path):
    for source in (tmp_path / "robot.urdf", str(tmp_path / "robot.urdf")):
        refuse(source, str(tmp_path / "robot.urdf"), "no such file")
    refuse("robot_that_is_not_here.urdf", "robot_that_is_not_here.urdf", "no such file")
    refuse(Path("go2"), "go2", "no such file")  # a Path is a path, never a name


def test_a_null_character_is_in_no_path():
    refuse("a\0b.urdf", r"'a\x00b.urdf'", "null character")
    refuse(Path("a\0b"), r"'a\x00b'", "null character")


@pytest.mark.parametrize("address", ["package://go2_description/go2.urdf", "https://nowhere.invalid/robot.urdf"])
def test_an_address_is_no_path(address):
    refuse(address, address, "the path of a file", address.partition("//")[0])


def test_bytes_are_to_be_decoded():
    with pytest.raises(TypeError, match=r"source: expected a name, a path or the text of a URDF, got bytes.*decode"):
        load(GOOD.encode())


def test_directory_is_no_file(tmp_path, monkeypatch):
    refuse(tmp_path, str(tmp_path), "is a directory")
    (tmp_path / "folder").mkdir()
    monkeypatch.chdir(tmp_path)
    refuse("folder", "folder", "is a directory")


def test_a_file_needs_no_ending_and_a_robots_name_is_not_a_file(save, tmp_path, monkeypatch):
    save(GOOD).rename(tmp_path / "machine")
    (tmp_path / "pendulum").mkdir()
    monkeypatch.chdir(tmp_path)
    assert load("machine").nv == 1
    assert load("pendulum").name == "pendulum"


def test_a_path_that_ends_as_a_robot_says_how_to_load_the_robot(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refuse("./go2", "./go2: no such file", "'go2' without a folder is a robot of the catalogue")
    refuse("./go3", "no such file")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "robot.urdf")
    refuse(tmp_path / "robot.urdf", "not a regular file")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may read every file")
def test_unreadable_file_is_named(save):
    path = save(GOOD)
    path.chmod(0)
    refuse(path, str(path), "cannot be read")


def test_name_too_long_for_the_system_is_an_error_of_ours():
    refuse("x" * 5000 + ".urdf", "cannot be read")


def test_base_is_one_of_two(save):
    refuse(save(GOOD), "base", "'flying'", "'fixed' or 'floating'", base="flying")


def test_a_comment_may_speak_of_a_doctype(save):
    assert load(save(changed(JOINT, "<!-- no <!DOCTYPE here -->" + JOINT))).nv == 1


# -------------------------------------------------------------------- attacks, and how long they take


def test_ten_megabytes_of_nesting_are_refused_at_once(save):
    depth = 10_000_000 // len("<link></link>")
    path = save('<robot name="r">' + "<link>" * depth + "</link>" * depth + "</robot>")
    start = time.perf_counter()
    refuse(path, "nested deeper")
    assert time.perf_counter() - start < 2


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_an_entity_bomb_is_refused_at_once(save, encoding):
    laughs = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 12))
    bomb = f'<?xml version="1.0" encoding="{encoding}"?><!DOCTYPE robot [<!ENTITY l0 "ha">{laughs}]>'
    start = time.perf_counter()
    refuse(save((bomb + '<robot name="&l11;"><link name="&l11;"/>&l11;</robot>').encode(encoding)), "DOCTYPE")
    assert time.perf_counter() - start < 2


def test_many_links_without_a_joint_make_a_short_message(save):
    links = "".join(f'<link name="l{i}"/>' for i in range(2_000))
    assert len(refuse(save(f'<robot name="r">{links}</robot>'), "2000 links", "...")) < 500


def test_a_long_cycle_is_found(save):
    n = 2000
    links = "".join(f'<link name="l{i}"/>' for i in range(n))
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="l{i}"/><child link="l{(i + 1) % n}"/></joint>' for i in range(n)
    )
    assert len(refuse(save(f'<robot name="r">{links}{joints}</robot>'), "cycle", "l0", "...")) < 500

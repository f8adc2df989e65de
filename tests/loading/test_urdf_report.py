"""What has one meaning is read, and reported; strict=True refuses it: every case on its own, and against Pinocchio."""

import pickle
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw

from .test_urdf_bad import GOOD, INERTIAL, JOINT, LIMIT, changed, refuse

ROOT_INERTIAL = '<link name="root"/>' + JOINT.replace('"j"', '"i"').replace('"b"', '"a"').replace('"a"', '"root"', 1)
"""A root without inertia, below the two links of the good file: both of them move then."""


def both_move(old, new):
    """Return the good file with both links moving, changed in link b."""
    head, mark, tail = GOOD.replace("</robot>", ROOT_INERTIAL + "</robot>").partition('<link name="b">')
    assert old in tail
    return head + mark + tail.replace(old, new, 1)


ALL_NINE = 'ixy="0.1" iyx="0.1" ixz="0" izx="0" iyz="0" izy="0"'
NO_MOMENTS = '<inertia ixx="0" iyy="0" izz="0"'

CASES = {
    "xml 0.0": ('<?xml version="0.0" ?>' + GOOD, ["line 1", "XML version '0.0'", "XML 1.0"]),
    "blank line first": ("\n\n<?xml version='1.0'?>\n" + GOOD, ["blanks before the XML declaration"]),
    "mark and blank line": ("\ufeff\n<?xml version='1.0' encoding='utf-8'?>" + GOOD, ["blanks before"]),
    "prefix of an element": (changed(LIMIT, LIMIT + "\n<drake:acceleration value='1'/>"), ["line 5", "prefix drake"]),
    "prefix of an attribute": (changed("<limit ", "<limit drake:acceleration='1' "), ["line 4", "prefix drake"]),
    "two prefixes": (changed(JOINT, "<sensor:a/><drake:b/><drake:c/>" + JOINT), ["prefix sensor", "prefix drake"]),
    "xacro in a visual": (changed(INERTIAL, INERTIAL + "<visual><xacro:grey/></visual>"), ["<xacro:grey>", "line 2"]),
    "declared xacro": (
        changed('name="r">', 'name="r" xmlns:xacro="http://ros.org/wiki/xacro"><gazebo><xacro:p/></gazebo>'),
        ["<xacro:p>", "no dynamics"],
    ),
    "xacro of a sensor": (changed(JOINT, "<xacro:imu_sensor/>" + JOINT), ["<xacro:imu_sensor>"]),
    "RefLink": (changed(JOINT, "<RefLink>a</RefLink>" + JOINT), ["line 4", "<RefLink>", "not URDF"]),
    "nine entries": (changed('ixy="0" ixz="0" iyz="0"', ALL_NINE), ["iyx, izx, izy", "the same matrix"]),
    "no limit": (changed(LIMIT, ""), ["line 4", "joint 'j'", "no <limit>", "no limits"]),
    "no limit, prismatic": (changed(LIMIT, "").replace("revolute", "prismatic"), ["no <limit>", "no limits"]),
    "no effort": (changed(' effort="1"', ""), ["no effort limit", "no limit of it"]),
    "no velocity": (changed(' velocity="1"', ""), ["no velocity limit"]),
    "negative effort": (changed('effort="1"', 'effort="-1"'), ["effort limit -1", "no limit of it"]),
    "limits crossed": (
        changed('lower="-1"', 'lower="2"'),
        ["lower limit 2 above upper limit 1", "no end of its range"],
    ),
    "lower above the default": (changed('lower="-1" upper="1"', 'lower="1"'), ["lower limit 1 above upper limit 0"]),
    "no room": (changed('lower="-1" upper="1"', 'lower="inf" upper="inf"'), ["lower limit inf"]),
    "neither end": (changed('lower="-1" upper="1" ', ""), ["neither lower nor upper", "no end of its range"]),
    "ends of another format": (
        changed('lower="-1" upper="1"', 'min="-1" max="1"'),
        ["neither lower", "(but max, min)"],
    ),
    "ends of a wheel": (
        changed("revolute", "continuous"),
        ["lower limit -1, upper limit 1", "continuous joint has none"],
    ),
    "negative damping": (changed(LIMIT, LIMIT + '<dynamics damping="-1"/>'), ["damping -1", "none"]),
    "no mass": (both_move('<mass value="1"/>', '<mass value="0"/>'), ["link 'b'", "an inertia without a mass"]),
    "no inertia": (both_move(INERTIAL, '<inertial><mass value="2"/></inertial>'), ["line 3", "no <inertia>", "point"]),
    "millimetres": (
        both_move('ixx="1" iyy="1" izz="1"', 'ixx="5e4" iyy="5e4" izz="5e4"'),
        ["link 'b'", "a radius of gyration of 224 m", "in metres and kg m²"],
    ),
    "millimetres of a joint": (changed(LIMIT, LIMIT + '<origin xyz="300 0 400"/>'), ["<origin> 500 m away"]),
    "placed by its joint": (changed("<joint ", '<joint xyz="0 0 1" '), ["line 4", "attribute 'xyz' of <joint>"]),
    "limits of a joint": (changed("<joint ", '<joint lower="1" '), ["attribute 'lower' of <joint>"]),
    "placed by its link": (changed("<link ", '<link xyz="0 0 1" '), ["line 2", "attribute 'xyz' of <link>"]),
    "mass of an inertial": (changed("<inertial>", '<inertial mass="3">'), ["attribute 'mass' of <inertial>"]),
    "com": (changed("<inertial>", '<inertial><com xyz="0 0 1"/>'), ["line 2", "<com> in <inertial>"]),
    "pose of a joint": (changed(LIMIT, LIMIT + "<pose>0 0 1 0 0 0</pose>"), ["<pose> in <joint>"]),
    "pose of a link": (changed(INERTIAL, INERTIAL + "<pose>0 0 1 0 0 0</pose>"), ["<pose> in <link>"]),
    "damping as an element": (changed(LIMIT, LIMIT + "<damping>3</damping>"), ["line 4", "<damping> in <joint>"]),
    "damping of another format": (
        changed(LIMIT, LIMIT + '<joint_properties damping="3"/>'),
        ["<joint_properties> in <joint>"],
    ),
    "spring": (changed(LIMIT, LIMIT + '<dynamics spring_stiffness="4"/>'), ["'spring_stiffness' of <dynamics>"]),
    "include": (changed(JOINT, '<include filename="arm.urdf"/>' + JOINT), ["<include>", "left out"]),
    "group": (changed(JOINT, '<group><link name="c"/></group>' + JOINT), ["line 4", "<group>", "left out"]),
    "a closed loop": (
        changed(JOINT, '<loop_joint name="l"><link1 link="a"/><axis xyz="1 0 0"/></loop_joint>' + JOINT),
        ["line 4", "<loop_joint name='l'>", "left out"],
    ),
    "a link of another namespace": (
        changed('name="r">', 'name="r" xmlns:u="urn:u"><u:link name="c"/>'),
        ["line 1", "<u:link name='c'>", "left out"],
    ),
    "a point": (both_move('<inertia ixx="1" iyy="1" izz="1"', NO_MOMENTS), ["link 'b'", "a point mass"]),
}


@pytest.fixture
def save(tmp_path):
    def saved(text):
        path = tmp_path / "robot.urdf"
        path.write_text(text, encoding="utf-8")
        return path

    return saved


def load_warned(path, **options):
    with pytest.warns(UserWarning, match="not all is as it should be") as caught:
        model = tw.load(path, **options)
    assert len(caught) == 1
    assert Path(caught[0].filename) == Path(__file__)
    return model, str(caught[0].message)


@pytest.mark.parametrize(("text", "words"), CASES.values(), ids=CASES.keys())
@pytest.mark.parametrize("physical", [True, False])
def test_what_has_one_meaning_is_read_warned_of_and_refused_by_strict(save, text, words, physical):
    path = save(text)
    model, message = load_warned(path, physical=physical)
    assert model.nv == 1 + ("root" in text)
    for word in words:
        assert word in message
    refuse(path, str(path), "strict=True", *words, physical=physical, strict=True)
    assert model.report == model.report.warnings != ()
    assert repr(model.report).startswith("line  where")
    assert pickle.loads(pickle.dumps(model)).report == model.report


def test_what_was_read_another_way_is_what_was_meant(save):
    good = tw.load(save(GOOD))
    for name in ("xml 0.0", "blank line first", "two prefixes", "xacro in a visual", "RefLink", "no limit"):
        model, _ = load_warned(save(CASES[name][0]))
        assert tw.crba(model, [0.3]) == tw.crba(good, [0.3])
    assert good.report == ()
    assert repr(good.report) == "nothing to report"


def test_lines_keep_their_numbers_behind_blank_ones(save):
    text = "\n\n<?xml version='0.1'?>\n" + GOOD.replace('value="1"', 'value="x"')
    refuse(save(text), "line 5", "'x' is not a number")


def test_a_version_is_put_right_in_any_encoding_that_python_knows(save):
    model, _ = load_warned(save('<?xml version="0.0" encoding="UTF-8" standalone="yes"?>' + GOOD.replace('"b"', '"ß"')))
    assert "ß" in model.frame_names


def test_no_limits_are_infinite_ones(save):
    model, _ = load_warned(save(CASES["no limit"][0]))
    limits = (model.lower, model.upper, model.velocity_limit, model.effort_limit)
    assert [x.tolist() for x in limits] == [[-np.inf], [np.inf], [np.inf], [np.inf]]
    model, _ = load_warned(save(CASES["limits crossed"][0]))
    limits = (model.lower, model.upper, model.velocity_limit, model.effort_limit)
    assert [x.tolist() for x in limits] == [[-np.inf], [np.inf], [1], [1]]


def test_infinite_limits_are_read_as_written(save):
    path = save(changed(LIMIT, '<limit lower="-inf" upper="inf" effort="INF" velocity="infinity"/>'))
    model = tw.load(path, strict=True)
    assert [model.lower[0], model.upper[0], model.effort_limit[0]] == [-np.inf, np.inf, np.inf]


@pytest.mark.parametrize("ends", ['lower="0" upper="0"', 'lower="-inf" upper="inf"', ""])
def test_ends_that_are_none_are_nothing_to_a_wheel(save, ends):
    text = changed('lower="-1" upper="1"', ends).replace("revolute", "continuous")
    assert tw.load(save(text), strict=True).report == ()


@pytest.mark.parametrize(
    ("ends", "read"),
    [
        ('lower="0" upper="0"', ([0], [0], "given: the joint cannot move")),
        ('upper="2"', ([0], [2], "0, as the format says")),
    ],
)
def test_a_range_as_the_format_has_it_is_noted_without_a_warning(save, ends, read):
    model = tw.load(save(changed('lower="-1" upper="1"', ends)), strict=True)
    assert (model.lower.tolist(), model.upper.tolist(), model.report[0].read_as) == read


def test_a_joint_without_ends_is_not_locked(save):
    model, _ = load_warned(save(CASES["neither end"][0]))
    assert (model.lower[0], model.upper[0]) == (-np.inf, np.inf)
    assert abs(model.random_configuration(rng=0)[0]) > 0.01


DRAKE = """<transmission name="t"><joint name="j"/><actuator name="m">
<drake:rotor_inertia value="0.0001321"/><drake:gear_ratio value="160"/></actuator></transmission>"""


@pytest.mark.parametrize("space", ["", ' xmlns:drake="http://drake.mit.edu"'], ids=["undeclared", "declared"])
def test_a_rotor_of_drakes_is_armature(save, space):
    """iiwa's first motor: 1.321e-4 kg m² behind a gear of 160 weigh 160² × 1.321e-4 = 3.38176 kg m² at the joint."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        good, model = (
            tw.load(save(GOOD)),
            tw.load(save(GOOD.replace('"r"', '"r"' + space).replace(JOINT, JOINT + DRAKE))),
        )
    np.testing.assert_allclose(tw.crba(model, [0.3]) - tw.crba(good, [0.3]), [[3.38176]], rtol=1e-15)
    assert [(entry.where, entry.warns) for entry in model.report if "a rotor" in entry.found] == [("joint 'j'", False)]


def test_two_rotors_on_a_joint_add_up(save):
    model, _ = load_warned(save(changed(JOINT, JOINT + DRAKE + DRAKE.replace('"t"', '"u"'))))
    assert model.armature[0] == pytest.approx(2 * 3.38176, rel=1e-15)


@pytest.mark.parametrize(
    "transmission",
    [
        DRAKE.replace('<joint name="j"/>', '<joint name="nobody"/>'),
        DRAKE.replace('<joint name="j"/>', '<joint name="j"/><joint name="k"/>'),
        DRAKE.replace("drake:", ""),
    ],
    ids=["of nobody", "of two joints", "of no prefix"],
)
def test_a_rotor_that_cannot_be_read_is_reported(save, transmission):
    model, message = load_warned(save(changed(JOINT, JOINT + transmission)))
    assert model.armature[0] == 0
    assert "left out" in message
    refuse(save(changed(JOINT, JOINT + DRAKE.replace("0.0001321", "-1"))), "joint 'j'", "rotor_inertia is -1")


def test_errors_about_rotors_name_what_stands_in_the_file(save):
    space = GOOD.replace('"r"', '"r" xmlns:drake="http://drake.mit.edu"')
    unread = space.replace(JOINT, JOINT + DRAKE.replace("0.0001321", "much"))
    refuse(save(unread), "joint 'j'", "<drake:rotor_inertia value='much'>")
    nobody = DRAKE.replace('<joint name="j"/>', "").replace(' name="t"', "")
    _, message = load_warned(save(space.replace(JOINT, JOINT + nobody)))
    assert "<transmission> of 0 joints" in message


@pytest.mark.parametrize("place", ["<joint ", "<limit "])
def test_an_armature_where_none_is_read_is_reported(save, place):
    model, message = load_warned(save(changed(place, place + 'armature="0.2" ')))
    assert model.armature[0] == 0
    assert f"attribute 'armature' of {place.strip()}>" in message


def test_a_gear_alone_weighs_nothing_and_is_noted(save):
    gear = DRAKE.replace("drake:rotor_inertia", "x").replace("drake:gear_ratio", "y")
    gear = gear.replace("</actuator>", "<mechanicalReduction>50</mechanicalReduction></actuator>")
    model = tw.load(save(changed(JOINT, JOINT + gear)), strict=True)
    assert [(entry.found, entry.warns) for entry in model.report] == [("a gear of 50", False)]


@pytest.mark.parametrize(
    "transmission",
    [
        '<transmission name="t"><joint name="j"/><actuator name="m"/>{}</transmission>',
        '<transmission name="t"><joint name="j">{}</joint><actuator name="m"/></transmission>',
        '<ros2_control name="c"><transmission name="t"><joint name="j">{}</joint></transmission></ros2_control>',
    ],
    ids=["of PR2", "of the joint", "of ros2_control"],
)
@pytest.mark.parametrize("name", ["mechanicalReduction", "mechanical_reduction"])
def test_a_gear_is_noted_wherever_it_may_stand(save, transmission, name):
    text = transmission.format(f"<{name}>50</{name}>")
    model = tw.load(save(changed(JOINT, JOINT + text)), strict=True)
    assert [(entry.where, entry.found) for entry in model.report] == [("joint 'j'", "a gear of 50")]


def test_a_planar_axis_may_hold_what_cad_leaves_of_zero(save):
    planar = JOINT.replace("revolute", "planar").replace(LIMIT, '<axis xyz="1e-17 -1e-12 1"/>')
    assert tw.load(save(changed(JOINT, planar)), strict=True).nv == 3


def test_a_mass_without_an_inertia_is_a_point(save):
    """M of a point on a rod is m l² about the joint: 2 kg at 1 m and 0.5 m along two axes."""
    point = '<inertial><origin xyz="0 1 0.5"/><mass value="2"/></inertial>'
    model, message = load_warned(save(both_move(INERTIAL, point)))
    assert message.count("'b'") == 1  # once, with its line
    np.testing.assert_allclose(tw.crba(model, [0.0, 0.0])[1, 1], 2 * (1 + 0.25), rtol=1e-15)


def test_all_nine_entries_give_the_matrix(save):
    moves = changed('ixy="0" ixz="0" iyz="0"', 'ixy="0.1" iyx="0.1" ixz="0.2" izx="0.2" iyz="0.3" izy="0.3"')
    model, _ = load_warned(save(moves), base="floating")
    expected = [[1, 0.1, 0.2], [0.1, 1, 0.3], [0.2, 0.3, 1]]
    np.testing.assert_array_equal(model.inertia[1].inertia_at_com, expected)


def test_one_warning_lists_everything_by_how_it_was_read(save):
    many = "".join(
        JOINT.replace('"j"', f'"j{i}"').replace('"b"', f'"b{i}"').replace(LIMIT, "")
        + f'<link name="b{i}">{INERTIAL}</link>'
        for i in range(9)
    )
    model, message = load_warned(save('<?xml version="0.0"?>' + GOOD.replace("</robot>", many + "</robot>")))
    assert message.count("\n") == 2
    assert "joint 'j0' (line 5: no <limit>), " in message
    assert " and 5 more: read as no limits" in message
    assert len(model.report) == 10


def test_a_joint_of_the_file_may_be_called_root_joint(save):
    path = save(GOOD.replace('"j"', '"root_joint"'))
    assert tw.load(path, strict=True).joint_names == ("universe", "root_joint")
    model, message = load_warned(path, base="floating")
    assert model.joint_names == ("universe", "root_joint_", "root_joint")
    assert "the base's is 'root_joint_'" in message
    refuse(path, "'root_joint'", base="floating", strict=True)


def test_a_floating_base_without_mass_on_one_joint_is_told_to_be_singular(save):
    path = save(GOOD.replace(INERTIAL, "", 1))
    assert tw.load(path, strict=True).nv == 1
    model, message = load_warned(path, base="floating")
    assert "link 'a' (floats without mass, and carries the joint 'j' alone): read as given: M is singular" in message
    with pytest.raises(tw.SingularError):
        tw.aba(model, model.neutral(), np.zeros(7), np.zeros(7))


def test_damping_and_friction_are_kept_reported_and_no_warning(save):
    path = save(changed(LIMIT, LIMIT + '<dynamics damping="0.5" friction="0.25"/>'))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model = tw.load(path, strict=True, base="floating")
    assert model.damping.tolist() == [0] * 6 + [0.5]
    assert model.friction.tolist() == [0] * 6 + [0.25]
    assert [(entry.where, entry.found) for entry in model.report] == [
        ("joint 'j'", "damping 0.5"),
        ("joint 'j'", "friction 0.25"),
    ]
    assert tw.lock_joints(model, ["root_joint"], model.neutral()).model.damping.tolist() == [0.5]
    assert tw.Scene(model, base="planar").model.damping.tolist() == [0, 0, 0, 0.5]
    assert tw.load(save(changed(LIMIT, LIMIT + '<dynamics damping="0"/>'))).report == ()


def test_damping_takes_the_energy_that_it_should(save):
    """q'' = −(d/I) q' about a principal axis through the centre of mass: q' = exp(−d t / I)."""
    path = save(changed(LIMIT, LIMIT + '<dynamics damping="0.5"/>'))
    model = tw.load(path, gravity=(0, 0, 0))
    run = tw.simulate(model, [0.0], [1.0], dt=0.01, duration=1.0, tau=lambda t, q, v: -model.damping * v, method="rk4")
    assert run.v[-1, 0] == pytest.approx(np.exp(-0.5), rel=1e-9)


# -------------------------------------------------------------------- robots of the textbooks


PUMA_1 = '<inertial><mass value="0"/><inertia ixx="0" iyy="0.35" izz="0" ixy="0" ixz="0" iyz="0"/></inertial>'


# Corke and Armstrong's first two links: the first has I = diag(0, 0.35, 0) kg m² and no mass.
PUMA = f"""<robot name="puma560"><link name="base"/><link name="l1">{PUMA_1}</link><link name="l2"><inertial>
    <origin xyz="-0.3638 0.006 0.2275"/><mass value="17.4"/>
    <inertia ixx="0.13" iyy="0.524" izz="0.539" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="j1" type="revolute"><parent link="base"/><child link="l1"/><origin rpy="-1.5707963267948966 0 0"/>
    <axis xyz="0 -1 0"/>{LIMIT}</joint><joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/>
    <axis xyz="0 0 1"/>{LIMIT}</joint></robot>"""


def test_the_first_link_of_the_puma_560_loads_as_published(save):
    model, message = load_warned(save(PUMA))
    assert "link 'l1' (an inertia without a mass): read as the inertia as given, with no weight" in message
    nothing = tw.SpatialInertia(0, [0, 0, 0], np.zeros((3, 3)))
    without = replace(model, inertia=(model.inertia[0], nothing, model.inertia[2]))
    q = [0.2, -0.4]
    np.testing.assert_allclose(tw.crba(model, q), tw.crba(without, q) + np.diag([0.35, 0]), rtol=0, atol=1e-15)


def test_what_loads_equals_pinocchio(save):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    rng = np.random.default_rng(0)
    rod = '<inertial><origin xyz="0 1 0.5"/>'
    point = CASES["a point"][0].replace("<inertial>", rod)
    bare = CASES["no inertia"][0].replace("<inertial>", rod)
    for text in (PUMA, point, bare, CASES["nine entries"][0], CASES["lower above the default"][0]):
        path = save(text)
        model, _ = load_warned(path)
        theirs = pin.buildModelFromUrdf(str(path))
        data, q, v, a = theirs.createData(), *rng.standard_normal((3, model.nv))
        tau = pin.rnea(theirs, data, q, v, a)
        np.testing.assert_allclose(tw.rnea(model, q, v, a), tau, rtol=1e-13, atol=1e-13)
        np.testing.assert_allclose(tw.crba(model, q), pin.crba(theirs, data, q), rtol=1e-13, atol=1e-14)
        np.testing.assert_allclose(tw.aba(model, q, v, tau), a, rtol=1e-12, atol=1e-12)


def test_point_masses_on_rods_are_the_textbooks_double_pendulum():
    builder = tw.Builder("double pendulum of points")
    for name, parent, z in (("upper", "base_link", 0.0), ("lower", "upper", -1.0)):
        bob = tw.SpatialInertia(1.0, [0, 0, -1], np.zeros((3, 3)))
        builder.link(name, parent=parent, joint=tw.Revolute("y"), placement=tw.SE3(np.eye(3), [0, 0, z]), inertia=bob)
    model, q2 = builder.build(), 0.7
    assert [(e.where, e.read_as) for e in model.report] == [
        ("link 'upper'", "a point mass"),
        ("link 'lower'", "a point mass"),
    ]
    c = np.cos(q2)
    np.testing.assert_allclose(tw.crba(model, [0.2, q2]), [[3 + 2 * c, 1 + c], [1 + c, 1]], rtol=1e-15)


# -------------------------------------------------------------------- the catalogue


def test_what_is_of_the_format_or_of_a_simulator_is_no_word_in_a_wrong_place(save):
    extras = '<safety_controller soft_lower_limit="-1" k_velocity="9"/><calibration rising="0.1"/>'
    joint = changed(LIMIT, '<limit lower="-1" upper="1" effort="1" velocity="1" acceleration="9"/>' + extras)
    sensor = '<sensor><parent link="a"/><origin xyz="0 0 1"/></sensor><gazebo><link/></gazebo><robot_info/>'
    simulator = (
        '<contact><damping value="9"/></contact><gravity>0</gravity><self_filter><origin xyz="1 0 0"/></self_filter>'
    )
    text = (
        joint.replace("</robot>", sensor + "</robot>")
        .replace(INERTIAL, INERTIAL + simulator)
        .replace("<robot ", '<robot version="1.0" ')
    )
    assert tw.load(save(text), strict=True).report == ()


def test_robots_of_the_catalogue_are_reported_on_and_do_not_warn():
    assert tw.load("go2").report == ()
    pytest.importorskip("pinocchio", reason="example-robot-data comes with Pinocchio")
    report = tw.load("panda").report
    assert any("<mimic>" in entry.found for entry in report.warnings)
    assert "<td>" in report._repr_html_()
    with pytest.raises(tw.ModelError, match="strict=True"):
        tw.load("baxter", strict=True)
    assert tw.load("baxter", strict=True, mimic="independent").nv == 19

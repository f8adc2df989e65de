"""A URDF becomes the right model: worked out by hand; test_urdf_pinocchio.py has the others."""

import warnings
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench.loading import load


def write(folder, body, name="robot"):
    path = folder / "robot.urdf"
    path.write_text(f'<robot name="{name}">{body}</robot>')
    return path


def inertial(mass=1.0, moments=(1, 1, 1), xyz="0 0 0", rpy="0 0 0"):
    ixx, iyy, izz = moments
    return (
        f'<inertial><origin xyz="{xyz}" rpy="{rpy}"/><mass value="{mass}"/>'
        f'<inertia ixx="{ixx}" iyy="{iyy}" izz="{izz}" ixy="0" ixz="0" iyz="0"/></inertial>'
    )


def joint(name, kind, parent="base", child="body", extra=""):
    limit = '<limit lower="-1" upper="2" effort="3" velocity="4"/>' if kind in ("revolute", "prismatic") else ""
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{limit}{extra}</joint>'


def one_joint(folder, kind, extra=""):
    """Write a body on one joint; its inertia is that of a unit ball at (0.1, 0.2, 0.3)."""
    body = f'<link name="base"/><link name="body">{inertial(xyz="0.1 0.2 0.3")}</link>'
    return write(folder, body + joint("j", kind, extra=extra))


# -------------------------------------------------------------------- by hand


def test_pendulum_about_its_pivot_has_m_l_squared_plus_two_fifths_m_r_squared():
    model = load("pendulum")
    assert model.inertia[1].matrix()[1, 1] == pytest.approx(1.0 * 1.0**2 + 0.4 * 1.0 * 0.05**2, rel=1e-15)
    assert model.joint_names == ("universe", "pivot")
    assert model.joints[1].axis == (0.0, 1.0, 0.0)
    assert model.frame("bob").body == 1
    np.testing.assert_array_equal(model.frame("bob").placement.translation, [0, 0, -1])


def test_inertial_origin_turns_the_inertia(tmp_path):
    path = write(tmp_path, f'<link name="body">{inertial(2, (3, 4, 5), "1 0 0", "0 0 1.5707963267948966")}</link>')
    body = load(path, base="floating").inertia[1]
    np.testing.assert_allclose(body.inertia_at_com, np.diag([4, 3, 5]), atol=1e-15)
    np.testing.assert_array_equal(body.com, [1, 0, 0])


def test_rpy_turns_about_fixed_axes_roll_first(tmp_path):
    path = one_joint(tmp_path, "revolute", '<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>')
    T = load(path).placement[1]
    expected = tw.exp3([0, 0, 0.3]) @ tw.exp3([0, 0.2, 0]) @ tw.exp3([0.1, 0, 0])
    np.testing.assert_allclose(T.rotation, expected, atol=2e-16)
    np.testing.assert_array_equal(T.translation, [1, 2, 3])


def test_welded_links_are_merged_and_stay_as_frames(tmp_path):
    links = "".join(f'<link name="{name}">{inertial()}</link>' for name in ("base", "body", "tip"))
    weld = joint("weld", "fixed", "body", "tip", '<origin xyz="0 0 2"/>')
    model = load(write(tmp_path, links + joint("j", "revolute") + weld))
    assert model.nbodies == 2
    assert model.inertia[1].mass == 2
    np.testing.assert_array_equal(model.inertia[1].com, [0, 0, 1])
    np.testing.assert_allclose(model.inertia[1].inertia_at_com, np.diag([4, 4, 2]))
    assert set(model.frame_names) == {"base", "j", "body", "weld", "tip"}
    np.testing.assert_array_equal(model.frame("tip").placement.translation, [0, 0, 2])


def test_numbers_are_read_to_the_last_bit(tmp_path):
    text = "0.1234567890123456789"
    path = write(tmp_path, f'<link name="body">{inertial(mass=text, xyz=f"{text} 1e-300 -{text}")}</link>')
    body = load(path, base="floating").inertia[1]
    assert body.mass == float(text)
    assert body.com.tolist() == [float(text), 1e-300, -float(text)]


@pytest.mark.parametrize(
    ("kind", "joint_kind", "nq", "nv"),
    [
        ("revolute", "revolute", 1, 1),
        ("continuous", "continuous", 2, 1),
        ("prismatic", "prismatic", 1, 1),
        ("floating", "free_flyer", 7, 6),
        ("planar", "planar", 4, 3),
    ],
)
def test_every_joint_type_of_urdf(tmp_path, kind, joint_kind, nq, nv):
    extra = '<axis xyz="0 0 2"/>' if kind == "planar" else ""
    model = load(one_joint(tmp_path, kind, extra))
    assert (model.joints[1].kind, model.nq, model.nv) == (joint_kind, nq, nv)


def test_axis_is_x_when_not_given_and_normalised_when_given(tmp_path):
    assert load(one_joint(tmp_path, "revolute")).joints[1].axis == (1, 0, 0)
    assert load(one_joint(tmp_path, "revolute", '<axis xyz="0 3 4"/>')).joints[1].axis == (0, 0.6, 0.8)


def test_limits_are_kept_and_a_limit_without_ends_locks_nothing(tmp_path):
    model = load(one_joint(tmp_path, "revolute"))
    limits = (model.lower, model.upper, model.effort_limit, model.velocity_limit)
    assert [x.tolist() for x in limits] == [[-1], [2], [3], [4]]
    path = one_joint(tmp_path, "prismatic")
    path.write_text(path.read_text().replace('lower="-1" upper="2" ', ""))
    with pytest.warns(UserWarning, match="neither lower nor upper limit"):
        model = load(path)
    assert (model.lower.tolist(), model.upper.tolist()) == ([-np.inf], [np.inf])


def test_base_and_gravity_are_those_asked_for(tmp_path):
    path = write(
        tmp_path, "".join(f'<link name="{x}">{inertial()}</link>' for x in ("base", "body")) + joint("j", "revolute")
    )
    assert (load(path).base, load(path).nv) == ("fixed", 1)
    floating = load(path, base="floating", gravity=(0, 0, -1.62))
    assert (floating.nv, floating.joint_names[1]) == (7, "root_joint")
    np.testing.assert_array_equal(floating.gravity, [0, 0, -1.62])
    assert load(str(path)).nv == 1


def test_meshes_are_never_looked_for(tmp_path):
    visual = '<geometry><mesh filename="package://nowhere/at_all.stl" scale="not a number"/></geometry>'
    link = f'<link name="base"><visual>{visual}</visual><collision>{visual}</collision>{inertial()}</link>'
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert load(write(tmp_path, link), base="floating").mass == 1


def test_what_a_urdf_does_not_know_is_passed_over(tmp_path):
    """Attributes and elements of others, in any alphabet; an axis and a limit on a fixed joint."""
    odd = '<axis xyz="0 0 0" größe="😀"/><limit lower="none"/><计/><limit/>'
    links = f'<link name="base" цвет="red">{inertial()}</link><link name="body"/><sensor/><!-- note -->'
    assert load(write(tmp_path, links + joint("j", "fixed", extra=odd)), base="floating").nv == 6


def test_a_link_without_inertial_is_massless_even_when_it_moves(tmp_path):
    links = f'<link name="base"/><link name="body"/><link name="tip">{inertial()}</link>'
    model = load(write(tmp_path, links + joint("j", "revolute") + joint("k", "revolute", "body", "tip")))
    assert [float(i.mass) for i in model.inertia] == [0, 0, 1]


def test_a_file_without_a_name_takes_the_name_of_the_file(tmp_path):
    path = tmp_path / "nameless.urdf"
    path.write_text('<robot><link name="base"/></robot>')
    assert load(path).name == "nameless"


def test_the_old_default_namespace_is_understood(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(f'<robot name="r" xmlns="http://www.ros.org"><link name="b">{inertial()}</link></robot>')
    assert load(path, base="floating").mass == 1


def test_other_encodings_are_read(tmp_path):
    path = tmp_path / "robot.urdf"
    text = f'<?xml version="1.0" encoding="UTF-16"?><robot name="机器人"><link name="底座">{inertial()}</link></robot>'
    path.write_bytes(text.encode("utf-16"))
    assert load(path, base="floating").frame_names[-1] == "底座"


def test_siblings_come_in_the_order_of_their_joints_names_as_in_pinocchio(tmp_path):
    links = "".join(f'<link name="{name}">{inertial()}</link>' for name in ("base", "p", "q", "r"))
    joints = joint("zulu", "revolute", "base", "p") + joint("alpha", "revolute", "base", "q")
    model = load(write(tmp_path, links + joints + joint("mike", "revolute", "q", "r")))
    assert model.joint_names == ("universe", "alpha", "mike", "zulu")
    assert model.parent == (-1, 0, 1, 0)


def test_a_link_and_a_joint_of_one_name_in_two_places_keep_both_frames(tmp_path):
    links = f'<link name="base"/><link name="knee">{inertial()}</link><link name="leg">{inertial()}</link>'
    welded = joint("weld", "fixed", "base", "knee", '<origin xyz="1 0 0"/>')
    model = load(write(tmp_path, links + welded + joint("knee", "revolute", "base", "leg")))
    assert model.frame("link:knee").body == 0
    assert model.frame("joint:knee").body == 1
    with pytest.raises(KeyError, match=r"did you mean .*'(link|joint):knee'"):
        model.frame("knee")


@pytest.mark.slow
def test_a_tree_of_a_thousand_links_needs_no_recursion(tmp_path):
    links = "".join(f'<link name="l{i}">{inertial()}</link>' for i in range(1001))
    joints = "".join(joint(f"j{i:04}", "revolute", f"l{i}", f"l{i + 1}") for i in range(1000))
    assert load(write(tmp_path, links + joints)).nv == 1000


# -------------------------------------------------------------------- mimic joints


def mimicking(folder):
    links = "".join(f'<link name="{name}">{inertial()}</link>' for name in ("base", "a", "b"))
    follower = joint("b", "revolute", "base", "b", '<mimic joint="a" multiplier="-1"/>')
    return write(folder, links + joint("a", "revolute", "base", "a") + follower)


def test_mimic_joints_of_a_file_are_free_and_the_loader_says_so(tmp_path):
    with pytest.warns(UserWarning, match=r"joint 'b' \(line 1: a <mimic> of 'a'\): read as free to move") as caught:
        assert load(mimicking(tmp_path)).nv == 2
    assert Path(caught[0].filename) == Path(__file__)


def test_mimic_independent_is_quiet(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert load(mimicking(tmp_path), mimic="independent").nv == 2


def test_a_fixed_joint_that_mimics_moves_nothing_and_is_not_mentioned(tmp_path):
    path = mimicking(tmp_path)
    path.write_text(path.read_text().replace('name="b" type="revolute"', 'name="b" type="fixed"'))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert load(path).nv == 1


def test_following_joints_are_refused_not_ignored(tmp_path):
    with pytest.raises(ValueError, match="mimic: expected 'independent'"):
        load(mimicking(tmp_path), mimic="follow")


# -------------------------------------------------------------------- a text in place of a file


def test_a_text_is_read_as_the_file_with_this_text(tmp_path):
    path = one_joint(tmp_path, "revolute")
    file, text = load(path), load(path.read_text())
    assert (text.name, text.joint_names, text.inertia) == (file.name, file.joint_names, file.inertia)
    assert load("\ufeff\n  " + path.read_text()).inertia == file.inertia


def test_the_encoding_that_a_text_declares_no_longer_counts():
    assert load('<?xml version="1.0" encoding="iso-8859-1"?><robot name="ä"><link name="a"/></robot>').name == "ä"


def test_an_error_in_a_text_has_its_line():
    with pytest.raises(tw.ModelError, match="<string>, line 2: "):
        load('<robot name="r">\n<lin name="a"/></robot>')
    with pytest.raises(tw.ModelError, match="<string>, line 1, column 7: not well-formed XML"):
        load("<robot")
    with pytest.raises(tw.ModelError, match="<string>, line 1"):
        load('<robot name="\ud800"><link name="a"/></robot>')


def test_an_arm_on_the_ceiling_is_one_under_turned_gravity_and_pinocchios_moved_base():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    at = tw.SE3(tw.exp3([np.pi - 0.1, 0.2, 0.3]), [0.5, -1.0, 2.0])
    hung, plain = tw.load("ur5", placement=at), tw.load("ur5")
    turned = tw.load("ur5", gravity=at.rotation.mT @ plain.gravity)
    q = plain.random_configuration(rng=0)
    np.testing.assert_allclose(tw.gravity(hung, q), tw.gravity(turned, q), rtol=0, atol=1e-13)
    for frame in ("base_link", "tool0"):
        there = at @ tw.frame_placement(plain, q, frame)
        np.testing.assert_allclose(tw.frame_placement(hung, q, frame).matrix(), there.matrix(), rtol=0, atol=1e-15)
    other = bridge.to_pinocchio_model(plain)
    other.jointPlacements[1] = bridge.to_pinocchio_se3(at) * other.jointPlacements[1]
    gravity = pin.computeGeneralizedGravity(other, other.createData(), q)
    np.testing.assert_allclose(tw.gravity(hung, q), gravity, rtol=0, atol=1e-12)


def test_a_floating_base_has_its_pose_in_q():
    with pytest.raises(tw.ModelError, match=r"placement.*'go2'.*its q"):
        tw.load("go2", placement=tw.SE3.identity())
    with pytest.raises(TypeError, match="placement"):
        tw.load("ur5", placement=np.eye(4))

"""The robots of models/ are what their headers say: figures, solids, mirror images, feet on the ground."""

import re
from pathlib import Path

import numpy as np
import pytest

from twistwrench import center_of_mass, frame_placement, static_equilibrium
from twistwrench.loading import catalogue, load, robots

OWN = [robot for robot in robots() if robot.source == "models"]


@pytest.mark.skipif(
    catalogue.example_robot_data_folder() is None, reason="example-robot-data is not installed: its Go2 is not compared"
)
def test_go2_equals_example_robot_datas_to_the_last_bit():
    ours, theirs = load("go2"), load("example-robot-data/go2")
    assert ours.joint_names == theirs.joint_names
    assert ours.parent == theirs.parent
    assert ours.joints == theirs.joints
    for a, b in zip(ours.inertia, theirs.inertia, strict=True):
        assert a.mass == b.mass
        assert (a.com == b.com).all()
        assert (a.inertia_at_com == b.inertia_at_com).all()
    for a, b in zip(ours.placement, theirs.placement, strict=True):
        assert (a.matrix() == b.matrix()).all()
    assert set(ours.frame_names) == set(theirs.frame_names)
    for name, frame in ours.frames.items():
        assert frame.body == theirs.frame(name).body
        assert (frame.placement.matrix() == theirs.frame(name).placement.matrix()).all()
    for limit in ("lower", "upper", "velocity_limit", "effort_limit"):
        np.testing.assert_array_equal(getattr(ours, limit), getattr(theirs, limit))


def solid(comment, mass):
    """Principal moments of the solid that a comment of humanoid.urdf names, from the textbook's formulas."""
    sizes = [float(number) for number in re.findall(r"\d+\.?\d*", comment)]
    if comment.startswith("box"):
        a, b, c = sizes
        return mass / 12 * np.array([b * b + c * c, a * a + c * c, a * a + b * b])
    if comment.startswith("cylinder"):
        r, length = sizes
        across = mass / 12 * (3 * r * r + length * length)
        return np.array([across, across, mass / 2 * r * r])
    (r,) = sizes
    return np.full(3, mass * 2 / 5 * r * r)


def links_of(name):
    """Yield name, comment, mass and inertia (ixx, iyy, izz) of each link with an inertial."""
    text = (catalogue.models_folder() / f"{name}.urdf").read_text()
    for link, body in re.findall(r'<link name="(\w+)">(.*?)</link>', text, re.DOTALL):
        comment = re.match(r"\s*<!-- (.*?) -->", body)
        mass = float(re.search(r'<mass value="(.*?)"', body)[1])
        moments = [float(re.search(rf'{key}="(.*?)"', body)[1]) for key in ("ixx", "iyy", "izz")]
        assert re.findall(r'(?:ixy|ixz|iyz)="(.*?)"', body) == ["0"] * 3
        yield link, comment[1] if comment else "", mass, moments


def test_humanoids_inertias_are_those_of_its_solids():
    links = list(links_of("humanoid"))
    assert len(links) == 25
    for name, comment, mass, moments in links:
        np.testing.assert_allclose(moments, solid(comment, mass), rtol=1e-9, err_msg=name)  # ten digits in the file


def test_humanoids_masses_are_winters_fractions_of_20_kg():
    mass = {name: m for name, _, m, _ in links_of("humanoid")}
    segments = {
        "head": 0.081,
        "torso": 0.216 + 0.139,
        "pelvis": 0.142,
        "left_hip_yaw_link left_hip_roll_link left_thigh": 0.100,
        "left_shank": 0.0465,
        "left_ankle_link left_foot": 0.0145,
        "left_shoulder_pitch_link left_shoulder_roll_link left_upper_arm": 0.028,
        "left_forearm": 0.016,
        "left_hand": 0.006,
    }
    for names, fraction in segments.items():
        assert sum(mass[name] for name in names.split()) == pytest.approx(20 * fraction, rel=1e-14), names
    assert sum(mass.values()) == pytest.approx(20, rel=1e-14)


def test_humanoid_is_the_mirror_image_of_itself():
    model, S = load("humanoid"), np.diag([1.0, -1.0, 1.0])
    for i, name in enumerate(model.joint_names):
        if not name.startswith("left_"):
            continue
        j = model.joint_id(name.replace("left_", "right_"))
        a, b = model.inertia[i], model.inertia[j]
        np.testing.assert_allclose(a.com, S @ b.com, atol=1e-15)
        np.testing.assert_allclose(a.inertia_at_com, S @ b.inertia_at_com @ S, atol=1e-15)
        np.testing.assert_allclose(model.placement[i].translation, S @ model.placement[j].translation)
        low, high = model.lower[model.q_slice[i]], model.upper[model.q_slice[i]]
        flip = model.joints[i].axis != (0, 1, 0)  # roll and yaw turn the other way in the mirror
        mirrored = (-model.upper, -model.lower) if flip else (model.lower, model.upper)
        np.testing.assert_array_equal(low, mirrored[0][model.q_slice[j]])
        np.testing.assert_array_equal(high, mirrored[1][model.q_slice[j]])


@pytest.mark.parametrize(
    ("robot", "link", "comment"),
    [
        ("pendulum", "rod", "ball, r = 0.05"),
        ("double_pendulum", "upper", "cylinder r = 0.02, l = 0.6"),
        ("double_pendulum", "lower", "cylinder r = 0.02, l = 0.6"),
        ("cart_pole", "cart", "box 0.5 x 0.3 x 0.2"),
        ("cart_pole", "pole", "cylinder r = 0.02, l = 1.0"),
    ],
)
def test_inertias_of_the_small_ones_are_those_of_their_solids(robot, link, comment):
    mass, moments = {name: (m, moments) for name, _, m, moments in links_of(robot)}[link]
    np.testing.assert_allclose(moments, solid(comment, mass), rtol=1e-15)


def test_planar_arms_links_are_cylinders_along_x():
    links = {name: (m, moments) for name, _, m, moments in links_of("planar_arm")}
    for name, r, length in (("upper_arm", 0.04, 0.5), ("forearm", 0.03, 0.4), ("hand", 0.02, 0.3)):
        mass, moments = links[name]
        np.testing.assert_allclose(moments, solid(f"cylinder {r} {length}", mass)[::-1], rtol=1e-15, err_msg=name)


def test_planar_arm_reaches_its_length_and_lifts_with_positive_angles():
    model = load("planar_arm")
    np.testing.assert_allclose(frame_placement(model, model.neutral(), "tool").translation, [1.2, 0, 0])
    up = frame_placement(model, [np.pi / 2, 0, 0], "tool").translation
    np.testing.assert_allclose(up, [0, 0, 1.2], atol=1e-15)


def test_models_carry_no_meshes_and_name_their_source():
    readme = (catalogue.models_folder() / "README.md").read_text(encoding="utf-8")
    for robot in OWN:
        text = Path(robot.path).read_text(encoding="utf-8")
        assert not re.search("<(visual|collision|mesh)", text)
        assert re.search("(?i)our own (figures|design)|that Unitree publishes|Barto", text)
        assert f"`{robot.name}`" in readme


@pytest.mark.parametrize("name", ["go2", "humanoid"])
def test_our_robots_stand_exactly_on_the_ground(name):
    model = load(name)
    heights = [frame_placement(model, model.standing(), foot).translation[2] for foot in model.feet]
    np.testing.assert_allclose(heights, 0, atol=1e-15)


def test_humanoid_stands_with_flat_soles_below_its_centre_of_mass():
    model = load("humanoid")
    q = model.standing()
    corners = [name for name in model.frame_names if re.fullmatch(r"(left|right)_sole_(fl|fr|rl|rr)", name)]
    assert set(model.feet) == set(corners)
    points = np.array([frame_placement(model, q, name).translation for name in corners])
    assert len(points) == 8
    np.testing.assert_allclose(points[:, 2], 0, atol=1e-15)
    com = center_of_mass(model, q)[:2]
    assert (points[:, :2].min(axis=0) < com).all()
    assert (com < points[:, :2].max(axis=0)).all()


def test_humanoid_is_held_at_the_corners_of_its_soles():
    """Force and moment about the world's origin are those of the weight; the soles only push."""
    model = load("humanoid")
    q = model.standing()
    forces = static_equilibrium(model, q).forces
    points = np.array([frame_placement(model, q, foot).translation for foot in model.feet])
    weight = np.array([0, 0, 9.81 * model.mass])
    np.testing.assert_allclose(forces.sum(axis=0), weight, atol=1e-12 * weight[2])
    moment = np.cross(center_of_mass(model, q), weight)
    np.testing.assert_allclose(np.cross(points, forces).sum(axis=0), moment, atol=1e-12 * weight[2])
    assert (forces[:, 2] > 0).all()

"""What `tw.view` shows: the right places, the right forces, and a page that needs nothing from outside."""

import contextlib
import re
import shutil
import subprocess
import sys
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import motions, plot
from twistwrench.cli import main
from twistwrench.loading.catalogue import PREFIX, find
from twistwrench.spatial import quaternion_to_rotation
from twistwrench.viewing.controls import add_joints, add_time
from twistwrench.viewing.origin import only_own_page
from twistwrench.viewing.scene import build
from twistwrench.viewing.shapes import shapes
from twistwrench.viewing.state import subject

from ..pages import FENCE, names_author_and_licence, page, run
from ..robots import shared

pytest.importorskip("matplotlib", reason="matplotlib is not installed: the pictures are not checked")
from matplotlib.figure import Figure

GO2 = shared("go2")
SOLES = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), mu=0.7) for side in ("left", "right")]


@pytest.fixture
def space():
    return Figure().add_subplot(projection="3d")


def curve(line):
    return np.stack(line.get_data_3d(), axis=-1)


# ---------------------------------------------------------------- what is seen


@pytest.mark.one_case
@pytest.mark.parametrize("seen", [subject("go2"), subject(tw.Scene("humanoid", contacts=SOLES))], ids=["feet", "soles"])
def test_the_forces_at_rest_carry_the_weight_and_turn_nothing(seen):
    """At the centre of pressure a sole's force stands for its wrench, but for the moment about the normal."""
    forces, weight = seen.forces(), seen.model.mass * 9.81
    np.testing.assert_allclose(forces.vectors.sum(axis=0), [0, 0, weight], atol=1e-9)
    arms = forces.at - tw.center_of_mass(seen.model, seen.q)
    np.testing.assert_allclose(np.cross(arms, forces.vectors).sum(axis=0)[:2], 0, atol=1e-9)


def test_two_points_cannot_hold_a_humanoid_and_no_force_is_shown(space):
    assert subject("humanoid", contacts=["left_sole", "right_sole"]).forces() is None
    tw.view("humanoid", contacts=["left_sole", "right_sole"], ax=space)
    assert not space.texts


def test_a_sole_that_bears_nothing_has_its_force_in_its_middle():
    seen = subject(tw.Scene("humanoid", contacts=SOLES, gravity=[0, 0, 0]))
    middles = [tw.frame_placement(seen.model, seen.q, sole.frame).translation for sole in SOLES]
    assert (seen.forces().at == middles).all()
    assert not seen.forces().vectors.any()


def test_a_sole_supports_with_its_corners():
    seen = subject("humanoid", contacts=SOLES)
    T = tw.frame_placement(seen.model, seen.q, "left_sole")
    np.testing.assert_allclose(seen.support()[:4], T.act(SOLES[0].points), atol=1e-15)


def test_only_the_feet_that_stand_support_a_motion():
    trot = motions.trot(GO2, samples=16)
    seen = subject(GO2, trot)
    assert [len(seen.at(k).support()) for k in range(16)] == trot.contacts.sum(axis=1).tolist()
    assert 0 < trot.contacts.sum() < trot.contacts.size
    np.testing.assert_array_equal(seen.t, trot.t)


def test_forces_that_were_given_say_which_feet_stand():
    f = np.zeros((4, 3))
    f[1] = [0, 0, 7.0]
    seen = subject(GO2, forces=f)
    np.testing.assert_allclose(seen.support(), [tw.frame_placement(GO2, seen.q, GO2.feet[1]).translation], atol=1e-15)
    assert seen.texts(seen.forces()) == ["", "7.0 N", "", ""]


def test_complex_forces_are_refused():
    with pytest.raises(ValueError, match="forces: expected real numbers, got complex128"):
        subject(GO2, forces=np.ones((4, 3)) * 1j)


def test_forces_on_one_body_are_summed_up_once():
    seen = subject("humanoid")
    texts = [text for text in seen.texts(seen.forces()) if text]
    assert texts == ["Σ 98.1 N", "Σ 98.1 N"]


# ---------------------------------------------------------------- the figure


def test_the_figure_shows_frames_centre_of_mass_polygon_and_forces_in_their_places(space):
    q = GO2.standing()
    assert tw.view(GO2, q, ax=space) is space
    assert space.get_legend_handles_labels()[1] == ["centre of mass", "support polygon", "force of the ground"]
    lines = [curve(line) for line in space.lines]
    joints = tw.forward_kinematics(GO2, q).placement[1:]
    triads = [curve(line) for line in space.lines if line.get_color() in plot.XYZ]
    assert len(triads) == 3 * 13
    np.testing.assert_allclose([line[0] for line in triads[::3]], [T.translation for T in joints], atol=1e-12)
    com = tw.center_of_mass(GO2, q)
    assert any(len(line) == 1 and np.allclose(line, com, atol=1e-12) for line in lines)
    feet = np.array([tw.frame_placement(GO2, q, foot).translation for foot in GO2.feet])
    assert any(len(line) == 5 and np.allclose(line[:4], plot.hull(feet), atol=1e-12) for line in lines)


def test_frames_that_are_asked_for_are_the_only_ones_and_carry_their_names(space):
    tw.view("planar_arm", frames=[], ax=space)
    without = len(space.lines)
    tw.view("planar_arm", frames=iter([shared("planar_arm").frame_names[-1]]), ax=space)
    assert len(space.lines) == 2 * without + 3
    assert [text.get_text().strip() for text in space.texts] == [shared("planar_arm").frame_names[-1]]


def test_a_model_without_frames_is_shown(space):
    tw.view(replace(tw.chain(3), frames={}), ax=space)
    assert any(line.get_color() in plot.XYZ for line in space.lines)


def test_a_model_that_no_robot_gave_its_name_is_shown_as_sticks():
    pytest.importorskip("viser", reason="viser is not installed: the browser is not checked")
    page = tw.view(tw.chain(3), backend="browser")
    page.stop()


def test_without_axes_a_figure_is_made_which_a_notebook_shows():
    import matplotlib.pyplot as plt

    try:
        ax = tw.view("pendulum")
        assert plt.gcf() is ax.figure
    finally:
        plt.close("all")


# ---------------------------------------------------------------- the stage in the browser


class Stage:
    """Takes down what is put up."""

    def __init__(self):
        self.nodes = {}

    def set_up_direction(self, direction):
        self.up = direction

    def __getattr__(self, add):
        def put_up(name, *args, **look):
            self.nodes[name] = SimpleNamespace(args=args, **look)
            return self.nodes[name]

        return put_up


def weightless(base):
    """A robot of which only the shape is known, as many a file for pictures has it."""
    builder = tw.Builder("shape", base=base)
    builder.link("leg", parent="base_link", joint=tw.Revolute("y"))
    builder.link("foot", parent="leg", placement=tw.SE3(np.eye(3), [0, 0, -1]))
    return builder.build(feet=["foot"])


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_a_robot_without_mass_is_shown_without_a_centre_of_mass(base, space):
    model = weightless(base)
    tw.view(model, ax=space)
    assert "centre of mass" not in space.get_legend_handles_labels()[1]
    plot.side_view(model, model.neutral(), ax=Figure().add_subplot())
    pytest.importorskip("trimesh")
    stage = Stage()
    build(stage, subject(model), [], None)
    assert "/centre_of_mass" not in stage.nodes
    assert not stage.nodes["/plumb"].visible
    assert stage.nodes["/support"].visible


def test_what_touches_nothing_and_weighs_nothing_has_no_legend(space):
    tw.view(weightless("fixed"), contacts=[], ax=space)
    assert space.get_legend() is None


def turned(wxyz, vector):
    return quaternion_to_rotation(np.roll(wxyz, -1, axis=-1)) @ vector


def test_sticks_on_the_stage_lie_where_the_figure_draws_them():
    pytest.importorskip("trimesh")
    stage, seen = Stage(), subject("go2")
    move = build(stage, seen, [], None)
    for q in (seen.q, GO2.random_configuration(rng=0)):
        move(seen.moved(q))
        rods, lines = stage.nodes["/rods"], plot.sticks(GO2, q)
        halves = turned(rods.batched_wxyzs, [0, 0, 1]) * rods.batched_scales[:, 2:] / 2
        np.testing.assert_allclose(rods.batched_positions - halves, lines[:, 0], atol=1e-12)
        np.testing.assert_allclose(rods.batched_positions + halves, lines[:, 1], atol=1e-12)
        np.testing.assert_allclose(stage.nodes["/centre_of_mass"].position, tw.center_of_mass(GO2, q), atol=1e-12)
        T = tw.forward_kinematics(GO2, q).placement[1:]
        axes = stage.nodes["/frames"].points
        np.testing.assert_allclose(axes[::3, 0], [t.translation for t in T], atol=1e-6)  # float32 for the browser
        direction = (axes[:, 1] - axes[:, 0]).reshape(-1, 3, 3)
        direction = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
        np.testing.assert_allclose(direction, [t.rotation.mT for t in T], atol=1e-5)


def test_two_feet_on_the_ground_are_joined_by_a_line():
    pytest.importorskip("trimesh")
    stage, trot = Stage(), motions.trot(GO2, samples=16)
    k = next(k for k in range(16) if trot.contacts[k].sum() == 2)
    seen = subject(GO2, trot)
    build(stage, seen, [], None)(seen.at(k))
    edges = stage.nodes["/support/edges"].points
    lengths = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=-1)
    apart = np.linalg.norm(np.subtract(*seen.at(k).support()))
    np.testing.assert_allclose(np.sort(lengths), [0, 0, apart, apart], rtol=1e-5)


@pytest.mark.one_case
@pytest.mark.parametrize("ground", [None, tw.Ground()])
def test_a_simulation_shows_its_own_contacts_and_forces(ground):
    """On a ground those of a step are shown where it ends: in the air there are none, and no polygon."""
    feet, q = [tw.PointContact(foot, 0.6) for foot in GO2.feet[:3]], GO2.standing()
    q[2] += 0.001 if ground else 0.0
    motion = tw.simulate(GO2, q, np.zeros(GO2.nv), dt=0.01, steps=3, contacts=feet, ground=ground)
    shown = subject(motion)
    assert shown.contacts == tuple(feet)
    for k, foot in enumerate(feet):
        forces = motion.contact_forces[foot.frame]
        np.testing.assert_array_equal(shown.given[:, k], np.concatenate([forces[: 4 - len(forces)], forces]))
    assert [len(shown.at(k).support()) for k in range(4)] == [3 * touches for touches in (shown.given != 0).any((1, 2))]
    assert shown.at(0).given.any() == (ground is None)
    assert subject(motion, contacts=GO2.feet).given is None
    assert subject(tw.simulate(GO2, q, np.zeros(GO2.nv), dt=0.01, steps=0, contacts=feet, ground=ground)).t is not None


@pytest.mark.slow
def test_in_flight_nothing_supports_and_no_polygon_is_shown():
    pytest.importorskip("trimesh")
    stage, jump = Stage(), motions.jump(GO2, samples=8)
    move, seen = build(stage, subject(GO2, jump), [], None), subject(GO2, jump)
    for k, stands in enumerate(jump.contacts.any(axis=1)):
        move(seen.at(k))
        assert stage.nodes["/support"].visible == stage.nodes["/plumb"].visible == stands
    assert not jump.contacts.all()


def test_a_frame_that_is_asked_for_moves_with_its_name():
    pytest.importorskip("trimesh")
    stage, seen, q = Stage(), subject("go2"), GO2.random_configuration(rng=3)
    build(stage, seen, [], ["FL_foot", "base"])(seen.moved(q))
    for k, name in enumerate(("FL_foot", "base")):
        label = stage.nodes[f"/names/{k}"]
        assert label.args == (name,)
        np.testing.assert_allclose(label.position, tw.frame_placement(GO2, q, name).translation, atol=1e-6)


def test_the_arrow_of_the_largest_given_force_is_as_long_whatever_its_size():
    pytest.importorskip("trimesh")
    arrows, f = [], np.zeros((4, 3))
    f[0], f[2] = [0, 3, 4], [0, 0, 1]
    for scale in (1, 1000):
        stage = Stage()
        build(stage, subject(GO2, forces=scale * f), [], None)
        arrows.append(np.diff(stage.nodes["/forces"].points, axis=1)[:, 0])
    np.testing.assert_allclose(arrows[0], arrows[1], atol=1e-6)
    np.testing.assert_allclose(arrows[0], f * np.linalg.norm(arrows[0][0]) / 5, atol=1e-6)
    assert [stage.nodes[f"/forces/{k}"].visible for k in range(4)] == [True, False, True, False]


def test_where_no_forces_hold_the_robot_none_are_shown():
    """On three feet, one of which slides: where they are in line, and the weight is beside it, nothing holds."""
    pytest.importorskip("trimesh")
    lump = tw.SpatialInertia(1, [0, 0.1, 0.5], np.eye(3))
    tripod = tw.Builder("tripod", base="floating", root_inertia=lump)
    for name, x in (("front", 1.0), ("rear", -1.0)):
        tripod.link(name, parent="base_link", placement=tw.SE3(np.eye(3), [x, 0, 0]))
    slide = tw.SpatialInertia(1e-3, [0, 0, 0], np.eye(3) * 1e-3)
    tripod.link("side", parent="base_link", joint=tw.Prismatic("y"), inertia=slide)
    stage, model = Stage(), tripod.build(feet=("front", "rear", "side"))
    wide, line = ([*model.neutral()[:7], y] for y in (0.5, 0.0))
    seen = subject(model, wide)
    move = build(stage, seen, [], None)
    for q, held in ((line, False), (wide, True)):
        move(seen.moved(q))
        assert stage.nodes["/forces"].visible is held


def test_a_rod_that_points_straight_down_is_turned_by_half_a_turn():
    pytest.importorskip("trimesh")
    stage = Stage()
    build(stage, subject("pendulum", [0.0]), [], None)
    np.testing.assert_allclose(turned(stage.nodes["/rods"].batched_wxyzs[-1], [0, 0, 1]), [0, 0, -1], atol=1e-12)


def test_bodies_with_meshes_stand_where_kinematics_says():
    stage, seen = Stage(), subject("go2")
    found = shapes(GO2, "go2")
    if not found:
        pytest.skip("example-robot-data is not installed: no meshes")
    q = GO2.random_configuration(rng=1)
    build(stage, seen, found, None)(seen.moved(q))
    T = tw.forward_kinematics(GO2, q).placement
    for shape in found:
        node = stage.nodes[f"/bodies/{shape.body}"]
        np.testing.assert_allclose(node.position, T[shape.body].translation, atol=1e-12)
        np.testing.assert_allclose(turned(node.wxyz, np.eye(3)), T[shape.body].rotation, atol=1e-12)
    lowest = min((T[s.body] @ s.placement).act(s.mesh.vertices)[:, 2].min() for s in found)
    feet = min(tw.frame_placement(GO2, q, foot).translation[2] for foot in GO2.feet)
    assert lowest < feet  # the frame of a foot is the middle of its ball
    ball = [s for s in found if s.body == GO2.frame("FL_foot").body][-1]
    np.testing.assert_allclose(
        ball.placement.act(ball.mesh.bounds.mean(axis=0)), GO2.frame("FL_foot").placement.translation, atol=0.01
    )


URDF = """<robot name="box"><link name="base"><visual><geometry><box size="1 2 3"/></geometry></visual></link>
<link name="arm"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><origin xyz="0 0 0.5"/><geometry><mesh filename="{}" scale="2 2 2"/></geometry>
<material name="m"><color rgba="1 0 0 1"/></material></visual></link>
<joint name="j" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>"""


@pytest.mark.parametrize("name", ["ball.stl", "package://mine/ball.stl", "package://other/ball.stl"])
def test_a_mesh_is_found_beside_the_urdf_and_in_packages_around_it(name, tmp_path):
    trimesh = pytest.importorskip("trimesh")
    folder = tmp_path / "mine"
    folder.mkdir()
    trimesh.creation.icosphere(radius=0.5).export(folder / "ball.stl")
    path = folder / "robot.urdf"
    path.write_text(URDF.format(name), encoding="utf-8")
    box, ball = shapes(tw.load(path), path)
    assert (box.body, ball.body) == (0, 1)
    np.testing.assert_allclose(box.mesh.extents, [1, 2, 3])
    np.testing.assert_allclose(ball.mesh.extents, [2, 2, 2], atol=0.02)
    np.testing.assert_allclose(ball.placement.translation, [0, 0, 0.5])
    assert ball.mesh.visual.face_colors[0].tolist() == [255, 0, 0, 255]


@pytest.mark.parametrize(
    ("element", "extents"),
    [('<cylinder radius="0.2" length="3"/>', (0.4, 0.4, 3)), ('<sphere radius="0.5"/>', (1, 1, 1))],
)
def test_round_shapes_have_their_size(element, extents, tmp_path):
    pytest.importorskip("trimesh")
    path = tmp_path / "robot.urdf"
    path.write_text(re.sub("<mesh [^>]*>", element, URDF), encoding="utf-8")
    found = shapes(tw.load(path), path)[1]
    np.testing.assert_allclose(found.mesh.extents, extents, rtol=0.01)
    assert found.placement.translation[2] == 0.5


def test_meshes_keep_the_colours_of_their_materials_with_a_picture_or_without(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    image = pytest.importorskip("PIL.Image")
    image.new("RGB", (4, 4), (0, 128, 255)).save(tmp_path / "blue.png")
    corners, faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n", "usemtl m\nf 1/1 2/2 3/3\n"
    for name, material in {"plain": "Kd 1 0 0", "picture": "map_Kd blue.png"}.items():
        (tmp_path / f"{name}.obj").write_text(f"mtllib {name}.mtl\n{corners}{faces}", encoding="utf-8")
        (tmp_path / f"{name}.mtl").write_text(f"newmtl m\n{material}\n", encoding="utf-8")
        path = tmp_path / f"{name}.urdf"
        path.write_text(URDF.format(f"{name}.obj"), encoding="utf-8")
        mesh = shapes(tw.load(path), path)[1].mesh
        assert isinstance(mesh.visual, trimesh.visual.ColorVisuals)
        expected = [255, 0, 0, 255] if name == "plain" else [0, 128, 255, 255]
        assert mesh.visual.vertex_colors.tolist() == 3 * [expected]


@pytest.mark.parametrize("name", ["gone.stl", "http://example.org/ball.stl"])
def test_a_mesh_that_is_not_here_is_said_and_not_fetched(name, tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(URDF.format(name), encoding="utf-8")
    with pytest.warns(UserWarning, match=rf"these links are not shown.*: arm \({name}: the file is missing\)"):
        assert len(shapes(tw.load(path), path)) == 1


POINTER = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n"


@pytest.mark.parametrize("suffix", ["stl", "STL", "obj", "dae", "glb", "gltf", "ply", "off", "3mf", "txt"])
@pytest.mark.parametrize(("content", "said"), [(POINTER, "git lfs pull"), ("", "mesh"), ("\0junk\n" * 99, "mesh")])
def test_a_file_without_a_mesh_is_named_with_its_link(suffix, content, said, tmp_path):
    pytest.importorskip("yourdfpy")
    path = tmp_path / "robot.urdf"
    path.write_text(URDF.format(f"arm.{suffix}"), encoding="utf-8")
    (tmp_path / f"arm.{suffix}").write_text(content, encoding="utf-8")
    with pytest.warns(UserWarning, match=rf"not shown.*: arm \(.*arm\.{suffix}: .*{said}"):
        assert len(shapes(tw.load(path), path)) == 1


@pytest.mark.parametrize(
    "geometry",
    [
        "",
        "<mesh/>",
        '<mesh filename=""/>',
        '<box size="a b"/>',
        '<box size="1 2"/>',
        "<box/>",
        '<box size="nan 1 1"/>',
        '<capsule radius="1"/>',
        '<cylinder radius="1"/>',
        f'<mesh filename="{"x" * 400}.stl"/>',
        '<mesh filename="/"/>',
    ],
)
def test_a_visual_that_cannot_be_drawn_is_named_and_the_others_are_shown(geometry, tmp_path):
    pytest.importorskip("yourdfpy")
    path = tmp_path / "robot.urdf"
    path.write_text(re.sub("<mesh [^>]*>", geometry, URDF), encoding="utf-8")
    with pytest.warns(UserWarning, match=r"not shown.*: arm \("):
        assert len(shapes(tw.load(path), path)) == 1


def test_a_colour_that_the_robot_gives_a_name_is_the_links(tmp_path):
    pytest.importorskip("yourdfpy")
    path, red = tmp_path / "robot.urdf", '<material name="m"><color rgba="1 0 0 1"/></material>'
    text = re.sub("<mesh [^>]*>", '<sphere radius="1"/>', URDF).replace(red, '<material name="m"/>')
    path.write_text(text.replace('<link name="base">', red + '<link name="base">'), encoding="utf-8")
    assert shapes(tw.load(path), path)[1].mesh.visual.face_colors[0].tolist() == [255, 0, 0, 255]


def test_meshes_of_another_robot_are_not_put_on(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(URDF.format("gone.stl"), encoding="utf-8")
    assert shapes(GO2, path) == []
    assert shapes(GO2, None) == []
    assert shapes(shared("planar_arm"), "planar_arm") == []


def test_our_robots_have_the_meshes_of_example_robot_data_and_none_without_it(monkeypatch):
    here = [shape.body for shape in shapes(GO2, "go2")]
    assert here == [shape.body for shape in shapes(GO2, f"{PREFIX}go2")]
    monkeypatch.setattr(sys.modules["twistwrench.loading.catalogue"], "example_robot_data_folder", lambda: None)
    assert shapes(GO2, "go2") == []


# ---------------------------------------------------------------- the page


@pytest.fixture
def browser():
    pytest.importorskip("viser", reason="viser is not installed: the browser is not checked")
    opened = []

    def open_(*args, **options):
        opened.append(tw.view(*args, backend="browser", **options))
        return opened[-1]

    yield open_
    for each in opened:
        each.stop()


def test_a_page_stands_alone(browser, tmp_path):
    shown = browser("double_pendulum", meshes=False)
    shown.update([0.3, -0.2])
    shown.save(tmp_path / "page.html")
    html = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "__VISER_EMBED_DATA__" in html
    assert not re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="?https?:', html)
    assert len(html) < 1_000_000
    assert "<iframe" in shown._repr_html_()
    with pytest.raises(tw.ShapeError, match="expected one configuration"):
        shown.update([[0.3, -0.2]])


def test_the_page_of_a_motion_is_longer_and_one_of_a_state_has_a_slider_for_each_joint(browser):
    model = shared("double_pendulum")
    still = browser(model, [0.1, 0.2])
    sliders = [handle.label for handle in still._server.gui._gui_input_handle_from_uuid.values()]
    assert sliders == list(model.joint_names[1:])
    moving = browser(model, np.random.default_rng(0).uniform(-1, 1, (40, 2)), t=np.arange(40) / 20)
    assert len(moving.html()) > len(still.html()) + 1000


def test_the_page_is_served_to_this_machine_only(browser):
    from urllib.request import urlopen

    shown = browser("pendulum")
    assert shown.url.startswith("http://127.0.0.1:")
    assert repr(shown) == f"<Browser: pendulum at {shown.url}>"
    with urlopen(shown.url, timeout=10) as answer:
        assert b"<!doctype html>" in answer.read(100)


@pytest.mark.parametrize(
    ("origin", "host", "taken"),
    [
        (None, None, True),
        ("http://127.0.0.1:{}", None, True),
        ("http://localhost:{}", "localhost:{}", True),
        ("http://evil.example", None, False),
        ("http://127.0.0.1:1", None, False),
        ("null", None, False),
        ("http://evil.example:{}", "evil.example:{}", False),
        (None, "evil.example:{}", False),
        (None, "[", False),
    ],
)
def test_a_page_of_another_site_is_not_answered(origin, host, taken, browser):
    import socket

    port = int(browser("pendulum").url.rpartition(":")[2])
    lines = ["GET / HTTP/1.1", f"Host: {(host or '127.0.0.1:{}').format(port)}", "Upgrade: websocket"]
    lines += ["Connection: Upgrade", "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==", "Sec-WebSocket-Version: 13"]
    lines += [f"Origin: {origin.format(port)}"] if origin else []
    with socket.create_connection(("127.0.0.1", port), timeout=10) as line:
        line.sendall("\r\n".join([*lines, "Sec-WebSocket-Protocol: viser-v0", "", ""]).encode())
        answer = line.recv(100)
    assert answer.startswith(b"HTTP/1.1 101" if taken else b"HTTP/1.1 403")


def test_a_server_that_cannot_be_guarded_is_said(recwarn):
    pytest.importorskip("websockets")
    with pytest.warns(UserWarning, match="pages of other sites"), only_own_page():
        pass


def test_without_viser_the_message_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(ModuleNotFoundError, match=r'pip install "twistwrench\[view\]"'):
        tw.view("pendulum", backend="browser")


@pytest.mark.slow
def test_a_real_browser_draws_the_page(tmp_path, browser):
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("no Chromium here: the page is not drawn")
    image = pytest.importorskip("PIL.Image")
    browser("go2", meshes=False).save(tmp_path / "go2.html")
    flags = "--headless --no-sandbox --no-first-run --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader"
    shot = tmp_path / "go2.png"
    where = [f"--user-data-dir={tmp_path}", f"--screenshot={shot}", (tmp_path / "go2.html").as_uri()]
    quick = ["--window-size=500,400", "--virtual-time-budget=3000"]
    try:
        subprocess.run([chromium, *flags.split(), *quick, *where], capture_output=True, timeout=25, check=True)
    except subprocess.TimeoutExpired:  # a browser that waits for itself does so rarely, and not twice
        subprocess.run([chromium, *flags.split(), *quick, *where], capture_output=True, timeout=120, check=True)
    pixels = np.asarray(image.open(shot).convert("RGB")).reshape(-1, 3).astype(int)
    sky = (pixels[:, 2] - pixels[:, 0] > 20).mean()  # the support polygon and the z axes
    assert 0.005 < sky < 0.5


# ---------------------------------------------------------------- sliders


class Controls:
    """Takes down what is added; `set` does what a hand in the browser does."""

    def __init__(self):
        self.handles = {}

    def add_folder(self, label, expand_by_default):
        return contextlib.nullcontext()

    def add_slider(self, label, low, high, step, value):
        assert low <= value <= high
        assert 0 < step < high - low
        return self._add(label, value=value, range=(low, high))

    def add_checkbox(self, label, initial_value):
        return self._add(label, value=initial_value)

    def _add(self, label, **look):
        handle = self.handles[label] = SimpleNamespace(**look)
        handle.on_update = lambda callback: setattr(handle, "callback", callback)
        return handle

    def set(self, label, value):
        handle = self.handles[label]
        handle.value = value
        handle.callback(SimpleNamespace(target=handle))


def test_sliders_move_the_joints_that_have_an_angle_within_their_limits():
    gui, shown = Controls(), []
    add_joints(gui, subject("go2"), shown.append)
    assert list(gui.handles) == list(GO2.joint_names[2:])  # not the free-flyer
    low, high = gui.handles["FL_calf_joint"].range
    at = GO2.q_slice[GO2.joint_id("FL_calf_joint")].start
    assert (low, high) == (GO2.lower[at], GO2.upper[at])
    gui.set("FL_calf_joint", -1.0)
    gui.set("RR_hip_joint", 0.25)
    (moved,) = np.nonzero(shown[-1] != GO2.standing())
    assert moved.tolist() == [at, GO2.q_slice[GO2.joint_id("RR_hip_joint")].start]
    assert shown[-1][moved].tolist() == [-1.0, 0.25]
    assert shown[0][at] == -1.0
    assert len({id(q) for q in shown}) == 2


def test_a_joint_without_limits_has_a_turn_and_one_outside_them_still_a_slider():
    gui = Controls()
    add_joints(gui, subject(tw.chain(1), [5.0]), lambda q: None)
    (slider,) = gui.handles.values()
    assert slider.range == (-np.pi, 5.0)


def test_the_slider_of_time_shows_what_was_then_and_plays_from_the_start_again():
    gui, shown, t = Controls(), [], np.array([0.0, 0.1, 0.4])
    add_time(gui, t, shown.append)
    for now in (0.0, 0.05, 0.1, 0.39, 0.4):
        gui.set("time [s]", now)
    assert shown == [0, 0, 1, 1, 2]
    gui.set("play", True)
    slider, places = gui.handles["time [s]"], set()
    end = time.monotonic() + 20
    while len(places) < 4 and time.monotonic() < end:
        places.add(slider.value)
        time.sleep(0.01)
    gui.set("play", False)
    assert len(places) >= 4
    assert min(places) < 0.4
    assert max(places) <= 0.4
    time.sleep(0.1)
    rests = slider.value
    time.sleep(0.1)
    assert slider.value == rests


# ---------------------------------------------------------------- what cannot be shown


@pytest.mark.parametrize(
    ("arguments", "options", "error", "said"),
    [
        (["go2"], {"backend": "vtk"}, tw.NameNotFound, "unknown backend 'vtk'; known: 'matplotlib', 'browser'"),
        (["gogo2"], {}, tw.NameNotFound, "unknown robot 'gogo2'"),
        ([GO2.nv], {}, TypeError, "robot: expected a name, a path, a Model, a Scene or a Simulation, got the int"),
        (["go2", np.zeros(18)], {}, tw.ShapeError, "q: expected shape (..., 19), got (18,)"),
        (["go2", np.tile(GO2.standing(), (2, 2, 1))], {}, tw.ShapeError, "or (n, 19) for a motion, got (2, 2, 19)"),
        (["go2", np.tile(GO2.standing(), (2, 1))], {}, tw.ShapeError, "matplotlib plays no motion"),
        (["pendulum", [0.1j]], {}, ValueError, "q: expected real numbers"),
        (["go2"], {"frames": ["FL_fot"]}, tw.NameNotFound, "unknown frame 'FL_fot'"),
        (["go2"], {"contacts": ["FL_fot"]}, tw.NameNotFound, "unknown frame 'FL_fot'"),
        (["go2"], {"contacts": "FL_foot"}, ValueError, "['FL_foot'] is one"),
        (["go2"], {"forces": np.zeros((3, 3))}, tw.ShapeError, "forces: expected shape (..., 4, 3), got (3, 3)"),
        (["go2"], {"forces": np.zeros((2, 4, 3))}, tw.ShapeError, "forces: expected shape (4, 3), got (2, 4, 3)"),
        (["go2"], {"t": [0.0]}, ValueError, "t: a single configuration has no times"),
        (
            ["pendulum", [[0.0], [1.0]]],
            {"t": [1.0, 0.0], "backend": "browser"},
            ValueError,
            "t: expected times that grow",
        ),
        (["pendulum", [[0.0], [1.0]]], {"t": [1.0], "backend": "browser"}, tw.ShapeError, "t: expected shape (..., 2)"),
        (["go2"], {"meshes": False}, ValueError, "meshes: matplotlib draws none"),
        (["go2"], {"ax": 1, "backend": "browser"}, ValueError, "ax: means nothing in the browser"),
    ],
)
def test_what_cannot_be_shown_is_said(arguments, options, error, said):
    with pytest.raises(error, match=re.escape(said)):
        tw.view(*arguments, **options)


# ---------------------------------------------------------------- the command line


def test_meshes_without_their_reader_say_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "yourdfpy", None)
    with pytest.raises(ModuleNotFoundError, match=r'yourdfpy, .* "twistwrench\[view\]"; meshes=False draws sticks'):
        shapes(shared("planar_arm"), find("planar_arm").path)


@pytest.mark.slow
def test_the_command_writes_a_picture(tmp_path):
    assert main(["view", "go2", "--output", str(tmp_path / "go2.png")]) == 0
    assert (tmp_path / "go2.png").read_bytes().startswith(b"\x89PNG")


def test_the_command_takes_postures_frames_contacts_and_a_base(tmp_path, monkeypatch):
    seen = {}
    monkeypatch.setattr("twistwrench.viewing.viewer.view", lambda *args, **how: seen.update(args=args, **how))
    monkeypatch.setattr(Figure, "savefig", lambda *args, **how: None)
    words = "view go2 --base fixed --frame base --frame FL_foot --contact FL_foot --contact FL_foot --posture standing"
    assert main([*words.split(), "--output", str(tmp_path / "x.svg")]) == 0
    model, q = seen["args"]
    assert (model.base, seen["frames"], seen["contacts"]) == ("fixed", ["base", "FL_foot"], ["FL_foot"])
    np.testing.assert_array_equal(q, model.postures["standing"])


def test_the_command_shows_bodies_that_cannot_exist(tmp_path):
    text = find("pendulum").path.read_text(encoding="utf-8")
    path = tmp_path / "robot.urdf"
    path.write_text(re.sub(r'ixx="[^"]*"', 'ixx="100"', text), encoding="utf-8")
    with pytest.raises(tw.ModelError, match="triangle inequality"):
        tw.load(path, physical=True)
    assert main(["view", str(path), "--output", str(tmp_path / "robot.png")]) == 0


def test_the_command_writes_a_page(tmp_path):
    pytest.importorskip("viser", reason="viser is not installed: the browser is not checked")
    assert main(["view", "pendulum", "--output", str(tmp_path / "p.html")]) == 0
    assert "__VISER_EMBED_DATA__" in (tmp_path / "p.html").read_text(encoding="utf-8")


def test_the_command_serves_the_page_until_it_is_interrupted(monkeypatch, capsys):
    pytest.importorskip("viser", reason="viser is not installed: the browser is not checked")
    from urllib.request import urlopen

    pages = []

    def look(url):
        with urlopen(url, timeout=10) as answer:
            pages.append((url, answer.read(100)))

    def interrupt(seconds):
        raise KeyboardInterrupt

    monkeypatch.setattr("webbrowser.open", look)
    monkeypatch.setattr("twistwrench.viewing.commands.time", SimpleNamespace(sleep=interrupt))
    assert main(["view", "pendulum", "--browser"]) == 130
    ((url, text),) = pages
    assert b"<!doctype html>" in text
    assert capsys.readouterr().out == f"{url}  (Ctrl-C ends it)\n"
    with pytest.raises(OSError, match="refused"):
        urlopen(url, timeout=10)


def test_the_command_opens_a_window(monkeypatch):
    import matplotlib.pyplot as plt

    shown = []
    monkeypatch.setattr(plt, "get_backend", lambda: "TkAgg")
    monkeypatch.setattr(plt, "show", lambda: shown.append(plt.gcf().axes[0].get_legend_handles_labels()[1]))
    try:
        assert main(["view", "go2"]) == 0
    finally:
        plt.close("all")
    assert shown == [["centre of mass", "support polygon", "force of the ground"]]


def test_the_command_says_what_it_cannot_do(tmp_path, capsys, monkeypatch):
    with pytest.raises(SystemExit):
        main(["view", "go2", "--output", "go2.gif"])
    assert "expected a name in .png, .svg, .pdf or .html, got go2.gif" in capsys.readouterr().err
    assert main(["view", "go2", "--posture", "lying", "--output", str(tmp_path / "x.png")]) == 2
    assert "unknown posture 'lying' of 'go2'; known: 'standing'" in capsys.readouterr().err
    monkeypatch.setattr("matplotlib.pyplot.get_backend", lambda: "agg")
    assert main(["view", "go2"]) == 2
    assert "--output FILE writes a picture" in capsys.readouterr().err


# ---------------------------------------------------------------- docs/view.md


@pytest.mark.slow
def test_the_part_of_the_page_that_needs_a_browser_runs_too(tmp_path, monkeypatch):
    pytest.importorskip("viser", reason="viser is not installed: the browser is not checked")
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"^```py\n(.*?)^```$", page("view").read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    model = shared("go2")
    exec(code, {"tw": tw, "trot": motions.trot(model, samples=4)})
    assert (tmp_path / "trot.html").stat().st_size > 500_000


@pytest.mark.slow
def test_the_page_runs_prints_what_it_shows_and_is_the_same_in_both_languages(capsys):
    import matplotlib.pyplot as plt

    texts = [page("view", language).read_text(encoding="utf-8") for language in ("", ".zh-CN")]
    code, twin = ([re.sub(r" *#.*", "", block) for block in FENCE.findall(text)] for text in texts)
    assert code == twin
    try:
        trace = run(page("view"), FENCE.findall(texts[0]))["trace"]
    finally:
        plt.close("all")
    for text in texts:
        tree, account = re.findall(r"^```text\n(.*?)\n```$", text, re.MULTILINE | re.DOTALL)
        assert trace.tree() == tree
        assert account in str(trace)
        assert re.findall(r"!\[.+\]\(pictures/view_(\w+).png\)", text) == ["go2", "soles", "page", "trot"]
    assert capsys.readouterr().out == trace.tree() + "\n"
    assert all(names_author_and_licence(page("view", language)) for language in ("", ".zh-CN"))

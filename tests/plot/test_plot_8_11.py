"""The pictures of sections 49.8 to 49.11: the right numbers in them."""

import numpy as np
import pytest

import twistwrench as tw

matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed: the pictures are not checked")
from matplotlib.figure import Figure  # noqa: E402

from twistwrench import plot  # noqa: E402

MODEL = tw.load("go2")
Q = MODEL.standing()


@pytest.fixture
def space():
    return Figure().add_subplot(projection="3d")


@pytest.fixture
def flat():
    return Figure().add_subplot()


def curve(line):
    """Return the points of a line in space."""
    return np.stack(line.get_data_3d(), axis=-1)


def random_postures():
    rng = np.random.default_rng(1)
    return np.array([MODEL.random_configuration(rng=rng) for _ in range(10)])


@pytest.mark.parametrize(
    ("draw", "fixture"),
    [
        (lambda ax: plot.mass_matrix(MODEL, tw.crba(MODEL, Q), ax=ax), "flat"),
        (lambda ax: plot.fill_in(MODEL, ax=ax), "flat"),
        (lambda ax: plot.side_view(MODEL, Q, ax=ax), "flat"),
        (lambda ax: plot.top_view(MODEL, Q, ax=ax), "flat"),
        (lambda ax: plot.support_polygon(np.eye(3), [0, 0, 1], ax=ax), "space"),
        (lambda ax: plot.foot_forces(MODEL, Q, np.ones((4, 3)), ax=ax), "space"),
    ],
)
def test_a_picture_is_drawn_on_the_axes_given(draw, fixture, request):
    ax = request.getfixturevalue(fixture)
    assert draw(ax) is ax
    assert ax.figure.axes == [ax]


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (lambda ax: plot.support_polygon(np.zeros((0, 3)), ax=ax), "points: expected shape .* n of at least 1, got"),
        (lambda ax: plot.support_polygon([0, 0, 0], ax=ax), r"points: expected shape .*, got \(3,\)"),
        (lambda ax: plot.support_polygon(np.eye(3), np.eye(3), ax=ax), r"com: expected shape \(3,\), got \(3, 3\)"),
        (lambda ax: plot.foot_forces(MODEL, Q, np.eye(3), "FL_foot", ax=ax), "contacts: expected a sequence of frame"),
        (lambda ax: plot.foot_forces(MODEL, Q, np.ones((2, 4, 3)), ax=ax), r"forces: expected shape \(4, 3\), got"),
    ],
)
def test_what_cannot_be_drawn_is_named(draw, said, space):
    with pytest.raises(ValueError, match=said):
        draw(space)


def test_contacts_may_come_from_an_iterator(space):
    plot.foot_forces(MODEL, Q, np.ones((4, 3)), iter(MODEL.feet), ax=space)
    assert len(space.texts) == 4


# ---------------------------------------------------------------- the mass matrix


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_off_the_branch_the_mass_matrix_is_zero_and_on_it_hardly_ever(base):
    for seed in range(5):
        model = tw.random_tree(8, rng=seed, base=base)
        M = tw.crba(model, model.random_configuration(rng=seed))
        branch = plot.same_branch(model)
        assert not M[~branch].any()
        between = branch.copy()  # a planar joint has zeros of its own between its entries, a free-flyer as well
        for s in model.v_slice:
            between[s, s] = False
        assert (M[between] != 0).mean() > 0.8


def test_the_branches_of_a_chain_are_all_one():
    assert plot.same_branch(tw.chain(5)).all()


def test_a_mass_matrix_shows_the_largest_of_each_entry_with_its_sign(flat):
    many = tw.crba(MODEL, random_postures())
    plot.mass_matrix(MODEL, many, ax=flat)
    shade = flat.images[0].get_array()
    largest = np.abs(many).max(axis=0)
    np.testing.assert_allclose(
        np.abs(shade.filled(0)) ** 3, np.where(largest > 1e-12, largest / largest.max(), 0), atol=1e-12
    )
    signed = np.where(many.max(axis=0) == largest, 1, -1)
    shown = largest > 1e-12
    np.testing.assert_array_equal(np.sign(shade.filled(0))[shown], signed[shown])
    assert "full colour" in flat.get_xlabel()  # what the colours mean, and nothing of orders of elimination


def test_dots_mark_the_zeros_that_the_tree_does_not_explain(flat):
    many = tw.crba(MODEL, random_postures())
    plot.mass_matrix(MODEL, many, ax=flat)
    (dots,) = [line for line in flat.lines if line.get_marker() == "."]
    squares = {(int(row), int(column)) for column, row in dots.get_xydata()}
    assert len(squares) == 20
    assert {(0, 3), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5), (3, 6), (3, 9), (3, 12), (3, 15)} < squares
    assert squares == {(column, row) for row, column in squares}
    assert all((np.abs(many[:, row, column]) < 1e-12).all() for row, column in squares)


@pytest.mark.parametrize("name", ["go2", "humanoid", "planar_arm"])
def test_each_joint_stands_at_its_row_right_of_the_one_that_carries_it(name, flat):
    model = tw.load(name)
    plot.mass_matrix(model, np.eye(model.nv), ax=flat)
    place = {text.get_text(): np.array(text.get_position()) for text in flat.texts}
    names = [joint.removesuffix("_joint") for joint in model.joint_names]
    for i in range(1, model.nbodies):
        rows = np.arange(model.nv)[model.v_slice[i]]
        assert place[names[i]][1] == rows.mean()
        assert place[names[i]][0] < -1  # left of the matrix
        if model.parent[i]:
            assert place[names[i]][0] == pytest.approx(place[names[model.parent[i]]][0] + 0.9)


@pytest.mark.parametrize("seed", range(4))
def test_what_is_filled_in_is_what_numpys_cholesky_fills_in(seed, flat):
    model = tw.random_tree(8, rng=seed, base="floating")
    filled = plot.filled_in(model)
    M = tw.crba(model, model.random_configuration(rng=seed))
    off = np.tril(~plot.same_branch(model))
    assert filled[off].sum() == np.count_nonzero(np.linalg.cholesky(M)[off]) > 0
    plot.fill_in(model, ax=flat)
    grey, orange = (line.get_xydata().astype(int) for line in flat.lines[:2])
    assert {(r, c) for c, r in orange} == set(zip(*np.nonzero(filled), strict=True))
    assert {(r, c) for c, r in grey} == set(zip(*np.nonzero(np.tril(plot.same_branch(model))), strict=True))


def test_a_mass_matrix_of_another_robot_is_refused(flat):
    with pytest.raises(tw.ShapeError, match=r"M: expected shape \(\.\.\., 18, 18\)"):
        plot.mass_matrix(MODEL, np.eye(12), ax=flat)


# ---------------------------------------------------------------- feet on the ground


def test_the_hull_is_a_convex_polygon_around_all_points():
    rng = np.random.default_rng(2)
    points = rng.standard_normal((60, 3))
    corners = plot.hull(points)
    assert {tuple(c) for c in corners} < {tuple(p) for p in points}
    sides = np.roll(corners, -1, axis=0)[:, :2] - corners[:, :2]
    to_points = points[None, :, :2] - corners[:, None, :2]
    left = sides[:, None, 0] * to_points[..., 1] - sides[:, None, 1] * to_points[..., 0]
    assert left.min() > -1e-12  # every point is on the left of every side, or on it
    assert (left > 1e-12).sum() == len(corners) * 60 - 2 * len(corners)  # on it are its two ends only


@pytest.mark.parametrize("points", [[[0, 0], [0, 0], [0, 0]], [[0, 0], [1, 1], [2, 2], [1, 1]]])
def test_the_hull_of_points_on_a_line_is_its_two_ends(points):
    corners = plot.hull(points)
    np.testing.assert_array_equal(corners, np.unique([np.min(points, 0), np.max(points, 0)], axis=0))


def test_the_plumb_line_leads_from_the_centre_of_mass_to_the_floor(space):
    corners, com = np.array([[0, 0, 0.1], [1, 0, 0.1], [0, 1, 0.1], [1, 1, 0.1]]), np.array([0.4, 0.3, 0.8])
    plot.support_polygon(corners, com, label="polygon", ax=space)
    outline, plumb, foot = space.lines
    np.testing.assert_array_equal(curve(outline), np.append(plot.hull(corners), [[0, 0, 0.1]], axis=0))
    np.testing.assert_allclose(curve(plumb), [com, [0.4, 0.3, 0.1]], rtol=1e-12)
    np.testing.assert_allclose(curve(foot), [[0.4, 0.3, 0.1]], rtol=1e-12)
    assert space.get_legend_handles_labels()[1] == ["polygon"]


def test_the_polygon_of_two_feet_is_a_line(space):
    plot.support_polygon([[0, 0, 0], [1, 0, 0]], ax=space)
    assert len(space.lines) == 1
    assert not space.collections


def test_foot_forces_start_at_the_feet_and_are_written_beside_them(space):
    forces = np.arange(12.0).reshape(4, 3)
    plot.foot_forces(MODEL, Q, forces, scale=0.01, ax=space)
    feet = np.array([tw.frame_placement(MODEL, Q, foot).translation for foot in MODEL.feet])
    assert [text.get_text().strip() for text in space.texts] == ["2.0 N", "5.0 N", "8.0 N", "11.0 N"]
    np.testing.assert_allclose([t.get_position_3d() for t in space.texts], feet + 0.01 * forces, atol=1e-12)


def test_foot_forces_act_on_the_contacts_that_are_named(space):
    plot.foot_forces(MODEL, Q, [[0, 0, 7.0]], ["RL_foot"], scale=0.0, ax=space)
    np.testing.assert_allclose(
        space.texts[0].get_position_3d(), tw.frame_placement(MODEL, Q, "RL_foot").translation, atol=1e-12
    )
    with pytest.raises(tw.ShapeError, match="forces"):
        plot.foot_forces(MODEL, Q, np.ones((3, 3)), ax=space)


# ---------------------------------------------------------------- from the side


def test_a_side_view_shows_x_and_z_and_is_shifted(flat):
    q = MODEL.random_configuration(rng=3)
    plot.side_view(MODEL, q, shift=2.0, ax=flat)
    drawn = {tuple(line.get_xydata().ravel().round(9)) for line in flat.lines[:-1]}
    sticks = plot.sticks(MODEL, q)[..., [0, 2]] + [2.0, 0]
    assert drawn == {tuple(stick.ravel().round(9)) for stick in sticks}
    com = tw.center_of_mass(MODEL, q)
    np.testing.assert_allclose(flat.lines[-1].get_xydata(), [[com[0] + 2, com[2]]], rtol=1e-12)


def test_the_sides_are_the_robots_own_wherever_it_stands_and_however_it_moves():
    def colours(q):
        ax, sticks = plot.side_view(MODEL, q, com=False, ax=Figure().add_subplot()), plot.sticks(MODEL, q)
        order = np.argsort(-sticks[..., 1].mean(axis=-1))  # the far ones are drawn first
        drawn = dict(zip(order, ax.lines))
        assert all((line.get_xydata() == sticks[k][:, [0, 2]]).all() for k, line in drawn.items())
        return [drawn[k].get_color() for k in range(len(sticks))]

    here = colours(Q)
    assert here.count(plot.COLOURS["blue"]) == here.count(plot.COLOURS["vermilion"]) == 6
    aside, turned = Q.copy(), MODEL.integrate(Q, np.r_[0, 0, np.pi, np.zeros(15)])
    aside[1] = 1.0
    assert colours(aside) == here
    assert colours(turned) == here
    for q in tw.motions.walk(MODEL, samples=8).q:
        assert colours(q) == here


def test_a_force_reads_as_zero_only_where_it_is(space):
    plot.foot_forces(MODEL, Q, np.diag([0, 0, 1.0])[[0, 2, 2, 2]] * [[1], [0.004], [1e-7], [123.45]], ax=space)
    assert [text.get_text().strip() for text in space.texts] == ["0 N", "0.004 N", "1e-07 N", "123.5 N"]


def test_a_mass_matrix_of_a_tiny_robot_has_no_more_zeros(flat):
    M = tw.crba(MODEL, Q)
    plot.mass_matrix(MODEL, 1e-15 * M, ax=flat)
    shade = flat.images[0].get_array()
    big = Figure().add_subplot()
    plot.mass_matrix(MODEL, M, ax=big)
    np.testing.assert_allclose(shade.filled(0), big.images[0].get_array().filled(0), rtol=1e-9)


def test_near_and_far_legs_have_their_own_colours_and_the_near_ones_are_in_front(flat):
    plot.side_view(MODEL, Q, com=False, ax=flat)
    colours = [line.get_color() for line in flat.lines]
    assert colours == [plot.COLOURS["blue"]] * 6 + [plot.COLOURS["grey"]] * 4 + [plot.COLOURS["vermilion"]] * 6


# ---------------------------------------------------------------- from above


def test_a_top_view_shows_x_and_y_of_the_legs_and_the_trunk_between_the_hips(flat):
    q = MODEL.random_configuration(rng=3)
    plot.top_view(MODEL, q, ax=flat)
    T = tw.forward_kinematics(MODEL, q).placement
    hips = [i for i in range(2, MODEL.nbodies) if MODEL.parent[i] == 1]
    drawn = {tuple(line.get_xydata().ravel().round(9)) for line in flat.lines}
    legs = [s for s in plot.sticks(MODEL, q) if not np.allclose(s[0], T[1].translation)]
    assert drawn == {tuple(stick[:, :2].ravel().round(9)) for stick in legs}
    outline = flat.patches[0].get_xy()
    assert all(np.isclose(outline, T[i].translation[:2]).all(axis=1).any() for i in hips)


@pytest.mark.parametrize("name", ["go2", "humanoid"])
def test_the_wedge_of_a_top_view_points_where_the_robot_looks(name):
    model = tw.load(name)
    for yaw in (0.0, 2.0, -1.5):
        q = model.standing()
        q[:2], q[3:7] = (3, -1), [0, 0, np.sin(yaw / 2), np.cos(yaw / 2)]
        ax = plot.top_view(model, q, ax=Figure().add_subplot())
        left, tip, right, *_ = ax.patches[1].get_xy()
        ahead = tip - (left + right) / 2
        np.testing.assert_allclose(ahead / np.linalg.norm(ahead), [np.cos(yaw), np.sin(yaw)], atol=1e-12)
        assert np.cross([*ahead, 0], [*(left - right), 0])[2] > 0  # x ahead, y to the left


@pytest.mark.parametrize("name", ["planar_arm", "cart_pole"])
def test_a_top_view_of_a_robot_that_is_bolted_down_has_all_its_sticks_and_no_trunk(name):
    model = tw.load(name)
    ax = plot.top_view(model, model.neutral(), ax=Figure().add_subplot())
    assert len(ax.lines) == len(plot.sticks(model, model.neutral()))
    assert not ax.patches

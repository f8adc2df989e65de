"""The pictures: drawn on the axes that were given, with the right numbers in them."""

import numpy as np
import pytest

import twistwrench as tw

matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed: the pictures are not checked")
from matplotlib.figure import Figure  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Line3DCollection  # noqa: E402

from twistwrench import plot  # noqa: E402

MODEL = tw.load("go2")
Q = MODEL.standing()
V = np.array([0.1, -0.2, 0.8, 0.3, 0.5, -0.2])


@pytest.fixture
def space():
    return Figure().add_subplot(projection="3d")


@pytest.fixture
def flat():
    return Figure().add_subplot()


def lines(ax):
    """Return the corners of every line that was drawn."""
    return [np.stack(line.get_data_3d(), axis=-1) for line in ax.lines]


def shafts(ax):
    """Return start and tip of every arrow: matplotlib draws all shafts, from the tips, then two heads for each."""
    drawn = [c._segments3d for c in ax.collections if isinstance(c, Line3DCollection)]
    return [np.asarray(s)[::-1] for segments in drawn for s in segments[: len(segments) // 3]]


# ---------------------------------------------------------------- axes


@pytest.mark.parametrize(
    "draw",
    [
        plot.axes_3d,
        lambda ax: plot.triad(tw.SE3.identity(), ax=ax),
        lambda ax: plot.arrows([0, 0, 0], [0, 0, 1], ax=ax),
        lambda ax: plot.robot(MODEL, Q, ax=ax),
        lambda ax: plot.screw_axis(V, ax=ax),
        lambda ax: plot.twist_field(V, np.eye(3), ax=ax),
        lambda ax: plot.fit(plot.axes_3d(ax), np.eye(3)),
    ],
)
def test_a_picture_is_drawn_on_the_axes_given(draw, space):
    figure = space.figure
    assert draw(space) is space
    assert figure.axes == [space]
    assert (space.get_xlabel(), space.get_ylabel(), space.get_zlabel()) == ("x [m]", "y [m]", "z [m]")


def test_a_picture_makes_its_own_axes_where_none_are_given():
    import matplotlib.pyplot as plt

    with matplotlib.rc_context({"backend": "Agg"}):
        spatial, plain = plot.robot(MODEL, Q), plot.matrix(np.eye(6))
    assert spatial.name == "3d"
    assert plain.name == "rectilinear"
    assert spatial.figure is not plain.figure
    plt.close("all")


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (lambda ax: plot.arrows(np.eye(3), np.eye(3), texts=["a"], ax=ax), "texts: expected one for each of 3 arrows"),
        (lambda ax: plot.robot(MODEL, Q, frames="FL_foot", ax=ax), "frames: expected a sequence of frame names"),
        (lambda ax: plot.screw_axis(V, near=np.eye(3), ax=ax), r"near: expected shape \(3,\), got \(3, 3\)"),
        (lambda ax: plot.matrix(np.eye(2), limit=-1, ax=ax), "limit: expected a number above zero, got -1"),
        (lambda ax: plot.matrix(np.eye(2), limit=0, ax=ax), "limit: expected a number above zero, got 0"),
    ],
)
def test_what_cannot_be_drawn_is_named(draw, said, space):
    with pytest.raises(ValueError, match=said):
        draw(space)


def test_flat_axes_are_refused_for_a_picture_of_space(flat):
    with pytest.raises(TypeError, match="projection='3d'"):
        plot.robot(MODEL, Q, ax=flat)


def test_a_metre_is_a_metre_in_every_direction(space):
    plot.robot(MODEL, Q, ax=space)
    plot.arrows([0, 0, 0.3], [0, 0, 1], ax=space)
    spans = [np.ptp(space.get_xlim()), np.ptp(space.get_ylim()), np.ptp(space.get_zlim())]
    ratio = space._box_aspect / spans
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-12)


def test_what_was_drawn_first_stays_in_the_picture(space):
    plot.robot(MODEL, Q, ax=space)
    plot.arrows([5, 0, 0], [0, 0, 1], ax=space)
    everything = np.concatenate([*lines(space), [[5, 0, 0], [5, 0, 1]]])
    for lim, x in zip((space.get_xlim(), space.get_ylim(), space.get_zlim()), everything.T):
        assert lim[0] <= x.min()
        assert x.max() <= lim[1]


# ---------------------------------------------------------------- frames, arrows


def test_a_triad_shows_the_columns_of_the_rotation(space):
    T = tw.exp6(V)
    plot.triad(T, "B", size=0.25, ax=space)
    for k, line in enumerate(lines(space)):
        np.testing.assert_allclose(line[0], T.translation, rtol=1e-12)
        np.testing.assert_allclose((line[1] - line[0]) / 0.25, T.rotation[:, k], rtol=0, atol=1e-12)
    assert [line.get_color() for line in space.lines] == list(plot.XYZ)
    np.testing.assert_allclose(space.texts[0].get_position_3d(), T.translation, rtol=1e-12)


def test_a_triad_of_a_batch_is_refused(space):
    with pytest.raises(tw.ShapeError, match=r"got a batch of shape \(2,\)"):
        plot.triad(tw.exp6(np.stack([V, V])), ax=space)


def test_arrows_go_from_their_points_along_the_vectors(space):
    rng = np.random.default_rng(1)
    points, vectors = rng.standard_normal((2, 4, 3))
    plot.arrows(points, vectors, scale=0.1, texts=["a", "b", "c", "d"], ax=space)
    drawn = shafts(space)
    assert len(drawn) == 4
    np.testing.assert_allclose([s[0] for s in drawn], points, atol=1e-12)
    np.testing.assert_allclose([s[1] for s in drawn], points + 0.1 * vectors, atol=1e-12)
    np.testing.assert_allclose([t.get_position_3d() for t in space.texts], points + 0.1 * vectors, atol=1e-12)


def test_arrows_that_do_not_fit_their_points_are_refused(space):
    with pytest.raises(tw.ShapeError, match="do not broadcast"):
        plot.arrows(np.zeros((2, 3)), np.zeros((3, 3)), ax=space)


# ---------------------------------------------------------------- robots


def test_sticks_lead_from_the_base_to_the_feet():
    sticks = plot.sticks(MODEL, Q)
    placement = tw.forward_kinematics(MODEL, Q).placement
    starts = {tuple(p.round(9)) for p in sticks[:, 0]}
    assert starts == {tuple(T.translation.round(9)) for T in placement[1:]}
    tips = {tuple(p.round(9)) for p in sticks[:, 1]} - starts
    assert tips == {tuple(tw.frame_placement(MODEL, Q, foot).translation.round(9)) for foot in MODEL.feet}


@pytest.mark.parametrize("name", ["pendulum", "double_pendulum", "planar_arm", "cart_pole", "humanoid"])
def test_the_sticks_of_one_robot_hang_together(name):
    model = tw.load(name)
    sticks = plot.sticks(model, model.neutral())
    tips = len(set(range(1, model.nbodies)) - set(model.parent))
    assert len(sticks) == model.nbodies - (2 if model.base == "floating" else 1) + tips
    ends = np.concatenate([sticks[:, 1], sticks[:1, 0], np.zeros((1, 3))])
    for start in sticks[:, 0]:
        assert np.abs(ends - start).max(axis=-1).min() < 1e-12


def test_a_robot_is_drawn_where_it_is(space):
    plot.robot(MODEL, Q, frames=["FR_foot"], ax=space)
    *sticks, joints, com = lines(space)
    np.testing.assert_allclose(sticks, plot.sticks(MODEL, Q), rtol=1e-12)
    np.testing.assert_allclose(joints, plot.sticks(MODEL, Q)[:, 0], rtol=1e-12)
    np.testing.assert_allclose(com[0], tw.center_of_mass(MODEL, Q), rtol=1e-12)
    foot = tw.frame_placement(MODEL, Q, "FR_foot").translation
    np.testing.assert_allclose(space.texts[0].get_position_3d(), foot, rtol=1e-12)


def test_the_centre_of_mass_can_be_left_out(space):
    plot.robot(MODEL, Q, com=False, ax=space)
    assert len(space.lines) == len(plot.sticks(MODEL, Q)) + 1


def test_a_batch_of_configurations_is_refused():
    with pytest.raises(tw.ShapeError, match=r"expected one real configuration, shape \(19,\), got .*\(2, 19\)"):
        plot.sticks(MODEL, np.stack([Q, Q]))


# ---------------------------------------------------------------- screws


def test_points_on_the_drawn_axis_move_along_it_with_the_pitch(space):
    plot.screw_axis(V, length=2.0, ax=space)
    ends, (middle,) = lines(space)
    np.testing.assert_allclose(ends.mean(axis=0), middle, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(ends[1] - ends[0]), 2.0, rtol=1e-12)
    along = tw.screw(V).pitch * V[:3]
    for point in (*ends, middle):
        np.testing.assert_allclose(V[3:] + np.cross(V[:3], point), along, atol=1e-12)


def test_the_drawn_axis_is_centred_near_what_is_looked_at(space):
    near = np.array([0.4, -0.3, 2.0])
    plot.screw_axis(V, near=near, ax=space)
    ends, (middle,) = lines(space)
    np.testing.assert_allclose(ends.mean(axis=0), middle, atol=1e-12)
    assert abs((near - middle) @ (ends[1] - ends[0])) < 1e-12
    np.testing.assert_allclose(V[3:] + np.cross(V[:3], middle), tw.screw(V).pitch * V[:3], atol=1e-12)


def test_the_axes_of_many_twists_at_once_are_refused(space):
    with pytest.raises(tw.ShapeError, match=r"expected one twist, got a batch of shape \(2,\)"):
        plot.screw_axis(np.stack([V, V]), ax=space)


def test_the_field_of_a_twist_is_the_rate_of_what_it_moves(space):
    rng = np.random.default_rng(2)
    points = rng.standard_normal((5, 3))
    moved = tw.exp6(1e-100j * V)  # the complex step: exact derivatives
    rate = np.array([moved.act(p).imag for p in points]) / 1e-100
    np.testing.assert_allclose(plot.point_velocity(V, points), rate, rtol=1e-12)
    plot.twist_field(V, points, scale=0.5, ax=space)
    np.testing.assert_allclose([s[1] - s[0] for s in shafts(space)], 0.5 * rate, atol=1e-12)


# ---------------------------------------------------------------- matrices


def test_a_matrix_is_white_where_it_is_zero_and_coloured_by_its_sign(flat):
    A = np.array([[0.0, 8.0], [-1.0, 1e-6]])
    plot.matrix(A, "A", rows="ab", columns="cd", lines=(1,), numbers="g", ax=flat)
    (image,) = flat.images
    shown = image.get_array()
    np.testing.assert_array_equal(np.ma.getmaskarray(shown), A == 0)
    np.testing.assert_allclose(shown.filled(0), np.cbrt(A / 8), rtol=1e-12)
    assert image.get_clim() == (-1, 1)
    assert {t.get_position(): t.get_text() for t in flat.texts} == {(1, 0): "8", (0, 1): "-1", (1, 1): "1e-06"}
    assert [t.get_text() for t in flat.get_yticklabels()] == ["a", "b"]
    assert [t.get_text() for t in flat.get_xticklabels()] == ["c", "d"]


def test_the_limit_of_a_matrix_scales_its_colours(flat):
    plot.matrix(np.eye(2), limit=8.0, ax=flat)
    assert flat.images[0].get_array()[0, 0] == pytest.approx(0.5)


def test_what_rounding_left_of_a_zero_can_be_drawn_as_zero(flat):
    plot.matrix([[1.0, -1e-17], [1e-11, 0.0]], rounding=1e-12, numbers="g", ax=flat)
    np.testing.assert_array_equal(np.ma.getmaskarray(flat.images[0].get_array()), [[False, True], [False, True]])
    assert [t.get_text() for t in flat.texts] == ["1", "1e-11"]


def test_names_that_are_not_as_many_as_the_rows_are_refused(flat):
    with pytest.raises(tw.ShapeError, match="do not go together"):
        plot.matrix(np.eye(2), rows=["one"], ax=flat)
    with pytest.raises(tw.ShapeError, match="do not go together"):
        plot.matrix(np.zeros(3), ax=flat)

"""The pictures of sections 49.4 to 49.7: the right numbers in them."""

import numpy as np
import pytest

import twistwrench as tw

matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed: the pictures are not checked")
from matplotlib.figure import Figure  # noqa: E402

from twistwrench import plot  # noqa: E402

MODEL = tw.load("go2")
Q = MODEL.standing()
CORNERS = np.array([[0.1, 0.04, 0], [0.1, -0.04, 0], [-0.06, -0.04, 0], [-0.06, 0.04, 0]])


@pytest.fixture
def space():
    return Figure().add_subplot(projection="3d")


@pytest.fixture
def flat():
    return Figure().add_subplot()


def curve(line):
    """Return the points of a line in space."""
    return np.stack(line.get_data_3d(), axis=-1)


def corners(surface):
    """Return the corners of all patches of a surface."""
    return np.concatenate([np.asarray(face) for face in surface._faces])


def body(rng):
    """Draw a body at random: a heap of twenty points."""
    mass, points = rng.uniform(0.1, 1, 20), rng.standard_normal((20, 3)) * [0.3, 0.2, 0.1]
    com = mass @ points / mass.sum()
    r = points - com
    return tw.SpatialInertia(mass.sum(), com, (mass[:, None, None] * tw.skew(r) @ tw.skew(r).mT).sum(0))


@pytest.mark.parametrize(
    ("draw", "fixture"),
    [
        (lambda ax: plot.friction_cone([0, 0, 0], 0.5, ax=ax), "space"),
        (lambda ax: plot.ellipsoid(MODEL.inertia[1], ax=ax), "space"),
        (lambda ax: plot.ellipsoids(MODEL, Q, ax=ax), "space"),
        (lambda ax: plot.sole(CORNERS, ax=ax), "flat"),
        (lambda ax: plot.apparent_mass_ellipse(MODEL.inertia[1].matrix(), ax=ax), "flat"),
        (lambda ax: plot.flow(MODEL, [""] * MODEL.nbodies, ax=ax), "flat"),
    ],
)
def test_a_picture_is_drawn_on_the_axes_given(draw, fixture, request):
    ax = request.getfixturevalue(fixture)
    assert draw(ax) is ax
    assert ax.figure.axes == [ax]


@pytest.mark.parametrize(
    ("draw", "fixture", "said"),
    [
        (lambda ax: plot.friction_cone(np.eye(3), 0.5, ax=ax), "space", r"point: expected shape \(3,\), got \(3, 3\)"),
        (lambda ax: plot.ellipsoids(MODEL, Q, names="hinge", ax=ax), "space", "names: expected a sequence of"),
        (lambda ax: plot.sole([CORNERS, CORNERS], ax=ax), "flat", r"corners: expected shape \(n, 3\), got \(2, 4, 3\)"),
        (lambda ax: plot.sole(CORNERS, np.ones((2, 6)), ax=ax), "flat", r"F: expected shape \(6,\), got \(2, 6\)"),
        (
            lambda ax: plot.apparent_mass_ellipse(np.ones((2, 6, 6)), ax=ax),
            "flat",
            r"inertia: expected shape \(6, 6\), got",
        ),
        (
            lambda ax: plot.apparent_mass_ellipse(np.eye(6), (1, 2, 3), ax=ax),
            "flat",
            r"at: expected shape \(..., 2\), got \(3,\)",
        ),
        (
            lambda ax: plot.apparent_mass_ellipse(np.eye(6), plane=(-1, -2), ax=ax),
            "flat",
            "plane: expected two of the axes",
        ),
        (
            lambda ax: plot.apparent_mass_ellipse(np.eye(6), plane=(2, 2), ax=ax),
            "flat",
            "plane: expected two of the axes",
        ),
    ],
)
def test_what_cannot_be_drawn_is_named(draw, fixture, said, request):
    with pytest.raises(ValueError, match=said):
        draw(request.getfixturevalue(fixture))


# ---------------------------------------------------------------- wrenches


def test_the_axis_of_a_wrench_is_drawn_and_not_that_of_the_twist_with_its_numbers(space):
    F = tw.Wrench([3.0, -2.0, 1.0, 0.0, 0.0, 20.0])
    plot.screw_axis(F, length=2.0, ax=space)
    ends = curve(space.lines[0])
    along, pitch = F.force, F.screw().pitch
    for point in ends:  # about a point of its axis the moment of a wrench is along its force
        np.testing.assert_allclose(F.moment - np.cross(point, F.force), pitch * along, atol=1e-12)
    np.testing.assert_allclose(ends[1] - ends[0], [0, 0, 2], atol=1e-12)


def test_a_wrench_has_no_tangential_moment_about_its_centre_of_pressure():
    F = np.random.default_rng(1).standard_normal((3, 1, 2, 6)) + 5 * np.eye(6)[5]
    p = plot.center_of_pressure(F)
    assert p.shape == (3, 1, 2, 3)
    about = F[..., :3] - np.cross(p, F[..., 3:])
    np.testing.assert_allclose(about[..., :2], 0, atol=1e-14)
    assert (p[..., 2] == 0).all()


def test_without_a_normal_force_there_is_no_centre_of_pressure():
    with pytest.raises(tw.SingularError, match="without a force along the normal"):
        plot.center_of_pressure([1, 0, 0, 5, 0, 0])


def test_a_twist_is_no_wrench_and_a_wrench_no_twist():
    with pytest.raises(TypeError, match="F: expected a Wrench or an array, got a Twist"):
        plot.center_of_pressure(tw.Twist([1, 0, 0, 0, 0, 1]))
    with pytest.raises(TypeError, match="V: expected a Twist or an array, got a Wrench"):
        plot.point_velocity(tw.Wrench([1, 0, 0, 0, 0, 1]), [0, 0, 0])
    with pytest.raises(TypeError, match="V: expected a Twist or an array, got a Wrench"):
        plot.twist_field([tw.Wrench([1, 0, 0, 0, 0, 1])], [0, 0, 0])


def test_a_friction_cone_stands_on_its_contact_and_opens_by_mu(space):
    p, mu = np.array([0.3, -0.2, 0.1]), 0.7
    plot.friction_cone(p, mu, height=0.2, label="cone", ax=space)
    rim = curve(space.lines[0]) - p
    np.testing.assert_allclose(np.hypot(rim[:, 0], rim[:, 1]), mu * rim[:, 2], rtol=1e-12)
    np.testing.assert_allclose(rim[:, 2], 0.2, rtol=1e-12)
    np.testing.assert_allclose(np.roll(rim[:-1], 24, axis=0)[:, :2], -rim[:-1, :2], atol=1e-12)  # all the way round
    (cone,) = space.collections
    drawn = corners(cone) - p
    np.testing.assert_allclose(np.hypot(drawn[:, 0], drawn[:, 1]), mu * drawn[:, 2], atol=1e-12)
    assert np.abs(drawn).sum(axis=1).min() < 1e-12  # down to the contact
    assert space.get_legend_handles_labels()[1] == ["cone"]


def test_a_sole_shows_the_centre_of_pressure_where_the_force_acts(flat):
    point, force = np.array([0.07, -0.03, 0]), np.array([2.0, 1.0, 90.0])
    plot.sole(CORNERS, np.concatenate([np.cross(point, force), force]), text="P", ax=flat)
    np.testing.assert_allclose(flat.lines[0].get_xydata(), [[point[1], point[0]]], rtol=1e-12)
    (outline,) = flat.patches
    np.testing.assert_allclose(outline.get_xy()[:4], CORNERS[:, [1, 0]])
    assert flat.texts[0].get_text() == "P"
    left, right = flat.get_xlim()
    assert left > right  # y to the left
    plot.sole(CORNERS, np.concatenate([np.cross(-point, force), force]), ax=flat)
    assert flat.get_xlim() == (left, right)


# ---------------------------------------------------------------- inertias


def test_the_ellipsoid_has_the_moments_of_the_body():
    inertia = body(np.random.default_rng(2))
    lengths, axes = plot.semi_axes(inertia)
    assert (np.diff(lengths) >= 0).all()
    square = inertia.mass / 5 * lengths**2  # second moments of a uniform ellipsoid
    moments = square.sum() - square
    np.testing.assert_allclose(axes @ np.diag(moments) @ axes.T, inertia.inertia_at_com, rtol=1e-12, atol=1e-13)


def test_a_thin_rod_is_an_ellipsoid_without_thickness():
    lengths, axes = plot.semi_axes(tw.SpatialInertia(3.0, [0, 0, 0], np.diag([0.25, 0.25, 0])))
    np.testing.assert_allclose(lengths, [0, 0, np.sqrt(5 / 12)], atol=1e-12)
    np.testing.assert_allclose(np.abs(axes[:, 2]), [0, 0, 1], atol=1e-12)


def test_an_impossible_body_has_no_ellipsoid(space):
    impossible = tw.SpatialInertia(1.0, [0, 0, 0], np.diag([1.0, 1.0, 10.0]))
    with pytest.raises(tw.ModelError, match=r"'plate'.*triangle"):
        plot.ellipsoid(impossible, name="plate", ax=space)


def test_an_ellipsoid_is_drawn_where_the_body_is(space):
    inertia, T = body(np.random.default_rng(3)), tw.exp6([0.3, -0.4, 0.5, 1.0, 2.0, 3.0])
    plot.ellipsoid(inertia, T, "B", ax=space)
    lengths, axes = plot.semi_axes(inertia)
    (surface,) = space.collections
    own = (T.inverse().act(corners(surface)) - inertia.com) @ axes  # along the principal axes
    np.testing.assert_allclose(((own / lengths) ** 2).sum(axis=1), 1, rtol=1e-9)
    assert np.abs(own).max(axis=0) == pytest.approx(lengths, rel=0.05)
    np.testing.assert_allclose(space.texts[0].get_position_3d(), T.act(inertia.com), rtol=1e-12)


def test_a_batch_of_bodies_has_no_one_ellipsoid():
    with pytest.raises(tw.ShapeError, match=r"got a batch of shape \(2,\)"):
        plot.semi_axes(tw.SpatialInertia([1.0, 2.0], [0, 0, 0], np.eye(3)))


def test_every_body_with_mass_has_its_ellipsoid_and_the_named_ones_a_name(space):
    plot.ellipsoids(MODEL, Q, names=["FR_calf_joint"], ax=space)
    assert len(space.collections) == MODEL.nbodies - 1
    assert [text.get_text() for text in space.texts] == ["FR_calf_joint"]
    i = MODEL.joint_id("FR_calf_joint")
    calf = tw.forward_kinematics(MODEL, Q).placement[i].act(MODEL.inertia[i].com)
    np.testing.assert_allclose(space.texts[0].get_position_3d(), calf, rtol=1e-12)


def test_bodies_without_mass_are_left_out(space):
    builder = tw.Builder("massless", base="fixed")
    builder.link("first", parent="base_link", joint=tw.Revolute("y"))
    builder.link("second", parent="first", joint=tw.Revolute("y"), inertia=tw.SpatialInertia(1, [0, 0, 1], np.eye(3)))
    plot.ellipsoids(builder.build(), [0.0, 0.0], ax=space)
    assert len(space.collections) == 1


def test_every_sole_that_is_drawn_has_its_own_corners(flat):
    plot.sole(CORNERS, ax=flat)
    plot.sole(2 * np.asarray(CORNERS), ax=flat)
    first, second = (patch.get_xy() for patch in flat.patches)
    np.testing.assert_array_equal(second, 2 * first)
    assert flat.xaxis.get_inverted()


def test_the_mass_of_a_rigid_body_is_felt_alike_in_every_direction(flat):
    inertia = body(np.random.default_rng(4))
    plot.apparent_mass_ellipse(inertia.matrix(), [1.0, 2.0], scale=0.1, ax=flat)
    radius = np.linalg.norm(flat.lines[0].get_xydata() - [1, 2], axis=1)
    np.testing.assert_allclose(radius, 0.1 * inertia.mass, rtol=1e-12)


def test_a_force_that_is_drawn_gives_the_unit_acceleration_it_is_drawn_for(flat):
    A = np.random.default_rng(5).standard_normal((6, 6))
    articulated = A @ A.T
    plot.apparent_mass_ellipse(articulated, plane=(1, 2), ax=flat)
    forces = flat.lines[0].get_xydata()
    accelerations = np.linalg.solve(articulated[4:, 4:], forces.T).T
    np.testing.assert_allclose(np.linalg.norm(accelerations, axis=1), 1, rtol=1e-9)


# ---------------------------------------------------------------- the tree


def test_every_body_has_a_seat_of_its_own_beyond_what_carries_it():
    for model in (MODEL, tw.load("humanoid"), tw.chain(4), tw.random_tree(15, rng=1)):
        seats = plot.tree_layout(model)
        assert len({tuple(seat) for seat in seats}) == model.nbodies
        for i in range(1, model.nbodies):
            assert seats[i, 0] == seats[model.parent[i], 0] + 1


def test_seats_of_the_legs_lie_on_either_side_of_the_base():
    seats = plot.tree_layout(MODEL)
    np.testing.assert_array_equal(seats[[0, 1]], [[0, -1.5], [1, -1.5]])
    np.testing.assert_array_equal(seats[[2, 5, 8, 11], 1], [0, -1, -2, -3])  # FL, FR, RL, RR from above


@pytest.mark.parametrize("inward", [False, True])
def test_the_arrows_of_a_pass_lead_its_way(inward, flat):
    amounts = np.arange(MODEL.nbodies)
    plot.flow(MODEL, [str(i) for i in range(MODEL.nbodies)], inward=inward, amounts=amounts, ax=flat)
    seats = plot.tree_layout(MODEL)
    assert len(flat.patches) == MODEL.nbodies - 1
    for i, arrow in enumerate(flat.patches, start=1):
        way = arrow._path_original.vertices  # ends at the tip
        assert (way[-1, 0] < way[0, 0]) == inward
        near, far = (way[-1], way[0]) if inward else (way[0], way[-1])
        assert 0 < near[0] - seats[MODEL.parent[i], 0] < 0.5
        assert 0 < seats[i, 0] - far[0] < 0.5
        assert near[1] == seats[MODEL.parent[i], 1]
        assert far[1] == seats[i, 1]
    widths = np.array([arrow.get_linewidth() for arrow in flat.patches])
    np.testing.assert_allclose(widths, 1 + 4 * np.sqrt(amounts[1:] / amounts.max()), rtol=1e-12)


def test_each_text_stands_at_its_arrow(flat):
    plot.flow(MODEL, [f"<{i}>" for i in range(MODEL.nbodies)], ax=flat)
    seats = plot.tree_layout(MODEL)
    places = {text.get_text(): np.array(getattr(text, "xy", text.get_position())) for text in flat.texts}
    for i in range(1, MODEL.nbodies):
        way = flat.patches[i - 1]._path_original.vertices
        np.testing.assert_allclose(places[f"<{i}>"], way[1:].mean(axis=0), rtol=1e-12)  # above the level part
    np.testing.assert_allclose(places["<0>"], seats[0] - [0, 0.45], rtol=1e-12)
    np.testing.assert_array_equal(places["base"], seats[1])
    np.testing.assert_array_equal(places["FL_hip"], seats[2])


def test_texts_and_amounts_that_are_not_as_many_as_the_bodies_are_refused(flat):
    with pytest.raises(tw.ShapeError, match="expected 14 of each, got 2"):
        plot.flow(MODEL, ["", ""], ax=flat)
    with pytest.raises(tw.ShapeError, match="amounts"):
        plot.flow(MODEL, [""] * 14, amounts=np.ones((2, 14)), ax=flat)

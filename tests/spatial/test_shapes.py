"""Bodies by shape: textbook moments, limits of one shape in another, sampled mass, Pinocchio, trimesh."""

from fractions import Fraction

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.spatial import SE3, SpatialInertia, exp3

CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
FACES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4]]
FACES += [[1, 5, 7], [1, 7, 3]]

SOLIDS = {  # a shape, the mean over it by sampling: what is inside of a box
    "box": (lambda: SpatialInertia.from_box(3.0, [2, 1, 1.5]), lambda p: (np.abs(p) <= [1, 0.5, 0.75]).all(-1)),
    "ellipsoid": (
        lambda: SpatialInertia.from_ellipsoid(3.0, [1, 0.5, 0.75]),
        lambda p: ((p / [1, 0.5, 0.75]) ** 2).sum(-1) <= 1,
    ),
    "sphere": (lambda: SpatialInertia.from_sphere(3.0, 0.8), lambda p: (p * p).sum(-1) <= 0.64),
    "cylinder": (
        lambda: SpatialInertia.from_cylinder(3.0, 0.5, 1.8),
        lambda p: (p[..., 0] ** 2 + p[..., 1] ** 2 <= 0.25) & (np.abs(p[..., 2]) <= 0.9),
    ),
    "capsule": (
        lambda: SpatialInertia.from_capsule(3.0, 0.4, 1.0),
        lambda p: p[..., 0] ** 2 + p[..., 1] ** 2 + np.maximum(np.abs(p[..., 2]) - 0.5, 0) ** 2 <= 0.16,
    ),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_the_moments_are_those_of_the_points_within(name):
    make, inside = SOLIDS[name]
    t = (np.arange(120) + 0.5) / 60 - 1  # the middles of 120 cells an axis
    grid = np.stack(np.meshgrid(t, t, t, indexing="ij"), axis=-1)
    p = grid[inside(grid)]
    spread = p.T @ p / len(p)
    expected = 3.0 * (np.trace(spread) * np.eye(3) - spread)
    # The surface cuts through cells of 1.7 cm: a thousandth of a moment.
    np.testing.assert_allclose(make().inertia_at_com, expected, rtol=0, atol=1e-3 * expected.max())


@pytest.mark.parametrize(
    ("body", "moments"),
    [  # Landau and Lifshitz, Mechanics, § 32, problem 2; Goldstein
        (SpatialInertia.from_rod(2.0, 3.0), [1.5, 1.5, 0]),  # m l²/12
        (SpatialInertia.from_sphere(5.0, 2.0), [8, 8, 8]),  # 2/5 m r²
        (SpatialInertia.from_shell(3.0, 2.0), [8, 8, 8]),  # 2/3 m r²
        (SpatialInertia.from_cylinder(4.0, 1.0, 3.0), [4, 4, 2]),  # m/4 (r² + l²/3), m r²/2
        (SpatialInertia.from_box(12.0, [1, 2, 3]), [13, 10, 5]),  # m/12 (b² + c²)
        (SpatialInertia.from_ellipsoid(5.0, [1, 2, 3]), [13, 10, 5]),  # m/5 (b² + c²)
    ],
)
def test_the_moments_of_the_textbooks(body, moments):
    np.testing.assert_allclose(body.inertia_at_com, np.diag(moments), rtol=0, atol=1e-15 * max(moments))
    np.testing.assert_array_equal(body.com, 0)


def test_each_shape_is_a_limit_of_another():
    capsule, cylinder = SpatialInertia.from_capsule, SpatialInertia.from_cylinder
    close = {"rtol": 0, "atol": 1e-15}
    np.testing.assert_allclose(capsule(2, 0.3, 0).matrix(), SpatialInertia.from_sphere(2, 0.3).matrix(), **close)
    np.testing.assert_allclose(capsule(2, 0, 0.8).matrix(), SpatialInertia.from_rod(2, 0.8).matrix(), **close)
    np.testing.assert_allclose(cylinder(2, 0, 0.8).matrix(), SpatialInertia.from_box(2, [0, 0, 0.8]).matrix(), **close)
    np.testing.assert_array_equal(capsule(2, 0, 0).matrix(), SpatialInertia.from_point(2).matrix())
    ball = SpatialInertia.from_ellipsoid(2, [0.3, 0.3, 0.3])
    np.testing.assert_allclose(ball.matrix(), SpatialInertia.from_sphere(2, 0.3).matrix(), **close)


def test_a_shell_is_the_difference_of_two_balls_that_are_nearly_equal():
    outer, inner = 1.0, 1.0 - 1e-6
    share = inner**3
    difference = SpatialInertia.from_sphere(1.0, outer) - SpatialInertia.from_sphere(share, inner)
    shell = SpatialInertia.from_shell(1 - share, outer)
    np.testing.assert_allclose(difference.matrix(), shell.matrix(), rtol=0, atol=1e-5 * (1 - share))


def test_two_halves_make_a_whole():
    half = SpatialInertia.from_box(1.5, [1, 2, 1.5])
    both = [half.transform(SE3(np.eye(3), [0, 0, z])) for z in (-0.75, 0.75)]
    np.testing.assert_allclose(sum(both).matrix(), SpatialInertia.from_box(3, [1, 2, 3]).matrix(), rtol=0, atol=1e-15)


def test_pinocchio_has_the_same_bodies():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    for ours, theirs in [
        (SpatialInertia.from_box(2, [0.3, 0.8, 0.5]), pin.Inertia.FromBox(2, 0.3, 0.8, 0.5)),
        (SpatialInertia.from_sphere(2, 0.3), pin.Inertia.FromSphere(2, 0.3)),
        (SpatialInertia.from_ellipsoid(2, [0.3, 0.8, 0.5]), pin.Inertia.FromEllipsoid(2, 0.3, 0.8, 0.5)),
        (SpatialInertia.from_cylinder(2, 0.3, 0.8), pin.Inertia.FromCylinder(2, 0.3, 0.8)),
        (SpatialInertia.from_capsule(2, 0.3, 0.8), pin.Inertia.FromCapsule(2, 0.3, 0.8)),
    ]:
        np.testing.assert_allclose(ours.inertia_at_com, theirs.inertia, rtol=0, atol=1e-15)


# --- meshes --------------------------------------------------------------------------------------


def test_a_cube_of_triangles_is_a_box_wherever_it_stands():
    R, p = exp3([0.3, -0.5, 0.2]), np.array([5.0, -3, 2])
    size = np.array([1, 2, 3])
    mesh = SpatialInertia.from_mesh(12.0, (CUBE * size / 2) @ R.T + p, FACES)
    box = SpatialInertia.from_box(12.0, size).transform(SE3(R, p))
    np.testing.assert_allclose(mesh.com, box.com, rtol=0, atol=4e-15)
    np.testing.assert_allclose(mesh.inertia_at_com, box.inertia_at_com, rtol=0, atol=1e-13)


def test_a_tetrahedron_has_the_moments_of_its_closed_form():
    corner = np.array([[0, 0, 0], [1.0, 0, 0], [0, 1, 0], [0, 0, 1]])
    body = SpatialInertia.from_mesh(20.0, corner, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    about_corner = body.matrix()[:3, :3]  # ∫ x² = m/10, ∫ xy = m/20
    np.testing.assert_allclose(about_corner, [[4, -1, -1], [-1, 4, -1], [-1, -1, 4]], rtol=0, atol=1e-14)


def test_a_pyramid_has_its_centre_at_a_quarter_of_its_height():
    corners = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 3]]
    faces = [[0, 3, 2], [0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    body = SpatialInertia.from_mesh(20.0, corners, faces)
    np.testing.assert_allclose(body.com, [0, 0, 0.75], rtol=0, atol=1e-15)
    moments = [20 * (4 * 4 + 3 * 9) / 80] * 2 + [20 * 4 / 10]  # m (4 s² + 3 h²)/80 and m s²/10, with s = 2 and h = 3
    np.testing.assert_allclose(body.inertia_at_com, np.diag(moments), rtol=0, atol=1e-14)


def test_trimesh_has_the_same_body_for_a_surface_that_is_not_convex():
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed: the comparison with it is skipped")
    for mesh in (trimesh.creation.annulus(0.5, 1.0, 0.7), trimesh.creation.icosphere(radius=0.4)):
        mesh.apply_translation([0.3, 0.2, -0.1])
        ours = SpatialInertia.from_mesh(mesh.volume, mesh.vertices, mesh.faces)
        np.testing.assert_allclose(ours.com, mesh.center_mass, rtol=0, atol=1e-14)
        np.testing.assert_allclose(ours.inertia_at_com, mesh.moment_inertia, rtol=0, atol=1e-14)


def test_a_surface_that_holds_no_volume_is_an_error():
    with pytest.raises(tw.ModelError, match=r"faces: expected a closed surface: the edge \(\d, \d\) has one side only"):
        SpatialInertia.from_mesh(1, CUBE, FACES[:-1])
    with pytest.raises(tw.ModelError, match="faces: expected a closed surface; merge vertices"):
        SpatialInertia.from_mesh(1, CUBE, [*FACES, FACES[0]])
    with pytest.raises(tw.ModelError, match="got -8 m³: is it inside out"):
        SpatialInertia.from_mesh(1, CUBE, [face[::-1] for face in FACES])
    with pytest.raises(tw.ShapeError, match="faces: expected rows of vertices, 0 to 7"):
        SpatialInertia.from_mesh(1, CUBE, [[0, 1, 8]])
    with pytest.raises(tw.ShapeError, match="vertices: expected shape"):
        SpatialInertia.from_mesh(1, CUBE[:, :2], FACES)


# --- number types, batches, errors ---------------------------------------------------------------


def test_fractions_stay_exact():
    body = SpatialInertia.from_cylinder(Fraction(12), Fraction(1, 3), 2)
    np.testing.assert_array_equal(body.inertia_at_com.diagonal(), [4 + Fraction(1, 3)] * 2 + [Fraction(2, 3)])


@pytest.mark.parametrize("r", [Fraction(1, 3), Fraction(7, 5)])
def test_each_shape_is_its_closed_form_exactly(r):
    """All digits of the formulas of the textbooks, with fractions; a capsule as a cylinder and two halves of a ball."""
    m, l = Fraction(12), Fraction(5, 7)
    x, y, z = (r**2, l**2, Fraction(4))  # squares of the sides or half axes
    ball = m * Fraction(4, 3) * r / (l + Fraction(4, 3) * r)  # the share of the mass in the caps
    rod = m - ball
    along = rod * r**2 / 2 + ball * 2 * r**2 / 5
    across = rod * (l**2 / 12 + r**2 / 4) + ball * (2 * r**2 / 5 + l**2 / 4 + 3 * l * r / 8)
    for body, moments in (
        (SpatialInertia.from_box(m, [r, l, 2]), [m * (y + z) / 12, m * (x + z) / 12, m * (x + y) / 12]),
        (SpatialInertia.from_ellipsoid(m, [r, l, 2]), [m * (y + z) / 5, m * (x + z) / 5, m * (x + y) / 5]),
        (SpatialInertia.from_rod(m, l), [m * y / 12, m * y / 12, 0]),
        (SpatialInertia.from_sphere(m, r), [2 * m * x / 5] * 3),
        (SpatialInertia.from_shell(m, r), [2 * m * x / 3] * 3),
        (SpatialInertia.from_cylinder(m, r, l), [m * (3 * x + y) / 12, m * (3 * x + y) / 12, m * x / 2]),
        (SpatialInertia.from_capsule(m, r, l), [across, across, along]),
    ):
        assert (body.inertia_at_com == np.diag(moments)).all()
    point = SpatialInertia.from_point(m, [r, l, 2]).matrix()
    assert (point[:3, :3] == m * ((x + y + z) * np.eye(3, dtype=int) - np.outer([r, l, 2], [r, l, 2]))).all()


def test_a_mesh_is_right_to_fifty_digits():
    """A tetrahedron of any shape, by its four corners: ∫ x xᵀ = m/20 (Σ x xᵀ + Σx Σxᵀ), with fractions."""
    corners = np.random.default_rng(9).normal(size=(4, 3))
    corners[[0, 1]] = corners[[0, 1] if np.linalg.det(corners[1:] - corners[0]) > 0 else [1, 0]]
    body = SpatialInertia.from_mesh(2.0, corners, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    x = np.vectorize(Fraction, otypes=[object])(corners)
    spread = (x.T @ x + np.outer(x.sum(0), x.sum(0))) / 10
    np.testing.assert_allclose(body.com, (x.sum(0) / 4).astype(float), rtol=0, atol=1e-15)
    exact = (np.trace(spread) * np.eye(3, dtype=int) - spread).astype(float)
    np.testing.assert_allclose(body.matrix()[:3, :3], exact, rtol=0, atol=4e-15 * np.abs(exact).max())


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble, np.complex128])
def test_batch_axes_and_number_types_are_kept(dtype):
    radius, length = np.ones((3, 1), dtype), np.ones((1, 2), dtype)
    for body in (
        SpatialInertia.from_capsule(dtype(2), radius, length),
        SpatialInertia.from_cylinder(dtype(2), radius, length),
        SpatialInertia.from_box(radius * length, np.ones((3, 2, 3), dtype)),
    ):
        assert body.mass.shape == (3, 2)
        assert body.inertia_at_com.shape == (3, 2, 3, 3)
        assert body.inertia_at_com.dtype == dtype


def test_errors_name_the_argument():
    with pytest.raises(tw.ModelError, match="radius: expected no negative number, got -1"):
        SpatialInertia.from_sphere(1, -1)
    with pytest.raises(tw.ModelError, match="mass: expected no negative number, got -2"):
        SpatialInertia.from_box(-2, [1, 1, 1])
    with pytest.raises(tw.ShapeError, match="size: expected shape"):
        SpatialInertia.from_box(1, 1)
    with pytest.raises(tw.ShapeError, match="mass, radius, length: batch axes do not broadcast"):
        SpatialInertia.from_cylinder(np.ones(2), np.ones(3), 1)


def test_a_point_mass_is_a_body_and_the_report_names_it():
    bob = SpatialInertia.from_point(2.0, [0, 0, -1])
    bob.check_physical("bob")
    robot = tw.Builder("simple pendulum")
    robot.link("bob", parent="base_link", joint=tw.Revolute("y"), inertia=bob)
    model = robot.build()
    assert "a point mass" in str(model.report)
    np.testing.assert_allclose(tw.aba(model, [0.3], [0], [0]), [-9.81 * np.sin(0.3)], rtol=1e-15)

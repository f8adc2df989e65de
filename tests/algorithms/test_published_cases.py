"""What tests of other projects ask, and what no other file here asked in their words.

tests/published_cases.csv names each of their tests and the test here that asks the same; the last tests of this file
hold that list and docs/published.md to each other.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from pathlib import Path

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench import newton_euler_3d as slow
from twistwrench.newton_euler_3d.bodies import cross

from ..strategies import Recipe
from .published import moved

ROOT = Path(__file__).parents[2]
H, ZERO = 1e-30, np.zeros(3)


def close(x, y, tolerance=1e-13):
    np.testing.assert_allclose(x, y, rtol=0, atol=tolerance * max(1.0, np.abs(y).max(initial=0)))


# ---------------------------------------------------------------- articulated inertia: Drake, from Featherstone's book


@pytest.mark.parametrize("q", [np.zeros(6), [0.1, 0.3, -0.2, 0.9, np.pi / 4, 0.5]])
def test_a_cylinder_that_turns_and_slides_in_a_box_leaves_its_mass_along_two_axes(q):
    """RBDA, example 7.1 with Drake's numbers: box of 2 kg on a ball joint, cylinder of 0.8 kg along x in it."""
    along_x = tw.SE3(tw.exp3([0, np.pi / 2, 0]), ZERO)
    box = tw.SpatialInertia.from_box(2.0, [0.4, 1.0, 1.0])
    cylinder = tw.SpatialInertia.from_cylinder(0.8, 0.2, 0.3).transform(along_x)
    builder = tw.Builder("box", gravity=ZERO)
    builder.link("box", parent="base_link", joint=tw.Spherical(), inertia=box)
    builder.link("ring", parent="box", joint=tw.Revolute("x"))
    builder.link("cylinder", parent="ring", joint=tw.Prismatic("y"), inertia=cylinder)
    model = builder.build()
    q = model.normalize(np.r_[q[:3], 1.0, q[4], q[5]])
    close(tw.articulated_inertia(model, q, "cylinder"), cylinder.matrix())
    T = moved(0, q[5], 0)  # the cylinder in the ring
    free = cylinder.matrix()
    free[4, 4] = 0  # along y it gives way
    X = T.inverse().motion_transform()
    close(tw.articulated_inertia(model, q, "ring"), X.T @ free @ X)
    ring = X.T @ free @ X
    left = ring - np.outer(ring[0], ring[0]) / ring[0, 0]  # and about x
    X = tw.SE3(tw.exp3([q[4], 0, 0]), ZERO).inverse().motion_transform()
    close(tw.articulated_inertia(model, q, "box"), box.matrix() + X.T @ left @ X)
    if not q[5]:
        P = tw.articulated_inertia(model, q, "box")
        rest = P - P[:, :3] @ np.linalg.solve(P[:3, :3], P[:3])
        close(rest, np.diag([0, 0, 0, 2.8, 2.0, 2.8]))


# ---------------------------------------------------------------- inertia: Drake, RBDL


def test_bodies_by_their_parts():
    """Drake's capsule (ρ 0.1, r 0.5, l 1.5) as a cylinder and two halves of a ball, and its cylinder about an end."""
    r, l, rho = 0.5, 1.5, 0.1
    rod, ball = np.pi * r**2 * l * rho, 4 / 3 * np.pi * r**3 * rho
    across = rod * (l**2 / 12 + r**2 / 4) + ball * (2 / 5 * r**2 + l**2 / 4 + 3 / 8 * l * r)
    along = rod * r**2 / 2 + ball * 2 / 5 * r**2
    capsule = tw.SpatialInertia.from_capsule(rod + ball, r, l)
    close(capsule.inertia_at_com, np.diag([across, across, along]), 1e-15)
    half = 2 / 5 * r**2 - (3 / 8 * r) ** 2  # of half a ball about its centre, 3/8 r from the flat side, per mass
    bowl = tw.SpatialInertia(ball / 2, [0, 0, l / 2 + 3 / 8 * r], ball / 2 * np.diag([half, half, 2 / 5 * r**2]))
    turned = bowl.transform(tw.SE3(tw.exp3([np.pi, 0, 0]), ZERO))
    close((tw.SpatialInertia.from_cylinder(rod, r, l) + bowl + turned).matrix(), capsule.matrix(), 1e-15)

    r, l = 2.5, 1.5
    about_end = tw.SpatialInertia.from_cylinder(1.0, r, l).transform(moved(0, 0, l / 2)).matrix()[:3, :3]
    end = (3 * r**2 + l**2) / 12 + l**2 / 4
    close(about_end, np.diag([end, end, r**2 / 2]), 1e-15)
    axis = np.array([1.0, 2, 3]) / np.sqrt(14)
    turn = tw.exp3(np.cross([0, 0, 1], axis) / np.sqrt(5 / 14) * np.arccos(axis[2]))
    oblique = tw.SpatialInertia.from_cylinder(1.0, r, l).transform(tw.SE3(turn, ZERO)).inertia_at_com
    across = (3 * r**2 + l**2) / 12
    close(oblique, across * np.eye(3) + (r**2 / 2 - across) * np.outer(axis, axis), 1e-15)


def test_points_tetrahedra_and_sums():
    """Drake's point of 3 kg at (1, 2, 3) and its tetrahedron, about a vertex and about another point; RBDL's sums."""
    point = tw.SpatialInertia.from_point(3.0, [1.0, 2, 3])
    close(point.matrix()[:3, :3], 3 * np.array([[13, -2, -3], [-2, 10, -6], [-3, -6, 5]]), 1e-15)
    corners = np.array([[0, 0, 0], [1.0, 1, 0], [0, 2, 0], [0, 3, 3]])
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    solid = tw.SpatialInertia.from_mesh(1.0, corners, faces)
    sums = corners.sum(0)
    spread = (corners.T @ corners + np.outer(sums, sums)) / 20  # ∫ x xᵀ of a tetrahedron, per mass
    close(solid.matrix()[:3, :3], np.trace(spread) * np.eye(3) - spread, 1e-14)
    there = tw.SpatialInertia.from_mesh(1.0, corners + np.array([1, 4, 5]), faces)
    close(there.matrix(), solid.transform(moved(1, 4, 5)).matrix(), 1e-14)

    a = tw.SpatialInertia(1.1, [-1.1, 1.3, 0], np.diag([3.1, 3.2, 3.3]))
    for T in (moved(0, 0, 0), moved(1.1, -2.2, 3.3), tw.SE3(tw.exp3([0, 0, np.pi / 3]), ZERO),
              tw.SE3(tw.exp3([np.pi / 3, 0, 0]), [-1.1, 2.2, -3.3])):  # fmt: skip
        b = tw.SpatialInertia(2.2, [0.4, -0.2, 0.6], np.diag([1.1, 1.2, 1.3])).transform(T)
        close((a + b).matrix(), a.matrix() + b.matrix())
        close((a + b - b).matrix(), a.matrix())
        close((a + b - a).matrix(), b.matrix())
    rotor = tw.SpatialInertia(0.0, ZERO, np.diag([1.0, 2, 2]))
    close((rotor + rotor).matrix(), 2 * rotor.matrix())
    close((a + tw.SpatialInertia(0.0, ZERO, np.zeros((3, 3)))).matrix(), a.matrix())
    V = np.array([0.3, -1.2, 0.8, 2.0, 0.1, -0.7])
    velocity = V[3:] + np.cross(V[:3], a.com)
    close(a.kinetic_energy(V), (1.1 * velocity @ velocity + V[:3] @ a.inertia_at_com @ V[:3]) / 2, 1e-14)


# ---------------------------------------------------------------- springs and dampers: Drake


@pytest.mark.parametrize(("damping", "name"), [(0.0, "undamped"), (0.5, "underdamped"), (25.0, "overdamped")])
def test_a_mass_on_a_spring_moves_as_its_closed_form(damping, name):
    """Drake's spring-mass system: 2 kg, 50 N/m, from 0.1 m; a spring is a policy for τ."""
    mass, stiffness, x0 = 2.0, 50.0, 0.1
    builder = tw.Builder(name, gravity=ZERO)
    builder.link("mass", parent="base_link", joint=tw.Prismatic("x"), inertia=tw.SpatialInertia.from_sphere(mass, 0.1))
    model = builder.build()
    run = tw.simulate(model, [x0], [0.0], dt=2e-3, duration=1.0, tau=lambda t, q, v: -stiffness * q - damping * v)
    roots = np.roots([mass, damping, stiffness])
    c = np.linalg.solve([[1, 1], roots], [x0, 0])
    close(run.q[-1], (c @ np.exp(roots)).real, 1e-9)
    close(run.v[-1], (c * roots @ np.exp(roots)).real, 1e-8)


def test_a_spring_between_two_points_takes_what_its_energy_gives():
    """Drake's linear spring-damper: k (l − l₀) + d l̇ along its line, by the Jacobians of its ends; power −U̇ − d l̇²."""
    model = tw.random_tree(6, rng=8)
    rng, stiffness, damping, rest = np.random.default_rng(2), 100.0, 4.0, 0.4
    q, v = model.random_configuration(rng=rng), rng.standard_normal(model.nv)
    a, b = (model.joint_names[i] for i in (2, 6))
    ends = [(a, [0.1, 0.2, 0.0]), (b, [0.0, -0.3, 0.1])]

    def length(q):
        p = [tw.frame_placement(model, q, frame).act(np.array(at)) for frame, at in ends]
        d = p[0] - p[1]
        return np.sqrt(d @ d), d / np.sqrt(d @ d)

    (l, along), J = length(q), [tw.point_jacobian(model, q, *end) for end in ends]
    rate = along @ (J[0] - J[1]) @ v
    close(rate, length(model.integrate(q, 1j * H * v))[0].imag / H)
    force = stiffness * (l - rest) + damping * rate
    tau = -(J[0] - J[1]).T @ along * force
    close(tau @ v, -stiffness * (l - rest) * rate - damping * rate**2)


# ---------------------------------------------------------------- second derivatives: Pinocchio


def test_second_derivatives_of_inverse_dynamics():
    """∂²τ of Pinocchio's `ComputeRNEASecondOrderDerivatives`: a complex step through what is exactly quadratic in v.

    Its own test compares with differences. ∂²τ/∂v² and ∂²τ/∂v∂q come from ½(τ(v + e) − τ(v − e)), ∂²τ/∂a∂q from M.
    """
    recipe = Recipe(5, seed=6, kinds=("revolute", "prismatic", "helical"))
    model, (q, v, a, *_) = recipe.model, recipe.state()
    one, n, h = np.eye(model.nv), model.nv, 1e-6
    steps = 1j * H * one

    def by_q(f, q=q):
        return np.moveaxis(f(model.integrate(q, steps)).imag / H, 0, -1)

    def tau(q, v=v, a=a):
        return tw.rnea(model, q, v, a)

    def by_v(q, v=v):
        return np.stack([(tau(q, v + e) - tau(q, v - e)) / 2 for e in one], axis=-1)

    vv = np.stack([by_v(q, e + v) - by_v(q, v) for e in one], axis=-1)
    close(vv, vv.swapaxes(1, 2))
    close(np.einsum("ijk,j,k->i", vv, v, v) / 2, tau(q) - tau(q, 0 * v))
    vq, aq = by_q(by_v), by_q(lambda q: tw.crba(model, q))
    close(np.einsum("ijk,k->ij", aq, v), tw.coriolis_matrix(model, q, v) + tw.coriolis_matrix(model, q, v).T)
    qq = np.zeros((n, n, n))
    for k in range(n):
        plus, minus = (model.integrate(q, s * h * one[k]) for s in (1, -1))
        close((by_v(plus) - by_v(minus)) / (2 * h), vq[:, :, k], 1e-8)
        close((tw.crba(model, plus) - tw.crba(model, minus)) / (2 * h), aq[:, :, k], 1e-8)
        qq[:, :, k] = (by_q(tau, plus) - by_q(tau, minus)) / (2 * h)
    close(qq, qq.swapaxes(1, 2), 1e-8)


def test_the_kinematic_hessian_is_the_bracket_of_two_columns():
    """∂Jᵢ/∂qⱼ = Jᵢ × Jⱼ in the frame's own axes where joint i carries joint j, else zero: asked by two projects."""
    recipe = Recipe(8, seed=4, base="floating", branching=0.7)
    model, q, frame = recipe.model, recipe.state().q, "joint_7"
    steps = 1j * H * np.eye(model.nv)
    hessian = np.moveaxis(tw.frame_jacobian(model, model.integrate(q, steps), frame).imag / H, 0, -1)
    J, joint = tw.frame_jacobian(model, q, frame), np.zeros(model.nv, int)
    for i, s in enumerate(model.v_slice[1:], 1):
        joint[s] = i
    for i in range(model.nv):
        for j in range(model.nv):
            carries = joint[i] != joint[j] and joint[i] in model.support(joint[j])
            bracket = tw.cross_motion(J[:, i]) @ J[:, j] * carries
            np.testing.assert_allclose(hessian[:, i, j], bracket, rtol=0, atol=1e-14)


def test_the_second_derivative_of_log_is_that_of_its_jacobian():
    """Pinocchio's Hlog3, asked as its own test does: a step through Jlog3; near 0 it is half of the cross product."""
    for w in ([0.3, -1.2, 0.8], [0, 0, 3.0], [1e-5, 2e-5, 0]):
        R, h = tw.exp3(w), 1e-6
        ways = [R @ tw.exp3(1j * H * e) for e in np.eye(3)]
        exact = np.stack([tw.Jlog3(x).imag / H for x in ways], axis=-1)
        for k, e in enumerate(np.eye(3)):
            slope = (tw.Jlog3(R @ tw.exp3(h * e)) - tw.Jlog3(R @ tw.exp3(-h * e))) / (2 * h)
            close(exact[:, :, k], slope, 1e-8)
        if np.abs(w).max() < 1e-3:
            close(exact, np.stack([tw.skew(e) / 2 for e in np.eye(3)], axis=-1), 1e-5)


# ---------------------------------------------------------------- what motors cannot do: RBDL


def test_a_pendulum_that_no_motor_reaches_is_said():
    """RBDL's cart of 10 kg on a rail with a pendulum and a motor at the cart alone."""
    cart = tw.SpatialInertia(10.0, ZERO, np.diag([0.41, 1.04, 1.04]))
    bar = tw.SpatialInertia(1.0, [0, -0.5, 0], np.diag([1 / 3, 1 / 3, 1 / 30]))
    builder = tw.Builder("cart", gravity=[0, 0, -9.81])
    builder.link("x", parent="base_link", joint=tw.Prismatic("x"), joint_name="x_joint")
    builder.link("z", parent="x", joint=tw.Prismatic("z"))
    builder.link("cart", parent="z", joint=tw.Revolute("y"), inertia=cart)
    builder.link("bar", parent="cart", joint=tw.Revolute("y"), inertia=bar)
    model, rail = builder.build(), []
    rail += [tw.Coupling(name, {}) for name in ("z", "cart")]
    q, v = np.array([0, 0, 0, 0.4]), np.array([0.3, 0, 0, -0.2])
    free = tw.contact_forward_dynamics(model, q, v, [2.0, 0, 0, 0], rail)
    back = tw.contact_inverse_dynamics(model, q, v, free.qdd, rail, motors=["x_joint"])
    close(back.tau, [2.0, 0, 0, 0], 1e-12)
    with pytest.raises(tw.SingularError):
        tw.contact_inverse_dynamics(model, q, v, free.qdd + np.eye(4)[3], rail, motors=["x_joint"])


# ---------------------------------------------------------------- symbols: Robotics Toolbox, Drake


def test_placements_and_jacobians_of_symbols():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: no symbols")
    a, b = sympy.symbols("a b", real=True)
    builder = tw.Builder("arm")
    for name, parent, x in (("near", "base_link", 0), ("far", "near", 1)):
        body = tw.SpatialInertia.from_point(1.0, [1.0, 0, 0])
        builder.link(name, parent=parent, joint=tw.Revolute("z"), placement=moved(x, 0, 0), inertia=body)
    builder.link("tip", parent="far", placement=moved(1, 0, 0))
    model, q = builder.build(), np.array([a, b], object)
    place = tw.frame_placement(model, q, "tip").translation
    x, y = sympy.cos(a) + sympy.cos(a + b), sympy.sin(a) + sympy.sin(a + b)
    J, M = tw.frame_jacobian(model, q, "tip", "local_world_aligned"), tw.crba(model, q)
    c, expected = sympy.cos(b), [[x.diff(a), x.diff(b)], [y.diff(a), y.diff(b)]]
    for got, right in zip([*place[:2], *J[3:5].ravel(), *M.ravel()],
                          [x, y, *expected[0], *expected[1], 3 + 2 * c, 1 + c, 1 + c, 1],
                          strict=True):  # fmt: skip
        assert sympy.simplify(sympy.nsimplify(got) - right) == 0


# ---------------------------------------------------------------- fifty digits


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_mobility_points_and_articulated_inertia_are_right_to_fifty_digits(base):
    """J M⁻¹ Jᵀ, its inverse, the motion of a point and of a body with all outboard joints free, from 3-D vectors."""
    recipe = Recipe(7, seed=11, base=base, branching=0.4)
    model, (q, v, a, *_) = recipe.model, recipe.state()
    frame, point = model.joint_names[-1], np.array([0.3, -0.2, 0.5])
    with mpmath.workdps(50):
        exact = [slow.as_mpmath(x) for x in (q, v, a)]
        M = mpmath.matrix(slow.mass_matrix(model, exact[0]).tolist())
        J = slow.frame_jacobian(model, exact[0], frame, "local_world_aligned")
        row = mpmath.matrix(J.tolist())
        mobility = row * M**-1 * row.T
        theirs = np.array(mobility.tolist(), float).reshape(6, 6)
        R = slow.frame_placement(model, exact[0], frame)[0]
        r = R @ slow.as_mpmath(point)
        bias = slow.frame_bias_acceleration(model, *exact[:2], frame, "local_world_aligned")
        motion, change = J @ exact[1], J @ exact[2] + bias
        velocity = motion[3:] + cross(motion[:3], r)
        acceleration = change[3:] + cross(change[:3], r) + cross(motion[:3], cross(motion[:3], r))
    near = {"tolerance": 1e-12}
    ours = tw.frame_jacobian(model, q, frame, "local_world_aligned")
    close(tw.delassus_matrix(model, q, ours), theirs, **near)
    close(tw.point_velocity(model, q, v, frame, point), velocity.astype(float), **near)
    close(tw.point_acceleration(model, q, v, a, frame, point), acceleration.astype(float), **near)
    if base == "floating":  # of the base: the inertia with all joints free
        J = tw.frame_jacobian(model, q, "root_joint")
        with mpmath.workdps(50):
            row = mpmath.matrix(J.tolist())
            free = (row * M**-1 * row.T) ** -1
        close(tw.articulated_inertia(model, q, "root_joint"), np.array(free.tolist(), float).reshape(6, 6), **near)


# ---------------------------------------------------------------- the list, and the page


def cases():
    with open(ROOT / "tests" / "published_cases.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_each_case_is_asked_by_a_test_that_exists_or_says_why_not():
    listed = cases()
    names = [tuple(case[key] for key in ("feature", "project", "file", "test")) for case in listed]
    assert len(set(names)) == len(names)
    files = {test.split("::")[0] for case in listed for test in case["asked_in"].split()}
    sources = {path: (ROOT / path).read_text(encoding="utf-8") for path in files}
    for case in listed:
        assert bool(case["asked_in"]) != bool(case["outside"]), case
        assert case["asks"], case
        assert not case["outside"] or case["outside"].split(":")[0] in ("missing", "outside the chapter", "interface")
        for test in case["asked_in"].split():
            path, name = test.split("::")
            assert re.search(rf"^def {name}\(", sources[path], re.MULTILINE), test


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_page_counts_what_the_list_has(language):
    listed, page = cases(), (ROOT / "docs" / f"published{language}.md").read_text(encoding="utf-8")
    counted = Counter((case["feature"], (case["outside"] or "asked").split(":")[0]) for case in listed)
    kinds = ("asked", "missing", "outside the chapter", "interface")
    features = list(dict.fromkeys(case["feature"] for case in listed))
    rows = [[counted[feature, kind] for kind in kinds] for feature in features]
    expected = [[sum(row), *row] for row in [*rows, np.sum(rows, axis=0).tolist()]]
    found = re.findall(r"^\| [^|]+ \| (\d+) \| (\d+) \| (\d+) \| (\d+) \| (\d+) \|", page, re.MULTILINE)
    assert [[int(x) for x in row] for row in found] == expected

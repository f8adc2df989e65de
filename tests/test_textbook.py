"""Mechanisms whose equations stand in every textbook, written out by hand from T and U.

All figures differ from one another, so that none can stand in for its neighbour. Angles are about y from the
downward vertical unless said; a turn by θ about y takes (0, 0, −c) to (−c sin θ, 0, −c cos θ).
"""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

G = 9.81
M1, M2, L1, C1, C2, I1, I2 = 1.3, 0.7, 0.9, 0.4, 0.25, 0.11, 0.05
STATES = np.random.default_rng(0).uniform(-2, 2, (6, 3, 2))  # (q, v, a) of two joints

states = pytest.mark.parametrize(("q", "v", "a"), STATES, ids=range(len(STATES)))


def at(x, y, z):
    return tw.SE3(np.eye(3), [x, y, z])


def body(mass, com, about_com, axis):
    """A body of which only the moment of inertia about one axis matters."""
    inertia = 0.6 * about_com * np.eye(3)
    inertia[axis, axis] = about_com
    return tw.SpatialInertia(mass, com, inertia)


def close(x, y, tolerance=1e-14):
    return np.abs(np.asarray(x) - np.asarray(y)).max() <= tolerance * max(1.0, np.abs(y).max())


def agrees(model, q, v, a, *, M, C_v, g):
    """Everything that follows from M, C v and g: inverse and forward dynamics, h, energies."""
    M, C_v, g = np.array(M), np.array(C_v), np.array(g)
    tau = M @ a + C_v + g
    assert close(tw.crba(model, q), M)
    assert close(tw.gravity(model, q), g)
    assert close(tw.nonlinear_effects(model, q, v), C_v + g)
    assert close(tw.coriolis_matrix(model, q, v) @ v, C_v)
    assert close(tw.rnea(model, q, v, a), tau)
    assert close(tw.aba(model, q, v, tau), a, 1e-13)
    assert close(tw.kinetic_energy(model, q, v), v @ M @ v / 2)


# ---------------------------------------------------------------- pendulums


def pendulum():
    builder = tw.Builder("pendulum")
    builder.link("bar", parent="base_link", joint=tw.Revolute("y"), inertia=body(M1, [0, 0, -C1], I1, 1))
    builder.link("tip", parent="bar", placement=at(0, 0, -L1))
    return builder.build()


@states
def test_compound_pendulum(q, v, a):
    # T = ½ (I + m c²) θ̇², U = −m g c cos θ
    model, q, v, a = pendulum(), q[:1], v[:1], a[:1]
    agrees(model, q, v, a, M=[[I1 + M1 * C1**2]], C_v=[0.0], g=[M1 * G * C1 * np.sin(q[0])])
    assert close(tw.potential_energy(model, q), -M1 * G * C1 * np.cos(q[0]))
    assert close(tw.center_of_mass(model, q), [-C1 * np.sin(q[0]), 0, -C1 * np.cos(q[0])])


def test_hinge_of_a_pendulum_bears_the_weight_and_the_centripetal_force():
    # at the bottom: m g + m c ω² along the bar, no moment
    wrench = tw.joint_wrenches(pendulum(), [0.0], [3.0], [0.0])[1]
    assert close(wrench, [0, 0, 0, 0, 0, M1 * (G + C1 * 9.0)])


def test_tip_of_a_rod_that_is_let_go_falls_faster_than_a_stone():
    # a uniform rod, horizontal: α = m g (l/2) / (m l²/3) = 3 g / (2 l), its tip falls with 1.5 g
    builder = tw.Builder("rod")
    builder.link("rod", parent="base_link", joint=tw.Revolute("y"), inertia=body(2.0, [0, 0, -0.5], 2.0 / 12, 1))
    builder.link("tip", parent="rod", placement=at(0, 0, -1))
    model, q, rest = builder.build(), [np.pi / 2], [0.0]
    a = tw.aba(model, q, rest, [0.0])
    assert close(a, [-1.5 * G])
    J = tw.frame_jacobian(model, q, "tip", "local_world_aligned")
    assert close(J @ a, [0, -1.5 * G, 0, 0, 0, -1.5 * G])


def double_pendulum():
    builder = tw.Builder("double pendulum")
    builder.link("upper", parent="base_link", joint=tw.Revolute("y"), inertia=body(M1, [0, 0, -C1], I1, 1))
    builder.link("lower", parent="upper", joint=tw.Revolute("y"), placement=at(0, 0, -L1),
                 inertia=body(M2, [0, 0, -C2], I2, 1))  # fmt: skip
    return builder.build()


def double_pendulum_equations(q, v, m1=M1, m2=M2, l1=L1, c1=C1, c2=C2, i1=I1, i2=I2):
    """M, C and g with relative angles, from T = Σ ½ m ṙ² + ½ I (θ̇₁ + …)² and U = −Σ m g · (depth)."""
    (q1, q2), (v1, v2) = q, v
    M11 = i1 + i2 + m1 * c1**2 + m2 * (l1**2 + c2**2 + 2 * l1 * c2 * np.cos(q2))
    M12 = i2 + m2 * (c2**2 + l1 * c2 * np.cos(q2))
    M = [[M11, M12], [M12, i2 + m2 * c2**2]]
    k = -m2 * l1 * c2 * np.sin(q2)
    C = np.array([[k * v2, k * (v1 + v2)], [-k * v1, 0.0]])
    g2 = m2 * c2 * G * np.sin(q1 + q2)
    return M, C, [(m1 * c1 + m2 * l1) * G * np.sin(q1) + g2, g2]


@states
def test_double_pendulum(q, v, a):
    M, C, g = double_pendulum_equations(q, v)
    agrees(double_pendulum(), q, v, a, M=M, C_v=C @ v, g=g)
    assert close(tw.coriolis_matrix(double_pendulum(), q, v), C)  # Christoffel's


@states
def test_chain_of_two_is_the_double_pendulum_of_two_rods(q, v, a):
    # solid cylinders of length l, radius l/20: m (3 r² + l²)/12 about the centre of mass; the lower one twice as heavy
    across = 0.8**2 * (3 / 20**2 + 1) / 12
    M, C, g = double_pendulum_equations(q, v, 1.5, 3.0, 0.8, 0.4, 0.4, 1.5 * across, 3.0 * across)
    agrees(tw.chain(2, mass=1.5, length=0.8, mass_ratio=2.0), q, v, a, M=M, C_v=C @ v, g=g)


def test_chain_held_out_straight_must_be_held_at_every_joint():
    # joint k of n equal rods of mass m and length l: the n − k rods beyond it have their centre (n − k) l / 2 away
    q = [np.pi / 2, 0, 0, 0, 0]
    expected = [-2.0 * G * 0.5 * k**2 / 2 for k in (5, 4, 3, 2, 1)]
    assert close(tw.gravity(tw.chain(5, mass=2.0, length=0.5), q), np.negative(expected))


@states
def test_planar_arm_of_spong_and_craig(q, v, a):
    # two links along x that turn about z: J and J̇ q̇ of the tip
    builder = tw.Builder("planar arm")
    builder.link("one", parent="base_link", joint=tw.Revolute("z"), inertia=body(M1, [C1, 0, 0], I1, 2))
    builder.link("two", parent="one", joint=tw.Revolute("z"), placement=at(L1, 0, 0))
    builder.link("tip", parent="two", placement=at(0.6, 0, 0))
    model, (q1, q2), (v1, v2) = builder.build(), q, v
    s1, c1, s12, c12 = np.sin(q1), np.cos(q1), np.sin(q1 + q2), np.cos(q1 + q2)
    J = tw.frame_jacobian(model, q, "tip", "local_world_aligned")
    assert close(J[3:5], [[-L1 * s1 - 0.6 * s12, -0.6 * s12], [L1 * c1 + 0.6 * c12, 0.6 * c12]])
    assert close(J[:3], [[0, 0], [0, 0], [1, 1]])
    bias = tw.frame_bias_acceleration(model, q, v, "tip", "local_world_aligned")
    one, two = L1 * v1**2, 0.6 * (v1 + v2) ** 2
    assert close(bias, [0, 0, 0, -one * c1 - two * c12, -one * s1 - two * s12, 0])
    assert close(tw.frame_placement(model, q, "tip").translation, [L1 * c1 + 0.6 * c12, L1 * s1 + 0.6 * s12, 0])


# ---------------------------------------------------------------- slides and hinges


@states
def test_cart_and_pole(q, v, a):
    # pole upright at θ = 0: T = ½ (m₁ + m₂) ẋ² + m₂ c cos θ ẋ θ̇ + ½ (I + m₂ c²) θ̇², U = m₂ g c cos θ
    builder = tw.Builder("cart-pole")
    builder.link("cart", parent="base_link", joint=tw.Prismatic("x"), inertia=body(M1, [0.1, 0.2, 0.3], I1, 1))
    builder.link("pole", parent="cart", joint=tw.Revolute("y"), inertia=body(M2, [0, 0, C2], I2, 1))
    c, s = np.cos(q[1]), np.sin(q[1])
    M = [[M1 + M2, M2 * C2 * c], [M2 * C2 * c, I2 + M2 * C2**2]]
    agrees(builder.build(), q, v, a, M=M, C_v=[-M2 * C2 * s * v[1] ** 2, 0.0], g=[0.0, -M2 * G * C2 * s])


@states
def test_polar_arm(q, v, a):
    # turns about the horizontal z, slides along its own x: T = ½ (I₁ + I₂ + m₁ c² + m₂ r²) θ̇² + ½ m₂ ṙ²
    builder = tw.Builder("polar arm", gravity=[0, -G, 0])
    builder.link("arm", parent="base_link", joint=tw.Revolute("z"), inertia=body(M1, [C1, 0, 0], I1, 2))
    builder.link("slider", parent="arm", joint=tw.Prismatic("x"), inertia=body(M2, [C2, 0, 0], I2, 2))
    r, c, s = q[1] + C2, np.cos(q[0]), np.sin(q[0])
    M = np.diag([I1 + I2 + M1 * C1**2 + M2 * r**2, M2])
    C_v = [2 * M2 * r * v[0] * v[1], -M2 * r * v[0] ** 2]  # Coriolis, centrifugal
    agrees(builder.build(), q, v, a, M=M, C_v=C_v, g=[(M1 * C1 + M2 * r) * G * c, M2 * G * s])


@states
def test_ladder_that_slides_on_a_smooth_floor(q, v, a):
    # Nothing pushes sideways, so its centre falls straight: (I + m c² sin² θ) θ̈ + m c² sin θ cos θ θ̇² = m g c sin θ.
    # The foot is a slide without mass: forward dynamics must not stumble over it.
    builder = tw.Builder("ladder")
    builder.link("foot", parent="base_link", joint=tw.Prismatic("x"))
    builder.link("ladder", parent="foot", joint=tw.Revolute("y"), inertia=body(M1, [0, 0, C1], I1, 1))
    s, c, k = np.sin(q[1]), np.cos(q[1]), M1 * C1**2
    turning = (M1 * G * C1 * s - k * s * c * v[1] ** 2) / (I1 + k * s**2)
    sliding = -C1 * (c * turning - s * v[1] ** 2)
    assert close(tw.aba(builder.build(), q, v, [0, 0]), [sliding, turning], 1e-13)


def test_lift_is_heavier_while_it_speeds_up():
    builder = tw.Builder("lift")
    builder.link("cabin", parent="base_link", joint=tw.Prismatic("z"), inertia=body(M1, [0.1, 0.2, 0.3], I1, 1))
    assert close(tw.rnea(builder.build(), [2.0], [1.0], [3.0]), [M1 * (G + 3.0)])


def test_rotor_counts_by_its_reflected_inertia():
    # a motor of inertia J behind a gear n : 1 adds n² J, and takes n² J q̈ to speed up
    n, J = 50.0, 1e-4
    builder = tw.Builder("geared")
    builder.link(
        "bar", parent="base_link", joint=tw.Revolute("y"), armature=n**2 * J, inertia=body(M1, [0, 0, -C1], I1, 1)
    )
    model, total = builder.build(), I1 + M1 * C1**2 + n**2 * J
    assert close(tw.crba(model, [0.0]), [[total]])
    assert close(tw.aba(model, [0.5], [1.0], [2.0]), [(2.0 - M1 * G * C1 * np.sin(0.5)) / total])


# ---------------------------------------------------------------- free bodies


def free(inertia, gravity=(0, 0, -G)):
    return tw.Builder("free", base="floating", root_inertia=inertia, gravity=gravity).build()


def random_pose(rng):
    return np.concatenate([rng.standard_normal(3), (x := rng.standard_normal(4)) / np.sqrt((x**2).sum())])


@pytest.mark.parametrize("seed", range(4))
def test_newton_and_euler_for_one_body(seed):
    rng = np.random.default_rng(seed)
    mass, c, principal = 2.5, rng.standard_normal(3), np.array([0.3, 0.5, 0.7])
    axes = tw.exp3(rng.standard_normal(3))
    I = axes @ np.diag(principal) @ axes.T
    model, q = free(tw.SpatialInertia(mass, c, I)), random_pose(rng)
    (w, v), (alpha, a) = rng.standard_normal((2, 3)), rng.standard_normal((2, 3))
    R = tw.forward_kinematics(model, q).placement[1].rotation
    # acceleration of the centre of mass, in the body's axes: the rate of v is not that of the velocity's vector
    a_c = a + np.cross(w, v) + np.cross(alpha, c) + np.cross(w, np.cross(w, c))
    force = mass * (a_c - R.T @ model.gravity)
    moment = I @ alpha + np.cross(w, I @ w) + np.cross(c, force)
    tau = np.concatenate([moment, force])
    assert close(tw.rnea(model, q, [*w, *v], [*alpha, *a]), tau, 1e-13)
    assert close(tw.aba(model, q, [*w, *v], tau), [*alpha, *a], 1e-12)
    spin, drift = R @ (I @ w), mass * R @ (v + np.cross(w, c))
    assert close(tw.centroidal_momentum(model, q, [*w, *v]), [*spin, *drift], 1e-13)


def test_symmetric_top_in_free_space_precesses():
    # Euler's equations of a body with I₁ = I₂: ω turns about the symmetry axis with Ω = (I₃ − I₁) ω₃ / I₁
    model = free(tw.SpatialInertia(1.0, [0, 0, 0], np.diag([0.4, 0.4, 0.6])), gravity=[0, 0, 0])
    w = np.array([0.3, -0.2, 5.0])
    rate = (0.6 - 0.4) / 0.4 * w[2]
    a = tw.aba(model, model.neutral(), [*w, 0, 0, 0], np.zeros(6))
    assert close(a, [-rate * w[1], rate * w[0], 0, 0, 0, 0])


def test_body_spins_steadily_about_a_principal_axis_and_about_no_other():
    model = free(tw.SpatialInertia(1.0, [0, 0, 0], np.diag([0.2, 0.3, 0.4])), gravity=[0, 0, 0])
    for w in np.eye(3):
        assert not tw.aba(model, model.neutral(), [*w, 0, 0, 0], np.zeros(6)).any()
    a = tw.aba(model, model.neutral(), [1, 1, 0, 0, 0, 0], np.zeros(6))
    assert close(a[:3], [0, 0, (0.2 - 0.3) / 0.4])


@pytest.mark.parametrize("tilt", [0.3, 1.2, np.pi / 2])
def test_heavy_top_precesses_steadily_at_the_rate_that_the_textbook_gives(tilt):
    # A top on a ball joint, axis tilted by θ, spinning with ψ̇ and precessing with φ̇ about the vertical, keeps θ if
    # m g l = φ̇ (I₃ ω₃ − I₁ φ̇ cos θ), with ω₃ = ψ̇ + φ̇ cos θ and I₁ about the tip.
    mass, length, I3, across = 0.8, 0.3, 0.02, 0.015
    I_tip, precession = across + mass * length**2, 0.9
    w3 = (mass * G * length / precession + I_tip * precession * np.cos(tilt)) / I3
    spin = w3 - precession * np.cos(tilt)
    builder = tw.Builder("top")
    inertia = tw.SpatialInertia(mass, [0, 0, length], np.diag([across, across, I3]))
    builder.link("top", parent="base_link", joint=tw.Spherical(), inertia=inertia)
    vertical = np.array([0, np.sin(tilt), np.cos(tilt)])  # in the axes of the top, tilted about x
    axis = np.array([0, 0, 1.0])
    w = precession * vertical + spin * axis
    assert np.isclose(w[2], w3)
    q = [np.sin(tilt / 2), 0, 0, np.cos(tilt / 2)]
    # In the top's axes the vertical turns with −ω ×, the axis stands still.
    steady = -precession * np.cross(w, vertical)
    assert close(
        tw.aba(builder.build(), q, w, np.zeros(3)), steady, 1e-11
    )  # I₃ω₃ and I₁φ̇: terms a hundred times larger


def test_gyroscope_pushes_sideways():
    # a wheel that spins about x with ω is yawed about z with Ω: it wants the moment I ω Ω about y
    builder = tw.Builder("gyroscope", gravity=[0, 0, 0])
    builder.link("yaw", parent="base_link", joint=tw.Revolute("z"))
    wheel = tw.SpatialInertia(1.0, [0, 0, 0], np.diag([0.5, 0.3, 0.3]))
    builder.link("wheel", parent="yaw", joint=tw.Revolute("x"), inertia=wheel)
    wrench = tw.joint_wrenches(builder.build(), [0.0, 0.0], [2.0, 7.0], [0.0, 0.0])[1]
    assert close(wrench, [0, 0.5 * 7.0 * 2.0, 0, 0, 0, 0])


def test_reaction_wheel_turns_the_satellite_the_other_way():
    wheel = tw.SpatialInertia(0.5, [0, 0, 0], np.diag([0.01, 0.01, 0.02]))
    satellite = tw.SpatialInertia(10.0, [0, 0, 0], np.diag([1.0, 1.1, 1.2]))
    builder = tw.Builder("satellite", base="floating", root_inertia=satellite, gravity=[0, 0, 0])
    builder.link("wheel", parent="base_link", joint=tw.Revolute("z"), inertia=wheel)
    model, rest = builder.build(), np.zeros(7)
    q = model.neutral()
    tau = np.array([0, 0, 0, 0, 0, 0, 0.3])
    # torque 0.3 on the wheel, −0.3 on the satellite: θ̈ = 0.3/0.02 + 0.3/1.2 relative to it
    assert close(tw.aba(model, q, rest, tau), [0, 0, -0.3 / 1.2, 0, 0, 0, 0.3 / 0.02 + 0.3 / 1.2])
    assert close(tw.centroidal_map(model, q)[2], [0, 0, 1.22, 0, 0, 0, 0.02])


@states
def test_body_that_slides_on_a_table(q, v, a):
    # planar joint, velocities in the body's axes: momentum p = m (v + ω × c), L = I ω + c × p; f = ṗ + ω × p
    c, rng = np.array([0.2, -0.3]), np.random.default_rng(1)
    builder = tw.Builder("puck")
    builder.link("puck", parent="base_link", joint=tw.Planar(), inertia=body(M1, [*c, 0.4], I1, 2))
    q, v, a = [*q, np.cos(0.7), np.sin(0.7)], np.append(v, rng.standard_normal()), np.append(a, rng.standard_normal())
    M = [
        [M1, 0, -M1 * c[1]],
        [0, M1, M1 * c[0]],
        [-M1 * c[1], M1 * c[0], I1 + M1 * c @ c],
    ]
    p = M1 * (v[:2] + v[2] * np.array([-c[1], c[0]]))
    agrees(builder.build(), q, v, a, M=M, C_v=[-v[2] * p[1], v[2] * p[0], v[0] * p[1] - v[1] * p[0]], g=[0, 0, 0])


def test_wheel_that_has_turned_by_its_cosine_and_sine_is_a_pendulum_again():
    builder = tw.Builder("wheel")
    builder.link("wheel", parent="base_link", joint=tw.Continuous("y"), inertia=body(M1, [0, 0, -C1], I1, 1))
    model = builder.build()
    for angle in (0.0, 1.0, 2.5, -3.0):
        q = [np.cos(angle), np.sin(angle)]
        assert close(tw.gravity(model, q), tw.gravity(pendulum(), [angle]))
        assert close(tw.aba(model, q, [2.0], [1.0]), tw.aba(pendulum(), [angle], [2.0], [1.0]))

"""Mechanisms whose equations stand in every textbook, written out by hand from T and U.

All figures differ from one another, so that none can stand in for its neighbour. Angles are about y from the
downward vertical unless said; a turn by θ about y takes (0, 0, −c) to (−c sin θ, 0, −c cos θ).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

import twistwrench as tw

G = 9.81
M1, M2, L1, C1, C2, I1, I2 = 1.3, 0.7, 0.9, 0.4, 0.25, 0.11, 0.05
STATES = np.random.default_rng(0).uniform(-2, 2, (6, 3, 2))  # (q, v, a) of two joints

states = pytest.mark.parametrize(("q", "v", "a"), STATES, ids=range(len(STATES)))


class Motion(NamedTuple):
    """A state of a mechanism with the terms of its equation, M a + C v + g = τ."""

    model: tw.Model
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    M: np.ndarray
    C_v: np.ndarray
    g: np.ndarray

    @property
    def tau(self) -> np.ndarray:
        return self.M @ self.a + self.C_v + self.g


def motion(model, q, v, a, *, M, C_v, g) -> Motion:
    return Motion(model, *(np.array(x) for x in (q, v, a, M, C_v, g)))


def agrees(x, expected, tolerance=1e-14) -> bool:
    return np.abs(np.asarray(x) - np.asarray(expected)).max() <= tolerance * max(1.0, np.abs(expected).max())


def at(x, y, z):
    return tw.SE3(np.eye(3), [x, y, z])


def body(mass, com, about_com, axis):
    """A body of which only the moment of inertia about one axis matters."""
    inertia = 0.6 * about_com * np.eye(3)
    inertia[axis, axis] = about_com
    return tw.SpatialInertia(mass, com, inertia)


# ---------------------------------------------------------------- pendulums


def pendulum():
    builder = tw.Builder("pendulum")
    builder.link("bar", parent="base_link", joint=tw.Revolute("y"), inertia=body(M1, [0, 0, -C1], I1, 1))
    builder.link("tip", parent="bar", placement=at(0, 0, -L1))
    return builder.build()


def compound_pendulum(q, v, a):
    # T = ½ (I + m c²) θ̇², U = −m g c cos θ
    return motion(pendulum(), q[:1], v[:1], a[:1],
                  M=[[I1 + M1 * C1**2]], C_v=[0.0], g=[M1 * G * C1 * np.sin(q[0])])  # fmt: skip


def two_bars():
    builder = tw.Builder("double pendulum")
    builder.link("upper", parent="base_link", joint=tw.Revolute("y"), inertia=body(M1, [0, 0, -C1], I1, 1))
    builder.link("lower", parent="upper", joint=tw.Revolute("y"), placement=at(0, 0, -L1),
                 inertia=body(M2, [0, 0, -C2], I2, 1))  # fmt: skip
    return builder.build()


def double_pendulum_equations(q, v, m1=M1, m2=M2, l1=L1, c1=C1, c2=C2, i1=I1, i2=I2):
    """M, C (Christoffel's) and g with relative angles, from T = Σ ½ m ṙ² + ½ I (θ̇₁ + …)², U = −Σ m g · (depth)."""
    (q1, q2), (v1, v2) = q, v
    M11 = i1 + i2 + m1 * c1**2 + m2 * (l1**2 + c2**2 + 2 * l1 * c2 * np.cos(q2))
    M12 = i2 + m2 * (c2**2 + l1 * c2 * np.cos(q2))
    M = [[M11, M12], [M12, i2 + m2 * c2**2]]
    k = -m2 * l1 * c2 * np.sin(q2)
    C = np.array([[k * v2, k * (v1 + v2)], [-k * v1, 0.0]])
    g2 = m2 * c2 * G * np.sin(q1 + q2)
    return M, C, [(m1 * c1 + m2 * l1) * G * np.sin(q1) + g2, g2]


def double_pendulum(q, v, a):
    M, C, g = double_pendulum_equations(q, v)
    return motion(two_bars(), q, v, a, M=M, C_v=C @ v, g=g)


def chain_of_two(q, v, a):
    # solid cylinders of length l, radius l/20: m (3 r² + l²)/12 about the centre of mass; the lower one twice as heavy
    across = 0.8**2 * (3 / 20**2 + 1) / 12
    M, C, g = double_pendulum_equations(q, v, 1.5, 3.0, 0.8, 0.4, 0.4, 1.5 * across, 3.0 * across)
    return motion(tw.chain(2, mass=1.5, length=0.8, mass_ratio=2.0), q, v, a, M=M, C_v=C @ v, g=g)


# ---------------------------------------------------------------- slides and hinges


def cart_and_pole(q, v, a):
    # pole upright at θ = 0: T = ½ (m₁ + m₂) ẋ² + m₂ c cos θ ẋ θ̇ + ½ (I + m₂ c²) θ̇², U = m₂ g c cos θ
    builder = tw.Builder("cart-pole")
    builder.link("cart", parent="base_link", joint=tw.Prismatic("x"), inertia=body(M1, [0.1, 0.2, 0.3], I1, 1))
    builder.link("pole", parent="cart", joint=tw.Revolute("y"), inertia=body(M2, [0, 0, C2], I2, 1))
    c, s = np.cos(q[1]), np.sin(q[1])
    M = [[M1 + M2, M2 * C2 * c], [M2 * C2 * c, I2 + M2 * C2**2]]
    return motion(builder.build(), q, v, a, M=M, C_v=[-M2 * C2 * s * v[1] ** 2, 0.0], g=[0.0, -M2 * G * C2 * s])


def polar_arm(q, v, a):
    # turns about the horizontal z, slides along its own x: T = ½ (I₁ + I₂ + m₁ c² + m₂ r²) θ̇² + ½ m₂ ṙ²
    builder = tw.Builder("polar arm", gravity=[0, -G, 0])
    builder.link("arm", parent="base_link", joint=tw.Revolute("z"), inertia=body(M1, [C1, 0, 0], I1, 2))
    builder.link("slider", parent="arm", joint=tw.Prismatic("x"), inertia=body(M2, [C2, 0, 0], I2, 2))
    r, c, s = q[1] + C2, np.cos(q[0]), np.sin(q[0])
    M = np.diag([I1 + I2 + M1 * C1**2 + M2 * r**2, M2])
    C_v = [2 * M2 * r * v[0] * v[1], -M2 * r * v[0] ** 2]  # Coriolis, centrifugal
    return motion(builder.build(), q, v, a, M=M, C_v=C_v, g=[(M1 * C1 + M2 * r) * G * c, M2 * G * s])


def puck_on_a_table(q, v, a):
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
    C_v = [-v[2] * p[1], v[2] * p[0], v[0] * p[1] - v[1] * p[0]]
    return motion(builder.build(), q, v, a, M=M, C_v=C_v, g=[0, 0, 0])


MECHANISMS = (compound_pendulum, double_pendulum, chain_of_two, cart_and_pole, polar_arm, puck_on_a_table)
mechanisms = pytest.mark.parametrize("mechanism", MECHANISMS, ids=lambda mechanism: mechanism.__name__)
"""With `states`: every mechanism in every state, a Motion by `mechanism(q, v, a)`."""


def wheel():
    """The pendulum again, but with the cosine and the sine of its angle for q."""
    builder = tw.Builder("wheel")
    builder.link("wheel", parent="base_link", joint=tw.Continuous("y"), inertia=body(M1, [0, 0, -C1], I1, 1))
    return builder.build()


def geared_pendulum():
    """A pendulum driven by a motor of inertia J behind a gear n : 1, and its inertia with n² J."""
    n, J = 50.0, 1e-4
    builder = tw.Builder("geared")
    builder.link(
        "bar", parent="base_link", joint=tw.Revolute("y"), armature=n**2 * J, inertia=body(M1, [0, 0, -C1], I1, 1)
    )
    return builder.build(), I1 + M1 * C1**2 + n**2 * J


# ---------------------------------------------------------------- free bodies


def free(inertia, gravity=(0, 0, -G)):
    return tw.Builder("free", base="floating", root_inertia=inertia, gravity=gravity).build()


class FreeMotion(NamedTuple):
    """A state of one free body with what Newton and Euler say of it: the wrench, in its axes, and its momentum."""

    model: tw.Model
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    tau: np.ndarray
    momentum: np.ndarray


def newton_and_euler(seed) -> FreeMotion:
    rng = np.random.default_rng(seed)
    mass, c, principal = 2.5, rng.standard_normal(3), np.array([0.3, 0.5, 0.7])
    axes = tw.exp3(rng.standard_normal(3))
    I = axes @ np.diag(principal) @ axes.T
    model = free(tw.SpatialInertia(mass, c, I))
    q = np.concatenate([rng.standard_normal(3), (x := rng.standard_normal(4)) / np.sqrt((x**2).sum())])
    (w, v), (alpha, a) = rng.standard_normal((2, 3)), rng.standard_normal((2, 3))
    R = tw.forward_kinematics(model, q).placement[1].rotation
    # acceleration of the centre of mass, in the body's axes: the rate of v is not that of the velocity's vector
    a_c = a + np.cross(w, v) + np.cross(alpha, c) + np.cross(w, np.cross(w, c))
    force = mass * (a_c - R.T @ model.gravity)
    moment = I @ alpha + np.cross(w, I @ w) + np.cross(c, force)
    spin, drift = R @ (I @ w), mass * R @ (v + np.cross(w, c))
    return FreeMotion(model, q, *(np.concatenate(x) for x in ((w, v), (alpha, a), (moment, force), (spin, drift))))


def satellite():
    """A free body, 1.2 kg m² about z, that carries a wheel of 0.02 kg m² on that axis."""
    wheel = tw.SpatialInertia(0.5, [0, 0, 0], np.diag([0.01, 0.01, 0.02]))
    hull = tw.SpatialInertia(10.0, [0, 0, 0], np.diag([1.0, 1.1, 1.2]))
    builder = tw.Builder("satellite", base="floating", root_inertia=hull, gravity=[0, 0, 0])
    builder.link("wheel", parent="base_link", joint=tw.Revolute("z"), inertia=wheel)
    return builder.build()

"""Points and soles: rows, axes, and the forces they bear."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import linprog

import twistwrench as tw
from twistwrench.contact import Contact

from ..touching import BOX, FEET, GO2, SOLE

SURFACE = tw.SurfaceContact("sole", (0.1, 0.04), 0.5)


def test_a_point_has_three_rows_and_a_surface_six():
    assert tw.PointContact("foot", 0.5).dim == 3
    assert SURFACE.dim == 6


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -3), (1, 0, 0), (0, -2, 0), (0.3, -0.2, 2.0), (1e-9, 0, -1)])
def test_axes_of_a_point_have_the_normal_as_z(normal):
    R = tw.PointContact("foot", 0.5, normal).axes(np.broadcast_to(np.eye(3), (2, 3, 3)))
    assert R.shape == (2, 3, 3)
    assert np.allclose(R[1] @ R[1].T, np.eye(3), rtol=0, atol=1e-15)
    assert np.allclose(R[1][:, 2], np.divide(normal, np.linalg.norm(normal)), rtol=0, atol=1e-15)
    assert np.isclose(np.linalg.det(R[1]), 1)


def test_axes_of_a_point_do_not_turn_with_the_robot_and_those_of_a_sole_do():
    R = tw.exp3([0.1, 0.2, 0.3])
    assert (tw.PointContact("foot", 0.5).axes(R) == np.eye(3)).all()
    assert (SURFACE.axes(R) == R).all()


@pytest.mark.parametrize("sides", [3, 4, 8, 16])
def test_the_inner_pyramid_is_within_the_cone_and_the_outer_one_around_it(sides):
    contact = tw.PointContact("foot", 0.7)
    angle = np.linspace(0, 2 * np.pi, 48 * sides, endpoint=False)
    rim = np.stack([0.7 * np.cos(angle), 0.7 * np.sin(angle), np.ones_like(angle)])  # f_z = 1, about to slip
    inner, outer = (contact.limits(sides, kind)[:-1] @ rim for kind in ("inner", "outer"))
    assert inner.max(axis=0).min() > -1e-15  # nothing beyond the rim is inside, and the edges touch it
    assert np.isclose(inner.max(axis=0).min(), 0, rtol=0, atol=1e-15)
    assert np.isclose(outer.max(), 0, rtol=0, atol=1e-15)  # all of the rim is inside, and the sides touch it


def test_without_friction_a_contact_bears_only_pressure():
    A = tw.PointContact("foot", 0.0).limits(4, "inner")
    assert (A @ [0, 0, 1] <= 0).all()
    assert (A @ [0, 0, -1]).max() == 1
    assert (A @ [0.01, 0, 1]).max() > 0


def test_spread_adds_up_the_forces_at_the_corners():
    rng = np.random.default_rng(0)
    f = rng.standard_normal((4, 3))
    wrench = np.concatenate([np.cross(SURFACE.points, f).sum(0), f.sum(0)])
    assert np.allclose(SURFACE.grasp_map @ f.ravel(), wrench, rtol=0, atol=1e-15)


def caron(wrench, half, mu):
    """How far a wrench is from each of the sixteen limits of Caron, Pham and Nakamura (2015), by their formulas."""
    tx, ty, tz, fx, fy, fz = wrench
    X, Y = half
    least = -mu * (X + Y) * fz + abs(Y * fx - mu * tx) + abs(X * fy - mu * ty)
    most = mu * (X + Y) * fz - abs(Y * fx + mu * tx) - abs(X * fy + mu * ty)
    return min(mu * fz - abs(fx), mu * fz - abs(fy), fz, Y * fz - abs(tx), X * fz - abs(ty), tz - least, most - tz)


def test_a_sole_bears_what_the_closed_form_says():
    """Outer pyramids of four sides are the ones of the closed form: |f_x| and |f_y| up to μ f_z at each corner."""
    rng = np.random.default_rng(1)
    A, G, seen = SURFACE.limits(4, "outer"), SURFACE.grasp_map, {True: 0, False: 0}
    for _ in range(120):
        wrench = rng.uniform(-1, 1, 6) * [0.05, 0.12, 0.05, 0.5, 0.5, 0] + [0, 0, 0, 0, 0, 1]
        margin = caron(wrench, SURFACE.half_size, 0.5)
        bears = linprog(np.zeros(12), A, np.zeros(len(A)), G, wrench, (None, None)).success
        if abs(margin) > 1e-6:
            assert bears == (margin > 0), (wrench, margin)
            seen[bears] += 1
    assert min(seen.values()) > 20


def test_the_moment_about_the_normal_is_limited_as_the_docstring_says():
    A, G = SURFACE.limits(64, "inner"), SURFACE.grasp_map
    carried = np.vstack([G[[0, 1, 3, 4, 5]], *(np.eye(12)[[k]] for k in (2, 5, 8))])  # evenly, and nothing sideways
    most = -linprog(-G[2], A, np.zeros(len(A)), carried, [0, 0, 0, 0, 4, 1, 1, 1], (None, None)).fun
    assert np.isclose(most, 0.5 * np.hypot(0.1, 0.04) * 4, rtol=2e-3)  # the pyramid's sides are at 0.9988 of μ


# ---------------------------------------------------------------- kinds that are added later


@dataclass(frozen=True)
class RoundSole(Contact):
    """A disc, by points around its rim."""

    frame: str
    radius: float
    mu: float
    rows = slice(0, 6)

    def axes(self, rotation):
        return rotation

    @property
    def points(self):
        angle = np.linspace(0, 2 * np.pi, 12, endpoint=False)
        return self.radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)

    @property
    def point_names(self):
        return tuple(f"rim {k} of {self.frame!r}" for k in range(12))


@dataclass(frozen=True)
class Grasp(Contact):
    """A hand around a bar: it bears any wrench."""

    frame: str
    mu: float = 0.0
    rows = slice(0, 6)
    points = np.array([[0.02, 0, 0], [-0.02, 0, 0.03], [0, 0, -0.03]])
    point_names = ("thumb", "finger", "palm")

    def axes(self, rotation):
        return rotation

    def limits(self, sides, pyramid):
        return np.zeros((0, 9))

    def limit_names(self, sides):
        return []


def test_a_new_kind_needs_rows_axes_and_points_only():
    rest, on_disc = np.zeros(6), [RoundSole("fl", 0.3, 0.6)]
    held = tw.contact_forward_dynamics(BOX, BOX.neutral(), rest, rest, on_disc)
    weight = BOX.mass * 9.81
    assert np.allclose(held.forces["fl"][3:], [0, 0, weight], rtol=0, atol=1e-12)
    assert np.allclose(held.forces["fl"][:3], [-0.2 * weight, 0.3 * weight, 0], rtol=0, atol=1e-12)
    assert not tw.stance_margins(BOX, BOX.neutral(), on_disc).stands  # the centre is 0.36 m away
    assert tw.stance_margins(BOX, BOX.neutral(), [RoundSole("fl", 0.4, 0.6)]).stands


def test_a_grasp_bears_what_no_foot_can():
    rest = np.zeros(6)
    hanging = tw.friction_inverse_dynamics(BOX, BOX.neutral(), rest, rest, [Grasp("fl")])
    assert np.allclose(hanging.forces["fl"][3:], [0, 0, BOX.mass * 9.81], rtol=0, atol=1e-11)
    assert hanging.binding == ()


# ---------------------------------------------------------------- what is refused


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: tw.PointContact("foot", -0.1), "'foot': mu: expected at least 0, got -0.1"),
        (lambda: tw.PointContact("foot", np.nan), "'foot': mu: expected finite"),
        (lambda: tw.PointContact("foot", np.inf), "'foot': mu: expected finite"),
        (lambda: tw.PointContact("foot", 1j), "'foot': mu: expected real"),
        (lambda: tw.PointContact("foot", [0.1, 0.2]), "'foot': mu: expected shape"),
        (lambda: tw.PointContact("foot", 0.5, (0, 0, 0)), "'foot': normal: expected a direction"),
        (lambda: tw.PointContact("foot", 0.5, (0, 1)), "'foot': normal: expected shape"),
        (lambda: tw.SurfaceContact("sole", (0.1, 0.0), 0.5), "above 0, got .*; a line is two PointContacts at its"),
        (lambda: tw.SurfaceContact("sole", (0.1, -0.1), 0.5), r"half_size: expected lengths above 0, got .*\]$"),
        (lambda: tw.SurfaceContact("sole", 0.1, 0.5), "'sole': half_size: expected shape"),
        (lambda: SURFACE.limits(2, "inner"), "sides: expected a whole number, at least 3, got 2"),
        (lambda: SURFACE.limits(4.5, "inner"), "sides: expected a whole number, at least 3, got 4.5"),
        (lambda: SURFACE.limits(4, "middle"), "pyramid: expected 'inner' or 'outer', got 'middle'"),
    ],
)
def test_what_is_no_contact_is_refused(make, said):
    with pytest.raises(ValueError, match=said):
        make()


def on_the_world() -> tw.Model:
    builder = tw.Builder("arm")
    builder.link("hand", parent="base_link", joint=tw.Revolute("y"), inertia=tw.SpatialInertia(1, [1, 0, 0], np.eye(3)))
    return builder.build()


@pytest.mark.parametrize(
    ("model", "contacts", "said"),
    [
        (GO2, [tw.PointContact("FL_fot", 0.6)], "unknown frame 'FL_fot'.*did you mean 'FL_foot'"),
        (GO2, ["FL_foot"], r"got 'FL_foot'; PointContact\('FL_foot', mu\) makes one"),
        (GO2, "FL_foot", "expected a sequence of contacts, got the single 'FL_foot'"),
        (GO2, FEET[0], "expected a sequence of contacts, got the single PointContact"),
        (GO2, [FEET[0], tw.SurfaceContact("FL_foot", SOLE, 0.6)], r"more on \['FL_foot'\]"),
        (on_the_world(), [tw.PointContact("base_link", 0.6)], "'base_link': the world carries this frame"),
    ],
)
def test_contacts_that_cannot_be_are_refused(model, contacts, said):
    with pytest.raises(ValueError, match=said):
        tw.constraint_jacobian(model, model.neutral(), contacts)


def test_no_contacts_are_no_rows():
    assert tw.constraint_jacobian(BOX, BOX.neutral(), []).shape == (0, 6)

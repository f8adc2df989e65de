"""A line is two points: of their six rows five are independent, and what touches along it turns about it freely."""

import numpy as np
import pytest

import twistwrench as tw

from ..truth import largest

MASS, AHEAD, UP, HALF, G = 3.0, 0.1, 0.4, 0.25, 9.81
ABOUT_Y = 0.05
LINE = [tw.PointContact(end, 0.8) for end in ("left", "right")]
HEAVY = tw.SpatialInertia(MASS, [AHEAD, 0, UP], np.diag([0.04, ABOUT_Y, 0.03]))
ABOUT_LINE = ABOUT_Y + MASS * (AHEAD**2 + UP**2)


def plate(joint: bool = False) -> tw.Model:
    """A plate that stands on a line along y: free with a frame at each end, or on a hinge."""
    if joint:
        hinged = tw.Builder("hinged")
        hinged.link("plate", parent="base_link", joint=tw.Revolute("y"), inertia=HEAVY)
        return hinged.build()
    builder = tw.Builder("plate", base="floating", root_inertia=HEAVY)
    for end, y in (("left", HALF), ("right", -HALF)):
        builder.link(end, parent="base_link", placement=tw.SE3(np.eye(3), [0, y, 0]))
    return builder.build()


FREE, REST = plate(), np.zeros(6)
Q = FREE.neutral()


def test_it_falls_about_the_line_and_both_ends_bear_alike():
    fall = tw.contact_forward_dynamics(FREE, Q, REST, REST, LINE)
    alpha = MASS * G * AHEAD / ABOUT_LINE
    assert (fall.rank, fall.redundant) == (5, 1)
    assert largest(fall.qdd - alpha * np.eye(6)[1]) < 1e-12 * alpha
    force = MASS * (alpha * np.array([UP, 0, -AHEAD]) + [0, 0, G])
    for end in ("left", "right"):
        assert largest(fall.forces[end] - force / 2) < 1e-12 * MASS * G


def test_a_push_along_the_line_is_shared_alike():
    push = 7.0 * np.eye(6)[4]
    held = tw.contact_forward_dynamics(FREE, Q, REST, push, LINE)
    assert [held.forces[end][1] for end in ("left", "right")] == pytest.approx([-3.5, -3.5])


def test_inverse_dynamics_gives_the_forces_of_the_fall_and_holds_the_cones():
    fall = tw.contact_forward_dynamics(FREE, Q, REST, REST, LINE)
    for found in (
        tw.contact_inverse_dynamics(FREE, Q, REST, fall.qdd, LINE),
        tw.friction_inverse_dynamics(FREE, Q, REST, fall.qdd, LINE),
    ):
        for end in ("left", "right"):
            assert largest(found.forces[end] - fall.forces[end]) < 1e-9 * MASS * G
        assert largest(found.tau) < 1e-9 * MASS * G


def test_after_an_impact_it_has_the_angular_momentum_about_the_line():
    v = np.array([0.3, 0.7, -0.2, 1.0, 0.5, -0.4])
    after = tw.impact(FREE, Q, v, LINE).v
    body = HEAVY.matrix() @ v  # about the frame's origin, which is on the line
    assert largest(after - body[1] / ABOUT_LINE * np.eye(6)[1]) < 1e-12


def test_it_stands_where_its_centre_is_over_the_line_and_tips_where_it_is_not():
    assert not tw.Scene(FREE, contacts=LINE).can_stand()
    over = FREE.integrate(Q, -np.arctan2(AHEAD, UP) * np.eye(6)[1])
    assert tw.Scene(FREE, contacts=LINE).can_stand(over)
    assert abs(tw.stance_margins(FREE, over, LINE).tip) < 1e-12  # m: it stands on an edge


def test_in_time_it_is_a_pendulum():
    """By Runge and Kutta, and on the ground, where it stays on its line, by time stepping."""
    hinged = plate(joint=True)
    clock = {"dt": 0.005, "steps": 40}
    truth = tw.simulate(hinged, [0.0], [0.5], **clock)
    start = 0.5 * np.eye(6)[1]
    for more, bound in (({}, 1e-8), ({"ground": tw.Ground()}, 0.01)):
        turned = tw.simulate(FREE, Q, start, contacts=LINE, **clock, **more)
        angle = 2 * np.arctan2(turned.q[:, 4], turned.q[:, 6])
        assert np.abs(angle - truth.q[:, 0]).max() < bound
        assert np.abs(turned.q[:, :3]).max() < 0.2 * bound
    assert truth.q[-1, 0] > 0.2

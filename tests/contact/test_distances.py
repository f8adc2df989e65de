"""Two points at a distance: closed forms, what the row is a derivative of, Pinocchio, and points that meet."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge

from ..strategies import Recipe
from ..touching import error

G, H = 9.81, 1e-20
TREE = Recipe(7, seed=4, branching=0.7).model  # of five kinds of joints; test_loops.py has all of them, in 50 digits
ROD = [tw.DistanceConstraint("joint_2", "joint_5")]


def trammel(m1=1.3, m2=0.7):
    """Two beads on rails along x and z: a rod between them, as in the ellipsograph of Archimedes."""
    builder = tw.Builder("trammel")
    for name, axis, mass in (("across", "x", m1), ("along", "z", m2)):
        body = tw.SpatialInertia.from_sphere(mass, 0.1)
        builder.link(name, parent="base_link", joint=tw.Prismatic(axis), inertia=body)
    return builder.build(), [tw.DistanceConstraint("across", "along")]


@pytest.mark.parametrize(("theta", "rate"), [(0.3, 0.0), (1.1, 4.0), (-2.0, -7.0)])
def test_two_beads_and_a_rod_move_as_lagrange_says(theta, rate):
    """(m₁ c² + m₂ s²) d² θ̈ + (m₂ − m₁) s c d² θ̇² = m₂ g d s, with x = d s and z = d c."""
    (model, rod), d, m1, m2 = trammel(), 0.9, 1.3, 0.7
    s, c = np.sin(theta), np.cos(theta)
    turn = (m2 * G * s / d - (m2 - m1) * s * c * rate**2) / (m1 * c**2 + m2 * s**2)
    q, v = d * np.array([s, c]), d * rate * np.array([c, -s])
    qdd = d * (turn * np.array([c, -s]) - rate**2 * np.array([s, c]))
    got = tw.contact_forward_dynamics(model, q, v, [0, 0], rod)
    np.testing.assert_allclose(got.qdd, qdd, rtol=0, atol=2e-14 * np.abs(qdd).max())
    np.testing.assert_allclose(got.forces["across"] * s, m1 * qdd[0], rtol=0, atol=1e-13 * np.abs(qdd).max())
    back = tw.contact_inverse_dynamics(model, q, v, qdd, rod, motors=["along"])
    np.testing.assert_allclose(back.tau, 0, atol=1e-12)
    hit = tw.impact(model, q, [1.0, 0.0], rod)  # of ½ I θ̇² the bead across is left its share
    np.testing.assert_allclose(hit.v, m1 * c / (m1 * c**2 + m2 * s**2) * np.array([c, -s]), rtol=0, atol=1e-15)


def test_a_simulated_rod_keeps_its_length_and_the_energy():
    model, rod = trammel()
    q, v = tw.project_state(model, [0.5, 0.6], [1.0, 0.0], rod, {"across": tw.SE3(np.eye(3), [0.9, 0, 0])})
    assert np.hypot(*q) == pytest.approx(0.9, abs=1e-12)
    run = tw.simulate(model, q, v, dt=2e-3, duration=0.1, contacts=rod)
    np.testing.assert_allclose(np.hypot(*run.q.T), 0.9, rtol=0, atol=1e-11)
    assert np.ptp(run.energy) < 1e-7 * np.abs(run.energy).max()
    leg = [tw.DistanceConstraint("across", "along", velocity=[0.2], acceleration=[0.5])]  # a motor extends it
    start = tw.impact(model, q, v, leg).v
    run = tw.simulate(model, q, start, dt=2e-3, duration=0.1, contacts=leg)
    assert np.hypot(*run.q[-1]) == pytest.approx(0.9 + 0.2 * 0.1 + 0.25 * 0.1**2, abs=1e-11)


def test_the_row_and_its_rate_are_derivatives_of_the_distance():
    rng = np.random.default_rng(2)
    q, v = TREE.random_configuration(rng=rng), rng.standard_normal(TREE.nv)
    later = TREE.integrate(q, 1j * H * v)
    d = tw.contact_placements(TREE, later, ROD)["joint_2"].translation
    apart = [tw.frame_placement(TREE, q, name).translation for name in ROD[0].frames]
    assert d[0].real == pytest.approx(np.linalg.norm(apart[0] - apart[1]), rel=1e-14)
    J, bias = tw.constraint_jacobian(TREE, q, ROD), tw.constraint_bias(TREE, q, v, ROD)
    assert (J @ v)[0] == pytest.approx(d[0].imag / H, rel=1e-13)
    assert bias == pytest.approx((tw.constraint_jacobian(TREE, later, ROD) @ v).imag / H, rel=1e-13)


def test_its_row_is_pinocchios_jacobians_along_the_line():
    """Pinocchio 4.1 has no such constraint: the row comes of its Jacobians of both points, q̈ of the dense equations."""
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    rng = np.random.default_rng(3)
    q, (v, tau) = TREE.random_configuration(rng=rng), rng.standard_normal((2, TREE.nv))
    there = bridge.to_pinocchio_model(TREE)
    data, V = there.createData(), bridge.to_pinocchio_tangent(TREE, v)
    pin.computeJointJacobians(there, data, q)
    pin.forwardKinematics(there, data, q, V, 0 * V)
    pin.updateFramePlacements(there, data)
    i, k = (there.getFrameId(name) for name in ROD[0].frames)
    J, drift = [], []
    for frame in (i, k):
        J.append(pin.getFrameJacobian(there, data, frame, pin.LOCAL_WORLD_ALIGNED)[:3])
        drift.append(pin.getFrameClassicalAcceleration(there, data, frame, pin.LOCAL_WORLD_ALIGNED).linear)
    way = data.oMf[i].translation - data.oMf[k].translation
    d, rows = np.linalg.norm(way), bridge.from_pinocchio_contact_jacobian(TREE, J[0] - J[1])
    row = way / d @ rows
    v = v - row * (row @ v) / (row @ row)
    np.testing.assert_allclose(tw.constraint_jacobian(TREE, q, ROD)[0], row, rtol=0, atol=1e-13)
    got, M = tw.contact_forward_dynamics(TREE, q, v, tau, ROD), tw.crba(TREE, q)
    bias = tw.constraint_bias(TREE, q, v, ROD)
    equations = np.block([[M, -row[:, None]], [row, 0]])
    expected = np.linalg.solve(equations, np.r_[tau - tw.nonlinear_effects(TREE, q, v), -bias])
    assert error(np.r_[got.qdd, got.forces["joint_2"]], expected) < 1e-11


def test_batches_and_programs_compute_the_same():
    rng = np.random.default_rng(5)
    q = np.stack([TREE.random_configuration(rng=rng) for _ in range(3)])
    v, tau = rng.standard_normal((2, 3, TREE.nv))
    many = tw.contact_forward_dynamics(TREE, q, v, tau, ROD)
    assert error(many.qdd[2], tw.contact_forward_dynamics(TREE, q[2], v[2], tau[2], ROD).qdd) < 1e-11
    J = tw.constraint_jacobian(TREE, q, ROD)
    for dtype in (np.float32, np.float64):
        got = tw.compile(TREE, "J_c", contacts=ROD, dtype=dtype)(TREE.normalize(q.astype(dtype)))
        assert got.dtype == dtype
        np.testing.assert_allclose(got, J, rtol=0, atol=100 * np.finfo(dtype).eps)


def test_points_that_meet_have_no_line():
    model, rod = trammel()
    zero, program = np.zeros(2), tw.compile(model, "J_c", contacts=rod)
    for ask in (
        lambda q: tw.constraint_jacobian(model, q, rod),
        lambda q: tw.contact_forward_dynamics(model, q, 0 * q, 0 * q, rod),
        lambda q: tw.impact(model, q, 0 * q, rod),
        program,
    ):
        for q in (zero, np.stack([zero + 1, zero])):
            with pytest.raises(
                tw.SingularError, match="contact 'across': its points meet, so the line has no direction"
            ):
                ask(q)
    with pytest.raises(ValueError, match="expected frames of two bodies, got 'across' of the same one"):
        tw.constraint_jacobian(model, zero, [tw.DistanceConstraint("across", "across")])
    with pytest.raises(ValueError, match=r"velocity: expected shape \(..., 1\)"):
        tw.DistanceConstraint("across", "along", velocity=[1, 2])
    with pytest.raises(ValueError, match="expected contacts with the ground that do not pull"):
        tw.stance_margins(model, [0.5, 0.6], rod)

"""A thin wheel that rolls: rows against differences, a coin that leans, and the benchmark bicycle."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

from ..mechanisms import G

R, CIRCLE, LEAN = 0.1, 1.0, 0.3
COIN = tw.Builder(
    "coin",
    base="floating",
    root="coin",
    root_inertia=tw.SpatialInertia(1.0, [0, 0, 0], R**2 / 4 * np.diag([1.0, 2.0, 1.0])),
).build()
TURN = np.sqrt(4 * G * np.tan(LEAN) / (6 * CIRCLE + R * np.sin(LEAN)))
"""rad/s: at which it goes round, from the momentum about its centre."""

Q = np.array([0, 0, R * np.cos(LEAN), -np.sin(LEAN / 2), 0, 0, np.cos(LEAN / 2)])
V = np.array([0, TURN * CIRCLE / R, TURN * np.cos(LEAN), TURN * CIRCLE, 0, 0])


def rim(mu=0.8, **options):
    return [tw.WheelContact("coin", R, mu, **options)]


def test_rows_and_bias_of_a_wheel_on_a_robot_are_differences():
    model, rng, h = tw.random_tree(4, rng=5, base="floating"), np.random.default_rng(0), 1e-5
    wheel = tw.WheelContact(model.joint_names[-1], 0.07, 0.5, axis=[1, 2, -0.5], normal=[0.3, -0.2, 1.0])
    q, v = model.random_configuration(rng=rng), rng.normal(size=model.nv)

    def lowest(q):
        T = tw.frame_placement(model, q, wheel.frame)
        angle = np.linspace(0, 2 * np.pi, 400001)
        side = np.cross(wheel.axis, [0, 0, 1.0])
        side /= np.linalg.norm(side)
        points = T.act(0.07 * (np.cos(angle)[:, None] * side + np.sin(angle)[:, None] * np.cross(wheel.axis, side)))
        return points[(points @ wheel.normal).argmin()]

    J, T = tw.frame_jacobian(model, q, wheel.frame, "local_world_aligned"), tw.frame_placement(model, q, wheel.frame)
    moves = J[3:] @ v + np.cross(J[:3] @ v, lowest(q) - T.translation)
    assert np.abs(tw.constraint_jacobian(model, q, [wheel]) @ v - moves).max() < 1e-4  # so near is a point of the rim
    ahead, back = (tw.constraint_jacobian(model, model.integrate(q, s * h * v), [wheel]) @ v for s in (1, -1))
    assert np.abs((ahead - back) / (2 * h) - tw.constraint_bias(model, q, v, [wheel])).max() < 1e-7  # h², rounding / h


@pytest.mark.slow
def test_a_coin_that_leans_rolls_round_by_runge_kutta_for_ever():
    s = tw.simulate(COIN, Q, V, dt=0.005, duration=1.0, contacts=rim())
    assert np.ptp(s.q[:, 2]) < 1e-7
    assert np.abs(s.q[-1, :2] - CIRCLE * np.array([np.sin(TURN), 1 - np.cos(TURN)])).max() < 1e-6
    assert np.ptp(s.energy) < 1e-6
    force = s.contact_forces["coin"][100]
    assert force[2] == pytest.approx(G, abs=1e-6)
    assert np.hypot(*force[:2]) == pytest.approx(TURN**2 * CIRCLE, abs=1e-6)


def test_on_a_ground_it_rolls_round_to_the_order_of_the_step():
    """Order 1: with steps half as long the way is off by half as much; and it slips where friction is too small."""
    off = []
    for dt in (0.002, 0.001):
        s = tw.simulate(COIN, Q, V, dt=dt, duration=0.4, contacts=rim(), ground=tw.Ground())
        end = CIRCLE * np.array([np.sin(0.4 * TURN), 1 - np.cos(0.4 * TURN)])
        off.append(np.linalg.norm(s.q[-1, :2] - end))
        assert np.abs(s.contact_forces["coin"][:, 2] - G).max() < 1.0
        assert not s.remarks
    assert off[0] < 0.01
    assert np.log2(off[0] / off[1]) > 0.8
    need = TURN**2 * CIRCLE / G
    for mu, slides in ((1.1 * need, False), (0.9 * need, True)):
        s = tw.simulate(COIN, Q, V, dt=0.001, steps=20, contacts=rim(mu), ground=tw.Ground())
        assert any(remark.kind == "slide" for remark in s.remarks) == slides


def test_what_is_no_wheel_is_refused_and_one_that_lies_flat_is_singular():
    for bad in ({"radius": 0.0}, {"axis": [0, 0, 0]}, {"normal": [0, 0, 0]}, {"mu": -0.1}, {"restitution": 2}):
        with pytest.raises(ValueError, match=f"contact 'f': {next(iter(bad))}"):
            tw.WheelContact(**({"frame": "f", "radius": 0.1, "mu": 0.5} | bad))
    flat = [0, 0, 0, np.sqrt(0.5), 0, 0, np.sqrt(0.5)]
    with pytest.raises(tw.SingularError, match="contact 'coin': the wheel lies flat"):
        tw.constraint_jacobian(COIN, flat, rim())


# ---------------------------------------------------------------- the benchmark bicycle


def bicycle():
    """The benchmark of Meijaard, Papadopoulos, Ruina and Schwab (2007), table 1: z down there, up here.

    Wheels of 0.3 m and 0.35 m, a wheel base of 1.02 m, a trail of 0.08 m, a steering axis tilted by π/10.
    """
    flip = np.diag([1.0, -1.0, -1.0])  # the axes of the paper: x ahead, y to the right, z down

    def rigid(mass, com, inertia):
        return tw.SpatialInertia(mass, flip @ np.array(com), flip @ np.array(inertia) @ flip)

    base, trail, tilt = 1.02, 0.08, np.pi / 10
    frame = rigid(85.0, [0.3, 0, -0.9], [[9.2, 0, 2.4], [0, 11, 0], [2.4, 0, 2.8]])
    builder = tw.Builder("bicycle", base="floating", root="rear", root_inertia=frame)
    hub, head = np.array([0, 0, 0.3]), np.array([base + trail, 0, 0.0])  # the steering axis meets the ground here
    steer = np.array([-np.sin(tilt), 0, np.cos(tilt)])
    fork = rigid(
        4.0, np.array([0.9, 0, -0.7]) - flip @ head, [[0.05892, 0, -0.00756], [0, 0.06, 0], [-0.00756, 0, 0.00708]]
    )
    builder.link("rear_wheel", parent="rear", joint=tw.Revolute("y"), placement=tw.SE3(np.eye(3), hub),
                 inertia=tw.SpatialInertia(2.0, [0, 0, 0], np.diag([0.0603, 0.12, 0.0603])))  # fmt: skip
    builder.link("front", parent="rear", joint=tw.Revolute(steer), placement=tw.SE3(np.eye(3), head), inertia=fork)
    builder.link("front_wheel", parent="front", joint=tw.Revolute("y"),
                 placement=tw.SE3(np.eye(3), np.array([base, 0, 0.35]) - head),
                 inertia=tw.SpatialInertia(3.0, [0, 0, 0], np.diag([0.1405, 0.28, 0.1405])))  # fmt: skip
    return builder.build(), [tw.WheelContact("rear_wheel", 0.3, 1.0), tw.WheelContact("front_wheel", 0.35, 1.0)]


PUBLISHED = {  # table 2 of the paper: capsize, castering, weave; at rest it falls over either way
    0.0: (3.13164324790656, -3.13164324790656, 5.53094371765393, -5.53094371765393),
    1.0: (-3.13423125066578, -7.11008014637441, 3.52696170990070 + 0.80774027519930j),
    5.0: (-0.32286642900409, -14.07838969279822, -0.77534188219585 + 4.46486771378823j),
}


@pytest.mark.one_case
@pytest.mark.parametrize("speed", sorted(PUBLISHED))
def test_the_bicycle_weaves_and_capsizes_as_published(speed):
    model, wheels = bicycle()
    q = model.neutral()
    v = np.zeros(model.nv)
    v[3] = speed
    for joint, radius in (("rear_wheel", 0.3), ("front_wheel", 0.35)):
        v[model.v_slice[model.frame(joint).body]] = speed / radius
    assert np.abs(tw.constraint_jacobian(model, q, wheels) @ v).max() < 1e-14

    def rates(x):
        """Return the rates of a step from the steady motion, and of a change of v, in axes that go along with it."""
        there, u = model.integrate(q, x[: model.nv]), v + x[model.nv :]
        qdd = tw.contact_forward_dynamics(model, there, u, 0 * u, wheels).qdd
        ahead = model.integrate(there, 1e-6 * u), model.integrate(there, -1e-6 * u)
        along = [model.difference(model.integrate(q, s * 1e-6 * v), y) for s, y in zip((1, -1), ahead)]
        return np.concatenate([(along[0] - along[1]) / 2e-6, qdd])

    n, h = 2 * model.nv, 1e-4
    A = np.stack([(rates(h * e) - rates(-h * e)) / (2 * h) for e in np.eye(n)], axis=1)
    found = np.linalg.eigvals(A)
    for expected in PUBLISHED[speed]:
        assert np.abs(found - expected).min() < 1e-6

"""Motion in time: closed forms with the order of every method, what mechanics keeps, and other programs."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import NamedTuple

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench.simulation import METHODS
from twistwrench.simulation.variational import bracket, momentum_and_force
from twistwrench.spatial import rotation_to_quaternion

from ..robots import shared
from ..sampling import sampled
from ..strategies import Recipe

ORDERS = {"euler": 1, "semi-implicit": 1, "midpoint": 2, "rk4": 4, "variational": 2}


def floating_without_gravity(model):
    return replace(model, gravity=np.zeros(3))


@cache
def body(*moments):
    """One body of 2 kg that flies freely, its centre of mass in its origin, without weight."""
    builder = tw.Builder(
        "body", base="floating", root_inertia=tw.SpatialInertia(2.0, np.zeros(3), np.diag(moments)), gravity=np.zeros(3)
    )
    return builder.build()


class Exact(NamedTuple):
    """A motion that is known: where it starts, and where it is at the time T."""

    model: tw.Model
    T: float
    q: np.ndarray
    v: np.ndarray
    q_end: np.ndarray
    v_end: np.ndarray

    def error(self, motion):
        return max(
            np.abs(self.model.difference(self.q_end, motion.q[-1])).max(), np.abs(motion.v[-1] - self.v_end).max()
        )


@cache
def pendulum() -> Exact:
    """Let go from rest at 2 rad: sin ½q = k sn(K − ω t), with k = sin 1 and ω² = m g l / I."""
    model, T, k, omega = shared("pendulum"), 0.5, mpmath.sin(1), mpmath.sqrt(mpmath.mpf(9.81) / mpmath.mpf("1.001"))
    u = mpmath.ellipk(k**2) - omega * T
    sn, cn = (mpmath.ellipfun(name, u, k=k) for name in ("sn", "cn"))
    end = float(2 * mpmath.asin(k * sn)), float(-2 * k * omega * cn)
    return Exact(model, T, np.array([2.0]), np.zeros(1), np.array(end[:1]), np.array(end[1:]))


@cache
def symmetric_top() -> Exact:
    """It precesses evenly: R = exp(t L/A) R₀ exp(−t Ω e₃), with Ω = (C − A) ω₃ / A, and flies straight on."""
    A, C, T, w, speed = 2.0, 0.5, 0.5, np.array([0.3, -1.2, 4.0]), np.array([0.5, -0.2, 0.8])
    R0, spin = tw.exp3([0.4, -0.3, 0.9]), (C - A) / A * w[2]
    L = R0 @ (np.array([A, A, C]) * w)
    R = tw.exp3(T * L / A) @ R0 @ tw.exp3([0, 0, -T * spin])
    w_end = tw.exp3([0, 0, T * spin]) @ w
    return free_flight(body(A, A, C), T, R0, w, R, w_end, speed)


@cache
def asymmetric_top() -> Exact:
    """Jacobi's solution of Euler's equations (Landau and Lifshitz, Mechanics, 37), the last angle by quadrature."""
    I1, I2, I3 = I = (mpmath.mpf(1), mpmath.mpf(2), mpmath.mpf(3))
    a, c, T = mpmath.mpf(1), mpmath.mpf(2), mpmath.mpf(0.5)  # ω(0) = (a, 0, c)
    energy2, L2 = I1 * a**2 + I3 * c**2, (I1 * a) ** 2 + (I3 * c) ** 2
    rate = mpmath.sqrt((I3 - I2) * (L2 - energy2 * I1) / (I1 * I2 * I3))
    k2 = (I2 - I1) * (energy2 * I3 - L2) / ((I3 - I2) * (L2 - energy2 * I1))
    b = mpmath.sqrt((energy2 * I3 - L2) / (I2 * (I3 - I2)))

    def omega(t):
        sn, cn, dn = (mpmath.ellipfun(name, rate * t, m=k2) for name in ("sn", "cn", "dn"))
        return [a * cn, b * sn, c * dn]

    def precession(t):
        w = omega(t)
        return mpmath.sqrt(L2) * (I1 * w[0] ** 2 + I2 * w[1] ** 2) / (I1**2 * w[0] ** 2 + I2**2 * w[1] ** 2)

    def attitude(t):  # Euler's angles about the angular momentum, which is on z
        x, y, z = (float(i * w) for i, w in zip(I, omega(t), strict=True))
        turned = float(mpmath.quad(precession, [0, t])) if t else 0.0
        z_to_body = tw.exp3([np.arctan2(np.hypot(x, y), z), 0, 0]) @ tw.exp3([0, 0, np.arctan2(x, y)])
        return tw.exp3([0, 0, turned]) @ z_to_body

    w0, w1 = (np.array(omega(t), float) for t in (0, T))
    return free_flight(body(1.0, 2.0, 3.0), float(T), attitude(0), w0, attitude(T), w1, np.array([0.1, 0.7, -0.4]))


def free_flight(model, T, R0, w0, R, w, speed) -> Exact:
    """A turn, and a straight flight at a speed in the world."""

    def q(position, turn):
        return np.concatenate([position, rotation_to_quaternion(turn)])

    v0, v = (np.concatenate([omega, turn.T @ speed]) for omega, turn in ((w0, R0), (w, R)))
    return Exact(model, T, q(np.zeros(3), R0), v0, q(speed * T, R), v)


# ---------------------------------------------------------------- closed forms


@pytest.mark.one_case
@pytest.mark.parametrize("method", ORDERS)
@pytest.mark.parametrize("exact", [pendulum, symmetric_top, asymmetric_top], ids=lambda f: f.__name__)
def test_the_order_is_the_one_of_theory(exact, method):
    exact, order = exact(), ORDERS[method]
    steps = {1: (40, 80), 2: (20, 40), 4: (12, 24)}[order]
    errors = [
        exact.error(tw.simulate(exact.model, exact.q, exact.v, dt=exact.T / n, steps=n, method=method)) for n in steps
    ]
    assert abs(np.log2(errors[0] / errors[1]) - order) < 0.1, errors
    assert METHODS[method].order == order
    assert errors[1] < {1: 0.02, 2: 1e-3, 4: 5e-7}[order]


def test_a_body_that_slides_under_a_constant_force_is_where_galilei_says():
    motion = tw.simulate(tw.chain(1, joint="prismatic", axis="x"), [0.0], [1.0], dt=0.125, steps=8, tau=[3.0])
    assert motion.q[-1, 0] == pytest.approx(1.0 + 3.0 / 2, rel=1e-14)  # 1 kg
    assert motion.v[-1, 0] == pytest.approx(4.0, rel=1e-14)


# ---------------------------------------------------------------- what mechanics keeps


def tumble(model, rng=0):
    rng = np.random.default_rng(rng)
    return model.random_configuration(rng=rng), rng.standard_normal(model.nv)


@pytest.mark.one_case
@pytest.mark.parametrize("seed", range(3))
def test_the_momentum_of_a_robot_that_floats_freely_is_kept_to_rounding(seed):
    """By the variational method, at a step at which midpoint is visibly off."""
    model = floating_without_gravity(Recipe(4, seed=seed, base="floating").model)
    q, v = tumble(model, seed)
    h = {
        m: tw.simulate(model, q, v, dt=0.02, steps=15, method=m).momentum_about_origin
        for m in ("variational", "midpoint")
    }
    changed = {m: np.abs(x - x[0]).max() / np.abs(x[0]).max() for m, x in h.items()}
    assert changed["variational"] < 1e-13
    assert changed["midpoint"] > 1e-6


@pytest.mark.slow
def test_with_gravity_the_momentum_about_the_vertical_and_the_horizontal_one_are_kept():
    model = Recipe(4, seed=1, base="floating").model
    h = tw.simulate(model, *tumble(model), dt=0.02, steps=15, method="variational").momentum_about_origin
    changed = np.abs(h - h[0]).max(axis=0)
    kept = [2, 3, 4]  # k_z, l_x, l_y
    assert changed[kept].max() < 1e-12 * np.abs(h[0]).max()
    assert changed[[0, 1, 5]].min() > 1e-3


def test_the_energy_of_the_variational_method_swings_and_does_not_drift():
    """Over 40 swings its error stays that of the first five; that of Runge-Kutta grows with time."""
    model = shared("pendulum")
    e = {m: tw.simulate(model, [2.0], [0.0], dt=0.2, steps=600, method=m).energy for m in ("variational", "rk4")}
    error = {m: np.abs(x - x[0]) for m, x in e.items()}
    first, last = (error["variational"][part].max() for part in (slice(0, 75), slice(-75, None)))
    assert last < 1.01 * first
    assert error["rk4"][-75:].max() > 5 * error["rk4"][:75].max()


@pytest.mark.slow
def test_the_energy_of_a_tumbling_body_is_held_over_long_times():
    model, v = body(1.0, 2.0, 3.0), np.array([0.1, 2.0, 0.1, 0.0, 0.0, 0.0])  # about the unstable axis
    energy = tw.simulate(model, model.neutral(), v, dt=0.3, steps=150, method="variational").energy
    error = np.abs(energy - energy[0])
    assert error[-50:].max() < 1.05 * error[:50].max()
    assert error.max() < 0.02 * energy[0]


def test_the_variational_step_is_symplectic():
    """Its Jacobian D in (q, p) of the double pendulum has Dᵀ Ω D = Ω; by central differences of 1e-5."""
    model = shared("double_pendulum")

    def step(method, x):
        q, p = x[:2], x[2:]
        motion = tw.simulate(model, q, np.linalg.solve(tw.crba(model, q), p), dt=0.1, steps=1, method=method)
        return np.concatenate([motion.q[-1], tw.crba(model, motion.q[-1]) @ motion.v[-1]])

    def defect(method):
        x, h = np.array([0.7, -1.1, 0.4, 0.3]), 1e-5
        D = np.stack([(step(method, x + h * e) - step(method, x - h * e)) / (2 * h) for e in np.eye(4)], axis=1)
        omega = np.kron([[0, 1], [-1, 0]], np.eye(2))
        return np.abs(D.T @ omega @ D - omega).max()

    assert defect("variational") < 1e-9
    assert defect("midpoint") > 1e-4
    assert defect("semi-implicit") > 1e-4  # M depends on q


def test_the_variational_method_goes_back_the_way_it_came():
    model = Recipe(4, seed=2, base="floating").model
    there = tw.simulate(model, *tumble(model), dt=0.05, steps=5, method="variational")
    back = tw.simulate(model, there.q[-1], -there.v[-1], dt=0.05, steps=5, method="variational")
    assert np.abs(model.difference(back.q[-1], there.q[0])).max() < 1e-12
    assert np.abs(back.v[-1] + there.v[0]).max() < 1e-12


@pytest.mark.slow
@pytest.mark.one_case
@pytest.mark.parametrize("method", sampled(METHODS, 2))
def test_where_a_robot_starts_makes_no_difference_without_gravity(method):
    """All methods work in the body's terms: a motion that is moved and turned is the same motion."""
    model = floating_without_gravity(shared("go2"))
    q, v = tumble(model)
    moved = q.copy()
    T = tw.SE3(tw.exp3([0.5, 1.0, -2.0]), np.array([3.0, -1.0, 2.0]))
    there = T @ tw.SE3(model.joints[1].transform(q[:7]).rotation, q[:3])
    moved[:7] = np.concatenate([there.translation, rotation_to_quaternion(there.rotation)])
    a, b = (tw.simulate(model, start, v, dt=0.02, steps=5, method=method) for start in (q, moved))
    assert np.abs(a.v - b.v).max() < 1e-11
    assert (
        np.abs(
            (T @ model.joints[1].transform(a.q[-1, :7])).matrix() - model.joints[1].transform(b.q[-1, :7]).matrix()
        ).max()
        < 1e-11
    )


@pytest.mark.parametrize("method", METHODS)
def test_quaternions_stay_of_length_one(method):
    model = body(1.0, 2.0, 3.0)
    q = tw.simulate(model, *tumble(model), dt=0.1, steps=30, method=method).q
    assert np.abs((q[:, 3:] ** 2).sum(axis=-1) - 1).max() < 1e-14


def test_what_a_policy_does_is_what_the_energy_gains():
    """dE/dt = τ·v, its integral by Simpson's rule."""
    model = shared("double_pendulum")

    def policy(t, q, v):
        return np.array([np.sin(3 * t), 0.2]) - 0.1 * v

    s = tw.simulate(model, [0.3, -0.2], [0.0, 1.0], dt=0.0025, steps=400, tau=policy)
    power = np.array([policy(*x) @ x[2] for x in zip(s.t, s.q, s.v, strict=True)])
    work = 0.0025 / 3 * (power[0] + 4 * power[1::2].sum() + 2 * power[2:-1:2].sum() + power[-1])
    assert s.energy[-1] - s.energy[0] == pytest.approx(work, abs=1e-8)


# ---------------------------------------------------------------- other programs


@pytest.mark.parametrize("seed", range(4))
def test_momentum_and_force_are_those_of_the_mass_and_coriolis_matrices(seed):
    """M v, and ∂L/∂q = Cᵀ v − ad*ᵥ (M v) − g, from d(M v)/dt = Cᵀ v − g + τ."""
    model = Recipe(6, seed=seed, base="floating").model
    q, v = tumble(model, seed)
    mu, force = momentum_and_force(model, q, v)
    M = tw.crba(model, q)
    expected = tw.coriolis_matrix(model, q, v).T @ v - tw.gravity(model, q) - bracket(model, v).T @ (M @ v)
    assert np.abs(mu - M @ v).max() < 1e-13 * np.abs(mu).max()
    assert np.abs(force - expected).max() < 1e-13 * max(np.abs(expected).max(), np.abs(tw.gravity(model, q)).max())


def test_one_step_on_the_manifold_is_pinocchios():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its integrate is not asked")
    model = Recipe(6, seed=3, base="floating").model
    there = tw.bridge.to_pinocchio_model(model)
    q, v = tumble(model)
    step = tw.simulate(model, q, v, dt=0.1, steps=1, method="euler")
    theirs = pin.integrate(there, q, 0.1 * tw.bridge.to_pinocchio_tangent(model, v))
    base = tw.frame_placement(model, q, model.frame_names[0])
    np.testing.assert_allclose(step.q[1, :3], q[:3] + 0.1 * base.rotation @ v[3:6], rtol=0, atol=1e-13)  # straight on
    for joint, at in zip(model.joints[1:], model.q_slice[1:]):
        if isinstance(joint, tw.FreeFlyer | tw.Planar):
            at = slice(at.start + joint.unit.start, at.stop)
        np.testing.assert_allclose(step.q[1, at], theirs[at], rtol=0, atol=1e-13)
    a = pin.aba(there, there.createData(), q, tw.bridge.to_pinocchio_tangent(model, v), np.zeros(model.nv))
    gained = 0.1 * tw.bridge.from_pinocchio_tangent(model, a)
    turns = np.zeros(model.nv, bool)  # entries along axes that do not turn with the joint
    for joint, at in zip(model.joints, model.v_slice):
        if joint is not None:
            turns[at] = not isinstance(joint, tw.FreeFlyer | tw.Planar) or joint.subspace()[:3].any(axis=0)
    size = np.abs(gained).max()
    np.testing.assert_allclose((step.v[1] - v)[turns], gained[turns], rtol=0, atol=1e-11 * size)
    after = tw.frame_placement(model, step.q[1], model.frame_names[0])
    change = after.rotation @ step.v[1, 3:6] - base.rotation @ v[3:6]
    pushed = base.rotation @ (gained[3:6] + 0.1 * np.cross(v[:3], v[3:6]))
    np.testing.assert_allclose(change, pushed, rtol=0, atol=1e-11 * size)


def textbook_rate(model, tau):
    """ẋ of x = (q, v) by 3-D mechanics: quaternions by q̇ = ½ q ⊗ ω, positions by ṗ = R v, in any kind of number."""

    def quaternion_rate(q, w):
        (x, y, z, s), (a, b, c) = q, w
        return (
            np.array([s * a + y * c - z * b, s * b + z * a - x * c, s * c + x * b - y * a, -x * a - y * b - z * c]) / 2
        )

    def rotate(q, v):
        u, s = q[:3], q[3]
        return v + 2 * np.cross(u, np.cross(u, v) + s * v)

    def rate(_, x):
        x = np.array(x)
        q, v, rates = x[: model.nq], x[model.nq :], []
        for joint, a, b in zip(model.joints[1:], model.q_slice[1:], model.v_slice[1:], strict=True):
            if joint.kind == "spherical":
                rates.append(quaternion_rate(q[a], v[b]))
            elif joint.kind == "free_flyer":
                rates += [rotate(q[a][3:], v[b][3:]), quaternion_rate(q[a][3:], v[b][:3])]
            else:
                rates.append(v[b])
        return np.concatenate([*rates, tw.newton_euler_3d.forward_dynamics(model, q, v, tau)])

    return rate


@pytest.mark.parametrize("method", ["rk4", "variational"])
def test_a_tree_of_balls_moves_as_3d_mechanics_and_dop853_say(method):
    integrate = pytest.importorskip("scipy.integrate", reason="SciPy is not installed: DOP853 is not asked")
    model = Recipe(3, seed=5, base="floating", kinds=("spherical", "revolute")).model
    (q, v), tau, T = tumble(model), np.linspace(-1, 1, model.nv), 0.2
    x = integrate.solve_ivp(
        textbook_rate(model, tau), (0, T), np.concatenate([q, v]), "DOP853", rtol=1e-12, atol=1e-13
    ).y[:, -1]
    q_end, v_end = model.normalize(x[: model.nq]), x[model.nq :]
    errors = []
    for n in (10, 20):
        s = tw.simulate(model, q, v, dt=T / n, steps=n, tau=tau, method=method)
        errors.append(max(np.abs(model.difference(q_end, s.q[-1])).max(), np.abs(s.v[-1] - v_end).max()))
    assert abs(np.log2(errors[0] / errors[1]) - ORDERS[method]) < 0.1, errors


@pytest.mark.slow
def test_the_double_pendulum_moves_as_30_digits_say():
    """3-D mechanics in mpmath, Taylor series of its solution."""
    model, q, v, T, tau = shared("double_pendulum"), [2.0, -1.0], [0.5, 3.0], 0.25, [0.3, -0.2]
    with mpmath.workdps(30):
        rate = textbook_rate(model, np.array([mpmath.mpf(x) for x in tau]))
        solution = mpmath.odefun(
            lambda t, x: list(rate(t, x)), 0, [mpmath.mpf(x) for x in (*q, *v)], tol=mpmath.mpf(10) ** -20
        )
        x = np.array(solution(T), float)
    s = tw.simulate(model, q, v, dt=T / 1024, steps=1024, tau=tau)
    assert np.abs(np.concatenate([s.q[-1], s.v[-1]]) - x).max() < 1e-12 * np.abs(x).max()

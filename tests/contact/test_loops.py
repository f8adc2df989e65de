"""Contacts with one or two rows, contacts that move, loops of bodies, gears: closed forms, invariants, Pinocchio."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as slow
from twistwrench.model import KINDS
from twistwrench.newton_euler_3d.bodies import cross

from ..algorithms.test_factorization import wheels
from ..strategies import BATCHES, Recipe, random_state
from ..touching import BOX, BOX_CORNERS, FEET, GO2, error, points, posed

G = 9.81
TREE = Recipe(7, seed=4, branching=0.7).model
LOOPS = [tw.LoopClosure("joint_0", "joint_2"), tw.LoopClosure("joint_3", "joint_6", welded=True)]
OF_ALL_KINDS = [
    *LOOPS,
    tw.SlidingContact("joint_2", [1, 0.5, 1], to="joint_3"),
    tw.SlidingContact("joint_4", [0.3, 0.2, 1]),
    tw.Coupling("joint_5", {"joint_4": -2.5, "joint_1": 0.5}),
]
LENGTHS = {"ground": 1.0, "crank": 0.3, "coupler": 0.9, "rocker": 0.7}
BAR = {name: tw.SpatialInertia.from_rod(1.0 + k, l) for k, (name, l) in enumerate(LENGTHS.items())}


def four_bar() -> tw.Model:
    """Crank, coupler and rocker in the plane y = 0, each along its own z axis; a loop closes it where they meet."""
    builder = tw.Builder("four-bar")
    for name, on, at in (
        ("crank", "base_link", [0, 0, 0]),
        ("coupler", "crank", [0, 0, LENGTHS["crank"]]),
        ("rocker", "base_link", [LENGTHS["ground"], 0, 0]),
    ):
        middle = tw.SE3(np.eye(3), [0, 0, LENGTHS[name] / 2])
        rod = BAR[name].transform(middle)
        builder.link(name, parent=on, joint=tw.Revolute("y"), inertia=rod, placement=tw.SE3(np.eye(3), at))
    for link in ("coupler", "rocker"):
        builder.link(f"{link}_end", parent=link, placement=tw.SE3(np.eye(3), [0, 0, LENGTHS[link]]))
    return builder.build()


FOUR_BAR, PIN = four_bar(), [tw.LoopClosure("coupler_end", "rocker_end")]


def angles(theta):
    """The angles of the three bars from the vertical, by the triangle of coupler, rocker and diagonal; any digits."""
    g, a, b, c = (mpmath.mpf(x) for x in LENGTHS.values())
    x, z = g - a * mpmath.sin(theta), -a * mpmath.cos(theta)  # from the crank's end to the rocker's pivot
    d, away = mpmath.sqrt(x * x + z * z), mpmath.atan2(x, z)
    opening = mpmath.acos((d * d + b * b - c * c) / (2 * d * b))
    coupler = away - opening
    end = (a * mpmath.sin(theta) + b * mpmath.sin(coupler) - g, a * mpmath.cos(theta) + b * mpmath.cos(coupler))
    return theta, coupler, mpmath.atan2(*end)


def four_bar_q(theta):
    crank, coupler, rocker = (float(x) for x in angles(mpmath.mpf(theta)))
    return np.array([crank, coupler - crank, rocker])


def by_lagrange(theta, rate, tau):
    """θ̈ = (τ − ½ I′(θ) θ̇² − U′(θ)) / I(θ), with one coordinate and derivatives in 50 digits."""
    mass = {name: mpmath.mpf(float(BAR[name].mass)) for name in LENGTHS}
    l = {name: mpmath.mpf(x) for name, x in LENGTHS.items()}

    def centers(t):
        crank, coupler, rocker = angles(t)
        half = {name: l[name] / 2 for name in l}
        return {
            "crank": (half["crank"] * mpmath.sin(crank), half["crank"] * mpmath.cos(crank), crank),
            "coupler": (
                l["crank"] * mpmath.sin(crank) + half["coupler"] * mpmath.sin(coupler),
                l["crank"] * mpmath.cos(crank) + half["coupler"] * mpmath.cos(coupler),
                coupler,
            ),
            "rocker": (half["rocker"] * mpmath.sin(rocker), half["rocker"] * mpmath.cos(rocker), rocker),
        }

    def inertia(t):
        total = mpmath.mpf(0)
        for name in ("crank", "coupler", "rocker"):
            dx, dz, da = (mpmath.diff(lambda s, n=name, k=k: centers(s)[n][k], t) for k in range(3))
            total += mass[name] * (dx**2 + dz**2) + mass[name] * l[name] ** 2 / 12 * da**2
        return total

    def height(t):
        return sum(mass[name] * mpmath.mpf(G) * centers(t)[name][1] for name in ("crank", "coupler", "rocker"))

    t = mpmath.mpf(theta)
    push = mpmath.mpf(tau) - mpmath.diff(inertia, t) * mpmath.mpf(rate) ** 2 / 2 - mpmath.diff(height, t)
    return float(push / inertia(t))


def bead() -> tw.Model:
    solid = tw.SpatialInertia(2.0, [0, 0, 0], 0.01 * np.eye(3))
    return tw.Builder("bead", base="floating", root="bead", root_inertia=solid).build()


# ---------------------------------------------------------------- one or two directions


@pytest.mark.one_case
@pytest.mark.parametrize("slope", [0.0, 0.5, 1.4])
def test_a_bead_on_a_rail_and_on_a_plane_accelerates_with_g_sin(slope):
    model, rest = bead(), np.zeros(6)
    out, down = np.array([np.sin(slope), 0, np.cos(slope)]), np.array([np.cos(slope), 0, -np.sin(slope)])
    for normals in ([out], [[0, 3, 0], out], [[0, 1, 0.5 * np.cos(slope)] + 0.5 * np.sin(slope) * np.eye(3)[0], out]):
        held = tw.contact_forward_dynamics(model, model.neutral(), rest, rest, [tw.SlidingContact("bead", normals)])
        assert np.allclose(held.qdd[3:], G * np.sin(slope) * down, rtol=0, atol=1e-14)
        force = held.forces["bead"] @ np.array(tw.SlidingContact("bead", normals).normals)
        assert np.allclose(force, 2 * G * np.cos(slope) * out, rtol=0, atol=1e-13)
        assert (held.rank, held.redundant) == (len(normals), 0)


@pytest.mark.slow
def test_a_bead_flies_outwards_on_a_rod_that_turns():
    """r̈ = r ω²: r = r₀ cosh ω t + ṙ₀/ω sinh ω t. The rod pushes sideways only, with 2 m ω ṙ.

    A coupling without other joints gives the rod its rate.
    """
    builder, solid = tw.Builder("rod", gravity=[0, 0, 0]), tw.SpatialInertia(2.0, [0, 0, 0], 0.01 * np.eye(3))
    builder.link("rod", parent="base_link", joint=tw.Revolute("z"), inertia=solid, joint_name="turn")
    builder.link("bead", parent="base_link", joint=tw.FreeFlyer(), inertia=solid)
    model, r, w, speed = builder.build(), 0.7, 3.0, 0.4
    q, v = model.neutral(), np.zeros(7)
    free, turn = (model.v_slice[model.joint_id(name)] for name in ("bead", "turn"))
    q[model.q_slice[model.joint_id("bead")].start] = r
    v[turn], v[free] = w, [0, 0, 0, speed, w * r, 0]
    held = [tw.SlidingContact("bead", [[0, 1, 0], [0, 0, 1]], to="rod"), tw.Coupling("turn", {}, velocity=[w])]
    got = tw.contact_forward_dynamics(model, q, v, 0 * v, held)
    assert np.allclose(got.slip, 0, rtol=0, atol=1e-14)
    assert np.allclose(got.qdd[free], [0, 0, 0, 0, 2 * w * speed, 0], rtol=0, atol=1e-12)
    assert np.allclose(got.forces["bead"], [2 * 2.0 * w * speed, 0], rtol=0, atol=1e-13)
    assert np.isclose(got.forces["turn"][0], 2 * 2.0 * w * speed * r, rtol=1e-13)
    run = tw.simulate(model, q, v, dt=0.01, duration=0.3, contacts=held)
    out = tw.frame_placement(model, run.q[-1], "bead").translation
    expected = r * np.cosh(0.9) + speed / w * np.sinh(0.9)
    assert np.allclose(out, expected * np.array([np.cos(0.9), np.sin(0.9), 0]), rtol=0, atol=1e-6)


def test_an_elevator_and_a_belt():
    lift, rest = 1.5, np.zeros(6)
    corners = points(["fl", "fr", "rl", "rr"], acceleration=(0, 0, lift), velocity=(0.4, 0, 2.0))
    q, v = posed([0, 0, 0], [0, 0, 0.1]), np.r_[rest[:3], 0.4, 0, 2.0]
    held = tw.contact_forward_dynamics(BOX, q, v, rest, corners)
    assert np.allclose(held.qdd, [0, 0, 0, 0, 0, lift], rtol=0, atol=1e-13)
    assert np.allclose(sum(held.forces.values()), [0, 0, BOX.mass * (G + lift)], rtol=0, atol=1e-12)
    assert np.allclose(held.slip, 0, rtol=0, atol=1e-15)
    asked = tw.contact_inverse_dynamics(BOX, q, v, held.qdd, corners)
    assert np.allclose(asked.residual, 0, rtol=0, atol=1e-13)
    hit = tw.impact(BOX, q, rest, corners)  # dropped on the belt, it moves as the belt does
    assert np.allclose(hit.v, v, rtol=0, atol=1e-14)
    assert np.isclose(hit.energy_lost, -BOX.mass * (0.4**2 + 2**2) / 2, rtol=1e-13)
    back = tw.impact(BOX, q, rest, corners, restitution=0.5)
    assert np.allclose(back.v, 1.5 * v, rtol=0, atol=1e-14)
    assert np.isclose(back.energy_lost, -tw.kinetic_energy(BOX, q, back.v), rtol=1e-13)
    ride = tw.simulate(BOX, q, v, dt=0.05, duration=1.0, contacts=corners)
    assert np.allclose(ride.q[-1][:3] - q[:3], [0.4, 0, 2.0 + lift / 2], rtol=0, atol=1e-12)
    assert np.allclose(ride.v[-1] - v, [0, 0, 0, 0, 0, lift], rtol=0, atol=1e-12)


def test_a_sole_on_a_turntable_goes_round_with_it():
    turning = (0, 0, 2.0, 0, 0, 0)
    table = [tw.SurfaceContact("body", (0.1, 0.1), 0.6, velocity=turning)]
    ride = tw.simulate(BOX, BOX.neutral(), turning, dt=0.05, duration=0.5, contacts=table)
    angle = BOX.difference(BOX.neutral(), ride.q[-1])
    assert np.allclose(angle, [0, 0, 1.0, 0, 0, 0], rtol=0, atol=1e-12)


# ---------------------------------------------------------------- loops


@pytest.mark.parametrize(("theta", "rate", "tau"), [(0.3, 0.0, 0.0), (1.1, 4.0, 2.0), (-2.0, -7.0, -3.0)])
def test_a_four_bar_moves_as_lagrange_says_and_a_motor_at_the_crank_makes_it(theta, rate, tau):
    q = four_bar_q(theta)
    slope = [float(mpmath.diff(lambda t, k=k: angles(t)[k], mpmath.mpf(theta))) for k in range(3)]
    v = rate * np.array([1.0, slope[1] - 1, slope[2]])
    got = tw.contact_forward_dynamics(FOUR_BAR, q, v, [tau, 0, 0], PIN)
    assert np.isclose(got.qdd[0], by_lagrange(theta, rate, tau), rtol=1e-12)
    assert (got.rank, got.redundant) == (2, 1)
    assert np.abs(got.residual).max() < 1e-12 * np.abs(got.qdd).max()
    back = tw.contact_inverse_dynamics(FOUR_BAR, q, v, got.qdd, PIN, motors=["crank"])
    assert np.allclose(back.tau, [tau, 0, 0], rtol=0, atol=1e-11)
    assert error(back.forces["coupler_end"], got.forces["coupler_end"], size=1.0) < 1e-11


def test_a_four_bar_is_assembled_and_keeps_its_energy():
    """From bars that do not meet; then 0.3 s of free motion, in which the joint stays closed."""
    apart = four_bar_q(1.1) + np.array([0.0, 0.05, -0.03])
    together = {"coupler_end": tw.SE3.identity()}
    q, v = tw.project_state(FOUR_BAR, apart, [3.0, 0, 0], PIN, together)
    gap = [tw.frame_placement(FOUR_BAR, q, name).translation for name in ("coupler_end", "rocker_end")]
    assert np.abs(gap[0] - gap[1]).max() < 1e-12
    run = tw.simulate(FOUR_BAR, q, v, dt=2e-3, duration=0.3, contacts=PIN)
    assert np.ptp(run.energy) < 1e-7 * np.abs(run.energy).max()
    assert np.abs(tw.contact_placements(FOUR_BAR, run.q, PIN)["coupler_end"].translation).max() < 1e-12
    assert np.allclose(run.q[-1], four_bar_q(run.q[-1][0]), rtol=0, atol=1e-11)


# ---------------------------------------------------------------- gears


def discs(joint=tw.Revolute, **inertias: float) -> tw.Model:
    builder = tw.Builder("gears", gravity=[0, 0, 0])
    for name, J in inertias.items():
        disc = tw.SpatialInertia(1.0, [0, 0, 0], np.diag([J, J, J]))
        builder.link(f"{name}_disc", parent="base_link", joint=joint("z"), inertia=disc, joint_name=name)
    return builder.build()


@pytest.mark.parametrize("n", [-10.0, 0.5, 37.0])
def test_a_gear_pair_has_the_apparent_inertia_j1_and_n_squared_j2(n):
    model, gears = discs(arm=2.0, motor=0.05), [tw.Coupling("motor", {"arm": n})]
    got = tw.contact_forward_dynamics(model, [0.2, 5.0], [0, 0], [3.0, 0.1], gears)
    assert np.allclose(got.qdd, np.array([1.0, n]) * (3.0 + n * 0.1) / (2.0 + n**2 * 0.05), rtol=1e-14, atol=0)
    assert np.isclose(got.forces["motor"][0], 0.05 * got.qdd[1] - 0.1, rtol=1e-13, atol=1e-14)
    run = tw.simulate(model, [0.2, 5.0], [1.0, n], dt=0.1, steps=20, tau=[3.0, 0.1], contacts=gears)
    turned = run.q - run.q[0]
    assert np.allclose(turned[:, 1], n * turned[:, 0], rtol=0, atol=1e-12 * abs(n))


def test_of_a_continuous_joint_the_rate_is_held():
    """Its q does not count the turns: here one and a half of them, on a motor with a given velocity."""
    model, gears = discs(tw.Continuous, arm=2.0, motor=0.05), [tw.Coupling("motor", {"arm": 3.0}, velocity=[0.5])]
    run = tw.simulate(model, model.neutral(), [1.0, 3.5], dt=0.25, steps=12, contacts=gears)
    assert np.allclose(run.v[-1], [1.0, 3.5], rtol=1e-13, atol=0)
    turned = np.arctan2(run.q[-1][1::2], run.q[-1][::2])
    assert np.allclose(turned, [3.0, 10.5 - 4 * np.pi], rtol=0, atol=1e-12)


def test_a_differential_shares_its_torque():
    """The cage turns with the mean of both wheels: each gets half of its torque, whichever of them is held."""
    model = discs(cage=0.3, left=0.2, right=0.2)
    mean = tw.Coupling("cage", {"left": 0.5, "right": 0.5})
    free = tw.contact_forward_dynamics(model, [0, 0, 0], [0, 0, 0], [1.4, 0, 0], [mean])
    assert np.allclose(free.qdd, 1.4 / (0.3 + 0.4), rtol=1e-14, atol=0)
    parked = tw.contact_forward_dynamics(model, [0, 0, 0], [0, 0, 0], [1.1, 0, 0], [mean, tw.Coupling("right", {})])
    assert np.allclose(parked.qdd, [1.1 / (0.3 + 4 * 0.2), 2 * 1.1 / (0.3 + 4 * 0.2), 0], rtol=1e-14, atol=1e-15)
    assert np.isclose(parked.forces["right"][0], -0.2 * parked.qdd[1], rtol=1e-14)  # ½ λ, as the wheel on the left


def test_given_accelerations_of_some_joints_are_hybrid_dynamics():
    """Couplings without other joints give q̈ of two of three joints: `rnea` of the result has the τ of the third."""
    q, v, tau = np.array([0.3, -0.8, 1.2]), np.array([1.0, -2.0, 0.5]), np.array([0.0, 0.7, 0.0])
    given = [tw.Coupling("crank", {}, acceleration=[2.0]), tw.Coupling("rocker", {}, acceleration=[-1.5])]
    got = tw.contact_forward_dynamics(FOUR_BAR, q, v, tau, given)
    assert np.allclose(got.qdd[[0, 2]], [2.0, -1.5], rtol=1e-13, atol=0)
    needed = tw.rnea(FOUR_BAR, q, v, got.qdd)
    forces = [got.forces["crank"][0], tau[1], got.forces["rocker"][0]]
    assert np.allclose(needed, forces, rtol=0, atol=1e-12 * np.abs(needed).max())


def test_a_coupling_is_a_mimic_joint():
    """A hand whose finger follows another: the reduced model of a mimic joint has the same accelerations."""
    hand = """<robot name="hand"><link name="palm"/>{}</robot>"""
    one = """<link name="{0}"><inertial><origin xyz="0 0.01 0.04"/><mass value="0.2"/>
      <inertia ixx="1e-4" iyy="2e-4" izz="1.5e-4" ixy="1e-5" ixz="0" iyz="0"/></inertial></link>
      <joint name="{0}_joint" type="revolute"><parent link="{1}"/><child link="{0}"/><origin xyz="0 0 0.05"/>
      <axis xyz="1 0 0"/><limit lower="-2" upper="2" effort="1" velocity="5"/>{2}</joint>"""
    follows = '<mimic joint="near_joint" multiplier="-1.7" offset="0.2"/>'
    text = hand.format(one.format("near", "palm", "") + one.format("far", "near", follows))
    free, mimic = (tw.load(text, mimic=how) for how in ("independent", "reduce"))
    q, v = np.array([0.4]), np.array([2.0])
    full, rate = np.array([0.4, -1.7 * 0.4 + 0.2]), np.array([2.0, -3.4])
    held = tw.contact_forward_dynamics(free, full, rate, [0.03, 0], [tw.Coupling("far_joint", {"near_joint": -1.7})])
    qdd = np.linalg.solve(tw.crba(mimic, q), 0.03 - tw.nonlinear_effects(mimic, q, v))
    assert np.allclose(held.qdd, qdd * [1, -1.7], rtol=1e-12, atol=0)


# ---------------------------------------------------------------- invariants, every joint


def moving(contacts, rng):
    q = TREE.random_configuration(rng=rng)
    J, v = tw.constraint_jacobian(TREE, q, contacts), rng.standard_normal(TREE.nv)
    return q, v - np.linalg.pinv(J) @ (J @ v), rng.standard_normal(TREE.nv)


def test_jacobian_and_bias_are_derivatives_of_the_placements():
    """Also of the parts across the normals, of turns, and at a velocity that the contacts forbid; by complex steps."""
    rng, h = np.random.default_rng(2), 1e-20
    q, v = TREE.random_configuration(rng=rng), rng.standard_normal(TREE.nv)
    J, bias = tw.constraint_jacobian(TREE, q, OF_ALL_KINDS), tw.constraint_bias(TREE, q, v, OF_ALL_KINDS)
    assert not J[[0, 1, 2, 9], 0].any()  # joint_1 carries both sides of these loops
    later = TREE.integrate(q, 1j * h * v)
    rate = (tw.constraint_jacobian(TREE, later, OF_ALL_KINDS) @ v).imag / h
    assert np.allclose(bias, rate, rtol=0, atol=1e-12 * np.abs(rate).max())
    now, then = (tw.contact_placements(TREE, x, OF_ALL_KINDS) for x in (q, later))
    expected = []
    for c in OF_ALL_KINDS:
        turn = tw.unskew(then[c.frame].rotation.imag / h @ now[c.frame].rotation.T)
        expected.append(c.directions @ np.r_[turn, then[c.frame].translation.imag / h])
    assert np.allclose(J @ v, np.concatenate(expected), rtol=0, atol=1e-12 * np.abs(J @ v).max())


def test_internal_forces_act_on_both_bodies_at_one_point():
    """Jᵀ λ of a weld is λ on one body and −λ on the other, by `rnea` with wrenches from outside."""
    rng, weld = np.random.default_rng(3), LOOPS[1]
    q, force = TREE.random_configuration(rng=rng), rng.standard_normal(6)
    placement, f_ext = tw.forward_kinematics(TREE, q).placement, np.zeros((TREE.nbodies, 6))
    here, there = (tw.frame_placement(TREE, q, name) for name in weld.frames)
    wrench = np.r_[there.rotation @ force[:3], there.rotation @ force[3:]]  # in the world's axes, at the frame's origin
    for name, sign in zip(weld.frames, (1, -1), strict=True):
        body = TREE.frame(name).body
        to_body = tw.SE3(placement[body].rotation.T, placement[body].inverse().act(here.translation))
        f_ext[body] += sign * to_body.force_transform() @ wrench
    rest = np.zeros(TREE.nv)
    push = tw.gravity(TREE, q) - tw.rnea(TREE, q, rest, rest, f_ext)
    assert np.allclose(tw.constraint_jacobian(TREE, q, [weld]).T @ force, push, rtol=0, atol=1e-12)


def test_forces_do_no_work_and_the_acceleration_is_nearest_to_the_free_one():
    """Gauss: every other acceleration that the contacts allow is further from the free one in the metric of M."""
    rng = np.random.default_rng(4)
    q, v, tau = moving(OF_ALL_KINDS, rng)
    got = tw.contact_forward_dynamics(TREE, q, v, tau, OF_ALL_KINDS)
    force, J, M = (
        np.concatenate(list(got.forces.values())),
        tw.constraint_jacobian(TREE, q, OF_ALL_KINDS),
        tw.crba(TREE, q),
    )
    assert got.rank == np.linalg.matrix_rank(J) == 10
    assert abs(force @ (J @ v)) < 1e-11 * np.abs(force).max()
    left = tw.rnea(TREE, q, v, got.qdd) - tau - J.T @ force
    assert np.abs(left).max() < 1e-12 * np.abs(J.T @ force).max()
    idle = np.linalg.svd(J)[2][10:]
    away = got.qdd - tw.aba(TREE, q, v, tau)
    assert np.abs(idle @ M @ away).max() < 1e-10 * np.abs(M @ away).max()


def test_batches_are_single_states_and_programs_compute_the_same():
    rng = np.random.default_rng(5)
    q = TREE.integrate(TREE.neutral(), rng.standard_normal((3, TREE.nv)))
    v, tau = rng.standard_normal((2, 1, TREE.nv)), rng.standard_normal((2, 1, TREE.nv))
    many = tw.contact_forward_dynamics(TREE, q, v, tau, OF_ALL_KINDS)
    one = tw.contact_forward_dynamics(TREE, q[2], v[1, 0], tau[1, 0], OF_ALL_KINDS)
    assert many.qdd.shape == (2, 3, TREE.nv)
    assert error(many.qdd[1, 2], one.qdd) < 1e-11
    for frame, force in one.forces.items():
        assert np.allclose(many.forces[frame][1, 2], force, rtol=0, atol=1e-10 * np.abs(force).max())
    J = tw.constraint_jacobian(TREE, q, OF_ALL_KINDS)
    assert np.allclose(tw.compile(TREE, "J_c", contacts=OF_ALL_KINDS)(q), J, rtol=0, atol=1e-13)
    assert np.allclose(tw.contact_jacobian(TREE, q, [*OF_ALL_KINDS, "joint_0"])[:, :12], J, rtol=0, atol=1e-13)
    rates = np.zeros((3, TREE.nv))
    for dynamics in (tw.dynamics, tw.fast.dynamics):
        found = dynamics(TREE, q, rates, contacts=tuple(OF_ALL_KINDS), want=("J_c",))
        assert np.allclose(found.J_c, J, rtol=0, atol=1e-13)


@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, np.complex128])
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_the_rows_keep_number_type_and_batch(dtype, batch):
    held = [*OF_ALL_KINDS, tw.DistanceConstraint("link_1", "link_4")]
    s = random_state(TREE, rng=6, batch=batch, dtype=dtype)
    J, bias = tw.constraint_jacobian(TREE, s.q, held), tw.constraint_bias(TREE, s.q, s.v, held)
    assert J.dtype == bias.dtype == dtype
    assert (J.shape, bias.shape) == ((*batch, 13, TREE.nv), (*batch, 13))
    if not batch and dtype != np.complex128:
        double = tw.constraint_bias(TREE, TREE.normalize(s.q.astype(float)), s.v.astype(float), held)
        assert error(bias, double) < 1e3 * max(np.finfo(dtype).eps, 2.0**-52)


def test_fractions_stay_exact():
    q = np.array([Fraction(3, 5), Fraction(4, 5), Fraction(5, 13), Fraction(-12, 13), Fraction(1, 3)])
    held = [tw.LoopClosure("b", "c", welded=True), tw.SlidingContact("a", [0, 0, 1])]
    J = tw.contact_jacobian(wheels(), q, held)
    assert all(isinstance(x, Fraction | int) for x in J.flat)
    assert error(J.astype(float), tw.contact_jacobian(wheels(), q.astype(float), held)) < 1e-15


def test_a_loop_far_from_the_origin_keeps_its_digits_and_its_rank():
    far, loop = GO2.standing(), [tw.LoopClosure("FL_foot", "RR_foot")]
    far[:3] += [1e6, -3e5, 2e4]
    here, there = (tw.constraint_jacobian(GO2, q, loop) for q in (GO2.standing(), far))
    assert np.abs(here - there).max() < 1e-15


# ---------------------------------------------------------------- 50 digits, every kind of joint

EVERY_KIND = Recipe(7, 129, "floating").model
HELD = [
    tw.PointContact("joint_0", 0.5),
    tw.SlidingContact("joint_5", [0.3, 0.2, 1]),
    tw.LoopClosure("joint_2", "joint_1"),
    tw.SlidingContact("welded_2", [[1, 0.5, 1], [0, 1, 0.3]], to="joint_5"),
    tw.Coupling("joint_1", {"joint_6": -2.5}),
    tw.DistanceConstraint("welded_6", "link_1"),
]


def rows_in_vectors(model, q, v, held):
    """J and J̇ v of contacts, by 3-D vectors: how a frame moves, as seen from a frame that turns."""
    rows, bias = [], []
    for c in held:
        if isinstance(c, tw.Coupling):
            ratios = {c.frame: 1} | {name: -ratio for name, ratio in c.ratios}
            rows.append(sum(n * np.eye(model.nv)[model.v_slice[model.joint_id(name)]] for name, n in ratios.items()))
            bias.append([0])
            continue
        (_, p), J = slow.frame_placement(model, q, c.frame), jacobian(model, q, c.frame)
        acceleration, axes = drift(model, q, v, c.frame), np.eye(3, dtype=int)
        if getattr(c, "to", None) is not None:
            (axes, there), other = slow.frame_placement(model, q, c.to), jacobian(model, q, c.to)
            (turn, slide), r = other, p - there
            w, relative = turn @ v, (J[1] - slide) @ v
            rate, free = drift(model, q, v, c.to)
            left = acceleration[1] - free - cross(rate, r) - cross(w, relative) - cross(w, relative - cross(w, r))
            if isinstance(c, tw.DistanceConstraint):  # of the way in the world
                n, rate = r / (d := mpmath.sqrt(r @ r)), (J[1] - slide) @ v
                across = rate - n * (n @ rate)
                rows.append((n @ (J[1] - slide))[None])
                bias.append([n @ (acceleration[1] - free) + across @ across / d])
                continue
            J, acceleration = (None, J[1] - slide - cross(turn, r)), (None, left)
        which = c.directions[:, 3:] @ axes.T
        rows.append(which @ J[1])
        bias.append(which @ acceleration[1])
    return np.concatenate(rows), np.concatenate(bias)


def jacobian(model, q, frame):
    return np.split(slow.frame_jacobian(model, q, frame, "local_world_aligned"), 2)


def drift(model, q, v, frame):
    return np.split(slow.frame_bias_acceleration(model, q, v, frame, "local_world_aligned"), 2)


@pytest.mark.slow
def test_motion_forces_and_impulses_are_right_to_fifty_digits():
    """The dense equations [M, −Jᵀ; J, 0] for points, rails, loops and gears on a tree with every kind of joint."""
    model, rng = EVERY_KIND, np.random.default_rng(8)
    assert {joint.kind for joint in model.joints[1:]} == {*KINDS}
    q, (v, tau) = model.random_configuration(rng=rng), rng.standard_normal((2, model.nv))
    tau[:6] = 0  # no motor at the base
    J = tw.constraint_jacobian(model, q, HELD)
    v, n, m = v - np.linalg.pinv(J) @ (J @ v), model.nv, len(J)
    with mpmath.workdps(50):
        q_, v_, tau_ = (slow.as_mpmath(x) for x in (q, v, tau))
        rows, bias = rows_in_vectors(model, q_, v_, HELD)
        M, h = slow.mass_matrix(model, q_), slow.nonlinear_effects(model, q_, v_)
        equations = np.block([[M, -rows.T], [rows, np.zeros((m, m), int)]])
        sides = (np.r_[tau_ - h, -bias], np.r_[M @ tau_, np.zeros(m, int)])  # stopped from a velocity of tau
        matrix = mpmath.matrix(equations.tolist())
        motion, after = (np.array([*mpmath.lu_solve(matrix, b.tolist())], float) for b in sides)
        rows, bias, equations = (x.astype(float) for x in (rows, bias, equations))
    assert error(J, rows) < 1e-14
    assert error(tw.constraint_bias(model, q, v, HELD), bias) < 1e-13
    lost = np.linalg.cond(equations) * np.finfo(float).eps
    got, hit = tw.contact_forward_dynamics(model, q, v, tau, HELD), tw.impact(model, q, tau, HELD)
    assert (got.rank, got.redundant) == (m, 0)
    for ours, exact in (
        (np.r_[got.qdd, *got.forces.values()], motion),
        (np.r_[hit.v, *hit.impulses.values()], after),
    ):
        assert error(ours, exact) < lost < 1e-10
    back = tw.contact_inverse_dynamics(model, q, v, got.qdd, HELD)
    assert error(tw.rnea(model, q, v, motion[:n]), back.tau + rows.T @ np.concatenate([*back.forces.values()])) < lost


# ---------------------------------------------------------------- Pinocchio


def test_accelerations_are_pinocchios():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its constrained dynamics is not asked")
    q, v, tau = moving(LOOPS, np.random.default_rng(7))
    there, anchors = bridge.to_pinocchio_model(TREE), tw.contact_placements(TREE, q, LOOPS)
    data, models, datas = there.createData(), pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    for loop in LOOPS:  # held where the frame is now, on both bodies
        kind = pin.ContactType.CONTACT_6D if loop.welded else pin.ContactType.CONTACT_3D
        at, (moved, fixed) = anchors[loop.frame], (there.frames[there.getFrameId(name)] for name in loop.frames)
        place = fixed.placement * pin.SE3(at.rotation, at.translation)
        ends = (fixed.parentJoint, place, moved.parentJoint, moved.placement)
        models.append(pin.RigidConstraintModel(kind, there, *ends, pin.LOCAL))
        datas.append(models[-1].createData())
    pin.initConstraintDynamics(there, data, models, datas)
    rates = [bridge.to_pinocchio_tangent(TREE, x) for x in (v, tau)]
    a = pin.constraintDynamics(there, data, q, *rates, models, datas, pin.ProximalSettings(1e-14, 1e-14, 0.0, 1))
    got = tw.contact_forward_dynamics(TREE, q, v, tau, LOOPS)
    assert error(got.qdd, bridge.from_pinocchio_tangent(TREE, a)) < 1e-12


# ---------------------------------------------------------------- what is refused, and who stands


def test_planes_carry_as_points_without_friction_do_and_what_pulls_cannot_stand():
    q, ice = GO2.standing(), [tw.SlidingContact(c.frame, [0, 0, 1]) for c in FEET]
    assert tw.stance_margins(GO2, q, ice).stands
    rest, up = np.zeros(GO2.nv), [tw.PointContact(c.frame, 0.0) for c in FEET]
    ours, theirs = (tw.friction_inverse_dynamics(GO2, q, rest, rest, feet) for feet in (ice, up))
    assert np.allclose(ours.tau, theirs.tau, rtol=0, atol=1e-10)
    hung = [tw.SlidingContact(c.frame, [[0, 0, 1], [1, 0, 0]]) for c in FEET]
    drop = rest.copy()
    drop[5] = -2 * G  # faster than free fall: the rails pull
    pull = tw.friction_inverse_dynamics(GO2, q, rest, drop, hung)
    assert np.isclose(sum(f[0] for f in pull.forces.values()), -GO2.mass * G, rtol=1e-9)
    carried = [tw.SlidingContact("FL_foot", [0, 0, 1], to="base")]
    for bad in (hung, carried, [tw.LoopClosure("FL_foot", "FR_foot")], [tw.Coupling("FL_calf_joint", {})]):
        with pytest.raises(ValueError, match="expected contacts with the ground that do not pull"):
            tw.stance_margins(GO2, q, bad)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: tw.SlidingContact("f", [0, 0, 0]), "normals: expected a direction, got zero"),
        (lambda: tw.SlidingContact("f", np.eye(3)), r"normals: expected shape \(3,\) or \(2, 3\), got \(3, 3\)"),
        (lambda: tw.SlidingContact("f", [[0, 0, 1], [0, 0, -2]]), "two directions that are independent"),
        (lambda: tw.SlidingContact("f", [0, 0, 1], velocity=[1, 2]), r"'f': velocity: expected shape \(..., 1\)"),
        (lambda: tw.PointContact("f", 0.5, acceleration=9.81), r"'f': acceleration: expected shape \(..., 3\)"),
        (lambda: tw.LoopClosure("f", "g", welded=2), "welded: expected True or False, got int 2"),
        (lambda: tw.Coupling("j", 2.0), "coupling 'j': ratios: expected a mapping of joints to numbers, got 2.0"),
        (lambda: tw.Coupling("j", {"j": 2.0}), "ratios: expected other joints, got the joint itself"),
        (lambda: tw.Coupling("j", {"k": np.nan}), "ratio of 'k': expected finite"),
        (
            lambda: tw.constraint_jacobian(GO2, GO2.standing(), [tw.Coupling("root_joint", {})]),
            "of one degree of freedom",
        ),
        (lambda: tw.constraint_jacobian(GO2, GO2.standing(), [tw.Coupling("FL", {})]), "unknown joint 'FL'"),
        (lambda: tw.contact_jacobian(GO2, GO2.standing(), [tw.LoopClosure("FL_foot", "FL")]), "unknown frame 'FL'"),
        (
            lambda: tw.constraint_jacobian(GO2, GO2.standing(), [tw.LoopClosure("FL_foot", "FL_calf")]),
            "'FL_foot': expected frames of two bodies, got 'FL_calf' of the same one",
        ),
        (
            lambda: tw.simulate(BOX, BOX.neutral(), np.eye(6)[2], dt=1, steps=1, contacts=[TILTING]),
            "turns about the axis",
        ),
        (
            lambda: tw.simulate(BOX, BOX.neutral(), np.zeros(6), dt=1, steps=1, contacts=RISING),
            "'fl' sticks, but slips",
        ),
        (
            lambda: tw.simulate(BOX, BOX.neutral(), np.zeros(6), dt=1, steps=1, contacts=RISING, ground=tw.Ground()),
            "'fl': velocity: expected one along the ground",
        ),
        (
            lambda: tw.contact_inverse_dynamics(FOUR_BAR, *3 * [np.zeros(3)], PIN, motors=["cam"]),
            "unknown joint 'cam'",
        ),
    ],
)
def test_what_cannot_be_is_said(make, said):
    with pytest.raises((TypeError, ValueError), match=said):
        make()


TILTING = tw.SurfaceContact("body", (0.1, 0.1), 0.5, velocity=(0, 0, 1, 0, 0, 0), acceleration=(1, 0, 0, 0, 0, 0))
RISING = [tw.PointContact(c.frame, 0.5, velocity=(0, 0, 1)) for c in BOX_CORNERS]

"""What the laws of mechanics say must hold, on random trees: no number here comes from another program.

Derivatives are by complex steps: f(x + i h) / h with h = 1e-20 is the derivative to the last digit, and along
the configuration manifold the step is q ⊕ i h v.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

import twistwrench as tw
from twistwrench.rotation import rotation_to_quaternion

from .strategies import REFERENCES, examples, recipes
from .truth import SKEEL, skeel

H = 1e-20
EPS = np.finfo(np.float64).eps
trees = given(recipes(10))
floating = given(recipes(10, bases=("floating",)))
hinges_and_slides = given(recipes(8, bases=("fixed",), kinds=("revolute", "prismatic")))
several = examples(12)


def close(x, y, tolerance=1e-12, *, size=0.0) -> bool:
    """Equal to the largest entry of either, or to `size` where the entries are what is left of larger terms."""
    x, y = np.asarray(x), np.asarray(y)
    assert x.shape == y.shape
    assert size > 0 or np.abs(y).max(initial=0) > 0, "two zeros are always equal"
    return bool(np.abs(x - y).max(initial=0) <= tolerance * max(np.abs(x).max(), np.abs(y).max(), size))


def step(model, q, v):
    """Return q ⊕ i h v, whose imaginary part, over h, is the rate of q along v."""
    return model.integrate(q, 1j * H * v)


def rate(x):
    return np.asarray(x).imag / H


def in_world(T, wrench):
    """Return a wrench of a frame placed at T, at the world's origin."""
    return T.force_transform() @ wrench


def body_frame(model, i):
    """A frame that coincides with body i's own."""
    return next(n for n, f in model.frames.items() if f.body == i and (f.placement.matrix() == np.eye(4)).all())


# ---------------------------------------------------------------- inverse and forward dynamics


@trees
@several
def test_forward_dynamics_undoes_inverse_dynamics(recipe):
    model, s = recipe.model, recipe.state()
    M, h = tw.crba(model, s.q), tw.nonlinear_effects(model, s.q, s.v)
    for f_ext in (None, s.f_ext):
        tau = tw.rnea(model, s.q, s.v, s.a, f_ext)
        lost = skeel(M, s.a, tau, h)
        error = np.abs(tw.aba(model, s.q, s.v, tau, f_ext) - s.a).max() / np.abs(s.a).max()
        assert error <= SKEEL * EPS * lost, f"relative error {error:.3g}, conditioning {lost:.3g}"


@trees
@several
def test_inverse_dynamics_undoes_forward_dynamics(recipe):
    model, s = recipe.model, recipe.state()
    M, h = tw.crba(model, s.q), tw.nonlinear_effects(model, s.q, s.v)
    for f_ext in (None, s.f_ext):
        a = tw.aba(model, s.q, s.v, s.tau, f_ext)
        size = (np.abs(M) @ np.abs(a) + np.abs(h)).max()
        assert close(tw.rnea(model, s.q, s.v, a, f_ext), s.tau, size=size)


@trees
@several
def test_inverse_dynamics_is_mass_times_acceleration_plus_bias(recipe):
    model, s = recipe.model, recipe.state()
    M, h = tw.crba(model, s.q), tw.nonlinear_effects(model, s.q, s.v)
    assert close(tw.rnea(model, s.q, s.v, s.a), M @ s.a + h)
    columns = tw.rnea(model, s.q, 0 * s.v, np.eye(model.nv)) - tw.gravity(model, s.q)
    assert close(columns, M, size=np.abs(tw.gravity(model, s.q)).max())


@trees
@several
def test_bias_is_gravity_plus_a_square_of_velocity(recipe):
    model, s = recipe.model, recipe.state()
    g, h = tw.gravity(model, s.q), tw.nonlinear_effects(model, s.q, s.v)
    weightless = replace(model, gravity=np.zeros(3))
    size = np.abs(h).max() + model.mass * 9.81
    assert close(tw.nonlinear_effects(model, s.q, 2 * s.v) - g, 4 * (h - g), size=size)
    assert close(tw.nonlinear_effects(model, s.q, -s.v), h, size=size)  # time runs backwards
    assert close(tw.nonlinear_effects(weightless, s.q, s.v), h - g, size=size)
    assert not tw.gravity(weightless, s.q).any()


@pytest.mark.parametrize("unit", [2.0**-60, 2.0**60])
@trees
@several
def test_acceleration_does_not_depend_on_the_unit_of_mass(unit, recipe):
    model, s = recipe.model, recipe.state()
    inertia = tuple(tw.SpatialInertia(unit * I.mass, I.com, unit * I.inertia_at_com) for I in model.inertia)
    scaled = replace(model, inertia=inertia, armature=unit * model.armature)
    a = tw.aba(scaled, s.q, s.v, unit * s.tau, unit * s.f_ext)
    assert (a == tw.aba(model, s.q, s.v, s.tau, s.f_ext)).all()  # a power of two: to the last bit


# ---------------------------------------------------------------- energy


@trees
@several
def test_momentum_is_the_derivative_of_kinetic_energy(recipe):
    model, s = recipe.model, recipe.state()
    M, T = tw.crba(model, s.q), tw.kinetic_energy(model, s.q, s.v)
    assert close(rate(tw.kinetic_energy(model, s.q, s.v + 1j * H * np.eye(model.nv))), M @ s.v)
    assert close(T, s.v @ M @ s.v / 2)


@trees
@several
def test_gravity_is_the_gradient_of_potential_energy(recipe):
    model, s = recipe.model, recipe.state()
    gradient = rate(tw.potential_energy(model, step(model, s.q, np.eye(model.nv))))
    assert close(tw.gravity(model, s.q), gradient, size=model.mass * 9.81)


@trees
@several
def test_power_of_all_forces_is_the_rate_of_energy(recipe):
    model, s = recipe.model, recipe.state()
    tau = tw.rnea(model, s.q, s.v, s.a, s.f_ext)
    q, v = step(model, s.q, s.v), s.v + 1j * H * s.a
    kinetic, potential = rate(tw.kinetic_energy(model, q, v)), rate(tw.potential_energy(model, q))
    twists = tw.forward_kinematics(model, s.q, s.v).twist
    powers = np.append(tau * s.v, s.f_ext * twists)
    assert close(kinetic + potential, powers.sum(), size=np.abs(powers).max())


@trees
@several
def test_mass_matrix_is_symmetric_and_positive_definite(recipe):
    model, s = recipe.model, recipe.state()
    M = tw.crba(model, s.q)
    assert (M == M.T).all()
    assert np.linalg.eigvalsh(M).min() > 0


@trees
@several
def test_coriolis_matrix_makes_the_forces_and_does_no_work(recipe):
    model, s = recipe.model, recipe.state()
    C, M_rate = tw.coriolis_matrix(model, s.q, s.v), rate(tw.crba(model, step(model, s.q, s.v)))
    size = np.abs(tw.crba(model, s.q)).max() * np.abs(s.v).max()
    bias = tw.nonlinear_effects(model, s.q, s.v) - tw.gravity(model, s.q)
    assert close(C @ s.v, bias, size=size * np.abs(s.v).max() + model.mass * 9.81)
    assert close(C + C.T, M_rate, size=size)  # Ṁ − 2C is skew-symmetric


@hinges_and_slides
@several
def test_lagranges_equations_hold_with_christoffels_symbols(recipe):
    # Where v = q̇: C_ij = ½ Σ_k (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) v_k.
    model, s = recipe.model, recipe.state()
    dM = rate(tw.crba(model, s.q + 1j * H * np.eye(model.nv)))  # [k, i, j]: ∂M_ij/∂q_k
    christoffel = (np.einsum("kij,k->ij", dM, s.v) + np.einsum("jik,k->ij", dM, s.v)) / 2
    christoffel -= np.einsum("ijk,k->ij", dM, s.v) / 2
    size = np.abs(tw.crba(model, s.q)).max() * np.abs(s.v).max()
    assert close(tw.coriolis_matrix(model, s.q, s.v), christoffel, size=size)
    # d/dt (∂T/∂v) − ∂T/∂q + ∂U/∂q, with a = 0
    forces = np.einsum("kij,k,j->i", dM, s.v, s.v) - np.einsum("ijk,j,k->i", dM, s.v, s.v) / 2
    forces += rate(tw.potential_energy(model, s.q + 1j * H * np.eye(model.nv)))
    weight = model.mass * 9.81
    assert close(tw.nonlinear_effects(model, s.q, s.v), forces, size=size * np.abs(s.v).max() + weight)


# ---------------------------------------------------------------- kinematics


@trees
@several
def test_twists_are_the_rate_of_placements_and_accelerations_that_of_twists(recipe):
    model, s = recipe.model, recipe.state()
    now = tw.forward_kinematics(model, s.q, s.v, s.a)
    soon = tw.forward_kinematics(model, step(model, s.q, s.v), s.v + 1j * H * s.a)
    for i in range(1, model.nbodies):
        body_twist = tw.vee(now.placement[i].inverse().matrix() @ rate(soon.placement[i].matrix()))
        assert close(now.twist[i], body_twist, size=np.abs(now.twist).max())
    assert close(rate(soon.twist), now.acceleration)
    assert not now.twist[0].any()
    assert not now.acceleration[0].any()


@trees
@several
def test_frame_jacobians_give_the_rate_of_the_frames_placement(recipe):
    model, s, frame = recipe.model, recipe.state(), recipe.frame()
    T, T_rate = (
        tw.frame_placement(model, s.q, frame),
        rate(tw.frame_placement(model, step(model, s.q, s.v), frame).matrix()),
    )
    twist = {
        "local": tw.vee(T.inverse().matrix() @ T_rate),
        "world": tw.vee(T_rate @ T.inverse().matrix()),
    }
    twist["local_world_aligned"] = np.concatenate([twist["world"][:3], T_rate[:3, 3]])
    for reference in REFERENCES:
        J = tw.frame_jacobian(model, s.q, frame, reference)
        assert close(J @ s.v, twist[reference], size=np.abs(J).max() + 1e-300)


@trees
@several
def test_bias_acceleration_is_the_rate_of_the_jacobian_times_velocity(recipe):
    model, s, frame = recipe.model, recipe.state(), recipe.frame()
    for reference in REFERENCES:
        J_rate = rate(tw.frame_jacobian(model, step(model, s.q, s.v), frame, reference))
        bias = tw.frame_bias_acceleration(model, s.q, s.v, frame, reference)
        size = np.abs(tw.frame_jacobian(model, s.q, frame, reference)).max() * np.abs(s.v).max() ** 2
        assert close(bias, J_rate @ s.v, size=size + 1e-300)  # a frame on the world has no Jacobian


@trees
@several
def test_body_moves_as_its_frame_does(recipe):
    model, s = recipe.model, recipe.state()
    motion = tw.forward_kinematics(model, s.q, s.v, s.a)
    for i in range(1, model.nbodies):
        name = body_frame(model, i)
        J, bias = tw.frame_jacobian(model, s.q, name), tw.frame_bias_acceleration(model, s.q, s.v, name)
        assert close(J @ s.v, motion.twist[i], size=np.abs(motion.twist).max())
        assert close(J @ s.a + bias, motion.acceleration[i], size=np.abs(motion.acceleration).max())
        assert close(tw.frame_placement(model, s.q, name).matrix(), motion.placement[i].matrix())


# ---------------------------------------------------------------- momentum


@trees
@several
def test_linear_momentum_is_mass_times_velocity_of_the_centre_of_mass(recipe):
    model, s = recipe.model, recipe.state()
    momentum = tw.centroidal_momentum(model, s.q, s.v)
    velocity = rate(tw.center_of_mass(model, step(model, s.q, s.v)))
    assert close(momentum[3:], model.mass * velocity, size=np.abs(momentum).max())
    assert close(tw.potential_energy(model, s.q), -model.mass * model.gravity @ tw.center_of_mass(model, s.q),
                 size=model.mass * 9.81)  # fmt: skip


@trees
@several
def test_centroidal_momentum_is_linear_in_velocity_and_its_rate_follows(recipe):
    model, s = recipe.model, recipe.state()
    A, momentum = tw.centroidal_map(model, s.q), tw.centroidal_momentum(model, s.q, s.v)
    assert close(A @ s.v, momentum, size=np.abs(A).max())
    later = tw.centroidal_momentum(model, step(model, s.q, s.v), s.v + 1j * H * s.a)
    assert close(tw.centroidal_momentum_rate(model, s.q, s.v, s.a), rate(later), size=np.abs(A).max())
    assert not tw.centroidal_momentum_rate(model, s.q, 0 * s.v, 0 * s.a).any()  # a matter of motion, not of forces


@floating
@several
def test_centroidal_map_is_the_base_rows_of_the_mass_matrix_seen_from_the_centre_of_mass(recipe):
    model, s = recipe.model, recipe.state()
    T = tw.forward_kinematics(model, s.q).placement[1]
    from_G = tw.SE3(T.rotation, T.translation - tw.center_of_mass(model, s.q))
    assert close(from_G.force_transform() @ tw.crba(model, s.q)[:6], tw.centroidal_map(model, s.q))


@floating
@several
def test_momentum_changes_by_external_forces_and_gravity_alone(recipe):
    model, s = recipe.model, recipe.state()
    a = tw.aba(model, s.q, s.v, s.tau, s.f_ext)  # the joints' own torques are internal; the base's are a wrench
    wrenches = s.f_ext.copy()
    wrenches[1] += s.tau[:6]
    G, placement = tw.center_of_mass(model, s.q), tw.forward_kinematics(model, s.q).placement
    total = np.concatenate([np.zeros(3), model.mass * model.gravity])
    for T, wrench in zip(placement, wrenches, strict=True):
        total += in_world(tw.SE3(T.rotation, T.translation - G), wrench)
    h_rate = tw.centroidal_momentum_rate(model, s.q, s.v, a)
    terms = np.abs(tw.centroidal_map(model, s.q)) @ np.abs(a)  # large accelerations whose momenta cancel
    assert close(h_rate, total, size=terms.max())


@floating
@several
def test_momentum_is_conserved_where_nothing_acts_from_outside(recipe):
    model, s = replace(recipe.model, gravity=np.zeros(3)), recipe.state()
    tau = s.tau.copy()
    tau[:6] = 0
    a = tw.aba(model, s.q, s.v, tau)
    h_rate = tw.centroidal_momentum_rate(model, s.q, s.v, a)
    terms = np.abs(tw.centroidal_map(model, s.q)) @ (np.abs(a) + s.v**2)
    assert np.abs(h_rate).max() <= 1e-12 * terms.max()
    q, v = step(model, s.q, s.v), s.v + 1j * H * a
    work = tau @ s.v
    assert close(rate(tw.kinetic_energy(model, q, v)), work, size=np.abs(tw.crba(model, s.q) @ a).max())


STONE = tw.Builder("stone", base="floating", root_inertia=tw.SpatialInertia(2, [0.1, 0.2, 0.3], np.diag([3, 4, 5])))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("distance", [1e3, 1e6, 1e9])
@pytest.mark.parametrize("model", [tw.load("go2"), STONE.build()], ids=lambda model: model.name)
def test_momentum_loses_no_digit_where_the_robot_is_far_from_the_worlds_origin(model, distance, dtype):
    rng = np.random.default_rng(5)
    here, v, a = model.random_configuration(rng=rng), *rng.normal(size=(2, model.nv))
    here, v, a = (x.astype(dtype) for x in (here, v, a))
    here[:3], there = 0, here.copy()
    there[:3] = distance * np.array([1, -0.7, 0.3])
    for function, motion in [
        (tw.centroidal_map, ()),
        (tw.centroidal_momentum, (v,)),
        (tw.centroidal_momentum_rate, (v, a)),
    ]:  # none depends on where the base is, and it drops out before anything is rounded: equal to the last bit
        assert (function(model, there, *motion) == function(model, here, *motion)).all()


def test_momentum_loses_no_digit_where_the_robot_is_welded_down_far_from_the_worlds_origin():
    arm, far = tw.load("planar_arm"), tw.SE3(np.eye(3), [1e6, 2e6, -1e6])
    moved = replace(arm, placement=(arm.placement[0], far @ arm.placement[1], *arm.placement[2:]))
    q = np.array([[0.3, -1.1, 0.7], [2.0, 0.4, -0.1]])
    assert (tw.centroidal_map(moved, q) == tw.centroidal_map(arm, q)).all()
    assert close(tw.center_of_mass(moved, q), tw.center_of_mass(arm, q) + far.translation)


# ---------------------------------------------------------------- wrenches


@trees
@several
def test_external_wrenches_act_through_the_jacobians_of_their_bodies(recipe):
    model, s = recipe.model, recipe.state()
    without, pushed = tw.rnea(model, s.q, s.v, s.a), tw.rnea(model, s.q, s.v, s.a, s.f_ext)
    through = sum(tw.frame_jacobian(model, s.q, body_frame(model, i)).T @ s.f_ext[i] for i in range(1, model.nbodies))
    assert close(without - pushed, through, size=np.abs(without).max())


@trees
@several
def test_joints_transmit_what_their_bodies_need_and_the_ground_bears_the_rest(recipe):
    model, s = recipe.model, recipe.state()
    F, tau = tw.joint_wrenches(model, s.q, s.v, s.a, s.f_ext), tw.rnea(model, s.q, s.v, s.a, s.f_ext)
    felt = np.concatenate([joint.subspace().T @ f for joint, f in zip(model.joints[1:], F[1:], strict=True)])
    assert close(felt, tau - model.armature * s.a)
    placement, G = tw.forward_kinematics(model, s.q).placement, tw.center_of_mass(model, s.q)
    at_G = tw.centroidal_momentum_rate(model, s.q, s.v, s.a)
    at_G[3:] -= model.mass * model.gravity
    ground = in_world(tw.SE3(np.eye(3), G), at_G)
    ground -= sum(in_world(T, f) for T, f in zip(placement, s.f_ext, strict=True))
    assert close(F[0], ground, size=np.abs(F).max())


@trees
@several
def test_rotors_add_their_inertia_to_their_joint_and_nothing_else(recipe):
    model, s = recipe.model, recipe.state()
    rotors = np.linspace(0.1, 0.9, model.nv)
    bare, geared = replace(model, armature=0 * rotors), replace(model, armature=rotors)
    M = tw.crba(bare, s.q)
    assert close(tw.crba(geared, s.q) - M, np.diag(rotors), size=np.abs(M).max())
    tau = tw.rnea(bare, s.q, s.v, s.a)
    assert close(tw.rnea(geared, s.q, s.v, s.a) - tau, rotors * s.a, size=np.abs(tau).max())
    T = tw.kinetic_energy(bare, s.q, s.v)
    assert close(tw.kinetic_energy(geared, s.q, s.v) - T, (rotors * s.v**2).sum() / 2, size=T)
    assert (tw.centroidal_map(geared, s.q) == tw.centroidal_map(bare, s.q)).all()
    assert (tw.nonlinear_effects(geared, s.q, s.v) == tw.nonlinear_effects(bare, s.q, s.v)).all()


# ---------------------------------------------------------------- the same motion seen from elsewhere


def moved(model, q, T):
    """Return the q of a floating robot that stands as before in a frame that is placed at T."""
    base = T @ tw.SE3(tw.forward_kinematics(model, q).placement[1].rotation, q[:3])
    return np.concatenate([base.translation, rotation_to_quaternion(base.rotation), q[7:]])


@floating
@several
def test_dynamics_do_not_depend_on_where_the_world_is(recipe):
    model, s, frame = recipe.model, recipe.state(), recipe.frame()
    T = tw.exp6([0.3, -1.1, 0.7, 4.0, -2.0, 1.0])
    turned = replace(model, gravity=T.rotation @ model.gravity)
    q, X = moved(model, s.q, T), T.motion_transform()
    twice = np.kron(np.eye(2), T.rotation)
    tau, h = tw.rnea(model, s.q, s.v, s.a, s.f_ext), tw.nonlinear_effects(model, s.q, s.v)
    assert close(tw.rnea(turned, q, s.v, s.a, s.f_ext), tau)
    assert not close(tw.rnea(model, q, s.v, s.a, s.f_ext), tau)  # the weight has stayed behind
    assert close(tw.crba(model, q), tw.crba(model, s.q))
    assert close(tw.coriolis_matrix(model, q, s.v), tw.coriolis_matrix(model, s.q, s.v))
    M, a = tw.crba(model, s.q), tw.aba(model, s.q, s.v, s.tau)
    assert close(tw.aba(turned, q, s.v, s.tau), a, 2 * SKEEL * EPS * skeel(M, a, s.tau, h))
    assert close(tw.center_of_mass(model, q), T.act(tw.center_of_mass(model, s.q)))
    assert close(tw.centroidal_map(model, q), twice @ tw.centroidal_map(model, s.q))
    assert close(tw.potential_energy(turned, q) - tw.potential_energy(model, s.q),
                 -model.mass * turned.gravity @ T.translation, size=model.mass * 9.81)  # fmt: skip
    J = {reference: tw.frame_jacobian(model, s.q, frame, reference) for reference in REFERENCES}
    assert close(tw.frame_jacobian(model, q, frame, "local"), J["local"])
    assert close(tw.frame_jacobian(model, q, frame, "world"), X @ J["world"])
    assert close(tw.frame_jacobian(model, q, frame, "local_world_aligned"), twice @ J["local_world_aligned"])


@floating
@several
def test_uniform_motion_of_everything_goes_unnoticed(recipe):
    # Galileo: add a constant velocity c. In the base's frame that is Rᵀc, which turns backwards with −ω × Rᵀc.
    model, s = recipe.model, recipe.state()
    seen = tw.forward_kinematics(model, s.q).placement[1].rotation.T @ [3.0, -5.0, 2.0]
    v, a = s.v.copy(), s.a.copy()
    v[3:6] += seen
    a[3:6] -= np.cross(s.v[:3], seen)
    tau = tw.rnea(model, s.q, s.v, s.a)
    assert close(tw.rnea(model, s.q, v, a), tau, 1e-11)  # terms of the order of |c| cancel
    assert not close(tw.rnea(model, s.q, v, s.a), tau)
    assert close(
        tw.centroidal_momentum(model, s.q, v) - tw.centroidal_momentum(model, s.q, s.v),
        np.concatenate([np.zeros(3), model.mass * np.array([3.0, -5.0, 2.0])]),
    )


# ---------------------------------------------------------------- every argument counts


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_every_argument_changes_the_answer(base):
    model = tw.random_tree(6, rng=3, base=base)
    rng = np.random.default_rng(0)
    q, other_q = model.random_configuration(rng=rng), model.random_configuration(rng=rng)
    v, a, tau, change = rng.standard_normal((4, model.nv))
    f_ext = rng.standard_normal((model.nbodies, 6))
    f_ext[0] = 0
    frame, elsewhere = body_frame(model, 6), body_frame(model, 3)
    functions = [
        (tw.rnea, {"q": q, "v": v, "a": a, "f_ext": None}),
        (tw.joint_wrenches, {"q": q, "v": v, "a": a, "f_ext": None}),
        (tw.aba, {"q": q, "v": v, "tau": tau, "f_ext": None}),
        (tw.crba, {"q": q}),
        (tw.gravity, {"q": q}),
        (tw.nonlinear_effects, {"q": q, "v": v}),
        (tw.coriolis_matrix, {"q": q, "v": v}),
        (tw.kinetic_energy, {"q": q, "v": v}),
        (tw.potential_energy, {"q": q}),
        (tw.center_of_mass, {"q": q}),
        (tw.centroidal_map, {"q": q}),
        (tw.centroidal_momentum, {"q": q, "v": v}),
        (tw.centroidal_momentum_rate, {"q": q, "v": v, "a": a}),
        (lambda m, q, v, a: tw.forward_kinematics(m, q, v, a).acceleration, {"q": q, "v": v, "a": a}),
        (lambda m, q, v: tw.forward_kinematics(m, q, v).twist, {"q": q, "v": v}),
        (lambda m, q: tw.forward_kinematics(m, q).placement[-1].matrix(), {"q": q}),
        (lambda m, q, frame: tw.frame_placement(m, q, frame).matrix(), {"q": q, "frame": frame}),
        (tw.frame_jacobian, {"q": q, "frame": frame, "reference": "local"}),
        (tw.frame_bias_acceleration, {"q": q, "v": v, "frame": frame, "reference": "local"}),
        (tw.contact_jacobian, {"q": q, "contacts": [frame]}),
        (model.integrate.__func__, {"q": q, "v_dt": v}),
        (model.difference.__func__, {"q0": q, "q1": model.integrate(q, v)}),
    ]
    changed = {
        "q": other_q, "q0": other_q, "q1": other_q, "v": change, "a": change, "tau": change, "v_dt": change,
        "f_ext": f_ext, "frame": elsewhere, "contacts": [elsewhere],
    }  # fmt: skip
    for function, arguments in functions:
        before = function(model, **arguments)
        for name in arguments:
            for value in ["world", "local_world_aligned"] if name == "reference" else [changed[name]]:
                after = function(model, **(arguments | {name: value}))
                assert np.abs(after - before).max() > 1e-3, f"{function} does not notice {name}"

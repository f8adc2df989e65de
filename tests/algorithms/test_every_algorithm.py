"""What all algorithms have in common: rotors, the observer, every argument, and a robot without joints."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.spatial import rotation_to_quaternion

from ..invariants import body_frame, close, floating, several, trees
from ..strategies import REFERENCES
from ..truth import SKEEL, skeel

EPS = np.finfo(np.float64).eps


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


def moved(model, q, T):
    """Return the q of a floating robot that stands as before in a frame that is placed at T."""
    base = T @ tw.SE3(tw.forward_kinematics(model, q).placement[1].rotation, q[:3])
    return np.concatenate([base.translation, rotation_to_quaternion(base.rotation), q[7:]])


@floating
@several
def test_no_algorithm_depends_on_where_the_world_is(recipe):
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


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_every_argument_changes_the_answer_of_every_algorithm(base):
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
        (tw.centroidal_map_rate, {"q": q, "v": v}),
        (tw.centroidal_inertia, {"q": q}),
        (tw.center_of_mass_jacobian, {"q": q}),
        (tw.center_of_mass_velocity, {"q": q, "v": v}),
        (tw.center_of_mass_acceleration, {"q": q, "v": v, "a": a}),
        (lambda m, q, frame: tw.subtree(m, q, frame).momentum_map, {"q": q, "frame": frame}),
        (tw.articulated_inertia, {"q": q, "frame": body_frame(model, 1)}),  # of a tip it is the body's own
        (tw.ltl, {"q": q}),
        (tw.solve_mass_matrix, {"q": q, "tau": tau}),
        (tw.inverse_mass_matrix, {"q": q}),
        (tw.delassus_matrix, {"q": q, "J": np.eye(2, model.nv)}),
        (tw.operational_space_inertia, {"q": q, "J": np.eye(2, model.nv)}),
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
        "f_ext": f_ext, "frame": elsewhere, "contacts": [elsewhere], "J": np.eye(2, model.nv, 1),
    }  # fmt: skip
    for function, arguments in functions:
        before = function(model, **arguments)
        for name in arguments:
            for value in ["world", "local_world_aligned"] if name == "reference" else [changed[name]]:
                after = function(model, **(arguments | {name: value}))
                assert np.abs(after - before).max() > 1e-3, f"{function} does not notice {name}"


def test_every_algorithm_takes_a_model_without_joints():
    model = tw.Builder("rock").build()
    empty = np.zeros(0)
    assert (model.nq, model.nv, model.nbodies) == (0, 0, 1)
    assert tw.rnea(model, empty, empty, empty).shape == (0,)
    assert tw.aba(model, empty, empty, empty).shape == (0,)
    assert tw.crba(model, empty).shape == (0, 0)
    assert tw.kinetic_energy(model, empty, empty) == 0
    for function, arguments in ((tw.center_of_mass, 1), (tw.centroidal_map, 1), (tw.centroidal_momentum_rate, 3)):
        with pytest.raises(tw.SingularError, match="centre of mass of 'rock': nothing that moves has mass"):
            function(model, *[empty] * arguments)
    assert tw.frame_placement(model, empty, "base_link").translation.tolist() == [0, 0, 0]
    assert tw.frame_jacobian(model, empty, "base_link").shape == (6, 0)

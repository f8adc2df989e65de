"""Energy: that of mechanisms of the textbooks, and what its derivatives must be on random trees."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from ..invariants import H, close, rate, several, step, trees
from ..mechanisms import C1, M1, G, agrees, mechanisms, pendulum, states


@mechanisms
@states
def test_kinetic_energy_is_that_of_the_textbook(mechanism, q, v, a):
    motion = mechanism(q, v, a)
    assert agrees(tw.kinetic_energy(motion.model, motion.q, motion.v), motion.v @ motion.M @ motion.v / 2)


@states
def test_potential_energy_of_a_pendulum_is_that_of_the_textbook(q, v, a):
    assert agrees(tw.potential_energy(pendulum(), q[:1]), -M1 * G * C1 * np.cos(q[0]))


@trees
@several
def test_kinetic_energy_has_the_momentum_for_its_derivative(recipe):
    model, s = recipe.model, recipe.state()
    M, T = tw.crba(model, s.q), tw.kinetic_energy(model, s.q, s.v)
    assert close(rate(tw.kinetic_energy(model, s.q, s.v + 1j * H * np.eye(model.nv))), M @ s.v)
    assert close(T, s.v @ M @ s.v / 2)


@trees
@several
def test_potential_energy_has_gravity_for_its_gradient(recipe):
    model, s = recipe.model, recipe.state()
    gradient = rate(tw.potential_energy(model, step(model, s.q, np.eye(model.nv))))
    assert close(tw.gravity(model, s.q), gradient, size=model.mass * 9.81)


@trees
@several
def test_energy_changes_at_the_power_of_all_forces(recipe):
    model, s = recipe.model, recipe.state()
    tau = tw.rnea(model, s.q, s.v, s.a, s.f_ext)
    q, v = step(model, s.q, s.v), s.v + 1j * H * s.a
    kinetic, potential = rate(tw.kinetic_energy(model, q, v)), rate(tw.potential_energy(model, q))
    twists = tw.forward_kinematics(model, s.q, s.v).twist
    powers = np.append(tau * s.v, s.f_ext * twists)
    assert close(kinetic + potential, powers.sum(), size=np.abs(powers).max())

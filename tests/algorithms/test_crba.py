"""CRBA: mass matrices of the textbooks, and what every mass matrix must be."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from ..invariants import several, trees
from ..mechanisms import agrees, geared_pendulum, mechanisms, states


@mechanisms
@states
def test_crba_gives_the_mass_matrix_of_the_textbook(mechanism, q, v, a):
    motion = mechanism(q, v, a)
    assert agrees(tw.crba(motion.model, motion.q), motion.M)


def test_crba_counts_a_rotor_by_its_reflected_inertia():
    # a motor of inertia J behind a gear n : 1 adds n² J
    model, total = geared_pendulum()
    assert agrees(tw.crba(model, [0.0]), [[total]])


@trees
@several
def test_crba_gives_a_symmetric_and_positive_definite_matrix(recipe):
    model, s = recipe.model, recipe.state()
    M = tw.crba(model, s.q)
    assert (M == M.T).all()
    assert np.linalg.eigvalsh(M).min() > 0

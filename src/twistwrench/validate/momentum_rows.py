"""The rows of 49.8 and 49.10: energies, centre of mass, centroidal momentum."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from .. import bridge
from .. import newton_euler_3d as ne
from .conditioning import reach, weight_at_reach
from .quantity import ComparedQuantity

__all__ = ["MOMENTUM"]

MOMENTUM = (
    ComparedQuantity(
        "49.8",
        "kinetic energy",
        "computeKineticEnergy",
        ours=lambda m, s: tw.kinetic_energy(m, s.q, s.v),
        theirs=lambda p, s: np.array(p.pin.computeKineticEnergy(p.model, p.data, s.q, p.tangent(s.v))),
        truth=lambda m, s: np.array(ne.kinetic_energy(m, s.q, s.v)),
    ),
    ComparedQuantity(
        "49.8",
        "potential energy",
        "computePotentialEnergy",
        ours=lambda m, s: tw.potential_energy(m, s.q),
        theirs=lambda p, s: np.array(p.pin.computePotentialEnergy(p.model, p.data, s.q)),
        truth=lambda m, s: np.array(ne.potential_energy(m, s.q)),
        terms=weight_at_reach,
    ),
    ComparedQuantity(
        "49.10",
        "centre of mass",
        "centerOfMass",
        ours=lambda m, s: tw.center_of_mass(m, s.q),
        theirs=lambda p, s: np.array(p.pin.centerOfMass(p.model, p.data, s.q)),
        truth=lambda m, s: ne.center_of_mass(m, s.q),
        terms=reach,
    ),
    ComparedQuantity(
        "49.10",
        "centroidal map A_G",
        "data.Ag",
        ours=lambda m, s: tw.centroidal_map(m, s.q),
        theirs=lambda p, s: p.jacobian(p.centroidal(s).Ag),
        truth=lambda m, s: ne.centroidal_map(m, s.q),
    ),
    ComparedQuantity(
        "49.10",
        "momentum h_G",
        "data.hg",
        ours=lambda m, s: tw.centroidal_momentum(m, s.q, s.v),
        theirs=lambda p, s: bridge.from_pinocchio_force(p.centroidal(s).hg),
        truth=lambda m, s: ne.centroidal_momentum(m, s.q, s.v),
    ),
    ComparedQuantity(
        "49.10",
        "its rate ḣ_G",
        "data.dhg",
        ours=lambda m, s: tw.centroidal_momentum_rate(m, s.q, s.v, s.a),
        theirs=lambda p, s: bridge.from_pinocchio_force(p.centroidal(s).dhg),
        truth=lambda m, s: ne.centroidal_momentum_rate(m, s.q, s.v, s.a),
    ),
)

"""What can be compiled: the quantities of the chapter, by the name of their function or by their symbol."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from ..algorithms.aba import aba_terms
from ..algorithms.centroidal import center_of_mass, centroidal_map, centroidal_momentum, centroidal_momentum_rate
from ..algorithms.coriolis import coriolis_matrix
from ..algorithms.crba import crba
from ..algorithms.energy import kinetic_energy, potential_energy
from ..algorithms.floating_base import HeldRows, contact_jacobian, selection_matrix
from ..algorithms.kinematics import Reference, frame_bias_acceleration, frame_jacobian, frame_placement
from ..algorithms.momentum_rate import (
    center_of_mass_acceleration,
    center_of_mass_velocity,
    centroidal_inertia,
    centroidal_map_rate,
)
from ..algorithms.rnea import gravity, nonlinear_effects, rnea
from ..algorithms.subtree import subtree
from ..arrays import Array
from ..errors import check_known
from ..model import Model, tree_terms
from .derivatives import derivatives, regressor
from .inverses import inverses
from .quantity import ARGUMENTS, Quantity, of_each, shapes
from .watch import pivots, with_watch

__all__ = ["ARGUMENTS", "SYMBOLS", "Quantity", "chosen", "quantities", "shapes"]

SYMBOLS = {
    "rnea": "tau",
    "aba": "qdd",
    "crba": "M",
    "nonlinear_effects": "h",
    "gravity": "g",
    "coriolis_matrix": "C",
    "kinetic_energy": "T",
    "potential_energy": "U",
    "selection_matrix": "S",
    "contact_jacobian": "J_c",
    "center_of_mass": "p_G",
    "centroidal_map": "A_G",
    "centroidal_momentum": "h_G",
    "centroidal_momentum_rate": "dh_G",
    "centroidal_map_rate": "dA_G",
    "centroidal_inertia": "I_G",
    "center_of_mass_velocity": "v_G",
    "center_of_mass_acceleration": "a_G",
    "inverse_mass_matrix": "M_inv",
    "solve_mass_matrix": "M_inv_tau",
    "delassus_matrix": "Lambda_inv",
    "operational_space_inertia": "Lambda",
    "articulated_inertia": "IA",
    "frame_placement": "placement",
    "frame_jacobian": "J",
    "frame_bias_acceleration": "dJ_v",
}
"""The symbol of each function of the package that can be compiled.

Besides: L and D of `ltdl`; of `subtree` the centre p_S, the map A_S and the inertia I_S; the regressor Y; derivatives.
"""


def quantities(
    model: Model,
    dtype: np.dtype[Any],
    contacts: Sequence[str | HeldRows] = (),
    frames: Sequence[str] = (),
    reference: Reference = "local",
    instead: Iterable[Quantity] = (),
) -> dict[str, Quantity]:
    """Return what can be computed of a model, by symbol.

    The number type decides what counts as singular. The contacts are those of J_c; the frames, along an axis before
    their own, those of placements, J and J̇ v, with this reference. What is given `instead`, a scene's quantities, takes
    the place of those of the same symbols, also where derivatives are asked for.
    """

    def of(symbol: str, arguments: str, function: Callable[..., Array]) -> Quantity:
        return Quantity(symbol, tuple(arguments.split()), lambda *x: (function(model, *x), []))

    def of_frames(symbol: str, arguments: str, one: Callable[..., Array], *tail: int) -> Quantity:
        return of(symbol, arguments, partial(of_each, frames, one, tail))

    def forward_dynamics(q: Array, v: Array, tau: Array, f_ext: Array | None = None) -> tuple[Array, list[Any]]:
        terms = aba_terms(model, q, v, tau, f_ext)
        if terms.qdd.dtype != object:
            return terms.qdd, []
        return terms.qdd, [*pivots(model, tree_terms(model, q), terms.D_inv, dtype)]

    nv = model.nv
    every = [
        of("tau", "q v a f_ext", rnea),
        Quantity("qdd", ("q", "v", "tau", "f_ext"), forward_dynamics),
        of("M", "q", crba),
        of("h", "q v", nonlinear_effects),
        of("g", "q", gravity),
        of("C", "q v", coriolis_matrix),
        of("T", "q v", kinetic_energy),
        of("U", "q", potential_energy),
        of("S", "", selection_matrix),
        Quantity("J_c", ("q",), lambda q: with_watch(contact_jacobian(model, q, contacts), contacts)),
        of("p_G", "q", center_of_mass),
        of("A_G", "q", centroidal_map),
        of("h_G", "q v", centroidal_momentum),
        of("dh_G", "q v a", centroidal_momentum_rate),
        of("dA_G", "q v", centroidal_map_rate),
        of("I_G", "q", centroidal_inertia),
        of("v_G", "q v", center_of_mass_velocity),
        of("a_G", "q v a", center_of_mass_acceleration),
        of_frames("placement", "q", lambda m, q, name: frame_placement(m, q, name).matrix(), 4, 4),
        of_frames("J", "q", lambda m, q, name: frame_jacobian(m, q, name, reference), 6, nv),
        of_frames("dJ_v", "q v", lambda m, q, v, name: frame_bias_acceleration(m, q, v, name, reference), 6),
        of_frames("p_S", "q", lambda m, q, name: subtree(m, q, name).center_of_mass, 3),
        of_frames("A_S", "q", lambda m, q, name: subtree(m, q, name).momentum_map, 6, nv),
        of_frames("I_S", "q", lambda m, q, name: subtree(m, q, name).inertia, 6, 6),
    ]
    known = {quantity.symbol: quantity for quantity in every} | {x.symbol: x for x in instead}
    every = [*known.values(), *inverses(model, dtype, frames, known["J_c"])]
    every += [of("Y", "q v a", regressor), *(d for quantity in every for d in derivatives(model, quantity))]
    return {quantity.symbol: quantity for quantity in every}


def chosen(known: Mapping[str, Quantity], want: Sequence[str]) -> tuple[Quantity, ...]:
    """Return the quantities of these names, which are symbols or names of functions."""
    for name in want:
        check_known("quantity", name, [*known, *(f for f, symbol in SYMBOLS.items() if symbol in known)])
    return tuple(dict.fromkeys(known[SYMBOLS.get(name, name)] for name in want))

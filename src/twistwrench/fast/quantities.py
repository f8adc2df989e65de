"""What can be compiled: the quantities of the chapter, by the name of their function or by their symbol."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from ..algorithms.aba import aba_terms
from ..algorithms.articulated import articulated_inertia, articulated_inertias
from ..algorithms.centroidal import center_of_mass, centroidal_map, centroidal_momentum, centroidal_momentum_rate
from ..algorithms.coriolis import coriolis_matrix
from ..algorithms.crba import crba
from ..algorithms.delassus import delassus_matrix, operational_space_inertia
from ..algorithms.energy import kinetic_energy, potential_energy
from ..algorithms.factorization import ltdl, solve_mass_matrix
from ..algorithms.floating_base import HeldRows, contact_jacobian, selection_matrix
from ..algorithms.inverse_mass import inverse_mass_matrix
from ..algorithms.kinematics import Reference, frame_bias_acceleration, frame_jacobian, frame_placement
from ..algorithms.momentum_rate import (
    center_of_mass_acceleration,
    center_of_mass_jacobian,
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
from .quantity import Quantity, shapes
from .watch import MIN_PIVOT_SHARE, pivots, with_watch

__all__ = ["SYMBOLS", "Quantity", "chosen", "quantities", "shapes"]

FUNCTIONS: dict[str, tuple[str, Callable[..., Array]]] = {
    "tau": ("q v a f_ext", rnea),
    "M": ("q", crba),
    "h": ("q v", nonlinear_effects),
    "g": ("q", gravity),
    "C": ("q v", coriolis_matrix),
    "T": ("q v", kinetic_energy),
    "U": ("q", potential_energy),
    "S": ("", selection_matrix),
    "p_G": ("q", center_of_mass),
    "A_G": ("q", centroidal_map),
    "h_G": ("q v", centroidal_momentum),
    "dh_G": ("q v a", centroidal_momentum_rate),
    "dA_G": ("q v", centroidal_map_rate),
    "I_G": ("q", centroidal_inertia),
    "J_G": ("q", center_of_mass_jacobian),
    "v_G": ("q v", center_of_mass_velocity),
    "a_G": ("q v a", center_of_mass_acceleration),
}
"""What depends on a model and a state alone, and divides by nothing but masses."""

SYMBOLS = {function.__name__: symbol for symbol, (_, function) in FUNCTIONS.items()} | {
    "aba": "qdd",
    "contact_jacobian": "J_c",
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

    The number type decides what counts as singular. The contacts are those of J_c, the frames those of placements, J,
    J̇ v and the like. What is given `instead` takes the place of those of the same symbols, also where others depend on
    them.
    """

    def of(
        symbol: str, arguments: str, function: Callable[..., Array], watch: Callable[[Array], Any] | None = None
    ) -> Quantity:
        def compute(*x: Array) -> tuple[Array, list[Any]]:
            return function(model, *x), [*watch(x[0])] if watch and x[0].dtype == object else []

        return Quantity(symbol, tuple(arguments.split()), compute)

    def by_aba(q: Array) -> Iterator[Any]:
        tree = tree_terms(model, q)
        return pivots(model, tree, articulated_inertias(tree).D_inv, dtype)

    def by_factors(q: Array) -> Iterator[Any]:
        D = ltdl(model, q)[1]
        return pivots(model, tree_terms(model, q), [np.diag(1 / D[s]) for s in model.v_slice], dtype)

    def rows(q: Array) -> Array:
        return known["J_c"].compute(q)[0]

    def by_rows(q: Array) -> Iterator[Any]:
        """Yield also A_kk (A⁻¹)_kk of each row, 1 where it is independent of the others, over the largest allowed."""
        yield from by_factors(q)
        A, A_inv = delassus_matrix(model, q, rows(q)), operational_space_inertia(model, q, rows(q))
        yield from Fraction(MIN_PIVOT_SHARE) * np.diag(A) * np.diag(A_inv)

    every = [
        *(of(symbol, arguments, function) for symbol, (arguments, function) in FUNCTIONS.items()),
        of("qdd", "q v tau f_ext", lambda m, *x: aba_terms(m, *x).qdd, by_aba),
        Quantity("J_c", ("q",), lambda q: with_watch(contact_jacobian(model, q, contacts), contacts)),
        of("M_inv", "q", inverse_mass_matrix, by_aba),
        of("L", "q", lambda m, q: ltdl(m, q)[0], by_factors),
        of("D", "q", lambda m, q: ltdl(m, q)[1], by_factors),
        of("M_inv_tau", "q tau", solve_mass_matrix, by_factors),
        of("Lambda_inv", "q", lambda m, q: delassus_matrix(m, q, rows(q)), by_factors),
        of("Lambda", "q", lambda m, q: operational_space_inertia(m, q, rows(q)), by_rows),
        of("IA", "q", of_each(frames, articulated_inertia, 6, 6), by_aba),
        *(of(*of_frames) for of_frames in _of_frames(model.nv, frames, reference)),
    ]
    known = {quantity.symbol: quantity for quantity in [*every, *instead]}
    made = [d for quantity in known.values() for d in derivatives(model, quantity, dtype)]
    return known | {x.symbol: x for x in [of("Y", "q v a", regressor), *made]}


def chosen(known: Mapping[str, Quantity], want: Sequence[str]) -> tuple[Quantity, ...]:
    """Return the quantities of these names, which are symbols or names of functions."""
    for name in want:
        check_known("quantity", name, [*known, *(f for f, symbol in SYMBOLS.items() if symbol in known)])
    return tuple(dict.fromkeys(known[SYMBOLS.get(name, name)] for name in want))


def of_each(frames: Sequence[str], one: Callable[..., Array], *tail: int) -> Callable[..., Array]:
    """Return a quantity of each frame, along an axis before its own, which have the shape `tail`."""

    def function(model: Model, *x: Array) -> Array:
        each = [one(model, *x, name) for name in frames]
        return np.stack(each, axis=-1 - len(tail)) if each else np.zeros((0, *tail))

    return function


def _of_frames(nv: int, frames: Sequence[str], reference: Reference) -> Iterator[tuple[str, str, Callable[..., Array]]]:
    """Yield symbols, arguments and functions of what is asked of frames."""
    each = partial(of_each, frames)
    yield "placement", "q", each(lambda m, q, name: frame_placement(m, q, name).matrix(), 4, 4)
    yield "J", "q", each(lambda m, q, name: frame_jacobian(m, q, name, reference), 6, nv)
    yield "dJ_v", "q v", each(lambda m, q, v, name: frame_bias_acceleration(m, q, v, name, reference), 6)
    yield "p_S", "q", each(lambda m, q, name: subtree(m, q, name).center_of_mass, 3)
    yield "A_S", "q", each(lambda m, q, name: subtree(m, q, name).momentum_map, 6, nv)
    yield "I_S", "q", each(lambda m, q, name: subtree(m, q, name).inertia, 6, 6)

"""Measure one robot."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Collection
from dataclasses import replace
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from os import PathLike
from typing import Literal

import numpy as np

import twistwrench as tw
from twistwrench.advice import NO_MPMATH
from twistwrench.errors import ModelError, unknown_name
from twistwrench.loading import load
from twistwrench.model import Model
from twistwrench.validate.oracle import Oracle
from twistwrench.validate.states import States, random_states

from .derivatives import derivative
from .dynamics import REFERENCE, WAYS, Robot, Ways
from .measure import Effort, candidates, measure
from .numbers import PAIRS, TRUTH, convert
from .poses import pose_quantities
from .quantity import Arrays, Inputs, Quantity, repeated
from .report import Trade

__all__ = ["FULL", "KEYS", "SHORT", "weigh"]

DRAWN = 50
"""The number of random states; larger batches repeat them."""

SLOPE = "dID/dq"
KEYS = (*WAYS, SLOPE, "exp", "log")
FULL = Effort()
SHORT = Effort(states=2, batch=20, rounds=2, least=1e-4, most=0.05)
"""A quick check that all of it runs. Its times are worth little."""


def weigh(
    robot: Model | str | PathLike[str],
    *,
    base: Literal["fixed", "floating"] | None = None,
    only: Collection[str] = (),
    effort: Effort = FULL,
    rng: int = 0,
    progress: bool | None = False,
    after_quantity: Callable[[Trade], object] = lambda trade: None,
) -> Trade:
    """Measure speed against accuracy: every quantity, every way, every number type.

    Parameters
    ----------
    robot : Model, str or path
        A name or a path is loaded as by `twistwrench.load`, accepting bodies that are not physical.
    base : {"fixed", "floating"}, optional
        For a name or a path: the base to load it with.
    only : collection of str
        The quantities to measure, of `KEYS`; all unless given.
    effort : Effort
    rng : int
        Seed of the random states.
    progress : bool, optional
        Show a bar on stderr; None: if that is a terminal.
    after_quantity : callable
        Called with what was measured so far, after each quantity.

    Returns
    -------
    Trade
        Prints as tables and words.

    Raises
    ------
    NameNotFound, ModelError
        As `twistwrench.load`; or if a quantity is unknown or nothing moves.
    ImportError
        If mpmath, which computes the truth, is not installed.
    ValueError
        If a base is named for a `Model`, which has one.

    Examples
    --------
    >>> trade = weigh("pendulum", only=["ID"], effort=SHORT)
    >>> {p.number for p in trade.points} >= {"float32", "float64", "50 digits"}
    True
    """
    from tqdm import tqdm

    start = time.perf_counter()
    for key in only:
        if key not in KEYS:
            raise unknown_name("quantity", key, KEYS)
    _ask_for_mpmath()
    model = _load(robot, base)
    if not model.nv:
        raise ModelError(f"{model.name}: nothing moves: nothing to measure")
    oracle = _oracle(model)
    quantities = [q for q in _quantities(model, oracle, effort, rng) if not only or q.key in only]
    points, left_out = [], []
    trade = Trade(
        robot=model.name if isinstance(robot, Model) else str(robot),
        description=repr(model).partition(": ")[2],
        names={},
        points=(),
        left_out=(),
        missing=_missing(),
        versions=_versions(),
        effort=effort,
        seconds=0.0,
    )
    steps = sum(len(candidates(q)) + effort.rounds for q in quantities)
    hidden = None if progress is None else not progress
    with tqdm(total=steps, unit="step", leave=False, disable=hidden) as bar:
        for quantity in quantities:
            bar.set_description(quantity.key)
            found, rejected = measure(quantity, effort, bar.update)
            points += found
            left_out += rejected
            names = {**trade.names, quantity.key: quantity.name}
            seconds = time.perf_counter() - start
            trade = replace(trade, names=names, points=tuple(points), left_out=tuple(left_out), seconds=seconds)
            after_quantity(trade)
    return trade


def _load(robot: Model | str | PathLike[str], base: Literal["fixed", "floating"] | None) -> Model:
    if not isinstance(robot, Model):
        return load(robot, base=base, physical=False, mimic="independent")
    if base is not None:
        raise ValueError(f"base: a Model has its base ({robot.base}) already, got {base!r}")
    return robot


def _quantities(model: Model, oracle: Oracle | None, effort: Effort, seed: int) -> list[Quantity]:
    """Return all quantities. The same states are drawn for every effort, and repeated to make a batch."""
    rng = np.random.default_rng(seed)
    states = random_states(model, DRAWN, rng=rng)
    at = Robot(model, oracle, _moving_frame(model, states))

    def quantity(key: str, name: str, of: tuple[str, ...], ways: Ways, batch: int) -> Quantity:
        inputs = _inputs(model, states, of)
        truth, every = ways(at)
        return Quantity(key, name, inputs, lambda i: truth(*inputs(TRUTH, i)), every, batch)

    dynamics = [quantity(key, *of, effort.batch) for key, of in WAYS.items()]
    # Each derivative evaluates nv or more states.
    slopes = quantity(SLOPE, "derivative ∂τ/∂q", ("q", "v", "a"), derivative, max(2, effort.batch // 10))
    poses = pose_quantities(DRAWN, effort.states, batch=effort.batch, rng=rng, pinocchio=oracle is not None)
    return [*dynamics, slopes, *poses]


def _moving_frame(model: Model, s: States) -> str:
    """Return a frame whose J̇ v is not zero, as it is on an axis that does not move; a foot if there is one."""
    names = (*s.frames, *model.frame_names)
    moving = (name for name in names if tw.frame_bias_acceleration(model, s.q[0], s.v[0], name, REFERENCE).any())
    return next(moving, names[0])


def _inputs(model: Model, s: States, of: tuple[str, ...]) -> Inputs:
    """Return q and others in a number type; NumPy's quaternions are made unit to the last digit of that type."""

    def inputs(number: str, where: int | slice) -> Arrays:
        q, *others = (convert(repeated(getattr(s, name), where), number) for name in of)
        return (q if number == PAIRS or number.endswith("digits") else model.normalize(q)), *others

    return inputs


def _ask_for_mpmath() -> None:
    if not _is_there("mpmath"):
        raise ImportError(NO_MPMATH)


def _oracle(model: Model) -> Oracle | None:
    try:
        return Oracle(model, None)
    except ImportError:
        return None


def _versions() -> dict[str, str]:
    found = {"python": sys.version.split()[0]}
    for name in ("twistwrench", "numpy", "mpmath", "gmpy2", "scipy", "pin"):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def _missing() -> tuple[str, ...]:
    """Return in words whose ways are missing."""
    said = {
        "pinocchio": "Pinocchio is not installed: its ways are left out (pip install pin; not on Windows)",
        "scipy": "SciPy is not installed: its ways are left out (pip install scipy)",
        "gmpy2": "gmpy2 is not installed: mpmath is some times slower without it (pip install gmpy2)",
    }
    return tuple(text for name, text in said.items() if not _is_there(name))


def _is_there(name: str) -> bool:
    try:
        import_module(name)
    except ImportError:
        return False
    return True

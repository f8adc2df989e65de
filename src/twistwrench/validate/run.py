"""Validate one robot (49.11)."""

from __future__ import annotations

import time
from collections.abc import Iterable
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ..arrays import as_count
from ..errors import NameNotFound, no_model
from ..loading import load
from ..loading.catalogue import find
from ..loading.element import read_robot_xml
from ..model import Model
from .fast_rows import FAST
from .measure import Judge
from .oracle import Oracle
from .quantities import QUANTITIES
from .quantity import ComparedQuantity
from .report import Report
from .states import random_states

__all__ = ["NOTHING_TO_COMPARE_WITH", "validate"]

REFERENCE_DIGITS = 50

NOTHING_TO_COMPARE_WITH = 'nothing to compare with: pip install "twistwrench[validate]" brings Pinocchio and mpmath'


def validate(
    robot: Model | str | PathLike[str],
    *,
    base: Literal["fixed", "floating"] | None = None,
    states: int = 8,
    truths: int = 3,
    frames: int = 4,
    rng: np.random.Generator | int = 0,
    fast: bool = False,
    progress: bool = False,
) -> Report:
    """Compare every quantity of the chapter with Pinocchio and with the 50-digit reference.

    Parameters
    ----------
    robot : Model, str or path
        A name or a path is loaded as by `twistwrench.load`, accepting bodies that are not physical, and
        Pinocchio reads the same file by itself. A `Model` is converted by the bridge.
    base : {"fixed", "floating"}, optional
        The base with which a name or a path is loaded.
    states : int
        Number of random states; ours is computed for all of them in one batch.
    truths : int
        The number of states at which the reference is always computed. At the other states it is computed if our result
        differs from Pinocchio's by more than the bound.
    frames : int
        The largest number of frames whose Jacobians are compared: first the feet, then other tips of the tree.
    rng : numpy Generator or int
        The source of the states. The same seed gives the same report, except for the times.
    fast : bool
        Compare the functions of `twistwrench.fast` instead: the first state by itself, the others in a batch.
    progress : bool
        Show a bar on stderr.

    Returns
    -------
    Report
        Prints as a table; `Report.passed` is whether every row is inside its bound.

    Raises
    ------
    NameNotFound, ModelError
        As `twistwrench.load`.
    ImportError
        If neither Pinocchio nor mpmath is installed to compare with.
    ValueError
        If `states` or `frames` is below 1, or a base is named for a `Model`.

    Notes
    -----
    Error: the largest difference at a state, over the largest entry of the right value; where larger
    terms cancelled in that, over a part of those. Bound: 1e-12; for the result of an inverse the
    larger one that its conditioning allows. See `twistwrench.validate.conditioning`. The truth decides
    where it is known, Pinocchio elsewhere.

    Examples
    --------
    >>> from twistwrench.validate import validate
    >>> report = validate("pendulum", states=2, truths=1)
    >>> report.passed
    True
    """
    start = time.perf_counter()
    for name, value, least in (("states", states, 1), ("truths", truths, 0), ("frames", frames, 1)):
        as_count(value, name, least)
    model, path = _load(robot, base)
    oracle = _oracle(model, path)
    context = _context()
    if oracle is None and context is None:
        raise ImportError(NOTHING_TO_COMPARE_WITH)
    at = random_states(model, states, rng=rng, frames=frames)
    judge = Judge(model, at, oracle, context, truths=min(truths, states))
    rows = (
        [judge.row(q) for q in _bar(FAST if fast else QUANTITIES, progress, model.name) if q.applies(model)]
        if model.nv
        else []
    )
    return Report(
        robot=model.name if isinstance(robot, Model) else str(robot),
        description=repr(model).partition(": ")[2],
        base=model.base,
        nv=model.nv,
        rows=tuple(rows),
        pinocchio=None if oracle is None else str(oracle.pin.__version__),
        mpmath=None if context is None else _version_of_mpmath(),
        states=states,
        truths=judge.truths,
        seed=int(rng) if isinstance(rng, int | np.integer) else None,
        loader=oracle is not None and path is not None,
        mimics=() if path is None else _mimics(path),
        seconds=time.perf_counter() - start,
    )


def _load(robot: Model | str | PathLike[str], base: Literal["fixed", "floating"] | None) -> tuple[Model, Path | None]:
    """Return the model, and its URDF where there is one."""
    if isinstance(robot, Model):
        if base is not None:
            raise ValueError(f"base: a Model has its base ({robot.base}) already, got {base!r}")
        return robot, None
    if not isinstance(robot, str | PathLike):
        raise no_model(robot, "robot", "a name, a path or a Model")
    model = load(robot, base=base, physical=False, mimic="independent")
    try:
        return model, find(str(robot)).path
    except NameNotFound:
        return model, Path(robot)


def _mimics(path: Path) -> tuple[str, ...]:
    """Name the joints of a URDF that should follow others and here move on their own."""
    moved = (joint for joint in read_robot_xml(path).iterfind("joint") if joint.get("type") != "fixed")
    return tuple(joint.get("name") for joint in moved if joint.find("mimic") is not None)


def _oracle(model: Model, path: Path | None) -> Oracle | None:
    try:
        return Oracle(model, path)
    except ImportError:
        return None


def _context() -> Any:
    """Return an mpmath context of our own, so that nobody else's number of digits changes; None without mpmath."""
    try:
        from mpmath import MPContext
    except ImportError:
        return None
    context = MPContext()
    context.dps = REFERENCE_DIGITS
    return context


def _version_of_mpmath() -> str:
    import mpmath

    return str(mpmath.__version__)


def _bar(quantities: Iterable[ComparedQuantity], show: bool, name: str) -> Iterable[ComparedQuantity]:
    if not show:
        return quantities
    from tqdm import tqdm

    bar: Iterable[ComparedQuantity] = tqdm(quantities, desc=name, unit="row", leave=False)
    return bar

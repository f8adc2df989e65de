"""Sample trees: a chain of equal rods, and random trees with joints of every kind."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Set
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_generator, as_names, as_number, check_choice
from ..errors import ModelError, check_known
from ..spatial import SE3, SpatialInertia, quaternion_to_rotation
from .builder import Base, Builder
from .joint import Joint
from .joints import Continuous, Prismatic, Revolute
from .model import Model

__all__ = ["KINDS", "chain", "random_tree"]

KINDS = tuple(Joint.kinds)
"""The kinds of joint that `random_tree` draws from by default: those of the package."""

MAX_MASS_OR_LENGTH = 1e60
"""Upper bound of masses, lengths and their ratios: products of several must not overflow."""

AXIAL: dict[str, Callable[[str | ArrayLike], Joint]] = {kind.kind: kind for kind in (Revolute, Prismatic, Continuous)}


def chain(
    n: int,
    *,
    mass: float = 1.0,
    length: float = 1.0,
    axis: str | ArrayLike = "y",
    joint: Literal["revolute", "prismatic", "continuous"] = "revolute",
    base: Base = "fixed",
    mass_ratio: float = 1.0,
) -> Model:
    """Return a chain of n round rods that hangs straight down in its neutral configuration.

    Parameters
    ----------
    n : int
        Number of rods, at least 1. A floating base carries the first one, so that n − 1 have a joint of their own.
    mass : float
        Of the first rod, kg.
    length : float
        Of each rod, m; its radius is a twentieth of that.
    axis : {"x", "y", "z"} or array_like, shape (3,)
        Of all joints.
    joint : {"revolute", "prismatic", "continuous"}
        Kind of all joints.
    base : {"fixed", "floating"}
    mass_ratio : float
        Mass of the last rod over that of the first; between them it grows by a constant factor. A heavy
        tip is what forward dynamics finds hard.

    Returns
    -------
    Model
        Links and joints ``"rod_01"``, ``"rod_02"``, …, and a frame ``"tip"`` at the end of the last rod.

    Raises
    ------
    ModelError
        If `n` is not a whole number of at least 1, another number is not positive, or `joint`, `axis` or `base`
        is not one of the above.

    Examples
    --------
    >>> chain(3)
    Model 'chain of 3': fixed base, 3 moving bodies, nq = 3, nv = 3, 3 kg
    >>> chain(3, mass_ratio=4.0).mass
    7.0
    """
    _check_count(n)
    check_choice(base, "base", ("fixed", "floating"), ModelError)
    for name, value in (("mass", mass), ("length", length), ("mass_ratio", mass_ratio)):
        if not 1 / MAX_MASS_OR_LENGTH < as_number(value, name) < MAX_MASS_OR_LENGTH:
            raise ModelError(f"{name}: expected a positive number, and no astronomical one, got {value}")
    mass, length, mass_ratio = float(mass), float(length), float(mass_ratio)
    if not isinstance(joint, str) or joint not in AXIAL:
        raise ModelError(f"joint: expected one of {list(AXIAL)}, got {joint!r}")
    names = [f"rod_{k:0{max(2, len(str(n)))}d}" for k in range(1, n + 1)]
    rods = [_rod(mass * mass_ratio ** (k / max(n - 1, 1)), length) for k in range(n)]
    floats = base == "floating"
    builder = Builder(
        f"chain of {n}", base=base, root=names[0] if floats else "base_link", root_inertia=rods[0] if floats else None
    )
    below = SE3(np.eye(3), [0.0, 0.0, -length])
    for k in range(1 if floats else 0, n):
        builder.link(
            names[k],
            parent=names[k - 1] if k else "base_link",
            joint=AXIAL[joint](axis),
            placement=below if k else None,
            inertia=rods[k],
        )
    builder.link("tip", parent=names[-1], placement=below)
    return builder.build()


def _check_count(n: int) -> None:
    """Raise ModelError unless n is a whole number of at least 1: not 0, 2.5 or True."""
    if not isinstance(n, (int, np.integer)) or isinstance(n, bool) or n < 1:
        raise ModelError(f"n: expected a whole number of at least 1, got {n!r}")


def _rod(mass: float, length: float) -> SpatialInertia:
    """Return the inertia of a uniform cylinder that hangs from its frame along −z."""
    radius = length / 20
    across = mass * (3 * radius**2 + length**2) / 12
    return SpatialInertia(mass, [0.0, 0.0, -length / 2], np.diag([across, across, mass * radius**2 / 2]))


def random_tree(
    n: int,
    *,
    rng: np.random.Generator | int | None = None,
    base: Base = "fixed",
    kinds: Sequence[str] = KINDS,
    branching: float = 0.5,
) -> Model:
    """Return a random tree with n joints, to test an algorithm on every case that can occur.

    The axes are oblique and the placements arbitrary; the inertias are those of a few point masses, so they are
    physical. About half of the joints have rotors. Some links are welded on, with and without
    mass. The names are shuffled: neither links nor joints come in alphabetical order.

    Parameters
    ----------
    n : int
        Number of joints; with a floating base one of them is its own.
    rng : numpy Generator or int, optional
        Where the randomness comes from.
    base : {"fixed", "floating"}
    kinds : sequence of str
        Kinds of joint to draw from, each the `kind` of a class of joint; all that the package has, if not given.
    branching : float
        Chance that a link is carried by any of the links before it, and not by the last one:
        0 makes a chain.

    Returns
    -------
    Model

    Raises
    ------
    ModelError
        If `n` is not a whole number of at least 1, `branching` not a probability, or `kinds` empty or a string.
    NameNotFound
        If a kind is not known.

    Examples
    --------
    >>> model = random_tree(5, rng=1, kinds=["revolute", "prismatic"])
    >>> model.nv, [joint.kind for joint in model.joints[1:]]
    (5, ['prismatic', 'prismatic', 'revolute', 'revolute', 'prismatic'])
    >>> chain = random_tree(5, rng=1, branching=0.0)
    >>> chain.parent
    (-1, 0, 1, 2, 3, 4)
    """
    rng = as_generator(rng)
    _check_count(n)
    check_choice(base, "base", ("fixed", "floating"), ModelError)
    if not 0 <= as_number(branching, "branching") <= 1:
        raise ModelError(f"branching: expected a number from 0 to 1, got {branching}")
    if isinstance(kinds, str | Set) or not len(kinds := as_names(kinds, "kinds", "kinds")):
        raise ModelError(f"kinds: expected a list or tuple of kinds, since the seed needs an order, got {kinds!r}")
    for kind in kinds:
        check_known("kind of joint", kind, Joint.kinds)
    links, joints = ([f"{what}_{k}" for k in rng.permutation(n)] for what in ("link", "joint"))
    floats = base == "floating"
    root = links[0] if floats else "base_link"
    builder = Builder("random tree", base=base, root=root, root_inertia=_random_inertia(rng) if floats else None)
    added = [root]
    for k in range(1 if floats else 0, n):
        if rng.random() < 0.3:  # weld a link on; later links may be carried by it
            inertia = _random_inertia(rng) if rng.random() < 0.5 else None
            builder.link(
                f"welded_{k}", parent=_carrier(rng, added, branching), placement=_random_placement(rng), inertia=inertia
            )
            added.append(f"welded_{k}")
        joint = Joint.kinds[kinds[int(rng.integers(len(kinds)))]].sample(rng)
        builder.link(
            links[k],
            parent=_carrier(rng, added, branching),
            joint=joint,
            joint_name=joints[k],
            placement=_random_placement(rng),
            inertia=_random_inertia(rng),
            armature=rng.random(joint.nv) * 0.2 if rng.random() < 0.5 else 0.0,
        )
        added.append(links[k])
    return builder.build()


def _carrier(rng: np.random.Generator, added: list[str], branching: float) -> str:
    return added[rng.integers(len(added))] if rng.random() < branching else added[-1]


def _random_placement(rng: np.random.Generator) -> SE3:
    return SE3(quaternion_to_rotation(rng.standard_normal(4)), rng.uniform(-0.5, 0.5, 3))


def _random_inertia(rng: np.random.Generator) -> SpatialInertia:
    """Return the inertia of six random point masses, which is always physical."""
    masses: Array = rng.uniform(0.1, 0.5, 6)
    points: Array = rng.uniform(-0.3, 0.3, (6, 3))
    com = masses @ points / masses.sum()
    r = points - com
    squares = (masses[:, None] * r).mT @ r
    return SpatialInertia(masses.sum(), com, np.eye(3) * squares.trace() - squares)

"""How many digits an answer keeps, known before it is asked for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .arrays import Array, resolution
from .fast import crba
from .model import Model, floats_of

__all__ = ["Accuracy", "accuracy"]

SUMMED, DIVIDED = 24, 4
"""So many times the bare formulas, of inverse and of forward dynamics. Less would do for the textbook; with these the
errors of `twistwrench.fast` are below as well, in ``twistwrench study extremes`` and in random trees."""

SHARE = 0.05
"""A joint with less of a motion's energy than this is not named."""

NAMED = 4
"""So many joints are named in print."""

PLENTY = 1e-3
"""Where a motion feels more than this part of the inertia of its joints, there is nothing to be said about it."""


@dataclass(frozen=True)
class Accuracy:
    """The relative errors that rounding may leave, estimated: what `accuracy` returns.

    Attributes
    ----------
    rnea : ndarray, shape (...)
        Of τ, each entry measured against the terms that it sums: over the bodies behind the joint, lever times force.
    aba, crba_solve : ndarray, shape (...)
        Of q̈, each entry weighed by √M_kk, measured against the largest of q̈, of q̈ without torques, and of their
        difference. Infinite where nothing is certain.
    felt : ndarray, shape (...)
        Inertia of the motion that feels least, as a part of what its joints feel one by one with the others locked.
    weak : tuple of str
        The joints of that motion, the most moved first; in a batch that of its worst state.
    resolution : float
        Of the number type that was asked about: 2.2e-16 in float64.
    """

    rnea: Array
    aba: Array
    crba_solve: Array
    felt: Array
    weak: tuple[str, ...]
    resolution: float

    @property
    def digits(self) -> dict[str, Array]:
        """Decimal digits that are certain, by algorithm; 0 where none is."""
        errors = {"rnea": self.rnea, "aba": self.aba, "crba_solve": self.crba_solve}
        return {name: np.maximum(-np.log10(np.minimum(error, 1.0)), 0.0) for name, error in errors.items()}

    def __str__(self) -> str:
        """Say it in words; of a batch, of its worst state."""
        whole = int(-np.log10(self.resolution) + 0.5)
        sure = {name: f"{int(digits.min(initial=whole)) or 'none'}" for name, digits in self.digits.items()}
        said = f"rnea keeps {sure['rnea']} of {whole} digits, aba {sure['aba']}, crba + solve {sure['crba_solve']}."
        felt = float(self.felt.min(initial=1))
        if felt > PLENTY:
            return said
        if len(self.weak) == 1:
            return (
                f"{said}\nA motion of {self.weak[0]!r} feels {felt:.1e} of the inertia that its parts feel one by one."
            )
        more = len(self.weak) - NAMED
        names = ", ".join(map(repr, self.weak[:NAMED])) + (f" and {more} more" if more > 0 else "")
        return f"{said}\nMoved against each other, {names} feel {felt:.1e} of the inertia that they feel one by one."


def accuracy(model: Model, q: ArrayLike) -> Accuracy:
    """Estimate what rounding will take from `rnea`, from `aba` and from solving with `crba`, whatever v and τ are.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
        In the number type in which the algorithms are going to work.

    Returns
    -------
    Accuracy
        Relative errors and the digits that are left. Print it for a sentence.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Inverse dynamics only adds: its error grows with the root of the number of joints on the longest way to a tip.
    Forward dynamics divides by M, and what counts is the least eigenvalue λ of D^-½ M D^-½, where D is M's diagonal:
    about the resolution over λ is lost, besides the error of the bias forces. The condition number of M itself
    misleads: it is large already where units or masses differ, which costs nothing. For the worst torques `aba` loses
    as much as a solver does.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> print(tw.accuracy(model, model.standing()))
    rnea keeps 13 of 16 digits, aba 13, crba + solve 13.
    >>> model = tw.chain(6, mass_ratio=1e6)
    >>> print(tw.accuracy(model, np.full(6, 0.1)))
    rnea keeps 13 of 16 digits, aba 8, crba + solve 8.
    Moved against each other, 'rod_02', 'rod_03', 'rod_01' feel ... of the inertia that they feel one by one.
    """
    (q,) = floats_of(model, q)
    eps, depth = resolution(q.dtype), max([1, *(len(model.support(i)) for i in range(model.nbodies))])
    felt, motion = _least_felt(model, model.normalize(q.real.astype(np.float64)))
    certain = felt - model.nv * resolution(np.float64)  # as far as the eigenvalue itself is
    sums = np.full(felt.shape, SUMMED * eps * np.sqrt(depth))
    forward = sums + np.where(certain > 0, DIVIDED * eps / np.where(certain > 0, certain, 1), np.inf)
    return Accuracy(sums, forward, forward.copy(), felt, _most_moved(model, felt, motion), eps)


def _least_felt(model: Model, q: Array) -> tuple[Array, Array]:
    """Return the least eigenvalue of M scaled to a diagonal of ones, and its eigenvector: which motion that is."""
    M = crba(model, q)
    own = np.diagonal(M, axis1=-2, axis2=-1)
    unit = np.sqrt(np.where(own > 0, own, 1))  # what moves nothing keeps its zero
    values, vectors = np.linalg.eigh(M / unit[..., :, None] / unit[..., None, :])
    return np.maximum(values.min(axis=-1, initial=1), 0), vectors[..., :1].sum(axis=-1)


def _most_moved(model: Model, felt: Array, motion: Array) -> tuple[str, ...]:
    """Return the names of the joints that take part in a motion, of the state where it feels least."""
    worst = motion.reshape(felt.size, model.nv)[np.argmin(felt)] if felt.size else np.zeros(model.nv)
    shares = [float((worst[s] ** 2).sum()) for s in model.v_slice]
    order = np.argsort(shares)[::-1]
    return tuple(model.joint_names[i] for i in order if shares[i] > SHARE)

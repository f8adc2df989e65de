"""How many digits the dynamics keep at a configuration, estimated before they are computed."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import ArrayLike

from .algorithms._mimic import also_of_mimics
from .arrays import Array, resolution
from .model import Model, composite_inertias, floats_of, tree_terms

__all__ = ["Accuracy", "accuracy"]

SUMMED, DIVIDED = 24, 4
"""Safety factors on the bare formulas, of inverse and of forward dynamics. Less would do for the textbook; with these
the errors of `twistwrench.fast` stay below too, in ``python -m benchmarks.study extremes`` and in random trees."""

SHARE = 0.05
"""A joint with a smaller share of a motion's energy than this is not named."""

NAMED = 4
"""How many joints are named in print."""

PLENTY = 1e-3
"""A motion with more than this part of the apparent inertia of its joints is not worth a warning."""


@dataclass(frozen=True)
class Accuracy:
    """The relative errors that rounding may leave, estimated: what `accuracy` returns.

    Attributes
    ----------
    rnea : ndarray, shape (...)
        Of τ, each entry measured against the terms that it sums: over the outboard bodies, lever times force.
    aba, crba_solve : ndarray, shape (...)
        Of q̈, each entry weighed by √M_kk, measured against the largest of q̈, of q̈ without torques, and of their
        difference. Infinite where nothing is certain.
    apparent_inertia : ndarray, shape (...)
        Of the motion with the least, as a part of the apparent inertia of its joints one by one, the others locked.
    weak : tuple of str
        The joints of that motion, the most moved first; in a batch that of its worst state.
    resolution : float
        Of the number type that was asked about: 2.2e-16 in float64.
    """

    rnea: Array
    aba: Array
    crba_solve: Array
    apparent_inertia: Array
    weak: tuple[str, ...]
    resolution: float

    @property
    def felt(self) -> Array:
        """The older name of `apparent_inertia`."""
        return self.apparent_inertia

    @property
    def digits(self) -> dict[str, Array]:
        """Decimal digits that are certain, by algorithm; 0 where no digit is."""
        errors = {"rnea": self.rnea, "aba": self.aba, "crba_solve": self.crba_solve}
        return {name: np.maximum(-np.log10(np.minimum(error, 1.0)), 0.0) for name, error in errors.items()}

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"

    def __str__(self) -> str:
        """Return the estimate in words; of a batch, that of its worst state."""
        whole = int(-np.log10(self.resolution) + 0.5)
        sure = {name: f"{int(digits.min(initial=whole)) or 'none'}" for name, digits in self.digits.items()}
        kept = f"rnea keeps {sure['rnea']} of {whole} digits, aba {sure['aba']}, crba + solve {sure['crba_solve']}."
        least = float(self.apparent_inertia.min(initial=1))
        if least > PLENTY:
            return kept
        if len(self.weak) == 1:
            return (
                f"{kept}\nA motion of {self.weak[0]!r} has {least:.1e} of the apparent inertia of its parts one by one."
            )
        more = len(self.weak) - NAMED
        names = ", ".join(map(repr, self.weak[:NAMED])) + (f" and {more} more" if more > 0 else "")
        return f"{kept}\nMoved against each other, {names} have {least:.1e} of their apparent inertias one by one."


def accuracy(model: Model, q: ArrayLike) -> Accuracy:
    """Estimate the rounding errors of `rnea`, of `aba` and of solving with M from `crba`, for any v and τ.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
        The configuration, in the number type of the computation.

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
    Inverse dynamics only adds. Its error grows with the square root of the number of joints from the base to the
    farthest tip. Forward dynamics divides by M. Its error is about the resolution of the number type divided by λ, the
    least eigenvalue of D^-½ M D^-½ with the diagonal D of M, plus the error of the bias forces. The condition number of
    M itself is misleading: different units or masses make it large, but they do not cause errors. For the worst
    torques, `aba` loses as many digits as a solver.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> print(tw.accuracy(model, model.standing()))
    rnea keeps 13 of 16 digits, aba 13, crba + solve 13.
    >>> model = tw.chain(6, mass_ratio=1e6)
    >>> print(tw.accuracy(model, np.full(6, 0.1)))
    rnea keeps 13 of 16 digits, aba 8, crba + solve 8.
    Moved against each other, 'rod_02', 'rod_03', 'rod_01' have ... of their apparent inertias one by one.
    """
    (q,) = floats_of(model, q)
    eps, depth = resolution(q.dtype), max([1, *(len(model.support(i)) for i in range(model.nbodies))])
    least, motion = _least_inertia(model, model.normalize(q.real.astype(np.float64)))
    certain = least - model.nv * resolution(np.float64)  # as certain as the eigenvalue itself is
    sums = np.full(least.shape, SUMMED * eps * np.sqrt(depth))
    forward = sums + np.where(certain > 0, DIVIDED * eps / np.where(certain > 0, certain, 1), np.inf)
    return Accuracy(sums, forward, forward.copy(), least, _most_moved(model, least, motion), eps)


@also_of_mimics
def _mass_matrix(model: Model, q: Array) -> Array:
    """Return M.

    `crba` keeps the chapter's loop, which takes the wrench of one joint after the other inward. Here the wrenches of
    all outboard joints go inward in one product: on a chain of 1000 links that is 25 times as fast.
    """
    tree = tree_terms(model, q)
    IC, M = composite_inertias(tree), np.zeros((*tree.batch, model.nv, model.nv))
    F = [np.zeros((*tree.batch, 6, model.nv))] * model.nbodies  # a column for each joint, in frame i
    for i in tree.inward:
        p, own, Fi = tree.parent[i], model.v_slice[i], F[i].copy()
        Fi[..., own] = IC[i] @ tree.S[i]
        M[..., own, :] = tree.S[i].mT @ Fi  # of joint i and of those outboard, whose numbers are higher
        M[..., own, own] += tree.rotor[i]
        F[p] = F[p] + tree.X[i].mT @ Fi
    return np.triu(M) + np.triu(M, 1).mT


def _least_inertia(model: Model, q: Array) -> tuple[Array, Array]:
    """Return the least eigenvalue of M scaled to a diagonal of ones, and its eigenvector, the motion that has it."""
    M = _mass_matrix(model, q)
    own = np.diagonal(M, axis1=-2, axis2=-1)
    unit = np.sqrt(np.where(own > 0, own, 1))  # a motion without inertia keeps its zero
    values, vectors = np.linalg.eigh(M / unit[..., :, None] / unit[..., None, :])
    return np.maximum(values.min(axis=-1, initial=1), 0), vectors[..., :1].sum(axis=-1)


def _most_moved(model: Model, least: Array, motion: Array) -> tuple[str, ...]:
    """Return the names of the joints that take part in a motion, of the state with the least apparent inertia."""
    worst = motion.reshape(least.size, model.nv)[np.argmin(least)] if least.size else np.zeros(model.nv)
    shares = [float((worst[s] ** 2).sum()) for s in model.v_slice]
    order = np.argsort(shares)[::-1]
    return tuple(model.joint_names[i] for i in order if shares[i] > SHARE)

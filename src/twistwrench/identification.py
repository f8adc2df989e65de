"""The combinations of inertial parameters that a motion can tell: the base parameters, for identification (49.5, 49.6).

τ = Y π is linear in the ten numbers π of each body, but not all of them affect τ. Some columns of Y are zero or
combinations of others, whatever the motion: the mass of a link on a hinge acts as if a point of its parent had it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Array
from .fast.derivatives import regressor
from .model import Model, check_model, readonly

__all__ = ["BaseParameters", "base_parameters"]

TEN = ("m", "mx", "my", "mz", "Ixx", "Ixy", "Iyy", "Ixz", "Iyz", "Izz")
"""The entries of `SpatialInertia.parameters`."""

STATES = 64
"""Random motions; each has a row of Y for each entry of v."""

INDEPENDENT = 1e-9
"""A column of Y is another parameter if this part of it, or more, is no combination of the columns before it."""

MAX_TERMS = 6
"""How many terms of a combination are printed."""


@dataclass(frozen=True, eq=False)
class BaseParameters:
    """Base parameters β of a robot, from `base_parameters`: β = combinations @ π with τ = Y[..., independent] @ β.

    Attributes
    ----------
    independent : ndarray of int, shape (b,)
        Columns of Y that are kept. Of dependent ones the first stays, that of the body nearer to the base.
    combinations : ndarray, shape (b, 10 (nbodies − 1))
        How each base parameter is made of the ten numbers of each body, `SpatialInertia.parameters`.
    share : ndarray, shape (b,)
        The part of a kept column that no column before it has; where it is small, only rare motions tell the two apart.
    names : tuple of str
        Of all columns: ``"Izz of elbow"``.
    """

    independent: Array
    combinations: Array
    share: Array
    names: tuple[str, ...]

    def __str__(self) -> str:
        """Return each base parameter as a sum, in a line."""
        lines = [f"{len(self.independent)} base parameters of {len(self.names)} numbers:"]
        for row in self.combinations:
            terms = [_term(float(x), name) for x, name in zip(row, self.names) if x]
            more = f" and {len(terms) - MAX_TERMS} more" if len(terms) > MAX_TERMS else ""
            lines.append("".join(terms[:MAX_TERMS]).removeprefix(" + ") + more)
        return "\n".join(lines)


def _term(factor: float, name: str) -> str:
    """Return a term of a sum with its sign, without a factor of one."""
    size = f"{abs(factor):.4g}"
    return f" {'-' if factor < 0 else '+'} " + ("" if size == "1" else f"{size} ") + name


def base_parameters(model: Model) -> BaseParameters:
    """Return the combinations of the bodies' inertial parameters that the joint forces depend on.

    Only these can be identified from measured torques; the inertias of the model do not matter, its geometry does.

    Parameters
    ----------
    model : Model

    Returns
    -------
    BaseParameters
        The kept columns of Y, and the combinations. Print it for the sums.

    Raises
    ------
    TypeError
        If `model` is not a Model.

    Notes
    -----
    The columns of the regressor Y of 64 random motions, without regard to limits, are made orthogonal one after the
    other; one of which no part is left is a combination of those before it. Gautier (1991) and Khalil and Dombre,
    chapter 9, do this by QR. Rotors and friction are not among the parameters.

    Examples
    --------
    Two hinges in a vertical plane, 0.6 m apart, tell six numbers of twenty:

    >>> import twistwrench as tw
    >>> print(base_parameters(tw.load("double_pendulum")))
    6 base parameters of 20 numbers:
    mx of shoulder
    mz of shoulder - 0.6 m of elbow
    Iyy of shoulder + 0.36 m of elbow
    mx of elbow
    mz of elbow
    Iyy of elbow
    """
    check_model(model)
    rng = np.random.default_rng(0)
    turns = rng.standard_normal((STATES, model.nv))
    v, a = rng.standard_normal((2, STATES, model.nv))
    Y = regressor(model, model.integrate(model.neutral(), turns), v, a)
    names = tuple(f"{one} of {joint}" for joint in model.joint_names[1:] for one in TEN)
    Y = Y.reshape(STATES * model.nv, len(names))
    lengths = np.linalg.norm(Y, axis=0)
    columns = Y / np.where(_felt(model, lengths), lengths, np.inf)
    basis, kept, share = np.zeros((len(Y), 0)), [], []
    for k, column in enumerate(columns.mT):
        left = column - basis @ (basis.mT @ column)
        left = left - basis @ (basis.mT @ left)  # twice: what rounding has left of the others
        part = np.linalg.norm(left)
        if part > INDEPENDENT:
            kept.append(k)
            share.append(part)
            basis = np.concatenate([basis, left[:, None] / part], axis=1)
    scaled = np.linalg.lstsq(columns[:, kept], columns, rcond=None)[0]
    scaled = np.where(np.abs(scaled) > INDEPENDENT, scaled, 0)
    scaled[:, kept] = np.eye(len(kept))
    combinations = scaled * lengths / lengths[kept][:, None]
    return BaseParameters(readonly(np.array(kept, int)), readonly(combinations), readonly(np.array(share)), names)


def _felt(model: Model, lengths: Array) -> Array:
    """Return whether a column of Y is more than rounding of the terms that it is made of.

    These are as large as the largest column of a mass, of a moment of mass, or of an inertia; of a moment also as g.
    """
    kinds = np.split(lengths.reshape(-1, len(TEN)), [1, 4], axis=1)
    sizes = [np.broadcast_to(kind.max(initial=0), kind.shape) for kind in kinds]
    sizes[1] = np.maximum(sizes[1], np.linalg.norm(model.gravity))
    return lengths > INDEPENDENT * np.concatenate(sizes, axis=1).ravel()

"""What a whole-body controller needs, in one call: the chapter's getDynamics (49.11 and the project)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from html import escape

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_names
from ..errors import check_known
from ..model import Model, check_state
from ..tables import html_matrix
from ._mimic import also_of_mimics
from .centroidal import centroidal_map
from .crba import crba
from .floating_base import HeldRows, as_frames, contact_jacobian
from .rnea import nonlinear_effects

__all__ = ["QUANTITIES", "Dynamics", "dynamics", "select_quantities"]

QUANTITIES = ("M", "h", "J_c", "A_G")


@dataclass(frozen=True, repr=False)
class Dynamics:
    """M, h, J_c and A_G of a robot, from `dynamics`; quantities that were not wanted are None.

    Attributes
    ----------
    M : ndarray, shape (..., nv, nv)
        Mass matrix.
    h : ndarray, shape (..., nv)
        Coriolis, centrifugal and gravity forces.
    J_c : ndarray, shape (..., 3 k, nv)
        Contact Jacobian, of frames the linear rows in the axes of the world; k = 0 where a robot has no contacts.
    A_G : ndarray, shape (..., 6, nv)
        Centroidal momentum matrix, rows (angular, linear).
    """

    M: Array | None = None
    h: Array | None = None
    J_c: Array | None = None
    A_G: Array | None = None

    def __repr__(self) -> str:
        shapes = {f.name: np.shape(x) for f in fields(self) if (x := getattr(self, f.name)) is not None}
        return f"Dynamics({', '.join(f'{name}: {shape}' for name, shape in shapes.items())})"

    def _repr_html_(self) -> str:
        drawn = {name: x for name in ("M", "J_c", "A_G") if np.ndim(x := getattr(self, name)) == 2}
        shown = (html_matrix(x.real.astype(float), name) for name, x in drawn.items())
        pictures = (f'<td style="vertical-align: top">{picture}</td>' for picture in shown)
        return f"<code>{escape(repr(self))}</code><table><tr>{''.join(pictures)}</tr></table>"


@also_of_mimics
def dynamics(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    *,
    contacts: Iterable[str | HeldRows] | None = None,
    want: Iterable[str] = QUANTITIES,
) -> Dynamics:
    """Return what a whole-body controller needs: M, h, J_c and A_G (the chapter's getDynamics).

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
    contacts : iterable of str or Contact, optional
        The frames of point contacts, or contacts of any kind; `model.feet` unless given.
    want : iterable of {"M", "h", "J_c", "A_G"}
        The quantities to compute; all others are None.

    Returns
    -------
    Dynamics

    Raises
    ------
    NameNotFound
        If `want` names something else, or the model has no such contact frame.
    ShapeError, ValueError
        As `Model.state`; or if `contacts` or `want` is a single string.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> d = tw.dynamics(model, model.standing(), np.zeros(model.nv), want={"M", "J_c"})
    >>> d.M.shape, d.J_c.shape, d.h
    ((18, 18), (12, 18), None)
    """
    check_state(model, q, v=v)  # also where no wanted quantity depends on v
    contacts = as_frames(model.feet if contacts is None else contacts)
    want = select_quantities(want)
    compute = {
        "M": lambda: crba(model, q),
        "h": lambda: nonlinear_effects(model, q, v),
        "J_c": lambda: contact_jacobian(model, q, contacts),
        "A_G": lambda: centroidal_map(model, q),
    }
    return Dynamics(**{name: compute[name]() for name in want})


def select_quantities(want: Iterable[str]) -> tuple[str, ...]:
    """Return which quantities are wanted; raise NameNotFound for a name that is not one of them."""
    want = as_names(want, "want", "quantities")
    for name in want:
        check_known("quantity", name, QUANTITIES)
    return want

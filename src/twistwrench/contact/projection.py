"""Projection onto the contacts: the drift of a configuration and a velocity is removed (49.9)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_count, as_number
from ..errors import SingularError
from ..fast.steps import integrate
from ..model import Model
from ..spatial import SE3
from ..spatial._elementary import at_first_index
from .decomposition import decompose
from .impacts import jump
from .relative import contact_errors
from .rows import as_contacts, contact_terms, per_contact, real_state
from .types import Contact

__all__ = ["project_state"]


def project_state(
    model: Model | MimicModel,
    q: ArrayLike,
    v: ArrayLike,
    contacts: Iterable[Contact],
    anchors: Mapping[str, SE3],
    *,
    tolerance: float = 1e-12,
    steps: int = 20,
) -> tuple[Array, Array]:
    """Return the nearby q at which the contacts are at their anchors, and the nearest v with which they stay there.

    Newton's method for q, each step the least in the metric of M; then `impact` projects v.

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
    contacts : iterable of Contact
    anchors : mapping of str to SE3
        Where the contacts' frames belong, as from `contact_placements`.
    tolerance : float, optional
        How far from its anchor a contact may stay, m; a sole's turn counts by the motion of its corners.
    steps : int, optional
        At most so many Newton steps.

    Returns
    -------
    q : ndarray, shape (..., nq)
    v : ndarray, shape (..., nv)
        In double precision.

    Raises
    ------
    SingularError
        If the contacts do not reach their anchors: out of reach, or too far away for Newton's method.
    NameNotFound, ShapeError, ValueError
        As `constraint_jacobian`; complex numbers; an anchor that is missing.

    Notes
    -----
    Section 49.9. Near a singular posture (straight knees) a target just out of reach has no solution near by, and one
    just within reach takes more steps.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> feet = [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> anchors = tw.contact_placements(model, model.standing(), feet)
    >>> drifted = model.integrate(model.standing(), np.full(model.nv, 1e-3))
    >>> q, v = tw.project_state(model, drifted, np.ones(model.nv), feet, anchors)
    >>> np.abs(tw.constraint_jacobian(model, q, feet) @ v).max() < 1e-12
    np.True_
    """
    steps = as_count(steps, "steps", 0)
    if not as_number(tolerance, "tolerance") >= 0:
        raise ValueError(f"tolerance: expected a number of at least 0, got {tolerance!r}")
    contacts = as_contacts(model, contacts)
    q, v, _ = real_state(model, q, v=v)
    for _ in range(steps + 1):
        terms = contact_terms(model, q, v, contacts)
        error = np.matvec(terms.W, contact_errors(contacts, terms.placement, anchors))
        far = np.asarray(np.abs(error).max(axis=-1, initial=0) > tolerance)
        if not far.any():
            return q, jump(model, v, contacts, terms).v
        parts = decompose(model, terms.M, terms.W @ terms.J)
        way = -parts.unwhiten(parts.respond(error)[0])
        q = model.integrate(q, way) if isinstance(model, MimicModel) else integrate(model, q, way)
    left = {frame: float(np.abs(e).max()) for frame, e in per_contact(contacts, error[far][0]).items()}
    worst = max(left, key=lambda frame: left[frame])
    raise SingularError(
        f"the contacts do not come to their anchors in {steps} steps{at_first_index(far)}: "
        f"{worst!r} is {left[worst]:.3g} m away"
    )

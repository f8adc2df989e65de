"""A motion: a whole-body trajectory with its velocities, its accelerations and its contacts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_names, as_real, as_sequence, check_kind
from ..errors import ShapeError
from ..model import Model

__all__ = ["Motion", "as_motions", "check_motion"]


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """States of a robot along a smooth motion.

    q̇ = v and v̇ = a hold to rounding: v and a come from the Jacobians of the tasks that make the motion, not from
    differences of q.

    Attributes
    ----------
    name : str
        For example ``"walk"``.
    t : ndarray, shape (n,)
        Times, s.
    q : ndarray, shape (n, nq)
    v, a : ndarray, shape (n, nv)
    feet : tuple of str
        The k frames that may touch the ground, `Model.feet`.
    contacts : ndarray of bool, shape (n, k)
        Which of them stand, at each time. What stands does not move.

    Raises
    ------
    ShapeError, ValueError, TypeError
        If an array does not have a row for each time or is not finite, the times do not grow, or a name is not a
        string.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from twistwrench import motions
    >>> trot = motions.trot(tw.load("go2"), samples=64)
    >>> trot
    <Motion 'trot': 64 states in 0.413 s, 4 feet>
    >>> trot.q.shape, trot.v.shape, trot.contacts.shape
    ((64, 19), (64, 18), (64, 4))
    """

    name: str
    t: Array
    q: Array
    v: Array
    a: Array
    feet: tuple[str, ...]
    contacts: Array

    def __post_init__(self) -> None:
        check_kind(self.name, "name", str, "a name")
        object.__setattr__(self, "feet", as_names(self.feet, "feet", "frame names", ordered=True))
        for foot in self.feet:
            check_kind(foot, "feet", str, "frame names")
        for name in ("t", "q", "v", "a"):
            object.__setattr__(self, name, as_real(getattr(self, name), name))
        try:
            contacts = np.array(self.contacts)
            n = self.t.size
        except ValueError:
            raise ShapeError("contacts: expected a rectangular array, got rows of different lengths") from None
        object.__setattr__(self, "contacts", contacts)
        if self.t.ndim != 1 or n == 0 or (np.diff(self.t) <= 0).any():
            raise ValueError(f"t: expected times that grow, shape (n,) with n of at least 1, got shape {self.t.shape}")
        if contacts.dtype != bool or contacts.shape != (n, len(self.feet)):
            got = f"{contacts.dtype} of shape {contacts.shape}"
            raise ShapeError(f"contacts: expected bools of shape {n, len(self.feet)}, one for each foot, got {got}")
        for name, x in (("q", self.q), ("v", self.v), ("a", self.a)):
            if x.ndim != 2 or len(x) != n or (name == "a" and x.shape != self.v.shape):
                raise ShapeError(f"{name}: expected a row for each of {n} times, got shape {x.shape}")

    @classmethod
    def from_states(
        cls,
        t: ArrayLike,
        q: ArrayLike,
        v: ArrayLike,
        a: ArrayLike,
        *,
        name: str = "motion",
        feet: Iterable[str] = (),
        contacts: ArrayLike | None = None,
    ) -> Motion:
        """Make a motion of what was measured, simulated or optimised.

        Parameters
        ----------
        t : array_like, shape (n,)
            Times, s.
        q : array_like, shape (n, nq)
        v, a : array_like, shape (n, nv)
        name : str
        feet : iterable of str
            The k frames that may touch the ground. Without any, what stands are the contacts of the scene.
        contacts : array_like of bool, shape (n, k), optional
            Which of them stand, at each time. Default: all, always.

        Raises
        ------
        ShapeError, ValueError, TypeError
            As above.

        Examples
        --------
        >>> t, states = np.arange(3) / 10, np.zeros((3, 2))
        >>> Motion.from_states(t, states, states, states)
        <Motion 'motion': 3 states in 0.2 s, 0 feet>
        """
        names = as_names(feet, "feet", "frame names", ordered=True)
        stand = np.ones((np.size(t), len(names)), bool) if contacts is None else np.asarray(contacts)
        return cls(name, np.asarray(t), np.asarray(q), np.asarray(v), np.asarray(a), names, stand)

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        duration = self.t[-1] - self.t[0]
        return f"<Motion {self.name!r}: {len(self)} states in {duration:.3g} s, {len(self.feet)} feet>"


def check_motion(motion: object, name: str = "motion") -> None:
    """Raise TypeError for an argument that is not a motion."""
    what = "a Motion, as motions.walk(model) or motions.Motion.from_states(t, q, v, a) makes one"
    check_kind(motion, name, Motion, what)


def as_motions(model: Model, given: Motion | Iterable[Motion], name: str) -> tuple[Motion, ...]:
    """Return motions of this robot, of one or of several."""
    some = (given,) if isinstance(given, Motion) else as_sequence(given, name, "motions", ordered=True)
    for motion in some:
        check_motion(motion, name)
        model.state(motion.q, v=motion.v, a=motion.a)  # raises where it is another robot's
    return some

"""A motion: a whole-body trajectory with its velocities, its accelerations and its contacts."""

from __future__ import annotations

from dataclasses import dataclass

from ..checks import Array

__all__ = ["Motion"]


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

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        duration = self.t[-1] - self.t[0]
        return f"<Motion {self.name!r}: {len(self)} states in {duration:.3g} s, {len(self.feet)} feet>"

"""Random states to compare at, and the frames to look at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ..arrays import Array, as_generator
from ..model import Model

__all__ = ["States", "random_states", "sample_frames"]


@dataclass(frozen=True)
class States:
    """A batch of states: every array has one leading axis. A single state has no leading axis.

    Attributes
    ----------
    q : ndarray, shape (n, nq)
        Configurations.
    v, a, tau, dv : ndarray, shape (n, nv)
        Velocities, accelerations, joint forces, and steps on the configuration manifold.
    f_ext : ndarray, shape (n, nbodies, 6)
        Wrenches from outside, zero on the world.
    frames : tuple of str
        The frames whose Jacobians are compared.
    """

    q: Array
    v: Array
    a: Array
    tau: Array
    dv: Array
    f_ext: Array
    frames: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.q)

    def __getitem__(self, i: int | Array) -> States:
        """Return one state, or those of several indices."""
        return States(**{key: array[i] for key, array in self._arrays().items()}, frames=self.frames)

    def exact(self, context: Any) -> States:
        """Return one state in the numbers of an mpmath context, where every double has an exact twin.

        Without a context in long doubles, which mostly hold 19 digits.
        """
        if context is None:
            return States(**{key: array.astype(np.longdouble) for key, array in self._arrays().items()}, frames=())
        exact = np.frompyfunc(lambda x: context.mpf(float(x)), 1, 1)
        return States(**{key: exact(array) for key, array in self._arrays().items()}, frames=self.frames)

    def _arrays(self) -> dict[str, Array]:
        return {f.name: getattr(self, f.name) for f in fields(self) if f.name != "frames"}


def random_states(model: Model, n: int, *, rng: np.random.Generator | int, frames: int = 4) -> States:
    """Draw states: q as `Model.random_configuration`, all else from normal distributions.

    Parameters
    ----------
    model : Model
    n : int
    rng : numpy Generator or int
    frames : int
        At most so many frames to look at.

    Returns
    -------
    States
        The first q is the standing one of a robot that has one. Rates of 1 rad/s and 1 m/s, accelerations,
        joint forces and wrenches of 1 in SI units, steps of 0.5 rad and 0.5 m, each times a normal number.

    Examples
    --------
    >>> from twistwrench.loading import load
    >>> random_states(load("pendulum"), 8, rng=0).f_ext.shape
    (8, 2, 6)
    """
    rng = as_generator(rng)
    f_ext = rng.standard_normal((n, model.nbodies, 6))
    f_ext[:, 0] = 0
    v, a, tau, dv = rng.standard_normal((4, n, model.nv))
    q = np.stack([model.random_configuration(rng=rng) for _ in range(n)])
    if "standing" in model.postures:
        q[0] = model.standing()
    return States(q=q, v=v, a=a, tau=tau, dv=dv / 2, f_ext=f_ext, frames=sample_frames(model, frames))


def sample_frames(model: Model, most: int) -> tuple[str, ...]:
    """Choose the frames to look at: the feet, and others at the tips of the tree.

    Of each tip the last frame in the file: it is often welded on, and its placement then counts as well.
    """
    last = {frame.body: name for name, frame in model.frames.items()}
    tips = [last[i] for i in range(1, model.nbodies) if i in last and i not in model.parent]
    feet = _spread(model.feet, most)  # the first four of eight corners are all on one leg
    others = tips or list(model.frames)  # a model from Pinocchio need not have one on every tip, or any at all
    return tuple(dict.fromkeys([*feet, *_spread(others, most)]))[:most]


def _spread(names: Sequence[str], most: int) -> Sequence[str]:
    return names[:: -(-len(names) // most) or 1]

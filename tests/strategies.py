"""Random trees and states for the tests, as recipes that hypothesis can shrink and print."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

import twistwrench as tw
from twistwrench.model import KINDS

from .sampling import DRAWN_BY

BATCHES = [(), (1,), (3, 1, 2), (0,)]
REFERENCES = ["local", "world", "local_world_aligned"]


def examples(count: int, every: int | None = None) -> settings:
    """Try so many examples, or `every` one where TWISTWRENCH_DRAW=all; by TWISTWRENCH_EXAMPLES=20 20 times as many."""
    if every and os.environ.get(DRAWN_BY) == "all":
        count = every
    return settings(max_examples=count * int(os.environ.get("TWISTWRENCH_EXAMPLES", "1")))


class State(NamedTuple):
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    tau: np.ndarray
    f_ext: np.ndarray


@dataclass(frozen=True)
class Recipe:
    """What a random tree is made of. Two equal recipes give the same model and the same states."""

    n: int
    seed: int = 0
    base: str = "fixed"
    kinds: tuple[str, ...] = KINDS
    branching: float = 0.5

    @property
    def model(self) -> tw.Model:
        return _model(self)

    def state(self, batch=(), dtype=np.float64) -> State:
        return random_state(self.model, rng=self.seed, batch=batch, dtype=dtype)

    def frame(self) -> str:
        """One of the frames, drawn once and for all."""
        names = self.model.frame_names
        return names[int(np.random.default_rng(self.seed).integers(len(names)))]


@lru_cache(maxsize=64)
def _model(recipe: Recipe) -> tw.Model:
    return tw.random_tree(recipe.n, rng=recipe.seed, base=recipe.base, kinds=recipe.kinds, branching=recipe.branching)


def recipes(max_bodies: int = 40, *, bases=("fixed", "floating"), kinds=KINDS):
    """Recipes of trees with 1 to `max_bodies` bodies; the simplest is one revolute joint."""
    return st.builds(
        Recipe,
        n=st.integers(1, max_bodies),
        seed=st.integers(0, 2**32 - 1),
        base=st.sampled_from(bases),
        kinds=st.sampled_from([kinds[:1], kinds, *[(kind,) for kind in kinds[1:]]]),
        branching=st.sampled_from([0.5, 0.0, 1.0]),
    )


def random_state(model: tw.Model, *, rng, batch=(), dtype=np.float64) -> State:
    """A state with entries of order 1 in a number type, the wrench on the world zero.

    Long double numbers are filled to their last bit. In complex numbers the entries have imaginary parts of about
    0.1; those of q 0.01, so that the real parts of the inertias stay positive, and those of quaternions and
    (cos, sin) 1e-20, as in a complex step.
    """
    rng = np.random.default_rng(rng)
    dtype = np.dtype(dtype)
    real = np.zeros((), dtype).real.dtype
    shape = (*batch, model.nq)
    q = np.stack([model.random_configuration(rng=rng) for _ in range(int(np.prod(batch)))] or [np.zeros(model.nq)])
    q = q[: int(np.prod(batch))].reshape(shape).astype(real)
    others = [(*batch, model.nv)] * 3 + [(*batch, model.nbodies, 6)]
    arrays = [q, *(rng.standard_normal(s).astype(real) for s in others)]
    if real.itemsize > 8:
        arrays = [x + 1e-17 * rng.standard_normal(x.shape).astype(real) for x in arrays]
    arrays[0] = model.normalize(arrays[0])
    if dtype.kind == "c":
        sizes = (0.01j, 0.1j, 0.1j, 0.1j, 0.1j)
        arrays = [x + i * rng.standard_normal(x.shape).astype(real) for x, i in zip(arrays, sizes, strict=True)]
        for joint, s in zip(model.joints, model.q_slice):
            if joint is not None and joint.unit is not None:
                unit = slice(s.start + joint.unit.start, s.start + joint.unit.stop)
                arrays[0].imag[..., unit] *= 1e-18
    q, v, a, tau, f_ext = (x.astype(dtype, copy=False) for x in arrays)
    f_ext[..., 0, :] = 0
    return State(q, v, a, tau, f_ext)

"""Curves with their first two derivatives.

A jet is an array with a first axis of three: value, rate, rate of the rate. All curves are three times differentiable
and take complex times, so that a complex step differentiates what is made of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike

from ..arrays import Array

__all__ = ["Harmonics", "PiecewiseCurve", "connect", "hop", "stair"]

SMOOTH_STEP = Polynomial([0, 0, 0, 0, 35, -84, 70, -20])
"""From 0 to 1 within the unit of time, with three derivatives zero at both ends."""
BUMP = 256 * Polynomial([0, 0, 0, 0, 1]) * Polynomial([1, -1]) ** 4
"""From 0 to 1 and back within the unit of time, with three derivatives zero at both ends."""


def stair(s: Array, rate: float) -> Array:
    """Return the jet of the smooth step at s = rate t + const, 0 before and 1 after, shape (3, ...)."""
    return _unit_jet(SMOOTH_STEP, s, rate)


def hop(s: Array, rate: float) -> Array:
    """Return the jet of the bump at s = rate t + const, 0 before and after, shape (3, ...)."""
    return _unit_jet(BUMP, s, rate)


def _unit_jet(p: Polynomial, s: Array, rate: float) -> Array:
    inside = np.where(s.real <= 0, 0, np.where(s.real >= 1, 1, s))
    return np.stack([p(inside), rate * p.deriv()(inside), rate**2 * p.deriv(2)(inside)])


def connect(
    start: Sequence[float], end: Sequence[float], interval: tuple[float, float], area: float | None = None
) -> Polynomial:
    """Return the polynomial that has given derivatives at both ends of an interval, and a given integral over it.

    Parameters
    ----------
    start, end : sequence of float
        Value, first derivative and so on.
    interval : (float, float)
        Where it begins and ends.
    area : float, optional
        Its integral over the interval, if that matters.
    """
    duration = interval[1] - interval[0]
    degree = len(start) + len(end) + (area is not None)
    basis = [Polynomial.basis(k) for k in range(degree)]  # in the unit of time: well conditioned
    rows = [[p.deriv(k)(at) for p in basis] for at, given in ((0.0, start), (1.0, end)) for k in range(len(given))]
    values = [x * duration**k for given in (start, end) for k, x in enumerate(given)]
    if area is not None:
        rows.append([p.integ()(1.0) for p in basis])
        values.append(area / duration)
    return Polynomial(np.linalg.solve(np.array(rows), np.array(values)), domain=interval, window=(0, 1))


class PiecewiseCurve:
    """A curve in pieces, each given by a polynomial for every coordinate.

    Parameters
    ----------
    breaks : array_like, shape (n + 1,)
        Where the pieces begin, and where the last one ends, s.
    pieces : sequence of sequences of polynomials, n times dim
        Of `numpy.polynomial`, in absolute time.
    """

    def __init__(self, breaks: ArrayLike, pieces: Sequence[Sequence[Any]]) -> None:
        self.breaks = np.asarray(breaks)
        self.pieces = pieces

    def __call__(self, t: Array) -> Array:
        """Return the jet at times t, shape (3, n, dim)."""
        at = np.clip(np.searchsorted(self.breaks, t.real, side="right") - 1, 0, len(self.pieces) - 1)
        out = np.zeros((3, len(t), len(self.pieces[0])), t.dtype)
        for k, piece in enumerate(self.pieces):
            here = at == k
            for dim, p in enumerate(piece):
                out[:, here, dim] = p(t[here]), p.deriv()(t[here]), p.deriv(2)(t[here])
        return out


class Harmonics:
    """A steady drift and a periodic part: x(t) = mean + drift t + Re Σ c_n exp(i n ω t), written in real terms.

    Parameters
    ----------
    drift : ndarray, shape (dim,)
    samples : ndarray, shape (n, dim)
        The periodic part over one period, evenly spaced.
    period : float
        s.
    gain : sequence of float
        Of each harmonic that is kept, from the mean upwards.
    """

    def __init__(self, drift: Array, samples: Array, period: float, gain: Array) -> None:
        spectrum = np.fft.rfft(samples, axis=0)[: len(gain)] * gain[:, None] * 2 / len(samples)
        spectrum[0] /= 2
        self.drift = drift
        self.cosines = spectrum.real
        self.sines = -spectrum.imag
        self.rates = 2 * np.pi / period * np.arange(len(gain))

    def __call__(self, t: Array) -> Array:
        """Return the jet at times t, shape (3, n, dim)."""
        w = self.rates
        c, s = np.cos(t[:, None] * w), np.sin(t[:, None] * w)
        value = c @ self.cosines + s @ self.sines + t[:, None] * self.drift
        rate = (c * w) @ self.sines - (s * w) @ self.cosines + self.drift
        return np.stack([value, rate, -(c * w**2) @ self.cosines - (s * w**2) @ self.sines])

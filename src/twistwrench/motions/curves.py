"""Curves that know their first two derivatives.

A jet is an array with a first axis of three: value, rate, rate of the rate. All curves are three times differentiable
and take complex times, so that a complex step differentiates what is made of them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..checks import Array

__all__ = ["Harmonics", "Polynomials", "between", "hop", "stair"]

SMOOTH_STEP = np.polynomial.Polynomial([0, 0, 0, 0, 35, -84, 70, -20])
"""From 0 to 1 within the unit of time, with three derivatives zero at both ends."""
BUMP = 256 * np.polynomial.Polynomial([0, 0, 0, 0, 1]) * np.polynomial.Polynomial([1, -1]) ** 4
"""From 0 to 1 and back within the unit of time, with three derivatives zero at both ends."""


def stair(s: Array, rate: float) -> Array:
    """Return the jet of the smooth step at s = rate t + const, 0 before and 1 behind, shape (3, ...)."""
    return _unit_jet(SMOOTH_STEP, s, rate)


def hop(s: Array, rate: float) -> Array:
    """Return the jet of the bump at s = rate t + const, 0 before and behind, shape (3, ...)."""
    return _unit_jet(BUMP, s, rate)


def _unit_jet(p: np.polynomial.Polynomial, s: Array, rate: float) -> Array:
    inside = np.where(s.real <= 0, 0, np.where(s.real >= 1, 1, s))
    return np.stack([p(inside), rate * p.deriv()(inside), rate**2 * p.deriv(2)(inside)])


def between(start: Sequence[float], end: Sequence[float], duration: float, area: float | None = None) -> Array:
    """Return the polynomial that has given derivatives at both ends of an interval, and a given integral.

    Parameters
    ----------
    start, end : sequence of float
        Value, first derivative and so on, at 0 and at `duration`.
    duration : float
    area : float, optional
        Its integral over the interval, if that matters.

    Returns
    -------
    ndarray
        Coefficients, the lowest first.
    """
    rows, values = [], [*start, *end]
    degree = len(values) + (area is not None)
    powers = np.polynomial.Polynomial
    basis = [powers.basis(k) for k in range(degree)]
    for at, given in ((0.0, start), (1.0, end)):  # in the unit of time: well conditioned
        rows += [[p.deriv(k)(at) if k else p(at) for p in basis] for k in range(len(given))]
    values = [x * duration**k for given in (start, end) for k, x in enumerate(given)]
    if area is not None:
        rows.append([p.integ()(1.0) for p in basis])
        values.append(area / duration)
    scaled = np.linalg.solve(np.array(rows), np.array(values))
    return np.asarray(scaled / duration ** np.arange(degree))


class Polynomials:
    """A curve in pieces, each a polynomial in the time since the piece began.

    Parameters
    ----------
    breaks : sequence of float, length n + 1
        Where the pieces begin, and where the last one ends, s.
    pieces : sequence of ndarray, shape (degree + 1, dim), length n
        Coefficients, the lowest first.
    """

    def __init__(self, breaks: Sequence[float], pieces: Sequence[Array]) -> None:
        self.breaks, self.pieces = np.asarray(breaks), list(pieces)

    def __call__(self, t: Array) -> Array:
        """Return the jet at times t, shape (3, n, dim)."""
        piece = np.clip(np.searchsorted(self.breaks, t.real, side="right") - 1, 0, len(self.pieces) - 1)
        out = np.zeros((3, len(t), self.pieces[0].shape[1]), t.dtype)
        for k, coefficients in enumerate(self.pieces):
            here = piece == k
            since = t[here] - self.breaks[k]
            for order in range(3):
                derivative = np.polynomial.polynomial.polyder(coefficients, order)
                out[order, here] = np.polynomial.polynomial.polyval(since, derivative).mT
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
        self.drift, self.cosines, self.sines = drift, spectrum.real, -spectrum.imag
        self.rates = 2 * np.pi / period * np.arange(len(gain))

    def __call__(self, t: Array) -> Array:
        """Return the jet at times t, shape (3, n, dim)."""
        w = self.rates
        c, s = np.cos(t[:, None] * w), np.sin(t[:, None] * w)
        value = c @ self.cosines + s @ self.sines + t[:, None] * self.drift
        rate = (c * w) @ self.sines - (s * w) @ self.cosines + self.drift
        return np.stack([value, rate, -(c * w**2) @ self.cosines - (s * w**2) @ self.sines])

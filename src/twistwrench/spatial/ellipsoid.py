"""A spatial inertia as a small picture: the uniform ellipsoid that moves as the body does, along three axes (49.5)."""

from __future__ import annotations

import numpy as np

from ..arrays import Array

__all__ = ["views"]

VIEW_PX = 110
"""Width of a view, pixels."""


def views(mass: Array, com: Array, inertia_at_com: Array) -> str:
    """Return the ellipsoid as SVG, seen along z, y and x; the cross is the origin of the frame.

    Parameters
    ----------
    mass : ndarray, shape ()
        kg, above zero.
    com : ndarray, shape (3,)
        m.
    inertia_at_com : ndarray, shape (3, 3)
        kg m².

    Returns
    -------
    str
    """
    second = np.trace(inertia_at_com) / 2 * np.eye(3) - inertia_at_com  # ∫ρ r rᵀ, from which Σ of the ellipsoid
    shape = (5 / mass * second).astype(float)  # the squares of its semi-axes are the eigenvalues
    reach = 1.1 * float(np.abs(com).max() + np.sqrt(np.abs(shape.diagonal()).max())) or 1.0
    scale = VIEW_PX / 2 / reach
    return "".join(_view(scale * com.astype(float), scale**2 * shape, *plane) for plane in ((0, 1), (0, 2), (1, 2)))


def _view(com: Array, shape: Array, i: int, j: int) -> str:
    """Return the shadow of the ellipsoid on the plane of two axes."""
    squares, axes = np.linalg.eigh(shape[np.ix_((i, j), (i, j))])
    b, a = np.sqrt(np.maximum(squares, 0))
    angle = -np.degrees(np.arctan2(axes[1, 1], axes[0, 1]))  # the picture's y points down
    x = com[i]
    y = -com[j]
    half = VIEW_PX / 2
    return (
        f'<svg width="{VIEW_PX}" height="{VIEW_PX + 14}" viewBox="{-half} {-half} {VIEW_PX} {VIEW_PX + 14}" role="img">'
        f"<title>{'xyz'[i]} to the right, {'xyz'[j]} up</title>"
        f'<ellipse rx="{max(a, 1):.1f}" ry="{max(b, 1):.1f}" fill="#56B4E9" fill-opacity="0.6" stroke="#0072B2" '
        f'transform="translate({x:.1f} {y:.1f}) rotate({angle:.1f})"/>'
        f'<path d="M-4 0H4M0 -4V4" stroke="currentColor"/><circle cx="{x:.1f}" cy="{y:.1f}" r="2" fill="#CC79A7"/>'
        f'<text x="0" y="{half + 11}" font-size="11" text-anchor="middle" fill="currentColor">'
        f"{'xyz'[i]} →, {'xyz'[j]} ↑</text></svg>"
    )

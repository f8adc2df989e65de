"""What is measured on the manifold of q: derivatives of ⊕ and ⊖, the way between two configurations and its length."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array
from .configuration import ConfigurationSpace
from .state import checked_state

__all__ = ["Manifold"]


class Manifold(ConfigurationSpace):
    """The part of a `Model` that concerns small changes of q, and ways from one q to another."""

    def d_integrate(self, q: ArrayLike, v_dt: ArrayLike) -> tuple[Array, Array]:
        """Return the derivatives of q ⊕ v_dt: where a small step dq before it, and a change of v_dt, move the end.

        (q ⊕ dq) ⊕ v_dt = (q ⊕ v_dt) ⊕ J_q dq, and q ⊕ (v_dt + dv) = (q ⊕ v_dt) ⊕ J_v dv, to first order.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v_dt : array_like, shape (..., nv)
            rad and m.

        Returns
        -------
        J_q, J_v : ndarray, shape (..., nv, nv)
            One block for each joint. Pinocchio's ``dIntegrate``.

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.

        Examples
        --------
        >>> import twistwrench as tw
        >>> model, step = tw.load("go2"), np.array([0, 0, np.pi / 2, *np.zeros(15)])
        >>> J_q, J_v = model.d_integrate(model.neutral(), step)
        >>> J_q[:3, :3].round(15) + 0.0  # after the quarter turn, what was along x is along −y
        array([[ 0.,  1.,  0.],
               [-1.,  0.,  0.],
               [ 0.,  0.,  1.]])
        """
        q, v_dt = checked_state(self, q=q, v_dt=v_dt)
        slices = zip(self.joints, self.v_slice)
        return self._blocks([joint.d_integrate(v_dt[..., vs]) for joint, vs in slices if joint], v_dt)

    def d_difference(self, q0: ArrayLike, q1: ArrayLike) -> tuple[Array, Array]:
        """Return the derivatives of q1 ⊖ q0: how it changes with a small step from q0, and with one from q1.

        q1 ⊖ (q0 ⊕ dq) = q1 ⊖ q0 + J₀ dq, and (q1 ⊕ dq) ⊖ q0 = q1 ⊖ q0 + J₁ dq, to first order.

        Parameters
        ----------
        q0, q1 : array_like, shape (..., nq)

        Returns
        -------
        J_0, J_1 : ndarray, shape (..., nv, nv)
            One block for each joint. Pinocchio's ``dDifference``.

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.

        Examples
        --------
        >>> import twistwrench as tw
        >>> model = tw.load("go2")
        >>> J_0, J_1 = model.d_difference(model.standing(), model.standing())
        >>> bool((J_1 == np.eye(18)).all() and (J_0 == -np.eye(18)).all())
        True
        """
        q0, q1 = checked_state(self, q0=q0, q1=q1)
        slices = zip(self.joints, self.q_slice)
        return self._blocks([joint.d_difference(q0[..., qs], q1[..., qs]) for joint, qs in slices if joint], q1)

    def _blocks(self, pairs: list[tuple[Array, Array]], like: Array) -> tuple[Array, Array]:
        """Put one pair of blocks per joint into two matrices over v."""
        first, second = np.zeros((2, *like.shape[:-1], self.nv, self.nv), like.dtype)
        for s, (A, B) in zip([s for joint, s in zip(self.joints, self.v_slice) if joint], pairs, strict=True):
            first[..., s, s], second[..., s, s] = A, B
        return first, second

    def interpolate(self, q0: ArrayLike, q1: ArrayLike, u: ArrayLike) -> Array:
        """Return the configuration on the way from q0 to q1: q0 ⊕ u (q1 ⊖ q0), every joint at a constant velocity.

        Parameters
        ----------
        q0, q1 : array_like, shape (..., nq)
        u : array_like, shape (...)
            0 at q0, 1 at q1.

        Returns
        -------
        ndarray, shape (..., nq)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.

        Examples
        --------
        >>> import twistwrench as tw
        >>> arm = tw.load("planar_arm")
        >>> arm.interpolate([0, 0, 0], [1, 2, -4], [0, 0.5])
        array([[ 0. ,  0. ,  0. ],
               [ 0.5,  1. , -2. ]])
        """
        return self.integrate(q0, as_array(u, "u")[..., None] * self.difference(q0, q1))

    def distance(self, q0: ArrayLike, q1: ArrayLike) -> Array:
        """Return the length of q1 ⊖ q0: radians and metres in one root, so it depends on the unit of length.

        Parameters
        ----------
        q0, q1 : array_like, shape (..., nq)

        Returns
        -------
        ndarray, shape (...)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.

        Examples
        --------
        >>> import twistwrench as tw
        >>> tw.load("planar_arm").distance([0, 0, 0], [1, 2, -2])
        array(3.)
        """
        step = self.difference(q0, q1)
        return np.asarray(np.sqrt((step * step).sum(-1)))

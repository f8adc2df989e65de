"""Wrenches: 6-D forces (τ, f), and the power they spend on a twist (section 49.4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_number_arrays, check_batches, check_overflow, without_overflow
from ..errors import SingularError
from ._vector import FramedVector, as_spatial, common_frame
from .rotation import cross_matrix
from .twist import Placed, Screw, Twist, check_placement, screw

__all__ = ["Wrench", "center_of_pressure", "power"]


@without_overflow("F, V")
def power(F: Wrench | ArrayLike, V: Twist | ArrayLike) -> Array:
    """Power of a wrench on a twist, FᵀV = τ·ω + f·v (section 49.4).

    Parameters
    ----------
    F : Wrench or array_like of shape (..., 6)
        (τ, f), N m and N.
    V : Twist or array_like of shape (..., 6)
        (ω, v), rad/s and m/s, in the frame of `F`.

    Returns
    -------
    ndarray, shape (...)
        W.

    Raises
    ------
    ShapeError
        If a last axis is not 6 long.
    FrameError
        If both are given with a frame, and the frames differ.
    TypeError
        If `F` is a Twist or `V` a Wrench.
    ValueError
        If the power overflows.

    Examples
    --------
    >>> power([0, 0, 2, 0, 0, 0], [0, 0, 3, 1, 0, 0])
    array(6.)
    """
    if isinstance(F, Twist) or isinstance(V, Wrench):
        raise TypeError(f"power({type(F).__name__}, {type(V).__name__}): expected a wrench, then a twist")
    if isinstance(F, FramedVector) and isinstance(V, FramedVector):
        common_frame(F, "·", V)
    f, v = as_number_arrays(F=(as_spatial(F, "F"), (6,)), V=(as_spatial(V, "V"), (6,)))
    check_batches("F and V", f.shape[:-1], v.shape[:-1])
    return np.asarray((f * v).sum(-1))


@without_overflow("F")
def center_of_pressure(F: Wrench | ArrayLike) -> Array:
    """Return the point (−τ_y, τ_x, 0) / f_z of the plane z = 0 about which F has only a moment along z (49.4).

    Parameters
    ----------
    F : Wrench or array_like of shape (..., 6)
        (τ, f) of the ground on the foot, in a frame whose z axis is the normal of the sole, N m and N.

    Returns
    -------
    ndarray, shape (..., 3)
        In the frame of `F`, m.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    SingularError
        If there is no force along z: the foot does not stand.
    TypeError
        If `F` is a Twist.

    Examples
    --------
    >>> center_of_pressure([0, -1, 0, 0, 0, 100])
    array([0.01, 0.  , 0.  ])
    """
    F = as_spatial(F, "F")
    if (F[..., 5].real == 0).any():
        raise SingularError("center_of_pressure: it does not exist without a force along the normal")
    return np.stack([-F[..., 1], F[..., 0], 0 * F[..., 5]], axis=-1) / F[..., 5:]


class Wrench(FramedVector):
    """Wrench on a rigid body, (τ, f): the moment about the origin of the frame, and the force (section 49.4).

    Parameters
    ----------
    vector : array_like, shape (..., 6)
        (τ, f), N m and N.
    frame : str, optional
        The frame in which the numbers are expressed. If both wrenches of a sum, or both factors of a power, name one,
        the two names must be the same.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If the angular and linear parts were passed as two arguments.

    Examples
    --------
    >>> Wrench([0, 0, 2, 0, 0, 0]) @ Twist([0, 0, 3, 1, 0, 0])
    array(6.)
    """

    __slots__ = ()
    _symbol = "F"
    _line_first = False

    @property
    def moment(self) -> Array:
        """The moment τ about the origin, shape (..., 3), N m: another name for `angular`."""
        return self.angular

    @property
    def force(self) -> Array:
        """The force f, shape (..., 3), N: another name for `linear`."""
        return self.linear

    def transform(self, T: Placed, *, frame: str | None = None) -> Wrench:
        """Return the wrench in another frame, F_A = X* F_B (section 49.4).

        Parameters
        ----------
        T : SE3
            T_AB: the present frame B, placed in A.
        frame : str, optional
            The name of A.

        Returns
        -------
        Wrench

        Raises
        ------
        TypeError
            If `T` is not an SE3.

        Examples
        --------
        >>> from twistwrench.spatial.plucker import SE3
        >>> Wrench([0, 0, 0, 0, 0, 10]).transform(SE3(np.eye(3), [0.5, 0, 0]), frame="world")
        Wrench([0.0, -5.0, 0.0, 0.0, 0.0, 10.0], frame='world')
        """
        check_placement(T)
        check_batches("SE3 and Wrench", T.translation.shape[:-1], self._vector.shape[:-1])
        return Wrench(np.matvec(T.force_transform(), self._vector), frame=frame)

    def screw(self) -> Screw:
        """Return axis, point, pitch and magnitude: see `twistwrench.screw`."""
        return screw(self)

    def _line_and_free(self) -> tuple[Array, Array]:
        return self.linear, self.angular

    @classmethod
    def from_force(
        cls, force: ArrayLike, point: ArrayLike, couple: ArrayLike = (0, 0, 0), *, frame: str | None = None
    ) -> Wrench:
        """Make the wrench of a force that acts at a point, and of a couple: τ = point × f + couple (section 49.4).

        Parameters
        ----------
        force : array_like, shape (..., 3)
            N.
        point : array_like, shape (..., 3)
            Where it acts, from the origin of the frame, m.
        couple : array_like, shape (..., 3)
            A moment in addition, N m.
        frame : str, optional
            The frame that the numbers are expressed in.

        Returns
        -------
        Wrench

        Raises
        ------
        ShapeError
            If a last axis is not 3 long, or the batch axes do not broadcast.

        Examples
        --------
        >>> Wrench.from_force([0, 0, 10], point=[0.5, 0, 0])
        Wrench([0.0, -5.0, 0.0, 0.0, 0.0, 10.0])
        """
        f, p, c = as_number_arrays(force=(force, (3,)), point=(point, (3,)), couple=(couple, (3,)))
        moment = np.matvec(cross_matrix(p), f) + c
        check_overflow(moment, "force, point")
        return cls(np.concatenate(np.broadcast_arrays(moment, f), axis=-1), frame=frame)

    def power(self, twist: Twist | ArrayLike) -> Array:
        """Return the power spent on a twist, W: see `twistwrench.power`."""
        return power(self, twist)

    def __matmul__(self, twist: object) -> Array:
        if not isinstance(twist, Twist):
            raise TypeError(f"Wrench @ {type(twist).__name__}: expected a Twist; .power() also takes an array")
        return power(self, twist)

    def __rmatmul__(self, other: object) -> Array:
        return power(self, other) if isinstance(other, Twist) else super().__rmatmul__(other)

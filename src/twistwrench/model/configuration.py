"""The coordinates of a model: which numbers q and v have, and the manifold on which q lives.

A q is not a vector: the sum of two quaternions is not a rotation. A step from q goes along a twist of each joint,
q ⊕ v dt, and two configurations differ by such a step, q₁ ⊖ q₀.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_count, as_generator
from ..errors import NameNotFound
from .joint import Joint
from .state import check_arrays, check_entries, with_number

__all__ = ["ConfigurationSpace"]


class ConfigurationSpace:
    """The part of a `Model` that concerns its q and v. The attributes are documented there."""

    name: str
    base: str
    joint_names: tuple[str, ...]
    joints: tuple[Joint | None, ...]
    parent: tuple[int, ...]
    lower: Array
    upper: Array
    postures: Mapping[str, Array]

    @property
    def nbodies(self) -> int:
        """Number of bodies, the world included."""
        return len(self.parent)

    @cached_property
    def nq(self) -> int:
        """Number of entries of q."""
        return sum(joint.nq for joint in self.joints if joint)

    @cached_property
    def nv(self) -> int:
        """Number of degrees of freedom: entries of v, a and tau."""
        return sum(joint.nv for joint in self.joints if joint)

    @cached_property
    def q_slice(self) -> tuple[slice, ...]:
        """Where joint i's entries stand in q; empty for the world."""
        return _slices([joint.nq if joint else 0 for joint in self.joints])

    @cached_property
    def v_slice(self) -> tuple[slice, ...]:
        """Where joint i's entries stand in v; empty for the world."""
        return _slices([joint.nv if joint else 0 for joint in self.joints])

    def neutral(self) -> Array:
        """Return the configuration in which no joint moves anything. It may be outside the limits.

        Returns
        -------
        ndarray, shape (nq,)

        Examples
        --------
        >>> import twistwrench as tw
        >>> tw.load("go2").neutral()[:7]  # the base at the world's origin, with the quaternion (0, 0, 0, 1)
        array([0., 0., 0., 0., 0., 0., 1.])
        """
        return np.concatenate([np.zeros(0), *(joint.neutral() for joint in self.joints if joint)])

    def standing(self) -> Array:
        """Return a posture within the limits with the feet on z = 0.

        Returns
        -------
        ndarray, shape (nq,)

        Raises
        ------
        NameNotFound
            If the model has none: only the legged robots of the catalogue do.

        Examples
        --------
        >>> import twistwrench as tw
        >>> tw.load("go2").standing()[2].round(3)  # how high the base is, m
        np.float64(0.265)
        """
        if "standing" not in self.postures:
            raise NameNotFound(f"model {self.name!r} has no standing posture; there is neutral()")
        return self.postures["standing"].copy()

    def random_configuration(
        self, size: int | tuple[int, ...] = (), *, rng: np.random.Generator | int | None = None
    ) -> Array:
        """Draw a configuration, or many at once.

        Uniform between the limits; uniform over the turns of a quaternion or a (cos, sin). A range without end, or
        one of more than 100 turns or 200 m, is cut to one turn or 2 m of it, as near to 0 as it goes: to ±π or ±1 m
        where 0 is well inside (Pinocchio returns infinities there).

        Parameters
        ----------
        size : int or tuple of int
            How many, or the batch axes. They are drawn joint by joint: others than one by one with the same seed.
        rng : numpy Generator or int, optional
            Where the randomness comes from.

        Returns
        -------
        ndarray, shape (*size, nq)

        Raises
        ------
        ValueError
            If `rng` is neither, or `size` is not made of whole numbers of at least 0.

        Examples
        --------
        >>> import twistwrench as tw
        >>> model = tw.load("go2")
        >>> q = model.random_configuration(rng=0)
        >>> bool(((model.lower <= q) & (q <= model.upper)).all())
        True
        >>> model.random_configuration(1000, rng=0).shape
        (1000, 19)
        """
        rng = as_generator(rng)
        batch = tuple(as_count(n, "size", 0) for n in (size if isinstance(size, tuple | list) else (size,)))
        joints = zip(self.joints, self.q_slice)
        parts = [joint.random(rng, self.lower[s], self.upper[s], batch) for joint, s in joints if joint]
        return np.concatenate([np.zeros((*batch, 0)), *parts], axis=-1)

    def integrate(self, q: ArrayLike, v_dt: ArrayLike) -> Array:
        """Return the configuration q ⊕ v_dt, to which v_dt leads from q.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v_dt : array_like, shape (..., nv)
            Velocity times duration, rad and m; a floating base goes along its twist, (ω, v) in its own axes.

        Returns
        -------
        ndarray, shape (..., nq)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.

        Examples
        --------
        A base at rest that turns by 90° about its z:

        >>> import twistwrench as tw
        >>> model = tw.load("go2")
        >>> step = np.array([0, 0, np.pi / 2, 0, 0, 0, *np.zeros(12)])
        >>> model.integrate(model.neutral(), step)[3:7].round(3)
        array([0.   , 0.   , 0.707, 0.707])
        """
        return self._step(*check_entries(self, q=q, v_dt=v_dt))

    def _step(self, q: Array, v_dt: Array) -> Array:
        """Return q ⊕ v_dt of a checked state, or of numbers that are recorded."""
        return self._by_joint(lambda joint, qs, vs: joint.integrate(q[..., qs], v_dt[..., vs]), q)

    def difference(self, q0: ArrayLike, q1: ArrayLike) -> Array:
        """Return the v_dt that leads from q0 to q1: q1 ⊖ q0, the inverse of `integrate`.

        Parameters
        ----------
        q0, q1 : array_like, shape (..., nq)

        Returns
        -------
        ndarray, shape (..., nv)
            rad and m; a turn by at most π.

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.

        Examples
        --------
        >>> import twistwrench as tw
        >>> model, step = tw.load("go2"), np.linspace(-1, 1, 18)
        >>> q = model.standing()
        >>> bool(np.allclose(model.difference(q, model.integrate(q, step)), step, rtol=0, atol=1e-14))
        True
        """
        return self._way(*check_entries(self, q0=q0, q1=q1))

    def _way(self, q0: Array, q1: Array) -> Array:
        """Return q1 ⊖ q0 of checked configurations, or of numbers that are recorded."""
        return self._by_joint(lambda joint, qs, vs: joint.difference(q0[..., qs], q1[..., qs]), q0)

    def normalize(self, q: ArrayLike) -> Array:
        """Scale the quaternions and the (cos, sin) in q to norm 1.

        Parameters
        ----------
        q : array_like, shape (..., nq)

        Returns
        -------
        ndarray, shape (..., nq)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`; but a norm other than 1 is accepted unless it is zero.

        Examples
        --------
        >>> import twistwrench as tw
        >>> model = tw.load("go2")
        >>> model.normalize(2 * model.neutral())[3:7]
        array([0., 0., 0., 1.])
        """
        (q,) = check_arrays(self, q=q)
        pieces = []
        for joint, name, s in zip(self.joints, self.joint_names, self.q_slice):
            try:
                pieces.append(joint.normalize(q[..., s]) if joint else q[..., s])
            except ValueError as error:
                raise ValueError(f"joint {name!r} (q[{s.start}:{s.stop}]): {error}") from None
        return np.concatenate(pieces, axis=-1)

    def _by_joint(self, function: Callable[[Joint, slice, slice], Array], like: Array) -> Array:
        """Concatenate what a function returns for each joint from its slices of q and v."""
        pieces = [function(joint, qs, vs) for joint, qs, vs in zip(self.joints, self.q_slice, self.v_slice) if joint]
        return np.concatenate([like[..., :0], *pieces], axis=-1)

    # Derivatives of ⊕ and ⊖, the way between two configurations and its length.

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
        return self._d_step(check_entries(self, q=q, v_dt=v_dt)[1])

    def _d_step(self, v_dt: Array) -> tuple[Array, Array]:
        """Return the derivatives of a checked step, or of numbers that are recorded: they are the same from every q."""
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
        return self._d_way(*check_entries(self, q0=q0, q1=q1))

    def _d_way(self, q0: Array, q1: Array) -> tuple[Array, Array]:
        """Return the derivatives of q1 ⊖ q0 of checked configurations, or of numbers that are recorded."""
        slices = zip(self.joints, self.q_slice)
        return self._blocks([joint.d_difference(q0[..., qs], q1[..., qs]) for joint, qs in slices if joint], q1)

    def _blocks(self, pairs: list[tuple[Array, Array]], like: Array) -> tuple[Array, Array]:
        """Put one pair of blocks per joint into two matrices over v."""
        first, second = np.zeros((2, *like.shape[:-1], self.nv, self.nv), like.dtype)
        for s, (A, B) in zip([s for joint, s in zip(self.joints, self.v_slice) if joint], pairs, strict=True):
            first[..., s, s] = A
            second[..., s, s] = B
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
        checked = dict(zip(("q0", "q1"), check_entries(self, q0=q0, q1=q1)))
        q0, q1, u = with_number(self, checked, u, "u")
        return self.integrate(q0, u[..., None] * self._way(q0, q1))

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

    def state(self, q: ArrayLike, **others: ArrayLike | None) -> tuple[Array, ...]:
        """Check a state and bring it to one dtype and one batch shape.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        **others : array_like
            By the name of the argument: ``f_ext`` (..., nbodies, 6), zero where it is None; names that
            begin with ``q`` (..., nq), all others (..., nv).

        Returns
        -------
        tuple of ndarray
            q and the others, in their order, broadcast against each other. Read-only views.

        Raises
        ------
        ShapeError
            A wrong last axis (with a hint where nq and nv were confused), or batch axes that do
            not broadcast.
        ValueError
            An infinity or a NaN; a wrench on the world; a quaternion or (cos, sin) that is off norm 1 by more than the
            root of the number type's resolution (1.5e-8 in float64).
        """
        return check_entries(self, q=q, **others)


def _slices(sizes: list[int]) -> tuple[slice, ...]:
    ends = np.cumsum([0, *sizes]).tolist()
    return tuple(slice(a, b) for a, b in pairwise(ends))

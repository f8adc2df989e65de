"""Joints that follow others: a smaller model whose M, h and Jacobians are those of the full one, projected.

A joint with ``<mimic>`` has no coordinate of its own: its q is multiplier · q_leader + offset. So the velocities of all
joints are v_full = G v with a constant G, and virtual work in both coordinates is the same, vᵀτ = v_fullᵀ τ_full:

    τ = Gᵀ τ_full,   M = Gᵀ M_full G,   h = Gᵀ h_full,   J = J_full G,   A_G = A_full G.

ABA has no such rule, since it takes each joint's coordinate for its own: q̈ = M⁻¹ (τ − h).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from inspect import signature
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, resolution
from ..errors import ModelError, SingularError, check_known
from ..model import ConfigurationSpace, Joint, LoadReport, Model, check_model
from .crba import crba
from .rnea import rnea
from .whole_body import Dynamics

__all__ = ["MimicModel", "follow"]

Law = tuple[str, float, float]
"""The law of a joint that follows: its leader, the multiplier, the offset."""

FORCES, MATRICES, COLUMNS, UNCHANGED = "forces", "matrices", "columns", "unchanged"
RESULTS = {
    **dict.fromkeys(("rnea", "nonlinear_effects", "gravity"), FORCES),
    **dict.fromkeys(("crba", "coriolis_matrix"), MATRICES),
    **dict.fromkeys(("frame_jacobian", "contact_jacobian", "point_jacobian"), COLUMNS),
    **dict.fromkeys(("centroidal_map", "centroidal_map_rate", "center_of_mass_jacobian"), COLUMNS),
    **dict.fromkeys(("forward_kinematics", "frame_placement", "frame_bias_acceleration", "joint_wrenches"), UNCHANGED),
    "frame_wrench": UNCHANGED,
    **dict.fromkeys(("kinetic_energy", "potential_energy", "center_of_mass"), UNCHANGED),
    **dict.fromkeys(("centroidal_momentum", "centroidal_momentum_rate", "centroidal_inertia"), UNCHANGED),
    **dict.fromkeys(("center_of_mass_velocity", "center_of_mass_acceleration"), UNCHANGED),
    **dict.fromkeys(("point_velocity", "point_acceleration"), UNCHANGED),
    "constraint_jacobian": COLUMNS,
    **dict.fromkeys(("constraint_bias", "contact_placements"), UNCHANGED),
}
"""How each function's result is projected. J̇ v and ȧ need no extra term: G is constant."""


@dataclass(frozen=True, eq=False, repr=False)
class MimicModel(ConfigurationSpace):
    """A model some of whose joints follow others; made by ``twistwrench.load(file, mimic="reduce")``.

    `rnea`, `aba`, `crba`, `nonlinear_effects`, `gravity`, `coriolis_matrix`, the kinematics, Jacobians, energies, the
    centroidal quantities and `dynamics` take it in the place of a `Model`, and so do `simulate` and the functions of
    contacts. Other functions, those of ``tw.fast`` too, raise TypeError; they take `full`, with the q and v of
    `expand`. Where they take contacts, as `Scene` does, a `Coupling` for each joint that follows makes it follow there.

    Parameters
    ----------
    full : Model
        With every joint free.
    laws : mapping of str to (str, float, float)
        For each joint that follows, its leader, the multiplier and the offset; no leader follows another joint.
    joint_names, joints, parent : tuple
        Those of the joints that have coordinates, as in `Model`; parents are bodies of the full model.
    G : ndarray, shape (nv of full, nv)
        v_full = G v.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = follow(tw.load("planar_arm"), {"wrist": ("elbow", -1.0, 0.5)})
    >>> arm
    MimicModel 'planar_arm': fixed base, nq = 2, nv = 2, 1 joint that follows
    >>> arm.expand([0.1, 0.2], [1.0, 2.0])
    (array([0.1, 0.2, 0.3]), array([ 1.,  2., -2.]))
    >>> tw.crba(arm, [0.1, 0.2]).shape
    (2, 2)
    """

    full: Model
    laws: Mapping[str, Law]
    joint_names: tuple[str, ...]
    joints: tuple[Joint | None, ...]
    parent: tuple[int, ...]
    kept_q: Array
    G: Array

    @property
    def name(self) -> str:  # type: ignore[override]
        """The full model's."""
        return self.full.name

    @property
    def base(self) -> str:  # type: ignore[override]
        """The full model's."""
        return self.full.base

    @property
    def nbodies(self) -> int:
        """Number of bodies, the world and those that follow included: the rows of an f_ext."""
        return self.full.nbodies

    @property
    def report(self) -> LoadReport:
        """The report of the full model."""
        return self.full.report

    @property
    def lower(self) -> Array:  # type: ignore[override]
        """Limits of q: the leaders' own."""
        return self.full.lower[self.kept_q]

    @property
    def upper(self) -> Array:  # type: ignore[override]
        """Limits of q: the leaders' own."""
        return self.full.upper[self.kept_q]

    @property
    def postures(self) -> Mapping[str, Array]:  # type: ignore[override]
        """The full model's, reduced to the entries that are coordinates here."""
        return {name: q[self.kept_q] for name, q in self.full.postures.items()}

    @property
    def feet(self) -> tuple[str, ...]:
        """The full model's."""
        return self.full.feet

    def expand(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return the full state, in which joints follow.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v : array_like, shape (..., nv); velocities or accelerations

        Returns
        -------
        tuple of ndarray, shapes (..., nq of full) and (..., nv of full)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        q, v = self.state(q, v=v)
        return self._full_q(q), np.matvec(self.G.astype(v.dtype), v)

    def _full_q(self, q: Array) -> Array:
        """Return the full configuration of a checked one."""
        own = dict(zip(self.joint_names, (q[..., s] for s in self.q_slice)))
        pieces = [q[..., :0]]
        for joint, name in zip(self.full.joints[1:], self.full.joint_names[1:]):
            if name in self.laws:
                leader, multiplier, offset = self.laws[name]
                pieces.append(_from_angle(multiplier * _angle(own[leader]) + offset, joint))
            else:
                pieces.append(own[name])
        return np.concatenate(pieces, axis=-1)

    def _project(self, function: Callable[..., Any], *args: Any, **kwargs: Any) -> Any:
        """Call a function with the full model, and project its result."""
        given = signature(function).bind(*args, **kwargs).arguments
        named = {name: x for name, x in given.items() if name in ("q", "v", "a", "tau", "f_ext") and x is not None}
        named = dict(zip(named, self.state(**named))) if named else {}
        full = {name: np.matvec(self.G.astype(x.dtype), x) for name, x in named.items() if name in ("v", "a")}
        asked = given | named | full | {"model": self.full, "q": self._full_q(named["q"])}
        if function.__name__ == "aba":
            return self._accelerations(asked)
        result = function(**asked)
        if isinstance(result, Dynamics):
            parts = {"M": MATRICES, "h": FORCES, "J_c": COLUMNS, "A_G": COLUMNS}
            shown = {name: x for name in parts if (x := getattr(result, name)) is not None}
            return replace(result, **{name: self._projected(x, parts[name]) for name, x in shown.items()})
        return self._projected(result, RESULTS[function.__name__])

    def _projected(self, x: Any, how: str) -> Any:
        if how == UNCHANGED:
            return x
        G = self.G.astype(x.dtype)
        if how == FORCES:
            return np.matvec(G.mT, x)
        return G.mT @ x @ G if how == MATRICES else x @ G

    def _accelerations(self, asked: Mapping[str, Any]) -> Array:
        """Solve M q̈ = τ − h."""
        q, v = asked["q"], asked["v"]
        M = self._projected(crba(self.full, q), MATRICES)
        h: Array = self._projected(rnea(self.full, q, v, np.zeros_like(v), asked.get("f_ext")), FORCES)
        return self._solve(M, asked["tau"] - h)

    def _solve(self, M: Array, b: Array) -> Array:
        """Solve M x = b by elimination, in any number type; raise SingularError unless M is positive definite."""
        M, x = np.broadcast_to(M, (*b.shape, self.nv)).copy(), b.copy()
        least = self.nv * resolution(M.dtype) * np.diagonal(M.real, axis1=-2, axis2=-1)
        for k in range(self.nv):
            if (M[..., k, k].real <= least[..., k]).any():
                name = next(name for name, s in zip(self.joint_names, self.v_slice) if k < s.stop)
                raise SingularError(f"M is singular at joint {name!r} of {self.name!r}: q̈ is not determined there")
            factor = M[..., k + 1 :, k] / M[..., k, None, k]
            M[..., k + 1 :, k:] -= factor[..., None] * M[..., k, None, k:]
            x[..., k + 1 :] -= factor * x[..., k, None]
        for k in reversed(range(self.nv)):
            x[..., k] = (x[..., k] - (M[..., k, k + 1 :] * x[..., k + 1 :]).sum(axis=-1)) / M[..., k, k]
        return x

    def __repr__(self) -> str:
        joints = "1 joint that follows" if len(self.laws) == 1 else f"{len(self.laws)} joints that follow"
        return f"MimicModel {self.name!r}: {self.base} base, nq = {self.nq}, nv = {self.nv}, {joints}"


def follow(model: Model, laws: Mapping[str, Law]) -> MimicModel:
    """Let joints of a model follow others: q = multiplier · q_leader + offset.

    Parameters
    ----------
    model : Model
    laws : mapping of str to (str, float, float)
        For each joint that follows, its leader, the multiplier and the offset. A leader may follow another joint.

    Returns
    -------
    MimicModel

    Raises
    ------
    ModelError
        If joints follow each other in a circle, or one of them has more than one degree of freedom; if a joint follows
        a continuous one (whose q is a cosine and a sine) by a multiplier that is not a whole number.
    NameNotFound
        If the model has no such joint.
    """
    check_model(model)
    laws = {name: _resolved(name, laws) for name in laws}
    for name, law in laws.items():
        _check(model, name, law)
    kept = [i for i in range(1, model.nbodies) if model.joint_names[i] not in laws]
    columns = {model.joint_names[i]: np.arange(model.nv)[model.v_slice[i]] for i in range(1, model.nbodies)}
    own = np.concatenate([np.zeros(0, int), *(columns[model.joint_names[i]] for i in kept)])
    G = np.eye(model.nv)[:, own]
    for name, (leader, multiplier, _) in laws.items():
        G[columns[name]] = multiplier * G[columns[leader]]
    G.flags.writeable = False
    return MimicModel(
        full=model,
        laws=laws,
        joint_names=(model.joint_names[0], *(model.joint_names[i] for i in kept)),
        joints=(None, *(model.joints[i] for i in kept)),
        parent=(-1, *(model.parent[i] for i in kept)),
        kept_q=np.concatenate([np.zeros(0, int), *(np.arange(model.nq)[model.q_slice[i]] for i in kept)]),
        G=G,
    )


def _resolved(name: str, laws: Mapping[str, Law]) -> Law:
    """Return the law of a joint in terms of a leader that does not follow another."""
    leader, multiplier, offset = laws[name]
    way = [name]
    while leader in laws:
        way.append(leader)
        if leader in way[:-1]:
            raise ModelError(f"joints follow each other in a circle: {' -> '.join(way)}")
        leader, m, o = laws[leader]
        multiplier, offset = multiplier * m, multiplier * o + offset
    return leader, multiplier, offset


def _check(model: Model, name: str, law: Law) -> None:
    leader, multiplier, _ = law
    for joint in (name, leader):
        check_known("joint", joint, model.joint_names[1:], f" of model {model.name!r} (a joint that moves)")
    follower, leading = (model.joints[model.joint_id(joint)] for joint in (name, leader))
    if follower is None or leading is None or follower.nv != 1 or leading.nv != 1:
        raise ModelError(f"joint {name!r} follows {leader!r}: expected two joints of one degree of freedom each")
    if leading.nq == 2 and (multiplier % 1 or not follower.subspace()[:3].any()):
        raise ModelError(
            f"joint {name!r} follows {leader!r} by {multiplier:g}: the leader is continuous, and its (cos, sin) gives "
            "its angle up to whole turns only: expected a joint that turns, by a whole number (or a leader with limits)"
        )


def _angle(q: Array) -> Array:
    """Return the angle or the length of a joint; of a (cos, sin) the one in (−π, π]; in complex numbers, too."""
    c, s = q[..., 0], q[..., -1]
    if q.shape[-1] == 1:
        return c
    near = np.arctan2(s.real, c.real)
    angle: Array = near + np.arctan((s * np.cos(near) - c * np.sin(near)) / (c * np.cos(near) + s * np.sin(near)))
    return angle


def _from_angle(angle: Array, joint: Joint | None) -> Array:
    """Return the q of a joint that turns by an angle, or moves by a length."""
    continuous = joint is not None and joint.nq == 2
    return np.stack([np.cos(angle), np.sin(angle)] if continuous else [angle], axis=-1)

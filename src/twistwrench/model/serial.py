"""Arms as textbooks print them: by screw axes (49.2), or by a table of Denavit and Hartenberg (49.3).

Either determines all placements of a chain, but not its masses, which are given separately.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import (
    Array,
    as_exactly,
    as_real,
    as_sequence,
    check_choice,
    check_kind,
    check_size,
    resolution,
    tolerance,
)
from ..errors import ModelError, ShapeError, check_known
from ..spatial import SE3, SpatialInertia, exp3, screw
from .arguments import check_model
from .builder import GRAVITY, Builder, placement_of
from .checks import UNLIMITED
from .joint import AxisJoint, Joint
from .joints import Helical, Prismatic, Revolute
from .model import Model
from .tree import joint_placements

__all__ = ["ScrewAxes", "from_dh", "from_screw_axes", "screw_axes"]


class ScrewAxes(NamedTuple):
    """A frame at q = 0, and the twists of the joints that move it there: what `screw_axes` returns.

    Attributes
    ----------
    M : ndarray, shape (4, 4)
        Placement of the frame in the world, in the neutral configuration.
    Slist : ndarray, shape (6, nv)
        The twist (ω, v) of each joint in the world, one column each: T(q) = exp(S₁q₁) ... exp(Sₙqₙ) M. A column is zero
        where the joint does not move the frame.
    Blist : ndarray, shape (6, nv)
        The same in the frame itself: T(q) = M exp(B₁q₁) ... exp(Bₙqₙ).
    """

    M: Array
    Slist: Array
    Blist: Array


def screw_axes(model: Model, frame: str) -> ScrewAxes:
    """Screw axes of a model in its neutral configuration, and a frame there: Modern Robotics' Slist, Blist and M.

    Parameters
    ----------
    model : Model
        Of joints with one degree of freedom.
    frame : str

    Returns
    -------
    ScrewAxes

    Raises
    ------
    ModelError, NameNotFound
        If a joint has more than one degree of freedom (its placement is not one exponential); an unknown frame.

    Examples
    --------
    >>> import twistwrench as tw
    >>> M, Slist, Blist = screw_axes(tw.load("planar_arm"), "tool")
    >>> Slist[:, 1]  # the elbow turns about an axis along −y, half a metre along x
    array([ 0. , -1. ,  0. ,  0. ,  0. , -0.5])
    """
    check_model(model)
    for name, joint in zip(model.joint_names, model.joints):
        if joint is not None and not isinstance(joint, AxisJoint):
            raise ModelError(f"model: joint {name!r}: expected joints of one degree of freedom, got {joint.kind}")
    at = model.frame(frame)
    place = joint_placements(model, model.neutral())
    for i in range(1, model.nbodies):
        place[i] = place[model.parent[i]] @ place[i]
    M = place[at.body] @ at.placement
    Slist = np.zeros((6, model.nv))
    S = model.constants(np.float64).S
    for i in model.support(at.body):
        Slist[:, model.v_slice[i]] = place[i].motion_transform() @ S[i]
    return ScrewAxes(M.matrix(), Slist, M.inverse().motion_transform() @ Slist)


def from_screw_axes(
    M: ArrayLike,
    Slist: ArrayLike | None = None,
    *,
    Blist: ArrayLike | None = None,
    Mlist: Sequence[ArrayLike] | None = None,
    Glist: Sequence[ArrayLike] | None = None,
    name: str = "screws",
    gravity: ArrayLike = GRAVITY,
    physical: bool = True,
) -> Model:
    """Make the model of an open chain from the screw axes of its joints, as Modern Robotics (Lynch and Park) prints it.

    Parameters
    ----------
    M : array_like, shape (4, 4)
        Placement of the end effector in the world at q = 0: the frame ``"tool"`` of the model.
    Slist : array_like, shape (6, n)
        A column for each joint: its twist (ω, v) in the world at q = 0, with |ω| = 1, or ω = 0 and |v| = 1. A
        `Revolute`, a `Helical` or a `Prismatic` joint, as its pitch says.
    Blist : array_like, shape (6, n)
        In place of Slist: the same in the frame of the end effector.
    Mlist : sequence of n or n + 1 array_like, shape (4, 4), optional
        Placement of the frame of link i, at its centre of mass, in that of link i − 1, at q = 0.
    Glist : sequence of n array_like, shape (6, 6), optional
        Spatial inertia of each link in its frame; without Mlist and Glist the links have no mass.
    name : str
    gravity : array_like, shape (3,)
        In the world, m/s².
    physical : bool
        Reject a body that cannot exist, as `Builder.build`.

    Returns
    -------
    Model
        Joints ``"joint1"`` ... in the order of the columns, frames ``"link1"`` ... on the axes, and ``"tool"``.

    Raises
    ------
    ShapeError
        If a shape is wrong, or M not a placement.
    ModelError
        If both or neither of Slist and Blist are given, Mlist comes without Glist, an axis is not of length 1, or a
        body cannot exist.

    Examples
    --------
    >>> import twistwrench as tw
    >>> M = SE3(np.diag([-1, 1, -1]), [0, 6, 2]).matrix()  # Modern Robotics, the example of FKinSpace
    >>> Slist = np.array([[0, 0, 1, 4, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, -1, -6, 0, -0.1]]).T
    >>> arm = from_screw_axes(M, Slist)
    >>> tw.frame_placement(arm, [np.pi / 2, 3, np.pi], "tool").translation.round(8)
    array([-5.        ,  4.        ,  1.68584073])
    """
    home = placement_of(M, "M")
    if (Slist is None) == (Blist is None):
        raise ModelError("expected either Slist or Blist, got both or neither")
    given, what = (Blist, "Blist") if Slist is None else (Slist, "Slist")
    S = as_real([] if given is None else given, what)
    check_size(S, what)
    if S.ndim != 2 or len(S) != 6:
        raise ShapeError(f"{what}: expected a column for each joint, shape (6, n), got {S.shape}")
    axes = (S if Blist is None else home.motion_transform() @ S).mT
    joints = [_joint(V, f"{what}: joint {i}") for i, V in enumerate(axes, start=1)]
    places = [SE3.identity(), *(SE3(np.eye(3), point) for _, point in joints)]
    inertias = _link_inertias(Mlist, Glist, places[1:])
    builder = Builder(name, root="link0", gravity=gravity)
    for i, ((joint, _), (here, there), inertia) in enumerate(zip(joints, pairwise(places), inertias), start=1):
        at = here.inverse() @ there
        own = f"link{i}"
        builder.link(own, parent=f"link{i - 1}", joint=joint, joint_name=f"joint{i}", placement=at, inertia=inertia)
    builder.link("tool", parent=f"link{len(joints)}", placement=places[-1].inverse() @ home)
    return builder.build(physical=physical)


def _joint(V: Array, what: str) -> tuple[Joint, Array]:
    """Return the joint of a screw axis, and a point on the axis; a pitch that rounding of v explains is zero."""
    if not V.any():
        raise ModelError(f"{what}: expected a screw axis, got zeros")
    axis, point, pitch, magnitude = screw(V)
    if abs(magnitude - 1) > tolerance(V.dtype):
        raise ModelError(f"{what}: expected |ω| = 1, or ω = 0 and |v| = 1, got a length of {magnitude:.6g}")
    if np.isinf(pitch):
        return Prismatic(axis), point
    turns = abs(pitch) <= 8 * resolution(V.dtype) * np.abs(V[3:]).max()
    return Revolute(axis) if turns else Helical(axis, float(pitch)), point


def _link_inertias(
    Mlist: Sequence[ArrayLike] | None, Glist: Sequence[ArrayLike] | None, places: list[SE3]
) -> list[SpatialInertia]:
    """Return the inertia of each link in the frame on its joint's axis."""
    n = len(places)
    if Mlist is None and Glist is None:
        return [SpatialInertia.zero()] * n
    if Mlist is None or Glist is None:
        raise ModelError("expected both Mlist and Glist, or neither, got one of them")
    steps, G = as_sequence(Mlist, "Mlist", "placements"), as_sequence(Glist, "Glist", "inertias")
    if len(steps) not in (n, n + 1) or len(G) != n:
        raise ShapeError(f"expected {n} or {n + 1} entries of Mlist and {n} of Glist, got {len(steps)} and {len(G)}")
    frames = [placement_of(step, f"Mlist[{i}]") for i, step in enumerate(steps)]
    inertias = [SpatialInertia.from_matrix(as_exactly(g, f"Glist[{i}]", 6, 6)) for i, g in enumerate(G)]
    return [
        inertia.transform(place.inverse() @ reduce(SE3.__matmul__, frames[: i + 1]))
        for i, (inertia, place) in enumerate(zip(inertias, places))
    ]


def from_dh(
    *,
    a: ArrayLike,
    alpha: ArrayLike,
    d: ArrayLike,
    theta: ArrayLike = 0.0,
    convention: Literal["classical", "modified"],
    kinds: str | None = None,
    inertias: Sequence[SpatialInertia] | None = None,
    name: str = "dh",
    gravity: ArrayLike = GRAVITY,
    physical: bool = True,
    **per_joint: ArrayLike,
) -> Model:
    """Make the model of an arm from its table of Denavit and Hartenberg.

    Classical (Spong's and Corke's convention), joint i turns about z of frame i − 1: A_i = Rz(θ) Tz(d) Tx(a) Rx(α).
    Modified (Craig's), joint i turns about z of frame i: A_i = Rx(α) Tx(a) Rz(θ) Tz(d), where row i holds what Craig
    calls α_{i−1} and a_{i−1}.

    Parameters
    ----------
    a, alpha, d : array_like, shape (n,)
        Lengths in m and twists in rad, a number for each joint.
    theta : array_like, shape (n,)
        Angles in rad. q adds to θ of a revolute joint, and to d of a prismatic one: here stands what is left at q = 0.
    convention : {"classical", "modified"}
    kinds : str, optional
        "R" or "P" for each joint, for example ``"RRP"``; all revolute unless given.
    inertias : sequence of n SpatialInertia, optional
        Of each link in its DH frame; without mass unless given.
    name : str
    gravity : array_like, shape (3,)
        In frame 0, m/s².
    physical : bool
        Reject a body that cannot exist, as `Builder.build`: link 3 of the Puma 560 as it is published is one.
    **per_joint : array_like, shape (n,)
        Limits, armature and the like, by the names of `Builder.link`: ``armature=G**2 * Jm``.

    Returns
    -------
    Model
        Joints ``"joint1"`` ..., and the DH frames ``"link0"`` to ``"link{n}"``, the last of which is the tool's.

    Raises
    ------
    ShapeError
        If the lengths differ.
    ModelError
        If `convention` or a kind is not one of those, or a body cannot exist.
    NameNotFound
        If an argument is not one of `Builder.link`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> scara = from_dh(a=[1, 1, 0], alpha=[0, np.pi, 0], d=[0, 0, 0], convention="classical", kinds="RRP")
    >>> tw.frame_placement(scara, [np.pi / 2, -np.pi / 2, 0.3], "link3").translation.round(12)
    array([ 1. ,  1. , -0.3])
    """
    check_choice(convention, "convention", ("classical", "modified"), ModelError)
    n, columns = _columns(a=a, alpha=alpha, d=d, theta=theta)
    kinds = "R" * n if kinds is None else kinds
    check_kind(kinds, "kinds", str, "a string of R and P")
    if len(kinds) != n or set(kinds) - {"R", "P"}:
        raise ModelError(f"kinds: expected {n} letters R or P, got {kinds!r}")
    bodies = [SpatialInertia.zero()] * n if inertias is None else as_sequence(inertias, "inertias", "inertias")
    if len(bodies) != n:
        raise ShapeError(f"inertias: expected one for each of the {n} joints, got {len(bodies)}")
    for body in bodies:
        check_kind(body, "inertias", SpatialInertia, "a SpatialInertia for each joint")
    for key in per_joint:
        check_known("argument", key, UNLIMITED)
    numbers = {key: np.broadcast_to(as_real(x, key), n) for key, x in per_joint.items()}
    builder = Builder(name, root="link0", gravity=gravity)
    for i, (a_i, alpha_i, d_i, theta_i) in enumerate(columns.mT):
        along_x = SE3(exp3([alpha_i, 0, 0]), [a_i, 0, 0])
        along_z = SE3(exp3([0, 0, theta_i]), [0, 0, d_i])  # q turns or slides about the same z, before or after
        before, after = (along_z, along_x) if convention == "classical" else (along_x @ along_z, SE3.identity())
        joint = Revolute("z") if kinds[i] == "R" else Prismatic("z")
        own = {key: x[i] for key, x in numbers.items()}
        axis, link = f"axis{i + 1}", f"link{i + 1}"
        builder.link(axis, parent=f"link{i}", joint=joint, joint_name=f"joint{i + 1}", placement=before, **own)
        builder.link(link, parent=axis, joint_name=f"flange{i + 1}", placement=after, inertia=bodies[i])
    return builder.build(physical=physical)


def _columns(**named: ArrayLike) -> tuple[int, Array]:
    """Return the number of joints, and the columns of a table as rows of one array."""
    columns = {name: as_real(x, name) for name, x in named.items()}
    for k, x in columns.items():
        check_size(x, k)
    shapes = {name: x.shape for name, x in columns.items() if x.ndim}
    if len(set(shapes.values())) != 1 or len(next(iter(shapes.values()))) != 1:
        raise ShapeError(f"expected columns of one length, got {', '.join(f'{k} {s}' for k, s in shapes.items())}")
    n = max(x.size for x in columns.values())
    return n, np.stack([np.broadcast_to(x, n) for x in columns.values()])

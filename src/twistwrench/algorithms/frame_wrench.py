"""The wrench that passes through a frame, a weld among them: what a force-torque sensor reads (49.6)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, convert
from ..errors import ModelError
from ..model import Frame, Model, cast, check_model, check_state, columns, tree_terms, wrenches
from ..spatial import SpatialInertia
from ..spatial.formulas import bias_wrench
from ._mimic import also_of_mimics
from .rnea import newton_euler

__all__ = ["frame_wrench"]

SAME_RTOL = 1e-9
"""The links of a body add up to its inertia within this part of it, unless it has been replaced."""


@also_of_mimics
def frame_wrench(
    model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, frame: str, f_ext: ArrayLike | None = None
) -> Array:
    """Return the wrench through a frame: of the robot on the link there and on all that hangs on it.

    A force-torque sensor between two links reads it. Of a sensor that reports the load on itself, as many do, the sign
    is the other one.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv)
    frame : str
        Of a link that is welded on, or carried by a joint; a link of the world is a plate under the robot.
    f_ext : array_like, shape (..., nbodies, 6), optional
        As `rnea`. What acts on the body that has the frame is taken to act beyond the frame: on the tool.

    Returns
    -------
    ndarray, shape (..., 6)
        (τ, f) at the frame's origin, in its axes, N m and N. The weight is in it: still, f is −m g.

    Raises
    ------
    NameNotFound
        If there is no such frame.
    ModelError
        If it is not known which part of the body is beyond the frame: after `reroot`, in a model of Pinocchio or
        MuJoCo, or with an inertia that was replaced as a whole.
    ShapeError, ValueError
        As `rnea`.

    See Also
    --------
    twistwrench.joint_wrenches : the same at all joints.

    Notes
    -----
    Section 49.6: the equation of Newton and Euler of what is beyond, and the wrenches of the joints that hang there.

    Examples
    --------
    A tool of 0.8 kg, with its centre at 6 cm, is held level:

    >>> import twistwrench as tw
    >>> tool = tw.SpatialInertia.from_point(0.8, [0.0, 0.0, 0.06])
    >>> robot = tw.Builder("wrist")
    >>> robot.link("hand", parent="base_link", joint=tw.Revolute("y"), inertia=tw.SpatialInertia.from_rod(1.0, 0.2))
    >>> robot.link("tool", parent="hand", inertia=tool)
    >>> tw.frame_wrench(robot.build(), [np.pi / 2], [0.0], [0.0], "tool").round(6) + 0.0
    array([ 0.     , -0.47088, 0.     , -7.848  , 0.     , 0.     ])
    """
    check_model(model)
    at = model.frame(frame)
    inertia, joints = _beyond(model, frame)
    q, v, a, f_ext = check_state(model, q, v=v, a=a, f_ext=f_ext)
    tree, outside = tree_terms(model, q), wrenches(f_ext)
    terms = newton_euler(tree, columns(model, v), columns(model, a), outside)
    I = convert(inertia.matrix(), q.dtype)
    V, A = terms.V[at.body][..., None], terms.A[at.body][..., None]
    F = I @ A + bias_wrench(I, V) - outside[at.body]
    for i in joints:
        F = F + tree.X[i].mT @ terms.F[i][..., None]
    wrench: Array = (cast(at.placement, q.dtype).motion_transform().mT @ F)[..., 0]  # by the inverse of X*
    return wrench


def _beyond(model: Model, frame: str) -> tuple[SpatialInertia, list[int]]:
    """Return the inertia of what is beyond a frame, in the frame of its body, and the joints that hang there."""
    body = model.frame(frame).body
    children = [i for i, p in enumerate(model.parent) if p == body]
    if frame == model.joint_names[body]:
        return model.inertia[body], children
    links = {name: f for name, f in model.frames.items() if f.body == body}
    whole = [f.inertia.transform(f.placement) for f in links.values() if f.inertia is not None]
    total = sum(whole, SpatialInertia.zero()).matrix()
    expected = total if body == 0 else model.inertia[body].matrix()
    off = np.abs(total - expected).max()
    if len(whole) < len(links) or not off <= SAME_RTOL * np.abs(expected).max():
        raise ModelError(
            f"frame {frame!r}: which part of the body of joint {model.joint_names[body]!r} is beyond it is not known; "
            "expected a model from load or Builder, not rerooted, and no inertia replaced as a whole: "
            "attach(model, tool, frame) adds what a frame carries"
        )
    welded = {name for name in links if frame in _carriers(links, name)}
    parts = [part for name, part in zip(links, whole) if name in welded]
    inertia = sum(parts, SpatialInertia.zero())
    return inertia, [i for i in children if model.frames[model.joint_names[i]].parent in welded]


def _carriers(links: Mapping[str, Frame], name: str | None) -> Iterator[str]:
    """Yield a frame of a body, the one that it hangs on, and so on to the joint."""
    while name is not None and name in links:
        yield name
        name = links[name].parent

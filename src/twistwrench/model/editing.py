"""A model made of others: one fixed to a frame of another, or one with the inertia of a body replaced (49.5)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import as_flag, check_kind
from ..errors import ModelError
from ..spatial import SE3, SpatialInertia
from .arguments import check_model
from .checks import PER_DOF
from .model import Frame, Model
from .reduction import lock_joints
from .report import LoadReport

__all__ = ["attach", "replace_inertia"]


def attach(model: Model, other: Model, frame: str | None, *, placement: SE3 | None = None, prefix: str = "") -> Model:
    """Weld the base of another model to a frame: a gripper to an arm, an arm to a mobile base; or let it float beside.

    Parameters
    ----------
    model : Model
    other : Model
        With a floating base, whose root link is welded on: ``tw.load(file, base="floating")``.
    frame : str or None
        Of `model`. None for what is not welded, and floats in the same world: two robots in one model.
    placement : SE3, optional
        Of the root link of `other` in that frame, or of where its base is at zero in the world; the identity unless
        given.
    prefix : str
        Put before every name of `other`, so that two hands can hang on one robot.

    Returns
    -------
    Model
        Its q and v are those of `model`, then those of `other`, without its base if that is welded.

    Raises
    ------
    NameNotFound
        If `model` has no such frame.
    ModelError
        If `other` has a fixed base, or a name is taken in `model`.
    TypeError
        If an argument is of another type.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm, palm = tw.load("planar_arm"), SpatialInertia.from_box(1, [0.1, 0.1, 0.02])
    >>> hand = tw.Builder("hand", base="floating", root_inertia=palm)
    >>> hand.link("finger", parent="base_link", joint=tw.Revolute("x"), inertia=SpatialInertia.from_rod(0.1, 0.2))
    >>> both = attach(arm, hand.build(), "tool", prefix="left_")
    >>> both.joint_names[1:], round(both.mass - arm.mass, 12)
    (('shoulder', 'elbow', 'wrist', 'left_finger'), 1.1)
    """
    check_model(model)
    check_kind(other, "other", Model, "a Model")
    check_kind(prefix, "prefix", str, "a string")
    placement = SE3.identity() if placement is None else placement
    check_kind(placement, "placement", SE3, "an SE3")
    if other.base != "floating":
        raise ModelError("other: expected a floating base: a fixed one has dropped the mass of its root link")
    carrier = Frame(0, SE3.identity()) if frame is None else model.frame(frame)
    n = model.nbodies - 1
    at = carrier.placement @ placement
    root = prefix + other.joint_names[1]
    taken = {*model.joint_names, *model.frames}
    while root in taken:
        root += "_"
    frames = {prefix + name: _carried(f, n, prefix) for name, f in other.frames.items() if f.body > 0}
    of_root = frames.pop(prefix + other.joint_names[1], None)  # where it is welded, its joint is gone
    hangs_on = frame if of_root is None or frame is not None else root
    for name, f in frames.items():
        if f.parent == prefix + other.joint_names[1]:
            frames[name] = replace(f, parent=hangs_on)
    frames |= {root: of_root} if of_root is not None and frame is None else {}
    names = [prefix + name for name in other.joint_names[2:]]
    if clash := sorted(taken & {*names, *frames}):
        raise ModelError(f"the name {clash[0]!r} is taken in model {model.name!r}: prefix= keeps the two apart")
    over = ("lower", "upper", *PER_DOF)
    limits: dict[str, Any] = {x: np.concatenate([getattr(model, x), getattr(other, x)]) for x in over}
    whole = replace(
        model,
        joint_names=(*model.joint_names, root, *names),
        joints=(*model.joints, *other.joints[1:]),
        parent=(*model.parent, carrier.body, *(p + n for p in other.parent[2:])),
        placement=(*model.placement, at, *other.placement[2:]),
        inertia=(*model.inertia, *other.inertia[1:]),
        frames={**model.frames, **frames},
        postures={name: np.concatenate([q, other.neutral()]) for name, q in model.postures.items()},
        feet=(*model.feet, *(prefix + foot for foot in other.feet)),
        report=LoadReport([*model.report, *other.report]),
        **limits,
    )
    return lock_joints(whole, [root], whole.neutral()).model if frame is not None else whole


def _carried(frame: Frame, n: int, prefix: str) -> Frame:
    """Return a frame as it is after n other bodies, with the prefix before names."""
    parent = None if frame.parent is None else prefix + frame.parent
    return replace(frame, body=frame.body + n, parent=parent)


def replace_inertia(model: Model, frame: str, inertia: SpatialInertia, *, physical: bool = True) -> Model:
    """Give the body that carries a frame another inertia: a measured one, or one with a payload.

    Parameters
    ----------
    model : Model
    frame : str
        Links welded together are one body: it is replaced as a whole. What is there now is
        ``model.inertia[model.frame(frame).body]``, in the body's frame.
    inertia : SpatialInertia
        In this frame.
    physical : bool
        Reject an inertia with which no body can exist.

    Returns
    -------
    Model

    Raises
    ------
    NameNotFound
        If there is no such frame.
    ModelError
        If the frame is fixed to the world, or no such body can exist.
    TypeError, ShapeError
        If `inertia` is not a SpatialInertia, or a batch of them.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm")
    >>> body = arm.frame("tool").body
    >>> loaded = replace_inertia(arm, "wrist", arm.inertia[body] + SpatialInertia.from_point(2.0, [0, 0, -0.2]))
    >>> round(loaded.mass - arm.mass, 12)
    2.0
    """
    check_model(model)
    physical = as_flag(physical, "physical")
    check_kind(inertia, "inertia", SpatialInertia, "a SpatialInertia")
    at = model.frame(frame)
    if at.body == 0:
        raise ModelError(f"frame {frame!r}: it is fixed to the world, which has no inertia")
    if physical:
        inertia.check_physical(frame)
    there = inertia.transform(at.placement)
    return replace(model, inertia=(*model.inertia[: at.body], there, *model.inertia[at.body + 1 :]))

"""Models converted to Pinocchio and back (section 49.11).

Bodies, joint ids and q are the same on both sides, entry for entry; limits and armature over v are
reordered like v.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from ..arrays import Array
from ..errors import ModelError
from ..model import AxisJoint, Continuous, Frame, FreeFlyer, Joint, Model, check_model
from ..spatial import SE3, SpatialInertia
from .objects import (
    from_pinocchio_inertia,
    from_pinocchio_se3,
    import_pinocchio,
    to_pinocchio_inertia,
    to_pinocchio_se3,
)
from .tangent import tangent_order

__all__ = ["from_pinocchio_model", "to_pinocchio_model"]

AXES = {(1.0, 0.0, 0.0): "X", (0.0, 1.0, 0.0): "Y", (0.0, 0.0, 1.0): "Z"}

FRAME_KINDS = {"BODY": "link", "JOINT": "joint", "FIXED_JOINT": "joint", "SENSOR": "sensor"}
"""The prefixes of frames of one name at different places."""

ONE_CONTINUOUS_JOINT = """<robot name="one"><link name="from"/><link name="to"/>
<joint name="turn" type="continuous"><parent link="from"/><child link="to"/><axis xyz="{} {} {}"/></joint></robot>"""


def to_pinocchio_model(model: Model) -> Any:
    """Return a model as ``pin.Model``.

    Parameters
    ----------
    model : Model

    Returns
    -------
    pin.Model
        Joints with the same ids and the same q; placements, inertias, armature, damping, friction, gravity,
        limits, named configurations. Every frame has one name: that of a joint is a JOINT frame, all others are
        OP_FRAMEs, since a `Model` does not keep which of them were links (``"link:a"`` and ``"joint:a"`` become
        the BODY and the joint frame ``"a"`` again). `Model.feet` is dropped: Pinocchio has no place for it.

    Raises
    ------
    ImportError
        If Pinocchio is missing.
    ModelError
        If a joint is of a kind that Pinocchio lacks.

    Notes
    -----
    Equal to the last bit, but for the axis of a continuous joint that is not x, y or z: Pinocchio's
    Python offers such a joint only by way of a URDF, and normalises the axis again.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> there = to_pinocchio_model(model)
    >>> (there.nq, there.nv, there.njoints) == (model.nq, model.nv, model.nbodies)
    True
    """
    check_model(model)
    pin, order = import_pinocchio(), tangent_order(model.joints)
    effort, velocity = model.effort_limit[order], model.velocity_limit[order]
    there = pin.Model()
    there.name = model.name
    for i, joint in enumerate(model.joints):
        if joint is None:
            continue
        qs, vs = model.q_slice[i], model.v_slice[i]
        limits = effort[vs], velocity[vs], model.lower[qs], model.upper[qs]
        name, placement = model.joint_names[i], to_pinocchio_se3(model.placement[i])
        there.addJoint(model.parent[i], _joint_there(pin, joint, name), placement, name, *limits)
    there.armature, there.damping = model.armature[order], model.damping[order]
    there.lowerDryFrictionLimit, there.upperDryFrictionLimit = -model.friction[order], model.friction[order]
    there.gravity = pin.Motion(model.gravity.copy(), np.zeros(3))
    _frames_there(pin, model, there)
    for i in range(1, model.nbodies):  # last: each frame adds an inertia of its own, and adding zero rounds
        there.inertias[i] = to_pinocchio_inertia(model.inertia[i])
    for name, q in model.postures.items():
        there.referenceConfigurations[name] = q
    return there


def _joint_there(pin: Any, joint: Joint, name: str) -> Any:
    """Return the joint as one of Pinocchio's joint models, the aligned one where there is one."""
    names = joint.pinocchio if Joint.kinds.get(joint.kind) is type(joint) else ()
    if not names:
        known = ", ".join(kind.__name__ for kind in Joint.kinds.values() if kind.pinocchio)
        raise ModelError(f"joint {name!r}: Pinocchio has no {type(joint).__name__}; it has {known}")
    others = [getattr(joint, constant) for constant in _constants(type(joint))]
    if not isinstance(joint, AxisJoint):
        return getattr(pin, "JointModel" + names[0])(*others)
    aligned, unaligned = names
    if joint.axis in AXES:
        return getattr(pin, "JointModel" + aligned + AXES[joint.axis])(*others)
    if isinstance(joint, Continuous):  # its constructor takes no axis
        return pin.buildModelFromXML(ONE_CONTINUOUS_JOINT.format(*joint.axis)).joints[1]
    return getattr(pin, "JointModel" + unaligned)(np.array(joint.axis), *others)


def _names(kind: type[Joint]) -> list[str]:
    """Return Pinocchio's names of a kind of joint."""
    if not issubclass(kind, AxisJoint) or not kind.pinocchio:
        return list(kind.pinocchio)
    aligned, unaligned = kind.pinocchio
    return [*(aligned + axis for axis in AXES.values()), unaligned]


def _constants(kind: type[Joint]) -> list[str]:
    """Return the names of a joint's constants besides its axis."""
    return [field.name for field in fields(kind) if field.name != "axis"] if is_dataclass(kind) else []


def _frames_there(pin: Any, model: Model, there: Any) -> None:
    """Add a frame per name; what a body carries hangs on its joint's frame."""
    kinds = pin.FrameType
    of_joint = [0]  # the index of each joint's frame; the world's is 0
    for i in range(1, model.nbodies):
        of_joint.append(there.addJointFrame(i, of_joint[model.parent[i]]))
    for name, frame in model.frames.items():
        kind, _, bare = name.rpartition(":")
        if kind in ("", "joint") and bare in model.joint_names and model.joint_id(bare) == frame.body:
            continue
        apart = f"link:{bare}" in model.frames and f"joint:{bare}" in model.frames
        known = {"link": kinds.BODY, "joint": kinds.FIXED_JOINT} if apart else {}
        shown = bare if kind in known else name
        placement = to_pinocchio_se3(frame.placement)
        there.addFrame(pin.Frame(shown, frame.body, of_joint[frame.body], placement, known.get(kind, kinds.OP_FRAME)))


def from_pinocchio_model(there: Any) -> Model:
    """Return a ``pin.Model`` as `Model`.

    Parameters
    ----------
    there : pin.Model

    Returns
    -------
    Model
        Bodies with the same ids and the same q; placements, inertias, armature, gravity, frames and named
        configurations. Limits of velocity and effort are Pinocchio's upper ones; its largest double is
        infinity; friction is the upper limit of Pinocchio's. What is welded to the world and rotors given apart
        from the armature take no part in the chapter's dynamics and are left out.

    Raises
    ------
    ModelError
        If a joint has no counterpart here (mimic, composite, universal, …; all are listed by name and type),
        gravity turns or is not finite, an inertia, a placement, a limit, an armature or a named configuration
        is invalid, two joints have one name, or two frames one name and kind.
    TypeError
        If `there` is not a pin.Model.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from_pinocchio_model(to_pinocchio_model(tw.load("go2")))
    Model 'go2': floating base, 13 moving bodies, nq = 19, nv = 18, 16.085 kg
    """
    if not isinstance(there, import_pinocchio().Model):
        package = type(there).__module__.partition(".")[0]
        raise TypeError(f"there: expected a pin.Model, got {package}'s {type(there).__name__}")
    joints = _joints_here(there)
    moving, names, order = range(1, len(joints)), tuple(there.names), tangent_order(joints)
    if there.gravity.angular.any() or not np.isfinite(there.gravity.linear).all():
        raise ModelError(f"gravity: expected a finite acceleration without rotation, got {there.gravity.vector} (v, ω)")
    placement = [_named(from_pinocchio_se3, there.jointPlacements[i], names[i], "placement") for i in moving]
    inertia = [_named(from_pinocchio_inertia, there.inertias[i], names[i], "inertia of its body") for i in moving]
    model = Model(
        name=there.name,
        base="floating" if len(joints) > 1 and isinstance(joints[1], FreeFlyer) else "fixed",
        joint_names=names,
        joints=joints,
        parent=(-1, *(int(there.parents[i]) for i in moving)),
        placement=(SE3.identity(), *placement),
        inertia=(SpatialInertia.zero(), *inertia),
        frames=_frames_here(there),
        gravity=there.gravity.linear,
        armature=there.armature[order],
        damping=there.damping[order],
        friction=there.upperDryFrictionLimit[order],
        lower=_limits(there.lowerPositionLimit),
        upper=_limits(there.upperPositionLimit),
        velocity_limit=_limits(there.velocityLimit[order]),
        effort_limit=_limits(there.effortLimit[order]),
    )
    postures = {entry.key(): entry.data() for entry in there.referenceConfigurations}
    for name, q in postures.items():
        _named(model.state, q, name, "named configuration")
    return replace(model, postures=postures)


def _joints_here(there: Any) -> tuple[Joint | None, ...]:
    """Return the joints; the axis is read off the motion subspace, which every joint has."""
    neutral = import_pinocchio().neutral(there)
    known = {name: kind for kind in Joint.kinds.values() for name in _names(kind)}
    joints: list[Joint | None] = [None]
    unknown = []
    for name, model in zip(list(there.names)[1:], list(there.joints)[1:], strict=True):
        full = model.shortname().removeprefix("JointModel")
        kind = known.get(full)
        if kind is None:
            unknown.append(f"{name!r} ({full})")
            continue
        constants: list[Any] = [getattr(model.extract(), constant) for constant in _constants(kind)]
        if issubclass(kind, AxisJoint):
            data = model.createData()
            model.calc(data, neutral)
            v, w = np.split(np.ravel(data.S), 2)  # Pinocchio's order
            constants.insert(0, w if w.any() else v)
        joints.append(kind(*constants))
    if unknown:
        raise ModelError(f"joints without a counterpart: {', '.join(unknown)}; those that have one: {', '.join(known)}")
    return tuple(joints)


def _frames_here(there: Any) -> dict[str, Frame]:
    """Return the frames by name, or by kind and name where frames of one name differ in place (as `Builder` does)."""
    found: dict[str, dict[str, Frame]] = {}
    for frame in list(there.frames)[1:]:  # the first is the universe
        placement = _named(from_pinocchio_se3, frame.placement, frame.name, "placement")
        same_name, kind = found.setdefault(frame.name, {}), FRAME_KINDS.get(str(frame.type), "frame")
        if kind in same_name:
            raise ModelError(f"{frame.name!r}: two {kind}s of one name")
        same_name[kind] = Frame(int(frame.parentJoint), placement)
    frames = {}
    for name, same_name in found.items():
        first = next(iter(same_name.values()))
        if all(other == first for other in same_name.values()):
            frames[name] = first
        else:
            frames |= {f"{kind}:{name}": frame for kind, frame in same_name.items()}
    return frames


def _named(convert: Callable[[Any], Any], value: Any, name: str, what: str) -> Any:
    """Convert, and name the place in the error."""
    try:
        return convert(value)
    except ValueError as error:
        raise ModelError(f"{name!r}: {what}: {error}") from None


def _limits(x: Array) -> Array:
    """Return limits; Pinocchio's largest double becomes infinity."""
    return np.where(np.abs(x) >= np.finfo(np.float64).max, np.copysign(np.inf, x), x)

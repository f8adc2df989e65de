"""Models from MuJoCo: whatever it can load is a `Model` (docs/conventions.md has both side by side).

Nothing here imports MuJoCo: an MjModel is arrays.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import Array
from ..errors import ModelError
from ..model import WORLD, Entry, Frame, FreeFlyer, Joint, LoadReport, Model, Prismatic, Revolute, Spherical
from ..spatial import SE3, SpatialInertia, quaternion_to_rotation
from .mujoco_actuators import Drives, read_actuators
from .mujoco_states import SCALAR_LAST, from_mujoco_configuration
from .spatial import HALVES

__all__ = ["from_mujoco_model"]

FREE, BALL, SLIDE = 0, 1, 2
FRICTIONLOSS_DISABLED, LIMIT_DISABLED, DAMPER_DISABLED, GRAVITY_DISABLED = 1 << 2, 1 << 3, 1 << 6, 1 << 7
LEFT_OUT = {
    "neq": "equality constraints",
    "ntendon": "tendons",
    "nflex": "flexible bodies",
    "nplugin": "plugins",
    "nplastic": "springs that yield",
}
"""What has forces of its own in MuJoCo and none here, by its count in an MjModel."""


def from_mujoco_model(there: Any) -> Model:
    """Return a ``mujoco.MjModel`` as `Model`.

    Parameters
    ----------
    there : mujoco.MjModel
        From MJCF, URDF or MuJoCo's own builder.

    Returns
    -------
    Model
        Joints in MuJoCo's order and with its angles. A body with several joints becomes a chain with massless links, a
        body without one a part of its parent. Bodies, joints and sites are frames; keyframes are named postures;
        armature, ranges, damping and friction loss are read, and of the actuators the limits of effort, armature and
        damping. What has forces in MuJoCo and none here stands in `Model.report`: springs, tendons, equality
        constraints, fluids, compensation of gravity, what the actuators are told. Contacts are not part of a model.

    Raises
    ------
    TypeError
        If `there` is not an MjModel.
    ModelError
        If the armature, damping or friction of a free joint depends on the direction in the world.

    Examples
    --------
    >>> import mujoco
    >>> rod = '''<mujoco model="rod"><worldbody><body><joint name="hinge" axis="0 1 0"/>
    ... <geom type="capsule" fromto="0 0 0 0 0 -1" size="0.02" mass="2"/></body></worldbody></mujoco>'''
    >>> from_mujoco_model(mujoco.MjModel.from_xml_string(rod))
    Model 'rod': fixed base, 1 moving body, nq = 1, nv = 1, 2 kg
    """
    if type(there).__name__ != "MjModel":
        raise TypeError(f"there: expected a mujoco.MjModel, got {type(there).__name__}")
    joints: list[Joint | None] = [None]
    parent, placement, inertia = [-1], [SE3.identity()], [SpatialInertia.zero()]
    carrier, at = [0], [SE3.identity()]  # of each of MuJoCo's bodies: the body here, and its place in that
    for b in range(1, there.nbody):
        up = there.body_parentid[b]
        body, T = carrier[up], at[up] @ _placed(there.body_pos[b], there.body_quat[b])
        for j in range(there.body_jntadr[b], there.body_jntadr[b] + there.body_jntnum[b]):
            joint, anchor = _joint(there, j), SE3(np.eye(3), there.jnt_pos[j])
            parent.append(body)
            # q of a free joint is its place in the world; that of the others is counted from qpos0.
            placement.append(SE3.identity() if there.jnt_type[j] == FREE else T @ anchor @ _back(there, j, joint))
            joints.append(joint)
            inertia.append(SpatialInertia.zero())
            body, T = len(joints) - 1, SE3.identity() if there.jnt_type[j] == FREE else anchor.inverse()
        carrier.append(body)
        at.append(T)
        if body > 0:
            own = SpatialInertia(there.body_mass[b], np.zeros(3), np.diag(there.body_inertia[b]))
            inertia[body] += own.transform(T @ _placed(there.body_ipos[b], there.body_iquat[b]))
    names = [WORLD, *(there.joint(j).name or f"joint{j}" for j in range(there.njnt))]
    drives = read_actuators(there)
    limits = np.concatenate([np.zeros((2, 0)), *(_limits(there, j) for j in range(there.njnt))], axis=-1)
    model = Model(
        name=there.names[: there.names.find(b"\0")].decode(),
        base="floating" if joints[1:] and isinstance(joints[1], FreeFlyer) else "fixed",
        joint_names=tuple(names),
        joints=tuple(joints),
        parent=tuple(parent),
        placement=tuple(placement),
        inertia=tuple(inertia),
        frames=dict(_frames(there, names, carrier, at)),
        gravity=there.opt.gravity * (not there.opt.disableflags & GRAVITY_DISABLED),
        lower=limits[0],
        upper=limits[1],
        velocity_limit=np.full(there.nv, np.inf),
        report=LoadReport([*_left_out(there, names), *drives.remarks]),
        **_per_dof(there, names, joints, drives),
    )
    keys = {there.key(k).name or f"key{k}": there.key_qpos[k] for k in range(there.nkey)}
    return replace(model, postures={k: model.normalize(from_mujoco_configuration(model, q)) for k, q in keys.items()})


def _placed(position: Array, quaternion: Array) -> SE3:
    return SE3(quaternion_to_rotation(quaternion[SCALAR_LAST]), position)


def _joint(there: Any, j: int) -> Joint:
    match there.jnt_type[j]:
        case 0:
            return FreeFlyer()
        case 1:
            return Spherical()
        case 2:
            return Prismatic(there.jnt_axis[j])
    return Revolute(there.jnt_axis[j])


def _back(there: Any, j: int, joint: Joint) -> SE3:
    """Return the placement that takes back the angle or length at which MuJoCo's bodies are given."""
    if there.jnt_type[j] == BALL:
        return SE3.identity()
    return joint.transform(-there.qpos0[there.jnt_qposadr[j]].reshape(1))


def _limits(there: Any, j: int) -> Array:
    """Return the lower and the upper limits, shape (2, nq of the joint)."""
    one = there.jnt_type[j] >= SLIDE
    if one and there.jnt_limited[j] and not there.opt.disableflags & LIMIT_DISABLED:
        return np.array(there.jnt_range[j])[:, None]
    return np.outer([-np.inf, np.inf], np.ones(_joint(there, j).nq))


def _frames(there: Any, names: list[str], carrier: list[int], at: list[SE3]) -> Iterator[tuple[str, Frame]]:
    """Yield bodies, joints and sites by name; by kind and name where an earlier one has the name at another place."""
    found: dict[str, Frame] = {}
    everything = [("body", there.body(b).name, Frame(carrier[b], at[b])) for b in range(1, there.nbody)]
    everything += [("joint", name, Frame(i, SE3.identity())) for i, name in enumerate(names) if i > 0]
    for k in range(there.nsite):
        b, T = there.site_bodyid[k], _placed(there.site_pos[k], there.site_quat[k])
        everything.append(("site", there.site(k).name, Frame(carrier[b], at[b] @ T)))
    for kind, name, frame in everything:
        own = name if found.get(name, frame) == frame else f"{kind}:{name}"
        if name:
            found[own] = frame
            yield own, frame


def _per_dof(there: Any, names: list[str], joints: list[Joint | None], drives: Drives) -> dict[str, Any]:
    """Return armature, damping, friction and limits of effort in our order; MuJoCo's free joints begin with v."""
    order = np.arange(there.nv)
    off = there.opt.disableflags
    sums = {
        "armature": there.dof_armature + drives.armature,
        "damping": there.dof_damping * (not off & DAMPER_DISABLED) + drives.damping,
        "friction": there.dof_frictionloss * (not off & FRICTIONLOSS_DISABLED),
        "effort_limit": drives.effort_limit,
    }
    arrays: dict[str, Any] = {}
    for joint, start in zip(joints[1:], there.jnt_dofadr):
        if isinstance(joint, FreeFlyer):
            order[start : start + 6] = start + HALVES
    for key, values in sums.items():
        arrays[key] = values[order]
        for name, joint, start in zip(names[1:], joints[1:], there.jnt_dofadr):
            linear = arrays[key][start + 3 : start + 6]
            if isinstance(joint, FreeFlyer) and (linear != linear[0]).any():
                raise ModelError(f"joint {name!r}: expected one {key} in all directions, got {linear}")
    return arrays


def _left_out(there: Any, names: list[str]) -> Iterator[Entry]:
    """Yield what exerts forces in MuJoCo and none here."""
    for count, what in LEFT_OUT.items():
        if getattr(there, count):
            yield Entry("the file", f"{getattr(there, count)} {what}", "left out")
    for name in ("density", "viscosity"):
        if getattr(there.opt, name):
            yield Entry("the file", f"a fluid of {name} {getattr(there.opt, name):g}", "left out")
    for j in np.flatnonzero(there.jnt_limited.astype(bool) & (there.jnt_type == BALL)):
        yield Entry(f"joint {names[j + 1]!r}", f"a ball that turns at most {there.jnt_range[j, 1]:g} rad", "no limit")
    for j in np.flatnonzero(there.jnt_stiffness):
        yield Entry(f"joint {names[j + 1]!r}", f"a spring of stiffness {there.jnt_stiffness[j]:g}", "left out")
    for j in np.flatnonzero(_polynomial(there, "jnt_stiffness", there.njnt)):
        yield Entry(f"joint {names[j + 1]!r}", "a spring whose stiffness changes", "left out")
    for j in sorted({*there.dof_jntid[_polynomial(there, "dof_damping", there.nv)]}):
        yield Entry(f"joint {names[j + 1]!r}", "damping that changes with speed", "its constant part")
    for b in np.flatnonzero(there.body_gravcomp):
        yield Entry(f"body {there.body(b).name!r}", f"gravity compensated by {there.body_gravcomp[b]:g}", "left out")


def _polynomial(there: Any, name: str, count: int) -> Array:
    """Return where a number has terms of higher order, which MuJoCo has had since version 4."""
    found: Array = np.any(getattr(there, f"{name}poly", np.zeros((count, 1))), axis=-1)
    return found

"""What the actuators of an MjModel are for a `Model`: limits of effort, rotors and friction of its joints.

What they are told to do is not part of a model. An actuator drives a joint by its gear g: its force f, its armature I
and its damping d are g f, g² I and g² d at the joint.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..arrays import Array
from ..model import Entry

__all__ = ["Drives", "read_actuators"]

JOINT, JOINT_IN_PARENT = 0, 1
DRIVEN = ("a joint", "a joint", "a crank", "a tendon", "a site", "a body", "a rotation")
BALL, SLIDE, HINGE = 1, 2, 3
CONTROLS_NOT_CLAMPED = 1 << 8
EVERYTHING = np.array([-np.inf, np.inf])


class Drives(NamedTuple):
    """What actuators do to each degree of freedom, in MuJoCo's order, and the report of what is left out."""

    effort_limit: Array
    armature: Array
    damping: Array
    remarks: list[Entry]


def read_actuators(there: Any) -> Drives:
    """Return what the actuators of a ``mujoco.MjModel`` are for the degrees of freedom that they drive.

    Parameters
    ----------
    there : mujoco.MjModel

    Returns
    -------
    Drives
        The efforts of several actuators of one joint add up; the joint's ``actuatorfrcrange`` bounds their sum.
    """
    count = len(there.actuator_trntype)
    remarks = [Entry("the file", _counted(count), "limits of effort; what they are told is left out")] * (count > 0)
    efforts, driven = np.zeros((there.nv, 2)), np.zeros(there.nv, dtype=bool)
    armature, damping = np.zeros(there.nv), np.zeros(there.nv)
    endless: list[tuple[str, Array]] = []
    for k in range(count):
        where = f"actuator {there.actuator(k).name or k!r}"
        if not _drives_a_joint(there, k):
            remarks.append(Entry(where, _drives_what(there, k), "left out"))
            continue
        dofs, gear = _driven(there, k)
        force = _force_range(there, k)
        if np.isinf(force).any():
            endless.append((where, dofs))
        efforts[dofs] += np.sort(np.multiply.outer(gear, force), axis=-1)
        driven[dofs] = True
        if np.any(getattr(there, "actuator_dampingpoly", np.zeros(count))[k]):
            remarks.append(Entry(where, "damping that changes with speed", "its constant part"))
        rotor, friction = (_read_actuator(there, key, k) for key in ("armature", "damping"))
        if len(dofs) > 1 and (rotor or friction):
            remarks.append(Entry(where, "armature or damping about an oblique axis of a ball", "left out"))
            continue
        armature[dofs] += gear**2 * rotor
        damping[dofs] += gear**2 * friction
    efforts[~driven] = EVERYTHING
    for j in np.flatnonzero(there.jnt_actfrclimited):
        dof = there.jnt_dofadr[j]
        efforts[dof] = np.clip(efforts[dof], *there.jnt_actfrcrange[j])
    limit = np.abs(efforts).max(axis=-1)
    for where, dofs in endless:
        if np.isinf(limit[dofs]).any():
            remarks.append(Entry(where, "a force without a limit", "no limit of effort"))
    for dof, (lower, upper) in enumerate(efforts):
        if np.isclose(-lower, upper, rtol=1e-12, atol=0):
            continue
        name = there.joint(there.dof_jntid[dof]).name or f"joint{there.dof_jntid[dof]}"
        remarks.append(Entry(f"joint {name!r}", f"efforts from {lower:g} to {upper:g}", f"effort limit {limit[dof]:g}"))
    return Drives(limit, armature, damping, remarks)


def _counted(count: int) -> str:
    return f"{count} actuator{'s' * (count != 1)}"


def _read_actuator(there: Any, key: str, k: int) -> float:
    """Return a number of an actuator that MuJoCo has had since version 4; 0 before."""
    values = getattr(there, f"actuator_{key}", None)
    return 0.0 if values is None else float(values[k])


def _drives_a_joint(there: Any, k: int) -> bool:
    """Return whether an actuator has one control and one force, along axes that are those of our degrees of freedom."""
    if any(getattr(there, f"actuator_{key}", np.ones(k + 1))[k] > 1 for key in ("ctrlnum", "outnum")):
        return False  # since MuJoCo 4
    kind, joint = there.actuator_trntype[k], there.jnt_type[there.actuator_trnid[k, 0]]
    return bool((joint in (SLIDE, HINGE) and kind in (JOINT, JOINT_IN_PARENT)) or (joint == BALL and kind == JOINT))


def _driven(there: Any, k: int) -> tuple[Array, Array]:
    """Return the degrees of freedom that an actuator drives, each with its gear."""
    j = there.actuator_trnid[k, 0]
    gear = there.actuator_gear[k][: 3 if there.jnt_type[j] == BALL else 1]
    axes = np.flatnonzero(gear)
    return there.jnt_dofadr[j] + axes, gear[axes]


def _drives_what(there: Any, k: int) -> str:
    kind = there.actuator_trntype[k]
    if kind not in (JOINT, JOINT_IN_PARENT):
        return f"drives {DRIVEN[kind] if kind < len(DRIVEN) else 'something else'}"
    j = there.actuator_trnid[k, 0]
    return f"drives joint {there.joint(j).name or f'joint{j}'!r} in axes of the world or its parent"


def _force_range(there: Any, k: int) -> Array:
    """Return the range of an actuator's force: its own, and that of its control where the force is gain × control."""
    force = EVERYTHING
    address = getattr(there, "actuator_ctrladr", range(k + 1))[k]
    clamped = there.actuator_ctrllimited[address] and not there.opt.disableflags & CONTROLS_NOT_CLAMPED
    proportional = there.actuator_gaintype[k] == there.actuator_dyntype[k] == 0
    biased = there.actuator_biastype[k] and there.actuator_biasprm[k].any()
    if clamped and proportional and not biased:
        force = np.sort(there.actuator_gainprm[k, 0] * there.actuator_ctrlrange[address])
    if there.actuator_forcelimited[k]:
        force = np.clip(force, *there.actuator_forcerange[k])
    return force

"""A model as a tree that unfolds, for notebooks."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .model import Model

__all__ = ["outline"]

UNFOLDED_JOINTS = 3
"""Depth in joints, from the world, to which the tree is unfolded."""


def outline(model: Model) -> str:
    """Return the tree of joints as HTML: of each its kind, the mass that moves with it, and its limits.

    Parameters
    ----------
    model : Model

    Returns
    -------
    str
    """
    return f"<div>{escape(repr(model))}{_branches(model, 0, 1)}</div>"


def _branches(model: Model, body: int, depth: int) -> str:
    """Return the branches that a body carries, as HTML."""
    return "".join(_branch(model, i, depth) for i in range(1, model.nbodies) if model.parent[i] == body)


def _branch(model: Model, i: int, depth: int) -> str:
    name = escape(model.joint_names[i])
    line = _facts(model, i)
    carried = _branches(model, i, depth + 1)
    if not carried:
        return f'<div style="margin-left:2.4em"><b>{name}</b> {line}</div>'
    unfolded = " open" * (depth < UNFOLDED_JOINTS)
    return f'<details{unfolded} style="margin-left:1.2em"><summary><b>{name}</b> {line}</summary>{carried}</details>'


def _facts(model: Model, i: int) -> str:
    """Return the kind of a joint, the mass of its body, and its limits where it has one degree of freedom."""
    joint = model.joints[i]
    said = []
    said.append(joint.kind if joint else "")
    said.append(f"{float(model.inertia[i].mass):.4g} kg")
    if (dof := model.v_slice[i]).stop - dof.start == 1 and np.isfinite(model.lower[model.q_slice[i]]).all():
        lower, upper = (float(x[model.q_slice[i]][0]) for x in (model.lower, model.upper))
        said.append(f"{lower:.3g} … {upper:.3g} {'m' if joint and joint.kind == 'prismatic' else 'rad'}")
    if dof.stop - dof.start == 1 and 0 < (most := float(model.effort_limit[dof][0])) < np.inf:
        said.append(f"± {most:.3g} {'N' if joint and joint.kind == 'prismatic' else 'N m'}")
    return ", ".join(said)

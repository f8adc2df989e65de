"""Pinocchio's values: the same robot, read by its own parser, computed by its own functions (49.11)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from .. import bridge
from ..arrays import Array
from ..errors import ModelError
from ..model import Model
from .states import States

__all__ = ["Oracle"]


class Oracle:
    """Pinocchio's model and data of a robot, and its results in the chapter's order.

    Parameters
    ----------
    ours : Model
    path : Path, optional
        The URDF of `ours`, for Pinocchio to read by itself. Without it the bridge hands
        the model over, and the loader goes unchecked.

    Raises
    ------
    ImportError
        If Pinocchio is not installed.
    ModelError
        If Pinocchio cannot read the file, or the two do not agree on the joints or their order.
    """

    def __init__(self, ours: Model, path: Path | None) -> None:
        self.pin = bridge.import_pinocchio()
        self.ours = ours
        if path is None:
            self.model = bridge.to_pinocchio_model(ours)
        else:
            root = (self.pin.JointModelFreeFlyer(),) if ours.base == "floating" else ()
            try:
                self.model = self.pin.buildModelFromUrdf(str(path), *root)
            except ValueError as error:
                raise ModelError(f"{path}: Pinocchio cannot read it: {error}") from None
            self.model.gravity.linear = ours.gravity
            self.model.armature = self.tangent(ours.armature)  # of Drake's rotors, which Pinocchio does not read
        self.data = self.model.createData()
        if tuple(self.model.names) != ours.joint_names:
            raise ModelError(
                f"{ours.name}: the joints differ: Pinocchio's {tuple(self.model.names)}, ours {ours.joint_names}"
            )

    def tangent(self, x: Array) -> Array:
        """Return a v, a or tau as Pinocchio takes it."""
        return bridge.to_pinocchio_tangent(self.ours, x)

    def vector(self, x: Array) -> Array:
        """Return a v, a or tau that Pinocchio gave. It may be NaN, which the bridge rejects."""
        return self._back(bridge.from_pinocchio_tangent, x)

    def matrix(self, x: Array) -> Array:
        """Return an M or C that Pinocchio gave."""
        return self._back(bridge.from_pinocchio_matrix, x)

    def jacobian(self, x: Array) -> Array:
        """Return a J or A_G that Pinocchio gave. Of one column it makes a vector."""
        return self._back(bridge.from_pinocchio_jacobian, np.reshape(x, (6, self.model.nv)))

    def _back(self, convert: Callable[[Model, Array], Array], x: Array) -> Array:
        return convert(self.ours, x) if np.isfinite(x).all() else np.full_like(x, np.nan)

    def placements(self, q: Array) -> list[Any]:
        """Return ``data.oMi``, world left out."""
        self.pin.forwardKinematics(self.model, self.data, q)
        return list(self.data.oMi)[1:]

    def motion(self, s: States) -> Any:
        """Return data after ``forwardKinematics`` with v and a."""
        self.pin.forwardKinematics(self.model, self.data, s.q, self.tangent(s.v), self.tangent(s.a))
        return self.data

    def wrenches(self, s: States) -> Array:
        """Return ``data.f`` after ``rnea``, world left out; shape (nbodies − 1, 6)."""
        self.pin.rnea(self.model, self.data, s.q, self.tangent(s.v), self.tangent(s.a))
        return bridge.from_pinocchio_force(list(self.data.f)[1:])

    def centroidal(self, s: States) -> Any:
        """Return data after the centroidal functions: com, Ag, hg, dhg."""
        arguments = self.model, self.data, s.q, self.tangent(s.v), self.tangent(s.a)
        self.pin.computeCentroidalMap(*arguments[:3])
        self.pin.computeCentroidalMomentumTimeVariation(*arguments)
        return self.data

    def frame(self, name: str) -> int:
        """Return the id of a frame. Of two apart with one name ours decides whether it is a link's or a joint's."""
        kind, _, bare = name.partition(":")
        types = self.pin.FrameType
        if self.model.existFrame(name, types.BODY):  # of a link and a joint of one name in one place, either
            found = self.model.getFrameId(name, types.BODY)
        elif self.model.existFrame(name):
            found = self.model.getFrameId(name)
        else:  # the number of frames for an unknown name
            kinds = [types.BODY] if kind == "link" else [types.JOINT, types.FIXED_JOINT]
            found = min(self.model.getFrameId(bare, kind) for kind in kinds)
        if found >= self.model.nframes:
            raise ModelError(f"{self.ours.name}: Pinocchio has no frame {name!r}")
        return int(found)

    def frame_placements(self, s: States) -> Array:
        """Return ``data.oMf`` of the frames, shape (frames, 4, 4)."""
        self.pin.framesForwardKinematics(self.model, self.data, s.q)
        return np.stack([self.data.oMf[self.frame(name)].homogeneous for name in s.frames])

    def frame_jacobians(self, s: States, reference: str) -> Array:
        """Return the Jacobians of the frames, shape (frames, 6, nv)."""
        self.pin.computeJointJacobians(self.model, self.data, s.q)
        self.pin.updateFramePlacements(self.model, self.data)
        where = self._reference(reference)
        J = [self.pin.getFrameJacobian(self.model, self.data, self.frame(name), where) for name in s.frames]
        return np.stack([self.jacobian(x) for x in J])

    def frame_bias(self, s: States, reference: str) -> Array:
        """Return J̇ v of the frames: the spatial acceleration, in LOCAL_WORLD_ALIGNED the classical one."""
        classical = reference == "local_world_aligned"
        rate = self.pin.getFrameClassicalAcceleration if classical else self.pin.getFrameAcceleration
        self.pin.forwardKinematics(self.model, self.data, s.q, self.tangent(s.v), np.zeros(self.model.nv))
        where = self._reference(reference)
        return np.stack(
            [bridge.from_pinocchio_motion(rate(self.model, self.data, self.frame(name), where)) for name in s.frames]
        )

    def _reference(self, reference: str) -> Any:
        return getattr(self.pin.ReferenceFrame, reference.upper())

    def static_equilibrium(self, s: States) -> Array:
        """Return (tau, contact forces) that hold the robot, from Pinocchio's g and Jacobians; shape (n + 3 k,)."""
        g = self.vector(self.pin.computeGeneralizedGravity(self.model, self.data, s.q))
        J = self.contact_jacobian(s)
        forces = np.linalg.lstsq(J[:, :6].mT, g[:6])[0]
        return np.concatenate([(g - J.mT @ forces)[6:], forces])

    def contact_jacobian(self, s: States) -> Array:
        """Return the linear rows at the feet, shape (3 k, nv)."""
        at_feet = replace(s, frames=self.ours.feet)
        return self.frame_jacobians(at_feet, "local_world_aligned")[:, 3:].reshape(-1, self.model.nv)

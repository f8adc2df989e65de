"""The scene: a robot, what holds it and what pushes it; and the dynamics of the smallest model that has all this."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from os import PathLike
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.kinematics import Reference, frame_placement
from ..algorithms.whole_body import QUANTITIES, Dynamics, select_quantities
from ..arrays import Array, as_number, check_kind
from ..contact import Contact
from ..errors import ModelError
from ..fast.quantity import Quantity
from ..model import FreeFlyer, Model, Planar, idle_joints, lock_joints, matching_joints
from ..motions import Motion
from ..motions.motion import as_motions
from .arguments import (
    Payload,
    add_payload,
    check_contacts,
    check_wrenches,
    expect_movable,
    posture,
    whole_robot,
)
from .candidates import candidates, limbs, radius_of_gyration, scene_candidate
from .costs import Costs, Tolerance, costs, read_tolerance
from .dynamics import scene_dynamics, scene_quantities
from .judging import ReferenceMotion
from .phases import Phase, phases
from .planar_base import PlanarBase
from .standing import Standing, standing

__all__ = ["Base", "Scene"]

Base = Literal["fixed", "floating", "planar"]


class Scene:
    """A robot, its contacts and loads, and the smallest model that moves in the same way.

    The smallest model, `model`, works with every function of the package. Held joints are locked in it, and the
    bodies that they connect are merged. Joints that carry nothing are removed. All frames remain.

    Parameters
    ----------
    robot : str, path or Model
        As `twistwrench.load` takes it, or a model.
    base : {"fixed", "floating", "planar"}, optional
        "fixed" holds the base where it is in q; "planar" lets it slide and turn on the floor. Default: the model's.
    contacts : iterable of Contact
        `PointContact` or `SurfaceContact`.
    hold : iterable of str
        Joints that are held still, by name or by a pattern such as ``"arm_*"``.
    q : array_like, shape (nq of the whole robot,), optional
        Posture of the held joints. Default: the standing posture, or else the neutral configuration.
    gravity : array_like, shape (3,), optional
        In the world, m/s²; the model's unless given.
    wrenches : mapping of str to array_like, shape (6,), optional
        Constant (τ, f) from outside on a frame: at its origin, in the axes of the world, N m and N.
    motors : iterable of str, optional
        Joints that have a motor, by name or by a pattern. Default: all whose effort limit is above zero, but a base,
        and joints that slide and turn on a plane or fly freely.
    payload : mapping of str to float, SpatialInertia or Model, optional
        What frames carry: a mass at the origin, kg; a body, in the axes of the frame; or an object with a floating
        base, whose root `attach` welds to the frame, with its name and ``"_"`` in front of the names of its frames.

    Attributes
    ----------
    model : Model
        The smallest model.
    full_model : Model
        The whole robot, with the scene's gravity and its payload.
    contacts : tuple of Contact
    held : tuple of str
        The joints that are held.
    idle : tuple of str
        The joints that were dropped because they carry nothing.
    q : ndarray, shape (nq of full_model,)
        Where the held and the dropped joints stand.
    wrenches : dict of str to ndarray, shape (6,)
    motors : tuple of str
        The joints of `model` that have a motor. Of all others the effort limit is zero.
    payload : mapping of str to float, SpatialInertia or Model

    Raises
    ------
    NameNotFound
        If a robot, a joint, a pattern or a frame is not known; the message lists those that are.
    ModelError
        If the scene is impossible: a base that the model cannot have; a contact, wrench or payload on a frame that is
        fixed to the world; two contacts at one place; nothing that can move; a payload that cannot exist.
    ShapeError, ValueError
        If a value is not a finite number or has the wrong shape; if friction is below zero.
    TypeError
        If an argument is of another type.

    Examples
    --------
    >>> import twistwrench as tw
    >>> soles = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), mu=0.7) for side in ("left", "right")]
    >>> scene = tw.Scene("humanoid", contacts=soles, hold=["*_shoulder_*", "*_elbow"])
    >>> scene
    <Scene 'humanoid': floating base, 2 contacts, 8 joints held, nv = 19 of 27>
    >>> d = scene.dynamics(scene.model.standing(), np.zeros(19), want={"M", "J_c"})
    >>> d.M.shape, d.J_c.shape, d.h
    ((19, 19), (12, 19), None)
    """

    def __init__(
        self,
        robot: str | PathLike[str] | Model,
        *,
        base: Base | None = None,
        contacts: Iterable[Contact] = (),
        hold: Iterable[str] = (),
        q: ArrayLike | None = None,
        gravity: ArrayLike | None = None,
        wrenches: Mapping[str, ArrayLike] | None = None,
        motors: Iterable[str] | None = None,
        payload: Mapping[str, Payload] | None = None,
    ) -> None:
        loaded = add_payload(whole_robot(robot, base, gravity), payload)
        strong, driven = _motors(loaded, motors)
        self.full_model = full = replace(loaded, effort_limit=strong)
        self.payload = dict(payload or {})
        self.q = posture(full, q)
        self.contacts = check_contacts(full, contacts)
        self.wrenches = check_wrenches(full, {} if wrenches is None else wrenches)
        self.held = _held(full, hold)
        self._base = base or full.base
        self._floor = PlanarBase.of(full, self.q) if base == "planar" else None
        before = self._floor.model if self._floor else full
        at = self._floor.reduce(self.q, np.zeros(full.nv))[0] if self._floor else self.q
        locked = {*self.held, *(full.joint_names[1:2] if (base, full.base) == ("fixed", "floating") else ())}
        touched = [*(frame for contact in self.contacts for frame in contact.frames), *self.wrenches]
        self.idle = idle_joints(lock_joints(before, locked, at).model, touched)
        self._reduction = lock_joints(before, {*locked, *self.idle}, at)
        self.model = self._reduction.model
        self.motors = tuple(name for name in self.model.joint_names if name in driven)
        if self.model.nv == 0:
            raise ModelError(f"{full.name!r}: nothing is left to move; every joint is held, or carries nothing")
        expect_movable(self.model, (contact.frame for contact in self.contacts), "contact on frame")
        expect_movable(self.model, self.wrenches, "wrench on frame")
        expect_movable(self.model, self.payload, "payload on frame")

    # ---------------------------------------------------------------- between the whole robot and the model

    def reduce(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return the state of `model` that belongs to one of `full_model`.

        The coordinates and velocities of the held joints are dropped; with a planar base also height,
        tilt and their rates. Accelerations are mapped as velocities are.

        Parameters
        ----------
        q : array_like, shape (..., nq of full_model)
        v : array_like, shape (..., nv of full_model)

        Returns
        -------
        (ndarray, ndarray), shapes (..., nq) and (..., nv)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        q, v = self.full_model.state(q, v=v)
        return self._reduction.reduce(*(self._floor.reduce(q, v) if self._floor else (q, v)))

    def expand(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Return the state of `full_model` that belongs to one of `model`: what is held stands still.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v : array_like, shape (..., nv)

        Returns
        -------
        (ndarray, ndarray), shapes (..., nq of full_model) and (..., nv of full_model)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        q, v = self._reduction.expand(q, v)
        return self._floor.expand(q, v) if self._floor else (q, v)

    @property
    def actuated(self) -> Array:
        """Which entries of v have a motor, bool of shape (nv,): those of `motors`, and none of a base."""
        names = np.repeat(self.model.joint_names, [s.stop - s.start for s in self.model.v_slice])
        return np.isin(names, self.motors)

    # ---------------------------------------------------------------- what a controller needs

    def dynamics(self, q: ArrayLike, v: ArrayLike, *, want: Iterable[str] = QUANTITIES) -> Dynamics:
        """Return what is wanted of M q̈ + h = Sᵀ τ + J_cᵀ λ, and nothing else.

        By a program for just this, made at the first call: see `twistwrench.fast`.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v : array_like, shape (..., nv)
        want : iterable of {"M", "h", "J_c", "A_G"}

        Returns
        -------
        Dynamics
            Of `model`. h holds the scene's wrenches: it is smaller by Σ Jᵀ (τ, f). J_c has the rows of each contact in
            the scene's order, in the axes of the world: (v) of a point, (ω, v) of a surface.

        Raises
        ------
        NameNotFound
            If `want` names anything else.
        ShapeError, SingularError, ValueError
            As `twistwrench.dynamics`.
        """
        return scene_dynamics(self.model, self.contacts, self.wrenches, q, v, select_quantities(want))

    def _quantities(self, dtype: np.dtype[Any], frames: tuple[str, ...], reference: Reference) -> dict[str, Quantity]:
        """Return what `twistwrench.compile` can make a program of, by symbol."""
        return scene_quantities(self.model, self.contacts, self.wrenches, dtype, frames, reference)

    def f_ext(self, q: ArrayLike) -> Array:
        """Return the scene's wrenches as `twistwrench.rnea` and `twistwrench.aba` take them, shape (..., nbodies, 6).

        Parameters
        ----------
        q : array_like, shape (..., nq)

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        (q,) = self.model.state(q)
        f = np.zeros((*q.shape[:-1], self.model.nbodies, 6), q.dtype)
        for name, wrench in self.wrenches.items():
            at = self.model.frame(name)
            R = frame_placement(self.model, q, name).rotation
            turned = np.concatenate([np.matvec(R.mT, wrench[:3]), np.matvec(R.mT, wrench[3:])], axis=-1)
            f[..., at.body, :] += np.matvec(at.placement.force_transform(), turned)
        return f

    def phases(self, motion: Motion) -> tuple[Phase, ...]:
        """Return who touches when: the phases of a motion, each with a scene of the contacts that stand in it.

        A contact of this scene stands when the foot on its frame does, or else all feet on its body; one on a body
        without feet (a hand on a rail) stands all the time.

        Parameters
        ----------
        motion : Motion
            Of the whole robot, `full_model`.

        Returns
        -------
        tuple of Phase

        Raises
        ------
        NameNotFound, ShapeError, ValueError
            As `Model.state`, where the motion is another robot's.

        Examples
        --------
        >>> import twistwrench as tw
        >>> go2 = tw.load("go2")
        >>> scene = tw.Scene(go2, contacts=[tw.PointContact(foot, mu=0.7) for foot in go2.feet])
        >>> [len(phase.scene.contacts) for phase in scene.phases(tw.motions.walk(go2, samples=60))]
        [4, 3, 4, 3, 4, 3, 4, 3, 4]
        """
        return phases(self, motion)

    # ---------------------------------------------------------------- whether it can stand, and what may be left out

    def can_stand(self, q: ArrayLike | None = None) -> Standing:
        """Return whether the robot can be at rest in a pose, and if not, why.

        It can if no joint is outside its limits, if forces within the friction cones of the contacts (as pyramids of 16
        sides inside them) hold it against its weight and the scene's wrenches, and if some of these forces leave no
        motor more than its limit. With a fixed base, an arm, the motors alone hold it where it has no contacts.

        Parameters
        ----------
        q : array_like, shape (nq,), optional
            Of `model`; the scene's own q unless given.

        Returns
        -------
        Standing
            True or False in a condition; printed, it gives the reason.

        Raises
        ------
        ValueError
            If there is no gravity, if the base is planar, or if it floats and there are no contacts.
        ShapeError
            As `Model.state`.

        Examples
        --------
        >>> import twistwrench as tw
        >>> feet = [tw.PointContact(f"{leg}_foot", mu=0.7) for leg in ("FL", "FR", "RL", "RR")]
        >>> print(tw.Scene("go2", contacts=feet).can_stand())
        it stands
        >>> print(tw.Scene("go2", contacts=feet[2:]).can_stand())
        cannot stand: ...
        """
        if self._base == "planar" or not (self.contacts or self._base == "fixed") or not self.model.gravity.any():
            raise ValueError(f"{self!r}: standing needs gravity, and a fixed base or a floating one with contacts")
        q = self.reduce(self.q, np.zeros(self.full_model.nv))[0] if q is None else posture(self.model, q)
        return standing(self.model, q, self.contacts, self.f_ext(q))

    def cheapest(
        self,
        tolerance: Tolerance,
        motion: Motion | Iterable[Motion],
        *,
        held_out: Motion | Iterable[Motion] = (),
        margin: float = 1.0,
        groups: Mapping[str, Iterable[str]] | None = None,
    ) -> Costs:
        """Return the error and the work of each smaller model on some motions, and the cheapest that is exact enough.

        The models are the templates of 49.10, the full model, and the full model with groups of joints held where the
        first motion begins: each group, any two, and all. A model that cannot be used is a row with the reason.

        Parameters
        ----------
        tolerance : float, or mapping of str to float
            The largest error that is allowed of each quantity: ``"wrench"``, ḣ_G, and ``"forces"``, at the worst
            contact, as shares of the weight; ``"cop"``, the centre of pressure, m; ``"tau"``, at the worst motor, N m,
            of all motors of the scene, or of the joints that ``"of"`` names: ``{"tau": 0.5, "of": ["*_knee"]}``. A
            model that lacks one of these does not do. A number alone is for the wrench.
        motion : Motion, or iterable of Motion
            Of the whole robot, `full_model`: `twistwrench.motions` makes some.
        held_out : Motion, or iterable of Motion, optional
            Motions that are not used for the choice; the table has the errors on them, too.
        margin : float, optional
            The largest errors, multiplied by this, must be within the tolerance; at least 1.
        groups : mapping of str to iterable of str, optional
            Names or patterns of joints to be held, by a name for each group. Default: the limbs that touch nothing.

        Returns
        -------
        Costs
            ``print`` shows the table, ``.plot()`` draws it; ``.best.model`` is the choice, and ``.best(q, v, a)`` its
            answer.

        Raises
        ------
        ValueError
            If a tolerance is below zero or of what the robot does not have; if the margin is below 1.
        SingularError
            If nothing that moves has mass.
        NameNotFound, ShapeError
            As `lock_joints` and `Model.state`; for an unknown quantity.

        Notes
        -----
        The work is the number of operations of the compiled program for one state. The wrench of the ground, ḣ_G minus
        the weight, is distributed among the closed contacts with the least forces f; the torques are τ − Jᵀ f. See
        docs/scenes.md.

        Examples
        --------
        >>> import twistwrench as tw
        >>> from twistwrench import motions
        >>> go2 = tw.load("go2")
        >>> scene = tw.Scene(go2, contacts=[tw.PointContact(foot, mu=0.7) for foot in go2.feet])
        >>> scene.cheapest(0.3, motions.walk(go2, samples=50)).best.predicts_torques
        False
        >>> scene.cheapest({"tau": 0.5, "cop": 0.01}, motions.walk(go2, samples=50)).best.name
        'full'
        """
        need, of = read_tolerance(tolerance)
        full = self.full_model
        needed = self.motors if of is None else matching_joints(full, of, "of")
        if idle := sorted({*needed} - {*self.motors, *_motors(full, None)[1]}):
            raise ModelError(f"of: {idle[0]!r} has no motor, so that its torque is not needed")
        if "tau" in need and not needed:
            raise ValueError(f"tolerance: 'tau' is nothing of {full.name!r}: no joint of the scene has a motor")
        motors = [k for name, s in zip(full.joint_names, full.v_slice) if name in needed for k in range(full.nv)[s]]
        ground = [c for c in self.contacts if c.pushes and c.to is None]
        borne = [*_motors(full, None)[1], *self.held]
        driven = np.isin(np.repeat(full.joint_names, [s.stop - s.start for s in full.v_slice]), borne)
        judged, unseen = (as_motions(full, x, name) for x, name in ((motion, "motion"), (held_out, "held_out")))
        if not judged:
            raise ValueError("motion: expected at least one motion, got none")
        if not 1 <= as_number(margin, "margin") < np.inf:
            raise ValueError(f"margin: expected a number of at least 1, got {margin!r}")
        if groups is None:
            feet = [contact.frame for contact in ground] or judged[0].feet
            whole = len(full.joint_names) - 1
            groups = {name: joints for name, joints in limbs(full, feet).items() if len(joints) < whole}
        check_kind(groups, "groups", Mapping, "names of joints by the name of a group")
        mine = scene_candidate(full, self.model, self._base, {*self.held, *self.idle}, self.reduce, self.wrenches)
        tried = [*candidates(full, judged[0].q[0], groups, ground, self.wrenches), *mine]
        length = radius_of_gyration(full, judged[0].q[0])
        judges = [
            [ReferenceMotion.of(full, one, self.contacts, self.wrenches, driven, length) for one in some]
            for some in (judged, unseen)
        ]
        return costs(full, judged, unseen, judges, need, margin, tried, np.array(motors, int))

    def __repr__(self) -> str:
        said = [f"{self._base} base"]
        for names, one, several in (
            (self.contacts, "contact", "contacts"),
            (self.wrenches, "wrench", "wrenches"),
            (self.payload, "payload", "payloads"),
            (self.held, "joint held", "joints held"),
            (self.idle, "joint that carries nothing dropped", "joints that carry nothing dropped"),
        ):
            if names:
                said.append(f"{len(names)} {one if len(names) == 1 else several}")
        return f"<Scene {self.full_model.name!r}: {', '.join(said)}, nv = {self.model.nv} of {self.full_model.nv}>"


def _motors(model: Model, motors: Iterable[str] | None) -> tuple[Array, set[str]]:
    """Return the effort limits, zero where there is no motor, and the joints that have one."""
    first = 2 if model.base == "floating" else 1
    joints = list(zip(model.joint_names, model.v_slice))[first:]
    able = {name for name, s in joints if model.effort_limit[s].any()}
    free = {name for name, joint in zip(model.joint_names, model.joints) if isinstance(joint, Planar | FreeFlyer)}
    driven = able - free
    if motors is not None:
        named = set(matching_joints(model, motors, "motors"))
        if weak := sorted(named - able):
            what = "a base has no motor" if weak[0] not in dict(joints) else "its effort limit is zero"
            raise ModelError(f"motors: {weak[0]!r}: {what}")
        driven = named
    limits = model.effort_limit.copy()
    for name, s in joints:
        if name not in driven:
            limits[s] = 0.0
    return limits, driven


def _held(model: Model, hold: Iterable[str]) -> tuple[str, ...]:
    """Return the joints that match; a floating base is not among them, as `base` decides about it."""
    held = matching_joints(model, hold, "hold")
    base = model.joint_names[1:2] if model.base == "floating" else ()
    if held and held == base:
        raise ModelError(f"hold: {base[0]!r} is the floating base; base='fixed' holds it")
    return tuple(name for name in held if name not in base)

"""What a robot carries: masses, bodies and objects welded to its frames (49.5)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ..arrays import as_number, check_kind
from ..errors import ModelError
from ..model import Model, attach
from ..spatial import SpatialInertia

__all__ = ["Payload", "loaded"]

Payload = float | SpatialInertia | Model


def loaded(model: Model, payload: Mapping[str, Payload] | None) -> Model:
    """Return the robot with what it carries, by the frames that carry it.

    Raises
    ------
    NameNotFound
        If the model has no such frame.
    ModelError
        If a mass is not above 0, if no such body can exist, if a frame is fixed to the world, or as `attach`.
    TypeError
        If it is given without the names of frames, or is neither a mass, a SpatialInertia nor a Model.
    """
    given = {} if payload is None else payload
    check_kind(given, "payload", Mapping, "what is carried by the names of frames")
    for frame, what in given.items():
        at, name = model.frame(frame), f"payload[{frame!r}]"
        if at.body == 0:
            raise ModelError(f"{name}: the world carries this frame")
        if isinstance(what, Model):
            model = attach(model, what, frame, prefix=f"{what.name}_")
            continue
        if not isinstance(what, SpatialInertia):
            if not 0 < as_number(what, name) < float("inf"):
                raise ModelError(f"{name}: expected a mass above 0, got {what!r}")
            what = SpatialInertia.from_point(float(what), [0, 0, 0])
        what.check_physical(name)
        body = model.inertia[at.body] + what.transform(at.placement)
        model = replace(model, inertia=(*model.inertia[: at.body], body, *model.inertia[at.body + 1 :]))
    return model

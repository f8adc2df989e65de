"""Robots from files: the URDF loader and the catalogue.

>>> load("go2")
Model 'go2': floating base, 13 moving bodies, nq = 19, nv = 18, 16.085 kg
"""

from __future__ import annotations

import re
from dataclasses import replace
from os import PathLike
from os.path import exists
from pathlib import Path
from typing import Any, Literal, cast

from numpy.typing import ArrayLike

from ..algorithms.mimic import follow
from ..arrays import as_flag, check_choice
from ..errors import ModelError, NameNotFound, no_model
from ..model import Model
from ..model.checks import check_placement
from ..spatial import SE3
from .catalogue import PREFIX, Catalogue, Robot, find, is_known, robots
from .stances import read_states, with_stance, with_states
from .urdf import load_urdf

__all__ = ["Catalogue", "Robot", "load", "robots"]

ADDRESS = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+://")


def load(
    source: str | PathLike[str],
    *,
    base: Literal["fixed", "floating"] | None = None,
    placement: SE3 | None = None,
    gravity: ArrayLike = (0.0, 0.0, -9.81),
    physical: bool | None = None,
    mimic: Literal["independent", "reduce"] | None = None,
    strict: bool = False,
) -> Model:
    """Load a robot of the catalogue, or a URDF: a file, or its text.

    Meshes are not read. Links welded by fixed joints are merged; every link and every joint of the file remains as a
    frame. If an entry violates the format but has a single possible meaning, it is read, and `Model.report` lists it;
    ambiguity is an error. docs/urdf.md has the details.

    Parameters
    ----------
    source : str or path
        A name of `twistwrench.robots`, a path to a ``.urdf``, or the text of one, which begins with ``<``.
        ``"example-robot-data/go2"`` names that package's robot where this package has one of the same name.
    base : {"fixed", "floating"}, optional
        Whether the root link is welded to the world or flies freely. Default: that of the catalogue; of a file, fixed.
    placement : SE3, optional
        Of the root link of a fixed base in the world: an arm on a wall, or hung from the ceiling. That of a floating
        base is in q. Default: the identity.
    gravity : array_like, shape (3,)
        In the world, m/s².
    physical : bool, optional
        Whether moving bodies must be able to exist: no principal moment of inertia about the centre of mass below zero,
        and the largest at most the sum of the other two. True rejects a body that breaks either rule, False accepts it.
        Default: what breaks the second, and so leaves M positive definite, is loaded with a warning.
    mimic : {"independent", "reduce"}, optional
        "reduce" makes the smaller model in which joints with ``<mimic>`` follow their leaders. "independent" lets them
        move on their own, as in Pinocchio, without the warning of the default.
    strict : bool
        Reject violations of the format that would otherwise be read with a warning.

    Returns
    -------
    Model
        With ``postures`` and ``feet`` for the legged robots of the catalogue. A `MimicModel` with ``mimic="reduce"``.

    Raises
    ------
    NameNotFound
        If the name is not known; the message lists the nearest ones.
    ModelError
        If the file is missing or broken: the message names file, line, link or joint, and what was expected; or if a
        floating base is given a placement.
    ValueError
        If `mimic` is not one of the two.
    TypeError
        If `source` is neither a name nor a path, or `placement` no SE3.

    Warns
    -----
    UserWarning
        For a file with a report; it contains the whole report. Those of the catalogue warn of bodies that cannot exist.

    Examples
    --------
    >>> load("pendulum").inertia[1].com
    array([ 0.,  0., -1.])
    >>> load("go2", base="fixed").nv
    12
    >>> load("go3")
    Traceback (most recent call last):
    twistwrench.errors.NameNotFound: unknown robot 'go3'; did you mean 'go2', 'go1', ...
    """
    if base is not None:
        check_choice(base, "base", ("fixed", "floating"), ModelError)
    if mimic is not None:
        check_choice(mimic, "mimic", ("independent", "reduce"))
    if placement is not None:
        check_placement(placement, "placement")
    physical = None if physical is None else as_flag(physical, "physical")
    strict = as_flag(strict, "strict")
    if isinstance(source, bytes | bytearray):
        raise TypeError("source: expected a name, a path or the text of a URDF, got bytes; use source.decode()")
    if not isinstance(source, str | PathLike):
        raise no_model(source, "source", "a name, a path or the text of a URDF")
    options: dict[str, Any] = {"gravity": gravity, "physical": physical, "mimic": mimic, "strict": strict}
    if isinstance(source, str) and source.lstrip("\ufeff \t\r\n").startswith("<"):
        path = Path("<string>")
        model, laws = load_urdf(path, base=base or "fixed", quiet=False, text=source, **options)
    elif not isinstance(source, str) or _is_path(source):
        _refuse_what_is_no_path(source)
        path = Path(source)
        model, laws = load_urdf(path, base=base or "fixed", quiet=False, **options)
    else:
        robot = find(source)
        path = robot.path
        model, laws = load_urdf(path, base=base or robot.base, quiet=True, **options)
        if robot.srdf is not None:
            model = with_states(model, read_states(robot.srdf))
        model = with_stance(model, robot.stance) if robot.stance is not None else model
    if placement is not None:
        model = _mount(model, placement)
    if mimic != "reduce":
        return model
    try:
        reduced: Any = follow(model, laws)
    except (ModelError, NameNotFound) as error:
        raise ModelError(f"{path}: {error} (mimic='independent' loads it, free to move on its own)") from None
    return cast("Model", reduced)


def _mount(model: Model, at: SE3) -> Model:
    """Return the model with all that the world carries at another place."""
    if model.base == "floating":
        raise ModelError(f"placement: expected none, as the pose of the floating base of {model.name!r} is in its q")
    return replace(
        model,
        placement=tuple(at @ T if p == 0 else T for p, T in zip(model.parent, model.placement)),
        frames={name: replace(f, placement=at @ f.placement) if f.body == 0 else f for name, f in model.frames.items()},
    )


def _is_path(source: str) -> bool:
    """Whether a string means a file: by its form, or because the file exists and no robot has the name."""
    if source.startswith(PREFIX):
        return False
    named = "/" in source or "\\" in source or source.lower().endswith((".urdf", ".xml", ".xacro", ".srdf", ".sdf"))
    return named or (not is_known(source) and exists(source))


def _refuse_what_is_no_path(source: str | PathLike[str]) -> None:
    """Raise for ``"./go2"``, where there is no such file, with the hint that the robot is called ``"go2"``.

    Raise for ``"package://go2_description/go2.urdf"`` as well: an address, which only ROS can resolve.
    """
    name = Path(source).name
    if isinstance(source, str) and (address := ADDRESS.match(source)):
        raise ModelError(f"{source}: expected the path of a file; addresses of {address[0]} are not resolved")
    if isinstance(source, str) and source != name and is_known(name) and not exists(source):
        raise ModelError(f"{source}: no such file; {name!r} without a folder is a robot of the catalogue")

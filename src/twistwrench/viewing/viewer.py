"""`view`: show a robot. Matplotlib or viser is imported when there is something to show."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal

from numpy.typing import ArrayLike

from ..arrays import as_names
from ..errors import ShapeError, check_known

if TYPE_CHECKING:
    from ..contact import Contact
    from ..model import Model
    from ..motions import Motion
    from ..scene import Scene
    from ..simulation import Simulation
    from .browser import Browser
    from .state import Subject

__all__ = ["view"]

BACKENDS = ("matplotlib", "browser")


def view(
    robot: str | PathLike[str] | Model | Scene | Simulation,
    q: ArrayLike | Motion | Simulation | None = None,
    *,
    contacts: Iterable[str | Contact] | None = None,
    forces: ArrayLike | None = None,
    frames: Collection[str] | None = None,
    t: ArrayLike | None = None,
    meshes: str | PathLike[str] | bool = True,
    backend: Literal["matplotlib", "browser"] = "matplotlib",
    ax: Any = None,
) -> Any:
    """Show a robot with its frames, centre of mass, support polygon and contact forces.

    Parameters
    ----------
    robot : str, path, Model, Scene or Simulation
        A name of `twistwrench.robots`, a URDF, or an object made of one.
    q : array_like of shape (nq,) or (n, nq), Motion or Simulation, optional
        Configuration; unless given the standing posture, or the neutral one of a robot without it. Of a motion, n of
        them, which the browser plays.
    contacts : iterable of str or Contact, optional
        What touches the ground: the contacts of the simulation or the scene, or `model.feet`, unless given.
    forces : array_like, shape (k, 3) or (n, k, 3), optional
        Of the ground on the frames of the k contacts, in the axes of the world, N. Unless given, those of the
        simulation; or else those that hold a floating robot at rest, where its contacts can
        (`twistwrench.contact_inverse_dynamics`), and none of another motion.
    frames : collection of str, optional
        Frames to draw, with their names; small ones on every body, without names, unless given.
    t : array_like, shape (n,), optional
        Times of the configurations of a motion, s; 1/30 s apart unless given.
    meshes : str, path or bool
        Browser only. The robot or URDF whose meshes are put on the bodies, if its links are the same; True takes
        those of `robot` where example-robot-data has some. Without any, or with False, sticks are drawn.
    backend : {"matplotlib", "browser"}
        The browser needs ``pip install "twistwrench[view]"``.
    ax : matplotlib Axes3D, optional
        Matplotlib only: where to draw.

    Returns
    -------
    matplotlib Axes3D or Browser
        In a notebook either shows itself. A `Browser` has ``url``, where it is served; ``save(path)``, which
        writes one HTML file that works without network or server; ``update(q)`` and ``stop()``.

    Raises
    ------
    NameNotFound
        If there is no such backend, robot or frame.
    ShapeError, ValueError
        If an array is not of the model's shape; if an argument means nothing to the backend.
    ModuleNotFoundError
        If the backend is not installed.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> ax = tw.view("go2", ax=Figure().add_subplot(projection="3d"))
    >>> [text.get_text().strip() for text in ax.texts]
    ['39.1 N', '39.1 N', '39.8 N', '39.8 N']
    """
    from .figure import draw
    from .state import subject

    check_known("backend", backend, BACKENDS)
    seen = subject(robot, q, t=t, contacts=contacts, forces=forces)
    if frames is not None:
        frames = as_names(frames, "frames", "frame names")
        for name in frames:
            seen.model.frame(name)
    if backend == "browser":
        if ax is not None:
            raise ValueError("ax: means nothing in the browser")
        return _in_browser(robot, seen, frames, meshes)
    if meshes is not True:
        raise ValueError("meshes: matplotlib draws none; backend='browser' does")
    if seen.t is not None:
        shape = f"expected one configuration, shape ({seen.model.nq},), got {seen.q.shape}"
        raise ShapeError(f"q: {shape}: matplotlib plays no motion; backend='browser' does")
    return draw(seen, frames, ax)


def _in_browser(
    robot: Any, seen: Subject, frames: Collection[str] | None, meshes: str | PathLike[str] | bool
) -> Browser:
    from ..loading.catalogue import is_known
    from .browser import Browser, import_viser
    from .shapes import shapes

    import_viser()  # report what is missing before looking for meshes
    source = None if isinstance(meshes, bool) else meshes
    if meshes is True:  # a model gets those of the robot of its name, if there is one
        name = seen.model.name
        source = robot if isinstance(robot, str | PathLike) else name if is_known(name) else None
    return Browser(seen, shapes(seen.model, source), frames)

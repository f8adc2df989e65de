"""A robot in the browser, by viser: a page with sliders, served from here, and a page that stands alone."""

from __future__ import annotations

from collections.abc import Collection
from contextlib import redirect_stdout
from html import escape
from io import StringIO
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..files import write_text
from .controls import add_joints, add_time
from .origin import only_own_page
from .scene import build
from .shapes import Shape
from .state import Subject

__all__ = ["Browser", "import_viser"]


class Browser:
    """A robot on a page; made by `twistwrench.view` with ``backend="browser"``.

    The page is served by this process, to this machine only, and loads nothing from any other; requests of other sites
    that are open in the same browser are rejected. In a notebook the page that stands alone is shown.

    Attributes
    ----------
    url : str
        Where the page is served.
    """

    def __init__(self, seen: Subject, shapes: list[Shape], frames: Collection[str] | None) -> None:
        viser = import_viser()
        self._seen = seen
        with redirect_stdout(StringIO()), only_own_page():  # viser greets
            self._server = viser.ViserServer(host="127.0.0.1", label=seen.model.name, verbose=False)
        self.url = f"http://127.0.0.1:{self._server.get_port()}"
        self._move = build(self._server.scene, seen, shapes, frames)
        self._aim(seen.at(0))
        gui = self._server.gui
        gui.configure_theme(show_logo=False, show_share_button=False)
        if seen.t is None:
            add_joints(gui, seen, self.update)
        self._plays = None if seen.t is None or len(seen.t) < 2 else add_time(gui, seen.t, self._show)

    def update(self, q: ArrayLike) -> None:
        """Show another configuration, shape (nq,).

        Raises
        ------
        ShapeError, ValueError
            If `q` is not one configuration of the model.
        """
        self._move(self._seen.moved(q))

    def html(self) -> str:
        """Return the page that stands alone: one file, without a server; a motion plays, and has a slider."""
        recorder = self._server.get_scene_serializer()
        if (t := self._seen.t) is not None:
            for k, wait in enumerate(np.diff(t, append=t[-1])):
                self._show(k)
                recorder.insert_sleep(float(wait))
        return str(recorder.as_html())

    def save(self, path: str | PathLike[str]) -> None:
        """Write the page that stands alone."""
        write_text(path, self.html())

    def stop(self) -> None:
        """Stop serving the page."""
        if self._plays is not None:
            self._plays.value = False
        with redirect_stdout(StringIO()):
            self._server.stop()

    def __repr__(self) -> str:
        return f"<Browser: {self._seen.model.name} at {self.url}>"

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{escape(self.html())}" style="width:100%;height:480px;border:0"></iframe>'

    def _show(self, k: int) -> None:
        self._move(self._seen.at(k))

    def _aim(self, seen: Subject) -> None:
        """Look at the robot from the front right, as the figure does."""
        (centre, extent), camera = seen.box(), self._server.initial_camera
        camera.look_at = centre
        camera.position = centre + extent * np.array([0.9, -1.4, 0.6])
        camera.fov = np.pi / 4


def import_viser() -> Any:
    """Import viser, or raise an error with the command that installs it."""
    try:
        import viser
    except ModuleNotFoundError:
        raise ModuleNotFoundError(
            'the browser needs viser, which is not installed: pip install "twistwrench[view]"'
        ) from None
    return viser

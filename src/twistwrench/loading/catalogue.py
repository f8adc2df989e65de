"""The catalogue: robots by name, without opening their files.

What is known of each is a line of ``catalogue.csv``. The licences of example-robot-data are those that its README of
each robot names ("BSD" where it names no version). A test compares every line with the installed package.
"""

from __future__ import annotations

import csv
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal

from ..errors import ModelError, NameNotFound, unknown_name
from ..tables import html_table, text_table
from .stances import STANCES, Stance

__all__ = ["Catalogue", "Robot", "find", "is_known", "robots"]

Source = Literal["models", "example-robot-data"]

PREFIX = "example-robot-data/"


@dataclass(frozen=True)
class Robot:
    """A row of the catalogue.

    Attributes
    ----------
    name : str
        What `twistwrench.load` takes.
    dof : int
        Degrees of freedom (nv) on the base below.
    base : {"fixed", "floating"}
        The default base of `twistwrench.load`.
    source : {"models", "example-robot-data"}
        ``models`` comes with this package.
    licence : str
        Of the robot's description.
    note : str
        Remarks for the user.
    file : str
        Path of the URDF below the source's folder.
    """

    name: str
    dof: int
    base: Literal["fixed", "floating"]
    source: Source
    licence: str
    note: str
    file: str

    @property
    def path(self) -> Path:
        """The URDF. Raises ModelError where example-robot-data is not installed."""
        folder = models_folder() if self.source == "models" else example_robot_data_folder()
        if folder is None:
            raise ModelError(
                f"robot {self.name!r} comes with example-robot-data, which is not installed: "
                "pip install example-robot-data (Linux and macOS)"
            )
        return folder / self.file

    @property
    def stance(self) -> Stance | None:
        """How it stands; None for a robot without legs."""
        name = self.name.removeprefix(PREFIX)
        return STANCES.get(f"models/{name}" if self.source == "models" else name)

    @property
    def srdf(self) -> Path | None:
        """The file of its named postures, where there is one."""
        if self.source == "models":
            return None
        stem = self.stance.srdf if self.stance else self.path.stem
        path = self.path.parent.parent / "srdf" / f"{stem}.srdf"
        return path if path.is_file() else None


class Catalogue(tuple[Robot, ...]):
    """The rows of the catalogue; prints as a table."""

    __slots__ = ()

    columns = ("name", "dof", "base", "source", "licence", "note")

    def _cells(self) -> list[list[str]]:
        return [[str(getattr(robot, column)) for column in self.columns] for robot in self]

    def __repr__(self) -> str:
        return text_table(self.columns, self._cells())

    def _repr_html_(self) -> str:
        return html_table(self.columns, self._cells())


@cache
def robots() -> Catalogue:
    """List the robots that `twistwrench.load` knows by name.

    Those of ``models`` come with this package; the others need ``pip install example-robot-data``.

    Returns
    -------
    Catalogue
        A tuple of `Robot`, which prints as a table: name, degrees of freedom, base, source, licence, note.

    Examples
    --------
    >>> catalogue = robots()
    >>> [robot.name for robot in catalogue if robot.source == "models"]
    ['cart_pole', 'double_pendulum', 'go2', 'humanoid', 'pendulum', 'planar_arm']
    >>> len(catalogue)
    74
    """
    with Path(__file__).with_name("catalogue.csv").open(encoding="utf-8", newline="") as file:
        rows: list[dict[str, Any]] = [*csv.DictReader(file)]
    ours = {row["name"] for row in rows if row["source"] == "models"}
    for row in rows:
        if row["source"] != "models" and row["name"] in ours:
            row["name"] = PREFIX + row["name"]
    return Catalogue(Robot(**row | {"dof": int(row["dof"])}) for row in rows)


def find(name: str) -> Robot:
    """Return the robot of this name; those of example-robot-data answer to their prefixed name as well.

    Raises
    ------
    NameNotFound
        Lists the nearest names.

    Examples
    --------
    >>> find("talos")
    Traceback (most recent call last):
    twistwrench.errors.NameNotFound: unknown robot 'talos'; did you mean 'talos_left_arm', 'talos_full_v2', ...
    """
    if not is_known(name):
        lower = name.lower()  # as all the names are: "GO2" means go2
        error = unknown_name("robot", lower, (robot.name for robot in robots()))
        said = str(error).replace(repr(lower), repr(name), 1)
        file = f"; its file would be {name + '.urdf'!r}" if Path(f"{name}.urdf").is_file() else ""
        raise NameNotFound(said + file)
    return _by_name()[name]


def is_known(name: str) -> bool:
    """Whether a robot has this name."""
    return name in _by_name()


@cache
def _by_name() -> dict[str, Robot]:
    """Every name; each robot of example-robot-data answers to its prefixed name as well."""
    rows = {PREFIX + r.name.removeprefix(PREFIX): r for r in robots() if r.source == "example-robot-data"}
    return rows | {robot.name: robot for robot in robots()}


def models_folder() -> Path:
    """Where the URDFs of this package are: inside it when installed, beside ``src`` in a checkout."""
    package = Path(__file__).resolve().parents[1]
    inside = package / "models"
    return inside if inside.is_dir() else package.parents[1] / "models"


def example_robot_data_folder() -> Path | None:
    """Where example-robot-data keeps its robots (pip's place, then conda's), or None without it."""
    tail = Path("share", "example-robot-data", "robots")
    for folder in (*(Path(entry, "cmeel.prefix", tail) for entry in sys.path), Path(sys.prefix, tail)):
        if folder.is_dir():
            return folder
    return None

"""A body's account: its own, what its children passed on, the sum, and what it passed on to its parent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..arrays import Array
from ..errors import unknown_name
from ..model import Model
from ..spatial import SE3
from .listing import Assignment

__all__ = ["Account", "BodyRecord", "Trace"]


@dataclass(frozen=True)
class Account:
    """What goes inward along the tree, in the frame of the body that holds it.

    Attributes
    ----------
    own : ndarray
        Before any child passed something on.
    received : dict of int to ndarray
        By the child.
    total : ndarray
    passed : ndarray or None
        To the parent, in the parent's frame; the world passes nothing on.
    """

    own: Array
    received: Mapping[int, Array]
    total: Array
    passed: Array | None


@dataclass(frozen=True)
class BodyRecord:
    """Values and accounts of a body.

    Attributes
    ----------
    body : int
    name : str
        Of its joint.
    parent : int
    values : dict of str to ndarray
        By the name of the variable in the source, in the order in which they were found.
    accounts : dict of str to Account
        By the name of the variable.
    """

    body: int
    name: str
    parent: int
    values: Mapping[str, Array]
    accounts: Mapping[str, Account]


@dataclass(frozen=True, repr=False)
class Trace:
    """Account of what each body received and passed on, from `twistwrench.trace`.

    It prints as a table; a notebook shows it as a page to go through line by line.

    Attributes
    ----------
    algorithm : {"rnea", "aba", "crba", "ccrba", "forward_kinematics"}
    model : Model
    result : ndarray
        What the algorithm returned.
    rows : tuple of BodyRecord
        For each body, the world first.
    steps : tuple of Assignment
        Every line of the source that gave a term of a body its value, in the order in which they are run.
    placement : tuple of SE3
        Of each body, in the world.
    """

    algorithm: str
    model: Model
    result: Array
    rows: tuple[BodyRecord, ...]
    steps: tuple[Assignment, ...]
    placement: tuple[SE3, ...]

    def row(self, body: int | str) -> BodyRecord:
        """Return the row of a body, by its number or by the name of its joint; raises NameNotFound, IndexError."""
        return self.rows[self.model.joint_id(body) if isinstance(body, str) else body]

    def __getitem__(self, name: str) -> list[Any]:
        """Return a variable of all bodies: its value, or the total of its account; None where a body has neither."""
        found = [row.accounts[name].total if name in row.accounts else row.values.get(name) for row in self.rows]
        if all(value is None for value in found):
            known = {known: None for row in self.rows for known in (*row.values, *row.accounts)}
            raise unknown_name("variable", name, known, f" of {self.algorithm}")
        return found

    def tree(self) -> str:
        """Return the tree of the bodies, with what each passed on to its parent, in short, as text."""
        from .printing import tree

        return tree(self)

    def __str__(self) -> str:
        from .printing import table

        return table(self)

    def __repr__(self) -> str:
        return f"<Trace: {self.algorithm} of {self.model.name!r}, {len(self.rows) - 1} bodies, {len(self.steps)} steps>"

    def _repr_html_(self) -> str:
        from .printing import html
        from .stepper import stepper

        return f"{stepper({self.model.name: self})}<details><summary>All the numbers</summary>{html(self)}</details>"

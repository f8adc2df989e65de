"""The chapter's exercises, checked.

`start` writes skeletons into a folder; there, ``python -m pytest`` checks the student's functions and explains
what is wrong with them. `status` shows the progress, `hint` and `solution` help. In a notebook, `check` does the same
for the functions of a cell.

The exercises are those of Chapter 49 of the Robotics Tutorial by Pengfei Guo (CC BY 4.0), in other words.
How to add one is in the README beside this file.

>>> from twistwrench.exercises import hint
>>> print(hint("49.3.2", language="en").splitlines()[0])
49.3.2 A pure rotation: hint 1 of 2
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .cases import case
    from .cells import Checked, check
    from .helping import hint, solution
    from .progress import Status, status
    from .skeletons import start
    from .workbook import mine

__all__ = ["Checked", "Status", "case", "check", "hint", "mine", "solution", "start", "status"]

_HOME = {"hint": "helping", "solution": "helping", "Status": "progress", "status": "progress"}
_HOME |= {"start": "skeletons", "mine": "workbook", "case": "cases", "check": "cells", "Checked": "cells"}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOME[name]}", __name__), name)

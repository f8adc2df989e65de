"""The chapter's exercises, checked.

`start` writes skeletons into a folder; there, ``python -m pytest`` checks the student's functions and explains
what is wrong with them. `status` shows the progress, `hint` and `solution` help. In a notebook, `check` does the same
for the functions of a cell.

The exercises are those of Chapter 49 of the Robotics Tutorial by Pengfei Guo (CC BY 4.0), in other words.
How to add one is in the README beside this file. Each file imports only from those above it in this table:

==========  ======================================================================
file        what it holds
==========  ======================================================================
robots      the robots of the cases, each loaded once, and small random ones
words       a room: the sentences of the messages
layouts     how the numbers of an answer are arranged
prose       the texts of the exercises
exercise    `Exercise`, `Part`, `Quantity`: what an exercise is
compare     right or wrong, entry by entry
calls       calls of functions that may be wrong: they end, and change no argument
catalogue   numbers, sections, names of files
cases       the cases that an answer is tried on
slips       a room: the list of slips with a name
changes     a room: small changes of a function
failing     the failing case, with its numbers
context     in how many cases an answer is wrong, and the first
forbidden   what the texts forbid
rules       whether a function keeps to that
statements  a room: the student's function statement by statement
stopwatch   a machine whose clock is known
wrong       wrong functions, made out of right ones
naming      a room: what is said of a wrong answer
judge       `judge`: to do, done or wrong
folder      a room: the student's folder
items       a room: the exercises
processes   a room: where a student's code runs
helping     hints, and solutions on request
notebook    a room: `check`
course      a room: a whole class
progress    a row for each section, and what comes next
checking    the plugin of pytest in a student's folder
commands    ``twistwrench exercises``
==========  ======================================================================

>>> from twistwrench.exercises import hint
>>> print(hint("49.3.2", language="en").splitlines()[0])
49.3.2 A pure rotation: hint 1 of 2
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .cases import case
    from .folder.skeletons import start
    from .folder.workbook import mine
    from .helping import hint, solution
    from .notebook.cells import Checked, check
    from .progress import Status, status

__all__ = ["Checked", "Status", "case", "check", "hint", "mine", "solution", "start", "status"]

_HOME = {"hint": "helping", "solution": "helping", "Status": "progress", "status": "progress"}
_HOME |= {
    "start": "folder.skeletons",
    "mine": "folder.workbook",
    "case": "cases",
    "check": "notebook.cells",
    "Checked": "notebook.cells",
}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOME[name]}", __name__), name)

"""The chapter's exercises: their texts, their slips, and what in them is about robots. ``misstep`` checks them.

`start` writes skeletons into a folder; there, ``python -m pytest`` checks the student's functions and explains
what is wrong with them. `status` shows the progress, `hint` and `solution` help. In a notebook, `check` does the same
for the functions of a cell.

The exercises are those of Chapter 49 of the Robotics Tutorial by Pengfei Guo (CC BY 4.0), in other words.
How to add one is in the README beside this file. Each file imports only from those above it in this table:

=========  ======================================================================
file       what it holds
=========  ======================================================================
robots     the robots of the cases, each loaded once, and small random ones
layouts    how the numbers of an answer are arranged
domains    what the arguments are, and the cases that only robots have
stopwatch  a machine whose clock is known
slips      a room: the list of slips with a name
wrong      slips of the chapter that need no code of their own
field      what is taken for each other
forbidden  what the texts rule out
chapter    `COURSE`: the sections, and all of the above
questions  a room: what the notebooks ask before they show
asking     `ask`: a question of a notebook, and the verdict on a guess
pencil     ten questions to each section for paper and pencil
public     the functions of this page
items      a room: the exercises
checking   the plugin of pytest in a student's folder
commands   ``twistwrench exercises``
=========  ======================================================================

>>> from twistwrench.exercises import hint
>>> print(hint("49.3.2", language="en").splitlines()[0])
49.3.2 rotation_transform: hint 1 of 1
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .asking import Asked
    from .public import Checked, Status, case, check, hint, mine, solution, start, status

__all__ = ["Asked", "Checked", "Status", "case", "check", "hint", "mine", "solution", "start", "status"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from . import asking, public

    return getattr(asking if name in asking.__all__ else public, name)

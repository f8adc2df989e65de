"""All exercises, by number and by section."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.util import find_spec

from ..errors import unknown_name
from .exercise import Exercise, Part
from .text import Text

__all__ = ["IDS", "SECTIONS", "available", "exercise", "file_name", "find_part", "of_section"]

_COUNTS = {"49.0": 5, "49.1": 2, "49.2": 2, "49.3": 3, "49.4": 3, "49.5": 3, "49.6": 3, "49.7": 2, "49.8": 2}
_COUNTS |= {"49.9": 3, "49.10": 3, "49.11": 3, "project": 4}

IDS = tuple(f"{section}.{k}" for section, n in _COUNTS.items() for k in range(1, n + 1))
"""The five questions of the pre-test, the chapter's 29 exercises, the four stages of the project."""

SECTIONS = {
    "49.0": Text("Before you start", "前置自测"),
    "49.1": Text("Why six dimensions", "为什么需要空间向量"),
    "49.2": Text("Twists", "Twist（空间速度）"),
    "49.3": Text("Change of frame", "Plücker 变换"),
    "49.4": Text("Wrenches", "Wrench（空间力）"),
    "49.5": Text("Spatial inertia", "空间惯量"),
    "49.6": Text("Inverse dynamics: RNEA", "逆动力学：RNEA"),
    "49.7": Text("Forward dynamics: ABA", "正向动力学：ABA"),
    "49.8": Text("Mass matrix: CRBA", "质量矩阵：CRBA"),
    "49.9": Text("The floating base", "浮动基座方程"),
    "49.10": Text("Centroidal momentum", "质心动量"),
    "49.11": Text("Everything at once", "综合实操"),
    "project": Text("The project", "累积项目"),
}


def _module(number: str) -> str:
    return f"{__package__}.items.ex_{number.replace('.', '_')}"


def available() -> tuple[str, ...]:
    """Return the numbers of the exercises that exist."""
    return tuple(number for number in IDS if find_spec(_module(number)) is not None)


@cache
def exercise(number: str) -> Exercise:
    """Return an exercise by its number.

    Raises
    ------
    NameNotFound
        If there is no such exercise; the message lists the nearest numbers.

    Examples
    --------
    >>> exercise("49.3.1").kind
    'code'
    """
    if number not in IDS or find_spec(_module(number)) is None:
        raise unknown_name("exercise", number, available())
    found: Exercise = import_module(_module(number)).EXERCISE
    return found


def of_section(section: str) -> tuple[Exercise, ...]:
    """Return the exercises of a section, in order."""
    return tuple(exercise(number) for number in available() if number.rpartition(".")[0] == section)


def file_name(section: str) -> str:
    """Return the name of the student's file of a section."""
    return f"ex_{section.replace('.', '_')}.py" if section.startswith("49") else f"{section}.py"


@cache
def find_part(name: str) -> tuple[Exercise, Part]:
    """Return the exercise to which a function of that name belongs, and its part.

    Raises
    ------
    NameNotFound
        If there is no such function.
    """
    every = {part.name: (e, part) for e in map(exercise, available()) for part in e.parts}
    if name not in every:
        raise unknown_name("function of an exercise", name, tuple(every))
    return every[name]

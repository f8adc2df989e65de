"""All exercises, by number and by section."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from ..errors import check_known
from .exercise import Exercise, Part
from .words.text import Text

__all__ = ["SECTIONS", "asked_for", "available", "exercise", "file_name", "find_part", "of_section"]

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


@cache
def available() -> tuple[str, ...]:
    """Return the numbers of all exercises, in order: `items` has a file for each.

    Examples
    --------
    >>> available()[:7]
    ('49.0.1', '49.0.2', '49.0.3', '49.0.4', '49.0.5', '49.1.1', '49.1.2')
    """
    folder = str(Path(__file__).with_name("items"))
    names = [module.name for module in iter_modules([folder]) if module.name.startswith("ex_")]
    split = [name.removeprefix("ex_").replace("_", ".").rpartition(".") for name in names]
    order = list(SECTIONS)
    return tuple("".join(n) for n in sorted(split, key=lambda n: (order.index(n[0]), int(n[2]))))


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
    check_known("exercise", number, available())
    found: Exercise = import_module(f".items.ex_{number.replace('.', '_')}", __package__).EXERCISE
    return found


def asked_for(name: str) -> Exercise:
    """Return an exercise by its number, or by the name of one of its functions.

    Raises
    ------
    NameNotFound
        If there is neither.

    Examples
    --------
    >>> asked_for("skew").id
    '49.0.1'
    """
    return exercise(name) if name[:1].isdigit() or name.startswith("project") else find_part(name)[0]


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
    check_known("function of an exercise", name, tuple(every))
    return every[name]

"""A course: its sections, its exercises by number, and what is special to its field."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from dataclasses import field as dataclass_field
from functools import cached_property
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import Any

import numpy as np

from .diagnose import Field
from .domains import Domain
from .errors import UnknownName, check_known
from .exercise import Exercise, Part
from .rules import Rules
from .text import Language, Text
from .verdict import Verdict

__all__ = ["Course", "Session"]

NO_RULES, EMPTY = Rules(), Text("", "")

SpecialCases = Callable[[Part, tuple[Any, ...], np.random.Generator], Sequence[tuple[Any, ...]]]


@dataclass
class Session:
    """What was checked in this process outside of any folder, as in a notebook.

    Attributes
    ----------
    language : str, optional
        The language that was asked for last.
    verdicts : dict
        From the name of a function to the last verdict on it.
    hints : dict
        From the name of a function to what stands for each of its hints that was shown.
    """

    language: Language | None = None
    verdicts: dict[str, Verdict] = dataclass_field(default_factory=dict)
    hints: dict[str, list[str]] = dataclass_field(default_factory=dict)


@dataclass(frozen=True, eq=False, kw_only=True)
class Course:
    """A course.

    Attributes
    ----------
    module : str
        In which it is called ``COURSE``: another process finds it there.
    items : str
        The package with its exercises: a module ``ex_<number>`` for each, which has an ``EXERCISE``, and its texts.
    sections : mapping
        The sections in order, with their titles.
    field : Field
        The slips that have a name, what is taken for each other, and the package that the exercises are about.
    domains : mapping
        What the arguments are, by their names: a name means one thing in all exercises of a course.
    model : str
        The name of an argument that is large, as a robot is; empty for none.
    special_cases : callable
        From a part, its first case and a random generator to cases that the domains do not know.
    rules : Rules
        What the texts rule out.
    alias : str
        The name of the package in a student's file.
    command, call, plugin : str
        What is typed in a shell and in Python before "case", "hint" and the like; the plugin of pytest.
    state_file : str
        The name of the file in a student's folder that remembers what was shown.
    opening : Text
        How a student's file begins; ``{title}``, ``{file}`` and ``{first}`` are those of its section.
    title_of : callable
        From a section to its title as it stands there.
    unknown : type
        The error that a name raises which is not known.
    session : Session
        What was checked in this process.
    """

    module: str
    items: str
    sections: Mapping[str, Text]
    field: Field
    domains: Mapping[str, Domain] = dataclass_field(default_factory=dict)
    model: str = ""
    special_cases: SpecialCases = lambda part, drawn, rng: ()
    rules: Rules = NO_RULES
    alias: str = ""
    command: str = "misstep"
    call: str = "misstep"
    plugin: str = "misstep.plugin"
    state_file: str = ".misstep.json"
    opening: Text = EMPTY
    title_of: Callable[[str], Text] | None = None
    unknown: type[Exception] = UnknownName
    session: Session = dataclass_field(default_factory=Session)

    @property
    def package_name(self) -> str:
        """The name of the package that the exercises are about; empty for none."""
        return self.field.package.__name__ if self.field.package else ""

    @property
    def shared(self) -> dict[str, ModuleType]:
        """The modules that references use as students do: what a file changes in them would be changed for both."""
        package = {self.alias: self.field.package} if self.field.package else {}
        return {"np": np, "np.linalg": np.linalg, **package}

    def title(self, section: str) -> Text:
        """Return the title of a section as it stands in its file."""
        return self.title_of(section) if self.title_of else self.sections[section]

    @cached_property
    def numbers(self) -> tuple[str, ...]:
        """The numbers of all exercises, in order."""
        path = import_module(self.items).__path__
        names = [module.name for module in iter_modules(path) if module.name.startswith("ex_")]
        split = [name.removeprefix("ex_").replace("_", ".").rpartition(".") for name in names]
        order = list(self.sections)
        return tuple("".join(n) for n in sorted(split, key=lambda n: (order.index(n[0]), int(n[2]))))

    @cached_property
    def _exercises(self) -> dict[str, Exercise]:
        return {}

    def exercise(self, number: str) -> Exercise:
        """Return an exercise by its number, 49.3.1 or 49_3_1; the error where there is none lists the nearest."""
        number = self.dotted(number)
        if number in self.sections:
            every = ", ".join(x for x in self.numbers if x.rpartition(".")[0] == number)
            raise self.unknown(f"{number} is a section: name one of its exercises, {every}")
        check_known("exercise", number, self.numbers, self.unknown)
        if number not in self._exercises:
            found = import_module(f"{self.items}.ex_{number.replace('.', '_')}").EXERCISE
            self._exercises[number] = replace(found, course=self)
        return self._exercises[number]

    def dotted(self, number: str) -> str:
        """Return the number of an exercise or a section as it is, where it is written as in the name of a test."""
        found = str(number).removeprefix("ex_").replace("_", ".")
        return found if found in self.numbers or found in self.sections else number

    @property
    def exercises(self) -> list[Exercise]:
        """All exercises, in order."""
        return [self.exercise(number) for number in self.numbers]

    def of_section(self, section: str) -> list[Exercise]:
        """Return the exercises of a section, in order."""
        return [self.exercise(number) for number in self.numbers if number.rpartition(".")[0] == section]

    def asked_for(self, name: str) -> Exercise:
        """Return an exercise by its number, or by the name of one of its functions."""
        name = self.dotted(name)
        is_number = name in self.numbers or name[:1].isdigit() or name.startswith(tuple(self.sections))
        return self.exercise(name) if is_number else self.find_part(name)[0]

    def file_name(self, section: str) -> str:
        """Return the name of the student's file of a section."""
        return f"ex_{section.replace('.', '_')}.py" if section[:1].isdigit() else f"{section}.py"

    @cached_property
    def files(self) -> dict[str, str]:
        """The sections by the names of their files."""
        return {self.file_name(section): section for section in self.sections}

    @cached_property
    def _parts(self) -> dict[str, tuple[Exercise, Part]]:
        return {part.name: (exercise, part) for exercise in self.exercises for part in exercise.parts}

    def find_part(self, name: str) -> tuple[Exercise, Part]:
        """Return the exercise to which a function of that name belongs, and its part."""
        check_known("function of an exercise", name, self._parts, self.unknown)
        return self._parts[name]

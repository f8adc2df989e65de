"""The ways that an exercise rules out: calls that it forbids, the reference itself, a result that is written down.

They are decided before anything is run, by what the code of the student's function names: the objects that its names
and their attributes stand for, in it and in the student's other functions that it uses. What is only named while it
runs is not seen.
"""

from __future__ import annotations

import builtins
import dis
import functools
import inspect
import re
import sys
import sysconfig
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from itertools import islice
from pathlib import Path
from types import BuiltinFunctionType, CellType, CodeType, FunctionType, GetSetDescriptorType, MethodType, ModuleType
from typing import Any, NamedTuple

from .exercise import Part
from .text import Text

__all__ = ["Rules", "broken_rules", "cell_content", "is_ours", "is_reference", "reference"]

BY_NAME = frozenset(("eval", "exec", "compile", "trace", "getattr", "attrgetter", "import_module", "__import__"))
"""Functions that are told by a text what to compute or to call."""

COURSE = f"{__package__}.course"  # the module that leads to the right answers
LIBRARY = sysconfig.get_path("stdlib")
UNKNOWN = object()  # what a name stands for that is only known at run time
MAX_HELD = 1000  # things that are looked at in a list or a dictionary that a function uses
TYPED = ("<ipython", "<stdin", "<string>", "<console>", "<python-input", "<cell")
"""How the names of files begin that stand for code which was typed, or run by `exec`."""

KEEPING = ("CACHE", "COPY", "POP_TOP", "PRECALL", "PUSH_NULL", "SWAP")
"""Steps of a code after which what was loaded last is still at hand."""

WRITTEN_DOWN = Text(
    "The numbers are right, but {name} is not used: the exercise asks to compute them, not to write them down.",
    "数值正确，但没有用到 {name}：题目要求算出结果，而不是直接写出。",
)
FORBIDDEN = Text(
    "The numbers are right, but {where} calls {name}, and the exercise asks to do without it.",
    "数值正确，但{where}调用了 {name}，而题目要求不用它。",
)
REFERENCE = Text(
    "The numbers are right, but they are those of the reference, which it calls: write {name} yourself.",
    "数值正确，但它调用的就是参考实现：请自己写出 {name}。",
)


@dataclass(frozen=True)
class Rules:
    """What the texts of a course rule out.

    Attributes
    ----------
    package : str
        The package that the exercises are about, and the name by which messages call it.
    alias : str
    rooms : tuple of str
        The modules in which names are looked up.
    forbidden : mapping
        From the name of an exercise's function to names of the package that it must not call.
    symbols : mapping
        What some of them compute, as a program that the package compiles names it.
    computed : mapping
        Which argument a result is to be computed from though its value does not depend on it, by the function's name.
    answers : tuple of str
        The modules with the right answers.
    """

    package: str = ""
    alias: str = ""
    rooms: tuple[str, ...] = ()
    forbidden: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    symbols: Mapping[str, str] = field(default_factory=dict)
    computed: Mapping[str, int] = field(default_factory=dict)
    answers: tuple[str, ...] = ()


class Named(NamedTuple):
    """What a function names, and the line; none where the function is it, or holds it."""

    value: Any
    line: int | None


# ---------------------------------------------------------------- what is forbidden


def broken_rules(rules: Rules, part: Part, function: Callable[..., Any]) -> list[Text]:
    """Return what a student's function names that it must not, as a message; nothing where it keeps to the rules."""
    if is_reference(part, function):
        return []
    forbidden, names = _forbidden(rules, part), rules.forbidden.get(part.name, ())
    symbols = {rules.symbols[name]: name for name in names if name in rules.symbols}
    texts, by_name = list[Text](), False
    for value, line in _named(rules, function):
        if _is_answer(rules, part, value):
            return [reference(part)]
        if id(value) in forbidden:
            return [_calls(forbidden[id(value)], line)]
        computed = set[str]()
        if isinstance(value, str):
            texts += [_calls(f"{rules.alias}.{name}", line) for name in names if re.search(rf"\b{name}\b", value)]
            texts += [_calls(f"{rules.alias}.{symbols[value]}", line)] if value in symbols else []
        elif isinstance(value, FunctionType | BuiltinFunctionType | type):
            by_name |= value.__name__ in BY_NAME
        elif _is_program(rules, value):
            computed = {getattr(x, "symbol", "") for x in vars(value).get("quantities", ())}
            texts += [_calls(f"{rules.alias}.{symbols[x]}", line) for x in sorted(computed & symbols.keys())]
        by_name |= bool(computed)
    return texts[:1] if by_name and texts else _written_down(rules, part, function)


def is_reference(part: Part, function: Callable[..., Any]) -> bool:
    """Whether what a student hands in is the reference itself, under whatever name."""
    return _core(function) is _core(part.solution)


def reference(part: Part) -> Text:
    """Return the message on that."""
    return REFERENCE.fill(name=part.name)


def _calls(name: str, line: int | None) -> Text:
    where = Text("the function", "函数") if line is None else Text(f"line {line}", f"第 {line} 行")
    return FORBIDDEN.fill(name=name, where=where)


def _forbidden(rules: Rules, part: Part) -> dict[int, str]:
    """Return the functions that the text forbids, by identity, with their names."""
    found: dict[int, str] = {}
    for room in map(import_module, rules.rooms if part.name in rules.forbidden else ()):
        shown = room.__name__.replace(rules.package, rules.alias)
        names = [name for name in rules.forbidden[part.name] if hasattr(room, name)]
        found |= {id(_core(getattr(room, name))): f"{shown}.{name}" for name in names}
    return found


def _is_answer(rules: Rules, part: Part, value: Any) -> bool:
    """Whether something is the reference, the listing that it runs, or what leads to them."""
    if any(value is _core(x) for x in (part.solution, *part.beside[-1:])):
        return True
    if not isinstance(value, FunctionType | type):
        return False
    if "mine" in vars(value):
        return bool(vars(value)["mine"] == part.name)
    home = str(vars(value).get("__module__") if isinstance(value, type) else value.__module__)
    return home.startswith((*rules.answers, COURSE))


def _is_program(rules: Rules, value: Any) -> bool:
    return bool(rules.package) and type(value).__module__.startswith(f"{rules.package}.") and hasattr(value, "__dict__")


def _written_down(rules: Rules, part: Part, function: Callable[..., Any]) -> list[Text]:
    """Report that a student's function does not use the argument that its result is to be computed from."""
    code = getattr(_core(function), "__code__", None)
    if part.name not in rules.computed or code is None or code.co_argcount <= rules.computed[part.name]:
        return []
    name = code.co_varnames[rules.computed[part.name]]
    loads = (x.argval for one in _codes(code) for x in dis.get_instructions(one) if "LOAD" in x.opname)
    is_used = any(name in x if isinstance(x, tuple) else name == x for x in loads)
    return [] if is_used else [WRITTEN_DOWN.fill(name=name)]


# ---------------------------------------------------------------- what a function names


def _named(rules: Rules, function: Any) -> Iterator[Named]:
    """Yield a function, and all that is named in it and in the student's functions and classes that it uses."""
    waiting, met = [Named(function, None)], dict[int, Any]()
    while waiting:
        value, line = waiting.pop(0)
        value = _core(value)
        if id(value) not in met:
            met[id(value)] = value
            yield Named(value, line)
            waiting += (x if isinstance(x, Named) else Named(x, line) for x in _inside(rules, value))


def _core(value: Any) -> Any:
    """Return the function that another one is made of, as a method, or one with a cache."""
    for _ in range(10):
        if isinstance(value, MethodType | staticmethod | classmethod):
            value = value.__func__
        elif isinstance(value, property):
            value = value.fget
        elif isinstance(value, FunctionType | functools._lru_cache_wrapper) and "__wrapped__" in vars(value):
            value = vars(value)["__wrapped__"]
    return value


def _inside(rules: Rules, value: Any) -> Iterator[Any]:
    """Yield what something of the student's is made of: what its code names, and what it holds."""
    if isinstance(value, functools.partial):
        yield from (value.func, *value.args, *value.keywords.values())
    elif isinstance(value, FunctionType):
        if not is_ours(value.__code__.co_filename):
            yield from (*(value.__defaults__ or ()), *(value.__kwdefaults__ or {}).values())
            cells = zip(value.__code__.co_freevars, value.__closure__ or ())
            closed = {name: x for name, cell in cells for x in cell_content(cell)}
            known = {**vars(builtins), **value.__globals__, **closed}
            yield from closed.values()
            for code in _codes(value.__code__):
                yield from _of_code(rules, code, known)
    elif isinstance(value, type):
        if any(isinstance(x, FunctionType) and not is_ours(x.__code__.co_filename) for x in vars(value).values()):
            yield from vars(value).values()
    elif isinstance(value, list | tuple | set | frozenset):
        yield from islice(value, MAX_HELD)
    elif isinstance(value, dict):
        yield from islice(value.values(), MAX_HELD)
    elif type(type(value)) is type and isinstance(vars(type(value)).get("__dict__"), GetSetDescriptorType):
        yield type(value)  # an object of a class, which may be the student's


def cell_content(cell: CellType) -> tuple[Any, ...]:
    """Return what is in a cell of a closure; nothing where it is empty."""
    try:
        return (cell.cell_contents,)
    except ValueError:
        return ()


def _codes(code: CodeType) -> Iterator[CodeType]:
    """Yield a code, and those of the functions that are written in it."""
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


def _of_code(rules: Rules, code: CodeType, known: Mapping[str, Any]) -> Iterator[Named]:
    """Yield what names, and names with their attributes, stand for in a code, and its constants."""
    own: dict[str, Any] = {}
    value = module = UNKNOWN
    for step in dis.get_instructions(code):
        name, line = step.argval, step.positions.lineno if step.positions else None
        if step.opname.startswith("STORE_") and isinstance(name, str):
            own[name], value = value, UNKNOWN
        elif step.opname == "IMPORT_NAME":
            value = module = _module(rules, name, whole=value is not None)
        elif step.opname == "IMPORT_FROM":
            value = _attribute(rules, module, name)
        elif step.opname in ("LOAD_ATTR", "LOAD_METHOD"):
            value = _attribute(rules, value, name)
        elif step.opname.startswith(("LOAD_CONST", "RETURN_CONST")):
            value = name
        elif step.opname.startswith("LOAD_") and isinstance(name, str):
            value = own.get(name, UNKNOWN if step.opname.startswith("LOAD_FAST") else known.get(name, UNKNOWN))
        elif step.opname not in KEEPING:
            value = UNKNOWN
        if value is not UNKNOWN and not isinstance(value, CodeType):
            yield Named(value, line)


def _module(rules: Rules, name: str, *, whole: bool) -> Any:
    """Return the module that an ``import`` in a function gives: the last of a dotted name, or the first."""
    try:
        found = import_module(name) if _is_studied(rules, name) else sys.modules.get(name, UNKNOWN)
    except ImportError:
        return UNKNOWN
    return found if whole else sys.modules.get(name.partition(".")[0], UNKNOWN)


def _is_studied(rules: Rules, module: str) -> bool:
    return bool(rules.package) and module.startswith(rules.package)


def _attribute(rules: Rules, value: Any, name: str) -> Any:
    """Return an attribute without running code of the student's."""
    if isinstance(value, ModuleType) and _is_studied(rules, value.__name__):
        return getattr(value, name, UNKNOWN)
    return UNKNOWN if value is UNKNOWN else inspect.getattr_static(value, name, UNKNOWN)


# ---------------------------------------------------------------- whose code it is


def is_ours(file: str) -> bool:
    """Whether a file is in this package, in Python's or another library, and not the student's."""
    own = str(Path(__file__).parents[1]) in file or "site-packages" in file or file.startswith(LIBRARY)
    return own or (file.startswith("<") and not file.startswith(TYPED))

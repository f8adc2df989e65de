"""The steps of traces as a page to go through: the line, its formula, the body, the picture, and the numbers.

All of it is one piece of HTML, which fetches nothing: `stepper.html` has the style and the script, and what is made
here is the data that it reads. A notebook shows it for a trace, the site for several at once.
"""

from __future__ import annotations

import inspect
import json
import re
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Array
from ..errors import check_known
from ..model import Model, tree_terms
from .algorithms import listings
from .anchors import SOURCE
from .ledger import Trace
from .listing import Assignment
from .printing import UNITS
from .words import FORMULAS, PARTS, TERMS, WORDS

__all__ = ["stepper"]

PAGE = Path(__file__).with_name("stepper.html")


def stepper(traces: Mapping[str, Trace], language: str = "en", playing: bool = False) -> str:
    """Return traces of one algorithm as a piece of HTML, in which the reader goes from line to line.

    Parameters
    ----------
    traces : mapping of str to Trace
        By what the reader chooses them by. Traces of one model share their steps.
    language : {"en", "zh"}
    playing : bool
        Whether it goes from line to line by itself from the start; not where the reader wants no motion.

    Returns
    -------
    str
        With its style and its script: it works in a file, in a notebook, and without a network.

    Raises
    ------
    NameNotFound
        If there is no such language.
    ValueError
        If the traces are of several algorithms, or there are none.

    Examples
    --------
    >>> import twistwrench as tw
    >>> t = tw.trace(tw.load("double_pendulum"), "crba", [0.3, 0.0])
    >>> "<script" in stepper({"at an angle": t})
    True
    """
    check_known("language", language, WORDS)
    algorithms = {trace.algorithm for trace in traces.values()}
    if len(algorithms) != 1:
        raise ValueError(f"expected traces of one algorithm, got {sorted(algorithms)}")
    robots = {trace.model.name: trace for trace in traces.values()}
    cases = [_case(label, trace, [*robots].index(trace.model.name)) for label, trace in traces.items()]
    data = {
        "words": WORDS[language],
        "playing": playing,
        "listings": [_listing(function) for function in listings(*algorithms)],
        "robots": [_robot(trace, language) for trace in robots.values()],
        "cases": _without_repetition(cases),
    }
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/")
    page = PAGE.read_text(encoding="utf-8").replace("{lang}", WORDS[language]["lang"])
    return page.replace("{data}", text)


def _listing(function: Any) -> dict[str, Any]:
    """Return the file and the lines of a function below its docstring."""
    lines, first = inspect.getsourcelines(function)
    end = next(k for k, line in enumerate(lines) if line.strip().endswith('"""')) + 1
    while not lines[end].strip():
        end += 1
    file = Path(inspect.getsourcefile(function) or "").relative_to(SOURCE).as_posix()
    text = [line.rstrip()[4:] for line in lines[end:]]
    return {"name": function.__name__, "file": file, "first": first + end, "lines": text}


def _robot(trace: Trace, language: str) -> dict[str, Any]:
    """Return what the steps of a model are, whatever their numbers."""
    model = trace.model
    names = [function.__name__ for function in listings(trace.algorithm)]
    return {
        "bodies": [[name, parent] for name, parent in zip(model.joint_names, model.parent)],
        "steps": [_step(trace, step, names.index(step.function), language) for step in _once(trace.steps)],
    }


def _once(steps: Sequence[Assignment]) -> list[Assignment]:
    """Return the steps without the second name of a line that gives two (``F[i] = B[i] = …``)."""
    seen: dict[Any, Assignment] = {}
    for step in steps:
        seen.setdefault((step.function, step.line, step.body, step.index), step)
    return [*seen.values()]


def _step(trace: Trace, step: Assignment, listing: int, language: str) -> dict[str, Any]:
    numbers = _numbers(trace.model, step)
    frame = step.index if isinstance(step.index, int) else step.index[0]
    says = TERMS[step.name, trace.algorithm] if (step.name, trace.algorithm) in TERMS else TERMS[step.name]
    single = step.name in ("tau", "u", "qdd") and _dofs(trace.model, frame) == 1
    return {
        "listing": listing,
        "line": step.line,
        "body": _turn(step),
        "frame": frame,
        "name": step.name,
        "anchor": step.anchor,
        "formula": formula(FORMULAS[step.anchor or ""], numbers),
        "says": re.sub(r"\b[ijkp]\b", lambda m: str(numbers[m[0]]), says[language]),
        "parts": [] if single else PARTS.get(step.name, ()),
        "units": _units(trace, step),
        "along": _rounded(_subspace(trace.model, frame)[:, 0]) if single else [],
        "arrows": step.name in PARTS and not single and step.name != "A_G",  # A_G has another frame
    }


def _numbers(model: Model, step: Assignment) -> dict[str, int]:
    """Return which body each letter of a formula stands for: i, its parent p, j towards the base, k outboard of j."""
    i = _turn(step)
    numbers = {"i": i, "p": max(model.parent[i], 0)}
    if isinstance(step.index, tuple):
        numbers["j"] = j = next((b for b in step.index if b != i), i)
        numbers["k"] = next((b for b in model.support(i) if model.parent[b] == j), i)
    return numbers


def formula(text: str, numbers: Mapping[str, int]) -> str:
    """Return a formula as HTML, with the bodies' numbers in it, and what it gives set apart.

    Examples
    --------
    >>> formula("V_i = X_i V_p", {"i": 3, "p": 2})
    '<mark>V<sub>3</sub></mark> = X<sub>3</sub> V<sub>2</sub>'
    """

    def raised(match: re.Match[str]) -> str:
        tag = "sub" if match[1] == "_" else "sup"
        inside = match[2] or match[3]
        if tag == "sub":
            inside = re.sub(r"\b[ijkp]\b", lambda m: str(numbers[m[0]]), inside)
        return f"<{tag}>{inside}</{tag}>"

    html = re.sub(r"([_^])(?:\{([^}]*)\}|(\w|\*))", raised, escape(text))
    return re.sub(r"^(.*?)( [=←] )", r"<mark>\1</mark>\2", html)


def _turn(step: Assignment) -> int:
    """Return the body whose turn it is; outside of the loops it is the world's."""
    return 0 if step.body is None else step.body


def _units(trace: Trace, step: Assignment) -> list[str]:
    """Return the units of the angular and of the linear part; those of a joint depend on whether it turns or slides."""
    model = trace.model
    name = step.name
    i = _turn(step)
    per_acceleration = name in ("U", "A_G") or (name, trace.algorithm) == ("F", "crba")
    joints = step.index if isinstance(step.index, tuple) else (i, i)
    if i and all(_dofs(model, k) == 1 for k in joints if name == "M" or k == i):
        turning = [_is_turning(model, k) for k in joints]
        if per_acceleration:
            return ["kg m²", "kg m"] if _is_turning(model, i) else ["kg m", "kg"]
        if name in ("tau", "u", "qdd"):
            return [UNITS[name].split(", ")[0 if turning[0] else 1]]
        if name in ("D", "M"):
            return [("kg", "kg m", "kg m²")[sum(turning)]]
        if name == "D_inv":
            return ["1/(kg m²)" if turning[0] else "1/kg"]
    return ["kg m² to kg"] if per_acceleration else UNITS[name].split(", ")


def _dofs(model: Model, i: int) -> int:
    return int(model.v_slice[i].stop - model.v_slice[i].start)


def _is_turning(model: Model, i: int) -> bool:
    """Whether a joint of one degree of freedom turns."""
    return bool(np.any(_subspace(model, i)[:3]))


def _subspace(model: Model, i: int) -> Array:
    """Return the motion subspace of a joint."""
    return tree_terms(model, model.neutral()).S[i]


def _case(label: str, trace: Trace, robot: int) -> dict[str, Any]:
    """Return the numbers of a trace, and where its bodies are."""
    steps = _once(trace.steps)
    largest: dict[str, float] = {}
    for step in steps:
        largest[step.name] = max(largest.get(step.name, 0.0), float(np.abs(step.value).max(initial=0.0)))
    return {
        "label": label,
        "robot": robot,
        "values": [_rounded(step.value, 1e-13 * largest[step.name]) for step in steps],
        "frames": [[_rounded(T.rotation), _rounded(T.translation)] for T in trace.placement],
        "sticks": [_sticks(trace, i) for i in range(trace.model.nbodies)],
    }


def _without_repetition(cases: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return cases with None for the values that are those of the first case of the same robot."""
    first: dict[int, list[Any]] = {}
    short = []
    for case in cases:
        values = first.setdefault(case["robot"], case["values"])
        same = case["values"] is not values
        short.append(case | {"values": [None if same and x == y else x for x, y in zip(case["values"], values)]})
    return short


def _rounded(x: Array, least: float = 1e-9) -> Any:
    """Return an array as lists, to four digits, with 0 for what is zero to rounding."""
    return np.vectorize(lambda e: float(f"{e:.4g}") if abs(e) > least else 0, otypes=[object])(np.asarray(x)).tolist()


def _sticks(trace: Trace, i: int) -> list[Any]:
    """Return the lines that draw a body, in the world: to its outboard joints, or to its farthest frame."""
    model, T = trace.model, trace.placement
    ends = [T[k].translation for k in range(1, model.nbodies) if model.parent[k] == i]
    if not ends and i:
        own = [frame.placement.translation for frame in model.frames.values() if frame.body == i]
        ends = [T[i].act(max([*own, 2 * model.inertia[i].com], key=np.linalg.norm))]
    return [[_rounded(T[i].translation), _rounded(end)] for end in ends] if i else []

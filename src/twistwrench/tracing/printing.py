"""A trace as text, as a tree and as HTML."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from html import escape

import numpy as np

from ..arrays import Array
from .ledger import Account, BodyRecord, Trace

__all__ = ["html", "table", "tree"]

UNITS = {
    "V": "rad/s, m/s",
    "A": "rad/s², m/s²",
    "c": "rad/s², m/s²",
    "F": "N m, N",
    "pA": "N m, N",
    "pa": "N m, N",
    "tau": "N m, N",
    "u": "N m, N",
    "IA": "kg m², kg",
    "Ia": "kg m², kg",
    "IC": "kg m², kg",
    "U": "kg m², kg m",
    "D": "kg m², kg",
    "M": "kg m² to kg",
    "A_G": "kg m² to kg",
    "X": "1, m",
    "T": "1, m",
    "D_inv": "1/(kg m²) to 1/kg",
    "qdd": "rad/s², m/s²",
}

FIRST = {"rnea": ("V", "A"), "aba": ("V", "c"), "crba": (), "ccrba": (), "forward_kinematics": ("T", "V", "A")}
"""The values found before anything is passed inward; the others follow the accounts."""

PASSED = {
    "rnea": "wrenches",
    "aba": "articulated inertias and bias wrenches",
    "crba": "composite inertias",
    "ccrba": "composite inertias",
}

Line = tuple[str, list[str], str]
"""What it is, its numbers, their unit."""


def table(trace: Trace) -> str:
    """Return a trace as text: below each body its values, and its accounts as own + received = total, → passed on."""
    blocks = [f"{trace.algorithm} of {trace.model.name!r}: {_title(trace)}"]
    for row in _without_rounding(trace.rows):
        lines = [_heading(row)]
        for what, cells, unit in _lines(trace.algorithm, row):
            lines.append(f"  {what:<18}{''.join(f'{cell:>11}' for cell in cells):<66}  {unit}")
        blocks.append("\n".join(line.rstrip() for line in lines))
    return "\n\n".join(blocks)


def html(trace: Trace) -> str:
    """Return a trace as a table of HTML."""
    rows = []
    for row in _without_rounding(trace.rows):
        rows.append(f'<tr><th colspan="8" style="text-align:left">{escape(_heading(row))}</th></tr>')
        for what, cells, unit in _lines(trace.algorithm, row):
            numbers = "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "<td></td>" * (6 - len(cells))
            rows.append(f'<tr><td style="text-align:left">{escape(what)}</td>{numbers}<td>{escape(unit)}</td></tr>')
    title = f"{trace.algorithm} of {trace.model.name}: {_title(trace)}"
    return f"<table><caption>{escape(title)}</caption>{''.join(rows)}</table>"


def tree(trace: Trace) -> str:
    """Return the bodies as a tree, with what each passes on to its parent."""
    rows = _without_rounding(trace.rows)
    lines = [rows[0].name]
    children = [[row for row in rows if row.parent == i] for i in range(len(rows))]

    def grow(i: int, indent: str) -> None:
        for row in children[i]:
            last = row is children[i][-1]
            lines.append(f"{indent}{'└─ ' if last else '├─ '}{row.body} {row.name}\t{_passes(trace.algorithm, row)}")
            grow(row.body, indent + ("   " if last else "│  "))

    grow(0, "")
    width = max(len(line.partition("\t")[0]) for line in lines) + 2
    return "\n".join(f"{name:<{width}}{text}".rstrip() for name, _, text in (line.partition("\t") for line in lines))


def _without_rounding(rows: Sequence[BodyRecord]) -> list[BodyRecord]:
    """Return rows with 0 for values that are zero to rounding: less than 1e-13 of the largest number in that unit."""
    largest: dict[str, float] = {}
    for row in rows:
        for name, x in [*row.values.items(), *((name, account.total) for name, account in row.accounts.items())]:
            largest[_unit(name)] = max(largest.get(_unit(name), 0.0), float(np.abs(x).max(initial=0.0)))

    def shown(name: str, x: Array) -> Array:
        return np.where(np.abs(x) > 1e-13 * largest[_unit(name)], x, 0.0)

    def account(name: str, of: Account) -> Account:
        received = {child: shown(name, part) for child, part in of.received.items()}
        passed = None if of.passed is None else shown(name, of.passed)
        return Account(shown(name, of.own), received, shown(name, of.total), passed)

    return [
        replace(
            row,
            values={name: shown(name, x) for name, x in row.values.items()},
            accounts={name: account(name, of) for name, of in row.accounts.items()},
        )
        for row in rows
    ]


def _passes(algorithm: str, row: BodyRecord) -> str:
    """Return in a line what a body passes on, and its joint's force or apparent inertia."""
    if algorithm == "forward_kinematics":
        origin = ", ".join(map(_number, row.values["T"][:3, 3]))
        return f"at {origin} m; {_norm(row.values['V'][:3])} rad/s, {_norm(row.values['V'][3:])} m/s"
    account, *_ = row.accounts.values()
    if account.passed is None:
        return ""
    if algorithm == "rnea":
        moment = _norm(account.passed[:3])
        force = _norm(account.passed[3:])
        return f"{moment} N m, {force} N to {row.parent}; tau = {_few(row.values['tau'])}"
    mass = _number(np.trace(account.passed[3:, 3:]) / 3)  # an articulated one differs with the direction: the mean
    if algorithm == "aba":
        diagonal = _few(np.diagonal(row.values["D"]))
        return f"{mass} kg to {row.parent}; D = {diagonal}; qdd = {_few(row.values['qdd'])}"
    if algorithm == "ccrba":
        return f"{mass} kg to {row.parent}"
    own = f"M[{row.body}, {row.body}]"
    return f"{mass} kg to {row.parent}; {own} = {_few(np.diagonal(row.values[own]))}"


def _title(trace: Trace) -> str:
    if trace.algorithm == "forward_kinematics":
        return "where each body is in the world, and how it moves,\nin its own frame (angular, linear)"
    return f"what each body received, and passed on to its parent:\n{PASSED[trace.algorithm]} (angular, linear)"


def _heading(row: BodyRecord) -> str:
    return f"{row.body} {row.name}" + (f", on {row.parent}" if row.parent >= 0 else "")


def _lines(algorithm: str, row: BodyRecord) -> Iterator[Line]:
    first = [name for name in row.values if name in FIRST[algorithm]]
    for name in first:
        yield from _numbers(name, name, row.values[name])
    for name, account in row.accounts.items():
        if not account.received:
            yield from _numbers(name, name, account.total)
        else:
            yield from _numbers(f"{name}: its own", name, account.own)
            for child, part in account.received.items():
                yield from _numbers(f"  + from {child}", name, part)
            yield from _numbers(f"  = {name}", name, account.total)
        if account.passed is not None:
            yield from _numbers(f"  → to {row.parent}", name, account.passed)
    for name in (name for name in row.values if name not in first):
        yield from _numbers(name, name, row.values[name])


def _numbers(what: str, name: str, x: Array) -> Iterator[Line]:
    """Yield a vector or a matrix: of a square one the diagonal, of another the columns."""
    unit = _unit(name)
    if x.ndim == 1:
        yield what, [_number(entry) for entry in x], unit
    elif name == "T":
        yield "T: origin", [_number(entry) for entry in x[:3, 3]], "m"
    elif x.shape[0] == x.shape[1] > 1:
        yield f"{what}, diag.", [_number(entry) for entry in np.diagonal(x)], unit
    else:
        for k, column in enumerate(x.mT):
            yield what if x.shape[1] == 1 else f"{what}, column {k}", [_number(entry) for entry in column], unit


def _unit(name: str) -> str:
    return UNITS["U" if name.startswith("F in") else name.partition("[")[0]]  # a wrench per unit of acceleration


def _number(x: float) -> str:
    return f"{x + 0.0:.4g}"  # + 0.0 turns -0 into 0


def _few(x: Array) -> str:
    """At most two numbers: six would be too long for a line."""
    return ", ".join([*map(_number, x[:2]), *["…"] * (len(x) > 2)])


def _norm(x: Array) -> str:
    return _number(float(np.sqrt((x * x).sum())))

"""`trace`: run an algorithm of the textbook, and read off what each body received and passed on."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.aba import aba_terms, articulated_body
from ..algorithms.centroidal import centroidal_composite, centroidal_terms, wrench_transforms
from ..algorithms.crba import composite_rigid_body, crba_terms
from ..algorithms.kinematics import forward_kinematics, motion, placements
from ..algorithms.rnea import newton_euler, rnea_terms
from ..algorithms.terms import AbaTerms, CentroidalTerms, CrbaTerms, RneaTerms
from ..arrays import Array
from ..errors import ShapeError, check_known
from ..model import Model, Tree, check_model, composite_inertias, tree_terms
from ..spatial.formulas import symmetric
from .anchors import anchors
from .ledger import Account, BodyRecord, Trace
from .listing import Assignment, places

__all__ = ["listings", "trace"]

NEEDED = {"rnea": ("v", "a"), "aba": ("v", "tau"), "crba": (), "ccrba": (), "forward_kinematics": ("v", "a")}
"""The arguments of each algorithm besides q."""

RESULT = {"rnea": "tau", "aba": "qdd", "crba": "M", "ccrba": "A_G", "forward_kinematics": "T"}
"""The result of each algorithm."""

UNMOVED = {"crba": "neither M nor A_G", "ccrba": "neither M nor A_G", "forward_kinematics": "no placement or motion"}
"""What wrenches from outside do not affect."""


def trace(
    model: Model,
    algorithm: Literal["rnea", "aba", "crba", "ccrba", "forward_kinematics"],
    q: ArrayLike,
    v: ArrayLike | None = None,
    a: ArrayLike | None = None,
    *,
    tau: ArrayLike | None = None,
    f_ext: ArrayLike | None = None,
) -> Trace:
    """Run an algorithm, and return what each body received and passed on.

    The algorithm is the textbook function itself. Each value is a term of its record (`rnea_terms`, `aba_terms`,
    `crba_terms`, `centroidal_terms`) and has the same name as in the source; those of `forward_kinematics` are T, V
    and A. What a body passes on is expressed in the frame of its parent, where it is added.

    Parameters
    ----------
    model : Model
    algorithm : {"rnea", "aba", "crba", "ccrba", "forward_kinematics"}
        "ccrba" is the algorithm of `centroidal_map`.
    q : array_like, shape (nq,)
        One configuration.
    v : array_like, shape (nv,), optional
        For rnea, aba and forward_kinematics.
    a : array_like, shape (nv,), optional
        For rnea and forward_kinematics.
    tau : array_like, shape (nv,), optional
        For aba, N m or N.
    f_ext : array_like, shape (nbodies, 6), optional
        For rnea and aba: wrench (τ, f) on each body, in its frame, N m and N.

    Returns
    -------
    Trace
        `print` shows a table, ``tree()`` a tree, a notebook line by line; ``rows`` and ``steps`` hold the arrays.

    Raises
    ------
    NameNotFound
        If there is no such algorithm.
    ShapeError, SingularError, ValueError
        As the algorithm; also if `q` is a batch, or if an argument is missing or is not used by the algorithm.

    Notes
    -----
    Sections 49.3, 49.6, 49.7, 49.8 and 49.10; Featherstone, RBDA tables 5.1, 7.1 and 6.2.

    Examples
    --------
    The weight of both links of a double pendulum goes through its first joint:

    >>> import twistwrench as tw
    >>> model = tw.load("double_pendulum")
    >>> t = tw.trace(model, "rnea", [0.3, 0.0], [0.0, 0.0], [0.0, 0.0])
    >>> forces = t.rows[1].accounts["F"]
    >>> own, received, total = (np.linalg.norm(f[3:]) for f in (forces.own, forces.received[2], forces.total))
    >>> bool(np.isclose(own + received, total))
    True
    """
    check_known("algorithm", algorithm, NEEDED)
    check_model(model)
    given = {name: x for name, x in {"v": v, "a": a, "tau": tau}.items() if x is not None}
    if tuple(given) != NEEDED[algorithm]:
        expected = ", ".join(("q", *NEEDED[algorithm]))
        raise ValueError(f"{algorithm} takes {expected}; got {', '.join(('q', *given))}")
    if f_ext is not None and algorithm in UNMOVED:
        raise ValueError(f"f_ext: expected none, since {UNMOVED[algorithm]} depends on it")
    wrenches = {} if f_ext is None else {"f_ext": f_ext}
    checked, *_ = model.state(q, **given, **wrenches)  # of one batch shape
    if checked.ndim != 1:
        raise ShapeError(f"{', '.join(('q', *given, *wrenches))}: expected one state, got a batch {checked.shape[:-1]}")
    run, read, _ = _ALGORITHMS[algorithm]
    terms = run(model, q, *given.values(), **wrenches)
    tree = tree_terms(model, checked)
    rows = tuple(read(model, tree, terms))
    steps = (_ccrba_steps if algorithm == "ccrba" else _steps)(algorithm, model, terms, rows)
    place = placements(model.parent, list(tree.placement))
    return Trace(algorithm, model, np.asarray(getattr(terms, RESULT[algorithm])), rows, tuple(steps), tuple(place))


def listings(algorithm: str) -> tuple[Callable[..., Any], ...]:
    """Return the functions in whose source the steps of an algorithm stand."""
    return _ALGORITHMS[algorithm].listings


def _rnea_rows(model: Model, tree: Tree, x: RneaTerms) -> list[BodyRecord]:
    """49.6: twists and accelerations outward, wrenches inward."""
    F = _accounts(tree, x.B, x.F, [_inward(X, F) for X, F in zip(tree.X, x.F)])
    tau = [x.tau[s] for s in model.v_slice]
    return [_row(model, i, {"F": F[i]}, {"V": x.V[i], "A": x.A[i], "tau": tau[i]}) for i in range(model.nbodies)]


def _aba_rows(model: Model, tree: Tree, x: AbaTerms) -> list[BodyRecord]:
    """49.7: twists outward, articulated inertias and bias wrenches inward, accelerations outward."""
    IA = _accounts(tree, tree.I, x.IA, [symmetric(X.mT @ Ia @ X) for X, Ia in zip(tree.X, x.Ia)])
    pA = _accounts(tree, x.B, x.pA, [_inward(X, pa) for X, pa in zip(tree.X, x.pa)])
    qdd = [x.qdd[s] for s in model.v_slice]
    names = ("V", "c", "U", "D", "u", "A")
    values = [{name: getattr(x, name)[i] for name in names} | {"qdd": qdd[i]} for i in range(model.nbodies)]
    return [_row(model, i, {"IA": IA[i], "pA": pA[i]}, values[i]) for i in range(model.nbodies)]


def _crba_rows(model: Model, tree: Tree, x: CrbaTerms) -> list[BodyRecord]:
    """49.8: composite inertias inward; the wrench of each joint's unit acceleration on its way to the base."""
    IC = _accounts(tree, tree.I, x.IC, [symmetric(X.mT @ IC @ X) for X, IC in zip(tree.X, x.IC)])
    at = model.v_slice
    rows: list[BodyRecord] = []
    for i in range(model.nbodies):
        values: dict[str, Array] = {}
        for j in model.support(i):  # in frame i, then in those on the way to the base
            values |= {f"F in {j}": x.F[j, i], f"M[{j}, {i}]": x.M[at[j], at[i]]}
        rows.append(_row(model, i, {"IC": IC[i]}, values))
    return rows


def _ccrba_rows(model: Model, tree: Tree, x: CentroidalTerms) -> list[BodyRecord]:
    """49.10: composite inertias inward; the columns of each joint, seen from the centre of mass."""
    IC = _accounts(tree, tree.I, x.IC, [symmetric(X.mT @ IC @ X) for X, IC in zip(tree.X, x.IC)])
    A_G = [x.A_G[:, s] for s in model.v_slice]
    return [_row(model, i, {"IC": IC[i]}, {"X": x.X[i], "A_G": A_G[i]}) for i in range(model.nbodies)]


class _Motion(NamedTuple):
    """What `forward_kinematics` computes, by the names in its source."""

    T: list[Array]
    V: list[Array]
    A: list[Array]


def _kinematic_terms(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> _Motion:
    found = forward_kinematics(model, q, v, a)
    V, A = (np.asarray(x) for x in (found.twist, found.acceleration))
    return _Motion([T.matrix() for T in found.placement], [*V], [*A])


def _kinematic_rows(model: Model, tree: Tree, x: _Motion) -> list[BodyRecord]:
    """49.3 and 49.6: placements, twists and accelerations outward."""
    found = [dict(zip(_Motion._fields, values)) for values in zip(*x, strict=True)]
    return [_row(model, i, {}, found[i]) for i in (0, *tree.outward)]


def _inward(X: Array, wrench: Array) -> Array:
    """Return a wrench in the parent's frame, as the recursions take it there."""
    there: Array = X.mT @ wrench[:, None]
    return there[:, 0]


def _accounts(tree: Tree, own: Sequence[Array], total: Sequence[Array], passed: Sequence[Array]) -> list[Account]:
    """Open an account for each body. The world passes nothing on."""
    children: list[dict[int, Array]] = [{} for _ in own]
    for i in tree.outward:
        children[tree.parent[i]][i] = passed[i]
    return [Account(*account) for account in zip(own, children, total, [None, *passed[1:]])]


def _row(model: Model, i: int, accounts: Mapping[str, Account], values: Mapping[str, Array]) -> BodyRecord:
    return BodyRecord(i, model.joint_names[i], model.parent[i], {k: x for k, x in values.items() if x.size}, accounts)


def _steps(algorithm: str, model: Model, terms: Any, rows: Sequence[BodyRecord]) -> Iterator[Assignment]:
    """Yield every line that gave a term its value; what adds up has a value more with each child."""
    sums: dict[Any, list[Array]] = {
        (name, row.body): _sums(account) for row in rows for name, account in row.accounts.items()
    }
    for listing in listings(algorithm):
        for place in places(listing, model.parent):
            name, index = place.name, place.index
            if (name, index) in sums:
                values = sums[name, index]
                value = values[0] if place.own else values.pop(1)
            else:
                value = _value(model, getattr(terms, name), index)
            yield Assignment(listing.__name__, place.line, place.source, place.body, name, index, value)


def _ccrba_steps(
    algorithm: str, model: Model, terms: CentroidalTerms, rows: Sequence[BodyRecord]
) -> Iterator[Assignment]:
    """Yield the three lines of the CCRBA, which stand in three functions, for every body in turn."""
    functions = [function.__name__ for function in listings(algorithm)]
    to_G, composite, column = (anchors()[name] for name in ("49.10 X", "49.5 IC", "49.10 A_G"))
    sums = {row.body: _sums(row.accounts["IC"]) for row in rows}
    outward = range(1, model.nbodies)
    for i in outward:
        yield Assignment(functions[0], to_G.number, to_G.line, i, "X", i, terms.X[i])
    for i in reversed(outward):
        p = model.parent[i]
        yield Assignment(functions[1], composite.number, composite.line, i, "IC", p, sums[p].pop(1))
    for i in outward:
        yield Assignment(functions[2], column.number, column.line, i, "A_G", i, rows[i].values.get("A_G"))


def _sums(account: Account) -> list[Array]:
    """Return an account's own value, and its value after each child, from the last to the first."""
    sums = [account.own]
    for part in reversed([*account.received.values()]):
        sums.append(sums[-1] + part)
    return sums


def _value(model: Model, term: Any, index: Any) -> Array:
    """Return the entry of a term: of a list by bodies, or of an array over all joints."""
    at = model.v_slice
    if isinstance(term, np.ndarray):
        index = tuple(at[k] for k in index) if isinstance(index, tuple) else at[index]
    value: Array = term[index]
    return value


class _Algorithm(NamedTuple):
    run: Callable[..., Any]
    read: Callable[[Model, Tree, Any], list[BodyRecord]]
    listings: tuple[Callable[..., Any], ...]


_ALGORITHMS = {
    "rnea": _Algorithm(rnea_terms, _rnea_rows, (newton_euler,)),
    "aba": _Algorithm(aba_terms, _aba_rows, (articulated_body,)),
    "crba": _Algorithm(crba_terms, _crba_rows, (composite_rigid_body,)),
    "ccrba": _Algorithm(centroidal_terms, _ccrba_rows, (wrench_transforms, composite_inertias, centroidal_composite)),
    "forward_kinematics": _Algorithm(_kinematic_terms, _kinematic_rows, (placements, motion)),
}
"""An algorithm, the function that reads the accounts off its record, and where its lines stand."""

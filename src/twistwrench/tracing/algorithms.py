"""`trace`: run the textbook's rnea, aba or crba, and read off what each body received and passed on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array
from ..door import check_model
from ..errors import ShapeError, check_known
from ..forward_dynamics import aba
from ..inverse_dynamics import _rnea, rnea
from ..mass_matrix import crba
from ..model import Model
from ..tree import Tree, composite_inertias
from .ledger import Account, Row, Trace
from .observer import Observation, observe

__all__ = ["trace"]

NEEDED = {"rnea": ("v", "a"), "aba": ("v", "tau"), "crba": ()}
"""What each algorithm asks for besides q."""


def trace(
    model: Model,
    algorithm: Literal["rnea", "aba", "crba"],
    q: ArrayLike,
    v: ArrayLike | None = None,
    a: ArrayLike | None = None,
    *,
    tau: ArrayLike | None = None,
    f_ext: ArrayLike | None = None,
) -> Trace:
    """Run an algorithm, and tell what each body received and passed on.

    The algorithm is the textbook's: it is watched as it runs, and every value is one of its own variables, under
    the name that it has in the source. What a body passes on is said in its parent's frame, where it is added.

    Parameters
    ----------
    model : Model
    algorithm : {"rnea", "aba", "crba"}
    q : array_like, shape (nq,)
        One configuration.
    v : array_like, shape (nv,), optional
        For rnea and aba.
    a : array_like, shape (nv,), optional
        For rnea.
    tau : array_like, shape (nv,), optional
        For aba, N m or N.
    f_ext : array_like, shape (nbodies, 6), optional
        For rnea and aba: wrench (τ, f) on each body, in its frame, N m and N.

    Returns
    -------
    Trace
        A table by `print`, a tree by ``tree()``; ``rows`` and ``steps`` hold the arrays.

    Raises
    ------
    NameNotFound
        If there is no such algorithm.
    ShapeError, SingularError, ValueError
        As the algorithm; if `q` is a batch, or an argument is missing or means nothing to the algorithm.

    Notes
    -----
    Sections 49.6, 49.7 and 49.8; Featherstone, RBDA tables 5.1, 7.1 and 6.2.

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
    if f_ext is not None and algorithm == "crba":
        raise ValueError("f_ext: the mass matrix does not depend on it")
    wrenches = {} if f_ext is None else {"f_ext": f_ext}
    checked, *_ = model.state(q, **given, **wrenches)  # of one batch shape
    if checked.ndim != 1:
        raise ShapeError(f"{', '.join(('q', *given, *wrenches))}: expected one state, got a batch {checked.shape[:-1]}")
    watched, function, read = _ALGORITHMS[algorithm]
    seen = observe(watched, lambda: function(model, q, *given.values(), **wrenches))
    return Trace(algorithm, model, seen.result, tuple(read(model, seen)), tuple(seen.steps))


def _rnea_rows(model: Model, seen: Observation) -> list[Row]:
    """49.6: twists and accelerations outward, wrenches inward."""
    x = seen.variables["_rnea"]
    tree: Tree = x["tree"]
    own = [seen.of("F", i)[0] for i in range(model.nbodies)]
    F = _accounts(tree, own, x["F"], lambda i: tree.X[i].mT @ x["F"][i])
    return [_row(model, i, {"F": F[i]}, {name: x[name][i] for name in ("V", "A", "tau")}) for i in range(model.nbodies)]


def _aba_rows(model: Model, seen: Observation) -> list[Row]:
    """49.7: twists outward, articulated inertias and bias wrenches inward, accelerations outward."""
    x = seen.variables["aba"]
    tree: Tree = x["tree"]
    Ia, pa, D = ([seen.during(name, i)[-1:] for i in range(model.nbodies)] for name in ("Ia", "pa", "D"))
    bias = [np.zeros(6), *(seen.of("pA", i)[0] for i in tree.outward)]  # the world has none of its own
    IA = _accounts(tree, tree.I, x["IA"], lambda i: tree.X[i].mT @ Ia[i][0] @ tree.X[i])
    pA = _accounts(tree, bias, x["pA"], lambda i: tree.X[i].mT @ pa[i][0])
    return [
        _row(
            model,
            i,
            {"IA": IA[i], "pA": pA[i]},
            {name: x[name][i] for name in ("V", "c")}
            | ({"U": x["U"][i], "D": D[i][0], "u": x["u"][i]} if i else {})
            | {name: x[name][i] for name in ("A", "qdd")},
        )
        for i in range(model.nbodies)
    ]


def _crba_rows(model: Model, seen: Observation) -> list[Row]:
    """49.8: composite inertias inward; the wrench of each joint's unit acceleration on its way to the base."""
    x, inside = seen.variables["crba"], seen.variables["composite_inertias"]
    tree: Tree = x["tree"]
    IC = _accounts(tree, tree.I, inside["IC"], lambda i: tree.X[i].mT @ inside["IC"][i] @ tree.X[i])
    at = model.v_slice
    rows: list[Row] = []
    for i in range(model.nbodies):
        values: dict[str, Array] = {}
        for j, F in zip(model.support(i), seen.during("F", i)):  # in frame i, then in those on the way to the base
            values |= {f"F in {j}": F, f"M[{j}, {i}]": x["M"][at[j], at[i]]}
        rows.append(_row(model, i, {"IC": IC[i]}, values))
    return rows


def _accounts(tree: Tree, own: list[Array], total: list[Array], passed: Callable[[int], Array]) -> list[Account]:
    """Open an account for each body. The world passes nothing on."""
    to_parent = [None, *(passed(i) for i in tree.outward)]
    children: list[dict[int, Array]] = [{} for _ in own]
    for i in tree.outward:
        children[tree.parent[i]][i] = passed(i)
    return [Account(*account) for account in zip(own, children, total, to_parent)]


def _row(model: Model, i: int, accounts: Mapping[str, Account], values: Mapping[str, Array]) -> Row:
    return Row(i, model.joint_names[i], model.parent[i], {k: x for k, x in values.items() if x.size}, accounts)


_ALGORITHMS: dict[
    str, tuple[list[Callable[..., Any]], Callable[..., Array], Callable[[Model, Observation], list[Row]]]
] = {
    "rnea": ([_rnea], rnea, _rnea_rows),
    "aba": ([aba], aba, _aba_rows),
    "crba": ([crba, composite_inertias], crba, _crba_rows),
}
"""What is watched, what is run, and what reads the accounts off that."""

"""The mass matrix beside the tree that its zeros come from (49.8)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import ShapeError
from ..model import Model, check_model
from .matrices import ANGULAR_LINEAR, matrix
from .style import COLOURS, as_drawable, as_drawable_number, axes_2d
from .words import word

__all__ = ["fill_in", "filled_in", "mass_matrix", "same_branch"]


def same_branch(model: Model) -> Array:
    """Return the entries of M that the tree allows to be nonzero: where one of two joints carries the other (49.8).

    Parameters
    ----------
    model : Model

    Returns
    -------
    ndarray of bool, shape (nv, nv)

    Examples
    --------
    Nine of a leg's entries go with each of the four legs, and not with the other three:

    >>> import twistwrench as tw
    >>> int((~same_branch(tw.load("go2"))).sum()) == 4 * 3 * 9
    True
    """
    check_model(model)
    carries = np.zeros((model.nv, model.nv), bool)
    for i in range(1, model.nbodies):
        for j in model.support(i):
            carries[model.v_slice[j], model.v_slice[i]] = True
    return np.asarray(carries | carries.mT)


def filled_in(model: Model) -> Array:
    """Return the zeros of M that Cholesky's usual order loses: those of L in M = L Lᵀ, from the root outward (49.8).

    In M = LᵀL, from the tips inward (`ltl`), none is lost.

    Parameters
    ----------
    model : Model

    Returns
    -------
    ndarray of bool, shape (nv, nv)
        Lower triangular.

    Examples
    --------
    Once the base of a Go2 is eliminated, each leg is coupled to every other:

    >>> import twistwrench as tw
    >>> int(filled_in(tw.load("go2")).sum()) == 6 * 3 * 3
    True
    """
    coupled = same_branch(model)
    kept = coupled.copy()
    for k in range(model.nv):
        later = k + 1 + np.flatnonzero(coupled[k + 1 :, k])
        coupled[np.ix_(later, later)] = True  # elimination of k couples all that k was coupled to
    filled: Array = np.tril(coupled & ~kept)
    return filled


def fill_in(model: Model, title: str = "", *, indent: float = 0.9, ax: Any = None) -> Any:
    """Draw which entries of L are not zero, with the tree beside its rows.

    Grey in both orders of elimination; orange in M = L Lᵀ alone, where M itself is zero.

    Parameters
    ----------
    model : Model
    title : str
    indent : float
        As `mass_matrix`.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> ax = fill_in(tw.load("cart_pole"), ax=Figure().add_subplot())
    >>> [text.get_text() for text in ax.texts]
    ['slide', 'hinge']
    """
    indent = as_drawable_number(indent, "indent")
    check_model(model)
    ax = axes_2d(ax, size=(7.5, 5.4))
    for entries, colour in ((np.tril(same_branch(model)), "grey"), (filled_in(model), "vermilion")):
        rows, columns = np.nonzero(entries)
        ax.plot(columns, rows, "s", color=COLOURS[colour], markersize=8)
    ax.set_aspect("equal")
    ax.set_title(title)
    ax.set_xticks([])
    ax.set_yticks([])
    _tree(model, indent, ax)
    ax.set_ylim(model.nv - 0.4, -0.6)
    ax.set_xlabel(word("grey: in both orders; orange: in M = L Lᵀ alone"), fontsize=8)
    for side in ax.spines.values():
        side.set_visible(False)
    return ax


def mass_matrix(
    model: Model, M: ArrayLike, title: str = "", *, rounding: float = 1e-12, indent: float = 0.9, ax: Any = None
) -> Any:
    """Draw a mass matrix with the tree beside its rows, like the folders of a file system.

    White squares are the zeros that the tree alone explains; those that are zero although one of
    the two joints carries the other have a dot.

    Parameters
    ----------
    model : Model
    M : array_like, shape (..., nv, nv)
        Of one posture or of many: then the largest of each entry is drawn, and white or dotted is what is
        zero in all of them.
    title : str
    rounding : float
        Entries M_ij up to this share of √(M_ii M_jj) are taken for zeros that rounding has touched: of a robot of
        grams as of one of tons.
    indent : float
        How far a joint stands to the right of the one that carries it, in squares.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ShapeError
        If the last axes of `M` are not (nv, nv).

    Examples
    --------
    A cart that moves along x, and its pole:

    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> model = tw.load("cart_pole")
    >>> ax = mass_matrix(model, tw.crba(model, [0.0, 0.3]), ax=Figure().add_subplot())
    >>> [text.get_text() for text in ax.texts]
    ['slide', 'hinge']
    """
    rounding = as_drawable_number(rounding, "rounding")
    indent = as_drawable_number(indent, "indent")
    check_model(model)
    M = as_drawable(M, "M", model.nv, model.nv).reshape(-1, model.nv, model.nv)
    if not len(M):
        raise ShapeError("M: expected at least one matrix, got none")
    largest = np.take_along_axis(M, np.abs(M).argmax(axis=0)[None], axis=0)[0]
    size = np.sqrt(np.abs(largest.diagonal()))
    largest = np.where(np.abs(largest) > rounding * np.multiply.outer(size, size), largest, 0)
    ax = matrix(largest, title, lines=(), ax=axes_2d(ax, size=(7.5, 5.4)))
    rows, columns = np.nonzero((largest == 0) & same_branch(model))
    ax.plot(columns, rows, ".", color=COLOURS["grey"], markersize=4)
    outward = range(1, model.nbodies)
    branches = [model.v_slice[i].start for i in outward if model.parent[i] in (0, 1) or model.parent[i] != i - 1]
    for k in [*branches, model.nv]:
        ax.plot([-0.5, model.nv - 0.5], [k - 0.5, k - 0.5], color=COLOURS["black"], linewidth=0.8)
        ax.plot([k - 0.5, k - 0.5], [-0.5, model.nv - 0.5], color=COLOURS["black"], linewidth=0.8)
    _tree(model, indent, ax)
    ax.set_ylim(model.nv - 0.4, -0.6)
    for side in ax.spines.values():
        side.set_visible(False)
    return ax


def _tree(model: Model, indent: float, ax: Any) -> None:
    """Draw the joints at their rows, left of the matrix."""
    depth = [len(model.support(i)) for i in range(model.nbodies)]
    names = [name.removesuffix("_joint") for name in model.joint_names]
    widest = max(d * indent + 0.5 * len(name) for d, name in zip(depth[1:], names[1:]))
    x = np.array(depth) * indent - widest - 1.5
    y = np.array([(s.start + s.stop - 1) / 2 for s in model.v_slice])
    for i in range(1, model.nbodies):
        p = model.parent[i]
        if p:
            bend = x[p] + 0.3
            ax.plot([bend, bend, x[i] - 0.1], [y[p] + 0.45, y[i], y[i]], color=COLOURS["black"], linewidth=1)
        ax.text(x[i], y[i], names[i], ha="left", va="center", fontsize=9)
        if model.v_slice[i].stop - model.v_slice[i].start == 6:
            for name, row in zip(ANGULAR_LINEAR, range(model.nv)[model.v_slice[i]]):
                ax.text(-0.7, row, name, ha="right", va="center", fontsize=8)
    ax.set_xlim(x[1] - 0.5, model.nv - 0.4)

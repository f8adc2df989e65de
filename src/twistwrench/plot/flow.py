"""Draw the quantities that a recursion passes along the tree (49.6, 49.7)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_names
from ..errors import ShapeError
from ..model import Model, check_model
from .style import COLOURS, as_drawable, axes_2d

__all__ = ["flow", "tree_layout"]


def tree_layout(model: Model) -> Array:
    """Return a place for each body in a flat picture of the tree: across its depth, along its branch.

    Parameters
    ----------
    model : Model

    Returns
    -------
    ndarray, shape (nbodies, 2)
        (depth, −branch). The world is at depth 0; every tip has a branch of its own, and a body that
        carries several stands in their middle.

    Examples
    --------
    The cart of a cart-pole, and its pole:

    >>> import twistwrench as tw
    >>> tree_layout(tw.load("cart_pole"))
    array([[0., 0.],
           [1., 0.],
           [2., 0.]])
    """
    check_model(model)
    depth = np.zeros(model.nbodies)
    branch = np.zeros(model.nbodies)
    tips = 0
    for i in range(1, model.nbodies):
        depth[i] = depth[model.parent[i]] + 1
    for i in reversed(range(model.nbodies)):  # children have larger numbers than their parents
        children = [j for j in range(1, model.nbodies) if model.parent[j] == i]
        branch[i] = branch[children].mean() if children else tips
        tips += not children
    return np.stack([depth, branch - branch.max()], axis=-1) + 0.0


def flow(
    model: Model,
    texts: Sequence[str],
    *,
    inward: bool = False,
    amounts: ArrayLike | None = None,
    colour: str = COLOURS["blue"],
    ax: Any = None,
) -> Any:
    """Draw the tree as boxes, with an arrow through each joint for what a pass passes on.

    Parameters
    ----------
    model : Model
    texts : sequence of str, one for each body
        Written at the arrow through the joint of each body; the first, the world's, below its box.
    inward : bool
        Whether the arrows lead from the tips to the base.
    amounts : array_like, shape (nbodies,), optional
        The arrows grow with the square root of these; all alike unless given. The first is ignored.
    colour : str
        Of the arrows.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ShapeError
        If there is not one text and one amount for each body.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from matplotlib.figure import Figure
    >>> ax = flow(tw.load("cart_pole"), ["", "1 kg", "0.1 kg"], inward=True, ax=Figure().add_subplot())
    >>> [text.get_text() for text in ax.texts if text.get_text()]
    ['world', 'slide', 'hinge', '1 kg', '0.1 kg']
    """
    places = tree_layout(model)
    size = np.ones(model.nbodies) if amounts is None else as_drawable(amounts, "amounts", model.nbodies)
    texts = as_names(texts, "texts", "texts", ordered=True)
    if len(texts) != model.nbodies or size.ndim != 1:
        raise ShapeError(f"texts, amounts: expected {model.nbodies} of each, got {len(texts)} and {size.shape}")
    width = 1 + 4 * np.sqrt(np.abs(size) / (np.abs(size[1:]).max(initial=0) or 1.0))
    ax = axes_2d(ax, size=(11.0, 3.2))
    names = ["world", *(name.removesuffix("_joint") for name in model.joint_names[1:])]
    names[1:2] = ["base"] if model.base == "floating" else names[1:2]
    box = {"boxstyle": "round,pad=0.35", "facecolor": "0.93", "edgecolor": COLOURS["black"]}
    for place, name in zip(places, names):
        ax.text(*place, name, ha="center", va="center", fontsize=9, bbox=box, zorder=3)
    if texts[0]:
        ax.text(*(places[0] + [0, -0.45]), texts[0], ha="center", va="center", fontsize=9, color=colour)
    for i in range(1, model.nbodies):
        end = places[i] - [0.28, 0]
        way = np.array([places[model.parent[i]] + [0.24, 0], end - [0.36, 0], end])  # then level, below its text
        _arrow(ax, way[::-1] if inward else way, color=colour, linewidth=width[i])
        ax.annotate(texts[i], end - [0.18, 0], (0, 5), textcoords="offset points", ha="center", va="bottom", fontsize=8)
    ax.set(xlim=(-0.4, places[:, 0].max() + 0.4), ylim=(places[:, 1].min() - 0.5, 0.6))
    ax.axis("off")
    return ax


def _arrow(ax: Any, way: Array, **style: Any) -> None:
    """Draw an arrow along a broken line."""
    from matplotlib.patches import FancyArrowPatch
    from matplotlib.path import Path

    ax.add_patch(FancyArrowPatch(path=Path(way), arrowstyle="-|>", mutation_scale=11, joinstyle="round", **style))

"""The pictures of docs/errata.md: for eight of the ten worst, what the chapter's line gives and what is right.

usage:  python docs/pictures/errata.py        (a few seconds; needs matplotlib)
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import twistwrench as tw
from twistwrench.model import Tree, tree_terms
from twistwrench.plot import COLOURS, matrix, sticks

HERE = Path(__file__).parent
GO2 = tw.load("go2")
STAND, REST = GO2.standing(), np.zeros(GO2.nv)
NAMES = ["base", *(name.removesuffix("_joint") for name in GO2.joint_names[2:])]
RIGHT, WRONG = COLOURS["blue"], COLOURS["vermilion"]
OURS, THEIRS = (["ωx", "ωy", "ωz", "vx", "vy", "vz"], ["vx", "vy", "vz", "ωx", "ωy", "ωz"])


def figure(columns: int, size: tuple[float, float]) -> tuple[Figure, list[Axes]]:
    """Return a figure with some axes side by side."""
    whole = Figure(figsize=size, layout="constrained")
    return whole, [*whole.subplots(1, columns, squeeze=False).flat]


def halves(A: np.ndarray, B: np.ndarray, name: str, theirs: str) -> Figure:
    """Return a matrix in the chapter's order beside what Pinocchio has."""
    whole, (left, right) = figure(2, (8.4, 4.2))
    matrix(A, f"{name}, (ω, v) as in the chapter's formula", rows=OURS, columns=OURS, ax=left)
    matrix(B, f"{theirs}, (v, ω)", rows=THEIRS, columns=THEIRS, ax=right)
    return whole


def order_of_action() -> Figure:
    """13: the lever of X stands in the other corner."""
    X = tw.frame_placement(GO2, STAND, "FR_calf").motion_transform()
    return halves(X, tw.bridge.to_pinocchio_transform(X), "X", "SE3.action")


def order_of_inertia() -> Figure:
    """22: the mass stands in the other corner."""
    I = GO2.inertia[1].matrix()
    swapped = np.roll(np.roll(I, 3, axis=0), 3, axis=1)
    return halves(I, swapped, "spatial inertia", "Inertia.matrix()")


def bars(right: np.ndarray, wrong: np.ndarray, what: str, unit: str) -> Figure:
    """Return a number for each body, right and as the chapter has it."""
    whole, (ax,) = figure(1, (9.0, 3.2))
    at = np.arange(len(right))
    ax.bar(at - 0.2, right, 0.4, color=RIGHT, label="right")
    ax.bar(at + 0.2, wrong, 0.4, color=WRONG, label=what)
    ax.axhline(0, color="0.3", lw=0.8)
    ax.set_xticks(at, NAMES, rotation=35, ha="right")
    ax.set_ylabel(unit)
    ax.legend(frameon=False)
    return whole


def overwritten() -> Figure:
    """25: what the children added to F is lost."""
    terms = tw.rnea_terms(GO2, STAND, REST, REST)
    right, own = (np.linalg.norm([F[3:] for F in part[1:]], axis=1) for part in (terms.F, terms.B))
    return bars(right, own, "F[i] set in the backward pass", "force through the joint [N]")


def inward(tree: Tree, own: list[np.ndarray], way: str) -> np.ndarray:
    """Return the wrenches of the backward pass, passed on by Xᵀ or by X*."""
    F = [np.array(wrench) for wrench in own]
    for i in reversed(range(1, len(F))):
        F[tree.parent[i]] += (tree.X[i].T if way == "Xᵀ" else np.linalg.inv(tree.X[i]).T) @ F[i]
    return np.stack(F)


def wrong_way() -> Figure:
    """26: X* turns a force the wrong way, and gives its moment the wrong sign."""
    own = tw.rnea_terms(GO2, STAND, REST, REST).B
    tree = tree_terms(GO2, STAND)
    right, wrong = (inward(tree, own, way)[1:, 5] for way in ("Xᵀ", "X*"))
    return bars(right, wrong, "passed on by X*", "force along the body's z axis [N]")


def doubled() -> Figure:
    """35: the recipe doubles every entry off the diagonal."""
    M = tw.crba(GO2, STAND)
    recipe = M + M.T - np.diag(M.diagonal())
    whole, (left, right) = figure(2, (9.0, 4.4))
    for ax, A, title in ((left, M, "M"), (right, recipe, "M + Mᵀ − diag(M)")):
        least = np.linalg.eigvalsh(A)[0]
        matrix(A, f"{title}: smallest eigenvalue {least:.2g}", lines=(6,), ax=ax)
    return whole


def strips(rows: dict[str, list[str]], cut: dict[str, tuple[int, int]]) -> Figure:
    """Return six named cells in a row for each order; what a slice takes has a frame."""
    whole, (ax,) = figure(1, (7.0, 0.9 * len(rows) + 0.4))
    for y, (title, cells) in enumerate(rows.items()):
        for x, cell in enumerate(cells):
            colour = COLOURS["orange"] if cell[0] in "kω" else COLOURS["sky"]
            ax.add_patch(_box(x, -y, 1, facecolor=colour, alpha=0.5, edgecolor="white"))
            ax.text(x + 0.5, -y + 0.4, cell, ha="center", va="center")
        first, last = cut[title]
        ax.add_patch(_box(first, -y, last - first, fill=False, edgecolor=WRONG if y == 0 else RIGHT, lw=3))
        ax.text(6.2, -y + 0.4, title, va="center", color=WRONG if y == 0 else RIGHT)
    ax.set(xlim=(-0.1, 11.5), ylim=(-len(rows) + 0.9, 0.9), aspect="equal")
    ax.axis("off")
    return whole


def _box(x: float, y: float, wide: float, **how: object):
    from matplotlib.patches import Rectangle

    return Rectangle((x, y), wide, 0.8, **how)


def slices_of_momentum() -> Figure:
    """52: the second half of Pinocchio's h_G is the angular one."""
    h = ["lx", "ly", "lz", "kx", "ky", "kz"]
    rows = {"h_G[3:]: angular, in the listing": h, "h_G[:3]: the linear momentum": h}
    return strips(rows, dict(zip(rows, ((3, 6), (0, 3)))))


def slices_of_jacobian() -> Figure:
    """53: so it is with the rows of a Jacobian."""
    rows = {"J_full[3:, :]: rank 9, in the listing": THEIRS, "J_full[:3, :]: rank 12": THEIRS}
    return strips(rows, dict(zip(rows, ((3, 6), (0, 3)))))


def standing_still() -> Figure:
    """58: least squares on all rows, and on those of the base."""
    feet = [tw.PointContact(foot, 0.6) for foot in GO2.feet]
    g, J_c = tw.gravity(GO2, STAND), tw.contact_jacobian(GO2, STAND, feet)
    found = {
        "g = J_cᵀ λ, all 18 rows": np.linalg.lstsq(J_c.T, g)[0],
        "the base's 6 rows": np.linalg.lstsq(J_c[:, :6].T, g[:6])[0],
    }
    whole, axes = figure(2, (9.0, 3.2))
    for ax, (title, forces), colour in zip(axes, found.items(), (WRONG, RIGHT), strict=True):
        for a, b in sticks(GO2, STAND):
            ax.plot([a[0], b[0]], [a[2], b[2]], color="0.6", lw=3, solid_capstyle="round")
        for foot, f in zip(GO2.feet, forces.reshape(-1, 3), strict=True):
            x, _, z = tw.frame_placement(GO2, STAND, foot).translation
            shift = 0.012 if foot.startswith(("FL", "RL")) else -0.012
            tip = (x + shift + f[0] / 250, z + f[2] / 250)
            ax.annotate("", tip, (x + shift, z), arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 2})
        total, left = forces[2::3].sum(), np.linalg.norm((J_c.T @ forces - g)[:6])
        ax.set_title(f"{title}\nfeet carry {total:.2f} N of 157.79 N, {left:.1f} left over at the base", fontsize=10)
        ax.set(xlim=(-0.45, 0.35), ylim=(-0.03, 0.33), aspect="equal")
        ax.axis("off")
    return whole


def all_pictures() -> Iterator[tuple[int, Figure]]:
    """Yield the number of each entry, and its picture."""
    drawn = {13: order_of_action, 22: order_of_inertia, 25: overwritten, 26: wrong_way}
    drawn |= {35: doubled, 52: slices_of_momentum, 53: slices_of_jacobian, 58: standing_still}
    for number, draw in drawn.items():
        yield number, draw()


if __name__ == "__main__":
    for number, picture in all_pictures():
        picture.savefig(HERE / f"errata_{number}.png", dpi=100)

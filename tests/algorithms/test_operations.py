"""What the zeros of the tree save, counted: the table of docs/mass_matrix.md."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.algorithms.articulated import articulated_inertias
from twistwrench.algorithms.crba import composite_rigid_body
from twistwrench.algorithms.delassus import delassus
from twistwrench.algorithms.factorization import factorize, inboard_dofs, solve_inward, solve_outward
from twistwrench.algorithms.inverse_mass import unit_force_responses
from twistwrench.model import tree_terms

from ..robots import shared
from .counting import Counted, counted, counted_tree, counting

DOCS = Path(__file__).parents[2] / "docs"
ROBOTS = {
    "go2": (shared("go2"), shared("go2").feet),
    "humanoid": (shared("humanoid"), shared("humanoid").feet),
    "chain of 18": (tw.chain(18), ["rod_18"]),
}


def full(model):
    """Cholesky's own lists: every row is coupled to all before it."""
    return [list(range(k)) for k in range(model.nv)]


def numbers(*shape):
    return np.array([Counted() for _ in range(int(np.prod(shape)))], object).reshape(shape)


def contact_rows(model, frames):
    rng = np.random.default_rng(1)
    many = [tw.contact_jacobian(model, model.random_configuration(rng=rng), frames) for _ in range(2)]
    return counted(*many)


def operations(model, frames):
    """Along the tree and as a full matrix: of the factors, of a solve, of J M⁻¹ Jᵀ, of M⁻¹ (all from the tree on)."""
    M, tree, n = tw.crba(model, model.random_configuration(rng=0)), counted_tree(model), model.nv
    found = {}
    for way, inboard, start in (
        ("tree", inboard_dofs(tree), counted(M)),
        ("full", full(model), numbers(n, n)),
    ):
        with counting() as found["factors", way]:
            L, D = factorize(start, inboard)
        with counting() as found["solve", way]:
            solve_outward(L, inboard, solve_inward(L, inboard, numbers(n, 1)) / D[:, None])
        rows = contact_rows(model, frames) if way == "tree" else numbers(3 * len(frames), n)
        with counting() as found["delassus", way]:
            delassus(L, D, inboard, rows)
    with counting() as found["inverse", "tree"]:
        unit_force_responses(tree, articulated_inertias(tree))
    with counting() as found["inverse", "full"]:
        L, D = factorize(composite_rigid_body(tree).M, inboard_dofs(tree))
        unit = counted(np.eye(n))
        solve_outward(L, inboard_dofs(tree), solve_inward(L, inboard_dofs(tree), unit) / D[:, None])
    return {key: sum(done.values()) for key, done in found.items()}


@pytest.mark.parametrize("name", ROBOTS)
def test_the_count_is_what_the_pattern_says(name):
    model, _ = ROBOTS[name]
    for inboard in (inboard_dofs(tree_terms(model, model.neutral())), full(model)):
        d = np.array([len(k) for k in inboard])
        M = np.empty((model.nv, model.nv), object)
        M[:] = counted(np.zeros(1))[0]
        for k, others in enumerate(inboard):
            M[k, [*others, k]] = numbers(len(others) + 1)
            M[[*others, k], k] = numbers(len(others) + 1)
        with counting() as done:
            L, D = factorize(M, inboard)
        assert done == {"÷": d.sum(), "×": (d * (d + 1) // 2).sum(), "+": (d * (d + 1) // 2).sum()}
        with counting() as done:
            solve_outward(L, inboard, solve_inward(L, inboard, numbers(model.nv, 1)) / D[:, None])
        assert done == {"÷": model.nv, "×": 2 * d.sum(), "+": 2 * d.sum()}


def table(page):
    rows = re.findall(r"^\| (go2|humanoid|chain of 18) \|(.*)\|$", (DOCS / page).read_text(encoding="utf-8"), re.M)
    return {name: [int(x.replace(" ", "")) for x in cells.split("|")] for name, cells in rows}


@pytest.mark.one_case
@pytest.mark.parametrize("page", ["mass_matrix.md", "mass_matrix.zh-CN.md"])
def test_the_table_of_the_page_is_counted(page):
    for name, (model, frames) in ROBOTS.items():
        found = operations(model, frames)
        expected = [
            found[what, way] for what in ("factors", "solve", "delassus", "inverse") for way in ("full", "tree")
        ]
        assert table(page)[name] == [model.nv, *expected], name


@pytest.mark.slow
def test_the_code_of_the_page_runs():
    blocks = re.findall(r"```python\n(.*?)```", (DOCS / "mass_matrix.md").read_text(encoding="utf-8"), re.DOTALL)
    assert len(blocks) == 5
    names = {}
    for block in blocks:
        exec(block, names)


def test_operations_are_counted_as_by_hand():
    two = numbers(2)
    with counting() as done:
        _ = two[0] * two[1] + 0 * two[0] - two[1] / two[0]
        _ = 1 * two[0] + 0
    assert done == {"×": 1, "÷": 1, "+": 1}

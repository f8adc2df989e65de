"""The questions inside the page: the orders of a recursion that the page calls right run, and no others do."""

import json
import re
import shutil
import subprocess
import sys
from html import unescape
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.exercises.pencil import SECTIONS, pencil_questions
from twistwrench.model import tree_terms

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from website import beside, pages, pencil  # noqa: E402

RECURSIONS = pencil.recursions()
EVERY = [pytest.param(name, id=name) for name in RECURSIONS]


# ---------------------------------------------------------------- the lines of a recursion


def small_tree():
    """A base, fixed, with two legs of three hinges whose axes are not parallel."""
    builder = tw.Builder("two legs")
    inertia = tw.SpatialInertia(1.5, [0.02, 0.01, -0.1], np.diag([0.02, 0.03, 0.01]))
    for leg in (-1, 1):
        for k, axis in enumerate("xyz"):
            parent = f"link_{leg}_{k - 1}" if k else "base_link"
            at = tw.SE3(tw.exp3([0.1, 0.2 * leg, 0.3]), [0.1, 0.2 * leg, -0.2])
            builder.link(f"link_{leg}_{k}", parent=parent, joint=tw.Revolute(axis), placement=at, inertia=inertia)
    return builder.build()


MODEL = small_tree()
Q, QD, QDD, TAU = np.random.default_rng(49).standard_normal((4, 6))


def given():
    """What the lines start from: the terms of the tree as arrays that begin with the world, as columns of numbers."""
    tree, n = tree_terms(MODEL, Q), MODEL.nbodies
    placed = tw.forward_kinematics(MODEL, Q).placement
    inertia = np.array([np.zeros((6, 6)), *(np.asarray(I) for I in tree.I[1:])])
    velocity = np.array(tw.forward_kinematics(MODEL, Q, QD).twist)
    axes = [np.zeros(6), *(np.asarray(S).ravel() for S in tree.S[1:])]
    V, A, F, c = np.zeros((4, n, 6))
    for i in range(1, n):
        c[i] = tw.cross_motion(velocity[i]) @ axes[i] * QD[i - 1]
    bias = np.array([tw.cross_force(velocity[i]) @ inertia[i] @ velocity[i] for i in range(n)])
    S, X = axes, [None, *(np.asarray(X) for X in tree.X[1:])]
    motion = {"V": V, "A": A, "F": F, "c": c, "qd": [0, *QD], "qdd": [0, *QDD], "gravity": MODEL.gravity}
    inertias = {"I": inertia, "IA": inertia.copy(), "IC": inertia.copy(), "pA": bias}
    results = {"tau": np.array([0, *TAU]), "M": np.zeros((n, n)), "A_G": np.zeros((6, n))}
    places = {"R": [T.rotation for T in placed], "r": [T.translation for T in placed], "S": S, "X": X}
    loops = {"p": list(tree.parent), "outward": range(1, n), "inward": range(n - 1, 0, -1)}
    used = (tw.cross_motion, tw.cross_force, tw.unskew, tw.force_transform, np.outer)
    return motion | inertias | results | places | loops | {function.__name__: function for function in used}


def expected(name):
    """What the package computes."""
    if name == "kinematics":
        return np.array(tw.forward_kinematics(MODEL, Q, QD, QDD).acceleration)
    if name == "rnea":
        return np.array([0, *tw.rnea(MODEL, Q, QD, QDD)])
    if name == "aba":
        return np.array(tw.aba_terms(MODEL, Q, QD, TAU).pA)[1:]
    if name == "crba":
        return np.pad(tw.crba(MODEL, Q), [(1, 0), (1, 0)])
    return np.pad(tw.centroidal_map(MODEL, Q), [(0, 0), (1, 0)])


def runs(name, order):
    """Whether the lines give what the package computes, in this order."""
    lines, names = RECURSIONS[name]["lines"], given()
    try:
        exec("\n".join(lines[k] for k in order), names)
    except (SyntaxError, NameError, FloatingPointError, ValueError, TypeError):
        return False
    found = names[RECURSIONS[name]["gives"]]
    return np.allclose(found[1:] if name == "aba" else found, expected(name), atol=1e-9)


def is_called_right(name, order):
    after = RECURSIONS[name]["after"]
    return all(set(after[line]) <= set(order[:k]) for k, line in enumerate(order))


def orders(name):
    """The order of the file, each with two neighbours exchanged, and others drawn at random."""
    n, rng = len(RECURSIONS[name]["lines"]), np.random.default_rng(7)
    plain = list(range(n))
    yield plain
    for k in range(n - 1):
        yield [*plain[:k], k + 1, k, *plain[k + 2 :]]
    for _ in range(30):
        order, left = [], set(plain)
        while left:  # one that the page calls right
            ready = [line for line in sorted(left) if set(RECURSIONS[name]["after"][line]) <= set(order)]
            order.append(int(rng.choice(ready)))
            left -= {order[-1]}
        yield order
        a, b = rng.choice(n, 2, replace=False)
        order = order.copy()
        order[a], order[b] = order[b], order[a]
        yield order
        yield rng.permutation(n).tolist()


@pytest.mark.filterwarnings("ignore:divide by zero", "ignore:invalid value", "ignore:overflow")
@pytest.mark.parametrize("name", EVERY)
def test_the_orders_that_the_page_calls_right_are_those_that_run(name):
    tried = {tuple(order) for order in orders(name)}
    judged = {order: is_called_right(name, order) for order in tried}
    assert [order for order, right in judged.items() if runs(name, order) != right] == []
    assert {*judged.values()} == {True, False}


def test_the_page_judges_as_the_test_does():
    if shutil.which("node") is None:
        pytest.skip("node is not installed")
    asked = [(RECURSIONS[name]["after"], order) for name in RECURSIONS for order in orders(name)]
    script = (ROOT / "docs/website/static/pencil.js").read_text(encoding="utf-8")
    script += f"\nconsole.log(JSON.stringify({json.dumps(asked)}.map(([after, order]) => !firstWrong(order, after))));"
    done = subprocess.run(["node", "-e", script], capture_output=True, text=True, timeout=60, check=True)
    assert json.loads(done.stdout) == [is_called_right(name, order) for name in RECURSIONS for order in orders(name)]


def test_every_algorithm_page_leads_to_its_lines():
    assert set(RECURSIONS) == set(beside.names())
    for name in RECURSIONS:
        assert f"pencil/{pencil.name_of(RECURSIONS[name]['section'])}.md" in beside.page(name, "zh")


# ---------------------------------------------------------------- the pages


@pytest.mark.parametrize("language", pages.LANGUAGES)
def test_a_page_asks_all_ten_and_hides_the_answers(language):
    for section in SECTIONS:
        text = pencil.page(section, language)
        questions = pencil_questions(section)
        assert text.count(":::{container} pencil\n") == 10
        assert text.count('<details class="choice right">') == sum(bool(question.choices) for question in questions)
        assert text.count('<details class="answer">') == sum(bool(question.numbers) for question in questions)
        outside = re.sub(r"<details.*?</details>", "", text, flags=re.DOTALL)
        assert not [question.why.of(language) for question in questions if question.why.of(language) in outside]


@pytest.mark.parametrize("language", pages.LANGUAGES)
def test_a_page_leads_to_the_slides_of_its_notebook(language):
    for section in SECTIONS:
        (name,) = re.findall(r'href="../slides/(\w+)\.html"', pencil.page(section, language))
        assert (ROOT / "notebooks" / language / f"{name}.ipynb").exists()
        assert name.startswith("00_first" if section == "49.0" else pencil.name_of(section))


def test_the_lines_are_shuffled_and_none_is_lost():
    for name, given in RECURSIONS.items():
        html = pencil.puzzle(given, "en")
        items = re.findall(r'<li data-line="(\d+)"><code>(.*?)</code></li>', html)
        assert [int(k) for k, _ in items] != list(range(len(items))), name
        assert {int(k): unescape(line) for k, line in items} == dict(enumerate(given["lines"]))


def test_the_pages_and_the_files_for_moodle_are_written(tmp_path):
    pencil.write_pencil(tmp_path, "zh")
    written = sorted(path.name for path in (tmp_path / "pencil").iterdir())
    assert len(written) == 2 * len(SECTIONS) + 1
    assert "49_05.gift.txt" in written
    index = (tmp_path / "pencil" / "index.md").read_text(encoding="utf-8")
    assert all(f"\n{pencil.name_of(section)}\n" in index for section in SECTIONS)

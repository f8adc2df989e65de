"""What objects show of themselves in a notebook: whole HTML, with the numbers that they have."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.tables import html_matrix

from .robots import shared

GO2 = shared("go2")
Q, REST = GO2.standing(), np.zeros(18)


def parsed(shown):
    """Read HTML as XML: every tag is closed, every letter escaped."""
    return ElementTree.fromstring(f"<div>{shown.replace('<br>', '').replace(' open ', ' ')}</div>")


@pytest.mark.parametrize("name", ["go2", "planar_arm", "talos_reduced"])
def test_a_model_shows_every_joint_once_below_the_one_that_carries_it(name):
    try:
        model = tw.load(name)
    except tw.NameNotFound:
        pytest.skip(f"{name} is not installed")
    tree = parsed(model._repr_html_())
    assert [b.text for b in tree.iter("b")] == sorted(model.joint_names[1:], key=model._repr_html_().index)
    assert len(list(tree.iter("b"))) == model.nbodies - 1
    for details in tree.iter("details"):
        parent = details.find("summary/b").text
        for child in [*details.findall("details/summary/b"), *details.findall("div/b")]:
            assert model.parent[model.joint_id(child.text)] == model.joint_id(parent)


def test_a_joint_is_shown_with_its_limits_and_its_units():
    shown = GO2._repr_html_()
    assert "revolute, 0.194 kg, -2.72 … -0.838 rad, ± 45.4 N m" in shown
    assert "prismatic" in shared("cart_pole")._repr_html_()
    name = tw.Builder("<b> & co").build()._repr_html_()
    assert "&lt;b&gt; &amp; co" in name


def test_an_inertia_is_drawn_as_its_ellipsoid():
    """Semi-axes of a uniform ellipsoid: I = m/5 (b² + c²); scaled, two to one in the first view."""
    a, b, c = 0.4, 0.2, 0.1
    body = tw.SpatialInertia(3.0, [0, 0, 0], 3 / 5 * np.diag([b * b + c * c, a * a + c * c, a * a + b * b]))
    first = next(parsed(body._repr_html_()).iter("ellipse"))
    assert float(first.get("rx")) / float(first.get("ry")) == pytest.approx(a / b, rel=0.01)
    assert float(re.search(r"rotate\((.*)\)", first.get("transform"))[1]) % 180 == 0
    assert "<svg" not in tw.SpatialInertia.zero()._repr_html_()
    assert "<svg" in tw.SpatialInertia(1.0, [0, 0, 0], np.zeros((3, 3)))._repr_html_()  # a point


def test_dynamics_show_their_matrices():
    tree = parsed(tw.dynamics(GO2, Q, REST)._repr_html_())
    pictures = list(tree.iter("svg"))
    assert [p.find("title").text.split(":")[0] for p in pictures] == ["M", "J_c", "A_G"]
    M = tw.crba(GO2, Q)
    assert len(pictures[0].findall("rect")) == np.count_nonzero(M)
    batch = tw.dynamics(GO2, np.tile(Q, (2, 1)), np.zeros((2, 18)))
    assert not list(parsed(batch._repr_html_()).iter("svg"))


def test_a_matrix_has_its_signs_and_sizes():
    tree = parsed(html_matrix(np.array([[8.0, -1.0], [0.0, 0.0]]), "A"))
    large, small = tree.iter("rect")
    assert (large.get("fill"), large.get("fill-opacity")) == ("#542788", "1.00")
    assert (small.get("fill"), small.get("fill-opacity")) == ("#B35806", "0.50")
    assert small.find("title").text == "A[0, 1] = -1"
    assert len(list(parsed(html_matrix(np.zeros((2, 2)), "A")).iter("rect"))) == 0


def test_equilibrium_and_accuracy_are_shown_as_they_are_read():
    held = tw.static_equilibrium(GO2, Q)
    cells = [td.text for td in parsed(held._repr_html_()).iter("td")]
    assert cells[::4] == list(held.contacts)
    assert float(cells[3]) == pytest.approx(held.forces[0, 2], rel=1e-3)
    accuracy = tw.accuracy(GO2, Q)
    assert next(parsed(accuracy._repr_html_()).iter("pre")).text == str(accuracy)


@pytest.mark.slow
def test_what_is_cheapest_is_a_table_with_the_choice_marked():
    motion = tw.motions.walk(GO2)
    found = tw.Scene("go2").cheapest(0.1, motion, held_out=tw.motions.trot(GO2))
    assert repr(found) == str(found)
    head, *rows = ([cell.text for cell in row] for row in parsed(found._repr_html_()).iter("tr"))
    assert all(len(row) == len(head) for row in rows)
    assert [row[1] for row in rows if row[0]] == [found.best.name]
    assert [row[1] for row in rows] == [option.name for option in found.options]
    assert parsed(found._repr_html_()).find("p").text == str(found).split("\n")[0]


def test_a_report_with_nothing_in_it_says_so():
    assert parsed(GO2.report._repr_html_()).find("p").text == "nothing to report"

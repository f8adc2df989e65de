"""One slip in a good file: another robot is never loaded without a word.

What is left out may have a default in the format; what stands in the wrong place, or under the wrong name, has none.
"""

from __future__ import annotations

import copy
import random
import string
import warnings
from contextlib import suppress
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from lxml import etree

import twistwrench as tw
from twistwrench.loading.element import Element
from twistwrench.loading.urdf_words import ATTRIBUTES, CHILDREN, WORDS

LINK = """<link name="{0}"><inertial><origin xyz="0.1 0.2 0.3" rpy="0.1 0.2 0.3"/><mass value="2"/>
<inertia ixx="1" ixy="0.01" ixz="0.02" iyy="0.9" iyz="0.03" izz="0.8"/></inertial></link>"""
JOINT = """<joint name="{0}" type="{1}"><origin xyz="0.3 0.1 0.2" rpy="0.3 0.1 0.2"/>
<parent link="{2}"/><child link="{3}"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="9" velocity="8"/>
<dynamics damping="0.1" friction="0.2"/>{4}</joint>"""
ENDS = {name: ('lower="-1" upper="1" ', "") if name == "k" else ("", "") for name in "ijkl"}
"""A continuous joint has no ends of its range."""

MIMIC = '<mimic joint="i" multiplier="2" offset="0.1"/>'
JOINTS = ["i revolute a b", "j prismatic b c", "k continuous a d", "l revolute d e"]
GOOD = "".join(
    [
        "<robot name='r'>",
        *map(LINK.format, "abcde"),
        *(JOINT.format(*words.split(), MIMIC if words[0] == "l" else "").replace(*ENDS[words[0]]) for words in JOINTS),
        "</robot>",
    ]
)
NUMBERS = {"xyz", "rpy", "value", "ixx", "ixy", "ixz", "iyy", "iyz", "izz", "multiplier", "offset"}
NO_NUMBERS = ["", " ", "nan", "inf", "1e999", "1,5", "0x10", "1 2 3 4", "true", "٣", "1_0", "1d3"]
SEED = random.randrange(10**6)


@pytest.fixture
def behaviour(tmp_path):
    """Return what loads a file: whether it was refused or reported, and how the robot moves."""

    def loaded(root):
        path = tmp_path / "robot.urdf"
        ElementTree.ElementTree(root).write(path, encoding="utf-8")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            robot = tw.load(path, base="floating", mimic="reduce")
        free, rng = robot.full, np.random.default_rng(1)
        q = free.integrate(free.neutral(), rng.standard_normal(free.nv))
        tau = tw.rnea(free, q, *rng.standard_normal((2, free.nv)))
        laws = [number for _, *law in robot.laws.values() for number in law]
        return bool(caught), np.concatenate([tau, free.damping, free.friction, laws])

    loaded.good = loaded(ElementTree.fromstring(GOOD))[1]
    return loaded


def places(tag="*"):
    """Return the parent and the index of every element."""
    root = ElementTree.fromstring(GOOD)
    return [(p, k) for p, parent in enumerate(root.iter()) for k, x in enumerate(parent) if tag in ("*", x.tag)]


def at(place):
    """Return a new copy of the file, and in it a parent and its child."""
    root = ElementTree.fromstring(GOOD)
    parent = list(root.iter())[place[0]]
    return root, parent, parent[place[1]]


def silent(root, behaviour):
    """Return whether a file is another robot, and nothing says so."""
    good = behaviour.good
    with suppress(tw.ModelError):
        reported, got = behaviour(root)
        return not reported and (got.shape != good.shape or not np.allclose(got, good, rtol=1e-12, atol=1e-12))
    return False


def misspelt(word, rng):
    """Return a word with one letter left out, doubled, swapped or replaced, or in capitals."""
    k = rng.randrange(len(word) - 1)
    return rng.choice(
        [
            word[:k] + word[k + 1 :],
            word[:k] + word[k] + word[k:],
            word[:k] + word[k + 1] + word[k] + word[k + 2 :],
            word[:k] + rng.choice(string.ascii_lowercase) + word[k + 1 :],
            word.capitalize(),
        ]
    )


def test_the_good_file_is_good(behaviour):
    reported, _ = behaviour(ElementTree.fromstring(GOOD))
    assert not reported


@pytest.mark.one_case
@pytest.mark.parametrize("where", ["above", "twice", "in its neighbour"])
def test_an_element_in_the_wrong_place_is_not_passed_over(behaviour, where):
    for place in places():
        root, parent, child = at(place)
        if where == "twice":
            parent.append(copy.deepcopy(child))
        elif where == "above" and parent is not root:
            above = next(x for x in root.iter() if parent in list(x))
            parent.remove(child)
            above.append(child)
        elif where == "in its neighbour" and (others := [x for x in parent if x is not child]):
            parent.remove(child)
            others[0].append(child)
        assert not silent(root, behaviour), (child.tag, child.attrib, where)


def test_a_misspelt_word_is_not_passed_over(behaviour):
    rng = random.Random(SEED)
    for place in places():
        root, _, child = at(place)
        child.tag, tag = misspelt(child.tag, rng), child.tag
        assert not silent(root, behaviour), (SEED, tag, child.tag)
        root, _, child = at(place)
        for key in list(child.attrib):
            root, _, child = at(place)
            if (word := misspelt(key, rng)) not in child.attrib:
                child.set(word, child.attrib.pop(key))
                assert not silent(root, behaviour), (SEED, child.tag, key, word)


def noticed(tag, attributes="", child=""):
    """Return whether an element is refused, or a remark on it is made that warns."""
    remarks = []
    try:
        Element(etree.fromstring(f"<{tag} {attributes}>{child}</{tag}>"), Path("r.urdf"), tag, remarks)
    except tw.ModelError:
        return True
    return any(entry.warns for entry in remarks)


@pytest.mark.parametrize("tag", [*{**CHILDREN, **ATTRIBUTES}])
def test_a_word_of_the_format_is_not_passed_over_on_any_other_element(tag):
    """Each word as an attribute, and as a child, of each element to which it does not belong."""
    own = ATTRIBUTES.get(tag, ()), CHILDREN.get(tag, ())
    for word in WORDS:
        assert noticed(tag, f'{word}="3"') == (word not in own[0]), f"attribute {word}"
        assert noticed(tag, child=f'<{word} value="3"/>') == (word not in own[1]), f"child {word}"


@pytest.mark.parametrize("word", ["position", "rotation", "direction", "kg"])
def test_a_word_of_another_format_is_not_passed_over(behaviour, word):
    for tag in ("origin", "axis"):
        for place in places(tag):
            root, _, child = at(place)
            child.set(word, child.attrib.pop("xyz"))
            assert not silent(root, behaviour), (tag, word)


def test_numbers_in_the_text_are_not_passed_over(behaviour):
    for tag in ("origin", "axis", "mass"):
        for place in places(tag):
            root, _, child = at(place)
            child.text, child.attrib = "0 0 1", {}
            assert not silent(root, behaviour), tag


@pytest.mark.parametrize("text", NO_NUMBERS)
def test_what_is_not_a_number_is_refused(behaviour, text):
    seen = set()
    for place in places():
        for key in NUMBERS & set(at(place)[2].attrib):
            root, _, child = at(place)
            if (child.tag, key) not in seen:
                seen.add((child.tag, key))
                child.set(key, text)
                with pytest.raises(tw.ModelError, match=f"<{child.tag} {key}="):
                    behaviour(root)
    assert {key for _, key in seen} == NUMBERS


def test_an_empty_origin_of_a_link_is_nothing(behaviour):
    root = ElementTree.fromstring(GOOD)
    root[0].append(ElementTree.fromstring('<origin xyz="0 0.0 0" rpy="0 -0 0"/>'))
    assert not behaviour(root)[0]
    root[0][-1].set("xyz", "0 0 1")
    assert behaviour(root)[0]


def test_an_attribute_of_zeros_is_nothing(behaviour):
    root = ElementTree.fromstring(GOOD)
    axis = next(root.iter("axis"))
    axis.set("rpy", "0 0 0.0")
    assert not behaviour(root)[0]
    axis.set("rpy", "0 0 1")
    assert behaviour(root)[0]


def test_an_inertia_outside_all_links_is_reported_with_its_line(tmp_path):
    """No link has it: a robot whose link is closed too early loads as it does elsewhere, and the warning says so."""
    file = tmp_path / "early.urdf"
    stray = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    file.write_text(f'<robot name="early">{LINK.format("base")}\n{stray}</robot>')
    with pytest.warns(UserWarning, match=r"<inertial> outside all links"):
        report = tw.load(file).report
    assert [(entry.found, entry.read_as) for entry in report] == [
        ("<inertial> outside all links", "not URDF, left out")
    ]
    with pytest.raises(tw.ModelError, match="<inertial> outside all links"):
        tw.load(file, strict=True)

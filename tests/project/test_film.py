"""The films of the site: what they draw is the motion, and the pages name motions that their code makes."""

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from website import film, front  # noqa: E402

GO2 = tw.load("go2")


def test_a_film_has_the_sticks_the_forces_and_the_polygon_of_the_motion():
    """Go2 at rest on its feet: forces that add up to its weight, and the rectangle of the feet."""
    feet, posture = [tw.PointContact(foot, 0.5) for foot in GO2.feet], GO2.standing()
    tau = np.r_[np.zeros(6), tw.static_equilibrium(GO2, posture).tau]
    stands = tw.simulate(GO2, posture, np.zeros(18), dt=0.05, steps=4, tau=tau, contacts=feet, ground=tw.Ground())
    data = film.moving(stands)
    assert len(data["sticks"]) == len(data["forces"]) == len(data["polygons"]) == len(data["gone"]) == 4
    arrows = np.array(data["forces"][-1]).reshape(4, 2, 3) / 1000
    carried = (arrows[:, 1] - arrows[:, 0]).sum(axis=0) * film.NEWTONS
    assert carried == pytest.approx([0, 0, 9.81 * GO2.mass], abs=4 * film.NEWTONS / 1000)
    corners = np.array(data["polygons"][-1]).reshape(-1, 3)
    places = [tw.frame_placement(GO2, stands.q[-1], foot).translation for foot in GO2.feet]
    assert np.abs(np.sort(corners, axis=0) - np.sort(1000 * np.array(places), axis=0)).max() < 1
    assert len(data["sides"]) == len(data["sticks"][0]) / 6
    assert data["mu"] == 0.5
    block = film.film("zh", data)
    assert json.loads(re.search(r"const film = (.*);", block)[1]) == data
    assert not re.search(r"\$[a-z]+\$", block)


def test_the_front_page_goes_on_where_a_stride_ends():
    data = front.stride()
    assert len(data["gone"]) == len(data["sticks"]) == front.FRAMES
    steps = np.diff([*data["gone"], data["length"]])
    assert steps.min() > 0  # mm
    assert steps.max() < 2 * steps.mean()


def test_pages_name_motions_that_their_code_makes_the_same_in_both_languages():
    marked = [path for path in (ROOT / "docs").glob("*.md") if film.MARK.search(path.read_text(encoding="utf-8"))]
    assert {path.name for path in marked} == {"control.md", "control.zh-CN.md"}
    texts = [path.read_text(encoding="utf-8") for path in sorted(marked)]
    names = [film.MARK.findall(text) for text in texts]
    assert names[0] == names[1]
    assert all(re.search(rf"^(\w+, )?{name}\b.*= ", texts[0], re.MULTILINE) for name in names[0])

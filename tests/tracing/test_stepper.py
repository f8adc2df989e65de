"""The stepper: every line with its formula and its words, the numbers of the trace, and a page that answers to keys."""

import json
import os
import re
import shutil

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.model import tree_terms
from twistwrench.tracing.stepper import formula, stepper
from twistwrench.tracing.words import FORMULAS, TERMS, WORDS

from ..robots import shared

NEEDS = {"rnea": ("v", "a"), "aba": ("v", "tau"), "crba": (), "ccrba": (), "forward_kinematics": ("v", "a")}


def traced(name, algorithm, seed=1):
    model, rng = tw.load(name), np.random.default_rng(seed)
    return tw.trace(
        model,
        algorithm,
        model.random_configuration(rng=rng),
        **{k: rng.standard_normal(model.nv) for k in NEEDS[algorithm]},
    )


def data(page):
    return json.loads(re.search(r'<script type="application/json">(.*?)</script>', page, re.DOTALL)[1])


# ---------------------------------------------------------------- the words


def test_every_line_has_a_formula_and_every_formula_its_line():
    steps = [step for algorithm in NEEDS for step in traced("go2", algorithm).steps]
    assert {step.anchor for step in steps} == set(FORMULAS)
    assert {step.name for step in steps} - {"B"} == {name for name in TERMS if isinstance(name, str)}


def test_both_languages_have_the_same_words():
    assert WORDS["en"].keys() == WORDS["zh"].keys()
    assert all(re.search("[\u4e00-\u9fff]", says["zh"]) and says["en"].isascii() for says in TERMS.values())


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("S_i^T F_i", "S<sub>4</sub><sup>T</sup> F<sub>4</sub>"),
        ("F_{j,i} = X_k^T F_{k,i}", "<mark>F<sub>1,4</sub></mark> = X<sub>2</sub><sup>T</sup> F<sub>2,4</sub>"),
        ("I^C_p ← I^C_p", "<mark>I<sup>C</sup><sub>3</sub></mark> ← I<sup>C</sup><sub>3</sub>"),
        ("I_{rotor}", "I<sub>rotor</sub>"),
        ("V_i ×^* I_i", "V<sub>4</sub> ×<sup>*</sup> I<sub>4</sub>"),
    ],
)
def test_a_formula_has_the_numbers_of_the_bodies(text, html):
    assert formula(text, {"i": 4, "p": 3, "j": 1, "k": 2}) == html


def test_a_wrench_on_its_way_to_the_base_names_the_body_that_it_comes_from():
    steps = data(stepper({"x": traced("go2", "crba")}))["robots"][0]["steps"]
    texts = [re.sub("<[^>]*>", "", step["formula"]) for step in steps if step["anchor"] == "49.8 F_j"]
    assert texts[:3] == ["F12,13 = X13T F13,13", "F11,13 = X12T F12,13", "F1,13 = X11T F11,13"]


# ---------------------------------------------------------------- the numbers


@pytest.mark.parametrize("algorithm", NEEDS)
@pytest.mark.parametrize("name", ["go2", "cart_pole", "double_pendulum"])
def test_the_numbers_are_those_of_the_trace_at_the_line_that_gives_them(name, algorithm):
    trace = traced(name, algorithm)
    found = data(stepper({"x": trace}))
    steps, values = found["robots"][0]["steps"], found["cases"][0]["values"]
    kept = [step for step in trace.steps if step.name != "B"]
    assert len(kept) == len(steps) == len(values)
    for step, shown, value in zip(kept, steps, values, strict=True):
        np.testing.assert_allclose(np.array(value, float), step.value, rtol=1e-3, atol=1e-9)  # four digits are shown
        listing = found["listings"][shown["listing"]]
        assert listing["lines"][shown["line"] - listing["first"]].strip() == step.source.strip()
        assert listing["name"] == step.function
        assert (shown["name"], shown["anchor"]) == (step.name, step.anchor)


def test_where_the_bodies_are():
    trace = traced("go2", "rnea")
    frames = data(stepper({"x": trace}))["cases"][0]["frames"]
    model, rng = trace.model, np.random.default_rng(1)
    placement = tw.forward_kinematics(model, model.random_configuration(rng=rng)).placement
    for (R, p), T in zip(frames, placement, strict=True):
        np.testing.assert_allclose(R, T.rotation, atol=1e-3)
        np.testing.assert_allclose(p, T.translation, rtol=1e-3, atol=1e-9)


def test_a_turned_base_changes_the_accelerations_and_not_the_twists():
    model = shared("go2")
    q = model.standing()
    turned = model.integrate(q, [0.5, *np.zeros(17)])
    traces = {str(k): tw.trace(model, "rnea", x, np.ones(18), np.zeros(18)) for k, x in enumerate((q, turned))}
    found = data(stepper(traces))
    names = [step["name"] for step in found["robots"][0]["steps"]]
    again = {name for name, value in zip(names, found["cases"][1]["values"]) if value is None}
    other = {name for name, value in zip(names, found["cases"][1]["values"]) if value is not None}
    assert len(found["robots"]) == 1
    assert again >= {"V"}
    assert other == {"A", "F", "tau"}


def test_units_tell_a_joint_that_turns_from_one_that_slides():
    steps = data(stepper({"x": traced("cart_pole", "rnea")}))["robots"][0]["steps"]
    assert [step["units"] for step in steps if step["name"] == "tau"] == [["N m"], ["N"]]  # the pole, then the cart
    steps = data(stepper({"x": traced("cart_pole", "crba")}))["robots"][0]["steps"]
    assert [step["units"] for step in steps if step["name"] == "M"] == [["kg m²"], ["kg m"], ["kg m"], ["kg"]]
    steps = data(stepper({"x": traced("cart_pole", "ccrba")}))["robots"][0]["steps"]
    assert [step["units"] for step in steps if step["name"] == "A_G"] == [["kg m", "kg"], ["kg m²", "kg m"]]


def test_the_steps_of_the_ccrba_end_at_the_centroidal_map():
    for name in ("go2", "double_pendulum"):
        trace = traced(name, "ccrba")
        q = trace.model.random_configuration(rng=np.random.default_rng(1))
        columns = [step.value for step in trace.steps if step.name == "A_G"]
        np.testing.assert_array_equal(np.hstack(columns), tw.centroidal_map(trace.model, q))
        last = {step.index: step.value for step in trace.steps if step.name == "IC"}
        for i, value in last.items():
            np.testing.assert_allclose(value, trace["IC"][i], rtol=1e-12, atol=1e-12)
        v = np.random.default_rng(2).standard_normal(trace.model.nv)
        np.testing.assert_allclose(trace.result @ v, tw.centroidal_momentum(trace.model, q, v), rtol=1e-12, atol=1e-13)


# ---------------------------------------------------------------- the page


def test_the_page_fetches_nothing():
    page = traced("go2", "aba")._repr_html_()
    assert not re.search(r"https?:|src=|@import|url\((?!#)|fetch\(", page)


def test_traces_of_two_algorithms_have_no_page():
    both = {"a": traced("go2", "crba"), "b": traced("go2", "ccrba")}
    with pytest.raises(ValueError, match=r"expected traces of one algorithm, got \['ccrba', 'crba'\]"):
        stepper(both)
    with pytest.raises(ValueError, match=r"got \[\]"):
        stepper({})
    with pytest.raises(tw.NameNotFound, match="language"):
        stepper({"a": both["a"]}, "fr")


def test_the_force_of_a_joint_is_an_arrow_along_its_axis():
    model = tw.load("cart_pole")
    found = data(stepper({"x": traced("cart_pole", "rnea")}))["robots"][0]["steps"]
    along = {step["frame"]: step["along"] for step in found if step["name"] == "tau"}
    assert along == {i: tree_terms(model, model.neutral()).S[i][:, 0].tolist() for i in (1, 2)}
    assert not any(step["along"] for step in found if step["name"] != "tau")


@pytest.fixture(scope="module")
def browser():
    """Yield a Chromium for all tests of this file: a start takes more than most of them."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed: no page is opened")
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        pytest.skip("no chromium on the PATH, and $CHROMIUM is not set: no page is opened")
    with sync_api.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture
def opened(tmp_path, browser):
    """Yield a function that opens HTML as a page without a network; nothing may go wrong there."""
    errors = []

    def show(html, width=1280, motion="no-preference"):
        file = tmp_path / "page.html"
        file.write_text(f"<!doctype html><meta charset='utf-8'>{html}", encoding="utf-8")
        size = {"width": width, "height": 800}
        page = browser.new_context(offline=True, viewport=size, reduced_motion=motion).new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda line: errors.append(line.text) if line.type == "error" else None)
        page.clock.install()
        page.goto(file.as_uri())
        return page

    yield show
    for context in browser.contexts:
        context.close()
    assert not errors


def pendulums():
    model = shared("double_pendulum")
    return {str(q): tw.trace(model, "rnea", [q, 0.0], [1.0, 0.0], [0.0, 0.0]) for q in (0.0, 0.5)}


def test_keys_buttons_and_bodies_lead_from_line_to_line(opened):
    page = opened(stepper(pendulums()))
    count, lit = page.locator(".count"), page.locator("pre .lit")
    assert count.inner_text() == "1 of 11"
    page.locator(".on").focus()
    page.keyboard.press("ArrowRight")
    assert (count.inner_text(), "49.6 V" in lit.inner_text()) == ("2 of 11", True)
    page.keyboard.press("End")
    assert "49.6 F_p" in lit.inner_text()
    page.keyboard.press("Home")
    page.keyboard.press("ArrowLeft")  # there is nothing before the first
    assert count.inner_text() == "1 of 11"
    page.get_by_role("button", name="2 elbow").click()
    assert (count.inner_text(), page.locator(".formula mark").inner_text()) == ("5 of 11", "V2")
    page.keyboard.press("End")
    before = page.locator(".grid").inner_text()
    page.select_option("select", "1")
    assert page.locator(".grid").inner_text() != before


def test_it_plays_until_the_reader_takes_over_and_is_not_read_aloud_meanwhile(opened):
    page = opened(stepper(pendulums(), playing=True))
    count, now = page.locator(".count"), page.locator(".now")
    assert (count.inner_text(), now.get_attribute("aria-live")) == ("1 of 11", "off")
    page.clock.run_for(1400)
    assert count.inner_text() == "2 of 11"
    page.locator("svg").focus()
    page.keyboard.press(" ")
    page.clock.run_for(5000)
    assert (count.inner_text(), now.get_attribute("aria-live")) == ("2 of 11", "polite")
    page.keyboard.press(" ")
    page.clock.run_for(1400)
    assert count.inner_text() == "3 of 11"
    page.keyboard.press("ArrowRight")  # the reader goes on by hand
    page.clock.run_for(5000)
    assert count.inner_text() == "4 of 11"
    page.keyboard.press("End")
    page.get_by_role("button", name="Play").click()
    page.clock.run_for(1400)  # from the beginning again
    assert count.inner_text() == "1 of 11"


def test_where_no_motion_is_wanted_it_waits(opened):
    page = opened(stepper(pendulums(), playing=True), motion="reduce")
    page.clock.run_for(5000)
    assert page.locator(".count").inner_text() == "1 of 11"


@pytest.mark.one_case
@pytest.mark.parametrize("width", [390, 1280])
@pytest.mark.parametrize("algorithm", ["rnea", "aba"])
def test_nothing_moves_from_one_step_to_the_next(opened, algorithm, width):
    page = opened(stepper({"x": traced("go2", algorithm)}), width)
    places = page.evaluate("""() => {
      const root = document.querySelector(".tw-stepper"), slider = root.querySelector(".slider"), seen = new Set();
      for (let k = 0; k <= Number(slider.max); k++) {
        slider.value = k;
        slider.oninput();
        const tops = [...root.querySelectorAll(".panel > div, .bodies, svg")].map((e) => e.getBoundingClientRect());
        seen.add(JSON.stringify(tops.map((r) => [r.top, r.height])));
      }
      return [...seen];
    }""")
    assert len(places) == 1
    assert page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth") <= 0

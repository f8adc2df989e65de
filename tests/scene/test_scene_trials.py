"""The trials of scenes: the tables of both pages are those of the results, and a run finds them again."""

import json

import pytest

from ..pages import page


@pytest.fixture
def maker(benchmark_file):
    """benchmarks/scene_trials.py, which makes the pages' table."""
    return benchmark_file("scene_trials")


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_table_of_the_page_is_that_of_the_results(maker, benchmark_file, language):
    text = page("scenes", language).read_text(encoding="utf-8")
    assert benchmark_file("tables").fill(text, maker.tables(language)) == text
    assert text.count("| `") >= 26
    assert set(maker.results()) == {trial.function for trial in maker.TRIALS if trial.function}


@pytest.mark.slow(one_in=3)
def test_each_trial_is_as_near_as_the_table_says(maker):
    """Roundings differ from one machine to another: up to ten times, and 1e-13 is enough."""
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: nothing is compared with it")
    pytest.importorskip("scipy", reason="SciPy is not installed: nothing is compared with it")
    before = maker.results()
    for trial in maker.TRIALS:
        if trial.function and trial.engine != "mujoco":
            allowed = max(1e-13, (1.1 if before[trial.function] > 1e-5 else 10) * before[trial.function])
            assert maker.function(trial)() <= allowed, trial.english


@pytest.fixture
def chooser(benchmark_file):
    """benchmarks/scenes_to_choose.py, which makes the table of what `cheapest` promises."""
    return benchmark_file("scenes_to_choose")


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_choices_of_the_page_are_those_of_the_results(chooser, benchmark_file, language):
    text = page("scenes", language).read_text(encoding="utf-8")
    assert benchmark_file("tables").fill(text, chooser.tables(language)) == text
    found = json.loads(chooser.RESULTS.read_text(encoding="utf-8"))
    assert len(found) == len(chooser.CASES) == 12
    assert [name for name, rows in found.items() if not rows[0]["holds"]] == ["parallelogram_with_one_motor"]
    for rows in found.values():
        assert rows[-1]["holds"]
        assert all(row["promised"][x] * row["margin"] <= most for row in rows for x, most in row["allowed"].items())


@pytest.mark.one_case
@pytest.mark.parametrize("name", ["biped_in_a_plane", "cart_whose_pole_has_no_motor", "parallelogram_with_one_motor"])
def test_a_choice_is_found_again(chooser, name):
    before = json.loads(chooser.RESULTS.read_text(encoding="utf-8"))[name]
    for row, known in zip(chooser.choose(name), before, strict=True):
        assert (row["choice"], row["tells"], row["holds"]) == (known["choice"], known["tells"], known["holds"])
        assert row["found"] == pytest.approx(known["found"], rel=1e-6, abs=1e-12)
        assert row["promised"] == pytest.approx(known["promised"], rel=1e-6, abs=1e-12)

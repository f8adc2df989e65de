"""The trials of scenes: the tables of both pages are those of the results, and a run finds them again."""

import importlib
from pathlib import Path

import pytest

from ..pages import page


@pytest.fixture
def maker(monkeypatch):
    """benchmarks/scene_trials.py, which makes the pages' table."""
    monkeypatch.syspath_prepend(str(Path(__file__).parents[2] / "benchmarks"))
    return importlib.import_module("scene_trials")


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_table_of_the_page_is_that_of_the_results(maker, language):
    text = page("scenes", language).read_text(encoding="utf-8")
    assert maker.fill(text, maker.tables(language)) == text
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

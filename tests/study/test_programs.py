"""docs/compile.md: its code, its tables and the recorder without one of its rules; `twistwrench advise`."""

import importlib
import re
from pathlib import Path

import numpy as np
import pytest
from tables import fill

import twistwrench as tw
from twistwrench.advice import USES, advise
from twistwrench.cli import main

from ..pages import blocks, page, run
from ..robots import shared

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def maker(monkeypatch):
    """benchmarks/programs.py, which makes the page's tables."""
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    return importlib.import_module("programs")


@pytest.mark.slow
def test_the_code_of_the_page_runs_and_is_the_same_in_both_languages():
    texts = [page("compile", language).read_text(encoding="utf-8") for language in ("", ".zh-CN")]
    code = [blocks(text, 0, len(text)) for text in texts]
    assert [block.strip() for block in code[0]] == [block.strip() for block in code[1]]
    run(page("compile"), code[0])


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_tables_of_the_page_are_those_of_the_results(maker, language):
    text = page("compile", language).read_text(encoding="utf-8")
    assert fill(text, maker.tables()) == text
    assert set(re.findall(r"<!-- table: (\w+) -->", text)) == set(maker.tables())


@pytest.mark.slow
def test_each_rule_saves_what_the_page_says(maker):
    counts = {(rule, want): n for rule, want, n in maker.rules()}
    found = maker.json.loads(maker.RESULTS.read_text(encoding="utf-8"))
    assert counts == {(rule, want): n for rule, want, n in found["rules"]}
    assert all(n >= counts["all rules", want] for (_, want), n in counts.items())
    assert counts["0 and 1 kept", "`rnea`"] > 2.5 * counts["all rules", "`rnea`"]


def test_without_a_rule_the_numbers_are_the_same(maker):
    model = shared("double_pendulum")
    q, v, a = np.array([[0.3, -0.4], [1.0, 2.0], [0.5, 0.6]])
    for tape in maker.RULES.values():
        with maker.recorded_on(tape):
            program = tw.compile(model, "rnea")
            program.line  # noqa: B018 - recorded here
            assert program(q, v, a) == pytest.approx(tw.rnea(model, q, v, a), rel=1e-14)


@pytest.mark.parametrize("use", USES)
def test_every_use_is_measured(use):
    pytest.importorskip("mpmath", reason="mpmath is not installed: there is no truth to hold anything against")
    found = advise(shared("double_pendulum"), use, rounds=1)
    assert found.seconds > 0
    largest = {"float32": 1e-1, "float64": 1e-9, "double-double": 1e-27, "50 digits": 1e-45}[found.number]
    assert 0 <= found.error < largest
    assert found.number in str(found)


def test_a_row_is_printed_and_an_unknown_use_lists_the_known(capsys):
    pytest.importorskip("mpmath", reason="mpmath is not installed: there is no truth to hold anything against")
    assert main(["advise", "pendulum", "--use", "mpc"]) == 0
    assert "dtau_dq" in capsys.readouterr().out
    assert main(["advise", "pendulum", "--use", "chess"]) == 2
    assert "unknown use 'chess'" in (said := capsys.readouterr().err)
    assert "verification" in said

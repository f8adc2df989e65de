"""docs/urdf.md: its blocks run, its table is that of the corpus, and what is installed of it has the verdict there."""

from __future__ import annotations

import csv
import hashlib
import re
import warnings
from pathlib import Path

import pytest

import twistwrench as tw
from twistwrench.loading.catalogue import example_robot_data_folder

from ..pages import blocks, names_author_and_licence, page, run

ROWS = list(
    csv.DictReader(
        (Path(__file__).parents[2] / "benchmarks/results/corpus.csv").read_text(encoding="utf-8").splitlines()
    )
)
BY_PINOCCHIO = [row for row in ROWS if row["pinocchio"] == "loaded"]
FOLDER = example_robot_data_folder()


def text(language=""):
    return page("urdf", language).read_text(encoding="utf-8")


def sources(language=""):
    return blocks(text(language), 0, len(text(language)))


def test_every_block_of_the_page_runs(capsys):
    run(page("urdf"), sources())
    shown = re.search(r"```text\n(.*?)```", text(), re.DOTALL)[1]
    assert capsys.readouterr().out == shown


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_both_languages_have_the_same_code_and_name_author_and_licence(language):
    assert [block.strip("\n") for block in sources(language)] == [block.strip("\n") for block in sources()]
    assert names_author_and_licence(page("urdf", language))
    assert all(re.search(r"^ *assert ", block, re.MULTILINE) for block in sources(language))


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_table_is_that_of_the_corpus(language):
    counts = [int(n) for n in re.findall(r"\| (\d+) \|$", text(language), re.MULTILINE)]
    verdicts = [row["verdict"] for row in BY_PINOCCHIO]
    refused = [row for row in BY_PINOCCHIO if row["verdict"] == "refused"]
    hopeless = [r for r in refused if r["physical_false"] == "refused" and "mimic='independent'" not in r["message"]]
    assert counts == [
        verdicts.count("loaded"),
        verdicts.count("with a report"),
        verdicts.count("not physical"),
        len(refused) - len(hopeless),
        len(hopeless),
    ]
    assert all(re.search(rf"\b{n}\b", text(language)) for n in (len(ROWS), len(BY_PINOCCHIO)))
    assert len({row["package"] for row in ROWS}) == 24
    assert ["two <axis>" in row["message"] for row in hopeless] == [True]
    assert sum("no <inertia>" in row["message"] for row in BY_PINOCCHIO) == 8
    assert sum("joint has none" in row["message"] for row in BY_PINOCCHIO) == 11
    assert sum("neither lower nor upper" in row["message"] for row in BY_PINOCCHIO) == 6
    assert max(float(row["difference"]) for row in ROWS if row["difference"]) < 8e-14


def test_what_pinocchio_refuses_is_refused_for_a_reason_that_is_named():
    others = [row for row in ROWS if row["pinocchio"] == "refused"]
    assert all(row["verdict"] == "refused" and row["message"].startswith("robot.urdf") for row in others)
    assert len(others) == len(ROWS) - len(BY_PINOCCHIO)


@pytest.mark.slow
@pytest.mark.skipif(FOLDER is None, reason="example-robot-data is not installed: its part of the corpus is not loaded")
def test_verdicts_of_what_is_installed():
    known = {row["sha256"]: row for row in ROWS if row["package"].startswith("example_robot_data")}
    found = 0
    for path in sorted(FOLDER.glob("**/*.urdf")):
        row = known.get(hashlib.sha256(path.read_bytes()).hexdigest())
        if row is None:
            continue  # another version of the package
        found += 1
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                tw.load(path)
                impossible = any("cannot exist" in str(warning.message) for warning in caught)
                verdict = "not physical" if impossible else "with a report" if caught else "loaded"
            except tw.ModelError:
                verdict = "refused"
        assert verdict == row["verdict"], path
    assert found > 60

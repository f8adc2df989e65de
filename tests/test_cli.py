"""The command line: what is printed, what is written, and the exit status."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.cli import main

pytest.importorskip("mpmath", reason="mpmath is not installed: the comparison with the truth is skipped")

QUICK = ["--states", "2", "--truths", "1"]


def test_validate_prints_a_table_and_succeeds(capsys):
    assert main(["validate", "double_pendulum", *QUICK]) == 0
    out, err = capsys.readouterr()
    assert "mass matrix M" in out
    assert out.splitlines()[-1].startswith("29 of 29 rows inside their bounds")
    assert err == ""


@pytest.mark.slow
def test_validate_without_a_name_takes_go2_and_several_names_a_table_each(capsys):
    assert main(["validate", "--states", "1", "--truths", "1"]) == 0
    assert capsys.readouterr().out.startswith("go2: floating base, 13 moving bodies")
    assert main(["validate", "pendulum", "cart_pole", *QUICK, "--base", "fixed"]) == 0
    out = capsys.readouterr().out
    assert out.count("29 of 29 rows inside") == 2
    assert "\n\ncart_pole: fixed base" in out


def test_validate_fails_with_status_1(monkeypatch, capsys):
    right = tw.rnea
    monkeypatch.setattr(tw, "rnea", lambda *args: np.negative(right(*args)))
    assert main(["validate", "double_pendulum", *QUICK]) == 1
    out = capsys.readouterr().out
    assert "27 of 29 rows inside their bounds; outside: inverse dynamics, inverse dynamics, f_ext" in out


def test_an_unknown_robot_suggests_names_with_status_2(capsys):
    assert main(["validate", "pendulun"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "unknown robot 'pendulun'; did you mean 'pendulum'" in err


def test_a_missing_file_is_named_with_status_2(capsys):
    assert main(["validate", "nowhere/robot.urdf"]) == 2
    assert "nowhere/robot.urdf: no such file" in capsys.readouterr().err


@pytest.mark.parametrize(
    "wrong",
    [["validate", "--states", "0"], ["validate", "go2", "--all"], ["validate", "--base", "flying"], [], ["fly"]],
)
def test_misuse_has_status_2(wrong, capsys):
    with pytest.raises(SystemExit) as stop:
        main(wrong)
    assert stop.value.code == 2
    assert "usage: twistwrench" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--seed", "-1"], "argument --seed: expected a whole number, 0 or more, got '-1'"),
        (["--states", "x"], "argument --states: expected a whole number, 1 or more, got 'x'"),
        (["--truths", "1.5"], "argument --truths: expected a whole number, 1 or more, got '1.5'"),
        (["--jobs", "2"], "argument --jobs: only with --all"),
        (["--truths", "9"], "argument --truths: expected at most the number of states, 8, got 9"),
    ],
)
def test_an_option_of_no_effect_is_refused(options, said, capsys):
    with pytest.raises(SystemExit) as stop:
        main(["validate", "pendulum", *options])
    assert stop.value.code == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert said in err


def test_the_version_and_python_dash_m(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["--version"])
    assert stop.value.code == 0
    said = capsys.readouterr().out
    assert said == f"twistwrench {tw.__version__}\n"
    ran = subprocess.run([sys.executable, "-m", "twistwrench", "--version"], capture_output=True, text=True)
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, said, "")
    with pytest.raises(SystemExit) as stop:
        main([])
    assert stop.value.code == 2


def test_json_goes_to_stdout_alone(capsys):
    assert main(["validate", "pendulum", "cart_pole", *QUICK, "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["passed"] is True
    assert [report["robot"] for report in found["reports"]] == ["pendulum", "cart_pole"]
    assert found["reports"][0]["rows"][0]["ours_vs_truth"] < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("encoding", ["ascii", pytest.param("cp1252", marks=pytest.mark.slow)])
def test_letters_that_the_output_lacks_are_shown_by_their_numbers(encoding):
    def said(*arguments):
        environment = os.environ | {"PYTHONIOENCODING": encoding}
        command = [sys.executable, "-m", "twistwrench", *arguments]
        ran = subprocess.run(command, capture_output=True, env=environment)
        assert (ran.returncode, ran.stderr) == (0, b"")
        return ran.stdout.decode(encoding)

    assert r"1e-12  \u2713" in said("validate", "pendulum", "--states", "1")
    rows = json.loads(said("validate", "pendulum", "--states", "1", "--json", "-"))["reports"][0]["rows"]
    assert "J̇ v, local" in [row["quantity"] for row in rows]


def test_json_goes_to_a_file_beside_the_table(tmp_path, capsys):
    file = tmp_path / "report.json"
    assert main(["validate", "pendulum", *QUICK, "--json", str(file)]) == 0
    assert "29 of 29 rows" in capsys.readouterr().out
    assert json.loads(file.read_text(encoding="utf-8"))["passed"] is True


def test_a_file_that_cannot_be_written_is_noticed_before_the_work(tmp_path, capsys):
    for command, option in [
        (["validate", "pendulum", *QUICK], "--json"),
        (["view", "pendulum"], "--output"),
    ]:
        folder = tmp_path / f"folder{'.json' if option == '--json' else '.png'}"
        folder.mkdir(exist_ok=True)
        for path in (folder, tmp_path / "nowhere" / folder.name):
            assert main([*command, option, str(path)]) == 2
            out, err = capsys.readouterr()
            assert out == ""
            assert f"{option} {path}: " in err


def test_a_file_without_a_name_is_none(capsys):
    assert main(["validate", "pendulum", *QUICK, "--json", ""]) == 2
    assert capsys.readouterr().out == ""


def test_of_several_robots_all_are_known_before_the_work(capsys):
    assert main(["validate", "pendulum", "pendulun", *QUICK]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "unknown robot 'pendulun'" in err


def test_a_file_is_neither_emptied_nor_made_before_there_is_something_to_write(tmp_path, capsys):
    old, new = tmp_path / "old.json", tmp_path / "new.json"
    old.write_text("kept")
    for path in (old, new):
        assert main(["validate", "pendulun", *QUICK, "--json", str(path)]) == 2
    assert old.read_text() == "kept"
    assert not new.exists()


@pytest.mark.slow
def test_the_seed_changes_the_states(capsys):
    def rows(seed):
        main(["validate", "cart_pole", *QUICK, "--seed", seed, "--json", "-"])
        return json.loads(capsys.readouterr().out)["reports"][0]["rows"]

    assert rows("1") == rows("1") != rows("2")


def test_the_bar_is_on_stderr_where_asked_for(capsys):
    assert main(["validate", "pendulum", *QUICK, "--progress"]) == 0
    out, err = capsys.readouterr()
    assert "pendulum:" in err
    assert "%|" not in out


def test_all_goes_through_the_catalogue(monkeypatch, capsys):
    from twistwrench.validate import sweep

    monkeypatch.setattr(sweep, "every_robot", lambda base: [("pendulum", base or "fixed"), ("nonsense", "fixed")])
    assert main(["validate", "--all", "--jobs", "1", *QUICK]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split()[:3] == ["robot", "base", "nv"]
    assert lines[1].split()[:4] == ["pendulum", "fixed", "1", "29/29"]
    assert "unknown robot 'nonsense'" in lines[2]
    assert lines[-1].startswith("1 of 2 robots and bases inside all their bounds, 29 rows; not: nonsense (fixed)")
    assert main(["validate", "--all", "--jobs", "1", *QUICK, "--json", "-"]) == 1
    assert [report["passed"] for report in json.loads(capsys.readouterr().out)["reports"]] == [True, False]


def test_robots_lists_the_catalogue(capsys):
    assert main(["robots"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == len(tw.robots()) + 1
    assert main(["robots", "--source", "models"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 7


def test_an_interrupt_says_so_by_its_status(monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("twistwrench.validate.validate", interrupted)
    assert main(["validate", "pendulum"]) == 130


@pytest.mark.slow
def test_help_is_quick_and_a_reader_that_leaves_is_no_error():
    script = "import sys; from twistwrench.cli import main; sys.exit(main(['robots']))"
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdout.close()
    error = process.stderr.read()
    process.stderr.close()
    process.wait()
    assert error == b""
    loaded = "import sys, twistwrench.cli; print([m for m in ('pinocchio', 'mpmath', 'tqdm') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True).stdout == "[]\n"

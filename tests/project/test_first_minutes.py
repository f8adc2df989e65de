"""What a newcomer types wrong, and what is said: the argument, what was expected, what came, what to do."""

import builtins
import re
import subprocess
import sys

import numpy as np
import pytest
from study.__main__ import main as study_main
from study.record import Record
from study.speed import QUANTITIES, shown
from study.trade import SHORT, weigh

import twistwrench as tw
from twistwrench.cli import main

from ..robots import shared

GO2 = shared("go2")
PENDULUM = shared("pendulum")


@pytest.mark.parametrize(
    ("name", "nearest"),
    [("talos", "talos_"), ("unitree_go2", "go2"), ("Go2_description", "go2"), ("anymal", "anymal_")],
)
def test_a_name_that_is_part_of_a_known_one_is_recognised(name, nearest):
    with pytest.raises(tw.NameNotFound, match=f"unknown robot '{name}'; did you mean '{nearest}"):
        tw.load(name)


def test_the_nearest_names_are_four_at_most_and_none_twice():
    with pytest.raises(tw.NameNotFound) as caught:
        GO2.frame("FL")
    named = re.findall(r"'(FL_\w+)'", str(caught.value))
    assert len(named) == len(set(named)) == 4
    with pytest.raises(tw.NameNotFound, match="known: "):
        tw.load("")


def test_a_file_beside_it_is_named_where_its_suffix_was_left_out(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my_arm.urdf").touch()
    with pytest.raises(tw.NameNotFound, match=r"unknown robot 'my_arm'; .*its file would be 'my_arm\.urdf'"):
        tw.load("my_arm")


def test_a_robot_is_a_name_or_a_path():
    with pytest.raises(TypeError, match=r"source: expected a name, a path or the text of a URDF, got None$"):
        tw.load(None)
    with pytest.raises(TypeError, match=r"source: expected a name, a path or the text of a URDF, got the Model$"):
        tw.load(PENDULUM)


def test_a_value_in_place_of_a_name_says_its_type_once():
    with pytest.raises(tw.NameNotFound, match=r"algorithm: expected a name, got Model 'pendulum'.*; known: 'rnea', "):
        tw.trace("rnea", PENDULUM, [0.0])
    with pytest.raises(tw.NameNotFound, match=r"algorithm: expected a name, got function <.*>; known: 'rnea', "):
        tw.trace(PENDULUM, tw.rnea, [0.0], [0.0], [0.0])


def test_joints_without_the_base_are_recognised():
    rest = np.zeros(GO2.nv)
    with pytest.raises(tw.ShapeError, match=r"q: .* got \(12,\); the 7 entries of the floating base come before"):
        tw.rnea(GO2, np.zeros(12), rest, rest)
    with pytest.raises(tw.ShapeError, match=r"a: .* got \(12,\); the 6 entries of the floating base come before"):
        tw.rnea(GO2, GO2.standing(), rest, np.zeros(12))


def test_states_in_columns_are_recognised():
    with pytest.raises(tw.ShapeError, match=r"q: .* got \(19, 5\); the axis of length 19 must be the last"):
        tw.crba(GO2, np.tile(GO2.standing(), (5, 1)).T)


def test_a_quaternion_of_zeros_is_told_what_to_be():
    with pytest.raises(ValueError, match=r"has norm 0, expected 1; model.neutral\(\) has the identity"):
        tw.crba(GO2, np.zeros(19))
    with pytest.raises(ValueError, match=r"has norm 2, expected 1; model.normalize\(q\) repairs it"):
        tw.crba(GO2, np.r_[np.zeros(6), 2.0, np.zeros(12)])


def test_what_stands_on_nothing_is_told_why():
    with pytest.raises(ValueError, match="'pendulum': expected a floating base, got a fixed one"):
        tw.static_equilibrium(PENDULUM, [0.0])
    with pytest.raises(ValueError, match="'go2': expected at least one contact, got none"):
        tw.static_equilibrium(GO2, GO2.standing(), [])
    with pytest.raises(tw.NameNotFound, match=r"no standing posture; there is neutral"):
        PENDULUM.standing()


def test_python_names_the_function_that_was_meant():
    done = subprocess.run(
        [sys.executable, "-c", "import twistwrench as tw; tw.nonlinear_effect"], capture_output=True, text=True
    )
    assert "no attribute 'nonlinear_effect'. Did you mean: 'nonlinear_effects'?" in done.stderr


def test_dynamics_print_as_shapes():
    d = tw.dynamics(PENDULUM, [0.0], [0.0], want={"M", "h"})
    assert repr(d) == "Dynamics(M: (1, 1), h: (1,))"


def test_the_command_alone_tells_the_commands(capsys):
    with pytest.raises(SystemExit):
        main([])
    assert "hold every quantity against Pinocchio" in capsys.readouterr().err


@pytest.fixture
def no_matplotlib(monkeypatch):
    """Let matplotlib be missing."""
    kept = builtins.__import__

    def missing(name, *args, **kwargs):
        if name.split(".")[0] == "matplotlib":
            raise ModuleNotFoundError("No module named 'matplotlib'", name="matplotlib")
        return kept(name, *args, **kwargs)

    monkeypatch.setattr(builtins, "__import__", missing)


@pytest.mark.usefixtures("no_matplotlib")
def test_without_matplotlib_the_command_and_the_call_say_how_to_get_it(tmp_path, capsys):
    assert main(["view", "pendulum", "--output", str(tmp_path / "x.png")]) == 2
    assert 'pip install "twistwrench[plot]"' in capsys.readouterr().err
    for draw in (tw.plot.robot, tw.view):
        with pytest.raises(ModuleNotFoundError, match=r'a picture needs matplotlib: pip install "twistwrench\[plot\]"'):
            draw(PENDULUM, [0.0])
    with pytest.raises(ModuleNotFoundError, match="twistwrench"):
        tw.plot.matrix(np.eye(2))
    with pytest.raises(ModuleNotFoundError, match="twistwrench"):
        tw.simulate(PENDULUM, [0.5], [0.0], dt=0.1, steps=1).plot()


def test_without_pinocchio_and_mpmath_the_commands_say_how_to_get_them(monkeypatch, capsys):
    for name in ("pinocchio", "mpmath"):
        monkeypatch.setitem(sys.modules, name, None)
    assert main(["validate", "--all"]) == 2  # once, and not a line for each robot
    assert capsys.readouterr() == (
        "",
        'twistwrench: nothing to compare with: pip install "twistwrench[validate]" brings Pinocchio and mpmath\n',
    )
    for study in ("trade", "extremes"):
        assert study_main([study]) == 2
        assert 'twistwrench: the truth needs mpmath: pip install "twistwrench[validate]"\n' in capsys.readouterr().err


@pytest.mark.parametrize("there", [True, False])
def test_starting_the_exercises_says_where_pytest_is_missing(there, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("misstep.commands.find_spec", lambda name: there or None)
    assert main(["exercises", "start", str(tmp_path / "mine")]) == 0
    printed = capsys.readouterr().out
    assert "&& python -m pytest" in printed
    assert ("pip install pytest" in printed) is not there


def test_the_table_of_speeds_fits_into_a_hundred_columns():
    ways = [
        ("Pinocchio", "float64", 300, 1e-5),
        ("textbook", "float64", 1, 1.23456e-2),
        ("fast", "float64", 1, 1.23456e-2),
    ]
    ways += [("fast", number, 1000, 1.23456e-2) for number in ("float64", "float32")]
    rows = [
        Record(key, way, number, states=n, seconds=seconds, quiet=False)
        for key in QUANTITIES
        for way, number, n, seconds in ways
    ]
    lines = shown(GO2, rows).splitlines()
    assert max(map(len, lines)) <= 100
    assert lines[3].split() == ["Pinocchio", "textbook", "fast", "1000", "states", "1000", "float32"]
    assert lines[4].split("  ")[-1].strip() == "~12346 (1235)"


@pytest.mark.slow
def test_the_tables_of_a_trade_fit_into_a_hundred_columns():
    pytest.importorskip("mpmath", reason="the truth is computed by mpmath")
    text = str(weigh(PENDULUM, only=["FD"], effort=SHORT))
    assert max(map(len, text.splitlines())) <= 100

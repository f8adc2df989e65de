"""The extremes: closed forms, and no cell that is silently bad."""

import importlib
import json
import random
import re
import sys
from dataclasses import replace
from functools import lru_cache
from itertools import product

import mpmath
import numpy as np
import pytest
from study.__main__ import main as study_main
from study.extremes import cells as measuring
from study.extremes import grid, report
from study.extremes.cells import Cell, measure
from study.extremes.grid import DIMENSIONS, ENDS, cells, of_pair, of_value
from study.extremes.robots import Recipe
from study.extremes.truth import accelerations, truth
from study.record import Record
from study.turns import exact_exp, exact_log, turns
from tables import fill

import twistwrench as tw
from study import pictures
from twistwrench import newton_euler_3d as ne
from twistwrench.plot.style import COLOURS

from ..pages import DOCS, numbered, page
from ..pages import run as run_page
from ..sampling import sampled

EPS = 2.0**-52


@pytest.fixture(autouse=True)
def fifty_digits():
    with mpmath.workdps(50):
        yield


# ---------------------------------------------------------------- closed forms

ODD = [Recipe(mass_ratio=1e9), Recipe(light=0.0), Recipe(leaves=True, tip=1e-12), Recipe(distance=1e9, length=1e-9)]


@pytest.mark.one_case
@pytest.mark.parametrize("recipe", ODD, ids=lambda recipe: str(recipe.changed))
def test_without_torques_and_at_rest_every_robot_falls_as_one_body(recipe):
    model, s = recipe.model, recipe.state
    s, none = s._replace(v=0 * s.v), 0 * s.v
    x, y, z, w = s.q[3:7] / np.hypot.reduce(s.q[3:7])
    down = np.array([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)])  # the world's z, in the base
    falls = np.concatenate([np.zeros(3), model.gravity[2] * down, np.zeros(model.nv - 6)])
    right = accelerations(model, s, none)
    assert np.abs((right - falls).astype(float)).max() < 4 * EPS * abs(model.gravity[2])
    bound = float(tw.accuracy(model, s.q).aba) * abs(model.gravity[2])
    for aba in (tw.aba, tw.fast.aba):
        assert np.abs(aba(model, s.q, none, none)[3:6] - falls[3:6]).max() < bound


def test_the_base_of_a_star_feels_the_mass_of_all():
    recipe = Recipe(leaves=True, bodies=10)
    right = truth(recipe.model, recipe.state)
    assert np.abs((right.right["M"][3:6, 3:6] - 10 * np.eye(3)).astype(float)).max() < 1e-14


def test_a_heavy_rotor_takes_a_torque_alone():
    recipe = Recipe(rotor=1e9)
    right = truth(recipe.model, recipe.state)
    alone = right.torques["pushed"] / recipe.model.armature.clip(1)
    assert right.right["pushed"][6:].astype(float) == pytest.approx(alone[6:], rel=1e-5)


# ---------------------------------------------------------------- the truth and the measure


@pytest.mark.slow
def test_fifty_digits_are_enough():
    """Twice as many change no error by a thousandth."""
    recipe = Recipe(mass_ratio=1e9, speed=1e8, light=1e-9, parallel=1e-6, length=1e-9)
    fifty, hundred = (measure(recipe, with_pinocchio=False, digits=digits) for digits in (50, 100))
    for one, other in zip(fifty, hundred, strict=True):
        assert (one.raised, one.fault) == (other.raised, other.fault)
        assert (one.error is None) == (other.error is None)
        assert one.error is None or one.error == pytest.approx(other.error, rel=1e-3)


def test_newton_s_accelerations_are_those_of_elimination():
    recipe = Recipe(mass_ratio=1e6)
    model, s = recipe.model, recipe.state
    torques = np.linspace(-3, 5, model.nv)
    right = ne.forward_dynamics(model, *(ne.as_mpmath(x) for x in (s.q, s.v, torques)))
    assert (abs(accelerations(model, s, torques) - right) <= 1e-22 * abs(right).max()).all()


@pytest.mark.parametrize("recipe", [Recipe(mass_ratio=1e18, bodies=2), Recipe(mass_ratio=1e20, bodies=3)])
def test_where_newton_does_not_come_to_rest_elimination_finds_the_accelerations(recipe):
    model, s = recipe.model, recipe.state
    found = truth(model, s)
    q, v, tau = (ne.as_mpmath(x) for x in (s.q, s.v, found.torques["pushed"]))
    right = found.right["pushed"]
    assert (abs(ne.inverse_dynamics(model, q, v, right) - tau) <= 1e-22 * abs(tau).max()).all()
    assert found.error("pushed", right.astype(float)) < 2 * EPS
    assert 1e-7 < found.error("pushed", (right * (1 + 1e-6)).astype(float)) <= 1.001e-6


def test_a_robot_at_rest_in_free_space_stays_there():
    recipe = Recipe(bodies=3)
    model, s = replace(recipe.model, gravity=np.zeros(3)), recipe.state
    assert not accelerations(model, s._replace(v=0 * s.v), 0 * s.v).any()


@pytest.mark.slow
def test_of_a_long_robot_some_columns_of_the_mass_matrix_are_judged(monkeypatch):
    recipe = Recipe()
    whole = truth(recipe.model, recipe.state)
    monkeypatch.setattr("study.extremes.truth.WHOLE", recipe.bodies)
    some, M = truth(recipe.model, recipe.state), whole.right["M"]
    assert (abs(some.right["M"] - M[:, [0, 5, 6, -1]]) <= 1e-45 * abs(M).max()).all()
    wrong = M.astype(float)
    wrong[2, 6] += 1e-6 * float(M[6, 6])
    assert some.error("M", wrong) == pytest.approx(whole.error("M", wrong), rel=1e-9)


def test_all_joints_stand_at_the_angle_that_is_asked_for():
    assert (Recipe(angle=np.pi).state.q[7:] == np.pi).all()


def test_an_error_is_what_is_wrong_of_the_terms():
    recipe = Recipe()
    right = truth(recipe.model, recipe.state)
    M = right.right["M"].astype(float)
    assert right.error("M", M) < 2 * EPS
    assert right.error("M", M * (1 + 1e-6)) == pytest.approx(1e-6, rel=1e-6)  # of a diagonal entry
    qdd = right.right["pushed"].astype(float)
    assert right.error("pushed", qdd) < 2 * EPS
    assert 1e-7 < right.error("pushed", qdd * (1 + 1e-6)) <= 1.001e-6


@lru_cache
def usual_errors():
    return {(o.quantity, o.way): o.error for o in measure(Recipe(), with_pinocchio=False)}


@pytest.mark.slow
@pytest.mark.parametrize("unit", sampled(["length", "mass", "time"], 1))
@pytest.mark.parametrize("scale", sampled([2.0**-30, 2.0**30], 1), ids=["1e-9", "1e9"])
def test_the_same_robot_in_other_units_loses_nothing(unit, scale):
    """Not a bit: by powers of two, of which 2**30 is about 1e9, rounding is the same.

    Only a program may round otherwise, by a small factor: a length of 1 m is no operation in it, and one of 1e-9 is.
    """
    usual = usual_errors()
    for o in measure(Recipe(**{unit: scale}), with_pinocchio=False):
        assert not o.fault
        if o.way == "float32" and o.raised:  # products would overflow
            assert "overflow in float32" in o.raised
        elif o.way == "fast":
            assert o.error <= 4 * usual[o.quantity, o.way] + EPS, o
        else:
            assert o.error == usual[o.quantity, o.way], o


@pytest.mark.parametrize("speed", sampled([1e8, 0.0, 1e4], 1))
def test_a_base_that_flies_fast_loses_nothing(speed):
    """Relative to the terms, in which ω × m v is one: with v × m v computed, `rnea` was off by 6e-9 at 1e8 m/s."""
    usual = usual_errors()
    for o in measure(Recipe(base_speed=speed), with_pinocchio=False):
        assert not o.fault
        if o.error is not None:
            assert o.error < 20 * usual[o.quantity, o.way], o


def test_the_speed_of_the_base_is_its_own():
    usual, fast = Recipe().state, Recipe(base_speed=1e4).state
    assert np.array_equal(fast.v[3:6], 1e4 * usual.v[3:6])
    assert np.array_equal(np.delete(fast.v, [3, 4, 5]), np.delete(usual.v, [3, 4, 5]))
    assert np.array_equal(fast.a, usual.a)


@pytest.mark.one_case
@pytest.mark.parametrize("length", [1e-9, 1e-3, 1.0, 1e3])
def test_a_solver_s_choice_of_pivots_does_not_depend_on_units(length):
    """`fast.aba` of one state solved the base's 6 × 6 equations in kg and m: 2e-9 was lost where rotors are heavy."""
    recipe = Recipe(length=length, rotor=1e9)
    q, v, a = recipe.state
    tau = np.random.default_rng(0).standard_normal(12) * np.abs(tw.rnea(recipe.model, q, v, a))
    slow, fast = tw.aba(recipe.model, q, v, tau), tw.fast.aba(recipe.model, q, v, tau)
    assert np.abs(fast / slow - 1).max() < 1e-12


# ---------------------------------------------------------------- the grid


def test_the_grid_has_every_value_and_every_pair():
    short, full = cells(full=False), cells(full=True)
    assert len(short) == len(set(short)) > 180
    assert set(short) < set(full)
    assert all(of_value(name, x) in full for name, values in DIMENSIONS.items() for x in values)
    assert all(set(of_pair(a, b, full=True)) <= set(full) for a in ENDS for b in ENDS if a < b)
    assert Recipe(bodies=300) in full


ENDS_ALONE = [
    of_value(name, values[-1]) for name, values in DIMENSIONS.items() if values[-1] < 1000 or name == "length"
]


def nothing_is_silent(recipes):
    """No NaN, no warning, no number where none is right; and nothing worse than `accuracy` said."""
    found = [(recipe, o) for recipe in recipes for o in measure(recipe, with_pinocchio=False)]
    assert [(recipe.changed, o) for recipe, o in found if o.fault] == []
    above = [
        (r.changed, o) for r, o in found if o.error is not None and o.estimate is not None and o.error > o.estimate
    ]
    assert above == []
    return found


@pytest.mark.slow
def test_no_cell_is_silently_bad():
    found = nothing_is_silent([*ENDS_ALONE, Recipe(mass_ratio=1e9, bodies=20), Recipe(light=1e-9, parallel=1e-6)])
    assert {recipe for recipe, o in found if o.raised and o.way == "textbook"} == {
        of_value("tip", 0.0),
        of_value("off", 0.1),
        of_value("edge", -1e-3),
    }


@pytest.mark.slow
def test_no_fortieth_cell_of_the_short_form_is_silently_bad():
    nothing_is_silent(cells(full=False)[random.randrange(40) :: 40])


def test_what_must_not_be_is_noticed(monkeypatch):
    """A NaN, a warning, another error, a number where none is right."""
    ways = {
        "aba": lambda model, q, v, tau: np.full(model.nv, np.nan),
        "rnea": lambda model, q, v, a: np.full(model.nv, np.inf),
        "crba": lambda model, q: np.ones(1) / np.zeros(1),
        "centroidal_map": lambda model, q: {}["A_G"],
        "nonlinear_effects": tw.nonlinear_effects,
    }
    for name, way in ways.items():
        monkeypatch.setattr(tw.fast, name, way)
    said = {o.quantity: o.fault for o in measure(Recipe(bodies=2), with_pinocchio=False) if o.way == "fast"}
    assert said["aba, pushed"] == "NaN"
    assert said["rnea"] == "infinite"
    assert said["crba"].startswith("warns: divide by zero")
    assert said["centroidal map"] == "KeyError: 'A_G'"
    monkeypatch.setattr(tw.fast, "aba", lambda model, q, v, tau: tau)
    said = {o.quantity: o.fault for o in measure(Recipe(bodies=2, tip=0.0), with_pinocchio=False) if o.way == "fast"}
    assert said["aba, pushed"] == "a number where none is right"


# ---------------------------------------------------------------- the run

FEW = [Recipe(), Recipe(off=0.1), Recipe(bodies=2, tip=0.0)]


def test_the_report_counts():
    def cell(bodies, error, theirs):
        ours = Record("aba, pushed", "textbook", error=error, estimate=1e-12)
        return Cell(Recipe(bodies=bodies), [ours, Record("aba, pushed", "pinocchio", error=theirs)])

    some = [cell(1, 1e-13, 1e-14), cell(2, 1e-15, 1e-13), cell(3, 1e-15, 1e-15), cell(4, 1e-11, 1e-11)]
    (row, _), (estimate,) = report.rows(some), report.estimates(some)
    assert (row["cells"], row["raised"], row["faults"]) == (4, 0, 0)
    assert (row["above"], row["below"], row["tenth"], row["worst"], row["where"]) == (1, 1, 1, 1e-11, "bodies 4")
    assert (estimate["cells"], estimate["held"]) == (4, 3)


@pytest.mark.slow
def test_the_command_prints_writes_and_draws(tmp_path, monkeypatch, capsys):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: the maps are not drawn")
    monkeypatch.setattr(grid, "cells", lambda *, full: FEW)
    monkeypatch.setattr(pictures, "MAPS", {"aba, pushed": "aba_pushed"})
    counted, maps = (str(tmp_path / name) for name in ("counted.json", "maps"))
    status = study_main(["extremes", "--json", counted, "--pictures", maps, "--angles", "20"])
    said = capsys.readouterr()
    assert status == 0
    for text in (
        "aba, pushed",
        "tw.accuracy",
        "exp3      twistwrench",
        "_aba_pushed.png",
    ):
        assert text in said.out
    assert json.loads((tmp_path / "counted.json").read_text())["cells"] == 3
    assert len(list((tmp_path / "maps").glob("extremes_*.png"))) == 1


def test_the_command_fails_where_a_cell_is_bad(monkeypatch, capsys):
    bad = [Record("aba, pushed", "fast", fault="NaN")]
    monkeypatch.setattr(grid, "cells", lambda *, full: FEW[:1])
    monkeypatch.setattr(measuring, "measure", lambda recipe, **how: bad)
    assert study_main(["extremes", "--angles", "0"]) == 1
    assert "aba, pushed by fast: NaN" in capsys.readouterr().err


def test_the_map_shows_a_nan_in_red_what_is_refused_hatched_and_pairs_by_their_worst():
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: the maps are not drawn")
    from matplotlib import colormaps
    from matplotlib.colors import to_rgba

    far = {"distance": 1e9}

    def cell(changed, **given):
        return Cell(Recipe(**changed), [Record("crba", "textbook", **given)])

    cells = [cell({"angle": -np.pi}, fault="NaN"), cell(far, raised="ValueError: q", estimate=2.0)]
    cells += [cell(far | {"speed": speed}, error=error) for speed, error in ((1e8, 1e-3), (1e-12, 1e-15))]
    figure = pictures.draw_map(cells, "crba")
    (above, below), said = figure.axes[0:4:2], figure.axes[1]
    refused, nan = above.patches
    assert [text.get_text() for text in above.texts] == ["1e9", "−π"]
    assert nan.get_facecolor() == to_rgba(COLOURS["vermilion"])
    assert (nan.get_hatch(), refused.get_hatch()) == (None, "/////")
    (pair,) = below.patches
    assert pair.get_facecolor() == colormaps["cividis"].resampled(pictures.KEPT)(3)
    assert [patch.get_hatch() for patch in said.patches] == ["/////"]  # sure of nothing


@pytest.mark.slow
def test_the_command_does_without_pinocchio_and_scipy(monkeypatch, capsys):
    for name in ("pinocchio", "scipy", "scipy.spatial.transform"):
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setattr(grid, "cells", lambda *, full: FEW[2:])
    assert study_main(["extremes", "--angles", "4"]) == 0
    said = capsys.readouterr()
    assert "Pinocchio" in said.err
    assert "it has no column" in said.err
    assert "exp3      twistwrench" in said.out
    assert "exp3      Pinocchio" not in said.out
    assert "exp3      SciPy" not in said.out


@pytest.mark.parametrize("angles", ["1", "-5", "2.5", "many"])
def test_a_number_of_angles_that_is_none_is_refused(angles, capsys):
    with pytest.raises(SystemExit):
        study_main(["extremes", "--angles", angles])
    assert f"got '{angles}'" in capsys.readouterr().err


# ---------------------------------------------------------------- exponentials and logarithms


def test_exp_and_log_are_good_to_2e_15_for_every_angle():
    ours = [r for r in turns(200) if r.way == "twistwrench"]
    assert {(r.quantity, r.where) for r in ours} == set(product(("exp3", "log3", "exp6", "log6"), ("near 0", "near π")))
    assert max(r.error for r in ours) < 2e-15


def test_the_truth_of_a_quarter_turn_is_a_closed_form():
    half_pi = mpmath.pi / 2
    V = np.array([[0 * half_pi, 0 * half_pi, half_pi, half_pi, 0 * half_pi, mpmath.mpf(1)]])
    T = exact_exp(V)[0]
    right = [[0, -1, 0, 1], [1, 0, 0, 1], [0, 0, 1, 1], [0, 0, 0, 1]]  # a quarter of a circle of radius 1, climbing
    assert (abs(T - np.array(right)) < 1e-45).all()
    assert (abs(exact_log(exact_exp(V)) - V) < 1e-45).all()


# ---------------------------------------------------------------- the page

PAGES = [page("extremes", language) for language in ("", ".zh-CN")]


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_page_counts_the_robots_of_the_grid(language):
    said = re.findall(
        r"python -m benchmarks.study extremes.* # (\d+)", page("extremes", language).read_text(encoding="utf-8")
    )
    assert [int(number) for number in said] == [len(cells(full=full)) for full in (False, True)]


@pytest.mark.slow
@pytest.mark.filterwarnings("error")
def test_every_block_of_the_page_runs(capsys):
    first, parts = numbered("extremes")
    run_page(PAGES[0], [*first, *(block for part in parts for block in part.blocks)])
    said, shown = capsys.readouterr().out, parts[-1].blocks[-1]
    assert [f"# {line}" in shown for line in said.splitlines()] == [True, True, True]


def test_both_languages_have_the_same_sections_and_the_same_code():
    (first, parts), (other, twins) = numbered("extremes"), numbered("extremes", ".zh-CN")
    code, twin = (
        [b.strip("\n") for b in [*f, *(b for p in ps for b in p.blocks)]] for f, ps in ((first, parts), (other, twins))
    )
    assert code == twin
    assert [part.heading[1] for part in parts] == [part.heading[1] for part in twins]
    for part in parts:
        assert any("assert " in block for block in part.blocks), part.heading[0]


@pytest.fixture
def maker(monkeypatch):
    """benchmarks/extremes.py, which makes the page's tables and measures its single numbers."""
    monkeypatch.syspath_prepend(str(DOCS.parent / "benchmarks"))
    return importlib.import_module("extremes")


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_tables_and_the_numbers_of_the_page_are_those_of_the_results(maker, language):
    text = page("extremes", language).read_text(encoding="utf-8")
    assert fill(text, maker.tables()) == text
    assert re.findall(r"<!-- table: (\w+) -->", text) == ["grid", "programs", "base", "turns"]
    words = re.sub(r"```.*?```|<!--[^\n]*\n(\|[^\n]*\n)+", "", text, flags=re.DOTALL)
    assert [number for number in maker.quoted() if number not in words] == []


@pytest.mark.slow
def test_the_results_of_a_heavy_tip_are_those_of_today(maker):
    recipe = maker.CELLS["heavy tip"]
    kept = json.loads(maker.RESULTS.read_text(encoding="utf-8"))["cells"]["heavy tip"]
    for record in measure(recipe, with_pinocchio=False):
        if record.error is not None and record.way == "textbook":
            assert record.error == pytest.approx(kept[record.quantity]["textbook"], rel=10, abs=1e-15)


def test_the_maps_are_there_and_small():
    sizes = {path: path.stat().st_size for path in (DOCS / "pictures").glob("extremes_*.png")}
    assert {path.name for path in sizes} == {f"extremes_{name}.png" for name in pictures.MAPS.values()}
    assert max(sizes.values()) < 150_000
    for at in PAGES:
        text = at.read_text(encoding="utf-8")
        assert [path.name for path in sizes if f"pictures/{path.name}" not in text] == []


def test_both_languages_have_the_same_numbers_in_their_tables():
    numbers = [re.findall(r"\d[\d.e-]*", "".join(re.findall(r"^\|.*$", at.read_text("utf-8"), re.M))) for at in PAGES]
    assert len(numbers[0]) > 30
    assert numbers[0] == numbers[1]

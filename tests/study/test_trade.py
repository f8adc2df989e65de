"""``python -m benchmarks.study trade``: fronts of made-up points, errors of every way, tables."""

import importlib
import json
import re
import sys
from itertools import cycle, pairwise
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import timing as clock

from ..pages import blocks, page, run

pytest.importorskip("mpmath", reason="mpmath is not installed: there is no truth to hold anything against")

from study.__main__ import main as study_main
from study.numbers import PAIRS, convert, digits, sum_of_pair
from study.record import Record
from study.trade import DRAWN, KEYS, SHORT, Effort, Trade, front, relative_error, weigh
from tables import fill

from study import pictures
from twistwrench.arrays import resolution
from twistwrench.validate.states import random_states

from ..sampling import sampled

QUICK = Effort(states=2, batch=3, rounds=1, least=0, most=0)
"""Only the errors are looked at."""

ROUNDINGS = 100
"""Allowed error in units of the number type's resolution; the worst seen on these robots is 30."""


def point(seconds: float, error: float) -> Record:
    return Record("ID", "a way", error=error, seconds=seconds)


def epsilon(number: str) -> float:
    """The spacing of a type's numbers next to 1."""
    if number.endswith("digits"):
        return float(digits(int(number.split()[0])).eps)
    if number == PAIRS:
        return 2.0**-105  # the roundings of hi and of lo: 53 binary digits each, and a sign
    return resolution(np.dtype(number))


# ---------------------------------------------------------------- the front


@pytest.mark.parametrize(
    ("points", "kept"),
    [
        ([], []),
        ([(1, 1e-6)], [0]),
        ([(1, 1e-6), (2, 1e-12), (3, 1e-9), (4, 1e-15), (5, 1e-15)], [0, 1, 3]),
        ([(3, 1e-9), (2, 1e-12), (1, 1e-6)], [2, 1]),
        ([(1, 1e-9), (1, 1e-12)], [1]),
        ([(1, 1e-9), (1, 1e-9)], [0]),
        ([(2, 1e-9), (1, 0.0), (3, 0.0)], [1]),
    ],
)
def test_the_front_of_made_up_points(points, kept):
    made = [point(*p) for p in points]
    assert front(made) == [made[i] for i in kept]


def test_the_front_of_a_hyperbola_is_all_of_it_and_nothing_above_it():
    below = [point(t, 1 / t) for t in range(1, 50)]
    above = [point(t, 1.01 / (t - 1)) for t in range(2, 50)]
    rng = np.random.default_rng(0)
    assert front(rng.permutation(np.array(above + below, object)).tolist()) == below


def test_nothing_is_both_faster_and_more_exact_than_a_point_of_the_front():
    rng = np.random.default_rng(1)
    points = [point(*x) for x in rng.uniform(size=(200, 2))]
    found = front(points)
    for p in points:
        beaten = any(q.seconds <= p.seconds and q.error <= p.error and q != p for q in points)
        assert (p in found) == (not beaten)


# ---------------------------------------------------------------- the errors


@pytest.fixture(scope="module")
def floating() -> Trade:
    tree = tw.random_tree(4, rng=3, base="floating")
    return weigh(tree, effort=QUICK)


@pytest.fixture(scope="module")
def fixed() -> Trade:
    return weigh(tw.load("double_pendulum"), effort=QUICK)


def approximate(p: Record) -> bool:
    return p.way.endswith("difference") and not p.number.endswith("digits")


@pytest.mark.slow
@pytest.mark.parametrize("robot", sampled(["fixed", "floating"], 1))
def test_all_exact_ways_keep_what_their_number_type_holds(robot, request):
    trade = request.getfixturevalue(robot)
    assert [r for r in trade.records if r.error is None] == []
    assert set(trade.names) == {p.quantity for p in trade.records} == set(KEYS)
    bad = [p for p in trade.records if not approximate(p) and not p.error <= ROUNDINGS * epsilon(p.number)]
    assert bad == []


@pytest.mark.slow
def test_no_type_is_more_exact_than_it_can_be(floating):
    """Else its truth would be its own."""
    for key in ("ID", "FD", "dh_G", "dID/dq"):
        for p in floating.points(key):
            assert p.error > 1e-3 * epsilon(p.number), p


@pytest.mark.slow
@pytest.mark.parametrize("robot", sampled(["fixed", "floating"], 1))
def test_finite_differences_lose_what_theory_says(robot, request):
    """A forward difference keeps half the digits, a central one two thirds, a complex step all: within 1.5 decades."""
    errors = {(p.way, p.number): p.error for p in request.getfixturevalue(robot).points("dID/dq") if p.states == 1}
    for number in ("float32", "float64", "longdouble"):
        eps = epsilon(number)
        for way, power in (("forward difference", 1 / 2), ("central difference", 2 / 3)):
            off = np.log10(errors[f"tw.fast.rnea, {way}", number] / eps**power)
            assert abs(off) < 1.5, (way, number, off)
        assert errors["tw.fast.rnea, complex step", number] < ROUNDINGS * eps


@pytest.mark.slow
def test_every_way_stands_beside_pinocchio_in_every_type_for_one_state_and_many(floating):
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its ways are left out")
    ways = {key: {p.way for p in floating.points(key)} for key in KEYS}
    assert {"tw.fast.aba", "tw.aba", "newton_euler_3d", "pin.aba", "pin.crba + Cholesky"} <= ways["FD"]
    assert {"tw.fast M, h + Cholesky", "tw.crba + Cholesky"} <= ways["FD"]
    assert all(any(way.startswith("pin.") for way in names) for names in ways.values())
    fast = {(p.number, p.states) for p in floating.points("ID") if p.way == "tw.fast.rnea"}
    assert fast == {(number, n) for number in ("float32", "float64", "longdouble") for n in (1, QUICK.batch)}
    programs = {(p.number, p.states) for p in floating.points("dJv") if p.way == "tw.compile frame_bias_acceleration"}
    assert programs == {(number, n) for number in ("float32", "float64", "double-double") for n in (1, QUICK.batch)}
    slow = {p.number for p in floating.points("FD") if p.way == "newton_euler_3d"}
    assert slow == {"float32", "float64", "longdouble", "20 digits", "50 digits"}


def test_the_fronts_are_those_of_the_points(fixed):
    for key in KEYS:
        one, many = fixed.fronts(key)
        assert {p.states for p in one} == {1}
        assert all(p.seconds < q.seconds and p.error > q.error for p, q in [*pairwise(one), *pairwise(many)])
        assert min(p.error for p in one) == min(p.error for p in fixed.points(key) if p.states == 1)


def test_pairs_of_doubles_keep_what_one_double_loses():
    """Their sum is taken in 60 digits: in doubles the second number would be lost, and its error with it."""
    third = convert(np.array([1.0]), "60 digits") / 3
    hi = third.astype(np.float64)
    pair = hi, (third - hi).astype(np.float64)
    assert relative_error(hi, third) > 1e-17
    assert 0 < relative_error(sum_of_pair(pair), third) < epsilon("double-double")


def test_a_relative_error_is_that_of_the_largest_entry():
    truth = convert(np.array([3.0, -4.0]), "60 digits")
    assert relative_error(np.array([3.0, -4.0]), truth) == 0
    assert relative_error(np.array([3.5, -4.0], np.float32), truth) == 0.125
    assert relative_error(convert(np.array([3.0, -2.0]), "20 digits"), truth) == 0.5
    third = truth / 3
    assert relative_error(third.astype(float), third) == pytest.approx(2.0**-54, rel=0.5)


@pytest.mark.parametrize(("wrong", "said"), [([np.nan, 1.0], "NaN"), ([np.inf, 1.0], "infinity"), ([1.0], "shape")])
def test_what_is_no_number_is_no_error_either(wrong, said):
    with pytest.raises(ValueError, match=said):
        relative_error(np.array(wrong), convert(np.ones(2), "60 digits"))


def test_what_has_no_acceleration_is_left_out_and_the_rest_is_there():
    """Nothing resists a joint that moves no inertia: there is a τ, but no v̇."""
    robot = tw.Builder("ghost")
    robot.link("rod", parent="base_link", joint=tw.Revolute("y"), inertia=tw.SpatialInertia(1, [0, 0, -1], np.eye(3)))
    robot.link("ghost", parent="rod", joint=tw.Revolute("x"))
    trade = weigh(robot.build(), only=["ID", "FD"], effort=QUICK)
    assert trade.points("ID") == [r for r in trade.records if r.error is not None]
    assert [(r.quantity, r.way) for r in trade.records if r.error is None] == [("FD", "all ways")]
    assert "no inertia resists the joints 'ghost'" in str(trade)


@pytest.mark.slow
def test_a_way_that_fails_in_one_number_type_is_left_out_there_alone():
    """In single precision Cholesky finds the mass matrix of links of 1 kg to a million tonnes not positive."""
    robot = tw.Builder("whip", base="floating", root_inertia=tw.SpatialInertia(1, [0, 0, -1], np.eye(3)))
    parent = "base_link"
    for k, axis in enumerate("xyx", 1):
        rod = tw.SpatialInertia(1e3**k, [0, 0, -1], np.eye(3) * 1e3**k)
        robot.link(f"rod {k}", parent=parent, joint=tw.Revolute(axis), inertia=rod)
        parent = f"rod {k}"
    trade = weigh(robot.build(), only=["FD"], effort=QUICK)
    left_out = [r for r in trade.records if r.error is None]
    assert {r.number for r in left_out} == {"float32"}
    why = {r.way: r.raised for r in left_out}
    assert why["tw.crba + Cholesky"] == why["tw.fast M, h + Cholesky"] == "Matrix is not positive definite"
    assert {p.number for p in trade.points("FD") if p.way == "tw.crba + Cholesky"} == {"float64"}


def test_a_quantity_that_is_zero_has_no_relative_error_and_is_left_out():
    """No frame of the cart-pole is off its axes, so no point is accelerated by v alone."""
    trade = weigh(tw.load("cart_pole"), only=["dJv"], effort=QUICK)
    assert [(r.way, r.error) for r in trade.records] == [("all ways", None)]
    assert "the right value is zero" in str(trade)


# ---------------------------------------------------------------- the clock


class Processor:
    """A clock for the wall and one for the processor, and work that takes known times on either."""

    def __init__(self, monkeypatch):
        self.wall = self.busy = 0.0
        monkeypatch.setattr(clock.time, "perf_counter", lambda: self.wall)
        monkeypatch.setattr(clock.time, "thread_time", lambda: self.busy)

    def work(self, busy: float, waits: tuple[float, ...] = (0.0,)):
        """A call that takes `busy` seconds, and waits for the processor besides: so long, in turns."""
        turns = cycle(waits)

        def call():
            self.busy += busy
            self.wall += busy + next(turns)

        return call


def test_the_clock_counts_stretches_that_nothing_disturbed(monkeypatch):
    cpu = Processor(monkeypatch)
    quiet, torn = clock.round_robin([cpu.work(1), cpu.work(2, (0, 0, 0, 5))], rounds=3, least=0, most=100)
    assert quiet.seconds.tolist() == [1, 1, 1]
    assert torn.seconds.tolist() == [2, 2, 2]
    assert torn.spare == [2]


def test_where_every_stretch_is_disturbed_the_time_on_the_processor_counts(monkeypatch):
    (lap,) = clock.round_robin([Processor(monkeypatch).work(2, (3,))], rounds=2, least=0, most=100)
    assert lap.kept == []
    assert set(lap.seconds) == {2}


def test_a_call_that_has_used_its_time_gets_no_more_stretches_and_each_gets_one(monkeypatch):
    cpu = Processor(monkeypatch)
    slow, quick = clock.round_robin([cpu.work(4), cpu.work(1)], rounds=9, least=0, most=5)
    assert len(slow.seconds) == 2
    assert len(quick.seconds) == 5
    (once,) = clock.round_robin([cpu.work(4)], rounds=9, least=0, most=0)
    assert len(once.seconds) == 1


def test_the_quickest_call_says_how_many_make_a_stretch(monkeypatch):
    (lap,) = clock.round_robin([Processor(monkeypatch).work(1, (60, 0, 0))], rounds=1, least=8, most=100)
    assert lap.repeat == 8


def test_a_race_counts_rounds_that_nothing_disturbed_and_gives_seconds_for_one_state(monkeypatch):
    cpu = Processor(monkeypatch)
    warm, round_, torn = (0, 0, 0), (0,), (5,)  # each call is made thrice before the first round
    found = clock.race((cpu.work(2), 4), (cpu.work(3, (*warm, *torn, *round_, *torn, *round_)), 2), rounds=2, least=0)
    assert found.ours.tolist() == [0.5, 0.5]
    assert found.theirs.tolist() == [1.5, 1.5]
    assert found.disturbed == 2


def test_a_race_of_several_threads_counts_every_round_and_one_that_is_never_quiet_ends(monkeypatch):
    cpu = Processor(monkeypatch)
    both = (cpu.work(4), 2), (cpu.work(1, (0, 0, 0, 3, 0, 1)), 1)
    found = clock.race(*both, rounds=3, least=0, one_thread=False)
    assert found.theirs.tolist() == [4, 1, 2]
    row = found.row()
    assert (row["us"], row["us_q1"], row["reference_us"], row["reference_us_q1"], row["reference_us_q3"]) == (
        pytest.approx((2e6, 2e6, 2e6, 1.5e6, 3e6))
    )
    assert (row["ratio"], row["rounds"], row["disturbed"]) == (1, 3, 0)
    alone = clock.race((cpu.work(2, (3,)), 1), None, rounds=2, least=0)
    assert alone.ours.tolist() == [5, 5]
    assert np.isnan(alone.theirs).all()
    assert alone.disturbed == 2 * clock.MAX_TRIES_PER_LAP


# ---------------------------------------------------------------- what is written


def test_the_table_holds_every_point_and_says_what_is_best(fixed):
    lines = str(fixed).splitlines()
    for p in fixed.records:
        assert any(p.way in line and p.number in line for line in lines)
    assert sum(line.startswith("●") for line in lines) == sum(len(fixed.fronts(key)[0]) for key in KEYS)


def test_the_json_holds_everything(fixed):
    read = json.loads(fixed.to_json())
    assert [Record.from_dict(r) for r in read["records"]] == fixed.records
    assert list(read["names"]) == list(KEYS)


@pytest.mark.slow
def test_the_command_prints_writes_and_draws(tmp_path, capsys):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: nothing is drawn")
    files = tmp_path / "found.json", tmp_path / "found.png"
    command = [
        "trade",
        "pendulum",
        "--short",
        "--only",
        "ID",
        "--json",
        str(files[0]),
        "--plot",
        str(files[1]),
        "--seed",
        "1",
    ]
    assert study_main(command) == 0
    out, err = capsys.readouterr()
    assert out.startswith("pendulum: fixed base, 1 moving body")
    assert "inverse dynamics τ" in out
    assert err == ""
    trade = weigh(tw.load("pendulum"), only=["ID"], effort=SHORT, seed=1)
    found = [(p["quantity"], p["way"], p["error"]) for p in json.loads(files[0].read_text())["records"]]
    assert found == [("ID", p.way, p.error) for p in trade.records]
    assert files[1].read_bytes().startswith(b"\x89PNG")
    pictures.save(pictures.draw_trade(trade), tmp_path / "found.svg")
    assert "pendulum: what a digit costs" in (tmp_path / "found.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("errors", "said"), [([1e-3], []), ([1e-3, 1e-32, 1e-45, 1e-43], ["down to 1e-45"]), ([0.0], ["down to 0"])]
)
def test_what_is_below_the_picture_is_said(errors, said):
    ax = pytest.importorskip("matplotlib.figure", reason="matplotlib is not installed").Figure().add_subplot()
    pictures.note_floor(ax, [point(1, error) for error in errors])
    assert [text.get_text().removeprefix("on the bottom line: ") for text in ax.texts] == said


@pytest.mark.slow
def test_the_command_shows_a_bar_if_told_to(capsys):
    assert study_main(["trade", "pendulum", "--short", "--only", "M", "--progress"]) == 0
    assert "M: " in capsys.readouterr().err


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (["pendulun"], "did you mean 'pendulum'"),
        (["nowhere/robot.urdf"], "nowhere/robot.urdf: no such file"),
        (["pendulum", "--only", "FK"], "unknown quantity 'FK'"),
        (["pendulum", "--json", "nowhere/x.json"], "--json nowhere/x.json: No such file or directory"),
        (["pendulum", "--plot", "nowhere/x.png"], "--plot nowhere/x.png: No such file or directory"),
        (["pendulum", "--plot", "x.bmp"], "--plot x.bmp: expected a file that ends with one of .png, .svg, .pdf"),
    ],
)
def test_what_cannot_be_done_is_said_before_anything_is_measured(wrong, said, capsys):
    assert study_main(["trade", *wrong]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert said in err


@pytest.mark.parametrize("wrong", [["--seed", "-1"], ["--seed", "x"], ["--base", "flying"], ["--fast"]])
def test_misuse_has_status_2(wrong, capsys):
    with pytest.raises(SystemExit) as stop:
        study_main(["trade", "pendulum", *wrong])
    assert stop.value.code == 2
    assert wrong[-1] in capsys.readouterr().err


@pytest.mark.slow
def test_the_base_and_the_seed_count():
    fixed, floating = (weigh(tw.load("pendulum", base=b), only=["M"], effort=QUICK) for b in ("fixed", "floating"))
    assert "fixed base" in fixed.description
    assert "floating base" in floating.description
    errors = [
        [p.error for p in weigh(tw.load("cart_pole"), only=["ID"], effort=QUICK, seed=seed).records]
        for seed in (1, 1, 2)
    ]
    assert errors[0] == errors[1] != errors[2]


def test_a_robot_that_does_not_move_is_refused():
    with pytest.raises(tw.ModelError, match="nothing moves"):
        weigh(tw.Builder("stone").build())


@pytest.mark.slow
def test_without_pinocchio_and_scipy_their_ways_are_left_out_and_a_line_says_so(monkeypatch):
    for name in ("pinocchio", "scipy", "scipy.linalg", "scipy.spatial.transform"):
        monkeypatch.setitem(sys.modules, name, None)
    trade = weigh(tw.load("pendulum"), only=["FD", "exp"], effort=QUICK)
    ours = {"tw.aba", "tw.fast.aba", "tw.fast", "tw.compile", "tw.crba", "tw.exp6"}
    assert {p.way.replace(",", "").split()[0] for p in trade.records} == ours | {"newton_euler_3d", "mpmath"}
    assert "not installed: pinocchio" in str(trade)
    assert "not installed: scipy" in str(trade)

    monkeypatch.setattr(pictures, "find_spec", lambda name: None)
    with pytest.raises(ImportError, match="matplotlib"):
        pictures.check_format(Path("x.png"))


def test_without_mpmath_there_is_no_truth(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "mpmath", None)
    assert study_main(["trade", "pendulum", "--short"]) == 2
    assert 'pip install "twistwrench[validate]"' in capsys.readouterr().err


# ---------------------------------------------------------------- docs/trade.md

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
REPRODUCED = 4
"""Factor between a rounding error here and the same on another machine, with another BLAS."""


@pytest.fixture
def maker(monkeypatch):
    """benchmarks/trade.py, which makes the page's tables."""
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    return importlib.import_module("trade")


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_tables_of_the_page_are_those_of_the_results(maker, language):
    text = page("trade", language).read_text(encoding="utf-8")
    assert fill(text, maker.tables()) == text
    assert set(re.findall(r"<!-- table: (\w+) -->", text)) == set(maker.tables())


def check_errors(maker, keys: list[str], robot: str = "go2") -> None:
    """The errors of the run that is kept are found again: none is worse, and few are better."""
    kept = {(p.quantity, p.way, p.number, p.states == 1): p.error for p in maker.points(robot)}
    records = weigh(tw.load(robot), only=keys, effort=Effort(rounds=1, least=0, most=0)).records
    found = [
        p for p in records if (p.quantity, p.way, p.number, p.states == 1) in kept
    ]  # newer ways come with a new run
    ratio = np.array([p.error / kept[p.quantity, p.way, p.number, p.states == 1] for p in found])
    assert len(ratio) > 10 * len(keys)
    assert [(p, r) for p, r in zip(found, ratio, strict=True) if r > REPRODUCED] == []
    assert np.mean(ratio < 1 / REPRODUCED) < 0.1


RATIOS = [  # what the page says in words, of which two times it is the ratio, and what it says
    (
        "half of the time of `pin.rnea`",
        ("ID", "tw.fast.rnea", "float64", 1),
        ("ID", "pin.rnea", "float64", 1),
        1 / 2,
    ),
    ("a third of that of `pin.aba`", ("FD", "tw.fast.aba", "float64", 1), ("FD", "pin.aba", "float64", 1), 1 / 3),
    ("about six tenths", ("ID", "tw.compile rnea", "float32", 1000), ("ID", "tw.compile rnea", "float64", 1000), 0.6),
    ("**Thirty-two digits cost a compiled program ten", ("ID", "double-double", 1000), ("ID", "float64", 1000), 10),
    ("to thirteen times as much in a batch", ("FD", "double-double", 1000), ("FD", "float64", 1000), 13),
    ("forty to sixty times with one state", ("FD", "double-double", 1), ("FD", "float64", 1), 40),
    ("to sixty times with one state", ("ID", "double-double", 1), ("ID", "float64", 1), 60),
    ("150 to 200", ("ID", "tw.fast.rnea", "longdouble", 1000), ("ID", "tw.fast.rnea", "float64", 1000), 150),
    ("to 200 times", ("FD", "tw.fast.aba", "longdouble", 1000), ("FD", "tw.fast.aba", "float64", 1000), 200),
    ("16 times as long as with pairs", ("ID", "tw.fast.rnea", "longdouble", 1000), ("ID", "double-double", 1000), 16),
    (
        "49.1 take eight times as long",
        ("ID", "newton_euler_3d", "20 digits", 1),
        ("ID", "newton_euler_3d", "float64", 1),
        8,
    ),
    ("some ten thousand times as long for one", ("ID", "newton_euler_3d", "50 digits", 1), ("ID", "float64", 1), 12e3),
    ("eighty thousand times", ("ID", "newton_euler_3d", "50 digits", 1), ("ID", "float64", 1000), 80e3),
    (
        "fourteen times with one state",
        ("FD", "tw.fast M, h + Cholesky", "float64", 1),
        ("FD", "tw.fast.aba", "float64", 1),
        14,
    ),
    (
        "twenty-six times in a batch",
        ("FD", "tw.fast M, h + Cholesky", "float64", 1000),
        ("FD", "tw.fast.aba", "float64", 1000),
        26,
    ),
    (
        "Pinocchio, ABA is faster by a fifth",
        ("FD", "pin.aba", "float64", 1),
        ("FD", "pin.crba + Cholesky", "float64", 1),
        4 / 5,
    ),
    (
        "eight times as long as a forward difference",
        ("dID/dq", "tw.fast.rnea, complex step", "float64", 100),
        ("dID/dq", "tw.fast.rnea, forward difference", "float64", 100),
        8,
    ),
    ("as long as two calls", ("dID/dq", "tw.compile dtau_dq", "float64", 1), ("ID", "float64", 1), 2),
    (
        "four times as long as `pin.rnea`",
        ("dID/dq", "pin.computeRNEADerivatives", "float64", 1),
        ("ID", "pin.rnea", "float64", 1),
        4,
    ),
]


def test_the_ratios_in_the_sentences_of_the_page_are_those_of_the_results(maker):
    """To a fifth, as the page says. Without a way, it is a program's."""
    text, seconds = " ".join(page("trade", "").read_text(encoding="utf-8").split()), {}
    for p in maker.points("go2"):
        seconds[p.quantity, p.way, p.number, p.states] = p.seconds
        if p.way.startswith("tw.compile"):
            seconds[p.quantity, p.number, p.states] = p.seconds
    for words, one, other, said in RATIOS:
        assert words in text
        assert seconds[one] / seconds[other] == pytest.approx(said, rel=0.2), words


@pytest.mark.slow
def test_the_errors_on_the_page_are_found_again(maker):
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its errors are not found again")
    check_errors(maker, ["ID", "exp"])


@pytest.mark.slow
def test_all_errors_on_the_page_are_found_again(maker):
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its errors are not found again")
    check_errors(maker, [key for key in KEYS if key not in ("ID", "exp")])


@pytest.mark.slow
def test_the_errors_of_the_humanoid_are_found_again(maker):
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its errors are not found again")
    check_errors(maker, ["FD"], "humanoid")


@pytest.mark.parametrize(("robot", "low", "high"), [("go2", 5e3, 7e3), ("humanoid", 1e5, 9e5)])
def test_the_condition_numbers_on_the_page(robot, low, high):
    model = tw.load(robot)
    states = random_states(model, DRAWN, rng=np.random.default_rng(0))
    found = np.linalg.cond(tw.crba(model, states.q[:5]))
    assert found.min() == pytest.approx(low, rel=0.5)
    assert found.max() == pytest.approx(high, rel=0.1)


def test_the_humanoid_keeps_more_digits_by_aba_than_by_its_mass_matrix(maker):
    """What the page concludes from its table: in double precision and in single."""
    errors = {(p.way, p.number): p.error for p in maker.points("humanoid") if p.quantity == "FD" and p.states == 1}
    for number in ("float32", "float64"):
        solved = [e for (way, kind), e in errors.items() if "Cholesky" in way and kind == number]
        assert min(solved) > 4 * errors["tw.aba", number]


@pytest.mark.slow
@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_the_code_of_the_page_runs(language):
    path = page("trade", language)
    text = path.read_text(encoding="utf-8")
    code = blocks(text, 0, len(text))
    assert len(code) == 2
    assert run(path, code)["best"] == 1e-8
    assert re.findall(r"^```\w+\n.*?^```", text, re.MULTILINE | re.DOTALL) == re.findall(
        r"^```\w+\n.*?^```", page("trade").read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )

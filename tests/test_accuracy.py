"""`tw.accuracy`: a closed form, what units may not change, and the truth in fifty digits."""

import time

import mpmath
import numpy as np
import pytest
from study.extremes.candidates import ALGORITHMS, candidates
from study.extremes.robots import Recipe, State
from study.extremes.truth import truth

import twistwrench as tw
from twistwrench import error_bounds

from .sampling import sampled

mpmath.mp.dps = 50

# ---------------------------------------------------------------- closed forms


def test_one_joint_has_nothing_to_move_against():
    known = tw.accuracy(tw.load("pendulum"), [0.3])
    assert known.apparent_inertia == 1
    assert known.resolution == 2.0**-52
    assert known.aba == pytest.approx(28 * 2.0**-52, rel=1e-14)
    assert known.rnea == pytest.approx(24 * 2.0**-52, rel=1e-14)


@pytest.mark.parametrize("ratio", [1e-3, 1.0, 1e3, 1e6])
def test_two_rods_feel_one_less_their_coupling(ratio):
    """The least eigenvalue of [1 c; c 1] is 1 − |c|."""
    model = tw.chain(2, mass_ratio=ratio)
    (a, b), (_, c) = tw.crba(model, [0.0, 0.4])
    assert tw.accuracy(model, [0.0, 0.4]).apparent_inertia == pytest.approx(1 - abs(b) / np.sqrt(a * c), rel=1e-9)


# ---------------------------------------------------------------- invariants


@pytest.mark.parametrize("unit", ["length", "mass", "time"])
@pytest.mark.parametrize("scale", [2.0**-30, 2.0**30])
def test_the_same_robot_in_other_units_has_the_same_digits(unit, scale):
    usual, other = Recipe(mass_ratio=1e6), Recipe(mass_ratio=1e6, **{unit: scale})
    first, second = (tw.accuracy(recipe.model, recipe.state.q) for recipe in (usual, other))
    assert second.apparent_inertia == pytest.approx(first.apparent_inertia, rel=1e-9)
    assert second.weak == first.weak


def test_where_the_base_is_does_not_count():
    model, q = tw.load("go2"), tw.load("go2").standing()
    far = q + np.array([1e9, -1e9, 1e9] + [0] * 16)
    assert tw.accuracy(model, far).apparent_inertia == tw.accuracy(model, q).apparent_inertia


def test_a_light_root_costs_digits_and_a_heavy_root_none():
    light, heavy = (tw.accuracy(tw.chain(10, mass_ratio=r), np.full(10, 0.3)) for r in (1e9, 1e-9))
    assert light.digits["aba"] < 7
    assert heavy.digits["aba"] > 13
    assert np.linalg.cond(tw.crba(tw.chain(10, mass_ratio=1e-9), np.full(10, 0.3))) > 1e9  # misleads


# ---------------------------------------------------------------- the truth

HARD = [
    Recipe(),
    Recipe(bodies=1),
    Recipe(mass_ratio=1e9),
    Recipe(mass_ratio=1e-9, speed=1e8),
    Recipe(light=1e-9, parallel=1e-6),
    Recipe(length=1e-9, rotor=1e9),
    Recipe(leaves=True, bodies=12, tip=1e-9),
]


def worst(model, s, who):
    """Error and estimate by algorithm, of one state."""
    right = truth(model, s)
    known = {bits: tw.accuracy(model, s.q.astype(bits)) for bits in (np.float32, np.float64)}
    for way in candidates(model, s, right.torques, pinocchio=False):
        name = {"rnea": "rnea", "aba": "aba", "crba + solve": "crba_solve"}.get(way.algorithm.partition(",")[0])
        if name is None or way.who not in who:
            continue
        expected = float(getattr(known[np.float32 if way.who == "float32" else np.float64], name))
        try:
            yield f"{way.algorithm} by {way.who}", right.error(ALGORITHMS[way.algorithm], way.answer()), expected
        except ValueError:  # it refuses: no digit is wrong
            continue


@pytest.mark.parametrize("recipe", sampled(HARD, 2), ids=lambda recipe: str(recipe.changed))
def test_no_error_is_above_the_estimate(recipe):
    found = list(worst(recipe.model, recipe.state, ("textbook", "fast", "float32")))
    assert len(found) >= 8
    assert [(what, error, bound) for what, error, bound in found if not error <= bound] == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(24))
def test_no_error_is_above_the_estimate_in_random_trees_with_joints_of_every_kind(seed):
    model = tw.random_tree(2 + seed % 12, rng=seed, base=("fixed", "floating")[seed % 2])
    rng = np.random.default_rng(seed)
    s = State(model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv)))
    found = list(worst(model, s, ("textbook", "fast")))
    assert len(found) == 10
    assert [(what, error, bound) for what, error, bound in found if not error <= bound] == []


# ---------------------------------------------------------------- what comes back


def test_the_estimate_follows_the_number_type():
    model, q = tw.load("go2"), tw.load("go2").standing()
    single, double, long = (tw.accuracy(model, q.astype(bits)) for bits in (np.float32, np.float64, np.longdouble))
    assert single.aba / double.aba == pytest.approx(2.0**29, rel=1e-3)
    assert long.aba / double.aba == pytest.approx(np.finfo(np.longdouble).eps / 2.0**-52, rel=1e-6)
    assert single.digits["rnea"] < 6 < 13 < double.digits["rnea"]


def test_a_batch_has_an_estimate_each():
    model = tw.load("go2")
    q = np.stack([model.random_configuration(rng=k) for k in range(6)]).reshape(3, 2, -1)
    known = tw.accuracy(model, q)
    assert known.rnea.shape == known.aba.shape == known.crba_solve.shape == known.apparent_inertia.shape == (3, 2)
    assert known.aba[2, 1] == pytest.approx(tw.accuracy(model, q[2, 1]).aba, rel=1e-9)
    assert {x.shape for x in known.digits.values()} == {(3, 2)}


def test_an_empty_batch_and_a_robot_without_joints_say_nothing_is_lost():
    model = tw.load("pendulum")
    empty = tw.accuracy(model, np.zeros((0, 1)))
    assert empty.aba.shape == (0,)
    assert "rnea" in str(empty)
    still = tw.Builder("rock").build()
    assert tw.accuracy(still, []).apparent_inertia == 1
    assert str(tw.accuracy(still, [])) == "rnea keeps 14 of 16 digits, aba 14, crba + solve 14."


def test_where_nothing_is_certain_the_estimate_is_infinite_and_names_the_joint():
    known = tw.accuracy(Recipe(tip=0.0).model, Recipe(tip=0.0).state.q)
    assert known.aba == known.crba_solve == np.inf
    assert np.isfinite(known.rnea)
    assert known.digits["aba"] == 0
    assert known.weak == ("body_0006",)
    assert "aba none" in str(known)
    assert str(known).endswith("A motion of 'body_0006' has 0.0e+00 of the apparent inertia of its parts one by one.")


def test_it_names_the_joints_that_move_against_each_other():
    known = tw.accuracy(tw.chain(6, mass_ratio=1e6), np.full(6, 0.1))
    assert known.weak[0] == "rod_02"
    assert "'rod_02'" in str(known)
    assert f"{float(known.apparent_inertia):.1e}" in str(known)


def test_of_many_joints_it_names_the_first_four():
    known = tw.accuracy(tw.chain(64), np.zeros(64))
    assert len(known.weak) > 4
    assert str(known).count("'rod_") == 4
    assert f"and {len(known.weak) - 4} more have" in str(known)


def test_of_a_robot_without_a_weak_motion_it_says_the_digits_only():
    assert str(tw.accuracy(tw.load("go2"), tw.load("go2").standing())).count("\n") == 0


def test_a_configuration_that_is_none_is_refused():
    model = tw.load("go2")
    with pytest.raises(tw.ShapeError, match="q: expected"):
        tw.accuracy(model, np.zeros(18))
    with pytest.raises(ValueError, match="quaternion"):
        tw.accuracy(model, np.zeros(19))
    with pytest.raises(ValueError, match="finite"):
        tw.accuracy(model, np.full(19, np.nan))


def test_it_costs_less_than_five_times_aba():
    """Measured in turns, the best of each: about a tenth."""
    model, q = tw.load("go2"), tw.load("go2").standing()
    rest = np.zeros(model.nv)
    best = {}
    for _ in range(7):
        for name, call in (("aba", lambda: tw.aba(model, q, rest, rest)), ("own", lambda: tw.accuracy(model, q))):
            start = time.perf_counter()
            call()
            best[name] = min(best.get(name, np.inf), time.perf_counter() - start)
    assert best["own"] < 5 * best["aba"]


def test_the_older_name_of_the_apparent_inertia_is_kept():
    known = tw.accuracy(tw.load("go2"), tw.load("go2").standing())
    assert known.felt is known.apparent_inertia


@pytest.mark.parametrize("seed", range(3))
def test_its_mass_matrix_is_that_of_crba(seed):
    rng = np.random.default_rng(seed)
    model = tw.random_tree(10, rng=rng)
    q = np.stack([model.random_configuration(rng=rng) for _ in range(2)])
    M = tw.crba(model, q)
    assert np.allclose(error_bounds._mass_matrix(model, q), M, rtol=0, atol=1e-14 * np.abs(M).max())

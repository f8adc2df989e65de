"""`tw.accuracy`: a closed form, what units may not change, and the truth in fifty digits."""

import time

import mpmath
import numpy as np
import pytest
from study.extremes.cells import ALGORITHMS, solve, ways
from study.extremes.robots import Recipe, State
from study.extremes.truth import accelerations, truth

import twistwrench as tw
from twistwrench import error_bounds
from twistwrench.newton_euler_3d import as_mpmath

from .robots import shared
from .sampling import sampled

mpmath.mp.dps = 50

# ---------------------------------------------------------------- closed forms


def test_one_joint_has_nothing_to_move_against():
    known = tw.accuracy(shared("pendulum"), [0.3])
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
    model, q = shared("go2"), shared("go2").standing()
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
    for way in ways(model, s, right.torques, with_pinocchio=False):
        name = {"rnea": "rnea", "aba": "aba", "crba + solve": "crba_solve"}.get(way.quantity.partition(",")[0])
        if name is None or way.name not in who:
            continue
        expected = float(getattr(known[np.dtype(way.number).type], name))
        try:
            yield f"{way.quantity} by {way.name}", right.error(ALGORITHMS[way.quantity][1], way.value()), expected
        except ValueError:  # it refuses: no digit is wrong
            continue


@pytest.mark.one_case
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


# ---------------------------------------------------------------- terms that cancel in q̈


def one_body(joint, inertia, **options):
    builder = tw.Builder("body", **options)
    builder.link("body", parent="base_link", joint=joint, inertia=inertia)
    return builder.build()


def disc(mass=0.1, radius=0.03, axis=(1, 2, 2)):
    n = np.array(axis) / np.linalg.norm(axis)
    return tw.SpatialInertia(mass, np.zeros(3), mass * radius**2 / 4 * (np.eye(3) + np.outer(n, n))), n


def fan(rate, drive):
    inertia, n = disc()
    return one_body(tw.Revolute(n), inertia), [0.3], [rate], [drive]


def ball(rate, drive, gravity, mass=0.5, radius=0.05):
    inertia, direction = tw.SpatialInertia.from_sphere(mass, radius), np.array([0.6, -0.3, 0.742])
    model = tw.Builder("ball", base="floating", root="ball", root_inertia=inertia, gravity=gravity).build()
    return model, model.neutral(), np.r_[rate * direction, 0, 0, 0], np.r_[drive * direction[::-1], 0, 0, 0]


def screw(rate):
    inertia = tw.SpatialInertia(1.0, [0.02, 0.01, 0], np.diag([0.01, 0.02, 0.015]))
    return one_body(tw.Helical([1, 2, 3], 0.4), inertia), [0.3], [rate], [1e-3]


def car(seed):
    """Spinning wheels with oblique axes on a body that hardly moves."""
    rng = np.random.default_rng(seed)
    body = tw.SpatialInertia.from_box(10.0, [1, 0.5, 0.2])
    builder = tw.Builder("car", base="floating", root="body", root_inertia=body, gravity=[0, 0, 0])
    for k in range(4):
        inertia, n = disc(0.5, 0.2, rng.standard_normal(3))
        builder.link(f"wheel{k}", parent="body", joint=tw.Revolute(n), inertia=inertia,
                     placement=tw.SE3(np.eye(3), rng.standard_normal(3)))  # fmt: skip
    model = builder.build()
    v = np.r_[np.zeros(6), rng.standard_normal(4) * 10 ** rng.uniform(1, 4)]
    return model, model.random_configuration(rng=rng), v, rng.standard_normal(model.nv) * 10 ** rng.uniform(-6, 0)


def tree(seed, seeds=None):
    rng = np.random.default_rng(seed)
    model = tw.random_tree(1 + seed % 8, rng=rng if seeds is None else seeds, base=("fixed", "floating")[seed % 2])
    v = rng.standard_normal(model.nv) * 10 ** rng.uniform(0, 6)
    return model, model.random_configuration(rng=rng), v, rng.standard_normal(model.nv) * 10 ** rng.uniform(-9, 3)


def rods(seed):
    """Thin rods on ball joints: each turns about itself almost freely."""
    rng, builder, last = np.random.default_rng(seed), tw.Builder("rods"), "base_link"
    for k in range(2 + seed % 3):
        tip, turn = rng.standard_normal(3), tw.SE3(tw.exp3(rng.standard_normal(3)), np.zeros(3))
        thin = tw.SpatialInertia(1.0, np.zeros(3), 10 ** rng.uniform(-5, 0) * np.diag([1, 1, 1.5]))
        builder.link(f"rod{k}", parent=last, joint=tw.Spherical(), placement=tw.SE3(turn.rotation, tip),
                     inertia=thin.transform(turn).transform(tw.SE3(np.eye(3), tip)))  # fmt: skip
        last = f"rod{k}"
    model = builder.build()
    v = rng.standard_normal(model.nv) * 10 ** rng.uniform(-2, 3)
    return model, model.random_configuration(rng=rng), v, rng.standard_normal(model.nv) * 100


FAST = {
    **{f"fan at {rate:g} rad/s, {drive:g} N m": fan(rate, drive) for rate in (100, 1047, 1e4) for drive in (0, 1e-4)},
    **{f"ball at {rate:g} rad/s": ball(rate, 1e-9, [0, 0, -9.81]) for rate in (1e3, 1e4)},
    "ball in orbit": ball(0.37, 1e-9, [0, 0, 0], 50.0, 0.5),
    **{f"screw at {rate:g} rad/s": screw(rate) for rate in (10, 1e3, 2e6)},
    "tree": tree(3, seeds=[1, 3]),
    "car": car(0),
    "rods": rods(0),
}


def exceeded(model, q, v, tau):
    """What is above the estimate, of a state and without one."""
    q, v, tau = (np.asarray(x, float) for x in (q, v, tau))
    s, weight = State(q, v, np.zeros(model.nv)), np.sqrt(np.diagonal(tw.crba(model, q)))
    right, free = (accelerations(model, s, x) for x in (tau, 0 * tau))
    size = float(max(abs(x * weight).max() for x in (right, free, right - free)))
    terms = (error_bounds._bias_terms(model, q, v) / weight).max()
    for_all, for_this, for_any_torque = tw.accuracy(model, q), tw.accuracy(model, q, v, tau), tw.accuracy(model, q, v)
    assert for_any_torque.aba >= for_this.aba * (1 - 1e-12)
    answers = {
        "aba": tw.aba(model, q, v, tau),
        "fast": tw.fast.aba(model, q, v, tau),
        "crba_solve": solve(tw.crba(model, q), tau - tw.nonlinear_effects(model, q, v)),
    }
    for name, answer in answers.items():
        error = float(max(abs((as_mpmath(answer) - right) * weight)))
        for known, against in ((for_this, size), (for_all, max(size, terms))):
            if not error <= float(known.aba) * against and not np.isinf(known.aba):
                yield name, error / against, float(known.aba)


@pytest.mark.parametrize("machine", FAST)
def test_where_terms_of_the_velocity_cancel_no_error_is_above_the_estimate(machine):
    assert list(exceeded(*FAST[machine])) == []


@pytest.mark.slow
@pytest.mark.parametrize("make", [car, tree, rods])
@pytest.mark.parametrize("seed", range(1, 40))
def test_no_error_of_fast_machines_is_above_the_estimate(make, seed):
    assert list(exceeded(*make(seed))) == []


def test_a_disc_that_spins_has_no_certain_digit_where_nothing_accelerates_it():
    model, q, v, _ = fan(1047.0, 0.0)
    assert tw.aba(model, q, v, [0.0]) != 0  # and right is 0
    assert tw.accuracy(model, q, v, [0.0]).aba == np.inf
    assert tw.accuracy(model, q, v, [0.0]).digits["aba"] == 0
    driven = [float(tw.accuracy(model, q, v, [drive]).aba) for drive in (1e-4, 1e-2, 1.0)]
    assert driven[0] > 10 * driven[1] > 100 * tw.accuracy(model, q).aba
    assert driven[1] > driven[2]


def test_a_slow_robot_has_the_digits_that_it_has_without_a_velocity():
    go2, arm = shared("go2"), shared("planar_arm")
    still = np.zeros(go2.nv)
    plain = tw.accuracy(go2, go2.standing()).aba
    for v in (still, still + 0.1, still + 1.0):
        for tau in (None, still, still + 3.0):
            assert plain <= tw.accuracy(go2, go2.standing(), v, tau).aba < 1.5 * plain
    assert tw.accuracy(arm, [0.1, 0.2, 0.3], tau=[1.0, 2.0, 0.5]).aba < 1.5 * tw.accuracy(arm, [0.1, 0.2, 0.3]).aba


def test_states_come_as_batches_and_are_checked():
    model, q = shared("go2"), shared("go2").standing()
    v = np.random.default_rng(0).standard_normal((3, 2, model.nv))
    known = tw.accuracy(model, q, v, v[0])
    assert known.aba.shape == known.crba_solve.shape == (3, 2)
    assert known.aba[2, 1] == pytest.approx(tw.accuracy(model, q, v[2, 1], v[0, 1]).aba, rel=1e-9)
    single = tw.accuracy(model, *(x.astype(np.float32) for x in (q, v[0, 0], v[0, 1])))
    assert single.aba > 1e8 * known.aba[0, 0]
    with pytest.raises(tw.ShapeError, match="v: expected"):
        tw.accuracy(model, q, q)
    with pytest.raises(tw.ShapeError, match="tau: expected"):
        tw.accuracy(model, q, tau=q)
    still = tw.Builder("rock").build()
    assert tw.accuracy(still, [], [], []).aba == tw.accuracy(still, []).aba


# ---------------------------------------------------------------- what comes back


def test_the_estimate_follows_the_number_type():
    model, q = shared("go2"), shared("go2").standing()
    single, double, long = (tw.accuracy(model, q.astype(bits)) for bits in (np.float32, np.float64, np.longdouble))
    assert single.aba / double.aba == pytest.approx(2.0**29, rel=1e-3)
    assert long.aba / double.aba == pytest.approx(np.finfo(np.longdouble).eps / 2.0**-52, rel=1e-6)
    assert single.digits["rnea"] < 6 < 13 < double.digits["rnea"]


def test_a_batch_has_an_estimate_each():
    model = shared("go2")
    q = np.stack([model.random_configuration(rng=k) for k in range(6)]).reshape(3, 2, -1)
    known = tw.accuracy(model, q)
    assert known.rnea.shape == known.aba.shape == known.crba_solve.shape == known.apparent_inertia.shape == (3, 2)
    assert known.aba[2, 1] == pytest.approx(tw.accuracy(model, q[2, 1]).aba, rel=1e-9)
    assert {x.shape for x in known.digits.values()} == {(3, 2)}


def test_an_empty_batch_and_a_robot_without_joints_say_nothing_is_lost():
    model = shared("pendulum")
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
    assert "\nA motion of 'body_0006' has 0.0e+00 of the apparent inertia of its parts one by one.\n" in str(known)
    (loss,) = known.losses
    assert (loss.cause, loss.joints, loss.digits, loss.lines) == ("no inertia", ("body_0006",), np.inf, "")


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
    assert str(tw.accuracy(shared("go2"), shared("go2").standing())).count("\n") == 0


def test_a_configuration_that_is_none_is_refused():
    model = shared("go2")
    with pytest.raises(tw.ShapeError, match="q: expected"):
        tw.accuracy(model, np.zeros(18))
    with pytest.raises(ValueError, match="quaternion"):
        tw.accuracy(model, np.zeros(19))
    with pytest.raises(ValueError, match="finite"):
        tw.accuracy(model, np.full(19, np.nan))


def test_it_costs_less_than_five_times_aba():
    """Measured in turns, the best of each: about a tenth."""
    model, q = shared("go2"), shared("go2").standing()
    rest = np.zeros(model.nv)
    best = {}
    for _ in range(7):
        for name, call in (("aba", lambda: tw.aba(model, q, rest, rest)), ("own", lambda: tw.accuracy(model, q))):
            start = time.perf_counter()
            call()
            best[name] = min(best.get(name, np.inf), time.perf_counter() - start)
    assert best["own"] < 5 * best["aba"]


def test_the_older_name_of_the_apparent_inertia_is_kept():
    known = tw.accuracy(shared("go2"), shared("go2").standing())
    assert known.felt is known.apparent_inertia


@pytest.mark.parametrize("seed", range(3))
def test_its_mass_matrix_is_that_of_crba(seed):
    rng = np.random.default_rng(seed)
    model = tw.random_tree(10, rng=rng)
    q = np.stack([model.random_configuration(rng=rng) for _ in range(2)])
    M = tw.crba(model, q)
    assert np.allclose(error_bounds._mass_matrix(model, q), M, rtol=0, atol=1e-14 * np.abs(M).max())


# ---------------------------------------------------------------- what to do


def test_it_says_of_each_section_of_the_page_what_to_do():
    bent, still = np.linspace(0.1, 1, 10), np.zeros(10)
    assert [x.cause for x in tw.accuracy(tw.chain(10, mass_ratio=1e-9), bent).elsewhere] == ["condition of M"]
    heavy = tw.chain(10, mass_ratio=1e9)
    steered = tw.accuracy(heavy, bent, still, tw.rnea(heavy, bent, still, np.ones(10)))
    assert [x.cause for x in steered.losses] == ["weak motion", "rounded tau"]
    assert [x.cause for x in tw.accuracy(heavy, bent, still, np.array([1.0, -1.0] * 5)).losses] == ["weak motion"]
    (single,) = tw.accuracy(tw.chain(64), np.zeros(64, np.float32)).losses
    assert "float64 keeps all 7" in single.cure
    go2, q = shared("go2"), shared("go2").standing()
    q[0] = 1e4
    assert [x.cause for x in tw.accuracy(go2, q).elsewhere] == ["sums in the world"]
    fast = np.r_[0.1, -0.2, 0.3, 1e6, 2e6, -3e6, np.zeros(12)]
    assert [x.cause for x in tw.accuracy(go2, go2.standing(), fast).elsewhere] == ["v × m v"]
    body = tw.SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.02, 0.02, 0.01]))
    far = one_body(tw.Revolute("z"), body.transform(tw.SE3(np.eye(3), [1e6, 0, 0])))
    assert [x.cause for x in tw.accuracy(far, [0.3]).elsewhere] == ["matrix of a far body"]
    model, q, v, tau = fan(1047.0, 1e-4)
    assert [(x.cause, x.joints) for x in tw.accuracy(model, q, v, tau).losses] == [("terms that cancel", ("body",))]


def test_a_body_far_out_on_an_oblique_axis_costs_digits():
    """M is 0.1 kg m², the sum of terms of m c² = 1e8 kg m²: eight digits of it cancel."""
    n = np.array([1.0, 2.0, 2.0]) / 3
    model = one_body(tw.Revolute(n), tw.SpatialInertia(1.0, 1e4 * n, 0.1 * np.eye(3)))
    known, error = tw.accuracy(model, [0.3]), abs(tw.crba(model, [0.3])[0, 0] / 0.1 - 1)
    assert 1e-12 < error < known.aba < 1e-6
    assert [(x.cause, x.joints) for x in known.losses] == [("terms of M", ("body",))]

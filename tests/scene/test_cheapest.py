"""The cheapest model that will do: what each misses, of what is needed; how long it takes; and who is chosen."""

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import motions
from twistwrench.scene import costs
from twistwrench.scene.candidates import Articulated, limbs, radius_of_gyration
from twistwrench.scene.compiled import compile_law
from twistwrench.templates import TEMPLATES, Template

from ..robots import shared

SOLES = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), mu=0.7) for side in ("left", "right")]
ARMS = ["*_shoulder_*", "*_elbow"]
NEED = {"wrench": 0.02, "cop": 0.002, "forces": 0.02, "tau": 0.2}
GO2, HUMANOID = shared("go2"), shared("humanoid")
WALK = motions.walk(HUMANOID, samples=24)
TROT = motions.trot(HUMANOID, samples=10)


@pytest.fixture(scope="module")
def found():
    """A humanoid that walks with swinging arms; a trot is held out."""
    return tw.Scene(HUMANOID, contacts=SOLES, hold=ARMS).cheapest(NEED, WALK, held_out=TROT, margin=1.2)


@pytest.fixture(autouse=True)
def quickly(monkeypatch):
    """No test but those of `found` and of `compile_law` needs programs."""
    monkeypatch.setattr(costs, "compile_law", lambda model, law, known, wanted: (lambda: law(*known), np.inf))


def rows(found):
    return {option.name: option for option in found.options}


def unfit(found):
    return {option.name: option.unfit for option in found.options if option.unfit}


def quick(scene, motion, **more):
    """With a tolerance that only exact models keep, so that few are compiled."""
    return scene.cheapest(1e-9, motion, **more)


# ---------------------------------------------------------------- what each misses


def test_the_wrench_missed_is_that_of_the_whole_robots_dynamics(found):
    """Of a template as it says itself; of held arms by finite differences of both momenta."""
    options = rows(found)
    template = TEMPLATES["srbm"].of(HUMANOID, WALK.q[0])
    own = template.residual(WALK.q, WALK.v, WALK.a).relative
    np.testing.assert_allclose(options["srbm"].errors["wrench"], own, rtol=1e-9)
    small = tw.lock_joints(HUMANOID, ARMS, HUMANOID.standing())
    size = template.residual(WALK.q[0], WALK.v[0], WALK.a[0])

    def missed(k, h=1e-5):
        rate = np.zeros(6)
        for sign in (1, -1):
            dv = sign * h * WALK.v[k] + h * h / 2 * WALK.a[k]
            q, v = HUMANOID.integrate(WALK.q[k], dv), WALK.v[k] + sign * h * WALK.a[k]
            held = tw.centroidal_momentum(small.model, *small.reduce(q, v))
            rate += sign * (held - tw.centroidal_momentum(HUMANOID, q, v)) / (2 * h)
        return np.sqrt((rate[3:] ** 2).sum() + (rate[:3] ** 2).sum() / size.length**2) / size.weight

    for k in (3, 11, 20):
        assert options["this scene"].errors["wrench"][k] == pytest.approx(missed(k), rel=1e-5)


def test_torques_and_forces_missed_are_those_of_the_inverse_dynamics_of_both_robots(found):
    """The least forces at the corners of the feet that stand, as `contact_inverse_dynamics` finds them."""
    small = tw.lock_joints(HUMANOID, ARMS, HUMANOID.standing())
    (q, v), (_, a) = small.reduce(WALK.q, WALK.v), small.reduce(WALK.q, WALK.a)
    mine = rows(found)["this scene"]
    np.testing.assert_array_equal(mine.kept, small.kept_v)
    weight = HUMANOID.mass * 9.81
    for k in range(0, len(WALK), 8):
        on = [tw.PointContact(foot, 1.0) for foot, stands in zip(WALK.feet, WALK.contacts[k], strict=True) if stands]
        whole = tw.contact_inverse_dynamics(HUMANOID, WALK.q[k], WALK.v[k], WALK.a[k], on)
        held = tw.contact_inverse_dynamics(small.model, q[k], v[k], a[k], on)
        off = np.abs(held.tau - whole.tau[small.kept_v])[6:].max()
        assert mine.errors["tau"][k] == pytest.approx(off, rel=1e-8, abs=1e-11)
        off = max(np.linalg.norm(held.forces[c.frame] - whole.forces[c.frame]) for c in on) / weight
        assert mine.errors["forces"][k] == pytest.approx(off, rel=1e-8, abs=1e-12)


def test_a_point_mass_has_its_pressure_off_by_the_moment_over_the_load(found):
    """Its force is right and its moment zero: so far the centre of pressure moves, |k̇| across gravity over f_z."""
    rate = tw.centroidal_momentum_rate(HUMANOID, WALK.q, WALK.v, WALK.a)
    off = np.hypot(rate[:, 0], rate[:, 1]) / (rate[:, 5] + 9.81 * HUMANOID.mass)
    np.testing.assert_allclose(rows(found)["point_mass"].errors["cop"], off, rtol=1e-9)
    needed = motions.ground(HUMANOID, WALK)
    mass = TEMPLATES["lipm"].of(HUMANOID, WALK.q[0])
    p_ddot = rate[:, 3:] / HUMANOID.mass
    there = mass.center_of_pressure(tw.center_of_mass(HUMANOID, WALK.q), p_ddot)
    assert needed.loaded.all()
    off = np.hypot(*(there - needed.center_of_pressure)[:, :2].T)
    assert np.abs(rows(found)["lipm"].errors["cop"] - off).max() < 0.02 * off.max()  # the feet are not all as low


def test_what_is_exact_misses_nothing_and_what_is_silent_tells_nothing(found):
    options = rows(found)
    assert set(options) == {
        *TEMPLATES,
        "hold waist_yaw",
        "hold left_shoulder_pitch",
        "hold right_shoulder_pitch",
        "hold left_shoulder_pitch + right_shoulder_pitch",
        "this scene",
    }
    assert {name: options["full"].worst(name) for name in NEED} == dict.fromkeys(NEED, 0)
    assert max(options["centroidal"].worst(name) for name in ("wrench", "cop", "forces")) < 1e-12
    assert options["centroidal"].worst("tau") == np.inf
    assert not options["centroidal"].predicts_torques
    assert options["full"].predicts_torques
    worst = {name: option.worst() for name, option in options.items()}
    assert worst["hold left_shoulder_pitch"] < worst["this scene"] < worst["srbm_frozen"]
    assert worst["this scene"] == pytest.approx(worst["hold left_shoulder_pitch + right_shoulder_pitch"], rel=0.01)


# ---------------------------------------------------------------- who is chosen


def test_the_choice_is_the_least_work_within_the_tolerance_and_the_margin(found):
    fits = [o for o in found.options if all(1.2 * o.worst(name) <= most for name, most in NEED.items())]
    assert found.best is fits[0] is found.options[0]
    assert [o.operations for o in fits] == sorted(o.operations for o in fits)
    assert np.isfinite([(o.operations, o.seconds) for o in fits]).all()
    assert all(np.isnan(o.operations) and np.isnan(o.seconds) for o in found.options if o not in fits)
    assert replace(found, tolerance=dict.fromkeys(NEED, 0.0)).best.name == "full"
    strict = replace(found, margin=1.001 * NEED["cop"] / rows(found)["this scene"].worst("cop"))
    assert not rows(found)["this scene"].within(NEED, strict.margin)


def test_what_is_held_out_judges_the_choice_and_does_not_make_it(found):
    options = rows(found)
    assert found.held_out == "trot"
    assert {len(o.held_out["wrench"]) for o in options.values()} == {10}
    alone = TEMPLATES["srbm"].of(HUMANOID, WALK.q[0]).residual(TROT.q, TROT.v, TROT.a).relative.max()
    assert options["srbm"].worst(held_out=True) == pytest.approx(alone)
    assert found.holds == found.best.within(NEED, held_out=True)
    assert not replace(found, tolerance={"tau": found.best.worst("tau")}, margin=1.0).holds  # it is worse in a trot


@pytest.mark.slow
def test_several_motions_are_judged_together():
    scene, some = tw.Scene(GO2), [motions.walk(GO2, samples=5), motions.trot(GO2, samples=4)]
    both, each = quick(scene, some), [quick(scene, one) for one in some]
    assert both.motion == "walk, trot"
    for name, option in rows(both).items():
        if name not in ("srbm_frozen", "lipm"):  # those are made where the first motion begins
            parts = [rows(one)[name].errors["cop"] for one in each]
            np.testing.assert_allclose(option.errors["cop"], np.concatenate(parts), rtol=0, atol=1e-9)


def test_the_choice_runs(found):
    best, k = found.best, 7
    assert isinstance(best.model, tw.Model)
    gone = [name for name in HUMANOID.joint_names[1:] if name not in best.model.joint_names]
    small = tw.lock_joints(HUMANOID, gone, HUMANOID.standing() if best.name == "this scene" else WALK.q[0])
    q, v = small.reduce(WALK.q, WALK.v)
    a = small.reduce(WALK.q, WALK.a)[1]
    answer = best(WALK.q, WALK.v, WALK.a)
    np.testing.assert_allclose(answer.tau, tw.rnea(best.model, q, v, a), rtol=1e-12, atol=1e-12)
    rate = tw.centroidal_momentum_rate(best.model, q, v, a)
    assert np.abs(answer.wrench - rate).max() < 1e-11 * np.abs(rate).max()
    assert best(WALK.q[k], WALK.v[k], WALK.a[k]).tau.shape == (len(best.kept),)
    mass = rows(found)["point_mass"]
    assert isinstance(mass.model, Template)
    assert mass(WALK.q, WALK.v, WALK.a).tau is None
    np.testing.assert_array_equal(mass(WALK.q, WALK.v, WALK.a).wrench, mass.model.rate(WALK.q, WALK.v, WALK.a))


def test_the_table_and_the_picture_show_every_option_and_the_choice(found):
    lines = str(found).splitlines()
    assert lines[0] == (
        "walk: the largest errors; shares are of the weight; at most wrench 0.02, cop 2 mm, forces 0.02, tau 0.2 N m, "
        "with a margin of 1.2; held out: trot"
    )
    assert len(lines) == 2 + len(found.options)
    assert [line.split("  ")[0] for line in lines if line.startswith("→")] == ["→ " + found.best.name]
    row = next(line for line in lines if line.startswith("  point_mass"))
    for text in (f"{rows(found)['point_mass'].worst():.2g}>", f"{1e3 * rows(found)['point_mass'].worst('cop'):.2g}>"):
        assert text in row
    figure = pytest.importorskip("matplotlib.figure", reason="matplotlib is not installed: the picture is not made")
    ax = figure.Figure().add_subplot()
    assert found.plot(ax) is ax
    timed = [o for o in found.options if np.isfinite(o.seconds)]
    ends = sorted(bar.get_x() + bar.get_width() for bar in ax.patches)
    np.testing.assert_allclose(ends, sorted(1e6 * o.seconds for o in timed), rtol=1e-12)
    assert all(f" {o.operations:.0f} " in line for o, line in zip(timed, lines[2:]))
    assert [label.get_text() for label in ax.get_yticklabels()] == [o.name for o in found.options]
    assert [text.get_text().split(",")[0] for text in ax.texts] == [f"{o.worst():.2g}" for o in found.options]


@pytest.mark.slow
def test_the_order_is_the_same_whatever_the_clock_says(monkeypatch):
    """By operations: those that come later are quicker by this clock. Of what is no program only the time is known."""
    monkeypatch.undo()
    monkeypatch.setattr(costs, "seconds", lambda calls, states: [1.0 / (k + 1) for k in range(len(calls))])
    scene, walk = tw.Scene(GO2), motions.walk(GO2, samples=4)
    some = [option for option in scene.cheapest(1.0, walk).options if option.operations > 0]
    assert [option.name for option in some] == ["lipm", "point_mass", "srbm_frozen", "srbm", "full", "centroidal"]
    assert [option.operations for option in some] == sorted(option.operations for option in some)
    monkeypatch.setattr(costs, "compile_law", lambda model, law, known, wanted: (lambda: law(*known), np.inf))
    names = [option.name for option in scene.cheapest(1.0, walk).options]
    assert names == ["full", "centroidal", "srbm", "srbm_frozen", "lipm", "point_mass"]


# ---------------------------------------------------------------- what is timed


def test_a_law_is_compiled_as_it_is_written():
    walk = motions.walk(GO2, samples=9)
    state = walk.q, walk.v, walk.a
    for name in ("point_mass", "lipm", "srbm_frozen", "srbm"):
        template = TEMPLATES[name].of(GO2, GO2.standing())
        known = template.read(*state)
        (rate,) = compile_law(GO2, lambda *x, law=template.law: (law(*x),), known, [0])[0]()
        assert np.abs(rate - template.law(*known)).max() < 1e-13 * GO2.mass * 9.81
    arm = shared("planar_arm")
    reach = motions.reach(arm, arm.neutral(), [1.0, -0.5, 0.2], samples=9)
    small = tw.lock_joints(arm, ["wrist"], arm.neutral())
    held = Articulated.of(arm, small.model, small.reduce)
    known = held.read(reach.q, reach.v, reach.a)
    for wanted in ([0], [0, 1]):
        for ours, right in zip(compile_law(arm, held.law, known, wanted)[0](), held.law(*known), strict=False):
            assert np.abs(ours - right).max() < 1e-12 * np.abs(right).max()


def test_a_law_that_asks_what_its_numbers_are_is_timed_as_it_is():
    x = np.arange(6.0).reshape(3, 2)
    run, operations = compile_law(GO2, lambda x: (x if float(x.flat[0]) >= 0 else -x, 2 * x), [x], [1])
    np.testing.assert_array_equal(run()[0], 2 * x)
    assert operations == np.inf


# ---------------------------------------------------------------- robots of every kind


def test_limbs_are_what_touches_nothing():
    assert list(limbs(HUMANOID, ["left_hand", *HUMANOID.feet])) == ["right_shoulder_pitch"]
    assert set(limbs(HUMANOID, [])) >= {"left_hip_yaw", "right_hip_yaw", "waist_yaw"}
    assert limbs(GO2, GO2.feet) == {}


def test_held_joints_that_are_still_cost_nothing():
    arms = [k for k, name in enumerate(HUMANOID.joint_names) if "shoulder" in name or "elbow" in name]
    q, v, a = WALK.q.copy(), WALK.v.copy(), WALK.a.copy()
    for k in arms:
        q[:, HUMANOID.q_slice[k]] = q[0, HUMANOID.q_slice[k]]
        v[:, HUMANOID.v_slice[k]] = a[:, HUMANOID.v_slice[k]] = 0
    need = {"wrench": 1e-9, "tau": 1e-9, "of": ["*_hip_*", "*_knee", "*_ankle_*"]}
    still = replace(WALK, q=q, v=v, a=a)
    some = rows(tw.Scene(HUMANOID).cheapest(need, still, groups={"arms": ARMS}))
    assert set(some) == {*TEMPLATES, "hold arms"}
    assert some["hold arms"].worst() < 1e-14
    assert some["hold arms"].worst("tau") < 1e-11
    assert some["hold arms"].leaves_out == "The motion of 8 of 21 joints."


@pytest.mark.slow
def test_a_robot_loaded_from_a_file_is_judged_as_the_one_of_the_catalogue():
    """It knows no feet; the height of the pendulum is that above the scene's contacts."""
    unknown = replace(GO2, feet=(), postures={})
    walk = motions.walk(GO2, samples=4)
    feet = [tw.PointContact(foot, 0.7) for foot in GO2.feet]
    here, there = (quick(tw.Scene(model, contacts=feet), walk) for model in (unknown, GO2))
    assert unfit(here) == unfit(there) == {}
    for name, option in rows(there).items():
        for quantity, errors in option.errors.items():
            np.testing.assert_allclose(rows(here)[name].errors[quantity], errors, rtol=0, atol=1e-12)
    without = quick(tw.Scene(unknown), walk)
    assert unfit(without) == {"lipm": "height: 'go2' has no feet, so it must be given"}
    assert "  lipm         does not apply: height: 'go2' has no feet" in str(without)


@pytest.mark.slow
def test_a_motion_without_feet_stands_on_the_scenes_contacts():
    walk = motions.walk(GO2, samples=3)
    on, off = (replace(walk, feet=(), contacts=np.zeros((3, 0), bool)), replace(walk, contacts=np.ones((3, 4), bool)))
    feet = [tw.PointContact(foot, 0.7) for foot in GO2.feet]
    for name, option in rows(quick(tw.Scene(GO2, contacts=feet), on)).items():
        for quantity, errors in rows(quick(tw.Scene(GO2), off))[name].errors.items():
            np.testing.assert_allclose(option.errors[quantity], errors, rtol=0, atol=1e-12)


def test_without_gravity_the_pendulum_does_not_apply_and_the_rest_does():
    walk = motions.walk(GO2, samples=8)
    some = quick(tw.Scene(GO2, gravity=[0, 0, 0]), walk)
    assert unfit(some) == {"lipm": "'go2' has no gravity: a pendulum needs one"}
    assert "shares are of the largest ḣ_G of the motion" in str(some)
    assert rows(some)["centroidal"].worst() < 1e-12
    assert rows(some)["point_mass"].worst() <= 1  # it has the force right, and misses what the moment is
    assert "cop" not in rows(some)["full"].errors
    still = replace(walk, q=walk.q[:1].repeat(8, 0), v=0 * walk.v, a=0 * walk.a)
    assert quick(tw.Scene(GO2, gravity=[0, 0, 0]), still).best.worst() == 0  # nothing moves, nothing is missed


def test_an_arm_has_no_templates_but_held_joints():
    arm = shared("planar_arm")
    motion = motions.reach(arm, arm.neutral(), [1.0, -0.5, 0.2], samples=12)
    groups = {"tip": ["wrist"], "mid": ["elbow"], "all": ["*"]}
    need = {"tau": 100.0, "of": ["shoulder", "elbow"], "wrench": 0.1}
    some = tw.Scene(arm).cheapest(need, motion, groups=groups)
    assert set(unfit(some)) == {"point_mass", "lipm", "srbm_frozen", "srbm", "centroidal", "hold all"}
    assert unfit(some)["srbm"] == "'planar_arm': expected a floating base, got a fixed one"
    assert unfit(some)["hold all"] == "nothing is left to move"
    with pytest.raises(ValueError, match="'hold all' does not apply: nothing is left to move"):
        rows(some)["hold all"](motion.q, motion.v, motion.a)
    assert {"hold tip", "hold mid", "hold tip + mid"} < set(rows(some))
    assert rows(some)["full"].worst() == rows(some)["full"].worst("tau") == 0
    assert set(rows(some)["full"].errors) == {"wrench", "tau"}
    small = tw.lock_joints(arm, ["wrist"], motion.q[0])
    q, v = small.reduce(motion.q, motion.v)
    a = small.reduce(motion.q, motion.a)[1]
    off = tw.rnea(small.model, q, v, a) - tw.rnea(arm, motion.q, motion.v, motion.a)[:, small.kept_v]
    np.testing.assert_allclose(rows(some)["hold tip"].errors["tau"], np.abs(off).max(axis=1), rtol=1e-9, atol=1e-13)
    missed = np.zeros((len(motion), 6))  # about the world's origin, and then about the whole arm's centre of mass
    for sign, model, x in ((1, small.model, (q, v, a)), (-1, arm, (motion.q, motion.v, motion.a))):
        rate = tw.centroidal_momentum_rate(model, *x)
        moment = rate[:, :3] + np.cross(tw.center_of_mass(model, x[0]), rate[:, 3:])
        missed += sign * np.concatenate([moment, rate[:, 3:]], axis=-1)
    moment = missed[:, :3] - np.cross(tw.center_of_mass(arm, motion.q), missed[:, 3:])
    sizes = (np.linalg.norm(x, axis=-1) for x in (missed[:, 3:], moment / radius_of_gyration(arm, motion.q[0])))
    share = np.hypot(*sizes) / (arm.mass * 9.81)
    np.testing.assert_allclose(rows(some)["hold tip"].errors["wrench"], share, rtol=1e-9, atol=1e-15)


def test_a_drone_is_one_body_and_has_no_motors_but_its_base():
    body = tw.SpatialInertia(1.5, [0, 0, 0.01], np.diag([0.02, 0.02, 0.04]))
    drone = tw.Builder("drone", base="floating", root_inertia=body).build()
    ahead = drone.integrate(drone.neutral(), [0.3, 0.2, 1.0, 1, 0, 0.5])
    scene, fly = tw.Scene(drone), motions.reach(drone, drone.neutral(), ahead, samples=8)
    some = quick(scene, fly)
    assert unfit(some) == {"lipm": "height: 'drone' has no feet, so it must be given"}
    assert some.best.name in ("srbm_frozen", "srbm", "centroidal", "full")  # all are exact
    assert rows(some)["srbm_frozen"].worst() < 1e-14
    for name, why in (("tau", "no joint of the scene has a motor"), ("cop", "nothing stands on the ground")):
        with pytest.raises(ValueError, match=f"tolerance: '{name}' is nothing of 'drone'.*: {why}"):
            scene.cheapest({name: 1.0}, fly)


def test_the_radius_of_gyration_is_that_of_the_templates():
    assert np.isclose(
        radius_of_gyration(GO2, GO2.standing()), TEMPLATES["full"].of(GO2, GO2.standing()).length, rtol=1e-12
    )


@pytest.mark.one_case
@pytest.mark.parametrize("base", ["planar", "fixed"])
def test_what_another_base_costs_is_a_row(base):
    walk = motions.walk(GO2, samples=4)
    scene = tw.Scene(GO2, base=base, hold=["FR_calf_joint"])
    some = quick(scene, walk)
    assert unfit(some) == {}
    mine = rows(some)["this scene"]
    said = {"planar": "The height and the tilt of the base", "fixed": "The motion of the base"}[base]
    assert mine.leaves_out == said + " and the motion of 1 of 12 joints."
    assert 1e-3 < mine.worst() < 1
    assert len(mine.kept) == 11
    level = replace(walk, q=walk.q[:1].repeat(4, 0), v=0 * walk.v, a=0 * walk.a)
    still = rows(quick(tw.Scene(GO2, base=base, q=walk.q[0]), level))["this scene"]
    assert max(still.worst(name) for name in ("wrench", "cop", "forces", "tau")) < 1e-9


# ---------------------------------------------------------------- what is rejected


@pytest.mark.parametrize(
    ("given", "error", "said"),
    [
        ({"tolerance": -0.1}, ValueError, "expected an error of 'wrench' that is allowed, 0 or more, got -0.1"),
        ({"tolerance": np.nan}, ValueError, "tolerance: expected"),
        ({"tolerance": {}}, ValueError, "tolerance: expected some of 'wrench', 'cop', 'forces', 'tau', got none"),
        ({"tolerance": {"torque": 1.0}}, tw.NameNotFound, "unknown quantity 'torque'"),
        ({"margin": 0.5}, ValueError, "margin: expected a number of at least 1, got 0.5"),
        ({"motion": []}, ValueError, "motion: expected at least one motion, got none"),
        ({"held_out": [1]}, TypeError, "held_out: expected a Motion"),
        ({"groups": {"tail": ["tail_*"]}}, tw.NameNotFound, "fits no joint"),
        ({"motion": motions.walk(GO2, samples=2)}, tw.ShapeError, "q: expected shape"),
    ],
)
def test_a_question_that_is_none_is_rejected(given, error, said):
    with pytest.raises(error, match=said):
        tw.Scene(HUMANOID).cheapest(**{"tolerance": 0.1, "motion": WALK} | given)


# ---------------------------------------------------------------- motors


def test_a_model_that_does_not_tell_a_needed_torque_does_not_do():
    """Still but for an arm: the model that holds everything else is right about that arm, and knows no other motor."""
    q, v, a = WALK.q[:1].repeat(24, 0), 0 * WALK.v, 0 * WALK.a
    others = [name for name in HUMANOID.joint_names[2:] if not name.startswith("left_shoulder")]
    groups = {"all but the left arm": others}
    scene, still = tw.Scene(HUMANOID, contacts=SOLES), replace(WALK, q=q, v=v, a=a)
    every = scene.cheapest({"tau": 0.5}, still, groups=groups)
    assert every.best.name == "full"
    assert f"ḣ_G, τ {21 - len(others)} of 21" in str(every)
    some = scene.cheapest({"tau": 0.5, "of": ["left_shoulder_*"]}, still, groups=groups)
    assert some.best.name == "hold all but the left arm"
    assert rows(some)["full"].worst("tau") == 0
    with pytest.raises(ValueError, match="'of' names the joints whose 'tau' is needed"):
        scene.cheapest({"wrench": 0.5, "of": ["left_*"]}, still)


def test_a_joint_without_a_motor_is_none():
    """A pole on a cart by its limit of zero, and by name; a base on a plane by its kind."""
    cart = tw.load("cart_pole")
    assert (tw.Scene(cart).motors, tw.Scene(cart).actuated.tolist()) == (cart.joint_names[1:2], [True, False])
    strong = replace(cart, effort_limit=[10.0, 10.0])
    assert tw.Scene(strong).actuated.tolist() == [True, True]
    named = tw.Scene(strong, motors=[cart.joint_names[1]])
    assert named.actuated.tolist() == [True, False]
    assert named.model.effort_limit.tolist() == [10.0, 0.0]
    slides = tw.Builder("sled")
    body = tw.SpatialInertia.from_box(1.0, [1, 1, 1])
    slides.link("sled", parent="base_link", joint=tw.Planar(), inertia=body)
    slides.link("mast", parent="sled", joint=tw.Revolute("y"), inertia=body)
    assert tw.Scene(slides.build()).actuated.tolist() == [False] * 3 + [True]


def test_what_cannot_be_a_motor_is_refused_by_name():
    cart = tw.load("cart_pole")
    with pytest.raises(tw.ModelError, match=f"motors.*{cart.joint_names[2]}.*effort limit is zero"):
        tw.Scene(cart, motors=["*"])
    with pytest.raises(tw.ModelError, match=r"root_joint.*no motor"):
        tw.Scene(GO2, motors=["root_joint"])
    still = motions.Motion.from_states([0.0], [[0, 0.0]], np.zeros((1, 2)), np.zeros((1, 2)))
    with pytest.raises(ValueError, match="no joint of the scene has a motor"):
        tw.Scene(replace(cart, effort_limit=0.0)).cheapest({"tau": 1.0}, still)


def test_a_bail_that_nothing_holds_does_not_stand():
    """A hinge without a motor: hanging it needs nothing, held out it would need 9.8 N m."""
    arm = tw.Builder("bucket")
    rod = tw.SpatialInertia(1.0, [0, 0, -1.0], np.diag([0.1, 0.1, 0.01]))
    arm.link("bail", parent="base_link", joint=tw.Revolute("y"), inertia=rod, effort_limit=0.0)
    scene = tw.Scene(arm.build())
    assert scene.can_stand([0.0])
    assert "'bail' would have to hold 9.81" in str(scene.can_stand([np.pi / 2]))


def test_a_motion_of_states_is_judged_as_the_one_they_came_from():
    mine = motions.Motion.from_states(WALK.t, WALK.q, WALK.v, WALK.a, feet=WALK.feet, contacts=WALK.contacts)
    scene = tw.Scene(HUMANOID, contacts=SOLES)
    for ours, theirs in zip(quick(scene, mine).options, quick(scene, WALK).options, strict=True):
        assert ours.worst() == theirs.worst()
    with pytest.raises(TypeError, match="from_states"):
        quick(scene, [1.0])


def test_the_torque_of_a_base_is_not_needed():
    with pytest.raises(tw.ModelError, match="of: 'root_joint' has no motor"):
        tw.Scene(HUMANOID).cheapest({"tau": 0.5, "of": ["root_joint"]}, WALK)

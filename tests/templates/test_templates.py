"""Templates: each exact where its assumptions hold, and off by just what they leave out where they do not (49.10)."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from study.__main__ import main as study_main
from study.templates import shown

import twistwrench as tw
from twistwrench import newton_euler_3d as slow
from twistwrench.templates import (
    TEMPLATES,
    Centroidal,
    FrozenRigidBody,
    Full,
    LinearPendulum,
    PointMass,
    Residual,
    RigidBody,
    Template,
)
from twistwrench.templates.template import com_acceleration, locked_inertia
from twistwrench.timing import Lap

from ..pages import blocks, page, run
from ..robots import shared
from ..strategies import BATCHES
from ..touching import on_bodies

GO2 = shared("go2")
STAND, REST = GO2.standing(), np.zeros(18)
G = 9.81
BRICK = tw.SpatialInertia(3.0, [0.1, -0.2, 0.3], np.diag([0.02, 0.03, 0.04]))


def brick(**how):
    return tw.Builder("brick", base="floating", root_inertia=BRICK, **how).build()


def states(*batch, seed=0, model=GO2):
    rng = np.random.default_rng(seed)
    n = int(np.prod(batch, dtype=int))
    q = np.reshape([model.random_configuration(rng=rng) for _ in range(n)], (*batch, model.nq))
    return q, *rng.standard_normal((2, *batch, model.nv))


def relative(template: Template, q, v, a):
    return template.residual(q, v, a).relative


# ---------------------------------------------------------------- closed forms


@pytest.mark.parametrize("name", [name for name in TEMPLATES if name != "lipm"])
def test_a_falling_brick_is_a_point_mass(name):
    model = brick()
    t = np.linspace(0, 2, 7)
    q = np.tile(model.neutral(), (7, 1))
    q[:, :3] += np.outer(t, [1, 0, 3]) - np.outer(t**2, [0, 0, G / 2])
    v, a = np.zeros((2, 7, 6))
    v[:, 3:], a[:, 3:] = np.array([1, 0, 3]) - np.outer(t, [0, 0, G]), [0, 0, -G]
    template = TEMPLATES[name].of(model, model.neutral())
    assert np.allclose(template.rate(q, v, a), [0, 0, 0, 0, 0, -3 * G], rtol=0, atol=1e-13)
    assert np.abs(relative(template, q, v, a)).max() < 1e-14


def test_a_pendulum_moves_hyperbolically_about_its_foot():
    """p(t) = c + (p₀ − c) cosh ωt + ṗ₀/ω sinh ωt is a motion of a body at constant height with its force through c."""
    model = brick()
    height = 0.7
    pendulum = LinearPendulum.of(model, model.neutral(), height=height)
    w, c = np.sqrt(G / height), np.array([0.3, -0.1, 0])
    t = np.linspace(0, 0.6, 11)[:, None]
    start, speed = np.array([-0.2, 0.05, height]), np.array([0.9, -0.3, 0])
    along = np.array([1, 1, 0])
    p = c + (start - c) * along * np.cosh(w * t) + speed / w * np.sinh(w * t) + [0, 0, height]
    p_ddot = w**2 * ((start - c) * along * np.cosh(w * t) + speed / w * np.sinh(w * t))
    q, a = np.tile(model.neutral(), (11, 1)), np.zeros((11, 6))
    q[:, :3], a[:, 3:] = p - BRICK.com, p_ddot
    v = np.zeros((11, 6))
    v[:, 3:] = w * (start - c) * along * np.sinh(w * t) + speed * np.cosh(w * t)
    assert np.allclose(pendulum.acceleration(p, c), p_ddot, rtol=1e-13, atol=1e-13)
    assert np.allclose(pendulum.center_of_pressure(p, p_ddot), c, rtol=0, atol=1e-13)
    assert relative(pendulum, q, v, a).max() < 1e-13
    force = pendulum.rate(q, v, a)[:, 3:] + [0, 0, 3 * G]
    assert np.abs(np.cross(c - p, force)).max() < 1e-12 * np.abs(p * force.max()).max()  # the force goes through c


def test_a_rigid_body_is_newton_and_eulers():
    """From the 3-D equations in 50 digits, of a tumbling brick."""
    model = brick()
    q, v, a = states(5, model=model)
    true = np.array([slow.centroidal_momentum_rate(model, *map(slow.as_mpmath, s)) for s in zip(q, v, a, strict=True)])
    for kind in (RigidBody, FrozenRigidBody):
        got = kind.of(model, q[0]).rate(q, v, a)
        assert np.abs((got - true).astype(float)).max() < 1e-14 * np.abs(true.astype(float)).max()


def test_a_free_top_keeps_its_angular_momentum():
    model = brick(gravity=(0, 0, 0))
    q, v, _ = states(9, model=model)
    rate = RigidBody.of(model, q[0]).rate(q, v, tw.aba(model, q, v, np.zeros(6)))
    assert np.abs(rate).max() < 1e-13


# ---------------------------------------------------------------- where the assumptions hold, and where not


def test_with_joints_that_are_still_a_robot_is_a_rigid_body():
    q, v, a = states(6)
    v[:, 6:] = a[:, 6:] = 0
    assert relative(RigidBody.of(GO2, STAND), q, v, a).max() < 1e-13
    for at in q:
        still = np.concatenate([q[:, :7], np.broadcast_to(at[7:], (6, 12))], axis=1)  # one posture, any placement
        assert relative(FrozenRigidBody.of(GO2, at), still, v, a).max() < 1e-13


def test_a_frozen_inertia_is_off_by_what_the_inertia_has_changed():
    q, v, a = states(6)
    v[:, 6:] = a[:, 6:] = 0
    frozen = FrozenRigidBody.of(GO2, STAND)
    R = tw.forward_kinematics(GO2, q).placement[1].rotation
    change, w = frozen.inertia - locked_inertia(GO2, q), v[:, :3]
    left = np.matvec(R, np.matvec(change, a[:, :3]) + np.cross(w, np.matvec(change, w)))
    residual = frozen.residual(q, v, a)
    assert np.abs(left).max() > 0.1
    assert np.allclose(residual.moment, left, rtol=0, atol=1e-12)
    assert np.abs(residual.force).max() < 1e-12


def test_a_rigid_body_leaves_out_the_joints_part_of_the_momentum():
    """At rest that is A_G q̈ of the joints; in motion it grows with the square of their rates."""
    q, v, a = states(6)
    template = RigidBody.of(GO2, STAND)
    joints = tw.centroidal_map(GO2, q)[:, :3, 6:]
    at_rest = template.residual(q, 0 * v, a).moment
    assert np.allclose(at_rest, -np.matvec(joints, a[:, 6:]), rtol=0, atol=1e-12)
    once, twice = (template.residual(q, s * v, 0 * a).moment for s in (1, 2))
    assert np.abs(once).max() > 0.01
    assert np.allclose(twice, 4 * once, rtol=1e-11, atol=1e-11)


def test_a_point_mass_leaves_out_the_moment_and_only_that():
    q, v, a = states(6)
    residual = PointMass.of(GO2, STAND).residual(q, v, a)
    assert np.allclose(residual.moment, -tw.centroidal_momentum_rate(GO2, q, v, a)[:, :3], rtol=0, atol=1e-12)
    assert np.abs(residual.force).max() < 1e-12
    slid = np.array([0, 0, 0, 1.0, 2, 3, *np.zeros(12)])  # all of it in one direction
    assert relative(PointMass.of(GO2, STAND), STAND, slid, slid) < 1e-14


def test_a_pendulum_leaves_out_what_lifts_it():
    pendulum = LinearPendulum.of(GO2, STAND)
    a = np.array([0, 0, 0, 1.0, 2, 0, *np.zeros(12)])
    assert relative(pendulum, STAND, REST, a) < 1e-14
    a[5] = 3
    residual = pendulum.residual(STAND, REST, a)
    assert np.allclose(residual.force, [0, 0, -3 * GO2.mass], rtol=1e-13, atol=1e-12)
    assert residual.relative == pytest.approx(3 / G, rel=1e-12)


def test_the_relative_residual_weighs_moments_by_the_radius_of_gyration():
    residual = Residual(np.array([3.0, 0, 0]), np.array([0, 4.0, 0]), weight=10.0, length=0.5)
    assert residual.relative == pytest.approx(np.sqrt(4**2 + 6**2) / 10)
    held = RigidBody.of(brick(), brick().neutral())
    assert held.length == pytest.approx(np.sqrt(0.09 / 2 / 3))
    assert held.weight == pytest.approx(3 * G)


# ---------------------------------------------------------------- invariants


@pytest.mark.parametrize("kind", [Centroidal, Full])
def test_the_rate_is_the_sum_of_all_wrenches_from_outside(kind):
    q, v, tau = states(4)
    forces = 30 * np.random.default_rng(1).standard_normal((4, 4, 3))
    f_ext = np.stack([on_bodies(GO2, *pair) for pair in zip(q, [GO2.feet] * 4, forces, strict=True)])
    tau[:, :6] = 0  # no motor pushes the base
    a = tw.aba(GO2, q, v, tau, f_ext)
    feet = np.stack([tw.frame_placement(GO2, q, foot).translation for foot in GO2.feet], axis=1)
    moment = np.cross(feet - tw.center_of_mass(GO2, q)[:, None], forces).sum(axis=1)
    outside = np.concatenate([moment, forces.sum(axis=1) + GO2.mass * GO2.gravity], axis=-1)
    rate = kind.of(GO2, STAND).rate(q, v, a)
    assert np.abs(rate - outside).max() < 1e-12 * np.abs(a).max()  # the accelerations are large, and cancel
    assert np.abs(PointMass.of(GO2, STAND).rate(q, v, a)[:, 3:] - outside[:, 3:]).max() < 1e-12 * np.abs(a).max()


@pytest.mark.parametrize("name", TEMPLATES)
def test_the_world_may_be_turned_about_gravity_and_shifted(name):
    template = TEMPLATES[name].of(GO2, STAND)
    q, v, a = states(5)
    T = tw.SE3(tw.exp3([0, 0, 1.1]), [3.0, -2, 5])
    there = T @ tw.forward_kinematics(GO2, q).placement[1]
    moved = np.concatenate([GO2.joints[1].from_placement(there, q[:, :7]), q[:, 7:]], axis=1)
    here, turned = template.residual(q, v, a), template.residual(moved, v, a)
    assert np.allclose(turned.moment, np.matvec(T.rotation, here.moment), rtol=0, atol=1e-11)
    assert np.allclose(turned.force, np.matvec(T.rotation, here.force), rtol=0, atol=1e-11)
    rate = template.rate(q, v, a).reshape(-1, 2, 3)
    assert np.allclose(template.rate(moved, v, a).reshape(-1, 2, 3), np.matvec(T.rotation, rate), rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", TEMPLATES)
def test_the_base_may_fly_from_any_frame_of_the_world(name):
    """Pinocchio's models may place their free-flyer anywhere: the same robot with other entries in q."""
    seat = tw.SE3(tw.exp3([0.3, 0.5, -0.4]), [1.0, 2, 3])
    other = replace(GO2, placement=(GO2.placement[0], seat, *GO2.placement[2:]))

    def there(q):
        placed = seat.inverse() @ tw.forward_kinematics(GO2, q).placement[1]
        return np.concatenate([GO2.joints[1].from_placement(placed, q[..., :7]), q[..., 7:]], axis=-1)

    q, v, a = states(6)
    here, moved = TEMPLATES[name].of(GO2, STAND), TEMPLATES[name].of(other, there(STAND))
    assert np.allclose(moved.rate(there(q), v, a), here.rate(q, v, a), rtol=0, atol=1e-10)
    assert np.allclose(moved.residual(there(q), v, a).relative, here.residual(q, v, a).relative, rtol=0, atol=1e-12)


def test_a_pendulums_up_is_where_gravity_does_not_pull():
    R = tw.exp3([0.4, -0.7, 0.2])
    pendulum, other = (LinearPendulum.of(m, m.neutral(), height=0.5) for m in (brick(), brick(gravity=R @ [0, 0, -G])))
    p, p_ddot = np.random.default_rng(0).standard_normal((2, 3))
    c = R @ pendulum.center_of_pressure(p, p_ddot)
    assert np.allclose(other.center_of_pressure(R @ p, R @ p_ddot), c, rtol=0, atol=1e-14)
    assert np.allclose(other.acceleration(R @ p, c), R @ pendulum.acceleration(p, R.T @ c), rtol=0, atol=1e-13)


# ---------------------------------------------------------------- outside oracle


def test_what_templates_read_is_pinocchios():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    there = tw.bridge.to_pinocchio_model(GO2)
    data = there.createData()
    for q, v, a in zip(*states(5), strict=True):
        pv, pa = (tw.bridge.to_pinocchio_tangent(GO2, x) for x in (v, a))
        pin.centerOfMass(there, data, q, pv, pa)
        assert np.allclose(com_acceleration(GO2, q, v, a), data.acom[0], rtol=0, atol=1e-12)
        pin.ccrba(there, data, q, pv)
        R = data.oMi[1].rotation
        assert np.allclose(R @ locked_inertia(GO2, q) @ R.T, data.Ig.inertia, rtol=0, atol=1e-13)
        composite = pin.crba(there, data, q) is not None and data.Ycrb[1].inertia  # at its own centre of mass
        assert np.allclose(locked_inertia(GO2, q), composite, rtol=0, atol=1e-13)
        dA_G = pin.computeCentroidalMapTimeVariation(there, data, q, pv)
        rate = tw.bridge.from_pinocchio_force(pin.Force(data.Ag @ pa + dA_G @ pv))
        for kind in (Centroidal, Full):
            assert np.allclose(kind.of(GO2, STAND).rate(q, v, a), rate, rtol=0, atol=1e-11)


def test_the_centroidal_model_is_the_truth_in_50_digits():
    for q, v, a in zip(*states(2), strict=True):
        true = slow.centroidal_momentum_rate(GO2, *map(slow.as_mpmath, (q, v, a)))
        for kind in (Centroidal, Full):
            error = np.abs((kind.of(GO2, STAND).rate(q, v, a) - true).astype(float)).max()
            assert error < 1e-14 * np.abs(true.astype(float)).max() * 10


# ---------------------------------------------------------------- batches, number types, names


@pytest.mark.parametrize("name", TEMPLATES)
@pytest.mark.parametrize("batch", BATCHES)
def test_batch_axes_come_first(name, batch):
    template = TEMPLATES[name].of(GO2, STAND)
    q, v, a = states(*batch)
    residual = template.residual(q, v, a)
    assert template.rate(q, v, a).shape == (*batch, 6)
    assert (residual.moment.shape, residual.force.shape, residual.relative.shape) == ((*batch, 3), (*batch, 3), batch)
    if 0 not in batch:
        one = template.rate(q[(0,) * len(batch)], v[(0,) * len(batch)], a[(0,) * len(batch)])
        assert np.allclose(template.rate(q, v, a)[(0,) * len(batch)], one, rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", TEMPLATES)
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, np.complex128])
def test_number_types_are_kept(name, dtype):
    template, (q, v, a) = TEMPLATES[name].of(GO2, STAND), states()
    rate = template.rate(q.astype(dtype), v.astype(dtype), a.astype(dtype))
    assert rate.dtype == dtype
    assert np.abs(rate - template.rate(q, v, a)).max() < 100 * max(np.finfo(dtype).eps, 1e-16) * np.abs(rate).max()


@pytest.mark.parametrize("name", TEMPLATES)
def test_a_complex_step_differentiates_a_prediction(name):
    template, (q, v, a), h = TEMPLATES[name].of(GO2, STAND), states(), 1e-20
    along = template.rate(q, v, a + 1j * h * a).imag / h  # linear in a
    assert np.allclose(along, template.rate(q, v, a) - template.rate(q, v, 0 * a), rtol=0, atol=1e-12)


def test_every_template_is_listed_by_its_name_and_says_what_it_assumes():
    assert [kind.name for kind in TEMPLATES.values()] == list(TEMPLATES)
    assert all(kind.assumes.endswith(".") for kind in TEMPLATES.values())


def test_a_template_of_ones_own_is_a_few_lines():
    class Nothing(Template):
        name, assumes = "nothing", "Nothing moves."

        def read(self, q, v, a):
            return (q,)

        def law(self, q):
            return np.zeros((*q.shape[:-1], 6))

    residual = Nothing.of(GO2, STAND).residual(*states(3))
    assert np.allclose(residual.force, -Full.of(GO2, STAND).rate(*states(3))[:, 3:])


# ---------------------------------------------------------------- what cannot be


def test_a_fixed_base_has_no_template():
    arm = shared("planar_arm")
    for kind in TEMPLATES.values():
        with pytest.raises(ValueError, match="'planar_arm': expected a floating base, got a fixed one"):
            kind.of(arm, arm.neutral())


def test_a_template_is_made_at_one_real_configuration():
    for q in (np.stack([STAND, STAND]), STAND + 0j):
        with pytest.raises(ValueError, match="expected one real configuration"):
            RigidBody.of(GO2, q)
    with pytest.raises(tw.ShapeError, match="expected shape"):
        PointMass.of(GO2, STAND[:-1])
    mine = STAND.copy()
    made = RigidBody.of(GO2, mine)
    mine[0] = 5.0
    assert (made.q == STAND).all()


def test_states_of_the_wrong_shape_are_refused():
    with pytest.raises(tw.ShapeError, match="v: expected shape"):
        PointMass.of(GO2, STAND).rate(STAND, REST[1:], REST)
    with pytest.raises(tw.ShapeError, match="batch axes"):
        Full.of(GO2, STAND).residual(np.stack([STAND] * 2), np.zeros((3, 18)), REST)


def test_without_gravity_there_is_no_pendulum_and_no_relative_residual():
    model = brick(gravity=(0, 0, 0))
    with pytest.raises(tw.SingularError, match="no gravity"):
        LinearPendulum.of(model, model.neutral(), height=1.0)
    residual = PointMass.of(model, model.neutral()).residual(*states(model=model))
    assert np.abs(residual.moment).max() > 0
    with pytest.raises(tw.SingularError, match="without gravity"):
        _ = residual.relative
    point = tw.Builder("point", base="floating", root_inertia=tw.SpatialInertia(1.0, [0, 0, 0], np.zeros((3, 3))))
    model = point.build(physical=False)
    with pytest.raises(tw.SingularError, match="a point has no radius of gyration"):
        _ = PointMass.of(model, model.neutral()).residual(*states(model=model)).relative


def test_a_pendulum_needs_a_height():
    with pytest.raises(ValueError, match="height: 'brick' has no feet"):
        LinearPendulum.of(brick(), brick().neutral())
    for height in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="height: expected a positive number"):
            LinearPendulum.of(GO2, STAND, height=height)
    flat = replace(GO2, feet=("base",))
    with pytest.raises(ValueError, match="height: expected a positive number"):
        LinearPendulum.of(flat, STAND)


def test_a_robot_without_mass_has_no_template():
    model = tw.Builder("ghost", base="floating").build()
    with pytest.raises(tw.SingularError, match="has mass"):
        PointMass.of(model, model.neutral())


# ---------------------------------------------------------------- the page

PAGES = [page("templates", language) for language in ("", ".zh-CN")]


def code_of(path):
    text = path.read_text(encoding="utf-8")
    return blocks(text, 0, len(text))


@pytest.mark.slow
def test_the_page_runs():
    run(PAGES[0], code_of(PAGES[0]))


def test_both_languages_have_the_same_code_and_the_same_numbers():
    code, twin = ([re.sub(r" *#.*", "", b).strip() for b in code_of(path)] for path in PAGES)
    assert code == twin
    numbers, others = (re.findall(r"^\|.*\d.*\|$", path.read_text(encoding="utf-8"), re.MULTILINE) for path in PAGES)
    assert [re.findall(r"[\d.e-]+\d", row) for row in numbers] == [re.findall(r"[\d.e-]+\d", row) for row in others]


def test_the_page_names_every_template():
    for path in PAGES:
        rows = re.findall(r"^\| `(\w+)` \| `(\w+)` \|", path.read_text(encoding="utf-8"), re.MULTILINE)
        assert dict(rows) == {name: kind.__name__ for name, kind in TEMPLATES.items()}


@pytest.mark.slow
def test_the_numbers_of_the_page_are_still_there():
    """Of the robots that are here: rms and largest of every template, and the largest k̇_G over the weight."""
    text = PAGES[0].read_text(encoding="utf-8")
    label = {"Go2": "go2", "Solo12": "solo12", "Talos": "talos_reduced", "G1": "g1"}
    rows = re.findall(r"^\| ?(Go2|Solo12|Talos|G1|) ?\| (walk|trot|jump) \|(.*)\|$", text, re.MULTILINE)
    assert len(rows) == 12
    name = ""
    for robot, kind, cells in rows:
        name = label[robot] if robot else name
        try:
            model = tw.load(name)
        except tw.NameNotFound:
            continue
        m = tw.motions.MOTIONS[kind](model)
        for template, cell in zip(list(TEMPLATES)[:4], cells.split("|"), strict=False):
            relative = TEMPLATES[template].of(model, model.standing()).residual(m.q, m.v, m.a).relative
            rms, largest = (float(x) for x in re.findall(r"[\d.]+", cell))
            assert np.sqrt((relative**2).mean()) == pytest.approx(rms, rel=0.06), (name, kind, template)
            assert relative.max() == pytest.approx(largest, rel=0.06), (name, kind, template)


# ---------------------------------------------------------------- the study


def in_a_millisecond(calls, *, rounds, after_round):
    """Every call, but the first has to wait for the processor each time."""
    for _ in range(rounds):
        after_round()
    return [Lap(call, **{"kept" if k else "spare": [1e-3]}) for k, call in enumerate(calls)]


@pytest.mark.slow
def test_the_study_prints_its_table_and_draws(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("study.record.round_robin", in_a_millisecond)
    picture = tmp_path / "templates.png"
    assert study_main(["templates", "go2", "--samples", "20", "--plot", str(picture)]) == 0
    printed = capsys.readouterr().out
    rows = re.findall(r"^(walk|trot|jump) +(\w+) +([\d.e-]+) \(", printed, re.MULTILINE)
    assert [row[:2] for row in rows] == [(kind, name) for kind in ("walk", "trot", "jump") for name in TEMPLATES]
    assert max(float(rms) for _, name, rms in rows if name in ("centroidal", "full")) < 1e-14
    assert "60 % of the time" in printed  # a jump is loaded for less
    assert len(re.findall(r" +50 µs +1\.00 +1\.000$", printed, re.MULTILINE)) == 3 * (len(TEMPLATES) - 1)
    assert len(re.findall(r"^\w+ +point_mass .* +~50 µs +1\.00 +1\.000$", printed, re.MULTILINE)) == 3
    assert printed.count("other things to do") == 1
    assert picture.stat().st_size > 20_000


@pytest.mark.slow
def test_the_picture_of_the_study_draws_the_values_that_it_has():
    figure = pytest.importorskip("matplotlib.figure", reason="matplotlib is not installed: the picture is not made")
    from study.pictures import draw_residuals

    jump, ax = tw.motions.jump(GO2, samples=20), figure.Figure().add_subplot()
    draw_residuals(GO2, jump, ax)
    point = next(line for line in ax.lines if line.get_label() == "point_mass")
    relative = PointMass.of(GO2, STAND).residual(jump.q, jump.v, jump.a).relative
    assert relative.min() < 1e-10
    np.testing.assert_array_equal(point.get_ydata(), relative)
    assert f"point_mass {relative.min():.0e}" in ax.texts[0].get_text()


def test_the_study_has_a_table_for_every_robot(monkeypatch, capsys):
    monkeypatch.setattr("study.record.round_robin", in_a_millisecond)
    monkeypatch.setattr("study.__main__.MOTIONS", {"walk": tw.motions.walk})
    assert study_main(["templates", "go2", "humanoid", "--samples", "4"]) == 0
    printed = capsys.readouterr().out
    assert re.findall(r"^(\w+), nv = (\d+)", printed, re.MULTILINE) == [("go2", "18"), ("humanoid", "27")]
    assert len(re.findall("^walk ", printed, re.MULTILINE)) == 2 * len(TEMPLATES)


def test_a_robot_of_the_study_that_is_not_installed_is_left_out(monkeypatch, capsys):
    monkeypatch.setattr("study.templates.ROBOTS", ("nobody",))
    assert study_main(["templates", "nobody"]) == 0
    assert capsys.readouterr().out == "nobody: not installed, left out (example-robot-data)\n\n"


def test_a_table_of_calls_that_nothing_disturbed_says_nothing_of_it():
    assert "other things to do" not in shown("go2", GO2, [], [])


@pytest.mark.parametrize("samples", ["1", "-5", "few"])
def test_the_study_takes_no_fewer_than_two_samples(samples, capsys):
    with pytest.raises(SystemExit) as stop:
        study_main(["templates", "go2", "--samples", samples])
    assert stop.value.code == 2
    assert f"--samples: expected a whole number, 2 or more, got '{samples}'" in capsys.readouterr().err


def test_the_study_says_which_robot_is_not_known(capsys):
    assert study_main(["templates", "go3"]) == 2
    assert "unknown robot 'go3'" in capsys.readouterr().err

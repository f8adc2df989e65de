"""Take it in your hand: the numbers that the pages compute are those of the package, and both languages say the same.

The scripts of the pages run under Node, where there is no page: each hands out the functions it computes with.
"""

import json
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from website import handled  # noqa: E402

FOLDER, SCRIPTS = ROOT / "docs" / "website" / "hands", ROOT / "docs" / "website" / "static" / "hands"
NAMES = sorted(path.stem for path in FOLDER.glob("*.toml"))
RUN = """
const fs = require("fs"), vm = require("vm");
const { files, calls } = JSON.parse(fs.readFileSync(0, "utf8"));
for (const file of files) vm.runInThisContext(fs.readFileSync(file, "utf8"), file);
const at = (path) => path.split(".").reduce((object, name) => object[name], globalThis);
const infinite = (key, x) => (x === Infinity ? "Infinity" : x);
console.log(JSON.stringify(calls.map(([path, ...given]) => at(path)(...given)), infinite));
"""
CLOSE = {"rtol": 1e-12, "atol": 1e-12}


def node(*calls):
    """Return what functions of the pages return: each call is a name, as se3.exp6, and its arguments."""
    if shutil.which("node") is None:
        pytest.skip("node is not installed: the numbers of the pages are not asked for")
    files = [str(SCRIPTS / f"{name}.js") for name in ("se3", "hand", *NAMES)]
    plain = lambda x: x.tolist() if isinstance(x, np.ndarray) else x  # noqa: E731
    given = json.dumps({"files": files, "calls": [[plain(x) for x in call] for call in calls]})
    done = subprocess.run(["node", "-e", RUN], input=given, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture
def rng():
    return np.random.default_rng(2049)


# ---------------------------------------------------------------- the algebra


def test_the_algebra_of_the_page_is_the_package_s(rng):
    sizes = [0.0, 1e-9, 1e-4, 0.1999, 0.2001, 1.0, 3.1]  # on both sides of where the series end
    twists = rng.standard_normal((len(sizes), 6))
    twists[:, :3] *= (np.array(sizes) / np.linalg.norm(twists[:, :3], axis=1))[:, None]
    placements = [tw.exp6(V) for V in twists]
    got = node(*(("se3.exp6", V) for V in twists))
    for found, T in zip(got, placements, strict=True):
        np.testing.assert_allclose(found["R"], T.rotation, **CLOSE)
        np.testing.assert_allclose(found["p"], T.translation, **CLOSE)
    V, T = twists[-1], placements[-1]
    R, p = T.rotation, T.translation
    matrices = node(
        ("se3.exp3", V[:3]), ("se3.motionTransform", R, p), ("se3.forceTransform", R, p), ("se3.crossMotion", V),
        ("se3.crossForce", V), ("se3.hat", V), ("se3.skew", V[:3]),
    )  # fmt: skip
    wanted = (
        tw.exp3(V[:3]), tw.motion_transform(R, p), tw.force_transform(R, p), tw.cross_motion(V), tw.cross_force(V),
        tw.hat(V), tw.skew(V[:3]),
    )  # fmt: skip
    for found, matrix in zip(matrices, wanted, strict=True):
        np.testing.assert_allclose(found, matrix, **CLOSE)


def test_equations_are_solved_and_singular_ones_are_not(rng):
    A, b = rng.standard_normal((6, 6)), rng.standard_normal(6)
    A[0, 0] = 0  # the pivot is elsewhere
    np.testing.assert_allclose(node(("se3.solve", A, b))[0], np.linalg.solve(A, b), rtol=1e-10)  # condition number 40
    with pytest.raises(AssertionError, match="the matrix is singular"):
        node(("se3.solve", np.zeros((2, 2)), b[:2]))


def test_the_screw_of_a_twist(rng):
    V = rng.standard_normal(6)
    found, sliding = node(("se3.screw", V), ("se3.screw", [0, 0, 0, 0, 3, 0]))
    screw = tw.screw(V)
    for name in ("axis", "point", "pitch"):
        np.testing.assert_allclose(found[name], getattr(screw, name), **CLOSE)
    assert sliding == {"axis": [0, 1, 0], "point": [0, 0, 0], "pitch": "Infinity"}


def test_a_screw_makes_the_field_that_leads_back_to_it():
    axis, point = np.array([0.3, 0.0, 0.95]), np.array([0.4, -0.2, 0.0])
    (V,) = node(("hand.field.twist", axis, point, 0.6))
    (at_axis,) = node(("hand.field.velocity", V, point))
    assert np.isclose(tw.screw(V).pitch, np.tan(0.6), rtol=1e-12)
    np.testing.assert_allclose(at_axis, np.sin(0.6) * axis / np.linalg.norm(axis), **CLOSE)


# ---------------------------------------------------------------- two frames, and steps against exp


def test_two_frames_see_the_same_power_and_the_slip_does_not(rng):
    T = tw.exp6(rng.standard_normal(6))
    V, F = rng.standard_normal((2, 6))
    given = ({"R": T.rotation.tolist(), "p": T.translation.tolist()}, V, F)
    right, wrong = node(("hand.frames.carried", *given), ("hand.frames.carried", *given, True))
    X = T.inverse().motion_transform()
    np.testing.assert_allclose(right["X"], X, **CLOSE)
    np.testing.assert_allclose(right["Xstar"], np.linalg.inv(X).T, **CLOSE)
    assert np.isclose(right["powerThere"], F @ V, rtol=1e-12)
    assert not np.isclose(wrong["powerThere"], F @ V, rtol=1e-3)


def test_steps_approach_the_exponential():
    V = np.array([0.1, 0.2, 2.0, 0.3, 1.0, 0.4])
    coarse, fine = (
        np.array(T) for T in node(("hand.exponential.steps", V, 12, 12), ("hand.exponential.steps", V, 1200, 1200))
    )
    np.testing.assert_allclose(coarse, np.linalg.matrix_power(np.eye(4) + tw.hat(V) / 12, 12), **CLOSE)
    exact = tw.exp6(V).matrix()
    assert 80 < np.abs(coarse - exact).max() / np.abs(fine - exact).max() < 140  # of first order: about 100
    (parts,) = node(("hand.exponential.parts", coarse))
    assert np.isclose(parts["volume"], np.linalg.det(coarse[:3, :3]), rtol=1e-12)
    assert np.isclose(parts["skewed"], np.abs(coarse[:3, :3].T @ coarse[:3, :3] - np.eye(3)).max(), rtol=1e-12)


# ---------------------------------------------------------------- robots


@pytest.mark.parametrize("push", [(0.0, 0.0, 0.0), (30.0, -70.0, 0.0)])
def test_the_forces_on_the_feet_are_the_least_that_carry_the_push(push):
    model, robot = tw.load("go2"), handled.feet()
    q, at = model.standing(), np.array([0.0, 0.01, 0.31])
    (found,) = node(("hand.feet.carried", robot, push, at))
    rows = tw.contact_jacobian(model, q, model.feet)[:, :6].T  # of the base: moments about its origin, in its axes
    base = tw.frame_placement(model, q, "base").inverse() @ tw.SE3(np.eye(3), at)
    load = tw.gravity(model, q)[:6] - base.force_transform() @ [0, 0, 0, *push]
    wanted = np.linalg.lstsq(rows, load)[0].reshape(4, 3)
    np.testing.assert_allclose(found["forces"], wanted, rtol=1e-11, atol=1e-11 * robot["weight"])
    if not any(push):
        held = tw.static_equilibrium(model, q).forces
        np.testing.assert_allclose(found["forces"], held, rtol=1e-11, atol=1e-11 * robot["weight"])
    moment = sum(
        np.cross(np.subtract(p, found["pressure"]), f) for p, f in zip(robot["feet"], found["forces"], strict=True)
    )
    np.testing.assert_allclose(moment[:2], 0, atol=1e-11 * robot["weight"])  # none about a level axis


def test_how_far_a_point_is_inside_a_polygon():
    square = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]
    assert node(*(("hand.feet.inside", square, p) for p in ([1, 0.5, 0], [3, 1, 0]))) == [0.5, -1]


@pytest.mark.parametrize("free", [(True, True, True), (True, False, True), (False, False, False)])
def test_the_hand_feels_the_articulated_inertia(free):
    angles, chain = [0.4, -1.1, 0.8], tw.chain(3)
    turned = [-angle for angle in angles]  # the page counts towards +x, the chain turns about y
    (found,) = node(("hand.felt.apparent", handled.felt()["inertia"], angles, free))
    names = [name for name, one in zip(chain.joint_names[1:], free, strict=True) if not one]
    if len(names) == 3:
        IC = tw.crba_terms(chain, turned).IC[1]
        X = tw.forward_kinematics(chain, turned).placement[1].inverse().motion_transform()
        np.testing.assert_allclose(found, X.T @ IC @ X, rtol=1e-12, atol=1e-12)
        return
    model = tw.lock_joints(chain, names, turned).model if names else chain
    q = [x for x, one in zip(turned, free, strict=True) if one]
    terms = tw.aba_terms(model, q, np.zeros(model.nv), np.zeros(model.nv))
    X = tw.forward_kinematics(model, q).placement[1].inverse().motion_transform()
    np.testing.assert_allclose(found, X.T @ terms.Ia[1] @ X, rtol=1e-12, atol=1e-12)


def single(inertia):
    return tw.Builder("body", base="floating", root_inertia=inertia).build()


def test_the_tumbling_body_keeps_what_it_has_to_keep():
    I, spin = np.array([0.4, 1.0, 1.3]), np.array([3.0, 0.1, 0.05])
    body = single(tw.SpatialInertia(12, [0, 0, 0], np.diag(I)))
    rate, course = node(("hand.tumbling.rate", I * spin, I), ("hand.tumbling.course", I, spin, 24, 720))
    model_rate = tw.aba(body, body.neutral(), np.r_[spin, 0, 0, 0], np.zeros(6))[:3]
    np.testing.assert_allclose(np.array(rate) / I, model_rate, **CLOSE)
    L, R = (np.array([step[name] for step in course]) for name in "LR")
    np.testing.assert_allclose(
        (R @ L[:, :, None])[..., 0], np.broadcast_to(I * spin, L.shape), atol=1e-5
    )  # 24 s of steps
    energy = (L**2 / I).sum(1) / 2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8)


def test_the_film_ends_at_the_base_with_all_the_weight_or_with_nothing():
    film, model = handled.film(), tw.load("go2")
    held, standing = film["F"]
    ground = np.sum([force for _, force in film["feet"]], axis=0)
    np.testing.assert_allclose(standing[1], 0, atol=1e-3)
    np.testing.assert_allclose(held[1][3:], ground, atol=3e-3)  # the base is level; rounded to 1e-3 N
    assert held[1][5] > 0.99 * model.mass * 9.81
    for i in range(2, model.nbodies):  # the hinge's part of the wrench is its torque
        S = model.joints[i].subspace()[:, 0]
        assert all(np.isclose(S @ F[i], tau[i - 2], atol=1e-2) for F, tau in zip(film["F"], film["tau"], strict=True))
    (steps,) = node(("hand.film.steps", model.nbodies))
    assert [s["body"] for s in steps] == [*range(1, 14), *range(13, 0, -1)]


# ---------------------------------------------------------------- translate my numbers


def state(rng):
    q = np.r_[rng.standard_normal(7), 0.4, -0.9]
    q[3:7] /= np.linalg.norm(q[3:7])
    return {"q": q} | dict(zip(("v", "a", "tau"), rng.standard_normal((3, 8)), strict=True))


def as_theirs(given, side):
    """The state as a library has it, by docs/conventions.md."""
    q, v, a, tau = (given[name] for name in ("q", "v", "a", "tau"))
    R = _rotation(q[3:7])
    if side == "twistwrench":
        return given
    B = np.eye(8)
    if side == "pinocchio":
        B[:6, :6] = np.roll(np.eye(6), 3, axis=0)
    elif side == "mujoco":
        B[:6, :6] = np.block([[np.zeros((3, 3)), R], [np.eye(3), np.zeros((3, 3))]])
    elif side == "drake":
        B[:3, :3] = B[3:6, 3:6] = R
    bend = np.r_[0, 0, 0, np.cross(v[:3], v[3:6]), 0, 0] if side in ("mujoco", "drake") else 0
    order = {"drake": [6, 3, 4, 5, 0, 1, 2, 7, 8], "pinocchio": [*range(9)]}.get(side, [0, 1, 2, 6, 3, 4, 5, 7, 8])
    return {"q": q[order], "v": B @ v, "a": B @ (a + bend), "tau": B @ tau}


def _rotation(quaternion):
    x, y, z, w = quaternion
    return np.eye(3) + 2 * w * tw.skew([x, y, z]) + 2 * tw.skew([x, y, z]) @ tw.skew([x, y, z])


SIDES = ("chapter", "twistwrench", "pinocchio", "mujoco", "drake")


def test_numbers_are_translated_as_the_conventions_say_and_back(rng):
    given = state(rng)
    theirs = {side: as_theirs(given, side) for side in SIDES}
    plain = {side: {name: x.tolist() for name, x in one.items()} for side, one in theirs.items()}
    pairs = [(a, b) for a in SIDES for b in SIDES]
    for (a, b), found in zip(pairs, node(*(("hand.translate.state", plain[a], a, b) for a, b in pairs)), strict=True):
        for name, x in theirs[b].items():
            np.testing.assert_allclose(found[name], x, rtol=1e-12, atol=1e-13, err_msg=f"{name}, {a} to {b}")


def test_the_translation_is_the_bridge_s(rng):
    body = tw.SpatialInertia(1, [0, 0, 0], np.eye(3))
    model = single(body)
    q, v = (state(rng)[name][: model.nq if name == "q" else model.nv] for name in ("q", "v"))
    given = {"q": q.tolist(), "v": v.tolist()}
    pinocchio, mujoco = node(*(("hand.translate.state", given, "twistwrench", to) for to in ("pinocchio", "mujoco")))
    assert pinocchio["v"] == tw.bridge.to_pinocchio_tangent(model, v).tolist()
    assert pinocchio["q"] == given["q"]
    np.testing.assert_allclose(mujoco["q"], tw.bridge.to_mujoco_configuration(model, q), **CLOSE)
    np.testing.assert_allclose(mujoco["v"], tw.bridge.to_mujoco_tangent(model, q, v), **CLOSE)


# ---------------------------------------------------------------- words


@pytest.mark.parametrize("name", NAMES)
def test_both_languages_have_every_word_that_the_page_uses(name):
    said = tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    script = (SCRIPTS / f"{name}.js").read_text(encoding="utf-8")
    for text in [said[key] for key in ("title", "card", "intro", "try")] + list(said["words"].values()):
        assert set(text) == {"en", "zh"}
        assert not re.search("[\u4e00-\u9fff]", text["en"])
    assert all(re.search("[\u4e00-\u9fff]", said[key]["zh"]) for key in ("title", "card", "intro", "try"))
    assert said["intro"]["en"].count("](") == said["intro"]["zh"].count("](")
    assert said["try"]["en"].count("\n- ") == said["try"]["zh"].count("\n- ")
    used = set(re.findall(r"words\.(\w+)", script)) - {"play", "pause", "stop", "comma"}
    assert used <= set(said["words"])
    computed = set(re.findall(r'"(\w+)"', script)) | set(re.findall(r"\b(\w+)_\$\{", script))
    assert not {w for w in said["words"] if w not in used | computed and w.split("_")[0] not in ("q", "v", "says")}


@pytest.mark.parametrize("name", NAMES)
def test_each_object_has_a_drawing_that_says_nothing_to_a_reader_of_screens(name):
    drawing = (FOLDER / f"{name}.svg").read_text(encoding="utf-8")
    assert 'aria-hidden="true"' in drawing
    assert not re.search(r"<title|<text|<script|href", drawing)
    assert not re.search('"(black|white|#000|#fff)', drawing)  # it is seen in the dark, too

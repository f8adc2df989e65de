"""Programs compute what the textbook computes, whatever runs them."""

import pickle
import sys
from concurrent.futures import ThreadPoolExecutor

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from straightline import DoubleDouble
from straightline.llvm import available
from twistwrench import compile
from twistwrench.fast.quantities import SYMBOLS

from ..sampling import sampled
from ..strategies import random_state
from .test_quantities import TOOLBOX

BACKENDS = [
    pytest.param("llvm", marks=pytest.mark.skipif(not available(), reason="llvmlite is not installed")),
    "numpy",
]
MODELS = [
    tw.load("go2"),
    tw.load("cart_pole"),
    *(tw.random_tree(7, rng=seed, base=base) for seed in (1, 5) for base in ("fixed", "floating")),
]
FRAMED = ("frame_placement", "frame_jacobian", "frame_bias_acceleration")


def textbook(model, name, args, frame):
    if name == "contact_jacobian":
        return tw.contact_jacobian(model, *args, [frame])
    if name in FRAMED:
        one = getattr(tw, name)(model, *args, frame)
        return (one.matrix() if name == "frame_placement" else one)[
            ..., None, *([slice(None)] * (1 + (name != FRAMED[2])))
        ]
    return getattr(tw, name)(model, *args)


@pytest.mark.one_case
@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("model", sampled(MODELS, 1), ids=lambda model: f"{model.name} {model.base} {model.nv}")
def test_every_quantity_is_the_textbooks(model, backend):
    frame = model.frame_names[-1]
    chapter = {name: symbol for name, symbol in SYMBOLS.items() if symbol not in TOOLBOX}
    program = compile(model, chapter, contacts=[frame], frames=[frame], backend=backend)
    one, many = random_state(model, rng=0), random_state(model, rng=1, batch=(3, 11))
    for state in (one, many):
        got = program(**state._asdict())
        for name, symbol in chapter.items():
            arguments = compile(model, name, contacts=[frame], frames=[frame]).arguments
            expected = textbook(model, name, [getattr(state, argument) for argument in arguments], frame)
            size = max(1.0, np.abs(expected).max(initial=0))
            shape = (*state.q.shape[:-1], *expected.shape) if name == "selection_matrix" else expected.shape
            assert getattr(got, symbol).shape == shape, name
            np.testing.assert_allclose(
                getattr(got, symbol), np.broadcast_to(expected, shape), rtol=0, atol=1e-12 * size, err_msg=name
            )


def test_a_program_pickles():
    model = tw.load("go2")
    program = pickle.loads(pickle.dumps(tw.compile(model, ["M", "J_c"], contacts=["FL_foot"], dtype=np.float32)))
    result = program(model.standing().astype(np.float32))
    assert result.M.dtype == np.float32
    np.testing.assert_allclose(result.J_c, tw.contact_jacobian(model, model.standing(), ["FL_foot"]), atol=1e-6)


@pytest.mark.slow
def test_threads_give_the_same_numbers():
    model = tw.load("go2")
    s = random_state(model, rng=0, batch=(7, 100))
    one, two = (tw.compile(model, "aba", threads=n)(s.q, s.v, s.tau, s.f_ext) for n in (1, 3))
    assert np.array_equal(one, two)


@pytest.mark.slow
def test_a_program_is_called_by_several_threads_at_once():
    """That change after every few instructions, from before the program has its first code."""
    model = tw.load("cart_pole")
    s = random_state(model, rng=0, batch=(400,))
    expected = tw.rnea(model, s.q, s.v, s.a)
    usual = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        for _ in range(5):
            program = tw.compile(model, "rnea")

            def call(k, program=program):
                return program(s.q[k % 400], s.v[k % 400], s.a[k % 400])

            with ThreadPoolExecutor(4) as pool:
                got = list(pool.map(call, range(2000)))
            np.testing.assert_allclose(got, np.tile(expected, (5, 1)), rtol=0, atol=1e-12 * np.abs(expected).max())
    finally:
        sys.setswitchinterval(usual)


@pytest.mark.one_case
@pytest.mark.parametrize("backend", BACKENDS)
def test_what_is_given_need_not_be_computed_with(backend):
    model = tw.load("go2")
    rest, q = np.zeros(model.nv), random_state(model, rng=0).q
    held = tw.compile(model, "rnea", given={"v": rest, "a": rest}, backend=backend)
    assert held.arguments == ("q", "f_ext")
    assert held.operations.total() < tw.compile(model, "rnea").operations.total() / 3
    np.testing.assert_allclose(held(q), tw.gravity(model, q), atol=1e-11)
    v = random_state(model, rng=0, batch=(30,)).v
    there = compile(model, ["M", "h"], given={"q": q}, backend=backend)
    np.testing.assert_allclose(there(v).h, tw.nonlinear_effects(model, q, v), rtol=0, atol=1e-11)
    np.testing.assert_allclose(there(v[0]).M, tw.crba(model, q), rtol=0, atol=1e-12)


@pytest.mark.one_case
@pytest.mark.parametrize("backend", BACKENDS)
def test_a_state_that_is_wrong_is_named_as_by_the_textbook(backend):
    model = tw.load("go2")
    s = random_state(model, rng=0, batch=(30,))
    program = tw.compile(model, "rnea", backend=backend)
    for spoil, message in (
        (lambda q, v: v.__setitem__((7, 3), np.nan), r"v: expected finite numbers, got nan at index \(7, 3\)"),
        (lambda q, v: v.__setitem__((7, 3), np.inf), r"v: expected finite numbers, got inf at index \(7, 3\)"),
        (lambda q, v: q.__setitem__((7, 3), 2), r"joint 'root_joint': the quaternion q\[3:7\] has norm"),
        (lambda q, v: v.__setitem__((7, 3), 1e80), r"v: expected at most"),
    ):
        q, v = s.q.copy(), s.v.copy()
        spoil(q, v)
        for states in ((q, v, s.a), (q[7], v[7], s.a[7])):
            with pytest.raises(ValueError, match=message.replace(r"\(7, 3\)", r".*3,?\)")):
                program(*states)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_large_angle_is_right(backend):
    model = tw.load("double_pendulum")
    q = np.array([1e6 + 0.3, -3e5])
    np.testing.assert_allclose(tw.compile(model, "M", backend=backend)(q), tw.crba(model, q), atol=1e-13)


def test_arguments_are_taken_as_the_textbook_takes_them():
    model = tw.load("cart_pole")
    program, q, v = compile(model, "rnea"), [0.5, 1], np.ones((3, 1, 2), np.float32)
    a = np.arange(8).reshape(4, 2)
    np.testing.assert_allclose(program(q, v, a), tw.rnea(model, q, v, a), atol=1e-12)
    np.testing.assert_allclose(program(a=a, q=q, v=v), tw.rnea(model, q, v, a), atol=1e-12)
    flipped = np.arange(24.0).reshape(2, 12)[:, ::-2].T  # strides of every kind
    np.testing.assert_allclose(
        program(flipped, flipped, flipped), tw.rnea(model, flipped, flipped, flipped), rtol=1e-12
    )
    for args, named, message in (
        ((q, v), {}, "expected q, v, a, f_ext: a missing"),
        ((q, v, a, None, None), {}, "got 5 arguments"),
        ((q, v, a), {"q": q}, "got 'q' twice"),
        ((q, v, a), {"w": q}, "got 'w'"),
    ):
        with pytest.raises(TypeError, match=message):
            program(*args, **named)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("want", ["rnea", "qdd", "M", "dg_dq", "Y", ("h", "dh_dv")], ids=str)
def test_numbers_that_a_program_cannot_hold_are_refused_by_name(want, backend):
    model = tw.load("double_pendulum")
    program = compile(model, want, backend=backend)
    plain = {name: np.array([0.1, 0.2]) for name in program.arguments if name != "f_ext"}
    for name, x in plain.items():
        for wrong in (x + 1e-30j, [0.1, 0.2j], np.stack([x, x]).astype(np.complex64)):
            with pytest.raises(ValueError, match=rf"^{name}: expected real numbers, got complex"):
                program(**plain | {name: wrong})
        with pytest.raises(TypeError, match=rf"^{name}: expected an array, got a DoubleDouble"):
            program(**plain | {name: DoubleDouble(x, 0 * x)})


def test_a_wrench_that_a_program_cannot_hold_is_refused_too():
    model = tw.load("double_pendulum")
    wrench = np.zeros((model.nbodies, 6))
    with pytest.raises(ValueError, match=r"^f_ext: expected real numbers, got complex128"):
        compile(model, "rnea")([0, 0], [0, 0], [0, 0], wrench + 0j)
    with pytest.raises(ValueError, match=r"^given\['v'\]: expected real numbers, got complex128"):
        compile(model, "h", given={"v": [0, 1j]})


@pytest.mark.skipif(np.finfo(np.longdouble).eps == np.finfo(float).eps, reason="long doubles are doubles here")
@pytest.mark.parametrize(
    "options", [{}, {"dtype": np.float32}, {"dtype": complex}, {"bound": True}, {"backend": "numpy"}], ids=str
)
def test_long_doubles_are_refused_by_programs_that_would_round_them(options):
    program = compile(tw.load("double_pendulum"), "gravity", **options)
    with pytest.raises(ValueError, match=r"^q: expected numbers that .* holds, got .*tw.compile"):
        program(np.array([1, 2], np.longdouble) / 3)


def test_narrower_numbers_are_taken_and_doubles_are_rounded_where_asked():
    model, q = tw.load("double_pendulum"), np.array([0.1, 0.2])
    right = tw.gravity(model, q.astype(np.float32).astype(float))
    double, single = (compile(model, "gravity", dtype=dtype) for dtype in (float, np.float32))
    np.testing.assert_allclose(double(q.astype(np.float32)), right, rtol=1e-15)
    np.testing.assert_array_equal(single(q), single(q.astype(np.float32)))
    np.testing.assert_array_equal(double([1, 2]), double([1.0, 2.0]))


@pytest.mark.skipif(not available(), reason="llvmlite is not installed")
@pytest.mark.parametrize("number", [np.float64, np.float32])
def test_sine_and_cosine_are_within_a_rounding(number):
    """Of the frame of a pendulum's bob the rotation is (cos, sin) untouched."""
    program = compile(tw.load("pendulum"), "placement", frames=["bob"], dtype=number)
    some = np.random.default_rng(0).uniform(-100, 100, 500)
    x = np.concatenate([some, [0, 1e-8, np.pi / 2, np.pi, 1e5], np.linspace(-9, 9, 500)]).astype(number)
    R = program(x[:, None])[:, 0]
    exact = [(mpmath.cos(float(angle)), mpmath.sin(float(angle))) for angle in x]
    errors = [(float(R[k, 0, 0]) - cos, abs(float(R[k, 0, 2])) - abs(sin)) for k, (cos, sin) in enumerate(exact)]
    assert max(abs(float(error)) for pair in errors for error in pair) < 0.6 * np.finfo(number).eps


def test_a_scene_is_compiled_with_its_contacts_and_wrenches():
    soles = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), mu=0.7) for side in ("left", "right")]
    push = {"left_sole": [1.0, 2, 3, 40, 50, 60]}
    scene = tw.Scene("humanoid", contacts=soles, hold=["*_shoulder_*", "*_elbow"], wrenches=push)
    model, s = scene.model, random_state(scene.model, rng=0)
    f_ext = scene.f_ext(s.q)
    program = compile(scene, ["tau", "h", "g", "J_c", "M", "dg_dq"])
    got = program(s.q, s.v, s.a)
    expected = scene.dynamics(s.q, s.v)
    tau = tw.rnea(model, s.q, s.v, s.a, f_ext)
    h, g = tw.rnea(model, s.q, s.v, 0 * s.v, f_ext), tw.rnea(model, s.q, 0 * s.v, 0 * s.v, f_ext)
    for x, y in ((got.tau, tau), (got.h, h), (got.g, g), (got.J_c, expected.J_c), (got.M, expected.M)):
        np.testing.assert_allclose(x, y, rtol=0, atol=1e-12 * np.abs(y).max())
    step = 1e-6 * s.a
    change = (tw.rnea(model, q := model.integrate(s.q, step), 0 * s.v, 0 * s.v, scene.f_ext(q)) - g) / 1e-6
    np.testing.assert_allclose(got.dg_dq @ s.a, change, rtol=0, atol=1e-3 * np.abs(change).max())
    assert pickle.loads(pickle.dumps(program)).operations == program.operations
    with pytest.raises(ValueError, match="contacts: a scene has its own"):
        compile(scene, "J_c", contacts=["left_sole"])


def test_a_scene_without_contacts_falls_with_its_wrenches():
    scene = tw.Scene("panda", wrenches={"panda_hand": [1.0, 2, 3, 40, 50, 60]})
    s = random_state(scene.model, rng=0)
    expected = tw.aba(scene.model, s.q, s.v, s.tau, scene.f_ext(s.q))
    found = compile(scene, "qdd")(s.q, s.v, s.tau)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_the_articulated_inertia_of_a_scene_with_contacts_is_refused_by_name():
    """It is the free robot's. A standing Go2 fell freely by a program of q̈, at 9.81 m/s²: now its feet hold it."""
    go2 = tw.load("go2")
    scene = tw.Scene(go2, contacts=[tw.PointContact(foot, mu=0.7) for foot in go2.feet])
    q, rest = go2.standing(), np.zeros(go2.nv)
    for want in ("articulated_inertia", "dIA_dq", ("M", "IA")):
        with pytest.raises(ValueError, match=r"^d?IA(_d\w+)?: expected a scene without contacts"):
            compile(scene, want, frames=["base"])
    sinks = compile(scene, "aba", backend="numpy")(q, rest, rest)
    np.testing.assert_allclose(sinks[5], -9.920142251371, rtol=0, atol=1e-9)
    held = compile(scene, ("M", "h", "J_c", "Lambda", "M_inv"), backend="numpy")(q, rest)
    np.testing.assert_allclose(held.M, tw.crba(go2, q), rtol=0, atol=1e-12)
    np.testing.assert_allclose(held.J_c, tw.contact_jacobian(go2, q, go2.feet), rtol=0, atol=1e-12)
    free = compile(scene.model, "qdd", backend="numpy")(q, rest, rest)
    np.testing.assert_allclose(free, tw.aba(go2, q, rest, rest), rtol=0, atol=1e-10)

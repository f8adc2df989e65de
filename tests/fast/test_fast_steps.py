"""Steps and differences as programs: 50 digits, Pinocchio, the textbook, and the laws between them."""

import mpmath
import numpy as np
import pytest
from hypothesis import given

import twistwrench as tw
from straightline import llvm
from twistwrench import bridge, fast
from twistwrench import newton_euler_3d as slow
from twistwrench.fast import programs, steps
from twistwrench.model import KINDS, Joint
from twistwrench.newton_euler_3d.bodies import cross
from twistwrench.validate import manifold

from ..strategies import BATCHES, Recipe, examples, recipes

PI = np.pi
SIZES = [0.0, 1e-300, 1e-160, 1e-8, 1e-4, 0.9999, 1.0001, PI - 1e-9, PI, PI + 1e-9, 2 * PI - 1e-9, 2 * PI, 20.0]
"""Of the steps: on both sides of wherever the textbook's formulas change."""

KIND = pytest.mark.parametrize("kind", KINDS)
EPS = np.finfo(float).eps
CALLS = {
    "integrate": lambda package, m, q, q1, v, u: package(m).integrate(q, v),
    "difference": lambda package, m, q, q1, v, u: package(m).difference(q, q1),
    "d_integrate": lambda package, m, q, q1, v, u: np.stack(package(m).d_integrate(q, v)),
    "d_difference": lambda package, m, q, q1, v, u: np.stack(package(m).d_difference(q, q1)),
    "interpolate": lambda package, m, q, q1, v, u: package(m).interpolate(q, q1, u),
}
EACH = pytest.mark.parametrize("name", CALLS)


class Fast:
    """The functions of `fast` as the methods of a model."""

    def __init__(self, model):
        self.model = model

    def __getattr__(self, name):
        return lambda *arguments, **options: getattr(fast, name)(self.model, *arguments, **options)


def textbook(model):
    return model


def tree(kind, n=3):
    return tw.random_tree(n, rng=7, kinds=(kind,), base="floating" if kind == "free_flyer" else "fixed")


def unit_turns(model, v):
    """Scale each joint's part of v so that it turns by 1 rad."""
    v = v.copy()
    for joint, s in zip(model.joints, model.v_slice):
        if joint and joint.unit is not None:
            v[..., s] /= np.linalg.norm(np.matvec(joint.subspace()[:3], v[..., s]), axis=-1, keepdims=True)
    return v


def cases(model, seed=1):
    """Return configurations, a step of each size from them, and where it leads, with quaternions of both signs."""
    rng = np.random.default_rng(seed)
    q = np.stack([model.random_configuration(rng=rng) for _ in SIZES])
    v = np.array(SIZES)[:, None] * unit_turns(model, rng.standard_normal((len(SIZES), model.nv)))
    q1 = model.integrate(q, v)
    for joint, s in zip(model.joints, model.q_slice):
        if joint and joint.unit == slice(joint.nq - 4, joint.nq):
            q1[::2, s][:, joint.unit] *= -1
    return q, q1, v


def states(model, batch, dtype=np.float64, seed=3):
    rng = np.random.default_rng(seed)
    count = int(np.prod(batch, dtype=int))
    q, q1 = (
        np.reshape([model.random_configuration(rng=rng) for _ in range(count)], (*batch, model.nq)) for _ in range(2)
    )
    q, q1 = (model.normalize(x.astype(dtype)) for x in (q, q1))
    return q, q1, rng.standard_normal((*batch, model.nv)).astype(dtype), rng.random(batch).astype(dtype)


@pytest.fixture
def without_textbook(monkeypatch):
    """Let nothing be left to the textbook."""

    def none(*arguments):
        raise AssertionError("the textbook was asked")

    for symbol, (_, formula) in steps.TEXTBOOK.items():
        monkeypatch.setitem(steps.TEXTBOOK, symbol, (none, formula))


# ---------------------------------------------------------------- 50 digits


@KIND
def test_a_step_of_any_size_is_right_to_fifty_digits(kind, without_textbook):
    model = tree(kind)
    q, _, v = cases(model)
    with mpmath.workdps(50):
        for one, step in zip(q, v):
            there = manifold.integrate(model, slow.as_mpmath(one), slow.as_mpmath(step))
            ours = fast.integrate(model, one, step)
            off = [turned_back(joint, ours[s] - there[s], ours[s] + there[s]) for joint, s in parts(model)]
            assert max(map(abs, np.concatenate(off))) < 3 * EPS * max(1, *abs(step), *abs(one))


def parts(model):
    return [(joint, s) for joint, s in zip(model.joints, model.q_slice) if joint]


def turned_back(joint, difference, total):
    """Return how far a q is off where a quaternion may have either sign."""
    if joint.unit == slice(joint.nq - 4, joint.nq) and abs(difference[-4:]).max() > 1:
        difference[-4:] = total[-4:]
    return difference


@KIND
def test_a_difference_of_any_size_is_right_to_fifty_digits(kind, without_textbook):
    model = tree(kind)
    for q0, q1, _ in zip(*cases(model)):
        ours = fast.difference(model, q0, q1)
        with mpmath.workdps(60):
            for joint, s, at in zip(model.joints, model.v_slice, model.q_slice):
                if joint:
                    way = between(joint, slow.as_mpmath(q0[at]), slow.as_mpmath(q1[at]))
                    off = min(abs(ours[s] - one).max() for one in way)
                    assert off < 6 * EPS * max(abs(way[0]).max(), 1e-300), (joint, float(off))


def between(joint, q0, q1):
    """Yield S⁺ log(T₀⁻¹ T₁) in mpmath's numbers, the second time with the other sign of half a turn."""
    mp = q0[0].context
    if joint.unit is None:
        return [q1 - q0]
    a, b = q0[joint.unit], q1[joint.unit]
    if len(a) == 2:
        angle = mp.atan2(a[0] * b[1] - a[1] * b[0], a @ b)
        ways = [np.array([mp.mpf(0), mp.mpf(0), angle - turn]) for turn in (0, 2 * mp.pi * mp.sign(angle))]
    else:
        u = a[3] * b[:3] - b[3] * a[:3] - cross(a[:3], b[:3])
        n, cosine = mp.sqrt(u @ u), a @ b
        angle = 2 * mp.atan2(n, cosine)
        ways = [u * ((angle - turn) / n if n else mp.mpf(0)) for turn in (0, 2 * mp.pi)]
    ways.sort(key=lambda w: w @ w)
    ways = ways[: 2 if ways[1] @ ways[1] < (mp.pi + 1e-14) ** 2 else 1]  # near half a turn rounding decides
    if joint.kind == "continuous":
        return [w[2:] for w in ways]
    if joint.kind == "spherical":
        return ways
    placed = joint.nq - len(a)
    p = np.array([*(q1[:placed] - q0[:placed]), *[mp.mpf(0)] * (3 - placed)])
    quaternion = a if len(a) == 4 else np.array([mp.mpf(0), mp.mpf(0), *half_angle(a)])
    p = manifold._rotate(np.array([*-quaternion[:3], quaternion[3]]), p)
    twists = []
    for w in ways:
        square = w @ w
        D = (1 - mp.sqrt(square) / 2 * mp.cot(mp.sqrt(square) / 2)) / square if square else mp.mpf(1) / 12
        v = p - cross(w, p) / 2 + D * cross(w, cross(w, p))
        twists.append(np.array([v[0], v[1], w[2]]) if joint.kind == "planar" else np.array([*w, *v]))
    return twists


def half_angle(cs):
    """Return sine and cosine of half an angle."""
    mp = cs[0].context
    half = mp.atan2(cs[1], cs[0]) / 2
    return mp.sin(half), mp.cos(half)


# ---------------------------------------------------------------- laws


@given(recipes(5))
@examples(2)
def test_the_laws_hold_for_every_joint(recipe):
    model = recipe.model
    q, q1, v, _ = states(model, (12,))
    v = v / 2
    there = fast.integrate(model, q, v)
    np.testing.assert_allclose(fast.difference(model, q, there), v, rtol=0, atol=1e-13)
    way = fast.difference(model, q, q1)
    same_place(model, fast.integrate(model, q, way), q1)
    J_q, J_v = fast.d_integrate(model, q, v)
    J_0, J_1 = fast.d_difference(model, q, there)
    one = np.broadcast_to(np.eye(model.nv), J_q.shape)
    np.testing.assert_allclose(J_1 @ J_v, one, rtol=0, atol=1e-12)
    np.testing.assert_allclose(J_0 + J_1 @ J_q, 0 * one, rtol=0, atol=1e-12)
    same_place(model, fast.interpolate(model, q, q1, 1.0), q1)
    np.testing.assert_allclose(fast.interpolate(model, q, q1, 0.0), q, rtol=0, atol=1e-14)
    third = fast.interpolate(model, q, q1, 1 / 3)
    np.testing.assert_allclose(fast.difference(model, q, third), way / 3, rtol=0, atol=1e-12)


def same_place(model, q, q1):
    assert np.abs(model.difference(q, q1)).max() < 1e-13 * max(1, np.abs(q1).max())


@KIND
def test_a_complex_step_gives_the_derivatives_at_any_angle(kind, without_textbook):
    model, h = tree(kind, 1), 1e-30
    for q0, q1, v in zip(*cases(model)):
        J_q, J_v = fast.d_integrate(model, q0, v)
        end = model.integrate(q0, v)
        size = max(1, np.abs(v).max())
        for k, dv in enumerate(1j * h * np.eye(model.nv)):
            for J, moved in (
                (J_q, model.integrate(model.integrate(q0, dv), v)),
                (J_v, model.integrate(q0, v + dv)),
            ):
                np.testing.assert_allclose(J[:, k], model.difference(end, moved).imag / h, rtol=0, atol=2e-14 * size)
        if PI - 1e-6 < np.linalg.norm(v) < PI + 1e-6:
            continue  # half a turn, where the difference jumps
        J_0, J_1 = fast.d_difference(model, q0, q1)
        for k, dv in enumerate(1j * h * np.eye(model.nv)):
            for J, moved in (
                (J_0, model.difference(model.integrate(q0, dv), q1)),
                (J_1, model.difference(q0, model.integrate(q1, dv))),
            ):
                np.testing.assert_allclose(J[:, k], moved.imag / h, rtol=0, atol=1e-13 * size)


# ---------------------------------------------------------------- Pinocchio


@KIND
def test_they_are_pinocchios(kind):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model = tree(kind)
    there = bridge.to_pinocchio_model(model)
    to = bridge.to_pinocchio_tangent(model, np.eye(model.nv)).mT  # from our v to theirs, a permutation
    q, q1, v, _ = states(model, (12,))
    for one, other, step in zip(q, q1, v):
        ours = fast.integrate(model, one, step)
        theirs = pin.integrate(there, one, to @ step)
        assert np.abs(model.difference(ours, theirs)).max() < 1e-13
        way = to.mT @ pin.difference(there, one, other)
        np.testing.assert_allclose(fast.difference(model, one, other), way, rtol=0, atol=1e-12)
        for J, expected in zip(fast.d_integrate(model, one, step), pin.dIntegrate(there, one, to @ step)):
            np.testing.assert_allclose(J, to.mT @ expected @ to, rtol=0, atol=1e-12)
        for J, expected in zip(fast.d_difference(model, one, other), pin.dDifference(there, one, other)):
            np.testing.assert_allclose(J, to.mT @ expected @ to, rtol=0, atol=1e-11)
        middle = pin.interpolate(there, one, other, 0.3)
        assert np.abs(model.difference(fast.interpolate(model, one, other, 0.3), middle)).max() < 1e-12


# ---------------------------------------------------------------- the textbook


def same(ours, book, digits=100):
    assert (ours.shape, ours.dtype) == (book.shape, book.dtype)
    size = np.abs(book).max(initial=1)
    np.testing.assert_allclose(ours, book, rtol=0, atol=digits * np.finfo(book.dtype).eps * size)


@EACH
@pytest.mark.parametrize("batch", [*BATCHES, (40,)], ids=str)
def test_batches_are_kept(name, batch):
    model = Recipe(7, 129, "floating").model
    arguments = states(model, batch)
    same(CALLS[name](Fast, model, *arguments), CALLS[name](textbook, model, *arguments))


@EACH
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble])
@pytest.mark.parametrize("batch", [(), (40,)], ids=str)
def test_number_types_are_kept(name, dtype, batch, without_textbook):
    model = Recipe(7, 129, "floating").model
    arguments = states(model, batch, dtype)
    same(CALLS[name](Fast, model, *arguments), CALLS[name](textbook, model, *arguments))


@EACH
def test_complex_numbers_are_the_textbooks(name):
    model = Recipe(7, 129, "floating").model
    q, q1, v, u = (x.astype(complex) for x in states(model, (3,)))
    q1 = model.integrate(q1, 1e-20j * v)
    np.testing.assert_array_equal(CALLS[name](Fast, model, q, q1, v, u), CALLS[name](textbook, model, q, q1, v, u))


@EACH
@pytest.mark.parametrize("batch", [(), (40,)], ids=str)
def test_without_machine_code_the_results_are_the_same(name, batch, monkeypatch, without_textbook):
    monkeypatch.setattr(llvm, "available", lambda: False)
    model = tw.random_tree(7, rng=129, base="floating")  # which remembers no program
    arguments = states(model, batch)
    same(CALLS[name](Fast, model, *arguments), CALLS[name](textbook, model, *arguments))


def test_number_types_and_batch_axes_are_brought_together_as_in_the_textbook():
    model = Recipe(7, 129, "floating").model
    q, q1, v, _ = states(model, (4,), np.float32)
    for u in (0.25, 1, np.float32(0.5), np.linspace(0, 1, 4, dtype=np.float32), [[0.5], [1.0]]):
        same(fast.interpolate(model, q, q1, u), model.interpolate(q, q1, u))
    same(fast.integrate(model, q[0], v.astype(float)), model.integrate(q[0], v.astype(float)))
    same(fast.integrate(model, q[0], [0] * model.nv), model.integrate(q[0], [0] * model.nv))


@pytest.mark.parametrize("batch", [(), (3,), (20,)], ids=str)
@pytest.mark.parametrize("dtype", [np.float64, np.complex128])
def test_out_is_filled_and_returned(batch, dtype):
    model = Recipe(7, 129, "floating").model
    q, q1, v, u = states(model, batch, dtype)
    for name, *arguments in (("integrate", q, v), ("difference", q, q1), ("interpolate", q, q1, u)):
        expected = getattr(fast, name)(model, *arguments)
        out = np.full(expected.shape, np.nan, dtype)
        assert getattr(fast, name)(model, *arguments, out=out) is out
        np.testing.assert_array_equal(out, expected)


GO2 = tw.load("go2")
Q, V = GO2.standing(), np.zeros(18)
BAD = np.where(np.arange(19) == 6, 1.1, Q)
WRONG = {
    "a NaN": ("integrate", np.where(np.arange(19) == 8, np.nan, Q), V),
    "a quaternion off norm 1": ("integrate", BAD, V),
    "v for q": ("integrate", V, V),
    "q for v": ("integrate", Q, Q),
    "a step too large": ("integrate", Q, np.full(18, 1e62)),
    "an angle too large": ("d_integrate", Q, np.full(18, 1e300)),
    "batches that do not fit": ("integrate", np.tile(Q, (3, 1)), np.tile(V, (2, 1))),
    "q0 off norm 1": ("difference", BAD, Q),
    "q1 off norm 1": ("difference", Q, BAD),
    "q1 off norm 1 in a batch": ("d_difference", Q, np.stack([Q, Q, BAD])),
    "v for q1": ("interpolate", Q, V, 0.5),
    "a u that is none": ("interpolate", Q, Q, "half"),
    "a u that is not finite": ("interpolate", Q, Q, np.inf),
    "a u that does not fit": ("interpolate", np.tile(Q, (3, 1)), Q, [0.0, 1.0]),
    "a u too large": ("interpolate", Q, np.where(np.arange(19) == 8, 0.5, Q), 1e65),
    "a way too long": ("interpolate", Q, np.where(np.arange(19) < 1, 1e40, Q), 1e40),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_what_the_textbook_refuses_is_refused_in_the_same_words(wrong):
    name, *arguments = WRONG[wrong]
    with pytest.raises(ValueError) as book:  # noqa: PT011 - the message is compared below
        getattr(GO2, name)(*arguments)
    with pytest.raises(type(book.value)) as ours:
        getattr(fast, name)(GO2, *arguments)
    assert str(ours.value) == str(book.value)


def test_what_is_no_model_is_refused():
    for name, *arguments in (("integrate", Q, V), ("difference", Q, Q), ("interpolate", Q, Q, 0.5)):
        with pytest.raises(TypeError, match="model"):
            getattr(fast, name)("go2", *arguments)


def test_a_joint_of_ones_own_that_asks_what_its_step_is_takes_the_textbooks():
    class Asking(Joint):
        kind, nq, nv = "asking of test_fast_steps", 1, 1

        def subspace(self, dtype=np.float64):
            return np.eye(6, 1, dtype=dtype)

        def transform(self, q):
            return tw.model.Revolute("x").transform(q)

        def integrate(self, q, dv):
            return np.where(np.isfinite(dv), q + dv, q)

    try:
        builder = tw.Builder("asking")
        builder.link("wheel", parent="base_link", joint=Asking())
        model = builder.build()
        assert fast.integrate(model, np.zeros(1), np.array([0.5])) == 0.5
        assert model._programs[("integrate",), np.dtype(float), None].backend == "textbook"
    finally:
        Joint.kinds.pop(Asking.kind)


def test_a_joint_of_ones_own_with_a_unit_part_takes_the_textbooks_difference():
    class Ball(tw.model.Spherical):
        kind = "ball of test_fast_steps"

        def turn_between(self, q0, q1):
            return tw.model.GroupJoint.turn_between(self, q0, q1)

    try:
        builder = tw.Builder("ball")
        builder.link("ball", parent="base_link", joint=Ball())
        model = builder.build()
        q0, q1, _, _ = states(model, (5,))
        np.testing.assert_allclose(fast.difference(model, q0, q1), tree("spherical", 1).difference(q0, q1), atol=1e-14)
        assert model._programs[("difference",), np.dtype(float), None].backend == "textbook"
    finally:
        Joint.kinds.pop(Ball.kind)


def test_a_program_is_made_once():
    model = tree("free_flyer")
    q, q1, v, u = states(model, ())
    for _ in range(2):
        for call in CALLS.values():
            call(Fast, model, q, q1, v, u)
    assert len(model._programs) == len(CALLS)
    assert all(isinstance(made, programs.Program) for made in model._programs.values())

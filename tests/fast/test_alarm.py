"""States that a program does not trust itself with are the textbook's: those of a batch, and no others."""

from itertools import product

import numpy as np
import pytest

import twistwrench as tw
from straightline.llvm import available
from twistwrench.fast import quantity

from ..sampling import sampled
from ..strategies import random_state

BACKENDS = [
    pytest.param("llvm", marks=pytest.mark.skipif(not available(), reason="llvmlite is not installed")),
    "numpy",
]
BATCHES = [(), (3,), (40,), (3, 9)]
GO2 = tw.load("go2")
POINT = tw.SpatialInertia(1.0, [0, 0, 0], np.zeros((3, 3)))
ROD = tw.SpatialInertia(1.0, [0.1, 0.2, 0.3], np.diag([0.2, 0.3, 0.4]))

WRONG = {
    "a NaN": lambda s: s.v.__setitem__((..., 3), np.nan),
    "an infinity": lambda s: s.tau.__setitem__((..., 3), -np.inf),
    "a position without end": lambda s: s.q.__setitem__((..., 0), np.inf),
    "a quaternion off norm 1": lambda s: s.q.__setitem__((..., 6), 2),
    "a quaternion just off norm 1": lambda s: s.q.__setitem__((..., slice(3, 7)), s.q[..., 3:7] * (1 + 1.6e-8)),
    "a quaternion of zeros": lambda s: s.q.__setitem__((..., slice(3, 7)), 0),
    "a velocity whose powers overflow": lambda s: s.v.__setitem__((..., 3), 1e80),
    "a wrench on the world": lambda s: s.f_ext.__setitem__((..., 0, 2), 5e-324),
    "a wrench that is no number": lambda s: s.f_ext.__setitem__((..., 4, 2), np.nan),
}


def copied(s):
    return type(s)(*(x.copy() for x in s))


def spoiled(s, spoil):
    """The states, of which one in the middle and the last are spoiled."""
    s = copied(s)
    count = s.q[..., 0].size
    for k in {count // 2, count - 1}:
        place = np.unravel_index(k, s.q.shape[:-1])
        spoil(type(s)(*(x[place] for x in s)))  # views
    return s


def message(function, *args):
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the message is compared by those who call
        function(*args)
    return type(caught.value), str(caught.value)


@pytest.mark.one_case
@pytest.mark.parametrize("backend", BACKENDS)
def test_a_state_that_is_wrong_is_named_with_its_place_in_the_batch(backend):
    program = tw.compile(GO2, "aba", backend=backend)
    for (what, spoil), batch in product(WRONG.items(), BATCHES):
        wrong = spoiled(random_state(GO2, rng=0, batch=batch), spoil)
        args = wrong.q, wrong.v, wrong.tau, wrong.f_ext
        assert message(program, *args) == message(tw.aba, GO2, *args), what


@pytest.mark.parametrize("batch", [(), (3, 9)], ids=str)
@pytest.mark.parametrize("backend", BACKENDS)
def test_it_is_named_whatever_depends_on_it(backend, batch):
    """M does not depend on v; and what is given has no place in the batch."""
    s = random_state(GO2, rng=0, batch=batch)
    rest, pushed = np.zeros(GO2.nv), np.ones((GO2.nbodies, 6)) * (np.arange(GO2.nbodies) > 0)[:, None]
    several = tw.compile(GO2, ["M", "h"], backend=backend)
    held = tw.compile(GO2, "rnea", given={"v": rest, "f_ext": pushed}, backend=backend)
    for what in ("a NaN", "a velocity whose powers overflow"):
        q, v, a, *_ = spoiled(s, WRONG[what])
        assert message(several, q, v) == message(tw.nonlinear_effects, GO2, q, v)
    for what in ("a position without end", "a quaternion off norm 1"):
        q, _, a, *_ = spoiled(s, WRONG[what])
        assert message(held, q, a) == message(tw.rnea, GO2, q, rest, a, pushed)


# ---------------------------------------------------------------- states that have an answer


def turned(s):
    """A leg has turned many times: the angle is more than a program's sine is good for."""
    s.q[..., 9] = 1e6


@pytest.mark.one_case
@pytest.mark.parametrize("batch", sampled([(3, 9), ()], 1), ids=str)
@pytest.mark.parametrize("backend", BACKENDS)
def test_other_states_stay_what_they_are(backend, batch):
    """To the last bit; and the large angle's are the textbook's."""
    s = random_state(GO2, rng=0, batch=batch)
    wide, given = spoiled(s, turned), {"v": np.full(GO2.nv, 0.5)}
    where = wide.q[..., 9] == 1e6
    for want, args, options in (
        ("aba", ("q", "v", "tau", "f_ext"), {}),
        ("rnea", ("q", "a", "f_ext"), {"given": given}),
        (["M", "h", "A_G", "T"], ("q", "v"), {}),
        (["M", "h", "S"], ("q",), {"given": given}),
    ):
        program = tw.compile(GO2, want, backend=backend, **options)
        ours, before = (program(**{name: getattr(x, name) for name in args}) for x in (wide, s))
        state = {name: getattr(wide, name) for name in args} | options.get("given", {})
        results = (
            [("qdd" if want == "aba" else "tau", ours, before)]
            if isinstance(want, str)
            else [(name, getattr(ours, name), getattr(before, name)) for name in want]
        )
        for name, got, usual in results:
            function = BY_SYMBOL[name]
            right = function(GO2, *(state[k] for k in ARGUMENTS[name] if k in state))
            np.testing.assert_array_equal(got[~where], usual[~where], err_msg=name)
            expected = np.broadcast_to(right, got.shape)[where]
            np.testing.assert_allclose(got[where], expected, rtol=0, atol=1e-13 * np.abs(expected).max(), err_msg=name)


BY_SYMBOL = {
    "qdd": tw.aba,
    "tau": tw.rnea,
    "M": tw.crba,
    "h": tw.nonlinear_effects,
    "A_G": tw.centroidal_map,
    "T": tw.kinetic_energy,
    "S": tw.selection_matrix,
}
ARGUMENTS = {
    "qdd": ("q", "v", "tau", "f_ext"),
    "tau": ("q", "v", "a", "f_ext"),
    "M": ("q",),
    "h": ("q", "v"),
    "A_G": ("q",),
    "T": ("q", "v"),
    "S": (),
}


@pytest.mark.one_case
@pytest.mark.parametrize("backend", BACKENDS)
def test_the_textbook_takes_no_other_states(backend, monkeypatch):
    seen, results = [], quantity._results
    monkeypatch.setattr(quantity, "CHUNK", 4 * GO2.nv)
    monkeypatch.setattr(quantity, "_results", lambda *args: (seen.append(args[2]["q"].shape), results(*args))[1])
    s = random_state(GO2, rng=0, batch=(20, 50))
    s.q[3:6, 7::22, 9] = 1e6
    s.q[3, 7, 9] = -1e7
    tw.compile(GO2, "crba", backend=backend)(s.q)
    assert seen == [(4, 19), (2, 19)]


# ---------------------------------------------------------------- states that have none


def gimbal(middle=np.pi / 2):
    """Three turns at one point, nothing but the last with inertia: at a right angle, two are about one axis."""
    builder = tw.Builder("gimbal", base="fixed")
    for parent, name, axis in (("base_link", "outer", "x"), ("outer", "middle", "y"), ("middle", "rod", "z")):
        body = ROD if name == "rod" else tw.SpatialInertia.zero()
        builder.link(name, parent=parent, joint=tw.Revolute(axis), inertia=body)
    return builder.build(), 1, middle


def slider():
    """A bead on a spoke that has no mass: at the hub, the turn of the spoke moves nothing."""
    builder = tw.Builder("slider", base="fixed")
    builder.link("spoke", parent="base_link", joint=tw.Revolute("z"))
    builder.link("bead", parent="spoke", joint=tw.Prismatic("x"), inertia=POINT)
    return builder.build(), 1, 0.0


@pytest.mark.parametrize("batch", BATCHES, ids=str)
@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("make", [gimbal, slider])
def test_a_singular_state_is_named_as_tw_aba_does(make, backend, batch):
    model, k, value = make()
    program, s = tw.compile(model, "aba", backend=backend), random_state(model, rng=0, batch=batch)
    s.q[..., k] = 0.3 + 0.1 * np.abs(s.q[..., k])  # far from singular
    usual = program(s.q, s.v, s.tau)
    np.testing.assert_allclose(usual, tw.aba(model, s.q, s.v, s.tau), rtol=0, atol=1e-11 * np.abs(usual).max())
    wrong = spoiled(s, lambda one: one.q.__setitem__(k, value))
    kind, text = message(program, wrong.q, wrong.v, wrong.tau)
    assert (kind, text) == message(tw.aba, model, wrong.q, wrong.v, wrong.tau)
    assert kind is tw.SingularError
    assert f"'{model.joint_names[1]}'" in text
    if batch and make is gimbal:  # where nothing at all moves, the textbook names joints only
        assert str(tuple(int(i) for i in np.unravel_index(s.q[..., 0].size // 2, batch)))[:-1] in text


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("batch", [(), (40,)], ids=str)
def test_what_is_nearly_singular_is_solved_by_the_textbook(backend, batch):
    model, *_ = gimbal()
    program, s = tw.compile(model, "aba", backend=backend), random_state(model, rng=0, batch=batch)
    s.q[..., 1] = 0.3
    near = spoiled(s, lambda one: one.q.__setitem__(1, np.pi / 2 - 1e-5))
    where = near.q[..., 1] != 0.3
    got, usual = program(near.q, near.v, near.tau), program(s.q, s.v, s.tau)
    np.testing.assert_array_equal(got[where], tw.aba(model, near.q, near.v, near.tau)[where])
    np.testing.assert_array_equal(got[~where], usual[~where])


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_a_link_without_mass_is_named(backend, batch):
    """Here the model is singular, in every state."""
    builder = tw.Builder("massless")
    builder.link("heavy", parent="base_link", joint=tw.Revolute("x"), inertia=ROD)
    builder.link("light", parent="heavy", joint=tw.Revolute("y"))
    model = builder.build()
    s = random_state(model, rng=0, batch=batch)
    expected = message(tw.aba, model, s.q, s.v, s.tau)
    assert "light" in expected[1]
    assert message(tw.compile(model, "aba", backend=backend), s.q, s.v, s.tau) == expected

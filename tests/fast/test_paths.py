"""One call, many ways to make it: each has the numbers of the first one to the last bit.

Also without the functions that read NumPy's arrays where they lie, without NumPy's own, and without both.
"""

import numpy as np
import pytest

import twistwrench as tw
from straightline import extension, ufunc
from straightline.llvm import available
from twistwrench import fast

from ..strategies import random_state

pytestmark = pytest.mark.skipif(not available(), reason="llvmlite is not installed")

MODEL = tw.load("go2")
S = random_state(MODEL, rng=0, batch=(40,))
FEET = tuple(MODEL.feet)


@pytest.fixture(scope="module", params=["", "extension", "ufunc", "both"])
def model(request):
    """A robot of its own, whose programs have been made with all pieces, or without some."""
    with pytest.MonkeyPatch.context() as patch:
        if request.param in ("extension", "both"):
            patch.setattr(extension, "POSSIBLE", False)
        if request.param in ("ufunc", "both"):
            patch.setattr(ufunc, "POSSIBLE", False)
        yield tw.load("go2")


@pytest.fixture(scope="module")
def right():
    """The result of each state by itself, in the first call of a program."""
    return {name: tw.compile(MODEL, name)(*args) for name, args in ARGUMENTS.items()}


ARGUMENTS = {
    "rnea": (S.q, S.v, S.a, S.f_ext),
    "aba": (S.q, S.v, S.tau, S.f_ext),
    "crba": (S.q,),
    "nonlinear_effects": (S.q, S.v),
    "centroidal_map": (S.q,),
}
LEADING = {
    "one state": lambda x: x[3],
    "one axis": lambda x: x[3:4],
    "five": lambda x: x[:5],
    "forty": lambda x: x,
    "none": lambda x: x[:0],
    "two axes": lambda x: x.reshape(4, 10, *x.shape[1:]),
    "every third": lambda x: x[::3],
    "backwards": lambda x: x[::-1],
    "axes exchanged": lambda x: x.reshape(4, 10, *x.shape[1:]).swapaxes(0, 1),
    "some of two axes": lambda x: x.reshape(4, 10, *x.shape[1:])[:, 2:9:2],
    "entries with gaps": lambda x: np.repeat(x, 2, -1)[..., ::2],
    "entries far apart": lambda x: np.asfortranarray(x),
    "unaligned": lambda x: np.frombuffer(b"\0" + x.tobytes(), float, offset=1).reshape(x.shape),
}


@pytest.mark.one_case
@pytest.mark.parametrize("leading", LEADING)
@pytest.mark.parametrize("name", ARGUMENTS)
def test_the_same_bits_wherever_the_states_lie(model, right, name, leading):
    view, function = LEADING[leading], getattr(fast, name)
    args, expected = [view(x) for x in ARGUMENTS[name]], view(right[name])
    for _ in range(3):  # the first call makes what the next ones go by
        found = function(model, *args)
        assert type(found) is np.ndarray
        assert found.flags.carray
        assert found.shape == expected.shape
        assert np.array_equal(found, expected)
        for out in (
            np.full(expected.shape, np.nan),
            np.full((*expected.shape[:-1], 40), np.nan)[..., : expected.shape[-1]],
        ):
            assert function(model, *args, out=out) is out
            assert np.array_equal(out, expected)


def test_the_same_bits_where_states_share_an_argument(model, right):
    q, v = np.broadcast_to(S.q[3], S.q.shape).copy(), S.v
    for _ in range(2):
        assert np.array_equal(fast.nonlinear_effects(model, S.q[3], v), fast.nonlinear_effects(model, q, v))
        both = fast.nonlinear_effects(model, S.q[:7, None], v[:5])
        for k in range(7):
            assert np.array_equal(both[k], fast.nonlinear_effects(model, np.tile(S.q[k], (5, 1)), v[:5]))


@pytest.mark.parametrize("count", [1, 3, 40])
def test_an_out_that_is_an_argument_is_read_before_it_is_written(model, right, count):
    f_ext = S.f_ext[:count]
    for _ in range(2):
        tau = S.tau[:count].copy()
        assert fast.aba(model, S.q[:count], S.v[:count], tau, f_ext, out=tau) is tau
        assert np.array_equal(tau, right["aba"][:count])
        # so many that they are written where they are wanted
        x = [np.tile(part[:count], (60, *[1] * (part.ndim - 1))) for part in (S.q, S.v, S.tau, S.f_ext)]
        assert fast.aba(model, *x, out=x[2]) is x[2]
        assert np.array_equal(x[2], np.tile(right["aba"][:count], (60, 1)))


@pytest.mark.parametrize("count", [2, 2000])
def test_a_wrong_state_is_refused_in_the_same_words_in_each_call(model, count):
    q, v = np.tile(S.q[0], (count, 1)), np.tile(S.v[0], (count, 1))
    out = np.zeros((count, 18))
    good = fast.nonlinear_effects(model, q, v)
    q[1, 0] = np.nan
    for options in ({}, {"out": out}) * 2:
        with pytest.raises(ValueError, match=r"q: .*nan"):
            fast.nonlinear_effects(model, q, v, **options)
    q[1, 0] = S.q[0, 0]
    assert np.array_equal(fast.nonlinear_effects(model, q, v, out=out), good)


@pytest.mark.parametrize("count", [3, 4000])
@pytest.mark.parametrize("kind", ["shape", "more axes", "number type", "read only", "shared entries", "no array"])
def test_an_out_that_does_not_fit_is_refused_in_each_call(model, kind, count):
    q, v = np.tile(S.q[0], (count, 1)), np.tile(S.v[0], (count, 1))
    read_only = np.zeros((count, 18))
    read_only.flags.writeable = False
    out = {
        "shape": np.zeros((count, 17)),
        "more axes": np.zeros((2, count, 18)),
        "number type": np.zeros((count, 18), np.float32),
        "read only": read_only,
        "shared entries": np.lib.stride_tricks.as_strided(np.zeros(18), (count, 18), (0, 8)),
        "no array": [0.0] * 18,
    }[kind]
    for _ in range(3):
        with pytest.raises(ValueError, match="out: expected for h an array"):
            fast.nonlinear_effects(model, q, v, out=out)


WANTS = {
    "all": {},
    "a tuple": {"contacts": FEET},
    "a list": {"contacts": [*FEET]},
    "a set": {"want": {"M", "h", "J_c", "A_G"}},
    "another order": {"want": ("A_G", "J_c", "h", "M")},
    "an iterator": {"want": lambda: iter(["h", "A_G", "M", "J_c"])},
    "contacts": {"contacts": [tw.PointContact(foot, mu=0.7) for foot in FEET]},
}


@pytest.mark.parametrize("leading", ["one state", "five", "forty", "some of two axes"])
@pytest.mark.parametrize("want", WANTS)
def test_dynamics_has_the_same_bits_however_it_is_asked(model, right, want, leading):
    view = LEADING[leading]
    M, h, A_G = (view(right[name]) for name in ("crba", "nonlinear_effects", "centroidal_map"))
    for _ in range(2):
        options = {name: x() if callable(x) else x for name, x in WANTS[want].items()}
        d = fast.dynamics(model, view(S.q), view(S.v), **options)
        assert np.array_equal(d.M, M)
        assert np.abs(d.h - h).max() < 1e-13 * np.abs(h).max()  # the sums of h and M together are others
        assert np.abs(d.A_G - A_G).max() < 1e-14 * np.abs(A_G).max()
        assert d.J_c.shape == (*h.shape[:-1], 12, 18)
        mine = tw.Dynamics(M=np.zeros_like(d.M), J_c=np.zeros_like(d.J_c))
        options = {name: x() if callable(x) else x for name, x in WANTS[want].items()}
        again = fast.dynamics(model, view(S.q), view(S.v), **options, out=mine)
        assert again.M is mine.M
        assert all(np.array_equal(x, getattr(d, name)) for name, x in vars(again).items())


def test_programs_are_remembered_once_however_contacts_and_wants_are_given():
    model = tw.chain(3)
    q = np.zeros(3)
    for contacts in (("rod_01",), ["rod_01"], iter(["rod_01"])):
        fast.dynamics(model, q, q, contacts=contacts, want=("M", "J_c"))
    for want in (["J_c", "M"], {"M", "J_c"}, iter(["M", "J_c"])):
        fast.dynamics(model, q, q, contacts=("rod_01",), want=want)
    assert len(model._programs) == 1


def test_arrays_that_were_pickled_are_taken_as_they_are():
    """Their number type is another object."""
    import pickle

    x = [pickle.loads(pickle.dumps(part)) for part in (S.q[0], S.v[0], S.a[0])]
    assert np.array_equal(fast.rnea(MODEL, *x), fast.rnea(MODEL, S.q[0], S.v[0], S.a[0]))

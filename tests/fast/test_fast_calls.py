"""How the fast way is called: what it refuses, where it writes, how it is spread, what it keeps."""

import gc
import pickle
import re
import sys
import weakref
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from straightline import extension, llvm, registers
from twistwrench import fast
from twistwrench.algorithms.whole_body import QUANTITIES
from twistwrench.fast import programs, quantity

from ..strategies import Recipe, random_state

GO2 = tw.load("go2")
CALLS = {
    "rnea": lambda package, model, q, v, **options: package.rnea(model, q, v, v, **options),
    "aba": lambda package, model, q, v, **options: package.aba(model, q, v, v, **options),
    "nonlinear_effects": lambda package, model, q, v, **options: package.nonlinear_effects(model, q, v, **options),
    "crba": lambda package, model, q, v, **options: package.crba(model, q, **options),
    "centroidal_map": lambda package, model, q, v, **options: package.centroidal_map(model, q, **options),
}
TAILS = {"rnea": (18,), "aba": (18,), "nonlinear_effects": (18,), "crba": (18, 18), "centroidal_map": (6, 18)}


@pytest.fixture
def states():
    return random_state(GO2, rng=0, batch=(37,))


# ---------------------------------------------------------------- what is refused


def spoil(x, index, value):
    x = x.copy()
    x[index] = value
    return x


Q, V = GO2.standing(), np.zeros(18)
WRONG = {
    "a NaN in q": (spoil(Q, 8, np.nan), V),
    "an infinity in v": (Q, spoil(V, 3, np.inf)),
    "two infinities in v": (Q, spoil(V, slice(3, 5), [np.inf, -np.inf])),
    "a q whose square overflows": (spoil(Q, 0, 1e78), V),
    "a v whose fifth power overflows": (Q, spoil(V, 3, -1e62)),
    "a quaternion off norm 1": (spoil(Q, 6, 1.001), V),
    "a quaternion just off norm 1": (spoil(Q, slice(3, 7), Q[3:7] * (1 + 1.6e-8)), V),
    "a zero quaternion": (spoil(Q, slice(3, 7), 0), V),
    "v for q": (V, V),
    "q for v": (Q, Q),
    "too short": (Q[:-1], V),
    "batches that do not fit": (np.tile(Q, (3, 1)), np.tile(V, (2, 1))),
    "text": (["a"] * 19, V),
    "rows of different lengths": ([[1.0], [1.0, 2.0]], V),
    "a mask": (Q, np.ma.array(V, mask=True)),
    "a mask in a batch": (np.tile(Q, (12, 1)), np.ma.array(np.ones((12, 18)), mask=True)),
    "a masked configuration": (np.ma.array(np.tile(Q, (2, 1)), mask=np.arange(19) > 7 * np.ones((2, 1))), V),
    "a bad state in a batch": (spoil(np.tile(Q, (3, 1)), (1, 6), 1.1), np.tile(V, (3, 1))),
}


@pytest.mark.parametrize("name", ["rnea", "aba", "nonlinear_effects"])
@pytest.mark.parametrize("wrong", WRONG)
def test_what_the_textbook_refuses_is_refused_in_the_same_words(name, wrong):
    q, v = WRONG[wrong]
    with pytest.raises(ValueError) as book:  # noqa: PT011 - the message is compared below
        CALLS[name](tw, GO2, q, v)
    with pytest.raises(type(book.value)) as ours:
        CALLS[name](fast, GO2, q, v)
    assert str(ours.value) == str(book.value)


@pytest.mark.parametrize("q", [spoil(Q, slice(3, 7), Q[3:7] * (1 + 1.4e-8)), Q.tolist(), Q.astype(np.float16)])
def test_what_the_textbook_takes_is_taken(q):
    np.testing.assert_allclose(fast.crba(GO2, q), tw.crba(GO2, q), rtol=0, atol=1e-6)
    assert fast.crba(GO2, q).dtype == tw.crba(GO2, q).dtype


def test_the_largest_numbers_that_pass_give_no_infinity():
    q, v = spoil(Q, 0, 1e77), np.full(18, 4e61)
    h = fast.nonlinear_effects(GO2, q, v)
    np.testing.assert_allclose(h, tw.nonlinear_effects(GO2, q, v), rtol=0, atol=1e-12 * np.abs(h).max())


def test_number_types_are_brought_together_as_in_the_textbook():
    q, v = Q.astype(np.float32), np.ones(18)
    for a in (np.zeros(18, int), np.zeros(18, np.float32), [0] * 18):
        ours, book = fast.rnea(GO2, q, v, a), tw.rnea(GO2, q, v, a)
        assert ours.dtype == book.dtype == np.float64
        np.testing.assert_allclose(ours, book, rtol=0, atol=1e-9)
    assert fast.rnea(GO2, q, q[1:], [0] * 18).dtype == np.float32


def test_a_wrench_on_the_world_is_refused():
    f_ext = np.zeros((GO2.nbodies, 6))
    f_ext[0, 0] = 1
    for function in (fast.rnea, fast.aba):
        with pytest.raises(ValueError, match="row 0 is a wrench on the world"):
            function(GO2, Q, V, V, f_ext)


def test_unknown_names_are_refused():
    with pytest.raises(KeyError, match="unknown quantity 'm'"):
        fast.dynamics(GO2, Q, V, want={"m"})
    with pytest.raises(KeyError, match="did you mean 'FR_foot'"):
        fast.dynamics(GO2, Q, V, contacts=["FR_fot"])
    with pytest.raises(KeyError, match="quantity: expected a name, got list"):
        fast.dynamics(GO2, Q, V, want=[["M"]])
    with pytest.raises(ValueError, match="want: expected a sequence of quantities, got the string 'M'"):
        fast.dynamics(GO2, Q, V, want="M")
    for want in (["J_c"], ["M"]):
        with pytest.raises(ValueError, match="contacts: expected a sequence of frame names, got the string 'FR_foot'"):
            fast.dynamics(GO2, Q, V, contacts="FR_foot", want=want)
    fast.dynamics(GO2, Q, V, contacts=["FR_fot"], want={"h"})  # nobody asked for J_c


@pytest.mark.one_case
@pytest.mark.parametrize("n", [1, 10])
def test_names_may_come_from_an_iterator(n):
    q, v = np.tile(Q, (n, 1)), np.tile(V, (n, 1))
    d = fast.dynamics(GO2, q, v, contacts=iter(GO2.feet), want=iter(["J_c", "M"]))
    assert (d.J_c == fast.dynamics(GO2, q, v).J_c).all()
    assert (fast.crba(GO2, q) == d.M).all()
    assert d.h is d.A_G is None


def massless():
    """A joint that moves nothing with mass, beyond one that does."""
    rod = tw.SpatialInertia(1.0, [0, 0, 0.5], np.eye(3) * 0.1)
    builder = tw.Builder("massless")
    builder.link("heavy", parent="base_link", joint=tw.Revolute("x"), inertia=rod)
    builder.link("light", parent="heavy", joint=tw.Revolute("y"))
    return builder.build()


def parallel():
    """Two joints about one axis, the mass behind both: the outer one moves, the inner one feels nothing."""
    rod = tw.SpatialInertia(1.0, [0, 0, 0.5], np.eye(3) * 0.1)
    builder = tw.Builder("parallel")
    builder.link("inner", parent="base_link", joint=tw.Revolute("x"))
    builder.link("outer", parent="inner", joint=tw.Revolute("x"), inertia=rod)
    return builder.build()


@pytest.mark.parametrize("make", [massless, parallel])
def test_singular_models_are_refused_in_the_same_words(make):
    model = make()
    q = np.array([[0.3, 0.4], [0.5, 0.6]])
    with pytest.raises(tw.SingularError) as book:
        tw.aba(model, q, q, q)
    with pytest.raises(tw.SingularError) as ours:
        fast.aba(model, q, q, q)
    assert str(ours.value) == str(book.value)
    np.testing.assert_allclose(fast.crba(model, q), tw.crba(model, q), rtol=0, atol=1e-15)


@pytest.mark.parametrize("batch", [(), (60,)], ids=str)
def test_a_massless_base_is_refused_in_the_same_words(batch):
    """The base can turn and its leg turn back without anything that has inertia moving."""
    rod = tw.SpatialInertia(1.0, [0.1, 0.2, 0.5], np.diag([0.1, 0.2, 0.25]))
    builder = tw.Builder("hopper", base="floating")
    builder.link("leg", parent="base_link", joint=tw.Revolute([1, 2, 3]), inertia=rod)
    model = builder.build()
    s = random_state(model, rng=0, batch=batch)
    with pytest.raises(tw.SingularError, match="'root_joint': with its outboard joints free") as book:
        tw.aba(model, s.q, s.v, s.tau)
    with pytest.raises(tw.SingularError) as ours:
        fast.aba(model, s.q, s.v, s.tau)
    assert str(ours.value) == str(book.value)


def test_what_is_only_nearly_singular_is_solved():
    """What the inner joint feels is its rotor: too little for the quick check, enough for the textbook."""
    rod = tw.SpatialInertia(1.0, [0, 0, 0.5], np.eye(3) * 0.1)
    builder = tw.Builder("nearly")
    builder.link("inner", parent="base_link", joint=tw.Revolute("x"), armature=5e-14)
    builder.link("outer", parent="inner", joint=tw.Revolute("x"), inertia=rod)
    model, q = builder.build(), np.array([[0.3, 0.4], [0.5, 0.6]])
    np.testing.assert_array_equal(fast.aba(model, q, q, q), tw.aba(model, q, q, q))


def test_states_in_single_precision_that_are_nearly_singular_are_the_textbooks():
    builder = tw.Builder("whip", base="floating", root_inertia=tw.SpatialInertia(1, [0, 0, -1], np.eye(3)))
    parent = "base_link"
    for k, axis in enumerate("xyx", 1):
        rod = tw.SpatialInertia(1e3**k, [0, 0, -1], np.eye(3) * 1e3**k)
        builder.link(f"rod {k}", parent=parent, joint=tw.Revolute(axis), inertia=rod)
        parent = f"rod {k}"
    model = builder.build()
    for seed in range(10):
        s = random_state(model, rng=seed, dtype=np.float32)
        try:
            expected = tw.aba(model, s.q, s.v, s.tau)
        except tw.SingularError as error:
            with pytest.raises(tw.SingularError, match=re.escape(str(error)) + "$"):
                fast.aba(model, s.q, s.v, s.tau)
        else:
            found = fast.aba(model, s.q, s.v, s.tau)
            assert found.dtype == np.float32
            np.testing.assert_array_equal(found, expected)


def test_no_mass_has_no_centroidal_map():
    builder = tw.Builder("nothing")
    builder.link("light", parent="base_link", joint=tw.Revolute("y"))
    with pytest.raises(tw.SingularError, match="nothing that moves has mass"):
        fast.centroidal_map(builder.build(), [0.0])


# ---------------------------------------------------------------- what is written where


@pytest.mark.parametrize("name", CALLS)
def test_inputs_are_only_read(name, states):
    q, v = states.q.copy(), states.v.copy()
    q.flags.writeable = v.flags.writeable = False
    CALLS[name](fast, GO2, q, v)
    np.testing.assert_array_equal(q, states.q)
    np.testing.assert_array_equal(v, states.v)


@pytest.mark.parametrize("order", ["states first", "states last", "every second"])
@pytest.mark.parametrize("name", CALLS)
def test_out_is_filled_and_returned(name, order, states):
    shape = (37, *TAILS[name])
    out = {
        "states first": lambda: np.full(shape, np.nan),
        "states last": lambda: np.moveaxis(np.full((*TAILS[name], 37), np.nan), -1, 0),
        "every second": lambda: np.full((2 * 37, *TAILS[name]), np.nan)[::2],
    }[order]()
    returned = CALLS[name](fast, GO2, states.q, states.v, out=out)
    assert returned is out
    np.testing.assert_array_equal(out, CALLS[name](fast, GO2, states.q, states.v))


@pytest.mark.parametrize("count", [4, 40])
def test_out_with_batch_axes_that_cannot_be_one_is_filled(count):
    s = random_state(GO2, rng=0, batch=(3, count))
    out = np.full((3, 2 * count + 1, 18), np.nan)[:, 1::2]
    assert fast.rnea(GO2, s.q, s.v, s.a, out=out) is out
    np.testing.assert_array_equal(out, fast.rnea(GO2, s.q, s.v, s.a))


def test_out_of_dynamics_is_filled_where_it_is_given(states):
    mine = tw.Dynamics(M=np.empty((37, 18, 18)), h=np.empty((2, 2)))  # h is not asked for
    d = fast.dynamics(GO2, states.q, states.v, out=mine, want={"M", "A_G"})
    assert d.M is mine.M
    assert d.h is None
    np.testing.assert_array_equal(d.M, fast.crba(GO2, states.q))
    np.testing.assert_allclose(d.A_G, fast.centroidal_map(GO2, states.q), rtol=0, atol=1e-14)


@pytest.mark.parametrize("out", [np.empty((37, 17)), np.empty((37, 18), np.float32), np.empty((2, 18)), [0.0] * 18])
def test_an_out_that_does_not_fit_is_refused(out, states):
    with pytest.raises(tw.ShapeError, match=r"out: expected for tau an array of float64 of shape \(37, 18\)"):
        fast.rnea(GO2, states.q, states.v, states.a, out=out)
    with pytest.raises(TypeError, match="out: expected a Dynamics, got "):
        fast.dynamics(GO2, states.q, states.v, out=out)


@pytest.mark.parametrize("count", [3, 37])
def test_out_may_be_an_input(states, count):
    states = type(states)(*(x[:count] for x in states))
    qdd = fast.aba(GO2, states.q, states.v, states.tau)
    tau = states.tau.copy()
    fast.aba(GO2, states.q, states.v, tau, out=tau)
    np.testing.assert_array_equal(tau, qdd)


@pytest.mark.one_case
@pytest.mark.parametrize("batch", [(), (3,), (12,)])
@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_contacts_may_be_none_or_on_the_world(batch, base):
    model = Recipe(5, seed=1, base=base).model
    s = random_state(model, rng=0, batch=batch)
    for contacts in ((), ("base_link",)):  # the latter only where the base is fixed
        if set(contacts) <= set(model.frame_names):
            book = tw.dynamics(model, s.q, s.v, contacts=contacts)
            for want in (QUANTITIES, ("J_c",)) * 2:  # the first call goes another way
                ours = fast.dynamics(model, s.q, s.v, contacts=contacts, want=want)
                assert ours.J_c.shape == book.J_c.shape
                np.testing.assert_array_equal(ours.J_c, book.J_c)


# ---------------------------------------------------------------- how it is spread


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize("count", [1, 3, 8, 9])
def test_a_state_has_the_same_result_alone_and_among_others(name, count, states):
    """To the last bit: vectors of states do what one state does."""
    together = CALLS[name](fast, GO2, states.q[:count], states.v[:count])
    alone = [CALLS[name](fast, GO2, states.q[k], states.v[k]) for k in range(count)]
    np.testing.assert_array_equal(together, alone)


@pytest.mark.parametrize("name", CALLS)
def test_without_machine_code_the_results_are_the_same(name, states, monkeypatch):
    """But for sin and cos, which have a rounding or two of their own; in chunks of 64 states."""
    compiled = CALLS[name](fast, GO2, states.q, states.v)
    monkeypatch.setattr(llvm, "available", lambda: False)
    monkeypatch.setattr(registers, "CHUNK", 64)
    model = tw.load("go2")
    q, v = (np.concatenate([x] * 3) for x in (states.q, states.v))
    found = CALLS[name](fast, model, q, v)
    size = 10 if name == "aba" else 1  # the condition of M
    for part in (found[:37], found[74:]):
        np.testing.assert_allclose(part, compiled, rtol=0, atol=size * 1e-14 * np.abs(compiled).max())


def test_memory_does_not_grow_with_the_batch(states):
    """Besides the results, by no more than what each state is watched with."""
    import tracemalloc

    peaks = []
    for n in (4000, 20_000):
        q, out = np.tile(Q, (n, 1)), np.empty((n, 18, 18))
        fast.crba(GO2, q, out=out)
        tracemalloc.start()
        fast.crba(GO2, q, out=out)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] - peaks[0] < 16_000 * 32


# ---------------------------------------------------------------- robots that are too long


@pytest.fixture
def long_chain(monkeypatch):
    """A chain that counts as too long, of which the textbook takes 5 states at a time."""
    monkeypatch.setattr(programs, "MAX_CHAIN_DOF", 5)
    monkeypatch.setattr(quantity, "CHUNK", 30)
    return tw.chain(6, base="floating")


@pytest.mark.parametrize("batch", [(), (3,), (4, 3), (0,)], ids=str)
def test_a_robot_that_is_too_long_is_the_textbooks(long_chain, batch):
    s = random_state(long_chain, rng=0, batch=batch)
    ours, book = (
        fast.dynamics(long_chain, s.q, s.v, contacts=["rod_03"]),
        tw.dynamics(long_chain, s.q, s.v, contacts=["rod_03"]),
    )
    for name, right in vars(book).items():
        np.testing.assert_array_equal(getattr(ours, name), right)
    f_ext = s.f_ext
    for function in ("rnea", "aba"):
        right = getattr(tw, function)(long_chain, s.q, s.v, s.tau, f_ext)
        tau = s.tau.copy()
        assert getattr(fast, function)(long_chain, s.q, s.v, tau, f_ext, out=tau) is tau
        np.testing.assert_array_equal(tau, right)
    assert {made.backend for made in long_chain._programs.values()} == {"textbook"}


def test_a_robot_that_is_too_long_is_refused_in_the_same_words(monkeypatch):
    monkeypatch.setattr(programs, "MAX_CHAIN_DOF", 1)
    monkeypatch.setattr(quantity, "CHUNK", 4)
    model, q = parallel(), np.zeros((7, 2))
    with pytest.raises(tw.SingularError) as book:
        tw.aba(model, q, q, q)
    with pytest.raises(tw.SingularError) as ours:
        fast.aba(model, q, q, q)
    assert str(ours.value) == str(book.value)


def bundle(chains: int, links: int) -> tw.Model:
    """Chains side by side."""
    rod, built = tw.SpatialInertia(1.0, [0, 0, -0.5], np.eye(3)), tw.Builder("bundle")
    for chain in range(chains):
        for k in range(links):
            parent = f"{chain} {k - 1}" if k else "base_link"
            built.link(f"{chain} {k}", parent=parent, joint=tw.Revolute("y"), inertia=rod)
    return built.build()


@pytest.mark.one_case
@pytest.mark.parametrize(
    ("chains", "links", "want", "reason"),
    [
        (1, 80, "M", None),
        (1, 81, "qdd", "81 degrees of freedom in a chain, more than 80"),
        (1, 81, "dtau_dq", "81 degrees of freedom in a chain, more than 80"),
        (1, 400, "h", None),
        (1, 401, "h", "401 degrees of freedom in a chain, more than 400"),
        (25, 40, "h", None),
        (27, 38, "h", "1026 degrees of freedom, more than 1000"),
        (10, 60, "M", None),
        (12, 60, "M", "21960 entries of M, more than 20000"),
    ],
)
def test_what_is_too_long_is_decided_by_degrees_of_freedom_and_by_the_entries_of_m(chains, links, want, reason):
    assert programs.too_long(bundle(chains, links), [want]) == reason


@pytest.mark.one_case
@pytest.mark.skipif(not llvm.available(), reason="llvmlite is not installed")
@pytest.mark.parametrize("name", ["rnea", "nonlinear_effects", "centroidal_map"])
def test_a_long_chain_has_machine_code_and_the_accuracy_of_the_textbook(name):
    """Against the textbook in long double: the median error is at most half as large again, or a rounding of each."""
    model = tw.chain(120)
    q, v = np.random.default_rng(0).standard_normal((2, 12, 120))
    exact = CALLS[name](tw, model, q.astype(np.longdouble), v.astype(np.longdouble))
    axes = tuple(range(1, exact.ndim))
    ours, book = (
        np.median(np.abs(CALLS[name](package, model, q, v) - exact).max(axes) / np.abs(exact).max(axes))
        for package in (fast, tw)
    )
    assert ours < max(1.5 * book, 4e-15)
    assert {made.backend for made in model._programs.values()} == {"llvm"}


def test_what_is_handed_to_the_textbook_is_in_the_log(long_chain, caplog):
    for _ in range(2):
        fast.crba(long_chain, long_chain.neutral())
    assert caplog.messages == ["chain of 6 has 11 degrees of freedom in a chain, more than 5: the textbook computes M"]


def test_lines_that_are_too_long_for_machine_code_are_numpys(monkeypatch):
    monkeypatch.setattr(programs, "MAX_COMPILED_OPERATIONS", 3)
    model, q = tw.load("double_pendulum"), np.array([[0.3, -1.2]] * 30)
    assert np.abs(fast.crba(model, q) - tw.crba(model, q)).max() < 1e-14
    assert np.abs(fast.crba(model, q[0]) - tw.crba(model, q[0])).max() < 1e-14
    assert [program.backend for program in model._programs.values()] == ["numpy"]


# ---------------------------------------------------------------- what is kept


def test_a_program_is_made_once_for_each_question_and_number_type():
    model = tw.chain(3)
    for _ in range(2):
        for dtype in (float, np.float32):
            q = np.zeros((2, 3), dtype)
            fast.crba(model, q)
            fast.dynamics(model, q, q, want=["h", "M"])
            fast.dynamics(model, q, q, want=["M", "h"], contacts=["rod_01"])  # nobody asked for J_c
    assert len(model._programs) == 4


def calls_within(function):
    """Return the names of the functions of Python that a call goes through."""
    way = []
    sys.setprofile(lambda frame, event, _: way.append(frame.f_code.co_qualname) if event == "call" else None)
    try:
        function()
    finally:
        sys.setprofile(None)
    return way[1:]


@pytest.mark.skipif(not llvm.available(), reason="llvmlite is not installed")
@pytest.mark.parametrize("leading", [(), (1,), (3, 4)], ids=str)
@pytest.mark.parametrize("pushed", [False, True], ids=["", "f_ext"])
def test_from_a_function_to_its_machine_code_there_are_few_calls(leading, pushed):
    """A reader can follow them, and nothing is looked for a second time, whatever the leading axes are."""
    s = random_state(GO2, rng=0, batch=leading)
    f_ext = s.f_ext if pushed else None
    fast.rnea(GO2, s.q, s.v, s.a, f_ext)
    way = ["rnea", "result", "remembered"]
    if leading or not extension.POSSIBLE:
        way += ["Program.results", "Program._of_arrays"]
    assert calls_within(lambda: fast.rnea(GO2, s.q, s.v, s.a, f_ext)) == way
    out = np.empty((*leading, 18))
    assert "Program._general" not in calls_within(lambda: fast.rnea(GO2, s.q, s.v, s.a, f_ext, out=out))


def test_a_program_goes_with_its_model_and_is_not_pickled():
    model = tw.chain(3)
    fast.crba(model, [0.1, 0.2, 0.3])
    assert len(model._programs) == 1
    assert pickle.loads(pickle.dumps(model))._programs == {}
    with pytest.raises(TypeError, match="belongs to its model"):
        pickle.dumps(next(iter(model._programs.values())))
    kept = [weakref.ref(x) for x in (*model._programs.values(), model)]
    del model
    gc.collect()
    assert [reference() for reference in kept] == [None, None]


@pytest.mark.slow
def test_more_sets_of_contacts_than_are_remembered_are_right(monkeypatch):
    monkeypatch.setattr(programs, "MAX_CACHED_PROGRAMS", 3)
    monkeypatch.setattr(llvm, "available", lambda: False)
    model = tw.load("go2")
    one = {foot: fast.dynamics(model, Q, V, contacts=[foot], want={"J_c"}).J_c for foot in model.feet}
    for contacts in (model.feet, model.feet[::-1], model.feet[:2], model.feet[1:]):
        J_c = fast.dynamics(model, Q, V, contacts=contacts, want={"J_c"}).J_c
        np.testing.assert_array_equal(J_c, np.concatenate([one[foot] for foot in contacts]))
    assert len(model._programs) == 3


@pytest.mark.parametrize("page", ["README.md", "README.zh-CN.md"])
def test_the_page_lists_what_is_fast(page):
    text = (Path(__file__).resolve().parents[2] / "benchmarks" / page).read_text(encoding="utf-8")
    section = text.split("\n## ")[[part.count("`d_difference`") > 0 for part in text.split("\n## ")].index(True)]
    listed = {name for line in section.splitlines() if line.startswith("| ") for name in re.findall(r"`(\w+)`", line)}
    assert listed == {*fast.__all__} - {"prepare"}  # which computes nothing

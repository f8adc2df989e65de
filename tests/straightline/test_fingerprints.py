"""`each_once`: closed forms, what it must not take for equal, and the same numbers in 60 digits."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from straightline.fingerprints import MAX_CONSTANT, each_once
from straightline.line import Line
from straightline.number import Tape, numbers
from straightline.packs import Packs
from straightline.registers import Registers
from twistwrench.fast import recording


def line_of(function, count=3):
    tape = Tape()
    return Line.of(tape, {"q": (count,)}, {"result": np.array(function(*numbers(tape, "q", count)), object)})


def results(line):
    return [line.nodes[k] for k in line.results]


def values(line, **state):
    """The results of a line in mpmath's numbers, of as many digits as are set."""
    given = [np.array([[mpmath.mpf(x) for x in np.ravel(state[name])]]) for name in line.inputs]
    found = np.empty((1, len(line.results)), object)
    Registers(line, np.dtype(object)).run([*given, found])
    return found[0]


# ---------------------------------------------------------------- closed forms


def test_angles_that_cancel_leave_a_constant_zero_or_the_number_itself():
    def formulas(a, b, m):
        c, s, k = a.cos(), a.sin(), b.cos()
        return [
            c * (3 * c) + s * (3 * s),
            c * s - s * (1 * c),
            (k * c) * c + (k * s) * s,
            (c + s) * (c - s) - c * c + s * s,
        ]

    three, nothing, k, last = results(each_once(line_of(formulas)))
    assert (three, nothing, last) == (("const", Fraction(3)), ("const", Fraction(0)), ("const", Fraction(0)))
    assert k[0] == "cos"


def test_the_inertia_of_a_turned_body_keeps_its_mass():
    """Xᵀ I X has the mass three times on its diagonal, a constant, and m [c]× twice."""
    model = tw.load("pendulum", base="floating")
    nodes, (shape, entries) = (line := tw.compile(model, "M").line).nodes, line.outputs["M"]
    M = np.reshape(np.array(entries), shape)
    assert [nodes[k] for k in M[3:6, 3:6].diagonal()] == [("const", Fraction(1))] * 3


# ---------------------------------------------------------------- what is not equal


@pytest.mark.parametrize(
    "formula",
    [
        lambda c, s, a: c * c + s * s * Fraction(2**60 + 1, 2**60),
        lambda c, s, a: c * c - s * s,
        lambda c, s, a: c * c + a.sin() * a.sin(),
        lambda c, s, a: (c * c).sqrt() - c,
        lambda c, s, a: c / s - s / c,
    ],
)
def test_what_is_not_the_same_in_every_state_stays(formula):
    line = line_of(lambda a, b, m: [formula(a.cos(), a.sin(), b)])
    assert each_once(line).operations == line.operations


def test_constants_of_any_size_stay_what_they_are():
    huge = Fraction(3 * MAX_CONSTANT + 1, 7)
    line = line_of(
        lambda a, b, m: [a.cos() * huge, (a.cos() * huge) * a.cos() + (a.sin() * huge) * a.sin(), 1 / huge + a]
    )
    with mpmath.workdps(120):
        before, after = (values(x, q=[0.3, 0.4, 0.5]) for x in (line, each_once(line)))
        assert all(mpmath.almosteq(x, y, rel_eps=1e-100) for x, y in zip(before, after))


def test_a_quotient_by_what_is_zero_is_left_to_the_alarm():
    line = each_once(line_of(lambda a, b, m: [m / (a.cos() * a.sin() - a.sin() * (1 * a.cos()) + 0 * m or b)]))
    assert line.operations["div"] == 1
    zero = line_of(lambda a, b, m: [m / ((a.cos() + a.sin()) * a.cos() - a.cos() * a.cos() - a.sin() * a.cos())])
    assert each_once(zero).operations["div"] == 1


# ---------------------------------------------------------------- the same numbers


@pytest.mark.one_case
@pytest.mark.parametrize("name", ["panda", "go2"])
@pytest.mark.parametrize("want", ["M", "A_G", "qdd"])
def test_in_60_digits_nothing_changes(name, want, monkeypatch):
    model = tw.load(name)
    line = tw.compile(model, want).line
    monkeypatch.setattr(recording, "each_once", lambda line: line)
    longer = tw.compile(model, want).line
    assert line.operations.total() < 0.9 * longer.operations.total()
    rng = np.random.default_rng(0)
    state = {"q": model.random_configuration(rng=rng), "v": rng.standard_normal(model.nv), "tau": np.ones(model.nv)}
    with mpmath.workdps(60):
        one, other = (values(x, **state) for x in (line, longer))
        size = max(abs(x) for x in other)
        assert max(abs(x - y) for x, y in zip(one, other)) < mpmath.mpf(10) ** -50 * size


def test_limbs_stay_alike():
    """Were numbers of one leg those of another one, NumPy could not do the four legs in one call."""
    line = tw.compile(tw.load("go2"), "rnea").line
    packs = Packs(line)
    four = sum(len(pack) for pack in packs.packs if len(pack) == 4)
    assert four > 0.8 * line.operations.total()

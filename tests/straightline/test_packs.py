"""The same operation in several limbs as one call of NumPy: what is put together, and that nothing else changes."""

from fractions import Fraction

import numpy as np
import pytest

import twistwrench as tw
from straightline import packs, registers
from straightline.line import Line
from straightline.number import Tape, numbers
from straightline.packs import Packs
from straightline.registers import Registers

DOUBLE = np.dtype(float)


def filled(code, line, arrays):
    results = [np.full((len(arrays[0]), len(entries)), np.nan) for _, entries in line.outputs.values()]
    code.run([*arrays, *results])
    return results


@pytest.mark.one_case
@pytest.mark.parametrize(("robot", "want"), [("go2", "rnea"), ("go2", "crba"), ("talos_left_arm", "aba")])
@pytest.mark.parametrize("states", [1, 7, 100])
def test_a_pack_computes_the_same_bits_as_one_operation_after_the_other(robot, want, states, monkeypatch):
    monkeypatch.setattr(registers, "CHUNK", 64)  # 100 states are two chunks
    line = tw.compile(tw.load(robot), want, backend="numpy").line
    arrays = list(np.random.default_rng(0).uniform(-1, 1, (len(line.inputs), states, 40)))
    arrays = [x[:, : np.prod(shape)] for x, shape in zip(arrays, line.inputs.values())]
    together = filled(Registers(line, DOUBLE), line, arrays)
    monkeypatch.setattr(packs, "MIN_LANES", 10**6)
    single = Registers(line, DOUBLE)
    assert {len(lanes) for k, lanes in enumerate(single.packs.packs) if single._operation(k) != "input"} == {1}
    for x, y in zip(together, filled(single, line, arrays), strict=True):
        np.testing.assert_array_equal(x, y)


@pytest.mark.parametrize("want", ["rnea", "crba"])
def test_four_legs_are_one_pack(want):
    found = Packs(tw.compile(tw.load("go2"), want, backend="numpy").line).packs
    lanes = [len(one) for one in found]
    assert lanes.count(4) > 0.6 * len(found)
    assert sum(lanes) < 1.02 * sum(len({*one}) for one in found) + 100  # hardly anything is computed twice


def test_a_left_limb_and_a_right_one_come_to_the_same_operations():
    tape = Tape()
    x, y = numbers(tape, "x", 2), numbers(tape, "y", 2)
    results = np.array([c * (x[0] * p - y[1]) + p * x[1] for c, p in zip((Fraction(3), Fraction(-3)), y)])
    line = Line.of(tape, {"x": (2,), "y": (2,)}, {"r": results})
    assert [line.nodes[k][0] for k in line.results] == ["add", "add"]


def test_rows_are_taken_for_another_number_of_states():
    line = tw.compile(tw.load("pendulum"), "gravity", backend="numpy").line
    code = Registers(line, DOUBLE)
    for states in (5, 3, 3, 8):
        q = np.linspace(0, 1, states)[:, None]
        (g,) = filled(code, line, [q])
        np.testing.assert_allclose(g, np.sin(q) * 9.81, rtol=1e-15)
    assert len(code.unused) == 1

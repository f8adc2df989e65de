"""The states of two registers take turns in each piece of a line: every number of states is done, and no other one."""

import numpy as np
import pytest

from straightline import llvm
from straightline.line import Line
from straightline.number import Tape, numbers

pytestmark = pytest.mark.skipif(not llvm.available(), reason="llvmlite is not installed")


def long_line():
    """Return a line of several pieces, with results from each of them."""
    tape = Tape()
    x = numbers(tape, "x", 20)
    results = []
    for k in range(40):
        x = [*x[1:].tolist(), x[0]]
        x = np.array([a * b + c for a, b, c in zip(x, x[3:] + x[:3], x[7:] + x[:7])], object) / (1 + k)
        results.append(x.sum())
    return Line.of(tape, {"x": (20,)}, {"y": np.array(results, object), "z": x})


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_any_number_of_states(dtype, monkeypatch):
    line, width = long_line(), llvm.lanes(np.dtype(dtype))
    texts, compiled = [], llvm.compiled
    monkeypatch.setattr(llvm, "compiled", lambda text: texts.append(text) or compiled(text))
    monkeypatch.setenv("STRAIGHTLINE_CACHE", "off")
    llvm.ENGINES.clear()
    one, many = llvm.MachineCode(line, np.dtype(dtype), 1), llvm.MachineCode(line, np.dtype(dtype), width)
    assert texts[1].count("define internal void @piece") > 2
    x = np.random.default_rng(0).uniform(-1, 1, (5 * width + 3, 20)).astype(dtype)
    right = [np.empty((len(x), size), dtype) for size in (40, 20)]
    one.run([x, *right])
    for count in (*range(width, 3 * width + 2), 4 * width, len(x)):
        found = [np.full((count + 2, size), np.nan, dtype) for size in (40, 20)]
        many.run([x[:count], *(y[1:-1] for y in found)])
        for y, expected in zip(found, right):
            np.testing.assert_array_equal(y[1:-1], expected[:count])
            assert np.isnan(y[[0, -1]]).all()

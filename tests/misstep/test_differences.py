"""How wrong numbers differ from right ones."""

import numpy as np
import pytest

from misstep.differences import differences
from misstep.exercise import Output, Part

A = np.array([[4.0, 1, 2], [1, 5, 3], [2, 3, 6]])
B = np.arange(9.0).reshape(3, 3) + 0.5


def part(n=1):
    return Part(solution=A.copy, returns=tuple(Output(f"r{k}") for k in range(n)), cases=lambda rng: [()], slips={})


@pytest.mark.parametrize(
    ("got", "right", "says"),
    [
        (-B, B, "sign is wrong"),
        (B.T, B, "transposed"),
        (-B.T, B, "transposed, and the sign"),
        (0 * B, B, "zero, and must not be"),
        (B + 1e-5, B, "right to 5 digits"),
        (B + np.outer([0, 0, 1], [0, 1, 0]), B, "wrong in [2, 1]"),
        (B[:2], B, "shape"),
        (B[0], "three", "a string"),
        (True, False, "is True, and must be False"),
    ],
)
def test_a_difference_is_described(got, right, says):
    lines, _ = differences(part(), got, right)
    assert says in " ".join(line.en for line in lines)
    assert all(line.zh for line in lines)


def test_nothing_is_told_of_what_is_right():
    lines, telling = differences(part(2), (B, -B), (B, B))
    assert telling
    assert [line.en for line in lines] == ["r1: the sign is wrong"]

"""Batch axes that do not broadcast are refused by name, and symbols pass through the inverses of skew and hat."""

import numpy as np
import pytest
import sympy

import twistwrench as tw


def placement(n):
    return tw.SE3(np.tile(np.eye(3), (n, 1, 1)), np.zeros((n, 3)))


def body(n):
    return tw.SpatialInertia(np.ones(n), np.zeros((n, 3)), np.tile(np.eye(3), (n, 1, 1)))


def twist(n):
    return tw.Twist(np.ones((n, 6)))


def wrench(n):
    return tw.Wrench(np.ones((n, 6)))


PRODUCTS = {
    "SE3 @ SE3": lambda m, n: placement(m) @ placement(n),
    "SE3 and point": lambda m, n: placement(m).act(np.zeros((n, 3))),
    "SE3 and Twist": lambda m, n: twist(n).transform(placement(m)),
    "SE3 and Wrench": lambda m, n: wrench(n).transform(placement(m)),
    "SE3 and SpatialInertia": lambda m, n: body(n).transform(placement(m)),
    "Twist + Twist": lambda m, n: twist(m) + twist(n),
    "Wrench - Wrench": lambda m, n: wrench(m) - wrench(n),
    "F and V": lambda m, n: wrench(m) @ twist(n),
    "number and Twist": lambda m, n: np.ones(m) * twist(n),
    "SpatialInertia + SpatialInertia": lambda m, n: body(m) + body(n),
    "SpatialInertia - SpatialInertia": lambda m, n: body(m) - body(n),
    "SpatialInertia and V": lambda m, n: body(m) @ twist(n),
    "scale and SpatialInertia": lambda m, n: np.ones(m) * body(n),
}


@pytest.mark.parametrize("what", PRODUCTS)
def test_both_are_named_where_their_batches_do_not_broadcast(what):
    with pytest.raises(tw.ShapeError) as error:
        PRODUCTS[what](2, 3)
    assert str(error.value) == f"{what}: batch axes (2,) and (3,) do not broadcast"
    PRODUCTS[what](1, 3)
    PRODUCTS[what](3, 3)


def test_symbols_come_back_out_of_their_matrices():
    x = sympy.symbols("x1:7")
    assert tw.unskew(tw.skew(x[:3])).tolist() == list(x[:3])
    assert tw.vee(tw.hat(x)).tolist() == list(x)
    with pytest.raises(tw.ShapeError, match="skew-symmetric"):
        tw.unskew(np.array([[x[0], 0, 0], [0, 0, 0], [0, 0, 0]], object))
    with pytest.raises(tw.ShapeError, match="last row of zeros"):
        tw.vee(np.diag([0, 0, 0, x[0]]))

"""Programs compute what the textbook computes, whatever runs them."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.compiler import compile
from twistwrench.compiler.llvm import available
from twistwrench.compiler.quantities import SYMBOLS, shapes

from ..strategies import random_state

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


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("name", SYMBOLS)
@pytest.mark.parametrize("model", MODELS, ids=lambda model: f"{model.name} {model.nv}")
def test_every_quantity_is_the_textbooks(model, name, backend):
    frame = model.frame_names[-1]
    program = compile(model, name, contacts=[frame], frames=[frame], backend=backend)
    state = random_state(model, rng=0)._asdict()
    args = [state[argument] for argument in program.arguments if argument in shapes(model)]
    expected = textbook(model, name, args, frame)
    size = max(1.0, np.abs(expected).max(initial=0))
    np.testing.assert_allclose(program(*args), expected, rtol=0, atol=1e-12 * size)
    many = [np.stack([x] * 11) for x in args]
    if args:
        np.testing.assert_allclose(program(*many)[10], expected, rtol=0, atol=1e-12 * size)

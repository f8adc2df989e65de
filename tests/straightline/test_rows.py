"""A line as rows for JAX: run here by NumPy in JAX's place, and by JAX where it is installed."""

import sys
from types import ModuleType

import numpy as np
import pytest

import twistwrench as tw
from straightline import jax_source, straight_line

from ..strategies import random_state


@pytest.fixture
def numpy_for_jax(monkeypatch):
    """Modules jax.numpy and jax.lax, of NumPy and a loop of Python; a result that is written twice is an error."""
    lax = ModuleType("jax.lax")

    def update(x, part, start):
        assert start[0] + len(part) <= len(x)  # JAX would move it without a word
        assert not x[start[0] : start[0] + len(part)].any()
        return np.concatenate([x[: start[0]], part, x[start[0] + len(part) :]])

    def scan(step, x, columns):
        for row in zip(*columns):
            x, _ = step(x, row)
        return x, None

    lax.dynamic_update_slice, lax.scan = update, scan
    lax.switch = lambda kind, branches, *operands: branches[kind](*operands)
    for name, module in {"jax": ModuleType("jax"), "jax.numpy": np, "jax.lax": lax}.items():
        monkeypatch.setitem(sys.modules, name, module)


def function(text, name):
    names = {}
    exec(text, names)
    return names[name]


@pytest.mark.parametrize("name", ["rnea", "aba", "crba", "center_of_mass", "potential_energy", "dqdd_dq"])
def test_rows_compute_what_the_program_computes(name, numpy_for_jax):
    model = tw.random_tree(6, rng=5, base="floating")
    program, state = tw.compile(model, name), random_state(model, rng=0)._asdict()
    args = [state[argument] for argument in program.arguments if argument != "f_ext"]
    expected = program(*args)
    got = function(program.source("jax.numpy"), program.quantities[0].symbol)(*args)
    assert got.shape == expected.shape
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-13 * np.abs(expected).max())


def test_every_operation_has_a_formula(numpy_for_jax):
    def mixed(x):
        a, b, c = x
        return np.array([-a, b - a * c, a * c - b, a / c, c.sqrt(), a.select(b, c)]), np.array(b.arctan2(a), object)

    parts, angle = function(jax_source(straight_line(mixed, x=(3,)), "f"), "f")(np.array([3.0, -4.0, 2.0]))
    np.testing.assert_array_equal(parts, [-3, -10, 10, 1.5, np.sqrt(2.0), -4])
    assert angle == np.arctan2(-4.0, 3.0)


def test_constants_alone_and_arguments_alone_need_no_loop(numpy_for_jax):
    line = straight_line(lambda x: (x[::-1], np.array([0, 2])), x=(2,))
    text = jax_source(line, "f")
    swapped, fixed = function(text, "f")(np.array([5.0, 6.0]))
    assert "scan" not in text
    np.testing.assert_array_equal(swapped, [6, 5])
    np.testing.assert_array_equal(fixed, [0, 2])


def test_another_number_of_entries_is_an_error(numpy_for_jax):
    gravity = function(tw.compile(tw.load("double_pendulum"), "gravity").source("jax.numpy"), "g")
    with pytest.raises(ValueError, match="reshape"):
        gravity(np.zeros((2, 2)))


def test_jax_compiles_differentiates_and_maps_the_rows():
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    model, rng = tw.load("go2"), np.random.default_rng(0)
    rnea = function(tw.compile(model, "rnea").source("jax.numpy"), "tau")
    q = np.stack([model.random_configuration(rng=rng) for _ in range(3)])
    v, a = rng.standard_normal((2, 3, model.nv))
    tau = tw.rnea(model, q, v, a)
    np.testing.assert_allclose(jax.jit(jax.vmap(rnea))(q, v, a), tau, rtol=0, atol=1e-12 * np.abs(tau).max())
    by_q, by_a = jax.jit(jax.jacfwd(rnea, argnums=(0, 2)))(q[0], v[0], a[0])
    backward = jax.jit(jax.jacrev(rnea))(q[0], v[0], a[0])
    exact = tw.compile(model, "dtau_dq")(q[0], v[0], a[0])
    step = np.stack([model.integrate(q[0], 1e-20j * e).imag / 1e-20 for e in np.eye(model.nv)], axis=1)  # ∂q/∂(v dt)
    for found in (by_q, backward):
        np.testing.assert_allclose(found @ step, exact, rtol=0, atol=1e-12 * np.abs(exact).max())
    np.testing.assert_allclose(by_a, tw.crba(model, q[0]), rtol=0, atol=1e-12)  # ∂τ/∂a = M

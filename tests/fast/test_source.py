"""The straight line as text: Python for any numbers, C where there is a compiler, and the names of the steps in it."""

import ctypes
import math
import shutil
import subprocess

import mpmath
import numpy as np
import pytest
import sympy

import twistwrench as tw
from twistwrench import newton_euler_3d as slow

from ..strategies import random_state


def function(program, functions="math"):
    names = {}
    exec(program.source(functions), names)
    return names[program.quantities[0].symbol]


@pytest.mark.parametrize("name", ["rnea", "aba", "crba", "centroidal_map", "potential_energy"])
def test_the_text_runs_on_floats(name):
    model = tw.random_tree(6, rng=5, base="floating")
    program, state = tw.compile(model, name), random_state(model, rng=0)._asdict()
    args = [state[argument] for argument in program.arguments if argument != "f_ext"]
    expected = getattr(tw, name)(model, *args)
    np.testing.assert_allclose(function(program)(*args), expected, rtol=0, atol=1e-12 * max(1, np.abs(expected).max()))


def test_the_text_runs_on_mpmath():
    model = tw.load("double_pendulum")
    q, v, tau = (
        slow.as_mpmath(np.array([0.3, -1.2])),
        slow.as_mpmath(np.array([2.0, 0.7])),
        slow.as_mpmath(np.array([1.0, 0])),
    )
    with mpmath.workdps(50):
        got = function(tw.compile(model, "aba"), "mpmath")(q, v, tau)
        expected = slow.forward_dynamics(model, q, v, tau)
        assert (
            max(abs(x - y) for x, y in zip(got, expected)) < mpmath.mpf(10) ** -13
        )  # 1/D of the last link is a double


def test_the_text_runs_on_symbols():
    """The textbook's pendulum: m g l sin q."""
    q = sympy.Symbol("q")
    (torque,) = function(tw.compile(tw.load("pendulum"), "gravity"), "sympy")([q])
    assert sympy.simplify(torque - sympy.Float(9.81) * sympy.sin(q)) == 0


def test_jax_compiles_differentiates_and_maps_the_text():
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    model = tw.load("cart_pole")
    program = tw.compile(model, "rnea")
    rnea = function(program, "jax.numpy")
    q, v, a = np.random.default_rng(0).standard_normal((3, 5, 2))
    torques = jax.jit(jax.vmap(lambda *x: jax.numpy.stack(rnea(*x))))
    np.testing.assert_allclose(torques(q, v, a), tw.rnea(model, q, v, a), atol=1e-12)
    by_a = jax.jacfwd(lambda x: jax.numpy.stack(rnea(q[0], v[0], x)))(a[0])
    np.testing.assert_allclose(by_a, tw.crba(model, q[0]), atol=1e-12)  # ∂τ/∂a = M


@pytest.mark.one_case
@pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")
@pytest.mark.parametrize("name", ["rnea", "crba"])
def test_the_c_text_is_c99(name, tmp_path):
    model = tw.load("go2")
    program, state = tw.compile(model, name), random_state(model, rng=0)._asdict()
    source, library = tmp_path / "program.c", tmp_path / "program.so"
    source.write_text(program.c(), encoding="utf-8")
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O1", "-ffp-contract=off", "-fPIC", "-shared"]
    subprocess.run(["cc", *flags, str(source), "-o", str(library), "-lm"], check=True)
    args = [np.ascontiguousarray(state[argument]) for argument in program.arguments if argument != "f_ext"]
    expected = getattr(tw, name)(model, *args)
    got = np.empty_like(expected)
    pointer = ctypes.POINTER(ctypes.c_double)
    getattr(ctypes.CDLL(str(library)), program.quantities[0].symbol)(*(x.ctypes.data_as(pointer) for x in (*args, got)))
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_values_have_the_names_of_the_steps():
    text = tw.compile(tw.load("go2"), "rnea").source()
    assert "# 49.6 V: twist, body 7" in text
    assert "    V7_1 = " in text
    assert "# 49.6 F_p: action and reaction, body 13" in text


def test_the_textbooks_pendulum_is_two_operations():
    assert dict(tw.compile(tw.load("pendulum"), "gravity").operations) == {"sin": 1, "mul": 1}
    assert math.isclose(function(tw.compile(tw.load("pendulum"), "gravity"))([0.5])[0], 9.81 * math.sin(0.5))

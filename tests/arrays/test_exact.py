"""Numbers that are objects: which are let in, what they become, and what comes out."""

import re
from decimal import Decimal
from fractions import Fraction as F
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.arrays import convert, elementary, exact_unit
from twistwrench.spatial._quaternions import exact_rotation
from twistwrench.spatial.rotation import quaternion_to_rotation

from ..robots import shared

TWO = tw.chain(2)
QUARTER = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])


def fractions(*shape, seed=0):
    """Draw fractions whose floats are exact."""
    return convert(np.random.default_rng(seed).integers(-9, 10, shape) / 4, object)


def same(exact, floats):
    assert exact.dtype == object
    assert all(isinstance(one, F | int) for one in exact.flat)
    np.testing.assert_allclose(exact.astype(float), floats, rtol=1e-14, atol=1e-14)


# ---------------------------------------------------------------- the algebra


def test_the_products_of_the_algebra_keep_fractions():
    V, W, c = fractions(6), fractions(6, seed=1), fractions(3, seed=2)
    v, w = V.astype(float), W.astype(float)
    for function in (tw.cross_motion, tw.cross_force, tw.hat):
        same(function(V), function(v))
    same(tw.skew(c), tw.skew(c.astype(float)))
    T, t = tw.SE3(convert(QUARTER, object), c), tw.SE3(QUARTER, c.astype(float))
    for exact, floats in ((T @ T.inverse() @ T, t), (T, t)):
        same(exact.motion_transform(), floats.motion_transform())
        same(exact.force_transform(), floats.force_transform())
        same(exact.act(c), floats.act(c.astype(float)))
    assert (T @ T.inverse()).matrix().tolist() == np.eye(4).tolist()
    body = tw.SpatialInertia(F(1, 3), c, convert(np.diag([1, 2, 3]) / 8, object)).transform(T)
    assert body.mass == F(1, 3)
    same(body.matrix(), tw.SpatialInertia(1 / 3, c.astype(float), np.diag([1, 2, 3]) / 8).transform(t).matrix())
    same(np.array(tw.power(W, V)), tw.power(w, v))
    assert (tw.Twist(V) + tw.Twist(W)).vector.tolist() == (V + W).tolist()


def test_a_quaternion_of_fractions_is_a_rotation_exactly():
    for seed in range(5):
        floats = tw.exp3(np.random.default_rng(seed).standard_normal(3))
        exact = exact_rotation(floats)
        assert (exact.T @ exact).tolist() == np.eye(3).tolist()
        assert abs(exact.astype(float) - floats).max() < 1e-15
    assert exact_rotation(tw.exp3([0, 0, np.pi / 2])).tolist() == QUARTER.tolist()  # 6e-17 is 0 here
    n = exact_unit(np.array([2, -1, 2]) / -3)
    assert (n * n).sum() == 1
    assert abs(n.astype(float) - np.array([2, -1, 2]) / -3).max() < 1e-15


def test_checks_look_at_what_has_a_value():
    with pytest.raises(tw.ShapeError, match=r"rotation: expected a rotation matrix, got \|RᵀR − 1\| = 3"):
        tw.SE3(convert(2 * np.eye(3), object), [0, 0, 0])
    with pytest.raises(tw.ModelError, match=r"mass: expected no negative mass, got -0\.5 kg"):
        tw.SpatialInertia(F(-1, 2), [0, 0, 0], np.eye(3))
    with pytest.raises(tw.SingularError, match="zero quaternion"):
        quaternion_to_rotation([F(0)] * 4)


# ---------------------------------------------------------------- the algorithms


def test_fractions_pass_through_the_algorithms():
    lift, box = tw.Builder("lift"), np.eye(3) / 8
    lift.link("stage", parent="base_link", joint=tw.Prismatic("z"), inertia=tw.SpatialInertia(2.0, [0, 0, 0.5], box))
    lift.link("hand", parent="stage", joint=tw.Prismatic("x"), inertia=tw.SpatialInertia(0.5, [0, 0, 0], box))
    model = lift.build()
    q, v, a = fractions(2), fractions(2, seed=1), fractions(2, seed=2)
    same(tw.rnea(model, q, v, a), tw.rnea(model, *(x.astype(float) for x in (q, v, a))))
    assert tw.rnea(model, [0, 0], [0, 0], [F(1, 3), 0])[0] == F(5, 2) * (F(1, 3) - F(-9.81))


def test_the_same_numbers_as_fractions_and_as_floats():
    q, v, a = [F(0), F(0)], [F(1, 3), F(2)], [F(1), F(1, 7)]
    floats = [np.array(x, float) for x in (q, v, a)]
    same(tw.rnea(TWO, q, v, a), tw.rnea(TWO, *floats))
    same(tw.crba(TWO, q), tw.crba(TWO, floats[0]))
    same(tw.forward_kinematics(TWO, q, v, a).acceleration, tw.forward_kinematics(TWO, *floats).acceleration)


def test_the_mass_matrix_of_the_double_pendulum_is_a_formula():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    q = sympy.symbols("q1 q2")
    M = sympy.Matrix(tw.crba(TWO, q)).applyfunc(sympy.trigsimp)
    tip = M[1, 1]
    expected = sympy.Matrix(
        [[2 * tip + 1 + sympy.cos(q[1]), tip + sympy.cos(q[1]) / 2], [tip + sympy.cos(q[1]) / 2, tip]]
    )
    assert sympy.simplify(M - expected) == sympy.zeros(2, 2)
    at = {q[0]: 0.3, q[1]: -0.8}
    np.testing.assert_allclose(np.array(M.subs(at), float), tw.crba(TWO, [0.3, -0.8]), rtol=1e-14)


@pytest.mark.parametrize("page", ["README.md", "README.zh-CN.md"])
def test_the_formula_of_the_readme_is_what_comes_out(page):
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    text = (Path(__file__).parents[2] / page).read_text(encoding="utf-8")
    line, *entries = re.search(r"`(sympy\.simplify\(.*\))`" + 3 * r"[^`]*`([^`]*)`", text).groups()
    M = eval(line, {"tw": tw, "sympy": sympy})
    assert [str(M[0, 0]), str(M[1, 1]), str(M[0, 1])] == entries
    assert M[0, 1] == M[1, 0]


def test_beside_symbols_a_float_is_its_shortest_decimal_and_beside_fractions_itself():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    screw, mass = tw.Builder("screw"), tw.SpatialInertia(0.3, [0.1, 0, 0], np.eye(3) / 100)
    screw.link("nut", parent="base_link", joint=tw.Helical([0.6, 0, 0.8], 0.1), inertia=mass, armature=0.1)
    model, x = screw.build(), sympy.Symbol("x")
    # I_c + m pitch² + m (0.1 · 0.8)² + armature
    assert tw.crba(model, [x]).tolist() == [
        [F("0.01") + F("0.3") * F("0.1") ** 2 + F("0.3") * F("0.08") ** 2 + F("0.1")]
    ]
    assert sympy.simplify(tw.newton_euler_3d.mass_matrix(model, [x])[0, 0]) == F("0.11492")
    exact = tw.crba(model, [F(0)])[0, 0]
    assert exact != F("0.11492")
    assert float(exact) == pytest.approx(0.11492, rel=1e-15)
    assert tw.crba(TWO, [F(0), F(0)])[1, 1] != tw.crba(TWO, [x, 0])[1, 1]  # each has constants of its own
    assert tw.Twist([x, 0.1, 0, 0, 0, 0]).vector[1] == F(1, 10)
    assert tw.Twist([F(1), 0.1, 0, 0, 0, 0]).vector[1] == F(0.1)
    turns, slides = tw.Twist([x, 0, 0, 0, 0, 0]), tw.Twist([0.1, 0, 0, 0, 0, 0.3])
    assert [(turns + slides).vector[0] - x, (slides - turns).vector[5]] == [sympy.Rational(1, 10), F(3, 10)]


def test_one_symbol_anywhere_in_the_state_makes_decimals_of_all_constants():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    model, (v, a) = shared("double_pendulum"), sympy.symbols("v a")
    tip = F("0.1201")
    assert sympy.expand(tw.rnea(model, [0, 0], [0, 0], [0, a])[1]) == sympy.Rational(tip) * a
    assert sympy.expand(tw.kinetic_energy(model, [0, 0], [0, v])) == sympy.Rational(tip) / 2 * v**2
    for x in tw.point_acceleration(model, [0, 0], [0, v], [0, a], "lower", [0.1, 0, 0]):
        assert all(number.q < 1000 for number in sympy.sympify(x).atoms(sympy.Rational))


def test_functions_of_time_are_numbers_as_symbols_are():
    """Their types have no `__module__`: SymPy makes one for each function."""
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    mechanics = pytest.importorskip("sympy.physics.mechanics")
    model, q, t = shared("double_pendulum"), sympy.symbols("q1 q2"), mechanics.dynamicsymbols("q1 q2")
    of_time = dict(zip(q, t))
    for function in (tw.gravity, tw.crba, tw.newton_euler_3d.gravity):
        assert sympy.Matrix(function(model, q)).subs(of_time) == sympy.Matrix(function(model, t))
    f = t[0]
    assert tw.skew([f, 0, 0])[2, 1] == f
    assert tw.hat([f] * 6)[0, 3] == tw.cross_motion([f] * 6)[2, 1] == f
    assert tw.SE3(np.eye(3), [f, 0, 0]).translation[0] == tw.Twist([f] * 6).vector[5] == f
    assert tw.SpatialInertia(f, [0, 0, 0], np.eye(3)).matrix()[5, 5] == f
    with pytest.raises(ValueError, match=r"w: expected floating-point numbers, got q1\(t\)"):
        tw.exp3([f, 0, 0])


def test_bias_forces_of_symbols_are_lagranges():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    q, v, a = (np.array(sympy.symbols(f"{name}1 {name}2")) for name in "qva")
    M, g = sympy.Matrix(tw.crba(TWO, q)), sympy.Matrix(tw.gravity(TWO, q))
    energy = (sympy.Matrix(v).T * M * sympy.Matrix(v))[0] / 2
    left = sympy.Matrix(tw.rnea(TWO, q, v, a)) - g
    for k in range(2):
        momentum = sympy.diff(energy, v[k])
        rate = sum(sympy.diff(momentum, x) * y for x, y in zip((*q, *v), (*v, *a)))
        assert sympy.simplify(left[k] - rate + sympy.diff(energy, q[k])) == 0


# ---------------------------------------------------------------- what is not let in


@pytest.mark.parametrize(
    ("bad", "said"),
    [
        (None, "expected numbers, got None"),
        ("1/3", "expected numbers, got '1/3'"),
        (True, "expected numbers, got True"),
        (Decimal("0.1"), r"expected a fraction .* got Decimal\('0.1'\)"),
        (1j, "expected no complex number beside exact ones, got 1j"),
        (np.inf, "expected finite numbers, got inf"),
        (tw.Twist(np.zeros(6)), "expected numbers, got Twist"),
    ],
    ids=repr,
)
def test_what_is_no_number_is_refused_beside_fractions(bad, said):
    x = np.empty(2, object)
    x[:] = [F(1, 3), 0]
    x[1] = bad
    with pytest.raises(ValueError, match=rf"^q: {said}.* at index \(1,\)$"):
        tw.crba(TWO, x)


def test_numbers_that_do_not_mix_with_fractions_are_refused():
    class Alone:
        """A number, as CasADi's are, that is added to floats only."""

        __neg__ = __radd__ = __rsub__ = __rmul__ = __rtruediv__ = lambda *_: NotImplemented

    with pytest.raises(
        ValueError, match=r"^q: expected numbers that can be added to fractions, got .* at index \(0,\)"
    ):
        tw.crba(TWO, np.array([Alone(), 0], object))


def test_symbols_that_are_not_finite_are_refused():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed")
    for bad in (sympy.oo, sympy.nan, sympy.zoo):
        with pytest.raises(ValueError, match="q: expected finite numbers"):
            tw.crba(TWO, [bad, 0])


def test_a_wrench_on_the_world_is_refused_whatever_its_numbers():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed")
    f_ext = np.zeros((3, 6), object)
    for one in (F(1, 3), sympy.Symbol("f")):
        f_ext[0, 2] = one
        with pytest.raises(ValueError, match="f_ext: row 0"):
            tw.rnea(TWO, [F(0), 0], [0, 0], [0, 0], f_ext)


def test_a_quaternion_of_fractions_may_have_any_length_but_zero():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed")
    go2, q = shared("go2"), [F(0)] * 19
    for zero in (F(0), sympy.Integer(0)):
        q[3:7] = [zero] * 4
        with pytest.raises(
            ValueError, match=r"^q: q\[3:7\] is zero, no direction; model\.neutral\(\) has the identity"
        ):
            tw.crba(go2, q)
    with pytest.raises(ValueError, match=r"q\[3:7\] is zero at index \(1,\), no direction"):
        tw.crba(go2, np.array([[*q[:6], F(2), *q[7:]], q], object))
    q[6] = F(2)
    same(tw.crba(go2, q), tw.crba(go2, go2.neutral()))


def test_functions_of_floats_say_so():
    for call in (
        lambda x: tw.exp3(x), lambda x: tw.exp6([*x, *x]), lambda x: tw.fast.crba(tw.chain(3), x),
        lambda x: tw.chain(3).integrate(x, x), lambda x: tw.screw(tw.Twist([*x, *x])),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=r"expected floating-point numbers, got Fraction\(1, 3\)"):
            call([F(1, 3)] * 3)


def test_a_fraction_has_only_the_functions_that_are_fractions():
    assert elementary("sqrt", F(9, 16)) == F(3, 4)
    assert (elementary("cos", 0), elementary("sin", F(0))) == (1, 0)
    for name, x in (("cos", F(1, 3)), ("sqrt", 2), ("sqrt", F(-1))):
        with pytest.raises(ValueError, match=rf"^the {name} of {x} is not a fraction"):
            elementary(name, x)
    with pytest.raises(ValueError, match=r"q: expected floating-point numbers, got an array of objects; \.astype"):
        tw.crba(TWO, np.array([0.1, 0.2], object))


def test_constants_that_are_symbols_are_named_where_floats_are_needed():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed")
    builder, symbol = tw.Builder("pendulum"), sympy.Symbol("l")
    rod = tw.SpatialInertia(1.0, [0, 0, -0.3], np.eye(3))
    unknown = {
        "placement": tw.SE3(np.eye(3), [0, 0, symbol]),
        "inertia": tw.SpatialInertia(symbol, [0, 0, 0], np.eye(3)),
    }
    for name, value in unknown.items():
        with pytest.raises(tw.ModelError, match=r"link 'rod': .* got symbols: .*l"):
            builder.link("rod", parent="base_link", joint=tw.Revolute("y"), **{name: value})
    root_two = tw.SE3(np.eye(3), [0, 0, sympy.sqrt(2)])  # has a value
    builder.link("rod", parent="base_link", joint=tw.Revolute("y"), inertia=rod, placement=root_two)
    assert builder.build().placement[1].translation[2] == np.sqrt(2)


def test_floats_of_q_have_a_cosine_beside_symbols_of_another_argument():
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not derived")
    model, q, a = shared("double_pendulum"), [0.1, 0.25], sympy.symbols("a1 a2")
    M, g = tw.crba(model, q), tw.gravity(model, q)
    for function in (tw.rnea, tw.newton_euler_3d.inverse_dynamics):
        tau = function(model, q, [0, 0], a)
        assert "cos(1/10)" in str(tau[0])
        parts = [[float(sympy.diff(one, x)) for x in a] for one in tau]
        np.testing.assert_allclose(parts, M, rtol=0, atol=1e-15)
        at_rest = [float(one.subs(dict.fromkeys(a, 0))) for one in tau]
        np.testing.assert_allclose(at_rest, g, rtol=0, atol=1e-14)

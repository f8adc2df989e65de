"""The fast way is right: against the truth in 50 digits, against Pinocchio, and against the textbook."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import twistwrench as tw
from twistwrench import bridge, fast
from twistwrench import newton_euler_3d as slow
from twistwrench.model import KINDS

from ..sampling import sampled
from ..strategies import BATCHES, Recipe, random_state, recipes
from ..truth import largest, skeel

WORSE = 2
"""How many times the error of the textbook is allowed."""

FEW = 8
"""Allowed besides: units of the resolution, of the size of the quantity or of its terms (of forward dynamics: of its
condition)."""

BIG_TREE = Recipe(40, seed=1, base="floating")


def by(package, model, s, contacts):
    """All quantities that the fast way offers, by it or by the textbook."""
    q, v, a, tau, f = s
    d = package.dynamics(model, q, v, contacts=contacts)
    return {
        "rnea": package.rnea(model, q, v, a),
        "rnea f_ext": package.rnea(model, q, v, a, f),
        "aba": package.aba(model, q, v, tau),
        "aba f_ext": package.aba(model, q, v, tau, f),
        "h alone": package.nonlinear_effects(model, q, v),
        "M alone": package.crba(model, q),
        "A_G alone": package.centroidal_map(model, q),
        "J_c alone": package.dynamics(model, q, v, contacts=contacts, want={"J_c"}).J_c,
        "M": d.M,
        "h": d.h,
        "J_c": d.J_c,
        "A_G": d.A_G,
    }


def truth(model, s, contacts):
    """The same in 50 digits."""
    q, v, a, tau, f = (slow.as_mpmath(x) for x in s)
    J = [slow.frame_jacobian(model, q, name, "local_world_aligned")[3:] for name in contacts]
    true = {
        "rnea": slow.inverse_dynamics(model, q, v, a),
        "rnea f_ext": slow.inverse_dynamics(model, q, v, a, f),
        "aba": slow.forward_dynamics(model, q, v, tau),
        "aba f_ext": slow.forward_dynamics(model, q, v, tau, f),
        "h": slow.nonlinear_effects(model, q, v),
        "M": slow.mass_matrix(model, q),
        "J_c": np.concatenate([slow.as_mpmath(np.zeros((0, model.nv))), *J]),
        "A_G": slow.centroidal_map(model, q),
    }
    return true | {f"{name} alone": true[name] for name in ("h", "M", "J_c", "A_G")}


def assert_as_good(model, s, contacts, *, few=FEW):
    """No error is above `WORSE` times the textbook's and `few` units of the resolution."""
    one, book, true = by(fast, model, s, contacts), by(tw, model, s, contacts), truth(model, s, contacts)
    many = by(fast, model, type(s)(*(np.stack([x] * 10) for x in s)), contacts)  # so many that vectors are full
    for name, right in true.items():
        assert one[name].shape == book[name].shape == many[name].shape[1:]
        assert one[name].dtype == many[name].dtype == book[name].dtype == s.q.dtype
        errors = [largest(slow.as_mpmath(x) - right) for x in (one[name], many[name][3])]
        error, textbook = max(errors), largest(slow.as_mpmath(book[name]) - right)
        size = largest(right)
        if name.startswith(("h", "rnea")):  # the terms may cancel
            size += model.mass * 9.81 + largest(true["M"]) * (largest(s.v) ** 2 + largest(s.a) * (name[0] == "r"))
        if name.startswith("J"):  # a lever arm of about a metre may be turned about itself
            size += 1
        lost = 1.0
        if name.startswith("aba"):
            h = true["h"] + (true["rnea f_ext"] - true["rnea"] if name.endswith("f_ext") else 0)
            lost = skeel(true["M"], right, s.tau, h)
        bound = WORSE * textbook + few * float(np.finfo(s.q.dtype).eps) * size * lost
        assert error <= bound, f"{name}: error {error:.2g}, the textbook's {textbook:.2g}, of {size:.2g}"


# ---------------------------------------------------------------- the truth


@pytest.mark.parametrize("recipe", sampled([Recipe(n, seed=1, base="floating") for n in (3, 5, 1)], 1), ids=str)
def test_errors_are_within_twice_those_of_the_textbook(recipe):
    assert_as_good(recipe.model, recipe.state(), [recipe.frame(), recipe.model.frame_names[-1]])


@pytest.mark.slow
@given(recipes(10))
@settings(max_examples=2, deadline=None)
def test_so_they_are_without_machine_code(recipe):
    """The same operations, so that more robots can be tried: nothing is compiled."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("straightline.llvm.available", lambda: False)
        assert_as_good(recipe.model, recipe.state(), [recipe.frame(), recipe.model.frame_names[-1]])


@pytest.mark.slow
@given(recipes(25), st.sampled_from([np.float64, np.float32, np.longdouble]))
@example(BIG_TREE, np.float64)
@settings(max_examples=3, deadline=None)
def test_errors_are_within_twice_those_of_the_textbook_at_length(recipe, dtype):
    assert_as_good(recipe.model, recipe.state(dtype=dtype), [recipe.frame(), recipe.model.frame_names[-1]])


@pytest.mark.slow
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble])
def test_so_they_are_in_other_number_types(dtype):
    recipe = Recipe(5, seed=3, base="floating")
    # A program keeps an axis as fractions of norm 1, which have the digits that its doubles had.
    few = max(FEW, 2.0**-53 / float(np.finfo(dtype).eps))
    assert_as_good(recipe.model, recipe.state(dtype=dtype), [recipe.frame()], few=few)


@pytest.mark.slow
@pytest.mark.parametrize("dtype", sampled([np.float64, np.float32], 1))
def test_so_they_are_a_thousand_kilometres_from_the_origin(dtype):
    """There float64 has nine decimals of a metre left, and float32 none: nothing may depend on where the robot is."""
    model = tw.load("go2")
    s = random_state(model, rng=1, dtype=dtype)
    s.q[:3] = [1e6, -1e6, 1e6]
    assert_as_good(model, s, model.feet)


@pytest.mark.one_case
@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_so_they_are_where_the_base_stands_a_thousand_kilometres_away(base):
    """Here the placement of the first joint says so, for an arm and for a free-flyer on a fixed base."""
    builder = tw.Builder("far", base="fixed")
    rod = tw.SpatialInertia(1.0, [0.1, 0.2, 0.3], np.diag([0.2, 0.3, 0.4]))
    far = tw.SE3(tw.exp3([0.3, -0.4, 0.5]), [1e6, -1e6, 1e6])
    joint = tw.Revolute([1, 2, 3]) if base == "fixed" else tw.FreeFlyer()
    builder.link("one", parent="base_link", joint=joint, placement=far, inertia=rod)
    builder.link("two", parent="one", joint=tw.Revolute("y"), placement=tw.SE3(np.eye(3), [0, 0, 1.0]), inertia=rod)
    builder.link("three", parent="two", joint=tw.Prismatic("x"), inertia=rod)
    model = builder.build()
    assert_as_good(model, random_state(model, rng=1), ["three"])


@pytest.mark.slow
@pytest.mark.parametrize("off", sampled([1e-3, 1e-2, 1e-5], 1))
def test_so_they_are_near_gimbal_lock(off):
    """Three turns at one point, nothing but the last with inertia, the middle one almost a right angle."""
    builder = tw.Builder("gimbal", base="fixed")
    rod = tw.SpatialInertia(1.0, [0.1, 0.2, 0.3], np.diag([0.2, 0.3, 0.4]))
    for parent, name, axis in (("base_link", "outer", "x"), ("outer", "middle", "y"), ("middle", "rod", "z")):
        body = rod if name == "rod" else tw.SpatialInertia.zero()
        builder.link(name, parent=parent, joint=tw.Revolute(axis), inertia=body)
    model = builder.build()
    s = random_state(model, rng=0)
    s.q[1] = np.pi / 2 - off
    assert_as_good(model, s, ["rod"])


# ---------------------------------------------------------------- Pinocchio


@pytest.mark.parametrize("name", sampled(["go2", "humanoid", "planar_arm", "cart_pole"], 2))
def test_every_quantity_is_pinocchios(name):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model = tw.load(name)
    there = bridge.to_pinocchio_model(model)
    data, s = there.createData(), random_state(model, rng=0, batch=(20,))
    d, tau = fast.dynamics(model, s.q, s.v, contacts=()), fast.rnea(model, s.q, s.v, s.a)
    qdd = fast.aba(model, s.q, s.v, s.tau)
    for k, q in enumerate(s.q):
        v, a, tau_in = (bridge.to_pinocchio_tangent(model, x[k]) for x in (s.v, s.a, s.tau))
        theirs = {
            "M": (d.M[k], bridge.from_pinocchio_matrix(model, pin.crba(there, data, q))),
            "h": (d.h[k], bridge.from_pinocchio_tangent(model, pin.nonLinearEffects(there, data, q, v))),
            "A_G": (d.A_G[k], bridge.from_pinocchio_jacobian(model, pin.computeCentroidalMap(there, data, q))),
            "rnea": (tau[k], bridge.from_pinocchio_tangent(model, pin.rnea(there, data, q, v, a))),
            "aba": (qdd[k], bridge.from_pinocchio_tangent(model, pin.aba(there, data, q, v, tau_in))),
        }
        for what, (ours, right) in theirs.items():
            bound = 1e-12 if what != "aba" else 1e-15 * np.linalg.cond(d.M[k])  # what an inverse may lose
            np.testing.assert_allclose(ours, right, rtol=0, atol=bound * np.abs(right).max(), err_msg=what)


# ---------------------------------------------------------------- the textbook


def assert_same(model, s, contacts, *, rtol=1e-12):
    ours, book = by(fast, model, s, contacts), by(tw, model, s, contacts)
    for name, right in book.items():
        assert ours[name].dtype == right.dtype
        assert ours[name].shape == right.shape
        size = np.abs(right).max(initial=0)
        bound = rtol * (1e4 if name.startswith("aba") else 1)  # conditions up to 1e4, each held to its own above
        np.testing.assert_allclose(ours[name], right, rtol=0, atol=bound * size, err_msg=name)


@pytest.mark.slow
@pytest.mark.parametrize("batch", BATCHES)
@pytest.mark.parametrize("base", sampled(["floating", "fixed"], 1))
def test_any_batch_shape_works(batch, base):
    recipe = Recipe(5, seed=4, base=base)
    assert_same(recipe.model, recipe.state(batch), [recipe.frame()])


@pytest.mark.slow  # a program for each, 80 s; every kind is among the random trees
@pytest.mark.parametrize("base", ["fixed", "floating"])
@pytest.mark.parametrize("kind", KINDS)
def test_any_joint_works_anywhere(kind, base):
    recipe = Recipe(7, seed=5, base=base, kinds=(kind,))
    for batch in ((), (12,)):
        assert_same(recipe.model, recipe.state(batch), list(recipe.model.frame_names))


@pytest.mark.slow
def test_a_joint_on_its_own_works():
    for kind in KINDS:
        recipe = Recipe(1, kinds=(kind,))
        for batch in ((), (12,)):
            assert_same(recipe.model, recipe.state(batch), list(recipe.model.frame_names))


@pytest.mark.slow
def test_two_robots_in_one_model_work():
    """Two free-flyers on the world: neither is the base."""
    builder = tw.Builder("two", base="fixed")
    for name in ("left", "right"):
        rod = tw.SpatialInertia(1.0, [0.1, 0.2, 0.3], np.diag([0.2, 0.3, 0.4]))
        builder.link(name, parent="base_link", joint=tw.FreeFlyer(), inertia=rod)
        builder.link(f"{name} arm", parent=name, joint=tw.Revolute([1, 2, 3]), inertia=rod)
    model = builder.build()
    for batch in ((), (12,)):
        assert_same(model, random_state(model, rng=0, batch=batch), ["left arm", "right", "base_link"])


@pytest.mark.slow
@pytest.mark.parametrize("dtype", sampled([np.complex128, np.complex64, np.clongdouble], 1))
def test_complex_numbers_pass_through(dtype):
    """To the resolution of the type, times what forward dynamics of this tree loses."""
    recipe = Recipe(6, seed=2, base="floating")
    assert_same(recipe.model, recipe.state((2,), dtype), [recipe.frame()], rtol=2000 * float(np.finfo(dtype).eps))


def test_a_complex_step_gives_the_derivative():
    model = tw.load("go2")
    s = random_state(model, rng=0)
    along = fast.nonlinear_effects(model, s.q, s.v + 1e-100j * s.a).imag / 1e-100
    quadratic = 2 * (fast.nonlinear_effects(model, s.q, s.v + s.a) - fast.nonlinear_effects(model, s.q, s.v - s.a)) / 4
    np.testing.assert_allclose(along, quadratic, rtol=0, atol=1e-12 * np.abs(along).max())  # h is quadratic in v


@pytest.mark.slow
def test_thirty_contacts_of_a_long_robot_have_the_rows_of_the_textbook():
    model, (q, v, *_) = BIG_TREE.model, BIG_TREE.state()
    contacts = model.frame_names[-30:]
    J_c = fast.dynamics(model, q, v, contacts=contacts).J_c
    np.testing.assert_allclose(J_c, tw.dynamics(model, q, v, contacts=contacts).J_c, rtol=0, atol=1e-13)


@pytest.mark.slow
def test_the_mass_matrix_is_symmetric_to_the_last_bit():
    for recipe in (BIG_TREE, Recipe(20, seed=7)):
        for batch in ((), (12,)):
            M = fast.crba(recipe.model, recipe.state(batch).q)
            assert (M.mT == M).all()


@pytest.mark.slow
def test_power_is_the_rate_of_energy():
    """vᵀ M v̇ + vᵀ h = vᵀ τ, with the three of them computed for themselves."""
    recipe = Recipe(15, seed=8, base="floating")
    s = recipe.state((50,))
    M, h = fast.crba(recipe.model, s.q), fast.nonlinear_effects(recipe.model, s.q, s.v)
    tau = fast.rnea(recipe.model, s.q, s.v, s.a)
    np.testing.assert_allclose((s.v * (np.matvec(M, s.a) + h)).sum(-1), (s.v * tau).sum(-1), rtol=1e-11)


# ---------------------------------------------------------------- long chains


@pytest.mark.slow
@pytest.mark.parametrize("count", sampled([10, 1], 1))
@pytest.mark.parametrize("base", sampled(["floating", "fixed"], 1))
def test_long_chains_lose_no_digits_against_the_textbook(base, count):
    """Three hundred links, slightly bent and moving; the textbook in long double is the truth."""
    if np.finfo(np.longdouble).eps >= np.finfo(float).eps:
        pytest.skip("long double is double on this platform: there is no truth to compare with")
    model = tw.chain(300, base=base, axis=[1.0, 2.0, -1.0])
    rng = np.random.default_rng(0)
    q = model.integrate(model.neutral(), 0.02 * rng.standard_normal(model.nv))
    v, a = 0.01 * rng.standard_normal((2, model.nv))
    exact = [x.astype(np.longdouble) for x in (q, v, a)]
    many = [np.stack([x] * count) for x in (q, v, a)]
    for name in ("rnea", "aba", "crba", "centroidal_map"):
        right, book, ours = (
            CALLED[name](package, model, *state) for package, state in ((tw, exact), (tw, (q, v, a)), (fast, many))
        )
        size = float(np.abs(right).max())
        error, textbook = (float(np.abs(x - right).max()) / size for x in (ours[-1], book))
        # Both are the textbook's here; in a batch NumPy adds up products in another order, and aba has lost 7 digits.
        assert error <= 2 * WORSE * textbook + FEW * 2**-52, f"{name}: {error:.2g}, the textbook's {textbook:.2g}"


CALLED = {
    "rnea": lambda package, model, q, v, a: package.rnea(model, q, v, a),
    "aba": lambda package, model, q, v, a: package.aba(model, q, v, a),
    "crba": lambda package, model, q, v, a: package.crba(model, q),
    "centroidal_map": lambda package, model, q, v, a: package.centroidal_map(model, q),
}

"""What is compiled beyond the recursions: M⁻¹, LᵀDL, Λ, articulated inertias, Ȧ_G, I_G, v_G, a_G and subtrees.

A program in mpmath's numbers has all digits of a formula: here 38 of the textbook's are held against 3-D vectors.
"""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from straightline.llvm import available
from twistwrench import newton_euler_3d as slow
from twistwrench.algorithms.subtree import outboard
from twistwrench.model import KINDS
from twistwrench.newton_euler_3d.bodies import cross

from ..invariants import body_frame
from ..sampling import sampled
from ..strategies import Recipe

OF_Q = ("M_inv", "L", "D", "Lambda_inv", "Lambda", "IA", "I_G", "p_S", "A_S", "I_S")
TOOLBOX = (*OF_Q, "M_inv_tau", "dA_G", "v_G", "a_G")
FEW, EVERY_KIND = Recipe(2, seed=5, base="floating", kinds=("helical",)), Recipe(7, 129, "floating")
TREES = pytest.mark.parametrize("recipe", sampled([FEW, EVERY_KIND], 1), ids=["few", "every kind"])
CASES = sampled([(np.float64, "llvm"), (np.float64, "numpy"), (np.float32, "llvm"), (np.float32, "numpy")], 1)


def together(model):
    return {"contacts": model.joint_names[2:3], "frames": model.joint_names[1:3]}


def test_the_larger_tree_has_every_kind_of_joint():
    assert {joint.kind for joint in EVERY_KIND.model.joints[1:]} == {*KINDS}


def textbook(model, s):
    q, v, a = s.q, s.v, s.a
    parts = [tw.subtree(model, q, name) for name in model.joint_names[1:3]]
    J = tw.contact_jacobian(model, q, model.joint_names[2:3])
    L, D = tw.ltdl(model, q)
    return {
        "M_inv": tw.inverse_mass_matrix(model, q),
        "L": L,
        "D": D,
        "M_inv_tau": tw.solve_mass_matrix(model, q, s.tau),
        "Lambda_inv": tw.delassus_matrix(model, q, J),
        "Lambda": tw.operational_space_inertia(model, q, J),
        "IA": np.stack([tw.articulated_inertia(model, q, name) for name in model.joint_names[1:3]], axis=-3),
        "dA_G": tw.centroidal_map_rate(model, q, v),
        "I_G": tw.centroidal_inertia(model, q),
        "v_G": tw.center_of_mass_velocity(model, q, v),
        "a_G": tw.center_of_mass_acceleration(model, q, v, a),
        "p_S": np.stack([part.center_of_mass for part in parts], axis=-2),
        "A_S": np.stack([part.momentum_map for part in parts], axis=-3),
        "I_S": np.stack([part.inertia for part in parts], axis=-3),
    }


@TREES
@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case[0].__name__} {case[1]}")
def test_programs_are_the_textbook_in_batches_and_number_types(recipe, case):
    dtype, backend = case
    if backend == "llvm" and not available():
        pytest.skip("llvmlite is not installed: no machine code")
    model, eps = recipe.model, np.finfo(dtype).eps
    program = tw.compile(model, TOOLBOX, **together(model), backend=backend, dtype=dtype)
    for batch in ((), (3, 2)):
        s = recipe.state(batch, dtype)
        got, expected = program(s.q, s.v, s.a, s.tau), textbook(model, s)
        lost = np.linalg.cond(tw.crba(model, s.q).astype(float)).max()
        for name in TOOLBOX:
            x, y = getattr(got, name), expected[name]
            assert (x.shape, x.dtype) == (y.shape, dtype), name
            bound = (10 * lost if name in ("M_inv", "L", "D", "M_inv_tau", "Lambda_inv", "Lambda") else 200) * eps
            np.testing.assert_allclose(x, y, rtol=0, atol=bound * np.abs(y).max(), err_msg=name)


def vectors(model, q, bodies):
    """Centre, momentum map and inertia of some bodies, by 3-D vectors in mpmath's numbers."""
    R, p = slow.placements(model, q)
    parts = []
    for i in bodies:
        body, J = model.inertia[i], slow.frame_jacobian(model, q, body_frame(model, i), "local_world_aligned")
        r, I_c = R[i] @ slow.as_mpmath(body.com), R[i] @ slow.as_mpmath(body.inertia_at_com) @ R[i].T
        parts.append((mpmath.mpf(float(body.mass)), p[i] + r, I_c, J[:3], J[3:] - cross(r, J[:3])))
    mass = sum(part[0] for part in parts)
    G = sum(m * c for m, c, *_ in parts) / mass
    turning = sum(I_c @ w + m * cross(c - G, v) for m, c, I_c, w, v in parts)
    about_G = sum(I_c + m * (((d := c - G) @ d) * np.eye(3, dtype=int) - np.outer(d, d)) for m, c, I_c, *_ in parts)
    inertia = np.block([[about_G, np.zeros((3, 3), int)], [np.zeros((3, 3), int), mass * np.eye(3, dtype=int)]])
    return mass, G, np.concatenate([turning, sum(m * v for m, _, _, _, v in parts)]), inertia


@TREES
def test_the_formulas_are_right_to_fifty_digits(recipe):
    model = recipe.model
    with mpmath.workdps(50):
        q, v, a, tau = (slow.as_mpmath(x) for x in recipe.state()[:4])
        got = tw.compile(model, TOOLBOX, **together(model), dtype="mpmath")(q, v, a, tau)

        def off(x, y):
            return max(abs(one) for one in np.ravel(x - y)) / max(abs(one) for one in np.ravel(y))

        def inverse(M):
            return np.array((mpmath.matrix(M.tolist()) ** -1).tolist(), object).reshape(M.shape)

        M = slow.mass_matrix(model, q)
        M_inv = inverse(M)
        J = slow.frame_jacobian(model, q, model.joint_names[2], "local_world_aligned")[3:]
        base = slow.frame_jacobian(model, q, "root_joint")
        right = {
            "M_inv": (got.M_inv, M_inv),
            "LᵀDL": (got.L.T @ (got.D[:, None] * got.L), M),
            "M_inv_tau": (got.M_inv_tau, M_inv @ tau),
            "Lambda_inv": (got.Lambda_inv, J @ M_inv @ J.T),
            "Lambda": (got.Lambda, inverse(J @ M_inv @ J.T)),
            "IA of the base": (got.IA[0], inverse(base @ M_inv @ base.T)),
        }
        for k, name in enumerate(model.joint_names[1:3]):
            _, G, A, inertia = vectors(model, q, outboard(model.parent, model.frame(name).body))
            right |= {f"p_S {k}": (got.p_S[k], G), f"A_S {k}": (got.A_S[k], A), f"I_S {k}": (got.I_S[k], inertia)}
        mass, _, A, inertia = vectors(model, q, range(1, model.nbodies))
        rate = slow.centroidal_momentum_rate(model, q, v, a)
        right |= {
            "I_G": (got.I_G, inertia),
            "v_G": (got.v_G, (A @ v)[3:] / mass),
            "a_G": (got.a_G, rate[3:] / mass),
            "dA_G v": (A @ a + got.dA_G @ v, rate),
        }
        errors = {name: float(off(*pair)) for name, pair in right.items()}
    assert max(errors.values()) < 1e-35, errors  # an oblique axis is a unit vector to 38 digits


def test_states_without_an_answer_are_the_textbooks():
    """A stretched knee, and a wrist in gimbal lock: the program sounds the alarm, and the textbook names it."""
    arm = tw.load("planar_arm")
    program = tw.compile(arm, "Lambda", contacts=[tw.SlidingContact("tool", [[1, 0, 0], [0, 0, 1]])])
    assert np.isfinite(program([0.3, 0.4, 0.5])).all()
    with pytest.raises(tw.SingularError, match=r"J: its rows depend on each other at index \(1,\)"):
        program([[0.3, 0.4, 0.5], [0.3, 0.0, 0.0]])
    builder, body = tw.Builder("gimbal"), tw.SpatialInertia.from_sphere(1.0, 0.1)
    for name, parent, axis in (("a", "base_link", "z"), ("b", "a", "y"), ("c", "b", "z")):
        builder.link(name, parent=parent, joint=tw.Revolute(axis), inertia=body if name == "c" else None)
    model = builder.build()
    for want in ("M_inv", "M_inv_tau", "L"):
        program = tw.compile(model, want)
        with pytest.raises(tw.SingularError, match=r"joint .a.: with its outboard|M is singular at joint .a."):
            program(np.zeros(3), *[np.ones(3)] * (len(program.arguments) - 1))


@pytest.mark.slow
def test_derivatives_and_symbols_come_with_them():
    """∂M⁻¹ = −M⁻¹ ∂M M⁻¹ of a program; and M⁻¹ τ of symbols, which no check can look at."""
    model, q = tw.load("planar_arm"), np.array([0.3, -0.7, 0.4])
    got = tw.compile(model, ["M_inv", "dM_inv_dq", "dM_dq"])(q)
    expected = -np.einsum("ij,jkn,kl->iln", got.M_inv, got.dM_dq, got.M_inv)
    np.testing.assert_allclose(got.dM_inv_dq, expected, rtol=0, atol=1e-13 * np.abs(expected).max())
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: no symbols")
    a, b = sympy.symbols("a b", real=True)
    model, zero = tw.load("double_pendulum"), Fraction(0)
    x = tw.solve_mass_matrix(model, np.array([a, b], object), np.array([1, zero], object))
    at = {a: 0.3, b: -0.8}
    np.testing.assert_allclose(
        [float(one.subs(at)) for one in x], tw.solve_mass_matrix(model, [0.3, -0.8], [1, 0]), rtol=0, atol=1e-14
    )

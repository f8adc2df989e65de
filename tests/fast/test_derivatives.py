"""Derivatives: against closed forms, laws of mechanics, complex steps, 50 digits, and Pinocchio."""

from functools import cache

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from straightline.llvm import available
from straightline.number import Tape, numbers
from straightline.tangent import jacobian
from twistwrench import compile
from twistwrench import newton_euler_3d as slow
from twistwrench.fast.derivatives import of_line, steps
from twistwrench.fast.quantities import quantities
from twistwrench.fast.quantity import Quantity, shapes
from twistwrench.fast.recording import record
from twistwrench.model import KINDS

from ..pages import blocks, page
from ..sampling import sampled
from ..strategies import random_state

BACKENDS = [
    pytest.param("llvm", marks=pytest.mark.skipif(not available(), reason="llvmlite is not installed")),
    "numpy",
]
MODELS = {
    "floating": tw.random_tree(4, rng=2, base="floating"),
    "go2": tw.load("go2"),
    **{kind: tw.random_tree(3, rng=7, kinds=(kind,)) for kind in KINDS},
    "fixed": tw.random_tree(5, rng=1),
}
every_model = pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
some_models = pytest.mark.parametrize("model", sampled(MODELS.values(), 2), ids=MODELS)


@cache
def program(model, *want, **options):
    return compile(model, want[0] if len(want) == 1 else want, **{"backend": "numpy", **options})


def close(got, expected, digits=1e-12):
    """Equal to 12 digits of the largest entry."""
    size = max(1.0, np.abs(expected).max(initial=0))
    np.testing.assert_allclose(got, expected, rtol=0, atol=digits * size)


# ---------------------------------------------------------------- closed forms


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_pendulum(backend):
    model = tw.load("pendulum")
    m, c, inertia = model.inertia[1].mass, 1.0, 1.0 + 0.001
    q, v, a, tau = np.array([[0.3], [0.5], [-0.7], [2.0]])
    known = program(model, "dtau_dq", "dtau_dv", "dqdd_dq", "dqdd_dv", "dqdd_dtau", "dg_dq", "dU_dq", backend=backend)
    found = known(q=q, v=v, a=a, tau=tau)
    slope = m * 9.81 * c * np.cos(q[0])
    for name, expected in {
        "dtau_dq": slope,
        "dtau_dv": 0,
        "dg_dq": slope,
        "dqdd_dq": -slope / inertia,
        "dqdd_dv": 0,
        "dqdd_dtau": 1 / inertia,
        "dU_dq": m * 9.81 * c * np.sin(q[0]),
    }.items():
        close(getattr(found, name).item(), expected, 1e-15)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_cart_pole(backend):
    model = tw.load("cart_pole")
    (_, theta), (_, rate), (push, turn) = q, v, a = np.array([[0.1, 0.4], [0.2, 1.5], [0.6, -0.8]])
    ml, s, c = 0.1 * 0.5, np.sin(theta), np.cos(theta)
    found = program(model, "dtau_dq", "dtau_dv", backend=backend)(q, v, a)
    close(found.dtau_dq, [[0, ml * (-turn * s - rate**2 * c)], [0, -ml * (push * s + 9.81 * c)]], 1e-15)
    close(found.dtau_dv, [[0, -2 * ml * rate * s], [0, 0]], 1e-15)


# ---------------------------------------------------------------- laws


@pytest.mark.one_case
@pytest.mark.parametrize("model", sampled([*MODELS.values()][1:], 3), ids=[*MODELS][1:])
def test_the_laws_of_mechanics(model):
    q, v, a, tau, _ = random_state(model, rng=3)
    of_forces = ("dtau_dq", "dtau_dv", "dtau_da", "dh_dq", "dh_dv", "dg_dq", "dqdd_dtau", "dM_dq")
    of_sums = ("dU_dq", "dT_dq", "dT_dv", "dp_G_dq", "dh_G_dq", "dh_G_dv")
    d = program(model, *of_forces, *of_sums)(q=q, v=v, a=a, tau=tau)
    M, C, A_G = tw.crba(model, q), tw.coriolis_matrix(model, q, v), tw.centroidal_map(model, q)
    close(d.dtau_da, M)
    close(d.dU_dq, tw.gravity(model, q))
    close(d.dT_dv, M @ v)
    close(d.dM_dq, d.dM_dq.swapaxes(0, 1))
    close(d.dM_dq @ v, C + C.T)  # the rate of M, and Ṁ − 2C skew
    close(d.dT_dq, np.einsum("ijk,i,j->k", d.dM_dq, v, v) / 2)
    close(d.dh_dv @ v, 2 * C @ v)  # h − g is a square in v
    close(d.dtau_dv, d.dh_dv)
    close(d.dtau_dq, d.dh_dq + np.einsum("ijk,j->ik", d.dM_dq, a))
    close(d.dp_G_dq * sum(I.mass for I in model.inertia[1:]), A_G[3:])
    close(d.dh_G_dv, A_G)
    close(d.dh_G_dq @ v, tw.centroidal_momentum_rate(model, q, v, 0 * a))  # Ȧ_G v
    close(d.dqdd_dtau @ M, np.eye(model.nv), 1e-12 * np.linalg.cond(M))  # an inverse loses what M is ill conditioned


def test_gravity_is_the_slope_of_a_potential():
    model = tw.random_tree(6, rng=4, kinds=("revolute", "prismatic", "helical"))
    H = program(model, "dg_dq")(random_state(model, rng=1).q)
    close(H, H.T)


def test_a_floating_base_does_not_feel_where_it_stands_nor_where_it_looks():
    model = MODELS["go2"]
    q, v, a, *_ = random_state(model, rng=5)
    dq = program(model, "dtau_dq")(q, v, a)
    assert not dq[:, 3:6].any()  # moved
    close(dq[:, :3], program(model, "dg_dq")(q)[:, :3])  # turned: only gravity comes from another side


@pytest.mark.one_case
@some_models
def test_the_derivatives_of_forward_dynamics_are_those_of_inverse_dynamics(model):
    q, v, _, tau, f_ext = random_state(model, rng=6)
    forward = program(model, "dqdd_dq", "dqdd_dv", "qdd")(q, v, tau, f_ext)
    M, loss = tw.crba(model, q), np.linalg.cond(tw.crba(model, q))
    inverse = program(model, "dtau_dq", "dtau_dv")(q=q, v=v, a=forward.qdd, f_ext=f_ext)
    close(M @ forward.dqdd_dq, -inverse.dtau_dq, 1e-14 * loss)
    close(M @ forward.dqdd_dv, -inverse.dtau_dv, 1e-14 * loss)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["go2", "spherical", "fixed"])
def test_the_aba_differentiated_itself_says_the_same_with_more_operations(name):
    model = MODELS[name]
    q, v, _, tau, _ = random_state(model, rng=6)
    aba = quantities(model, np.dtype(float))["qdd"]
    itself = Quantity("itself", aba.arguments, of_line(model, aba, "q"))
    ours = program(model, "dqdd_dq")
    close(itself.compute(q, v, tau)[0], ours(q, v, tau), 1e-14 * np.linalg.cond(tw.crba(model, q)))
    line = record(model, [itself], {name: shapes(model)[name] for name in ("q", "v", "tau")}, {}, np.dtype(float))
    assert line.operations.total() > 1.15 * ours.operations.total()


@pytest.mark.parametrize("name", ["qdd", "h_G"])
def test_second_derivatives_by_a_complex_step_are_symmetric_and_those_of_a_difference(name):
    """Two angles commute, so ∂²/∂q∂q is symmetric; a cart pole has nothing else."""
    model, rng = tw.load("cart_pole"), np.random.default_rng(0)
    q, v, tau = rng.standard_normal((3, model.nv))
    rest = {"qdd": (v, tau), "h_G": (v,)}[name]
    steps = np.eye(model.nv)
    exact = tw.compile(model, f"d{name}_dq", dtype=complex)(q + 1e-30j * steps, *rest).imag / 1e-30
    real = tw.compile(model, f"d{name}_dq", backend="numpy")
    difference = (real(q + 1e-5 * steps, *rest) - real(q - 1e-5 * steps, *rest)) / 2e-5
    np.testing.assert_allclose(exact, difference, rtol=0, atol=1e-8)
    np.testing.assert_allclose(exact, np.swapaxes(exact, 0, -1), atol=1e-13)


@pytest.mark.parametrize(
    ("robot", "name"),
    [
        ("double_pendulum", "dqdd_dq_dq"),
        ("double_pendulum", "dqdd_dv_dtau"),
        ("planar_arm", "dtau_dq_dv"),
        pytest.param("go2", "dtau_dq_dq", marks=pytest.mark.slow),
        pytest.param("go2", "dA_G_dq_dq", marks=pytest.mark.slow),
    ],
)
def test_second_derivatives_by_name_are_complex_steps_of_the_first(robot, name):
    model = tw.load(robot)
    s = random_state(model, rng=3)
    first, _, by = name.rpartition("_d")
    program, of = tw.compile(model, name, backend="numpy"), tw.compile(model, first, dtype=complex, backend="numpy")
    given = {x: getattr(s, x) for x in program.arguments if x != "f_ext"}
    steps = 1e-30j * np.eye(model.nv)
    moved = {x: np.tile(y, (model.nv, 1)) for x, y in given.items()}
    moved[by] = model.integrate(s.q, steps) if by == "q" else given[by] + steps
    expected = np.moveaxis(of(**moved).imag / 1e-30, 0, -1)
    np.testing.assert_allclose(program(**given), expected, rtol=0, atol=1e-11 * max(1, np.abs(expected).max()))


# ---------------------------------------------------------------- the page


@pytest.mark.slow
def test_the_page_runs_and_both_languages_have_the_same_code():
    pages = [page("derivatives", language).read_text(encoding="utf-8") for language in ("", ".zh-CN")]
    code, twin = (["".join(block.splitlines()) for block in blocks(text, 0, len(text))] for text in pages)
    assert code == twin
    assert len(code) == 8
    exec("\n".join(blocks(pages[0], 0, len(pages[0]))), {})


# ---------------------------------------------------------------- the regressor


@every_model
def test_joint_forces_are_linear_in_ten_numbers_of_each_body(model):
    q, v, a, *_ = random_state(model, rng=8, batch=(2,))
    ten = np.concatenate([I.parameters() for I in model.inertia[1:]])
    Y = program(model, "Y")(q, v, a)
    assert Y.shape == (2, model.nv, 10 * (model.nbodies - 1))
    close(Y @ ten, tw.rnea(model, q, v, a) - model.armature * a)


def test_a_body_is_felt_by_the_joints_that_carry_it():
    """A body has no part in the force at a joint that does not carry it."""
    model = MODELS["go2"]
    q, v, a, *_ = random_state(model, rng=9)
    Y = program(model, "Y")(q, v, a).reshape(model.nv, model.nbodies - 1, 10)
    for j in range(1, model.nbodies):
        for i in range(1, model.nbodies):
            above, k = {0}, i
            while k:
                above.add(k)
                k = model.parent[k]
            assert (j in above) == bool(Y[model.v_slice[j], i - 1].any())


# ---------------------------------------------------------------- other ways to differentiate


def complex_step(model, function, q, *rest, of):
    """Column k by a step of 1e-30 i along entry k: no difference, so no digit is lost."""
    columns = []
    for k in range(model.nv):
        step = np.zeros(model.nv, complex)
        step[k] = 1e-30j
        args = [q, *rest]
        args[of] = model.integrate(q.astype(complex), step) if of == 0 else args[of] + step
        columns.append(np.asarray(function(model, *args)).imag / 1e-30)
    return np.stack(columns, axis=-1)


@pytest.mark.slow
@some_models
def test_a_complex_step_through_the_textbook_and_through_integrate(model):
    q, v, a, tau, f_ext = random_state(model, rng=11)
    want = ("dtau_dq", "dtau_dv", "dh_G_dq", "dg_dq", "dqdd_dq", "dqdd_dv")
    d = program(model, *want)(q=q, v=v, a=a, tau=tau, f_ext=f_ext)
    loss = max(1.0, np.linalg.cond(tw.crba(model, q)) / 100)
    close(d.dtau_dq, complex_step(model, tw.rnea, q, v, a, f_ext, of=0))
    close(d.dtau_dv, complex_step(model, tw.rnea, q, v, a, f_ext, of=1))
    close(d.dh_G_dq, complex_step(model, tw.centroidal_momentum, q, v, of=0))
    close(d.dg_dq, complex_step(model, tw.gravity, q, of=0))
    close(d.dqdd_dq, complex_step(model, tw.aba, q, v, tau, f_ext, of=0), 1e-12 * loss)
    close(d.dqdd_dv, complex_step(model, tw.aba, q, v, tau, f_ext, of=1), 1e-12 * loss)


def slopes(model, q):
    """The dq of a step along each entry of v, joint by joint, as the books have them; in 50 digits."""
    columns = []
    for joint, qs in zip(model.joints, model.q_slice):
        for k in range(joint.nv if joint else 0):
            x, dq = q[qs], slow.as_mpmath(np.zeros(model.nq))
            e = slow.as_mpmath(np.eye(joint.nv)[k])
            match joint.kind:
                case "continuous":
                    dq[qs] = [-x[1], x[0]]
                case "planar":
                    dq[qs] = [x[2] * e[0] - x[3] * e[1], x[3] * e[0] + x[2] * e[1], -x[3] * e[2], x[2] * e[2]]
                case "spherical":
                    dq[qs] = half_product(x, e)
                case "free_flyer":
                    dq[qs] = [*turned(x[3:], e[3:]), *half_product(x[3:], e[:3])]
                case _:
                    dq[qs] = e
            columns.append(dq)
    return columns


def half_product(quaternion, w):
    """½ q ⊗ (ω, 0)."""
    u, s = quaternion[:3], quaternion[3]
    return [*((s * w + cross(u, w)) / 2), -(u @ w) / 2]


def turned(quaternion, p):
    """R p = p + 2 w u × p + 2 u × (u × p)."""
    u, s = quaternion[:3], quaternion[3]
    return p + 2 * (s * cross(u, p) + cross(u, cross(u, p)))


def cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


@pytest.mark.one_case
@pytest.mark.parametrize("model", sampled(MODELS.values(), 4), ids=MODELS)
def test_fifty_digits(model):
    """A central difference over 1e-20 in 50 digits, of the way without spatial vectors."""
    mpmath.mp.dps = 50
    q, v, a, _, f_ext = random_state(model, rng=12)
    exact = [slow.as_mpmath(x) for x in (q, v, a, f_ext)]
    for joint, qs in zip(model.joints, model.q_slice):
        if joint is not None and joint.unit is not None:
            part = exact[0][qs][joint.unit]
            exact[0][qs.start + joint.unit.start : qs.start + joint.unit.stop] = part / mpmath.sqrt(part @ part)
    h = mpmath.mpf("1e-20")
    units = [slow.as_mpmath(e) for e in np.eye(model.nv)]
    d = program(model, "dtau_dq", "dtau_dv")(q, v, a, f_ext)
    for of, directions, got in ((0, slopes(model, exact[0]), d.dtau_dq), (1, units, d.dtau_dv)):
        for k in range(0, model.nv, 3 if model.nv > 9 else 1):
            ends = [[x + side * h * directions[k] if n == of else x for n, x in enumerate(exact)] for side in (1, -1)]
            high, low = (slow.inverse_dynamics(model, *end) for end in ends)
            close(got[:, k], np.array((high - low) / (2 * h), float))


@pytest.mark.parametrize("name", sampled(["floating", "go2", "fixed"], 1))
def test_pinocchio(name):
    """Its tangent of q is that of its v: so only the halves of a free-flyer are swapped."""
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed")
    model, bridge = MODELS[name], tw.bridge
    q, v, a, tau, _ = random_state(model, rng=13)
    there = bridge.to_pinocchio_model(model)
    data = there.createData()
    x = [bridge.to_pinocchio_tangent(model, y) for y in (v, a, tau)]
    d = program(model, "dtau_dq", "dtau_dv", "dqdd_dq", "dqdd_dv", "dqdd_dtau", "dg_dq", "dh_G_dq", "Y")
    found = d(q=q, v=v, a=a, tau=tau)
    loss = max(1.0, np.linalg.cond(tw.crba(model, q)) / 100)
    expected = pin.computeRNEADerivatives(there, data, q, x[0], x[1])
    for got, theirs in zip((found.dtau_dq, found.dtau_dv), expected):
        close(got, bridge.from_pinocchio_matrix(model, theirs))
    expected = pin.computeABADerivatives(there, data, q, x[0], x[2])
    for got, theirs in zip((found.dqdd_dq, found.dqdd_dv, found.dqdd_dtau), expected):
        close(got, bridge.from_pinocchio_matrix(model, theirs), 1e-12 * loss)
    close(found.dg_dq, bridge.from_pinocchio_matrix(model, pin.computeGeneralizedGravityDerivatives(there, data, q)))
    Y = pin.computeJointTorqueRegressor(there, data, q, x[0], x[1])
    close(found.Y, bridge.from_pinocchio_tangent(model, Y.T).T)
    dh = pin.computeCentroidalDynamicsDerivatives(there, data, q, x[0], x[1])[0]
    close(found.dh_G_dq, bridge.from_pinocchio_jacobian(model, dh))


# ---------------------------------------------------------------- as programs


@pytest.mark.slow
@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("batch", sampled([(3, 1, 2), (1,), (), (13,), (0,)], 2))
def test_batches(backend, batch):
    model = MODELS["floating"]
    q, v, a, tau, f_ext = random_state(model, rng=14, batch=batch)
    d = program(model, "dtau_dq", "dqdd_dv", "Y", backend=backend)
    found = d(q=q, v=v, a=a, tau=tau, f_ext=f_ext)
    assert found.dtau_dq.shape == (*batch, model.nv, model.nv)
    for k in np.ndindex(batch):
        one = program(model, "dtau_dq", "dqdd_dv", "Y")(q=q[k], v=v[k], a=a[k], tau=tau[k], f_ext=f_ext[k])
        for name in ("dtau_dq", "dqdd_dv", "Y"):
            close(getattr(found, name)[k], getattr(one, name))


@pytest.mark.one_case
@pytest.mark.parametrize("backend", BACKENDS)
def test_single_precision(backend):
    model = MODELS["go2"]
    q, v, a, *_ = random_state(model, rng=15)
    got = program(model, "dtau_dq", dtype=np.float32, backend=backend)(*(x.astype(np.float32) for x in (q, v, a)))
    assert got.dtype == np.float32
    close(got, program(model, "dtau_dq")(q, v, a), 1e-5)


def test_wrenches_from_outside_turn_with_their_bodies():
    model = MODELS["floating"]
    q, v, a, _, f_ext = random_state(model, rng=16)
    d = program(model, "dtau_dq")
    close(d(q, v, a, f_ext) - d(q, v, a), -complex_step(model, arms, q, f_ext, of=0))


def arms(model, q, f_ext):
    """Σ Jᵢᵀ f_ext[i]: the force at the joints of a robot without mass."""
    rest = np.zeros(model.nv)
    return tw.rnea(model, q, rest, rest) - tw.rnea(model, q, rest, rest, f_ext)


def test_what_is_known_costs_nothing():
    model = MODELS["go2"]
    q, _, a, *_ = random_state(model, rng=17)
    rest = np.zeros(model.nv)
    still = compile(model, "dtau_dq", given={"v": rest}, backend="numpy")
    close(still(q, a), program(model, "dtau_dq")(q, rest, a))
    counts = [d.operations.total() for d in (still, program(model, "dg_dq"), program(model, "dtau_dq"))]
    assert counts[0] < 0.8 * counts[2]
    assert counts[1] < 0.4 * counts[2]
    at_rest = compile(model, "dtau_dv", given={"v": rest}, backend="numpy")
    assert not at_rest(q, a).any()
    assert at_rest.line.outputs["dtau_dv"][1] == (at_rest.line.outputs["dtau_dv"][1][0],) * 18**2  # one constant, 0


def test_work_is_shared_and_zeros_are_free():
    model = MODELS["go2"]
    apart = sum(program(model, name).operations.total() for name in ("dtau_dq", "dtau_dv", "M"))
    together = program(model, "dtau_dq", "dtau_dv", "M")
    assert together.operations.total() < 0.97 * apart
    line = together.line
    constant = [line.nodes[k][0] == "const" for k in line.outputs["dtau_dq"][1]]
    always_zero = np.array(constant).reshape(18, 18)
    legs = [range(6 + 3 * k, 9 + 3 * k) for k in range(4)]
    for one in legs:
        for other in legs:
            assert always_zero[np.ix_(one, other)].all() == (one != other)


@pytest.mark.parametrize("backend", BACKENDS)
def test_large_angles_and_lost_pivots_are_the_textbooks(backend):
    model = tw.load("double_pendulum")
    far, near = np.array([2.0**20, 0.5]), np.array([np.fmod(2.0**20, 2 * np.pi), 0.5])
    d = program(model, "dtau_dq", "dqdd_dq", backend=backend)
    v, a, tau = np.array([[0.3, 0.2], [0.1, 0.4], [1.0, 2.0]])
    found, expected = d(q=far, v=v, a=a, tau=tau), d(q=near, v=v, a=a, tau=tau)
    close(found.dtau_dq, expected.dtau_dq, 1e-9)  # the two angles agree to 2e-10
    close(found.dqdd_dq, expected.dqdd_dq, 1e-8)
    needle = tw.Builder("needle")
    needle.link("arm", parent="base_link", joint=tw.Revolute("y"), inertia=tw.SpatialInertia(1, [0, 0, 1], np.eye(3)))
    needle.link("needle", parent="arm", joint=tw.Revolute("y"))
    with pytest.raises(tw.SingularError, match="needle"):
        program(needle.build(), "dqdd_dq", backend=backend)(np.zeros(2), np.zeros(2), np.zeros(2))


def test_an_unknown_derivative_is_named():
    with pytest.raises(ValueError, match="did you mean 'dtau_dq'"):
        compile(MODELS["go2"], "dtau_dQ")


def test_what_depends_on_q_in_another_way_is_not_differentiated():
    model = tw.load("cart_pole")
    tape = Tape()
    q = numbers(tape, "q", 2)
    with pytest.raises(NotImplementedError, match="whose derivatives are given"):
        jacobian(tape, np.array([q[1] * q[1]], object), steps(model, q), 2)


def test_every_quantity_has_its_derivatives():
    model = MODELS["go2"]
    known = quantities(model, np.dtype(float))
    assert {name for name in known if name.startswith(("dtau_d", "dqdd_d"))} == {
        *("dtau_dq", "dtau_dv", "dtau_da", "dqdd_dq", "dqdd_dv", "dqdd_dtau")
    }
    assert {"dT_dq", "dT_dv", "dM_dq", "dC_dv", "dA_G_dq", "ddh_G_da"} <= set(known)

"""Contacts as programs: q̈, λ, v⁺ and Λ by elimination, their derivatives, and what is left to the decomposition."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from straightline.llvm import available
from twistwrench import bridge
from twistwrench.contact.calls import known_program
from twistwrench.contact.forward import held_by_decomposition

from ..sampling import sampled
from ..strategies import Recipe
from ..touching import BOX, BOX_CORNERS, FEET, GO2, HUMANOID, SOLES, error, kkt, motors, points, posed, straight

H = 1e-20
TREE = Recipe(14, seed=4, base="floating", branching=0.7).model
TIPS = [TREE.joint_names[i] for i in range(1, TREE.nbodies) if i not in TREE.parent]
FIXED = Recipe(9, seed=5, base="fixed", branching=0.4).model
ENDS = [FIXED.joint_names[i] for i in range(1, FIXED.nbodies) if i not in FIXED.parent]
MIXED = [*points(TIPS[:1]), tw.SurfaceContact(TIPS[2], (0.1, 0.05), 0.6), tw.LoopClosure(TIPS[1], TIPS[3])]

LEG = Recipe(3, seed=2, base="floating", branching=0.0).model

ROBOTS = {
    "a leg": (LEG, LEG.random_configuration(rng=1), [tw.SurfaceContact(LEG.joint_names[-1], (0.1, 0.05), 0.6)]),
    "Go2 on four feet": (GO2, GO2.standing(), FEET),
    "humanoid on two soles": (HUMANOID, HUMANOID.standing(), SOLES),
    "a tree in a loop": (TREE, TREE.random_configuration(rng=1), MIXED),
    "an arm at a rod": (
        FIXED,
        FIXED.random_configuration(rng=2),
        [tw.DistanceConstraint(ENDS[0], "base_link" if "base_link" in FIXED.frame_names else FIXED.frame_names[0])],
    ),
    "a wheel and a ball": (
        TREE,
        TREE.random_configuration(rng=3),
        [tw.WheelContact(TIPS[0], 0.1, 0.5), tw.SphereContact(TIPS[1], 0.1, 0.5)],
    ),
}
robots = pytest.mark.parametrize("name", sampled(ROBOTS, 1))
needs_llvm = pytest.mark.skipif(not available(), reason="llvmlite is not installed: there is no machine code")


def state(name):
    model, q, contacts = ROBOTS[name]
    rng = np.random.default_rng(7)
    return model, q, rng.standard_normal(model.nv), rng.standard_normal(model.nv), contacts


def forces_of(found) -> np.ndarray:
    return np.concatenate([*found.forces.values()], axis=-1)


def close(x, y, digits=1e-12):
    np.testing.assert_allclose(x, y, rtol=0, atol=digits * max(1.0, np.abs(y).max()))


# ---------------------------------------------------------------- the function, by program and by decomposition


@needs_llvm
@robots
def test_the_program_finds_what_the_decomposition_finds(name):
    model, q, v, tau, contacts = state(name)
    for _ in range(2):  # made, and found again
        got = tw.contact_forward_dynamics(model, q, v, tau, contacts)
    assert known_program(model, "held", contacts).one(q, v, tau) is not None
    book = held_by_decomposition(model, contacts, q, v, {"tau": tau})
    close(got.qdd, book.qdd)
    close(forces_of(got), forces_of(book))
    close(got.slip, book.slip)
    assert (got.rank, got.redundant) == (book.rank, book.redundant)


@needs_llvm
def test_states_side_by_side_are_those_one_by_one_with_singular_ones_among_them():
    bent = GO2.standing()
    qs = np.stack([bent, straight(plumb=True), bent, straight(plumb=False)])
    rng = np.random.default_rng(3)
    v, tau = rng.standard_normal((2, 4, GO2.nv))
    v[1::2] = 0
    together = tw.contact_forward_dynamics(GO2, qs, v, tau, FEET)
    assert together.rank.tolist() == [12, 11, 12, 12]
    for k, q in enumerate(qs):
        alone = held_by_decomposition(GO2, FEET, q, v[k], {"tau": tau[k]})
        close(together.qdd[k], alone.qdd)
        close(forces_of(together)[k], forces_of(alone))


@pytest.mark.one_case
@needs_llvm
@pytest.mark.parametrize("bend", [1e-1, 3e-3, 1e-3])
def test_near_a_singular_stance_no_digit_is_lost_by_the_program(bend):
    """A knee that is nearly straight costs digits by elimination; before they count the decomposition takes over."""
    q = straight(plumb=True)
    q[7:] += bend * (GO2.standing() - q)[7:]
    v, tau = np.random.default_rng(1).standard_normal(GO2.nv), motors(GO2, np.random.default_rng(1))
    got, true = tw.contact_forward_dynamics(GO2, q, v, tau, FEET), kkt(GO2, q, v, tau, FEET)
    assert error(got.qdd, true.qdd, size=9.81) < 1e-12
    assert error(forces_of(got), np.concatenate([*true.forces.values()])) < 1e-12


@needs_llvm
@robots
def test_an_impact_by_the_program_is_the_least_change(name):
    model, q, v, _, contacts = state(name)
    for e in (0.0, 0.4):
        hit = tw.impact(model, q, v, contacts, restitution=e)
        J, M = tw.constraint_jacobian(model, q, contacts), tw.crba(model, q)
        close(J @ hit.v, -e * J @ v, 1e-11)
        close(M @ (hit.v - v), J.T @ np.concatenate([*hit.impulses.values()]), 1e-11)
        close(hit.energy_lost, tw.kinetic_energy(model, q, v) - tw.kinetic_energy(model, q, hit.v), 1e-11)
    assert known_program(model, "hit", contacts).one(q, v) is not None


@needs_llvm
def test_lists_and_tuples_of_the_same_contacts_share_a_program_and_others_do_not():
    q, rest = GO2.standing(), np.zeros(GO2.nv)
    tw.contact_forward_dynamics(GO2, q, rest, rest, FEET)
    assert known_program(GO2, "held", tuple(FEET)) is known_program(GO2, "held", FEET)
    assert known_program(GO2, "held", FEET[:3]) is not known_program(GO2, "held", FEET)
    assert known_program(GO2, "held", ["FL_foot"]) is None
    first = known_program(GO2, "held", FEET).program
    for _ in range(100):  # contacts that are made anew for each call are not kept for ever
        again = points(GO2.feet)
        tw.contact_forward_dynamics(GO2, q, rest, rest, again)
    assert known_program(GO2, "held", again).program is first
    assert len(GO2._programs["held"]) <= 64
    with pytest.raises(ValueError, match="expected contacts such as PointContact"):
        tw.contact_forward_dynamics(GO2, q, rest, rest, ["FL_foot"])


# ---------------------------------------------------------------- Pinocchio


def there(model, q, contacts):
    """The robot and its contacts as Pinocchio's, which take the frame's own axes for six rows."""
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its constrained dynamics is not asked")
    other = bridge.to_pinocchio_model(model)
    models, datas = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    for c in contacts:
        frame = other.frames[other.getFrameId(c.frame)]
        kind = pin.ContactType.CONTACT_3D if c.dim == 3 else pin.ContactType.CONTACT_6D
        at = tw.frame_placement(model, q, c.frame)
        ends = (frame.parentJoint, frame.placement, 0, pin.SE3(at.rotation, at.translation))
        models.append(pin.RigidConstraintModel(kind, other, *ends, pin.LOCAL))
        datas.append(models[-1].createData())
    data = other.createData()
    pin.initConstraintDynamics(other, data, models, datas)
    return pin, other, data, models, datas, pin.ProximalSettings(1e-14, 1e-14, 0.0, 1)


@needs_llvm
@pytest.mark.parametrize("seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in range(1, 8))])
def test_random_robots_accelerate_as_in_pinocchio(seed):
    recipe = Recipe(5 + seed, seed=seed, base="floating", branching=0.6)
    model = recipe.model
    q, v, _, tau, _ = recipe.state()
    tips = [model.joint_names[i] for i in range(2, model.nbodies) if i not in model.parent]
    contacts = points(tips[:2])
    got = [tw.contact_forward_dynamics(model, q, v, tau, contacts) for _ in range(2)][-1]
    pin, other, data, models, datas, exact = there(model, q, contacts)
    rates = (bridge.to_pinocchio_tangent(model, x) for x in (v, tau))
    if got.redundant:
        exact = pin.ProximalSettings(1e-14, 1e-14, 1e-8, 20)
    a = bridge.from_pinocchio_tangent(model, pin.constraintDynamics(other, data, q, *rates, models, datas, exact))
    close(got.qdd, a, 1e-10 if got.redundant else 1e-12)


# ---------------------------------------------------------------- compile


WANT = tuple(f"d{x}_d{by}" for x in ("qdd", "lambda") for by in ("q", "v", "tau"))


@robots
def test_a_compiled_scene_is_held_by_its_contacts(name):
    model, q, v, tau, contacts = state(name)
    program = tw.compile(tw.Scene(model, contacts=contacts), ("qdd", "lambda", "v_plus", "impulse"), backend="numpy")
    assert program.model.nv == model.nv
    got = program(q, v, tau)
    held, hit = tw.contact_forward_dynamics(model, q, v, tau, contacts), tw.impact(model, q, v, contacts)
    close(got.qdd, held.qdd)
    close(getattr(got, "lambda"), forces_of(held))
    close(got.v_plus, hit.v)
    close(got.impulse, np.concatenate([*hit.impulses.values()]))


def test_redundant_contacts_of_a_compiled_scene_are_the_least_squares():
    scene = tw.Scene(BOX, contacts=BOX_CORNERS)
    q, rest = posed([0, 0, 0.3], [1, 2, 0.1]), np.zeros(6)
    got = tw.compile(scene, ("qdd", "lambda"), backend="numpy")(q, rest, rest)
    close(got.qdd, 0 * rest)
    close(getattr(got, "lambda").reshape(4, 3), np.tile([0, 0, 8.0 * 9.81 / 4], (4, 1)))
    with pytest.raises(tw.SingularError, match="12 directions of which 6 are independent"):
        tw.compile(scene, "dlambda_dq", backend="numpy")(q, rest, rest)


@pytest.mark.skipif(not available(), reason="llvmlite is not installed")
def test_contacts_of_different_friction_share_a_program():
    model = tw.load("double_pendulum")
    for mu in (0.5, 0.6, 0.7):
        contacts = [tw.SphereContact("tip", 0.1, mu, restitution=mu)]
        tw.contact_forward_dynamics(model, np.ones(2), np.ones(2), np.ones(2), contacts)
    assert len([key for key in model._programs if key[0] == "held"]) == 1


@pytest.mark.one_case
@pytest.mark.parametrize("number", ["mpmath", "double-double"])
@pytest.mark.parametrize("want", ["impulse", "lambda", "qdd"])
def test_of_many_forces_no_program_chooses_one_in_more_digits(want, number):
    """The wrist of an arm is straight: of its six rows five are independent, and a pivot is rounding."""
    arm = tw.load("ur5")
    scene = tw.Scene(arm, contacts=[tw.SurfaceContact("tool0", (0.1, 0.1), 0.6)])
    program = tw.compile(scene, want, dtype=number)
    x = np.linspace(-1.0, 1.0, 6)
    straight = [np.where(np.arange(6) == 4, np.pi, x), x, x][: 2 if want == "impulse" else 3]
    with pytest.raises(tw.SingularError, match="6 directions of which 5 are independent"):
        program(*straight)
    bent = [np.where(np.arange(6) == 4, 1.0, x), *straight[1:]]
    assert np.isfinite(np.asarray(program(*bent), float)).all()


def test_rows_that_depend_on_each_other_in_every_state_have_no_bound_and_no_more_digits():
    leg = tw.lock_joints(GO2, ["FR_*", "RL_*", "RR_*"], GO2.standing()).model
    scene = tw.Scene(leg, contacts=[tw.PointContact("FL_foot", 0.6), tw.PointContact("FL_calf", 0.6)])  # of one body
    state = leg.standing(), np.zeros(9), np.ones(9)
    assert np.isfinite(tw.compile(scene, "lambda")(*state)).all()
    for how in ({"dtype": "double-double"}, {"dtype": "mpmath"}, {"bound": True}, {"bound": "running"}):
        with pytest.raises(tw.SingularError, match="a pivot is zero in every state"):
            tw.compile(scene, "lambda", **how)(*state)
    arm = tw.load("planar_arm")
    flat = tw.Scene(arm, contacts=[tw.PointContact("tool", 0.6)])
    with pytest.raises(tw.SingularError, match="row 1 of J"):
        tw.compile(flat, "qdd")(np.ones(3), np.ones(3), np.ones(3))


@pytest.mark.parametrize("name", sampled(["a leg", "Go2 on four feet", "a tree in a loop"], 1))
def test_derivatives_are_those_of_complex_steps(name):
    model, q, v, tau, contacts = state(name)
    scene = tw.Scene(model, contacts=contacts)
    got = tw.compile(scene, WANT, backend="numpy")(q, v, tau)
    steps = 1j * H * np.eye(model.nv)
    forward = tw.compile(scene, ("qdd", "lambda"), dtype=complex, backend="numpy")
    alike = np.broadcast_to
    n = (model.nv,)
    ways = {
        "q": (model.integrate(q.astype(complex), steps), alike(v, n + n) + 0j, alike(tau, n + n) + 0j),
        "v": (alike(q, n + q.shape) + 0j, v + steps, alike(tau, n + n) + 0j),
        "tau": (alike(q, n + q.shape) + 0j, alike(v, n + n) + 0j, tau + steps),
    }
    for by, args in ways.items():
        changed = forward(*args)
        for symbol in ("qdd", "lambda"):
            expected = getattr(changed, symbol).imag.T / H
            close(getattr(got, f"d{symbol}_d{by}"), expected, 1e-11)


@pytest.mark.parametrize("name", sampled(["a leg", "Go2 on four feet", "humanoid on two soles"], 1))
def test_derivatives_are_pinocchios_along_what_the_contacts_allow(name):
    """Pinocchio counts J v in axes that turn with the robot: both agree where the contacts stay at rest."""
    model, q, v, tau, contacts = state(name)
    v = tw.impact(model, q, v, contacts).v
    got = tw.compile(tw.Scene(model, contacts=contacts), WANT, backend="numpy")(q, v, tau)
    pin, other, data, models, datas, exact = there(model, q, contacts)
    rates = (bridge.to_pinocchio_tangent(model, x) for x in (v, tau))
    pin.constraintDynamics(other, data, q, *rates, models, datas, exact)
    pin.computeConstraintDynamicsDerivatives(other, data, models, datas, exact)
    by_q, by_v, by_tau = (bridge.from_pinocchio_matrix(model, x) for x in (data.ddq_dq, data.ddq_dv, data.ddq_dtau))
    close(got.dqdd_dtau, by_tau, 1e-11)
    J = tw.constraint_jacobian(model, q, contacts)
    steps = 1j * H * np.eye(model.nv)
    turned = np.matvec(tw.constraint_jacobian(model, model.integrate(q.astype(complex), steps), contacts), v).imag.T / H
    both = np.block([[J, 0 * J], [turned, J]])
    ways = np.linalg.svd(both)[2][len(both) :].T
    close(np.hstack([got.dqdd_dq, got.dqdd_dv]) @ ways, np.hstack([by_q, by_v]) @ ways, 1e-10)


def test_derivatives_of_an_impact_and_of_a_scene_with_wrenches_are_differences():
    tip = LEG.joint_names[-1]
    scene = tw.Scene(LEG, contacts=points([tip]), wrenches={tip: [0, 0, 0, 5.0, -3.0, 2.0]})
    free = tw.Scene("double_pendulum", wrenches={tw.load("double_pendulum").joint_names[-1]: [1.0, 2, 3, 40, 50, 60]})
    rng = np.random.default_rng(5)
    for where, symbol in ((scene, "lambda"), (scene, "v_plus"), (free, "qdd")):
        model = where.model
        q, v, tau = model.random_configuration(rng=4), *rng.standard_normal((2, model.nv))
        args = (q, v) if symbol == "v_plus" else (q, v, tau)
        got = tw.compile(where, f"d{symbol}_dq", backend="numpy")(*args)
        program = tw.compile(where, symbol, backend="numpy")
        h = 1e-6 * np.eye(model.nv)[[0, model.nv - 1]]
        plus, minus = (program(model.integrate(q, way), *(np.tile(x, (2, 1)) for x in args[1:])) for way in (h, -h))
        close(got[:, [0, -1]].T, (plus - minus) / 2e-6, 1e-6)

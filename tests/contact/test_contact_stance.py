"""Whether a robot can stand: verdicts against a linear programme, and their proofs checked without any solver."""

import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.contact.qp import least_breach, nonnegative_least_squares
from twistwrench.contact.task import ContactProblem

from ..sampling import sampled
from ..touching import BOX, FEET, GO2, HUMANOID, SOLES, points, posed
from .test_contact_types import Grasp

SIDES = 16
EDGE = 1e-8
"""What forces may leave over, of the weight: the tolerance that `stance_margins` documents."""
ROBOTS = ("go2", "humanoid", "talos_reduced", "g1")


def loaded(name):
    try:
        return tw.load(name)
    except tw.NameNotFound:
        pytest.skip(f"{name} comes with example-robot-data, which is not installed")


def stances(model, rng):
    """Random poses with contacts of every kind: on coplanar soles, on soles that are not, on points, on walls."""
    turned, bent = rng.normal(size=3) * rng.choice([0, 0.05, 0.3]), rng.normal(size=model.nv - 6)
    kind = rng.integers(4)
    size = (rng.uniform(0.01, 0.12), rng.uniform(0.01, 0.06))
    mu = float(rng.choice([0.05, 0.3, 0.6, 1.5]))
    if kind == 0:  # coplanar, on a slope
        step, on = np.r_[turned, 0, 0, 0, 0 * bent], model.feet[: rng.integers(1, len(model.feet) + 1)]
    else:
        step = np.r_[turned, 0, 0, 0, rng.choice([1e-9, 1e-3, 0.1]) * bent]
        on = rng.permutation(model.feet)[: rng.integers(1, len(model.feet) + 1)]
    q = model.integrate(model.standing(), step)
    if kind < 3:
        return q, [tw.SurfaceContact(str(frame), size, mu) for frame in on]
    frames = {tuple(tw.frame_placement(model, q, f).translation.round(6)): f for f in model.frame_names[2:]}
    some = rng.permutation(list(frames.values()))[: rng.integers(3, 6)]
    return q, [tw.PointContact(str(f), mu, rng.normal(size=3) * [0.6, 0.6, 0.2] + [0, 0, 1]) for f in some]


def lines_of_force(model, q, contacts):
    """Points from the centre of mass and the axes of the contact at each, shapes (k, 3) and (k, 3, 3), and μ, (k,)."""
    places = [tw.frame_placement(model, q, c.frame) for c in contacts]
    axes = [c.axes(T.rotation) for c, T in zip(contacts, places, strict=True)]
    at = [T.translation + c.points @ R.T for c, T, R in zip(contacts, places, axes, strict=True)]
    G = tw.center_of_mass(model, q)
    return (
        np.concatenate(at) - G,
        np.concatenate([np.broadcast_to(R, (len(c.points), 3, 3)) for c, R in zip(contacts, axes, strict=True)]),
        np.concatenate([np.full(len(c.points), c.mu) for c in contacts]),
    )


def edges(mu):
    """The edges of an inner pyramid, (sides, 3)."""
    angle = (np.arange(SIDES) + 0.5) * 2 * np.pi / SIDES
    return np.stack([mu * np.cos(angle), mu * np.sin(angle), np.ones(SIDES)], axis=-1)


def torques(model, q, contacts):
    """The torques of rest without contact forces, and what a force at each point in the world takes from them."""
    J = []
    for c in contacts:
        R = tw.frame_placement(model, q, c.frame).rotation
        turn, shift = tw.frame_jacobian(model, q, c.frame, "local_world_aligned").reshape(2, 3, -1)
        J += [shift - tw.skew(c.axes(R) @ p) @ turn for p in c.points]
    return tw.gravity(model, q)[6:], np.concatenate(J).T[6:]


def missed_by(model, q, contacts, motors=False):
    """What no forces within the pyramids can do without, of the weight: a linear programme by HiGHS.

    The largest entry of (moment / length, force) / weight that is left over, where it is least; with the motors at most
    as strong as they are, where asked.
    """
    linprog = pytest.importorskip("scipy.optimize", reason="the oracle of this test is SciPy's").linprog
    p, R, mu = lines_of_force(model, q, contacts)
    pushes = np.concatenate([edges(m) @ axes.T for m, axes in zip(mu, R, strict=True)])
    length = np.abs(p).max()
    wrenches = np.concatenate([np.cross(np.repeat(p, SIDES, 0), pushes) / length, pushes], axis=-1).T
    scale = np.abs(wrenches).max(axis=0)
    wrenches = wrenches / scale
    asked = np.r_[0, 0, 0, 0, 0, 1.0]
    slack = -np.ones((6, 1))
    A, b = np.block([[wrenches, slack], [-wrenches, slack]]), np.r_[asked, -asked]
    if motors:
        tau, lever = torques(model, q, contacts)
        weight, strong = model.mass * np.linalg.norm(model.gravity), model.effort_limit[6:]
        of_point = np.kron(np.eye(len(p)), np.ones(SIDES)).repeat(3, 0)
        eased = lever @ (of_point * np.tile(pushes.T / scale, (len(p), 1)))
        A = np.block([[A], [-eased, 0 * strong[:, None]], [eased, 0 * strong[:, None]]])
        b = np.r_[b, (strong - tau) / weight, (strong + tau) / weight]
    found = linprog(
        np.r_[np.zeros(wrenches.shape[1]), 1.0],
        A_ub=A,
        b_ub=b,
        method="highs",
        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
    )
    return found.x[-1] if found.status == 0 else np.nan


def check_proof(model, q, contacts, margins):
    """See the forces, or the motion along which nothing holds, without any solver."""
    p, R, mu = lines_of_force(model, q, contacts)
    weight = model.mass * np.linalg.norm(model.gravity)
    if margins.stands:
        assert margins.falls is None
        f = np.concatenate([margins.point_forces[c.frame] for c in contacts])
        assert (np.hypot(f[:, 0], f[:, 1]) <= mu * f[:, 2] + 1e-12 * np.abs(f).max()).all()
        in_world = np.matvec(R, f)
        assert np.abs(in_world.sum(axis=0) + model.mass * model.gravity).max() < 3 * EDGE * weight
        assert np.abs(np.cross(p, in_world).sum(axis=0)).max() < 10 * EDGE * weight
    else:
        assert margins.point_forces is None
        turn, shift = tw.frame_placement(model, q, model.frame_names[1]).rotation @ margins.falls.reshape(2, 3, 1)
        G = tw.center_of_mass(model, q) - tw.frame_placement(model, q, model.frame_names[1]).translation
        v_G = shift[:, 0] + np.cross(turn[:, 0], G)
        u = np.matvec(R.mT, v_G + np.cross(turn[:, 0], p))  # of the points, in their contact's axes
        against = min((edges(m) @ x).min() for m, x in zip(mu, u, strict=True))
        power = model.mass * model.gravity @ v_G
        assert power > 0
        assert -against * weight <= 1e-5 * power  # what forces as large as the weight can do against it


def holds(model, q, contacts):
    """Whether the programme finds forces within pyramids and motors; those that it finds are looked at."""
    rest = np.zeros(model.nv)
    try:
        found = tw.friction_inverse_dynamics(model, q, rest, rest, contacts, sides=SIDES, effort_limits=True)
    except tw.SingularError:
        return False
    left = tw.gravity(model, q) - found.tau
    left = left - tw.constraint_jacobian(model, q, contacts).T @ np.concatenate(list(found.forces.values()))
    assert np.abs(left).max() < 30 * EDGE * model.mass * 9.81
    assert (np.abs(found.tau[6:]) <= model.effort_limit[6:] + 30 * EDGE * model.mass * 9.81).all()
    return True


def compare(model, rng, count):
    """Return how many poses stand, how many with weak motors, and by how much a linear programme misses otherwise."""
    stand, strong, otherwise = 0, 0, []
    for _ in range(count):
        q, contacts = stances(model, rng)
        margins = tw.stance_margins(model, q, contacts, sides=SIDES)
        check_proof(model, q, contacts, margins)
        missed = missed_by(model, q, contacts)
        stand += margins.stands
        if np.isnan(missed) or margins.stands != (missed <= EDGE):
            otherwise.append(float(missed))
        if margins.stands:
            need = np.abs(tw.friction_inverse_dynamics(model, q, *np.zeros((2, model.nv)), contacts, sides=SIDES).tau)
            limit = np.r_[np.full(6, np.inf), np.full(model.nv - 6, rng.uniform(0.5, 1.05) * need.max())]
            weak = replace(model, effort_limit=limit)
            enough, missed = holds(weak, q, contacts), missed_by(weak, q, contacts, motors=True)
            strong += enough
            if enough != (missed <= EDGE):  # nan where no forces at all spare the motors
                otherwise.append(float(missed))
    return stand, strong, otherwise


@pytest.mark.parametrize("name", sampled(ROBOTS, 1))
def test_verdicts_are_those_of_a_linear_programme_and_come_with_their_proof(name):
    stand, strong, otherwise = compare(loaded(name), np.random.default_rng(7), 6)
    assert 0 < strong <= stand < 6
    assert otherwise == []


@pytest.mark.slow(one_in=3)
@pytest.mark.parametrize(("name", "count"), [("go2", 50), ("humanoid", 100), ("talos_reduced", 50), ("g1", 50)])
def test_verdicts_of_a_hundred_poses(name, count):
    stand, strong, otherwise = compare(loaded(name), np.random.default_rng(2026), count)
    assert 0.1 * count < stand < 0.8 * count
    assert 0.2 * stand < strong < 0.95 * stand
    assert otherwise == []


@pytest.mark.slow
def test_poses_that_ended_in_a_flag_of_the_solver():
    rng = np.random.default_rng(50)
    for _ in range(40):
        q = GO2.integrate(GO2.standing(), np.r_[np.zeros(6), 0.1 * rng.standard_normal(12)])
        contacts = [tw.SurfaceContact(foot, (0.02, 0.01), 0.6) for foot in GO2.feet[:3]]
        check_proof(GO2, q, contacts, tw.stance_margins(GO2, q, contacts, sides=SIDES))
    q = HUMANOID.integrate(HUMANOID.standing(), np.r_[0, -0.1, 0, np.zeros(24)])
    q[HUMANOID.q_slice[HUMANOID.joint_id("left_ankle_pitch")]] -= 0.1
    assert tw.stance_margins(HUMANOID, q, SOLES).reason == "it slips: it would need 6.2 times the friction"
    rng = np.random.default_rng(51)
    q = HUMANOID.integrate(HUMANOID.standing(), np.r_[np.zeros(6), 0.1 * rng.standard_normal(HUMANOID.nv - 6)])
    wide = [tw.SurfaceContact(foot, (0.1, 0.05), 0.6) for foot in HUMANOID.feet]
    assert tw.Scene(HUMANOID, contacts=wide).can_stand(q)
    assert missed_by(HUMANOID, q, wide) <= EDGE


@pytest.mark.parametrize("beyond", [-1e-6, -1e-12, 0.0, 1e-12, 1e-6])
def test_on_the_edge_the_documented_tolerance_decides(beyond):
    """A smooth box, tilted until its centre is above the edge that it turns about, and a hair further."""
    q, smooth = posed([0, np.arctan2(0.3, 0.1) + beyond, 0], [0, 0, 0]), points(["fl", "fr", "rl", "rr"], 0.0)
    margins = tw.stance_margins(BOX, q, smooth, sides=SIDES)
    assert margins.stands == (beyond < 1e-9)
    check_proof(BOX, q, smooth, margins)
    if margins.stands:
        pushed = tw.friction_inverse_dynamics(BOX, q, np.zeros(6), np.zeros(6), smooth)
        assert pushed.forces["fl"][2] == pytest.approx(BOX.mass * 9.81 / 2, rel=1e-5)


def test_a_contact_with_limits_of_its_own_is_asked_for_them():
    """A grasp bears any wrench; beside feet, too."""
    hung = tw.stance_margins(BOX, BOX.neutral(), [Grasp("fl")])
    assert (hung.stands, hung.friction_used) == (True, 0.0)
    pressed = hung.point_forces["fl"].sum(axis=0)
    assert np.allclose(pressed, -BOX.mass * BOX.gravity, rtol=0, atol=1e-6)
    held = tw.Scene(
        HUMANOID, contacts=[*SOLES[:1], Grasp("right_hand")] if "right_hand" in HUMANOID.frame_names else SOLES
    )
    assert held.can_stand()


class Weak:
    """A solver that does not solve: not installed, giving up, or wrong."""

    ways = (
        None,
        SimpleNamespace(solve=lambda H, f, A, b, primal_tol: (f, 0.0, -2, {"lam": b})),
        SimpleNamespace(solve=lambda H, f, A, b, primal_tol: (np.full(len(f), np.nan), 0.0, 1, {"lam": b})),
        SimpleNamespace(solve=lambda H, f, A, b, primal_tol: (f, 0.0, 1, {"lam": b})),
    )


@pytest.mark.parametrize("solver", Weak.ways, ids=["missing", "flag", "nan", "outside"])
@pytest.mark.parametrize("push", [5.0, 5.4, 6.0])
def test_the_least_forces_need_no_solver(monkeypatch, solver, push):
    """DAQP makes it quick; its answers are looked at, and the second method finds the same."""
    pytest.importorskip("daqp")
    a = np.r_[0, 0, 0, push, 0, 0, np.zeros(12)]

    def ask():
        try:
            found = tw.friction_inverse_dynamics(GO2, GO2.standing(), 0 * a, a, FEET)
        except tw.SingularError as error:
            return str(error), ()
        return np.concatenate(list(found.forces.values())), found.binding

    want, leans = ask()
    monkeypatch.setitem(sys.modules, "daqp", solver)
    got, leans_too = ask()
    assert leans == leans_too
    if push == 6.0:  # more than μ g
        assert got == want
        assert want.startswith("cannot: no forces within")
    else:
        assert np.abs(got - want).max() < 1e-8


def test_nonnegative_least_squares_leave_a_proof():
    rng = np.random.default_rng(3)
    for _ in range(200):
        E = rng.standard_normal((6, 20)) * rng.choice([1e-3, 1, 1e3], 20)
        E[:, 7], E[:, 9] = 0, E[:, 8]  # nothing, and one twice
        E[2] = np.abs(E[2]) * rng.choice([0, 1])
        f = rng.standard_normal(6)
        x, r = nonnegative_least_squares(E, f)
        assert (x >= 0).all()
        assert np.abs(E @ x + r - f).max() < 1e-12 * (1 + np.abs(E * x).max())
        assert (E.T @ r <= 1e-13 * np.sqrt((E * E).sum(axis=0))).all()  # of the conditions of Karush, Kuhn and Tucker
        assert abs(r @ f - r @ r) < 1e-13
    assert nonnegative_least_squares(np.zeros((3, 0)), np.ones(3))[1].tolist() == [1, 1, 1]


def test_the_least_breach_leaves_nothing_to_gain():
    rng = np.random.default_rng(4)
    for _ in range(50):
        A, b = rng.standard_normal((30, 5)), rng.standard_normal(30) - 1
        broken = least_breach(A, b, 1.0)
        assert np.abs(A.T @ broken).max() < 1e-6  # the gradient of the sum of the squares
    assert least_breach(np.eye(3), np.ones(3), 2.0).tolist() == [0, 0, 0]


def test_a_free_fall_asks_nothing_of_the_feet():
    rest, fall = np.zeros(18), np.r_[0, 0, 0, 0, 0, -9.81, np.zeros(12)]
    task = ContactProblem.of(GO2, GO2.standing(), rest, fall, FEET, None)
    assert task.reach(SIDES, "inner").reached
    assert np.abs(task.reach(SIDES, "inner").f).max() < 1e-9

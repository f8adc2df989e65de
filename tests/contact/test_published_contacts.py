"""What RBDL's tests ask of contacts, impacts and loops: its mechanisms made anew, its cases, our equations.

The rows of each contact are made here from `point_jacobian` and solved with M in one dense system of equations;
`contact_forward_dynamics` goes another way. tests/published_cases.toml says which case is asked by which test.
"""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

from ..algorithms.published import moved, one
from ..sampling import sampled

X, Y, Z = np.eye(3)
PI, ORIGIN = np.pi, np.zeros(3)


def about(axis, angle, *p):
    return tw.SE3(tw.exp3(np.multiply(angle, axis)), p)


def dense(model, q, v, tau, rows, bias, f_ext=None):
    """q̈ and λ of M q̈ + h = τ + Jᵀ λ, J q̈ + J̇ v = 0, by one least-squares solution of both."""
    M, J = tw.crba(model, q), np.array(rows)
    h, none = tw.rnea(model, q, v, 0 * v, f_ext), np.zeros((len(J), len(J)))
    x = np.linalg.lstsq(np.block([[M, -J.T], [J, none]]), np.r_[tau - h, -np.array(bias)], rcond=1e-12)[0]
    return x[: model.nv], x[model.nv :]


def agrees(x, y, size=1.0, tolerance=1e-11):
    """RBDL's own bound, relative to the largest number."""
    np.testing.assert_allclose(x, y, rtol=0, atol=tolerance * max(size, np.abs(y).max()))


# ---------------------------------------------------------------- contacts of one, two and three directions


def arms(children, base="fixed", second=ORIGIN):
    """A base with hinges z, y, x and bodies of 1 kg in a row, each with three more; contact points on them."""
    first = tw.SpatialInertia(1.0, [0.5, 0, 0], np.eye(3))
    builder = tw.Builder("arms", base=base, gravity=[0, -9.81, 0], root_inertia=first if base == "floating" else None)
    parent, bodies = (
        "base_link",
        [first] * (base == "fixed") + [tw.SpatialInertia(1.0, [0, 0.5, 0], np.eye(3))] * children,
    )
    for k, body in enumerate(bodies):
        at = ORIGIN if base == "fixed" and k == 0 else second
        for axis, place, solid in (("z", at, None), ("y", ORIGIN, None), ("x", ORIGIN, body)):
            builder.link(f"b{k}{axis}", parent=parent, joint=tw.Revolute(axis), placement=moved(*place), inertia=solid)
            parent = f"b{k}{axis}"
    last = len(bodies) - 1
    for name, link, point in (("near", last - (children > 1), (0.5, 0.5, 0)), ("far", last, (0.5, 0.5, 0)),
                              ("x", last, (1, 0, 0)), ("y", last, (0, 1, 0))):  # fmt: skip
        builder.link(name, parent=f"b{link}x", placement=moved(*point))
    return builder.build()


SIX, NINE = arms(1, second=X), arms(2)
FLOATING = arms(2, base="floating", second=X)
BENT = {0: 0.6, 3: 0.6 * PI, 4: 0.1}
CASES = {
    "single": (SIX, {}, {}, {"far": [Y]}),
    "single, bent": (SIX, BENT, {}, {"far": [Y]}),
    "single, bent, moving": (SIX, BENT, {0: -0.3, 1: 0.1, 2: -0.5, 3: 0.8}, {"far": [Y]}),
    "two points": (SIX, {}, {}, {"x": [Y], "y": [Y]}),
    "two directions": (SIX, {0: PI / 4, 1: 0.2, 3: PI / 2}, {}, {"far": [X, Y]}),
    "two bodies": (NINE, dict(enumerate([0.1, -0.1, 0.1, -0.1, -0.1, 0.1])),
                   dict(enumerate([1, -1, 1, -1.5, 1.5, -1.5])), {"near": [X, Y], "far": [Y]}),
    "two bodies, another state": (NINE, dict(enumerate([0.1, -0.3, 0.15, -0.21, -0.81, 0.11, 0.31, -0.91, 0.61])),
                                  dict(enumerate([1.3, -1.7, 3, -2.5, 1.5, -5.5, 2.5, -1.5, -3.5])),
                                  {"near": [X, Y], "far": [Y]}),
    "floating base": (FLOATING, {7: -0.3, 8: 0.15, 9: -0.21, 10: -0.81, 11: 0.11, 12: 0.31},
                      dict(enumerate([1.3, -1.7, 3, -2.5, 1.5, -5.5, 2.5, -1.5, -3.5, 0.1, 0.2, 0.3])),
                      {"near": [X, Y], "far": [Y]}),
    "a point": (FLOATING, {7: -0.3, 8: 0.15}, {0: 1.1, 3: -1.4, 7: 2.0}, {"far": [X, Y, Z]}),
}  # fmt: skip

PUSHED = [*CASES][1::2]  # by wrenches on their bodies


@pytest.mark.parametrize("case", sampled(CASES, 3))
def test_accelerations_and_forces_are_those_of_the_dense_equations(case):
    model, at, rates, held = CASES[case]
    q, v, rng = model.neutral(), np.zeros(model.nv), np.random.default_rng(3)
    for x, values in ((q, at), (v, rates)):
        x[list(values)] = list(values.values())
    tau = np.linspace(-0.5, 0.6, model.nv)
    f_ext = (
        rng.standard_normal((model.nbodies, 6)) * (np.arange(model.nbodies) > 0)[:, None] if case in PUSHED else None
    )
    contacts = [tw.SlidingContact(f, n) if len(n) < 3 else tw.PointContact(f, 0.5) for f, n in held.items()]
    rows = [n @ tw.point_jacobian(model, q, frame, ORIGIN) for frame, normals in held.items() for n in normals]
    ways = [(frame, n) for frame, normals in held.items() for n in normals]
    bias = [n @ tw.point_acceleration(model, q, v, 0 * v, frame, ORIGIN) for frame, n in ways]
    qdd, forces = dense(model, q, v, tau, rows, bias, f_ext)
    got = tw.contact_forward_dynamics(model, q, v, tau, contacts, f_ext)
    agrees(got.qdd, qdd)
    agrees(np.concatenate([got.forces[frame] for frame in held]), forces)
    accelerations = [n @ tw.point_acceleration(model, q, v, got.qdd, frame, ORIGIN) for frame, n in ways]
    agrees(accelerations, 0 * forces, size=np.abs(qdd).max())


def test_a_plate_that_three_directions_hold_bears_half_its_weight_at_each_end():
    """1 kg on two points 1 m apart, held along x at one of them; then stopped from (2, −1) m/s."""
    builder = tw.Builder("plate", gravity=[0, -9.81, 0])
    builder.link("x", parent="base_link", joint=tw.Prismatic("x"))
    builder.link("y", parent="x", joint=tw.Prismatic("y"))
    builder.link("plate", parent="y", joint=tw.Revolute("z"), inertia=one([0.0, 0, 0]))
    for name, x in (("left", -0.5), ("right", 0.5)):
        builder.link(name, parent="plate", placement=moved(x, 0, 0))
    model, held = builder.build(), [tw.SlidingContact("left", [Y, X]), tw.SlidingContact("right", Y)]
    rest = np.zeros(3)
    got = tw.contact_forward_dynamics(model, [0, 0, PI / 3], rest, rest, held)
    agrees(np.r_[got.forces["left"], got.forces["right"]], [9.81 / 2, 0, 9.81 / 2])
    agrees(got.qdd, rest)
    hit = tw.impact(model, rest, [2.0, -1, 0], held)
    agrees(np.r_[hit.impulses["left"], hit.impulses["right"], hit.v], [0.5, -2, 0.5, 0, 0, 0])
    slipped = tw.contact_forward_dynamics(model, [0, 0, PI / 3], [1.0, 0, 0], rest, held).slip
    agrees(slipped, [0, 1, 0])  # a wrong velocity along x is told in that row alone
    back = tw.Baumgarte(5.0, tw.contact_placements(model, [0, 0, PI / 3], held))
    pulled = tw.contact_forward_dynamics(model, [0, 0, PI / 3], [1.0, 0, 0], rest, held, stabilise=back)
    agrees(pulled.qdd, [-2 * 5.0, 0, 0])


@pytest.mark.parametrize("bent", [0.0, 1.0])
@pytest.mark.parametrize("after", [(0, 0, 0), (1, 2, 3)])
def test_a_point_has_the_velocity_that_the_impact_leaves_it(bent, after):
    builder, parent = tw.Builder("impulses", gravity=[0, -9.81, 0]), "base_link"
    for k in range(2):
        for axis, place, solid in (("z", k * X, None), ("y", ORIGIN, None), ("x", ORIGIN, one([0, 1.0, 0]))):
            builder.link(f"{k}{axis}", parent=parent, joint=tw.Revolute(axis), placement=moved(*place), inertia=solid)
            parent = f"{k}{axis}"
    builder.link("point", parent=parent, placement=moved(0, 1, 0))
    model, v = builder.build(), np.array([0.1, -0.2, 0.1, 0, 0, 0])
    q = bent * np.array([0.2, -0.5, 0.1, -0.4, -0.1, 0.4])
    hit = tw.impact(model, q, v, [tw.PointContact("point", 0.5, velocity=after)])
    agrees(tw.point_velocity(model, q, hit.v, "point", ORIGIN), after, tolerance=1e-14)
    J = tw.point_jacobian(model, q, "point", ORIGIN)
    agrees(tw.crba(model, q) @ (hit.v - v), J.T @ hit.impulses["point"], tolerance=1e-13)


# ---------------------------------------------------------------- loops


def bars(base="fixed", fifth=False):
    """Four bars of 2 m and 2 kg about z, two and two: they meet where the fifth hinge of RBDL's chain is."""
    builder, rod = (
        tw.Builder("four-bar", gravity=[0, -9.81, 0]),
        tw.SpatialInertia(2.0, [1.0, 0, 0], np.diag([0, 0, 8 / 3])),
    )
    root = "base_link"
    if base == "floating":
        for axis in "xyz":
            builder.link(f"t{axis}", parent=root, joint=tw.Prismatic(axis))
            root = f"t{axis}"
        builder.link("base", parent=root)
    for name, parent, at in (("b1", root, 0), ("b2", "b1", 2), ("b3", root, 0), ("b4", "b3", 2)):
        builder.link(name, parent=parent, joint=tw.Revolute("z"), placement=moved(at, 0, 0), inertia=rod)
    if fifth:
        builder.link("b5", parent="b4", joint=tw.Revolute("z"), placement=moved(2, 0, 0))
    builder.link("end", parent="b2", placement=moved(2, 0, 0))
    builder.link("tip", parent="b5" if fifth else "b4", placement=moved(0 if fifth else 2, 0, 0))
    return builder.build(physical=False)


def slider_crank(spherical):
    """A slider along x, a crank of 1 m and a rod of 3 m with a ball joint, which meets the slider."""
    builder = tw.Builder("slider-crank", gravity=[0, -9.81, 0])
    rod = tw.SpatialInertia(1.0, [1.5, 0, 0], np.diag([0.02, 9.12 / 12, 9.12 / 12]))
    crank = tw.SpatialInertia(3.0, [0.5, 0, 0], np.diag([0, 0, 1.0]))
    builder.link("slider", parent="base_link", joint=tw.Prismatic("x"), inertia=one([0.0, 0, 0]))
    builder.link(
        "crank", parent="base_link", joint=tw.Revolute("z"), inertia=crank, placement=about(Y, -PI / 2, 0, 0, 2.1)
    )
    knee, parent = about(Y, PI, 1, 0, 0), "crank"
    for axis in "b" if spherical else "zyx":
        joint = tw.Spherical() if spherical else tw.Revolute(axis)
        builder.link(f"rod_{axis}", parent=parent, joint=joint, placement=knee, inertia=rod if axis in "bx" else None)
        parent, knee = f"rod_{axis}", None
    builder.link("tip", parent=parent, placement=about(Y, -PI / 2, 3, 0, 0))
    builder.link("side", parent="tip", placement=moved(1, 0, 0))  # held along y, it keeps the tip from turning about z
    builder.link("end", parent="slider", placement=moved(0, 0, 0.1))
    return builder.build(physical=False)


PINNED = [tw.LoopClosure("tip", "end")]
UNTURNED = [*PINNED, tw.SlidingContact("side", Y, to="end")]
HELD_BASE = [*PINNED, tw.PointContact("base", 0.5)]
MECHANISMS = {
    "four-bar": (bars(), PINNED, [3 * PI / 4, -PI / 2, PI / 4, PI / 2], [-1.0, -1, -2, 1]),
    "four-bar, stretched": (bars(), PINNED, np.zeros(4), [-1.0, -1, -1, -1]),
    "floating four-bar": (bars("floating"), HELD_BASE, [0, 0, 0, 3 * PI / 4, -PI / 2, PI / 4, PI / 2],
                          [0.0, 0, 0, -1, -1, -2, 1]),
    "slider-crank": (slider_crank(False), UNTURNED, [0.4, PI / 4, -PI / 4, 0.01, 0.01], None),
    "slider-crank, ball joint": (slider_crank(True), UNTURNED, None, None),
}  # fmt: skip
loops = pytest.mark.parametrize("name", MECHANISMS)


def rows_by_hand(model, q, v, contacts):
    """The rows of the points that each contact holds, in the axes of what holds it, and J̇ v of each."""
    rows, bias = [], []
    for c in contacts:
        R, ends = np.eye(3), [(c.frame, ORIGIN)]
        if c.to is not None:  # and the point of the other frame at the same place; that frame does not turn, or is met
            here, there = (tw.frame_placement(model, q, f) for f in (c.frame, c.to))
            R, point = there.rotation, there.rotation.T @ (here.translation - there.translation)
            ends.append((c.to, point))
        which = np.array(c.normals) if isinstance(c, tw.SlidingContact) else np.eye(3)
        J = [which @ R.T @ tw.point_jacobian(model, q, *end) for end in ends]
        b = [which @ R.T @ tw.point_acceleration(model, q, v, 0 * v, *end) for end in ends]
        rows += list(J[0] - sum(J[1:]))
        bias += list(b[0] - sum(b[1:]))
    return np.array(rows), np.array(bias)


def together(contacts):
    """Where the loop's frames belong: the tip in the end, its side 1 m beside it, the base at the origin."""
    return {c.frame: moved(float(c.frame == "side"), 0, 0) for c in contacts}


def assembled(name):
    """A state in which the loop is closed and stays so."""
    model, contacts, q, v = MECHANISMS[name]
    if q is None:  # the ball joint of the crank from a turn like that of the three hinges
        q = model.integrate(model.neutral(), [0.4, PI / 4, 0.01, 0.01, -PI / 4])
    v = np.linspace(0.4, -0.5, model.nv) if v is None else v
    return model, contacts, *tw.project_state(model, q, v, contacts, together(contacts))


@loops
def test_a_loop_is_assembled(name):
    model, contacts, q, v = assembled(name)
    there = [tw.frame_placement(model, q, frame) for frame in ("tip", "end")]
    agrees(there[0].translation, there[1].translation)
    if "crank" in name:
        R = there[1].rotation.T @ there[0].rotation
        agrees(R[1, 0], 0, size=1.0)
    elif MECHANISMS[name][3] is not None:  # it was closed already
        agrees(q, MECHANISMS[name][2])
        agrees(v, MECHANISMS[name][3])
    gap = model.integrate(q, 0.02 * np.cos(np.arange(model.nv)))
    again, _ = tw.project_state(model, gap, v, contacts, together(contacts))
    here = tw.contact_placements(model, again, contacts)
    for frame, T in together(contacts).items():
        only = Y if frame == "side" else np.eye(3)
        agrees(only @ here[frame].translation, only @ T.translation)


def test_of_a_loop_some_joints_are_kept_as_they_are():
    """RBDL's weights: the first and third angle of the four-bar stay, the others close it."""
    model, q = bars(), np.array([3 * PI / 4 - 0.2, -PI / 2, PI / 4 + 0.1, PI / 2 - 0.03])
    kept = [*PINNED, *(tw.Coupling(name, {}) for name in ("b1", "b3"))]
    anchors = {**together(PINNED), **{c.frame: tw.contact_placements(model, q, kept)[c.frame] for c in kept[1:]}}
    closed, v = tw.project_state(model, q, [0.01, 0.5, -0.7, -0.5], PINNED, together(PINNED))
    agrees(tw.contact_placements(model, closed, PINNED)["tip"].translation, ORIGIN)
    closed, _ = tw.project_state(model, q, v, kept, anchors)
    agrees(closed[[0, 2]], q[[0, 2]])
    agrees(tw.contact_placements(model, closed, PINNED)["tip"].translation, ORIGIN)
    rates = tw.impact(model, closed, [0.01, 0.5, -0.7, -0.5], [PINNED[0], tw.Coupling("b1", {}, velocity=[0.01]),
                                                              tw.Coupling("b3", {}, velocity=[-0.7])])  # fmt: skip
    agrees(rates.v[[0, 2]], [0.01, -0.7])
    agrees(tw.constraint_jacobian(model, closed, PINNED) @ rates.v, ORIGIN)


@loops
def test_what_a_loop_is_off_and_how_fast_is_told(name):
    model, contacts, q, v = assembled(name)
    far = model.integrate(q, 0.3 * np.sin(1 + np.arange(model.nv)))
    tip, end = (tw.frame_placement(model, far, frame) for frame in ("tip", "end"))
    off = tw.contact_placements(model, far, contacts)["tip"]
    agrees(off.translation, end.rotation.T @ (tip.translation - end.translation))
    agrees(off.rotation, end.rotation.T @ tip.rotation)
    wrong = np.linspace(-1, 1, model.nv)
    rows, _ = rows_by_hand(model, q, v, contacts)
    agrees(tw.constraint_jacobian(model, q, contacts), rows)
    if "stretched" in name:  # its bars cannot leave their line with different rates
        with pytest.raises(tw.SingularError, match="the contacts contradict each other"):
            tw.contact_forward_dynamics(model, q, wrong, 0 * v, contacts)
    else:
        agrees(tw.contact_forward_dynamics(model, q, wrong, 0 * v, contacts).slip, rows @ wrong)
    agrees(tw.constraint_jacobian(model, q, contacts) @ v, np.zeros(len(rows)))


@loops
def test_accelerations_of_a_loop_are_those_of_the_dense_equations(name):
    model, contacts, q, v = assembled(name)
    tau = np.array([1.0, -2, 3, -5, 7, -4, 2])[: model.nv]
    rows, bias = rows_by_hand(model, q, v, contacts)
    got = tw.contact_forward_dynamics(model, q, v, tau, contacts)
    agrees(got.qdd, dense(model, q, v, tau, rows, bias)[0])
    ends = [tw.point_acceleration(model, q, v, got.qdd, frame, ORIGIN) for frame in ("tip", "end")]
    agrees(ends[0], ends[1], size=np.abs(got.qdd).max())


def test_the_massless_fifth_hinge_of_the_four_bar_changes_nothing():
    """RBDL has a fifth body without mass, welded to the second bar. Its τ is a couple between bars 2 and 4."""
    full, model, contacts, q, v = bars(fifth=True), *assembled("four-bar")
    tau = np.array([1.0, -2, 3, -5, 7])
    closing = np.array([1, 1, -1, -1])
    q5, v5 = np.append(q, closing @ q), np.append(v, closing @ v)
    rows, bias = rows_by_hand(full, q5, v5, PINNED)
    turn = tw.frame_jacobian(full, q5, "tip", "world")[2] - tw.frame_jacobian(full, q5, "end", "world")[2]
    expected, forces = dense(full, q5, v5, tau, [*rows, turn], [*bias, 0])
    got = tw.contact_forward_dynamics(model, q, v, tau[:4] + 7 * closing, contacts)
    agrees(got.qdd, expected[:4])
    agrees(closing @ got.qdd, expected[4], size=np.abs(expected).max())
    assert np.isclose(abs(forces[-1]), 7)  # the turn of the massless body is held by its motor


@loops
def test_an_impact_leaves_a_loop_the_velocity_that_is_given(name):
    model, contacts, q, v = assembled(name)
    before = np.linspace(1, -2, model.nv)
    rows, _ = rows_by_hand(model, q, v, contacts)
    hit = tw.impact(model, q, before, contacts)
    agrees(rows @ hit.v, np.zeros(len(rows)), size=np.abs(hit.v).max())
    M = tw.crba(model, q)
    agrees(M @ (hit.v - before), rows.T @ np.linalg.lstsq(rows.T, M @ (hit.v - before))[0])
    asked = 0.3 * rows @ np.cos(np.arange(model.nv))  # one that the loop can have
    count = np.split(asked, np.cumsum([c.dim for c in contacts])[:-1])
    given = [type(c)(c.frame, *rest(c), velocity=x) for c, x in zip(contacts, count, strict=True)]
    agrees(rows @ tw.impact(model, q, before, given).v, asked, size=np.abs(hit.v).max())


def rest(c):
    return {tw.LoopClosure: ("end",), tw.PointContact: (0.5,), tw.SlidingContact: (Y, "end")}[type(c)]


# ---------------------------------------------------------------- bodies held together instead of joints


def test_two_free_bodies_held_by_hinges_are_the_double_pendulum_of_joints():
    """RBDL's double perpendicular pendulum: hinges about z and y as loops. A hinge is two points of its axis."""
    mass, inertia, l = 1.0, np.diag([1e-2, 1.0, 1.0]), 1.5
    body = tw.SpatialInertia(mass, [l / 2, 0, 0], inertia)
    joints = tw.Builder("joints", gravity=[0, -9.81, 0])
    joints.link("one", parent="base_link", joint=tw.Revolute("z"), inertia=body)
    joints.link("two", parent="one", joint=tw.Revolute("y"), placement=moved(l, 0, 0), inertia=body)
    joined = joints.build()
    free = tw.Builder("free", gravity=[0, -9.81, 0])
    for name, axis in (("one", Z), ("two", Y)):
        free.link(name, parent="base_link", joint=tw.FreeFlyer(), inertia=body)
        free.link(f"{name}_root", parent=name)
        free.link(f"{name}_axis", parent=name, placement=moved(*axis))
    free.link("one_end", parent="one", placement=moved(l, 0, 0))
    free.link("one_end_axis", parent="one", placement=moved(l, 1, 0))
    model = free.build()
    held = [*(tw.PointContact(f, 0.5) for f in ("one_root", "one_axis")),
            tw.LoopClosure("two_root", "one_end"), tw.LoopClosure("two_axis", "one_end_axis")]  # fmt: skip
    angles, rates, tau = np.array([PI / 3, PI / 6]), np.array([0.7, -1.2]), np.array([0.4, -0.9])
    place = tw.forward_kinematics(joined, angles, rates, tw.aba(joined, angles, rates, tau))
    q, v, wanted = model.neutral(), np.zeros(12), np.zeros(12)
    wrench = np.zeros(12)
    for name in ("one", "two"):
        i = model.joint_id(name)
        T, i_here = place.placement[joined.joint_id(name)], joined.joint_id(name)
        q[model.q_slice[i]] = np.r_[T.translation, tw.spatial.rotation_to_quaternion(T.rotation)]
        v[model.v_slice[i]], wanted[model.v_slice[i]] = place.twist[i_here], place.acceleration[i_here]
    R12 = place.placement[joined.joint_id("one")].rotation.T @ place.placement[joined.joint_id("two")].rotation
    first, second = (model.v_slice[model.joint_id(name)] for name in ("one", "two"))
    wrench[first][:3] = tau[0] * Z - tau[1] * (R12 @ Y)
    wrench[second][:3] = tau[1] * Y
    got = tw.contact_forward_dynamics(model, q, v, wrench, held)
    agrees(got.slip, np.zeros(12))
    assert (int(got.rank), int(got.redundant)) == (10, 2)
    agrees(got.qdd, wanted)

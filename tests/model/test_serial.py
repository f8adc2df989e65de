"""Arms by screw axes, as Modern Robotics prints them, and by tables of DH, in the manner of Craig, Spong and Corke.

The tables of DH and their closed forms are written down here, not copied: no page or edition of a book is claimed. Only
the Puma's masses, and its g and M in `test_published.py`, were read where they are published: in the Robotics Toolbox.
"""

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench.model import Helical, Prismatic, Revolute
from twistwrench.spatial import SE3, SpatialInertia, Twist, exp3, exp6

from ..robots import shared

PI = np.pi


def fk(model, q, frame):
    return tw.frame_placement(model, q, frame).matrix()


# --- screw axes: Modern Robotics -----------------------------------------------------------------

W1, W2, L1, L2, H1, H2 = 0.109, 0.082, 0.425, 0.392, 0.089, 0.095
UR5_M = [[-1, 0, 0, L1 + L2], [0, 0, 1, W1 + W2], [0, 1, 0, H1 - H2], [0, 0, 0, 1]]
UR5_S = np.array(
    [
        [0, 0, 1, 0, 0, 0],
        [0, 1, 0, -H1, 0, 0],
        [0, 1, 0, -H1, 0, L1],
        [0, 1, 0, -H1, 0, L1 + L2],
        [0, 0, -1, -W1, L1 + L2, 0],
        [0, 1, 0, H2 - H1, 0, L1 + L2],
    ]
).T

# The three-link arm of the book's code: every docstring of its chapter 8 has it.
MLIST = [
    SE3(np.eye(3), [0, 0, 0.089159]).matrix(),
    [[0, 0, 1, 0.28], [0, 1, 0, 0.13585], [-1, 0, 0, 0], [0, 0, 0, 1]],
    SE3(np.eye(3), [0, -0.1197, 0.395]).matrix(),
    SE3(np.eye(3), [0, 0, 0.14225]).matrix(),
]
GLIST = [
    np.diag([0.010267, 0.010267, 0.00666, 3.7, 3.7, 3.7]),
    np.diag([0.22689, 0.22689, 0.0151074, 8.393, 8.393, 8.393]),
    np.diag([0.0494433, 0.0494433, 0.004095, 2.275, 2.275, 2.275]),
]
SLIST = np.array([[1, 0, 1, 0, 1, 0], [0, 1, 0, -0.089, 0, 0], [0, 1, 0, -0.089, 0, 0.425]]).T


def three_links():
    M = np.linalg.multi_dot([np.array(m, float) for m in MLIST])
    # Printed as they are, its first axis (1, 0, 1) is not of length 1: the book's code takes it all the same.
    S = SLIST / np.where(np.arange(3) == 0, np.sqrt(2), 1)
    return tw.from_screw_axes(M, S, Mlist=MLIST, Glist=GLIST, gravity=[0, 0, -9.8])


def test_the_ur5_as_printed():
    ur5 = tw.from_screw_axes(UR5_M, UR5_S)
    np.testing.assert_allclose(fk(ur5, np.zeros(6), "tool"), UR5_M, rtol=0, atol=1e-15)
    # Example 4.5: θ₂ = −90°, θ₅ = 90°
    printed = [[0, -1, 0, 0.095], [1, 0, 0, 0.109], [0, 0, 1, 0.988], [0, 0, 0, 1]]
    np.testing.assert_allclose(fk(ur5, [0, -PI / 2, 0, 0, PI / 2, 0], "tool"), printed, rtol=0, atol=4e-4)
    M, Slist, _ = tw.screw_axes(ur5, "tool")
    np.testing.assert_allclose(M, UR5_M, rtol=0, atol=1e-15)
    np.testing.assert_allclose(Slist, UR5_S, rtol=0, atol=1e-15)


def test_the_examples_of_its_forward_kinematics():
    M = SE3(np.diag([-1, 1, -1]), [0, 6, 2]).matrix()
    S = np.array([[0, 0, 1, 4, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, -1, -6, 0, -0.1]]).T
    B = np.array([[0, 0, -1, 2, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 1, 0, 0, 0.1]]).T
    expected = [[0, 1, 0, -5], [1, 0, 0, 4], [0, 0, -1, 1.68584073], [0, 0, 0, 1]]
    for arm in (tw.from_screw_axes(M, S), tw.from_screw_axes(M, Blist=B)):
        np.testing.assert_allclose(fk(arm, [PI / 2, 3, PI], "tool"), expected, rtol=0, atol=5e-9)
        assert [type(joint) for joint in arm.joints[1:]] == [Revolute, Prismatic, Helical]
        np.testing.assert_allclose(tw.screw_axes(arm, "tool").Blist, B, rtol=0, atol=1e-15)


def test_the_examples_of_its_dynamics():
    """`InverseDynamics` with no wrench at the tip needs axes of length 1: all but its first joint are."""
    mr = pytest.importorskip("modern_robotics", reason="modern_robotics is not installed: its code is not asked")
    arm, rng = three_links(), np.random.default_rng(0)
    _, S, _ = tw.screw_axes(arm, "tool")
    for _ in range(5):
        q, v, a = rng.normal(size=(3, 3))
        theirs = mr.InverseDynamics(q, v, a, arm.gravity, np.zeros(6), np.array(MLIST), np.array(GLIST), S)
        np.testing.assert_allclose(tw.rnea(arm, q, v, a), theirs, rtol=0, atol=1e-12)
        M = mr.MassMatrix(q, np.array(MLIST), np.array(GLIST), S)
        np.testing.assert_allclose(tw.crba(arm, q), M, rtol=0, atol=1e-12)
        J = mr.JacobianSpace(S, q)
        np.testing.assert_allclose(tw.frame_jacobian(arm, q, "tool", "world"), J, rtol=0, atol=1e-13)


def test_random_screws_multiply_as_exponentials():
    rng = np.random.default_rng(1)
    for n in (1, 3, 7):
        M, pitch = exp6(rng.normal(size=6)).matrix(), rng.choice([0, 0.2, -0.1, np.inf], size=n)
        S = Twist.from_screw(rng.normal(size=(n, 3)), rng.normal(size=(n, 3)), pitch).vector.T
        q, T = rng.normal(size=n), SE3.identity()
        for k in range(n):
            T = T @ exp6(S[:, k] * q[k])
        arm = tw.from_screw_axes(M, S)
        np.testing.assert_allclose(fk(arm, q, "tool"), T.matrix() @ M, rtol=0, atol=1e-13)
        found = tw.screw_axes(arm, "tool")
        np.testing.assert_allclose(found.Slist, S, rtol=0, atol=1e-14)
        np.testing.assert_allclose(fk(tw.from_screw_axes(M, Blist=found.Blist), q, "tool"), T.matrix() @ M, atol=1e-13)


def test_the_product_of_exponentials_in_fifty_digits_pinocchio_and_programs():
    rng = np.random.default_rng(7)
    M, pitch = exp6(rng.normal(size=6)).matrix(), [0, np.inf, 0.2, -0.1]
    S = Twist.from_screw(rng.normal(size=(4, 3)), rng.normal(size=(4, 3)), pitch).vector.T
    arm, q = tw.from_screw_axes(M, S), rng.normal(size=(3, 4))
    with mpmath.workdps(50):
        T = mpmath.eye(4)
        for s, x in zip(S.T, q[0]):
            way = np.zeros((4, 4))
            way[:3, :3], way[:3, 3] = tw.skew(s[:3]), s[3:]
            T = T * mpmath.expm(mpmath.matrix(way.tolist()) * mpmath.mpf(x))
        exact = np.array((T * mpmath.matrix(M.tolist())).tolist(), float)
    np.testing.assert_allclose(fk(arm, q[0], "tool"), exact, rtol=0, atol=5e-15)
    for dtype in (np.float32, np.float64):
        program = tw.compile(arm, "frame_placement", frames=["tool"], dtype=dtype)
        got = program(q.astype(dtype))[:, 0]
        np.testing.assert_allclose(got, fk(arm, q, "tool"), rtol=0, atol=50 * np.finfo(dtype).eps)
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    there = tw.bridge.to_pinocchio_model(arm)
    data = there.createData()
    pin.framesForwardKinematics(there, data, q[0])
    np.testing.assert_allclose(data.oMf[there.getFrameId("tool")].homogeneous, exact, rtol=0, atol=5e-15)


def test_a_model_and_its_screw_axes_make_the_same_motion():
    chain = tw.random_tree(6, rng=3, kinds=("revolute", "prismatic", "helical"), branching=0.0)
    tip = chain.joint_names[-1]
    M, S, _ = tw.screw_axes(chain, tip)
    again, q = tw.from_screw_axes(M, S), np.random.default_rng(4).normal(size=6)
    np.testing.assert_allclose(fk(again, q, "tool"), fk(chain, q, tip), rtol=0, atol=1e-13)


def test_joints_beside_the_way_to_the_frame_have_columns_of_zeros():
    tree = tw.load("go2", base="fixed")
    _, S, _ = tw.screw_axes(tree, "FR_foot")
    moving = [joint for i, joint in enumerate(tree.joint_names[1:]) if S[:, i].any()]
    assert moving == ["FR_hip_joint", "FR_thigh_joint", "FR_calf_joint"]
    with pytest.raises(tw.ModelError, match="joint 'root_joint': expected joints of one degree of freedom"):
        tw.screw_axes(shared("go2"), "FR_foot")


def test_bad_screw_axes_are_named():
    with pytest.raises(tw.ModelError, match="either Slist or Blist, got both or neither"):
        tw.from_screw_axes(np.eye(4))
    with pytest.raises(
        tw.ModelError, match=r"Slist: joint 1: expected \|ω\| = 1, or ω = 0 and \|v\| = 1, got a length"
    ):
        tw.from_screw_axes(np.eye(4), SLIST)
    with pytest.raises(tw.ModelError, match="Slist: joint 2: expected a screw axis, got zeros"):
        tw.from_screw_axes(np.eye(4), np.eye(6)[:, :2] * [1, 0])
    with pytest.raises(tw.ShapeError, match="Blist: expected a column for each joint"):
        tw.from_screw_axes(np.eye(4), Blist=np.ones((3, 2)))
    with pytest.raises(tw.ModelError, match="both Mlist and Glist"):
        tw.from_screw_axes(UR5_M, UR5_S, Glist=GLIST)
    with pytest.raises(tw.ShapeError, match="expected 6 or 7 entries of Mlist and 6 of Glist, got 4 and 3"):
        tw.from_screw_axes(UR5_M, UR5_S, Mlist=MLIST, Glist=GLIST)


# --- Denavit and Hartenberg ----------------------------------------------------------------------


def test_a_puma_560_in_the_modified_convention():
    """A wrist whose axes meet, in the manner of Craig (Introduction to Robotics): its tool in closed form."""
    a2, a3, d3, d4 = 0.4318, 0.0203, 0.1245, 0.4318
    alpha, a, d = [0, -PI / 2, 0, -PI / 2, PI / 2, -PI / 2], [0, 0, a2, a3, 0, 0], [0, 0, d3, d4, 0, 0]
    puma = tw.from_dh(a=a, alpha=alpha, d=d, convention="modified")
    q = np.array([0.3, -0.7, 1.1, 0.4, -0.9, 2.0])
    (c1, c2, _, c4, c5, c6), (s1, s2, _, s4, s5, s6) = np.cos(q), np.sin(q)
    c23, s23 = np.cos(q[1] + q[2]), np.sin(q[1] + q[2])
    T = fk(puma, q, "link6")
    inner, outer = c23 * (c4 * c5 * c6 - s4 * s6) - s23 * s5 * c6, s4 * c5 * c6 + c4 * s6
    first = [c1 * inner + s1 * outer, s1 * inner - c1 * outer, -s23 * (c4 * c5 * c6 - s4 * s6) - c23 * s5 * c6]
    reach = a2 * c2 + a3 * c23 - d4 * s23
    p = [c1 * reach - d3 * s1, s1 * reach + d3 * c1, -a3 * s23 - a2 * s2 - d4 * c23]
    np.testing.assert_allclose(T[:3, 0], first, rtol=0, atol=1e-15)
    np.testing.assert_allclose(T[:3, 3], p, rtol=0, atol=1e-15)


def test_a_stanford_arm_and_a_scara_in_the_classical_convention():
    """In the manner of Spong, Hutchinson and Vidyasagar (Robot Modeling and Control): their tools in closed form."""
    d2, d6, q = 0.154, 0.263, np.array([0.3, -0.7, 0.5, 0.4, -0.9, 2.0])
    alpha = [-PI / 2, PI / 2, 0, -PI / 2, PI / 2, 0]
    arm = tw.from_dh(a=np.zeros(6), alpha=alpha, d=[0, d2, 0, 0, 0, d6], convention="classical", kinds="RRPRRR")
    (c1, c2, _, c4, c5, _), (s1, s2, _, s4, s5, _) = np.cos(q), np.sin(q)
    x = c1 * s2 * q[2] - s1 * d2 + d6 * (c1 * c2 * c4 * s5 + c1 * c5 * s2 - s1 * s4 * s5)
    y = s1 * s2 * q[2] + c1 * d2 + d6 * (c1 * s4 * s5 + c2 * c4 * s1 * s5 + c5 * s1 * s2)
    z = c2 * q[2] + d6 * (c2 * c5 - c4 * s2 * s5)
    np.testing.assert_allclose(fk(arm, q, "link6")[:3, 3], [x, y, z], rtol=0, atol=1e-15)

    a1, a2, d4 = 0.4, 0.3, 0.1
    scara = tw.from_dh(a=[a1, a2, 0, 0], alpha=[0, PI, 0, 0], d=[0, 0, 0, d4], convention="classical", kinds="RRPR")
    one, both, turn = q[0], q[0] + q[1], q[0] + q[1] - q[3]
    expected = [a1 * np.cos(one) + a2 * np.cos(both), a1 * np.sin(one) + a2 * np.sin(both), -q[2] - d4]
    T = fk(scara, q[:4], "link4")
    np.testing.assert_allclose(T[:3, 3], expected, rtol=0, atol=1e-15)
    R = [[np.cos(turn), np.sin(turn), 0], [np.sin(turn), -np.cos(turn), 0], [0, 0, -1]]
    np.testing.assert_allclose(T[:3, :3], R, rtol=0, atol=1e-15)


PUMA = {"a": [0, 0.4318, 0.0203, 0, 0, 0], "d": [0, 0, 0.15005, 0.4318, 0, 0]}
PUMA |= {"alpha": [PI / 2, 0, -PI / 2, PI / 2, -PI / 2, 0], "convention": "classical"}


def corkes_puma():
    """Masses, centres, moments, rotors and gears of the Robotics Toolbox for Python, ``models/DH/Puma560.py``.

    It names its source: P. Corke and B. Armstrong-Hélouvry, A search for consensus among model parameters reported for
    the PUMA 560 robot, ICRA 1994.
    """
    mass = [0, 17.4, 4.8, 0.82, 0.34, 0.09]
    com = [[0, 0, 0], [-0.3638, 0.006, 0.2275], [-0.0203, -0.0141, 0.070], [0, 0.019, 0], [0, 0, 0], [0, 0, 0.032]]
    moments = [[0, 0.35, 0], [0.13, 0.524, 0.539], [0.066, 0.086, 0.0125], [1.8e-3, 1.3e-3, 1.8e-3]]
    moments += [[0.3e-3, 0.4e-3, 0.3e-3], [0.15e-3, 0.15e-3, 0.04e-3]]
    rotor = np.array([200e-6, 200e-6, 200e-6, 33e-6, 33e-6, 33e-6])
    gear = np.array([-62.6111, 107.815, -53.7063, 76.0364, 71.923, 76.686])
    bodies = [SpatialInertia(m, c, np.diag(I)) for m, c, I in zip(mass, com, moments)]
    # As published, link 3 breaks the triangle inequality: 0.066 + 0.0125 < 0.086.
    return tw.from_dh(**PUMA, inertias=bodies, armature=gear**2 * rotor, physical=False)


def test_corkes_puma_560():
    """The tool in closed form; g and M as the Toolbox's tests have them, four digits behind the point."""
    puma, qn = corkes_puma(), [0, PI / 4, PI, 0, PI / 4, 0]
    a2, a3, d3, d4 = 0.4318, 0.0203, 0.15005, 0.4318
    p = [(a2 - a3 + d4) * 0.5**0.5, -d3, (a2 - a3 - d4) * 0.5**0.5]
    T = [[0, 0, 1, p[0]], [0, 1, 0, p[1]], [-1, 0, 0, p[2]], [0, 0, 0, 1]]
    np.testing.assert_allclose(fk(puma, qn, "link6"), T, rtol=0, atol=1e-15)
    np.testing.assert_allclose(fk(puma, np.zeros(6), "link6")[:3, 3], [a2 + a3, -d3, d4], rtol=0, atol=1e-15)
    np.testing.assert_allclose(tw.gravity(puma, qn), [0, 31.6399, 6.0351, 0, 0.0283, 0], rtol=0, atol=6e-5)
    printed = [
        [3.6594, -0.4044, 0.1006, -0.0025, 0, 0],
        [-0.4044, 4.4137, 0.3509, 0, 0.0024, 0],
        [0.1006, 0.3509, 0.9378, 0, 0.0015, 0],
        [-0.0025, 0, 0, 0.1925, 0, 0],
        [0, 0.0024, 0.0015, 0, 0.1713, 0],
        [0, 0, 0, 0, 0, 0.1941],
    ]
    np.testing.assert_allclose(tw.crba(puma, qn), printed, rtol=0, atol=6e-5)


def test_both_conventions_describe_one_arm():
    """Modified row i holds the a and α of classical row i − 1, and the last a and α are left over."""
    rng = np.random.default_rng(5)
    a, alpha, d, theta, q = rng.normal(size=(5, 4))
    kinds = "RPRR"
    one = tw.from_dh(a=a, alpha=alpha, d=d, theta=theta, convention="classical", kinds=kinds)
    rest = {"d": d, "theta": theta, "convention": "modified", "kinds": kinds}
    two = tw.from_dh(a=[0, *a[:-1]], alpha=[0, *alpha[:-1]], **rest)
    last = SE3(exp3([alpha[-1], 0, 0]), [a[-1], 0, 0]).matrix()
    np.testing.assert_allclose(fk(one, q, "link4"), fk(two, q, "link4") @ last, rtol=0, atol=1e-14)


def test_each_dh_matrix_is_the_product_of_its_four_motions():
    rng = np.random.default_rng(6)
    a, alpha, d, theta = rng.normal(size=(4, 1))
    q = rng.normal(size=1)
    x = SE3(exp3([*alpha, 0, 0]), [*a, 0, 0]).matrix()
    for kind in "RP":
        angle, slide = (theta + q, d) if kind == "R" else (theta, d + q)
        z = SE3(exp3([0, 0, *angle]), [0, 0, *slide]).matrix()
        for convention, expected in (("classical", z @ x), ("modified", x @ z)):
            arm = tw.from_dh(a=a, alpha=alpha, d=d, theta=theta, convention=convention, kinds=kind)
            np.testing.assert_allclose(fk(arm, q, "link1"), expected, rtol=0, atol=2e-15)


@pytest.mark.parametrize("convention", ["classical", "modified"])
def test_a_table_is_right_to_fifty_digits(convention):
    rng = np.random.default_rng(8)
    a, alpha, d, theta, q = rng.normal(size=(5, 6))
    arm = tw.from_dh(a=a, alpha=alpha, d=d, theta=theta, convention=convention, kinds="RRPRPR")
    with mpmath.workdps(50):

        def motion(turn, slide, axis):
            c, s = mpmath.cos(turn), mpmath.sin(turn)
            R = [[1, 0, 0], [0, c, -s], [0, s, c]] if axis == 0 else [[c, -s, 0], [s, c, 0], [0, 0, 1]]
            return mpmath.matrix([[*row, slide * (k == axis)] for k, row in enumerate(R)] + [[0, 0, 0, 1]])

        T = mpmath.eye(4)
        for k, kind in enumerate("RRPRPR"):
            turn, slide = mpmath.mpf(theta[k]), mpmath.mpf(d[k])
            z = motion(turn + q[k], slide, 2) if kind == "R" else motion(turn, slide + q[k], 2)
            x = motion(mpmath.mpf(alpha[k]), mpmath.mpf(a[k]), 0)
            T = T * (z * x if convention == "classical" else x * z)
        exact = np.array(T.tolist(), float)
    np.testing.assert_allclose(fk(arm, q, "link6"), exact, rtol=0, atol=5e-15)


def test_masses_are_given_in_the_frames_of_the_table():
    body = SpatialInertia.from_box(2.0, [0.1, 0.2, 0.3]).transform(SE3(np.eye(3), [0.1, 0.2, 0.3]))
    for convention in ("classical", "modified"):
        arm = tw.from_dh(a=[0.5, 0.4], alpha=[0.3, 0.2], d=[0.1, 0], convention=convention, inertias=[body, body])
        q = [0.3, -0.8]
        places = [tw.frame_placement(arm, q, f"link{i}") for i in (1, 2)]
        com = np.mean([T.act(body.com) for T in places], axis=0)
        np.testing.assert_allclose(tw.center_of_mass(arm, q), com, rtol=0, atol=1e-15)


def test_limits_and_armature_are_those_of_the_joints():
    arm = tw.from_dh(a=[1, 1], alpha=0, d=0, convention="classical", armature=[0.1, 0.2], lower=-1, upper=[1, 2])
    np.testing.assert_array_equal(arm.armature, [0.1, 0.2])
    np.testing.assert_array_equal([arm.lower, arm.upper], [[-1, -1], [1, 2]])


def test_a_bad_table_is_named():
    good = {"a": [1, 1], "alpha": 0, "d": 0, "convention": "classical"}
    with pytest.raises(tw.ModelError, match="convention: expected 'classical' or 'modified', got 'standard'"):
        tw.from_dh(**good | {"convention": "standard"})
    with pytest.raises(tw.ShapeError, match=r"expected columns of one length, got a \(2,\), d \(3,\)"):
        tw.from_dh(**good | {"d": [1, 2, 3]})
    with pytest.raises(tw.ModelError, match="kinds: expected 2 letters R or P, got 'RX'"):
        tw.from_dh(**good, kinds="RX")
    with pytest.raises(tw.ShapeError, match="inertias: expected one for each of the 2 joints, got 1"):
        tw.from_dh(**good, inertias=[SpatialInertia.zero()])
    with pytest.raises(tw.NameNotFound, match="unknown argument 'limit'"):
        tw.from_dh(**good, limit=1)

"""Joints that follow others: the smaller model against Pinocchio's, finite differences, energy and power."""

import pickle
from xml.etree import ElementTree

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge

from .test_urdf_bad import LIMIT, refuse

BODY = """<inertial><origin xyz="0.1 0.2 0.5" rpy="0.1 0.2 0.3"/><mass value="{m}"/>
<inertia ixx="0.3" iyy="0.2" izz="0.15" ixy="0.01" ixz="0.02" iyz="0.03"/></inertial>"""


def robot(*joints):
    """Write a chain; each joint is (name, type, axis, what else stands in it)."""
    links = "".join(f'<link name="l{i}">{BODY.format(m=1 + i)}</link>' for i in range(len(joints) + 1))
    chain = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="l{i}"/><child link="l{i + 1}"/><axis xyz="{axis}"/>'
        f'<origin xyz="0.3 0.1 0.4" rpy="0.3 -0.2 0.5"/>{"" if kind == "continuous" else LIMIT}{extra}</joint>'
        for i, (name, kind, axis, extra) in enumerate(joints)
    )
    return f'<robot name="r">{links}{chain}</robot>'


FINGER = robot(
    ("a", "revolute", "0 1 0", ""),
    ("b", "revolute", "1 1 0", '<mimic joint="a" multiplier="-0.7" offset="0.3"/>'),
    ("c", "prismatic", "0 0 1", '<mimic joint="a" multiplier="0.2"/>'),
    ("d", "revolute", "0 0 1", ""),
    ("e", "revolute", "1 0 0", '<mimic joint="d"/>'),
)
# Pinocchio takes a leader that comes before, and follows a continuous joint by continuous ones only.
CONTINUOUS = robot(
    ("a", "continuous", "0 1 0", ""),
    ("b", "continuous", "1 1 0", '<mimic joint="a" multiplier="-1" offset="0.4"/>'),
)
EARLY = robot(("a", "revolute", "0 1 0", '<mimic joint="b" multiplier="2"/>'), ("b", "revolute", "1 1 0", ""))
WHEELS = robot(
    ("a", "continuous", "0 1 0", ""),
    ("b", "continuous", "1 1 0", '<mimic joint="a" multiplier="-1" offset="0.4"/>'),
    ("c", "revolute", "0 0 1", '<mimic joint="a" multiplier="2"/>'),
)
CHAIN = robot(
    ("a", "revolute", "0 1 0", ""),
    ("b", "revolute", "1 1 0", '<mimic joint="c" multiplier="2" offset="0.1"/>'),
    ("c", "revolute", "0 0 1", '<mimic joint="a" multiplier="-3" offset="0.2"/>'),
)


@pytest.fixture
def save(tmp_path):
    def saved(text):
        path = tmp_path / "robot.urdf"
        path.write_text(text, encoding="utf-8")
        return path

    return saved


def state(model, seed=0):
    rng = np.random.default_rng(seed)
    q = model.integrate(model.neutral(), rng.standard_normal(model.nv))
    return q, *rng.standard_normal((2, model.nv))


@pytest.mark.parametrize("base", ["fixed", "floating"])
@pytest.mark.parametrize("text", [FINGER, CONTINUOUS], ids=["finger", "continuous"])
def test_reduced_model_equals_pinocchios(save, text, base):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    path = save(text)
    model = tw.load(path, base=base, mimic="reduce")
    root = [pin.JointModelFreeFlyer()] if base == "floating" else []
    theirs = pin.buildModelFromUrdf(str(path), *root, mimic=True)
    data = theirs.createData()  # not for crba and ccrba: in a used one, pin 4.1.0 adds to what is there
    assert (model.nq, model.nv) == (theirs.nq, theirs.nv)
    swap = [3, 4, 5, 0, 1, 2]
    order = [*(swap if base == "floating" else []), *range(6 * (base == "floating"), model.nv)]
    for seed in range(5):
        q, v, a = state(model, seed)
        V, A = v[order], a[order]
        close(tw.rnea(model, q, v, a), pin.rnea(theirs, data, q, V, A)[order])
        close(tw.nonlinear_effects(model, q, v), pin.nonLinearEffects(theirs, data, q, V)[order])
        close(tw.gravity(model, q), pin.computeGeneralizedGravity(theirs, data, q)[order])
        close(tw.crba(model, q), pin.crba(theirs, theirs.createData(), q)[np.ix_(order, order)])
        pin.forwardKinematics(theirs, data, q, V, A)
        motion = tw.forward_kinematics(model, q, v, a)
        for i in range(1, theirs.njoints):
            close(motion.placement[i].matrix(), data.oMi[i].homogeneous)
            close(motion.twist[i], np.asarray(data.v[i])[swap])
        if base == "fixed":
            tip = pin.computeFrameJacobian(theirs, data, q, theirs.getFrameId(list(theirs.frames)[-1].name), pin.LOCAL)
            close(tw.frame_jacobian(model, q, list(theirs.frames)[-1].name), tip.reshape(6, -1)[swap])
        close(
            tw.centroidal_map(model, q),
            pin.computeCentroidalMap(theirs, theirs.createData(), q).reshape(6, -1)[np.ix_(swap, order)],
        )


def close(ours, theirs):
    np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12 * max(1.0, np.abs(theirs).max(initial=0)))


@pytest.mark.parametrize("text", [FINGER, EARLY, WHEELS, CHAIN], ids=["finger", "early", "wheels", "chain"])
@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_laws_of_mechanics_hold_in_the_smaller_model(save, text, base):
    model = tw.load(save(text), base=base, mimic="reduce")
    q, v, a = state(model)
    tau = tw.rnea(model, q, v, a)
    close(tw.aba(model, q, v, tau), a)
    close(tw.crba(model, q) @ a + tw.nonlinear_effects(model, q, v), tau)
    close(tw.coriolis_matrix(model, q, v) @ v + tw.gravity(model, q), tw.nonlinear_effects(model, q, v))
    close(v @ tw.crba(model, q) @ v / 2, tw.kinetic_energy(model, q, v))
    close(tw.centroidal_map(model, q) @ v, tw.centroidal_momentum(model, q, v))
    bias = tw.centroidal_momentum_rate(model, q, v, a) - tw.centroidal_map(model, q) @ a
    close(tw.centroidal_map_rate(model, q, v) @ v, bias)
    close(tw.center_of_mass_velocity(model, q, v) * model.full.mass, tw.centroidal_momentum(model, q, v)[3:])
    close(tw.center_of_mass_jacobian(model, q) @ v, tw.center_of_mass_velocity(model, q, v))
    close(tw.center_of_mass_acceleration(model, q, v, a) * model.full.mass,
          tw.centroidal_momentum_rate(model, q, v, a)[3:])  # fmt: skip
    close(tw.centroidal_inertia(model, q)[3:, 3:], model.full.mass * np.eye(3))
    for function in (tw.ltdl, tw.ltl, tw.inverse_mass_matrix):  # M of followers is coupled where the tree is not
        with pytest.raises(TypeError, match="full"):
            function(model, q)
    tip = model.full.frame("l2").body
    close(tw.frame_jacobian(model, q, "l2") @ v, tw.forward_kinematics(model, q, v).twist[tip])
    h = 1e-6
    for sign in (1, -1):
        ahead = model.integrate(q, sign * h * v)
        close(np.round(model.difference(q, ahead) / h, 8), np.round(sign * v, 8))
    rise = tw.potential_energy(model, model.integrate(q, h * v)) - tw.potential_energy(
        model, model.integrate(q, -h * v)
    )
    assert rise / (2 * h) == pytest.approx(tw.gravity(model, q) @ v, rel=1e-7, abs=1e-7)


def test_virtual_work_is_the_same_in_both_coordinates(save):
    model = tw.load(save(FINGER), mimic="reduce")
    q, v, a = state(model)
    q_full, v_full = model.expand(q, v)
    assert q_full[[1, 2, 4]] == pytest.approx([-0.7 * q[0] + 0.3, 0.2 * q[0], q[1]], rel=1e-15)
    work = tw.rnea(model.full, q_full, v_full, model.G @ a) @ v_full
    assert tw.rnea(model, q, v, a) @ v == pytest.approx(work, rel=1e-13)


def test_a_leader_may_follow_another_joint(save):
    model = tw.load(save(CHAIN), mimic="reduce")
    q, _ = model.expand([0.3], [0.0])
    c = -3 * 0.3 + 0.2
    assert q == pytest.approx([0.3, 2 * c + 0.1, c], rel=1e-15)
    assert model.G.ravel().tolist() == [1, -6, -3]
    wheels = tw.load(save(WHEELS), mimic="reduce")
    q, _ = wheels.expand([np.cos(2.0), np.sin(2.0)], [0.0])
    assert q == pytest.approx([np.cos(2.0), np.sin(2.0), np.cos(0.4 - 2.0), np.sin(0.4 - 2.0), 4.0], rel=1e-14)


def test_forces_from_outside_and_batches_and_number_types(save):
    model = tw.load(save(FINGER), mimic="reduce")
    rng = np.random.default_rng(1)
    q, v, a = rng.standard_normal((3, 4, 2))
    f_ext = rng.standard_normal((model.nbodies, 6))
    f_ext[0] = 0
    tau = tw.rnea(model, q, v, a, f_ext)
    assert tau.shape == (4, 2)
    close(tw.aba(model, q, v, tau, f_ext), a)
    close(tau[2], tw.rnea(model, q[2], v[2], a[2], f_ext=f_ext))
    close(tw.rnea(model=model, q=q[0], v=v[0], a=a[0]), tw.rnea(model, q, v, a)[0])
    for dtype in (np.float32, np.longdouble):
        again = tw.aba(model, *(x.astype(dtype) for x in (q, v, tau)), f_ext.astype(dtype))
        assert again.dtype == dtype
        np.testing.assert_allclose(again, a, rtol=0, atol=1e-4 if dtype == np.float32 else 1e-12)
    step = 1e-30
    slope = tw.gravity(model, q[0] + 1j * step * np.array([1, 0])).imag / step
    ahead, back = (tw.gravity(model, q[0] + x * np.array([1, 0])) for x in (1e-6, -1e-6))
    np.testing.assert_allclose(slope, (ahead - back) / 2e-6, rtol=1e-7)


def test_a_continuous_leader_is_differentiable_in_complex_numbers(save):
    model = tw.load(save(WHEELS), mimic="reduce")
    q, step = model.integrate(model.neutral(), [2.0]), 1e-30
    along = tw.gravity(model, q + 1j * step * np.array([-q[1], q[0]])).imag / step
    ahead, back = (tw.gravity(model, model.integrate(q, [x])) for x in (1e-6, -1e-6))
    np.testing.assert_allclose(along, (ahead - back) / 2e-6, rtol=1e-7)


def test_dynamics_gives_all_four(save):
    model = tw.load(save(FINGER), mimic="reduce")
    q, v, _ = state(model)
    all_four = tw.dynamics(model, q, v, contacts=["l5"])
    assert repr(all_four) == "Dynamics(M: (2, 2), h: (2,), J_c: (3, 2), A_G: (6, 2))"
    np.testing.assert_array_equal(all_four.M, tw.crba(model, q))
    np.testing.assert_array_equal(all_four.J_c, tw.contact_jacobian(model, q, ["l5"]))
    assert tw.dynamics(model, q, v, want=["h"]).M is None


def test_what_does_not_know_such_models_refuses_them_by_name(save):
    model = tw.load(save(FINGER), mimic="reduce")
    q, v, a = state(model)
    calls = [
        lambda: tw.fast.rnea(model, q, v, a),
        lambda: tw.fast.dynamics(model, q, v),
        lambda: tw.newton_euler_3d.inverse_dynamics(model, q, v, a),
        lambda: tw.compile(model, "M"),
        lambda: tw.bridge.to_pinocchio_model(model),
    ]
    for call in calls:
        with pytest.raises(
            TypeError, match=r"MimicModel.* its \.full has them free.*\[tw\.Coupling\('b', \{'a': -0\.7\}\), …\]"
        ):
            call()


def test_the_couplings_that_the_error_names_do_what_the_smaller_model_does(save):
    small = tw.load(save(FINGER), mimic="reduce")
    q, v, _ = state(small)
    full, (q_full, v_full) = small.full, small.expand(q, v)
    couplings = [tw.Coupling(name, {leader: ratio}) for name, (leader, ratio, _) in small.laws.items()]
    leaders, tau = [full.v_slice[full.joint_id(name)].start for name in small.joint_names[1:]], np.zeros(full.nv)
    tau[leaders] = [0.3, -0.2]
    qdd = tw.contact_forward_dynamics(full, q_full, v_full, tau, couplings).qdd
    np.testing.assert_allclose(qdd[leaders], tw.aba(small, q, v, tau[leaders]), rtol=1e-12)
    np.testing.assert_allclose(qdd, small.expand(q, qdd[leaders])[1], rtol=0, atol=1e-12 * abs(qdd).max())


def test_a_wrong_shape_is_told_in_the_smaller_coordinates(save):
    model = tw.load(save(FINGER), mimic="reduce")
    with pytest.raises(tw.ShapeError, match=r"v: expected shape \(\.\.\., 2\), got \(5,\)"):
        tw.rnea(model, [0, 0], np.zeros(5), [0, 0])


def test_the_report_says_who_follows_whom(save):
    model = tw.load(save(FINGER), mimic="reduce", strict=True)
    assert (model.report[0].where, model.report[0].read_as) == ("joint 'b'", "q = -0.7 q_leader + 0.3")
    assert repr(model) == "MimicModel 'r': fixed base, nq = 2, nv = 2, 3 joints that follow"
    assert model.lower.tolist() == [-1, -1]
    assert tw.crba(pickle.loads(pickle.dumps(model)), [0.1, 0.2]).tolist() == tw.crba(model, [0.1, 0.2]).tolist()


def test_laws_that_cannot_be_followed_are_refused(save):
    circle = EARLY.replace(f"{LIMIT}</joint></robot>", f'{LIMIT}<mimic joint="a"/></joint></robot>')
    refuse(save(circle), "circle", "a -> b -> a", "independent", mimic="reduce")
    refuse(save(WHEELS.replace('multiplier="2"', 'multiplier="0.5"')), "'c' follows 'a'", "whole turns", mimic="reduce")
    refuse(save(FINGER.replace('joint="d"', 'joint="x"')), "'e'", "unknown joint 'x'", "independent", mimic="reduce")
    fixed = FINGER.replace('name="d" type="revolute"', 'name="d" type="fixed"')
    refuse(save(fixed), "'d'", "a joint that moves", "independent", mimic="reduce")
    floating = FINGER.replace('name="d" type="revolute"', 'name="d" type="floating"')
    with pytest.warns(UserWarning, match="a floating joint has none"):
        refuse(save(floating), "'e' follows 'd'", "one degree of freedom", mimic="reduce")


def test_massless_followers_leave_no_singular_row(save):
    tip = f'<link name="l5">{BODY.format(m=6)}</link>'
    model = tw.load(save(FINGER.replace(tip, '<link name="l5"/>')), mimic="reduce")
    assert np.isfinite(tw.aba(model, *state(model))).all()
    with pytest.raises(tw.SingularError, match="'e'"):
        tw.aba(model.full, *np.zeros((3, 5)))


@pytest.mark.parametrize("name", ["panda", "baxter", "tiago_pro", "pr2"])
def test_robots_of_the_catalogue_equal_pinocchios(name):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    from twistwrench.loading.catalogue import find

    model = tw.load(name, base="fixed", mimic="reduce", physical=False)
    theirs = pin.buildModelFromUrdf(str(find(name).path), mimic=True)
    assert (model.nq, model.nv) == (theirs.nq, theirs.nv)
    q, v, a = state(model)
    data = theirs.createData()
    close(tw.rnea(model, q, v, a), pin.rnea(theirs, data, q, v, a))
    close(tw.crba(model, q), pin.crba(theirs, theirs.createData(), q))


def written_laws(path):
    """Return the laws of a file as they stand in it, read by another parser: follower to leader, multiplier, offset."""
    laws = {}
    for joint in ElementTree.parse(path).getroot().iter("joint"):
        if (mimic := joint.find("mimic")) is not None:
            law = mimic.get("joint"), float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0))
            laws[joint.get("name")] = law
    return laws


@pytest.mark.parametrize("name", ["romeo", "talos_full_v2"])
def test_robots_whose_leaders_come_later_equal_pinocchios_full_model_projected_by_hand(name):
    """Pinocchio's own ``mimic=True`` demands that a leader comes before those that follow it."""
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    from twistwrench.loading.catalogue import find

    path = find(name).path
    model = tw.load(name, base="floating", mimic="reduce", physical=False)
    theirs = pin.buildModelFromUrdf(str(path), pin.JointModelFreeFlyer())
    laws = {name: law for name, law in written_laws(path).items() if theirs.existJointName(name)}
    assert any(theirs.getJointId(leader) > theirs.getJointId(follower) for follower, (leader, _, _) in laws.items())

    q, v, a = state(model)
    kept = [joint for joint in theirs.names[2:] if joint not in laws]
    assert model.joint_names[2:] == tuple(kept)
    theta, G = pin.neutral(theirs), np.zeros((theirs.nv, model.nv))
    theta[:7], G[:6, :6] = q[:7], np.eye(6)
    for joint in theirs.names[2:]:
        leader, ratio, offset = laws.get(joint, (joint, 1.0, 0.0))
        mine, its = theirs.joints[theirs.getJointId(joint)], model.joint_names.index(leader)
        G[mine.idx_v, model.v_slice[its]] = ratio
        theta[mine.idx_q] = ratio * q[model.q_slice[its]][0] + offset

    def swapped(x):
        return bridge.to_pinocchio_tangent(model.full, x)

    tau = bridge.from_pinocchio_tangent(
        model.full, pin.rnea(theirs, theirs.createData(), theta, swapped(G @ v), swapped(G @ a))
    )
    M = bridge.from_pinocchio_matrix(model.full, pin.crba(theirs, theirs.createData(), theta))
    h = bridge.from_pinocchio_tangent(model.full, pin.nle(theirs, theirs.createData(), theta, swapped(G @ v)))
    close(tw.rnea(model, q, v, a), G.T @ tau)
    close(tw.crba(model, q), G.T @ M @ G)
    close(tw.nonlinear_effects(model, q, v), G.T @ h)
    if name == "romeo":  # its hands have no mass
        with pytest.raises(tw.SingularError, match="LHand"):
            tw.aba(model, q, v, a)
    else:
        close(G.T @ (M @ G @ tw.aba(model, q, v, a) + h), a)

"""The bridge: arrays swapped as Pinocchio has them, models that move the same on both sides.

No conversion is held against its inverse alone. Each is held against what Pinocchio computes on trees with
free-flyers at the base and inside, and each comparison says that it fails without the swap.
"""

import importlib.util
import sys
import types
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench.model import PER_DOF

if importlib.util.find_spec("pinocchio") is not None:
    import pinocchio as pin
needs_pinocchio = pytest.mark.skipif(
    "pin" not in globals(), reason="Pinocchio is not installed: the comparison with it is skipped"
)

TREES = {
    "all kinds, floating": {"n": 12, "rng": 1, "base": "floating"},
    "all kinds, fixed": {"n": 14, "rng": 2},
    "free-flyers": {"n": 4, "rng": 3, "base": "floating", "kinds": ["free_flyer"]},
    "no free-flyer": {"n": 9, "rng": 4, "kinds": ["revolute", "prismatic", "continuous", "planar", "spherical"]},
    "chain": {"n": 8, "rng": 5, "base": "floating", "branching": 0.0},
}
DTYPES = [np.float32, np.float64, np.longdouble, np.complex64, np.complex128, np.clongdouble]


def close(ours, theirs, tolerance=1e-12):
    """Equal to a relative 1e-12 of the largest entry."""
    ours, theirs = np.asarray(ours), np.asarray(theirs)
    assert ours.shape == theirs.shape
    return np.abs(ours - theirs).max(initial=0) <= tolerance * max(1.0, np.abs(theirs).max(initial=0))


def has_free_flyer(model):
    return any(isinstance(joint, tw.FreeFlyer) for joint in model.joints)


def agree(ours, converted, raw, *, swapped=True):
    """Ours is Pinocchio's, and is not what Pinocchio returns before it is converted."""
    assert close(ours, converted)
    if swapped:
        assert not close(ours, raw, 1e-3)
    else:
        assert (np.asarray(converted) == raw).all()


@pytest.fixture(scope="module", params=TREES.values(), ids=TREES.keys())
def pair(request):
    """A random tree here and there, with one state in both orders."""
    model = tw.random_tree(**request.param)
    rng = np.random.default_rng(0)
    q = model.random_configuration(rng=rng)
    v, a, tau = rng.standard_normal((3, model.nv))
    f_ext = rng.standard_normal((model.nbodies, 6))
    f_ext[0] = 0
    there = bridge.to_pinocchio_model(model)
    V, A, TAU = (bridge.to_pinocchio_tangent(model, x) for x in (v, a, tau))
    return SimpleNamespace(
        model=model, q=q, v=v, a=a, tau=tau, f_ext=f_ext, swapped=has_free_flyer(model),
        there=there, data=there.createData(), V=V, A=A, TAU=TAU, F_EXT=bridge.to_pinocchio_f_ext(model, f_ext),
    )  # fmt: skip


# -------------------------------------------------------------------- arrays, with and without Pinocchio


def conversions(model):
    """Of each conversion of arrays: both directions and the last axes."""
    over_v = {"tangent": (model.nv,), "jacobian": (6, model.nv), "matrix": (model.nv, model.nv)}
    over_v["contact_jacobian"] = (7, model.nv)
    spatial = {"motion": (6,), "force": (6,), "transform": (6, 6)}
    for name, tail in (spatial | over_v).items():
        to, back = getattr(bridge, f"to_pinocchio_{name}"), getattr(bridge, f"from_pinocchio_{name}")
        if name in over_v:
            to, back = (lambda x, f=f: f(model, x) for f in (to, back))
        yield name, tail, to, back


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("batch", [(), (1,), (3, 1, 2), (0,)])
def test_round_trips_give_every_entry_back_in_its_number_type(batch, dtype):
    model = tw.random_tree(6, rng=1, base="floating")
    rng = np.random.default_rng(0)
    for name, tail, to, back in conversions(model):
        x = rng.standard_normal((*batch, *tail)).astype(dtype)
        if np.dtype(dtype).kind == "c":
            x += 1j * rng.standard_normal(x.shape)
        before = x.copy()
        there = to(x)
        assert (there.dtype, there.shape) == (x.dtype, x.shape), name
        assert (back(there) == x).all(), name
        assert (to(back(x)) == x).all(), name
        assert not np.shares_memory(there, x), name
        assert (x == before).all(), name
        if x.size:
            assert (there != x).any(), name


def test_batch_is_converted_item_by_item():
    model = tw.random_tree(6, rng=1, base="floating")
    rng = np.random.default_rng(0)
    for name, tail, to, back in conversions(model):
        x = rng.standard_normal((2, 3, *tail))
        for function in (to, back):
            items = np.array([[function(item) for item in row] for row in x])
            assert (function(x) == items).all(), name


def test_integers_and_lists_become_float64():
    assert bridge.to_pinocchio_motion([1, 2, 3, 4, 5, 6]).dtype == np.float64


def tree_with_free_flyer_inside():
    """q and v: a hinge, a free-flyer on it, a slide on that."""
    builder = tw.Builder("satellite dispenser")
    body = tw.SpatialInertia(1.0, [0.1, 0.2, 0.3], np.eye(3))
    builder.link("a", parent="base_link", joint=tw.Revolute("z"), inertia=body)
    builder.link("b", parent="a", joint=tw.FreeFlyer(), inertia=body, armature=[1, 2, 3, 4, 5, 6],
                 velocity_limit=[1, 2, 3, 4, 5, 6], effort_limit=[10, 20, 30, 40, 50, np.inf])  # fmt: skip
    builder.link("c", parent="b", joint=tw.Prismatic("x"), inertia=body)
    return builder.build()


def test_six_entries_of_a_free_flyer_inside_the_tree_are_swapped_and_no_others():
    model = tree_with_free_flyer_inside()
    assert bridge.to_pinocchio_tangent(model, np.arange(8)).tolist() == [0, 4, 5, 6, 1, 2, 3, 7]
    columns = bridge.to_pinocchio_contact_jacobian(model, np.arange(16).reshape(2, 8))
    assert columns.tolist() == [[0, 4, 5, 6, 1, 2, 3, 7], [8, 12, 13, 14, 9, 10, 11, 15]]
    J = bridge.to_pinocchio_jacobian(model, np.arange(48).reshape(6, 8))
    assert J[0].tolist() == [24, 28, 29, 30, 25, 26, 27, 31]
    M = bridge.to_pinocchio_matrix(model, np.arange(64).reshape(8, 8))
    assert M[1].tolist() == [32, 36, 37, 38, 33, 34, 35, 39]


def test_fixed_base_has_nothing_to_swap_over_v_but_the_rows_of_a_jacobian():
    model = tw.chain(3)
    J = np.arange(18.0).reshape(6, 3)
    assert (bridge.to_pinocchio_tangent(model, [1, 2, 3]) == [1, 2, 3]).all()
    assert (bridge.to_pinocchio_jacobian(model, J) == J[[3, 4, 5, 0, 1, 2]]).all()


@pytest.mark.parametrize("function", [bridge.to_pinocchio_tangent, bridge.from_pinocchio_tangent])
def test_q_handed_over_as_a_tangent_is_refused(function):
    model = tw.load("go2")
    with pytest.raises(tw.ShapeError, match=r"\(\.\.\., 18\), got \(19,\)"):
        function(model, model.standing())


@pytest.mark.parametrize("function", [bridge.to_pinocchio_contact_jacobian, bridge.from_pinocchio_contact_jacobian])
def test_vector_is_no_contact_jacobian(function):
    with pytest.raises(tw.ShapeError, match=r"J_c: expected shape \(\.\.\., k, 3\), got \(3,\)"):
        function(tw.chain(3), [1, 2, 3])


def test_column_that_pinocchio_drops_of_a_robot_with_one_joint_is_put_back():
    rod, J = tw.load("pendulum"), np.arange(6.0)[:, None]
    for convert in (bridge.from_pinocchio_jacobian, bridge.from_pinocchio_contact_jacobian):
        for batch in (J, np.stack([J, 2 * J])):
            assert (convert(rod, batch[..., 0]) == convert(rod, batch)).all()
            assert convert(rod, batch[..., 0]).shape == batch.shape
        with pytest.raises(tw.ShapeError, match="expected shape"):
            convert(tw.chain(2), J[:, 0])
        with pytest.raises(tw.ShapeError, match="expected shape"):
            convert(rod, 1.0)


def test_jacobians_of_a_robot_with_one_joint_cross_as_pinocchio_gives_them():
    pin = pytest.importorskip("pinocchio")
    rod, q = tw.load("pendulum"), np.array([0.3])
    there = bridge.to_pinocchio_model(rod)
    data = there.createData()
    for name in rod.frame_names:
        raw = pin.computeFrameJacobian(there, data, q, there.getFrameId(name), pin.LOCAL)
        assert raw.shape == (6,)
        assert close(bridge.from_pinocchio_jacobian(rod, raw), tw.frame_jacobian(rod, q, name))
        assert close(bridge.from_pinocchio_contact_jacobian(rod, raw[:3]), tw.frame_jacobian(rod, q, name)[3:])
    assert close(
        bridge.from_pinocchio_jacobian(rod, pin.computeCentroidalMap(there, data, q)), tw.centroidal_map(rod, q)
    )


def test_twists_and_wrenches_with_a_type_are_taken():
    x = np.arange(6.0)
    assert (bridge.to_pinocchio_motion(tw.Twist(x)) == [3, 4, 5, 0, 1, 2]).all()
    assert (bridge.to_pinocchio_force(tw.Wrench(x)) == [3, 4, 5, 0, 1, 2]).all()


def test_twists_and_wrenches_that_change_places_are_refused():
    V, F = tw.Twist(np.arange(6)), tw.Wrench(np.arange(6))
    with pytest.raises(TypeError, match="V: expected a Twist or an array, got a Wrench"):
        bridge.to_pinocchio_motion(F)
    with pytest.raises(TypeError, match="F: expected a Wrench or an array, got a Twist"):
        bridge.to_pinocchio_force(V)
    for ours in (V, F, [V, V]):  # in our order: there is nothing to take from Pinocchio's
        with pytest.raises(TypeError, match=r"V: expected a pin\.Motion or an array, got a (Twist|Wrench), angular"):
            bridge.from_pinocchio_motion(ours)
        with pytest.raises(TypeError, match=r"F: expected a pin\.Force or an array, got a (Twist|Wrench), angular"):
            bridge.from_pinocchio_force(ours)


# -------------------------------------------------------------------- every quantity against Pinocchio's


@needs_pinocchio
def test_inverse_and_forward_dynamics_with_external_wrenches(pair):
    p = pair
    raw = pin.rnea(p.there, p.data, p.q, p.V, p.A, p.F_EXT)
    agree(tw.rnea(p.model, p.q, p.v, p.a, p.f_ext), bridge.from_pinocchio_tangent(p.model, raw), raw, swapped=p.swapped)
    raw = pin.aba(p.there, p.data, p.q, p.V, p.TAU, p.F_EXT)
    agree(
        tw.aba(p.model, p.q, p.v, p.tau, p.f_ext), bridge.from_pinocchio_tangent(p.model, raw), raw, swapped=p.swapped
    )


@needs_pinocchio
def test_velocity_that_nobody_swapped_gives_other_forces(pair):
    p = pair
    h = tw.nonlinear_effects(p.model, p.q, p.v)
    assert close(h, bridge.from_pinocchio_tangent(p.model, pin.nonLinearEffects(p.there, p.data, p.q, p.V)))
    if p.swapped:
        forgotten = pin.nonLinearEffects(p.there, p.data, p.q, p.v)
        assert not close(h, bridge.from_pinocchio_tangent(p.model, forgotten), 1e-3)


@needs_pinocchio
def test_external_wrenches_that_nobody_swapped_give_other_forces(pair):
    p = pair
    tau = tw.rnea(p.model, p.q, p.v, p.a, p.f_ext)
    forgotten = pin.StdVec_Force()
    forgotten.extend([pin.Force(f) for f in p.f_ext])
    raw = pin.rnea(p.there, p.data, p.q, p.V, p.A, forgotten)
    assert not close(tau, bridge.from_pinocchio_tangent(p.model, raw), 1e-3)


@needs_pinocchio
def test_matrices_over_v(pair):
    p = pair
    for ours, raw in [
        (tw.crba(p.model, p.q), pin.crba(p.there, p.data, p.q)),
        (tw.coriolis_matrix(p.model, p.q, p.v), pin.computeCoriolisMatrix(p.there, p.data, p.q, p.V)),
    ]:
        agree(ours, bridge.from_pinocchio_matrix(p.model, raw), raw, swapped=p.swapped)
        assert close(bridge.to_pinocchio_matrix(p.model, ours), raw)


@needs_pinocchio
def test_inverse_of_the_mass_matrix_is_converted_like_it(pair):
    p = pair
    raw = pin.computeMinverse(p.there, p.data, p.q)
    M = tw.crba(p.model, p.q)
    residual = M @ bridge.from_pinocchio_matrix(p.model, raw) - np.eye(p.model.nv)
    assert np.abs(residual).max() <= 1e-15 * np.linalg.cond(M)  # what an inverse in float64 can give


@needs_pinocchio
@pytest.mark.parametrize("reference", ["local", "world", "local_world_aligned"])
def test_jacobians_of_all_frames(pair, reference):
    p = pair
    there = getattr(pin, reference.upper())
    differ = False
    for name in p.model.frame_names:
        index = p.there.getFrameId(name)
        raw = pin.computeFrameJacobian(p.there, p.data, p.q, index, there)
        ours = tw.frame_jacobian(p.model, p.q, name, reference)
        assert close(ours, bridge.from_pinocchio_jacobian(p.model, raw))
        assert close(bridge.to_pinocchio_jacobian(p.model, ours), raw)
        differ |= not close(ours, raw, 1e-3)
    assert differ  # not in each: the local Jacobian of a free-flyer is 1 in either order


@needs_pinocchio
def test_contact_jacobian_has_pinocchios_linear_rows_which_are_the_first_three(pair):
    p = pair
    contacts = p.model.frame_names[-2:]
    aligned = pin.LOCAL_WORLD_ALIGNED
    raw = [pin.computeFrameJacobian(p.there, p.data, p.q, p.there.getFrameId(name), aligned)[:3] for name in contacts]
    raw = np.concatenate(raw)
    ours = tw.contact_jacobian(p.model, p.q, contacts)
    agree(ours, bridge.from_pinocchio_contact_jacobian(p.model, raw), raw, swapped=p.swapped)
    assert close(bridge.to_pinocchio_contact_jacobian(p.model, ours), raw)


@needs_pinocchio
def test_placements_and_their_transforms(pair):
    p = pair
    pin.forwardKinematics(p.there, p.data, p.q)
    for ours, theirs in list(zip(tw.forward_kinematics(p.model, p.q).placement, p.data.oMi, strict=True))[1:]:
        assert close(ours.matrix(), theirs.homogeneous)
        assert close(bridge.from_pinocchio_se3(theirs).matrix(), ours.matrix())
        assert (bridge.to_pinocchio_se3(ours).homogeneous == ours.matrix()).all()
        X, inverse = ours.motion_transform(), ours.inverse().motion_transform()
        agree(X, bridge.from_pinocchio_transform(theirs.action), theirs.action)
        agree(inverse, bridge.from_pinocchio_transform(theirs.actionInverse), theirs.actionInverse)
        agree(ours.force_transform(), bridge.from_pinocchio_transform(theirs.dualAction), theirs.dualAction)
        assert close(bridge.to_pinocchio_transform(X), theirs.action)


@needs_pinocchio
def test_cross_products_are_converted_like_transforms():
    V = np.random.default_rng(0).standard_normal(6)
    there = pin.Motion(bridge.to_pinocchio_motion(V))
    agree(tw.cross_motion(V), bridge.from_pinocchio_transform(there.action), there.action)
    agree(tw.cross_force(V), bridge.from_pinocchio_transform(there.dualAction), there.dualAction)


@needs_pinocchio
def test_twists_accelerations_and_wrenches_of_the_bodies(pair):
    p = pair
    kinematics = tw.forward_kinematics(p.model, p.q, p.v, p.a)
    pin.forwardKinematics(p.there, p.data, p.q, p.V, p.A)
    for ours, theirs in ((kinematics.twist, p.data.v), (kinematics.acceleration, p.data.a)):
        agree(ours, bridge.from_pinocchio_motion(theirs), np.stack([one.vector for one in theirs]))
        assert close(bridge.from_pinocchio_motion(theirs[1]), ours[1])
        assert close(bridge.to_pinocchio_motion(ours[1]), theirs[1].vector)
    pin.rnea(p.there, p.data, p.q, p.V, p.A, p.F_EXT)
    wrenches = tw.joint_wrenches(p.model, p.q, p.v, p.a, p.f_ext)[1:]
    theirs = list(p.data.f)[1:]
    agree(wrenches, bridge.from_pinocchio_force(theirs), np.stack([one.vector for one in theirs]))
    assert close(bridge.to_pinocchio_force(wrenches[0]), theirs[0].vector)


@needs_pinocchio
def test_centroidal_map_momentum_and_rate(pair):
    p = pair
    raw = pin.computeCentroidalMap(p.there, p.data, p.q)
    ours = tw.centroidal_map(p.model, p.q)
    agree(ours, bridge.from_pinocchio_jacobian(p.model, raw), raw)
    assert close(bridge.to_pinocchio_jacobian(p.model, ours), raw)
    pin.computeCentroidalMomentumTimeVariation(p.there, p.data, p.q, p.V, p.A)
    momentum, rate = p.data.hg, p.data.dhg
    agree(tw.centroidal_momentum(p.model, p.q, p.v), bridge.from_pinocchio_force(momentum), momentum.vector)
    agree(tw.centroidal_momentum_rate(p.model, p.q, p.v, p.a), bridge.from_pinocchio_force(rate), rate.vector)


@needs_pinocchio
def test_q_and_its_manifold_need_no_conversion(pair):
    p = pair
    target = p.model.integrate(p.q, p.v)
    assert close(target, pin.integrate(p.there, p.q, p.V))
    back = bridge.from_pinocchio_tangent(p.model, pin.difference(p.there, p.q, target))
    assert close(p.model.difference(p.q, target), back, 1e-10)  # Pinocchio's log6 is off by up to 9e-13 near π
    assert (pin.neutral(p.there) == p.model.neutral()).all()


@needs_pinocchio
def test_batch_of_ours_is_pinocchio_state_by_state():
    model = tw.random_tree(8, rng=1, base="floating")
    there = bridge.to_pinocchio_model(model)
    data, rng = there.createData(), np.random.default_rng(0)
    q = np.array([[model.random_configuration(rng=rng) for _ in range(2)] for _ in range(3)])
    V, A = rng.standard_normal((2, 3, 2, model.nv))
    v, a = bridge.from_pinocchio_tangent(model, V), bridge.from_pinocchio_tangent(model, A)
    raw = np.array([[pin.rnea(there, data, *s) for s in zip(*row, strict=True)] for row in zip(q, V, A, strict=True)])
    agree(tw.rnea(model, q, v, a), bridge.from_pinocchio_tangent(model, raw), raw)
    raw = np.array([[pin.crba(there, data, one).copy() for one in row] for row in q])
    agree(tw.crba(model, q), bridge.from_pinocchio_matrix(model, raw), raw)
    raw = np.array([[pin.computeCentroidalMap(there, data, one).copy() for one in row] for row in q])
    agree(tw.centroidal_map(model, q), bridge.from_pinocchio_jacobian(model, raw), raw)


# -------------------------------------------------------------------- Pinocchio's own types


@needs_pinocchio
def test_inertia_is_the_same_ten_numbers_and_its_matrix_is_swapped():
    model = tw.random_tree(5, rng=0)
    for ours in model.inertia[1:]:
        theirs = bridge.to_pinocchio_inertia(ours)
        assert (theirs.mass, *theirs.lever) == (ours.mass, *ours.com)
        assert (theirs.inertia == ours.inertia_at_com).all()
        agree(ours.matrix(), bridge.from_pinocchio_transform(theirs.matrix()), theirs.matrix())
        assert close(bridge.to_pinocchio_transform(ours.matrix()), theirs.matrix())
        back = bridge.from_pinocchio_inertia(theirs)
        assert (back.matrix() == ours.matrix()).all()
        V = np.arange(6.0)
        momentum = (theirs * pin.Motion(bridge.to_pinocchio_motion(V))).vector
        agree(ours.momentum(V), bridge.from_pinocchio_force(momentum), momentum)


@needs_pinocchio
def test_inertia_that_no_body_can_have_is_handed_over_all_the_same():
    # 10 of iCub's 33 are of this kind; Pinocchio's constructor refuses them, its URDF reader does not.
    odd = tw.SpatialInertia(1.0, [0, 0, 1], np.diag([-1.0, 1, 1]))
    assert (bridge.to_pinocchio_inertia(odd).inertia == odd.inertia_at_com).all()


@needs_pinocchio
def test_inertia_of_negative_mass_is_refused_here():
    with pytest.raises(tw.ModelError, match="negative mass"):
        bridge.from_pinocchio_inertia(pin.Inertia(-1.0, np.zeros(3), np.eye(3)))


@needs_pinocchio
def test_external_wrenches_go_there_and_back():
    model = tw.random_tree(5, rng=0)
    f_ext = np.random.default_rng(0).standard_normal((model.nbodies, 6))
    f_ext[0] = 0
    there = bridge.to_pinocchio_f_ext(model, f_ext)
    assert isinstance(there, pin.StdVec_Force)
    assert len(there) == model.nbodies
    assert (there[2].angular == f_ext[2, :3]).all()
    assert (there[2].linear == f_ext[2, 3:]).all()
    assert (bridge.from_pinocchio_f_ext(model, there) == f_ext).all()


@needs_pinocchio
def test_external_wrenches_that_cannot_be_are_refused():
    model = tw.chain(2)
    good = np.zeros((3, 6))
    on_the_world = good + 1
    with pytest.raises(ValueError, match="row 0 is a wrench on the world"):
        bridge.to_pinocchio_f_ext(model, on_the_world)
    with pytest.raises(ValueError, match="row 0 is a wrench on the world"):
        bridge.from_pinocchio_f_ext(model, [pin.Force(np.ones(6))] * 3)
    with pytest.raises(tw.ShapeError, match=r"\(\.\.\., 3, 6\), got \(2, 6\)"):
        bridge.to_pinocchio_f_ext(model, good[1:])
    with pytest.raises(tw.ShapeError, match=r"\(\.\.\., 3, 6\), got \(2, 6\)"):
        bridge.from_pinocchio_f_ext(model, [pin.Force.Zero()] * 2)
    with pytest.raises(tw.ShapeError, match=r"f_ext: Pinocchio takes one at a time, got batch axes \(4,\)"):
        bridge.to_pinocchio_f_ext(model, np.zeros((4, 3, 6)))
    with pytest.raises(ValueError, match="f_ext: Pinocchio has no complex numbers, got complex128"):
        bridge.to_pinocchio_f_ext(model, good * 1j)


@needs_pinocchio
def test_batch_and_complex_numbers_do_not_fit_into_one_placement_or_inertia():
    R = np.broadcast_to(np.eye(3), (2, 3, 3))
    with pytest.raises(tw.ShapeError, match=r"T.rotation: .* got batch axes \(2,\)"):
        bridge.to_pinocchio_se3(tw.SE3(R, np.zeros(3)))
    with pytest.raises(ValueError, match=r"T.rotation: Pinocchio has no complex numbers"):
        bridge.to_pinocchio_se3(tw.SE3(np.eye(3), np.zeros(3, complex)))
    with pytest.raises(tw.ShapeError, match=r"mass: .* got batch axes \(2,\)"):
        bridge.to_pinocchio_inertia(tw.SpatialInertia([1, 2], np.zeros(3), np.eye(3)))


@needs_pinocchio
def test_wrench_taken_for_a_twist_is_refused():
    with pytest.raises(TypeError, match=r"V: expected a pin.Motion or an array, got a pin.Force"):
        bridge.from_pinocchio_motion(pin.Force.Zero())
    with pytest.raises(TypeError, match=r"F: expected a pin.Force or an array, got a pin.Motion"):
        bridge.from_pinocchio_force([pin.Motion.Zero()])


def test_missing_pinocchio_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    with pytest.raises(ImportError, match="pip install pin"):
        bridge.to_pinocchio_se3(tw.SE3.identity())
    with pytest.raises(ImportError, match="pip install pin"):
        bridge.to_pinocchio_model(tw.chain(1))


def test_other_package_of_that_name_is_noticed(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", types.ModuleType("pinocchio"))
    with pytest.raises(ImportError, match=r"is not the rigid-body library; .*pip install pin"):
        bridge.import_pinocchio()


# -------------------------------------------------------------------- models


@needs_pinocchio
@pytest.mark.parametrize(("given", "came"), [(tw.chain(1), "twistwrench's Model"), ("go2", "builtins's str")])
def test_what_is_no_model_of_pinocchio_is_refused(given, came):
    with pytest.raises(TypeError, match=f"there: expected a pin.Model, got {came}"):
        bridge.from_pinocchio_model(given)


@needs_pinocchio
def test_a_model_of_pinocchio_is_no_source_and_the_way_from_it_is_told():
    with pytest.raises(TypeError, match=r"got pinocchio's Model; tw\.bridge\.from_pinocchio_model makes one of it"):
        tw.load(bridge.to_pinocchio_model(tw.chain(1)))


def one_joint(joint):
    builder = tw.Builder("one joint")
    body = tw.SpatialInertia(2.0, [0.1, -0.2, 0.3], np.diag([0.3, 0.4, 0.5]))
    builder.link("a", parent="base_link", joint=joint, inertia=body, placement=tw.SE3(np.eye(3), [1, 2, 3]))
    return builder.build()


def same_model(a, b, axis=0.0):
    """Every attribute equal to the last bit, axes to `axis`."""
    assert (a.name, a.base, a.joint_names, a.parent) == (b.name, b.base, b.joint_names, b.parent)
    for one, other in zip(a.joints[1:], b.joints[1:], strict=True):
        assert one.kind == other.kind
        if hasattr(one, "axis"):
            assert np.abs(np.subtract(one.axis, other.axis)).max() <= axis
            assert replace(one, axis="x") == replace(other, axis="x")
    for one, other in zip(a.inertia, b.inertia, strict=True):
        assert (one.matrix() == other.matrix()).all()
    for one, other in zip(a.placement, b.placement, strict=True):
        assert (one.matrix() == other.matrix()).all()
    assert set(a.frames) == set(b.frames)
    for name, frame in a.frames.items():
        assert frame.body == b.frames[name].body
        assert (frame.placement.matrix() == b.frames[name].placement.matrix()).all()
    for name in ("gravity", "lower", "upper", *PER_DOF):
        assert (getattr(a, name) == getattr(b, name)).all(), name
    assert a.postures.keys() == b.postures.keys()
    assert all((a.postures[name] == b.postures[name]).all() for name in a.postures)


@needs_pinocchio
@pytest.mark.parametrize("tree", TREES.values(), ids=TREES.keys())
def test_model_comes_back_as_it_left(tree):
    model = tw.random_tree(**tree)
    # Pinocchio normalises the axis of an oblique continuous joint once more.
    same_model(model, bridge.from_pinocchio_model(bridge.to_pinocchio_model(model)), axis=2.3e-16)


@needs_pinocchio
def test_damping_and_friction_cross_both_ways():
    builder = tw.Builder("stiff", base="floating", root_inertia=tw.SpatialInertia(1, [0, 0, 0], np.eye(3)))
    body = tw.SpatialInertia(1, [0, 0, 0.1], np.eye(3))
    builder.link("a", parent="base_link", joint=tw.Revolute("x"), inertia=body, damping=0.5, friction=0.25)
    builder.link("b", parent="a", joint=tw.FreeFlyer(), inertia=body, damping=[1, 2, 3, 4, 5, 6])
    model = builder.build()
    there = bridge.to_pinocchio_model(model)
    assert there.damping.tolist() == [0] * 6 + [0.5, 4, 5, 6, 1, 2, 3]
    assert there.upperDryFrictionLimit[6] == 0.25 == -there.lowerDryFrictionLimit[6]
    same_model(model, bridge.from_pinocchio_model(there))


@needs_pinocchio
@pytest.mark.parametrize("robot", ["go2", "pendulum", "double_pendulum", "cart_pole", "planar_arm", "humanoid"])
def test_robot_of_the_catalogue_comes_back_as_it_left(robot):
    model = tw.load(robot)
    same_model(model, bridge.from_pinocchio_model(bridge.to_pinocchio_model(model)))


@needs_pinocchio
@pytest.mark.parametrize(
    ("joint", "name"),
    [
        (tw.Revolute("x"), "RX"),
        (tw.Revolute("y"), "RY"),
        (tw.Revolute("z"), "RZ"),
        (tw.Revolute([-1, 0, 0]), "RevoluteUnaligned"),
        (tw.Revolute([0.36, 0.48, -0.8]), "RevoluteUnaligned"),
        (tw.Prismatic("x"), "PX"),
        (tw.Prismatic("y"), "PY"),
        (tw.Prismatic("z"), "PZ"),
        (tw.Prismatic([0, 0, -1]), "PrismaticUnaligned"),
        (tw.Prismatic([0.36, 0.48, -0.8]), "PrismaticUnaligned"),
        (tw.Continuous("x"), "RUBX"),
        (tw.Continuous("y"), "RUBY"),
        (tw.Continuous("z"), "RUBZ"),
        (tw.Continuous([0, -1, 0]), "RevoluteUnboundedUnaligned"),
        (tw.Continuous([0.36, 0.48, -0.8]), "RevoluteUnboundedUnaligned"),
        (tw.Helical("x", 0.3), "HX"),
        (tw.Helical("y", -0.1), "HY"),
        (tw.Helical("z", 0.0), "HZ"),
        (tw.Helical([0.36, 0.48, -0.8], 1 / 3), "HelicalUnaligned"),
        (tw.Planar(), "Planar"),
        (tw.Spherical(), "Spherical"),
        (tw.FreeFlyer(), "FreeFlyer"),
    ],
    ids=lambda x: x if isinstance(x, str) else f"{x.kind}{getattr(x, 'axis', '')}",
)
def test_joint_becomes_pinocchios_joint_of_that_axis_and_moves_the_same(joint, name):
    model = one_joint(joint)
    there = bridge.to_pinocchio_model(model)
    assert there.joints[1].shortname() == "JointModel" + name
    back = bridge.from_pinocchio_model(there)
    assert type(back.joints[1]) is type(joint)
    assert back.joints[1] == joint
    rng, data = np.random.default_rng(0), there.createData()
    q, v, a = model.random_configuration(rng=rng), rng.standard_normal(model.nv), rng.standard_normal(model.nv)
    V, A = bridge.to_pinocchio_tangent(model, v), bridge.to_pinocchio_tangent(model, a)
    tau = bridge.from_pinocchio_tangent(model, pin.rnea(there, data, q, V, A))
    assert close(tw.rnea(model, q, v, a), tau)
    assert close(tw.rnea(back, q, v, a), tau)
    pin.forwardKinematics(there, data, q)
    assert close(tw.forward_kinematics(model, q).placement[1].matrix(), data.oMi[1].homogeneous)


@needs_pinocchio
def test_armature_and_limits_of_a_free_flyer_change_order():
    model = tree_with_free_flyer_inside()
    there = bridge.to_pinocchio_model(model)
    assert there.armature.tolist() == [0, 4, 5, 6, 1, 2, 3, 0]
    assert there.velocityLimit.tolist() == [np.inf, 4, 5, 6, 1, 2, 3, np.inf]
    assert there.effortLimit.tolist() == [np.inf, 40, 50, np.inf, 10, 20, 30, np.inf]
    same_model(model, bridge.from_pinocchio_model(there))
    q = model.random_configuration(rng=0)
    M = bridge.from_pinocchio_matrix(model, pin.crba(there, there.createData(), q))
    assert close(tw.crba(model, q), M)


@needs_pinocchio
def test_limits_of_position_stand_where_they_stood():
    builder = tw.Builder("limits")
    builder.link("a", parent="base_link", joint=tw.Planar(), lower=[-1, -2, -3, -4], upper=[1, 2, 3, 4])
    builder.link("b", parent="a", joint=tw.Revolute("x"), lower=-0.5, upper=0.25, velocity_limit=7, effort_limit=9)
    there = bridge.to_pinocchio_model(builder.build())
    assert there.lowerPositionLimit.tolist() == [-1, -2, -3, -4, -0.5]
    assert there.upperPositionLimit.tolist() == [1, 2, 3, 4, 0.25]
    assert there.velocityLimit[3] == 7
    assert (there.effortLimit[3], there.lowerEffortLimit[3]) == (9, -9)


@needs_pinocchio
def test_largest_double_is_no_limit_here():
    there = pin.Model()
    there.addJoint(0, pin.JointModelRX(), pin.SE3.Identity(), "a")
    assert np.isfinite(there.upperPositionLimit).all()
    model = bridge.from_pinocchio_model(there)
    assert (model.lower[0], model.upper[0], model.velocity_limit[0], model.effort_limit[0]) == (-np.inf, *[np.inf] * 3)


@needs_pinocchio
def test_gravity_is_handed_over():
    model = tw.Builder("moon", base="floating", gravity=[0.1, 0.2, -1.62]).build()
    there = bridge.to_pinocchio_model(model)
    assert there.gravity.linear.tolist() == [0.1, 0.2, -1.62]
    assert not there.gravity.angular.any()
    assert bridge.from_pinocchio_model(there).gravity.tolist() == [0.1, 0.2, -1.62]


@needs_pinocchio
def test_standing_posture_becomes_a_reference_configuration():
    model = tw.load("go2")
    there = bridge.to_pinocchio_model(model)
    assert (there.referenceConfigurations["standing"] == model.standing()).all()
    assert (bridge.from_pinocchio_model(there).standing() == model.standing()).all()


@needs_pinocchio
def test_frames_are_where_they_were(pair):
    p = pair
    pin.framesForwardKinematics(p.there, p.data, p.q)
    names = [frame.name for frame in p.there.frames][1:]
    assert sorted(names) == sorted(p.model.frame_names)
    for index, frame in enumerate(p.there.frames):
        if index:
            theirs = p.data.oMf[index].homogeneous
            assert close(tw.frame_placement(p.model, p.q, frame.name).matrix(), theirs)
            assert p.there.frames[frame.parentFrame].parentJoint in (
                frame.parentJoint,
                p.model.parent[frame.parentJoint],
            )


@needs_pinocchio
def test_link_and_joint_of_one_name_that_lie_apart_stay_apart():
    builder = tw.Builder("like ANYmal C", base="floating")
    at = tw.SE3(np.eye(3), [1, 0, 0])
    builder.link("hip", parent="base_link", joint_name="leg", joint=tw.Revolute("x"), placement=at)
    builder.link("foot", parent="hip", joint_name="hip", placement=at)
    builder.link("knee", parent="hip", joint_name="foot", joint=tw.Revolute("y"), placement=at)
    model = builder.build()
    assert {"link:hip", "joint:hip", "link:foot", "joint:foot"} <= set(model.frames)
    there = bridge.to_pinocchio_model(model)
    kinds = pin.FrameType
    assert there.frames[there.getFrameId("hip", kinds.BODY)].placement.translation.tolist() == [0, 0, 0]
    assert there.frames[there.getFrameId("hip", kinds.FIXED_JOINT)].placement.translation.tolist() == [1, 0, 0]
    assert there.getFrameId("foot", kinds.JOINT) < there.nframes
    same_model(model, bridge.from_pinocchio_model(there))


@needs_pinocchio
def test_later_changes_on_one_side_do_not_reach_the_other():
    model = tw.load("go2")
    there = bridge.to_pinocchio_model(model)
    back = bridge.from_pinocchio_model(there)
    there.inertias[1].mass = 100.0
    there.jointPlacements[2] = pin.SE3.Random()
    there.gravity = pin.Motion.Zero()
    there.armature = np.ones(18)
    there.upperPositionLimit = np.zeros(19)
    for frame in there.frames:
        frame.placement.translation = np.ones(3)
    same_model(back, model)
    same_model(tw.load("go2"), model)


URDFS = [(robot, base) for robot in ("go2", "pendulum", "double_pendulum", "cart_pole", "planar_arm", "humanoid")
         for base in ("fixed", "floating")]  # fmt: skip


def from_urdf(path, base):
    return (
        pin.buildModelFromUrdf(str(path), pin.JointModelFreeFlyer())
        if base == "floating"
        else (pin.buildModelFromUrdf(str(path)))
    )


@needs_pinocchio
@pytest.mark.parametrize(("robot", "base"), URDFS)
def test_model_handed_over_is_the_one_that_pinocchio_reads_from_the_urdf(robot, base):
    model = tw.load(robot, base=base)
    ours, theirs = bridge.to_pinocchio_model(model), from_urdf(urdf(robot), base)
    assert (ours.nq, ours.nv, ours.name) == (theirs.nq, theirs.nv, theirs.name)
    assert list(ours.names) == list(theirs.names)
    assert list(ours.parents) == list(theirs.parents)
    assert [j.shortname() for j in list(ours.joints)[1:]] == [j.shortname() for j in list(theirs.joints)[1:]]
    assert {frame.name for frame in ours.frames} == {frame.name for frame in theirs.frames}
    assert ours.gravity == theirs.gravity
    for i in range(1, ours.njoints):
        assert close(ours.jointPlacements[i].homogeneous, theirs.jointPlacements[i].homogeneous)
        assert close(ours.inertias[i].matrix(), theirs.inertias[i].matrix())
    for name in ("lowerPositionLimit", "upperPositionLimit", "velocityLimit", "effortLimit", "armature", "damping"):
        bounded = np.abs(getattr(theirs, name)) < np.finfo(float).max
        assert (getattr(ours, name)[bounded] == getattr(theirs, name)[bounded]).all(), name


@needs_pinocchio
@pytest.mark.parametrize(("robot", "base"), URDFS)
def test_model_taken_from_pinocchio_has_its_dynamics(robot, base):
    check_taken_over(from_urdf(urdf(robot), base), tw.load(robot, base=base))


def urdf(robot):
    return next(row.path for row in tw.robots() if row.name == robot)


def check_taken_over(there, loaded):
    """Pinocchio's model taken over here is the one that `tw.load` reads, and has Pinocchio's rnea."""
    model = bridge.from_pinocchio_model(there)
    assert (model.base, model.joint_names, model.parent) == (loaded.base, loaded.joint_names, loaded.parent)
    assert set(model.frames) == set(loaded.frames)
    assert [joint.kind for joint in model.joints[1:]] == [joint.kind for joint in loaded.joints[1:]]
    rng, data = np.random.default_rng(0), there.createData()
    q = model.random_configuration(rng=rng)
    v, a = rng.standard_normal((2, model.nv))
    V, A = bridge.to_pinocchio_tangent(model, v), bridge.to_pinocchio_tangent(model, a)
    tau = bridge.from_pinocchio_tangent(model, pin.rnea(there, data, q, V, A))
    assert close(tw.rnea(model, q, v, a), tau)
    assert close(tw.rnea(loaded, q, v, a), tau)
    assert close(tw.crba(model, q), bridge.from_pinocchio_matrix(model, pin.crba(there, data, q)))
    there_again = bridge.to_pinocchio_model(model)
    assert close(pin.rnea(there_again, there_again.createData(), q, V, A), pin.rnea(there, data, q, V, A))


@needs_pinocchio
@pytest.mark.slow
@pytest.mark.parametrize("robot", [row for row in tw.robots() if row.source != "models"], ids=lambda row: row.name)
def test_every_robot_of_example_robot_data_is_taken_over(robot):
    try:
        path = robot.path
    except tw.ModelError as missing:
        pytest.skip(str(missing))
    there = from_urdf(path, robot.base)
    check_taken_over(there, tw.load(robot.name, physical=False))


@needs_pinocchio
@pytest.mark.parametrize(
    ("where", "value", "said"),
    [
        ("gravity", lambda: pin.Motion(np.array([0, 0, np.nan]), np.zeros(3)), "gravity: expected a finite acc"),
        ("armature", lambda: np.array([0.0, np.nan]), "joint 'b': armature: is not a number"),
        ("armature", lambda: np.array([0.0, -1.0]), "joint 'b': armature .* is below zero"),
        ("lowerPositionLimit", lambda: np.array([np.nan, 0.0]), "joint 'a': lower: is not a number"),
        ("lowerPositionLimit", lambda: np.array([0.0, 3.0]), "joint 'b': lower limit .* is above upper limit"),
        ("upperVelocityLimit", lambda: np.array([-1.0, 3.0]), "joint 'a': velocity_limit .* is below zero"),
        ("names", lambda: ["universe", "a", "a"], "joint 'a': the name is taken"),
        ("names", lambda: ["universe", "a", "universe"], "joint 'universe': the name belongs to the world"),
    ],
)
def test_numbers_and_names_that_cannot_be_are_not_taken_over(where, value, said):
    there = pin.Model()
    for name in "ab":
        there.addJoint(0, pin.JointModelRX(), pin.SE3.Identity(), name)
    there.upperPositionLimit = np.ones(2)
    if where == "names":
        for i, name in enumerate(value()):
            there.names[i] = name
    else:
        setattr(there, where, value())
    with pytest.raises(tw.ModelError, match=said):
        bridge.from_pinocchio_model(there)


@needs_pinocchio
def test_joints_without_a_counterpart_are_all_named():
    there = pin.Model()
    there.addJoint(0, pin.JointModelRX(), pin.SE3.Identity(), "good")
    there.addJoint(1, pin.JointModelSphericalZYX(), pin.SE3.Identity(), "wrist")
    there.addJoint(
        2, pin.JointModelUniversal(np.array([1.0, 0, 0]), np.array([0, 1.0, 0])), pin.SE3.Identity(), "cross"
    )
    there.addJoint(2, pin.JointModelTranslation(), pin.SE3.Identity(), "gantry")
    composite = pin.JointModelComposite()
    composite.addJoint(pin.JointModelRX())
    there.addJoint(0, composite, pin.SE3.Identity(), "stack")
    with pytest.raises(tw.ModelError) as caught:
        bridge.from_pinocchio_model(there)
    for part in ("'wrist' (SphericalZYX)", "'cross' (Universal)", "'gantry' (Translation)", "'stack' (Composite)"):
        assert part in str(caught.value)
    assert "'good'" not in str(caught.value)


@needs_pinocchio
def test_joint_of_a_kind_that_pinocchio_lacks_is_refused_by_name():
    class Helical(tw.Revolute):
        """A screw."""

    class Ball(tw.Spherical):
        """A ball."""

    for joint in (Helical("z"), Ball()):
        model = replace(tw.random_tree(1, rng=0, kinds=[joint.kind]), joints=(None, joint))
        message = f"joint {model.joint_names[1]!r}: Pinocchio has no {type(joint).__name__}; it has Revolute, Prismatic"
        with pytest.raises(tw.ModelError, match=message):
            bridge.to_pinocchio_model(model)


MIMIC = """<robot name="gripper"><link name="palm"/><link name="left"/><link name="right"/>
<joint name="l" type="prismatic"><parent link="palm"/><child link="left"/><axis xyz="0 1 0"/>
<limit lower="0" upper="1" effort="1" velocity="1"/></joint>
<joint name="r" type="prismatic"><parent link="palm"/><child link="right"/><axis xyz="0 -1 0"/>
<limit lower="0" upper="1" effort="1" velocity="1"/><mimic joint="l"/></joint></robot>"""


@needs_pinocchio
def test_mimic_joint_that_follows_is_refused_and_one_that_does_not_is_taken():
    with pytest.raises(tw.ModelError, match=r"'r' \(Mimic\)"):
        bridge.from_pinocchio_model(pin.buildModelFromXML(MIMIC, mimic=True))
    assert bridge.from_pinocchio_model(pin.buildModelFromXML(MIMIC)).nv == 2


def with_one_joint():
    there = pin.Model()
    there.addJoint(0, pin.JointModelRX(), pin.SE3.Identity(), "elbow")
    return there


def rotating_gravity(there):
    there.gravity = pin.Motion(np.array([0, 0, -9.81]), np.array([0, 0, 1.0]))


def negative_mass(there):
    there.inertias[1] = pin.Inertia(-1.0, np.zeros(3), np.eye(3))


def sheared_placement(there):
    there.jointPlacements[1] = pin.SE3(2 * np.eye(3), np.zeros(3))


def short_posture(there):
    there.referenceConfigurations["rest"] = np.zeros(3)


def two_of_a_kind(there):
    for at in (0.0, 1.0):
        there.addFrame(pin.Frame("cable", 1, 0, pin.SE3(np.eye(3), np.full(3, at)), FIXED[int(at)]))


@needs_pinocchio
@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (rotating_gravity, "gravity: expected a finite acceleration without rotation"),
        (negative_mass, "'elbow': inertia of its body: mass: expected no negative mass, got -1 kg"),
        (sheared_placement, "'elbow': placement: rotation"),
        (short_posture, "'rest': named configuration"),
        (two_of_a_kind, "'cable': two joints of one name"),
    ],
)
def test_model_that_cannot_be_is_refused_by_name(spoil, message):
    there = with_one_joint()
    spoil(there)
    with pytest.raises(tw.ModelError, match=message):
        bridge.from_pinocchio_model(there)


FIXED = [pin.FrameType.JOINT, pin.FrameType.FIXED_JOINT] if "pin" in globals() else []


@needs_pinocchio
def test_empty_model_is_a_world_and_nothing_else():
    model = bridge.from_pinocchio_model(pin.Model())
    assert (model.nbodies, model.nq, model.nv, model.base) == (1, 0, 0, "fixed")
    assert bridge.to_pinocchio_model(model).njoints == 1


@needs_pinocchio
def test_objects_of_the_other_package_are_named():
    for function, given, message in (
        (bridge.to_pinocchio_se3, pin.SE3.Identity(), r"T: expected twistwrench\.SE3, got pinocchio\.SE3"),
        (bridge.from_pinocchio_se3, tw.SE3.identity(), r"T: expected pinocchio\.SE3, got twistwrench\.SE3"),
        (bridge.to_pinocchio_inertia, np.eye(6), r"inertia: expected twistwrench\.SpatialInertia, got numpy\.ndarray"),
        (bridge.from_pinocchio_inertia, np.eye(6), r"inertia: expected pinocchio\.Inertia, got numpy\.ndarray"),
    ):
        with pytest.raises(TypeError, match=f"^{message}$"):
            function(given)

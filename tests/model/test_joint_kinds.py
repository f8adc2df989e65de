"""Kinds of joint: the table of them, and kinds of one's own, which nothing outside the class has ever seen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge, fast, newton_euler_3d
from twistwrench.model import KINDS, AxisJoint, GroupJoint, Joint, placement, turn, unit
from twistwrench.spatial import exp6

from ..sampling import sampled
from ..strategies import random_state


class Screwed(AxisJoint):
    """A turn of q about an axis, and a slide of 0.3 m/rad along it."""

    kind, nq = "screwed", 1

    def subspace(self, dtype=np.float64):
        return np.concatenate([self._axis(dtype), self._axis(dtype) * np.dtype(dtype).type(0.3)])[:, None]

    def transform(self, q):
        R = turn(self._axis(q.dtype), np.cos(q), np.sin(q)).rotation
        return placement(R, q.dtype.type(0.3) * q * self._axis(q.dtype))


class Geared(AxisJoint):
    """A turn by twice q."""

    kind, nq = "geared", 1

    def subspace(self, dtype=np.float64):
        return np.concatenate([2 * self._axis(dtype), np.zeros(3, dtype)])[:, None]

    def transform(self, q):
        return turn(self._axis(q.dtype), np.cos(2 * q), np.sin(2 * q))


@dataclass(frozen=True)
class Beside(Joint):
    """A turn about an axis that is beside the origin, askew to what it slides along."""

    kind, nq, nv = "beside", 1, 1

    def subspace(self, dtype=np.float64):
        return np.array([0.6, 0, 0.8, 0.2, -0.5, 0.1], dtype)[:, None]

    def transform(self, q):
        return exp6(self.subspace(q.dtype)[:, 0] * q)


@dataclass(frozen=True)
class Cylindrical(Joint):
    """A turn about z by the first entry of q, a slide along it by the second."""

    kind, nq, nv = "cylindrical", 2, 2

    def subspace(self, dtype=np.float64):
        return np.eye(6, dtype=dtype)[:, [2, 5]]

    def transform(self, q):
        z = np.eye(3, dtype=q.dtype)[2]
        return placement(turn(z, np.cos(q[..., :1]), np.sin(q[..., :1])).rotation, q[..., 1:] * z)


@dataclass(frozen=True)
class Sined(GroupJoint):
    """A turn about z with q = (sin, cos): as many entries and the same unit part as a continuous joint."""

    kind, nq, nv = "sined", 2, 1
    unit = slice(0, 2)
    _one = 1

    def subspace(self, dtype=np.float64):
        return np.eye(6, dtype=dtype)[:, 2:3]

    def transform(self, q):
        sc = unit(q)
        return turn(np.eye(3, dtype=q.dtype)[2], sc[..., 1:], sc[..., :1])

    def from_placement(self, T, near):
        return unit(T.rotation[..., [1, 0], 0])


OWN = {
    "screwed": lambda: Screwed([1, 2, -2]),
    "geared": lambda: Geared([0, 3, 4]),
    "beside": Beside,
    "cylindrical": Cylindrical,
    "sined": Sined,
}
DTYPES = [np.float64, np.float32, np.longdouble, np.complex128]


def robot(joint, base):
    """Four bodies: a joint of one's own on a hinge, one on that, and a slide at the end."""
    rng, builder = np.random.default_rng(3), tw.Builder("own", base=base)
    if base == "floating":
        builder = tw.Builder("own", base=base, root="base_link", root_inertia=lump(rng))
    parent = "base_link"
    for k, each in enumerate([tw.Revolute([1, 1, 0]), joint, joint, tw.Prismatic([0, 1, 1])]):
        at = tw.SE3(tw.exp3(rng.standard_normal(3)), rng.uniform(-0.5, 0.5, 3))
        rotor = np.full(each.nv, 0.1)
        builder.link(f"body_{k}", parent=parent, joint=each, placement=at, inertia=lump(rng), armature=rotor)
        parent = f"body_{k}"
    return builder.build()


def lump(rng):
    return tw.SpatialInertia(rng.uniform(0.5, 2), rng.uniform(-0.1, 0.1, 3), np.diag([0.02, 0.03, 0.04]))


@pytest.mark.one_case
@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("base", sampled(["fixed", "floating"], 1))
@pytest.mark.parametrize("kind", sampled(OWN, 2))
def test_fast_is_right_for_a_kind_that_it_has_never_seen(kind, base, dtype):
    model = robot(OWN[kind](), base)
    s = random_state(model, rng=1, batch=(20,), dtype=dtype)
    size = 1e4 * np.finfo(dtype).eps
    for count in (1, 3, 20):
        q, v, a, tau, f_ext = (x[:count] for x in s)
        want = tw.dynamics(model, q, v, contacts=["body_3"])
        got = fast.dynamics(model, q, v, contacts=["body_3"])
        pairs = [(getattr(got, name), getattr(want, name)) for name in ("M", "h", "J_c", "A_G")]
        pairs.append((fast.rnea(model, q, v, a), tw.rnea(model, q, v, a)))
        pairs.append((fast.rnea(model, q, v, a, f_ext), tw.rnea(model, q, v, a, f_ext)))
        pairs.append((fast.aba(model, q, v, tau), tw.aba(model, q, v, tau)))
        pairs.append((fast.aba(model, q, v, tau, f_ext), tw.aba(model, q, v, tau, f_ext)))
        for x, right in pairs:
            assert np.abs(x - right).max() < size * max(1, np.abs(right).max())


@pytest.mark.one_case
@pytest.mark.parametrize("kind", OWN)
def test_a_kind_of_ones_own_can_be_simulated_and_its_digits_foretold(kind):
    model = robot(OWN[kind](), "fixed")
    q, v = model.random_configuration(rng=2), np.full(model.nv, 0.3)
    run = tw.simulate(model, q, v, dt=1e-3, duration=0.02)
    energy = [tw.kinetic_energy(model, q, v) + tw.potential_energy(model, q) for q, v in zip(run.q, run.v)]
    assert np.ptp(energy) < 1e-6 * max(1, np.abs(energy).max())
    tw.accuracy(model, q)


@pytest.mark.parametrize("base", ["fixed", "floating"])
@pytest.mark.parametrize("kind", ["screwed", "geared", "beside"])
def test_a_kind_with_one_coordinate_is_right_without_spatial_algebra_too(kind, base):
    model = robot(OWN[kind](), base)
    s = random_state(model, rng=1)
    tau = newton_euler_3d.inverse_dynamics(model, s.q, s.v, s.a)
    assert np.allclose(tw.rnea(model, s.q, s.v, s.a), tau, rtol=0, atol=1e-12)
    q = np.array([0.7])
    R, p = newton_euler_3d.joints.joint_pose(newton_euler_3d.arithmetic.Arithmetic(q.dtype), OWN[kind](), q, "own")
    T = OWN[kind]().transform(q)
    assert np.allclose(T.rotation, R, rtol=0, atol=1e-15)
    assert np.allclose(T.translation, p, rtol=0, atol=1e-15)


# ---------------------------------------------------------------- the table


def test_every_kind_of_the_package_is_in_the_table_and_is_sampled_as_itself():
    for kind in KINDS:
        joint = Joint.kinds[kind].sample(np.random.default_rng(0))
        assert joint.kind == kind
        assert getattr(tw, type(joint).__name__) is type(joint)


def test_a_kind_of_ones_own_is_drawn_by_its_name_only():
    assert not set(OWN) & set(KINDS)
    model = tw.random_tree(4, rng=0, kinds=["cylindrical", "geared"])
    assert {joint.kind for joint in model.joints[1:]} == {"cylindrical", "geared"}


def test_a_kind_that_is_taken_is_refused():
    with pytest.raises(tw.ModelError, match="kind of Hinge: 'revolute' is taken by Revolute"):

        class Hinge(tw.Prismatic):
            kind = "revolute"


def test_a_class_defined_again_takes_the_place_of_the_first_as_in_a_notebook():
    for _ in range(2):

        class Again(tw.Revolute):
            kind = "again"

        assert Joint.kinds["again"] is Again


def test_another_kind_does_not_inherit_the_name_that_its_base_has_in_pinocchio():
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")

    class Worm(tw.Revolute):
        kind = "worm"

    for joint in (Worm("z"), Screwed("z")):
        with pytest.raises(tw.ModelError, match=f"Pinocchio has no {type(joint).__name__}; it has Revolute"):
            bridge.to_pinocchio_model(robot(joint, "fixed"))


# ---------------------------------------------------------------- a formula is arithmetic


class Number:
    """A number that can be computed with, and neither compared nor turned into a float."""

    def __init__(self, value):
        self.value = value

    def __repr__(self):
        return f"Number({self.value})"

    def _with(self, other, operation):
        if isinstance(other, np.ndarray):
            return NotImplemented
        return Number(operation(self.value, other.value if isinstance(other, Number) else other))

    def __add__(self, other):
        return self._with(other, lambda a, b: a + b)

    def __sub__(self, other):
        return self._with(other, lambda a, b: a - b)

    def __rsub__(self, other):
        return self._with(other, lambda a, b: b - a)

    def __mul__(self, other):
        return self._with(other, lambda a, b: a * b)

    def __truediv__(self, other):
        return self._with(other, lambda a, b: a / b)

    def __rtruediv__(self, other):
        return self._with(other, lambda a, b: b / a)

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self):
        return Number(-self.value)

    def cos(self):
        return Number(np.cos(self.value))

    def sin(self):
        return Number(np.sin(self.value))

    def sqrt(self):
        return Number(np.sqrt(self.value))

    def _refuse(self, *_):
        raise AssertionError("a formula looked at a value")

    __lt__ = __le__ = __gt__ = __ge__ = __eq__ = __ne__ = __bool__ = __float__ = __abs__ = _refuse
    __hash__ = None


def value(x):
    return x.value if isinstance(x, Number) else x


@pytest.mark.parametrize("batch", [(), (2,)], ids=str)
@pytest.mark.parametrize("kind", KINDS)
def test_where_a_joint_is_and_what_it_leaves_free_is_arithmetic_alone(kind, batch):
    rng = np.random.default_rng(4)
    joint = Joint.kinds[kind].sample(rng)
    free = np.full(joint.nq, np.inf)
    q = np.stack([joint.random(rng, -free, free) for _ in range(2)])[0 if not batch else slice(None)]
    objects = np.array([Number(x) for x in q.flat], object).reshape(q.shape)
    T, right = joint.transform(objects), joint.transform(q)
    for got, want in ((T.rotation, right.rotation), (T.translation, right.translation)):
        assert got.dtype == object
        assert np.allclose(np.vectorize(value, otypes=[float])(got), want, rtol=0, atol=1e-15)
    S = joint.subspace(object)  # fractions, whose squares add up to 1 exactly
    assert np.allclose(S.astype(float), joint.subspace(), rtol=0, atol=2e-16)
    turn = S[:3].any(axis=0)
    assert ((np.where(turn, S[:3], S[3:]) ** 2).sum(axis=0) == 1).all()


def test_a_joint_whose_subspace_is_not_constant_is_refused_by_name(monkeypatch):
    """Two axes that cross: the first one turns with the second in the moved frame."""
    monkeypatch.setattr(Joint, "kinds", dict(Joint.kinds))

    class Universal(Joint):
        kind, nq, nv = "universal", 2, 2

        def subspace(self, dtype=np.float64):
            return np.eye(6, 2, dtype=dtype)

        def transform(self, q):
            return tw.Revolute("x").transform(q[..., :1]) @ tw.Revolute("y").transform(q[..., 1:])

    builder = tw.Builder("gimbal", base="fixed")
    with pytest.raises(tw.ModelError, match=r"joint 'cross': expected an S that is constant.*a chain"):
        builder.link("ring", parent="base_link", joint=Universal(), joint_name="cross")

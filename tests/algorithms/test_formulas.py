"""A formula is arithmetic: every recursion, joint and transform runs on numbers that nobody can look at."""

import math

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.algorithms.aba import articulated_body
from twistwrench.algorithms.articulated import articulated_inertias
from twistwrench.algorithms.centroidal import centroidal_composite, placements_from_first_body, to_center_of_mass
from twistwrench.algorithms.coriolis import christoffel
from twistwrench.algorithms.crba import composite_rigid_body
from twistwrench.algorithms.delassus import delassus
from twistwrench.algorithms.factorization import factorize, inboard_dofs, solve_inward, solve_outward
from twistwrench.algorithms.inverse_mass import unit_force_responses
from twistwrench.algorithms.kinematics import motion, placements
from twistwrench.algorithms.momentum_rate import momentum_map_rate, total_inertia
from twistwrench.algorithms.rnea import newton_euler
from twistwrench.algorithms.subtree import subtree_momentum_map
from twistwrench.model import KINDS, Joint, columns, composite_inertias, joint_placements, tree_terms, wrenches
from twistwrench.spatial import SE3

from ..robots import shared


class Blind:
    """A number that can be added, subtracted, multiplied, divided and turned, but not looked at."""

    __hash__ = None

    def __init__(self, hidden):
        self.hidden = hidden

    def _with(self, other, operation):
        if isinstance(other, np.ndarray):
            return NotImplemented  # NumPy takes it entry by entry
        return Blind(operation(self.hidden, other.hidden if isinstance(other, Blind) else other))

    def __add__(self, other):
        return self._with(other, lambda x, y: x + y)

    def __radd__(self, other):
        return self._with(other, lambda x, y: y + x)

    def __sub__(self, other):
        return self._with(other, lambda x, y: x - y)

    def __rsub__(self, other):
        return self._with(other, lambda x, y: y - x)

    def __mul__(self, other):
        return self._with(other, lambda x, y: x * y)

    def __rmul__(self, other):
        return self._with(other, lambda x, y: y * x)

    def __truediv__(self, other):
        return self._with(other, lambda x, y: x / y)

    def __rtruediv__(self, other):
        return self._with(other, lambda x, y: y / x)

    def __neg__(self):
        return Blind(-self.hidden)

    def sin(self):
        return Blind(math.sin(self.hidden))

    def cos(self):
        return Blind(math.cos(self.hidden))

    def sqrt(self):
        return Blind(math.sqrt(self.hidden))

    def _looked_at(self, *_):
        raise AssertionError("a formula has looked at a number")

    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = __bool__ = __abs__ = _looked_at
    __float__ = __int__ = __complex__ = __index__ = __round__ = _looked_at


def blind(x):
    return np.frompyfunc(Blind, 1, 1)(np.asarray(x, float)).astype(object).reshape(np.shape(x))


def seen(x):
    """What is behind the numbers of an array."""
    flat = [y.hidden if isinstance(y, Blind) else float(y) for y in np.asarray(x, object).flat]
    return np.array(flat, float).reshape(np.shape(x))


def close(x, y, name=""):
    size = max(1.0, float(np.abs(y).max(initial=0)))
    np.testing.assert_allclose(seen(x), y, rtol=0, atol=1e-11 * size, err_msg=name)


def test_blind_numbers_cannot_be_looked_at():
    for look in (float, bool, abs, lambda x: x < 1, lambda x: x == 1, np.isfinite):
        with pytest.raises((AssertionError, TypeError)):
            look(Blind(1.0))
    assert seen(Blind(2.0) * np.eye(2))[1, 1] == 2


JOINTS = {kind: Joint.kinds[kind].sample(np.random.default_rng(1)) for kind in KINDS}


@pytest.mark.parametrize("kind", JOINTS)
@pytest.mark.parametrize("batch", [(), (2,)])
def test_every_joint_places_its_frame_without_looking(kind, batch):
    joint, rng = JOINTS[kind], np.random.default_rng(0)
    q = rng.standard_normal((*batch, joint.nq))
    if joint.unit is not None:
        q[..., joint.unit] /= np.linalg.norm(q[..., joint.unit], axis=-1, keepdims=True)
    ours, theirs = joint.transform(blind(q)), joint.transform(q)
    close(ours.rotation, theirs.rotation)
    close(ours.translation, theirs.translation)
    close(joint.subspace(object), joint.subspace())


def test_every_transform_is_arithmetic():
    rng = np.random.default_rng(0)
    real = [SE3(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3)) for _ in range(2)]
    hidden = [SE3._trusted(blind(T.rotation), blind(T.translation)) for T in real]
    for f in (SE3.motion_transform, SE3.force_transform, SE3.matrix, lambda T: T.inverse().motion_transform()):
        close(f(hidden[0]), f(real[0]))
    close((hidden[0] @ hidden[1]).matrix(), (real[0] @ real[1]).matrix())


MODELS = [
    shared("go2"),
    shared("cart_pole"),
    *(tw.random_tree(7, rng=seed, base=base) for seed in (1, 5) for base in ("fixed", "floating")),
]


@pytest.fixture(params=MODELS, ids=lambda model: f"{model.name} {model.base} {model.nv}")
def state(request):
    model, rng = request.param, np.random.default_rng(3)
    q, v, a = model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv))
    f_ext = rng.standard_normal((model.nbodies, 6))
    f_ext[0] = 0
    return model, q, v, a, f_ext


def test_the_random_trees_have_every_joint():
    kinds = {joint.kind for model in MODELS for joint in model.joints if joint}
    assert kinds == set(JOINTS)


def test_every_recursion_is_arithmetic(state):
    model, q, v, a, f_ext = state
    tree = tree_terms(model, blind(q))
    qd, qdd, wrench = columns(model, blind(v)), columns(model, blind(a)), wrenches(blind(f_ext))

    inverse, expected = newton_euler(tree, qd, qdd, wrench), tw.rnea_terms(model, q, v, a, f_ext)
    for name in ("V", "A", "B", "F"):
        for x, y in zip(getattr(inverse, name), getattr(expected, name), strict=True):
            close(x, y, name)
    close(inverse.tau, expected.tau, "tau")

    close(articulated_body(tree, qd, columns(model, blind(expected.tau)), wrench).qdd, a, "qdd")
    close(composite_rigid_body(tree).M, tw.crba(model, q), "M")
    close(christoffel(tree, qd), tw.coriolis_matrix(model, q, v), "C")
    close(centroidal_composite(tree, placements_from_first_body(model, tree)).A_G, tw.centroidal_map(model, q), "A_G")
    kinematics = tw.forward_kinematics(model, q, v, a)
    V, A = motion(tree, qd, qdd)
    close(np.stack(V)[..., 0], kinematics.twist, "V")
    close(np.stack(A)[..., 0], kinematics.acceleration, "A")
    for x, y in zip(placements(model.parent, joint_placements(model, blind(q))), kinematics.placement, strict=True):
        close(x.matrix(), y.matrix())
    close(composite_inertias(tree)[0], composite_inertias(tree_terms(model, q))[0], "IC")


def test_factors_solves_and_inverses_are_arithmetic(state):
    model, q, v, _, _ = state
    tree, inboard = tree_terms(model, blind(q)), inboard_dofs(tree_terms(model, q))
    L, D = factorize(composite_rigid_body(tree).M, inboard)
    for x, y in zip((L, D), tw.ltdl(model, q), strict=True):
        close(x, y)
    x = solve_outward(L, inboard, solve_inward(L, inboard, blind(v)[:, None]) / D[:, None])
    close(x[:, 0], tw.solve_mass_matrix(model, q, v))
    close(unit_force_responses(tree, articulated_inertias(tree)), tw.inverse_mass_matrix(model, q))
    J = tw.frame_jacobian(model, q, model.frame_names[-1])
    close(delassus(L, D, inboard, blind(J)), tw.delassus_matrix(model, q, J))


def test_rates_and_parts_of_the_momentum_are_arithmetic(state):
    model, q, v, _, _ = state
    tree = tree_terms(model, blind(q))
    X = to_center_of_mass(model, tree, blind(q))
    close(momentum_map_rate(tree, X, columns(model, blind(v))), tw.centroidal_map_rate(model, q, v), "dA_G")
    close(total_inertia(tree, X, range(model.nbodies)), tw.centroidal_inertia(model, q), "I_G")
    close(subtree_momentum_map(tree, X, 0), tw.centroidal_map(model, q), "A_G")


# ---------------------------------------------------------------- checked once


@pytest.mark.parametrize(
    ("call", "most"),
    [
        (lambda m, q, v: tw.rnea(m, q, v, v), 1),
        (lambda m, q, v: tw.aba(m, q, v, v), 1),
        (lambda m, q, v: tw.crba(m, q), 1),
        (lambda m, q, v: tw.coriolis_matrix(m, q, v), 1),
        (lambda m, q, v: tw.forward_kinematics(m, q, v, v), 1),
        (lambda m, q, v: tw.centroidal_map(m, q), 1),
        (lambda m, q, v: tw.centroidal_momentum(m, q, v), 1),
        (lambda m, q, v: tw.kinetic_energy(m, q, v), 1),
        (lambda m, q, v: tw.potential_energy(m, q), 1),
        (lambda m, q, v: tw.dynamics(m, q, v), 9),  # four functions of the textbook, J_c one for each foot
    ],
)
def test_nothing_is_checked_twice(call, most, monkeypatch):
    model = shared("go2")
    q, v = model.standing(), np.zeros(model.nv)
    call(model, q, v)  # what is made once for a model is made
    counted = []
    import twistwrench.arrays.conversion as checks
    import twistwrench.model.state as entrance

    original = checks.as_arrays

    def count(**named):
        counted.append(named)
        return original(**named)

    monkeypatch.setattr(checks, "as_arrays", count)
    monkeypatch.setattr(entrance, "as_arrays", count)
    call(model, q, v)
    assert len(counted) <= most

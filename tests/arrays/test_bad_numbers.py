"""Numbers that are huge, single, masked or missing: what comes out is finite, or an error that says why not."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

from ..robots import shared

GO2 = shared("go2")
STAND, REST = GO2.standing(), np.zeros(18)
ARM = tw.chain(3)


def slider(joint=None, **limits):
    builder = tw.Builder("slider")
    rod = tw.SpatialInertia(1.0, [0, 0, -0.5], 0.1 * np.eye(3))
    builder.link("rod", parent="base_link", joint=joint or tw.Revolute("y"), inertia=rod, **limits)
    return builder.build()


# ---------------------------------------------------------------- huge


@pytest.mark.parametrize("size", [1e78, 1e160, 1e308])
def test_number_whose_products_overflow_is_refused_by_its_name(size):
    zero = np.zeros(3)
    for name, function in {
        "q": lambda x: tw.crba(ARM, x),
        "v": lambda x: tw.rnea(ARM, zero, x, zero),
        "a": lambda x: tw.rnea(ARM, zero, zero, x),
        "tau": lambda x: tw.aba(ARM, zero, zero, x),
    }.items():
        most = r"1.2e\+77" if name == "q" else r"4.5e\+61"
        with pytest.raises(ValueError, match=rf"^{name}: expected at most {most}, as products overflow in float64"):
            function(np.array([0, size, 0]))
    with pytest.raises(ValueError, match=r"v: .* got 1e\+62 at \(1, 2\)"):
        tw.kinetic_energy(ARM, zero, [[0, 0, 0], [0, 0, 1e62]])


def test_largest_numbers_that_are_let_in_give_finite_ones():
    flying = tw.chain(3, base="floating")
    for dtype in (np.float32, np.float64):
        far, big = (dtype(0.99 * float(np.finfo(dtype).max) ** root) for root in (1 / 4, 1 / 5))
        q, v = flying.neutral().astype(dtype), np.full(flying.nv, big)
        q[:3] = far
        for x in (
            tw.rnea(flying, q, v, v),
            tw.aba(flying, q, v, v),
            tw.kinetic_energy(flying, q, v),
            tw.crba(flying, q),
        ):
            assert x.dtype == dtype
            assert np.isfinite(x).all()


# ---------------------------------------------------------------- random configurations


@pytest.mark.parametrize(
    ("joint", "span"), [(tw.Revolute("y"), np.pi), (tw.Prismatic("y"), 1.0)], ids=["turn", "slide"]
)
@pytest.mark.parametrize(
    ("lower", "upper", "middle"),
    [
        (-np.inf, np.inf, 0),
        (-1e16, 1e16, 0),
        (-1.7e308, 1.7e308, 0),
        (-50.0, np.inf, 0),
        (0.0, np.inf, 1),  # in spans
        (0.0, 1e5, 1),
        (-np.inf, 0.0, -1),
    ],
)
def test_range_without_end_is_cut_to_one_turn_or_two_metres_near_zero(joint, span, lower, upper, middle):
    model = slider(joint, lower=lower, upper=upper)
    q = np.array([model.random_configuration(rng=seed)[0] for seed in range(200)])
    assert ((q >= lower) & (q <= upper)).all()
    assert (np.abs(q - middle * span) <= span).all()
    assert np.ptp(q) > 1.8 * span


def test_range_of_many_turns_is_kept():
    model = slider(lower=-99 * np.pi, upper=99 * np.pi)
    q = np.array([model.random_configuration(rng=seed)[0] for seed in range(200)])
    assert np.abs(q).max() > 90 * np.pi


# ---------------------------------------------------------------- quaternions


def test_quaternion_is_judged_by_the_precision_it_came_with():
    q = GO2.random_configuration(rng=1).astype(np.float32)
    q[3:7] *= np.float32(1 + 1e-6)
    assert abs(np.linalg.norm(q[3:7].astype(float)) - 1) > 5e-7  # float64 would have it below 1.5e-8
    v = np.random.default_rng(0).standard_normal((3, 18))
    exact = GO2.normalize(q.astype(float))
    f_ext = np.zeros((14, 6))
    for function, others in (
        (tw.rnea, (v[0], v[1], f_ext)),
        (tw.aba, (v[0], v[1], f_ext)),
        (tw.nonlinear_effects, (v[0],)),
        (tw.coriolis_matrix, (v[0],)),
        (tw.kinetic_energy, (v[0],)),
        (tw.centroidal_momentum, (v[0],)),
        (tw.centroidal_momentum_rate, (v[0], v[1])),
    ):
        right = function(GO2, exact, *others)
        assert np.abs(function(GO2, q, *others) - right).max() < 1e-12 * np.abs(right).max()
    GO2.integrate(q, v[0])
    tw.forward_kinematics(GO2, q, v[0], v[1])
    tw.frame_bias_acceleration(GO2, q, v[0], "FR_foot")
    with pytest.raises(ValueError, match="norm 1"):
        tw.crba(GO2, q.astype(float))


def test_quaternion_off_norm_1_is_placed_and_measured():
    q = np.stack([STAND] * 4)
    q[2, 3:7] *= 1 + 1e-7
    with pytest.raises(ValueError, match=r"has norm 1 at index \(2,\), which is 1 \+1e-07; model.normalize"):
        tw.crba(GO2, q)
    q[2, 3:7] = 0
    with pytest.raises(ValueError, match=r"joint 'root_joint' \(q\[0:7\]\): .* all zero at index \(2,\)"):
        GO2.normalize(q)


# ---------------------------------------------------------------- masked, missing


def test_masked_numbers_are_refused():
    hidden = np.ma.masked_greater(np.arange(3.0), 1.5)
    with pytest.raises(ValueError, match="q: expected numbers, got a masked array"):
        tw.crba(ARM, hidden)
    with pytest.raises(ValueError, match="w: expected numbers, got a masked array"):
        tw.exp3(hidden)
    assert tw.crba(ARM, np.ma.array(np.zeros(3))).shape == (3, 3)  # nothing is hidden here


def test_what_is_missing_is_called_so():
    with pytest.raises(ValueError, match=r"^q: expected numbers, got None$"):
        tw.crba(ARM, None)
    with pytest.raises(ValueError, match=r"^v: expected numbers, got None$"):
        tw.rnea(ARM, np.zeros(3), None, np.zeros(3))


def test_wrenches_without_the_row_of_the_world_are_recognised():
    with pytest.raises(tw.ShapeError, match=r"f_ext: expected shape \(..., 14, 6\), got \(13, 6\); row 0 is the world"):
        tw.rnea(GO2, STAND, REST, REST, np.zeros((13, 6)))


@pytest.mark.parametrize("axis", [[1j, 0, 0], [1 + 1j, 0, 0]], ids=str)
def test_axis_is_real(axis):
    with pytest.raises(ValueError, match="axis: expected real numbers, got complex128"):
        tw.Revolute(axis)

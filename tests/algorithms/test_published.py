"""Numbers that other projects print in their tests and docstrings: docs/published.md says which, from where.

Their code is not here. A number with n digits after the point is met to half a unit of the last one.
"""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.loading import catalogue

from . import published
from .published import one


def printed(ours, theirs, digits):
    """Ours, rounded to as many digits after the point, are the printed ones."""
    ours, theirs = np.asarray(ours, float), np.asarray(theirs, float)
    assert ours.shape == theirs.shape
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=0.501 * 10.0**-digits)


# ---------------------------------------------------------------- RBDL (zlib licence)

X, Y, Z, O = "x", "y", "z", (0, 0, 0)
RBDL_TREES = {
    "single chain": ([(0, Z, O, one([1.0, 0, 0]))], [-4.905]),
    "spatial inertia": ([(0, Z, O, one([1.5, 1, 1], (1, 2, 3)))], [-2.3544]),
    "double chain": ([(0, Z, O, one([1.0, 0, 0])), (1, Z, (1, 0, 0), one([1.0, 0, 0]))], [-5.886, 3.924]),
    "triple chain": (
        [(k, Z, (1, 0, 0) if k else O, one([1.0, 0, 0])) for k in range(3)],
        [-6.03692307692308, 3.77307692307692, 1.50923076923077],
    ),
    "double chain in space": ([(0, Z, O, one([1.0, 0, 0])), (1, Y, (1, 0, 0), one([0, 1.0, 0]))], [-3.924, 0.0]),
    "tree": (
        [
            (0, Z, O, one([1.0, 0, 0])),
            (1, Y, (1, 0, 0), one([0, 1.0, 0])),
            (2, X, (0, 1, 0), one([0, 0, 1.0])),
            (1, Y, (-0.5, 0, 0), one([0, 1.0, 0])),
            (4, X, (0, -0.5, 0), one([0, 0, 1.0])),
        ],
        [-1.60319066147860, -0.534396887159533, 4.10340466926070, 0.267198443579767, 5.30579766536965],
    ),
}


@pytest.mark.parametrize("name", RBDL_TREES)
def test_forward_dynamics_of_rbdl(name):
    links, qdd = RBDL_TREES[name]
    model = published.rbdl_tree(*links)
    zero = np.zeros(model.nv)
    printed(tw.aba(model, zero, zero, zero), qdd, 13)
    printed(tw.solve_mass_matrix(model, zero, -tw.gravity(model, zero)), qdd, 13)


def test_three_axes_in_one_point_of_spatial_v1():
    """RBDL has the number from Featherstone's spatial_v1."""
    body = one([0, 0.5, 0])
    model = published.rbdl_tree((0, Z, O, None), (1, Y, O, None), (2, X, O, body))
    qdd = tw.aba(model, [1.0, 0, 0], np.zeros(3), np.zeros(3))
    printed(qdd, [3.301932144386186, 0, 0], 13)


def test_floating_base_of_rbdl_with_a_torque_at_its_arm():
    builder = tw.Builder("two", base="floating", root_inertia=one([1.0, 0, 0]), gravity=[0, -9.81, 0])
    builder.link("arm", parent="base_link", joint=tw.Revolute("z"), placement=published.moved(2, 0, 0),
                 inertia=one([1.0, 0, 0]))  # fmt: skip
    model = builder.build()
    qdd = tw.aba(model, model.neutral(), np.zeros(7), [0, 0, 0, 0, 0, 0, 1.0])
    printed(qdd, [0, 0, -1, 0, -8.81, 0, 2], 13)  # (ω, v) of the base


HUMANS = np.array([0.1, 1.1, 1.2, 1.3, 1.5, 1.7])


@pytest.mark.parametrize(
    ("q", "v", "a", "acceleration"),
    [
        (HUMANS, HUMANS, 0, [-5.302760158847160, 6.541369639625232, -4.795115077652286]),
        (0, 0, HUMANS, [2.44, -1.37, 0.99]),
        (HUMANS, HUMANS, HUMANS, [-4.993637532756404, 10.43238173517606, -0.6948370826218673]),
    ],
)
def test_a_point_moves_as_humans_says(q, v, a, acceleration):
    """From the HuMAnS toolbox, by way of RBDL."""
    model, (q, v, a) = published.six_axes(), (x + np.zeros(6) for x in (q, v, a))
    J = tw.frame_jacobian(model, q, "point", "local_world_aligned")[3:]
    bias = tw.frame_bias_acceleration(model, q, v, "point", "local_world_aligned")[3:]
    printed(J @ a + bias, acceleration, 13)
    if q.any():
        position = [-0.6357089363622626, -0.6831041744630977, 2.968974805916970]
        printed(tw.frame_placement(model, q, "point").translation, position, 14)
        printed(J @ v, [0.3091226260907569, 3.891012095550828, 4.100277995030419], 14)
        near = tw.frame_jacobian(model, q, "near", "local_world_aligned")[3:]
        printed(near @ v, [-0.3888503432977729, -0.3171179347202455, 1.093894197498446], 14)


def test_cross_product_of_spatial_vectors_of_rbdl_and_modern_robotics():
    expected = [
        [0, -3, 2, 0, 0, 0],
        [3, 0, -1, 0, 0, 0],
        [-2, 1, 0, 0, 0, 0],
        [0, -6, 5, 0, -3, 2],
        [6, 0, -4, 3, 0, -1],
        [-5, 4, 0, -2, 1, 0],
    ]
    assert (tw.cross_motion([1, 2, 3, 4, 5, 6]) == expected).all()


# ---------------------------------------------------------------- Modern Robotics (MIT licence)

TURN = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])


def test_algebra_of_modern_robotics():
    printed(tw.exp3([1, 2, 3]), [[-0.69492056, 0.71352099, 0.08929286], [-0.19200697, -0.30378504, 0.93319235],
                                 [0.69297817, 0.6313497, 0.34810748]], 8)  # fmt: skip
    printed(tw.log3([[0, 0, 1], [1, 0, 0], [0, 1, 0]]), [1.20919958] * 3, 8)
    printed(tw.log6(tw.SE3(TURN, [0, 0, 3])), [1.57079633, 0, 0, 0, 2.35619449, 2.35619449], 8)
    printed(tw.SE3(TURN, [0, 0, 3]).motion_transform(), [[1, 0, 0, 0, 0, 0], [0, 0, -1, 0, 0, 0], [0, 1, 0, 0, 0, 0],
            [0, 0, 3, 1, 0, 0], [3, 0, 0, 0, 0, -1], [0, 0, 0, 0, 1, 0]], 15)  # fmt: skip
    near = [[0.675, 0.150, 0.720], [0.370, 0.771, -0.511], [-0.630, 0.619, 0.472]]
    printed(tw.nearest_rotation(near), [[0.67901136, 0.14894516, 0.71885945], [0.37320708, 0.77319584, -0.51272279],
                                        [-0.63218672, 0.61642804, 0.46942137]], 8)  # fmt: skip


def test_dynamics_of_the_ur5_of_modern_robotics():
    model, q, v, a = published.ur5(), np.full(3, 0.1), np.array([0.1, 0.2, 0.3]), np.array([2, 1.5, 1])
    # Slist's first axis (1, 0, 1, 0, 1, 0) is no unit screw: its θ is our angle divided by √2
    scale = np.array([np.sqrt(2), 1, 1])
    q, v, a = q * scale, v * scale, a * scale
    M = scale[:, None] * tw.crba(model, q) * scale
    printed(M, [[22.5433380, -0.307146754, -0.00718426391], [-0.307146754, 1.96850717, 0.432157368],
                [-0.00718426391, 0.432157368, 0.191630858]], 7)  # fmt: skip
    C_v = tw.nonlinear_effects(model, q, v) - tw.gravity(model, q)
    printed(scale * C_v, [0.26453118, -0.05505157, -0.00689132], 8)
    printed(scale * tw.gravity(model, q), [28.40331262, -37.64094817, -5.4415892], 7)
    tip = scale * (tw.frame_jacobian(model, q, "tip").T @ np.ones(6))
    printed(tip, [1.40954608, 1.85771497, 1.392409], 8)
    tau = scale * tw.rnea(model, q, v, a) + tip
    printed(tau, [74.69616155, -33.06766016, -3.23057314], 8)
    pushed = (np.array([0.5, 0.6, 0.7]) - tip) / scale
    printed(tw.aba(model, q, v, pushed) / scale, [-0.97392907, 25.58466784, -32.91499212], 8)


# ---------------------------------------------------------------- Robotics Toolbox (MIT licence): "from MATLAB"

QN = np.array([0, np.pi / 4, np.pi, 0, np.pi / 4, 0])


def test_puma_560_of_the_robotics_toolbox():
    model, ones = published.puma(), np.ones(6)
    gravity = [0, 31.6399, 6.0351, 0, 0.0283, 0]
    printed(tw.gravity(model, QN), gravity, 4)
    printed(tw.rnea(model, QN, 0 * ones, ones), [3.35311, 36.0025, 7.42596, 0.190043, 0.203441, 0.194133], 4)
    M = [
        [3.6594, -0.4044, 0.1006, -0.0025, 0, 0],
        [-0.4044, 4.4137, 0.3509, 0, 0.0024, 0],
        [0.1006, 0.3509, 0.9378, 0, 0.0015, 0],
        [-0.0025, 0, 0, 0.1925, 0, 0],
        [0, 0.0024, 0.0015, 0, 0.1713, 0],
        [0, 0, 0, 0, 0, 0.1941],
    ]
    printed(tw.crba(model, QN), M, 4)
    a = np.array([1.0, 2, 3, 1, 2, 3])
    printed(tw.crba(model, QN) @ a, [3.1500, 9.4805, 3.6189, 0.1901, 0.3519, 0.5823], 4)
    C = [
        [-0.1735, -2.0494, -0.1178, -0.0002, -0.0045, 0.0001],
        [0.6274, 1.1572, 1.9287, -0.0015, -0.0003, 0],
        [-0.3608, -0.7734, -0.0018, -0.0009, -0.0064, 0],
        [0.0011, 0.0005, -0.0001, 0.0002, 0.0002, -0.0001],
        [-0.0002, 0.0028, 0.0046, -0.0002, 0, 0],
        [0.0001, 0, 0, 0, 0, 0],
    ]
    printed(tw.coriolis_matrix(model, QN, a), C, 4)


def test_inertia_of_the_puma_at_its_hand():
    """The Toolbox's `cinertia`, rows (v, ω): Λ, by way of our factors of M."""
    expected = np.array([
        [17.2954, -2.7542, -9.6233, 0, 0.2795, 0],
        [-2.7542, 12.1909, 1.2459, -0.3254, -0.0703, -0.9652],
        [-9.6233, 1.2459, 13.3348, 0, 0.2767, 0],
        [0, -0.3254, 0, 0.1941, 0, 0.1941],
        [0.2795, -0.0703, 0.2767, 0, 0.1713, 0],
        [0, -0.9652, 0, 0.1941, 0, 0.5791],
    ])  # fmt: skip
    model = published.puma()
    J = tw.frame_jacobian(model, QN, "hand", "local_world_aligned")
    printed(tw.operational_space_inertia(model, QN, J[[3, 4, 5, 0, 1, 2]]), expected, 4)


# ---------------------------------------------------------------- Pinocchio (BSD licence): from RBDL

HUMANOID = {
    "000": (0, 0, 0, 4, """0 0 1281.84 0 -40.5132 0 4.4492 -1.5386 0 -1.5386 -1.5386 0 -4.4492 -1.5386 0 -1.5386 -1.5386
        0 -37.436 0 0 -2.548 0 0 0.392 0 0.392 0 -2.548 0 0 0.392 0 0.392 0"""),
    "0V0": (0, 0.1, 0, 5, """-48.10636 -73.218816 1384.901025 -7.2292939 -186.342371 -20.6685852 -0.78887946
        -1.869651075 1.8889752 -2.036768175 -2.105948175 -1.023232 -18.3738505 -4.133954895 9.0456456 -4.276615035
        -4.143427035
        -2.534896 -180.338765 15.71570676 -29.8639164 -59.917862 -2.3307916 -2.7648728 -45.76782776 3.4151272
        -18.4320456 -4.5768072 -76.60945104 -0.5897908 -2.640844 -63.93417064 5.359156 -25.8309196 -6.976116"""),
    "0VA": (0, 0.01, 0.1, 5, """-15.3331636 -0.67891816 1273.80521 102.9435113 110.3509945 81.52296995 13.31476408
        14.26606068 3.682505252 9.048274318 4.663303518 2.05308568 12.54347834 25.92680911 6.327105656 16.71123385
        8.96650473 3.54200704 70.15812475 77.02410963 73.81994844 41.73185754 28.75786872 28.94251127 31.65847724
        20.40431127 18.18579154 6.838471928 50.44193173 34.07362801 34.53507156 38.33983417 24.61507156 22.2842788
        8.23435884"""),
    "Q00": (0.1, 0, 0, 7, """0 0 1281.84 -133.3062501 198.975587 0 15.06850407 58.39287139 -22.14971864 17.14327289
        1.291543104 0.7402017048 -4.386231387 22.73949408 -19.01681794 0.8839600793 -0.3197599308 -0.466827706
        65.47086697 32.71449398 -4.250622066 -0.7937685568 -0.15349648 -1.070480752 -3.066302263 -0.3557903212
        -0.2183951073 0.182684221 -0.6648425468 -2.902772493 0.1250340934 0.4402877138 -0.3158584741 -0.0865162794
        0.3918733239"""),
    "QVA": (0.1, 0.01, 0.01, 6, """-1.911650826 1.250211406 1284.82058 -139.0188156 201.744449 1.554847332 15.1910084
        59.27339983 -21.70753738 17.84339797 1.754639468 0.670280632 -2.968778954 23.0776205 -17.56870284 1.765761886
        0.2889992363 -0.392159764 68.83598707 34.59002827 -4.604435817 -0.3832225891 1.085231916 -0.348635267
        -2.831371037 -1.047616506 -0.228384161 0.5656880079 1.302869049 0.8481280783 0.7042182131 1.554751317
        -0.3908790552 -0.1294643218 1.421077555"""),
}  # fmt: skip
"""How much q, v and a of joint i grow with i, the digits after the point that all entries have, and τ as printed."""


@pytest.mark.parametrize("name", HUMANOID)
def test_humanoid_of_pinocchio(name):
    if catalogue.example_robot_data_folder() is None:
        pytest.skip("example-robot-data is not installed: its humanoid is not checked")
    model = published.simple_humanoid()
    steps, (digits, expected) = HUMANOID[name][:3], HUMANOID[name][3:]
    count = np.arange(6, model.nv)
    q = np.r_[0, 0, 0, 0, 0, 0, 1, steps[0] * count]
    v, a = (np.r_[np.zeros(6), step * count] for step in steps[1:])
    tau = tw.rnea(model, q, v, a)
    printed(tau[[3, 4, 5, 0, 1, 2, *count]], [float(x) for x in expected.split()], digits)  # Pinocchio's base: (f, τ)


# ---------------------------------------------------------------- Drake, MotionGenesis (BSD licence)


def test_babyboot_of_motion_genesis():
    """Where it is after ten seconds and how it accelerates there; the energy that it began with is zero."""
    model = published.babyboot()
    q, v = np.radians([-61.312983340691, -929.47789677244]), np.array([-6.7440081040646, -2.7795690128833])
    qdd = tw.aba(model, q, v, [0, 0])
    np.testing.assert_allclose(qdd, [41.137023263571, 19.483647096003], rtol=1e-12)
    energy = tw.kinetic_energy(model, q, v) + tw.potential_energy(model, q)
    start = tw.potential_energy(model, np.radians([90, 1]))
    assert abs(energy - start) < 1e-12


@pytest.mark.slow
def test_babyboot_gets_there():
    model = published.babyboot()
    run = tw.simulate(model, np.radians([90.0, 1.0]), [0, 0], dt=1e-3, duration=10.0, method="rk4")
    # 8e-6 rad at this step, 1.4e-4 at twice the step: fourth order, towards the published angles
    assert np.abs(run.q[-1] - np.radians([-61.312983340691, -929.47789677244])).max() < 1e-5

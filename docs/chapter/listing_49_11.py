"""The listing of 49.11, mended: Go2 with Pinocchio, seven tests that pass, and the static equilibrium.

usage:  pip install pin example-robot-data
        python docs/chapter/listing_49_11.py [go2.urdf]

Pinocchio has the linear part first: (v, ω), (f, τ). The numbers in brackets are entries of ../errata.md, which
say what the chapter's listing has instead.
"""

import sys
from importlib.metadata import files
from time import perf_counter

import numpy as np
import pinocchio as pin

FEET = ["FL_foot", "FR_foot", "RL_foot", "RR_foot"]
STANDING = [0, 0.8, -1.5]  # hip, thigh and calf, rad: pin.neutral() is outside the limits [11]


def go2_urdf() -> str:
    """Return the path of the description that example-robot-data installs."""
    found = next(file for file in files("example-robot-data") or [] if file.name == "go2.urdf")
    return str(found.locate())


def contact_jacobian(model, data, q):
    """Return the linear rows of all feet, 12 × nv, in the axes of the world."""
    pin.computeJointJacobians(model, data, q)  # getFrameJacobian reads what this leaves in data [54]
    pin.updateFramePlacements(model, data)
    ids = [model.getFrameId(foot) for foot in FEET]
    rows = [pin.getFrameJacobian(model, data, i, pin.LOCAL_WORLD_ALIGNED)[:3] for i in ids]  # 0:3 are linear [53]
    return np.vstack(rows)


def errors(model, data, q, v, a, tau):
    """Return the largest error of each of the first six tests."""
    M = pin.crba(model, data, q).copy()  # symmetric already [35]
    h = pin.nonLinearEffects(model, data, q, v)  # rnea does not take 0 for a vector [55]
    found = {"1 rnea = M a + h": pin.rnea(model, data, q, v, a) - (M @ a + h)}
    found["2 aba = M⁻¹ (τ − h)"] = pin.aba(model, data, q, v, tau) - np.linalg.solve(M, tau - h)

    for i in (1, 3, 5):  # joints: 1 is the base with all that is welded to it [23]
        body = model.inertias[i]
        m, c = body.mass, pin.skew(body.lever)
        I = np.block([[m * np.eye(3), -m * c], [m * c, body.inertia - m * c @ c]])  # (v, ω) [22]
        found[f"3 inertia of body {i}"] = body.matrix() - I

    pin.forwardKinematics(model, data, q, v)
    for i in (1, 4, 7):
        R, p = data.oMi[i].rotation, data.oMi[i].translation
        X = np.block([[R, pin.skew(p) @ R], [np.zeros((3, 3)), R]])  # (v, ω) [13]
        found[f"4 transform of joint {i}"] = data.oMi[i].action - X

    h_G = pin.computeCentroidalMomentum(model, data, q, v).vector.copy()
    found["5 h_G = A_G v"] = h_G - pin.computeCentroidalMap(model, data, q) @ v
    pin.centerOfMass(model, data, q, v)
    found["6 linear momentum"] = h_G[:3] - pin.computeTotalMass(model) * data.vcom[0]  # 0:3 is linear [52]
    return {name: np.abs(error).max() for name, error in found.items()}


def equilibrium(model, data, q):
    """Return the forces of the ground on the feet, 4 × 3, and the torques of the motors."""
    g, J_c = pin.computeGeneralizedGravity(model, data, q), contact_jacobian(model, data, q)
    forces = np.linalg.lstsq(J_c[:, :6].T, g[:6])[0]  # the rows of the base have no torque of a motor [58]
    return forces.reshape(4, 3), (g - J_c.T @ forces)[6:]


def main() -> None:
    """Run the tests and print what they find."""
    model = pin.buildModelFromUrdf(*sys.argv[1:2] or [go2_urdf()], pin.JointModelFreeFlyer())
    data, rng = model.createData(), np.random.default_rng(49)
    stand = np.r_[pin.neutral(model)[:7], STANDING * 4]
    lower, upper = model.lowerPositionLimit.copy(), model.upperPositionLimit.copy()
    lower[:3], upper[:3] = -1, 1  # m: the limits of the base are infinite, and so would be q [43]
    q = pin.randomConfiguration(model, lower, upper)
    v, a, tau = rng.standard_normal((3, model.nv))
    tau[:6] = 0  # no motor acts on the base

    print(f"nq = {model.nq}, nv = {model.nv}, mass = {pin.computeTotalMass(model):.3f} kg")
    for name, error in errors(model, data, q, v, a, tau).items():
        print(f"{name:24} {error:.1e}")
        assert error < 1e-10, name
    rank = np.linalg.matrix_rank(contact_jacobian(model, data, stand))
    print(f"{'7 rank of J_c':24} {rank}")
    assert rank == 12

    forces, torques = equilibrium(model, data, stand)
    print(f"feet carry {forces[:, 2].round(1)} N, motors need at most {np.abs(torques).max():.1f} N m")
    assert np.isclose(forces[:, 2].sum(), 9.81 * pin.computeTotalMass(model))

    calls = {"RNEA": lambda: pin.rnea(model, data, q, v, a), "ABA": lambda: pin.aba(model, data, q, v, tau)}
    calls["CRBA"] = lambda: pin.crba(model, data, q)
    for name, call in calls.items():
        start = perf_counter()
        for _ in range(10000):
            call()
        print(f"{name}: {(perf_counter() - start) * 100:.1f} µs")  # of 10000 calls, in µs each


if __name__ == "__main__":
    main()

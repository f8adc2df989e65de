"""Every quantity of the package beside its 50-digit truth and beside Pinocchio, and what counts as equal.

Equal is relative to the largest entry of the array. Where a quantity is a sum whose terms may cancel (a
Coriolis matrix of a joint that has none, a potential energy next to zero), it is relative to the terms.
"""

from __future__ import annotations

import mpmath
import numpy as np

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as slow

from .strategies import REFERENCES, Recipe, State

mpmath.mp.dps = 50

ULPS = 250
"""Allowed error in units of the number type's resolution: 6e-14 in double precision, 3e-5 in single, 3e-17 in
80 bits. The worst seen over trees of up to 40 bodies is 26."""

SKEEL = 20
"""Factor of the bound of forward dynamics; the worst seen is 1.4."""


def textbook(model, s: State, frame: str) -> dict[str, np.ndarray]:
    """All quantities by the textbook algorithms."""
    q, v, a, tau, f = s
    kin = tw.forward_kinematics(model, q, v, a)
    at = tw.frame_placement(model, q, frame)
    return {
        "rotation": np.stack([T.rotation for T in kin.placement], axis=-3),
        "translation": np.stack([T.translation for T in kin.placement], axis=-2),
        "twist": kin.twist,
        "acceleration": kin.acceleration,
        "frame rotation": at.rotation,
        "frame translation": at.translation,
        "rnea": tw.rnea(model, q, v, a),
        "rnea f_ext": tw.rnea(model, q, v, a, f),
        "joint wrenches": tw.joint_wrenches(model, q, v, a, f),
        "h": tw.nonlinear_effects(model, q, v),
        "g": tw.gravity(model, q),
        "aba": tw.aba(model, q, v, tau),
        "aba f_ext": tw.aba(model, q, v, tau, f),
        "M": tw.crba(model, q),
        "C": tw.coriolis_matrix(model, q, v),
        "com": tw.center_of_mass(model, q),
        "A_G": tw.centroidal_map(model, q),
        "h_G": tw.centroidal_momentum(model, q, v),
        "dh_G": tw.centroidal_momentum_rate(model, q, v, a),
        "T": tw.kinetic_energy(model, q, v),
        "U": tw.potential_energy(model, q),
        **{f"J {r}": tw.frame_jacobian(model, q, frame, r) for r in REFERENCES},
        **{f"dJ v {r}": tw.frame_bias_acceleration(model, q, v, frame, r) for r in REFERENCES},
    }


def truth(model, s: State, frame: str) -> dict[str, np.ndarray]:
    """The same quantities with 3-D vectors in 50 digits."""
    q, v, a, tau, f = (slow.as_mpmath(x) for x in s)
    rotation, translation = slow.placements(model, q)
    frame_rotation, frame_translation = slow.frame_placement(model, q, frame)
    return {
        "rotation": rotation,
        "translation": translation,
        "twist": slow.body_twists(model, q, v),
        "acceleration": slow.body_accelerations(model, q, v, a),
        "frame rotation": frame_rotation,
        "frame translation": frame_translation,
        "rnea": slow.inverse_dynamics(model, q, v, a),
        "rnea f_ext": slow.inverse_dynamics(model, q, v, a, f),
        "joint wrenches": slow.joint_wrenches(model, q, v, a, f),
        "h": slow.nonlinear_effects(model, q, v),
        "g": slow.gravity(model, q),
        "aba": slow.forward_dynamics(model, q, v, tau),
        "aba f_ext": slow.forward_dynamics(model, q, v, tau, f),
        "M": slow.mass_matrix(model, q),
        "C": slow.coriolis_matrix(model, q, v),
        "com": slow.center_of_mass(model, q),
        "A_G": slow.centroidal_map(model, q),
        "h_G": slow.centroidal_momentum(model, q, v),
        "dh_G": slow.centroidal_momentum_rate(model, q, v, a),
        "T": slow.kinetic_energy(model, q, v),
        "U": slow.potential_energy(model, q),
        **{f"J {r}": slow.frame_jacobian(model, q, frame, r) for r in REFERENCES},
        **{f"dJ v {r}": slow.frame_bias_acceleration(model, q, v, frame, r) for r in REFERENCES},
    }


def pinocchio(pin, model, s: State, frame: str) -> dict[str, np.ndarray]:
    """The same quantities by Pinocchio, in our order, where it has them."""
    there = bridge.to_pinocchio_model(model)
    data, at = there.createData(), there.getFrameId(frame)
    v, a, tau = (bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.a, s.tau))
    f_ext = bridge.to_pinocchio_f_ext(model, s.f_ext)

    def ours(x):
        return bridge.from_pinocchio_tangent(model, x)

    def columns(J):  # for nv = 1 Pinocchio's Python flattens a 6 × 1 matrix
        return bridge.from_pinocchio_jacobian(model, J.reshape(6, model.nv))

    def motions(list_of_motions):
        return np.stack([bridge.from_pinocchio_motion(m) for m in list_of_motions])

    def forward(*f):  # Pinocchio's aba loses up to eight digits on a row of ball joints: one step of refinement
        a = pin.aba(there, data, s.q, v, tau, *f)
        return ours(a + np.linalg.solve(pin.crba(there, data, s.q), tau - pin.rnea(there, data, s.q, v, a, *f)))

    out = {
        "rnea": ours(pin.rnea(there, data, s.q, v, a)),
        "rnea f_ext": ours(pin.rnea(there, data, s.q, v, a, f_ext)),
        "joint wrenches": np.stack([bridge.from_pinocchio_force(f) for f in data.f])[
            1:
        ],  # it has no row for the ground
        "h": ours(pin.nonLinearEffects(there, data, s.q, v)),
        "g": ours(pin.computeGeneralizedGravity(there, data, s.q)),
        "aba": forward(),
        "aba f_ext": forward(f_ext),
        "M": bridge.from_pinocchio_matrix(model, pin.crba(there, data, s.q)),
        "C": bridge.from_pinocchio_matrix(model, pin.computeCoriolisMatrix(there, data, s.q, v)),
        "A_G": columns(pin.computeCentroidalMap(there, data, s.q)),
        "h_G": bridge.from_pinocchio_force(pin.computeCentroidalMomentum(there, data, s.q, v)),
        "dh_G": bridge.from_pinocchio_force(pin.computeCentroidalMomentumTimeVariation(there, data, s.q, v, a)),
        "com": pin.centerOfMass(there, data, s.q).copy(),
        "U": np.array(pin.computePotentialEnergy(there, data, s.q)),
    }
    pin.forwardKinematics(there, data, s.q, v, a)
    pin.computeJointJacobians(there, data, s.q)
    pin.updateFramePlacements(there, data)
    out |= {
        "rotation": np.stack([T.rotation for T in data.oMi]),
        "translation": np.stack([T.translation for T in data.oMi]),
        "twist": motions(data.v),
        "acceleration": motions(data.a),
        "frame rotation": data.oMf[at].rotation.copy(),
        "frame translation": data.oMf[at].translation.copy(),
    }
    for r in REFERENCES:
        out[f"J {r}"] = columns(pin.getFrameJacobian(there, data, at, getattr(pin, r.upper())))
    pin.forwardKinematics(there, data, s.q, v, 0 * a)
    pin.updateFramePlacements(there, data)
    for r in REFERENCES:
        get = pin.getFrameClassicalAcceleration if r == "local_world_aligned" else pin.getFrameAcceleration
        out[f"dJ v {r}"] = bridge.from_pinocchio_motion(get(there, data, at, getattr(pin, r.upper())))
    # Pinocchio 4.1 counts the rotors in T, except that of a revolute joint about an oblique axis: ask without.
    there.armature = 0 * there.armature
    out["T"] = pin.computeKineticEnergy(there, data, s.q, v) + (model.armature * s.v**2).sum() / 2
    return out


def double(x) -> np.ndarray:
    """Round to double precision, complex where it is."""
    x = np.asarray(x)
    return x.astype(complex if any(isinstance(y, mpmath.mpc) for y in x.flat) else float) if x.dtype == object else x


def largest(x) -> float:
    return float(np.abs(double(x)).max(initial=0))


def scale(name: str, model, s: State, true: dict[str, np.ndarray]) -> float:
    """The size of a quantity, or of the terms whose sum it is."""
    v, weight = largest(s.v), model.mass * float(np.sqrt((model.gravity**2).sum()))
    terms = {
        "com": largest(true["translation"]),
        "U": weight * largest(true["translation"]),
        "C": largest(true["M"]) * v,
        "g": weight,
        "h": weight + largest(true["M"]) * v**2,
        "dh_G": largest(true["h_G"]) * v,
        **{f"dJ v {r}": largest(true[f"J {r}"]) * v**2 for r in REFERENCES},
    }
    return max(largest(true[name]), terms.get(name, 0.0))


def skeel(M, a, tau, h) -> float:
    """How much of the relative precision forward dynamics loses at most in a state.

    The componentwise condition of M a = τ − h: ‖ |M⁻¹| (|M| |a| + |τ| + |h|) ‖ / ‖a‖. Raw cond(M) would
    say the same of a heavy root, which costs nothing.
    """
    inverse = np.abs(np.linalg.inv(double(M)))
    M, a, tau, h = (np.abs(double(x)).astype(float) for x in (M, a, tau, h))
    return float((inverse @ (M @ a + tau + h)).max() / a.max())


def assert_agree(model, s: State, got: dict, true: dict, *, dtype=None, against=None) -> None:
    """Every quantity that `true` has is right to the precision of its number type.

    `against` holds the sizes where `true` is not the truth itself.
    """
    sizes = true if against is None else against
    for name, right in true.items():
        ours = np.asarray(got[name])
        assert dtype is None or ours.dtype == dtype, f"{name}: {ours.dtype}"
        assert ours.shape == np.shape(right), f"{name}: shape {ours.shape}, expected {np.shape(right)}"
        difference = slow.as_mpmath(ours) - right if np.asarray(right).dtype == object else ours - right
        error = largest(np.asarray(difference))
        size, lost = scale(name, model, s, sizes), 1.0
        bound = ULPS * float(np.finfo(ours.dtype).eps)
        if name.startswith("aba"):
            pushed = double(sizes["rnea"]) - double(sizes["rnea f_ext"]) if name.endswith("f_ext") else 0
            lost = skeel(sizes["M"], sizes[name], s.tau, np.abs(double(sizes["h"])) + np.abs(pushed))
            bound = SKEEL * float(np.finfo(ours.dtype).eps) * lost
        assert error <= bound * size, (
            f"{name}: relative error {error / size if size else error:.3g} is above {bound:.3g}"
            + (f", the bound from a conditioning of {lost:.3g}" if lost != 1 else "")
        )


def check_against_the_truth(recipe: Recipe, dtype) -> None:
    """Every quantity of one state of a random tree is right, and of that number type."""
    model, s, frame = recipe.model, recipe.state(dtype=dtype), recipe.frame()
    assert_agree(model, s, textbook(model, s, frame), truth(model, s, frame), dtype=np.dtype(dtype))

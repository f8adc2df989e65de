"""Why a motion diverged: the joint that began, and the step that its feedback or its spin would have needed.

A policy with the gain kd on a joint whose apparent inertia is D makes of v, over a step, v (1 − dt kd / D): beyond
dt kd / D = 2 it changes its sign and grows. D = 1 / (M⁻¹)ⱼⱼ is what a motor feels of the robot when all other joints
give way, and for a light foot on a heavy leg it is the foot alone. With the gain kp and no kd the same happens beyond
dt √(kp / D) = 2. Joints whose gains are small enough one by one can be too much together: v grows along the eigenvector
of M⁻¹ kd with the largest eigenvalue λ, beyond dt λ = 2.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..algorithms.kinematics import forward_kinematics
from ..arrays import Array
from ..contact import constraint_jacobian
from ..fast import crba
from ..fast.steps import integrate
from ..model import joint_name_at
from .system import System

__all__ = ["divergence_cause"]

MAX_DAMPING_RATIO = {"rk4": 2.785, "variational": np.inf}
"""The largest dt kd / D at which a method is stable, on the real axis; 2 of all others."""

MAX_SWING_RATIO = 2.0
"""The largest dt √(kp / D), of the semi-implicit method; of the others it is of this size, or less."""

MAX_TURN_RAD = 1.0
"""rad: a body that turns further in one step is too fast for an explicit method."""

LARGE_CHANGE = 0.1
"""rad or m in a step: velocities that change by more are not those with which a divergence begins."""

MIN_SHARE = 0.05
"""Of an eigenvector's squares: a joint that has less is not named."""

PROBE_SIZE = 1e-4
"""rad, m, rad/s or m/s: how far apart states are at which a policy is asked for its gains."""


def divergence_cause(system: System, method: str, t0: float, states: Sequence[tuple[Array, Array]]) -> str:
    """Return a sentence on what began a divergence, empty where nothing of the kind is found.

    Parameters
    ----------
    system : System
    method : str
    t0 : float
        Time of the first state, s.
    states : sequence of (q, v)
        Until the step that failed.
    """
    size = np.abs(states[-1][1]).max(axis=-1, initial=0)
    item = tuple(int(i) for i in np.unravel_index(size.argmax(), size.shape))
    speeds = np.array([v[item] for _, v in states])
    k, entry = onset(speeds, system.dt)
    q, v = states[k]
    try:
        found = feedback_cause(system, method, t0 + k * system.dt, q, v, item)
    except Exception:  # M cannot be asked in such a state, or the policy, which may raise anything
        found = None
    if found is None:
        found = spin_cause(system, q[item], v[item])
    if found is None:
        return ""
    entry, reason = found
    name = joint_name_at(system.model, entry)
    return f"it began with joint {name!r}{alternating(speeds[k:, entry])}: {reason}"


def onset(speeds: Array, dt: float) -> tuple[int, int]:
    """Return the state after which changes of v grew or were large until the end, and the entry that changed most."""
    change = np.diff(speeds, axis=0)
    if not len(change):
        return 0, int(np.abs(speeds[0]).argmax())
    size = np.abs(change).max(axis=-1)
    k = len(size) - 1
    while k > 0 and (size[k - 1] < size[k] or dt * size[k - 1] > LARGE_CHANGE):
        k -= 1
    return k, int(np.abs(change[k]).argmax())


def alternating(v: Array) -> str:
    """Return what is to be said of a velocity that changes its direction in every step."""
    change = np.diff(v)
    return ", whose velocity alternates" if len(change) > 1 and (change[1:] * change[:-1] < 0).all() else ""


def feedback_cause(
    system: System, method: str, t: float, q: Array, v: Array, item: tuple[int, ...]
) -> tuple[int, str] | None:
    """Return the entry of v whose feedback needs the shortest step, and that step; None where dt is short enough."""
    kp, kd = gains(system, t, q, v, item)
    inverse = mobility(system, q[item])
    D = apparent_inertia(inverse)
    dt = system.dt * max(system.period, 1)
    limit = 2.0 if system.period else MAX_DAMPING_RATIO.get(method, 2.0)
    damped = dt * kd / D
    swung = dt * np.sqrt(np.maximum(kp, 0) / D)
    name = "dt_control" if system.period else "dt"
    j = int(damped.argmax())
    if damped[j] > limit:
        bound = f"{name} = {dt:.3g} s must be below {limit:.3g} D/kd = {limit * D[j] / kd[j]:.2g} s"
        unit = f"D = {D[j]:.2g}, the damping kd = {kd[j]:.3g}"
        instead = "time stepping needs no bound where kd is damping of the model"
        return j, f"its apparent inertia is {unit} (SI units), and {bound}; {instead}"
    j = int(swung.argmax())
    if swung[j] > MAX_SWING_RATIO and np.isfinite(limit):
        longest = MAX_SWING_RATIO * np.sqrt(D[j] / kp[j])
        bound = f"{name} = {dt:.3g} s must be below {MAX_SWING_RATIO:.3g} √(D/kp) = {longest:.2g} s"
        return j, f"its apparent inertia is D = {D[j]:.2g}, the stiffness kp = {kp[j]:.3g} (SI units), and {bound}"
    for what, k, power, bounded in (("kd", kd, 1.0, limit), ("kp", kp, 0.5, MAX_SWING_RATIO)):
        root = np.sqrt(np.maximum(k, 0))
        squares, shapes = np.linalg.eigh(root[:, None] * inverse * root)
        rate = float(squares[-1]) ** power
        if dt * rate > bounded and np.isfinite(limit):
            share = shapes[:, -1] ** 2
            j, *more = (int(i) for i in np.argsort(-share)[:3])
            named = [joint_name_at(system.model, i) for i in more if share[i] > MIN_SHARE]
            others = " and ".join(map(repr, named)) or "others"
            eigenvalue = f"λ = {squares[-1]:.3g} is the largest eigenvalue of M⁻¹ {what}, and {name} = {dt:.3g} s"
            longest = f"{bounded:.3g}/{'λ' if power == 1 else '√λ'} = {bounded / rate:.2g} s"
            return j, f"alone it would not, but with {others}: {eigenvalue} must be below {longest}"
    j = int(kd.argmin())
    if kd[j] < 0 and -kd[j] / D[j] * dt > PROBE_SIZE:
        return j, f"its τ grows with its own velocity, by {-kd[j]:.3g} (SI units): a sign in the policy?"
    return None


def gains(system: System, t: float, q: Array, v: Array, item: tuple[int, ...]) -> tuple[Array, Array]:
    """Return −∂τ/∂q and −∂τ/∂v of each joint on itself, shapes (nv,)."""
    kp, kd = np.zeros((2, system.model.nv))
    for j in range(system.model.nv):
        probe = np.zeros_like(v)
        entry = (*item, j)
        probe[entry] = PROBE_SIZE
        ahead, back = (system.policy_forces(t, integrate(system.model, q, sign * probe), v.copy()) for sign in (1, -1))
        kp[j] = (back - ahead)[entry] / (2 * PROBE_SIZE)
        ahead, back = (system.policy_forces(t, q.copy(), v + sign * probe) for sign in (1, -1))
        kd[j] = (back - ahead)[entry] / (2 * PROBE_SIZE)
    return kp, kd


def mobility(system: System, q: Array) -> Array:
    """Return M⁻¹, shape (nv, nv), with the contacts that stick."""
    inverse: Array = np.linalg.inv(crba(system.model, q).astype(np.float64))
    if system.contacts and system.stepping is None:
        J = constraint_jacobian(system.model, q, system.contacts)
        inverse = inverse - inverse @ J.mT @ np.linalg.pinv(J @ inverse @ J.mT) @ J @ inverse
    return inverse


def apparent_inertia(inverse: Array) -> Array:
    """Return D = 1 / (M⁻¹)ⱼⱼ, shape (nv,); ∞ where contacts leave no motion."""
    gives = np.diagonal(inverse)
    free = gives > 1e-9 * gives.max(initial=0)
    return np.where(free, 1 / np.where(free, gives, 1), np.inf)


def spin_cause(system: System, q: Array, v: Array) -> tuple[int, str] | None:
    """Return the joint whose body turns too far in a step for the gyroscopic torque to be integrated."""
    twists = np.asarray(forward_kinematics(system.model, q, v).twist)
    turn = system.dt * np.linalg.norm(twists[1:, :3], axis=-1)
    if not turn.max(initial=0) > MAX_TURN_RAD:
        return None
    body = 1 + int(turn.argmax())
    reason = f"its body turns by dt |ω| = {turn.max():.3g} rad in a step, and must stay well below 1"
    return system.model.v_slice[body].start, reason

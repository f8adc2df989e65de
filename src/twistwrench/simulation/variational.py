"""A Lie-group method that keeps the structure of mechanics: a discrete principle of least action.

Of all motions between two configurations the true one makes the action ∫ L dt stationary. Here the action itself is
made discrete, and not the equation that follows from it: over a step, L is taken at the middle, at the constant
velocity ξ that leads from one end to the other, in the axes of the beginning (`straight`),

    q₁ = q₀ ⊕ h ξ,        m = q₀ ⊕ ½ h ξ,        S(q₀, q₁) = h L(m, ξ).

Two laws of mechanics then hold for any h. Where moving or turning the whole robot in the world changes nothing, the
momentum that belongs to it is kept to rounding: of a robot that floats freely without gravity the linear momentum and
the angular one about the world's origin; with gravity the horizontal one and the one about the vertical. And the flow
is symplectic, so that the energy swings about its value and does not drift away, however long the motion. The price is
an equation to solve in each step.

Over a step that turns by φ, R = exp [φ]×. A momentum p that is seen from its beginning is Rᵀ p seen from its end, and
dexp_φ = 1 + ½ [φ]× + 1/6 [φ]×² + … says how exp φ moves with φ (49.2, 49.3). For joints about one axis, and for what
slides in axes that stand still, both are 1.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array, resolution
from ..contact.forward import largest
from ..fast import aba, crba
from ..fast.programs import cached_program
from ..fast.quantities import Quantity
from ..model import GroupJoint, Model, joint_name_at, tree_terms
from ..model.tree import join, split
from ..spatial import cross_force, cross_motion
from ..spatial._quaternions import exp_quaternion
from ..spatial.exponential import shift
from ..spatial.rotation import cross_matrix, quaternion_matrix
from .divergence import DivergenceError, check_divergence, check_turn
from .straight import go_straight, in_turned_axes, shifted_and_turned, sliding, turned, turning
from .system import System

__all__ = ["bracket", "middle", "momenta", "momentum_and_force", "variational"]

MAX_ITERATIONS = 50
CONVERGED_ROUNDINGS = 50
"""Times the rounding: from there one more iteration reaches the last digit."""


def momentum_and_force(model: Model, q: Array, v: Array) -> tuple[Array, Array]:
    """Return μ = ∂L/∂v = M v and the force ∂L/∂q of a checked state, both (..., nv), without M, in O(N).

    μᵢ = Sᵢᵀ hᵢ, where hᵢ is the momentum of the subtree outboard of joint i. When the joint moves by δ, the subtree is
    moved by S δ while its carrier still moves it with the twist C: the energy changes by −δ Sᵀ (C ×* h), and by Sᵀ w δ,
    where w is the subtree's weight.
    """
    tree = tree_terms(model, q)
    qd = split(model, v)
    n = model.nbodies
    armature = model.constants(q.dtype).armature
    V, A, carrier, h, w, mu, force = ([np.zeros(6, q.dtype)] * n for _ in range(7))
    A[0], mu[0], force[0] = -model.constants(q.dtype).gravity, v[..., :0], v[..., :0]  # the world rises
    for i in tree.outward:
        carrier[i], A[i] = np.matvec(tree.X[i], V[tree.parent[i]]), np.matvec(tree.X[i], A[tree.parent[i]])
        V[i] = carrier[i] + np.matvec(tree.S[i], qd[i])
        h[i], w[i] = np.matvec(tree.I[i], V[i]), -np.matvec(tree.I[i], A[i])
    for i in tree.inward:
        p, S = tree.parent[i], tree.S[i].mT
        mu[i] = np.matvec(S, h[i])
        force[i] = np.matvec(S, w[i] - np.matvec(cross_force(carrier[i]), h[i]))
        h[p], w[p] = h[p] + np.matvec(tree.X[i].mT, h[i]), w[p] + np.matvec(tree.X[i].mT, w[i])
    rotor = armature * v  # as `rnea` has it: it adds to M and to nothing else, so what it would turn is taken away
    return join(mu) + rotor, join(force) - np.matvec(bracket(model, v).mT, rotor)


def variational(system: System, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """Make one step: find the ξ at which the momenta at both ends agree with the one in the middle.

    J. E. Marsden and M. West, Discrete mechanics and variational integrators, 2001, for a Lie group. The step is
    solved by Broyden's method, starting from M⁻¹: some four to twelve evaluations, each O(N).
    """
    M = crba(system.model, q)
    model = system.model
    dt = q.dtype.type(system.dt)
    equation = Equation(system, t, q, np.matvec(M, v))
    fall = aba(model, q, v, np.zeros_like(v))  # also raises where there is no inertia
    xi = v + dt / 2 * (fall + turning(model, v))
    check_turn(model, dt * xi)
    inverse = np.linalg.inv(M.astype(np.float64))
    done = np.zeros(v.shape[:-1], bool)
    defect, end, close = equation.defect(xi)
    for _ in range(MAX_ITERATIONS):
        change = np.where(done[..., None], 0, -np.matvec(inverse, defect)).astype(v.dtype)
        xi = xi + change
        done = done | close
        before = defect
        defect, end, close = equation.defect(xi)
        if done.all():
            check_turn(model, dt * xi)
            q1 = go_straight(model, q, dt * xi)
            return q1, solve(crba(model, q1), end)
        inverse = broyden(inverse, change, defect - before)
    raise unsolved(model, np.where(close[..., None], 0, defect))


def middle(model: Model, q: Array, u: Array, xi: Array) -> tuple[Array, Array, Array, Array]:
    """Return where a way u leads to from q, v there, and μ and ∂L/∂q there, for a velocity ξ in the axes of q.

    μ and the force are in the axes of q, too. There the velocity of what slides stays while it turns by δ, so that the
    one in its own axes changes by −δ × v, and L by −δ · (v × p).

    Returns
    -------
    tuple of ndarray, shapes (..., nq) and three times (..., nv)
    """

    def terms(q: Array, u: Array, xi: Array) -> tuple[Array, list[object]]:
        there, v = shifted_and_turned(model, q, u), turned(model, xi, u)
        mu, force = momentum_and_force(model, there, v)
        for _, joint, s in sliding(model):
            S = joint.subspace(u.dtype)
            along, p = np.matvec(S[3:], v[..., s]), np.matvec(S[3:], mu[..., s])
            force[..., s] -= np.matvec(S.mT[:, :3], np.matvec(cross_matrix(along), p))
        return np.concatenate([there, v, turned(model, mu, -u), turned(model, force, -u)], axis=-1), []

    asked = Quantity("middle", ("q", "v", "a"), terms)
    found = cached_program(model, ("middle", u.dtype), u.dtype, lambda: [asked], single=True)(q, u, xi)
    there, v, mu, force = np.split(found, model.nq + model.nv * np.arange(3), axis=-1)
    return there, v, mu, force


class Equation:
    """The equation of one step from q, with the momentum p₀ = M(q) v there.

    Momenta of what turns are seen from the middle: P₀ = Ad(exp ½u)ᵀ p₀ and P₁ = P₀ + h f, with u = h ξ and
    f = ∂L/∂q + τ at the middle. Then ξ must be such that

        μ = ½ (dexp(−½u)ᵀ P₀ + dexp(½u)ᵀ P₁),    and at the end    p₁ = Ad(exp ½u)ᵀ P₁.

    For what slides, and for joints about one axis, dexp = Ad = 1, so that μ = ½ (p₀ + p₁) and p₁ = p₀ + h f.
    """

    def __init__(self, system: System, t: float, q: Array, p0: Array) -> None:
        self.system, self.q, self.p0 = system, q, p0
        self.t = t + system.dt / 2
        self.dt = q.dtype.type(system.dt)
        self.weight = system.model.mass * float(np.abs(system.model.gravity).max())

    def defect(self, xi: Array) -> tuple[Array, Array, Array]:
        """Return the residual of ξ, the momentum p₁ it leads to, and whether the residual is only rounding."""
        model = self.system.model
        dt = self.dt
        check_divergence(model, "v", xi, dt=self.system.dt)
        u = dt / 2 * xi
        there, v, mu, force = middle(model, self.q, u, xi)
        tau = self.system.force(self.t, there, v)
        if tau.any():
            tau = in_turned_axes(model, tau, -u)
        between, end = momenta(model, u, self.p0, dt * (force + tau))
        defect = mu - between
        size = largest(self.p0) + largest(mu) + dt * (largest(force) + largest(tau) + self.weight)
        return defect, end, largest(defect) <= CONVERGED_ROUNDINGS * resolution(xi.dtype) * size


def broyden(inverse: Array, x: Array, y: Array) -> Array:
    """Return the inverse Jacobian, changed as little as makes it lead from y to x (Sherman and Morrison)."""
    Hy, xH = np.matvec(inverse, y), np.matvec(inverse.mT, x)
    size = (x * Hy).sum(axis=-1)[..., None, None]
    changed: Array = inverse + (x - Hy)[..., :, None] * xH[..., None, :] / np.where(size == 0, 1, size)
    return changed


def solve(M: Array, p: Array) -> Array:
    """Return M⁻¹ p, refined to the digits of the number type."""
    M64 = M.astype(np.float64)
    x = np.zeros_like(p)
    for _ in range(3):
        rest = (p - np.matvec(M, x)).astype(np.float64)
        x = x + np.linalg.solve(M64, rest[..., None])[..., 0].astype(p.dtype)
    return x


def unsolved(model: Model, defect: Array) -> DivergenceError:
    """Return the error that names the joint in which a step was not solved."""
    entry = int(np.abs(defect).reshape(-1, model.nv).max(axis=0).argmax())
    return DivergenceError(
        f"the step was not solved in {MAX_ITERATIONS} iterations, least of all for joint "
        f"{joint_name_at(model, entry)!r}; a smaller dt or weaker forces?"
    )


def bracket(model: Model, u: Array) -> Array:
    """Return the matrix ad_u with ad_u w = [u, w] on the whole tree, shape (..., nv, nv); 0 where joints commute.

    Of each joint the twists are S u and S w, and [u, w] is what S makes into S u × S w (49.5).
    """
    ad = np.zeros((*u.shape, model.nv), u.dtype)
    for joint, S, s in zip(model.joints, model.constants(u.dtype).S, model.v_slice):
        if joint is not None and joint.nv > 1:
            ad[..., s, s] = S.mT @ cross_motion(np.matvec(S, u[..., s])) @ S
    return ad


def momenta(model: Model, u: Array, p0: Array, impulse: Array) -> tuple[Array, Array]:
    """Return what μ must be in the middle of a step 2 u, and the momentum at its end, both (..., nv).

    P₀ = Rᵀ p₀ and P₁ = P₀ + impulse are seen from the middle; μ = ½ (dexp(−u)ᵀ P₀ + dexp(u)ᵀ P₁) and p₁ = Rᵀ P₁.
    What slides has its p₀ and its impulse in the axes of the beginning, and its p₁ in those of the end.
    """

    def both(u: Array, p0: Array, impulse: Array) -> tuple[Array, list[object]]:
        mu = p0 + impulse / 2
        end = p0 + impulse
        for joint, s in zip(model.joints, model.v_slice):
            if isinstance(joint, GroupJoint) and joint.nv > 1:
                S = joint.subspace(u.dtype)
                turn = S[:3]
                slide = S[3:]
                phi = np.matvec(turn, u[..., s])
                back = quaternion_matrix(exp_quaternion(phi)).mT
                P0 = np.matvec(back, np.matvec(turn, p0[..., s]))
                P1 = P0 + np.matvec(turn, impulse[..., s])
                mean = (dexp_transposed(-phi, P0) + dexp_transposed(phi, P1)) / 2
                along = np.matvec(slide, mu[..., s]), np.matvec(back @ back, np.matvec(slide, end[..., s]))
                mu[..., s] = np.matvec(turn.mT, mean) + np.matvec(slide.mT, along[0])
                end[..., s] = np.matvec(turn.mT, np.matvec(back, P1)) + np.matvec(slide.mT, along[1])
        return np.concatenate([mu, end], axis=-1), []

    asked = Quantity("momenta", ("v", "a", "tau"), both)
    found = cached_program(model, ("momenta", u.dtype), u.dtype, lambda: [asked], single=True)(u, p0, impulse)
    return found[..., : model.nv], found[..., model.nv :]


def dexp_transposed(phi: Array, p: Array) -> Array:
    """Return dexp_φᵀ p = Σ (−[φ]×)ᵏ p / (k + 1)!, shape (..., 3): the way of a velocity p that turns by −φ."""
    return shift(np.concatenate([-phi, p], axis=-1))

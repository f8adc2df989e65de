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
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array, resolution
from ..fast import aba, crba
from ..fast.programs import remembered
from ..fast.quantities import Quantity
from ..model import Model, tree_terms
from ..model.tree import join, split
from ..spatial import cross_force
from ..spatial.rotation import cross_matrix
from .divergence import DivergenceError, refuse_divergence, refuse_whole_turn
from .straight import go_straight, in_turned_axes, shifted_and_turned, sliding, turned, turning, watched
from .system import System
from .tangent import bracket, momenta

__all__ = ["middle", "momentum_and_force", "variational"]

ITERATIONS = 50
CLOSE = 50
"""Times the rounding: from there one more iteration reaches the last digit."""


def momentum_and_force(model: Model, q: Array, v: Array) -> tuple[Array, Array]:
    """Return μ = ∂L/∂v = M v and the force ∂L/∂q of a checked state, both (..., nv), without M, in O(N).

    μᵢ = Sᵢᵀ hᵢ, where hᵢ is the momentum of the subtree outboard of joint i. When the joint moves by δ, the subtree is
    moved by S δ while its carrier still moves it with the twist C: the energy changes by −δ Sᵀ (C ×* h), and by Sᵀ w δ,
    where w is the subtree's weight.
    """
    tree, qd, n = tree_terms(model, q), split(model, v), model.nbodies
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
    M, model, dt = crba(system.model, q), system.model, q.dtype.type(system.dt)
    equation = Equation(system, t, q, np.matvec(M, v))
    fall = aba(model, q, v, np.zeros_like(v))  # also raises where there is no inertia
    xi = v + dt / 2 * (fall + turning(model, v))
    refuse_whole_turn(model, dt * xi)
    inverse, done = np.linalg.inv(M.astype(np.float64)), np.zeros(v.shape[:-1], bool)
    defect, end, close = equation.defect(xi)
    for _ in range(ITERATIONS):
        change = np.where(done[..., None], 0, -np.matvec(inverse, defect)).astype(v.dtype)
        xi, done, before = xi + change, done | close, defect
        defect, end, close = equation.defect(xi)
        if done.all():
            refuse_whole_turn(model, dt * xi)
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
        return np.concatenate([there, v, turned(model, mu, -u), turned(model, force, -u)], axis=-1), watched(model, u)

    asked = Quantity("middle", ("q", "v", "a"), terms)
    found = remembered(model, ("middle", u.dtype), u.dtype, lambda: [asked], single=True)(q, u, xi)
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
        self.t, self.dt = t + system.dt / 2, q.dtype.type(system.dt)
        self.weight = system.model.mass * float(np.abs(system.model.gravity).max())

    def defect(self, xi: Array) -> tuple[Array, Array, Array]:
        """Return the residual of ξ, the momentum p₁ it leads to, and whether the residual is only rounding."""
        model, dt = self.system.model, self.dt
        refuse_divergence(model, "v", xi, dt=self.system.dt)
        u = dt / 2 * xi
        there, v, mu, force = middle(model, self.q, u, xi)
        tau = self.system.force(self.t, there, v)
        if tau.any():
            tau = in_turned_axes(model, tau, -u)
        between, end = momenta(model, u, self.p0, dt * (force + tau))
        defect = mu - between
        size = largest(self.p0) + largest(mu) + dt * (largest(force) + largest(tau) + self.weight)
        return defect, end, largest(defect) <= CLOSE * resolution(xi.dtype) * size


def largest(x: Array) -> Array:
    """Return the largest magnitude over the last axis."""
    return np.asarray(np.abs(x).max(axis=-1, initial=0))


def broyden(inverse: Array, x: Array, y: Array) -> Array:
    """Return the inverse Jacobian, changed as little as makes it lead from y to x (Sherman and Morrison)."""
    Hy, xH = np.matvec(inverse, y), np.matvec(inverse.mT, x)
    size = (x * Hy).sum(axis=-1)[..., None, None]
    changed: Array = inverse + (x - Hy)[..., :, None] * xH[..., None, :] / np.where(size == 0, 1, size)
    return changed


def solve(M: Array, p: Array) -> Array:
    """Return M⁻¹ p, refined to the digits of the number type."""
    M64, x = M.astype(np.float64), np.zeros_like(p)
    for _ in range(3):
        rest = (p - np.matvec(M, x)).astype(np.float64)
        x = x + np.linalg.solve(M64, rest[..., None])[..., 0].astype(p.dtype)
    return x


def unsolved(model: Model, defect: Array) -> DivergenceError:
    """Return the error that names the joint in which a step was not solved."""
    entry = int(np.abs(defect).reshape(-1, model.nv).max(axis=0).argmax())
    joint = next(i for i, s in enumerate(model.v_slice) if s.start <= entry < s.stop)
    return DivergenceError(
        f"the step was not solved in {ITERATIONS} iterations, least of all for joint {model.joint_names[joint]!r}; "
        "a smaller dt or weaker forces?"
    )

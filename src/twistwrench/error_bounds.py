"""How many digits the dynamics keep at a configuration, estimated before they are computed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from html import escape
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .algorithms._mimic import also_of_mimics
from .algorithms.aba import aba
from .algorithms.kinematics import forward_kinematics
from .arrays import Array, resolution
from .errors import SingularError
from .model import Model, check_model, columns, composite_inertias, floats_of, joint_name_at, tree_terms

__all__ = ["Accuracy", "Loss", "accuracy"]

SUMMED, DIVIDED = 24, 4
"""Safety factors on the bare formulas, of inverse and of forward dynamics. Less would do for the textbook; with these
the errors of `twistwrench.fast` stay below too, in ``python -m benchmarks.study extremes`` and in random trees."""

CANCELLATION_FACTOR = 0.25
"""Safety factor on what is left of terms of q̈ that cancel."""

MIN_INDEPENDENCE = 0.1
"""Where the directions of one joint are less independent than this, eliminating them together costs digits besides."""

MIN_ENERGY_SHARE = 0.05
"""A joint with a smaller share of a motion's energy than this is not named."""

MAX_NAMED_JOINTS = 4
"""How many joints are named in print."""

AMPLE_INERTIA_SHARE = 1e-3
"""A motion with more than this part of the apparent inertia of its joints is not worth a warning."""

FREE_TERMS = 10
"""The terms of M_jj may be so many times as large as their sum before they cost digits."""

ILL_CONDITIONED = 1e8
"""A condition number of M above this makes people look for the loss of digits."""

NAMED_DIGITS, PART_DIGITS = 3, 1
"""Causes are named where so many digits are lost in all; of these each that costs so many."""

AS_DOUBLES = "q, v, tau = (np.asarray(x, float) for x in (q, v, tau))\n"
NORMALIZED = "q = model.normalize(q)\n"
IN_FLOAT64 = "qdd = tw.aba(model, q, v, tau)"
IN_PAIRS = 'qdd = tw.compile(model, "aba", dtype="double-double")(q, v, tau).hi'
IN_MPMATH = """mpmath.mp.dps = 80
q, v, tau = (tw.newton_euler_3d.as_mpmath(x) for x in (q, v, tau))
qdd = tw.newton_euler_3d.forward_dynamics(model, q, v, tau).astype(float)"""


@dataclass(frozen=True)
class Loss:
    """Why digits are lost, and what to do: an entry of `Accuracy.losses` or `Accuracy.elsewhere`.

    Attributes
    ----------
    cause : str
        "weak motion", "dependent directions", "terms of M", "terms that cancel", "rounded tau", "no inertia"; elsewhere
        "sums in the world", "v × m v", "condition of M", "matrix of a far body".
    joints : tuple of str
        Where.
    digits : float
        How many are lost; infinite where none is certain.
    cure : str
        What to do, as a sentence.
    lines : str
        Lines of Python that do it: with np, mpmath, tw, model, q, v and tau they leave the answer in ``qdd``. Empty
        where no computation helps.
    """

    cause: str
    joints: tuple[str, ...]
    digits: float
    cure: str
    lines: str = ""

    def __str__(self) -> str:
        where = f" ({', '.join(self.joints[:MAX_NAMED_JOINTS])})" if self.joints else ""
        lost = f"{self.digits:.0f} digits" if np.isfinite(self.digits) else "all digits"
        return f"{self.cause}{where}, {lost}: {self.cure}"


@dataclass(frozen=True)
class Accuracy:
    """The relative errors that rounding may leave, estimated: what `accuracy` returns.

    Attributes
    ----------
    rnea : ndarray, shape (...)
        Of τ, each entry measured against the terms that it sums: over the outboard bodies, lever times force.
    aba, crba_solve : ndarray, shape (...)
        Of q̈, each entry weighed by √M_kk, measured against the largest of q̈, of q̈ without torques, and of their
        difference. Where no v was given, also against the terms of the bias forces, each divided by √M_kk: those of a
        wheel that spins may cancel, and leave no acceleration. Infinite where nothing is certain.
    apparent_inertia : ndarray, shape (...)
        Of the motion with the least, as a part of the apparent inertia of its joints one by one, the others locked.
    weak : tuple of str
        The joints of that motion, the most moved first; in a batch that of its worst state.
    resolution : float
        Of the number type that was asked about: 2.2e-16 in float64.
    losses : tuple of Loss
        Where three digits of q̈ or more are lost: the causes, with the joints and what to do; in a batch those of its
        worst state.
    elsewhere : tuple of Loss
        What costs nothing here, but three digits or more in other formulas and libraries, and what to do there.
    """

    rnea: Array
    aba: Array
    crba_solve: Array
    apparent_inertia: Array
    weak: tuple[str, ...]
    resolution: float
    losses: tuple[Loss, ...] = ()
    elsewhere: tuple[Loss, ...] = ()

    @property
    def felt(self) -> Array:
        """The older name of `apparent_inertia`."""
        return self.apparent_inertia

    @property
    def digits(self) -> dict[str, Array]:
        """Decimal digits that are certain, by algorithm; 0 where no digit is."""
        errors = {"rnea": self.rnea, "aba": self.aba, "crba_solve": self.crba_solve}
        return {name: np.maximum(-np.log10(np.minimum(error, 1.0)), 0.0) for name, error in errors.items()}

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"

    def __str__(self) -> str:
        """Return the estimate in words; of a batch, that of its worst state."""
        whole = int(-np.log10(self.resolution) + 0.5)
        sure = {name: f"{int(digits.min(initial=whole)) or 'none'}" for name, digits in self.digits.items()}
        kept = f"rnea keeps {sure['rnea']} of {whole} digits, aba {sure['aba']}, crba + solve {sure['crba_solve']}."
        causes = [f"Lost by {loss}" for loss in self.losses]
        others = [f"Elsewhere by {loss}" for loss in self.elsewhere]
        return "\n".join([kept, *self._weak_motion(), *causes, *others])

    def _weak_motion(self) -> list[str]:
        """Return the sentence on a motion with little inertia, if there is one."""
        least = float(self.apparent_inertia.min(initial=1))
        if least > AMPLE_INERTIA_SHARE:
            return []
        if len(self.weak) == 1:
            return [f"A motion of {self.weak[0]!r} has {least:.1e} of the apparent inertia of its parts one by one."]
        more = len(self.weak) - MAX_NAMED_JOINTS
        names = ", ".join(map(repr, self.weak[:MAX_NAMED_JOINTS])) + (f" and {more} more" if more > 0 else "")
        return [f"Moved against each other, {names} have {least:.1e} of their apparent inertias one by one."]


def accuracy(model: Model, q: ArrayLike, v: ArrayLike | None = None, tau: ArrayLike | None = None) -> Accuracy:
    """Estimate the rounding errors of `rnea`, of `aba` and of solving with M from `crba`.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
        The configuration, in the number type of the computation.
    v : array_like, shape (..., nv), optional
        The velocity. Without it the estimate is for any v, but for a q̈ that is as large as its terms: not for that of a
        wheel that spins fast, or of an arm that hangs at rest, whose terms cancel.
    tau : array_like, shape (..., nv), optional
        The joint forces, with v, which is zero unless given. Without them the estimate is for any τ.

    Returns
    -------
    Accuracy
        Relative errors, the digits that are left, why others are lost and what to do. Print it for sentences.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Inverse dynamics only adds. Its error grows with the square root of the number of joints from the base to the
    farthest tip. Forward dynamics divides by M. Its error is about the resolution of the number type divided by λ, the
    least eigenvalue of D^-½ M D^-½ with the diagonal D of M, plus the error of the bias forces. The condition number of
    M itself is misleading: different units or masses make it large, but they do not cause errors. For the worst
    torques, `aba` loses as many digits as a solver, and more where a ball joint carries a thin rod: it eliminates three
    directions together, of which one has little inertia. Where free or ball joints inside a tree carry bodies that
    differ by 1e8 and more, one error in fifty was above the estimate, by up to 40 times; elsewhere none was.

    Where the terms of M_jj are much larger than their sum, as of a body far out on an oblique axis, they cost digits.
    The error of the bias forces is relative to their terms, lever times force. Where v is given, it is compared with q̈,
    so that terms which cancel cost digits.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> print(tw.accuracy(model, model.standing()))
    rnea keeps 13 of 16 digits, aba 13, crba + solve 13.
    >>> model = tw.chain(6, mass_ratio=1e6)
    >>> print(tw.accuracy(model, np.full(6, 0.1)))
    rnea keeps 13 of 16 digits, aba 8, crba + solve 8.
    Moved against each other, 'rod_02', 'rod_03', 'rod_01' have ... of their apparent inertias one by one.
    Lost by weak motion (rod_02, rod_03, rod_01), 7 digits: a program in double-double keeps all 16:...

    A fan of an oblique axis turns at 10 000 rpm, and 0.1 mN m drive it:

    >>> n = np.array([1, 2, 2]) / 3
    >>> fan, disc = tw.Builder("fan"), tw.SpatialInertia(0.1, [0, 0, 0], 2e-5 * (np.eye(3) + np.outer(n, n)))
    >>> fan.link("disc", parent="base_link", joint=tw.Revolute(n), inertia=disc)
    >>> print(tw.accuracy(fan.build(), [0.3], [1047.0], [1e-4]))
    rnea keeps 14 of 16 digits, aba 9, crba + solve 9.
    Lost by terms that cancel (disc), 5 digits: a program in double-double keeps all 16:...
    """
    given, rates, torques = _state(model, q, v, tau)
    eps = resolution(given.dtype)
    depth = max([1, *(len(model.support(i)) for i in range(model.nbodies))])
    at = model.normalize(_double(given))
    M = _mass_matrix(model, at)
    scaled = _scaled(M)
    least, motion = _least_inertia(scaled)
    certain = least - model.nv * resolution(np.float64)  # as certain as the eigenvalue itself is
    sums = np.full(least.shape, SUMMED * eps * np.sqrt(depth))
    within = np.maximum(MIN_INDEPENDENCE / np.maximum(_least_of_joints(model, scaled), np.finfo(float).tiny), 1)
    terms = _terms_of_mass(model, at, np.diagonal(M, axis1=-2, axis2=-1))
    factor = within * np.maximum(terms.max(axis=-1, initial=1) / FREE_TERMS, 1)
    forward = sums + np.where(certain > 0, DIVIDED * eps * factor / np.where(certain > 0, certain, 1), np.inf)
    drives = None if torques is None else _double(torques)
    cancelled = np.zeros(least.shape)
    if rates is not None:
        cancelled = _cancelled(model, at, _double(rates), drives, certain)
        forward = forward + eps * cancelled
    known = Accuracy(sums, forward, forward.copy(), least, _most_moved(model, least, motion), eps)
    if not forward.size or model.nv == 0:
        return known
    worst = np.unravel_index(int(np.argmax(forward)), forward.shape)
    one = [None if x is None else np.broadcast_to(x, (*forward.shape, x.shape[-1]))[worst] for x in (at, rates, drives)]
    state = _State(model, one[0], None if one[1] is None else _double(one[1]), one[2])  # type: ignore[arg-type]
    tiny = np.finfo(float).tiny
    parts = {
        "weak motion": (1 / float(certain[worst]) if certain[worst] > 0 else np.inf, known.weak),
        "dependent directions": (float(within[worst]), _dependent(model, scaled[worst])),
        "terms of M": (float(terms[worst].max()) / FREE_TERMS, (joint_name_at(model, int(terms[worst].argmax())),)),
        "terms that cancel": (float(cancelled[worst]) * max(float(certain[worst]), tiny) / DIVIDED, state.cancelling()),
    }
    lost = float(np.log10(forward[worst] / ((SUMMED + DIVIDED) * eps)))
    return replace(
        known,
        losses=_losses(state, M[worst], parts, lost, float(forward[worst]), eps),
        elsewhere=_elsewhere(state, M[worst], float(least[worst])),
    )


def _state(
    model: Model, q: ArrayLike, v: ArrayLike | None, tau: ArrayLike | None
) -> tuple[Array, Array | None, Array | None]:
    """Check a state; v is zero where only torques are given."""
    check_model(model)
    given = {name: x for name, x in (("v", v), ("tau", tau)) if x is not None}
    if "tau" in given and v is None:
        given["v"] = np.zeros(model.nv, int)  # which affects no number type
    checked = dict(zip(("q", *given), floats_of(model, q, **given)))
    return checked["q"], checked.get("v"), checked.get("tau")


def _double(x: Array) -> Array:
    """Return real parts in double precision."""
    return x.real.astype(np.float64)


def _cancelled(model: Model, q: Array, v: Array, tau: Array | None, least: Array) -> Array:
    """Return the terms of q̈ as multiples of q̈, shape (...): infinite where no digit of q̈ is certain.

    An error of h becomes one of M⁻¹h. With entries weighed by √M_kk this is at most 1/λ times as large.
    """
    weight = np.sqrt(np.diagonal(_mass_matrix(model, q), axis1=-2, axis2=-1))
    terms = _bias_terms(model, q, v) / np.where(weight > 0, weight, 1)
    lost = CANCELLATION_FACTOR * terms.max(axis=-1, initial=0) / np.where(least > 0, least, 1)
    try:
        free = aba(model, q, v, np.zeros(model.nv))
        driven = free if tau is None else aba(model, q, v, tau)
    except SingularError:
        return np.where(lost > 0, np.inf, 0)
    sizes = [np.abs(weight * x).max(axis=-1, initial=0) for x in (free, driven, driven - free)]
    size = np.maximum.reduce(sizes) - resolution(np.float64) * lost  # of q̈, as far as it is certain itself
    return np.where(lost > 0, np.where(size > 0, lost / np.where(size > 0, size, 1), np.inf), 0)


def _bias_terms(model: Model, q: Array, v: Array) -> Array:
    """Return the size of the terms of each entry of h, shape (..., nv): RNEA with every vector replaced by its length.

    So nothing cancels but in the twists, whose sizes are those of their sums and of what the own joint adds.
    """
    tree, rates = tree_terms(model, q), columns(model, v)
    reach = [_length(T.translation) for T in tree.placement]  # from the parent's frame to the body's
    (V,), (nothing, falling) = tree.zeros(1), (np.zeros(tree.batch), np.full(tree.batch, _length(model.gravity)))
    force, moment, turning, moving = [nothing], [nothing], [nothing], [falling]  # the last two: terms of ω̇ and v̇
    for i in tree.outward:
        p = tree.parent[i]
        own = tree.S[i] @ rates[i]
        V[i] = tree.X[i] @ V[p] + own
        own_w = _length(own[..., :3, 0])
        own_v = _length(own[..., 3:, 0])
        w = _length(V[i][..., :3, 0]) + own_w
        u = _length(V[i][..., 3:, 0]) + own_v + reach[i] * _length(V[p][..., :3, 0])
        turning.append(turning[p] + w * own_w)
        moving.append(moving[p] + reach[i] * turning[p] + w * own_v + u * own_w)
        m = tree.I[i][5, 5]
        mc = np.linalg.norm(tree.I[i][:3, 3:])
        J = np.linalg.norm(tree.I[i][:3, :3])
        force.append(m * moving[i] + mc * turning[i] + w * (m * u + mc * w))
        moment.append(J * turning[i] + mc * moving[i] + w * (J * w + 2 * mc * u))
    h = np.zeros((*tree.batch, model.nv))
    for i in tree.inward:
        p, S = tree.parent[i], tree.S[i]
        turns = np.linalg.norm(S[:3], axis=0)
        slides = np.linalg.norm(S[3:], axis=0)
        h[..., model.v_slice[i]] = turns * moment[i][..., None] + slides * force[i][..., None]
        force[p] = force[p] + force[i]
        moment[p] = moment[p] + moment[i] + reach[i] * force[i]
    return h


def _length(x: Array) -> Array:
    """Return the lengths of vectors over the last axis."""
    return np.asarray(np.linalg.norm(x, axis=-1))


@also_of_mimics
def _mass_matrix(model: Model, q: Array) -> Array:
    """Return M.

    `crba` keeps the chapter's loop, which takes the wrench of one joint after the other inward. Here the wrenches of
    all outboard joints go inward in one product: on a chain of 1000 links that is 25 times as fast.
    """
    tree = tree_terms(model, q)
    IC, M = composite_inertias(tree), np.zeros((*tree.batch, model.nv, model.nv))
    F = [np.zeros((*tree.batch, 6, model.nv))] * model.nbodies  # a column for each joint, in frame i
    for i in tree.inward:
        p = tree.parent[i]
        own = model.v_slice[i]
        Fi = F[i].copy()
        Fi[..., own] = IC[i] @ tree.S[i]
        M[..., own, :] = tree.S[i].mT @ Fi  # of joint i and of those outboard, whose numbers are higher
        M[..., own, own] += tree.rotor[i]
        F[p] = F[p] + tree.X[i].mT @ Fi
    return np.triu(M) + np.triu(M, 1).mT


def _scaled(M: Array) -> Array:
    """Return D^-½ M D^-½: M in units in which each degree of freedom alone has the inertia 1."""
    own = np.diagonal(M, axis1=-2, axis2=-1)
    unit = np.sqrt(np.where(own > 0, own, 1))  # a motion without inertia keeps its zero
    return np.asarray(M / unit[..., :, None] / unit[..., None, :])


def _least_inertia(scaled: Array) -> tuple[Array, Array]:
    """Return the least eigenvalue of the scaled M, and its eigenvector, the motion that has it."""
    values, vectors = np.linalg.eigh(scaled)
    return np.maximum(values.min(axis=-1, initial=1), 0), vectors[..., :1].sum(axis=-1)


def _least_of_joints(model: Model, scaled: Array) -> Array:
    """Return the least eigenvalue of the blocks of joints with several directions that other joints carry."""
    blocks = [s for s, p in zip(model.v_slice, model.parent) if p > 0 and s.stop - s.start > 1]
    least = [np.linalg.eigvalsh(scaled[..., s, s])[..., 0] for s in blocks]
    return np.asarray(np.min([np.ones(scaled.shape[:-2]), *least], axis=0))


def _most_moved(model: Model, least: Array, motion: Array) -> tuple[str, ...]:
    """Return the names of the joints that take part in a motion, of the state with the least apparent inertia."""
    worst = motion.reshape(least.size, model.nv)[np.argmin(least)] if least.size else np.zeros(model.nv)
    shares = [float((worst[s] ** 2).sum()) for s in model.v_slice]
    order = np.argsort(shares)[::-1]
    return tuple(model.joint_names[i] for i in order if shares[i] > MIN_ENERGY_SHARE)


def _terms_of_mass(model: Model, q: Array, own: Array) -> Array:
    """Return how many times as large the terms of M_jj are as their sum, shape (..., nv).

    A body's mass, moment of mass and inertia are written about the origins of all frames on the way to the base, where
    the terms may cancel. Their squares add up: roundings are independent.
    """
    tree = tree_terms(model, q)
    IC = composite_inertias(tree)
    sizes = [_sizes(I) for I in tree.I]
    first, second = [x[1] for x in sizes], [x[2] for x in sizes]
    ratio = np.ones((*tree.batch, model.nv))
    for i in tree.inward:
        p, S = tree.parent[i], tree.S[i]
        mass, moment, _ = _sizes(IC[i])
        turn, slide = np.linalg.norm(S[:3], axis=0), np.linalg.norm(S[3:], axis=0)
        terms = turn**2 * second[i][..., None] + 2 * turn * slide * first[i][..., None] + slide**2 * mass[..., None]
        at = model.v_slice[i]
        ratio[..., at] = np.where(own[..., at] > 0, terms / np.where(own[..., at] > 0, own[..., at], 1), 1)
        reach = _length(tree.placement[i].translation)
        second[p] = _root(second[p], second[i], 2 * reach * first[i], 2 * reach * moment + mass * reach**2)
        first[p] = _root(first[p], first[i], mass * reach)
    return ratio


def _sizes(I: Array) -> tuple[Array, Array, Array]:
    """Return the mass, the size of the moment of mass, and the trace of the inertia of a 6 × 6 matrix."""
    moment = np.linalg.norm(I[..., :3, 3:], axis=(-2, -1)) / np.sqrt(2)
    return I[..., 5, 5], np.asarray(moment), np.trace(I[..., :3, :3], axis1=-2, axis2=-1)


def _root(*terms: Array) -> Array:
    """Return the root of a sum of squares that cannot overflow."""
    total = terms[0]
    for term in terms[1:]:
        total = np.hypot(total, term)
    return np.asarray(total)


def _dependent(model: Model, scaled: Array) -> tuple[str, ...]:
    """Return the joint whose own directions are least independent."""
    blocks = [i for i, s in enumerate(model.v_slice) if model.parent[i] > 0 and s.stop - s.start > 1]
    least = [float(np.linalg.eigvalsh(scaled[s, s])[0]) for s in (model.v_slice[i] for i in blocks)]
    return (model.joint_names[blocks[int(np.argmin(least))]],) if blocks else ()


class _State(NamedTuple):
    """One state in double precision; v and tau may be missing."""

    model: Model
    q: Array
    v: Array | None
    tau: Array | None

    def accelerations(self) -> tuple[Array, Array] | None:
        """Return q̈ without torques and with them; None where it is not determined."""
        rates = np.zeros(self.model.nv) if self.v is None else self.v
        try:
            free = aba(self.model, self.q, rates, np.zeros(self.model.nv))
            return free, free if self.tau is None else aba(self.model, self.q, rates, self.tau)
        except ValueError:
            return None

    def cancelling(self) -> tuple[str, ...]:
        """Return the joint with the largest terms of the bias force."""
        if self.v is None:
            return ()
        own = np.sqrt(np.maximum(np.diagonal(_mass_matrix(self.model, self.q)), np.finfo(float).tiny))
        return (joint_name_at(self.model, int(np.argmax(_bias_terms(self.model, self.q, self.v) / own))),)


def _losses(
    state: _State, M: Array, parts: dict[str, tuple[float, tuple[str, ...]]], lost: float, error: float, eps: float
) -> tuple[Loss, ...]:
    """Return the causes that cost digits, the largest first, each with the cure for all of them."""
    model, own = state.model, np.diagonal(M)
    idle = tuple(dict.fromkeys(joint_name_at(model, int(k)) for k in np.flatnonzero(own <= 0)))
    if idle:
        cure = "give the link a mass or the rotor an armature, or hold the joint: tw.lock_joints"
        return (Loss("no inertia", idle, np.inf, cure),)
    if lost < NAMED_DIGITS:
        return ()
    found = state.accelerations()
    cure, lines = _cure(found is not None, error, eps)
    lines = AS_DOUBLES + NORMALIZED * (eps > resolution(np.float64)) + lines
    digits = {name: float(np.log10(max(size, 1))) for name, (size, _) in parts.items()}
    named = [name for name in sorted(digits, key=lambda name: -digits[name]) if digits[name] >= PART_DIGITS]
    losses = [Loss(name, parts[name][1], digits[name], cure, lines) for name in named]
    if found is not None and state.tau is not None:
        weight = np.sqrt(own)
        size = max(float(np.abs(weight * x).max()) for x in (*found, found[1] - found[0]))
        reach = float((np.abs(np.linalg.inv(_scaled(M))) @ (np.abs(state.tau) / weight)).max())
        if size > 0 and reach > 10**NAMED_DIGITS * size:
            keep = "no number type helps where tau itself was rounded: keep the q̈ that it was computed from"
            losses.append(Loss("rounded tau", (), float(np.log10(reach / size)), keep))
    return tuple(losses)


def _cure(determined: bool, error: float, eps: float) -> tuple[str, str]:
    """Return what to do against all losses, and the lines that do it: the cheapest that returns all digits."""
    whole = int(-np.log10(eps) + 0.5)
    double = resolution(np.float64)
    if not determined:
        return "M is singular to the rounding of doubles; 80 digits of newton_euler_3d tell whether q̈ exists", IN_MPMATH
    if error * double / eps < eps:  # of a number type with fewer digits
        return f"float64 keeps all {whole}, at the same cost", IN_FLOAT64
    whole = min(whole, 16)
    return f'a program in double-double keeps all {whole}: tw.compile(model, "aba", dtype="double-double")', IN_PAIRS


def _elsewhere(state: _State, M: Array, least: float) -> tuple[Loss, ...]:
    """Return what costs digits in other formulas at this state, and none here."""
    model, own, found = state.model, np.diagonal(M), []
    tree = tree_terms(model, state.q)
    IC = composite_inertias(tree)
    placed = forward_kinematics(model, state.q).placement
    turning = [(i, k) for i in range(1, model.nbodies) for k in range(*model.v_slice[i].indices(model.nv))]
    sizes = [IC[i][5, 5] * (placed[i].translation ** 2).sum() / own[k] for i, k in turning if own[k] > 0]
    if sizes and max(sizes) > 10**NAMED_DIGITS:
        cure = "put the base at the origin for a library that sums there: M, h and A_G do not depend on its place"
        found.append(Loss("sums in the world", (), float(np.log10(max(sizes))), cure))
    if state.v is not None and model.base == "floating":
        terms = float(_bias_terms(model, state.q, state.v)[:3].max())
        excess = float(IC[1][5, 5] * (state.v[3:6] ** 2).sum())
        if excess > 10**NAMED_DIGITS * terms > 0:
            cure = "subtract the base's velocity V from v and add ω × V to its acceleration: τ is the same"
            found.append(Loss("v × m v", model.joint_names[1:2], float(np.log10(excess / terms)), cure))
    values = np.linalg.eigvalsh(M)
    if least > AMPLE_INERTIA_SHARE and values[0] > 0 and values[-1] > ILL_CONDITIONED * values[0]:
        cure = "change nothing: it comes from units and masses, and no digit of q̈ is lost"
        found.append(Loss("condition of M", (), float(np.log10(values[-1] / values[0])), cure))
    for name, I in zip(model.joint_names, model.inertia):
        moments = np.linalg.eigvalsh(I.inertia_at_com)
        excess = float(I.mass * (I.com**2).sum())
        if excess > 10**NAMED_DIGITS * moments[-1] > 0:
            cure = "keep the ten numbers: SpatialInertia.from_matrix cannot bring back that at the centre of mass"
            found.append(Loss("matrix of a far body", (name,), float(np.log10(excess / moments[-1])), cure))
    return tuple(found)

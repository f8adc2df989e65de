"""``twistwrench advise``: who needs which digits for what, and what they cost on this machine.

An error is worth a number of digits only to somebody. So each use has a function, a number type and a number of states
in a call; what it gives is measured: the error against the truth in 60 digits, in N m or in mm, and the time.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw

from . import newton_euler_3d as ne
from .arrays import Array
from .errors import check_known
from .fast.program import Results
from .model import Model
from .timing import duration, round_robin
from .validate.manifold import integrate

__all__ = ["NO_MPMATH", "USES", "Advice", "Use", "add_advise", "advise"]

NO_MPMATH = 'the truth needs mpmath: pip install "twistwrench[validate]"'

TRUTH_DIGITS = 60
"""More than any way has, so that each has an error to show."""

RANDOM_STATES = 1000
"""The number of random states; larger batches repeat them."""

CHECKED_STATES = 3
"""States at which the error is measured; the worst counts."""

MILLIMETRES = "mm after 1 s"
"""Where an error of an acceleration, if it stayed, would lead 1 m away from the joint: 500 mm for 1 rad/s²."""

MM_OF_ACCELERATION = 500.0


class Use(NamedTuple):
    """What somebody computes, and how exactly.

    Attributes
    ----------
    what : str
        In words.
    function : str
        The call, as it is written.
    make : callable
        From a model to the function of (q, v, u), where u is the acceleration or the torque.
    number : str
        float32, float64, or 50 digits.
    states : int
        In a call.
    truth : callable
        From a model and a state in 60 digits to the truth of what `make` returns first.
    unit : str
        Of the error.
    enough : str
        What is larger than this error.
    """

    what: str
    function: str
    make: Callable[[Model], Callable[[Array, Array, Array], Any]]
    number: str
    states: int
    truth: Callable[[Model, Array, Array, Array], Array]
    unit: str
    enough: str


class Advice(NamedTuple):
    """What a use costs, and what it gives.

    Attributes
    ----------
    use, function, number : str
    states : int
    error : float
        Largest error of an entry, in `unit`.
    unit : str
    seconds : float
        For one state.
    enough : str
    """

    use: str
    function: str
    number: str
    states: int
    error: float
    unit: str
    seconds: float
    enough: str

    def __str__(self) -> str:
        some = "one state" if self.states == 1 else f"{self.states} states in a call"
        cost = f"{duration(self.seconds)} a state"
        return (
            f"{self.use}: {self.function}, {self.number}, {some}: {self.error:.0e} {self.unit}, {cost}; {self.enough}"
        )


def _program(want: str | tuple[str, ...], arguments: str, dtype: str = "float64") -> Any:
    """Return what makes a program of a model, called with those of (q, v, u) that it takes."""
    names = arguments.split()

    def make(model: Model) -> Callable[..., Any]:
        program = tw.compile(model, want, dtype=dtype)

        def call(q: Array, v: Array, u: Array) -> Any:
            state = {"q": q, "v": v, "a": u, "tau": u}
            return program(*(state[name] for name in names))

        return call

    return make


def _derivative(model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return ∂τ/∂q of one state, from forward differences with twice the digits: these lose one half of them."""
    import mpmath

    with mpmath.workdps(2 * TRUTH_DIGITS + 4):
        h = mpmath.mpf(10) ** (-TRUTH_DIGITS - 2)
        here = ne.inverse_dynamics(model, q, v, a)
        steps = ne.as_mpmath(np.eye(model.nv)) * h
        ahead = [ne.inverse_dynamics(model, integrate(model, q, step), v, a) for step in steps]
        return np.stack([(tau - here) / h for tau in ahead], axis=1)


def _in_fifty_digits(model: Model) -> Callable[[Array, Array, Array], Array]:
    """Return inverse dynamics of mpmath numbers, rounded to 50 digits."""

    def call(q: Array, v: Array, a: Array) -> Array:
        import mpmath

        with mpmath.workdps(50):
            return ne.inverse_dynamics(model, q, v, a)

    return call


def _torques_of_regressor(model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return τ = Y π: the regressor has no truth of its own."""
    return ne.inverse_dynamics(model, q, v, a)


USES = {
    "learn": Use(
        "read, change and trace an algorithm",
        "tw.rnea(model, q, v, a)",
        lambda model: partial(tw.rnea, model),
        "float64",
        1,
        ne.inverse_dynamics,
        "N m",
        "every number of a page is reached",
    ),
    "control": Use(
        "M and h in a control loop",
        'tw.compile(model, ("h", "M", "J_c", "A_G"))',
        _program(("h", "M", "J_c", "A_G"), "q v"),
        "float64",
        1,
        lambda model, q, v, a: ne.inverse_dynamics(model, q, v, 0 * a),
        "N m",
        "friction in a gearbox is 0.1 N m and more",
    ),
    "mpc": Use(
        "τ and its derivatives along a horizon",
        'tw.compile(model, ("dtau_dq", "dtau_dv", "tau"))',
        _program(("dtau_dq", "dtau_dv", "tau"), "q v a"),
        "float64",
        100,
        _derivative,
        "N m/rad",
        "a difference of doubles leaves some 1e-6",
    ),
    "sampling": Use(
        "thousands of rollouts, as for learning a policy",
        'tw.compile(model, "aba", dtype="float32")',
        _program("aba", "q v tau", "float32"),
        "float32",
        10_000,
        ne.forward_dynamics,
        MILLIMETRES,
        "masses are known to some percent",
    ),
    "simulation": Use(
        "energy and momentum over minutes",
        'tw.compile(model, "aba")',
        _program("aba", "q v tau"),
        "float64",
        1,
        ne.forward_dynamics,
        MILLIMETRES,
        "the error of a step of 1 ms is larger",
    ),
    "identification": Use(
        "masses and inertias from measured torques",
        'tw.compile(model, "Y")',
        _program("Y", "q v a"),
        "float64",
        1000,
        _torques_of_regressor,
        "N m",
        "a torque is measured to 0.01 N m",
    ),
    "verification": Use(
        "hold other programs against it, state by state",
        'tw.compile(model, "rnea", dtype="double-double")',
        _program("rnea", "q v a", "double-double"),
        "float64",
        1000,
        ne.inverse_dynamics,
        "N m",
        "no error of a double is in it",
    ),
    "truth": Use(
        "digits without end, by formulas of another kind",
        "tw.newton_euler_3d.inverse_dynamics, mpmath",
        _in_fifty_digits,
        "50 digits",
        1,
        ne.inverse_dynamics,
        "N m",
        "nothing in it is shared with the rest",
    ),
}
"""By name: who computes what."""


def advise(model: Model, use: str, *, rounds: int = 5) -> Advice:
    """Return what a use takes on this machine, and what it gives.

    Parameters
    ----------
    model : Model
    use : str
        A key of `USES`.
    rounds : int
        Of the timing.

    Raises
    ------
    NameNotFound
        If there is no such use.
    ImportError
        If mpmath, which computes the truth, is not installed.

    Examples
    --------
    >>> import twistwrench as tw
    >>> found = advise(tw.load("pendulum"), "simulation", rounds=1)
    >>> found.function, found.number, found.error < 1e-12
    ('tw.compile(model, "aba")', 'float64', True)
    """
    check_known("use", use, USES)
    wanted = USES[use]
    try:
        import mpmath
    except ImportError:
        raise ImportError(NO_MPMATH) from None
    states = _random_states(model, max(wanted.states, CHECKED_STATES))
    compute = wanted.make(model)
    with mpmath.workdps(TRUTH_DIGITS):
        error = max(_error(model, wanted, compute, [x[k] for x in states]) for k in range(CHECKED_STATES))
        of_call = 0 if wanted.states == 1 else slice(wanted.states)
        args = [_convert(x[of_call], wanted.number) for x in states]
        (lap,) = round_robin([lambda: compute(*args)], rounds=rounds, least=0.005)
    seconds = float(np.median(lap.seconds)) / wanted.states
    number = "double-double" if "double-double" in wanted.function else wanted.number
    return Advice(use, wanted.function, number, wanted.states, error, wanted.unit, seconds, wanted.enough)


def _random_states(model: Model, n: int) -> list[Array]:
    """Draw q (n, nq), v and a (n, nv): `RANDOM_STATES` states, which are repeated as often as needed."""
    rng = np.random.default_rng(0)
    drawn = min(n, RANDOM_STATES)
    q = np.stack([model.random_configuration(rng=rng) for _ in range(drawn)])
    v, a = rng.standard_normal((2, drawn, model.nv))
    return [np.resize(x, (n, x.shape[-1])) for x in (q, v, a)]


def _convert(x: Array, number: str) -> Array:
    """Convert doubles into a number type."""
    return ne.as_mpmath(x) if number.endswith("digits") else x.astype(number)


def _error(model: Model, use: Use, compute: Callable[..., Any], state: list[Array]) -> float:
    """Return the largest error of an entry of the first result, the state's own rounding included."""
    found = compute(*(_convert(x, use.number) for x in state))
    first = next(iter(vars(found).values())) if isinstance(found, Results) else found
    if use.truth is _torques_of_regressor:
        first = first @ np.concatenate([I.parameters() for I in model.inertia[1:]]) + model.armature * state[2]
    parts = first if isinstance(first, tuple) else (first,)  # of a double-double, two
    value = sum(part if part.dtype == object else ne.as_mpmath(part) for part in parts)
    truth = use.truth(model, *(ne.as_mpmath(x) for x in state))
    return float(abs(value - truth).max()) * (MM_OF_ACCELERATION if use.unit == MILLIMETRES else 1)


# -------------------------------------------------------------------- the command


def add_advise(commands: Any) -> None:
    """Add ``twistwrench advise``."""
    parser = commands.add_parser(
        "advise",
        help="which function and number type for a use, with its error and time here",
        description="Measure what a use takes on this machine: function, number type, error in its unit, time.",
    )
    parser.add_argument("robot", nargs="?", default="go2", metavar="ROBOT", help="a catalogue name or a URDF (go2)")
    parser.add_argument("--base", choices=["fixed", "floating"], help="the base, if not the robot's own")
    parser.add_argument("--use", metavar="USE", help=f"of {', '.join(USES)}; all unless given")
    parser.set_defaults(run=run_advise)


def run_advise(args: argparse.Namespace) -> int:
    """Print the row of a use, or of all."""
    if args.use is not None:
        check_known("use", args.use, USES)
    model = tw.load(args.robot, base=args.base)
    for use in USES if args.use is None else (args.use,):
        print(f"{USES[use].what}:\n  {advise(model, use)}")
    return 0

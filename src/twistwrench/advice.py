"""``twistwrench advise``: who needs which digits for what, and what they cost on this machine.

An error is worth a number of digits only to somebody. So each use has a function and some number types, and what they
give is measured: the error of the worst of many states, in N m or in mm, and the time. From the error that is allowed
follows the cheapest that keeps it. How far off a whole motion is, `motion_error` finds out.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

import twistwrench as tw

from . import newton_euler_3d as ne
from .arrays import Array, as_count, check_kind
from .errors import check_known
from .fast.program import Results
from .model import Model, check_model
from .step_choice import cheapest_steps
from .tables import text_table
from .timing import duration as in_words
from .timing import round_robin
from .validate.manifold import integrate

__all__ = ["NO_MPMATH", "USES", "Advice", "Decision", "Use", "add_advise", "advise", "read_tolerance"]

NO_MPMATH = 'the truth needs mpmath: pip install "twistwrench[validate]"'

TRUTH_DIGITS = 60
"""More than any way has, so that each has an error to show."""

RANDOM_STATES = 1000
"""The number of random states; larger batches repeat them."""

CHECKED_STATES = 200
"""Random states at which an error is measured. The largest of n is above a share 0.05^(1/n) of all, 98.5 % here, with a
confidence of 95 %."""

EXACT_STATES = 59
"""The same of 50 digits, and of all on a machine whose longest numbers are doubles: the truth in 60 digits takes up to
a second a state. The largest is above 95 % of all."""

MILLIMETRES = "mm after 1 s"
"""Where an error of an acceleration, if it stayed, would lead 1 m away from the joint: 500 mm for 1 rad/s²."""

MM_OF_ACCELERATION = 500.0

DIGITS = "digits"
"""The unit of an error that is a share of the largest entry."""

DOUBLE_DOUBLE, FIFTY = "double-double", "50 digits"

UNITS = {
    "nm": ("N m", 1.0),
    "nm/rad": ("N m/rad", 1.0),
    "mm": ("mm", 1.0),
    "um": ("mm", 1e-3),
    "m": ("mm", 1e3),
    "digits": (DIGITS, 1.0),
    "digit": (DIGITS, 1.0),
}
"""How units are spelt, without blanks, dots and capitals."""


Bound = Literal["running"] | bool
"""Whether a program proves its error, and how: see `tw.compile`."""


class Use(NamedTuple):
    """What somebody computes, and how exactly.

    Attributes
    ----------
    what : str
        In words.
    want : str or tuple of str
        The quantities of a program; the error is that of the first. Or the call, where it is no program.
    arguments : str
        Those of (q, v, u) that it takes, where u is the acceleration, or the torque.
    numbers : tuple of str
        The number types that are tried; the first is what is usual.
    states : int
        In a call.
    truth : callable
        From a model and a state, in any number type, to the truth of the first quantity.
    unit : str
        Of the error.
    enough : str
        What is larger than the error of the usual one.
    """

    what: str
    want: str | tuple[str, ...]
    arguments: str
    numbers: tuple[str, ...]
    states: int
    truth: Callable[[Model, Array, Array, Array], Array]
    unit: str
    enough: str

    def function(self, number: str, bound: Bound = False) -> str:
        """Return the call as it is written."""
        if self.want in WITHOUT_PROGRAM:
            return str(self.want)
        wanted = repr(self.want).replace("'", '"')
        options = f', dtype="{number}"' if number != "float64" else ""
        options += f", bound={bound!r}".replace("'", '"') if bound else ""
        return f"tw.compile(model, {wanted}{options})"

    def make(self, model: Model, number: str, bound: Bound = False) -> Callable[[Array, Array, Array], Any]:
        """Return the function of (q, v, u)."""
        if self.want in WITHOUT_PROGRAM:
            return WITHOUT_PROGRAM[str(self.want)](model)
        names = self.arguments.split()
        program = tw.compile(model, self.want, dtype=number, bound=bound)

        def call(q: Array, v: Array, u: Array) -> Any:
            state = {"q": q, "v": v, "a": u, "tau": u}
            return program(*(state[name] for name in names))

        return call


class Advice(NamedTuple):
    """What a way of computing costs, and what it gives.

    Attributes
    ----------
    use, function, number : str
    states : int
        In a call.
    error : float
        The largest error of an entry in `checked` random states, in `unit`; of a bound, the largest bound.
    unit : str
    seconds : float
        For one state, or for the motion.
    enough : str
    checked : int
    """

    use: str
    function: str
    number: str
    states: int
    error: float
    unit: str
    seconds: float
    enough: str
    checked: int = CHECKED_STATES

    def __str__(self) -> str:
        some = "one state" if self.states == 1 else f"{self.states} states in a call"
        cost = f"{in_words(self.seconds)} a state"
        said = f"{self.use}: {self.function}, {self.number}, {some}: {self.error:.0e} {self.unit}, {cost}"
        return f"{said}; {self.enough}"


class Decision(NamedTuple):
    """The cheapest way that keeps an error: the result of `advise` with a tolerance. Printed, it is a table.

    Attributes
    ----------
    within : float
        The error that is allowed, in `unit`.
    unit : str
    tried : tuple of Advice
        Those that keep it first, the cheapest first.
    sure : str
        Of which states the errors are the largest, and of how many others they are.
    instead : str
        What would hold where nothing does; empty where something does.
    """

    within: float
    unit: str
    tried: tuple[Advice, ...]
    sure: str
    instead: str

    @property
    def best(self) -> Advice | None:
        """The cheapest that keeps the error; None if nothing does."""
        return next((advice for advice in self.tried if advice.error <= self.within), None)

    def __str__(self) -> str:
        rows = [
            ["→" if advice == self.best else "", advice.function, self._error(advice), in_words(advice.seconds)]
            for advice in self.tried
        ]
        limit = [f"at most {_shown(self.within, self.unit)}; > where there is more"]
        found = limit if self.best else [f"nothing here keeps {_shown(self.within, self.unit)}: {self.instead}"]
        return "\n".join([*found, text_table(["", "function", "error", "time"], rows), self.sure])

    def _error(self, advice: Advice) -> str:
        return _shown(advice.error, self.unit) + ("" if advice.error <= self.within else " >")


def _shown(error: float, unit: str) -> str:
    if unit != DIGITS:
        return f"{error:.2g} {unit}"
    return f"{-np.log10(error):.1f} digits" if error > 0 else "all digits"


def _derivative(model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return ∂τ/∂q: of doubles by a program; in mpmath from forward differences with twice the digits, which lose half.

    A program in long double differentiates the same line as one in double.
    """
    if q.dtype != object:
        return np.asarray(tw.compile(model, "dtau_dq", dtype=q.dtype)(q, v, a))
    import mpmath

    with mpmath.workdps(2 * TRUTH_DIGITS + 4):
        h = mpmath.mpf(10) ** (-TRUTH_DIGITS - 2)
        here = ne.inverse_dynamics(model, q, v, a)
        steps = ne.as_mpmath(np.eye(model.nv)) * h
        ahead = [ne.inverse_dynamics(model, integrate(model, q, step), v, a) for step in steps]
        return np.stack([(tau - here) / h for tau in ahead], axis=1)


def _torques(model: Model, q: Array, v: Array, a: Array) -> Array:
    return ne.inverse_dynamics(model, q, v, a) if q.dtype == object else tw.rnea(model, q, v, a)


def _bias(model: Model, q: Array, v: Array, a: Array) -> Array:
    return _torques(model, q, v, 0 * a)


def _torques_of_regressor(model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return τ = Y π: the regressor has no truth of its own."""
    return _torques(model, q, v, a)


def _accelerations(model: Model, q: Array, v: Array, tau: Array) -> Array:
    return ne.forward_dynamics(model, q, v, tau) if q.dtype == object else tw.aba(model, q, v, tau)


def _in_fifty_digits(model: Model) -> Callable[[Array, Array, Array], Array]:
    """Return inverse dynamics of mpmath numbers, rounded to 50 digits."""

    def call(q: Array, v: Array, a: Array) -> Array:
        import mpmath

        with mpmath.workdps(50):
            return ne.inverse_dynamics(model, q, v, a)

    return call


LEARN, TRUTH = "tw.rnea(model, q, v, a)", "tw.newton_euler_3d.inverse_dynamics, mpmath"
WITHOUT_PROGRAM: dict[Any, Callable[[Model], Callable[[Array, Array, Array], Any]]] = {
    LEARN: lambda model: partial(tw.rnea, model),
    TRUTH: _in_fifty_digits,
}

USES = {
    "learn": Use(
        "read, change and trace an algorithm",
        LEARN,
        "q v a",
        ("float64", "float32"),
        1,
        _torques,
        "N m",
        "every number of a page is reached",
    ),
    "control": Use(
        "M and h in a control loop",
        ("h", "M", "J_c", "A_G"),
        "q v",
        ("float64", "float32", DOUBLE_DOUBLE),
        1,
        _bias,
        "N m",
        "friction in a gearbox is 0.1 N m and more",
    ),
    "mpc": Use(
        "τ and its derivatives along a horizon",
        ("dtau_dq", "dtau_dv", "tau"),
        "q v a",
        ("float64", "float32"),
        100,
        _derivative,
        "N m/rad",
        "a difference of doubles leaves some 1e-6",
    ),
    "sampling": Use(
        "thousands of rollouts, as for learning a policy",
        "aba",
        "q v tau",
        ("float32", "float64"),
        10_000,
        _accelerations,
        MILLIMETRES,
        "masses are known to some percent",
    ),
    "simulation": Use(
        "energy and momentum over minutes",
        "aba",
        "q v tau",
        ("float64", "float32", DOUBLE_DOUBLE),
        1,
        _accelerations,
        MILLIMETRES,
        "the error of a step of 1 ms is larger",
    ),
    "identification": Use(
        "masses and inertias from measured torques",
        "Y",
        "q v a",
        ("float64", "float32"),
        1000,
        _torques_of_regressor,
        "N m",
        "a torque is measured to 0.01 N m",
    ),
    "verification": Use(
        "hold other programs against it, state by state",
        "rnea",
        "q v a",
        (DOUBLE_DOUBLE, "float64"),
        1000,
        _torques,
        "N m",
        "no error of a double is in it",
    ),
    "truth": Use(
        "digits without end, by formulas of another kind",
        TRUTH,
        "q v a",
        (FIFTY,),
        1,
        _torques,
        "N m",
        "nothing in it is shared with the rest",
    ),
}
"""By name: who computes what."""


def advise(
    model: Model,
    use: str,
    *,
    within: str | float | None = None,
    duration: float | None = None,
    certified: bool = False,
    start: tuple[ArrayLike, ArrayLike] | None = None,
    rounds: int = 5,
    progress: bool = False,
) -> Advice | Decision:
    """Return what a use takes on this machine, and what it gives; or the cheapest way that keeps an error.

    Parameters
    ----------
    model : Model
    use : str
        A key of `USES`: who computes what.
    within : str or float, optional
        The error that is allowed: ``"0.01 N m"``, ``"0.1 mm"``, ``"6 digits"``; a number alone is in the unit of the
        use. The digits are those of the largest entry.
    duration : float, optional
        With the use ``"simulation"``: the time after which every body must be within that many mm of where it should
        be, s. Method and dt are then part of the answer.
    certified : bool
        Whether the error must be proved, state by state: of programs with ``bound=``, which return it.
    start : tuple of array_like, optional
        q (nq,) and v (nv,) of the motion, with `duration`. Default: 64 random starts, without joint forces.
    rounds : int
        Of the timing.
    progress : bool
        Show what is being measured.

    Returns
    -------
    Advice or Decision
        Without `within`, the usual way of the use; with it, all that were tried, and the cheapest that does.

    Raises
    ------
    NameNotFound
        If there is no such use.
    ValueError
        If `within` is no error of this use, or an option needs another one.
    ImportError
        If mpmath, which computes the truth of numbers beyond double, is not installed.

    Examples
    --------
    >>> import twistwrench as tw
    >>> pendulum = tw.load("pendulum")
    >>> found = tw.advise(pendulum, "control", within="0.01 N m", rounds=1)
    >>> found.best.number in ("float32", "float64"), found.best.error < 0.01
    (True, True)
    >>> tw.advise(pendulum, "control", within="1e-20 N m", rounds=1).best.number
    'double-double'
    """
    check_model(model)
    check_known("use", use, USES)
    wanted = USES[use]
    rounds = as_count(rounds, "rounds", 1)
    if within is None:
        if duration is not None or certified:
            raise ValueError("within: expected the error that is allowed, as in '0.1 mm', with duration or certified")
        return _measure(model, use, wanted.numbers[0], False, wanted.unit, rounds, progress)
    if duration is not None:
        return _for_motion(model, use, within, duration, certified, start, progress)
    if start is not None:
        raise ValueError("start: a state to start from belongs to a motion, with duration=")
    most, unit = read_tolerance(within, wanted.unit)
    proved = wanted.want not in WITHOUT_PROGRAM and wanted.truth is not _torques_of_regressor and unit == "N m"
    if certified and not proved:
        raise ValueError(f"certified: a bound is proved of programs, in N m; {use!r} has none")
    ways: list[tuple[str, Bound]] = [(number, False) for number in wanted.numbers]
    if certified:
        ways = [("float64", "running"), ("float64", True)]
    tried = list[Advice]()
    for number, bound in sorted(ways, key=lambda way: way[0] in (DOUBLE_DOUBLE, FIFTY)):
        if number in (DOUBLE_DOUBLE, FIFTY) and any(advice.error <= most for advice in tried):
            continue  # it takes ten times as long, and more
        tried.append(_measure(model, use, number, bound, unit, rounds, progress))
    tried.sort(key=lambda advice: (advice.error > most, advice.seconds))
    fewest = min(advice.checked for advice in tried)
    share = 0.05 ** (1 / fewest)
    sure = f"the largest error in {fewest} random states: with 95 % confidence, {share:.1%} of all have less"
    sure = "the largest bound in 200 random states; each call returns its own, which is proved" if certified else sure
    instead = "" if any(advice.error <= most for advice in tried) else _instead(use, unit)
    return Decision(most, unit, tuple(tried), sure, instead)


def _instead(use: str, unit: str) -> str:
    """Return what has a smaller error than all that was tried."""
    if DOUBLE_DOUBLE in USES[use].numbers:
        return "mpmath does, with as many digits as are asked for (use 'truth')"
    if unit == "N m":
        return "numbers with 32 digits do (use 'verification'), at a hundred times the cost"
    return "a program with dtype='double-double' or mpmath has more digits"


def read_tolerance(within: str | float, unit: str) -> tuple[float, str]:
    """Return an error that is allowed, and its unit: that of a use, or digits.

    Raises
    ------
    ValueError
        If it is not a number above zero with one of the units.

    Examples
    --------
    >>> read_tolerance("20 µm", MILLIMETRES)
    (0.02, 'mm after 1 s')
    >>> read_tolerance("6 digits", "N m")
    (1e-06, 'digits')
    """
    text = str(within)
    match = re.fullmatch(r"\s*([0-9.]+(?:e[+-]?\d+)?)\s*(.*?)\s*", text, re.IGNORECASE)
    plain = unit.removesuffix(" after 1 s")
    expected = f"within: expected an error above zero, as in '0.1 {plain}' or '6 digits', got {within!r}"
    if match is None:
        raise ValueError(expected)
    spelt = re.sub(r"[\s·*]", "", match[2]).lower().replace("µ", "u").replace("μ", "u")
    named, factor = UNITS.get(spelt, ("", 1.0)) if spelt else (plain, 1.0)
    most = float(match[1]) * factor
    if named == "mm" != plain:
        raise ValueError(f"within: millimetres are of a motion, with duration= (--for), got {within!r}")
    if named not in (plain, DIGITS) or not 0 < most < np.inf:
        raise ValueError(expected)
    return (10.0**-most, DIGITS) if named == DIGITS else (most, unit)


def _for_motion(
    model: Model,
    use: str,
    within: str | float,
    duration: float,
    certified: bool,
    start: tuple[ArrayLike, ArrayLike] | None,
    progress: bool,
) -> Decision:
    """Return the method and dt with the least work that keep a motion within so many millimetres."""
    if use != "simulation" or certified:
        raise ValueError("duration: expected the use 'simulation', whose errors are measured and not proved")
    most, unit = read_tolerance(within, "mm")
    if unit != "mm":
        raise ValueError(f"within: expected millimetres of a motion, as in '0.1 mm', got {within!r}")
    if start is not None:
        check_kind(start, "start", tuple, "a tuple (q, v)")
    found = cheapest_steps(model, most, duration, start, progress=progress)
    rows = [
        Advice(
            use,
            f'tw.simulate(model, q, v, dt={duration:g} / {way.steps}, duration={duration:g}, method="{way.method}")',
            "float64",
            1,
            way.error,
            unit,
            way.seconds,
            "",
            found.starts,
        )
        for way in found.ways
    ]
    rows.sort(key=lambda advice: (advice.error > most, advice.seconds))
    return Decision(most, unit, tuple(rows), found.sure, found.instead)


def _measure(model: Model, use: str, number: str, bound: Bound, unit: str, rounds: int, progress: bool) -> Advice:
    """Return the error and the time of one way."""
    wanted = USES[use]
    if progress:
        print(f"{wanted.function(number, bound)} ...", flush=True)
    no_longer = np.finfo(np.longdouble).eps == np.finfo(np.float64).eps
    beyond = number in (DOUBLE_DOUBLE, FIFTY) or no_longer
    few = number == FIFTY or (no_longer and number != DOUBLE_DOUBLE)
    checked = EXACT_STATES if few and not bound else CHECKED_STATES
    states = _random_states(model, max(wanted.states, checked))
    compute = wanted.make(model, number, bound)
    some = [x[:checked] for x in states]
    usual = "float64" if number == DOUBLE_DOUBLE else number
    if bound:
        error = float(np.max(np.asarray(_first(compute(*some)[1]))))
    elif beyond:
        error = max(_exact_error(model, wanted, compute, [x[k] for x in some], usual, unit) for k in range(checked))
    else:
        given = [_convert(x, usual) for x in some]
        found = _value(model, wanted, compute(*given), given[2]).astype(np.longdouble)
        truth = wanted.truth(model, *(x.astype(np.longdouble) for x in some))
        error = _worst(found - truth, truth, unit)
    of_call = 0 if wanted.states == 1 else slice(wanted.states)
    args = [_convert(x[of_call], usual) for x in states]
    (lap,) = round_robin([lambda: compute(*args)], rounds=rounds, least=0.005)
    seconds = float(np.median(lap.seconds)) / wanted.states
    function = wanted.function(number, bound)
    return Advice(use, function, number, wanted.states, error, unit, seconds, wanted.enough, checked)


def _random_states(model: Model, n: int) -> list[Array]:
    """Draw q (n, nq), v and a (n, nv): `RANDOM_STATES` states, which are repeated as often as needed."""
    rng = np.random.default_rng(0)
    drawn = min(n, RANDOM_STATES)
    q = model.random_configuration(drawn, rng=rng)
    v, a = rng.standard_normal((2, drawn, model.nv))
    return [np.resize(x, (n, x.shape[-1])) for x in (q, v, a)]


def _convert(x: Array, number: str) -> Array:
    """Convert doubles into a number type."""
    return ne.as_mpmath(x) if number == FIFTY else x.astype(number)


def _first(found: Any) -> Any:
    """Return the first quantity of a program that computes several."""
    return next(iter(vars(found).values())) if isinstance(found, Results) else found


def _value(model: Model, use: Use, found: Any, u: Array) -> Any:
    """Return what is held against the truth: the first quantity, or of a regressor the torques that it gives."""
    first = _first(found)
    if use.truth is not _torques_of_regressor:
        return first
    parameters = np.concatenate([inertia.parameters() for inertia in model.inertia[1:]])
    return first @ parameters.astype(first.dtype) + model.armature.astype(first.dtype) * u


def _exact_error(
    model: Model, use: Use, compute: Callable[..., Any], state: Sequence[Array], number: str, unit: str
) -> float:
    """Return the error against 60 digits, the state's own rounding included."""
    try:
        import mpmath
    except ImportError:
        raise ImportError(NO_MPMATH) from None
    with mpmath.workdps(TRUTH_DIGITS):
        given = [_convert(x, number) for x in state]
        first = _value(model, use, compute(*given), given[2])
        parts = first if isinstance(first, tuple) else (first,)  # of a double-double, two
        value = sum(part if part.dtype == object else ne.as_mpmath(part) for part in parts)
        truth = use.truth(model, *(ne.as_mpmath(x) for x in state))
        return _worst(value - truth, truth, unit)


def _worst(off: Array, truth: Array, unit: str) -> float:
    """Return the largest error of an entry in the unit: of digits, as a share of the state's largest entry."""
    if unit == DIGITS:
        axes = tuple(range(1, truth.ndim)) if truth.dtype != object else None
        size = np.abs(truth).max(axis=axes)
        most = np.abs(off).max(axis=axes)
        return float(np.max(np.where(size == 0, 0, most / np.where(size == 0, 1, size))))
    return float(np.abs(off).max()) * (MM_OF_ACCELERATION if unit == MILLIMETRES else 1)


# -------------------------------------------------------------------- the command


def add_advise(commands: Any) -> None:
    """Add ``twistwrench advise``."""
    parser = commands.add_parser(
        "advise",
        help="which function, number type and step for a use, with its error and time here",
        description="Measure what a use takes on this machine: function, number type, error in its unit, time; or find "
        "the cheapest way that keeps an error.",
    )
    parser.add_argument("robot", nargs="?", default="go2", metavar="ROBOT", help="a catalogue name or a URDF (go2)")
    parser.add_argument("--base", choices=["fixed", "floating"], help="the base, if not the robot's own")
    parser.add_argument("--use", metavar="USE", help=f"of {', '.join(USES)}; all unless given")
    parser.add_argument("--within", metavar="ERROR", help='the error that is allowed: "0.01Nm", "0.1mm", "6digits"')
    parser.add_argument("--for", dest="duration", metavar="TIME", help="of a motion that must stay within, as in 60s")
    parser.add_argument("--certified", action="store_true", help="the error must be proved, state by state")
    parser.set_defaults(run=run_advise)


def _seconds(text: str) -> float:
    """Return the seconds of "60s", or of "60"."""
    try:
        return float(text.strip().removesuffix("s"))
    except ValueError:
        raise ValueError(f"--for: expected seconds, as in 60s, got {text!r}") from None


def run_advise(args: argparse.Namespace) -> int:
    """Print the row of a use, or of all; or the decision for an error that is allowed."""
    if args.use is not None:
        check_known("use", args.use, USES)
    model = tw.load(args.robot, base=args.base)
    if args.within is None and args.duration is None and not args.certified:
        for use in USES if args.use is None else (args.use,):
            print(f"{USES[use].what}:\n  {advise(model, use)}", flush=True)
        return 0
    try:
        duration = None if args.duration is None else _seconds(args.duration)
        use = args.use or ("simulation" if duration is not None else "control")
        found = advise(model, use, within=args.within, duration=duration, certified=args.certified, progress=True)
    except ValueError as error:
        raise tw.ModelError(str(error)) from None
    print(f"{USES[use].what if duration is None else f'a motion of {duration:g} s'}:\n{found}")
    return 0 if isinstance(found, Decision) and found.best else 1

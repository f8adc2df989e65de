"""The cost of a reduced model: error and work of each over some motions, and the least work that is exact enough."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from html import escape
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from straightline.llvm import default_backend

from ..arrays import Array, as_number
from ..errors import check_known
from ..model import Model
from ..motions import Motion
from ..tables import aligned, html_table
from ..templates.template import Template
from .candidates import Articulated, Candidate
from .compiled import compile_law, seconds
from .judging import QUANTITIES, ReferenceMotion, scale, unit

__all__ = ["Costs", "Option", "Prediction", "Tolerance", "costs", "read_tolerance"]

Tolerance = float | Mapping[str, float | Iterable[str]]


class Prediction(NamedTuple):
    """Prediction of a model: ḣ_G, (..., 6), and of the entries `Option.kept` τ without contact forces, or None."""

    wrench: Array
    tau: Array | None


@dataclass(frozen=True, eq=False)
class Option:
    """A model that could take the place of the full one, and what that costs.

    Called with states of the whole robot, ``option(q, v, a)``, it returns an `Prediction`.

    Attributes
    ----------
    name : str
        Of the template, or of the joints that are held.
    leaves_out : str
        What it assumes.
    model : Template, Model or None
        The model itself: a template, or the robot without the joints that are held. None where it does not apply.
    kept : ndarray of int, shape (k,)
        The entries of the whole robot's τ that it tells.
    errors, held_out : dict of str to ndarray, shape (n,)
        At each state of the motions, and of those that were held out: the ``"wrench"`` that it misses and that of the
        worst contact, ``"forces"``, as shares of the weight; how far off its centre of pressure is, ``"cop"``, m; and
        the torque of the worst motor that is needed, ``"tau"``, N m. Of all that it tells; no torque where it does not
        tell all that are needed.
    operations : float
        Of its compiled program, for one state; infinite where NumPy computes it because it cannot be a program. Not a
        number where none was made, because it is not exact enough or does not apply.
    seconds : float
        For one state, when all states are done at once; not a number where there are no operations.
    unfit : str
        Why it does not apply to this robot; empty where it does.
    """

    name: str
    leaves_out: str
    errors: Mapping[str, Array] = field(repr=False)
    held_out: Mapping[str, Array] = field(repr=False)
    operations: float
    seconds: float
    unfit: str = ""
    _runs: Candidate | None = field(default=None, repr=False)

    @property
    def model(self) -> Template | Model | None:
        """The model itself."""
        found = self._runs.model if self._runs else None
        return found.model if isinstance(found, Articulated) else found

    @property
    def kept(self) -> Array:
        """The entries of the whole robot's τ that it tells."""
        return self._runs.kept if self._runs else np.zeros(0, int)

    @property
    def predicts_torques(self) -> bool:
        """Whether it gives joint torques, and not only ḣ_G and what follows from it."""
        return self._runs is not None and self._runs.predicts_torques

    def worst(self, quantity: str = "wrench", *, held_out: bool = False) -> float:
        """Return the largest error over the motions; infinite where the model does not tell the quantity."""
        found = self.held_out if held_out else self.errors
        return float(found[quantity].max(initial=0)) if quantity in found else np.inf

    def within(self, need: Mapping[str, float], margin: float = 1.0, *, held_out: bool = False) -> bool:
        """Whether the largest errors times the margin are at most what is needed."""
        return all(margin * self.worst(name, held_out=held_out) <= most for name, most in need.items())

    def __call__(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Prediction:
        """Return what it predicts for states of the whole robot: q (..., nq), v and a (..., nv)."""
        runs = self._runs
        if runs is None or runs.model is None:
            raise ValueError(f"{self.name!r} does not apply: {self.unfit}")
        whole = runs.model.full if isinstance(runs.model, Articulated) else runs.model.model
        rate, *tau = runs.law(*runs.model.read(*whole.state(q, v=v, a=a)))
        return Prediction(rate, tau[0] if tau else None)


@dataclass(frozen=True, eq=False, repr=False)
class Costs:
    """Costs of the models that could serve, from `Scene.cheapest`: all options, the least work first. A table in print.

    Attributes
    ----------
    motion : str
        The names of the motions.
    held_out : str
        The names of those that the choice was not made on.
    tolerance : dict of str to float
        What is needed, and the largest error that is allowed: see `Option`.
    margin : float
        The largest errors times this must be within the tolerance.
    options : tuple of Option
        Those that are exact enough come first, the fewest operations first: a time is another one in the next run.
        Then the rest; those that do not apply come last.
    motors : ndarray of int, shape (k,)
        The entries of the whole robot's τ that are needed where a torque is: all motors of the scene, or those named.
    share_of : str
        What errors of wrenches and forces are shares of: the weight, or without gravity the largest ḣ_G of the motion.
    timed_by : str
        The back end of the programs: "llvm" or "numpy".
    """

    motion: str
    held_out: str
    tolerance: Mapping[str, float]
    margin: float
    options: tuple[Option, ...]
    motors: Array
    share_of: str
    timed_by: str

    @property
    def best(self) -> Option:
        """The option of the fewest operations that stays within the tolerance, with the margin, over the motions."""
        return next(option for option in self.options if option.within(self.tolerance, self.margin))

    @property
    def holds(self) -> bool:
        """Whether the choice stays within the tolerance on the motions that were held out."""
        return self.best.within(self.tolerance, held_out=True)

    def __repr__(self) -> str:
        return str(self)

    def _repr_html_(self) -> str:
        head, rows = self._table()
        left_out = {option.name: f"does not apply: {option.unfit}" for option in self.options if option.unfit}
        blank = ["-"] * (len(head) - 2)
        rows += [[name, *blank, why] for name, why in left_out.items()]
        marked = [["→" if row[0] == self.best.name else "", *row] for row in rows]
        return f"<p>{escape(self._title())}</p>{html_table(['', *head], marked)}"

    def __str__(self) -> str:
        head, rows = self._table()
        width = max(len(option.name) for option in self.options)
        lines = [[f"{'→' if name == self.best.name else ' '} {name:{width}}", *rest] for name, *rest in rows]
        table = aligned([[f"  {head[0]}", *head[1:]], *lines], right=range(1, len(head) - 2))
        left_out = [f"  {o.name:{width}}  does not apply: {o.unfit}" for o in self.options if o.unfit]
        return "\n".join([self._title(), *table, *left_out])

    def _title(self) -> str:
        """Return the motions, the tolerances and the margin, in one line."""
        most = ", ".join(f"{name} {most * scale(name):.3g}{unit(name)}" for name, most in self.tolerance.items())
        title = f"{self.motion}: the largest errors; shares are of {self.share_of}; at most {most}"
        title += f", with a margin of {self.margin:g}" if self.margin != 1 else ""
        title += f"; held out: {self.held_out}" if self.held_out else ""
        return title

    def _table(self) -> tuple[list[str], list[list[str]]]:
        """Return the head of the table, and the cells of each option that applies."""
        columns = [(name, out) for name in self.tolerance for out in ((False, True) if self.held_out else (False,))]
        errors = [f"{name}, held out" if out else name + unit(name) for name, out in columns]
        rows = [
            [
                option.name,
                *(self._error(option, *column) for column in columns),
                f"{option.operations:.0f}" if option.operations < np.inf else "-",
                "-" if np.isnan(option.seconds) else f"{option.seconds * 1e6:.3f}",
                self._tells(option),
                option.leaves_out,
            ]
            for option in self.options
            if not option.unfit
        ]
        return ["model", *errors, "operations", "µs/state", "tells", "leaves out"], rows

    def _tells(self, option: Option) -> str:
        """Return what an option tells as a cell: of the torques that are needed how many, where not all."""
        told = int(np.isin(self.motors, option.kept).sum())
        bears = told == len(self.motors) and "tau" not in option.errors  # the load of a joint that it lacks
        if bears or not told:
            return "ḣ_G"
        return "ḣ_G, τ" if told == len(self.motors) else f"ḣ_G, τ {told} of {len(self.motors)}"

    def _error(self, option: Option, name: str, held_out: bool) -> str:
        """Return the largest error of an option as a cell, marked where it is above the tolerance."""
        worst = option.worst(name, held_out=held_out)
        if not np.isfinite(worst):
            return "- "
        over = worst * (1.0 if held_out else self.margin) > self.tolerance[name]
        return f"{worst * scale(name):.2g}" + (">" if over else " ")

    def plot(self, ax: Any = None) -> Any:
        """Draw the time of each option that is exact enough, the choice marked, and the error of every option.

        Parameters
        ----------
        ax : matplotlib Axes, optional

        Returns
        -------
        matplotlib Axes

        Raises
        ------
        ModuleNotFoundError
            If matplotlib is not installed.
        """
        from ..plot.style import COLOURS, axes_2d
        from ..plot.words import word

        options = [option for option in self.options if not option.unfit]
        ax = axes_2d(ax, size=(7.0, 1.2 + 0.32 * len(options)))
        timed = [option for option in options if option.seconds > 0]
        times = [1e6 * option.seconds for option in timed]
        for kind, colour in (("the choice", "vermilion"), ("exact enough", "blue")):
            rows = [k for k, option in enumerate(timed) if (option is self.best) == (kind == "the choice")]
            ax.barh(rows, [times[k] for k in rows], color=COLOURS[colour], label=word(kind))
        for k, option in enumerate(options):
            errors = [
                f"{option.worst(name) * scale(name):.2g}{unit(name)}" if name in option.errors else "-"
                for name in self.tolerance
            ]
            label = ", ".join(errors) + (word("  + torques") if option.predicts_torques else "")
            end = times[k] if k < len(times) else 0.0
            ax.text(end + 0.01 * max(times), k, label, va="center")
        ax.set_yticks(range(len(options)), [option.name for option in options])
        ax.set(xlim=(0, 2.4 * max(times)), ylim=(len(options) - 0.5, -0.5), xlabel=word("time [µs per state]"))
        ax.set_title(word("{}: largest errors of {}").format(self.motion, ", ".join(self.tolerance)))
        ax.legend(loc="lower right", fontsize="small")
        return ax


def _rank(option: Option) -> tuple[bool, bool, float, float]:
    """Return by what options are in order: operations; the time, of those that are no program, which have no number."""
    count = np.nan_to_num(option.operations, posinf=np.inf)
    return bool(option.unfit), bool(np.isnan(option.operations)), count, 0.0 if count < np.inf else option.seconds


def read_tolerance(tolerance: Tolerance) -> tuple[dict[str, float], Iterable[str] | None]:
    """Return the largest error that is allowed of each quantity that is needed, and the joints of ``"of"``."""
    given: dict[str, Any] = dict(tolerance) if isinstance(tolerance, Mapping) else {"wrench": tolerance}
    of = given.pop("of", None)
    if of is not None and "tau" not in given:
        raise ValueError("tolerance: 'of' names the joints whose 'tau' is needed, and none is")
    for name, most in given.items():
        check_known("quantity", name, QUANTITIES)
        if not as_number(most, "tolerance") >= 0:
            raise ValueError(f"tolerance: expected an error of {name!r} that is allowed, 0 or more, got {most!r}")
    if not given:
        raise ValueError(f"tolerance: expected some of {', '.join(map(repr, QUANTITIES))}, got none")
    return {name: float(most) for name, most in given.items()}, of


def costs(
    model: Model,
    motions: Sequence[Motion],
    held_out: Sequence[Motion],
    judges: Sequence[Sequence[ReferenceMotion]],
    need: Mapping[str, float],
    margin: float,
    tried: Iterable[Candidate],
    motors: Array,
) -> Costs:
    """See `Scene.cheapest`."""
    for judge, motion in zip([*judges[0], *judges[1]], [*motions, *held_out]):
        for name in need:
            if name not in judge.tells:
                why = "it has no motors" if name == "tau" else "nothing stands on the ground, or nothing has weight"
                raise ValueError(f"tolerance: {name!r} is nothing of {model.name!r} in {motion.name!r}: {why}")
    options = list[Option]()
    calls = dict[int, Callable[[], object]]()
    for one in tried:
        if one.model is None:
            options.append(Option(one.name, one.leaves_out, {}, {}, np.nan, np.nan, one.unfit, one))
            continue
        known = list[tuple[Array, ...]]()
        found = list[dict[str, Array]]()
        for judging, some in zip(judges, (motions, held_out)):
            errors = list[Mapping[str, Array]]()
            for judge, motion in zip(judging, some):
                known.append(one.model.read(*model.state(motion.q, v=motion.v, a=motion.a)))
                rate, *tau = one.law(*known[-1])
                errors.append(judge.errors(rate, tau[0] if tau else None, one.kept, motors))
            common = [name for name in QUANTITIES if errors and all(name in e for e in errors)]
            found.append({name: np.concatenate([e[name] for e in errors]) for name in common})
        options.append(Option(one.name, one.leaves_out, found[0], found[1], np.nan, np.nan, "", one))
        states = [np.concatenate(x) for x in zip(*known[: len(motions)])]
        wanted = [0, 1] if "tau" in need else [0]
        if options[-1].within(need, margin):
            call, operations = compile_law(model, one.law, states, wanted[: 1 + one.predicts_torques])
            options[-1] = replace(options[-1], operations=operations)
            calls[len(options) - 1] = call
    for k, time in zip(calls, seconds([*calls.values()], sum(map(len, motions)))):
        options[k] = replace(options[k], seconds=time)
    options.sort(key=_rank)
    share = "the weight" if model.gravity.any() else "the largest ḣ_G of the motion"
    names, names_out = (", ".join(motion.name for motion in some) for some in (motions, held_out))
    by = default_backend(np.dtype(np.float64))
    return Costs(names, names_out, dict(need), float(margin), tuple(options), motors, share, by)

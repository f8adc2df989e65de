"""``python -m benchmarks.study templates``: the error of each template of a walking robot, and its time."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.motions import MOTIONS, Motion
from twistwrench.options import at_least, check_writable
from twistwrench.templates import TEMPLATES
from twistwrench.timing import round_robin

from .trade.picture import check_format

__all__ = ["ROBOTS", "Loss", "add_templates", "losses"]

ROBOTS = ("go2", "solo12", "talos_reduced", "g1")
REFERENCE = "full"


class Loss(NamedTuple):
    """The error of one template over one motion of one robot.

    Attributes
    ----------
    robot, motion, template : str
    rms, largest : float
        Of the relative residual, over the states.
    moment, force : float
        Root mean square of the residual's parts, N m and N.
    shift : float
        By how much the moment left out moves the centre of pressure of a robot that pushes with its weight, root mean
        square: moment / weight, m.
    us, law_us : float
        Time for a state of the batch, µs: from (q, v, a), and of the template's law alone.
    ratio, law_ratio : float
        Of those to the time of the full model.
    disturbed : bool
        Whether the machine was busy with other work in every round.
    """

    robot: str
    motion: str
    template: str
    rms: float
    largest: float
    moment: float
    force: float
    shift: float
    us: float
    law_us: float
    ratio: float
    law_ratio: float
    disturbed: bool


def losses(
    model: tw.Model, motion: Motion, *, rounds: int = 7, after_round: Callable[[], object] = lambda: None
) -> Iterator[Loss]:
    """Compare every template with the full model over a motion, and time them in turns.

    Parameters
    ----------
    model : Model
    motion : Motion
    rounds : int
        Of the timing.
    after_round : callable
        Called after each round, for a progress bar.

    Yields
    ------
    Loss

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> for loss in losses(model, tw.motions.walk(model, samples=20), rounds=1):
    ...     print(f"{loss.template:12} {loss.rms:.0e}")
    point_mass   2e-02
    lipm         2e-02
    srbm_frozen  2e-02
    srbm         2e-02
    centroidal   ...e-16
    full         0e+00
    """
    made = {name: kind.of(model, model.standing()) for name, kind in TEMPLATES.items()}
    state = model.state(motion.q, v=motion.v, a=motion.a)
    calls: list[Callable[[], object]] = []
    for template in made.values():
        known = template.read(*state)
        calls += [partial(template.rate, motion.q, motion.v, motion.a), partial(template.law, *known)]
    laps = round_robin(calls, rounds=rounds, after_round=after_round)
    times = [float(np.median(lap.seconds)) * 1e6 / len(motion) for lap in laps]
    full = times[2 * list(made).index(REFERENCE)]
    for k, (name, template) in enumerate(made.items()):
        residual = template.residual(motion.q, motion.v, motion.a)
        whole, law = times[2 * k : 2 * k + 2]
        yield Loss(
            *(model.name, motion.name, name),
            *(_rms(residual.relative[:, None]), float(residual.relative.max())),
            *(_rms(residual.moment), _rms(residual.force), _rms(residual.moment) / residual.weight),
            *(whole, law, whole / full, law / full),
            disturbed=not all(lap.kept for lap in laps[2 * k : 2 * k + 2]),
        )


def _rms(x: Any) -> float:
    """Root of the mean over the states of the square of the length."""
    return float(np.sqrt((x * x).sum(axis=-1).mean()))


def add_templates(studies: Any) -> None:
    """Add ``python -m benchmarks.study templates``."""
    parser = studies.add_parser(
        "templates",
        help="what point mass, pendulum and rigid body leave out of a walk, a trot and a jump",
        description="Make a walk, a trot and a jump of each robot, compare every template with the full model over "
        "each, and time them in turns.",
    )
    parser.add_argument("robot", nargs="*", default=list(ROBOTS), metavar="ROBOT", help=f"({' '.join(ROBOTS)})")
    parser.add_argument("--samples", type=at_least(2), default=200, metavar="N", help="states of each motion (200)")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="draw the first robot: a png, svg or pdf")
    parser.set_defaults(run=run_templates)


def run_templates(args: argparse.Namespace) -> int:
    """Print a table for each robot, and draw the first."""
    from tqdm import tqdm

    if args.plot is not None:
        check_format(args.plot)
        check_writable("--plot", args.plot)
    drawn = args.plot is None
    for robot in args.robot:
        try:
            model = tw.load(robot)
        except tw.NameNotFound:
            if robot not in ROBOTS:
                raise
            print(f"{robot}: not installed, left out (example-robot-data)\n")
            continue
        motions = [make(model, samples=args.samples) for make in MOTIONS.values()]
        rounds = 7
        with tqdm(total=rounds * len(motions), desc=robot, disable=not sys.stderr.isatty(), leave=False) as bar:
            found = [loss for m in motions for loss in losses(model, m, rounds=rounds, after_round=bar.update)]
        print(_table(robot, model, motions, found))
        if not drawn:
            from .templates_picture import draw

            draw(model, motions, args.plot)
            drawn = True
    return 0


def _table(robot: str, model: tw.Model, motions: Sequence[Motion], found: Sequence[Loss]) -> str:
    head = ("relative", "moment, N m", "shift, mm", "force, N", "µs/state", "× full", "law × full")
    lines = [
        f"{robot}, nv = {model.nv}, {model.mass:.3g} kg: what is left out of ḣ_G, root mean square over the states",
        "relative to the weight (largest); shift = moment / weight: how far it moves the centre of pressure",
        "",
        f"{'motion':7}{'template':11}{head[0]:>18}" + "".join(f"{title:>{len(title) + 2}}" for title in head[1:]),
    ]
    for motion in motions:
        for r in found:
            if r.motion == motion.name:
                share = f"{r.rms:.2g} ({r.largest:.2g})"
                numbers = [f"{x:.2g}" for x in (r.moment, 1e3 * r.shift, r.force)]
                numbers += ["~" * r.disturbed + f"{r.us:.3g}", f"{r.ratio:.2f}", f"{r.law_ratio:.3f}"]
                cells = "".join(f"{x:>{len(title) + 2}}" for x, title in zip(numbers, head[1:]))
                lines.append(f"{r.motion:7}{r.template:11}{share:>18}{cells}")
        lines.append(_needs(model, motion))
    if any(r.disturbed for r in found):
        lines.append("~ the machine had other things to do in every round: run it again when it has not")
    return "\n".join(lines) + "\n"


def _needs(model: tw.Model, motion: Motion) -> str:
    """Return in words what the ground must do for a motion."""
    needed = tw.motions.ground(model, motion)
    broken = tw.motions.limits_broken(model, motion)
    limits = f"        outside the limits of {len(broken)} joints: {', '.join(broken)}\n" if broken else ""
    worst = 1e3 * float(needed.margin.min())
    return (
        f"        the ground: loaded for {100 * needed.loaded.mean():.0f} % of the time, friction of at least "
        f"{needed.friction.max():.2f},\n        centre of pressure at worst {abs(worst):.0f} mm "
        f"{'inside' if worst > 0 else 'outside'} the polygon of the feet's frames\n{limits}"
    )
